"""Which particle is in which lane: what it goes through is its own."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from small_clouds import assert_same

from foamprb.cloud.block import ROWS, SHELF, Medium, idle_lanes, new_scratch
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.lanes import ENDED, READY, begin_lanes, drop_unfinished, set_aside, take_back
from foamprb.cloud.layout import LANES
from foamprb.cloud.limits import Limits
from foamprb.cloud.patches import Mirror, Rebound
from foamprb.cloud.state import Particles, set_rest_shape, spheres
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models

ADAPTIVE = ("rosenbrock", "stokes")
N = 240
AROUND = WallLift(strain=False), BrownianMotion(T=1e13, shape=False)
LABELS = ("member", "status", "reason", "patch", "host", "step", "number", "mended")


def in_vortex(flow, integrator, rows=slice(None), models=()):
    """Bodies of all sizes and softness with surface tension sink in a vortex and bounce off its walls.

    Some come later, some are ellipsoids at rest, some are stretched too far. The floor mirrors them.
    """
    random = np.random.default_rng(7)
    x, t0 = 0.05 + 0.9 * random.random((N, 3)), random.choice([0.0, 0.05, 0.13], N)
    mu = 0.011 * np.pi / 10.0 ** random.uniform(-2.0, -0.4, N)
    d, gamma = random.uniform(0.01, 0.03, N), random.uniform(0.0, 4e-3, N)
    p = spheres(x, d=d, rho=30.0, mu=mu, gamma=gamma, t0=t0)
    ratios = np.where(np.arange(N)[:, None] % 4 == 0, random.uniform(0.8, 1.2, (N, 3)), 1.0)
    set_rest_shape(p, ratios, Rotation.random(N, random_state=7).as_matrix())
    p.v[:], _ = flow.sample(x, flow.locate(x), 0.0)
    chosen = Models(integrator=integrator, surroundings=models, rebounds=True, stride=4)
    medium = Medium(0.011, 1.0, (0.0, -7.0, -7.0))
    walls = [Mirror() if patch.name == "floor" else Rebound() for patch in flow.patches]
    limits = Limits(maxStretch=1.3)
    cloud = Cloud(p, flow, medium, walls, 0.02, chosen, threads=1, limits=limits)
    cloud.particles = p.take(np.arange(N)[rows])
    return cloud


def go(cloud):
    """Through 20 steps. Those that move share blocks from the second call on."""
    Stepper(cloud).advance(4)
    Stepper(cloud).advance(16)


def scratch():
    """With numbers of no meaning in all lanes, each of them another."""
    kept = INTEGRATORS["rosenbrock"].layout
    s = new_scratch(kept, room=20)
    begin_lanes(s, 1.0)
    s.block[:] = np.arange(len(s.block))
    for n, name in enumerate(LABELS):
        getattr(s, name)[:] = 100 * n + np.arange(LANES)
    return s


@pytest.mark.parametrize(
    ("integrator", "models"), [("rosenbrock", ()), ("stokes", AROUND)], ids=["rosenbrock", "surroundings"]
)
def test_a_particle_goes_the_same_way_whoever_is_in_the_other_lanes(
    coarse_vortex, integrator, models, monkeypatch
):
    """Whether it is set aside or alone."""
    seen, places = [], SHELF // 2

    def new_scratch_to_see(*args):
        made = new_scratch(*args)
        made.labels[:] = -1
        seen.append(made.labels)
        return made

    with monkeypatch.context() as patch:
        patch.setattr("foamprb.cloud.tracker.new_scratch", new_scratch_to_see)
        cloud = in_vortex(coarse_vortex, integrator, models=models)
        go(cloud)
    p, rebounds = cloud.particles, cloud.take_rebounds()
    aside = np.max([(labels[:, 0].reshape(2, places) >= 0).sum(1) for labels in seen], axis=0)
    for k in range(0, N, 12):
        alone = in_vortex(coarse_vortex, integrator, slice(k, k + 1), models)
        go(alone)
        assert_same(p, alone.particles, slice(k, k + 1))
    # What is put on a shelf that is full would be written beyond its end.
    assert aside.max() <= places // 2
    # Else this would say little.
    assert len(rebounds) > 5
    assert p.substeps.max() > 2.0 * p.substeps.min()
    assert aside[ENDED] == (LANES if integrator == "stokes" else 0)


def test_a_call_that_is_stopped_leaves_each_particle_at_its_begin_or_end(coarse_vortex):
    """And the same steps, taken again by those, take all to the state of a run that was not stopped."""
    whole, cloud = (in_vortex(coarse_vortex, "rosenbrock") for _ in range(2))
    for each in (whole, cloud):
        Stepper(each).advance(4)
        each.take_rebounds()
    begun = Particles(*(array.copy() for array in whole.particles))
    Stepper(whole).advance(16)
    # So that calls end for want of it, each time a little later.
    cloud.tracker._room = 1
    seen = []

    def watch():
        seen.append(Particles(*(array.copy() for array in cloud.particles)))
        return False

    Stepper(cloud).advance(16, watch)
    while cloud.step < 20:
        seen.append(Particles(*(array.copy() for array in cloud.particles)))
        Stepper(cloud).advance(20 - cloud.step, watch)
    assert_same(whole.particles, cloud.particles)
    np.testing.assert_array_equal(whole.take_rebounds(), cloud.take_rebounds())
    for p in seen:
        for k in range(N):
            assert any(
                np.array_equal(p.F[k], q.F[k]) and np.array_equal(p.x[k], q.x[k])
                for q in (begun, whole.particles)
            )


def test_what_is_put_aside_comes_back_in_any_lane():
    s = scratch()
    before = s.block.reshape(-1, LANES).copy()
    labels = {name: getattr(s, name).copy() for name in LABELS}
    for lane, kind in ((3, READY), (0, ENDED), (5, ENDED), (7, READY)):
        set_aside(s, lane, kind)
        assert s.member[lane] == -1
    s.block[:] = np.nan
    after = s.block.reshape(-1, LANES)
    for lane, kind, was in ((9, ENDED, 5), (2, READY, 7), (3, READY, 3), (1, ENDED, 0)):
        take_back(s, lane, kind)
        np.testing.assert_array_equal(after[s.lasting, lane], before[s.lasting, was])
        for name in LABELS:
            assert getattr(s, name)[lane] == labels[name][was]
    assert not s.counts[:2].any()


def test_rebounds_of_the_unfinished_do_not_count():
    s = scratch()
    s.member[:] = -1
    s.member[2], s.number[2] = 0, 11
    for lane, kind, number in ((4, READY, 12), (5, ENDED, 13), (6, ENDED, 14)):
        s.number[lane] = number
        set_aside(s, lane, kind)
    numbers = [10, 11, 12, 20, 13, 14, 21, 11]
    s.rebounds[: len(numbers), 0] = numbers
    s.rebounds[: len(numbers), 1:] = np.arange(len(numbers))[:, None]
    # Of the first two it was known before.
    s.noted[0], s.noted[1] = len(numbers), 2
    drop_unfinished(s)
    assert list(s.noted) == [4, 4]
    np.testing.assert_array_equal(s.rebounds[:4, 0], [10, 11, 20, 21])
    np.testing.assert_array_equal(s.rebounds[:4, 20], [0, 1, 3, 6])


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_what_loading_leaves_alone_is_empty_in_a_lane_that_is_used_again(integrator):
    own = INTEGRATORS[integrator].layout
    block = np.full(own.rows * LANES, np.nan)
    idle_lanes(block, own.initial, 1.0)
    left = own.lasting[len(own.lasting) - len(own.fresh) :]
    assert len(left) > 0
    np.testing.assert_array_equal(block.reshape(-1, LANES)[left], np.tile(own.fresh, (LANES, 1)).T)
    assert len(set(own.lasting)) == len(own.lasting)
    assert max(own.lasting) >= ROWS
