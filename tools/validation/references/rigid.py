"""Rigid ellipsoids in Stokes flow, in closed form or by scipy: independent of foamprb's own code.

Lengths are in any unit; the shear flow is u₁ = γ̇ x₂ with γ̇ = 1. Vectors are arrays (3,), tensors (3, 3).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from validation.references import Floats

# --- Orbits -------------------------------------------------------------------------------------------------


def jeffery_period(ratio: float) -> float:
    """Return the period 2π (r + 1/r)/γ̇ of a spheroid's axis in shear, r its aspect ratio (Jeffery 1922)."""
    return 2.0 * math.pi * (ratio + 1.0 / ratio)


def orbit_constant(axis: Floats, ratio: float) -> Floats:
    """Return C = tan θ √(cos²φ + sin²φ/r²) of axes (..., 3); θ from vorticity, φ from the gradient.

    Jeffery's κ as Leal & Hinch (1971) write it; infinite for an axis in the plane of shear.
    """
    p = np.moveaxis(axis, -1, 0)
    with np.errstate(divide="ignore"):
        return np.asarray(np.sqrt((p[0] / ratio) ** 2 + p[1] ** 2) / np.abs(p[2]))


def jeffery_axis(start: Floats, ratio: float, times: Floats) -> Floats:
    """Return the direction (n, 3) of a spheroid's axis at times (n,), unit 1/γ̇, from ``start`` at time 0.

    p ∝ (r K sin ψ, K cos ψ, p₃), ψ = ψ₀ + t/(r + 1/r): Jeffery's tan φ = r tan ψ with tan θ of his orbit.
    """
    amplitude = math.hypot(start[0] / ratio, start[1])
    psi = math.atan2(start[0] / ratio, start[1]) + times / (ratio + 1.0 / ratio)
    p = np.stack([ratio * amplitude * np.sin(psi), amplitude * np.cos(psi), np.full_like(psi, start[2])], 1)
    return np.asarray(p / np.linalg.norm(p, axis=1, keepdims=True))


def rigid_axes(semi_axes: Floats, axes: Floats, gradient: Floats, times: Floats) -> Floats:
    """Return axes of a rigid ellipsoid free of torque at times (n,), from time 0, as rows, (n, 3, 3).

    In its axes the body turns with Ω_ij = w_ij + (a_j² − a_i²)/(a_j² + a_i²) d_ij (Jeffery 1922; for three
    different axes Hinch & Leal 1979), ∂u_i/∂x_j of the rotation being Ω.

    Parameters
    ----------
    semi_axes
        (3,), in any unit.
    axes
        Their directions at time 0, rows of a rotation (3, 3).
    gradient
        ∂u_i/∂x_j of the fluid, (3, 3).
    times
        Rising, in units that fit the gradient.
    """
    squares = semi_axes**2
    slip = (squares[None, :] - squares[:, None]) / (squares[None, :] + squares[:, None])

    def rate(_t: float, y: Floats) -> Floats:
        Q = y.reshape(3, 3)
        l = Q @ gradient @ Q.T
        turn = 0.5 * (l - l.T) + slip * 0.5 * (l + l.T)
        # Row a of Q is the direction e_a; de_a/dt has the components Ω_ia in the axes.
        return np.asarray((turn.T @ Q).ravel())

    answer = solve_ivp(rate, (0.0, float(times[-1])), axes.ravel(), "DOP853", times, rtol=1e-12, atol=1e-13)
    return np.asarray(answer.y.T.reshape(-1, 3, 3))


# --- Stresslet ----------------------------------------------------------------------------------------------


class SpheroidFunctions(NamedTuple):
    """Resistance functions of a prolate spheroid, each in units that make them 1 for a sphere (or 0: Y^H)."""

    XM: float
    YM: float
    ZM: float
    YH: float
    YC: float


def spheroid_functions(ratio: float) -> SpheroidFunctions:
    """Return X^M, Y^M, Z^M, Y^H and Y^C of a prolate spheroid of aspect ratio above 1 (Kim & Karrila 1991).

    In terms of its eccentricity e and L = ln((1 + e)/(1 − e)).
    """
    e2 = 1.0 - 1.0 / ratio**2
    e = math.sqrt(e2)
    L = math.log((1.0 + e) / (1.0 - e))
    m = (1.0 + e2) * L - 2.0 * e
    return SpheroidFunctions(
        XM=8.0 / 15.0 * e**5 / ((3.0 - e2) * L - 6.0 * e),
        YM=0.8 * e**5 * (2.0 * e * (1.0 - 2.0 * e2) - (1.0 - e2) * L)
        / ((2.0 * e * (2.0 * e2 - 3.0) + 3.0 * (1.0 - e2) * L) * m),
        ZM=3.2 * e**5 * (1.0 - e2) / (3.0 * (1.0 - e2) ** 2 * L - 2.0 * e * (3.0 - 5.0 * e2)),
        YH=4.0 / 3.0 * e**5 / m,
        YC=4.0 / 3.0 * e**3 * (2.0 - e2) / m,
    )  # fmt: skip


def spheroid_stresslet(ratio: float, axis: Floats, gradient: Floats) -> Floats:
    """Return the stresslet of a torque-free rigid prolate spheroid over viscosity and volume, (3, 3).

    S = (20/3) π μ a³ (X^M E₀ + Y^M E₁ + Z^M E₂) for a spheroid that does not turn against the fluid; free,
    it does, with the spin (Y^H/Y^C) p × (E·p), which takes 4π μ a³ (Y^H)²/Y^C E₁ away. E₀, E₁ and E₂ are the
    parts of the rate of strain that stretch along the axis p, shear it, and act across it.

    Parameters
    ----------
    ratio
        Aspect ratio a/b > 1.
    axis
        p, unit vector (3,).
    gradient
        ∂u_i/∂x_j of the fluid, of no trace, (3, 3).
    """
    f = spheroid_functions(ratio)
    E = 0.5 * (gradient + gradient.T)
    pp = np.outer(axis, axis)
    Ep = E @ axis
    pEp = float(axis @ Ep)
    E0 = 1.5 * pEp * (pp - np.eye(3) / 3.0)
    E1 = np.outer(axis, Ep) + np.outer(Ep, axis) - 2.0 * pEp * pp
    E2 = E - E0 - E1
    # In units of π μ a³, of which the volume 4π a³/(3 r²) is 4/(3 r²).
    free = 20.0 / 3.0 * f.YM - 4.0 * f.YH**2 / f.YC
    return np.asarray(0.75 * ratio**2 * (20.0 / 3.0 * (f.XM * E0 + f.ZM * E2) + free * E1))
