"""The second derivatives of flows, as Faxén's correction reads them."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, cyclic_row

from foamprb.compile.link import link
from foamprb.flow import analytic
from foamprb.flow.curvatures import _PLACES, mean_curvatures
from foamprb.flow.images import seam
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
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


@pytest.mark.parametrize("reconstructed", [False, True])
@pytest.mark.parametrize("kind", ["hexahedra", "tetrahedra"])
def test_second_derivatives_on_a_mesh_are_those_of_the_nodes_gradients(kind, reconstructed):
    """Exact where the gradient at the nodes is linear."""
    grid = block(4, kind=kind)
    mesh = build_mesh(grid, box_patches(grid))
    u, l = quadratic_nodes(mesh)
    curvatures = mean_curvatures(mesh, l) if reconstructed else None
    flow = MeshFlow(mesh, u, l, curvatures=curvatures)
    curvature = link(flow.kernels["curvature"])
    x = np.random.default_rng(0).uniform(0.1, 0.9, (20, 3))
    for place, host in zip(x, flow.locate(x), strict=True):
        assert np.array(curvature(flow.arrays(), host, tuple(place), 0.0)) == pytest.approx(
            np.array(QUADRATIC, dtype=float), abs=1e-6 if reconstructed else 1e-9
        )


def wave(x):
    """Return u of turning cells, and its second derivatives, a vector for each of PAIRS."""
    y, z, zero = 3.0 * x[:, 1], 3.0 * x[:, 2], 0.0 * x[:, 0]
    u = np.stack([zero, np.sin(y) * np.cos(z), -np.cos(y) * np.sin(z)], axis=1)
    mixed = 9.0 * np.stack([zero, -np.cos(y) * np.sin(z), np.sin(y) * np.cos(z)], axis=1)
    return u, np.stack([0.0 * u, -9.0 * u, -9.0 * u, 0.0 * u, mixed, 0.0 * u], axis=1)


def test_means_at_the_nodes_have_a_fraction_of_the_error():
    grid = block(10)
    mesh = build_mesh(grid, box_patches(grid))
    reconstruct = Reconstruction(mesh)
    u, l = reconstruct(wave(mesh.centres)[0], wave(mesh.boundary_centres)[0])
    x = np.random.default_rng(1).uniform(0.25, 0.75, (200, 3))
    errors = []
    for curvatures in (None, mean_curvatures(mesh, l)):
        flow = MeshFlow(mesh, u, l, curvatures=curvatures)
        curvature, hosts = link(flow.kernels["curvature"]), flow.locate(x)
        found = np.array([curvature(flow.arrays(), h, tuple(y), 0.0) for y, h in zip(x, hosts, strict=True)])
        errors.append(np.linalg.norm(found - wave(x)[1]))
    assert errors[1] < 0.25 * errors[0]


def test_second_derivatives_are_the_same_on_both_sides_of_a_period():
    """A period of a sector of 60°, in which the flow turns with the angle."""
    mesh = cyclic_row(60.0, 1)
    x, y, _ = np.asarray(mesh.nodes).T
    zero = 0.0 * x
    # u = r² e_z × x, whose gradient follows from the product rule.
    l = np.stack(
        [-2 * x * y, -3 * y * y - x * x, zero, 3 * x * x + y * y, 2 * x * y, zero, zero, zero, zero], axis=1
    )
    found = mean_curvatures(mesh, l.reshape(-1, 3, 3))
    (coupling,) = [c for c in mesh.couplings if c.turn[0, 1] < 0.0]
    here, there, turn = seam(mesh, coupling)
    full = np.take(found.reshape(-1, 6, 3), _PLACES, axis=1).transpose(0, 3, 1, 2).astype(float)
    turned = np.einsum("ia,jb,kc,nabc->nijk", turn, turn, turn, full[here])
    np.testing.assert_allclose(full[there], turned, atol=1e-5)


@pytest.mark.parametrize("curved", [False, True])
def test_second_derivatives_of_a_flow_that_changes_are_linear_in_time(curved):
    grid = block(3)
    mesh = build_mesh(grid, box_patches(grid))
    u, l = quadratic_nodes(mesh)
    table = mean_curvatures(mesh, l)

    def read(i):
        return (1.0 + i) * u, (1.0 + i) * l, *([(1.0 + i) * table] if curved else [])

    flow = SeriesFlow(mesh, (0.0, 1.0, 3.0), read, curved=curved)
    flow.load(0.0, 3.0)
    curvature, x = link(flow.kernels["curvature"]), (0.4, 0.5, 0.6)
    host = flow.locate(np.array([x]))[0]
    for t, factor in ((0.0, 1.0), (0.5, 1.5), (2.0, 2.5)):
        found = np.array(curvature(flow.arrays(), host, x, t))
        expected = factor * np.array(QUADRATIC, dtype=float)
        assert found == pytest.approx(expected, abs=1e-5 if curved else 1e-9)
