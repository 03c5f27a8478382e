"""From a case to a job that can be executed: settings → flow → cloud."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body.imex import relaxation_time
from foamprb.body.material import MATERIALS
from foamprb.body.memory import RESOLVED
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.communicator import Communicator
from foamprb.cloud.injection.distribution import Distribution
from foamprb.cloud.injection.models import (
    START_OF_FLOW,
)
from foamprb.cloud.injection.shapes import Sphere
from foamprb.cloud.integrators.registry import automatic
from foamprb.cloud.patches import CYCLIC, stopping
from foamprb.cloud.surroundings.memory import FadingMemory
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.tracker import Models, Tracker, available_threads
from foamprb.cloud.viscosity import viscosity_at_rate
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Flow
from foamprb.flow.deforming import DeformingFlow
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.moving import MovingFlow
from foamprb.flow.nodes import NodeValues
from foamprb.flow.read.flows import check_region, read_flow, read_transient_flow, rotations_of
from foamprb.flow.read.motion import moves, moves_rigidly
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.flow.rotating import RotatingFlow
from foamprb.flow.series import SeriesFlow
from foamprb.results.folder import ResultsFolder
from foamprb.run.compilation import Compilation
from foamprb.run.description import describe
from foamprb.run.release import Release, number_of_times
from foamprb.settings.patches import match_patches
from foamprb.settings.settings import Settings, read_settings
from foamprb.settings.solution import MULTIPLE_TOLERANCE, Solution

log = logging.getLogger("foamprb")

TIME_TOLERANCE = 1e-9
"""Relative error of a time that has been written and read."""
_WIDTH = 0.1
"""Width of a flow that has not been read, m."""


@dataclass(frozen=True)
class Job:
    """Run that is ready to start."""

    settings: Settings
    cloud: Cloud
    functions: CloudFunctions
    compilation: Compilation = field(default_factory=Compilation)
    output: Path | None = None
    """Folder of the results instead of ``postProcessing`` in the case."""

    @property
    def observed(self) -> ObservedCloud:
        """Cloud with the names of its injection models and patches."""
        names = {"patch": self.patch_names, "injector": self.injector_names}
        return ObservedCloud(self.cloud, names)

    @property
    def folder(self) -> ResultsFolder:
        """Folder of the results."""
        return ResultsFolder.of_case(
            self.settings.case, self.settings.name, self.settings.region, self.output
        )

    @cached_property
    def description(self) -> dict[str, Any]:
        """Description of the run, made before the first step."""
        return describe(self.settings, self.cloud, self.steps)

    @property
    def steps(self) -> int:
        """Number of steps from the start to the end of the run."""
        return _last_step(self.settings.solution, self.cloud.start)[0]

    def next_write(self, step: int) -> int:
        """Return the next step after ``step`` at which results are written, at most the last."""
        solution = self.settings.solution
        if solution.writeInterval >= solution.endTime:
            return self.steps
        interval = max(1, round(solution.writeInterval / solution.deltaT))
        return min(self.steps, (step // interval + 1) * interval)

    def writes(self, first: int, last: int) -> list[int]:
        """Return the steps after ``first`` up to ``last`` at which results are written."""
        steps, step = [], first
        while step < min(last, self.steps) and (step := self.next_write(step)) <= last:
            steps.append(step)
        return steps

    @property
    def injector_names(self) -> tuple[str, ...]:
        """Names of the injection models, in the order of the codes in ``Particles.injector``."""
        return tuple(injection.name for injection in self.settings.injections)

    @property
    def patch_names(self) -> tuple[str, ...]:
        """Names of the flow's patches, in the order of the codes in ``Particles.patch``."""
        return tuple(patch.name for patch in self.cloud.flow.patches)


