"""Initial settings, written by ``foamprb init``, with values from the case."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from foamprb.body.imex import relaxation_time
from foamprb.body.material import STEADY_CAPILLARY
from foamprb.body.quadratic import parts, resolved_strain, square
from foamprb.body.tensor import sym
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.integrators.registry import SMALL_STOKES
from foamprb.dictionary.constraints import Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Floats, Patch, PatchFaces
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.case import is_only_decomposed, regions
from foamprb.flow.read.caveats import MOVING, is_unsteady, pseudo_time, turbulence_fields
from foamprb.flow.read.describe import size_of
from foamprb.flow.read.field import VELOCITY_FIELD
from foamprb.flow.read.flows import check_region, open_case, read_flow
from foamprb.flow.read.fluid import (
    FILES,
    CaseViscosity,
    apparent_viscosity,
    find_density,
    fluid_file,
    mean_field,
    phase_values,
    phases_of,
    read_viscosity,
)
from foamprb.flow.read.mrf import read_rotations
from foamprb.flow.read.openfoam import transient_times
from foamprb.flow.read.processors import Processors
from foamprb.flow.read.source import FlowSource
from foamprb.flow.walk import curvature
from foamprb.run.validity import CURVED, are_curved
from foamprb.settings.fluid import of_region, read_gravity
from foamprb.settings.help import meaning, plain

log = logging.getLogger("foamprb")

NAME = "softCloudProperties"
PARTICLES = 1000
"""Approximate number of particles in a first run."""
_TIMES, _MOST_STEPS, _SAMPLES = 50, 5000, 300
"""Number of write times, largest number of steps, and approximate number of points of a path."""
_CAPILLARIES = {0.5: 0.1, 0.9: 0.4, 1.0: 2.0}
"""Capillary numbers of the initial stiffness at the largest rates on these shares of the paths."""
_STRAIN = 1.0
"""Largest strain on a path by extension in which a body has no steady shape."""
_ROUND_OFF = 1e-6
"""Speed over √(g L), and rate times L over the speed, below which they are round-off."""
_LEAST_WAY = 1e-4
"""Way in the solver's time, in cells, below which a fluid is at rest."""
_CROSSINGS, _WRITTEN = 100.0, 100.0
"""Longest run, over the time to cross the flow at the largest speed, and over an unsteady solver's."""
_PATHS, _MOVES, _MOVE = 200, 400, 0.5
"""Number of paths, of moves along each, and length of a move in cells."""


@dataclass(frozen=True)
class FlowScales:
    """Scales of a flow, from which the initial settings follow."""

    speed: float
    """Largest speed at cells and boundary, m/s; 0 for a fluid at rest."""
    step: float
    """Time in which the fluid crosses a fifth of a cell, s; the 5 % quantile."""
    duration: float
    """Time in which the fluid is replaced, or crosses a closed domain ten times, s."""
    shear: float
    """Mean shear rate, 1/s."""
    most_shear: float
    """Shear rate exceeded at one node in a thousand, 1/s."""
    cell: float
    """Size of a cell, m; the 5 % quantile."""
    volume: float
    """Volume of the domain, m³."""
    inlet: str
    """Patch through which most fluid enters; empty without inflow."""


def write_template(case: Path, source: FlowSource | None = None, output: Path | None = None) -> Path:
    """Write settings for a case, or for the region of the source.

    Parameters
    ----------
    case, source
        The case, and the source of its flow.
    output
        The file; by default ``constant/softCloudProperties`` in the case.

    Raises
    ------
    InputError
        If the file exists, which is not changed, or cannot be written, or the case has no mesh or no flow.
    """
    source = source or FlowSource()
    if not case.is_dir():
        raise InputError(f"{case}: no such folder.")
    check_region(case, source)
    file = output or case / "constant" / source.region / NAME
    present = output or case / of_region(case, source.region, NAME)
    if file.exists() or present.exists():
        raise InputError(
            f"{file if file.exists() else present} exists and is not changed. Check it with "
            f"foamprb run -dry-run{source.options}, or rename it to get a new one."
        )
    if not source.region and source.file is None and (names := regions(case)):
        log.info("The case has the regions %s: -region NAME. These settings are for the mesh beside them.",
                 ", ".join(names))  # fmt: skip
    flow = read_flow(case, "latestTime", _with_fractions(case, source))
    text = template(case, flow, source)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with file.open("x", encoding="utf-8") as out:
            out.write(text)
    except FileExistsError:
        raise InputError(f"{file} exists and is not changed.") from None
    except OSError as error:
        how = "" if output else " The option -output FILE writes the settings elsewhere, for run -dict FILE."
        raise InputError(f"{file}: {error.strerror}.{how}") from error
    return file


