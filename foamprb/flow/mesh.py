"""Polyhedral cells → faces, neighbours, tetrahedra and patches.

A cell is bounded by faces of any number of vertices. Every face is cut into triangles as a fan, in the same
way for the two cells that share it, and each triangle with the centre of a cell makes one tetrahedron. The
tetrahedra fill the mesh without a gap, and a field given at mesh points and cell centres is continuous and
piecewise linear on them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph

from foamprb.errors import InputError
from foamprb.flow.coupling import Coupling, couple
from foamprb.flow.patch import Patch

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int32]
_Index: TypeAlias = NDArray[np.intp]
_Hash: TypeAlias = NDArray[np.uint64]
_Mask: TypeAlias = NDArray[np.bool_]

__all__ = ["Mesh", "Patch", "PatchSurface", "build_mesh"]

_POLYHEDRON = 42
# Faces of VTK's cell types by local vertex.
_CELL_FACES: dict[int, tuple[tuple[int, ...], ...]] = {
    10: ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)),
    12: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
    13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}
CELL_KINDS = {10: "tetrahedron", 12: "hexahedron", 13: "prism", 14: "pyramid", _POLYHEDRON: "polyhedron"}

# Faces or cells handled at once: the temporary arrays then stay in the cache.
_CHUNK = 1 << 15
_MOST_TURNS = 5


class PatchSurface(NamedTuple):
    """A patch with its faces, ``surface`` a ``pyvista.PolyData`` with points of its own."""

    name: str
    type: str
    surface: Any
    neighbour: str = ""
    """The patch that a cyclic patch leads to."""


@dataclass(frozen=True)
class Mesh:
    """Cells, faces and tetrahedra of a mesh; lengths in metres.

    Nodes are the mesh points followed by the cell centres: the centre of cell c is node ``n_points + c``.
    Interior faces come first; boundary faces follow, patch by patch and in each patch's own order.
    """

    points: Floats
    """(n_points, 3)."""
    centres: Floats
    """(n_cells, 3), centres of volume by pyramids about the mean of the face centres, as in OpenFOAM."""
    volumes: Floats
    """(n_cells,), from the same pyramids, m³."""
    cell_point_start: Ints
    """(n_cells + 1,) into ``cell_points``."""
    cell_points: Ints
    """Points of each cell."""
    face_start: Ints
    """(n_faces + 1,) into ``face_points``."""
    face_points: Ints
    """Points of each face, turning outwards from the owner; the first is the base of the face's fan."""
    owner: Ints
    """(n_faces,)."""
    neighbour: Ints
    """(n_internal,)."""
    patches: tuple[Patch, ...]
    patch_start: Ints
    """(n_patches + 1,): boundary faces of patch p are ``patch_start[p]`` to ``patch_start[p + 1]``."""
    boundary_centres: Floats
    """(n_boundary, 3), centres of the boundary faces."""
    boundary_areas: Floats
    """(n_boundary, 3), their area vectors, outward, m²."""
    cell_start: Ints
    """(n_cells + 1,): the tetrahedra of cell c are ``cell_start[c]`` to ``cell_start[c + 1]``."""
    tets: Ints
    """(n_tets, 4) nodes; the first is the cell centre, the other three turn outwards."""
    neighbours: Ints
    """(n_tets, 4): the tetrahedron across the face opposite each vertex; −1 − b for boundary triangle b."""
    triangles: Ints
    """(n_triangles, 3) nodes of the boundary triangles, turning outwards."""
    triangle_patch: Ints
    """(n_triangles,) index into ``patches``."""
    triangle_face: Ints
    """(n_triangles,) boundary face (0 is the first boundary face)."""
    triangle_tet: Ints
    """(n_triangles,) the tetrahedron inside."""
    triangle_normals: Floats
    """(n_triangles, 3) unit normals, inward."""
    inverted: int
    """Number of tetrahedra of negative volume."""
    couplings: tuple[Coupling, ...]
    """Cyclic patches and wedges, each way."""

    @property
    def n_points(self) -> int:
        """Number of mesh points."""
        return len(self.points)

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return len(self.centres)

    @property
    def n_internal(self) -> int:
        """Number of faces between two cells."""
        return len(self.neighbour)

    @property
    def nodes(self) -> Floats:
        """(n_points + n_cells, 3), mesh points followed by cell centres."""
        return np.concatenate([self.points, self.centres])


