"""Womersley's flow in closed form, and particles that it carries to and fro."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import jv

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape, Stick
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models

RADIUS, NU, PERIOD, AMPLITUDE, MEAN, PHASE = 2e-3, 2e-6, 1.0, 0.06, 5e-3, 0.4
OMEGA = 2 * np.pi / PERIOD
RHO = 1e3
WATER = Medium(RHO * NU, RHO, (0.0, 0.0, 0.0))


def exact(r, t, nu=NU):
    """u, ∂u/∂r and ∂u/∂t of Womersley (1955)."""
    k = 1j**1.5 * np.sqrt(OMEGA / nu)
    swing = AMPLITUDE / (1j * OMEGA) * np.exp(1j * (OMEGA * t + PHASE))
    profile = 1 - jv(0, k * r) / jv(0, k * RADIUS)
    u = 2 * MEAN * (1 - (r / RADIUS) ** 2) + (swing * profile).real
    slope = -4 * MEAN * r / RADIUS**2 + (swing * k * jv(1, k * r) / jv(0, k * RADIUS)).real
    return u, slope, (1j * OMEGA * swing * profile).real


def flow(nu=NU):
    return analytic.womersley(RADIUS, nu, PERIOD, AMPLITUDE, MEAN, PHASE)


@pytest.mark.parametrize("alpha", [0.3, 1.0, 3.5, 10.0, 20.0, 29.9])
def test_velocity_gradient_and_acceleration_against_bessel_functions(alpha, random):
    nu = RADIUS**2 * OMEGA / alpha**2
    r, phi, t = RADIUS * np.sqrt(random.random(40)), 2 * np.pi * random.random(40), 0.77
    x = np.stack([0 * r, r * np.cos(phi), r * np.sin(phi)], axis=1)
    u, l = flow(nu).sample(x, np.zeros(40, dtype=np.int32), t)
    _, _, u_t = flow(nu).kernels["sample"](flow(nu).arrays(0.0, ()), 0, tuple(x.T), t)
    for found, expected in zip((u[:, 0], l[:, 0, 1] * np.cos(phi) + l[:, 0, 2] * np.sin(phi), u_t[0]),
                               exact(r, t, nu), strict=True):  # fmt: skip
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    assert np.all(u[:, 1:] == 0)
    assert np.all(l[:, 1:] == 0)


def test_where_the_series_fails_it_is_refused():
    with pytest.raises(ValueError, match=r"Womersley number 31\.3 > 30"):
        analytic.womersley(RADIUS, RADIUS**2 * OMEGA / 31.3**2, PERIOD, AMPLITUDE)


def cloud_at(r, integrator, dt, **solid):
    p = spheres([[0.0, r, 0.0]], poissons_ratio=0.49, **solid)
    return Cloud(
        p, flow(), WATER, (Stick(), Escape(), Escape()), dt, Models(integrator=integrator, tolerance=1e-6)
    )


@pytest.mark.parametrize(
    ("integrator", "steps", "tolerance"), [("rosenbrock", 100, 2e-6), ("paper", 4000, 1e-3)]
)
def test_a_heavy_rigid_sphere_lags_behind_the_flow_on_the_axis(integrator, steps, tolerance):
    """Against m dv/dt = 6 π μ R (u(t) − v) with u = u₀ + Re(û exp(iωt))."""
    d, rho = 2e-4, 150 * RHO
    tau = rho * d**2 / (18 * WATER.mu)
    k = 1j**1.5 * np.sqrt(OMEGA / NU) * RADIUS
    swing = AMPLITUDE / (1j * OMEGA) * (1 - 1 / jv(0, k)) * np.exp(1j * PHASE)
    lag = swing / (1 + 1j * OMEGA * tau)
    cloud = cloud_at(0.0, integrator, PERIOD / steps, d=d, rho=rho, mu=1e3)
    cloud.advance(steps)
    start = -2 * MEAN - lag.real
    v = 2 * MEAN + (lag * np.exp(1j * OMEGA)).real + start * np.exp(-PERIOD / tau)
    x = 2 * MEAN + (lag / (1j * OMEGA) * (np.exp(1j * OMEGA) - 1)).real
    x += start * tau * (1 - np.exp(-PERIOD / tau))
    scale = abs(swing)
    assert abs(lag) < 0.9 * scale
    np.testing.assert_allclose(cloud.particles.v[0], [v, 0, 0], rtol=0, atol=tolerance * scale)
    np.testing.assert_allclose(cloud.particles.x[0], [x, 0, 0], rtol=0, atol=tolerance * scale * PERIOD)
