"""The cloud functions by name, and the functions of a run with their data."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Value
from foamprb.cloud.state import Particles, empty
from foamprb.cloudfunctions.base import (
    CloudFunction,
    CloudShare,
    ContactObserver,
    Memory,
    ObservedCloud,
    StepObserver,
    add_up,
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
from foamprb.cloudfunctions.suspension_stress import SuspensionStress
from foamprb.errors import InputError
from foamprb.flow.fields import FieldColumns, columns_of
from foamprb.flow.loaded import LoadedFlow
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
        """What the functions remember; of processes that hold the particles, without their rows."""
        for name, function in self.functions.items():
            try:
                self._begin(name, function)
                if undeclared := self._memory[name].keys() - function.arrays:
                    raise TypeError(f"{type(function).__name__}.arrays lacks {', '.join(undeclared)}")
            except InputError as error:
                raise InputError(f"cloudFunctions/{name}: {error}") from error

    def _begin(self, name: str, function: CloudFunction) -> None:
        """Let a function return its initial data."""
        cloud, homes = self._seen_by(name), self.cloud.cloud.homes
        if homes is None or name not in self.travelling:
            self._memory[name] = function.begin(cloud)
            return
        self._memory[name] = memory = function.begin(cloud.of(empty(0)))
        homes.remember(self.with_particles([name]))
        for sums in names_of_kind(function, per_cell):
            homes.share_sums(name, memory[sums].shape)
            memory[sums] = memory[sums][:0].copy()
        homes.begin(name, lambda p: rows_of_particles(function, function.begin(cloud.of(p))))

    def _seen_by(self, name: str) -> ObservedCloud:
        """Return the cloud as a function observes it."""
        return replace(self.cloud, _name=name)

    def _in(self, flow: LoadedFlow, time: float) -> ObservedCloud:
        """Return the cloud in a flow that is loaded, at a time, s."""
        cloud = self.cloud.cloud
        share: Any = CloudShare(cloud.interactions, flow, cloud.medium, cloud.tracker, time)
        return replace(self.cloud, cloud=share, _seen=cloud.whole())

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
        """Names of the functions whose data go with the particles."""
        return [name for name, function in self.functions.items() if names_of_kind(function, per_particle)]

    @property
    def summing(self) -> list[str]:
        """Names of the functions that have sums of cells."""
        return [name for name, function in self.functions.items() if names_of_kind(function, per_cell)]

    def before_steps(self, flow: LoadedFlow, start: float, until: float) -> None:
        """Let the functions observe the particles before a call of the loop, while its flow is loaded."""
        cloud = self._in(flow, start)
        for name, function in self.functions.items():
            if isinstance(function, StepObserver):
                function.before_steps(self._memory[name], cloud, until)

    def after_steps(self, flow: LoadedFlow, until: float) -> None:
        """Let the functions observe the particles after a call of the loop."""
        cloud = self._in(flow, until)
        for name, function in self.functions.items():
            if isinstance(function, StepObserver):
                function.after_steps(self._memory[name], cloud)

    def sample(self, names: Collection[str]) -> None:
        """Let some functions record a sample."""
        self._record_rebounds()
        for name in names:
            function, memory = self.functions[name], self._memory[name]
            self._observe(name, function.sample)
            for sums in names_of_kind(function, per_cell):
                events = events_of(self.functions[name])
                add_up(memory[sums], memory[events])
                memory[events] = memory[events][:0].copy()

    def _observe(self, name: str, observe: Callable[[Memory, ObservedCloud], None]) -> None:
        """Let a function observe particles, and add its events in their order."""
        memory, events = self._memory[name], events_of(self.functions[name])
        before = memory.get(events)
        if before is not None:
            memory[events] = before[:0]
        observe(memory, self._seen_by(name))
        if before is not None:
            memory[events] = np.concatenate([before, in_time(memory[events])])

    def write(self, folder: Path) -> None:
        """Let every function write into a folder of its name."""
        for name, function in self.functions.items():
            if events := events_of(self.functions[name]):
                # Those of rebounds and of samples were recorded one after the other.
                self._memory[name][events] = in_time(self._memory[name][events])
            function.write(self._memory[name], self._seen_by(name), folder / name)

    def with_particles(self, names: Iterable[str]) -> Memory:
        """Return the arrays of some functions with a row for each particle, by ``function/array``."""
        return {
            f"{name}/{key}": array
            for name in names
            for key, array in rows_of_particles(self.functions[name], self._memory[name]).items()
        }

    def new_events(self, names: Iterable[str]) -> Memory:
        """Return empty tables of the events of some functions, by their names."""
        tables = {name: events_of(self.functions[name]) for name in names}
        return {name: self._memory[name][table][:0] for name, table in tables.items() if table}

    def add_events(self, found: Sequence[Memory]) -> None:
        """Add tables of events, which were recorded apart, in the order of their times."""
        for name in found[0]:
            new = np.concatenate([tables[name] for tables in found])
            append(self._memory[name], events_of(self.functions[name]), in_time(new))

    def with_fates(self, function: Callable[..., Value], *arguments: Any) -> Iterator[Value]:
        """Yield what a function finds of all particles and of the columns that are added to ``fates``.

        See :meth:`ObservedCloud.map`. The columns are those of the same particles, by name.
        """
        fields = tuple(columns_of(self.cloud.cloud.flow))
        given = function, self.functions, fields, *arguments
        return self.cloud.map(self.with_particles(self.functions), _with_fates, *given)

    def state(self) -> Memory:
        """Return the data of all functions, by ``function/array``; of particles elsewhere, no rows."""
        self._record_rebounds()
        return {f"{name}/{key}": array for name, m in self._memory.items() for key, array in m.items()}

    def _record_rebounds(self) -> None:
        if self.cloud.cloud.models.rebounds:
            self.record_rebounds(self.cloud.cloud.take_rebounds(), self.functions)

    def record_rebounds(self, rows: NDArray[np.float64], names: Iterable[str]) -> None:
        """Let some functions record rebounds and passages; for these see :meth:`Cloud.take_rebounds`."""
        for name in names if len(rows) else ():
            function = self.functions[name]
            if isinstance(function, ContactObserver):
                self._observe(name, partial(function.record_rebounds, rows=rows))

    def restore(self, stored: Collection[str], read: Callable[[str], NDArray[Any]]) -> None:
        """Restore the data that :meth:`state` returned in an earlier run.

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
        elsewhere: set[str] = set()
        if self.cloud.cloud.homes is not None:
            sums = [f"{name}/sums" for name in self.summing]
            elsewhere = {*self.with_particles(self.travelling), *sums}
        expected, found = {*self.state()}, {*stored}
        if expected != found:
            changed = ", ".join(sorted({key.split("/")[0] for key in expected ^ found}))
            raise InputError(f"cloudFunctions: {changed} was not observed from the start, or no longer is.")
        for name, memory in self._memory.items():
            own = {key: f"{name}/{key}" for key in memory}
            memory.update({key: read(path) for key, path in own.items() if path not in elsewhere})


def _with_fates(
    p: Particles,
    memory: Memory,
    function: Callable[..., Value],
    functions: Mapping[str, CloudFunction],
    fields: Sequence[FieldColumns],
    *arguments: Any,
) -> Value:
    """Return what a function finds of particles, and of the columns of cloud functions for them."""
    found: dict[str, Column] = {}
    for name, own in functions.items():
        found |= own.fates(memory_of(memory, name), fields)
    return function(p, found, *arguments)
