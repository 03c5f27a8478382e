"""Cells that their centre does not see whole, or that are flat: paths through them that cannot be lost.

Every tetrahedron has a sense of its own, that in which its nodes are numbered. A straight line that meets no
edge of any tetrahedron enters each that it meets through one face and leaves it through another, by this
sense: forwards in tetrahedra of positive volume, backwards in those that are turned inside out. So its way
through the mesh is one thread, along which the distance t is continuous, and which ends only at the
boundary. The tetrahedra cover every place of the mesh once more forwards than backwards, every place outside
equally often: a thread that passes t = 1 for the last time forwards has reached the point there; one that
ends before has left the mesh. A thread could leave the mesh in a fold and come in again on the other side of
a gap; so in folded cells the line is cut with the triangles of the boundary as well.

Whether a line passes an edge on its left or on its right is decided for the line's picture of the points,
and in the same way wherever the edge comes up; ties are decided as if the line and the points were moved by
infinitesimal amounts [1, 2]. No tetrahedron can then be too flat to be passed, not even one of coincident
points.

References
----------
.. [1] S. Woop, C. Benthin, I. Wald, *Watertight ray/triangle intersection*, J. Comput. Graph. Tech. 2 (2013).
.. [2] H. Edelsbrunner, E. P. Mücke, *Simulation of simplicity*, ACM Trans. Graph. 9 (1990).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus, norm, plus, vector_product
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import TOLERANCE, MeshArrays, arm, frame, point, weights
from foamprb.flow.mesh.tree import holds_point, next_node

__all__ = ["FLAT", "FOLDED", "SOUND", "grade", "is_there", "nearby", "settle", "trace"]

SOUND, FLAT, FOLDED = 0, 1, 2
"""A cell where :func:`foamprb.flow.walk.follow` is exact; one with a flat tetrahedron; one whose box meets
that of a tetrahedron turned inside out: places in it may be covered more than once, or lie outside."""

# Volumes, in units of the product of the three edges from the first node. In flatter tetrahedra the round-off
# of the weights is beyond TOLERANCE; in still flatter ones nothing can be interpolated, and no fold matters.
_THIN = 1e-7
_FLAT = 1e-11

_PULLS = 5
# How far a line may have been shifted, in units of what counts as round-off.
_HEALED = 1e3
# How near to a plane a place is in it, in the same units.
_FLUSH = 1e-4
# Smaller weights than this, negative, are no round-off.
_ASTRAY = 1e-6
_MOST_CROSSINGS = 1_000_000
_REACHED, _FAILED, _NONE = -1, -2, -1


def grade(nodes: Floats, tets: Ints, n_points: int, folds: NDArray[np.uint8], boxes: Floats) -> int:
    """Mark cells with flat tetrahedra as ``FLAT``, and find the boxes of the tetrahedra turned inside out.

    Parameters
    ----------
    nodes, tets, n_points
        As in :class:`foamprb.flow.mesh.arrays.MeshArrays`.
    folds
        (n_cells,), for the marks.
    boxes
        (n, 6), for the first n boxes, lower and upper corner, m.

    Returns
    -------
    The number of tetrahedra turned inside out.
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
    """Six times a tetrahedron's volume, and the product of the lengths of its edges from the first node."""
    o = point(nodes, tets[tet, 0])
    p, q, r = arm(nodes, tets[tet, 1], o), arm(nodes, tets[tet, 2], o), arm(nodes, tets[tet, 3], o)
    return inner(p, vector_product(q, r)), norm(p) * norm(q) * norm(r)


def is_flat(flow: MeshArrays, tet: int) -> bool:
    """Whether nothing can be interpolated in a tetrahedron."""
    volume, size = _volume(flow.nodes, flow.tets, tet)
    return not abs(volume) > _FLAT * size


def settle(flow: MeshArrays, tet: int, x: Vector) -> int:
    """The tetrahedron itself or, if it is flat, the one nearby that comes nearest to holding x.

    A place in a flat tetrahedron is as near to one beside it as that is thin.
    """
    return nearby(flow, tet, x) if is_flat(flow, tet) else tet


def _arrived(flow: MeshArrays, tet: int, x: Vector) -> int:
    """As :func:`settle`, of where a thread passes x.

    A line in the plane of a face meets it somewhere in it, so that the thread may seem to pass x a face too
    early; then the tetrahedron does not hold it.
    """
    host = settle(flow, tet, x)
    return host if _depth(flow, host, x) >= -_ASTRAY else nearby(flow, host, x)


