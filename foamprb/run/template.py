"""Initial settings, written by ``foamprb init``, with values from the case."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.body.imex import relaxation_time
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.integrators.registry import SMALL_STOKES
from foamprb.dictionary.constraints import Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Patch
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.case import is_only_decomposed
from foamprb.flow.read.caveats import turbulence_fields
from foamprb.flow.read.flows import check_region, open_case, read_flow
from foamprb.flow.read.fluid import (
    CaseViscosity,
    apparent_viscosity,
    density_of_state,
    fluid_file,
    is_gas,
    mean_density,
    mean_pressure,
    mean_temperature,
    phase_values,
    phases_of,
    read_density,
    read_viscosity,
)
from foamprb.flow.read.mrf import read_rotations
from foamprb.flow.read.openfoam import transient_times
from foamprb.flow.read.processors import Processors
from foamprb.flow.read.source import FlowSource
from foamprb.settings.fluid import of_region, read_gravity
from foamprb.settings.help import meaning, plain
from foamprb.settings.solution import STRIDE

__all__ = ["FlowScales", "scales_of", "template", "write_template"]

log = logging.getLogger("foamprb")

NAME = "softCloudProperties"
PARTICLES = 1000
"""Approximate number of particles in a first run."""
_TIMES, _MOST_STEPS, _SAMPLES = 50, 5000, 300
"""Number of write times, largest number of steps, and approximate number of points of a path."""
_CAPILLARY, _MOST_CAPILLARY = 0.1, 0.4
"""Capillary numbers of the initial stiffness, at the largest rates on half and on 90 % of the paths.

