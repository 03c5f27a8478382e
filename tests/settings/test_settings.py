"""Settings of a cloud: what is read, and the one message for each mistake."""

from __future__ import annotations

import contextlib
import re
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from foamlib import FoamFile
from hypothesis import given
from hypothesis import strategies as st
from paths import PIPE, ROOT

from foamprb import PressureGradient, VirtualMass
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, General, Normal, RosinRammler, Scaled, Uniform
from foamprb.cloud.injection.models import (
    INJECTIONS,
    CellZoneInjection,
    ConeInjection,
    ManualInjection,
    PatchInjection,
)
from foamprb.cloud.injection.shapes import SHAPES, Ellipsoid, Sphere
from foamprb.cloud.patches import INTERACTIONS, Cyclic, Escape, Mirror, Rebound, Stick
from foamprb.cloudfunctions.functions import (
    FUNCTIONS,
    ParticleCollector,
    ParticleHistogram,
    ParticleTracks,
    PatchPostProcessing,
)
from foamprb.dictionary.grammar import Dictionary, Stream, read_dictionary
from foamprb.dictionary.positions import read_positions
from foamprb.dictionary.schema import read_entries
from foamprb.errors import InputError
from foamprb.settings import settings as settings_module
from foamprb.settings.settings import (
    INTERACTION_MODELS,
    Fluid,
    PatchRule,
    Settings,
    match_patches,
    read_settings,
)

CLOUD = """
FoamFile { version 2.0; format ascii; class dictionary; object softCloudProperties; }
solution
{
    deltaT          2e-05;
    endTime         0.4;
}
constantProperties
{
    rho0            2560;
    rhoInf          1.208;
    solid { type neoHooke; poissonsRatio 0.4; shearModulus 1000; }
}
subModels
{
    particleForces { ellipsoidDrag; }
    injectionModels
    {
        inlet
        {
            type patchInjection; patch inlet; parcelsPerSecond 1000; duration 0.1;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 5e-6; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs
    {
        patches ( wall { type stick; } "(inlet|outlet)" { type escape; } );
    }
}
"""

Reader = Callable[..., Settings]


@pytest.fixture
def case(tmp_path: Path) -> Path:
    (tmp_path / "constant").mkdir()
    (tmp_path / "constant/transportProperties").write_text("transportModel Newtonian; nu 1.5e-5;")
    (tmp_path / "constant/g").write_text("dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);")
    (tmp_path / "constant/positions").write_text("((0 0 0))")
    return tmp_path


@pytest.fixture
def read(case: Path) -> Reader:
    """Read the dictionary above with some of its text replaced."""

    def read(*changes: tuple[str, str]) -> Settings:
        text = CLOUD
        for old, new in changes:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        (case / "constant/softCloudProperties").write_text(text)
        return read_settings(case)

    return read


def dictionary(folder: Path, text: str) -> Dictionary:
    (folder / "dictionary").write_text(text)
    return read_dictionary(folder / "dictionary", folder)


def tree(entry: object) -> object:
    """Nested dicts of strings."""
    if isinstance(entry, Dictionary):
        return {key: tree(value) for key, value in entry.entries.items()}
    assert isinstance(entry, Stream)
    return entry.text


def test_defaults(read: Reader, case: Path) -> None:
    settings = read()
    assert settings.case == case
    assert settings.file == case / "constant/softCloudProperties"
    assert settings.name == "softCloud"
    assert settings.solution.writeInterval == settings.solution.endTime == 0.4
    assert settings.solution.deltaT == 2e-5
    assert (settings.solution.shape, settings.solution.tolerance) == ("auto", 1e-4)
    assert settings.fluid.mu == pytest.approx(1.208 * 1.5e-5, rel=1e-15)
    assert settings.gravity == (0.0, 0.0, 0.0)
    assert (settings.traction, settings.drag, settings.touching) == ("roscoe", "oberbeck", "ellipsoid")
    (inlet,) = settings.injections
    assert inlet.name == "inlet"
    assert inlet.model == PatchInjection(patch="inlet", parcelsPerSecond=1000.0, duration=0.1)
    assert inlet.rho == 2560.0
    assert inlet.size.value == 5e-6
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
    np.testing.assert_array_equal(read_positions(model.positionsFile), [[0.0, 0.0, 0.0]])


