"""Who carries the particles of a cloud through their steps: by default the threads of this process."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import gradients
from foamprb.cloud.motion import longest_of
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.tracker import Outcome, never
from foamprb.compile.helper import available_threads
from foamprb.compile.link import link

if TYPE_CHECKING:
    from pathlib import Path

    from foamprb.cloud.cloud import Cloud, Snapshot
    from foamprb.results.pvd import Series

__all__ = ["Executor", "Threads", "longest_semi_axis"]


class Executor(ABC):
    """Carries the particles of a cloud through their steps, and writes them.

    :meth:`foamprb.cloud.cloud.Cloud.hand_over` gives a cloud to an executor. From then on the executor knows
    the state of each particle, and the cloud's arrays may be behind until :meth:`gather`. What stands here is
    for executors that leave the particles in the cloud's arrays.
    """

    at_once: int = 200_000_000
    """Largest number of steps of one particle in a call of :meth:`advance`; it takes about a minute."""
    precompiles: bool = False
    """Whether another process may compile the loop for it before it is wanted."""
    signals: Sequence[int] = ()
    """Signals, Ctrl-C for one, that other processes than this have received."""
    _cloud: Cloud

    def take(self, cloud: Cloud) -> None:
        """Take over the particles of a cloud that is ready to be advanced."""
        self._cloud = cloud

    @property
    def threads(self) -> int:
        """Number of threads that each of its processes has for particles, unless the user says otherwise."""
        return available_threads()

    @property
    @abstractmethod
    def compiled(self) -> bool:
        """Whether the loop is compiled."""

    @abstractmethod
    def advance(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:
        """Take steps with what the flow's kernels read.

        Parameters
        ----------
        flow, stop
            See :meth:`foamprb.cloud.tracker.Tracker.advance`.
        steps
            Their number.
        """

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status."""
        return self._cloud.particles.counts()

    @abstractmethod
    def longest(self) -> float:
        """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""

    def gather(self) -> None:  # noqa: B027
        """Put the state of every particle into the cloud's arrays."""

    def take_rebounds(self) -> NDArray[np.float64]:
        """The rebounds since it was last asked, as :meth:`~foamprb.cloud.cloud.Cloud.take_rebounds` has."""
        return self._cloud.tracker.take_rebounds()

    def snapshot_files(self, stem: Path) -> tuple[Path, ...]:
        """The files that :meth:`begin_write` may write for a snapshot.

        Parameters
        ----------
        stem
            The snapshot's file without its ending.
        """
        from foamprb.results.pvd import with_ending

        return (with_ending(stem, ".vtp"),)

    def begin_write(
        self, series: Series, snapshot: Snapshot, names: Mapping[str, Sequence[str]]
    ) -> Callable[[], object]:
        """Begin to write a snapshot of the cloud as it is now, and to list it in a series.

        Parameters
        ----------
        series
            The series of files; the snapshot is later than those that it lists.
        snapshot
            Made after :meth:`gather`.
        names
            For each array of codes, what the codes 0, 1, … mean.

        Returns
        -------
        What ends that; another thread may call it while this one advances the cloud.

        Raises
        ------
        OSError
            If a file cannot be written; what is returned raises it, too.
        """
        # Whoever only compiles need not load VTK.
        from foamprb.cloud.report import report

        p, flow, mu, time = snapshot.particles, snapshot.flow, self._cloud.medium.mu, snapshot.time
        # By then another flow than a steady one may have gone on to other times.
        seen = flow if flow.span == (-np.inf, np.inf) else gradients(p, flow, time)
        return lambda: series.append(report(p, seen, mu, time, names))


class Threads(Executor):
    """The threads of this process, as many as the cloud says, in the cloud's own arrays."""

    precompiles = True

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled."""
        return self._cloud.tracker.compiled

    def advance(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:
        """Take steps in the cloud's arrays."""
        cloud = self._cloud
        return cloud.tracker.advance(
            flow, cloud.particles, cloud.step, steps, cloud.threads, cloud.bounds, stop
        )

    def longest(self) -> float:
        """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""
        return longest_semi_axis(self._cloud.particles)


def longest_semi_axis(p: Particles) -> float:
    """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""
    return float(link(longest_of)(p))
