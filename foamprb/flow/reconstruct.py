"""Reconstruction of u and ∇u at the nodes of the tetrahedra from cell and boundary values.

Gradients are least-squares fits over face neighbours and boundary values. The gradient of the gradients gives
the second derivatives, whose contribution is then subtracted from the differences, so that quadratic fields
are reproduced. The value at a node is the weighted mean of the Taylor series about its cells; on a wall the
wall's values count. In tetrahedra, prisms and polyhedra off the walls the gradients at the points of a cell
give better second derivatives, and these better gradients, until they stay.

A value that a boundary face has from its cell, as at an outlet, belongs to the point opposite the centre of
the cell. The gradient continues it to the centre of the face.

The field continues beyond a symmetry plane, an empty patch, a wedge or a cyclic patch: each cell there has an
image (:mod:`foamprb.flow.images`) with known values, which counts as a neighbour.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.gradient import (
    PAIR_OF,
    PAIRS,
    LeastSquaresGradient,
    PointGradient,
    grouped,
    mean_series,
)
from foamprb.flow.images import Images, points_of_faces
from foamprb.flow.mesh.layer import layer_of
from foamprb.flow.mesh.lists import Index, Mask, share
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import VALUELESS, PatchKind

_SMOOTH = 0.9
"""Least cosine between a face's normal and the mean around its corner on a surface that is smooth there."""
_MOST_OFFSET = 0.3
"""Largest distance of a wall from the face, over that of the cell's centre."""
_SAME_NORMAL = 0.07
"""Largest squared tangent of half the angle between two facets of a smooth surface, 30°."""
_MOST_PASSES = 5
_CHANGE = 1e-3
"""Change of the gradients in a pass, over the gradients, after which no other one follows; norms."""


