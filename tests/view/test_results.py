"""The results of a run in Python."""

from __future__ import annotations

import json
import os
import sys

import numpy as np
import pytest
import pyvista
from view_run import motion, write_run

import foamprb
from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.results.tables import read_table
from foamprb.results.vtk_check import seal


@pytest.fixture
def case(tmp_path):
    write_run(tmp_path, motion(9, 5), mesh=False, fates=True)
    return tmp_path


def test_a_notebook_shows_the_page_of_view(case):
    page = foamprb.open_run(case).view(time=0.2, max_size=5)
    assert page.path == case / "postProcessing/softCloud/softCloud.html"
    shown = page._repr_html_()
    assert shown.startswith('<iframe title="foamprb view" srcdoc="&lt;!doctype html')
    assert '"' not in shown.split('"')[3]
    # Jupyter shows only this text where the notebook is not trusted.
    assert ">This notebook is not trusted. To see the page, run the cell" in shown


def test_the_name_of_a_case_need_not_be_text(tmp_path, monkeypatch):
    write_run(tmp_path / "case", motion(2, 2), mesh=False, fates=True)
    monkeypatch.chdir((tmp_path / "case").rename(tmp_path / os.fsdecode(b"ca\xffse")))
    assert "ca\ufffdse" in foamprb.open_run(".").view().path.read_text()
    assert main(["report", "-noBrowser"]) == 0


def test_times_tables_and_snapshots(case):
    run = foamprb.open_run(case)
    np.testing.assert_allclose(run.times, 0.1 * np.arange(5))
    assert run.tables == ("fates",)
    fates = run.table()
    assert fates["id"].dtype == np.int64
    np.testing.assert_allclose(fates["Ca"], np.linspace(0.1, 1.0, 9))
    assert fates["fate"][1] == "stuck"
    cloud = run.snapshot(0.29)
    assert isinstance(cloud, pyvista.PolyData)
    assert cloud.field_data["time"] == pytest.approx(0.3)
    assert run.snapshot().n_points == 9
    assert run.units["shearRate"] == "1/s"
    assert run.tracks is None
    assert run.record == {}
    assert "5 times from 0 to 0.4 s" in repr(run)


def test_a_data_frame_where_a_library_for_it_is_installed(case, monkeypatch):
    made = {}

    class Pandas:
        @staticmethod
        def DataFrame(table):
            made.update(table)
            return "frame"

    monkeypatch.setitem(sys.modules, "pandas", Pandas)
    assert foamprb.open_run(case).frame() == "frame"
    assert len(made["id"]) == 9
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(InputError, match="needs pandas: pip install pandas"):
        foamprb.open_run(case).frame()


def test_without_pyvista_tables_are_read_and_the_extra_is_named(case, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    run = foamprb.open_run(case)
    assert len(run.table()["id"]) == 9
    with pytest.raises(InputError, match=r"need pyvista: pip install 'foamprb\[view\]'"):
        run.snapshot()


def test_surfaces_of_the_bodies_have_their_arrays(case):
    run = foamprb.open_run(case)
    cloud, bodies = run.snapshot(0.3), run.bodies(0.3, enlargement=2.0)
    assert cloud.active_tensors_name == "glyph"
    size = bodies.n_points // cloud.n_points
    assert bodies["origId"].tolist() == np.repeat(cloud["origId"], size).tolist()
    away = np.linalg.norm(bodies.points - np.repeat(cloud.points, size, axis=0), axis=1)
    farthest = away.reshape(-1, size).max(axis=1)
    assert farthest == pytest.approx(2.0 * cloud["semiAxes"][:, 0], rel=0.02)
    # R F has its columns one after the other in the array, and the eigenvectors of B = F Fᵀ.
    F = cloud["glyph"].reshape(-1, 3, 3).swapaxes(1, 2)
    axis = np.linalg.eigh(F @ F.swapaxes(1, 2))[1][:, :, -1]
    tip = (bodies.points - np.repeat(cloud.points, size, axis=0)).reshape(-1, size, 3)
    tip = tip[np.arange(len(tip)), away.reshape(-1, size).argmax(axis=1)] / farthest[:, None]
    assert np.abs(np.einsum("ni,ni->n", tip, axis)) == pytest.approx(1.0, abs=0.05)
    assert bodies.field_data["time"] == pytest.approx(0.3)


def test_surfaces_have_the_quadratic_mode(tmp_path):
    """A bullet reaches 1 + ε forward and 1 − ε backward; a body whose mode is not finite is an ellipsoid."""
    moved = motion(4, 1)
    moved.F[:] = np.eye(3)
    # ε P₃ along z: B_zzz = ε.
    B = np.tile([0.0, 0.0, -0.1, 0.0, 0.0, 0.0, -0.1], (1, 4, 1))
    B[0, 2] = np.nan
    write_run(tmp_path, moved, mesh=False, B=B)
    run = foamprb.open_run(tmp_path)
    bodies, cloud = run.bodies(), run.snapshot()
    offsets = bodies.points.reshape(cloud.n_points, -1, 3) - cloud.points[:, None]
    for body, epsilon in ((1, 0.2), (2, 0.0)):
        along = offsets[cloud["origId"].tolist().index(body), :, 2] / moved.radius[body]
        assert along.max() == pytest.approx(1.0 + epsilon)
        assert along.min() == pytest.approx(-1.0 + epsilon)


def test_missing_and_damaged_files_are_reported(case):
    run = foamprb.open_run(case)
    with pytest.raises(InputError, match=r"no table 'fate'. Did you mean 'fates'"):
        run.table("fate")
    with pytest.raises(InputError, match=r"none\.csv is no table: No such file"):
        read_table(run.folder / "none.csv")
    (run.folder / "run.json").write_text("{")
    with pytest.raises(InputError, match=r"run\.json is damaged"):
        _ = foamprb.open_run(case).record
    (run.folder / "run.json").write_text(json.dumps({"warnings": []}))
    assert foamprb.open_run(case).record == {"warnings": []}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b'NumberOfPoints="6"', b'NumberOfPoints="900000000000"'),
        (b'NumberOfPoints="6"', b'NumberOfPoints="-5"'),
        (b'type="Float64"', b'type="Float32"'),
        (b'offset="25"', b'offset="29"'),
        (b'NumberOfComponents="9"', b'NumberOfComponents="8"'),
    ],
)
def test_a_damaged_header_is_one_message(case, old, new):
    """VTK would crash on it, hang, or read other numbers."""
    file = case / "postProcessing/softCloud/softCloud_000000.vtp"
    run, whole = foamprb.open_run(case), file.read_bytes()
    assert len(run.cloud(0).points) == 6
    assert old in whole
    for body in (whole, whole[: whole.rindex(b"<!--")]):
        file.write_bytes(body.replace(old, new))
        if body is not whole:
            # Its checksum is right again.
            seal(file)
        with pytest.raises(InputError, match=r"softCloud_000000\.vtp is damaged"):
            run.cloud(0)
