"""Particles per area that stick to a wall, on the unrolled wall."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.view.geometry import Surface

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
    points: Floats
    """Coordinates of the particles, (n, 2), m."""

    @property
    def few(self) -> bool:
        """Whether there are too few particles for a density; they are drawn as dots."""
        return self.number < FEW


def deposits(surface: Surface, x: Floats) -> Deposits:
    """Count the particles at positions ``x`` on a wall, (n, 3), m.

    The sum of density times area over the bins is the number of particles, if every bin with a particle
    contains a part of the wall.
    """
    areas = np.linalg.norm(surface.areas, axis=1)
    total = float(areas.sum())
    mean = np.linalg.norm(surface.areas.sum(axis=0)) / total
    spread, weight = _spread(surface, areas)
    centre = np.average(spread, axis=0, weights=weight)
    rolled = bool(mean < _ROUND)
    if rolled:
        # The axis is the direction that is closest to perpendicular to all normals.
        axes = np.linalg.eigh(np.einsum("ti,tj->ij", surface.areas / areas[:, None], surface.areas))[1].T
    else:
        axes = np.linalg.eigh(np.cov((spread - centre).T, aweights=weight))[1].T[::-1]
    # The largest component of each axis is positive, so that similar walls are drawn alike.
    axes *= np.sign(axes[np.arange(3), np.abs(axes).argmax(axis=1)])[:, None]
    radius = float(np.average(np.linalg.norm((spread - centre) @ axes[1:].T, axis=1), weights=weight))

    def unrolled(points: Floats) -> Floats:
        local = (points - centre) @ axes.T
        if rolled:
            local[:, 1] = radius * np.arctan2(local[:, 2], local[:, 1])
        return np.asarray(local[:, :2])

    on_wall, at = unrolled(spread), unrolled(x)
    low = np.minimum(on_wall.min(axis=0), at.min(axis=0, initial=np.inf))
    high = np.maximum(on_wall.max(axis=0), at.max(axis=0, initial=-np.inf))
    side = high - low
    bins = _bins(side, len(x))
    edges = [np.linspace(low[k], high[k], bins[k] + 1) for k in range(2)]
    wall = np.histogram2d(on_wall[:, 0], on_wall[:, 1], bins=edges, weights=weight)[0]
    counts = np.histogram2d(at[:, 0], at[:, 1], bins=edges)[0]
    with np.errstate(invalid="ignore", divide="ignore"):
        density = np.where(wall > 0.0, counts / wall, np.nan)
    names = ("along", "around") if rolled else ("along", "across")
    return Deposits(
        surface.name,
        len(x),
        total,
        names,
        (edges[0], edges[1]),
        density,
        at,
    )


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
