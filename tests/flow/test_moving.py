"""Flows on meshes whose pieces move as rigid bodies, against flows that are known in the inertial frame."""

from __future__ import annotations

import re
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from foam_writer import GRADIENT, Format, header, number_list, put_linear, put_scalar, write_case
from mesh_shapes import block, box_patches, layer, rings
from scipy.spatial.transform import Rotation

from foamprb import Cloud, Medium, Models, Rebound, Status, Stick, WallLift, spheres
from foamprb.cloud.patches import Adhere, Cyclic, Mirror
from foamprb.errors import InputError
from foamprb.flow.curvatures import mean_curvatures
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.moving import MovingFlow
from foamprb.flow.read.motion import notes_of, rigid_motion
from foamprb.flow.read.openfoam import read_series
from foamprb.flow.sampling import sample_with

TIMES = ("0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6")
STEP = 0.1
WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))


def no_walls(_index, cells):
    """No wall shows how fast a piece turns."""


def moved_by(mesh, motion, u, l=None, period=None, times=TIMES, curved=False):
    """Return the flow u(x, t), with the gradient l or l(x), on a mesh that ``motion(points, t)`` moves."""
    t = [float(name) for name in times]
    fit = rigid_motion(
        Path("case"), times, lambda name: motion(mesh.points, float(name)), mesh, {}, no_walls, period
    )
    means = {}

    def read(index):
        x = np.einsum("nij,nj->ni", fit.Q[index, fit.nodes(mesh)], mesh.nodes - fit.c[fit.nodes(mesh)])
        x += fit.y[index, fit.nodes(mesh)]
        gradient = np.zeros((3, 3)) if l is None else l(x) if callable(l) else l
        _, W = fit.frame(index, mesh)
        means[index] = fit.means(mesh, u(x, t[index])[mesh.n_points :])
        v = u(x, t[index]) - fit.speed(index, x, fit.nodes(mesh))
        v, gradient = fit.in_frames(index, mesh, v, gradient - W)
        own = replace(mesh, couplings=fit.within(mesh))
        return (v, gradient, mean_curvatures(own, gradient)) if curved else (v, gradient)

    return MovingFlow(fit, means, mesh, t, read, period, curved=curved)


def turned(angle):
    return lambda x, t: Rotation.from_rotvec([0.0, 0.0, angle * t / STEP]).apply(x)


def rotor(angle):
    """The inner ring of ``rings`` turns by an angle a write, radians."""

    def motion(points, t):
        inner = np.hypot(*points[:, :2].T) < 0.99
        inner |= np.arange(len(points)) < len(points) * 2 // 5
        return np.where(inner[:, None], turned(angle)(points, t), points)

    return motion


def open_rings(**shape):
    """Rings without walls, through which a fluid may flow."""
    mesh = rings(**shape)
    return replace(mesh, patches=[p._replace(type="patch") if p.type == "wall" else p for p in mesh.patches])


@pytest.fixture(scope="module")
def stirred():
    """A stream through a ring that turns by 50 degrees a write, and a fluid that turns more slowly."""
    u0, omega = np.array([0.3, 0.1, 0.0]), np.array([0.0, 0.0, 1.5])
    l = np.array([[0.0, -1.5, 0.0], [1.5, 0.0, 0.0], [0.0, 0.0, 0.0]])
    flow = moved_by(open_rings(), rotor(np.radians(50.0)), lambda x, _t: u0 + np.cross(omega, x), l)
    return flow, u0, l


def test_the_motion_of_each_piece_follows_from_the_points(stirred):
    flow = stirred[0]
    note = notes_of(flow.motion, 3.0)
    assert note.startswith("The mesh moves: piece 1 (72 cells) turns with 8.7266 rad/s about (0 0 1), 50 deg")
    assert note.endswith("piece 2 (108 cells) is at rest.")
    assert np.abs(flow.motion.c[0, :2]).max() < 1e-9


