"""Cloud functions on the ranks that hold the particles: each rank observes the steps of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import Medium
from foamprb.cloud.communicator import Rank
from foamprb.cloud.patches import Interaction
from foamprb.cloud.paths import Observation, Steps, step
from foamprb.cloud.state import Particles
from foamprb.cloudfunctions.base import (
    CloudFunction,
    CloudShare,
    Memory,
    ObservedCloud,
    PathFunction,
    events_of,
    memory_of,
    names_of_kind,
    per_cell,
    per_particle,
)
from foamprb.cloudfunctions.cells import add_up, no_sums


class Sampling:
    """Functions that observe the particles of a rank, with their events and sums of cells."""

    def __init__(
        self,
        functions: Mapping[str, CloudFunction],
        memory: Mapping[str, Memory],
        interactions: Sequence[Interaction],
        medium: Medium,
        names: Mapping[str, Sequence[str]],
        late: int,
    ) -> None:
        self.functions, self._initial = functions, memory
        self._interactions, self._medium, self._names = tuple(interactions), medium, names
        self._late = late
        self._events: dict[str, list[NDArray[np.float64]]] = {name: [] for name in functions}
        self._sums: dict[str, NDArray[np.int64]] = {}

    @staticmethod
    def install(rank: Rank, sampling: Sampling) -> None:
        """Observe the particles of a rank from now on."""
        rank.sampling = sampling

    def cloud(self, rank: Rank, p: Particles, time: float) -> ObservedCloud:
        """Return the cloud with some particles of a rank, as functions observe it at a time, s."""
        n = int(rank.firsts[-1]) + self._late
        share: Any = CloudShare(self._interactions, rank.seen, self._medium, rank.tracker, time, n)
        return ObservedCloud(share, self._names, _seen=p)

    def observers(self, rank: Rank, until: float) -> Observation | None:
        """Return the functions that observe the steps of a call of the loop, None for none.

        ``until`` is the time of its end, s.
        """
        following = {name: f for name, f in self.functions.items() if isinstance(f, PathFunction)}
        if not following:
            return None
        cloud, numbers = self.cloud(rank, rank.particles, until), rank.particles.number
        masks = [function.watches(numbers, cloud.cloud.size) for function in following.values()]
        watched = np.logical_or.reduce([np.ones(len(numbers)) if mask is None else mask for mask in masks])
        needs = frozenset[str]().union(*(function.needs for function in following.values()))
        each = []
        for name, function in following.items():
            adding = partial(self._add_to_cells, self._sums_of(rank, name, function), Lock())
            initial = {k: v for k, v in self._initial[name].items() if function.arrays[k] is not per_particle}
            memory = {**initial, **memory_of(rank.share.memory, name)}
            each.append((name, function, memory, replace(cloud, _name=name, add_to_cells=adding)))

        def observe(steps: Steps) -> None:
            if "l1" in needs:
                steps = _with_fluid(steps, rank.seen, rank.tracker.integrator.recorded.end_l < 0)
            for name, function, memory, seen in each:
                events = function.follow(memory, seen, steps)
                if events is not None and len(events):
                    self._events[name].append(events)

        return Observation(needs, watched, observe)

    def _sums_of(self, rank: Rank, name: str, function: CloudFunction) -> NDArray[np.int64]:
        """Return the sums of the cells of a rank that a function adds to; none without such an array."""
        if not names_of_kind(function, per_cell):
            return no_sums(0, 0)
        mesh = getattr(rank.flow, "mesh", rank.flow)
        columns = self._initial[name][names_of_kind(function, per_cell)[0]].shape[1] // 2
        if name not in self._sums:
            self._sums[name] = no_sums(len(mesh.cell_start) - 1, columns)
        return self._sums[name]

    @staticmethod
    def _add_to_cells(
        sums: NDArray[np.int64],
        lock: Any,
        cells: NDArray[np.int64],
        values: NDArray[np.float64],
        scale: NDArray[np.float64],
    ) -> None:
        with lock:
            add_up(sums, cells, values, scale)

    @staticmethod
    def take_events(rank: Rank) -> Memory:
        """Return the events that the functions have recorded on a rank since the last call."""
        sampling: Sampling = rank.sampling
        events, sampling._events = sampling._events, {name: [] for name in sampling.functions}
        return {
            name: np.concatenate([sampling._initial[name][table][:0], *events[name]])
            for name, function in sampling.functions.items()
            if (table := events_of(function))
        }

    @staticmethod
    def take_sums(rank: Rank) -> Memory:
        """Return the sums of cells on a rank since the last call, by the names of the functions."""
        sampling: Sampling = rank.sampling
        sums, sampling._sums = sampling._sums, {}
        return sums


def _with_fluid(steps: Steps, flow: Any, everywhere: bool) -> Steps:
    """Return steps with the fluid's gradient where they ended, if that is not where they led.

    With ``everywhere``, where every step ended.
    """
    (t0, t1), hosts = steps.t, steps.of(step.host1)
    rows = np.flatnonzero((everywhere | steps.ended) & (t1 > t0) & (hosts >= 0))
    if len(rows):
        l = flow.sample(steps.take(rows).x[1], hosts[rows], t1[rows])[1].reshape(-1, 9)
        m, k = np.divmod(rows, steps.tables.shape[2])
        steps.tables[m, step.l1 : step.l1 + 9, k] = l
    return steps
