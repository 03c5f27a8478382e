"""Velocities on the faces of patches: from the file, or by OpenFOAM's boundary conditions.

A condition without ``value`` in the file gets the value that OpenFOAM computes for it. A condition that
requires a ``value``, or is unknown, is an error.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from foamprb.dictionary.dimensions import RATE, VELOCITY, VOLUME_FLUX, Dimensions
from foamprb.dictionary.values import factor_of, unit_of
from foamprb.errors import InputError, closest, suggestion
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import CONSTRAINTS, VALUE_CONDITIONS, VALUELESS, WALL_CONDITIONS, PatchKind
from foamprb.flow.read.boundary import CaseMesh, PatchInfo
from foamprb.flow.read.field import FoamField, PatchField
from foamprb.flow.read.times import listed


class PatchGeometry(NamedTuple):
    """Faces of a patch."""

    cells: Floats
    """(n, 3) velocities of the cells behind them, m/s."""
    normals: Floats
    """(n, 3), unit, out of the domain."""
    areas: Floats
    """(n,), m²."""
    centres: Floats
    """(n, 3), m."""
    depths: Floats
    """(n, 1), distances of the cell centres behind them along the normals, m."""


_MAY_BE_WALLS = PatchKind.OPENING, PatchKind.COUPLED
_ALONG = 1e-4
"""Cosine of the angle between a velocity along a face and its normal."""
_CROSSED = 0.05
"""Least flux through an opening that is a wall by its type, over that of the speed on it."""
_LENGTH: Dimensions = (0, 1, 0, 0, 0, 0, 0)
Rule = Callable[[PatchField, PatchGeometry], Floats | None]
"""Returns the values (n, 3), m/s, of a boundary condition; None if it lacks an entry."""


def with_openings(whole: CaseMesh, field: FoamField, boundary: Floats) -> CaseMesh:
    """Return the mesh with the walls as openings through which fluid flows.

    Mesh generators make walls of patches that have no type. A velocity that is given on a wall is that of a
    moving or porous one.

    Parameters
    ----------
    whole, field
        The mesh and the velocity.
    boundary
        (n_boundary, 3) velocity at the boundary faces, m/s.
    """
    mesh, patches, notes = whole.mesh, list(whole.mesh.patches), []
    for index, patch in enumerate(whole.patches[: len(patches)]):
        entry, rows = field.of(patch), slice(mesh.patch_start[index], mesh.patch_start[index + 1])
        walls = WALL_CONDITIONS | VALUE_CONDITIONS
        if entry is None or entry.type in walls or patches[index].kind is not PatchKind.WALL:
            continue
        values, areas = boundary[rows], mesh.boundary_areas[rows]
        flux = float(np.einsum("ni,ni->", values, areas))
        most = float((np.linalg.norm(values, axis=1) * np.linalg.norm(areas, axis=1)).sum())
        if abs(flux) > _CROSSED * most:
            patches[index] = patches[index]._replace(type="patch", groups=patch.groups - {"wall"})
            way = "leave" if flux > 0.0 else "enter"
            notes.append(
                Caveat(
                    f"patch {patch.name} is of type {patch.type}, but {abs(flux):.4g} m3/s {way} through it "
                    f"({entry.type}): it is an opening. To make it a wall, give it an entry in "
                    "localInteractionCoeffs/patches."
                )
            )
    return whole._replace(mesh=replace(mesh, patches=tuple(patches)), notes=(*whole.notes, *notes))


def caveats_of_walls(whole: CaseMesh, field: FoamField, boundary: Floats) -> list[Caveat]:
    """Return a warning for each wall of a mesh at rest across which its given velocity goes.

    ``boundary`` (n_boundary, 3) is the velocity at the boundary faces, m/s.
    """
    mesh, caveats = whole.mesh, []
    for index, patch in enumerate(whole.patches[: len(mesh.patches)]):
        entry, rows = field.of(patch), slice(mesh.patch_start[index], mesh.patch_start[index + 1])
        values, areas = boundary[rows], mesh.boundary_areas[rows]
        given = entry is not None and entry.type in VALUE_CONDITIONS
        if entry is None or not given or mesh.patches[index].kind is not PatchKind.WALL:
            continue
        if _passes(values, areas):
            across = np.einsum("ni,ni->n", values, areas) / np.linalg.norm(areas, axis=1)
            most = float(np.abs(across).max())
            caveats.append(
                Caveat(
                    f"wall {patch.name}: its velocity ({entry.type}) has up to {most:.3g} m/s across its "
                    "faces, but the mesh is at rest: fluid passes there, and particles meet a wall. Should "
                    "it be an opening (type patch), or move along itself (movingWallVelocity)?"
                )
            )
    return caveats


def with_walls(whole: CaseMesh, field: FoamField, *later: FoamField) -> CaseMesh:
    """Return the mesh with the patches as walls that are none by their type, but by the velocity on them.

    Values on a wall have no component across it at ``later`` times either: a fluid may start from rest.
    """
    patches, names = list(whole.mesh.patches), []
    for index, patch in enumerate(whole.patches[: len(patches)]):
        entry = field.of(patch)
        if entry is None or patch.type in CONSTRAINTS or patches[index].kind not in _MAY_BE_WALLS:
            continue
        areas = whole.mesh.boundary_areas[whole.mesh.patch_start[index] :][: patch.faces]
        values = [given.fields.get("value") for f in (field, *later) if (given := f.of(patch)) is not None]
        given_everywhere = entry.type in VALUE_CONDITIONS and all(v is not None for v in values)
        closed = given_everywhere and not any(_passes(v, areas) for v in values if v is not None)
        if entry.type in WALL_CONDITIONS or closed:
            patches[index] = patches[index]._replace(type="wall", groups=patch.groups | {"wall"})
            names.append(f"{patch.name} ({patch.type}, {entry.type})")
    if not names:
        return whole
    note = f"Walls by the velocity on them, not by their type: {listed(names)}."
    return whole._replace(mesh=replace(whole.mesh, patches=tuple(patches)), notes=(*whole.notes, note))


def _passes(values: Floats, areas: Floats) -> bool:
    """Return whether a velocity (n, 3) or (1, 3) has a component across faces with areas (n, 3)."""
    if len(values) not in (1, len(areas)):
        # Their number is an error elsewhere.
        return True
    sizes = np.linalg.norm(values, axis=1) * np.linalg.norm(areas, axis=1)
    return bool((np.abs(np.sum(values * areas, axis=1)) > _ALONG * sizes).any())


def boundary_values(field: FoamField, patches: Sequence[PatchInfo], mesh: Mesh, cells: Floats) -> Floats:
    """Return the velocity at the boundary faces, (n_boundary, 3), m/s; zero on patches without values.

    Parameters
    ----------
    field
        The velocity.
    patches, mesh
        The patches as the case lists them, and the mesh.
    cells
        (n_cells, 3) velocity at the cells, m/s.

    Raises
    ------
    InputError
        The field has no entry for a patch, an entry of a type that the patch cannot have, or one without the
        values that it needs; or the counts of values and faces differ.
    """
    owner = mesh.owner[mesh.n_internal :]
    sizes = np.linalg.norm(mesh.boundary_areas, axis=1)
    normals = mesh.boundary_areas / np.maximum(sizes, 1e-300)[:, None]
    values = np.zeros((len(owner), 3))
    for index, patch in enumerate(patches):
        rows = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
        entry = field.of(patch)
        _check_type(field, patch, entry)
        if entry is None or patch.type in VALUELESS or patch.faces == 0:
            continue
        behind, n, centres = owner[rows], normals[rows], mesh.boundary_centres[rows]
        depths = np.einsum("ni,ni->n", centres - mesh.centres[behind], n)[:, None]
        faces = PatchGeometry(cells[behind], n, sizes[rows], centres, depths)
        values[rows] = _values(field, patch, entry, faces)
    return values


def _check_type(field: FoamField, patch: PatchInfo, entry: PatchField | None) -> None:
    """Raise InputError if a patch has no entry, or one that OpenFOAM does not allow for its type."""
    if patch.faces == 0:
        return
    if entry is None:
        if patch.type in CONSTRAINTS:
            return
        names = [name for name, other in field.patches.items() if not other.pattern]
        raise InputError(
            f"{field.path}: no entry of boundaryField for patch {patch.name}. {suggestion(patch.name, names)}"
        )
    # OpenFOAM writes cyclicAMI on patches of types that are derived from it.
    if patch.type in _AMI and entry.type == "cyclicAMI":
        return
    if patch.type in CONSTRAINTS and patch.type not in (entry.type, entry.words.get("patchType")):
        raise InputError(
            f"{field.path}: patch {patch.name} is of type {patch.type}, so the field must be of this type; "
            f"here it is of type {entry.type}."
        )
    if entry.type in CONSTRAINTS and entry.type != patch.type:
        raise InputError(
            f"{field.path}: on patch {patch.name} the field is of type {entry.type}, which a patch of type "
            f"{patch.type} cannot have."
        )


def _values(field: FoamField, patch: PatchInfo, entry: PatchField, faces: PatchGeometry) -> Floats:
    always, otherwise = RULES.get(entry.type, (False, None))
    given = entry.fields.get("value")
    try:
        values = given if given is not None and not always else otherwise and otherwise(entry, faces)
    except ValueError as error:
        raise InputError(f"{field.path}: patch {patch.name} has an entry {error}.") from None
    if values is None:
        raise InputError(f"{field.path}: {_missing(patch, entry, otherwise)}")
    if len(values) not in (1, patch.faces):
        raise InputError(
            f"{field.path}: {len(values)} values on patch {patch.name}, which has {patch.faces} faces."
        )
    return values


def _missing(patch: PatchInfo, entry: PatchField, rule: Rule | None) -> str:
    what = f"patch {patch.name} is of type {entry.type} and has no value"
    if rule is not None:
        return f"{what}, nor what OpenFOAM computes it from. Add the entry value, as OpenFOAM writes it."
    # Other conditions of OpenFOAM have similar names and another meaning.
    meant = closest(entry.type, RULES, 0.85)
    hint = f" Did you mean {meant}?" if meant else ""
    return f"{what}. Allowed: value uniform (x y z), or nonuniform and a list.{hint}"


def _zero(entry: PatchField, faces: PatchGeometry) -> Floats:  # noqa: ARG001
    return np.zeros((1, 3))


def _of_cells(entry: PatchField, faces: PatchGeometry) -> Floats:  # noqa: ARG001
    return faces.cells


def _tangential(entry: PatchField, faces: PatchGeometry) -> Floats:  # noqa: ARG001
    return faces.cells - _along(faces.cells, faces.normals)


def _along(vectors: Floats, normals: Floats) -> Floats:
    along: Floats = np.einsum("ni,ni->n", vectors, normals)[:, None] * normals
    return along


def _fixed_normal_slip(entry: PatchField, faces: PatchGeometry) -> Floats | None:
    """Return n (n·fixedValue) plus the tangential part of the cells' velocity."""
    fixed = entry.fields.get("fixedValue")
    if fixed is None:
        return None
    return _along(np.broadcast_to(fixed, faces.cells.shape), faces.normals) + _tangential(entry, faces)