def build_mesh(grid: Any, surfaces: Sequence[PatchSurface] | None = None, source: str = "mesh") -> Mesh:
    """Find faces, neighbours, patches and tetrahedra of an unstructured grid.

    Parameters
    ----------
    grid
        ``pyvista.UnstructuredGrid`` of tetrahedra, hexahedra, prisms, pyramids and polyhedra.
    surfaces
        The patches. A face is known by the coordinates of its vertices, equal to the last bit. None: the
        source knows no patches, and the whole boundary is one patch ``boundary`` of type ``wall``.
    source
        What the messages call the grid, e.g. its file.

    Raises
    ------
    InputError
        Cells of another type; a face of three cells; an open cell; boundary faces that no patch has or two
        patches have; patch faces that are not on the boundary.
    """
    points = np.ascontiguousarray(grid.points, dtype=np.float64)
    half = _half_faces(grid, source)
    first, second = _match_halves(half, source)
    cell_point_start, cell_points = _cell_array(grid.GetCells())
    apart = _baffles(points, grid.points.dtype, half, first, second, surfaces)
    if apart.any():
        split = np.concatenate([first[apart], second[apart]])
        first, second = (np.concatenate([ends[~apart], split]) for ends in (first, second))
        points, half, cell_points = _part_points(points, half, first, second, cell_point_start, cell_points)
    half, owner_half, neighbour_half = _order_faces(points, half, first, second)
    cells = (_int32(cell_point_start), _int32(cell_points))
    for _ in range(_MOST_TURNS):
        mesh, astray = _assemble(
            points, grid.points.dtype, half, owner_half, neighbour_half, cells, surfaces, source
        )
        if len(astray) == 0:
            return mesh
        half = _turn_alike(half, owner_half, neighbour_half, astray)
    raise InputError(
        f"{source}: the faces of {len(astray)} cells do not turn alike (the first is cell {astray[0]}); "
        "is the mesh damaged?"
    )


def _assemble(
    points: Floats,
    dtype: Any,
    half: _Halves,
    owner_half: _Index,
    neighbour_half: _Index,
    cells: tuple[Ints, Ints],
    surfaces: Sequence[PatchSurface] | None,
    source: str,
) -> tuple[Mesh, _Index]:
    """The mesh, and cells of which two neighbouring faces turn against each other."""
    order, patches, patch_start = _assign_patches(points, dtype, half, owner_half, surfaces, source)
    n_internal = len(neighbour_half)
    owner_half = np.concatenate([owner_half[:n_internal], owner_half[n_internal:][order]])
    face_start, face_points = _take_lists(half.start, half.points, owner_half)
    owner, neighbour = half.cell[owner_half], half.cell[neighbour_half]

    face_centres, areas = _face_geometry(points, face_start, face_points)
    patches, couplings = couple(patches, patch_start, face_centres[n_internal:], areas[n_internal:], source)
    centres, volumes = _cell_geometry(face_centres, areas, owner, neighbour, half.n_cells)
    face_points, inverted = _choose_bases(points, centres, face_start, face_points, owner, neighbour)

    cell_start, tets, neighbours, triangle_tet, astray = _tetrahedra(
        half, face_start, face_points, owner_half, neighbour_half, len(points), source
    )
    triangles = tets[triangle_tet][:, 1:]
    counts = np.diff(face_start)[n_internal:] - 2
    triangle_face = np.repeat(np.arange(len(counts)), counts)
    boundary_patch = np.repeat(np.arange(len(patches)), np.diff(patch_start))
    mesh = Mesh(
        points=points,
        centres=centres,
        volumes=volumes,
        cell_point_start=cells[0],
        cell_points=cells[1],
        face_start=_int32(face_start),
        face_points=_int32(face_points),
        owner=_int32(owner),
        neighbour=_int32(neighbour),
        patches=patches,
        patch_start=_int32(patch_start),
        boundary_centres=face_centres[n_internal:].copy(),
        boundary_areas=areas[n_internal:].copy(),
        cell_start=_int32(cell_start),
        tets=tets,
        neighbours=neighbours,
        triangles=np.ascontiguousarray(triangles),
        triangle_patch=_int32(boundary_patch[triangle_face]),
        triangle_face=_int32(triangle_face),
        triangle_tet=_int32(triangle_tet),
        triangle_normals=_inward_normals(points, triangles, areas[n_internal:][triangle_face]),
        inverted=inverted,
        couplings=couplings,
    )
    return mesh, astray


class _Halves(NamedTuple):
    """The faces of each cell, cell after cell: an interior face appears twice."""

    n_cells: int
    cell: _Index
    start: _Index
    points: _Index


