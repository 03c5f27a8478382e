"""Warnings about properties of the flow of a case that particles will not feel."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from foamprb.dictionary.dimensions import MASS_FLUX
from foamprb.dictionary.files import existing, read_bytes
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.fluxes import Conservation, UnbalancedFlowError
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.boundary import CaseMesh, PatchInfo
from foamprb.flow.read.case import active_zones, available_times, find_dictionary, word_of
from foamprb.flow.read.checks import require_numbers
from foamprb.flow.read.density import FLUX_FIELD, densities, varies
from foamprb.flow.read.field import FoamField, Kind
from foamprb.flow.read.fluid import FRACTION_FIELD

log = logging.getLogger("foamprb")

_PSEUDO = ("steadyState", "localEuler", "CoEuler", "SLTS")
"""Schemes of ``ddtSchemes`` by which a time is an iteration, with a step of its own in each cell or none."""
MOVING = "movingMesh"
"""Fault of a flow of one time whose mesh moves."""
_AT_REST = frozenset({"staticFvMesh", "dynamicRefineFvMesh"})
"""Types of meshes whose points keep their places."""
_LEAST_DIFFERENCE = 0.05
"""Fraction by which densities must differ for a warning."""
_LEAST_PHASE = 1e-3
"""Fraction of the cells that a phase must fill for a warning."""
_ZERO = re.compile(rb"internalField\s+uniform\s+0(?:\.0*)?\s*;")
_VARIES = re.compile(rb"internalField\s+nonuniform")
_HEAD = 1 << 16
TURBULENT, PHASES = (
    "the flow is the mean or the resolved part of a turbulent one",
    "the flow has several phases",
)
"""Beginnings of caveats."""
LEAST_LOSS = 1e-3
"""Fraction of the flux by which inflow and outflow must differ for a warning."""
_MOST_LOSS = 0.5
"""The fraction of ``phi`` from which on fates are worthless; values on patches may be stale."""
_MOST_MADE = 0.3
"""Fraction of the flux through cells by which ``phi`` may differ between their inflow and outflow."""
ROUND_OFF = 1e-9
"""Fraction of the largest velocity times the area of the boundary by which they must differ, too."""


def balanced(conserve: Conservation, *values: Any, notes: list[Any]) -> Floats | None:
    """Return the fluxes of a steady flow; None, and a caveat in ``notes``, if they cannot be balanced."""
    try:
        return conserve(*values)
    except UnbalancedFlowError as error:
        notes.append(Caveat(str(error), "unbalanced"))
        return None


def balanced_in_time(conserve: Conservation, *values: Any, accept: Sequence[str]) -> Floats:
    """Return the fluxes at a time of a transient flow; NaN if they cannot be balanced, and this is accepted.

    Raises
    ------
    InputError
        If they cannot be balanced, and this is not accepted.
    """
    try:
        return conserve(*values)
    except UnbalancedFlowError as error:
        if "unbalanced" not in accept:
            raise InputError(f"{error} Allowed: to go on, solution/accept ( unbalanced ).") from None
        log.warning("%s", error)
        return np.full(conserve.n_faces, np.nan)


def caveats_of_case(
    case: Path,
    region: str,
    folder: Path,
    read: Callable[[str, Kind], FoamField],
    *,
    moving: bool = True,
    turbulent: bool = False,
    relative: bool = False,
    mixed: bool = False,
) -> list[Caveat]:
    """Return warnings from the dictionaries of a case, and from the fields beside the velocity.

    Parameters
    ----------
    case, region
        The case, and a region of its mesh.
    folder, read
        Folder of the fields at the time, and the function that reads one of them.
    moving
        True if the flow is read at one time only, so that a moving mesh stands still.
    turbulent
        True if a model of the eddies acts, so that they need no warning.
    relative
        True if rotating zones are described in the frames of their rotors, so that they need no warning.
    mixed
        True if particles are in the local mixture of phases, so that these need no warning.
    """
    caveats = [*_rotating(case, region, relative), *_porous(case, region)]
    caveats += () if turbulent else _turbulent(folder)
    caveats += () if mixed else tuple(_phases(folder, read)) or tuple(_compressible(read))
    return [*caveats, *(_moving(case, region, folder) if moving else ())]


def refuse_absolute(case: Path, region: str, folder: Path, velocity: str) -> None:
    """Raise InputError if the velocity is absolute in a mesh that rotates with its frame."""
    rotating = _zones(case, region, "SRFProperties") is not None
    if rotating and velocity == "U" and existing(folder / "Urel") is not None:
        raise InputError(
            f"{folder / 'U'} is the absolute velocity of a flow in a rotating frame (SRFProperties), whose "
            "mesh and blades stand still. Allowed: -velocity Urel, the velocity relative to them."
        )


def pseudo_time(case: Path, region: str) -> str:
    """Return the scheme of ``ddtSchemes`` by which the times of a case are iterations, or ''."""
    return word if (word := _time_scheme(case, region)) in _PSEUDO else ""


def _time_scheme(case: Path, region: str) -> str:
    """Return the default scheme of ``ddtSchemes``, or '' without one."""
    try:
        schemes = read_dictionary(case / "system" / region / "fvSchemes", case).entries.get("ddtSchemes")
    except InputError:
        return ""
    words = word_of(schemes, "default").split() if isinstance(schemes, Dictionary) else []
    return next((word for word in words if word != "bounded"), "")


def in_degrees(case: Path, region: str) -> bool:
    """Return whether the times of a case are degrees of an engine's crank."""
    try:
        engine, control = (find_dictionary(case, region, name) for name in ("engineGeometry", "controlDict"))
    except InputError:
        return False
    user = control.entries.get("userTime") if control is not None else None
    by_user = isinstance(user, Dictionary) and word_of(user, "type") == "engine"
    return by_user or (engine is not None and "rpm" in engine.entries)


