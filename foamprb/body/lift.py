"""Lift by inertia of the fluid: on a sphere that slips in shear, and on a neutral one in a duct.

The first is that of Saffman (1965, 1968) and Mei (1992). The second follows a table; those of channels, pipes
and rectangular ducts are the theory of Ho & Leal (1974), Vasseur & Cox (1976), Schonberg & Hinch (1989) and
Hood, Lee & Roper (2015).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add_identity,
    dot,
    dot_vector,
    from_frame,
    inverse,
    norm,
    scale,
    select,
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
    w: Vector, Q: Tensor, resistance: Tensor, omega: Vector, R: Scalar, rho: Scalar, mu: Scalar
) -> Vector:
    """Return the slip at which drag balances the lift and a load, m/s: μ_f K·w' = μ_f K·w + L ω × w'.

    Parameters
    ----------
    w
        Slip by the load without lift, m/s.
    Q, resistance
        Particle frame (rows) and K in it, m.
    omega
        Vorticity of the fluid, 1/s.
    R, rho, mu
        Radius, m; density and viscosity of the fluid.
    """
    x, y, z = omega
    mobility = scale(1.0 / mu, from_frame(Q, inverse(resistance)))
    turn = dot(mobility, (0.0 * x, -z, y, z, 0.0 * x, -x, -y, x, 0.0 * x))
    size = norm(omega)
    slip = w
    for _ in range(_REPEATS):
        L = lift_coefficient(norm(slip), size, R, rho, mu)
        slip = dot_vector(inverse(add_identity(scale(-L, turn), 1.0)), w)
    return slip


_CHANNEL = (
    0, 0.03444, 0.06854, 0.10192, 0.13425, 0.16517, 0.19435, 0.22144, 0.24613, 0.26809, 0.287, 0.30257,
    0.3145, 0.3225, 0.32632, 0.32569, 0.32035, 0.31007, 0.29462, 0.27377, 0.24732, 0.21506, 0.17678,
    0.13228, 0.08138, 0.02387, -0.04045, -0.11179, -0.19036, -0.27641, -0.37016, -0.4719, -0.58189,
    -0.70044, -0.82788, -0.96456, -1.11085, -1.26713, -1.43381, -1.61126, -1.79987,
)  # fmt: skip
_PIPE = (
    0, 0.04245, 0.08455, 0.12593, 0.16624, 0.20514, 0.24226, 0.27728, 0.30984, 0.33962, 0.36629,
    0.38953, 0.40903, 0.42448, 0.43559, 0.44206, 0.4436, 0.43994, 0.43084, 0.41603, 0.39522, 0.36812,
    0.33447, 0.29406, 0.24657, 0.19175, 0.12934, 0.05908, -0.01956, -0.10694, -0.20248, -0.30596,
    -0.41956, -0.5456, -0.68465, -0.83685, -1.00234, -1.18125, -1.37372, -1.57988, -1.79987,
)  # fmt: skip
PLANE_CHANNEL: tuple[tuple[float, float], ...] = tuple((0.025 * k, C) for k, C in enumerate(_CHANNEL))
PIPE: tuple[tuple[float, float], ...] = tuple((0.025 * k, C) for k, C in enumerate(_PIPE))
"""(s, C) of Poiseuille flow: C ρ_f γ̇² R⁴ towards the wall, with the shear rate at the wall.

s is the distance from the middle over half of that of the walls, or over the pipe's radius. To first order
in the Reynolds number, for a small sphere: the quadratures are ``duct.py`` and ``tube.py`` in
``tools/validation/references``. At the walls C is −55π/96 (Cox & Hsu 1977).
"""
DUCTS = {"channel": PLANE_CHANNEL, "pipe": PIPE}


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


LONG, SHORT = 10, 7
"""Numbers of terms of :func:`rectangle_coefficient` along the longer sides and along the shorter ones."""


@cache
def rectangles() -> dict[float, tuple[tuple[float, ...], ...]]:
    """Return c_mn of :func:`rectangle_coefficient` by aspect ratio, along longer and shorter sides."""
    rows = np.loadtxt(Path(__file__).with_name("rectangle.txt")).reshape(-1, 2, 1 + LONG * SHORT).tolist()
    return {along[0]: (tuple(along[1:]), tuple(across[1:])) for along, across in rows}


def rectangle_coefficient(s: Scalar, t: Scalar, table: Sequence[Scalar], terms: int) -> Scalar:
    """Return C = s Σ c_mn T_m(2 s² − 1) T_n(2 t² − 1), with Chebyshev's polynomials T.

    Parameters
    ----------
    s, t
        Places along the force and across it, over half of the sides.
    table, terms
        c row by row, and the number of terms across, that of columns.
    """
    s, t = np.minimum(1.0, np.maximum(-1.0, s)), np.minimum(1.0, np.maximum(-1.0, t))
    w, v = 2.0 * s * s - 1.0, 2.0 * t * t - 1.0
    # Clenshaw's recurrence, of both series.
    a = b = 0.0 * w
    for m in range(len(table) // terms - 1, -1, -1):
        c = d = 0.0 * w
        for n in range(terms - 1, 0, -1):
            c, d = 2.0 * v * c - d + table[terms * m + n], c
        row = v * c - d + table[terms * m]
        a, b = 2.0 * w * a - b + row, a
    return s * (a - w * b)


def duct_lift(C: Scalar, R: Scalar, rate: Scalar, rho: Scalar, rho_s: Scalar) -> Scalar:
    """Return C ρ_f γ̇² R⁴ over the mass of a solid sphere, m/s²."""
    return C * 3.0 / (4.0 * np.pi) * rho / rho_s * rate * rate * R
