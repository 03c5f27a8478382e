"""What a run leaves in its folder, lists there, and removes of an earlier run."""

from __future__ import annotations

import errno
import json
import re
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyvista
from pipe_case import edit, message, results
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from foamprb import execute, open_run, prepare
from foamprb.cli import main
from foamprb.cloud.measures import WRITTEN
from foamprb.cloud.state import Status
from foamprb.errors import RunStopped
from foamprb.results import atomic
from foamprb.results.atomic import unfinished
from foamprb.results.background import Writer
from foamprb.results.checkpoint import Checkpoints
from foamprb.results.folder import ResultsFolder
from foamprb.results.manifest import Manifest
from foamprb.results.pieces import XMLPolyDataReader
from foamprb.results.pvd import Series, SnapshotFile, read_pvd
from foamprb.results.tables import read_table
from foamprb.run import results as results_of_run

TRACKS = "paths { type particleTracks; trackInterval 10; maxSamples 10; }"
HITS = "hits { type patchPostProcessing; patches (wall outlet); }"


def run(case: Path, *options: str) -> None:
    assert main(["run", "-case", str(case), *options]) == 0


def folder_of(case: Path) -> Path:
    return case / "postProcessing/softCloud"


def observe(case: Path, *functions: str) -> None:
    edit(case, r"(?s)^cloudFunctions\s*\{.*\}\s*\Z", f"cloudFunctions {{ {' '.join(functions)} }}")


def names(folder: Path) -> set[str]:
    return {str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()}


def test_results_go_into_another_folder(case, tmp_path, truth, capsys):
    case.chmod(0o555)
    out = tmp_path / "out"
    run(case, "-output", str(out))
    assert not (case / "postProcessing").exists()
    assert (out / "softCloud/fates.csv").read_bytes() == truth["fates.csv"]
    run(case, "-output", str(out), "-resume")
    assert "The run has ended" in capsys.readouterr().out
    for command in (["view", "-noBrowser"], ["report"], ["export", "openfoam"]):
        assert main([*command, "-case", str(case), "-results", str(out)]) == 0
    assert {"softCloud.html", "report.html", "openfoam"} < {
        file.name for file in (out / "softCloud").iterdir()
    }
    assert not (case / "postProcessing").exists()


def test_a_folder_that_cannot_be_written_has_a_way_out(case, capsys, monkeypatch):
    def refuse(path: Path) -> None:
        raise PermissionError(errno.EACCES, "Permission denied", str(path))

    monkeypatch.setattr(results_of_run, "only_writer", refuse)
    assert main(["run", "-case", str(case)]) == 1
    said = capsys.readouterr().err
    assert "The option -output DIR writes the results into another folder." in said
    # Nothing is there that could be continued.
    assert "-resume" not in said


def test_a_file_is_listed_before_it_is_written(case, monkeypatch):
    replace, seen = Path.replace, []

    def listed(file: Path, target: Path) -> Path:
        seen.append(target)
        if target.name != "manifest.json":
            assert target in Manifest.read(folder_of(case)).files
        return replace(file, target)

    monkeypatch.setattr(Path, "replace", listed)
    run(case)
    # Manifest and record; cloud and list at the start; these and a checkpoint at six times; manifest, table.
    assert len(seen) == 2 + 2 + 3 * 6 + 2


def test_new_run_removes_listed_files_only(case, truth):
    observe(case, TRACKS, HITS)
    edit(case, r"endTime\s+\S+;", "endTime 0.009;")
    run(case)
    folder = folder_of(case)
    own = [
        "softCloud_mine.vtp", "softCloud_000099.vtp", "other_000007.vtp", "paths/notes.txt", "failed.txt",
        "softCloud_000042/0.vtp", "checkpoint/mine", ".hidden.0.tmp",
        "failed.csv", ".notes.0123abcd.tmp",
    ]  # fmt: skip
    for name in own:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text("mine")
    observe(case)
    edit(case, r"endTime\s+\S+;", "endTime 0.006;")
    run(case)
    for name in own:
        assert (folder / name).read_text() == "mine"
        (folder / name).unlink()
    (folder / "softCloud_000042").rmdir()
    (folder / "paths").rmdir()
    assert not (folder / "hits").exists()
    assert results(case) == truth


