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

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.mesh.coupling import Coupling, couple
from foamprb.flow.mesh.faces import (
    OPEN,
    TWISTED,
    add_at,
    add_pyramids,
    choose_bases,
    gather_faces,
    list_faces,
    measure_faces,
    pair_faces,
    split_cells,
)
from foamprb.flow.mesh.patch import Patch

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int32]
_Index: TypeAlias = NDArray[np.intp]
_Labels: TypeAlias = NDArray[np.integer[Any]]
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
_CORNERS = np.zeros(256, dtype=np.intp)
for _kind, _faces in _CELL_FACES.items():
    _CORNERS[_kind] = 1 + max(map(max, _faces))
CELL_KINDS = {10: "tetrahedron", 12: "hexahedron", 13: "prism", 14: "pyramid", _POLYHEDRON: "polyhedron"}

# Faces handled at once: the temporary arrays then stay in the cache.
_CHUNK = 1 << 15
_MOST_INDICES = int(np.iinfo(np.int32).max)
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
    half, cell_point_start, cell_points = _half_faces(grid, source)
    mate = _match_halves(half, source)
    apart = _baffles(points, grid.points.dtype, half, mate, surfaces)
    if apart.any():
        split = np.flatnonzero(apart)
        mate[mate[split]] = mate[split]
        mate[split] = split
        points, half, cell_points = _part_points(points, half, mate, cell_point_start, cell_points)
    faces, middles = _order_faces(points, half, mate)
    del half, mate
    for _ in range(_MOST_TURNS):
        mesh, astray = _assemble(
            points, grid.points.dtype, faces, middles, (cell_point_start, cell_points), surfaces, source
        )
        if len(astray) == 0:
            return mesh
        _turn_alike(faces, astray)
    raise InputError(
        f"{source}: the faces of {len(astray)} cells do not turn alike (the first is cell {astray[0]}); "
        "is the mesh damaged?"
    )


def _assemble(
    points: Floats,
    dtype: Any,
    faces: _Faces,
    middles: Floats,
    cells: tuple[Ints, Ints],
    surfaces: Sequence[PatchSurface] | None,
    source: str,
) -> tuple[Mesh, _Index]:
    """The mesh, and cells of which two neighbouring faces turn against each other."""
    order, patches, patch_start = _assign_patches(points, dtype, faces, surfaces, source)
    _sort_boundary(faces, order)
    # The bases of the fans must not depend on how often the faces were turned.
    faces = faces._replace(points=faces.points.copy())
    owner, neighbour = faces.owner, faces.neighbour
    n_internal = len(neighbour)

    boundary_centres, boundary_areas = _boundary_geometry(points, faces)
    patches, couplings = couple(patches, patch_start, boundary_centres, boundary_areas, source)
    centres, volumes = _cell_geometry(points, faces, middles)
    inverted = link(choose_bases)(points, centres, faces.start, faces.points, owner, neighbour)

    cell_start, tets, neighbours, triangle_tet, astray = _tetrahedra(faces, len(points), source)
    triangles = tets[triangle_tet][:, 1:]
    counts = np.diff(faces.start)[n_internal:] - 2
    triangle_face = np.repeat(np.arange(len(counts)), counts)
    boundary_patch = np.repeat(np.arange(len(patches)), np.diff(patch_start))
    mesh = Mesh(
        points=points,
        centres=centres,
        volumes=volumes,
        cell_point_start=cells[0],
        cell_points=cells[1],
        face_start=faces.start,
        face_points=faces.points,
        owner=owner,
        neighbour=neighbour,
        patches=patches,
        patch_start=_int32(patch_start),
        boundary_centres=boundary_centres,
        boundary_areas=boundary_areas,
        cell_start=cell_start,
        tets=tets,
        neighbours=neighbours,
        triangles=np.ascontiguousarray(triangles),
        triangle_patch=_int32(boundary_patch[triangle_face]),
        triangle_face=_int32(triangle_face),
        triangle_tet=triangle_tet,
        triangle_normals=_inward_normals(points, triangles, boundary_areas[triangle_face]),
        inverted=inverted,
        couplings=couplings,
    )
    return mesh, astray


