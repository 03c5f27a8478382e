"""Runs that are interrupted and go on: the same results, bit for bit, or one clear message."""

from __future__ import annotations

import errno
import gzip
import itertools
import json
import logging
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from paths import ROOT
from pipe_case import EARLIER, END, edit, fates, message, results, stop_after, time_folder

from foamprb import execute, prepare
from foamprb.cli import main
from foamprb.cloud.instants import PREFIX
from foamprb.errors import RunStopped
from foamprb.results import atomic
from foamprb.results.background import Writer
from foamprb.results.checkpoint import StoredCheckpoint
from foamprb.results.pvd import read_pvd
from foamprb.run import restart

KILL_TEST = ROOT / "tools/hardening/kill_test"


def go_on(case: Path, *options: str) -> None:
    assert main(["run", "-case", str(case), "-resume", *options]) == 0


def test_walls_molecules_and_shapes_go_on_where_they_were(case, monkeypatch):
    """Numbers are those of the particle and the step, and the forces those of the place."""
    edit(case, r"shape\s+paper;", "shape stokes;")
    edit(case, r"^(\s*)tractionModel", r"\1shapeModel quadratic;\n\1tractionModel")
    edit(
        case,
        r"^\s+gravity;",
        "wallLift { cutOff 100; } BrownianMotion { T 293.15; } faxenCorrection; gravity;",
    )
    camera = "type deformabilityCytometry; origin (0.0005 0 0); normal (1 0 0); view (0 0 1);"
    channel = "channel { type tube; radius 0.0021; }"
    edit(case, r"cloudFunctions\s*\{\}", f"cloudFunctions {{ camera {{ {camera} {channel} }} }}")
    monkeypatch.setattr("foamprb.run.loop.MOST_STEPS", 3000)
    assert main(["run", "-case", str(case)]) == 0
    expected = results(case)
    assert expected["camera/cytometry.csv"].count(b"\n") > 100
    shutil.rmtree(case / "postProcessing")
    for time in (0.0017, EARLIER):
        stop_after(case, time)
    go_on(case, "-threads", "3")
    assert results(case) == expected
    shutil.rmtree(case / "postProcessing")
    edit(case, r"T 293\.15;", "T 293.15; seed 2;")
    assert main(["run", "-case", str(case)]) == 0
    assert results(case)["fates.csv"] != expected["fates.csv"]


def test_a_run_stopped_between_two_write_times_goes_on(case, truth, monkeypatch):
    # A few steps at a time, so that it stops at any of them.
    monkeypatch.setattr("foamprb.run.loop.MOST_STEPS", 3000)
    assert main(["run", "-case", str(case)]) == 0
    expected = results(case)
    assert expected["fates.csv"] == truth["fates.csv"]
    shutil.rmtree(case / "postProcessing")
    for time in (0.0, 0.0017, 0.0043):
        stop_after(case, time)
    go_on(case)
    assert results(case) == expected


def test_steps_through_several_tracking_steps_do_not_depend_on_where_a_run_stops(case, monkeypatch):
    """Nor on the number of threads; write times are no multiples of theirs."""
    edit(case, r"shape\s+paper;", "shape rosenbrock;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.00154;")
    assert main(["run", "-case", str(case)]) == 0
    expected = results(case)
    shutil.rmtree(case / "postProcessing")
    monkeypatch.setattr("foamprb.run.loop.MOST_STEPS", 3000)
    for time in (0.0, 0.0009, 0.0017, 0.0043):
        stop_after(case, time)
    stopped = prepare(case).cloud
    go_on(case, "-threads", "2")
    assert results(case) == expected
    assert stopped.tracker.stretch_steps > 1


def test_a_run_that_stops_within_a_call_keeps_what_passed_write_times(case, monkeypatch):
    """Some particles are then ahead of others, beyond write times."""
    edit(case, r"shape\s+paper;", "shape rosenbrock;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.00014;")
    assert main(["run", "-case", str(case)]) == 0
    expected = results(case)
    shutil.rmtree(case / "postProcessing")
    monkeypatch.setattr("foamprb.cloud.tracker._PATIENCE", 0.0)
    for _ in range(3):
        job = prepare(case)

        def passed(rank=job.cloud.comm.rank) -> bool:
            return any(a.any() for name, a in rank.share.memory.items() if name == f"{PREFIX}status")

        with pytest.raises(RunStopped):
            execute(job, "latestTime", passed)
        checkpoint = max((case / "postProcessing/softCloud/checkpoint").iterdir())
        assert len(StoredCheckpoint(checkpoint).header["stored"]) > 0
    go_on(case)
    assert results(case) == expected


