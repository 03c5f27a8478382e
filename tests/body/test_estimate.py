from __future__ import annotations

from math import inf, pi

import pytest
from scipy.integrate import solve_ivp

from foamprb.body.estimate import (
    SoftSphere,
    Surroundings,
    across_forces,
    estimate,
    lift_coefficient,
    shear_modulus,
)

WATER = Surroundings(mu=1e-3, rho=1000.0, shear_rate=100.0, wall_distance=20e-6, temperature=300.0)
BEAD = SoftSphere(d=5e-6, rho=1050.0, mu=1.0)


def test_numbers_of_a_bead_in_water():
    """By hand: 5 µm, 50 kg/m³ denser than water, 1 Pa, 100 1/s."""
    e = estimate(BEAD, WATER, 10.0)
    assert e.capillary_number == pytest.approx(0.1)
    assert e.reynolds_number == pytest.approx(2.5e-3)
    assert e.stokes_number == pytest.approx(100.0 * 1050.0 * 25e-12 / 18e-3)
    assert e.settling_speed == pytest.approx(2.0 / 9.0 * 50.0 * 9.81 * 6.25e-12 / 1e-3, rel=1e-6, abs=0.0)
    D = 1.380649e-23 * 300.0 / (6.0 * pi * 1e-3 * 2.5e-6)
    assert e.diffusion_coefficient == pytest.approx(D, rel=1e-6, abs=0.0)
    assert e.peclet_number == pytest.approx(100.0 * 6.25e-12 / D)
    assert e.lift_speed == pytest.approx(0.0996 * 100.0 * 2.5e-6**3 / 20e-6**2, rel=0.01)
    assert e.settling_length == pytest.approx(10.0 * e.settling_speed, rel=1e-6)
    assert e.settling_reynolds_number == pytest.approx(e.settling_speed * 5.0)
    assert e.diffusion_length == pytest.approx((20.0 * D) ** 0.5)
    # 5/2 k_B T of energy μ_s V ε:ε.
    assert 1.0 * 4.0 / 3.0 * pi * 2.5e-6**3 * e.thermal_strain**2 == pytest.approx(
        2.5 * 1.380649e-23 * 300, abs=0.0
    )


@pytest.mark.parametrize(("Ca", "k"), [(0.1, 0.0996), (0.2, 0.1947), (0.4, 0.3600), (1.0, 0.6858)])
def test_lift_coefficient(Ca, k):
    assert lift_coefficient(Ca) == pytest.approx(k, rel=3e-3)


def test_the_lift_length_is_the_integral_of_the_lift_speed():
    t = 30.0
    e = estimate(BEAD, WATER, t)
    k = e.lift_speed * WATER.wall_distance**2

    def rate(_t, h):
        return k / h**2

    answer = solve_ivp(rate, (0.0, t), [WATER.wall_distance], rtol=1e-10, atol=1e-16)
    assert e.lift_length == pytest.approx(answer.y[0, -1] - WATER.wall_distance, rel=1e-6)


def test_at_the_lift_height_the_lift_balances_weight():
    e = estimate(BEAD, WATER, 1.0)
    there = estimate(BEAD, WATER._replace(wall_distance=e.lift_height), 1.0)
    assert there.lift_speed == pytest.approx(there.settling_speed, rel=1e-6, abs=0.0)


def test_a_heavy_sphere_falls_before_it_settles():
    """1 mm in air: settling at 30 m/s after some seconds, but g t²/2 in a hundredth of a second."""
    sphere, air = SoftSphere(1e-3, 1000.0, 1.0), Surroundings(1.8e-5, 1.2, 100.0)
    tau = 1000.0 * 1e-6 / (18.0 * 1.8e-5)
    for t in (1e-4, 1e-2):
        assert estimate(sphere, air, t).settling_length == pytest.approx(
            0.5 * 9.81 * 0.9988 * t * t, rel=2e-3
        )
    e = estimate(sphere, air, 100.0 * tau)
    assert e.settling_length == pytest.approx(99.0 * tau * e.settling_speed)
    assert e.settling_reynolds_number == pytest.approx(1.2 * e.settling_speed * 1e-3 / 1.8e-5)


def test_without_a_wall_or_weight():
    e = estimate(BEAD._replace(rho=1000.0), WATER._replace(wall_distance=inf), 1.0)
    assert (e.lift_speed, e.lift_length, e.settling_speed, e.lift_height) == (0.0, 0.0, 0.0, inf)


def test_a_light_sphere_rises():
    assert estimate(BEAD._replace(rho=950.0), WATER, 1.0).settling_speed < 0.0


def test_the_modulus_from_a_capillary_number():
    mu = shear_modulus(0.1, WATER.mu, WATER.shear_rate)
    assert estimate(BEAD._replace(mu=mu), WATER, 1.0).capillary_number == pytest.approx(0.1)


def test_forces_across_the_flow_of_a_channel():
    """At 0.4 of its width: C = 0.24613 at s = 0.2 outwards, with 100/s 1/s at the walls."""
    f, e = across_forces(BEAD, WATER, 50e-6), estimate(BEAD, WATER, 1.0)
    assert f.duct_lift == pytest.approx(-0.24613 * 1000.0 * 500.0**2 * 2.5e-6**4, rel=1e-6, abs=0.0)
    drag = 6.0 * pi * 1e-3 * 2.5e-6
    assert f.wall_lift == pytest.approx(drag * e.lift_speed, rel=1e-6, abs=0.0)
    assert f.weight == pytest.approx(4.0 / 3.0 * pi * 2.5e-6**3 * 50.0 * 9.81, rel=1e-6, abs=0.0)
    saffman = 6.46 * 1e-3 * 2.5e-6**2 * (1000.0 * 100.0 / 1e-3) ** 0.5 * e.settling_speed
    assert f.slip_lift == pytest.approx(saffman, rel=2e-3, abs=0.0)
    assert across_forces(BEAD, WATER).duct_lift == 0.0
    # Away from the wall nearer to it than 0.18 of the width.
    assert across_forces(BEAD, WATER._replace(wall_distance=8e-6), 50e-6).duct_lift > 0.0
