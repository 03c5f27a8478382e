"""The fluid and gravity: ρ_f from the cloud's dictionary, ν from ``transportProperties``, g from ``g``."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated, Literal

from foamprb.dictionary.constraints import Positive, Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import read_entries, read_entry
from foamprb.dictionary.tree import Dictionary
from foamprb.dictionary.values import Acceleration, Density, Viscosity
from foamprb.settings import entries
from foamprb.settings.settings import Fluid

__all__ = ["of_region", "read_fluid", "read_gravity"]

log = logging.getLogger("foamprb")


def of_region(case: Path, region: str, name: str) -> Path:
    """Return the path, relative to the case, of a region's file, or of the case's if the region has none."""
    own = Path("constant") / region / name
    return own if (case / own).is_file() else Path("constant") / name


def read_fluid(case: Path, region: str, constant: Dictionary) -> Fluid:
    """Read ρ_f and ν.

    Parameters
    ----------
    case, region
        The case, and a region of its mesh.
    constant
        The cloud's ``constantProperties``; if they give no density, ``transportProperties`` may.

    Raises
    ------
    InputError
        If there are mistakes, in ``constantProperties`` or in the other file, all of them.
    """
    file = of_region(case, region, "transportProperties")
    mistakes = Mistakes()
    with mistakes:
        properties = read_entries(entries.ConstantProperties, constant)
    with mistakes:
        transport = read_dictionary(case / file, case)
        with mistakes:
            nu = _viscosity(transport)
        with mistakes:
            other = None if "rhoInf" in constant.entries else _density(transport)
    mistakes.raise_any()
    if properties.rhoInf is not None:
        return Fluid(properties.rhoInf, nu)
    if other is None:
        raise constant.missing("rhoInf", f"Allowed: {Positive.text}; also in {file}.")
    log.info("%s: constantProperties/rhoInf is %g kg/m3, that of %s.", constant.source, other, file)
    return Fluid(other, nu)


def _viscosity(transport: Dictionary) -> float:
    """Read ν, m2/s, of a Newtonian fluid."""
    mistakes = Mistakes()
    with mistakes:
        if "transportModel" in transport.entries:
            read_entry(transport, "transportModel", Literal["Newtonian"])
    with mistakes:
        coefficients = transport.entries.get("NewtonianCoeffs", transport).dictionary()
        nu = read_entry(coefficients, "nu", Annotated[Viscosity, Positive])
    mistakes.raise_any()
    return float(nu)


def _density(transport: Dictionary) -> float | None:
    """Read ρ_f, kg/m3, under one of the names that OpenFOAM's solvers give it; None without any."""
    for key in ("rhoInf", "rho"):
        if key in transport.entries:
            return float(read_entry(transport, key, Annotated[Density, Positive]))
    return None


def read_gravity(case: Path, region: str) -> Vector3:
    """Read g, m/s2."""
    root = read_dictionary(case / of_region(case, region, "g"), case)
    if "dimensions" in root.entries:
        read_entry(root, "dimensions", Acceleration)
    g: Vector3 = read_entry(root, "value", Vector3)
    return g
