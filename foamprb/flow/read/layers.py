"""Meshes whose layers of cells are added and removed: the cells of one time, which follow the boundary."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh, with_points
from foamprb.flow.read.refinement import tree_of

_SAME = 1e-2
"""Largest distance between points that are the same, over the median width of the cells."""
_ALONG = 0.1
"""Largest cosine between the normal of a wall and a motion along it."""
_ACROSS = 0.1
"""Conductance across the motion over that along it."""
_SAME_VOLUME = 1e-3
"""Largest relative difference between the volumes of two meshes of the same region."""
_FLAT = 1e-9
"""Volume of a tetrahedron without size over the cube of its longest side."""


class Layers:
    """Cells of a mesh that deform so that they fill other meshes, patch by patch.

    A patch with the same points as there, up to a shift, carries its points along: a piston, a box that
    moves, a wall at rest. Points of other patches slide along them, as on a liner, or are at rest if the wall
    is not along the motion. The displacement of these and of points inside satisfies Laplace's equation. With
    a larger conductance along the motion, distances to a piston shrink alike, at edges of its bowl too.
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._close = _SAME * float(np.cbrt(np.median(mesh.volumes)))
        self._key, self._factors = b"", None

    def at(self, there: Mesh, where: str) -> Mesh:
        """Return the mesh with its points at other places, so that it fills ``there``.

        Raises
        ------
        InputError
            No patches agree, or the cells do not fill the mesh; ``where`` names it.
        """
        moved, held, directions = self._on_boundary(there)
        if held.any():
            self._spread(moved, held, directions)
        mesh = with_points(self.mesh, self.mesh.points + moved[: self.mesh.n_points])
        volume, whole, least = float(mesh.volumes.sum()), float(there.volumes.sum()), mesh.volumes.min()
        off = _boxes(mesh) - _boxes(there)
        patch = mesh.patches[int(np.abs(off).max(axis=(1, 2)).argmax())].name
        fits = np.abs(off).max() <= self._close and abs(volume - whole) <= _SAME_VOLUME * whole
        if not (fits and least > 0.0):
            raise InputError(
                f"{where}: the cells are no parts of those of other times, and those do not fit into this "
                f"mesh: they would fill {volume:.6g} of {whole:.6g} m3, the smallest one {least:.3g} m3, and "
                f"patch {patch} would be up to {np.abs(off).max():.3g} m off. Allowed: cells that are "
                "divided and joined again, as by dynamicRefineFvMesh, in a region whose boundary is at rest; "
                "layers of cells that are added and removed, if each patch keeps its faces and does not "
                "turn, as a piston, or lies along the motion, as a liner."
            )
        return mesh

    def _on_boundary(self, there: Mesh) -> tuple[Floats, NDArray[np.bool_], Floats]:
        """Return displacements of nodes (n_nodes, 3), m, which of them are known, and their directions."""
        mesh = self.mesh
        moved, held = np.zeros_like(mesh.nodes), np.zeros(len(mesh.nodes), dtype=bool)
        shifts, trees = {}, {}
        for patch in np.unique(mesh.triangle_patch):
            nodes, others = (np.unique(m.triangles[m.triangle_patch == patch]) for m in (mesh, there))
            if len(others) == 0:
                continue
            a, b = mesh.points[nodes], there.points[others]
            trees[patch] = tree_of(b)
            distance, nearest = trees[patch].query(a + b.mean(axis=0) - a.mean(axis=0))
            if len(np.unique(nearest)) == len(a) == len(b) and distance.max() <= self._close:
                shifts[patch] = nodes, b[nearest] - a
        # The edge between a wall and a piston belongs to the latter.
        for nodes, shift in sorted(shifts.values(), key=lambda pair: float(np.abs(pair[1]).max())):
            moved[nodes], held[nodes] = shift, True
        means = np.array([shift.mean(axis=0) for _, shift in shifts.values()]).reshape(-1, 3)
        length = np.linalg.norm(means, axis=1)
        directions = (means / np.maximum(length, 1e-300)[:, None])[length > self._close]
        across = (np.abs(mesh.triangle_normals @ directions.T) > _ALONG).any(axis=1)
        for patch in trees.keys() - shifts.keys():
            nodes = np.unique(mesh.triangles[across & (mesh.triangle_patch == patch)])
            held[nodes[trees[patch].query(mesh.points[nodes])[0] <= self._close]] = True
        return moved, held, directions

    def _spread(self, moved: Floats, held: NDArray[np.bool_], directions: Floats) -> None:
        """Set the displacements of the nodes that are not held, in place."""
        # Rounded, as the same factors serve at many times.
        along = np.round(directions.T @ directions / max(len(directions), 1), 3)
        key = held.tobytes() + along.tobytes()
        if key != self._key:
            matrix = _stiffness(self.mesh, along + _ACROSS * np.eye(3))[~held]
            self._key, self._factors = key, (_factors(matrix[:, ~held]), matrix[:, held])
        solve, of_held = self._factors
        moved[~held] = -solve(of_held @ moved[held])


def _boxes(mesh: Mesh) -> Floats:
    """Return the lowest and highest coordinates of each patch, (n_patches, 2, 3), m; 0 without faces."""
    boxes = np.zeros((len(mesh.patches), 2, 3))
    for patch in np.unique(mesh.triangle_patch):
        points = mesh.points[mesh.triangles[mesh.triangle_patch == patch]]
        boxes[patch] = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    return boxes


def _stiffness(mesh: Mesh, conductance: Floats) -> Any:
    """Return the matrix of linear finite elements in the tetrahedra, (n_nodes, n_nodes)."""
    from scipy import sparse

    corners, n = mesh.nodes[mesh.tets], len(mesh.nodes)
    sides = corners[:, 1:] - corners[:, :1]
    volumes, size = np.abs(np.linalg.det(sides)), np.linalg.norm(sides, axis=2).max(axis=1)
    flat = volumes <= _FLAT * size**3
    sides[flat], volumes[flat] = np.eye(3), 0.0
    slopes = np.linalg.inv(sides)
    slopes = np.concatenate([-slopes.sum(axis=2, keepdims=True), slopes], axis=2)
    values = volumes[:, None, None] * (np.swapaxes(slopes, 1, 2) @ conductance @ slopes)
    rows, columns = np.repeat(mesh.tets, 4, axis=1), np.tile(mesh.tets, 4)
    matrix = sparse.csr_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n))
    # Points of no cell stay.
    return matrix + 1e-12 * float(matrix.diagonal().mean()) * sparse.eye_array(n, format="csr")


def _factors(matrix: Any) -> Any:
    from scipy.sparse.linalg import splu

    return splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve
