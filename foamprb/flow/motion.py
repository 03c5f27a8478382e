"""Motion of a mesh: poses of rigid pieces at the times of a flow, or the velocities of nodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats
from foamprb.flow.images import seam
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import PatchKind

_NEAR = 7
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

    def frame(self, index: int, mesh: Mesh) -> tuple[Floats, Floats]:
        """Return the velocity of the pieces at the nodes, and its gradient."""
        pieces = self.nodes(mesh)
        return self.speed(index, mesh.nodes, pieces), spins(self.omega[index])[pieces]

    def fastest(self, mesh: Mesh) -> float:
        """Return the largest speed of the mesh at any time, m/s."""
        size = float(np.ptp(mesh.points, axis=0).max())
        top = np.linalg.norm(self.velocity, axis=2) + size * np.linalg.norm(self.omega, axis=2)
        return float(top.max())

    def joins(self, mesh: Mesh) -> bool:
        """Return whether patches of different pieces are coupled."""
        return len(self.within(mesh)) < len(mesh.couplings)

    def within(self, mesh: Mesh) -> tuple[Coupling, ...]:
        """Return the couplings of patches of the same piece."""
        piece = self.piece[mesh.owner[mesh.n_internal :]]
        return tuple(c for c in mesh.couplings if (piece[c.faces] == piece[c.partners]).all())

    def of_frames(self) -> Motion:
        """Return the same rates in components of the frames, for points at their places at the first time."""
        omega, velocity = (np.einsum("npba,npb->npa", self.Q, v) for v in (self.omega, self.velocity))
        return self._replace(y=np.broadcast_to(self.c, self.y.shape), omega=omega, velocity=velocity)

    def moved(self, index: int, mesh: Mesh) -> Mesh:
        """Return the mesh of the first time with its places and directions at the time of an index."""
        nodes, n, piece = self.nodes(mesh), mesh.n_points, self.piece[mesh.owner[mesh.n_internal :]]
        Q, c, y = self.Q[index], self.c, self.y[index]

        def turned(directions: Floats, of: NDArray[np.int64]) -> Floats:
            result: Floats = np.einsum("nij,nj->ni", Q[of], directions)
            return result

        x = turned(mesh.nodes - c[nodes], nodes) + y[nodes]
        return replace(
            mesh,
            points=x[:n],
            centres=x[n:],
            boundary_centres=turned(mesh.boundary_centres - c[piece], piece) + y[piece],
            boundary_areas=turned(mesh.boundary_areas, piece),
            triangle_normals=turned(mesh.triangle_normals, piece[mesh.triangle_face]),
        )

    def turned(self, index: int, vectors: Floats, pieces: NDArray[np.int64]) -> Floats:
        """Return vectors (n, 3 k) in components of the frames of their pieces."""
        Q, each = self.Q[index, pieces], vectors.reshape(len(vectors), -1, 3)
        components: Floats = np.einsum("nji,nkj->nki", Q, each).reshape(vectors.shape)
        return components

    def in_frames(self, index: int, mesh: Mesh, u: Floats, l: Floats) -> tuple[Floats, Floats]:
        """Return vectors and tensors at the nodes in components of the frames of their pieces."""
        pieces = self.nodes(mesh)
        Q = self.Q[index, pieces]
        return self.turned(index, u, pieces), np.swapaxes(Q, 1, 2) @ l.reshape(-1, 3, 3) @ Q

    def means(self, mesh: Mesh, cells: Floats) -> Floats:
        """Return the mean velocities of the pieces, (n_pieces, 3), from those of the cells, m/s."""
        volumes = np.bincount(self.piece, mesh.volumes)
        sums = [np.bincount(self.piece, mesh.volumes * cells[:, i]) for i in range(3)]
        means: Floats = np.stack(sums, axis=1) / volumes[:, None]
        return means


_SMOOTH = 0.9
"""Least length of the mean of unit normals at a node of a wall that is smooth there."""
_EDGE = 0.02
"""Least mean square of the component of unit normals in a direction across a wall."""
_LIKE = 0.1
"""Largest difference between velocities of fluid and mesh across a wall, over that of the mesh."""


class Deformation(NamedTuple):
    """Motion of the n_points points of a mesh that deforms, given at n times."""

    times: tuple[float, ...]
    period: float | None
    ways: Floats
    """(n − 1,) the largest way of a point from each time to the next, m."""
    rows: NDArray[np.int32]
    """(n_points,) row of each point on walls and openings in ``past``, −1 for others."""
    past: Floats
    """(n, n_rows, 6) places, m, and velocities, m/s."""
    sliding: frozenset[tuple[int, int]] = frozenset()
    """Pairs of coupled patches, each way, that slide on each other."""

    def fastest(self, mesh: Mesh) -> float:  # noqa: ARG002
        """Return the largest speed of the mesh at any time, m/s."""
        return float((self.ways / np.diff(self.times)).max())

    def rates(self, index: int, places: Callable[[int], Floats]) -> Floats:
        """Return the rates of places at the time of an index, by those at up to seven times."""
        n, period = len(self.times), self.period
        near: Sequence[int] = nearest_times(n, index)
        if period is not None:
            near = range(index - _NEAR // 2, index + _NEAR // 2 + 1)
        times = [self.times[k % n] + k // n * (period or 0.0) for k in near]
        return rates_of(times, np.stack([places(k % n) for k in near]), index - near[0])


def match_walls(mesh: Mesh, u: Floats, w: Floats) -> None:
    """Let velocities of fluid and mesh, u and w (n_nodes, 3), be the same across walls, in place.

    It is that of the fluid, which the solver has at the time itself, unless both differ much. At an edge
    between walls it is that of the mesh across each of them; along the edge a mesh may slide.
    """
    walls = np.array([patch.kind is PatchKind.WALL for patch in mesh.patches], dtype=bool)
    some = walls[mesh.triangle_patch]
    seams = [seam(mesh, coupling) for coupling in mesh.couplings if coupling.patch < coupling.other]
    touched, corners = np.zeros(len(u), dtype=bool), mesh.triangles[some].ravel()
    touched[corners] = True
    for here, there, _ in seams:
        touched[here] = touched[there] = touched[here] | touched[there]
    nodes, number = np.flatnonzero(touched), np.cumsum(touched) - 1
    of, n = number[corners], np.repeat(mesh.triangle_normals[some], 3, axis=0)
    normals, squares = np.zeros((len(nodes), 3)), np.zeros((len(nodes), 3, 3))
    counts = np.bincount(of, minlength=len(nodes))
    for k in range(3):
        normals[:, k] = np.bincount(of, n[:, k], len(nodes))
        for j in range(3):
            squares[:, k, j] = np.bincount(of, n[:, k] * n[:, j], len(nodes))
    for here, there, turn in seams:
        # A wall goes on beyond coupled patches.
        a, b = number[here[touched[here]]], number[there[touched[here]]]
        normals[a], counts[a] = normals[a] + normals[b] @ turn, counts[a] + counts[b]
        squares[a] += turn.T @ squares[b] @ turn
        normals[b], counts[b] = normals[a] @ turn.T, counts[a]
        squares[b] = turn @ squares[a] @ turn.T
    length = np.linalg.norm(normals, axis=1)
    normals /= np.maximum(length, 1e-300)[:, None]
    lack = u[nodes] - w[nodes]
    across = np.einsum("ni,ni->n", normals, lack)
    smooth, near = length > _SMOOTH * counts, np.abs(across) <= _LIKE * np.linalg.norm(w[nodes], axis=1)
    along = normals * across[:, None]
    w[nodes] += np.where((smooth & near)[:, None], along, 0.0)
    sizes, axes = np.linalg.eigh(squares)
    of_edges = np.einsum("nik,nk,njk,nj->ni", axes, sizes > _EDGE * counts[:, None], axes, lack)
    u[nodes] -= np.where(smooth[:, None], np.where(near[:, None], 0.0, along), of_edges)


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