class Reconstruction:
    """Operator from the cell and boundary values of a mesh to u and ∇u at its nodes.

    Parameters
    ----------
    mesh
        The mesh.
    valued
        (n_boundary,) mask of boundary faces with a value; by default all except of
        :data:`~foamprb.flow.patches.VALUELESS` types.
    """

    def __init__(self, mesh: Mesh, valued: Mask | None = None) -> None:
        patch_of_face = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
        if valued is None:
            valued = np.array([p.type not in VALUELESS for p in mesh.patches], dtype=bool)[patch_of_face]
        walls = np.array([p.kind is PatchKind.WALL for p in mesh.patches], dtype=bool)[patch_of_face] & valued
        self.mesh = mesh
        self._valued, self._walls = np.flatnonzero(valued), np.flatnonzero(walls)
        self._on_walls = np.unique(points_of_faces(mesh, self._walls)[0])
        self._open = ~walls[self._valued]
        self._owner = mesh.owner[mesh.n_internal :].astype(np.intp)
        self._images, self._layer = images, _ = Images(mesh), layer_of(mesh)
        n = mesh.n_cells
        # Boundary faces with values and images are sites like cell centres.
        places = mesh.boundary_centres.copy()
        places[self._walls] += wall_offsets(mesh, self._walls)
        self._sites = np.concatenate([mesh.centres, places[self._valued], images.places])
        self._of_images = slice(n + len(self._valued), len(self._sites))
        self._of_faces = slice(n, self._of_images.start)
        faces = np.concatenate([self._valued, images.faces])
        numbers = np.arange(n, len(self._sites), dtype=np.int32)
        self._gradient = LeastSquaresGradient.over_faces(mesh, self._sites, faces, numbers)
        imaged = len(self._valued)
        self._across = LeastSquaresGradient.over_faces(
            mesh, self._sites, faces[imaged:], numbers[imaged:], least=0.01
        )
        regular = (np.diff(mesh.cell_point_start) == 8) & (np.diff(mesh.cell_face_start) == 6)
        regular[self._owner[self._walls]] = True
        # Their neighbours lie evenly around hexahedra; beside a wall the errors of a finite-volume solution
        # exceed those of the first estimate.
        self._settled = np.flatnonzero(regular)
        self._passes = 1 + (_MOST_PASSES if len(self._settled) < n else 0)
        rows, columns = (part.astype(np.int32) for part in points_of_faces(mesh, faces))
        of_cells = np.repeat(np.arange(n, dtype=np.int32), np.diff(mesh.cell_point_start))
        self._around = grouped(
            np.concatenate([mesh.cell_points, rows]), np.concatenate([of_cells, n + columns]), mesh.n_points
        )

    def __call__(self, cells: Floats, boundary: Floats) -> tuple[Floats, Floats]:
        """Reconstruct a field.

        Parameters
        ----------
        cells
            (n_cells, 3) velocity at cell centres, m/s.
        boundary
            (n_boundary, 3) velocity at boundary faces; rows of faces without a value are ignored.

        Returns
        -------
        u, l
            (n_nodes, 3) and (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j, mesh points first, then cell centres.
        """
        n, n_points = self.mesh.n_cells, self.mesh.n_points
        u = np.concatenate([cells, boundary[self._valued], self._images.turned(cells)])
        slopes, bends = self._derivatives(u)
        u_nodes, l_nodes = np.empty((n_points + n, 3)), np.empty((n_points + n, 3, 3))
        u_nodes[n_points:], l_nodes[n_points:] = cells, slopes[:n]
        at_points = u_nodes[:n_points], l_nodes[:n_points]
        self._average(u, slopes, bends, *at_points)
        self._impose_walls(at_points[0], boundary, slopes, bends)
        for values, fixed in zip(at_points, (self._on_walls, None), strict=True):
            self._images.agree(values, fixed)
        if self._layer is not None:
            self._layer.flatten(self.mesh, u_nodes, l_nodes, self._on_walls)
        return u_nodes, l_nodes

    def scalars(self, cells: Floats, boundary: Floats) -> tuple[Floats, Floats]:
        """Reconstruct three scalars within the range of the values around a node, so that they stay positive.

        Parameters
        ----------
        cells, boundary
            (n_cells, 3) and (n_boundary, 3); :func:`mean_series` takes three at a time.

        Returns
        -------
        values, slopes
            (n_nodes, 3) and their least-squares gradients (n_nodes, 3, 3).
        """
        mesh, images, m = self.mesh, self._images, cells.shape[1]
        n, owner = mesh.n_cells, self._owner[self._valued]
        at_sites = np.concatenate([cells, boundary[self._valued], cells[images.cells]])
        slopes_of_cells = np.zeros((n, m, 3))
        self._gradient(at_sites, slopes_of_cells)
        values = np.concatenate([self._means(at_sites), cells])
        if len(self._walls):
            rows, columns = points_of_faces(mesh, self._walls)
            on_wall, place = np.unique(rows, return_inverse=True)
            count = np.bincount(place)
            for f in range(m):
                at_faces = boundary[self._walls, f]
                values[on_wall, f] = np.bincount(place, at_faces[columns]) / count
        slopes = np.zeros((mesh.n_points + n, m, 3))
        for f in range(m):
            own = slopes_of_cells[:, f]
            slopes[: mesh.n_points, f] = self._means(np.concatenate([own, own[owner], images.turned(own)]))
            images.agree(slopes[: mesh.n_points, f])
            slopes[mesh.n_points :, f] = own
        return values, slopes

    def scalar(self, cells: Floats, boundary: Floats) -> Floats:
        """Return a scalar and its gradient at the nodes, (n_nodes, 4).

        ``cells`` (n_cells,) and ``boundary`` (n_boundary,) are its values; see :meth:`scalars`, which takes
        three.
        """
        values, slopes = self.scalars(*(np.repeat(a[:, None], 3, axis=1) for a in (cells, boundary)))
        return np.concatenate([values[:, :1], slopes[:, 0]], axis=1)

    def linear(self, cells: Floats, boundary: Floats) -> Floats:
        """Return a scalar, a vector or a tensor at the nodes, (n_nodes, 3, …); linear fields are exact.

        ``cells`` (n_cells, 3, …) and ``boundary`` (n_boundary, 3, …) are its values. Beside a front it may
        exceed their range.
        """
        return self._at_nodes(*self._with_slopes(cells, boundary))

    def gradient(self, cells: Floats, boundary: Floats) -> Floats:
        """Return the gradient of a scalar, a vector or a tensor at the nodes, (n_nodes, 3, …, 3).

        See :meth:`linear`. The last index is that of the derivative; gradients of linear fields are exact.
        """
        return self._at_nodes(self._with_slopes(cells, boundary)[1])

    def _with_slopes(self, cells: Floats, boundary: Floats) -> tuple[Floats, Floats]:
        """Return values (n_sites, …) and least-squares gradients (n_sites, …, 3) at all sites."""
        owner, turned = self._owner[self._valued], self._images.turned
        values = np.concatenate([cells, boundary[self._valued], turned(cells)])
        flat = values.reshape(len(values), -1)
        found = np.zeros((self.mesh.n_cells, flat.shape[1], 3))
        self._gradient(flat, found)
        slopes = found.reshape(*cells.shape, 3)
        return values, np.concatenate([slopes, slopes[owner], turned(slopes)])

    def _at_nodes(self, values: Floats, slopes: Floats | None = None) -> Floats:
        """Return values at all sites, (n_sites, …), at the nodes; see :meth:`_means`."""
        flat = values.reshape(len(values), -1)
        at_points = np.empty((self.mesh.n_points, flat.shape[1]))
        for k in range(0, flat.shape[1], 3):
            three = np.minimum(np.arange(k, k + 3), flat.shape[1] - 1)
            own = None if slopes is None else np.take(slopes.reshape(*flat.shape, 3), three, 1)
            at_points[:, three] = self._means(np.take(flat, three, 1), own)
        shape = values.shape[1:]
        return np.concatenate([at_points.reshape(-1, *shape), values[: self.mesh.n_cells]])

    def _means(self, values: Floats, slopes: Floats | None = None) -> Floats:
        """Average values (n_sites, 3) at the mesh points, (n_points, 3), by the inverse distance.

        With gradients (n_sites, 3, 3) they are continued to the points first.
        """
        m = values.shape[1]
        means, nothing = np.empty((self.mesh.n_points, m)), np.empty((self.mesh.n_points, m, 3))
        l = np.zeros((len(values), m, 3)) if slopes is None else slopes
        self._average(values, l, np.zeros((len(values), m, 6)), means, nothing)
        return means

    def _average(self, u: Floats, l: Floats, h: Floats, u_points: Floats, l_points: Floats) -> None:
        """Average the Taylor series about the sites at the mesh points, in ``u_points`` and ``l_points``."""
        points, (start, columns) = self.mesh.points, self._around

        def part(low: int, high: int) -> None:
            results = u_points[low:high], l_points[low:high]
            for result in results:
                result[:] = 0.0
            link(mean_series)(
                points[low:high], self._sites, start[low : high + 1], columns, u, l, h, *results
            )

        share(len(points), part)

    def _derivatives(self, u: Floats) -> tuple[Floats, Floats]:
        """Return first derivatives (n_sites, 3, 3) and second derivatives (n_sites, 3, 6) at all sites.

        Values of boundary faces in ``u`` that are those of their cells are continued to the faces.
        """
        n, n_points = self.mesh.n_cells, self.mesh.n_points
        owner = self._owner[self._valued]
        own = np.flatnonzero(self._open & np.all(u[self._of_faces] == u[owner], axis=1))
        slopes, bends = np.zeros((len(u), 3, 3)), np.zeros((len(u), 3, 6))
        around, nothing = np.empty((n + n_points, 3, 3)), np.empty((n_points, 3))
        self._gradient(u, slopes[:n])
        self._beyond(u, slopes, bends, own)
        for number in range(self._passes):
            if number == 0:
                self._across.bends(slopes, bends[:n])
            else:
                self._average(u, slopes, bends, nothing, around[n:])
                self._images.agree(around[n:])
                kept = bends[self._settled]
                self._inside.average(around.reshape(-1, 9))
                self._inside.fit.bends(around, bends[:n])
                bends[self._settled] = kept
            before = slopes[:n].copy() if self._passes > 1 else slopes[:0]
            self._gradient(u, slopes[:n], bends=bends[:n])
            self._beyond(u, slopes, bends, own)
            before -= slopes[: len(before)]
            if len(before) == 0 or _norm(before) <= _CHANGE * _norm(slopes[:n]):
                break
        return slopes, bends

    @cached_property
    def _inside(self) -> PointGradient:
        return PointGradient(self.mesh)

    def _beyond(self, u: Floats, l: Floats, h: Floats, own: Index) -> None:
        """Continue derivatives from the cells beyond the boundary, and values to boundary faces ``own``."""
        n, images, valued = self.mesh.n_cells, self._images, self._valued
        owner = self._owner[valued]
        h[self._of_faces] = h[owner]
        l[self._of_faces] = self._at_faces(valued, l, h)
        l[self._of_images] = images.turned(l[:n])
        turned = images.turned(h, lambda own: own[:, :, PAIR_OF])
        for pair, (j, k) in enumerate(PAIRS):
            h[self._of_images, :, pair] = turned[:, :, j, k]
        if len(own):
            faces, cells = valued[own], owner[own]
            normals = _normals(self.mesh, faces)
            arms = self.mesh.boundary_centres[faces] - self.mesh.centres[cells]
            arms -= np.einsum("ni,ni->n", arms, normals)[:, None] * normals
            mean = l[cells] + 0.5 * np.einsum("nijk,nk->nij", h[cells][:, :, PAIR_OF], arms)
            u[n + own] = u[cells] + np.einsum("nij,nj->ni", mean, arms)

    def _at_faces(self, faces: Index, l: Floats, h: Floats) -> Floats:
        """Extrapolate gradients from the cells to their boundary faces."""
        owner = self._owner[faces]
        arms = self.mesh.boundary_centres[faces] - self.mesh.centres[owner]
        faces_l: Floats = l[owner] + np.einsum("nijk,nk->nij", h[owner][:, :, PAIR_OF], arms)
        return faces_l

    def _impose_walls(self, u_points: Floats, boundary: Floats, l: Floats, h: Floats) -> None:
        """Set the velocity at points of walls.

        Where the wall faces around a point have the same velocity, the point has exactly this velocity;
        elsewhere their values are extrapolated to the point.
        """
        mesh, faces = self.mesh, self._walls
        if len(faces) == 0:
            return
        rows, columns = points_of_faces(mesh, faces)
        values = boundary[faces]
        on_wall, place = np.unique(rows, return_inverse=True)
        start, around = grouped(place, columns, len(on_wall))
        mean, _ = _continued(
            mesh.points[on_wall], mesh.boundary_centres[faces], (start, around),
            values, self._at_faces(faces, l, h),
        )  # fmt: skip
        low = np.minimum.reduceat(values[around], start[:-1])
        high = np.maximum.reduceat(values[around], start[:-1])
        apart = np.any(low != high, axis=1)
        u_points[on_wall] = np.where(apart[:, None], mean, low)
        across = np.abs(np.einsum("ni,ni->n", _normals(mesh, faces), values))
        tight = across <= 1e-9 * np.linalg.norm(values, axis=1)
        # Nothing flows through walls that meet at a point, though one of them moves.
        apart &= np.bincount(place, ~tight[columns], len(on_wall)) == 0
        slide(mesh, u_points, faces, on_wall[apart])


