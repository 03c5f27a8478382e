"""Bodies with inertia near walls, whose drag the walls hinder: paths against their exact equations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from foamprb import analytic
from foamprb.body.drag import oberbeck
from foamprb.body.ellipsoid import integrals
from foamprb.body.wall import hindered_resistance, hindrance
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound, Stick
from foamprb.cloud.state import concatenate, set_rest_shape, spheres
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.validation.references import wall as ref

R, MU_F, RHO = 1e-5, 1e-3, 2000.0
TAU = 2.0 / 9.0 * RHO * R**2 / MU_F
"""Time in which drag stops a sphere that no wall is near, s."""
MASS = 4.0 / 3.0 * np.pi * R**3 * RHO
STILL = analytic.shear_over_wall(0.0)
SLOPE = np.array([0.6, 0.0, -0.8])
STIFF = 1e5
"""Shear modulus, Pa: strains of 1e-5 and less."""


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
    """Of a sphere along and across a wall, by Faxén and by Schäffer et al., over that without."""
    along = 1 - 9 * e / 16 + e**3 / 8 - 45 * e**4 / 256 - e**5 / 16
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


@pytest.mark.parametrize(
    ("number", "place", "speed"), [(0.1, 3e-5, 3e-4), (1.0, 3e-4, 2e-3), (10.0, 2e-3, 0.03)]
)
def test_a_sphere_falls_onto_a_slope_as_its_equation_of_motion_says(number, place, speed):
    """From rest at 4R to a gap of 0.1R, with steps of the default tolerance; the faster, the fewer."""
    g = weight(number) * SLOPE
    end, expected = fallen(4.0, g, lowest=1.1)
    p = carried(bodies(4.0), g, end / 20, 20)
    assert state(p)[:2] == pytest.approx(expected[:2], abs=place * R)
    assert state(p)[2:] == pytest.approx(expected[2:], rel=speed)


def test_it_does_so_with_order_three():
    g = weight(1.0) * SLOPE
    end, expected = fallen(2.0, g, lowest=1.35)
    errors = [
        abs(state(carried(bodies(2.0), g, end / n, n, tolerance=np.inf)) - expected)[:2].max() / R
        for n in (4, 8, 16)
    ]
    print(errors)
    assert errors[-1] < 1e-4
    assert np.log2(errors[0] / errors[1]) > 2.5
    assert np.log2(errors[1] / errors[2]) > 2.7


def test_steps_may_be_long_against_the_time_in_which_drag_stops_it():
    """St of 1e-4, in 20 steps of 2700 τ from 3R to a gap of 0.2R; with strain off they stay so long."""
    g = weight(1e-4) * SLOPE
    end, expected = fallen(3.0, g, lowest=1.2)
    assert end > 20 * 2000.0 * TAU
    model = WallLift(cutOff=1000.0, strain=False)
    errors = []
    for n in (20, 40):
        p = carried(bodies(3.0), g, end / n, n, model=model, tolerance=np.inf)
        assert state(p)[2:] == pytest.approx(expected[2:], rel=0.02)
        errors.append(abs(state(p) - expected)[:2].max() / R)
    print(errors)
    assert errors[0] < 2e-4
    assert np.log2(errors[0] / errors[1]) > 2.2


def test_with_little_inertia_it_goes_as_without():
    """St of 1e-3, and steps of 27 τ: place to 2e-4 R, which is what those of stokes have as their error."""
    g = weight(1e-3) * SLOPE
    end, expected = fallen(3.0, g, lowest=1.3)
    p, q = (carried(bodies(3.0), g, end / 200, 200, integrator=name) for name in ("rosenbrock", "stokes"))
    print(state(p) / R, state(q) / R, expected / R)
    assert state(p)[:2] == pytest.approx(expected[:2], abs=3e-5 * R)
    assert state(p) == pytest.approx(state(q), rel=4e-3, abs=1e-3 * R)


def tilted_spheroid(h, mu, ratio=2.0):
    """One whose axis leaves the plane of the slope, with its Q, semi-axes and resistances."""
    p = bodies(h, mu)
    axis = np.array([0.6, 0.48, 0.64])
    others = np.linalg.svd(axis[None])[2][1:]
    Q = np.stack([axis, *others])
    axes = np.array([ratio, 1.0, 1.0]) / np.cbrt(ratio)
    p.F[0] = (Q.T @ np.diag(axes) @ Q).ravel()
    p.M[0] = np.linalg.inv(Q.T @ np.diag(axes**2) @ Q).ravel()
    return p, Q, axes


def drag_of(Q, axes, h):
    """Its hindered resistance, (3, 3), m."""
    n = Q @ [0.0, 0.0, 1.0]
    k = tuple(R * np.array(oberbeck(tuple(axes), integrals(tuple(axes)))))
    gap = (h - np.linalg.norm(axes * n)) * R
    K = np.reshape(hindered_resistance(k, hindrance(k, tuple(n), h * R, gap)), (3, 3))
    return Q.T @ K @ Q
