"""Division of a boundary without named patches, by an array on its faces or at its sharp edges."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.flow.mesh.boundary import PatchSurface, sort_boundary
from foamprb.flow.mesh.cells import poly_of_grid
from foamprb.flow.mesh.lists import starts
from foamprb.flow.mesh.mesh import Mesh, assemble
from foamprb.flow.read.source import Division
from foamprb.flow.read.times import listed
from foamprb.flow.read.vtk_guard import load_pyvista

BOUNDARY = "boundary"
_MOST_PATCHES = 1000


def divided(grid: Any, whole: Any, division: Division, path: Path) -> tuple[Mesh, str]:
    """Return the mesh with its boundary divided as requested, and a note for the user."""
    poly = poly_of_grid(grid, None, str(path))
    mesh = assemble(poly, str(path))
    if division.array:
        labels, names = _by_array(mesh, whole, division.array, path)
    elif division.feature_angle is not None:
        labels = _by_angle(mesh, division.feature_angle)
        names = [f"{BOUNDARY}{k}" for k in range(labels.max() + 1)]
    else:
        return mesh, " ".join(
            ["The file names no patches: the whole boundary is one wall, named boundary.", *_crossings(mesh)]
        )
    if len(names) > _MOST_PATCHES:
        raise InputError(f"{path}: the boundary falls into {len(names)} patches; at most {_MOST_PATCHES}.")
    sort_boundary(poly.faces, np.argsort(labels, kind="stable"))
    patches = [PatchSurface(name, "wall", None) for name in names]
    patch_start = starts(np.bincount(labels, minlength=len(names)))
    mesh = assemble(poly._replace(patches=patches, patch_start=patch_start), str(path))
    return mesh, " ".join([f"The boundary is divided into {patch_names(mesh)}.", *_crossings(mesh)])


def _by_array(mesh: Mesh, whole: Any, array: str, path: Path) -> tuple[NDArray[np.intp], list[str]]:
    """Return the patch of each boundary face by an array on the surface cells, and the patches' names."""
    if array not in whole.cell_data:
        raise InputError(f"{path}: no cell array {array}. {suggestion(array, whole.cell_data.keys())}")
    values = np.asarray(whole.cell_data[array])
    if values.ndim != 1 or values.dtype.kind not in "iu":
        raise InputError(f"{path}: cell array {array} is not an array of integers, one for each cell.")
    flat = [
        kind for kind in np.unique(whole.celltypes).tolist() if load_pyvista().CellType(kind).dimension == 2
    ]
    rows = np.flatnonzero(np.isin(whole.celltypes, flat))
    if len(rows) == 0:
        raise InputError(f"{path}: no surface cells among the cells, for {array} to name patches on.")
    groups = [(str(name), whole.field_data[name]) for name in list(whole.field_data.keys())]
    names = {int(value[0]): name for name, value in groups if np.size(value) == 2 and int(value[1]) == 2}
    value_of = {
        frozenset(
            map(tuple, np.asarray(whole.points, dtype=np.float64)[whole.get_cell(row).point_ids] + 0.0)
        ): (int(values[row]))
        for row in rows.tolist()
    }
    labels = np.empty(len(mesh.boundary_centres), dtype=np.intp)
    used: dict[str, int] = {}
    for face in range(len(labels)):
        begin, end = mesh.face_start[mesh.n_internal + face : mesh.n_internal + face + 2]
        corners = frozenset(map(tuple, mesh.points[mesh.face_points[begin:end]] + 0.0))
        value = value_of.get(corners)
        name = BOUNDARY if value is None else names.get(value, f"{BOUNDARY}{value}")
        labels[face] = used.setdefault(name, len(used))
    return labels, list(used)


def _boundary_edges(mesh: Mesh) -> tuple[NDArray[np.int64], NDArray[np.intp]]:
    """Return the edges of the boundary faces, face by face, as integers made of their points; their faces."""
    start = mesh.face_start[mesh.n_internal :].astype(np.intp)
    sizes = np.diff(start)
    a = mesh.face_points[start[0] :].astype(np.int64)
    b = np.roll(a, -1)
    b[start[1:] - start[0] - 1] = a[start[:-1] - start[0]]
    return (np.minimum(a, b) << 32) | np.maximum(a, b), np.repeat(np.arange(len(sizes)), sizes)


def _crossings(mesh: Mesh) -> list[str]:
    """Return a warning if the boundary touches or crosses itself, as at a cell with a wrong point."""
    edges, _ = _boundary_edges(mesh)
    crossings = np.count_nonzero(np.unique(edges, return_counts=True)[1] > 2)
    if not crossings:
        return []
    return [
        f"At {crossings} edges more than two boundary faces meet: the domain touches itself there, or cells "
        "name points that are not theirs."
    ]


def _by_angle(mesh: Mesh, angle: float) -> NDArray[np.intp]:
    """Return the patch of each boundary face; edges that turn by less than the angle join faces."""
    from scipy import sparse
    from scipy.sparse import csgraph

    edges, face = _boundary_edges(mesh)
    order = np.argsort(edges, kind="stable")
    same = edges[order[1:]] == edges[order[:-1]]
    one, other = face[order[:-1]][same], face[order[1:]][same]
    normals = mesh.boundary_areas / np.maximum(
        np.linalg.norm(mesh.boundary_areas, axis=1, keepdims=True), 1e-300
    )
    smooth = np.einsum("ei,ei->e", normals[one], normals[other]) > np.cos(np.radians(angle))
    graph = sparse.coo_array(
        (np.ones(np.count_nonzero(smooth), dtype=np.int8), (one[smooth], other[smooth])),
        shape=2 * (len(mesh.boundary_centres),),
    )
    labels: NDArray[np.intp] = csgraph.connected_components(graph, directed=False)[1].astype(np.intp)
    return labels


def patch_names(mesh: Mesh) -> str:
    """Return the patches by name, type and number of faces, for a message."""
    faces = np.diff(mesh.patch_start).tolist()
    return listed([f"{p.name} ({p.type}, {n} faces)" for p, n in zip(mesh.patches, faces, strict=True)])
