"""Where and when particles appear."""

from __future__ import annotations

import gzip
import re
import resource
import shutil
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mesh_shapes import block, box_patches
from paths import PIPE
from scipy import stats

from foamprb.cloud.injection.models import (
    BYTES,
    GIVEN,
    BoxInjection,
    CellZoneInjection,
    ConeInjection,
    LineInjection,
    ManualInjection,
    PatchFlowRateInjection,
    PatchInjection,
    SphereInjection,
    given_shear_modulus,
    pending,
)
from foamprb.errors import InputError
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.foamfile import read_cell_zones
from foamprb.flow.read.openfoam import read_case
from foamprb.flow.series import SeriesFlow
from foamprb.memory import memory, spread_over

CONE = {
    "positionAxis": (((0.1, 0.0, 0.0), (1.0, 1.0, 0.0)), ((0.2, 0.0, 0.0), (0.0, 0.0, -3.0))),
    "duration": 2.0,
    "parcelsPerInjector": 3000.0,
    "Umag": 5.0,
    "thetaInner": 20.0,
    "thetaOuter": 60.0,
    "SOI": 0.5,
}


def no_file(path, columns):
    raise AssertionError(path)


def release(model, flow, random, read):
    return pending(model.places(flow, random, read))


def rng(seed=5):
    return np.random.default_rng(seed)


@pytest.fixture(scope="module")
def pipe_flow():
    return read_case(PIPE)


def with_zones(flow, zones):
    return MeshFlow(flow.mesh, flow._arrays.nodes[:, 4:7], flow._arrays.nodes[:, 7:], zones=lambda: zones)


