"""Bounces of particles off walls, and their records."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.contact import rebounds_of
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models

RADIUS, D, SPEED = 2.1e-3, 5e-6, 0.05
NEARLY_NOTHING = Medium(1e-11, 1e-9, (0.0, 0.0, 0.0))
NOTED = Models(integrator="paper", rebounds=True)


def falling(start, models=NOTED, v=(0.02, -SPEED, 0.0), e=0.8, mu=0.1, **options):
    """Heavy stiff spheres in free flight, that far above the bottom of a pipe, m."""
    start = np.atleast_1d(start)
    x = np.stack([np.full(start.shape, 0.1), start - RADIUS, np.zeros(start.shape)], axis=1)
    p = spheres(x, d=D, rho=2560.0, mu=10.0)
    p.v[:] = v
    walls = (Rebound(e, mu), Escape(), Escape())
    return Cloud(p, analytic.pipe(RADIUS, 0.0, 1.0), NEARLY_NOTHING, walls, 1e-5, models, **options)


def many():
    """Spheres that bounce once, each at its own time."""
    return falling(D * np.linspace(1.0, 60.0, 70), v=(0.0, -0.4, 0.0), e=1.0, mu=0.0)


@pytest.mark.parametrize("touching", ["ellipsoid", "centre"])
def test_free_flight_between_two_walls(touching):
    """From 4 diameters above the bottom to it, and across the pipe to the top."""
    models = Models(touching=touching, integrator="paper", rebounds=True)
    reach = D / 2 if touching == "ellipsoid" else 0.0
    cloud = falling(4 * D, models, v=(0.02, -SPEED, 0.0))
    first = (4 * D - reach) / SPEED
    second = first + 2.0 * (RADIUS - reach) / (0.8 * SPEED)
    cloud.advance(round(1.05 * second / cloud.dt))
    found = rebounds_of(cloud.take_rebounds())
    np.testing.assert_array_equal(found.number, 0)
    np.testing.assert_array_equal(found.patch, 0)
    np.testing.assert_allclose(found.t, [first, second], rtol=4e-4)
    away = RADIUS - reach
    np.testing.assert_allclose(found.x[:, 1], [-away, away], rtol=1e-6)
    x = [0.1 + 0.02 * first, 0.1 + 0.02 * first + 0.018 * (second - first)]
    np.testing.assert_allclose(found.x[:, 0], x, rtol=1e-6)
    v = [[0.02, -SPEED, 0.0], [0.018, 0.8 * SPEED, 0.0]]
    np.testing.assert_allclose(found.v, v, rtol=2e-3, atol=1e-8)
    np.testing.assert_allclose(found.n, [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]], atol=1e-9)
    np.testing.assert_allclose(found.F, np.tile(np.eye(3).ravel(), (2, 1)), atol=1e-6)
    assert len(cloud.take_rebounds()) == 0


@pytest.mark.parametrize("touching", ["ellipsoid", "centre"])
@pytest.mark.parametrize(("integrator", "tolerance"), [("paper", 3e-3), ("rosenbrock", 1e-4)])
@pytest.mark.parametrize("per_fall", [12, 49])
def test_a_bouncing_body_keeps_its_energy(integrator, tolerance, touching, per_fall):
    """Four bounces with e = 1 in free fall: the body is above the wall by its first height after each."""
    g, height = 9.81, 200 * D
    reach = D / 2 if touching == "ellipsoid" else 0.0
    fall = np.sqrt(2.0 * height / g)
    p = spheres([[0.1, height + reach - RADIUS, 0.0]], d=D, rho=2560.0, mu=10.0)
    p.v[:] = 0.0
    models = Models(integrator=integrator, touching=touching, rebounds=True)
    vacuum, walls = Medium(1e-12, 1e-9, (0.0, -g, 0.0)), (Rebound(1.0, 0.0), Escape(), Escape())
    cloud = Cloud(p, analytic.pipe(RADIUS, 0.0, 1.0), vacuum, walls, fall / per_fall / 1.013, models)
    highest = []
    while cloud.time < 9.0 * fall:
        cloud.advance(1)
        highest.append((p.x[0, 1] + RADIUS - reach) / height)
    found = rebounds_of(cloud.take_rebounds())
    np.testing.assert_allclose(np.diff(found.t[:4]), 2.0 * fall, rtol=tolerance)
    np.testing.assert_allclose(found.v[:4, 1] ** 2, 2.0 * g * height, rtol=tolerance * 2)
    # A fall is seen at steps only.
    assert 1.0 - per_fall**-2.0 < max(highest[-2 * per_fall :]) < 1.0 + tolerance


def test_a_body_comes_to_rest_after_ever_lower_bounces():
    """With e = 1/2 in free fall, bounces end after three times the first fall."""
    g, height = 9.81, 20 * D
    # So stiff that its weight does not flatten it.
    p = spheres([[0.1, height + D / 2 - RADIUS, 0.0]], d=D, rho=2560.0, mu=1e9)
    p.v[:] = 0.0
    vacuum, walls = Medium(1e-12, 1e-9, (0.0, -g, 0.0)), (Rebound(0.5, 0.0), Escape(), Escape())
    flow, fall = analytic.pipe(RADIUS, 0.0, 1.0), np.sqrt(2.0 * height / g)
    models = Models(integrator="rosenbrock", rebounds=True)
    cloud = Cloud(p, flow, vacuum, walls, fall / 10.0, models)
    cloud.advance(40)
    found = rebounds_of(cloud.take_rebounds())
    np.testing.assert_allclose(found.t[:4] / fall, [1.0, 2.0, 2.5, 2.75], rtol=1e-4)
    assert p.v[0, 1] == pytest.approx(0.0, abs=1e-12)
    assert p.x[0, 1] == pytest.approx(D / 2 - RADIUS, abs=1e-6 * D)


def test_the_same_by_any_number_of_threads_and_calls():
    """Also where the room for them is too small, so that blocks are taken again."""
    whole = many()
    whole.advance(300)
    expected = whole.take_rebounds()
    assert len(expected) == 70
    assert (np.diff(expected[:, 2]) >= 0.0).all()
    for threads, calls in ((2, (300,)), (1, (1, 99, 200)), (2, (150, 150))):
        cloud = many()
        cloud.threads = threads
        cloud.tracker._room = 3
        for steps in calls:
            cloud.advance(steps)
        np.testing.assert_array_equal(cloud.take_rebounds(), expected)
        np.testing.assert_array_equal(cloud.particles.x, whole.particles.x)


def test_no_rebound_is_recorded_twice_after_a_stop():
    whole = many()
    whole.advance(300)
    cloud = many()
    asked = itertools.count()
    while cloud.step < 300:
        # Every other call is stopped at once.
        begun = next(asked)
        Stepper(cloud).advance(min(40, 300 - cloud.step), lambda begun=begun: begun % 2 == 0)
        assert begun < 100
    np.testing.assert_array_equal(cloud.take_rebounds(), whole.take_rebounds())


def test_a_stop_counts_though_there_is_no_room():
    """Else a run that stops would go on until there is."""
    cloud = many()
    cloud.tracker._room = 1
    # All bodies bounce at the bottom in these steps.
    Stepper(cloud).advance(300, lambda: True)
    assert cloud.step == 0
    room = cloud.tracker._room
    assert room in (1, 4)
    cloud.advance(300)
    whole = many()
    whole.advance(300)
    np.testing.assert_array_equal(cloud.take_rebounds(), whole.take_rebounds())


def test_rebounds_are_recorded_on_request_only():
    # It meets the wall in the middle of a step.
    cloud = falling(2.25 * D, Models(integrator="paper"))
    cloud.advance(60)
    assert cloud.particles.v[0, 1] == pytest.approx(0.8 * SPEED, rel=2e-3)
    assert len(cloud.take_rebounds()) == 0


def test_a_body_that_stays_in_touch_bounced_when_it_came():
    """Without restitution it slides along the wall."""
    air = Medium(1.8e-5, 1.2, (0.0, -9.81, 0.0))
    p = spheres([[0.05, -RADIUS + 0.6 * D, 0.0]], d=D, rho=2560.0, mu=1.0)
    flow, walls = analytic.pipe(RADIUS, 0.485, 1.0), (Rebound(0.0, 0.0), Escape(), Escape())
    cloud = Cloud(p, flow, air, walls, 2e-5, Models(integrator="stokes", rebounds=True))
    cloud.advance(3000)
    assert p.status[0] == Status.ACTIVE
    found = rebounds_of(cloud.take_rebounds())
    assert len(found.t) == 1
    assert 0.0 < found.t[0] < 0.01


def test_a_ball_whose_step_ends_on_the_wall_bounces():
    """To a ten millionth of its radius, in the hundredth step; it flies up for the next fifty."""
    cloud = falling(D / 2 + 100 * 1e-5 * SPEED + 1e-7 * D, v=(0.0, -SPEED, 0.0), e=1.0, mu=0.0)
    cloud.advance(150)
    height = RADIUS + cloud.particles.x[0, 1] - D / 2
    assert height == pytest.approx(50 * 1e-5 * SPEED, rel=1e-3)


def test_sticking_particles_do_not_rebound():
    p = spheres([[0.05, -RADIUS + 2 * D, 0.0]], d=D, rho=2560.0, mu=10.0)
    p.v[:] = (0.0, -SPEED, 0.0)
    walls = (Stick(), Escape(), Escape())
    cloud = Cloud(p, analytic.pipe(RADIUS, 0.0, 1.0), NEARLY_NOTHING, walls, 1e-5, NOTED)
    cloud.advance(60)
    assert p.status[0] == Status.STUCK
    assert len(cloud.take_rebounds()) == 0
