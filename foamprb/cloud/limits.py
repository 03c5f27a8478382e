"""Limits of the model of a body in a uniform gradient; a particle beyond them fails."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple


@dataclass(frozen=True)
class Limits:
    """Limits of a particle, by the names of their entries in ``solution``.

    Raises
    ------
    ValueError
        If one is out of its range.
    """

    maxStretch: float = 100.0
    """Largest stretch from the shape at rest, 1."""
    maxSize: float = 0.5
    """Longest semi-axis over the flow's width; at ½ a body is as long as the flow is wide."""
    maxSubSteps: float = 10_000.0
    """Most time steps of a particle in one tracking step, repeated ones included."""
    maxCells: float = math.inf
    """Longest semi-axis over the size of the cell that holds the centre, the cube root of its volume."""

    def __post_init__(self) -> None:
        sizes = self.maxSize > 0.0 and self.maxCells > 0.0
        if not (self.maxStretch > 1.0 and sizes and self.maxSubSteps >= 1.0):
            raise ValueError(f"{self} is out of bounds.")


class LoopLimits(NamedTuple):
    """The same limits as arguments of the compiled loop, for one flow."""

    maxStretch: float = math.inf
    maxLength: float = math.inf
    """Longest semi-axis, m: ``maxSize`` times the flow's width."""
    maxSubSteps: float = math.inf
    reach: float = math.inf
    """Distance within which all walls are listed, m."""
    reach_grows: bool = False
    """Whether walls farther away can be listed for a body that needs it."""
    maxCells: float = math.inf
    tolerance: float = 0.0
    """Least tolerance of steps, by the roughness of the flow."""
