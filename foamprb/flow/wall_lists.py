"""Lists of the walls near each cell, for the contact of bodies and for models that depend on walls.

A tree over the wall triangles, whose nodes also bound the directions of normals, makes both lists. A list
for contact holds all triangles within its reach. If these are too many, it holds only the nearest one, from
which the tree is searched. A list for models holds each triangle that is a wall in the sense of
:func:`foamprb.flow.planes.walls` for some place in the cell.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, vector_product
from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.tree import build_tree, meet, next_node, square_to_box
from foamprb.flow.walk import nearest_point

MOST_LISTED = 64
"""Largest number of triangles in a list for contact; beyond it, only the nearest to the cell's centre."""
# One gigabyte.
_MOST_ENTRIES = 250_000_000
_FLAT = 1e-9
"""Sine of the angle, and share of a length, below which an edge is flat."""
_SAME = 1e-12
"""Distance over extent below which two triangles lie in one plane."""


class WallTree(NamedTuple):
    """Triangles of walls and a tree over them; indices refer to ``corners``."""

    corners: Floats
    """(n, 3, 3): triangle, vertex, coordinate; m."""
    normals: Floats
    """(n, 3), unit, into the fluid."""
    boxes: Floats
    """(2 n_leaves, 6), as ``tree_boxes`` of :class:`foamprb.flow.mesh.arrays.MeshArrays`."""
    leaves: Ints
    """(n_leaves, leaf size), as ``tree_cells`` there."""
    cones: Floats
    """(2 n_leaves, 5): a direction, the largest angle of a normal of the node with it, and 1 if one of its
    triangles has an edge or a corner that can be nearer than any face, else 0."""
    edges: NDArray[np.bool_]
    """(n,) whether a triangle has such an edge."""


def wall_tree(corners: Floats, normals: Floats, seen: bool = True) -> WallTree:
    """Return the tree over triangles of walls; cones and edges are zero unless these are ``seen``."""
    boxes, leaves = build_tree(np.concatenate([corners.min(axis=1), corners.max(axis=1)], axis=1))
    if not seen:
        none = np.zeros((len(boxes), 5)), np.zeros(len(corners), dtype=bool)
        return WallTree(corners, normals, boxes, leaves, *none)
    edges = edges_out(corners, normals)
    return WallTree(corners, normals, boxes, leaves, _cones(normals, edges, leaves), edges)


def edges_out(corners: Floats, normals: Floats) -> NDArray[np.bool_]:
    """Return which triangles have an edge at which the wall ends or recedes from the fluid, (n,).

    The nearest point of a wall lies on such an edge, or on a corner of one, or in a triangle.
    """
    n = len(corners)
    # Corners that are the same to round-off of the longest coordinate, by number.
    size = np.abs(corners).max(initial=1e-300)
    keys = np.round(corners.reshape(-1, 3) / (1e-12 * size)).astype(np.int64)
    _, number = np.unique(keys, axis=0, return_inverse=True)
    number = number.reshape(n, 3)
    ends = np.stack([number, np.roll(number, -1, axis=1)], axis=2).reshape(-1, 2)
    ends.sort(axis=1)
    owner = np.repeat(np.arange(n), 3)
    apex = np.roll(corners, -2, axis=1).reshape(-1, 3)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    same = np.all(ends[order][1:] == ends[order][:-1], axis=1)
    first = np.concatenate([[True], ~same])
    group = np.cumsum(first) - 1
    paired = np.bincount(group, minlength=1)[group] == 2
    out = np.ones(3 * n, dtype=bool)
    one = np.flatnonzero(first & paired)
    a, b = order[one], order[one + 1]
    # The other's third corner lies below the plane of the first.
    arms = apex[b] - corners.reshape(-1, 3)[a]
    length = np.linalg.norm(arms, axis=1)
    recedes = np.einsum("ni,ni->n", normals[owner[a]], arms) < -_FLAT * length
    out[a] = out[b] = recedes
    some = np.zeros(n, dtype=bool)
    some[owner[out]] = True
    return some


