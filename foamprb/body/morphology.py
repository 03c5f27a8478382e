"""Morphology tensor: the shape of a drop or of a blood cell, an ellipsoid that remembers the flow.

    dS/dt = f₃ (W S − S W) − f₁ (S − g I) + f₂ (E S + S E),   g = 3 III/II

with the invariants II and III of S, whose eigenvalues are the squares of the semi-axes; E and W are the
symmetric and the skew part of ∂u_i/∂x_j. Drops follow it with f₃ = 1 (Maffettone & Minale, J. Non-Newton.
Fluid Mech. 78, 227, 1998), the model cells of Arora, Behr & Pasquali (Artif. Organs 28, 1002, 2004) with
f₃ = f₂.

With S = F Fᵀ it is dF/dt = l F, where l = f₃ W + f₂ E − ½ f₁ (I − g S⁻¹) is traceless, so that the volume is
kept. A drop is thus a body with the velocity gradient l. The last term is the stress of an incompressible
solid of the energy ³⁄₂ μ ln (I₂/3) (:func:`drop_energy`) with a linear mobility (:func:`drop_mobility`).

Arguments of the drop's functions:

ratio
    λ, viscosity of the drop over that of the fluid.
Ca
    μ_f γ̇ R/σ with γ̇ = √(2 E:E) and the surface tension σ.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.stokes import Mobility
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    add,
    add_identity,
    cofactor,
    ddot,
    det,
    dev,
    dot,
    log_ratio,
    scale,
    subtract,
    sym,
    trace,
    transpose,
)


class Rates(NamedTuple):
    """Coefficients of the equation."""

    recovery: float
    """f₁, 1/s."""
    strain: float
    """f₂."""
    vorticity: float
    """f₃."""


def recovering(S: Tensor) -> Tensor:
    """Return I − g S⁻¹, which vanishes for a sphere and whose trace is 0; g S⁻¹ = 3 cof S/tr cof S."""
    C = cofactor(S)
    return add_identity(scale(-3.0 / trace(C), C), 1.0)


def morphology_rate(S: Tensor, l_f: Tensor, rates: Rates) -> Tensor:
    """Return dS/dt, 1/s, for the fluid's ∂u_i/∂x_j, 1/s."""
    f1, f2, f3 = rates
    E = sym(l_f)
    l = add(scale(f2, E), scale(f3, subtract(l_f, E)))
    half = dot(subtract(l, scale(0.5 * f1, recovering(S))), S)
    return add(half, transpose(half))


def morphology_step(S: Tensor, l0: Tensor, l1: Tensor, h: Scalar, rates: Rates) -> Tensor:
    """Return S after a step h, s, of the classical Runge–Kutta method; det S = 1 is kept.

    ∂u_i/∂x_j of the fluid, 1/s, is linear in time between ``l0`` and ``l1``.
    """
    middle = scale(0.5, add(l0, l1))
    k1 = morphology_rate(S, l0, rates)
    k2 = morphology_rate(add(S, scale(0.5 * h, k1)), middle, rates)
    k3 = morphology_rate(add(S, scale(0.5 * h, k2)), middle, rates)
    k4 = morphology_rate(add(S, scale(h, k3)), l1, rates)
    total = add(add(k1, k4), scale(2.0, add(k2, k3)))
    new = add(S, scale(h * (1.0 / 6.0), total))
    return scale(det(new) ** (-1.0 / 3.0), new)


# ---------------------------------------------------------------------------------------------------------
# Drops


def recovery_of_drop(ratio: Scalar) -> Scalar:
    """Return f₁ in units of σ/(μ_f R)."""
    return 40.0 * (ratio + 1.0) / ((2.0 * ratio + 3.0) * (19.0 * ratio + 16.0))


def strain_of_drop(ratio: Scalar, Ca: Scalar) -> Scalar:
    """Return f₂."""
    square = Ca * Ca
    return 5.0 / (2.0 * ratio + 3.0) + 3.0 * square / (2.0 + 6.0 * square)


