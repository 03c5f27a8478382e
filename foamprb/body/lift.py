"""Lift by inertia of the fluid: on a sphere that slips in shear, and on a neutral one in a duct.

The first is that of Saffman (1965, 1968) and Mei (1992), the second that of Ho and Leal (1974) for plane
channels.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add_identity,
    dot,
    dot_vector,
    inverse,
    norm,
    scale,
    select,
    transpose,
)

SAFFMAN = 6.46
_REPEATS = 4
_TINY = 1e-300


def vorticity(l_f: Tensor) -> Vector:
    """Return ∇ × u of a velocity gradient ∂u_i/∂x_j, 1/s."""
    return l_f[7] - l_f[5], l_f[2] - l_f[6], l_f[3] - l_f[1]


def mei_factor(Re: Scalar, Re_w: Scalar) -> Scalar:
    """Return Mei's factor of Saffman's lift; 1 for Re → 0.

    ``Re`` = ρ_f |v − u| d/μ_f and ``Re_w`` = ρ_f |ω| d²/μ_f are the Reynolds numbers of slip and vorticity.
    """
    beta = 0.5 * Re_w / (Re + _TINY)
    lost = 1.0 - np.exp(-0.1 * Re)
    # (1 − a) e + a with a = 0.3314 √β, which is large for small Re.
    return select(Re < 40.0, 1.0 - lost + 0.3314 * np.sqrt(beta) * lost, 0.0524 * np.sqrt(beta * Re))


def lift_coefficient(slip: Scalar, vorticity: Scalar, R: Scalar, rho: Scalar, mu: Scalar) -> Scalar:
    """Return L of the lift f = L ω × w on a sphere with the slip w = v − u, kg.

    Saffman's force is 6.46 μ_f R² √(ρ_f |ω|/μ_f) (u − v) × ω/|ω|. The arguments are |w|, m/s, |ω|, 1/s, the
    radius, m, and density and viscosity of the fluid.
    """
    c = 2.0 * R * rho / mu
    factor = mei_factor(c * slip, 2.0 * R * c * vorticity)
    return SAFFMAN * factor * R * R * np.sqrt(rho * mu / (vorticity + _TINY))


def lift_force(w: Vector, omega: Vector, R: Scalar, rho: Scalar, mu: Scalar) -> Vector:
    """Return L ω × w, N, with the arguments of :func:`lifted_slip`."""
    L = lift_coefficient(norm(w), norm(omega), R, rho, mu)
    x, y, z = omega
    return L * (y * w[2] - z * w[1]), L * (z * w[0] - x * w[2]), L * (x * w[1] - y * w[0])


def lifted_slip(
    w: Vector, Q: Tensor, resistances: Vector, omega: Vector, R: Scalar, rho: Scalar, mu: Scalar
) -> Vector:
    """Return the slip at which drag balances the lift and a load, m/s: μ_f K·w' = μ_f K·w + L ω × w'.

    Parameters
    ----------
    w
        Slip by the load without lift, m/s.
    Q, resistances
        Particle frame (rows) and K_a along its axes, m.
    omega
        Vorticity of the fluid, 1/s.
    R, rho, mu
        Radius, m; density and viscosity of the fluid.
    """
    x, y, z = omega
    k = (1.0 / (mu * resistances[0]), 1.0 / (mu * resistances[1]), 1.0 / (mu * resistances[2]))
    mobility = dot(transpose(Q), (
        k[0] * Q[0], k[0] * Q[1], k[0] * Q[2],
        k[1] * Q[3], k[1] * Q[4], k[1] * Q[5],
        k[2] * Q[6], k[2] * Q[7], k[2] * Q[8],
    ))  # fmt: skip
    turn = dot(mobility, (0.0 * x, -z, y, z, 0.0 * x, -x, -y, x, 0.0 * x))
    size = norm(omega)
    found = w
    for _ in range(_REPEATS):
        L = lift_coefficient(norm(found), size, R, rho, mu)
        found = dot_vector(inverse(add_identity(scale(-L, turn), 1.0)), w)
    return found


_G1 = (
    0.0, 0.0419, 0.0837, 0.1254, 0.1669, 0.208, 0.2489, 0.2894, 0.3293, 0.3688, 0.4077, 0.4459, 0.4834, 0.52,
    0.556, 0.591, 0.626, 0.659, 0.691, 0.723, 0.753, 0.782, 0.81, 0.836, 0.861, 0.885, 0.907, 0.927, 0.945,
    0.96, 0.973, 0.982, 0.988, 0.99, 0.988, 0.981, 0.971, 0.957, 0.943, 0.931, 0.927, 0.94, 0.982, 1.07, 1.23,
    1.5, 1.93, 2.58, 3.59, 5.33,
)  # fmt: skip
_G2 = (
    1.072, 1.07, 1.068, 1.066, 1.062, 1.056, 1.05, 1.042, 1.033, 1.023, 1.012, 1.0, 0.987, 0.972, 0.956, 0.94,
    0.922, 0.902, 0.882, 0.861, 0.838, 0.815, 0.79, 0.765, 0.738, 0.711, 0.683, 0.654, 0.625, 0.596, 0.566,
    0.536, 0.506, 0.477, 0.448, 0.42, 0.393, 0.368, 0.345, 0.324, 0.306, 0.292, 0.282, 0.278, 0.28, 0.291,
    0.315, 0.354, 0.414, 0.505,
)  # fmt: skip
"""Ho and Leal's G₁ and G₂ at the distances 0, 0.01, … from the middle, over the distance of the walls."""

