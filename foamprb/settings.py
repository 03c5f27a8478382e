"""What a user asks for: ``constant/softCloudProperties`` of a case → typed, validated settings.

Three floors, from the top: the settings and how they follow from the entries; the entries, one frozen
dataclass per dictionary, whose field names are the entries' own words, and one function that reads any of
them; the grammar of OpenFOAM's dictionaries with macros and includes.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, field, fields, replace
from pathlib import Path
from types import UnionType
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    Literal,
    NamedTuple,
    NewType,
    Protocol,
    TypeAlias,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from foamprb.body.drag import DRAGS
from foamprb.body.imex import INTEGRATORS
from foamprb.body.material import MATERIALS, lame_parameter
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.injection import INJECTIONS, SIZE_DISTRIBUTIONS, FixedValue, Injection, Vector3
from foamprb.cloud.patches import INTERACTIONS, Interaction, Rebound
from foamprb.entries import Bounds, PoissonsRatio, Positive
from foamprb.errors import InputError, suggestion

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Record = TypeVar("Record", bound="DataclassInstance")
Touching: TypeAlias = Literal["ellipsoid", "centre"]
Line = NewType("Line", str)
"""An entry's whole text, of one word or more."""
Viscosity = NewType("Viscosity", float)
"""A kinematic viscosity, m2/s, that may be written with its name and dimensions."""

DICTIONARY = Path("constant/softCloudProperties")
MULTIPLE_TOLERANCE = 1e-6


# ---------------------------------------------------------------------------------------------------------
# Settings


@dataclass(frozen=True)
class Solution:
    """Time stepping: step, end and write interval, s, and the integrator of the shape."""

    deltaT: float
    endTime: float
    writeInterval: float
    shape: str


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
    """A particle's material: its name, μ_s and λ_s, Pa, and the shear rate that its Ca refers to, 1/s."""

    type: str
    shear_modulus: float
    lame: float
    reference_shear_rate: float | None = None


@dataclass(frozen=True)
class InjectionSettings:
    """One injection model: where and when particles appear, and what they are; rho in kg/m3."""

    name: str
    model: Injection
    rho: float
    solid: Solid
    size: FixedValue


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
class Settings:
    """All that a user asks for; gravity in m/s2."""

    case: Path
    file: Path
    name: str
    solution: Solution
    fluid: Fluid
    gravity: Vector3
    traction: str
    drag: str
    touching: Touching
    injections: tuple[InjectionSettings, ...]
    patches: tuple[PatchRule, ...]


def read_settings(case: Path, dictionary: Path | None = None) -> Settings:
    """Read and validate the settings of a cloud.

    Parameters
    ----------
    case
        The case; ν comes from its ``constant/transportProperties`` and, if ``gravity`` is among the
        particle forces, g from its ``constant/g``.
    dictionary
        The cloud's dictionary, relative to the case; ``constant/softCloudProperties`` by default.

    Raises
    ------
    InputError
        At the first mistake: the file, the line, the entry's path, what was found and what is allowed.
    """
    file = case / (dictionary or DICTIONARY)
    root = read_dictionary(file, case)
    cloud = read_entries(_CloudProperties, root)
    fluid = Fluid(rho=cloud.constantProperties.rhoInf, nu=_viscosity(case))
    models = cloud.subModels
    return Settings(
        case=case,
        file=file,
        name=file.stem.removesuffix("Properties") or file.stem,
        solution=_solution(cloud.solution, root),
        fluid=fluid,
        gravity=_gravity(case) if models.particleForces.gravity else (0.0, 0.0, 0.0),
        traction=models.tractionModel,
        drag=models.particleForces.ellipsoidDrag.type,
        touching=models.localInteractionCoeffs.touching,
        injections=_injections(models.injectionModels, cloud.constantProperties, root, fluid),
        patches=tuple(_patch_rule(entry) for entry in models.localInteractionCoeffs.patches.items),
    )


def _solution(entries: _Solution, root: Dictionary) -> Solution:
    interval = entries.writeInterval
    if interval is not None:
        steps = max(round(interval / entries.deltaT), 1)
        if abs(steps * entries.deltaT - interval) > MULTIPLE_TOLERANCE * interval:
            raise root.at("solution/writeInterval").mistake(
                f"is {interval:g}. Allowed: a multiple of deltaT = {entries.deltaT:g}."
            )
    return Solution(
        deltaT=entries.deltaT,
        endTime=entries.endTime,
        writeInterval=entries.endTime if interval is None else interval,
        shape=entries.integrationSchemes.shape,
    )