def _cones(normals: Floats, edges: NDArray[np.bool_], leaves: Ints) -> Floats:
    """See :class:`WallTree`."""
    n = len(leaves)
    cones = np.zeros((2 * n, 5))
    there = leaves >= 0
    directions = np.where(there[:, :, None], normals[leaves], 0.0)
    axis = _unit(directions.sum(axis=1))
    angles = np.arccos(np.clip(np.einsum("nki,ni->nk", directions, axis), -1.0, 1.0))
    cones[n:, :3], cones[n:, 3] = axis, np.where(there, angles, 0.0).max(axis=1)
    cones[n:, 4] = (edges[leaves] & there).any(axis=1)
    filled = np.zeros(2 * n, dtype=bool)
    filled[n:] = there.any(axis=1)
    first = n
    while first > 1:
        first //= 2
        two = cones[2 * first : 4 * first].reshape(first, 2, 5)
        some = filled[2 * first : 4 * first].reshape(first, 2)
        axis = _unit((two[:, :, :3] * some[:, :, None]).sum(axis=1))
        angles = np.arccos(np.clip(np.einsum("nki,ni->nk", two[:, :, :3], axis), -1.0, 1.0)) + two[:, :, 3]
        here = slice(first, 2 * first)
        cones[here, :3] = axis
        cones[here, 3] = np.minimum(np.where(some, angles, 0.0).max(axis=1), math.pi)
        cones[here, 4] = (two[:, :, 4] * some).max(axis=1)
        filled[here] = some.any(axis=1)
    return cones


def _unit(v: Floats) -> Floats:
    """Return the unit vectors of rows; x for a row without direction."""
    length = np.linalg.norm(v, axis=1, keepdims=True)
    unit: Floats = np.where(length > 1e-12, v / np.maximum(length, 1e-300), [[1.0, 0.0, 0.0]])
    return unit


def near_walls(tree: WallTree, boxes: Floats, reach: float, names: Ints, size: float) -> tuple[Ints, Ints]:
    """List, cell by cell, the wall triangles whose boxes are within ``reach`` of the cell's, along each axis.

    Parameters
    ----------
    tree
        Of the triangles that count.
    boxes
        Those of the cells.
    reach
        Distance in metres, at least the longest semi-axis of a particle.
    names
        (n,) names of the tree's triangles, rising.
    size
        Width of a cell, m, for the message.

    Returns
    -------
    near_start, near
        As in :class:`foamprb.flow.mesh.arrays.MeshArrays`; boxes contain their triangles, so that none is
        missed.

    Raises
    ------
    InputError
        The lists would be longer than memory should bear.
    """
    n_cells = len(boxes)
    start = np.zeros(n_cells + 1, dtype=np.int32)
    counts = np.zeros(n_cells, dtype=np.int32)
    listing = link(_list_near)
    none, work = np.empty(0, dtype=np.int32), np.empty(MOST_LISTED, dtype=np.int32)
    total = listing(tree, boxes, reach, names, counts, start, none, work)
    if total > _MOST_ENTRIES:
        raise InputError(
            f"Walls within {reach:g} m of a particle's centre may be touched, but cells are {size:g} m wide: "
            f"lists of the {len(names)} wall triangles near each of the {n_cells} cells would have more "
            f"than {_MOST_ENTRIES} entries. Are the particles as large as they should be? Particles many "
            "cells wide need a coarser mesh."
        )
    np.cumsum(counts, out=start[1:])
    near = np.empty(total, dtype=np.int32)
    listing(tree, boxes, reach, names, counts, start, near, work)
    return start, near


def _list_near(
    tree: WallTree,
    boxes: Floats,
    reach: float,
    names: Ints,
    counts: Ints,
    start: Ints,
    near: Ints,
    found: Ints,
) -> int:
    """Count the entries of each list, or fill them if there is room in ``near``; return the sum.

    ``found`` (most,) holds those of one.
    """
    total, seed, filling = 0, 0, near.shape[0] > 0
    leaves, most = tree.leaves.shape[0], found.shape[0]
    for cell in range(boxes.shape[0]):
        count = 0
        node = 1
        while node > 0 and count <= most:
            hit = meet(tree.boxes, node, boxes, cell, reach)
            for k in range(tree.leaves.shape[1] if hit and node >= leaves else 0):
                i = tree.leaves[node - leaves, k]
                if i >= 0 and count <= most and _triangle_meets(tree.corners, i, boxes, cell, reach):
                    if count < most:
                        found[count] = i
                    count += 1
            node = next_node(node, leaves, hit)
        if filling and count > most:
            seed, _ = nearest_triangle(tree, _middle(boxes, cell), math.inf, seed)
            near[start[cell]] = -1 - names[seed]
        elif filling:
            _sort(found, 0, count)
            planes = _planes_first(tree, found, count)
            for k in range(count):
                name = names[found[k]]
                near[start[cell] + k] = name if k < planes else -1 - name
        counts[cell] = 1 if count > most else count
        total += counts[cell]
    return total


def _planes_first(tree: WallTree, found: Ints, count: int) -> int:
    """Move the first triangle of each plane to the front; return the number of planes.

    The order among these is kept, and so is the order of the others.
    """
    planes = 0
    for k in range(count):
        i, alone = found[k], True
        for m in range(planes):
            alone = alone and not _in_plane(tree, found[m], i)
        if alone:
            for m in range(k, planes, -1):
                found[m] = found[m - 1]
            found[planes] = i
            planes += 1
    return planes


