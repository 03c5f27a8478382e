"""Whether there is memory for the particles that are asked for, before it is taken."""

from __future__ import annotations

import math
import os
import resource
from pathlib import Path

import numpy as np

from foamprb.cloud.state import VARIABLES
from foamprb.errors import InputError

__all__ = ["BYTES", "free_memory", "require_room"]

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
        If it is none, or if there is not enough memory: how many they are, what they need and what is free.
    """
    need, free = number * BYTES, free_memory()
    if not need < free:
        raise InputError(
            f"{what} gives {number:.3g} particles, which need about {_spoken(need)} of memory; "
            f"{_spoken(free)} are free."
        )
    n = round(number)
    if n == 0:
        raise InputError(f"{what} gives no particle.")
    return n


def free_memory() -> float:
    """Return the memory that this process can still get, bytes; infinite if the system does not say."""
    found = [math.inf]
    try:
        lines = Path("/proc/meminfo").read_text().splitlines()
        found += [1024.0 * int(line.split()[1]) for line in lines if line.startswith("MemAvailable:")]
        in_use = int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return min(found)
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit != resource.RLIM_INFINITY:
        found.append(max(0.0, limit - in_use))
    return min(found)


def _spoken(size: float) -> str:
    for unit, factor in (("TB", 1e12), ("GB", 1e9)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size / 1e6:.3g} MB"
