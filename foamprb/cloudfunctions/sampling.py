"""Cloud functions on the ranks that hold the particles: each rank samples its own."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import Medium
from foamprb.cloud.communicator import Rank
from foamprb.cloud.patches import Interaction
from foamprb.cloud.state import Particles
from foamprb.cloudfunctions.base import (
    CloudFunction,
    CloudShare,
    ContactObserver,
    Memory,
    ObservedCloud,
    StepObserver,
    add_up,
    events_of,
    in_time,
    memory_of,
)

Observe: TypeAlias = Callable[[Any, Memory, ObservedCloud], None]
"""Lets a function observe particles: its data of them changes."""


class Sampling:
    """Functions that sample the particles of a rank, with their events and sums of cells.

    Parameters
    ----------
    functions
        The functions, by their names.
    events
        Empty tables of events, by the names of their functions.
    sums
        Sums without rows, by ``function/array``, and the number of cells.
    interactions, medium
        See :class:`foamprb.cloud.cloud.Cloud`.
    names
        See :class:`ObservedCloud`.
    """

    def __init__(
        self,
        functions: Mapping[str, CloudFunction],
        events: Memory,
        sums: Mapping[str, tuple[int, NDArray[Any]]],
        interactions: Sequence[Interaction],
        medium: Medium,
        names: Mapping[str, Sequence[str]],
    ) -> None:
        self.functions, self._no_events, self._no_sums = functions, events, sums
        self._interactions, self._medium, self._names = tuple(interactions), medium, names
        self._events: Memory = {}
        self.sums: dict[str, tuple[NDArray[np.int64], NDArray[np.float64]]] = {}
        """The first cell of each rank, and the sums of the cells of this one, by ``function/array``."""

    @staticmethod
    def install(rank: Rank, sampling: Sampling) -> None:
        """Sample the particles of a rank from now on."""
        firsts = rank.firsts
        for name, (n, array) in sampling._no_sums.items():
            # A rank without a part of a checkpoint has none.
            first = np.where(firsts == firsts[-1], n, firsts * n // max(firsts[-1], 1))
            first[0] = 0
            n_cells = int(first[rank.number + 1] - first[rank.number])
            sampling.sums[name] = first, np.zeros((n_cells, *array.shape[1:]))
        rank.sampling = sampling

    def cloud(self, rank: Rank, p: Particles, time: float) -> ObservedCloud:
        """Return the cloud with some particles of a rank, as functions observe it at a time, s."""
        share: Any = CloudShare(self._interactions, rank.seen, self._medium, rank.tracker, time)
        return ObservedCloud(share, self._names, _seen=p)

    def observe(self, rank: Rank, names: Iterable[str], time: float, observe: Observe) -> None:
        """Let some functions observe the particles of a rank at a time, s."""
        cloud = self.cloud(rank, rank.particles, time)
        for name in names:
            function, memory = self.functions[name], memory_of(rank.share.memory, name)
            table = events_of(function)
            if table:
                memory[table] = self._events.get(name, self._no_events[name])
            observe(function, memory, cloud)
            if table:
                self._events[name] = memory[table]

    def before_steps(self, rank: Rank, start: float, until: float) -> None:
        """Let the functions observe the particles before a call of the loop, while its flow is loaded."""
        observers = self._of_kind(StepObserver)
        self.observe(rank, observers, start, lambda f, memory, cloud: f.before_steps(memory, cloud, until))

    def after_steps(self, rank: Rank, until: float) -> None:
        """Let the functions observe the particles after a call of the loop."""
        observers = self._of_kind(StepObserver)
        self.observe(rank, observers, until, lambda f, memory, cloud: f.after_steps(memory, cloud))

    @staticmethod
    def sample(rank: Rank, names: Collection[str], time: float) -> None:
        """Let some functions sample the particles of a rank."""
        rank.sampling.observe(rank, names, time, lambda f, memory, cloud: f.sample(memory, cloud))
        rank.sampling.add_up(rank, names)

    @staticmethod
    def record(rank: Rank, rows: NDArray[np.float64], time: float) -> None:
        """Let the functions record rebounds and passages of the particles of a rank."""
        here, at = rank.find(rows[:, 0].astype(np.int64))
        local = np.column_stack([at, rows[here, 1:]])
        observers = rank.sampling._of_kind(ContactObserver)
        rank.sampling.observe(
            rank, observers, time, lambda f, memory, cloud: f.record_rebounds(memory, cloud, local)
        )

    @staticmethod
    def take_events(rank: Rank) -> Memory:
        """Return the events that the functions have recorded on a rank since the last call."""
        sampling: Sampling = rank.sampling
        events, sampling._events = {**sampling._no_events, **sampling._events}, {}
        return events

    def add_up(self, rank: Rank, names: Collection[str]) -> None:
        """Add the events of some functions to the sums of cells, each on the rank that has these."""
        for path, (first, sums) in self.sums.items():
            name = path.split("/")[0]
            if name not in names:
                continue
            events = self._events[name]
            received = rank.sent(np.searchsorted(first[1:], events[:, 2], side="right"), events)
            received[:, 2] -= first[rank.number]
            add_up(sums, in_time(received))
            self._events[name] = events[:0].copy()

    def _of_kind(self, kind: type) -> list[str]:
        return [name for name, function in self.functions.items() if isinstance(function, kind)]
