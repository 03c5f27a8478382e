"""Measures of particles as points with arrays, for files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import (
    MEASURES,
    OF_RATES,
    WRITTEN,
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


class Contents(NamedTuple):
    """Arrays of the files of a cloud, the same at all times."""

    arrays: tuple[str, ...] = WRITTEN
    """Names of the measures."""
    names: Mapping[str, Sequence[str]] = MappingProxyType({})
    """For each array of codes, the meanings of the codes 0, 1, …."""
    single: bool = False
    """Whether numbers have single precision."""
    single_places: bool = False
    """Whether positions have single precision."""

    @property
    def of_flow(self) -> bool:
        """Whether a measure depends on the flow."""
        return any(MEASURES[name].of_flow for name in self.arrays)

    @property
    def of_rates(self) -> bool:
        """Whether a measure depends on dF/dt."""
        return not set(self.arrays).isdisjoint(OF_RATES)


def report(
    particles: Particles,
    flow: Sampled | FlowSamples,
    mu: float | VaryingViscosity,
    time: float,
    contents: Contents,
    ids: NDArray[np.int64] | None = None,
) -> Parts:
    """Return measures and sampled fields of the injected particles, computed part by part on request.

    Parameters
    ----------
    particles, flow, mu, time, ids
        See :func:`foamprb.cloud.measures.context`.
    contents
        The arrays.
    """
    units = {name: MEASURES[name].unit for name in contents.arrays}

    def parts() -> Iterator[PointCloud]:
        for c in contexts(particles, flow, mu, time, ids):
            fields = c.fields()
            arrays = measure(c, contents.arrays) | {name: f.array for name, f in fields.items()}
            if contents.single:
                arrays = {name: _single(array) for name, array in arrays.items()}
            all_units = units | {name: f.unit for name, f in fields.items()}
            x = _single(c.particles.x) if contents.single_places else c.particles.x
            yield PointCloud(time, x, arrays, all_units, contents.names)

    return Parts(time, number_of_contexts(len(injected(particles))), parts())


def _single(array: NDArray[np.generic]) -> NDArray[Any]:
    """Return numbers in single precision; integers unchanged."""
    return array.astype(np.float32) if array.dtype == np.float64 else array
