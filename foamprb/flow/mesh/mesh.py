"""Mesh of polyhedral cells: faces, neighbours, tetrahedra and patches.

A cell is bounded by faces with any number of vertices. Every face is cut into a fan of triangles, the same
for the two cells that share it. Each triangle forms one tetrahedron with the centre of a cell. The tetrahedra
fill the mesh without gaps, and a field given at mesh points and cell centres is continuous and piecewise
linear on them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints, Patch
from foamprb.flow.mesh.baffles import part_points
from foamprb.flow.mesh.boundary import PatchSurface, PolyMesh, patches_of, surface_of
from foamprb.flow.mesh.cells import poly_of_grid
from foamprb.flow.mesh.coupling import Coupling, couple
from foamprb.flow.mesh.faces import OPEN, TWISTED, Faces, Fans, Numbering, number_tetrahedra, split_cells
from foamprb.flow.mesh.geometry import (
    cell_geometry,
    inward_normals,
    measured,
    points_of_cells,
    rotate_faces,
)
from foamprb.flow.mesh.lists import MOST_INDICES, Index, Mask, int32, share

_FACES_OF_PRISM, _DIVIDED_FACES = 5, 9
_MOST_TURNS = 5


@dataclass(eq=False)
class Mesh:
    """Cells, faces and tetrahedra; lengths in metres.

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
    cell_face_start: Ints
    """(n_cells + 1,) into ``cell_faces``."""
    cell_faces: Ints
    """Faces of each cell, in the order of its tetrahedra."""
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
    """Coupled patches and wedges, each way."""
    divided: bool = False
    """True if the mesh is one cell thick, and its faces in both planes are divided; see
    :mod:`foamprb.flow.mesh.layer`."""

    @property
    def n_points(self) -> int:
        """Return the number of mesh points."""
        return len(self.points)

    @property
    def n_cells(self) -> int:
        """Return the number of cells."""
        return len(self.centres)

    @property
    def n_internal(self) -> int:
        """Return the number of faces between two cells."""
        return len(self.neighbour)

    @property
    def simple(self) -> Mask:
        """Return which cells have at most five faces: tetrahedra, pyramids and prisms, (n_cells,)."""
        return np.diff(self.cell_face_start) <= (_DIVIDED_FACES if self.divided else _FACES_OF_PRISM)

    @property
    def nodes(self) -> Floats:
        """Return mesh points followed by cell centres, (n_points + n_cells, 3)."""
        return np.concatenate([self.points, self.centres])


def build_mesh(grid: Any, surfaces: Sequence[PatchSurface] | None = None, source: str = "mesh") -> Mesh:
    """Find faces, neighbours, patches and tetrahedra of an unstructured grid.

    Parameters
    ----------
    grid
        ``vtkUnstructuredGrid`` of tetrahedra, hexahedra, prisms, pyramids and polyhedra.
    surfaces
        The patches. Faces are identified by the coordinates of their vertices, equal to the last bit. None:
        the whole boundary is one patch ``boundary`` of type ``wall``.
    source
        Name of the grid for messages, e.g. its file.

    Raises
    ------
    InputError
        Cells of another type; a face of three cells; an open cell; boundary faces in no patch or in two
        patches; patch faces that are not on the boundary.
    """
    return assemble(poly_of_grid(grid, surfaces, source), source)


def assemble(poly: PolyMesh, source: str) -> Mesh:
    """Find neighbours, tetrahedra and coupled patches of a mesh.

    Parameters
    ----------
    poly, source
        Points, faces and patches; the name of the mesh for messages.

    Raises
    ------
    InputError
        A cell is open, or its faces cannot be oriented; or coupled patches do not fit.
    """
    points, faces, *_ = poly
    cell_start, cell_points = points_of_cells(faces, len(points))
    points, faces, cell_points = part_points(points, faces, cell_start, cell_points)
    poly = poly._replace(points=points, faces=faces)
    for _ in range(_MOST_TURNS):
        mesh, astray = _assemble(poly, (cell_start, cell_points), source)
        if len(astray) == 0:
            return mesh
        turn_alike(faces, astray)
    raise InputError(
        f"{source}: the faces of {len(astray)} cells do not turn alike (the first is cell {astray[0]}); "
        "is the mesh damaged?"
    )


