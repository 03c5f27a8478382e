"""Particles that cross a plane, against paths that are known."""

from __future__ import annotations

import numpy as np
import pytest
import pyvista
from mesh_shapes import cyclic_row
from observing import (
    MEAN,
    RADIUS,
    WATER,
    D,
    column,
    go_on,
    made_steps,
    observe,
    observed,
    pipe_cloud,
    see,
    table,
)

from foamprb import analytic
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Cyclic, Rebound
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.flow.meshflow import MeshFlow


def collector(at=0.01, **options):
    return ParticleCollector("plane", (at, 0.0, 0.0), (2.0, 0.0, 0.0), **options)


@pytest.mark.parametrize("every", [1, 16, 100])
def test_tracers_cross_when_their_speed_says(tmp_path, every):
    """Without gravity the paths are straight and even: exact, however seldom one looks."""
    cloud = pipe_cloud(medium=WATER)
    p = cloud.particles
    r2 = p.x[:, 1] ** 2 + p.x[:, 2] ** 2
    speed = 2.0 * MEAN * (1.0 - r2 / RADIUS**2)
    p.v[:] = speed[:, None] * [1.0, 0.0, 0.0]
    due = p.t0 + (0.01 - p.x0[:, 0]) / speed
    observe(cloud, collector(), tmp_path)
    rows = table(tmp_path / "f/crossings.csv")
    k = column(rows, "id").astype(int)
    np.testing.assert_array_equal(k, np.argsort(due)[: len(k)])
    np.testing.assert_allclose(column(rows, "t"), due[k], rtol=1e-9)
    np.testing.assert_allclose(column(rows, "x"), 0.01, rtol=1e-12)
    np.testing.assert_allclose(column(rows, "y"), p.x0[k, 1], rtol=1e-9)
    assert len(k) == np.count_nonzero(due < 0.07)
    totals = table(tmp_path / "f/collector.csv")
    assert len(totals) == 6
    mass = 2560.0 * np.pi / 6.0 * D**3
    for row in totals:
        end, own = float(row["time"]), p.injector == ("one", "two").index(row["injector"])
        begin = {0.02: 0.0, 0.04: 0.02, 0.07: 0.04}[round(end, 9)]
        assert int(row["parcels"]) == np.count_nonzero(own & (due <= end))
        assert int(row["parcelsOpposite"]) == 0
        assert float(row["mass"]) == pytest.approx(int(row["parcels"]) * mass, rel=1e-6, abs=0.0)
        fresh = np.count_nonzero(own & (due > begin) & (due <= end))
        assert float(row["massFlowRate"]) == pytest.approx(fresh * mass / (end - begin), rel=1e-6, abs=0.0)


def test_a_particle_without_a_velocity_crosses_where_its_path_says(tmp_path):
    """As one that is released with the fluid's, before its first step."""
    cloud = pipe_cloud(medium=WATER)
    p = cloud.particles
    speed = 2.0 * MEAN * (1.0 - (p.x[:, 1] ** 2 + p.x[:, 2] ** 2) / RADIUS**2)
    due = p.t0 + (0.01 - p.x0[:, 0]) / speed
    p.v[:] = np.nan
    observe(cloud, collector(), tmp_path)
    rows = table(tmp_path / "f/crossings.csv")
    k = column(rows, "id").astype(int)
    assert len(k) > 5
    np.testing.assert_allclose(column(rows, "t"), due[k], rtol=1e-3)
    np.testing.assert_allclose(column(rows, "x"), 0.01, rtol=1e-12)


def orbit(folder, dt, function, turns=3.2):
    """A particle on a given circle, in steps of dt; the rows of crossings.csv."""
    p = spheres([[1.0, 0.2, 0.0]], d=D, rho=1.0, mu=1.0)
    cloud = Cloud(p, analytic.rotation(1.0), WATER, (), dt)
    function_set = CloudFunctions({"f": function}, observed(cloud))
    t = np.arange(round(turns * 2.0 * np.pi / dt) + 1) * dt
    phase, radius = t + np.arctan2(0.2, 1.0), np.hypot(1.0, 0.2)
    x = radius * np.stack([np.cos(phase), np.sin(phase), 0.0 * t], axis=1)
    v = radius * np.stack([-np.sin(phase), np.cos(phase), 0.0 * t], axis=1)
    see(cloud, made_steps(t, x, v))
    cloud.step = len(t) - 1
    folder.mkdir(exist_ok=True)
    function_set.write(folder)
    return table(folder / "f/crossings.csv"), table(folder / "f/collector.csv")


def circle(**options):
    return ParticleCollector("plane", (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), **options)


