"""Arrays in memory that all processes of a computer share, by MPI's shared windows."""

from __future__ import annotations

import os
import pickle
import time
from collections.abc import Callable
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import RunStopped

if TYPE_CHECKING:
    from mpi4py.MPI import Comm

Array = NDArray[Any]

NODE_RANKS = "FOAMPRB_NODE_RANKS"
"""Environment variable with the number of processes of a node; by default all of a computer."""
_LONGEST_PAUSE = 1e-3
"""Longest pause between two tests of a barrier, s."""
_SMALLEST = 1 << 16
"""Bytes from which an array is worth a window."""
_MOST_AT_ONCE = 1 << 30
"""Bytes sent at once: their number is a 32-bit integer to MPI."""


class Place(NamedTuple):
    """Stands for an array in shared memory where the array itself would be."""

    key: int
    shape: tuple[int, ...]


class Windows:
    """The shared arrays of a process: on each computer there is one of each.

    All processes make, fill and free arrays together, in the same order.

    Parameters
    ----------
    MPI
        The module ``mpi4py.MPI``.
    comm
        All processes; the first fills the arrays.
    """

    def __init__(self, MPI: ModuleType, comm: Comm) -> None:
        self._MPI = MPI
        few = int(os.environ.get(NODE_RANKS, "0"))
        self.node = comm.Split(comm.rank // few, comm.rank) if few else comm.Split_type(MPI.COMM_TYPE_SHARED)
        # The first process of each computer; rank 0 is the first of these.
        first = self.node.rank == 0
        self.leaders = comm.Split(0 if first else MPI.UNDEFINED)
        self.nodes: int = comm.allreduce(int(first))
        self.arrays: dict[int, Array] = {}
        self._windows: dict[int, Any] = {}

    def make(self, key: int, shape: tuple[int, ...], dtype: str) -> None:
        """Make an array.

        Raises
        ------
        RunStopped
            If the computer has not so much memory to share.
        """
        size = int(np.prod(shape)) * np.dtype(dtype).itemsize
        try:
            window = self._MPI.Win.Allocate_shared(size if self.node.rank == 0 else 0, 1, comm=self.node)
        except self._MPI.Exception as error:
            where = self._MPI.Get_processor_name()
            raise RunStopped(
                f"{size / 1e6:.0f} MB of memory could not be shared on {where}: {error}."
            ) from error
        window.Lock_all(self._MPI.MODE_NOCHECK)
        memory, _ = window.Shared_query(0)
        self._windows[key] = window
        self.arrays[key] = np.ndarray(shape, dtype, buffer=memory)

    def spread(self, key: int) -> None:
        """Copy an array from the first process to all computers."""
        self._windows[key].Sync()
        if self.leaders != self._MPI.COMM_NULL:
            flat = self.arrays[key].reshape(-1).view(np.uint8)
            for start in range(0, len(flat), _MOST_AT_ONCE):
                self.leaders.Bcast(flat[start : start + _MOST_AT_ONCE], root=0)
        self.node.Barrier()
        self._windows[key].Sync()

    def sync(self, key: int) -> None:
        """Separate earlier writes to an array from later reads, on both sides of a barrier."""
        self._windows[key].Sync()

    def free(self, key: int) -> None:
        """Free a window; later reads are invalid."""
        del self.arrays[key]
        window = self._windows.pop(key)
        window.Unlock_all()
        window.Free()

    def find(self, tree: object) -> Any:
        """Replace each :class:`Place` in a tree by this rank's array."""

        def array(leaf: object) -> Any:
            if not isinstance(leaf, Place):
                return leaf
            self.sync(leaf.key)
            return self.arrays[leaf.key].reshape(leaf.shape)

        return _map(tree, array)


class Publisher:
    """Publisher of arrays, on the first process, into the windows of all.

    Parameters
    ----------
    windows
        The windows of the first process.
    order
        Lets all processes call a method of their windows, by its name and arguments.
    """

    def __init__(self, windows: Windows, order: Callable[..., Any]) -> None:
        self._windows, self._order = windows, order
        self._next = 0
        self._sources: dict[int, Array] = {}
        """Arrays from which the windows were filled."""
        self._own: dict[tuple[int, int], int] = {}
        """Windows that take the place of their sources, by their addresses and bytes."""
        self._small = b""

    @property
    def size(self) -> int:
        """Bytes shared on each computer."""
        return sum(array.nbytes for array in self._windows.arrays.values())

    def move(self, array: Array) -> Array:
        """Put an array into shared memory for good; return it there."""
        if not _is_large(array):
            return array
        key = self._fill_new(array)
        moved = self._windows.arrays[key]
        self._own[_extent(moved)] = key
        return moved

    def publish(self, tree: object) -> Any:
        """Make the arrays in a tuple known to all processes; those of the call before are forgotten.

        What :meth:`foamprb.flow.base.Flow.arrays` says of arrays that change is relied upon.

        Returns
        -------
        The tuple with a :class:`Place` for each large array.
        """
        used: set[int] = set()
        small = pickle.dumps(_map(tree, lambda leaf: None if _is_large(leaf) else leaf))
        changed, self._small = small != self._small, small

        def place(leaf: Any) -> Any:
            if not _is_large(leaf):
                return leaf
            key = self._own.get(_extent(leaf))
            if key is None:
                key = self._update(leaf, changed)
                used.add(key)
            else:
                self._windows.sync(key)
            return Place(key, leaf.shape)

        placed = _map(tree, place)
        for key in set(self._sources) - used:
            del self._sources[key]
            self._order("free", key)
        return placed

    def _update(self, array: Array, changed: bool) -> int:
        for key, source in self._sources.items():
            if _where(source) == _where(array):
                shared = self._windows.arrays[key]
                if changed and not np.array_equal(shared.view(np.uint8), array.view(np.uint8)):
                    shared[...] = array
                    self._order("spread", key)
                return key
        key = self._fill_new(array)
        self._sources[key] = array
        return key

    def _fill_new(self, array: Array) -> int:
        key, self._next = self._next, self._next + 1
        self._order("make", key, array.shape, array.dtype.str)
        self._windows.arrays[key][...] = array
        self._order("spread", key)
        return key


def wait_for_all(comm: Comm) -> None:
    """Wait for all processes with short pauses; MPI itself would keep the processor busy."""
    request, pause = comm.Ibarrier(), 1e-6
    while not request.Test():
        time.sleep(pause)
        pause = min(2.0 * pause, _LONGEST_PAUSE)


def _is_large(leaf: object) -> bool:
    return isinstance(leaf, np.ndarray) and leaf.nbytes >= _SMALLEST


def _extent(array: Array) -> tuple[int, int]:
    return array.__array_interface__["data"][0], array.nbytes


def _where(array: Array) -> tuple[int, tuple[int, ...], str]:
    return array.__array_interface__["data"][0], array.shape, array.dtype.str


def _map(tree: object, function: Callable[[Any], Any]) -> Any:
    """Apply a function to the leaves of nested named tuples."""
    if isinstance(tree, tuple) and hasattr(tree, "_fields") and not isinstance(tree, Place):
        return type(tree)(*(_map(item, function) for item in tree))
    return function(tree)