def slide(mesh: Mesh, u_points: Floats, faces: Index, points: Index | None = None) -> None:
    """Subtract from velocities at mesh points, in place, their components across the boundary faces there.

    Facets of a smooth surface have one normal at a point, the mean one; faces that meet at an edge or a
    corner have two or three.

    Parameters
    ----------
    u_points
        (n_points, 3), m/s.
    faces
        Boundary faces.
    points
        Points at which velocities change; by default all points of the faces.
    """
    rows, columns = points_of_faces(mesh, faces)
    own = np.unique(rows) if points is None else points
    place, normals = np.searchsorted(own, rows), _normals(mesh, faces)
    at = np.flatnonzero(np.isin(rows, own))
    squares = np.zeros((len(own), 3, 3))
    np.add.at(squares, place[at], normals[columns[at], :, None] * normals[columns[at], None, :])
    values, vectors = np.linalg.eigh(squares)
    across = np.einsum("pki,pk->pi", vectors, u_points[own])
    across[values <= _SAME_NORMAL * values[:, 2:]] = 0.0
    u_points[own] -= np.einsum("pki,pi->pk", vectors, across)


def _normals(mesh: Mesh, faces: Index) -> Floats:
    """Return the unit normals of boundary faces, (n, 3)."""
    areas = mesh.boundary_areas[faces]
    normals: Floats = areas / np.maximum(np.linalg.norm(areas, axis=1), 1e-300)[:, None]
    return normals


