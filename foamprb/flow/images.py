"""Images of cells beyond patches over which a field continues: mirrors, wedges and cyclic patches."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from foamprb.flow.base import Floats
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.lists import Index, take_lists
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import PatchKind

SEAM = 0.05
"""Largest distance of a point from its image beyond a coupled patch, over the width of a face."""


def _unchanged(values: Floats) -> Floats:
    return values


class Images:
    """Images of cells beyond the patches over which the field continues."""

    def __init__(self, mesh: Mesh) -> None:
        owner = mesh.owner[mesh.n_internal :].astype(np.intp)
        areas = mesh.boundary_areas
        normals = areas / np.maximum(np.linalg.norm(areas, axis=1), 1e-300)[:, None]
        faces, cells, places, turns = [], [], [], []
        self._planes, self._seams = [], []
        for index, patch in enumerate(mesh.patches):
            own = np.arange(mesh.patch_start[index], mesh.patch_start[index + 1])
            if patch.kind is not PatchKind.MIRROR or len(own) == 0:
                continue
            n = normals[own]
            away = np.einsum("fi,fi->f", mesh.boundary_centres[own] - mesh.centres[owner[own]], n)
            faces.append(own)
            cells.append(owner[own])
            places.append(mesh.centres[owner[own]] + 2.0 * away[:, None] * n)
            mirror = np.eye(3) - 2.0 * n[:, :, None] * n[:, None, :]
            # On a two-dimensional mesh the flow is the same at every height.
            turns.append(np.broadcast_to(np.eye(3), mirror.shape) if patch.type == "empty" else mirror)
            if patch.type != "empty":
                self._planes.append(_mean_normals(mesh, own, n))
        for coupling in mesh.couplings:
            faces.append(coupling.faces)
            cells.append(owner[coupling.partners])
            # Backwards: the cells before the second patch lie beyond the first.
            places.append((mesh.centres[cells[-1]] - coupling.shift) @ coupling.turn)
            turns.append(np.broadcast_to(coupling.turn.T, (len(coupling.faces), 3, 3)))
            if coupling.patch < coupling.other and len(coupling.faces):
                self._seams.append(seam(mesh, coupling))
        self.faces: Index = np.concatenate([np.empty(0, dtype=np.intp), *faces])
        self.cells: Index = np.concatenate([np.empty(0, dtype=np.intp), *cells])
        self.places: Floats = np.concatenate([np.empty((0, 3)), *places])
        self._turns: Floats = np.concatenate([np.empty((0, 3, 3)), *turns])

    def turned(self, values: Floats, read: Callable[[Floats], Floats] = _unchanged) -> Floats:
        """Return tensors of the images (n, 3, …, 3), which ``read`` makes of the cells' ``values``."""
        return _turned(self._turns, read(values[self.cells]))

    def agree(self, points: Floats, walls: Index | None = None) -> None:
        """Average tensors at the mesh points (n_points, 3, …, 3) in place with their images.

        At coupled patches the points of ``walls`` keep their values; their images off walls take these.
        """
        on_wall = np.zeros(len(points), dtype=bool)
        on_wall[walls if walls is not None else slice(0)] = True
        for rows, mirrors in self._planes:
            points[rows] = 0.5 * (points[rows] + _turned(mirrors, points[rows]))
        for here, there, turn in self._seams:
            turns = np.broadcast_to(turn, (len(here), 3, 3))
            counts = np.stack([on_wall[here] | ~on_wall[there], on_wall[there] | ~on_wall[here]])
            a, b = (counts / counts.sum(axis=0)).reshape(2, -1, *(points.ndim - 1) * [1])
            mean = a * _turned(turns, points[here]) + b * points[there]
            points[here], points[there] = _turned(turns.transpose(0, 2, 1), mean), mean
            axis = here[here == there]
            if len(axis) and points.ndim < 4 and np.any(turn != np.eye(3)):
                points[axis] = _unturned(turn, points[axis])


def _turned(turns: Floats, values: Floats) -> Floats:
    """Return Q_ia Q_jb … T_ab… for n rotations or mirrors Q (n, 3, 3) and tensors T, (n,) to (n, 3, …, 3)."""
    rank = values.ndim - 1
    if rank == 0:
        return values
    old, new = "abc"[:rank], "ijk"[:rank]
    factors = ",".join(f"n{i}{a}" for i, a in zip(new, old, strict=True))
    turned: Floats = np.einsum(f"{factors},n{old}->n{new}", *[turns] * rank, values, optimize=True)
    return turned


def _unturned(turn: Floats, values: Floats) -> Floats:
    """Return the part of vectors (n, 3) or tensors (n, 3, 3) that is invariant about the axis of ``turn``."""
    axis = np.linalg.svd(turn - np.eye(3))[2][2]
    # Round-off must not tilt an axis along a coordinate, across which the velocity is exactly zero.
    axis[np.abs(axis) < 1e-12] = 0.0
    along = np.outer(axis, axis)
    part_of_values = np.zeros_like(values)
    if values.ndim == 2:
        part_of_values += values @ along
        return part_of_values
    for part in (along, np.eye(3) - along, np.cross(np.eye(3), axis)):
        part_of_values += np.einsum("nij,ij->n", values, part)[:, None, None] * part / np.sum(part * part)
    return part_of_values


def _mean_normals(mesh: Mesh, faces: Index, normals: Floats) -> tuple[Index, Floats]:
    """Return the points of a mirror patch, and for each the mirror about the mean plane of its faces."""
    rows, columns = points_of_faces(mesh, faces)
    points, place = np.unique(rows, return_inverse=True)
    total = np.stack([np.bincount(place, normals[columns, i], len(points)) for i in range(3)], axis=1)
    mean = total / np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]
    return points, np.eye(3) - 2.0 * mean[:, :, None] * mean[:, None, :]


def seam(mesh: Mesh, coupling: Coupling) -> tuple[Index, Index, Floats]:
    """Return points of a coupled patch, their images on the other patch, and the rotation between."""
    from scipy.spatial import KDTree

    here, there = (np.unique(points_of_faces(mesh, f)[0]) for f in (coupling.faces, coupling.partners))
    images = mesh.points[here] @ coupling.turn.T + coupling.shift
    distance, nearest = KDTree(mesh.points[there]).query(images, distance_upper_bound=SEAM * coupling.size)
    near = np.isfinite(distance)
    return here[near], there[np.asarray(nearest)[near]], coupling.turn


def points_of_faces(mesh: Mesh, faces: Index) -> tuple[Index, Index]:
    """Return the points of boundary faces, and the position of each point's face in ``faces``."""
    start, points = take_lists(mesh.face_start, mesh.face_points, mesh.n_internal + faces)
    return points.astype(np.intp), np.repeat(np.arange(len(faces)), np.diff(start))
