"""Outlines of bodies against shadows that are drawn point by point, and against numbers of the theory."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import cyclic_row
from observing import MEAN, RADIUS, WATER, column, observe, pipe_cloud, table
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from foamprb import analytic
from foamprb.body.quadratic import tube_amplitude, tube_deformation, tube_velocity
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Cyclic, Escape, Rebound
from foamprb.cloud.state import drops, spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.deformability_cytometry import Channel, DeformabilityCytometry, outline
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.errors import InputError
from foamprb.flow.curvatures import mean_curvatures
from foamprb.flow.meshflow import MeshFlow


def shaped(*F, B=None):
    """Spheres of the radius 1 with deformation gradients and quadratic modes."""
    p = spheres(np.zeros((len(F), 3)), d=2.0, rho=1.0, mu=1.0)
    p.F[:] = np.reshape(F, (-1, 9))
    if B is not None:
        p.B[:] = B
    return p


def test_an_outline_is_that_of_the_points_of_the_surface():
    random = np.random.default_rng(3)
    unit = random.standard_normal((400_000, 3))
    unit /= np.linalg.norm(unit, axis=1)[:, None]
    axes, turn = np.array([3.0, 2.0, 0.7]), Rotation.from_rotvec([0.3, -1.1, 0.6]).as_matrix()
    F = turn * axes
    view = np.array([0.2, -0.5, 0.6]) / np.linalg.norm([0.2, -0.5, 0.6])
    flat = np.linalg.svd(view[None])[2][1:]
    hull = ConvexHull(unit @ F.T @ flat.T)
    found = outline(shaped(F), view)
    # Of a polygon, in two dimensions the hull's volume is its area, and its area its perimeter.
    assert found.area[0] == pytest.approx(hull.volume, rel=1e-3)
    assert found.perimeter[0] == pytest.approx(hull.area, rel=1e-3)


def test_a_sphere_has_no_deformation_and_an_ellipse_that_of_its_axes():
    found = outline(shaped(np.eye(3), np.diag([2.0, 1.0, 3.0])), np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(found.area, [np.pi, 2.0 * np.pi])
    np.testing.assert_allclose(found.semi_axes, [[1.0, 1.0], [2.0, 1.0]])
    # Ramanujan's second formula for the perimeter, exact to 1e-6 here.
    h = (1.0 / 3.0) ** 2
    perimeter = np.pi * 3.0 * (1.0 + 3.0 * h / (10.0 + np.sqrt(4.0 - 3.0 * h)))
    expected = [0.0, 1.0 - 2.0 * np.sqrt(2.0) * np.pi / perimeter]
    np.testing.assert_allclose(found.deformation, expected, atol=1e-6)


def test_an_outline_has_both_modes():
    """In a flow without symmetry, seen along (0, −0.8, 0.6), with μ_f/μ_s = 1e-4."""
    E = np.array([[1.0, 1.0, 1.5], [1.0, -2.0, 0.0], [1.5, 0.0, 1.0]])
    S = np.array([0.4, 1.8, 4.0 / 15.0, -8.0 / 15.0, -1.0 / 3.0, 0.4, 29.0 / 15.0])
    B, view = 1e-4 * 35.0 / 32.0 * S, np.array([0.0, -0.8, 0.6])
    bullet, both = outline(shaped(np.eye(3), np.eye(3) + 2.5e-4 * E, B=B), view).deformation
    assert bullet == pytest.approx(0.00054247e-4, rel=1e-5)
    assert both == pytest.approx(0.00219791e-4, rel=1e-3)


def test_the_outline_of_a_bullet():
    """Seen from the side: π a² (1 − ¾ ε²), shifted by ⅜ ε a; from the front a disc."""
    eps, a = 0.1, 5e-6
    p = spheres(np.zeros((1, 3)), d=2.0 * a, rho=1.0, mu=1.0)
    p.B[:] = [0.0, -0.5 * eps, 0.0, 0.0, 0.0, eps, 0.0]
    seen = outline(p, np.array([0.6, 0.0, 0.8]))
    assert seen.area[0] == pytest.approx(np.pi * a * a * (1.0 - 0.75 * eps**2))
    assert seen.deformation[0] == pytest.approx(25.0 / 32.0 * eps**2)
    assert seen.perimeter[0] == pytest.approx(
        2.0 * np.sqrt(np.pi * seen.area[0]) / (1.0 - 25.0 / 32.0 * eps**2)
    )
    np.testing.assert_allclose(seen.shift, [[0.0, 0.375 * eps * a, 0.0]], atol=1e-15)
    assert seen.bullet_amplitude[0] == pytest.approx(eps)
    assert outline(p, np.array([0.0, 1.0, 0.0])).deformation[0] == pytest.approx(0.0, abs=1e-15)


def test_particles_are_seen_where_and_when_they_cross(tmp_path):
    cloud = pipe_cloud(medium=WATER)
    p, start = cloud.particles, cloud.particles.x[:, 0].copy()
    r = np.hypot(p.x[:, 1], p.x[:, 2])
    speed = 2.0 * MEAN * (1.0 - (r / RADIUS) ** 2)
    plane = DeformabilityCytometry(origin=(0.01, 0, 0), normal=(2, 0, 0), view=(0, 0, 1))
    observe(cloud, plane, tmp_path)
    rows = table(tmp_path / "f/cytometry.csv")
    ids = column(rows, "id").astype(int)
    assert len(ids) > 20
    np.testing.assert_allclose(column(rows, "t"), p.t0[ids] + (0.01 - start[ids]) / speed[ids], rtol=1e-4)
    np.testing.assert_allclose(column(rows, "x"), 0.01, rtol=1e-9)
    assert (column(rows, "direction") == 1).all()
    deformation = column(rows, "deformation")
    assert (deformation >= -1e-12).all()
    assert deformation.max() > 0.001
    # Taken along the view, none has more than the area of the longest and the middle axis.
    assert (column(rows, "area") < np.pi * p.R[ids] ** 2 * 2.0).all()


def test_directions_of_no_length_are_refused():
    with pytest.raises(InputError, match=r"has a view \(0 0 0\)"):
        DeformabilityCytometry(origin=(0, 0, 0), normal=(1, 0, 0), view=(0, 0, 0))


# --- Cells near the axis of a tube --------------------------------------------------------------------------

TUBE, U, MU_F = 1e-5, 0.2, 15e-3
"""Radius, m; velocity on the axis, m/s; viscosity, Pa s."""


def passed(folder, places, d, function, dt=2e-6, steps=60, models=(), material="neoHooke", eta=0.0):
    """Cells of 1 kPa that were released round at the inlet; the table of a function at x = 20 µm."""
    make = (lambda **k: drops(gamma=1e-3, **k)) if material == "drop" else (lambda **k: spheres(mu=1e3, **k))
    p = make(x=np.reshape(places, (-1, 3)), d=np.asarray(d), rho=1000.0, eta=eta)
    flow = analytic.pipe(TUBE, 0.5 * U, 1e-4)
    selected = Models(integrator="stokes", material=material, surroundings=models, shape="quadratic")
    patches = [Escape()] * len(flow.patches)
    cloud = Cloud(p, flow, Medium(MU_F, 1000.0, (0.0, 0.0, 0.0)), patches, dt, selected)
    observe(cloud, function, folder, (steps,))
    return table(next((folder / "f").glob("c[ry]*.csv")))


def camera(channel=None):
    return DeformabilityCytometry((2e-5, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), channel)


@pytest.mark.parametrize("eta", [0.0, 0.05])
def test_a_bullet_is_seen_as_far_as_it_has_come(tmp_path, eta):
    """ε = ⅞ μ U a/(μ_s R²) (1 − exp −t/τ₃), in the middle of a step that is longer than τ₃."""
    a = 3e-6
    (row,) = passed(tmp_path, (0.0, 0.0, 0.0), 2.0 * a, camera(), dt=6e-5, steps=2, eta=eta)
    tau = (19.0 * MU_F + 16.0 * eta) / (16.0 * 1e3)
    eps = 7.0 / 8.0 * MU_F * U * a / (1e3 * TUBE**2) * (1.0 - np.exp(-float(row["t"]) / tau))
    assert float(row["deformation"]) == pytest.approx(25.0 / 32.0 * eps**2, rel=1e-6)
    assert float(row["shiftx"]) == pytest.approx(0.375 * eps * a, rel=1e-6)
    assert float(row["bulletAmplitude"]) == pytest.approx(eps, rel=1e-6)


def test_a_mode_turns_between_the_ends_of_a_step(tmp_path):
    """Off the axis; against steps of an eighth of the length."""
    plane, rows = ParticleCollector("plane", (2e-5, 0.0, 0.0), (1.0, 0.0, 0.0)), []
    for dt in (8e-6, 1e-6):
        for function in (plane, camera()):
            folder = tmp_path / f"{type(function).__name__}{dt}"
            rows += passed(folder, (0.0, 0.6 * TUBE, 0.0), 2e-6, function, dt, round(3.2e-4 / dt))
    assert float(rows[0]["bulletAmplitude"]) == pytest.approx(float(rows[2]["bulletAmplitude"]), rel=5e-3)
    for name in ("shiftx", "shifty"):
        assert float(rows[1][name]) == pytest.approx(float(rows[3][name]), rel=1e-2)


def test_a_mode_turns_where_coupled_patches_do(tmp_path):
    """Round and round through a sector of 60°; seen at 1° within a step that began at 55°."""
    mesh, seen = cyclic_row(60.0, 1), []

    def velocity(x):
        rate = 4.0 + 20.0 * (np.hypot(x[:, 0], x[:, 1]) - 1.5) ** 2
        return rate[:, None] * np.column_stack([-x[:, 1], x[:, 0], 0.0 * rate])

    h = 1e-5 * np.eye(3)
    l = np.stack([(velocity(mesh.nodes + e) - velocity(mesh.nodes - e)) / 2e-5 for e in h], axis=2)
    flow = MeshFlow(mesh, velocity(mesh.nodes), l, curvatures=mean_curvatures(mesh, l))
    start, at = np.radians([7.0, 1.0])
    plane = ParticleCollector("plane", (0.0, 0.0, 0.0), (-np.sin(at), np.cos(at), 0.0))
    walls = [Cyclic() if patch.neighbour else Rebound() for patch in flow.patches]
    for dt in (0.03, 0.03 / 16.0):
        p = spheres([(1.5 * np.cos(start), 1.5 * np.sin(start), 0.5)], d=2e-2, rho=1.0, mu=20.0)
        models = Models(integrator="stokes", shape="quadratic", tolerance=np.inf, rebounds=True)
        cloud = Cloud(p, flow, Medium(1.0, 1.0, (0.0, 0.0, 0.0)), walls, dt, models)
        functions = observe(cloud, plane, tmp_path, (round(0.3 / dt),))
        seen.append(functions.state()["f/crossings"][0])
    assert seen[0][1] == pytest.approx(seen[1][1], rel=1e-2)
    size = np.abs(seen[1][15:22]).max()
    assert size > 5e-3
    np.testing.assert_allclose(seen[0][15:22], seen[1][15:22], atol=0.05 * size)


def test_walls_of_a_channel_act_on_bodies_near_the_axis(tmp_path, caplog):
    """On those within 0.2 radii; a square channel is a tube of 0.547 of its width."""
    a = np.array([2e-6, 5e-6, 5e-6, 5e-6, 8e-6])
    y = np.array([0.0, 0.9e-6, 0.9e-6, 1.1e-6, 0.0])
    places = np.column_stack([np.zeros(5), y, np.zeros(5)])
    free = passed(tmp_path / "free", places, 2.0 * a, camera())
    assert not caplog.records
    square = Channel("square", width=TUBE / 0.547)
    near = {"within": places[:3], "all": places}
    for name, channel in (("within", Channel("tube", radius=TUBE)), ("all", square)):
        n = len(near[name])
        rows = passed(tmp_path / name, near[name], 2.0 * a[:n], camera(channel))
        b = np.where(np.arange(n) < 3, a[:n] / TUBE, 0.0)
        ids = column(rows, "id").astype(int)
        ours, before = column(rows, "deformation"), column(free, "deformation")
        order, other = np.argsort(ids), np.argsort(column(free, "id"))[:n]
        bullets = 25.0 / 32.0 * column(free, "bulletAmplitude")[other] ** 2
        expected = before[other] + (tube_deformation(b) ** 2 - 1.0) * bullets
        np.testing.assert_allclose(ours[order], expected, rtol=1e-3)
        ratio = column(rows, "shiftx")[order] / column(free, "shiftx")[other]
        np.testing.assert_allclose(ratio, tube_amplitude(b), rtol=1e-9)
        lost = 1.0 - column(rows, "area")[order][0] / (np.pi * a[0] ** 2)
        assert lost == pytest.approx(0.75 * column(rows, "bulletAmplitude")[order][0] ** 2, rel=1e-4)
        np.testing.assert_array_equal(column(rows, "channel")[order], (b > 0.0).astype(int))
        speed = U * (1.0 - (y[:n] / TUBE) ** 2) * tube_velocity(b)
        np.testing.assert_allclose(column(rows, "speed")[order], speed, rtol=2e-2)
        warned = [record.getMessage() for record in caplog.records]
        assert len(warned) == (name == "all")
    assert "2 of 5 crossings so far are more than 0.2 radii of the body from the axis" in warned[0]


def test_the_speed_has_the_correction_by_faxen_once(tmp_path):
    channel = Channel("tube", radius=TUBE)
    speeds = [
        float(passed(tmp_path / str(k), (0.0, 0.0, 0.0), 1e-5, camera(channel), models=models)[0]["speed"])
        for k, models in enumerate(((), (FaxenCorrection(),)))
    ]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-3)


def test_a_channel_needs_its_size_and_solids_with_a_quadratic_mode(tmp_path):
    for wrong, message in (
        ({"type": "tube", "width": 1.0}, "has type tube, which needs radius, and not width"),
        ({"type": "square", "radius": 1.0, "width": 1.0}, "has type square, which needs width"),
    ):
        with pytest.raises(InputError, match=message):
            Channel(**wrong)
    with pytest.raises(InputError, match="cloudFunctions/f: a channel needs subModels/shapeModel quadratic"):
        observe(pipe_cloud(), camera(Channel("tube", radius=TUBE)), tmp_path)
    with pytest.raises(InputError, match="a channel needs solids"):
        passed(tmp_path, (0, 0, 0), 1e-6, camera(Channel("tube", radius=TUBE)), material="drop", eta=1e-3)