def test_a_file_of_the_user_in_a_folder_of_a_function_is_not_listed(case):
    notes = folder_of(case) / "paths/notes.txt"
    notes.parent.mkdir(parents=True)
    notes.write_text("mine")
    observe(case, TRACKS)
    run(case)
    assert notes not in Manifest.read(folder_of(case)).files
    assert folder_of(case) / "paths/tracks.vtp" in Manifest.read(folder_of(case)).files


def leave_behind(case: Path) -> None:
    """What a killed run leaves that wrote the cloud of 4 ms with others, but no checkpoint."""
    folder = folder_of(case)
    left = ["softCloud_000004.pvtp", "softCloud_000004/0.vtp", "softCloud_000004/1.vtp"]
    Manifest(folder, Manifest.read(folder).files).expect([folder / name for name in left])
    for name in (*left, "softCloud_000004/.1.vtp.0123abcd.tmp", ".softCloud.pvd.0123abcd.tmp"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).touch()
    series = Series(ResultsFolder(folder, "softCloud"))
    series.relist([*read_pvd(series.folder.pvd), SnapshotFile(0.004, left[0])])


@pytest.mark.parametrize("option", ["-resume", "-overwrite"])
def test_leftovers_of_a_killed_run_are_removed(option, stopped, truth):
    leave_behind(stopped)
    run(stopped, option)
    assert results(stopped) == truth
    assert not (folder_of(stopped) / "softCloud_000004").exists()


DAMAGES: dict[str, Callable[[Path], object]] = {
    "garbled": lambda pvd: pvd.write_text("<VTKFile>"),
    "with names of other folders": lambda pvd: pvd.write_text(pvd.read_text().replace('"soft', '"../soft')),
    "missing": Path.unlink,
}


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("option", ["-resume", "-overwrite"])
def test_a_damaged_list_of_clouds_stops_no_run(option, damage, stopped, truth, capsys):
    DAMAGES[damage](folder_of(stopped) / "softCloud.pvd")
    run(stopped, option)
    note = "rebuilt from the checkpoint" if option == "-resume" else "It is replaced"
    warned = re.search(rf"Warning : .*softCloud\.pvd.* {note}", capsys.readouterr().out)
    assert bool(warned) == (damage != "missing")
    assert results(stopped) == truth


def test_a_run_with_a_damaged_manifest_goes_on_but_is_not_replaced(stopped, truth, capsys):
    """What an earlier run wrote is not known then; what the checkpoint needs is."""
    manifest = folder_of(stopped) / "manifest.json"
    manifest.write_text(manifest.read_text().replace("softCloud_000001", "../softCloud_000001"))
    before = names(folder_of(stopped))
    text = message(stopped, capsys, "-overwrite")
    assert re.search(r"manifest\.json is damaged: it names .* remove or rename", text)
    assert names(folder_of(stopped)) == before
    run(stopped, "-resume")
    assert "Warning : " in capsys.readouterr().out
    assert results(stopped) == truth


def test_checkpoints_that_no_manifest_lists_are_not_removed(stopped, truth, capsys):
    folder = folder_of(stopped)
    (folder / "manifest.json").unlink()
    before = names(folder)
    text = message(stopped, capsys, "-overwrite")
    assert re.search(r"manifest\.json does not list checkpoint/0\.00[23]\.npz\. .* remove or rename", text)
    assert names(folder) == before
    for file in (folder / "checkpoint").iterdir():
        file.unlink()
    run(stopped)
    assert results(stopped) == truth


