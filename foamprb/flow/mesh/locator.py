"""The cell-locating tree, and the arrays that every compiled function of a mesh flow reads."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.tensor import Vector
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.mesh import Mesh

__all__ = ["TOLERANCE", "MeshArrays", "build_tree", "cell_boxes", "frame", "locate", "weights"]

_LEAF = 8

TOLERANCE = 1e-9
"""How far outside a tetrahedron a point may lie and still belong to it, in units of the barycentric weights.

Coordinates have been float32 once, so that no cell is thinner than some 1e-7 of its distance from the origin;
the round-off of a weight in double precision is then below 1e-9.
"""


class MeshArrays(NamedTuple):
    """What the kernels read of a flow on a mesh; SI units, indices int32."""

    nodes: Floats
    """(n_nodes, 16): x y z, u v w, the nine ∂u_i/∂x_j row by row, one spare: two cache lines a node."""
    n_points: int
    """Number of mesh points: the centre of cell c is node ``n_points + c``."""
    tets: Ints
    """(n_tets, 4) nodes, the first the cell centre."""
    neighbours: Ints
    """(n_tets, 4): the tetrahedron across the face opposite each vertex; −1 − b for boundary triangle b."""
    cell_start: Ints
    """(n_cells + 1,) first tetrahedron of each cell."""
    tree_boxes: Floats
    """(2 n_leaves, 6): lower and upper corners; node i has children 2i and 2i + 1, the root is 1."""
    tree_cells: Ints
    """(n_leaves, leaf size) cells, −1 where there is none."""
    triangles: Ints
    """(n_triangles, 3) nodes of the boundary triangles, then of images of walls beyond coupled patches."""
    triangle_patch: Ints
    """(n_triangles,) patch of each."""
    triangle_normals: Floats
    """(n_triangles, 3) unit normals, inward."""
    triangle_tet: Ints
    """(n_boundary_triangles,) the tetrahedron inside."""
    across: Ints
    """(n_boundary_triangles, 2): where a patch is coupled, first and last + 1 of ``partners`` across."""
    partners: Ints
    """Boundary triangles across coupled patches."""
    motions: Floats
    """(n_patches, 12): rotation row by row and shift from each coupled patch to its neighbour."""
    near_start: Ints
    """(n_cells + 1,) into ``near``."""
    near: Ints
    """The wall triangles that a particle with its centre in the cell might touch."""


def no_mesh() -> MeshArrays:
    """The arrays of a mesh without cells, for which the kernels can be compiled."""
    none = np.empty(0, dtype=np.int32)

    def floats(k: int) -> Floats:
        return np.empty((0, k))

    def ints(k: int) -> Ints:
        return np.empty((0, k), dtype=np.int32)

    return MeshArrays(
        nodes=floats(16),
        n_points=0,
        tets=ints(4),
        neighbours=ints(4),
        cell_start=none,
        tree_boxes=floats(6),
        tree_cells=ints(1),
        triangles=ints(3),
        triangle_patch=none,
        triangle_normals=floats(3),
        triangle_tet=none,
        across=ints(2),
        partners=none,
        motions=floats(12),
        near_start=none,
        near=none,
    )


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


def frame(flow: MeshArrays, tet: int) -> tuple[Vector, Vector, Vector, Vector, float]:
    """Origin, the three cofactor vectors and six times the signed volume of a tetrahedron.

    With r = x − origin, the barycentric weights of vertices 1, 2, 3 at x are r·c_k over that volume.
    """
    nodes, tets = flow.nodes, flow.tets
    a, b, c, d = tets[tet, 0], tets[tet, 1], tets[tet, 2], tets[tet, 3]
    ox, oy, oz = nodes[a, 0], nodes[a, 1], nodes[a, 2]
    px, py, pz = nodes[b, 0] - ox, nodes[b, 1] - oy, nodes[b, 2] - oz
    qx, qy, qz = nodes[c, 0] - ox, nodes[c, 1] - oy, nodes[c, 2] - oz
    rx, ry, rz = nodes[d, 0] - ox, nodes[d, 1] - oy, nodes[d, 2] - oz
    c1 = (qy * rz - qz * ry, qz * rx - qx * rz, qx * ry - qy * rx)
    c2 = (ry * pz - rz * py, rz * px - rx * pz, rx * py - ry * px)
    c3 = (py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx)
    return (ox, oy, oz), c1, c2, c3, px * c1[0] + py * c1[1] + pz * c1[2]


def weights(
    origin: Vector, c1: Vector, c2: Vector, c3: Vector, volume: float, x: Vector
) -> tuple[float, float, float, float]:
    """Barycentric weights at x times ``volume``, from what :func:`frame` gives."""
    rx, ry, rz = x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]
    w1 = rx * c1[0] + ry * c1[1] + rz * c1[2]
    w2 = rx * c2[0] + ry * c2[1] + rz * c2[2]
    w3 = rx * c3[0] + ry * c3[1] + rz * c3[2]
    return volume - w1 - w2 - w3, w1, w2, w3


def locate(flow: MeshArrays, x: Vector) -> int:
    """Find the tetrahedron that holds x, or −1 when x lies outside the mesh.

    Of several (x on a shared face) it is the one whose smallest barycentric weight is largest, then the first
    in the order of the tree.
    """
    boxes, cells, first_tet = flow.tree_boxes, flow.tree_cells, flow.cell_start
    leaves = cells.shape[0]
    best, depth = -1, -TOLERANCE
    node = 1
    while node > 0:
        inside = (
            boxes[node, 0] <= x[0] <= boxes[node, 3]
            and boxes[node, 1] <= x[1] <= boxes[node, 4]
            and boxes[node, 2] <= x[2] <= boxes[node, 5]
        )
        if inside and node < leaves:
            node = 2 * node
            continue
        if inside:
            for k in range(cells.shape[1]):
                cell = cells[node - leaves, k]
                if cell < 0:
                    continue
                for tet in range(first_tet[cell], first_tet[cell + 1]):
                    origin, c1, c2, c3, volume = frame(flow, int(tet))
                    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
                    if volume == 0.0:
                        continue
                    smallest = min(w0 / volume, w1 / volume, w2 / volume, w3 / volume)
                    if smallest > depth:
                        best, depth = tet, smallest
        # To the right sibling of the nearest ancestor (itself included) that is a left child.
        while node & 1:
            node >>= 1
        if node > 0:
            node += 1
    return best
