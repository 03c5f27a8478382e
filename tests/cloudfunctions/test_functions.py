"""What is observed of a cloud on the way, against the paths that the particles are known to take."""

from __future__ import annotations

import csv
import re
import shutil

import numpy as np
import pytest
import pyvista
from paths import PIPE
from pipe_case import copy_of_pipe, edit

from foamprb import analytic, execute, prepare
from foamprb.body.tensor import principal_frame
from foamprb.cli import main
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import MEASURES, context
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.functions import (
    FUNCTIONS,
    Functions,
    Look,
    ParticleCollector,
    ParticleHistogram,
    ParticleTracks,
    PatchPostProcessing,
    SuspensionStress,
)
from foamprb.errors import InputError, RunStopped

RADIUS, MEAN, D = 2.1e-3, 0.485, 5e-6
WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
# So strong a gravity that half of the particles reach the wall before the end of the pipe.
AIR = Medium(1.8e-5, 1.2, (0.0, -400.0, 0.0))


def pipe_cloud(n=40, medium=AIR, length=0.03, integrator="stokes", walls=None, **options):
    """Particles spread over the inlet that start one after the other, from two injection models."""
    random = np.random.default_rng(1)
    r, phi = 0.97 * RADIUS * np.sqrt(random.uniform(0, 1, n)), random.uniform(0, 2 * np.pi, n)
    x = np.stack([np.full(n, 1e-3), r * np.cos(phi), r * np.sin(phi)], axis=1)
    mu = medium.mu * 900.0 / random.uniform(0.1, 1.0, n)
    p = spheres(x, d=D, rho=2560.0, mu=mu, t0=random.uniform(0.0, 5e-3, n))
    p.injector[:] = np.arange(n) % 2
    flow = analytic.pipe(RADIUS, MEAN, length)
    walls = walls or (Stick(), Escape(), Escape())
    return Cloud(p, flow, medium, walls, 1e-4, Models(integrator=integrator), **options)


def look_at(cloud):
    return Look(cloud, ("one", "two"), tuple(patch.name for patch in cloud.flow.patches))


def observe(cloud, function, folder, writes=(200, 400, 700)):
    """Advance as a run does, and write at some steps."""
    functions = Functions({"f": function}, look_at(cloud))
    go_on(cloud, functions, folder, writes)
    return functions


def go_on(cloud, functions, folder, writes):
    for target in writes:
        while cloud.step < target:
            until = functions.next_look(target)
            cloud.advance(until - cloud.step)
            cloud.step = until
            functions.see()
        functions.write(folder)


