"""Exact relaxation of the elastic stress over a step, for a body without inertia.

The stiff term of dF/dt = l_s F is the solid's elasticity. Without the off-diagonal components of the elastic
stretch, its linear part Y ↦ J Y, the change of l_s along H = Y F, couples in the particle frame only the
components ij and ji, and the three ii (:mod:`foamprb.body.stokes`). The former blocks are of rank one, the
latter of rank two. The functions

    φ₁(z) = (eᶻ − 1)/z,   φ_{k+1}(z) = (φ_k(z) − 1/k!)/z

of h J, by which an exponential integrator advances (Hochbruck & Ostermann, Acta Numerica 19, 2010), therefore
have closed forms in five rates: φ_k(hJ) Y = Y/k! + h φ_{k+1}(hJ) J Y, with φ_{k+1} on the range of J only.
All tensors are components in the particle frame of the step's start.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.rosenbrock import Elasticity
from foamprb.body.stokes import Mobility
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    diagonal,
    dot,
    dot_vector,
    scale,
    select,
    trace,
)

Phi = tuple[Scalar, Scalar, Scalar, Scalar, Scalar]
"""eᶻ, φ₁(z), φ₂(z), φ₃(z) and φ₄(z)."""

_TINY = 1e-300
# Beyond, eᶻ is negligible beside 1, or the step is rejected anyway.
_LARGEST = 40.0


def _power_64(x: Scalar) -> Scalar:
    x = x * x
    x = x * x
    x = x * x
    x = x * x
    x = x * x
    return x * x


def phi_functions(z: Scalar) -> Phi:
    """Return the functions to 1e-13 for z ≤ 40, without a branch or a library call.

    Below |z| = 1 they follow from the series of φ₄ by φ_k = 1/k! + z φ_{k+1}, beyond it from
    eᶻ = (e^(z/64))⁶⁴ by φ_{k+1} = (φ_k − 1/k!)/z.
    """
    w = np.maximum(np.minimum(z, _LARGEST), -_LARGEST) * (1.0 / 64.0)
    s = 1.0 / 479001600.0 + w * (1.0 / 6227020800.0)
    s = 1.0 / 39916800.0 + w * s
    s = 1.0 / 3628800.0 + w * s
    s = 1.0 / 362880.0 + w * s
    s = 1.0 / 40320.0 + w * s
    s = 1.0 / 5040.0 + w * s
    s = 1.0 / 720.0 + w * s
    s = 1.0 / 120.0 + w * s
    s = 1.0 / 24.0 + w * s
    s = 1.0 / 6.0 + w * s
    s = 1.0 / 2.0 + w * s
    s = 1.0 + w * s
    e = _power_64(1.0 + w * s)

    small = abs(z) < 1.0
    y = select(small, z, 0.0)
    near4 = 1.0 / 20922789888000.0 + y * (1.0 / 355687428096000.0)
    near4 = 1.0 / 1307674368000.0 + y * near4
    near4 = 1.0 / 87178291200.0 + y * near4
    near4 = 1.0 / 6227020800.0 + y * near4
    near4 = 1.0 / 479001600.0 + y * near4
    near4 = 1.0 / 39916800.0 + y * near4
    near4 = 1.0 / 3628800.0 + y * near4
    near4 = 1.0 / 362880.0 + y * near4
    near4 = 1.0 / 40320.0 + y * near4
    near4 = 1.0 / 5040.0 + y * near4
    near4 = 1.0 / 720.0 + y * near4
    near4 = 1.0 / 120.0 + y * near4
    near4 = 1.0 / 24.0 + y * near4
    near3 = 1.0 / 6.0 + y * near4
    near2 = 0.5 + y * near3
    near1 = 1.0 + y * near2

    r = 1.0 / select(small, 1.0, z)
    far1 = (e - 1.0) * r
    far2 = (far1 - 1.0) * r
    far3 = (far2 - 0.5) * r
    far4 = (far3 - 1.0 / 6.0) * r
    return (
        select(small, 1.0 + y * near1, e),
        select(small, near1, far1),
        select(small, near2, far2),
        select(small, near3, far3),
        select(small, near4, far4),
    )


def phi_of_twice(p: Phi) -> Phi:
    """Return the functions of 2z from those of z: φ_k(2z) = 2⁻ᵏ (eᶻ φ_k(z) + Σ_{j=1}^{k} φ_j(z)/(k − j)!)."""
    e, p1, p2, p3, p4 = p
    return (
        e * e,
        0.5 * (e * p1 + p1),
        0.25 * (e * p2 + p1 + p2),
        0.125 * (e * p3 + 0.5 * p1 + p2 + p3),
        0.0625 * (e * p4 + p1 * (1.0 / 6.0) + 0.5 * p2 + p3 + p4),
    )


class Relaxation(NamedTuple):
    """Linear part J of the elastic relaxation, 1/s."""

    squares: Vector
    """e_a², the squared elastic stretches."""
    upper: Vector
    """Y_23, Y_13, Y_12 of J Y for unit Y_ij e_j² + Y_ji e_i²."""
    lower: Vector
    """Y_32, Y_31, Y_21 likewise."""
    normal: Tensor
    """(J Y)_aa for unit Y_cc; its columns sum to zero."""


def relaxation(m: Mobility, e: Elasticity, mu_f: Scalar) -> Relaxation:
    """Return J; the elasticity is that without the resistance to dilation, μ_f in Pa s."""
    h = 1.0 / mu_f
    s, k = e.shear, m.compliance
    c1, c2, c3 = -0.5 * h * s[0] * k[0], -0.5 * h * s[1] * k[1], -0.5 * h * s[2] * k[2]
    p, q, r = m.slip
    return Relaxation(
        e.squares,
        (c1 * (1.0 + p), c2 * (1.0 + q), c3 * (1.0 + r)),
        (c1 * (1.0 - p), c2 * (1.0 - q), c3 * (1.0 - r)),
        scale(h, dot(m.normal, e.slopes)),
    )


def _stretchings(n: Relaxation, Y: Tensor) -> Vector:
    """Return Y_ij e_j² + Y_ji e_i² of the pairs 23, 13 and 12."""
    x, y, z = n.squares
    return Y[5] * z + Y[7] * y, Y[2] * z + Y[6] * x, Y[1] * y + Y[3] * x


def _tensor(n: Relaxation, d: Vector, s: Vector) -> Tensor:
    """Return the tensor with the diagonal d and the off-diagonal components by the stretchings s."""
    u, l = n.upper, n.lower
    return (
        d[0], u[2] * s[2], u[1] * s[1],
        l[2] * s[2], d[1], u[0] * s[0],
        l[1] * s[1], l[0] * s[0], d[2],
    )  # fmt: skip


def relaxing(n: Relaxation, Y: Tensor) -> Tensor:
    """Return J Y, the change of l_s by the elastic stress along H = Y F."""
    return _tensor(n, dot_vector(n.normal, diagonal(Y)), _stretchings(n, Y))


def _rates(n: Relaxation) -> tuple[Vector, Scalar, Scalar]:
    """Return the eigenvalues of J: of the three pairs, and the two of the normal components."""
    x, y, z = n.squares
    u, l = n.upper, n.lower
    pairs = (u[0] * z + l[0] * y, u[1] * z + l[1] * x, u[2] * y + l[2] * x)
    A = n.normal
    mean = 0.5 * trace(A)
    minors = A[0] * A[4] - A[1] * A[3] + A[0] * A[8] - A[2] * A[6] + A[4] * A[8] - A[5] * A[7]
    half = np.sqrt(np.maximum(mean * mean - minors, 0.0))
    return pairs, mean - half, mean + half


def fastest(n: Relaxation) -> Scalar:
    """Return the fastest rate of J, 1/s, or up to twice it: the two normal rates count with their sum."""
    x, y, z = n.squares
    u, l = n.upper, n.lower
    first, second = abs(u[0] * z + l[0] * y), abs(u[1] * z + l[1] * x)
    third, normal = abs(u[2] * y + l[2] * x), abs(trace(n.normal))
    return np.maximum(np.maximum(first, second), np.maximum(third, normal))


class Response(NamedTuple):
    """h² φ₂, h² φ₃ and h² φ₄ of h J on its range, for one h, s²."""

    pairs: Tensor
    """Those of the pairs 23, 13, 12, one row each."""
    along: Vector
    """Factors of J for the normal components, s²."""
    bent: Vector
    """Factors of J², s³. On the range, both together equal the functions of the two normal rates."""


def _response(p: Phi, q: Phi, r: Phi, s: Phi, t: Phi, h: Scalar, a: Scalar, b: Scalar) -> Response:
    """Return the response from the functions of the pairs' rates and of the two normal rates a and b."""
    z1, z2 = h * a, h * b
    d, centre, h2 = 1.0 / (z2 - z1 + _TINY), 0.5 * (z1 + z2), h * h
    x, y, z = (t[2] - s[2]) * d, (t[3] - s[3]) * d, (t[4] - s[4]) * d
    return Response(
        (
            h2 * p[2], h2 * p[3], h2 * p[4],
            h2 * q[2], h2 * q[3], h2 * q[4],
            h2 * r[2], h2 * r[3], h2 * r[4],
        ),
        (
            h2 * (0.5 * (s[2] + t[2]) - centre * x),
            h2 * (0.5 * (s[3] + t[3]) - centre * y),
            h2 * (0.5 * (s[4] + t[4]) - centre * z),
        ),
        (h2 * (h * x), h2 * (h * y), h2 * (h * z)),
    )  # fmt: skip


