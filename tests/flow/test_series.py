"""Flows that change in time, on a mesh and in closed form."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from mesh_shapes import block, box_patches
from small_clouds import assert_same
from unsteady_flow import changing_flow

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.patches import Escape, Rebound
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow, series_of
from foamprb.flow.timeline import one_period

WATER = Medium(1e-3, 1e3, (0.0, 0.0, 0.0))
INTEGRATORS = ("paper", "rosenbrock", "stokes")
CENTRE = np.array([0.5, 0.5, 0.5])
SHEAR = np.array([[0.0, 1.0, 0.0], [0.3, 0.0, 0.0], [0.0, 0.0, 0.0]])
DRIFT = np.array([0.1, 0.0, 0.05])


def swing(omega, growth, t):
    """Factor of the flow at t."""
    return math.cos(omega * t) + growth * t


def in_closed_form(omega=0.0, growth=0.0):
    """Shear about the cube's centre and a drift, both in proportion to the factor."""
    along, across, drift_x, drift_z = (
        (0.0, share, 0.0, share * growth) for share in (SHEAR[0, 1], SHEAR[1, 0], DRIFT[0], DRIFT[2])
    )
    return changing_flow(omega, along, across, drift_x, drift_z, 0.5)


@pytest.fixture(scope="module")
def mesh():
    shape = block(2, 0.2)
    return build_mesh(shape, box_patches(shape))


def in_files(mesh, times, omega=0.0, growth=0.0, log=None, **options):
    """The same flow, known at some times."""

    def read(index):
        if log is not None:
            log.append(index)
        f = swing(omega, growth, times[index])
        l = np.broadcast_to(f * SHEAR, (mesh.n_points + mesh.n_cells, 3, 3))
        return f * (DRIFT + (mesh.nodes - CENTRE) @ SHEAR.T), l

    return SeriesFlow(mesh, times, read, **options)


def cloud_in(flow, dt, integrator="paper", start=0.0, n=3, spread=0.0, tolerance=1e-6, **options):
    """Soft particles near the middle that go with the flow."""
    random = np.random.default_rng(7)
    x = CENTRE + 0.1 * random.uniform(-1, 1, (n, 3))
    t0 = start + spread * np.arange(n) / n
    p = spheres(x, d=2e-3, rho=1e3, mu=1e-3 / 0.3, poissons_ratio=0.45, t0=t0)
    p.v[:] = np.nan
    walls = [Rebound() if patch.type == "wall" else Escape() for patch in flow.patches]
    models = Models(integrator=integrator, tolerance=tolerance)
    return Cloud(p, flow, WATER, walls, dt, models, start=start, **options)


