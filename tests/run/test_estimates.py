"""``foamprb estimate``: a few numbers in, orders of magnitude out."""

from __future__ import annotations

import math

import pytest

from foamprb.body.estimate import SoftSphere, Surroundings, estimate
from foamprb.cli import main

NUMBERS = ("-d", "5e-6", "-rho0", "1050", "-mu", "1e-3", "-rhoInf", "1000")
NUMBERS += ("-shearRate", "100", "-residenceTime", "10")


def told(capsys, *more):
    assert main(["estimate", *NUMBERS, *more]) == 0
    found = {}
    for line in capsys.readouterr().out.splitlines():
        found[line[:22].strip()] = float(line[23:].split()[0])
    return found


def test_it_prints_what_the_formulas_give(capsys):
    found = told(capsys, "-Ca", "0.1", "-wallDistance", "20e-6")
    e = estimate(SoftSphere(5e-6, 1050.0, 1.0), Surroundings(1e-3, 1000.0, 100.0, 20e-6), 10.0)
    assert found["shear modulus [Pa]"] == pytest.approx(1.0)
    assert found["Reynolds number"] == pytest.approx(e.reynolds_number, rel=1e-3)
    assert found["Peclet number"] == pytest.approx(e.peclet_number, rel=1e-3)
    assert found["lift length [m]"] == pytest.approx(e.lift_length, rel=1e-3)
    assert found["settling length [m]"] == pytest.approx(e.settling_length, rel=1e-3)
    assert found["diffusion length [m]"] == pytest.approx(e.diffusion_length, rel=1e-3)
    turning = 1.380649e-23 * 293.15 / (8.0 * math.pi * 1e-3 * 2.5e-6**3)
    assert found["turning [1/s]"] == pytest.approx(turning, rel=1e-3)


def test_stiffness_may_be_the_modulus_and_no_wall_lifts_not(capsys):
    found = told(capsys, "-shearModulus", "2")
    assert found["capillary number"] == pytest.approx(0.05)
    assert found["lift speed [m/s]"] == 0.0


def test_it_tells_which_force_across_the_flow_is_the_largest(capsys):
    assert main(["estimate", *NUMBERS, "-Ca", "0.1", "-wallDistance", "20e-6", "-channelWidth", "50e-6"]) == 0
    lines = {line[:22].strip(): line for line in capsys.readouterr().out.splitlines()}
    assert "ductLift" in lines["inertial lift [N]"]
    assert lines["inertial lift [N]"].split()[3].startswith("-")
    assert [name for name, line in lines.items() if "; the largest" in line] == ["weight [N]"]


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["-Ca", "-1"], "Ca is -1. Allowed: a number > 0."),
        (["-Ca", "1", "-wallDistance", "1e-6"], "wallDistance is 1e-06. Allowed: at least half the diameter"),
        (
            ["-Ca", "1", "-wallDistance", "3e-5", "-channelWidth", "5e-5"],
            "wallDistance is 3e-05. Allowed: less than half of channelWidth, 2.5e-05.",
        ),
        ([], "one of the arguments -Ca -shearModulus is required"),
    ],
)
def test_wrong_numbers_are_refused(capsys, more, message):
    assert main(["estimate", *NUMBERS, *more]) == (1 if more else 2)
    said = capsys.readouterr()
    assert message in said.out + said.err
