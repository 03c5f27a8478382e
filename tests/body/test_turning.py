from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, mild_stretches, rotations, square, tensors

from foamprb.body import rosenbrock, stokes
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import finger, metric_at_rest
from foamprb.body.relaxation import relaxation, relaxing
from foamprb.body.tensor import dev, principal_frame
from foamprb.body.turning import commutator, shape_spin, turning_gradient

MU_F = 0.7


def velocity_gradient(F, M, mu, l_f):
    """l_s in the inertial frame, and its ingredients."""
    Q, axes = principal_frame(flat(F))
    g, R = integrals(axes), square(Q)
    m = stokes.mobility(axes, g, 0.0)
    b_e = finger(flat(R @ F), M)
    sigma = tuple(s / MU_F for s in rosenbrock.kirchhoff(b_e, 1.0, mu, 0.0, 0.0))
    l = stokes.velocity_gradient(m, sigma, flat(R @ l_f @ R.T))
    return R.T @ square(l) @ R, (R, axes, m, b_e, sigma, l)


def body(Ca, rest, random):
    """An ellipsoid at rest that has been strained by about Ca, and a gradient around it."""
    R = np.linalg.qr(random.normal(size=(3, 3)))[0]
    axes = np.array(rest) / np.prod(rest) ** (1 / 3)
    F0 = R @ np.diag(axes) @ R.T
    l_f = square(dev(flat(random.normal(size=(3, 3)))))
    mu = MU_F / Ca
    F = F0
    # To the strain at which it would rest: l_s has no strain rate left but what turning makes.
    for _ in range(400):
        l, _ = velocity_gradient(F, metric_at_rest(flat(F0)), mu, l_f)
        d = 0.5 * (l + l.T)
        F = (np.eye(3) + 0.2 * Ca * d) @ F
        F /= np.cbrt(np.linalg.det(F))
    return F, metric_at_rest(flat(F0)), mu, l_f


def test_a_nearly_rigid_body_changes_its_velocity_gradient_by_turning_only(random):
    """d(l_s − J Ω)/dt along Ω = l_s t by differences, for prolate, oblate and triaxial bodies."""
    for rest in ((2.0, 1.0, 1.0), (1.0, 2.0, 2.0), (1.7, 1.2, 0.7)):
        misses = []
        for Ca in (1e-3, 1e-4):
            F, M, mu, l_f = body(Ca, rest, random)
            l, (R, axes, m, b_e, sigma, own) = velocity_gradient(F, M, mu, l_f)
            e = rosenbrock.elasticity((b_e[0], b_e[4], b_e[8]), 1.0, mu, 0.0, 0.0, 0.0)
            seen = flat(R @ l_f @ R.T)
            found = R.T @ square(turning_gradient(axes, m, e, MU_F, own, seen, sigma)) @ R
            h = 1e-6
            ends = [velocity_gradient((np.eye(3) + k * h * l) @ F, M, mu, l_f)[0] for k in (-1, 1)]
            stiff = R.T @ square(relaxing(relaxation(m, e, MU_F), own)) @ R
            expected = (ends[1] - ends[0]) / (2 * h) - stiff
            misses.append(np.abs(found - expected).max() / np.abs(expected).max())
        # ε of the fit leaves 1 to 2 % of the spin.
        assert max(misses) < 0.04, (rest, misses)


@given(mild_stretches, rotations, tensors)
def test_rigid_turning_is_found_where_the_body_is_not_round(stretch, R, l):
    spin = 0.5 * (square(l) - square(l).T)
    W = square(shape_spin(stretch, flat(spin)))
    b = np.array(stretch) ** 2
    for i, j in ((0, 1), (0, 2), (1, 2)):
        d, s = b[j] - b[i], b[i] + b[j]
        np.testing.assert_allclose(W[i, j], spin[i, j] * d * d / (d * d + 0.01 * s * s), atol=1e-12)
    np.testing.assert_allclose(W, -W.T)


@given(mild_stretches, st.floats(-2.0, 2.0))
def test_a_body_that_tank_treads_does_not_turn(stretch, rate):
    """Where b does not change, l b is skew, and there is no spin."""
    skew = rate * np.array([[0.0, 1.0, -0.3], [-1.0, 0.0, 0.7], [0.3, -0.7, 0.0]])
    l = skew @ np.diag(1.0 / np.array(stretch) ** 2)
    np.testing.assert_allclose(shape_spin(stretch, flat(l)), 0.0, atol=1e-14)


@given(tensors, tensors)
def test_commutator(S, T):
    expected = square(S) @ square(T) - square(T) @ square(S)
    np.testing.assert_allclose(square(commutator(S, T)), expected, atol=1e-12)
