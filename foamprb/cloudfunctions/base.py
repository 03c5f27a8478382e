"""Base classes of cloud functions, OpenFOAM's ``cloudFunctions``, which record data of a cloud during a run.

A cloud function is a frozen dataclass of its entries with methods. Its data is a dict of arrays that belongs
to the run, so that a checkpoint can save it. A new function is one file with such a class and a line in
:mod:`foamprb.cloudfunctions.registry`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Value, parts_of
from foamprb.cloud.contact import Rebounds, passages
from foamprb.cloud.measures import MEASURES, PER_CONTEXT, Context, as_slice, contexts, fields_at
from foamprb.cloud.patches import CYCLIC, Interaction
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.tracker import Tracker
from foamprb.dictionary.constraints import AtLeastOne, Meaning
from foamprb.flow.fields import FieldColumns, FieldValues
from foamprb.flow.loaded import LoadedFlow
from foamprb.results.tables import Column

__all__ = [
    "CELLS",
    "STATUS_NAMES",
    "CloudFunction",
    "CloudShare",
    "Memory",
    "ObservedCloud",
    "Rows",
    "SampleInterval",
    "SampledFunction",
    "add_up",
    "append",
    "columns",
    "in_time",
    "masses",
    "memory_of",
    "names_of",
    "store",
    "taylor_of",
]

Rows: TypeAlias = NDArray[np.int64]
"""Row numbers of particles in their cloud."""
Memory: TypeAlias = dict[str, NDArray[Any]]
CELLS = 1 << 18
"""Cells in a part of :meth:`ObservedCloud.of_cells`."""
SampleInterval = Annotated[int, AtLeastOne, Meaning("steps between two samples")]
STATUS_NAMES = tuple(status.name.lower() for status in Status)


class CloudShare(NamedTuple):
    """Properties of a cloud that functions use where some of its particles are, in place of the cloud."""

    interactions: Sequence[Interaction]
    flow: LoadedFlow
    medium: Medium
    tracker: Tracker
    time: float


@dataclass(frozen=True)
class ObservedCloud:
    """The cloud of a run as an argument of its functions, with the names of injection models and patches."""

    cloud: Cloud
    injectors: tuple[str, ...]
    patches: tuple[str, ...]
    tables: str = "csv"
    """Kind of the tables of functions, and suffix of their files."""
    seen: Particles | None = None
    """Particles that are observed; None for all."""
    name: str = ""
    """Name of the function that observes."""

    @property
    def particles(self) -> Particles:
        """The observed particles, pending ones included; their rows are those of the other methods."""
        return self.cloud.whole() if self.seen is None else self.seen

    def seeing(self, p: Particles) -> ObservedCloud:
        """Return the same cloud with other observed particles."""
        return replace(self, seen=p)

    def of(self, numbers: Rows) -> ObservedCloud:
        """Return the same cloud with the particles of some numbers, in their order."""
        return self.seeing(self.cloud.of(numbers))

    def observe(self, numbers: Rows, function: Callable[..., Value], *arguments: Any) -> list[Value]:
        """Return what a function finds of some particles, where they move.

        Parameters
        ----------
        numbers
            The particles; rising.
        function
            Called with the cloud that has only those of them that a process moves, and the ``arguments``;
            other processes import it.
        """
        if self.cloud.homes is None:
            return [function(self.of(numbers), *arguments)]
        return self.cloud.homes.observe(numbers, function, self.time, *arguments)

    def at_homes(self, remembered: Memory, function: Callable[..., Value], *arguments: Any) -> list[Value]:
        """Return what a function finds of the particles of each process.

        Parameters
        ----------
        remembered
            Arrays of the function that observes with a row for each particle, see
            :meth:`CloudFunction.of_particles`.
        function
            Called with particles in any order, the arrays of these particles, and the ``arguments``; other
            processes import it.
        """
        if self.cloud.homes is None:
            return [function(self.cloud.particles, remembered, *arguments)]
        return self.cloud.homes.at_homes(function, *arguments, of=self.name)

    def in_order(
        self, remembered: Memory, function: Callable[..., Value], *arguments: Any
    ) -> Iterator[Value]:
        """Yield what a function finds of all particles, part by part in the order of their numbers.

        See :meth:`at_homes`. A cloud without particles has one part.
        """
        if self.cloud.homes is not None:
            return self.cloud.homes.in_order(function, *arguments, of=self.name)
        p = self.cloud.particles
        return (
            function(p.take(part), {key: array[part] for key, array in remembered.items()}, *arguments)
            for part in parts_of(p.size)
        )

    @property
    def time(self) -> float:
        """Time of the cloud, s."""
        return self.cloud.time

    def has_ended(self, rows: Rows | slice) -> NDArray[np.bool_]:
        """Return whether particles have ended: those that may move again have not."""
        return np.isin(self.particles.status[rows], self.cloud.tracker.movable, invert=True)

    def passages(self, rows: NDArray[np.float64]) -> Iterator[tuple[Rebounds, Rebounds]]:
        """Yield the passages of coupled patches among records, see :func:`foamprb.cloud.contact.passages`."""
        return passages(rows, [k for k, i in enumerate(self.cloud.interactions) if i.code == CYCLIC])

    def contexts(self, rows: Rows) -> Iterator[Context]:
        """Yield the arguments of the measures for particles of any status.

        See :func:`foamprb.cloud.measures.contexts`; they come in parts.
        """
        p = self.particles
        for start in range(0, max(len(rows), 1), PER_CONTEXT):
            yield from self._contexts_of(p.take(as_slice(rows[start : start + PER_CONTEXT])))

    def collect_of(self, p: Particles, *values: Callable[[Context], NDArray[Any]]) -> list[NDArray[Any]]:
        """Return values of particles that may differ from the cloud's present state."""
        return _collect(self._contexts_of(p), values)

    def _contexts_of(self, p: Particles) -> Iterator[Context]:
        p = p._replace(status=np.full_like(p.status, Status.ACTIVE))
        return contexts(p, self.cloud.flow, self.cloud.medium.mu, self.time)

    def of_cells(self, sums: NDArray[np.float64], n: int) -> Iterator[tuple[slice, NDArray[np.float64]]]:
        """Yield parts of n cells in their order, and the sums of each; see :attr:`CloudFunction.sums`."""
        homes = self.cloud.homes
        for first in range(0, n, CELLS):
            part = slice(first, min(first + CELLS, n))
            yield part, sums[part] if homes is None else homes.of_cells(self.name, part)

    def fields(self, rows: Rows) -> Mapping[str, FieldValues]:
        """Return the sampled fields at particles at their times; NaN at pending ones."""
        p = self.particles.take(rows)
        hosts = np.where(p.status == Status.PENDING, np.int32(-1), p.host)
        return fields_at(self.cloud.flow, p.x, hosts, np.minimum(p.t, self.time))

    def at(self, flow: LoadedFlow, time: float) -> ObservedCloud:
        """Return the same particles in a flow that is loaded, at a time, s."""
        cloud = self.cloud
        share: Any = CloudShare(cloud.interactions, flow, cloud.medium, cloud.tracker, time)
        return replace(self, cloud=share, seen=self.particles)

    def appearing(self, until: float) -> Rows:
        """Return the pending particles that appear between the time of the cloud and ``until``, s."""
        p = self.particles
        return np.flatnonzero((p.status == Status.PENDING) & (p.t0 >= self.time) & (p.t0 <= until))

    def fields_at_release(self, rows: Rows, hosts: NDArray[np.int32]) -> Mapping[str, FieldValues]:
        """Return the sampled fields where and when particles were released in their hosts."""
        p = self.particles
        return fields_at(self.cloud.flow, p.x0[rows], hosts, p.t0[rows])

    def measure(self, rows: Rows, *names: str) -> list[NDArray[Any]]:
        """Return some of :data:`foamprb.cloud.measures.MEASURES` of particles of any status."""
        return _collect(self.contexts(rows), [MEASURES[name].value for name in names])