class _Halves(NamedTuple):
    """The faces of each cell, cell after cell: an interior face appears twice."""

    first: Ints
    """(n_cells + 1,): the first face of each cell."""
    start: Ints
    points: Ints

    def cells(self) -> Ints:
        """The cell of each face."""
        return np.repeat(np.arange(len(self.first) - 1, dtype=np.int32), np.diff(self.first))


class _Faces(NamedTuple):
    """The faces of a mesh, those between two cells first; they turn outwards from their owner."""

    start: Ints
    points: Ints
    owner: Ints
    neighbour: Ints
    first: Ints
    """(n_cells + 1,) into ``of_cell``."""
    of_cell: Ints
    """The faces of each cell; a face's owner comes before its neighbour."""


def _half_faces(grid: Any, source: str) -> tuple[_Halves, Ints, Ints]:
    """The faces of the cells; the points of the cells, and where each cell's begin."""
    types = np.ascontiguousarray(grid.celltypes, dtype=np.uint8)
    unknown = sorted(set(np.flatnonzero(np.bincount(types)).tolist()) - set(CELL_KINDS))
    if unknown:
        raise InputError(
            f"{source}: cells of VTK type {', '.join(map(str, unknown))}; allowed are "
            + ", ".join(f"{kind} ({number})" for number, kind in CELL_KINDS.items())
            + "."
        )
    if len(types) == 0:
        raise InputError(f"{source}: the mesh has no cells.")
    offset, connectivity = _cell_array(grid.GetCells())
    polyhedra = [*_cell_array(grid.GetPolyhedronFaceLocations()), *_cell_array(grid.GetPolyhedronFaces())]
    for lists in (connectivity, polyhedra[3]):
        if len(lists) and (lists.min() < 0 or lists.max() >= len(grid.points)):
            raise InputError(
                f"{source}: a cell names point {max(lists.max(), -lists.min())}, "
                f"but there are {len(grid.points)} points."
            )
        if len(lists) > _MOST_INDICES:
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
    cells, shapes, kinds = (
        (_int32(offset), _int32(connectivity)),
        _shapes(),
        np.bincount(types, minlength=256),
    )
    n_faces = int(kinds @ np.count_nonzero(shapes[:, :, 0], axis=1)) + len(ids)
    n_entries = int(kinds @ shapes[:, :, 0].sum(axis=1) + np.diff(face_start)[ids].sum())
    given = (types, *cells, shapes, *map(_int32, polyhedra))
    if n_entries > _MOST_INDICES:
        raise InputError(f"{source}: {n_entries} points of faces are too many for 32-bit indices.")
    half = _Halves(*(np.empty(n, dtype=np.int32) for n in (len(types) + 1, n_faces + 1, n_entries)))
    link(list_faces)(*given, *half)
    least = np.diff(half.start).min()
    if least < 3:
        raise InputError(f"{source}: a face of {least} vertices; at least 3 are needed.")
    return half, *cells


def _shapes() -> Ints:
    """The faces of VTK's types of cells as :func:`list_faces` reads them."""
    shapes = np.zeros((256, 6, 5), dtype=np.int32)
    for number, faces in _CELL_FACES.items():
        for k, face in enumerate(faces):
            shapes[number, k, : len(face) + 1] = (len(face), *face)
    return shapes


def _match_halves(half: _Halves, source: str) -> Ints:
    """The other half of each interior face; a half without a mate has itself."""
    n = len(half.start) - 1
    head, following, mate = np.full(n, -1, dtype=np.int32), *np.empty((2, n), dtype=np.int32)
    third = link(pair_faces)(half.start, half.points, head, following, mate)
    if third >= 0:
        at = np.searchsorted(half.first, third, side="right") - 1
        raise InputError(f"{source}: a face of cell {at} belongs to three or more cells.")
    return mate