MISTAKES = [
    # one word of the dictionary, what stands there instead, and what the message says
    ("deltaT ", "deltat ", "line 5: solution/deltat is not known. Did you mean 'deltaT'?"),
    ("deltaT          2e-05;", "", "line 3: solution/deltaT is missing. Allowed: a number > 0."),
    ("2e-05", "-2e-05", "line 5: solution/deltaT is '-2e-05'. Allowed: a number > 0."),
    ("2e-05", "nan", "solution/deltaT is 'nan'"),
    ("2e-05", "1e400", "solution/deltaT is '1e400'"),
    ("2e-05", "fast", "solution/deltaT is 'fast'. Allowed: a number > 0."),
    ("2e-05;", "2e-05", "solution/deltaT is '2e-05 endTime 0.4'"),
    (
        "deltaT ",
        "writeInterval 3e-5; deltaT ",
        "solution/writeInterval is 3e-05. Allowed: a multiple of deltaT",
    ),
    (
        "deltaT ",
        "active false; deltaT ",
        "solution/active is 'false'. Allowed: true (the cloud is not active",
    ),
    ("deltaT ", "active maybe; deltaT ", "solution/active is 'maybe'. Allowed: true"),
    (
        "deltaT ",
        "coupled true; deltaT ",
        "solution/coupled is 'true'. Allowed: false (the particles do not act",
    ),
    ("deltaT ", "period 1; deltaT ", "solution/period needs a flow that changes in time: transient yes."),
    ("deltaT ", "transient yes; period 0; deltaT ", "solution/period is '0'. Allowed: a number > 0."),
    (
        "deltaT ",
        "interpolationSchemes { U cell; } deltaT ",
        "interpolationSchemes/U is 'cell'. Allowed: linear.",
    ),
    ("deltaT ", "integrationSchemes { shape papre; } deltaT ", "Did you mean 'paper'?"),
    ("rhoInf          1.208;", "", "constantProperties/rhoInf is missing"),
    ("2560", "-1", "constantProperties/rho0 is '-1'. Allowed: a number > 0, or a dictionary"),
    (
        "poissonsRatio 0.4",
        "poissonsRatio 0.5",
        "solid/poissonsRatio is '0.5'. Allowed: a number > -1 and < 0.5.",
    ),
    ("poissonsRatio 0.4;", "", "constantProperties/solid/poissonsRatio is missing. Allowed: a number > -1"),
    ("type neoHooke;", "", "constantProperties/solid/type is missing. Allowed: gent, mooneyRivlin, neoHooke"),
    ("neoHooke", "neoHook", "solid/type is 'neoHook'. Did you mean 'neoHooke'?"),
    ("shearModulus 1000;", "", "constantProperties/solid gives no stiffness. Allowed: one of shearModulus, "),
    ("1000; }", "1000; Ca 1; }", "constantProperties/solid gives shearModulus and Ca. Allowed: one of"),
    ("shearModulus 1000", "Ca 1", "constantProperties/solid/referenceShearRate is missing"),
    ("ellipsoidDrag;", "", "subModels/particleForces/ellipsoidDrag is missing. Allowed: a dictionary"),
    ("ellipsoidDrag;", "sphereDrag;", "subModels/particleForces/sphereDrag is not known."),
    (
        "ellipsoidDrag;",
        "ellipsoidDrag { type stokes; }",
        "ellipsoidDrag/type is 'stokes'. Allowed: brennerProlate",
    ),
    ("ellipsoidDrag;", "ellipsoidDrag; gravity no;", "particleForces/gravity is 'no'. Allowed: a dictionary"),
    (
        "subModels\n{",
        "subModels { tractionModel rosco;",
        "subModels/tractionModel is 'rosco'. Did you mean 'roscoe'?",
    ),
    ("patchInjection", "conicalInjection", "inlet/type is 'conicalInjection'. Did you mean 'coneInjection'?"),
    (
        "parcelsPerSecond 1000",
        "parcelsPerSecond 0",
        "subModels/injectionModels/inlet/parcelsPerSecond is '0'. All",
    ),
    (
        "duration 0.1;",
        "",
        "line 19: subModels/injectionModels/inlet/duration is missing. Allowed: a number > 0.",
    ),
    ("duration 0.1;", "duration 0.1; U0 (0 0);", "inlet/U0 is '(0 0)'. Allowed: a vector (x y z)."),
    ("duration 0.1;", "duration 0.1; U0 (0 0 a);", "inlet/U0 is '(0 0 a)'. Allowed: a vector (x y z)."),
    (
        "duration 0.1;",
        "duration 0.1; massTotal 1;",
        "inlet/massTotal is '1'. Allowed: 0.0 (particles are single",
    ),
    (
        "duration 0.1;",
        "duration 0.1; nParticle 9;",
        "inlet/nParticle is '9'. Allowed: 1.0 (particles are single",
    ),
    (
        "duration 0.1;",
        "duration 0.1; flowRateProfile table ((0 1) (1 2));",
        "is 'table ((0 1) (1 2))'. Allowed: con",
    ),
    ("patch inlet;", "patch in let;", "inlet/patch is 'in let'. Allowed: a word."),
    ("patchInjection", 'manualInjection; positionsFile "no"', "inlet/patch is not known"),
    ("value 5e-6;", "", "inlet/sizeDistribution/fixedValueDistribution/value is missing"),
    ("fixedValueDistribution { value 5e-6; }", "", "sizeDistribution/fixedValueDistribution is missing"),
    ("type fixedValue;", "type norml;", "inlet/sizeDistribution/type is 'norml'. Did you mean 'normal'?"),
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
    ("type escape", "type escpae", "patches/(inlet|outlet)/type is 'escpae'. Did you mean 'escape'?"),
    ("type stick", "type rebound; e 2", "patches/wall/e is '2'. Allowed: a number from 0 to 1."),
    ("type stick", "type stick; e 1", "patches/wall/e is not known. Allowed: type."),
    ("(inlet|outlet)", "(inlet|outlet", "patches/(inlet|outlet is not a regular expression"),
    ("patches (", "touching edge; patches (", "touching is 'edge'. Allowed: centre, ellipsoid."),
    (
        "FoamFile",
        "cloudFunctions { facePostProcessing { } } FoamFile",
        "cloudFunctions/facePostProcessing/type is missing. Allowed: particleCollector, ",
    ),
    ("FoamFile", "colour blue; FoamFile", "line 2: colour is not known. "),
    ("solution\n{", "solution 3; other {", "line 3: other is not known"),
]


