"""Brownian motion: random force and random stress of the fluid's molecules on a soft body.

Both follow from the fluctuation–dissipation theorem. Over a step Δt a body without inertia moves with
v = u + (μ_f K)⁻¹·(f + f_B) and deforms with l_s(σ − T_B; l_f), where f_B and T_B are constant in the inertial
frame over the step,

    ⟨f_B f_B⟩ = 2 k_B T μ_f K/Δt,        ⟨V T_B V T_B⟩ = 2 k_B T V μ_f 𝓡/Δt,

with the resistances K and 𝓡 of the step's start. The body responds with the resistances of its present place
and shape. To first order in Δt this gives the drift k_B T ∇·(μ_f K)⁻¹ and the drift of the shape (the kinetic
interpretation of noise, Hütter & Öttinger 1998). Particles over a wall reach Boltzmann's distribution of
heights, and soft bodies take shapes with the weight exp(−w vol/k_B T), w their stored energy.

All tensors are components in the particle frame. ``r`` is :func:`shape_resistance`, ``xi`` are normal
deviates.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from foamprb.body.ellipsoid import Integrals
from foamprb.body.philox import Word, normals, philox
from foamprb.body.tensor import Scalar, Tensor, Vector, plus, reciprocals, select

BOLTZMANN = 1.380649e-23
"""k_B, J/K."""

_LOW, _HALF, _TWO = np.uint64(0xFFFFFFFF), np.uint64(32), np.uint64(2)
_FIRST, _SECOND, _THIRD = np.uint64(0), np.uint64(1), np.uint64(2)
_PAIR = sqrt(0.5)
_SMALL, _LARGE, _TINY = 1e-6, 700.0, 1e-300


def deviates(particle: Word, step: Word, key: tuple[Word, Word]) -> tuple[Vector, Tensor]:
    """Return three and nine independent normal deviates of a particle and a step.

    Parameters
    ----------
    particle, step
        Their indices, unsigned integers of 64 bits, the step's below 2⁶².
    key
        Two numbers below 2³²: the seed and the purpose of the deviates.
    """
    low, high = particle & _LOW, particle >> _HALF
    low_step, high_step = step & _LOW, (step >> _HALF) << _TWO
    a = normals(philox((low, high, low_step, high_step | _FIRST), key))
    b = normals(philox((low, high, low_step, high_step | _SECOND), key))
    c = normals(philox((low, high, low_step, high_step | _THIRD), key))
    return (a[0], a[1], a[2]), (a[3], b[0], b[1], b[2], b[3], c[0], c[1], c[2], c[3])


def random_force(K: Tensor, size: Scalar, xi: Vector) -> Vector:
    """Return f_B, N, for the resistance K, m, of a body, near walls or not.

    K is symmetric and positive definite (:func:`foamprb.body.wall.hindered_resistance`), ``size`` is
    √(2 k_B T μ_f/Δt), N/√m.
    """
    # Cholesky's factor of K.
    a = np.sqrt(K[0])
    b, c = K[3] / a, K[6] / a
    d = np.sqrt(K[4] - b * b)
    e = (K[7] - b * c) / d
    f = np.sqrt(K[8] - c * c - e * e)
    return size * a * xi[0], size * (b * xi[0] + d * xi[1]), size * (c * xi[0] + e * xi[1] + f * xi[2])


class ShapeResistance(NamedTuple):
    """𝓡: the stress T over μ_f that deforms and turns a body with l_s in a fluid at rest.

    It includes the viscous stress of the solid. With s = ½(T_ij + T_ji), t = ½(T_ji − T_ij), i < j, and d and
    w the same combinations of l_s: s = shear d + cross w, t = cross d + spin w; T_aa = normal_a d_aa − p, tr
    d = 0. Shear, cross and spin are those of 23, 13 and 12.
    """

    normal: Vector
    shear: Vector
    cross: Vector
    spin: Vector


def shape_resistance(semi_axes: Vector, g: Integrals, eta: Scalar) -> ShapeResistance:
    """Return the resistance: symmetric by Lorentz's theorem, and positive definite.

    ``semi_axes`` and ``g`` are a, b, c and their integrals, in one unit of length, ``eta`` the viscosity of
    the solid over that of the fluid.
    """
    a, b, c = semi_axes
    viscous = 2.0 - 2.0 * eta
    alpha, beta, gamma = g.alpha
    x, y, z = a * a, b * b, c * c
    s = g.star
    k = 1.0 / (a * b * c)
    n = 4.0 * k / (s[0] * s[1] + s[1] * s[2] + s[2] * s[0])
    p, q, r = reciprocals((y * beta + z * gamma, z * gamma + x * alpha, x * alpha + y * beta))
    p, q, r = 2.0 * k * p, 2.0 * k * q, 2.0 * k * r
    return ShapeResistance(
        (n * s[0] - viscous, n * s[1] - viscous, n * s[2] - viscous),
        (
            p * (beta + gamma) / g.ring[0] - viscous,
            q * (gamma + alpha) / g.ring[1] - viscous,
            r * (alpha + beta) / g.ring[2] - viscous,
        ),
        (p * (y - z), q * (x - z), r * (x - y)),
        (p * (y + z), q * (x + z), r * (x + y)),
    )


def random_stress(r: ShapeResistance, size: Scalar, xi: Tensor, relaxing: Scalar = 0.0) -> Tensor:
    """Return T_B, Pa; its skew part is the random torque over the volume.

    A constant stress deforms a body with the modulus μ less than one that changes all the time, if it lasts
    longer than the shape takes to relax. The deforming part is larger by so much that the variance of the
    strain is that of equilibrium: √(y/2 coth(y/2)) times, with y = 2 μ Δt/(μ_f r) and the resistance r.

    Parameters
    ----------
    size
        √(2 k_B T μ_f/(V Δt)), √(Pa Pa s), with the volume V of the body.
    relaxing
        2 μ Δt/μ_f.
    """
    half = _PAIR * size
    T23, T32 = _random_pair(r.shear[0], r.cross[0], r.spin[0], half, xi[5], xi[7], relaxing)
    T13, T31 = _random_pair(r.shear[1], r.cross[1], r.spin[1], half, xi[2], xi[6], relaxing)
    T12, T21 = _random_pair(r.shear[2], r.cross[2], r.spin[2], half, xi[1], xi[3], relaxing)
    n, m = (
        r.normal,
        (_held(r.normal[0], relaxing), _held(r.normal[1], relaxing), _held(r.normal[2], relaxing)),
    )
    return (
        size * np.sqrt(n[0] * m[0]) * xi[0], T12, T13,
        T21, size * np.sqrt(n[1] * m[1]) * xi[4], T23,
        T31, T32, size * np.sqrt(n[2] * m[2]) * xi[8],
    )  # fmt: skip


def _held(r: Scalar, relaxing: Scalar) -> Scalar:
    """Return y/2 coth(y/2) for y = relaxing/r, at least 1."""
    y = relaxing / r
    e = np.exp(-np.minimum(y, _LARGE))
    return select(y > _SMALL, 0.5 * y * (1.0 + e) / (1.0 - e + _TINY), 1.0)


def _random_pair(
    shear: Scalar, cross: Scalar, spin: Scalar, size: Scalar, x: Scalar, y: Scalar, relaxing: Scalar
) -> tuple[Scalar, Scalar]:
    a = np.sqrt(shear)
    b = cross / a
    s = size * a * np.sqrt(_held(shear, relaxing)) * x
    t = size * (b * x + np.sqrt(spin - b * b) * y)
    return s - t, s + t


def with_inertia(r: ShapeResistance, semi_axes: Vector, inertia: Scalar) -> ShapeResistance:
    """Return the resistance of a solid that is accelerated from rest: T gains ``inertia`` l_s·b.

    ``inertia`` is ρ_s R²/5 over μ_f and the time, b = F Fᵀ has the squares of the semi-axes (over R).
    """
    x, y, z = (
        0.5 * inertia * semi_axes[0] * semi_axes[0],
        0.5 * inertia * semi_axes[1] * semi_axes[1],
        0.5 * inertia * semi_axes[2] * semi_axes[2],
    )
    return ShapeResistance(
        plus(r.normal, (2.0 * x, 2.0 * y, 2.0 * z)),
        plus(r.shear, (y + z, x + z, x + y)),
        plus(r.cross, (y - z, x - z, x - y)),
        plus(r.spin, (y + z, x + z, x + y)),
    )


def response(r: ShapeResistance, T: Tensor, dilation: Scalar = 0.0) -> Tensor:
    """Return the velocity gradient l_s, 1/s, of a body by a stress T over μ_f, 1/s, symmetric or not.

    For a symmetric T it equals :func:`foamprb.body.stokes.velocity_gradient` for σ = −T and l_f = 0.
    ``dilation`` is the rate of dilation by a unit pressure over μ_f.
    """
    m = reciprocals(r.normal)
    pressure = (m[0] * T[0] + m[1] * T[4] + m[2] * T[8]) / (m[0] + m[1] + m[2] + dilation)
    l23, l32 = _response_pair(r.shear[0], r.cross[0], r.spin[0], T[5], T[7])
    l13, l31 = _response_pair(r.shear[1], r.cross[1], r.spin[1], T[2], T[6])
    l12, l21 = _response_pair(r.shear[2], r.cross[2], r.spin[2], T[1], T[3])
    return (
        m[0] * (T[0] - pressure), l12, l13,
        l21, m[1] * (T[4] - pressure), l23,
        l31, l32, m[2] * (T[8] - pressure),
    )  # fmt: skip


def _response_pair(
    shear: Scalar, cross: Scalar, spin: Scalar, Tij: Scalar, Tji: Scalar
) -> tuple[Scalar, Scalar]:
    s, t = 0.5 * (Tij + Tji), 0.5 * (Tji - Tij)
    n = 1.0 / (shear * spin - cross * cross)
    d, w = n * (spin * s - cross * t), n * (shear * t - cross * s)
    return d - w, d + w