def _baffles(
    points: Floats, dtype: Any, half: _Halves, mate: Ints, surfaces: Sequence[PatchSurface] | None
) -> _Mask:
    """Which of the matched halves belong to patches: walls without thickness, with a patch on either side."""
    inside = mate != np.arange(len(mate), dtype=np.int32)
    faces = sum(surface.surface.n_cells for surface in surfaces or ())
    if surfaces is None or faces <= np.count_nonzero(~inside):
        return np.zeros(len(mate), dtype=bool)
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
    found: _Mask = inside & np.isin(codes, np.concatenate(wanted))
    return found


def _part_points(
    points: Floats, half: _Halves, mate: Ints, start: Ints, cell_points: Ints
) -> tuple[Floats, _Halves, Ints]:
    """Give each side of a baffle points of its own, where no way around through cells joins the sides.

    Around a point, cells are joined by the faces between them that hold the point; a point whose cells fall
    into several groups is copied for each group but one.
    """
    on_wall = np.zeros(len(points), dtype=bool)
    sizes, cell_of = np.diff(half.start), half.cells().astype(np.intp)
    first = np.arange(len(mate))
    on_wall[_take_lists(half.start, half.points, first[mate == first])[1]] = True
    # Corners: a cell and one of its points on a wall.
    cells = np.repeat(np.arange(len(start) - 1), np.diff(start))
    at = np.flatnonzero(on_wall[cell_points])
    keys = cells[at] * len(points) + cell_points[at]
    order = np.argsort(keys)
    keys = keys[order]
    inside = first[mate > first]
    owners = np.repeat(cell_of[inside], sizes[inside])
    others = np.repeat(cell_of[mate[inside]], sizes[inside])
    shared = _take_lists(half.start, half.points, inside)[1]
    held = on_wall[shared]
    joined = [
        np.searchsorted(keys, side[held] * len(points) + shared[held]).astype(np.intp)
        for side in (owners, others)
    ]
    graph = sparse.coo_array((np.ones(len(joined[0]), dtype=np.int8), joined), shape=(len(keys), len(keys)))
    groups = csgraph.connected_components(graph, directed=False)[1]
    point = cell_points[at[order]].astype(np.intp)
    # The first group of a point keeps it, each other group gets a copy.
    pairs, place = np.unique(np.stack([point, groups]), axis=1, return_inverse=True)
    copy = np.concatenate([[False], pairs[0, 1:] == pairs[0, :-1]])
    names = np.where(copy, len(points) + np.cumsum(copy) - 1, pairs[0])
    named = names[place.reshape(-1)]
    moved = cell_points.copy()
    moved[at[order]] = named
    lists = half.points.copy()
    on_lists = np.flatnonzero(on_wall[lists])
    of_half = np.repeat(cell_of, sizes)[on_lists]
    lists[on_lists] = named[np.searchsorted(keys, of_half * len(points) + lists[on_lists])]
    return np.concatenate([points, points[pairs[0, copy]]]), half._replace(points=lists), moved


def _order_faces(points: Floats, half: _Halves, mate: Ints) -> tuple[_Faces, Floats]:
    """Put interior faces first and let every list turn outwards from its owner, as far as can be told.

    Returns the middles of the cells as well.
    """
    single = np.flatnonzero(mate == np.arange(len(mate), dtype=np.int32))
    n_internal = (len(mate) - len(single)) // 2
    n_entries = (len(half.points) + int((half.start[single + 1] - half.start[single]).sum())) // 2
    n_faces = n_internal + len(single)
    start, lists, owner, neighbour, of_cell = (
        np.empty(n, dtype=np.int32) for n in (n_faces + 1, n_entries, n_faces, n_internal, len(mate))
    )
    link(gather_faces)(*half, mate, start, lists, owner, neighbour, of_cell)
    faces = _Faces(start, lists, owner, neighbour, half.first, of_cell)
    middles = _cell_middles(points, faces)
    for part, centres, areas in _measured(points, faces):
        own, beyond = owner[part], neighbour[part]
        ahead = centres - middles[own]
        ahead[: len(beyond)] = middles[beyond] - middles[own[: len(beyond)]]
        inwards = part.start + np.flatnonzero(np.einsum("fi,fi->f", areas, ahead) < 0.0)
        sizes = start[inwards + 1] - start[inwards]
        backwards = np.repeat(start[inwards] + start[inwards + 1] - 1, sizes)
        places = _ragged(start[inwards], sizes)
        lists[places] = lists[backwards - places]
    return faces, middles