@pytest.mark.parametrize(("old", "new", "message"), MISTAKES)
def test_a_mistake_gives_its_one_message(read: Reader, old: str, new: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read((old, new))
    assert str(caught.value).startswith("constant/softCloudProperties, line ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_no_injection_model(read: Reader) -> None:
    text = CLOUD[CLOUD.index("        inlet\n") : CLOUD.index("    }\n    patchInter")]
    with pytest.raises(InputError, match="subModels/injectionModels is empty"):
        read((text, ""))


def test_files_that_are_missing(case: Path, read: Reader) -> None:
    with pytest.raises(InputError, match=r"^constant/softCloudProperties: No such file or directory \(case "):
        read_settings(case)
    (case / "constant/g").unlink()
    read()
    with pytest.raises(InputError, match=r"^constant/g: No such file"):
        read(("ellipsoidDrag;", "ellipsoidDrag; gravity;"))
    with pytest.raises(
        InputError, match=r"inlet/positionsFile is '\"no\"'\. Allowed: the name of an existing"
    ):
        read(
            (
                "patchInjection; patch inlet; parcelsPerSecond 1000; duration 0.1;",
                'manualInjection; positionsFile "no";',
            )
        )


# Stiffness


@pytest.mark.parametrize(
    ("stiffness", "mu", "rate"),
    [
        ("shearModulus 1000;", 1000.0, None),
        ("shearModulus 1000; referenceShearRate 900;", 1000.0, 900.0),
        ("youngsModulus 2800;", 1000.0, None),
        ("Ca 0.5; referenceShearRate 1000;", 1.208 * 1.5e-5 * 1000.0 / 0.5, 1000.0),
    ],
)
def test_stiffness(read: Reader, stiffness: str, mu: float, rate: float | None) -> None:
    solid = read(("shearModulus 1000;", stiffness)).injections[0].solid
    assert solid.type == "neoHooke"
    assert solid.shear_modulus == pytest.approx(mu, rel=1e-14)
    assert solid.poissons_ratio == 0.4
    assert solid.reference_shear_rate == rate


def test_an_injection_models_solid_replaces_entries_of_the_clouds(read: Reader) -> None:
    def solid(cloud: str, own: str) -> tuple[float, float, float | None]:
        settings = read(
            ("poissonsRatio 0.4; shearModulus 1000;", cloud),
            ("patch inlet;", f"patch inlet; rho0 900; solid {{ {own} }}"),
        )
        assert settings.injections[0].rho == 900.0
        result = settings.injections[0].solid
        return result.shear_modulus, result.poissons_ratio, result.reference_shear_rate

    mu = Fluid(1.208, 1.5e-5).mu
    common = "poissonsRatio 0.4; referenceShearRate 100; "
    assert solid(common + "Ca 1;", "Ca 0.25;") == pytest.approx((400.0 * mu, 0.4, 100.0))
    assert solid(common + "shearModulus 5;", "Ca 0.25;") == pytest.approx((400.0 * mu, 0.4, 100.0))
    assert solid(common + "Ca 1;", "shearModulus 7;") == pytest.approx((7.0, 0.4, 100.0))
    assert solid(common + "Ca 1;", "poissonsRatio 0.25;") == pytest.approx((100.0 * mu, 0.25, 100.0))
    assert solid(common, "Ca 2; referenceShearRate 50;") == pytest.approx((25.0 * mu, 0.4, 50.0))
    with pytest.raises(InputError, match="injectionModels/inlet/solid/referenceShearRate is missing"):
        solid("poissonsRatio 0.4; shearModulus 5;", "Ca 2;")
    with pytest.raises(InputError, match="injectionModels/inlet/solid gives shearModulus and youngsModulus"):
        solid(common + "Ca 1;", "youngsModulus 1; shearModulus 7;")


# Populations

NORMAL = "type normal; normalDistribution { expectation 1000; variance 200; minValue 300; maxValue 3000; }"
EXPECTED = Normal(minValue=300.0, maxValue=3000.0, expectation=1000.0, variance=200.0)


def test_stiffness_and_density_may_be_distributed(read: Reader) -> None:
    fixed = "type fixedValue;"
    (inlet,) = read(("shearModulus 1000;", f"shearModulus {{ {NORMAL} }}")).injections
    assert inlet.solid.shear_modulus == EXPECTED
    (inlet,) = read(("shearModulus 1000;", f"youngsModulus {{ {NORMAL} }}")).injections
    assert inlet.solid.shear_modulus == Scaled(EXPECTED, pytest.approx(1.0 / 2.8))
    (inlet,) = read(("shearModulus 1000;", f"referenceShearRate 50; Ca {{ {NORMAL} }}")).injections
    assert inlet.solid.shear_modulus == Scaled(EXPECTED, pytest.approx(50.0 * 1.208 * 1.5e-5), -1)
    (inlet,) = read(("rho0            2560;", f"rho0 {{ {NORMAL} }}")).injections
    assert inlet.rho == EXPECTED
    (inlet,) = read(("patch inlet;", f"patch inlet; rho0 {{ {NORMAL} }}")).injections
    assert inlet.rho == EXPECTED
    (inlet,) = read(("poissonsRatio", f"viscosity {{ {NORMAL} }} surfaceTension 3; poissonsRatio")).injections
    assert (inlet.solid.viscosity, inlet.solid.surface_tension) == (EXPECTED, 3.0)
    (inlet,) = read((f"{fixed} fixedValueDistribution {{ value 5e-6; }}", NORMAL)).injections
    assert inlet.size == EXPECTED


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ("type uniform; uniformDistribution { minValue 1; maxValue 2; }", Uniform(1.0, 2.0)),
        (
            "type RosinRammler; RosinRammlerDistribution { minValue 1; maxValue 2; d 3; n 0.5; }",
            RosinRammler(1.0, 2.0, 3.0, 0.5),
        ),
        (
            "type general; generalDistribution { distribution ( (1 0.5) (2 3) ); }",
            General(((1.0, 0.5), (2.0, 3.0))),
        ),
        (
            "type general; generalDistribution { distribution 2((1 0.5)(2 3)); }",
            General(((1.0, 0.5), (2.0, 3.0))),
        ),
    ],
)
def test_distributions(read: Reader, size: str, expected: object) -> None:
    old = "type fixedValue; fixedValueDistribution { value 5e-6; }"
    assert read((old, size)).injections[0].size == expected


