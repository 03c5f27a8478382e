"""Bodies in curved flows, carried with Faxén's correction."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

MU_F, R = 1e-3, 1e-5
WATER = Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))


CURVED = (FaxenCorrection(),)


def carried(
    x, flow, *, integrator="stokes", models=CURVED, steps=1, dt=1e-4, mu=1e4, rho=1000.0, stretch=None
):
    p = spheres(np.atleast_2d(x), d=2.0 * R, rho=rho, mu=mu, poissons_ratio=0.4999)
    if stretch is not None:
        p.F0[:] = np.diag(stretch).ravel()
        p.F[:] = p.F0
    chosen = Models(integrator=integrator, surroundings=models)
    Cloud(p, flow, WATER, [Escape()] * len(flow.patches), dt, chosen, threads=1).advance(steps)
    return p


# --- Bodies -------------------------------------------------------------------------------------------------


def test_a_sphere_with_inertia_lags_in_a_pipe_by_two_thirds_of_its_radius_squared():
    """(2/3) u_max (R/a)² wherever it is, and goes nowhere across (Happel & Brenner 1965)."""
    a, U = 1e-4, 1e-3
    x = [(0.0, y, 0.2 * a) for y in (0.0, 0.3 * a, 0.6 * a)]
    flow = analytic.pipe(a, U)
    p = carried(x, flow, integrator="rosenbrock", steps=40)
    u, _ = flow.sample(p.x, p.host, 0.0)
    lag = u[:, 0] - p.v[:, 0]
    assert lag == pytest.approx(2.0 / 3.0 * 2.0 * U * (R / a) ** 2, rel=2e-3)
    assert np.abs(p.v[:, 1:]).max() < 1e-9 * U


def test_a_body_moves_as_fast_as_the_mean_over_the_mapped_sphere():
    """In a flow that is quadratic in all coordinates; a light body, without inertia."""
    flow = analytic.function(_quadratic)
    stretch = np.array([1.6, 1.0, 1.0 / 1.6])
    centre = np.array([3e-5, -2e-5, 1e-5])
    p = carried(centre, flow, stretch=stretch, dt=1e-7, rho=1e-2)
    ends = np.concatenate([np.diag(stretch), -np.diag(stretch)]) * R
    mean = np.mean([_quadratic(*(p.x[0] + arm)) for arm in ends], axis=0)
    here = np.array(_quadratic(*p.x[0]))
    assert np.abs(mean - here).max() > 1e-5
    assert p.v[0] - here == pytest.approx(mean - here, rel=1e-4)


def _quadratic(x, y, z):
    k = 1e6
    return k * (y * y + 2.0 * x * z), k * (x * x - 0.5 * z * z), k * (y * x - z * z)


def test_a_flow_without_second_derivatives_is_refused():
    flow = analytic.shear(1.0)
    del flow.kernels["curvature"]
    with pytest.raises(InputError, match="FaxenCorrection needs curvature, which this flow does not have"):
        carried((0.0, 0.0, 0.0), flow)