def prepare(
    case: PathLike[str] | str,
    time: float | str | None = None,
    dictionary: Path | None = None,
    threads: int | None = None,
    source: FlowSource | None = None,
    precompile: bool = False,
    outside_libs: bool = False,
    output: Path | str | None = None,
    overrides: Mapping[str, object] | None = None,
    flows: dict[FlowSource, Flow] | None = None,
    comm: Communicator | None = None,
) -> Job:
    """Read a case and place its particles.

    Parameters
    ----------
    case
        An OpenFOAM case folder.
    time
        Time of a steady flow: a value, or ``"latestTime"``, the default. Times of a transient flow, as
        :func:`foamprb.flow.read.case.select_times` selects them; all by default.
    dictionary
        Settings instead of ``constant/softCloudProperties``.
    threads
        Number of threads; all processors by default.
    source
        The mesh file or region to read, and the names of its fields, if they are not the usual ones.
    precompile
        Whether to compile the loop in a second process meanwhile, if it is not in the cache.
    outside_libs
        Whether Python files of ``libs`` may lie outside the case.
    output
        Folder of the results instead of ``postProcessing`` in the case.
    overrides
        Values that replace entries of the settings, by path: ``{"solution/deltaT": 1e-5}``. Sequences are
        lists, mappings are dictionaries.
    flows
        Steady flows of this case and time that have been read, by their sources; a new one is added.
    comm
        Processes of ``mpirun`` that advance the particles; by default this one alone.

    Raises
    ------
    InputError
        If the case, the flow or the settings cannot be used: what, where, and what is allowed.
    """
    case, comm = Path(case), comm or Communicator()
    source = source or FlowSource()
    check_region(case, source)
    settings = read_settings(case, dictionary, source.region, time_of_fluid(time), outside_libs, overrides)
    scale = settings.solution.scale if source.scale is None else source.scale
    settings = replace(settings, solution=replace(settings.solution, scale=scale))
    source = _with_fields(source, settings)
    compilation = Compilation()
    # A loop whose forces read fields depends on the kinds of these.
    if precompile and not any(force.needed_fields for force in settings.forces.values()):
        compilation.begin(*_loop(settings, bool(rotations_of(case, source)), source))
    log.info("Reading flow of case %s", case if source.file is None else source.file)
    with compilation.shown():
        flow = None if flows is None or settings.solution.transient else flows.get(source)
        if flow is None:
            times = FlowTimes(time, settings.solution.transient, settings.solution.period)
            flow = _open_flow(settings, case, times, source)
        if flows is not None and not settings.solution.transient:
            flows[source] = flow
        _log_notes(flow, settings)
        job = assemble(settings, flow, threads, comm)
    return replace(job, compilation=compilation, output=None if output is None else Path(output))


def time_of_fluid(time: float | str | None) -> float | str:
    """Return the time of the fluid's density and viscosity: of a range of times the latest."""
    return "latestTime" if time is None or re.search(r"[:,\s]", str(time)) else time


def _with_fields(source: FlowSource, settings: Settings) -> FlowSource:
    """Return a source with the fields and operators that the settings need."""
    scale = settings.solution.scale
    curved = settings.shape != "affine" or any(
        "curvature" in model.kernels for model in settings.surroundings.values()
    )
    readers: list[Any] = [*settings.functions.values(), *settings.forces.values()]
    return replace(
        source,
        scale=None if scale == 1.0 else scale,
        turbulent=bool(settings.dispersion),
        curved=curved,
        relative=settings.solution.rotatingZones == "relative",
        viscosity=settings.fluid.field,
        sampled=tuple(dict.fromkeys(name for reader in readers for name in reader.needed_fields)),
        accept=settings.solution.accept,
    )


def _log_notes(flow: Flow, settings: Settings) -> None:
    """Log the notes of a flow; raise InputError for faults that the settings do not accept."""
    faults: dict[str, str] = {}
    for note in flow.notes:
        if not isinstance(note, Caveat):
            log.info("    %s", note)
        elif note.fault and note.fault not in settings.solution.accept:
            faults.setdefault(note.fault, note)
        else:
            log.warning("%s", note)
    if faults:
        accept = f"solution/accept ( {' '.join((*settings.solution.accept, *faults))} )"
        raise InputError(f"{settings.case}: {' '.join(faults.values())} Allowed: to go on, {accept}.")