def test_a_stream_and_a_turning_fluid_are_exact_at_all_times(stirred, random):
    """Velocity, gradient and acceleration, in the piece that turns and in that at rest."""
    flow, u0, l = stirred
    for t in (0.0, 0.137, 0.3, 0.55):
        a, r = random.uniform(0.0, 2.0 * np.pi, 200), random.uniform(0.52, 1.45, 200)
        x = np.column_stack([r * np.cos(a), r * np.sin(a), random.uniform(0.1, 0.9, 200)])
        hosts = flow.locate(x, t)
        x, hosts = x[hosts >= 0], hosts[hosts >= 0]
        assert len(x) > 190
        u, gradient = flow.sample(x, hosts, t)
        assert u == pytest.approx(u0 + x @ l.T, abs=2e-3)
        assert np.median(np.abs(u - u0 - x @ l.T)) < 1e-9
        assert gradient == pytest.approx(np.broadcast_to(l, gradient.shape), abs=1e-9)
        # Along its own path a point has the velocity at a slightly later time.
        h = 1e-6
        later, _ = sample_with(flow.kernels["sample"], flow.arrays(), x + h * u, hosts, t + h)
        assert (later - u) / h == pytest.approx(u @ l.T, abs=0.1)


def test_a_strain_is_exact_at_each_time_of_the_flow(random):
    """The gradient is turned back, and between the times it is that of the velocity."""
    l = np.array([[0.5, 0.8, 0.1], [0.2, -0.7, 0.3], [-0.4, 0.6, 0.2]])
    flow = moved_by(open_rings(), rotor(np.radians(50.0)), lambda x, _t: x @ l.T, l)
    a, r = random.uniform(0.0, 2.0 * np.pi, 50), random.uniform(0.52, 0.95, 50)
    x = np.column_stack([r * np.cos(a), r * np.sin(a), random.uniform(0.1, 0.9, 50)])
    for t in (0.0, 0.2, 0.3):
        u, gradient = flow.sample(x, flow.locate(x, t), t)
        assert u == pytest.approx(x @ l.T, abs=1e-9)
        assert gradient == pytest.approx(np.broadcast_to(l, gradient.shape), abs=1e-9)
    hosts, h = flow.locate(x, 0.13), 1e-6
    u, gradient = flow.sample(x, hosts, 0.13)
    for k in range(3):
        beside, _ = flow.sample(x + h * np.eye(3)[k], hosts, 0.13)
        assert (beside - u) / h == pytest.approx(gradient[:, :, k], abs=1e-6)


def test_tracers_cross_the_interface_of_a_turning_ring(stirred):
    flow, u0, _ = stirred
    r = np.linspace(0.6, 1.35, 31)
    a = 2.4 * np.arange(31)
    x = np.column_stack([r * np.cos(a), r * np.sin(a), np.full(31, 0.5)])
    bodies = spheres(x, d=1e-6, rho=1000.0, mu=1e3)
    patches = [Cyclic() if p.neighbour else Rebound() for p in flow.patches]
    cloud = Cloud(bodies, flow, WATER, patches, 0.02, threads=1)
    cloud.advance(10)
    angle = 1.5 * 0.2
    # The fluid turns about the point at which it rests.
    centre = np.array([-u0[1], u0[0]]) / 1.5
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    assert np.all(bodies.status == Status.ACTIVE)
    assert bodies.x[:, :2] == pytest.approx(centre + (x[:, :2] - centre) @ turn.T, abs=2e-4)


@pytest.mark.parametrize("angle", [0.0, 50.0])
def test_the_quadratic_mode_between_cylinders_is_that_on_a_mesh_at_rest(angle):
    """Of u = (A r + B/r) e_θ in closed form, within the ring that turns, beside the interface, and outside.

    S = 2i B e^{3iθ}/r³ for S₁₁₁ + i S₁₁₂ turns with 3 (A + B/r²) 1/s, the fluid with A, and the body follows.
    """
    A, B, a, mu_s = -1.1, 2.45, 0.02, 0.1

    def spin(x, _t=0.0):
        return A + B / (x[:, 0] ** 2 + x[:, 1] ** 2)

    def u(x, t):
        return spin(x)[:, None] * np.cross([0.0, 0.0, 1.0], x)

    def gradient(x):
        slope = -2.0 * B * x * [1.0, 1.0, 0.0] / ((x[:, :2] ** 2).sum(axis=1) ** 2)[:, None]
        e = np.cross([0.0, 0.0, 1.0], x)
        turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
        return e[:, :, None] * slope[:, None] + spin(x)[:, None, None] * turn

    mesh = open_rings(around=(48, 72), layers=6)
    flow = moved_by(mesh, rotor(np.radians(angle)), u, gradient, curved=True)
    x = [[0.67, 0.2, 0.5], [-0.35, 0.77, 0.4], [1.2, 0.0, 0.5], [0.976, 0.085, 0.45]]
    p = spheres(x, d=2.0 * a, rho=1e-9, mu=mu_s, poissons_ratio=0.4999)
    thin, models = Medium(1e-3, 1e-9, (0.0, 0.0, 0.0)), Models(integrator="stokes", shape="quadratic")
    patches = [Cyclic() if patch.neighbour else Rebound() for patch in flow.patches]
    Cloud(p, flow, thin, patches, 0.01, models, threads=1).advance(30)
    z, c = p.x[:, 0] + 1j * p.x[:, 1], 1.0 / (19.0 * 1e-3)
    S = 2j * B * z**3 / np.abs(z) ** 6
    expected = 17.5e-3 * a * c * S / (16.0 * mu_s * c + 3j * (spin(p.x) - A))
    off = np.abs(p.B[:, 0] + 1j * p.B[:, 1] - expected) / np.abs(expected)
    assert off[:3].max() < 0.02
    assert off[3] < 0.07