def _half_faces(grid: Any, source: str) -> _Halves:
    types = np.asarray(grid.celltypes)
    unknown = sorted(set(np.unique(types).tolist()) - set(CELL_KINDS))
    if unknown:
        raise InputError(
            f"{source}: cells of VTK type {', '.join(map(str, unknown))}; allowed are "
            + ", ".join(f"{kind} ({number})" for number, kind in CELL_KINDS.items())
            + "."
        )
    if len(types) == 0:
        raise InputError(f"{source}: the mesh has no cells.")
    offset, connectivity = _cell_array(grid.GetCells())
    if len(connectivity) and (connectivity.min() < 0 or connectivity.max() >= len(grid.points)):
        raise InputError(
            f"{source}: a cell names point {max(connectivity.max(), -connectivity.min())}, "
            f"but there are {len(grid.points)} points."
        )
    faces_per_cell = np.zeros(len(types), dtype=np.intp)
    for number, table in _CELL_FACES.items():
        faces_per_cell[types == number] = len(table)
    polyhedra = np.flatnonzero(types == _POLYHEDRON)
    if len(polyhedra):
        locations, face_ids = _cell_array(grid.GetPolyhedronFaceLocations())
        poly_start, poly_points = _cell_array(grid.GetPolyhedronFaces())
        faces_per_cell[polyhedra] = np.diff(locations)[polyhedra]
    first = _starts(faces_per_cell)

    sizes = np.zeros(first[-1], dtype=np.intp)
    cells_of = {number: np.flatnonzero(types == number) for number in _CELL_FACES}
    for number, table in _CELL_FACES.items():
        for k, face in enumerate(table):
            sizes[first[cells_of[number]] + k] = len(face)
    if len(polyhedra):
        wanted = face_ids[_ragged(locations[polyhedra], faces_per_cell[polyhedra])]
        targets = _ragged(first[polyhedra], faces_per_cell[polyhedra])
        sizes[targets] = np.diff(poly_start)[wanted]
    start = _starts(sizes)
    points = np.empty(start[-1], dtype=np.intp)
    for number, table in _CELL_FACES.items():
        for k, face in enumerate(table):
            cells = cells_of[number]
            to = start[first[cells] + k][:, None] + np.arange(len(face))
            points[to] = connectivity[offset[cells][:, None] + np.array(face)]
    if len(polyhedra):
        points[_ragged(start[targets], sizes[targets])] = poly_points[
            _ragged(poly_start[wanted], sizes[targets])
        ]
    if sizes.min() < 3:
        raise InputError(f"{source}: a face of {sizes.min()} vertices; at least 3 are needed.")
    return _Halves(len(types), np.repeat(np.arange(len(types)), faces_per_cell), start, points)


def _match_halves(half: _Halves, source: str) -> tuple[_Index, _Index]:
    """First and second half of each interior face; a half without a mate has itself as second."""
    # The sum does not depend on where the list starts or which way it turns.
    codes = np.add.reduceat(_mix(half.points), half.start[:-1])
    order = np.argsort(codes)
    same = codes[order[1:]] == codes[order[:-1]]
    if np.any(same[1:] & same[:-1]):
        at = half.cell[order[1:-1][same[1:] & same[:-1]][0]]
        raise InputError(f"{source}: a face of cell {at} belongs to three or more cells.")
    one, other = order[:-1][same], order[1:][same]
    first, second = np.minimum(one, other), np.maximum(one, other)
    sizes = np.diff(half.start)
    wrong = sizes[first] != sizes[second]
    for size, at in _by_size(sizes[first]):
        if not wrong[at].any():
            a = _lists(half.start, half.points, first[at], size)
            b = _lists(half.start, half.points, second[at], size)
            wrong[at] = np.any(np.sort(a, axis=1) != np.sort(b, axis=1), axis=1)
    if wrong.any():
        raise InputError(
            f"{source}: cells {half.cell[first[wrong][0]]} and {half.cell[second[wrong][0]]} do not fit "
            "together."
        )
    mate = np.arange(len(half.cell))
    mate[first], mate[second] = second, first
    owners = np.flatnonzero(mate >= np.arange(len(mate)))
    return owners, mate[owners]


def _baffles(
    points: Floats,
    dtype: Any,
    half: _Halves,
    first: _Index,
    second: _Index,
    surfaces: Sequence[PatchSurface] | None,
) -> _Mask:
    """Which of the matched faces belong to patches: walls without thickness, with a patch on either side."""
    inside = first != second
    faces = sum(surface.surface.n_cells for surface in surfaces or ())
    none = np.zeros(len(first), dtype=bool)
    if surfaces is None or faces <= np.count_nonzero(~inside):
        return none
    polygons = [_cell_array(surface.surface.GetPolys()) for surface in surfaces]
    clouds = [np.asarray(surface.surface.points, dtype=dtype).reshape(-1, 3) for surface in surfaces]
    coordinates = np.concatenate([points.astype(dtype), *clouds]) + 0
    place = np.unique(coordinates, axis=0, return_inverse=True)[1].reshape(-1).astype(np.intp)
    begin, wanted = len(points), []
    for (start, lists), cloud in zip(polygons, clouds, strict=True):
        if len(start) > 1:
            wanted.append(np.add.reduceat(_mix(place[begin + lists]), start[:-1]))
        begin += len(cloud)
    codes = np.add.reduceat(_mix(place[half.points]), half.start[:-1])
    found: _Mask = inside & np.isin(codes[first], np.concatenate(wanted))
    return found


