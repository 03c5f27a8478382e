"""A dictionary in the words of OpenFOAM's clouds: what means nothing here, and what has another name."""

from __future__ import annotations

from pathlib import Path

import pytest

from foamprb.errors import InputError
from foamprb.settings.settings import read_settings

CLOUD = """
solution
{
    active true; coupled true; transient no; cellValueSourceCorrection off; maxCo 0.4;
    interpolationSchemes { rho cell; mu cell; U.water cellPoint; rho.water cell; }
    averagingMethod dual;
    integrationSchemes { U Euler; }
    sourceTerms { schemes { U semiImplicit 1; } }
}
constantProperties
{
    rhoMin 1e-14; constantVolume false; alphaMax 0.8;
    rho0 1050; youngsModulus 4e7; poissonsRatio 0.4;
}
subModels
{
    particleForces { sphereDrag; gravity; }
    injectionModels
    {
        seeds
        {
            type manualInjection; massTotal 0; parcelBasisType fixed; nParticle 40; SOI 0;
            positionsFile "positions"; U0 (0 0 0);
            sizeDistribution { type fixedValue; fixedValueDistribution { value 2e-4; } }
        }
    }
    dispersionModel none; surfaceFilmModel none; heatTransferModel none; stochasticCollisionModel none;
    radiation off;
    patchInteractionModel standardWallInteraction;
    standardWallInteractionCoeffs { type rebound; e 0.9; mu 0.1; }
    collisionModel pairCollision;
    pairCollisionCoeffs { maxInteractionDistance 2e-4; pairModel none; wallModel none; }
    packingModel implicit;
    implicitCoeffs { alphaMin 1e-4; }
}
cloudFunctions {}
"""
EXPECTED = [
    "line 4: solution/coupled is 'true'. Allowed: false (the particles do not act on the flow).",
    "line 5: solution/interpolationSchemes/U.water is not known: use U, there is one fluid.",
    "line 13: constantProperties/youngsModulus is not known: use solid, a dictionary with youngsModulus and "
    "type.",
    "line 13: constantProperties/poissonsRatio is not known: use solid, a dictionary with poissonsRatio and "
    "type.",
    "line 17: subModels/particleForces/sphereDrag is not known: use ellipsoidDrag, which for a rigid sphere "
    "is Stokes' drag.",
    "line 22: subModels/injectionModels/seeds/nParticle is '40'. Allowed: 1.0 (particles are single, not "
    "parcels).",
    "line 31: subModels/collisionModel is 'pairCollision'. Allowed: none (the suspension is dilute, "
    "particles do not meet).",
    "line 33: subModels/packingModel is 'implicit'. Allowed: none (the suspension is dilute, particles do "
    "not meet).",
]
CHANGES = [
    ("coupled true", "coupled false"),
    ("U.water cellPoint", "U cellPoint"),
    ("youngsModulus 4e7; poissonsRatio 0.4;",
     "solid { type neoHooke; youngsModulus 4e7; poissonsRatio 0.4; }"),
    ("sphereDrag", "ellipsoidDrag"),
    ("nParticle 40", "nParticle 1"),
    ("pairCollision;", "none;"),
    ("packingModel implicit", "packingModel none"),
]  # fmt: skip
NOTES = ["maxCo", "rho", "mu", "rho.water", "averagingMethod", "sourceTerms", "rhoMin",
         "constantVolume", "alphaMax", "pairCollisionCoeffs", "implicitCoeffs"]  # fmt: skip


@pytest.fixture
def case(tmp_path: Path) -> Path:
    files = {
        "constant/transportProperties": "transportModel Newtonian; nu [0 2 -1 0 0 0 0] 1e-6; "
        "rhoInf rhoInf [1 -3 0 0 0 0 0] 998;",
        "constant/g": "dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);",
        "constant/positions": "((0 0 0))",
        "system/controlDict": "deltaT 1e-3; endTime 2; writeControl runTime; writeInterval 0.5;",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def test_all_that_must_change_is_listed(case: Path) -> None:
    (case / "constant/softCloudProperties").write_text(CLOUD)
    with pytest.raises(InputError) as caught:
        read_settings(case)
    first, *lines = str(caught.value).split("\n")
    assert first == "8 mistakes:"
    assert sorted(lines) == sorted(f"    constant/softCloudProperties, {text}" for text in EXPECTED)


def test_with_those_changes_it_is_read(case: Path, notes: list[str]) -> None:
    text = CLOUD
    for old, new in CHANGES:
        assert text.count(old) == 1
        text = text.replace(old, new)
    (case / "constant/softCloudProperties").write_text(text)
    settings = read_settings(case)
    unused = [note.split(" has no effect: ")[0].split("/")[-1] for note in notes if "has no effect" in note]
    assert sorted(unused) == sorted(NOTES)
    assert settings.fluid.rho == 998.0
    assert any(note.endswith("rhoInf is 998 kg/m3, that of constant/transportProperties.") for note in notes)
    assert (settings.solution.deltaT, settings.solution.writeInterval) == (1e-3, 0.5)
    assert settings.injections[0].solid.shearModulus == pytest.approx(4e7 / 2.8)


def test_a_density_of_the_cloud_goes_before_that_of_the_fluids_file(case: Path) -> None:
    text = CLOUD
    for old, new in [*CHANGES, ("rho0 1050", "rho0 1050; rhoInf 1000")]:
        text = text.replace(old, new)
    (case / "constant/softCloudProperties").write_text(text)
    assert read_settings(case).fluid.rho == 1000.0
    (case / "constant/transportProperties").write_text("nu 1e-6; rho [0 0 0 0 0 0 0] 998;")
    assert read_settings(case).fluid.rho == 1000.0
    (case / "constant/softCloudProperties").write_text(text.replace("rhoInf 1000;", ""))
    with pytest.raises(InputError, match=r"rho is .*a number without unit, not \[1 -3 0 0 0 0 0\]"):
        read_settings(case)


def test_a_suggestion_is_never_a_word_without_effect(case: Path) -> None:
    (case / "constant/softCloudProperties").write_text("solution { maxC 1; deltaT 1; endTime 1; }")
    with pytest.raises(InputError) as caught:
        read_settings(case)
    (line,) = [line for line in str(caught.value).split("\n") if "solution/maxC " in line]
    assert "maxCo" not in line