@pytest.mark.parametrize(
    ("size", "message"),
    [
        ("type uniform; uniformDistribution { minValue 2; maxValue 1; }", "minValue 2, which is not below"),
        (
            "type uniform; uniformDistribution { minValue 0; maxValue 1; }",
            "begins at 0. Allowed: values > 0.",
        ),
        ("type fixedValue; fixedValueDistribution { value -1; }", "begins at -1. Allowed: values > 0."),
        ("type uniform; uniformDistribution { minValue 2; }", "uniformDistribution/maxValue is missing"),
        ("type uniform;", "sizeDistribution/uniformDistribution is missing. Allowed: a dictionary"),
        (
            "type normal; normalDistribution { minValue 1; maxValue 2; expectation 1; variance 0; }",
            "variance is '0'. Allowed: a number > 0.",
        ),
        (
            "type general; generalDistribution { distribution ((1 2 3)); }",
            "distribution is '((1 2 3))'. Allowed: a list of pairs",
        ),
        ("type general; generalDistribution { distribution ((1 2)); }", "needs two pairs"),
        ("type general; generalDistribution { distribution 3; }", "Allowed: a list of pairs"),
        ("type general; generalDistribution { distribution ((1 2)) (; }", "no closing )"),
    ],
)
def test_a_wrong_distribution_has_its_message(read: Reader, size: str, message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read(("type fixedValue; fixedValueDistribution { value 5e-6; }", size))
    assert str(caught.value).startswith("constant/softCloudProperties, line ")


# Injection models

PATCH_INJECTION = "patchInjection; patch inlet; parcelsPerSecond 1000; duration 0.1;"
CONE = (
    "coneInjection; SOI 0.5; duration 2; parcelsPerInjector 20; flowRateProfile constant 1; "
    "positionAxis ( ((0.3 0.35 1.45) (0 0 -1)) ((0.6 0.35 1.45) (0 1 0)) ); "
    "Umag constant 3.0; thetaInner 0; thetaOuter constant 45;"
)


def test_cell_zone_injection(read: Reader) -> None:
    zone = "cellZoneInjection; cellZone drop; numberDensity 1e9; U0 (0 0 1); SOI 0.25;"
    model = read((PATCH_INJECTION, zone)).injections[0].model
    assert model == CellZoneInjection("drop", 1e9, U0=(0.0, 0.0, 1.0), SOI=0.25)


def test_cone_injection(read: Reader) -> None:
    axes = (((0.3, 0.35, 1.45), (0.0, 0.0, -1.0)), ((0.6, 0.35, 1.45), (0.0, 1.0, 0.0)))
    model = read((PATCH_INJECTION, CONE)).injections[0].model
    assert model == ConeInjection(axes, 2.0, 20.0, 3.0, 0.0, 45.0, SOI=0.5)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("Umag constant 3.0", "Umag table ((0 1) (1 2))", "Allowed: a number >= 0, constant in time."),
        ("thetaInner 0", "thetaInner -1", "an angle from 0 to 180 degrees"),
        ("(0 1 0)) )", "(0 1)) )", "a list of positions with an axis"),
        ("(0 1 0)) )", "(0 0 0)) )", "inlet has an axis (0 0 0) in positionAxis."),
        ("flowRateProfile constant 1", "flowRateProfile constant 2", "Allowed: constant 1 ("),
        ("SOI 0.5", "SOI -1", "inlet/SOI is '-1'. Allowed: a number >= 0"),
    ],
)
def test_a_wrong_cone_has_its_message(read: Reader, old: str, new: str, message: str) -> None:
    assert CONE.count(old) == 1
    with pytest.raises(InputError, match=re.escape(message)):
        read((PATCH_INJECTION, CONE.replace(old, new)))


def test_viscosity_and_surface_tension(read: Reader) -> None:
    plain = read().injections[0].solid
    assert (plain.viscosity, plain.surface_tension) == (0.0, 0.0)
    solid = read(("shearModulus 1000;", "shearModulus 1000; viscosity 2e-3; surfaceTension 0.01;"))
    assert solid.injections[0].solid.viscosity == 2e-3
    assert solid.injections[0].solid.surface_tension == 0.01
    with pytest.raises(InputError, match=r"solid/viscosity is '-1'. Allowed: a number >= 0"):
        read(("shearModulus 1000;", "shearModulus 1000; viscosity -1;"))


def test_shapes(read: Reader) -> None:
    assert read().injections[0].shape == Sphere()
    own = "shape { type ellipsoid; axisRatios (2 1 1); e1 (0 0 3); e2 (1 0 1); }"
    shape = read(
        ("rho0            2560;", "rho0 2560; shape { type ellipsoid; axisRatios (3 2 1); }"),
        ("patch inlet;", f"patch inlet; {own}"),
    ).injections[0].shape  # fmt: skip
    assert isinstance(shape, Ellipsoid)
    assert shape.axisRatios == (2.0, 1.0, 1.0)
    np.testing.assert_allclose(shape.axes(), [[0, 0, 1], [1, 0, 0], [0, 1, 0]], atol=1e-15)
    with pytest.raises(InputError, match=r"shape/axisRatios is '\(2 0 1\)'. Allowed: .* each a number > 0"):
        read(("patch inlet;", f"patch inlet; {own.replace('(2 1 1)', '(2 0 1)')}"))
    with pytest.raises(InputError, match="inlet/shape gives no orientation: e1 and e2 are parallel"):
        read(("patch inlet;", f"patch inlet; {own.replace('(1 0 1)', '(0 0 -1)')}"))
    with pytest.raises(InputError, match="Did you mean 'ellipsoid'"):
        read(("patch inlet;", f"patch inlet; {own.replace('type ellipsoid', 'type elipsoid')}"))