def _norm(values: Floats) -> float:
    """Return the norm of values (n, 3, 3), which is the same for any number of threads, unlike with BLAS."""
    return math.sqrt(np.einsum("nij,nij->", values, values))


def wall_offsets(mesh: Mesh, faces: Index) -> Floats:
    """Return the way from the centres of wall faces to the curved wall that they approximate, (n, 3), m.

    The corners of a face lie on the wall, its centre does not. Thin cells resolve the flow over the faces.
    In a simple cell (:attr:`~foamprb.flow.mesh.mesh.Mesh.simple`) that is as high as wide the value is that
    of a flow over the curved wall. The distance is that of a quadratic surface through the n corners with
    the mean normals there, Σ n_i·(x_i − x)/2n. Zero in all other cells.
    """
    owner = mesh.owner[mesh.n_internal + faces]
    if not mesh.simple[owner].any():
        return np.zeros((len(faces), 3))
    corners, columns = points_of_faces(mesh, faces)
    areas, centres, normals = mesh.boundary_areas[faces], mesh.boundary_centres[faces], _normals(mesh, faces)
    total = np.zeros((mesh.n_points, 3))
    np.add.at(total, corners, areas[columns])
    mean = total[corners] / np.maximum(np.linalg.norm(total[corners], axis=1), 1e-300)[:, None]
    smooth = np.einsum("ni,ni->n", mean, normals[columns]) >= _SMOOTH
    arms = mesh.points[corners] - centres[columns]
    terms = np.where(smooth, np.einsum("ni,ni->n", mean - normals[columns], arms), 0.0)
    n = np.maximum(np.bincount(columns, minlength=len(faces)), 1)
    depth = np.bincount(columns, terms, len(faces)) / (2 * n)
    height = np.einsum("ni,ni->n", centres - mesh.centres[owner], normals)
    near = mesh.simple[owner] & (np.abs(depth) <= _MOST_OFFSET * height)
    offsets: Floats = np.where(near, depth, 0.0)[:, None] * normals
    return offsets


