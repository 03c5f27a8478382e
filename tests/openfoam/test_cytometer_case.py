"""The cytometer run live, as its page says: outlines of cells, against finite elements."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
from paths import ROOT
from validation.quadratic import ELEMENTS

import foamprb
from foamprb.cli import main

pytestmark = pytest.mark.openfoam


@pytest.fixture(scope="module")
def seen(tmp_path_factory):
    """The table of the camera."""
    case = tmp_path_factory.mktemp("live") / "cytometer"
    for name in ("0", "constant", "system"):
        shutil.copytree(ROOT / "cases/cytometer" / name, case / name)
    for program in ("blockMesh", "simpleFoam"):
        subprocess.run([program, "-case", case], check=True, capture_output=True)
    assert main(["run", "-case", str(case)]) == 0
    return foamprb.open_run(case).table("camera/cytometry")


def test_outlines_are_those_of_finite_elements(seen):
    """With default settings, in the solver's flow, within 5 % up to a deformation of 0.05."""
    area, deformation, _ = np.array(ELEMENTS[:12]).T
    order = np.argsort(seen["id"])
    assert len(order) == 12
    assert 1e12 * np.asarray(seen["area"])[order] == pytest.approx(area, rel=2e-3)
    assert np.asarray(seen["deformation"])[order] == pytest.approx(deformation, rel=0.05)


def test_the_walls_act_on_all_cells(seen):
    assert (np.asarray(seen["channel"]) == 1).all()
    assert (np.asarray(seen["shiftx"]) > 0.0).all()
