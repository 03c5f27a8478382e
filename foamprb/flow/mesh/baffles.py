"""Walls without thickness inside the mesh: a face between two cells that is a patch's on either side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.boundary import PatchSurface, mix
from foamprb.flow.mesh.cells import HalfFaces
from foamprb.flow.mesh.lists import Mask, cell_array, points_of, take_lists


def find_baffles(
    points: Floats, dtype: Any, half: HalfFaces, mate: Ints, surfaces: Sequence[PatchSurface] | None
) -> Mask:
    """Which of the matched halves belong to patches: walls without thickness, with a patch on either side."""
    inside = mate != np.arange(len(mate), dtype=np.int32)
    faces = sum(surface.surface.GetNumberOfCells() for surface in surfaces or ())
    if surfaces is None or faces <= np.count_nonzero(~inside):
        return np.zeros(len(mate), dtype=bool)
    polygons = [cell_array(surface.surface.GetPolys()) for surface in surfaces]
    clouds = [points_of(surface.surface).astype(dtype, copy=False) for surface in surfaces]
    coordinates = np.concatenate([points.astype(dtype), *clouds]) + 0
    place = np.unique(coordinates, axis=0, return_inverse=True)[1].reshape(-1).astype(np.intp)
    begin, wanted = len(points), []
    for (start, lists), cloud in zip(polygons, clouds, strict=True):
        if len(start) > 1:
            wanted.append(np.add.reduceat(mix(place[begin + lists]), start[:-1]))
        begin += len(cloud)
    codes = np.add.reduceat(mix(place[half.points]), half.start[:-1])
    found: Mask = inside & np.isin(codes, np.concatenate(wanted))
    return found


def part_points(
    points: Floats, half: HalfFaces, mate: Ints, start: Ints, cell_points: Ints
) -> tuple[Floats, HalfFaces, Ints]:
    """Give each side of a baffle points of its own, where no way around through cells joins the sides.

    Around a point, cells are joined by the faces between them that hold the point; a point whose cells fall
    into several groups is copied for each group but one.
    """
    on_wall = np.zeros(len(points), dtype=bool)
    sizes, cell_of = np.diff(half.start), half.cells().astype(np.intp)
    first = np.arange(len(mate))
    on_wall[take_lists(half.start, half.points, first[mate == first])[1]] = True
    # Corners: a cell and one of its points on a wall.
    cells = np.repeat(np.arange(len(start) - 1), np.diff(start))
    at = np.flatnonzero(on_wall[cell_points])
    keys = cells[at] * len(points) + cell_points[at]
    order = np.argsort(keys)
    keys = keys[order]
    inside = first[mate > first]
    owners = np.repeat(cell_of[inside], sizes[inside])
    others = np.repeat(cell_of[mate[inside]], sizes[inside])
    shared = take_lists(half.start, half.points, inside)[1]
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
