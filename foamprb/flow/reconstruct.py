"""Cell values and wall values → u and ∇u at the nodes of the tetrahedra, continuous in between.

Gradients come from least squares over face neighbours and boundary values. The gradient of the gradients
gives the second derivatives, whose part in the differences is then taken off again, so that quadratic fields
are met beside a wall nearly as well as in the core. A node's value is the weighted mean of what its cells say
about it by Taylor's formula; on a wall the wall's own values decide.

Beyond a symmetry plane, an empty patch, a wedge or a cyclic patch the field goes on: each cell there has an
image, whose values are known, and which counts as a neighbour like any other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.spatial import KDTree

from foamprb.body import tensor
from foamprb.compile.link import link
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.mesh import Floats, Ints, Mesh
from foamprb.flow.mesh.patch import WALLS
from foamprb.flow.stencils import group, mean_series, sum_differences

__all__ = ["VALUELESS", "Reconstruction", "from_points"]

VALUELESS = frozenset(
    {
        "symmetry",
        "symmetryPlane",
        "wedge",
        "empty",
        "cyclic",
        "cyclicAMI",
        "cyclicACMI",
        "cyclicSlip",
        "processor",
    }
)
"""Types of patches whose boundary values say nothing that the cells do not say."""

_MIRRORS = frozenset({"symmetry", "symmetryPlane", "empty", "wedge"})
_Index: TypeAlias = NDArray[np.intp]
_Mask: TypeAlias = NDArray[np.bool_]

# The six second derivatives: pairs of directions.
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
_PAIR_OF = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])
# Cells handled at once: the temporary arrays then stay in the cache.
_CHUNK = 1 << 15


class Reconstruction:
    """The weights by which a mesh's cell and boundary values give u and ∇u at its nodes.

    Parameters
    ----------
    mesh
        The mesh.
    valued
        (n_boundary,) boundary faces that have a value; default: all but those of :data:`VALUELESS` patches.
    """

    def __init__(self, mesh: Mesh, valued: _Mask | None = None) -> None:
        patch_of_face = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
        if valued is None:
            valued = np.array([p.type not in VALUELESS for p in mesh.patches], dtype=bool)[patch_of_face]
        walls = np.array([p.type in WALLS for p in mesh.patches], dtype=bool)[patch_of_face] & valued
        self.mesh = mesh
        self._valued, self._walls = np.flatnonzero(valued), np.flatnonzero(walls)
        self._owner = mesh.owner[mesh.n_internal :].astype(np.intp)
        self._images = images = _Images(mesh)
        n = mesh.n_cells
        # A boundary face with a value is a place like a cell centre, and so is an image.
        self._sites = np.concatenate([mesh.centres, mesh.boundary_centres[self._valued], images.places])
        self._of_images = slice(n + len(self._valued), len(self._sites))
        self._of_faces = slice(n, self._of_images.start)
        faces = np.concatenate([self._valued, images.faces])
        numbers = np.arange(n, len(self._sites), dtype=np.int32)
        self._gradient = _Gradient(mesh, self._sites, faces, numbers)
        imaged = len(self._valued)
        self._bend = _Gradient(mesh, self._sites, faces[imaged:], numbers[imaged:], least=0.01)
        rows, columns = (part.astype(np.int32) for part in _face_points(mesh, faces))
        of_cells = np.repeat(np.arange(n, dtype=np.int32), np.diff(mesh.cell_point_start))
        self._around = _grouped(
            np.concatenate([mesh.cell_points, rows]), np.concatenate([of_cells, n + columns]), mesh.n_points
        )

    def __call__(self, cells: Floats, boundary: Floats, l: Floats | None = None) -> tuple[Floats, Floats]:
        """Reconstruct a field.

        Parameters
        ----------
        cells
            (n_cells, 3) velocity at cell centres, m/s.
        boundary
            (n_boundary, 3) velocity at boundary faces; rows of faces without a value are not read.
        l
            (n_cells, 3, 3) gradient at cell centres, l_ij = ∂u_i/∂x_j, 1/s, if it is known already.

        Returns
        -------
        u, l
            (n_nodes, 3) and (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j, mesh points first, then cell centres.
        """
        n, n_points = self.mesh.n_cells, self.mesh.n_points
        u = np.concatenate([cells, boundary[self._valued], self._images.turned(cells)])
        slopes, bends = self._derivatives(u, l)
        u_nodes, l_nodes = np.zeros((n_points + n, 3)), np.zeros((n_points + n, 3, 3))
        u_nodes[n_points:], l_nodes[n_points:] = cells, slopes[:n]
        at_points = u_nodes[:n_points], l_nodes[:n_points]
        link(mean_series)(self.mesh.points, self._sites, *self._around, u, slopes, bends, *at_points)
        self._impose_walls(at_points[0], boundary, slopes, bends)
        for values in at_points:
            self._images.agree(values)
        return u_nodes, l_nodes

    def _derivatives(self, u: Floats, l: Floats | None) -> tuple[Floats, Floats]:
        """First derivatives (n_sites, 3, 3) and second derivatives (n_sites, 3, 6) at all sites.

        The order of the second derivatives is xx, yy, zz, xy, xz, yz.
        """
        n = self.mesh.n_cells
        slopes, bends = np.zeros((len(u), 3, 3)), np.zeros((len(u), 3, 6))
        if l is None:
            self._gradient(u, slopes[:n])
        else:
            slopes[:n] = l
        slopes[self._of_images] = self._images.turned(slopes[:n])
        for low in range(0, n, _CHUNK):
            part = np.empty((min(_CHUNK, n - low), 9, 3))
            self._bend(slopes.reshape(-1, 9), part, low)
            second = part.reshape(-1, 3, 3, 3)
            for pair, (j, k) in enumerate(_PAIRS):
                bends[low : low + len(part), :, pair] = 0.5 * (second[:, :, j, k] + second[:, :, k, j])
        if l is None:
            # One correction: beside a wall, the cell values of a finite-volume solution are themselves off by
            # as much as a second would change.
            self._gradient(u, slopes[:n], bends=bends[:n])
        images = self._images
        slopes[self._of_faces] = self._at_faces(self._valued, slopes, bends)
        slopes[self._of_images] = images.turned(slopes[:n])
        bends[self._of_faces] = bends[self._owner[self._valued]]
        turned = images.turned(bends, lambda own: own[:, :, _PAIR_OF])
        for pair, (j, k) in enumerate(_PAIRS):
            bends[self._of_images, :, pair] = turned[:, :, j, k]
        return slopes, bends

    def _at_faces(self, faces: _Index, l: Floats, h: Floats) -> Floats:
        """Gradients continued from the cells to their boundary faces."""
        owner = self._owner[faces]
        arms = self.mesh.boundary_centres[faces] - self.mesh.centres[owner]
        faces_l: Floats = l[owner] + np.einsum("nijk,nk->nij", h[owner][:, :, _PAIR_OF], arms)
        return faces_l

    def _impose_walls(self, u_points: Floats, boundary: Floats, l: Floats, h: Floats) -> None:
        """Give the points of walls the wall's velocity, from the gradients at the wall's faces.

        Where the wall's faces about a point move alike, the point moves so too, exactly; elsewhere their
        values are continued to the point.
        """
        mesh, faces = self.mesh, self._walls
        if len(faces) == 0:
            return
        rows, columns = _face_points(mesh, faces)
        values = boundary[faces]
        on_wall, place = np.unique(rows, return_inverse=True)
        start, around = _grouped(place, columns, len(on_wall))
        mean, _ = _continued(
            mesh.points[on_wall], mesh.boundary_centres[faces], (start, around),
            values, self._at_faces(faces, l, h),
        )  # fmt: skip
        low = np.minimum.reduceat(values[around], start[:-1])
        high = np.maximum.reduceat(values[around], start[:-1])
        u_points[on_wall] = np.where(np.all(low == high, axis=1, keepdims=True), low, mean)


def _as_it_is(values: Floats) -> Floats:
    return values


class _Images:
    """Cells beyond the patches over which the field goes on, each the image of a cell inside."""

    def __init__(self, mesh: Mesh) -> None:
        owner = mesh.owner[mesh.n_internal :].astype(np.intp)
        areas = mesh.boundary_areas
        normals = areas / np.maximum(np.linalg.norm(areas, axis=1), 1e-300)[:, None]
        coupled = {coupling.patch for coupling in mesh.couplings}
        faces, cells, places, turns = [], [], [], []
        self._planes, self._seams = [], []
        for index, patch in enumerate(mesh.patches):
            own = np.arange(mesh.patch_start[index], mesh.patch_start[index + 1])
            if patch.type not in _MIRRORS or index in coupled or len(own) == 0:
                continue
            n = normals[own]
            away = np.einsum("fi,fi->f", mesh.boundary_centres[own] - mesh.centres[owner[own]], n)
            faces.append(own)
            cells.append(owner[own])
            places.append(mesh.centres[owner[own]] + 2.0 * away[:, None] * n)
            mirror = np.eye(3) - 2.0 * n[:, :, None] * n[:, None, :]
            # On a plane mesh the flow is the same at every height.
            turns.append(np.broadcast_to(np.eye(3), mirror.shape) if patch.type == "empty" else mirror)
            if patch.type != "empty":
                self._planes.append(_mean_normals(mesh, own, n))
        for coupling in mesh.couplings:
            faces.append(coupling.faces)
            cells.append(owner[coupling.partners])
            # Backwards: what lies beyond the first patch is what lies before the second.
            places.append((mesh.centres[cells[-1]] - coupling.shift) @ coupling.turn)
            turns.append(np.broadcast_to(coupling.turn.T, (len(coupling.faces), 3, 3)))
            if coupling.patch < coupling.other and len(coupling.faces):
                self._seams.append(_seam(mesh, coupling))
        self.faces: _Index = np.concatenate([np.empty(0, dtype=np.intp), *faces])
        self.cells: _Index = np.concatenate([np.empty(0, dtype=np.intp), *cells])
        self.places: Floats = np.concatenate([np.empty((0, 3)), *places])
        self._turns: Floats = np.concatenate([np.empty((0, 3, 3)), *turns])

    def turned(self, values: Floats, read: Callable[[Floats], Floats] = _as_it_is) -> Floats:
        """What the images have of the cells' tensors (n_cells, 3, …, 3), those that ``read`` gives."""
        return _turned(self._turns, read(values[self.cells]))

    def agree(self, points: Floats) -> None:
        """Make tensors at the mesh points (n_points, 3, …, 3) agree with their images."""
        for rows, mirrors in self._planes:
            points[rows] = 0.5 * (points[rows] + _turned(mirrors, points[rows]))
        for here, there, turn in self._seams:
            turns = np.broadcast_to(turn, (len(here), 3, 3))
            mean = 0.5 * (_turned(turns, points[here]) + points[there])
            points[here], points[there] = _turned(turns.transpose(0, 2, 1), mean), mean
            still = here[here == there]
            if len(still) and np.any(turn != np.eye(3)):
                points[still] = _about(turn, points[still])


def _turned(turns: Floats, values: Floats) -> Floats:
    """Q_ia Q_jb … T_ab… for n rotations or mirrors Q (n, 3, 3) and tensors T (n, 3, …, 3)."""
    rank = values.ndim - 1
    old, new = "abc"[:rank], "ijk"[:rank]
    factors = ",".join(f"n{i}{a}" for i, a in zip(new, old, strict=True))
    turned: Floats = np.einsum(f"{factors},n{old}->n{new}", *[turns] * rank, values, optimize=True)
    return turned


def _about(turn: Floats, values: Floats) -> Floats:
    """The part of vectors (n, 3) or tensors (n, 3, 3) that no rotation about the axis of ``turn`` changes."""
    axis = np.linalg.svd(turn - np.eye(3))[2][2]
    # Round-off must not tilt an axis that lies along a coordinate: across it there is exactly no velocity.
    axis[np.abs(axis) < 1e-12] = 0.0
    along = np.outer(axis, axis)
    kept = np.zeros_like(values)
    if values.ndim == 2:
        kept += values @ along
        return kept
    for part in (along, np.eye(3) - along, np.cross(np.eye(3), axis)):
        kept += np.einsum("nij,ij->n", values, part)[:, None, None] * part / np.sum(part * part)
    return kept


def _mean_normals(mesh: Mesh, faces: _Index, normals: Floats) -> tuple[_Index, Floats]:
    """Points of a patch of mirrors, and for each the mirror about the mean plane of its faces."""
    rows, columns = _face_points(mesh, faces)
    points, place = np.unique(rows, return_inverse=True)
    total = np.stack([np.bincount(place, normals[columns, i], len(points)) for i in range(3)], axis=1)
    mean = total / np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]
    return points, np.eye(3) - 2.0 * mean[:, :, None] * mean[:, None, :]


