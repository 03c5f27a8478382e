"""Schemas: frozen dataclasses that declare a dictionary's entries: types, bounds, defaults, meanings.

Field names are the entries' names, type hints declare their values: ``rho0: Annotated[float, Positive]``.
A field of type ``Annotated[None, NoEffect(why)]`` is an entry of OpenFOAM's that is accepted with any value;
the log says that it has no effect.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import MISSING, Field, fields
from functools import cache
from types import NoneType, UnionType
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

log = logging.getLogger("foamprb")


class Instead(NamedTuple):
    """Replacement for an entry of OpenFOAM's that does not exist here."""

    entry: str
    """Name of an entry that exists."""
    why: str
    """End of the message ``use <entry>, …``."""


class Schema(Protocol):
    """Any dataclass.

    It may have a static method ``instead(word)``, which returns :class:`Instead` for an entry of OpenFOAM's
    that has another name here, else None.
    """

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


S = TypeVar("S", bound=Schema)


def read_entries(schema: type[S], dictionary: Dictionary, also: Iterable[str] = ()) -> S:
    """Read the entries of a dictionary that a schema declares.

    Parameters
    ----------
    schema
        A type hint may be a key of :data:`~foamprb.dictionary.values.READERS`, another schema, a Literal, or
        a class with a static method ``from_dictionary``. It may be one of them ``| None``, or
        ``| Dictionary`` or another class that is read from a dictionary, and Annotated with one rule.
    dictionary
        The dictionary; entries that a macro has used may have any name.
    also
        Names of entries that are read elsewhere.

    Raises
    ------
    InputError
        If entries are unknown, missing or invalid, with all of them; or if the schema raises it because
        entries contradict each other.
    """
    hints = hints_of(schema)
    names = {*names_of(schema), *also}
    # Entries without effect are read, but never suggested.
    idle = {name for name, hint in hints.items() if isinstance(_kind(hint)[1], NoEffect)}
    mistakes = Mistakes()
    with mistakes:
        _refuse_unknown(dictionary, names, idle, getattr(schema, "instead", None))
    values = {}
    lines = {key: entry.line for key, entry in dictionary.entries.items()}
    for entry in sorted(fields(schema), key=lambda field: lines.get(field.name, 0)):
        with mistakes:
            if entry.name in lines or entry.default is MISSING:
                values[entry.name] = read_entry(dictionary, entry.name, hints[entry.name])
    mistakes.raise_any()
    try:
        return schema(**values)
    except InputError as error:
        raise dictionary.mistake(f"{error}.") from error


def read_entry(dictionary: Dictionary, key: str, hint: object) -> Any:
    """Read one entry of a dictionary by a type hint; see :func:`read_entries`."""
    if key not in dictionary.entries:
        raise dictionary.missing(key, allowed(hint))
    return _convert(dictionary.entries[key], hint)


@cache
def hints_of(schema: type) -> dict[str, Any]:
    """Return the hints of the entries that a schema declares, with their notes."""
    return get_type_hints(schema, include_extras=True)


def names_of(schema: type[Schema]) -> tuple[str, ...]:
    """Return the names of the entries that a schema declares."""
    return tuple(entry.name for entry in fields(schema))


def refuse_unknown(dictionary: Dictionary, names: Collection[str]) -> None:
    """Raise InputError, with suggestions, for entries whose names are not known."""
    _refuse_unknown(dictionary, names, (), None)


def _refuse_unknown(
    dictionary: Dictionary,
    names: Collection[str],
    idle: Collection[str],
    instead: Callable[[str], Instead | None] | None,
) -> None:
    """See :func:`refuse_unknown`; ``idle`` names are known but never suggested, ``instead`` goes first."""
    mistakes = Mistakes()
    active = set(names).difference(idle)
    for key, entry in dictionary.entries.items():
        # A macro's variable may have any name.
        if key in names or entry.used:
            continue
        other = instead(key) if instead else None
        if other and other.entry in idle:
            _log_no_effect(entry, other.why)
        elif other:
            mistakes.add(entry.mistake(f"is not known: use {other.entry}, {other.why}.", (other.entry,)))
        else:
            meant = closest(key, active)
            text = f"is not known. {suggestion(key, active)}"
            mistakes.add(entry.mistake(text, (meant,) if meant else ()))
    mistakes.raise_any()


