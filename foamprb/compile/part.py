"""A function that is compiled, and the keys by which its code is found."""

from __future__ import annotations

from typing import Any, NamedTuple

__all__ = ["Keys", "Part"]


class Keys(NamedTuple):
    """Keys of a function, of equal length."""

    full: str
    """It changes with the code of the function and of its callees."""
    outside: str
    """The same, but callees that are machine code of their own count by their names alone."""


class Part(NamedTuple):
    """A compiled function."""

    dispatcher: Any
    keys: Keys