def template(case: Path, flow: MeshFlow, source: FlowSource) -> str:
    """Return the text of a dictionary for the flow of a case, and log the notes of the flow."""
    followed = _moving_times(case, flow, source)
    for note in flow.notes:
        if followed and isinstance(note, Caveat) and note.fault == MOVING:
            log.info("    The mesh moves: the run follows it from time %s to %s.", followed[0], followed[-1])
        elif isinstance(note, Caveat) or source.file:
            log.log(logging.WARNING if isinstance(note, Caveat) else logging.INFO, "%s", note)
    log.info("    %s", size_of(*flow.bounds, source.file is not None))
    scales = scales_of(flow)
    if _is_at_rest(case, flow, source, scales):
        scales = replace(scales, speed=0.0, inlet="")
    if followed and scales.inlet and _begins_at_rest(case, source):
        scales = replace(scales, inlet="")
    written = 0.0 if source.file else float(flow.at_nodes()[0])
    if written > 0.0 and is_unsteady(case, source.region):
        scales = replace(scales, duration=min(scales.duration, _WRITTEN * written))
    fluid = _fluid(case, flow, source, scales)
    for line in fluid.remarks:
        log.info("    %s", " ".join(line.removeprefix("// ").split()))
    rho0 = 1000.0 if fluid.rho is not None and fluid.rho <= 500.0 else 1050.0
    rotating = _rotating(case, flow, source)
    d = diameter(scales, fluid.nu or math.inf, rho0 / fluid.rho if fluid.rho and len(rotating) > 1 else 0.0)
    step, interval, end = times(scales)
    if followed:
        end, span = float(followed[-1]), float(followed[-1]) - float(followed[0])
        interval = step * _nice(max(1.0, span / step / _TIMES), up=True)
    paths = rates_on_paths(flow, scales, 0.5 * d) if scales.speed > 0.0 else None
    changes = [*rotating, *([] if rotating and not followed else _transient(case, source, followed))]
    scale = [f"scale {source.scale:g}; // {_said('solution', 'scale')}"] if source.scale else []
    text = f"""\
// Initial settings by foamprb init, from the case. Check: foamprb run -dry-run{source.options}.
// Explain an entry: foamprb help ENTRY. Change first: diameter, density and stiffness of the particles.
FoamFile
{{
    version     2.0;
    format      ascii;
    class       dictionary;
    object      {NAME};
}}

solution
{{
    deltaT {step:g}; // {_said("solution", "deltaT", "a fifth of a cell in the flow")}
    endTime {end:g}; // {_said("solution", "endTime")}
    writeInterval {interval:g}; // {_said("solution", "writeInterval")}
{_lines([*scale, *_faults(flow, followed), *changes, *fluid.options])}}}

constantProperties
{{
    rho0 {rho0:g}; // {_said("constantProperties", "rho0")}
{_lines(fluid.lines)}
    solid
    {{
        type neoHooke; // all types: foamprb help solid
{_lines(_stiffness(flow, scales, fluid.mu, paths), 8)}    }}
}}

subModels
{{
    particleForces
    {{
        ellipsoidDrag;
        {_gravity(case, source.region)}
    }}

{_lines(_shape_model(paths))}{_lines(_dispersion(case, flow, source))}    injectionModels
    {{
{_lines(_injection(scales, end, d), 8)}    }}

{_lines(_interaction(flow.patches))}}}

cloudFunctions
{{
    paths
    {{
        type particleTracks; // for foamprb view and foamprb report
        trackInterval {max(1, round(end / step / _SAMPLES))}; // steps
        maxSamples 1000;
        maxTracks 200;
    }}
    // exposure {{ type particleHistogram; }} // of each particle to shear; slow with more than 1e5 particles
}}
"""
    return re.sub(r"^( *)(\w+)(?: ([^{}\n]*?))?;(?: // (.*))?$", _aligned, text, flags=re.MULTILINE)


