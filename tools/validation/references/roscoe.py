"""Roscoe's steady viscoelastic ellipsoid in simple shear, by his algebraic equations."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from validation.references import Floats
from validation.references.ellipsoid import integrals
from validation.references.shear import ShearShape


class Roscoe(NamedTuple):
    """Roscoe's (1967) steady viscoelastic ellipsoid in simple shear, for one pair of semi-axes."""

    axes: Floats
    """a₁ > a₃ > a₂, of product 1; a₁ and a₂ in the plane of shear."""
    angle: float
    """θ, degrees."""
    Ca: float
    """η₀ γ̇/μ₁; infinite where a viscous solid is never stretched so far."""


def _roscoe_integrals(axes: Floats) -> tuple[float, float, float]:
    """Return I, J and K of Roscoe (1967) from g₁″, g₂″, g₃″ and g₃′."""
    g = integrals(axes)
    g1, g2, g3 = g.star
    n = g2 * g3 + g3 * g1 + g1 * g2
    a1, a2, _ = axes**2
    return 0.4 * (g1 + g2) / n, 0.4 * (g1 - g2) / n, float((a1 + a2) / (5.0 * g.ring[2] * a1 * a2))


def roscoe(a1: float, viscosity_ratio: float = 0.0) -> Roscoe:
    """Return Roscoe's solution for the longest semi-axis a₁ > 1, by his algebraic equations.

    R. Roscoe, On the rheology of a suspension of viscoelastic spheres in a viscous liquid, J. Fluid Mech. 28
    (1967) 273–293, as restated for semi-axes of product 1.

    Parameters
    ----------
    viscosity_ratio
        η₁/η₀ of solid and fluid.
    """

    def axes(a2: float) -> Floats:
        return np.array([a1, a2, 1.0 / (a1 * a2)])

    def balance(a2: float) -> float:
        I, Jr, _ = _roscoe_integrals(axes(a2))
        return float((a1**2 + a2**2 - 2.0 / (a1 * a2) ** 2) * I - Jr * (a1**2 - a2**2))

    a2 = float(brentq(balance, 0.2 / a1, 1.0 - 1e-12, xtol=1e-15, rtol=1e-14))
    I, _, K = _roscoe_integrals(axes(a2))
    # In units of η₀/μ₁: σ = 5/2, τ = 3/2 + η₁/η₀.
    sigma, tau = 2.5, 1.5 + viscosity_ratio
    q = (tau - sigma) / (K * sigma)
    s, d = a1**2 + a2**2, a1**2 - a2**2
    cosine = d / s * (1.0 + q * (s / (2.0 * a1 * a2)) ** 2) / (1.0 + q * (d / (2.0 * a1 * a2)) ** 2)
    if not abs(cosine) < 1.0:
        return Roscoe(axes(a2), 0.0, np.inf)
    double = float(np.arccos(cosine))
    return Roscoe(axes(a2), float(np.degrees(double)) / 2.0, float(d / (2.0 * I * sigma * np.sin(double))))


def roscoe_at(Ca: float, viscosity_ratio: float = 0.0) -> ShearShape:
    """Return Roscoe's solution at a capillary number η₀γ̇/μ₁.

    The spin follows from his ν: the steady l_s carries the ellipse into itself, so that in its axes it has
    the components l₁₂ = ν a/b and l₂₁ = −ν b/a, and |ω_s3| = ν (a² + b²)/(2ab).
    """

    # 1/Ca falls through zero where a viscous solid can be stretched no further.
    def miss(a: float) -> float:
        return 1.0 / roscoe(a, viscosity_ratio).Ca - 1.0 / Ca

    a1 = float(brentq(miss, 1.0 + 1e-4 * Ca, 6.0, xtol=1e-14))
    ellipsoid = roscoe(a1, viscosity_ratio)
    a, b, c = ellipsoid.axes
    nu = roscoe_frequency(a, b, ellipsoid.angle)
    return ShearShape((a - b) / (a + b), b / a, c / a, ellipsoid.angle, nu * (a * a + b * b) / (2 * a * b))


def roscoe_frequency(a: float, b: float, angle: float) -> float:
    """Return Roscoe's ν/γ̇ = (a² + b²)/(2ab) · [1 − (a² − b²)/(a² + b²) cos 2θ]/2, θ in degrees."""
    a2, b2 = a * a, b * b
    return float(
        (a2 + b2) / (2 * a * b) * (1.0 - (a2 - b2) / (a2 + b2) * np.cos(2 * np.radians(angle))) / 2.0
    )
