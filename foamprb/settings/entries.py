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
from foamprb.cloud.limits import Limits
from foamprb.cloud.surroundings.dispersion import DISPERSIONS
from foamprb.dictionary.constraints import (
    Bounds,
    Choice,
    Fraction,
    Meaning,
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

    U: Annotated[Literal["linear", "cellPoint"], Meaning("the only one; OpenFOAM calls it `cellPoint`")] = (
        "linear"
    )
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

    U: Annotated[Literal["Euler"], Meaning("of the barycentre; the only one")] = "Euler"
    shape: Annotated[
        str,
        Choice(("auto", *INTEGRATORS)),
        Meaning("[integrator of the shape](integrators.md); `auto` chooses by the shape Stokes number"),
    ] = "auto"
    tolerance: Annotated[
        float,
        Positive,
        Meaning("largest error of a step, of the integrators that choose their own steps", "1"),
    ] = 1e-4


_ABOVE_ONE = Bounds(1.0, math.inf, True, True, "a number > 1")
_FROM_ONE = Bounds(1.0, math.inf, False, True, "a number >= 1")
_OF_CONTROL = "that of `system/controlDict`"
_NOT_COUPLED = Only(False, "the particles do not act on the flow")
_NO_SOURCES = NoEffect("the particles do not act on the flow")


@dataclass(frozen=True, kw_only=True)
class Solution:
    """``solution``."""

    deltaT: Annotated[float, Positive, Meaning("tracking step", "s", _OF_CONTROL)] | None = None
    maxDeltaT: (
        Annotated[
            float,
            Positive,
            Meaning(
                "[longest step](integrators.md#steps-longer-than-deltat) of integrators that choose their "
                "own, if the error allows it",
                "s",
                "eight times `deltaT`",
            ),
        ]
        | None
    ) = None
    endTime: (
        Annotated[
            float,
            Positive,
            Meaning("end of the run, which also ends when no particle moves", "s", _OF_CONTROL),
        ]
        | None
    ) = None
    writeInterval: (
        Annotated[
            float,
            Positive,
            Meaning(
                "time between two writings, a multiple of `deltaT`; if `deltaT` or `endTime` is that of "
                "`system/controlDict`, so is this one",
                "s",
                "`endTime`",
            ),
        ]
        | None
    ) = None
    startFrom: (
        Annotated[
            StartFrom,
            Meaning(
                "`startTime`: begin anew; `latestTime`: go on from the last checkpoint, if there is one",
                default="as `startTime` unless an unfinished run is there, which is an error",
            ),
        ]
        | None
    ) = None
    startTime: Annotated[float, Only(0.0, "a cloud begins at time 0"), Meaning("accepted as 0", "s")] = 0.0
    maxFailedFraction: Annotated[
        float,
        Fraction,
        Meaning("the run ends when a larger share of the injected particles has failed", "1"),
    ] = 1.0
    maxStretch: Annotated[
        float,
        _ABOVE_ONE,
        Meaning("a particle that is stretched more, from its shape at rest, fails", "1"),
    ] = Limits.maxStretch
    maxSize: Annotated[
        float,
        Positive,
        Meaning(
            "one whose longest semi-axis is a larger share of the flow's width fails; one that would start "
            "so is an error",
            "1",
        ),
    ] = Limits.maxSize
    maxSubSteps: Annotated[
        float, _FROM_ONE, Meaning("one that needs more time steps in one `deltaT` fails", "1")
    ] = Limits.maxSubSteps
    maxCells: (
        Annotated[
            float,
            Positive,
            Meaning(
                "one whose longest semi-axis is more times the size of the cell that holds its centre (the "
                "cube root of its volume) fails",
                "1",
                "none",
            ),
        ]
        | None
    ) = None
    active: Annotated[bool, Only(True, "the cloud is not active, there is nothing to do")] = True
    coupled: Annotated[bool, _NOT_COUPLED] = False
    transient: Annotated[
        bool,
        Meaning(
            "the flow changes in time: it is read at all its times, or those that `-time a:b` selects, "
            "and is linear between them; the run begins at the first"
        ),
    ] = False
    period: (
        Annotated[
            float, Positive, Meaning("with `transient`: the flow repeats itself after this time", "s", "none")
        ]
        | None
    ) = None
    rotatingZones: Annotated[
        Literal["relative", "absolute"],
        Meaning(
            "[zones of `constant/MRFProperties`](models/rotating-zones.md): particles in them move "
            "relative to the rotor, or with the absolute velocity as if nothing turned"
        ),
    ] = "relative"
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


_ONE_OF_THESE = "one of the three is required"


@dataclass(frozen=True, kw_only=True)
class Solid:
    """``solid``; which of its entries are needed depends on all of them."""

    type: (
        Annotated[
            str,
            Choice(MATERIALS),
            Meaning(
                "[material](models/materials.md), or one from `libs`; one for the whole cloud", "", "required"
            ),
        ]
        | None
    ) = None
    bulkModulus: (
        Annotated[
            float,
            Positive,
            Meaning(
                "bulk modulus; the default keeps the volume to 10⁻⁴ at the largest γ̇ at release",
                "Pa",
                "10⁴ max(μ_s, μ_f γ̇)",
            ),
        ]
        | None
    ) = None
    poissonsRatio: (
        Annotated[
            float,
            PoissonsRatio,
            Meaning("Poisson's ratio, in place of `bulkModulus`", "1", "with `youngsModulus` required"),
        ]
        | None
    ) = None
    shearModulus: (
        Annotated[float, Positive, Meaning("shear modulus", "Pa", _ONE_OF_THESE)] | Dictionary | None
    ) = None
    youngsModulus: (
        Annotated[float, Positive, Meaning("Young's modulus", "Pa", _ONE_OF_THESE)] | Dictionary | None
    ) = None
    Ca: (
        Annotated[
            float,
            Positive,
            Meaning("capillary number μ_f γ̇/μ_s at `referenceShearRate`", "1", _ONE_OF_THESE),
        ]
        | Dictionary
        | None
    ) = None
    referenceShearRate: (
        Annotated[
            float,
            Positive,
            Meaning(
                "γ̇ of `Ca`; without it the reported Ca is that at the place of release",
                "1/s",
                "with `Ca` required",
            ),
        ]
        | None
    ) = None
    viscosity: (
        Annotated[
            float, NonNegative, Meaning("[of the solid](models/viscosity.md) (Kelvin–Voigt)", "Pa s", "0")
        ]
        | Dictionary
        | None
    ) = None
    surfaceTension: (
        Annotated[float, NonNegative, Meaning("[surface tension](models/surface-tension.md)", "N/m", "0")]
        | Dictionary
        | None
    ) = None


STIFFNESS = ("shearModulus", "youngsModulus", "Ca")
"""The entries of a solid of which one gives its stiffness."""

COMPRESSIBILITY = ("poissonsRatio", "bulkModulus")
"""The entries of a solid of which one at most says how it yields to pressure."""


def parameters() -> dict[str, Any]:
    """Return the entries of the solids' third parameters with their type hints, user-made solids included."""
    return {
        p.entry: Annotated[
            float,
            Bounds(p.lower, p.upper, True, math.isinf(p.upper), f"a number > {p.lower:g} and <= {p.upper:g}"),
            Meaning(f"third parameter of `{name}`", "1", f"with `{name}` required"),
        ]
        for name, p in ((name, material.parameter) for name, material in MATERIALS.items())
        if p is not None
    }


_OF_CASE = "that of the case, see [The fluid](#the-fluid)"
_NO_MASS_TRANSFER = NoEffect("the mass of a particle does not change")


@dataclass(frozen=True, kw_only=True)
class ConstantProperties:
    """``constantProperties``."""

    rho0: Annotated[float, Positive, Meaning("density of the particles", "kg/m³")] | Dictionary
    rhoInf: Annotated[Density, Positive, Meaning("density of the fluid", "kg/m³", _OF_CASE)] | None = None
    nu: (
        Annotated[Viscosity, Positive, Meaning("kinematic viscosity of the fluid", "m²/s", _OF_CASE)] | None
    ) = None
    mu: (
        Annotated[
            DynamicViscosity,
            Positive,
            Meaning("dynamic viscosity of the fluid, in place of `nu`", "Pa s", _OF_CASE),
        ]
        | None
    ) = None
    TInf: (
        Annotated[
            float,
            Positive,
            Meaning("temperature of the fluid", "K", "required where the viscosity depends on it"),
        ]
        | None
    ) = None
    solid: (
        Annotated[
            Dictionary,
            Meaning(
                "[material](#solid); an injection model's own `solid` replaces single entries", "", "required"
            ),
        ]
        | None
    ) = None
    shape: (
        Annotated[
            Dictionary, Meaning("[shape at rest](#shape); so may an injection model's own", default="sphere")
        ]
        | None
    ) = None
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

    type: Annotated[str, Choice(DRAGS), Meaning("[law of drag](models/drag.md)")] = "oberbeck"


@dataclass(frozen=True, kw_only=True)
class ParticleForces:
    """``subModels/particleForces``, without those that the registries of forces and surroundings have."""

    ellipsoidDrag: Annotated[EllipsoidDrag, Meaning("drag; `ellipsoidDrag;` alone is enough")]

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

    type: Annotated[str, Choice(INJECTIONS), Meaning("one of those below")]
    sizeDistribution: (
        Annotated[
            Dictionary,
            Meaning(
                "[distribution](#distributions) of the diameters, of the sphere of the same volume",
                "m",
                "required, unless a file of positions gives `d`",
            ),
        ]
        | None
    ) = None
    rho0: (
        Annotated[float, Positive, Meaning("density of this model's particles", "kg/m³", "that of the cloud")]
        | Dictionary
        | None
    ) = None
    solid: (
        Annotated[
            Dictionary, Meaning("[material](#solid) of this model's particles", "", "that of the cloud")
        ]
        | None
    ) = None
    shape: (
        Annotated[
            Dictionary, Meaning("[shape at rest](#shape) of this model's particles", "", "that of the cloud")
        ]
        | None
    ) = None
    parcelBasisType: Annotated[str, Only("fixed", _PARCELS)] = "fixed"
    nParticle: Annotated[float, Only(1.0, _PARCELS)] = 1.0
    massTotal: Annotated[float, Only(0.0, f"{_PARCELS}: their mass follows from diameter and rho0")] = 0.0
    flowRateProfile: Annotated[
        Line, Only(_CONSTANT_RATE, "parcelsPerSecond is the rate for the whole duration")
    ] = _CONSTANT_RATE


_DILUTE = Only("none", "the suspension is dilute, particles do not meet")
_NO_MODEL = NoEffect("there is no such model")


@dataclass(frozen=True, kw_only=True)
class SubModels:
    """``subModels``, without the coefficients of the patch interaction models."""

    particleForces: Annotated[Dictionary, Meaning("[forces](#particleforces); `ellipsoidDrag;` at least")]
    injectionModels: Annotated[
        Dictionary, Meaning("[dictionaries](#injectionmodels), one for each model, any number")
    ]
    patchInteractionModel: Annotated[
        str,
        Choice(INTERACTION_MODELS),
        Meaning("[what patches do](#patch-interaction), with the `…Coeffs` of the model"),
    ]
    tractionModel: Annotated[
        str, Choice(TRACTIONS), Meaning("[traction](models/traction.md) on the surface")
    ] = "roscoe"
    dispersionModel: Annotated[
        str,
        Choice(("none", *DISPERSIONS)),
        Meaning(
            "[dispersion by eddies](models/turbulent-dispersion.md) of a flow that is a mean, with the "
            "`…Coeffs` of the model if wanted"
        ),
    ] = "none"
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

    solution: Annotated[Dictionary, Meaning("[time](#solution) and schemes")]
    constantProperties: Annotated[Dictionary, Meaning("[fluid and particles](#constantproperties)")]
    subModels: Annotated[Dictionary, Meaning("[models](#submodels)")]
    cloudFunctions: (
        Annotated[Dictionary, Meaning("[what is observed](#cloudfunctions)", default="none")] | None
    ) = None
    libs: (
        Annotated[
            Files,
            Meaning(
                "Python files, in `constant` or absolute, that add [solids](models/materials.md)", "", "none"
            ),
        ]
        | None
    ) = None
