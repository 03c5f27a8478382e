"""Rules that a dictionary entry's value must keep, and what it means, declared beside its type.

A settings class is a frozen dataclass whose field names are the entries' own words; a bounded entry is
annotated, e.g. ``rho0: Annotated[float, Positive]``. :mod:`foamprb.dictionary.schema` checks.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass
from typing import NewType, TypeAlias


@dataclass(frozen=True)
class Bounds:
    """An interval of allowed values; ``text`` is how a message names it."""

    lower: float
    upper: float
    open_lower: bool
    open_upper: bool
    text: str

    def admits(self, value: float) -> bool:
        """Whether ``value`` is finite and lies in the interval."""
        above = value > self.lower if self.open_lower else value >= self.lower
        below = value < self.upper if self.open_upper else value <= self.upper
        return math.isfinite(value) and above and below


@dataclass(frozen=True, eq=False)
class Choice:
    """The names that a word may be, in most cases a registry."""

    names: Collection[str]

    def admits(self, value: str) -> bool:
        """Whether ``value`` is one of the names."""
        return value in self.names


@dataclass(frozen=True)
class Only:
    """An entry of OpenFOAM's that may have one value only, the one that means what foamprb does; and why."""

    value: bool | float | str
    why: str

    def admits(self, value: bool | float | str) -> bool:
        """Whether ``value`` is the one."""
        return value == self.value


@dataclass(frozen=True)
class NoEffect:
    """An entry of OpenFOAM's that changes nothing here, whatever its value; and why."""

    why: str

    def admits(self, value: object) -> bool:  # noqa: ARG002
        """Whether ``value`` is allowed: any is."""
        return True


@dataclass(frozen=True)
class Each:
    """Bounds of every component of a vector."""

    bounds: Bounds

    @property
    def text(self) -> str:
        """How a message names it."""
        return f"a vector (x y z), each {self.bounds.text}"

    def admits(self, value: tuple[float, ...]) -> bool:
        """Whether all components are admitted."""
        return all(self.bounds.admits(component) for component in value)


@dataclass(frozen=True)
class Meaning:
    """What the documentation says of an entry, in Markdown: beside its rule, in the same type hint.

    ``deltaT: Annotated[float, Positive, Meaning("tracking step", "s")]``. :mod:`foamprb.settings.reference`
    makes the pages, ``foamprb help`` and the comments of ``foamprb init`` of it.
    """

    text: str
    unit: str = ""
    default: str = ""
    """How the default is called, where its value says nothing to a reader."""


Rule: TypeAlias = Bounds | Choice | Only | NoEffect | Each
Vector3: TypeAlias = tuple[float, float, float]
Constant = NewType("Constant", float)
"""A number that OpenFOAM lets vary in time, and that is constant here: ``constant 3`` or ``3``."""
Words: TypeAlias = tuple[str, ...]
Pairs: TypeAlias = tuple[tuple[float, float], ...]
Axes: TypeAlias = tuple[tuple[Vector3, Vector3], ...]
"""Positions, each with the direction of an axis."""

Positive = Bounds(0.0, math.inf, True, True, "a number > 0")
NonNegative = Bounds(0.0, math.inf, False, True, "a number >= 0")
AtLeastOne = Bounds(1.0, math.inf, False, True, "a whole number >= 1")
Fraction = Bounds(0.0, 1.0, False, False, "a number from 0 to 1")
Angle = Bounds(0.0, 180.0, False, False, "an angle from 0 to 180 degrees")
PoissonsRatio = Bounds(-1.0, 0.5, True, True, "a number > -1 and < 0.5")
Positive3 = Each(Positive)
