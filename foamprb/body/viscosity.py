"""Viscosity of generalised Newtonian fluids by their shear rate: OpenFOAM's laws.

The shear rate is √(2 d:d), OpenFOAM's ``strainRate``. Coefficients are those of the dynamic viscosity;
OpenFOAM's kinematic ones times the density.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import MISSING, astuple, dataclass, fields
from typing import Any, ClassVar

import numpy as np

from foamprb.body.tensor import Scalar, Tensor, ddot, sym

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


@dataclass(frozen=True, kw_only=True)
class RateLaw:
    """A law of the shear rate; its fields are the arguments of the formula."""

    law: ClassVar[Callable[..., Any]]
    """The formula."""
    by_density: ClassVar[tuple[str, ...]]
    """Coefficients that are the kinematic ones times the density."""

    def at(self, rate: Any) -> Any:
        """Return the viscosity, Pa s, at a shear rate, 1/s."""
        return type(self).law(rate, *astuple(self))

    @classmethod
    def kinematic_names(cls) -> dict[str, float | None]:
        """Return OpenFOAM's names of the coefficients, with their default values, None if required."""
        return {
            field.name.replace("mu", "nu"): None if field.default is MISSING else float(field.default)
            for field in fields(cls)
        }


@dataclass(frozen=True, kw_only=True)
class PowerLaw(RateLaw):
    """k γ̇ⁿ⁻¹ between two limits, OpenFOAM's ``powerLaw``: k in Pa sⁿ, limits in Pa s."""

    k: float
    n: float
    muMin: float = 0.0
    muMax: float = math.inf

    law: ClassVar = staticmethod(power_law)
    by_density: ClassVar = ("k", "muMin", "muMax")


@dataclass(frozen=True, kw_only=True)
class CrossPowerLaw(RateLaw):
    """μ∞ + (μ₀ − μ∞)/(1 + (m γ̇)ⁿ), OpenFOAM's ``CrossPowerLaw``: μ in Pa s, m in s."""

    mu0: float
    muInf: float
    m: float
    n: float

    law: ClassVar = staticmethod(cross_power_law)
    by_density: ClassVar = ("mu0", "muInf")


@dataclass(frozen=True, kw_only=True)
class BirdCarreau(RateLaw):
    """μ∞ + (μ₀ − μ∞)(1 + (k γ̇)ᵃ)^((n − 1)/a), OpenFOAM's ``BirdCarreau``: μ in Pa s, k in s."""

    mu0: float
    muInf: float
    k: float
    n: float
    a: float = 2.0

    law: ClassVar = staticmethod(bird_carreau)
    by_density: ClassVar = ("mu0", "muInf")


@dataclass(frozen=True, kw_only=True)
class HerschelBulkley(RateLaw):
    """(τ₀ + k γ̇ⁿ)/γ̇, at most μ₀, OpenFOAM's ``HerschelBulkley``: μ₀ in Pa s, τ₀ in Pa, k in Pa sⁿ."""

    mu0: float
    tau0: float
    k: float
    n: float

    law: ClassVar = staticmethod(herschel_bulkley)
    by_density: ClassVar = ("mu0", "tau0", "k")


@dataclass(frozen=True, kw_only=True)
class Casson(RateLaw):
    """(√(τ₀/γ̇) + √m)² between two limits, OpenFOAM's ``Casson``: m and limits in Pa s, τ₀ in Pa."""

    m: float
    tau0: float
    muMin: float = 0.0
    muMax: float = math.inf

    law: ClassVar = staticmethod(casson)
    by_density: ClassVar = ("m", "tau0", "muMin", "muMax")


LAWS: dict[str, type[RateLaw]] = {
    "BirdCarreau": BirdCarreau,
    "Casson": Casson,
    "CrossPowerLaw": CrossPowerLaw,
    "HerschelBulkley": HerschelBulkley,
    "powerLaw": PowerLaw,
}
"""By OpenFOAM's names."""
