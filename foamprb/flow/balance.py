"""Least change of the fluxes through faces that keeps the mass of each cell, by conjugate gradients.

Cells are computed in segments that depend on the mesh alone; sums have the order of the cells and of the
segments. The fluxes are therefore the same to the last bit for any number of threads.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import pairwise, zip_longest
from typing import Any, NamedTuple

import numpy as np

from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.interfaces import FacePairs
from foamprb.flow.mesh.lists import Index, Mask, starts, threads
from foamprb.flow.mesh.mesh import Mesh

_LEAST_ERROR = 0.04
"""Least square of the error of a flux that counts in its weight, over the mean square."""
_BLOCK, _MOST_BLOCKS = 100, 5000
"""Cells in a block of the preconditioner, about, and the most blocks."""
BALANCED = 1e-5
"""Largest flux that cells make or lose, over the fluxes through faces; root mean squares."""
MOST_ITERATIONS = 2000
_PARTS, _LEAST_SEGMENT, _MOST_SEGMENT = 8, 10_000, 50_000
"""Segments that are computed at the same time, at most; cells in one of up to as many, and in one of more."""


class Mass(NamedTuple):
    """Density of the fluid in any unit, as only its ratios matter, and its rate of change per second.

    Of the cells (n_cells,) and at the boundary faces (n_boundary,), or one value for all.
    """

    cells: Floats
    boundary: Floats
    growth: Floats


CONSTANT = Mass(np.ones(1), np.ones(1), np.zeros(1))
"""Density of an incompressible flow, whose cells keep volume."""


class Balanced(NamedTuple):
    """Outcome of :class:`Balance`: ratios of root mean squares to those of the flow, and a count.

    A flow that starts from rest moves at its boundary only: the change is compared with the largest velocity
    there if that is larger. A change of the density counts as flow, too.
    """

    left: float
    """Mass that cells still make or lose, to the fluxes through faces and into cells."""
    change: float
    """Change of the velocity through faces; means over their areas."""
    iterations: int


class Balance:
    """Least change of the fluxes through the faces of the cells that keeps the mass of each cell.

    The change is the smallest in the sum of squares over a weight, which is a conductance: the area of a face
    in the direction of the line between the centres, over its length. A face that this line meets at a small
    angle lies along long cells; a flux through it would move the fluid along them. It is multiplied by the
    square of an error: the difference between the integral of the interpolated velocity and the mean of the
    cells, as large as at walls and shear layers that the mesh does not resolve, plus a part of its mean.

    Parameters
    ----------
    mesh
        Cells and faces.
    pairs
        Coupled faces; the flux through the area that two faces share may change.
    measures
        (3, n_faces) results of :func:`~foamprb.flow.fluxes.weigh_faces`; weights and errors are overwritten.
    fluxes
        (n_faces,) interpolated fluxes; calls change them.
    free
        Other boundary faces through which the flux may change.
    closed
        See :func:`closed_pieces`.
    """

    def __init__(
        self,
        mesh: Mesh,
        pairs: FacePairs,
        measures: Floats,
        fluxes: Floats,
        free: Mask,
        closed: Ints,
    ) -> None:
        weight, error, area = measures
        self._mesh, self._weight, self._closed, n = mesh, weight, closed, mesh.n_internal
        self._fluxes, self._area = fluxes, area
        outer = mesh.owner[n:]
        self._pairs, self._ends = pairs, (outer[pairs.faces], outer[pairs.others])
        # The normals of two coupled faces are opposite.
        of_pairs = 0.25 * (error[n:][pairs.faces] - error[n:][pairs.others]) ** 2
        np.square(error, out=error)
        least = _LEAST_ERROR * float(error.mean()) + 1e-12 * float(((fluxes / area) ** 2).mean()) + 1e-300
        error += least
        # The two halves of the way between two cells are in series.
        one, other = weight[n:][pairs.faces] * pairs.parts, weight[n:][pairs.others] * pairs.of_others
        across = one * other / np.maximum(one + other, 1e-300) * (of_pairs + least)
        weight *= error
        largest = float(weight.max(initial=1e-300))
        weight /= largest
        weight[n:][~free] = 0.0
        self._across = across / largest
        size = 2 * n + len(pairs.faces)
        # Unsigned, which avoids a check for negative indices.
        start, columns = np.empty(mesh.n_cells + 1, dtype=np.uint32), np.empty(size, dtype=np.uint32)
        rows = start, columns, np.empty(size), np.empty(mesh.n_cells)
        faces_of = mesh.cell_face_start, mesh.cell_faces, mesh.owner, mesh.neighbour
        link(list_rows)(*faces_of, weight, pairs.start, self._ends[1], self._across, *rows)
        self._equations = Equations(rows, *_blocks(mesh.centres), _segments(mesh.n_cells))

    def __call__(self, crossing: Floats, mass: Mass, speed: float) -> Balanced:
        """Change the fluxes in place; what remains of a closed piece is shared by volume.

        Parameters
        ----------
        crossing
            (n_pairs,) part of the fluxes of coupled faces that crosses each pair.
        mass
            Density of the fluid.
        speed
            Largest velocity at walls and openings, m/s.
        """
        mesh, pairs, weight, n = self._mesh, self._pairs, self._weight, self._mesh.n_internal
        fluxes = self._fluxes
        owner, neighbour, cells = mesh.owner, mesh.neighbour, mesh.n_cells
        inside = np.broadcast_to(mass.cells, (cells,))
        outside = np.broadcast_to(mass.boundary, (len(owner) - n,))
        density, between = np.ones((2, 1))
        (here, there), coupled = self._ends, n + np.flatnonzero(np.diff(pairs.start))
        if mass is not CONSTANT:
            density = np.concatenate([0.5 * (inside[owner[:n]] + inside[neighbour]), outside])
            between = 0.5 * (inside[here] + inside[there])
        fluxes *= density
        fluxes[coupled] = pairs.total(crossing * between)[coupled - n]
        stored = mesh.volumes * mass.growth
        rest = np.bincount(neighbour, fluxes[:n], cells) - np.bincount(owner, fluxes, cells) - stored
        self._equations.close(rest, mesh.volumes, self._closed)
        size = math.sqrt(float((fluxes**2).mean()) * cells + float((stored**2).sum()))
        y, left, iterations = self._equations.solve(rest, BALANCED * size)
        given = fluxes.copy()
        fluxes += weight * y[owner]
        fluxes[:n] -= weight[:n] * y[neighbour]
        crossing = crossing * between + self._across * (y[here] - y[there])
        fluxes[coupled] = pairs.total(crossing)[coupled - n]
        fluxes /= density
        given /= density
        fluxes[coupled] = pairs.total(crossing / between)[coupled - n]
        change = math.sqrt(self._mean_square(given - fluxes))
        # What a change of the density moves, it may move through all of the mesh.
        rates, length = float(((mass.growth / inside) ** 2).mean()), float(mesh.volumes.sum()) ** (1.0 / 3.0)
        flow = self._mean_square(given) + rates * length**2
        return Balanced(left / max(size, 1e-300), change / max(math.sqrt(flow), speed, 1e-300), iterations)

    def _mean_square(self, fluxes: Floats) -> float:
        """Return the mean over the area of the faces of the squared velocity through them."""
        area, squares = float(self._area.sum()), float((fluxes**2 / self._area).sum())
        return squares / max(area, 1e-300)


def closed_pieces(mesh: Mesh, pairs: FacePairs, free: Mask) -> Ints:
    """Return a number for all cells (n_cells,) of each piece of a mesh that no flux enters, −1 for others.

    Fluxes pass from one piece to the next neither through faces nor through coupled ones. ``free`` are the
    boundary faces through which they may change.
    """
    from scipy import sparse
    from scipy.sparse.csgraph import connected_components

    n, outer = mesh.n_internal, mesh.owner[mesh.n_internal :]
    sides = (mesh.owner[:n], outer[pairs.faces]), (mesh.neighbour, outer[pairs.others])
    ends = tuple(np.concatenate(side) for side in sides)
    links = sparse.coo_array((np.ones(len(ends[0]), dtype=np.int8), ends), shape=2 * (mesh.n_cells,))
    count, piece = connected_components(links, directed=False)
    is_open = np.zeros(count, dtype=bool)
    is_open[piece[outer[free]]] = True
    return np.where(is_open, -1, np.cumsum(~is_open) - 1).astype(np.int32)[piece]


def _segments(cells: int) -> Index:
    """Return the first cell of each segment and the end of the last."""
    count = max(1, min(_PARTS, cells // _LEAST_SEGMENT), cells // _MOST_SEGMENT)
    return np.linspace(0, cells, count + 1).astype(np.intp)


class Equations:
    """Equations of the cells of some segments: A·y = b.

    Parameters
    ----------
    rows
        Results of :func:`list_rows`.
    block, n_blocks
        Block of the preconditioner of each cell, and the number of blocks.
    segments
        The first cell of each segment, and the end of the last.
    """

    def __init__(self, rows: tuple[Any, ...], block: Ints, n_blocks: int, segments: Index) -> None:
        from scipy import sparse
        from scipy.sparse.linalg import splu

        self._rows, self._n_blocks, self._segments = rows, n_blocks, list(pairwise(segments.tolist()))
        start, diagonal = rows[0], rows[3]
        # The blocks of a segment are numbered: their sums depend on no other segment.
        self._pair, number = np.empty(len(diagonal), dtype=np.int32), np.empty(n_blocks, dtype=np.int32)
        coarse = []
        most = max((int(start[b] - start[a]) for a, b in self._segments), default=0)
        between = np.empty((2, most), dtype=np.int32), np.empty(most)
        for a, b in self._segments:
            used = np.flatnonzero(np.bincount(block[a:b], minlength=n_blocks))
            number[used] = np.arange(len(used))
            self._pair[a:b] = number[block[a:b]]
            sums = np.bincount(self._pair[a:b], diagonal[a:b], len(used))
            inside = np.zeros(len(used))
            count = link(part_weights)(a, b, *rows[:3], block, self._pair, inside, *between)
            faces = between[1][:count], tuple(between[0][:, :count])
            summed = sparse.csr_array(faces, shape=(n_blocks, n_blocks)).tocoo()
            coarse.append((used, sums, inside, summed.row, summed.col, summed.data))
        self._blocks = [used for used, *_ in coarse]
        self._all_blocks, *of_cells, at, beside, weights = map(np.concatenate, zip(*coarse, strict=True))
        total, within = (np.bincount(self._all_blocks, a, n_blocks) for a in of_cells)
        pairs = sparse.csr_array((-weights, (at, beside)), shape=(n_blocks, n_blocks))
        # Blocks that no flux leaves, as a closed flow, are determined but for a constant.
        matrix = pairs + pairs.T + sparse.diags_array((1.0 + 1e-9) * total - 2.0 * within)
        self._solve_blocks = splu(matrix.tocsc()).solve

    def close(self, residual: Floats, volumes: Floats, closed: Ints) -> None:
        """Subtract from what the cells of each closed piece lack their share, by volume, of its sum.

        Without it there is no solution. ``closed`` (n_cells,) is the piece of each cell, −1 for open ones.
        """
        lack = np.bincount(closed + 1, residual) / np.maximum(np.bincount(closed + 1, volumes), 1e-300)
        lack[0] = 0.0
        residual -= volumes * lack[closed + 1]

    def solve(self, residual: Floats, enough: float) -> tuple[Floats, float, int]:
        """Solve for potentials of the cells by conjugate gradients until the norm of what is left is enough.

        The preconditioner is Jacobi's plus the exact solution with a constant in each block. BLAS, and so
        SciPy's solvers, add in an order that depends on the number of threads.

        Parameters
        ----------
        residual
            (n_cells,) what cells lack; it is overwritten.

        Returns
        -------
        The potentials (n_cells,), the norm, and the number of iterations.
        """
        with threads(min(len(self._segments), _PARTS)) as run:
            return self._solve(run, residual, enough)

    def _solve(
        self, run: Callable[..., list[Any]], residual: Floats, enough: float
    ) -> tuple[Floats, float, int]:
        n, diagonal, pair = len(residual), self._rows[3], self._pair
        each = partial(self._each, run)
        y, image = np.zeros((2, n))
        way = np.zeros(n)
        ends = list(pairwise(starts(np.array([len(used) for used in self._blocks], dtype=np.intp)).tolist()))
        of_pairs = np.empty(ends[-1][1] if ends else 0)
        parts = [(of_pairs[a:b],) for a, b in ends]
        go, turn, multiply = link(go_down), link(turn_way), link(multiply_rows)
        step = part_of_last = before = 0.0
        for iteration in range(MOST_ITERATIONS + 1):
            found = each(go, diagonal, pair, step, way, image, y, residual, rows=parts)
            squares, energies = zip(*found, strict=True)
            left = math.sqrt(sum(squares))
            if left <= enough or iteration == MOST_ITERATIONS:
                break
            sums = np.bincount(self._all_blocks, of_pairs, self._n_blocks)
            of_blocks = self._solve_blocks(sums)
            energy = sum(energies) + float(np.einsum("i,i->", sums, of_blocks))
            part_of_last, before = energy / before if before else 0.0, energy
            solved = [(of_blocks[used],) for used in self._blocks]
            each(turn, diagonal, pair, part_of_last, residual, way, rows=solved)
            step = energy / sum(each(multiply, *self._rows, way, image))
        return y, left, iteration

    def _each(
        self,
        run: Callable[..., list[Any]],
        kernel: Callable[..., Any],
        *arguments: object,
        rows: Iterable[Any] = (),
    ) -> list[Any]:
        """Return the results of a kernel for the segments; its last argument is a row, if given."""
        parts = zip_longest(self._segments, rows, fillvalue=())
        calls = [partial(kernel, *part, *arguments, *row) for part, row in parts]
        n = min(len(calls), _PARTS)
        groups = [calls[len(calls) * k // n : len(calls) * (k + 1) // n] for k in range(n)]
        return [result for group in run(*(partial(_in_turn, group) for group in groups)) for result in group]


def _in_turn(calls: Sequence[Callable[[], Any]]) -> list[Any]:
    return [call() for call in calls]


def _blocks(centres: Floats) -> tuple[Ints, int]:
    """Return the block of each cell, a box of a regular grid over all centres, and the number of blocks.

    Boxes without a cell are not counted.
    """
    n, low = len(centres), centres.min(axis=0)
    extent = centres.max(axis=0) - low
    wide = extent > 1e-6 * max(extent.max(initial=0.0), 1e-300)
    counts = np.ones(3, dtype=np.int64)
    if wide.any():
        boxes = min(max(n / _BLOCK, 1.0), _MOST_BLOCKS)
        edge = float(np.prod(extent[wide]) / boxes) ** (1.0 / np.count_nonzero(wide))
        counts[wide] = np.ceil(extent[wide] / edge)
    number = np.zeros(len(centres), dtype=np.intp)
    for axis in range(3):
        x = centres[:, axis]
        at = (x - low[axis]) / (extent[axis] if wide[axis] else 1.0) * counts[axis]
        number *= counts[axis]
        number += np.minimum(at.astype(np.int32), counts[axis] - 1)
    used = np.bincount(number, minlength=int(counts.prod())) > 0
    numbers = np.cumsum(used, dtype=np.int32)
    return numbers[number] - np.int32(1), int(numbers[-1])


def list_rows(
    first: Ints,
    of_cell: Ints,
    owner: Ints,
    neighbour: Ints,
    weight: Floats,
    pair_start: Ints,
    beyond: Ints,
    across: Floats,
    start: Ints,
    columns: Ints,
    values: Floats,
    diagonal: Floats,
) -> None:
    """List the equations of the cells: minus the weights of the cells beside, and the sum of all weights.

    Parameters
    ----------
    first, of_cell, owner, neighbour, weight
        The faces of each cell; the cells and the weight of each face.
    pair_start, beyond, across
        The pairs of each boundary face; the cell beyond and the weight of each pair.
    start, columns, values, diagonal
        Results: the row of cell c is from ``start[c]`` to before ``start[c + 1]``. 1 on the diagonal of a
        cell without weights.
    """
    at = 0
    for c in range(diagonal.shape[0]):
        total, start[c] = 0.0, at
        for h in range(first[c], first[c + 1]):
            f = of_cell[h]
            total += weight[f]
            if f < neighbour.shape[0]:
                columns[at] = neighbour[f] if owner[f] == c else owner[f]
                values[at] = -weight[f]
                at += 1
                continue
            b = f - neighbour.shape[0]
            for k in range(pair_start[b], pair_start[b + 1]):
                if beyond[k] != c:
                    total += across[k]
                    columns[at] = beyond[k]
                    values[at] = -across[k]
                    at += 1
        diagonal[c] = total if total > 0.0 else 1.0
    start[diagonal.shape[0]] = at


def part_weights(
    begin: int,
    end: int,
    start: Ints,
    columns: Ints,
    values: Floats,
    block: Ints,
    pair: Ints,
    inside: Floats,
    blocks: Ints,
    weights: Floats,
) -> int:
    """Add the weights of faces within a block to ``inside``; list those between two blocks.

    Of the two equations with a face the one of the lower cell counts.

    Parameters
    ----------
    begin, end
        The cells.
    start, columns, values
        Results of :func:`list_rows`.
    block, pair
        Block of each cell, and its index in ``inside``.
    inside, blocks, weights
        Results; (2, n) the two blocks of a face, and (n,) its weight.

    Returns
    -------
    The number of faces that are listed.
    """
    count = 0
    for c in range(begin, end):
        for k in range(start[c], start[c + 1]):
            to = columns[k]
            if to > c:
                if block[to] == block[c]:
                    inside[pair[c]] -= values[k]
                else:
                    blocks[0, count], blocks[1, count], weights[count] = block[c], block[to], -values[k]
                    count += 1
    return count


def multiply_rows(
    begin: int,
    end: int,
    start: Ints,
    columns: Ints,
    values: Floats,
    diagonal: Floats,
    way: Floats,
    image: Floats,
) -> float:
    """Write the product of some rows of :func:`list_rows` with ``way``; return its product with ``way``."""
    total = 0.0
    for c in range(begin, end):
        y = diagonal[c] * way[c]
        for k in range(start[c], start[c + 1]):
            y += values[k] * way[columns[k]]
        image[c] = y
        total += y * way[c]
    return total


def go_down(
    begin: int,
    end: int,
    diagonal: Floats,
    block: Ints,
    step: float,
    way: Floats,
    image: Floats,
    y: Floats,
    residual: Floats,
    sums: Floats,
) -> tuple[float, float]:
    """Go a step on the way for some cells; put the sums of the residual by blocks into ``sums``.

    Returns
    -------
    The sum of squares of the residual, and that over the diagonal.
    """
    sums[:] = 0.0
    square = energy = 0.0
    for c in range(begin, end):
        y[c] += step * way[c]
        residual[c] -= step * image[c]
        sums[block[c]] += residual[c]
        square += residual[c] * residual[c]
        energy += residual[c] * residual[c] / diagonal[c]
    return square, energy


def turn_way(
    begin: int,
    end: int,
    diagonal: Floats,
    block: Ints,
    before: float,
    residual: Floats,
    way: Floats,
    of_blocks: Floats,
) -> None:
    """Write the preconditioned residual plus ``before`` times the last way for some cells."""
    for c in range(begin, end):
        way[c] = residual[c] / diagonal[c] + of_blocks[block[c]] + before * way[c]
