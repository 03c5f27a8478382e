"""Eddies in the loop: their statistics, and the dispersion that follows from them."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches
from scipy.stats import kstest, norm

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape, Mirror, Rebound
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.dispersion import (
    DOWN,
    DOWN_OR_UP,
    NORMAL,
    OPENFOAM,
    GradientDispersion,
    StochasticDispersion,
    eddy_velocity,
)
from foamprb.cloud.tracker import Models
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow

K, EPSILON = 1.5e-6, 1.5e-6
"""A life of 1 s, and fluctuations of 1 mm/s, small against the box of 1 m."""
SIGMA = 1e-3
MEDIUM = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
RANDOM_WALK = StochasticDispersion()


def mesh_of(cells=2):
    shape = block(cells, 0.0)
    return build_mesh(shape, box_patches(shape))


def table(mesh, k=lambda x: K + 0.0 * x, epsilon=lambda x: EPSILON + 0.0 * x):
    """k, ε, and by differences ∇k and ∇(k²/3ε), functions of x alone."""
    x = np.concatenate([mesh.points, mesh.centres])[:, 0]
    values = np.zeros((len(x), 8))
    values[:, 0], values[:, 1] = k(x), epsilon(x)
    d = 1e-6
    values[:, 2] = (k(x + d) - k(x - d)) / (2.0 * d)
    values[:, 5] = (k(x + d) ** 2 / epsilon(x + d) - k(x - d) ** 2 / epsilon(x - d)) / (6.0 * d)
    return values


def box(values=None, mesh=None, u=(0.0, 0.0, 0.0)):
    mesh = mesh or mesh_of()
    n = mesh.n_points + mesh.n_cells
    velocity = np.broadcast_to(np.array(u), (n, 3))
    values = table(mesh) if values is None else values
    return MeshFlow(mesh, velocity, np.zeros((n, 3, 3)), turbulence=values)


def changing(factors):
    """Fluid at rest, whose turbulence is the factors times that of :func:`table` at the times 0, 1, …"""
    mesh = mesh_of()
    still = np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))
    times = [float(i) for i in range(len(factors))]
    return SeriesFlow(mesh, times, lambda i: (*still, factors[i] * table(mesh)), turbulent=True)


def tracers(n, place=(0.5, 0.5, 0.5), rho=1000.0, d=1e-5):
    return spheres(np.tile(np.asarray(place, float), (n, 1)), d=d, rho=rho, mu=1e3, poissons_ratio=0.4999)


def cloud_of(p, flow, dt, *, model=RANDOM_WALK, threads=1, integrator="stokes", medium=MEDIUM, patch=Mirror):
    models = Models(integrator=integrator, surroundings=(model,))
    return Cloud(p, flow, medium, [patch() for _ in flow.patches], dt, models, threads=threads)


def carried(p, flow, steps, dt, **options):
    cloud_of(p, flow, dt, **options).advance(steps)
    return p


def test_with_inertia_each_component_of_the_fluctuation_has_the_variance_2k_3():
    """To four times the standard error of a variance, √(2/n); no mean, no correlation."""
    n = 2000
    p = carried(tracers(n), changing([1.0, 1.0]), 1, 1e-3, integrator="rosenbrock")
    moments = p.eddy.T @ p.eddy / n / SIGMA**2
    np.testing.assert_allclose(moments, np.eye(3), atol=4.0 * np.sqrt(2.0 / n))
    assert kstest(p.eddy.ravel() / SIGMA, "norm").pvalue > 1e-3
    # A tracer moves with it; its velocity adapts within ρd²/18μ, 5.6 µs.
    np.testing.assert_allclose(p.v, p.eddy, rtol=0.02, atol=1e-3 * SIGMA)


def test_openfoams_fluctuations_have_a_third_of_it():
    """The first eddy is met after a life of them, and none where they live for less than a step."""
    n, openfoam = 2000, StochasticDispersion(fluctuations="OpenFOAM")
    assert not np.any(carried(tracers(20), box(), 4, 0.2, model=openfoam).eddy)
    assert not np.any(carried(tracers(20), box(), 4, 2.0, model=openfoam).eddy)
    p = carried(tracers(n), box(), 6, 0.2, model=openfoam)
    moments = p.eddy.T @ p.eddy / n / SIGMA**2
    np.testing.assert_allclose(moments, np.eye(3) / 3.0, atol=4.0 * np.sqrt(2.0 / n))
    assert kstest(np.linalg.norm(p.eddy, axis=1) / SIGMA, "halfnorm").pvalue > 1e-3


@pytest.mark.parametrize("last", [1.5, -1.5])
def test_an_eddys_velocity_is_of_three_deviates_or_of_a_length_and_a_direction(last):
    """The fourth is the length, negative only where eddies go along ∇k as often as against it."""
    xi, slope = (2.0, -1.0, 2.0, last), (0.0, 3.0, -4.0)
    assert eddy_velocity(xi, NORMAL, slope) == xi[:3]
    assert eddy_velocity(xi, OPENFOAM, slope) == pytest.approx(np.array(xi[:3]) * last * np.sign(last) / 3.0)
    assert eddy_velocity(xi, DOWN, slope) == pytest.approx((0.0, -0.9, 1.2))
    assert eddy_velocity(xi, DOWN_OR_UP, slope) == pytest.approx(np.sign(last) * np.array([0.0, -0.9, 1.2]))


def test_results_do_not_depend_on_threads_nor_on_turns_nor_on_order():
    flow = box()
    whole = carried(tracers(100), flow, 12, 0.3)
    assert np.array_equal(whole.x, carried(tracers(100), flow, 12, 0.3, threads=3).x)
    p = tracers(100)
    cloud = cloud_of(p, flow, 0.3)
    for _ in range(4):
        cloud.advance(3)
    assert np.array_equal(whole.x, p.x)
    assert np.array_equal(whole.eddy, p.eddy)
    other = carried(tracers(100), flow, 12, 0.3, model=StochasticDispersion(seed=2))
    assert abs(np.corrcoef(other.x[:, 0], whole.x[:, 0])[0, 1]) < 0.4


def test_a_transient_flow_has_the_turbulence_of_the_time():
    p, flow = tracers(2000), changing([1.0, 4.0])
    p.t0[:] = 0.5
    carried(p, flow, 6, 0.1, integrator="rosenbrock")
    # k is 2.5 times that of the start.
    assert p.eddy.var() / SIGMA**2 == pytest.approx(2.5, rel=4.0 * np.sqrt(2.0 / 6000))
    assert len(flow.turbulence_at_nodes()) == len(flow.mesh.nodes)


def test_gradient_dispersion_goes_from_high_to_low_k():
    mesh = mesh_of(4)
    flow = box(table(mesh, lambda x: K * (0.5 + x)), mesh)
    n = 2000
    p = carried(tracers(n), flow, 1, 1e-3, model=GradientDispersion())
    assert np.all(p.eddy[:, 0] < 0.0)
    assert not np.any(p.eddy[:, 1:])
    assert kstest(-p.eddy[:, 0] / SIGMA, "halfnorm").pvalue > 1e-3


def test_walls_and_mirrors_turn_the_eddy_with_the_particle():
    """A tracer that met a wall goes on away from it; it does not lie on it until its eddy ends."""
    flow = box(table(mesh_of(), lambda x: 1e4 * K + 0.0 * x, lambda x: 1e2 * EPSILON + 0.0 * x))
    far, start = 0.08, 0.02

    def folded(x):
        return norm.cdf((x - start) / far) - norm.cdf((-x - start) / far)

    for patch in (Mirror, Rebound):
        p = carried(tracers(400, place=(start, 0.5, 0.5)), flow, 8, 0.1, patch=patch)
        assert kstest(p.x[:, 0], folded).pvalue > 1e-3


def test_without_turbulence_there_are_no_eddies():
    mesh = mesh_of()
    flow = box(np.zeros((mesh.n_points + mesh.n_cells, 8)), mesh, u=(0.1, 0.0, 0.0))
    p = carried(tracers(10), flow, 3, 0.1, patch=Escape)
    assert not np.any(p.eddy)
    assert p.x[:, 0] == pytest.approx(0.53)