def _continued(
    points: Floats, sites: Floats, around: tuple[Ints, Ints], u: Floats, l: Floats
) -> tuple[Floats, Floats]:
    """Average at points the Taylor series about sites, from values and first derivatives."""
    at_points = np.zeros((len(points), 3)), np.zeros((len(points), 3, 3))
    link(mean_series)(points, sites, *around, u, l, np.zeros((len(sites), 3, 6)), *at_points)
    return at_points


def from_points(mesh: Mesh, points: Floats) -> tuple[Floats, Floats]:
    """Return nodal u and l from velocities at the mesh points alone, (n_points, 3), m/s.

    Each cell's gradient is the least-squares fit to its points; the nodes average these as in
    :class:`Reconstruction`, without second derivatives.
    """
    n, fit = mesh.n_cells, PointGradient(mesh)
    l = np.empty((n, 3, 3))
    values = np.concatenate([np.empty((n, 3)), points])
    mean = fit.average(values)
    fit.fit(values, l)
    u = mean + np.einsum("nij,nj->ni", l, mesh.centres - fit.middles)
    columns = np.repeat(np.arange(n, dtype=np.int32), np.diff(mesh.cell_point_start))
    # Without second derivatives the Taylor series average the gradients of the cells.
    around = grouped(mesh.cell_points, columns, mesh.n_points)
    _, l_points = _continued(mesh.points, mesh.centres, around, u, l)
    u, l = np.concatenate([points, u]), np.concatenate([l_points, l])
    if (layer := layer_of(mesh)) is not None:
        layer.flatten(mesh, u, l)
    return u, l
