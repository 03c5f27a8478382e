"""Points of baffles: each side of a wall without thickness has points of its own.

Cells around a point are joined by the faces between them that hold the point. A point on the boundary whose
cells form several groups is copied for each group except the one with the lowest cell. The copies are
numbered behind all points: by their points, then by the lowest cells of their groups.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.boundary import mix
from foamprb.flow.mesh.faces import Faces
from foamprb.flow.mesh.lists import Index, Labels, int32, take_lists


def part_points(points: Floats, faces: Faces, start: Ints, cell_points: Ints) -> tuple[Floats, Faces, Ints]:
    """Duplicate the points of baffles."""
    n, outer = len(points), np.arange(len(faces.neighbour), len(faces.owner))
    codes = codes_of(faces.start, faces.points, outer)
    if len(np.unique(codes)) == len(codes):
        return points, faces, cell_points
    neighbour = np.full(len(faces.owner), -1, dtype=np.int32)
    neighbour[: outer[0]] = faces.neighbour
    corners, groups = _groups(n, faces.start, faces.points, outer, faces.owner, neighbour)
    pairs, place = np.unique(np.stack([corners % n, groups]), axis=1, return_inverse=True)
    copy = np.append(False, pairs[0, 1:] == pairs[0, :-1])
    names = np.where(copy, n - 1 + np.cumsum(copy), pairs[0])[place.reshape(-1)]

    def renamed(cells: Labels, sizes: Labels, lists: Ints) -> Ints:
        wanted = np.repeat(cells.astype(np.int64), sizes) * n + lists
        return int32(_looked_up(corners, names, wanted, lists))

    lists = renamed(faces.owner, np.diff(faces.start), faces.points)
    moved = renamed(np.arange(len(start) - 1), np.diff(start), cell_points)
    return np.concatenate([points, points[pairs[0, copy]]]), faces._replace(points=lists), moved


def codes_of(start: Labels, lists: Labels, faces: Index) -> NDArray[np.uint64]:
    """Return a hash of the points of each of some faces, the same in any order of the points."""
    outer, points = take_lists(start, lists, faces)
    return np.add.reduceat(mix(points), outer[:-1]) if len(faces) else np.empty(0, dtype=np.uint64)


def _groups(
    n_points: int, start: Labels, lists: Labels, outer: Index, owner: Labels, neighbour: Labels
) -> tuple[NDArray[np.int64], Index]:
    """Return the corners, each a cell and one of its points on the boundary, and their groups.

    Parameters
    ----------
    n_points
        Number of points.
    start, lists, outer
        Points of the faces; the faces of the boundary.
    owner, neighbour
        (n_faces,) cells, −1 for none.

    Returns
    -------
    corners, groups
        cell · n_points + point, rising; numbers of groups in the order of their first corners.
    """
    from scipy import sparse
    from scipy.sparse import csgraph

    on_wall = np.zeros(n_points, dtype=bool)
    on_wall[take_lists(start, lists, outer)[1]] = True
    at = np.flatnonzero(on_wall[lists])
    face = np.repeat(np.arange(len(start) - 1), np.diff(start))[at]
    one, other = (side[face].astype(np.int64) * n_points + lists[at] for side in (owner, neighbour))
    corners = np.unique(np.concatenate([one, other]))
    corners = corners[corners >= 0]
    both = np.minimum(one, other) >= 0
    joined = [np.searchsorted(corners, side[both]) for side in (one, other)]
    ones = np.ones(np.count_nonzero(both), dtype=np.int8)
    graph = sparse.coo_array((ones, joined), shape=2 * (len(corners),))
    return corners, csgraph.connected_components(graph, directed=False)[1].astype(np.intp)


def _looked_up(keys: Labels, values: Labels, wanted: Labels, otherwise: Labels) -> Labels:
    """Return the value of each wanted one of rising keys, or else the entry of ``otherwise``."""
    at = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    return np.where(keys[at] == wanted, values[at], otherwise)
