"""Memory: available amount, and the message on exhaustion."""

from __future__ import annotations

import ctypes
import errno
import os
import resource
from contextlib import suppress

__all__ = ["OutOfMemory", "memory", "ran_out", "size_text", "spread_over", "trim"]

_machines = [1]
"""Number of machines of a run."""


class OutOfMemory(MemoryError):  # noqa: N818
    """Memory exhaustion; the message gives the available amount."""


def memory() -> float:
    """Return the memory of this machine, or of this process if it is limited, bytes.

    Of a run on several machines it is that of all, see :func:`spread_over`.
    """
    limits = [float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))]
    for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA):
        limit, _ = resource.getrlimit(kind)
        limits += [] if limit == resource.RLIM_INFINITY else [float(limit)]
    return min(limits) * _machines[0]


def spread_over(machines: int) -> None:
    """State on how many machines like this one a run holds its particles."""
    _machines[0] = machines


def ran_out(error: BaseException | None) -> OutOfMemory | None:
    """Return the OutOfMemory for an error caused by memory exhaustion, else None."""
    seen: list[BaseException] = []
    while error is not None and error not in seen:
        if isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
            return OutOfMemory(f"not enough memory; {size_text(memory())} are available.")
        seen.append(error)
        error = error.__cause__ or error.__context__
    return None


def size_text(size: float) -> str:
    """Return a size in bytes as text with a unit."""
    for unit, factor in (("TB", 1e12), ("GB", 1e9)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size / 1e6:.3g} MB"


def trim() -> None:
    """Return free memory of this process to the system, which the C library would keep."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)
