"""The main job: settings → flow → cloud → time loop → output. The one place where all rooms meet."""

from __future__ import annotations

import logging
import math
import re
import time as clock
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from foamprb.body.imex import relaxation_time
from foamprb.body.material import lame_parameter
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Snapshot
from foamprb.cloud.executor import available_threads
from foamprb.cloud.injection.distribution import draw
from foamprb.cloud.injection.models import release
from foamprb.cloud.injection.shapes import Sphere
from foamprb.cloud.integrators.registry import INTEGRATORS, SMALL_STOKES, automatic
from foamprb.cloud.measures import context, shear_rate_at
from foamprb.cloud.state import REASONS, Particles, Reason, Status, concatenate
from foamprb.cloud.tracker import Models, Tracker
from foamprb.cloudfunctions.functions import STATUS_NAMES, Functions, Look
from foamprb.compile.link import cache_directory
from foamprb.dictionary.positions import read_positions
from foamprb.errors import InputError, RunStopped
from foamprb.flow.base import Flow
from foamprb.flow.read.source import Source, read_flow, read_transient_flow
from foamprb.flow.series import SeriesFlow
from foamprb.flow.walk import MeshFlow
from foamprb.output.atomic import only_writer, remove_unfinished
from foamprb.output.background import Writer
from foamprb.output.checkpoint import Checkpoints
from foamprb.output.tables import Column, write_table
from foamprb.output.vtk import Series
from foamprb.parallel.team import Serial, Team, View
from foamprb.run.checks import Groups, doubts, groups
from foamprb.run.precompile import Ahead
from foamprb.run.restart import Fingerprint, fingerprint, restore, save
from foamprb.settings.settings import (
    InjectionSettings,
    Settings,
    Solution,
    StartFrom,
    match_patches,
    read_settings,
)

log = logging.getLogger("foamprb")

_MAX_LISTED_FAILURES = 10
TIME_TOLERANCE = 1e-9
"""Relative error of a time that has been written and read."""
_HOW_TO_GO_ON = "To go on from the last checkpoint: foamprb run -resume."

FATES = "fates.csv"
FAILURES = "failed.csv"
CHECKPOINTS = "checkpoint"
"""Files and the folder in a run's folder, besides its series."""


@dataclass(frozen=True)
class Job:
    """A run that is ready to start."""

    settings: Settings
    cloud: Cloud
    functions: Functions
    ahead: Ahead | None = None
    """Who compiles the loop, if it is another process."""

    @property
    def look(self) -> Look:
        """What is to be seen of the cloud."""
        injectors = tuple(injection.name for injection in self.settings.injections)
        return Look(self.cloud, injectors, self.patch_names)

    @property
    def folder(self) -> Path:
        """Where the results go."""
        return self.settings.case / "postProcessing" / self.settings.region / self.settings.name

    @property
    def steps(self) -> int:
        """Number of steps from the start to the end of the run."""
        return _steps(self.settings.solution, self.cloud.start)

    @property
    def patch_names(self) -> tuple[str, ...]:
        """Names of the flow's patches, in the order of the codes in ``Particles.patch``."""
        return tuple(patch.name for patch in self.cloud.flow.patches)


def prepare(
    case: Path | str,
    time: float | str | None = None,
    dictionary: Path | None = None,
    threads: int | None = None,
    source: Source | None = None,
    ahead: bool = False,
) -> Job:
    """Read a case and place its particles.

    Parameters
    ----------
    case
        An OpenFOAM case folder.
    time
        Time of a steady flow: a value, or ``"latestTime"``, the default. Times of a transient flow, as
        :func:`foamprb.flow.series.select_times` has them; all by default.
    dictionary
        Settings instead of ``constant/softCloudProperties``.
    threads
        Number of threads; all processors by default.
    source
        The mesh file or region to read, and the names of its fields, if they are not the usual ones.
    ahead
        Whether to compile the loop in another process meanwhile, if it has never been compiled.

    Raises
    ------
    InputError
        If the case, the flow or the settings cannot be used: what, where, and what is allowed.
    """
    case = Path(case)
    source = source or Source()
    settings = read_settings(case, dictionary, source.region)
    compiling = _compile_ahead(settings) if ahead else None
    try:
        log.info("Reading flow of case %s", case if source.file is None else source.file)
        flow = _read_flow(settings, time, source)
        for note in flow.notes:
            log.info("    %s", note)
        return replace(assemble(settings, flow, threads), ahead=compiling)
    except BaseException:
        if compiling:
            compiling.stop()
        raise


