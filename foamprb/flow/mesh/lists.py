"""Lists of lists as two arrays: the start of each list, and the entries of all lists."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Ints

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


def cell_types(grid: Any) -> NDArray[np.uint8]:
    """Return VTK's type number of each cell of a vtkUnstructuredGrid."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if grid.GetNumberOfCells() == 0:
        return np.empty(0, dtype=np.uint8)
    return np.ascontiguousarray(vtk_to_numpy(grid.GetCellTypes()), dtype=np.uint8)


def int32(values: NDArray[Any]) -> Ints:
    """Return the values as a contiguous array of 32-bit integers."""
    return np.ascontiguousarray(values, dtype=np.int32)
