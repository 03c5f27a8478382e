"""Arrays of a flow on a mesh that the kernels read, and the geometry of a tetrahedron."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector
from foamprb.compile.record import record
from foamprb.flow.base import Floats, Ints

TOLERANCE = 1e-9
"""Tolerance of barycentric weights: a point in a tetrahedron may have weights down to minus this.

Weights follow from differences of coordinates: their round-off is about 1e-16 × distance from the origin.
"""

FREE, VELOCITY, GRADIENT = 3, 4, 7
"""First columns of the nodes after the place; of :data:`FREE` see :func:`foamprb.flow.fluxes.free_nodes`."""


@record
class MeshArrays(NamedTuple):
    """Arrays of a flow on a mesh that the kernels read; SI units, indices int32."""

    nodes: Floats
    """(n_nodes, 16): x y z, :func:`~foamprb.flow.fluxes.free_nodes`, u v w, and the nine ∂u_i/∂x_j row by
    row: two cache lines a node. (n_nodes, 4) if u and ∇u are in another table."""
    n_points: int
    """Number of mesh points; the centre of cell c is node ``n_points + c``."""
    tets: Ints
    """(n_tets, 4) nodes; the first is the cell centre."""
    neighbours: Ints
    """(n_tets, 4): the tetrahedron across the face opposite each vertex; −1 − b for boundary triangle b."""
    cell_start: Ints
    """(n_cells + 1,) first tetrahedron of each cell."""
    tree_boxes: Floats
    """(2 n_leaves, 6): lower and upper corners; node i has children 2i and 2i + 1, the root is 1."""
    tree_cells: Ints
    """(n_leaves, leaf size) cells, −1 for none."""
    triangles: Ints
    """(n_triangles, 3) nodes of the boundary triangles, then of images of walls beyond coupled patches."""
    triangle_patch: Ints
    """(n_triangles,) patch of each."""
    triangle_normals: Floats
    """(n_triangles, 3) unit normals, inward."""
    triangle_tet: Ints
    """(n_boundary_triangles,) the tetrahedron inside."""
    across: Ints
    """(n_boundary_triangles, 2): on coupled patches, first and last + 1 of the ``partners`` across."""
    partners: Ints
    """Boundary triangles across coupled patches."""
    motions: Floats
    """(n_patches, 12): rotation row by row and shift from each coupled patch to its neighbour."""
    folds: NDArray[np.uint8]
    """(n_cells,): ``SOUND``, ``FLAT`` or ``FOLDED``; see :mod:`foamprb.flow.mesh.folds`."""
    rim_start: Ints
    """(n_cells + 1,) into ``rim``."""
    rim: Ints
    """Boundary triangles whose boxes meet the box of a folded cell, cell by cell."""
    near_start: Ints
    """(n_cells + 1,) into ``near``."""
    near: Ints
    """Wall triangles that a particle with its centre in the cell might touch: first one of each plane, then
    −1 − the others in these planes. If they are many, only −1 − one triangle, from which the tree is
    searched."""
    wall_boxes: Floats
    """Boxes of a tree over all wall triangles that a particle might touch; see ``tree_boxes``."""
    wall_leaves: Ints
    """(n_leaves, leaf size) wall triangles, −1 for none."""
    seen_start: Ints
    """(n_cells + 1,) into ``seen``."""
    seen: Ints
    """Triangles that may be walls of :mod:`foamprb.flow.planes` for points in the cell, each as
    2 × triangle, + 1 if an edge of it may be the nearest wall."""
    turbulence: Floats
    """(n_nodes, 8): k, ε, ∇k and ∇(k²/3ε); no rows if they were not read."""
    viscosity: Floats
    """(n_nodes, 4): a field of the viscosity and its gradient; no rows if it was not read."""
    curvatures: NDArray[np.float32]
    """(n_nodes, 18), 1/(m s): second derivatives of the velocity, a vector for each of xx, yy, zz, xy, yz and
    xz; no rows if they were not reconstructed."""
    correction: NDArray[np.float32]
    """(n_tets, 4), 1/s, of the velocity between the nodes (:mod:`foamprb.flow.fluxes`): the additional flux
    through the side opposite each vertex over the volume and the number of the side's nodes that lie on no
    wall; see :mod:`foamprb.flow.correction`. No rows for no correction."""
    phi: Floats
    """(n_faces,) fluxes out of the owners of the faces that keep volume, m³/s, from which the correction
    follows; NaN for no correction."""
    owner: Ints
    """(n_faces,)."""
    face_start: Ints
    """(n_faces + 1,): face f has ``face_start[f + 1]`` − ``face_start[f]`` points."""
    cell_face_start: Ints
    """(n_cells + 1,) into ``cell_faces``."""
    cell_faces: Ints
    """Faces of each cell, in the order of its tetrahedra."""
    layer: Floats
    """(3,) unit normal of the planes of a two-dimensional flow (:mod:`foamprb.flow.mesh.layer`); (13,) that
    of the middle plane of a wedge and :attr:`~foamprb.flow.mesh.layer.Layer.axis`; or (0,)."""


_FLOATS = {
    "nodes": 16, "turbulence": 8, "viscosity": 4, "motions": 12, "tree_boxes": 6, "wall_boxes": 6,
    "triangle_normals": 3,
}  # fmt: skip
_TABLES = {"tets": 4, "neighbours": 4, "triangles": 3, "across": 2, "tree_cells": 1, "wall_leaves": 1}


def no_mesh() -> MeshArrays:
    """Return the arrays of a mesh without cells, for which the kernels can be compiled."""
    empty: dict[str, Any] = {name: np.empty(0, dtype=np.int32) for name in MeshArrays._fields}
    empty |= {name: np.empty((0, columns)) for name, columns in _FLOATS.items()}
    empty |= {name: np.empty((0, columns), dtype=np.int32) for name, columns in _TABLES.items()}
    empty |= {"folds": np.empty(0, dtype=np.uint8), "correction": np.empty((0, 4), dtype=np.float32)}
    empty |= {"curvatures": np.empty((0, 18), dtype=np.float32)}
    empty |= {"phi": np.empty(0), "layer": np.empty(0)}
    return MeshArrays(**empty | {"n_points": 0})


def point(table: Floats, i: int) -> Vector:
    """Return the point in row i of a table, (n, 3) or more columns."""
    return table[i, 0], table[i, 1], table[i, 2]


def arm(table: Floats, i: int, x: Vector) -> Vector:
    """Return the vector from x to the point in row i of a table."""
    return table[i, 0] - x[0], table[i, 1] - x[1], table[i, 2] - x[2]


def nodes_of(flow: MeshArrays, tet: int) -> tuple[Any, Any, Any, Any]:
    """Return the rows of the nodes of a tetrahedron; unsigned, which avoids a check for negative indices."""
    tets, row = flow.tets, np.uint64(tet)
    return np.uint32(tets[row, 0]), np.uint32(tets[row, 1]), np.uint32(tets[row, 2]), np.uint32(tets[row, 3])


def frame(flow: MeshArrays, tet: int) -> tuple[Vector, Vector, Vector, Vector, float]:
    """Return origin, three cofactor vectors and six times the signed volume of a tetrahedron.

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
    """Return the barycentric weights at x times ``volume``, from the results of :func:`frame`."""
    rx, ry, rz = x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]
    w1 = rx * c1[0] + ry * c1[1] + rz * c1[2]
    w2 = rx * c2[0] + ry * c2[1] + rz * c2[2]
    w3 = rx * c3[0] + ry * c3[1] + rz * c3[2]
    return volume - w1 - w2 - w3, w1, w2, w3


def bends(f: float, g: float) -> float:
    """Return 1 if the velocity is quadratic along an edge, else 0, from its ends' values of :data:`FREE`.

    One end must lie off the walls, the other one off them or among simple cells.
    """
    return abs(f * g) if f + g >= 0.0 else 0.0
