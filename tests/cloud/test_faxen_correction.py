"""Bodies in curved flows, carried with Faxén's correction, and the second derivatives of flows."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.tracker import Models
from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow

MU_F, R = 1e-3, 1e-5
WATER = Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


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


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
def test_a_sphere_lags_in_a_pipe_by_two_thirds_of_its_radius_squared(integrator):
    """(2/3) u_max (R/a)² wherever it is, and goes nowhere across (Happel & Brenner 1965)."""
    a, U = 1e-4, 1e-3
    x = [(0.0, y, 0.2 * a) for y in (0.0, 0.3 * a, 0.6 * a)]
    flow = analytic.pipe(a, U)
    steps = 1 if integrator == "stokes" else 40
    p = carried(x, flow, integrator=integrator, steps=steps)
    u, _ = flow.sample(p.x, p.host, 0.0)
    lag = u[:, 0] - p.v[:, 0]
    assert lag == pytest.approx(2.0 / 3.0 * 2.0 * U * (R / a) ** 2, rel=2e-3)
    assert np.abs(p.v[:, 1:]).max() < 1e-9 * U


def test_a_soft_body_migrates_no_more_in_a_pipe_with_it_than_without():
    """In a unidirectional flow the correction is along the flow."""
    flow, x = analytic.pipe(1e-4, 1e-3), (0.0, 5e-5, 0.0)
    p, q = (carried(x, flow, models=m, steps=200, mu=0.4) for m in (CURVED, ()))
    assert np.ptp(p.F) > 0.1
    assert q.x[0, 0] - p.x[0, 0] > 2e-7
    assert np.abs(p.x[0, 1:] - q.x[0, 1:]).max() < 1e-15


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


# --- Second derivatives -------------------------------------------------------------------------------------


def wavy(x, y, z, t):
    s = 1.0 + t
    return s * np.sin(2.0 * y) * np.cos(z), s * np.cos(3.0 * x * z), s * y * np.sin(x)


FLOWS = {
    "shear": (analytic.shear(2.0), 1.0),
    "slit": (analytic.slit(0.7, 3.0), 1.0),
    "pipe": (analytic.pipe(0.7, 3.0), 1.0),
    "pulsating pipe": (analytic.womersley(0.7, 1e-2, 1.0, amplitude=2.0, mean_velocity=1.0), 1.0),
    "function": (analytic.function(wavy, length=1.0), 1.0),
}


@pytest.mark.parametrize("name", FLOWS)
def test_second_derivatives_of_flows_in_closed_form(name):
    """Against differences of the gradient."""
    flow, t = FLOWS[name]
    arrays, h, x = flow.arrays(0.0, ()), 1e-5, np.array([0.3, 0.2, 0.25])
    sample, curvature = link(flow.kernels["sample"]), link(flow.kernels["curvature"])

    def gradient(place):
        return np.reshape(sample(arrays, 0, tuple(place), t)[1], (3, 3))

    D = [(gradient(x + arm) - gradient(x - arm)) / (2.0 * h) for arm in h * np.eye(3)]
    found = curvature(arrays, 0, tuple(x), t)
    for (j, k), vector in zip(PAIRS, found, strict=True):
        assert vector == pytest.approx(0.5 * (D[k][:, j] + D[j][:, k]), abs=2e-5)


def quadratic_nodes(mesh):
    x, y, z = np.asarray(mesh.nodes).T
    zero = 0.0 * x
    u = np.stack([y * y + x * z, x * y, z * z - x * x], axis=1)
    l = np.stack([z, 2.0 * y, x, y, x, zero, -2.0 * x, zero, 2.0 * z], axis=1).reshape(-1, 3, 3)
    return u, l


QUADRATIC = [(0, 0, -2), (2, 0, 0), (0, 0, 2), (0, 1, 0), (0, 0, 0), (1, 0, 0)]


@pytest.mark.parametrize("kind", ["hexahedra", "tetrahedra"])
def test_second_derivatives_on_a_mesh_are_those_of_the_nodes_gradients(kind):
    """Exact where the gradient at the nodes is linear."""
    grid = block(4, kind=kind)
    mesh = build_mesh(grid, box_patches(grid))
    flow = MeshFlow(mesh, *quadratic_nodes(mesh))
    curvature = link(flow.kernels["curvature"])
    x = np.random.default_rng(0).uniform(0.1, 0.9, (20, 3))
    for place, host in zip(x, flow.locate(x), strict=True):
        assert np.array(curvature(flow.arrays(), host, tuple(place), 0.0)) == pytest.approx(
            np.array(QUADRATIC, dtype=float), abs=1e-9
        )


def test_second_derivatives_of_a_flow_that_changes_are_linear_in_time():
    grid = block(3)
    mesh = build_mesh(grid, box_patches(grid))
    u, l = quadratic_nodes(mesh)
    flow = SeriesFlow(mesh, (0.0, 1.0, 3.0), lambda i: ((1.0 + i) * u, (1.0 + i) * l))
    flow.load(0.0, 3.0)
    curvature, x = link(flow.kernels["curvature"]), (0.4, 0.5, 0.6)
    host = flow.locate(np.array([x]))[0]
    for t, factor in ((0.0, 1.0), (0.5, 1.5), (2.0, 2.5)):
        found = np.array(curvature(flow.arrays(), host, x, t))
        assert found == pytest.approx(factor * np.array(QUADRATIC, dtype=float), abs=1e-9)