def _part_points(
    points: Floats, half: _Halves, first: _Index, second: _Index, start: _Index, cell_points: _Index
) -> tuple[Floats, _Halves, _Index]:
    """Give each side of a baffle points of its own, where no way around through cells joins the sides.

    Around a point, cells are joined by the faces between them that hold the point; a point whose cells fall
    into several groups is copied for each group but one.
    """
    on_wall = np.zeros(len(points), dtype=bool)
    sizes = np.diff(half.start)
    single = first[first == second]
    on_wall[_take_lists(half.start, half.points, single)[1]] = True
    # Corners: a cell and one of its points on a wall.
    cells = np.repeat(np.arange(half.n_cells), np.diff(start))
    at = np.flatnonzero(on_wall[cell_points])
    keys = cells[at] * len(points) + cell_points[at]
    order = np.argsort(keys)
    keys = keys[order]
    inside = first != second
    owners = np.repeat(half.cell[first[inside]], sizes[first[inside]])
    others = np.repeat(half.cell[second[inside]], sizes[first[inside]])
    shared = _take_lists(half.start, half.points, first[inside])[1]
    held = on_wall[shared]
    joined = [
        np.searchsorted(keys, side[held] * len(points) + shared[held]).astype(np.intp)
        for side in (owners, others)
    ]
    graph = sparse.coo_array((np.ones(len(joined[0]), dtype=np.int8), joined), shape=(len(keys), len(keys)))
    groups = csgraph.connected_components(graph, directed=False)[1]
    point = cell_points[at[order]]
    # The first group of a point keeps it, each other group gets a copy.
    pairs, place = np.unique(np.stack([point, groups]), axis=1, return_inverse=True)
    copy = np.concatenate([[False], pairs[0, 1:] == pairs[0, :-1]])
    names = np.where(copy, len(points) + np.cumsum(copy) - 1, pairs[0])
    named = names[place.reshape(-1)]
    moved = cell_points.copy()
    moved[at[order]] = named
    lists = half.points.copy()
    on_lists = np.flatnonzero(on_wall[lists])
    of_half = np.repeat(half.cell, sizes)[on_lists]
    lists[on_lists] = named[np.searchsorted(keys, of_half * len(points) + lists[on_lists])]
    return np.concatenate([points, points[pairs[0, copy]]]), half._replace(points=lists), moved


def _order_faces(
    points: Floats, half: _Halves, first: _Index, second: _Index
) -> tuple[_Halves, _Index, _Index]:
    """Put interior faces first and let every list turn outwards from its cell."""
    inside = first != second
    owner_half = np.concatenate([first[inside], first[~inside]])
    neighbour_half = second[inside]
    n_internal = len(neighbour_half)
    means = np.empty((len(owner_half), 3))
    normals = np.empty((len(owner_half), 3))
    for size, at in _by_size(np.diff(half.start)[owner_half]):
        corners = points[_lists(half.start, half.points, owner_half[at], size)]
        means[at] = corners.mean(axis=1)
        normals[at] = _area(corners)
    owner, neighbour = half.cell[owner_half], half.cell[neighbour_half]
    guess = _per_cell(means, owner, neighbour, half.n_cells)
    guess /= _per_cell(np.ones((len(owner), 1)), owner, neighbour, half.n_cells)
    ahead = np.concatenate([guess[neighbour], means[n_internal:]]) - guess[owner]
    inwards = np.einsum("fi,fi->f", normals, ahead) < 0.0
    lists = half.points.copy()
    for size, at in _by_size(np.diff(half.start)[owner_half]):
        own = _lists(half.start, half.points, owner_half[at], size)
        own[inwards[at]] = own[inwards[at]][:, ::-1]
        lists[half.start[owner_half[at]][:, None] + np.arange(size)] = own
        at = at[at < n_internal]
        to = half.start[neighbour_half[at]][:, None] + np.arange(size)
        lists[to] = own[: len(at), ::-1]
    return half._replace(points=lists), owner_half, neighbour_half


