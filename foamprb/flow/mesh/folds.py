"""Robust paths through cells that are flat, or folded: not star-shaped about their centre.

Every tetrahedron has an orientation by the order of its nodes. A straight line that meets no edge of any
tetrahedron enters each tetrahedron through one face and leaves it through another: forwards in tetrahedra of
positive volume, backwards in inverted ones. So its path through the mesh is one thread, along which the
distance t is continuous, and which ends only at the boundary. The tetrahedra cover every point of the mesh
once more forwards than backwards, and every point outside equally often: a thread that passes t = 1 forwards
for the last time has reached the point there; a thread that ends before has left the mesh. A thread could
leave the mesh in a fold and enter it again across a gap; so in folded cells the line is also intersected with
the triangles of the boundary.

The side on which a line passes an edge is computed from the projected points, in the same way for all
tetrahedra at the edge; ties are broken as if the line and the points were moved by infinitesimal amounts
[1, 2]. So the line passes every tetrahedron, even one of coincident points.

References
----------
.. [1] S. Woop, C. Benthin, I. Wald, *Watertight ray/triangle intersection*, J. Comput. Graph. Tech. 2 (2013).
.. [2] H. Edelsbrunner, E. P. Mücke, *Simulation of simplicity*, ACM Trans. Graph. 9 (1990).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus, norm, plus, vector_product
from foamprb.compile.link import separate
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import TOLERANCE, MeshArrays, arm, frame, point, weights
from foamprb.flow.mesh.tree import holds_point, next_node

SOUND, FLAT, FOLDED = 0, 1, 2
"""Cells where :func:`foamprb.flow.walk.follow` is exact; cells with a flat tetrahedron; cells whose box meets
the box of an inverted tetrahedron, where points may be covered more than once, or lie outside."""

# Volumes over the product of the three edges from the first node. Below _THIN the round-off of the weights
# exceeds TOLERANCE; below _FLAT interpolation is impossible.
_THIN = 1e-7
_FLAT = 1e-11

_PULLS = 5
# Largest shift of a line, in units of the round-off.
_HEALED = 1e3
# Tolerance for points in a plane, in the same units.
_FLUSH = 1e-4
# More negative weights are not round-off.
_ASTRAY = 1e-6
_MOST_CROSSINGS = 1_000_000
_REACHED, _FAILED, _NONE = -1, -2, -1


def grade(nodes: Floats, tets: Ints, n_points: int, folds: NDArray[np.uint8], boxes: Floats) -> int:
    """Mark cells with flat tetrahedra as ``FLAT``, and find the boxes of the inverted tetrahedra.

    Parameters
    ----------
    nodes, tets, n_points
        See :class:`foamprb.flow.mesh.arrays.MeshArrays`.
    folds
        (n_cells,) marks.
    boxes
        (n, 6) result: the first n boxes, lower and upper corner, m.

    Returns
    -------
    The number of inverted tetrahedra.
    """
    found = 0
    for tet in range(tets.shape[0]):
        volume, size = _volume(nodes, tets, tet)
        if volume > _THIN * size:
            continue
        folds[tets[tet, 0] - n_points] = FLAT
        if volume >= -_FLAT * size:
            continue
        if found < boxes.shape[0]:
            for i in range(3):
                low = high = nodes[tets[tet, 0], i]
                for k in range(1, 4):
                    x = nodes[tets[tet, k], i]
                    low, high = min(low, x), max(high, x)
                boxes[found, i], boxes[found, i + 3] = low, high
        found += 1
    return found


def _volume(nodes: Floats, tets: Ints, tet: int) -> tuple[float, float]:
    """Return six times the volume of a tetrahedron, and the product of its edges from the first node."""
    o = point(nodes, tets[tet, 0])
    p, q, r = arm(nodes, tets[tet, 1], o), arm(nodes, tets[tet, 2], o), arm(nodes, tets[tet, 3], o)
    return inner(p, vector_product(q, r)), norm(p) * norm(q) * norm(r)


def is_flat(flow: MeshArrays, tet: int) -> bool:
    """Return True if a tetrahedron is too flat for interpolation."""
    volume, size = _volume(flow.nodes, flow.tets, tet)
    return not abs(volume) > _FLAT * size


def settle(flow: MeshArrays, tet: int, x: Vector) -> int:
    """Return the tetrahedron or, if it is flat, the one nearby with the largest smallest weight at x."""
    return nearby(flow, tet, x) if is_flat(flow, tet) else tet


def _arrived(flow: MeshArrays, tet: int, x: Vector) -> int:
    """Return the host of x where a thread passes it; see :func:`settle`.

    A line in the plane of a face meets it at an arbitrary point, so that a thread may pass x one face too
    early, in a tetrahedron that does not hold x.
    """
    host = settle(flow, tet, x)
    return host if _depth(flow, host, x) >= -_ASTRAY else nearby(flow, host, x)


@separate
def nearby(flow: MeshArrays, tet: int, x: Vector) -> int:
    """Return the tetrahedron with the largest smallest weight at x, without flat ones.

    The search covers the cell, its neighbours and their neighbours, and then, behind a stack of flat cells,
    the tree.
    """
    cell, start, neighbours = _cell(flow, tet), flow.cell_start, flow.neighbours
    best, depth = _deepest(flow, cell, x, tet, -np.inf)
    for own in range(start[cell], start[cell + 1]):
        if depth < -TOLERANCE and neighbours[own, 0] >= 0:
            best, depth = _deepest(flow, _cell(flow, neighbours[own, 0]), x, best, depth)
    for own in range(start[cell], start[cell + 1]):
        if depth < -TOLERANCE and neighbours[own, 0] >= 0:
            beside = _cell(flow, neighbours[own, 0])
            for other in range(start[beside], start[beside + 1]):
                if neighbours[other, 0] >= 0:
                    best, depth = _deepest(flow, _cell(flow, neighbours[other, 0]), x, best, depth)
    if depth < -TOLERANCE:
        best = _deepest_of_all(flow, x, best, depth)
    return best


def _deepest_of_all(flow: MeshArrays, x: Vector, best: int, depth: float) -> int:
    """Return the tetrahedron of :func:`_deepest` of all cells that may hold x."""
    cells = flow.tree_cells
    node, n_leaves = 1, cells.shape[0]
    while node > 0:
        hit = holds_point(flow.tree_boxes, node, x)
        for k in range(cells.shape[1] if hit and node >= n_leaves else 0):
            cell = cells[node - n_leaves, k]
            if cell >= 0:
                best, depth = _deepest(flow, cell, x, best, depth)
        node = next_node(node, n_leaves, hit)
    return best


def _cell(flow: MeshArrays, tet: int) -> int:
    """Return the cell of a tetrahedron."""
    return flow.tets[tet, 0] - flow.n_points  # type: ignore[no-any-return]


def _deepest(flow: MeshArrays, cell: int, x: Vector, best: int, depth: float) -> tuple[int, float]:
    """Return the tetrahedron of a cell with the largest smallest weight at x, if above ``depth``, and it."""
    for tet in range(flow.cell_start[cell], flow.cell_start[cell + 1]):
        smallest = _depth(flow, tet, x)
        if smallest > depth or (smallest == depth and tet < best):
            best, depth = tet, smallest
    return best, depth


def _depth(flow: MeshArrays, tet: int, x: Vector) -> float:
    """Return the smallest weight of a tetrahedron at x, −∞ if it is flat or inverted."""
    volume, size = _volume(flow.nodes, flow.tets, tet)
    if not volume > _FLAT * size:
        return -np.inf
    origin, c1, c2, c3, volume = frame(flow, tet)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    return min(w0, w1, w2, w3) / volume


@separate
def is_in_mesh(flow: MeshArrays, tet: int, x: Vector, way: Vector) -> bool:
    """Return True if x in a tetrahedron is a point of the mesh from which a walk can go that way."""
    if is_flat(flow, tet):
        return False
    return trace(flow, tet, x, plus(x, way))[2] != _FAILED


@separate
def trace(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Follow the thread of the line from x0, in the tetrahedron ``host``, to x1, in any mesh.

    If the thread is lost, as from a point on a face, the line is shifted into the host by 1e-12 of its size,
    then by more.

    Returns
    -------
    See :func:`foamprb.flow.walk.walk`; the hosts are not flat. The walk fails if the thread shows that x0 is
    outside the mesh, or does not lead away from x0.
    """
    d = minus(x1, x0)
    first = settle(flow, host, x0)
    longest = max(abs(d[0]), abs(d[1]), abs(d[2]))
    if not longest > 0.0:
        return first, 1.0, _REACHED, _NONE
    k = 0 if abs(d[0]) == longest else 1 if abs(d[1]) == longest else 2
    # Round-off of a distance from x0, in units of t.
    room = TOLERANCE * np.sqrt(_squared_edge(flow, first)) / longest
    # Round-off of the distance from a plane, m.
    flush = _FLUSH * room * longest
    for attempt in range(_PULLS):
        origin = _pulled(flow, first, x0, 0.0 if attempt == 0 else 1e-14 * 100.0**attempt)
        tet, candidate, cell = first, _NONE, _NONE
        leaving, entering, rim = np.inf, np.inf, _NONE
        for _ in range(_MOST_CROSSINGS):
            face, t = _way_out(flow, tet, origin, d, k, x0)
            if face < 0:
                break
            folded = flow.folds[_cell(flow, tet)] == FOLDED
            if folded and _cell(flow, tet) != cell:
                cell = _cell(flow, tet)
                for r in range(flow.rim_start[cell], flow.rim_start[cell + 1]):
                    way, s = _crossing(flow, flow.rim[r], origin, d, k, x0)
                    if way > 0 and -room < s < leaving:
                        leaving, rim = s, flow.rim[r]
                    elif way < 0 and room < s < entering and height(flow, flow.rim[r], x0) > flush:
                        entering = s
            if t >= entering and entering < min(leaving, 1.0):
                return host, 0.0, _FAILED, _NONE
            if t >= leaving and leaving < 1.0:
                return _left_by(flow, rim, x0, d, leaving, room)
            if t <= 1.0:
                candidate = _NONE
            elif candidate < 0:
                candidate = tet
            # A point that is covered once is final, and so is every point before the boundary.
            if candidate >= 0 and (not folded or t >= leaving):
                return _arrived(flow, candidate, x1), 1.0, _REACHED, _NONE
            other = flow.neighbours[tet, face]
            if other < 0:
                if t >= 1.0 - 1e-12:
                    return _arrived(flow, tet if candidate < 0 else candidate, x1), 1.0, _REACHED, _NONE
                if t < -room and height(flow, -1 - other, x0) > flush:
                    return host, 0.0, _FAILED, _NONE
                return _left_by(flow, -1 - other, x0, d, t, room)
            tet = other
            if tet == first:
                return host, 0.0, _FAILED, _NONE
    return host, 0.0, _FAILED, _NONE


