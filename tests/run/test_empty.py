"""A cloud without particles is a run like any other: it ends, says so, and writes everything."""

from __future__ import annotations

import re

import pytest
import pyvista
from pipe_case import copy_of_pipe, edit, fates

from foamprb.cli import main
from foamprb.results.pvd import read_pvd

BLOCK = """cloudFunctions
{
    tracks { type particleTracks; trackInterval 100; maxSamples 100; }
    impacts { type patchPostProcessing; patches (wall outlet); }
    plane { type particleCollector; mode plane; origin (0.02 0 0); normal (1 0 0); }
    spread { type particleHistogram; nBins 5; }
    stress { type suspensionStress; }
}
"""
FILES = {
    "fates.csv", "tracks/tracks.vtp", "impacts/wall.csv", "impacts/outlet.csv", "plane/collector.csv",
    "plane/crossings.csv", "spread/exposure.csv", "spread/residenceTime.csv", "stress/suspensionStress.csv",
}  # fmt: skip


@pytest.fixture
def case(tmp_path):
    """The pipe with one injection model, all of whose positions lie outside."""
    case = copy_of_pipe(tmp_path)
    edit(case, r"injectionModels\s*\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}",
         "injectionModels { outside { $onePoint; ignoreOutOfBounds true; } }")  # fmt: skip
    edit(case, r"-0\.00165|-1\.65e-0?3", "-0.0022", "constant/softCloudPositions")
    edit(case, r"cloudFunctions\s*\{\}", BLOCK)
    edit(case, r"endTime\s+\S+;", "endTime 0.004;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.002;")
    return case


@pytest.mark.parametrize("shape", ["paper", "auto"])
def test_a_run_without_particles_writes_all_files(case, shape, capsys):
    edit(case, r"shape\s+paper;", f"shape {shape};")
    assert main(["run", "-case", str(case)]) == 0
    out = capsys.readouterr().out
    assert "1 of 1 positions lie outside the mesh and are left out" in out
    assert "Warning : there is no particle" in out
    assert re.search(r"^    injected +0$", out, re.MULTILINE)
    assert fates(case) == []
    folder = case / "postProcessing/softCloud"
    assert {str(file.relative_to(folder)) for file in folder.rglob("*.*")} >= FILES
    entries = read_pvd(folder / "softCloud.pvd")
    assert [pyvista.read(folder / entry.file).n_points for entry in entries] == [0] * len(entries)
    assert entries
    assert (folder / "spread/residenceTime.csv").read_text().startswith("lower,upper,outside\n")


def test_it_can_be_resumed(case, capsys):
    assert main(["run", "-case", str(case)]) == 0
    assert main(["run", "-case", str(case), "-resume"]) == 0
    assert "there is nothing to continue" in capsys.readouterr().out


def test_a_dry_run_says_so(case, capsys):
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    out = capsys.readouterr().out
    assert "Warning : there is no particle" in out
    assert "Dry run: 0 particles" in out