def nearby(flow: MeshArrays, tet: int, x: Vector) -> int:
    """The tetrahedron that comes nearest to holding x, flat ones excepted.

    It is sought in the cell, in those that share faces with it, and in those that share faces with these;
    behind a pile of flat cells, by the tree.
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
    """As :func:`_deepest`, of all cells that may hold x; only the tetrahedron."""
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
    """The cell of a tetrahedron."""
    return flow.tets[tet, 0] - flow.n_points  # type: ignore[no-any-return]


def _deepest(flow: MeshArrays, cell: int, x: Vector, best: int, depth: float) -> tuple[int, float]:
    """The tetrahedron of a cell with the largest smallest weight at x, if that is above ``depth``; and it."""
    for tet in range(flow.cell_start[cell], flow.cell_start[cell + 1]):
        smallest = _depth(flow, tet, x)
        if smallest > depth:
            best, depth = tet, smallest
    return best, depth


def _depth(flow: MeshArrays, tet: int, x: Vector) -> float:
    """The smallest weight of a tetrahedron at x, −∞ if it is flat or turned inside out."""
    volume, size = _volume(flow.nodes, flow.tets, tet)
    if not volume > _FLAT * size:
        return -np.inf
    origin, c1, c2, c3, volume = frame(flow, tet)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    return min(w0, w1, w2, w3) / volume


def is_there(flow: MeshArrays, tet: int, x: Vector, way: Vector) -> bool:
    """Whether a tetrahedron holds x as a place of the mesh, from which a walk can go that way."""
    if is_flat(flow, tet):
        return False
    _, _, patch, _ = trace(flow, tet, x, plus(x, way))
    return patch != _FAILED


def trace(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Follow the thread of the line from x0, in the tetrahedron ``host``, to x1, in whatever mesh.

    Where the thread is lost, as from a place on a face, the line is shifted into the host by 1e-12 of its
    size, then by more.

    Returns
    -------
    As :func:`foamprb.flow.walk.walk`; the hosts are not flat. The walk fails if the thread shows that x0 is
    outside the mesh, or does not lead away from x0.
    """
    d = minus(x1, x0)
    first = settle(flow, host, x0)
    longest = max(abs(d[0]), abs(d[1]), abs(d[2]))
    if not longest > 0.0:
        return first, 1.0, _REACHED, _NONE
    k = 0 if abs(d[0]) == longest else 1 if abs(d[1]) == longest else 2
    # What lies nearer to x0 than this, in units of t, lies there but for round-off.
    room = TOLERANCE * np.sqrt(_squared_edge(flow, first)) / longest
    # So does what lies in a plane that x0 is nearer to than this.
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
            # Nothing comes back from a place that is covered once; and before the boundary all is inside.
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
    """What a walk returns that leaves the mesh about t through a triangle of the boundary."""
    # Where the line itself meets the triangle's plane, which may have been shifted to find t.
    n = point(flow.triangle_normals, triangle)
    slope = inner(n, d)
    exact = inner(n, arm(flow.nodes, flow.triangles[triangle, 0], x0)) / slope if slope != 0.0 else t
    if abs(exact - t) < _HEALED * room:
        t = exact
    t = min(max(t, 0.0), 1.0)
    host = settle(flow, flow.triangle_tet[triangle], (x0[0] + t * d[0], x0[1] + t * d[1], x0[2] + t * d[2]))
    return host, t, flow.triangle_patch[triangle], triangle


def height(flow: MeshArrays, triangle: int, x: Vector) -> float:
    """Distance of a place from the plane of a triangle of the boundary, m."""
    d = arm(flow.nodes, flow.triangles[triangle, 0], x)
    return float(abs(inner(point(flow.triangle_normals, triangle), d)))


def _crossing(
    flow: MeshArrays, triangle: int, origin: Vector, d: Vector, k: int, x0: Vector
) -> tuple[int, float]:
    """1 if the line leaves the mesh through a triangle of the boundary, −1 if it enters, else 0; and t."""
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
    """The longest edge from the first node of a tetrahedron, squared, m²."""
    nodes, tets = flow.nodes, flow.tets
    o, longest = point(nodes, tets[tet, 0]), 0.0
    for k in range(1, 4):
        edge = arm(nodes, tets[tet, k], o)
        longest = max(longest, inner(edge, edge))
    return longest


def _pulled(flow: MeshArrays, tet: int, x: Vector, least: float) -> Vector:
    """The place in a tetrahedron where no weight is below ``least``, near x; at none, x itself if it holds x.

    Products that round to a tie can lose a thread anywhere: so places inside are shifted, too.
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
    """The face where the line through ``origin`` along d leaves a tetrahedron, −1 for none; and t there.

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
    """Where a node appears to one who looks along d from the origin, and its t.

    Space is sheared so that d becomes axis k. A face that the line leaves through turns anticlockwise.
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
    """Whether the origin lies to the left of the way from p to q, of which ``rising`` says which comes first.

    Products are compared, not subtracted: rounding never reverses an order. The origin counts as moved by
    (ε, ε²), points in the same place as moved apart by less, in the order of their numbers.
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
    """The t at which the line meets a triangle that it is known to meet."""
    wp, wq, wr = q[0] * r[1] - r[0] * q[1], r[0] * p[1] - p[0] * r[1], p[0] * q[1] - q[0] * p[1]
    wp, wq, wr = max(wp, 0.0), max(wq, 0.0), max(wr, 0.0)
    total = wp + wq + wr
    low, high = min(tp, tq, tr), max(tp, tq, tr)
    # A triangle seen from its edge is met somewhere in it.
    t = (wp * tp + wq * tq + wr * tr) / total if total > 0.0 else 0.5 * (low + high)
    return min(max(t, low), high)