@pytest.mark.parametrize(("writes", "limit"), [(6, 3.5e-3), (12, 8e-4)])
def test_a_fluid_that_is_shaken_with_its_box_stays_in_place(writes, limit):
    """In two dimensions; nothing that begins close to a wall touches it."""
    way = 0.3 * np.array([1.0, 0.4, 0.0])
    flow = moved_by(
        layer((0.0, 1.0), (0.0, 1.0), 10, 10),
        lambda x, t: x + np.sin(2.0 * np.pi * t) * way,
        lambda x, t: np.broadcast_to(2.0 * np.pi * np.cos(2.0 * np.pi * t) * way, x.shape),
        times=[f"{t:.12g}" for t in np.linspace(0.0, 0.7, writes + 1)],
    )
    x = np.column_stack([*np.random.default_rng(0).uniform(0.001, 0.999, (2, 100)), np.full(100, 0.05)])
    bodies = spheres(x, d=1e-6, rho=1000.0, mu=1e3)
    patches = [Mirror() if patch.type == "empty" else Stick() for patch in flow.patches]
    Cloud(bodies, flow, WATER, patches, 0.007, threads=1).advance(100)
    assert np.all(bodies.status == Status.ACTIVE)
    off = bodies.x - x - np.sin(1.4 * np.pi) * way
    assert np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1))) < limit


def test_bodies_that_bonds_hold_for_a_while_turn_with_the_wall_and_the_fluid():
    """Their shape, and the quadratic mode, up to the step at whose end each bond forms."""
    omega, n = np.radians(300.0), 20
    shape = block(3, 0.0)
    mesh = build_mesh(shape, [p._replace(type="wall") for p in box_patches(shape)])
    spin = np.array([[0.0, -omega, 0.0], [omega, 0.0, 0.0], [0.0, 0.0, 0.0]])
    flow = moved_by(mesh, turned(omega * STEP), lambda x, _t: x @ spin.T, spin)
    p = spheres([[0.4, y, 0.01] for y in np.linspace(0.3, 0.7, n)], d=0.02, rho=2000.0, mu=1e-3)
    p.B[:, [0, 3]] = 0.1, -0.1
    models, oil = Models(integrator="stokes", shape="quadratic"), Medium(1.0, 1000.0, (0.0, 0.0, -9.81))
    walls = [Adhere(kOn=30.0, kOff=20.0)] * len(flow.patches)
    cloud = Cloud(p, flow, oil, walls, 0.005, models, threads=1)
    cloud.advance(60)
    now, turn = cloud.comm.rank.at_instant(0.3, False), np.exp(1j * omega * 0.3)
    assert p.bonds.max() > 1
    assert 3 < np.count_nonzero(now.status == Status.STUCK) < n - 3
    assert now.F[:, 0] + 1j * now.F[:, 3] == pytest.approx(np.full(n, turn), abs=2e-3)
    off = (now.B[:, 0] + 1j * now.B[:, 1]) / (0.1 * turn**3)
    assert np.abs(off) == pytest.approx(1.0, abs=1e-3)
    assert np.all(np.abs(np.angle(off)) < 3.0 * omega * 0.005 * (0.5 * p.bonds + 0.51))


def box_at(speed):
    """Return a fluid in a box that both move along x at a constant speed."""
    shape = block(3, 0.0)
    mesh = build_mesh(shape, [p._replace(type="wall") for p in box_patches(shape)])
    way = np.array([speed, 0.0, 0.0])
    return moved_by(mesh, lambda x, t: x + t * way, lambda x, _t: np.broadcast_to(way, x.shape))


