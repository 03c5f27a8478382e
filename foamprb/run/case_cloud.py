"""Cloud of an OpenFOAM case, ``constant/kinematicCloudProperties``, as the start of the initial settings."""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import numpy as np

from foamprb.cloud.forces import FORCES
from foamprb.cloud.injection.distribution import DISTRIBUTIONS, Distribution
from foamprb.cloud.injection.models import INJECTIONS
from foamprb.cloud.surroundings.dispersion import DISPERSIONS
from foamprb.cloud.surroundings.registry import SURROUNDINGS
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.dictionary.constraints import Choice, NoEffect, Only
from foamprb.dictionary.files import existing
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.positions import read_positions
from foamprb.dictionary.schema import allowed, read_entries, read_entry, read_model, rule_of, selected
from foamprb.dictionary.tree import CaseFile, Dictionary, DictionaryList, Entry, Stream, unquoted
from foamprb.errors import InputError
from foamprb.flow.base import Patch
from foamprb.flow.meshflow import MeshFlow
from foamprb.results.folder import fault_of_function, fault_of_word
from foamprb.settings.fluid import ConstantProperties, of_region
from foamprb.settings.injections import InjectionModel
from foamprb.settings.patches import INTERACTION_MODELS, applies, patch_rule
from foamprb.settings.settings import SubModels
from foamprb.settings.solution import Solution

__all__ = ["CaseCloud", "braces", "read_case_cloud"]

log = logging.getLogger("foamprb")

_FORCES = {**FORCES, **SURROUNDINGS}
_NAME = "kinematicCloudProperties"
_MODULI = ("youngsModulus", "poissonsRatio")
_MOST_PARTICLES = 100_000
"""Largest number of particles of an injection model; a larger one is reduced to it."""


@dataclass
class CaseCloud:
    """Entries of the case's cloud that are valid for soft particles, as lines of dictionaries."""

    file: str
    """The file, relative to the case."""
    rho0: float | None = None
    """Density of the particles, kg/m³."""
    moduli: Mapping[str, float] = field(default_factory=dict)
    """Young's modulus, Pa, and Poisson's ratio, if both are given."""
    gravity: bool = False
    """Whether gravity is among the forces."""
    forces: list[str] = field(default_factory=list)
    """Forces beside drag and gravity."""
    dispersion: str = ""
    """The dispersion model; empty if there is none."""
    injections: list[str] = field(default_factory=list)
    diameters: Distribution | None = None
    """The last size distribution."""
    last: float = 0.0
    """Time of the last release, s."""
    interaction: str = ""
    """The patch interaction model; empty if it is not carried over."""
    wall: str = "stick"
    """Interaction of walls without a rule: ``rebound`` if the collision model moved particles off walls."""
    coefficients: list[str] = field(default_factory=list)
    """Its coefficients; of ``localInteraction``, the rules that match patches."""
    ruled: frozenset[str] = frozenset()
    """Names of the patches that these rules match."""
    functions: list[str] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    """Sentences about entries that are not carried over."""


def read_case_cloud(case: Path, region: str, flow: MeshFlow, end: float) -> CaseCloud | None:
    """Read the case's own cloud; return None if there is none or it cannot be read.

    Parameters
    ----------
    case, region
        The case, and a region of its mesh.
    flow
        The flow into which the injection models must release particles.
    end
        Duration of a first run, s; a longer injection is reduced to a fifth of it, a later one begins at 0.
    """
    file = case / of_region(case, region, _NAME)
    if existing(file) is None:
        return None
    rotating = existing(case / of_region(case, region, "MRFProperties")) is not None
    reader = _Reader(CaseCloud(str(CaseFile(file, case))), rotating)
    try:
        reader.read(read_dictionary(file, case), flow, end)
    except InputError as error:
        log.warning("%s The initial settings are made without this file.", error)
        return None
    for sentence in reader.cloud.left_out:
        log.info("%s: left out: %s.", reader.cloud.file, sentence)
    return reader.cloud


