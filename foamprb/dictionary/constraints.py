"""Rules for the values of dictionary entries, and their documentation, declared beside their types.

A settings class is a frozen dataclass whose field names are the entries' names; an entry with a rule is
annotated, e.g. ``rho0: Annotated[float, Positive]``. :mod:`foamprb.dictionary.schema` checks the rules.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Annotated, NewType, TypeAlias


@dataclass(frozen=True)
class Bounds:
    """An interval of allowed values; ``text`` is its name in messages."""

    lower: float
    upper: float
    open_lower: bool
    open_upper: bool
    text: str

    def admits(self, value: float) -> bool:
        """Return whether ``value`` is finite and lies in the interval."""
        above = value > self.lower if self.open_lower else value >= self.lower
        below = value < self.upper if self.open_upper else value <= self.upper
        return math.isfinite(value) and above and below


@dataclass(frozen=True, eq=False)
class Choice:
    """Allowed words of an entry or of its list, in most cases the names of a registry."""

    names: Collection[str]

    def admits(self, value: str | Words) -> bool:
        """Return whether ``value`` is one of the names, or all words of a list are."""
        return all(word in self.names for word in ([value] if isinstance(value, str) else value))


@dataclass(frozen=True)
class Only:
    """An entry of OpenFOAM's with a single allowed value, which describes foamprb's model; and why."""

    value: bool | float | str
    why: str

    def admits(self, value: bool | float | str) -> bool:
        """Return whether ``value`` is the allowed one."""
        return value == self.value


@dataclass(frozen=True)
class NoEffect:
    """An entry of OpenFOAM's without effect here, with any value; and why."""

    why: str

    def admits(self, value: object) -> bool:  # noqa: ARG002
        """Return true: any value is allowed."""
        return True


@dataclass(frozen=True)
class Each:
    """Bounds of every component of a vector."""

    bounds: Bounds

    @property
    def text(self) -> str:
        """Name in messages."""
        return f"a vector (x y z), each {self.bounds.text}"

    def admits(self, value: tuple[float, ...]) -> bool:
        """Return whether all components are admitted."""
        return all(self.bounds.admits(component) for component in value)


@dataclass(frozen=True)
class Meaning:
    """Documentation of an entry, in Markdown: beside its rule, in the same type hint.

    ``deltaT: Annotated[float, Positive, Meaning("tracking step", "s")]``. ``tools/settings_reference.py``
    makes the settings page, ``foamprb help`` and the comments of ``foamprb init`` from it.
    """

    text: str
    unit: str = ""
    default: str = ""
    """Description of the default, if its value is not to be shown."""
    values: Mapping[str, str] = field(default_factory=dict)
    """What each allowed word means, where the text does not say it."""


Rule: TypeAlias = Bounds | Choice | Only | NoEffect | Each
Vector3: TypeAlias = tuple[float, float, float]
Constant = NewType("Constant", float)
"""A number that may vary in time in OpenFOAM and is constant here: ``constant 3`` or ``3``."""
Words: TypeAlias = tuple[str, ...]
Numbers: TypeAlias = tuple[float, ...]
Pairs: TypeAlias = tuple[tuple[float, float], ...]
Axes: TypeAlias = tuple[tuple[Vector3, Vector3], ...]
"""Positions, each with the direction of an axis."""

Positive = Bounds(0.0, math.inf, True, True, "a number > 0")
NonNegative = Bounds(0.0, math.inf, False, True, "a number >= 0")
AtLeastOne = Bounds(1.0, math.inf, False, True, "an integer >= 1")
Fraction = Bounds(0.0, 1.0, False, False, "a number from 0 to 1")
Angle = Bounds(0.0, 180.0, False, False, "an angle from 0 to 180 degrees")
PoissonsRatio = Bounds(
    -1.0, 0.5, True, True, "a number > -1 and < 0.5, such as 0.4999 for a solid that keeps its volume"
)
Positive3 = Each(Positive)
Seed = Annotated[
    int,
    Bounds(0.0, 2.0**32 - 1.0, False, False, "an integer >= 0 and < 4294967296"),
    Meaning("runs with the same seed have the same random numbers"),
]