@pytest.mark.parametrize("integrator", ["rosenbrock", "stokes"])
def test_particles_go_through_files_as_through_the_flow_itself(mesh, integrator):
    moved = [
        cloud_in(flow, 0.01, integrator)
        for flow in (in_files(mesh, [0.0, 0.13, 0.4], growth=1.0), in_closed_form(growth=1.0))
    ]
    for cloud in moved:
        cloud.advance(40)
    files, exact = (cloud.particles for cloud in moved)
    assert (files.status == Status.ACTIVE).all()
    np.testing.assert_allclose(files.x, exact.x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(files.F, exact.F, rtol=0, atol=1e-7)
    assert np.abs(exact.F - np.eye(3).ravel()).max() > 0.05
    assert np.abs(exact.x - CENTRE).max() > 0.03


def test_interpolation_in_time_is_of_second_order(mesh):
    # Steps that end where the slope of the fluid's velocity jumps.
    end, omega = 1.0, 4.0
    exact = cloud_in(in_closed_form(omega), 0.005, "stokes")
    exact.advance(200)
    errors = []
    for n in (10, 20, 40):
        cloud = cloud_in(in_files(mesh, np.linspace(0.0, end, n + 1).tolist(), omega), 0.005, "stokes")
        cloud.advance(200)
        errors.append([np.abs(cloud.particles.x - exact.particles.x).max(),
                       np.abs(cloud.particles.F - exact.particles.F).max()])  # fmt: skip
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert ((orders > 1.8) & (orders < 2.2)).all(), orders


@pytest.mark.parametrize(
    ("integrator", "dt"),
    [("stokes", 0.01), ("stokes", 0.07), ("rosenbrock", 0.07), ("rosenbrock", 0.35), ("paper", 0.07)],
)
def test_the_answer_does_not_depend_on_how_the_work_is_split(mesh, integrator, dt):
    times = np.linspace(0.2, 1.6, 15).tolist()
    steps = round(1.4 / dt)

    def moved(parts, threads=1, **options):
        flow = in_files(mesh, times, 5.0, **options)
        cloud = cloud_in(flow, dt, integrator, start=0.2, n=40, spread=0.5, tolerance=1e-2, threads=threads)
        for part in parts:
            # With Δt beyond its limit `paper` loses them, however the work is split.
            Stepper(cloud).advance(part)
        return cloud.particles

    whole = moved([steps])
    assert (whole.status == Status.ACTIVE).all() or integrator == "paper"
    assert_same(whole, moved([1] * steps))
    assert_same(whole, moved([steps - 1, 1], threads=2))
    assert_same(whole, moved([steps], keep=len(times)))


def test_a_periodic_flow_goes_as_the_same_written_out(mesh):
    one = (0.1 + np.array([0.0, 0.15, 0.2, 0.35])).tolist()
    period = 0.5
    omega = 2 * math.pi / period
    many = [t + period * cycle for cycle in range(4) for t in one]
    looped = in_files(mesh, one, omega, period=period)
    assert looped.span == (0.1, math.inf)
    closed = in_files(mesh, [*one, 0.6], omega, period=period)
    moved = [
        cloud_in(flow, 0.01, "stokes", start=0.1) for flow in (looped, closed, in_files(mesh, many, omega))
    ]
    for cloud in moved:
        cloud.advance(170)
    np.testing.assert_allclose(moved[0].particles.x, moved[2].particles.x, rtol=0, atol=1e-12)
    np.testing.assert_allclose(moved[0].particles.F, moved[2].particles.F, rtol=0, atol=1e-9)
    assert_same(moved[0].particles, moved[1].particles)


def test_few_times_are_in_memory_and_each_is_read_once(mesh):
    log = []
    times = np.linspace(0.0, 1.0, 21).tolist()
    flow = in_files(mesh, times, 5.0, log=log)
    cloud = cloud_in(flow, 0.01)
    for _ in range(100):
        cloud.advance(1)
        flow.sample(cloud.particles.x, cloud.particles.host, cloud.time)
        assert len(flow.arrays().fields) <= 3 * (mesh.n_points + mesh.n_cells)
    assert log == list(range(21))


def test_a_particle_appears_with_the_velocity_of_the_fluid_at_that_time(mesh):
    flow = in_files(mesh, [0.0, 1.0], growth=3.0)
    # So heavy that they keep it.
    p = spheres(np.tile(CENTRE, (2, 1)), d=2e-3, rho=1e12, mu=1.0, t0=[0.0, 0.25])
    p.v[:] = np.nan
    walls = [Rebound() if patch.type == "wall" else Escape() for patch in flow.patches]
    cloud = Cloud(p, flow, WATER, walls, 0.5, Models(integrator="rosenbrock"))
    cloud.advance(1)
    for k, t in enumerate(p.t0):
        u = (1.0 + 3.0 * t) * DRIFT
        np.testing.assert_allclose(p.v[k], u, rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(p.x[k] - CENTRE, (0.5 - t) * u, rtol=1e-6, atol=1e-9)


def test_beyond_its_times_a_flow_is_not_known(mesh):
    flow = in_files(mesh, [0.5, 1.0])
    cloud = cloud_in(flow, 0.1, start=0.5)
    cloud.advance(5)
    with pytest.raises(InputError, match=r"the flow is known from 0.5 s to 1 s, not from 1 s to 1.1 s"):
        cloud.advance(1)
    p = spheres(np.tile(CENTRE, (3, 1)), d=2e-3, rho=1e3, mu=1.0, t0=[0.6, 0.7, 0.65])
    with pytest.raises(
        InputError, match=r"2 of 3 particles would appear before the start of the run at 0.7 s"
    ):
        Cloud(p, flow, WATER, cloud.interactions, 0.1, start=0.7)


def test_a_time_that_cannot_be_read_stops_the_run_when_it_is_needed(mesh):
    def read(index):
        if index == 3:
            raise InputError("3/U: broken")
        return np.zeros((mesh.n_points + mesh.n_cells, 3)), np.zeros((mesh.n_points + mesh.n_cells, 3, 3))

    cloud = cloud_in(SeriesFlow(mesh, [0.0, 1.0, 2.0, 3.0, 4.0], read), 0.1, "stokes")
    with pytest.raises(InputError, match="3/U: broken"):
        cloud.advance(40)
    assert cloud.step == 20


def test_times_that_fill_the_period_are_proposed(mesh):
    with pytest.raises(InputError, match=r"of 1 s from 0 to 1 s: -time 3:4 selects such times\."):
        in_files(mesh, [0.0, 2.5, 3.0, 3.25, 3.5, 3.75, 4.0], period=1.0)


def tables(mesh, times, turbulent=True, **options):
    """Random values of all columns at all nodes and times, and the flow of them."""
    n = mesh.n_points + mesh.n_cells
    values = np.random.default_rng(3).normal(size=(len(times), n, 20))

    def read(k):
        parts = values[k, :, :3], values[k, :, 3:12].reshape(-1, 3, 3), values[k, :, 12:]
        return parts if turbulent else parts[:2]

    return values, SeriesFlow(mesh, times, read, turbulent=turbulent, **options)


@pytest.mark.parametrize("period", [None, 1.4])
def test_all_columns_are_linear_in_time_and_all_but_the_velocity_between_nodes(mesh, random, period):
    times = (0.0, 0.3, 1.0)
    values, flow = tables(mesh, times, period=period)
    steady = MeshFlow(mesh, values[0, :, :3], values[0, :, 3:12].reshape(-1, 3, 3))
    x = tuple(random.uniform(0.2, 0.8, 3))
    host = int(flow.locate(np.array([x]))[0])
    rows = mesh.tets[host]
    w = np.linalg.solve(np.vstack([mesh.nodes[rows].T, np.ones(4)]), [*x, 1.0])
    ends, at = (*times, 1.4) if period else times, (np.array([x]), np.array([host]), 0.0)
    for start, end, t in (
        (0.0, 1.0, 0.1), (0.0, 1.0, 0.5), (0.3, 0.9, 0.5), (0.0, 0.3, 0.2),
        *(((1.0, 1.4, 1.2), (0.3, 1.4, 1.1)) if period else ()),
    ):  # fmt: skip
        flow.load(start, end)
        arrays = flow.arrays()
        k = int(np.searchsorted(ends, t)) - 1
        length = ends[k + 1] - ends[k]
        s = (t - ends[k]) / length
        a, b = w @ values[k, rows], w @ values[(k + 1) % 3, rows]
        u, l, u_t = flow.kernels["sample"](arrays, host, x, t)
        mean = a + s * (b - a)
        u0, u1 = (
            MeshFlow(mesh, values[i, :, :3], values[i, :, 3:12].reshape(-1, 3, 3)).sample(*at)[0][0]
            for i in (k, (k + 1) % 3)
        )
        assert u == pytest.approx(u0 + s * (u1 - u0), rel=1e-9, abs=1e-10)
        assert l == pytest.approx(mean[3:12], rel=1e-9, abs=1e-10)
        assert u_t == pytest.approx((u1 - u0) / length, rel=1e-9, abs=1e-10)
        k_e, epsilon, slope, drift = flow.kernels["turbulence"](arrays, host, x, t)
        assert (k_e, epsilon, *slope, *drift) == pytest.approx(mean[12:], rel=1e-9, abs=1e-10)
        bends = []
        for level in (k, (k + 1) % 3):
            steady._arrays.nodes[:, 7:] = values[level, :, 3:12]
            bends.append(np.array(steady.kernels["curvature"](steady.arrays(), host, x, t)))
        found = np.array(flow.kernels["curvature"](arrays, host, x, t))
        np.testing.assert_allclose(found, bends[0] + s * (bends[1] - bends[0]), rtol=1e-9, atol=1e-10)
    assert flow.turbulence_at_nodes() == pytest.approx(values[0, :, 12:])
    name, u, l = flow.at_nodes()
    assert name == "0"
    assert np.array_equal(u, values[0, :, :3])
    assert np.array_equal(l, values[0, :, 3:12])


def test_without_turbulence_there_is_none(mesh):
    values, flow = tables(mesh, (0.0, 1.0), turbulent=False)
    flow.load(0.0, 1.0)
    assert flow.kernels["turbulence"](flow.arrays(), 0, (0.1, 0.1, 0.1), 0.3) == (
        0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0),
    )  # fmt: skip
    assert flow.turbulence_at_nodes().shape == (0, 8)
    assert flow.arrays().fields.shape[1] == values.shape[2] - 8


def test_what_the_mesh_does_is_the_same_as_in_a_steady_flow(mesh, random):
    _, flow = tables(mesh, (0.0, 1.0))
    n = mesh.n_points + mesh.n_cells
    steady = MeshFlow(mesh, np.zeros((n, 3)), np.zeros((n, 3, 3)))
    flow.load(0.0, 1.0)
    walls = [k for k, patch in enumerate(mesh.patches) if patch.type == "wall"]
    ours, theirs = flow.arrays(0.3, walls, 0.3, walls), steady.arrays(0.3, walls, 0.3, walls)
    F, chosen = (1.1, 0.2, 0.0, 0.0, 0.9, 0.1, 0.0, 0.0, 1.0), np.ones(len(mesh.patches), dtype=np.int8)
    for x0, x1 in random.uniform(0.01, 0.99, (10, 2, 3)):
        a, b = tuple(x0), tuple(x1)
        host = flow.kernels["recover"](ours, a)
        assert host == steady.kernels["recover"](theirs, a) >= 0
        for name, arguments in (
            ("walk", (host, a, b)), ("walk", (host, a, (2.0 * b[0] - a[0], b[1], -1.0))),
            ("gap", (host, a, F, 0.1)), ("walls", (host, a, 0.3, chosen)), ("cell_volume", (host,)),
            ("normal", (int(random.integers(len(mesh.triangles))), a)),
        ):  # fmt: skip
            assert flow.kernels[name](ours, *arguments) == steady.kernels[name](theirs, *arguments)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_a_period_ends_where_the_first_time_comes_again(scale):
    """Times from there on are left out, a millionth of the period before it as well."""
    times = scale * np.array([0.5, 1.0, 1.5, 2.0])
    assert one_period((*times, 2.5 * scale, 3.0 * scale), 2.0 * scale) == tuple(times)
    assert one_period((*times, scale * (2.5 - 1e-6)), 2.0 * scale) == tuple(times)
    assert one_period((*times, scale * 2.499), 2.0 * scale) == (*times, scale * 2.499)
    # The last interval may be twice as long as the longest of the others.
    assert one_period(tuple(times[:3]), 2.0 * scale) == tuple(times[:3])
    for few, period in ((times[:3], 2.1), (times[:1], 0.5), (times, 0.4)):
        end = scale * (0.5 + period)
        with pytest.raises(
            InputError, match=rf"the period of {scale * period:g} s from {few[0]:g} to {end:g} s"
        ):
            one_period(tuple(few), period * scale)


def test_a_flow_is_known_between_its_times(mesh):
    _, flow = tables(mesh, (1.0, 1.5, 2.0))
    slack = 1e-9 * 2.0
    assert flow.load(1.0 - 0.9 * slack, 2.0 + 0.9 * slack) == 2.0
    for start, end in ((1.0 - 2.0 * slack, 1.5), (1.0, 2.0 + 2.0 * slack), (3.0, 3.0), (0.0, 1.0)):
        with pytest.raises(InputError, match=r"the flow is known from 1 s to 2 s, not from"):
            flow.load(start, end)
    with pytest.raises(InputError, match=r"the times 1, 3, 2 do not rise"):
        tables(mesh, (1.0, 3.0, 2.0))
    with pytest.raises(InputError, match=r"the times 1, 1 do not rise"):
        tables(mesh, (1.0, 1.0))


def test_later_times_change_nothing_before_them(mesh):
    """A run continues when a solver has written more times."""
    _, short = tables(mesh, (1.0, 1.5))
    _, flow = tables(mesh, (1.0, 1.5, 2.0, 2.0001))
    short.load(1.0, 1.2)
    flow.load(1.0, 1.2)
    assert short.arrays().slack == flow.arrays().slack
    assert flow.times_until(1.5) == (1.0, 1.5)
    assert flow.times_until(1.6) == (1.0, 1.5, 2.0)
    assert flow.change_until(1.6, (0.5, 1.0, 1.5, 2.0)) == ""
    assert flow.change_until(1.6, (1.0, 1.4, 1.5, 2.0)) == ""
    assert flow.change_until(1.6, (1.0, 2.0)) == "the time 1.5 was added to the flow"
    assert flow.change_until(1.9, (1.0, 1.5, 1.8, 2.0)) == "the time 1.8 of the flow is missing"


def test_what_tells_a_series_from_another(mesh):
    values, flow = tables(mesh, (1.0, 1.5, 2.0), period=2.0)
    traits = flow.traits()
    assert traits["times"] == (1.0, 1.5, 2.0)
    assert traits["period"] == 2.0
    assert np.array_equal(traits["fields"], values[0])
    endless = tables(mesh, (1.0, 1.5))[1].traits()
    assert (endless["times"], endless["period"]) == ((1.0,), 0.0)
    faces, steady = flow.patch_faces("floor", 1.25), MeshFlow.patch_faces(flow, "floor", 1.25)
    mean = 0.5 * (values[0] + values[1])
    at = np.flatnonzero(mesh.triangle_patch == 0)
    np.testing.assert_allclose(faces.velocity, mean[mesh.triangles[at], :3], atol=1e-12)
    assert np.array_equal(faces.vertices, steady.vertices)
    hosts = np.array([0, 3], dtype=np.int32)
    assert flow.cell_size(hosts) == pytest.approx(np.cbrt(mesh.volumes[flow.cell_of(hosts)]))
    assert flow.cell_zone(None).volumes.sum() == pytest.approx(1.0)


def flow_of(mesh, period=None, names=("0", "0.5", "1.0", "1.5"), turbulent=False, log=None, **options):
    n = mesh.n_points + mesh.n_cells

    def read(name):
        if log is not None:
            log.append(name)
        f = float(name)
        fields = np.full((n, 3), f), np.zeros((n, 3, 3)), np.full((n, 8), f)
        return fields if turbulent else fields[:2]

    return series_of(Path("case"), mesh, names, read, period, ["a note."], turbulent=turbulent, **options)


def test_times_are_read_by_their_names(mesh):
    log = []
    flow = flow_of(mesh, log=log)
    x = np.array([[0.3, 0.4, 0.6]])
    u, _ = flow.sample(x, flow.locate(x), 1.2)
    assert u[0] == pytest.approx([1.2] * 3)
    assert log[:2] == ["1.0", "1.5"]
    assert flow.times == (0.0, 0.5, 1.0, 1.5)
    assert flow.notes == ("a note.", "The flow is linear in time between 4 times from 0 to 1.5.")
    assert flow_of(mesh, 2.0).notes[-1] == (
        "The flow is linear in time between 4 times from 0 to 1.5, and repeats itself every 2 s."
    )


@pytest.mark.parametrize(("turbulent", "columns"), [(False, 12), (True, 20)])
def test_all_times_of_a_period_are_kept_if_they_have_room(turbulent, columns, mesh, monkeypatch):
    """Eight bytes for each column at each node; otherwise only what a step needs."""
    a_time = 8 * columns * (mesh.n_points + mesh.n_cells)
    for room, kept in ((4 * a_time, 4), (4 * a_time - 1, 3), (a_time, 2)):
        monkeypatch.setattr("foamprb.flow.series._MOST_IN_MEMORY", room)
        flow = flow_of(mesh, 2.0, turbulent=turbulent)
        for start in (0.0, 0.5, 1.0):
            flow.load(start, start + 0.5)
        assert flow._fields.nbytes == kept * a_time
    once = flow_of(mesh, turbulent=turbulent)
    once.load(0.0, 0.5)
    assert once._fields.nbytes == 2 * a_time


def test_messages_name_the_case(mesh):
    with pytest.raises(InputError, match=r"^case: the times 0, 2, 1 do not rise\.$"):
        flow_of(mesh, names=("0", "2", "1"))
    with pytest.raises(InputError, match=r"^case: the times from 0 to .* do not fill the period of 9 s"):
        flow_of(mesh, 9.0)


def test_zones_of_cells_go_with_the_flow():
    mesh = build_mesh(block(2, 0.0))
    flow = flow_of(mesh, zones=lambda: {"some": np.array([3])})
    assert flow.cell_zone("some").volumes.sum() == pytest.approx(mesh.volumes[3])
