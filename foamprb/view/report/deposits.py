"""Particles per area that stick to a wall, on its triangles and on the unrolled wall."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from foamprb.view.geometry import Surface

__all__ = ["Deposits", "deposits"]

Floats = NDArray[np.float64]

FEW = 30
"""Fewer particles than this on a wall are dots."""
_SAMPLES = 100_000
"""Number of points over which the area of a wall is distributed."""
_ROUND = 0.5
"""A wall whose mean normal is shorter than this is unrolled."""
_PER_BIN, _MOST_BINS = 8.0, 60
"""Mean number of particles in a bin, and largest number of bins along a side."""


class Deposits(NamedTuple):
    """Particles on a wall, counted in bins of its two coordinates."""

    name: str
    number: int
    """Number of particles."""
    area: float
    """Area of the wall, m²."""
    across: tuple[str, str]
    """Names of the coordinates."""
    edges: tuple[Floats, Floats]
    """Edges of the bins along both coordinates, m; (p + 1,) and (q + 1,)."""
    density: Floats
    """Particles per area, (p, q), 1/m²; NaN outside the wall."""
    triangles: Floats
    """Density on each triangle of the surface, (t,), 1/m²."""
    points: Floats
    """Coordinates of the particles, (n, 2), m."""
    places: Floats
    """Positions of the particles, (n, 3), m."""
    flat: bool = False
    """Whether the case is two-dimensional."""

    @property
    def few(self) -> bool:
        """Whether there are too few particles for a density; they are drawn as dots."""
        return self.number < FEW


def deposits(surface: Surface, x: Floats, flat: Floats | None = None) -> Deposits:
    """Count the particles at positions ``x`` on a wall, (n, 3), m.

    The sum of density times area over the bins is the number of particles, if every bin with a particle
    contains a part of the wall. In a two-dimensional case, of normal ``flat``, the first coordinate is the
    length along the wall, and one bin spans the second one.
    """
    areas = np.linalg.norm(surface.areas, axis=1)
    total = float(areas.sum())
    mean = np.linalg.norm(surface.areas.sum(axis=0)) / total
    spread, weight = _spread(surface, areas)
    centre = np.average(spread, axis=0, weights=weight)
    rolled = flat is None and bool(mean < _ROUND)
    if rolled:
        # The axis is the direction that is closest to perpendicular to all normals.
        axes = np.linalg.eigh(np.einsum("ti,tj->ij", surface.areas / areas[:, None], surface.areas))[1].T
    else:
        axes = np.linalg.eigh(np.cov((spread - centre).T, aweights=weight))[1].T[::-1]
    # The largest component of each axis is positive, so that similar walls are drawn alike.
    axes *= np.sign(axes[np.arange(3), np.abs(axes).argmax(axis=1)])[:, None]
    radius = float(np.average(np.linalg.norm((spread - centre) @ axes[1:].T, axis=1), weights=weight))

    if flat is not None:
        tree, along = KDTree(spread), _length_along(surface, flat, spread)

    def unrolled(points: Floats) -> Floats:
        if flat is not None:
            return np.column_stack([along[tree.query(points)[1]], (points - centre) @ flat])
        local = (points - centre) @ axes.T
        if rolled:
            local[:, 1] = radius * np.arctan2(local[:, 2], local[:, 1])
        return np.asarray(local[:, :2])

    on_wall, at = unrolled(spread), unrolled(x)
    low = np.minimum(on_wall.min(axis=0), at.min(axis=0, initial=np.inf))
    high = np.maximum(on_wall.max(axis=0), at.max(axis=0, initial=-np.inf))
    side = high - low
    bins = _bins(side, len(x)) if flat is None else (int(np.clip(len(x) / _PER_BIN, 1, _MOST_BINS)), 1)
    edges = [np.linspace(low[k], high[k], bins[k] + 1) for k in range(2)]
    wall = np.histogram2d(on_wall[:, 0], on_wall[:, 1], bins=edges, weights=weight)[0]
    counts = np.histogram2d(at[:, 0], at[:, 1], bins=edges)[0]
    with np.errstate(invalid="ignore", divide="ignore"):
        density = np.where(wall > 0.0, counts / wall, np.nan)
    middles = unrolled(surface.centres)
    i, j = (np.clip(np.searchsorted(edges[k], middles[:, k]) - 1, 0, bins[k] - 1) for k in range(2))
    names = ("along", "around") if rolled else ("along", "across")
    return Deposits(
        surface.name,
        len(x),
        total,
        names,
        (edges[0], edges[1]),
        density,
        np.nan_to_num(density[i, j]),
        at,
        x,
        flat is not None,
    )


def _length_along(surface: Surface, flat: Floats, points: Floats) -> Floats:
    """Return the length along a wall of a two-dimensional case at points of its triangles, in their order, m.

    Parts of the wall that do not touch follow one another.
    """
    plane = surface.points - np.outer(surface.points @ flat, flat)
    corners, used = np.unique(
        np.round(plane / (1e-6 * np.ptp(plane, axis=0).max())), axis=0, return_inverse=True
    )
    ends = used.reshape(-1)[surface.triangles]
    place = np.zeros((len(corners), 3))
    place[used.reshape(-1)] = plane
    # In the plane of the case a triangle is a line: its longest side.
    sides = ends[:, [[0, 1], [1, 2], [2, 0]]]
    longest = np.linalg.norm(place[sides[..., 0]] - place[sides[..., 1]], axis=2).argmax(axis=1)
    lines = np.sort(sides[np.arange(len(sides)), longest], axis=1)
    unique, line_of = np.unique(lines, axis=0, return_inverse=True)
    lines_at: dict[int, list[int]] = {}
    for k, line in enumerate(unique.tolist()):
        for corner in line:
            lines_at.setdefault(corner, []).append(k)
    start, origin, total = np.zeros(len(unique)), unique[:, 0].copy(), 0.0
    left = set(range(len(unique)))
    # Open parts begin at an end.
    for first in sorted(lines_at, key=lambda corner: len(lines_at[corner]) != 1):
        corner = first
        while here := left.intersection(lines_at[corner]):
            k = min(here)
            left.remove(k)
            start[k], origin[k] = total, corner
            corner = int(unique[k].sum()) - corner
            total += float(np.linalg.norm(place[corner] - place[origin[k]]))
    line_of = np.repeat(line_of.reshape(-1), len(points) // len(line_of))
    in_plane = points - np.outer(points @ flat, flat)
    return np.asarray(start[line_of] + np.linalg.norm(in_plane - place[origin[line_of]], axis=1))


def _spread(surface: Surface, areas: Floats) -> tuple[Floats, Floats]:
    """Return points distributed evenly over each triangle, and the area of each point."""
    order = max(1, round(np.sqrt(_SAMPLES / max(1, len(areas)))))
    i, j = (index.ravel() for index in np.meshgrid(np.arange(order), np.arange(order)))
    inside = i + j < order
    u, v = (i[inside] + 1.0 / 3.0) / order, (j[inside] + 1.0 / 3.0) / order
    weights = np.stack([1.0 - u - v, u, v], axis=1)
    points = np.einsum("sv,tvi->tsi", weights, surface.points[surface.triangles])
    return points.reshape(-1, 3), np.repeat(areas / len(weights), len(weights))


def _bins(side: Floats, n: int) -> tuple[int, int]:
    """Return the number of bins along both sides, for n particles; bins are about square."""
    cells = max(1.0, n / _PER_BIN)
    ratio = np.sqrt(max(side[0], 1e-300) / max(side[1], 1e-300))
    both = np.clip(np.round(np.sqrt(cells) * np.array([ratio, 1.0 / ratio])), 1, _MOST_BINS).astype(int)
    return int(both[0]), int(both[1])