def _seam(mesh: Mesh, coupling: Coupling) -> tuple[_Index, _Index, Floats]:
    """Points of a coupled patch beside those of the other that continue them, and the rotation between."""
    here, there = (np.unique(_face_points(mesh, f)[0]) for f in (coupling.faces, coupling.partners))
    images = mesh.points[here] @ coupling.turn.T + coupling.shift
    size = np.sqrt(np.linalg.norm(mesh.boundary_areas[coupling.faces], axis=1).min())
    distance, nearest = KDTree(mesh.points[there]).query(images, distance_upper_bound=0.05 * size)
    near = np.isfinite(distance)
    return here[near], there[np.asarray(nearest)[near]], coupling.turn


class _Gradient:
    """Least-squares gradient at cell centres, differences weighted by the inverse square of the distance.

    A cell whose neighbours and boundary values leave a direction open (``least`` of the largest eigenvalue)
    asks its neighbours' neighbours as well. A direction that is still open then gets no gradient: the missing
    one of a mesh one cell thick.
    """

    def __init__(self, mesh: Mesh, sites: Floats, faces: _Index, numbers: Ints, least: float = 1e-6) -> None:
        n = mesh.n_cells
        inner, neighbour = mesh.owner[: mesh.n_internal], mesh.neighbour
        self._n, self._sites, self._kernel = n, sites, link(sum_differences)
        self._around = _grouped(
            np.concatenate([inner, neighbour, mesh.owner[mesh.n_internal + faces]]),
            np.concatenate([neighbour, inner, numbers]),
            n,
        )
        open_cells = np.concatenate(
            [low + np.flatnonzero(_nearly_singular(matrix, least)) for low, matrix in self._matrices()]
        )
        if len(open_cells):
            start, columns = self._around
            more = _second_neighbours(inner, neighbour, n, open_cells)
            rows = np.repeat(np.arange(n), np.diff(start))
            self._around = _grouped(np.concatenate([rows, more[0]]), np.concatenate([columns, more[1]]), n)
        # Six components of each, as it is symmetric.
        self._inverse = np.empty((n, 6))
        for low, matrix in self._matrices():
            inverse = _invert(matrix, least)
            for pair, (j, k) in enumerate(_PAIRS):
                self._inverse[low : low + len(matrix), pair] = inverse[:, j, k]

    def _matrices(self) -> Iterator[tuple[int, Floats]]:
        """For some cells at a time, the first, and the normal equations' matrices Σ e ⊗ e (n, 3, 3)."""
        for low in range(0, self._n, _CHUNK):
            matrix = np.empty((min(_CHUNK, self._n - low), 3, 3))
            self._sums(self._sites, matrix, low)
            yield low, matrix

    def __call__(self, values: Floats, gradients: Floats, low: int = 0, bends: Floats | None = None) -> None:
        """Gradients (n, m, 3) of m fields at n cells from ``low`` on, from the sites' values (n_sites, m).

        The part of the second derivatives ``bends`` (n_cells, m, 6) in the values is taken off.
        """
        self._sums(values, gradients, low, bends)
        for first in range(0, len(gradients), _CHUNK):
            part = gradients[first : first + _CHUNK]
            part[:] = part @ self._inverse[low + first : low + first + len(part)][:, _PAIR_OF]

    def _sums(self, values: Floats, sums: Floats, low: int = 0, bends: Floats | None = None) -> None:
        """The right side (n, m, 3) of the normal equations."""
        if bends is None:
            bends = np.empty((0, values.shape[1], 6))
        sums[:] = 0.0
        self._kernel(self._sites, *self._around, values, bends, low, sums)


