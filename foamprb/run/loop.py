"""The time loop: begin, advance, write, end."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable

import numpy as np

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.executor import Executor
from foamprb.cloud.injection.room import BYTES
from foamprb.cloud.measures import context
from foamprb.cloud.state import Status
from foamprb.errors import RunInterrupted, RunStopped
from foamprb.memory import require, wants
from foamprb.parallel.signals import caught_signals
from foamprb.results.folder import FAILURES
from foamprb.run.job import Job
from foamprb.run.log import RunLog, log_compiling, progress_bar
from foamprb.run.results import HOW_TO_GO_ON, Results, open_results
from foamprb.settings.solution import StartFrom

_COPIES, _BESIDE = 0.5 * BYTES, 1e8
"""Address space for each particle, for the copy that is written; and for threads and libraries, bytes."""


def execute(
    job: Job,
    start_from: StartFrom | None = None,
    stop: Callable[[], bool] = lambda: False,
    executor: Executor | None = None,
) -> dict[Status, int]:
    """Advance a cloud to the end time, or until no particle moves, and write its results.

    A checkpoint is written with the results of every write time, after them. The particles go on while the
    files are written, until the next are due. Whatever ends a run, another one started from ``latestTime``
    ends with the same state and the same files, bit for bit, as a run never interrupted.

    Parameters
    ----------
    job
        A cloud that has not been advanced.
    start_from
        ``"startTime"`` to begin anew, in place of an old run; ``"latestTime"`` to go on from the last
        checkpoint, if there is one. By default what the settings say. If they say nothing, a run begins anew,
        but not in place of an unfinished one.
    stop
        Asked some times a second: true to write a checkpoint and end the run.
    executor
        Who carries the particles; by default the threads of this process.

    Returns
    -------
    Number of particles of each status.

    Raises
    ------
    InputError
        If the run cannot go on from its checkpoints, or the user must say whether it shall; if another run is
        writing to the same folder.
    RunStopped
        If ``stop`` said so, too many particles failed, or results could not be written.
    OutOfMemory
        If the address space of this process is limited, and too small.
    """
    wants("particles", job.cloud.particles.size, BYTES)
    require(_COPIES * job.cloud.particles.size + _BESIDE)
    with open_results(job) as results:
        results.begin(start_from or job.settings.solution.startFrom)
        log = RunLog(job)
        _make_ready(job, executor)
        results.write_start()
        log.begin()
        pace = _Pace()
        with progress_bar(job.cloud.start, job.settings.solution.endTime) as show:
            while _goes_on(job):
                if not _advance(job, results, stop, show, pace):
                    results.save()
                    raise RunStopped(f"stopped at t = {job.cloud.time:.12g} s. {HOW_TO_GO_ON}")
                results.write()
                log.write_time()
        results.end()
        failing = _failing(job)
        log.end(finished=not failing)
    if failing:
        raise RunStopped(f"{failing} The results until then are in {job.folder.path}.")
    return job.cloud.particles.counts()


def execute_until_signal(job: Job, executor: Executor, start_from: StartFrom | None = None) -> None:
    """Execute a job as :func:`execute`; Ctrl-C or SIGTERM to any of its processes stops it in order.

    Raises
    ------
    RunInterrupted
        If a signal was the reason to stop.
    InputError, RunStopped
        As of :func:`execute`.
    """
    _compile(job, executor)
    with caught_signals() as caught:
        try:
            execute(job, start_from, lambda: bool(caught or executor.signals), executor)
        except RunStopped as stopped:
            signals = [*caught, *executor.signals]
            if not signals:
                raise
            raise RunInterrupted(str(stopped), signals[0]) from stopped


def _compile(job: Job, executor: Executor) -> None:
    """Compile the loop, if this process needs it; a signal acts at once until then."""
    cloud = job.cloud
    if not executor.precompiles:
        return
    if job.precompiler:
        cloud.make_ready()
        job.precompiler.wait()
    if not cloud.compiled:
        log_compiling()
    cloud.tracker.compile(cloud.make_ready())


def _make_ready(job: Job, executor: Executor | None) -> None:
    """Hand the particles over, and compile what is needed beside the loop."""
    cloud = job.cloud
    # Code may not be linked in two threads at once, and the thread that writes measures the particles.
    first = cloud.particles.take(np.arange(min(1, cloud.particles.size)))
    first.status[:] = Status.ACTIVE
    context(first, cloud.flow, cloud.medium.mu, cloud.time)
    if executor is not None:
        cloud.hand_over(executor)
    if job.precompiler:
        cloud.make_ready()
        job.precompiler.wait()


def _goes_on(job: Job) -> bool:
    """Whether there are steps left, particles to take them, and not too many that failed."""
    cloud = job.cloud
    return cloud.step < job.steps and (cloud.step == 0 or _moving(cloud)) and not _failing(job)


def _failing(job: Job) -> str:
    """Say that too many particles have failed; nothing if not."""
    p, most = job.cloud.particles, job.settings.solution.maxFailedFraction
    counts = p.counts()
    injected = p.size - counts[Status.PENDING]
    if counts[Status.FAILED] <= most * injected:
        return ""
    return (
        f"{counts[Status.FAILED]} of {injected} particles have failed at t = {job.cloud.time:.12g} s, more "
        f"than maxFailedFraction {most:g} allows; {job.folder.table(FAILURES, job.tables)} says why."
    )


def _moving(cloud: Cloud) -> bool:
    counts = cloud.counts()
    return counts[Status.PENDING] + counts[Status.ACTIVE] > 0


def _advance(
    job: Job, results: Results, stop: Callable[[], bool], show: Callable[[float], None], pace: _Pace
) -> bool:
    """Advance to the next write time; return whether it was reached before ``stop`` said so."""
    cloud, target = job.cloud, job.next_write(job.cloud.step)
    while cloud.step < target and _moving(cloud):
        results.check()
        if stop():
            return False
        until = results.next_observation(target)
        pace.advance(cloud, until, stop)
        if cloud.step == until:
            results.observe()
        show(cloud.time)
    cloud.step = target
    return True


_FIRST_CALL = 1 / 800
"""Share of the most that an executor takes in a call: some tenths of a second."""
_CALL = 2.0
"""Seconds that a call should take."""
_FEW, _LONG = 100, 30.0
"""Smallest number of steps of a call, unless they take longer than so many seconds."""
_SLOWER, _FASTER = 0.1, 4.0


class _Pace:
    """How many steps are taken at once: so many that to take particles up and put them down costs little."""

    def __init__(self) -> None:
        self._steps: float = 0.0

    def advance(self, cloud: Cloud, target: int, stop: Callable[[], bool]) -> None:
        """Take some steps towards a target."""
        steps = self._at_once(cloud, target)
        # What is compiled at the first call says nothing of the next.
        compiled, started = cloud.compiled, clock.perf_counter()
        cloud.carry(steps, stop)
        if compiled:
            seconds = clock.perf_counter() - started
            wanted = max(_CALL, min(_LONG, _FEW * seconds / steps))
            self._steps = steps * min(_FASTER, max(_SLOWER, wanted / (seconds + 1e-9)))

    def _at_once(self, cloud: Cloud, target: int) -> int:
        counts = cloud.counts()
        work = counts[Status.PENDING] + counts[Status.ACTIVE]
        most = cloud.executor.at_once / work
        steps = min(most, self._steps or _FIRST_CALL * most)
        rest, whole = target - cloud.step, cloud.tracker.whole
        # Calls of like length: not a long one and the rest.
        steps = max(1, min(int(most), math.ceil(rest / max(1, round(rest / max(1.0, steps))))))
        # Where steps may go through several, the answer depends on where calls end unless it is there.
        return min(rest, -(-(cloud.step + steps) // whole) * whole - cloud.step)