def test_a_later_end_time_continues_the_run(case, truth):
    edit(case, r"endTime\s+\S+;", f"endTime {EARLIER};")
    assert main(["run", "-case", str(case)]) == 0
    edit(case, r"endTime\s+\S+;", f"startFrom latestTime; startTime 0; endTime {END};")
    assert main(["run", "-case", str(case)]) == 0
    assert results(case) == truth


def test_an_earlier_end_time_ends_the_run(stopped):
    """The checkpoint has bodies that enter after the new end, which a run with this end does not store."""
    edit(stopped, r"endTime\s+\S+;", "endTime 0.0035;")
    go_on(stopped)
    found = results(stopped)
    assert main(["run", "-case", str(stopped), "-overwrite"]) == 0
    assert found == results(stopped)


def test_a_run_that_ended_within_a_stretch_of_steps_continues_from_its_start(case):
    """Its last steps were shorter than those of the longer run."""
    edit(case, r"shape\s+paper;", "shape stokes;")
    assert main(["run", "-case", str(case)]) == 0
    expected = results(case)
    edit(case, r"endTime\s+\S+;", "endTime 0.0047;")
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert results(case)["fates.csv"] != expected["fates.csv"]
    edit(case, r"endTime\s+\S+;", f"endTime {END};")
    go_on(case)
    assert results(case) == expected


def test_a_run_ends_at_an_end_time_between_two_steps(case, truth):
    """A later end time continues before the shorter last step, which a longer run does not have."""
    edit(case, r"endTime\s+\S+;", "endTime 0.0030137;")
    assert main(["run", "-case", str(case)]) == 0
    ended = results(case)
    pvd = case / "postProcessing/softCloud/softCloud.pvd"
    assert [entry.time for entry in read_pvd(pvd)] == pytest.approx([0.0, 1e-3, 2e-3, 3e-3, 3.0137e-3])
    assert {float(row["t1"]) for row in fates(case) if row["fate"] == "active"} == {0.0030137}
    shutil.rmtree(pvd.parent)
    stop_after(case, 0.002)
    go_on(case)
    assert results(case) == ended
    edit(case, r"endTime\s+\S+;", f"endTime {END};")
    go_on(case)
    assert results(case) == truth


def test_a_run_with_one_checkpoint_between_two_steps_cannot_be_extended(case, capsys):
    edit(case, r"endTime\s+\S+;", "endTime 0.0005137;")
    assert main(["run", "-case", str(case)]) == 0
    edit(case, r"endTime\s+\S+;", "endTime 0.001;")
    assert "no step of deltaT = 2e-05 s does. Restore its endTime" in message(case, capsys, "-resume")


def test_another_write_interval_changes_no_particle(stopped, truth):
    edit(stopped, r"writeInterval\s+\S+;", "writeInterval 0.002;")
    go_on(stopped)
    assert results(stopped)["fates.csv"] == truth["fates.csv"]


def test_finished_run_writes_its_tables_again(stopped, truth):
    go_on(stopped)
    (stopped / "postProcessing/softCloud/fates.csv").unlink()
    go_on(stopped)
    assert results(stopped) == truth


def test_unfinished_run_is_replaced_on_request_only(stopped, truth, capsys):
    before = results(stopped)
    text = message(stopped, capsys)
    for words in ("unfinished run", "0.003 s", "-resume", "-overwrite", "startFrom latestTime"):
        assert words in text
    assert results(stopped) == before
    assert main(["run", "-case", str(stopped), "-overwrite"]) == 0
    assert results(stopped) == truth
    assert main(["run", "-case", str(stopped)]) == 0


def test_start_from_start_time_replaces_an_unfinished_run(stopped, truth):
    edit(stopped, r"endTime\s", "startFrom startTime; endTime ")
    assert main(["run", "-case", str(stopped)]) == 0
    assert results(stopped) == truth


def test_without_a_checkpoint_a_run_begins_at_the_start(case, truth, capsys):
    go_on(case)
    assert "No checkpoint in" in capsys.readouterr().out
    assert results(case) == truth


def hasten(case: Path) -> None:
    """Let the flow be faster by a thousandth, in the cells."""
    file = time_folder(case) / "U.gz"
    text = gzip.decompress(file.read_bytes())
    count = re.search(rb"internalField\s+nonuniform List<vector>\s+(\d+)\s*\(", text)
    n, start = 3 * int(count[1]), count.end()
    values = 1.001 * np.frombuffer(text, dtype=float, count=n, offset=start)
    file.write_bytes(gzip.compress(text[:start] + values.tobytes() + text[start + 8 * n :]))