class _Reader:
    """Reader of the parts of a cloud."""

    def __init__(self, cloud: CaseCloud, rotating: bool) -> None:
        self.cloud, self.rotating = cloud, rotating

    def read(self, root: Dictionary, flow: MeshFlow, end: float) -> None:
        """Read all parts; see :func:`read_case_cloud`."""
        cloud, models = self.cloud, _inner(root, "subModels")
        # In OpenFOAM transient is a property of the cloud, not of the flow.
        self._prune(_inner(root, "solution"), Solution, without=("transient",))
        constant = self._prune(_inner(root, "constantProperties"), ConstantProperties, also=_MODULI)
        if "rho0" in constant.entries:
            cloud.rho0 = read_entry(constant, "rho0", float)
        if set(_MODULI) <= constant.entries.keys():
            cloud.moduli = {name: read_entry(constant, name, float) for name in _MODULI}
        self._read_forces(_inner(models, "particleForces"))
        dispersion = models.entries.get("dispersionModel")
        if isinstance(dispersion, Stream) and dispersion.text in DISPERSIONS:
            cloud.dispersion = dispersion.text
        for own in _dictionaries(_inner(models, "injectionModels")):
            try:
                cloud.injections += self._injection(own, flow, end)
            except InputError as error:
                self._leave_out(own, str(error))
        collision = models.entries.get("collisionModel")
        if isinstance(collision, Stream) and collision.text != "none":
            cloud.wall = "rebound"
        self._read_interaction(models, flow.patches)
        others = ("particleForces", "injectionModels", "patchInteractionModel")
        coefficients = [name for name in models.entries if name.endswith("Coeffs")]
        self._prune(models, SubModels, without=(*others, *coefficients))
        for own in _dictionaries(_inner(root, "cloudFunctions")):
            try:
                cloud.functions += self._function(own)
            except InputError as error:
                self._leave_out(own, str(error))

    def _leave_out(self, entry: Entry, why: str) -> None:
        """Note an entry that is not carried over."""
        value = f" {_text(entry)}" if isinstance(entry, Stream) and entry.tokens else ""
        # Without the place of the entry in a message about it.
        why = re.sub(rf"^.*?, line \d+: (?:{re.escape(entry.path)}/?)?", "", " ".join(why.split()))
        self.cloud.left_out.append(f"{entry.path}{value} ({why[:1].lower()}{why[1:].removesuffix('.')})")

    def _prune(
        self, dictionary: Dictionary, *schemas: Any, also: Sequence[str] = (), without: Sequence[str] = ()
    ) -> Dictionary:
        """Remove the entries that no schema accepts, which are noted, and those without effect.

        Parameters
        ----------
        dictionary
            The dictionary, which is changed and returned.
        schemas
            Classes that declare entries.
        also, without
            Names of further entries that stay, and that are removed without a note.
        """
        hints = {name: hint for s in schemas for name, hint in get_type_hints(s, include_extras=True).items()}
        for key, entry in [*dictionary.entries.items()]:
            if key in also or entry.used:
                continue
            # U.air is the velocity of a phase.
            name = key.partition(".")[0]
            rule = rule_of(hints[name]) if name in hints else None
            if key in without or isinstance(rule, NoEffect):
                del dictionary.entries[key]
            elif name not in hints:
                del dictionary.entries[key]
                if not isinstance(entry, Stream) or entry.text not in ("none", "no", "off", "false"):
                    self._leave_out(entry, "it is not modelled")
            elif (
                rule is None
                and isinstance(entry, Dictionary)
                and hasattr(hints[name], "__dataclass_fields__")
            ):
                self._prune(entry, hints[name])
            else:
                try:
                    read_entry(dictionary, key, hints[name])
                except InputError:
                    self._leave_out(entry, rule.why if isinstance(rule, Only) else allowed(hints[name]))
                    del dictionary.entries[key]
                else:
                    if isinstance(rule, Only):
                        del dictionary.entries[key]
        return dictionary

    def _read_forces(self, forces: Dictionary) -> None:
        for name, entry in forces.entries.items():
            if name == "gravity":
                self.cloud.gravity = True
            elif name == "SaffmanMeiLiftForce" and self.rotating:
                self._leave_out(entry, "it does not hold in the rotating zones of MRFProperties")
            elif name in _FORCES:
                try:
                    read_entry(forces, name, _FORCES[name])
                    self.cloud.forces += _lines(entry)
                except InputError as error:
                    self._leave_out(entry, str(error))
            elif name != "sphereDrag":
                self._leave_out(
                    entry, "ellipsoidDrag replaces it" if name.endswith("Drag") else "it is not modelled"
                )

    def _injection(self, own: Dictionary, flow: MeshFlow, end: float) -> list[str]:
        """Return the lines of an injection model; raise InputError if it cannot release particles here."""
        if fault := fault_of_word(unquoted(own.key)):
            raise InputError(f"its name is not valid: {fault}")
        kind = selected(INJECTIONS, own)
        sizes = _inner(own, "sizeDistribution")
        law = read_entry(sizes, "type", Annotated[str, Choice(DISTRIBUTIONS)])
        sizes.entries = {name: sizes.entries[name] for name in ("type", f"{law}Distribution")}
        self.cloud.diameters = Distribution.from_dictionary(sizes)
        self._prune(own, kind, InjectionModel)
        comments = {}

        def reduce(name: str, value: float, unit: str) -> None:
            entry = own.entries[name]
            comments[name] = f" // {unit}the case has {read_entry(own, name, float):g}"
            own.entries[name] = Stream(name, own, own.source, entry.line, tokens=(f"{value:.2g}",))

        if "SOI" in own.entries and read_entry(own, "SOI", float) > end:
            reduce("SOI", 0.0, "s, ")
        duration = read_entry(own, "duration", float) if "duration" in own.entries else 0.0
        if duration > end:
            reduce("duration", 0.2 * end, "s, ")
            duration = 0.2 * end
        for name, factor, unit in (("parcelsPerSecond", duration, "1/s, "), ("parcelsPerInjector", 1.0, "")):
            number = factor * read_entry(own, name, float) if name in own.entries else 0.0
            if number > _MOST_PARTICLES:
                reduce(name, _MOST_PARTICLES / factor, unit)
        also = [name for name in own.entries if name not in get_type_hints(kind)]
        places = read_entries(kind, own, also=also).places(flow, np.random.default_rng(1), read_positions)
        if "parcelConcentration" in own.entries and (n := len(places.t)) > _MOST_PARTICLES:
            concentration = read_entry(own, "parcelConcentration", float)
            reduce("parcelConcentration", concentration * _MOST_PARTICLES / n, "1/m3, ")
        self.cloud.last = max(self.cloud.last, float(np.max(places.t, initial=0.0)))
        lines = _lines(own)
        return [line + comments.get(line.split()[0], "") for line in lines]

    def _read_interaction(self, models: Dictionary, patches: Sequence[Patch]) -> None:
        """Read the patch interaction model, without rules that match no patch."""
        model = models.entries.get("patchInteractionModel")
        if not isinstance(model, Stream):
            return
        name = model.text
        coefficients = _inner(models, f"{name}Coeffs")
        if name not in INTERACTION_MODELS:
            self._leave_out(model, "localInteraction replaces it")
            return
        rules = coefficients.entries.get("patches")
        if name != "localInteraction":
            try:
                INTERACTION_MODELS[name](coefficients)
            except InputError as error:
                self._leave_out(model, str(error))
                return
            self.cloud.coefficients = [
                line for entry in coefficients.entries.values() for line in _lines(entry)
            ]
        elif isinstance(rules, DictionaryList):
            for own in rules.items:
                try:
                    rule = patch_rule(own)
                except InputError as error:
                    self._leave_out(own, str(error))
                    continue
                matched = {patch.name for patch in patches if applies(rule, patch)}
                self.cloud.ruled |= matched
                if matched:
                    self.cloud.coefficients += _lines(own)
                else:
                    self._leave_out(own, "it matches no patch")
        self.cloud.interaction = name

    def _function(self, own: Dictionary) -> list[str]:
        """Return the lines of a cloud function; raise InputError if there is none such here."""
        if fault := fault_of_function(unquoted(own.key), "softCloud"):
            raise InputError(f"its name is not valid: {fault}")
        self._prune(own, selected(FUNCTIONS, own), also=("type",))
        read_model(FUNCTIONS, own)
        return _lines(own)


def _inner(dictionary: Dictionary, key: str) -> Dictionary:
    """Return a dictionary in another one, or an empty one."""
    entry = dictionary.entries.get(key)
    return Dictionary(key, dictionary, dictionary.source, 0) if entry is None else entry.dictionary()


def _dictionaries(dictionary: Dictionary) -> list[Dictionary]:
    return [
        entry for entry in dictionary.entries.values() if isinstance(entry, Dictionary) and not entry.used
    ]


def _text(entry: Stream) -> str:
    return re.sub(r"(?<=\() | (?=\))", "", entry.text)


def _lines(entry: Entry) -> list[str]:
    """Return an entry as lines of a dictionary."""
    if isinstance(entry, Stream):
        return [f"{entry.key} {_text(entry)};".replace(" ;", ";")]
    if isinstance(entry, DictionaryList):
        return [entry.key, "(", *(f"    {line}" for item in entry.items for line in _lines(item)), ");"]
    inner = [part for part in entry.dictionary().entries.values() if not part.used]
    return braces(entry.key, [line for part in inner for line in _lines(part)])


def braces(key: str, lines: Sequence[str]) -> list[str]:
    """Return the lines of a dictionary."""
    return [key, "{", *(f"    {line}" if line else "" for line in lines), "}"]
