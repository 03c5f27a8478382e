"""The particles' stress in OpenFOAM's solver, by the dictionaries and commands of docs/coupling.md."""

from __future__ import annotations

import re
import shutil
import subprocess

import numpy as np
import pytest
from foam_writer import header, rows
from parcels import G
from paths import ROOT

pytestmark = [
    pytest.mark.openfoam,
    pytest.mark.skipif(shutil.which("simpleFoam") is None, reason="simpleFoam is not on PATH"),
]

NX, NY, LENGTH, SPEED, NU = 24, 12, 2.0, 1e-3, 1e-3
FRACTION = 0.05


def page(language: str) -> list[str]:
    """The code blocks of the page in a language."""
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / "docs/coupling.md").read_text(), re.DOTALL)


FILES = {
    "system/blockMeshDict": """
        vertices
        (
            (0 -0.5 0) (2 -0.5 0) (2 0.5 0) (0 0.5 0) (0 -0.5 0.1) (2 -0.5 0.1) (2 0.5 0.1) (0 0.5 0.1)
        );
        blocks (hex (0 1 2 3 4 5 6 7) (24 12 1) simpleGrading (1 1 1));
        boundary
        (
            inlet { type patch; faces ((0 4 7 3)); }
            outlet { type patch; faces ((1 2 6 5)); }
            walls { type wall; faces ((0 1 5 4) (3 7 6 2)); }
            frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }
        );""",
    "system/controlDict": """
        startFrom latestTime; stopAt endTime; endTime 2000; deltaT 1;
        writeControl timeStep; writeInterval 2000; writePrecision 12;""",
    "system/fvSchemes": """
        ddtSchemes { default steadyState; } gradSchemes { default Gauss linear; }
        divSchemes { default Gauss linear; } laplacianSchemes { default Gauss linear corrected; }""",
    "system/fvSolution": """
        solvers
        {
            p { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0.01; }
            "U|sigma" { solver PBiCGStab; preconditioner DILU; tolerance 1e-14; relTol 0; }
        }
        SIMPLE { consistent yes; residualControl { p 1e-8; U 1e-8; } }
        relaxationFactors { equations { U 0.9; } }
        """,
    "constant/transportProperties": f"transportModel Newtonian; nu {NU};",
    "constant/turbulenceProperties": "",
    "constant/softCloudProperties": """
        solution { deltaT 1; endTime 1; writeInterval 1; }
        constantProperties { rho0 1000; rhoInf 1000; solid { type neoHooke; shearModulus 1000; } }
        subModels
        {
            particleForces { ellipsoidDrag; gravity; }
            injectionModels
            {
                all
                {
                    type manualInjection; SOI 0; positionsFile "positions";
                    sizeDistribution { type fixedValue; fixedValueDistribution { value 1e-5; } }
                }
            }
            patchInteractionModel standardWallInteraction;
            standardWallInteractionCoeffs { type rebound; }
        }
        """,
    "0/p": """
        dimensions [0 2 -2 0 0 0 0];
        internalField uniform 0;
        boundaryField
        {
            "(inlet|walls)" { type zeroGradient; }
            outlet { type fixedValue; value uniform 0; }
            frontAndBack { type empty; }
        }""",
    "0/sigma": "",
}
KINDS = {
    "U": "volVectorField", "p": "volScalarField", "sigma": "volSymmTensorField",
    "g": "uniformDimensionedVectorField",
}  # fmt: skip


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """A plane channel with a parabolic inflow, and stiff spheres at the centres of its cells."""
    case = tmp_path_factory.mktemp("coupling")
    function, model, relaxation, stress = page("text")
    y = ((np.arange(NY) + 0.5) / NY - 0.5).tolist()
    centres = [((i + 0.5) * LENGTH / NX, s, 0.05) for s in y for i in range(NX)]
    inflow = [(1.5 * SPEED * (1.0 - 4.0 * s * s), 0.0, 0.0) for s in y]
    velocity = f"""
        dimensions [0 1 -1 0 0 0 0];
        internalField uniform ({SPEED} 0 0);
        boundaryField
        {{
            inlet {{ type fixedValue; value nonuniform List<vector> {NY} ({rows(inflow)}); }}
            outlet {{ type zeroGradient; }}
            walls {{ type noSlip; }}
            frontAndBack {{ type empty; }}
        }}"""
    more = {
        "system/fvSolution": relaxation,
        "constant/turbulenceProperties": model,
        "constant/softCloudProperties": function,
        "constant/positions": f"({rows(centres)})",
        "constant/g": G,
        "0/U": velocity,
        "0/sigma": stress,
    }
    for name in {**FILES, **more}:
        path = case / name
        path.parent.mkdir(exist_ok=True)
        kind = KINDS.get(path.name, "dictionary")
        path.write_text(header(kind, path.name) + FILES.get(name, "") + more.get(name, ""))
    subprocess.run(["blockMesh"], cwd=case, check=True, capture_output=True)
    return case


def pressure_gradient(case, time: int) -> float:
    """The kinematic pressure gradient in the middle of the channel."""
    text = (case / str(time) / "p").read_text()
    p = np.array(text.split("(", 1)[1].split(")")[0].split(), dtype=float).reshape(NY, NX).mean(axis=0)
    return float((p[6] - p[17]) / (11 * LENGTH / NX))


def test_rigid_spheres_raise_the_pressure_gradient_by_einsteins_factor(case):
    script = page("sh")[0].replace("1 2 3 4", "1 2")
    done = subprocess.run(["sh", "-e", "-c", script], cwd=case, check=True, capture_output=True, text=True)
    times = sorted(int(path.name) for path in case.glob("[1-9]*"))
    without, with_spheres = (pressure_gradient(case, time) for time in times)
    poiseuille = 12.0 * NU * SPEED
    assert without == pytest.approx(poiseuille, rel=2e-2)
    # Second order in the height of a cell, 1/12; 4e-4 with twice as many.
    assert (with_spheres - without) / poiseuille == pytest.approx(2.5 * FRACTION, rel=2e-3)
    assert "Change of the stress" in done.stdout + done.stderr
