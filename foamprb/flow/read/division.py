"""Patches of a mesh file: their types, and the division of a boundary whose patches have no names.

Such files have no types of patches. They follow from the velocity: a patch that the flow crosses is an
opening, of type ``patch``. A plane along which the fluid slides, without shear, is a ``symmetryPlane``. The
others are walls.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.gradient import LeastSquaresGradient
from foamprb.flow.mesh.boundary import PatchSurface, PolyMesh, sort_boundary
from foamprb.flow.mesh.lists import Mask, starts
from foamprb.flow.mesh.mesh import Mesh, assemble
from foamprb.flow.read.source import Division
from foamprb.flow.read.vtk_guard import load_pyvista

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

BOUNDARY = "boundary"
_GUESSES = {"patch": "opening", "wall": "wall", "symmetryPlane": "symmetry plane"}
_MOST_PATCHES = 1000
_ANGLE = 30.0
"""Default angle in degrees at which openings and planes end."""
_ACROSS, _ROUND_OFF = 0.1, 1e-6
"""Least velocity across a face that is open, over the local velocity and over the largest."""
_OPEN, _OPEN_PART, _STEADY, _OPEN_VALUED = 0.5, 0.9, 0.7, 0.05
"""Least fluxes of an opening.

In the cells over that of their speed, if it is a smooth surface or a part of one; across the faces over that
in the cells; and across faces with a velocity of their own over that of its magnitude.
"""
_SLANTED, _STEADY_SLANTED, _STEADY_RISING = 0.1, 0.85, 0.6
"""The same of a smooth surface which the flow crosses at an angle; and if the speed rises towards it."""
_LEAST_SHARE = 1e-4
"""Least flux across an opening over that across all patches."""
_LEAST_FACES, _LEAST_FLUX, _LEAST_AREA = 8, 0.01, 0.1
"""Limits of a part of a smooth surface that becomes a patch of its own.

Number of faces; of an opening, its flux over that of all; of a wall, its area over that of the surface.
"""
_LEAST_SLIP, _MOST_SHEAR, _PLANE = 1e-3, 0.3, 1e-5
"""Limits of a symmetry plane: its speed over the largest, the change of velocity across the mesh, at the rate
at the plane, over the velocity, and the relative difference of its area from that of its projection."""
_AT_REST = 0.8
"""Velocity that is continued to a wall at rest over that in the cells, at most; rms.