def is_unsteady(case: Path, region: str) -> bool:
    """Return whether the times of a case are those of an unsteady solver."""
    return _time_scheme(case, region) not in ("", *_PSEUDO)


def caveat_of_flux(
    whole: CaseMesh,
    cells: Floats,
    boundary: Floats,
    read: Callable[[str, Kind], FoamField],
    velocity: str,
    unsteady: bool,
) -> list[Caveat]:
    """Return a warning if inflow and outflow differ.

    The balance of a phase is not that of the fluid, and a compressible fluid accumulates in unsteady flows.

    Parameters
    ----------
    whole
        The mesh.
    cells
        (n_cells, 3) velocity at the cells, m/s; differences that are small against it are round-off.
    boundary
        (n_boundary, 3) velocity at the boundary faces, m/s, used where there is no ``phi``.
    read
        Reads a field at the time.
    velocity, unsteady
        Name of the velocity, whose flux is ``phi`` if it is ``U`` or ``Urel``; True for an unsteady flow.
    """
    mesh = whole.mesh
    phi = _flux(read, whole.patches) if velocity in ("U", "Urel") else None
    compressible = varies(densities(read)) or (phi is not None and phi[2] == "kg/s")
    # Without phi the flux of mass is unknown.
    if "." in velocity or (compressible and (unsteady or phi is None)):
        return []
    source, unit = (phi[1], phi[2]) if phi else ("U on the patches", "m3/s")
    made = 100.0 * _made_by_cells(mesh, phi[0], phi[3]) if phi else 0.0
    if made > 100.0 * _MOST_MADE:
        return [
            Caveat(
                f"phi makes or loses {made:.3g} % of the fluid that crosses a cell, on average (allowed: "
                f"{100.0 * _MOST_MADE:g} %). Do mesh and fields have one numbering? After renumberMesh, "
                "earlier times need the mesh from before.",
                "unbalanced",
            )
        ]
    flux = phi[0] if phi else np.einsum("ni,ni->n", boundary, mesh.boundary_areas)
    areas, speeds = np.linalg.norm(mesh.boundary_areas, axis=1), np.linalg.norm(cells, axis=1)
    outflow, inflow = float(flux[flux > 0.0].sum()), float(-flux[flux < 0.0].sum())
    round_off = ROUND_OFF * float(areas.sum()) * float(speeds.max())
    lost, most = abs(outflow - inflow), max(outflow, inflow)
    if lost <= max(LEAST_LOSS * most, round_off):
        return []
    return [
        Caveat(
            f"the flow does not conserve {'mass' if unit == 'kg/s' else 'volume'}: {inflow:.6g} {unit} enter "
            f"and {outflow:.6g} {unit} leave (from {source}). Has the solver converged at this time? "
            "Particles follow a flow that loses or makes fluid.",
            "unbalanced" if phi and lost > _MOST_LOSS * most else "",
        )
    ]


