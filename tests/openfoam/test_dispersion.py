"""OpenFOAM's parcels with stochasticDispersionRAS on pitzDaily, and ours: the same distribution."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from foam_tutorials import tutorial
from foam_writer import header
from parcels import CLOUD, TRANSPORT, G, control_dict, numbers
from scipy import stats

from foamprb import prepare

pytestmark = pytest.mark.openfoam

N, END, DT = 4000, 0.02, 1e-4
SOFT = f"""
    solution
    {{
        deltaT 5e-5; maxDeltaT 5e-5; endTime {END + DT}; integrationSchemes {{ shape rosenbrock; }}
    }}
    constantProperties
    {{
        rho0 1000; rhoInf 1.2;
        solid {{ type neoHooke; poissonsRatio 0.4; shearModulus 1e5; }}
    }}
    subModels
    {{
        particleForces {{ ellipsoidDrag; gravity; }}
        injectionModels {{ #include "injectionModels" }}
        dispersionModel MODEL;
        stochasticDispersionRASCoeffs {{ fluctuations OpenFOAM; }}
        patchInteractionModel localInteraction;
        localInteractionCoeffs {{ patches ( PATCHES ); }}
    }}"""
INTERACTION = "patchInteractionModel localInteraction; localInteractionCoeffs { patches ( PATCHES ); }"
PARCELS = CLOUD.replace("INTERACTION", INTERACTION)
PATCHES = '"(upper|lower)Wall" { type rebound; e 1; mu 0; } "inlet|outlet" { type escape; }'
FILES = {
    "constant/injectionModels": """
        model
        {
            type manualInjection; massTotal 0; parcelBasisType fixed; nParticle 1; SOI 0;
            positionsFile "positions"; U0 (8 0 0);
            sizeDistribution { type fixedValue; fixedValueDistribution { value 2e-6; } }
        }""",
    "constant/transportProperties": TRANSPORT,
    "system/controlDict": control_dict(END, DT),
}


def run(case: Path, command: str) -> None:
    subprocess.run([command], cwd=case, check=True, capture_output=True)


def solved(folder: Path) -> Path:
    """The tutorial's flow after some hundred iterations, 0.1 m thick: no parcel comes to front or back."""
    case = tutorial("incompressible/simpleFoam/pitzDaily", folder / "flow")
    mesh = case / "system/blockMeshDict"
    mesh.write_text(re.sub(r" (-?)0\.5\)", r" \g<1>50)", mesh.read_text()))
    control = case / "system/controlDict"
    text = control.read_text().partition("functions\n")[0]
    text = re.sub(r"(endTime|writeInterval) +\d+;", r"\1 300;", text)
    control.write_text(text)
    run(case, "blockMesh")
    run(case, "simpleFoam")
    return case


def prepared(flow: Path, case: Path, model: str) -> Path:
    """A case with the flow at time 0, in three dimensions, and the dictionaries of both programs."""
    latest = max((path for path in flow.iterdir() if path.name.isdigit()), key=lambda path: int(path.name))
    shutil.copytree(flow, case, ignore=shutil.ignore_patterns("[0-9]*"))
    shutil.copytree(latest, case / "0", ignore=shutil.ignore_patterns("phi", "uniform"))
    boundary = case / "constant/polyMesh/boundary"
    before, name, after = boundary.read_text().partition("frontAndBack")
    after = after.replace("empty;", "symmetry;", 1).replace("inGroups        1(empty);", "", 1)
    boundary.write_text(before + name + after)
    for field in ("U", "k", "epsilon", "nut", "p"):
        before, name, after = (case / "0" / field).read_text().partition("frontAndBack")
        (case / "0" / field).write_text(before + name + after.replace("empty", "symmetry"))
    for path, text in FILES.items():
        (case / path).write_text(header("dictionary", Path(path).name) + text)
    for path, text, patches in (
        ("constant/kinematicCloudProperties", PARCELS, f"{PATCHES} frontAndBack {{ type none; }}"),
        ("constant/softCloudProperties", SOFT, PATCHES),
    ):
        (case / path).write_text(
            header("dictionary", Path(path).name) + text.replace("MODEL", model).replace("PATCHES", patches)
        )
    heights = 0.002 + 0.02 * (np.arange(N) + 0.5) / N
    places = "\n".join(f"(0.002 {y:.9g} 0)" for y in heights)
    (case / "constant/positions").write_text(header("vectorField", "positions") + f"{N}\n(\n{places}\n)\n")
    (case / "constant/g").write_text(header("uniformDimensionedVectorField", "g") + G)
    schemes = case / "system/fvSchemes"
    schemes.write_text(schemes.read_text().replace("steadyState", "Euler"))
    return case


def theirs(case: Path) -> np.ndarray:
    """Positions at the end, in the order of release."""
    run(case, "icoUncoupledKinematicParcelFoam")
    cloud = case / f"{END:g}/lagrangian/kinematicCloud"
    return numbers(cloud / "positions").reshape(-1, 4)[np.argsort(numbers(cloud / "origId")), :3]


def ours(case: Path) -> np.ndarray:
    """The same; OpenFOAM's parcels take one more step, as it begins with that before the start."""
    cloud = prepare(case, 0, threads=1).cloud
    cloud.advance(round((END + DT) / cloud.dt))
    return cloud.particles.x


def test_parcels_are_distributed_as_openfoams(tmp_path):
    """How far eddies have taken parcels from the path that each has without them, in both programs.

    The difference of each program's own paths tells the eddies from the interpolation of the mean flow. Ours
    take the same steps with eddies and without, so that both end at the same bits where there are none.
    """
    flow = solved(tmp_path)
    with_eddies = prepared(flow, tmp_path / "eddies", "stochasticDispersionRAS")
    without = prepared(flow, tmp_path / "none", "none")
    a, b = theirs(with_eddies) - theirs(without), ours(with_eddies) - ours(without)
    assert len(a) == len(b) == N
    for i in range(3):
        assert stats.ks_2samp(a[:, i], b[:, i]).pvalue > 1e-3
        assert b[:, i].std() == pytest.approx(a[:, i].std(), rel=0.06)


def test_openfoams_fluctuations_have_a_third_of_the_variance_that_2k_3_says(tmp_path):
    """Of uniform k and ε: measured, as our page says it."""
    case = prepared(solved(tmp_path), tmp_path / "uniform", "stochasticDispersionRAS")
    for field, value in (("k", 1.5), ("epsilon", 1500.0)):
        path = case / "0" / field
        text = re.sub(r"internalField\s+nonuniform.*?\)\s*;", f"internalField uniform {value};",
                      path.read_text(), count=1, flags=re.DOTALL)  # fmt: skip
        path.write_text(text)
    control = case / "system/controlDict"
    control.write_text(
        re.sub(r"deltaT [^;]*;", "deltaT 1e-5;", control.read_text()).replace("0.02", "0.0025")
    )
    run(case, "icoUncoupledKinematicParcelFoam")
    fluctuations = numbers(case / "0.0025/lagrangian/kinematicCloud/UTurb").reshape(-1, 3)
    assert fluctuations.var() == pytest.approx(1.0 / 3.0, rel=0.06)
    lengths = np.linalg.norm(fluctuations, axis=1)
    assert stats.kstest(lengths, "halfnorm").pvalue > 1e-3
    assert stats.kstest(fluctuations[:, 2] / lengths, stats.uniform(-1.0, 2.0).cdf).pvalue > 1e-3
