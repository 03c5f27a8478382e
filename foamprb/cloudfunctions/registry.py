"""The cloud functions by name, and the functions of a run with their data."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.communicator import Value
from foamprb.cloud.state import Particles, empty
from foamprb.cloudfunctions.base import (
    CloudFunction,
    ContactObserver,
    Memory,
    ObservedCloud,
    append,
    events_of,
    in_time,
    memory_of,
    names_of_kind,
    per_cell,
    per_particle,
    rows_of_particles,
)
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.field_sampling import FieldSampling
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.cloudfunctions.sampling import Sampling
from foamprb.cloudfunctions.suspension_stress import SuspensionStress
from foamprb.errors import InputError
from foamprb.flow.fields import FieldColumns, columns_of
from foamprb.results.tables import Column

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

    Raises
    ------
    InputError
        If the cloud lacks a name in the entries of a function.
    """

    def __init__(self, functions: Mapping[str, CloudFunction], cloud: ObservedCloud) -> None:
        self.functions = dict(functions)
        self.cloud = cloud
        self._memory: dict[str, Memory] = {}
        """Data of the functions; ranks hold the rows of arrays per particle."""
        for name, function in self.functions.items():
            try:
                self._begin(name, function)
                if undeclared := self._memory[name].keys() - function.arrays:
                    raise TypeError(f"{type(function).__name__}.arrays lacks {', '.join(undeclared)}")
            except InputError as error:
                raise InputError(f"cloudFunctions/{name}: {error}") from error
        base, away = cloud.cloud, {name: self.functions[name] for name in self.travelling}
        # The sums of all cells stay here.
        initial = {name: self._without_cells(name) for name in away}
        arguments = base.interactions, base.medium, cloud.names, base.late
        base.comm.call(Sampling.install, Sampling(away, initial, *arguments))

    def _begin(self, name: str, function: CloudFunction) -> None:
        """Let a function return its initial data."""
        cloud = self._seen_by(name)
        if name not in self.travelling:
            self._memory[name] = function.begin(cloud)
            return
        self._memory[name] = function.begin(cloud.of(empty(0)))

        def first(p: Particles) -> Memory:
            rows = rows_of_particles(function, function.begin(cloud.of(p)))
            return {f"{name}/{key}": array for key, array in rows.items()}

        self.cloud.cloud.comm.store(first(empty(0)), first)

    def _seen_by(self, name: str) -> ObservedCloud:
        """Return the cloud as a function observes it."""
        return replace(self.cloud, _name=name)

    def _without_cells(self, name: str) -> Memory:
        sums, memory = names_of_kind(self.functions[name], per_cell), self._memory[name]
        return {key: array[:0] if key in sums else array for key, array in memory.items()}

    @property
    def travelling(self) -> list[str]:
        """Names of the functions whose data go with the particles."""
        return [name for name, function in self.functions.items() if names_of_kind(function, per_particle)]

    def _gather(self) -> None:
        """Take the events of all ranks, in the order of their times, and their sums of cells."""
        self._record_rebounds()
        comm = self.cloud.cloud.comm
        events = comm.call(Sampling.take_events)
        for name in events[0]:
            table = events_of(self.functions[name])
            new = np.concatenate([tables[name] for tables in events])
            self._memory[name][table] = in_time(append(self._memory[name], table, new))
        for rank in comm.call(Sampling.take_sums):
            for name, sums in rank.items():
                total = self._memory[name][names_of_kind(self.functions[name], per_cell)[0]]
                total += sums

    def write(self, folder: Path) -> None:
        """Let every function write into a folder of its name."""
        self._gather()
        for name, function in self.functions.items():
            function.write(self._memory[name], self._seen_by(name), folder / name)

    def with_fates(self, function: Callable[..., Value], *arguments: object) -> Iterator[Value]:
        """Apply a function to blocks of particles, and the columns that are added to ``fates`` for these.

        See :meth:`ObservedCloud.map`.
        """
        fields = tuple(columns_of(self.cloud.cloud.flow))
        return self.cloud.map(_with_fates, function, self.functions, fields, *arguments)

    def state(self) -> Memory:
        """Return the data of all functions, by ``function/array``; without the rows of several ranks."""
        self._gather()
        here = self.cloud.cloud.comm.arrays_here()
        arrays = {f"{name}/{key}": array for name, m in self._memory.items() for key, array in m.items()}
        return {path: here.get(path, array) for path, array in arrays.items()}

    def _record_rebounds(self) -> None:
        """Let the functions record rebounds and passages since the last call."""
        cloud = self.cloud.cloud
        rows = cloud.take_rebounds() if cloud.models.rebounds and self.functions else ()
        if len(rows) == 0:
            return
        for name, function in self.functions.items():
            if isinstance(function, ContactObserver):
                function.record_rebounds(self._memory[name], self._seen_by(name), np.asarray(rows))

    def restore(self, stored: Collection[str], read: Callable[[str], NDArray[Any]]) -> None:
        """Restore the data that :meth:`state` returned in an earlier run, but for the rows that ranks hold.

        Parameters
        ----------
        stored
            Names of all arrays, ``function/array``.
        read
            Returns one of them, with all rows.

        Raises
        ------
        InputError
            If it belongs to other functions.
        """
        expected, names = {*self.state()}, {*stored}
        if expected != names:
            changed = ", ".join(sorted({key.split("/")[0] for key in expected ^ names}))
            raise InputError(f"cloudFunctions: {changed} was not observed from the start, or no longer is.")
        for name, memory in self._memory.items():
            kinds = self.functions[name].arrays
            tables = [key for key in memory if kinds[key] is not per_particle]
            for key in tables:
                array, initial = read(f"{name}/{key}"), memory[key]
                if array.dtype != initial.dtype or array.shape[1:] != initial.shape[1:]:
                    raise InputError(f"cloudFunctions: {name}/{key} of the checkpoint has another type.")
                memory[key] = array


def _with_fates(
    p: Particles,
    memory: Memory,
    function: Callable[..., Value],
    functions: Mapping[str, CloudFunction],
    fields: Sequence[FieldColumns],
    *arguments: object,
) -> Value:
    """Apply a function to particles and to the columns that cloud functions add to ``fates``."""
    columns: dict[str, Column] = {}
    for name, cloud_function in functions.items():
        columns |= cloud_function.fates(memory_of(memory, name), fields)
    return function(p, columns, *arguments)
