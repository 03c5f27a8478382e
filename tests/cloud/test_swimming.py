"""Swimmers in the loop: how far they come, walls, mirrors, and numbers that depend on nothing else."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest

from foamprb.cloud.block import Medium, at, idle_lanes, load3, load9, new_block, store3, store9
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.layout import LANES, layout, offsets
from foamprb.cloud.measures import context, measure, swimming_direction
from foamprb.cloud.motion import turn_along
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import drops, set_rest_shape, spheres
from foamprb.cloud.surroundings import swimming
from foamprb.cloud.surroundings.base import Survey
from foamprb.cloud.surroundings.dispersion import StochasticDispersion
from foamprb.cloud.surroundings.registry import compose
from foamprb.cloud.surroundings.swimming import SwimmerRows, Swimming
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

R, V, D_R, DT = 0.5e-6, 20e-6, 1.5, 5e-3
WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
UP = (0.0, 0.0, 1.0)


def cloud_of(p, rate=0.0, threads=1, **entries):
    models = Models(integrator="stokes", surroundings=(Swimming(**({"speed": V} | entries)),))
    return Cloud(p, analytic.shear_over_wall(rate), WATER, [Rebound()], DT, models, threads=threads)


def bodies(n, height=1.0):
    return spheres(np.tile([0.0, 0.0, height], (n, 1)), d=2 * R, rho=1000.0, mu=1e4, poissons_ratio=0.4999)


def test_a_swimmer_turns_in_shear_and_leaves_walls():
    """Half the vorticity for a sphere; a spheroid has its direction along its axis; a wall mirrors it."""
    p = bodies(3)
    p.x[2] = (0.0, 0.0, R + 3.5 * V * DT)
    set_rest_shape(p, np.array([(1.0, 1.0, 1.0), (1.0, 1.0, 4.0), (1.0, 1.0, 4.0)]))
    p.F[2] = p.F0[2] = np.eye(3).ravel()
    cloud = cloud_of(p, rate=2.0, direction=(0.0, 0.0, 5.0))
    p.heading[2] = (0.6, 0.0, -0.8)
    cloud.advance(4)
    d = measure(context(p, cloud.flow, 1e-3, cloud.time))["swimmingDirection"]
    angle = 4 * DT
    np.testing.assert_allclose(d[0], (np.sin(angle), 0.0, np.cos(angle)), atol=1e-6)
    F = p.F[1].reshape(3, 3)
    np.testing.assert_allclose(d[1], F[:, 2] / np.linalg.norm(F[:, 2]), atol=1e-12)
    assert d[1, 0] / d[1, 2] == pytest.approx(2.0 * 16.0 / 17.0 * angle, rel=1e-3)
    assert p.x[0, 2] - 1.0 == pytest.approx(V * np.sin(angle), rel=1e-4)
    before = d[2, 2]
    cloud.advance(4)
    after = swimming_direction(p)[2]
    assert before < 0.0 < after[2]
    assert p.x[2, 2] > R
    np.testing.assert_allclose(np.linalg.det(p.F[2].reshape(3, 3)), 1.0, atol=1e-9)


@pytest.fixture
def lane():
    """A block whose lane 3 swims along (0.6 0 −0.8), with a deformed body."""
    rows = offsets(SwimmerRows)
    own = layout(at, rows)
    block = new_block(own.rows)
    idle_lanes(block, own.initial, DT)
    F = np.diag([1.25, 1.0, 0.8])
    store9(block, at.F, 3, tuple(F.ravel()))
    store9(block, at.new_F, 3, tuple(F.ravel()))
    store3(block, rows.heading, 3, tuple(np.linalg.solve(F, (0.6, 0.0, -0.8))))
    return SimpleNamespace(block=block, rows=rows)


def test_swimming_adds_velocity_and_spin(lane):
    store3(lane.block, lane.rows.tumble, 3, (1.0, 2.0, 3.0))
    swimming.swim(lane.block, WATER, 0.0, (2.0, 0.0, np.uint64(1)))
    assert load3(lane.block, at.u, 3) == pytest.approx((1.2, 0.0, -1.6))
    spin = np.array(load9(lane.block, at.l, 3)).reshape(3, 3)
    np.testing.assert_allclose(spin @ (1.0, 0.0, 0.0), np.cross((1.0, 2.0, 3.0), (1.0, 0.0, 0.0)))
    assert not lane.block[at.u * LANES : at.u * LANES + 3].any()


def test_a_wall_mirrors_the_swimmer_that_swims_into_it(lane):
    swimming.leave_wall(lane.block, 3, (0.0, 0.0, -1.0))
    assert not lane.block[at.renewed * LANES + 3]
    swimming.leave_wall(lane.block, 3, UP)
    F, q = load9(lane.block, at.F, 3), load3(lane.block, lane.rows.heading, 3)
    assert swimming.direction(F, q) == pytest.approx((0.6, 0.0, 0.8))
    assert lane.block[at.renewed * LANES + 3] == lane.block[at.mirrored * LANES + 3] == 1.0


def test_a_rotated_body_keeps_its_heading(lane):
    q = load3(lane.block, lane.rows.heading, 3)
    swimming.turn_heading(lane.block, 3, (0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0))
    assert load3(lane.block, lane.rows.heading, 3) == q


def test_models_together_all_turn_with_the_body():
    """Eddies and swimming bind the same function: both are called."""
    both = compose([StochasticDispersion(), Swimming(speed=V)], (), False).slots[turn_along]
    called = {f.__name__ for name, f in both.__globals__.items() if re.fullmatch(r"f\d", name)}
    assert called == {"turn_eddy", "turn_heading"}


def test_entries_are_logged_and_bad_ones_refused():
    assert str(Swimming(speed=1.0, direction=(1.0, 0.0, 0.5))).startswith(
        "(speed 1, rotationalDiffusivity 0, direction (1 0 0.5)"
    )
    with pytest.raises(InputError, match="has a direction of length 0"):
        Swimming(speed=V, direction=(0.0, 0.0, 0.0))
    (warning,) = (
        Swimming(speed=V, rotationalDiffusivity=100.0).remarks(Survey(bodies(1), None, WATER, 1e-3)).warnings
    )
    assert "Use deltaT < 0.0002" in warning
    p = drops(np.zeros((1, 3)), d=2 * R, rho=1000.0, gamma=1e-3, eta=1e-3)
    models = Models(material="drop", surroundings=(Swimming(speed=V),))
    with pytest.raises(InputError, match="swimming holds for solids, not for drops"):
        Cloud(p, analytic.shear(1.0), WATER, [], DT, models)
