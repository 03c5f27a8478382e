"""Cell values and wall values → u and ∇u at the nodes of the tetrahedra, continuous in between.

Gradients come from least squares over face neighbours and boundary values. The gradient of the gradients
gives the second derivatives, whose part in the differences is then taken off again, so that quadratic fields
are met beside a wall nearly as well as in the core. A node's value is the weighted mean of what its cells say
about it by Taylor's formula; on a wall the wall's own values decide.

Beyond a symmetry plane, an empty patch, a wedge or a cyclic patch the field goes on: each cell there has an
image, whose values are known, and which counts as a neighbour like any other.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.spatial import KDTree

from foamprb.flow.coupling import Coupling
from foamprb.flow.mesh import Floats, Mesh
from foamprb.flow.patch import WALLS

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

# The six second derivatives: pairs of directions, and how often each occurs in ½ d·H·d.
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
_TIMES = (0.5, 0.5, 0.5, 1.0, 1.0, 1.0)
_PAIR_OF = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])


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
        self._images = _Images(mesh)
        self._gradient = _Gradient(mesh, self._valued, self._images)
        self._bend = _Gradient(mesh, np.empty(0, dtype=np.intp), self._images, least=0.01)
        self._curvature = self._gradient.curvature()

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
        if l is None:
            l, h = self.derivatives(cells, boundary)
        else:
            h = self._second(l)
        u_points, l_points = self._at_points(cells, boundary, l, h)
        return np.concatenate([u_points, cells]), np.concatenate([l_points, l])

    def derivatives(self, cells: Floats, boundary: Floats) -> tuple[Floats, Floats]:
        """First derivatives (n_cells, 3, 3) and second derivatives (n_cells, 3, 6) at cell centres.

        The order of the second derivatives is xx, yy, zz, xy, xz, yz.
        """
        # One correction: beside a wall, the cell values of a finite-volume solution are themselves off by as
        # much as a second would change.
        beyond = self._images.turned(cells)
        plain = self._gradient(cells, np.concatenate([boundary[self._valued], beyond]))
        h = self._second(plain)
        return plain - np.einsum("njp,nip->nij", self._curvature, h), h

    def _second(self, l: Floats) -> Floats:
        """Second derivatives from the first."""
        slopes = self._bend(l.reshape(-1, 9), self._images.turned(l).reshape(-1, 9)).reshape(-1, 3, 3, 3)
        return np.stack([0.5 * (slopes[:, :, j, k] + slopes[:, :, k, j]) for j, k in _PAIRS], axis=2)

    def _at_points(self, cells: Floats, boundary: Floats, l: Floats, h: Floats) -> tuple[Floats, Floats]:
        mesh, faces, images = self.mesh, self._valued, self._images
        rows, columns = _face_points(mesh, faces)
        more_rows, more_columns = _face_points(mesh, images.faces)
        around = _Taylor(
            mesh.points,
            np.concatenate([mesh.centres, mesh.boundary_centres[faces], images.places]),
            np.concatenate([mesh.cell_points, rows, more_rows]),
            np.concatenate(
                [
                    np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_point_start)),
                    mesh.n_cells + columns,
                    mesh.n_cells + len(faces) + more_columns,
                ]
            ),
        )
        # A boundary face is a place like a cell centre; its derivatives are those of its cell.
        slopes = h[:, :, _PAIR_OF]
        l_faces = self._at_faces(faces, l, slopes)
        l_sites = np.concatenate([l, l_faces, images.turned(l)])
        bends = np.concatenate([slopes, slopes[self._owner[faces]], images.turned(slopes)])
        h_sites = np.stack([bends[:, :, j, k] for j, k in _PAIRS], axis=2)
        u_points = around(np.concatenate([cells, boundary[faces], images.turned(cells)]), l_sites, h_sites)
        l_points = around(l_sites.reshape(-1, 9), bends.reshape(-1, 9, 3)).reshape(-1, 3, 3)
        self._impose_walls(u_points, boundary, self._at_faces(self._walls, l, slopes))
        return images.agree(u_points), images.agree(l_points)

    def _at_faces(self, faces: _Index, l: Floats, slopes: Floats) -> Floats:
        """Gradients continued from the cells to their boundary faces."""
        owner = self._owner[faces]
        arms = self.mesh.boundary_centres[faces] - self.mesh.centres[owner]
        faces_l: Floats = l[owner] + np.einsum("nijk,nk->nij", slopes[owner], arms)
        return faces_l

    def _impose_walls(self, u_points: Floats, boundary: Floats, l: Floats) -> None:
        """Give the points of walls the wall's velocity, from the gradients at the wall's faces.

        Where the wall's faces about a point move alike, the point moves so too, exactly; elsewhere their
        values are continued to the point.
        """
        mesh, faces = self.mesh, self._walls
        if len(faces) == 0:
            return
        rows, columns = _face_points(mesh, faces)
        values = boundary[faces]
        mean = _Taylor(mesh.points, mesh.boundary_centres[faces], rows, columns)(values, l)
        order = np.argsort(rows, kind="stable")
        on_wall, first = np.unique(rows[order], return_index=True)
        low = np.minimum.reduceat(values[columns[order]], first)
        high = np.maximum.reduceat(values[columns[order]], first)
        u_points[on_wall] = np.where(np.all(low == high, axis=1, keepdims=True), low, mean[on_wall])


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

    def turned(self, values: Floats) -> Floats:
        """What the images have of the cells' tensors of any rank, (n_cells, 3, …, 3)."""
        return _turned(self._turns, values[self.cells])

    def agree(self, points: Floats) -> Floats:
        """Tensors at the mesh points (n_points, 3, …, 3), made to agree with their images."""
        points = points.copy()
        for rows, mirrors in self._planes:
            points[rows] = 0.5 * (points[rows] + _turned(mirrors, points[rows]))
        for here, there, turn in self._seams:
            turns = np.broadcast_to(turn, (len(here), 3, 3))
            mean = 0.5 * (_turned(turns, points[here]) + points[there])
            points[here], points[there] = _turned(turns.transpose(0, 2, 1), mean), mean
            still = here[here == there]
            if len(still) and np.any(turn != np.eye(3)):
                points[still] = _about(turn, points[still])
        return points


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

    def __init__(self, mesh: Mesh, valued: _Index, images: _Images, least: float = 1e-6) -> None:
        n = mesh.n_cells
        owner, neighbour = mesh.owner.astype(np.intp), mesh.neighbour.astype(np.intp)
        inner = owner[: mesh.n_internal]
        outer = np.concatenate([valued, images.faces])
        rows = np.concatenate([inner, neighbour, owner[mesh.n_internal + outer]])
        columns = np.concatenate([neighbour, inner, n + np.arange(len(outer))])
        sites = np.concatenate([mesh.centres, mesh.boundary_centres[valued], images.places])
        matrix = _directions(mesh.centres, sites, rows, columns)
        open_cells = np.flatnonzero(_nearly_singular(matrix, least))
        if len(open_cells):
            more_rows, more_columns = _second_neighbours(inner, neighbour, n, open_cells)
            rows, columns = np.concatenate([rows, more_rows]), np.concatenate([columns, more_columns])
            matrix = _directions(mesh.centres, sites, rows, columns)
        rows, self._columns, self._start = _by_row(rows, columns, n)
        self._shape = (n, len(sites))
        self._rows = rows
        self._arms = sites[self._columns] - mesh.centres[rows]
        square = np.einsum("ei,ei->e", self._arms, self._arms)
        weight = 1.0 / np.where(square > 0.0, square, np.inf)
        inverse = _invert(matrix, least)
        self._parts = []
        self._own = np.empty((n, 3))
        for i in range(3):
            data = weight * np.einsum("ej,ej->e", inverse[rows, i], self._arms)
            self._parts.append(sparse.csr_array((data, self._columns, self._start), shape=self._shape))
            self._own[:, i] = np.bincount(rows, data, n)

    def __call__(self, cells: Floats, boundary: Floats) -> Floats:
        """Gradients (n_cells, m, 3) of m fields at cells (n_cells, m), valued faces and images (…, m)."""
        values = np.concatenate([cells, boundary])
        gradient = np.empty((*cells.shape, 3))
        for i, part in enumerate(self._parts):
            gradient[:, :, i] = part @ values - self._own[:, i, None] * cells
        return gradient

    def curvature(self) -> Floats:
        """What second derivatives of one do to the gradient, (n_cells, 3, 6)."""
        n = self._shape[0]
        effect = np.empty((n, 3, 6))
        for i, part in enumerate(self._parts):
            for pair, ((j, k), times) in enumerate(zip(_PAIRS, _TIMES, strict=True)):
                term = part.data * self._arms[:, j] * self._arms[:, k]
                effect[:, i, pair] = times * np.bincount(self._rows, term, n)
        return effect


