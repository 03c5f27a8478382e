"""Compiled loops over what surrounds a cell or a point: differences, Taylor series.

Sites are places with values. Those around row r are ``columns[start[r]]`` to ``columns[start[r + 1] - 1]``,
int32; the first sites are the cell centres, so that the row of a cell is also its own site. Six second
derivatives stand in the order xx, yy, zz, xy, xz, yz.
"""

from __future__ import annotations

from foamprb.body.tensor import Vector, inner, norm
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import arm, point

__all__ = ["group", "mean_series", "sum_differences"]


def group(keys: Ints, values: Ints, start: Ints, grouped: Ints) -> None:
    """Put values by their keys, in their order: those of key k from ``start[k]`` to ``start[k + 1] - 1``.

    ``start`` (n_keys + 1,) holds zeros.
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


def sum_differences(
    sites: Floats, start: Ints, columns: Ints, values: Floats, bends: Floats, low: int, sums: Floats
) -> None:
    """Sums over the sites s around cells c of (f_s − f_c) d/|d|², with d from c to s.

    Parameters
    ----------
    values
        (n_sites, m) of m fields f.
    bends
        (n_cells, m, 6) second derivatives, whose part in the differences is taken off; none if it is empty.
    low, sums
        For the results (n, m, 3) of the cells from ``low`` on; holds zeros.
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
    """Means at points of the Taylor series about the sites around, weighted by the inverse distance.

    Parameters
    ----------
    u, l, h
        Values (n_sites, 3), first (n_sites, 3, 3) and second derivatives (n_sites, 3, 6); l_ij = ∂u_i/∂x_j.
    u_points, l_points
        For the results (n, 3) and (n, 3, 3); hold zeros.
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


def _half_bend(h: Floats, r: int, i: int, d: Vector) -> float:
    """½ d·H·d with the second derivatives of field i in row r."""
    diagonal = h[r, i, 0] * d[0] * d[0] + h[r, i, 1] * d[1] * d[1] + h[r, i, 2] * d[2] * d[2]
    mixed = h[r, i, 3] * d[0] * d[1] + h[r, i, 4] * d[0] * d[2] + h[r, i, 5] * d[1] * d[2]
    return float(0.5 * diagonal + mixed)
