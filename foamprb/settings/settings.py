"""What a user asks for: ``constant/softCloudProperties`` of a case → typed, validated settings.

First the settings and how they follow from the entries; then the entries, one frozen dataclass per
dictionary (:mod:`foamprb.dictionary.schema` reads any of them).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import (
    Annotated,
    Any,
    Literal,
    Protocol,
    TypeAlias,
    get_type_hints,
)

from foamprb.body.drag import DRAGS
from foamprb.body.material import MATERIALS
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.forces.base import Force
from foamprb.cloud.forces.registry import FORCES
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution, Scaled, scaled
from foamprb.cloud.injection.models import INJECTIONS, Injection
from foamprb.cloud.injection.shapes import SHAPES, Ellipsoid, Shape, Sphere
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.patches import INTERACTIONS, Cyclic, Escape, Interaction, Mirror, Rebound
from foamprb.cloudfunctions.functions import FUNCTIONS, CloudFunction
from foamprb.dictionary.constraints import (
    Bounds,
    Choice,
    Fraction,
    NonNegative,
    Only,
    PoissonsRatio,
    Positive,
    Vector3,
)
from foamprb.dictionary.grammar import (
    DICTIONARY_TEXT,
    Dictionary,
    DictionaryList,
    Entry,
    read_dictionary,
    unquoted,
)
from foamprb.dictionary.schema import (
    Files,
    Line,
    Viscosity,
    allowed,
    names_of,
    read_entries,
    read_entry,
    refuse_unknown,
    selected,
)
from foamprb.errors import InputError, suggestion
from foamprb.flow.mesh.patch import WALLS
from foamprb.settings.libs import load_libs

Touching: TypeAlias = Literal["ellipsoid", "centre"]
StartFrom: TypeAlias = Literal["startTime", "latestTime"]
DICTIONARY = Path("constant/softCloudProperties")
MULTIPLE_TOLERANCE = 1e-6


# ---------------------------------------------------------------------------------------------------------
# Settings


@dataclass(frozen=True)
class Solution:
    """Time stepping: step, end and write interval, s; the flow in time; the integrator and its tolerance.

    A run begins at time 0 or goes on from its last checkpoint, as ``startFrom`` says, None if the user does
    not; it stops when more than ``maxFailedFraction`` of the injected particles have failed.
    """

    deltaT: float
    endTime: float
    writeInterval: float
    shape: str
    tolerance: float
    transient: bool = False
    """Whether the flow changes in time; its time is then that of the run."""
    period: float | None = None
    """Time after which a transient flow repeats itself, s."""
    startFrom: StartFrom | None = None
    maxFailedFraction: float = 1.0


@dataclass(frozen=True)
class Fluid:
    """Density rho, kg/m3, and kinematic viscosity nu, m2/s."""

    rho: float
    nu: float

    @property
    def mu(self) -> float:
        """Dynamic viscosity, Pa s."""
        return self.rho * self.nu


@dataclass(frozen=True)
class Solid:
    """A particle's material: μ_s, Pa, and ν_s, the shear rate of its Ca, 1/s, η_s, Pa s, and γ, N/m."""

    type: str
    shear_modulus: float | Distribution
    poissons_ratio: float
    reference_shear_rate: float | None = None
    parameter: float = 0.0
    viscosity: float | Distribution = 0.0
    surface_tension: float | Distribution = 0.0


@dataclass(frozen=True)
class InjectionSettings:
    """One injection model: where and when particles appear, and what they are; rho in kg/m3."""

    name: str
    model: Injection
    rho: float | Distribution
    solid: Solid
    size: Distribution
    shape: Shape


@dataclass(frozen=True)
class PatchRule:
    """What the patches do whose name or group is ``pattern`` or, if that is a ``regex``, matches it."""

    pattern: str
    interaction: Interaction
    regex: bool = False

    def matches(self, word: str) -> bool:
        """Whether the whole ``word`` is or matches the pattern."""
        return re.fullmatch(self.pattern, word) is not None if self.regex else self.pattern == word


@dataclass(frozen=True)
class KindRule:
    """What all patches of a kind do: the walls, the open ones (neither walls nor constrained), or any."""

    kind: Literal["wall", "open", "any"]
    interaction: Interaction


Rule: TypeAlias = PatchRule | KindRule


