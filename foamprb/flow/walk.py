"""Kernels that move a particle through a mesh and interpolate u and ∇u.

The host of a particle is the tetrahedron that holds its centre. A step follows the straight segment from the
old point to the new one through the faces that it crosses, so that location costs a few operations and a wall
is met exactly where it is crossed.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.faxen import Curvature, curvature_of
from foamprb.body.tensor import Tensor, Vector, between, dot_vector, inner, minus, plus, scale
from foamprb.compile.link import separate
from foamprb.flow.base import Floats, Turbulence
from foamprb.flow.correction import correct_cell, is_added, is_stored, stored
from foamprb.flow.mesh.arrays import (
    FREE,
    GRADIENT,
    TOLERANCE,
    VELOCITY,
    MeshArrays,
    arm,
    bends,
    frame,
    nodes_of,
    point,
    weights,
)
from foamprb.flow.mesh.folds import SOUND, trace
from foamprb.flow.mesh.locator import locate, seek
from foamprb.flow.wedge import (
    across,
    change_around,
    distance,
    is_wedge,
    stretched,
    tangent,
    turned,
    turned_curvature,
)

REACHED = -1
FAILED = -2
NO_TRIANGLE = _NO_TET = -1
WITHIN = 4
"""Result of :func:`way_out` in place of a face."""

_MOST_CROSSINGS = 20_000
# Crossings without progress (around an edge or a vertex) after which the start is moved.
_MOST_STALLS = 200
_ATTEMPTS = 4
# More negative weights are not round-off.
_APART = 1e-6
# Weights of a point inside a tetrahedron, off its middle and the middles of its faces.
_INSIDE = (0.1, 0.2, 0.3, 0.4)
_MIDDLE = (0.25, 0.25, 0.25, 0.25)
STEADY: Vector = (0.0, 0.0, 0.0)
"""∂u/∂t of a steady flow, m/s²."""

Corners: TypeAlias = tuple[int, int, int, int]
Weights: TypeAlias = tuple[float, float, float, float]


def sample(flow: MeshArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:  # noqa: ARG001
    """Return u + c (m/s), l_ij = ∂u_i/∂x_j (1/s) and −l·c (m/s²) at x; see :func:`parts`.

    With a velocity v the acceleration of the fluid is l·v − l·c, in which the jumps of c cancel.
    """
    u, c, l = parts(flow, host, x)
    return plus(u, c), l, minus(STEADY, dot_vector(l, c))


def parts(flow: MeshArrays, host: int, x: Vector) -> tuple[Vector, Vector, Tensor]:
    """Return u at x in the tetrahedron ``host``, its correction c, both m/s, and l, 1/s."""
    sides, s, w = shape_and_sides(flow, host, x)
    u, l = interpolate(flow, host, flow.nodes, VELOCITY, 0, w)
    c = correction_at(flow, flow.correction, host, flow.phi, 0, flow.nodes, VELOCITY, 0, host, w, sides, s)
    return from_middle(flow, x, u, c, l) if is_wedge(flow.layer) else (u, c, l)


def from_middle(
    flow: MeshArrays, x: Vector, u: Vector, c: Vector, l: Tensor
) -> tuple[Vector, Vector, Tensor]:
    """Return two velocities and a gradient of the middle plane of a wedge turned to x."""
    t = tangent(flow.layer, x)
    return stretched(flow.layer, t, u), stretched(flow.layer, t, c), turned(flow.layer, t, l)


def sample_ahead(
    flow: MeshArrays,
    host: int,
    x0: Vector,
    x1: Vector,
    t1: float,  # noqa: ARG001
) -> tuple[int, float, int, Vector, Tensor, Vector]:
    """Return the last tetrahedron on the path from x0 in ``host`` to x1, and :func:`sample` at x1 in it.

    Usually it is ``host``, as the weights of its nodes show. The second result is the distance from x1, m,
    along each axis within which a point certainly lies in the tetrahedron, if more than 0. The third one is
    the number of cells that the path enters.
    """
    last, sound, entered = host, is_sound(flow, host), 0
    origin, c1, c2, c3, volume = frame(flow, host)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x1)
    least = min(w0, w1, w2, w3)
    if not (least >= -TOLERANCE * volume and sound):
        found, _, patch, _, entered = follow(flow, host, x0, x1)
        if patch != FAILED:
            last, sound = found, is_sound(flow, found)
        origin, c1, c2, c3, volume = frame(flow, last)
        w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x1)
        least = min(w0, w1, w2, w3)
    s = 1.0 / volume
    w = (s * w0, s * w1, s * w2, s * w3)
    u, l = interpolate(flow, last, flow.nodes, VELOCITY, 0, w)
    c = correction_at(
        flow, flow.correction, last, flow.phi, 0, flow.nodes, VELOCITY, 0, last, w, (c1, c2, c3), s
    )
    if is_wedge(flow.layer):
        u, c, l = from_middle(flow, x1, u, c, l)
    # The gradient of a weight is its cofactor vector; that of the origin minus the sum of the others.
    room = least / (_components(c1) + _components(c2) + _components(c3)) if sound else 0.0
    return last, room, entered, plus(u, c), l, minus(STEADY, dot_vector(l, c))


def _components(v: Vector) -> Any:
    return abs(v[0]) + abs(v[1]) + abs(v[2])


def turbulence(flow: MeshArrays, host: int, x: Vector, t: float) -> Turbulence:  # noqa: ARG001
    """Return k, ε, ∇k and ∇(k²/3ε) at x, linear in the tetrahedron ``host``; zeros if they were not read."""
    if flow.turbulence.shape[0] == 0:
        return 0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    return blend_turbulence(flow.turbulence, 0, corners(flow, host, 0), shape(flow, host, x))


def blend_turbulence(f: Floats, k: int, nodes: Corners, w: Weights) -> Turbulence:
    """Return k, ε, ∇k and ∇(k²/3ε) from a table with a row for each node, from column k on."""
    return (
        blend(f, k, nodes, w),
        blend(f, k + 1, nodes, w),
        (blend(f, k + 2, nodes, w), blend(f, k + 3, nodes, w), blend(f, k + 4, nodes, w)),
        (blend(f, k + 5, nodes, w), blend(f, k + 6, nodes, w), blend(f, k + 7, nodes, w)),
    )


def corners(flow: MeshArrays, host: int, first: int) -> Corners:
    """Return the rows of the nodes of a tetrahedron in a table where node 0 has the row ``first``."""
    a, b, c, d = nodes_of(flow, host)
    return first + a, first + b, first + c, first + d


def shape(flow: MeshArrays, host: int, x: Vector) -> Weights:
    """Return the barycentric weights of a tetrahedron at x."""
    return shape_and_sides(flow, host, x)[2]


def shape_and_sides(
    flow: MeshArrays, host: int, x: Vector
) -> tuple[tuple[Vector, Vector, Vector], float, Weights]:
    """Return three cofactor vectors, the inverse of their volume (:func:`frame`), and :func:`shape`."""
    origin, c1, c2, c3, volume = frame(flow, host)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    s = 1.0 / volume
    return (c1, c2, c3), s, (s * w0, s * w1, s * w2, s * w3)


def interpolate(
    flow: MeshArrays, host: int, f: Floats, k: int, first: int, w: Weights
) -> tuple[Vector, Tensor]:
    """Return velocity and gradient from a table with a row for each node, from row ``first`` and column k on.

    The gradient is linear, Σ λ_i l_i. The velocity is quadratic: at the middle of an edge that bends
    (:func:`~foamprb.flow.mesh.arrays.bends`) it is ½(u_i + u_j) + ⅛(l_i − l_j)·(x_j − x_i). Along other edges
    it is linear. In a tetrahedron with a side on a wall and no edge that bends it is thus, with its
    correction, parallel to the wall.
    """
    a, b, c, d = nodes_of(flow, host)
    at = first + a, first + b, first + c, first + d
    nodes = flow.nodes
    o = point(nodes, a)
    sides = _sides_of(flow, (b, c, d), o)
    fa, fb, fc, fd = nodes[a, FREE], nodes[b, FREE], nodes[c, FREE], nodes[d, FREE]
    arms = _arms((abs(fa) * w[0], abs(fb) * w[1], abs(fc) * w[2], abs(fd) * w[3]), sides)
    if min(fa, fb, fc, fd) < 0.0:
        # Edges between two nodes on walls do not bend.
        ra, rb, rc, rd = _arms(
            (min(fa, 0.0) * w[0], min(fb, 0.0) * w[1], min(fc, 0.0) * w[2], min(fd, 0.0) * w[3]), sides
        )
        arms = minus(arms[0], ra), minus(arms[1], rb), minus(arms[2], rc), minus(arms[3], rd)
    u = (
        blend(f, k, at, w) + _product(f, at, k + 3, arms),
        blend(f, k + 1, at, w) + _product(f, at, k + 6, arms),
        blend(f, k + 2, at, w) + _product(f, at, k + 9, arms),
    )
    l = (
        blend(f, k + 3, at, w), blend(f, k + 4, at, w), blend(f, k + 5, at, w),
        blend(f, k + 6, at, w), blend(f, k + 7, at, w), blend(f, k + 8, at, w),
        blend(f, k + 9, at, w), blend(f, k + 10, at, w), blend(f, k + 11, at, w),
    )  # fmt: skip
    return u, l


def _sides_of(flow: MeshArrays, others: tuple[Any, Any, Any], o: Vector) -> tuple[Vector, Vector, Vector]:
    """Return the sides of a tetrahedron from a vertex at o; in a wedge their parts along its middle plane."""
    p, q, r = arm(flow.nodes, others[0], o), arm(flow.nodes, others[1], o), arm(flow.nodes, others[2], o)
    if is_wedge(flow.layer):
        return across(flow.layer, p), across(flow.layer, q), across(flow.layer, r)
    return p, q, r


def _arms(m: Weights, sides: tuple[Vector, Vector, Vector]) -> tuple[Vector, Vector, Vector, Vector]:
    """Return what to multiply the gradients at the nodes with for the sum over all edges.

    The sum of ½ m_i m_j (l_i − l_j)·(x_j − x_i) is ½ Σ m_i l_i·(z − m p_i), with the sum m of the weights m_i
    and z = Σ m_i p_i. The ``sides`` are p_1, p_2 and p_3; p_0 = 0.
    """
    (ma, mb, mc, md), (p, q, r) = m, sides
    total = ma + mb + mc + md
    z = (
        mb * p[0] + mc * q[0] + md * r[0],
        mb * p[1] + mc * q[1] + md * r[1],
        mb * p[2] + mc * q[2] + md * r[2],
    )
    return (
        _half(ma, total, z, (0.0, 0.0, 0.0)),
        _half(mb, total, z, p),
        _half(mc, total, z, q),
        _half(md, total, z, r),
    )


def _half(weight: float, m: float, z: Vector, p: Vector) -> Vector:
    s = 0.5 * weight
    return s * (z[0] - m * p[0]), s * (z[1] - m * p[1]), s * (z[2] - m * p[2])


def _product(f: Floats, at: Corners, k: int, arms: tuple[Vector, Vector, Vector, Vector]) -> Any:
    """Return the sum over four rows of the products of three columns, from k on, with the arms."""
    i, j, m, n = at
    a, b, c, d = arms
    return (
        f[i, k] * a[0] + f[i, k + 1] * a[1] + f[i, k + 2] * a[2]
        + f[j, k] * b[0] + f[j, k + 1] * b[1] + f[j, k + 2] * b[2]
        + f[m, k] * c[0] + f[m, k + 1] * c[1] + f[m, k + 2] * c[2]
        + f[n, k] * d[0] + f[n, k + 1] * d[1] + f[n, k + 2] * d[2]
    )  # fmt: skip


def correction_at(
    flow: MeshArrays,
    correction: NDArray[np.float32],
    row: int,
    phi: Floats,
    first_face: int,
    f: Floats,
    k: int,
    first: int,
    host: int,
    w: Weights,
    sides: tuple[Vector, Vector, Vector],
    s: float,
) -> Vector:
    """Return the velocity, m/s, that keeps volume (:mod:`foamprb.flow.fluxes`), at weights ``w`` in a host.

    Row ``row`` of ``correction`` holds its fluxes q over volume and free nodes. A flux through the side
    opposite vertex k moves along the edges from k to the free vertices j of the side, as λ_j q_k (x_j − x_k).
    With the absolute values f_j of :data:`FREE` the sum is Σ_j x_j (f_j λ_j Σ_k q_k − q_j Σ_k f_k λ_k).

    Parameters
    ----------
    phi, first_face
        Fluxes through the faces, from row ``first_face`` on; see :class:`MeshArrays`.
    f, k, first
        Table of velocities and gradients, from row ``first`` and column k on; see :func:`interpolate`.
    sides, s
        Results of :func:`shape_and_sides`.
    """
    if correction.shape[0] == 0:
        return 0.0, 0.0, 0.0
    q = fluxes_of(flow, correction, row, phi, first_face, f, k, first, host)
    return correction_by(flow, q, f, k, first, host, w, sides, s)


def fluxes_of(
    flow: MeshArrays,
    correction: NDArray[np.float32],
    row: int,
    phi: Floats,
    first_face: int,
    f: Floats,
    k: int,
    first: int,
    host: int,
) -> Weights:
    """Return the additional fluxes through the sides of a host; see :func:`correction_at`."""
    at = np.uint64(row)
    if not is_stored(correction, at):
        correct_cell(flow, correction, row, phi, first_face, f, k, first, host)
    return (
        stored(correction, at, 0), stored(correction, at, 1),
        stored(correction, at, 2), stored(correction, at, 3),
    )  # fmt: skip


def correction_by(
    flow: MeshArrays,
    fluxes: Weights,
    f: Floats,
    k: int,
    first: int,
    host: int,
    w: Weights,
    sides: tuple[Vector, Vector, Vector],
    s: float,
) -> Vector:
    """Return the correction by the additional fluxes of a host; see :func:`correction_at`."""
    (a, b, c, d), nodes, (qa, qb, qc, qd) = nodes_of(flow, host), flow.nodes, fluxes
    free = nodes[a, FREE], nodes[b, FREE], nodes[c, FREE], nodes[d, FREE]
    fa, fb, fc, fd = abs(free[0]), abs(free[1]), abs(free[2]), abs(free[3])
    q, count, flat = qa + qb + qc + qd, fa + fb + fc + fd, flow.layer.shape[0] > 0
    if flat and max(is_added(flow, b), is_added(flow, c), is_added(flow, d)):
        # Of the two nodes in the column of the centre, one counts.
        count -= 1.0
    o, rows = point(nodes, a), (first + a, first + b, first + c, first + d)
    arms = p, m, r = _sides_of(flow, (b, c, d), o)
    # The second part is Σ e_k λ_k x_k − (Σ e_k λ_k) x, with x = Σ λ_k x_k and a quarter e of the divergence.
    if min(free[0], free[1], free[2], free[3]) == 1.0:
        eb, ec, ed = _excess(f, k + 3, rows, arms, sides, s)
    else:
        eb, ec, ed = _excess_at_walls(f, k + 3, rows, free, arms, sides, s)
    if is_wedge(flow.layer):
        # The divergence holds u_ρ/ρ, too, of which the first part counts one half.
        ga, gb, gc, gd = _spreads(flow, f, k, rows, (a, b, c, d))
        part = 0.125 if min(free[0], free[1], free[2], free[3]) == 1.0 else 0.25
        eb, ec, ed = eb + part * (gb - ga), ec + part * (gc - ga), ed + part * (gd - ga)
    if flat:
        # A third instead of a quarter in two dimensions.
        eb, ec, ed = 4.0 / 3.0 * eb, 4.0 / 3.0 * ec, 4.0 / 3.0 * ed
    e = eb * w[1] + ec * w[2] + ed * w[3]
    sb, sc, sd = (eb - e) * w[1], (ec - e) * w[2], (ed - e) * w[3]
    if count == 4.0 or count == 0.0:
        sb, sc, sd = sb + q * w[1] - qb, sc + q * w[2] - qc, sd + q * w[3] - qd
    else:
        z = fa * w[0] + fb * w[1] + fc * w[2] + fd * w[3]
        sb, sc, sd = sb + fb * w[1] * q - qb * z, sc + fc * w[2] * q - qc * z, sd + fd * w[3] * q - qd * z
    if count == 1.0:
        # The side opposite the only free vertex has a uniform flux.
        q = fa * qa + fb * qb + fc * qc + fd * qd
        sb += q * (w[1] - fb)
        sc += q * (w[2] - fc)
        sd += q * (w[3] - fd)
    v = (
        sb * p[0] + sc * m[0] + sd * r[0],
        sb * p[1] + sc * m[1] + sd * r[1],
        sb * p[2] + sc * m[2] + sd * r[2],
    )
    return across(flow.layer, v) if flat else v


def _spreads(flow: MeshArrays, f: Floats, k: int, rows: Corners, nodes: Corners) -> Weights:
    """Return u_ρ/ρ at four nodes of a wedge, 1/s, from velocities and gradients in columns k on."""
    p, q, r, s = (
        distance(flow.layer, point(flow.nodes, nodes[0])), distance(flow.layer, point(flow.nodes, nodes[1])),
        distance(flow.layer, point(flow.nodes, nodes[2])), distance(flow.layer, point(flow.nodes, nodes[3])),
    )  # fmt: skip
    least = 1e-6 * max(p, q, r, s)
    return (
        _spread(flow, f, k, rows[0], p, least), _spread(flow, f, k, rows[1], q, least),
        _spread(flow, f, k, rows[2], r, least), _spread(flow, f, k, rows[3], s, least),
    )  # fmt: skip


def _spread(flow: MeshArrays, f: Floats, k: int, row: int, rho: float, least: float) -> Any:
    """Return u_ρ/ρ at a node, 1/s; on the axis, nearer than ``least``, ∂u_ρ/∂ρ."""
    e = flow.layer[6], flow.layer[7], flow.layer[8]
    if rho > least:
        return inner(e, (f[row, k], f[row, k + 1], f[row, k + 2])) / rho
    m = k + 3
    return inner(
        e,
        (
            inner(e, (f[row, m], f[row, m + 1], f[row, m + 2])),
            inner(e, (f[row, m + 3], f[row, m + 4], f[row, m + 5])),
            inner(e, (f[row, m + 6], f[row, m + 7], f[row, m + 8])),
        ),
    )


def _excess(
    f: Floats,
    k: int,
    rows: Corners,
    arms: tuple[Vector, Vector, Vector],
    sides: tuple[Vector, Vector, Vector],
    s: float,
) -> Vector:
    """Return a quarter of the divergence at vertices 1, 2 and 3 less that at vertex 0, 1/s.

    That of the interpolated velocity at vertex i is half of Σ_j ∇λ_j·(l_i − l_j)·(x_j − x_i) and a constant,
    which is half of tr l_i + (Σ_j ∇λ_j·l_j)·x_i and another constant. The gradients are in columns k on.
    """
    c1, c2, c3 = sides
    c0 = -c1[0] - c2[0] - c3[0], -c1[1] - c2[1] - c3[1], -c1[2] - c2[2] - c3[2]
    t, cofactors = 0.125 * s, (c0, c1, c2, c3)
    v = (
        t * _product_of_columns(f, k, rows, cofactors),
        t * _product_of_columns(f, k + 1, rows, cofactors),
        t * _product_of_columns(f, k + 2, rows, cofactors),
    )
    least = _trace(f, k, rows[0])
    return (
        0.125 * (_trace(f, k, rows[1]) - least) + inner(v, arms[0]),
        0.125 * (_trace(f, k, rows[2]) - least) + inner(v, arms[1]),
        0.125 * (_trace(f, k, rows[3]) - least) + inner(v, arms[2]),
    )


def _trace(f: Floats, k: int, row: int) -> Any:
    return f[row, k] + f[row, k + 4] + f[row, k + 8]


def _product_of_columns(f: Floats, k: int, rows: Corners, c: tuple[Vector, Vector, Vector, Vector]) -> Any:
    """Return the sum over four rows of the products of columns k, k + 3 and k + 6 with a vector."""
    return (
        f[rows[0], k] * c[0][0] + f[rows[0], k + 3] * c[0][1] + f[rows[0], k + 6] * c[0][2]
        + f[rows[1], k] * c[1][0] + f[rows[1], k + 3] * c[1][1] + f[rows[1], k + 6] * c[1][2]
        + f[rows[2], k] * c[2][0] + f[rows[2], k + 3] * c[2][1] + f[rows[2], k + 6] * c[2][2]
        + f[rows[3], k] * c[3][0] + f[rows[3], k + 3] * c[3][1] + f[rows[3], k + 6] * c[3][2]
    )  # fmt: skip


def _excess_at_walls(
    f: Floats,
    k: int,
    rows: Corners,
    free: Weights,
    arms: tuple[Vector, Vector, Vector],
    sides: tuple[Vector, Vector, Vector],
    s: float,
) -> Vector:
    """Return :func:`_excess` where some edges do not bend."""
    (a, b, c, d), (fa, fb, fc, fd), (p, q, r), (c1, c2, c3) = rows, free, arms, sides
    c0 = -c1[0] - c2[0] - c3[0], -c1[1] - c2[1] - c3[1], -c1[2] - c2[2] - c3[2]
    ab, ac, ad = _bend(f, k, a, b, p), _bend(f, k, a, c, q), _bend(f, k, a, d, r)
    bc, cd, db = (
        _bend(f, k, b, c, minus(q, p)),
        _bend(f, k, c, d, minus(r, q)),
        _bend(f, k, d, b, minus(p, r)),
    )
    fab, fac, fad, fbc, fcd, fdb = (
        bends(fa, fb), bends(fa, fc), bends(fa, fd), bends(fb, fc), bends(fc, fd), bends(fd, fb)
    )  # fmt: skip
    t = 0.125 * s
    least = fab * inner(c1, ab) + fac * inner(c2, ac) + fad * inner(c3, ad)
    return (
        t * (fab * inner(c0, ab) + fbc * inner(c2, bc) + fdb * inner(c3, db) - least),
        t * (fac * inner(c0, ac) + fbc * inner(c1, bc) + fcd * inner(c3, cd) - least),
        t * (fad * inner(c0, ad) + fdb * inner(c1, db) + fcd * inner(c2, cd) - least),
    )


def _bend(f: Floats, k: int, i: int, j: int, d: Vector) -> Vector:
    """Return (l_i − l_j)·d, from the gradients in columns k on."""
    return _drop(f, k, i, j, d), _drop(f, k + 3, i, j, d), _drop(f, k + 6, i, j, d)


def _drop(f: Floats, k: int, i: int, j: int, d: Vector) -> Any:
    return (
        (f[i, k] - f[j, k]) * d[0] + (f[i, k + 1] - f[j, k + 1]) * d[1] + (f[i, k + 2] - f[j, k + 2]) * d[2]
    )


def curvature(flow: MeshArrays, host: int, x: Vector, t: float) -> Curvature:  # noqa: ARG001
    """Return the second derivatives of the velocity at x, 1/(m s): linear in the tetrahedron ``host``.

    They are constant there if they were not reconstructed at the nodes.
    """
    if flow.curvatures.shape[0] == 0:
        return curvature_of_nodes(flow, host, x, flow.nodes, GRADIENT, 0)
    h = blend_curvature(flow.curvatures, corners(flow, host, 0), shape(flow, host, x))
    return turned_curvature(flow.layer, x, h) if is_wedge(flow.layer) else h


def curvature_of_nodes(flow: MeshArrays, host: int, x: Vector, f: Floats, k: int, first: int) -> Curvature:
    """Return :func:`curvature_in`; in a wedge with the change of the gradient about the axis, at x."""
    h = curvature_in(flow, host, f, k, first)
    if not is_wedge(flow.layer):
        return h
    (a, b, c, d), at, w = nodes_of(flow, host), corners(flow, host, first), shape(flow, host, x)
    # Also for arrays of hosts and points.
    p, q = distance(flow.layer, point(flow.nodes, a)), distance(flow.layer, point(flow.nodes, b))
    r, s = distance(flow.layer, point(flow.nodes, c)), distance(flow.layer, point(flow.nodes, d))
    least = 1e-6 * np.maximum(np.maximum(p, q), np.maximum(r, s))
    l = (
        blend(f, k, at, w), blend(f, k + 1, at, w), blend(f, k + 2, at, w),
        blend(f, k + 3, at, w), blend(f, k + 4, at, w), blend(f, k + 5, at, w),
        blend(f, k + 6, at, w), blend(f, k + 7, at, w), blend(f, k + 8, at, w),
    )  # fmt: skip
    n, change = change_around(flow.layer, np.maximum(distance(flow.layer, x), least), l)
    g = curvature_of(scale(n[0], change), scale(n[1], change), scale(n[2], change))
    h = (
        plus(h[0], g[0]), plus(h[1], g[1]), plus(h[2], g[2]),
        plus(h[3], g[3]), plus(h[4], g[4]), plus(h[5], g[5]),
    )  # fmt: skip
    return turned_curvature(flow.layer, x, h)


def blend_curvature(f: NDArray[np.float32], nodes: Corners, w: Weights) -> Curvature:
    """Interpolate second derivatives between four rows of their table."""
    return (
        _blend_vector(f, 0, nodes, w), _blend_vector(f, 3, nodes, w), _blend_vector(f, 6, nodes, w),
        _blend_vector(f, 9, nodes, w), _blend_vector(f, 12, nodes, w), _blend_vector(f, 15, nodes, w),
    )  # fmt: skip


def _blend_vector(f: Any, k: int, nodes: Corners, w: Weights) -> Vector:
    return blend(f, k, nodes, w), blend(f, k + 1, nodes, w), blend(f, k + 2, nodes, w)


def curvature_in(flow: MeshArrays, host: int, f: Floats, k: int, first: int) -> Curvature:
    """Return second derivatives from a table with a row for each node, from row ``first`` on.

    The gradient, from column k on, is linear in a tetrahedron; its derivatives are constant there.
    """
    _, c1, c2, c3, volume = frame(flow, host)
    nodes = corners(flow, host, first)
    s = 1.0 / volume
    return curvature_of(
        _slopes(f, k, nodes, (s * c1[0], s * c2[0], s * c3[0])),
        _slopes(f, k, nodes, (s * c1[1], s * c2[1], s * c3[1])),
        _slopes(f, k, nodes, (s * c1[2], s * c2[2], s * c3[2])),
    )


def _slopes(f: Floats, k: int, nodes: Corners, w: Vector) -> Tensor:
    """Return the derivative of nine columns from k on along an axis; ``w`` derives the weights 1, 2 and 3."""
    return (
        _slope(f, k, nodes, w), _slope(f, k + 1, nodes, w), _slope(f, k + 2, nodes, w),
        _slope(f, k + 3, nodes, w), _slope(f, k + 4, nodes, w), _slope(f, k + 5, nodes, w),
        _slope(f, k + 6, nodes, w), _slope(f, k + 7, nodes, w), _slope(f, k + 8, nodes, w),
    )  # fmt: skip


def _slope(f: Floats, k: int, nodes: Corners, w: Vector) -> float:
    a, b, c, d = nodes
    o = f[a, k]
    return w[0] * (f[b, k] - o) + w[1] * (f[c, k] - o) + w[2] * (f[d, k] - o)  # type: ignore[no-any-return]


def blend(f: Floats, k: int, nodes: Corners, w: Weights) -> float:
    """Interpolate column k of a table between four of its rows."""
    a, b, c, d = nodes
    return w[0] * f[a, k] + w[1] * f[b, k] + w[2] * f[c, k] + w[3] * f[d, k]  # type: ignore[no-any-return]


def walk(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Go from x0, in the tetrahedron ``host``, straight to x1.

    Returns
    -------
    host, fraction, patch, triangle
        ``(tetrahedron of x1, 1, −1, −1)`` when x1 was reached; ``(last tetrahedron, fraction of the segment,
        patch, boundary triangle)`` when the boundary was crossed there; patch −2 when the walk failed.
    """
    return _look_and_follow(flow, host, host, x0, x1)


