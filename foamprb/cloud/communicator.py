"""Access to the particles of a cloud, wherever they are: on this process, or on several ones.

A function is applied to the particles of each process (:meth:`Communicator.call`), and the results return.
:mod:`foamprb.distributed` has the communicator of several processes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.instants import PREFIX, Moments, hosts_at, ridden, state_at, status_at, store
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.paths import Observation
from foamprb.cloud.state import Particles, Status, concatenate, empty
from foamprb.cloud.tracker import Outcome, Tracker
from foamprb.flow.base import Flow
from foamprb.flow.loaded import LoadedFlow, loaded_fields

Value = TypeVar("Value")
Arrays = Mapping[str, NDArray[Any]]
PART = 1 << 14
"""Particles in a block of :meth:`Communicator.map_by_id`."""


class Share(NamedTuple):
    """Particles, and the arrays that cloud functions store of them, by ``function/array``."""

    particles: Particles
    memory: Arrays = MappingProxyType({})

    @classmethod
    def of(cls, arrays: Arrays) -> Share:
        """Return the particles of some arrays by their names in a record."""
        memory = dict(arrays)
        return cls(Particles(*(memory.pop(name) for name in Particles._fields)), memory)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return all arrays by their names in a record."""
        return {**self.particles._asdict(), **self.memory}

    def take(self, rows: Any) -> Share:
        """Return the particles of some rows."""
        memory = {name: array[rows] for name, array in self.memory.items()}
        return Share(self.particles.take(rows), memory)

    def apply(self, function: Callable[..., Value], of: str | None, *arguments: object) -> Value:
        """Apply a function to the particles and, with a name ``of`` a cloud function, to its arrays.

        An empty name stands for the arrays of all cloud functions, by ``function/array``.
        """
        if of is None:
            return function(self.particles, *arguments)
        prefix = f"{of}/" if of else ""
        memory = {k.removeprefix(prefix): array for k, array in self.memory.items() if k.startswith(prefix)}
        return function(self.particles, memory, *arguments)


class Rank:
    """Process with its share of the particles; this one has all, in the order of their numbers."""

    number = 0
    tracker: Tracker
    threads: int

    def __init__(self) -> None:
        self.share = Share(empty(0))
        self.sampling: Any = None
        """Cloud functions here, see :class:`foamprb.cloudfunctions.sampling.Sampling`."""
        self.flow: Any = None
        """Arguments of the flow's kernels."""
        self.sampled: Any = None
        """Fields of the flow that are sampled."""
        self.moments = Moments()
        """Instants at which the next steps store the state."""

    @property
    def particles(self) -> Particles:
        """Particles of this process."""
        return self.share.particles

    @property
    def firsts(self) -> NDArray[np.int64]:
        """Number of the first particle that each process writes to checkpoints, and of all particles."""
        return np.array([0, self.particles.size])

    @property
    def seen(self) -> LoadedFlow:
        """The flow around the particles, at the loaded times."""
        return LoadedFlow(self.tracker.kernels, self.flow, self.sampled)

    def find(self, numbers: NDArray[np.int64]) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
        """Return which of the given particles this rank owns, and the rows of these."""
        return np.ones(len(numbers), dtype=bool), numbers

    def at_instant(self, time: float, in_flow: bool, now: Particles | None = None) -> Particles:
        """Return the particles at an instant of the last steps, s; at any other time, as they are.

        ``in_flow`` tells whether they are needed with their hosts. ``now`` is a copy of the particles.
        """
        p, moments = self.particles if now is None else now, self.moments
        if time not in moments.times:
            return ridden(self.tracker.kernels, self.flow, p, time)
        then = state_at(p, self.share.memory, moments.times.index(time), moments)
        then = ridden(self.tracker.kernels, self.flow, then, time)
        if not in_flow:
            return then
        hosts = hosts_at(self.tracker.kernels, self.flow, p, then)
        return then._replace(host=hosts.astype(p.host.dtype))

    def advance(self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool]) -> Outcome:
        """Advance the particles by some steps in the loaded flow."""
        until = self.tracker.start + (step + steps) * self.tracker.dt
        observation = (self.sampling and self.sampling.observers(self, until)) or Observation()
        if self.moments.times:
            storing = partial(store, self.moments, self.share.memory)
            observation = observation._replace(**self.moments._asdict(), store=storing)
        arguments = self.flow, self.particles, step, steps, self.threads, bounds, stop, self.sampled
        return self.tracker.advance(*arguments, observation)