def _assign_patches(
    points: Floats,
    dtype: Any,
    half: _Halves,
    owner_half: _Index,
    surfaces: Sequence[PatchSurface] | None,
    source: str,
) -> tuple[_Index, tuple[Patch, ...], _Index]:
    """Order of the boundary faces by patch; the patches; where each begins."""
    neighbours = len(half.cell) - len(owner_half)
    boundary = owner_half[neighbours:]
    if surfaces is None:
        everything = np.arange(len(boundary))
        return everything, (Patch("boundary", "wall"),), np.array([0, len(boundary)])
    start, lists = _take_lists(half.start, half.points, boundary)
    polygons = [_cell_array(surface.surface.GetPolys()) for surface in surfaces]
    clouds = [np.asarray(surface.surface.points, dtype=dtype).reshape(-1, 3) for surface in surfaces]
    used, local = np.unique(lists, return_inverse=True)
    # A point is known by its coordinates; adding zero makes −0 equal to 0.
    coordinates = np.concatenate([points[used].astype(dtype), *clouds]) + 0
    place = np.unique(coordinates, axis=0, return_inverse=True)[1].reshape(-1).astype(np.intp)
    codes = _turning_codes(start, place[local])
    order = np.argsort(codes, kind="stable")

    chosen: list[_Index] = []
    first_point = len(used)
    for surface, (poly_start, poly_points), cloud in zip(surfaces, polygons, clouds, strict=True):
        ids = place[first_point + poly_points]
        first_point += len(cloud)
        found = _find(codes, order, _turning_codes(poly_start, ids))
        # Two patches may lie on the same points (baffles): then only the sense of rotation tells them apart.
        astray = found < 0
        found[astray] = _find(codes, order, _turning_codes(poly_start, ids, reverse=True))[astray]
        if np.any(found < 0):
            raise InputError(
                f"{source}: {np.count_nonzero(found < 0)} of the {len(found)} faces of patch {surface.name} "
                "are not on the boundary of the mesh."
            )
        chosen.append(found)
    faces = np.concatenate([np.empty(0, dtype=np.intp), *chosen])
    times = np.bincount(faces, minlength=len(boundary))
    names = ", ".join(surface.name for surface in surfaces) or "(none)"
    if np.any(times == 0):
        raise InputError(
            f"{source}: {np.count_nonzero(times == 0)} of {len(boundary)} boundary faces belong to no patch; "
            f"the patches are {names}."
        )
    if np.any(times > 1):
        raise InputError(
            f"{source}: {np.count_nonzero(times > 1)} boundary faces belong to more than one of the patches "
            f"{names}."
        )
    patches = tuple(Patch(surface.name, surface.type, surface.neighbour) for surface in surfaces)
    return faces, patches, _starts(np.array([len(found) for found in chosen], dtype=np.intp))


def _face_geometry(points: Floats, start: _Index, lists: _Index) -> tuple[Floats, Floats]:
    """Face centres and area vectors, by triangles about the mean of the vertices."""
    centres, areas = np.empty((len(start) - 1, 3)), np.empty((len(start) - 1, 3))
    for size, at in _by_size(np.diff(start)):
        corners = points[_lists(start, lists, at, size)]
        middle = corners.mean(axis=1)
        areas[at] = _area(corners)
        if size == 3:
            centres[at] = middle
            continue
        weights, moment = np.zeros(len(at)), np.zeros((len(at), 3))
        for k in range(size):
            a, b = corners[:, k], corners[:, (k + 1) % size]
            area = np.einsum("fi,fi->f", _cross(a - middle, b - middle), areas[at])
            weights += area
            moment += area[:, None] * ((a - middle) + (b - middle))
        # A face folded onto itself has no area to weigh with; its mean is as good a centre as any.
        weights[weights == 0.0] = np.inf
        centres[at] = middle + moment / (3.0 * weights[:, None])
    return centres, areas


def _cell_geometry(
    face_centres: Floats, areas: Floats, owner: _Index, neighbour: _Index, n_cells: int
) -> tuple[Floats, Floats]:
    """Cell centres and volumes, by pyramids about the mean of the face centres."""
    n_internal = len(neighbour)
    guess = _per_cell(face_centres, owner, neighbour, n_cells)
    guess /= _per_cell(np.ones((len(owner), 1)), owner, neighbour, n_cells)

    def pyramids(cells: _Index, faces: slice, sign: float) -> tuple[Floats, Floats]:
        arm = face_centres[faces] - guess[cells]
        volume = sign / 3.0 * np.einsum("fi,fi->f", areas[faces], arm)
        return volume, (0.75 * volume)[:, None] * arm

    own, own_moment = pyramids(owner, slice(None), 1.0)
    across, across_moment = pyramids(neighbour, slice(n_internal), -1.0)
    volumes = np.zeros(n_cells)
    volumes += np.bincount(owner, own, n_cells)
    volumes += np.bincount(neighbour, across, n_cells)
    moments = _sum_per_cell(own_moment, owner, n_cells) + _sum_per_cell(across_moment, neighbour, n_cells)
    centres: Floats = guess + moments / np.where(volumes == 0.0, np.inf, volumes)[:, None]
    return centres, volumes