def responses(n: Relaxation, h: Scalar) -> tuple[Response, Response]:
    """Return the functions for a quarter of the step h, s, and for the whole step."""
    (a, b, c), d, e = _rates(n)
    f = 0.25 * h
    p, q, r = phi_functions(f * a), phi_functions(f * b), phi_functions(f * c)
    s, t = phi_functions(f * d), phi_functions(f * e)
    quarter = _response(p, q, r, s, t, f, d, e)
    p, q, r = phi_of_twice(phi_of_twice(p)), phi_of_twice(phi_of_twice(q)), phi_of_twice(phi_of_twice(r))
    s, t = phi_of_twice(phi_of_twice(s)), phi_of_twice(phi_of_twice(t))
    return quarter, _response(p, q, r, s, t, h, d, e)


def respond(n: Relaxation, r: Response, h: Scalar, Y1: Tensor, Y2: Tensor, Y3: Tensor) -> Tensor:
    """Return h (φ₁(hJ) Y₁ + φ₂(hJ) Y₂ + φ₃(hJ) Y₃), the response to rates Y₁ + Y₂ t/h + ½ Y₃ (t/h)², 1/s.

    ``r`` are the functions for the step ``h``, s.
    """
    p1, p2, p3 = _stretchings(n, Y1), _stretchings(n, Y2), _stretchings(n, Y3)
    f = r.pairs
    s = (
        f[0] * p1[0] + f[1] * p2[0] + f[2] * p3[0],
        f[3] * p1[1] + f[4] * p2[1] + f[5] * p3[1],
        f[6] * p1[2] + f[7] * p2[2] + f[8] * p3[2],
    )
    d1, d2, d3 = diagonal(Y1), diagonal(Y2), diagonal(Y3)
    d = _along(n, _sum(r.along, d1, d2, d3), _sum(r.bent, d1, d2, d3))
    free = add(add(Y1, scale(0.5, Y2)), scale(1.0 / 6.0, Y3))
    return add(scale(h, free), _tensor(n, d, s))


