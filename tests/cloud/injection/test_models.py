"""Where particles appear: zones of cells and cones."""

from __future__ import annotations

import gzip
import re
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

from foamprb.cloud.injection.models import CellZoneInjection, ConeInjection, PatchInjection, release
from foamprb.errors import InputError
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read.foamfile import read_cell_zones
from foamprb.flow.read.openfoam import read_case
from foamprb.flow.walk import MeshFlow

CONE = {
    "positionAxis": (((0.1, 0.0, 0.0), (1.0, 1.0, 0.0)), ((0.2, 0.0, 0.0), (0.0, 0.0, -3.0))),
    "duration": 2.0,
    "parcelsPerInjector": 3000.0,
    "Umag": 5.0,
    "thetaInner": 20.0,
    "thetaOuter": 60.0,
    "SOI": 0.5,
}


def no_file(path):
    raise AssertionError(path)


def rng(seed=5):
    return np.random.default_rng(seed)


@pytest.fixture(scope="module")
def pipe_flow():
    return read_case(PIPE)


def with_zones(flow, zones):
    return MeshFlow(flow.mesh, flow._arrays.nodes[:, 3:6], flow._arrays.nodes[:, 6:15], zones=lambda: zones)


class TestCellZone:
    def test_particles_fill_the_zone_evenly(self, pipe_flow):
        mesh = pipe_flow.mesh
        cells = np.flatnonzero((mesh.centres[:, 0] > 0.1) & (mesh.centres[:, 1] > 0.0))
        flow = with_zones(pipe_flow, {"part": cells})
        volumes = mesh.volumes[cells]
        model = CellZoneInjection("part", numberDensity=8000.0 / volumes.sum(), SOI=0.25)
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

    def test_velocity_is_the_fluids_or_the_users(self, pipe_flow):
        flow = with_zones(pipe_flow, {"all": np.arange(pipe_flow.mesh.n_cells)})
        density = 100.0 / pipe_flow.mesh.volumes.sum()
        free = release(CellZoneInjection("all", density), flow, rng(), no_file)
        # That of the fluid when and where they appear.
        assert np.isnan(free.v).all()
        given_velocity = release(CellZoneInjection("all", density, U0=(1.0, 2.0, 3.0)), flow, rng(), no_file)
        np.testing.assert_array_equal(given_velocity.v, np.tile([1.0, 2.0, 3.0], (100, 1)))

    def test_mistakes(self, pipe_flow):
        flow = with_zones(pipe_flow, {"part": np.arange(3), "none": np.arange(0), "far": np.array([10**6])})
        with pytest.raises(InputError, match=r"prt is not in the mesh\. Did you mean 'part'"):
            release(CellZoneInjection("prt", 1.0), flow, rng(), no_file)
        with pytest.raises(InputError, match="gives no particle"):
            release(CellZoneInjection("part", 1.0), flow, rng(), no_file)
        with pytest.raises(InputError, match="gives no particle"):
            release(CellZoneInjection("none", 1e30), flow, rng(), no_file)
        with pytest.raises(InputError, match="names cells beyond"):
            release(CellZoneInjection("far", 1.0), flow, rng(), no_file)
        with pytest.raises(InputError, match="a flow in closed form has no cells"):
            release(CellZoneInjection("part", 1.0), analytic.pipe(1.0, 1.0), rng(), no_file)

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
        assert zone.volumes.sum() == pytest.approx(flow.mesh.volumes[[5, 7]].sum(), rel=1e-12)


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

    def test_equal_labels_may_be_written_once(self):
        text = zones_file({"a": [0]}).replace(b"1\n(\n0\n)", b"3{4}")
        np.testing.assert_array_equal(read_back(text)["a"], [4, 4, 4])

    def test_a_count_that_is_wrong_is_refused(self):
        text = zones_file({"a": [1, 2, 3]}).replace(b"3\n(\n1", b"4\n(\n1")
        with pytest.raises(InputError, match="a list of 4 entries, not 3, expected"):
            read_back(text)


class TestCone:
    def release(self, **changes):
        return release(ConeInjection(**(CONE | changes)), analytic.pipe(1.0, 1.0), rng(), no_file)

    def test_positions_take_turns_at_even_times(self):
        p = self.release()
        assert p.size == 6000
        np.testing.assert_allclose(p.t0, 0.5 + 2.0 * np.arange(6000) / 6000, rtol=1e-14)
        np.testing.assert_array_equal(p.x[::2], np.tile([0.1, 0.0, 0.0], (3000, 1)))
        np.testing.assert_array_equal(p.x[1::2], np.tile([0.2, 0.0, 0.0], (3000, 1)))

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


@pytest.fixture(scope="module")
def lid_flow():
    """A unit cube of few cells, into which fluid enters through the lid at the speed x."""
    shape = block(2, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    u = np.zeros((len(mesh.nodes), 3))
    u[:, 2] = -mesh.nodes[:, 0]
    return MeshFlow(mesh, u, np.zeros((len(u), 3, 3)))


class TestPatch:
    def test_as_many_appear_per_area_as_fluid_enters_there(self, lid_flow):
        """Not as many on each face, nor as the speed at one point of it: within faces too."""
        p = release(PatchInjection("lid", 20_000.0, 1.0), lid_flow, rng(), no_file)
        assert p.x[:, 2] == pytest.approx(1.0, abs=1e-12)
        assert stats.kstest(p.x[:, 0], lambda x: np.clip(x, 0.0, 1.0) ** 2).pvalue > 0.01
        assert stats.kstest(p.x[:, 1], "uniform").pvalue > 0.01

    def test_the_first_appears_at_once_and_the_others_at_even_times(self, lid_flow):
        p = release(PatchInjection("lid", 40.0, 0.25, SOI=0.5), lid_flow, rng(), no_file)
        assert p.t0 == pytest.approx([0.5 + k / 40.0 for k in range(10)], abs=1e-15)
        assert np.array_equal(p.t, p.t0)