def _aligned(entry: re.Match[str]) -> str:
    """Return an entry with its value and its comment in columns."""
    indent, key, value, comment = entry.groups()
    text = f"{key:19} {value.strip()};" if value else f"{key};"
    return indent + (f"{text:35} // {comment}" if comment else text)


def _lines(lines: Sequence[str], by: int = 4) -> str:
    """Return indented lines, each with a line break."""
    return "".join(" " * by + line + "\n" if line else "\n" for line in lines)


def scales_of(flow: MeshFlow) -> FlowScales:
    """Return the scales of a flow on a mesh."""
    _, u, l = flow.at_nodes()
    speeds = np.linalg.norm(u, axis=1)
    rates = np.asarray(shear_rate(tuple(l[flow.mesh.n_points :].T)))
    everywhere = np.asarray(shear_rate(tuple(l.T)))
    volumes = np.maximum(flow.mesh.volumes, 0.0)
    sizes = np.cbrt(volumes)
    volume, speed = float(volumes.sum()), float(speeds.max())
    moving = speeds[flow.mesh.n_points :]
    length = float(np.linalg.norm(flow.bounds[1] - flow.bounds[0]))
    crossing = sizes[moving > 1e-3 * speed] / moving[moving > 1e-3 * speed] if speed > 0.0 else np.empty(0)
    step = 0.2 * float(np.quantile(crossing, 0.05)) if len(crossing) else 0.0
    inlet, rate_of_flow = _inlet(flow, speed, volume)
    duration = 1.0
    if speed > 0.0:
        duration = (
            min(2.0 * volume / rate_of_flow, _CROSSINGS * length / speed) if inlet else 10.0 * length / speed
        )
    return FlowScales(
        speed,
        step or (0.2 * float(np.quantile(sizes, 0.05)) / speed if speed > 0.0 else 0.0),
        duration,
        float(np.average(rates, weights=volumes)) if volume > 0.0 else 0.0,
        float(np.quantile(everywhere, 0.999)),
        float(np.quantile(sizes, 0.05)),
        volume,
        inlet,
    )


def _is_at_rest(case: Path, flow: MeshFlow, source: FlowSource, scales: FlowScales) -> bool:
    """Return True if the velocities are round-off: against waves by gravity, or in the solver's time."""
    try:
        g = float(np.linalg.norm(read_gravity(case, source.region)))
    except InputError:
        g = 0.0
    if scales.speed < _ROUND_OFF * math.sqrt(g * float(np.linalg.norm(flow.bounds[1] - flow.bounds[0]))):
        return True
    time = "" if source.file is not None or pseudo_time(case, source.region) else flow.at_nodes()[0]
    return 0.0 < float(time or 0.0) * scales.speed < _LEAST_WAY * scales.cell


def _begins_at_rest(case: Path, source: FlowSource) -> bool:
    """Return True if the velocity is zero in all cells and on all patches at the first time of a case."""
    opened = open_case(case, source)
    first = transient_times(opened, None, source.velocity)[0][0]
    field = opened.field(first, source.velocity, VELOCITY_FIELD)
    given = [values for entry in field.patches.values() for values in entry.fields.values()]
    return not any(np.any(values) for values in (field.cells, *given))


def _inflow(faces: PatchFaces) -> Floats:
    """Return the inflow through the triangles of a patch, m³/s; 0 where the fluid leaves.

    If it enters through none of them, but at some corners, these are their areas.
    """
    rates: Floats = np.einsum("tvi,ti->t", faces.velocity, faces.normals).clip(0.0) * faces.areas / 3.0
    return rates if rates.any() else faces.areas


class _Paths(NamedTuple):
    """Rates on paths of the fluid, 1/s."""

    shear: Floats
    """(n,), the largest on each path."""
    curvature: Floats
    """(n,), the curvature number of a body on each path, 1."""
    extension: Floats
    """(moves, n), the rate of extension times √3, the shear rate in uniaxial extension; 0 behind the end."""
    duration: Floats
    """(moves, n), s."""

    def strain(self, limit: float) -> float:
        """Return the largest strain on a path where the extension exceeds a limit, 1/s."""
        return float((np.maximum(self.extension - limit, 0.0) * self.duration).sum(axis=0).max())


