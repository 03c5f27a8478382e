"""The flow in tetrahedra and prisms, whose nodes mostly lie on walls."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, pipe, pipe_patches

from foamprb.flow.fluxes import Conservation, free_nodes
from foamprb.flow.jumps import count_jumps, medians, relative_jumps
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction, wall_offsets

LENGTH = 4.0


def poiseuille(x):
    u = np.zeros_like(x)
    u[:, 0] = 2.0 * np.maximum(1.0 - x[:, 1] ** 2 - x[:, 2] ** 2, 0.0)
    return u


def meshed(kind, n=6):
    """A pipe of radius 1 m: hexahedra, or tetrahedra with the same points."""
    shape = pipe(n, 10, length=LENGTH)
    if kind == "tetrahedra":
        shape = shape.triangulate()
    return build_mesh(shape, pipe_patches(shape, LENGTH))


def flowing(mesh):
    """Poiseuille's flow from exact values at cells and at rest on walls: with its correction, and without."""
    boundary = poiseuille(mesh.boundary_centres)
    boundary[walls_of(mesh)] = 0.0
    u, l = Reconstruction(mesh)(poiseuille(mesh.centres), boundary)
    return MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l)), MeshFlow(mesh, u, l)


def walls_of(mesh):
    k = [patch.name for patch in mesh.patches].index("wall")
    return np.arange(mesh.patch_start[k], mesh.patch_start[k + 1])


def places(flow, random, n=20_000):
    """Points off the ends, their hosts, and distances from the axis."""
    r, angle = np.sqrt(random.random(n)), 2.0 * np.pi * random.random(n)
    x = np.column_stack([LENGTH * random.uniform(0.2, 0.8, n), r * np.cos(angle), r * np.sin(angle)])
    hosts = flow.locate(x)
    return x[hosts >= 0], hosts[hosts >= 0], r[hosts >= 0]


@pytest.fixture(scope="module")
def tetrahedra():
    return flowing(meshed("tetrahedra"))


def test_the_correction_is_of_the_size_of_the_error(tetrahedra, random):
    """The few nodes off walls need not carry what the velocity along edges to walls lacks."""
    x, hosts, _ = places(tetrahedra[0], random)
    with_c, without = (
        np.linalg.norm(flow.sample(x, hosts, 0.0)[0] - poiseuille(x), axis=1) for flow in tetrahedra
    )
    rms = [np.sqrt(np.mean(e**2)) for e in (with_c, without)]
    assert rms[1] < 0.006
    assert rms[0] < 1.8 * rms[1]
    assert with_c.max() < 2.0 * without.max()


def test_the_gradient_at_a_curved_wall(tetrahedra, random):
    """The faces are chords: their centres are inside the pipe, where the fluid is not at rest."""
    x, hosts, r = places(tetrahedra[0], random)
    near = r > 0.9
    l = tetrahedra[0].sample(x[near], hosts[near], 0.0)[1]
    assert np.linalg.norm(l, axis=(1, 2)) / (4.0 * r[near]) == pytest.approx(1.0, abs=0.07)
    assert np.mean(np.linalg.norm(l, axis=(1, 2)) / (4.0 * r[near])) == pytest.approx(1.0, abs=0.03)


def test_walls_lie_outside_their_faces_by_the_height_of_the_arc():
    mesh = meshed("tetrahedra", 8)
    walls = walls_of(mesh)
    centres = mesh.boundary_centres[walls]
    r = np.hypot(centres[:, 1], centres[:, 2])
    inside = (centres[:, 0] > 0.2 * LENGTH) & (centres[:, 0] < 0.8 * LENGTH)
    moved = centres + wall_offsets(mesh, walls)
    outside = np.hypot(moved[:, 1], moved[:, 2])
    assert np.mean(1.0 - r[inside]) > 4e-3
    assert outside[inside] == pytest.approx(1.0, abs=5e-4)
    assert wall_offsets(meshed("hexahedra"), walls_of(meshed("hexahedra"))) == pytest.approx(0.0, abs=0.0)


def test_a_sharp_edge_is_not_round():
    """Walls of a box are flat up to its edges."""
    mesh = build_mesh(block(3, 0.2, "tetrahedra"))
    assert wall_offsets(mesh, np.arange(len(mesh.boundary_centres))) == pytest.approx(0.0, abs=1e-15)


def test_nothing_flows_through_walls_of_tetrahedra(tetrahedra, random):
    mesh = tetrahedra[0].mesh
    on_wall = np.isin(mesh.triangle_face, walls_of(mesh))
    corners = mesh.points[mesh.triangles[on_wall]]
    x = np.einsum("nk,nki->ni", random.dirichlet(np.ones(3), len(corners)), corners)
    assert np.all(free_nodes(mesh)[mesh.triangles[on_wall]] == -1.0)
    u = tetrahedra[0].sample(x, mesh.triangle_tet[on_wall], 0.0)[0]
    through = np.einsum("ni,ni->n", u, mesh.triangle_normals[on_wall])
    # The correction is stored in single precision.
    assert np.abs(through).max() < 1e-6 * np.abs(u).max()


def test_gradients_change_by_their_relative_jumps():
    """The mean difference from the neighbours over the norm, at most 1; the flow itself stays as it is."""
    l = np.zeros((4, 9))
    l[:, 1] = [1.0, 2.0, 2.0, 0.0]
    jumps = relative_jumps(l, np.array([0, 1, 2]), np.array([1, 2, 3]))
    np.testing.assert_allclose(jumps, [1.0, 0.25, 0.5, 1.0])
    shape = block(2, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    shear = np.zeros((len(mesh.nodes), 3, 3))
    # Half as large in the cells with x > ½: of the three faces of a cell, one has a jump.
    shear[:, 0, 1] = np.where(mesh.nodes[:, 0] > 0.5, 1.0, 2.0)
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), shear)
    cells = mesh.centres[:, 0] > 0.5
    rates = flow.with_jumps(0.1).at_nodes()[2][mesh.n_points :, 1]
    np.testing.assert_allclose(rates, np.where(cells, 1.0 + 0.1 / 3.0, 2.0 + 0.1 / 3.0))
    np.testing.assert_allclose(flow.at_nodes()[2][mesh.n_points :, 1], np.where(cells, 1.0, 2.0))


def test_jumps_of_the_gradient():
    """Cells whose gradients differ by 2 %, 2 % and 100 %; the last at a wall."""
    l = np.outer([1.0, 1.02, 1.04, 3.12], np.eye(3).ravel())
    first, second = np.arange(3), np.arange(1, 4)
    counts = count_jumps(l, first, second, np.array([False, False, False, True]))
    assert counts.sum(axis=1).tolist() == [3, 1]
    assert medians(counts) == pytest.approx((0.02, 1.0), rel=0.05)
    halves = [count_jumps(l, first[k], second[k], np.zeros(4, dtype=bool)) for k in (slice(2), slice(2, 3))]
    assert np.array_equal(sum(halves)[0], counts[0])
