"""The arrays that every compiled function of a mesh flow reads, and the geometry of one tetrahedron."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector
from foamprb.flow.base import Floats, Ints

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
    folds: NDArray[np.uint8]
    """(n_cells,): which cells are ``SOUND``, ``FLAT`` or ``FOLDED``; see :mod:`foamprb.flow.mesh.folds`."""
    rim_start: Ints
    """(n_cells + 1,) into ``rim``."""
    rim: Ints
    """The boundary triangles whose boxes meet that of a folded cell, cell by cell."""
    near_start: Ints
    """(n_cells + 1,) into ``near``."""
    near: Ints
    """The wall triangles that a particle with its centre in the cell might touch: one of each plane first,
    then −1 − those of which the plane is there already; or, if they are many, −1 − one of them alone, from
    which the tree is searched."""
    wall_boxes: Floats
    """As ``tree_boxes``, of a tree over all wall triangles that a particle might touch."""
    wall_leaves: Ints
    """(n_leaves, leaf size) wall triangles, −1 where there is none."""
    seen_start: Ints
    """(n_cells + 1,) into ``seen``."""
    seen: Ints
    """The triangles that may be walls in the sense of :mod:`foamprb.flow.planes` for places in the cell, each
    as 2 × triangle + 1 if an edge of it may be the nearest wall, else + 0."""
    turbulence: Floats
    """(n_nodes, 8): k, ε, ∇k and ∇(k²/3ε); without rows if nobody asked for them."""


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
        folds=np.empty(0, dtype=np.uint8),
        rim_start=none,
        rim=none,
        near_start=none,
        near=none,
        turbulence=floats(8),
        wall_boxes=floats(6),
        wall_leaves=ints(1),
        seen_start=none,
        seen=none,
    )


def point(table: Floats, i: int) -> Vector:
    """Return the point in row i of a table, (n, 3) or more columns."""
    return table[i, 0], table[i, 1], table[i, 2]


def arm(table: Floats, i: int, x: Vector) -> Vector:
    """Return the vector from x to the point in row i of a table."""
    return table[i, 0] - x[0], table[i, 1] - x[1], table[i, 2] - x[2]


def nodes_of(flow: MeshArrays, tet: int) -> tuple[Any, Any, Any, Any]:
    """Rows of the nodes of a tetrahedron; unsigned, so that none is asked whether it counts from the end."""
    tets, row = flow.tets, np.uint64(tet)
    return np.uint32(tets[row, 0]), np.uint32(tets[row, 1]), np.uint32(tets[row, 2]), np.uint32(tets[row, 3])


def frame(flow: MeshArrays, tet: int) -> tuple[Vector, Vector, Vector, Vector, float]:
    """Origin, the three cofactor vectors and six times the signed volume of a tetrahedron.

    With r = x − origin, the barycentric weights of vertices 1, 2, 3 at x are r·c_k over that volume.
    """
    nodes = flow.nodes
    a, b, c, d = nodes_of(flow, tet)
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
