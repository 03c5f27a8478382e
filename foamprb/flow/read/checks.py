"""Checks of numbers, volumes and shapes of patches."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import KINDS
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.field import FoamField

LARGEST = 1e30
"""Limit of lengths in m and velocities in m/s: products of a few of them stay finite."""
_PLANAR = {"symmetryPlane": "; the type of a curved one is symmetry", "wedge": ""}
_SINGLE = 6e-8
"""Relative error of coordinates in single precision, which meshes of other programs may have."""
_LEAST_TURN = 1e-6
"""Tolerance of the angle between faces, rad, with exact coordinates."""
_UNORDERED, _LEAST_SPREAD, _FEW_CELLS = 0.6, 0.01, 100
"""Difference of neighbouring cells over that of random ones beyond which their order is doubtful, least
difference over the speed, and least number of cells, for :func:`caveat_of_order`."""


def require_numbers(values: Floats, source: Path, what: str, where: str = "number") -> None:
    """Check that all rows are finite, and not larger than any length or velocity.

    Parameters
    ----------
    values, source
        (n, components) values, and their file.
    what, where
        Name of a row, and of its position, before the index.

    Raises
    ------
    InputError
        The message has the count of wrong rows, and the first one.
    """
    bad = np.flatnonzero(~(np.abs(values) <= LARGEST).all(axis=1))
    if len(bad):
        first = " ".join(f"{x:g}" for x in values[bad[0]])
        raise InputError(
            f"{source}: {len(bad)} of {len(values)} {what}s are not finite numbers below {LARGEST:g}; the "
            f"first is ({first}) {where} {bad[0]}."
        )


def require_volumes(mesh: Mesh, source: Path) -> None:
    """Raise InputError if cells have no positive volume."""
    flat = np.flatnonzero(~(mesh.volumes > 0.0))
    if len(flat):
        x = "({:g} {:g} {:g})".format(*mesh.centres[flat[0]])
        raise InputError(
            f"{source}: {len(flat)} of {mesh.n_cells} cells have no positive volume; the first is cell "
            f"{flat[0]} at {x}. Is the mesh damaged? (checkMesh tells)"
        )


def require_patch_shapes(mesh: Mesh, source: Path) -> None:
    """Raise InputError for overset, curved symmetry planes and wedges, and ``empty`` patches in 3-D."""
    normals, doubt = _normals(mesh)
    faces = [slice(*mesh.patch_start[i : i + 2]) for i in range(len(mesh.patches))]
    for patch, part in zip(mesh.patches, faces, strict=True):
        if patch.type == "overset" and not patch.faceless:
            raise InputError(
                f"{source}: patch {patch.name} is of type overset: the meshes of several parts overlap, and "
                "particles cannot go from one to another. Allowed: the flow on one mesh, as by mapFields."
            )
        if patch.type in _PLANAR and part.stop > part.start:
            turned = np.linalg.norm(normals[part] - normals[part][0], axis=1)
            if np.any(turned > doubt[part] + doubt[part][0]):
                angle = np.degrees(2.0 * np.arcsin(min(0.5 * turned.max(), 1.0)))
                raise InputError(
                    f"{source}: patch {patch.name} is of type {patch.type}, but not planar: its faces turn "
                    f"by up to {angle:.3g} degrees{_PLANAR[patch.type]}."
                )
    empty = [part for patch, part in zip(mesh.patches, faces, strict=True) if patch.type == "empty"]
    rows = np.concatenate([np.empty(0, dtype=np.intp), *(np.arange(p.start, p.stop) for p in empty)])
    if len(rows):
        _require_flat(mesh, rows, normals[rows], doubt[rows], source)


def _require_flat(mesh: Mesh, rows: Floats, normals: Floats, doubt: Floats, source: Path) -> None:
    """Check that each empty face is normal to a coordinate axis, and that each cell has two on each axis."""
    names = " and ".join(patch.name for patch in mesh.patches if patch.type == "empty")
    axis = np.argmax(np.abs(normals), axis=1)
    aside = np.sqrt(np.maximum(1.0 - normals[np.arange(len(rows)), axis] ** 2, 0.0))
    if np.any(aside > doubt):
        raise InputError(
            f"{source}: empty patch {names}: {np.count_nonzero(aside > doubt)} of {len(rows)} faces do not "
            "look along x, y or z, as those of a mesh of two dimensions or one do (checkMesh tells)."
        )
    owner = mesh.owner[mesh.n_internal :][rows]
    for direction in np.unique(axis):
        count = np.bincount(owner[axis == direction], minlength=mesh.n_cells)
        wrong = np.flatnonzero(count != 2)
        if len(wrong):
            raise InputError(
                f"{source}: empty patch {names}: cell {wrong[0]} has {count[wrong[0]]} faces on it along "
                f"{'xyz'[direction]}, not 2; the mesh has several layers of cells there, and is not one of "
                "two dimensions (checkMesh tells)."
            )


def caveat_of_order(mesh: Mesh, cells: Floats) -> list[Caveat]:
    """Return a warning if the velocities (n_cells, 3) of neighbouring cells differ as those of random cells.

    They do if the field and the mesh have different numberings.
    """
    first, second = mesh.owner[: mesh.n_internal], mesh.neighbour
    if mesh.n_cells < _FEW_CELLS or len(first) == 0:
        return []
    random = np.random.default_rng(1).permutation(mesh.n_cells)[second]
    beside, apart = (float(np.abs(cells[first] - cells[rows]).mean()) for rows in (second, random))
    if beside <= max(_UNORDERED * apart, _LEAST_SPREAD * float(np.abs(cells).mean())):
        return []
    return [
        Caveat(
            f"velocities of neighbouring cells differ by {beside:.3g} m/s on average, those of random cells "
            f"by {apart:.3g} m/s (usual: below {100.0 * _UNORDERED:g} % of that): either the field has the "
            "numbering of another mesh, as after renumberMesh, or it is noise."
        )
    ]


def notes_of_types(patches: Sequence[PatchInfo]) -> list[str]:
    """Return a note for each patch of a type that OpenFOAM does not have, or that couples another patch."""
    notes = [
        f"Patch {patch.name} is of type {patch.type}, which is taken for a plain patch, as by OpenFOAM."
        for patch in patches
        if patch.type not in KINDS
    ]
    return notes + [
        f"Patch {patch.name} couples patch {patch.entries['originalPatch']}, which needs no interaction."
        for patch in patches
        if patch.type == "nonConformalCyclic" and "originalPatch" in patch.entries
    ]


def _normals(mesh: Mesh) -> tuple[Floats, Floats]:
    """Return unit normals of the boundary faces (n, 3), and their errors as angles (n,), rad."""
    start = mesh.face_start[mesh.n_internal :].astype(np.intp)
    corners = mesh.points[mesh.face_points[start[0] :]]
    spread = np.linalg.norm(corners - np.repeat(mesh.boundary_centres, np.diff(start), axis=0), axis=1)
    extent = np.maximum.reduceat(spread, start[:-1] - start[0]) if len(spread) else spread
    areas = np.maximum(np.linalg.norm(mesh.boundary_areas, axis=1), 1e-300)
    # The width of a face of length 2·extent is about its area over that length.
    doubt = 8.0 * _SINGLE * np.abs(mesh.points).max() * 2.0 * extent / areas + _LEAST_TURN
    return mesh.boundary_areas / areas[:, None], doubt


def at_cells(field: FoamField, mesh: Mesh) -> Floats:
    """Return the values of a field at all cells, (n_cells, components)."""
    if len(field.cells) not in (1, mesh.n_cells):
        raise InputError(
            f"{field.path}: internalField has {len(field.cells)} values, but there are {mesh.n_cells} cells."
        )
    cells = np.ascontiguousarray(np.broadcast_to(field.cells, (mesh.n_cells, field.cells.shape[1])))
    require_numbers(cells, field.path, "value", "at cell")
    return cells
