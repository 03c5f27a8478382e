from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, mild_stretches, rotations, square, tensors

from foamprb.body import imex
from foamprb.body.material import MATERIALS, lame_parameter, piola
from foamprb.body.tensor import cofactor, det

MU = 2.0
LAME = lame_parameter(MU, 0.49)
SPHERE = flat(np.eye(3))


def residual(G, predictor, stress, kappa):
    """R(F) of (49) with the Piola-type stress J σ̃ F⁻ᵀ and P(F), as the paper writes it."""
    traction = square(stress) @ square(cofactor(G))
    P = square(piola(MATERIALS["neoHooke"], G, MU, LAME))
    return square(G) - square(predictor) - kappa * (traction - P)


def dense_matrix(n):
    """The 9×9 matrix of Newton's equation, column by column."""
    return np.stack([np.array(imex.tangent(n, flat(E))) for E in np.eye(9)], axis=1)


def dense_newton(predictor, stress, kappa, steps):
    """Norms of the residual (49) along Newton's iteration with the full tangent."""
    G, norms = predictor, []
    for _ in range(steps):
        norms.append(np.linalg.norm(residual(G, predictor, stress, kappa)))
        n = imex.equation(G, predictor, stress, kappa, MU, LAME, SPHERE)
        X = np.linalg.solve(dense_matrix(n), np.array(n.r)).reshape(3, 3)
        G = flat(square(G) - X @ square(G))
    return G, np.array(norms)


@given(rotations, mild_stretches, rotations, tensors, tensors, st.floats(0.01, 1.0))
def test_newtons_equation_is_the_residual_and_its_derivative(Q1, stretch, Q2, stress, X, kappa):
    """(49) and (50): r = R Gᵀ, and the tangent is its change along H = X G, against finite differences."""
    G = Q1 @ np.diag(stretch) @ Q2
    predictor = flat(np.eye(3))
    n = imex.equation(flat(G), predictor, stress, kappa, MU, LAME, SPHERE)
    np.testing.assert_allclose(square(n.r), residual(flat(G), predictor, stress, kappa) @ G.T, atol=1e-10)
    H = square(X) @ G
    h = 1e-3
    R = [residual(flat(G + k * h * H), predictor, stress, kappa) for k in (-2, -1, 1, 2)]
    derivative = (R[0] - 8 * R[1] + 8 * R[2] - R[3]) / (12 * h)
    size = np.abs(derivative).max() + 1.0
    if min(det(flat(G + k * h * H)) for k in (-2, 2)) > 0.2 * det(flat(G)):
        np.testing.assert_allclose(square(imex.tangent(n, X)), derivative @ G.T, atol=3e-6 * size)


@given(mild_stretches, tensors, tensors, tensors)
def test_an_equation_without_off_diagonal_components_is_solved_in_closed_form(squares, S, D, r):
    """X of X B + κ S Xᵀ − κ tr(X) D = r by the dense matrix of it, each of the three axes another."""
    B, S, D = (np.diag(np.diag(square(T))) for T in (flat(np.diag(squares)), S, D))
    n = imex.Newton(0.07, flat(B), flat(S), flat(D), r)
    X = np.linalg.solve(dense_matrix(n), np.array(r))
    np.testing.assert_allclose(imex.solve_diagonal(n, r), X, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(imex.solve(n), X, rtol=1e-9, atol=1e-12)


@given(st.integers(0, 10_000), st.sampled_from([1e-4, 1e-3, 1e-2, 0.1]))
def test_fast_step_error_is_below_its_estimate(seed, kappa):
    random = np.random.default_rng(seed)
    stretch = random.uniform(0.6, 1.6, 3)
    stretch /= np.cbrt(stretch.prod())
    G = np.diag(stretch) @ np.linalg.qr(random.normal(size=(3, 3)))[0]
    predictor = flat((np.eye(3) + 3e-3 * random.normal(size=(3, 3))) @ G)
    stress = flat(2e-3 * random.normal(size=9))
    found, error = imex.advance(predictor, stress, kappa, MU, LAME, SPHERE)
    exact, norms = dense_newton(predictor, stress, kappa, 12)
    assert norms[-1] < 1e-12
    np.testing.assert_allclose(found, exact, atol=10 * error + 1e-14)


def test_fast_step_reports_that_it_has_not_converged():
    stress = tuple(50.0 * s for s in (0.9, 0.4, -0.2, 0.5, -0.3, 0.1, 0.0, 0.3, -0.8))
    with np.errstate(invalid="ignore"):
        _, error = imex.advance(flat(np.eye(3)), stress, 0.5, MU, LAME, SPHERE)
    assert not error <= imex.RELATIVE_TOLERANCE


@pytest.mark.parametrize("R", [1e-6, 5e-6])
def test_relaxation_time_is_that_of_a_spinning_sphere(R):
    """I dω/dt = −8π μ R³ ω with I = 2/5 m R² gives 15 μ/(ρ R²)."""
    rho, mu = 2560.0, 1.8e-5
    inertia = 2 / 5 * (4 / 3 * np.pi * R**3 * rho) * R**2
    np.testing.assert_allclose(
        imex.relaxation_time(rho, R, mu), inertia / (8 * np.pi * mu * R**3), rtol=1e-14
    )
