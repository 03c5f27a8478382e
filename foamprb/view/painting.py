"""Deposits as a density on the walls: particles per area, by a kernel around each place."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from foamprb.flow.base import WALLS
from foamprb.view.colours import round_limits
from foamprb.view.geometry import Geometry
from foamprb.view.results import Table

__all__ = ["Painting", "painting_of"]

Floats = NDArray[np.float64]

FEW = 100
"""Fewer deposits are marked one by one."""
_MOST = 20_000
"""Largest number of places; of more deposits as many are taken, evenly."""
_WITHIN = 8.0
"""Mean number of deposits in the area of the kernel."""
CELLS, PER_WIDTH, REACH = 200_000, 1.5, 3.0
"""Cells of the grid of a page, cells in a width of the kernel, and widths beyond which it is zero."""
_WIDEST = 0.1
"""Largest width of the kernel, in second longest sides of the geometry."""


class Painting(NamedTuple):
    """Places of deposits, and how their density is drawn."""

    places: Floats
    """(v, 3), m, in order of time."""
    times: Floats
    """(v,), s."""
    each: float
    """Deposits that a place stands for."""
    width: float
    """Standard deviation of the kernel, m."""
    most: float
    """Density at which the colours end, 1/m²."""

    @property
    def unit(self) -> tuple[str, float]:
        """Unit in which densities are written, and its number in 1/m²."""
        return ("1/mm2", 1e-6) if self.most > 1e5 else ("1/m2", 1.0)

    def density(self, points: Floats, time: float) -> Floats:
        """Return the deposits per area at points (n, 3) of the walls at a time, (n,), 1/m²."""
        here = self.places[: np.searchsorted(self.times, time, side="right")]
        if len(here) == 0:
            return np.zeros(len(points))
        near = cKDTree(points).sparse_distance_matrix(
            cKDTree(here), REACH * self.width, output_type="coo_matrix"
        )
        weight = self.each / (2.0 * np.pi * self.width**2) * np.exp(-0.5 * (near.data / self.width) ** 2)
        return np.bincount(near.row, weight, len(points)).astype(np.float64)


def painting_of(fates: Table | None, geometry: Geometry | None) -> Painting | None:
    """Return the painting of all deposits of a run; None for few of them, and in a two-dimensional case."""
    if fates is None or geometry is None or geometry.flat is not None or "x1" not in fates:
        return None
    stuck = np.flatnonzero(fates["fate"] == "stuck")
    walls = [surface for surface in geometry.surfaces if surface.type in WALLS]
    if len(stuck) < FEW or not walls:
        return None
    met = [surface for surface in walls if (fates["patch"][stuck] == surface.name).any()] or walls
    area = sum(float(np.linalg.norm(surface.areas, axis=1).sum()) for surface in met)
    sides = np.ptp(geometry.points, axis=0)
    least = PER_WIDTH * float((sides.prod() / CELLS) ** (1.0 / 3.0))
    wanted = float(np.sqrt(_WITHIN * area / (4.0 * np.pi * len(stuck))))
    width = max(least, min(wanted, _WIDEST * float(np.sort(sides)[1])))
    each = max(1.0, len(stuck) / _MOST)
    rows = stuck[(np.arange(int(len(stuck) / each)) * each).astype(np.int64)]
    rows = rows[np.argsort(fates["t1"][rows], kind="stable")]
    places = np.stack([fates[key][rows] for key in ("x1", "y1", "z1")], axis=1)
    painting = Painting(places, fates["t1"][rows].astype(np.float64), each, width, 1.0)
    some = places[:: max(1, len(places) // 2000)]
    return painting._replace(most=round_limits(0.0, float(painting.density(some, np.inf).max()))[1])
