"""The tree that finds the cell, and in it the tetrahedron, that holds a point."""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Vector
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import TOLERANCE, MeshArrays, frame, next_leaf, weights
from foamprb.flow.mesh.folds import SOUND, is_there
from foamprb.flow.mesh.mesh import Mesh

_LEAF = 8


def cell_boxes(mesh: Mesh) -> Floats:
    """Bounding boxes of the cells, (n_cells, 6): lower corner, upper corner.

    A box holds the cell's tetrahedra and is larger by the tolerance of :func:`locate`.
    """
    boxes = np.empty((mesh.n_cells, 6))
    link(_bound)(mesh.points, mesh.centres, mesh.cell_point_start, mesh.cell_points, boxes)
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


def build_tree(boxes: Floats) -> tuple[Floats, Ints]:
    """Sort boxes into a balanced binary tree.

    Each level cuts every group in two equal halves along the axis on which the group is longest.

    Parameters
    ----------
    boxes
        (n, 6), lower and upper corners.

    Returns
    -------
    tree_boxes, tree_cells
        As in :class:`MeshArrays`.
    """
    n = len(boxes)
    depth = max(0, int(np.ceil(np.log2(n / _LEAF))))
    leaves = 1 << depth
    leaf = -(-n // leaves)
    # Entries that hold no cell sort behind all others.
    centres = np.full((leaf * leaves, 3), np.inf)
    centres[:n] = 0.5 * (boxes[:, :3] + boxes[:, 3:])
    order = np.arange(leaf * leaves, dtype=np.int32)
    link(_halve)(centres, order, depth)
    order = np.sort(order.reshape(leaves, leaf), axis=1)
    cells = np.where(order < n, order, np.int32(-1))

    tree = np.empty((2 * leaves, 6))
    empty = np.array([np.inf] * 3 + [-np.inf] * 3)
    tree[0] = empty
    padded = boxes[cells]
    padded[cells < 0] = empty
    tree[leaves:, :3] = padded[:, :, :3].min(axis=1)
    tree[leaves:, 3:] = padded[:, :, 3:].max(axis=1)
    for level in reversed(range(depth)):
        first = 1 << level
        children = tree[2 * first : 4 * first].reshape(first, 2, 6)
        tree[first : 2 * first, :3] = children[:, :, :3].min(axis=1)
        tree[first : 2 * first, 3:] = children[:, :, 3:].max(axis=1)
    return tree, cells


def _halve(centres: Floats, order: Ints, depth: int) -> None:
    """Put the lower half of each group along its longest axis before the upper, on each level of the tree."""
    for level in range(depth):
        size = order.shape[0] >> level
        for begin in range(0, order.shape[0], size):
            axis, longest = 0, 0.0
            for j in range(3):
                low, high = np.inf, -np.inf
                for k in range(begin, begin + size):
                    x = centres[order[k], j]
                    low, high = min(low, x), max(high, x if x < np.inf else high)
                if high - low > longest:
                    axis, longest = j, high - low
            _part(centres, axis, order, begin, begin + size - 1, begin + size // 2)


def _part(centres: Floats, axis: int, order: Ints, first: int, last: int, middle: int) -> None:
    """Let no entry before ``middle`` lie above one behind it (Hoare's selection)."""
    while first < last:
        pivot = centres[order[(first + last) // 2], axis]
        i, j = first, last
        while i <= j:
            while centres[order[i], axis] < pivot:
                i += 1
            while centres[order[j], axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                i += 1
                j -= 1
        if middle <= j:
            last = j
        elif middle >= i:
            first = i
        else:
            return


def locate(flow: MeshArrays, x: Vector) -> int:
    """Find the tetrahedron that holds x, or −1 when x lies outside the mesh; as :func:`seek`."""
    box = flow.tree_boxes
    dx, dy, dz = box[1, 3] - box[1, 0], box[1, 4] - box[1, 1], box[1, 5] - box[1, 2]
    return seek(flow, x, (dx, 0.1 * dy, 0.01 * dz))


def seek(flow: MeshArrays, x: Vector, way: Vector) -> int:
    """Find the tetrahedron that holds x, and from which a walk can go that way, or −1 when there is none.

    Of several (x on a shared face) it is the one whose smallest barycentric weight is largest, then the first
    in the order of the tree. A tetrahedron in a fold counts only if x is a place of the mesh in it.
    """
    cells, first_tet = flow.tree_cells, flow.cell_start
    best, depth = -1, -TOLERANCE
    leaf = next_leaf(flow, 0, x)
    while leaf > 0:
        for k in range(cells.shape[1]):
            cell = cells[leaf - cells.shape[0], k]
            if cell < 0:
                continue
            for tet in range(first_tet[cell], first_tet[cell + 1]):
                origin, c1, c2, c3, volume = frame(flow, int(tet))
                w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
                if volume == 0.0:
                    continue
                smallest = min(w0 / volume, w1 / volume, w2 / volume, w3 / volume)
                if smallest > depth and (flow.folds[cell] == SOUND or is_there(flow, tet, x, way)):
                    best, depth = tet, smallest
        leaf = next_leaf(flow, leaf, x)
    return best
