"""Drops after Maffettone and Minale: breakup; `tools/validation/drops.py` has their shapes and settling."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, explain
from foamprb.cloud.measures import context, measure
from foamprb.cloud.state import Reason, Status, drops, set_rest_shape, spheres
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.errors import FailedParticlesWarning, InputError

MU, RATE, R = 1e-3, 100.0, 5e-6


def test_a_drop_breaks_up():
    p = drops(np.zeros((2, 3)), d=2 * R, rho=1e3, gamma=MU * RATE * R / np.array([3.0, 0.1]), eta=MU)
    cloud = cloud_of(p)
    assert cloud.models.integrator == "stokes"
    with pytest.warns(FailedParticlesWarning, match="stretched"):
        cloud.advance(1000)
    assert (p.status[0], p.reason[0]) == (Status.FAILED, Reason.STRETCHED)
    assert p.status[1] == Status.ACTIVE
    assert "breaks up" in explain(p.reason[0], cloud.models, cloud.limits)
    assert measure(context(p, cloud.flow, MU, cloud.time))["capillaryNumber"][1] == pytest.approx(0.1)


def cloud_of(p, **models):
    medium = Medium(MU, 1000.0, (0.0, 0.0, 0.0))
    return Cloud(p, analytic.shear(RATE), medium, [], 1e-3, Models(**({"material": "drop"} | models)))


def test_what_drops_exclude_is_refused():
    x = np.zeros((1, 3))
    drop = drops(x, d=2 * R, rho=1e3, gamma=1e-3, eta=MU)
    with pytest.raises(InputError, match="needs the integrator stokes, not rosenbrock"):
        cloud_of(drop, integrator="rosenbrock")
    with pytest.raises(InputError, match="wallLift/mobility holds for solids, not for drops: set it no"):
        cloud_of(drop, surroundings=(WallLift(),))
    with pytest.raises(InputError, match="the material is neoHooke, but 1 of 1 particles are drops"):
        cloud_of(drop, material="neoHooke")
    with pytest.raises(InputError, match="the material is drop, but 1 of 1 particles are solids"):
        cloud_of(spheres(x, d=2 * R, rho=1e3, mu=100.0))
    set_rest_shape(drop, (2.0, 1.0, 1.0))
    with pytest.raises(InputError, match="a drop is a sphere at rest"):
        cloud_of(drop)
