"""Two-dimensional flows, on meshes one cell thick."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import boundary, grid

from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow

DEPTH = 0.1


def layer(kind, planes="empty", n=6):
    """A unit square of n² displaced quadrangles, or twice as many triangles, between two planes."""
    g = np.linspace(0.0, 1.0, n + 1)
    y, x = (a.ravel() for a in np.meshgrid(g, g, indexing="ij"))
    inside = (np.minimum(x, y) > 1e-9) & (np.maximum(x, y) < 1.0 - 1e-9)
    shift = 0.3 / n * np.random.default_rng(0).uniform(-0.5, 0.5, (2, len(x))) * inside
    points = np.concatenate(
        [np.column_stack([x + shift[0], y + shift[1], 0.0 * x + z]) for z in (0.0, DEPTH)]
    )
    first = (np.arange(n) + (n + 1) * np.arange(n)[:, None]).ravel()
    quads = np.stack([first, first + 1, first + n + 2, first + n + 1], axis=1)
    flat = quads if kind == "hexahedra" else np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])
    shape = grid(points, [(12 if kind == "hexahedra" else 13, np.hstack([flat, flat + len(x)]))])

    def name(centre):
        return (
            "planes"
            if min(centre[2], DEPTH - centre[2]) < 1e-9
            else "lid"
            if centre[1] > 1.0 - 1e-9
            else "sides"
        )

    return build_mesh(shape, boundary(shape, name, {"planes": planes, "lid": "wall", "sides": "wall"}))


def cavity(mesh):
    """A lid of the velocity 1 over whirls, whose nodes at the corners are at rest; u, ∇u and fluxes."""
    x, y = mesh.centres[:, 0], mesh.centres[:, 1]
    u = np.column_stack(
        [
            np.sin(np.pi * x) ** 2 * y * (3.0 * y - 2.0),
            -np.pi * np.sin(2.0 * np.pi * x) * y**2 * (y - 1.0),
            0.0 * x,
        ]
    )
    given = np.zeros_like(mesh.boundary_centres)
    given[slice(*mesh.patch_start[1:3]), 0] = 1.0
    u, l = Reconstruction(mesh)(u, given)
    return u, l, Conservation(mesh)(u, l)


@pytest.mark.parametrize(("kind", "planes"), [("hexahedra", "empty"), ("prisms", "symmetryPlane")])
def test_velocity_and_its_correction_are_two_dimensional(kind, planes, random):
    mesh = layer(kind, planes)
    u, l, fluxes = cavity(mesh)
    flow = MeshFlow(mesh, u, l, fluxes=fluxes)
    x = np.column_stack([random.uniform(0.001, 0.999, (500, 2)), np.full(500, 0.5 * DEPTH)])
    values, gradients = [], []
    for depth in (0.001, 0.2, 0.5, 0.9):
        x[:, 2] = depth * DEPTH
        for found, part in zip((values, gradients), flow.sample(x, flow.locate(x), 0.0), strict=True):
            found.append(part)
    assert np.abs(values)[..., 2].max() == 0.0
    assert np.abs(gradients)[:, :, 2].max() == np.abs(gradients)[:, :, :, 2].max() == 0.0
    # The correction is stored in single precision.
    assert np.ptp(values, axis=0).max() < 1e-6
    assert np.ptp(gradients, axis=0).max() < 1e-12
    # It makes the flow solenoidal at each point, and lets nothing through a wall, not even beside the lid.
    hosts, e = flow.locate(x), 1e-5
    ends = [[flow.sample(x + s * e * np.eye(3)[k], hosts, 0.0)[0][:, k] for s in (1.0, -1.0)] for k in (0, 1)]
    assert np.abs(sum(a - b for a, b in ends) / (2.0 * e)).max() < 1e-3
    at_sides = np.column_stack([np.zeros(200), random.uniform(0.0, 1.0, 200), np.full(200, 0.3 * DEPTH)])
    assert np.abs(flow.sample(at_sides, flow.locate(at_sides), 0.0)[0][:, 0]).max() < 1e-6


def test_a_transient_flow_in_two_dimensions_is_that_of_its_times(random):
    mesh = layer("hexahedra", n=3)
    values = cavity(mesh)
    series = SeriesFlow(mesh, [0.0, 2.0], lambda k: tuple((1 + k) * a for a in values), conservative=True)
    flow = MeshFlow(mesh, *values[:2], fluxes=values[2])
    x = random.uniform(0.01, 0.99, (100, 3)) * [1.0, 1.0, DEPTH]
    hosts = series.locate(x)
    assert series.sample(x, hosts, 1.0)[0] == pytest.approx(1.5 * flow.sample(x, hosts, 0.0)[0], abs=1e-6)
