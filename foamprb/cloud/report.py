"""Measures of particles as points with arrays, for files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import (
    MEASURES,
    Gradients,
    contexts,
    injected,
    measure,
    number_of_contexts,
)
from foamprb.cloud.state import Particles
from foamprb.flow.base import Sampled
from foamprb.results.vtk import Parts, PointCloud


def report(
    particles: Particles,
    flow: Sampled | Gradients,
    mu: float,
    time: float,
    names: Mapping[str, Sequence[str]],
    ids: NDArray[np.int64] | None = None,
) -> Parts:
    """Return all measures of the injected particles, computed part by part on request.

    Parameters
    ----------
    particles, flow, mu, time, ids
        See :func:`foamprb.cloud.measures.context`.
    names
        For each array of codes, the meanings of the codes 0, 1, ….
    """
    units = {name: m.unit for name, m in MEASURES.items()}

    def parts() -> Iterator[PointCloud]:
        for c in contexts(particles, flow, mu, time, ids):
            yield PointCloud(time, c.particles.x, measure(c), units, names)

    return Parts(time, number_of_contexts(len(injected(particles))), parts())
