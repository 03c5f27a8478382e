"""foamprb beside icoFoam, which removes its times."""

from __future__ import annotations

import re
import shutil
import subprocess
import threading

import pytest
from foam_tutorials import tutorial
from foam_writer import header
from transient_case import SETTINGS

from foamprb.cli import main

pytestmark = pytest.mark.openfoam

CHANGES = {
    "system/blockMeshDict": [(r"\(20 20 1\)", "(60 60 1)")],
    "system/controlDict": [
        (r"endTime( +)0.5", "endTime 0.24"), (r"deltaT .*;", "deltaT 0.001;"),
        (r"writeInterval .*;", "writeInterval 40;"), (r"purgeWrite .*;", "purgeWrite 0;"),
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


def solve(case):
    subprocess.run("icoFoam", cwd=case, check=True, stdout=subprocess.DEVNULL)


def test_run_beside_a_solver_is_that_after_it(case):
    whole = shutil.copytree(case, case.parent / "whole")
    solve(whole)
    assert main(["run", "-case", str(whole)]) == 0
    solver = threading.Thread(target=solve, args=(case,))
    solver.start()
    assert main(["run", "-case", str(case), "-follow"]) == 0
    solver.join()
    found, expected = (folder / "postProcessing/softCloud/fates.csv" for folder in (case, whole))
    assert found.read_bytes() == expected.read_bytes()
