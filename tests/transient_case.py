"""A box with a velocity that changes in time, and is uniform in space or nearly."""

from __future__ import annotations

import re
from pathlib import Path

from foam_writer import header, write_case
from parcels import G

SETTINGS = """
solution { deltaT 0.05; endTime 1.2; writeInterval 0.4; transient yes; integrationSchemes { shape stokes; } }
constantProperties
{
    rho0 1000; rhoInf 1000;
    solid { type neoHooke; poissonsRatio 0.49; shearModulus 10; }
}
subModels
{
    particleForces { ellipsoidDrag; }
    injectionModels
    {
        manual
        {
            type manualInjection; positionsFile "positions"; SOI 0.3;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 1e-3; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs { patches ( ".*" { type escape; } ); }
}
"""
SCALE = {"0": 0.01, "0.5": 0.02, "1.5": -0.04}


def scaled(text, factor):
    """The text with each vector of numbers multiplied."""
    return re.sub(
        r"\((\S+) (\S+) (\S+)\)",
        lambda m: "({:.9g} {:.9g} {:.9g})".format(*(factor * float(x) for x in m.groups())),
        text,
    )


def write_transient_case(case: Path) -> Path:
    """A linear velocity, whose factor is 0.01, 0.02 and −0.04 at the times 0, 0.5 and 1.5."""
    write_case(case)
    (case / "1e1").rename(case / "1.5")
    for time, factor in SCALE.items():
        file = case / time / "U"
        file.write_text(scaled(file.read_text(), factor))
    # A force of zero, as the loop with gravity is compiled for other tests.
    settings = SETTINGS.replace("ellipsoidDrag;", "ellipsoidDrag; gravity;")
    (case / "constant/softCloudProperties").write_text(header("dictionary", "softCloudProperties") + settings)
    (case / "constant/g").write_text(header("uniformDimensionedVectorField", "g") + G)
    (case / "constant/positions").write_text("((0.5 0.5 0.5) (0.45 0.5 0.55))")
    (case / "constant/transportProperties").write_text("nu 1e-06;")
    return case
