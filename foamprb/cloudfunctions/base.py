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
from typing import Any, ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import taylor_deformation
from foamprb.body.tensor import stretches_in_frame
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.communicator import Value
from foamprb.cloud.measures import MEASURES, PER_CONTEXT, Context, FlowSamples, as_slice, contexts
from foamprb.cloud.patches import CYCLIC, Interaction
from foamprb.cloud.paths import Steps, step, tensor_of
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.tracker import Tracker
from foamprb.compile.link import compiled
from foamprb.flow.base import Sampled
from foamprb.flow.fields import FieldColumns
from foamprb.flow.loaded import LoadedFlow
from foamprb.results.tables import Column

Rows: TypeAlias = NDArray[np.int64]
"""Row numbers of particles in their cloud."""
Memory: TypeAlias = dict[str, NDArray[Any]]
STATUS_NAMES = tuple(status.name.lower() for status in Status)


class Kind(Enum):
    """Kind of an array of a cloud function: meaning of its rows."""

    per_particle = "a row for each particle, which goes with the particle to the process that advances it"
    per_event = "a row for each event: number of the particle, time, and others; in the order of time"
    per_cell = "sums of each cell of the mesh, see :mod:`foamprb.cloudfunctions.cells`"
    table = "rows that only begin and write change"


per_particle, per_event, per_cell, table = Kind


