"""A soft sphere without inertia in simple shear: its transient by scipy, and tables of steady shapes.

Independent of foamprb's own code. Vectors are arrays (3,), tensors (3, 3); lengths in radii of the sphere at
rest, rates in units of γ̇.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from validation.references import Floats
from validation.references.ellipsoid import diagonal_response, integrals, symmetric_and_skew


def inertialess_rate(F: Floats, l_f: Floats, Ca: float, viscosity_ratio: float = 0.0) -> Floats:
    """Return the velocity gradient l_s/γ̇ of an incompressible neo-Hooke body without inertia, (3, 3).

    The balance σ̃(F, l_s; l_f) = σ(F) solved in the particle frame, where it decouples; a Kelvin–Voigt solid
    adds 2 η_s d_s to its stress.

    Parameters
    ----------
    F
        Deformation gradient, det F = 1.
    l_f
        Velocity gradient of the fluid, in units of γ̇.
    Ca
        μ_f γ̇/μ_s.
    viscosity_ratio
        η_s/μ_f of the solid.
    """
    U, axes, _ = np.linalg.svd(F)
    d_f, w_f = symmetric_and_skew(U.T @ l_f @ U)
    g = integrals(axes)
    volume = np.prod(axes)
    keep = 1.0 - viscosity_ratio
    l_s = np.zeros((3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        a2, b2 = axes[i] ** 2, axes[j] ** 2
        delta = keep * d_f[j, i] / (keep - 2.0 / (volume * g.ring[k] * (a2 + b2)))
        spin = w_f[j, i] + (a2 - b2) / (a2 + b2) * delta
        l_s[j, i] = d_f[j, i] - delta + spin
        l_s[i, j] = d_f[j, i] - delta - spin
    M = diagonal_response(axes)
    # Three balances −p + M·(d_f − d_s) + 2 (1 − η_s/μ_f) d_s = λ²/Ca, and Σ d_s = 0.
    system = np.zeros((4, 4))
    system[:3, :3] = 2.0 * keep * np.eye(3) - M
    system[:3, 3] = -1.0
    system[3, :3] = 1.0
    load = np.append(axes**2 / Ca - M @ np.diag(d_f), 0.0)
    l_s += np.diag(np.linalg.solve(system, load)[:3])
    return np.asarray(U @ l_s @ U.T)


def inertialess_history(
    l_f: Floats, Ca: float, times: Floats, viscosity_ratio: float = 0.0, tolerance: float = 1e-11
) -> Floats:
    """Return deformation gradients (n, 3, 3) at rising times in units of 1/γ̇, from a sphere at time 0."""

    def rate(_t: float, y: Floats) -> Floats:
        F = y.reshape(3, 3)
        return (inertialess_rate(F, l_f, Ca, viscosity_ratio) @ F).ravel()

    answer = solve_ivp(
        rate, (0.0, float(times[-1])), np.eye(3).ravel(), "DOP853", times, rtol=tolerance, atol=tolerance
    )
    return np.asarray(answer.y.T.reshape(-1, 3, 3))


class ShearShape(NamedTuple):
    """A body in the shear flow u₁ = γ̇ x₂."""

    deformation: float
    """D = (a − b)/(a + b), a and b the axes in the plane of shear."""
    b_over_a: float
    c_over_a: float
    """c along the vorticity."""
    angle: float
    """θ of the long axis to the flow, degrees."""
    spin: float
    """|ω_s3|/γ̇, ω_s the axial vector of skew l_s."""


def shear_shape(F: Floats, l_s: Floats) -> ShearShape:
    """Return the shape of a body with F and velocity gradient l_s in units of γ̇, each (3, 3)."""
    values, vectors = np.linalg.eigh((F @ F.T)[:2, :2])
    b, a = np.sqrt(values)
    c = np.linalg.norm(F[2])
    angle = np.degrees(np.arctan(vectors[1, 1] / vectors[0, 1]))
    return ShearShape(
        (a - b) / (a + b), b / a, float(c / a), float(angle), abs(0.5 * (l_s[1, 0] - l_s[0, 1]))
    )


SHEAR = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""Velocity gradient of the simple shear l₁₂ = γ̇ in units of γ̇."""

STEADY_SHAPES = {
    0.01: ShearShape(0.01250, 0.97531, 0.98760, 44.570, 0.50012),
    0.1: ShearShape(0.12392, 0.77949, 0.88485, 40.733, 0.51242),
    0.4: ShearShape(0.44314, 0.38587, 0.64198, 29.397, 0.68281),
}
"""Steady simple shear by Ca, from an independent high-order solution, rounded as written."""

TRANSIENT_SHAPES = {1.0: (0.4494, 0.6927, 34.86), 3.0: (0.3833, 0.6410, 29.62)}
"""b/a, c/a and θ (degrees) at Ca = 0.4 by γ̇t, from the same solution."""


def steady_shear(Ca: float, viscosity_ratio: float = 0.0) -> ShearShape:
    """Return steady shape in simple shear: the end of a long transient of :func:`inertialess_history`."""
    end = 30.0 + 120.0 * Ca * (1.0 + viscosity_ratio)
    F = inertialess_history(SHEAR, Ca, np.array([end]), viscosity_ratio)
    return shear_shape(F[-1], inertialess_rate(F[-1], SHEAR, Ca, viscosity_ratio))


def tank_treading_rate(l_s: Floats) -> float:
    """Return Roscoe's ν/γ̇ of a steady body: the eigenvalues of l_s in the plane are ±iν."""
    return float(np.sqrt(np.linalg.det(l_s[:2, :2])))