@dataclass(frozen=True)
class Settings:
    """All that a user asks for; gravity in m/s2, zero if it is not among the forces."""

    case: Path
    file: Path
    name: str
    solution: Solution
    fluid: Fluid
    gravity: Vector3
    traction: str
    drag: str
    injections: tuple[InjectionSettings, ...]
    interaction: str
    touching: Touching
    patches: tuple[Rule, ...]
    functions: Mapping[str, CloudFunction]
    forces: Mapping[str, Force]
    region: str = ""


def read_settings(case: Path, dictionary: Path | None = None, region: str = "") -> Settings:
    """Read and validate the settings of a cloud.

    Parameters
    ----------
    case
        The case; ν comes from its ``constant/transportProperties`` and, if ``gravity`` is among the
        particle forces, g from its ``constant/g``.
    dictionary
        The cloud's dictionary, relative to the case; ``constant/softCloudProperties`` by default.
    region
        Region of the mesh: its files in ``constant/REGION`` go before those in ``constant``.

    Raises
    ------
    InputError
        At the first mistake: the file, the line, the entry's path, what was found and what is allowed.
    """
    file = case / (dictionary or _of_region(case, region, DICTIONARY.name))
    root = read_dictionary(file, case)
    if "libs" in root.entries:
        load_libs(read_entry(root, "libs", Files))
    cloud = read_entries(_CloudProperties, root, also=("libs",))
    fluid = Fluid(rho=cloud.constantProperties.rhoInf, nu=_viscosity(case, region))
    models = cloud.subModels
    drag, forces = _forces(models.particleForces)
    patches, touching = _patch_interaction(models.patchInteractionModel, root.at("subModels").dictionary())
    return Settings(
        case=case,
        file=file,
        name=file.stem.removesuffix("Properties") or file.stem,
        solution=_solution(cloud.solution, root),
        fluid=fluid,
        gravity=_gravity(case, region) if "gravity" in forces else (0.0, 0.0, 0.0),
        traction=models.tractionModel,
        drag=drag.type,
        injections=_injections(models.injectionModels, cloud.constantProperties, root, fluid),
        interaction=models.patchInteractionModel,
        touching=touching,
        patches=patches,
        functions=_functions(cloud.cloudFunctions),
        forces=forces,
        region=region,
    )


def _of_region(case: Path, region: str, name: str) -> Path:
    """A file of a region, or of the case where the region has none, relative to the case."""
    own = Path("constant") / region / name
    return own if (case / own).is_file() else Path("constant") / name


def _solution(entries: _Solution, root: Dictionary) -> Solution:
    interval = entries.writeInterval
    if interval is not None:
        steps = max(round(interval / entries.deltaT), 1)
        if abs(steps * entries.deltaT - interval) > MULTIPLE_TOLERANCE * interval:
            raise root.at("solution/writeInterval").mistake(
                f"is {interval:g}. Allowed: a multiple of deltaT = {entries.deltaT:g}."
            )
    if entries.period is not None and not entries.transient:
        raise root.at("solution/period").mistake("needs a flow that changes in time: transient yes.")
    return Solution(
        deltaT=entries.deltaT,
        endTime=entries.endTime,
        writeInterval=entries.endTime if interval is None else interval,
        shape=entries.integrationSchemes.shape,
        tolerance=entries.integrationSchemes.tolerance,
        transient=entries.transient,
        period=entries.period,
        startFrom=entries.startFrom,
        maxFailedFraction=entries.maxFailedFraction,
    )


def _injections(
    models: Dictionary, constant: _ConstantProperties, root: Dictionary, fluid: Fluid
) -> tuple[InjectionSettings, ...]:
    entries = [entry for entry in models.entries.values() if isinstance(entry, Dictionary) or not entry.used]
    if not entries:
        raise models.mistake("is empty: no particle would ever appear.")
    return tuple(_injection(entry.dictionary(), constant, root, fluid) for entry in entries)


def _injection(
    dictionary: Dictionary, constant: _ConstantProperties, root: Dictionary, fluid: Fluid
) -> InjectionSettings:
    model = selected(INJECTIONS, dictionary)
    common = read_entries(_InjectionModel, dictionary, also=names_of(model))
    solids = [solid for solid in (constant.solid, common.solid) if solid is not None]
    return InjectionSettings(
        name=dictionary.key,
        model=read_entries(model, dictionary, also=names_of(_InjectionModel)),
        rho=_quantity(constant.rho0 if common.rho0 is None else common.rho0),
        solid=_solid(solids, fluid, where=solids[-1] if solids else root.at("constantProperties")),
        size=_distribution(common.sizeDistribution),
        shape=_shape(common.shape or constant.shape),
    )


