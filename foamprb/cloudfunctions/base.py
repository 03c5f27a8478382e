"""Base classes of cloud functions, OpenFOAM's ``cloudFunctions``, which record data of a cloud during a run.

A cloud function is a frozen dataclass of its entries with methods. Its data is a dict of arrays that belongs
to the run, so that a checkpoint can save it. A new function is one file with such a class and a line in
:mod:`foamprb.cloudfunctions.registry`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud import contact
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.communicator import Rank, Value
from foamprb.cloud.contact import Rebounds
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
    "ContactObserver",
    "Kind",
    "Memory",
    "ObservedCloud",
    "Rows",
    "SampleInterval",
    "SampledFunction",
    "StepObserver",
    "add_up",
    "appearing",
    "append",
    "columns",
    "events_of",
    "fields_at_release",
    "fields_of",
    "has_ended",
    "in_time",
    "map_where_they_move",
    "masses",
    "memory_of",
    "names_of",
    "names_of_kind",
    "passages",
    "per_cell",
    "per_event",
    "per_particle",
    "rows_of_particles",
    "store",
    "sums_of_cells",
    "table",
    "taylor_of",
]

Rows: TypeAlias = NDArray[np.int64]
"""Row numbers of particles in their cloud."""
Memory: TypeAlias = dict[str, NDArray[Any]]
CELLS = 1 << 18
"""Cells in a part of :func:`sums_of_cells`."""
SampleInterval = Annotated[int, AtLeastOne, Meaning("steps between two samples")]
STATUS_NAMES = tuple(status.name.lower() for status in Status)


class Kind(Enum):
    """Kind of an array of a cloud function: meaning of its rows."""

    per_particle = "a row for each particle, which goes with the particle to the process that advances it"
    per_event = "a row for each event: number of the particle, time, and others; in the order of time"
    per_cell = (
        "a row for each cell of the mesh, to which the events of each sample are added and then removed: "
        "number of the particle, a number that orders its events, cell, and the columns of this array, `sums`"
    )
    table = "rows that only begin and write use"


per_particle, per_event, per_cell, table = Kind


class CloudShare(NamedTuple):
    """Properties of a cloud that functions use where some of its particles are, in place of the cloud."""

    interactions: Sequence[Interaction]
    flow: LoadedFlow
    medium: Medium
    tracker: Tracker
    time: float


@dataclass(frozen=True)
class ObservedCloud:
    """The cloud of a run, as an argument of its functions."""

    cloud: Cloud
    names: Mapping[str, Sequence[str]]
    """Names of the injection models and patches, by ``injector`` and ``patch``."""
    _seen: Particles | None = None
    """Observed particles; None for all."""
    _name: str = ""
    """Name of the observing function."""

    @cached_property
    def particles(self) -> Particles:
        """The observed particles, pending ones included; in a run on several processes collected here."""
        return self.cloud.all_particles() if self._seen is None else self._seen

    @property
    def time(self) -> float:
        """Time of the cloud, s."""
        return self.cloud.time

    def of(self, some: Rows | Particles) -> ObservedCloud:
        """Return the same cloud with other observed particles, given by their numbers or themselves."""
        return replace(self, _seen=some if isinstance(some, Particles) else self.cloud.of(some))

    def measure(self, rows: Rows, *values: str | Callable[[Context], NDArray[Any]]) -> list[NDArray[Any]]:
        """Return values of particles of any status, as if they moved.

        Parameters
        ----------
        rows
            Rows of the particles.
        values
            Names of :data:`foamprb.cloud.measures.MEASURES`, or functions of a
            :class:`~foamprb.cloud.measures.Context`.
        """
        functions = [MEASURES[value].value if isinstance(value, str) else value for value in values]
        parts = []
        for start in range(0, max(len(rows), 1), PER_CONTEXT):
            p = self.particles.take(as_slice(rows[start : start + PER_CONTEXT]))
            p = p._replace(status=np.full_like(p.status, Status.ACTIVE))
            for c in contexts(p, self.cloud.flow, self.cloud.medium.mu, self.time):
                parts.append([np.array(function(c)) for function in functions])
        return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]

    def map(self, function: Callable[..., Value], *arguments: Any) -> Iterator[Value]:
        """Apply a function to blocks of particles, sorted by number; once to a cloud without particles.

        Parameters
        ----------
        function
            Called with particles, the arrays ``per_particle`` of the observing function for these, and the
            ``arguments``; other processes import it.
        """
        return self.cloud.comm.map_by_id(function, *arguments, of=self._name)


@dataclass(frozen=True)
class CloudFunction:
    """A function that records data while the cloud moves."""

    arrays: ClassVar[Mapping[str, Kind]] = {}
    """Kinds of the arrays of its data. With an array ``per_particle`` it samples on each process, with the
    particles and rows of that process."""

    @property
    def interval(self) -> int:
        """Tracking steps between two samples: ``sampleInterval``, or 0 for samples at write times only."""
        return int(getattr(self, "sampleInterval", 0))

    @property
    def needed_fields(self) -> tuple[str, ...]:
        """Names of the fields of the case that it samples."""
        return ()

    def begin(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return the initial data; raise InputError if the cloud lacks a name in the entries."""
        return {}

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Record a sample of the cloud, every ``interval`` steps and before each writing."""

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the data into the function's own folder, at each write time."""
        raise NotImplementedError

    def fates(self, memory: Memory, fields: Sequence[FieldColumns]) -> Mapping[str, Column]:  # noqa: ARG002
        """Return columns of ``fates``, with a row for each row of the data; by default none.

        ``fields`` are the sampled fields of the flow.
        """
        return {}


