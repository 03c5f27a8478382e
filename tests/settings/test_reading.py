"""Settings of a cloud: what is read, and the one message for each mistake."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from cloud_dictionary import CLOUD, Reader, unexpected

from foamprb import PressureGradient, SaffmanMeiLift, VirtualMass, WallLift
from foamprb.cloud.injection.models import ManualInjection, PatchInjection
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloudfunctions.particle_collector import ParticleCollector
from foamprb.cloudfunctions.particle_histogram import ParticleHistogram
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.patch_post_processing import PatchPostProcessing
from foamprb.dictionary.positions import read_positions
from foamprb.errors import InputError
from foamprb.run.job import _models
from foamprb.settings.patches import PatchRule
from foamprb.settings.settings import read_settings


def test_defaults(read: Reader, case: Path) -> None:
    settings = read()
    assert settings.case == case
    assert settings.file == case / "constant/softCloudProperties"
    assert settings.name == "softCloud"
    assert settings.solution.writeInterval == settings.solution.endTime == 0.4
    assert settings.solution.deltaT == 2e-5
    assert settings.solution.integrationSchemes.shape == "auto"
    assert settings.solution.integrationSchemes.tolerance == 1e-4
    assert settings.fluid.mu == pytest.approx(1.208 * 1.5e-5, rel=1e-15, abs=0.0)
    assert settings.gravity == (0.0, 0.0, 0.0)
    assert (settings.traction, settings.drag, settings.touching) == ("roscoe", "oberbeck", "ellipsoid")
    (inlet,) = settings.injections
    assert inlet.name == "inlet"
    assert inlet.model == PatchInjection(patch="inlet", parcelsPerSecond=1000.0, duration=0.1)
    assert inlet.rho0 == 2560.0
    assert inlet.sizeDistribution.value == 5e-6
    assert settings.patches == (PatchRule("wall", Stick()), PatchRule("(inlet|outlet)", Escape(), regex=True))


def test_selections(read: Reader) -> None:
    settings = read(
        ("ellipsoidDrag;", "ellipsoidDrag { type brennerProlate; } gravity;"),
        ("injectionModels", "tractionModel jeffery; injectionModels"),
        ("patches (", "touching centre; patches ( side { type rebound; e 0.9; mu 0.1; }"),
        ("endTime         0.4;", "endTime 0.4; writeInterval 0.02;"),
    )
    assert settings.gravity == (0.0, -9.81, 0.0)
    assert (settings.traction, settings.drag, settings.touching) == ("jeffery", "brennerProlate", "centre")
    assert settings.patches[0] == PatchRule("side", Rebound(e=0.9, mu=0.1))
    assert settings.solution.writeInterval == 0.02


def test_what_means_the_same_in_openfoam_is_accepted(read: Reader) -> None:
    plain = read()
    assert plain == read(
        ("deltaT ", "active yes; coupled off; transient no; cellValueSourceCorrection off; deltaT "),
        ("endTime ", "interpolationSchemes { U linear; } integrationSchemes { U Euler; } endTime "),
        ("duration 0.1;", "duration 0.1; massTotal 0; parcelBasisType fixed; nParticle 1;"),
        ("patch inlet;", "patch inlet; flowRateProfile constant 1;"),
        ("injectionModels", "dispersionModel none; collisionModel none; injectionModels"),
    )


def test_the_longest_step_is_rounded_down_to_tracking_steps(read: Reader) -> None:
    longest = {"2e-5": 1, "3.9999e-5": 1, "4e-5": 2, "6e-5": 3, "1.1e-4": 5, "1.5e-4": 7, "0.00032": 16}
    found = {dt: read(("deltaT ", f"maxDeltaT {dt}; deltaT ")).solution.stride for dt in longest}
    assert found == longest
    assert read().solution.stride is None


def test_manual_injection(read: Reader, case: Path) -> None:
    settings = read(
        ("patchInjection; patch inlet; parcelsPerSecond 1000; duration 0.1;", "manualInjection; $more;"),
        (
            "FoamFile",
            'more { positionsFile "positions"; U0 (0 1 -2e-3); SOI 0.1; ignoreOutOfBounds yes; } FoamFile',
        ),
    )
    model = settings.injections[0].model
    assert model == ManualInjection(case / "constant/positions", (0.0, 1.0, -2e-3), 0.1, True)
    assert isinstance(model, ManualInjection)
    np.testing.assert_array_equal(read_positions(model.positionsFile).x, [[0.0, 0.0, 0.0]])


MISTAKES = [
    # one word of the dictionary, what stands there instead, and what the message says
    ("deltaT          2e-05;", "", "line 3: solution/deltaT is missing. Allowed: a number > 0."),
    ("2e-05", "-2e-05", "line 5: solution/deltaT is '-2e-05'. Allowed: a number > 0."),
    ("2e-05", "nan", "solution/deltaT is 'nan'"),
    ("2e-05", "fast", "solution/deltaT is 'fast'. Allowed: a number > 0."),
    ("2e-05;", "2e-05", "solution/deltaT is '2e-05 endTime 0.4'"),
    (
        "deltaT ",
        "writeInterval 3e-5; deltaT ",
        "solution/writeInterval is 3e-05. Allowed: a multiple of deltaT",
    ),
    ("deltaT ", "maxDeltaT 1e-5; deltaT ", "solution/maxDeltaT is 1e-05. Allowed: at least deltaT = 2e-05."),
    ("deltaT ", "maxDeltaT 1e25; deltaT ", "solution/maxDeltaT is 1e+25, with deltaT = 2e-05 that is"),
    (
        "deltaT ",
        "active false; deltaT ",
        "solution/active is 'false'. Allowed: true (the cloud is not active",
    ),
    ("deltaT ", "period 1; deltaT ", "solution/period needs a flow that changes in time: transient yes."),
    ("deltaT ", "transient yes; period 0; deltaT ", "solution/period is '0'. Allowed: a number > 0."),
    (
        "deltaT ",
        "interpolationSchemes { U cell; } deltaT ",
        "interpolationSchemes/U is 'cell'. Did you mean 'cellPoint'? Allowed: cellPoint, linear.",
    ),
    ("2560", "-1", "constantProperties/rho0 is '-1'. Allowed: a number > 0, or a dictionary"),
    (
        "poissonsRatio 0.4",
        "poissonsRatio 0.5",
        "solid/poissonsRatio is '0.5'. Allowed: a number > -1 and < 0.5, such as 0.4999 for a solid that "
        "keeps its volume.",
    ),
    (
        "poissonsRatio 0.4; shearModulus",
        "youngsModulus",
        "constantProperties/solid/poissonsRatio is missing. Allowed: a number > -1",
    ),
    (
        "poissonsRatio 0.4;",
        "poissonsRatio 0.4; bulkModulus 1e5;",
        "constantProperties/solid gives poissonsRatio and bulkModulus. Allowed: one of",
    ),
    (
        "type neoHooke;",
        "",
        "constantProperties/solid/type is missing. Allowed: capsule, drop, gent, mooneyRivlin, neoHooke",
    ),
    ("shearModulus 1000;", "", "constantProperties/solid gives no stiffness. Allowed: one of shearModulus, "),
    ("1000; }", "1000; Ca 1; }", "constantProperties/solid gives shearModulus and Ca. Allowed: one of"),
    ("shearModulus 1000", "Ca 1", "constantProperties/solid/referenceShearRate is missing"),
    ("ellipsoidDrag;", "", "subModels/particleForces/ellipsoidDrag is missing. Allowed: a dictionary"),
    (
        "ellipsoidDrag;",
        "ellipsoidDrag { type stokes; }",
        "ellipsoidDrag/type is 'stokes'. Allowed: brennerProlate",
    ),
    ("ellipsoidDrag;", "ellipsoidDrag; gravity no;", "particleForces/gravity is 'no'. Allowed: a dictionary"),
    ("duration 0.1;", "duration 0.1; U0 (0 0);", "inlet/U0 is '(0 0)'. Allowed: a vector (x y z)."),
    (
        "duration 0.1;",
        "duration 0.1; massTotal 1;",
        "inlet/massTotal is '1'. Allowed: 0.0 (particles are single",
    ),
    (
        "duration 0.1;",
        "duration 0.1; flowRateProfile table ((0 1) (1 2));",
        "is 'table ((0 1) (1 2))'. Allowed: con",
    ),
    ("patch inlet;", "patch in let;", "inlet/patch is 'in let'. Allowed: a word."),
    ("value 5e-6;", "", "inlet/sizeDistribution/fixedValueDistribution/value is missing"),
    ("fixedValueDistribution { value 5e-6; }", "", "sizeDistribution/fixedValueDistribution is missing"),
    (
        "type fixedValue;",
        "type normal;",
        "inlet/sizeDistribution/fixedValueDistribution is not known. Did you",
    ),
    (
        "localInteraction;",
        "standardWallInteraction;",
        "subModels/standardWallInteractionCoeffs is missing. Allowed: a dictionary",
    ),
    ("type stick", "type rebound; e 2", "patches/wall/e is '2'. Allowed: a number from 0 to 1."),
    ("type stick", "type stick; e 1", "patches/wall/e is not known. Allowed: type."),
    ("(inlet|outlet)", "(inlet|outlet", "patches/(inlet|outlet is not a regular expression"),
    ("patches (", "touching edge; patches (", "touching is 'edge'. Allowed: centre, ellipsoid."),
    ("FoamFile", "colour blue; FoamFile", "line 2: colour is not known. "),
]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("dimensions [0 1 -1 0 0 0 0];", "line 1: dimensions is '[0 1 -1 0 0 0 0]', with the dimensions "
         "[0 1 -1 0 0 0 0], those of a velocity, not [0 1 -2 0 0 0 0], those of an acceleration."),
        ("dimensions [0 1];", "whose dimensions cannot be read"),
    ],
)  # fmt: skip
def test_dimensions_of_gravity(case: Path, read: Reader, text: str, message: str) -> None:
    (case / "constant/g").write_text(f"{text} value (0 -9.81 0);")
    with pytest.raises(InputError) as caught:
        read(("ellipsoidDrag;", "ellipsoidDrag; gravity;"))
    assert str(caught.value).startswith("constant/g, line 1: ")
    assert message in str(caught.value)
    for sound in ("", "dimensions [0 1 -2 0 0 0 0];", "dimensions [0 1 -2 0 0];"):
        (case / "constant/g").write_text(f"{sound} value (0 -9.81 0);")
        assert read(("ellipsoidDrag;", "ellipsoidDrag; gravity;")).gravity == (0.0, -9.81, 0.0)
    for sound in ("(0 -981 0) [cm/s^2]", "[cm s^-2] (0 -981 0)"):
        (case / "constant/g").write_text(f"dimensions [acceleration]; value {sound};")
        found = read(("ellipsoidDrag;", "ellipsoidDrag; gravity;")).gravity
        assert found == pytest.approx((0.0, -9.81, 0.0), rel=1e-15, abs=0.0)


def test_each_mistake_gives_its_one_message(read: Reader) -> None:
    assert unexpected(read, MISTAKES) == []


SEVERAL = [
    (
        [("patchInjection", 'manualInjection; positionsFile "no"')],
        ["line 21: subModels/injectionModels/inlet/patch is not", "duration is not known", "parcelsPerSecond",
         """positionsFile is '"no"'. Allowed: the name of an existing file"""],
    ),
    ([("solution\n{", "solution 3; other {")], ["other is not known", "solution is '3'. Allowed: a dict"]),
    (
        # One in each section, and of each kind: misspelt, missing, of the wrong type, out of bounds.
        [("deltaT ", "deltat "), ("rho0 ", "rho "), ("ellipsoidDrag", "sphereDrag"), ("neoHooke", "neoHook"),
         ("patch inlet;", ""), ("value 5e-6;", "value -1;"), ("type stick", "type stik"),
         ("type escape", "kind escape"), ("FoamFile", "cloudFunctions { a; b { type c; } } FoamFile")],
        ["line 2: cloudFunctions/a/type is missing", "line 2: cloudFunctions/b/type is 'c'",
         "line 5: solution/deltat is not known. Did you mean 'deltaT'",
         "line 10: constantProperties/rho is not known. Did you mean 'rho0'",
         "line 12: constantProperties/solid/type is 'neoHook'. Did you mean 'neoHooke'",
         "line 16: subModels/particleForces/sphereDrag is not known: use ellipsoidDrag",
         "line 19: subModels/injectionModels/inlet/patch is missing",
         "line 22: subModels/injectionModels/inlet/sizeDistribution/fixedValueDistribution begins at -1",
         "line 28: subModels/localInteractionCoeffs/patches/wall/type is 'stik'. Did you mean 'stick'",
         "line 28: subModels/localInteractionCoeffs/patches/(inlet|outlet)/type is missing"],
    ),
    ([("subModels\n{", "models {"), ("rhoInf          1.208;", "")],
     ["line 8: constantProperties/rhoInf is missing", "models is not known. Did you mean 'subModels'"]),
    ([("localInteractionCoeffs", "localInteractonCoeffs"), ("rhoInf ", "rhoinf ")],
     ["line 11: constantProperties/rhoinf is not known. Did you mean 'rhoInf'",
      "localInteractonCoeffs is not known. Did you mean 'localInteractionCoeffs'"]),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "expected"), SEVERAL)
def test_all_mistakes_come_at_once(read: Reader, changes: list[tuple[str, str]], expected: list[str]) -> None:
    with pytest.raises(InputError) as caught:
        read(*changes)
    first, *lines = str(caught.value).split("\n")
    assert first == f"{len(expected)} mistakes:"
    assert len(lines) == len(expected)
    for text in expected:
        assert sum(text in line for line in lines) == 1, text
    assert all(line.startswith("    constant/softCloudProperties") for line in lines)
    numbers = [int(found[1]) if (found := re.search(r", line (\d+):", line)) else 0 for line in lines]
    assert numbers == sorted(numbers)


def test_mistakes_of_several_files_come_together(case: Path, read: Reader) -> None:
    (case / "constant/transportProperties").write_text("transportModel Newtonian;\nnu air;")
    with pytest.raises(InputError) as caught:
        read(("2e-05", "fast"))
    assert [line.split(":")[0].strip() for line in str(caught.value).split("\n")[1:]] == [
        "constant/softCloudProperties, line 5",
        "constant/transportProperties, line 2",
    ]


def test_a_mistake_that_all_injection_models_share_counts_once(read: Reader) -> None:
    text = CLOUD[CLOUD.index("        inlet\n") : CLOUD.index("    }\n    patchInter")]
    two = text + text.replace("inlet\n", "second\n", 1)
    with pytest.raises(InputError) as caught:
        read((text, two), ("poissonsRatio 0.4", "poissonsRatio 1"), ("rhoInf          1.208;", "rhoInf 0;"))
    assert str(caught.value).startswith("2 mistakes:")


def test_no_injection_model(read: Reader) -> None:
    text = CLOUD[CLOUD.index("        inlet\n") : CLOUD.index("    }\n    patchInter")]
    with pytest.raises(InputError, match="subModels/injectionModels is empty"):
        read((text, ""))


def test_what_to_do_without_a_dictionary(case: Path) -> None:
    with pytest.raises(InputError) as caught:
        read_settings(case)
    assert str(caught.value) == (
        f"constant/softCloudProperties: No such file or directory (case {case}). Write one: foamprb init "
        "writes softCloudProperties for a case; or name another file with -dict."
    )
    for missing in ("constant/other", "/nowhere/other"):
        with pytest.raises(
            InputError, match=rf"^{missing}: No such file or directory .* foamprb init writes"
        ):
            read_settings(case, Path(missing))


def test_files_that_are_missing(case: Path, read: Reader) -> None:
    (case / "constant/g").unlink()
    read()
    with pytest.raises(InputError, match=r"^constant/g: No such file"):
        read(("ellipsoidDrag;", "ellipsoidDrag; gravity;"))


def test_forces(read: Reader) -> None:
    assert read().forces == {}
    settings = read(("ellipsoidDrag;", "virtualMass { Cvm 0.5; } ellipsoidDrag; pressureGradient { U U; }"))
    # In the order of the registry.
    both = [("pressureGradient", PressureGradient()), ("virtualMass", VirtualMass(Cvm=0.5))]
    assert list(settings.forces.items()) == both
    with pytest.raises(InputError, match="virtualMass/Cvm is missing"):
        read(("ellipsoidDrag;", "ellipsoidDrag; virtualMass;"))


def test_saffmans_lift(read: Reader) -> None:
    settings = read(("ellipsoidDrag;", "ellipsoidDrag; SaffmanMeiLiftForce { U U; }"))
    assert settings.surroundings == {"SaffmanMeiLiftForce": SaffmanMeiLift()}
    with pytest.raises(InputError, match="SaffmanMeiLiftForce does not hold in rotating zones"):
        _models(settings, "stokes", rotating=True)


def test_surroundings(read: Reader) -> None:
    assert read().surroundings == {}
    settings = read(
        ("ellipsoidDrag;", 'ellipsoidDrag; wallLift { cutOff 20; mobility no; patches (wall "s.*"); }')
    )
    (model,) = settings.surroundings.values()
    assert model == WallLift(cutOff=20.0, mobility=False, patches=("wall", "s.*"))
    assert str(model) == "(cutOff 20, strain yes, mobility no, leastGap 0.01, patches (wall s.*))"
    with pytest.raises(InputError, match=r"wallLift/cutOff is '1'. Allowed: a number > 2."):
        read(("ellipsoidDrag;", "ellipsoidDrag; wallLift { cutOff 1; }"))


def test_libs_must_be_files(read: Reader) -> None:
    with pytest.raises(InputError, match=r"libs is .*no.py.*Allowed: a list \(file file\)"):
        read(("solution", 'libs ("no.py");\nsolution'))


# Fluid


@pytest.mark.parametrize(
    "text",
    [
        "nu 1e-5;",
        "nu [0 2 -1 0 0 0 0] 1e-5;",
        "nu [ 0 2 -1 0 0 ] 1e-5;",
        "nu nu [0 2 -1 0 0 0 0] 1e-5;",
        "transportModel Newtonian; NewtonianCoeffs { nu 1e-5; } nu 3;",
        'air 1e-5; rho #calc "1+1"; nu $air;',
        "R 2; area #eval{ $R*sqrt(0.5); }; nu 1e-5;",
    ],
)
def test_viscosity(case: Path, read: Reader, text: str) -> None:
    (case / "constant/transportProperties").write_text(text)
    assert read().fluid.nu == 1e-5


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nu 0;", "nu is '0'. Allowed: a number > 0."),
        (
            "nu [0 1 -1 0 0 0 0] 1e-5;",
            "nu is '[0 1 -1 0 0 0 0] 1e-5', with the dimensions [0 1 -1 0 0 0 0], those of a velocity, not "
            "[0 2 -1 0 0 0 0], those of a kinematic viscosity.",
        ),
        ("nu [1 0 0 0 0 0 2] 1e-5;", "with the dimensions [1 0 0 0 0 0 2], not [0 2 -1 0 0 0 0], those of"),
        ("nu [0 2 -1] 1e-5;", "whose dimensions cannot be read"),
        ("transportModel Newtonian;", "transportProperties: nu is missing"),
        (
            "transportModel CrossPowerlaw; nu 1e-5;",
            "transportModel is 'CrossPowerlaw'. Allowed: Newtonian, constant, BirdCarreau, Casson, ",
        ),
        (
            "transportModel powerLaw; k 1; nuMin 0; nuMax 1;",
            "n is missing. Allowed: a number, a coefficient of powerLaw.",
        ),
        ("transportModel powerLaw; k one; n 1; nuMin 0; nuMax 1;", "k is 'one'. Allowed: a number."),
    ],
)
def test_viscosity_mistakes(case: Path, read: Reader, text: str, message: str) -> None:
    (case / "constant/transportProperties").write_text(text)
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read()
    assert str(caught.value).startswith("constant/transportProperties")


# Cloud functions


def test_cloud_functions(read: Reader) -> None:
    assert read().functions == {}
    block = """
    cloudFunctions
    {
        paths { type particleTracks; trackInterval 5; maxSamples 100; maxTracks 7; }
        hits { type patchPostProcessing; patches (wall "out let"); maxStoredParcels 20; }
        gate { type particleCollector; mode plane; origin (1 2 3); normal (0 0 1); resetOnWrite yes; }
        spread { type particleHistogram; fields (shearExposure); nBins 7; }
    }
    solution"""
    assert read(("solution", block)).functions == {
        "paths": ParticleTracks(trackInterval=5, maxSamples=100, maxTracks=7),
        "hits": PatchPostProcessing(patches=("wall", "out let"), maxStoredParcels=20),
        "gate": ParticleCollector("plane", (1.0, 2.0, 3.0), (0.0, 0.0, 1.0), resetOnWrite=True),
        "spread": ParticleHistogram(fields=("shearExposure",), nBins=7),
    }


FUNCTION_MISTAKES = [
    ("f { type particleTrack; }", "f/type is 'particleTrack'. Did you mean 'particleTracks'?"),
    (
        "f { type particleTracks; trackInterval 0; maxSamples 5; }",
        "is '0'. Allowed: an integer >= 1.",
    ),
    ("f { type patchPostProcessing; patches wall; }", "patches is 'wall'. Allowed: a list of words"),
    (
        "f { type particleCollector; mode polygon; origin (0 0 0); normal (1 0 0); }",
        "mode is 'polygon'. Allowed: plane.",
    ),
    (
        "f { type particleCollector; mode plane; origin (0 0 0); normal (1 0 0); removeCollected yes; }",
        "removeCollected is 'yes'. Allowed: false (the particles go on).",
    ),
    (
        "f { type particleCollector; mode plane; origin (0 0 0); normal (0 0 0); }",
        "has a normal (0 0 0).",
    ),
    (
        "f { type particleHistogram; fields (age); }",
        "cloudFunctions/f has the field age. Allowed: maxDef",
    ),
    ('"a/b" { type particleHistogram; }', "cloudFunctions/a/b is not a valid name of a folder"),
    ("a/../../b { type particleHistogram; }", "is not a valid name of a folder for results: it conta"),
    (".. { type particleHistogram; }", "cloudFunctions/.. is not a valid name of a folder"),
    ('"a b" { type particleHistogram; }', "it contains ' '"),
    ("fates.csv { type particleHistogram; }", "the results have a file of that name"),
    ("checkpoint { type particleHistogram; }", "the results have a file of that name"),
    ("softCloud_000000 { type particleHistogram; }", "the results have a file of that name"),
]


def test_each_wrong_cloud_function_has_its_message(read: Reader) -> None:
    mistakes = [("solution", f"cloudFunctions {{ {own} }} solution", text) for own, text in FUNCTION_MISTAKES]
    assert unexpected(read, mistakes) == []


def test_names_that_are_no_words_are_refused(case: Path, read: Reader) -> None:
    text = CLOUD[CLOUD.index("        inlet\n") : CLOUD.index("        {\n            type patchInj")]
    with pytest.raises(
        InputError, match=r"injectionModels/a/b is not a valid name of an injection model: it cont"
    ):
        read((text, "        a/b\n"))
    for file in ("constant/..Properties", "constant/a bProperties"):
        (case / file).write_text(CLOUD)
        with pytest.raises(InputError, match=r"the file name yields an invalid cloud name"):
            read_settings(case, Path(file))
    with pytest.raises(InputError, match=r"'\.\./\.\./x' is not a valid name of a region: it contains '/'"):
        read_settings(case, region="../../x")


# The case in the tree
