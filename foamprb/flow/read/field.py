"""OpenFOAM's fields: values at the cells, and an entry for each patch; in double precision.

The long lists are read by :mod:`~foamprb.flow.read.foamfile`; the remaining text is a dictionary, with macros
and includes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from foamprb.dictionary.dimensions import (
    DENSITY,
    VELOCITY,
    Dimensions,
    described,
    read_dimensions,
    written,
)
from foamprb.dictionary.grammar import parse_dictionary
from foamprb.dictionary.patterns import matches
from foamprb.dictionary.tree import Dictionary, Entry, Stream, unquoted
from foamprb.dictionary.values import factor_of, unit_of
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.foamfile import COMPONENTS, FoamFile, ListAt


class Kind(NamedTuple):
    """Class of fields."""

    name: str
    """OpenFOAM's name."""
    inner: str
    """Type of a value."""
    dimensions: tuple[Dimensions, ...]
    """Allowed dimensions; empty for any."""
    meaning: str
    """Meaning of the field, for messages."""


VELOCITY_FIELD = Kind("volVectorField", "vector", (VELOCITY,), "a velocity")
DENSITY_FIELD = Kind("volScalarField", "scalar", (DENSITY,), "a density")
PRESSURE_FIELD = Kind("volScalarField", "scalar", ((1, -1, -2, 0, 0, 0, 0),), "a pressure")
TEMPERATURE_FIELD = Kind("volScalarField", "scalar", ((0, 0, 0, 1, 0, 0, 0),), "a temperature")


class PatchField(NamedTuple):
    """Entry of a field for a patch, or for all patches whose names match a pattern."""

    type: str
    pattern: bool = False
    """True if the name is a regular expression."""
    fields: Mapping[str, Floats] = {}
    """Values by key, ``value`` among them: (n_faces, components), or one row if they are all alike."""
    words: Mapping[str, str] = {}
    """All other entries but dictionaries, as text."""


class FoamField(NamedTuple):
    """Field of a case."""

    path: Path
    kind: Kind
    cells: Floats
    """(n_cells, components), or (1, components) if they are all alike."""
    patches: Mapping[str, PatchField]
    """By name or pattern, in their order."""
    dimensions: Dimensions

    def of(self, patch: PatchInfo) -> PatchField | None:
        """Return the entry that applies to a patch, by OpenFOAM's rules.

        It is the entry with its name; else the last one with the name of one of its groups; else the last one
        whose pattern matches the name. It has the values of the faces that count.
        """
        entry = self._entry(patch)
        if entry is None or patch.rows is None:
            return entry
        rows, fields = patch.rows, entry.fields.items()
        return entry._replace(fields={k: v[rows] if len(v) == len(rows) > 1 else v for k, v in fields})

    def _entry(self, patch: PatchInfo) -> PatchField | None:
        if patch.name in self.patches and not self.patches[patch.name].pattern:
            return self.patches[patch.name]
        backwards = list(self.patches.items())[::-1]
        for name, entry in backwards:
            if not entry.pattern and name in patch.groups:
                return entry
        for name, entry in backwards:
            if entry.pattern and matches(name, patch.name):
                return entry
        return None


_MARK = "List@"
"""Placeholder for a list in the text of a field, followed by the list's number."""
_COMPONENT_TYPES = b"|".join(COMPONENTS)
_LIST = re.compile(
    rb"//[^\n]*|/\*.*?\*/|\"(?:[^\"\\]|\\.)*\"|\bnonuniform\s+(?:List<(?P<inner>%b)>\s*)?(?P<size>\d)"
    % _COMPONENT_TYPES,
    re.DOTALL,
)
# A patch of a constraint type has this type of field even without these entries.
_CONSTRAINT_TYPES = re.compile(rb'#includeEtc\s+"caseDicts/setConstraintTypes"')


def read_field(path: Path | FoamFile, kind: Kind, case: Path) -> FoamField:
    """Read a field.

    Parameters
    ----------
    path
        The file, plain or compressed, or its contents.
    kind
        Required class and dimensions.
    case
        The case; see :func:`~foamprb.dictionary.grammar.read_dictionary`.
    """
    file = path if isinstance(path, FoamFile) else FoamFile(path)
    if file.kind != kind.name:
        kind_of_file = file.kind or "(none)"
        raise InputError(f"{file.path}: the class is {kind_of_file}, but {kind.meaning} is a {kind.name}.")
    text, lists = _without_lists(file, kind)
    try:
        root = parse_dictionary(text, file.path, case)
        dimensions = _dimensions(root, kind)
        reader = _Reader(file, kind, lists, dimensions)
        cells = reader.field(root.entries["internalField"]) if "internalField" in root.entries else None
        patches = root.entries.get("boundaryField")
        if cells is None or patches is None:
            raise InputError(
                f"{root.source}: no internalField of {kind.inner}s and boundaryField; the file is cut short."
            )
        entries = patches.dictionary().entries
        of_patches = {unquoted(key): reader.patch(key, entry.dictionary()) for key, entry in entries.items()}
    except InputError as error:
        raise InputError(f"{case}: {error}" if str(case) not in str(error) else str(error)) from None
    return FoamField(file.path, kind, cells, of_patches, dimensions)


