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


def test_pores_open_next_to_the_wall_only(scratch: Path) -> None:
    """A power law has nearly a million times the damage."""
    pictures = execute(ROOT / "docs/tutorials/blood.md", scratch)
    assert [picture.name for picture in pictures] == ["blood.png"]
    run = foamprb.open_run(".")
    at_once, later = (run.table(f"{name}/haemolysis")["haemolysis"] for name in ("powerLaw", "pores"))
    assert 0.0 < np.mean(later > 0.0) < 0.02
    assert np.min(at_once) > 0.0
    assert 1e4 < np.mean(at_once) / np.mean(later) < 1e7


def test_cells_that_the_rotor_shears_are_damaged(scratch: Path) -> None:
    """Nobody sticks or is lost, and blades at 4.2 m/s shear the fluid by 1e4 1/s and more."""
    # Films have tests of their own.
    pictures = execute(ROOT / "docs/tutorials/rotor.md", scratch, ("foamprb view -film",))
    assert [picture.name for picture in pictures] == ["rotor.png"]
    run = foamprb.open_run(".")
    fates = run.table()
    assert (fates["fate"] == "active").all()
    assert 50.0 < np.max(fates["maxShearStress"]) < 500.0
    assert 0.05 < np.quantile(fates["maxD"], 0.99) < 0.3
    near = np.hypot(fates["x0"], fates["y0"]) < 1.2e-3
    for name in ("powerLaw", "pores"):
        damage = run.table(f"{name}/haemolysis")["haemolysis"]
        assert np.mean(damage[near]) > 5.0 * np.mean(damage[~near])
