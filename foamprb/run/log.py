"""What a person reads of a run: what was selected, how far it has come, and what became of the particles."""

from __future__ import annotations

import logging
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from foamprb.cloud.integrators.paper import PAPER
from foamprb.cloud.integrators.registry import INTEGRATORS, SMALL_STOKES
from foamprb.cloud.measures import shape_stokes_number, shear_rate
from foamprb.cloud.reasons import explain
from foamprb.cloud.stability import longest_stable_steps
from foamprb.cloud.state import Status
from foamprb.compile.cache import cache_directory
from foamprb.results.folder import FAILURES
from foamprb.run.checks import Groups, doubts, groups
from foamprb.run.job import Job

log = logging.getLogger("foamprb")

_MAX_LISTED_FAILURES = 10
_CHUNK = 1 << 20
_BETWEEN_LINES = 30.0
"""Seconds between two lines on how far a run is."""


def describe(job: Job) -> list[str]:
    """Log what was selected and what it means; return the warnings, each logged as well."""
    settings, cloud = job.settings, job.cloud
    _log_flow(job)
    log.info("Selecting tractionModel %s", settings.traction)
    forces = {"ellipsoidDrag": settings.drag, **settings.forces, **settings.surroundings}
    named = ", ".join(f"{name} {force}".rstrip() for name, force in forces.items())
    log.info("Selecting particleForces %s", named)
    log.info("Selecting solid %s", cloud.models.material)
    scheme = cloud.models.integrator
    log.info("Selecting integrationScheme %s: %s", scheme, INTEGRATORS[scheme].description)
    if settings.solution.shape == "auto":
        number = shape_stokes_number(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time)
        log.info("    auto: shape Stokes number up to %.3g at injection; stokes below %g, else rosenbrock",
                 number, SMALL_STOKES)  # fmt: skip
    if cloud.tracker.stride > 1:
        log.info("    steps of up to %d deltaT where the error allows it", cloud.tracker.stride)
    for name, dispersion in settings.dispersion.items():
        log.info("Selecting dispersionModel %s %s", name, dispersion)
    for model in cloud.models.surroundings:
        for line in model.notes(cloud.particles, cloud.make_ready(), cloud.flow):
            log.info("    %s", line)
    log.info("Selecting patchInteractionModel %s, touching by the %s",
             settings.interaction, settings.touching)  # fmt: skip
    for patch, interaction in zip(cloud.flow.patches, cloud.interactions, strict=True):
        log.info("    %-16s %s", patch.name, type(interaction).__name__.lower())
    warnings = []
    for index, injection in enumerate(settings.injections):
        g = groups(cloud, index)
        log.info("Selecting injectionModel %s: %s", injection.name, type(injection.model).__name__)
        _log_groups(g)
        warnings += doubts(g, cloud.models.integrator, f"injection model {injection.name}") if g.n else []
    for model in cloud.models.surroundings:
        warnings += model.warnings(cloud.particles, cloud.flow, cloud.medium, cloud.dt)
    for name, function in settings.functions.items():
        log.info("Selecting cloudFunction %s: %s", name, type(function).__name__)
    if cloud.particles.size == 0:
        warnings.append("there is no particle: no injection model releases any.")
    for warning in warnings:
        log.warning("%s", warning)
    return warnings


def _log_flow(job: Job) -> None:
    """Log the fluid, and the ranges of the flow that was read."""
    fluid, (time, u, l) = job.settings.fluid, job.cloud.flow.at_nodes()
    log.info("Fluid: nu = %.4g m2/s, mu = %.4g Pa s, rho = %.4g kg/m3", fluid.nu, fluid.mu, fluid.rho)
    if len(u) == 0:
        return
    parts = [slice(start, start + _CHUNK) for start in range(0, len(u), _CHUNK)]
    first = " (the first)" if job.settings.solution.transient else ""
    log.info("Flow%s", f" at time {time}{first}" if time else "")
    for name, values in (
        ("|U| [m/s]", [np.linalg.norm(u[part], axis=1) for part in parts]),
        ("shear rate [1/s]", [shear_rate(tuple(l[part].T)) for part in parts]),
    ):
        low, high = min(v.min() for v in values), max(v.max() for v in values)
        log.info("    %-24s %.4g to %.4g", name, low, high)


def log_dry_run(job: Job) -> None:
    """Log what a run would do that is not done."""
    log.info(
        "\nDry run: %d particles, %d steps, nothing written.\n\nEnd", job.cloud.particles.size, job.steps
    )


def _log_groups(g: Groups) -> None:
    log.info("    particles                %d", g.n)
    if g.n == 0:
        return
    for name, (low, high) in (
        ("shear rate [1/s]", g.shear_rate),
        ("capillary number", g.capillary),
        ("Reynolds number", g.reynolds),
        ("shape Stokes number", g.stokes),
        ("deltaT/relaxation time", g.step),
        ("size/cell size", g.size),
    ):
        log.info("    %-24s %.4g%s", name, low, "" if high <= low * (1 + 1e-9) else f" to {high:.4g}")


def log_compiling() -> None:
    """Say that the loop over the particles is compiled now."""
    log.info("Compiling the particle loop, once; the code is kept in %s", cache_directory())


