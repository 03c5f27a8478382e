"""What the particles are that a cloud's dictionary asks for: solids, populations, shapes, places."""

from __future__ import annotations

import numpy as np
import pytest
from cloud_dictionary import Reader, unexpected

from foamprb.cloud.injection.distribution import General, Normal, RosinRammler, Scaled, Uniform
from foamprb.cloud.injection.models import CellZoneInjection, ConeInjection
from foamprb.cloud.injection.shapes import Ellipsoid, Sphere
from foamprb.errors import InputError
from foamprb.settings.fluid import Fluid

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
    assert solid.shearModulus == pytest.approx(mu, rel=1e-14, abs=0.0)
    assert solid.poissonsRatio == 0.4
    assert solid.referenceShearRate == rate


def test_an_injection_models_solid_replaces_entries_of_the_clouds(read: Reader) -> None:
    def solid(cloud: str, own: str) -> tuple[float, float, float | None]:
        settings = read(
            ("poissonsRatio 0.4; shearModulus 1000;", cloud),
            ("patch inlet;", f"patch inlet; rho0 900; solid {{ {own} }}"),
        )
        assert settings.injections[0].rho0 == 900.0
        result = settings.injections[0].solid
        return result.shearModulus, result.poissonsRatio, result.referenceShearRate

    mu = Fluid(1.208, 1.5e-5).mu
    common = "poissonsRatio 0.4; referenceShearRate 100; "
    assert solid(common + "Ca 1;", "Ca 0.25;") == pytest.approx((400.0 * mu, 0.4, 100.0))
    assert solid(common + "shearModulus 5;", "Ca 0.25;") == pytest.approx((400.0 * mu, 0.4, 100.0))
    assert solid(common + "Ca 1;", "shearModulus 7;") == pytest.approx((7.0, 0.4, 100.0))
    assert solid(common + "Ca 1;", "poissonsRatio 0.25;") == pytest.approx((100.0 * mu, 0.25, 100.0))
    assert solid(common, "Ca 2; referenceShearRate 50;") == pytest.approx((25.0 * mu, 0.4, 50.0))
    assert solid(common + "Ca 1;", "bulkModulus 3;") == pytest.approx((100.0 * mu, None, 100.0))
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
    assert inlet.solid.shearModulus == EXPECTED
    (inlet,) = read(("shearModulus 1000;", f"youngsModulus {{ {NORMAL} }}")).injections
    assert inlet.solid.shearModulus == Scaled(EXPECTED, pytest.approx(1.0 / 2.8))
    (inlet,) = read(("shearModulus 1000;", f"referenceShearRate 50; Ca {{ {NORMAL} }}")).injections
    assert inlet.solid.shearModulus == Scaled(EXPECTED, pytest.approx(50.0 * 1.208 * 1.5e-5), -1)
    (inlet,) = read(("rho0            2560;", f"rho0 {{ {NORMAL} }}")).injections
    assert inlet.rho0 == EXPECTED
    (inlet,) = read(("patch inlet;", f"patch inlet; rho0 {{ {NORMAL} }}")).injections
    assert inlet.rho0 == EXPECTED
    (inlet,) = read(("poissonsRatio", f"viscosity {{ {NORMAL} }} surfaceTension 3; poissonsRatio")).injections
    assert (inlet.solid.viscosity, inlet.solid.surfaceTension) == (EXPECTED, 3.0)
    (inlet,) = read((f"{fixed} fixedValueDistribution {{ value 5e-6; }}", NORMAL)).injections
    assert inlet.sizeDistribution == EXPECTED


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
    assert read((old, size)).injections[0].sizeDistribution == expected


DISTRIBUTION_MISTAKES = [
    (
        "type uniform; uniformDistribution { minValue 0; maxValue 1; }",
        "begins at 0. Allowed: values > 0.",
    ),
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
    ("type general; generalDistribution { distribution 3; }", "Allowed: a list of pairs"),
    ("type general; generalDistribution { distribution ((1 2)) (; }", "no closing )"),
]


def test_each_wrong_distribution_has_its_message(read: Reader) -> None:
    old = "type fixedValue; fixedValueDistribution { value 5e-6; }"
    assert unexpected(read, [(old, own, message) for own, message in DISTRIBUTION_MISTAKES]) == []


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
    assert model == CellZoneInjection(cellZone="drop", numberDensity=1e9, U0=(0.0, 0.0, 1.0), SOI=0.25)


def test_injection_into_all_cells(read: Reader) -> None:
    zone = "cellZoneInjection; selectionMode all; numberDensity 1e9;"
    model = read((PATCH_INJECTION, zone)).injections[0].model
    assert model == CellZoneInjection(1e9, selectionMode="all")
    with pytest.raises(InputError, match=r"inlet has the cellZone drop, but selectionMode all\."):
        read((PATCH_INJECTION, f"{zone} cellZone drop;"))
    for wrong in (zone.replace("selectionMode all; ", ""), zone.replace("all", "cellZone")):
        with pytest.raises(InputError, match=r"inlet has no cellZone\. Allowed: the name of a zone, or sel"):
            read((PATCH_INJECTION, wrong))
    with pytest.raises(InputError, match=r"selectionMode is 'cells'\. Did you mean 'cellZone'"):
        read((PATCH_INJECTION, zone.replace("all", "cells")))


def test_cone_injection(read: Reader) -> None:
    axes = (((0.3, 0.35, 1.45), (0.0, 0.0, -1.0)), ((0.6, 0.35, 1.45), (0.0, 1.0, 0.0)))
    model = read((PATCH_INJECTION, CONE)).injections[0].model
    assert model == ConeInjection(axes, 2.0, 20.0, 3.0, 0.0, 45.0, SOI=0.5)


