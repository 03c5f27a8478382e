"""What foamprb init takes from the cloud of an OpenFOAM case."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from paths import PIPE
from pipe_case import edit

from foamprb.cli import main
from foamprb.cloud.patches import Escape, Rebound
from foamprb.run.job import prepare
from foamprb.settings.settings import read_settings

CLOUD = """
FoamFile { version 2.0; format ascii; class dictionary; object kinematicCloudProperties; }
solution
{
    active true; coupled true; transient yes; maxCo 0.3;
    interpolationSchemes { rho.air cell; U.air cell; }
    sourceTerms { schemes { U semiImplicit 1; } }
}
constantProperties { rho0 1500; alphaMax 0.9; T0 300; youngsModulus 3000; poissonsRatio 0.25; }
subModels
{
    particleForces
    {
        WenYuDrag { alphac alpha.air; } virtualMass { Cvm 0.5; } paramagnetic; SaffmanMeiLiftForce;
    }
    injectionModels
    {
        many
        {
            type patchInjection; parcelBasisType mass; massTotal 40; nParticle 5; patch inlet; SOI 1;
            parcelsPerSecond 1e9; duration 1e4; U0 (1 0 0); flowRateProfile constant 1;
            sizeDistribution
            {
                type uniform; uniformDistribution { minValue 1e-6; maxValue 3e-6; } normalDistribution { }
            }
        }
        zone
        {
            type cellZoneInjection; cellZone none; numberDensity 1;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 1e-6; } }
        }
    }
    dispersionModel none; phaseChangeModel none;
    patchInteractionModel localInteraction;
    localInteractionCoeffs { patches ( "wa.*" { type rebound; e 0.5; mu 0; } hole { type stick; } ); }
    collisionModel pairCollision;
    pairCollisionCoeffs { maxInteractionDistance 1; }
}
cloudFunctions
{
    hits { type patchPostProcessing; patches (outlet); maxStoredParcels 20; fields (U); }
    erosion { type particleErosion; p 1; psi 2; K 2; }
}
"""
LEFT_OUT = [
    "solution/coupled true (the particles do not act on the flow)",
    "solution/interpolationSchemes/U.air cell (allowed: cellPoint, linear)",
    "constantProperties/T0 300 (it is not modelled)",
    "subModels/particleForces/WenYuDrag (ellipsoidDrag replaces it)",
    "subModels/particleForces/paramagnetic (it is not modelled)",
    "injectionModels/many/massTotal 40 (particles are single, not parcels: their mass",
    "injectionModels/many/nParticle 5 (particles are single, not parcels)",
    "subModels/injectionModels/zone (",
    "localInteractionCoeffs/patches/hole (it matches no patch)",
    "subModels/collisionModel pairCollision (the suspension is dilute, particles do not meet)",
    "cloudFunctions/hits/fields (U) (it is not modelled)",
    "cloudFunctions/erosion (",
]


@pytest.fixture
def case(tmp_path: Path) -> Path:
    folder = tmp_path / "pipe"
    shutil.copytree(PIPE, folder, ignore=shutil.ignore_patterns("postProcessing", "soft*"))
    (folder / "constant/kinematicCloudProperties").write_text(CLOUD)
    return folder


def test_the_cases_own_cloud_is_the_start(case, capsys):
    assert main(["init", "-case", str(case)]) == 0
    said = capsys.readouterr().out
    text = (case / "constant/softCloudProperties").read_text()
    for sentence in LEFT_OUT:
        assert said.count(sentence) == 1, sentence
        assert text.count(sentence) == 1, sentence
    assert text.count("//   ") == said.count("left out") == len(LEFT_OUT) + 1
    settings = read_settings(case)
    (injection,) = settings.injections
    assert (injection.name, injection.rho0, injection.model.U0) == ("many", 1500.0, (1.0, 0.0, 0.0))
    assert injection.sizeDistribution.limits == (1e-6, 3e-6)
    assert injection.solid.shearModulus == pytest.approx(3000.0 / 2.5)
    assert list(settings.forces) == ["virtualMass"]
    assert list(settings.surroundings) == ["SaffmanMeiLiftForce"]
    assert list(settings.functions) == ["paths", "hits"]
    assert settings.functions["hits"].maxStoredParcels == 20


def test_lift_is_left_out_in_rotating_zones(case):
    (case / "constant/MRFProperties").write_text("")
    assert main(["init", "-case", str(case)]) == 0
    text = (case / "constant/softCloudProperties").read_text()
    assert "SaffmanMeiLiftForce (it does not hold in the rotating zones" in text
    assert not read_settings(case).surroundings


def test_a_large_injection_is_reduced_to_a_first_run(case):
    assert main(["init", "-case", str(case)]) == 0
    text = (case / "constant/softCloudProperties").read_text()
    assert re.search(r"SOI +0; +// s, the case has 1$", text, re.MULTILINE)
    assert re.search(r"duration +\S+; +// s, the case has 10000", text)
    assert re.search(r"parcelsPerSecond +\S+; +// 1/s, the case has 1e\+09", text)
    job = prepare(case)
    assert job.cloud.particles.size == pytest.approx(1e5, rel=0.05)
    # The last particles have time to pass.
    assert job.settings.solution.endTime > 5.0 * job.cloud.particles.t0.max()


def test_a_large_concentration_is_reduced_too(case):
    edit(case, "patchInjection", "patchFlowRateInjection", "constant/kinematicCloudProperties")
    edit(case, r"parcelsPerSecond 1e9;", "parcelConcentration 1e13;", "constant/kinematicCloudProperties")
    assert main(["init", "-case", str(case)]) == 0
    text = (case / "constant/softCloudProperties").read_text()
    assert re.search(r"parcelConcentration +\S+; +// 1/m3, the case has 1e\+13", text)
    assert prepare(case).cloud.particles.size == pytest.approx(1e5, rel=0.05)


def test_patches_without_a_rule_get_one(case):
    assert main(["init", "-case", str(case)]) == 0
    job = prepare(case)
    kinds = {p.name: type(i) for p, i in zip(job.cloud.flow.patches, job.cloud.interactions, strict=True)}
    assert kinds == {"inlet": Escape, "outlet": Escape, "wall": Rebound}


def test_walls_off_which_collisions_moved_particles_let_them_rebound(case):
    file = case / "constant/kinematicCloudProperties"
    file.write_text(re.sub("Model localInteraction;", "Model none;", file.read_text()))
    assert main(["init", "-case", str(case)]) == 0
    text = (case / "constant/softCloudProperties").read_text()
    assert re.search(r"wall +\{ type rebound; \} // wall; or stick, escape", text)


def test_a_model_for_all_walls_is_carried_over(case):
    file = case / "constant/kinematicCloudProperties"
    file.write_text(
        re.sub("localInteraction;", "standardWallInteraction;", file.read_text()).replace(
            "collisionModel",
            "standardWallInteractionCoeffs { type rebound; e 0.97; mu 0.09; } collisionModel",
        )
    )
    assert main(["init", "-case", str(case)]) == 0
    assert read_settings(case).interaction == "standardWallInteraction"
    assert main(["run", "-dry-run", "-case", str(case)]) == 0


def test_a_cloud_that_cannot_be_read_is_warned_of(case, capsys):
    (case / "constant/kinematicCloudProperties").write_text("solution { #calc 1; }")
    assert main(["init", "-case", str(case)]) == 0
    assert "The initial settings are made without this file." in capsys.readouterr().out
    assert main(["run", "-dry-run", "-case", str(case)]) == 0


def test_without_a_cloud_nothing_is_said_of_one(case):
    (case / "constant/kinematicCloudProperties").unlink()
    assert main(["init", "-case", str(case)]) == 0
    assert "Made from" not in (case / "constant/softCloudProperties").read_text()