def selected(registry: Mapping[str, type[S]], dictionary: Dictionary) -> type[S]:
    """Return the class that a dictionary's ``type`` selects from a registry."""
    return registry[read_entry(dictionary, "type", Annotated[str, Choice(registry)])]


def read_model(registry: Mapping[str, type[S]], dictionary: Dictionary, also: Iterable[str] = ()) -> S:
    """Read ``{ type name; … }``: the class that ``type`` selects from a registry, with its entries."""
    return read_entries(selected(registry, dictionary), dictionary, also=("type", *also))


def allowed(hint: object, text: str = "") -> str:
    """Return the part of a message that lists the allowed values of an entry, given the value found."""
    kind, rule = _kind(hint)
    match rule:
        case Choice(names):
            return suggestion(unquoted(text), names)
        case Only(value, why):
            return f"Allowed: {str(value).lower() if isinstance(value, bool) else value} ({why})."
        case Bounds() | Each():
            text = f"{rule.text}{', constant in time' if kind is Constant else ''}"
        case _:
            text = READERS[kind if kind in READERS else Dictionary].text
    other = f", or {DICTIONARY_TEXT}" if any(map(_reads_dictionary, members(hint)[1:])) else ""
    return f"Allowed: {text}{other}."


def members(hint: Any) -> tuple[Any, ...]:
    """Return the types that an entry may have by its hint, without None and notes."""
    if get_origin(hint) is Annotated:
        return members(hint.__origin__)
    if get_origin(hint) in (Union, UnionType):
        return tuple(one for part in get_args(hint) if part is not NoneType for one in members(part))
    return (hint,)


def note_of(hint: Any, kind: Any) -> Any:
    """Return the note of a kind in a hint, such as its :class:`~foamprb.dictionary.constraints.Meaning`."""
    notes = hint.__metadata__ if get_origin(hint) is Annotated else ()
    return next((note for note in notes if isinstance(note, kind)), None)


def rule_of(hint: Any) -> Rule | None:
    """Return the rule for the value of an entry, by its type hint."""
    return _kind(hint)[1]


def _kind(hint: object) -> tuple[Any, Rule | None]:
    """Split a hint into its first type (a key of ``READERS``, or a schema) and the rule for the value."""
    kind, rule = members(hint)[0], note_of(hint, Rule)
    return (str, Choice(get_args(kind))) if get_origin(kind) is Literal else (kind, rule)


def _reads_dictionary(kind: object) -> bool:
    return kind is Dictionary or hasattr(kind, "from_dictionary")


def _convert(entry: Entry, hint: object) -> Any:
    """Return the value of an entry, of the type that a hint declares."""
    kind, rule = _kind(hint)
    if isinstance(rule, NoEffect):
        _log_no_effect(entry, rule.why)
        return None
    of_dictionary = next(filter(_reads_dictionary, members(hint)), None)
    if of_dictionary and (isinstance(entry, Dictionary) or of_dictionary is kind):
        dictionary = entry.dictionary()
        return dictionary if of_dictionary is Dictionary else of_dictionary.from_dictionary(dictionary)
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
        # An entry without its semicolon includes the entries after it.
        text, tokens = (entry.text, entry.tokens) if isinstance(entry, Stream) else ("", ())
        raise entry.mistake(f"is {entry}. {allowed(hint, text)}", tokens)
    return value


def _log_no_effect(entry: Entry, why: str) -> None:
    log.info("%s, line %d: %s has no effect: %s.", entry.source, entry.line, entry.path, why)
