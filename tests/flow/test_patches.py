"""Kinds of patches, by all types of patches and conditions of the velocity of OpenFOAM v1912."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from foam_writer import write_case

from foamprb.cloud.patches import Escape, Mirror
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Patch
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.boundary_values import with_walls
from foamprb.flow.read.field import VELOCITY_FIELD, FoamField, PatchField
from foamprb.flow.read.openfoam import Case, read_case
from foamprb.run.template import write_template
from foamprb.settings.patches import KindRule, PatchRule, match_patches

TYPES = {
    PatchKind.OPENING: "patch mappedPatch mapped",
    PatchKind.WALL: "wall mappedWall mappedVariableThicknessWall",
    PatchKind.MIRROR: "empty symmetry symmetryPlane wedge",
    PatchKind.COUPLED: "cyclic cyclicACMI cyclicAMI cyclicPeriodicAMI cyclicSlip nonuniformTransformCyclic "
    "oldCyclic overset processor processorCyclic",
}
"""Of v1912, from the tables of constructors of its libraries."""
ELSEWHERE = "cyclicRepeatAMI cyclicGgi ggi overlapGgi mixingPlane jumpCyclic regionCouple regionCoupledAMI"
"""Coupled types of other versions."""
WALLS = (
    "noSlip movingWallVelocity rotatingWallVelocity translatingWallVelocity SRFWallVelocity slip "
    "partialSlip maxwellSlipU JohnsonJacksonParticleSlip filmPyrolysisVelocityCoupled"
)
VALUES = ["fixedValue", "calculated"]
"""Walls where the values have no component across the patch."""
OPENINGS = (
    "SRFFreestreamVelocity SRFVelocity activeBaffleVelocity activePressureForceBaffleVelocity advective "
    "atmBoundaryLayerInletVelocity codedFixedValue codedMixed cylindricalInletVelocity directionMixed "
    "exprFixedValue exprMixed externalCoupledMixed extrapolatedCalculated filmHeightInletVelocity "
    "fixedGradient fixedInternalValue fixedMean fixedMeanOutletInlet fixedNormalInletOutletVelocity "
    "fixedNormalSlip fixedProfile fixedShearStress flowRateInletVelocity flowRateOutletVelocity "
    "fluxCorrectedVelocity freeSurfaceVelocity freestream freestreamVelocity "
    "inclinedFilmNusseltInletVelocity inletOutlet interstitialInletVelocity mapped mappedField "
    "mappedFixedInternalValue mappedFixedPushedInternalValue mappedFlowRate mappedVelocityFlux "
    "matchedFlowRateOutletVelocity mixed outletInlet outletMappedUniformInlet outletPhaseMeanVelocity "
    "pressureDirectedInletOutletVelocity pressureDirectedInletVelocity pressureInletOutletParSlipVelocity "
    "pressureInletOutletVelocity pressureInletUniformVelocity pressureInletVelocity "
    "pressureNormalInletOutletVelocity pressurePIDControlInletVelocity "
    "rotatingPressureInletOutletVelocity scaledFixedValue semiPermeableBaffleVelocity "
    "supersonicFreestream surfaceNormalFixedValue swirlFlowRateInletVelocity swirlInletVelocity "
    "timeVaryingMappedFixedValue turbulentDFSEMInlet turbulentDigitalFilterInlet turbulentInlet "
    "uniformFixedGradient uniformFixedValue uniformInletOutlet uniformNormalFixedValue "
    "variableHeightFlowRateInletVelocity waveTransmissive waveVelocity zeroGradient"
)


def test_every_type_of_v1912_has_its_kind():
    for kind, names in TYPES.items():
        assert {name: Patch("p", name).kind for name in names.split()} == dict.fromkeys(names.split(), kind)
    assert Patch("p", "cyclicAMI", "q").kind is PatchKind.PASSABLE
    assert Patch("p", "cyclicAMI", faceless=True).kind is PatchKind.FACELESS
    # OpenFOAM takes an unknown type for a plain patch; no coupled type of a fork is one.
    assert (Patch("p", "fanWall").kind, Patch("p", "cyclicNew").kind) == (
        PatchKind.OPENING,
        PatchKind.COUPLED,
    )


@pytest.mark.parametrize("kind", [*TYPES[PatchKind.COUPLED].split(), *ELSEWHERE.split()])
def test_a_coupled_patch_lets_nothing_out_unless_it_is_named(kind):
    patch = Patch("side", kind)
    for rule in (KindRule("open", Escape()), PatchRule(".*", Escape(), regex=True)):
        with pytest.raises(InputError, match="side"):
            match_patches([rule], [patch, Patch("out", "patch")], "file")
    assert match_patches([PatchRule("side", Escape())], [patch], "file") == [Escape()]
    assert match_patches([], [patch._replace(faceless=True)], "file") == [Mirror()]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("box")
    write_case(folder, perturbation=0.0)
    mesh = Case(folder).mesh("1e1")
    plain, infos = (tuple(p._replace(type="patch") for p in of) for of in (mesh.mesh.patches, mesh.patches))
    return mesh._replace(mesh=replace(mesh.mesh, patches=plain), patches=infos)


def kinds_with(whole, condition, value):
    entries = {p.name: PatchField(condition, fields={"value": np.array([value])}) for p in whole.patches}
    field = FoamField(Path("U"), VELOCITY_FIELD, np.zeros((1, 3)), entries, (0, 1, -1, 0, 0, 0, 0))
    result = with_walls(whole, field)
    assert len(result.notes) - len(whole.notes) == (result.mesh is not whole.mesh)
    return {patch.name: patch.kind for patch in result.mesh.patches}


def test_every_condition_of_v1912_is_a_wall_or_an_opening(whole):
    assert len([*WALLS.split(), *VALUES, *OPENINGS.split()]) == 82
    still, moving = (0.0, 0.0, 0.0), (1e-9, 1e-9, 1e-9)
    for condition in WALLS.split():
        assert {*kinds_with(whole, condition, moving).values()} == {PatchKind.WALL}, condition
    for condition in VALUES:
        assert {*kinds_with(whole, condition, still).values()} == {PatchKind.WALL}, condition
        assert {*kinds_with(whole, condition, moving).values()} == {PatchKind.OPENING}, condition
    for condition in OPENINGS.split():
        assert {*kinds_with(whole, condition, still).values()} == {PatchKind.OPENING}, condition


def test_a_lid_that_slides_in_its_plane_is_a_wall(whole):
    kinds = kinds_with(whole, "fixedValue", (1.0, 0.0, 0.0))
    assert (kinds["lid"], kinds["sides"]) == (PatchKind.WALL, PatchKind.OPENING)
    assert kinds_with(whole, "fixedValue", (1.0, 0.0, 1e-3))["lid"] is PatchKind.OPENING


def types_of(case, **types):
    path = case / "constant/polyMesh/boundary"
    text = path.read_text()
    for name, kind in types.items():
        text = re.sub(rf"({name} // a patch\n    {{ type )\w+", rf"\1{kind}", text)
    path.write_text(text)


def test_first_settings_know_walls_by_the_velocity_and_coupled_patches(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    types_of(tmp_path, floor="patch", sides="ggi")
    path = tmp_path / "1e1/U"
    path.write_text(
        re.sub(r"floor \{.*?\}", "floor { type noSlip; }", path.read_text(), flags=re.DOTALL).replace(
            "sides { type fixedValue;", "sides { type ggi;"
        )
    )
    text = write_template(tmp_path).read_text()
    assert re.search(r"^ +floor +\{ type stick; \} // wall", text, re.MULTILINE)
    assert re.search(r"^ +// sides +\{ type rebound; \} // particles cannot pass a ggi", text, re.MULTILINE)
    assert re.search(r"^ +lid +\{ type escape; \}", text, re.MULTILINE)


def test_overset_is_one_error(tmp_path):
    write_case(tmp_path, perturbation=0.0)
    types_of(tmp_path, lid="overset")
    with pytest.raises(InputError, match=r"patch lid is of type overset: .* Allowed: the flow on one mesh"):
        write_template(tmp_path)


@pytest.mark.parametrize("condition", ["zeroGradient", "inletOutlet", "fixedValue", "noSlip"])
def test_a_wall_through_which_fluid_flows_is_an_opening_and_named(tmp_path, condition):
    """Not if the condition gives a velocity to the wall."""
    write_case(tmp_path, perturbation=0.0)
    path = tmp_path / "1e1/U"
    text = re.sub(r"(floor \{ type )\w+", rf"\1{condition}", path.read_text())
    if condition == "fixedValue":
        text = re.sub(
            r"floor \{.*?\}", "floor { type fixedValue; value uniform (2 0 -0.3); }", text, flags=re.DOTALL
        )
    path.write_text(text)
    flow = read_case(tmp_path)
    caveats = [note for note in flow.notes if isinstance(note, Caveat)]
    warned = [caveat for caveat in caveats if "patch floor is of type wall" in caveat]
    assert len(warned) == (condition in ("zeroGradient", "inletOutlet"))
    kind = next(patch.kind for patch in flow.patches if patch.name == "floor")
    assert kind is (PatchKind.OPENING if warned else PatchKind.WALL)
    assert not warned or f"({condition}): it is an opening" in warned[0]
    across = [caveat for caveat in caveats if "wall floor: its velocity" in caveat]
    assert len(across) == (condition == "fixedValue")
    assert not across or "(fixedValue) has up to 0.3 m/s across its faces" in across[0]
