from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_shapes import (
    KINDS,
    block,
    boundary,
    box_patches,
    corners,
    cyclic_row,
    grid,
    merged,
    period,
    pipe,
    pipe_patches,
    wedge,
    wedge_patches,
)
from scipy.spatial import KDTree

from foamprb.flow.base import Patch
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction, from_points

vectors = st.lists(st.floats(-3.0, 3.0), min_size=12, max_size=12)


@given(st.sampled_from(KINDS), st.floats(0.0, 0.5), st.integers(0, 1000), vectors)
@settings(max_examples=40)
def test_linear_fields_are_reproduced(kind, perturbation, seed, numbers):
    shape = block(2, perturbation, kind, seed)
    # Walls do not stretch.
    mesh = build_mesh(shape, [p._replace(type="patch") for p in box_patches(shape)])
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


@pytest.mark.parametrize(
    ("kind", "error"),
    [("hexahedra", 0.0015), ("tetrahedra", 0.0015), ("polyhedra", 0.0022), ("prisms", 0.003)],
)
def test_cells_of_every_shape_reproduce_quadratic_fields(kind, error):
    """Off the walls; from the neighbours alone the errors are 0.0012, 0.013, 0.0026 and 0.0062."""
    shape = block(6, 0.3, kind)
    mesh = build_mesh(shape, box_patches(shape))
    _, l = Reconstruction(mesh)(quadratic(mesh.centres)[0], quadratic(mesh.boundary_centres)[0])
    inside = np.abs(mesh.nodes - 0.5).max(axis=1) < 0.25
    assert np.sqrt(np.mean((l - quadratic(mesh.nodes)[1])[inside] ** 2)) < error


@pytest.mark.parametrize("kind", ["tetrahedra", "polyhedra"])
def test_a_value_that_an_outlet_has_of_its_cell_is_continued_to_its_face(kind):
    """Poiseuille's flow between plates; the cells' centres do not lie opposite those of the faces."""

    def flow(x):
        return np.column_stack([1.0 - (2.0 * x[:, 1] - 1.0) ** 2, np.zeros((len(x), 2))])

    shape = block(6, 0.3, kind)
    mesh = build_mesh(shape, [p._replace(type="patch") for p in box_patches(shape)])
    boundary, cells = flow(mesh.boundary_centres), flow(mesh.centres)
    ends = np.abs(mesh.boundary_centres[:, 0] - 0.5) > 0.499
    boundary[ends] = cells[mesh.owner[mesh.n_internal :]][ends]
    u, _ = Reconstruction(mesh)(cells, boundary)
    assert np.sqrt(np.mean((u - flow(mesh.nodes)) ** 2)) < 2e-3


@pytest.mark.parametrize("v", [(0.0, 0.0, 0.0), (0.1, -0.7, 1.0 / 3.0)], ids=["at rest", "sliding"])
def test_the_velocity_of_a_wall_is_exact_at_every_point_of_it(v, random):
    shape = pipe(6)
    mesh = build_mesh(shape, pipe_patches(shape))
    cells, faces = random.random((mesh.n_cells, 3)), random.random((len(mesh.boundary_centres), 3))
    faces[mesh.patch_start[2] :] = v
    u, _ = Reconstruction(mesh)(cells, faces)
    on_wall = np.hypot(mesh.points[:, 1], mesh.points[:, 2]) > 1.0 - 1e-9
    assert on_wall.sum() == 24 * 5
    assert np.all(u[: mesh.n_points][on_wall] == v)
    assert np.all(u[: mesh.n_points][~on_wall] != v)


@pytest.mark.parametrize("kind", ["cyclic", "cyclicAMI", "processor"])
def test_coupled_patches_without_partner_have_no_say(kind):
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
    assert np.all(u == [1.0, 1.0, 0.0])
    assert np.all(l == 0.0)