HO_LEAL: tuple[tuple[float, float], ...] = tuple(
    (0.02 * k, 0.02 * k * (G2 - 0.02 * k * G1)) for k, (G1, G2) in enumerate(zip(_G1, _G2, strict=True))
)
"""(s, C) of a plane channel: C ρ_f γ̇² R⁴ towards the nearer wall, with the shear rate at the wall.

s is the distance from the middle over half the distance of the walls. The force is 16 ρ_f (U R²/H)² s
(s G₁ − G₂) away from the wall, with the velocity U in the middle, H between the walls and γ̇ = 4 U/H.
"""


def balances(table: Sequence[tuple[float, float]]) -> list[float]:
    """Return where C changes its sign from plus to minus, and neutral particles gather."""
    return [s + (t - s) * C / (C - D) for (s, C), (t, D) in pairwise(table) if C > 0.0 >= D]


def hinges(table: Sequence[tuple[float, float]]) -> tuple[float, ...]:
    """Return (C₀, s₀, k₀, s₁, k₁, …), C = C₀ + Σ k_i max(0, s − s_i), of a table of (s, C) with rising s."""
    s, C = (tuple(map(float, column)) for column in zip(*table, strict=True))
    slopes = [(C[i + 1] - C[i]) / (s[i + 1] - s[i]) for i in range(len(s) - 1)]
    changes = [b - a for a, b in zip((0.0, *slopes), (*slopes, 0.0), strict=True)]
    return C[0], *(number for pair in zip(s, changes, strict=True) for number in pair)


def duct_coefficient(s: Scalar, table: Sequence[Scalar]) -> Scalar:
    """Return C at s, linear between the points of :func:`hinges`, constant beyond the first and the last."""
    C = table[0]
    for k in range(1, len(table), 2):
        C = C + table[k + 1] * np.maximum(0.0, s - table[k])
    return C


def duct_lift(C: Scalar, R: Scalar, rate: Scalar, rho: Scalar, rho_s: Scalar) -> Scalar:
    """Return C ρ_f γ̇² R⁴ over the mass of a solid sphere, m/s²."""
    return C * 3.0 / (4.0 * np.pi) * rho / rho_s * rate * rate * R
