"""Values of entries from their text: numbers, words, vectors, lists, names of files."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple, NewType, TypeAlias, TypeVar

from foamprb.dictionary.constraints import Axes, Constant, Numbers, Pairs, Vector3, Words
from foamprb.dictionary.dimensions import (
    ACCELERATION,
    DENSITY,
    DYNAMIC_VISCOSITY,
    KINEMATIC_VISCOSITY,
    Dimensions,
    described,
    read_unit,
    written,
)
from foamprb.dictionary.tree import DICTIONARY_TEXT, Dictionary, DictionaryList, Stream, unquoted

T = TypeVar("T")
Item: TypeAlias = "str | tuple[Item, ...]"
"""A word, or a list of items."""
Line = NewType("Line", str)
"""An entry's whole text, of one word or more."""
Files = NewType("Files", tuple[Path, ...])
"""Names of existing files, in the case's ``constant`` folder or absolute."""
Viscosity = NewType("Viscosity", float)
"""A kinematic viscosity, m2/s, that may be written with its name and dimensions."""
DynamicViscosity = NewType("DynamicViscosity", float)
"""A dynamic viscosity, Pa s, that may be written with its name and dimensions."""
Density = NewType("Density", float)
"""A density, kg/m3, that may be written with its name and dimensions."""
Acceleration = NewType("Acceleration", str)
"""The dimensions of an acceleration."""
AccelerationVector = NewType("AccelerationVector", Vector3)
"""An acceleration, m/s2, that may be written with its unit."""


class Reader(NamedTuple):
    """Reader of the values of one type, with its name in messages."""

    read: Callable[[Stream], Any]
    """Returns the value of an entry, or None if its text is something else.

    It may raise ValueError with the message on the text.
    """
    text: str


SMALLEST, LARGEST = 1e-30, 1e30
"""Sizes of numbers that single precision keeps, and whose products can be computed."""
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_INTEGER = re.compile(r"[-+]?\d{1,18}", re.ASCII)
_DIMENSIONED = re.compile(
    r"(?:(?:[^\W\d]\S* )?(?P<dimensions>\[ .* \]|\[[^ ]*\]) )?(?P<value>[^\s\[]+)(?: (?P<unit>\[.*\]))?"
)
_SWITCHES = {"yes": True, "on": True, "true": True, "no": False, "off": False, "false": False}


def _number(text: str) -> float | None:
    if not _NUMBER.fullmatch(text):
        return None
    number = float(text)
    if number and not SMALLEST <= abs(number) <= LARGEST:
        raise ValueError("whose size is not from 1e-30 to 1e30")
    return number


def _dimensioned(expected: Dimensions) -> Callable[[Stream], float | None]:
    """Return a reader of numbers with or without name and dimensions."""

    def read(entry: Stream) -> float | None:
        match = _DIMENSIONED.fullmatch(entry.text)
        if not match or (value := _number(match["value"])) is None:
            return None
        for text in (match["dimensions"], match["unit"]):
            if text:
                value *= factor_of(text, expected)
        return value

    return read


def factor_of(text: str, expected: Dimensions) -> float:
    """Return the factor of a unit to SI; raise ValueError if its dimensions differ from the expected ones."""
    unit = read_unit(text)
    if unit is None:
        raise ValueError("whose dimensions cannot be read")
    dimensions, factor = unit
    if dimensions != expected:
        raise ValueError(f"with the dimensions {described(dimensions)}, not {described(expected)}")
    return factor


def _dimensions_of_acceleration(entry: Stream) -> str:
    if factor_of(entry.text, ACCELERATION) != 1.0:
        raise ValueError("which is not in m s^-2")
    return entry.text


def _constant(entry: Stream) -> float | None:
    match entry.tokens:
        case (value,) | ("constant", value):
            return _number(value)
    return None


def _vector(entry: Stream) -> tuple[float, ...] | None:
    return _numbers(_nested(entry.tokens), 3)


def unit_of(tokens: Sequence[str]) -> tuple[str, Sequence[str]]:
    """Return a unit in brackets that stands before or behind a value, or nothing, and the other tokens."""
    if "[" not in tokens or "]" not in tokens:
        return "", tokens
    start, end = tokens.index("["), tokens.index("]") + 1
    return " ".join(tokens[start:end]), (*tokens[:start], *tokens[end:])


def _acceleration(entry: Stream) -> tuple[float, ...] | None:
    """Return a vector in m/s2."""
    unit, tokens = unit_of(entry.tokens)
    vector = _numbers(_nested(tokens), 3)
    return vector and tuple((factor_of(unit, ACCELERATION) if unit else 1.0) * x for x in vector)


def _pairs(entry: Stream) -> tuple[tuple[float, ...], ...] | None:
    return _each(_nested(entry.tokens), lambda item: _numbers(item, 2))


