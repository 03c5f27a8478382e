"""Walls around a point as planes, behind which a particle has images."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, norm, vector_product
from foamprb.compile.link import separate
from foamprb.flow.base import NO_PLANES, Planes
from foamprb.flow.mesh.arrays import MeshArrays, arm
from foamprb.flow.walk import inward, nearest_point

_SAME_WALL = math.sqrt(0.5)
_ON_EDGE = 1e-9


def walls(flow: MeshArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """Return the walls around x that are nearer than ``cut`` (m).

    A wall is a boundary triangle on which the perpendicular from x ends, or the nearest point of all if it
    lies on an edge or a corner. Walls whose normals are within 45° of each other are facets of one curved
    wall, of which the nearest counts. Of more than three walls the three nearest count.

    Parameters
    ----------
    chosen
        1 for each patch that counts as a wall, else 0.
    """
    cell = flow.tets[host, 0] - flow.n_points
    begin, end = flow.seen_start[cell], flow.seen_start[cell + 1]
    if begin == end:
        return NO_PLANES
    return planes_among(flow, begin, end, x, cut, chosen)


@separate
def planes_among(
    flow: MeshArrays, begin: int, end: int, x: Vector, cut: float, chosen: NDArray[np.int8]
) -> Planes:
    """Return the walls among the entries ``begin`` to ``end`` of ``seen``; see :func:`walls`."""
    planes = NO_PLANES
    nearest, towards = cut, (0.0, 0.0, 0.0)
    nodes = flow.nodes
    for k in range(begin, end):
        entry = flow.seen[k]
        triangle = entry >> 1
        if chosen[flow.triangle_patch[triangle]] == 0:
            continue
        a = flow.triangles[triangle, 0]
        ra = arm(nodes, a, x)
        n = inward(flow, triangle)
        h = -inner(n, ra)
        # x is behind the wall, or the wall is beyond the cut.
        if h <= 0.0 or h >= cut or _known(planes, h, n):
            continue
        b, c = flow.triangles[triangle, 1], flow.triangles[triangle, 2]
        rb, rc = arm(nodes, b, x), arm(nodes, c, x)
        if _over(n, ra, rb, rc):
            planes = _with(planes, h, n)
        elif entry & 1 and h < min(nearest, planes.h1, planes.h2, planes.h3):
            p = nearest_point(ra, rb, rc)
            distance = norm(p)
            if distance < nearest:
                nearest, towards = distance, (-p[0] / distance, -p[1] / distance, -p[2] / distance)
    if nearest < cut and nearest < min(planes.h1, planes.h2, planes.h3):
        planes = _with(planes, nearest, towards)
    return planes


def _known(planes: Planes, h: float, n: Vector) -> bool:
    """Return True if a wall at the distance h belongs to a wall that was found and is not nearer."""
    return bool(
        (h >= planes.h1 and inner(n, planes.n1) > _SAME_WALL)
        or (h >= planes.h2 and inner(n, planes.n2) > _SAME_WALL)
        or (h >= planes.h3 and inner(n, planes.n3) > _SAME_WALL)
    )


def _over(n: Vector, a: Vector, b: Vector, c: Vector) -> bool:
    """Return True if the perpendicular from the origin to the plane of a triangle of normal n ends in it."""
    p = inner(n, vector_product(a, b))
    q = inner(n, vector_product(b, c))
    r = inner(n, vector_product(c, a))
    least = -_ON_EDGE * abs(p + q + r)
    return bool((p >= least and q >= least and r >= least) or (p <= -least and q <= -least and r <= -least))


def _with(planes: Planes, h: float, n: Vector) -> Planes:
    """Return the planes with one more wall; a facet of a wall replaces it if it is nearer."""
    h1, n1, h2, n2, h3, n3 = planes
    if inner(n, n1) > _SAME_WALL:
        return Planes(h, n, h2, n2, h3, n3) if h < h1 else planes
    if inner(n, n2) > _SAME_WALL:
        return Planes(h1, n1, h, n, h3, n3) if h < h2 else planes
    if inner(n, n3) > _SAME_WALL:
        return Planes(h1, n1, h2, n2, h, n) if h < h3 else planes
    # Replace the farthest; an empty place is infinitely far.
    if h1 >= h2 and h1 >= h3:
        return Planes(h, n, h2, n2, h3, n3) if h < h1 else planes
    if h2 >= h3:
        return Planes(h1, n1, h, n, h3, n3) if h < h2 else planes
    return Planes(h1, n1, h2, n2, h, n) if h < h3 else planes