def _continued(
    points: Floats, sites: Floats, around: tuple[Ints, Ints], u: Floats, l: Floats
) -> tuple[Floats, Floats]:
    """Means at points of the Taylor series about sites, from values and first derivatives."""
    at_points = np.zeros((len(points), 3)), np.zeros((len(points), 3, 3))
    link(mean_series)(points, sites, *around, u, l, np.zeros((len(sites), 3, 6)), *at_points)
    return at_points


def _grouped(rows: NDArray[Any], columns: NDArray[Any], n: int) -> tuple[Ints, Ints]:
    """Where each of n rows begins, and the columns by row, in their order."""
    start, grouped = np.zeros(n + 1, dtype=np.int32), np.empty(len(columns), dtype=np.int32)
    link(group)(rows.astype(np.int32, copy=False), columns.astype(np.int32, copy=False), start, grouped)
    return start, grouped


def _second_neighbours(owner: Ints, neighbour: Ints, n: int, cells: _Index) -> tuple[_Index, _Index]:
    """The given cells, each beside the neighbours of its neighbours (not itself, nor its neighbours)."""
    ones = np.ones(2 * len(owner), dtype=np.int32)
    ends = (np.concatenate([owner, neighbour]), np.concatenate([neighbour, owner]))
    adjacent = sparse.csr_array((ones, ends), shape=(n, n))
    second = sparse.coo_array(adjacent[cells] @ adjacent)
    near = sparse.csr_array(adjacent[cells]).tocoo()
    rows, columns = cells[second.row], second.col.astype(np.intp)
    known = np.isin(rows * n + columns, np.concatenate([cells[near.row] * n + near.col, cells * (n + 1)]))
    return rows[~known], columns[~known]


