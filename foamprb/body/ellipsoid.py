"""Integrals over the exterior of an ellipsoid, and its shape measures.

The integrals are Jeffery's (B.2), (B.4), (B.9). Each is a Carlson R-function of the squared semi-axes; one
duplication sum serves all of them, with only positive terms, so that no digit is lost between a sphere and
axis ratios of 1000.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.tensor import Scalar, Tensor, Vector, dot_vector, select, transpose

_DUPLICATIONS, _FEW_DUPLICATIONS = 5, 3
COMPACT = 4.0
"""Axis ratio up to which :func:`integrals_of_compact` holds."""


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


def _ring_tail(x: Scalar, y: Scalar, z: Scalar) -> Scalar:
    """∫dλ/((y+λ)(z+λ)Δ) for nearly equal x, y, z (squared semi-axes), by its series about their mean.

    The integral is (2/5) R_{-5/2}(1/2, 3/2, 3/2; x, y, z), expanded in the power sums of the relative
    deviations (Carlson 1979); the series ends before the eighth order.
    """
    mean = (x + 3.0 * y + 3.0 * z) * (1.0 / 7.0)
    inverse = 1.0 / mean
    X, Y, Z = (mean - x) * inverse, (mean - y) * inverse, (mean - z) * inverse
    p, q, r = 0.5 * X * X, 1.5 * Y * Y, 1.5 * Z * Z
    p2 = p + q + r
    p, q, r = p * X, q * Y, r * Z
    p3 = p + q + r
    p, q, r = p * X, q * Y, r * Z
    p4 = p + q + r
    p, q, r = p * X, q * Y, r * Z
    p5 = p + q + r
    p, q, r = p * X, q * Y, r * Z
    p6 = p + q + r
    p7 = p * X + q * Y + r * Z
    # Products with constants: a division costs as much as ten of them.
    T2 = p2 * (1.0 / 2.0)
    T3 = p3 * (1.0 / 3.0)
    T4 = p4 * (1.0 / 4.0) + p2 * p2 * (1.0 / 8.0)
    T5 = p5 * (1.0 / 5.0) + p2 * p3 * (1.0 / 6.0)
    T6 = p6 * (1.0 / 6.0) + p2 * p4 * (1.0 / 8.0) + p3 * p3 * (1.0 / 18.0) + p2 * p2 * p2 * (1.0 / 48.0)
    T7 = p7 * (1.0 / 7.0) + p2 * p5 * (1.0 / 10.0) + p3 * p4 * (1.0 / 12.0) + p2 * p2 * p3 * (1.0 / 24.0)
    # (5/2)_m / (7/2)_m = 5/(5 + 2m)
    series = (
        1.0
        + (T2 * (5.0 / 9.0) + T3 * (5.0 / 11.0) + T4 * (5.0 / 13.0))
        + (T5 * (5.0 / 15.0) + T6 * (5.0 / 17.0) + T7 * (5.0 / 19.0))
    )
    return 0.4 * series * inverse * inverse * np.sqrt(inverse)


def integrals_of_compact(semi_axes: Vector) -> Integrals:
    """The same as :func:`integrals` with two duplications fewer; 3e-15 off for axis ratios up to 4."""
    return _duplicated(semi_axes, _FEW_DUPLICATIONS)


def integrals(semi_axes: Vector) -> Integrals:
    """Jeffery's integrals for an ellipsoid with the given semi-axes, in any order.

    Duplication: with s = √x and so on, Λ = s_x s_y + s_y s_z + s_z s_x, the squares x, y, z give way to
    (x+Λ)/4, …; what is left of α₀ at step n is 2·4⁻ⁿ/(s_x(s_x+s_y)(s_x+s_z)), and its divided differences,
    taken analytically, give α₀° (B.10). α₀* = β₀ − c²α₀° with the smaller of b and c. Relative error below
    1e-13 for axis ratios up to 1000.

    Parameters
    ----------
    semi_axes
        a, b, c > 0, in any unit of length.
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
    for _ in range(times):
        sx, sy, sz = np.sqrt(x), np.sqrt(y), np.sqrt(z)
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
        shift = sx * sy + sy * sz + sz * sx
        x, y, z = 0.25 * (x + shift), 0.25 * (y + shift), 0.25 * (z + shift)
        weight = 0.25 * weight

    tail_alpha, tail_beta, tail_gamma = _ring_tail(x, y, z), _ring_tail(y, z, x), _ring_tail(z, x, y)
    # α₀ + β₀ + γ₀ = 2/(abc) and (B.10), well conditioned once the axes are nearly equal.
    total = 2.0 / np.sqrt(x * y * z)
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
    """Support function R |Fᵀ·n|: how far the ellipsoid reaches from its centre along the unit vector n, m."""
    h = dot_vector(transpose(F), n)
    return R * np.sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2])


def sorted_frame(Q: Tensor, stretches: Vector) -> tuple[Tensor, Vector]:
    """The principal frame with its axes in falling order of stretch, still a proper rotation.

    Parameters
    ----------
    Q, stretches
        As :func:`foamprb.body.tensor.principal_frame` returns them.
    """
    p, q, r = (Q[0], Q[1], Q[2]), (Q[3], Q[4], Q[5]), (Q[6], Q[7], Q[8])
    a, b, c = stretches
    a, b, p, q = _in_order(a, b, p, q)
    b, c, q, r = _in_order(b, c, q, r)
    a, b, p, q = _in_order(a, b, p, q)
    return (p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2]), (a, b, c)


def _in_order(a: Scalar, b: Scalar, p: Vector, q: Vector) -> tuple[Scalar, Scalar, Vector, Vector]:
    """Two axes with the longer one first; a swap mirrors the frame, the sign makes it a rotation again."""
    swap = a < b
    return (
        select(swap, b, a),
        select(swap, a, b),
        (select(swap, q[0], p[0]), select(swap, q[1], p[1]), select(swap, q[2], p[2])),
        (select(swap, -p[0], q[0]), select(swap, -p[1], q[1]), select(swap, -p[2], q[2])),
    )


def taylor_deformation(a: Scalar, b: Scalar) -> Scalar:
    """Taylor's deformation parameter D = (a − b)/(a + b) (54)."""
    return (a - b) / (a + b)