def swirl_free(x):
    """u_r = r z, u_θ = r (1 + z), u_z = r² − z² about the z axis."""
    u = np.column_stack(
        [
            x[:, 0] * x[:, 2] - x[:, 1] * (1.0 + x[:, 2]),
            x[:, 1] * x[:, 2] + x[:, 0] * (1.0 + x[:, 2]),
            x[:, 0] ** 2 + x[:, 1] ** 2 - x[:, 2] ** 2,
        ]
    )
    l = np.zeros((len(x), 3, 3))
    l[:, 0, 0] = l[:, 1, 1] = x[:, 2]
    l[:, 0, 1], l[:, 1, 0] = -1.0 - x[:, 2], 1.0 + x[:, 2]
    l[:, 0, 2], l[:, 1, 2] = x[:, 0] - x[:, 1], x[:, 1] + x[:, 0]
    l[:, 2] = 2.0 * x
    l[:, 2, 2] *= -1.0
    return u, l


def test_a_wedge_of_one_layer_has_the_gradient_of_the_whole(random):
    shape = wedge(16)
    mesh = build_mesh(shape, wedge_patches(shape))
    assert [patch.neighbour for patch in mesh.patches] == ["back", "front", "", ""]
    u, l = Reconstruction(mesh)(swirl_free(mesh.centres)[0], swirl_free(mesh.boundary_centres)[0])
    exact_u, exact_l = swirl_free(mesh.nodes)
    h = 1.0 / 16.0
    # A corner that has but one face of the wall moves like that face.
    corner = (mesh.nodes[:, 0] > 0.99) & (np.abs(mesh.nodes[:, 2] - 0.5) > 0.49)
    assert u[~corner] == pytest.approx(exact_u[~corner], abs=h**2)
    assert u[corner] == pytest.approx(exact_u[corner], abs=h)
    assert l == pytest.approx(exact_l, abs=0.5 * h)
    axis = np.hypot(*mesh.nodes[:, :2].T) < 1e-9
    assert np.count_nonzero(axis) == 17
    assert np.all(u[axis, :2] == 0.0)
    assert l[axis, 0, 0] == pytest.approx(l[axis, 1, 1], abs=1e-14)
    assert l[axis, 0, 1] == pytest.approx(-l[axis, 1, 0], abs=1e-14)
    flow = MeshFlow(mesh, u, l)
    points = np.column_stack([random.uniform(0.02, 0.98, 500), np.zeros(500), random.uniform(0.0, 1.0, 500)])
    u, l = flow.sample(points, flow.locate(points), 0.0)
    assert u == pytest.approx(swirl_free(points)[0], abs=h**2)
    assert l == pytest.approx(swirl_free(points)[1], abs=h)


@pytest.mark.parametrize("kind", ["symmetryPlane", "symmetry"])
def test_half_of_a_symmetric_flow_is_half_of_the_whole(kind, random):
    mirror = np.array([1.0, 1.0, -1.0])
    shape = block(4, 0.2)
    half = build_mesh(shape, [p._replace(type=kind) if p.name == "floor" else p for p in box_patches(shape)])
    twin = shape.copy()
    twin.points = twin.points * mirror
    whole = build_mesh(merged([twin, shape]))
    cells = random.random((half.n_cells, 3))
    above = whole.centres[:, 2] > 0.0
    field = cells[KDTree(half.centres).query(np.abs(whole.centres))[1]]
    field[~above] *= mirror
    u, l = unbounded(half, cells)
    whole_u, whole_l = unbounded(whole, field)
    same = KDTree(whole.nodes).query(half.nodes)[1]
    assert u == pytest.approx(whole_u[same], abs=1e-12)
    assert l == pytest.approx(whole_l[same], abs=1e-11)
    plane = np.abs(half.nodes[:, 2]) < 1e-9
    assert np.count_nonzero(plane) == 25
    assert np.all(np.abs(u[plane, 2]) < 1e-15)
    assert np.all(np.abs(l[plane][:, [0, 1, 2, 2], [2, 2, 0, 1]]) < 1e-14)


def unbounded(mesh, cells):
    """A reconstruction from the values of the cells alone."""
    n = len(mesh.boundary_centres)
    return Reconstruction(mesh, valued=np.zeros(n, dtype=bool))(cells, np.zeros((n, 3)))