def test_forces(read: Reader) -> None:
    assert read().forces == {}
    settings = read(("ellipsoidDrag;", "virtualMass { Cvm 0.5; } ellipsoidDrag; pressureGradient { U U; }"))
    # In the order of the registry.
    both = [("pressureGradient", PressureGradient()), ("virtualMass", VirtualMass(Cvm=0.5))]
    assert list(settings.forces.items()) == both
    with pytest.raises(InputError, match="virtualMass/Cvm is missing"):
        read(("ellipsoidDrag;", "ellipsoidDrag; virtualMass;"))


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
        ("nu [0 1 -1 0 0 0 0] 1e-5;", "nu is '[0 1 -1 0 0 0 0] 1e-5'. Allowed: a number > 0."),
        ('nu #calc "1e-5";', "nu is '#calc \"1e-5\"', which is not evaluated: write the value itself."),
        ("transportModel Newtonian;", "transportProperties: nu is missing"),
        ("transportModel CrossPowerLaw; nu 1e-5;", "transportModel is 'CrossPowerLaw'. Allowed: Newtonian."),
    ],
)
def test_viscosity_mistakes(case: Path, read: Reader, text: str, message: str) -> None:
    (case / "constant/transportProperties").write_text(text)
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read()
    assert str(caught.value).startswith("constant/transportProperties")


# Dictionaries: values


@dataclass(frozen=True)
class Values:
    number: float
    vector: tuple[float, float, float]
    whole: int
    switch: bool
    word: str


finite = st.floats(allow_nan=False, allow_infinity=False)


@given(
    st.builds(
        Values,
        finite,
        st.tuples(finite, finite, finite),
        st.integers(-(10**17), 10**17),
        st.booleans(),
        st.from_regex(r"[A-Za-z_][A-Za-z0-9_:.-]*", fullmatch=True),
    ),
    st.sampled_from([" ", "\n", " // comment; }\n", "/* a\n{ */"]),
)
def test_written_values_are_read_back(
    tmp_path_factory: pytest.TempPathFactory, values: Values, gap: str
) -> None:
    x, y, z = values.vector
    words = [
        "number",
        repr(values.number),
        ";vector",
        f"({x!r}",
        repr(y),
        f"{z!r})",
        ";whole",
        str(values.whole),
    ]
    words += [";switch", "on" if values.switch else "no", ";word", values.word, ";"]
    root = dictionary(tmp_path_factory.getbasetemp(), gap.join(words))
    assert read_entries(Values, root) == values


def test_a_whole_number_has_no_fraction(tmp_path: Path) -> None:
    root = dictionary(tmp_path, "number 1; vector (0 0 0); whole 1.5; switch on; word a;")
    with pytest.raises(InputError, match=r"dictionary, line 1: whole is '1\.5'\. Allowed: a whole number\."):
        read_entries(Values, root)


