"""Walls that a body may touch: the clearance between a body and its walls, and which walls are near a cell.

Walls beyond a cyclic patch or a wedge count as well: they appear as images on this side of it.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from foamprb.body.tensor import Tensor, Vector, dot_vector, inverse, vector_dot
from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import MeshArrays
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.walk import NO_TRIANGLE, inward, nearest_point

# Entries of the lists of walls nearby: a gigabyte.
_MOST_ENTRIES = 250_000_000


def gap(flow: MeshArrays, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """Clearance between the ellipsoid {x + R F·ξ: ξ·ξ ≤ 1} and the nearest wall triangle.

    The map y → F⁻¹(y − x) turns the ellipsoid into a ball of radius R about the origin and keeps triangles
    triangles. The clearance is the distance of the mapped triangle from the origin (corners and edges count)
    less R: negative exactly when body and wall overlap. Over a plane wall at distance h with normal n it is
    h/|Fᵀn| − R.

    Returns
    -------
    gap, patch, triangle
        The clearance in metres of the undeformed ball, ``inf`` with −1, −1 when no wall triangle is near.
    """
    cell = flow.tets[host, 0] - flow.n_points
    begin, end = flow.near_start[cell], flow.near_start[cell + 1]
    if begin == end:
        return np.inf, -1, NO_TRIANGLE
    return nearest_wall(flow, begin, end, x, F, R)


def nearest_wall(
    flow: MeshArrays, begin: int, end: int, x: Vector, F: Tensor, R: float
) -> tuple[float, int, int]:
    """The nearest of those wall triangles that are listed from ``begin`` to ``end``, as :func:`gap`."""
    best, nearest = np.inf, NO_TRIANGLE
    inverse_F = inverse(F)
    nodes = flow.nodes
    for k in range(begin, end):
        triangle = flow.near[k]
        a, b, c = flow.triangles[triangle, 0], flow.triangles[triangle, 1], flow.triangles[triangle, 2]
        ra = (nodes[a, 0] - x[0], nodes[a, 1] - x[1], nodes[a, 2] - x[2])
        n = inward(flow, triangle)
        height = n[0] * ra[0] + n[1] * ra[1] + n[2] * ra[2]
        m = vector_dot(n, F)
        limit = best + R
        # The triangle's plane is no farther than the triangle.
        if height * height >= limit * limit * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]):
            continue
        rb = (nodes[b, 0] - x[0], nodes[b, 1] - x[1], nodes[b, 2] - x[2])
        rc = (nodes[c, 0] - x[0], nodes[c, 1] - x[1], nodes[c, 2] - x[2])
        distance = _distance(dot_vector(inverse_F, ra), dot_vector(inverse_F, rb), dot_vector(inverse_F, rc))
        if distance - R < best:
            best, nearest = distance - R, triangle
    return best, (flow.triangle_patch[nearest] if nearest >= 0 else -1), nearest


def _distance(a: Vector, b: Vector, c: Vector) -> float:
    """Distance of the triangle a, b, c from the origin."""
    p = nearest_point(a, b, c)
    return float(np.sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]))


class Walls(NamedTuple):
    """Triangles that a body may touch: corners (n, 3, 3), inward unit normals (n, 3), patches (n,)."""

    corners: Floats
    normals: Floats
    patches: Ints

    def moved(self, turn: Floats, shift: Floats) -> Walls:
        """The triangles where x → turn·x + shift carries them."""
        return Walls(self.corners @ turn.T + shift, self.normals @ turn.T, self.patches)

    def take(self, rows: Any) -> Walls:
        """Some of the triangles, by number or mask."""
        return Walls(*(array[rows] for array in self))


def images_of_walls(mesh: Mesh, walls: Walls, reach: float) -> Walls:
    """Images of the walls that lie beyond a coupled patch, within ``reach`` (m) of it.

    Where two pairs of patches meet, there are images of images.
    """
    found: list[Walls] = []
    sources = [(-1, walls)]
    for _ in range(2):
        images = []
        for pair, seen in sources:
            for coupling in mesh.couplings:
                if min(coupling.patch, coupling.other) == pair or len(coupling.faces) == 0:
                    continue
                # Beyond the patch lies what lies before its neighbour.
                boxes = _face_box(mesh, coupling.partners)
                low, high = seen.corners.min(axis=1), seen.corners.max(axis=1)
                near = np.all((high >= boxes[0] - reach) & (low <= boxes[1] + reach), axis=1)
                back = coupling.reverse()
                image = seen.take(near).moved(back.turn, back.shift)
                images.append((min(coupling.patch, coupling.other), image))
        found += [image for _, image in images]
        sources = images
    return Walls(*(np.concatenate(arrays) for arrays in zip(walls.take(slice(0)), *found, strict=True)))


def _face_box(mesh: Mesh, faces: Any) -> tuple[Floats, Floats]:
    """Corners of the box around boundary faces."""
    points = mesh.points[mesh.triangles[np.isin(mesh.triangle_face, faces)]].reshape(-1, 3)
    return points.min(axis=0), points.max(axis=0)


def near_walls(
    mesh: Mesh, boxes: Floats, tree: tuple[Floats, Ints], reach: float, names: Ints, corners: Floats
) -> tuple[Ints, Ints]:
    """List, cell by cell, the wall triangles within ``reach`` of the cell's box.

    Parameters
    ----------
    mesh, boxes, tree
        The mesh, its cells' boxes and the tree over them.
    reach
        Distance in metres, at least the longest semi-axis of a particle; 0 lists nothing.
    names, corners
        Indices (n,) of the triangles that count, and their corners (n, 3, 3).

    Returns
    -------
    near_start, near
        As in :class:`MeshArrays`; a box distance is never larger than the true one, so none is missed.

    Raises
    ------
    InputError
        The lists would be longer than memory should bear, as the reach is many cells wide.
    """
    start = np.zeros(mesh.n_cells + 1, dtype=np.int32)
    if reach <= 0.0 or len(names) == 0:
        return start, np.empty(0, dtype=np.int32)
    targets = np.concatenate([corners.min(axis=1) - reach, corners.max(axis=1) + reach], axis=1)
    meet = link(_meetings)
    counts = np.zeros(mesh.n_cells, dtype=np.int32)
    total = meet(*tree, boxes, targets, names, _MOST_ENTRIES, counts, np.empty(0, dtype=np.int32))
    if total > _MOST_ENTRIES:
        size = np.cbrt(np.median(mesh.volumes))
        raise InputError(
            f"Walls within {reach:g} m of a particle's centre may be touched, but cells are {size:g} m wide: "
            f"lists of the {len(names)} wall triangles near each of the {mesh.n_cells} cells would have more "
            f"than {_MOST_ENTRIES} entries. Are the particles as large as they should be? Particles many "
            "cells wide need a coarser mesh."
        )
    np.cumsum(counts, out=start[1:])
    near = np.empty(total, dtype=np.int32)
    meet(*tree, boxes, targets, names, _MOST_ENTRIES, start[:-1].copy(), near)
    return start, near


def pairs_near(boxes: Floats, tree: tuple[Floats, Ints], targets: Floats) -> tuple[Ints, Ints]:
    """Which of the boxes ``targets`` (n, 6) meet each cell's: start (n_cells + 1,), and their numbers."""
    start, names = np.zeros(len(boxes) + 1, dtype=np.int32), np.arange(len(targets), dtype=np.int32)
    meet, most, counts = link(_meetings), np.iinfo(np.int64).max - 1, np.zeros(len(boxes), dtype=np.int32)
    total = meet(*tree, boxes, targets, names, most, counts, np.empty(0, dtype=np.int32))
    np.cumsum(counts, out=start[1:])
    found = np.empty(total, dtype=np.int32)
    meet(*tree, boxes, targets, names, most, start[:-1].copy(), found)
    return start, found


