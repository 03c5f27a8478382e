"""The dictionaries of clouds in OpenFOAM's tutorials: each is answered with all that must change in it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from foam_tutorials import tutorial

from foamprb.errors import InputError
from foamprb.settings.settings import read_settings

pytestmark = pytest.mark.openfoam

HOPPER = "lagrangian/icoUncoupledKinematicParcelFoam/hopper"
DRAG, SOLID = "particleForces/{}Drag is not known", "youngsModulus is not known: use solid"
DENSE = ["coupled is 'true'", "U.air is not known: use U", "solid is missing",
         "isotropyModel is 'stochastic'"]  # fmt: skip
PAIRS = [SOLID, "poissonsRatio is not known: use solid", DRAG.format("sphere"),
         "collisionModel is 'pairCollision'"]  # fmt: skip
UNKNOWN = ["parcelTypeId is not known", "minParcelMass is not known"]
EXPECTED = {
    f"{HOPPER}/hopperInitialState": [*PAIRS, "patchInteractionModel is 'none'"],
    f"{HOPPER}/hopperEmptying": [*PAIRS, "patchInteractionModel is 'none'", "injectionModels is empty"],
    "lagrangian/icoUncoupledKinematicParcelDyMFoam/mixerVesselAMI2D": [*PAIRS, *UNKNOWN, "coupled is 'true'"],
    "lagrangian/MPPICFoam/column": [*DENSE, DRAG.format("ErgunWenYu"), "nParticle is '750'",
                                    "packingModel is 'implicit'"],
    "lagrangian/MPPICFoam/cyclone": [*DENSE, DRAG.format("ErgunWenYu"), "massTotal is '40'",
                                     "parcelBasisType is 'mass'", "packingModel is 'implicit'"],
    "lagrangian/MPPICFoam/injectionChannel": [*DENSE, DRAG.format("WenYu"), "dampingModel is 'relaxation'",
                                              "cellValueSourceCorrection is 'on'"],
    "lagrangian/MPPICFoam/Goldschmidt": [*DENSE, DRAG.format("PlessisMasliyah"),
                                         "packingModel is 'explicit'"],
    "lagrangian/DPMFoam/Goldschmidt": [*UNKNOWN, "coupled is 'true'", "U.air is not known: use U",
                                       SOLID,
                                       "poissonsRatio is not known: use solid", DRAG.format("ErgunWenYu"),
                                       "Did you mean 'standardWallInteractionCoeffs'",
                                       "collisionModel is 'pairCollision'"],
}  # fmt: skip


@pytest.mark.parametrize("name", EXPECTED)
def test_a_tutorials_dictionary_is_answered_at_once(name: str, tmp_path: Path) -> None:
    case = tutorial(name, tmp_path / "case")
    with pytest.raises(InputError) as caught:
        read_settings(case, Path("constant/kinematicCloudProperties"))
    first, *lines = str(caught.value).split("\n")
    assert first == f"{len(EXPECTED[name])} mistakes:"
    for text in EXPECTED[name]:
        assert sum(text in line for line in lines) == 1, text
    assert all(re.match(r" {4}constant/kinematicCloudProperties, line \d+: ", line) for line in lines)