def _triangle_meets(corners: Floats, i: int, boxes: Floats, cell: int, reach: float) -> bool:
    """Return True if the box of a triangle meets that of a cell, see :func:`foamprb.flow.mesh.tree.meet`."""
    for axis in range(3):
        a, b, c = corners[i, 0, axis], corners[i, 1, axis], corners[i, 2, axis]
        if min(a, b, c) - reach > boxes[cell, axis + 3] or boxes[cell, axis] > max(a, b, c) + reach:
            return False
    return True


def _middle(boxes: Floats, cell: int) -> Vector:
    return (
        0.5 * (boxes[cell, 0] + boxes[cell, 3]),
        0.5 * (boxes[cell, 1] + boxes[cell, 4]),
        0.5 * (boxes[cell, 2] + boxes[cell, 5]),
    )


def nearest_triangle(tree: WallTree, x: Vector, cut: float, seed: int) -> tuple[int, float]:
    """Return the triangle nearest to x and its distance; −1 if none is nearer than ``cut`` (m).

    ``seed`` is one that may be near.
    """
    best, nearest = cut * cut, -1
    square = _square_to_triangle(tree.corners, seed, x)
    if square < best:
        best, nearest = square, seed
    leaves = tree.leaves.shape[0]
    node = 1
    while node > 0:
        hit = square_to_box(tree.boxes, node, x) < best
        for k in range(tree.leaves.shape[1] if hit and node >= leaves else 0):
            i = tree.leaves[node - leaves, k]
            if i >= 0:
                square = _square_to_triangle(tree.corners, i, x)
                if square < best:
                    best, nearest = square, i
        node = next_node(node, leaves, hit)
    return nearest, math.sqrt(best)


def _square_to_triangle(corners: Floats, i: int, x: Vector) -> Any:
    p = nearest_point(_seen(corners, i, 0, x), _seen(corners, i, 1, x), _seen(corners, i, 2, x))
    return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]


def _seen(corners: Floats, i: int, k: int, x: Vector) -> Vector:
    return corners[i, k, 0] - x[0], corners[i, k, 1] - x[1], corners[i, k, 2] - x[2]


def seen_walls(tree: WallTree, boxes: Floats, sight: float, names: Ints) -> tuple[Ints, Ints]:
    """List, cell by cell, the triangles that can be a wall for some place in the cell, nearer than ``sight``.

    Parameters
    ----------
    As in :func:`near_walls`; ``sight`` is a distance from the place, m.

    Returns
    -------
    seen_start, seen
        As in :class:`foamprb.flow.mesh.arrays.MeshArrays`, each list in ascending order.
    """
    start = np.zeros(len(boxes) + 1, dtype=np.int32)
    listing = link(_list_seen)
    listing(tree, boxes, sight, names, start, np.empty(0, dtype=np.int32))
    np.cumsum(start, out=start)
    found = np.empty(start[-1], dtype=np.int32)
    listing(tree, boxes, sight, names, start, found)
    return start, found


def _list_seen(tree: WallTree, boxes: Floats, sight: float, names: Ints, start: Ints, found: Ints) -> None:
    """Write the list of each cell to ``found``; if that is empty, the length of each to ``start``."""
    filling, seed, leaves = found.shape[0] > 0, 0, tree.leaves.shape[0]
    for cell in range(boxes.shape[0]):
        middle = _middle(boxes, cell)
        half = boxes[cell, 3] - middle[0], boxes[cell, 4] - middle[1], boxes[cell, 5] - middle[2]
        size = math.sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2])
        nearest, distance = nearest_triangle(tree, middle, sight + size, seed)
        if nearest < 0:
            continue
        seed = nearest
        limit = min(distance + size, sight)
        n, node = 0, 1
        while node > 0:
            square = _square_between(tree.boxes, node, boxes, cell)
            hit = square < sight * sight and (
                (tree.cones[node, 4] > 0.0 and square <= limit * limit) or _faces(tree, node, middle, size)
            )
            for k in range(tree.leaves.shape[1] if hit and node >= leaves else 0):
                i = tree.leaves[node - leaves, k]
                kind = _kind(tree, i, boxes, cell, middle, half, sight, limit) if i >= 0 else -1
                if kind >= 0:
                    if filling:
                        found[start[cell] + n] = 2 * names[i] + kind
                    n += 1
            node = next_node(node, leaves, hit)
        if filling:
            _sort(found, start[cell], start[cell] + n)
        else:
            start[cell + 1] = n