def walk_on(flow: MeshArrays, host: int, ahead: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Walk with a hint: an earlier path from x0 to a point near x1 ended in the tetrahedron ``ahead``.

    If that holds x1, the path is not followed again; see :func:`walk`.
    """
    return _look_and_follow(flow, host, ahead, x0, x1)


def _look_and_follow(
    flow: MeshArrays, host: int, ahead: int, x0: Vector, x1: Vector
) -> tuple[int, float, int, int]:
    if holds(flow, ahead, x1) and is_sound(flow, ahead):
        return ahead, 1.0, REACHED, NO_TRIANGLE
    found, fraction, patch, triangle, _ = follow(flow, host, x0, x1)
    return found, fraction, patch, triangle


def holds(flow: MeshArrays, tet: int, x: Vector) -> bool:
    """Return True if a sound tetrahedron holds x, to round-off."""
    origin, c1, c2, c3, volume = frame(flow, tet)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    return min(w0, w1, w2, w3) >= -TOLERANCE * volume


def is_sound(flow: MeshArrays, tet: int) -> bool:
    """Return True if the cell of a tetrahedron is neither flat nor folded."""
    return flow.folds[flow.tets[tet, 0] - flow.n_points] == SOUND  # type: ignore[no-any-return]


@separate
def follow(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int, int]:
    """Follow the segment from x0, in the tetrahedron ``host``, to x1, through the faces on its way.

    A face is crossed at the fraction of the whole segment where its barycentric weight vanishes, which does
    not drift with the number of crossings. A path that circles about an edge or a vertex starts again from a
    point moved towards the middle of the host by 1e-8 of its size, then by more. A path that enters a flat or
    folded cell is computed by :func:`foamprb.flow.mesh.folds.trace`.

    Returns
    -------
    See :func:`walk`; and the number of cells that the path enters, 0 if that is not known.
    """
    neighbours = flow.neighbours
    if not is_sound(flow, host):
        return uncounted(find_thread(flow, host, x0, x1))
    for attempt in range(_ATTEMPTS):
        start = x0
        if attempt > 0:
            m, nudge = _blend3(flow, host, _INSIDE), 1e-10 * 100.0**attempt
            start = between(x0, m, nudge)
        tet, came_from, progress, stalls, entered = host, -1, 0.0, 0, 0
        for _ in range(_MOST_CROSSINGS):
            face, fraction = way_out(flow, tet, came_from, start, x1)
            if face == WITHIN:
                return tet, 1.0, REACHED, NO_TRIANGLE, entered
            if face < 0:
                break
            other = neighbours[tet, face]
            if other < 0:
                triangle = -1 - other
                fraction = min(max(fraction, 0.0), 1.0)
                return tet, fraction, flow.triangle_patch[triangle], triangle, entered
            stalls = 0 if fraction > progress + 1e-12 else stalls + 1
            if stalls > _MOST_STALLS:
                break
            progress = max(progress, fraction)
            entered += flow.tets[other, 0] != flow.tets[tet, 0]
            tet, came_from = other, tet
            if not is_sound(flow, tet):
                return uncounted(find_thread(flow, host, x0, x1))
    return uncounted(find_thread(flow, host, x0, x1))


def way_out(flow: MeshArrays, tet: int, came_from: int, x0: Vector, x1: Vector) -> tuple[int, float]:
    """Return the face by which the segment from x0 to x1 leaves a tetrahedron, and the fraction there.

    The face is :data:`WITHIN` if x1 lies inside, and −1 if none is found. ``came_from`` is the tetrahedron
    before, −1 for none: the path does not turn back.
    """
    origin, c1, c2, c3, volume = frame(flow, tet)
    end = weights(origin, c1, c2, c3, volume, x1)
    slack = -TOLERANCE * volume
    if min(end[0], end[1], end[2], end[3]) >= slack:
        return WITHIN, 1.0
    begin = weights(origin, c1, c2, c3, volume, x0)
    face, fraction, first = -1, 0.0, np.inf
    for k in range(4):
        w0, w1 = begin[k], end[k]
        if w0 <= w1 or w1 >= slack:
            continue
        other = flow.neighbours[tet, k]
        if other >= 0 and other == came_from:
            continue
        s = w0 / (w0 - w1)
        # At the rim of a wall the path inside is preferred.
        rank = s + (0.0 if other >= 0 else TOLERANCE)
        if rank < first:
            face, fraction, first = k, s, rank
    return face, fraction


def uncounted(path: tuple[int, float, int, int]) -> tuple[int, float, int, int, int]:
    """Return a path of :func:`find_thread` as :func:`follow` does, with an unknown number of cells."""
    return path[0], path[1], path[2], path[3], 0


def find_thread(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Run :func:`foamprb.flow.mesh.folds.trace`, and again from another tetrahedron at x0 if it fails."""
    found, fraction, patch, triangle = trace(flow, host, x0, x1)
    if patch == FAILED:
        other = seek(flow, x0, minus(x1, x0))
        if other >= 0:
            return trace(flow, other, x0, x1)
    return found, fraction, patch, triangle


def recover(flow: MeshArrays, x: Vector) -> int:
    """Return the tetrahedron that holds x, found by the tree; −1 if x lies outside the mesh."""
    return locate(flow, x)


def cell_volume(flow: MeshArrays, host: int) -> float:
    """Return the volume of the cell of a tetrahedron, bounded by triangles, m³."""
    cell = flow.tets[host, 0] - flow.n_points
    volume = 0.0
    for tet in range(flow.cell_start[cell], flow.cell_start[cell + 1]):
        volume += frame(flow, tet)[4]
    return volume / 6.0


def normal(flow: MeshArrays, triangle: int, x: Vector) -> Vector:  # noqa: ARG001
    """Return the unit normal of a boundary triangle, pointing into the mesh, the same at every x."""
    return inward(flow, triangle)


def inward(flow: MeshArrays, triangle: int) -> Vector:
    """Return the unit normal of a boundary triangle, pointing into the mesh."""
    return point(flow.triangle_normals, triangle)


def cross(flow: MeshArrays, triangle: int, x: Vector) -> tuple[int, Vector, Tensor]:
    """Go from x on a triangle of a coupled patch to where the neighbouring patch continues it.

    Returns
    -------
    host, x, turn
        The tetrahedron behind the neighbouring face that holds the point, −1 if the patch is not coupled; the
        point; the rotation from this side to the other. Where the two sides are cut into different faces, the
        point may lie between them, outside the mesh: then the nearest tetrahedron.
    """
    first, end = flow.across[triangle, 0], flow.across[triangle, 1]
    m, k = flow.motions, flow.triangle_patch[triangle]
    turn = (m[k, 0], m[k, 1], m[k, 2], m[k, 3], m[k, 4], m[k, 5], m[k, 6], m[k, 7], m[k, 8])
    y = plus(dot_vector(turn, x), (m[k, 9], m[k, 10], m[k, 11]))
    host, depth = _NO_TET, -np.inf
    for place in range(first, end):
        tet = int(flow.triangle_tet[flow.partners[place]])
        origin, c1, c2, c3, volume = frame(flow, tet)
        if volume != 0.0:
            w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, y)
            smallest = min(w0 / volume, w1 / volume, w2 / volume, w3 / volume)
            if smallest > depth:
                host, depth = tet, smallest
    if depth < -_APART and first < end:
        # Surfaces that are cut into different faces lie apart, or overlap, by the difference of their chords.
        nearest = _nearest(flow, first, end, y)
        host, _, patch, _, _ = follow(flow, nearest, middle_of(flow, nearest), y)
        host = nearest if patch == FAILED else host
    elif host >= 0 and depth < 0.0:
        origin, c1, c2, c3, volume = frame(flow, host)
        w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, y)
        s = 1.0 / volume
        w0, w1, w2, w3 = max(s * w0, 0.0), max(s * w1, 0.0), max(s * w2, 0.0), max(s * w3, 0.0)
        s = 1.0 / (w0 + w1 + w2 + w3)
        y = _blend3(flow, host, (s * w0, s * w1, s * w2, s * w3))
    return host, y, turn


