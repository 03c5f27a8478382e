"""Bodies with inertia near walls, whose drag the walls hinder: paths against their exact equations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from strategies import flat, square
from validation.references import wall as ref

from foamprb import analytic
from foamprb.body.drag import oberbeck
from foamprb.body.ellipsoid import integrals
from foamprb.body.tensor import ZERO
from foamprb.body.traction import roscoe
from foamprb.body.wall import force_gradient, hindered_resistance, hindrance, stresslet_gradient
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import Status, concatenate, set_rest_shape, spheres
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError

R, MU_F, RHO = 1e-5, 1e-3, 2000.0
TAU = 2.0 / 9.0 * RHO * R**2 / MU_F
"""Time in which drag stops a sphere that no wall is near, s."""
MASS = 4.0 / 3.0 * np.pi * R**3 * RHO
STILL = analytic.shear_over_wall(0.0)
SLOPE = np.array([0.6, 0.0, -0.8])
STIFF, RIGID = 1e5, 1e7
"""Shear moduli, Pa: strains of up to 0.02 next to the wall, and 2e-4."""
NO_STRAIN = WallLift(cutOff=1000.0, strain=False)


def weight(stokes_number):
    """Acceleration by which a sphere far from walls falls its Stokes number times its radius in τ, m/s²."""
    return stokes_number * R / TAU**2


def bodies(heights, mu=STIFF, rho=RHO):
    x = [(0.0, 0.0, h * R) for h in np.atleast_1d(heights)]
    p = spheres(x, d=2.0 * R, rho=rho, mu=mu, poissons_ratio=0.4999)
    p.v[:] = 0.0
    return p


def cloud_of(p, g, dt, *, integrator="rosenbrock", model=None, flow=STILL, threads=1, **more):
    """Gravity is all that acts: the fluid has no weight."""
    around = (model or WallLift(cutOff=1000.0),)
    models = Models(integrator=integrator, surroundings=around, **more)
    rules = [Rebound()] * len(flow.patches)
    return Cloud(p, flow, Medium(MU_F, 1e-6, tuple(g)), rules, dt, models, threads=threads)


def carried(p, g, dt, steps, **more):
    cloud_of(p, g, dt, **more).advance(steps)
    return p


def mobilities(e):
    """Of a sphere along and across a wall (Schäffer et al.), over that without."""
    along = 1 / (1 - np.log(1 - e) / 2 + e / 16 + 17 * e**2 / 256 - 0.1137 * e**3 + 0.0559 * e**4)
    across = 1 - 9 * e / 8 + e**3 / 2 - 57 * e**4 / 100 + e**5 / 5 + 7 * e**11 / 200 - e**12 / 25
    return along, across


def fallen(h, g, end=np.inf, lowest=0.0):
    """When and where a rigid sphere from rest is, and its velocity (x, z, v, w), from its equation of motion.

    m dv/dt = m g − 6πμR v/m(R/h), until a time or a height, in radii.
    """

    def rate(_t, y):
        along, across = mobilities(R / y[1])
        return y[2], y[3], g[0] - y[2] / (TAU * along), g[2] - y[3] / (TAU * across)

    def low(_t, y):
        return y[1] - lowest * R

    low.terminal = True
    scale = np.array([R, R, R / TAU, R / TAU])
    last = min(end, 1e6 * TAU)
    start = (0.0, h * R, 0.0, 0.0)
    found = solve_ivp(rate, (0.0, last), start, "LSODA", events=low, rtol=1e-10, atol=1e-12 * scale)
    return found.t[-1], found.y[:, -1]


def state(p):
    return np.array([p.x[0, 0], p.x[0, 2], p.v[0, 0], p.v[0, 2]])


def test_it_does_so_with_order_three():
    """What lies beside the wall's normal and what lies along it, of a sphere that stays round."""
    g = weight(1.0) * SLOPE
    end, expected = fallen(2.0, g, lowest=1.35)
    errors = np.array(
        [
            state(carried(bodies(2.0, RIGID), g, end / n, n, model=NO_STRAIN, tolerance=np.inf)) - expected
            for n in (8, 16, 32)
        ]
    )[:, [0, 3]] / (R, expected[3])
    assert abs(errors[-1]).max() < 2e-5
    assert np.log2(errors[:-1] / errors[1:]).min() > 2.9