def table(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


class TestRegistry:
    def test_looks_come_at_multiples_and_no_later_than_asked(self):
        cloud = pipe_cloud(2)
        functions = Functions(
            {
                "a": ParticleHistogram(sampleInterval=6),
                "b": ParticleTracks(4, 10),
                "c": PatchPostProcessing(()),
            },
            look_at(cloud),
        )
        steps = []
        while cloud.step < 20:
            cloud.step = functions.next_look(20)
            steps.append(cloud.step)
        assert steps == [4, 6, 8, 12, 16, 18, 20]
        assert Functions({}, look_at(cloud)).next_look(100) == 100

    def test_a_mistake_names_the_function(self):
        with pytest.raises(InputError, match=r"cloudFunctions/who: patch wal is not in the mesh\. Did"):
            Functions({"who": PatchPostProcessing(("wal",))}, look_at(pipe_cloud(2)))
        bouncing = pipe_cloud(2, walls=(Rebound(), Escape(), Escape()))
        with pytest.raises(InputError, match="patch wall: particles bounce off it"):
            Functions({"who": PatchPostProcessing(("wall",))}, look_at(bouncing))

    @pytest.mark.parametrize(
        "function",
        [
            ParticleTracks(7, 1000),
            PatchPostProcessing(("wall", "outlet")),
            ParticleCollector("plane", (0.01, 0.0, 0.0), (1.0, 0.0, 0.0)),
            ParticleHistogram(nBins=5),
        ],
        ids=lambda f: type(f).__name__,
    )
    def test_what_is_remembered_survives_a_restart(self, function, tmp_path):
        cloud = pipe_cloud()
        observe(cloud, function, tmp_path / "whole")
        first = pipe_cloud()
        state = observe(first, function, tmp_path / "parts", writes=(200,)).state()
        np.savez(tmp_path / "state.npz", allow_pickle=False, **state)
        second = pipe_cloud()
        functions = Functions({"f": function}, look_at(second))
        for array, saved in zip(second.particles, first.particles, strict=True):
            array[:] = saved
        second.step = first.step
        with np.load(tmp_path / "state.npz", allow_pickle=False) as saved:
            functions.restore(dict(saved))
        go_on(second, functions, tmp_path / "parts", (400, 700))
        whole = sorted(path.relative_to(tmp_path / "whole") for path in (tmp_path / "whole").rglob("*.*"))
        assert whole
        for path in whole:
            assert (tmp_path / "parts" / path).read_bytes() == (tmp_path / "whole" / path).read_bytes()

    def test_the_memory_of_other_functions_is_refused(self):
        look = look_at(pipe_cloud(2))
        state = Functions({"a": ParticleTracks(1, 1), "b": ParticleHistogram()}, look).state()
        with pytest.raises(InputError, match="cloudFunctions: b, c was not observed from the start"):
            Functions({"a": ParticleTracks(1, 1), "c": ParticleHistogram()}, look).restore(state)


class TestTracks:
    def test_paths_lead_from_release_to_end_through_the_looks(self, tmp_path):
        cloud = pipe_cloud()
        n = cloud.particles.size
        recorded = [[(*x, t)] for x, t in zip(cloud.particles.x0, cloud.particles.t0, strict=True)]
        reference = pipe_cloud()
        for _ in range(0, 700, 50):
            reference.advance(50)
            p = reference.particles
            for k in np.flatnonzero(p.status != Status.PENDING):
                if p.t[k] > recorded[k][-1][3]:
                    recorded[k].append((*p.x[k], p.t[k]))
        observe(cloud, ParticleTracks(50, 1000), tmp_path)
        tracks = pyvista.read(tmp_path / "f/tracks.vtp")
        assert tracks.n_lines == n
        np.testing.assert_array_equal(tracks.cell_data["origId"], np.arange(n))
        np.testing.assert_array_equal(tracks.cell_data["status"], cloud.particles.status)
        assert set(cloud.particles.status) == {Status.STUCK, Status.ESCAPED}
        at = 0
        for k, path in enumerate(recorded):
            assert tracks.lines[at] == len(path)
            ids = tracks.lines[at + 1 : at + 1 + len(path)]
            at += 1 + len(path)
            np.testing.assert_array_equal(tracks.points[ids], np.array(path)[:, :3])
            np.testing.assert_array_equal(tracks.point_data["time"][ids], np.array(path)[:, 3])
            np.testing.assert_array_equal(tracks.points[ids[-1]], cloud.particles.x[k])
        axes = tracks.point_data["semiAxes"]
        D_found = (axes[:, 0] - axes[:, 2]) / (axes[:, 0] + axes[:, 2])
        np.testing.assert_allclose(tracks.point_data["taylorDeformation"], D_found, atol=1e-14)
        assert list(tracks.field_data["injectorNames"]) == ["one", "two"]

    def test_samples_and_tracks_have_their_limits(self, tmp_path):
        cloud = pipe_cloud()
        observe(cloud, ParticleTracks(1, maxSamples=21, maxTracks=8), tmp_path)
        tracks = pyvista.read(tmp_path / "f/tracks.vtp")
        np.testing.assert_array_equal(tracks.cell_data["origId"], np.arange(0, 40, 5))
        assert tracks.n_points == 8 * 21

    def test_what_has_not_moved_has_no_path(self, tmp_path):
        cloud = pipe_cloud()
        functions = Functions({"f": ParticleTracks(10, 21)}, look_at(cloud))
        functions.write(tmp_path)
        assert pyvista.read(tmp_path / "f/tracks.vtp").n_points == 0


class TestPatches:
    def test_who_hits_when_and_in_what_shape(self, tmp_path):
        cloud = pipe_cloud()
        observe(cloud, PatchPostProcessing(("wall", "outlet")), tmp_path)
        p = cloud.particles
        seen = 0
        for index, name, status in ((0, "wall", Status.STUCK), (2, "outlet", Status.ESCAPED)):
            rows = table(tmp_path / f"f/{name}.csv")
            k = column(rows, "id").astype(int)
            seen += len(k)
            assert set(k) == set(np.flatnonzero((p.patch == index) & (p.status == status)))
            np.testing.assert_array_equal(column(rows, "t"), np.sort(p.t[k]))
            np.testing.assert_array_equal(column(rows, "t"), p.t[k])
            np.testing.assert_array_equal(column(rows, "y"), p.x[k, 1])
            assert [row["injector"] for row in rows] == [("one", "two")[i % 2] for i in k]
            np.testing.assert_allclose(column(rows, "mass"), 2560.0 * np.pi / 6.0 * D**3, rtol=1e-14)
            frame, stretches = principal_frame(tuple(p.F[k].T))
            axes = np.sort(np.stack(stretches, axis=1) * D / 2.0, axis=1)[:, ::-1]
            np.testing.assert_allclose(np.stack([column(rows, c) for c in "abc"], axis=1), axes, rtol=1e-12)
            # The normal that points out of the fluid: radial on the wall, along the pipe at its end.
            out = p.x[k] * [0.0, 1.0, 1.0] if name == "wall" else np.tile([1.0, 0.0, 0.0], (len(k), 1))
            out /= np.linalg.norm(out, axis=1)[:, None]
            cosine = np.einsum("ni,ni->n", p.v[k], out) / np.linalg.norm(p.v[k], axis=1)
            np.testing.assert_allclose(np.cos(np.radians(column(rows, "impactAngle"))), cosine, atol=1e-9)
            longest = np.argmax(np.stack(stretches), axis=0)
            e = np.stack(frame, axis=1).reshape(-1, 3, 3)[np.arange(len(k)), longest]
            cosine = np.abs(np.einsum("ni,ni->n", e, out))
            np.testing.assert_allclose(np.cos(np.radians(column(rows, "axisAngle"))), cosine, atol=1e-9)
        assert seen == p.size

    def test_touching_by_the_centre(self, tmp_path):
        cloud = pipe_cloud()
        centre = Cloud(
            cloud.particles, cloud.flow, AIR, cloud.interactions, cloud.dt, Models(touching="centre")
        )
        observe(centre, PatchPostProcessing(("wall",), maxStoredParcels=3), tmp_path)
        rows = table(tmp_path / "f/wall.csv")
        assert len(rows) == 3
        assert np.isfinite(column(rows, "impactAngle")).all()


class TestCollector:
    def collector(self, at=0.01, **options):
        return ParticleCollector("plane", (at, 0.0, 0.0), (2.0, 0.0, 0.0), **options)

    @pytest.mark.parametrize("every", [1, 16, 100])
    def test_tracers_cross_when_their_speed_says(self, tmp_path, every):
        """Without gravity the paths are straight and even: exact, however seldom one looks."""
        cloud = pipe_cloud(medium=WATER)
        p = cloud.particles
        r2 = p.x[:, 1] ** 2 + p.x[:, 2] ** 2
        speed = 2.0 * MEAN * (1.0 - r2 / RADIUS**2)
        p.v[:] = speed[:, None] * [1.0, 0.0, 0.0]
        due = p.t0 + (0.01 - p.x0[:, 0]) / speed
        observe(cloud, self.collector(sampleInterval=every), tmp_path)
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
            assert float(row["mass"]) == pytest.approx(int(row["parcels"]) * mass)
            fresh = np.count_nonzero(own & (due > begin) & (due <= end))
            assert float(row["massFlowRate"]) == pytest.approx(fresh * mass / (end - begin))

    def orbit(self, folder, dt, function, turns=3.2):
        """A particle on a given circle, seen at times dt apart; the rows of crossings.csv."""
        p = spheres([[1.0, 0.2, 0.0]], d=D, rho=1.0, mu=1.0)
        cloud = Cloud(p, analytic.rotation(1.0), WATER, (), dt)
        function_set = Functions({"f": function}, look_at(cloud))
        for step in range(round(turns * 2.0 * np.pi / dt)):
            t = (step + 1) * dt
            phase = t + np.arctan2(0.2, 1.0)
            radius = np.hypot(1.0, 0.2)
            p.status[:], p.t[:] = Status.ACTIVE, t
            p.x[:] = radius * np.array([np.cos(phase), np.sin(phase), 0.0])
            p.v[:] = radius * np.array([-np.sin(phase), np.cos(phase), 0.0])
            cloud.step = step + 1
            function_set.see()
        function_set.write(folder)
        return table(folder / "f/crossings.csv"), table(folder / "f/collector.csv")

    def circle(self, **options):
        return ParticleCollector("plane", (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), sampleInterval=1, **options)

    def test_a_curved_path_is_met_to_fourth_order(self, tmp_path):
        """Half a turn after half a turn through y = 0, to and fro."""
        errors = []
        for dt in (0.4, 0.2):
            rows, totals = self.orbit(tmp_path / str(dt), dt, self.circle())
            exact = np.pi * np.arange(1, len(rows) + 1) - np.arctan2(0.2, 1.0)
            assert len(rows) == 6
            np.testing.assert_array_equal(column(rows, "direction"), [-1, 1, -1, 1, -1, 1])
            errors.append(np.abs(column(rows, "t") - exact).max())
            assert (totals[0]["parcels"], totals[0]["parcelsOpposite"]) == ("3", "3")
        assert errors[0] < 1e-3
        assert errors[1] < errors[0] / 10.0

    def test_what_comes_back_may_be_taken_off(self, tmp_path):
        mass = np.pi / 6.0 * D**3
        _, (row, _) = self.orbit(tmp_path / "sum", 0.2, self.circle())
        assert float(row["mass"]) == pytest.approx(6.0 * mass)
        _, (row, _) = self.orbit(tmp_path / "net", 0.2, self.circle(negateParcelsOppositeNormal=True))
        assert float(row["mass"]) == pytest.approx(0.0, abs=1e-12 * mass)

    def test_only_a_disc_of_the_plane_counts(self, tmp_path):
        disc = ParticleCollector("plane", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), radius=0.5, sampleInterval=1)
        rows, _ = self.orbit(tmp_path, 0.1, disc)
        assert (column(rows, "x") > 0.9).all()
        assert len(rows) == 3

    def test_counts_may_begin_anew_at_each_writing(self, tmp_path):
        cloud = pipe_cloud(medium=WATER)
        observe(cloud, self.collector(resetOnWrite=True), tmp_path)
        parts = column(table(tmp_path / "f/collector.csv"), "parcels")
        other = pipe_cloud(medium=WATER)
        observe(other, self.collector(), tmp_path / "all")
        totals = column(table(tmp_path / "all/f/collector.csv"), "parcels")
        np.testing.assert_array_equal(np.cumsum(parts.reshape(3, 2), axis=0), totals.reshape(3, 2))

    def test_a_plane_needs_a_normal(self):
        with pytest.raises(InputError, match=re.escape("normal (0 0 0)")):
            ParticleCollector("plane", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


class TestHistogram:
    def test_exposure_in_a_steady_shear_is_rate_times_time(self, tmp_path):
        cloud = pipe_cloud(medium=WATER)
        p = cloud.particles
        r = np.hypot(p.x[:, 1], p.x[:, 2])
        observe(cloud, ParticleHistogram(nBins=7), tmp_path)
        rows = table(tmp_path / "f/exposure.csv")
        assert [int(row["id"]) for row in rows] == list(range(p.size))
        age = p.t - p.t0
        np.testing.assert_allclose(column(rows, "residenceTime"), age, rtol=1e-12)
        expected = 4.0 * MEAN * r / RADIUS**2 * age
        np.testing.assert_allclose(column(rows, "shearExposure"), expected, rtol=1e-6)

    def test_deformation_is_the_largest_and_the_mean_of_a_fine_record(self, tmp_path):
        record = pipe_cloud()
        n = record.particles.size
        times, shapes = [record.particles.t.copy()], [np.zeros(n)]
        for _ in range(700):
            record.advance(1)
            c = context(
                record.particles._replace(status=np.ones(n, dtype=np.int8)), record.flow, 1.0, record.time
            )
            times.append(record.particles.t.copy())
            shapes.append(MEASURES["taylorDeformation"].value(c))
        t, D_path = np.array(times), np.array(shapes)
        mean = np.sum(0.5 * np.diff(t, axis=0) * (D_path[1:] + D_path[:-1]), axis=0) / (t[-1] - t[0])
        errors = {}
        for every in (1, 5, 20):
            observe(pipe_cloud(), ParticleHistogram(sampleInterval=every), tmp_path)
            rows = table(tmp_path / "f/exposure.csv")
            largest = np.abs(column(rows, "maxDeformation") - D_path.max(axis=0)).max()
            errors[every] = largest, np.abs(column(rows, "meanDeformation") - mean).max()
        np.testing.assert_allclose(errors[1], 0.0, atol=1e-12)
        assert max(errors[5]) < 0.005
        assert errors[5][1] < errors[20][1] / 8.0

    def test_the_bins_hold_everybody(self, tmp_path):
        cloud = pipe_cloud()
        observe(cloud, ParticleHistogram(nBins=7), tmp_path)
        exposure = table(tmp_path / "f/exposure.csv")
        for field in ParticleHistogram().fields:
            rows = table(tmp_path / f"f/{field}.csv")
            assert len(rows) == 7
            np.testing.assert_array_equal(column(rows, "lower")[1:], column(rows, "upper")[:-1])
            for name in ("one", "two"):
                own = column([row for row in exposure if row["injector"] == name], field)
                edges = np.append(column(rows, "lower"), column(rows, "upper")[-1])
                np.testing.assert_array_equal(column(rows, name), np.histogram(own, edges)[0])
                assert column(rows, name).sum() == 20

    def test_an_unknown_field(self):
        with pytest.raises(InputError, match=r"field residenceTim\. Did you mean 'residenceTime'"):
            ParticleHistogram(fields=("residenceTim",))


BLOCK = """cloudFunctions
{
    tracks { type particleTracks; trackInterval 100; maxSamples 100; }
    impacts { type patchPostProcessing; patches (wall outlet); }
    plane { type particleCollector; mode plane; origin (0.02 0 0); normal (1 0 0); }
    spread { type particleHistogram; fields (shearExposure); nBins 5; sampleInterval 30; }
}
"""


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """The pipe, with and without functions."""
    cases = []
    for name, block in (("plain", "cloudFunctions\n{}\n"), ("observed", BLOCK)):
        case = tmp_path_factory.mktemp(name) / "pipe"
        shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("postProcessing", "log.*"))
        path = case / "constant/softCloudProperties"
        text = path.read_text().replace("cloudFunctions\n{}\n", block)
        text = re.sub(r"endTime\s+\S+;", "endTime 0.16;", text)
        path.write_text(re.sub(r"writeInterval\s+\S+;", "writeInterval 0.08;", text))
        assert main(["run", "-case", str(case)]) == 0
        cases.append(case / "postProcessing/softCloud")
    return cases


