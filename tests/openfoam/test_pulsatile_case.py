"""The pulsatile pipe run live on its coarse mesh: flow, particles, and the same in processor folders."""

from __future__ import annotations

import re
import shutil
import subprocess

import numpy as np
import pytest
from paths import ROOT, load

import foamprb
from foamprb.cli import main
from foamprb.flow.read.flows import read_flow, read_transient_flow
from foamprb.flow.read.source import FlowSource
from foamprb.results.pvd import read_pvd

pytestmark = pytest.mark.openfoam

CASE = ROOT / "cases/pulsatilePipe"
PARTS = FlowSource(decomposed=True)
MEAN_FLOW = 0.012
"""Error of the coarse mesh's mean flow, which carries the particles astray."""


check = load(CASE / "check.py")


@pytest.fixture(scope="module")
def exact(live):
    cloud = check.in_exact_flow(check.in_files(live))
    return cloud, check.track(cloud)


def test_the_flow_is_womersleys(live):
    errors = check.flow_errors(live)
    assert max(errors.u) < 0.008
    assert max(errors.slope) < 0.02


def test_particles_go_as_in_the_flow_in_closed_form(live, exact):
    cloud, track = exact
    moved = np.abs(cloud.particles.x - cloud.particles.x0).max()
    assert moved > 0.03
    x, F = check.distances(check.track(check.in_files(live)), track)
    assert x[1] < MEAN_FLOW * moved
    # A shear strain of two, in a flow whose mean shear is off by as much.
    assert F[0] < 4.0 * MEAN_FLOW


def test_the_error_of_few_times_is_of_second_order(live):
    # In every second and fourth of the times; not fewer, where the next order shows.
    tracks = [check.track(check.in_files(live, stride), periods=2) for stride in (1, 2, 4)]
    two, four = (check.distances(track, tracks[0])[1, 0] for track in tracks[1:])
    # (4² − 1²)/(2² − 1²) = 5
    assert four / two == pytest.approx(5.0, rel=0.1)


def test_the_case_runs_from_the_command_line(live):
    settings = live / "constant/softCloudProperties"
    settings.write_text(re.sub(r"writeInterval +\S+;", "writeInterval 1;", settings.read_text()))
    assert main(["run", "-case", str(live), "-time", "3:4"]) == 0
    folder = live / "postProcessing/softCloud"
    assert [entry.time for entry in read_pvd(folder / "softCloud.pvd")] == pytest.approx([3, 4, 5, 6, 7])


@pytest.fixture(scope="module", params=["ascii, compressed", "binary"])
def decomposed(live, request, tmp_path_factory):
    """Two times of the case, and the same cut into 2 × 2 × 1 parts."""
    case = tmp_path_factory.mktemp("decomposed") / "case"
    shutil.copytree(live, case, ignore=shutil.ignore_patterns("3.[1-9]*", "4", "postProcessing"))
    control = case / "system/controlDict"
    kind = "binary" if request.param == "binary" else "ascii"
    zipped = "on" if "compressed" in request.param else "off"
    text = re.sub(r"writeFormat .*;", f"writeFormat {kind};", control.read_text())
    control.write_text(re.sub(r"writeCompression .*;", f"writeCompression {zipped};", text))
    (case / "system/decomposeParDict").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
        "numberOfSubdomains 4; method hierarchical;\n"
        "hierarchicalCoeffs { n (2 2 1); delta 0.001; order xyz; }\n"
    )
    for command in ("foamFormatConvert", "decomposePar"):
        subprocess.run([command, "-case", case, "-time", "3:3.1"], check=True, capture_output=True)
    assert (case / "processor3/3.05" / ("U.gz" if zipped == "on" else "U")).is_file()
    return case


def test_a_decomposed_case_is_the_whole_to_the_last_bit(decomposed, random):
    whole, parts = foamprb.read_case(decomposed, 3.05), read_flow(decomposed, 3.05, PARTS)
    assert [patch.name for patch in parts.patches] == [patch.name for patch in whole.patches]
    for name, a, b in zip(whole.arrays()._fields, whole.arrays(1e-3), parts.arrays(1e-3), strict=True):
        np.testing.assert_array_equal(a, b, err_msg=name)
    series = [foamprb.read_series(decomposed, "3:3.1"), read_transient_flow(decomposed, "3:3.1", None, PARTS)]
    x = random.random((20, 3)) * [0.06, 1e-3, 1e-3]
    for t in (3.0, 3.03, 3.05, 3.075):
        u, l = (
            np.stack(values) for values in zip(*(s.sample(x, s.locate(x), t) for s in series), strict=True)
        )
        np.testing.assert_array_equal(u[0], u[1])
        np.testing.assert_array_equal(l[0], l[1])


def test_without_the_whole_the_parts_are_read_by_themselves(decomposed, tmp_path, capsys):
    case = tmp_path / "case"
    shutil.copytree(decomposed, case)
    for path in (case / "constant/polyMesh", case / "3", case / "3.05", case / "3.025", case / "3.075"):
        shutil.rmtree(path, ignore_errors=True)
    settings = case / "constant/softCloudProperties"
    settings.write_text(
        settings.read_text().replace("period          1;", "").replace("endTime         7", "endTime 3.05")
    )
    assert main(["run", "-case", str(case), "-time", "3:", "-dry-run"]) == 0
    assert "put together from 4 processor folders" in capsys.readouterr().out
    assert main(["info", "-case", str(case)]) == 0
    assert "hexahedron" in capsys.readouterr().out
