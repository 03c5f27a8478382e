"""Bodies that stick to a wall by bonds and come off again: shares, places and files."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Adhere
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import BirdCarreau
from foamprb.errors import InputError
from foamprb.flow import analytic

R, MU, DT, N = 2e-6, 1e-3, 1e-2, 1000
WATER = Medium(MU, 1000.0, (0.0, 0.0, -9.81))
STUCK, ACTIVE = Status.STUCK, Status.ACTIVE


def cloud_of(rate=0.0, n=N, threads=1, height=R * (1.0 + 1e-7), integrator="stokes", medium=WATER, **entries):
    """Bodies that lie on a wall in shear, or fall onto it."""
    p = spheres(np.tile([0.0, 0.0, height], (n, 1)), d=2 * R, rho=1200.0, mu=100.0)
    flow, models = analytic.shear_over_wall(rate), Models(integrator=integrator)
    patch = Adhere(**({"kOn": 2.0, "kOff": 0.0} | entries))
    return Cloud(p, flow, medium, [patch], DT, models, threads=threads)


def share_stuck(cloud):
    return np.mean(cloud.particles.status == STUCK)


def assert_share(cloud, expected):
    """To four standard errors."""
    assert share_stuck(cloud) == pytest.approx(expected, abs=4.0 * np.sqrt(expected * (1.0 - expected) / N))


def test_bodies_stick_with_the_contact_time():
    """1 − exp(−k_on t), for any number of steps and calls; stuck ones stay where they are."""
    cloud = cloud_of(rate=10.0)
    cloud.advance(50)
    assert_share(cloud, 1.0 - np.exp(-2.0 * 0.5))
    p = cloud.particles
    stuck = p.status == STUCK
    np.testing.assert_array_equal(p.bonds, stuck)
    np.testing.assert_array_equal(p.patch, np.where(stuck, 0, -1))
    x = p.x[stuck].copy()
    cloud.advance(20)
    assert np.array_equal(p.x[stuck], x)
    np.testing.assert_allclose(p.x[stuck, 0], 10.0 * R * p.t[stuck], rtol=0.02)
    assert sum(p.counts().values()) == N
    assert cloud.tracker.movable == (Status.PENDING, ACTIVE)


def test_nothing_sticks_above_the_critical_shear_rate():
    cloud = cloud_of(rate=10.0, n=40, kOn=50.0, criticalShearRate=20.0)
    cloud.advance(20)
    assert share_stuck(cloud) == 1.0
    faster = cloud_of(rate=30.0, n=40, kOn=50.0, criticalShearRate=20.0)
    faster.particles.status[:20], faster.particles.patch[:20] = STUCK, 0
    faster.advance(3)
    assert share_stuck(faster) == 0.0
    assert faster.particles.bonds[:20].min() == 1


def test_a_falling_body_does_not_stick_before_it_touches():
    cloud = cloud_of(n=40, height=1.5 * R, kOn=1e9)
    cloud.advance(70)
    p = cloud.particles
    assert share_stuck(cloud) == 1.0
    speed = 2.0 / 9.0 * 200.0 * 9.81 * R**2 / MU
    np.testing.assert_allclose(p.t, 0.5 * R / speed, atol=1.001 * DT)
    np.testing.assert_allclose(p.x[:, 2], R, rtol=1e-5)


def test_bad_entries_are_refused():
    with pytest.raises(InputError, match="xb, which needs the temperature T"):
        Adhere(kOn=1.0, kOff=1.0, xb=1e-10)
    with pytest.raises(InputError, match="adhere needs the integrator stokes or rosenbrock, not paper"):
        cloud_of(integrator="paper")
    thinning = Medium(BirdCarreau(mu0=1e-3, muInf=1e-4, k=1.0, n=0.5), 1000.0, (0.0, 0.0, -9.81))
    with pytest.raises(InputError, match="xb, which needs a constant viscosity"):
        cloud_of(medium=thinning, xb=1e-10, T=300.0)
