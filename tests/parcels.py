"""Parcels of icoUncoupledKinematicParcelFoam: its dictionaries, and what it writes."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

G = "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);"
CLOUD = """
    solution
    {
        active true; coupled false; transient yes; cellValueSourceCorrection off; maxCo 0.3;
        interpolationSchemes { rho cell; U cellPoint; mu cell; }
        integrationSchemes { U Euler; }
        sourceTerms { schemes { } }
    }
    constantProperties
    {
        parcelTypeId 1; rhoMin 1e-15; minParcelMass 1e-30; rho0 1000; youngsModulus 1e8; poissonsRatio 0.35;
    }
    subModels
    {
        particleForces { sphereDrag; }
        injectionModels { #include "injectionModels" }
        dispersionModel MODEL; surfaceFilmModel none; stochasticCollisionModel none; collisionModel none;
        INTERACTION
    }
    cloudFunctions { }"""
TRANSPORT = """
    rhoInf rhoInf [1 -3 0 0 0 0 0] 1.2; transportModel Newtonian; nu nu [0 2 -1 0 0 0 0] 1e-5;"""


def control_dict(end: float, dt: float) -> str:
    """Return a ``controlDict`` of a run from 0 that writes at its end, in ascii."""
    return (
        "application icoUncoupledKinematicParcelFoam; startFrom startTime; startTime 0; stopAt endTime; "
        f"endTime {end}; deltaT {dt}; writeControl runTime; writeInterval {end}; writeFormat ascii; "
        "writePrecision 16; timeFormat general; timePrecision 8; runTimeModifiable false;"
    )


def numbers(path: Path) -> np.ndarray:
    """Of a list of scalars or vectors that OpenFOAM wrote in ascii."""
    body = path.read_text().split("// * *", 1)[1]
    return np.array(re.sub(r"[()]", " ", body[body.index("(") : body.rindex(")")]).split(), dtype=float)
