"""Elastic solids, each a stored energy of the invariants I₁, I₂ of b = F Fᵀ and J = det F.

A solid has a shear modulus μ, Lamé's λ and, if it needs one, a third parameter k. The Kirchhoff stress
follows from the energy's derivatives, τ = 2(w₁ + I₁w₂) b − 2w₂ b² + J w_J I; it and its tangent are formed
elsewhere, so that a new solid is its energy, its derivatives and a line in :data:`MATERIALS`.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import NamedTuple

import numpy as np

from foamprb.body.tensor import Scalar, Tensor, add, cofactor, det, dot, log_ratio, scale, transpose

Derivatives = Callable[[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar], tuple[Scalar, Scalar, Scalar]]


class Parameter(NamedTuple):
    """A solid's third parameter k: its entry in the settings, and its range, ``lower`` < k ≤ ``upper``."""

    entry: str
    lower: float
    upper: float


class Material(NamedTuple):
    """An isotropic hyperelastic solid."""

    energy: Callable[[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar], Scalar]
    """Stored energy per undeformed volume w₀(I₁, I₂, J, μ, λ, k), J/m³."""
    derivatives: Derivatives
    """∂w₀/∂I₁, ∂w₀/∂I₂ and ∂w₀/∂J of the same, Pa."""
    parameter: Parameter | None = None
    dilation: Callable[[Scalar, Scalar, Scalar], Scalar] | None = None
    """J d(J w_J)/dJ of (J, μ, λ), Pa, where P = φ F + ψ(J) F⁻ᵀ with φ constant: for the paper's scheme."""
    isochoric: bool = True
    """Whether a pressure may stand for λ, as the integrator without inertia has it."""


def neo_hooke_energy(I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar) -> Scalar:
    """w₀ = ½ μ (I₁ − 3 − 2 ln J) + ½ λ ln² J, J/m³."""
    log_J = log_ratio(J)
    return 0.5 * mu * (I1 - 3.0 - 2.0 * log_J) + 0.5 * lame * log_J * log_J


