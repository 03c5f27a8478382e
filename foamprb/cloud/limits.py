"""Where the model of a body in a uniform gradient ends: what fails a particle that goes beyond."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["Bounds", "Limits"]


@dataclass(frozen=True)
class Limits:
    """Limits of a particle; one that passes them fails, with a reason of its own.

    Raises
    ------
    ValueError
        If one is not positive, or below 1 where there is nothing less.
    """

    max_stretch: float = 100.0
    """Largest stretch from the shape at rest, 1."""
    max_size: float = 0.5
    """Longest semi-axis over the flow's width; at ½ a body is as long as the flow is wide."""
    max_sub_steps: float = 10_000.0
    """Most time steps that a particle takes in one tracking step, those that are repeated among them."""
    max_cells: float = math.inf
    """Longest semi-axis over the size of the cell that holds the centre, the cube root of its volume."""

    def __post_init__(self) -> None:
        sizes = self.max_size > 0.0 and self.max_cells > 0.0
        if not (self.max_stretch > 1.0 and sizes and self.max_sub_steps >= 1.0):
            raise ValueError(f"{self} is out of bounds.")


class Bounds(NamedTuple):
    """The same limits as the compiled loop reads them, for one flow."""

    stretch: float = math.inf
    """1, from the shape at rest."""
    length: float = math.inf
    """Of a semi-axis, m."""
    sub_steps: float = math.inf
    reach: float = math.inf
    """Distance within which all walls are listed, m."""
    reach_grows: bool = False
    """Whether they can be listed farther away, for a body that needs it."""
    cells: float = math.inf
    """Semi-axis over the size of the cell."""
