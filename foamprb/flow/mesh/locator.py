"""Point location: the tetrahedron that holds a point, by a tree of cells."""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Vector
from foamprb.compile.link import link, separate
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import TOLERANCE, MeshArrays, frame, weights
from foamprb.flow.mesh.folds import SOUND, is_in_mesh
from foamprb.flow.mesh.lists import share
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.mesh.tree import holds_point, next_node


def cell_boxes(mesh: Mesh) -> Floats:
    """Return the bounding boxes of the cells, (n_cells, 6): lower corner, upper corner.

    They hold the cells' tetrahedra and are larger by the tolerance of :func:`locate`.
    """
    boxes, start, bound = np.empty((mesh.n_cells, 6)), mesh.cell_point_start, link(_bound)

    def part(low: int, high: int) -> None:
        own = mesh.centres[low:high], start[low : high + 1], mesh.cell_points
        bound(mesh.points, *own, boxes[low:high])

    share(mesh.n_cells, part)
    return boxes


def _bound(points: Floats, centres: Floats, start: Ints, lists: Ints, boxes: Floats) -> None:
    for c in range(boxes.shape[0]):
        size = 0.0
        for i in range(3):
            low = high = centres[c, i]
            for k in range(start[c], start[c + 1]):
                x = points[lists[k], i]
                low, high = min(low, x), max(high, x)
            boxes[c, i], boxes[c, i + 3] = low, high
            size = max(size, high - low)
        margin = 4.0 * TOLERANCE * size
        for i in range(3):
            boxes[c, i] -= margin
            boxes[c, i + 3] += margin


def locate(flow: MeshArrays, x: Vector) -> int:
    """Return the tetrahedron that holds x, or −1 if x lies outside the mesh; see :func:`seek`."""
    box = flow.tree_boxes
    dx, dy, dz = box[1, 3] - box[1, 0], box[1, 4] - box[1, 1], box[1, 5] - box[1, 2]
    return seek(flow, x, (dx, 0.1 * dy, 0.01 * dz))


@separate
def seek(flow: MeshArrays, x: Vector, way: Vector) -> int:
    """Return the tetrahedron that holds x and from which a walk in direction ``way`` can start, −1 for none.

    Of several (x on a shared face) it is the one with the largest smallest barycentric weight, then the first
    of them. A tetrahedron in a fold counts only if x is a point of the mesh in it.
    """
    cells, first_tet = flow.tree_cells, flow.cell_start
    best, depth = -1, -TOLERANCE
    node, n_leaves = 1, cells.shape[0]
    while node > 0:
        hit = holds_point(flow.tree_boxes, node, x)
        for k in range(cells.shape[1] if hit and node >= n_leaves else 0):
            cell = cells[node - n_leaves, k]
            if cell < 0:
                continue
            for tet in range(first_tet[cell], first_tet[cell + 1]):
                smallest = depth_of(flow, int(tet), x)
                better = smallest > depth or (smallest == depth and tet < best)
                if better and (flow.folds[cell] == SOUND or is_in_mesh(flow, tet, x, way)):
                    best, depth = tet, smallest
        node = next_node(node, n_leaves, hit)
    return best


def depth_of(flow: MeshArrays, tet: int, x: Vector) -> float:
    """Return the smallest barycentric weight of a tetrahedron at x; −∞ without volume."""
    origin, c1, c2, c3, volume = frame(flow, tet)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    if volume == 0.0:
        return -np.inf
    return min(w0 / volume, w1 / volume, w2 / volume, w3 / volume)
