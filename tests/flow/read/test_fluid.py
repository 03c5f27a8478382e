"""Viscosity and density of the fluid, from the dictionaries of OpenFOAM's solvers and the field ``rho``."""

from __future__ import annotations

import re

import numpy as np
import pytest
from foam_writer import header, put_scalar
from transient_case import SETTINGS

from foamprb.body.viscosity import bird_carreau
from foamprb.errors import InputError
from foamprb.flow.read.fluid import (
    describe_viscosity,
    find_density,
    fluid_file,
    mean_field,
    phase_values,
    phases_of,
    read_density,
    read_viscosity,
)
from foamprb.settings.settings import read_settings

AIR = """
thermoType
{
    type heRhoThermo; mixture pureMixture; transport %s; thermo hConst; equationOfState %s; specie specie;
    energy sensibleEnthalpy;
}
mixture { specie { molWeight 28.9; } equationOfState { %s } transport { %s } }
"""
SUTHERLAND = AIR % ("sutherland", "perfectGas", "", "As 1.4792e-06; Ts 116;")


def write(case, name, text):
    path = case / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def viscosity(case, text, temperature=None, name="thermophysicalProperties"):
    return read_viscosity(write(case, f"constant/{name}", text), case, temperature)


def test_constant_viscosities(tmp_path):
    assert viscosity(tmp_path, "transportModel Newtonian; nu 1e-6;")[:2] == (1e-6, None)
    assert viscosity(tmp_path, "viscosityModel constant; nu [0 2 -1 0 0 0 0] 2e-6;")[:2] == (2e-6, None)
    air = AIR % ("const", "rhoConst", "rho 1.2;", "mu 1.8e-05; Pr 0.7;")
    assert viscosity(tmp_path, air)[:2] == (None, 1.8e-5)
    old = "thermoType hPsiThermo<pureMixture<constTransport<specieThermo<hConstThermo<perfectGas>>>>>;"
    assert viscosity(tmp_path, f"{old} mixture {{ transport {{ mu 3e-5; }} }}")[:2] == (None, 3e-5)


def test_a_polynomial_of_the_temperature(tmp_path):
    """That of OpenFOAM's heatExchanger for air."""
    text = AIR % (
        "polynomial",
        "icoPolynomial",
        "",
        "muCoeffs<8> ( 1.5061e-06 6.16e-08 -1.819e-11 0 0 0 0 0 );",
    )
    assert viscosity(tmp_path, text, 300.0).mu == pytest.approx(1.5061e-6 + 6.16e-8 * 300 - 1.819e-11 * 9e4)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            SUTHERLAND,
            r"transport sutherland the viscosity depends on the temperature. Add TInf, K, to constantP",
        ),
        (
            AIR % ("WLF", "rhoConst", "", ""),
            r"the viscosity of transport WLF is not read. .*or add nu, m2/s, or mu",
        ),
        (AIR % ("const", "rhoConst", "", "Pr 1;"), r"mixture/transport/mu is missing"),
        (
            AIR % ("const", "rhoConst", "", "mu 0;"),
            r"is 0, of an inviscid flow\. Add nu, m2/s, or mu, Pa s, to",
        ),
        (AIR % ("const", "rhoConst", "", "mu -1;"), r"mixture/transport/mu is '-1'"),
        (
            AIR % ("const", "rhoConst", "", "mu [0 2 -1 0 0 0 0] 1;"),
            r"kinematic viscosity, not \[1 -1 -1 0 0",
        ),
        ("thermoType { transport const; }", r"mixture is missing"),
        (
            "phases (water air);",
            r"nu is missing. Allowed: a number > 0, m2/s; or nu or mu in constantProperties",
        ),
    ],
)
def test_a_viscosity_that_cannot_be_read_says_what_to_add(text, message, tmp_path):
    with pytest.raises(InputError, match=message):
        viscosity(tmp_path, text)


def test_densities(tmp_path):
    def density(text):
        return read_density(write(tmp_path, "constant/thermophysicalProperties", text), tmp_path)

    assert density(AIR % ("const", "rhoConst", "rho 1.2;", "mu 1;")) == 1.2
    assert density(SUTHERLAND) is None
    assert density("rho [1 -3 0 0 0 0 0] 998;") == 998.0


