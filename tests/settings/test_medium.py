"""The medium of a case, read from Python."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from paths import ROOT

from foamprb import InputError, Medium, read_medium

CONSTANT = ROOT / "cases/pipe/constant"


@pytest.fixture
def case(tmp_path: Path) -> Path:
    for name in ("transportProperties", "g"):
        (tmp_path / "constant").mkdir(exist_ok=True)
        shutil.copy(CONSTANT / name, tmp_path / "constant")
    return tmp_path


def test_kinematic_viscosity_times_the_density(case: Path) -> None:
    assert read_medium(case, rho=1.208) == Medium(1.491e-5 * 1.208, 1.208, (0.0, -9.81, 0.0))
    with (case / "constant/transportProperties").open("a") as file:
        file.write("rho 1.2;\n")
    assert read_medium(case) == Medium(1.491e-5 * 1.2, 1.2, (0.0, -9.81, 0.0))


def test_without_a_file_there_is_no_gravity_and_what_is_given_goes_before(case: Path) -> None:
    (case / "constant/g").unlink()
    assert read_medium(case, rho=1000.0, mu=1e-3) == Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
    (case / "constant/transportProperties").unlink()
    assert read_medium(case, rho=1000.0, mu=1e-3) == Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))


def test_what_is_missing_is_said(case: Path) -> None:
    with pytest.raises(InputError, match="the density is not in the case; give rho"):
        read_medium(case)
    (case / "constant/transportProperties").unlink()
    with pytest.raises(InputError, match="transportProperties does not exist; give mu"):
        read_medium(case, rho=1.0)