CHANGES: dict[str, tuple[Callable[[Path], object], str]] = {
    "stiffness": (lambda c: edit(c, r"Ca 0\.25;", "Ca 0.3;"), "injections/Ca025/solid/shearModulus was"),
    "limits": (
        lambda c: edit(c, r"deltaT\s", "maxStretch 50; deltaT "),
        r"else: limits/maxStretch was 100\.0, is 50\.0\. Undo",
    ),
    "surroundings": (
        lambda c: edit(c, r"^(\s*)gravity;", r"\1gravity; faxenCorrection;"),
        r"else: surroundings/faxenCorrection was absent, is FaxenCorrection\. Undo",
    ),
    "force": (
        lambda c: edit(c, r"^(\s*)gravity;", r"\1gravity; virtualMass { Cvm 0.4; }"),
        r"else: forces/virtualMass was absent, is VirtualMass; forces/virtualMass/Cvm was absent, is 0\.4; ",
    ),
    "wall": (lambda c: edit(c, r"type(\s+)stick", r"type\1escape"), "patch wall was Stick"),
    "two places exchanged": (
        lambda c: edit(c, r"(\(0 -0\.00165 0\)) (\([^)]+\))", r"\2 \1", "constant/softCloudPositions"),
        "particles at the start/x has changed",
    ),
    "flow": (hasten, "flow/nodes has changed"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_changed_physics_is_refused_by_name(name, stopped, capsys, monkeypatch):
    # Nothing is advanced.
    monkeypatch.setattr("foamprb.run.loop.compile_run", lambda *_, **__: None)
    change, expected = CHANGES[name]
    before = results(stopped)
    change(stopped)
    text = message(stopped, capsys, "-resume")
    assert re.search(expected, text), text
    assert "-overwrite" in text
    assert results(stopped) == before


def test_fingerprint_tolerates_round_off_and_tells_the_order_of_rows():
    random = np.random.default_rng(0)
    values = random.normal(size=(1000, 3))
    values[7, 1] = np.nan

    def sums(*parts):
        numbers = np.split(np.arange(1000), np.cumsum([len(part) for part in parts])[:-1])
        return restart._means(sum(map(restart._totals, parts, numbers)), 1000)

    assert restart._agree(sums(values), sums(values * (1.0 + 1e-15)))
    assert restart._agree(sums(values), sums(values[:300], values[300:]))
    assert not restart._agree(sums(values), sums(values * (1.0 + 1e-8)))
    assert not restart._agree(sums(values), sums(values[::-1]))


def test_results_that_are_not_the_runs_are_refused(stopped, capsys):
    folder = stopped / "postProcessing/softCloud"
    pvd = (folder / "softCloud.pvd").read_text()
    (folder / "softCloud.pvd").write_text(pvd.replace('timestep="0.002"', 'timestep="0.0025"'))
    assert "lists other times" in message(stopped, capsys, "-resume")
    (folder / "softCloud.pvd").write_text(pvd)
    snapshot = folder / "softCloud_000001.vtp"
    snapshot.unlink()
    assert "softCloud_000001.vtp is missing" in message(stopped, capsys, "-resume")
    (folder / "softCloud.pvd").unlink()
    assert "softCloud_000001.vtp is missing" in message(stopped, capsys, "-resume")


def test_a_damaged_checkpoint_costs_one_write_interval(stopped, truth, capsys):
    folder = stopped / "postProcessing/softCloud/checkpoint"
    last = folder / "0.003.npz"
    last.write_bytes(last.read_bytes()[:-1000])
    go_on(stopped)
    out = capsys.readouterr().out
    assert re.search(r"Warning : .*0\.003\.npz is damaged", out)
    assert "Continuing from the checkpoint at t = 0.002 s" in out
    assert results(stopped) == truth


def test_an_unfinished_table_of_fates_is_removed(stopped, truth):
    """No manifest lists it yet."""
    (stopped / "postProcessing/softCloud/.fates.csv.0123abcd.tmp").touch()
    go_on(stopped)
    assert results(stopped) == truth


@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGINT, 130), (signal.SIGHUP, 129), (signal.SIGXCPU, 152)]
)
def test_a_signal_leaves_a_checkpoint_and_says_how_to_go_on(number, status, case, truth, capsys, monkeypatch):
    before = {n: signal.getsignal(n) for n in (signal.SIGINT, signal.SIGHUP, signal.SIGXCPU)}
    submit = Writer.submit

    writes = itertools.count(1)

    def interrupted(writer: Writer, write: Callable[[], object]) -> None:
        if next(writes) == 2:
            signal.raise_signal(number)
        submit(writer, write)

    monkeypatch.setattr(Writer, "submit", interrupted)
    assert main(["run", "-case", str(case)]) == status
    err = capsys.readouterr().err
    assert err == "--> foamprb stopped at t = 0.002 s. To continue from the last checkpoint, add -resume.\n"
    assert {n: signal.getsignal(n) for n in before} == before
    go_on(case)
    assert results(case) == truth


