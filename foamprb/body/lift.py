"""Lift by inertia of the fluid on a sphere that slips in a shear flow (Saffman 1965, 1968; Mei 1992)."""

from __future__ import annotations

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
