"""The step with inertia: its rational functions and their arguments."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from strategies import flat, mild_stretches, square, tensors

from foamprb.body import inertial_path as path
from foamprb.body import inertial_runge_kutta as own
from foamprb.body import rosenbrock
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import viscous_stress
from foamprb.body.tensor import skew
from foamprb.body.traction import roscoe
from foamprb.body.turning import shape_spin

AT_REST = (0.0,) * 9
MU_F = 0.7
positive = st.floats(1e-3, 1e3)


def stiffness(stretch, c=1.0, eta=0.0):
    e = rosenbrock.elasticity(tuple(s * s for s in stretch), float(np.prod(stretch)), 3.0, 20.0, 0.0, 0.0)
    return rosenbrock.inertial_stiffness(stretch, integrals(stretch), e, c, MU_F, eta), e


def r(k, z):
    """r_k(z) from P = 1/(1 − γz)."""
    P = 1.0 / (1.0 - own.GAMMA * z)
    weights = (own.R1, own.R2, own.R3)[k - 1]
    return sum(w * P ** (i + 1) for i, w in enumerate(weights))


def test_rational_functions_follow_from_one_that_is_near_the_exponential():
    for z in (-1e6, -3.0, -0.1, 0.2, 1.0 + 2.0j, -4.0j):
        R = 1.0 + z * r(1, z)
        assert r(1, z) == pytest.approx(1.0 + z * r(2, z), rel=1e-9, abs=0.0)
        assert r(2, z) == pytest.approx(0.5 + z * r(3, z), rel=1e-9, abs=1e-12)
        assert abs(R) <= 1.0 + 0.4 * max(np.real(z), 0.0) + 1e-12 or np.real(z) > 0
    errors = [abs(1.0 + z * r(1, z) - np.exp(z)) for z in (-0.02, -0.01)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.1)
    assert abs(1.0 - 1e9 * r(1, -1e9)) < 1e-6


@given(mild_stretches, tensors, st.floats(0.1, 10.0), st.floats(0.0, 20.0))
def test_stiff_rate_is_that_of_the_traction(stretch, Y, c, eta):
    n, _ = stiffness(stretch, c, eta)
    velocity, rate = own.stiff_rate(n, (AT_REST, Y))
    assert velocity == Y
    traction = MU_F * square(roscoe(stretch, integrals(stretch), AT_REST, Y)) - square(viscous_stress(Y, eta))
    expected = c * np.prod(stretch) * traction
    np.testing.assert_allclose(
        square(rate) * np.array(n.b), expected, atol=1e-10 * (1 + np.abs(expected).max())
    )


@given(mild_stretches, tensors, tensors, tensors, st.floats(0.1, 10.0), st.floats(0.0, 20.0))
def test_fluid_change_is_that_of_roscoes_traction(stretch, l_f, dl_f, l_s, c, eta):
    n, _ = stiffness(stretch, c, eta)
    g = integrals(stretch)
    before, after = (square(roscoe(stretch, g, l, l_s)) for l in (l_f, tuple(np.add(l_f, dl_f))))
    expected = c * np.prod(stretch) * MU_F * (after - before)
    found = square(own.fluid_change(n, dl_f)) * np.array(n.b)
    np.testing.assert_allclose(found, expected, atol=1e-10 * (1 + np.abs(expected).max()))


@given(mild_stretches, tensors, tensors, tensors, st.floats(0.1, 10.0))
def test_turning_changes_the_rate_as_it_does_in_a_body_that_turns(stretch, l_s, l_f, stress, c):
    """Shape, l_s and traction turn with one spin, the elastic stress with another, and the flow with none."""
    n, _ = stiffness(stretch, c)
    g, b, J = integrals(stretch), np.array(n.b), np.prod(stretch)
    W, spin = square(shape_spin(stretch, l_s)), square(skew(l_s))
    tau = square(stress) + square(stress).T

    def rate(t):
        R, S = expm(t * W), expm(t * spin)
        seen = roscoe(stretch, g, flat(R.T @ square(l_f) @ R), l_s)
        force = c * J * MU_F * square(seen) - c * (R.T @ S @ tau @ S.T @ R)
        return R @ (force / b - square(l_s) @ square(l_s)) @ R.T

    h = 1e-4
    change = (8.0 * (rate(h) - rate(-h)) - (rate(2 * h) - rate(-2 * h))) / (12.0 * h)
    turned = W @ square(l_s) - square(l_s) @ W
    _, stiff = own.stiff_rate(n, (flat(spin), flat(turned)))
    found = own.turning_acceleration(stretch, n, c, l_s, flat(rate(0.0)), l_f, flat(tau))
    size = 1.0 + np.abs(rate(0.0)).max() + np.abs(change).max()
    np.testing.assert_allclose(square(found), change - square(stiff), atol=1e-7 * size)


@given(mild_stretches, tensors, st.floats(0.1, 10.0))
def test_stiff_rate_is_that_of_elasticity(stretch, X, c):
    n, e = stiffness(stretch, c)
    _, rate = own.stiff_rate(n, (X, AT_REST))
    X, s = square(X), np.array(e.squares)
    stress = np.diag(square(e.slopes) @ np.diag(X))
    for (i, j), shear in (((1, 2), e.shear[0]), ((0, 2), e.shear[1]), ((0, 1), e.shear[2])):
        stress[i, j] = stress[j, i] = shear * (X[i, j] * s[j] + X[j, i] * s[i])
    np.testing.assert_allclose(square(rate) * np.array(n.b), -c * stress, atol=1e-8)


@given(mild_stretches, st.floats(0.1, 10.0), st.floats(0.0, 20.0))
def test_where_drag_outweighs_inertia_shear_relaxes_at_its_rate(stretch, c, eta):
    """The traction's and the elastic part of dl_s/dt balance: T Y + E X = 0, and X decays by −T⁻¹E."""
    n, _ = stiffness(stretch, c, eta)
    units = [flat(unit) for unit in np.eye(9)]
    T = np.array([own.stiff_rate(n, (AT_REST, unit))[1] for unit in units]).T
    E = np.array([own.stiff_rate(n, (unit, AT_REST))[1] for unit in units]).T
    shear = np.ix_([1, 2, 3, 5, 6, 7], [1, 2, 3, 5, 6, 7])
    rates = np.linalg.eigvals(np.linalg.solve(T[shear], E[shear]))
    np.testing.assert_allclose(rosenbrock.relaxation_rate(n), abs(rates).max(), rtol=1e-8)