def _compile_ahead(settings: Settings) -> Ahead:
    """Begin to compile the loop that the settings will want, as far as they tell."""
    scheme = settings.solution.shape
    # Most particles are small.
    models = _models(settings, "stokes" if scheme == "auto" else scheme)
    shaped = any(not isinstance(injection.shape, Sphere) for injection in settings.injections)
    tense = any(injection.solid.surface_tension != 0.0 for injection in settings.injections)
    flow = SeriesFlow if settings.solution.transient else MeshFlow
    dt, medium = settings.solution.deltaT, _medium(settings)
    tracker = Tracker(models, flow.kernels, medium, [], dt, 0.0, shaped, tense)
    ahead = Ahead(tracker, flow)
    if ahead:
        log.info("Compiling the particle loop, once; the code is kept in %s", cache_directory())
        tracker.compile_stages()
    return ahead


def _medium(settings: Settings) -> Medium:
    return Medium(settings.fluid.mu, settings.fluid.rho, settings.gravity)


def _models(settings: Settings, integrator: str) -> Models:
    solid = settings.injections[0].solid.type if settings.injections else Models.material
    tolerance = settings.solution.tolerance
    # Without any force g is zero: gravity then does nothing, in a loop that is compiled already.
    forces = tuple(settings.forces.values()) or Models.forces
    return Models(settings.traction, settings.drag, solid, settings.touching, integrator, tolerance, forces)


def _read_flow(settings: Settings, time: float | str | None, source: Source) -> Flow:
    solution = settings.solution
    if solution.transient:
        return read_transient_flow(
            settings.case, None if time is None else str(time), solution.period, source
        )
    if isinstance(time, str) and re.search(r"[:,\s]", time):
        raise InputError(
            f"{settings.file}: solution/transient is no, but -time '{time}' selects several times: set "
            "transient yes, or select one time."
        )
    return read_flow(settings.case, "latestTime" if time is None else time, source)


def assemble(settings: Settings, flow: Flow, threads: int | None = None) -> Job:
    """Put the particles that the settings ask for into a flow.

    Raises
    ------
    InputError
        If a patch has no interaction or particles would start outside the flow.
    """
    interactions = match_patches(settings.patches, flow.patches, settings.file)
    medium = _medium(settings)
    start = _start(settings, flow)
    # Not a list, which would keep them.
    particles = concatenate(
        _inject(i, injection, flow, medium) for i, injection in enumerate(settings.injections)
    )
    solids = sorted({injection.solid.type for injection in settings.injections})
    if len(solids) > 1:
        raise InputError(f"{settings.file}: one cloud has one type of solid, not {', '.join(solids)}.")
    solution = settings.solution
    integrator = solution.shape
    if integrator == "auto":
        integrator = automatic(_shape_stokes_number(particles, flow, medium.mu, start))
    models = _models(settings, integrator)
    try:
        cloud = Cloud(
            particles,
            flow,
            medium,
            interactions,
            solution.deltaT,
            models,
            threads or available_threads(),
            start=start,
        )
    except InputError as error:
        raise InputError(f"{settings.file}: {error}.") from error
    look = Look(cloud, tuple(i.name for i in settings.injections), tuple(p.name for p in flow.patches))
    try:
        functions = Functions(settings.functions, look)
    except InputError as error:
        raise InputError(f"{settings.file}: {error}") from error
    return Job(settings, cloud, functions)


