"""Least-squares gradients at cell centres, and means of Taylor series at points.

Sites are places with values, the cell centres first, so that the row of a cell is also its site. The sites
around row r are ``columns[start[r]]`` to ``columns[start[r + 1] - 1]``, int32. Second derivatives stand in
the order xx, yy, zz, xy, xz, yz.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body import tensor
from foamprb.body.tensor import Vector, inner, norm
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import arm, point
from foamprb.flow.mesh.lists import Index, Mask, share
from foamprb.flow.mesh.mesh import Mesh

# Directions of the six second derivatives.
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
PAIR_OF = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])
# Number of cells per chunk: the temporary arrays then stay in the cache.
CHUNK = 1 << 15


def in_chunks(n: int, part: Callable[[int, int], Any]) -> None:
    """Call ``part(begin, end)`` for chunks of 0 to n, in threads."""

    def run(begin: int, end: int) -> None:
        for low in range(begin, end, CHUNK):
            part(low, min(low + CHUNK, end))

    share(n, run)


class LeastSquaresGradient:
    """Least-squares gradient at cell centres, differences weighted by the inverse square of the distance.

    Along directions in which a cell has no sites around it, as on a mesh one cell thick, it is zero.

    Parameters
    ----------
    sites
        Places with values, (n_sites, 3), m; the cell centres first.
    around
        Start of each cell's sites around it, (n + 1,), and these sites.
    least
        A direction is open if its eigenvalue of the normal equations is below this fraction of the largest.
    """

    def __init__(self, sites: Floats, around: tuple[Ints, Ints], least: float = 1e-6) -> None:
        self._n, self._sites, self._kernel = len(around[0]) - 1, sites, link(sum_differences)
        self._around = around
        self._inverse, open_ = np.empty((self._n, 6)), np.empty(self._n, dtype=bool)

        def part(low: int, high: int) -> None:
            # The matrices Σ e ⊗ e of the normal equations.
            matrix = np.empty((high - low, 3, 3))
            self._sum(sites, np.empty((0, 3, 6)), low, matrix)
            inverse, open_[low:high] = invert(matrix, least)
            for pair, (j, k) in enumerate(PAIRS):
                self._inverse[low:high, pair] = inverse[:, j, k]

        in_chunks(self._n, part)
        self.open = np.flatnonzero(open_)
        """Cells with a direction in which the gradient is zero."""

    @classmethod
    def over_faces(
        cls, mesh: Mesh, sites: Floats, faces: Index, numbers: Ints, least: float = 1e-6
    ) -> LeastSquaresGradient:
        """Return the gradient from the sites across the faces of the cells.

        Where these leave a direction of a cell open, its neighbours' neighbours are used as well.

        Parameters
        ----------
        faces, numbers
            Boundary faces (n,), and the index of the site beyond each.
        """
        n, inner, neighbour = mesh.n_cells, mesh.owner[: mesh.n_internal], mesh.neighbour
        beyond = np.full(len(mesh.owner) - mesh.n_internal, -1, dtype=np.int32)
        beyond[faces] = numbers
        around = np.empty(n + 1, dtype=np.int32), np.empty(len(mesh.cell_faces), dtype=np.int32)
        of_cells = mesh.cell_face_start, mesh.cell_faces
        end = link(list_around)(*of_cells, mesh.owner, neighbour, beyond, *around)
        around = around[0], around[1][:end]
        gradient = cls(sites, around, least)
        if len(gradient.open) == 0:
            return gradient
        more = _second_neighbours(inner, neighbour, n, gradient.open)
        rows = np.repeat(np.arange(n), np.diff(around[0]))
        return cls(
            sites, grouped(np.concatenate([rows, more[0]]), np.concatenate([around[1], more[1]]), n), least
        )

    def __call__(self, values: Floats, gradients: Floats, bends: Floats | None = None) -> None:
        """Write the gradients of m fields at the cells into ``gradients`` (n_cells, m, 3).

        ``values`` (n_sites, m) are those at the sites; the contribution of the second derivatives ``bends``
        (n_cells, m, 6) is subtracted from their differences.
        """
        given, turn = np.empty((0, values.shape[1], 6)) if bends is None else bends, link(turn_rows)

        def part(low: int, high: int) -> None:
            self._sum(values, given, low, gradients[low:high])
            turn(self._inverse[low:high], gradients[low:high])

        in_chunks(self._n, part)

    def bends(self, l: Floats, h: Floats) -> None:
        """Write the second derivatives (n_cells, 3, 6) from gradients at the sites (n_sites, 3, 3)."""
        values, nothing = l.reshape(-1, 9), np.empty((0, 9, 6))
        turn, make_symmetric = link(turn_rows), link(symmetrise)

        def part(low: int, high: int) -> None:
            second = np.empty((high - low, 9, 3))
            self._sum(values, nothing, low, second)
            turn(self._inverse[low:high], second)
            make_symmetric(second, h[low:high])

        in_chunks(self._n, part)

    def _sum(self, values: Floats, bends: Floats, low: int, sums: Floats) -> None:
        """Write the right side (n, m, 3) of the normal equations into ``sums``."""
        sums[:] = 0.0
        self._kernel(self._sites, *self._around, values, bends, low, sums)


class PointGradient:
    """Least-squares gradient in the cells of a mesh from values at their points."""

    def __init__(self, mesh: Mesh) -> None:
        self._points_of = mesh.cell_point_start, mesh.cell_points
        self._n, self._sites = mesh.n_cells, np.concatenate([np.empty((mesh.n_cells, 3)), mesh.points])
        link(average)(*self._points_of, mesh.points, self._sites[: self._n])
        around = mesh.cell_point_start, self._n + mesh.cell_points
        self.fit = LeastSquaresGradient(self._sites, around)

    @property
    def middles(self) -> Floats:
        """Return the means of the points of the cells (n_cells, 3), m."""
        return self._sites[: self._n]

    def average(self, values: Floats) -> Floats:
        """Write the means of m fields in the cells into the first rows of ``values`` (n_cells + n_points, m).

        Returns these rows; the other rows are the values at the points. ``fit`` makes gradients of all.
        """
        link(average)(*self._points_of, values[self._n :], values[: self._n])
        return values[: self._n]


def grouped(rows: NDArray[np.generic], columns: NDArray[np.generic], n: int) -> tuple[Ints, Ints]:
    """Sort pairs of row and column by row; return the start of each of n rows, and the columns in order."""
    start, sorted_columns = np.zeros(n + 1, dtype=np.int32), np.empty(len(columns), dtype=np.int32)
    link(group)(
        rows.astype(np.int32, copy=False), columns.astype(np.int32, copy=False), start, sorted_columns
    )
    return start, sorted_columns


def _second_neighbours(owner: Ints, neighbour: Ints, n: int, cells: Index) -> tuple[Index, Index]:
    """Return pairs of the given cells and the neighbours of their neighbours, without closer ones."""
    from scipy import sparse

    ones = np.ones(2 * len(owner), dtype=np.int32)
    ends = (np.concatenate([owner, neighbour]), np.concatenate([neighbour, owner]))
    adjacent = sparse.csr_array((ones, ends), shape=(n, n))
    second = sparse.coo_array(adjacent[cells] @ adjacent)
    near = sparse.csr_array(adjacent[cells]).tocoo()
    rows, columns = cells[second.row], second.col.astype(np.intp)
    known = np.isin(rows * n + columns, np.concatenate([cells[near.row] * n + near.col, cells * (n + 1)]))
    return rows[~known], columns[~known]


def _nearly_singular(matrix: Floats, least: float) -> Mask:
    """Return True for matrices (n, 3, 3) whose smallest eigenvalue is below ``least`` of the largest."""
    T = _components(matrix)
    suspect: Mask = tensor.det(T) <= 27.0 * least * (tensor.trace(T) / 3.0) ** 3
    # With eigenvalues λ₁ ≥ λ₂ ≥ λ₃, det ≤ λ₃ λ₁² and λ₁ ≤ 3·(trace/3): every λ₃ < least·λ₁ is suspected.
    values = np.linalg.eigvalsh(matrix[suspect])
    suspect[suspect] = values[:, 0] <= least * values[:, 2]
    return suspect


def invert(matrix: Floats, least: float) -> tuple[Floats, Mask]:
    """Invert symmetric positive semidefinite matrices (n, 3, 3); nearly singular ones are pseudo-inverted.

    Returns the inverses, and True for the nearly singular ones.
    """
    poor = _nearly_singular(matrix, least)
    safe = np.where(poor[:, None, None], np.eye(3), matrix)
    result = np.stack(tensor.inverse(_components(safe)), axis=1).reshape(-1, 3, 3)
    values, vectors = np.linalg.eigh(matrix[poor])
    used = values > least * values[:, -1:]
    scaled = np.where(used, 1.0 / np.where(used, values, 1.0), 0.0)
    result[poor] = np.einsum("nij,nj,nkj->nik", vectors, scaled, vectors)
    return result, poor


def _components(matrix: Floats) -> tensor.Tensor:
    """Return the nine components of matrices (n, 3, 3)."""
    a, b, c, d, e, f, g, h, i = matrix.reshape(-1, 9).T
    return a, b, c, d, e, f, g, h, i


def group(keys: Ints, values: Ints, start: Ints, grouped: Ints) -> None:
    """Sort values stably by key: the values of key k go to ``start[k]`` to ``start[k + 1] - 1``.

    ``start`` (n_keys + 1,) must hold zeros.
    """
    n = start.shape[0] - 1
    for i in range(keys.shape[0]):
        start[keys[i] + 1] += 1
    for k in range(n):
        start[k + 1] += start[k]
    for i in range(keys.shape[0]):
        k = keys[i]
        grouped[start[k]] = values[i]
        start[k] += 1
    for k in range(n, 0, -1):
        start[k] = start[k - 1]
    start[0] = 0


def list_around(
    first: Ints, of_cell: Ints, owner: Ints, neighbour: Ints, beyond: Ints, start: Ints, columns: Ints
) -> int:
    """List the sites across the faces of each cell: larger cells, smaller cells, and sites at the boundary.

    Parameters
    ----------
    first, of_cell, owner, neighbour
        The faces of each cell, and the cells of each face.
    beyond
        (n_boundary,) site beyond each boundary face, −1 for none.
    start, columns
        Results: the start of each cell's list (n_cells + 1,), and the lists.

    Returns
    -------
    The number of entries in ``columns``.
    """
    at, n_internal = 0, neighbour.shape[0]
    for c in range(start.shape[0] - 1):
        start[c] = at
        for kind in range(3):
            for h in range(first[c], first[c + 1]):
                f, site = of_cell[h], -1
                if f >= n_internal:
                    site = beyond[f - n_internal] if kind == 2 else -1
                elif owner[f] == c:
                    site = neighbour[f] if kind == 0 else -1
                else:
                    site = owner[f] if kind == 1 else -1
                if site >= 0:
                    columns[at] = site
                    at += 1
    start[start.shape[0] - 1] = at
    return at


def sum_differences(
    sites: Floats, start: Ints, columns: Ints, values: Floats, bends: Floats, low: int, sums: Floats
) -> None:
    """Sum (f_s − f_c) d/|d|² over the sites s around cells c, with d from c to s.

    Parameters
    ----------
    values
        (n_sites, m) values of m fields f.
    bends
        (n_cells, m, 6) second derivatives, whose contribution is subtracted; no rows for none.
    low, sums
        Results (n, m, 3) of the cells from ``low`` on; must hold zeros.
    """
    bent = bends.shape[0] > 0
    for i in range(sums.shape[0]):
        c = low + i
        for k in range(start[c], start[c + 1]):
            s = columns[k]
            d = arm(sites, s, point(sites, c))
            square = inner(d, d)
            weight = 1.0 / square if square > 0.0 else 0.0
            for f in range(sums.shape[1]):
                difference = values[s, f] - values[c, f]
                if bent:
                    difference -= _half_bend(bends, c, f, d)
                for j in range(3):
                    sums[i, f, j] += weight * difference * d[j]


def turn_rows(inverse: Floats, sums: Floats) -> None:
    """Multiply ``sums`` (n, m, 3) by symmetric matrices (n, 6) from the right, in place."""
    for i in range(sums.shape[0]):
        xx, yy, zz = inverse[i, 0], inverse[i, 1], inverse[i, 2]
        xy, xz, yz = inverse[i, 3], inverse[i, 4], inverse[i, 5]
        for f in range(sums.shape[1]):
            x, y, z = sums[i, f, 0], sums[i, f, 1], sums[i, f, 2]
            sums[i, f, 0] = x * xx + y * xy + z * xz
            sums[i, f, 1] = x * xy + y * yy + z * yz
            sums[i, f, 2] = x * xz + y * yz + z * zz


def symmetrise(second: Floats, h: Floats) -> None:
    """Write derivatives (n, 9, 3) of the components of gradients as second derivatives (n, 3, 6)."""
    for c in range(h.shape[0]):
        for i in range(3):
            h[c, i, 0], h[c, i, 1], h[c, i, 2] = (
                second[c, 3 * i, 0],
                second[c, 3 * i + 1, 1],
                second[c, 3 * i + 2, 2],
            )
            h[c, i, 3] = 0.5 * (second[c, 3 * i, 1] + second[c, 3 * i + 1, 0])
            h[c, i, 4] = 0.5 * (second[c, 3 * i, 2] + second[c, 3 * i + 2, 0])
            h[c, i, 5] = 0.5 * (second[c, 3 * i + 1, 2] + second[c, 3 * i + 2, 1])


def mean_series(
    points: Floats,
    sites: Floats,
    start: Ints,
    columns: Ints,
    u: Floats,
    l: Floats,
    h: Floats,
    u_points: Floats,
    l_points: Floats,
) -> None:
    """Average at points the Taylor series about the sites around them, weighted by the inverse distance.

    Parameters
    ----------
    u, l, h
        Values (n_sites, 3), first (n_sites, 3, 3) and second derivatives (n_sites, 3, 6); l_ij = ∂u_i/∂x_j.
    u_points, l_points
        Results (n, 3) and (n, 3, 3); must hold zeros.
    """
    for p in range(points.shape[0]):
        if start[p] == start[p + 1]:
            continue
        total = 0.0
        for k in range(start[p], start[p + 1]):
            s = columns[k]
            d = arm(points, p, point(sites, s))
            w = 1.0 / max(norm(d), 1e-300)
            total += w
            for i in range(3):
                slope = l[s, i, 0] * d[0] + l[s, i, 1] * d[1] + l[s, i, 2] * d[2]
                u_points[p, i] += w * (u[s, i] + slope + _half_bend(h, s, i, d))
                x = h[s, i, 0] * d[0] + h[s, i, 3] * d[1] + h[s, i, 4] * d[2]
                y = h[s, i, 3] * d[0] + h[s, i, 1] * d[1] + h[s, i, 5] * d[2]
                z = h[s, i, 4] * d[0] + h[s, i, 5] * d[1] + h[s, i, 2] * d[2]
                l_points[p, i, 0] += w * (l[s, i, 0] + x)
                l_points[p, i, 1] += w * (l[s, i, 1] + y)
                l_points[p, i, 2] += w * (l[s, i, 2] + z)
        for i in range(3):
            u_points[p, i] /= total
            for j in range(3):
                l_points[p, i, j] /= total


def average(start: Ints, columns: Ints, values: Floats, means: Floats) -> None:
    """Write the mean of the rows of ``values`` (n, m) in each group of columns into ``means``."""
    for r in range(means.shape[0]):
        means[r] = 0.0
        for k in range(start[r], start[r + 1]):
            for f in range(means.shape[1]):
                means[r, f] += values[columns[k], f]
        for f in range(means.shape[1]):
            means[r, f] /= start[r + 1] - start[r]


def _half_bend(h: Floats, r: int, i: int, d: Vector) -> float:
    """Return ½ d·H·d with the second derivatives of field i in row r."""
    diagonal = h[r, i, 0] * d[0] * d[0] + h[r, i, 1] * d[1] * d[1] + h[r, i, 2] * d[2] * d[2]
    mixed = h[r, i, 3] * d[0] * d[1] + h[r, i, 4] * d[0] * d[2] + h[r, i, 5] * d[1] * d[2]
    return float(0.5 * diagonal + mixed)