def middle_of(flow: MeshArrays, tet: int) -> Vector:
    """Return the middle of a tetrahedron."""
    return _blend3(flow, tet, _MIDDLE)


def _blend3(flow: MeshArrays, tet: int, w: Weights) -> Vector:
    """Return the point of a tetrahedron with these weights."""
    nodes, at = flow.nodes, corners(flow, tet, 0)
    return blend(nodes, 0, at, w), blend(nodes, 1, at, w), blend(nodes, 2, at, w)


def _nearest(flow: MeshArrays, first: int, end: int, y: Vector) -> int:
    """Return the tetrahedron behind the triangle nearest to y among ``partners`` across."""
    host, least, nodes = _NO_TET, np.inf, flow.nodes
    for place in range(first, end):
        triangle = int(flow.partners[place])
        a, b, c = flow.triangles[triangle, 0], flow.triangles[triangle, 1], flow.triangles[triangle, 2]
        p = nearest_point(arm(nodes, a, y), arm(nodes, b, y), arm(nodes, c, y))
        if inner(p, p) < least:
            host, least = int(flow.triangle_tet[triangle]), inner(p, p)
    return host


def nearest_point(a: Vector, b: Vector, c: Vector) -> Vector:
    """Return the point of a triangle nearest to the origin (Ericson, Real-Time Collision Detection, 2005)."""
    ab, ac = minus(b, a), minus(c, a)
    d1, d2 = -inner(ab, a), -inner(ac, a)
    d3, d4 = -inner(ab, b), -inner(ac, b)
    d5, d6 = -inner(ab, c), -inner(ac, c)
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    v, w = 0.0, 0.0
    if d1 <= 0.0 and d2 <= 0.0:
        v, w = 0.0, 0.0
    elif d3 >= 0.0 and d4 <= d3:
        v, w = 1.0, 0.0
    elif d6 >= 0.0 and d5 <= d6:
        v, w = 0.0, 1.0
    elif vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        v, w = d1 / (d1 - d3), 0.0
    elif vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        v, w = 0.0, d2 / (d2 - d6)
    elif va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        v = 1.0 - w
    else:
        s = 1.0 / (va + vb + vc)
        v, w = vb * s, vc * s
    return a[0] + v * ab[0] + w * ac[0], a[1] + v * ab[1] + w * ac[1], a[2] + v * ab[2] + w * ac[2]
