"""Way of the rows of arrays from each process to others."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

_ROWS = 1 << 16
"""Most rows that a process sends at once."""
_AT_ONCE = 1 << 22
"""Most rows that all processes send together, and so one of them receives at once."""
_FIRST = 1000
"""Rows that are looked at first."""


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

    def __init__(self, MPI: Any, comm: Any, to: NDArray[np.int64]) -> None:
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

    def send(self, array: NDArray[Any]) -> NDArray[Any]:
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


def has_bits(array: NDArray[Any]) -> bool:
    """Return whether any bit of a contiguous array is 1."""
    # Most arrays that have some have one early.
    return any(bool(part.reshape(-1).view(np.uint8).any()) for part in (array[:_FIRST], array))


def _starts(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.cumsum(counts) - counts
