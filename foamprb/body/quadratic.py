"""Quadratic mode of a soft sphere: its shape by the curvature of the flow, and its drift across the stream.

Around the centre the fluid has u_i = U_i + L_ij x_j + ½ G_ijk x_j x_k, E = sym L and Ω = ½ curl u. The
surface is

    r = a (1 + A_ij n_i n_j + B_ijk n_i n_j n_k),    x = F X + (1/a) B_ijk X_j X_k,

with A and B symmetric and traceless. A is the affine mode, R² F Fᵀ = a² (1 + 2A); B is the quadratic one. The
theory is closed to first order in the strain, for creeping flow without walls: of the three parts of G
(:func:`parts`) only S deforms the body, and each mode relaxes with one time. Products of A, B and G are left
out of the rates.

A symmetric, traceless tensor of third order is a tuple of the components 111, 112, 113, 122, 123, 222 and
223. The others follow from the vanishing traces. Arguments of the functions:

a
    Radius of the sphere at rest, m.
mu_f, mu_s, eta
    Viscosity of the fluid, shear modulus and viscosity of the solid, Pa s, Pa and Pa s.
ratio
    λ, viscosity of a drop over that of the fluid; that of a solid for its rates is η/μ_f.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np

from foamprb.body.exponential_runge_kutta import group_exponential
from foamprb.body.faxen import Curvature
from foamprb.body.relaxation import phi_functions
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    combine_vectors,
    ddot,
    dot,
    dot_vector,
    inner,
    inverse,
    norm,
    plus,
    plus_scaled,
    scale,
    scale_vector,
    sym,
    to_frame,
    transpose,
    vector_dot,
    vector_product,
)

Third: TypeAlias = tuple[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar, Scalar]
"""Components 111, 112, 113, 122, 123, 222 and 223 of a symmetric, traceless tensor of third order."""


# ---------------------------------------------------------------------------------------------------------
# Tensors of third order


def layers(B: Third) -> tuple[Tensor, Tensor, Tensor]:
    """Return the tensors B_1jk, B_2jk and B_3jk."""
    xxx, xxy, xxz, xyy, xyz, yyy, yyz = B
    xzz, yzz, zzz = -xxx - xyy, -xxy - yyy, -xxz - yyz
    return (
        (xxx, xxy, xxz, xxy, xyy, xyz, xxz, xyz, xzz),
        (xxy, xyy, xyz, xyy, yyy, yyz, xyz, yyz, yzz),
        (xxz, xyz, xzz, xyz, yyz, yzz, xzz, yzz, zzz),
    )


def contract(B: Third, E: Tensor) -> Vector:
    """Return B_ijk E_jk."""
    xxx, xxy, xxz, xyy, xyz, yyy, yyz = B
    # E_33 is subtracted, as B_i33 = −B_i11 − B_i22.
    x, y = E[0] - E[8], E[4] - E[8]
    xy, xz, yz = E[1] + E[3], E[2] + E[6], E[5] + E[7]
    return (
        xxx * x + xyy * y + xxy * xy + xxz * xz + xyz * yz,
        xxy * x + yyy * y + xyy * xy + xyz * xz + yyz * yz,
        xxz * x + yyz * y + xyz * xy - (xxx + xyy) * xz - (xxy + yyy) * yz,
    )


def square(B: Third) -> Scalar:
    """Return B_ijk B_ijk."""
    xxx, xxy, xxz, xyy, xyz, yyy, yyz = B
    xzz, yzz, zzz = xxx + xyy, xxy + yyy, xxz + yyz
    once = xxx * xxx + yyy * yyy + zzz * zzz
    thrice = xxy * xxy + xxz * xxz + xyy * xyy + yyz * yyz + xzz * xzz + yzz * yzz
    return once + 3.0 * thrice + 6.0 * xyz * xyz


def bullet_amplitude(B: Third) -> Scalar:
    """Return ε of the shape r = a (1 + ε P₃) with as large a B: B_ijk B_ijk = ⁵⁄₂ ε²."""
    return np.sqrt(0.4 * square(B))


def resolved_strain(a: Scalar, E: Tensor, u: Vector) -> Scalar:
    """Return |E|, 1/s, as one of 10⁻⁵ |u|/a at least: the velocities of a case have about six digits."""
    return np.maximum(np.sqrt(ddot(E, E)), 1e-5 * norm(u) / a)


def steady_amplitude(mu_f: Scalar, mu_s: Scalar, eta: Scalar, tension: Scalar, aS: Scalar) -> Scalar:
    """Return ε of the steady shape of a solid by a |S|, 1/s; ``tension`` is γ/a, Pa."""
    return 0.4**0.5 * source(eta / mu_f) * aS / relaxation_of_solid(mu_f, mu_s, eta, tension)


def steady_amplitude_of_drop(mu_f: Scalar, ratio: Scalar, tension: Scalar, aS: Scalar) -> Scalar:
    """Return ε of the steady shape of a drop by a |S|, 1/s; ``tension`` is σ/a, Pa."""
    return 0.4**0.5 * source(ratio) * aS / relaxation_of_drop(mu_f, ratio, tension)


def turned(B: Third, Q: Tensor) -> Third:
    """Return Q_il Q_jm Q_kn B_lmn, for a rotation or a reflection Q."""
    x, y, z = layers(B)
    x, y, z = to_frame(Q, x), to_frame(Q, y), to_frame(Q, z)
    p, q, r, s, t, u = Q[0], Q[1], Q[2], Q[3], Q[4], Q[5]
    return (
        p * x[0] + q * y[0] + r * z[0],
        p * x[1] + q * y[1] + r * z[1],
        p * x[2] + q * y[2] + r * z[2],
        p * x[4] + q * y[4] + r * z[4],
        p * x[5] + q * y[5] + r * z[5],
        s * x[4] + t * y[4] + u * z[4],
        s * x[5] + t * y[5] + u * z[5],
    )


def combine(s: Scalar, B: Third, t: Scalar, C: Third) -> Third:
    """Return s B + t C."""
    return (
        s * B[0] + t * C[0], s * B[1] + t * C[1], s * B[2] + t * C[2], s * B[3] + t * C[3],
        s * B[4] + t * C[4], s * B[5] + t * C[5], s * B[6] + t * C[6],
    )  # fmt: skip


# ---------------------------------------------------------------------------------------------------------
# Parts of the flow


class Parts(NamedTuple):
    """Parts of the second derivatives G_ijk of a velocity."""

    S: Third
    """Symmetric, traceless part, 1/(m s)."""
    T: Tensor
    """Symmetric part of the gradient of the vorticity, 1/(m s)."""
    v: Vector
    """Laplacian of the velocity, 1/(m s)."""


def parts(curvature: Curvature) -> Parts:
    """Return the parts S (7 components), T (5) and v (3) of the second derivatives of a velocity.

    G_ijk = S_ijk + ⅓(ε_iak T_aj + ε_iaj T_ak) + ¹⁄₁₀(4 δ_jk v_i − δ_ij v_k − δ_ik v_j) without divergence.
    """
    xx, yy, zz, xy, yz, xz = curvature
    v = (xx[0] + yy[0] + zz[0], xx[1] + yy[1] + zz[1], xx[2] + yy[2] + zz[2])
    # A fifth of the trace of the symmetric part: a third of the Laplacian and of twice ∇(div u).
    t = (
        (v[0] + 2.0 * (xx[0] + xy[1] + xz[2])) * (1.0 / 15.0),
        (v[1] + 2.0 * (xy[0] + yy[1] + yz[2])) * (1.0 / 15.0),
        (v[2] + 2.0 * (xz[0] + yz[1] + zz[2])) * (1.0 / 15.0),
    )
    third = 1.0 / 3.0
    S = (
        xx[0] - 3.0 * t[0],
        third * (2.0 * xy[0] + xx[1]) - t[1],
        third * (2.0 * xz[0] + xx[2]) - t[2],
        third * (2.0 * xy[1] + yy[0]) - t[0],
        third * (yz[0] + xz[1] + xy[2]),
        yy[1] - 3.0 * t[1],
        third * (2.0 * yz[1] + yy[2]) - t[2],
    )
    W = (
        xy[2] - xz[1], yy[2] - yz[1], yz[2] - zz[1],
        xz[0] - xx[2], yz[0] - xy[2], zz[0] - xz[2],
        xx[1] - xy[0], xy[1] - yy[0], xz[1] - yz[0],
    )  # fmt: skip
    return Parts(S, sym(W), v)


# ---------------------------------------------------------------------------------------------------------
# Rates of the modes


def source(ratio: Scalar) -> Scalar:
    """Return 35/(2 (19 + 16 λ)): dB/dt = source·a S − B/τ₃ in the frame that turns with the fluid."""
    return 17.5 / (19.0 + 16.0 * ratio)


def relaxation_of_solid(mu_f: Scalar, mu_s: Scalar, eta: Scalar, tension: Scalar) -> Scalar:
    """Return 1/τ₃ of a solid, 1/s: (16 μ_s + ²⁸⁰⁄₁₁ γ/a)/(19 μ_f + 16 η); ``tension`` is γ/a, Pa."""
    return (16.0 * mu_s + (280.0 / 11.0) * tension) / (19.0 * mu_f + 16.0 * eta)


def relaxation_of_drop(mu_f: Scalar, ratio: Scalar, tension: Scalar) -> Scalar:
    """Return 1/τ₃ of a drop, 1/s; ``tension`` is σ/a, Pa."""
    resistance = (10.0 + 11.0 * ratio) * (19.0 + 16.0 * ratio)
    return 280.0 * (1.0 + ratio) * tension / (resistance * mu_f)


def relaxation_of_shift(mu_f: Scalar, mu_s: Scalar, eta: Scalar) -> Scalar:
    """Return 1/τ₁ of :func:`shift`, 1/s."""
    return 3.0 * mu_s / (2.0 * mu_f + 3.0 * eta)


def shift(a: Scalar, mu_f: Scalar, mu_s: Scalar, v: Vector) -> Vector:
    """Return q = (μ_f a²/μ_s) v/9, m: how far the mean of the surface of a solid is steadily displaced.

    It is relative to the mean of the volume. v is the Laplacian of the fluid's velocity.
    """
    return scale_vector(mu_f * a * a / (9.0 * mu_s), v)


class Weights(NamedTuple):
    """Weights of the value at the start of a step, and of the sources at its start and its end."""

    decay: Scalar
    before: Scalar
    """s."""
    after: Scalar
    """s."""


def weights(rate: Scalar, h: Scalar) -> Weights:
    """Return the weights of a step h, s, of y' = s − rate·y with a source s that is linear in time."""
    decay, one, two, _, _ = phi_functions(-rate * h)
    return Weights(decay, h * (one - two), h * two)