class _Taylor:
    """Means at points, weighted by inverse distance, of the Taylor series about sites."""

    def __init__(self, points: Floats, sites: Floats, rows: _Index, columns: _Index) -> None:
        rows, self._columns, self._start = _by_row(rows, columns, len(points))
        self._shape = (len(points), len(sites))
        self._arms = points[rows] - sites[self._columns]
        distance = np.sqrt(np.einsum("ei,ei->e", self._arms, self._arms))
        weight = 1.0 / np.maximum(distance, 1e-300)
        self._weights = weight / np.bincount(rows, weight, len(points))[rows]

    def __call__(self, values: Floats, slopes: Floats, bends: Floats | None = None) -> Floats:
        """Means (n_points, m) of values (n_sites, m), slopes (…, m, 3) and second derivatives (…, m, 6)."""
        total = self._mean(self._weights, values)
        for i in range(3):
            total += self._mean(self._weights * self._arms[:, i], slopes[:, :, i])
        if bends is not None:
            for pair, ((j, k), times) in enumerate(zip(_PAIRS, _TIMES, strict=True)):
                weights = times * self._weights * self._arms[:, j] * self._arms[:, k]
                total += self._mean(weights, bends[:, :, pair])
        return total

    def _mean(self, weights: Floats, values: Floats) -> Floats:
        matrix = sparse.csr_array((weights, self._columns, self._start), shape=self._shape)
        return np.asarray(matrix @ np.ascontiguousarray(values))


