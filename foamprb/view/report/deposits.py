"""How many particles stick to a wall per area: on the wall as it lies in space, and on the wall unrolled."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.view.geometry import Surface

__all__ = ["Deposits", "deposits"]

Floats = NDArray[np.float64]

_SAMPLES = 100_000
"""Points of a wall over which its area is spread."""
_ROUND = 0.5
"""A wall is unrolled if its mean normal is shorter than this."""
_WANTED, _MOST_BINS = 8.0, 60
"""Particles of a filled bin, and bins along a side."""


class Deposits(NamedTuple):
    """Particles on a wall, counted in bins along two coordinates of it."""

    name: str
    number: int
    """Of the particles."""
    area: float
    """Of the wall, m²."""
    across: tuple[str, str]
    """What the coordinates are."""
    edges: tuple[Floats, Floats]
    """Of the bins along both, m; (p + 1,) and (q + 1,)."""
    density: Floats
    """Particles per area, (p, q), 1/m²; NaN where the wall is not."""
    triangles: Floats
    """Density on each triangle of the surface, (t,), 1/m²."""
    points: Floats
    """Coordinates of the particles, (n, 2), m."""


def deposits(surface: Surface, x: Floats) -> Deposits:
    """Count particles on a wall.

    Parameters
    ----------
    surface
        The wall.
    x
        Where particles stick, (n, 3), m.

    The sum of density times area over the bins is the number of particles, as far as a bin that holds one
    holds some of the wall.
    """
    areas = np.linalg.norm(surface.areas, axis=1)
    total = float(areas.sum())
    mean = np.linalg.norm(surface.areas.sum(axis=0)) / total
    spread, weight = _spread(surface, areas)
    centre = np.average(spread, axis=0, weights=weight)
    rolled = bool(mean < _ROUND)
    if rolled:
        # Its axis is the direction to which its normals are most nearly perpendicular.
        axes = np.linalg.eigh(np.einsum("ti,tj->ij", surface.areas / areas[:, None], surface.areas))[1].T
    else:
        axes = np.linalg.eigh(np.cov((spread - centre).T, aweights=weight))[1].T[::-1]
    # The direction of each axis is that of its largest component, so that pictures do not turn around.
    axes *= np.sign(axes[np.arange(3), np.abs(axes).argmax(axis=1)])[:, None]
    radius = float(np.average(np.linalg.norm((spread - centre) @ axes[1:].T, axis=1), weights=weight))

    def flat(points: Floats) -> Floats:
        local = (points - centre) @ axes.T
        if rolled:
            local[:, 1] = radius * np.arctan2(local[:, 2], local[:, 1])
        return np.asarray(local[:, :2])

    on_wall, at = flat(spread), flat(x)
    low = np.minimum(on_wall.min(axis=0), at.min(axis=0, initial=np.inf))
    high = np.maximum(on_wall.max(axis=0), at.max(axis=0, initial=-np.inf))
    side = high - low
    bins = _bins(side, len(x))
    edges = [np.linspace(low[k], high[k], bins[k] + 1) for k in range(2)]
    wall = np.histogram2d(on_wall[:, 0], on_wall[:, 1], bins=edges, weights=weight)[0]
    counts = np.histogram2d(at[:, 0], at[:, 1], bins=edges)[0]
    with np.errstate(invalid="ignore", divide="ignore"):
        density = np.where(wall > 0.0, counts / wall, np.nan)
    middles = flat(surface.centres)
    i, j = (np.clip(np.searchsorted(edges[k], middles[:, k]) - 1, 0, bins[k] - 1) for k in range(2))
    names = ("along", "around") if rolled else ("along", "across")
    return Deposits(
        surface.name, len(x), total, names, (edges[0], edges[1]), density, np.nan_to_num(density[i, j]), at
    )


def _spread(surface: Surface, areas: Floats) -> tuple[Floats, Floats]:
    """Points spread evenly over each triangle, and the area that each stands for."""
    order = max(1, round(np.sqrt(_SAMPLES / max(1, len(areas)))))
    i, j = (index.ravel() for index in np.meshgrid(np.arange(order), np.arange(order)))
    inside = i + j < order
    u, v = (i[inside] + 1.0 / 3.0) / order, (j[inside] + 1.0 / 3.0) / order
    weights = np.stack([1.0 - u - v, u, v], axis=1)
    points = np.einsum("sv,tvi->tsi", weights, surface.points[surface.triangles])
    return points.reshape(-1, 3), np.repeat(areas / len(weights), len(weights))


def _bins(side: Floats, n: int) -> tuple[int, int]:
    """Bins along both sides, about as long as wide, for so many particles."""
    cells = max(1.0, n / _WANTED)
    ratio = np.sqrt(max(side[0], 1e-300) / max(side[1], 1e-300))
    both = np.clip(np.round(np.sqrt(cells) * np.array([ratio, 1.0 / ratio])), 1, _MOST_BINS).astype(int)
    return int(both[0]), int(both[1])
