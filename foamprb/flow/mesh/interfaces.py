"""Triangles of a cyclicAMI patch, and those of its neighbour on which each may go on."""

from __future__ import annotations

import numpy as np
from scipy.spatial import KDTree

from foamprb.flow.base import Floats
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.lists import Index, starts
from foamprb.flow.mesh.mesh import Mesh

__all__ = ["overlaps"]

# Of a triangle's radius: surfaces cut differently lie a little apart.
_MARGIN = 1.1


def overlaps(mesh: Mesh, coupling: Coupling) -> tuple[Index, Index, Index]:
    """Find the triangles of the other patch that each triangle of a patch may overlap.

    Returns
    -------
    triangles, start, others
        The triangles (n,) of the first patch; where the list of each begins in ``others``, (n + 1,). A list
        holds all triangles whose circles about their middle reach that of the first, and the nearest one.
    """
    here = np.flatnonzero(mesh.triangle_patch == coupling.patch)
    there = np.flatnonzero(mesh.triangle_patch == coupling.other)
    middle, radius = _circles(mesh.points[mesh.triangles[here]] @ coupling.turn.T + coupling.shift)
    others, reach = _circles(mesh.points[mesh.triangles[there]])
    tree = KDTree(others)
    # Small triangles need not be asked for the sake of a large one elsewhere: by halves of the radius.
    octave = np.floor(np.log2(np.maximum(reach, 1e-300))).astype(int)
    rows, columns = [np.arange(len(here))], [np.asarray(tree.query(middle)[1])]
    for size in np.unique(octave):
        some = np.flatnonzero(octave == size)
        lists = KDTree(others[some]).query_ball_point(middle, _MARGIN * (radius + reach[some].max()))
        row = np.repeat(np.arange(len(here)), [len(found) for found in lists])
        column = some[np.concatenate([np.empty(0, dtype=np.intp), *map(np.asarray, lists)]).astype(np.intp)]
        near = np.linalg.norm(middle[row] - others[column], axis=1) <= _MARGIN * (radius[row] + reach[column])
        rows.append(row[near])
        columns.append(column[near])
    pairs = np.unique(np.stack([np.concatenate(rows), np.concatenate(columns)], axis=1), axis=0)
    return here, starts(np.bincount(pairs[:, 0], minlength=len(here))), there[pairs[:, 1]]


def _circles(corners: Floats) -> tuple[Floats, Floats]:
    """Middles (n, 3) of triangles (n, 3, 3), and the distances of their farthest corners."""
    middle = corners.mean(axis=1)
    return middle, np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