def _loop(settings: Settings, rotating: bool, source: FlowSource) -> tuple[Tracker, type[MeshFlow]]:
    """Return the loop that the settings select, as far as they determine it, and the class of the flow."""
    scheme = settings.solution.integrationSchemes.shape
    models = _models(settings, likely_integrator(settings) if scheme == "auto" else scheme, rotating)
    shaped = any(not isinstance(injection.shape, Sphere) for injection in settings.injections)
    tense = any(
        injection.solid.surfaceTension != 0.0 and not MATERIALS[injection.solid.type].liquid
        for injection in settings.injections
    )
    # Without the start, which the flow may delay, a power law may have one time more or less.
    if n_times := number_of_times(settings.injections, _span(settings, 0.0)):
        models = replace(models, surroundings=(FadingMemory(n_times=n_times), *models.surroundings))
    flow: type[MeshFlow] = RotatingFlow if rotating else MeshFlow
    if settings.solution.transient:
        flow, where = SeriesFlow, (settings.case, settings.region)
        if source.file is None and moves(*where):
            flow = MovingFlow if moves_rigidly(*where) else DeformingFlow
    dt, medium = settings.solution.deltaT, _medium(settings)
    return Tracker(models, flow.kernels, medium, [], dt, 0.0, shaped, tense), flow


def likely_integrator(settings: Settings) -> str:
    """Return the likely choice of ``auto`` before the flow is read.

    The shear rate is the reference; without it, a tenth of 1/Δt, a usual choice of Δt.
    """
    numbers, fluid, g = [0.0], settings.fluid, float(np.linalg.norm(settings.gravity))
    for injection in settings.injections:
        if injection.sizeDistribution is not None:
            rho, d = _most(injection.rho0), injection.sizeDistribution.limits[1]
            rate = injection.solid.referenceShearRate or 0.1 / settings.solution.deltaT
            mu = viscosity_at_rate(fluid.mu, rate)
            numbers.append(rate * float(relaxation_time(rho, 0.5 * d, mu)))
            tau = rho * d**2 / (18.0 * mu)
            numbers.append(tau**2 * abs(1.0 - fluid.rho / rho) * g / _WIDTH)
    return automatic(max(numbers), _material(settings))


def _most(quantity: float | Distribution) -> float:
    return quantity if isinstance(quantity, float | int) else quantity.limits[1]


def _medium(settings: Settings) -> Medium:
    return Medium(settings.fluid.mu, settings.fluid.rho, settings.gravity)


def _material(settings: Settings) -> str:
    return settings.injections[0].solid.material if settings.injections else Models.material


def _models(settings: Settings, integrator: str, rotating: bool = False) -> Models:
    schemes = settings.solution.integrationSchemes
    # Without any force g is zero: gravity then does nothing, in a loop that is compiled already.
    forces = tuple(settings.forces.values()) or Models.forces
    frames = (RotatingFrames(),) if rotating else ()
    if rotating and "SaffmanMeiLiftForce" in settings.surroundings:
        raise InputError(
            "SaffmanMeiLiftForce does not hold in rotating zones (MRFProperties): leave the force out, or "
            "set solution/rotatingZones absolute"
        )
    return Models(
        settings.traction,
        settings.drag,
        _material(settings),
        settings.touching,
        integrator,
        schemes.tolerance,
        forces,
        (*frames, *settings.dispersion.values(), *settings.surroundings.values(), *settings.fates.values()),
        stride=settings.solution.stride,
        roughness_share=schemes.roughnessShare,
        shape=settings.shape,
    )


def _open_flow(settings: Settings, case: Path, times: FlowTimes, source: FlowSource) -> Flow:
    """Return the flow of a case, with caveats of cells that overlap."""
    flow = _read_flow(settings, case, times, source)
    if isinstance(flow, MeshFlow):
        flow.notes += tuple(flow.overlap())
    return flow


def _read_flow(settings: Settings, case: Path, times: FlowTimes, source: FlowSource) -> Flow:
    time = times.selection
    if times.transient:
        return read_transient_flow(case, times.several, times.period, source)
    if isinstance(time, str) and re.search(r"[:,\s]", time):
        raise InputError(
            f"{settings.file}: solution/transient is no, but -time '{time}' selects several times: set "
            "transient yes, or select one time."
        )
    return read_flow(case, times.steady, source)