CONE_MISTAKES = [
    ("Umag constant 3.0", "Umag table ((0 1) (1 2))", "Allowed: a number >= 0, constant in time."),
    ("thetaInner 0", "thetaInner -1", "an angle from 0 to 180 degrees"),
    ("(0 1 0)) )", "(0 1)) )", "a list of positions with an axis"),
    ("(0 1 0)) )", "(0 0 0)) )", "inlet has an axis (0 0 0) in positionAxis."),
    ("flowRateProfile constant 1", "flowRateProfile constant 2", "Allowed: constant 1 ("),
    ("SOI 0.5", "SOI -1", "inlet/SOI is '-1'. Allowed: a number >= 0"),
]


def test_each_wrong_cone_has_its_message(read: Reader) -> None:
    mistakes = [(PATCH_INJECTION, CONE.replace(old, new), text) for old, new, text in CONE_MISTAKES]
    assert unexpected(read, mistakes) == []


def test_viscosity_and_surface_tension(read: Reader) -> None:
    plain = read().injections[0].solid
    assert (plain.viscosity, plain.surfaceTension) == (0.0, 0.0)
    solid = read(("shearModulus 1000;", "shearModulus 1000; viscosity 2e-3; surfaceTension 0.01;"))
    assert solid.injections[0].solid.viscosity == 2e-3
    assert solid.injections[0].solid.surfaceTension == 0.01
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


def test_a_solid_reads_its_third_parameter(read: Reader) -> None:
    settings = read(("type neoHooke;", "type gent; stretchLimit 30;"))
    assert settings.injections[0].parameter == 30.0
    assert read(("type neoHooke;", "type saintVenantKirchhoff;")).injections[0].parameter == 0.0


def test_a_drop_has_a_tension_and_a_viscosity_in_place_of_a_stiffness(read: Reader) -> None:
    def drop(entries: str) -> tuple[str, str]:
        return "type neoHooke; poissonsRatio 0.4; shearModulus 1000;", f"type drop; {entries}"

    solid = read(drop("surfaceTension 0.002; viscosity 0.01;")).injections[0].solid
    assert (solid.type, solid.surfaceTension, solid.viscosity) == ("drop", 0.002, 0.01)
    with pytest.raises(InputError, match="solid/viscosity is missing"):
        read(drop("surfaceTension 0.002;"))
    with pytest.raises(InputError, match="gives shearModulus, which the solid drop does not have"):
        read(drop("surfaceTension 0.002; viscosity 0.01; shearModulus 100;"))


def test_a_capsule_has_a_membrane_in_place_of_a_stiffness(read: Reader) -> None:
    def capsule(entries: str) -> tuple[str, str]:
        return "type neoHooke; poissonsRatio 0.4; shearModulus 1000;", f"type capsule; {entries}"

    both = "surfaceShearModulus 1e-3; surfacePoissonsRatio 0.5;"
    solid = read(capsule(both)).injections[0].solid
    assert (solid.surfaceShearModulus, solid.surfacePoissonsRatio) == (1e-3, 0.5)
    mu = read(capsule(both)).fluid.mu
    assert solid.viscosity == pytest.approx(mu)
    assert read(capsule(f"{both} viscosityRatio 5;")).injections[0].solid.viscosity == pytest.approx(5.0 * mu)
    assert read(capsule(f"{both} viscosity 0;")).injections[0].solid.viscosity == 0.0
    with pytest.raises(InputError, match="gives viscosity and viscosityRatio"):
        read(capsule(f"{both} viscosity 1e-3; viscosityRatio 5;"))
    with pytest.raises(InputError, match="solid/law is missing"):
        read(capsule("surfaceShearModulus 1e-3;"))
    assert solid.material == "capsule"
    solid = read(capsule("surfaceShearModulus 1e-3; law Skalak; C 2;")).injections[0].solid
    assert (solid.material, solid.surfacePoissonsRatio) == ("capsule Skalak 2", pytest.approx(2.0 / 3.0))
    with pytest.raises(InputError, match="gives surfacePoissonsRatio"):
        read(capsule(f"{both} law neoHookean;"))
    solid = read(capsule("law fluid; excessArea 0.5; bendingModulus 2e-19;")).injections[0].solid
    assert (solid.material, solid.excessArea, solid.viscosity) == ("capsule fluid", 0.5, pytest.approx(mu))
    with pytest.raises(InputError, match="gives surfaceShearModulus, which the solid capsule does not have"):
        read(capsule("law fluid; excessArea 0.5; surfaceShearModulus 1e-3;"))
    with pytest.raises(InputError, match="solid/C is missing"):
        read(capsule("surfaceShearModulus 1e-3; law Skalak;"))
    with pytest.raises(InputError, match="gives shearModulus, which the solid capsule does not have"):
        read(capsule(f"{both} shearModulus 100;"))
    with pytest.raises(InputError, match="which the solid neoHooke does not have"):
        read(("type neoHooke;", f"type neoHooke; {both}"))


PARAMETER_MISTAKES = [
    ("type gent;", "stretchLimit is missing"),
    ("type gent; stretchLimit -1;", "a number > 0"),
    ("type gent; mooneyRatio 0.5; stretchLimit 30;", "which the solid gent does not have"),
    ("type mooneyRivlin; mooneyRatio 1.5;", "a number > 0 and <= 1"),
    ("type neoHooke; stretchLimit 30;", "which the solid neoHooke does not have"),
]


def test_each_wrong_third_parameter_has_its_message(read: Reader) -> None:
    mistakes = [("type neoHooke;", solid, message) for solid, message in PARAMETER_MISTAKES]
    assert unexpected(read, mistakes) == []