def _without_lists(file: FoamFile, kind: Kind) -> tuple[str, list[ListAt]]:
    """Return the text of a field with a mark for each list of numbers, and the lists."""
    parts: list[bytes] = []
    lists: list[ListAt] = []
    begin = file.at = 0
    while (match := _LIST.search(file.data, file.at)) is not None:
        file.at = match.end()
        if match["size"] is None:
            continue
        file.at = match.start("size")
        inner = match["inner"] or kind.inner.encode()
        lists.append(file.locate(COMPONENTS[inner], file.label if inner == b"label" else None))
        lines = file.data.count(b"\n", match.start(), file.at)
        mark = b"nonuniform %s%d " % (_MARK.encode(), len(lists) - 1)
        parts += [file.data[begin : match.start()], mark, b"\n" * lines]
        begin = file.at
    parts.append(file.data[begin:])
    text = _CONSTRAINT_TYPES.sub(b"", b"".join(parts))
    return text.decode("utf-8", "replace"), lists


def _dimensions(root: Dictionary, kind: Kind) -> Dimensions:
    entry = root.entries.get("dimensions")
    if entry is None:
        raise root.missing("dimensions", f"Allowed: {_allowed(kind)}.")
    dimensions = read_dimensions(entry.text) if isinstance(entry, Stream) else None
    if dimensions is None:
        raise entry.mistake(f"is {entry}. Allowed: {_allowed(kind)}.")
    if kind.dimensions and dimensions not in kind.dimensions:
        raise entry.mistake(f"is {described(dimensions)}; this should be {kind.meaning}: {_allowed(kind)}.")
    return dimensions


def _allowed(kind: Kind) -> str:
    return " or ".join(map(written, kind.dimensions)) or "seven exponents [0 1 -1 0 0 0 0]"


class _Reader:
    """Reader of the entries of a field."""

    def __init__(self, file: FoamFile, kind: Kind, lists: Sequence[ListAt], dimensions: Dimensions) -> None:
        self._file, self._lists, self._dimensions = file, lists, dimensions
        self._components = COMPONENTS[kind.inner.encode()]
        self._inner = kind.inner

    def field(self, entry: Entry) -> Floats:
        """Return values of the field's type after ``uniform`` or ``nonuniform``."""
        values = self._values(entry)
        if values is None or values.shape[1] != self._components:
            raise entry.mistake(
                f"is {entry}. Allowed: uniform and a {self._inner}, or nonuniform and a List<{self._inner}>."
            )
        return values

    def patch(self, key: str, dictionary: Dictionary) -> PatchField:
        """Return the entry of a patch."""
        fields: dict[str, Floats] = {}
        words: dict[str, str] = {}
        for name, entry in dictionary.entries.items():
            if name == "value":
                fields[name] = self.field(entry)
            elif isinstance(entry, Stream):
                values = self._values(entry)
                if values is None:
                    words[name] = entry.text
                else:
                    fields[name] = values
        if "type" not in words:
            raise dictionary.missing("type", "Allowed: the name of a boundary condition.")
        if words["type"] == "empty":
            # decomposePar writes a list without values.
            fields = {}
        return PatchField(words["type"], key.startswith('"'), fields, words)

    def _values(self, entry: Entry) -> Floats | None:
        """Return values after ``uniform`` or ``nonuniform``, (n, components); None for other entries.

        A unit before or behind them must be one of the field.
        """
        unit, tokens = unit_of(entry.tokens if isinstance(entry, Stream) else ())
        if unit:
            numbers = self._numbers(tokens)
            try:
                return None if numbers is None else factor_of(unit, self._dimensions) * numbers
            except ValueError as error:
                raise entry.mistake(f"is {entry}, {error}.") from None
        return self._numbers(tokens)

    def _numbers(self, tokens: Sequence[str]) -> Floats | None:
        match tokens:
            case ("nonuniform", mark) if mark.startswith(_MARK):
                numbers: Floats = self._file.numbers(self._lists[int(mark.removeprefix(_MARK))])
                return numbers
            case ("uniform", number):
                numbers_of_entry = [number]
            case ("uniform", "(", *numbers_of_entry, ")"):
                pass
            case _:
                return None
        try:
            return np.array([numbers_of_entry], dtype=np.float64)
        except ValueError:
            return None