def rotation(Omega: Vector, h: Scalar) -> Tensor:
    """Return the rotation by the angular velocity Ω, 1/s, in a time h, s."""
    x, y, z = scale_vector(h, Omega)
    zero = 0.0 * x
    return group_exponential((zero, -z, y, z, zero, -x, -y, x, zero))


def advanced(B: Third, before: Third, after: Third, w: Weights, turn: Tensor) -> Third:
    """Return B after a step: exact for a source that is linear in the frame that turns with the fluid.

    ``before`` and ``after`` are the sources at the start and the end, 1/s, and ``turn`` is the rotation.
    """
    return combine(1.0, turned(combine(w.decay, B, w.before, before), turn), w.after, after)


def advanced_vector(q: Vector, before: Vector, after: Vector, w: Weights, turn: Tensor) -> Vector:
    """Return a vector after a step, as :func:`advanced` does."""
    q = combine_vectors(w.decay, q, w.before, before)
    return plus_scaled(dot_vector(turn, q), w.after, after)


# ---------------------------------------------------------------------------------------------------------
# Drift


def drift_of_solid(a: Scalar, B: Third, E: Tensor) -> Vector:
    """Return −²⁄₇ a B_ijk E_jk, m/s, the drift by the quadratic shape.

    That by A is the part ⅓ a² G_ijk A_jk of Faxén's correction (:mod:`foamprb.body.faxen`); a shift q adds
    −dq/dt in the frame that turns with the fluid.
    """
    return scale_vector((-2.0 / 7.0) * a, contract(B, E))


