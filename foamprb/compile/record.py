"""Named tuples that compiled functions take by address, and objects that stand in for them.

numba passes each number of each array in a tuple as an argument of its own. The arrays of a mesh make two
hundred arguments, which each function that only passes them on unpacks and packs again. A record is one
argument.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, TypeVar, dataclass_transform

__all__ = ["RECORDS", "record", "stand_in"]

RECORDS: list[type[tuple[Any, ...]]] = []
"""Classes of records."""

S = TypeVar("S")
T = TypeVar("T", bound=type[tuple[Any, ...]])


def record(cls: T) -> T:
    """Make a named tuple a record.

    Compiled functions read its items by name. They can neither return nor make one.
    """
    RECORDS.append(cls)
    return cls


@dataclass_transform(frozen_default=True)
def stand_in(cls: type[S]) -> type[S]:
    """Make a class one of objects that kernels make and use in place of a record or of a table.

    Items that it lacks are those of its item ``base``, a record. Its element [i, j], a float, is
    ``cls.item(self, i, j)``: a static method that calls no other function of Python.
    """

    def forwarded(self: Any, name: str) -> Any:
        return getattr(object.__getattribute__(self, "base"), name)

    made: Any = dataclass(frozen=True)(cls)
    made.item_names = tuple(field.name for field in fields(made))
    made.__getattr__ = forwarded
    if hasattr(made, "item"):
        made.__getitem__ = lambda self, place: made.item(self, *place)
    return made  # type: ignore[no-any-return]