def _start(settings: Settings, flow: Flow) -> float:
    """The first time of the flow, s, if it has one; raise InputError if the run goes beyond the flow."""
    solution, (first, last) = settings.solution, flow.span
    start = first if math.isfinite(first) else 0.0
    if solution.endTime <= start:
        raise InputError(
            f"{settings.file}: solution/endTime is {solution.endTime:g}. Allowed: after {start:g}, the first "
            "time of the flow."
        )
    end = start + _steps(solution, start) * solution.deltaT
    if end > last + TIME_TOLERANCE * abs(last):
        raise InputError(
            f"{settings.file}: solution/endTime is {solution.endTime:g}; the last step ends at {end:g}, "
            f"the flow at {last:g}. Allowed: up to that, or a flow that repeats itself (period)."
        )
    for injection in settings.injections:
        if injection.model.SOI < start:  # noqa: SIM300
            raise InputError(
                f"{settings.file}: injection model {injection.name}: SOI is {injection.model.SOI:g}. "
                f"Allowed: from {start:g} on, the first time of the flow."
            )
    return start


def _steps(solution: Solution, start: float) -> int:
    """Number of steps from the start to the end of the run."""
    return max(1, round((solution.endTime - start) / solution.deltaT))


def _shape_stokes_number(p: Particles, flow: Flow, mu: float, time: float) -> float:
    """The largest γ̇ τ_s of the particles where they start, at ``time`` (s)."""
    if p.size == 0:
        return 0.0
    rate = shear_rate_at(flow, p, time)
    return float((rate * relaxation_time(p.rho, p.R, mu, p.eta)).max())


def _inject(index: int, injection: InjectionSettings, flow: Flow, medium: Medium) -> Particles:
    try:
        p = release(injection.model, flow, _random(injection.name), read_positions)
    except InputError as error:
        raise InputError(f"injection model {injection.name}: {error}") from error
    solid = injection.solid
    p.R[:] = 0.5 * draw(injection.size, p.size, _random(injection.name, "size"))
    p.rho[:] = draw(injection.rho, p.size, _random(injection.name, "rho"))
    p.mu[:] = draw(solid.shear_modulus, p.size, _random(injection.name, "stiffness"))
    p.eta[:] = draw(solid.viscosity, p.size, _random(injection.name, "viscosity"))
    p.gamma[:] = draw(solid.surface_tension, p.size, _random(injection.name, "surfaceTension"))
    p.lame[:], p.k[:] = lame_parameter(p.mu, solid.poissons_ratio), solid.parameter
    injection.shape.form(p, _random(injection.name, "shape"))
    p.injector[:] = index
    wrong = ~((p.mu > 0.0) & (p.mu < math.inf))
    if wrong.any():
        raise InputError(
            f"injection model {injection.name}: the shear modulus of {np.count_nonzero(wrong)} of {p.size} "
            f"particles is {p.mu[wrong][0]:g}, no positive number; the fluid has {medium.mu:g} Pa s."
        )
    rate: Any = solid.reference_shear_rate
    if rate is None:
        rate = shear_rate_at(flow, p, injection.model.SOI)
    p.Ca[:] = medium.mu * rate / p.mu
    return p


def _random(*names: str) -> np.random.Generator:
    """Random numbers of an injection model, or of one of its quantities: no other changes what it draws."""
    return np.random.default_rng([zlib.crc32(name.encode()) for name in names])


def describe(job: Job) -> list[str]:
    """Log what was selected and what it means; return the warnings, each logged as well."""
    settings, cloud = job.settings, job.cloud
    log.info("Selecting tractionModel %s", settings.traction)
    forces = {"ellipsoidDrag": settings.drag, **settings.forces}
    named = ", ".join(f"{name} {force}".rstrip() for name, force in forces.items())
    log.info("Selecting particleForces %s", named)
    log.info("Selecting solid %s", cloud.models.material)
    scheme = cloud.models.integrator
    log.info("Selecting integrationScheme %s: %s", scheme, INTEGRATORS[scheme].description)
    if settings.solution.shape == "auto":
        number = _shape_stokes_number(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time)
        log.info("    auto: shape Stokes number up to %.3g at injection; stokes below %g, else rosenbrock",
                 number, SMALL_STOKES)  # fmt: skip
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
    for name, function in settings.functions.items():
        log.info("Selecting cloudFunction %s: %s", name, type(function).__name__)
    for warning in warnings:
        log.warning("%s", warning)
    return warnings


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