class CloudShare(NamedTuple):
    """Properties of a cloud that functions use where some of its particles are, in place of the cloud."""

    interactions: Sequence[Interaction]
    flow: LoadedFlow
    medium: Medium
    tracker: Tracker
    time: float
    size: int
    """Number of particles of all processes, and of those that never appear."""


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
    add_to_cells: Callable[[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]], None] | None = None
    """Adds values, (columns, n), to the sums of cells, (n,), with their scales, (columns,); of steps only."""

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
        p, parts = self.particles, []
        for start in range(0, max(len(rows), 1), PER_CONTEXT):
            some = self.of(p.take(as_slice(rows[start : start + PER_CONTEXT])))
            parts.append(some.measure_in(self.cloud.flow, *values))
        return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]

    def measure_in(
        self, flow: Sampled | FlowSamples, *values: str | Callable[[Context], NDArray[Any]]
    ) -> list[NDArray[Any]]:
        """Return values of all observed particles in a flow, or in what it is where they are."""
        p = self.particles._replace(status=np.full_like(self.particles.status, Status.ACTIVE))
        functions = [MEASURES[value].value if isinstance(value, str) else value for value in values]
        parts = [
            [np.array(function(c)) for function in functions]
            for c in contexts(p, flow, self.cloud.medium.mu, self.time)
        ]
        return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]

    def map(self, function: Callable[..., Value], *arguments: object) -> Iterator[Value]:
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
    """Kinds of the arrays of its data."""

    @property
    def needed_fields(self) -> tuple[str, ...]:
        """Names of the fields of the case that it samples."""
        return ()

    def begin(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return the initial data; raise InputError if the cloud lacks a name in the entries."""
        return {}

    def needs_rebounds(self, interactions: Mapping[str, Interaction]) -> bool:  # noqa: ARG002
        """Return whether the cloud must record rebounds and passages, by the interactions of the patches."""
        return False

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the data into the function's own folder, after each write time."""
        raise NotImplementedError

    def fates(self, memory: Memory, fields: Sequence[FieldColumns]) -> Mapping[str, Column]:  # noqa: ARG002
        """Return columns of ``fates``, with a row for each row of the data; by default none.

        ``fields`` are the sampled fields of the flow.
        """
        return {}


class ContactObserver:
    """Cloud function that records rebounds, and passages of coupled patches."""

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Record rebounds and passages, see :meth:`foamprb.cloud.cloud.Cloud.take_rebounds`."""
        raise NotImplementedError


@dataclass(frozen=True)
class PathFunction(CloudFunction):
    """A cloud function that observes all steps of particles, see :class:`foamprb.cloud.paths.Steps`.

    A particle is observed up to the end of its last step. No step ends for it.
    """

    arrays: ClassVar[Mapping[str, Kind]] = {"t": per_particle}
    """Kinds of its arrays: the time to which each particle was observed; those of :meth:`initial` are added.
    """

    @property
    def needs(self) -> frozenset[str]:
        """What it reads of steps beside times and places, see :class:`foamprb.cloud.paths.StepRows`."""
        return frozenset()

    def watches(self, numbers: Rows, n: int) -> NDArray[np.bool_] | None:  # noqa: ARG002
        """Return which of some of n particles it observes, by their numbers; None for all."""
        return None

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return further data at the start: sums of zero and empty tables."""
        raise NotImplementedError

    def add(
        self, memory: Memory, cloud: ObservedCloud, steps: Steps, fresh: NDArray[np.bool_]
    ) -> NDArray[np.float64] | None:
        """Add the fresh ones, (n,), of some steps; return rows of its array ``per_event``, None for none.

        It changes its rows of these particles only, and sums of cells by ``cloud.add_to_cells``. Threads call
        it with different particles at the same time.
        """
        raise NotImplementedError

    def needs_rebounds(self, interactions: Mapping[str, Interaction]) -> bool:
        """Return whether there are coupled patches, at which a path is divided."""
        return any(interaction.code == CYCLIC for interaction in interactions.values())

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the times of the start, and the initial data."""
        return {"t": cloud.particles.t.copy(), **self.initial(cloud)}

    def follow(self, memory: Memory, cloud: ObservedCloud, steps: Steps) -> NDArray[np.float64] | None:
        """Add the steps that were not added before; return new rows of its array ``per_event``."""
        fresh = np.empty(steps.n, dtype=np.bool_)
        # After an interruption, particles take some steps again.
        compiled(_select_fresh)(steps.tables, memory["t"], fresh)
        return self.add(memory, cloud, steps, fresh)


def _select_fresh(tables: NDArray[np.float64], seen: NDArray[np.float64], fresh: NDArray[np.bool_]) -> None:
    """Tell which steps end after the time to which their particle was seen, which is then their end."""
    k = 0
    for table in tables:
        for i in range(table.shape[1]):
            t, row = table[step.t1, i], int(table[step.row, i])
            fresh[k] = row >= 0 and t > table[step.t0, i] and t > seen[row]
            if fresh[k]:
                seen[row] = t
            k += 1


def names_of_kind(function: CloudFunction, kind: Kind) -> list[str]:
    """Return the names of the arrays of a kind."""
    return [name for name, its_kind in function.arrays.items() if its_kind is kind]


def events_of(function: CloudFunction) -> str:
    """Return the name of its array ``per_event``; empty for none."""
    return next(iter(names_of_kind(function, per_event)), "")


def rows_of_particles(function: CloudFunction, memory: Memory) -> Memory:
    """Return the arrays with a row for each particle."""
    return {key: array for key, array in memory.items() if function.arrays[key] is per_particle}


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


def taylor_at_end(table: NDArray[np.float64], k: int) -> float:
    """Return Taylor's D at the end of step k of a table."""
    (a, b, c), _ = stretches_in_frame(tensor_of(table, step.F1, k), tensor_of(table, step.Q1, k))
    return taylor_deformation(max(a, b, c), min(a, b, c))  # type: ignore[no-any-return]


def masses(p: Particles, rows: Rows) -> NDArray[np.float64]:
    """Return masses, kg."""
    mass: NDArray[np.float64] = 4.0 / 3.0 * math.pi * p.rho[rows] * p.R[rows] ** 3
    return mass


def names_of(names: Sequence[str], codes: NDArray[np.generic]) -> list[str]:
    """Return the name of each code."""
    return [names[code] for code in codes.astype(np.int64)]


def columns(names: Sequence[str], array: NDArray[np.generic]) -> dict[str, Column]:
    """Return the columns of an array by their names."""
    return dict(zip(names, array.T, strict=True))