def _left_by(
    flow: MeshArrays, triangle: int, x0: Vector, d: Vector, t: float, room: float
) -> tuple[int, float, int, int]:
    """Return the result of a walk that leaves the mesh near t through a triangle of the boundary."""
    # The line may have been shifted to find t: intersect the original with the triangle's plane.
    n = point(flow.triangle_normals, triangle)
    slope = inner(n, d)
    exact = inner(n, arm(flow.nodes, flow.triangles[triangle, 0], x0)) / slope if slope != 0.0 else t
    if abs(exact - t) < _HEALED * room:
        t = exact
    t = min(max(t, 0.0), 1.0)
    host = settle(flow, flow.triangle_tet[triangle], (x0[0] + t * d[0], x0[1] + t * d[1], x0[2] + t * d[2]))
    return host, t, flow.triangle_patch[triangle], triangle


def height(flow: MeshArrays, triangle: int, x: Vector) -> float:
    """Return the distance of a point from the plane of a triangle of the boundary, m."""
    d = arm(flow.nodes, flow.triangles[triangle, 0], x)
    return float(abs(inner(point(flow.triangle_normals, triangle), d)))


def _crossing(
    flow: MeshArrays, triangle: int, origin: Vector, d: Vector, k: int, x0: Vector
) -> tuple[int, float]:
    """Return 1 if the line leaves the mesh through a boundary triangle, −1 if it enters, else 0; and t."""
    na, nb, nc = flow.triangles[triangle, 0], flow.triangles[triangle, 1], flow.triangles[triangle, 2]
    a, ta = _picture(flow.nodes, na, origin, d, k, x0)
    b, tb = _picture(flow.nodes, nb, origin, d, k, x0)
    c, tc = _picture(flow.nodes, nc, origin, d, k, x0)
    ab, bc, ac = _left(a, b, na < nb), _left(b, c, nb < nc), _left(a, c, na < nc)
    if ab and bc and not ac:
        return 1, _meeting(a, b, c, ta, tb, tc)
    if ac and not ab and not bc:
        return -1, _meeting(a, c, b, ta, tc, tb)
    return 0, 0.0


