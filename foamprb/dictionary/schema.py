"""A schema: a frozen dataclass that declares a dictionary's entries: types, bounds, defaults, meanings.

Its field names are the entries' own words, its type hints say what they hold:
``rho0: Annotated[float, Positive]``. A field of type ``Annotated[None, NoEffect(why)]`` is an entry of
OpenFOAM's that is accepted with any value, and of which a note says that it has no effect.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import MISSING, Field, fields
from types import UnionType
from typing import (
    Annotated,
    Any,
    ClassVar,
    Literal,
    NamedTuple,
    Protocol,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from foamprb.dictionary.constraints import Bounds, Choice, Constant, Each, NoEffect, Only, Rule
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.tree import DICTIONARY_TEXT, Dictionary, DictionaryList, Entry, Stream, unquoted
from foamprb.dictionary.values import READERS
from foamprb.errors import InputError, closest, suggestion

__all__ = [
    "Instead",
    "Schema",
    "allowed",
    "names_of",
    "read_entries",
    "read_entry",
    "refuse_unknown",
    "rule_of",
    "selected",
]


log = logging.getLogger("foamprb")


class Instead(NamedTuple):
    """What to write for an entry of OpenFOAM's that does not exist here."""

    entry: str
    """The name of an entry that does."""
    why: str
    """How a message goes on behind ``use <entry>, ``."""


class Schema(Protocol):
    """Any dataclass.

    It may have a static method ``instead(word)``, which returns :class:`Instead` for a word of OpenFOAM's
    that has another name here, else None.
    """

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


S = TypeVar("S", bound=Schema)


def read_entries(schema: type[S], dictionary: Dictionary, also: Iterable[str] = ()) -> S:
    """Read the entries of a dictionary that a schema declares.

    Parameters
    ----------
    schema
        Its type hints may be a key of :data:`~foamprb.dictionary.values.READERS`, another schema, Literal, or
        Annotated with one rule; each also with ``| None``, or with ``| Dictionary`` for what may be a
        dictionary instead.
    dictionary
        Its entries; those that a macro has used may have any name.
    also
        Names of entries that are read elsewhere.

    Raises
    ------
    InputError
        If entries are not known, missing, or do not hold what their hints say, all of them; or if the schema
        refuses what its entries say together.
    """
    hints = get_type_hints(schema, include_extras=True)
    known = {*names_of(schema), *also}
    # Those are read, but not worth a suggestion.
    idle = {name for name, hint in hints.items() if isinstance(_kind(hint)[1], NoEffect)}
    mistakes = Mistakes()
    with mistakes:
        _refuse_unknown(dictionary, known, idle, getattr(schema, "instead", None))
    values = {}
    for entry in sorted(fields(schema), key=lambda field: _line(dictionary, field.name)):
        with mistakes:
            if entry.name in dictionary.entries or not _has_default(entry):
                values[entry.name] = read_entry(dictionary, entry.name, hints[entry.name])
    mistakes.raise_any()
    try:
        return schema(**values)
    except InputError as error:
        raise dictionary.mistake(f"{error}.") from error


def read_entry(dictionary: Dictionary, key: str, hint: Any) -> Any:
    """Read one entry of a dictionary as a type hint says; see :func:`read_entries`."""
    if key not in dictionary.entries:
        raise dictionary.missing(key, allowed(hint))
    return _convert(dictionary.entries[key], hint)


def names_of(schema: type[Schema]) -> tuple[str, ...]:
    """Return the names of the entries that a schema declares."""
    return tuple(entry.name for entry in fields(schema))


def refuse_unknown(dictionary: Dictionary, known: Collection[str]) -> None:
    """Raise InputError, with suggestions, for entries whose names are not known."""
    _refuse_unknown(dictionary, known, (), None)


