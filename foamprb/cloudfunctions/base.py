"""What a run observes of its cloud: OpenFOAM's ``cloudFunctions``, and how a run calls them.

A cloud function is a frozen dataclass of its entries with three methods. What it remembers is a dict of
arrays that belongs to the run, so that a checkpoint can save it. A new function is one file with such a class
and a line in :mod:`foamprb.cloudfunctions.registry`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import MEASURES, PER_CONTEXT, Context, as_slice, contexts
from foamprb.cloud.state import Particles, Status
from foamprb.dictionary.constraints import Meaning
from foamprb.dictionary.schema import Schema
from foamprb.errors import InputError

__all__ = [
    "SAMPLE_INTERVAL",
    "STATUS_NAMES",
    "CloudFunction",
    "CloudFunctions",
    "Memory",
    "ObservedCloud",
    "Rows",
    "SeesRebounds",
    "wants_rebounds",
]

Rows: TypeAlias = NDArray[np.int64]
"""Row numbers of particles in their cloud."""
Memory: TypeAlias = dict[str, NDArray[Any]]
SAMPLE_INTERVAL = Meaning("steps between two samples")
STATUS_NAMES = tuple(status.name.lower() for status in Status)


@dataclass(frozen=True)
class ObservedCloud:
    """The cloud of a run as its functions observe it, with the names of injection models and patches."""

    cloud: Cloud
    injectors: tuple[str, ...]
    patches: tuple[str, ...]
    tables: str = "csv"
    """The kind of the tables that functions write, which is the ending of their files."""

    @property
    def particles(self) -> Particles:
        """The whole cloud, the pending included."""
        return self.cloud.particles

    @property
    def time(self) -> float:
        """Time to which the cloud has come, s."""
        return self.cloud.time

    def contexts(self, rows: Rows) -> Iterator[Context]:
        """Return what the measures of :mod:`foamprb.cloud.measures` need of particles, whatever their status.

        As :func:`foamprb.cloud.measures.contexts`, a few at a time.
        """
        for start in range(0, max(len(rows), 1), PER_CONTEXT):
            yield from self._contexts_of(self.particles.take(as_slice(rows[start : start + PER_CONTEXT])))

    def collect(self, rows: Rows, *values: Callable[[Context], NDArray[Any]]) -> list[NDArray[Any]]:
        """Return values of particles, whatever their status."""
        return _collect(self.contexts(rows), values)

    def collect_of(self, p: Particles, *values: Callable[[Context], NDArray[Any]]) -> list[NDArray[Any]]:
        """Return values of particles that need not be in the state in which the cloud has them."""
        return _collect(self._contexts_of(p), values)

    def _contexts_of(self, p: Particles) -> Iterator[Context]:
        p = p._replace(status=np.full_like(p.status, Status.ACTIVE))
        return contexts(p, self.cloud.flow, self.cloud.medium.mu, self.time)

    def measure(self, rows: Rows, *names: str) -> list[NDArray[Any]]:
        """Return some of :data:`foamprb.cloud.measures.MEASURES` of particles, whatever their status."""
        return self.collect(rows, *(MEASURES[name].value for name in names))


def _collect(
    found: Iterable[Context], values: Sequence[Callable[[Context], NDArray[Any]]]
) -> list[NDArray[Any]]:
    parts = [[np.array(value(c)) for value in values] for c in found]
    return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]


class CloudFunction(Schema, Protocol):
    """Something that is observed while the cloud moves.

    Between two samples a particle goes unobserved; where and when it ended is exact all the same.
    """

    @property
    def interval(self) -> int:
        """Tracking steps between two samples; 0 if the write times are enough."""

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return what is remembered at the start; InputError if the cloud lacks what the entries name."""

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Observe the cloud, at every ``interval``-th step and before each writing."""

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write what was observed into the function's own folder, at each write time."""


@runtime_checkable
class SeesRebounds(Protocol):
    """A cloud function that may want to know where and when particles bounce off."""

    def wants_rebounds(self, bouncing: Collection[str]) -> bool:
        """Whether it does, if they bounce off these patches."""

    def note_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Remember those of :meth:`foamprb.cloud.cloud.Cloud.take_rebounds` that count."""


def wants_rebounds(functions: Iterable[CloudFunction], bouncing: Collection[str]) -> bool:
    """Whether one of the functions wants rebounds to be noted, if particles bounce off these patches."""
    return any(isinstance(f, SeesRebounds) and f.wants_rebounds(bouncing) for f in functions)


class CloudFunctions:
    """The cloud functions of a run, and what they remember.

    Parameters
    ----------
    functions
        By their names.
    cloud
        The cloud at the start.

    Raises
    ------
    InputError
        If a function asks for what the cloud does not have.
    """

    def __init__(self, functions: Mapping[str, CloudFunction], cloud: ObservedCloud) -> None:
        self.functions = dict(functions)
        self._cloud = cloud
        self._memory: dict[str, Memory] = {}
        for name, function in self.functions.items():
            try:
                self._memory[name] = function.begin(cloud)
            except InputError as error:
                raise InputError(f"cloudFunctions/{name}: {error}") from error

    def next_sample(self, last: int) -> int:
        """Return the step, at most ``last``, to which the cloud may advance before the next sample."""
        step = self._cloud.cloud.step
        return min([last, *((step // n + 1) * n for f in self.functions.values() if (n := f.interval) > 0)])

    def sample(self) -> None:
        """Let those functions observe the cloud that do so at its present step."""
        step = self._cloud.cloud.step
        for name, function in self.functions.items():
            if function.interval and step % function.interval == 0:
                function.sample(self._memory[name], self._cloud)

    def write(self, folder: Path) -> None:
        """Let every function observe the cloud and write into a folder of its name."""
        self._note_rebounds()
        for name, function in self.functions.items():
            function.sample(self._memory[name], self._cloud)
            function.write(self._memory[name], self._cloud, folder / name)

    def state(self) -> Memory:
        """Return all that is remembered, by ``function/array``."""
        self._note_rebounds()
        return {f"{name}/{key}": array for name, m in self._memory.items() for key, array in m.items()}

    def _note_rebounds(self) -> None:
        if not self._cloud.cloud.models.rebounds:
            return
        rows = self._cloud.cloud.take_rebounds()
        for name, function in self.functions.items():
            if isinstance(function, SeesRebounds) and len(rows):
                function.note_rebounds(self._memory[name], self._cloud, rows)

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take over what :meth:`state` returned in an earlier run.

        Raises
        ------
        InputError
            If it was that of other functions.
        """
        expected, found = sorted(self.state()), sorted(state)
        if expected != found:
            changed = ", ".join(sorted({key.split("/")[0] for key in {*expected} ^ {*found}}))
            raise InputError(f"cloudFunctions: {changed} was not observed from the start, or no longer is.")
        for name, memory in self._memory.items():
            memory.update({key: state[f"{name}/{key}"].copy() for key in memory})
