"""The time loop: begin, advance, write, end."""

from __future__ import annotations

import logging
import math
import time as clock
from collections.abc import Callable, Iterator
from contextlib import nullcontext

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Stepper, explain
from foamprb.cloud.state import Particles, Reason, Status
from foamprb.cloud.tracker import never
from foamprb.distributed.launch import caught_signals
from foamprb.errors import RunInterrupted, RunStopped
from foamprb.results.folder import FAILURES
from foamprb.run.compilation import Compilation, compile_run
from foamprb.run.job import Job
from foamprb.run.log import RunLog, progress_bar
from foamprb.run.points import points_of
from foamprb.run.results import HOW_TO_GO_ON, Results, open_results
from foamprb.settings.solution import StartFrom

log = logging.getLogger("foamprb")


def execute(
    job: Job,
    start_from: StartFrom | None = None,
    stop: Callable[[], bool] = lambda: False,
) -> dict[Status, int]:
    """Advance a cloud to the end time, or until no particle moves, and write its results.

    No step ends for a write time: the particles advance to the end of their stretch of steps, and their state
    at the write times within it is stored on the way. A checkpoint of the end of the stretch is written after
    the results. The particles advance while the files are written, until the next are due. Whatever ends a
    run, another one started from ``latestTime`` ends with the same state and the same files, bit for bit, as
    an uninterrupted run.

    Parameters
    ----------
    job
        A cloud that has not been advanced.
    start_from
        ``"startTime"`` to start over, in place of an old run; ``"latestTime"`` to continue from the last
        checkpoint, if there is one. By default, the entry of the settings. Without it, a run starts over, but
        not in place of an unfinished one.
    stop
        Called several times a second; True to write a checkpoint and end the run.

    Returns
    -------
    Number of particles of each status.

    Raises
    ------
    InputError
        If the run cannot continue from its checkpoints, or the user must decide whether it shall; if another
        run writes to the same folder.
    RunStopped
        If ``stop`` returned True, too many particles failed, or results could not be written.
    """
    cloud = job.cloud
    compile_run(cloud, job.compilation)
    # Before a checkpoint is read: the bodies are where they are released.
    points = points_of(job) if job.settings.solution.tracers else None
    if points is not None:
        compile_run(points, job.compilation)
    with open_results(job) as results:
        results.begin(start_from or job.settings.solution.startFrom)
        if results.finished:
            return cloud.counts()
        run_log = RunLog(job)
        results.write_start()
        schedule = _Schedule(Stepper(cloud), job.compilation, results.store_between)
        run_log.begin()
        with progress_bar(cloud.start, job.settings.solution.endTime) as show:
            for steps in _advance_to_writes(job, results, schedule, stop, show):
                counts = {time: cloud.counts_at(time) for time in map(cloud.time_of, steps)}
                results.write(steps)
                run_log.write_times(counts)
        failing = _failing(job)
        points = None if failing else points
        if points is not None:
            log.info("Following %d points of the fluid\n", points.size)
            follow(points, job, stop)
        results.end(run_log.warnings_at_end(), points)
        run_log.end(finished=not failing, points=points)
    if failing:
        raise RunStopped(f"{failing} The results until then are in {job.folder.path}.")
    return cloud.counts()


def follow(cloud: Cloud, job: Job, stop: Callable[[], bool] = never) -> None:
    """Advance another cloud to the end of a run; RunStopped if ``stop`` returned True."""
    schedule = _Schedule(Stepper(cloud), job.compilation, lambda _first, _last: None)
    while cloud.step < job.steps and moving(cloud):
        if stop():
            raise RunStopped(f"stopped at t = {cloud.time:.12g} s of the tracers. {HOW_TO_GO_ON}")
        schedule.advance(job.steps, stop)


def execute_until_signal(job: Job, start_from: StartFrom | None = None) -> None:
    """Execute a job as :func:`execute`; Ctrl-C or SIGTERM to any of its processes stops it in order.

    Raise RunInterrupted if a signal stopped the run; see :func:`execute` for other errors.
    """
    # Until the loop is compiled, signals act at once.
    comm = job.cloud.comm
    if comm.size == 1:
        compile_run(job.cloud, job.compilation)
    with caught_signals() as caught:
        try:
            execute(job, start_from, lambda: bool(caught or comm.signals))
        except RunStopped as stopped:
            signals = [*caught, *comm.signals]
            if not signals:
                raise
            raise RunInterrupted(str(stopped), signals[0]) from stopped