Extension may tear softer bodies apart.
"""
_TEMPERATURE, _PRESSURE = 300.0, 1e5
"""Temperature of a fluid, K, and its pressure, Pa, if they matter and the case does not have them."""
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

    Returns
    -------
    The file.

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
    flow = read_flow(case, "latestTime", source)
    for note in flow.notes if source.file else ():
        log.log(logging.WARNING if isinstance(note, Caveat) else logging.INFO, "%s", note)
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
    """Return the text of a dictionary for the flow of a case."""
    scales = scales_of(flow)
    rho, nu, fluid = _fluid(case, source, scales.shear)
    rho0 = 1050.0 if rho > 500.0 else 1000.0
    rotating = _rotating(case, flow, source)
    d = diameter(scales, nu, rho0 / rho if len(rotating) > 1 else 0.0)
    step, interval, end = times(scales)
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
{_lines([*scale, *_faults(flow), *(rotating or _transient(case, source))])}}}

constantProperties
{{
    rho0 {rho0:g}; // {_said("constantProperties", "rho0")}
{_lines(fluid)}
    solid
    {{
        type neoHooke; // all types: foamprb help solid
{_lines(_stiffness(flow, scales, rho * nu), 8)}    }}
}}

subModels
{{
    particleForces
    {{
        ellipsoidDrag;
        {_gravity(case, source.region)}
    }}

{_lines(_dispersion(case, flow, source))}    injectionModels
    {{
{_lines(_injection(scales, end, d), 8)}    }}

{_lines(_interaction(flow.patches))}}}

cloudFunctions
{{
    paths
    {{
        type particleTracks; // for foamprb view and foamprb report
        trackInterval {STRIDE * max(1, round(end / step / _SAMPLES / STRIDE))}; // steps
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
    nodes = flow.arrays().nodes
    speeds = np.linalg.norm(nodes[:, 3:6], axis=1)
    cells = nodes[flow.mesh.n_points :]
    rates = np.asarray(shear_rate(tuple(cells[:, 6:15].T)))
    everywhere = np.asarray(shear_rate(tuple(nodes[:, 6:15].T)))
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
        duration = 2.0 * volume / rate_of_flow if inlet else 10.0 * length / speed
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


def rates_on_paths(flow: MeshFlow, scales: FlowScales) -> NDArray[np.float64]:
    """Return the largest shear rate on some paths of the fluid, 1/s, from the inlet or from all cells."""
    random = np.random.default_rng(1)
    if scales.inlet:
        faces = flow.patch_faces(scales.inlet, 0.0)
        inflow = np.einsum("tvi,ti->t", faces.velocity, faces.normals).clip(0.0) * faces.areas
        rows = random.choice(len(inflow), _PATHS, p=inflow / inflow.sum())
        x, hosts = faces.vertices[rows].mean(axis=1), faces.hosts[rows]
    else:
        x = flow.mesh.centres[random.integers(flow.mesh.n_cells, size=_PATHS)]
        hosts = flow.locate(x)
    largest = np.zeros(len(x))
    moving = np.flatnonzero(hosts >= 0)
    for _ in range(_MOVES):
        u, l = flow.sample(x[moving], hosts[moving], 0.0)
        rate = np.asarray(shear_rate(tuple(l.reshape(-1, 9).T)))  # type: ignore[arg-type]
        largest[moving] = np.maximum(largest[moving], rate)
        speed = np.linalg.norm(u, axis=1)
        step = _MOVE * flow.cell_size(hosts[moving]) / np.maximum(speed, 1e-300)
        x[moving] += step[:, None] * u
        hosts[moving] = flow.locate(x[moving])
        moving = moving[(hosts[moving] >= 0) & (speed > 0.0)]
    return largest


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


def _fluid(case: Path, source: FlowSource, rate: float) -> tuple[float, float, list[str]]:
    """Return density and kinematic viscosity of the fluid, and entries for values that the case lacks.

    ``rate`` is the shear rate, 1/s, at which a fluid that is not Newtonian is taken.
    """
    phases = _phases(case, source, rate)
    if phases:
        return phases
    file = fluid_file(case, source.region)
    where = "" if file is None else f"constant/{file.relative_to(case / 'constant')}"
    nu: float | None = None
    mu: float | None = None
    lines: list[str] = []
    try:
        if file is not None:
            time = None if source.file else "latestTime"
            viscosity = read_viscosity(file, case, None, source.region, time)
            nu, mu, lines = _typical(viscosity, rate, where)
    except InputError as error:
        assert file is not None
        try:
            T, origin = _temperature(case, source.region)
            nu, mu, temperature = read_viscosity(file, case, T)[:3]
            if temperature is None:
                raise error
            lines.append(f"TInf {T:g}; // {_said('constantProperties', 'TInf')}{origin}")
        except InputError:
            nu, what = _viscosity_of_model(file, case, rate, _temperature(case, source.region)[0])
            lines.append(
                f"nu {nu:g}; // m2/s, kinematic viscosity; {what or f'{where} has no constant value'}"
            )
    if nu is None and mu is None:
        nu = 1e-6
        lines.append("nu 1e-06; // m2/s, kinematic viscosity; not in the case: like water")
    rho, origin = _density(case, file, source.region, where)
    if rho is not None:
        lines.append(f"// {'rhoInf':12s}{rho:g}: from {origin}")
    else:
        rho, origin = _density_of_state(case, file, source.region)
        if rho is None:
            # Gases have about 1e-5 m²/s, or 1e-5 Pa s.
            water = mu > 1e-4 if nu is None and mu is not None else not 5e-6 <= (nu or 0.0) <= 1e-4
            rho, origin = (
                (1000.0, "not in the case: like water") if water else (1.2, "not in the case: like air")
            )
        lines.append(f"rhoInf {rho:g}; // kg/m3, density of the fluid; {origin}")
    return rho, nu if nu is not None else float(mu or 0.0) / rho, lines


def _typical(
    viscosity: CaseViscosity, rate: float, where: str
) -> tuple[float | None, float | None, list[str]]:
    """Return a viscosity, m²/s or else Pa s, and a comment: one that varies at a rate, 1/s, or its mean."""
    nu, mu, at = viscosity.nu, viscosity.mu, "on average"
    if viscosity.law is not None:
        nu, at = viscosity.law(rate), f"at {rate:.3g} 1/s"
    elif viscosity.field is not None:
        nu, mu = (viscosity.field.mean, None) if viscosity.field.kinematic else (None, viscosity.field.mean)
    name = f"// {'nu' if nu else 'mu':12s}"
    comment = (
        f"local, by {viscosity.origin}; {nu or mu:.4g} {at}"
        if viscosity.origin
        else f"{nu or mu:g}: from {where}"
    )
    return nu, mu, [name + comment]


def _temperature(case: Path, region: str, *phases: str) -> tuple[float, str]:
    """Return the mean temperature of a phase or of the fluid, K, and its source for a comment."""
    for field in (*(f"T.{phase}" for phase in phases), "T"):
        try:
            mean = mean_temperature(case, region, "latestTime", field)
        except InputError:
            mean = None
        if mean is not None:
            return float(f"{mean[0]:.4g}"), f", mean of {field} at {mean[1]}"
    return _TEMPERATURE, ""


def _pressure(case: Path, region: str) -> float:
    """Return the mean pressure of the fluid, Pa."""
    try:
        mean = mean_pressure(case, region, "latestTime")
    except InputError:
        mean = None
    return _PRESSURE if mean is None else mean[0]


def _phases(case: Path, source: FlowSource, rate: float) -> tuple[float, float, list[str]] | None:
    """Return the result of :func:`_fluid` for one of several phases; the others are in comments."""
    phases = _known_phases(case, source, rate)
    if not phases:
        return None
    lines = []
    for index, (name, nu, rho) in enumerate(phases):
        start, why = ("// ", "") if index else ("", ", in which the particles move")
        lines += [f"{start}nu {nu:g}; // m2/s, of {name}{why}", f"{start}rhoInf {rho:g}; // kg/m3, of {name}"]
    return phases[0][2], phases[0][1], lines


def _known_phases(case: Path, source: FlowSource, rate: float) -> list[tuple[str, float, float]]:
    """Return name, viscosity, m²/s, and density, kg/m³, of each of several phases.

    The phase of the velocity, such as ``U.air``, or else the first goes first.
    """
    phases = []
    try:
        for name, phase in phases_of(case, source.region).items():
            T, p = _temperature(case, source.region, name)[0], _pressure(case, source.region)
            nu, rho = phase_values(phase, rate, p, T)
            if nu is not None and rho is not None:
                phases.append((name, float(f"{nu:.4g}"), float(f"{rho:.4g}")))
    except InputError:
        return []
    name_of_source = source.velocity.partition(".")[2]
    return sorted(phases, key=lambda phase: phase[0] != name_of_source)


def _viscosity_of_model(file: Path, case: Path, rate: float, T: float) -> tuple[float, str]:
    """Return the viscosity of the selected model, m²/s, at a rate (1/s) and a temperature, and its source."""
    try:
        root = read_dictionary(file, case)
    except InputError:
        return 1e-6, ""
    if law := apparent_viscosity(root, rate, T):
        return float(f"{law[1]:.4g}"), f"{law[0]} at {rate:.3g} 1/s"
    return (1.5e-5, "not constant: like air") if is_gas(root) else (1e-6, "")


def _density(case: Path, file: Path | None, region: str, where: str) -> tuple[float | None, str]:
    try:
        if file is not None and (rho := read_density(file, case)) is not None:
            return rho, where
        field = mean_density(case, region, "latestTime")
    except InputError:
        return None, ""
    return (field[0], f"the field rho at time {field[1]}") if field else (None, "")


def _density_of_state(case: Path, file: Path | None, region: str) -> tuple[float | None, str]:
    """Return the density by the equation of state of the fluid, kg/m³, and its source for a comment."""
    T, p = _temperature(case, region)[0], _pressure(case, region)
    try:
        rho = None if file is None else density_of_state(read_dictionary(file, case), p, T)
    except InputError:
        rho = None
    return (None, "") if rho is None else (float(f"{rho:.4g}"), f"equationOfState at {p:.4g} Pa, {T:.4g} K")


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


def _stiffness(flow: MeshFlow, scales: FlowScales, mu: float) -> list[str]:
    """Return the entries of the stiffness by the rates on paths of the fluid."""
    largest = rates_on_paths(flow, scales)
    rate = float(np.median(largest)) or 1.0
    where = "the largest on half of the paths" if largest.any() else "as the fluid is at rest"
    at = f"{rate:.2g} 1/s, {where}"
    modulus = _rounded(mu * max(rate / _CAPILLARY, np.quantile(largest, 0.9) / _MOST_CAPILLARY))
    said = f"Pa; Ca = {mu * rate / modulus:.2g} at {at}"
    return ["poissonsRatio 0.499; // nearly incompressible", f"shearModulus {modulus:g}; // {said}"]


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


def _faults(flow: MeshFlow) -> list[str]:
    """Return a hint for each fault of a flow with which a run ends."""
    faults = [note for note in flow.notes if isinstance(note, Caveat) and note.fault]
    return [f"// accept ( {note.fault} ); // to go on, although {note.split(':')[0]}" for note in faults]


def _transient(case: Path, source: FlowSource) -> list[str]:
    """Return a hint if the flow was written at several times."""
    try:
        names, notes = transient_times(open_case(case, source), None, source.velocity)
    except InputError:
        return []
    names = [name for name in names if float(name) > 0.0]
    faults = [note.split(":")[0] for note in notes if isinstance(note, Caveat) and note.fault]
    if source.file is not None or len(names) < 2:
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
            "type cellZoneInjection; // no patch has inflow",
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
    choice = "or rebound, escape"
    lines, walls = [], [patch for patch in patches if patch.kind is PatchKind.WALL]
    named = [patch for patch in patches if patch.kind in (PatchKind.OPENING, PatchKind.COUPLED)]
    for patch in named:
        start, why = "", "" if patch.type == "patch" else f" // {patch.type}"
        if patch.kind is PatchKind.COUPLED:
            start, why = "// ", f" // particles cannot pass a {patch.type}"
        lines.append(f"{start}{_word(patch.name):20s}{{ type escape; }}{why}")
    if len(walls) > 6:
        lines.append(f"{'wall':20s}{{ type stick; }} // all {len(walls)} walls; {choice}")
    else:
        lines += [f"{_word(patch.name):20s}{{ type stick; }} // wall; {choice}" for patch in walls]
    others = [f"{patch.name} ({patch.type})" for patch in patches if patch not in (*walls, *named)]
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
