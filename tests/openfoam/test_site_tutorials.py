"""The tutorials of the site that need OpenFOAM, word for word; the site's build executes the others."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from figures.tutorials import ROOT, execute

import foamprb

pytestmark = pytest.mark.openfoam


@pytest.fixture
def scratch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    return tmp_path


def test_half_of_the_beads_turn(scratch: Path) -> None:
    # Reports have tests of their own, and take longest.
    left_out = ("foamprb report", "foamprb view -png beads.png")
    pictures = execute(ROOT / "docs/tutorials/openfoam.md", scratch, left_out)
    assert [picture.name for picture in pictures] == ["junction.png"]
    fates = foamprb.open_run(".").table()
    assert np.mean(fates["patch"] == "side") == pytest.approx(0.48, abs=0.03)
    assert np.mean(fates["patch"] == "straight") == pytest.approx(0.45, abs=0.03)


def test_cells_with_memory_are_damaged_less(scratch: Path) -> None:
    pictures = execute(ROOT / "docs/tutorials/blood.md", scratch)
    assert [picture.name for picture in pictures] == ["blood.png"]
    run = foamprb.open_run(".")
    at_once, later = (run.table(f"{name}/haemolysis")["haemolysis"] for name in ("stress", "cell"))
    assert 1e3 < np.min(at_once / later) < np.max(at_once / later) < 1e6
