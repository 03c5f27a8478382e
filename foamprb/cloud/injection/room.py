"""Whether there is memory for the particles that are asked for, before it is taken."""

from __future__ import annotations

import math

import numpy as np

from foamprb.cloud.state import VARIABLES
from foamprb.errors import InputError
from foamprb.memory import memory, spoken

__all__ = ["BYTES", "require_room"]

BYTES = sum(
    (1 if v.fixed else 2) * math.prod(v.shape) * np.dtype(v.dtype).itemsize for v in VARIABLES.values()
)
"""Memory that a run needs for each particle: its state, and what changes of it at the last write time."""


def require_room(number: float, what: str) -> int:
    """Return a number of particles, rounded.

    Parameters
    ----------
    number
        As many as are asked for, infinite if that overflows.
    what
        What asks for them, at the beginning of a message.

    Raises
    ------
    InputError
        If it is none, or if there is not enough memory: how many they are, what they need, what there is.
    """
    need, there = number * BYTES, memory()
    if not need < there:
        raise InputError(
            f"{what} gives {number:.3g} particles, which need about {spoken(need)} of memory; there are "
            f"{spoken(there)}."
        )
    n = round(number)
    if n == 0:
        raise InputError(f"{what} gives no particle.")
    return n
