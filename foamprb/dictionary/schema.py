"""Any frozen dataclass from a dictionary: its field names are the entries, its type hints their kinds."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import MISSING, Field, fields
from pathlib import Path
from types import UnionType
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    Literal,
    NamedTuple,
    NewType,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from foamprb.dictionary.constraints import (
    Axes,
    Bounds,
    Choice,
    Constant,
    Each,
    Only,
    Pairs,
    Rule,
    Vector3,
    Words,
)
from foamprb.dictionary.grammar import DICTIONARY_TEXT, Dictionary, DictionaryList, Entry, Stream, unquoted
from foamprb.errors import InputError, suggestion

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Record = TypeVar("Record", bound="DataclassInstance")
Line = NewType("Line", str)
"""An entry's whole text, of one word or more."""
Files = NewType("Files", tuple[Path, ...])
"""Names of existing files, in the case's ``constant`` folder or absolute."""
Viscosity = NewType("Viscosity", float)
"""A kinematic viscosity, m2/s, that may be written with its name and dimensions."""


def read_entries(record: type[Record], dictionary: Dictionary, also: Iterable[str] = ()) -> Record:
    """Read a record, a dataclass whose fields are a dictionary's entries, by its type hints.

    Parameters
    ----------
    record
        Its hints may be a key of ``_READERS``, another record, Literal, or Annotated with one ``Rule``; each
        also with ``| None``, or with ``| Dictionary`` for what may be a dictionary instead.
    dictionary
        Its entries; those that a macro has used may have any name.
    also
        Names of entries that somebody else reads.

    Raises
    ------
    InputError
        If an entry is not known, missing, or does not hold what its hint says, or the record refuses what
        its entries say together.
    """
    hints = get_type_hints(record, include_extras=True)
    refuse_unknown(dictionary, (*names_of(record), *also))
    values = {
        entry.name: read_entry(dictionary, entry.name, hints[entry.name])
        for entry in fields(record)
        if entry.name in dictionary.entries or not _has_default(entry)
    }
    try:
        return record(**values)
    except InputError as error:
        raise dictionary.mistake(f"{error}.") from error


def read_entry(dictionary: Dictionary, key: str, hint: Any) -> Any:
    """Read one entry of a dictionary as a type hint says; see :func:`read_entries`."""
    if key not in dictionary.entries:
        raise dictionary.missing(key, allowed(hint))
    return _convert(dictionary.entries[key], hint)


def _has_default(entry: Field[Any]) -> bool:
    return entry.default is not MISSING or entry.default_factory is not MISSING


def names_of(record: type[DataclassInstance]) -> tuple[str, ...]:
    """Name the entries that a record reads."""
    return tuple(entry.name for entry in fields(record))


def refuse_unknown(dictionary: Dictionary, known: Collection[str]) -> None:
    """Raise InputError, with a suggestion, for an entry that nobody reads."""
    for key, entry in dictionary.entries.items():
        # A name that only serves as a macro's variable is the user's own.
        if key not in known and not entry.used:
            raise entry.mistake(f"is not known. {suggestion(key, known)}")


def selected(registry: Mapping[str, type[Record]], dictionary: Dictionary) -> type[Record]:
    """Find the class that a dictionary's ``type`` selects from a registry."""
    return registry[read_entry(dictionary, "type", Annotated[str, Choice(registry)])]