def _by_row(rows: _Index, columns: _Index, n: int) -> tuple[_Index, _Index, _Index]:
    """Entries of a sparse matrix of n rows, sorted by row: rows, columns, start of each row.

    Two cells may share several faces; unlike scipy's own conversion this keeps every entry.
    """
    # With a column of its own for each entry the conversion is a counting sort, and loses none.
    entries = np.arange(len(rows))
    sorted_rows = sparse.csr_array((np.ones(len(rows), dtype=np.int8), (rows, entries)), shape=(n, len(rows)))
    order = sorted_rows.indices
    return rows[order], columns[order], sorted_rows.indptr.astype(np.intp)


def _directions(centres: Floats, sites: Floats, rows: _Index, columns: _Index) -> Floats:
    """Sum of e ⊗ e over the unit vectors e from each centre to its sites, (n, 3, 3)."""
    arms = sites[columns] - centres[rows]
    arms /= np.maximum(np.sqrt(np.einsum("ei,ei->e", arms, arms)), 1e-300)[:, None]
    matrix = np.empty((len(centres), 3, 3))
    for i in range(3):
        for j in range(i, 3):
            matrix[:, i, j] = matrix[:, j, i] = np.bincount(rows, arms[:, i] * arms[:, j], len(centres))
    return matrix


def _second_neighbours(owner: _Index, neighbour: _Index, n: int, cells: _Index) -> tuple[_Index, _Index]:
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
    suspect: _Mask = np.linalg.det(matrix) <= 27.0 * least * (np.trace(matrix, axis1=1, axis2=2) / 3.0) ** 3
    # With eigenvalues λ₁ ≥ λ₂ ≥ λ₃, det ≤ λ₃ λ₁² and λ₁ ≤ 3·(trace/3): no λ₃ < least·λ₁ goes unsuspected.
    values = np.linalg.eigvalsh(matrix[suspect])
    suspect[suspect] = values[:, 0] <= least * values[:, 2]
    return suspect


def _invert(matrix: Floats, least: float) -> Floats:
    """Inverses of symmetric positive semidefinite (n, 3, 3), pseudo-inverses of nearly singular ones."""
    poor = _nearly_singular(matrix, least)
    safe = matrix.copy()
    safe[poor] = np.eye(3)
    inverse = np.empty_like(matrix)
    inverse[:] = np.linalg.inv(safe)
    values, vectors = np.linalg.eigh(matrix[poor])
    kept = values > least * values[:, -1:]
    scaled = np.where(kept, 1.0 / np.where(kept, values, 1.0), 0.0)
    inverse[poor] = np.einsum("nij,nj,nkj->nik", vectors, scaled, vectors)
    return inverse


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
    # A point's gradient is the mean over its cells, which is what a Taylor series without slopes gives.
    around = _Taylor(mesh.points, mesh.centres, rows, columns)
    l_points = around(l.reshape(-1, 9), np.zeros((mesh.n_cells, 9, 3))).reshape(-1, 3, 3)
    return np.concatenate([points, u]), np.concatenate([l_points, l])
