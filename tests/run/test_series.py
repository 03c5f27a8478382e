"""Transient cases through the command line: a box with a velocity that is uniform in space, or nearly."""

from __future__ import annotations

import gzip
import json
import re
import shutil
from dataclasses import replace

import numpy as np
import pytest
import pyvista
from foamlib import FoamCase
from observing import table
from pipe_case import edit, message
from transient_case import SCALE, scaled, write_transient_case

import foamprb
from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.flow import balance, fluxes
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.flows import read_transient_flow
from foamprb.flow.read.meshfile import read_mesh_series
from foamprb.flow.read.openfoam import read_case, read_series
from foamprb.flow.read.source import FlowSource
from foamprb.flow.series import SeriesFlow
from foamprb.results.pvd import read_pvd
from foamprb.run.job import prepare


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    return write_transient_case(tmp_path_factory.mktemp("transient") / "case")


@pytest.fixture
def case(written, tmp_path):
    shutil.copytree(written, tmp_path / "case")
    return tmp_path / "case"


def run(case, *options):
    assert main(["run", "-case", str(case), *options]) == 0
    return case / "postProcessing/softCloud"


@pytest.mark.parametrize(("kind", "first"), [("case", "0"), ("file", "0.5")])
def test_the_first_time_without_balanced_fluxes_is_named(kind, first, case, tmp_path, monkeypatch):
    monkeypatch.setattr(balance, "MOST_ITERATIONS", 0)
    for module in (balance, fluxes):
        monkeypatch.setattr(module, "BALANCED", 0.0)
    flow, source = read_series(case), FlowSource(accept=("unbalanced",))
    if kind == "file":
        mesh = pyvista.ImageData(dimensions=(3, 3, 3)).cast_to_unstructured_grid()
        for k, time in enumerate((0.0, 0.5, 1.0)):
            mesh.cell_data["U"] = time * np.arange(24.0).reshape(8, 3) ** 2
            mesh.save(tmp_path / f"{k}.vtu")
        files = [{"name": f"{k}.vtu", "time": 0.5 * k} for k in range(3)]
        (tmp_path / "all.vtu.series").write_text(json.dumps({"files": files}))
        source = replace(source, file=tmp_path / "all.vtu.series")
        flow = read_mesh_series(source.file)
    with pytest.raises(InputError, match=rf"{first}(/U)? cannot be balanced.*accept \( unbalanced"):
        flow.load(0.0, flow.times[-1])
    accepted = read_transient_flow(case, None, None, source)
    accepted.load(0.0, 1.0)
    mesh = accepted.mesh
    accepted.sample(mesh.nodes[mesh.tets].mean(axis=1), np.arange(len(mesh.tets)), 0.5)
    assert accepted.arrays().correction[: 2 * len(mesh.tets)] == pytest.approx(0.0, abs=1e-30)


def test_the_time_of_the_run_is_that_of_the_flow(case):
    edit(case, r"deltaT\s", "writeFields (shearRate); deltaT ")
    folder = run(case, "-time", "0:1.5")
    entries = read_pvd(folder / "softCloud.pvd")
    assert [entry.time for entry in entries] == pytest.approx([0.0, 0.4, 0.8, 1.2])
    row = table(folder / "fates.csv")[0]
    assert (float(row["t0"]), float(row["t1"])) == (0.3, pytest.approx(1.2))
    # The factor is 0.02 at 0.5 and −0.04 at 1.5: at 1.2 it is −0.022.
    last = pyvista.read(folder / entries[-1].file)
    gradient = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])
    d = 0.5 * 0.022 * (gradient + gradient.T)
    assert last["shearRate"] == pytest.approx(np.sqrt(2 * np.sum(d * d)), rel=1e-4)


def test_injection_starts_with_the_flow_unless_it_says_otherwise(case):
    edit(case, "SOI 0.3;", "")
    folder = run(case, "-time", "0.5:")
    assert [float(row["t0"]) for row in table(folder / "fates.csv")] == [0.5, 0.5]
    assert read_pvd(folder / "softCloud.pvd")[1].time == pytest.approx(0.9)


def test_first_time_at_rest_is_named_where_no_fluid_enters(case, capsys):
    """The first time of a solution that changes in time is often one at rest."""
    start = 'type manualInjection; positionsFile "positions"; SOI 0.3;'
    edit(case, start, "type patchInjection; patch floor; parcelsPerSecond 100; duration 0.1;")
    velocity = case / "0/U"
    velocity.write_text(re.sub(r"\((\S+) (\S+) (\S+)\)", "(0 0 0)", velocity.read_text()))
    error = message(case, capsys)
    assert "patchInjection on floor: no fluid enters through this patch at SOI, 0 s; it is at rest" in error
    assert prepare(case, "0.5:").cloud.particles.t0.min() == 0.5


