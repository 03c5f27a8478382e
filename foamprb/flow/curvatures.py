"""Second derivatives of the velocity at the nodes of a mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.compile.link import link
from foamprb.flow.base import Floats
from foamprb.flow.images import Images
from foamprb.flow.mesh.arrays import MeshArrays, frame, no_mesh, nodes_of
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.walk import curvature_in

_DIRECTIONS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
_PLACES = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
"""Order of second derivatives, and the place of each in it."""


def mean_curvatures(mesh: Mesh, l: Floats) -> NDArray[np.float32]:
    """Return the second derivatives of u at the nodes, (n_nodes, 18), 1/(m s), from ∇u there.

    ∇u is linear in each tetrahedron. Its slopes are constant there; their means around a node, weighted by
    volume, are more accurate (Zienkiewicz & Zhu 1992). They are the same on both sides of mirrors and coupled
    patches. The columns are a vector for each of xx, yy, zz, xy, yz and xz.
    """
    n, images = mesh.n_points + mesh.n_cells, Images(mesh)
    slopes, volumes = np.zeros((n, 18)), np.zeros(n)
    arrays = no_mesh()._replace(nodes=mesh.nodes, tets=mesh.tets)
    link(sum_slopes)(arrays, np.ascontiguousarray(l).reshape(-1, 9), slopes, volumes)
    slopes /= np.maximum(volumes, 1e-300)[:, None]
    points = slopes[: mesh.n_points]
    if len(images.faces):
        full = third_order(points)
        images.agree(full)
        points[:] = columns_of_third(full)
    return slopes.astype(np.float32)


def third_order(columns: NDArray[Any]) -> NDArray[Any]:
    """Return a copy of second derivatives (n, 18) as tensors ∂²u_i/∂x_j∂x_k (n, 3, 3, 3)."""
    tensors: NDArray[Any] = np.take(columns.reshape(-1, 6, 3), _PLACES, axis=1).transpose(0, 3, 1, 2).copy()
    return tensors


def columns_of_third(tensors: NDArray[Any]) -> NDArray[Any]:
    """Return second derivatives (n, 3, 3, 3) as columns (n, 18)."""
    j, k = np.transpose(_DIRECTIONS)
    return tensors[:, :, j, k].transpose(0, 2, 1).reshape(-1, 18)


def sum_slopes(flow: MeshArrays, l: Floats, sums: Floats, volumes: Floats) -> None:
    """Sum at the nodes the slopes of ∇u (n_nodes, 9) in the tetrahedra around them, times their volumes.

    ``sums`` (n_nodes, 18) and ``volumes`` (n_nodes,) must hold zeros.
    """
    for tet in range(flow.tets.shape[0]):
        volume = frame(flow, tet)[4]
        if volume <= 0.0:
            continue
        slopes = curvature_in(flow, tet, l, 0, 0)
        for node in nodes_of(flow, tet):
            volumes[node] += volume
            for j in range(6):
                for c in range(3):
                    sums[node, 3 * j + c] += volume * slopes[j][c]
