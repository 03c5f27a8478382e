"""Stiff terms of a deforming body: its elasticity and, with inertia, the traction by its own deformation.

Both are linear in a small change of the state. They form the J of the integrators
(:mod:`foamprb.body.exponential_runge_kutta`, :mod:`foamprb.body.inertial_runge_kutta`), which are of order 3
for any J. Without the off-diagonal components of the elastic stretch, J couples in the particle frame only
the components ij and ji, and the three ii.

All tensors are components in the particle frame Q of the step's start, unless stated otherwise. Common
arguments:

b, squares
    Elastic b_e (:func:`foamprb.body.material.finger`), and its diagonal e_a² in the particle frame.
J
    det F.
mu, lame, k
    Lamé parameters of the solid, Pa, and its third parameter.
tension
    γ/R, Pa.
semi_axes, g
    a, b, c and their integrals, in one unit of length.
eta
    Viscosity of the solid over that of the fluid.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import Integrals
from foamprb.body.material import derivatives, dilation, invariants
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add_identity,
    diagonal,
    dot,
    dot_vector,
    reciprocals,
    scale,
    subtract,
)
from foamprb.body.traction import shear_factors

_DIFFERENCE, _PER_DIFFERENCE = 1e-6, 1e6

Shear: TypeAlias = tuple[Scalar, Scalar, Scalar, Scalar]
"""Rows of a 2×2 matrix that acts on the components ij and ji, one after the other."""
Pull: TypeAlias = tuple[Scalar, Scalar]
"""Row of such a matrix with two equal rows, as the elastic stress is symmetric."""


class Elasticity(NamedTuple):
    """Derivative of an isotropic solid's Kirchhoff stress where its elastic stretch is diagonal."""

    squares: Vector
    """e_a², the squared elastic stretches."""
    slopes: Tensor
    """∂τ_a/∂ln e_c, Pa."""
    shear: Vector
    """s₂₃, s₁₃, s₁₂, Pa: the change of stress τ_ij along H = X F is s_ij (X_ij e_j² + X_ji e_i²)."""


