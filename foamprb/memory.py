"""Memory: available amount, and the message on exhaustion."""

from __future__ import annotations

import ctypes
import errno
import math
import mmap
import os
import resource
from contextlib import suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray

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


def sparse_zeros(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """Return zeros that take memory only where they are written."""
    # Texts and declarations, which read the rest of this module, need no numpy.
    import numpy as np

    size = math.prod(shape) * np.dtype(dtype).itemsize
    if size == 0:
        return np.zeros(shape, dtype)
    pages = mmap.mmap(-1, size, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    with suppress(OSError, AttributeError):
        # A huge page would take 2 MB at once.
        pages.madvise(mmap.MADV_NOHUGEPAGE)
    return np.frombuffer(pages, dtype).reshape(shape)


def clear(rows: NDArray[Any]) -> None:
    """Set consecutive rows to zero; those of :func:`sparse_zeros` free their memory."""
    import numpy as np

    base: Any = rows
    while isinstance(base, np.ndarray):
        base = base.base
    flat, pages = rows.reshape(-1).view(np.uint8), getattr(base, "obj", None)
    if isinstance(pages, mmap.mmap) and hasattr(mmap, "MADV_DONTNEED"):
        offset = _address(rows) - _address(np.frombuffer(pages, np.uint8))
        begin = -(-offset // mmap.PAGESIZE) * mmap.PAGESIZE
        end = (offset + len(flat)) // mmap.PAGESIZE * mmap.PAGESIZE
        if begin < end:
            pages.madvise(mmap.MADV_DONTNEED, begin, end - begin)
            flat[: begin - offset] = flat[end - offset :] = 0
            return
    flat[:] = 0


def _address(array: NDArray[Any]) -> int:
    address: int = array.__array_interface__["data"][0]
    return address


def trim() -> None:
    """Return free memory of this process to the system, which the C library would keep."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)
