"""Triangles of coupled patches, and the triangles of the neighbours on which particles continue."""

from __future__ import annotations

import numpy as np

from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.lists import Index, ragged, starts
from foamprb.flow.mesh.mesh import Mesh

# Factor of a triangle's radius: surfaces that are cut differently lie a little apart.
_MARGIN = 1.1
# Factor of a search radius, so that round-off of the search loses no pair.
_WIDER = 1.0 + 1e-9


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