def shaken(interaction):
    """Bodies in a box that moves, in it a fluid that is all but absent."""
    flow = box_at(1.0)
    bodies = spheres([[0.2, 0.5, 0.5], [0.2, 0.4, 0.6]], d=1e-2, rho=1e9, mu=1e9)
    bodies.v[:] = 0.0
    air = Medium(1e-9, 1e-9, (0.0, 0.0, 0.0))
    return Cloud(bodies, flow, air, [interaction] * len(flow.patches), 0.01, threads=1)


def test_a_ball_settles_in_a_box_that_moves_as_in_one_at_rest():
    models, found = Models(integrator="stokes", surroundings=(WallLift(),)), []
    for speed in (0.0, 1.0):
        ball, flow = spheres([[0.04, 0.5, 0.5]], d=0.02, rho=2000.0, mu=1e7), box_at(speed)
        oil = Medium(1.0, 1000.0, (-9.81, 0.0, 0.0))
        Cloud(ball, flow, oil, [Stick()] * len(flow.patches), 0.005, models, threads=1).advance(40)
        found.append([ball.x[0, 0] - 0.2 * speed, ball.v[0, 0] - speed])
    assert 0.012 < found[0][0] < 0.02
    assert found[1] == pytest.approx(found[0], abs=1e-6)


@pytest.mark.parametrize("e", [1.0, 0.5])
def test_a_body_at_rest_that_a_wall_hits_leaves_with_the_speed_of_the_wall_and_e_times_it(e):
    cloud = shaken(Rebound(e=e))
    cloud.advance(30)
    p = cloud.particles
    assert p.v == pytest.approx(np.broadcast_to([1.0 + e, 0.0, 0.0], (2, 3)), abs=1e-5)
    assert p.x[:, 0] == pytest.approx(0.2 + (1.0 + e) * (0.3 - 0.195), abs=1e-5)


def test_a_body_that_sticks_to_a_moving_wall_rides_along():
    cloud = shaken(Stick())
    cloud.advance(30)
    assert np.all(cloud.particles.status == Status.STUCK)
    assert cloud.particles.t == pytest.approx(0.195, abs=1e-6)
    now = cloud.comm.rank.at_instant(0.3, False)
    assert now.x[:, 0] == pytest.approx(0.3 + 0.005, abs=1e-6)
    assert now.v == pytest.approx(np.broadcast_to([1.0, 0.0, 0.0], (2, 3)), abs=1e-9)


def test_a_wall_that_moves_with_the_mesh_has_the_velocity_of_its_points(tmp_path):
    """Whatever the file has there, which lags."""
    write_case(tmp_path, perturbation=0.0)
    points = (tmp_path / "constant/polyMesh/points").read_text()
    for time in ("0", "0.5", "1e1"):
        turn = Rotation.from_rotvec([0.0, 0.0, 0.03 * float(time)])
        path = tmp_path / time / "U"
        path.write_text(re.sub(r"(floor *{ *type) fixedValue", r"\1 movingWallVelocity", path.read_text()))

        def moved(m, turn=turn):
            return "({:.17g} {:.17g} {:.17g})".format(*turn.apply([float(x) for x in m.groups()]))

        if time != "0":
            (tmp_path / time / "polyMesh").mkdir()
            text = re.sub(r"\((\S+) (\S+) (\S+)\)", moved, points)
            (tmp_path / time / "polyMesh/points").write_text(text)
    flow = read_series(tmp_path)
    assert any("0.03 rad/s about (0 0 1)" in note for note in flow.notes)
    for t in (0.0, 0.5, 3.0):
        faces = flow.patch_faces("floor", t)
        expected = np.cross([0.0, 0.0, 0.03], faces.vertices)
        assert faces.velocity == pytest.approx(expected, abs=1e-9)