def _squared_edge(flow: MeshArrays, tet: int) -> float:
    """Return the longest edge from the first node of a tetrahedron, squared, m²."""
    nodes, tets = flow.nodes, flow.tets
    o, longest = point(nodes, tets[tet, 0]), 0.0
    for k in range(1, 4):
        edge = arm(nodes, tets[tet, k], o)
        longest = max(longest, inner(edge, edge))
    return longest


def _pulled(flow: MeshArrays, tet: int, x: Vector, least: float) -> Vector:
    """Return the point near x where no weight of a tetrahedron is below ``least``.

    Products that round to a tie can lose a thread anywhere; so points inside are shifted too, unless
    ``least`` is 0.
    """
    origin, c1, c2, c3, volume = frame(flow, tet)
    if volume == 0.0:
        return x
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    s = 1.0 / volume
    w0, w1, w2, w3 = s * w0, s * w1, s * w2, s * w3
    if least == 0.0 and min(w0, w1, w2, w3) >= 0.0:
        return x
    w0, w1, w2, w3 = max(w0, least), max(w1, least) + least, max(w2, least) + 2.0 * least, max(w3, least)
    s = 1.0 / (w0 + w1 + w2 + w3)
    w0, w1, w2, w3 = s * w0, s * w1, s * w2, s * w3
    n, tets = flow.nodes, flow.tets
    a, b, c, d = tets[tet, 0], tets[tet, 1], tets[tet, 2], tets[tet, 3]
    return (
        w0 * n[a, 0] + w1 * n[b, 0] + w2 * n[c, 0] + w3 * n[d, 0],
        w0 * n[a, 1] + w1 * n[b, 1] + w2 * n[c, 1] + w3 * n[d, 1],
        w0 * n[a, 2] + w1 * n[b, 2] + w2 * n[c, 2] + w3 * n[d, 2],
    )