def _shape(dictionary: Dictionary | None) -> Shape:
    """Read ``shape { type ellipsoid; … }``; without it particles are spheres."""
    if dictionary is None:
        return Sphere()
    shape: Shape = read_entries(selected(SHAPES, dictionary), dictionary, also=("type",))
    if isinstance(shape, Ellipsoid):
        try:
            shape.axes()
        except ValueError as error:
            raise dictionary.mistake(f"gives no orientation: {error}.") from error
    return shape


def _quantity(found: float | Dictionary) -> float | Distribution:
    """A positive number, or a distribution of such numbers."""
    return _distribution(found) if isinstance(found, Dictionary) else found


def _distribution(dictionary: Dictionary) -> Distribution:
    """Read ``{ type name; nameDistribution { … } }``, a distribution of positive numbers."""
    kind = selected(DISTRIBUTIONS, dictionary)
    coefficients = f"{read_entry(dictionary, 'type', str)}Distribution"
    refuse_unknown(dictionary, ("type", coefficients))
    if coefficients not in dictionary.entries:
        raise dictionary.missing(coefficients, f"Allowed: {DICTIONARY_TEXT}.")
    entries = dictionary.entries[coefficients].dictionary()
    distribution: Distribution = read_entries(kind, entries)
    if not distribution.limits[0] > 0.0:
        raise entries.mistake(f"begins at {distribution.limits[0]:g}. Allowed: values > 0.")
    return distribution


def _solid(dictionaries: Sequence[Dictionary], fluid: Fluid, where: Entry) -> Solid:
    """Combine the cloud's solid with an injection model's, whose entries replace the cloud's.

    Parameters
    ----------
    dictionaries
        The cloud's ``solid`` and the injection model's, as far as they exist.
    fluid
        The fluid that a capillary number refers to.
    where
        The dictionary that a message about a missing entry names.
    """
    entries: dict[str, Any] = {}
    parameters = _parameters()
    for dictionary in dictionaries:
        read = vars(read_entries(_Solid, dictionary, also=parameters))
        own = {key: value for key, value in read.items() if value is not None}
        own |= {
            name: read_entry(dictionary, name, hint)
            for name, hint in parameters.items()
            if name in dictionary.entries
        }
        stiffness = [key for key in _STIFFNESS if key in own]
        if len(stiffness) > 1:
            raise dictionary.mistake(
                f"gives {' and '.join(stiffness)}. Allowed: one of {', '.join(_STIFFNESS)}."
            )
        if stiffness:
            entries = {key: value for key, value in entries.items() if key not in _STIFFNESS}
        entries |= own
    if not entries.keys() & set(_STIFFNESS):
        raise where.mistake(f"gives no stiffness. Allowed: one of {', '.join(_STIFFNESS)}.")
    hints = get_type_hints(_Solid, include_extras=True)
    for key in ("type", "poissonsRatio", *(["referenceShearRate"] if "Ca" in entries else [])):
        if key not in entries:
            raise where.missing(key, allowed(hints[key]))
    parameter = MATERIALS[entries["type"]].parameter
    for name, hint in parameters.items():
        if parameter is not None and name == parameter.entry and name not in entries:
            raise where.missing(name, allowed(hint))
        if name in entries and (parameter is None or name != parameter.entry):
            raise where.mistake(f"gives {name}, which the solid {entries['type']} does not have.")
    mu = _shear_modulus(entries, fluid)
    return Solid(
        type=entries["type"],
        shear_modulus=mu,
        poissons_ratio=entries["poissonsRatio"],
        reference_shear_rate=entries.get("referenceShearRate"),
        parameter=entries[parameter.entry] if parameter else 0.0,
        viscosity=_quantity(entries.get("viscosity", 0.0)),
        surface_tension=_quantity(entries.get("surfaceTension", 0.0)),
    )