@given(mild_stretches, tensors, tensors, st.floats(1e-3, 10.0))
def test_response_is_that_function_of_the_stiffness(stretch, X, Y, h):
    n, _ = stiffness(stretch)
    J = np.empty((18, 18))
    for k in range(18):
        unit = np.zeros(18)
        unit[k] = 1.0
        J[:, k] = np.concatenate(own.stiff_rate(n, (tuple(unit[:9]), tuple(unit[9:]))))
    P = np.linalg.inv(np.eye(18) - own.GAMMA * h * J)
    pairs = [(X, Y), (Y, X), (flat(square(X).T), Y)]
    expected = np.zeros(18)
    for weights, pair in zip((own.R1, own.R2, own.R3), pairs, strict=True):
        f = sum(w * np.linalg.matrix_power(P, i + 1) for i, w in enumerate(weights))
        expected += h * f @ np.concatenate(pair)
    found = np.concatenate(own.respond(n, own.resolvent(n, h), h, *pairs))
    np.testing.assert_allclose(found, expected, atol=1e-7 * (1.0 + np.abs(expected).max()))


def test_a_slope_counts_for_its_sum_or_a_little_more():
    """½ P for r₂, from no damping to one that leaves nothing."""
    ratios = [0.5 / (1.0 - own.GAMMA * z) / r(2, z) for z in -np.geomspace(1e-6, 1e6, 40)]
    assert 0.96 < min(ratios) < max(ratios) < 1.15


@given(mild_stretches, tensors, tensors, st.floats(1e-3, 10.0))
def test_resolve_inverts_one_less_the_stiff_rate(stretch, X, Y, h):
    n, _ = stiffness(stretch)
    whole = own.resolvent(n, h)
    s = own.resolve(n, whole, (X, Y))
    # (1 − γhJ) s = v
    J = own.stiff_rate(n, s)
    for part, rate, v in zip(s, J, (X, Y), strict=True):
        back = np.subtract(part, own.GAMMA * h * np.array(rate))
        np.testing.assert_allclose(back, np.array(v), atol=1e-7 * (1.0 + np.abs(v).max()))


