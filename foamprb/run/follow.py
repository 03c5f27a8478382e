"""Flow of a case whose solver is running: waits for the times that a run needs next."""

from __future__ import annotations

import logging
import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.tracker import never
from foamprb.errors import InputError, RunInterrupted, RunStopped
from foamprb.flow.base import Flow
from foamprb.flow.read.density import may_vary
from foamprb.flow.read.flows import open_case
from foamprb.flow.read.follow import FollowedCase
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.flow.series import SeriesFlow
from foamprb.results.folder import ResultsFolder
from foamprb.run.restart import require_choice
from foamprb.settings.solution import StartFrom

log = logging.getLogger("foamprb")

_ROUND_OFF = 1e-9
_PAUSE, _LONG_PAUSE, _SHARE = 0.1, 1.0, 0.02
"""Shortest and longest time between two looks at the case, s; and its share of the time waited so far."""
_FIRST_LINE, _LONGEST = 5.0, 3600.0
"""Wait before the first line in the log, s; the time between lines doubles, up to the longest."""
_BEFORE_START = "stopped before the first step."


@dataclass(frozen=True)
class Follow:
    """Options of a run beside a running solver."""

    start_from: StartFrom | None = None
    """See :func:`foamprb.run.loop.execute`."""
    patience: float = math.inf
    """Time without a new time of the flow after which the run stops, s."""


class Following:
    """Flow of a case whose solver is running.

    Parameters
    ----------
    case
        The complete times of the case.
    flow
        The flow at these times.
    lag
        Number of times at the end that only serve the rates of change before them.
    patience
        See :class:`Follow`.
    signal
        Called several times a second while the run waits; returns a signal that ends the wait, 0 for none.
    """

    def __init__(
        self, case: FollowedCase, flow: SeriesFlow, lag: int, patience: float, signal: Callable[[], int]
    ) -> None:
        self.flow = flow
        self._case, self._lag, self._patience, self._signal = case, lag, patience, signal
        self._checked = 0
        self.ended = False
        """Whether the flow has all times that its solver writes."""
        self.reason = ""
        """Why the last wait ended, if not by ``stop``; the end of a sentence."""
        self._extend()

    def wait_until(self, t: float, purpose: str) -> None:
        """Wait until the flow covers a time before the run.

        Raises
        ------
        RunStopped
            The solver has written no time for too long, or a signal ended the wait.
        """
        if not self._wait(lambda: self.flow.span[1] >= t, never, f"the flow until {t:.12g} s, {purpose}"):
            raise RunInterrupted(_BEFORE_START, self._signal())

    def wait(self, cloud: Cloud, stop: Callable[[], bool]) -> bool:
        """Wait until the flow covers the next step of a cloud, or ends.

        Returns
        -------
        False if ``stop`` returned True, or the solver has written no time for too long.
        """

        def covered() -> bool:
            return cloud.steps_until(self.flow.span[1]) > cloud.step

        try:
            what = f"a time of the flow after {self.flow.span[1]:.12g} s"
            return covered() or self._wait(covered, stop, what)
        except RunStopped as error:
            self.reason = f": {error}"
            return False

    def require_unchanged(self, t: float) -> None:
        """Raise InputError if times since the last call were written again; the run has come to t, s."""
        self._case.require_unchanged(self._case.times[self._checked :])
        self._checked = max(0, len(self.flow.times_until(t)) - 2)

    def report_end(self, end: float) -> None:
        """Warn if the flow ends before the end time of a run, s."""
        last = self.flow.span[1]
        if self.ended and last < end * (1.0 - _ROUND_OFF):
            log.warning(
                "the solver has ended at %.12g s, before endTime, %.12g s: the run ends there.", last, end
            )

    def _wait(self, ready: Callable[[], bool], stop: Callable[[], bool], what: str) -> bool:
        def extended() -> bool:
            self._extend()
            return ready()

        return wait(self._case, extended, lambda: stop() or self._signal() > 0, self._patience, what)

    def _extend(self) -> None:
        # In this order: another thread may add the last time meanwhile.
        ended, names = self._case.ended, tuple(self._case.times)
        usable = len(names) - (0 if ended else self._lag)
        if usable != len(self.flow.times):
            self.flow.extend(names, usable)
        self.ended = ended