LIQUID = "thermoType { mixture pureMixture; properties liquid; } mixture { H2O; }"
PLACES = [
    ("transportProperties", "nu nu [0 2 -1 0 0 0 0] 1e-6; rho 998;", (1e-6, None), 998.0),
    ("transportProperties", "NewtonianCoeffs { nu 2e-6; } rhoInf 900;", (2e-6, None), 900.0),
    ("transportProperties", "nu 2e-6; NewtonianCoeffs { } rhoInf 900;", (2e-6, None), 900.0),
    ("transportProperties", "mu 0.001; rho 800;", (None, 1e-3), 800.0),
    ("transportProperties", "mu [1 -1 -1 0 0 0 0] 3e-3;", (None, 3e-3), 1000.0),
    ("transportProperties", "rho 1; nu 1; mu 1; sigma 1;", (1.0, None), 1.0),
    ("transportProperties", "mug 0; mul [0 2 -1 0 0 0 0] 1e-3; rhog 1; rhol 100;", (1e-3, None), 100.0),
    ("transportProperties", "mul 2e-3; rhol 850;", (None, 2e-3), 850.0),
    ("transportProperties", "nul 4e-6; rhol 850;", (4e-6, None), 850.0),
    ("transportProperties", "continuousPhase air; rho.air 1.2; nu 1.5e-5;", (1.5e-5, None), 1.2),
    ("transportProperties", "continuousPhaseName air; rho.air 1.2; nu 1.5e-5;", (1.5e-5, None), 1.2),
    ("physicalProperties", "viscosityModel constant; nu 1e-05 [m^2/s]; rho 1.2;", (1e-5, None), 1.2),
    ("physicalProperties.air", "viscosityModel constant; nu 1e-05; rho 1.2;", (1e-5, None), 1.2),
    ("thermophysicalProperties", AIR % ("const", "rhoConst", "rho 1.2;", "mu 2e-5;"), (None, 2e-5), 1.2),
    ("thermophysicalProperties", AIR % ("const", "Boussinesq", "rho0 1.1;", "mu 2e-5;"), (None, 2e-5), 1.1),
    (
        "thermophysicalProperties",
        AIR % ("const", "perfectGas", "", "mu 2e-5;"),
        (None, 2e-5),
        2e5 * 28.9 / (8314.46 * 400.0),
    ),
    (
        "thermophysicalProperties",
        AIR % ("const", "perfectFluid", "R 3000; rho0 1027;", "mu 2e-5;"),
        (None, 2e-5),
        1027.0 + 2e5 / (3000.0 * 400.0),
    ),
    (
        "thermophysicalProperties",
        AIR % ("const", "icoPolynomial", "rhoCoeffs<8> (1000 -0.5 0 0 0 0 0 0);", "mu 2e-5;"),
        (None, 2e-5),
        800.0,
    ),
    (
        "thermophysicalProperties",
        AIR % ("const", "rPolynomial", "C (1e-3 1e-6 1e-9 1e-12 1e-15);", "mu 2e-5;"),
        (None, 2e-5),
        1.0 / (1e-3 + 4e-4 + 1.6e-4 - 2e-7 - 8e-8),
    ),
]


@pytest.mark.parametrize(("name", "text", "viscosities", "rho"), PLACES)
def test_the_places_where_openfoam_keeps_a_fluid(name, text, viscosities, rho, tmp_path):
    """Of a compressible fluid at the means of p and T; of sonicLiquidFoam in thermodynamicProperties."""
    file = write(tmp_path, f"constant/{name}", text)
    write(tmp_path, "constant/thermodynamicProperties", "rho0 1000; p0 1e5; psi 4.54e-07;")
    if "thermoType" in text:
        (tmp_path / "constant/thermodynamicProperties").unlink()
    (tmp_path / "2").mkdir()
    put_scalar(tmp_path / "2", "p", "1 -1 -2", 2e5)
    put_scalar(tmp_path / "2", "T", "0 0 0", 400.0)
    (tmp_path / "2/T").write_text((tmp_path / "2/T").read_text().replace("0 0 0 0 0 0 0", "0 0 0 1 0 0 0"))
    assert fluid_file(tmp_path, "") == file
    assert read_viscosity(file, tmp_path, time="latestTime")[:2] == viscosities
    assert find_density(tmp_path, "", file, "latestTime")[0] == pytest.approx(rho, rel=1e-12)


def test_phases_of_openfoam_org_have_a_file_each(tmp_path):
    write(tmp_path, "constant/phaseProperties", "phases (water air);")
    for name, nu, rho in (("water", 1e-6, 1000.0), ("air", 1.5e-5, 1.2)):
        write(
            tmp_path, f"constant/physicalProperties.{name}", f"viscosityModel constant; nu {nu}; rho {rho};"
        )
    phases = phases_of(tmp_path, "")
    assert [*phases] == ["air", "water"]
    assert phase_values(tmp_path, "", "air", phases["air"], 1.0, "latestTime") == (1.5e-5, 1.2)