def rates_on_paths(flow: MeshFlow, scales: FlowScales, radius: float) -> _Paths:
    """Return the rates on some paths of the fluid, from the inlet or from all cells.

    The curvature numbers are those of bodies of a radius, m.
    """
    random = np.random.default_rng(1)
    if scales.inlet:
        faces = flow.patch_faces(scales.inlet, 0.0)
        inflow = _inflow(faces)
        rows = random.choice(len(inflow), _PATHS, p=inflow / inflow.sum())
        x, hosts = faces.vertices[rows].mean(axis=1), faces.hosts[rows]
    else:
        x = flow.mesh.centres[random.integers(flow.mesh.n_cells, size=_PATHS)]
        hosts = flow.locate(x)
    paths = _Paths(*np.zeros((2, len(x))), *np.zeros((2, _MOVES, len(x))))
    moving, strain = np.flatnonzero(hosts >= 0), np.zeros(len(x))
    for move in range(_MOVES):
        u, l = flow.sample(x[moving], hosts[moving], 0.0)
        rate = np.asarray(shear_rate(tuple(l.reshape(-1, 9).T)))  # type: ignore[arg-type]
        paths.shear[moving] = np.maximum(paths.shear[moving], rate)
        second: Any = curvature(flow.arrays(), hosts[moving], tuple(x[moving].T), 0.0)  # type: ignore[arg-type]
        E: Any = sym(tuple(l.reshape(-1, 9).T))  # type: ignore[arg-type]
        speed = np.linalg.norm(u, axis=1)
        step = _MOVE * flow.cell_size(hosts[moving]) / np.maximum(speed, 1e-300)
        paths.curvature[moving] += step * radius * np.sqrt(square(parts(second).S))
        strain[moving] += step * resolved_strain(radius, E, tuple(u.T))
        paths.extension[move, moving] = math.sqrt(3.0) * np.linalg.eigvals(l).real.max(axis=1)
        paths.duration[move, moving] = np.where(speed > 0.0, step, 0.0)
        x[moving] += step[:, None] * u
        hosts[moving] = flow.locate(x[moving])
        moving = moving[(hosts[moving] >= 0) & (speed > 0.0)]
    paths.curvature[:] /= np.maximum(strain, 1e-300)
    return paths


def _inlet(flow: MeshFlow, speed: float, volume: float) -> tuple[str, float]:
    """Return the patch through which most fluid enters, and the inflow through all patches, m³/s."""
    rates = {}
    for patch in flow.patches:
        if patch.kind is not PatchKind.OPENING:
            continue
        try:
            faces = flow.patch_faces(patch.name, 0.0)
        except InputError:
            continue
        inflow = np.maximum(np.einsum("tvi,ti->tv", faces.velocity, faces.normals), 0.0)
        rates[patch.name] = float((inflow.mean(axis=1) * faces.areas).sum())
    total = sum(rates.values())
    # Round-off and weak recirculation are no inflow.
    if total <= 1e-6 * speed * volume ** (2.0 / 3.0):
        return "", 0.0
    return max(rates, key=lambda name: rates[name]), total


def times(scales: FlowScales) -> tuple[float, float, float]:
    """Return step, write interval and end of a first run, s: integer multiples of each other, rounded."""
    if scales.speed == 0.0:
        return 0.01, 0.02, 1.0
    shortest = scales.duration / _MOST_STEPS
    step = _nice(max(shortest, min(scales.step, scales.duration / (4 * _TIMES))), up=scales.step < shortest)
    steps = _nice(max(1.0, scales.duration / step / _TIMES), up=True)
    return step, step * steps, step * steps * _TIMES


def diameter(scales: FlowScales, nu: float, ratio: float = 0.0) -> float:
    """Return a diameter, m, for the cells and for Stokes flow (γ̇ d²/ν below 0.05), at most 10 µm.

    ``ratio`` is the density of the solid over that of the fluid if the solid's inertia must be small, too.
    """
    largest = min(0.05, 0.5 * SMALL_STOKES / relaxation_time(ratio, 0.5, 1.0)) if ratio > 0.0 else 0.05
    stokes = math.sqrt(largest * nu / scales.most_shear) if scales.most_shear > 0.0 else math.inf
    return _nice(min(1e-5, 0.2 * scales.cell, stokes), up=False)


def _nice(value: float, *, up: bool) -> float:
    """Return the nearest of 1, 2, 5, 10, … that is not above the value, or not below it if ``up``."""
    power = math.floor(math.log10(value))
    steps = [float(f"{m}e{e}") for e in (power - 1, power, power + 1) for m in (1, 2, 5)]
    slack = 1e-9 * value
    return min(s for s in steps if s >= value - slack) if up else max(s for s in steps if s <= value + slack)


