"""Log of a run: its selections, its progress, and the fates of the particles."""

from __future__ import annotations

import logging
import math
import time as clock
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

import foamprb
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, explain
from foamprb.cloud.integrators.paper import PAPER
from foamprb.cloud.integrators.registry import SMALL_STOKES
from foamprb.cloud.stability import unstable, warning_of
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.surroundings.wall_lift import WallLift, count_close, share_of_close
from foamprb.cloud.viscosity import medium_at
from foamprb.flow.base import Caveat, Sampled
from foamprb.results.folder import FAILURES
from foamprb.results.intervals import share
from foamprb.run.checks import SMALL_REYNOLDS
from foamprb.run.job import Job
from foamprb.run.slip import Slip, drag_excess, slip_of
from foamprb.run.validity import PathRecord, mode_of

log = logging.getLogger("foamprb")

_MAX_LISTED_FAILURES = 10
_GROUPS = {
    "shear_rate": "shear rate [1/s]",
    "capillary": "capillary number",
    "reynolds": "Reynolds number",
    "stokes": "shape Stokes number",
    "step": "deltaT/relaxation time",
    "size": "size/cell size",
}
_ROUND_OFF = 1e-12
"""Numbers of the flow and of dimensionless groups below this are shown as 0."""
_COST, _COST_OF_CALL = 0.12, 2.0
"""Processor time per particle of a tracking step and of a call of the loop, about, µs."""
_BETWEEN_LINES = 30.0
"""Time between two lines about the progress, s."""


def log_description(job: Job) -> None:
    """Log the selections of a run, their numbers and warnings, from its description."""
    description = job.description
    fluid, flow, models = (description[key] for key in ("fluid", "flow", "models"))
    if "viscosity" in fluid:
        log.info("Fluid: rho = %.4g kg/m3", fluid["rho"])
        log.info("    viscosity: %s, %.4g to %.4g Pa s over the nodes", fluid["viscosity"], *fluid["mu"])
    else:
        log.info(
            "Fluid: nu = %.4g m2/s, mu = %.4g Pa s, rho = %.4g kg/m3", fluid["nu"], fluid["mu"], fluid["rho"]
        )
    if flow["U"] is not None:
        first = " (the first)" if description["time"]["transient"] else ""
        log.info("Flow%s", f" at time {flow['time']}{first}" if flow["time"] else "")
        _log_range("|U| [m/s]", flow["U"])
        _log_range("shear rate [1/s]", flow["shearRate"])
        jumps = zip(flow["gradientJump"], ("(median)", "at walls"), strict=True)
        said = ", ".join(f"{100.0 * jump:.2g} % {where}" for jump, where in jumps if jump is not None)
        if said:
            log.info("    %-24s %s", "grad U between cells", said)
        rough = 100.0 * flow["roughness"]
        log.info("    %-24s %.2g %%, about the error of strains by the mesh", "roughness of grad U", rough)
    log.info("Selecting tractionModel %s", models["traction"])
    forces = {"ellipsoidDrag": models["drag"], **models["forces"], **models["surroundings"]}
    log.info(
        "Selecting particleForces %s",
        ", ".join(f"{name} {entries}".rstrip() for name, entries in forces.items()),
    )
    log.info("Selecting solid %s", models["solid"])
    if models["shape"] != "affine":
        log.info("Selecting shapeModel %s", models["shape"])
    log.info("Selecting integrationScheme %s: %s", models["integrator"], models["integratorDescription"])
    if models["shapeStokesNumber"] is not None:
        shape, path = models["shapeStokesNumber"], models["pathStokesNumber"]
        reason = f"a Stokes number is {SMALL_STOKES:g} or more"
        if max(shape, path) < SMALL_STOKES:
            reason = f"both Stokes numbers are below {SMALL_STOKES:g}"
        elif models["integrator"] == "stokes":
            reason = f"drops have no inertia; their Stokes numbers should be below {SMALL_STOKES:g}"
        log.info("    integrator %s, as %s: %.3g (shape), %.3g (path) at injection",
                 models["integrator"], reason, shape, path)  # fmt: skip
    given = job.cloud.models.tolerance
    if models["tolerance"] > given:
        log.info("    tolerance %.2g, by the roughness of grad U; roughnessShare 0 keeps %.2g",
                 models["tolerance"], given)  # fmt: skip
    if models["stepsEnd"] > 1:
        most = f" of up to {models['longestStep']} deltaT" if models["longestStep"] else " longer than deltaT"
        log.info("    may take steps%s, to multiples of %d deltaT", most, models["stepsEnd"])
    for name, entries in models["dispersion"].items():
        log.info("Selecting dispersionModel %s %s", name, entries)
    for name, entries in models["fates"].items():
        log.info("Selecting %s %s", name, entries)
    for line in models["notes"]:
        log.info("    %s", line)
    log.info(
        "Selecting patchInteractionModel %s, touching by the %s", models["interaction"], models["touching"]
    )
    for patch in description["patches"]:
        log.info("    %-16s %s", patch["name"], patch["interaction"])
    for injection in description["injections"]:
        log.info("Selecting injectionModel %s: %s", injection["name"], injection["type"])
        log.info("    particles                %d", injection["particles"])
        for key, name in _GROUPS.items():
            if key in injection:
                _log_range(name, injection[key])
    for name, kind in description["functions"].items():
        log.info("Selecting cloudFunction %s: %s", name, kind)
    # Caveats were logged when the flow was read.
    caveats = {str(note) for note in job.cloud.flow.notes if isinstance(note, Caveat)}
    for warning in description["warnings"]:
        if warning not in caveats:
            log.warning("%s", warning)