def drift_of_drop(a: Scalar, ratio: Scalar, A: Tensor, B: Third, E: Tensor, flow: Parts) -> Vector:
    """Return the velocity of a drop relative to the fluid at its centre, m/s, to first order in A and B.

    That of a sphere is a² λ/(2 (2 + 3λ)) v.
    """
    two, one, four = 2.0 + 3.0 * ratio, 1.0 + ratio, 4.0 + ratio
    of_S = (6.0 + 7.0 * ratio) / (7.0 * two)
    of_v = -(6.0 - 4.0 * ratio + 3.0 * ratio * ratio) / (5.0 * two * two)
    of_T = -2.0 * (2.0 + 2.0 * ratio + ratio * ratio) / (3.0 * two * four)
    of_E = -2.0 * (8.0 - ratio + 3.0 * ratio * ratio) / (7.0 * one * two)
    sphere = scale_vector(0.5 * ratio / two, flow.v)
    M = dot(A, flow.T)
    by_A = plus(
        combine_vectors(of_S, contract(flow.S, A), of_v, dot_vector(A, flow.v)),
        scale_vector(of_T, (M[5] - M[7], M[6] - M[2], M[1] - M[3])),
    )
    return combine_vectors(a * a, plus(sphere, by_A), a * of_E, contract(B, E))