def drop_growth(l_f: Tensor, ratio: Scalar, time: Scalar) -> tuple[Tensor, Scalar]:
    """Return a tensor and a limit: a drop breaks up if the real part of an eigenvalue exceeds the limit.

    dS/dt = A S + S Aᵀ − f₁ (S − g I)/τ with A = W + f₂ E has a steady solution if all eigenvalues of A τ are
    below f₁/2. ``time`` is τ = μ_f R/σ, s.
    """
    E = sym(l_f)
    f2 = strain_of_drop(ratio, time * np.sqrt(2.0 * ddot(E, E)))
    growing = add(subtract(l_f, E), scale(f2, E))
    return scale(time, growing), 0.5 * recovery_of_drop(ratio)


def drop_energy(_I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar) -> Scalar:
    """Return w₀ = ³⁄₂ μ ln (I₂/3) − 2 μ ln J + ½ (λ + ⅔ μ) ln² J, J/m³: its stress is μ (I − g S⁻¹)."""
    log_J = log_ratio(J)
    return 1.5 * mu * np.log(I2 / 3.0) - 2.0 * mu * log_J + 0.5 * (lame + mu / 1.5) * log_J * log_J


def drop_derivatives(
    _I1: Scalar, I2: Scalar, J: Scalar, mu: Scalar, lame: Scalar, _k: Scalar
) -> tuple[Scalar, Scalar, Scalar]:
    """Return 0, ³⁄₂ μ/I₂ and ((λ + ⅔ μ) ln J − 2 μ)/J, Pa; μ = σ/R."""
    return 0.0 * mu, 1.5 * mu / I2, ((lame + mu / 1.5) * log_ratio(J) - 2.0 * mu) / J


def drop_mobility(ratio: Scalar, Ca: Scalar) -> Mobility:
    """Return the mobility of l_s = W + f₂ E − ½ f₁ σ'/μ_f, with the stress σ' of :func:`drop_energy`."""
    f1, f2 = recovery_of_drop(ratio), strain_of_drop(ratio, Ca)
    p, q, zero = -f1 / 3.0, f1 / 6.0, 0.0 * f1
    return Mobility((p, q, q, q, p, q, q, q, p), (f1, f1, f1), (zero, zero, zero), (f2 - 1.0) / f1)


def drop_drag_factor(ratio: Scalar) -> Scalar:
    """Return the drag of a spherical drop over that of a solid one (Hadamard 1911, Rybczyński 1911)."""
    return (2.0 + 3.0 * ratio) / (3.0 + 3.0 * ratio)


def drop_stress(ratio: Scalar, Ca: Scalar, E: Tensor, d_s: Tensor, S: Tensor) -> Tensor:
    """Return the extra stress of a drop over μ_f, its stresslet over its volume, 1/s.

        10 (λ − 1)/(2λ + 3) E + 4/(2λ + 3) σ'/μ_f + k dev sym(X E),        X = I − g S⁻¹,
        k = 3 (25λ² + 41λ + 4)/(35 (λ + 1)²).

    In steady flow it is exact to second order in the deformation, with the normal stresses of Schowalter,
    Chaffey & Brenner (J. Colloid Interface Sci. 26, 152, 1968); to first order it is Taylor's (1932)
    (5λ + 2)/(λ + 1) E. k makes up for the second-order error of the shape too. σ' follows from d_s = f₂ E −
    ½ f₁ σ'/μ_f.
    """
    f1, f2 = recovery_of_drop(ratio), strain_of_drop(ratio, Ca)
    k = 1.0 / (2.0 * ratio + 3.0)
    elastic = scale(8.0 * k / f1, subtract(scale(f2, E), d_s))
    n = 1.0 / (ratio + 1.0)
    second = (3.0 / 35.0) * n * n * (4.0 + ratio * (41.0 + 25.0 * ratio))
    bent = scale(second, dev(sym(dot(recovering(S), E))))
    return add(add(scale(10.0 * (ratio - 1.0) * k, E), elastic), bent)
