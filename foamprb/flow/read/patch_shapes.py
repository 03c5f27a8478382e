"""Checks that patches have the shape that their types promise, as OpenFOAM or its checkMesh make them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.boundary import TYPES, PatchInfo

_PLANAR = {"symmetryPlane": "; the type of a curved one is symmetry", "wedge": ""}
_SINGLE = 6e-8
"""Relative error of coordinates in single precision."""
_LEAST_TURN = 1e-6
"""Least angle, rad, by which a face is held to be turned, however exact its coordinates."""


def require_patch_shapes(mesh: Mesh, source: Path) -> None:
    """Raise InputError for curved symmetry planes and wedges, and for ``empty`` patches of a 3-D mesh."""
    normals, doubt = _normals(mesh)
    faces = [slice(*mesh.patch_start[i : i + 2]) for i in range(len(mesh.patches))]
    for patch, part in zip(mesh.patches, faces, strict=True):
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
    """Each empty face must look along a coordinate, and each cell have two in each such direction."""
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


def notes_of_types(patches: Sequence[PatchInfo]) -> list[str]:
    """A note for each patch of a type that OpenFOAM itself does not have."""
    return [
        f"Patch {patch.name} is of type {patch.type}, which is taken for a plain patch, as by OpenFOAM."
        for patch in patches
        if patch.type not in TYPES
    ]


def _normals(mesh: Mesh) -> tuple[Floats, Floats]:
    """Unit normals of the boundary faces (n, 3), and the angles (n,), rad, by which they may be off."""
    start = mesh.face_start[mesh.n_internal :].astype(np.intp)
    corners = mesh.points[mesh.face_points[start[0] :]]
    spread = np.linalg.norm(corners - np.repeat(mesh.boundary_centres, np.diff(start), axis=0), axis=1)
    extent = np.maximum.reduceat(spread, start[:-1] - start[0]) if len(spread) else spread
    areas = np.maximum(np.linalg.norm(mesh.boundary_areas, axis=1), 1e-300)
    # A face of length 2·extent is about as wide as its area over that.
    doubt = 8.0 * _SINGLE * np.abs(mesh.points).max() * 2.0 * extent / areas + _LEAST_TURN
    return mesh.boundary_areas / areas[:, None], doubt
