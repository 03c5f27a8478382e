"""Least-squares gradients at cell centres."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from foamprb.body import tensor
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.lists import Index, Mask
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.stencils import group, sum_differences

# The six second derivatives: pairs of directions.
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
PAIR_OF = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])
# Cells handled at once: the temporary arrays then stay in the cache.
CHUNK = 1 << 15


class LeastSquaresGradient:
    """Least-squares gradient at cell centres, differences weighted by the inverse square of the distance.

    Where the neighbours and boundary values of a cell say nothing about a direction, its neighbours'
    neighbours count as well. If they say nothing either, as on a mesh one cell thick, the gradient in this
    direction is zero.

    Parameters
    ----------
    mesh
        The mesh.
    sites
        Places with values, (n_sites, 3), m; the cell centres first.
    faces, numbers
        Boundary faces (n,), and for each the number of the site beyond it.
    least
        A direction counts as open if its eigenvalue of the normal equations is below this share of the
        largest.
    """

    def __init__(self, mesh: Mesh, sites: Floats, faces: Index, numbers: Ints, least: float = 1e-6) -> None:
        n = mesh.n_cells
        inner, neighbour = mesh.owner[: mesh.n_internal], mesh.neighbour
        self._n, self._sites, self._kernel = n, sites, link(sum_differences)
        self._around = grouped(
            np.concatenate([inner, neighbour, mesh.owner[mesh.n_internal + faces]]),
            np.concatenate([neighbour, inner, numbers]),
            n,
        )
        open_cells = np.concatenate(
            [low + np.flatnonzero(_nearly_singular(matrix, least)) for low, matrix in self._matrices()]
        )
        if len(open_cells):
            start, columns = self._around
            more = _second_neighbours(inner, neighbour, n, open_cells)
            rows = np.repeat(np.arange(n), np.diff(start))
            self._around = grouped(np.concatenate([rows, more[0]]), np.concatenate([columns, more[1]]), n)
        # Six components of each, as it is symmetric.
        self._inverse = np.empty((n, 6))
        for low, matrix in self._matrices():
            inverse = invert(matrix, least)
            for pair, (j, k) in enumerate(PAIRS):
                self._inverse[low : low + len(matrix), pair] = inverse[:, j, k]

    def _matrices(self) -> Iterator[tuple[int, Floats]]:
        """Chunk by chunk, the first cell and the matrices Σ e ⊗ e (n, 3, 3) of the normal equations."""
        for low in range(0, self._n, CHUNK):
            matrix = np.empty((min(CHUNK, self._n - low), 3, 3))
            self._sums(self._sites, matrix, low)
            yield low, matrix

    def __call__(self, values: Floats, gradients: Floats, low: int = 0, bends: Floats | None = None) -> None:
        """Put the gradients of m fields at n cells from ``low`` on into ``gradients`` (n, m, 3).

        They come from the values (n_sites, m) at the sites, less what the second derivatives ``bends``
        (n_cells, m, 6) add to them.
        """
        self._sums(values, gradients, low, bends)
        for first in range(0, len(gradients), CHUNK):
            part = gradients[first : first + CHUNK]
            part[:] = part @ self._inverse[low + first : low + first + len(part)][:, PAIR_OF]

    def _sums(self, values: Floats, sums: Floats, low: int = 0, bends: Floats | None = None) -> None:
        """The right side (n, m, 3) of the normal equations."""
        if bends is None:
            bends = np.empty((0, values.shape[1], 6))
        sums[:] = 0.0
        self._kernel(self._sites, *self._around, values, bends, low, sums)


def grouped(rows: NDArray[Any], columns: NDArray[Any], n: int) -> tuple[Ints, Ints]:
    """Sort pairs of row and column by row: where each of n rows begins, and the columns, in their order."""
    start, sorted_columns = np.zeros(n + 1, dtype=np.int32), np.empty(len(columns), dtype=np.int32)
    link(group)(
        rows.astype(np.int32, copy=False), columns.astype(np.int32, copy=False), start, sorted_columns
    )
    return start, sorted_columns


def _second_neighbours(owner: Ints, neighbour: Ints, n: int, cells: Index) -> tuple[Index, Index]:
    """The given cells, each beside the neighbours of its neighbours (not itself, nor its neighbours)."""
    ones = np.ones(2 * len(owner), dtype=np.int32)
    ends = (np.concatenate([owner, neighbour]), np.concatenate([neighbour, owner]))
    adjacent = sparse.csr_array((ones, ends), shape=(n, n))
    second = sparse.coo_array(adjacent[cells] @ adjacent)
    near = sparse.csr_array(adjacent[cells]).tocoo()
    rows, columns = cells[second.row], second.col.astype(np.intp)
    known = np.isin(rows * n + columns, np.concatenate([cells[near.row] * n + near.col, cells * (n + 1)]))
    return rows[~known], columns[~known]


def _nearly_singular(matrix: Floats, least: float) -> Mask:
    """Which of the matrices (n, 3, 3) have their smallest eigenvalue below ``least`` of the largest."""
    T = _components(matrix)
    suspect: Mask = tensor.det(T) <= 27.0 * least * (tensor.trace(T) / 3.0) ** 3
    # With eigenvalues λ₁ ≥ λ₂ ≥ λ₃, det ≤ λ₃ λ₁² and λ₁ ≤ 3·(trace/3): no λ₃ < least·λ₁ goes unsuspected.
    values = np.linalg.eigvalsh(matrix[suspect])
    suspect[suspect] = values[:, 0] <= least * values[:, 2]
    return suspect


def invert(matrix: Floats, least: float) -> Floats:
    """Inverses of symmetric positive semidefinite (n, 3, 3), pseudo-inverses of nearly singular ones."""
    poor = _nearly_singular(matrix, least)
    safe = np.where(poor[:, None, None], np.eye(3), matrix)
    result = np.stack(tensor.inverse(_components(safe)), axis=1).reshape(-1, 3, 3)
    values, vectors = np.linalg.eigh(matrix[poor])
    used = values > least * values[:, -1:]
    scaled = np.where(used, 1.0 / np.where(used, values, 1.0), 0.0)
    result[poor] = np.einsum("nij,nj,nkj->nik", vectors, scaled, vectors)
    return result


def _components(matrix: Floats) -> tensor.Tensor:
    """The nine columns of matrices (n, 3, 3)."""
    T = matrix.reshape(-1, 9).T
    return T[0], T[1], T[2], T[3], T[4], T[5], T[6], T[7], T[8]