def execute(
    job: Job,
    start_from: StartFrom | None = None,
    stop: Callable[[], bool] = lambda: False,
    team: Team | None = None,
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
        Asked every second or so: true to write a checkpoint and end the run.
    team
        The processes that share the particles; this one alone by default.

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
    """
    try:
        with only_writer(job.folder):
            return _execute(job, start_from or job.settings.solution.startFrom, stop, team or Serial())
    except OSError as error:
        raise RunStopped(f"{str(error).rstrip('.')}. {_HOW_TO_GO_ON}") from error


def _execute(
    job: Job, start_from: StartFrom | None, stop: Callable[[], bool], team: Team
) -> dict[Status, int]:
    cloud = job.cloud
    marks = fingerprint(job.settings, cloud)
    checkpoints = Checkpoints(job.folder / CHECKPOINTS)
    series = _begin(job, marks, checkpoints, start_from)
    started, cpu = clock.perf_counter(), clock.process_time()
    _compile_measures(cloud)
    team.take(cloud)
    if job.ahead:
        cloud.make_ready()
        job.ahead.wait()
    if not cloud.compiled:
        log.info("Compiling the particle loop, once; the code is kept in %s", cache_directory())
    log.info("\nStarting time loop\n")

    def log_time() -> None:
        _log_time(job, clock.process_time() - cpu, clock.perf_counter() - started)

    failing = _go_through_time(job, Results(series, checkpoints, marks), stop, team, log_time)
    write_fates(job)
    log_fates(job)
    log.info("\nResults in %s", job.folder)
    log.info(
        "ExecutionTime = %.2f s  ClockTime = %.2f s\n",
        clock.process_time() - cpu,
        clock.perf_counter() - started,
    )
    if failing:
        raise RunStopped(f"{failing} The results until then are in {job.folder}.")
    log.info("End")
    return cloud.particles.counts()


class Results(NamedTuple):
    """What is written at each write time, besides what the cloud functions write."""

    series: Series
    checkpoints: Checkpoints
    marks: Fingerprint

    def save(self, cloud: Cloud | Snapshot, functions: Mapping[str, NDArray[Any]]) -> None:
        """Write a checkpoint, of a cloud whose files have been written."""
        self.checkpoints.write(save(cloud, functions, self.series.entries, self.marks))


def _go_through_time(
    job: Job, results: Results, stop: Callable[[], bool], team: Team, log_time: Callable[[], None]
) -> str:
    """Advance and write until the end; return why too many particles have failed, if so."""
    solution, cloud = job.settings.solution, job.cloud
    last = job.steps
    per_write = max(1, round(solution.writeInterval / solution.deltaT))
    reported = np.flatnonzero(cloud.particles.status == Status.FAILED)
    failing = _failing(job)
    snapshot: Snapshot | None = None
    with Writer() as writer, _progress(cloud.start, solution.endTime) as show:

        def ask() -> bool:
            writer.check()
            return stop()

        while cloud.step < last and (cloud.step == 0 or _moving(cloud)) and not failing:
            target = min(last, (cloud.step // per_write + 1) * per_write)
            reached = _advance_to(job, target, show, ask)
            if reached and target < last and _moving(cloud):
                cloud.begin(_next_chunk(job, min(last, target + per_write)))
            cloud.gather()
            # So far the copy is being read.
            writer.finish()
            if not reached:
                results.save(cloud, job.functions.state())
                raise RunStopped(f"stopped at t = {cloud.time:.12g} s. {_HOW_TO_GO_ON}")
            snapshot = cloud.snapshot(snapshot)
            end_write = team.begin_write(results.series, snapshot, view(job))
            job.functions.write(job.folder)
            seen = {name: array.copy() for name, array in job.functions.state().items()}
            writer.begin(partial(_end_writing, end_write, results, snapshot, seen))
            log_time()
            reported = _log_failures(cloud.particles, reported)
            failing = _failing(job)
    return failing


def _end_writing(
    end_write: Callable[[], object], results: Results, cloud: Snapshot, functions: Mapping[str, NDArray[Any]]
) -> None:
    end_write()
    results.save(cloud, functions)


def _compile_measures(cloud: Cloud) -> None:
    """Measure a particle: not in two threads at once may code be linked."""
    first = cloud.particles.take(np.arange(min(1, cloud.particles.size)))
    first.status[:] = Status.ACTIVE
    context(first, cloud.flow, cloud.medium.mu, cloud.time)


def _begin(job: Job, marks: Fingerprint, checkpoints: Checkpoints, start_from: StartFrom | None) -> Series:
    """Put the cloud at the time from which the run goes on, and drop what an old run wrote after it."""
    fates, failed = job.folder / FATES, job.folder / FAILURES
    if start_from is None and checkpoints.files() and not fates.exists():
        raise InputError(
            f"{job.folder}: an unfinished run has come to t = {max(checkpoints.files()):g} s. To go on with "
            "it: -resume, or startFrom latestTime; to begin anew in its place: -overwrite, or startFrom "
            "startTime."
        )
    checkpoint = checkpoints.latest() if start_from == "latestTime" else None
    if checkpoint is None:
        if start_from == "latestTime":
            log.info("No checkpoint in %s: beginning at the start time", checkpoints.folder)
        # First: with them an interrupted removal could be taken for the run itself.
        checkpoints.truncate(after=-np.inf)
        after = -np.inf
    else:
        restore(job.cloud, job.functions, checkpoint, marks, job.folder / f"{job.settings.name}.pvd")
        log.info("Continuing from the checkpoint at t = %.12g s in %s", job.cloud.time, checkpoints.folder)
        after = checkpoint.time
    remove_unfinished(job.folder)
    for table in (fates, failed):
        table.unlink(missing_ok=True)
    return Series(job.folder, job.settings.name, after=after)


def _failing(job: Job) -> str:
    """Say that too many particles have failed; nothing if not."""
    p, most = job.cloud.particles, job.settings.solution.maxFailedFraction
    counts = p.counts()
    injected = p.size - counts[Status.PENDING]
    if counts[Status.FAILED] <= most * injected:
        return ""
    return (
        f"{counts[Status.FAILED]} of {injected} particles have failed at t = {job.cloud.time:.12g} s, more "
        f"than maxFailedFraction {most:g} allows; {job.folder / FAILURES} says why."
    )


def _moving(cloud: Cloud) -> bool:
    counts = cloud.counts()
    return counts[Status.PENDING] + counts[Status.ACTIVE] > 0


def _advance_to(job: Job, target: int, show: Callable[[float], None], stop: Callable[[], bool]) -> bool:
    """Advance to a step; whether it was reached before ``stop`` said so."""
    cloud = job.cloud
    while cloud.step < target and _moving(cloud):
        if stop():
            return False
        until = job.functions.next_look(target)
        cloud.advance(_next_chunk(job, target))
        if cloud.step == until:
            job.functions.see()
        show(cloud.time)
    cloud.step = target
    return True


def _next_chunk(job: Job, target: int) -> int:
    """Number of steps that the cloud takes at once on its way to a target."""
    cloud = job.cloud
    counts = cloud.counts()
    work = counts[Status.PENDING] + counts[Status.ACTIVE]
    return min(job.functions.next_look(target) - cloud.step, max(1, cloud.executor.at_once // work))


@contextmanager
def _progress(start: float, end: float) -> Iterator[Callable[[float], None]]:
    """A progress bar on a terminal, nothing elsewhere."""
    console = Console(stderr=True)
    columns = (
        TextColumn("{task.completed:g} of {task.total:g} s"),
        BarColumn(None),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("", total=end - start)
        yield lambda t: progress.update(task, completed=min(t, end) - start)


def view(job: Job) -> View:
    """What it takes to report a job's particles."""
    names: dict[str, tuple[str, ...]] = {
        "status": STATUS_NAMES,
        "reason": tuple(REASONS[reason] for reason in Reason),
        "patch": job.patch_names,
        "injector": tuple(injection.name for injection in job.settings.injections),
    }
    return View(names, job.cloud.medium.mu)


def _log_time(job: Job, cpu: float, wall: float) -> None:
    counts = job.cloud.particles.counts()
    injected = job.cloud.particles.size - counts[Status.PENDING]
    log.info("Time = %.12g\n", job.cloud.time)
    log.info("Cloud: %s", job.settings.name)
    log.info("    Current number of parcels       = %d", counts[Status.ACTIVE])
    log.info("    injected                        = %d", injected)
    log.info("    stuck, escaped, failed          = %d, %d, %d",
             counts[Status.STUCK], counts[Status.ESCAPED], counts[Status.FAILED])  # fmt: skip
    log.info("ExecutionTime = %.2f s  ClockTime = %.2f s\n", cpu, wall)


def _log_failures(p: Particles, reported: NDArray[np.int64]) -> NDArray[np.int64]:
    """Log the failures since those ``reported``, as far as the log lists them; return all of them."""
    failed = np.flatnonzero(p.status == Status.FAILED)
    room = max(0, _MAX_LISTED_FAILURES - len(reported))
    for k in np.setdiff1d(failed, reported)[:room]:
        log.warning("particle %d failed at t = %.6g s, position (%g %g %g): %s.",
                    k, p.t[k], *p.x[k], REASONS[Reason(p.reason[k])])  # fmt: skip
    return failed


def write_fates(job: Job) -> None:
    """Write ``fates.csv``, a row per particle, and ``failed.csv`` if any failed."""
    p, look = job.cloud.particles, job.look
    fates = np.array(STATUS_NAMES, dtype=object)
    # The last is that of −1.
    patches = np.array((*job.patch_names, ""), dtype=object)
    axes, D = look.measure(np.arange(p.size), "semiAxes", "taylorDeformation")
    write_table(
        job.folder / FATES,
        {
            "id": np.arange(p.size), "d": 2.0 * p.R, "rho": p.rho, "Ca": p.Ca,
            "t0": p.t0, "x0": p.x0[:, 0], "y0": p.x0[:, 1], "z0": p.x0[:, 2],
            "t1": p.t, "x1": p.x[:, 0], "y1": p.x[:, 1], "z1": p.x[:, 2],
            "fate": fates[p.status], "patch": patches[p.patch],
            "a": axes[:, 0], "b": axes[:, 1], "c": axes[:, 2], "D": D,
        },
    )  # fmt: skip
    failed = np.flatnonzero(p.status == Status.FAILED)
    table = job.folder / FAILURES
    if len(failed):
        reasons = [REASONS[Reason(r)] for r in p.reason[failed]]
        x = p.x[failed]
        columns: dict[str, Column] = {
            "id": failed,
            "t": p.t[failed],
            "x": x[:, 0],
            "y": x[:, 1],
            "z": x[:, 2],
            "reason": reasons,
        }
        write_table(table, columns)
    else:
        table.unlink(missing_ok=True)


def log_fates(job: Job) -> None:
    """Log how many particles met which fate, by patch; the numbers sum to those injected."""
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
    if counts[Status.PENDING]:
        log.warning("%d particles were not yet injected at the end time.", counts[Status.PENDING])
    if job.cloud.recovered:
        log.info("    %-24s %10d", "walks mended by the tree", job.cloud.recovered)
    if counts[Status.FAILED] > _MAX_LISTED_FAILURES:
        log.warning("%d particles failed; %s lists them.", counts[Status.FAILED], job.folder / FAILURES)
