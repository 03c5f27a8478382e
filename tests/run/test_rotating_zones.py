"""MRFProperties in a run: read, refused, or left aside if an entry says so."""

from __future__ import annotations

import pytest
from foam_writer import header, put_zones
from pipe_case import edit, message, short_case, time_folder

from foamprb.cli import main
from foamprb.flow.read.openfoam import Case


@pytest.fixture
def case(tmp_path):
    case = short_case(tmp_path)
    n = Case(case).mesh(time_folder(case).name).mesh.n_cells
    put_zones(case, rotor=range(n))
    (case / "constant/MRFProperties").write_text(
        header("dictionary", "MRFProperties")
        + "rotor { cellZone rotor; active yes; nonRotatingPatches ( side ); origin (0 0 0); axis (0 0 1); "
        "omega constant 2; }"
    )
    return case


def test_the_log_says_how_a_zone_is_seen(case, capsys):
    edit(case, r"shape\s+paper;", "shape stokes;")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    said = capsys.readouterr().out
    assert "rotates with 2 rad/s: particles in it move relative to the rotor" in said
    edit(case, "endTime ", "rotatingZones absolute; endTime ")
    assert main(["run", "-case", str(case), "-dry-run"]) == 0
    assert "rotating zones (MRFProperties: rotor), but particles move in them" in capsys.readouterr().out


def test_integrator_with_inertia_is_refused_with_a_remedy(case, capsys):
    edit(case, r"shape\s+paper;", "shape rosenbrock;")
    said = message(case, capsys)
    assert "need the integrator stokes, not rosenbrock: set integrationSchemes/shape stokes, or" in said
    assert "solution/rotatingZones absolute" in said
