from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, mild_stretches, rotations, square, tensors

from foamprb.body import rosenbrock, stokes
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import MATERIALS, piola, stored_energy
from foamprb.body.tensor import dev
from foamprb.body.traction import roscoe

MU, LAME = 2.0, 30.0
AT_REST = (0.0,) * 9
PAIRS = ((1, 2, 0), (0, 2, 1), (0, 1, 2))


def kirchhoff(F):
    return square(piola(MATERIALS["neoHooke"], flat(F), MU, LAME)) @ F.T


@given(rotations, mild_stretches, rotations)
def test_kirchhoff_stress_is_the_piola_stress_pushed_forward(Q1, stretch, Q2):
    F = Q1 @ np.diag(stretch) @ Q2
    found = square(rosenbrock.kirchhoff(flat(F @ F.T), np.linalg.det(F), MU, LAME, 0.0))
    np.testing.assert_allclose(found, kirchhoff(F), atol=1e-11)


@given(mild_stretches)
def test_principal_stresses_are_the_energys_derivatives(stretch):
    """∂w₀/∂λ_a λ_a = τ_a."""
    material = MATERIALS["neoHooke"]
    x = np.array(stretch)
    h = 1e-5
    for a in range(3):
        step = h * x * np.eye(3)[a]
        w = [stored_energy(material, flat(np.diag(x + k * step)), MU, LAME) for k in (-1, 1)]
        tau = rosenbrock.elasticity(stretch, MU, LAME, 0.0).tau[a]
        np.testing.assert_allclose((w[1] - w[0]) / (2 * h), tau, atol=1e-7)


@given(mild_stretches, tensors)
def test_elasticity_is_the_derivative_of_the_kirchhoff_stress(stretch, X):
    e, F, X = rosenbrock.elasticity(stretch, MU, LAME, 0.0), np.diag(stretch), square(X)
    h = 1e-5
    change = (kirchhoff(F + h * X @ F) - kirchhoff(F - h * X @ F)) / (2 * h)
    np.testing.assert_allclose(square(e.slopes) @ np.diag(X), np.diag(change), atol=3e-3)
    for i, j, k in PAIRS:
        expected = e.shear[k] * (X[i, j] * stretch[j] ** 2 + X[j, i] * stretch[i] ** 2)
        np.testing.assert_allclose(change[i, j], expected, atol=1e-7)


@given(mild_stretches, tensors)
def test_traction_coefficients_are_those_of_roscoes_traction(axes, Y):
    g, Y = integrals(axes), square(Y)
    s = square(roscoe(axes, g, AT_REST, flat(Y)))
    np.testing.assert_allclose(
        square(rosenbrock.traction_slopes(axes, g)) @ np.diag(Y), np.diag(s), atol=1e-11
    )
    k = 8.0 / np.prod(axes)
    for i, j, other in PAIRS:
        c = rosenbrock.shear_coefficients(axes[i], axes[j], g.alpha[i], g.alpha[j], g.ring[other], k)
        np.testing.assert_allclose(c[0] * Y[i, j] + c[1] * Y[j, i], s[i, j], atol=1e-11)
        np.testing.assert_allclose(c[2] * Y[i, j] + c[3] * Y[j, i], s[j, i], atol=1e-11)


@given(mild_stretches, tensors, st.floats(1e-3, 10.0), st.floats(0.1, 100.0))
def test_solve_inertial_solves_its_equation(stretch, r, gh, c):
    g = integrals(stretch)
    n = rosenbrock.inertial_stiffness(stretch, g, rosenbrock.elasticity(stretch, MU, LAME, 0.0), c, 0.7)
    Y = rosenbrock.solve_inertial(n, gh, r)
    traction = c * np.prod(stretch) * 0.7 * square(roscoe(stretch, g, AT_REST, Y))
    left = square(Y) * np.array(n.b) - gh * traction + gh**2 * square(rosenbrock.elastic_response(n, Y))
    np.testing.assert_allclose(left, square(r), atol=1e-8 * (1 + np.abs(traction).max() * gh))


@given(mild_stretches, tensors, tensors)
def test_inertialess_body_is_in_balance_and_keeps_its_volume(axes, stress, l_f):
    """σ̃(l_s; l_f) = σ up to a pressure, no torque, Σ d_s,aa = 0."""
    g = integrals(axes)
    sigma = square(stress) + square(stress).T
    L = flat(square(dev(l_f)))
    l_s = stokes.velocity_gradient(axes, g, stokes.mobility(axes, g), flat(sigma), L)
    np.testing.assert_allclose(np.trace(square(l_s)), 0.0, atol=1e-12)
    left = square(roscoe(axes, g, L, l_s)) - sigma
    np.testing.assert_allclose(left - np.trace(left) / 3 * np.eye(3), 0.0, atol=1e-10)


@given(tensors, tensors)
def test_inertialess_sphere_has_its_closed_form(stress, l_f):
    """d_s = 5/3 d_f − σ'/(3 μ_f), w_s = w_f."""
    sphere = (1.0, 1.0, 1.0)
    g = integrals(sphere)
    sigma, L = square(stress) + square(stress).T, square(dev(l_f))
    l_s = square(stokes.velocity_gradient(sphere, g, stokes.mobility(sphere, g), flat(sigma), flat(L)))
    expected = 5 / 3 * (L + L.T) / 2 - square(dev(flat(sigma))) / 3 + (L - L.T) / 2
    np.testing.assert_allclose(l_s, expected, atol=1e-12)


@given(mild_stretches, tensors, st.floats(1e-3, 1e4))
def test_solve_inertialess_solves_its_equation(stretch, r, gh):
    """Y − γh (l_s(σ + δτ(Y)/μ_f) − l_s(σ)) = r, l_s being affine in the stress."""
    g, mu_f = integrals(stretch), 0.7
    m, e = stokes.mobility(stretch, g), rosenbrock.elasticity(stretch, MU, LAME, 0.0)
    Y = square(stokes.solve_inertialess(m, e, stretch, gh, mu_f, r))
    change = np.diag(square(e.slopes) @ np.diag(Y))
    for i, j, k in PAIRS:
        change[i, j] = change[j, i] = e.shear[k] * (Y[i, j] * stretch[j] ** 2 + Y[j, i] * stretch[i] ** 2)
    response = square(stokes.velocity_gradient(stretch, g, m, flat(change / mu_f), AT_REST))
    size = 1 + gh * np.abs(response).max()
    np.testing.assert_allclose(Y - gh * response, square(r), atol=1e-9 * size)


@given(st.floats(0.8, 1.2))
def test_isochoric_restores_the_volume(J):
    F = flat(np.diag([J, 1.0, 1.0]))
    np.testing.assert_allclose(np.linalg.det(square(stokes.isochoric(F, J))), 1.0, rtol=1e-14)