def _shear_modulus(solid: Mapping[str, Any], fluid: Fluid) -> float | Distribution:
    """μ_s, Pa, of a solid that gives one of ``_STIFFNESS``; Ca = μ_f γ̇/μ_s."""
    if "Ca" in solid:
        return _scaled(_quantity(solid["Ca"]), fluid.mu * solid["referenceShearRate"], power=-1)
    if "youngsModulus" in solid:
        return _scaled(_quantity(solid["youngsModulus"]), 0.5 / (1.0 + solid["poissonsRatio"]))
    return _quantity(solid["shearModulus"])


def _scaled(quantity: float | Distribution, factor: float, power: int = 1) -> float | Distribution:
    """``factor`` times a power of a quantity, distributed or not."""
    if isinstance(quantity, float):
        return float(scaled(quantity, factor, power))
    return Scaled(quantity, factor, power)


def _functions(dictionary: Dictionary | None) -> dict[str, CloudFunction]:
    """Read ``cloudFunctions { name { type …; … } … }``."""
    functions: dict[str, CloudFunction] = {}
    for entry in dictionary.entries.values() if dictionary else ():
        name, own = unquoted(entry.key), entry.dictionary()
        if Path(name).name != name:
            raise entry.mistake("is no name of a folder, which the results need.")
        functions[name] = read_entries(selected(FUNCTIONS, own), own, also=("type",))
    return functions


def _forces(dictionary: Dictionary) -> tuple[_EllipsoidDrag, dict[str, Force]]:
    """Read ``particleForces { ellipsoidDrag { … } gravity; … }``: the drag, and the others by name."""
    drag = read_entries(_ParticleForces, dictionary, also=FORCES).ellipsoidDrag
    chosen = {name: kind for name, kind in FORCES.items() if name in dictionary.entries}
    return drag, {name: read_entry(dictionary, name, kind) for name, kind in chosen.items()}


def _patch_interaction(model: str, models: Dictionary) -> tuple[tuple[Rule, ...], Touching]:
    """Read the coefficients of a patch interaction model: rules for the patches, and what touches."""
    coefficients: Dictionary = read_entry(models, f"{model}Coeffs", Dictionary)
    touching: Touching = "ellipsoid"
    if "touching" in coefficients.entries:
        touching = read_entry(coefficients, "touching", Touching)
    return INTERACTION_MODELS[model](coefficients), touching


def _local_interaction(dictionary: Dictionary) -> tuple[Rule, ...]:
    """Rules patch by patch."""
    entries = read_entries(_LocalInteraction, dictionary, also=("touching",))
    return tuple(_patch_rule(entry) for entry in entries.patches.items)


def _standard_wall_interaction(dictionary: Dictionary) -> tuple[Rule, ...]:
    """One rule for all walls; particles leave through what is open."""
    walls = read_entries(selected(INTERACTIONS, dictionary), dictionary, also=("type", "touching"))
    return KindRule("wall", walls), KindRule("open", Escape())


def _rebound(dictionary: Dictionary) -> tuple[Rule, ...]:
    """Particles bounce off every patch; twice UFactor of the normal velocity is taken away."""
    entries = read_entries(_Rebound, dictionary, also=("touching",))
    return (KindRule("any", Rebound(e=2.0 * entries.UFactor - 1.0)),)


INTERACTION_MODELS: dict[str, Callable[[Dictionary], tuple[Rule, ...]]] = {
    "localInteraction": _local_interaction,
    "rebound": _rebound,
    "standardWallInteraction": _standard_wall_interaction,
}
"""Patch interaction models: what their coefficients mean for the patches."""


def _patch_rule(dictionary: Dictionary) -> PatchRule:
    pattern, regex = unquoted(dictionary.key), dictionary.key.startswith('"')
    if regex:
        try:
            re.compile(pattern)
        except re.error as error:
            raise dictionary.mistake(f"is not a regular expression: {error}.") from error
    interaction = read_entries(selected(INTERACTIONS, dictionary), dictionary, also=("type",))
    return PatchRule(pattern, interaction, regex)


def _viscosity(case: Path, region: str) -> float:
    """Read ν, m2/s, with its name and dimensions or without."""
    root = read_dictionary(case / _of_region(case, region, "transportProperties"), case)
    if "transportModel" in root.entries:
        read_entry(root, "transportModel", Literal["Newtonian"])
    coefficients = root.entries.get("NewtonianCoeffs", root).dictionary()
    return float(read_entry(coefficients, "nu", Annotated[Viscosity, Positive]))


