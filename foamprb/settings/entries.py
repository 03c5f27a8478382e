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
    NonNegative,
    Only,
    PoissonsRatio,
    Positive,
)
from foamprb.dictionary.tree import Dictionary
from foamprb.dictionary.values import Files, Line
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


@dataclass(frozen=True, kw_only=True)
class InterpolationSchemes:
    """``solution/interpolationSchemes``."""

    U: Literal["linear"] = "linear"


@dataclass(frozen=True, kw_only=True)
class IntegrationSchemes:
    """``solution/integrationSchemes``."""

    U: Literal["Euler"] = "Euler"
    shape: Annotated[str, Choice(("auto", *INTEGRATORS))] = "auto"
    tolerance: Annotated[float, Positive] = 1e-4


_NOT_COUPLED = Only(False, "the particles do not act on the flow")


@dataclass(frozen=True, kw_only=True)
class Solution:
    """``solution``."""

    deltaT: Annotated[float, Positive]
    endTime: Annotated[float, Positive]
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


@dataclass(frozen=True, kw_only=True)
class ConstantProperties:
    """``constantProperties``."""

    rho0: Annotated[float, Positive] | Dictionary
    rhoInf: Annotated[float, Positive]
    solid: Dictionary | None = None
    shape: Dictionary | None = None


@dataclass(frozen=True, kw_only=True)
class EllipsoidDrag:
    """``subModels/particleForces/ellipsoidDrag``."""

    type: Annotated[str, Choice(DRAGS)] = "oberbeck"


@dataclass(frozen=True, kw_only=True)
class Gravity:
    """``subModels/particleForces/gravity``, which has no entries."""


_FLUID_VELOCITY = Only("U", "the flow's velocity")


@dataclass(frozen=True, kw_only=True)
class PressureGradient:
    """``subModels/particleForces/pressureGradient``."""

    U: Annotated[str, _FLUID_VELOCITY] = "U"


@dataclass(frozen=True, kw_only=True)
class VirtualMass:
    """``subModels/particleForces/virtualMass``."""

    Cvm: Annotated[float, NonNegative]
    U: Annotated[str, _FLUID_VELOCITY] = "U"


@dataclass(frozen=True, kw_only=True)
class ParticleForces:
    """``subModels/particleForces``."""

    ellipsoidDrag: EllipsoidDrag
    gravity: Gravity | None = None
    pressureGradient: PressureGradient | None = None
    virtualMass: VirtualMass | None = None


_PARCELS = "particles are single, not parcels"
_CONSTANT_RATE = Line("constant 1")


@dataclass(frozen=True, kw_only=True)
class InjectionModel:
    """The entries that every injection model has beside its own."""

    type: Annotated[str, Choice(INJECTIONS)]
    sizeDistribution: Dictionary
    rho0: Annotated[float, Positive] | Dictionary | None = None
    solid: Dictionary | None = None
    shape: Dictionary | None = None
    parcelBasisType: Annotated[str, Only("fixed", _PARCELS)] = "fixed"
    nParticle: Annotated[float, Only(1.0, _PARCELS)] = 1.0
    massTotal: Annotated[float, Only(0.0, f"{_PARCELS}: their mass follows from diameter and rho0")] = 0.0
    flowRateProfile: Annotated[
        Line, Only(_CONSTANT_RATE, "parcelsPerSecond is the rate for the whole duration")
    ] = _CONSTANT_RATE


@dataclass(frozen=True, kw_only=True)
class SubModels:
    """``subModels``, without the coefficients of the patch interaction models."""

    particleForces: ParticleForces
    injectionModels: Dictionary
    patchInteractionModel: Annotated[str, Choice(INTERACTION_MODELS)]
    tractionModel: Annotated[str, Choice(TRACTIONS)] = "roscoe"
    dispersionModel: Literal["none"] = "none"
    heatTransferModel: Literal["none"] = "none"
    surfaceFilmModel: Literal["none"] = "none"
    collisionModel: Literal["none"] = "none"
    stochasticCollisionModel: Literal["none"] = "none"


@dataclass(frozen=True, kw_only=True)
class CloudProperties:
    """The whole file."""

    solution: Solution
    constantProperties: ConstantProperties
    subModels: Dictionary
    cloudFunctions: Dictionary | None = None
    libs: Files | None = None
