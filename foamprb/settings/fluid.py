"""The fluid and gravity: ρ_f and ν from the cloud's dictionary or the case's, g from ``g``."""

from __future__ import annotations

import logging
from pathlib import Path

from foamprb.cloud.block import Medium
from foamprb.dictionary.constraints import Positive, Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import read_entries, read_entry
from foamprb.dictionary.tree import Dictionary, Source
from foamprb.dictionary.values import Acceleration
from foamprb.errors import InputError
from foamprb.flow.read.fluid import (
    FILES,
    CaseViscosity,
    fluid_file,
    mean_density,
    read_density,
    read_viscosity,
)
from foamprb.settings import entries
from foamprb.settings.settings import Fluid

__all__ = ["of_region", "read_fluid", "read_gravity", "read_medium"]

log = logging.getLogger("foamprb")


def of_region(case: Path, region: str, name: str) -> Path:
    """Return the path, relative to the case, of a region's file, or of the case's if the region has none."""
    own = Path("constant") / region / name
    return own if (case / own).is_file() else Path("constant") / name


def read_fluid(case: Path, region: str, constant: Dictionary, time: float | str = "latestTime") -> Fluid:
    """Read ρ_f and ν.

    Parameters
    ----------
    case, region
        The case, and a region of its mesh.
    constant
        The cloud's ``constantProperties``, which go before the case's own dictionary of the fluid, and this
        before the field ``rho``.
    time
        At which the field ``rho`` is read.

    Raises
    ------
    InputError
        If there are mistakes, in ``constantProperties`` or in the other file, all of them.
    """
    file = fluid_file(case, region)
    properties, viscosity = None, None
    rho: float | None = None
    mistakes = Mistakes()
    with mistakes:
        properties = read_entries(entries.ConstantProperties, constant)
        if properties.nu is not None and properties.mu is not None:
            mistakes.add(constant.mistake("gives nu and mu. Allowed: one of them."))
        viscosity = CaseViscosity(properties.nu, properties.mu)
    with mistakes:
        if not {"nu", "mu"} & set(constant.entries):
            if file is None:
                raise constant.missing(
                    "nu", f"Allowed: {Positive.text}, m2/s; or mu, Pa s; or nu in constant/{FILES[0]}."
                )
            viscosity = read_viscosity(file, case, properties.TInf if properties else None)
    with mistakes:
        if properties and properties.rhoInf is not None:
            rho = properties.rhoInf
        elif "rhoInf" not in constant.entries:
            rho = _density_of_case(case, region, constant, file, time)
    mistakes.raise_any()
    assert viscosity is not None
    assert rho is not None
    if viscosity.temperature is not None:
        log.info("%s: the viscosity is %g Pa s, at %g K.", file, viscosity.mu, viscosity.temperature)
    return Fluid(rho, viscosity.nu if viscosity.nu is not None else float(viscosity.mu or 0.0) / rho)


def _density_of_case(
    case: Path, region: str, constant: Dictionary, file: Path | None, time: float | str
) -> float:
    """Read ρ_f, kg/m3, from the dictionary of the fluid or from the field."""
    found = _find_density(case, region, file, time)
    if found is None:
        also = str(Source(file, case)) if file is not None else f"constant/{FILES[0]}"
        raise constant.missing("rhoInf", f"Allowed: {Positive.text}; also in {also}.")
    log.info("%s: constantProperties/rhoInf is %g kg/m3, that of %s.", constant.source, *found)
    return found[0]


def _find_density(case: Path, region: str, file: Path | None, time: float | str) -> tuple[float, str] | None:
    """Density, kg/m3, and where the case says it; None if it does not."""
    if file is not None and (found := read_density(file, case)) is not None:
        return found, str(Source(file, case))
    field = mean_density(case, region, time)
    return None if field is None else (field[0], f"the field rho at time {field[1]}, its mean")


def read_medium(
    case: Path | str,
    region: str = "",
    time: float | str = "latestTime",
    *,
    rho: float | None = None,
    mu: float | None = None,
    temperature: float | None = None,
) -> Medium:
    """Read the fluid's viscosity and density, and gravity, wherever the solver of a case keeps them.

    Parameters
    ----------
    case, region
        The case's folder, and a region of its mesh if it has several.
    time
        At which the field ``rho`` is read, if the density is nowhere else.
    rho, mu
        Density, kg/m³, and viscosity, Pa s, to be taken instead of the case's.
    temperature
        At which a viscosity that depends on it is taken, K.

    Returns
    -------
    The medium; without a file ``g`` there is no gravity.

    Raises
    ------
    InputError
        A file that is broken, or a value that is neither in the case nor given.
    """
    case = Path(case)
    file = fluid_file(case, region)
    if rho is None:
        found = _find_density(case, region, file, time)
        if found is None:
            raise InputError(f"{case}: the density is not in the case; give rho, kg/m3.")
        rho = found[0]
    if mu is None:
        if file is None:
            raise InputError(f"{case}: constant/{FILES[0]} is not there; give mu, Pa s.")
        viscosity = read_viscosity(file, case, temperature)
        mu = float(viscosity.mu or 0.0) if viscosity.nu is None else viscosity.nu * rho
    there = (case / of_region(case, region, "g")).is_file()
    return Medium(mu, rho, read_gravity(case, region) if there else (0.0, 0.0, 0.0))


def read_gravity(case: Path, region: str) -> Vector3:
    """Read g, m/s2."""
    root = read_dictionary(case / of_region(case, region, "g"), case)
    if "dimensions" in root.entries:
        read_entry(root, "dimensions", Acceleration)
    g: Vector3 = read_entry(root, "value", Vector3)
    return g