def test_a_plane_mesh_has_no_gradient_across():
    points, hexes = corners(6, 0.0)
    shape = grid(points[:98], [(12, hexes[:36])])
    patches = boundary(
        shape,
        lambda x: "planes" if min(x[2], abs(x[2] - 1.0 / 6.0)) < 1e-9 else "sides",
        {"planes": "empty", "sides": "wall"},
    )
    mesh = build_mesh(shape, patches)
    gradient = np.array([[1.0, 2.0, 0.0], [3.0, -1.0, 0.0], [0.5, -0.25, 0.0]])
    u, l = Reconstruction(mesh)(mesh.centres @ gradient.T, mesh.boundary_centres @ gradient.T)
    # Nothing goes across the plane.
    gradient[2] = 0.0
    assert l == pytest.approx(np.broadcast_to(gradient, l.shape), abs=1e-12)
    assert u == pytest.approx(mesh.nodes @ gradient.T, abs=1e-12)


@pytest.mark.parametrize("angle", [0.0, 60.0])
def test_a_flow_goes_on_beyond_a_cyclic_patch(angle, random):
    """One period beside three of it in a row, straight or around a corner."""
    turn, shift = period(angle)
    one, three = cyclic_row(angle, 1), cyclic_row(angle, 3)
    field = random.random((one.n_cells, 3))
    u, l = unbounded(one, field)
    all_u, all_l = unbounded(three, np.concatenate([field, field @ turn.T, field @ turn.T @ turn.T]))
    middle = one.nodes @ turn.T + shift
    same = KDTree(three.nodes).query(middle)[1]
    assert three.nodes[same] == pytest.approx(middle, abs=1e-12)
    assert all_u[same] == pytest.approx(u @ turn.T, abs=1e-12)
    assert all_l[same] == pytest.approx(turn @ l @ turn.T, abs=1e-11)
    here, there = one.couplings[0].faces, one.couplings[0].partners
    assert len(here) == 16
    assert one.boundary_centres[here] @ turn.T + shift == pytest.approx(
        one.boundary_centres[there], abs=1e-12
    )


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


def test_scalars_stay_between_the_values_around_and_are_those_of_walls_on_them(random):
    shape = block(3, 0.3)
    mesh = build_mesh(shape, box_patches(shape))
    walls = [patch.type == "wall" for patch in mesh.patches]
    cells, faces = random.random((mesh.n_cells, 3)), random.random((len(mesh.boundary_centres), 3))
    values, slopes = Reconstruction(mesh).scalars(cells, faces)
    assert values.shape == (len(mesh.nodes), 3)
    assert slopes.shape == (len(mesh.nodes), 3, 3)
    np.testing.assert_array_equal(values[mesh.n_points :], cells)
    patch_of = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
    for p in range(mesh.n_points):
        own = [
            f for f in range(len(patch_of))
            if p in mesh.face_points[slice(*mesh.face_start[mesh.n_internal + f :][:2])]
        ]  # fmt: skip
        of_walls = [f for f in own if walls[patch_of[f]]]
        if of_walls:
            np.testing.assert_allclose(values[p], faces[of_walls].mean(axis=0), rtol=1e-12)
            continue
        around = [c for c in range(mesh.n_cells)
                  if p in mesh.cell_points[slice(*mesh.cell_point_start[c : c + 2])]]  # fmt: skip
        sites = np.concatenate([mesh.centres[around], mesh.boundary_centres[own]])
        w = 1.0 / np.linalg.norm(sites - mesh.points[p], axis=1)
        mean = w @ np.concatenate([cells[around], faces[own]]) / w.sum()
        np.testing.assert_allclose(values[p], mean, rtol=1e-12)


def test_slopes_of_scalars_are_those_of_a_linear_field(random):
    """At every node; on a plane of symmetry only along it."""
    slope = random.normal(size=(3, 3))
    for kind in ("wall", "symmetryPlane"):
        slope[:, 2] = 0.0 if kind == "symmetryPlane" else slope[:, 2]
        shape = block(3, 0.3)
        patches = [p._replace(type=kind) if p.name == "floor" else p for p in box_patches(shape)]
        mesh = build_mesh(shape, patches)
        values, slopes = Reconstruction(mesh).scalars(mesh.centres @ slope.T, mesh.boundary_centres @ slope.T)
        np.testing.assert_allclose(slopes, np.broadcast_to(slope, slopes.shape), atol=1e-10)
        assert values[mesh.n_points :] == pytest.approx(mesh.centres @ slope.T)