def _partial_slip(entry: PatchField, faces: PatchGeometry) -> Floats | None:
    """Return f refValue + (1 − f) u_t with f = valueFraction and u_t the tangential velocity of the cells."""
    f, fixed = entry.fields.get("valueFraction"), entry.fields.get("refValue", np.zeros((1, 3)))
    return None if f is None else f * fixed + (1.0 - f) * _tangential(entry, faces)


def _surface_normal(entry: PatchField, faces: PatchGeometry) -> Floats | None:
    """Return ``refValue`` times the outward normal."""
    speed = entry.fields.get("refValue")
    return None if speed is None else speed * faces.normals


def _fixed_gradient(entry: PatchField, faces: PatchGeometry) -> Floats | None:
    """Return the cells' velocity plus ``gradient``, or the constant ``uniformGradient``, times the depth."""
    slope = entry.fields.get("gradient")
    if slope is None:
        slope = _constant(entry.words.get("uniformGradient", ""), 3, RATE)
    return None if slope is None else faces.cells + slope * faces.depths


def _entry(name: str) -> Rule:
    """Make the rule that returns the field, or the constant, of an entry."""

    def rule(entry: PatchField, faces: PatchGeometry) -> Floats | None:  # noqa: ARG001
        return entry.fields[name] if name in entry.fields else _constant(entry.words.get(name, ""), 3)

    return rule


