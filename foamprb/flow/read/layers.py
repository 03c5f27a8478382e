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
_SAME_VOLUME = 1e-3
"""Largest relative difference between the volumes of two meshes of the same region."""
_ENOUGH, _MOST_ITERATIONS = 1e-9, 10_000
"""Residual over that at the start with which the solution of Laplace's equation ends, and iterations."""
_FLAT = 1e-9
"""Volume of a tetrahedron without size over the cube of its longest side."""


def filled(mesh: Mesh, there: Mesh, where: str) -> Mesh:
    """Return a mesh with its points at other places, so that it fills another one, patch by patch.

    A patch with the same points there, up to a shift, carries its points along: a piston, a box that moves, a
    wall at rest. Points of other patches slide along them, as on a liner, or are at rest if the wall is not
    along the motion. The displacement of these and of points inside satisfies Laplace's equation, so that
    before a piston all distances shrink alike.

    Raises
    ------
    InputError
        No patches agree, or the cells do not fill the mesh; ``where`` names it.
    """
    close = _SAME * float(np.cbrt(np.median(mesh.volumes)))
    moved, held = _on_boundary(mesh, there, close)
    _solve(_stiffness(mesh), moved, ~held)
    found = with_points(mesh, mesh.points + moved[: mesh.n_points])
    volume, whole, least = float(found.volumes.sum()), float(there.volumes.sum()), found.volumes.min()
    off = np.abs(_boxes(found) - _boxes(there)).max(axis=(1, 2))
    fits = off.max() <= close and abs(volume - whole) <= _SAME_VOLUME * whole
    if not (fits and least > 0.0):
        raise InputError(
            f"{where}: the cells are no parts of those of other times, and those do not fit into this "
            f"mesh: they would fill {volume:.6g} of {whole:.6g} m3, the smallest one {least:.3g} m3, and "
            f"patch {mesh.patches[off.argmax()].name} would be up to {off.max():.3g} m off. Allowed: cells "
            "that are divided and joined again, as by dynamicRefineFvMesh, in a region whose boundary is at "
            "rest; layers of cells that are added and removed, if each patch keeps its faces and does not "
            "turn, as a piston, or lies along the motion, as a liner."
        )
    return found


def _on_boundary(mesh: Mesh, there: Mesh, close: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Return displacements of nodes (n_nodes, 3), m, and which of them are known.

    Points that are nearer than ``close``, m, are the same.
    """
    moved, held = np.zeros_like(mesh.nodes), np.zeros(len(mesh.nodes), dtype=bool)
    shifts, trees = {}, {}
    for patch in np.unique(there.triangle_patch):
        nodes, others = (np.unique(m.triangles[m.triangle_patch == patch]) for m in (mesh, there))
        a, b = mesh.points[nodes], there.points[others]
        trees[patch] = tree_of(b)
        if len(a) != len(b):
            continue
        distance, nearest = trees[patch].query(a + b.mean(axis=0) - a.mean(axis=0))
        if len(np.unique(nearest)) == len(a) and distance.max() <= close:
            shifts[patch] = nodes, b[nearest] - a
    # The edge between a wall and a piston belongs to the latter.
    for nodes, shift in sorted(shifts.values(), key=lambda pair: float(np.abs(pair[1]).max())):
        moved[nodes], held[nodes] = shift, True
    means = np.array([shift.mean(axis=0) for _, shift in shifts.values()]).reshape(-1, 3)
    length = np.linalg.norm(means, axis=1)
    directions = (means / np.maximum(length, 1e-300)[:, None])[length > close]
    across = (np.abs(mesh.triangle_normals @ directions.T) > _ALONG).any(axis=1)
    for patch in trees.keys() - shifts.keys():
        nodes = np.unique(mesh.triangles[across & (mesh.triangle_patch == patch)])
        held[nodes[trees[patch].query(mesh.points[nodes])[0] <= close]] = True
    return moved, held


def _boxes(mesh: Mesh) -> Floats:
    """Return the lowest and highest coordinates of each patch, (n_patches, 2, 3), m; 0 without faces."""
    boxes = np.zeros((len(mesh.patches), 2, 3))
    for patch in np.unique(mesh.triangle_patch):
        points = mesh.points[mesh.triangles[mesh.triangle_patch == patch]]
        boxes[patch] = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    return boxes


def _stiffness(mesh: Mesh) -> Any:
    """Return the matrix of linear finite elements in the tetrahedra, (n_nodes, n_nodes)."""
    from scipy import sparse

    corners, n = mesh.nodes[mesh.tets], len(mesh.nodes)
    sides = corners[:, 1:] - corners[:, :1]
    volumes, size = np.abs(np.linalg.det(sides)), np.linalg.norm(sides, axis=2).max(axis=1)
    flat = volumes <= _FLAT * size**3
    sides[flat], volumes[flat] = np.eye(3), 0.0
    slopes = np.linalg.inv(sides)
    slopes = np.concatenate([-slopes.sum(axis=2, keepdims=True), slopes], axis=2)
    values = volumes[:, None, None] * (np.swapaxes(slopes, 1, 2) @ slopes)
    rows, columns = np.repeat(mesh.tets, 4, axis=1), np.tile(mesh.tets, 4)
    return sparse.csr_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n))


def _solve(matrix: Any, x: Floats, free: NDArray[np.bool_]) -> None:
    """Set the free rows of x (n, 3) so that those of matrix · x are 0, by conjugate gradients.

    If nothing is given, x is 0. Sums of NumPy do not depend on the number of threads, as those of BLAS do.
    """
    weights = np.where(free, 1.0 / np.maximum(matrix.diagonal(), 1e-300), 0.0)[:, None]
    left = -(matrix @ x) * free[:, None]
    way, energy = np.zeros_like(x), np.ones(3)
    enough = _ENOUGH**2 * np.einsum("ni,ni->i", left, weights * left)
    for _ in range(_MOST_ITERATIONS):
        last, energy = energy, np.einsum("ni,ni->i", left, weights * left)
        if (energy <= enough).all():
            break
        way = weights * left + energy / np.maximum(last, 1e-300) * way
        image = matrix @ way
        step = energy / np.maximum(np.einsum("ni,ni->i", way, image), 1e-300)
        x += step * way
        left -= step * image * free[:, None]