@given(st.text(st.sampled_from('abc1.$:#{}()[];"/*\\ \n')) | st.text())
def test_any_text_is_read_or_refused(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = tmp_path_factory.getbasetemp()
    (folder / "dictionary").write_bytes(text.encode("utf-8", errors="surrogatepass"))
    with contextlib.suppress(InputError):
        read_dictionary(folder / "dictionary", folder)


# Dictionaries: grammar


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", {}),
        ("a 1; a 2;", {"a": "2"}),
        ("a { b 1; c 1; } a { b 2; }", {"a": {"b": "2", "c": "1"}}),
        ("a { b 1; } a 2;", {"a": "2"}),
        ("a; b { };", {"a": "", "b": {}}),
        ("a b c ( d e );", {"a": "b c ( d e )"}),
        ('"a.*" "b;}";', {'"a.*"': '"b;}"'}),
        ("a 1; b $a; c ${a}; d ($a 0 $a);", {"a": "1", "b": "1", "c": "1", "d": "( 1 0 1 )"}),
        ("a 1; b { c $a; a 2; d $a; }", {"a": "1", "b": {"c": "1", "a": "2", "d": "2"}}),
        ("a { x 1; } b $a; a { x 2; } c $a.x;", {"a": {"x": "2"}, "b": {"x": "1"}, "c": "2"}),
        ("a { x 1; y 1; } b { y 0; $a; x 2; }", {"a": {"x": "1", "y": "1"}, "b": {"y": "1", "x": "2"}}),
        (
            "x 1; a { x 2; b { p $:x; q $..x; r $x; } } c $:a.x;",
            {"x": "1", "a": {"x": "2", "b": {"p": "1", "q": "2", "r": "2"}}, "c": "2"},
        ),
        ("x 1; a { x 2; b $.x; }", {"x": "1", "a": {"x": "2", "b": "2"}}),
        ("a { b 1; c $b; } a { d 1; }", {"a": {"b": "1", "c": "1", "d": "1"}}),
        ("a.b 1; c $a.b;", {"a.b": "1", "c": "1"}),
    ],
)
def test_macros_and_duplicates(tmp_path: Path, text: str, expected: object) -> None:
    root = dictionary(tmp_path, text)
    assert tree(root) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a\n{ b 1;\n", "line 2: '{' of a has no closing }."),
        ("a 1;\n}", "line 2: '}' stands where a key is expected."),
        ("a 1;\nb 2", "line 2: 'b' has no closing ;."),
        ("a 1\nb { }", "line 1: 'a' has no closing ;."),
        ("a { b 1 }", "line 1: 'b' has no closing ;."),
        ("a (1 2;\nb 2;", "line 1: 'a' has no closing )."),
        ("a (1 2];", "line 1: 'a' has no closing )."),
        ('a 1;\nb "c;\n', "line 2: this string has no end."),
        ("a 1; /* b\n", "line 1: this comment has no end."),
        ("a ( b { } c 1 );", "line 1: 'c' in the list a is not a name with its dictionary { … }."),
        ("a ( b { } )", "line 1: 'a' has no closing ;."),
        ("\na $b;", "line 2: '$b' is not defined above."),
        ("a { $b; } b { }", "line 1: '$b' is not defined above."),
        ("a 1; b { c $..d; }", "line 1: '$..d' is not defined above."),
        ("a 1; b { c $.a; }", "line 1: '$.a' is not defined above."),
        ("a { b 1; c $:a.b; }", "line 1: '$:a.b' is not defined above."),
        ("a 1; $a;", "line 1: '$a' stands where a key is expected, but is '1', not a dictionary."),
        ("a { } b (0 $a 0);", "line 1: '$a' is a dictionary, and cannot stand within a value."),
        ("a { } b { $a } c 1;", "line 1: '$a' has no closing ;."),
        ("#inputMode merge", "line 1: '#inputMode' is not supported. Did you mean"),
        ("a 1;\n#calc 2;", "line 2: '#calc' is not supported."),
        ("#codeStream { code #{ x; #}; };", "line 1: '#codeStream' is not supported."),
        ("#include", "line 1: '#include' names no file."),
        ('#include "gone"', "line 1: '\"gone\"' cannot be included: No such file or directory."),
        ('#include "dictionary"', "line 1: '\"dictionary\"' includes itself."),
    ],
)
def test_syntax_errors(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        dictionary(tmp_path, text)
    assert str(caught.value).startswith(f"dictionary, {message}")


def test_a_computed_value_is_refused_where_it_is_needed(read: Reader) -> None:
    with pytest.raises(InputError, match=r"solution/deltaT is '#calc .*', which is not evaluated"):
        read(("2e-05", '#calc "1e-5*2"'))
    with pytest.raises(InputError, match=r"solution/deltaT is '#eval \{ 1e-5\*2 \}', which is not evaluated"):
        read(("2e-05", "$dt"), ("FoamFile", "dt #eval{ 1e-5*2 }; FoamFile"))


def test_a_macros_variable_may_have_any_name(read: Reader) -> None:
    settings = read(("FoamFile", "size 2e-6; FoamFile"), ("value 5e-6;", "value $size;"))
    assert settings.injections[0].size.value == 2e-6
    settings = read(
        ("injectionModels\n    {", "injectionModels { size 2e-6;"), ("value 5e-6;", "value $size;")
    )
    assert len(settings.injections) == 1
    settings = read(
        ("deltaT          2e-05;", "one 1e-5; two { one $one; deltaT $one; three $one; } deltaT $two.deltaT;")
    )
    assert settings.solution.deltaT == 1e-5


def test_includes(case: Path, read: Reader) -> None:
    (case / "shared").mkdir()
    (case / "shared/time").write_text('FoamFile { } #include "step"\nendTime 2;')
    (case / "shared/step").write_text("deltaT 0.5;")
    (case / "system").mkdir()
    (case / "system/step").write_text("deltaT 0.25;")
    lines = ("deltaT          2e-05;\n    endTime         0.4;", "{}")

    def deltaT(text: str) -> float:
        return read((lines[0], text)).solution.deltaT

    assert deltaT('#include "../shared/time"') == 0.5
    assert deltaT('#include "../shared/time"\n deltaT 0.1;') == 0.1
    assert deltaT('endTime 2; #include "<system>/step"') == 0.25
    assert deltaT('endTime 2; #include "$FOAM_CASE/system/step"') == 0.25
    assert deltaT('endTime 2; deltaT 0.1; #includeIfPresent "none"') == 0.1
    assert deltaT('endTime 2; deltaT 0.1; #sinclude "../system/step"') == 0.25
    (case / "shared/step").write_text("\ndeltat 0.5;")
    with pytest.raises(
        InputError, match=r"^shared/step, line 2: solution/deltat is not known\. Did you mean"
    ):
        deltaT('#include "../shared/time"')
    (case / "shared/step").write_text('#include "time"')
    with pytest.raises(InputError, match=r"^shared/step, line 1: '\"time\"' includes itself"):
        deltaT('#include "../shared/time"')


# Patches


class Patch(NamedTuple):
    name: str
    type: str = "patch"
    neighbour: str = ""


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        (
            [PatchRule("in", Stick()), PatchRule("out", Escape()), PatchRule("side", Stick())],
            [Stick(), Escape(), Stick()],
        ),
        (
            [PatchRule("side|.*n", Stick(), regex=True), PatchRule("out", Escape())],
            [Stick(), Escape(), Stick()],
        ),
        ([PatchRule("out", Escape()), PatchRule(".*", Stick(), regex=True)], [Stick(), Escape(), Stick()]),
        ([PatchRule(".*", Stick(), regex=True), PatchRule("out", Escape())], [Stick(), Stick(), Stick()]),
        (
            [PatchRule("(in|out)", Escape(), regex=True), PatchRule("wall", Stick())],
            [Escape(), Escape(), Stick()],
        ),
    ],
)
def test_the_first_rule_that_matches_counts(rules: list[PatchRule], expected: list[object]) -> None:
    assert match_patches(rules, [Patch("in"), Patch("out"), Patch("side", "wall")]) == expected


