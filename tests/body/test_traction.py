from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from strategies import flat, mild_stretches, rotations, square, tensors

from foamprb.body.ellipsoid import integrals
from foamprb.body.tensor import dev, principal_frame, skew, sym, trace
from foamprb.body.traction import TRACTIONS, jeffery, roscoe


def in_space(traction, F, l_f, l_s):
    """σ̃/μ_f in the inertial frame, for a deformation gradient and two velocity gradients there."""
    Q, axes = principal_frame(flat(F))
    Q = square(Q)
    s = traction(axes, integrals(axes), flat(Q @ l_f @ Q.T), flat(Q @ l_s @ Q.T))
    return Q.T @ square(s) @ Q


@given(rotations, tensors, tensors)
def test_sphere_has_its_closed_form_in_any_frame(Q, l_f, l_s):
    """σ̃/μ_f = 5 dev d_f − 3 dev d_s + 3 w − 4/3 tr(d_s) I."""
    expected = (
        5 * square(dev(sym(l_f)))
        - 3 * square(dev(sym(l_s)))
        + 3 * (square(skew(l_f)) - square(skew(l_s)))
        - 4 / 3 * trace(l_s) * np.eye(3)
    )
    found = in_space(roscoe, Q, square(l_f), square(l_s))
    np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize("name", TRACTIONS)
@given(rotations, mild_stretches, rotations, tensors, tensors, rotations)
def test_frame_indifference(name, Q1, stretch, Q2, l_f, l_s, R):
    F = Q1 @ np.diag(stretch) @ Q2
    L_f, L_s = square(l_f), square(l_s)
    turned = in_space(TRACTIONS[name], R @ F, R @ L_f @ R.T, R @ L_s @ R.T)
    np.testing.assert_allclose(turned, R @ in_space(TRACTIONS[name], F, L_f, L_s) @ R.T, atol=1e-11)


@pytest.mark.parametrize("name", TRACTIONS)
@given(mild_stretches, tensors, tensors, tensors, tensors)
def test_linearity_in_the_velocity_gradients(name, axes, a, b, c, d):
    traction, g = TRACTIONS[name], integrals(axes)

    def combine(p, q):
        return tuple(2.0 * x - 0.5 * y for x, y in zip(p, q, strict=True))

    together = traction(axes, g, combine(a, b), combine(c, d))
    apart = combine(traction(axes, g, a, c), traction(axes, g, b, d))
    np.testing.assert_allclose(together, apart, atol=1e-11)


@given(mild_stretches, tensors)
def test_a_body_that_moves_with_the_fluid_has_the_fluids_own_stress(axes, gradient):
    """With l_s = l_f, traceless, the particle disturbs nothing: σ̃ = 2 μ d."""
    d = dev(gradient)
    np.testing.assert_allclose(roscoe(axes, integrals(axes), d, d), 2.0 * np.array(sym(d)), atol=1e-12)


@given(mild_stretches)
def test_dilation_is_resisted_as_by_an_expanding_sphere(axes):
    """The mean normal stress −4/3 tr d_s of Stokes flow around an expanding sphere."""
    s = roscoe(axes, integrals(axes), flat(np.zeros(9)), flat(0.3 * np.eye(3)))
    np.testing.assert_allclose(s, -4 / 3 * 0.9 * np.eye(3).ravel(), atol=1e-13)


@pytest.mark.parametrize("e", [0.1, 0.5, 0.9, 0.99])
def test_stresslet_of_rigid_prolate_spheroids(e):
    """S = 20/3 π μ a³ (X^M, Y^M, Z^M) E for the three strains (Kim & Karrila 1991, table 3.4)."""
    L = np.log((1 + e) / (1 - e))
    X = 8 / 15 * e**5 / ((3 - e**2) * L - 6 * e)
    Y = 4 / 5 * e**5 * (2 * e * (1 - 2 * e**2) - (1 - e**2) * L)
    Y /= (2 * e * (2 * e**2 - 3) + 3 * (1 - e**2) * L) * (-2 * e + (1 + e**2) * L)
    Z = 16 / 5 * e**5 * (1 - e**2) / (3 * (1 - e**2) ** 2 * L - 2 * e * (3 - 5 * e**2))
    a, b = 1.0, np.sqrt(1 - e**2)
    axes, g = (a, b, b), integrals((a, b, b))
    volume = 4 / 3 * np.pi * a * b * b
    at_rest = flat(np.zeros(9))

    def stresslet(E):
        # Free of torque, so the body turns with Jeffery's rate; only E₁₂ makes it turn.
        w = -((a * a - b * b) / (a * a + b * b)) * E[0, 1]
        l_s = np.array([[0, w, 0], [-w, 0, 0], [0, 0, 0]])
        s = square(roscoe(axes, g, flat(E), flat(l_s)))
        return volume * square(dev(sym(flat(s))))

    unit = 20 / 3 * np.pi * a**3
    axial = np.diag([1.0, -0.5, -0.5])
    np.testing.assert_allclose(stresslet(axial), unit * X * axial, atol=2e-11 * unit / e**2)
    transverse = np.diag([0.0, 1.0, -1.0])
    np.testing.assert_allclose(stresslet(transverse), unit * Z * transverse, atol=2e-11 * unit / e**2)
    shear = np.zeros((3, 3))
    shear[0, 1] = shear[1, 0] = 1.0
    np.testing.assert_allclose(stresslet(shear), unit * Y_free(e, L, Y) * shear, atol=2e-9 * unit / e**4)
    assert at_rest == (0.0,) * 9


def Y_free(e, L, Y):
    """Y^M for a torque-free body is K&K's Y^M − (couple's share), with Y^C and Y^H of the same table."""
    Y_C = 4 / 3 * e**3 * (2 - e**2) / (-2 * e + (1 + e**2) * L)
    Y_H = 4 / 3 * e**5 / (-2 * e + (1 + e**2) * L)
    return Y - 3 / 5 * Y_H**2 / Y_C


@given(mild_stretches, tensors, tensors)
def test_jeffery_is_roscoe_for_a_body_that_does_not_deform(axes, l_f, l_s):
    g = integrals(axes)
    np.testing.assert_array_equal(jeffery(axes, g, l_f, l_s), roscoe(axes, g, l_f, skew(l_s)))