def test_files_of_no_run_are_named_and_removed_on_request(finished, capsys):
    """As a run of an earlier version left them; notes of a user stay."""
    case, folder = finished, folder_of(finished)
    left = ["softCloud_000017.vtp", "checkpoint/0.9.npz", ".softCloud.pvd.0123abcd.tmp"]
    stay = ["checkpoint/notes.txt", "other/notes.csv"]
    (folder / "other").mkdir()
    for name in (*left, *stay):
        (folder / name).touch()
    assert main(["report", "-case", str(case)]) == 0
    assert "4 files in" in (page := (folder / "report.html").read_text())
    assert all(name in page for name in (*left, "other/notes.csv"))
    assert "manifest.json does not list checkpoint/0.9.npz" in message(case, capsys)
    run(case, "-overwrite")
    assert {*left, *stay} & names(folder) == {*stay}


def test_a_table_is_listed_before_it_is_begun(case, monkeypatch):
    observe(case, HITS)
    manifest, seen = folder_of(case) / "manifest.json", []
    touch = Path.touch

    def watched(file: Path, *arguments: object, **options: bool) -> None:
        if file.parent.name == "hits":
            seen.append(unfinished(file).relative_to(manifest.parent).as_posix())
            assert seen[-1] in json.loads(manifest.read_text())["files"]
        touch(file, *arguments, **options)

    monkeypatch.setattr(Path, "touch", watched)
    run(case)
    assert len(seen) > len({*seen}) > 0


