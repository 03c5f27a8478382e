"""Integrals over the exterior of an ellipsoid, and its shape measures.

The integrals are Jeffery's (B.2), (B.4), (B.9). Each is a Carlson R-function of the squared semi-axes. One
duplication sum with positive terms serves all of them, without loss of digits from a sphere to axis ratios of
1000.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.tensor import Scalar, Tensor, Vector, from_rows, norm, reciprocals, rows, select, vector_dot

_DUPLICATIONS, _FEW_DUPLICATIONS = 5, 3
COMPACT = 4.0
"""Largest axis ratio for :func:`integrals_of_compact`."""


class Integrals(NamedTuple):
    """Jeffery's integrals, with Δ² = (a²+λ)(b²+λ)(c²+λ) and λ from 0 to ∞."""

    alpha: Vector
    """α₀ = ∫dλ/((a²+λ)Δ), β₀, γ₀ (B.2); 1/length³."""
    ring: Vector
    """α₀° = ∫dλ/((b²+λ)(c²+λ)Δ), β₀°, γ₀° (B.9); 1/length⁵."""
    star: Vector
    """α₀* = ∫λdλ/((b²+λ)(c²+λ)Δ), β₀*, γ₀* (B.4); 1/length³."""
    chi: Scalar
    """χ = ∫dλ/Δ; 1/length."""


def _ring_tail(x: Scalar, y: Scalar, z: Scalar, inverse: Scalar) -> Scalar:
    """Return m^{5/2} ∫dλ/((y+λ)(z+λ)Δ) for nearly equal x, y, z (squared semi-axes) by its series about m.

    ``inverse`` is 1/m of the mean m = (x + 3y + 3z)/7. The integral is (2/5) R_{-5/2}(1/2, 3/2, 3/2; x, y,
    z). Its series in the power sums of the relative deviations 1 − x/m, 1 − y/m and 1 − z/m (Carlson 1979) is
    arranged by x/m − 1 and the square of (y − z)/m, which determine all three. It is truncated before the
    eighth order.
    """
    s, d = x * inverse - 1.0, (y - z) * inverse
    t = d * d
    p = s * (
        581.0 / 22464.0 - s * (763.0 / 38880.0 - s * (102445.0 / 6345216.0 - s * (286233.0 / 21275136.0)))
    )
    p = 2.0 / 5.0 + s * s * (7.0 / 108.0 - s * (35.0 / 1188.0) + s * p)
    q = 9.0 / 416.0 - s * (1.0 / 432.0 - s * (1475.0 / 235008.0 - s * (1021.0 / 262656.0)))
    q = 1.0 / 12.0 + s * (1.0 / 44.0 + s * q)
    r = 15.0 / 832.0 + s * (1.0 / 96.0 + s * (205.0 / 26112.0 + s * (15.0 / 9728.0)))
    return p + t * (q + t * (r + t * (35.0 / 8704.0 + s * (35.0 / 9728.0))))


def _tails(x: Scalar, y: Scalar, z: Scalar) -> tuple[Scalar, Scalar, Scalar, Scalar]:
    """Return :func:`_ring_tail`'s integral for x, y and z in turn, and 2/√(xyz), for nearly equal x, y, z.

    Divisions and roots dominate the cost. One division gives all reciprocals. One root is that of the common
    mean; a series in the deviation from it, below 0.013, gives the others.
    """
    p, q, r = (
        (x + 3.0 * (y + z)) * (1.0 / 7.0),
        (y + 3.0 * (z + x)) * (1.0 / 7.0),
        (z + 3.0 * (x + y)) * (1.0 / 7.0),
    )
    mean = (x + y + z) * (1.0 / 3.0)
    both, v, w = reciprocals((p * mean, q, r))
    u, inverse = mean * both, p * both
    root = np.sqrt(inverse)
    return (
        _ring_tail(x, y, z, u) * (u * u * (root * _reciprocal_root(p * inverse - 1.0))),
        _ring_tail(y, z, x, v) * (v * v * (root * _reciprocal_root(q * inverse - 1.0))),
        _ring_tail(z, x, y, w) * (w * w * (root * _reciprocal_root(r * inverse - 1.0))),
        2.0 * inverse * (root * _reciprocal_root((x * inverse) * (y * inverse) * (z * inverse) - 1.0)),
    )


def _reciprocal_root(e: Scalar) -> Scalar:
    """Return 1/√(1 + e) for |e| below 0.013, to round-off."""
    s = 231.0 / 1024.0 - e * (429.0 / 2048.0)
    s = 35.0 / 128.0 - e * (63.0 / 256.0 - e * s)
    s = 3.0 / 8.0 - e * (5.0 / 16.0 - e * s)
    return 1.0 - e * (1.0 / 2.0 - e * s)


def integrals_of_compact(semi_axes: Vector) -> Integrals:
    """Return :func:`integrals` by two duplications fewer, to 3e-15 for axis ratios up to :data:`COMPACT`."""
    return _duplicated(semi_axes, _FEW_DUPLICATIONS)