def test_a_period_repeats_the_flow(case):
    edit(case, "endTime 1.2", "endTime 6; period 2")
    folder = run(case)
    assert read_pvd(folder / "softCloud.pvd")[-1].time == pytest.approx(6.0)
    flow = prepare(case).cloud.flow
    x = np.array([[0.2, 0.3, 0.4]])
    for t in (0.0, 0.7, 1.8):
        u, _ = flow.sample(x, flow.locate(x), t)
        again, _ = flow.sample(x, flow.locate(x), t + 4.0)
        np.testing.assert_allclose(u, again, rtol=1e-12)
    assert any("repeats itself every 2 s" in note for note in flow.notes)


def test_a_run_goes_on_after_its_solver_wrote_and_removed_times(case, tmp_path, capsys):
    """A run at 0.8 s needs the times around it, not those before, and may continue through later ones."""
    # Steps then end at 0.8 s in the longer run, too.
    edit(case, "transient yes;", "transient yes; maxDeltaT 0.05;")
    later = case / "2"
    shutil.copytree(case / "0.5", later)
    whole = tmp_path / "whole"
    shutil.copytree(case, whole)
    edit(whole, "endTime 1.2", "endTime 2")
    run(whole)
    expected = (whole / "postProcessing/softCloud/fates.csv").read_bytes()
    later.rename(tmp_path / "2")
    edit(case, "endTime 1.2", "endTime 0.8")
    run(case)
    edit(case, "endTime 0.8", "endTime 2")
    (tmp_path / "2").rename(later)
    shutil.copytree(case / "0.5", case / "0.6")
    assert "the time 0.6 was added to the flow" in message(case, capsys, "-resume")
    shutil.rmtree(case / "0.6")
    (case / "1.5").rename(tmp_path / "1.5")
    assert "the time 1.5 of the flow is missing" in message(case, capsys, "-resume")
    (tmp_path / "1.5").rename(case / "1.5")
    text = (case / "1.5/U").read_text()
    # The solver was restarted from 0.5.
    (case / "1.5/U").write_text(scaled(text, 0.999))
    assert "the flow around t = 0.8 s has changed" in message(case, capsys, "-resume")
    (case / "1.5/U").write_text(text)
    assert (run(case, "-resume") / "fates.csv").read_bytes() == expected


def test_a_case_of_foamlib_stands_for_its_folder(case):
    of_foamlib = FoamCase(case)
    assert foamprb.select_times(of_foamlib) == ("0", "0.5", "1.5")
    assert foamprb.read_case(of_foamlib, 0).at_nodes()[0] == "0"
    assert isinstance(foamprb.read_series(of_foamlib), SeriesFlow)
    assert foamprb.read_medium(of_foamlib, rho=1000.0).mu == pytest.approx(1e-3)
    foamprb.execute(foamprb.prepare(of_foamlib))
    assert len(foamprb.open_run(of_foamlib).times) == 4
    assert list(foamprb.open_runs(of_foamlib)) == ["case"]


def test_a_run_does_not_go_on_in_another_flow(case, capsys):
    edit(case, "endTime 1.2", "endTime 0.8")
    run(case)
    edit(case, "endTime 0.8", "endTime 1.2; period 2")
    assert "flow/period" in message(case, capsys, "-resume")


def test_a_single_time_is_a_steady_flow(case):
    assert isinstance(prepare(case).cloud.flow, SeriesFlow)
    for options in ("0.5", "latestTime"):
        job = prepare(case, options)
        assert isinstance(job.cloud.flow, MeshFlow)
        assert job.cloud.start == 0.0


def test_dry_run_reports_the_times_of_the_flow(case, capsys):
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    assert "2 particles, 24 steps" in out
    assert "linear in time" in out


def test_a_transient_flow_of_a_mesh_file(case, tmp_path):
    """That of the case, written out by VTK: the same fates but for the cut of the faces."""
    whole = run(case)
    names = []
    for time in SCALE:
        flow = read_case(case, time)
        grid = pyvista.OpenFOAMReader(str(marked(case)))
        grid.set_active_time_value(float(time))
        shape = grid.read()["internalMesh"]
        shape.clear_data()
        shape.cell_data["U"] = flow.arrays(0.0).nodes[flow.mesh.n_points :, 4:7]
        shape.save(tmp_path / f"flow{time}.vtu")
        names.append({"name": f"flow{time}.vtu", "time": float(time)})
    (tmp_path / "flow.vtu.series").write_text(json.dumps({"files": names}))
    expected = table(whole / "fates.csv")
    shutil.rmtree(case / "postProcessing")
    file = str(tmp_path / "flow.vtu.series")
    found = table(run(case, "-flow", file, "-time", "0:1.5") / "fates.csv")
    for a, b in zip(found, expected, strict=True):
        assert [float(a[k]) for k in ("x1", "y1", "z1")] == pytest.approx(
            [float(b[k]) for k in ("x1", "y1", "z1")], abs=1e-6
        )


