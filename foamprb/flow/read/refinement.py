"""Meshes that are refined and coarsened in time: the finest cells of all times, and values at their nodes."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import PolyMesh
from foamprb.flow.mesh.geometry import faces_of
from foamprb.flow.mesh.lists import int32, starts, take_lists
from foamprb.flow.mesh.mesh import Mesh, assemble
from foamprb.flow.meshflow import MeshFlow

_FINER = 0.75
"""Largest volume of a part of a cell, over that of the cell."""
_CLOSE = 1e-3
"""Largest distance between points that are the same, over the width of the smallest cell, or of an edge."""
_SAME_VOLUME = 1e-4
"""Largest relative difference between the volumes of meshes of the same region."""
_MOST_LEVELS = 10
_INWARD = (0.0, 1e-9, 1e-6, 1e-3, 0.03)
"""Shares of the way to the middle of the cells around that a node moves until it lies within a mesh."""


class NotPartsError(InputError):
    """Cells of two meshes that are not parts of each other."""


class _Side(NamedTuple):
    """Faces of one of two meshes, in numbers of the cells and points of both."""

    start: NDArray[np.intp]
    points: NDArray[np.integer[Any]]
    owner: NDArray[np.int64]
    neighbour: NDArray[np.int64]
    """−1 on the boundary."""
    patch: NDArray[np.int64]
    """−1 inside."""


def finest(a: Mesh, b: Mesh, poly: PolyMesh, where: str) -> Mesh:
    """Return a mesh with the cells of two, of which each divides cells of the other one.

    Where one mesh is finer, its cells are taken. Faces between cells of both belong to the finer mesh; points
    on edges of its neighbours are inserted there.

    Parameters
    ----------
    a, b
        The meshes.
    poly
        Patches of ``b``, before they are coupled.
    where
        Name of ``b``, for messages.

    Raises
    ------
    NotPartsError
        The meshes cover different regions, or their cells are not parts of each other.
    """
    in_a = cells_at(a, b.centres)
    finer = (in_a >= 0) & (b.volumes < _FINER * a.volumes[in_a])
    kept = np.ones(a.n_cells, dtype=bool)
    kept[in_a[finer]] = False
    volume = float(a.volumes[kept].sum() + b.volumes[finer].sum())
    total, other = float(a.volumes.sum()), float(b.volumes.sum())
    distance, nearest = tree_of(a.points).query(b.points)
    new = distance > _CLOSE * float(np.cbrt(min(a.volumes.min(), b.volumes.min())))
    of_finer = np.zeros(b.n_points, dtype=bool)
    of_finer[b.cell_points[np.repeat(finer, np.diff(b.cell_point_start))]] = True
    fits = max(abs(volume - total), abs(other - total)) <= _SAME_VOLUME * total
    if not fits or (in_a < 0).any() or (new & ~of_finer).any():
        raise NotPartsError(f"{where}: the cells are no parts of those of other times.")
    if not finer.any():
        return a
    number_a, number_b = np.cumsum(kept) - 1, kept.sum() + np.cumsum(finer) - 1
    point = np.where(new, a.n_points + np.cumsum(new) - 1, nearest)
    points = np.concatenate([a.points, b.points[new]])

    left, right = _faces(a), _faces(b)
    chosen = kept[left.owner] & ((left.neighbour < 0) | kept[left.neighbour])
    ours, theirs = finer[right.owner], (right.neighbour >= 0) & finer[right.neighbour]
    both, mixed = ours & (theirs | (right.neighbour < 0)), (right.neighbour >= 0) & (ours ^ theirs)
    # Beyond a face of one fine cell lies a cell of a.
    fine = np.where(ours, right.owner, right.neighbour)[mixed]
    centres = _means(b.points, right.start, right.points)[mixed]
    beyond = cells_at(a, centres + 0.2 * (centres - b.centres[fine]))
    parts = [
        _taken(left, chosen, number_a[left.owner], number_a[left.neighbour]),
        _taken(right, both, number_b[right.owner], number_b[right.neighbour]),
    ]
    between = _taken(right, mixed, right.owner, right.neighbour)
    here, there = number_b[fine], number_a[beyond]
    own = np.where(ours[mixed], here, there), np.where(ours[mixed], there, here)
    parts.append(between._replace(owner=own[0], neighbour=own[1]))
    parts[1:] = [part._replace(points=point[part.points]) for part in parts[1:]]
    counts = np.concatenate([np.diff(part.start) for part in parts])
    lists = np.concatenate([part.points for part in parts])
    start, lists = _with_hanging_points(points, starts(counts), lists)
    owner, neighbour, patch = (np.concatenate([part[k] for part in parts]) for k in (2, 3, 4))
    order = np.argsort(patch, kind="stable")
    start, lists = take_lists(start, lists, order)
    n_cells, inside = int(kept.sum() + finer.sum()), patch[order] < 0
    faces = faces_of(
        int32(start), int32(lists), int32(owner[order]), int32(neighbour[order][inside]), n_cells
    )
    counts = np.bincount(patch[patch >= 0], minlength=len(poly.patches))
    return assemble(PolyMesh(points, faces, poly.patches, starts(counts)), where)


def cells_at(mesh: Mesh, x: Floats) -> NDArray[np.int64]:
    """Return the cells (n,) that hold points (n, 3), −1 for none."""
    flow = MeshFlow(mesh, None, None)
    hosts = flow.locate(x)
    return np.where(hosts < 0, -1, flow.cell_of(np.maximum(hosts, 0)))


def _faces(mesh: Mesh) -> _Side:
    n, outside = mesh.n_internal, len(mesh.owner) - mesh.n_internal
    patches = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
    return _Side(
        np.asarray(mesh.face_start, dtype=np.intp),
        np.asarray(mesh.face_points, dtype=np.int64),
        np.asarray(mesh.owner, dtype=np.int64),
        np.concatenate([mesh.neighbour[:n], np.full(outside, -1)]).astype(np.int64),
        np.concatenate([np.full(n, -1), patches]).astype(np.int64),
    )


def _means(points: Floats, start: NDArray[np.intp], lists: NDArray[np.integer[Any]]) -> Floats:
    """Return the means of the points of faces."""
    means: Floats = np.add.reduceat(points[lists], start[:-1]) / np.diff(start)[:, None]
    return means


def tree_of(points: Floats) -> Any:
    """Return a tree by which the nearest points are found."""
    from scipy.spatial import cKDTree

    return cKDTree(points)


def _taken(
    side: _Side, rows: NDArray[np.bool_], owner: NDArray[np.int64], neighbour: NDArray[np.int64]
) -> _Side:
    """Return some of the faces, with other numbers of their cells."""
    start, points = take_lists(side.start, side.points, np.flatnonzero(rows))
    beside = np.where(side.neighbour < 0, -1, neighbour)
    return _Side(start, points, owner[rows], beside[rows], side.patch[rows])


def _with_hanging_points(
    points: Floats, start: NDArray[np.intp], lists: NDArray[np.integer[Any]]
) -> tuple[NDArray[np.intp], NDArray[np.integer[Any]]]:
    """Return faces with the points that lie in the middle of their edges."""
    used = np.unique(lists)
    tree = tree_of(points[used])
    for _ in range(_MOST_LEVELS):
        following = np.arange(1, len(lists) + 1)
        following[start[1:] - 1] = start[:-1]
        p, q = points[lists], points[lists[following]]
        distance, nearest = map(np.asarray, tree.query(0.5 * (p + q)))
        inserted = np.flatnonzero(distance < _CLOSE * np.linalg.norm(q - p, axis=1))
        if len(inserted) == 0:
            break
        face = np.repeat(np.arange(len(start) - 1), np.diff(start))
        counts = np.diff(start) + np.bincount(face[inserted], minlength=len(start) - 1)
        lists = np.insert(lists, inserted + 1, used[nearest[inserted]])
        start = starts(counts)
    return start, lists


class Resampling:
    """Linear map of values from the nodes of a mesh ``there`` to those of another one of the same region.

    InputError if nodes lie outside ``there``; ``where`` names it.
    """

    def __init__(self, mesh: Mesh, there: Mesh, where: str) -> None:
        flow, nodes = MeshFlow(there, None, None), mesh.nodes
        cells = np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_point_start))
        counts = np.maximum(np.bincount(mesh.cell_points, minlength=mesh.n_points), 1)
        sums = [np.bincount(mesh.cell_points, mesh.centres[cells, k], mesh.n_points) for k in range(3)]
        inner = np.concatenate([np.stack(sums, axis=1) / counts[:, None], mesh.centres])
        hosts = np.full(len(nodes), -1, dtype=np.int32)
        for share in _INWARD:
            lost = np.flatnonzero(hosts < 0)
            hosts[lost] = flow.locate(nodes[lost] + share * (inner[lost] - nodes[lost]))
        if (hosts < 0).any():
            raise InputError(
                f"{where}: the mesh covers another region than at other times: {(hosts < 0).sum()} of "
                f"{len(hosts)} points of these lie outside. Allowed: a region whose boundary is at rest."
            )
        self._flow, self._rows = flow, flow.mesh.tets[hosts]
        self._arms = nodes[:, None] - flow.mesh.nodes[self._rows]
        # The weights of a point that lies outside by round-off extrapolate.
        sides = np.swapaxes(self._arms[:, :1] - self._arms[:, 1:], 1, 2)
        w = np.linalg.solve(sides, self._arms[:, 0, :, None])[:, :, 0]
        self._weights = np.concatenate([1.0 - w.sum(axis=1, keepdims=True), w], axis=1)

    def __call__(self, values: NDArray[np.generic]) -> NDArray[Any]:
        """Return values at the nodes, linear in each tetrahedron of ``there``."""
        there: NDArray[Any] = self._flow.widened(values)[self._rows]
        at_nodes: NDArray[Any] = np.einsum("ni,ni...->n...", self._weights, there)
        return at_nodes

    def velocities(self, u: Floats, l: Floats) -> tuple[Floats, Floats]:
        """Return velocities, m/s, and their gradients, 1/s, at the nodes.

        The velocity is quadratic, see :func:`foamprb.flow.walk.interpolate`.
        """
        bend = np.einsum("ni,niab,nib->na", self._weights, self._flow.widened(l)[self._rows], self._arms)
        return self(u) + 0.5 * bend, self(l)


def same_mesh(a: Mesh, b: Mesh) -> bool:
    """Return whether two meshes have the same points and faces."""
    names = ("points", "face_start", "face_points", "owner", "neighbour")
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in names)