def test_patches_of_a_constraint_type() -> None:
    planes = [Patch(name, name) for name in ("empty", "symmetry", "symmetryPlane", "wedge")]
    assert match_patches([], planes) == [Mirror()] * 4
    assert match_patches([PatchRule("symmetry", Stick())], planes)[1] == Stick()
    assert match_patches([PatchRule("wall", Stick())], [Patch("to_solid", "mappedWall")]) == [Stick()]
    for kind in ("cyclic", "wedge"):
        pair = [Patch("left", kind, "right"), Patch("right", kind, "left")]
        assert match_patches([], pair) == [Cyclic()] * 2
    with pytest.raises(InputError, match="the cyclic patch 'left' names no neighbourPatch"):
        match_patches([], [Patch("left", "cyclic")])
    with pytest.raises(InputError, match="cannot pass through 'left', a patch of type cyclicAMI"):
        match_patches([], [Patch("left", "cyclicAMI", "right")])
    assert match_patches([PatchRule("left", Escape())], [Patch("left", "cyclicAMI")]) == [Escape()]


def test_standard_wall_interaction(read: Reader) -> None:
    """Walls do what the entries say, open patches let through, constraint types keep their meaning."""
    text = CLOUD[CLOUD.index("    patchInteractionModel") : CLOUD.rindex("}")]
    settings = read(
        (
            text,
            "patchInteractionModel standardWallInteraction; localInteractionCoeffs { } "
            "standardWallInteractionCoeffs { type rebound; e 0.97; mu 0.09; touching centre; }",
        )
    )
    assert (settings.interaction, settings.touching) == ("standardWallInteraction", "centre")
    patches = [
        Patch("wall"),
        Patch("side", "wall"),
        Patch("mid", "symmetryPlane"),
        Patch("out", "mappedPatch"),
    ]
    bounce = Rebound(e=0.97, mu=0.09)
    assert match_patches(settings.patches, patches) == [Escape(), bounce, Mirror(), Escape()]
    with pytest.raises(InputError, match="names no neighbourPatch"):
        match_patches(settings.patches, [Patch("left", "cyclic")])


def test_rebound_from_every_patch(read: Reader) -> None:
    text = CLOUD[CLOUD.index("    patchInteractionModel") : CLOUD.rindex("}")]
    settings = read((text, "patchInteractionModel rebound; reboundCoeffs { UFactor 0.8; }"))
    patches = [Patch("in"), Patch("side", "wall"), Patch("mid", "symmetryPlane")]
    assert match_patches(settings.patches, patches) == [Rebound(e=pytest.approx(0.6))] * 3
    with pytest.raises(InputError, match=r"UFactor is '0\.4'\. Allowed: a number from 0\.5 to 1"):
        read((text, "patchInteractionModel rebound; reboundCoeffs { UFactor 0.4; }"))


@pytest.mark.parametrize(
    ("rule", "message"),
    [
        (
            PatchRule("inlt", Stick()),
            "patches/inlt matches no patch. Did you mean 'inlet'? Allowed: inlet, outlet.",
        ),
        (PatchRule("in", Stick(), regex=True), "patches/in matches no patch."),
        (PatchRule("in.*", Stick()), "patches/in.* matches no patch."),
        (PatchRule("inlet", Stick()), "patches has no entry for the patch 'outlet'."),
    ],
)
def test_patches_without_a_rule_and_rules_without_a_patch(rule: PatchRule, message: str) -> None:
    with pytest.raises(InputError) as caught:
        match_patches([rule], [Patch("inlet"), Patch("outlet")])
    assert str(caught.value).startswith(
        "constant/softCloudProperties: subModels/localInteractionCoeffs/" + message
    )


# Positions


@given(
    st.lists(st.tuples(finite, finite, finite)),
    st.booleans(),
    st.sampled_from(["", "// (1 2 3)\n", "/*\n*/ "]),
)
def test_written_positions_are_read_back(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float, float, float]],
    counted: bool,
    comment: str,
) -> None:
    path = tmp_path_factory.getbasetemp() / "positions"
    body = "\n".join(f"({x!r} {y!r}\t{z!r} ) {comment}" for x, y, z in rows)
    path.write_text(
        f"FoamFile {{ class vectorField; }}\n{comment}{len(rows) if counted else ''}\n(\n{body})\n{comment}"
    )
    positions = read_positions(path)
    assert positions.shape == (len(rows), 3)
    assert positions.dtype == np.float64
    np.testing.assert_array_equal(positions, np.array(rows, dtype=float).reshape(-1, 3))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("(\n(0 0 0)\n(0 0)\n)", r"line 3: found '\(0 0\)'\. Expected: \(x y z\), three numbers"),
        ("(\n(0 0 nan)\n)", r"line 2: found '\(0 0 nan\)'"),
        (
            "(\n(0 0 0)\n(0 1e400 0)\n)",
            r"line 3: found '\(0 1e400 0\)'\. Expected: \(x y z\), three finite numbers",
        ),
        ("(\n(0 0 0)\n", "line 3: found 'the end of the file'"),
        ("((0 0 0))\n(1 1 1)", "line 2: found .*Expected: nothing after the list"),
        ("\n3 ((0 0 0) (1 1 1))", r"line 2: .*The list holds 2 positions\."),
        ("(0 0 0)", "line 1: found '0 0 0"),
        ("", "line 1: found 'the end of the file'. Expected: a list"),
        ("FoamFile { }\nuniform (0 0 0);", "line 2: found 'uniform"),
    ],
)
def test_positions_mistakes(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "positions").write_text(text)
    with pytest.raises(InputError, match=f"^{re.escape(str(tmp_path))}/positions, {message}"):
        read_positions(tmp_path / "positions")


