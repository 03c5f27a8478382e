"""Largest values on the paths of bodies, and the curvature of the flow there."""

from __future__ import annotations

import math

import numpy as np
import pytest

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import drops, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.run.validity import path_values

MU_F, RHO, R = 1e-3, 1000.0, 1e-5
WATER = Medium(MU_F, RHO, (0.0, 0.0, 0.0))
RADIUS, U, SOFT = 1e-4, 1e-2, 1.0
PLACES = np.array([2e-5, 5e-5, 8.5e-5])
"""Distances from the axis, m."""


def in_pipe(integrator="stokes", shape="affine", dt=1e-4, steps=(200,), stride=None, flow=None, y=PLACES):
    """Soft spheres in a pipe, after some calls."""
    x = np.stack([0.0 * y, y, 0.0 * y], axis=1)
    p = spheres(x, d=2.0 * R, rho=RHO, mu=SOFT, poissons_ratio=0.4999)
    flow = analytic.pipe(RADIUS, 0.5 * U) if flow is None else flow
    models = Models(integrator=integrator, shape=shape, stride=stride)
    cloud = Cloud(p, flow, WATER, [Rebound() for _ in flow.patches], dt, models, threads=1)
    for n in steps:
        cloud.advance(n)
    return p


@pytest.mark.parametrize(("integrator", "dt"), [("stokes", 1e-4), ("rosenbrock", 1e-4), ("paper", 1e-5)])
def test_values_of_a_poiseuille_flow(integrator, dt):
    """γ̇ = 2 U r/R², κ = 0.894 a/r, ε = 7/8 μ U a/(μ_s R²), and the gap of a sphere at the start."""
    p = in_pipe(integrator, dt=dt)
    values = path_values(p, RHO, False)
    rate = 2.0 * U * PLACES / RADIUS**2
    np.testing.assert_allclose(values["maxShearRate"], rate, rtol=1e-4)
    np.testing.assert_allclose(values["maxShearStress"], MU_F * rate, rtol=1e-4)
    np.testing.assert_allclose(values["maxReynolds"], RHO * rate * 4.0 * R**2 / MU_F, rtol=1e-4)
    np.testing.assert_allclose(values["curvatureNumber"], np.sqrt(0.8) * R / PLACES, rtol=1e-4)
    steady = 7.0 / 8.0 * MU_F * U * R / (SOFT * RADIUS**2)
    np.testing.assert_allclose(values["maxBulletAmplitude"], steady, rtol=1e-5)
    np.testing.assert_allclose(values["minGap"], (RADIUS - PLACES) / R - 1.0, atol=3e-3)
    assert (values["maxD"] >= p.D * (1.0 - 1e-12)).all()


def test_a_short_life_has_a_curvature_number():
    """Of three time steps, where the means of longer lives are of one sample in 64."""
    numbers = path_values(in_pipe(steps=(3,)), RHO, False)["curvatureNumber"]
    np.testing.assert_allclose(numbers, np.sqrt(0.8) * R / PLACES, rtol=1e-4)


def fading_shear(x, y, z, t):
    return 100.0 * y * math.exp(-((t / 0.01) ** 2)), 0.0, 0.0


def test_the_largest_deformation_remains_where_a_body_becomes_a_sphere_again():
    p = spheres([(0.0, 0.0, 0.0)], d=2.0 * R, rho=RHO, mu=SOFT, poissons_ratio=0.4999)
    cloud = Cloud(p, analytic.function(fading_shear, 1e-4), WATER, (), 1e-4, Models(integrator="stokes"))
    D = []
    for _ in range(500):
        cloud.advance(1)
        D.append(p.D[0])
    assert D[-1] < 1e-6
    assert p.largest[0, 0] == pytest.approx(max(D), rel=1e-6)
    assert path_values(p, RHO, False)["maxD"] == pytest.approx(max(D), rel=1e-6)
    assert p.largest[0, 1] == pytest.approx(100.0, rel=1e-3)


def test_the_amplitude_of_the_mode_is_the_largest_on_the_path():
    """A bullet that has relaxed for three τ₃ has reached 95 % of its steady amplitude."""
    tau = 19.0 * MU_F / (16.0 * SOFT)
    p = in_pipe(shape="quadratic", dt=0.1 * tau, steps=(30,), stride=1, y=np.zeros(1))
    steady = 7.0 / 8.0 * MU_F * U * R / (SOFT * RADIUS**2)
    assert path_values(p, RHO, True)["maxBulletAmplitude"] == pytest.approx(
        steady * (1.0 - np.exp(-2.9)), rel=1e-5
    )


def test_steady_amplitude_of_a_drop():
    """ε = (10 + 11λ)/(20 (1 + λ)) μ U a²/(σ R²)."""
    p = drops([(0.0, 2e-5, 0.0)], d=2.0 * R, rho=RHO, gamma=SOFT * R, eta=MU_F)
    flow = analytic.pipe(RADIUS, 0.5 * U)
    walls = [Rebound() for _ in flow.patches]
    Cloud(p, flow, WATER, walls, 1e-4, Models(integrator="stokes", material="drop")).advance(70)
    eps = 21.0 / 40.0 * MU_F * U * R / (SOFT * RADIUS**2)
    assert path_values(p, RHO, False)["maxBulletAmplitude"][0] == pytest.approx(eps, rel=1e-4)


@pytest.mark.parametrize(("integrator", "stride"), [("stokes", None), ("stokes", 1), ("paper", 1)])
def test_values_do_not_depend_on_calls(integrator, stride):
    """A run that is divided at multiples of its stretches has the same values, bit for bit."""
    whole, divided = (
        in_pipe(integrator, dt=1e-5, steps=s, stride=stride) for s in ((2048,), (1024, 992, 32))
    )
    for name in ("largest", "curved"):
        np.testing.assert_array_equal(getattr(divided, name), getattr(whole, name))
    assert (whole.curved[:, 2] > 1).all()