# The first manifest, cloud, list and checkpoint, some between, and the manifest and the table at the end.
@pytest.mark.parametrize("nth", [1, 5, 8, 26, 49, 51])
def test_a_full_disk_has_one_message_and_the_run_goes_on(nth, case, truth, capsys, monkeypatch):
    flush, calls = atomic._flush, iter(range(1, 1000))

    def full(path: Path, flags: int) -> None:
        if next(calls) == nth:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        flush(path, flags)

    monkeypatch.setattr(atomic, "_flush", full)
    text = message(case, capsys)
    assert re.search(r"No space left on device: '.*/softCloud/.*'", text)
    found = results_so_far(case)
    assert ("-resume" in text) == any(name.startswith("checkpoint/") for name in found)
    listed = json.loads(found.pop("manifest.json", b'{"files": []}'))["files"]
    assert found.keys() <= {*listed}
    final = {name for name in found if not name.endswith((".npz", ".pvd", "run.json"))}
    assert all(truth[name] == found[name] for name in final)
    monkeypatch.undo()
    go_on(case)
    assert results(case) == truth


def results_so_far(case: Path) -> dict[str, bytes]:
    folder = case / "postProcessing/softCloud"
    return {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*") if f.is_file()}


def test_too_many_failures_end_the_run_with_its_results(case, capsys):
    edit(case, r"deltaT\s+\S+;", "deltaT 0.001;")
    edit(case, r"endTime\s+\S+;", f"endTime {END};")
    assert "maxFailedFraction 0.5 allows; " in message(case, capsys)
    edit(case, r"endTime\s", "maxFailedFraction 0.1;\n endTime ")
    text = message(case, capsys, "-overwrite")
    assert re.search(
        r"allows; \d+ of them: its volume ratio J left \[1/8, 8\] \(Δt beyond stability\?\)\.", text
    )
    failed, injected = map(int, re.search(r"(\d+) of (\d+) particles have failed", text).groups())
    assert failed > 0.1 * injected
    folder = case / "postProcessing/softCloud"
    assert len((folder / "failed.csv").read_text().splitlines()) == failed + 1
    assert (folder / "fates.csv").exists()
    # Still too many.
    assert text.split(";")[0] == message(case, capsys, "-resume").split(";")[0]
    edit(case, r"maxFailedFraction\s+\S+;", "maxFailedFraction 1;")
    go_on(case)
    allowed = results(case)
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert results(case) == allowed


def test_mistakes_in_the_entries(case, capsys):
    edit(case, r"endTime\s", "startFrom lastTime; endTime ")
    assert "Did you mean 'latestTime'?" in message(case, capsys)
    edit(case, r"startFrom lastTime;", "startTime 0.1;")
    assert "a cloud begins at time 0" in message(case, capsys)
    edit(case, r"startTime 0\.1;", "maxFailedFraction 2;")
    assert "a number from 0 to 1" in message(case, capsys)
    assert main(["run", "-case", str(case), "-resume", "-overwrite"]) == 2
    assert "not allowed with" in capsys.readouterr().err


def test_killed_runs_end_as_if_they_had_never_been(tmp_path):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])}
    words = [sys.executable, str(KILL_TEST), "-kills", "3", "-seed", "5"]
    done = subprocess.run(words, capture_output=True, text=True, env=environment, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"^([3-9]|1\d) interruptions", done.stdout, re.MULTILINE)


def test_recovered_walks_before_an_interruption_are_counted(case, capsys):
    logging.getLogger("foamprb").handlers.clear()
    job = prepare(case, threads=1)
    job.cloud.recovered = 5
    with pytest.raises(RunStopped):
        execute(job, stop=lambda: job.cloud.time > 0.99 * EARLIER)
    go_on(case)
    assert re.search(r"relocated by tree search +5\n", capsys.readouterr().out)


def test_a_finished_run_is_left_as_it_is(finished, capsys):
    folder = finished / "postProcessing/softCloud"
    before = {file: file.stat().st_mtime_ns for file in folder.rglob("*") if file.is_file()}
    assert main(["run", "-case", str(finished), "-resume"]) == 0
    assert "The run has ended at t = 0.006 s: there is nothing to continue.\n" in capsys.readouterr().out
    assert {file: file.stat().st_mtime_ns for file in folder.rglob("*") if file.is_file()} == before
