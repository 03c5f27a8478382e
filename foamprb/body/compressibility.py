"""How much a solid yields to pressure, apart from how much it yields to shear.

Soft matter is mostly water. Its bulk modulus K, some 10⁹ Pa, has nothing to do with its shear modulus.
Poisson's ratio ties the two together, λ = 499 μ for ν = 0.499: the softer the body, the more it is squeezed.
For the neo-Hooke solid

    ln J = [⅓ tr(J σ̃) − μ_s (I₁/3 − 1)]/λ,

where both terms are of the order of the larger of μ_s and μ_f γ̇. In simple shear from rest up to γ̇t =
6, with K = N max(μ_s, μ_f γ̇), |J − 1| stays below 0.8/N for Ca up to 10⁴.
"""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Scalar

ENOUGH = 1e4
"""Bulk modulus over the largest stress with which the volume is kept to 10⁻⁴."""


def lame_from_bulk_modulus(bulk: Scalar, mu: Scalar) -> Scalar:
    """λ = K − ⅔ μ, Pa, of a solid with bulk modulus K and shear modulus μ."""
    return bulk - 2.0 / 3.0 * mu


def bulk_modulus(mu: Scalar, poissons_ratio: Scalar) -> Scalar:
    """K = ⅔ μ (1 + ν)/(1 − 2ν), Pa, of a solid with shear modulus μ and Poisson's ratio ν < ½."""
    return 2.0 / 3.0 * mu * (1.0 + poissons_ratio) / (1.0 - 2.0 * poissons_ratio)


def sufficient_bulk_modulus(mu: Scalar, viscous_stress: Scalar) -> Scalar:
    """Bulk modulus, Pa, that keeps the volume of a body however soft it is: 10⁴ max(μ_s, μ_f γ̇).

    A larger one costs the paper's scheme more than the three iterations that it has at hand, at Δt =
    τ_s/3. And the pressure is K times a difference of J from 1 that round-off reaches: with water's 2 ·
    10⁹ Pa it is wrong by 10⁻⁶ Pa, where the fluid's stress in air is 10⁻² Pa.

    Parameters
    ----------
    mu
        Shear modulus of the solid, Pa.
    viscous_stress
        μ_f γ̇, Pa, with the largest shear rate that the body meets.
    """
    return ENOUGH * np.maximum(mu, viscous_stress)