def _measured(points: Floats, faces: _Faces, first: int = 0) -> Iterator[tuple[slice, Floats, Floats]]:
    """Centres and area vectors of the faces from the first on, part by part."""
    n, measure = len(faces.owner), link(measure_faces)
    for low in range(first, n, _CHUNK):
        part = slice(low, min(low + _CHUNK, n))
        centres, areas = np.empty((part.stop - low, 3)), np.empty((part.stop - low, 3))
        measure(points, faces.start[low : part.stop + 1], faces.points, centres, areas)
        yield part, centres, areas


def _boundary_geometry(points: Floats, faces: _Faces) -> tuple[Floats, Floats]:
    """Centres and area vectors of the boundary faces."""
    n_internal = len(faces.neighbour)
    centres, areas = np.empty((2, len(faces.owner) - n_internal, 3))
    for part, *measured in _measured(points, faces, n_internal):
        to = slice(part.start - n_internal, part.stop - n_internal)
        centres[to], areas[to] = measured
    return centres, areas


def _cell_middles(points: Floats, faces: _Faces) -> Floats:
    """Means of the centres of each cell's faces."""
    middles, add = np.zeros((len(faces.first) - 1, 3)), link(add_at)
    for part, centres, _ in _measured(points, faces):
        for cells in (faces.owner[part], faces.neighbour[part]):
            add(cells, centres, middles)
    middles /= np.diff(faces.first)[:, None]
    return middles


def _cell_geometry(points: Floats, faces: _Faces, middles: Floats) -> tuple[Floats, Floats]:
    """Cell centres and volumes, by pyramids about the means of the face centres."""
    add = link(add_pyramids)
    moments, volumes = np.zeros((len(middles), 3)), np.zeros(len(middles))
    for part, centres, areas in _measured(points, faces):
        for cells, sign in ((faces.owner[part], 1.0), (faces.neighbour[part], -1.0)):
            add(cells, sign, centres, areas, middles, volumes, moments)
    moments /= np.where(volumes == 0.0, np.inf, volumes)[:, None]
    moments += middles
    return moments, volumes


def _sort_boundary(faces: _Faces, order: _Index) -> None:
    """Put the boundary faces in the given order."""
    n_internal = len(faces.neighbour)
    ends, moved = _take_lists(faces.start, faces.points, n_internal + order)
    faces.start[n_internal:] = faces.start[n_internal] + ends
    faces.points[faces.start[n_internal] :] = moved
    faces.owner[n_internal:] = faces.owner[n_internal + order]
    place = np.empty(len(order), dtype=np.int32)
    place[order] = np.arange(n_internal, len(faces.owner), dtype=np.int32)
    outside = np.flatnonzero(faces.of_cell >= n_internal)
    faces.of_cell[outside] = place[faces.of_cell[outside] - n_internal]


def _assign_patches(
    points: Floats,
    dtype: Any,
    faces: _Faces,
    surfaces: Sequence[PatchSurface] | None,
    source: str,
) -> tuple[_Index, tuple[Patch, ...], _Index]:
    """Order of the boundary faces by patch; the patches; where each begins."""
    boundary = np.arange(len(faces.neighbour), len(faces.owner))
    if surfaces is None:
        everything = np.arange(len(boundary))
        return everything, (Patch("boundary", "wall"),), np.array([0, len(boundary)])
    start, lists = _take_lists(faces.start, faces.points, boundary)
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
    found = np.concatenate([np.empty(0, dtype=np.intp), *chosen])
    times = np.bincount(found, minlength=len(boundary))
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
    return found, patches, _starts(np.array([len(part) for part in chosen], dtype=np.intp))