def with_points(mesh: Mesh, points: Floats, surfaces: Sequence[PatchSurface] = (), source: str = "") -> Mesh:
    """Return a mesh with its points at other places, (n_points, 3), m, and the same tetrahedra.

    Coupled patches of ``surfaces`` are matched anew; see :func:`assemble` for errors and ``source``.
    """
    given = mesh.face_start, mesh.face_points, mesh.owner, mesh.neighbour
    faces, n = Faces(*given, mesh.cell_face_start, mesh.cell_faces), mesh.n_internal
    face_centres, face_areas = measured(points, faces)
    _, centres, volumes = cell_geometry(faces, face_centres, face_areas)
    areas = face_areas[n:].copy()
    normals = inward_normals(points, mesh.triangles, areas[mesh.triangle_face])
    boundary, couplings = (face_centres[n:].copy(), areas), mesh.couplings
    if surfaces:
        starts = mesh.patch_start.astype(np.intp)
        _, couplings = _coupled(points, faces, surfaces, starts, *boundary, source)
    return replace(
        mesh, points=points, centres=centres, volumes=volumes, boundary_centres=boundary[0],
        boundary_areas=areas, triangle_normals=normals, couplings=couplings,
    )  # fmt: skip


def _coupled(
    points: Floats,
    faces: Faces,
    surfaces: Sequence[PatchSurface],
    patch_start: Index,
    centres: Floats,
    areas: Floats,
    source: str,
) -> tuple[tuple[Patch, ...], tuple[Coupling, ...]]:
    """Return the patches and their couplings; ``centres`` and ``areas`` are of the boundary faces."""
    first = len(faces.neighbour)
    surfaces = [
        patch._replace(
            surface=surface_of(points, faces.start, faces.points, slice(first + low, first + high))
        )
        if patch.type == "cyclicAMI" and patch.surface is None
        else patch
        for patch, low, high in zip(surfaces, patch_start[:-1], patch_start[1:], strict=True)
    ]
    return couple(patches_of(surfaces, patch_start), patch_start, centres, areas, surfaces, source)


def _assemble(poly: PolyMesh, cells: tuple[Ints, Ints], source: str) -> tuple[Mesh, Index]:
    """Return the mesh, and the cells with neighbouring faces that turn against each other."""
    points, faces, surfaces, patch_start, *_ = poly
    # The bases of the fans must not depend on the number of turns of a face.
    faces = faces._replace(points=faces.points.copy())
    n_internal = len(faces.neighbour)

    face_centres, face_areas = measured(points, faces)
    boundary_centres, boundary_areas = face_centres[n_internal:].copy(), face_areas[n_internal:].copy()
    patches, couplings = _coupled(
        points, faces, surfaces, patch_start, boundary_centres, boundary_areas, source
    )
    _, centres, volumes = cell_geometry(faces, face_centres, face_areas)
    del face_centres, face_areas
    inverted = rotate_faces(points, centres, faces)
    return cut(
        points, faces, patch_start, cells, source, boundary_areas, centres=centres, volumes=volumes,
        patches=patches, boundary_centres=boundary_centres, inverted=inverted, couplings=couplings,
    )  # fmt: skip


