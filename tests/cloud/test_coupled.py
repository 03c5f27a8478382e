"""Particles that go on beyond cyclic patches, wedges and symmetry planes, against the whole domain."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, cyclic_row, interfaces, period, rings, wedge, wedge_patches

from foamprb import (
    Cloud,
    Escape,
    InputError,
    Medium,
    Models,
    Rebound,
    Status,
    Stick,
    analytic,
    patch_interactions,
    spheres,
)  # fmt: skip
from foamprb.cloud.patches import Cyclic, Mirror
from foamprb.cloud.state import Particles
from foamprb.compile.link import link
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.walls import gap

AIR = Medium(1.8e-5, 1.2, (0.0, 0.0, 0.0))
F0 = np.array([[1.1, 0.2, 0.1], [0.0, 0.9, 0.3], [0.05, 0.0, 1.0]])
F0 /= np.cbrt(np.linalg.det(F0))
REST = np.diag([1.25, 0.8, 1.0]) @ np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])


def moving(x, v, rho=1000.0):
    p = spheres(x, d=2e-3, rho=rho, mu=1e-3)
    p.v[:] = v
    p.F[:] = F0.ravel()
    p.F0[:] = REST.ravel()
    return p


def linear(mesh, l, u0=(0.0, 0.0, 0.0)):
    l = np.asarray(l, dtype=float)
    return MeshFlow(mesh, mesh.nodes @ l.T + u0, np.broadcast_to(l, (len(mesh.nodes), 3, 3)))


def tracked(particles, flow, interactions, steps):
    cloud = Cloud(particles, flow, AIR, interactions, 1e-3, Models(integrator="paper"), threads=1)
    cloud.advance(steps)
    return cloud


def actions(flow):
    return [
        Cyclic() if p.neighbour else Mirror() if p.type.startswith("symm") else Rebound()
        for p in flow.patches
    ]


@pytest.mark.parametrize("angle", [0.0, 60.0])
def test_one_period_holds_the_whole_path(angle, random):
    assert_paths_go_on(cyclic_row(angle, 1), angle, 1.0, period(angle), random)


@pytest.mark.parametrize("angle", [0.0, 20.0])
def test_faces_that_do_not_fit_one_to_one_are_crossed_like_nothing(angle, random):
    """Round and round through interfaces between blocks cut into 4, 5 and 7 cells a side."""
    mesh, turn, shift = interfaces(angle)
    assert_paths_go_on(mesh, 3.0 * angle, 3.0, (turn, shift), random)


def assert_paths_go_on(mesh, angle, length, motion, random):
    """Particles in a period, straight or a sector of that angle, go as in the whole, up to its motion."""
    turn, shift = motion
    l = np.zeros((3, 3)) if angle == 0.0 else 3.0 * np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 0]])
    u0 = np.array([4.0 * length, 0.0, 0.0] if angle == 0.0 else [0.0, 0.0, 0.0])
    flow = linear(mesh, l, u0)
    x = np.column_stack([random.uniform(0.1, 0.4, (20, 2)), random.uniform(0.3, 0.7, 20)])
    if angle:
        x[:, :2] = [1.0, 0.8] + 0.1 * (x[:, :2] - 0.25)
    v = x @ l.T + u0
    cloud = tracked(moving(x, v, 5.0), flow, actions(flow), 500)
    free = tracked(moving(x, v, 5.0), analytic.linear(l, u0), [], 500)
    p, q = cloud.particles, free.particles
    assert np.all(p.status == Status.ACTIVE)
    assert cloud.recovered == 0
    y, rotation = q.x.copy(), np.broadcast_to(np.eye(3), (20, 3, 3)).copy()
    for _ in range(5):
        beyond = y[:, 0] > length if angle == 0.0 else ~_in_sector(y, angle)
        y[beyond] = (y[beyond] - shift) @ turn
        rotation[beyond] = turn.T @ rotation[beyond]
    assert np.any(y != q.x)
    assert p.x == pytest.approx(y, abs=1e-9)
    assert p.v == pytest.approx(np.einsum("nij,nj->ni", rotation, q.v), abs=1e-8)
    for name in ("F", "A"):
        ours, theirs = (getattr(c, name).reshape(-1, 3, 3) for c in (p, q))
        assert ours == pytest.approx(rotation @ theirs, abs=1e-7)


def _in_sector(x, angle):
    at = np.degrees(np.arctan2(x[:, 1], x[:, 0]))
    return (at >= 0.0) & (at <= angle)


def test_straight_paths_through_rings_that_slide_on_each_other_stay_straight():
    """Between the chords of 24 and of 36 segments the place is kept, also where a path grazes them."""
    mesh = rings()
    assert [(c.patch, c.other) for c in mesh.couplings] == [(0, 3), (3, 0)]
    flow = linear(mesh, np.zeros((3, 3)))
    a = 2.0 * np.pi * (np.arange(200) + 0.3) / 200
    r, across = (np.column_stack([f(a), g(a), 0.0 * a]) for f, g in ((np.cos, np.sin), (np.sin, np.cos)))
    along = across * [-1.0, 1.0, 1.0]
    lanes = [(0.8 * r, r), (1.25 * r, -r), (0.995 * r - 0.2 * along, along), (1.002 * r - 0.2 * along, along)]
    x, v = (np.concatenate([lane[k] for lane in lanes]) for k in range(2))
    p = moving(x + np.array([0.0, 0.0, 0.4]), v + np.array([0.0, 0.0, 0.3]), 1e13)
    expected = p.x + 0.4 * p.v
    cloud = tracked(p, flow, actions(flow), 400)
    assert np.all(cloud.particles.status == Status.ACTIVE)
    assert cloud.recovered == 0
    assert cloud.particles.x == pytest.approx(expected, abs=1e-6)


def test_bodies_that_run_along_an_interface_go_on():
    """On a circle between the chords of 24 and of 36 segments, with a fluid that turns as a whole."""
    mesh, l = rings(), np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    flow, r = linear(mesh, l), np.linspace(0.988, 1.004, 41)
    start = np.column_stack([r, 0.0 * r, np.full(41, 0.5)])
    bodies = spheres(start, d=1e-5, rho=1.2, mu=1e-3)
    bodies.v[:] = (start - [0.0, 0.0, 0.5]) @ l.T
    cloud = Cloud(bodies, flow, AIR, actions(flow), 5e-2, threads=1)
    cloud.advance(10)
    x, y, _ = bodies.x.T
    assert np.arctan2(y, x) == pytest.approx(0.5, abs=1e-5)
    assert np.hypot(x, y) == pytest.approx(r, abs=1e-5)


def test_an_interaction_of_a_coupled_patch_is_refused():
    """Stick at walls and Escape elsewhere lost the bodies at cyclic patches."""
    flow = linear(cyclic_row(0.0, 1), np.zeros((3, 3)))
    p = moving([[0.5, 0.5, 0.5]], [0.0, 0.0, 0.0])
    walls = [Stick() if patch.type == "wall" else Escape() for patch in flow.patches]
    with pytest.raises(InputError, match=r"the patch left is coupled with right.*has the interaction Escape"):
        Cloud(p, flow, AIR, walls, 1e-3)
    assert Cloud(p, flow, AIR, walls, 1e-3, decoupled=("left", "right")).interactions == walls
    assert [i.code for i in patch_interactions(flow)] == [4, 4, *(i.code for i in walls[2:])]


def test_a_snapshot_has_a_copy_of_shapes_at_rest_if_a_mirror_changes_them():
    """Else the cloud's own serve."""
    shape, copied = block(4, 0.2), []
    l = np.diag([-0.1, -0.1, 0.2])
    for kind in ("symmetryPlane", "wall"):
        patches = [p._replace(type=kind) if p.name == "floor" else p for p in box_patches(shape)]
        flow = linear(build_mesh(shape, patches), l)
        p = moving(np.array([[0.5, 0.5, 0.1]]), np.array([[0.1, 0.02, -1.0]]))
        cloud = tracked(p, flow, actions(flow), 1)
        snapshot, before = cloud.snapshot(), Particles(*(array.copy() for array in cloud.particles))
        cloud.advance(300)
        now = cloud.particles
        changed = {name for name in Particles._fields if (getattr(now, name) != getattr(before, name)).any()}
        assert {"x", "F"} < changed <= cloud.tracker.changing
        copied.append("F0" in changed)
        for name, kept, then in zip(Particles._fields, snapshot.particles, before, strict=True):
            np.testing.assert_array_equal(kept, then, err_msg=name)
    assert copied == [True, False]


