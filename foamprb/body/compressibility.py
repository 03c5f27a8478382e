"""Bulk modulus of a solid, independent of its shear modulus.

Soft matter is mostly water. Its bulk modulus K, some 10⁹ Pa, does not depend on its shear modulus. A constant
Poisson's ratio couples the two, λ = 499 μ for ν = 0.499: the softer the body, the more it is compressed. For
the neo-Hooke solid

    ln J = [⅓ tr(J σ̃) − μ_s (I₁/3 − 1)]/λ,

where both terms are of the order of the larger of μ_s and μ_f γ̇. In simple shear from rest up to γ̇t = 6,
with K = N max(μ_s, μ_f γ̇), |J − 1| stays below 0.8/N for Ca up to 10⁴.
"""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Scalar

ENOUGH = 1e4
"""Bulk modulus over the largest stress at which the volume is constant to 10⁻⁴."""


INCOMPRESSIBLE = 1e5
"""Largest λ over the largest stress on a body."""


def limited_lame(lame: Scalar, stress: Scalar) -> Scalar:
    """Return λ, Pa, or 10⁵ times the largest of the stresses on a body, Pa, if that is less.

    The volume is then constant to about 10⁻⁵, and the shape that of an incompressible body to about as much.
    The pressure of a solid with water's 2·10⁹ Pa is a difference of numbers 10¹¹ times larger.
    """
    return np.minimum(lame, INCOMPRESSIBLE * stress)


def lame_from_bulk_modulus(bulk: Scalar, mu: Scalar) -> Scalar:
    """Return λ = K − ⅔ μ, Pa, of a solid with bulk modulus K and shear modulus μ."""
    return bulk - 2.0 / 3.0 * mu


def bulk_modulus(mu: Scalar, poissons_ratio: Scalar) -> Scalar:
    """Return K = ⅔ μ (1 + ν)/(1 − 2ν), Pa, of a solid with shear modulus μ and Poisson's ratio ν < ½."""
    return 2.0 / 3.0 * mu * (1.0 + poissons_ratio) / (1.0 - 2.0 * poissons_ratio)


def sufficient_bulk_modulus(mu: Scalar, viscous_stress: Scalar) -> Scalar:
    """Return the bulk modulus, Pa, that keeps the volume of a body of any softness: 10⁴ max(μ_s, μ_f γ̇).

    ``mu`` is the shear modulus, ``viscous_stress`` μ_f γ̇ at the largest shear rate on the path, both in Pa.
    """
    return ENOUGH * np.maximum(mu, viscous_stress)