def _convert(entry: Entry, hint: Any) -> Any:
    """Turn an entry into what a type hint says."""
    kind, rule = _kind(hint)
    if isinstance(entry, Dictionary) and _may_be_dictionary(hint):
        return entry
    if kind is Dictionary:
        return entry.dictionary()
    if kind not in _READERS:
        return read_entries(kind, entry.dictionary())
    if kind is DictionaryList and isinstance(entry, DictionaryList):
        return entry
    if isinstance(entry, Stream) and any(token.startswith("#") for token in entry.tokens):
        raise entry.mistake(f"is {entry}, which is not evaluated: write the value itself.")
    value = _READERS[kind].read(entry) if isinstance(entry, Stream) else None
    if value is None or not (rule is None or rule.admits(value)):
        raise entry.mistake(
            f"is {entry}. {allowed(hint, found=entry.text if isinstance(entry, Stream) else '')}"
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
        return _kind(_first(hint))
    return hint, None


def _may_be_dictionary(hint: Any) -> bool:
    """Whether a union names Dictionary as the second choice."""
    return Dictionary in get_args(hint) and _first(hint) is not Dictionary


def _first(union: Any) -> Any:
    """The first member of a union that is not None."""
    return next(kind for kind in get_args(union) if kind is not type(None))


def allowed(hint: Any, found: str = "") -> str:
    """Say what an entry may be."""
    if _may_be_dictionary(hint):
        return f"{allowed(_first(hint), found).removesuffix('.')}, or {DICTIONARY_TEXT}."
    kind, rule = _kind(hint)
    match rule:
        case Choice(names):
            return suggestion(unquoted(found), names)
        case Only(value, why):
            return f"Allowed: {str(value).lower() if isinstance(value, bool) else value} ({why})."
        case Bounds() | Each():
            return f"Allowed: {rule.text}{', constant in time' if kind is Constant else ''}."
    return f"Allowed: {_READERS[kind if kind in _READERS else Dictionary].text}."


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


def _constant(entry: Stream) -> float | None:
    match entry.tokens:
        case (value,) | ("constant", value):
            return _number(value)
    return None


def _vector(entry: Stream) -> Any:
    return _numbers(_nested(entry), 3)


def _pairs(entry: Stream) -> Any:
    return _each(_nested(entry), lambda item: _numbers(item, 2))


def _axes(entry: Stream) -> Any:
    return _each(_nested(entry), _two_vectors)


def _words(entry: Stream) -> Any:
    return _each(_nested(entry), lambda item: unquoted(item) if isinstance(item, str) else None)


def _two_vectors(item: Any) -> Any:
    vectors = _each(item, lambda part: _numbers(part, 3))
    return vectors if vectors is not None and len(vectors) == 2 else None


def _numbers(item: Any, n: int) -> Any:
    """A tuple of n numbers; None if the item is something else."""
    numbers = _each(item, lambda part: _number(part) if isinstance(part, str) else None)
    return numbers if numbers is not None and len(numbers) == n else None


def _each(item: Any, read: Callable[[Any], Any]) -> Any:
    """A tuple of what is read of each part of a list; None if it is no list, or a part cannot be read."""
    if not isinstance(item, tuple):
        return None
    parts = tuple(map(read, item))
    return None if any(part is None for part in parts) else parts


def _nested(entry: Stream) -> Any:
    """Parentheses as nested tuples of words, the number of items before the outermost left out."""
    tokens = entry.tokens
    if len(tokens) > 1 and _INTEGER.fullmatch(tokens[0]):
        tokens = tokens[1:]
    lists: list[list[Any]] = [[]]
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
    return path if path.is_file() else None


def _files(entry: Stream) -> tuple[Path, ...] | None:
    if len(entry.tokens) < 2 or (entry.tokens[0], entry.tokens[-1]) != ("(", ")"):
        return None
    paths = [_existing(entry, unquoted(name)) for name in entry.tokens[1:-1]]
    found = tuple(path for path in paths if path is not None)
    return found if len(found) == len(paths) else None


_READERS: dict[Any, _Reader] = {
    float: _Reader(lambda entry: _number(entry.text), "a number"),
    int: _Reader(lambda entry: int(entry.text) if _INTEGER.fullmatch(entry.text) else None, "a whole number"),
    bool: _Reader(lambda entry: _SWITCHES.get(entry.text), ", ".join(_SWITCHES)),
    str: _Reader(_word, "a word"),
    Line: _Reader(lambda entry: entry.text, "any text"),
    Viscosity: _Reader(_viscosity_value, "a number, with the dimensions [0 2 -1 0 0 0 0] or none"),
    Path: _Reader(_file, "the name of an existing file, in constant/ or absolute"),
    Files: _Reader(_files, "a list (file file) of existing files, in constant/ or absolute"),
    Vector3: _Reader(_vector, "a vector (x y z)"),
    Constant: _Reader(_constant, "a number, constant in time"),
    Words: _Reader(_words, "a list of words ( word word … )"),
    Pairs: _Reader(_pairs, "a list of pairs ( (x w) (x w) … )"),
    Axes: _Reader(_axes, "a list of positions with an axis ( ((x y z) (x y z)) … )"),
    Dictionary: _Reader(lambda _: None, DICTIONARY_TEXT),
    DictionaryList: _Reader(lambda _: None, "a list ( name { … } name { … } )"),
}
