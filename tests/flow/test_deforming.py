"""Flows on meshes that deform, against flows that are known in closed form."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from foam_writer import header, put_linear, write_case
from mesh_shapes import block, box_patches, cyclic_row, interfaces, layer, rings
from scipy.spatial.transform import Rotation

from foamprb import Cloud, Escape, Medium, Models, Rebound, Status, Stick, WallLift, spheres
from foamprb.cloud.cloud import clearances
from foamprb.cloud.injection.models import BoxInjection
from foamprb.cloud.injection.shapes import Sphere
from foamprb.cloud.patches import Adhere, Cyclic, Mirror
from foamprb.errors import InputError
from foamprb.flow.curvatures import mean_curvatures
from foamprb.flow.deforming import DeformingFlow
from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.mesh import build_mesh, with_points
from foamprb.flow.motion import match_walls
from foamprb.flow.read.describe import describe
from foamprb.flow.read.motion import deformation_of, note_of_deformation, require_uncoupled
from foamprb.flow.read.openfoam import Case, read_series, transient_flow
from foamprb.flow.read.source import FlowSource
from foamprb.flow.reconstruct import Reconstruction
from foamprb.run.room import Room

WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))


def deforming(mesh, motion, u, times, period=None, curved=False, surfaces=()):
    """Return the flow u(x, t) on a mesh that ``motion(points, t)`` moves, as a case would give it."""
    names = [f"{t:.12g}" for t in times]
    fit = deformation_of(Path("case"), names, lambda n: motion(mesh.points, float(n)), mesh, period, surfaces)
    shapes = {}

    def at(k):
        return with_points(mesh, motion(mesh.points, times[k]), surfaces)

    def read(k):
        here = at(k)
        v, l = Reconstruction(here)(u(here.centres, times[k]), u(here.boundary_centres, times[k]))
        w = fit.rates(k, lambda j: at(j).nodes)
        match_walls(here, v, w)
        shapes[k] = np.concatenate([here.nodes, w], axis=1)
        fluxes = Conservation(here)(v, l, fastest=fit.fastest(here))
        return (v, l, fluxes, mean_curvatures(here, l)) if curved else (v, l, fluxes)

    return DeformingFlow(fit, shapes, mesh, times, read, period, conservative=True, curved=curved)


def layers_up_to(length):
    """Ends of layers of the same thickness, of which the last one is thicker or thinner."""
    return np.append(0.1 * np.arange(max(round(10.0 * length), 1)), length)


def layered(folder, axis, cells, u, ends, right="patch", put=lambda *_: None):
    """Write a case of the flow u(x, t), linear in x, with layers across an axis whose ends change in time.

    ``put(folder, mesh, t)`` writes further fields.
    """
    for name, heights in ends.items():
        n, other = len(heights) - 1, folder / f"only{name}"
        mesh = layer((0.0, 1.0), (0.0, 1.0), *((n, cells) if axis == 0 else (cells, n)), right=right)
        points = mesh.points.copy()
        points[:, axis] = np.interp(points[:, axis], np.linspace(0.0, 1.0, n + 1), heights)
        mesh = with_points(mesh, points)
        write_case(other, times=(name,), mesh=mesh)
        at = [u(x, float(name))[0] for x in np.zeros((4, 1, 3)) + np.eye(4, 3, -1)[:, None]]
        put_linear(other / name, mesh, "U", np.transpose(at[1:] - at[0]), at[0], "[0 1 -1 0 0 0 0]")
        put(other / name, mesh, float(name))
        shutil.copytree(other / "constant/polyMesh", other / name / "polyMesh")
        shutil.copytree(other, folder / "case", dirs_exist_ok=True)
    return folder / "case"


def followed(flow, start, interactions, dt, steps, **body):
    """Return tracers after some steps in a flow."""
    bodies = spheres(start, **{"d": 1e-6, "rho": 1000.0, "mu": 1e3, **body})
    patches = [interactions.get(patch.name, Mirror()) for patch in flow.patches]
    cloud = Cloud(bodies, flow, WATER, patches, dt, threads=1)
    cloud.advance(steps)
    return cloud, bodies


def rms(x, expected):
    return float(np.sqrt(np.mean(np.sum((x[:, :2] - expected[:, :2]) ** 2, axis=1))))


def spread(n, low, high):
    """n places in a rectangle, even but in no lines."""
    i = np.arange(n)
    parts = np.stack([(i * 0.618) % 1.0, (i * 0.382) % 1.0], axis=1)
    return np.column_stack([np.array(low) + parts * (np.array(high) - low), np.full(n, 0.05)])


OMEGA = 2.0 * np.pi


def h(t):
    return 0.6 + 0.4 * np.cos(OMEGA * t)


def strain_rate(t):
    return -0.4 * OMEGA * np.sin(OMEGA * t) / h(t)


def squeezed(writes, folder=None):
    """Fluid between a plate and another one that comes nearer: x h and y / h stay.

    With a folder, layers of cells at this one vanish, eight of ten.
    """

    def u(x, t):
        s = strain_rate(t)
        return np.stack([-s * x[:, 0], s * x[:, 1], 0.0 * x[:, 0]], axis=1)

    times, ratio = np.linspace(0.0, 0.5, writes + 1), np.array([h(0.0) / h(0.5), h(0.5)])
    if folder is not None:
        ends = {f"{t:.12g}": layers_up_to(h(t)) for t in times}
        return read_series(layered(folder, 1, 16, u, ends)), ratio
    mesh = layer((0.0, 1.0), (0.0, 1.0), 16, 10, right="patch")
    return deforming(mesh, lambda x, t: x * [1.0, h(t), 1.0], u, times), ratio


@pytest.mark.parametrize(
    ("writes", "limit", "layers"), [(10, 1.5e-3, False), (20, 3e-4, False), (20, 3e-4, True)]
)
def test_fluid_is_pressed_out_between_plates(tmp_path, writes, limit, layers):
    flow, ratio = squeezed(writes, tmp_path if layers else None)
    assert any("of the mesh of 0 s (160 cells), which deforms" in note for note in flow.notes) == layers
    x = spread(100, (0.02, 0.0005), (0.18, 0.9995))
    stick = dict.fromkeys(("left", "bottom", "top"), Stick())
    _, p = followed(flow, x, {**stick, "right": Escape()}, 0.005, 100)
    assert np.all(p.status == Status.ACTIVE)
    assert rms(p.x, x[:, :2] * ratio) < limit


@pytest.mark.parametrize("layers", [False, True])
def test_gas_is_compressed_with_its_layers_of_density(tmp_path, layers):
    """In a closed cylinder y / h stays, and the density is h⁻¹ times a function of it."""

    def u(x, t):
        return x * [0.0, strain_rate(t), 0.0]

    def put(folder, mesh, t):
        put_linear(folder, mesh, "rho", [0.0, 1.0 / h(t) ** 2, 0.0], 1.0 / h(t), "[1 -3 0 0 0 0 0]")

    ends = {
        f"{t:.12g}": layers_up_to(h(t)) if layers else np.linspace(0.0, h(t), 11)
        for t in np.linspace(0.0, 0.5, 21)
    }
    case = layered(tmp_path, 1, 4, u, ends, "wall", put)
    text = header("dictionary", "thermophysicalProperties") + "thermoType { type hePsiThermo; }"
    (case / "constant/thermophysicalProperties").write_text(text)
    x = spread(100, (0.02, 0.0005), (0.98, 0.9995))
    _, p = followed(
        read_series(case), x, dict.fromkeys(("left", "right", "bottom", "top"), Stick()), 0.005, 100
    )
    assert np.all(p.status == Status.ACTIVE)
    # The growth of the density is the slope between the times before and after.
    assert rms(p.x, x[:, :2] * [1.0, h(0.5)]) < 4e-4


def wave(x, t):
    y = 0.15 * np.sin(np.pi * x[:, 0] - OMEGA * t)
    return x + np.stack([0.0 * y, y, 0.0 * y], axis=1)


def waving(speed, length, ends="patch"):
    """A channel whose walls are a running wave, and a fluid that slides through it, or rests in it."""

    def u(x, t):
        c = np.cos(np.pi * x[:, 0] - OMEGA * t)
        return np.stack([speed + 0.0 * c, 0.15 * (np.pi * speed - OMEGA) * c, 0.0 * c], axis=1)

    mesh = layer((0.0, length), (-0.5, 0.5), round(12 * length), 12, left=ends, right=ends)
    return deforming(mesh, wave, u, np.linspace(0.0, 0.75, 10))


@pytest.mark.parametrize("speed", [0.0, 0.5])
def test_walls_that_wave_touch_no_tracer_of_a_fluid_that_moves_with_them(speed):
    flow = waving(speed, 4.0)
    y = spread(100, (0.4, -0.498), (3.1, 0.498))
    end = y + np.array([0.75 * speed, 0.0, 0.0])
    walls = dict.fromkeys(("bottom", "top"), Stick())
    ends = dict.fromkeys(("left", "right"), Escape())
    _, p = followed(flow, wave(y, 0.0), {**walls, **ends}, 0.00625, 120)
    assert np.all(p.status == Status.ACTIVE)
    assert rms(p.x, wave(end, 0.75)) < 1e-3


CHANNEL = {"bottom": Stick(), "top": Stick(), "left": Cyclic(), "right": Cyclic()}


def test_a_wave_of_one_length_between_cyclic_ends_is_an_endless_channel():
    """A fluid slides through it; a ball beside an end has the gap of one in a longer channel."""
    flow = waving(0.5, 2.0, "cyclic")
    y = spread(100, (0.0, -0.498), (2.0, 0.498))
    _, p = followed(flow, wave(y, 0.0), CHANNEL, 0.00625, 120)
    assert np.all(p.status == Status.ACTIVE)
    end = wave(y + np.array([0.375, 0.0, 0.0]), 0.75)
    turns = np.round((end[:, 0] - p.x[:, 0]) / 2.0)
    assert np.count_nonzero(turns) > 15
    assert rms(p.x + np.outer(turns, [2.0, 0.0, 0.0]), end) < 1e-3
    x, gaps = np.array([[0.05, -0.25], [0.05, 0.25], [1.95, -0.25], [1.95, 0.25]]), []
    for own, beyond in ((flow, 0.0), (waving(0.5, 4.0), 2.0)):
        places = np.column_stack([x[:, 0] + beyond * (x[:, 0] < 1.0), x[:, 1], np.full(4, 0.05)])
        bodies = spheres(places, d=0.2, rho=1e3, mu=1e3, t0=0.2)
        bodies.t[:] = 0.2
        gaps.append(clearances(bodies, own, 0.4, [2, 3]))
    assert np.all(np.abs(gaps[1]) < 0.3)
    assert gaps[0] == pytest.approx(gaps[1], abs=1e-4)


def test_coupled_patches_of_a_mesh_whose_faces_change_are_refused():
    mesh = layer((0.0, 1.0), (0.0, 1.0), 2, 2, left="cyclic", right="cyclic")
    with pytest.raises(InputError, match=r"^case: .* other faces .* its patch left \(cyclic\)"):
        require_uncoupled(Path("case"), mesh)


def test_a_stream_through_a_cyclic_box_whose_inside_moves_returns_where_it_was():
    mesh = layer((0.0, 1.0), (0.0, 1.0), 6, 6, left="cyclic", right="cyclic")

    def motion(x, t):
        s = 0.05 * np.sin(OMEGA * t) * np.prod(np.sin(np.pi * x[:, :2]), axis=1)
        return x + np.outer(s, [1.0, -1.0, 0.0])

    def u(x, _t):
        return np.broadcast_to([2.0, 0.0, 0.0], x.shape)

    flow = deforming(mesh, motion, u, np.linspace(0.0, 1.0, 9))
    x = spread(50, (0.05, 0.01), (0.95, 0.99))
    _, p = followed(flow, x, CHANNEL, 0.02, 50)
    assert np.all(p.status == Status.ACTIVE)
    assert p.x == pytest.approx(x, abs=1e-6)


def test_a_stream_crosses_a_ring_that_turns_in_a_mesh_whose_cells_breathe():
    """Patches of cyclicAMI slide on each other, cut into different faces."""
    mesh = rings()
    mesh = replace(mesh, patches=[p._replace(type="patch") if p.type == "wall" else p for p in mesh.patches])
    surfaces = [PatchSurface(p.name, p.type, None, p.neighbour) for p in mesh.patches]

    def motion(x, t):
        r = np.hypot(x[:, 0], x[:, 1])
        inner = (r < 0.99) | (np.arange(len(x)) < 0.4 * len(x))
        turned = np.where(inner[:, None], Rotation.from_rotvec([0.0, 0.0, 3.0 * t]).apply(x), x)
        return turned * (1.0 + np.outer(0.02 * np.sin(OMEGA * t) * np.sin(OMEGA * r), [1.0, 1.0, 0.0]))

    stream = np.array([0.5, 0.2, 0.0])

    def u(x, _t):
        return np.broadcast_to(stream, x.shape)

    flow = deforming(mesh, motion, u, np.linspace(0.0, 1.0, 9), surfaces=surfaces)
    a = np.linspace(1.5, 5.0, 24)
    x = np.column_stack([1.2 * np.cos(a), 1.2 * np.sin(a), np.full(24, 0.5)])
    through = {p.name: Cyclic() if p.neighbour else Escape() for p in flow.patches}
    _, p = followed(flow, x, through, 0.01, 100)
    inside = p.status == Status.ACTIVE
    assert np.count_nonzero(inside) > 8
    assert np.count_nonzero(np.hypot(p.x[inside, 0], p.x[inside, 1]) < 0.95) > 4
    assert p.x[inside] == pytest.approx((x + stream)[inside], abs=5e-4)
    now, arrays = flow.nodes_at(0.9), flow.arrays()
    for triangle in np.flatnonzero(flow.mesh.triangle_patch == 0)[::6]:
        place = now[flow.mesh.triangles[triangle]].mean(axis=0)
        host, y, _ = flow.kernels["cross"](arrays, int(triangle), tuple(place), 0.9)
        assert np.linalg.norm(now[flow.mesh.tets[host]].mean(axis=0) - y) < 0.3


@pytest.fixture(scope="module", params=["cells that shrink", "layers that vanish"])
def piston(request, tmp_path_factory):
    """A box of which one side moves in as 0.2 t + 0.1 t², and the fluid leaves by the other one."""

    def motion(x, t):
        return x + np.stack([(1.0 - x[:, 0]) * place(t), 0.0 * x[:, 0], 0.0 * x[:, 0]], axis=1)

    def u(x, t):
        return np.broadcast_to([speed(t), 0.0, 0.0], x.shape)

    times = np.linspace(0.0, 1.0, 6)
    if "layers" in request.param:
        ends = {f"{t:.12g}": 1.0 - layers_up_to(1.0 - place(t))[::-1] for t in times}
        return read_series(layered(tmp_path_factory.mktemp("piston"), 0, 6, u, ends))
    mesh = layer((0.0, 1.0), (0.0, 1.0), 8, 6, right="patch")
    return deforming(mesh, motion, u, times)


def place(t):
    return 0.2 * t + 0.1 * t * t


def speed(t):
    return 0.2 + 0.2 * t


HEAVY = {"d": 0.02, "rho": 1e9, "mu": 1e9}


def contact_time():
    return (-0.2 + np.sqrt(0.04 + 0.4 * 0.09)) / 0.2


@pytest.mark.parametrize("e", [1.0, 0.5])
def test_a_body_at_rest_that_a_piston_hits_leaves_with_its_speed_and_e_times_it(piston, e):
    hit = contact_time()
    walls = dict.fromkeys(("left", "bottom", "top"), Rebound(e=e))
    _, p = followed_at_rest(piston, walls, 0.01, 60)
    v = (1.0 + e) * speed(hit)
    assert p.v == pytest.approx(np.broadcast_to([v, 0.0, 0.0], (2, 3)), abs=2e-4)
    assert p.x[:, 0] == pytest.approx(0.1 + v * (0.6 - hit), abs=2e-4)


def followed_at_rest(flow, walls, dt, steps):
    bodies = spheres([[0.1, 0.5, 0.05], [0.1, 0.43, 0.05]], **HEAVY)
    bodies.v[:] = 0.0
    thin = Medium(1e-9, 1e-9, (0.0, 0.0, 0.0))
    patches = [{**walls, "right": Escape()}.get(patch.name, Mirror()) for patch in flow.patches]
    cloud = Cloud(bodies, flow, thin, patches, dt, threads=1)
    cloud.advance(steps)
    return cloud, bodies


def test_a_body_that_sticks_to_a_piston_rides_along(piston):
    walls = dict.fromkeys(("left", "bottom", "top"), Stick())
    cloud, p = followed_at_rest(piston, walls, 0.01, 90)
    assert np.all(p.status == Status.STUCK)
    assert p.t == pytest.approx(contact_time(), abs=1e-4)
    now = cloud.comm.rank.at_instant(0.9, False)
    assert now.x[:, 0] == pytest.approx(place(0.9) + 0.01, abs=1e-4)
    assert now.v == pytest.approx(np.broadcast_to([speed(0.9), 0.0, 0.0], (2, 3)), abs=1e-6)


SPEED, OIL = 1.0, Medium(1.0, 1000.0, (-9.81, 0.0, 0.0))


def box(speed):
    """A box of fluid of which one side moves in with a speed, and the fluid before it."""

    def motion(x, t):
        return x + np.stack([(1.0 - x[:, 0]) * speed * t, 0.0 * x[:, 0], 0.0 * x[:, 0]], axis=1)

    def u(x, _t):
        return np.broadcast_to([speed, 0.0, 0.0], x.shape)

    mesh = layer((0.0, 1.0), (0.0, 1.0), 8, 6, right="patch")
    return deforming(mesh, motion, u, np.linspace(0.0, 0.5, 6))


def settled(flow, interaction, models, steps, n):
    """Return n stiff balls that settle onto the left wall."""
    x = np.column_stack([np.full(n, 0.04), np.linspace(0.3, 0.7, n), np.full(n, 0.05)])
    p = spheres(x, d=0.02, rho=2000.0, mu=1e7)
    patches = [interaction if patch.name == "left" else Mirror() for patch in flow.patches]
    cloud = Cloud(p, flow, OIL, patches, 0.005, models, threads=1)
    cloud.advance(steps)
    return cloud.comm.rank.at_instant(cloud.time, False)


def test_a_ball_settles_onto_a_wall_that_moves_as_onto_one_at_rest():
    """In the frame of the wall."""
    models = Models(integrator="stokes", surroundings=(WallLift(),))
    there, p = (settled(box(speed), Stick(), models, 20, 1) for speed in (0.0, SPEED))
    assert 0.02 < there.x[0, 0] < 0.03
    assert p.x[:, 0] - SPEED * 0.1 == pytest.approx(there.x[:, 0], abs=1e-6)
    assert p.v[:, 0] - SPEED == pytest.approx(there.v[:, 0], abs=2e-6)


def test_bonds_hold_bodies_on_a_wall_that_moves():
    """As many as on one at rest, and each rides along, also after its bond broke."""
    models = Models(integrator="stokes")
    there, p = (settled(box(speed), Adhere(kOn=30.0, kOff=20.0), models, 60, 40) for speed in (0.0, SPEED))
    held = there.status == Status.STUCK
    assert 5 < np.count_nonzero(held) < 35
    assert np.array_equal(p.status, there.status)
    assert p.x[:, 0] == pytest.approx(SPEED * 0.3 + 0.01, abs=1e-5)
    assert p.v[:, 0] == pytest.approx(SPEED + np.where(held, 0.0, there.v[:, 0]), abs=1e-6)


def test_bullets_in_a_channel_are_those_of_a_mesh_at_rest():
    """While points inside move: B = 35/32 μ a S/μ_s of plane Poiseuille flow."""
    mesh, a, y = layer((0.0, 2.0), (-0.5, 0.5), 32, 12, left="patch", right="patch"), 0.02, (0.05, 0.2, -0.3)
    bullets = []
    for way in (0.0, 0.05):

        def motion(x, t, way=way):
            s = way * np.sin(2.0 * np.pi * t) * np.sin(np.pi * x[:, 0]) * np.cos(np.pi * x[:, 1])
            return x + np.stack([s, s * np.cos(3.0 * x[:, 0]), 0.0 * s], axis=1)

        def u(x, _t):
            return np.stack([1.0 - 4.0 * x[:, 1] ** 2, 0.0 * x[:, 0], 0.0 * x[:, 0]], axis=1)

        flow = deforming(mesh, motion, u, np.linspace(0.0, 0.6, 8), curved=True)
        p = spheres([[0.3, at, 0.05] for at in y], d=2.0 * a, rho=1e-9, mu=0.1, poissons_ratio=0.4999)
        patches = [Mirror() if patch.type == "empty" else Escape() for patch in flow.patches]
        thin, models = Medium(1e-3, 1e-9, (0.0, 0.0, 0.0)), Models(integrator="stokes", shape="quadratic")
        Cloud(p, flow, thin, patches, 0.01, models, threads=1).advance(60)
        bullets.append(p.B[:, [0, 3]])
    S = 8.0 * np.array([1.0 / 5.0, -4.0 / 15.0])
    assert bullets[0] / (35.0 / 32.0 * 1e-3 * a * S / 0.1) == pytest.approx(1.0, abs=7e-3)
    assert bullets[1] == pytest.approx(bullets[0], rel=2e-3)


def test_patches_zones_and_hosts_are_where_they_are_at_a_time(piston):
    """Off the times of the flow, too."""
    for t in (0.0, 0.5, 0.9):
        faces = piston.patch_faces("left", t)
        assert faces.vertices[:, :, 0] == pytest.approx(place(t), abs=1e-9)
        assert faces.velocity[:, :, 0] == pytest.approx(speed(t), abs=1e-6)
        assert faces.normals == pytest.approx(np.broadcast_to([1.0, 0.0, 0.0], faces.normals.shape))
        zone = piston.cell_zone(None, t)
        assert zone.volumes.sum() == pytest.approx(0.1 * (1.0 - place(t)))
        assert zone.vertices(zone.hosts)[:, :, 0].min() == pytest.approx(place(t))
        beside = np.array([[place(t) - 1e-3, 0.5, 0.05], [place(t) + 1e-3, 0.5, 0.05]])
        assert np.array_equal(piston.locate(beside, t) >= 0, [False, True])


def test_bodies_with_clearance_have_room_when_they_are_released(piston):
    """The others keep their places."""
    model = BoxInjection(min=(0.0, 0.2, 0.04), max=(0.5, 0.8, 0.06), number=200, duration=0.95)
    bodies = SimpleNamespace(sizeDistribution=0.1, shape=Sphere())
    left = [patch.name for patch in piston.patches].index("left")
    room = Room(bodies, piston, [left], *np.random.default_rng(0).spawn(2))
    kept = model.places(piston, np.random.default_rng(1), None, room.fit)
    drawn = model.places(piston, np.random.default_rng(1), None)
    overlap = drawn.x[:, 0] - place(drawn.t) < 0.05
    assert np.array_equal((kept.x != drawn.x).any(axis=1), overlap)
    assert 20 < room.moved == overlap.sum()
    assert kept.x[:, 0].min() < 0.1
    assert np.all(kept.x[:, 0] - place(kept.t) > 0.05)


def test_places_are_carried_back_to_the_mesh_of_the_first_time(piston):
    """At loaded times with the fluid, at any time on the boundary."""
    x = np.array([[0.3, 0.4, 0.05], [0.7, 0.2, 0.05], [0.001, 0.4, 0.05]])
    for t, apart, rows in ((0.7, True, [0, 1]), (0.9, False, [2])):
        now = x + (1.0 - x[:, :1]) * [place(t), 0.0, 0.0]
        hosts = piston.locate(now, t)
        piston.load(0.7, 0.7)
        back = piston.arrays().pulled(now[rows], hosts[rows], np.full(len(rows), t), apart)
        assert back == pytest.approx(x[rows], abs=3e-4)


def test_acceleration_is_that_at_a_fixed_point():
    """Of a moving mesh, by the kernel as it runs in the interpreter."""
    flow, _ = squeezed(20)
    x, t = np.array([[0.2, 0.1, 0.05], [0.5, 0.3, 0.05]]), 0.112
    hosts = flow.locate(x, t)
    s, s_t = strain_rate(t), (strain_rate(t + 1e-4) - strain_rate(t - 1e-4)) / 2e-4
    for host, at in zip(hosts, x, strict=True):
        u, l, u_t = flow.kernels["sample"](flow.arrays(), int(host), tuple(at), t)
        assert u[:2] == pytest.approx([-s * at[0], s * at[1]], abs=2e-3)
        assert l[0] == pytest.approx(-s, rel=1e-3)
        assert u_t[:2] == pytest.approx([-s_t * at[0], s_t * at[1]], rel=2e-2, abs=0.05)


def test_the_log_tells_how_far_points_move(piston):
    note = note_of_deformation(piston.motion, piston.mesh)
    assert note.startswith("The mesh deforms: points move by up to 0.076 m from time to time, 0.6")


def stretch(case, times=("0.5", "1e1")):
    """Let the points of a case move."""
    points = (case / "constant/polyMesh/points").read_text()
    for time in times:

        def moved(m, factor=1.0 + 0.1 * float(time)):
            x, y, z = (float(x) for x in m.groups())
            return f"({factor * x:.17g} {y:.17g} {z:.17g})"

        (case / time / "polyMesh").mkdir()
        text = re.sub(r"\((\S+) (\S+) (\S+)\)", moved, points)
        (case / time / "polyMesh/points").write_text(text)


def test_a_case_whose_points_move_deforms(tmp_path):
    mesh = write_case(tmp_path, perturbation=0.0)
    stretch(tmp_path)
    assert describe(Case(tmp_path)).lines()[-1] == "    Points of the mesh, too: 0.5, 1e1"
    flow = read_series(tmp_path)
    assert any("the mesh deforms: points move by up to 0.95 m" in note for note in flow.notes)
    assert flow.notes[-1] == "The flow is cubic in time between 3 times from 0 to 1e1."
    for t in (0.0, 0.3, 0.5, 4.0, 10.0):
        assert flow.nodes_at(t) == pytest.approx(mesh.nodes * [1.0 + 0.1 * t, 1.0, 1.0], abs=1e-9)
    text = "dynamicFvMesh dynamicMotionSolverFvMesh; motionSolver solidBody;"
    (tmp_path / "constant/dynamicMeshDict").write_text(header("dictionary", "dynamicMeshDict") + text)
    with pytest.raises(
        InputError, match=r"m off a rigid motion\. Its dynamicMeshDict names rigid motions only"
    ):
        read_series(tmp_path)


def test_a_time_that_is_read_again_from_the_cache_has_the_same_bits(tmp_path):
    """The velocities of nodes on walls, too, which follow those of the fluid."""
    case = tmp_path / "case"
    mesh = write_case(case, perturbation=0.0)
    squares = replace(mesh, centres=mesh.centres**2, boundary_centres=mesh.boundary_centres**2)
    for time in ("0", "0.5", "1e1"):
        put_linear(case / time, squares, "U", np.diag([0.102, 0.0, 0.0]), 0.0, "[0 1 -1 0 0 0 0]")
    stretch(case)

    def arrays():
        flow = transient_flow(Case(case), None, None, FlowSource(cache=tmp_path / "cache", curved=True))
        flow.load(0.0, 0.3)
        return flow.arrays()

    made, stored = arrays(), arrays()
    assert len(list((tmp_path / "cache").iterdir())) == 3
    assert made.shapes[:, 3].max() == pytest.approx(0.102)
    first, second = np.split(made.series.curvatures[:, 0], 3)[:2]
    assert second == pytest.approx(first / 1.05**2, rel=1e-3)
    for of, to in ((made, stored), (made.series, stored.series)):
        for name in ("shapes", "past", "fields", "phi", "curvatures"):
            if hasattr(of, name):
                np.testing.assert_array_equal(getattr(of, name), getattr(to, name))


def test_a_mesh_that_slides_along_an_edge_between_walls_moves_no_fluid_there():
    """Across the edge, and at corners, the fluid follows the mesh."""
    shape = block(2, 0.0)
    mesh = build_mesh(shape, [p._replace(type="wall") for p in box_patches(shape)])
    u, w = np.zeros_like(mesh.nodes), mesh.nodes.copy()
    match_walls(mesh, u, w)
    at = {tuple(x): v for x, v in zip(mesh.nodes.tolist(), u.tolist(), strict=True)}
    assert at[0.0, 1.0, 0.5] == pytest.approx([0.0, 1.0, 0.0])
    assert at[1.0, 1.0, 0.5] == pytest.approx([1.0, 1.0, 0.0])
    assert at[1.0, 1.0, 1.0] == pytest.approx([1.0, 1.0, 1.0])


def test_another_number_of_points_is_reported():
    mesh = layer((0.0, 1.0), (0.0, 1.0), 2, 2)

    def points(name):
        return mesh.points[: 18 if name == "0" else 17]

    with pytest.raises(InputError, match="the mesh has 17 points at 1 s and 18 before, with the same faces"):
        deformation_of(Path("case"), ("0", "1"), points, mesh, None)


def test_a_period_that_does_not_return_the_points_is_reported():
    mesh = layer((0.0, 1.0), (0.0, 1.0), 2, 2)

    def points(name):
        return mesh.points * [1.0 + 0.1 * float(name), 1.0, 1.0]

    with pytest.raises(InputError, match=r"a period of 1 s does not return the points .* 0\.1 m off at 1 s"):
        deformation_of(Path("case"), ("0", "0.5", "1"), points, mesh, 1.0)


@pytest.mark.parametrize("kind", ["cyclic", "cyclicAMI"])
def test_coupled_patches_that_do_not_move_alike_are_reported(kind):
    mesh = cyclic_row(0.0, 2) if kind == "cyclic" else interfaces(0.0)[0]

    def points(name):
        """All that moves as one body is allowed."""
        x, t = mesh.points, float(name)
        return x + t if t < 2.0 else x + np.outer(0.1 * x[:, 0] * np.sin(3.0 * x[:, 1]), [0.0, 0.0, 1.0])

    with pytest.raises(InputError, match=rf"at 2 s points of its {kind} patch \w+ are up to 0\.\d+ m off"):
        deformation_of(Path("case"), ("0", "1", "2"), points, mesh, None)