def test_positions_file_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none: No such file or directory"):
        read_positions(tmp_path / "none")


def test_a_broken_row_late_in_a_long_file_is_found_at_once(tmp_path: Path) -> None:
    (tmp_path / "positions").write_text("(" + "(0 1 2)\n" * 100_000 + "(0 1\n)")
    with pytest.raises(InputError, match="line 100001: found"):
        read_positions(tmp_path / "positions")


# The case in the tree


def test_the_pipes_settings(tmp_path: Path) -> None:
    shutil.copytree(PIPE / "constant", tmp_path / "constant", ignore=shutil.ignore_patterns("polyMesh"))
    settings = read_settings(tmp_path)
    Ca = {
        injection.name: settings.fluid.mu
        * (injection.solid.reference_shear_rate or 0.0)
        / injection.solid.shear_modulus
        for injection in settings.injections
    }
    expected = {"Ca00001": 0.0001, "Ca025": 0.25, "Ca05": 0.5, "Ca075": 0.75, "Ca1": 1.0, "inlet": 0.5}
    assert Ca == pytest.approx(expected)
    *points, inlet = (injection.model for injection in settings.injections)
    assert isinstance(inlet, PatchInjection)
    assert inlet.U0 is None
    assert inlet.parcelsPerSecond * inlet.duration == pytest.approx(300.0)
    for point in points:
        assert isinstance(point, ManualInjection)
        np.testing.assert_array_equal(read_positions(point.positionsFile), [[0.0, -0.00165, 0.0]])
    assert settings.gravity == (0.0, -9.81, 0.0)
    match_patches(settings.patches, [Patch("inlet"), Patch("outlet"), Patch("wall", "wall")])


@pytest.mark.parametrize(
    "file",
    ["constant/g", "constant/transportProperties", "system/fvSolution", "constant/softCloudProperties"],
)
def test_dictionary_agrees_with_foamlib(file):
    """An independent parser finds the same keys and numbers where no macro is used."""
    ours = read_dictionary(PIPE / file, PIPE)

    def compare(entries, expected):
        for key, value in expected.items():
            if key is None or key == "FoamFile" or key.startswith("$"):
                continue
            entry = entries[key]
            if isinstance(value, Mapping):
                compare(entry.dictionary().entries, value)
            elif isinstance(value, int | float) and not isinstance(value, bool):
                assert float(entry.text) == value

    compare(ours.entries, FoamFile(PIPE / file).as_dict())


def test_a_solid_reads_its_third_parameter(read: Reader) -> None:
    settings = read(("type neoHooke;", "type gent; stretchLimit 30;"))
    assert settings.injections[0].solid.parameter == 30.0
    assert read(("type neoHooke;", "type saintVenantKirchhoff;")).injections[0].solid.parameter == 0.0


@pytest.mark.parametrize(
    ("solid", "message"),
    [
        ("type gent;", "stretchLimit is missing"),
        ("type gent; stretchLimit -1;", "a number > 0"),
        ("type gent; mooneyRatio 0.5; stretchLimit 30;", "which the solid gent does not have"),
        ("type mooneyRivlin; mooneyRatio 1.5;", "a number > 0 and <= 1"),
        ("type neoHooke; stretchLimit 30;", "which the solid neoHooke does not have"),
    ],
)
def test_a_wrong_third_parameter_has_its_message(read: Reader, solid: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read(("type neoHooke;", solid))
    assert message in str(caught.value)


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
        "spread": ParticleHistogram(fields=("shearExposure",), nBins=7, sampleInterval=10),
    }


@pytest.mark.parametrize(
    ("function", "message"),
    [
        ("f { type particleTrack; }", "f/type is 'particleTrack'. Did you mean 'particleTracks'?"),
        (
            "f { type particleTracks; maxSamples 5; }",
            "f/trackInterval is missing. Allowed: a whole number >= 1.",
        ),
        (
            "f { type particleTracks; trackInterval 0; maxSamples 5; }",
            "is '0'. Allowed: a whole number >= 1.",
        ),
        ("f { type particleTracks; trackInterval 1.5; maxSamples 5; }", "is '1.5'. Allowed: a whole number"),
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
        ('"a/b" { type particleHistogram; }', "cloudFunctions/a/b is no name of a folder"),
        ("f;", "cloudFunctions/f/type is missing"),
    ],
)
def test_a_wrong_cloud_function_has_its_message(read: Reader, function: str, message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read(("solution", f"cloudFunctions {{ {function} }} solution"))
    assert str(caught.value).startswith("constant/softCloudProperties, line ")


def test_the_documentation_names_every_entry() -> None:
    text = (ROOT / "docs/settings.md").read_text()
    code = re.findall(r"`([^`]+)`", text.replace("```", "`"))
    words = set(re.findall(r"[A-Za-z]\w*", " ".join(code)))
    private = [r for name, r in vars(settings_module).items() if name.startswith("_")]
    records = [r for r in private if isinstance(r, type) and is_dataclass(r)]
    registries = (DISTRIBUTIONS, FUNCTIONS, INJECTIONS, INTERACTIONS, SHAPES)
    for registry in registries:
        records += registry.values()
    entries = {field.name for record in records for field in fields(record)}
    entries |= {name for registry in (*registries, INTERACTION_MODELS) for name in registry}
    # The coefficients of the patch interaction models stand under one name.
    missing = {name for name in entries - words if not name.endswith("Coeffs")}
    assert missing == set()
    assert len(entries) > 90