@choice
def extra_stress(b: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return the Kirchhoff stress up to a pressure, 2(w₁ + I₁w₂) b − 2w₂ b², Pa, in any frame."""
    I1, I2 = invariants(b)
    w1, w2, _ = derivatives(I1, I2, J, mu, lame, k)
    return subtract(scale(2.0 * (w1 + I1 * w2), b), scale(2.0 * w2, dot(b, b)))


def kirchhoff(b: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return the Kirchhoff stress τ = P Fᵀ = 2(w₁ + I₁w₂) b − 2w₂ b² + J w_J I, Pa, in any frame."""
    I1, I2 = invariants(b)
    return add_identity(extra_stress(b, J, mu, lame, k), _pressure(I1, I2, J, mu, lame, k))


def extra_stress_in_frame(b: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return :func:`extra_stress` for a diagonal b: rest shape a sphere, in the particle frame."""
    x, y, z = _principal_extra_stress(diagonal(b), J, mu, lame, k)
    return (x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z)


def kirchhoff_in_frame(b: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return :func:`kirchhoff` for a diagonal b."""
    I1, I2 = _principal_invariants(diagonal(b))
    return add_identity(extra_stress_in_frame(b, J, mu, lame, k), _pressure(I1, I2, J, mu, lame, k))


def _principal_invariants(e: Vector) -> tuple[Scalar, Scalar]:
    return e[0] + e[1] + e[2], e[0] * e[1] + e[1] * e[2] + e[2] * e[0]


def _pressure(I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Scalar:
    _, _, wJ = derivatives(I1, I2, J, mu, lame, k)
    return J * wJ


def _principal_extra_stress(e: Vector, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Vector:
    I1, I2 = _principal_invariants(e)
    w1, w2, _ = derivatives(I1, I2, J, mu, lame, k)
    p, q = 2.0 * (w1 + I1 * w2), 2.0 * w2
    return p * e[0] - q * e[0] * e[0], p * e[1] - q * e[1] * e[1], p * e[2] - q * e[2] * e[2]


def _strained(J: Scalar) -> tuple[Scalar, Scalar]:
    """Return the factor of e_a² and the new J for a small extension along one axis."""
    h = _DIFFERENCE
    return 1.0 + 2.0 * h + 2.0 * h * h, J * (1.0 + h + 0.5 * h * h)


@choice
def extra_elasticity(
    squares: Vector, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar, tension: Scalar
) -> Elasticity:
    """Return :func:`elasticity` of :func:`extra_stress`; columns of the slopes are exact up to a pressure."""
    x, y, z = squares
    tau = _principal_extra_stress((x, y, z), J, mu, lame, k)
    g, Jh = _strained(J)
    tx = _principal_extra_stress((x * g, y, z), Jh, mu, lame, k)
    ty = _principal_extra_stress((x, y * g, z), Jh, mu, lame, k)
    tz = _principal_extra_stress((x, y, z * g), Jh, mu, lame, k)
    slopes = _slopes(tau, tx, ty, tz, tension)
    I1, I2 = _principal_invariants((x, y, z))
    w1, w2, _ = derivatives(I1, I2, J, mu, lame, k)
    p, q = 2.0 * (w1 + I1 * w2) + 0.8 * tension, 2.0 * w2
    return Elasticity(squares, slopes, (p - q * (y + z), p - q * (x + z), p - q * (x + y)))


def _slopes(t: Vector, tx: Vector, ty: Vector, tz: Vector, tension: Scalar) -> Tensor:
    """Return ∂τ_a/∂ln e_c, Pa, from the normal stresses and those after a small extension along each axis."""
    per, normal, cross = _PER_DIFFERENCE, 16.0 / 15.0 * tension, -8.0 / 15.0 * tension
    return (
        (tx[0] - t[0]) * per + normal, (ty[0] - t[0]) * per + cross, (tz[0] - t[0]) * per + cross,
        (tx[1] - t[1]) * per + cross, (ty[1] - t[1]) * per + normal, (tz[1] - t[1]) * per + cross,
        (tx[2] - t[2]) * per + cross, (ty[2] - t[2]) * per + cross, (tz[2] - t[2]) * per + normal,
    )  # fmt: skip


@choice
def elasticity(
    squares: Vector, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar, tension: Scalar
) -> Elasticity:
    """Return the derivatives of the stress by one-sided differences; surface tension as for a sphere.

    Surface tension adds 4/5 γ/R to the shear modulus: where it is stiff, the body is nearly a sphere.
    """
    x, y, z = squares
    e = extra_elasticity(squares, J, mu, lame, k, tension)
    g, Jh = _strained(J)
    p = _pressure(*_principal_invariants((x, y, z)), J, mu, lame, k)
    px = (_pressure(*_principal_invariants((x * g, y, z)), Jh, mu, lame, k) - p) * _PER_DIFFERENCE
    py = (_pressure(*_principal_invariants((x, y * g, z)), Jh, mu, lame, k) - p) * _PER_DIFFERENCE
    pz = (_pressure(*_principal_invariants((x, y, z * g)), Jh, mu, lame, k) - p) * _PER_DIFFERENCE
    return _with_pressure(e, px, py, pz)


def _with_pressure(e: Elasticity, px: Scalar, py: Scalar, pz: Scalar) -> Elasticity:
    """Return ``e`` with the changes of pressure per ln e_c, Pa."""
    s = e.slopes
    slopes = (
        s[0] + px, s[1] + py, s[2] + pz,
        s[3] + px, s[4] + py, s[5] + pz,
        s[6] + px, s[7] + py, s[8] + pz,
    )  # fmt: skip
    return Elasticity(e.squares, slopes, e.shear)


def elasticity_by_dilation(
    squares: Vector, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar, tension: Scalar
) -> Elasticity:
    """Return :func:`elasticity` of a solid with τ = φ b_e + ψ(J) I and a constant φ, in closed form.

    Such solids have a :attr:`foamprb.body.material.Material.dilation`.
    """
    bulk = dilation(J, mu, lame)
    return _with_pressure(extra_elasticity_by_dilation(squares, J, mu, lame, k, tension), bulk, bulk, bulk)


def extra_elasticity_by_dilation(
    squares: Vector, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar, tension: Scalar
) -> Elasticity:
    """Return :func:`extra_elasticity` of a solid with a constant φ; see :func:`elasticity_by_dilation`."""
    x, y, z = squares
    w1, _, _ = derivatives(x + y + z, x * y + y * z + z * x, J, mu, lame, k)
    phi = 2.0 * w1
    normal, cross, shear = 16.0 / 15.0 * tension, -8.0 / 15.0 * tension, phi + 0.8 * tension
    slopes = (
        2.0 * phi * x + normal, cross, cross,
        cross, 2.0 * phi * y + normal, cross,
        cross, cross, 2.0 * phi * z + normal,
    )  # fmt: skip
    return Elasticity(squares, slopes, (shear, shear, shear))


def elasticity_by_stress(
    squares: Vector, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar, tension: Scalar
) -> Elasticity:
    """Return :func:`elasticity` of a solid that is given by its stress, also for :func:`extra_elasticity`.

    A shear component of the stress is proportional to that of b, as the solid is isotropic.
    """
    (x, y, z), h, n = squares, _DIFFERENCE, 0.0 * J
    (g, Jh), per = _strained(J), _PER_DIFFERENCE
    tau = solid_stress((x, h, h, h, y, h, h, h, z), J, mu, lame, k)
    t = diagonal(solid_stress((x, n, n, n, y, n, n, n, z), J, mu, lame, k))
    tx = diagonal(solid_stress((x * g, n, n, n, y, n, n, n, z), Jh, mu, lame, k))
    ty = diagonal(solid_stress((x, n, n, n, y * g, n, n, n, z), Jh, mu, lame, k))
    tz = diagonal(solid_stress((x, n, n, n, y, n, n, n, z * g), Jh, mu, lame, k))
    slopes, shear = _slopes(t, tx, ty, tz, tension), 0.8 * tension
    return Elasticity(squares, slopes, (tau[5] * per + shear, tau[2] * per + shear, tau[1] * per + shear))


@choice
def solid_stress(b: Tensor, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Tensor:
    """Return the Kirchhoff stress of a solid that is given by its stress, Pa."""
    return kirchhoff(b, J, mu, lame, k)


def traction_slopes(semi_axes: Vector, g: Integrals, eta: Scalar) -> Tensor:
    """Return the change of the normal stresses (σ̃ − σ_v)_aa/μ_f with the body's own stretching d_s,cc (26).

    Columns are the responses to unit d_s,cc, including −4/3 of its dilation; σ_v is the viscous stress of the
    solid.
    """
    x, y, z = g.star
    n = 1.0 / (6.0 * (x * y + y * z + z * x))
    f = n * (8.0 / (semi_axes[0] * semi_axes[1] * semi_axes[2]))
    # A unit d_cc reduces s̃_aa (B.5) by 2u, 2v or 2w for a = c and increases it by u, v or w otherwise. The
    # pressure 4(α₀A + β₀B + γ₀C) of (B.1) is the same for all a. Dilation is removed: a row less its mean.
    u, v, w = f * x, f * y, f * z
    total, k = g.alpha[0] + g.alpha[1] + g.alpha[2], 4.0 * n
    p = k * x * (3.0 * g.alpha[0] - total) + u
    q = k * y * (3.0 * g.alpha[1] - total) + v
    r = k * z * (3.0 * g.alpha[2] - total) + w
    shift = -(1.0 / 3.0) * (p + q + r) - 4.0 / 3.0
    p, q, r = p + shift, q + shift, r + shift
    deficit = 2.0 / 3.0 - 2.0 / 3.0 * eta
    u, v, w = deficit - u, deficit - v, deficit - w
    return (
        p + 2.0 * u, q - u, r - u,
        p - v, q + 2.0 * v, r - v,
        p - w, q - w, r + 2.0 * w,
    )  # fmt: skip


def shear_coefficients(
    a: Scalar, b: Scalar, alpha: Scalar, beta: Scalar, ring: Scalar, f: Scalar, eta: Scalar
) -> Shear:
    """Return the change of (σ̃ − σ_v)_ab/μ_f by the body's l_s,ab and l_s,ba, then that of component ba.

    Parameters
    ----------
    a, b, alpha, beta, ring
        Two semi-axes, their α₀, and the third axis' α₀°.
    f
        4/(abc) times the third of :func:`foamprb.body.traction.shear_factors`.
    """
    a2, b2 = a * a, b * b
    # d = (Y_ab + Y_ba)/2 and w_ba = (Y_ba − Y_ab)/2 in H and H° (B.8), with d and w of the fluid zero.
    deficit = 1.0 - eta
    d1, w1 = deficit - 0.5 * f * alpha, 0.5 * f * b2 * ring
    d2, w2 = deficit - 0.5 * f * beta, -0.5 * f * a2 * ring
    return d1 - w1, d1 + w1, d2 - w2, d2 + w2


def shears(semi_axes: Vector, g: Integrals, eta: Scalar) -> tuple[Shear, Shear, Shear]:
    """Return :func:`shear_coefficients` of the pairs 23, 13 and 12, dimensionless."""
    a, b, c = semi_axes
    # The same division as in the traction, which shares it.
    k, (f, g_, h) = 0.5 * (8.0 / (a * b * c)), shear_factors(semi_axes, g)
    return (
        shear_coefficients(b, c, g.alpha[1], g.alpha[2], g.ring[0], k * f, eta),
        shear_coefficients(a, c, g.alpha[0], g.alpha[2], g.ring[1], k * g_, eta),
        shear_coefficients(a, b, g.alpha[0], g.alpha[1], g.ring[2], k * h, eta),
    )


class Stiffness(NamedTuple):
    """The J of the inertial shape at the start of a step (:mod:`foamprb.body.inertial_runge_kutta`)."""

    b: Vector
    """λ_a²."""
    traction: Tensor
    """c J μ_f times :func:`traction_slopes`, 1/s, with c = 5/(ρ_s R²)."""
    traction_pairs: tuple[Shear, Shear, Shear]
    """c J μ_f times :func:`shear_coefficients` of 23, 13 and 12, 1/s."""
    elastic: Tensor
    """c ∂τ_a/∂ln e_c, 1/s²."""
    elastic_pairs: tuple[Pull, Pull, Pull]
    """c times the change of the shear stresses 23, 13 and 12, 1/s²."""
    weight: Scalar
    """c J μ_f, 1/s."""
    deficit: Scalar
    """1 − η_s/μ_f."""


def inertial_stiffness(
    stretches: Vector, g: Integrals, e: Elasticity, c: Scalar, mu_f: Scalar, eta: Scalar
) -> Stiffness:
    """Return the Jacobian.

    Parameters
    ----------
    stretches, g
        Semi-axes over R and their integrals.
    e
        :func:`elasticity` there.
    c
        5/(ρ_s R²), m/kg.
    mu_f, eta
        Viscosities of the fluid and of the solid, Pa s.
    """
    x, y, z = stretches
    b = (x * x, y * y, z * z)
    J = x * y * z
    ratio = eta * (1.0 / mu_f)
    f = c * J * mu_f
    traction, elastic = scale(f, traction_slopes(stretches, g, ratio)), scale(c, e.slopes)
    p, q, r = shears(stretches, g, ratio)
    traction_pairs = (
        (f * p[0], f * p[1], f * p[2], f * p[3]),
        (f * q[0], f * q[1], f * q[2], f * q[3]),
        (f * r[0], f * r[1], f * r[2], f * r[3]),
    )
    (s23, s13, s12), (e1, e2, e3) = e.shear, e.squares
    elastic_pairs = (
        (c * s23 * e3, c * s23 * e2),
        (c * s13 * e3, c * s13 * e1),
        (c * s12 * e2, c * s12 * e1),
    )
    return Stiffness(b, traction, traction_pairs, elastic, elastic_pairs, f, 1.0 - ratio)


def elastic_response(n: Stiffness, X: Tensor) -> Tensor:
    """Return the reduction of Ȧ Fᵀ by the displacement H = X F, the elastic part of the Jacobian, 1/s²."""
    d = dot_vector(n.elastic, diagonal(X))
    yz, xz, xy = _pulled(n, X)
    return (d[0], xy, xz, xy, d[1], yz, xz, yz, d[2])


def elastic_response_to_spin(n: Stiffness, W: Tensor) -> Tensor:
    """Return :func:`elastic_response` to a skew W."""
    yz, xz, xy = _pulled(n, W)
    return (0.0, xy, xz, xy, 0.0, yz, xz, yz, 0.0)


def _pulled(n: Stiffness, X: Tensor) -> Vector:
    """Return the shear stresses 23, 13 and 12 of :func:`elastic_response`."""
    p, q, r = n.elastic_pairs
    return p[0] * X[5] + p[1] * X[7], q[0] * X[2] + q[1] * X[6], r[0] * X[1] + r[1] * X[3]


def paired(normal: Tensor, pairs: tuple[Shear, Shear, Shear], X: Tensor) -> Tensor:
    """Return the products of ``normal`` with the X_ii and of the pairs with their X_ij and X_ji."""
    d, (p, q, r) = dot_vector(normal, diagonal(X)), pairs
    return (
        d[0], r[0] * X[1] + r[1] * X[3], q[0] * X[2] + q[1] * X[6],
        r[2] * X[1] + r[3] * X[3], d[1], p[0] * X[5] + p[1] * X[7],
        q[2] * X[2] + q[3] * X[6], p[2] * X[5] + p[3] * X[7], d[2],
    )  # fmt: skip


def relaxation_rate(n: Stiffness) -> Scalar:
    """Return the fastest rate at which shear stresses relax where drag outweighs inertia, 1/s.

    Without inertia the shear components of dl_s/dt = T Y − E X vanish, Y = dX/dt, with T the
    ``traction_pairs`` and E the ``elastic_pairs``. X decays by the eigenvalues of −T⁻¹E, one for each of the
    pairs 23, 13 and 12; the other eigenvalue is 0, a rotation.
    """
    (p, q, r), (e, f, g) = n.traction_pairs, n.elastic_pairs
    x, y, z = reciprocals((_determinant(p), _determinant(q), _determinant(r)))
    return np.maximum(np.maximum(abs(x * _trace(p, e)), abs(y * _trace(q, f))), abs(z * _trace(r, g)))


def _determinant(T: Shear) -> Scalar:
    return T[0] * T[3] - T[1] * T[2]


def _trace(T: Shear, E: Pull) -> Scalar:
    """Return the non-zero eigenvalue of det(T) T⁻¹E for E = (e, f; e, f)."""
    return E[0] * (T[3] - T[1]) + E[1] * (T[0] - T[2])
