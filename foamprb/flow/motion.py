"""Motion of the rigid pieces of a mesh: their poses at the times of a flow, and fields in their frames."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh

_NEAR = 5
"""Number of times from which a rate follows: the polynomial through them is derived."""


class Motion(NamedTuple):
    """Poses of n_pieces pieces at n times: x = Q·(X − c) + y, with the place X at the first time."""

    piece: NDArray[np.int64]
    """(n_cells,) the piece of each cell."""
    names: tuple[str, ...]
    """Names of the pieces, for messages."""
    c: Floats
    """(n_pieces, 3), m: the point of a piece that moves least."""
    Q: Floats
    """(n, n_pieces, 3, 3)."""
    y: Floats
    """(n, n_pieces, 3), m."""
    turns: Floats
    """(n or n − 1, n_pieces, 3): rotation vectors from each time to the next; with a period the last one
    leads to the first time of the next."""
    omega: Floats
    """(n, n_pieces, 3), 1/s."""
    velocity: Floats
    """(n, n_pieces, 3): ẏ, m/s."""

    def nodes(self, mesh: Mesh) -> NDArray[np.int64]:
        """Return the pieces of the nodes of the mesh, (n_nodes,)."""
        of_points = np.zeros(mesh.n_points, dtype=np.int64)
        of_points[mesh.cell_points] = np.repeat(self.piece, np.diff(mesh.cell_point_start))
        return np.concatenate([of_points, self.piece])

    def speed(self, index: int, x: Floats, pieces: NDArray[np.int64]) -> Floats:
        """Return the velocity of pieces at places (m, 3) at the time of an index, (m, 3), m/s."""
        arm = x - self.y[index, pieces]
        v: Floats = self.velocity[index, pieces] + np.cross(self.omega[index, pieces], arm)
        return v

    def frame(self, index: int, mesh: Mesh) -> tuple[Floats, Floats, float]:
        """Return the velocity of the pieces at the nodes, its gradient, and the top speed at all times."""
        pieces = self.nodes(mesh)
        size = float(np.ptp(mesh.points, axis=0).max())
        top = np.linalg.norm(self.velocity, axis=2) + size * np.linalg.norm(self.omega, axis=2)
        w = self.speed(index, mesh.nodes, pieces)
        return w, spins(self.omega[index])[pieces], float(top.max())

    def in_frames(self, index: int, mesh: Mesh, u: Floats, l: Floats) -> tuple[Floats, Floats]:
        """Return vectors and tensors at the nodes in components of the frames of their pieces."""
        Q = self.Q[index, self.nodes(mesh)]
        return np.einsum("nji,nj->ni", Q, u), np.einsum("nji,njk,nkl->nil", Q, l.reshape(-1, 3, 3), Q)

    def means(self, mesh: Mesh, cells: Floats) -> Floats:
        """Return the mean velocities of the pieces, (n_pieces, 3), from those of the cells, m/s."""
        volumes = np.bincount(self.piece, mesh.volumes)
        sums = [np.bincount(self.piece, mesh.volumes * cells[:, i]) for i in range(3)]
        means: Floats = np.stack(sums, axis=1) / volumes[:, None]
        return means


def spins(omega: Floats) -> Floats:
    """Return the matrices W of angular velocities (n, 3), with W·a = Ω × a, (n, 3, 3)."""
    W = np.zeros((len(omega), 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        W[:, k, j], W[:, j, k] = omega[:, i], -omega[:, i]
    return W


def rates_of(times: Sequence[float], values: Floats, at: int) -> Floats:
    """Return the derivative at a time of the polynomial through values (n, …) at times, s (Fornberg 1988)."""
    t = np.asarray(times) - times[at]
    scale = float(np.abs(t).max())
    powers = (t / scale)[:, None] ** np.arange(len(t))
    slopes = np.linalg.inv(powers)[1] / scale
    derived: Floats = np.tensordot(slopes, values, axes=1)
    return derived


def nearest_times(n: int, at: int) -> range:
    """Return the indices, of n times, from which the rate at one of them follows."""
    first = min(max(at - _NEAR // 2, 0), max(n - _NEAR, 0))
    return range(first, min(first + _NEAR, n))
