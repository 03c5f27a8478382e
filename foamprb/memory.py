"""Memory: how much there is, what asks for it, and what is said where it runs out."""

from __future__ import annotations

import errno
import os
import resource
from contextlib import suppress
from pathlib import Path

__all__ = ["OutOfMemory", "forget", "memory", "ran_out", "require", "require_start", "spoken", "wants"]

START = 1e9
"""Address space of a run with next to no particles and cells, bytes; a third of it is ever used.

With much less the libraries cannot be loaded, and what they do then is not for sure.
"""

_wanted: dict[str, tuple[int, float]] = {}
"""What was asked for last: a number, and bytes of each."""


class OutOfMemory(MemoryError):  # noqa: N818
    """There is not enough memory: the message says for what, how much it needs, and how much there is."""


def memory() -> float:
    """Return the memory of this machine, or of this process if it is limited, bytes."""
    found = [float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))]
    found += [limit for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA) if (limit := _limit(kind))]
    return min(found)


def wants(what: str, number: int, each: float) -> None:
    """Say what is about to be asked for, so that a message can name it where memory runs out.

    Parameters
    ----------
    what
        In the plural: ``"particles"``.
    number
        How many they are.
    each
        Bytes for each of them, all in all.
    """
    _wanted[what] = number, each


def forget() -> None:
    """Forget what was asked for: another command begins."""
    _wanted.clear()


def require_start() -> None:
    """Raise OutOfMemory if the address space of this process is too small to load the program."""
    limit = _limit(resource.RLIMIT_AS)
    if 0.0 < limit < START:
        raise OutOfMemory(
            f"not enough memory for the program itself: needs about {spoken(START)}, and this process may "
            f"take {spoken(limit)} (ulimit -v)."
        )


def require(size: float) -> None:
    """Raise OutOfMemory if so many bytes are more than the limit of this process' address space has left.

    A library that is denied memory may end the process by itself, which cannot be told afterwards.
    """
    limit = _limit(resource.RLIMIT_AS)
    if limit and size > limit - _taken():
        raise OutOfMemory(_message())


def ran_out(error: BaseException | None) -> OutOfMemory | None:
    """Return what is to be said of an error if its reason is that memory ran out, else None."""
    seen: list[BaseException] = []
    while error is not None and error not in seen:
        if isinstance(error, OutOfMemory):
            return error
        if _is_of_memory(error):
            return OutOfMemory(_message())
        seen.append(error)
        error = error.__cause__ or error.__context__
    return None


def spoken(size: float) -> str:
    """A size in bytes, with its unit."""
    for unit, factor in (("TB", 1e12), ("GB", 1e9)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size / 1e6:.3g} MB"


def _message() -> str:
    there = memory()
    names = " and ".join(f"{number} {what}" for what, (number, _) in _wanted.items())
    need = sum(number * each for number, each in _wanted.values())
    if _limit(resource.RLIMIT_AS):
        need += START
    # Others may have taken some of what there is.
    needs = f"about {spoken(need)}" if need > there else f"more than {spoken(there)}"
    return (
        f"not enough memory for {names}; needs {needs}, and there are {spoken(there)}."
        if names
        else f"not enough memory; there are {spoken(there)}."
    )


def _taken() -> float:
    """Address space of this process, bytes; 0 where the system does not say."""
    with suppress(OSError):
        pages = Path("/proc/self/statm").read_text().split()[0]
        return float(int(pages) * os.sysconf("SC_PAGE_SIZE"))
    return 0.0


def _limit(kind: int) -> float:
    """A limit of this process, 0 for none."""
    limit, _ = resource.getrlimit(kind)
    return 0.0 if limit == resource.RLIM_INFINITY else float(limit)


def _is_of_memory(error: BaseException) -> bool:
    if isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return True
    if isinstance(error, SystemError) and _limit(resource.RLIMIT_AS):
        # Python could not even make the exception.
        return True
    text = str(error)
    # Of the loader of shared libraries, and of Python's threads.
    return (isinstance(error, ImportError | OSError) and "failed to map segment" in text) or (
        isinstance(error, RuntimeError) and "can't start new thread" in text
    )
