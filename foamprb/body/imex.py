"""The paper's implicit–explicit Euler step of the shape (Sect. 4.2, Appendix E).

The traction's stress σ̃* is taken at the old shape; the new deformation gradient solves

    R(F) = F − Fⁿ − Δt Aⁿ − κ [J σ̃* F⁻ᵀ − P(F)] = 0,   κ = Δt² vol₀/Θ = 5 Δt²/(ρ_s R²)

by Newton's method, in the particle frame of the old shape: G = Q·F, where G Gᵀ and σ̃* are nearly diagonal.
With H = X G and P = φ F M + ψ F⁻ᵀ, Newton's equation times Gᵀ is

    X B + κ S Xᵀ − κ tr(X) D = r,   r = B − G* Gᵀ − κ S,

where B = G Gᵀ + κφ b_e with the elastic b_e = G M Gᵀ, G* = Q·(Fⁿ + Δt Aⁿ), S = Jσ̃* − ψ I and
D = Jσ̃* − (J dψ/dJ) I: this is (50), in which M = I and b_e = G Gᵀ.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.material import finger_of_sphere as finger
from foamprb.body.material import neo_hooke_derivatives as derivatives
from foamprb.body.material import neo_hooke_dilation as dilation
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
    trace,
    transpose,
)

_TINY = 1e-300

RELATIVE_TOLERANCE = 1e-12
"""Largest estimated relative error of F that a step may leave."""


class Newton(NamedTuple):
    """Newton's equation of one iterate: X B + κ S Xᵀ − κ tr(X) D = r."""

    kappa: Scalar
    B: Tensor
    S: Tensor
    D: Tensor
    r: Tensor


def inertia_factor(dt: Scalar, rho: Scalar, R: Scalar) -> Scalar:
    """κ = 5 Δt²/(ρ_s R²), 1/Pa, of a sphere at rest with Θ = m R²/5 I."""
    return 5.0 * dt * dt / (rho * R * R)


def relaxation_time(rho: Scalar, R: Scalar, mu_f: Scalar, eta: Scalar = 0.0) -> Scalar:
    """Inertial relaxation time of a sphere's shape, τ_s = ρ_s R²/(5 (3 μ_f + 2 η_s)), s.

    ``eta`` is the viscosity of the solid, Pa s.
    """
    return rho * R * R / (15.0 * mu_f + 10.0 * eta)


def equation(
    G: Tensor, predictor: Tensor, stress: Tensor, kappa: Scalar, mu: Scalar, lame: Scalar, M: Tensor
) -> Newton:
    """Newton's equation (49), (50) at the iterate G.

    Parameters
    ----------
    G, predictor
        The iterate Q·F and Q·(Fⁿ + Δt Aⁿ).
    stress
        σ̃*, Pa, particle frame.
    kappa
        :func:`inertia_factor`, 1/Pa.
    mu, lame
        Lamé parameters of the solid, Pa.
    M
        Shape at rest, as :func:`foamprb.body.material.finger` takes it.
    """
    J = det(G)
    b = dot(G, transpose(G))
    # φ = 2 w₁ is a constant of the solids that this scheme takes, ψ = J w_J a function of J.
    w1, _, wJ = derivatives(3.0, 3.0, J, mu, lame, 0.0)
    phi, psi, bulk = 2.0 * w1, J * wJ, dilation(J, mu, lame)
    traction = scale(J, stress)
    S = add_identity(traction, -psi)
    D = add_identity(traction, -bulk)
    B = add(b, scale(kappa * phi, finger(G, M)))
    r = add(add(B, scale(-kappa, S)), scale(-1.0, dot(predictor, transpose(G))))
    return Newton(kappa, B, S, D, r)


def tangent(n: Newton, X: Tensor) -> Tensor:
    """The left side X B + κ S Xᵀ − κ tr(X) D for the increment H = X G (50)."""
    T = add(dot(X, n.B), scale(n.kappa, dot(n.S, transpose(X))))
    return add(T, scale(-n.kappa * trace(X), n.D))


def _pair(
    d: Scalar, Bi: Scalar, Bj: Scalar, q: Scalar, s: Scalar, rij: Scalar, rji: Scalar
) -> tuple[Scalar, Scalar]:
    """X_ij and X_ji from B_j X_ij + q X_ji = r_ij and B_i X_ji + s X_ij = r_ji, d the inverse determinant."""
    return d * (Bi * rij - q * rji), d * (Bj * rji - s * rij)


def solve_diagonal(n: Newton, r: Tensor) -> Tensor:
    """X for the right side r with the off-diagonal components of B, S and D left out, in closed form."""
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
    """X of Newton's equation, to second order in its off-diagonal components."""
    X = solve_diagonal(n, n.r)
    return add(X, solve_diagonal(n, add(n.r, scale(-1.0, tangent(n, X)))))


def improve(
    G: Tensor, predictor: Tensor, stress: Tensor, kappa: Scalar, mu: Scalar, lame: Scalar, M: Tensor
) -> tuple[Tensor, Scalar]:
    """One iteration from G: the next iterate, and the size |X| of the relative correction.

    Parameters
    ----------
    As :func:`equation`.
    """
    X = solve(equation(G, predictor, stress, kappa, mu, lame, M))
    return add(G, scale(-1.0, dot(X, G))), np.sqrt(ddot(X, X))


def advance(
    predictor: Tensor, stress: Tensor, kappa: Scalar, mu: Scalar, lame: Scalar, M: Tensor
) -> tuple[Tensor, Scalar]:
    """New deformation gradient in the old particle frame, and the estimated error of the iteration.

    Three iterations from the predictor. The error is that of a sequence which goes on contracting as it did
    last; where it exceeds :data:`RELATIVE_TOLERANCE` the caller solves the equation densely.

    Parameters
    ----------
    As :func:`equation`.

    Returns
    -------
    G, error
        G = Q·Fⁿ⁺¹ and the estimate of |δG G⁻¹|; a non-finite error is one above any tolerance.
    """
    # Three iterations, written out: a loop here would keep the compiler from vectorising the one over lanes.
    G, _ = improve(predictor, predictor, stress, kappa, mu, lame, M)
    G, before = improve(G, predictor, stress, kappa, mu, lame, M)
    G, last = improve(G, predictor, stress, kappa, mu, lame, M)
    contraction = last / (before + _TINY)
    return G, last * select(contraction < 1.0, contraction, 1.0)
