"""A run with eddies: what it says, and that it goes on as if it had not been interrupted."""

from __future__ import annotations

import pytest
from foam_writer import put_scalar
from pipe_case import edit, fates, message, time_folder, with_eddies

from foamprb.cli import main


@pytest.fixture
def case(tmp_path):
    return with_eddies(tmp_path)


def test_log_names_the_dispersion_model_and_its_limits(case, capsys):
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    said = capsys.readouterr()
    assert "Selecting dispersionModel stochasticDispersionRAS (seed 1, fluctuations normal," in said.out
    # √(2k/3) and k/ε.
    assert "fluctuation [m/s]        0.00816 to 0.00816, median 0.00816" in said.out
    assert "eddy time [s]            0.002 to 0.002, median 0.002" in said.out
    assert "eddies move particles but do not deform them. The shear rate of the smallest" in said.out


def test_too_long_a_step_is_warned_of(case, capsys):
    put_scalar(time_folder(case), "epsilon", "0 2 -3", 50.0)
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    assert "deltaT is 10 of the eddies' median life of 2e-06 s" in capsys.readouterr().out


def test_without_epsilon_the_run_ends_with_one_message(case, capsys):
    (time_folder(case) / "epsilon").unlink()
    assert "/epsilon: no such field, and no omega. The dispersionModel needs" in message(case, capsys)


def test_a_run_that_goes_on_ends_as_one_that_was_not_interrupted(case, tmp_path):
    edit(case, r"shape\s+paper;", "shape stokes;")
    assert main(["run", "-case", str(case), "-threads", "2"]) == 0
    expected = fates(case)
    edit(case, r"endTime\s+\S+;", "endTime 0.003;")
    assert main(["run", "-case", str(case), "-overwrite", "-threads", "1"]) == 0
    edit(case, r"endTime\s+\S+;", "endTime 0.006; startFrom latestTime;")
    assert main(["run", "-case", str(case), "-threads", "1"]) == 0
    assert fates(case) == expected
    edit(case, "dispersionModel stochasticDispersionRAS;", "")
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert fates(case) != expected