def test_a_liquid_of_openfoams_code_is_unknown(tmp_path):
    file = write(tmp_path, "constant/thermophysicalProperties", LIQUID)
    with pytest.raises(
        InputError, match=r"the properties of H2O are in OpenFOAM's code, not in the case\. Wri"
    ):
        read_viscosity(file, tmp_path, time="latestTime")
    assert find_density(tmp_path, "", file, "latestTime") is None
    (tmp_path / "2").mkdir()
    put_scalar(tmp_path / "2", "thermo:mu", "1 -1 -1", 9e-4)
    put_scalar(tmp_path / "2", "rho", "1 -3 0", 997.0)
    assert read_viscosity(file, tmp_path, time="latestTime").field.mean == 9e-4
    assert find_density(tmp_path, "", file, "latestTime")[0] == 997.0


def test_a_dictionary_without_a_fluid_gives_way(tmp_path):
    """Such as the transportProperties of a reacting flow, with values of species only."""
    write(tmp_path, "constant/transportProperties", '".*" { transport { As 1.67212e-6; Ts 170.672; } }')
    file = write(tmp_path, "constant/thermophysicalProperties", SUTHERLAND)
    assert fluid_file(tmp_path, "") == file


TWO = "phases (water air); water { nu 1e-06; rho 1000; } air { transportModel Newtonian; nu 1.5e-05; rho 1; }"


def test_solids_are_no_phases_and_zero_is_no_property(tmp_path):
    """Particles move in the liquid of a melt; tutorials of interIsoFoam have phases without viscosity."""
    write(tmp_path, "constant/transportProperties", "phases (solid liquid); liquid { nu 0; rho 0; }")
    write(tmp_path, "constant/thermophysicalProperties.solid", "thermoType { type heSolidThermo; }")
    phases = phases_of(tmp_path, "")
    assert [*phases] == ["liquid"]
    assert phase_values(tmp_path, "", "liquid", phases["liquid"], 1.0, "latestTime") == (None, None)


def test_alternatives_to_a_mixture_are_no_phases(tmp_path):
    for name in ("thermophysicalProperties.water", "thermophysicalProperties.air"):
        write(tmp_path, f"constant/{name}", SUTHERLAND)
    assert [*phases_of(tmp_path, "")] == ["air", "water"]
    write(tmp_path, "constant/thermophysicalProperties", SUTHERLAND)
    assert phases_of(tmp_path, "") == {}


def put_fraction(time, name, value):
    time.mkdir(exist_ok=True)
    put_scalar(time, name, "0 0 0", value)


def test_a_mixture_of_two_phases(case):
    """At α = 0.3 of water: ρ = 300.7 kg/m³ and μ = 0.3·1e-3 + 0.7·1.5e-5 Pa s."""
    write(case, "constant/transportProperties", TWO)
    change(case, "solution {", "solution { mixture true;")
    with pytest.raises(InputError, match=r"constantProperties/rhoInf has no effect with solution/mixture"):
        read_settings(case)
    change(case, "rhoInf 1000;", "")
    with pytest.raises(InputError, match=r"needs the field alpha\.water or alpha\.air at each time"):
        read_settings(case)
    put_fraction(case / "2", "alpha.air", 0.7)
    fluid = read_settings(case).fluid
    assert fluid.rho == pytest.approx(300.7)
    assert fluid.mu.mean == pytest.approx(3.105e-4)
    put_fraction(case / "2", "alpha.water", 0.2)
    assert read_settings(case).fluid.rho == pytest.approx(200.8)
    write(case, "constant/transportProperties", TWO.replace("nu 1.5e-05", "mu 1"))
    with pytest.raises(InputError, match=r"air/nu is missing\. solution/mixture needs a constant nu"):
        read_settings(case)
    write(case, "constant/transportProperties", "nu 1;")
    with pytest.raises(InputError, match=r"needs a case with two phases; the phases are: none"):
        read_settings(case)


def test_the_dictionary_of_the_region_and_of_the_solver_counts_first(tmp_path):
    assert fluid_file(tmp_path, "air") is None
    for name in (
        "thermophysicalProperties",
        "physicalProperties",
        "transportProperties",
        "air/physicalProperties",
    ):
        path = write(tmp_path, f"constant/{name}", "nu 1;")
        assert fluid_file(tmp_path, "air") == path
    assert fluid_file(tmp_path, "") == tmp_path / "constant/transportProperties"