class TestCellZone:
    def test_particles_fill_the_zone_evenly(self, pipe_flow):
        mesh = pipe_flow.mesh
        cells = np.flatnonzero((mesh.centres[:, 0] > 0.1) & (mesh.centres[:, 1] > 0.0))
        flow = with_zones(pipe_flow, {"part": cells})
        volumes = mesh.volumes[cells]
        model = CellZoneInjection(cellZone="part", numberDensity=8000.0 / volumes.sum(), SOI=0.25)
        p = release(model, flow, rng(), no_file)
        assert p.size == 8000
        np.testing.assert_array_equal(p.t0, 0.25)
        np.testing.assert_array_equal(flow.cell_of(p.host), flow.cell_of(flow.locate(p.x)))
        counts = np.bincount(flow.cell_of(p.host), minlength=mesh.n_cells)
        assert counts.sum() == counts[cells].sum()
        assert np.abs(counts[cells] - volumes * model.numberDensity).max() < 2.0
        # The pipe's half is filled: its centroid, to four standard errors.
        centroid = np.average(mesh.centres[cells], axis=0, weights=volumes)
        np.testing.assert_array_less(
            np.abs(p.x.mean(axis=0) - centroid), 4.0 * p.x.std(axis=0) / np.sqrt(8000)
        )

    def test_all_cells_are_a_zone_of_all(self, pipe_flow, monkeypatch):
        monkeypatch.setattr("foamprb.flow.meshflow.AT_ONCE", 1000)
        mesh = pipe_flow.mesh
        flow = with_zones(pipe_flow, {"all": np.arange(mesh.n_cells)})
        density = 5000.0 / mesh.volumes.sum()
        whole = release(CellZoneInjection(density, selectionMode="all"), flow, rng(), no_file)
        zone = release(CellZoneInjection(density, "all"), flow, rng(), no_file)
        assert whole.size == 5000
        for one, other in zip(whole, zone, strict=True):
            np.testing.assert_array_equal(one, other)
        counts = np.bincount(flow.cell_of(whole.host), minlength=mesh.n_cells)
        assert np.abs(counts - mesh.volumes * density).max() < 2.0

    def test_tetrahedra_inside_out_get_no_particle(self, lid_flow, monkeypatch):
        """They overlap their neighbours, which hold their share already."""
        zone = lid_flow.cell_zone(None)
        volumes = np.where(np.arange(len(zone.volumes)) % 3 == 1, -0.5, 1.0) * zone.volumes
        monkeypatch.setattr(MeshFlow, "cell_zone", lambda *_: zone._replace(volumes=volumes))
        p = release(CellZoneInjection(selectionMode="all", numberDensity=3000.0), lid_flow, rng(), no_file)
        assert p.size == pytest.approx(3000.0 * volumes[volumes > 0.0].sum(), abs=1.0)
        assert (volumes[np.searchsorted(zone.hosts, p.host)] > 0.0).all()

    def test_velocity_is_the_fluids_or_the_users(self, pipe_flow):
        flow = with_zones(pipe_flow, {"all": np.arange(pipe_flow.mesh.n_cells)})
        density = 100.0 / pipe_flow.mesh.volumes.sum()
        free = release(CellZoneInjection(cellZone="all", numberDensity=density), flow, rng(), no_file)
        # That of the fluid when and where they appear.
        assert np.isnan(free.v).all()
        given_velocity = release(
            CellZoneInjection(cellZone="all", numberDensity=density, U0=(1.0, 2.0, 3.0)), flow, rng(), no_file
        )
        np.testing.assert_array_equal(given_velocity.v, np.tile([1.0, 2.0, 3.0], (100, 1)))

    def test_mistakes(self, pipe_flow):
        flow = with_zones(pipe_flow, {"part": np.arange(3), "none": np.arange(0), "far": np.array([10**6])})
        with pytest.raises(InputError, match=r"prt is not in the mesh\. Did you mean 'part'"):
            release(CellZoneInjection(cellZone="prt", numberDensity=1.0), flow, rng(), no_file)
        with pytest.raises(InputError, match="gives no particle"):
            release(CellZoneInjection(cellZone="part", numberDensity=1.0), flow, rng(), no_file)
        with pytest.raises(InputError, match="gives no particle"):
            release(CellZoneInjection(cellZone="none", numberDensity=1e30), flow, rng(), no_file)
        with pytest.raises(InputError, match="names cells beyond"):
            release(CellZoneInjection(cellZone="far", numberDensity=1.0), flow, rng(), no_file)
        with pytest.raises(InputError, match="a flow in closed form has no cells"):
            release(CellZoneInjection(1.0, "part"), analytic.pipe(1.0, 1.0), rng(), no_file)
        with pytest.raises(InputError, match="all cells: a flow in closed form has no cells"):
            release(CellZoneInjection(1.0, selectionMode="all"), analytic.pipe(1.0, 1.0), rng(), no_file)

    def test_a_cases_zones_are_found(self, tmp_path):
        case = tmp_path / "pipe"
        shutil.copytree(
            PIPE, case, ignore=shutil.ignore_patterns("postProcessing", "coarse", "medium", "fine")
        )
        with pytest.raises(InputError, match=r"Allowed: \(nothing\)"):
            read_case(case).cell_zone("two")
        text = zones_file({"one": [3], "two": [7, 5]})
        (case / "constant/polyMesh/cellZones.gz").write_bytes(gzip.compress(text))
        flow = read_case(case)
        zone = flow.cell_zone("two")
        assert set(flow.cell_of(zone.hosts)) == {5, 7}
        assert zone.volumes.sum() == pytest.approx(flow.mesh.volumes[[5, 7]].sum(), rel=1e-12, abs=0.0)


def zones_file(zones, width=None):
    """The file ``cellZones``: ascii, or binary with labels of some bytes."""
    kind = "ascii" if width is None else f'binary; arch "LSB;label={8 * width};scalar=64"'
    parts = [f'FoamFile {{ version 2.0; format {kind}; class regIOobject; location "constant/polyMesh"; }}\n']
    parts.append(f"// * * * //\n\n{len(zones)}\n(\n")
    data = "".join(parts).encode()
    for name, cells in zones.items():
        data += f"{name}\n{{\n    type cellZone;\ncellLabels      ".encode()
        data += b"List<label> \n" if cells or width is None else b""
        if width is None:
            data += f"{len(cells)}\n(\n{' '.join(map(str, cells))}\n)\n".encode()
        elif len(cells):
            data += f"\n{len(cells)}\n(".encode() + np.array(cells, dtype=f"<i{width}").tobytes() + b")"
        else:
            data += b"0"
        data += b";\n}\n\n"
    return data + b")\n\n// ***** //\n"


names = st.from_regex(r"[A-Za-z][A-Za-z0-9_.:]{0,8}", fullmatch=True)
labels = st.lists(st.integers(0, 2**31 - 1), max_size=30)


def read_back(text):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cellZones"
        path.write_bytes(text)
        return read_cell_zones(path)