def test_a_case_that_turns_has_the_flow_of_each_time(tmp_path):
    """Its velocity, and k with its gradient, are those in space, though they are read in the turned frame."""
    mesh = write_case(tmp_path, perturbation=0.0)
    G, slope = 0.02 * GRADIENT, np.array([1.0, 2.0, 0.5])
    for time in ("0", "0.5", "1e1"):
        R = Rotation.from_rotvec([0.0, 0.0, 0.03 * float(time)])
        now = replace(mesh, centres=R.apply(mesh.centres), boundary_centres=R.apply(mesh.boundary_centres))
        put_linear(tmp_path / time, now, "U", G, 0.0, "[0 1 -1 0 0 0 0]")
        put_linear(tmp_path / time, now, "k", slope, 5.0, "[0 2 -2 0 0 0 0]")
        put_scalar(tmp_path / time, "epsilon", "0 2 -3", 1.0)
        if time != "0":
            (tmp_path / time / "polyMesh").mkdir()
            text = header("vectorField", "points").encode() + number_list(R.apply(mesh.points), Format(True))
            (tmp_path / time / "polyMesh/points").write_bytes(text.replace(b"ascii", b"binary"))
    flow = read_series(tmp_path, turbulent=True)
    x = np.array([[0.4, 0.3, 0.45], [0.3, 0.6, 0.6]])
    for t in (0.0, 10.0):
        hosts = flow.locate(x, t)
        u, l = flow.sample(x, hosts, t)
        assert u == pytest.approx(x @ G.T, abs=2e-3)
        assert l == pytest.approx(np.broadcast_to(G, l.shape), abs=1e-4)
        for host, at in zip(hosts, x, strict=True):
            k, _, grad_k, _ = flow.kernels["turbulence"](flow.arrays(), int(host), tuple(at), t)
            assert k == pytest.approx(5.0 + slope @ at, abs=0.05)
            assert grad_k == pytest.approx(slope, abs=0.05)


def test_whole_turns_follow_from_the_walls():
    mesh, spins = rings(), {"turns": 10.0 * np.radians(400.0), "none": None}
    for name, rate in spins.items():

        def spin(index, cells, rate=rate):
            return None if rate is None or len(cells) != 72 else np.array([0.0, 0.0, rate])

        fit = rigid_motion(
            Path("case"),
            TIMES,
            lambda n: rotor(np.radians(40.0))(mesh.points, float(n)),
            mesh,
            {},
            spin,
            None,
        )
        degrees = np.degrees(np.linalg.norm(fit.turns[:, 0], axis=1))
        assert degrees == pytest.approx(400.0 if name == "turns" else 40.0)


@pytest.mark.parametrize(
    ("precision", "way", "rigid"),
    [(6, 0.0, True), (10, 0.0, True), (17, 2e-7, True), (17, 2e-5, False), (8, 2e-5, False)],
)
def test_a_piece_is_rigid_up_to_the_digits_of_its_points_and_a_share_of_its_edges(precision, way, rigid):
    """Fine cells, 2e-4 of the mesh, may not move by 0.1 of themselves, which is 2e-5 of the mesh."""
    shape = block(4, 0.0)
    x = np.array(shape.points)
    x[:, 0] = np.interp(x[:, 0], np.linspace(0.0, 1.0, 5), [0.0, 2e-4, 0.3, 0.7, 1.0])
    shape.points = x
    mesh = build_mesh(shape, box_patches(shape))

    def points(name):
        own = mesh.points + [0.0, way, 0.0] * np.isclose(mesh.points[:, :1], 2e-4)
        moved = turned(np.radians(7.0))(own, float(name)) + np.array([2.0, 0.1, 0.0])
        return np.array([[float(f"{c:.{precision}g}") for c in place] for place in moved])

    with nullcontext() if rigid else pytest.raises(InputError, match=r"points at 0\.1 s are up to"):
        fit = rigid_motion(Path("case"), ("0", "0.1"), points, mesh, {}, no_walls, None)
        assert np.linalg.norm(fit.turns[0, 0]) == pytest.approx(np.radians(7.0), abs=2e-5)


@pytest.mark.parametrize(
    ("motion", "period", "message"),
    [
        (
            rotor(np.radians(120.0)),
            None,
            r"piece 1 \(72 cells\) of the mesh turns by 120 degrees from 0 to 0.1 s",
        ),
        (
            lambda x, t: x * (1.0 + t),
            None,
            r"piece 1 \(72 cells\) of the mesh deforms: its points at 0.1 s are up",
        ),
        (rotor(np.radians(50.0)), 0.5, r"a period of 0.5 s does not return the points of the mesh"),
    ],
)
def test_a_motion_that_cannot_be_followed_is_reported(motion, period, message):
    mesh = rings()
    with pytest.raises(InputError, match=message):
        moved_by(mesh, motion, lambda x, _t: 0.0 * x, period=period)