def test_steps_may_be_long_against_the_time_in_which_drag_stops_it():
    """St of 1e-4 and steps of up to 5400 τ, from 3R to a gap of 0.2R: with order two still."""
    g = weight(1e-4) * SLOPE
    end, expected = fallen(3.0, g, lowest=1.2)
    assert end / 10 > 5000.0 * TAU
    errors = np.array(
        [
            state(carried(bodies(3.0, RIGID), g, end / n, n, model=NO_STRAIN, tolerance=np.inf)) - expected
            for n in (10, 20, 40)
        ]
    )
    assert (abs(errors[:, :2]).max(axis=1) < R * np.array([6e-4, 7e-5, 2e-5])).all()
    assert (abs(errors[:, 2:] / expected[2:]).max(axis=1) < [0.05, 0.01, 0.002]).all()
    assert np.log2(errors[:-1, 0] / errors[1:, 0]).min() > 1.7


@pytest.mark.parametrize(("h", "ratios"), [(2.0, (1.6, 1.0, 0.8)), (1.7, (1.2, 1.0, 0.9))])
def test_settling_soft_ellipsoid_in_shear_follows_its_equations(h, ratios):
    """The lighter at the same weight, in proportion to γ̇τ; to 2e-3, the error of steps of `stokes`."""

    def ended(integrator, lightness):
        p = spheres([(0.0, 0.0, h * R)], d=2.0 * R, rho=RHO / lightness, mu=1.0, poissons_ratio=0.4999)
        set_rest_shape(p, ratios)
        g = lightness * weight(1e-3) * SLOPE
        carried(p, g, 0.02 / 100.0, 50, integrator=integrator, flow=SHEAR)
        F = p.F[0].reshape(3, 3)
        return np.concatenate([p.x[0] / R, p.v[0] / (100.0 * R), (F @ F.T).ravel()])

    limit = ended("rosenbrock", 1000.0)
    misses = [abs(ended("rosenbrock", lightness) - limit).max() for lightness in (1.0, 10.0, 100.0)]
    assert misses[0] < 0.02
    assert np.array(misses[1:]) * [10.0, 100.0] == pytest.approx(misses[0], rel=0.3)
    assert limit == pytest.approx(ended("stokes", 1.0), abs=3e-3)


def dev(T):
    return T - np.trace(T) / 3.0 * np.eye(3)


def drag_of(Q, axes, h):
    """Its hindered resistance, (3, 3), m."""
    n = Q @ [0.0, 0.0, 1.0]
    k = tuple(R * np.array(oberbeck(tuple(axes), integrals(tuple(axes)))))
    gap = (h - np.linalg.norm(axes * n)) * R
    K = np.reshape(hindered_resistance(k, hindrance(k, tuple(n), h * R, gap)), (3, 3))
    return Q.T @ K @ Q


@pytest.mark.parametrize("h", [8.0, 2.0, 1.6])
def test_drag_on_a_tilted_spheroid_is_the_whole_tensor_near_the_wall(h):
    """How it comes to its settling from a throw, v̇ = g − μ_f K_h·v/m, its axes oblique to the wall.

    Without strain, by which the image of its drag would turn it.
    """
    axis = np.array([0.6, 0.48, 0.64])
    Q = np.stack([axis, *np.linalg.svd(axis[None])[2][1:]])
    Q[2] *= np.linalg.det(Q)
    axes = np.array([2.0, 1.0, 1.0]) / np.cbrt(2.0)
    p = bodies(h)
    set_rest_shape(p, axes, Q)
    g, speed = weight(1e-4) * SLOPE, 1e-4 * R / TAU
    p.v[0] = thrown = speed * np.array([-0.5, 1.0, 0.7])
    carried(p, g, 0.1 * TAU, 8, model=NO_STRAIN)
    rate = MU_F * drag_of(Q, axes, h) / MASS
    assert abs(rate - np.diag(np.diag(rate))).max() > 0.02 / TAU
    settling = np.linalg.solve(rate, g)
    expected = settling + expm(-0.8 * TAU * rate) @ (thrown - settling)
    assert p.v[0] == pytest.approx(expected, abs=1e-3 * speed)


