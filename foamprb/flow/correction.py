"""Kernels of the correction of the interpolated velocity; see :mod:`foamprb.flow.fluxes`.

The correction of a cell follows from the fluxes through its faces, and from u and ∇u at its nodes. It is
computed when a particle first needs it there.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus, norm, plus, scale_vector, vector_product
from foamprb.compile.link import allocating
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import FREE, MeshArrays, arm, bends, point
from foamprb.flow.wedge import across, distance, is_wedge, stretched, tangent

# Sum of squares of what the tetrahedra of a cell may still lack, over that of their fluxes.
_EXACT = 1e-14
_ROWS = 7
"""Rows of working memory of :func:`correct_cell`."""
_SIZE, _COUNT = 3, 4
"""Columns of its sides: the length of the area vector, m², and the number of free nodes."""
_ZERO = float(np.finfo(np.float32).tiny)
"""Added to what is stored, so that 0 means that nothing is stored yet; no other number is changed by it."""


class NodalFlow(NamedTuple):
    """Tables of the places x, m, velocities u, m/s, gradients l, 1/s, and :data:`FREE` at nodes.

    Velocities and gradients begin in row ``first``. The last three numbers are the first columns of the
    tables.
    """

    x: Floats
    u: Floats
    l: Floats
    free: Floats
    first: int
    k_u: int
    k_l: int
    k_free: int


class Work(NamedTuple):
    """Working memory for the n tetrahedra of a cell."""

    fluxes: Floats
    """(n, 4), of the better velocity out of each side, m³/s."""
    lacking: NDArray[np.float32]
    """(n, 4), minus that of the interpolated velocity."""
    weight: Floats
    """(n, 4)."""
    sides: Floats
    """(n, 4, 5): the area vector of each side, m², its length, and the number of free nodes."""
    rows: Floats
    """(7, n)."""


def area_vector(nodes: Floats, a: int, b: int, c: int) -> Vector:
    """Return the area vector of a triangle, m²."""
    o = point(nodes, a)
    s = vector_product(minus(point(nodes, b), o), minus(point(nodes, c), o))
    return 0.5 * s[0], 0.5 * s[1], 0.5 * s[2]


def triangle_flux(at: NodalFlow, a: int, b: int, c: int) -> float:
    """Return the flux of the better velocity (:func:`_measure_sides`) through a triangle, m³/s."""
    s, flux = area_vector(at.x, a, b, c), 0.0
    u, v, w = _velocity(at, a), _velocity(at, b), _velocity(at, c)
    for k in range(3):
        flux += s[k] * (u[k] + v[k] + w[k]) / 3.0
    for i, j in ((a, b), (b, c), (c, a)):
        flux += _off(_free(at, i), _free(at, j)) * inner(s, _edge_bend(at, i, j))
    return float(flux)


def _velocity(at: NodalFlow, node: int) -> Vector:
    row, k = at.first + node, at.k_u
    return at.u[row, k], at.u[row, k + 1], at.u[row, k + 2]


def _velocity_at(at: NodalFlow, layer: Floats, node: int) -> Vector:
    """Return the velocity of a node, in a wedge without that around the axis, which makes no volume."""
    v = _velocity(at, node)
    return stretched(layer, tangent(layer, point(at.x, node)), across(layer, v)) if is_wedge(layer) else v


def _free(at: NodalFlow, node: int) -> float:
    return at.free[node, at.k_free]  # type: ignore[no-any-return]


def _edge_bend(at: NodalFlow, i: int, j: int) -> Vector:
    """Return (l_i − l_j)·(x_j − x_i)/24, m/s: a third of what an edge adds to a mean velocity."""
    return _bend_along(at, i, j, arm(at.x, j, point(at.x, i)))


def _bend_along(at: NodalFlow, i: int, j: int, d: Vector) -> Vector:
    a, b, k, s = at.first + i, at.first + j, at.k_l, 1.0 / 24.0
    return (
        s * _change(at.l, a, b, k, d),
        s * _change(at.l, a, b, k + 3, d),
        s * _change(at.l, a, b, k + 6, d),
    )


def _edge_bend_at(at: NodalFlow, layer: Floats, i: int, j: int) -> Vector:
    """Return :func:`_edge_bend`, in a wedge along its middle plane."""
    if not is_wedge(layer):
        return _edge_bend(at, i, j)
    return across(layer, _bend_along(at, i, j, across(layer, arm(at.x, j, point(at.x, i)))))


def _change(l: Floats, i: int, j: int, k: int, d: Vector) -> float:
    """Return the sum of the products of (l_i − l_j) in three columns, from k on, with d."""
    x, y, z = l[i, k] - l[j, k], l[i, k + 1] - l[j, k + 1], l[i, k + 2] - l[j, k + 2]
    return x * d[0] + y * d[1] + z * d[2]  # type: ignore[no-any-return]


@allocating
def correct_cell(
    flow: MeshArrays,
    correction: NDArray[np.float32],
    row: int,
    phi: Floats,
    first_face: int,
    f: Floats,
    k: int,
    first: int,
    host: int,
) -> None:
    """Write the correction in the tetrahedra of the cell of a host; see :class:`MeshArrays`.

    Other threads and processes may write the same numbers at the same time, and read them. Each number is
    written once.

    Parameters
    ----------
    correction, row
        (n, 4), and the row of the host.
    phi, first_face
        Flux out of the owner of each face, m³/s, NaN for no correction, and the row of face 0.
    f, k, first
        Table of velocities and gradients, from column k on, and the row of node 0.
    """
    tets, neighbours, face_start = flow.tets, flow.neighbours, flow.face_start
    c = tets[host, 0] - flow.n_points
    begin, n = flow.cell_start[c], flow.cell_start[c + 1] - flow.cell_start[c]
    memory = Work(
        np.empty((n, 4)), np.empty((n, 4), np.float32), np.empty((n, 4)), np.empty((n, 4, 5)),
        np.empty((_ROWS, n)),
    )  # fmt: skip
    fluxes, lacking, weight, sides, work = memory
    rest, change, volume = work[0], work[4], work[5]
    at = NodalFlow(flow.nodes, f, f, flow.nodes, first, k, k + 3, FREE)
    total = space = 0.0
    for t in range(n):
        volume[t] = _measure_sides(at, flow.layer, tets, begin + t, t, memory)
        space += volume[t]
    # The triangles of a face share its flux by their areas and free nodes.
    t = 0
    for h in range(flow.cell_face_start[c], flow.cell_face_start[c + 1]):
        face = flow.cell_faces[h]
        size = face_start[face + 1] - face_start[face] - 2
        interpolated = area = 0.0
        for s in range(t, t + size):
            interpolated += fluxes[s, 0]
            work[1, s] = sides[s, 0, _SIZE] * sides[s, 0, _COUNT]
            area += work[1, s]
        if area == 0.0:
            for s in range(t, t + size):
                work[1, s] = sides[s, 0, _SIZE]
                area += work[1, s]
        out = phi[first_face + face]
        out = out if flow.owner[face] == c else -out
        total += out
        for s in range(t, t + size):
            fluxes[s, 0] += (out - interpolated) * work[1, s] / max(area, 1e-300)
        t += size
    _carry(at.x, tets, begin, n, space, memory)
    square = lost = 0.0
    for t in range(n):
        rest[t] = total * volume[t] / space
        for s in range(4):
            rest[t] -= fluxes[t, s]
            square += fluxes[t, s] * fluxes[t, s]
        lost += rest[t] / n
    for t in range(n):
        # Round-off in the sum, for which there is no solution.
        rest[t] -= lost
    for t in range(n):
        for s in range(1, 4):
            reach = abs(volume[t]) + abs(volume[neighbours[begin + t, s] - begin])
            size = sides[t, s, _SIZE]
            weight[t, s] = sides[t, s, _COUNT] * size * size / max(reach, 1e-300)
    _share(neighbours, begin, n, weight, work, _EXACT * square)
    for t in range(n):
        for s in range(1, 4):
            fluxes[t, s] += weight[t, s] * (change[t] - change[neighbours[begin + t, s] - begin])
    if flow.layer.shape[0] > 0:
        _flatten(flow, begin, n, memory)
    for t in range(n):
        for s in range(4):
            # All nodes of a side are free if none is.
            count = sides[t, s, _COUNT] if sides[t, s, _COUNT] > 0.0 else 3.0
            flux = fluxes[t, s] + lacking[t, s]
            q = np.float32(flux / (count * volume[t])) if volume[t] != 0.0 else np.float32(0.0)
            # NaN for no correction.
            q = np.float32(q + _ZERO) if abs(q) >= 0.0 else np.float32(_ZERO)
            correction[row - host + begin + t, s] = q if q != 0.0 else np.float32(_ZERO)


def is_added(flow: MeshArrays, node: Any) -> bool:
    """Return True for the centres of faces in the planes of a two-dimensional flow."""
    return bool(flow.n_points - 2 * (flow.cell_start.shape[0] - 1) <= node < flow.n_points)


def _flatten(flow: MeshArrays, begin: int, n: int, memory: Work) -> None:
    """Make the fluxes in a cell of a two-dimensional flow those of its prisms, the same at all depths.

    A prism lies between three columns of nodes; each of its tetrahedra has two nodes in one of them. The
    additional fluxes through the sides of the prism are the sums over the tetrahedra. The results make that
    velocity in two dimensions in :func:`foamprb.flow.walk.correction_at`: with the area A of the side
    opposite a column, its distance H and free nodes f, q = 2 flux/(f A H).
    """
    fluxes, lacking, _, sides, work = memory
    sums, prism, areas, volume = memory.weight, work[0], work[1:4], work[5]
    for t in range(n):
        prism[t] = t
        for k in range(3):
            sums[t, k] = areas[k, t] = 0.0
    # The tetrahedra of a prism follow each other across the sides opposite a node of the doubled column.
    for _ in range(3):
        for t in range(n):
            i, j = _doubled(flow, begin + t)
            for k in range(1, 4):
                if k in (i, j):
                    prism[t] = min(prism[t], prism[flow.neighbours[begin + t, k] - begin])
    for t in range(n):
        (i, j), p = _doubled(flow, begin + t), int(prism[t])
        for k in range(4):
            if k not in (i, j):
                c = _column(flow, begin + p, flow.tets[begin + t, k])
                sums[p, c] += fluxes[t, k] + lacking[t, k]
                areas[c, p] += sides[t, k, _SIZE]
    for t in range(n):
        (i, j), p = _doubled(flow, begin + t), int(prism[t])
        a, b, c = _columns(flow, begin + p)
        d, e = _in_plane_arm(flow, a, b), _in_plane_arm(flow, a, c)
        area = norm(vector_product(d, e))
        edges = norm(minus(e, d)), norm(e), norm(d)
        f, g, h = abs(flow.nodes[a, FREE]), abs(flow.nodes[b, FREE]), abs(flow.nodes[c, FREE])
        free = g + h, h + f, f + g
        for k in range(4):
            s = _column(flow, begin + p, flow.tets[begin + t, k])
            count = free[s] if free[s] > 0.0 else 2.0
            if is_wedge(flow.layer):
                count *= _mean_distance(flow, (a, b, c), s, free[s] > 0.0)
            q = 2.0 * sums[p, s] * edges[s] / max(count * areas[s, p] * area, 1e-300)
            q = 0.5 * q if k in (i, j) else q
            # What :func:`correct_cell` stores of it is q.
            count = sides[t, k, _COUNT] if sides[t, k, _COUNT] > 0.0 else 3.0
            fluxes[t, k], lacking[t, k] = q * count * volume[t], 0.0


def _mean_distance(flow: MeshArrays, nodes: tuple[Any, Any, Any], s: int, free: bool) -> float:
    """Return the mean distance from the axis of a flux through side s over that of the side.

    The flux is distributed over the ``free`` nodes of the side, or over both.
    """
    i, j = (nodes[1], nodes[2]) if s == 0 else (nodes[2], nodes[0]) if s == 1 else (nodes[0], nodes[1])
    p, q = distance(flow.layer, point(flow.nodes, i)), distance(flow.layer, point(flow.nodes, j))
    f, g = (abs(flow.nodes[i, FREE]), abs(flow.nodes[j, FREE])) if free else (1.0, 1.0)
    mean = 2.0 * (f * (2.0 * p + q) + g * (2.0 * q + p)) / (3.0 * (f + g) * max(p + q, 1e-300))
    return float(mean)


def _in_plane_arm(flow: MeshArrays, a: Any, b: Any) -> Vector:
    return across(flow.layer, arm(flow.nodes, b, point(flow.nodes, a)))


def _doubled(flow: MeshArrays, tet: int) -> tuple[int, int]:
    """Return the two vertices of a tetrahedron that lie in one column, in order."""
    least, i, j = np.inf, 0, 0
    for k in range(3):
        for m in range(k + 1, 4):
            d = _in_plane_arm(flow, flow.tets[tet, k], flow.tets[tet, m])
            if inner(d, d) < least:
                least, i, j = inner(d, d), k, m
    return i, j


def _columns(flow: MeshArrays, tet: int) -> tuple[Any, Any, Any]:
    """Return a node in each column of the prism of a tetrahedron, the cell centre first."""
    i, j = _doubled(flow, tet)
    first = i if i > 0 else 2 if j == 1 else 1
    # The vertices but the first are 1, 2 and 3.
    return flow.tets[tet, 0], flow.tets[tet, first], flow.tets[tet, 6 - first - j]


def _column(flow: MeshArrays, tet: int, node: Any) -> int:
    """Return the column of :func:`_columns` in which a node lies."""
    a, b, c = _columns(flow, tet)
    d, e, f = _in_plane_arm(flow, a, node), _in_plane_arm(flow, b, node), _in_plane_arm(flow, c, node)
    x, y, z = inner(d, d), inner(e, e), inner(f, f)
    return 0 if x <= min(y, z) else 1 if y <= z else 2


def is_stored(correction: NDArray[np.float32], row: Any) -> bool:
    """Return True if :func:`correct_cell` has written a row."""
    a, b, c, d = correction[row, 0], correction[row, 1], correction[row, 2], correction[row, 3]
    return min(abs(a), abs(b), abs(c), abs(d)) > 0.0  # type: ignore[no-any-return]


def stored(correction: NDArray[np.float32], row: Any, k: int) -> Any:
    """Return a number that :func:`correct_cell` has written."""
    return np.float32(correction[row, k] - _ZERO)


def _measure_sides(at: NodalFlow, layer: Floats, tets: Ints, tet: int, row: int, memory: Work) -> float:
    """Measure the sides of a tetrahedron; return its signed volume, m³.

    Side k is opposite vertex k. The interpolated velocity (:func:`foamprb.flow.walk.interpolate`) is straight
    along an edge to a wall. A better one is quadratic there, too, but straight along edges on a wall.

    Parameters
    ----------
    tet, row
        The tetrahedron, and its row in working memory.
    memory
        Results are its fluxes and sides.
    """
    nodes = at.x
    o, a, b, c = tets[tet, 0], tets[tet, 1], tets[tet, 2], tets[tet, 3]
    x = point(nodes, o)
    p, q, r = arm(nodes, a, x), arm(nodes, b, x), arm(nodes, c, x)
    so, sa = _half_product(minus(q, p), minus(r, p)), _half_product(r, q)
    sb, sc = _half_product(p, r), _half_product(q, p)
    oa, ob, oc = (
        _edge_bend_at(at, layer, o, a), _edge_bend_at(at, layer, o, b), _edge_bend_at(at, layer, o, c)
    )  # fmt: skip
    ab, bc, ca = (
        _edge_bend_at(at, layer, a, b), _edge_bend_at(at, layer, b, c), _edge_bend_at(at, layer, c, a)
    )  # fmt: skip
    fo, fa, fb, fc = _free(at, o), _free(at, a), _free(at, b), _free(at, c)
    uo, ua = _velocity_at(at, layer, o), _velocity_at(at, layer, a)
    ub, uc = _velocity_at(at, layer, b), _velocity_at(at, layer, c)
    _put_side(memory, row, 0, so, plus(plus(ua, ub), uc), (fa, fb, fc), (ab, bc, ca))
    _put_side(memory, row, 1, sa, plus(plus(uo, uc), ub), (fo, fc, fb), (oc, bc, ob))
    _put_side(memory, row, 2, sb, plus(plus(uo, ua), uc), (fo, fa, fc), (oa, ca, oc))
    _put_side(memory, row, 3, sc, plus(plus(uo, ub), ua), (fo, fb, fa), (ob, ab, oa))
    volume = -inner(p, sa) / 3.0
    return float(volume)


def _half_product(v: Vector, w: Vector) -> Vector:
    return scale_vector(0.5, vector_product(v, w))


def _put_side(
    memory: Work,
    row: int,
    k: int,
    s: Vector,
    u: Vector,
    free: Vector,
    edges: tuple[Vector, Vector, Vector],
) -> None:
    """Write side k from its area vector, and the sum of velocities, free nodes and edges 01, 12, 20."""
    sides, (f, g, h) = memory.sides, free
    size, ends = inner(s, s), (inner(s, edges[0]), inner(s, edges[1]), inner(s, edges[2]))
    mean = inner(s, u) / 3.0
    flux = mean + bends(f, g) * ends[0] + bends(g, h) * ends[1] + bends(h, f) * ends[2]
    better = mean + _off(f, g) * ends[0] + _off(g, h) * ends[1] + _off(h, f) * ends[2]
    memory.fluxes[row, k], memory.lacking[row, k] = better, -flux
    sides[row, k, 0], sides[row, k, 1], sides[row, k, 2] = s
    sides[row, k, _SIZE], sides[row, k, _COUNT] = np.sqrt(size), abs(f) + abs(g) + abs(h)


def _off(f: float, g: float) -> float:
    """Return 1 for an edge with an end off the walls, else 0; see :func:`~foamprb.flow.fluxes.free_nodes`."""
    return 1.0 if f > 0.0 or g > 0.0 else 0.0


def _carry(nodes: Floats, tets: Ints, begin: int, n: int, space: float, memory: Work) -> None:
    """Add to the fluxes inside a cell those of the mean correction that the ones through its sides make.

    The mean is Σ x δ over the volume ``space``, with the additional flux δ out of a side with the middle x.
    """
    fluxes, lacking, sides = memory.fluxes, memory.lacking, memory.sides
    o, mean = point(nodes, tets[begin, 0]), (0.0, 0.0, 0.0)
    for t in range(n):
        tet = begin + t
        s = (fluxes[t, 0] + lacking[t, 0]) / (3.0 * space)
        p, q, r = arm(nodes, tets[tet, 1], o), arm(nodes, tets[tet, 2], o), arm(nodes, tets[tet, 3], o)
        mean = (
            mean[0] + s * (p[0] + q[0] + r[0]),
            mean[1] + s * (p[1] + q[1] + r[1]),
            mean[2] + s * (p[2] + q[2] + r[2]),
        )
    for t in range(n):
        for k in range(1, 4):
            area = sides[t, k, 0], sides[t, k, 1], sides[t, k, 2]
            fluxes[t, k] += inner(area, mean) * sides[t, k, _COUNT] / 3.0


def _share(neighbours: Ints, first: int, n: int, weight: Floats, work: Floats, enough: float) -> None:
    """Solve for potentials of the tetrahedra of a cell, whose differences drive fluxes that balance ``rest``.

    ``rest``, row 0 of ``work``, is what each tetrahedron lacks; the potentials go into row 4. The fluxes are
    the smallest change in the sum of squares over ``weight`` (n, 4). Conjugate gradients end when the sum of
    squares of what is still lacking is ``enough``.
    """
    rest, way, residual, image, change, diagonal = work[0], work[1], work[2], work[3], work[4], work[6]
    energy = square = 0.0
    for t in range(n):
        change[t] = 0.0
        diagonal[t] = weight[t, 1] + weight[t, 2] + weight[t, 3]
        residual[t] = rest[t]
        way[t] = rest[t] / diagonal[t]
        energy += rest[t] * way[t]
        square += rest[t] * rest[t]
    for _ in range(8 * n):
        # NaN for no correction.
        if not square > enough:
            break
        curve = 0.0
        for t in range(n):
            image[t] = 0.0
            for k in range(1, 4):
                image[t] += weight[t, k] * (way[t] - way[neighbours[first + t, k] - first])
            curve += way[t] * image[t]
        if curve <= 0.0:
            break
        s, before = energy / curve, energy
        square = energy = 0.0
        for t in range(n):
            change[t] += s * way[t]
            residual[t] -= s * image[t]
            square += residual[t] * residual[t]
            energy += residual[t] * residual[t] / diagonal[t]
        for t in range(n):
            way[t] = residual[t] / diagonal[t] + energy / before * way[t]
