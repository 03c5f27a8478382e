"""The paper's implicit–explicit Euler step of the shape (Sect. 4.2, Appendix E).

The stress σ̃* of the traction is that of the old shape. The new deformation gradient solves

    R(F) = F − Fⁿ − Δt Aⁿ − κ [J σ̃* F⁻ᵀ − P(F)] = 0,   κ = Δt² vol₀/Θ = 5 Δt²/(ρ_s R²)

by Newton's method, in the particle frame of the old shape: G = Q·F, where G Gᵀ and σ̃* are nearly diagonal.
With H = X G and P = φ F M + ψ F⁻ᵀ, Newton's equation times Gᵀ is

    X B + κ S Xᵀ − κ tr(X) D = r,   r = B − G* Gᵀ − κ S,

where B = G Gᵀ + κφ b_e with the elastic b_e = G M Gᵀ, G* = Q·(Fⁿ + Δt Aⁿ), S = Jσ̃* − ψ I and
D = Jσ̃* − (J dψ/dJ) I. This is (50) for M = I, b_e = G Gᵀ. Arguments of the iteration:

G, predictor
    The iterate Q·F, and G*.
stress
    σ̃*, Pa, particle frame.
kappa
    :func:`inertia_factor`, 1/Pa.
mu, lame
    Lamé parameters of the solid, Pa.
M
    Rest shape; see :func:`foamprb.body.material.finger`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.material import derivatives, dilation, finger_of_body
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    add,
    add_identity,
    ddot,
    det,
    dot,
    reciprocals,
    scale,
    select,
    subtract,
    trace,
    transpose,
)

_TINY = 1e-300

RELATIVE_TOLERANCE = 1e-12
"""Largest estimated relative error of F after a step."""


class Newton(NamedTuple):
    """Newton's equation of one iterate: X B + κ S Xᵀ − κ tr(X) D = r."""

    kappa: Scalar
    B: Tensor
    S: Tensor
    D: Tensor
    r: Tensor


def inertia_factor(dt: Scalar, rho: Scalar, R: Scalar) -> Scalar:
    """Return κ = 5 Δt²/(ρ_s R²), 1/Pa, for a sphere at rest with Θ = m R²/5 I."""
    return 5.0 * dt * dt / (rho * R * R)


def relaxation_time(rho: Scalar, R: Scalar, mu_f: Scalar, eta: Scalar = 0.0) -> Scalar:
    """Return the inertial relaxation time of a sphere's shape, τ_s = ρ_s R²/(5 (3 μ_f + 2 η_s)), s.

    ``eta`` is the viscosity of the solid, Pa s.
    """
    return rho * R * R / (15.0 * mu_f + 10.0 * eta)


def equation(
    G: Tensor, predictor: Tensor, stress: Tensor, kappa: Scalar, mu: Scalar, lame: Scalar, M: Tensor
) -> Newton:
    """Return Newton's equation (49), (50) at the iterate G."""
    J = det(G)
    b = dot(G, transpose(G))
    # φ = 2 w₁ is constant for the solids of this scheme, ψ = J w_J a function of J.
    w1, _, wJ = derivatives(3.0, 3.0, J, mu, lame, 0.0)
    phi, psi, bulk = 2.0 * w1, J * wJ, dilation(J, mu, lame)
    traction = scale(J, stress)
    S = add_identity(traction, -psi)
    D = add_identity(traction, -bulk)
    B = add(b, scale(kappa * phi, finger_of_body(G, M)))
    r = subtract(add(B, scale(-kappa, S)), dot(predictor, transpose(G)))
    return Newton(kappa, B, S, D, r)


def tangent(n: Newton, X: Tensor) -> Tensor:
    """Return the left side X B + κ S Xᵀ − κ tr(X) D for the increment H = X G (50)."""
    T = add(dot(X, n.B), scale(n.kappa, dot(n.S, transpose(X))))
    return add(T, scale(-n.kappa * trace(X), n.D))


def _pair(
    d: Scalar, Bi: Scalar, Bj: Scalar, q: Scalar, s: Scalar, rij: Scalar, rji: Scalar
) -> tuple[Scalar, Scalar]:
    """Solve B_j X_ij + q X_ji = r_ij and B_i X_ji + s X_ij = r_ji; d is the inverse determinant."""
    return d * (Bi * rij - q * rji), d * (Bj * rji - s * rij)


def solve_diagonal(n: Newton, r: Tensor) -> Tensor:
    """Return X for the right side r without the off-diagonal components of B, S and D, in closed form."""
    B1, B2, B3 = n.B[0], n.B[4], n.B[8]
    s1, s2, s3 = n.kappa * n.S[0], n.kappa * n.S[4], n.kappa * n.S[8]
    e1, e2, e3 = reciprocals((B1 + s1, B2 + s2, B3 + s3))
    d12, d13, d23 = reciprocals((B1 * B2 - s1 * s2, B1 * B3 - s1 * s3, B2 * B3 - s2 * s3))
    D1, D2, D3 = n.kappa * n.D[0] * e1, n.kappa * n.D[4] * e2, n.kappa * n.D[8] * e3
    x1, x2, x3 = r[0] * e1, r[4] * e2, r[8] * e3
    dilation_factor = 1.0 / (1.0 - D1 - D2 - D3)
    tr = (x1 + x2 + x3) * dilation_factor
    X12, X21 = _pair(d12, B1, B2, s1, s2, r[1], r[3])
    X13, X31 = _pair(d13, B1, B3, s1, s3, r[2], r[6])
    X23, X32 = _pair(d23, B2, B3, s2, s3, r[5], r[7])
    return (x1 + D1 * tr, X12, X13, X21, x2 + D2 * tr, X23, X31, X32, x3 + D3 * tr)


def solve(n: Newton) -> Tensor:
    """Return X of Newton's equation, to second order in its off-diagonal components."""
    X = solve_diagonal(n, n.r)
    return add(X, solve_diagonal(n, subtract(n.r, tangent(n, X))))


def improve(
    G: Tensor, predictor: Tensor, stress: Tensor, kappa: Scalar, mu: Scalar, lame: Scalar, M: Tensor
) -> tuple[Tensor, Scalar]:
    """Return the next iterate after G, and the size |X| of the relative correction."""
    X = solve(equation(G, predictor, stress, kappa, mu, lame, M))
    return subtract(G, dot(X, G)), np.sqrt(ddot(X, X))


def advance(
    predictor: Tensor, stress: Tensor, kappa: Scalar, mu: Scalar, lame: Scalar, M: Tensor
) -> tuple[Tensor, Scalar]:
    """Return the new deformation gradient in the old particle frame, G = Q·Fⁿ⁺¹, and the error |δG G⁻¹|.

    Three iterations from the predictor. The error estimate assumes that the last contraction continues. Where
    it exceeds :data:`RELATIVE_TOLERANCE`, or is not finite, the caller solves the equation densely.
    """
    # Three iterations, written out: a loop here would prevent vectorisation of the loop over lanes.
    G, _ = improve(predictor, predictor, stress, kappa, mu, lame, M)
    G, before = improve(G, predictor, stress, kappa, mu, lame, M)
    G, last = improve(G, predictor, stress, kappa, mu, lame, M)
    contraction = last / (before + _TINY)
    return G, last * select(contraction < 1.0, contraction, 1.0)
