"""The pair of order 3(2), stepped in plain numpy."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pair_steps import distance, pair_step, shear, unit_bodies
from pair_steps import steps as take
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from strategies import flat, square, tensors
from validation.references.shear import inertialess_rate

from foamprb.body import exponential_runge_kutta as pair
from foamprb.body.turning import commutator


def test_its_nodes_are_those_of_a_method_of_order_three():
    c, b3 = Fraction(1, 4), Fraction(5, 18)
    b = (Fraction(-1, 6), Fraction(8, 9), b3)
    assert Fraction(pair.NODE) == c
    # The last argument has the slope (N(c) − N(0))/c of weight ½ · OVERSHOOT.
    a32 = Fraction(pair.OVERSHOOT).limit_denominator(100) / (2 * c)
    assert sum(b) == 1
    assert b[1] * c + b[2] == Fraction(1, 2)
    assert b[1] * c**2 + b[2] == Fraction(1, 3)
    assert b[2] * a32 * c == Fraction(1, 6)
    # The parabola through the values at 0, c and 1 has these weights.
    assert b3 == (Fraction(1, 3) - c / 2) / (1 - c)


@given(tensors, st.floats(0.0, 0.2))
def test_the_exponential_is_one_to_sixth_order_and_a_rotation_for_a_spin(K, size):
    scaled = size * square(K)
    found = square(pair.group_exponential(flat(scaled)))
    bound = np.linalg.norm(scaled, 2) ** 7 / 500 + 1e-14
    np.testing.assert_allclose(found, expm(scaled), atol=bound)
    spin = square(pair.group_exponential(flat(scaled - scaled.T)))
    np.testing.assert_allclose(spin @ spin.T, np.eye(3), atol=1e-13)


@given(tensors, tensors)
def test_algebra_rate_is_the_rate_of_the_logarithm(K, l):
    """F = exp(Ω) with dF/dt = l F: Ω + δt dΩ/dt is the logarithm of exp(δt l) exp(Ω)."""
    Omega, l = 0.05 * square(K), square(l)
    rate = square(pair.algebra_rate(flat(Omega), flat(l)))
    h = 1e-5
    ends = [expm(Omega + k * h * rate) @ expm(-Omega) for k in (-1, 1)]
    found = (ends[1] - ends[0]) / (2 * h)
    # The series goes on with [Ω, [Ω, [Ω, [Ω, l]]]]/720.
    c = flat(l)
    for _ in range(4):
        c = commutator(flat(Omega), c)
    np.testing.assert_allclose(found, l, atol=np.abs(c).max() / 300 + 1e-8)


def unsteady(t):
    """A gradient that grows and turns, at times (n,) or at one."""
    at = np.asarray(t)[..., None, None]
    steady = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.2], [0.0, 0.3, 0.0]])
    pulse = np.array([[0.0, 0.5, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    return (
        steady + np.cos(at) * pulse + np.sin(2 * at) * np.diag([0.3, -0.2, -0.1]) + 0.4 * np.sin(at) * pulse.T
    )


def independent(Ca, end):
    """F(end) by the reference of the validation, whose formulas are its own."""

    def rate(t, y):
        return (inertialess_rate(y.reshape(3, 3), unsteady(t), Ca) @ y.reshape(3, 3)).ravel()

    return solve_ivp(rate, (0.0, end), np.eye(3).ravel(), "LSODA", rtol=1e-10, atol=1e-12).y[:, -1]


def steps(Ca, kind, n, end, tolerance, gradient):
    bodies, F = unit_bodies(Ca, kind)
    return bodies, take(bodies, F, gradient, n, end / n, tolerance)


@pytest.mark.parametrize(("tolerance", "order"), [(0.0, 3), (np.inf, 2)])
def test_order_with_a_gradient_that_depends_on_time(tolerance, order):
    Ca = np.array([0.2, 0.5, 2.0])
    exact = np.array([independent(c, 1.0) for c in Ca]).T
    errors = []
    for n in (10, 20, 40):
        _, F = steps(Ca, "sphere", n, 1.0, tolerance, unsteady)
        errors.append(np.abs(np.array(F) - exact).max(axis=0))
    found = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (found > order - 0.2).all(), found
    assert (errors[-1] < (2e-5 if order == 3 else 2e-3)).all(), errors


def test_the_order_of_a_stiff_bodys_strain_is_not_reduced():
    """Ellipsoids that tumble in an unsteady flow, from rest: their elastic strain over it, or attitude.

    At Ca = 0.01 the relaxation of the start, h/τ = 7 and 3, is between resolved and over at once.
    """
    Ca = np.array([1e-5, 1e-4, 1e-3, 1e-2])
    for kind in ("prolate", "oblate"):
        bodies, exact = steps(Ca, kind, 160, 1.0, 0.0, unsteady)
        errors = [distance(bodies, steps(Ca, kind, n, 1.0, 0.0, unsteady)[1], exact) for n in (10, 20)]
        assert (errors[0] < 3e-4).all(), errors
        assert (errors[1] < [2e-5, 2e-5, 2e-5, 1e-4]).all(), errors
        assert (np.log2(errors[0] / errors[1])[:2] > 2.6).all(), errors


def test_a_stiff_sphere_has_its_steady_strain_at_once():
    """Started from rest, with a step a thousand times the relaxation time: D = 5/4 Ca."""
    Ca = np.array([1e-5, 1e-4])
    _, F = steps(Ca, "sphere", 1, 0.1, 0.0, shear)
    G = np.array(F).T.reshape(-1, 3, 3)
    values = np.sqrt(np.linalg.eigvalsh(G @ G.transpose(0, 2, 1)))
    found = (values[:, 2] - values[:, 0]) / (values[:, 2] + values[:, 0])
    np.testing.assert_allclose(found, 1.25 * Ca, rtol=2e-3)


def test_steps_of_a_body_that_tank_treads_are_exact():
    """In its steady state the shape stays and the body turns in it, whatever the step."""
    bodies, F = steps(np.array([0.3]), "sphere", 200, 20.0, 0.0, shear)
    args = (bodies, shear, np.zeros(1), F, np.full(1, 0.3))
    b = [np.array(G).reshape(3, 3) @ np.array(G).reshape(3, 3).T for G in (F, pair_step(*args, 0.0).F)]
    np.testing.assert_allclose(b[1], b[0], atol=1e-5)
    # It does so with two evaluations.
    assert pair_step(*args, 1e-4).evaluations[0] == 2