class RunLog:
    """The log of a run from the start of its time loop on."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._started, self._cpu = clock.perf_counter(), clock.process_time()
        self._failed = self._failures()
        self._unstable = 0

    def begin(self) -> None:
        """Say that the time loop starts, and whether its loop over the particles has yet to be compiled."""
        if not self._job.cloud.compiled:
            log_compiling()
        log.info("\nStarting time loop\n")

    def write_time(self) -> None:
        """Say how many particles are where at a write time, and which have failed since the one before."""
        cloud = self._job.cloud
        counts = cloud.particles.counts()
        log.info("Time = %.12g\n", cloud.time)
        log.info("Cloud: %s", self._job.settings.name)
        log.info("    Current number of parcels       = %d", counts[Status.ACTIVE])
        log.info("    injected                        = %d", cloud.particles.size - counts[Status.PENDING])
        log.info("    stuck, escaped, failed          = %d, %d, %d",
                 counts[Status.STUCK], counts[Status.ESCAPED], counts[Status.FAILED])  # fmt: skip
        self._log_steps()
        self._log_clocks()
        self._log_failures()
        self._log_unstable()

    def end(self, finished: bool) -> None:
        """Say what became of the particles, where the results are, and whether the run has ``finished``."""
        self._log_fates()
        log.info("\nResults in %s", self._job.folder.path)
        self._log_clocks()
        if finished:
            log.info("End")

    def _log_steps(self) -> None:
        """Say in how many steps the last tracking step was cut."""
        cloud = self._job.cloud
        p = cloud.particles
        moved = (p.status == Status.ACTIVE) & (p.substeps > 0.0)
        if not moved.any():
            return
        n, short = p.substeps[moved], p.h[moved] < 0.1 * cloud.dt
        log.info("    steps per tracking step         = %.3g in the mean, %.3g at most", n.mean(), n.max())
        log.info("    with a step below deltaT/10     = %.3g %%", 100.0 * short.mean())

    def _failures(self) -> NDArray[np.int64]:
        """Numbers of the particles that have failed."""
        return np.flatnonzero(self._job.cloud.particles.status == Status.FAILED)

    def _log_clocks(self) -> None:
        cpu, wall = clock.process_time() - self._cpu, clock.perf_counter() - self._started
        log.info("ExecutionTime = %.2f s  ClockTime = %.2f s\n", cpu, wall)

    def _log_failures(self) -> None:
        """Name the particles that have failed since the last time, as long as there are few in all."""
        cloud, failed = self._job.cloud, self._failures()
        p = cloud.particles
        room = max(0, _MAX_LISTED_FAILURES - len(self._failed))
        for k in np.setdiff1d(failed, self._failed)[:room]:
            log.warning("particle %d failed at t = %.6g s, position (%g %g %g): %s.",
                        k, p.t[k], *p.x[k], explain(p.reason[k], cloud.models, cloud.limits))  # fmt: skip
        self._failed = failed

    def _log_unstable(self) -> None:
        """Say for how many particles the step is too long, if there are more than at any time before."""
        cloud = self._job.cloud
        if cloud.models.integrator != PAPER.name:
            return
        limits = longest_stable_steps(cloud.particles, cloud.medium.mu, cloud.dt, cloud.models.material)
        beyond = int(np.isfinite(limits).sum())
        if beyond > self._unstable:
            self._unstable = beyond
            log.warning("deltaT is up to %.3g times what the integrator paper is stable with for the shapes "
                        "of %d particles: they are not as long as they should be. Take a deltaT below "
                        "%.3g s, or rosenbrock.", cloud.dt / limits.min(), beyond, limits.min())  # fmt: skip

    def _log_fates(self) -> None:
        """Say how many particles met which fate, by patch; the numbers sum to those injected."""
        job = self._job
        p = job.cloud.particles
        counts = p.counts()
        log.info("Fate of the particles")
        log.info("    %-24s %10d", "injected", p.size - counts[Status.PENDING])
        for status in (Status.ACTIVE, Status.STUCK, Status.ESCAPED, Status.FAILED):
            log.info("    %-24s %10d", status.name.lower(), counts[status])
            for index, name in enumerate(job.patch_names):
                at = np.count_nonzero((p.status == status) & (p.patch == index))
                if at:
                    log.info("        %-20s %10d", name, at)
        for model in job.cloud.models.surroundings:
            for line in model.summary(p, job.cloud.dt):
                log.info("    %s", line)
        if counts[Status.PENDING]:
            log.warning("%d particles were not yet injected at the end time.", counts[Status.PENDING])
        if job.cloud.recovered:
            log.info("    %-24s %10d", "walks mended by the tree", job.cloud.recovered)
        if counts[Status.FAILED] > _MAX_LISTED_FAILURES:
            log.warning(
                "%d particles failed; %s lists them.",
                counts[Status.FAILED],
                job.folder.table(FAILURES, job.tables),
            )


@contextmanager
def progress_bar(start: float, end: float) -> Iterator[Callable[[float], None]]:
    """A progress bar on a terminal, a line in the log now and then elsewhere.

    Parameters
    ----------
    start, end
        Times of the run, s.

    Yields
    ------
    What is to be told the time, s, now and then.
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
    """Lines in the log that say how far a run is; arguments as of :func:`progress_bar`."""

    def __init__(self, start: float, end: float) -> None:
        self._start, self._end = start, end
        self._first: tuple[float, float] | None = None
        self._last = clock.perf_counter()

    def __call__(self, t: float) -> None:
        """Say how far the run is at a time, s, if that was not said just now."""
        now = clock.perf_counter()
        if self._first is None:
            # What was compiled until here says nothing of the rest.
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
