"""Density of the fluid of a case: volume or mass is kept."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from foam_writer import header, write_case

from foamprb.flow.balance import CONSTANT
from foamprb.flow.read.density import mass_of
from foamprb.flow.read.openfoam import Case, read_case

VOLUME, MASS = "[0 3 -1 0 0 0 0]", "[1 0 -1 0 0 0 0]"
GAS = "thermoType { equationOfState perfectGas; } mixture { specie { molWeight 28.9; } }"
RHO, P, T = ("rho", "[1 -3 0 0 0 0 0]"), ("p", "[1 -1 -2 0 0 0 0]"), ("T", "[0 0 0 1 0 0 0]")


@pytest.fixture
def case(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    return tmp_path


def put(case, time, field, values, kind="volScalarField"):
    name, units = field
    (case / time).mkdir(exist_ok=True)
    listed = f"nonuniform List<scalar> {len(values)} ({' '.join(map(str, values))})"
    (case / time / name).write_text(
        header(kind, name) + f"dimensions {units}; internalField {listed}; "
        'boundaryField { ".*" { type calculated; } }'
    )


def mass(case, *times, index=0, velocity="U"):
    source = Case(case)
    reads = [partial(source.field, name) for name in times]
    return mass_of(case, "", source.mesh("1e1"), times, reads, index, velocity)


def test_the_velocity_of_one_phase_keeps_no_volume(case):
    assert mass(case, "1e1", velocity="U.air") is None


def gas(case):
    (case / "constant/thermophysicalProperties").write_text(
        header("dictionary", "thermophysicalProperties") + GAS
    )


@pytest.mark.parametrize(
    ("rho", "phi", "keeps"),
    [
        (None, None, "what it makes"),
        (None, VOLUME, "volume"),
        (1.2 + np.zeros(8), MASS, "volume"),
        (1.2 + 0.01 * np.arange(8), MASS, "mass"),
        (1.2 + 0.01 * np.arange(8), None, "what it makes"),
        (None, MASS, "what it makes"),
        # Two phases, of which each keeps its density.
        (np.where(np.arange(8) < 4, 1.2, 1000.0), VOLUME, "volume"),
    ],
)
def test_a_flow_keeps_volume_or_mass(case, rho, phi, keeps):
    if rho is None:
        gas(case)
    else:
        put(case, "1e1", RHO, rho)
    if phi:
        put(case, "1e1", ("phi", phi), [0.0], "surfaceScalarField")
    found = mass(case, "1e1")
    assert (found is CONSTANT, found is None) == (keeps == "volume", keeps == "what it makes")
    if keeps == "mass":
        assert found.cells.tolist() == rho.tolist()
    assert read_case(case).notes is not None


def test_an_incompressible_solver_keeps_volume(case):
    assert mass(case, "1e1") is CONSTANT


def test_the_density_of_a_gas_is_that_of_its_state(case):
    """286.6 K at 1e5 Pa: 1.2128 kg/m3."""
    gas(case)
    put(case, "1e1", P, np.full(8, 1e5))
    put(case, "1e1", T, np.r_[286.6, np.full(7, 573.2)])
    found = mass(case, "1e1")
    assert found.cells[:2] == pytest.approx([1.2128, 0.6064], rel=1e-4)
    assert found.growth.tolist() == [0.0]


def test_the_growth_of_the_density_is_that_between_the_times_before_and_after(case):
    gas(case)
    for time, value in ("1e1", 1.0), ("11", 1.5), ("12", 3.0):
        put(case, time, RHO, np.full(8, value))
    times = "1e1", "11", "12"
    assert [mass(case, *times, index=i).growth[0] for i in range(3)] == pytest.approx([0.5, 1.0, 1.5])
