"""Roughness of ∇u on a mesh, and the tolerance of steps by it."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, pipe, pipe_patches
from small_clouds import assert_same

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.flow.jumps import roughness
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow

START = np.random.default_rng(2).uniform(0.3, 0.6, (40, 3))


def flow_in(shape, patches, u):
    mesh = build_mesh(shape, patches)
    return MeshFlow(mesh, *Reconstruction(mesh)(u(mesh.centres), u(mesh.boundary_centres)))


def vortex(x):
    p, q = np.pi * x[:, 0], np.pi * x[:, 1]
    return np.stack([np.sin(p) * np.cos(q), -np.cos(p) * np.sin(q), 0.0 * p], axis=1)


def poiseuille(x):
    return np.stack([2.0 - 2.0 * (x[:, 1] ** 2 + x[:, 2] ** 2), 0.0 * x[:, 0], 0.0 * x[:, 0]], axis=1)


def in_block(kind, n, u):
    shape = block(n, 0.0, kind)
    return flow_in(shape, box_patches(shape), u)


@pytest.fixture(scope="module")
def smooth():
    """A pipe of hexahedra."""
    shape = pipe(16, 8)
    return flow_in(shape, pipe_patches(shape), poiseuille)


def test_roughness_is_the_error_of_interpolation(smooth):
    """None in a linear flow; of second order in the width of cells."""
    assert in_block("tetrahedra", 4, lambda x: x @ np.diag([1.0, 1.0, -2.0], 0)).roughness() < 1e-14
    coarse, fine = (in_block("tetrahedra", n, vortex).roughness() for n in (8, 16))
    assert 0.005 < coarse < 0.25
    assert 3.5 < coarse / fine < 6.0
    assert 5e-4 < smooth.roughness() < 2e-3
    # Noise of a uniform flow is no roughness of its velocity.
    noise = 1e-6 * np.random.default_rng(1).normal(size=(4**3 + 3**3, 9))
    corners = np.arange(8 * 27).reshape(27, 8) % 64
    assert roughness(noise, 8 * np.arange(28), corners.ravel(), 1.0) < 1e-5


def test_of_two_kinds_of_cells_the_smoother_one_counts():
    """Of gradients that differ by ½ in tetrahedra and by ¼ in prisms."""
    start, points = np.array([0, 4, 8, 14, 20]), np.arange(20)
    l = np.ones((24, 9))
    l[20:] *= np.array([1.5, 0.5, 1.25, 0.75])[:, None]
    assert roughness(l, start, points, 0.0) == pytest.approx(0.25)
    assert roughness(l[[*range(8), 20, 21]], start[:3], points[:8], 0.0) == pytest.approx(0.5)


def test_of_a_transient_flow_the_end_of_the_loaded_interval_counts():
    """So steps are the same whichever earlier times are loaded."""
    rough, linear = in_block("tetrahedra", 4, vortex), in_block("tetrahedra", 4, lambda x: x)
    fields = [flow.at_nodes()[1:] for flow in (linear, rough, linear)]
    series = SeriesFlow(rough.mesh, [0.0, 1.0, 2.0], lambda i: fields[i])
    for start, end, k in ((0.0, 0.5, rough.roughness()), (0.5, 1.5, 0.0), (1.5, 1.6, 0.0)):
        series.load(start, end)
        assert series.roughness() == pytest.approx(k, abs=1e-14)


def moved(flow, share, tolerance=1e-4):
    """Bodies after 0.13 units of time, and the tolerance of their steps."""
    p = spheres(START, d=1e-3, rho=1.0, mu=2.0)
    models = Models(integrator="stokes", tolerance=tolerance, stride=None, roughness_share=share)
    walls = [Escape() for _ in flow.patches]
    cloud = Cloud(p, flow, Medium(0.5, 1.0, (0.0, 0.0, 0.0)), walls, 2e-3, models, 1)
    cloud.advance(64)
    return cloud.particles, cloud.tolerance


def test_steps_follow_the_mesh_where_it_is_rough_and_nothing_changes_elsewhere(smooth):
    (p, tolerance), (other, _) = moved(smooth, 0.05), moved(smooth, 0.0)
    assert tolerance == 1e-4
    assert_same(p, other)
    rough = in_block("tetrahedra", 8, vortex)
    (p, tolerance), (other, _), (exact, fine) = moved(rough, 0.05), moved(rough, 0.0), moved(rough, 0.0, 1e-7)
    assert (tolerance, fine) == (pytest.approx(0.05 * rough.roughness()), 1e-7)
    assert p.substeps.sum() < 0.75 * other.substeps.sum()
    off, way = np.linalg.norm(p.x - exact.x, axis=1), np.linalg.norm(exact.x - START, axis=1)
    assert (off < 0.05 * rough.roughness() * way).all()