def test_a_wedge_is_left_on_one_side_and_entered_on_the_other():
    """Past the axis at a twentieth of the radius: radius and height are those of a straight path."""
    shape = wedge(8)
    flow = linear(build_mesh(shape, wedge_patches(shape)), np.zeros((3, 3)))
    x, v = np.array([[0.5, 0.0, 0.4]]), np.array([[-1.0, 0.1, 0.2]])
    p = moving(x, v)
    p.rho[:] = 1e13
    cloud = Cloud(p, flow, AIR, actions(flow), 1e-2, Models(integrator="paper"), threads=1)
    radii = []
    for step in range(90):
        cloud.advance(1)
        there = x[0] + 1e-2 * (step + 1) * v[0]
        assert p.status[0] == Status.ACTIVE
        assert np.hypot(*p.x[0, :2]) == pytest.approx(np.hypot(*there[:2]), abs=1e-9)
        assert p.x[0, 2] == pytest.approx(there[2], abs=1e-9)
        radii.append(np.hypot(*p.x[0, :2]))
    assert min(radii) == pytest.approx(0.0497, abs=1e-3)
    assert cloud.recovered == 0
    assert np.linalg.det(p.F[0].reshape(3, 3)) == pytest.approx(1.0, abs=1e-6)


def clearances(flow, hosts, x, F, R, gaps):
    for i in range(x.shape[0]):
        f = (F[i, 0], F[i, 1], F[i, 2], F[i, 3], F[i, 4], F[i, 5], F[i, 6], F[i, 7], F[i, 8])
        gaps[i], _, _ = gap(flow, hosts[i], (x[i, 0], x[i, 1], x[i, 2]), f, R)


