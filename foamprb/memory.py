"""Memory: available amount, announced needs, and the message on exhaustion."""

from __future__ import annotations

import ctypes
import errno
import os
import resource
from contextlib import suppress
from pathlib import Path

__all__ = [
    "OutOfMemory",
    "announce",
    "forget",
    "memory",
    "ran_out",
    "require",
    "require_start",
    "size_text",
    "spread_over",
]

START = 1e9
"""Address space of a run with few particles and cells, bytes; at most a third of it is used.

With much less the libraries cannot be loaded, and may fail in unpredictable ways.
"""

_announced: dict[str, tuple[int, float]] = {}
"""Announced needs: a number, and bytes of each, by name."""
_machines = [1]
"""Number of machines of a run."""


class OutOfMemory(MemoryError):  # noqa: N818
    """Memory exhaustion; the message gives the purpose, the need and the available amount."""


def memory() -> float:
    """Return the memory of this machine, or of this process if it is limited, bytes.

    Of a run on several machines it is that of all, see :func:`spread_over`.
    """
    found = [float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))]
    found += [limit for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA) if (limit := _limit(kind))]
    return min(found) * _machines[0]


def spread_over(machines: int) -> None:
    """State on how many machines like this one a run holds its particles."""
    _machines[0] = machines


def announce(what: str, number: int, each: float) -> None:
    """Announce a need for memory, so that a message can name it on exhaustion.

    Parameters
    ----------
    what
        Name in the plural: ``"particles"``.
    number
        Their number.
    each
        Bytes for each of them in total.
    """
    _announced[what] = number, each


def forget() -> None:
    """Forget announced needs, at the start of another command."""
    _announced.clear()


def require_start() -> None:
    """Raise OutOfMemory if the address space of this process is too small to load the program."""
    limit = _limit(resource.RLIMIT_AS)
    if 0.0 < limit < START:
        raise OutOfMemory(
            f"not enough memory for the program itself: needs about {size_text(START)}, and this process may "
            f"take {size_text(limit)} (ulimit -v)."
        )


def require(size: float) -> None:
    """Raise OutOfMemory if the limit of this process' address space leaves fewer bytes.

    A library that fails to allocate memory may end the process itself, without a message.
    """
    limit, taken = _limit(resource.RLIMIT_AS), 0.0
    with suppress(OSError):
        taken = float(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    if limit and size > limit - taken:
        raise OutOfMemory(_message())


def ran_out(error: BaseException | None) -> OutOfMemory | None:
    """Return the OutOfMemory for an error caused by memory exhaustion, else None."""
    seen: list[BaseException] = []
    while error is not None and error not in seen:
        if isinstance(error, OutOfMemory):
            return error
        if _is_memory_error(error):
            return OutOfMemory(_message())
        seen.append(error)
        error = error.__cause__ or error.__context__
    return None


def size_text(size: float) -> str:
    """Return a size in bytes as text with a unit."""
    for unit, factor in (("TB", 1e12), ("GB", 1e9)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size / 1e6:.3g} MB"


def _message() -> str:
    there = memory()
    names = " and ".join(f"{number} {what}" for what, (number, _) in _announced.items())
    need = sum(number * each for number, each in _announced.values())
    if _limit(resource.RLIMIT_AS):
        need += START
    # Other processes may use part of the memory.
    needs = f"about {size_text(need)}" if need > there else f"more than {size_text(there)}"
    return (
        f"not enough memory for {names}; needs {needs}, and there are {size_text(there)}."
        if names
        else f"not enough memory; there are {size_text(there)}."
    )


def _limit(kind: int) -> float:
    """Return a limit of this process, 0 without a limit."""
    limit, _ = resource.getrlimit(kind)
    return 0.0 if limit == resource.RLIM_INFINITY else float(limit)


def _is_memory_error(error: BaseException) -> bool:
    if isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return True
    if isinstance(error, SystemError) and _limit(resource.RLIMIT_AS):
        # Python could not allocate the exception itself.
        return True
    text = str(error)
    # Messages of the loader of shared libraries and of Python's threads.
    return (isinstance(error, ImportError | OSError) and "failed to map segment" in text) or (
        isinstance(error, RuntimeError) and "can't start new thread" in text
    )


def trim() -> None:
    """Return free memory of this process to the system, which the C library would keep."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)