def _rounded(value: float) -> float:
    return float(f"{value:.1e}")


class _Fluid(NamedTuple):
    """Fluid of a case, as far as the case has it."""

    rho: float | None
    """kg/m³."""
    nu: float | None
    """m²/s."""
    mu: float | None
    """Pa s."""
    lines: list[str]
    """Lines of ``constantProperties``."""
    remarks: list[str]
    """About values that are assumed or missing, and phases, for the log."""
    options: list[str]
    """Lines of ``solution``."""


def _unknown(key: str, unit: str, why: str) -> list[str]:
    """Return comments in place of an entry that the case does not have."""
    return [f"// {key:12s}unknown: {why}", f"// {'':12s}set {key}, {unit}"]


def _fluid(case: Path, flow: MeshFlow, source: FlowSource, scales: FlowScales) -> _Fluid:
    """Return the fluid of a case; one that is not Newtonian at the mean shear rate."""
    phases = _phases(case, flow, source, scales)
    if phases is not None:
        return phases
    file = fluid_file(case, source.region)
    where = f"constant/{FILES[0]}" if file is None else f"constant/{file.relative_to(case / 'constant')}"
    time = None if source.file else "latestTime"
    nu: float | None = None
    mu: float | None = None
    lines, why = list[str](), f"{where} {'does not exist' if file is None else 'has none that is read'}"
    if file is not None:
        try:
            nu, mu, lines = _viscosity(file, case, source.region, time, scales.shear, where)
        except InputError as error:
            why = " ".join(str(error).split(". ")[0].split())
    lines = lines or _unknown("nu", "m2/s, or mu, Pa s", why)
    density = None
    with suppress(InputError):
        density = find_density(case, source.region, file, "latestTime")
    if density is not None:
        rho: float | None = density[0]
        lines.append(f"// {'rhoInf':12s}{rho:.4g}: from {density[1]}")
    elif nu is None:
        rho = None
        lacks = "the case has no density, and no p and T at the latest time that give one"
        lines += _unknown("rhoInf", "kg/m3", lacks)
    else:
        # Solvers of incompressible flow have none. Gases have about 1e-5 m²/s.
        rho, like = (1.2, "air") if 5e-6 <= nu <= 1e-4 else (1000.0, "water")
        lines.append(f"rhoInf {rho:g}; // kg/m3, assumed: the case has no density; like {like}")
    if rho is not None:
        nu, mu = (nu, nu * rho) if nu is not None else (mu / rho if mu is not None else None, mu)
    remarks = [line for line in lines if "unknown: " in line or "assumed: " in line]
    return _Fluid(rho, nu, mu, lines, remarks, [])


def _viscosity(
    file: Path, case: Path, region: str, time: str | None, rate: float, where: str
) -> tuple[float | None, float | None, list[str]]:
    """Return a viscosity, m²/s or else Pa s, and its entry or a comment.

    Raises
    ------
    InputError
        It is unknown.
    """
    try:
        return _typical(read_viscosity(file, case, None, region, time), rate, where)
    except InputError:
        mean = mean_field(case, region, "latestTime", "T")
        if mean is None:
            raise
        T = float(f"{mean[0]:.4g}")
        if (law := apparent_viscosity(read_dictionary(file, case), rate, T)) is not None:
            nu = float(f"{law[1]:.4g}")
            return nu, None, [f"nu {nu:g}; // m2/s, {law[0]} of {where} at {rate:.3g} 1/s, {T:g} K"]
        nu_of_T, mu, temperature = read_viscosity(file, case, T)[:3]
        if temperature is None:
            raise
        return nu_of_T, mu, [f"TInf {T:g}; // {_said('constantProperties', 'TInf')}, mean of T at {mean[1]}"]


def _typical(
    viscosity: CaseViscosity, rate: float, where: str
) -> tuple[float | None, float | None, list[str]]:
    """Return a viscosity, m²/s or else Pa s, and a comment: one that varies at a rate, 1/s, or its mean."""
    nu, mu, at = viscosity.nu, viscosity.mu, "on average"
    if viscosity.law is not None:
        nu, at = viscosity.law(rate), f"at {rate:.3g} 1/s"
    elif viscosity.field is not None:
        nu, mu = (viscosity.field.mean, None) if viscosity.field.kinematic else (None, viscosity.field.mean)
    name, value, unit = ("mu", mu, "Pa s") if nu is None else ("nu", nu, "m2/s")
    comment = (
        f"local, by {viscosity.origin}; {value:.4g} {unit} {at}"
        if viscosity.origin
        else f"{value:g}: from {where}"
    )
    return nu, mu, [f"// {name:12s}{comment}"]


