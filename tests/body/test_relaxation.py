from __future__ import annotations

import mpmath
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from strategies import flat, mild_stretches, square, tensors

from foamprb.body import rosenbrock, stokes
from foamprb.body.ellipsoid import integrals
from foamprb.body.relaxation import (
    fastest,
    phi_functions,
    phi_of_twice,
    relaxation,
    relaxing,
    respond,
    respond_to_constant,
    respond_to_slope,
    responses,
)

MU, MU_F = 2.0, 0.7
AT_REST = (0.0,) * 9


def exact(z: float) -> list[float]:
    """eᶻ and φ₁ to φ₄ in 60 digits."""
    with mpmath.workdps(60):
        values = [mpmath.exp(mpmath.mpf(z))]
        for k in range(4):
            at_zero = mpmath.mpf(1) / mpmath.factorial(k)
            values.append((values[-1] - at_zero) / z if z else at_zero / (k + 1))
        return [float(v) for v in values]


def test_phi_functions_are_exact_to_round_off():
    for z in (-1e9, -300.0, -41.0, -12.0, -1.001, -0.999, -0.1, -1e-8, 0.0, 0.7, 3.0):
        # Below −40 the exponential stays as at −40.
        for found in (phi_functions(z), phi_of_twice(phi_functions(0.5 * z))):
            np.testing.assert_allclose(found, exact(z), rtol=3e-13, atol=1e-17, err_msg=f"z = {z}")


def assemble(stretch, eta=0.0, tension=0.0):
    g, J = integrals(stretch), np.prod(stretch)
    m = stokes.mobility(stretch, g, eta)
    e = rosenbrock.elasticity(tuple(x * x for x in stretch), J, MU, 0.0, 0.0, tension)
    return g, m, e, relaxation(m, e, MU_F)


def matrix(n):
    """J as a 9×9 matrix."""
    return np.array([relaxing(n, flat(E)) for E in np.eye(9)]).T


@given(mild_stretches, tensors, st.floats(0.0, 20.0))
def test_relaxing_is_the_change_of_the_bodys_velocity_gradient_by_its_stress(stretch, Y, eta):
    _, m, e, n = assemble(stretch, eta)
    change = np.diag(square(e.slopes) @ np.diag(square(Y)))
    for i, j, k in ((1, 2, 0), (0, 2, 1), (0, 1, 2)):
        change[i, j] = change[j, i] = e.shear[k] * (
            square(Y)[i, j] * stretch[j] ** 2 + square(Y)[j, i] * stretch[i] ** 2
        )
    expected = stokes.velocity_gradient(m, flat(change / MU_F), AT_REST)
    np.testing.assert_allclose(relaxing(n, Y), expected, atol=1e-11)


@given(mild_stretches, tensors, tensors, tensors, st.floats(1e-4, 1e4), st.floats(0.0, 3.0))
def test_respond_is_the_sum_of_the_matrix_functions(stretch, Y1, Y2, Y3, h, tension):
    """exp of the block matrix [[hJ, Y₁, …], …] has φ_k(hJ) in its first row (Saad 1992)."""
    *_, n = assemble(stretch, 0.0, tension)
    J = matrix(n)
    for part, response in zip((0.25 * h, h), responses(n, h), strict=True):
        B = np.zeros((36, 36))
        B[:9, :9] = part * J
        for k in range(3):
            B[9 * k : 9 * k + 9, 9 * k + 9 : 9 * k + 18] = np.eye(9)
        phi = expm(B)[:9]
        expected = part * sum(phi[:, 9 * k : 9 * k + 9] @ Y for k, Y in ((1, Y1), (2, Y2), (3, Y3)))
        found = respond(n, response, part, Y1, Y2, Y3)
        np.testing.assert_allclose(found, expected, atol=1e-9 * max(part, 1.0))


@given(mild_stretches, tensors, tensors, st.floats(1e-4, 1e4))
def test_responses_to_a_constant_and_to_a_slope_add_up(stretch, Y1, Y2, h):
    *_, n = assemble(stretch)
    _, whole = responses(n, h)
    found = np.add(respond_to_constant(n, whole, h, Y1), respond_to_slope(n, whole, h, Y2))
    np.testing.assert_allclose(found, respond(n, whole, h, Y1, Y2, AT_REST), atol=1e-12 * max(h, 1.0))


def test_a_body_with_two_equal_rates_is_no_exception():
    """A sphere, whose normal rates are equal, and one that nearly is."""
    for stretch in ((1.0, 1.0, 1.0), (1.0 + 1e-9, 1.0, 1.0 - 1e-9)):
        *_, n = assemble(stretch)
        found = respond(
            n, responses(n, 0.3)[1], 0.3, (1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0), AT_REST, AT_REST
        )
        # A sphere relaxes as d_s = −σ'/(3 μ_f), σ' = 2 μ ε: at the rate 2μ/(3μ_f).
        rate = 2.0 * MU / (3.0 * MU_F)
        expected = (1.0 - np.exp(-rate * 0.3)) / rate
        np.testing.assert_allclose((found[0], found[4], found[8]), (expected, -expected, 0.0), atol=1e-6)


@given(mild_stretches, st.floats(0.0, 20.0), st.floats(0.0, 3.0))
def test_the_fastest_rate_is_not_below_that_of_the_matrix(stretch, eta, tension):
    *_, n = assemble(stretch, eta, tension)
    most = abs(np.linalg.eigvals(matrix(n))).max()
    assert most * (1.0 - 1e-9) <= fastest(n) <= 2.0 * most * (1.0 + 1e-9)