def _gravity(case: Path, region: str) -> Vector3:
    """Read g, m/s2."""
    root = read_dictionary(case / _of_region(case, region, "g"), case)
    g: Vector3 = read_entry(root, "value", Vector3)
    return g


# ---------------------------------------------------------------------------------------------------------
# Patches


class Patch(Protocol):
    """A boundary patch: its name, OpenFOAM's type (``patch``, ``wall``, …), the patch it is coupled to."""

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def type(self) -> str: ...  # noqa: D102
    @property
    def neighbour(self) -> str: ...  # noqa: D102


_MIRRORS = frozenset({"empty", "symmetry", "symmetryPlane", "wedge"})
_COUPLED = ("cyclic", "processor")


def match_patches(
    rules: Sequence[Rule], patches: Sequence[Patch], file: Path | str = DICTIONARY
) -> list[Interaction]:
    """Find what each patch does to a particle, as OpenFOAM's patch interaction models do.

    The first rule counts whose pattern matches the patch's name or its group (a ``wall`` belongs to the group
    of that name, as does a patch of a constraint type). Without a rule, a particle goes on beyond a cyclic
    patch or a wedge from its neighbour, and symmetry planes and empty patches mirror it.

    Parameters
    ----------
    rules, patches
        As the settings list them, and the mesh.
    file
        The file that a message names.

    Raises
    ------
    InputError
        If a rule matches no patch, or a patch of another kind is left without a rule.
    """
    where = f"{file}: subModels/localInteractionCoeffs/patches"
    for rule in rules:
        if isinstance(rule, PatchRule) and not any(_applies(rule, patch) for patch in patches):
            names = [patch.name for patch in patches]
            raise InputError(f"{where}/{rule.pattern} matches no patch. {suggestion(rule.pattern, names)}")
    return [_interaction(rules, patch, file, where) for patch in patches]


def _interaction(rules: Sequence[Rule], patch: Patch, file: Path | str, where: str) -> Interaction:
    for rule in rules:
        if _applies(rule, patch):
            return rule.interaction
    if patch.neighbour and patch.type in ("cyclic", "wedge"):
        return Cyclic()
    if patch.type in _MIRRORS:
        return Mirror()
    if patch.type == "cyclic":
        raise InputError(f"{where}: the cyclic patch '{patch.name}' names no neighbourPatch to go on from.")
    if patch.type.startswith(_COUPLED):
        raise InputError(
            f"{file}: particles cannot pass through '{patch.name}', a patch of type {patch.type}; of the "
            "coupled patches only cyclic ones, whose faces fit one to one, let them through. Give it an "
            f"entry of its own ({', '.join(INTERACTIONS)})."
        )
    raise InputError(f"{where} has no entry for the patch '{patch.name}'.")


def _applies(rule: Rule, patch: Patch) -> bool:
    group = "wall" if patch.type in WALLS else patch.type
    constrained = group in _MIRRORS or group.startswith(_COUPLED)
    if isinstance(rule, KindRule):
        kind = "wall" if group == "wall" else "constrained" if constrained else "open"
        return rule.kind in (kind, "any")
    return rule.matches(patch.name) or ((group == "wall" or constrained) and rule.matches(group))


# ---------------------------------------------------------------------------------------------------------
# Entries


_CONSTANT_RATE = Line("constant 1")
_PARCELS = "particles are single, not parcels"


@dataclass(frozen=True, kw_only=True)
class _InterpolationSchemes:
    U: Literal["linear"] = "linear"


@dataclass(frozen=True, kw_only=True)
class _IntegrationSchemes:
    U: Literal["Euler"] = "Euler"
    shape: Annotated[str, Choice(("auto", *INTEGRATORS))] = "auto"
    tolerance: Annotated[float, Positive] = 1e-4