def test_a_compressible_solver_reads_the_mixture(tmp_path):
    """Beside it, mixerVessel2D of rhoPimpleFoam keeps a ν that is 1.5 times too small."""
    first = write(tmp_path, "constant/transportProperties", "transportModel Newtonian; nu 1e-5;")
    mixture = write(tmp_path, "constant/thermophysicalProperties", SUTHERLAND)
    (tmp_path / "1").mkdir()
    for units, file in (("1 -1 -2", mixture), ("0 2 -2", first)):
        put_scalar(tmp_path / "1", "p", units, 1e5)
        assert fluid_file(tmp_path, "") == file


RHO = header("volScalarField", "rho") + (
    "dimensions [1 -3 0 0 0 0 0]; internalField nonuniform List<scalar> 4(1.1 1.2 1.3 1.4); boundaryField { }"
)


def test_the_mean_of_the_field_is_the_density_of_last_resort(tmp_path):
    assert mean_field(tmp_path, "", "latestTime", "rho") is None
    write(tmp_path, "1/rho", RHO)
    write(tmp_path, "2/rho", RHO.replace("1.1 1.2", "1.5 1.6"))
    assert mean_field(tmp_path, "", "latestTime", "rho") == (pytest.approx(1.45), "2")
    assert mean_field(tmp_path, "", 1, "rho") == (pytest.approx(1.25), "1")


@pytest.fixture
def case(tmp_path):
    write(tmp_path, "constant/softCloudProperties", header("dictionary", "softCloudProperties") + SETTINGS)
    write(tmp_path, "constant/positions", "((0.5 0.5 0.5))")
    return tmp_path


def change(case, old, new):
    path = case / "constant/softCloudProperties"
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))


def test_the_clouds_own_entries_go_before_the_cases(case):
    write(case, "constant/thermophysicalProperties", AIR % ("const", "rhoConst", "rho 1.2;", "mu 1.8e-05;"))
    assert (read_settings(case).fluid.rho, read_settings(case).fluid.mu) == (1000.0, pytest.approx(1.8e-5))
    change(case, "rhoInf 1000;", "")
    assert (read_settings(case).fluid.rho, read_settings(case).fluid.mu) == (1.2, pytest.approx(1.8e-5))
    change(case, "rho0 1000;", "rho0 1000; mu 2e-5;")
    assert read_settings(case).fluid.nu == pytest.approx(2e-5 / 1.2)
    change(case, "mu 2e-5;", "nu 3e-5;")
    assert read_settings(case).fluid.nu == 3e-5
    change(case, "nu 3e-5;", "nu 3e-5; mu 2e-5;")
    with pytest.raises(
        InputError, match=re.escape("constantProperties gives nu and mu. Allowed: one of them.")
    ):
        read_settings(case)


def test_a_stated_temperature_and_the_field_of_the_density(case, caplog, monkeypatch):
    monkeypatch.setattr("foamprb.settings.fluid.log.propagate", True)
    write(case, "constant/thermophysicalProperties", SUTHERLAND)
    change(case, "rhoInf 1000;", "")
    with pytest.raises(InputError) as caught:
        read_settings(case)
    assert "2 mistakes" in str(caught.value)
    assert "Add TInf, K, to constantProperties" in str(caught.value)
    assert "rhoInf is missing. Allowed: a number > 0; also in constant/thermophysicalP" in str(caught.value)
    change(case, "rho0 1000;", "rho0 1000; TInf 293.15;")
    write(case, "3/rho", RHO)
    caplog.set_level("INFO")
    fluid = read_settings(case).fluid
    assert (fluid.rho, fluid.mu) == (pytest.approx(1.25), pytest.approx(1.8146e-5, rel=1e-4))
    assert "that of the field rho at time 3, its mean" in caplog.text
    assert "at 293.15 K" in caplog.text


def test_without_any_dictionary_the_message_says_which_entry_to_add(case):
    with pytest.raises(
        InputError, match=r"nu is missing. Allowed: a number > 0, m2/s; or mu, Pa s; or nu in con"
    ):
        read_settings(case)
    change(case, "rho0 1000;", "rho0 1000; nu 1e-6;")
    assert read_settings(case).fluid.nu == 1e-6


