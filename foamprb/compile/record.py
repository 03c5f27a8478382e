"""Named tuples that compiled functions take by address.

numba passes each number of each array in a tuple as an argument of its own. The arrays of a mesh make two
hundred arguments, which each function that only passes them on unpacks and packs again. A record is one
argument.
"""

from __future__ import annotations

from typing import Any, TypeVar

__all__ = ["RECORDS", "record"]

RECORDS: list[type[tuple[Any, ...]]] = []
"""Classes of records."""

T = TypeVar("T", bound=type[tuple[Any, ...]])


def record(cls: T) -> T:
    """Make a named tuple a record.

    Compiled functions read its items by name. They can neither return nor make one.
    """
    RECORDS.append(cls)
    return cls