def _square_between(boxes: Floats, i: int, others: Floats, j: int) -> Any:
    """Square of the distance between two boxes, m²."""
    dx = max(boxes[i, 0] - others[j, 3], 0.0, others[j, 0] - boxes[i, 3])
    dy = max(boxes[i, 1] - others[j, 4], 0.0, others[j, 1] - boxes[i, 4])
    dz = max(boxes[i, 2] - others[j, 5], 0.0, others[j, 2] - boxes[i, 5])
    return dx * dx + dy * dy + dz * dz


def _faces(tree: WallTree, node: int, middle: Vector, size: float) -> bool:
    """Return True if a perpendicular from within ``size`` of a place may end on a triangle of a node."""
    b, cone = tree.boxes, tree.cones
    wx = middle[0] - 0.5 * (b[node, 0] + b[node, 3])
    wy = middle[1] - 0.5 * (b[node, 1] + b[node, 4])
    wz = middle[2] - 0.5 * (b[node, 2] + b[node, 5])
    ex, ey, ez = b[node, 3] - b[node, 0], b[node, 4] - b[node, 1], b[node, 5] - b[node, 2]
    blur = size + 0.5 * math.sqrt(ex * ex + ey * ey + ez * ez)
    length = math.sqrt(wx * wx + wy * wy + wz * wz)
    if length <= blur:
        return True
    cosine = (wx * cone[node, 0] + wy * cone[node, 1] + wz * cone[node, 2]) / length
    allowed = cone[node, 3] + math.asin(blur / length) + _FLAT
    return bool(allowed >= math.pi or cosine >= math.cos(allowed))


def _kind(
    tree: WallTree, i: int, boxes: Floats, cell: int, middle: Vector, half: Vector, sight: float, limit: float
) -> int:
    """Return 1 if an edge of triangle i may be the nearest wall to a place in the cell.

    Otherwise 0 if a perpendicular from the cell may end on the triangle, else −1.
    """
    corners, n = tree.corners, tree.normals
    edge = False
    if tree.edges[i]:
        square = 0.0
        for axis in range(3):
            a, b, c = corners[i, 0, axis], corners[i, 1, axis], corners[i, 2, axis]
            d = max(min(a, b, c) - boxes[cell, axis + 3], 0.0, boxes[cell, axis] - max(a, b, c))
            square += d * d
        edge = square <= limit * limit
    normal = n[i, 0], n[i, 1], n[i, 2]
    h, extent = inner(normal, _seen(corners, i, 0, middle)), _extent(normal, half)
    # All of the cell behind the wall, or farther from its plane than can be seen.
    if h - extent >= 0.0 or -h - extent >= sight:
        return -1
    foot = True
    for k in range(3):
        a, b = _seen(corners, i, k, middle), _seen(corners, i, (k + 1) % 3, middle)
        c = _seen(corners, i, (k + 2) % 3, middle)
        along = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        # In the plane, across the edge, away from the third corner.
        out = vector_product(along, normal)
        if inner(out, c) > inner(out, a):
            out = -out[0], -out[1], -out[2]
        if -inner(out, a) - _extent(out, half) > _FLAT * inner(along, along):
            foot = False
    if edge:
        return 1
    return 0 if foot else -1


def _in_plane(tree: WallTree, i: int, j: int) -> bool:
    """Return True if triangle j lies in the plane of i, to :data:`_SAME` of its own extent."""
    n, m, corners = tree.normals, tree.normals, tree.corners
    if n[i, 0] * m[j, 0] + n[i, 1] * m[j, 1] + n[i, 2] * m[j, 2] < 0.5:
        return False
    length = 0.0
    for axis in range(3):
        length = max(length, abs(corners[j, 1, axis] - corners[j, 0, axis]))
        length = max(length, abs(corners[j, 2, axis] - corners[j, 0, axis]))
    origin = corners[i, 0, 0], corners[i, 0, 1], corners[i, 0, 2]
    normal = n[i, 0], n[i, 1], n[i, 2]
    off = 0.0
    for k in range(3):
        off = max(off, abs(inner(normal, _seen(corners, j, k, origin))))
    return bool(off <= _SAME * length)


def _sort(numbers: Ints, begin: int, end: int) -> None:
    """Let the numbers from ``begin`` to ``end`` rise; there are few."""
    for k in range(begin + 1, end):
        number, place = numbers[k], k
        while place > begin and numbers[place - 1] > number:
            numbers[place] = numbers[place - 1]
            place -= 1
        numbers[place] = number


def _extent(direction: Vector, half: Vector) -> Any:
    """Return the extent of a box of these half widths from its middle along a direction, times its length."""
    return abs(direction[0]) * half[0] + abs(direction[1]) * half[1] + abs(direction[2]) * half[2]