def _refuse_unknown(
    dictionary: Dictionary,
    known: Collection[str],
    idle: Collection[str],
    instead: Callable[[str], Instead | None] | None,
) -> None:
    """Do the same; what is ``idle`` is known, but no suggestion, and ``instead`` may have a better one."""
    mistakes = Mistakes()
    names = set(known).difference(idle)
    for key, entry in dictionary.entries.items():
        # A name that only serves as a macro's variable is the user's own.
        if key in known or entry.used:
            continue
        other = instead(key) if instead else None
        if other and other.entry in idle:
            _note(entry, other.why)
        elif other:
            mistakes.add(entry.mistake(f"is not known: use {other.entry}, {other.why}.", (other.entry,)))
        else:
            meant = closest(key, names)
            text = f"is not known. {suggestion(key, names)}"
            mistakes.add(entry.mistake(text, (meant,) if meant else ()))
    mistakes.raise_any()


def selected(registry: Mapping[str, type[S]], dictionary: Dictionary) -> type[S]:
    """Return the class that a dictionary's ``type`` selects from a registry."""
    return registry[read_entry(dictionary, "type", Annotated[str, Choice(registry)])]


def allowed(hint: Any, found: str = "") -> str:
    """Return the part of a message that says what an entry may be, given what was found."""
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
    return f"Allowed: {READERS[kind if kind in READERS else Dictionary].text}."


def _line(dictionary: Dictionary, key: str) -> int:
    return dictionary.entries[key].line if key in dictionary.entries else 0


def _has_default(entry: Field[Any]) -> bool:
    return entry.default is not MISSING or entry.default_factory is not MISSING


def _convert(entry: Entry, hint: Any) -> Any:
    """Return what an entry holds, of the type that a hint says."""
    kind, rule = _kind(hint)
    if isinstance(rule, NoEffect):
        _note(entry, rule.why)
        return None
    if isinstance(entry, Dictionary) and _may_be_dictionary(hint):
        return entry
    if kind is Dictionary:
        return entry.dictionary()
    if kind not in READERS:
        return read_entries(kind, entry.dictionary())
    if kind is DictionaryList and isinstance(entry, DictionaryList):
        return entry
    if isinstance(entry, Stream) and any(token.startswith("#") for token in entry.tokens):
        raise entry.mistake(f"is {entry}, which is not evaluated: write the value itself.")
    try:
        value = READERS[kind].read(entry) if isinstance(entry, Stream) else None
    except ValueError as error:
        raise entry.mistake(f"is {entry}, {error}.") from error
    if value is None or not (rule is None or rule.admits(value)):
        # Without its semicolon an entry swallows those that follow.
        text, tokens = (entry.text, entry.tokens) if isinstance(entry, Stream) else ("", ())
        raise entry.mistake(f"is {entry}. {allowed(hint, found=text)}", tokens)
    return value


def _note(entry: Entry, why: str) -> None:
    log.info("%s, line %d: %s has no effect: %s.", entry.source, entry.line, entry.path, why)


def _kind(hint: Any) -> tuple[Any, Rule | None]:
    """Split a hint into a type (a key of ``READERS``, or a schema) and the rule that the value must keep."""
    origin = get_origin(hint)
    if origin is Annotated:
        kind, rule = _kind(hint.__origin__)
        return kind, next((note for note in hint.__metadata__ if isinstance(note, Rule)), rule)
    if origin is Literal:
        return str, Choice(get_args(hint))
    if origin in (Union, UnionType):
        return _kind(_first(hint))
    return hint, None


def rule_of(hint: Any) -> Rule | None:
    """Return the rule that the value of an entry must keep, by its type hint."""
    return _kind(hint)[1]


def _may_be_dictionary(hint: Any) -> bool:
    """Whether a union names Dictionary as the second choice."""
    return Dictionary in get_args(hint) and _first(hint) is not Dictionary


def _first(union: Any) -> Any:
    """Return the first member of a union that is not None."""
    return next(kind for kind in get_args(union) if kind is not type(None))