def _made_by_cells(mesh: Mesh, outer: Floats, inner: Floats) -> float:
    """Return what cells make or lose over the flux through them, means; 0 without values at inner faces."""
    n, cells = mesh.n_internal, mesh.n_cells
    # Of a decomposed case only the values on patches are read.
    if len(inner) != n or not inner.any():
        return 0.0
    flux = np.concatenate([inner, outer])
    made, size = (
        np.bincount(mesh.owner, f, cells) + sign * np.bincount(mesh.neighbour, f[:n], cells)
        for f, sign in ((flux, -1.0), (np.abs(flux), 1.0))
    )
    return float(np.abs(made).sum() / (0.5 * size.sum()))


def _rotating(case: Path, region: str, relative: bool) -> Iterator[Caveat]:
    zones = _zones(case, region, "MRFProperties")
    if zones and not relative:
        yield Caveat(
            f"the flow has rotating zones (MRFProperties: {zones}), but particles move in them with the "
            "absolute velocity: they meet the blades only where the mesh has them, as if these stood still."
        )
    if _zones(case, region, "SRFProperties") is not None:
        yield Caveat(
            "the flow is that of a rotating frame (SRFProperties), but rotating frames are not modelled: "
            "centrifugal and Coriolis forces on particles are left out."
        )


def _porous(case: Path, region: str) -> Iterator[Caveat]:
    zones = [
        _zones(case, region, "fvOptions", lambda entry: "orosity" in word_of(entry, "type")),
        _zones(case, region, "porosityProperties"),
    ]
    if any(zones):
        yield Caveat(
            f"the flow has porous zones ({', '.join(filter(None, zones))}): particles go through with the "
            "superficial velocity, and the pores neither catch nor deform them."
        )


def _turbulent(folder: Path) -> Iterator[Caveat]:
    name = "nut" if existing(folder / "nut") is not None else "k"
    if is_not_zero(folder / name):
        fields = turbulence_fields(folder)
        hint = "The case does not have k and epsilon or omega, which a dispersionModel needs."
        if fields:
            hint = "subModels/dispersionModel stochasticDispersionRAS adds the dispersion, from "
            hint += f"{' and '.join(fields)}."
        yield Caveat(
            f"{TURBULENT} (there is {name}): particles "
            "follow and feel that part alone, without dispersion by the eddies and without their stresses. "
            f"{hint}"
        )


def turbulence_fields(folder: Path) -> tuple[str, ...]:
    """Return the names of the fields in a time directory that give k and ε, or ()."""
    pairs = (("k", second) for second in ("epsilon", "omega") if is_not_zero(folder / second))
    return next(pairs, ()) if is_not_zero(folder / "k") else ()


def is_not_zero(path: Path) -> bool:
    """Return True if there is a field that is not zero everywhere."""
    file = existing(path)
    return file is not None and not _ZERO.search(read_bytes(file, _HEAD))


def _compressible(read: Callable[[str, Kind], FoamField]) -> Iterator[Caveat]:
    rho = densities(read)
    low, high = rho.min(initial=np.inf), rho.max(initial=-np.inf)
    if high - low > _LEAST_DIFFERENCE * high:
        yield Caveat(
            f"the fluid's density is from {low:.4g} to {high:.4g} kg/m3 (there is rho), but "
            "to particles it is constant, rhoInf."
        )


