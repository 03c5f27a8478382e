"""Lists of lists as two arrays: where each list begins, and the entries of all, one list after the other."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Ints

Index: TypeAlias = NDArray[np.intp]
Labels: TypeAlias = NDArray[np.integer[Any]]
Mask: TypeAlias = NDArray[np.bool_]

MOST_INDICES = int(np.iinfo(np.int32).max)
"""As many entries as 32-bit numbers can count."""


def starts(counts: Labels) -> Index:
    """Where each of n lists begins, and where the last ends, (n + 1,), from their lengths."""
    start = np.zeros(len(counts) + 1, dtype=np.intp)
    np.cumsum(counts, out=start[1:])
    return start


def ragged(start: Labels, counts: Labels) -> Index:
    """Concatenation of start[i], start[i] + 1, …, start[i] + counts[i] − 1."""
    begin = starts(counts)
    return np.arange(begin[-1]) + np.repeat(start - begin[:-1], counts)


def take_lists(start: Labels, lists: Labels, at: Index) -> tuple[Index, Labels]:
    """Some of the lists, by number: where they begin, and their entries."""
    counts = np.diff(start)[at]
    return starts(counts), lists[ragged(start[at], counts)]


def cell_array(cells: Any) -> tuple[Index, Index]:
    """Offsets and connectivity of a vtkCellArray."""
    if cells is None or cells.GetNumberOfCells() == 0:
        return np.zeros(1, dtype=np.intp), np.empty(0, dtype=np.intp)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    start = vtk_to_numpy(cells.GetOffsetsArray()).astype(np.intp, copy=False)
    return start, vtk_to_numpy(cells.GetConnectivityArray()).astype(np.intp, copy=False)


def points_of(data: Any) -> NDArray[np.floating[Any]]:
    """Points of a vtkPointSet, (n, 3), m, of the type that it holds."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if data.GetNumberOfPoints() == 0:
        return np.empty((0, 3))
    points: NDArray[np.floating[Any]] = vtk_to_numpy(data.GetPoints().GetData())
    return points


def cell_types(grid: Any) -> NDArray[np.uint8]:
    """VTK's type number of each cell of a vtkUnstructuredGrid."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if grid.GetNumberOfCells() == 0:
        return np.empty(0, dtype=np.uint8)
    return np.ascontiguousarray(vtk_to_numpy(grid.GetCellTypes()), dtype=np.uint8)


def int32(values: NDArray[Any]) -> Ints:
    """The values as 32-bit integers, one after the other in memory."""
    return np.ascontiguousarray(values, dtype=np.int32)
