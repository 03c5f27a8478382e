"""Whether there is memory for the particles that are asked for, before it is taken."""

from __future__ import annotations

import math
import os
import resource

import numpy as np

from foamprb.cloud.state import VARIABLES
from foamprb.errors import InputError

__all__ = ["BYTES", "memory", "require_room"]

BYTES = 2 * sum(math.prod(v.shape) * np.dtype(v.dtype).itemsize for v in VARIABLES.values())
"""Memory that a run needs for each particle: its state, and that of the last write time."""


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
            f"{what} gives {number:.3g} particles, which need about {_spoken(need)} of memory; there are "
            f"{_spoken(there)}."
        )
    n = round(number)
    if n == 0:
        raise InputError(f"{what} gives no particle.")
    return n


def memory() -> float:
    """Return the memory of this machine, or of this process if it is limited, bytes."""
    found = [float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))]
    for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA):
        limit, _ = resource.getrlimit(kind)
        if limit != resource.RLIM_INFINITY:
            found.append(float(limit))
    return min(found)


def _spoken(size: float) -> str:
    for unit, factor in (("TB", 1e12), ("GB", 1e9)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size / 1e6:.3g} MB"
