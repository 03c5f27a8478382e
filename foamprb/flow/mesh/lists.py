"""Lists of lists as two arrays: the start of each list, and the entries of all lists."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Ints

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

Index: TypeAlias = NDArray[np.intp]
Labels: TypeAlias = NDArray[np.integer[Any]]
Mask: TypeAlias = NDArray[np.bool_]

MOST_INDICES = int(np.iinfo(np.int32).max)
"""Largest number of entries with 32-bit indices."""


def starts(counts: Labels) -> Index:
    """Return the start of each of n lists and the end of the last, (n + 1,), from their lengths."""
    start = np.zeros(len(counts) + 1, dtype=np.intp)
    np.cumsum(counts, out=start[1:])
    return start


def ragged(start: Labels, counts: Labels) -> Index:
    """Concatenate start[i], start[i] + 1, …, start[i] + counts[i] − 1."""
    begin = starts(counts)
    return np.arange(begin[-1]) + np.repeat(start - begin[:-1], counts)


def take_lists(start: Labels, lists: Labels, at: Index) -> tuple[Index, Labels]:
    """Return the starts and the entries of the lists ``at``."""
    counts = np.diff(start)[at]
    return starts(counts), lists[ragged(start[at], counts)]


def cell_array(cells: Any) -> tuple[Index, Index]:
    """Return offsets and connectivity of a vtkCellArray."""
    if cells is None or cells.GetNumberOfCells() == 0:
        return np.zeros(1, dtype=np.intp), np.empty(0, dtype=np.intp)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    start = vtk_to_numpy(cells.GetOffsetsArray()).astype(np.intp, copy=False)
    return start, vtk_to_numpy(cells.GetConnectivityArray()).astype(np.intp, copy=False)


def points_of(data: Any) -> NDArray[np.floating[Any]]:
    """Return the points of a vtkPointSet, (n, 3), m, in its own type."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if data.GetNumberOfPoints() == 0:
        return np.empty((0, 3))
    points: NDArray[np.floating[Any]] = vtk_to_numpy(data.GetPoints().GetData())
    return points


def cell_types(grid: vtkUnstructuredGrid) -> NDArray[np.uint8]:
    """Return VTK's type number of each cell of a vtkUnstructuredGrid."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if grid.GetNumberOfCells() == 0:
        return np.empty(0, dtype=np.uint8)
    return np.ascontiguousarray(vtk_to_numpy(grid.GetCellTypes()), dtype=np.uint8)


_LEAST_SHARE = 10_000
_MOST_THREADS = 8


def together(*calls: Callable[[], Any]) -> list[Any]:
    """Return the results of calls that run at the same time, in threads."""
    with threads(len(calls)) as run:
        return run(*calls)


@contextmanager
def threads(n: int) -> Iterator[Callable[..., list[Any]]]:
    """Yield a function like :func:`together` that starts its n threads only once."""
    if n <= 1 or len(os.sched_getaffinity(0)) == 1:
        yield lambda *calls: [call() for call in calls]
        return
    with ThreadPoolExecutor(n) as pool:
        yield lambda *calls: list(pool.map(lambda call: call(), calls))


def share(n: int, part: Callable[[int, int], Any]) -> list[Any]:
    """Return the results of ``part(begin, end)`` for parts of 0 to n, computed at the same time."""
    count = max(1, min(len(os.sched_getaffinity(0)), _MOST_THREADS, n // _LEAST_SHARE))
    ends = [n * k // count for k in range(count + 1)]
    return together(*(partial(part, begin, end) for begin, end in pairwise(ends)))


def int32(values: NDArray[np.generic]) -> Ints:
    """Return the values as a contiguous array of 32-bit integers."""
    return np.ascontiguousarray(values, dtype=np.int32)
