"""Sums over the cells that paths go through, which do not depend on the order of their parts.

A sum is an integer in two words, so that threads and processes may add in any order.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.paths import Steps, step, vector_of
from foamprb.compile.link import compiled
from foamprb.flow.mesh.arrays import MeshArrays
from foamprb.flow.walk import WITHIN, is_sound, way_out

Floats = NDArray[np.float64]
Words = NDArray[np.int64]

_WORD = 2.0**32
_DIGITS = 2.0**-60
"""Smallest difference between sums, over the largest value that is added at once."""
_PARTS, _LEAST_ROOM = 8, 4096
"""Parts for which there is room: over the number of steps, and at least."""
_MOST_TETRAHEDRA = 100_000


def no_sums(n_cells: int, columns: int) -> Words:
    """Return sums of zero of some columns of each cell, (n_cells, 2 columns): high and low words."""
    return np.zeros((n_cells, 2 * columns), dtype=np.int64)


def values_of(sums: Words, scale: Floats) -> Floats:
    """Return the values of sums, (n, columns), with the largest value of each column, (columns,)."""
    return np.asarray((sums[:, 0::2] * _WORD + sums[:, 1::2]) * (_DIGITS * scale))


def add_up(sums: Words, cells: NDArray[np.int64], values: Floats, scale: Floats) -> None:
    """Add values, (columns, n), to the sums of cells, (n,); ``scale`` is as in :func:`values_of`."""
    compiled(_add_up)(sums, cells, values, 1.0 / (_DIGITS * scale))


def _add_up(sums: Words, cells: NDArray[np.int64], values: Floats, per_unit: Floats) -> None:
    for k in range(len(cells)):
        for c in range(len(per_unit)):
            units = np.rint(values[c, k] * per_unit[c])
            high = np.floor(units / _WORD)
            sums[cells[k], 2 * c] += np.int64(high)
            sums[cells[k], 2 * c + 1] += np.int64(units - high * _WORD)


def parts_in_cells(
    mesh: MeshArrays, steps: Steps, fresh: NDArray[np.bool_], first: Floats, last: Floats
) -> Iterator[tuple[NDArray[np.int64], Floats]]:
    """Yield the parts of the fresh ones, (n,), of some steps in single cells.

    A pair are the cells, (m,), and integrals of quantities, (1 + k, m): of 1, and of quantities that are
    linear in time between their values at the starts and the ends of the steps, (k, n). A part ends where the
    straight way crosses a face.
    """
    room = max(_PARTS * steps.n, _LEAST_ROOM)
    cells, values, reached = np.empty(room, dtype=np.int64), np.empty((1 + len(first), room)), 0
    divide = compiled(_divide)
    while reached < steps.n:
        reached, m = divide(mesh, steps.tables, fresh, first, last, reached, cells, values)
        yield cells[:m], values[:, :m]


def _divide(
    mesh: MeshArrays,
    tables: Floats,
    fresh: NDArray[np.bool_],
    first: Floats,
    last: Floats,
    begin: int,
    cells: NDArray[np.int64],
    values: Floats,
) -> tuple[int, int]:
    """Divide steps from number ``begin`` on, as many as fit; return the next step, and how many parts."""
    m, k = 0, -1
    for table in tables:
        for i in range(table.shape[1]):
            k += 1
            if k < begin or not fresh[k]:
                continue
            host0, host1 = int(table[step.host0, i]), int(table[step.host1, i])
            # A particle that the mesh has lost counts in its last cell.
            host0 = host1 if host0 < 0 else host0
            host1 = host0 if host1 < 0 else host1
            if host0 >= 0:
                after = _follow(mesh, table, i, first, last, k, host0, host1, cells, values, m)
                if after < 0:
                    return k, m
                m = after
    return k + 1, m


def _follow(
    mesh: MeshArrays,
    table: Floats,
    i: int,
    first: Floats,
    last: Floats,
    k: int,
    host0: int,
    host1: int,
    cells: NDArray[np.int64],
    values: Floats,
    m: int,
) -> int:
    """Add the parts of step k, which is i of its table, from part m on; return the number of parts.

    It is −1 if there is no room.
    """
    x0, x1 = vector_of(table, step.x0, i), vector_of(table, step.x1, i)
    duration = table[step.t1, i] - table[step.t0, i]
    tet, came_from, done, end, begun = host0, -1, 0.0, _cell(mesh, host1), m
    for _ in range(_MOST_TETRAHEDRA):
        cell = _cell(mesh, tet)
        if cell == end or not is_sound(mesh, tet):
            break
        face, fraction = way_out(mesh, tet, came_from, x0, x1)
        if face < 0 or face == WITHIN:
            break
        other = mesh.neighbours[tet, face]
        if other < 0:
            break
        if _cell(mesh, other) != cell and fraction > done:
            if m == len(cells) - 1:
                break
            _add_part(duration, first, last, k, cell, done, min(fraction, 1.0), cells, values, m)
            m, done = m + 1, min(fraction, 1.0)
        tet, came_from = other, tet
    if m >= len(cells) - 1 and begun > 0:
        return -1
    # What is left of a way that cannot be followed counts in its last cell.
    _add_part(duration, first, last, k, end, done, 1.0, cells, values, m)
    return m + 1


def _cell(mesh: MeshArrays, tet: int) -> int:
    return int(mesh.tets[tet, 0]) - mesh.n_points


def _add_part(
    duration: float,
    first: Floats,
    last: Floats,
    k: int,
    cell: int,
    a: float,
    b: float,
    cells: NDArray[np.int64],
    values: Floats,
    m: int,
) -> None:
    """Store the part of step k between two shares of it as part m."""
    time, middle = (b - a) * duration, 0.5 * (a + b)
    cells[m], values[0, m] = cell, time
    for c in range(first.shape[0]):
        values[1 + c, m] = time * (first[c, k] + middle * (last[c, k] - first[c, k]))
