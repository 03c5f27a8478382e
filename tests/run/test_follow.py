"""Runs beside a solver: its times appear while the run waits for them."""

from __future__ import annotations

import math
import shutil
from types import SimpleNamespace

import pytest
from foam_writer import header
from transient_case import SCALE, write_transient_case

from foamprb.cli import main
from foamprb.errors import RunStopped
from foamprb.flow.read import follow as links
from foamprb.run import follow
from foamprb.run.follow import Follow
from foamprb.run.job import prepare
from foamprb.run.loop import execute

CONTROL = "deltaT 0.1; endTime 1.5; writeControl runTime; writeInterval 1;"
END = "\n// ***** //\n"


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A case whose solver has ended, and the results of a run after it."""
    case = write_transient_case(tmp_path_factory.mktemp("followed") / "case")
    (case / "system/controlDict").write_text(header("dictionary", "controlDict") + CONTROL)
    for name in SCALE:
        for field in ("U", "p"):
            with (case / name / field).open("a") as file:
                file.write(END)
    whole = shutil.copytree(case, case.parent / "whole")
    assert main(["run", "-case", str(whole)]) == 0
    return case, whole


class Solver:
    """Makes the folder of a time, or writes its fields, whenever a run waits."""

    def __init__(self, source, case, monkeypatch):
        self.source, self.case, self.monkeypatch = source, case, monkeypatch
        self.steps = iter([(name, part) for name in list(SCALE)[1:] for part in (1, 2)])
        self.waits = 0
        self.now = 0.0
        clock = SimpleNamespace(monotonic=lambda: self.now, sleep=self.wait)
        monkeypatch.setattr(follow, "clock", clock)

    def wait(self, _seconds):
        self.waits += 1
        self.now += 10.0
        self.write()

    def write(self):
        name, part = next(self.steps, ("", 0))
        if name:
            folder = self.case / name
            folder.mkdir(exist_ok=True)
            for field in ("U", "p") if part == 2 else ():
                shutil.copy(self.source / name / field, folder / field)
            self.monkeypatch.setattr(links, "_QUIET", 0.0 if part == 2 else math.inf)


@pytest.fixture
def case(written, tmp_path):
    case = shutil.copytree(written[0], tmp_path / "case")
    for name in list(SCALE)[1:]:
        shutil.rmtree(case / name)
    return case


def files(case):
    folder = case / "postProcessing/softCloud"
    return {
        path.name: path.read_bytes() for path in folder.iterdir() if path.suffix in (".csv", ".vtp", ".pvd")
    }


def test_run_beside_a_solver_is_that_after_it(written, case, monkeypatch):
    solver = Solver(written[0], case, monkeypatch)
    job = prepare(case, follow=Follow())
    # The time 0.5 is complete when the folder of 1.5 exists.
    assert solver.waits == 3
    execute(job)
    assert solver.waits == 4
    assert files(case) == files(written[1])


def test_log_has_few_lines_of_a_long_wait(monkeypatch, caplog):
    caplog.set_level("INFO", "foamprb")
    case = SimpleNamespace(times=["0"], ended=False, look=lambda: None)
    clock = SimpleNamespace(now=0.0)

    def sleep(seconds):
        clock.now += seconds
        if clock.now > 1e4:
            case.times, case.ended = ["0", "0.5"], True

    monkeypatch.setattr(follow, "clock", SimpleNamespace(monotonic=lambda: clock.now, sleep=sleep))
    assert follow.wait(case, lambda: False, lambda: False, math.inf, "a time after 0 s")
    assert not follow.wait(
        SimpleNamespace(times=[], ended=False, look=lambda: None), bool, lambda: True, 1.0, ""
    )
    lines = [record.message for record in caplog.records]
    assert lines == [*["Waiting for a time after 0 s"] * 12, "The flow has come to 0.5 s"]


def test_run_ends_with_its_solver(written, case, monkeypatch, caplog):
    Solver(written[0], case, monkeypatch)
    longer = {"solution/endTime": 9.0, "solution/writeInterval": 0.3}
    execute(prepare(case, follow=Follow(), overrides=longer))
    assert any("the solver has ended at 1.5 s, before endTime, 9 s" in r.message for r in caplog.records)
    found, whole = files(case), case.parent / "whole"
    shutil.copytree(written[0], whole)
    execute(prepare(whole, overrides=longer | {"solution/endTime": 1.5}))
    assert found == files(whole)


def test_stopped_run_continues(written, case, monkeypatch):
    solver = Solver(written[0], case, monkeypatch)
    job = prepare(case, follow=Follow())
    with pytest.raises(RunStopped, match=r"stopped at t = 0\.5 s\. To continue"):
        # The solver has only 1.5 to complete.
        execute(job, stop=lambda: job.cloud.step == 10)
    for _ in range(3):
        solver.write()
    assert main(["run", "-case", str(case), "-follow", "-resume"]) == 0
    assert files(case) == files(written[1])


def test_impatient_run_stops_with_a_checkpoint(written, case, monkeypatch):
    solver = Solver(written[0], case, monkeypatch)
    job = prepare(case, follow=Follow(patience=60.0))
    solver.steps = iter(())
    with pytest.raises(RunStopped, match=r"stopped at t = 0\.5 s: no new time of the flow for 60 s"):
        execute(job)
    solver.steps = iter([("1.5", 2)])
    assert main(["run", "-case", str(case), "-follow", "-resume"]) == 0
    assert files(case) == files(written[1])


def test_injection_by_flux_waits_for_its_times(written, case, monkeypatch):
    settings = case / "constant/softCloudProperties"
    start = 'type manualInjection; positionsFile "positions"; SOI 0.3;'
    flux = "type patchFlowRateInjection; patch floor; parcelConcentration 4000; duration 0.9;"
    for folder in (case, shutil.copytree(written[0], case.parent / "whole")):
        settings = folder / "constant/softCloudProperties"
        settings.write_text(settings.read_text().replace(start, flux))
    solver = Solver(written[0], case, monkeypatch)
    found = prepare(case, follow=Follow()).cloud.particles
    expected = prepare(case.parent / "whole").cloud.particles
    assert solver.waits == 4
    assert found.size == expected.size > 10
    assert (found.t0 == expected.t0).all()
    assert found.t0.max() > 0.5


def test_compressible_flow_is_used_up_to_the_time_before_the_last(written, case, monkeypatch):
    Solver(written[0], case, monkeypatch)
    (case / "constant/thermophysicalProperties").write_text(
        header("dictionary", "thermophysicalProperties") + "thermoType { type hePsiThermo; }"
    )
    following = prepare(case, follow=Follow()).following
    assert following is not None
    assert (following.ended, following.flow.times) == (True, (0.0, 0.5, 1.5))
    following.ended = False
    following._case.ended = False
    following._extend()
    assert (following.flow.times, following.flow.span) == ((0.0, 0.5), (0.0, 0.5))


MISTAKES = {
    "steady flow": (["-follow", "-dict", "steady"], "-follow goes through a flow that changes in time"),
    "plan": (["-follow", "-dry-run"], "-dry-run does not go with -follow"),
    "patience alone": (["-patience", "3"], "-patience goes with -follow"),
    "no patience": (["-follow", "-patience", "0"], "-patience 0: a number of seconds > 0"),
    "single time": (["-follow", "-latestTime"], "'latestTime' is no range of times"),
    "one time": (["-follow", "-time", ":0.2"], "has ended (system/controlDict) with 1 time"),
    "a time without a velocity": (
        ["-follow", "-velocity", "V"],
        "goes through all times, but V at 0.5 is missing",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_have_one_message(mistake, written, tmp_path, capsys):
    case = shutil.copytree(written[0], tmp_path / "case")
    text = (case / "constant/softCloudProperties").read_text()
    (case / "steady").write_text(text.replace("transient yes;", ""))
    for time in ("0", "1.5"):
        shutil.copy(case / time / "U", case / time / "V")
    options, words = MISTAKES[mistake]
    usage = mistake in ("plan", "patience alone")
    assert main(["run", "-case", str(case), *options]) == (2 if usage else 1)
    error = capsys.readouterr().err
    assert words in error
    assert len(error.splitlines()) == 1
