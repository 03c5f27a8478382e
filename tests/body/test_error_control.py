from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pair_steps import CA, REST, pair_step, shear, steps, turning_strain, unit_bodies
from strategies import flat, mild_stretches, rotations, square, tensors

from foamprb.body import error_control as control
from foamprb.body.material import finger, finger_of_sphere
from foamprb.body.tensor import dot, inverse

UNSTRAINED = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


@given(rotations, mild_stretches, tensors)
def test_strain_by_is_the_change_of_b(R, stretch, Omega):
    F = R @ np.diag(stretch)
    h = 1e-6
    ends = [finger_of_sphere(flat((np.eye(3) + k * h * square(Omega)) @ F), UNSTRAINED) for k in (-1, 1)]
    expected = (np.array(ends[1]) - np.array(ends[0])) / (2 * h)
    np.testing.assert_allclose(control.strain_by(Omega, flat(F @ F.T)), expected, atol=1e-8)


@given(st.floats(1e-5, 0.3), st.floats(1e-8, 1e-4))
def test_an_error_is_relative_to_the_strain(strain, error):
    """b_e = diag(1 + s, 1, 1): an error ε of ln λ₁ is one of 2ε of b_e, over s; a turn by ε counts as ε."""
    b_e = (1.0 + strain, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    scale = control.strain_scale(b_e, (0.0,) * 9)
    np.testing.assert_allclose(scale, strain, rtol=1e-9)
    stretch = (error, *(0.0,) * 8)
    np.testing.assert_allclose(
        control.relative_size(stretch, b_e, scale), 2 * error * (1 + strain) / strain, rtol=1e-6
    )
    turn = (0.0, error, 0.0, -error, 0.0, 0.0, 0.0, 0.0, 0.0)
    np.testing.assert_allclose(control.relative_size(turn, b_e, scale), error, rtol=1e-6)


def test_a_body_that_starts_from_rest_is_measured_by_the_strain_at_the_end():
    shear = (0.0, 0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    np.testing.assert_allclose(control.strain_scale(UNSTRAINED, shear), 0.02)
    np.testing.assert_allclose(control.strain_scale(UNSTRAINED, (0.0,) * 9), control.LEAST_STRAIN)


def test_path_errors_are_those_of_the_chord_and_of_the_parabola():
    """v = t²: ∫v is h³/3; the chord gives h³/2, and the parabola is exact. v = t³: h⁴/4, h⁴/2 and h⁴/3."""
    h, way = 0.1, 0.02

    def errors(dv, a0, a1):
        return control.chord_error(h, way, a0, a1), control.parabola_error(h, way, dv, a0, a1)

    squares = errors((h**2, 0.0, 0.0), (0.0, 0.0, 0.0), (2 * h, 0.0, 0.0))
    np.testing.assert_allclose(squares, [h**3 * (1 / 2 - 1 / 3) / way, 0.0], rtol=1e-12)
    cubes = errors((0.0, h**3, 0.0), (0.0, 0.0, 0.0), (0.0, 3 * h**2, 0.0))
    np.testing.assert_allclose(
        cubes, [h**4 * (1 / 2 - 1 / 4) / way, h**4 * (1 / 3 - 1 / 4) / way], rtol=1e-12
    )


def test_parabola_error_includes_an_inconsistent_acceleration():
    """v = t with an acceleration of 1 + δ: the parabola gives h²/2 + δ h²/6, the chord is exact."""
    h, way, delta = 0.1, 0.02, 0.3
    wrong = (0.0, 0.0, 1.0 + delta)
    assert control.chord_error(h, way, wrong, wrong) == 0.0
    found = control.parabola_error(h, way, (0.0, 0.0, h), wrong, wrong)
    np.testing.assert_allclose(found, delta * h**2 / 6 / way, rtol=1e-12)


@pytest.mark.parametrize("order", [2, 3])
def test_steps_chosen_by_the_path_settle_below_the_tolerance(order):
    """Errors of h² or h³ over the way: whatever the first step was, the last ones are accepted."""
    tolerance = 1e-4
    for h in (1e-3, 1.0, 30.0):
        errors = []
        for _ in range(30):
            errors.append(1e-4 * h**order)
            by_path = control.path_factor(errors[-1], tolerance)
            h *= control.step_factor(False, 0.0, by_path, tolerance)
        late = np.array(errors[20:])
        assert np.all((late <= tolerance) & (late > 0.5 * tolerance))


def test_step_factor():
    tolerance = 1e-4
    assert control.step_factor(False, 1.0, np.inf, tolerance) == control.MOST
    assert control.step_factor(True, np.nan, np.inf, tolerance) == control.LEAST
    assert control.step_factor(True, 1e9, np.inf, tolerance) == control.LEAST
    # δ₂ of tolerance^(3/4) is just accepted; it is of third order.
    just = tolerance**0.75
    assert control.step_factor(True, just, np.inf, tolerance) == pytest.approx(control.SAFETY)
    assert control.step_factor(True, just / 8, np.inf, tolerance) == pytest.approx(2 * control.SAFETY)
    by_path = control.path_factor(4 * tolerance, tolerance)
    assert control.step_factor(False, 0.0, by_path, tolerance) == pytest.approx(control.SAFETY / 2)
    for path in (np.inf, np.nan):
        by_path = control.path_factor(path, tolerance)
        assert control.step_factor(False, 0.0, by_path, tolerance) == control.LEAST


def test_next_size():
    """At most half as long again as was meant; a step cut short does not cut the next but by its error."""
    assert control.next_size(1.0, 1.0, control.MOST, False) == control.GROWTH
    assert control.next_size(1.0, 1.0, control.MOST, True) == 1.0
    assert control.next_size(1.0, 1.0, 1.2, False) == 1.2
    assert control.next_size(1.0, 1.0, 0.4, True) == 0.4
    assert control.next_size(0.1, 1.0, control.MOST, False) == 1.0
    assert control.next_size(0.1, 1.0, 1.2, False) == pytest.approx(0.12)


@given(
    stretch=st.integers(1, 32),
    share=st.floats(1e-3, 1.0),
)
def test_a_stretch_is_soon_limited_by_its_errors_only(stretch, share):
    """Whatever the size was, where nothing speaks against a step as long as all that is left."""
    longest, size = stretch / np.ceil(stretch * share), 1e-3
    for _ in range(40):
        left = np.ceil(stretch / size - 1e-9)
        size = min(longest, control.next_size(stretch / left, size, control.MOST, False))
    assert np.ceil(stretch / size - 1e-9) == np.ceil(stretch / longest - 1e-9)


def test_learned_share_follows_from_the_difference_of_orders():
    share = control.measured_ratio(np.array([0.1, 1.0, 4.0, 9.0, np.inf]), 10.0)
    np.testing.assert_allclose(share, [0.25, 0.25, 0.6, 1.0, 1.0])


def distance(bodies, F, exact):
    """Size of Ω in F = (1 + Ω) F_exact."""
    b_e = finger(exact, bodies.M)
    Omega = np.array(dot(F, inverse(exact))) - np.eye(3).reshape(9, 1)
    return control.relative_size(tuple(Omega), b_e, control.strain_scale(b_e, (0.0,) * 9))


@cache
def developed(kind):
    """Bodies of all stiffnesses in a flow that turns, at t = 1."""
    bodies, F = unit_bodies(CA, kind)
    return bodies, steps(bodies, F, turning_strain, 20, 0.05, 0.0)


def one_step(h, tolerance):
    """Errors of one step of these bodies against the solution."""
    n, found = len(CA), []
    for kind in REST:
        bodies, F = developed(kind)
        exact = steps(bodies, F, turning_strain, 16, h / 16, 0.0, 1.0)
        args = (bodies, turning_strain, np.ones(n), F, np.full(n, h))
        two, three = (pair_step(*args, t) for t in (np.inf, tolerance))
        found.append((distance(bodies, two.F, exact), distance(bodies, three.F, exact), three.error))
    return np.concatenate(found, axis=1)


def test_the_difference_of_the_two_solutions_is_the_error_of_the_first():
    for h, off in ((0.1, 0.2), (0.025, 0.05)):
        second, third, estimate = one_step(h, 0.0)
        # The largest component depends on the frame, by up to a third.
        np.testing.assert_allclose(estimate**0.75, second, rtol=0.35)
        assert (third < off * second).all()


def test_accepted_steps_have_errors_below_the_tolerance():
    """Steps from far too short to far too long; those that are accepted, with two evaluations or three."""
    shares = []
    for h in (0.02, 0.1, 0.2, 0.4):
        _, error, estimate = one_step(h, 1e-4)
        accepted = estimate <= 1e-4
        assert (error[accepted] < 1e-4).all()
        shares.append(accepted.mean())
    assert shares[0] == 1.0
    assert shares[1] > 0.3
    assert shares[3] < 0.2


@pytest.mark.parametrize(("h", "rho", "share"), [(0.01, 3.0, 0.04), (0.01, 0.0, 0.01), (0.5, 3.0, 1.0)])
def test_the_error_is_the_smaller_a_share_of_the_slopes_part_the_less_its_time(h, rho, share):
    found = control.share_of_slope(h, rho, (0.0, 0.48, 0.0, -0.6, 0.0, 0.0, 0.0, 0.0, 0.64))
    np.testing.assert_allclose(found, control.SECOND_SHARE * share, rtol=1e-12)


def test_soft_bodies_in_steady_shear_need_two_evaluations():
    """At γ̇h = 0.07, and then the error is below the tolerance still."""
    n, tolerance, h = len(CA), 1e-4, 0.07
    bodies, F = unit_bodies(CA, "sphere")
    F = steps(bodies, F, shear, 20, h, 0.0)
    step = pair_step(bodies, shear, np.zeros(n), F, np.full(n, h), tolerance)
    assert (step.evaluations == 2).all()
    assert (distance(bodies, step.F, steps(bodies, F, shear, 32, h / 32, 0.0)) < tolerance).all()


@given(tensors, tensors)
def test_a_rotation_changes_no_longest_step(l_f, F):
    Q = np.linalg.qr(np.reshape(F, (3, 3)) + np.diag([1.0, 3.0, 9.0]))[0]
    turned = tuple((Q @ np.reshape(l_f, (3, 3)) @ Q.T).ravel())
    np.testing.assert_allclose(control.longest_step(turned), control.longest_step(l_f), rtol=1e-9)
    assert control.longest_step((0.0, 2.0, *7 * (0.0,))) == control.LONGEST / 2.0