class TestZones:
    @given(st.dictionaries(names, labels, max_size=4), st.sampled_from([None, 4, 8]))
    def test_written_zones_are_read_back(self, zones, width):
        found = read_back(zones_file(zones, width))
        assert list(found) == list(zones)
        for name, cells in zones.items():
            np.testing.assert_array_equal(found[name], cells)

    @given(st.dictionaries(names, labels, min_size=1, max_size=3), st.sampled_from([None, 4]), st.data())
    def test_a_file_cut_short_is_refused(self, zones, width, data):
        text = zones_file(zones, width)
        end = text.rindex(b"}") - 1
        with pytest.raises(InputError, match=r"broken or cut short|zones could be read"):
            read_back(text[: data.draw(st.integers(0, end))])


class TestCone:
    def release(self, **changes):
        return release(ConeInjection(**(CONE | changes)), analytic.pipe(1.0, 1.0), rng(), no_file)

    def test_positions_take_turns_at_even_times(self):
        p = self.release()
        assert p.size == 6000
        np.testing.assert_allclose(p.t0, 0.5 + 2.0 * np.arange(6000) / 6000, rtol=1e-14)
        np.testing.assert_array_equal(p.x[::2], np.tile([0.1, 0.0, 0.0], (3000, 1)))
        np.testing.assert_array_equal(p.x[1::2], np.tile([0.2, 0.0, 0.0], (3000, 1)))

    def test_angles_may_be_given_from_the_outer_to_the_inner(self):
        angles = CONE["thetaInner"], CONE["thetaOuter"]
        turned = self.release(thetaInner=angles[1], thetaOuter=angles[0])
        np.testing.assert_array_equal(turned.v, self.release().v)

    def test_directions_fill_the_cone_as_in_openfoam(self):
        """Uniform in the angle from the axis and in the angle about it."""
        p = self.release()
        np.testing.assert_allclose(np.linalg.norm(p.v, axis=1), 5.0, rtol=1e-14)
        for part, axis in ((p.v[::2], [1.0, 1.0, 0.0]), (p.v[1::2], [0.0, 0.0, -3.0])):
            e = np.array(axis) / np.linalg.norm(axis)
            theta = np.degrees(np.arccos(part @ e / 5.0))
            assert stats.ks_1samp(theta, stats.uniform(20.0, 40.0).cdf).pvalue > 0.01
            one = np.cross(e, [0.3, 0.5, 0.7])
            one /= np.linalg.norm(one)
            turn = np.arctan2(part @ np.cross(e, one), part @ one)
            assert stats.ks_1samp(turn, stats.uniform(-np.pi, 2.0 * np.pi).cdf).pvalue > 0.01

    def test_a_cone_without_an_angle_is_a_jet(self):
        p = self.release(thetaInner=0.0, thetaOuter=0.0)
        np.testing.assert_allclose(p.v[1::2], np.tile([0.0, 0.0, -5.0], (3000, 1)), atol=1e-14)

    def test_mistakes(self):
        with pytest.raises(InputError, match=re.escape("position (0.1 2 0) lies outside")):
            self.release(positionAxis=(((0.1, 2.0, 0.0), (1.0, 0.0, 0.0)),))
        with pytest.raises(InputError, match="gives no particle"):
            self.release(parcelsPerInjector=0.4)
        with pytest.raises(InputError, match=re.escape("an axis (0 0 0)")):
            self.release(positionAxis=(((0.1, 0.0, 0.0), (0.0, 0.0, 0.0)),))
        with pytest.raises(InputError, match="empty list positionAxis"):
            self.release(positionAxis=())