def test_a_stopped_run_goes_on_with_what_its_functions_saw(tmp_path, monkeypatch):
    """Stopped between two looks and between two writings: the same files as of a run never stopped."""
    block = BLOCK.replace("0.02 0 0", "0.001 0 0")
    results = []
    for name in ("whole", "parts"):
        case = copy_of_pipe(tmp_path / name)
        edit(case, r"cloudFunctions\s*\{\}", block)
        edit(case, r"endTime\s+\S+;", "endTime 0.012;")
        edit(case, r"writeInterval\s+\S+;", "writeInterval 0.004;")
        if name == "parts":
            monkeypatch.setattr("foamprb.cloud.executor.Threads.at_once", 1000)
            job = prepare(case, threads=1)
            with pytest.raises(RunStopped):
                execute(job, stop=lambda job=job: job.cloud.step > 261)
            assert 261 < job.cloud.step < 270
        assert main(["run", "-case", str(case), "-resume"]) == 0
        folder = case / "postProcessing/softCloud"
        found = [file for file in folder.rglob("*.*") if file.suffix in (".csv", ".vtp")]
        results.append({str(file.relative_to(folder)): file.read_bytes() for file in found})
    assert {"plane/crossings.csv", "spread/exposure.csv", "tracks/tracks.vtp"} <= results[0].keys()
    assert len(results[0]["plane/crossings.csv"].splitlines()) > 1
    assert results[0] == results[1]