def _nearly_singular(matrix: Floats, least: float) -> _Mask:
    """Which of the matrices (n, 3, 3) have their smallest eigenvalue below ``least`` of the largest."""
    T = _components(matrix)
    suspect: _Mask = tensor.det(T) <= 27.0 * least * (tensor.trace(T) / 3.0) ** 3
    # With eigenvalues λ₁ ≥ λ₂ ≥ λ₃, det ≤ λ₃ λ₁² and λ₁ ≤ 3·(trace/3): no λ₃ < least·λ₁ goes unsuspected.
    values = np.linalg.eigvalsh(matrix[suspect])
    suspect[suspect] = values[:, 0] <= least * values[:, 2]
    return suspect


def _invert(matrix: Floats, least: float) -> Floats:
    """Inverses of symmetric positive semidefinite (n, 3, 3), pseudo-inverses of nearly singular ones."""
    poor = _nearly_singular(matrix, least)
    safe = np.where(poor[:, None, None], np.eye(3), matrix)
    result = np.stack(tensor.inverse(_components(safe)), axis=1).reshape(-1, 3, 3)
    values, vectors = np.linalg.eigh(matrix[poor])
    kept = values > least * values[:, -1:]
    scaled = np.where(kept, 1.0 / np.where(kept, values, 1.0), 0.0)
    result[poor] = np.einsum("nij,nj,nkj->nik", vectors, scaled, vectors)
    return result