def _log_range(name: str, ends: Sequence[float | None]) -> None:
    low, high = (math.nan if end is None else 0.0 if abs(end) < _ROUND_OFF else end for end in ends)
    log.info("    %-24s %.4g%s", name, low, "" if high <= low * (1 + 1e-9) else f" to {high:.4g}")


def log_dry_run(job: Job) -> None:
    """Log the plan of a run that is not executed."""
    steps, call = job.steps, max(1, min(job.next_write(0), job.cloud.tracker.stretch_steps))
    seconds = 1e-6 * (_COST + _COST_OF_CALL / call) * job.cloud.size * steps
    log.info("\nDry run: %d particles, %d steps, nothing written. Tracking takes about %.1g s of processor "
             "time, without reading and compilation.\n\nEnd", job.cloud.size, steps, seconds)  # fmt: skip


class RunLog:
    """Log of a run from the start of its time loop."""

    def __init__(self, job: Job) -> None:
        self._job = job
        failed = np.sort(np.concatenate(job.cloud.map_ranks(_failed_of, _MAX_LISTED_FAILURES)))
        self._listed = set(failed[:_MAX_LISTED_FAILURES].tolist())
        """Numbers of failed particles that need no line; no more than lines."""
        self._unstable = 0
        self._slip = Slip()
        self._turn = 0

    def begin(self) -> None:
        """Log the start of the time loop."""
        log.info("\nStarting time loop\n")

    def write_times(self, counts: Mapping[float, Mapping[Status, int]]) -> None:
        """Log the numbers of particles at write times, s, and the failures until now."""
        for time, numbers in counts.items():
            self._log_numbers(time, numbers)
        self._log_steps()
        self._log_clocks()
        self._log_failures()
        self._log_unstable()
        self._log_slip()

    def _log_numbers(self, time: float, counts: Mapping[Status, int]) -> None:
        """Log the numbers of particles at a write time, s."""
        log.info("Time = %.12g\n", time)
        log.info("Cloud: %s", self._job.settings.name)
        log.info("    Current number of parcels       = %d", counts[Status.ACTIVE])
        log.info("    injected                        = %d", sum(counts.values()) - counts[Status.PENDING])
        log.info("    stuck, escaped, failed          = %d, %d, %d",
                 counts[Status.STUCK], counts[Status.ESCAPED], counts[Status.FAILED])  # fmt: skip
        if self._job.cloud.models.has_fates:
            log.info("    ruptured, released              = %d, %d",
                     counts[Status.RUPTURED], counts[Status.RELEASED])  # fmt: skip

    def end(self, finished: bool, points: Cloud | None = None) -> None:
        """Log the fates, beside those of ``points``, the folder, and End if the run has ``finished``."""
        self._log_fates(points)
        self._log_paths()
        log.info("\nResults in %s", self._job.folder.path)
        self._log_clocks()
        if finished:
            log.info("End")

    def warnings_at_end(self) -> list[str]:
        """Return the warnings of a run that its particles show at its end, for its record."""
        models, counts = self._job.cloud.models, self._job.cloud.counts()
        record = self._paths
        warnings = record.warnings(models.material) if record else []
        if counts[Status.PENDING]:
            warnings.append(f"{counts[Status.PENDING]} particles were not yet injected at the end time.")
        if counts[Status.FAILED]:
            table = self._job.folder.table(FAILURES)
            warnings.append(f"{counts[Status.FAILED]} particles failed; {table.name} lists them.")
        return warnings

    @cached_property
    def _paths(self) -> PathRecord | None:
        """Largest values on the paths at the end; None without released particles."""
        models, rho = self._job.cloud.models, self._job.settings.fluid.rho
        record = PathRecord.total([*self._job.cloud.map_by_id(PathRecord.of, rho, models)])
        return record if record.n else None

    def _log_steps(self) -> None:
        """Log the mean step, and the number of steps per tracking step."""
        cloud = self._job.cloud
        moved, steps, most, short = zip(*cloud.map_in_flow(_steps_of, cloud.dt), strict=True)
        n = sum(moved)
        if n == 0:
            return
        log.info("    mean step                       = %.3g deltaT, at most %.3g steps per deltaT",
                 n / sum(steps), max(most))  # fmt: skip
        log.info("    with a step below deltaT/10     = %.3g %%", 100.0 * sum(short) / n)

    def _log_clocks(self) -> None:
        """Log the times since the start of the program, as OpenFOAM does."""
        wall = clock.perf_counter() - foamprb.started
        log.info("ExecutionTime = %.2f s  ClockTime = %.2f s\n", clock.process_time(), wall)

    def _log_failures(self) -> None:
        """Log the particles that have failed since the last time, up to a number in all."""
        cloud, room = self._job.cloud, _MAX_LISTED_FAILURES - len(self._listed)
        if room <= 0 or cloud.counts()[Status.FAILED] == len(self._listed):
            return
        failures = [row for rows in cloud.map_in_flow(_failures_of, self._listed, room) for row in rows]
        for number, t, x, reason in sorted(failures)[:room]:
            self._listed.add(number)
            log.warning("particle %d failed at t = %.6g s, position (%g %g %g): %s.",
                        number, t, *x, explain(reason, cloud.models, cloud.limits))  # fmt: skip

    def _log_unstable(self) -> None:
        """Log the number of particles for which Δt is too long, if it is larger than before."""
        cloud = self._job.cloud
        if cloud.models.integrator != PAPER.name:
            return
        answers = cloud.map_in_flow(_unstable_of, cloud.medium, cloud.dt, cloud.models.material)
        beyond, limit = sum(n for n, _ in answers), min(limit for _, limit in answers)
        if beyond > self._unstable:
            self._unstable = beyond
            log.warning("%s", warning_of(beyond, limit, cloud.dt))

    def _log_slip(self) -> None:
        """Record the slip of the particles, and warn of the first Reynolds number that is too large."""
        before, cloud = self._slip.reynolds, self._job.cloud
        for slip in cloud.map_in_flow(slip_of, cloud.medium, cloud.size, self._turn):
            self._slip = self._slip.or_more(slip)
        self._turn += 1
        worst = self._slip.reynolds
        if before <= SMALL_REYNOLDS < worst:
            log.warning(
                "the Reynolds number of slip exceeds %g: drag is that of Stokes flow, which is %.2g %% or "
                "more too small for a sphere there. The end of the log has its largest value.",
                SMALL_REYNOLDS, 100.0 * drag_excess(SMALL_REYNOLDS))  # fmt: skip

    def _log_fates(self, points: Cloud | None) -> None:
        """Log number and share of the particles by fate and patch; their sum is the number injected."""
        job, counts = self._job, self._job.cloud.counts()
        answers = job.cloud.map_in_flow(_fates_of, len(job.patch_names))
        at_patches, close, touched = zip(*answers, strict=True)
        log.info("Fate of the particles")
        injected = sum(counts.values()) - counts[Status.PENDING]
        log.info("    %-24s %10d", "injected", injected)
        # The last column is that of points on no patch.
        of_points = np.zeros((len(Status), len(job.patch_names) + 1), dtype=np.int64)
        if points is not None:
            np.add.at(of_points, (points.particles.status, points.particles.patch), 1)

        def log_line(depth: int, name: str, count: int, tracers: int) -> None:
            said = _share(count, injected)
            if points is not None:
                both = (share(int(n), injected).percent() for n in (count, tracers))
                said = "   {}; of points {}".format(*both)
            log.info("%*s%-*s %10d%s", depth, "", 28 - depth, name, count, said)

        for status in tuple(Status)[Status.ACTIVE :]:
            if status > Status.FAILED and not job.cloud.models.has_fates:
                continue
            log_line(4, status.name.lower(), counts[status], of_points[status].sum())
            for index, name in enumerate(job.patch_names):
                at = sum(table[status, index] for table in at_patches)
                if at or of_points[status, index]:
                    log_line(8, name, at, of_points[status, index])
            if status is Status.STUCK and (n := sum(touched)):
                log.info("        %-20s %10d   of the others %s", "touched at release", n,
                         share(counts[status] - n, injected - n).percent())  # fmt: skip
        if any(isinstance(model, WallLift) for model in job.cloud.models.surroundings):
            log.info("    %s", share_of_close(*(sum(numbers) for numbers in zip(*close, strict=True))))
        for line in self._slip.lines():
            log.info("    %s", line)
        if counts[Status.PENDING]:
            log.warning("%d particles were not yet injected at the end time.", counts[Status.PENDING])
        if job.cloud.recovered:
            log.info("    %-24s %10d", "relocated by tree search", job.cloud.recovered)
        if counts[Status.FAILED] > _MAX_LISTED_FAILURES:
            log.warning(
                "%d particles failed; %s lists them.",
                counts[Status.FAILED],
                job.folder.table(FAILURES),
            )

    def _log_paths(self) -> None:
        """Log the largest values on the paths, and the particles for which they are beyond the model."""
        models, record = self._job.cloud.models, self._paths
        if record is None:
            return
        log.info("Largest values on the paths")
        for line in record.lines(affine=not models.has_quadratic):
            log.info("    %s", line)
        for warning in record.warnings(models.material):
            log.warning("%s", warning)
        if mode_of(models) is False and (advice := record.advice()):
            log.info("%s", advice)