class TestRoom:
    @pytest.mark.parametrize(
        ("model", "message"),
        [
            (
                PatchInjection("inlet", 1e12, 0.1),
                "on inlet: parcelsPerSecond 1e[+]12 times duration 0.1 s gives 1e[+]11 particles, "
                "which need about 9[0-9]([.][0-9])? TB of memory; .* [MGT]B are available[.]$",
            ),
            (PatchInjection("inlet", 1e200, 1e200), "gives inf particles, which need about inf TB"),
            (
                CellZoneInjection(cellZone="all", numberDensity=1e30),
                "cellZoneInjection in all: numberDensity 1e[+]30 .* gives .* particles, which need about",
            ),
            (
                ConeInjection(**(CONE | {"parcelsPerInjector": 1e300})),
                "coneInjection: parcelsPerInjector 1e[+]300 at 2 positions gives 2e[+]300 particles",
            ),
            (ConeInjection(**(CONE | {"parcelsPerInjector": 1.7e308})), "gives inf particles"),
        ],
    )
    def test_more_than_memory_can_hold_is_refused_before_it_is_taken(self, pipe_flow, model, message):
        flow = with_zones(pipe_flow, {"all": np.arange(pipe_flow.mesh.n_cells)})
        if isinstance(model, ConeInjection):
            flow = analytic.pipe(1.0, 1.0)
        with pytest.raises(InputError, match=message):
            release(model, flow, rng(), no_file)

    def test_limits_of_the_process_count(self, pipe_flow, monkeypatch):
        monkeypatch.setattr("foamprb.cloud.injection.models.memory", lambda: 50_000.0 * BYTES)
        assert release(PatchInjection("inlet", 49_999.0, 1.0), pipe_flow, rng(), no_file).size == 49_999
        with pytest.raises(
            InputError, match=r"5e\+04 particles, which need about \S+ MB of memory; \S+ MB are available"
        ):
            release(PatchInjection("inlet", 50_001.0, 1.0), pipe_flow, rng(), no_file)

    def test_memory_is_that_of_the_machine_or_less(self):
        machine = memory()
        total = int(re.search(r"MemTotal: +(\d+) kB", Path("/proc/meminfo").read_text())[1])
        assert machine <= total * 1024 * 1.1
        soft, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (int(machine) // 2, hard))
        try:
            assert memory() == int(machine) // 2
        finally:
            resource.setrlimit(resource.RLIMIT_AS, (soft, hard))

    def test_memory_of_all_machines_of_a_run_counts(self, monkeypatch):
        monkeypatch.setattr("foamprb.memory._machines", [1])
        machine = memory()
        spread_over(3)
        assert memory() == 3.0 * machine

    def test_a_run_needs_what_is_said(self):
        """Less than a kilobyte, which tests/run/test_memory.py measures."""
        assert 800 < BYTES < 1000


class TestGiven:
    """What a file of positions says of each particle."""

    def test_columns_go_with_the_positions_that_are_inside(self):
        x = np.array([[0.1, 0.0, 0.0], [0.1, 5.0, 0.0], [0.2, 0.0, 0.0]])

        def read(path, columns):
            assert columns is GIVEN
            return x, {"d": np.array([1.0, 2.0, 3.0])}

        model = ManualInjection(Path("file"), ignoreOutOfBounds=True)
        places = model.places(analytic.pipe(1.0, 1.0), rng(), read)
        np.testing.assert_array_equal(pending(places).x, x[[0, 2]])
        np.testing.assert_array_equal(places.columns["d"], [1.0, 3.0])

    @pytest.mark.parametrize(
        ("outside", "told"),
        [
            (1, "(0.1 2 -1). "),
            (3, "(0.1 2 -1), (0.1 3 -1), (0.1 4 -1). "),
            (4, "(0.1 2 -1), (0.1 3 -1), (0.1 4 -1), .... "),
        ],
    )
    def test_message_lists_three_places_outside(self, outside, told):
        x = [(0.1, 0.5, 0.0), *((0.1, 2.0 + k, -1.0) for k in range(outside))]

        def read(path, columns):
            return np.array(x), {}

        with pytest.raises(InputError) as caught:
            ManualInjection(Path("file")).places(analytic.pipe(1.0, 1.0), rng(), read)
        assert str(caught.value).startswith(
            f"file: {outside} of {outside + 1} positions lie outside the mesh: {told}Move them inside"
        )

    def test_stiffness_in_each_of_its_forms(self):
        column = np.array([2.0, 4.0])
        assert given_shear_modulus({"d": column}, 0.25, 3.0, None) is None
        for name, expected in (
            ("shearModulus", [2.0, 4.0]),
            ("youngsModulus", [0.8, 1.6]),
            ("Ca", [15.0, 7.5]),
        ):
            found = given_shear_modulus({name: column}, 0.25, 3.0, 10.0)
            np.testing.assert_allclose(found, expected, rtol=1e-15)

    def test_mistakes(self):
        column = np.ones(2)
        with pytest.raises(InputError, match="gives shearModulus and Ca, but one"):
            given_shear_modulus({"Ca": column, "shearModulus": column}, 0.25, 3.0, 1.0)
        with pytest.raises(InputError, match="gives Ca, which needs the entry referenceShearRate"):
            given_shear_modulus({"Ca": column}, 0.25, 3.0, None)


@pytest.fixture(scope="module")
def lid_flow():
    """A unit cube of few cells, into which fluid enters through the lid at the speed x."""
    shape = block(2, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    u = np.zeros((len(mesh.nodes), 3))
    u[:, 2] = -mesh.nodes[:, 0]
    return MeshFlow(mesh, u, np.zeros((len(u), 3, 3)))


class TestPatch:
    @pytest.mark.parametrize(("speed", "still"), [(0.0, True), (1.0, False), (1e-300, False)])
    def test_no_fluid_may_enter_as_it_is_at_rest_or_leaves(self, lid_flow, speed, still):
        u = np.tile([0.0, 0.0, speed], (len(lid_flow.mesh.nodes), 1))
        flow = MeshFlow(lid_flow.mesh, u, np.zeros((len(u), 3, 3)))
        with pytest.raises(
            InputError, match=r"on lid: no fluid enters through this patch at SOI, 0\.5 s"
        ) as caught:
            release(PatchInjection("lid", 10.0, 1.0, SOI=0.5), flow, rng(), no_file)
        assert ("it is at rest," in str(caught.value)) == still

    def test_as_many_appear_per_area_as_fluid_enters_there(self, lid_flow):
        """Not as many on each face, nor as the speed at one point of it: within faces too."""
        p = release(PatchInjection("lid", 20_000.0, 1.0), lid_flow, rng(), no_file)
        assert p.x[:, 2] == pytest.approx(1.0, abs=1e-12)
        assert stats.kstest(p.x[:, 0], lambda x: np.clip(x, 0.0, 1.0) ** 2).pvalue > 0.01
        assert stats.kstest(p.x[:, 1], "uniform").pvalue > 0.01

    def test_a_large_face_gets_as_many_more_particles(self):
        """In a uniform inflow through faces whose widths are 1 : 3."""
        shape = block(2, 0.0)
        patches = box_patches(shape)
        for points in (shape.points, *(patch.surface.points for patch in patches)):
            points[:, 0] = points[:, 0] ** 2
        mesh = build_mesh(shape, patches)
        u = np.tile([0.0, 0.0, -1.0], (len(mesh.nodes), 1))
        flow = MeshFlow(mesh, u, np.zeros((len(u), 3, 3)))
        p = release(PatchInjection("lid", 4000.0, 1.0), flow, rng(), no_file)
        assert stats.kstest(p.x[:, 0], "uniform").pvalue > 0.01

    def test_the_first_appears_at_once_and_the_others_at_even_times(self, lid_flow):
        p = release(PatchInjection("lid", 40.0, 0.25, SOI=0.5), lid_flow, rng(), no_file)
        assert p.t0 == pytest.approx([0.5 + k / 40.0 for k in range(10)], abs=1e-15)
        assert np.array_equal(p.t, p.t0)


class TestRegions:
    def test_a_box_is_filled_evenly_where_it_lies_in_the_mesh(self, lid_flow):
        """Half of it lies above the cube."""
        model = BoxInjection(min=(0.2, 0.1, 0.5), max=(0.6, 0.9, 1.5), number=4000, duration=2.0, SOI=0.5)
        p = release(model, lid_flow, rng(), no_file)
        for axis, (low, size) in enumerate(((0.2, 0.4), (0.1, 0.8), (0.5, 0.5))):
            assert stats.kstest(p.x[:, axis], "uniform", (low, size)).pvalue > 0.01
        np.testing.assert_array_equal(p.host, lid_flow.locate(p.x))
        np.testing.assert_allclose(p.t0, 0.5 + 2.0 * np.arange(4000) / 4000, rtol=1e-15)

    def test_a_box_beside_the_mesh_or_upside_down_is_refused(self, lid_flow):
        with pytest.raises(InputError, match=r"boxInjection: only 0 of 1000 random places lie in the mesh"):
            release(BoxInjection(min=(2.0,) * 3, max=(3.0,) * 3, number=5), lid_flow, rng(), no_file)
        with pytest.raises(InputError, match="component of min above that of max"):
            BoxInjection(min=(0.0, 1.0, 0.0), max=(1.0, 0.0, 1.0), number=5)

    def test_a_sphere_is_filled_evenly(self, lid_flow):
        model = SphereInjection(origin=(0.5, 0.5, 0.5), radius=0.4, number=4000)
        p = release(model, lid_flow, rng(), no_file)
        arms = p.x - 0.5
        r = np.linalg.norm(arms, axis=1)
        assert stats.kstest((r / 0.4) ** 3, "uniform").pvalue > 0.01
        for axis in range(3):
            assert stats.kstest(arms[:, axis] / r, "uniform", (-1.0, 2.0)).pvalue > 0.01
        np.testing.assert_array_equal(p.t0, 0.0)

    def test_a_line_is_divided_evenly_and_released_in_any_order(self, lid_flow):
        ends = {"start": (0.1, 0.2, 0.3), "end": (0.9, 0.8, 0.7)}
        p = release(LineInjection(**ends, number=5, duration=1.0), lid_flow, rng(), no_file)
        np.testing.assert_allclose(p.x[:, 0], [0.1, 0.3, 0.5, 0.7, 0.9], rtol=1e-14)
        np.testing.assert_allclose(sorted(p.t0), [0.0, 0.2, 0.4, 0.6, 0.8], rtol=1e-14)
        assert (np.diff(p.t0) < 0.0).any()

    def test_places_of_a_line_outside_are_refused_or_left_out(self, lid_flow):
        ends = {"start": (0.5, 0.5, 0.25), "end": (0.5, 0.5, 1.75), "number": 4}
        with pytest.raises(InputError, match="lineInjection: 2 of 4 positions lie outside the mesh"):
            release(LineInjection(**ends), lid_flow, rng(), no_file)
        p = release(LineInjection(**ends, ignoreOutOfBounds=True), lid_flow, rng(), no_file)
        np.testing.assert_allclose(p.x[:, 2], [0.25, 0.75])


class TestFlowRate:
    """Through the lid of a unit cube at the speed f x: ½ f m³/s for f > 0."""

    @pytest.fixture
    def series(self, lid_flow):
        """At rest at 0, f = 1 at 1 s, 0 at 2 s and −1 at 3 s."""
        u, l = lid_flow._arrays.nodes[:, 4:7], np.zeros((len(lid_flow.mesh.nodes), 3, 3))
        return SeriesFlow(lid_flow.mesh, [0.0, 1.0, 3.0], lambda k: ((0.0, 1.0, -1.0)[k] * u, l))

    def test_number_and_times_follow_the_inflow(self, series):
        p = release(PatchFlowRateInjection("lid", 4000.0, 10.0), series, rng(), no_file)
        assert p.size == 2000
        # ¼ t² m³ have entered in the first second.
        k = np.arange(1000)
        np.testing.assert_allclose(p.t0[:1000], np.sqrt((k + 0.5) / 1000.0), rtol=1e-12)
        np.testing.assert_allclose(p.t0[1000:], 2.0 - p.t0[:1000][::-1], rtol=1e-3)
        assert stats.kstest(p.x[:, 0], lambda x: np.clip(x, 0.0, 1.0) ** 2).pvalue > 0.01
        assert stats.kstest(p.x[:, 1], "uniform").pvalue > 0.01
        np.testing.assert_array_equal(p.host, series.locate(p.x - [0.0, 0.0, 1e-9]))
        assert np.isnan(p.v).all()

    def test_a_steady_inflow_gives_even_times(self, lid_flow):
        model = PatchFlowRateInjection("lid", 10.0, 2.0, concentration=2.0, SOI=0.5)
        p = release(model, lid_flow, rng(), no_file)
        np.testing.assert_allclose(p.t0, 0.5 + (np.arange(20) + 0.5) / 10.0, rtol=1e-13)

    def test_an_outflow_is_refused(self, series):
        with pytest.raises(InputError, match="fluid for 0 particles enters from 2 to 3 s, for none"):
            release(PatchFlowRateInjection("lid", 4000.0, 1.0, SOI=2.0), series, rng(), no_file)

    def test_times_of_each_period_count(self, lid_flow):
        u, l = lid_flow._arrays.nodes[:, 4:7], np.zeros((len(lid_flow.mesh.nodes), 3, 3))
        flow = SeriesFlow(lid_flow.mesh, [0.0, 1.0], lambda k: (k * u, l), period=2.0)
        assert flow.times_within(0.5, 4.0) == [1.0, 2.0, 3.0]
        p = release(PatchFlowRateInjection("lid", 400.0, 4.0), flow, rng(), no_file)
        np.testing.assert_allclose(p.t0[200:] - 2.0, p.t0[:200], rtol=1e-10)