def marked(case):
    (case / "case.foam").touch()
    return case / "case.foam"


def moving(case):
    (case / "0.5/polyMesh").mkdir()
    shutil.copy(case / "constant/polyMesh/points", case / "0.5/polyMesh/points")


def remade(case):
    shutil.copytree(case / "constant/polyMesh", case / "0.5/polyMesh")


def compress(file):
    packed = gzip.compress(file.read_bytes())
    file.unlink()
    file.with_name("U.gz").write_bytes(packed[: len(packed) // 2])


DAMAGES = {
    "missing": lambda file: file.unlink(),
    "empty": lambda file: file.write_text(""),
    "cut off": lambda file: file.write_text(file.read_text()[:-5]),
    "unreadable": compress,
}


@pytest.mark.parametrize("fault", DAMAGES)
def test_a_time_without_a_whole_velocity_is_left_out(fault, case, capsys):
    DAMAGES[fault](case / "0.5/U")
    assert main(["run", "-dry-run", "-case", str(case)]) == 0
    said = capsys.readouterr().out
    assert said.count(f"Times without a whole field U are left out: 0.5 ({fault}).") == 1
    assert "linear in time between 2 times from 0 to 1.5" in said
    assert ("Warning : Times" in said) == (fault != "missing")


def test_points_at_all_times_are_the_motion_of_the_mesh(case, capsys):
    points = (case / "constant/polyMesh/points").read_text()
    for time, way in (("0.5", 0.05), ("1.5", 0.15)):
        moved = re.sub(
            r"\((\S+) (\S+) (\S+)\)", lambda m, way=way: f"({float(m[1]) + way} {m[2]} {m[3]})", points
        )
        (case / time / "polyMesh").mkdir()
        (case / time / "polyMesh/points").write_text(moved)
    assert main(["run", "-dry-run", "-case", str(case)]) == 0
    said = capsys.readouterr().out
    assert re.search(r"The mesh moves: piece 1 \(\d+ cells\) moves by up to 0.1 m a write\.", said)
    edit(case, "ellipsoidDrag;", "ellipsoidDrag; wallLift;")
    assert main(["run", "-dry-run", "-case", str(case)]) == 0
    assert "beyond cutOff" in capsys.readouterr().out


MISTAKES = {
    "end beyond the flow": (
        lambda c: edit(c, "endTime 1.2", "endTime 1.6"), [],
        ["softCloudProperties", "solution/endTime is 1.6", "the flow at 1.5", "period"],
    ),
    "end before the start": (
        lambda c: edit(c, "endTime 1.2", "endTime 0.4"), ["-time", "0.5:"],
        ["solution/endTime is 0.4. Allowed: after 0.5, the first time of the flow"],
    ),
    "injection before the start": (
        lambda c: edit(c, "SOI 0.3", "SOI 0.3"), ["-time", "0.5:"],
        ["injection model manual: SOI is 0.3. Allowed: from 0.5 on"],
    ),
    "points at some times": (
        moving, [], ["the mesh moves, but polyMesh/points is missing at the times 1.5. Allowed: points"],
    ),
    "points at one time": (remade, [], ["polyMesh/points is missing at the times 1.5"]),
    "several times of a steady flow": (
        lambda c: edit(c, "transient yes; ", ""), ["-time", "0:0.5"],
        ["solution/transient is no", "-time '0:0.5' selects several times"],
    ),
    "a period that the times do not fill": (
        lambda c: edit(c, "transient yes; ", "transient yes; period 4; "), [],
        ["to 1.5 s do not fill the period of 4 s from 0 to 4 s: correct the period."],
    ),
    "iterations": (
        lambda c: (c / "system/fvSchemes").write_text("ddtSchemes { default localEuler; }"), [],
        ["the times of the flow are iterations (ddtSchemes localEuler)", "accept ( pseudoTime )"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_gives_one_message(mistake, case, capsys):
    break_it, options, words = MISTAKES[mistake]
    break_it(case)
    error = message(case, capsys, *options)
    for word in words:
        assert word in error