def _way_out(flow: MeshArrays, tet: int, origin: Vector, d: Vector, k: int, x0: Vector) -> tuple[int, float]:
    """Return the face where the line through ``origin`` along d leaves a tetrahedron, or −1, and t there.

    ``k`` is the longest component of d; t is 0 at x0 and 1 at x0 + d.
    """
    tets = flow.tets
    na, nb, nc, nd = tets[tet, 0], tets[tet, 1], tets[tet, 2], tets[tet, 3]
    a, ta = _picture(flow.nodes, na, origin, d, k, x0)
    b, tb = _picture(flow.nodes, nb, origin, d, k, x0)
    c, tc = _picture(flow.nodes, nc, origin, d, k, x0)
    e, te = _picture(flow.nodes, nd, origin, d, k, x0)
    ab, ac, ae = _left(a, b, na < nb), _left(a, c, na < nc), _left(a, e, na < nd)
    bc, be, ce = _left(b, c, nb < nc), _left(b, e, nb < nd), _left(c, e, nc < nd)
    if bc and ce and not be:
        return 0, _meeting(b, c, e, tb, tc, te)
    if ae and not ce and not ac:
        return 1, _meeting(a, e, c, ta, te, tc)
    if ab and be and not ae:
        return 2, _meeting(a, b, e, ta, tb, te)
    if ac and not bc and not ab:
        return 3, _meeting(a, c, b, ta, tc, tb)
    return -1, 0.0


def _picture(
    nodes: Floats, node: int, origin: Vector, d: Vector, k: int, x0: Vector
) -> tuple[tuple[float, float], float]:
    """Return the projection of a node along d about the origin, and its t.

    Space is sheared so that d becomes axis k. A face through which the line leaves turns anticlockwise.
    """
    i, j = (k + 1) % 3, (k + 2) % 3
    along = (nodes[node, k] - origin[k]) / d[k]
    u = nodes[node, i] - origin[i] - along * d[i]
    v = nodes[node, j] - origin[j] - along * d[j]
    t = (nodes[node, k] - x0[k]) / d[k]
    if d[k] < 0.0:
        return (v, u), t
    return (u, v), t


def _left(p: tuple[float, float], q: tuple[float, float], rising: bool) -> bool:
    """Return True if the origin lies to the left of the edge from p to q, whose indices rise if ``rising``.

    Products are compared, not subtracted, because rounding never reverses an order. Ties: the origin is moved
    by (ε, ε²), and coincident points by less, in the order of their indices.
    """
    here, there = p[0] * q[1], q[0] * p[1]
    if here != there:
        return here > there
    if p[1] != q[1]:
        return p[1] > q[1]
    if p[0] != q[0]:
        return q[0] > p[0]
    return rising == (p[0] > 0.0)


def _meeting(
    p: tuple[float, float],
    q: tuple[float, float],
    r: tuple[float, float],
    tp: float,
    tq: float,
    tr: float,
) -> float:
    """Return the t at which the line meets a triangle that it is known to meet."""
    wp, wq, wr = q[0] * r[1] - r[0] * q[1], r[0] * p[1] - p[0] * r[1], p[0] * q[1] - q[0] * p[1]
    wp, wq, wr = max(wp, 0.0), max(wq, 0.0), max(wr, 0.0)
    total = wp + wq + wr
    low, high = min(tp, tq, tr), max(tp, tq, tr)
    # A triangle parallel to the line is met at its middle.
    t = (wp * tp + wq * tq + wr * tr) / total if total > 0.0 else 0.5 * (low + high)
    return min(max(t, low), high)