def interrupt_removal(case: Path, nth: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Begin a run anew, and interrupt it as it removes the nth file of the one before."""
    unlink, calls = Path.unlink, iter(range(1, 1000))

    def dies(file: Path, missing_ok: bool = False) -> None:
        if next(calls) == nth:
            raise KeyboardInterrupt
        unlink(file, missing_ok)

    monkeypatch.setattr(Path, "unlink", dies)
    assert main(["run", "-case", str(case), "-overwrite"]) == 130
    monkeypatch.undo()


@pytest.mark.parametrize("nth", [1, 3, 6])
def test_a_removal_that_is_interrupted_is_taken_up(nth, stopped, truth, monkeypatch):
    """Whatever has been removed by then, the run that comes next leaves nothing of what has not."""
    leave_behind(stopped)
    interrupt_removal(stopped, nth, monkeypatch)
    run(stopped, "-resume")
    assert results(stopped) == truth


@pytest.mark.parametrize("nth", [1, 5])
def test_a_finished_run_is_replaced_or_whole(nth, case, monkeypatch):
    """Without its checkpoints nobody takes what is left for the run, with them all is there."""
    observe(case, TRACKS.replace("paths", "aaa"))
    run(case)
    expected = results(case)
    interrupt_removal(case, nth, monkeypatch)
    run(case, "-resume")
    assert results(case) == expected


@pytest.mark.parametrize("option", ["-resume", "-overwrite"])
def test_a_list_names_whole_files_only_while_others_are_removed(option, stopped, monkeypatch):
    leave_behind(stopped)
    unlink, removed = Path.unlink, []

    def check(file: Path, missing_ok: bool = False) -> None:
        unlink(file, missing_ok)
        removed.append(file.name)
        pvd = folder_of(stopped) / "softCloud.pvd"
        if pvd.exists():
            assert all((pvd.parent / entry.file).exists() for entry in read_pvd(pvd))

    monkeypatch.setattr(Path, "unlink", check)
    run(stopped, option)
    assert "softCloud_000004.pvtp" in removed


def test_only_one_run_writes_to_a_folder(stopped, capsys):
    with atomic.only_writer(folder_of(stopped)):
        assert "another run is writing here" in message(stopped, capsys, "-overwrite")


def cloud_at(case: Path, index: int) -> Any:
    folder = folder_of(case)
    return XMLPolyDataReader(folder / read_pvd(folder / "softCloud.pvd")[index].file).read()


def test_the_first_snapshot_is_that_of_the_start(case):
    """It has those that are injected then: at rest in shape, with the fluid's velocity or what is given."""
    edit(case, r"SOI\s+0;", "SOI 0; // all at once")
    edit(case, r"deltaT\s", "writePrecision double; deltaT ")
    run(case)
    entries = read_pvd(folder_of(case) / "softCloud.pvd")
    assert [e.time for e in entries] == pytest.approx([0.001 * n for n in range(7)], abs=1e-15)
    job = prepare(case)
    p, found = job.cloud.particles, cloud_at(case, 0)
    rows = np.flatnonzero(p.t0 == 0.0)
    assert 0 < len(rows) < p.size
    assert found["origId"].tolist() == rows.tolist()
    np.testing.assert_array_equal(found.points, p.x[rows])
    u = job.cloud.flow.sample(p.x[rows], p.host[rows], 0.0)[0]
    np.testing.assert_array_equal(found["U"], np.where(np.isnan(p.v[rows]), u, p.v[rows]))
    np.testing.assert_array_equal(found["deformationGradient"], np.tile(np.eye(3).ravel(), (len(rows), 1)))
    assert not found["age"].any()
    assert found["active"].all()
    # Nothing of it is seen in the run itself.
    assert (p.status == Status.PENDING).all()


def test_files_have_single_precision_and_the_requested_arrays(case):
    edit(case, r"deltaT\s", "writeFields (shearRate J); deltaT ")
    edit(case, r"endTime\s+\S+;", "endTime 0.001;")
    run(case)
    path = folder_of(case) / read_pvd(folder_of(case) / "softCloud.pvd")[1].file
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    found = pyvista.wrap(reader.GetOutput())
    assert {*found.point_data} == {*WRITTEN, "shearRate", "J"}
    assert {found[name].dtype for name in ("U", "d", "glyph", "shearRate")} == {np.dtype(np.float32)}
    assert found.points.dtype == np.float32
    # Numbers of particles have no rounding.
    assert found["origId"].dtype == np.int64
    job = prepare(case)
    # One percent of the radius is 2.5e-8 m, half a unit in the last place at 1.5 m is 6e-8 m.
    job.cloud.flow.bounds = (np.zeros(3), np.array([0.0, 0.0, 1.5]))
    contents = results_of_run._contents_of(job)
    assert (contents.single, contents.single_places) == (True, False)


def test_a_run_that_goes_on_from_before_its_first_step_lists_its_start_once(case, truth):
    with pytest.raises(RunStopped):
        execute(prepare(case), stop=lambda: True)
    assert [file.name for file in (folder_of(case) / "checkpoint").iterdir()] == ["0.npz"]
    run(case, "-resume")
    assert results(case) == truth


def test_a_run_whose_particles_come_later_begins_with_an_empty_snapshot(case):
    edit(case, r"SOI\s+0;", "SOI 0.0015;")
    run(case)
    assert [cloud_at(case, n).n_points > 0 for n in range(3)] == [False, False, True]


def test_a_run_whose_last_checkpoint_fails_is_not_done(case, monkeypatch):
    """Though the table that says so is written beside it; the run goes on from the checkpoint before."""
    job, write = prepare(case, threads=1), Checkpoints.write

    def fail_late(self, checkpoint):
        # Long enough for the table to be there first.
        time.sleep(0.2)
        if checkpoint.time >= 0.999 * job.settings.solution.endTime:
            raise OSError(errno.ENOSPC, "No space left on device", str(self.file(checkpoint.time)))
        return write(self, checkpoint)

    monkeypatch.setattr(Checkpoints, "write", fail_late)
    monkeypatch.setattr(results_of_run, "LONG", 3)
    with pytest.raises(RunStopped, match="No space left"):
        execute(job)
    assert not list(folder_of(case).glob("*fates*"))
    monkeypatch.undo()
    execute(prepare(case, threads=1), "latestTime")
    assert (folder_of(case) / "fates.csv").exists()


def test_a_long_table_of_fates_has_the_same_rows_as_numpy_has_them(case, monkeypatch):
    """Until a run with few bodies takes its place."""
    monkeypatch.setattr(results_of_run, "LONG", 3)
    run(case)
    folder = folder_of(case)
    records, table = np.load(folder / "fates.npy"), read_table(folder / "fates.csv", ("fate", "patch"))
    assert records.dtype.names == tuple(table)
    for name, column in table.items():
        np.testing.assert_array_equal(records[name], column)
        np.testing.assert_array_equal(open_run(case).table()[name], column)
    monkeypatch.undo()
    run(case, "-overwrite")
    assert {file.name for file in folder.glob("fates*")} == {"fates.csv"}


def test_a_case_that_is_moved_ends_its_run(case):
    """Else the results would be split between two folders."""
    job, elsewhere = prepare(case, threads=1), case.with_name("elsewhere")

    def move() -> bool:
        if job.cloud.step and case.exists():
            case.rename(elsewhere)
        return False

    with pytest.raises(RunStopped, match="No such file or directory"):
        execute(job, stop=move)
    assert not case.exists()
    assert (elsewhere / "postProcessing/softCloud/softCloud.pvd").exists()


def test_the_cost_of_a_write_is_linear_in_the_number_of_snapshots(case):
    job, calls = prepare(case, threads=1), [0]

    def count(_frame: object, event: str, _argument: object) -> None:
        calls[-1] += event in ("call", "c_call")

    with atomic.only_writer(job.folder.path), Writer() as thread:
        written = results_of_run.Results(job, thread)
        written.begin("startTime")
        threading.setprofile(count)
        sys.setprofile(count)
        try:
            for job.cloud.step in range(1, 61):
                written.write([job.cloud.step])
                thread.finish()
                calls.append(0)
        finally:
            sys.setprofile(None)
            threading.setprofile(None)
    # The lines of earlier snapshots are kept: without that they took twenty calls for each.
    assert sum(calls[50:60]) - sum(calls[20:30]) < 10 * 30 * 2


def test_no_step_ends_for_a_write_time(case):
    """Fates are the same to the last bit for any interval, and so is the cloud at times that two have."""
    edit(case, r"shape\s+paper;", "shape auto;")
    seen: dict[float, dict[float, Any]] = {}
    tables = set()
    for interval in (0.006, 0.002, 0.0005, 0.00014):
        edit(case, r"writeInterval\s+\S+;", f"writeInterval {interval};")
        assert main(["run", "-case", str(case), "-overwrite", "-threads", "2"]) == 0
        run = open_run(case)
        tables.add((case / "postProcessing/softCloud/fates.csv").read_bytes())
        seen[interval] = {round(at, 9): run.snapshot(at) for at in run.times}
    assert len(tables) == 1
    assert len(seen[0.00014]) == 44
    for coarse, fine in ((0.006, 0.002), (0.002, 0.0005)):
        for at, snapshot in seen[coarse].items():
            other = seen[fine][at]
            np.testing.assert_array_equal(snapshot.points, other.points)
            for name in ("U", "glyph", "status", "origId", "age"):
                np.testing.assert_array_equal(snapshot[name], other[name])


def test_a_snapshot_within_steps_is_that_of_steps_which_end_there(case):
    """Within the tolerance, with all that depends on the flow there."""
    edit(case, r"shape\s+paper;", "shape stokes;")
    edit(
        case, r"(writeInterval)\s+\S+;", r"\1 0.00154; writeFields (stresslet shearRate angularVelocity Uc);"
    )
    assert main(["run", "-case", str(case)]) == 0
    within = open_run(case).snapshot(0.00462)
    edit(case, r"endTime\s+\S+;", "endTime 0.00462;")
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    ended = open_run(case).snapshot(0.00462)
    np.testing.assert_array_equal(within["origId"], ended["origId"])
    np.testing.assert_array_equal(within["status"], ended["status"])
    # The tolerance of 1e-4 is that of the way of a step, some 0.4 mm.
    assert np.abs(within.points - ended.points).max() < 1e-4 * 1e-3
    for name, tolerance in (("Uc", 1e-5), ("shearRate", 1e-4), ("glyph", 1e-3), ("U", 1e-3)):
        difference = np.abs(within[name] - ended[name]).max()
        assert difference < tolerance * np.abs(ended[name]).max(), name
    for name in ("stresslet", "angularVelocity"):
        difference = np.abs(within[name] - ended[name])
        assert np.quantile(difference, 0.95) < 0.02 * np.abs(ended[name]).max(), name