def assemble(
    settings: Settings,
    flow: Flow,
    threads: int | None = None,
    comm: Communicator | None = None,
) -> Job:
    """Place the particles of the settings in a flow.

    Raises
    ------
    InputError
        If a patch has no interaction or particles would start outside the flow.
    """
    interactions = match_patches(settings.patches, flow.patches, settings.file)
    medium = _medium(settings)
    start = _start(settings, flow)
    steps, end = _last_step(settings.solution, start)
    last = max(settings.solution.endTime, start + steps * settings.solution.deltaT)
    span, solid = _span(settings, start, flow), stopping(interactions)
    release = Release(settings.injections, flow, medium, span, last, solid)
    solids = sorted({injection.solid.material for injection in settings.injections})
    if len(solids) > 1:
        raise InputError(f"{settings.file}: one cloud has one type of solid, not {', '.join(solids)}.")
    comm = comm or Communicator()
    particles = comm.place(release.size, release.parts, release.n_times)
    solution = settings.solution
    models = _models(settings, solution.integrationSchemes.shape, bool(getattr(flow, "rotating", ())))
    by_name = {patch.name: i for patch, i in zip(flow.patches, interactions, strict=True)}
    models = replace(models, rebounds=any(f.needs_rebounds(by_name) for f in settings.functions.values()))
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
            limits=solution.limits,
            decoupled=[patch.name for patch in flow.patches if by_name[patch.name].code != CYCLIC],
            comm=comm,
            end=end,
            late=release.late,
        )
    except InputError as error:
        raise InputError(f"{settings.file}: {error}.") from error
    injectors = tuple(injection.name for injection in settings.injections)
    names = {"patch": tuple(patch.name for patch in flow.patches), "injector": injectors}
    try:
        functions = CloudFunctions(settings.functions, ObservedCloud(cloud, names))
    except InputError as error:
        raise InputError(f"{settings.file}: {error}") from error
    return Job(settings, cloud, functions)


def _span(settings: Settings, start: float, flow: Flow | None = None) -> tuple[float, float]:
    """Return the shortest and the longest time of a run, s, over which a power law holds.

    The shortest is Δt, or 1/γ̇ for the largest shear rate at the nodes of the flow: in shear, strain turns
    with γ̇, whatever Δt is. Ten relaxation times resolve :data:`RESOLVED`.
    """
    shortest, longest = settings.solution.deltaT, settings.solution.endTime - start
    if flow is not None and any(
        MATERIALS[injection.solid.type].power_law for injection in settings.injections
    ):
        ends = flow.ends_at_nodes(_rates)
        largest = float(ends[0][1]) if ends else 0.0
        shortest = min(shortest, max(1.0 / max(largest, 1e-300), longest / RESOLVED))
    return shortest, longest


def _rates(values: NodeValues) -> tuple[NDArray[np.float64]]:
    return (np.asarray(shear_rate(tuple(values.l.T))),)


def _start(settings: Settings, flow: Flow) -> float:
    """Return the first time of the flow, s, or 0; raise InputError if the flow ends before the run."""
    solution, (first, last) = settings.solution, flow.span
    start = first if math.isfinite(first) else 0.0
    if solution.endTime <= start:
        raise InputError(
            f"{settings.file}: solution/endTime is {solution.endTime:g}. Allowed: after {start:g}, the first "
            "time of the flow."
        )
    steps, end = _last_step(solution, start)
    end = min(end, start + steps * solution.deltaT)
    if end > last + TIME_TOLERANCE * abs(last):
        raise InputError(
            f"{settings.file}: solution/endTime is {solution.endTime:g}; the last step ends at {end:g}, "
            f"the flow at {last:g}. Allowed: up to that, or a flow that repeats itself (period)."
        )
    for injection in settings.injections:
        if START_OF_FLOW < injection.model.SOI < start:
            raise InputError(
                f"{settings.file}: injection model {injection.name}: SOI is {injection.model.SOI:g}. "
                f"Allowed: from {start:g} on, the first time of the flow."
            )
    return start


def _last_step(solution: Solution, start: float) -> tuple[int, float]:
    """Return the number of steps of the run, and the time at which a shorter last step ends, s, or inf."""
    steps = (solution.endTime - start) / solution.deltaT
    if abs(steps - round(steps)) <= MULTIPLE_TOLERANCE * min(1.0, steps):
        return round(steps), math.inf
    return math.ceil(steps), solution.endTime
