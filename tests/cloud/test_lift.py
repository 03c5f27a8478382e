"""Bodies that settle along a shear flow, and neutral ones in ducts, with the lift by inertia of the fluid."""

from __future__ import annotations

import math
from dataclasses import replace
from types import FunctionType

import numpy as np
import pytest

from foamprb.body.lift import PIPE, PLANE_CHANNEL, balances, lift_coefficient
from foamprb.body.wall import normal_mobility, parallel_mobility
from foamprb.cloud.block import ROWS, Medium, at
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import DuctLift, Gravity, RectangularDuctLift, coefficients, compose, forces_on
from foamprb.cloud.layout import LANES
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

R, RATE, RHO, MU, LOAD = 25e-6, 1000.0, 1000.0, 1e-3, 9.0 * 1e-3 * 1e-3 / (2.0 * 25e-6**2)
"""LOAD is the weight less buoyancy by which a sphere settles at 1 mm/s, N/m³."""
HEIGHT = 1e-4
CHANNEL = DuctLift(
    shape="channel", origin=(0.0, 0.0, HEIGHT / 2), direction=(0.0, 0.0, -2.0), size=HEIGHT / 2, shearRate=6e4
)
LEAST = replace(CHANNEL, shearRate=0.0)
AROUND = (WallLift(strain=False), SaffmanMeiLift())
"""With :data:`LEAST`, or far from the wall, in the loop that is compiled for all."""


def advance(integrator="stokes", dt=1e-9, steps=1, rho=1e-6, rate=RATE, height=50.0, rho_f=RHO, mu=1e5):
    """Return the slip of a sphere that settles along a shear flow, m/s; ``height`` over the wall in radii."""
    # Without inertia of the body: light, in a strong field of gravity.
    p = spheres([(0.0, 0.0, height * R)], d=2.0 * R, rho=rho, mu=mu, poissons_ratio=0.4999)
    p.v[:, 0] = rate * height * R
    water = Medium(MU, rho_f, (-LOAD / (rho_f - rho), 0.0, 0.0))
    models = Models(integrator=integrator, forces=(Gravity(), LEAST), surroundings=AROUND)
    Cloud(p, analytic.shear_over_wall(rate), water, [Rebound()], dt, models, threads=1).advance(steps)
    return p.v[0] - (rate * p.x[0, 2], 0.0, 0.0)


def test_a_sphere_with_inertia_comes_to_the_same_slip():
    """Also in steps of 14 times its relaxation time, and where the lift is as large as the drag.

    Inertia changes it by a share γ̇ τ = 1e-3 of the slip.
    """
    for rate in (RATE, 1e4):
        v, w = (advance(integrator=i, dt=2e-6, steps=5, rho=1.0, rate=rate) for i in ("rosenbrock", "stokes"))
        np.testing.assert_allclose(v, w, atol=1.5e-6)


@pytest.mark.parametrize("h", [2.0, 1.1])
def test_a_wall_hinders_the_slip_and_the_drift_by_it(h):
    """Drag hindered along and across the wall balances weight and lift, with and without inertia.

    In a fluid that is nearly without mass there is no lift.
    """
    speeds = [
        advance(integrator, dt, steps, rho, height=h, rho_f=rho_f, mu=1e7)
        for integrator, dt, steps, rho in (("stokes", 1e-9, 1, 1e-6), ("rosenbrock", 2e-6, 6, 1.0))
        for rho_f in (1e-9, RHO)
    ]
    along, across = (m(1.0 / h) / (6.0 * math.pi * MU * R) for m in (parallel_mobility, normal_mobility))
    load = 6.0 * math.pi * MU * R * 1e-3
    w = np.array([along * load, 0.0])
    for _ in range(20):
        L = lift_coefficient(np.hypot(*w), RATE, R, RHO, MU) * RATE
        w = np.array([along * (load + L * w[1]), -across * L * w[0]])
    for without, lifted in (speeds[:2], speeds[2:]):
        np.testing.assert_allclose((lifted - without)[2], w[1], rtol=2e-3)
        np.testing.assert_allclose((lifted - without)[0], w[0] - along * load, rtol=0.15)


def force_at(lift, x, radius=R, rho=1500.0):
    """Return the force of a lift on a sphere, N, as the integrators add it up."""
    block = np.zeros(ROWS * LANES)
    block[at.rho * LANES], block[at.R * LANES] = rho, radius
    for k in range(3):
        block[(at.x + k) * LANES] = x[k]
    medium = Medium(MU, RHO, (0.0, 0.0, 0.0), coefficients((lift,)))
    bound = FunctionType(forces_on.__code__, forces_on.__globals__ | {"sum_of_forces": compose((lift,))})
    steady, push, inertia = bound(block, 0, medium, 1.0, (0.0, 0.0, 0.0))
    assert steady == push
    assert inertia == 1.0
    return np.array(push) * 4.0 / 3.0 * math.pi * radius**3 * rho


def test_lift_in_a_channel_goes_away_from_the_middle():
    """C = 0.24613 at s = 0.2."""
    radius = 3e-6
    expected = 0.24613 * RHO * 6e4**2 * radius**4
    for sign in (1.0, -1.0):
        found = force_at(CHANNEL, (5.0, 7.0, HEIGHT / 2 * (1.0 + 0.2 * sign)), radius)
        np.testing.assert_allclose(found, (0.0, 0.0, sign * expected), rtol=1e-9)
    assert not force_at(CHANNEL, (5.0, 7.0, HEIGHT / 2)).any()