@pytest.mark.parametrize(
    ("coefficients", "message"),
    [
        ("muCoeffs<8> ( 1 two );", r"is '\(1 two\)'\. Allowed: a list of numbers"),
        ("", r"gives a viscosity of nan Pa s at 300 K"),
        ("muCoeffs<8> ( -1 0 );", r"gives a viscosity of -1 Pa s at 300 K"),
    ],
)
def test_a_polynomial_must_give_a_viscosity(coefficients, message, tmp_path):
    with pytest.raises(InputError, match=message):
        viscosity(tmp_path, AIR % ("polynomial", "icoPolynomial", "", coefficients), 300.0)


def test_a_mean_that_is_no_density_is_none(tmp_path):
    write(tmp_path, "1/rho", RHO.replace("1.1 1.2 1.3 1.4", "0 0 0 0"))
    assert mean_field(tmp_path, "", 1, "rho") is None
    assert mean_field(tmp_path / "nothing", "", 1, "rho") is None
    (tmp_path / "2").mkdir()
    assert mean_field(tmp_path, "", 2, "rho") is None


@pytest.mark.parametrize(
    "text",
    ["1e-05 [m^2/s]", "10 [mm^2/s]", "[kinematicViscosity] 1e-05", "nu [m^2 s^-1] 1e-5"],
)
def test_units_of_openfoam_org(text, tmp_path):
    """Its version 12 writes a unit after the value; other units than SI are applied."""
    (tmp_path / "nu").write_text(f"viscosityModel constant;\nnu {text};\n")
    assert read_viscosity(tmp_path / "nu", tmp_path).nu == pytest.approx(1e-5)


@pytest.mark.parametrize("text", ["1e-05 [m/s]", "1e-05 [Pa s]", "1 [furlong^2/s]", "[m^2/s] 1e-5 [m^2/s] 1"])
def test_wrong_units_are_refused(text, tmp_path):
    (tmp_path / "nu").write_text(f"viscosityModel constant;\nnu {text};\n")
    with pytest.raises(InputError, match="nu is '"):
        read_viscosity(tmp_path / "nu", tmp_path)


BLOOD = "transportModel BirdCarreau; BirdCarreauCoeffs { nu0 5.28e-5; nuInf 3.25e-6; k 3.313; n 0.3568; }"


@pytest.mark.parametrize(
    ("text", "fields", "lines"),
    [
        ("transportModel Newtonian; nu 1e-6;", (), ["nu 1e-06 m2/s"]),
        (
            BLOOD,
            ("U", "nu"),
            [
                "BirdCarreau of constant/transportProperties: "
                "nu0 5.28e-05, nuInf 3.25e-06, k 3.313, n 0.3568, a 2",
                "the written field nu takes its place",
            ],
        ),
        (
            "phases (water air); water { nu 1; } air { nu 1; }",
            (),
            ["phases water, air: see transportProperties"],
        ),
        (
            "thermoType { transport sutherland; } mixture { }",
            ("T",),
            ["sutherland of transportProperties, at the local T"],
        ),
        ("transportModel odd;", (), ["transportProperties has none that is read"]),
    ],
)
def test_the_viscosity_is_described(text, fields, lines, tmp_path):
    write(tmp_path, "constant/transportProperties", text)
    assert describe_viscosity(tmp_path, "", fields) == lines


def test_a_law_of_the_shear_rate(tmp_path):
    found = viscosity(tmp_path, BLOOD, name="transportProperties")
    assert (found.nu, found.mu, found.origin) == (None, None, "BirdCarreau of constant/transportProperties")
    assert found.law.coefficients == {"nu0": 5.28e-5, "nuInf": 3.25e-6, "k": 3.313, "n": 0.3568, "a": 2.0}
    assert found.law(10.0) == pytest.approx(bird_carreau(10.0, *found.law.coefficients.values()))


