"""Boundary for files that are read back: regular files of limited size, values of declared types.

A file may have been damaged, replaced or made by somebody else. Whatever is wrong with it becomes one message
with its name.
"""

from __future__ import annotations

import json
import math
import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from types import NoneType, UnionType
from typing import (
    Any,
    BinaryIO,
    Literal,
    TypeVar,
    Union,
    cast,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

from foamprb.errors import InputError

T = TypeVar("T")
_hints_of = cache(get_type_hints)
MOST_BYTES = 1 << 30
"""Largest size of a list or a record."""


@contextmanager
def reading(path: Path, what: str = "is damaged", remedy: str = "") -> Iterator[None]:
    """Raise InputError, with the name of a file, in place of any error that its contents cause."""
    try:
        yield
    except (InputError, MemoryError):
        raise
    except Exception as error:
        text = getattr(error, "strerror", None) or str(error)
        text = text.rstrip(".") if isinstance(error, OSError | ValueError) else repr(error)
        raise InputError(f"{path} {what}: {text}. {remedy}".rstrip()) from error


def open_regular(path: Path) -> BinaryIO:
    """Open a regular file; reading a pipe or a device may never end.

    Raises
    ------
    OSError
        If it cannot be opened.
    ValueError
        If it is something else.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise ValueError("it is not a regular file")
    return os.fdopen(descriptor, "rb")


def read_bytes(path: Path, most: int = MOST_BYTES) -> bytes:
    """Return the contents of a regular file; see :func:`open_regular`, also for a file that is too large."""
    with open_regular(path) as file:
        # A read of at most so many bytes would take memory for as many.
        if os.fstat(file.fileno()).st_size > most:
            raise ValueError(f"it is larger than {most >> 20} MiB")
        return file.read()


def read_json(path: Path, schema: type[T]) -> T:
    """Return the values in a file of JSON, of the types that a schema declares.

    Raises
    ------
    InputError
        If the file is something else.
    """
    with reading(path):
        return checked(json.loads(read_bytes(path)), schema)


def checked(value: Any, schema: type[T], where: str = "") -> T:
    """Return a value of JSON or TOML if it has the type that a schema declares, else raise ValueError.

    Parameters
    ----------
    value
        The value.
    schema
        A TypedDict, whose entries without declaration are ignored; a type of number or text, None, a Literal,
        a list, tuple or dict of these, or a union. Numbers are finite.
    where
        Name of the value in the message, if it has one.
    """
    fault = _fault(value, schema, where)
    if fault:
        raise ValueError(fault)
    return cast(T, value)


def _fault(value: Any, hint: Any, where: str) -> str:
    """Return what is wrong with a value; empty if it is as declared."""
    origin, arguments = get_origin(hint), get_args(hint)
    parts: Iterable[tuple[Any, Any, str]] = ()
    if hint is Any:
        return ""
    if origin in (Union, UnionType):
        faults = [_fault(value, one, where) for one in arguments]
        return "" if "" in faults else faults[0]
    if is_typeddict(hint) and isinstance(value, dict):
        if missing := hint.__required_keys__ - value.keys():
            return f"{where or 'it'} has no {min(missing)}"
        parts = ((value[k], t, _path(where, k)) for k, t in _hints_of(hint).items() if k in value)
    elif origin is list and isinstance(value, list):
        parts = ((item, arguments[0], where) for item in value)
    elif origin is dict and isinstance(value, dict):
        parts = ((item, arguments[1], _path(where, k)) for k, item in value.items())
    elif origin is tuple and isinstance(value, list) and len(value) == len(arguments):
        parts = ((item, one, where) for item, one in zip(value, arguments, strict=True))
    elif not _is_plain(value, hint, arguments if origin is Literal else ()):
        return f"{where or 'it'} is {value!r:.60}, not {_name_of(hint)}"
    return next(filter(None, (_fault(*part) for part in parts)), "")


def _path(where: str, key: Any) -> str:
    return f"{where}/{key}" if where else str(key)


def _is_plain(value: Any, kind: Any, values: tuple[Any, ...]) -> bool:
    """Return whether a value is a number, text or None of a type, or one of some values."""
    if values:
        return type(value) is type(values[0]) and value in values
    if kind is float:
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return number and abs(value) < 1e308 and math.isfinite(value)
    if kind is int:
        return type(value) is int and abs(value) < 1 << 63
    return kind in (str, bool, None, NoneType) and type(value) is (NoneType if kind is None else kind)


def _name_of(hint: Any) -> str:
    """Return the name of a type in a message."""
    names = {float: "a number", int: "an integer", str: "a text", bool: "true or false", NoneType: "null"}
    if get_origin(hint) is Literal:
        return " or ".join(map(repr, get_args(hint)))
    if get_origin(hint) in (list, tuple):
        return "a list"
    return names.get(hint, "an object")