def _share(count: int, injected: int) -> str:
    return f"   {share(int(count), injected).percent()}" if count else ""


def _steps_of(p: Particles, _flow: Sampled, _t: float, dt: float) -> tuple[int, float, float, int]:
    """Return how many particles moved, the sum and the most of their steps, and how many had short ones."""
    moved = (p.status == Status.ACTIVE) & (p.substeps > 0.0)
    n, short = p.substeps[moved], p.h[moved] < 0.1 * dt
    return len(n), float(n.sum()), float(n.max(initial=0.0)), int(short.sum())


def _failures_of(
    p: Particles, _flow: Sampled, _t: float, listed: Collection[int], most: int
) -> list[tuple[int, float, list[float], int]]:
    """Return number, time, position and reason of failed particles that are not known, the first few."""
    rows = np.flatnonzero(p.status == Status.FAILED)
    rows = rows[~np.isin(p.number[rows], list(listed))]
    rows = rows[np.argsort(p.number[rows])[:most]]
    columns = (array[rows].tolist() for array in (p.number, p.t, p.x, p.reason))
    return list(zip(*columns, strict=True))


def _failed_of(p: Particles, most: int) -> NDArray[np.int64]:
    """Return the numbers of the first failed particles."""
    return np.asarray(p.number[np.flatnonzero(p.status == Status.FAILED)[:most]])