def _components(matrix: Floats) -> tensor.Tensor:
    """The nine columns of matrices (n, 3, 3)."""
    T = matrix.reshape(-1, 9).T
    return T[0], T[1], T[2], T[3], T[4], T[5], T[6], T[7], T[8]


def _face_points(mesh: Mesh, faces: _Index) -> tuple[_Index, _Index]:
    """Points of boundary faces, and for each the position of its face in ``faces``."""
    begin = mesh.face_start[mesh.n_internal + faces].astype(np.intp)
    count = np.diff(mesh.face_start)[mesh.n_internal + faces].astype(np.intp)
    owner = np.repeat(np.arange(len(faces)), count)
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    return mesh.face_points[begin[owner] + within].astype(np.intp), owner


def from_points(mesh: Mesh, points: Floats) -> tuple[Floats, Floats]:
    """Nodal u and l from velocities at the mesh points alone, (n_points, 3) in m/s.

    Each cell's gradient is the least-squares fit to its points, continued to the nodes as in
    :class:`Reconstruction` but without second derivatives.
    """
    rows = mesh.cell_points.astype(np.intp)
    columns = np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_point_start))
    count = np.diff(mesh.cell_point_start)[:, None]

    def mean(values: Floats) -> Floats:
        return np.stack([np.bincount(columns, column, mesh.n_cells) for column in values.T], axis=1) / count

    middle, average = mean(mesh.points[rows]), mean(points[rows])
    arms, differences = mesh.points[rows] - middle[columns], points[rows] - average[columns]
    matrix, right = np.empty((mesh.n_cells, 3, 3)), np.empty((mesh.n_cells, 3, 3))
    for j in range(3):
        matrix[:, j] = mean(arms * arms[:, j, None])
        right[:, :, j] = mean(differences * arms[:, j, None])
    l = np.einsum("nij,njk->nik", right, _invert(matrix, 1e-12))
    u = average + np.einsum("nij,nj->ni", l, mesh.centres - middle)
    # A point's gradient is the mean over its cells, which is what a Taylor series without bends gives.
    around = _grouped(rows, columns, mesh.n_points)
    _, l_points = _continued(mesh.points, mesh.centres, around, u, l)
    return np.concatenate([points, u]), np.concatenate([l_points, l])
