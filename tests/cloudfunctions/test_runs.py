"""Cloud functions in runs of the pipe case."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
import pyvista
from observing import column, table
from paths import PIPE
from pipe_case import copy_of_pipe, edit

from foamprb import execute, open_run, prepare
from foamprb.cli import main
from foamprb.errors import RunStopped
from foamprb.results.folder import fault_of_function

BLOCK = """cloudFunctions
{
    tracks { type particleTracks; trackInterval 100; maxSamples 100; }
    impacts { type patchPostProcessing; patches (wall outlet); }
    plane { type particleCollector; mode plane; origin (0.02 0 0); normal (1 0 0); }
    spread { type particleHistogram; fields (shearExposure); nBins 5; }
}
"""


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """The pipe, with and without functions."""
    cases = []
    for name, block in (("plain", "cloudFunctions\n{}\n"), ("observed", BLOCK)):
        case = tmp_path_factory.mktemp(name) / "pipe"
        shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("postProcessing", "log.*"))
        path = case / "constant/softCloudProperties"
        text = path.read_text().replace("cloudFunctions\n{}\n", block)
        text = re.sub(r"endTime\s+\S+;", "endTime 0.16;", text)
        path.write_text(re.sub(r"writeInterval\s+\S+;", "writeInterval 0.08;", text))
        assert main(["run", "-case", str(case)]) == 0
        cases.append(case / "postProcessing/softCloud")
    return cases


def test_a_stopped_run_goes_on_with_what_its_functions_saw(tmp_path, monkeypatch):
    """Stopped between two looks and between two writings: the same files as of a run never stopped."""
    block = BLOCK.replace("0.02 0 0", "0.001 0 0")
    results = []
    for name in ("whole", "parts"):
        case = copy_of_pipe(tmp_path / name)
        edit(case, r"cloudFunctions\s*\{\}", block)
        edit(case, r"endTime\s+\S+;", "endTime 0.012;")
        edit(case, r"writeInterval\s+\S+;", "writeInterval 0.004;")
        if name == "parts":
            monkeypatch.setattr("foamprb.run.loop.MOST_STEPS", 100)
            job = prepare(case, threads=1)
            with pytest.raises(RunStopped):
                execute(job, stop=lambda job=job: job.cloud.step > 261)
            assert 261 < job.cloud.step < 270
        assert main(["run", "-case", str(case), "-resume"]) == 0
        folder = case / "postProcessing/softCloud"
        found = [file for file in folder.rglob("*.*") if file.suffix in (".csv", ".vtp")]
        results.append({str(file.relative_to(folder)): file.read_bytes() for file in found})
    assert {"plane/crossings.csv", "spread/exposure.csv", "fates.csv", "tracks/tracks.vtp"} <= {*results[0]}
    assert len(open_run(case).table("plane/crossings")["id"]) > 0
    assert results[0] == results[1]


def test_looking_changes_nothing(cases):
    plain, observed = cases
    assert (plain / "fates.csv").read_bytes() == (observed / "fates.csv").read_bytes()


def test_every_function_writes(cases):
    _, observed = cases
    fates = table(observed / "fates.csv")
    for patch, fate in (("wall", "stuck"), ("outlet", "escaped")):
        expected = [row for row in fates if row["patch"] == patch and row["fate"] == fate]
        rows = {row["id"]: row for row in table(observed / f"impacts/{patch}.csv")}
        assert rows.keys() == {row["id"] for row in expected}
        assert len(rows) > 0
        for row in expected:
            assert [rows[row["id"]][c] for c in "abcD"] == [row[c] for c in "abcD"]
        angles = column(rows.values(), "impactAngle")
        assert (angles >= 0.0).all()
        assert (angles < 90.0).all()
    past = [row for row in fates if float(row["x1"]) >= 0.02]
    assert {row["id"] for row in table(observed / "plane/crossings.csv")} == {row["id"] for row in past}
    assert len(table(observed / "spread/shearExposure.csv")) == 5
    assert pyvista.read(observed / "tracks/tracks.vtp").n_lines == len(fates)


def test_the_facets_normal_is_that_of_the_pipe(cases):
    """On the mesh, to the angle between a facet and the circle."""
    rows = table(cases[1] / "impacts/wall.csv")
    radial = np.stack([np.zeros(len(rows)), column(rows, "y"), column(rows, "z")], axis=1)
    radial /= np.linalg.norm(radial, axis=1)[:, None]
    v = np.stack([column(rows, c) for c in ("Ux", "Uy", "Uz")], axis=1)
    angle = np.degrees(np.arccos(np.einsum("ni,ni->n", v, radial) / np.linalg.norm(v, axis=1)))
    np.testing.assert_allclose(column(rows, "impactAngle"), angle, atol=6.0)


def test_no_function_may_have_the_name_of_a_result(cases):
    plain, _ = cases
    written = [path.name for path in plain.iterdir()]
    assert len(written) > 4
    assert all(fault_of_function(name, "softCloud") for name in written)
