"""Drops after Maffettone and Minale: steady shapes, settling, stress and breakup."""

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
# λ, Ca, D and θ, deg: LSODA at 1e-11 for the equation of S.
STEADY = np.array([
    (1.0, 0.1, 0.109709, 38.8305), (1.0, 0.2, 0.221505, 33.1853), (1.0, 0.3, 0.338202, 28.3626),
    (5.0, 0.1, 0.103956, 29.4918), (5.0, 0.2, 0.173528, 19.8735), (5.0, 0.3, 0.225599, 14.5020),
    (0.1, 0.1, 0.102871, 41.2914), (0.1, 0.2, 0.212816, 37.7031), (0.1, 0.3, 0.338278, 34.3335),
])  # fmt: skip
SMALL, TORN = 9, 10


def test_drops_in_shear():
    """Steady shapes; a small one settles by Hadamard and Rybczyński and has Taylor's stress; one breaks."""
    ratio = np.append(STEADY[:, 0], (3.0, 1.0))
    Ca = np.append(STEADY[:, 1], (1e-3, 3.0))
    p = drops(np.zeros((11, 3)), d=2 * R, rho=1200.0, gamma=MU * RATE * R / Ca, eta=ratio * MU)
    medium = Medium(MU, 1000.0, (0.0, 0.0, -9.81))
    cloud = Cloud(p, analytic.shear(RATE), medium, [], 2e-3, Models(material="drop"))
    assert cloud.models.integrator == "stokes"
    with pytest.warns(FailedParticlesWarning, match="stretched"):
        cloud.advance(1000)

    F = p.F[:SMALL].reshape(-1, 3, 3)
    squares, axes = np.linalg.eigh(F @ F.transpose(0, 2, 1))
    long, short = np.sqrt(squares[:, 2]), np.sqrt(squares[:, 0])
    np.testing.assert_allclose((long - short) / (long + short), STEADY[:, 2], atol=1e-6)
    angle = np.degrees(np.arctan(axes[:, 1, 2] / axes[:, 0, 2]))
    np.testing.assert_allclose(angle, STEADY[:, 3], atol=1e-4)
    np.testing.assert_allclose(np.linalg.det(F), 1.0, atol=1e-14)

    stokes = 2.0 / 9.0 * (1200.0 - 1000.0) * -9.81 * R * R / MU
    assert p.v[SMALL, 2] == pytest.approx(stokes * 12.0 / 11.0, rel=1e-4)
    values = measure(context(p, cloud.flow, MU, cloud.time))
    assert values["capillaryNumber"][SMALL] == pytest.approx(1e-3)
    shear_stress = values["stresslet"][SMALL, 3] / (4.0 / 3.0 * np.pi * R**3)
    assert shear_stress == pytest.approx(0.5 * MU * RATE * 17.0 / 4.0, rel=1e-4)

    assert (p.status[TORN], p.reason[TORN]) == (Status.FAILED, Reason.STRETCHED)
    assert "breaks up" in explain(p.reason[TORN], cloud.models, cloud.limits)


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
