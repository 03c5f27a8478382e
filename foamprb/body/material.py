"""Elastic solids: stored energy and Piola stress."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from foamprb.body.tensor import Scalar, Tensor, add, cofactor, ddot, det, log_ratio, scale


class Material(NamedTuple):
    """An isotropic hyperelastic solid with Piola stress P = φ F + ψ(J) F⁻ᵀ and two Lamé parameters."""

    energy: Callable[[Tensor, Scalar, Scalar], Scalar]
    """Stored energy per undeformed volume w₀(F, μ, λ), J/m³."""
    coefficients: Callable[[Scalar, Scalar, Scalar], tuple[Scalar, Scalar, Scalar]]
    """φ, ψ and J dψ/dJ of (J, μ, λ), Pa."""
    derivatives: Callable[[Scalar, Scalar, Scalar, Scalar, Scalar], tuple[Scalar, Scalar, Scalar]]
    """∂w₀/∂I₁, ∂w₀/∂I₂ and ∂w₀/∂J of (I₁, I₂, J, μ, λ), Pa; I₁ and I₂ are those of b = F Fᵀ."""


def neo_hooke_energy(F: Tensor, mu: Scalar, lame: Scalar) -> Scalar:
    """w₀ = ½ μ (F:F − 3 − 2 ln J) + ½ λ ln² J, J/m³, whose derivative is (24)."""
    log_J = log_ratio(det(F))
    return 0.5 * mu * (ddot(F, F) - 3.0 - 2.0 * log_J) + 0.5 * lame * log_J * log_J


def neo_hooke_coefficients(J: Scalar, mu: Scalar, lame: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """φ = μ, ψ = λ ln J − μ and J dψ/dJ = λ: P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ (24), Pa.

    The paper prints F⁻¹ for the first F⁻ᵀ.

    Parameters
    ----------
    J
        Volume ratio det F, in [1/8, 8].
    mu, lame
        Shear modulus μ_s and λ_s, Pa.
    """
    return mu, lame * log_ratio(J) - mu, lame


def neo_hooke_derivatives(
    _I1: Scalar, _I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """½ μ, 0 and (λ ln J − μ)/J, Pa: the derivatives of :func:`neo_hooke_energy` by the invariants."""
    return 0.5 * mu, 0.0 * mu, (lame * log_ratio(J) - mu) / J


MATERIALS: dict[str, Material] = {
    "neoHooke": Material(neo_hooke_energy, neo_hooke_coefficients, neo_hooke_derivatives),
}


def piola(material: Material, F: Tensor, mu: Scalar, lame: Scalar) -> Tensor:
    """Piola stress P = ∂w₀/∂F (20) of a material, Pa."""
    J = det(F)
    phi, psi, _ = material.coefficients(J, mu, lame)
    return add(scale(phi, F), scale(psi / J, cofactor(F)))


def lame_parameter(mu: Scalar, poissons_ratio: Scalar) -> Scalar:
    """λ_s = 2 μ ν/(1 − 2ν), Pa, of a solid with shear modulus μ and Poisson's ratio ν < ½."""
    return 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio)