@given(st.tuples(positive, positive, positive), st.floats(1e-3, 10.0))
def test_the_barycentre_is_advanced_by_the_same_functions(rates, h):
    """Along each axis by its own rate."""
    random = np.random.default_rng(7)
    vectors = random.normal(size=(3, 2, 3))
    expected = np.zeros((2, 3))
    for axis, rate in enumerate(rates):
        J = np.array([[0.0, 1.0], [0.0, -rate]])
        P = np.linalg.inv(np.eye(2) - own.GAMMA * h * J)
        for weights, pair in zip((own.R1, own.R2, own.R3), vectors[:, :, axis], strict=True):
            f = sum(a * np.linalg.matrix_power(P, i + 1) for i, a in enumerate(weights))
            expected[:, axis] += h * f @ pair
    found = path.respond(rates, h, *((tuple(x), tuple(v)) for x, v in vectors))
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-9 * abs(expected).max())


RATES = np.array([0.7, 2.0, 5.0])
SPRING, FRICTION, WEIGHT = np.array([1.5, -0.8, 3.0]), np.array([0.3, 0.9, -0.5]), np.array([0.2, -1.0, 0.4])
FLUID = np.array([[0.5, -1.2, 2.0], [1.0, 0.6, -0.9], [-0.4, 0.8, 1.1]])
"""u₀, its rate and half its second derivative."""
START = np.array([[0.3, -0.6, 0.9], [-1.0, 0.4, 0.2]])


def exact_path(t):
    """Of dv/dt = g − w x − c v + k (u₀ + t u₁ + t² u₂ − v), by the exponential of a matrix for each axis."""
    found = np.empty((2, 3))
    for i in range(3):
        k = RATES[i]
        A = np.zeros((5, 5))
        # For x, v, 1, t and t².
        A[0, 1] = A[3, 2] = 1.0
        A[4, 3] = 2.0
        A[1] = [-SPRING[i], -FRICTION[i] - k, WEIGHT[i] + k * FLUID[0, i], k * FLUID[1, i], k * FLUID[2, i]]
        found[:, i] = (expm(t * A) @ [*START[:, i], 1.0, 0.0, 0.0])[:2]
    return found


def path_by_a_step(h):
    """The changes of x and v of order 2 and of order 3."""
    rate = tuple(RATES)

    def forced(t, moved):
        x, v = START + np.asarray(moved)
        u = FLUID[0] + t * FLUID[1] + t * t * FLUID[2]
        return WEIGHT - SPRING * x - FRICTION * v + RATES * (u - v)

    start = START[1], forced(0.0, np.zeros((2, 3)))
    changes = path.fluid_changes(rate, h, h * FLUID[1] + h * h * FLUID[2], FLUID[1])
    first, t = path.first_motion(rate, h, start, *changes), path.NODE * h
    seen = RATES * (t * FLUID[1] + t * t * FLUID[2])
    slope = path.slope(rate, first[1], forced(t, first), start[1], seen, 1.0 / path.NODE)
    last = path.last_motion(rate, h, start, *changes, slope)
    end = path.slope(rate, last[1], forced(h, last), start[1], changes[0], 1.0)
    args = (rate, h, start, *changes, slope)
    return np.array([path.second_order(*args), path.third_order(*args, end)])


def test_each_axis_of_the_path_is_of_its_order():
    """With drag, another along each axis, a fluid that speeds up, and forces by place and velocity."""
    steps = (0.02, 0.01)
    errors = np.array([abs(path_by_a_step(h) + START - exact_path(h)) for h in steps])
    # A step of order 2 misses v by h³, and x by one power more.
    orders = np.log2(errors[0] / errors[1])
    assert orders[0, 1] == pytest.approx([3.0] * 3, abs=0.2)
    assert orders[1] == pytest.approx(np.full((2, 3), 4.0), abs=0.3)
    assert errors[0, 1].max() < 1e-5