def _with_fractions(case: Path, source: FlowSource) -> FlowSource:
    """Return the source of a flow with the volume fractions of its phases at the latest time."""
    phases: Sequence[str] = ()
    with suppress(InputError):
        phases = tuple(phases_of(case, source.region))
    if source.file is not None or not phases:
        return source
    opened = open_case(case, source)
    fields = opened.fields(opened.select_time("latestTime"))
    names = [f"alpha.{name}" for name in phases if fields.get(f"alpha.{name}") == "volScalarField"]
    return replace(source, sampled=tuple(names))


def _shares(flow: MeshFlow, scales: FlowScales, phases: Sequence[str]) -> dict[str, float]:
    """Return the shares of phases in the volume that is released from: the inflow, or all cells.

    The fraction of one phase may follow from the others; else nothing is known without fields.
    """
    if scales.inlet:
        faces = flow.patch_faces(scales.inlet, 0.0)
        values = flow.fields(0.0, 0.0).at(faces.vertices.mean(axis=1), faces.hosts, 0.0)
        fractions, weights = {name: field.array for name, field in values.items()}, _inflow(faces)
    else:
        table = flow.field_table[flow.mesh.n_points :]
        fractions = {column.name: table[:, k] for k, column in enumerate(flow.field_columns)}
        weights = np.maximum(flow.mesh.volumes, 0.0)
    shares = {
        name: float(np.average(fractions[f"alpha.{name}"].clip(0.0, 1.0), weights=weights))
        for name in phases
        if f"alpha.{name}" in fractions
    }
    others = [name for name in phases if name not in shares]
    if len(others) > 1:
        return {}
    return shares | {name: 1.0 - sum(shares.values()) for name in others}


def _phases(case: Path, flow: MeshFlow, source: FlowSource, scales: FlowScales) -> _Fluid | None:
    """Return the phase of the velocity, such as ``U.air``, or that with the most volume at the release.

    The others are in comments. Returns None without phases.
    """
    try:
        phases = phases_of(case, source.region)
    except InputError:
        return None
    if not phases:
        return None
    shares = _shares(flow, scales, tuple(phases))
    of_velocity = source.velocity.partition(".")[2]
    main = of_velocity if of_velocity in phases else max(shares, key=lambda name: shares[name], default="")
    time = flow.at_nodes()[0]
    where = (
        f"{100.0 * shares[main]:.4g} % of the {'inflow' if scales.inlet else 'volume'}"
        if main in shares
        else ""
    )
    why = f", {where} at time {time}" if where else ", of the velocity" if main else ""
    lines, rho, nu, complete = list[str](), None, None, len(phases) == 2
    for name in sorted(phases, key=lambda name: name != main):
        pair = phase_values(case, source.region, name, phases[name], scales.shear, "latestTime")
        start = "" if name == main else "// "
        for key, value, unit in zip(("nu", "rhoInf"), pair, ("m2/s", "kg/m3"), strict=True):
            if value is None:
                complete = False
                lines += _unknown(key, unit, f"{name} has none that is read")
            else:
                lines.append(f"{start}{key} {value:.6g}; // {unit}, of {name}{'' if start else why}")
        if name == main:
            nu, rho = pair
    if not main:
        lines.insert(0, f"// unknown: the phase of the particles; no field alpha.{next(iter(phases))}")
    options = []
    if complete and shares and not of_velocity:
        options = [
            f"// mixture true; // local nu and rho of {' and '.join(phases)}, in place of nu and rhoInf"
        ]
    said = f"Particles move in {main}{why}." if main else "The phase of the particles is unknown."
    return _Fluid(rho, nu, nu * rho if nu and rho else None, lines, [said], options)


