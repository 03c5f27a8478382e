"""Errors of fates: finer steps and other gradients of the flow, without any change of the results."""

from __future__ import annotations

import re

import numpy as np
import pytest
from pipe_case import edit, results, short_case

import foamprb
from foamprb.cli import main
from foamprb.run.errors_of_fates import estimate_errors


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """Bodies from almost rigid to very soft that fall to the wall, some in time to touch it."""
    case = short_case(tmp_path_factory.mktemp("errors"))
    edit(case, r"shape\s+paper;", "shape stokes;")
    places = " ".join(f"(0 {y:.9g} 0)" for y in np.linspace(-2.0875e-3, -2.0825e-3, 80))
    edit(case, r"\(0 -0\.00165 0\)", places, "constant/softCloudPositions")
    return case


def test_particles_whose_fates_are_uncertain_are_listed(case, capsys):
    """A larger gradient stretches soft bodies along the wall, so that they touch it later."""
    assert main(["run", "-case", str(case), "-threads", "2"]) == 0
    before = results(case)
    capsys.readouterr()
    assert main(["run", "-case", str(case), "-threads", "2", "-resume", "-estimateErrors"]) == 0
    assert results(case) == before
    text = capsys.readouterr().out.partition("Errors of the fates")[2]
    finer, larger, smaller = re.split(r"\n    (?=grad)", text)
    assert "half of tolerance: 0 of 705 particles end elsewhere, 0 % (0–0.542 %)" in finer
    for part, change in ((larger, "stuck: wall -> active"), (smaller, "active -> stuck: wall")):
        (count,) = re.findall(rf"\n {{8}}{change} +(\d+)\n", part)
        numbers = list(map(int, re.search(r"\n {8}particles (.*)", part)[1].split(",")))
        assert len(numbers) == int(count) > 0
        # The first 80 are almost rigid.
        assert min(numbers) >= 80


def test_paper_halves_its_steps(case, tmp_path):
    overrides = {"solution/integrationSchemes/shape": "paper"}
    job = foamprb.prepare(case, output=tmp_path, threads=2, overrides=overrides)
    foamprb.execute(job)
    finer = next(estimate_errors(job))
    assert finer.what == "half of deltaT"
    table = foamprb.open_run(case, results=tmp_path).table()
    words = [
        f"{fate}: {patch}" if patch else fate
        for fate, patch in zip(table["fate"], table["patch"], strict=True)
    ]
    assert finer.before.tolist() == words
    assert len(finer.changed) < 0.02 * len(words)


def test_no_errors_of_a_run_that_is_not_executed(case, capsys):
    assert main(["run", "-case", str(case), "-dry-run", "-estimateErrors"]) == 2
    assert "-estimateErrors does not go with -parallel or -dry-run" in capsys.readouterr().err