def _choose_bases(
    points: Floats, centres: Floats, start: _Index, lists: _Index, owner: _Index, neighbour: _Index
) -> tuple[_Index, int]:
    """Rotate every list so that its fan has the best worst tetrahedron seen from both cells.

    The quality of a tetrahedron is its volume over the cube of its root-mean-square edge.
    """
    rotated = lists.copy()
    inverted = 0
    n_internal = len(neighbour)
    for size, at in _by_size(np.diff(start)):
        ids = _lists(start, lists, at, size)
        corners = np.ascontiguousarray(points[ids].transpose(1, 2, 0))
        inside = np.searchsorted(at, n_internal)
        sides = [
            (1.0, slice(None), centres[owner[at]].T),
            (-1.0, slice(inside), centres[neighbour[at[:inside]]].T),
        ]
        bases = 1 if size == 3 else 2 if size == 4 else size
        worst, negative = np.full((bases, len(at)), np.inf), np.zeros((bases, len(at)), dtype=np.intp)
        for sign, part, centre in sides:
            rays = corners[:, :, part] - centre
            lengths = np.einsum("kif,kif->kf", rays, rays)
            for base in range(bases):
                for k in range(1, size - 1):
                    i, j = (base + k) % size, (base + k + 1) % size
                    u, v, w = rays[base], rays[i], rays[j]
                    volume = sign * (
                        u[0] * (v[1] * w[2] - v[2] * w[1])
                        + u[1] * (v[2] * w[0] - v[0] * w[2])
                        + u[2] * (v[0] * w[1] - v[1] * w[0])
                    )
                    edges = lengths[base] + lengths[i] + lengths[j]
                    for p, q in ((u, v), (v, w), (w, u)):
                        edge = p - q
                        edges += edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]
                    quality = volume / (edges * np.sqrt(edges))
                    worst[base, part] = np.minimum(worst[base, part], quality)
                    negative[base, part] += volume <= 0.0
        # Round-off must not decide between equal fans.
        worst[0] += 1e-9
        best = np.argmax(worst, axis=0)
        inverted += int(negative[best, np.arange(len(at))].sum())
        turn = (best[:, None] + np.arange(size)) % size
        rotated[start[at][:, None] + np.arange(size)] = np.take_along_axis(ids, turn, axis=1)
    return rotated, inverted


def _tetrahedra(
    half: _Halves,
    face_start: _Index,
    face_points: _Index,
    owner_half: _Index,
    neighbour_half: _Index,
    n_points: int,
    source: str,
) -> tuple[_Index, Ints, Ints, _Index, _Index]:
    """Tetrahedra by cell with their neighbours, the tetrahedron of each boundary triangle, cells astray."""
    sizes = np.diff(half.start)
    tet_start = _starts(sizes - 2)
    n_internal, n_tets = len(neighbour_half), int(tet_start[-1])
    if max(4 * n_tets, len(half.points)) > np.iinfo(np.int32).max:
        raise InputError(f"{source}: {n_tets} tetrahedra are too many for 32-bit indices.")
    tets = np.empty((n_tets, 4), dtype=np.int32)
    neighbours = np.full((n_tets, 4), -1, dtype=np.int32)
    boundary_start = _starts(np.diff(face_start)[n_internal:] - 2)
    triangle_tet = np.empty(boundary_start[-1], dtype=np.intp)
    lists = np.empty(len(half.points), dtype=np.int32)

    def fill(halves: _Index, fan: _Index) -> None:
        size = fan.shape[1]
        lists[half.start[halves][:, None] + np.arange(size)] = fan
        for k in range(size - 2):
            tet = tet_start[halves] + k
            tets[tet, 0] = n_points + half.cell[halves]
            tets[tet, 1], tets[tet, 2], tets[tet, 3] = fan[:, 0], fan[:, k + 1], fan[:, k + 2]
            if k > 0:
                neighbours[tet, 3] = tet - 1
            if k < size - 3:
                neighbours[tet, 2] = tet + 1

    for size, at in _by_size(np.diff(face_start)):
        fan = _lists(face_start, face_points, at, size)
        fill(owner_half[at], fan)
        inside = np.searchsorted(at, n_internal)
        # From the other side the fan turns the other way about the same base.
        fill(neighbour_half[at[:inside]], np.concatenate([fan[:inside, :1], fan[:inside, :0:-1]], axis=1))
        for k in range(size - 2):
            own = tet_start[owner_half[at]] + k
            across = tet_start[neighbour_half[at[:inside]]] + (size - 3 - k)
            neighbours[own[:inside], 0] = across
            neighbours[across, 0] = own[:inside]
            triangle = boundary_start[at[inside:] - n_internal] + k
            neighbours[own[inside:], 0] = -1 - triangle
            triangle_tet[triangle] = own[inside:]
    astray = _join_within_cells(half, lists, tet_start, neighbours, source)
    cell_start = tet_start[np.searchsorted(half.cell, np.arange(half.n_cells + 1))]
    return cell_start, tets, neighbours, triangle_tet, astray