def _tetrahedra(faces: _Faces, n_points: int, source: str) -> tuple[Ints, Ints, Ints, Ints, _Index]:
    """Tetrahedra by cell with their neighbours, the tetrahedron of each boundary triangle, cells astray."""
    n_cells, n_internal = len(faces.first) - 1, len(faces.neighbour)
    sizes = np.diff(faces.start)
    n_tets = int(sizes.sum() + sizes[:n_internal].sum()) - 2 * len(faces.of_cell)
    if 4 * n_tets > _MOST_INDICES:
        raise InputError(f"{source}: {n_tets} tetrahedra are too many for 32-bit indices.")
    n_triangles = int(sizes[n_internal:].sum() - 2 * (len(sizes) - n_internal))
    cell_start, triangle_tet = np.empty(n_cells + 1, dtype=np.int32), np.empty(n_triangles, dtype=np.int32)
    tets, neighbours = np.empty((n_tets, 4), dtype=np.int32), np.empty((n_tets, 4), dtype=np.int32)
    state = np.zeros(n_cells, dtype=np.uint8)
    link(split_cells)(
        n_points,
        *(faces.first, faces.of_cell, faces.start, faces.points, n_internal),
        np.full(len(sizes), -1, dtype=np.int32),
        np.full((5, 1 << int(np.diff(faces.first).max() * sizes.max()).bit_length()), -1, dtype=np.int32),
        *(cell_start, tets, neighbours, triangle_tet, state),
    )
    gaping = np.flatnonzero(state & OPEN)
    if len(gaping):
        raise InputError(
            f"{source}: {len(gaping)} cells are not closed (the first is cell {gaping[0]}): each edge of "
            "a cell must belong to exactly two of its faces."
        )
    return cell_start, tets, neighbours, triangle_tet, np.flatnonzero(state & TWISTED)


def _turn_alike(faces: _Faces, cells: _Index) -> None:
    """Turn those faces of cells that run along an edge in the same direction as their neighbours there.

    Which way a face turns has been judged by where the middle of the cell lies, which fails for single faces
    of cells far from convex.
    """
    for c in cells.tolist():
        own = faces.of_cell[faces.first[c] : faces.first[c + 1]].tolist()
        lists = [faces.points[faces.start[f] : faces.start[f + 1]] for f in own]
        outward = [
            (points if faces.owner[f] == c else points[::-1]).tolist()
            for f, points in zip(own, lists, strict=True)
        ]
        for k in np.flatnonzero(_against(outward)).tolist():
            lists[k][:] = lists[k][::-1].copy()


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


def _cross(a: Floats, b: Floats) -> Floats:
    product = np.empty_like(a)
    product[:, 0] = a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1]
    product[:, 1] = a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2]
    product[:, 2] = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product


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


def _starts(counts: _Labels) -> _Index:
    start = np.zeros(len(counts) + 1, dtype=np.intp)
    np.cumsum(counts, out=start[1:])
    return start


def _ragged(start: _Labels, counts: _Labels) -> _Index:
    """Concatenation of start[i], start[i] + 1, …, start[i] + counts[i] − 1."""
    begin = _starts(counts)
    return np.arange(begin[-1]) + np.repeat(start - begin[:-1], counts)


def _take_lists(start: _Labels, lists: _Labels, at: _Index) -> tuple[_Index, _Labels]:
    counts = np.diff(start)[at]
    return _starts(counts), lists[_ragged(start[at], counts)]


def _cell_array(cells: Any) -> tuple[_Index, _Index]:
    """Offsets and connectivity of a vtkCellArray."""
    if cells is None or cells.GetNumberOfCells() == 0:
        return np.zeros(1, dtype=np.intp), np.empty(0, dtype=np.intp)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    start = vtk_to_numpy(cells.GetOffsetsArray()).astype(np.intp, copy=False)
    return start, vtk_to_numpy(cells.GetConnectivityArray()).astype(np.intp, copy=False)


def _int32(values: NDArray[Any]) -> Ints:
    return np.ascontiguousarray(values, dtype=np.int32)