def _phases(folder: Path, read: Callable[[str, Kind], FoamField]) -> Iterator[Caveat]:
    paths = sorted(path for path in folder.glob("alpha.*") if path.is_file() and ".orig" not in path.name)
    names = [path.name.removesuffix(".gz") for path in paths if _VARIES.search(read_bytes(path, _HEAD))]
    if any(_LEAST_PHASE < _mean(read(name, FRACTION_FIELD)) < 1.0 - _LEAST_PHASE for name in names):
        hint = " solution/mixture true takes those of the local mixture." if len(names) <= 2 else ""
        yield Caveat(
            f"{PHASES} ({', '.join(names)}), but to particles the fluid is one, with "
            f"rhoInf and one viscosity everywhere: they cross interfaces as if there were none.{hint}"
        )


def _mean(field: FoamField) -> float:
    """Return the mean of fractions over the cells."""
    return float(field.cells[:, 0].clip(0.0, 1.0).mean())


def _moving(case: Path, region: str, folder: Path) -> Iterator[Caveat]:
    try:
        root = find_dictionary(case, region, "dynamicMeshDict")
        kind = "" if root is None else word_of(root, "dynamicFvMesh") or "dynamicMeshDict"
        # OpenFOAM.org has an entry for each way in which a mesh changes.
        if root is not None and "mover" not in root.entries and "topoChanger" in root.entries:
            kind = ""
    except InputError:
        kind = "dynamicMeshDict"
    moved, remade = (existing(folder / "polyMesh" / part) is not None for part in ("points", "faces"))
    if kind in ("", *_AT_REST):
        kind = "points at this time" if moved and not remade else ""
    # A dictionary alone, as that of a motion by MRFProperties or of a shape optimisation, moves nothing.
    times = folder.parents[1 if region else 0]
    if not any(existing(times / name / region / "polyMesh/points") for name in available_times(times)):
        kind = ""
    if kind:
        yield Caveat(
            f"the mesh moves ({kind}), but is read at one time: it stands still, and particles meet its "
            "walls where they are at this time.",
            MOVING,
        )


def _zones(
    case: Path, region: str, name: str, meant: Callable[[Dictionary], bool] = lambda _: True
) -> str | None:
    """Return the names of the active entries that are meant in a dictionary; None if there is no file.

    A dictionary that cannot be read may have any.
    """
    try:
        root = find_dictionary(case, region, name)
    except InputError:
        return "which cannot be read"
    return None if root is None else ", ".join(zone.key for zone in active_zones(root) if meant(zone))


def _flux(
    read: Callable[[str, Kind], FoamField], patches: Sequence[PatchInfo], name: str = "phi"
) -> tuple[Floats, str, str, Floats] | None:
    """Return the flux out of the boundary faces (n,), its name, its unit, and the flux through inner faces.

    Returns None if ``phi`` is missing. On a mesh that moves it is relative to the faces, whose own flux
    ``meshPhi`` is added.
    """
    try:
        phi = read(name, FLUX_FIELD)
    except InputError:
        return None
    require_numbers(phi.cells, phi.path, "value", "at face")
    values = []
    for patch in patches:
        entry = phi.of(patch)
        values_there = entry.fields.get("value") if entry else None
        if values_there is None or len(values_there) not in (1, patch.faces):
            if patch.faces > 0 and patch.type not in ("empty", "processor"):
                return None
            values_there = np.zeros((1, 1))
        require_numbers(values_there, phi.path, "value", f"on patch {patch.name}, face")
        values.append(np.broadcast_to(values_there, (patch.faces, 1))[:, 0])
    unit = "kg/s" if phi.dimensions == MASS_FLUX else "m3/s"
    outer, inner = np.concatenate([np.empty(0), *values]), phi.cells[:, 0]
    carried = _flux(read, patches, "meshPhi") if name == "phi" and unit == "m3/s" else None
    if carried is not None and len(carried[3]) == len(inner):
        return outer + carried[0], "phi + meshPhi", unit, inner + carried[3]
    return outer, name, unit, inner
