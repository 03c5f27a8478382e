"""Morphology tensor: limits of its equation, and the constants of drops."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from foamprb.body.material import MATERIALS, finger_of_sphere_in_frame
from foamprb.body.morphology import (
    Rates,
    drop_drag_factor,
    drop_mobility,
    drop_stress,
    morphology_rate,
    morphology_step,
    recovering,
    recovery_of_drop,
    strain_of_drop,
)
from foamprb.body.rosenbrock import extra_stress
from foamprb.body.stokes import velocity_gradient
from foamprb.body.tensor import ZERO

RNG = np.random.default_rng(7)


def flat(T):
    return tuple(np.asarray(T, dtype=float).ravel())


def square(T):
    return np.array(T, dtype=float).reshape(3, 3)


def shape():
    F = np.eye(3) + 0.4 * RNG.standard_normal((3, 3))
    S = F @ F.T
    return S / np.cbrt(np.linalg.det(S))


def textbook(S, l, f1, f2, f3):
    E, W = 0.5 * (l + l.T), 0.5 * (l - l.T)
    second = 0.5 * (np.trace(S) ** 2 - np.trace(S @ S))
    recovery = S - 3.0 * np.linalg.det(S) / second * np.eye(3)
    return f3 * (W @ S - S @ W) - f1 * recovery + f2 * (E @ S + S @ E)


def test_the_rate_is_that_of_the_equation_and_keeps_the_volume():
    S, l = shape(), RNG.standard_normal((3, 3))
    l -= np.trace(l) / 3.0 * np.eye(3)
    found = square(morphology_rate(flat(S), flat(l), Rates(0.7, 1.3, 0.4)))
    np.testing.assert_allclose(found, textbook(S, l, 0.7, 1.3, 0.4), rtol=1e-12, atol=1e-13)
    assert abs(np.trace(found @ np.linalg.inv(S))) < 1e-12


def test_a_shape_turns_with_a_rigid_rotation_of_the_fluid():
    S = shape()
    w = np.array([[0.0, -0.3, 0.1], [0.3, 0.0, -0.2], [-0.1, 0.2, 0.0]])
    found = flat(S)
    for _ in range(100):
        found = morphology_step(found, flat(w), flat(w), 0.05, Rates(0.0, 1.0, 1.0))
    R = expm(5.0 * w)
    np.testing.assert_allclose(square(found), R @ S @ R.T, rtol=2e-5)


def test_steps_are_of_fourth_order_and_keep_the_volume():
    S, l = shape(), np.array([[0.2, 1.0, 0.0], [0.1, -0.3, 0.4], [0.0, 0.2, 0.1]])
    end = l.T.copy()
    rates = Rates(0.8, 0.9, 0.6)

    def slope(t, y):
        return textbook(y.reshape(3, 3), l + t * (end - l), *rates).ravel()

    exact = solve_ivp(slope, (0.0, 1.0), S.ravel(), rtol=1e-12, atol=1e-13).y[:, -1]
    error = []
    for n in (4, 8):
        found, at = flat(S), [flat(l + k / n * (end - l)) for k in range(n + 1)]
        for k in range(n):
            found = morphology_step(found, at[k], at[k + 1], 1.0 / n, rates)
        assert np.linalg.det(square(found)) == pytest.approx(1.0, abs=1e-14)
        error.append(np.abs(np.array(found) - exact).max())
    assert error[1] < 2e-5
    assert 12.0 < error[0] / error[1] < 20.0


@pytest.mark.parametrize("ratio", [0.0, 0.1, 1.0, 5.0, 100.0])
def test_drops_of_small_deformation_are_taylors(ratio):
    """D = (19λ + 16)/(16λ + 16) Ca: ½ f₂/f₁ in a steady state; stress (5λ + 2)/(λ + 1) μ_f E; their drag."""
    assert 0.5 * strain_of_drop(ratio, 0.0) / recovery_of_drop(ratio) == pytest.approx(
        (19.0 * ratio + 16.0) / (16.0 * ratio + 16.0)
    )
    E = np.zeros((3, 3))
    E[0, 1] = E[1, 0] = 0.5
    S = square(drop_stress(ratio, 0.0, flat(E), ZERO, flat(np.eye(3))))
    np.testing.assert_allclose(S, (5.0 * ratio + 2.0) / (ratio + 1.0) * E, rtol=1e-12)
    assert drop_drag_factor(0.0) == pytest.approx(2.0 / 3.0)
    assert drop_drag_factor(1e9) == pytest.approx(1.0)


@pytest.mark.parametrize(("ratio", "N2"), [(0.1, -2.708), (1.0, -2.1875), (2.0, -2.057), (6.0, -1.976)])
def test_the_second_normal_stress_of_steady_drops_is_schowalters(ratio, N2):
    """−(19λ + 16)(29λ² + 61λ + 50)/(280 (λ + 1)³) Ca μ_f γ̇ V in shear (1968)."""
    Ca, l = 1e-3, np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    rates = recovery_of_drop(ratio) / Ca, strain_of_drop(ratio, Ca), 1.0

    def slope(t, y):
        return textbook(y.reshape(3, 3), l, *rates).ravel()

    S = solve_ivp(slope, (0.0, 1.0), np.eye(3).ravel(), method="LSODA", rtol=1e-12, atol=1e-14).y[:, -1]
    recovery = 0.5 * rates[0] * square(recovering(flat(S)))
    E, W = 0.5 * (l + l.T), 0.5 * (l - l.T)
    stress = square(drop_stress(ratio, Ca, flat(E), flat(W + rates[1] * E - recovery), flat(S)))
    assert (stress[1, 1] - stress[2, 2]) / Ca == pytest.approx(N2, rel=1e-3)


def test_the_velocity_gradient_of_a_drop_is_that_of_its_equation():
    """W + f₂ E − ½ f₁ (I − g S⁻¹), from the mobility and the stress of the solid that stands for it."""
    ratio, Ca = 0.6, 0.35
    stretches = np.array([1.4, 1.1, 1.0 / 1.54])
    l = RNG.standard_normal((3, 3))
    l -= np.trace(l) / 3.0 * np.eye(3)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("foamprb.body.rosenbrock.derivatives", MATERIALS["drop"].derivatives)
        b = finger_of_sphere_in_frame(tuple(stretches), ZERO, ZERO)
        sigma = extra_stress(b, 1.0, 1.0, 0.0, 0.0)
    found = square(velocity_gradient(drop_mobility(ratio, Ca), sigma, flat(l)))
    E, W = 0.5 * (l + l.T), 0.5 * (l - l.T)
    recovery = square(recovering(flat(np.diag(stretches**2))))
    f1, f2 = recovery_of_drop(ratio), strain_of_drop(ratio, Ca)
    np.testing.assert_allclose(found, W + f2 * E - 0.5 * f1 * recovery, atol=1e-13)
