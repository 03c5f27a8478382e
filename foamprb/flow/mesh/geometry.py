"""The faces of a mesh in order, which way they turn, and centres, areas and volumes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.cells import HalfFaces
from foamprb.flow.mesh.faces import add_at, add_pyramids, bound, gather_faces, measure_faces
from foamprb.flow.mesh.lists import ragged

# Faces handled at once: the temporary arrays then stay in the cache.
_CHUNK = 1 << 15


class Faces(NamedTuple):
    """The faces of a mesh, those between two cells first; they turn outwards from their owner."""

    start: Ints
    points: Ints
    owner: Ints
    neighbour: Ints
    first: Ints
    """(n_cells + 1,) into ``of_cell``."""
    of_cell: Ints
    """The faces of each cell; a face's owner comes before its neighbour."""


def order_faces(points: Floats, half: HalfFaces, mate: Ints) -> tuple[Faces, Floats]:
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
    faces = Faces(start, lists, owner, neighbour, half.first, of_cell)
    middles = _cell_middles(points, faces)
    for part, centres, areas in _measured(points, faces):
        own, beyond = owner[part], neighbour[part]
        ahead = centres - middles[own]
        ahead[: len(beyond)] = middles[beyond] - middles[own[: len(beyond)]]
        inwards = part.start + np.flatnonzero(np.einsum("fi,fi->f", areas, ahead) < 0.0)
        sizes = start[inwards + 1] - start[inwards]
        backwards = np.repeat(start[inwards] + start[inwards + 1] - 1, sizes)
        places = ragged(start[inwards], sizes)
        lists[places] = lists[backwards - places]
    return faces, middles


def _measured(points: Floats, faces: Faces, first: int = 0) -> Iterator[tuple[slice, Floats, Floats]]:
    """Centres and area vectors of the faces from the first on, part by part."""
    n, measure = len(faces.owner), link(measure_faces)
    for low in range(first, n, _CHUNK):
        part = slice(low, min(low + _CHUNK, n))
        centres, areas = np.empty((part.stop - low, 3)), np.empty((part.stop - low, 3))
        measure(points, faces.start[low : part.stop + 1], faces.points, centres, areas)
        yield part, centres, areas


def boundary_geometry(points: Floats, faces: Faces) -> tuple[Floats, Floats]:
    """Centres and area vectors of the boundary faces."""
    n_internal = len(faces.neighbour)
    centres, areas = np.empty((2, len(faces.owner) - n_internal, 3))
    for part, *measured in _measured(points, faces, n_internal):
        to = slice(part.start - n_internal, part.stop - n_internal)
        centres[to], areas[to] = measured
    return centres, areas


def _cell_middles(points: Floats, faces: Faces) -> Floats:
    """Means of the centres of each cell's faces."""
    middles, add = np.zeros((len(faces.first) - 1, 3)), link(add_at)
    for part, centres, _ in _measured(points, faces):
        for cells in (faces.owner[part], faces.neighbour[part]):
            add(cells, centres, middles)
    middles /= np.diff(faces.first)[:, None]
    return middles


def cell_geometry(points: Floats, faces: Faces, middles: Floats) -> tuple[Floats, Floats]:
    """Cell centres and volumes, by pyramids about the means of the face centres.

    A centre that is not among the face centres, as where the volume is round-off, is their mean instead.
    """
    add, widen = link(add_pyramids), link(bound)
    moments, volumes = np.zeros((len(middles), 3)), np.zeros(len(middles))
    low, high = np.full((len(middles), 3), np.inf), np.full((len(middles), 3), -np.inf)
    for part, centres, areas in _measured(points, faces):
        for cells, sign in ((faces.owner[part], 1.0), (faces.neighbour[part], -1.0)):
            add(cells, sign, centres, areas, middles, volumes, moments)
            widen(cells, centres, low, high)
    moments /= np.where(volumes == 0.0, np.inf, volumes)[:, None]
    moments += middles
    # By round-off it may be beside them.
    room = 1e-9 * (high - low).max(axis=1)[:, None]
    astray = ~((low - room <= moments) & (moments <= high + room)).all(axis=1)
    moments[astray] = middles[astray]
    return moments, volumes


def inward_normals(points: Floats, triangles: Ints, areas: Floats) -> Floats:
    """Unit normals (n, 3) of triangles that turn outwards; ``areas`` (n, 3) are those of their faces, m²."""
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
