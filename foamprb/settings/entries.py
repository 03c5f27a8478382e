"""The entries of the cloud's dictionary: a schema for each of its dictionaries.

The names are the entries' own words; where OpenFOAM has an entry, its name, unit and meaning are OpenFOAM's.
Entries of models that a registry knows (injection models, distributions, shapes, interactions, cloud
functions) stand with the models.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from foamprb.body.drag import DRAGS
from foamprb.body.material import MATERIALS
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.injection.models import INJECTIONS
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.dictionary.constraints import (
    Bounds,
    Choice,
    Fraction,
    NoEffect,
    NonNegative,
    Only,
    PoissonsRatio,
    Positive,
)
from foamprb.dictionary.schema import Instead
from foamprb.dictionary.tree import Dictionary
from foamprb.dictionary.values import Density, DynamicViscosity, Files, Line, Viscosity
from foamprb.settings.patches import INTERACTION_MODELS
from foamprb.settings.settings import StartFrom

__all__ = [
    "STIFFNESS",
    "CloudProperties",
    "ConstantProperties",
    "InjectionModel",
    "Solid",
    "Solution",
    "SubModels",
    "parameters",
]


_CONSTANT_FLUID = NoEffect("density and viscosity of the fluid are constants")


@dataclass(frozen=True, kw_only=True)
class InterpolationSchemes:
    """``solution/interpolationSchemes``; OpenFOAM's ``cellPoint`` is linear in the same tetrahedra."""

    U: Literal["linear", "cellPoint"] = "linear"
    rho: Annotated[None, _CONSTANT_FLUID] = None
    mu: Annotated[None, _CONSTANT_FLUID] = None

    @staticmethod
    def instead(word: str) -> Instead | None:
        """Return the name without that of a phase, as in ``U.air``."""
        name, dot, _ = word.partition(".")
        return Instead(name, "there is one fluid") if dot and name in ("U", "rho", "mu") else None


@dataclass(frozen=True, kw_only=True)
class IntegrationSchemes:
    """``solution/integrationSchemes``."""

    U: Literal["Euler"] = "Euler"
    shape: Annotated[str, Choice(("auto", *INTEGRATORS))] = "auto"
    tolerance: Annotated[float, Positive] = 1e-4


_NOT_COUPLED = Only(False, "the particles do not act on the flow")
_NO_SOURCES = NoEffect("the particles do not act on the flow")


@dataclass(frozen=True, kw_only=True)
class Solution:
    """``solution``."""

    deltaT: Annotated[float, Positive] | None = None
    endTime: Annotated[float, Positive] | None = None
    writeInterval: Annotated[float, Positive] | None = None
    startFrom: StartFrom | None = None
    startTime: Annotated[float, Only(0.0, "a cloud begins at time 0")] = 0.0
    maxFailedFraction: Annotated[float, Fraction] = 1.0
    active: Annotated[bool, Only(True, "the cloud is not active, there is nothing to do")] = True
    coupled: Annotated[bool, _NOT_COUPLED] = False
    transient: bool = False
    period: Annotated[float, Positive] | None = None
    cellValueSourceCorrection: Annotated[bool, _NOT_COUPLED] = False
    interpolationSchemes: InterpolationSchemes = InterpolationSchemes()
    integrationSchemes: IntegrationSchemes = IntegrationSchemes()
    maxCo: Annotated[
        None, NoEffect("the tracking step is deltaT, and walks go through any number of cells")
    ] = None
    sourceTerms: Annotated[None, _NO_SOURCES] = None
    averagingMethod: Annotated[None, _NO_SOURCES] = None
    averagingMethods: Annotated[None, _NO_SOURCES] = None
    calcFrequency: Annotated[None, _NO_SOURCES] = None
    resetSourcesOnStartup: Annotated[None, _NO_SOURCES] = None


@dataclass(frozen=True, kw_only=True)
class Solid:
    """``solid``; which of its entries are needed depends on all of them."""

    type: Annotated[str, Choice(MATERIALS)] | None = None
    poissonsRatio: Annotated[float, PoissonsRatio] | None = None
    shearModulus: Annotated[float, Positive] | Dictionary | None = None
    youngsModulus: Annotated[float, Positive] | Dictionary | None = None
    Ca: Annotated[float, Positive] | Dictionary | None = None
    referenceShearRate: Annotated[float, Positive] | None = None
    viscosity: Annotated[float, NonNegative] | Dictionary | None = None
    surfaceTension: Annotated[float, NonNegative] | Dictionary | None = None


STIFFNESS = ("shearModulus", "youngsModulus", "Ca")
"""The entries of a solid of which one gives its stiffness."""


def parameters() -> dict[str, Any]:
    """Return the entries of the solids' third parameters with their type hints, user-made solids included."""
    return {
        p.entry: Annotated[
            float,
            Bounds(p.lower, p.upper, True, math.isinf(p.upper), f"a number > {p.lower:g} and <= {p.upper:g}"),
        ]
        for p in (material.parameter for material in MATERIALS.values())
        if p is not None
    }