def _rotating(case: Path, flow: MeshFlow, source: FlowSource) -> list[str]:
    """Return entries for the rotating zones of ``MRFProperties``."""
    if source.file is not None:
        return []
    try:
        zones = read_rotations(case, source.region)
        for zone in zones:
            flow.cell_zone(zone.zone)
    except InputError:
        return ["rotatingZones absolute; // MRFProperties has features that are not modelled"]
    if not zones:
        return []
    names = ", ".join(zone.name for zone in zones)
    return [
        f"rotatingZones relative; // {names} of MRFProperties; absolute: as with fixed blades",
        "integrationSchemes  { shape stokes; } // required for rotating zones",
    ]


def _shape_model(paths: _Paths | None) -> list[str]:
    """Return the entry of the quadratic mode if the flow is curved over the bodies on its paths."""
    if paths is None or not are_curved(paths.curvature):
        return []
    share = 100.0 * np.mean(paths.curvature > CURVED)
    return [
        f"shapeModel quadratic; // curvature number over {CURVED:g} on {share:.2g} % of the paths; or affine",
        "",
    ]


def _stiffness(flow: MeshFlow, scales: FlowScales, mu: float | None, paths: _Paths | None) -> list[str]:
    """Return the entries of the stiffness by the rates on paths of the fluid; of a viscosity, Pa s."""
    length = float(np.linalg.norm(flow.bounds[1] - flow.bounds[0]))
    largest = np.zeros(0) if paths is None else paths.shear[paths.shear * length > _ROUND_OFF * scales.speed]
    rate, over_mu, where = 1.0, 1.0 / _CAPILLARIES[0.5], "as the fluid is at rest"
    if len(largest):
        rate, where = float(np.median(largest)), "the largest on half of the paths"
        over_mu = max(float(np.quantile(largest, q)) / Ca for q, Ca in _CAPILLARIES.items())
        while paths and paths.strain(STEADY_CAPILLARY * over_mu) > _STRAIN:
            over_mu *= 1.1
    elif paths:
        where = "as the flow is uniform"
    lines = ["poissonsRatio 0.499; // nearly incompressible"]
    if mu is None:
        return [*lines, f"Ca {_rounded(rate / over_mu):g}; // capillary number",
                f"referenceShearRate {_rounded(rate):g}; // 1/s, {where}"]  # fmt: skip
    modulus = _rounded(mu * over_mu)
    said = f"Pa; Ca = {mu * rate / modulus:.2g} at {rate:.2g} 1/s, {where}"
    return [*lines, f"shearModulus {modulus:g}; // {said}"]


def _dispersion(case: Path, flow: MeshFlow, source: FlowSource) -> list[str]:
    """Return the entry of a dispersion model if the case has the fields of a mean turbulent flow."""
    if source.file is not None:
        return []
    divided = source.decomposed or is_only_decomposed(case, source.region)
    folder = Processors(case).folders[0] if divided else case
    fields = turbulence_fields(folder / flow.at_nodes()[0] / source.region)
    if not fields:
        return []
    return [f"dispersionModel none; // or stochasticDispersionRAS: {' and '.join(fields)} are available", ""]


def _moving_times(case: Path, flow: MeshFlow, source: FlowSource) -> list[str]:
    """Return the names of the times of a mesh that moves, if a run can follow it."""
    faults = [note.fault for note in flow.notes if isinstance(note, Caveat)]
    names, unread = _written(case, source) if MOVING in faults else ([], [])
    return [] if unread or len(names) < 2 else names


def _faults(flow: MeshFlow, followed: Sequence[str]) -> list[str]:
    """Return a hint if a flow has faults with which a run ends; a motion that is followed is none."""
    caveats = [note for note in flow.notes if isinstance(note, Caveat) and note.fault]
    caveats = [note for note in caveats if not (followed and note.fault == MOVING)]
    faults = " ".join(dict.fromkeys(caveat.fault for caveat in caveats))
    return [f"// accept ( {faults} ); // to go on, although {caveats[0].split(':')[0]}"] if caveats else []


def _written(case: Path, source: FlowSource) -> tuple[list[str], list[str]]:
    """Return the names of the times after 0 of a case, and why they are no transient flow; none of a file."""
    if source.file is not None:
        return [], []
    try:
        names, notes = transient_times(open_case(case, source), None, source.velocity)
    except InputError:
        return [], []
    faults = [note.split(":")[0] for note in notes if isinstance(note, Caveat) and note.fault]
    return [name for name in names if float(name) > 0.0], faults