def _axes(entry: Stream) -> tuple[tuple[tuple[float, ...], ...], ...] | None:
    return _each(_nested(entry.tokens), _two_vectors)


def _words(entry: Stream) -> tuple[str, ...] | None:
    return _each(_nested(entry.tokens), lambda item: unquoted(item) if isinstance(item, str) else None)


def _list_of_numbers(entry: Stream) -> tuple[float, ...] | None:
    return _each(_nested(entry.tokens), lambda item: _number(item) if isinstance(item, str) else None)


def _two_vectors(item: Item) -> tuple[tuple[float, ...], ...] | None:
    vectors = _each(item, lambda part: _numbers(part, 3))
    return vectors if vectors is not None and len(vectors) == 2 else None


def _numbers(item: Item | None, n: int) -> tuple[float, ...] | None:
    """Return a tuple of n numbers; None if the item is something else."""
    numbers = _each(item, lambda part: _number(part) if isinstance(part, str) else None)
    return numbers if numbers is not None and len(numbers) == n else None


def _each(item: Item | None, read: Callable[[Item], T | None]) -> tuple[T, ...] | None:
    """Return a tuple of the values of a list's items; None if it is no list, or an item cannot be read."""
    if not isinstance(item, tuple):
        return None
    parts = tuple(part for part in map(read, item) if part is not None)
    return parts if len(parts) == len(item) else None


def _nested(tokens: Sequence[str]) -> Item | None:
    """Return parentheses as nested tuples of words, without the number of items before them."""
    if len(tokens) > 1 and _INTEGER.fullmatch(tokens[0]):
        tokens = tokens[1:]
    lists: list[list[Item]] = [[]]
    for token in tokens:
        if token == "(":
            lists.append([])
        elif token == ")" and len(lists) > 1:
            last = tuple(lists.pop())
            lists[-1].append(last)
        else:
            lists[-1].append(token)
    return lists[0][0] if len(lists) == 1 and len(lists[0]) == 1 else None


def _word(entry: Stream) -> str | None:
    return (unquoted(entry.text) or None) if len(entry.tokens) == 1 else None


def _file(entry: Stream) -> Path | None:
    name = _word(entry)
    return _existing(entry, name) if name else None


def _existing(entry: Stream, name: str) -> Path | None:
    path = entry.source.case / "constant" / name
    try:
        return path if path.is_file() else None
    except OSError:
        return None


def _files(entry: Stream) -> tuple[Path, ...] | None:
    if len(entry.tokens) < 2 or (entry.tokens[0], entry.tokens[-1]) != ("(", ")"):
        return None
    paths = [_existing(entry, unquoted(name)) for name in entry.tokens[1:-1]]
    there = tuple(path for path in paths if path is not None)
    return there if len(there) == len(paths) else None


def _empty_list(entry: Stream) -> DictionaryList | None:
    if entry.tokens != ("(", ")"):
        return None
    return DictionaryList(entry.key, entry.parent, entry.source, entry.line)


READERS: dict[Any, Reader] = {
    float: Reader(lambda entry: _number(entry.text), "a number"),
    int: Reader(lambda entry: int(entry.text) if _INTEGER.fullmatch(entry.text) else None, "an integer"),
    bool: Reader(lambda entry: _SWITCHES.get(entry.text), ", ".join(_SWITCHES)),
    str: Reader(_word, "a word"),
    Line: Reader(lambda entry: entry.text, "any text"),
    Viscosity: Reader(
        _dimensioned(KINEMATIC_VISCOSITY), f"a number, or {written(KINEMATIC_VISCOSITY)} and a number"
    ),
    DynamicViscosity: Reader(
        _dimensioned(DYNAMIC_VISCOSITY), f"a number, or {written(DYNAMIC_VISCOSITY)} and a number"
    ),
    Density: Reader(_dimensioned(DENSITY), f"a number, or {written(DENSITY)} and a number"),
    Acceleration: Reader(_dimensions_of_acceleration, written(ACCELERATION)),
    Path: Reader(_file, "the name of an existing file, in constant/ or absolute"),
    Files: Reader(_files, "a list (file file) of existing files, in constant/ or absolute"),
    Vector3: Reader(_vector, "a vector (x y z)"),
    AccelerationVector: Reader(_acceleration, "a vector (x y z)"),
    Constant: Reader(_constant, "a number, constant in time"),
    Words: Reader(_words, "a list of words ( word word … )"),
    Numbers: Reader(_list_of_numbers, "a list of numbers ( x x … )"),
    Pairs: Reader(_pairs, "a list of pairs ( (x w) (x w) … )"),
    Axes: Reader(_axes, "a list of positions with an axis ( ((x y z) (x y z)) … )"),
    Dictionary: Reader(lambda _: None, DICTIONARY_TEXT),
    DictionaryList: Reader(_empty_list, "a list ( name { … } name { … } )"),
}
"""By the type in a schema's hint."""