_NO_MASS_TRANSFER = NoEffect("the mass of a particle does not change")


@dataclass(frozen=True, kw_only=True)
class ConstantProperties:
    """``constantProperties``."""

    rho0: Annotated[float, Positive] | Dictionary
    rhoInf: Annotated[Density, Positive] | None = None
    nu: Annotated[Viscosity, Positive] | None = None
    mu: Annotated[DynamicViscosity, Positive] | None = None
    TInf: Annotated[float, Positive] | None = None
    solid: Dictionary | None = None
    shape: Dictionary | None = None
    parcelTypeId: Annotated[None, NoEffect("particles are told apart by their injection model")] = None
    constantVolume: Annotated[None, _NO_MASS_TRANSFER] = None
    rhoMin: Annotated[None, _NO_MASS_TRANSFER] = None
    minParcelMass: Annotated[None, _NO_MASS_TRANSFER] = None
    minParticleMass: Annotated[None, _NO_MASS_TRANSFER] = None
    alphaMax: Annotated[None, NoEffect("the suspension is dilute, particles do not meet")] = None

    @staticmethod
    def instead(word: str) -> Instead | None:
        """Return the dictionary in which the moduli are."""
        moduli = ("youngsModulus", "poissonsRatio", "shearModulus")
        return Instead("solid", f"a dictionary with {word} and type") if word in moduli else None


@dataclass(frozen=True, kw_only=True)
class EllipsoidDrag:
    """``subModels/particleForces/ellipsoidDrag``."""

    type: Annotated[str, Choice(DRAGS)] = "oberbeck"


@dataclass(frozen=True, kw_only=True)
class ParticleForces:
    """``subModels/particleForces``, without those that the registries of forces and surroundings have."""

    ellipsoidDrag: EllipsoidDrag

    @staticmethod
    def instead(word: str) -> Instead | None:
        """Return the drag that stands for OpenFOAM's laws for spheres."""
        why = "which for a rigid sphere is Stokes' drag"
        return Instead("ellipsoidDrag", why) if word.endswith("Drag") else None


_PARCELS = "particles are single, not parcels"
_CONSTANT_RATE = Line("constant 1")


@dataclass(frozen=True, kw_only=True)
class InjectionModel:
    """The entries that every injection model has beside its own."""

    type: Annotated[str, Choice(INJECTIONS)]
    sizeDistribution: Dictionary | None = None
    rho0: Annotated[float, Positive] | Dictionary | None = None
    solid: Dictionary | None = None
    shape: Dictionary | None = None
    parcelBasisType: Annotated[str, Only("fixed", _PARCELS)] = "fixed"
    nParticle: Annotated[float, Only(1.0, _PARCELS)] = 1.0
    massTotal: Annotated[float, Only(0.0, f"{_PARCELS}: their mass follows from diameter and rho0")] = 0.0
    flowRateProfile: Annotated[
        Line, Only(_CONSTANT_RATE, "parcelsPerSecond is the rate for the whole duration")
    ] = _CONSTANT_RATE


_NO_DISPERSION = Only(
    "none", "particles follow the velocity field that was read, without turbulent dispersion"
)
_DILUTE = Only("none", "the suspension is dilute, particles do not meet")
_NO_MODEL = NoEffect("there is no such model")


@dataclass(frozen=True, kw_only=True)
class SubModels:
    """``subModels``, without the coefficients of the patch interaction models."""

    particleForces: Dictionary
    injectionModels: Dictionary
    patchInteractionModel: Annotated[str, Choice(INTERACTION_MODELS)]
    tractionModel: Annotated[str, Choice(TRACTIONS)] = "roscoe"
    dispersionModel: Annotated[str, _NO_DISPERSION] = "none"
    heatTransferModel: Annotated[str, Only("none", "particles have no temperature")] = "none"
    surfaceFilmModel: Annotated[str, Only("none", "there is no film on the walls")] = "none"
    collisionModel: Annotated[str, _DILUTE] = "none"
    stochasticCollisionModel: Annotated[str, _DILUTE] = "none"
    packingModel: Annotated[str, _DILUTE] = "none"
    dampingModel: Annotated[str, _DILUTE] = "none"
    isotropyModel: Annotated[str, _DILUTE] = "none"
    radiation: Annotated[bool, Only(False, "particles have no temperature")] = False
    pairCollisionCoeffs: Annotated[None, _NO_MODEL] = None
    explicitCoeffs: Annotated[None, _NO_MODEL] = None
    implicitCoeffs: Annotated[None, _NO_MODEL] = None
    relaxationCoeffs: Annotated[None, _NO_MODEL] = None
    stochasticCoeffs: Annotated[None, _NO_MODEL] = None


@dataclass(frozen=True, kw_only=True)
class CloudProperties:
    """The whole file, the dictionaries of which have schemas of their own."""

    solution: Dictionary
    constantProperties: Dictionary
    subModels: Dictionary
    cloudFunctions: Dictionary | None = None
    libs: Files | None = None