def _join_within_cells(
    half: _Halves, lists: Ints, tet_start: _Index, neighbours: Ints, source: str
) -> _Index:
    """Join the tetrahedra of a cell across the edges at which two of its faces meet.

    Returns the cells of which two faces run along a common edge in the same direction.
    """
    astray = []
    first_half = np.searchsorted(half.cell, np.arange(half.n_cells + 1))
    flat = neighbours.reshape(-1)
    for low in range(0, half.n_cells, _CHUNK):
        high = min(low + _CHUNK, half.n_cells)
        halves = np.arange(first_half[low], first_half[high])
        begin, end = half.start[halves[0]], half.start[halves[-1] + 1]
        size = np.diff(half.start[halves[0] : halves[-1] + 2])
        last = half.start[halves + 1] - 1 - begin
        a = lists[begin:end].astype(np.int64)
        b = np.roll(a, -1)
        b[last] = a[half.start[halves] - begin]
        position = np.arange(begin, end) - np.repeat(half.start[halves], size)
        slot = 4 * (np.repeat(tet_start[halves], size) + np.maximum(position - 1, 0)) + 1
        slot[position == 0] += 2
        slot[last] = 4 * (tet_start[halves + 1] - 1) + 2
        cell = np.repeat(half.cell[halves], size)
        edge = (np.minimum(a, b) << 32) | np.maximum(a, b)
        # Stable: equal edges stay in the order of the cells, so that mates become consecutive.
        order = np.argsort(edge, kind="stable")
        edge, cell, slot, ahead = edge[order], cell[order], slot[order], (a < b)[order]
        fresh = np.ones(len(edge) + 1, dtype=bool)
        fresh[1:-1] = (edge[1:] != edge[:-1]) | (cell[1:] != cell[:-1])
        bad = np.diff(np.flatnonzero(fresh)) != 2
        if bad.any():
            cells = np.unique(cell[np.flatnonzero(fresh)[:-1][bad]])
            raise InputError(
                f"{source}: {len(cells)} cells are not closed (the first is cell {cells[0]}): each edge of "
                "a cell must belong to exactly two of its faces."
            )
        flat[slot[0::2]] = slot[1::2] // 4
        flat[slot[1::2]] = slot[0::2] // 4
        astray.append(np.unique(cell[0::2][ahead[0::2] == ahead[1::2]]))
    return np.concatenate(astray)


def _turn_alike(half: _Halves, owner_half: _Index, neighbour_half: _Index, cells: _Index) -> _Halves:
    """Turn those faces of cells that run along an edge in the same direction as their neighbours there.

    Which way a face turns has been judged by where the middle of the cell lies, which fails for single faces
    of cells far from convex.
    """
    mate = np.full(len(half.cell), -1)
    mate[owner_half[: len(neighbour_half)]] = neighbour_half
    mate[neighbour_half] = owner_half[: len(neighbour_half)]
    lists = half.points.copy()
    first = np.searchsorted(half.cell, cells)
    last = np.searchsorted(half.cell, cells, side="right")
    for begin, end in zip(first.tolist(), last.tolist(), strict=True):
        faces = [lists[half.start[h] : half.start[h + 1]].tolist() for h in range(begin, end)]
        for h in np.flatnonzero(_against(faces)).tolist():
            for side in (begin + h, int(mate[begin + h])):
                if side >= 0:
                    at = slice(half.start[side], half.start[side + 1])
                    lists[at] = lists[at][::-1].copy()
    return half._replace(points=lists)


def _against(faces: list[list[int]]) -> _Mask:
    """Which faces of a closed cell turn against the others, who are more."""
    edges: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for k, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            edges.setdefault((min(a, b), max(a, b)), []).append((k, 1 if a < b else -1))
    beside: list[list[tuple[int, int]]] = [[] for _ in faces]
    for (k, way), (j, other) in (pair for pair in edges.values() if len(pair) == 2):
        beside[k].append((j, -way * other))
        beside[j].append((k, -way * other))
    senses = np.zeros(len(faces))
    senses[0], waiting = 1, [0]
    while waiting:
        k = waiting.pop()
        for j, relation in beside[k]:
            if senses[j] == 0:
                senses[j] = senses[k] * relation
                waiting.append(j)
    against: _Mask = senses < 0 if senses.sum() >= 0 else senses > 0
    return against