def test_a_neutral_sphere_drifts_by_the_lift_in_a_channel():
    """Along the vorticity, where no lift by the slip acts, and far from the wall of the flow."""
    x, duct = (0.0, 0.1 * HEIGHT, 1e-2), replace(CHANNEL, origin=(0.0, 0.0, 0.0), direction=(0.0, -2.0, 0.0))
    p = spheres([x], d=6e-6, rho=RHO, mu=1e5, poissons_ratio=0.4999)
    models = Models(integrator="stokes", forces=(Gravity(), duct), surroundings=AROUND)
    medium = Medium(MU, RHO, (9.81, 0.0, 0.0))
    Cloud(p, analytic.shear_over_wall(RATE), medium, [Rebound()], 1e-6, models, threads=1).advance(1)
    speed = force_at(duct, x, 3e-6)[1] / (6.0 * math.pi * MU * 3e-6)
    slip = p.v[0] - (RATE * p.x[0, 2], 0.0, 0.0)
    np.testing.assert_allclose(slip, (0.0, speed, 0.0), rtol=2e-4, atol=1e-6 * speed)


def test_neutral_particles_gather_at_six_tenths():
    assert balances(PLANE_CHANNEL) == pytest.approx([0.6346], abs=5e-4)
    assert "C = 0 at 0.634" in str(CHANNEL)
    assert balances(PIPE) == pytest.approx([0.693], abs=0.003)
    assert "C = 0 at 0.69" in str(replace(CHANNEL, shape="pipe"))


def test_lift_in_a_pipe_follows_the_given_table():
    """C ρ_f γ̇² R⁴ from the axis outwards: 0.3 half-way between 0.2 and 0.4, −1 beyond the last point."""
    table = ((0.0, 0.0), (0.5, 0.2), (0.6, 0.4), (0.9, -1.0))
    pipe = DuctLift(
        shape="pipe",
        origin=(1.0, 2.0, 3.0),
        direction=(0.0, 0.0, 5.0),
        size=1e-4,
        shearRate=RATE,
        table=table,
    )
    unit = RHO * RATE**2 * R**4
    across = np.array((0.6, 0.8, 0.0))
    for s, C in ((0.55, 0.3), (0.95, -1.0)):
        found = force_at(pipe, np.array((1.0, 2.0, 9.0)) + s * 1e-4 * across)
        np.testing.assert_allclose(found, C * unit * across, rtol=1e-9, atol=1e-12 * unit)
    assert balances(table) == pytest.approx([0.6 + 0.3 * 0.4 / 1.4])


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"direction": (0.0, 0.0, 0.0)}, "has a direction of length 0"),
        ({"table": ((0.0, 0.0),)}, "needs a table of 2 to 50 pairs"),
        ({"table": ((0.0, 0.0), (0.5, 1.0), (0.5, 2.0))}, "increasing"),
    ],
)
def test_wrong_ducts_are_refused(entries, message):
    given = {name: getattr(CHANNEL, name) for name in ("shape", "origin", "direction", "size", "shearRate")}
    with pytest.raises(InputError, match=message):
        DuctLift(**{**given, **entries})


RECTANGLE = RectangularDuctLift(
    origin=(1.0, 2.0, 3.0), axis=(0.0, 2.0, 0.0), direction=(0.0, 0.0, 5.0), size=HEIGHT / 2, shearRate=6e4,
    aspectRatio=2.0,
)  # fmt: skip


def test_lift_in_a_rectangular_duct_has_both_components():
    """Against the quadrature in tools/validation: C_x and C_z in a duct of 2:1 at s = 0.4, t = 0.3."""
    radius = 3e-6
    unit = RHO * 6e4**2 * radius**4
    for a, b in ((1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)):
        x = np.array((1.0, 7.0, 3.0)) + HEIGHT * np.array((0.4 * a, 0.0, 0.15 * b))
        expected = unit * np.array((0.0531 * a, 0.0, 0.2549 * b))
        np.testing.assert_allclose(force_at(RECTANGLE, x, radius), expected, atol=3e-3 * unit)
    assert not force_at(RECTANGLE, (1.0, 7.0, 3.0)).any()


def test_a_square_duct_has_four_places_in_the_middle_of_its_sides():
    """0.354 of the width from the centre; the places on the diagonals, at 0.295, are unstable."""
    square = replace(RECTANGLE, aspectRatio=1.0)

    def force(y, z):
        return force_at(square, np.array((1.0, 2.0, 3.0)) + HEIGHT * np.array((y, 0.0, z)))

    assert force(0.0, 0.351)[2] > 0.0 > force(0.0, 0.356)[2]
    assert force(0.01, 0.354)[0] < 0.0
    x, _, z = force(0.291, 0.291)
    assert x == pytest.approx(z, abs=2e-3 * RHO * 6e4**2 * R**4)
    assert x > 0.0 > force(0.301, 0.301)[0]
    assert force(0.31, 0.29)[0] > force(0.31, 0.29)[2]


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"aspectRatio": 3.0}, "aspectRatio 3. Allowed: 1, 2, 4"),
        ({"axis": (0.0, 1.0, 0.1)}, "a direction at a right angle"),
        ({"direction": (0.0, 0.0, 0.0)}, "needs an axis"),
    ],
)
def test_wrong_rectangles_are_refused(entries, message):
    with pytest.raises(InputError, match=message):
        replace(RECTANGLE, **entries)