@pytest.mark.parametrize(
    ("laminar", "expected"),
    [
        ("model generalisedNewtonian; viscosityModel BirdCarreau; nuInf 1e-6; k 2; n 0.5;",
         {"nu0": 1e-5, "nuInf": 1e-6, "k": 2.0, "n": 0.5, "a": 2.0}),
        ("model generalisedNewtonian; viscosityModel BirdCarreau; nuInf 1e-6; tauStar 1e-4; n 0.5; a 1;",
         {"nu0": 1e-5, "nuInf": 1e-6, "k": 0.1, "n": 0.5, "a": 1.0}),
        ("model generalisedNewtonian; viscosityModel CrossPowerLaw; "
         "CrossPowerLawCoeffs { nuInf 1e-6; tauStar 1e-4; n 1; }",
         {"nu0": 1e-5, "nuInf": 1e-6, "m": 0.1, "n": 1.0}),
        ("model generalisedNewtonian; viscosityModel powerLaw; k 3e-5; n 0.5; nuMin 0; nuMax 1;",
         {"k": 3e-5, "n": 0.5, "nuMin": 0.0, "nuMax": 1.0}),
        ("laminarModel generalizedNewtonian; viscosityModel powerLaw; n 0.5; nuMin 0; nuMax 1;",
         {"k": 1e-5, "n": 0.5, "nuMin": 0.0, "nuMax": 1.0}),
        ("model generalizedNewtonian; viscosityModel powerLaw; k 3; n 0.5; nuMin 0; nuMax 1;",
         {"k": 1e-5, "n": 0.5, "nuMin": 0.0, "nuMax": 1.0}),
        ("model generalisedNewtonian; viscosityModel HerschelBulkley; tau0 1e-6; k 1e-6; n 0.5;",
         {"nu0": 1e-5, "tau0": 1e-6, "k": 1e-6, "n": 0.5}),
    ],
)  # fmt: skip
def test_generalised_newtonian_fluids_of_newer_versions(laminar, expected, tmp_path):
    """ν₀ is that of the fluid's dictionary; generalizedNewtonian's powerLaw has it in the place of k."""
    write(tmp_path, "constant/momentumTransport", f"simulationType laminar; laminar {{ {laminar} }}")
    found = viscosity(tmp_path, "viscosityModel constant; nu 1e-5;", name="physicalProperties")
    assert found.law.coefficients == pytest.approx(expected)
    assert list(found.law.coefficients) == list(expected)


NU = header("volScalarField", "nu") + (
    "dimensions [0 2 -1 0 0 0 0]; internalField nonuniform List<scalar> 4(1e-6 2e-6 3e-6 4e-6); "
    "boundaryField { }"
)


def test_a_written_field_goes_before_the_law(tmp_path):
    """For a transient flow it must be there at all times."""
    path = write(tmp_path, "constant/transportProperties", BLOOD)
    write(tmp_path, "1/U", "")
    write(tmp_path, "2/nu", NU)
    found = read_viscosity(path, tmp_path, time="latestTime")
    assert (found.field.name, found.field.kinematic) == ("nu", True)
    assert found.field.mean == pytest.approx(2.5e-6)
    for options in ({"time": 1}, {"time": "latestTime", "transient": True}, {}):
        assert read_viscosity(path, tmp_path, **options).field is None


def test_a_model_that_is_not_known_needs_the_field(tmp_path):
    path = write(tmp_path, "constant/transportProperties", "transportModel strainRateFunction;")
    with pytest.raises(InputError, match=r"is 'strainRateFunction'\. Allowed: .*or a field nu at the time"):
        read_viscosity(path, tmp_path, time="latestTime")
    write(tmp_path, "2/nu", NU)
    found = read_viscosity(path, tmp_path, time="latestTime")
    assert found.origin == "strainRateFunction, the field nu"


def test_sutherlands_law_at_the_local_temperature(tmp_path):
    path = write(tmp_path, "constant/thermophysicalProperties", SUTHERLAND)
    temperature = header("volScalarField", "T") + (
        "dimensions [0 0 0 1 0 0 0]; internalField nonuniform List<scalar> 2(293.15 373.15); "
        "boundaryField { }"
    )
    write(tmp_path, "2/T", temperature)
    found = read_viscosity(path, tmp_path, time="latestTime")
    assert found.field.law(np.array([293.15, 373.15])) == pytest.approx([18.2e-6, 21.8e-6], rel=0.01)
    assert found.field.mean == pytest.approx(0.5 * (18.146e-6 + 21.802e-6), rel=1e-3)
    # A stated temperature is that of the whole fluid.
    assert read_viscosity(path, tmp_path, 293.15, time="latestTime").mu == pytest.approx(18.146e-6, rel=1e-4)


def test_the_viscosity_of_the_cloud_goes_before_that_of_the_case(case):
    write(case, "constant/transportProperties", BLOOD)
    law = read_settings(case).fluid.mu
    assert law.at_rate(100.0) == pytest.approx(1000.0 * 4.4384e-6, rel=1e-3)
    change(case, "rho0 1000;", "rho0 1000; nu 3e-6;")
    assert read_settings(case).fluid.mu == pytest.approx(3e-3)