def _collect(
    found: Iterable[Context], values: Sequence[Callable[[Context], NDArray[Any]]]
) -> list[NDArray[Any]]:
    parts = [[np.array(value(c)) for value in values] for c in found]
    return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]


@dataclass(frozen=True)
class CloudFunction:
    """A function that records data while the cloud moves."""

    @property
    def interval(self) -> int:
        """Tracking steps between two samples: ``sampleInterval``, or 0 for samples at write times only."""
        return int(getattr(self, "sampleInterval", 0))

    whole: ClassVar[bool] = True
    """Whether it reads ``particles`` of the whole cloud, which the first process of several then collects for
    each call. Otherwise it uses :meth:`ObservedCloud.of`, ``observe``, ``at_homes`` and ``in_order``, or has
    :attr:`rows`."""
    rows: ClassVar[bool] = False
    """Whether all its arrays have a row for each particle, but :attr:`events`, :attr:`common` and ``sums``.
    It can then begin and sample with some particles and their rows, which go with the particles."""
    events: ClassVar[str] = ""
    """Name of the array with a row for each event: number of the particle, time, and others."""
    common: ClassVar[frozenset[str]] = frozenset({"history", "written", "warned"})
    """Names of arrays that only :meth:`write` needs."""
    sums: ClassVar[bool] = False
    """Whether its array ``sums`` has a row for each cell of the mesh, to which the events of each sample are
    added and then removed. An event has the number of the particle, another one that orders its events, the
    cell, and what is added. Of a cloud at homes each process has the rows of some cells."""

    @property
    def needed_fields(self) -> tuple[str, ...]:
        """Names of the fields of the case that it samples."""
        return ()

    def begin(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return the initial data; raise InputError if the cloud lacks a name in the entries."""
        return {}

    def of_particles(self, memory: Memory) -> Memory:
        """Return the arrays with a row for each particle."""
        if not self.rows:
            return {}
        others = {self.events, *self.common, *(("sums",) if self.sums else ())}
        return {key: array for key, array in memory.items() if key not in others}

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Record a sample of the cloud, every ``interval`` steps and before each writing."""

    def before_steps(self, memory: Memory, cloud: ObservedCloud, until: float) -> None:
        """Observe particles before the steps of a call of the loop, from the time of the cloud ``until``, s.

        The flow of these steps is loaded. By default no-op.
        """

    def after_steps(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Observe particles after the steps of a call; see :meth:`before_steps`."""

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the data into the function's own folder, at each write time."""
        raise NotImplementedError

    def fates(self, memory: Memory, fields: Sequence[FieldColumns]) -> Mapping[str, Column]:  # noqa: ARG002
        """Return columns of ``fates``, with a row for each row of the data; by default none.

        ``fields`` are those of the flow that are sampled.
        """
        return {}

    def needs_rebounds(self, interactions: Mapping[str, Interaction]) -> bool:  # noqa: ARG002
        """Return whether it needs the records of rebounds or passages, by the interactions of the patches."""
        return False

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Record rebounds and passages, which :meth:`foamprb.cloud.cloud.Cloud.take_rebounds` returned.

        The next sample follows.
        """


@dataclass(frozen=True)
class SampledFunction(CloudFunction):
    """A cloud function that compares each sample of a particle with the one before.

    Between two samples a particle is not observed, but the last sample is at its exact end.
    """

    whole: ClassVar[bool] = False
    rows: ClassVar[bool] = True

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return the values of particles that are stored at each sample, by name."""
        raise NotImplementedError

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return further data at the start: sums of zero and empty tables."""
        raise NotImplementedError

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Add a sample: ``memory`` has the values and times ``t`` of the last, ``now`` those of the present.

        It may change ``now``, which is stored afterwards.
        """
        raise NotImplementedError

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the first sample, of all particles, and the initial data."""
        p = cloud.particles
        own = self.initial(cloud)
        closed = np.zeros(p.size, dtype=bool)
        return {"closed": closed, "t": p.t.copy(), **self.observe(cloud, np.arange(p.size)), **own}

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add a sample of the particles that move, or that have ended since the last one."""
        self._add(memory, cloud, ~memory["closed"] & (cloud.particles.status != Status.PENDING))

    def close(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add the last sample of the particles that have ended since the one before."""
        self._add(memory, cloud, ~memory["closed"] & cloud.has_ended(slice(None)))

    def _add(self, memory: Memory, cloud: ObservedCloud, chosen: NDArray[np.bool_]) -> None:
        p, rows = cloud.particles, np.flatnonzero(chosen)
        now = {**self.observe(cloud, rows), "t": p.t[rows]}
        self.add(memory, cloud, rows, now)
        store(memory, rows, {**now, "closed": cloud.has_ended(rows)})


def store(memory: Memory, rows: Rows, values: Memory) -> None:
    """Store values of the particles of some rows."""
    for name, array in values.items():
        memory[name][rows] = array


def memory_of(memory: Mapping[str, NDArray[Any]], name: str) -> Memory:
    """Return the arrays of a function among those of all, by ``function/array``; all without a name."""
    own = f"{name}/" if name else ""
    return {key.removeprefix(own): array for key, array in memory.items() if key.startswith(own)}


def append(memory: Memory, name: str, lines: Any) -> NDArray[np.float64]:
    """Append lines to a table of the data, and return the table."""
    table = memory[name]
    memory[name] = np.concatenate([table, np.reshape(lines, (-1, table.shape[1]))])
    return memory[name]


def in_time(events: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return events in the order of their times, then of particle numbers."""
    steps = np.diff(events[:, :2], axis=0)
    if ((steps[:, 1] > 0.0) | ((steps[:, 1] == 0.0) & (steps[:, 0] >= 0.0))).all():
        return events
    return events[np.lexsort((events[:, 0], events[:, 1]))]


def add_up(sums: NDArray[np.float64], events: NDArray[np.float64]) -> None:
    """Add events, (n, 3 + k), in their order to sums, (n_cells, k); see :attr:`CloudFunction.sums`."""
    cell = events[:, 2].astype(np.int64)
    for total, values in zip(sums.T, events[:, 3:].T, strict=True):
        np.add.at(total, cell, values)


def taylor_of(cloud: ObservedCloud, rows: Rows, F: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return Taylor's D of particles with the deformation gradients F, (n, 9)."""
    p = cloud.particles.take(rows)._replace(F=np.ascontiguousarray(F))
    return cloud.collect_of(p, MEASURES["taylorDeformation"].value)[0]


def masses(p: Particles, rows: Rows) -> NDArray[np.float64]:
    """Return masses, kg."""
    mass: NDArray[np.float64] = 4.0 / 3.0 * math.pi * p.rho[rows] * p.R[rows] ** 3
    return mass


def names_of(names: Sequence[str], codes: NDArray[Any]) -> list[str]:
    """Return the name of each code."""
    return [names[code] for code in codes.astype(np.int64)]


def columns(names: Sequence[str], array: NDArray[Any]) -> dict[str, Column]:
    """Return the columns of an array by their names."""
    return dict(zip(names, array.T, strict=True))
