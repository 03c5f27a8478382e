from __future__ import annotations

import math

import numpy as np
import pytest

from foamprb.body.lift import DUCTS, SAFFMAN, lift_coefficient, lift_force, lifted_slip, mei_factor

R, SLIP, RATE, RHO, MU = 25e-6, 1e-3, 1000.0, 1000.0, 1e-3
AXES = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def test_saffmans_force_and_meis_factor_in_water():
    """Re 0.05 and Re_ω 2.5: 1.2768e-10 N, and 0.3 % more by Mei."""
    factor = mei_factor(0.05, 2.5)
    a = 0.3314 * math.sqrt(25.0)
    assert factor == pytest.approx((1.0 - a) * math.exp(-0.005) + a, rel=1e-14, abs=0.0)
    force = lift_coefficient(SLIP, RATE, R, RHO, MU) * RATE * SLIP
    assert force / factor == pytest.approx(1.2768e-10, rel=5e-5, abs=0.0)
    assert force == pytest.approx(1.2810e-10, rel=5e-5, abs=0.0)
    assert force / factor / (6.0 * math.pi * MU * R * SLIP) == pytest.approx(0.2709, abs=5e-5)


def test_the_factor_is_one_without_slip_and_mei_s_second_law_from_re_40_on():
    assert mei_factor(0.0, 2.5) == 1.0
    assert mei_factor(1e-9, 2.5) == pytest.approx(1.0, abs=1e-4)
    assert mei_factor(50.0, 10.0) == pytest.approx(0.0524 * math.sqrt(5.0), rel=1e-14, abs=0.0)


def test_openfoam_writes_the_same_force():
    """m/ρ ρ_f C_l (u − v) × ω with C_l = 3/(2π √Re_ω) C_ld."""
    Re, Re_w = 2.0 * R * RHO * 0.1 / MU, 4.0 * R * R * RHO * RATE / MU
    volume = 4.0 / 3.0 * math.pi * R**3
    theirs = volume * RHO * 3.0 / (2.0 * math.pi * math.sqrt(Re_w)) * SAFFMAN * mei_factor(Re, Re_w)
    assert lift_coefficient(0.1, RATE, R, RHO, MU) == pytest.approx(theirs, rel=1e-12, abs=0.0)


def test_lift_is_perpendicular_to_vorticity_and_slip():
    w, omega = np.array([SLIP, 2e-4, -3e-4]), np.array([100.0, 300.0, -RATE])
    L = lift_coefficient(np.linalg.norm(w), np.linalg.norm(omega), R, RHO, MU)
    np.testing.assert_allclose(
        lift_force(tuple(w), tuple(omega), R, RHO, MU), L * np.cross(omega, w), rtol=1e-12
    )


def test_drag_balances_load_and_lift_on_an_ellipsoid():
    K = np.array([1.5, 2.0, 1.0]) * 6.0 * math.pi * R
    c, s = math.cos(0.4), math.sin(0.4)
    Q = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    w0, omega = np.array([SLIP, 2e-4, -3e-4]), np.array([100.0, 300.0, -RATE])
    w = np.array(
        lifted_slip(tuple(w0), tuple(Q.ravel()), tuple(np.diag(K).ravel()), tuple(omega), R, RHO, MU)
    )
    L = lift_coefficient(np.linalg.norm(w), np.linalg.norm(omega), R, RHO, MU)
    resistance = MU * Q.T @ np.diag(K) @ Q
    np.testing.assert_allclose(resistance @ (w - w0), L * np.cross(omega, w), rtol=1e-6, atol=1e-18)


def test_without_vorticity_or_load_there_is_no_lift():
    K, w0 = tuple(6.0 * math.pi * R * np.eye(3).ravel()), (SLIP, 0.0, 0.0)
    assert lifted_slip(w0, AXES, K, (0.0, 0.0, 0.0), R, RHO, MU) == w0
    assert lifted_slip((0.0, 0.0, 0.0), AXES, K, (0.0, 0.0, RATE), R, RHO, MU) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("table", DUCTS.values(), ids=DUCTS)
def test_lift_in_ducts_is_a_smooth_function_of_the_place(table):
    """From 0 on the axis to −55π/96 at the wall (Cox and Hsu 1977); round-off of the digits is 16 · 5e-6."""
    s, C = np.array(table).T
    np.testing.assert_allclose(s, np.linspace(0.0, 1.0, 41), atol=1e-15)
    assert np.abs(np.diff(C, 4)).max() < 2.5e-3
    assert C[0] == 0.0
    assert C[-1] == pytest.approx(-55.0 * math.pi / 96.0, abs=1e-5)
