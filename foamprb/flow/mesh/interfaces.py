"""Coupled patches: triangles of the neighbours on which particles continue, and faces that share an area."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.tensor import Vector, inner, minus, plus, scale_vector, vector_product
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import point
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.lists import Index, ragged, starts
from foamprb.flow.mesh.mesh import Mesh

# Factor of a triangle's radius: surfaces that are cut differently lie a little apart.
_MARGIN = 1.1
# Factor of a search radius, so that round-off of the search loses no pair.
_WIDER = 1.0 + 1e-9
# Smallest part of a triangle that counts as shared with another one.
_LEAST_SHARED = 1e-6


class FacePairs(NamedTuple):
    """Pairs of coupled boundary faces that share an area, listed for both, in the order of the first."""

    start: Index
    """(n_boundary + 1,) the first pair of each face."""
    faces: Index
    """(n,)."""
    others: Index
    """(n,) faces that continue them."""
    parts: Floats
    """(n,) part of the face in the area; the parts of a face add up to 1."""
    of_others: Floats
    """(n,) part of the other face."""

    def crossing(self, fluxes: Floats) -> Floats:
        """Return the mean of the fluxes (n_boundary,) that leave the two faces through their pairs, (n,)."""
        return 0.5 * (fluxes[self.faces] * self.parts - fluxes[self.others] * self.of_others)

    def total(self, values: Floats) -> Floats:
        """Return the sums of values of the pairs (n,) of each boundary face, (n_boundary,)."""
        total = np.zeros(len(self.start) - 1)
        np.add.at(total, self.faces, values)
        return total


def face_pairs(mesh: Mesh) -> FacePairs:
    """Return the pairs of coupled faces; a face that lies on no other one has no pair."""
    nothing = np.empty(0, dtype=np.intp)
    pairs = [(nothing, nothing, np.empty(0))]
    for coupling in mesh.couplings:
        if coupling.matching:
            pairs.append((coupling.faces, coupling.partners, np.ones(len(coupling.faces))))
        elif coupling.patch < coupling.other:
            here, there, area = _shared_areas(mesh, coupling)
            pairs += [(here, there, area), (there, here, area)]
    here, there, area = map(np.concatenate, zip(*pairs, strict=True))
    order = np.lexsort((there, here))
    here, there, area = here[order], there[order], area[order]
    n = len(mesh.boundary_centres)
    total = np.bincount(here, area, n)
    start = starts(np.bincount(here, minlength=n))
    return FacePairs(start, here, there, area / total[here], area / total[there])


def _shared_areas(mesh: Mesh, coupling: Coupling) -> tuple[Index, Index, Floats]:
    """Return the pairs of faces of two patches that lie on each other, and the area that they share, m²."""
    here, start, there = overlaps(mesh, coupling)
    corners = mesh.points[mesh.triangles[here]] @ coupling.turn.T + coupling.shift
    areas = np.empty(len(there))
    # Each of three cuts at most doubles the number of corners.
    link(share_areas)(corners, start, mesh.points[mesh.triangles[there]], areas, np.empty((2, 24, 3)))
    rows = np.repeat(here, np.diff(start))
    shared = areas > 0.0
    pairs, place = np.unique(
        np.stack([mesh.triangle_face[rows[shared]], mesh.triangle_face[there[shared]]]),
        axis=1, return_inverse=True,
    )  # fmt: skip
    own, other = pairs.astype(np.intp)
    total = np.zeros(len(own))
    np.add.at(total, place.reshape(-1), areas[shared])
    return own, other, total


def share_areas(corners: Floats, start: Ints, others: Floats, areas: Floats, polygons: Floats) -> None:
    """Compute the area that each triangle (n, 3, 3) shares with each of its list of others, m².

    Slivers of triangles that only touch have the area 0. ``polygons`` is working memory.
    """
    polygon, clipped = polygons
    for t in range(len(corners)):
        p = corners[t]
        n = vector_product(minus(point(p, 1), point(p, 0)), minus(point(p, 2), point(p, 0)))
        size = max(np.sqrt(inner(n, n)), 1e-300)
        for k in range(start[t], start[t + 1]):
            count = 3
            for i in range(3):
                polygon[i, 0], polygon[i, 1], polygon[i, 2] = point(others[k], i)
            for side in range(3):
                a, b = point(p, side), point(p, (side + 1) % 3)
                count = clip(polygon, count, a, vector_product(n, minus(b, a)), clipped)
                polygon, clipped = clipped, polygon
            total = 0.0
            for i in range(1, count - 1):
                o = point(polygon, 0)
                arms = minus(point(polygon, i), o), minus(point(polygon, i + 1), o)
                total += 0.5 * inner(n, vector_product(arms[0], arms[1])) / size
            areas[k] = abs(total) if abs(total) > 0.5 * _LEAST_SHARED * size else 0.0


def clip(polygon: Floats, count: int, place: Vector, normal: Vector, clipped: Floats) -> int:
    """Cut a polygon by a plane; keep the side to which the normal points (Sutherland and Hodgman 1974).

    Returns
    -------
    The number of points of ``clipped``.
    """
    n = 0
    for i in range(count):
        a, b = point(polygon, i), point(polygon, (i + 1) % count)
        above, next_above = inner(normal, minus(a, place)), inner(normal, minus(b, place))
        if above >= 0.0:
            clipped[n, 0], clipped[n, 1], clipped[n, 2] = a
            n += 1
        if (above >= 0.0) != (next_above >= 0.0):
            clipped[n, 0], clipped[n, 1], clipped[n, 2] = plus(
                a, scale_vector(above / (above - next_above), minus(b, a))
            )
            n += 1
    return n


def triangles_across(mesh: Mesh) -> tuple[Ints, Ints]:
    """Return ``across`` and ``partners`` of :class:`foamprb.flow.mesh.arrays.MeshArrays`."""
    count = np.bincount(mesh.triangle_face, minlength=len(mesh.boundary_centres))
    start = np.concatenate([[0], np.cumsum(count)])
    partner = np.full(len(mesh.boundary_centres), -1)
    for coupling in mesh.couplings:
        partner[coupling.faces] = coupling.partners
    other = partner[mesh.triangle_face]
    # The triangles of a face are consecutive.
    across = np.stack([start[other], start[other + 1]], axis=1)
    across[other < 0] = 0
    partners = [np.arange(len(mesh.triangle_face))]
    first = len(partners[0])
    for coupling in mesh.couplings:
        if not coupling.matching:
            own, begin, lists = overlaps(mesh, coupling)
            across[own] = first + np.stack([begin[:-1], begin[1:]], axis=1)
            partners.append(lists)
            first += len(lists)
    return across.astype(np.int32), np.concatenate(partners).astype(np.int32)


def motions_of_patches(mesh: Mesh) -> Floats:
    """Return ``motions`` of :class:`foamprb.flow.mesh.arrays.MeshArrays`."""
    motions = np.zeros((len(mesh.patches), 12))
    motions[:, [0, 4, 8]] = 1.0
    for coupling in mesh.couplings:
        motions[coupling.patch] = [*coupling.turn.ravel(), *coupling.shift]
    return motions


def overlaps(mesh: Mesh, coupling: Coupling) -> tuple[Index, Index, Index]:
    """Find the triangles of the other patch that each triangle of a patch may overlap.

    Returns
    -------
    triangles, start, others
        Triangles (n,) of the first patch; start (n + 1,) of the list of each in ``others``. A list holds the
        triangles whose circles about their middles meet the circle of the first, and those of the partner of
        its face.
    """
    here = np.flatnonzero(mesh.triangle_patch == coupling.patch)
    there = np.flatnonzero(mesh.triangle_patch == coupling.other)
    own = _circles(mesh.points[mesh.triangles[here]] @ coupling.turn.T + coupling.shift)
    rows, columns = pairs_within(*own, *_circles(mesh.points[mesh.triangles[there]]), _MARGIN)
    partner = np.full(len(mesh.boundary_centres), -1)
    partner[coupling.faces] = coupling.partners
    partners, faces = partner[mesh.triangle_face[here]], mesh.triangle_face[there]
    first, end = (np.searchsorted(faces, partners, side=side) for side in ("left", "right"))
    rows = np.concatenate([rows, np.repeat(np.arange(len(here)), end - first)])
    columns = np.concatenate([columns, ragged(first, end - first)])
    pairs = np.unique(np.stack([rows, columns], axis=1), axis=0)
    return here, starts(np.bincount(pairs[:, 0], minlength=len(here))), there[pairs[:, 1]]


def pairs_within(
    middle: Floats, radius: Floats, others: Floats, reach: Floats, margin: float
) -> tuple[Index, Index]:
    """Return the pairs of spheres that meet if they are larger by a factor.

    Parameters
    ----------
    middle, radius
        Centres (n, 3) and radii (n,), m.
    others, reach
        Those of the others.
    margin
        The factor.
    """
    from scipy.spatial import KDTree

    # Sizes are searched octave by octave, so that one large sphere does not widen the search for all.
    octave = np.floor(np.log2(np.maximum(reach, 1e-300))).astype(int)
    rows, columns = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
    for size in np.unique(octave):
        some = np.flatnonzero(octave == size)
        far = _WIDER * margin * (radius + reach[some].max())
        lists = KDTree(others[some]).query_ball_point(middle, far)
        row = np.repeat(np.arange(len(middle)), [len(found) for found in lists])
        column = some[np.concatenate([columns[0], *map(np.asarray, lists)]).astype(np.intp)]
        apart = np.linalg.norm(middle[row] - others[column], axis=1)
        near = apart <= margin * (radius[row] + reach[column])
        rows.append(row[near])
        columns.append(column[near])
    return np.concatenate(rows), np.concatenate(columns)


def _circles(corners: Floats) -> tuple[Floats, Floats]:
    """Return the middles (n, 3) of triangles (n, 3, 3), and the distances of their farthest corners."""
    middle = corners.mean(axis=1)
    return middle, np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