def neo_hooke_derivatives(
    _I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """½ μ, 0 and (λ ln J − μ)/J, Pa: P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ (24), where the paper prints F⁻¹ once."""
    return 0.5 * mu, 0.0 * mu, (lame * log_ratio(J) - mu) / J


def neo_hooke_dilation(_J: Scalar, _mu: Scalar, lame: Scalar) -> Scalar:
    """J dψ/dJ = λ for ψ = λ ln J − μ, Pa."""
    return lame


def _mooney_rivlin_moduli(mu: Scalar, lame: Scalar, k: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """c₁ = ½ μ(1 − k), c₂ = ½ μ k and λ' = λ − 4c₂, Pa, with which λ is that of small strains."""
    return 0.5 * mu * (1.0 - k), 0.5 * mu * k, lame - 2.0 * mu * k


def mooney_rivlin_energy(I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Scalar:
    """w₀ = c₁(I₁ − 3) + c₂(I₂ − 3) − (2c₁ + 4c₂) ln J + ½ λ' ln² J, J/m³; k is the share c₂/(c₁ + c₂)."""
    log_J = log_ratio(J)
    c1, c2, bulk = _mooney_rivlin_moduli(mu, lame, k)
    shear = c1 * (I1 - 3.0) + c2 * (I2 - 3.0) - (2.0 * c1 + 4.0 * c2) * log_J
    return shear + 0.5 * bulk * log_J * log_J


def mooney_rivlin_derivatives(
    _I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """c₁, c₂ and (λ' ln J − 2c₁ − 4c₂)/J, Pa."""
    c1, c2, bulk = _mooney_rivlin_moduli(mu, lame, k)
    return c1, c2, (bulk * log_ratio(J) - 2.0 * c1 - 4.0 * c2) / J


def saint_venant_kirchhoff_energy(
    I1: Scalar, I2: Scalar, _J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> Scalar:
    """w₀ = ½ λ tr² E + μ E:E with E = ½(Fᵀ F − I), J/m³."""
    trace = 0.5 * (I1 - 3.0)
    return 0.5 * lame * trace * trace + 0.25 * mu * (I1 * I1 - 2.0 * I2 - 2.0 * I1 + 3.0)


def saint_venant_kirchhoff_derivatives(
    I1: Scalar, _I2: Scalar, _J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """¼ λ(I₁ − 3) + ½ μ(I₁ − 1), −½ μ and 0, Pa."""
    return 0.25 * lame * (I1 - 3.0) + 0.5 * mu * (I1 - 1.0), -0.5 * mu, 0.0 * mu


def gent_energy(I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar) -> Scalar:
    """w₀ = −½ μ k ln(1 − (I₁ − 3)/k) − μ ln J + ½ (λ − 2μ/k) ln² J (after Gent 1996), J/m³; I₁ < 3 + k."""
    log_J = log_ratio(J)
    bulk = lame - 2.0 * mu / k
    return -0.5 * mu * k * np.log(1.0 - (I1 - 3.0) / k) - mu * log_J + 0.5 * bulk * log_J * log_J


def gent_derivatives(
    I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """½ μ k/(k − I₁ + 3), 0 and ((λ − 2μ/k) ln J − μ)/J, Pa; infinite from the limit of stretch on."""
    room = np.maximum(k - I1 + 3.0, 0.0)
    return 0.5 * mu * k / room, 0.0 * mu, ((lame - 2.0 * mu / k) * log_ratio(J) - mu) / J


MATERIALS: dict[str, Material] = {
    "neoHooke": Material(neo_hooke_energy, neo_hooke_derivatives, dilation=neo_hooke_dilation),
    "mooneyRivlin": Material(
        mooney_rivlin_energy, mooney_rivlin_derivatives, Parameter("mooneyRatio", 0.0, 1.0)
    ),
    "saintVenantKirchhoff": Material(
        saint_venant_kirchhoff_energy, saint_venant_kirchhoff_derivatives, isochoric=False
    ),
    "gent": Material(gent_energy, gent_derivatives, Parameter("stretchLimit", 0.0, inf)),
}
"""The solids by the names under which the settings select them."""


def invariants(b: Tensor) -> tuple[Scalar, Scalar]:
    """I₁ = tr b and I₂ = ½(I₁² − b:b) of b = F Fᵀ."""
    I1 = b[0] + b[4] + b[8]
    off = b[1] * b[1] + b[2] * b[2] + b[5] * b[5]
    return I1, b[0] * b[4] + b[4] * b[8] + b[8] * b[0] - off


def stored_energy(material: Material, F: Tensor, mu: Scalar, lame: Scalar, k: Scalar = 0.0) -> Scalar:
    """Stored energy per undeformed volume of a deformation gradient, J/m³."""
    I1, I2 = invariants(dot(F, transpose(F)))
    return material.energy(I1, I2, det(F), mu, lame, k)


def piola(material: Material, F: Tensor, mu: Scalar, lame: Scalar, k: Scalar = 0.0) -> Tensor:
    """Piola stress P = ∂w₀/∂F = 2(w₁ + I₁w₂) F − 2w₂ b F + w_J cof F (20), Pa."""
    b, J = dot(F, transpose(F)), det(F)
    I1, I2 = invariants(b)
    w1, w2, wJ = material.derivatives(I1, I2, J, mu, lame, k)
    return add(add(scale(2.0 * (w1 + I1 * w2), F), scale(-2.0 * w2, dot(b, F))), scale(wJ, cofactor(F)))


def lame_parameter(mu: Scalar, poissons_ratio: Scalar) -> Scalar:
    """λ_s = 2 μ ν/(1 − 2ν), Pa, of a solid with shear modulus μ and Poisson's ratio ν < ½."""
    return 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio)
