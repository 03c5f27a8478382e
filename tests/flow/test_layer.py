"""Two-dimensional and axisymmetric flows, on meshes one cell thick."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import boundary, grid, wedge, wedge_patches

from foamprb.compile.link import link
from foamprb.flow.curvatures import mean_curvatures, third_order
from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow
from foamprb.flow.walk import curvature as walk_curvature

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


ANGLES = np.radians([-2.49, -1.0, 0.0, 1.7, 2.49])


def pipe_in_a_wedge(n, swirl=0.0):
    """u_z = 2 (1 − r²) and a vortex ring between a wall and the axis, with ``swirl`` r about the axis."""
    shape = wedge(n)
    mesh = build_mesh(shape, wedge_patches(shape))
    edge = np.cos(np.radians(2.5))

    def velocity(x):
        r, z = np.hypot(x[:, 0], x[:, 1]) / edge, np.pi * x[:, 2]
        ring = 0.2 * (1.0 - r**2) ** 2 * np.cos(z)
        return np.column_stack(
            [
                -np.pi * ring * x[:, 0] - swirl * x[:, 1],
                -np.pi * ring * x[:, 1] + swirl * x[:, 0],
                2.0 * (1.0 - r**2) + 0.4 * (1.0 - r**2) * (1.0 - 3.0 * r**2) * np.sin(z),
            ]
        )

    given = velocity(mesh.boundary_centres)
    start = mesh.patch_start[[patch.name for patch in mesh.patches].index("wall")]
    given[start:] = np.array([-swirl, swirl, 0.0]) * mesh.boundary_centres[start:, [1, 0, 2]]
    u, l = Reconstruction(mesh)(velocity(mesh.centres), given)
    return mesh, (u, l, Conservation(mesh)(u, l)), velocity


def at_angles(flow, rho, z):
    """Return velocities (angles, n, 3) and gradients in the frame of the middle plane, over 1/cos θ."""
    values, gradients = [], []
    for angle in ANGLES:
        x = np.column_stack([rho, rho * np.tan(angle), z])
        u, l = flow.sample(x, flow.locate(x), 0.0)
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        values.append(u @ turn.T * [c, c, 1.0])
        gradients.append(turn @ l @ turn.T)
    return np.array(values), np.array(gradients)


@pytest.mark.parametrize("swirl", [0.0, 0.5])
def test_a_wedge_has_the_flow_of_its_middle_plane_at_all_angles(swirl, random):
    mesh, (u, l, fluxes), exact = pipe_in_a_wedge(12, swirl)
    flow = MeshFlow(mesh, u, l, fluxes=fluxes)
    rho, z = random.uniform(0.0, 0.99, 400), random.uniform(0.01, 0.99, 400)
    u, l = at_angles(flow, rho, z)
    # To round-off, and to single precision, in which the correction is stored.
    assert u[:, :, 1] == pytest.approx(np.broadcast_to(swirl * rho, u.shape[:2]), abs=2e-3 * swirl + 1e-15)
    assert np.ptp(u, axis=0).max() < 1e-8
    assert np.ptp(l, axis=0).max() < 1e-13
    if swirl == 0.0:
        assert np.abs(l[:, :, [0, 1, 1, 2], [1, 0, 2, 1]]).max() < 1e-14
    x = np.column_stack([rho, np.zeros(400), z])
    assert np.sqrt(np.mean((u[2] - exact(x)) ** 2)) < 1e-3
    hosts, e = flow.locate(x), 1e-6
    ends = [[flow.sample(x + s * e * d, hosts, 0.0)[0] @ d for s in (1.0, -1.0)] for d in np.eye(3)]
    divergence = sum(a - b for a, b in ends) / (2.0 * e)
    assert np.sqrt(np.mean(divergence**2)) < 3e-3


def test_a_uniform_stream_along_the_axis_of_a_wedge_is_uniform():
    shape = wedge(3)
    mesh = build_mesh(
        shape, [p._replace(type="patch") if p.name == "wall" else p for p in wedge_patches(shape)]
    )
    along = np.array([0.0, 0.0, 1.0])
    u, l = Reconstruction(mesh)(mesh.centres * 0.0 + along, mesh.boundary_centres * 0.0 + along)
    assert u == pytest.approx(np.broadcast_to(along, u.shape), abs=1e-13)
    fluxes = Conservation(mesh)(u, l)[mesh.n_internal :]
    assert fluxes == pytest.approx(mesh.boundary_areas[:, 2], abs=1e-15)
    flow = MeshFlow(mesh, u, l)
    assert flow.at_nodes()[1] == pytest.approx(np.broadcast_to(along, flow.mesh.nodes.shape), abs=1e-13)


def test_points_in_a_wedge_keep_their_angle_and_the_stream_function(random):
    """Points at all angles cover the same way, in a flow in closed form."""
    mesh, (u, l, fluxes), _ = pipe_in_a_wedge(12)
    flow = MeshFlow(mesh, u, l, fluxes=fluxes)
    rho, tangents = np.repeat(random.uniform(0.02, 0.95, 40), len(ANGLES)), np.tile(np.tan(ANGLES), 40)
    x, dt = np.column_stack([rho, rho * tangents, np.full(200, 0.05)]), 2e-3

    def stream(x):
        square = (x[:, 0] / np.cos(np.radians(2.5))) ** 2
        return x[:, 0] ** 2 * (1.0 - 0.5 * square + 0.2 * (1.0 - square) ** 2 * np.sin(np.pi * x[:, 2]))

    start = stream(x)
    for _ in range(200):
        half = x + 0.5 * dt * flow.sample(x, flow.locate(x), 0.0)[0]
        x = x + dt * flow.sample(half, flow.locate(half), 0.0)[0]
    assert np.ptp(x[:, 0] / rho) > 0.05
    assert x[:, 1] == pytest.approx(x[:, 0] * tangents, abs=1e-15)
    assert np.ptp(x.reshape(40, -1, 3)[:, :, [0, 2]], axis=1).max() < 1e-8
    assert stream(x) == pytest.approx(start, abs=5e-4)


@pytest.mark.parametrize("reconstructed", [False, True])
def test_second_derivatives_and_a_transient_flow_in_a_wedge_are_turned(reconstructed, random):
    """Those of the middle plane, where ∇²u_z of Poiseuille's flow is −8; half of it is around the axis."""
    mesh, values, _ = pipe_in_a_wedge(12, 0.5)
    bent = mean_curvatures(mesh, values[1]) if reconstructed else None
    steady = MeshFlow(mesh, *values[:2], fluxes=values[2], curvatures=bent)
    options = {"conservative": True, "curved": reconstructed}
    values = (*values, bent) if reconstructed else values
    series = SeriesFlow(mesh, [0.0, 2.0], lambda k: tuple((1 + k) * a for a in values), **options)
    rho, z = random.uniform(0.1, 0.8, 20), random.uniform(0.2, 0.8, 20)
    found = []
    for angle in ANGLES:
        x = np.column_stack([rho, rho * np.tan(angle), z])
        hosts = series.locate(x)
        assert series.sample(x, hosts, 1.0)[0] == pytest.approx(
            1.5 * steady.sample(x, hosts, 0.0)[0], abs=1e-6
        )
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        both = []
        for flow, t, factor in ((steady, 0.0, 1.0), (series, 1.0, 1.5)):
            curvature, arrays = link(flow.kernels["curvature"]), flow.arrays()
            h = np.array([curvature(arrays, i, tuple(y), t) for i, y in zip(hosts, x, strict=True)]) / factor
            if flow is steady and not reconstructed:
                at_once = walk_curvature(arrays, hosts, tuple(x.T), t)
                assert np.moveaxis(at_once, 2, 0) == pytest.approx(h, abs=1e-9)
            both.append(np.einsum("ai,bj,ck,nijk->nabc", turn, turn, turn, third_order(h.reshape(-1, 18))))
        assert both[1] == pytest.approx(both[0], abs=1e-5)
        found.append(both[0])
    assert np.ptp(found, axis=0).max() < 1e-5
    square, sine, edge = (rho / np.cos(np.radians(2.5))) ** 2, np.sin(np.pi * z), np.cos(np.radians(2.5))
    ring = (48.0 * square - 16.0) / edge**2 - np.pi**2 * (1.0 - square) * (1.0 - 3.0 * square)
    laplacian = np.einsum("nijj->ni", found[2])[:, 2]
    error = laplacian - (-8.0 / edge**2 + 0.4 * ring * sine)
    assert np.sqrt(np.mean(error**2)) < 0.06 * np.abs(laplacian).mean()
