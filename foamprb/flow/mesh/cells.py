"""Cells of VTK's unstructured grids: their faces, and the pairs of these between two cells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.base import Ints
from foamprb.flow.mesh.boundary import PatchSurface, PolyMesh, assign_patches, find_baffles, sort_boundary
from foamprb.flow.mesh.faces import list_faces, pair_faces
from foamprb.flow.mesh.geometry import HalfFaces, order_faces
from foamprb.flow.mesh.lists import MOST_INDICES, cell_array, cell_types, int32, points_of

_POLYHEDRON = 42
# Local vertices of the faces of VTK's cell types.
_CELL_FACES: dict[int, tuple[tuple[int, ...], ...]] = {
    10: ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)),
    12: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
    13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}
_VOXEL = (0, 1, 3, 2, 4, 5, 7, 6)
_CELL_FACES[11] = tuple(tuple(_VOXEL[k] for k in face) for face in _CELL_FACES[12])
_CORNERS = np.zeros(256, dtype=np.intp)
for _kind, _faces in _CELL_FACES.items():
    _CORNERS[_kind] = 1 + max(map(max, _faces))
CELL_KINDS = {
    10: "tetrahedron", 11: "voxel", 12: "hexahedron", 13: "prism", 14: "pyramid", _POLYHEDRON: "polyhedron",
}  # fmt: skip
CURVED = {
    24: 10, 71: 10, 79: 10,
    25: 12, 29: 12, 33: 12, 72: 12, 80: 12,
    26: 13, 31: 13, 32: 13, 73: 13, 81: 13,
    27: 14, 37: 14, 74: 14,
}  # fmt: skip
"""Cells of higher order, and the cell with the same corners, which come first among their points."""
_STRAIGHT = np.arange(256, dtype=np.uint8)
_STRAIGHT[list(CURVED)] = list(CURVED.values())


def poly_of_grid(grid: Any, surfaces: Sequence[PatchSurface] | None, source: str) -> PolyMesh:
    """Return points, faces and patches of a grid; see :func:`foamprb.flow.mesh.mesh.build_mesh`."""
    given = points_of(grid)
    points = np.ascontiguousarray(given, dtype=np.float64)
    half = list_half_faces(grid, source)
    mate = match_half_faces(half, source)
    apart = np.flatnonzero(find_baffles(points, given.dtype, half.start, half.points, mate, surfaces))
    mate[mate[apart]] = mate[apart]
    mate[apart] = apart
    faces = order_faces(points, half, mate)
    flat = np.unique(faces.neighbour[faces.owner[: len(faces.neighbour)] == faces.neighbour])
    if len(flat):
        raise InputError(
            f"{source}: {len(flat)} of {len(half.first) - 1} cells have no positive volume; the first is "
            f"cell {flat[0]}, of which two faces are the same."
        )
    n_boundary = len(faces.owner) - len(faces.neighbour)
    if surfaces is None:
        return PolyMesh(points, faces, (PatchSurface("boundary", "wall", None),), np.array([0, n_boundary]))
    order, patch_start = assign_patches(points, given.dtype, faces, surfaces, source)
    sort_boundary(faces, order)
    return PolyMesh(points, faces, surfaces, patch_start)


def list_half_faces(grid: Any, source: str) -> HalfFaces:
    """List the faces of the cells of a ``vtkUnstructuredGrid``, cell by cell.

    Raises
    ------
    InputError
        Cells of an unknown type, indices out of range, or more cells than 32-bit indices allow.
    """
    types, n_points = _STRAIGHT[cell_types(grid)], grid.GetNumberOfPoints()
    unknown = sorted(set(np.flatnonzero(np.bincount(types)).tolist()) - set(CELL_KINDS))
    if unknown:
        raise InputError(
            f"{source}: cells of VTK type {', '.join(map(str, unknown))}; allowed are "
            + ", ".join(f"{kind} ({number})" for number, kind in CELL_KINDS.items())
            + "."
        )
    if len(types) == 0:
        raise InputError(f"{source}: the mesh has no cells.")
    offset, connectivity = cell_array(grid.GetCells())
    polyhedra = [*cell_array(grid.GetPolyhedronFaceLocations()), *cell_array(grid.GetPolyhedronFaces())]
    for lists in (connectivity, polyhedra[3]):
        if len(lists) and (lists.min() < 0 or lists.max() >= n_points):
            raise InputError(
                f"{source}: a cell names point {max(lists.max(), -lists.min())}, "
                f"but there are {n_points} points."
            )
        if len(lists) > MOST_INDICES:
            raise InputError(f"{source}: {len(types)} cells are too many for 32-bit indices.")
    short = np.flatnonzero(np.diff(offset) < _CORNERS[types])
    if len(short):
        raise InputError(
            f"{source}: cell {short[0]} has {np.diff(offset)[short[0]]} points, but its type is "
            f"{CELL_KINDS[types[short[0]]]}."
        )
    locations, ids, face_start, _ = polyhedra
    own = np.diff(locations)[types[: len(locations) - 1] == _POLYHEDRON].sum()
    if own != len(ids) or (len(ids) and not 0 <= ids.min() <= ids.max() < len(face_start) - 1):
        raise InputError(f"{source}: the faces of the polyhedra do not fit its cells; the mesh is damaged.")
    shapes, kinds = _shapes(), np.bincount(types, minlength=256)
    n_faces = int(kinds @ np.count_nonzero(shapes[:, :, 0], axis=1)) + len(ids)
    n_entries = int(kinds @ shapes[:, :, 0].sum(axis=1) + np.diff(face_start)[ids].sum())
    given = (types, int32(offset), int32(connectivity), shapes, *map(int32, polyhedra))
    if n_entries > MOST_INDICES:
        raise InputError(f"{source}: {n_entries} points of faces are too many for 32-bit indices.")
    half = HalfFaces(*(np.empty(n, dtype=np.int32) for n in (len(types) + 1, n_faces + 1, n_entries)))
    n_faces = link(list_faces)(*given, *half)
    return HalfFaces(half.first, half.start[: n_faces + 1], half.points[: half.start[n_faces]])


def _shapes() -> Ints:
    """Return the faces of VTK's cell types for :func:`list_faces`."""
    shapes = np.zeros((256, 6, 5), dtype=np.int32)
    for number, faces in _CELL_FACES.items():
        for k, face in enumerate(faces):
            shapes[number, k, : len(face) + 1] = (len(face), *face)
    return shapes


def match_half_faces(half: HalfFaces, source: str) -> Ints:
    """Return the other half of each interior face; boundary faces are their own mates."""
    n = len(half.start) - 1
    head, following, mate = np.full(n, -1, dtype=np.int32), *np.empty((2, n), dtype=np.int32)
    third = link(pair_faces)(half.start, half.points, head, following, mate)
    if third >= 0:
        at = np.searchsorted(half.first, third, side="right") - 1
        raise InputError(f"{source}: a face of cell {at} belongs to three or more cells.")
    return mate