def begin_to_follow(
    case: Path,
    folder: ResultsFolder,
    options: Follow,
    selection: str | None,
    source: FlowSource,
    read: Callable[[Path, FlowTimes, FlowSource], Flow],
    signal: Callable[[], int] = lambda: 0,
) -> Following:
    """Wait for the first times of a case whose solver is running, and return its flow.

    Parameters
    ----------
    case, source
        The case, and the fields to read.
    folder
        Folder of the results.
    options
        Options of the run.
    selection
        Range of times.
    read
        Returns the flow at the times until now.
    signal
        See :class:`Following`.

    Raises
    ------
    InputError
        The solver ends before its second time; or see
        :class:`FollowedCase` and :func:`foamprb.flow.read.flows.read_transient_flow`.
    RunStopped
        The solver has written no time for too long, or a signal ended the wait.
    """
    if source.file is not None:
        raise InputError(f"{source.file}: -follow goes with a case of OpenFOAM, not with a mesh file.")
    require_choice(folder, options.start_from)
    followed = FollowedCase(case, selection, source.region, source.decomposed)

    def wait_for(n: int) -> None:
        what = "the first times of the flow"
        ready, stop = (lambda: len(followed.times) >= n), (lambda: signal() > 0)
        if not wait(followed, ready, stop, options.patience, what):
            raise RunInterrupted(_BEFORE_START, signal())

    lag = 0
    wait_for(2)
    if len(followed.times) > 1:
        source = replace(source, decomposed=followed.decomposed)
        opened = open_case(case, source)
        lag = int(may_vary(opened.root, opened.region, partial(opened.field, followed.times[-1])))
        wait_for(2 + lag)
    if len(followed.times) < 2:
        raise InputError(
            f"{case}: the solver has ended (system/controlDict) with {len(followed.times)} time of the "
            "flow in the selected range. Allowed: two or more."
        )
    damaged = open_case(case, source).damaged(followed.times, source.velocity)
    if damaged:
        time, fault = next(iter(damaged.items()))
        raise InputError(
            f"{case}: -follow goes through all times, but {source.velocity} at {time} is {fault}."
        )
    times = FlowTimes(f"{followed.times[0]}:{followed.times[-1]}", transient=True)
    flow: Any = read(case, times, source)
    return Following(followed, flow, lag, options.patience, signal)


def wait(
    case: FollowedCase, ready: Callable[[], bool], stop: Callable[[], bool], patience: float, what: str
) -> bool:
    """Wait until a condition holds or the solver has ended; return False if ``stop`` returned True before.

    Parameters
    ----------
    case
        The case of the solver.
    ready
        The condition, which is evaluated after each look at the case.
    stop
        Called several times a second.
    patience
        Time without a new time of the flow after which a wait ends, s.
    what
        What is missing, for the log.

    Raises
    ------
    RunStopped
        The solver has written no time for too long.
    """
    started, next_line, n_times = clock.monotonic(), _FIRST_LINE, -1
    while True:
        case.look()
        if ready() or case.ended:
            if next_line > _FIRST_LINE:
                log.info("The flow has come to %s s", case.times[-1] if case.times else "no time")
            return True
        if stop():
            return False
        if len(case.times) != n_times:
            n_times, started, next_line = len(case.times), clock.monotonic(), _FIRST_LINE
        waited = clock.monotonic() - started
        if waited > patience:
            raise RunStopped(f"no new time of the flow for {patience:g} s (-patience)")
        if waited > next_line:
            log.info("Waiting for %s", what)
            next_line += min(next_line, _LONGEST)
        clock.sleep(min(_LONG_PAUSE, max(_PAUSE, _SHARE * waited)))
