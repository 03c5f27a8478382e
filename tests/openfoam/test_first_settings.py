"""foamprb init on OpenFOAM's tutorials: what it writes passes a dry run as it is."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from foam_tutorials import tutorial

from foamprb.cli import main

pytestmark = pytest.mark.openfoam

LAGRANGIAN = "../lagrangian"
MESHERS = {
    "icoFoam/cavity/cavity": ["blockMesh"],
    "icoFoam/elbow": ["fluentMeshToFoam", "elbow.msh"],
    "simpleFoam/pitzDaily": ["blockMesh"],
    "nonNewtonianIcoFoam/offsetCylinder": ["blockMesh"],
    "boundaryFoam/boundaryLaunderSharma": ["blockMesh"],
    "pisoFoam/RAS/cavity": ["blockMesh"],
    "simpleFoam/pipeCyclic": ["blockMesh"],
    "pimpleFoam/laminar/planarContraction": ["blockMesh"],
    f"{LAGRANGIAN}/icoUncoupledKinematicParcelFoam/hopper/hopperInitialState": ["blockMesh"],
    f"{LAGRANGIAN}/MPPICFoam/injectionChannel": ["blockMesh"],
    f"{LAGRANGIAN}/DPMFoam/Goldschmidt": ["blockMesh"],
}


@pytest.mark.parametrize("name", MESHERS)
def test_a_tutorial_passes_a_dry_run(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = tutorial(f"incompressible/{name}", tmp_path / "case")
    if not (case / "0").exists():
        shutil.copytree(case / "0.orig", case / "0")
    subprocess.run(MESHERS[name], cwd=case, check=True, capture_output=True)
    velocity = "U.air" if (case / "0/U.air").exists() else "U"
    assert main(["init", "-case", str(case), "-velocity", velocity]) == 0
    assert main(["run", "-dry-run", "-case", str(case), "-velocity", velocity]) == 0
    said = capsys.readouterr().out
    assert "particles                0" not in said
    if LAGRANGIAN not in name:
        assert "Warning : injection model" not in said
