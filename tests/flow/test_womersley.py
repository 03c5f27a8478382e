"""Particles that Womersley's flow carries to and fro."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import jv

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models

RADIUS, NU, PERIOD, AMPLITUDE, MEAN, PHASE = 2e-3, 2e-6, 1.0, 0.06, 5e-3, 0.4
OMEGA = 2 * np.pi / PERIOD
RHO = 1e3
WATER = Medium(RHO * NU, RHO, (0.0, 0.0, 0.0))


SWING = (
    AMPLITUDE / (1j * OMEGA) * (1 - 1 / jv(0, 1j**1.5 * np.sqrt(OMEGA / NU) * RADIUS)) * np.exp(1j * PHASE)
)
"""Of the velocity on the axis of a pipe of Womersley's (1955), u = u₀ + Re(û exp(iωt))."""
REAL, IMAGINARY = float(SWING.real), float(SWING.imag)


def velocity(x, y, z, t):
    swing = REAL * np.cos(OMEGA * t) - IMAGINARY * np.sin(OMEGA * t)
    return 2.0 * MEAN + swing + 0.0 * x, 0.0 * y, 0.0 * z


FLOW = analytic.function(velocity, length=RADIUS, time=PERIOD)


def cloud_at(r, integrator, dt, **solid):
    p = spheres([[0.0, r, 0.0]], poissons_ratio=0.49, **solid)
    return Cloud(p, FLOW, WATER, (), dt, Models(integrator=integrator, tolerance=1e-6))


@pytest.mark.parametrize(
    ("integrator", "steps", "tolerance"), [("rosenbrock", 100, 2e-6), ("paper", 4000, 1e-3)]
)
def test_a_heavy_rigid_sphere_lags_behind_the_flow_on_the_axis(integrator, steps, tolerance):
    """Against m dv/dt = 6 π μ R (u(t) − v) with u = u₀ + Re(û exp(iωt))."""
    d, rho = 2e-4, 150 * RHO
    tau = rho * d**2 / (18 * WATER.mu)
    lag = SWING / (1 + 1j * OMEGA * tau)
    cloud = cloud_at(0.0, integrator, PERIOD / steps, d=d, rho=rho, mu=1e3)
    cloud.advance(steps)
    start = -2 * MEAN - lag.real
    v = 2 * MEAN + (lag * np.exp(1j * OMEGA)).real + start * np.exp(-PERIOD / tau)
    x = 2 * MEAN + (lag / (1j * OMEGA) * (np.exp(1j * OMEGA) - 1)).real
    x += start * tau * (1 - np.exp(-PERIOD / tau))
    scale = abs(SWING)
    assert abs(lag) < 0.9 * scale
    np.testing.assert_allclose(cloud.particles.v[0], [v, 0, 0], rtol=0, atol=tolerance * scale)
    np.testing.assert_allclose(cloud.particles.x[0], [x, 0, 0], rtol=0, atol=tolerance * scale * PERIOD)
