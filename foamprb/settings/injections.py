"""Injection models with their particles and solids: from dictionaries to settings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal

from foamprb.body.material import MATERIALS
from foamprb.body.membrane import FLUID, MOST_C, name_of, poissons_ratio_of
from foamprb.body.memory import MOST
from foamprb.cloud.injection.distribution import Distribution, scaled
from foamprb.cloud.injection.models import INJECTIONS, Injection
from foamprb.cloud.injection.shapes import Shape, Sphere
from foamprb.cloud.viscosity import VaryingViscosity, viscosity_at_rate
from foamprb.dictionary.constraints import (
    Bounds,
    Choice,
    Meaning,
    NonNegative,
    Numbers,
    Only,
    PoissonsRatio,
    Positive,
)
from foamprb.dictionary.mistakes import Mistakes, ReportedError
from foamprb.dictionary.schema import allowed, hints_of, names_of, read_entries, read_entry, selected
from foamprb.dictionary.tree import DICTIONARY_TEXT, Dictionary, unquoted
from foamprb.dictionary.values import Line
from foamprb.errors import InputError
from foamprb.results.folder import fault_of_word
from foamprb.settings.fluid import ConstantProperties, Fluid

_ONE_OF_THESE = "one of shearModulus, youngsModulus and Ca is required"
_OF_POWER_LAW = "with `powerLaw` required"


@dataclass(frozen=True, kw_only=True)
class Prony:
    """``relaxation { type prony; … }``: moduli that relax, beside the shear modulus, which stays."""

    type: Annotated[
        Literal["prony"], Meaning("Prony series", values={"prony": "G(t) = shearModulus + Σ G exp(−t/T)"})
    ]
    moduli: Annotated[
        Numbers, Meaning(f"`( G G … )`, shear moduli that relax, at most {MOST}; `shearModulus` stays", "Pa")
    ]
    times: Annotated[Numbers, Meaning("`( T T … )`, their relaxation times", "s")]

    def __post_init__(self) -> None:
        if not 0 < len(self.moduli) <= MOST or len(self.moduli) != len(self.times):
            raise InputError(
                f"has {len(self.moduli)} moduli and {len(self.times)} times. Allowed: as many of both, 1 to "
                f"{MOST}"
            )
        wrong = [x for x in (*self.moduli, *self.times) if not x > 0.0]
        if wrong:
            raise InputError(f"has the modulus or time {wrong[0]:g}. Allowed: numbers > 0")


@dataclass(frozen=True, kw_only=True)
class Solid:
    """``solid``; which of its entries are required depends on the others.

    Of the stiffness, settings have ``shearModulus`` only, whichever entry gave it.
    """

    type: Annotated[
        str,
        Choice(MATERIALS),
        Meaning(
            "[material](models/materials.md), or one from `libs`; one for the whole cloud",
            "",
            "required",
            {
                "neoHooke": "rubber-like solid of constant shear modulus, as a microgel; the usual choice",
                "mooneyRivlin": "rubber-like solid whose energy also depends on the second invariant",
                "gent": "solid that stiffens towards a largest stretch, as chains of a gel do",
                "saintVenantKirchhoff": "linear law of large rotations, for small strains",
                "drop": "[drop](models/drops.md) of a liquid of this viscosity and surface tension",
                "capsule": "[liquid in a thin elastic membrane](models/capsules.md)",
                "powerLaw": "solid whose modulus falls with time as a power, as that of cells and gels does",
            },
        ),
    ] = ""
    bulkModulus: Annotated[
        float | None,
        Positive,
        Meaning(
            "bulk modulus; the default keeps the volume to 10⁻⁴ at the largest γ̇ at release, and larger ones "
            "count as at most ten times the default",
            "Pa",
            "10⁴ max(μ_s, μ_f γ̇)",
        ),
    ] = None
    poissonsRatio: Annotated[
        float | None,
        PoissonsRatio,
        Meaning("Poisson's ratio, in place of `bulkModulus`", "1", "with `youngsModulus` required"),
    ] = None
    shearModulus: Annotated[float | Distribution, Positive, Meaning("shear modulus", "Pa", _ONE_OF_THESE)] = (
        math.nan
    )
    youngsModulus: Annotated[
        float | Distribution | None, Positive, Meaning("Young's modulus", "Pa", _ONE_OF_THESE)
    ] = None
    Ca: Annotated[
        float | Distribution | None,
        Positive,
        Meaning("capillary number μ_f γ̇/μ_s at `referenceShearRate`", "1", _ONE_OF_THESE),
    ] = None
    referenceShearRate: Annotated[
        float | None,
        Positive,
        Meaning(
            "γ̇ of `Ca`; without it the reported Ca is that at the place of release",
            "1/s",
            "with `Ca` required",
        ),
    ] = None
    viscosity: Annotated[
        float | Distribution,
        NonNegative,
        Meaning(
            "[of the solid](models/viscosity.md) (Kelvin–Voigt), or of the liquid of a `drop` or `capsule`",
            "Pa s",
            "0, with `drop` required, with `capsule` by `viscosityRatio`",
        ),
    ] = 0.0
    viscosityRatio: Annotated[
        float | Distribution,
        NonNegative,
        Meaning("viscosity of the liquid in a `capsule` over the fluid's, in place of `viscosity`", "1"),
    ] = 1.0
    surfaceTension: Annotated[
        float | Distribution,
        NonNegative,
        Meaning(
            "[surface tension](models/surface-tension.md), or that of a `drop`",
            "N/m",
            "0, with `drop` required, > 0",
        ),
    ] = 0.0
    surfaceShearModulus: Annotated[
        float | Distribution | None,
        Positive,
        Meaning("of the membrane of a [`capsule`](models/capsules.md)", "N/m", "with `capsule` required"),
    ] = None
    law: Annotated[
        Literal["neoHookean", "Skalak", "small", "fluid"] | None,
        Meaning(
            "of that membrane",
            "",
            "with `capsule` required; `small` with `surfacePoissonsRatio`",
            {
                "neoHookean": "rubber-like; softens where it is stretched",
                "Skalak": "stiffens, and resists changes of its area; as of red blood cells",
                "fluid": "a [vesicle](models/capsules.md#vesicles): without elasticity, of constant area",
                "small": "the solid that is equivalent for small deformation, in place of the membrane",
            },
        ),
    ] = None
    C: Annotated[
        float,
        Bounds(0.0, MOST_C, False, False, f"a number >= 0 and <= {MOST_C:g}"),
        Meaning("resistance to changes of the area over that to shear", "1", "with `Skalak` required"),
    ] = 0.0
    excessArea: Annotated[
        float,
        Bounds(0.01, 20.0, False, False, "a number >= 0.01 and <= 20"),
        Meaning("area of a vesicle over R², less 4π", "1", "with `law fluid` required"),
    ] = 0.0
    bendingModulus: Annotated[
        float, Positive, Meaning("of the membrane of a vesicle, for its capillary number alone", "J")
    ] = 1e-19
    surfacePoissonsRatio: Annotated[
        float | None,
        Bounds(-1.0, 1.0, True, False, "a number > -1 and <= 1"),
        Meaning("of that membrane; 1 where it keeps its area", "1", "with `law small` required"),
    ] = None
    relaxation: Annotated[
        Prony | None, Meaning("[memory](models/memory.md) of the solid: moduli that relax", "", "none")
    ] = None
    k: Annotated[
        float | Distribution | None,
        Positive,
        Meaning("of a [`powerLaw`](models/memory.md#power-law), G(t) = k (ω₀t)^(−α)", "Pa", _OF_POWER_LAW),
    ] = None
    alpha: Annotated[
        float | Distribution | None,
        Bounds(0.0, 1.0, True, True, "a number > 0 and < 1"),
        Meaning("its exponent α", "1", _OF_POWER_LAW),
    ] = None
    referenceFrequency: Annotated[float, Positive, Meaning("ω₀/2π of a `powerLaw`", "Hz")] = 1.0

    @property
    def material(self) -> str:
        """Name in :data:`MATERIALS`, with the law of a membrane."""
        return name_of(self.law or "", self.C) if MATERIALS[self.type].membrane else self.type


STIFFNESS = ("shearModulus", "youngsModulus", "Ca")
"""Entries of a solid of which exactly one is given."""
COMPRESSIBILITY = ("poissonsRatio", "bulkModulus")
"""Entries of a solid of which at most one is given."""
INNER = ("viscosity", "viscosityRatio")
"""Entries of a capsule of which at most one is given."""
LIQUID = ("surfaceTension", "viscosity")
"""Entries of a drop, in place of both."""
MEMBRANE = {
    None: ("surfaceShearModulus", "law"),
    "small": ("surfaceShearModulus", "surfacePoissonsRatio"),
    "neoHookean": ("surfaceShearModulus",),
    "Skalak": ("surfaceShearModulus", "C"),
    "fluid": ("excessArea",),
}
"""Entries of a capsule by its law, in place of a stiffness."""
OF_CAPSULES = (
    *("surfaceShearModulus", "law", "surfacePoissonsRatio", "C", "viscosityRatio"),
    *("excessArea", "bendingModulus"),
)
"""Entries of capsules alone."""
POWER_LAW = ("k", "alpha")
"""Entries of a power law, in place of a stiffness."""


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


_PARCELS = "particles are single, not parcels"
_CONSTANT_RATE = Line("constant 1")


@dataclass(frozen=True, kw_only=True)
class InjectionModel:
    """The entries of every injection model beside its own."""

    type: Annotated[str, Choice(INJECTIONS), Meaning("one of those below")]
    sizeDistribution: Annotated[
        Distribution | None,
        Meaning(
            "[distribution](#distributions) of the diameters, of the sphere of the same volume",
            "m",
            "required, unless a file of positions gives `d`",
        ),
    ] = None
    rho0: Annotated[
        float | Distribution | None,
        Positive,
        Meaning("density of this model's particles", "kg/m³", "that of the cloud"),
    ] = None
    solid: Annotated[
        Dictionary | None, Meaning("[material](#solid) of this model's particles", "", "that of the cloud")
    ] = None
    shape: Annotated[
        Shape | None, Meaning("[shape at rest](#shape) of this model's particles", "", "that of the cloud")
    ] = None
    parcelBasisType: Annotated[str, Only("fixed", _PARCELS)] = "fixed"
    nParticle: Annotated[float, Only(1.0, _PARCELS)] = 1.0
    massTotal: Annotated[float, Only(0.0, f"{_PARCELS}: their mass follows from diameter and rho0")] = 0.0
    flowRateProfile: Annotated[
        Line, Only(_CONSTANT_RATE, "parcelsPerSecond is the rate for the whole duration")
    ] = _CONSTANT_RATE


@dataclass(frozen=True)
class InjectionSettings:
    """An injection model with its particles."""

    name: str
    model: Injection
    rho0: float | Distribution
    """Density, kg/m³."""
    solid: Solid
    parameter: float
    """Third parameter of the solid; 0 if it has none."""
    sizeDistribution: Distribution | None
    """Diameters, m; None if a file of positions must give them."""
    shape: Shape


def read_injections(
    models: Dictionary, constant: Dictionary, properties: ConstantProperties | None, fluid: Fluid
) -> tuple[InjectionSettings, ...]:
    """Read ``injectionModels { name { type …; … } … }``.

    Parameters
    ----------
    models
        The dictionary.
    constant, properties
        The cloud's ``constantProperties``, and its entries, None if they are broken. An injection model's own
        entries replace them.
    fluid
        The fluid to which a capillary number refers.
    """
    entries = [entry for entry in models.entries.values() if isinstance(entry, Dictionary) or not entry.used]
    if not entries:
        raise models.mistake("is empty: there would be no particles.")
    mistakes, injections = Mistakes(), []
    for entry in entries:
        with mistakes:
            injections.append(_injection(entry.dictionary(), constant, properties, fluid))
    mistakes.raise_any()
    return tuple(injections)


def _injection(
    dictionary: Dictionary, constant: Dictionary, properties: ConstantProperties | None, fluid: Fluid
) -> InjectionSettings:
    mistakes = Mistakes()
    name = unquoted(dictionary.key)
    if fault := fault_of_word(name):
        mistakes.add(dictionary.mistake(f"is not a valid name of an injection model: {fault}."))
    names = {key for model in INJECTIONS.values() for key in names_of(model)}
    with mistakes:
        kind = selected(INJECTIONS, dictionary)
        names = set(names_of(kind))
        with mistakes:
            model = read_entries(kind, dictionary, also=names_of(InjectionModel))
    with mistakes:
        common = read_entries(InjectionModel, dictionary, also=names)
        if common.sizeDistribution is None and "positionsFile" not in names:
            hint = hints_of(InjectionModel)["sizeDistribution"]
            raise dictionary.missing("sizeDistribution", allowed(hint))
    with mistakes:
        places = [place for place in (constant, dictionary) if "solid" in place.entries]
        solid, parameter = _solid(places, constant, fluid)
    if properties is None:
        mistakes.add(ReportedError("constantProperties is broken"))
    mistakes.raise_any()
    assert properties is not None
    return InjectionSettings(
        name=name,
        model=model,
        rho0=properties.rho0 if common.rho0 is None else common.rho0,
        solid=solid,
        parameter=parameter,
        sizeDistribution=common.sizeDistribution,
        shape=common.shape or properties.shape or Sphere(),
    )


def _solid(places: Sequence[Dictionary], constant: Dictionary, fluid: Fluid) -> tuple[Solid, float]:
    """Combine the cloud's solid with an injection model's, whose entries replace the cloud's.

    Parameters
    ----------
    places
        ``constantProperties`` and the injection model, as far as they have a ``solid``.
    constant
        ``constantProperties``.
    fluid
        The fluid to which a capillary number refers.

    Returns
    -------
    The solid and its third parameter, 0 if it has none.
    """
    if not places:
        raise constant.missing(
            "solid",
            f"Allowed: {DICTIONARY_TEXT} with type and one of {', '.join(STIFFNESS)}, "
            "here or in every injection model.",
        )
    mistakes = Mistakes()
    combined: dict[str, Any] = {}
    for place in places:
        with mistakes:
            entries = _solid_entries(place.entries["solid"].dictionary())
            for one_of in (STIFFNESS, COMPRESSIBILITY, INNER):
                if entries.keys() & set(one_of):
                    combined = {key: value for key, value in combined.items() if key not in one_of}
            combined |= entries
    # Whether entries are missing depends on valid entries.
    mistakes.raise_any()
    where = places[-1].entries["solid"].dictionary()
    hints = parameters() | hints_of(Solid)
    stiffness = combined.keys() & set(STIFFNESS)
    material = MATERIALS[combined["type"]] if "type" in combined else None
    liquid, membrane = material is not None and material.liquid, material is not None and material.membrane
    fading = material is not None and material.power_law
    if not (stiffness or liquid or membrane or fading):
        mistakes.add(where.mistake(f"gives no stiffness. Allowed: one of {', '.join(STIFFNESS)}."))
    required = {"Ca": "referenceShearRate", "youngsModulus": "poissonsRatio"}
    needed = ["type", *(required[key] for key in stiffness if key in required)]
    if liquid or membrane or fading:
        needed = ["type", *(LIQUID if liquid else POWER_LAW)]
    if membrane:
        law = combined.get("law", "small" if "surfacePoissonsRatio" in combined else None)
        combined |= {"law": law} if law else {}
        needed = ["type", *MEMBRANE[law]]
    parameter = material.parameter if material else None
    if parameter:
        needed.append(parameter.entry)
    for key in needed:
        if key not in combined:
            mistakes.add(where.missing(key, allowed(hints[key])))
    others = {*parameters(), *OF_CAPSULES, *POWER_LAW, *(() if fading else ("referenceFrequency",))}
    others |= {*STIFFNESS, "relaxation"} if liquid or membrane or fading else set()
    others |= set(COMPRESSIBILITY if liquid else ())
    if membrane:
        others -= {"law", "viscosityRatio", *(("bendingModulus",) if law == FLUID else ())}
    for name in sorted(others) if material else ():
        if name in combined and name not in needed:
            mistakes.add(where.mistake(f"gives {name}, which the solid {combined['type']} does not have."))
    by_ratio = membrane and "viscosity" not in combined
    if by_ratio and isinstance(fluid.mu, VaryingViscosity):
        mistakes.add(where.mistake("gives no viscosity, and the fluid's varies. Allowed: viscosity, Pa s."))
    mistakes.raise_any()
    third = combined[parameter.entry] if parameter else 0.0
    solid = Solid(**{name: value for name, value in combined.items() if name in names_of(Solid)})
    if solid.law in ("neoHookean", "Skalak"):
        solid = replace(solid, surfacePoissonsRatio=poissons_ratio_of(solid.law, solid.C))
    if by_ratio:
        solid = replace(solid, viscosity=scaled(solid.viscosityRatio, viscosity_at_rate(fluid.mu, None)))
    return _with_shear_modulus(solid, fluid), third


def _solid_entries(dictionary: Dictionary) -> dict[str, Any]:
    """Read the entries of one ``solid``, as far as it has them; of the stiffness only one."""
    third = parameters()
    mistakes, values = Mistakes(), dict[str, Any]()
    with mistakes:
        solid = read_entries(Solid, dictionary, also=third)
        values = {name: getattr(solid, name) for name in names_of(Solid) if name in dictionary.entries}
    for name, hint in third.items():
        with mistakes:
            if name in dictionary.entries:
                values[name] = read_entry(dictionary, name, hint)
    for one_of in (STIFFNESS, COMPRESSIBILITY, INNER):
        present = [key for key in one_of if key in dictionary.entries]
        if len(present) > 1:
            mistakes.add(
                dictionary.mistake(f"gives {' and '.join(present)}. Allowed: one of {', '.join(one_of)}.")
            )
    mistakes.raise_any()
    return values


def _with_shear_modulus(solid: Solid, fluid: Fluid) -> Solid:
    """Return a solid with μ_s, Pa, from Ca = μ_f γ̇/μ_s or Young's modulus, if it gives one of these."""
    if solid.Ca is not None and solid.referenceShearRate is not None:
        stress = viscosity_at_rate(fluid.mu, solid.referenceShearRate) * solid.referenceShearRate
        return replace(solid, shearModulus=scaled(solid.Ca, stress, -1), Ca=None)
    if solid.youngsModulus is not None and solid.poissonsRatio is not None:
        modulus = scaled(solid.youngsModulus, 0.5 / (1.0 + solid.poissonsRatio))
        return replace(solid, shearModulus=modulus, youngsModulus=None)
    return solid
