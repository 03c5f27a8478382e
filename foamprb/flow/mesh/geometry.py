"""Order and orientation of the faces of a mesh, and centres, areas and volumes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.tensor import vector_product
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.faces import (
    Faces,
    choose_bases,
    gather_faces,
    list_points,
    measure_cells,
    measure_faces,
)
from foamprb.flow.mesh.lists import share, starts


class HalfFaces(NamedTuple):
    """Faces of each cell, cell by cell; an interior face appears twice."""

    first: Ints
    """(n_cells + 1,) first face of each cell."""
    start: Ints
    points: Ints


def faces_of(start: Ints, points: Ints, owner: Ints, neighbour: Ints, n_cells: int) -> Faces:
    """Return faces with the lists of the cells; faces whose owner is not the lower cell are turned."""
    cells = np.concatenate([owner, neighbour]).astype(np.int64)
    first = starts(np.bincount(cells, minlength=n_cells)).astype(np.int32)
    # Pairs of a cell and a face, in order; compiled code would be loaded for this only in foamprb info.
    pairs = cells << 32
    pairs[: len(owner)] += np.arange(len(owner))
    pairs[len(owner) :] += np.arange(len(neighbour))
    pairs.sort()
    faces = Faces(start, points, owner, neighbour, first, pairs.astype(np.int32))
    wrong = np.flatnonzero(owner[: len(neighbour)] > neighbour)
    owner[wrong], neighbour[wrong] = neighbour[wrong], owner[wrong]
    faces.turn(wrong)
    return faces


def order_faces(points: Floats, half: HalfFaces, mate: Ints) -> Faces:
    """Put interior faces first, and turn every face outwards from its owner, judged by the cells' middles."""
    single = np.flatnonzero(mate == np.arange(len(mate), dtype=np.int32))
    n_internal = (len(mate) - len(single)) // 2
    n_entries = (len(half.points) + int((half.start[single + 1] - half.start[single]).sum())) // 2
    n_faces = n_internal + len(single)
    start, lists, owner, neighbour, of_cell = (
        np.empty(n, dtype=np.int32) for n in (n_faces + 1, n_entries, n_faces, n_internal, len(mate))
    )
    link(gather_faces)(*half, mate, start, lists, owner, neighbour, of_cell)
    faces = Faces(start, lists, owner, neighbour, half.first, of_cell)
    centres, areas = measured(points, faces)
    middles, *_ = cell_geometry(faces, centres, areas)
    ahead = centres - middles[owner]
    ahead[:n_internal] = middles[neighbour] - middles[owner[:n_internal]]
    faces.turn(np.flatnonzero(np.einsum("fi,fi->f", areas, ahead) < 0.0))
    return faces


def points_of_cells(faces: Faces, n_points: int) -> tuple[Ints, Ints]:
    """Return the start of each cell's points, (n_cells + 1,), and the points."""
    nothing, run = np.empty(0, dtype=np.int32), link(list_points)

    def listed(begin: int, end: int) -> tuple[Ints, Ints]:
        first = faces.first[begin : end + 1]
        given = first, faces.of_cell, faces.start, faces.points
        start, last = np.empty(len(first), dtype=np.int32), np.full(n_points, -1, dtype=np.int32)
        run(*given, last, start, nothing)
        points = np.empty(start[-1], dtype=np.int32)
        last[:] = -1
        run(*given, last, start, points)
        return start, points

    parts = share(len(faces.first) - 1, listed)
    ends = starts(np.array([len(points) for _, points in parts]))
    start = [part[:-1] + np.int32(end) for (part, _), end in zip(parts, ends, strict=False)]
    return np.concatenate([*start, ends[-1:].astype(np.int32)]), np.concatenate(
        [points for _, points in parts]
    )


def rotate_faces(points: Floats, centres: Floats, faces: Faces) -> int:
    """Choose the bases of the fans; see :func:`choose_bases`."""
    n_internal, choose = len(faces.neighbour), link(choose_bases)

    def chosen(begin: int, end: int) -> int:
        own = points, centres, faces.start[begin : end + 1], faces.points, faces.owner[begin:end]
        inside = faces.neighbour[begin:end] if end <= n_internal else faces.neighbour[:0]
        return int(choose(*own, inside))

    inner: list[int] = share(n_internal, chosen)
    return sum(inner) + chosen(n_internal, len(faces.owner))


def measured(points: Floats, faces: Faces) -> tuple[Floats, Floats]:
    """Return centres and area vectors of the faces, (n_faces, 3)."""
    centres, areas = np.empty((2, len(faces.owner), 3))
    measure = link(measure_faces)
    share(
        len(centres),
        lambda begin, end: measure(
            points, faces.start[begin : end + 1], faces.points, centres[begin:end], areas[begin:end]
        ),
    )
    return centres, areas


def cell_geometry(faces: Faces, centres: Floats, areas: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the means of the face centres of the cells, their centres and volumes; see `measure_cells`."""
    n, measure = len(faces.first) - 1, link(measure_cells)
    middles, found, volumes = np.empty((n, 3)), np.empty((n, 3)), np.empty(n)
    given = faces.first, faces.of_cell, faces.owner, centres, areas
    share(n, lambda begin, end: measure(begin, end, *given, middles, found, volumes))
    return middles, found, volumes


def inward_normals(points: Floats, triangles: Ints, areas: Floats) -> Floats:
    """Return inward unit normals (n, 3) of outward triangles; ``areas`` (n, 3) are of their faces, m²."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    p, q = (b - a).T, (c - a).T
    normals = -np.stack(vector_product((p[0], p[1], p[2]), (q[0], q[1], q[2])), axis=1)
    length = np.linalg.norm(normals, axis=1)
    # A triangle without area borrows the normal of its face.
    empty = length <= 1e-14 * np.maximum(np.linalg.norm(areas, axis=1), 1e-300)
    normals[empty] = -areas[empty]
    length[empty] = np.linalg.norm(areas[empty], axis=1)
    return normals / np.where(length > 0.0, length, 1.0)[:, None]
