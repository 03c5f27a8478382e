"""Who carries the particles of a cloud through their steps: by default the threads of this process."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from foamprb.cloud.motion import longest_of
from foamprb.cloud.state import Particles, Status
from foamprb.compile.link import link

if TYPE_CHECKING:
    from foamprb.cloud.cloud import Cloud

__all__ = ["Executor", "Threads", "available_threads", "longest_semi_axis"]


def available_threads() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


AT_ONCE = 20_000_000
"""Steps of a particle that threads take in some seconds; to take up its state and put it down costs a few."""


class Executor(Protocol):
    """Who carries the particles of a cloud through their steps, and knows the state of each until asked."""

    at_once: int
    """Number of steps of a particle that it takes in a second or so."""

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled."""

    def begin(self, prepare: Callable[[], tuple[Any, int]]) -> None:
        """Begin with steps while the cloud's arrays stay as they are or are gathered, if that can be done.

        ``prepare`` gives what the flow's kernels read, and the number of steps. The next :meth:`advance`
        takes these steps if it asks for as many; else they are as if they had never been begun.
        """

    def advance(self, flow: Any, steps: int) -> int:
        """Take steps with what the flow's kernels read; return the number of walks mended by the tree."""

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status."""

    def longest(self) -> float:
        """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""

    def gather(self) -> None:
        """Put the state of every particle into the cloud's arrays."""


class Threads:
    """The executor of a cloud by itself: the threads of this process, in the cloud's own arrays."""

    at_once = AT_ONCE

    def __init__(self, cloud: Cloud) -> None:
        self._cloud = cloud

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled."""
        return self._cloud.tracker.compiled

    def begin(self, prepare: Callable[[], tuple[Any, int]]) -> None:
        """They would take the time from what is done meanwhile."""

    def advance(self, flow: Any, steps: int) -> int:
        """Take steps in the cloud's arrays; return the number of walks mended by the tree."""
        cloud = self._cloud
        return cloud.tracker.advance(flow, cloud.particles, cloud.step, steps, cloud.threads)

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status."""
        return self._cloud.particles.counts()

    def longest(self) -> float:
        """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""
        return longest_semi_axis(self._cloud.particles)

    def gather(self) -> None:
        """They are there."""


def longest_semi_axis(p: Particles) -> float:
    """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""
    return float(link(longest_of)(p))