def cut(
    points: Floats,
    faces: Faces,
    patch_start: Index,
    cells: tuple[Ints, Ints],
    source: str,
    boundary_areas: Floats,
    **known: Any,
) -> tuple[Mesh, Index]:
    """Cut cells into tetrahedra; return the mesh, and the cells with faces that turn against each other.

    ``known`` are further fields of the mesh.
    """
    n_internal = len(faces.neighbour)
    cell_start, tets, neighbours, triangle_tet, astray = cut_into_tetrahedra(faces, len(points), source)
    triangles = tets[triangle_tet][:, 1:]
    counts = np.diff(faces.start)[n_internal:] - 2
    triangle_face = np.repeat(np.arange(len(counts)), counts)
    boundary_patch = np.repeat(np.arange(len(patch_start) - 1), np.diff(patch_start))
    mesh = Mesh(
        points=points,
        cell_point_start=cells[0],
        cell_points=cells[1],
        face_start=faces.start,
        face_points=faces.points,
        cell_face_start=faces.first,
        cell_faces=faces.of_cell,
        owner=faces.owner,
        neighbour=faces.neighbour,
        patch_start=int32(patch_start),
        boundary_areas=boundary_areas,
        cell_start=cell_start,
        tets=tets,
        neighbours=neighbours,
        triangles=np.ascontiguousarray(triangles),
        triangle_patch=int32(boundary_patch[triangle_face]),
        triangle_face=int32(triangle_face),
        triangle_tet=triangle_tet,
        triangle_normals=inward_normals(points, triangles, boundary_areas[triangle_face]),
        **known,
    )
    return mesh, astray


def cut_into_tetrahedra(faces: Faces, n_points: int, source: str) -> tuple[Ints, Ints, Ints, Ints, Index]:
    """Return the tetrahedra by cell, their neighbours, those of the boundary triangles, and twisted cells."""
    n_cells, n_internal = len(faces.first) - 1, len(faces.neighbour)
    sizes = np.diff(faces.start)
    n_tets = int(sizes.sum() + sizes[:n_internal].sum()) - 2 * len(faces.of_cell)
    if n_tets > MOST_INDICES:
        raise InputError(f"{source}: {n_tets} tetrahedra are too many for 32-bit indices.")
    n_triangles = int(sizes[n_internal:].sum() - 2 * (len(sizes) - n_internal))
    cell_start, triangle_tet = np.empty(n_cells + 1, dtype=np.int32), np.empty(n_triangles, dtype=np.int32)
    tets, neighbours = np.empty((n_tets, 4), dtype=np.int32), np.empty((n_tets, 4), dtype=np.int32)
    state, face_tet = np.zeros(n_cells, dtype=np.uint8), np.empty(len(sizes), dtype=np.int32)
    numbers = Numbering(cell_start, face_tet)
    link(number_tetrahedra)(faces, numbers)
    most_edges = int(np.add.reduceat(sizes[faces.of_cell], faces.first[:-1]).max())
    slots, split = 1 << most_edges.bit_length(), link(split_cells)
    fans = Fans(tets, neighbours, triangle_tet, state)

    def cut(begin: int, end: int) -> None:
        # 64 bits: it holds four numbers for each tetrahedron.
        edges = np.full((5, slots), -1, dtype=np.int64)
        split(begin, end, n_points, faces, numbers, edges, fans)

    share(n_cells, cut)
    gaping = np.flatnonzero(state & OPEN)
    if len(gaping):
        raise InputError(
            f"{source}: {len(gaping)} cells are not closed (the first is cell {gaping[0]}): each edge of "
            "a cell must belong to exactly two of its faces."
        )
    return cell_start, tets, neighbours, triangle_tet, np.flatnonzero(state & TWISTED)


def turn_alike(faces: Faces, cells: Index) -> None:
    """Turn the faces of cells that run along an edge in the same direction as their neighbours there.

    The orientation of a face was judged by the middle of the cell, which fails in cells far from convex.
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


def _against(faces: list[list[int]]) -> Mask:
    """Return True for the faces of a closed cell that turn against the majority."""
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
    against: Mask = senses < 0 if senses.sum() >= 0 else senses > 0
    return against
