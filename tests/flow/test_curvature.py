"""The second derivatives of flows, as Faxén's correction reads them."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.compile.link import link
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


def wavy(x, y, z, t):
    s = 1.0 + t
    return s * np.sin(2.0 * y) * np.cos(z), s * np.cos(3.0 * x * z), s * y * np.sin(x)


def test_second_derivatives_of_a_function():
    """Against differences of the gradient; test_channels.py has those of the other closed forms."""
    flow, t = analytic.function(wavy, length=1.0), 1.0
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