def respond_to_constant(n: Relaxation, r: Response, h: Scalar, Y: Tensor) -> Tensor:
    """Return h φ₁(hJ) Y, :func:`respond` for a rate Y."""
    f = r.pairs
    return _respond_to(n, (f[0], f[3], f[6]), r.along[0], r.bent[0], h, Y)


def respond_to_slope(n: Relaxation, r: Response, h: Scalar, Y: Tensor) -> Tensor:
    """Return h φ₂(hJ) Y, :func:`respond` for a rate Y t/h."""
    f = r.pairs
    return _respond_to(n, (f[1], f[4], f[7]), r.along[1], r.bent[1], 0.5 * h, Y)


def _respond_to(n: Relaxation, f: Vector, along: Scalar, bent: Scalar, free: Scalar, Y: Tensor) -> Tensor:
    p = _stretchings(n, Y)
    a, b = (along * Y[0], along * Y[4], along * Y[8]), (bent * Y[0], bent * Y[4], bent * Y[8])
    return add(scale(free, Y), _tensor(n, _along(n, a, b), (f[0] * p[0], f[1] * p[1], f[2] * p[2])))


def _along(n: Relaxation, a: Vector, b: Vector) -> Vector:
    """Return J a + J² b of the normal components."""
    c = dot_vector(n.normal, b)
    return dot_vector(n.normal, (a[0] + c[0], a[1] + c[1], a[2] + c[2]))


def _sum(w: Vector, a: Vector, b: Vector, c: Vector) -> Vector:
    return (
        w[0] * a[0] + w[1] * b[0] + w[2] * c[0],
        w[0] * a[1] + w[1] * b[1] + w[2] * c[1],
        w[0] * a[2] + w[1] * b[2] + w[2] * c[2],
    )