def drift_by_shift(Omega: Vector, q: Vector, rate: Vector) -> Vector:
    """Return −dq/dt in the frame that turns with Ω, m/s, from the rate dq/dt in space."""
    return plus_scaled(vector_product(Omega, q), -1.0, rate)


# ---------------------------------------------------------------------------------------------------------
# Sphere on the axis of a tube


def tube_velocity(b: Scalar) -> Scalar:
    """Return the velocity over that of the fluid on the axis, for b = a/R ≤ 0.7 in a tube of radius R."""
    five = b * b * b * b * b
    fit = 0.159256 + b * b * (0.5821 + b * (-0.8136 + b * b * 0.2479))
    return 1.0 - (2.0 / 3.0) * b * b + five * fit


def tube_amplitude(b: Scalar) -> Scalar:
    """Return the amplitude of P₃ over that without walls."""
    five = b * b * b * b * b
    return 1.0 + five * (3.913713 + b * b * (-6.8340 + b * (5.0896 + b * b * 2.6434)))


def tube_deformation(b: Scalar) -> Scalar:
    """Return the square root of the deformation of the outline over that without walls, by P₃ and P₅."""
    five = b * b * b * b * b
    return 1.0 + five * (3.913713 + b * b * (-8.5654 + b * (6.8029 + b * b * 2.6066)))


# ---------------------------------------------------------------------------------------------------------
# Contact


def turn_of(F: Tensor) -> Tensor:
    """Return the rotation Q of F = V Q, by Newton's iteration."""
    Q = F
    for _ in range(12):
        Q = scale(0.5, add(Q, transpose(inverse(Q))))
    return Q


def swelling(mode: tuple[Third, Tensor], inverse_F: Tensor, p: Vector) -> Scalar:
    """Return how much farther than the ellipsoid the surface reaches, over a, in the frame of the material.

    F⁻¹ maps the ellipsoid to a ball, and the surface to X + F⁻¹ B YY with Y = Q X, |X| = 1. To second order
    in B its support function in the direction p is 1 + f + 2 |w − f p|², f = p·F⁻¹ B YY and w = (p·F⁻¹ B·Y) Q
    at X = p.

    Parameters
    ----------
    mode
        B, and the rotation Q by :func:`turn_of`.
    inverse_F, p
        F⁻¹, and a unit vector.
    """
    B, Q = mode
    y = dot_vector(Q, p)
    X, Y, Z = layers(B)
    M = add(add(scale(y[0], X), scale(y[1], Y)), scale(y[2], Z))
    row = dot_vector(M, vector_dot(p, inverse_F))
    f, w = inner(row, y), vector_dot(row, Q)
    return f + 2.0 * (inner(w, w) - f * f)


def largest_swelling(mode: tuple[Third, Tensor], inverse_F: Tensor) -> Scalar:
    """Return an upper bound of :func:`swelling` in all directions."""
    most = bullet_amplitude(mode[0]) * ddot(inverse_F, inverse_F) ** 0.5
    return most + 2.0 * most * most


# ---------------------------------------------------------------------------------------------------------
# Outline


class OutlineParts(NamedTuple):
    """Contribution of B to the outline in the plane of two axes, to second order; odd orders vanish."""

    area: Scalar
    """Over π a²."""
    perimeter: Scalar
    """Over 2π a."""
    deformation: Scalar
    """1 − 2 √(π area)/perimeter."""
    centre: tuple[Scalar, Scalar]
    """Centre of the area less that of the volume, over a."""


def outline_parts(B: Third) -> OutlineParts:
    """Return the contribution of B to the outline that is seen along the third axis.

    The surface x = X + (1/a) B X X has in the plane the support function a (1 + b + 2 |B·ee − b e|²) with
    b = B_ijk e_i e_j e_k, e = (cos φ, sin φ, 0).
    """
    xxx, xxy, xxz, xyy, xyz, yyy, yyz = B
    # b = Σ p cos kφ + q sin kφ of k = 1, 3; its derivative is three times the part of B·ee along the outline.
    p1, q1, p3, q3 = 0.75 * (xxx + xyy), 0.75 * (xxy + yyy), 0.25 * xxx - 0.75 * xyy, 0.75 * xxy - 0.25 * yyy
    one, three = 0.5 * (p1 * p1 + q1 * q1), 0.5 * (p3 * p3 + q3 * q3)
    b, along = one + three, one * (1.0 / 9.0) + three
    m, d = 0.5 * (xxz + yyz), 0.5 * (xxz - yyz)
    across = m * m + 0.5 * (d * d + xyz * xyz)
    return OutlineParts(
        area=b - 5.0 * along + 4.0 * across,
        perimeter=2.0 * (along + across),
        deformation=4.0 * three,
        centre=(p1, q1),
    )