def _failing(job: Job) -> str:
    """Return a sentence if too many particles have failed; empty if not."""
    counts, most = job.cloud.counts(), job.settings.solution.maxFailedFraction
    injected = sum(counts.values()) - counts[Status.PENDING]
    if counts[Status.FAILED] <= most * injected:
        return ""
    cloud, numbers = job.cloud, np.sum(job.cloud.map_ranks(_reasons_of), axis=0)
    why = explain(int(np.argmax(numbers)), cloud.models, cloud.limits)
    return (
        f"{counts[Status.FAILED]} of {injected} particles have failed at t = {cloud.time:.12g} s, more than "
        f"maxFailedFraction {most:g} allows; {np.max(numbers)} of them: {why}. {job.folder.table(FAILURES)} "
        "lists all."
    )


def _reasons_of(p: Particles) -> NDArray[np.int64]:
    """Return the number of failed particles for each reason."""
    return np.bincount(p.reason[p.status == Status.FAILED], minlength=len(Reason))


def moving(cloud: Cloud) -> int:
    """Return the number of particles that are pending, active, or stuck for a time."""
    counts = cloud.counts()
    return sum(counts[status] for status in cloud.tracker.movable)


def _advance_to_writes(
    job: Job,
    results: Results,
    schedule: _Schedule,
    stop: Callable[[], bool],
    show: Callable[[float], None],
) -> Iterator[list[int]]:
    """Advance to the end of the run; pause after each stretch of steps with a write time.

    Yields
    ------
    The steps that end at the write times until there.
    """
    cloud = job.cloud
    while cloud.step < job.steps and (cloud.step == 0 or moving(cloud)) and not _failing(job):
        first = cloud.step
        due = job.next_write(first)
        while cloud.step < due and moving(cloud):
            results.check()
            if stop():
                results.save()
                raise RunStopped(f"stopped at t = {cloud.time:.12g} s. {HOW_TO_GO_ON}")
            schedule.advance(min(job.steps, -(-due // cloud.stretch_steps) * cloud.stretch_steps), stop)
            show(cloud.time)
        if not moving(cloud):
            # Later results would repeat those after the last end.
            cloud.step = job.next_write(max(first, cloud.steps_before(cloud.last_end)))
        yield job.writes(first, cloud.step)


MOST_STEPS = 200_000_000
"""Maximum particle-steps per call of the stepper; they take about a minute."""
_FIRST_CALL = 1 / 800
"""Share of it in the first call: some tenths of a second."""
_CALL = 2.0
"""Intended duration of a call, s."""
_FEW, _LONG = 100, 30.0
"""Minimum steps per call, if it takes less than 30 s."""
_SLOWER, _FASTER = 0.1, 4.0


class _Schedule:
    """Number of steps per call of the stepper, large enough that loading and storing particles is cheap."""

    def __init__(
        self, stepper: Stepper, compilation: Compilation, prepare: Callable[[int, int], None]
    ) -> None:
        self.stepper, self.compilation, self._prepare = stepper, compilation, prepare
        self._steps: float = 0.0

    def advance(self, target: int, stop: Callable[[], bool]) -> None:
        """Take some steps towards a target."""
        steps, cloud = self._next_steps(target), self.stepper.cloud
        self._prepare(cloud.step, cloud.step + steps)
        # A call that includes compilation is no measure of the next.
        compiled, started = cloud.tracker.compiled, clock.perf_counter()
        # Of several ranks, each compiles the loop with its first steps.
        with nullcontext() if compiled else self.compilation.shown():
            self.stepper.advance(steps, stop)
        self.compilation.log_end()
        if compiled:
            seconds = clock.perf_counter() - started
            wanted = max(_CALL, min(_LONG, _FEW * seconds / steps))
            self._steps = steps * min(_FASTER, max(_SLOWER, wanted / (seconds + 1e-9)))

    def _next_steps(self, target: int) -> int:
        cloud = self.stepper.cloud
        most = MOST_STEPS / max(1, moving(cloud) - cloud.late)
        steps = min(most, self._steps or _FIRST_CALL * most)
        left, stretch = target - cloud.step, cloud.tracker.stretch_steps
        # Calls of similar length: not a long one and a remainder.
        steps = max(1, min(int(most), math.ceil(left / max(1, round(left / max(1.0, steps))))))
        # Steps of several Δt end at multiples of the stretch: calls that end elsewhere would change results.
        return min(left, -(-(cloud.step + steps) // stretch) * stretch - cloud.step)
