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


@pytest.fixture
def case(tmp_path):
    write_run(tmp_path, motion(9, 5), mesh=False, fates=True)
    return tmp_path


def test_a_notebook_shows_the_page_of_view(case):
    page = foamprb.open_run(case).view(time=0.2, max_size=5)
    assert page.path == case / "postProcessing/softCloud/softCloud.html"
    shown = page._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!doctype html')
    assert '"' not in shown.split('"')[1]


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
    monkeypatch.setattr("foamprb.view.results._FRAMES", ())
    with pytest.raises(InputError, match="needs pandas or polars"):
        foamprb.open_run(case).frame()


def test_without_pyvista_tables_are_read_and_the_extra_is_named(case, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    run = foamprb.open_run(case)
    assert len(run.table()["id"]) == 9
    with pytest.raises(InputError, match=r"need pyvista: pip install 'foamprb\[view\]'"):
        run.snapshot()


def test_missing_and_damaged_files_are_reported(case):
    run = foamprb.open_run(case)
    with pytest.raises(InputError, match=r"no table 'fate'. Did you mean 'fates'"):
        run.table("fate")
    with pytest.raises(InputError, match="not a readable table"):
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
    file.write_bytes(whole.replace(old, new))
    with pytest.raises(InputError, match=r"softCloud_000000\.vtp: damaged"):
        run.cloud(0)