class Communicator:
    """Ranks that hold the particles of a cloud; here there is one, this process."""

    size = 1
    """Number of ranks."""
    threads: int | None = None
    """Number of threads of each rank; by default all processors."""
    signals: Sequence[int] = ()
    """Signals that any rank has received."""
    parts: tuple[int, ...] = ()
    """Number of the first particle of each part of a checkpoint, if several ranks write parts."""

    def __init__(self) -> None:
        self.rank = Rank()

    @property
    def n_particles(self) -> int:
        """Number of particles of all ranks."""
        return self.rank.particles.size

    def call(self, function: Callable[..., Value], *arguments: object) -> list[Value]:
        """Return the results of a function of a :class:`Rank` and the arguments on each rank."""
        return [function(self.rank, *arguments)]

    def place(self, size: int, parts: Callable[..., Iterable[Particles]], n_times: int = 0) -> Particles:  # noqa: ARG002
        """Give each rank its particles; return this rank's.

        Parameters
        ----------
        size
            Number of particles.
        parts
            Returns the particles in the order of their numbers, at most as many together as its argument.
        n_times
            Number of relaxation times of their solid.
        """
        return concatenate(parts())

    def adopt(self, p: Particles) -> None:
        """Take the particles that :meth:`place` returned, or others on one process, and number them."""
        p.number[:] = np.arange(p.size)
        self.rank.share = Share(p)

    def map_by_id(
        self, function: Callable[..., Value], *arguments: object, of: str | None = None
    ) -> Iterator[Value]:
        """Apply a function to blocks of particles sorted by number, at least one; see :meth:`Share.apply`."""
        share = self.rank.share
        blocks = parts_of(share.particles.size)
        return (share.take(rows).apply(function, of, *arguments) for rows in blocks)

    def store(self, layout: Arrays, first: Callable[[Particles], Arrays]) -> None:
        """Add arrays of a cloud function with a row for each particle.

        Parameters
        ----------
        layout
            The arrays without rows, by ``function/array``.
        first
            Returns the first rows of some particles.
        """
        self.call(add_arrays, layout)
        for p in self.map_by_id(same):
            self.put(p.number, first(p))

    def put(self, numbers: NDArray[np.int64], arrays: Arrays) -> None:
        """Store rows of arrays of particles of consecutive numbers."""
        stored = self.rank.share.arrays()
        for name, array in arrays.items():
            stored[name][numbers] = array

    def arrays_here(self) -> Arrays:
        """Return the arrays of cloud functions that the first rank writes to checkpoints."""
        return self.rank.share.memory

    def prepare_steps(self, cloud: Any) -> None:
        """Prepare the ranks for the steps of a :class:`~foamprb.cloud.cloud.Cloud`."""
        self.rank.tracker, self.rank.threads = cloud.tracker, cloud.threads
        self.rank.share = self.rank.share._replace(particles=cloud.particles)

    def publish(self, arrays: Any, flow: Flow) -> None:
        """Give all ranks the arguments of a flow's kernels, and its fields that are sampled."""
        self.rank.flow, self.rank.sampled = arrays, loaded_fields(flow)

    def advance(self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool]) -> Outcome:
        """Advance all particles by some steps in the flow that was published."""
        return self.rank.advance(step, steps, bounds, stop)

    def counts(self) -> dict[Status, int]:
        """Return the number of particles of each status."""
        return self.rank.particles.counts()

    def piece_files(self, stem: Any) -> tuple[Any, ...]:  # noqa: ARG002
        """Return the files of a snapshot that several ranks write; none on one rank."""
        return ()

    def write_pieces(self, stem: Any, *options: Any) -> Callable[[], Any]:
        """Let all ranks write a piece of a snapshot; return a function that lists these in a file."""
        raise NotImplementedError

    def write_parts(self, file: Any, time: float) -> list[tuple[int, str]]:  # noqa: ARG002
        """Let all ranks write their part of a checkpoint; return first numbers and checksums of the parts.

        On one rank there are none: the checkpoint has the particles.
        """
        return []


def applied(rank: Rank, function: Callable[..., Value], of: str | None, *arguments: object) -> Value:
    """Apply a function to the particles of a rank; see :meth:`Share.apply`."""
    return rank.share.apply(function, of, *arguments)


def particles_of(rank: Rank, numbers: NDArray[np.int64]) -> Particles:
    """Return the requested particles that a rank holds."""
    return rank.particles.take(rank.find(numbers)[1])


def values_of(rank: Rank, numbers: NDArray[np.int64], name: str) -> tuple[NDArray[Any], ...]:
    """Return the requested particles that a rank holds, and their values of an array."""
    rows = rank.find(numbers)[1]
    return rank.particles.number[rows], getattr(rank.particles, name)[rows]


def in_flow(rank: Rank, function: Callable[..., Value], time: float, *arguments: object) -> Value:
    """Apply a function to the particles of a rank, the flow around them, the time, and the arguments."""
    return function(rank.particles, rank.seen, time, *arguments)


def normals_at(rank: Rank, numbers: NDArray[np.int64]) -> tuple[NDArray[Any], ...]:
    """Return the requested particles that a rank holds, and the normals of the walls where they ended."""
    rows = rank.find(numbers)[1]
    return rank.particles.number[rows], rank.tracker.contact_normals(rank.flow, rank.particles, rows)


def take_rebounds(rank: Rank) -> NDArray[np.float64]:
    """Return the rebounds on a rank since the last call."""
    return rank.tracker.take_rebounds()


def store_at(rank: Rank, moments: Moments) -> None:
    """Let the next steps of a rank store the state at some instants; those of the same are kept."""
    if moments == rank.moments:
        return
    memory = {name: array for name, array in rank.share.memory.items() if not name.startswith(PREFIX)}
    rank.moments, rank.share = moments, rank.share._replace(memory=memory)
    if moments.times:
        add_arrays(rank, moments.layout())


def count_at(rank: Rank, time: float) -> NDArray[np.int64]:
    """Return the number of particles of each status on a rank, see :meth:`Rank.at_instant`."""
    p, moments = rank.particles, rank.moments
    if time in moments.times:
        status = status_at(p, rank.share.memory, moments.times.index(time), moments)[1]
    else:
        status = p.status
    return np.bincount(status, minlength=len(Status))


def add_arrays(rank: Rank, layout: Arrays) -> None:
    """Add arrays of cloud functions for the particles of a rank, given without rows."""
    n = rank.particles.size
    more = {name: np.zeros((n, *array.shape[1:]), dtype=array.dtype) for name, array in layout.items()}
    rank.share = rank.share._replace(memory={**rank.share.memory, **more})


def parts_of(n: int) -> Iterator[slice]:
    """Yield the rows of each block of n particles; once without particles."""
    return (slice(start, start + PART) for start in range(0, max(n, 1), PART))


def same(p: Particles) -> Particles:
    """Return the particles themselves, for :meth:`Communicator.map_by_id`."""
    return p
