"""How well a mesh resolves the gradient that deforms bodies: jumps of ∇u between cells, and roughness."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from foamprb.compile.link import compiled
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.lists import Mask

_DECADES, _PER_DECADE = (-6.0, 1.0), 50
_BINS = int((_DECADES[1] - _DECADES[0]) * _PER_DECADE)
_AT_ONCE = 1 << 16
_FEW, _ENOUGH = 0.05, 20_000
"""Share of the cells up to which those of one kind do not count, and number of cells of a median."""
NO_JUMPS: NDArray[np.int64] = np.zeros((2, _BINS), dtype=np.int64)
"""Counts of a flow without cells."""


def count_jumps(l: Floats, first: Ints, second: Ints, at_walls: Mask) -> NDArray[np.int64]:
    """Count faces by the difference of ∇u in their two cells over the mean of its norms, (2, bins).

    The first row has all faces, the second those of a cell at a wall. Bins are logarithmic.

    Parameters
    ----------
    l
        (n_cells, 9) gradients, 1/s.
    first, second
        (n,) the cells of each face.
    at_walls
        (n_cells,) cells with a face on a wall.
    """
    counts, norms = NO_JUMPS.copy(), _norms(l)
    for k in range(0, len(first), _AT_ONCE):
        a, b = first[k : k + _AT_ONCE], second[k : k + _AT_ONCE]
        ratios = 2.0 * _norms(l[a] - l[b]) / np.maximum(norms[a] + norms[b], 1e-300)
        bins = np.floor((np.log10(np.maximum(ratios, 1e-300)) - _DECADES[0]) * _PER_DECADE)
        bins = np.clip(bins, 0, _BINS - 1).astype(np.intp)
        counts[0] += np.bincount(bins, minlength=_BINS)
        counts[1] += np.bincount(bins[at_walls[a] | at_walls[b]], minlength=_BINS)
    return counts


def relative_jumps(l: Floats, first: Ints, second: Ints) -> Floats:
    """Return the mean difference of ∇u in each cell from its neighbours over its norm, at most 1, (n_cells,).

    Parameters
    ----------
    l, first, second
        As in :func:`count_jumps`, of all faces between two cells.
    """
    n, norms = len(l), _norms(l)
    total, faces = np.zeros(n), np.zeros(n)
    for k in range(0, len(first), _AT_ONCE):
        a, b = first[k : k + _AT_ONCE], second[k : k + _AT_ONCE]
        jump = _norms(l[a] - l[b])
        for cells in (a, b):
            total += np.bincount(cells, jump, n)
            faces += np.bincount(cells, minlength=n)
    return np.minimum(total / np.maximum(faces * norms, 1e-300), 1.0)


def roughness(l: Floats, start: Ints, points: Ints, least: float) -> float:
    """Return the relative difference of ∇u at the centres of cells from the mean at their points, a median.

    It is of second order in the width of cells, as the error of interpolation is, and about as large as the
    relative error of the strain by the mesh. Of tetrahedra and other cells it is the smaller value, if at
    least a twentieth of the cells are of this kind, and it is at most 1. Of a large mesh it is that of some
    cells, evenly spread over their numbers.

    Parameters
    ----------
    l
        (n_nodes, 9) gradients at the mesh points, then at the cell centres, 1/s.
    start, points
        Points of each cell, as ``cell_point_start`` and ``cell_points`` of a mesh.
    least
        Smallest |∇u| to which a difference is related, 1/s.
    """
    n = len(start) - 1
    some = np.arange(0, n, max(1, n // _ENOUGH))
    ratios = np.empty(len(some))
    compiled(_off_centre)(l, start, points, some, least + 1e-300, ratios)
    tetrahedral = np.diff(start)[some] == 4
    kinds = (ratios[tetrahedral], ratios[~tetrahedral])
    return min(1.0, *(float(np.median(r)) for r in kinds if len(r) > _FEW * len(some)))


def _off_centre(l: Floats, start: Ints, points: Ints, some: Ints, least: float, ratios: Floats) -> None:
    """Store |∇u − mean|/|mean| of some cells: at their centres, and the mean over their points."""
    n = len(start) - 1
    for k, cell in enumerate(some):
        square, difference = 0.0, 0.0
        for c in range(9):
            mean = 0.0
            for j in range(start[cell], start[cell + 1]):
                mean += l[points[j], c]
            mean /= start[cell + 1] - start[cell]
            square += mean * mean
            difference += (l[len(l) - n + cell, c] - mean) ** 2
        ratios[k] = math.sqrt(difference) / max(math.sqrt(square), least)


def _norms(rows: Floats) -> Floats:
    norms: Floats = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    return norms


def medians(counts: NDArray[np.int64]) -> tuple[float, float]:
    """Return the median jumps of all faces and of those at walls, to 2 %; NaN of no faces."""
    results = []
    for row in counts:
        half = int(np.searchsorted(np.cumsum(row), 0.5 * row.sum()))
        results.append(10.0 ** (_DECADES[0] + (half + 0.5) / _PER_DECADE) if row.any() else np.nan)
    return results[0], results[1]
