"""OpenFOAM's mixer, a rotor in an MRF zone: particles go around the blades, not through them."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from foam_tutorials import tutorial
from foam_writer import header

from foamprb import prepare
from foamprb.cloud.state import Status
from foamprb.errors import InputError
from foamprb.flow.rotating import RotatingFlow

pytestmark = pytest.mark.openfoam

CLOUD = """
    solution { rotatingZones HOW; deltaT 1e-4; endTime 0.02; integrationSchemes { shape stokes; } }
    constantProperties
    {
        rho0 1000; rhoInf 1000;
        solid { type neoHooke; poissonsRatio 0.499; shearModulus 1000; }
    }
    subModels
    {
        particleForces { ellipsoidDrag; pressureGradient; virtualMass { Cvm 0.5; } }
        injectionModels
        {
            model
            {
                type cellZoneInjection; cellZone rotor; numberDensity 2e7; U0 (0 0 0); massTotal 0; SOI 0;
                sizeDistribution { type fixedValue; fixedValueDistribution { value 2e-5; } }
            }
        }
        patchInteractionModel localInteraction;
        localInteractionCoeffs { patches ( "rotor|stator" { type stick; } ); }
    }"""


def run(case: Path, *command: str) -> str:
    return subprocess.run(command, cwd=case, check=True, capture_output=True, text=True).stdout


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    case = tutorial("incompressible/simpleFoam/mixerVessel2D", tmp_path_factory.mktemp("mixer") / "case")
    (case / "system/blockMeshDict").write_text(run(case, "m4", "system/blockMeshDict.m4"))
    control = case / "system/controlDict"
    control.write_text(re.sub(r"(endTime|writeInterval) +\d+;", r"\1 150;", control.read_text()))
    run(case, "blockMesh")
    run(case, "simpleFoam")
    return case


def stuck(case: Path, how: str) -> float:
    """Share of the particles that met a blade in a third of a turn."""
    path = case / "constant/softCloudProperties"
    path.write_text(header("dictionary", path.name) + CLOUD.replace("HOW", how))
    cloud = prepare(case, 150, threads=1).cloud
    assert isinstance(cloud.flow, RotatingFlow) == (how == "relative")
    cloud.advance(200)
    return cloud.particles.counts()[Status.STUCK] / cloud.particles.size


def test_blades_are_met_by_few(case):
    """Fluid does not go through walls that turn with it."""
    assert stuck(case, "relative") < 0.03


def test_an_absolute_velocity_that_crosses_its_walls_is_refused(case):
    """At one time the blades move through the fluid; a flow around them as they stand is another one."""
    with pytest.raises(InputError, match="cannot be balanced"):
        stuck(case, "absolute")