def integrals(semi_axes: Vector) -> Integrals:
    """Return Jeffery's integrals for an ellipsoid with the semi-axes a, b, c > 0, in any order and unit.

    Duplication: with s_x = √x etc. and Λ = s_x s_y + s_y s_z + s_z s_x, the squares x, y, z are replaced by
    (x+Λ)/4 = (s_x+s_y)(s_x+s_z)/4, …. Step n contributes 2·4⁻ⁿ/(s_x(s_x+s_y)(s_x+s_z)) to α₀, and the
    analytical divided differences of these terms give α₀° (B.10). α₀* = β₀ − c²α₀° with the smaller of b and
    c. Relative error below 1e-13 for axis ratios up to 1000.
    """
    return _duplicated(semi_axes, _DUPLICATIONS)


def _duplicated(semi_axes: Vector, times: int) -> Integrals:
    a, b, c = semi_axes
    x, y, z = a * a, b * b, c * c
    x0, y0, z0 = x, y, z
    zero = 0.0 * a
    alpha, beta, gamma = zero, zero, zero
    alpha_ring, beta_ring, gamma_ring = zero, zero, zero
    weight = 1.0
    sx, sy, sz = a, b, c
    for _ in range(times):
        p, q, r = sy + sz, sz + sx, sx + sy
        # d = 1/(s_x s_y s_z p q r)
        product = sx * sy * sz
        d = 1.0 / (product * p * q * r)
        alpha = alpha + weight * (2.0 * d) * (p * sy * sz)
        beta = beta + weight * (2.0 * d) * (q * sz * sx)
        gamma = gamma + weight * (2.0 * d) * (r * sx * sy)
        common = (2.0 * weight * weight) * (sx + sy + sz) * product * d * d
        alpha_ring = alpha_ring + common * (sx * q * r)
        beta_ring = beta_ring + common * (sy * r * p)
        gamma_ring = gamma_ring + common * (sz * p * q)
        x, y, z = 0.25 * q * r, 0.25 * r * p, 0.25 * p * q
        sx, sy, sz = np.sqrt(x), np.sqrt(y), np.sqrt(z)
        weight = 0.25 * weight

    tail_alpha, tail_beta, tail_gamma, total = _tails(x, y, z)
    # α₀ + β₀ + γ₀ = 2/(abc) and (B.10), well conditioned once the axes are nearly equal.
    third = weight * (1.0 / 3.0)
    alpha = alpha + third * (total + (y - x) * tail_gamma + (z - x) * tail_beta)
    beta = beta + third * (total + (z - y) * tail_alpha + (x - y) * tail_gamma)
    gamma = gamma + third * (total + (x - z) * tail_beta + (y - z) * tail_alpha)
    square = weight * weight
    alpha_ring = alpha_ring + square * tail_alpha
    beta_ring = beta_ring + square * tail_beta
    gamma_ring = gamma_ring + square * tail_gamma

    alpha_star = select(z0 < y0, beta - z0 * alpha_ring, gamma - y0 * alpha_ring)
    beta_star = select(x0 < z0, gamma - x0 * beta_ring, alpha - z0 * beta_ring)
    gamma_star = select(y0 < x0, alpha - y0 * gamma_ring, beta - x0 * gamma_ring)
    return Integrals(
        (alpha, beta, gamma),
        (alpha_ring, beta_ring, gamma_ring),
        (alpha_star, beta_star, gamma_star),
        x0 * alpha + y0 * beta + z0 * gamma,
    )


def reach(R: Scalar, F: Tensor, n: Vector) -> Scalar:
    """Return the support function R |Fᵀ·n|, the reach of the ellipsoid along the unit vector n, m."""
    return R * norm(vector_dot(n, F))


@choice
def swelling(mode: Any, inverse_F: Tensor, p: Vector) -> Scalar:  # noqa: ARG001
    """Return 0: the surface is that of the ellipsoid. See :func:`foamprb.body.quadratic.swelling`."""
    return 0.0


@choice
def largest_swelling(mode: Any, inverse_F: Tensor) -> Scalar:  # noqa: ARG001
    """Return 0, the bound of :func:`swelling`."""
    return 0.0


def sorted_frame(Q: Tensor, stretches: Vector) -> tuple[Tensor, Vector]:
    """Return a principal frame with axes in descending order of stretch, still a proper rotation."""
    p, q, r = rows(Q)
    a, b, c = stretches
    a, b, p, q = _in_order(a, b, p, q)
    b, c, q, r = _in_order(b, c, q, r)
    a, b, p, q = _in_order(a, b, p, q)
    return from_rows(p, q, r), (a, b, c)


def _in_order(a: Scalar, b: Scalar, p: Vector, q: Vector) -> tuple[Scalar, Scalar, Vector, Vector]:
    """Return two axes with the longer one first; a swap changes a sign to keep the frame a rotation."""
    swap = a < b
    return (
        select(swap, b, a),
        select(swap, a, b),
        (select(swap, q[0], p[0]), select(swap, q[1], p[1]), select(swap, q[2], p[2])),
        (select(swap, -p[0], q[0]), select(swap, -p[1], q[1]), select(swap, -p[2], q[2])),
    )


def taylor_deformation(a: Scalar, b: Scalar) -> Scalar:
    """Return Taylor's deformation parameter D = (a − b)/(a + b) (54)."""
    return (a - b) / (a + b)
