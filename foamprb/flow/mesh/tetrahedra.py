"""Cells → tetrahedra with their neighbours; and faces that turn the wrong way, which this brings to light."""

from __future__ import annotations

import numpy as np

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.base import Ints
from foamprb.flow.mesh.faces import OPEN, TWISTED, split_cells
from foamprb.flow.mesh.geometry import Faces
from foamprb.flow.mesh.lists import MOST_INDICES, Index, Mask


def cut_into_tetrahedra(faces: Faces, n_points: int, source: str) -> tuple[Ints, Ints, Ints, Ints, Index]:
    """Tetrahedra by cell with their neighbours, the tetrahedron of each boundary triangle, cells astray."""
    n_cells, n_internal = len(faces.first) - 1, len(faces.neighbour)
    sizes = np.diff(faces.start)
    n_tets = int(sizes.sum() + sizes[:n_internal].sum()) - 2 * len(faces.of_cell)
    if 4 * n_tets > MOST_INDICES:
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


def turn_alike(faces: Faces, cells: Index) -> None:
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


def _against(faces: list[list[int]]) -> Mask:
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
    against: Mask = senses < 0 if senses.sum() >= 0 else senses > 0
    return against