class TestRun:
    def test_looking_changes_nothing(self, cases):
        plain, observed = cases
        assert (plain / "fates.csv").read_bytes() == (observed / "fates.csv").read_bytes()

    def test_every_function_writes(self, cases):
        _, observed = cases
        fates = table(observed / "fates.csv")
        for patch, fate in (("wall", "stuck"), ("outlet", "escaped")):
            expected = [row for row in fates if row["patch"] == patch and row["fate"] == fate]
            rows = {row["id"]: row for row in table(observed / f"impacts/{patch}.csv")}
            assert rows.keys() == {row["id"] for row in expected}
            assert len(rows) > 0
            for row in expected:
                assert [rows[row["id"]][c] for c in "abcD"] == [row[c] for c in "abcD"]
            angles = column(rows.values(), "impactAngle")
            assert (angles >= 0.0).all()
            assert (angles < 90.0).all()
        past = [row for row in fates if float(row["x1"]) >= 0.02]
        assert {row["id"] for row in table(observed / "plane/crossings.csv")} == {row["id"] for row in past}
        assert len(table(observed / "spread/shearExposure.csv")) == 5
        assert pyvista.read(observed / "tracks/tracks.vtp").n_lines == len(fates)

    def test_the_facets_normal_is_that_of_the_pipe(self, cases):
        """On the mesh, to the angle between a facet and the circle."""
        rows = table(cases[1] / "impacts/wall.csv")
        radial = np.stack([np.zeros(len(rows)), column(rows, "y"), column(rows, "z")], axis=1)
        radial /= np.linalg.norm(radial, axis=1)[:, None]
        v = np.stack([column(rows, c) for c in ("Ux", "Uy", "Uz")], axis=1)
        angle = np.degrees(np.arccos(np.einsum("ni,ni->n", v, radial) / np.linalg.norm(v, axis=1)))
        np.testing.assert_allclose(column(rows, "impactAngle"), angle, atol=6.0)