class StepObserver:
    """Cloud function that observes particles around each call of the loop, while its flow is loaded."""

    def before_steps(self, memory: Memory, cloud: ObservedCloud, until: float) -> None:
        """Observe particles before steps from the time of the cloud ``until``, s."""

    def after_steps(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Observe particles after these steps; by default no-op."""


class ContactObserver:
    """Cloud function that records rebounds, and passages of coupled patches."""

    def needs_rebounds(self, interactions: Mapping[str, Interaction]) -> bool:
        """Return whether it records any, by the interactions of the patches; by default, coupled patches."""
        return any(interaction.code == CYCLIC for interaction in interactions.values())

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Record rebounds and passages, see :meth:`foamprb.cloud.cloud.Cloud.take_rebounds`.

        The next sample follows.
        """
        raise NotImplementedError


@dataclass(frozen=True)
class SampledFunction(CloudFunction):
    """A cloud function that compares each sample of a particle with the one before.

    Between two samples a particle is not observed, but the last sample is at its exact end.
    """

    arrays: ClassVar[Mapping[str, Kind]] = {"closed": per_particle, "t": per_particle}
    """Kinds of its arrays; those of :meth:`observe` and :meth:`initial` are added."""

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
        initial = self.initial(cloud)
        closed = np.zeros(p.size, dtype=bool)
        return {"closed": closed, "t": p.t.copy(), **self.observe(cloud, np.arange(p.size)), **initial}

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add a sample of the particles that move, or that have ended since the last one."""
        self._add(memory, cloud, ~memory["closed"] & (cloud.particles.status != Status.PENDING))

    def close(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add the last sample of the particles that have ended since the one before."""
        self._add(memory, cloud, ~memory["closed"] & has_ended(cloud, slice(None)))

    def _add(self, memory: Memory, cloud: ObservedCloud, mask: NDArray[np.bool_]) -> None:
        p, rows = cloud.particles, np.flatnonzero(mask)
        now = {**self.observe(cloud, rows), "t": p.t[rows]}
        self.add(memory, cloud, rows, now)
        store(memory, rows, {**now, "closed": has_ended(cloud, rows)})


def names_of_kind(function: CloudFunction, kind: Kind) -> list[str]:
    """Return the names of the arrays of a kind."""
    return [name for name, its_kind in function.arrays.items() if its_kind is kind]


def events_of(function: CloudFunction) -> str:
    """Return the name of its array ``per_event``; empty for none."""
    return next(iter(names_of_kind(function, per_event)), "")


def rows_of_particles(function: CloudFunction, memory: Memory) -> Memory:
    """Return the arrays with a row for each particle."""
    return {key: array for key, array in memory.items() if function.arrays[key] is per_particle}


def has_ended(cloud: ObservedCloud, rows: Rows | slice) -> NDArray[np.bool_]:
    """Return whether particles have ended and cannot move again."""
    return np.isin(cloud.particles.status[rows], cloud.cloud.tracker.movable, invert=True)


def passages(cloud: ObservedCloud, rows: NDArray[np.float64]) -> Iterator[tuple[Rebounds, Rebounds]]:
    """Yield the passages of coupled patches among records, see :func:`foamprb.cloud.contact.passages`."""
    return contact.passages(rows, [k for k, i in enumerate(cloud.cloud.interactions) if i.code == CYCLIC])


def appearing(cloud: ObservedCloud, until: float) -> Rows:
    """Return the pending particles that appear between the time of the cloud and ``until``, s."""
    p = cloud.particles
    return np.flatnonzero((p.status == Status.PENDING) & (p.t0 >= cloud.time) & (p.t0 <= until))


def fields_of(cloud: ObservedCloud, rows: Rows) -> Mapping[str, FieldValues]:
    """Return the sampled fields at particles at their times; NaN at pending ones."""
    p = cloud.particles.take(rows)
    hosts = np.where(p.status == Status.PENDING, np.int32(-1), p.host)
    return fields_at(cloud.cloud.flow, p.x, hosts, np.minimum(p.t, cloud.time))


def fields_at_release(
    cloud: ObservedCloud, rows: Rows, hosts: NDArray[np.int32]
) -> Mapping[str, FieldValues]:
    """Return the sampled fields where and when particles were released in their hosts."""
    p = cloud.particles
    return fields_at(cloud.cloud.flow, p.x0[rows], hosts, p.t0[rows])


def sums_of_cells(cloud: ObservedCloud, name: str, n: int) -> Iterator[tuple[slice, NDArray[np.float64]]]:
    """Yield parts of n cells in their order, and the rows of each of an array ``per_cell``."""
    for first in range(0, n, CELLS):
        part = slice(first, min(first + CELLS, n))
        yield part, np.concatenate(cloud.cloud.comm.call(_sums_of, f"{cloud._name}/{name}", part))


def _sums_of(rank: Rank, path: str, part: slice) -> NDArray[np.float64]:
    """Return the cell sums of a rank's part of a range."""
    first, sums = rank.sampling.sums[path]
    ends = first[rank.number : rank.number + 2]
    of_range: NDArray[np.float64] = sums[slice(*np.clip([part.start, part.stop], *ends) - ends[0])]
    return of_range


def map_where_they_move(
    cloud: ObservedCloud, numbers: Rows, function: Callable[..., Value], *arguments: Any
) -> list[Value]:
    """Apply a function to the cloud with the given particles, by rising numbers, that each rank owns."""
    return cloud.cloud.comm.call(_observe, numbers, function, cloud.time, *arguments)


def _observe(
    rank: Rank, numbers: Rows, function: Callable[..., Value], time: float, *arguments: Any
) -> Value:
    p = rank.particles.take(rank.find(numbers)[1])
    return function(rank.sampling.cloud(rank, p, time), *arguments)


def store(memory: Memory, rows: Rows, values: Memory) -> None:
    """Store values of the particles of some rows."""
    for name, array in values.items():
        memory[name][rows] = array


def memory_of(memory: Mapping[str, NDArray[Any]], name: str) -> Memory:
    """Return the arrays of one function from a dict by ``function/array``; all without a name."""
    prefix = f"{name}/" if name else ""
    return {key.removeprefix(prefix): array for key, array in memory.items() if key.startswith(prefix)}


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
    """Add events, (n, 3 + k), in their order to an array ``per_cell``, (n_cells, k); see :class:`Kind`."""
    cell = events[:, 2].astype(np.int64)
    for total, values in zip(sums.T, events[:, 3:].T, strict=True):
        np.add.at(total, cell, values)


def taylor_of(cloud: ObservedCloud, rows: Rows, F: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return Taylor's D of particles with the deformation gradients F, (n, 9)."""
    p = cloud.particles.take(rows)._replace(F=np.ascontiguousarray(F))
    return cloud.of(p).measure(np.arange(p.size), "taylorDeformation")[0]


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