def _unstable_of(
    p: Particles, flow: Sampled, t: float, medium: Medium, dt: float, material: str
) -> tuple[int, float]:
    return unstable(p, medium_at(medium, flow, p, t).mu, dt, material)


def _fates_of(
    p: Particles, _flow: Sampled, _t: float, patches: int
) -> tuple[NDArray[np.int64], tuple[float, float, int], int]:
    """Return the numbers of particles by status and patch, :func:`count_close`, and how many never moved."""
    numbers = np.zeros((len(Status), patches + 1), dtype=np.int64)
    # The last column takes the particles that are on no patch.
    np.add.at(numbers, (p.status, p.patch), 1)
    return numbers, count_close(p), int(p.touched.sum())


@contextmanager
def progress_bar(start: float, end: float) -> Iterator[Callable[[float], None]]:
    """Show a progress bar on a terminal, otherwise lines in the log.

    Yields
    ------
    A function to call with the current time, s.
    """
    console = Console(stderr=True)
    columns = (
        TextColumn("{task.completed:g} of {task.total:g} s"),
        BarColumn(None),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        if console.is_terminal:
            task = progress.add_task("", total=end - start)
            yield lambda t: progress.update(task, completed=min(t, end) - start)
        else:
            yield _Lines(start, end)


class _Lines:
    """Lines in the log with the progress of a run; for the arguments see :func:`progress_bar`."""

    def __init__(self, start: float, end: float) -> None:
        self._start, self._end = start, end
        self._first: tuple[float, float] | None = None
        self._last = clock.perf_counter()

    def __call__(self, t: float) -> None:
        """Log the progress at a time, s, unless the last line is recent."""
        now = clock.perf_counter()
        if self._first is None:
            # Compilation before this call is no measure of the rest.
            self._first = now, t
        if now - self._last < _BETWEEN_LINES:
            return
        self._last = now
        began, from_time = self._first
        left = ""
        if t > from_time:
            left = f", about {_duration((now - began) * (self._end - t) / (t - from_time))} left"
        share = 100.0 * (t - self._start) / (self._end - self._start)
        log.info("t = %.6g s, %.3g %% of the run%s", t, share, left)


def _duration(seconds: float) -> str:
    for size, name in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * size:
            return f"{seconds / size:.0f} {name}"
    return f"{seconds:.0f} s"