def _transient(case: Path, source: FlowSource, followed: Sequence[str]) -> list[str]:
    """Return the entry of a transient flow, as a hint unless the mesh moves."""
    if followed:
        return [f"transient true; // the mesh moves, times {followed[0]} to {followed[-1]}"]
    names, faults = _written(case, source)
    if len(names) < 2:
        return []
    return [f"// no transient flow: {fault}" for fault in faults] or [
        f"// transient       true;   // transient flow, times {names[0]} to {names[-1]}; default: the latest"
    ]


def _injection(scales: FlowScales, end: float, d: float) -> list[str]:
    """Return an injection model."""
    duration = _rounded(0.2 * end)
    rate = _said("injections", "parcelsPerSecond", model="patchInjection")
    lines = [
        "type patchInjection;",
        f"patch {_word(scales.inlet)}; // largest inflow",
        f"parcelsPerSecond {_rounded(PARTICLES / duration):g}; // {rate}",
        f"duration {duration:g}; // s",
    ]
    if not scales.inlet:
        density = _rounded(PARTICLES / scales.volume)
        lines = [
            "type cellZoneInjection; // no patch has inflow at the start",
            "selectionMode all; // all cells",
            f"numberDensity {density:g}; // 1/m3, of {scales.volume:.3g} m3",
        ]
    value = [f"value {d:g}; // m, diameter; cells are {scales.cell:.2g} m"]
    law = ["type fixedValue; // or: foamprb help distributions", *braces("fixedValueDistribution", value)]
    return braces("particles", [*lines, "", *braces("sizeDistribution", law)])


def _gravity(case: Path, region: str) -> str:
    """Return the entry of gravity, or a comment if the case has no gravity."""
    file = of_region(case, region, "g")
    try:
        g: Vector3 = read_gravity(case, region)
    except InputError:
        return "// gravity;            // the case has no constant/g"
    if not any(g):
        return f"// gravity;            // {file} is zero"
    return f"gravity; // less buoyancy; {file}: ({g[0]:g} {g[1]:g} {g[2]:g}) m/s2"


def _interaction(patches: Sequence[Patch]) -> list[str]:
    """Return the patch interaction model with its coefficients."""
    rules = ["patches", "(", *(f"    {line}" for line in _patches(patches)), ");"]
    return ["patchInteractionModel localInteraction;", "", *braces("localInteractionCoeffs", rules)]


def _patches(patches: Sequence[Patch]) -> list[str]:
    """Return the rules of patches."""
    choice, lines = "or rebound, escape", []
    walls, openings, coupled = (
        [patch for patch in patches if patch.kind is kind]
        for kind in (PatchKind.WALL, PatchKind.OPENING, PatchKind.COUPLED)
    )
    for patch in openings:
        why = "" if patch.type == "patch" else f" // {patch.type}"
        lines.append(f"{_word(patch.name):20s}{{ type escape; }}{why}")
    for patch in coupled:
        why = f"particles cannot pass a {patch.type}; or stick, escape"
        lines.append(f"// {_word(patch.name):20s}{{ type rebound; }} // {why}")
    if len(walls) > 6:
        lines.append(f"{'wall':20s}{{ type stick; }} // all {len(walls)} walls; {choice}")
    else:
        lines += [f"{_word(patch.name):20s}{{ type stick; }} // wall; {choice}" for patch in walls]
    others = [
        f"{patch.name} ({patch.type})" for patch in patches if patch not in (*walls, *openings, *coupled)
    ]
    if others:
        more = ", …" if len(others) > 4 else ""
        lines.append(f"// without entry: {', '.join(others[:4])}{more}")
    return lines


def braces(key: str, lines: Sequence[str]) -> list[str]:
    """Return the lines of a dictionary."""
    return [key, "{", *(f"    {line}" if line else "" for line in lines), "}"]


def _said(section: str, entry: str, more: str = "", model: str = "") -> str:
    """Return the unit of an entry and the first clause of its documentation."""
    text = meaning(section, entry, model)
    said = re.split(r"[;:,]", plain(text.meaning))[0]
    unit = text.unit.replace("³", "3").replace("²", "2")
    return ", ".join(filter(None, (unit, said, more)))


def _word(name: str) -> str:
    """Return a name as a keyword; a name that is no word is quoted and escaped as a regular expression."""
    return name if re.fullmatch(r"[A-Za-z_][\w.:+-]*", name) else f'"{re.escape(name)}"'
