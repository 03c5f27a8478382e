"""Particles that stick to walls: their density there, and how far along the flow they come."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.results.vtk import triangles_data
from foamprb.view.geometry import Geometry, Surface, filtered, triangles_of
from foamprb.view.results import Table

Floats = NDArray[np.float64]

FEW = 30
"""Fewer particles than this on a wall give no density."""
_PER_CIRCLE = 4.0
"""Mean number of particles in the circle over which the density is a mean."""
_SAMPLES, _NEIGHBOURS = 20_000, 16
"""Number of points over which a boundary is distributed, and of the points to which ways lead from each."""
_FINEST, _WIDEST = 0.02, 4.0
"""Length of the edges of a divided wall over the root of its area, at least, and radius of a circle over the
distance of the points in it, at least."""


def ends_of(fates: Table) -> Floats:
    """Return the places where particles ended, (n, 3), m."""
    return np.stack([fates[key] for key in ("x1", "y1", "z1")], axis=1)


def painted(geometry: Geometry, fates: Table) -> Geometry:
    """Return a boundary whose walls have the density of the particles that stuck there."""
    if "x1" not in fates:
        return geometry
    x, on = ends_of(fates), np.where(fates["fate"] == "stuck", fates["patch"], "")
    return geometry._replace(surfaces=tuple(with_density(s, x[on == s.name]) for s in geometry.surfaces))


def with_density(wall: Surface, x: Floats) -> Surface:
    """Return a wall with the number of particles per area at its points, whose long triangles are divided.

    The density is the mean over a circle that holds :data:`_PER_CIRCLE` particles on average; with fewer
    than :data:`FEW` particles, which are at ``x``, (n, 3), m, there is none.
    """
    if len(x) < FEW:
        return wall
    from scipy.spatial import cKDTree
    from vtkmodules.vtkFiltersModeling import vtkAdaptiveSubdivisionFilter

    area = float(np.linalg.norm(wall.areas, axis=1).sum())
    samples, side = spread_over([wall]), np.sqrt(area)
    radius = side * max(np.sqrt(_PER_CIRCLE / (np.pi * len(x))), _WIDEST / np.sqrt(_SAMPLES))
    tree = cKDTree(samples)
    finer = vtkAdaptiveSubdivisionFilter()
    finer.SetMaximumEdgeLength(max(0.7 * radius, _FINEST * side))
    points, triangles = triangles_of(filtered(finer, triangles_data(wall.points, wall.triangles)))
    # The centres of the particles are off the wall.
    on_wall = cKDTree(samples[tree.query(x)[1]])
    number, share = (t.query_ball_point(points, radius, return_length=True) for t in (on_wall, tree))
    density = number / (np.maximum(share, 1) * area / len(samples))
    return wall._replace(points=points, triangles=triangles, density=density)


def ways(geometry: Geometry, starts: Floats, ends: Floats) -> tuple[Floats, float]:
    """Return the shortest ways along the boundary from the nearest of some places to others, (n,), m.

    The places are (k, 3) and (n, 3), m. The longest way to any point of the boundary, m, comes with them.
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import dijkstra
    from scipy.spatial import cKDTree

    points = spread_over(geometry.surfaces)
    tree = cKDTree(points)
    lengths, near = tree.query(points, min(_NEIGHBOURS, len(points)))
    start = np.arange(len(points) + 1) * near.shape[1]
    graph = csr_matrix((np.ravel(lengths), near.ravel(), start), shape=(len(points), len(points)))
    sources = np.unique(tree.query(starts)[1])
    way = dijkstra(graph, directed=False, indices=sources, min_only=True)
    # Obstacles that touch no other boundary are reached from the side.
    reached = np.isfinite(way)
    at = cKDTree(points[reached]).query(ends)[1]
    return way[reached][at], float(way[reached].max())


def spread_over(surfaces: tuple[Surface, ...] | list[Surface]) -> Floats:
    """Return points that are spread evenly over surfaces, (:data:`_SAMPLES`, 3), m."""
    corners = np.concatenate([surface.points[surface.triangles] for surface in surfaces])
    areas = np.concatenate([np.linalg.norm(surface.areas, axis=1) for surface in surfaces])
    total, k = np.cumsum(areas), np.arange(_SAMPLES) + 0.5
    rows = np.minimum(np.searchsorted(total, k / _SAMPLES * total[-1]), len(areas) - 1)
    # Additive recurrence of the plastic number, folded into a triangle (Roberts 2018).
    u, v = (k * 0.7548776662466927) % 1.0, (k * 0.5698402909980532) % 1.0
    over = u + v > 1.0
    u, v = np.where(over, 1.0 - u, u), np.where(over, 1.0 - v, v)
    weights = np.stack([1.0 - u - v, u, v], axis=1)
    return np.asarray(np.einsum("sv,svi->si", weights, corners[rows]))
