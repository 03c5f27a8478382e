from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_flow_shapes import KINDS, block, box_patches, pipe, pipe_patches

from foamprb.flow.mesh import Patch, build_mesh
from foamprb.flow.reconstruct import Reconstruction, from_points
from foamprb.flow.walk import MeshFlow

vectors = st.lists(st.floats(-3.0, 3.0), min_size=12, max_size=12)


@given(st.sampled_from(KINDS), st.floats(0.0, 0.5), st.integers(0, 1000), vectors)
@settings(max_examples=40)
def test_linear_fields_are_reproduced(kind, perturbation, seed, numbers):
    shape = block(2, perturbation, kind, seed)
    mesh = build_mesh(shape, box_patches(shape))
    gradient, offset = np.reshape(numbers[:9], (3, 3)), np.array(numbers[9:])
    u, l = Reconstruction(mesh)(
        mesh.centres @ gradient.T + offset, mesh.boundary_centres @ gradient.T + offset
    )
    assert u == pytest.approx(mesh.nodes @ gradient.T + offset, abs=1e-11)
    assert l == pytest.approx(np.broadcast_to(gradient, l.shape), abs=1e-10)


@pytest.mark.parametrize("kind", ["hexahedra", "polyhedra", "mixed", "prisms"])
def test_linear_fields_are_reproduced_from_points(kind):
    mesh = build_mesh(block(4, 0.3, kind))
    gradient = np.arange(9.0).reshape(3, 3) - 4.0
    u, l = from_points(mesh, mesh.points @ gradient.T + 1.0)
    assert u == pytest.approx(mesh.nodes @ gradient.T + 1.0, abs=1e-12)
    assert l == pytest.approx(np.broadcast_to(gradient, l.shape), abs=1e-11)


def quadratic(x):
    u = np.column_stack([x[:, 0] * x[:, 1], x[:, 2] ** 2 - x[:, 0], x[:, 1] * x[:, 2]])
    l = np.zeros((len(x), 3, 3))
    l[:, 0, 0], l[:, 0, 1] = x[:, 1], x[:, 0]
    l[:, 1, 0], l[:, 1, 2] = -1.0, 2.0 * x[:, 2]
    l[:, 2, 1], l[:, 2, 2] = x[:, 2], x[:, 1]
    return u, l


def test_quadratic_fields_are_nearly_reproduced_walls_included():
    shape = block(6, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    u, l = Reconstruction(mesh)(quadratic(mesh.centres)[0], quadratic(mesh.boundary_centres)[0])
    exact_u, exact_l = quadratic(mesh.nodes)
    assert l == pytest.approx(exact_l, abs=0.03)
    assert u == pytest.approx(exact_u, abs=1e-2)


def test_no_slip_is_exact_at_every_point_of_the_wall(random):
    shape = pipe(6)
    mesh = build_mesh(shape, pipe_patches(shape))
    cells, faces = random.random((mesh.n_cells, 3)), random.random((len(mesh.boundary_centres), 3))
    faces[mesh.patch_start[2] :] = 0.0
    u, _ = Reconstruction(mesh)(cells, faces)
    on_wall = np.hypot(mesh.points[:, 1], mesh.points[:, 2]) > 1.0 - 1e-9
    assert on_wall.sum() == 24 * 5
    assert np.all(u[: mesh.n_points][on_wall] == 0.0)
    assert np.all(u[: mesh.n_points][~on_wall] != 0.0)


def test_a_sliding_wall_is_exact(random):
    shape = pipe(4)
    mesh = build_mesh(shape, pipe_patches(shape))
    faces = random.random((len(mesh.boundary_centres), 3))
    faces[mesh.patch_start[2] :] = (0.1, -0.7, 1.0 / 3.0)
    u, _ = Reconstruction(mesh)(random.random((mesh.n_cells, 3)), faces)
    on_wall = np.hypot(mesh.points[:, 1], mesh.points[:, 2]) > 1.0 - 1e-9
    assert np.all(u[: mesh.n_points][on_wall] == (0.1, -0.7, 1.0 / 3.0))


@pytest.mark.parametrize("kind", ["symmetryPlane", "empty", "cyclic", "wedge", "processor"])
def test_constraint_patches_have_no_say(kind):
    shape = block(4, 0.2)
    patches = [p if p.name != "lid" else p._replace(type=kind) for p in box_patches(shape)]
    mesh = build_mesh(shape, patches)
    cells, faces = mesh.centres.copy(), mesh.boundary_centres.copy()
    assert mesh.patches[1] == Patch("lid", kind)
    faces[mesh.patch_start[1] : mesh.patch_start[2]] = np.nan
    u, l = Reconstruction(mesh)(cells, faces)
    assert u == pytest.approx(mesh.nodes, abs=1e-11)
    assert l == pytest.approx(np.broadcast_to(np.eye(3), l.shape), abs=1e-10)


def test_a_mesh_of_one_layer_has_no_gradient_across():
    shape = block(1, 0.0)
    shape.points = np.array(shape.points)
    mesh = build_mesh(shape, [p._replace(type="empty") for p in box_patches(shape)])
    u, l = Reconstruction(mesh)(np.ones((1, 3)), np.zeros((6, 3)))
    assert np.all(u == 1.0)
    assert np.all(l == 0.0)


@cache
def pipe_errors():
    """Rms errors of u (core, wall) and ∇u (core, wall) on three pipes; mean velocity and wall shear are 1."""
    rng = np.random.default_rng(0)
    n = 20_000
    r, angle, x = np.sqrt(rng.random(n)), 2.0 * np.pi * rng.random(n), 0.1 + 0.8 * rng.random(n)
    points = np.column_stack([x, r * np.cos(angle), r * np.sin(angle)])
    rows = []
    for cells in (8, 16, 32):
        shape = pipe(cells)
        mesh = build_mesh(shape, pipe_patches(shape))
        boundary = poiseuille(mesh.boundary_centres)[0]
        boundary[mesh.patch_start[2] :] = 0.0
        flow = MeshFlow(mesh, *Reconstruction(mesh)(poiseuille(mesh.centres)[0], boundary))
        hosts = flow.locate(points)
        inside, core = hosts >= 0, r < 0.9
        u, l = flow.sample(points[inside], hosts[inside], 0.0)
        exact_u, exact_l = poiseuille(points[inside])
        off_u = np.linalg.norm(u - exact_u, axis=1)
        off_l = np.linalg.norm(l - exact_l, axis=(1, 2)) / 4.0
        rows.append(
            [np.sqrt(np.mean(off[part[inside]] ** 2)) for off in (off_u, off_l) for part in (core, ~core)]
        )
    return np.array(rows)


def poiseuille(x):
    u, l = np.zeros((len(x), 3)), np.zeros((len(x), 3, 3))
    u[:, 0] = 2.0 * (1.0 - x[:, 1] ** 2 - x[:, 2] ** 2)
    l[:, 0, 1:] = -4.0 * x[:, 1:]
    return u, l


def test_velocity_converges_to_second_order():
    errors = pipe_errors()[:, :2]
    assert np.all(np.log2(errors[:-1] / errors[1:]) > 1.8)
    assert np.all(errors[-1] < 1e-3)


def test_gradient_converges_to_first_order_at_least():
    errors = pipe_errors()[:, 2:]
    assert np.all(np.log2(errors[:-1] / errors[1:]) > 0.9)
    assert errors[-1, 0] < 2e-4
    assert errors[-1, 1] < 1e-2
