"""The cloud functions by name, and the functions of a run with their data."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloudfunctions.base import CloudFunction, Memory, ObservedCloud, Rows, append
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.field_sampling import FieldSampling
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.suspension_stress import SuspensionStress
from foamprb.errors import InputError
from foamprb.results.tables import Column

__all__ = ["FUNCTIONS", "CloudFunctions"]

FUNCTIONS: dict[str, type[CloudFunction]] = {
    "deformabilityCytometry": DeformabilityCytometry,
    "fieldSampling": FieldSampling,
    "haemolysis": Haemolysis,
    "particleCollector": ParticleCollector,
    "particleHistogram": ParticleHistogram,
    "particleStatistics": ParticleStatistics,
    "particleTracks": ParticleTracks,
    "patchPostProcessing": PatchPostProcessing,
    "suspensionStress": SuspensionStress,
}
"""By the word that ``type`` selects."""


class CloudFunctions:
    """The cloud functions of a run with their data.

    Parameters
    ----------
    functions
        By their names.
    cloud
        The cloud at the start.

    Raises
    ------
    InputError
        If the cloud lacks a name in the entries of a function.
    """

    def __init__(self, functions: Mapping[str, CloudFunction], cloud: ObservedCloud) -> None:
        self.functions = dict(functions)
        self.cloud = cloud
        self._memory: dict[str, Memory] = {}
        for name, function in self.functions.items():
            try:
                self._memory[name] = function.begin(cloud)
            except InputError as error:
                raise InputError(f"cloudFunctions/{name}: {error}") from error

    def next_sample(self, last: int) -> int:
        """Return the step of the next sample, at most ``last``."""
        step = self.cloud.cloud.step
        return min([last, *((step // n + 1) * n for f in self.functions.values() if (n := f.interval) > 0)])

    @property
    def due(self) -> list[str]:
        """Names of the functions that sample at the present step."""
        step = self.cloud.cloud.step
        return [name for name, f in self.functions.items() if f.interval and step % f.interval == 0]

    @property
    def travelling(self) -> list[str]:
        """Names of the functions whose data can go with the particles."""
        if self.cloud.cloud.models.rebounds:
            # Records of a particle may be on another process than the particle.
            return []
        return [name for name, function in self.functions.items() if function.travels]

    def watched(self, names: Collection[str]) -> Rows | None:
        """Return the numbers of the particles that some functions sample next; None for all."""
        found = [self.functions[name].watched(self._memory[name]) for name in names]
        some = [rows for rows in found if rows is not None]
        return np.unique(np.concatenate(some)) if len(some) == len(found) else None

    def sample(self, names: Collection[str]) -> None:
        """Let some functions record a sample."""
        self._record_rebounds()
        for name in names:
            self.functions[name].sample(self._memory[name], self.cloud)

    def write(self, folder: Path) -> None:
        """Let every function write into a folder of its name."""
        for name, function in self.functions.items():
            function.write(self._memory[name], self.cloud, folder / name)

    def with_particles(self, names: Iterable[str]) -> Memory:
        """Return the arrays of some functions with a row for each particle, by ``function/array``."""
        return {
            f"{name}/{key}": array
            for name in names
            for key, array in self._memory[name].items()
            if key != self.functions[name].events and key not in self.functions[name].common
        }

    def new_events(self, names: Iterable[str]) -> Memory:
        """Return empty tables of the events of some functions, by their names."""
        tables = {name: self.functions[name].events for name in names}
        return {name: self._memory[name][table][:0] for name, table in tables.items() if table}

    def add_events(self, found: Sequence[Memory]) -> None:
        """Add tables of events, which were recorded apart, in the order of their times."""
        for name in found[0]:
            new = np.concatenate([tables[name] for tables in found])
            append(self._memory[name], self.functions[name].events, new[np.lexsort((new[:, 0], new[:, 1]))])

    def fates(self) -> dict[str, Column]:
        """Return the columns that the functions add to ``fates``."""
        functions = self.functions.items()
        return {k: c for name, f in functions for k, c in f.fates(self._memory[name], self.cloud).items()}

    def state(self) -> Memory:
        """Return the data of all functions, by ``function/array``."""
        self._record_rebounds()
        return {f"{name}/{key}": array for name, m in self._memory.items() for key, array in m.items()}

    def _record_rebounds(self) -> None:
        if self.cloud.cloud.models.rebounds and len(rows := self.cloud.cloud.take_rebounds()):
            for name, function in self.functions.items():
                function.record_rebounds(self._memory[name], self.cloud, rows)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Restore the data that :meth:`state` returned in an earlier run.

        Raises
        ------
        InputError
            If it belongs to other functions.
        """
        expected, found = sorted(self.state()), sorted(state)
        if expected != found:
            changed = ", ".join(sorted({key.split("/")[0] for key in {*expected} ^ {*found}}))
            raise InputError(f"cloudFunctions: {changed} was not observed from the start, or no longer is.")
        for name, memory in self._memory.items():
            memory.update({key: state[f"{name}/{key}"].copy() for key in memory})
