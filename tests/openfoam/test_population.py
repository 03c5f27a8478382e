"""One dictionary of injection models, read by OpenFOAM and by foamprb: the same population appears."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from foam_writer import header
from parcels import CLOUD, TRANSPORT, G, control_dict, numbers
from scipy import stats

from foamprb import prepare

pytestmark = pytest.mark.openfoam

COMMON = "massTotal 0; parcelBasisType fixed; nParticle 1; SOI 0;"
SIZES = {
    "normal": "minValue 2e-6; maxValue 12e-6; expectation 5e-6; variance 3e-6;",
    "RosinRammler": "minValue 2e-6; maxValue 12e-6; d 5e-6; n 2;",
    "uniform": "minValue 2e-6; maxValue 12e-6;",
    "general": "distribution ((2e-6 1) (4e-6 3) (5e-6 0) (9e-6 1));",
}


def injections() -> str:
    zones = "".join(
        f"""
        {name}
        {{
            type cellZoneInjection; cellZone part; numberDensity 100000; U0 (0 0 0); {COMMON}
            sizeDistribution {{ type {name}; {name}Distribution {{ {entries} }} }}
        }}"""
        for name, entries in SIZES.items()
    )
    return f"""{zones}
        cone
        {{
            type coneInjection; positionAxis (((0.5 0.5 0.5) (1 1 0)) ((0.4 0.5 0.5) (0 0 2)));
            duration 1e-6; parcelsPerInjector 2000; flowRateProfile constant 1; Umag constant 100;
            thetaInner constant 20; thetaOuter constant 60; {COMMON}
            sizeDistribution {{ type fixedValue; fixedValueDistribution {{ value 1e-6; }} }}
        }}"""


FILES = {
    "system/blockMeshDict": """
        convertToMeters 1;
        vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
        blocks (hex (0 1 2 3 4 5 6 7) (8 9 10) simpleGrading (2 1 1));
        boundary
        (
            inlet { type patch; faces ((0 4 7 3)); }
            outlet { type patch; faces ((1 2 6 5)); }
            walls { type wall; faces ((0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7)); }
        );""",
    "system/topoSetDict": """
        actions
        (
            { name rest; type cellSet; action new; source boxToCell; box (0.62 0 0) (1 1 1); }
            { name rest; type cellZoneSet; action new; source setToCellZone; set rest; }
            { name part; type cellSet; action new; source boxToCell; box (0.1 0.1 0.1) (0.62 0.7 0.9); }
            { name part; type cellZoneSet; action new; source setToCellZone; set part; }
        );""",
    "system/controlDict": control_dict(1e-6, 1e-6),
    "system/fvSchemes": """
        ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default none; }
        laplacianSchemes { default none; } interpolationSchemes { default linear; }
        snGradSchemes { default none; }""",
    "system/fvSolution": "",
    "constant/turbulenceProperties": "simulationType laminar;",
    "constant/transportProperties": TRANSPORT,
    "constant/kinematicCloudProperties": CLOUD.replace("MODEL", "none").replace(
        "INTERACTION",
        "patchInteractionModel standardWallInteraction; "
        "standardWallInteractionCoeffs { type rebound; e 1; mu 0; }",
    ),
    "constant/softCloudProperties": """
        solution { deltaT 1e-6; endTime 1e-6; }
        constantProperties
        {
            rho0 1000; rhoInf 1.2;
            solid { type neoHooke; poissonsRatio 0.4; shearModulus 1000; }
        }
        subModels
        {
            particleForces { ellipsoidDrag; }
            injectionModels { #include "injectionModels" }
            patchInteractionModel localInteraction;
            localInteractionCoeffs { patches ( ".*" { type escape; } ); }
        }""",
}
U = """
    dimensions [0 1 -1 0 0 0 0]; internalField uniform (1 0 0);
    boundaryField
    {
        inlet { type fixedValue; value uniform (1 0 0); }
        outlet { type zeroGradient; }
        walls { type slip; }
    }"""


def write_box(case: Path) -> None:
    for folder in ("0", "constant", "system"):
        (case / folder).mkdir(parents=True)
    for path, text in FILES.items():
        (case / path).write_text(header("dictionary", Path(path).name) + text)
    (case / "constant/injectionModels").write_text(injections())
    (case / "0/U").write_text(header("volVectorField", "U") + U)
    (case / "constant/g").write_text(header("uniformDimensionedVectorField", "g") + G)


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """OpenFOAM's diameters and velocities in the order of release, and foamprb's particles."""
    case = tmp_path_factory.mktemp("box") / "case"
    write_box(case)
    for command in ("blockMesh", "topoSet", "icoUncoupledKinematicParcelFoam"):
        subprocess.run([command], cwd=case, check=True, capture_output=True)
    cloud = case / "1e-06/lagrangian/kinematicCloud"
    order = np.argsort(numbers(cloud / "origId"))
    theirs = numbers(cloud / "d")[order], numbers(cloud / "U").reshape(-1, 3)[order]
    return theirs, prepare(case, 0, threads=1).cloud.particles


def test_as_many_particles_appear(both):
    (d, _), p = both
    # OpenFOAM rounds down what a cell asks for, and carries the rest over.
    assert abs(len(d) - p.size) <= len(SIZES)
    assert p.size > 25_000 * len(SIZES)


@pytest.mark.parametrize("name", SIZES)
def test_sizes_are_distributed_as_openfoams(both, name):
    (d, _), p = both
    at = list(SIZES).index(name)
    n = (len(d) - 4000) // len(SIZES)
    theirs, ours = d[at * n : (at + 1) * n], 2.0 * p.R[p.injector == at]
    assert stats.ks_2samp(theirs, ours).pvalue > 0.01


def test_cones_have_openfoams_directions(both):
    """The angle from the axis; drag has begun to turn OpenFOAM's velocities, by less than this can see."""
    (d, v), p = both
    axis = np.array([1.0, 1.0, 0.0]) / np.sqrt(2.0)
    ours = p.v[p.injector == len(SIZES)]
    theirs = v[np.isclose(d, 1e-6)]
    assert len(theirs) == len(ours) == 4000
    angles = [np.arccos(u @ axis / np.linalg.norm(u, axis=1)) for u in (theirs, ours)]
    assert stats.ks_2samp(*angles).pvalue > 0.01