@pytest.mark.parametrize(("h", "miss", "slow"), [(5.0, 5e-3, 2e-3), (3.0, 0.01, 2e-3), (2.0, 0.03, 5e-3)])
def test_a_soft_one_falls_and_deforms_as_in_the_stokes_flow_around_it(h, miss, slow):
    """St of 0.01, after ten times the time in which drag stops it: deformed by the image of its drag."""
    g, mu = weight(0.01) * SLOPE, 0.1
    p = carried(bodies(h, mu), g, TAU, 10)
    F, force = p.F[0].reshape(3, 3), MASS * g
    scale = np.linalg.norm(force) / (MU_F * R**2)
    assert abs(F @ F.T - np.eye(3)).max() > 5e-3
    exact = ref.Ellipsoid(F, p.x[0, 2] / R).free_motion(
        mu / (MU_F * scale) * F @ F.T, np.zeros((3, 3)), force / np.linalg.norm(force)
    )
    l = p.A[0].reshape(3, 3) @ np.linalg.inv(F) / scale
    strain, expected = 0.5 * (l + l.T), 0.5 * (exact.l + exact.l.T)
    assert abs(strain - expected).max() < miss * abs(expected).max()
    assert p.v[0, ::2] / (scale * R) == pytest.approx(exact.v[::2], rel=slow)


def test_a_soft_one_that_is_thrown_deforms_by_its_drag():
    """Not by its weight, of which it has none: σ̃ of the image's strain begins to move the shape."""
    h, speed = 2.0, 1e-2 * R / TAU
    p = bodies(h, 0.1)
    p.v[0] = speed * np.array([0.6, 0.0, -0.8])
    carried(p, np.zeros(3), 1e-4 * TAU, 1)
    load = MU_F * drag_of(np.eye(3), np.ones(3), h) @ p.v[0]
    E = square(force_gradient(tuple(load), flat(R**2 * np.eye(3)), (0.0, 0.0, 1.0), h * R, MU_F))
    # In which a rigid sphere has the stresslet 20/3 π μ R³ E, whose image is a part of it.
    S = flat(20.0 / 3.0 * np.pi * MU_F * R**3 * E)
    E = E + square(stresslet_gradient(S, flat(R**2 * np.eye(3)), (0.0, 0.0, 1.0), h * R, MU_F))
    begins = (
        5.0 / (RHO * R**2) * MU_F * square(roscoe((1.0, 1.0, 1.0), integrals((1.0, 1.0, 1.0)), flat(E), ZERO))
    )
    found = p.A[0].reshape(3, 3) / (1e-4 * TAU)
    np.testing.assert_allclose(dev(found), dev(begins), atol=2e-3 * abs(begins).max())


SHEAR = analytic.shear_over_wall(100.0)


def many(ratios=(1.0, 1.0, 1.0)):
    p = bodies(np.linspace(1.2, 14.0, 50), 1.0)
    set_rest_shape(p, ratios)
    return p


def test_a_particle_that_no_wall_is_near_goes_as_without_the_model():
    """Whatever others are in its block."""
    g, heights = weight(0.1) * SLOPE, [30.0, 31.0, 500.0]
    alone, shear = bodies(heights, 1.0), analytic.linear([[0.0, 0.0, 100.0], [0.0] * 3, [0.0] * 3])
    Cloud(alone, shear, Medium(MU_F, 1e-6, tuple(g)), (), TAU, Models(integrator="rosenbrock"),
          threads=1).advance(6)  # fmt: skip
    p = carried(concatenate([many(), bodies(heights, 1.0)]), g, TAU, 6, flow=SHEAR, model=WallLift())
    only = carried(bodies(heights, 1.0), g, TAU, 6, flow=SHEAR, model=WallLift())
    for name in ("x", "v", "F", "A"):
        assert np.array_equal(getattr(p, name)[-3:], getattr(only, name)), name
        scale = np.abs(getattr(alone, name)).max()
        np.testing.assert_allclose(
            getattr(only, name), getattr(alone, name), 1e-11, 1e-13 * scale, err_msg=name
        )


def test_it_comes_to_touch_the_wall():
    """The least gap ends what the gap would do; then it lies there."""
    p = carried(bodies(1.5), (0.0, 0.0, -weight(0.1)), 10.0 * TAU, 60, model=WallLift(leastGap=0.05))
    assert p.status[0] == Status.ACTIVE
    assert p.x[0, 2] == pytest.approx(R, rel=0.01)


def test_the_papers_integrator_is_refused():
    with pytest.raises(
        InputError, match=r"wallLift/mobility is yes.*stokes or rosenbrock, not paper.*mobility no"
    ):
        carried(bodies(4.0), (0.0, 0.0, 0.0), TAU, 1, integrator="paper")
