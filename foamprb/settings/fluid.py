"""The dictionary ``constantProperties``, and the fluid and gravity of a case."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Annotated

from foamprb.cloud.block import Medium
from foamprb.cloud.injection.distribution import Distribution
from foamprb.cloud.injection.shapes import Shape
from foamprb.cloud.viscosity import RATE_LAWS, FieldViscosity, PhaseMixture, VaryingViscosity
from foamprb.dictionary.constraints import Meaning, NoEffect, Positive, Vector3
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes, ReportedError
from foamprb.dictionary.schema import Instead, read_entry
from foamprb.dictionary.tree import CaseFile, Dictionary
from foamprb.dictionary.values import Acceleration, AccelerationVector, Density, DynamicViscosity, Viscosity
from foamprb.errors import InputError
from foamprb.flow.read.fluid import (
    FILES,
    CaseViscosity,
    ViscosityField,
    find_density,
    fluid_file,
    read_mixture,
    read_viscosity,
)

log = logging.getLogger("foamprb")

_OF_CASE = "that of the case, see [The fluid](#the-fluid)"
_NO_MASS_TRANSFER = NoEffect("the mass of a particle does not change")


@dataclass(frozen=True, kw_only=True)
class ConstantProperties:
    """``constantProperties``."""

    rho0: Annotated[float | Distribution, Positive, Meaning("density of the particles", "kg/m³")]
    rhoInf: Annotated[Density | None, Positive, Meaning("density of the fluid", "kg/m³", _OF_CASE)] = None
    nu: Annotated[
        Viscosity | None, Positive, Meaning("kinematic viscosity of the fluid", "m²/s", _OF_CASE)
    ] = None
    mu: Annotated[
        DynamicViscosity | None,
        Positive,
        Meaning("dynamic viscosity of the fluid, in place of `nu`", "Pa s", _OF_CASE),
    ] = None
    TInf: Annotated[
        float | None,
        Positive,
        Meaning("temperature of the fluid", "K", "the local one, where the viscosity depends on it"),
    ] = None
    solid: Annotated[
        Dictionary | None,
        Meaning(
            "[material](#solid); an injection model's own `solid` replaces single entries", "", "required"
        ),
    ] = None
    shape: Annotated[
        Shape | None,
        Meaning("[shape at rest](#shape); an injection model may have its own", default="sphere"),
    ] = None
    constantVolume: Annotated[None, _NO_MASS_TRANSFER] = None
    rhoMin: Annotated[None, _NO_MASS_TRANSFER] = None
    alphaMax: Annotated[None, NoEffect("the suspension is dilute, particles do not meet")] = None

    @staticmethod
    def instead(word: str) -> Instead | None:
        """Return the dictionary of the moduli."""
        moduli = ("youngsModulus", "poissonsRatio", "shearModulus")
        return Instead("solid", f"a dictionary with {word} and type") if word in moduli else None


@dataclass(frozen=True)
class Fluid:
    """Density rho, kg/m3, and kinematic viscosity nu, m2/s."""

    rho: float
    nu: float | None
    varying: VaryingViscosity | None = None
    """Model of a viscosity that varies; then ``nu`` is None."""
    origin: str = ""
    """What gives a viscosity that varies."""
    field: ViscosityField | None = None
    """Field that the flow must read for it."""

    @property
    def mu(self) -> float | VaryingViscosity:
        """Dynamic viscosity, Pa s, or the model of one that varies."""
        return self.varying if self.nu is None and self.varying else self.rho * (self.nu or 0.0)


def of_region(case: Path, region: str, name: str) -> Path:
    """Return the path, relative to the case, of a region's file; without it, of the case's file."""
    file = Path("constant") / region / name
    return file if (case / file).is_file() else Path("constant") / name


def read_fluid(
    case: Path,
    region: str,
    constant: Dictionary,
    properties: ConstantProperties | None,
    time: float | str = "latestTime",
    transient: bool = False,
    mixture: bool = False,
) -> Fluid:
    """Read ρ_f and ν: from ``constantProperties``, the case's dictionary of the fluid, or fields.

    Parameters
    ----------
    case, region
        The case, and a region of its mesh.
    constant, properties
        The cloud's ``constantProperties``, and its entries, None if they are broken.
    time
        Time of the fields.
    transient
        Whether the flow is read at all times.
    mixture
        Whether ν and ρ_f are those of two phases at the local volume fraction.
    """
    if mixture:
        return _mixed(case, region, constant, time, transient)
    file = fluid_file(case, region)
    viscosity, rho = None, None
    mistakes = Mistakes()
    with mistakes:
        if properties and properties.nu is not None and properties.mu is not None:
            raise constant.mistake("gives nu and mu. Allowed: one of them.")
        if properties and {"nu", "mu"} & constant.entries.keys():
            viscosity = CaseViscosity(properties.nu, properties.mu)
        elif not {"nu", "mu"} & constant.entries.keys():
            if file is None:
                raise constant.missing(
                    "nu", f"Allowed: {Positive.text}, m2/s; or mu, Pa s; or nu in constant/{FILES[0]}."
                )
            T = properties.TInf if properties else None
            viscosity = read_viscosity(file, case, T, region, time, transient)
    with mistakes:
        if "rhoInf" not in constant.entries:
            density = find_density(case, region, file, time)
            if density is None:
                also = str(CaseFile(file, case)) if file is not None else f"constant/{FILES[0]}"
                raise constant.missing("rhoInf", f"Allowed: {Positive.text}; also in {also}.")
            log.info("%s: constantProperties/rhoInf is %g kg/m3, that of %s.", constant.source, *density)
            rho = density[0]
        elif properties:
            rho = properties.rhoInf
    mistakes.raise_any()
    if viscosity is None or rho is None:
        raise ReportedError("constantProperties is broken")
    if viscosity.temperature is not None:
        log.info("%s: the viscosity is %g Pa s, at %g K.", file, viscosity.mu, viscosity.temperature)
    if varying := _varying(viscosity, rho):
        return Fluid(rho, None, varying, viscosity.origin, viscosity.field)
    return Fluid(rho, viscosity.nu if viscosity.nu is not None else float(viscosity.mu or 0.0) / rho)


def _mixed(case: Path, region: str, constant: Dictionary, time: float | str, transient: bool) -> Fluid:
    """Read the fluid of two phases with local ν and ρ; ``rho`` is the mean over the cells."""
    for key in ("nu", "mu", "rhoInf"):
        if key in constant.entries:
            raise constant.entries[key].mistake(
                "has no effect with solution/mixture, which takes it from the phases. Allowed: one of both."
            )
    names, nu, rho, field = read_mixture(case, region, time, transient)
    mu = (nu[0] * rho[0], nu[1] * rho[1])
    a = field.mean
    model = PhaseMixture(mu=mu, rho=rho, mean=a * mu[0] + (1.0 - a) * mu[1])
    origin = f"mixture of {' and '.join(names)}, rho {rho[0]:.4g} and {rho[1]:.4g} kg/m3, by {field.name}"
    return Fluid(a * rho[0] + (1.0 - a) * rho[1], None, model, origin, field)


def _varying(viscosity: CaseViscosity, rho: float) -> VaryingViscosity | None:
    """Return the model of a viscosity that varies, None for a constant; ρ is the density, kg/m³."""
    if viscosity.field is not None:
        factor = rho if viscosity.field.kinematic else 1.0
        return FieldViscosity(factor=factor, mean=factor * viscosity.field.mean)
    if viscosity.law is not None:
        return RATE_LAWS[viscosity.law.model].of_kinematic(viscosity.law.coefficients, rho)
    return None


def read_medium(
    case: PathLike[str] | str,
    region: str = "",
    time: float | str = "latestTime",
    *,
    rho: float | None = None,
    mu: float | VaryingViscosity | None = None,
    temperature: float | None = None,
) -> Medium:
    """Read the fluid's viscosity and density, and gravity, from any file where a solver keeps them.

    Parameters
    ----------
    case, region
        The case's folder, and a region of its mesh if it has several.
    time
        Time of the field ``rho``, which is read if no other file gives the density.
    rho, mu
        Density, kg/m³, and viscosity, Pa s, in place of the case's.
    temperature
        Temperature for a viscosity that depends on it, K.

    Returns
    -------
    The medium; without a file ``g``, gravity is zero. A viscosity by the shear rate is a model, see
    :mod:`foamprb.cloud.viscosity`.

    Raises
    ------
    InputError
        If a file is broken, or a value is neither in the case nor given.
    """
    case = Path(case)
    file = fluid_file(case, region)
    if rho is None:
        density = find_density(case, region, file, time)
        if density is None:
            raise InputError(f"{case}: the density is not in the case; give rho, kg/m3.")
        rho = density[0]
    if mu is None:
        if file is None:
            raise InputError(f"{case}: constant/{FILES[0]} does not exist; give mu, Pa s.")
        viscosity = read_viscosity(file, case, temperature, region)
        constant = float(viscosity.mu or 0.0) if viscosity.nu is None else viscosity.nu * rho
        mu = _varying(viscosity, rho) or constant
    there = (case / of_region(case, region, "g")).is_file()
    return Medium(mu, rho, read_gravity(case, region) if there else (0.0, 0.0, 0.0))


def read_gravity(case: Path, region: str) -> Vector3:
    """Read g, m/s2."""
    root = read_dictionary(case / of_region(case, region, "g"), case, warn=True)
    if "dimensions" in root.entries:
        read_entry(root, "dimensions", Acceleration)
    g: Vector3 = read_entry(root, "value", AccelerationVector)
    return g
