"""run.json: what was run, as it was."""

from __future__ import annotations

import json
import math
import re
import shutil

import pytest
from paths import PIPE

from foamprb import prepare
from foamprb.cli import main
from foamprb.flow.base import Caveat
from foamprb.run import job as run_job
from foamprb.run import log as run_log
from foamprb.view.results import open_run


@pytest.fixture
def case(tmp_path):
    shutil.copytree(PIPE, tmp_path / "pipe", ignore=shutil.ignore_patterns("postProcessing"))
    change(tmp_path / "pipe", "endTime", "0.002")
    change(tmp_path / "pipe", "writeInterval", "0.001")
    return tmp_path / "pipe"


def change(case, entry, value):
    file = case / "constant/softCloudProperties"
    file.write_text(re.sub(rf"({entry}\s+)[^;]+;", rf"\g<1>{value};", file.read_text(), count=1))


def record(case):
    text = (case / "postProcessing/softCloud/run.json").read_text()
    # Strict: no NaN.
    return json.loads(text, parse_constant=lambda word: pytest.fail(word))


def test_record_describes_a_run_and_its_continuation(case, capsys):
    assert main(["run", "-case", str(case)]) == 0
    first = record(case)
    assert first["settings"]["text"] == (case / "constant/softCloudProperties").read_text()
    assert first["time"]["end"] == 0.002
    assert first["fluid"]["rho"] == 1.208
    assert {patch["name"]: patch["interaction"] for patch in first["patches"]}["wall"] == "stick"
    outlet = next(patch for patch in first["patches"] if patch["name"] == "outlet")
    assert outlet["area"] == pytest.approx(math.pi * 2.1e-3**2, rel=0.02)
    assert outlet["centre"] == pytest.approx([0.11, 0.0, 0.0], abs=1e-5)
    assert first["injections"][0]["particles"] > 0
    assert first["injections"][0]["shear_rate"][0] <= first["injections"][0]["shear_rate"][1]
    assert first["mesh"]["cells"] > 1000
    change(case, "endTime", "0.003")
    assert main(["run", "-case", str(case), "-resume"]) == 0
    change(case, "endTime", "0.002")
    assert main(["run", "-case", str(case), "-resume"]) == 1
    assert "endTime is 0.002. Allowed: 0.003 or more; or start over" in capsys.readouterr().err
    second = record(case)
    assert second["time"]["end"] == 0.003
    assert "0.003" in second["settings"]["text"]
    # Ranges are those of the bodies that appear before the end, which are more.
    for before, after in zip(first["injections"], second["injections"], strict=True):
        assert before["particles"] == after["particles"]
        assert before["capillary"][0] >= after["capillary"][0]
        assert before["capillary"][1] <= after["capillary"][1]
    # The pipe lies along x.
    assert second["flow"]["direction"] == pytest.approx([1.0, 0.0, 0.0], abs=1e-6)
    assert open_run(case).record == second


def test_the_record_has_every_model_and_warning_of_the_log(case, capsys):
    file = case / "constant/softCloudProperties"
    models = "wallLift; faxenCorrection; BrownianMotion { T 30000; }"
    text = file.read_text().replace("gravity;", f"gravity; {models}", 1)
    # With the quadratic mode, for the loop of a test of restarts.
    file.write_text(text.replace("tractionModel", "shapeModel quadratic; tractionModel", 1))
    change(case, "shape", "stokes")
    change(case, "deltaT", "2e-4")
    assert main(["run", "-case", str(case)]) == 0
    log, found = capsys.readouterr().out, record(case)
    assert list(found["models"]["surroundings"]) == ["faxenCorrection", "wallLift", "BrownianMotion"]
    for name, entries in found["models"]["surroundings"].items():
        assert f"{name} {entries}".rstrip() in log
    for note in found["models"]["notes"]:
        assert f"    {note}" in log
    warned = [line.partition(" : ")[2] for line in log.splitlines() if "foamprb Warning" in line]
    assert found["warnings"]
    at_start = prepare(case).description["warnings"]
    assert warned[: len(at_start)] == found["warnings"][: len(at_start)] == at_start
    # Of the end of the run.
    assert {*found["warnings"]} <= {*warned}


def test_caveat_of_the_flow_is_logged_once_and_recorded(case, monkeypatch):
    read, logged = run_job.read_flow, []

    def read_doubtful(*arguments):
        flow = read(*arguments)
        flow.notes = (*flow.notes, Caveat("The flow is doubtful."))
        return flow

    monkeypatch.setattr(run_job, "read_flow", read_doubtful)
    for module in (run_job, run_log):
        monkeypatch.setattr(module.log, "warning", lambda text, *words: logged.append(text % words))
    job = prepare(case)
    assert logged == ["The flow is doubtful."]
    run_log.log_description(job)
    assert logged.count("The flow is doubtful.") == 1
    assert job.description["warnings"].count("The flow is doubtful.") == 1


def test_jumps_of_the_gradient_are_logged_where_there_are_any(case, caplog):
    """A flow between mirrors has no walls."""
    job = prepare(case)
    for jumps, text in (((0.19, None), "19 % (median)"), ((0.19, 0.08), "19 % (median), 8 % at walls")):
        job.description["flow"]["gradientJump"] = jumps
        caplog.clear()
        with caplog.at_level("INFO", "foamprb"):
            run_log.log_description(job)
        assert f"    grad U between cells     {text}" in caplog.messages