def test_registry_names_are_openfoams_where_it_has_them():
    assert {"particleTracks", "patchPostProcessing", "particleCollector"} <= FUNCTIONS.keys()


def test_suspension_of_rigid_spheres_is_einsteins(tmp_path):
    """[η] = 5/2 and S = 5 μ_f V d_f, whatever the sizes and the flow."""
    L = np.array([[0.2, 1.0, 0.0], [0.0, -0.3, 0.5], [0.0, 0.0, 0.1]])
    radii = np.array([1e-6, 2e-6, 3e-6, 4e-6])
    p = spheres(np.zeros((4, 3)), d=2 * radii, rho=1e3, mu=WATER.mu * 1e5)
    p.injector[:] = [0, 0, 1, 1]
    cloud = Cloud(p, analytic.linear(L), WATER, (), 0.01, Models(integrator="stokes"))
    observe(cloud, SuspensionStress(), tmp_path, writes=(10, 20))
    rows = table(tmp_path / "f/suspensionStress.csv")
    assert [(row["time"], row["injector"], row["parcels"]) for row in rows] == [
        ("0.1", "one", "2"), ("0.1", "two", "2"), ("0.2", "one", "2"), ("0.2", "two", "2")
    ]  # fmt: skip
    d = (L + L.T) / 2
    for row in rows:
        np.testing.assert_allclose(float(row["intrinsicViscosity"]), 2.5, rtol=1e-4)
        found = [float(row[name]) for name in ("Sxx", "Syy", "Szz", "Sxy", "Syz", "Sxz")]
        expected = 5 * WATER.mu * d[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
        np.testing.assert_allclose(found, expected, atol=1e-4 * WATER.mu)
    own = radii[:2] if rows[0]["injector"] == "one" else radii[2:]
    np.testing.assert_allclose(float(rows[0]["volume"]), np.sum(4 / 3 * np.pi * own**3), rtol=1e-6)