def _inward_normals(points: Floats, triangles: Ints, areas: Floats) -> Floats:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = -_cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1)
    # A triangle without area borrows the normal of its face.
    empty = length <= 1e-14 * np.maximum(np.linalg.norm(areas, axis=1), 1e-300)
    normals[empty] = -areas[empty]
    length[empty] = np.linalg.norm(areas[empty], axis=1)
    return normals / np.where(length > 0.0, length, 1.0)[:, None]


def _area(corners: Floats) -> Floats:
    """Area vectors of polygons, corners (n, size, 3)."""
    first = corners[:, 0]
    area = np.zeros_like(first)
    for k in range(1, corners.shape[1] - 1):
        area += _cross(corners[:, k] - first, corners[:, k + 1] - first)
    return 0.5 * area


def _cross(a: Floats, b: Floats) -> Floats:
    product = np.empty_like(a)
    product[:, 0] = a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1]
    product[:, 1] = a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2]
    product[:, 2] = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product


def _sum_per_cell(values: Floats, cells: _Index, n_cells: int) -> Floats:
    return np.stack([np.bincount(cells, column, n_cells) for column in values.T], axis=1)


def _per_cell(values: Floats, owner: _Index, neighbour: _Index, n_cells: int) -> Floats:
    """Sum of the values of each cell's faces."""
    inside = values[: len(neighbour)]
    return _sum_per_cell(values, owner, n_cells) + _sum_per_cell(inside, neighbour, n_cells)


def _mix(ids: _Index) -> _Hash:
    """Scramble ids into 64 bits (the finalizer of splitmix64)."""
    code = (ids.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    code = (code ^ (code >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    code = (code ^ (code >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return code ^ (code >> np.uint64(31))


def _turning_codes(start: _Index, lists: _Index, reverse: bool = False) -> _Hash:
    """Hash of each list that does not depend on where it begins, but on which way it turns."""
    if len(start) < 2:
        return np.empty(0, dtype=np.uint64)
    following = np.roll(lists, -1)
    following[start[1:] - 1] = lists[start[:-1]]
    a, b = (following, lists) if reverse else (lists, following)
    return np.add.reduceat(_mix((_mix(a) + _mix(b) * np.uint64(3)).view(np.intp)), start[:-1])


def _find(codes: _Hash, order: _Index, wanted: _Hash) -> _Index:
    """Position of each wanted code, −1 when absent."""
    if len(codes) == 0:
        return np.full(len(wanted), -1, dtype=np.intp)
    at = order[np.minimum(np.searchsorted(codes, wanted, sorter=order), len(codes) - 1)]
    return np.where(codes[at] == wanted, at, -1)


def _starts(counts: _Index) -> _Index:
    start = np.zeros(len(counts) + 1, dtype=np.intp)
    np.cumsum(counts, out=start[1:])
    return start


def _ragged(start: _Index, counts: _Index) -> _Index:
    """Concatenation of start[i], start[i] + 1, …, start[i] + counts[i] − 1."""
    begin = _starts(counts)
    return np.arange(begin[-1]) + np.repeat(start - begin[:-1], counts)


def _lists(start: _Index, lists: _Index, at: _Index, size: int) -> _Index:
    """The lists of equal size at the given positions, (n, size)."""
    places: _Index = start[at][:, None] + np.arange(size)
    return lists[places]


def _take_lists(start: _Index, lists: _Index, at: _Index) -> tuple[_Index, _Index]:
    counts = np.diff(start)[at]
    return _starts(counts), lists[_ragged(start[at], counts)]


def _by_size(sizes: _Index) -> Iterator[tuple[int, _Index]]:
    """Positions of equal size, ascending, in chunks."""
    for size in np.unique(sizes).tolist():
        at = np.flatnonzero(sizes == size)
        for low in range(0, len(at), _CHUNK):
            yield size, at[low : low + _CHUNK]


def _cell_array(cells: Any) -> tuple[_Index, _Index]:
    """Offsets and connectivity of a vtkCellArray."""
    if cells is None or cells.GetNumberOfCells() == 0:
        return np.zeros(1, dtype=np.intp), np.empty(0, dtype=np.intp)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    start = vtk_to_numpy(cells.GetOffsetsArray()).astype(np.intp)
    return start, vtk_to_numpy(cells.GetConnectivityArray()).astype(np.intp)


def _int32(values: NDArray[Any]) -> Ints:
    return np.ascontiguousarray(values, dtype=np.int32)