Towards a wall at rest the velocity decreases. Along a moving wall, or one without friction, it does not.
"""
_MOST_LOST = 0.1
"""Fraction by which inflow and outflow through the openings may differ without a warning."""


class BoundaryVelocity(NamedTuple):
    """Velocity beside the boundary faces at one or more times, (n_times, n_boundary, 3), m/s."""

    faces: Floats
    """At the centres of the faces."""
    cells: Floats
    """At the centres of their cells."""
    valued: Mask
    """(n_boundary,): True where the file has a velocity of the face itself."""

    def fluxes(self, mesh: Mesh) -> Floats:
        """Return the fluxes out of the faces, (n_times, n_boundary), m³/s."""
        flux: Floats = np.einsum("tfi,fi->tf", self.faces, mesh.boundary_areas)
        return flux


def boundary_velocity(
    mesh: Mesh, data: Sequence[tuple[Any, Sequence[tuple[str, Any]]]], velocity: str
) -> BoundaryVelocity | None:
    """Return the velocity beside the boundary, or None if the data has no such array.

    Parameters
    ----------
    mesh
        The mesh, whose patches are the surfaces, if the data has any.
    data
        Cells and surfaces at each time.
    velocity
        Name of the velocity. Where surfaces have none, it is continued from the cells.
    """
    at_times = [_beside(mesh, grid, surfaces, velocity) for grid, surfaces in data]
    complete = [arrays for arrays in at_times if arrays is not None]
    if not complete:
        return None
    faces, cells, valued = map(np.stack, zip(*complete, strict=True))
    return BoundaryVelocity(faces, cells, np.any(valued, axis=0))


def _beside(
    mesh: Mesh, grid: vtkUnstructuredGrid, surfaces: Sequence[tuple[str, Any]], velocity: str
) -> tuple[Floats, Floats, Mask] | None:
    owner = mesh.owner[mesh.n_internal :]
    if np.shape(values := _vectors(grid.cell_data, velocity)) == (mesh.n_cells, 3):
        slopes, none = np.empty((mesh.n_cells, 3, 3)), np.empty(0, dtype=np.intp)
        LeastSquaresGradient.over_faces(mesh, mesh.centres, none, none.astype(np.int32))(values, slopes)
        cells = values[owner]
        way = mesh.boundary_centres - mesh.centres[owner]
        faces = cells + np.einsum("nij,nj->ni", slopes[owner], way)
    elif np.shape(values := _vectors(grid.point_data, velocity)) == (mesh.n_points, 3):
        start = mesh.face_start[mesh.n_internal :].astype(np.intp)
        faces = _means(values[mesh.face_points[start[0] :]], start - start[0])
        cells = _means(values[mesh.cell_points], mesh.cell_point_start)[owner]
    else:
        return None
    valued = np.zeros(len(owner), dtype=bool)
    for index, (_, surface) in enumerate(surfaces):
        first, last = mesh.patch_start[index : index + 2]
        if velocity not in surface.cell_data and velocity in surface.point_data:
            surface = surface.point_data_to_cell_data()
        if np.shape(on_patch := _vectors(surface.cell_data, velocity)) == (last - first, 3):
            faces[first:last], valued[first:last] = on_patch, True
    return faces, cells, valued


def _vectors(data: Any, name: str) -> Floats:
    return np.asarray(data.get(name, []), dtype=np.float64)


def _means(values: Floats, start: NDArray[np.generic]) -> Floats:
    """Return the means of consecutive lists of vectors."""
    means: Floats = np.add.reduceat(values, start[:-1].astype(np.intp)) / np.diff(start)[:, None]
    return means


def with_types(mesh: Mesh, u: BoundaryVelocity | None) -> Mesh:
    """Return a mesh of named patches with their types."""
    labels = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
    types = ["wall"] * len(mesh.patches) if u is None else _types(mesh, u, labels)
    patches = [patch._replace(type=kind) for patch, kind in zip(mesh.patches, types, strict=True)]
    return replace(mesh, patches=tuple(patches))


def divided(
    poly: PolyMesh, mesh: Mesh, whole: Any, division: Division, u: BoundaryVelocity | None, path: Path
) -> tuple[Mesh, BoundaryVelocity | None, list[str]]:
    """Return the mesh with its boundary divided, the velocity beside it, and warnings.

    Parameters
    ----------
    poly, mesh
        The mesh with one patch, before and after its assembly.
    whole
        Contents of the file.
    division
        Array or angle that divides the boundary.
    u
        Velocity beside the boundary, None if it is unknown.
    path
        The file, for messages.
    """
    if division.array:
        labels, names = _by_array(mesh, whole, division.array, path)
        types = ["wall"] * len(names) if u is None else _types(mesh, u, labels)
    else:
        labels, types = _by_velocity(mesh, u, division.feature_angle)
        names = _numbered([_GUESSES[kind].split()[0] for kind in types])
    if len(names) > _MOST_PATCHES:
        raise InputError(f"{path}: the boundary falls into {len(names)} patches; at most {_MOST_PATCHES}.")
    order = np.argsort(labels, kind="stable")
    sort_boundary(poly.faces, order)
    patches = [PatchSurface(name, kind, None) for name, kind in zip(names, types, strict=True)]
    patch_start = starts(np.bincount(labels, minlength=len(names)))
    mesh = assemble(poly._replace(patches=patches, patch_start=patch_start), str(path))
    u = u and BoundaryVelocity(u.faces[:, order], u.cells[:, order], u.valued[order])
    return mesh, u, _crossings(mesh)


def _numbered(names: Sequence[str]) -> list[str]:
    """Return the names, those that occur several times with numbers."""
    totals, counts = Counter(names), Counter[str]()
    numbered = []
    for name in names:
        numbered.append(f"{name}{counts[name]}" if totals[name] > 1 else name)
        counts[name] += 1
    return numbered


def _by_velocity(
    mesh: Mesh, u: BoundaryVelocity | None, angle: float | None
) -> tuple[NDArray[np.intp], list[str]]:
    """Return the patch of each boundary face, and the types of the patches; walls are one without an angle.

    Each smooth surface is an opening, or not, as most of its area. Large enough parts of the other kind are
    patches of their own: an opening in a wall, or a wall beside an opening.
    """
    limit = _ANGLE if angle is None else angle
    surface = _by_angle(mesh, limit, np.zeros(len(mesh.boundary_centres)))
    if u is None:
        return (surface, ["wall"] * (surface.max() + 1)) if angle else (np.zeros_like(surface), ["wall"])
    areas, is_open = np.linalg.norm(mesh.boundary_areas, axis=1), _open_faces(mesh, u)
    mostly = _are_openings(mesh, u, surface)[surface]
    other = is_open != mostly
    part = _by_angle(mesh, limit, other)
    flux = u.fluxes(mesh) * is_open
    through = np.abs([np.bincount(part, f) for f in flux]).max(axis=0)
    crossed = through >= _LEAST_FLUX * 0.5 * np.abs(flux).sum(axis=1).max()
    crossed &= _are_openings(mesh, u, part, _OPEN_PART)
    wide = np.bincount(part, areas)[part] >= _LEAST_AREA * np.bincount(surface, areas)[surface]
    apart = other & (np.bincount(part) >= _LEAST_FACES)[part] & np.where(mostly, wide, crossed[part])
    labels = _by_angle(mesh, limit, mostly ^ apart)
    types = _types(mesh, u, labels)
    if angle is None:
        # All walls are one patch.
        is_wall = np.array([kind == "wall" for kind in types])
        used, labels = np.unique(np.where(is_wall[labels], is_wall.argmax(), labels), return_inverse=True)
        types = [types[k] for k in used]
    return labels, types


def _open_faces(mesh: Mesh, u: BoundaryVelocity) -> Mask:
    """Return True for boundary faces that the flow crosses at any time."""
    areas = np.maximum(np.linalg.norm(mesh.boundary_areas, axis=1), 1e-300)
    across, along = np.abs(u.fluxes(mesh)) / areas, np.linalg.norm([u.faces, u.cells], axis=3)
    is_open: Mask = np.any(
        (across > _ACROSS * along.max(axis=0)) & (across > _ROUND_OFF * along.max()), axis=0
    )
    return is_open


def _are_openings(mesh: Mesh, u: BoundaryVelocity, labels: NDArray[np.intp], least: float = _OPEN) -> Mask:
    """Return True for patches that the flow crosses, from the patch of each boundary face.

    Towards a wall the velocity across it decreases, so that it is continued to another value or direction.
    ``least`` is the fraction of the speed in the cells that must be across the patch.
    """
    normals = mesh.boundary_areas
    at_faces, in_cells = (np.einsum("tfi,fi->tf", v, normals) for v in (u.faces, u.cells))
    steady = np.where(at_faces * in_cells > 0.0, np.minimum(np.abs(at_faces), np.abs(in_cells)), 0.0)
    stated = np.abs(at_faces) * u.valued
    # The largest fluxes that the speeds in the cells and on the faces allow.
    allowed = np.linalg.norm(u.cells, axis=2) * np.linalg.norm(normals, axis=1)
    at_most = np.linalg.norm(u.faces, axis=2) * np.linalg.norm(normals, axis=1)
    sums = (np.bincount(labels, f.sum(axis=0)) for f in (steady, np.abs(in_cells), stated, allowed, at_most))
    steady, across, stated, allowed, at_most = sums
    openings: Mask = (steady >= _STEADY * across) & (across >= least * allowed)
    if least == _OPEN:
        most = np.where(_falls(u, labels, 1.0), _STEADY_SLANTED, _STEADY_RISING)
        slanted = (steady >= most * across) & (across >= _SLANTED * allowed)
        openings |= slanted & ~_falls(u, labels)
    openings &= steady > _LEAST_SHARE * steady.sum()
    openings |= (stated > _ROUND_OFF * stated.sum()) & (stated >= _OPEN_VALUED * at_most)
    return openings


def _types(mesh: Mesh, u: BoundaryVelocity, labels: NDArray[np.intp]) -> list[str]:
    """Return the types of patches from the patch of each boundary face."""
    areas = np.linalg.norm(mesh.boundary_areas, axis=1)
    total = np.maximum(np.bincount(labels, areas), 1e-300)
    opening = _are_openings(mesh, u, labels)
    vector = np.stack([np.bincount(labels, column) for column in mesh.boundary_areas.T], axis=1)
    normals = vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-300)
    flat = np.linalg.norm(vector, axis=1) > (1.0 - _PLANE) * total
    n = normals[labels]
    depth = np.einsum("fi,fi->f", mesh.boundary_centres - mesh.centres[mesh.owner[mesh.n_internal :]], n)
    extent = np.ptp(mesh.points, axis=0)
    width, least_depth = np.abs(n) @ extent, 1e-9 * extent.max()
    speed = np.square(u.faces).sum(axis=(0, 2))
    shear = np.square(u.faces - u.cells).sum(axis=(0, 2)) * (width / np.maximum(depth, least_depth)) ** 2
    slip, sheared = np.bincount(labels, areas * speed), np.bincount(labels, areas * shear)
    largest = np.square(u.cells).sum(axis=(0, 2)).max(initial=0.0)
    sliding = flat & (slip > _LEAST_SLIP**2 * largest * total) & (sheared < _MOST_SHEAR**2 * slip)
    return ["patch" if o else "symmetryPlane" if s else "wall" for o, s in zip(opening, sliding, strict=True)]


def faces_at_rest(mesh: Mesh, u: BoundaryVelocity | None) -> Mask:
    """Return True for boundary faces of smooth walls towards which the velocity decreases."""
    labels = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
    if u is None:
        return np.zeros(len(labels), dtype=bool)
    walls = np.array([patch.type == "wall" for patch in mesh.patches], dtype=bool)[labels]
    labels = _by_angle(mesh, _ANGLE, labels)
    at_rest: Mask = walls & _falls(u, labels)[labels]
    return at_rest


def _falls(u: BoundaryVelocity, labels: NDArray[np.intp], most: float = _AT_REST) -> Mask:
    """Return True for patches towards which the speed decreases, by default as towards a wall at rest."""
    at_faces, in_cells = (np.bincount(labels, np.square(v).sum(axis=(0, 2))) for v in (u.faces, u.cells))
    falls: Mask = at_faces < most**2 * in_cells
    return falls


def patch_lines(mesh: Mesh, u: BoundaryVelocity | None) -> list[str]:
    """Return a line for each patch: name, faces, guess, area, and flux at the first time."""
    areas, flux = np.linalg.norm(mesh.boundary_areas, axis=1), None if u is None else u.fluxes(mesh)[0]
    lines = []
    for index, patch in enumerate(mesh.patches):
        rows = slice(*mesh.patch_start[index : index + 2])
        centre = "({:.4g} {:.4g} {:.4g})".format(*mesh.boundary_centres[rows].mean(axis=0))
        rate = "" if flux is None else f", {flux[rows].sum():.4g} m3/s out"
        lines.append(
            f"{patch.name:20s} {rows.stop - rows.start:10d} faces  {_GUESSES[patch.type]:14s}  "
            f"{areas[rows].sum():.4g} m2{rate}, about {centre}"
        )
    return lines


def lost_flow(mesh: Mesh, u: BoundaryVelocity) -> list[Caveat]:
    """Return a warning if inflow and outflow through the openings differ."""
    opening = np.repeat([patch.type == "patch" for patch in mesh.patches], np.diff(mesh.patch_start))
    flux = u.fluxes(mesh)[0][opening]
    inflow, outflow = -flux[flux < 0.0].sum(), flux[flux > 0.0].sum()
    if abs(inflow - outflow) <= _MOST_LOST * max(inflow, outflow):
        return []
    return [
        Caveat(
            f"{inflow:.4g} m3/s enter and {outflow:.4g} m3/s leave through the openings that the velocity "
            "shows: is one of the walls an opening? -patchArray or -featureAngle divide the boundary, and a "
            ".vtm file names its patches."
        )
    ]


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


def _by_angle(mesh: Mesh, angle: float, groups: NDArray[np.generic]) -> NDArray[np.intp]:
    """Return the patch of each boundary face.

    Edges that turn by less than the angle, in degrees, join faces of the same group.
    """
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
    smooth &= groups[one] == groups[other]
    graph = sparse.coo_array(
        (np.ones(np.count_nonzero(smooth), dtype=np.int8), (one[smooth], other[smooth])),
        shape=2 * (len(mesh.boundary_centres),),
    )
    labels: NDArray[np.intp] = csgraph.connected_components(graph, directed=False)[1].astype(np.intp)
    return labels