def _meetings(
    tree_boxes: Floats,
    tree_cells: Ints,
    boxes: Floats,
    targets: Floats,
    names: Ints,
    most: int,
    place: Ints,
    found: Ints,
) -> int:
    """Count pairs of a cell and a target whose boxes meet, up to ``most`` and one, in all and by cell.

    With room in ``found``, the names of the targets go there from ``place`` (n_cells,) on, cell by cell.
    """
    leaves = tree_cells.shape[0]
    count = 0
    for i in range(targets.shape[0]):
        node = 1
        while node > 0:
            if _meet(tree_boxes, node, targets, i):
                if node < leaves:
                    node = 2 * node
                    continue
                for k in range(tree_cells.shape[1]):
                    cell = tree_cells[node - leaves, k]
                    if cell >= 0 and _meet(boxes, cell, targets, i):
                        if found.shape[0] > 0:
                            found[place[cell]] = names[i]
                        place[cell] += 1
                        count += 1
                if count > most:
                    return count
            while node & 1:
                node >>= 1
            if node > 0:
                node += 1
    return count


def _meet(boxes: Floats, i: int, others: Floats, j: int) -> bool:
    return bool(
        boxes[i, 0] <= others[j, 3]
        and boxes[i, 1] <= others[j, 4]
        and boxes[i, 2] <= others[j, 5]
        and others[j, 0] <= boxes[i, 3]
        and others[j, 1] <= boxes[i, 4]
        and others[j, 2] <= boxes[i, 5]
    )