def _flow_rate(entry: PatchField, faces: PatchGeometry) -> Floats | None:
    """Return the uniform velocity into the domain that carries the volumetric flow rate, m³/s."""
    rate = _constant(entry.words.get("volumetricFlowRate", ""), 1, VOLUME_FLUX)
    area = faces.areas.sum()
    return None if rate is None else -rate / area * faces.normals


def _rotating_wall(entry: PatchField, faces: PatchGeometry) -> Floats | None:
    """Return ω a × (x − origin) with a the direction of the axis."""
    origin = _constant(entry.words.get("origin", ""), 3, _LENGTH)
    axis = _constant(entry.words.get("axis", ""), 3)
    omega = _constant(entry.words.get("omega", ""), 1, RATE)
    if origin is None or axis is None or omega is None or not axis.any():
        return None
    return omega * np.cross(axis / np.linalg.norm(axis), faces.centres - origin)


_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"


def _constant(text: str, components: int, dimensions: Dimensions = VELOCITY) -> Floats | None:
    """Return a number or a vector (1, components), after ``constant`` or not; None for other text.

    It may have a unit; ValueError is raised if that has other dimensions.
    """
    unit, tokens = unit_of(text.split(" "))
    text = " ".join(tokens)
    numbers = " ".join([_NUMBER] * components)
    match = re.fullmatch("(?:constant )?" + (numbers if components == 1 else rf"\( {numbers} \)"), text)
    if match is None:
        return None
    return (factor_of(unit, dimensions) if unit else 1.0) * np.array([match.groups()], dtype=np.float64)


RULES: dict[str, tuple[bool, Rule]] = {
    "fixedGradient": (True, _fixed_gradient),
    "fixedNormalSlip": (True, _fixed_normal_slip),
    "flowRateInletVelocity": (False, _flow_rate),
    "freestream": (False, _entry("freestreamValue")),
    "freestreamVelocity": (False, _entry("freestreamValue")),
    "inletOutlet": (False, _entry("inletValue")),
    "noSlip": (True, _zero),
    "outletInlet": (False, _entry("outletValue")),
    "partialSlip": (True, _partial_slip),
    "rotatingWallVelocity": (False, _rotating_wall),
    "slip": (True, _tangential),
    "surfaceNormalFixedValue": (True, _surface_normal),
    "uniformFixedGradient": (False, _fixed_gradient),
    "uniformFixedValue": (False, _entry("uniformValue")),
    "uniformInletOutlet": (False, _entry("uniformInletValue")),
    "zeroGradient": (True, _of_cells),
}
"""By type of condition: True if OpenFOAM computes the values even if there is a ``value``; and the rule."""

_AMI = frozenset({"cyclicPeriodicAMI", "cyclicRepeatAMI"})