@pytest.mark.parametrize("angle", [0.0, 60.0])
def test_walls_beyond_a_cyclic_patch_are_touched(angle, random):
    turn, shift = period(angle)
    R, n = 0.05, 200
    along, z = random.choice([0.01, 0.03, 0.97, 0.99], n), random.uniform(0.005, 0.05, n)
    F = random.uniform(-1.0, 1.0, (n, 3, 3))
    F = F / np.cbrt(np.linalg.det(F))[:, None, None]
    F *= 2.0 / np.maximum(np.linalg.norm(F, axis=(1, 2)), 2.0)[:, None, None]
    F = F[np.linalg.det(F) > 0.0]
    x = np.column_stack([along, random.uniform(0.3, 0.7, n), z])[: len(F)]
    if angle:
        t = np.radians(angle) * x[:, 0]
        x[:, :2] = (1.0 + x[:, 1:2]) * np.column_stack([np.cos(t), np.sin(t)])
    found = []
    for flow, at, shapes in (
        (linear(cyclic_row(angle, 1), np.zeros((3, 3))), x, F),
        (linear(cyclic_row(angle, 3), np.zeros((3, 3))), x @ turn.T + shift, turn @ F),
    ):
        gaps = np.empty(len(x))
        link(clearances)(
            flow.arrays(0.2), flow.locate(at), np.ascontiguousarray(at), shapes.reshape(-1, 9), R, gaps
        )
        found.append(gaps)
    near = found[1] < 0.0
    assert np.count_nonzero(near) > 20
    assert found[0][near] == pytest.approx(found[1][near], abs=1e-12)
