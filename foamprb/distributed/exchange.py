"""Exchange of particles between ranks: the rows that each sends, and how many should go where."""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.communicator import Share
from foamprb.cloud.layout import LANES

if TYPE_CHECKING:
    from mpi4py.MPI import Comm

Rows = NDArray[np.int64]

UNEVEN = 1.1
"""How much longer than with even shares a step may take before particles change hands."""
_ROWS = 1 << 16
"""Most rows that a process sends at once."""
_AT_ONCE = 1 << 22
"""Most rows that all processes send together, and so one of them receives at once."""
_FIRST = 1000
"""Rows that are looked at first."""


def with_others(share: Share, rows: Rows, others: Share) -> Share:
    """Return particles with others in place of some rising rows, perhaps in other rows.

    They are in the same memory as far as it suffices.
    """
    n = len(share.particles.number) - len(rows) + len(others.particles.number)
    before, new = share.arrays(), others.arrays()
    return Share.of({name: _replaced(array, rows, new[name], n) for name, array in before.items()})


def _replaced(array: NDArray[np.generic], rows: Rows, others: NDArray[np.generic], n: int) -> NDArray[Any]:
    """Replace rows of an array by others; fill gaps with the last rows (swap-remove), to n rows."""
    # An array of zeros takes no memory of the machine until its rows are written.
    written, both = has_bits(others), min(len(rows), len(others))
    if written or has_bits(array[rows[:both]]):
        array[rows[:both]] = others[:both]
    if n < len(array):
        free = rows[both:]
        last = np.setdiff1d(np.arange(n, len(array)), free, assume_unique=True)
        moved = array[last]
        if has_bits(moved) or has_bits(array[free]):
            array[free[: len(last)]] = moved
        return array[:n]
    if n > len(array):
        before, array = len(array), _with_room(array, n)
        if written or has_bits(array[before:]):
            array[before:] = others[both:]
    return array


def _with_room(array: NDArray[np.generic], n: int) -> NDArray[Any]:
    """Extend an array to n rows, in its memory if that suffices."""
    memory = array if array.base is None else array.base
    if (
        isinstance(memory, np.ndarray)
        and (memory.dtype, memory.shape[1:]) == (array.dtype, array.shape[1:])
        and memory.ctypes.data == array.ctypes.data
        and len(memory) >= n
    ):
        return memory[:n]
    larger = np.zeros((n + n // _ROOM, *array.shape[1:]), array.dtype)
    if has_bits(array):
        larger[: len(array)] = array
    return larger[:n]


_ROOM = 8
"""A share that grows has room for a part of its particles more: pages that are not written take no memory."""


def pack(share: Share, rows: Rows) -> NDArray[Any]:
    """Return records of the particles in some rows."""
    arrays = share.arrays()
    layout = [(name, array.dtype, array.shape[1:]) for name, array in arrays.items()]
    records = np.empty(len(rows), dtype=layout)
    for name, array in arrays.items():
        records[name] = array[rows]
    return records


def unpack(records: NDArray[Any]) -> Share:
    """Return the particles of records."""
    return Share.of({name: records[name].copy() for name in records.dtype.names or ()})


def firsts_of(n: int, size: int) -> NDArray[np.int64]:
    """Return the number of the first particle that each rank writes to checkpoints, and n, (size + 1,).

    A rank writes particles of consecutive numbers.
    """
    # Rounded up, so that the first process has some if there are any.
    return -(-np.arange(size + 1, dtype=np.int64) * n // size)


def plan_exchange(active: Sequence[int]) -> NDArray[np.int64] | None:
    """Return the exchange after which all have as many active particles; None if it does not pay.

    The processes wait for the one with most blocks of particles. A block takes the same time full or not.

    Parameters
    ----------
    active
        Number of active particles of each of n processes.

    Returns
    -------
    The number that process i gives to process j, (n, n).
    """
    n, total = len(active), sum(active)
    even = np.diff(np.arange(n + 1) * total // n)
    if -(-max(active) // LANES) <= UNEVEN * -(-int(even.max()) // LANES):
        return None
    plan = np.zeros((n, n), dtype=np.int64)
    surplus = np.asarray(active) - even
    givers, takers = np.flatnonzero(surplus > 0), np.flatnonzero(surplus < 0)
    # Surplus and deficit as rows of particles: each surplus particle goes to the deficit at the same index.
    giver = np.repeat(givers, surplus[givers])
    taker = np.repeat(takers, -surplus[takers])
    np.add.at(plan, (giver, taker), 1)
    return plan


class Route:
    """Way of the rows of a process to others, for arrays of as many rows.

    All processes make a route, and send arrays of the same names and types, together.

    Parameters
    ----------
    MPI
        The module ``mpi4py.MPI``.
    comm
        The processes.
    to
        Process to which each row goes, (n,).
    """

    def __init__(self, MPI: ModuleType, comm: Comm, to: NDArray[np.int64]) -> None:
        self._MPI, self._comm = MPI, comm
        most = max(1, min(_ROWS, _AT_ONCE // comm.size))
        self._rounds: list[tuple[Any, NDArray[np.int64], NDArray[np.int64]]] = []
        for k in range(max(1, comm.allreduce(-(-len(to) // most), MPI.MAX))):
            some = to[k * most : (k + 1) * most]
            sent = np.bincount(some, minlength=comm.size).astype(np.int64)
            received = np.empty_like(sent)
            comm.Alltoall(sent, received)
            self._rounds.append((_sorted_rows(some, k * most), sent, received))
        self.size = sum(int(received.sum()) for _, _, received in self._rounds)
        """Number of rows that arrive."""

    def send(self, array: NDArray[np.generic]) -> NDArray[Any]:
        """Send an array; return the rows that arrive, in the same order for every array.

        If no process has anything but bits that are 0, nothing is sent.
        """
        if not self._comm.allreduce(has_bits(array), self._MPI.LOR):
            return np.zeros((self.size, *array.shape[1:]), array.dtype)
        arrived = np.empty((self.size, *array.shape[1:]), array.dtype)
        row = self._MPI.BYTE.Create_contiguous(array.dtype.itemsize * math.prod(array.shape[1:])).Commit()
        start = 0
        for rows, sent, received in self._rounds:
            end = start + int(received.sum())
            self._comm.Alltoallv(
                [array[rows], (sent, _starts(sent)), row],
                [arrived[start:end], (received, _starts(received)), row],
            )
            start = end
        row.Free()
        return arrived


def _sorted_rows(to: NDArray[np.int64], first: int) -> NDArray[np.int64] | slice:
    """Return rows from a first one on in the order of the processes to which they go."""
    if (to[1:] >= to[:-1]).all():
        return slice(first, first + len(to))
    return first + np.argsort(to, kind="stable")


def has_bits(array: NDArray[np.generic]) -> bool:
    """Return whether any bit of a contiguous array is 1."""
    # Most arrays that have some have one early.
    return any(bool(part.reshape(-1).view(np.uint8).any()) for part in (array[:_FIRST], array))


def _starts(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.cumsum(counts) - counts
