"""Measures of particles as points with arrays, for files."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import (
    MEASURES,
    FlowSamples,
    contexts,
    injected,
    measure,
    number_of_contexts,
)
from foamprb.cloud.state import Particles
from foamprb.cloud.viscosity import VaryingViscosity
from foamprb.flow.base import Sampled
from foamprb.results.vtk import Parts, PointCloud


def report(
    particles: Particles,
    flow: Sampled | FlowSamples,
    mu: float | VaryingViscosity,
    time: float,
    names: Mapping[str, Sequence[str]],
    further: Collection[str] = (),
    ids: NDArray[np.int64] | None = None,
) -> Parts:
    """Return all measures and sampled fields of the injected particles, computed part by part on request.

    Parameters
    ----------
    particles, flow, mu, time, ids
        See :func:`foamprb.cloud.measures.context`.
    names
        For each array of codes, the meanings of the codes 0, 1, ….
    further
        Names of the optional measures to include.
    """
    units = {name: m.unit for name, m in MEASURES.items() if name in further or not m.optional}

    def parts() -> Iterator[PointCloud]:
        for c in contexts(particles, flow, mu, time, ids):
            fields = c.fields()
            arrays = measure(c, further) | {name: f.array for name, f in fields.items()}
            all_units = units | {name: f.unit for name, f in fields.items()}
            yield PointCloud(time, c.particles.x, arrays, all_units, names)

    return Parts(time, number_of_contexts(len(injected(particles))), parts())