@dataclass(frozen=True, kw_only=True)
class _Solution:
    deltaT: Annotated[float, Positive]
    endTime: Annotated[float, Positive]
    writeInterval: Annotated[float, Positive] | None = None
    startFrom: StartFrom | None = None
    startTime: Annotated[float, Only(0.0, "a cloud begins at time 0")] = 0.0
    maxFailedFraction: Annotated[float, Fraction] = 1.0
    active: Annotated[bool, Only(True, "the cloud is not active, there is nothing to do")] = True
    coupled: Annotated[bool, Only(False, "the particles do not act on the flow")] = False
    transient: bool = False
    period: Annotated[float, Positive] | None = None
    cellValueSourceCorrection: Annotated[bool, Only(False, "the particles do not act on the flow")] = False
    interpolationSchemes: _InterpolationSchemes = _InterpolationSchemes()
    integrationSchemes: _IntegrationSchemes = _IntegrationSchemes()


@dataclass(frozen=True, kw_only=True)
class _Solid:
    type: Annotated[str, Choice(MATERIALS)] | None = None
    poissonsRatio: Annotated[float, PoissonsRatio] | None = None
    shearModulus: Annotated[float, Positive] | Dictionary | None = None
    youngsModulus: Annotated[float, Positive] | Dictionary | None = None
    Ca: Annotated[float, Positive] | Dictionary | None = None
    referenceShearRate: Annotated[float, Positive] | None = None
    viscosity: Annotated[float, NonNegative] | Dictionary | None = None
    surfaceTension: Annotated[float, NonNegative] | Dictionary | None = None


_STIFFNESS = ("shearModulus", "youngsModulus", "Ca")


def _parameters() -> dict[str, Any]:
    """Return the entries of the solids' third parameters, those of the user's own solids included."""
    return {
        p.entry: Annotated[
            float,
            Bounds(p.lower, p.upper, True, math.isinf(p.upper), f"a number > {p.lower:g} and <= {p.upper:g}"),
        ]
        for p in (material.parameter for material in MATERIALS.values())
        if p is not None
    }


@dataclass(frozen=True, kw_only=True)
class _ConstantProperties:
    rho0: Annotated[float, Positive] | Dictionary
    rhoInf: Annotated[float, Positive]
    solid: Dictionary | None = None
    shape: Dictionary | None = None


@dataclass(frozen=True, kw_only=True)
class _EllipsoidDrag:
    type: Annotated[str, Choice(DRAGS)] = "oberbeck"


@dataclass(frozen=True, kw_only=True)
class _ParticleForces:
    """What ``particleForces`` reads beside :data:`FORCES`."""

    ellipsoidDrag: _EllipsoidDrag


@dataclass(frozen=True, kw_only=True)
class _InjectionModel:
    """What every injection model reads beside its own entries."""

    type: Annotated[str, Choice(INJECTIONS)]
    sizeDistribution: Dictionary
    rho0: Annotated[float, Positive] | Dictionary | None = None
    solid: Dictionary | None = None
    shape: Dictionary | None = None
    parcelBasisType: Annotated[str, Only("fixed", _PARCELS)] = "fixed"
    nParticle: Annotated[float, Only(1.0, _PARCELS)] = 1.0
    massTotal: Annotated[float, Only(0.0, f"{_PARCELS}: their mass follows from diameter and rho0")] = 0.0
    flowRateProfile: Annotated[
        Line, Only("constant 1", "parcelsPerSecond is the rate for the whole duration")
    ] = _CONSTANT_RATE


@dataclass(frozen=True, kw_only=True)
class _LocalInteraction:
    patches: DictionaryList


@dataclass(frozen=True, kw_only=True)
class _Rebound:
    UFactor: Annotated[float, Bounds(0.5, 1.0, False, False, "a number from 0.5 to 1")]


@dataclass(frozen=True, kw_only=True)
class _SubModels:
    particleForces: Dictionary
    injectionModels: Dictionary
    patchInteractionModel: Annotated[str, Choice(INTERACTION_MODELS)]
    localInteractionCoeffs: Dictionary | None = None
    standardWallInteractionCoeffs: Dictionary | None = None
    reboundCoeffs: Dictionary | None = None
    tractionModel: Annotated[str, Choice(TRACTIONS)] = "roscoe"
    dispersionModel: Literal["none"] = "none"
    heatTransferModel: Literal["none"] = "none"
    surfaceFilmModel: Literal["none"] = "none"
    collisionModel: Literal["none"] = "none"
    stochasticCollisionModel: Literal["none"] = "none"


@dataclass(frozen=True, kw_only=True)
class _CloudProperties:
    solution: _Solution
    constantProperties: _ConstantProperties
    subModels: _SubModels
    cloudFunctions: Dictionary | None = None