def _injections(
    models: Dictionary, constant: _ConstantProperties, root: Dictionary, fluid: Fluid
) -> tuple[InjectionSettings, ...]:
    entries = [entry for entry in models.entries.values() if isinstance(entry, Dictionary) or not entry.used]
    if not entries:
        raise models.mistake("is empty: no particle would ever appear.")
    return tuple(_injection(_as_dictionary(entry), constant, root, fluid) for entry in entries)


def _injection(
    dictionary: Dictionary, constant: _ConstantProperties, root: Dictionary, fluid: Fluid
) -> InjectionSettings:
    model = _selected(INJECTIONS, dictionary)
    common = read_entries(_InjectionModel, dictionary, also=_names(model))
    solids = [solid for solid in (constant.solid, common.solid) if solid is not None]
    return InjectionSettings(
        name=dictionary.key,
        model=read_entries(model, dictionary, also=_names(_InjectionModel)),
        rho=constant.rho0 if common.rho0 is None else common.rho0,
        solid=_solid(solids, fluid, where=solids[-1] if solids else root.at("constantProperties")),
        size=_size_distribution(common.sizeDistribution),
    )


def _size_distribution(dictionary: Dictionary) -> FixedValue:
    """Read ``sizeDistribution { type name; nameDistribution { … } }``."""
    distribution = _selected(SIZE_DISTRIBUTIONS, dictionary)
    coefficients = f"{read_entry(dictionary, 'type', str)}Distribution"
    _refuse_unknown(dictionary, ("type", coefficients))
    size: FixedValue = read_entry(dictionary, coefficients, distribution)
    return size


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
    for dictionary in dictionaries:
        own = {
            key: value for key, value in vars(read_entries(_Solid, dictionary)).items() if value is not None
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
            raise where.missing(key, _allowed(hints[key]))
    mu = _shear_modulus(entries, fluid)
    return Solid(
        type=entries["type"],
        shear_modulus=mu,
        lame=lame_parameter(mu, entries["poissonsRatio"]),
        reference_shear_rate=entries.get("referenceShearRate"),
    )


def _shear_modulus(solid: Mapping[str, Any], fluid: Fluid) -> float:
    """μ_s, Pa, of a solid that gives one of ``_STIFFNESS``; Ca = μ_f γ̇/μ_s."""
    if "Ca" in solid:
        return float(fluid.mu * solid["referenceShearRate"] / solid["Ca"])
    if "youngsModulus" in solid:
        return float(solid["youngsModulus"] / (2.0 * (1.0 + solid["poissonsRatio"])))
    return float(solid["shearModulus"])


def _patch_rule(dictionary: Dictionary) -> PatchRule:
    pattern, regex = _unquoted(dictionary.key), dictionary.key.startswith('"')
    if regex:
        try:
            re.compile(pattern)
        except re.error as error:
            raise dictionary.mistake(f"is not a regular expression: {error}.") from error
    interaction = read_entries(_selected(INTERACTIONS, dictionary), dictionary, also=("type",))
    return PatchRule(pattern, interaction, regex)


def _viscosity(case: Path) -> float:
    """Read ν, m2/s, with its name and dimensions or without."""
    root = read_dictionary(case / "constant/transportProperties", case)
    if "transportModel" in root.entries:
        read_entry(root, "transportModel", Literal["Newtonian"])
    coefficients = _as_dictionary(root.entries.get("NewtonianCoeffs", root))
    return float(read_entry(coefficients, "nu", Annotated[Viscosity, Positive]))


def _gravity(case: Path) -> Vector3:
    """Read g, m/s2."""
    g: Vector3 = read_entry(read_dictionary(case / "constant/g", case), "value", Vector3)
    return g


# ---------------------------------------------------------------------------------------------------------
# Patches


class Patch(Protocol):
    """A boundary patch of a mesh: its name, and OpenFOAM's type (``patch``, ``wall``, ``symmetry``, …)."""

    @property
    def name(self) -> str: ...  # noqa: D102
    @property
    def type(self) -> str: ...  # noqa: D102


_MIRRORS = frozenset({"empty", "symmetry", "symmetryPlane", "wedge"})
_COUPLED = ("cyclic", "processor")


def match_patches(
    rules: Sequence[PatchRule], patches: Sequence[Patch], file: Path | str = DICTIONARY
) -> list[Interaction]:
    """Find what each patch does to a particle, as OpenFOAM's ``localInteraction`` does.

    The first rule counts whose pattern matches the patch's name or its group (a ``wall`` belongs to the group
    of that name, as does a patch of a constraint type). Without a rule, symmetry planes, wedges and empty
    patches mirror the particle.

    Parameters
    ----------
    rules, patches
        As the settings list them, and the mesh.
    file
        The file that a message names.

    Raises
    ------
    InputError
        If a rule matches no patch, or a patch that mirrors nothing is left without a rule.
    """
    where = f"{file}: subModels/localInteractionCoeffs/patches"
    for rule in rules:
        if not any(_applies(rule, patch) for patch in patches):
            names = [patch.name for patch in patches]
            raise InputError(f"{where}/{rule.pattern} matches no patch. {suggestion(rule.pattern, names)}")
    return [_interaction(rules, patch, where) for patch in patches]


def _interaction(rules: Sequence[PatchRule], patch: Patch, where: str) -> Interaction:
    for rule in rules:
        if _applies(rule, patch):
            return rule.interaction
    if patch.type in _MIRRORS:
        return Rebound(e=1.0, mu=0.0)
    if patch.type.startswith(_COUPLED):
        raise InputError(f"{where}: particles cannot yet pass through '{patch.name}', a {patch.type} patch.")
    raise InputError(f"{where} has no entry for the patch '{patch.name}'.")


def _applies(rule: PatchRule, patch: Patch) -> bool:
    is_group = patch.type == "wall" or patch.type in _MIRRORS or patch.type.startswith(_COUPLED)
    return rule.matches(patch.name) or (is_group and rule.matches(patch.type))


# ---------------------------------------------------------------------------------------------------------
# Entries


@dataclass(frozen=True, eq=False)
class Choice:
    """The names that a word may be, in most cases a registry."""

    names: Collection[str]

    def admits(self, value: str) -> bool:
        """Whether ``value`` is one of the names."""
        return value in self.names


@dataclass(frozen=True)
class Only:
    """The one value that means what foamprb does, for entries that OpenFOAM's users know; and why."""

    value: bool | float | str
    why: str

    def admits(self, value: bool | float | str) -> bool:
        """Whether ``value`` is the one."""
        return value == self.value


Rule: TypeAlias = Bounds | Choice | Only
_PARCELS = "particles are single, not parcels"


@dataclass(frozen=True, kw_only=True)
class _InterpolationSchemes:
    U: Literal["linear"] = "linear"


@dataclass(frozen=True, kw_only=True)
class _IntegrationSchemes:
    U: Literal["Euler"] = "Euler"
    shape: Annotated[str, Choice(INTEGRATORS)] = "paper"


@dataclass(frozen=True, kw_only=True)
class _Solution:
    deltaT: Annotated[float, Positive]
    endTime: Annotated[float, Positive]
    writeInterval: Annotated[float, Positive] | None = None
    active: Annotated[bool, Only(True, "the cloud is not active, there is nothing to do")] = True
    coupled: Annotated[bool, Only(False, "the particles do not act on the flow")] = False
    transient: Annotated[bool, Only(False, "particles are tracked through steady flows only")] = False
    cellValueSourceCorrection: Annotated[bool, Only(False, "the particles do not act on the flow")] = False
    interpolationSchemes: _InterpolationSchemes = _InterpolationSchemes()
    integrationSchemes: _IntegrationSchemes = _IntegrationSchemes()


@dataclass(frozen=True, kw_only=True)
class _Solid:
    type: Annotated[str, Choice(MATERIALS)] | None = None
    poissonsRatio: Annotated[float, PoissonsRatio] | None = None
    shearModulus: Annotated[float, Positive] | None = None
    youngsModulus: Annotated[float, Positive] | None = None
    Ca: Annotated[float, Positive] | None = None
    referenceShearRate: Annotated[float, Positive] | None = None


_STIFFNESS = ("shearModulus", "youngsModulus", "Ca")


@dataclass(frozen=True, kw_only=True)
class _ConstantProperties:
    rho0: Annotated[float, Positive]
    rhoInf: Annotated[float, Positive]
    solid: Dictionary | None = None


@dataclass(frozen=True, kw_only=True)
class _EllipsoidDrag:
    type: Annotated[str, Choice(DRAGS)] = "oberbeck"


@dataclass(frozen=True, kw_only=True)
class _Gravity:
    pass


@dataclass(frozen=True, kw_only=True)
class _ParticleForces:
    ellipsoidDrag: _EllipsoidDrag
    gravity: _Gravity | None = None


@dataclass(frozen=True, kw_only=True)
class _InjectionModel:
    """What every injection model reads beside its own entries."""

    type: Annotated[str, Choice(INJECTIONS)]
    sizeDistribution: Dictionary
    rho0: Annotated[float, Positive] | None = None
    solid: Dictionary | None = None
    parcelBasisType: Annotated[str, Only("fixed", _PARCELS)] = "fixed"
    nParticle: Annotated[float, Only(1.0, _PARCELS)] = 1.0
    massTotal: Annotated[float, Only(0.0, f"{_PARCELS}: their mass follows from diameter and rho0")] = 0.0
    flowRateProfile: Annotated[
        Line, Only("constant 1", "parcelsPerSecond is the rate for the whole duration")
    ] = Line("constant 1")


@dataclass(frozen=True, kw_only=True)
class _LocalInteraction:
    patches: DictionaryList
    touching: Touching = "ellipsoid"


@dataclass(frozen=True, kw_only=True)
class _SubModels:
    particleForces: _ParticleForces
    injectionModels: Dictionary
    patchInteractionModel: Literal["localInteraction"]
    localInteractionCoeffs: _LocalInteraction
    tractionModel: Annotated[str, Choice(TRACTIONS)] = "roscoe"
    dispersionModel: Literal["none"] = "none"
    heatTransferModel: Literal["none"] = "none"
    surfaceFilmModel: Literal["none"] = "none"
    collisionModel: Literal["none"] = "none"
    stochasticCollisionModel: Literal["none"] = "none"


@dataclass(frozen=True, kw_only=True)
class _CloudFunctions:
    pass


@dataclass(frozen=True, kw_only=True)
class _CloudProperties:
    solution: _Solution
    constantProperties: _ConstantProperties
    subModels: _SubModels
    cloudFunctions: _CloudFunctions = _CloudFunctions()


def read_entries(record: type[Record], dictionary: Dictionary, also: Iterable[str] = ()) -> Record:
    """Read a record, a dataclass whose fields are a dictionary's entries, by its type hints.

    Parameters
    ----------
    record
        Its hints may be a key of ``_READERS``, another record, Literal, or Annotated with one ``Rule``; each
        also with ``| None``.
    dictionary
        Its entries; those that a macro has used may have any name.
    also
        Names of entries that somebody else reads.

    Raises
    ------
    InputError
        If an entry is not known, missing, or does not hold what its hint says.
    """
    hints = get_type_hints(record, include_extras=True)
    _refuse_unknown(dictionary, (*_names(record), *also))
    return record(
        **{
            entry.name: read_entry(dictionary, entry.name, hints[entry.name])
            for entry in fields(record)
            if entry.name in dictionary.entries or not _has_default(entry)
        }
    )


def read_entry(dictionary: Dictionary, key: str, hint: Any) -> Any:
    """Read one entry of a dictionary as a type hint says; see :func:`read_entries`."""
    if key not in dictionary.entries:
        raise dictionary.missing(key, _allowed(hint))
    return _convert(dictionary.entries[key], hint)


def _has_default(entry: Field[Any]) -> bool:
    return entry.default is not MISSING or entry.default_factory is not MISSING


def _names(record: type[DataclassInstance]) -> tuple[str, ...]:
    return tuple(entry.name for entry in fields(record))


def _refuse_unknown(dictionary: Dictionary, known: Collection[str]) -> None:
    for key, entry in dictionary.entries.items():
        # A name that only serves as a macro's variable is the user's own.
        if key not in known and not entry.used:
            raise entry.mistake(f"is not known. {suggestion(key, known)}")


def _selected(registry: Mapping[str, type[Record]], dictionary: Dictionary) -> type[Record]:
    """Find the class that a dictionary's ``type`` selects from a registry."""
    return registry[read_entry(dictionary, "type", Annotated[str, Choice(registry)])]


def _convert(entry: Entry, hint: Any) -> Any:
    """Turn an entry into what a type hint says."""
    kind, rule = _kind(hint)
    if kind is Dictionary:
        return _as_dictionary(entry)
    if kind not in _READERS:
        return read_entries(kind, _as_dictionary(entry))
    if kind is DictionaryList and isinstance(entry, DictionaryList):
        return entry
    if isinstance(entry, Stream) and any(token.startswith("#") for token in entry.tokens):
        raise entry.mistake(f"is {entry}, which is not evaluated: write the value itself.")
    value = _READERS[kind].read(entry) if isinstance(entry, Stream) else None
    if value is None or not (rule is None or rule.admits(value)):
        raise entry.mistake(
            f"is {entry}. {_allowed(hint, found=entry.text if isinstance(entry, Stream) else '')}"
        )
    return value


def _kind(hint: Any) -> tuple[Any, Rule | None]:
    """Split a hint into a key of ``_READERS``, or a record, and the rule that the value must keep."""
    origin = get_origin(hint)
    if origin is Annotated:
        return hint.__origin__, hint.__metadata__[0]
    if origin is Literal:
        return str, Choice(get_args(hint))
    if origin in (Union, UnionType):
        return _kind(next(kind for kind in get_args(hint) if kind is not type(None)))
    return hint, None


def _allowed(hint: Any, found: str = "") -> str:
    """Say what an entry may be."""
    kind, rule = _kind(hint)
    match rule:
        case Choice(names):
            return suggestion(_unquoted(found), names)
        case Only(value, why):
            return f"Allowed: {str(value).lower() if isinstance(value, bool) else value} ({why})."
        case Bounds():
            return f"Allowed: {rule.text}."
    return f"Allowed: {_READERS[kind if kind in _READERS else Dictionary].text}."


# ---------------------------------------------------------------------------------------------------------
# OpenFOAM's dictionaries


@dataclass(frozen=True)
class Source:
    """A file that is read for a case."""

    path: Path
    case: Path

    def __str__(self) -> str:
        path, case = self.path.resolve(), self.case.resolve()
        return str(path.relative_to(case) if path.is_relative_to(case) else self.path)

    def mistake(self, line: int, what: str) -> InputError:
        """Make the error of a line."""
        return InputError(f"{self}, line {line}: {what}")


@dataclass(eq=False)
class Entry:
    """What stands under a key of a dictionary, where it was written, and whether a macro has used it."""

    key: str
    parent: Entry | None
    source: Source
    line: int
    used: bool = field(default=False, kw_only=True)

    @property
    def path(self) -> str:
        """Keys from the top of the file, with slashes between them."""
        above = self.parent.path if self.parent else ""
        return f"{above}/{_unquoted(self.key)}" if above else _unquoted(self.key)

    def mistake(self, what: str) -> InputError:
        """Make the error of this entry: file, line, path, and what is wrong."""
        return self.source.mistake(self.line, f"{self.path} {what}")

    def missing(self, key: str, allowed: str) -> InputError:
        """Make the error of a key that this dictionary lacks."""
        path = f"{self.path}/{key}" if self.path else key
        place = f", line {self.line}" if self.path else ""
        return InputError(f"{self.source}{place}: {path} is missing. {allowed}")

    def copy(self, key: str, parent: Entry) -> Entry:
        """Copy to another place."""
        return replace(self, key=key, parent=parent)


@dataclass(eq=False)
class Stream(Entry):
    """An entry's tokens up to the semicolon, macros expanded."""

    tokens: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The tokens with a space between any two."""
        return " ".join(self.tokens)

    def __str__(self) -> str:
        text = re.sub(r"(?<=[(\[]) | (?=[)\]])", "", self.text)
        return f"'{text if len(text) <= 60 else text[:57] + '...'}'"


@dataclass(eq=False)
class Dictionary(Entry):
    """Entries by key, in their order."""

    entries: dict[str, Entry] = field(default_factory=dict)

    def __str__(self) -> str:
        return "a dictionary"

    def at(self, path: str) -> Entry:
        """Find the entry that the keys of a path with slashes lead to."""
        entry: Entry = self
        for key in path.split("/"):
            entry = _as_dictionary(entry).entries[key]
        return entry

    def copy(self, key: str, parent: Entry) -> Dictionary:
        """Copy to another place, entries and all."""
        twin = replace(self, key=key, parent=parent)
        twin.entries = {name: entry.copy(name, twin) for name, entry in self.entries.items()}
        return twin

    def add(self, entry: Entry) -> None:
        """Add an entry; of two dictionaries with one key the entries are merged, else the last one counts."""
        earlier = self.entries.get(entry.key)
        if isinstance(earlier, Dictionary) and isinstance(entry, Dictionary):
            earlier.merge(entry)
        else:
            self.entries[entry.key] = entry

    def merge(self, other: Dictionary) -> None:
        """Take over another dictionary's entries."""
        for entry in other.entries.values():
            entry.parent = self
            self.add(entry)


@dataclass(eq=False)
class DictionaryList(Entry):
    """Named dictionaries in parentheses, ``( name { … } name { … } )``; a name may occur twice."""

    items: list[Dictionary] = field(default_factory=list)

    def __str__(self) -> str:
        return "a list of dictionaries"

    def copy(self, key: str, parent: Entry) -> DictionaryList:
        """Copy to another place, dictionaries and all."""
        twin = replace(self, key=key, parent=parent)
        twin.items = [item.copy(item.key, twin) for item in self.items]
        return twin


def read_dictionary(path: Path, case: Path) -> Dictionary:
    """Read a file in OpenFOAM's dictionary format, with macros and includes.

    Expanded are ``$name`` (also ``${name}``), looked up from the dictionary where it stands outward, with
    ``.`` between the keys of nested dictionaries; ``$:a.b`` from the top of the file; ``$.name`` and
    ``$..name`` in this and in the enclosing dictionary only; ``$name;`` in place of an entry, which merges
    the dictionary ``name``; ``#include``, ``#includeIfPresent`` and ``#sinclude``. A macro sees what is
    complete before it, as in OpenFOAM: not the dictionary that it stands in.

    Parameters
    ----------
    path
        The file.
    case
        The case, which messages name files relative to, and ``$FOAM_CASE`` and ``<case>`` in an include mean.

    Raises
    ------
    InputError
        If the file cannot be read or is not such a dictionary; with the line.
    """
    source = Source(path, case)
    root = Dictionary("", None, source, 0)
    text = _read_text(path, lambda why: InputError(f"{source}: {why} (case {case})."))
    _Parser(source, text, including=()).fill(root)
    root.entries.pop(_HEADER, None)
    return root


def _read_text(path: Path, mistake: Callable[[str], InputError]) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise mistake(error.strerror or "cannot be read") from error
    except UnicodeDecodeError as error:
        raise mistake("is not a text file") from error


class _Token(NamedTuple):
    text: str
    line: int


_TOKEN = re.compile(
    r"""
      (?P<skip> \s+ | //[^\n]* | /\*.*?\*/ )
    | (?P<token> "(?:\\.|[^"\\])*"                          # a string
               | \#\{.*?\#\}                                # code
               | \$\{[^\s{}]*\}
               | [{}()\[\];]
               | (?: [^\s"/;{}()\[\]] | /(?![/*]) )+ )      # a word or number
    """,
    re.DOTALL | re.VERBOSE,
)
_HEADER = "FoamFile"
_CLOSING = {"{": "}", "(": ")", "[": "]"}
_MARKS = frozenset("{}()[];")
_INCLUDES = {"#include": True, "#includeIfPresent": False, "#sinclude": False}
_CASE_FOLDERS = {
    "$FOAM_CASE": "",
    "${FOAM_CASE}": "",
    "<case>": "",
    "<constant>": "constant",
    "<system>": "system",
}


def _tokens(source: Source, text: str) -> Iterator[_Token]:
    position, line = 0, 1
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            what = "comment" if text[position] == "/" else "string"
            raise source.mistake(line, f"this {what} has no end.")
        if match["token"]:
            yield _Token(match["token"], line)
        line += match[0].count("\n")
        position = match.end()
    yield _Token("", line)


class _Parser:
    """Reads one file; ``including`` are the files that it is being included from."""

    def __init__(self, source: Source, text: str, including: tuple[Path, ...]) -> None:
        self.source = source
        self.tokens = list(_tokens(source, text))
        self.position = 0
        self.files = (*including, source.path.resolve())

    def fill(self, dictionary: Dictionary, opened: _Token | None = None) -> None:
        """Read entries into a dictionary, up to its closing brace or the end of the file."""
        while True:
            token = self.take()
            if token.text == ("}" if opened else ""):
                return
            if token.text == "":
                raise self.mistake(opened or token, f"of {dictionary.path} has no closing }}.")
            if token.text == ";":
                continue
            if token.text.startswith("#"):
                self.include(token, dictionary)
            elif token.text.startswith("$"):
                self.merge(token, dictionary)
            elif token.text in _MARKS:
                raise self.mistake(token, "stands where a key is expected.")
            else:
                dictionary.add(self.entry(token, dictionary))

    def entry(self, key: _Token, parent: Dictionary) -> Entry:
        """Read what follows a key."""
        start, _, beyond = (self.peek(ahead).text for ahead in range(3))
        if start == "{":
            return self.dictionary(key, parent)
        if start == "(" and beyond == "{":
            return self.dictionaries(key, parent)
        tokens = self.stream(key)
        if start.startswith("$") and len(tokens) == 1:
            twin = self.look_up(tokens[0], parent).copy(key.text, parent)
            twin.used = False
            return twin
        # The variables of a computed value belong to the computation, which whoever needs the value refuses.
        words = [
            word
            for token in tokens
            for word in ([token.text] if start.startswith("#") else self.expand(token, parent))
        ]
        return Stream(key.text, parent, self.source, key.line, tokens=tuple(words))

    def dictionary(self, key: _Token, parent: Entry) -> Dictionary:
        """Read ``{ … }``."""
        dictionary = Dictionary(key.text, parent, self.source, key.line)
        self.fill(dictionary, opened=self.take())
        return dictionary

    def dictionaries(self, key: _Token, parent: Dictionary) -> DictionaryList:
        """Read ``( name { … } name { … } );``."""
        entry = DictionaryList(key.text, parent, self.source, key.line)
        self.take()
        while (name := self.take()).text != ")":
            if name.text in _MARKS or name.text == "" or self.peek().text != "{":
                raise self.mistake(
                    name, f"in the list {entry.path} is not a name with its dictionary {{ … }}."
                )
            entry.items.append(self.dictionary(name, entry))
        if self.take().text != ";":
            raise self.mistake(key, "has no closing ;.")
        return entry

    def stream(self, key: _Token) -> list[_Token]:
        """Read tokens up to the semicolon."""
        tokens: list[_Token] = []
        expected: list[str] = []
        computed = self.peek().text.startswith("#")
        while (token := self.take()).text != ";" or expected[-1:] == ["}"]:
            if expected and token.text == expected[-1]:
                expected.pop()
            elif token.text in _CLOSING and (token.text != "{" or computed):
                expected.append(_CLOSING[token.text])
            elif (token.text in _MARKS and token.text != ";") or token.text == "":
                raise self.mistake(key, f"has no closing {expected[-1] if expected else ';'}.")
            tokens.append(token)
        if expected:
            raise self.mistake(key, f"has no closing {expected[-1]}.")
        return tokens

    def expand(self, token: _Token, scope: Dictionary) -> tuple[str, ...]:
        """Replace a macro by the tokens of the entry that it names."""
        if not token.text.startswith("$"):
            return (token.text,)
        entry = self.look_up(token, scope)
        if not isinstance(entry, Stream):
            raise self.mistake(token, f"is {entry}, and cannot stand within a value.")
        return entry.tokens

    def look_up(self, token: _Token, scope: Dictionary) -> Entry:
        """Find the entry that a macro names."""
        name = token.text[1:].removeprefix("{").removesuffix("}")
        scopes = [above for above in _upward(scope) if isinstance(above, Dictionary)]
        dots = len(name) - len(name.lstrip("."))
        if name.startswith(":"):
            scopes = scopes[-1:]
        elif dots:
            scopes = scopes[dots - 1 : dots]
        for dictionary in scopes:
            entry = _descend(dictionary, name.lstrip(".:"))
            if entry is not None:
                for used in _upward(entry):
                    used.used = True
                return entry
        raise self.mistake(token, "is not defined above.")

    def merge(self, token: _Token, dictionary: Dictionary) -> None:
        """Put the entries of the dictionary that a macro names into this one."""
        template = self.look_up(token, dictionary)
        if not isinstance(template, Dictionary):
            raise self.mistake(token, f"stands where a key is expected, but is {template}, not a dictionary.")
        if self.take().text != ";":
            raise self.mistake(token, "has no closing ;.")
        dictionary.merge(template.copy(template.key, dictionary))

    def include(self, directive: _Token, dictionary: Dictionary) -> None:
        """Read another file's entries into a dictionary."""
        if directive.text not in _INCLUDES:
            raise self.mistake(directive, f"is not supported. {suggestion(directive.text, _INCLUDES)}")
        name = self.take()
        if name.text in _MARKS or name.text == "":
            raise self.mistake(directive, "names no file.")
        path = self.source.path.parent / self.in_case(_unquoted(name.text))
        if not (path.is_file() or _INCLUDES[directive.text]):
            return
        if path.resolve() in self.files:
            raise self.mistake(name, "includes itself.")
        text = _read_text(path, lambda why: self.mistake(name, f"cannot be included: {why}."))
        _Parser(Source(path, self.source.case), text, self.files).fill(dictionary)
        dictionary.entries.pop(_HEADER, None)

    def in_case(self, name: str) -> str:
        """Replace a leading tag for a folder of the case."""
        for tag, folder in _CASE_FOLDERS.items():
            if name.startswith(tag):
                return f"{self.source.case.resolve() / folder}{name.removeprefix(tag)}"
        return name

    def peek(self, ahead: int = 0) -> _Token:
        """Look at a coming token; the last one has no text."""
        return self.tokens[min(self.position + ahead, len(self.tokens) - 1)]

    def take(self) -> _Token:
        """Go on to the next token."""
        token = self.peek()
        self.position += 1
        return token

    def mistake(self, token: _Token, what: str) -> InputError:
        """Make the error of a token."""
        return self.source.mistake(token.line, f"'{token.text}' {what}")


def _upward(entry: Entry) -> Iterator[Entry]:
    """Go from an entry to the top of the file."""
    above: Entry | None = entry
    while above is not None:
        yield above
        above = above.parent


def _descend(dictionary: Dictionary, name: str) -> Entry | None:
    """Find ``a.b`` or, in a nested dictionary ``a``, ``b``."""
    if name in dictionary.entries:
        return dictionary.entries[name]
    first, _, rest = name.partition(".")
    inner = dictionary.entries.get(first)
    return _descend(inner, rest) if isinstance(inner, Dictionary) and rest else None


def _as_dictionary(entry: Entry) -> Dictionary:
    """Take a key without a value, such as ``gravity;``, as an empty dictionary."""
    if isinstance(entry, Stream) and not entry.tokens:
        return Dictionary(entry.key, entry.parent, entry.source, entry.line)
    if not isinstance(entry, Dictionary):
        raise entry.mistake(f"is {entry}. {_allowed(Dictionary)}")
    return entry


def _unquoted(text: str) -> str:
    return text[1:-1] if text.startswith('"') else text


# ---------------------------------------------------------------------------------------------------------
# Values


class _Reader(NamedTuple):
    read: Callable[[Stream], Any]
    text: str


_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_INTEGER = re.compile(r"[-+]?\d{1,18}", re.ASCII)
_VISCOSITY = re.compile(r"(?:(?:[^\W\d]\S* )?\[ 0 2 -1 0 0(?: 0 0)? \] )?(?P<value>\S+)")
_SWITCHES = {"yes": True, "on": True, "true": True, "no": False, "off": False, "false": False}


def _number(text: str) -> float | None:
    number = float(text) if _NUMBER.fullmatch(text) else math.nan
    return number if math.isfinite(number) else None


def _viscosity_value(entry: Stream) -> float | None:
    match = _VISCOSITY.fullmatch(entry.text)
    return _number(match["value"]) if match else None


def _vector(entry: Stream) -> Vector3 | None:
    match entry.tokens:
        case ("(", x, y, z, ")"):
            vector = tuple(number for number in map(_number, (x, y, z)) if number is not None)
            return vector if len(vector) == 3 else None
    return None


def _word(entry: Stream) -> str | None:
    return (_unquoted(entry.text) or None) if len(entry.tokens) == 1 else None


def _file(entry: Stream) -> Path | None:
    name = _word(entry)
    path = entry.source.case / "constant" / name if name else None
    return path if path and path.is_file() else None


_READERS: dict[Any, _Reader] = {
    float: _Reader(lambda entry: _number(entry.text), "a number"),
    int: _Reader(lambda entry: int(entry.text) if _INTEGER.fullmatch(entry.text) else None, "a whole number"),
    bool: _Reader(lambda entry: _SWITCHES.get(entry.text), ", ".join(_SWITCHES)),
    str: _Reader(_word, "a word"),
    Line: _Reader(lambda entry: entry.text, "any text"),
    Viscosity: _Reader(_viscosity_value, "a number, with the dimensions [0 2 -1 0 0 0 0] or none"),
    Path: _Reader(_file, "the name of an existing file, in constant/ or absolute"),
    Vector3: _Reader(_vector, "a vector (x y z)"),
    Dictionary: _Reader(lambda _: None, "a dictionary { … }"),
    DictionaryList: _Reader(lambda _: None, "a list ( name { … } name { … } )"),
}
