"""foamprb beside icoFoam, which writes further times."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from foam_tutorials import tutorial
from foam_writer import header
from transient_case import SETTINGS

from foamprb.cli import main

pytestmark = pytest.mark.openfoam

DOCS = Path(__file__).parents[2] / "docs"

CHANGES = {
    "system/blockMeshDict": [(r"\(20 20 1\)", "(60 60 1)")],
    "system/controlDict": [
        (r"endTime( +)0.5", "endTime 0.24"), (r"deltaT .*;", "deltaT 0.001;"),
        (r"writeInterval .*;", "writeInterval 40;"),
    ],
}  # fmt: skip
RUN = [
    ("deltaT 0.05; endTime 1.2; writeInterval 0.4", "deltaT 0.002; endTime 0.24; writeInterval 0.08"),
    ("SOI 0.3", "SOI 0"),
    ("value 1e-3", "value 1e-5"),
]


@pytest.fixture
def case(tmp_path):
    case = tutorial("incompressible/icoFoam/cavity/cavity", tmp_path / "cavity")
    for name, changes in CHANGES.items():
        for pattern, text in changes:
            edit(case / name, pattern, text)
    text = header("dictionary", "softCloudProperties") + SETTINGS
    for old, new in RUN:
        assert old in text
        text = text.replace(old, new)
    (case / "constant/softCloudProperties").write_text(text)
    (case / "constant/positions").write_text("((0.05 0.05 0.005) (0.05 0.09 0.005) (0.02 0.07 0.004))")
    subprocess.run("blockMesh", cwd=case, check=True, capture_output=True)
    return case


def edit(file, pattern, text):
    edited, n = re.subn(pattern, text, file.read_text())
    assert n
    file.write_text(edited)


def documented_lines():
    """The loop of docs/transient.md, for icoFoam, with a run every second."""
    (lines,) = re.findall(r"```sh\n(track\(\).*?)```", (DOCS / "transient.md").read_text(), re.DOTALL)
    assert "sleep 60" in lines
    return lines.replace("pimpleFoam", "icoFoam").replace("sleep 60", "sleep 1")


def test_particles_tracked_beside_a_solver_end_as_after_it(case):
    foamprb = f'foamprb() {{ "{sys.executable}" -m foamprb "$@"; }}\n'
    done = subprocess.run(
        ["bash", "-c", foamprb + documented_lines()], cwd=case, check=True, capture_output=True, text=True
    )
    assert done.stdout.count("Continuing from the checkpoint") >= 1
    beside = (case / "postProcessing/softCloud/fates.csv").read_bytes()
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert (case / "postProcessing/softCloud/fates.csv").read_bytes() == beside