def test_a_curved_path_is_met_to_fourth_order(tmp_path):
    """Half a turn after half a turn through y = 0, to and fro."""
    errors = []
    for dt in (0.4, 0.2):
        rows, totals = orbit(tmp_path / str(dt), dt, circle())
        exact = np.pi * np.arange(1, len(rows) + 1) - np.arctan2(0.2, 1.0)
        assert len(rows) == 6
        np.testing.assert_array_equal(column(rows, "direction"), [-1, 1, -1, 1, -1, 1])
        errors.append(np.abs(column(rows, "t") - exact).max())
        assert (totals[0]["parcels"], totals[0]["parcelsOpposite"]) == ("3", "3")
    assert errors[0] < 1e-3
    assert errors[1] < errors[0] / 10.0


def test_what_comes_back_may_be_taken_off(tmp_path):
    mass = np.pi / 6.0 * D**3
    _, (row, _) = orbit(tmp_path / "sum", 0.2, circle())
    assert float(row["mass"]) == pytest.approx(6.0 * mass, rel=1e-6, abs=0.0)
    _, (row, _) = orbit(tmp_path / "net", 0.2, circle(negateParcelsOppositeNormal=True))
    assert float(row["mass"]) == pytest.approx(0.0, abs=1e-12 * mass)


def test_only_a_disc_of_the_plane_counts(tmp_path):
    disc = ParticleCollector("plane", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), radius=0.5)
    rows, _ = orbit(tmp_path, 0.1, disc)
    assert (column(rows, "x") > 0.9).all()
    assert len(rows) == 3


def test_counts_may_begin_anew_at_each_writing(tmp_path):
    cloud = pipe_cloud(medium=WATER)
    observe(cloud, collector(resetOnWrite=True), tmp_path)
    parts = column(table(tmp_path / "f/collector.csv"), "parcels")
    other = pipe_cloud(medium=WATER)
    observe(other, collector(), tmp_path / "all")
    totals = column(table(tmp_path / "all/f/collector.csv"), "parcels")
    np.testing.assert_array_equal(np.cumsum(parts.reshape(3, 2), axis=0), totals.reshape(3, 2))


@pytest.mark.parametrize("every", [1, 7, 400])
def test_passages_of_coupled_patches_are_no_crossings(every, tmp_path):
    """Straight through periods of 1 m at 4 m/s: one crossing per period, for any interval of tracks."""
    mesh = cyclic_row(0.0, 1)
    u = np.broadcast_to([4.0, 0.0, 0.0], mesh.nodes.shape).copy()
    flow = MeshFlow(mesh, u, np.zeros((len(u), 3, 3)))
    p = spheres([[0.25, 0.5, 0.5], [0.6, 0.4, 0.4]], d=1e-3, rho=1e3, mu=1.0)
    p.v[:] = [4.0, 0.0, 0.0]
    walls = [Cyclic() if patch.neighbour else Rebound() for patch in flow.patches]
    cloud = Cloud(p, flow, WATER, walls, 1e-3, Models(integrator="paper", rebounds=True))
    plane = (0.5, 0.0, 0.0), (1.0, 0.0, 0.0)
    functions = CloudFunctions(
        {
            "plane": ParticleCollector("plane", *plane, negateParcelsOppositeNormal=True),
            "camera": DeformabilityCytometry(*plane, (0.0, 1.0, 0.0)),
            "tracks": ParticleTracks(every, 1000),
        },
        observed(cloud),
    )
    go_on(cloud, functions, tmp_path, (800,))
    expected = [(0, (n + 0.25) / 4.0) for n in range(4) if n + 0.25 < 3.2] + [
        (1, (n + 0.9) / 4.0) for n in range(3)
    ]
    for file in ("plane/crossings.csv", "camera/cytometry.csv"):
        rows = table(tmp_path / file)
        found = sorted(zip(column(rows, "id").astype(int), column(rows, "t"), strict=True))
        np.testing.assert_allclose(found, expected, rtol=1e-6)
        assert set(column(rows, "direction")) == {1}
    totals = table(tmp_path / "plane/collector.csv")
    assert sum(float(row["mass"]) for row in totals) == pytest.approx(
        len(expected) * 1e3 * np.pi / 6.0 * 1e-9
    )
    tracks = pyvista.read(tmp_path / "tracks/tracks.vtp")
    offsets = tracks.lines
    lengths = []
    while len(offsets):
        x = tracks.points[offsets[1 : offsets[0] + 1], 0]
        assert (np.diff(x) >= 0.0).all()
        lengths.append(x[-1] - x[0])
        offsets = offsets[offsets[0] + 1 :]
    assert len(lengths) == 4 + 4
    assert sum(lengths) == pytest.approx(2 * 3.2)
