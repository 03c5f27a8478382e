"""Viscosity of generalised Newtonian fluids by their shear rate: OpenFOAM's laws.

The shear rate is √(2 d:d), OpenFOAM's ``strainRate``. Coefficients are those of the dynamic viscosity;
OpenFOAM's kinematic ones times the density.
"""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Scalar, Tensor, ddot, sym

__all__ = ["bird_carreau", "casson", "cross_power_law", "herschel_bulkley", "power_law", "shear_rate"]

_LEAST_RATE = 1e-300
"""Smallest shear rate, 1/s; OpenFOAM's VSMALL."""


def shear_rate(l_f: Tensor) -> Scalar:
    """Return the shear rate γ̇ = √(2 d_f:d_f) of a velocity gradient, 1/s."""
    d = sym(l_f)
    return np.sqrt(2.0 * ddot(d, d))


def _power(x: Scalar, exponent: Scalar) -> Scalar:
    """Return a power of a number ≥ 0; stages have no other."""
    return np.exp(exponent * np.log(np.maximum(x, _LEAST_RATE)))


def power_law(rate: Scalar, k: Scalar, n: Scalar, least: Scalar, most: Scalar) -> Scalar:
    """Return k γ̇ⁿ⁻¹ within limits, Pa s: ``powerLaw``."""
    return np.maximum(least, np.minimum(most, k * _power(rate, n - 1.0)))


def cross_power_law(rate: Scalar, mu0: Scalar, inf: Scalar, m: Scalar, n: Scalar) -> Scalar:
    """Return μ∞ + (μ₀ − μ∞)/(1 + (m γ̇)ⁿ), Pa s: ``CrossPowerLaw``."""
    return inf + (mu0 - inf) / (1.0 + _power(m * rate, n))


def bird_carreau(rate: Scalar, mu0: Scalar, inf: Scalar, k: Scalar, n: Scalar, a: Scalar) -> Scalar:
    """Return μ∞ + (μ₀ − μ∞)(1 + (k γ̇)ᵃ)^((n − 1)/a), Pa s: ``BirdCarreau``."""
    return inf + (mu0 - inf) * _power(1.0 + _power(k * rate, a), (n - 1.0) / a)


def herschel_bulkley(rate: Scalar, mu0: Scalar, tau0: Scalar, k: Scalar, n: Scalar) -> Scalar:
    """Return (τ₀ + k γ̇ⁿ)/γ̇, at most μ₀, Pa s: ``HerschelBulkley``."""
    return np.minimum(mu0, (tau0 + k * _power(rate, n)) / np.maximum(rate, _LEAST_RATE))


def casson(rate: Scalar, m: Scalar, tau0: Scalar, least: Scalar, most: Scalar) -> Scalar:
    """Return (√(τ₀/γ̇) + √m)² within limits, Pa s: ``Casson``."""
    root = np.sqrt(tau0 / np.maximum(rate, _LEAST_RATE)) + np.sqrt(m)
    return np.maximum(least, np.minimum(most, root * root))
