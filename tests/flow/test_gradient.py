"""Least squares: inverses of matrices that may be singular, and which cells count as neighbours."""

from __future__ import annotations

import numpy as np
from mesh_shapes import block, corners, grid

from foamprb.flow import gradient
from foamprb.flow.gradient import LeastSquaresGradient, grouped, invert
from foamprb.flow.mesh.mesh import build_mesh

NONE = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int32)


def symmetric(random, values):
    """Matrices with these eigenvalues and random axes; and the axes."""
    axes = np.linalg.qr(random.normal(size=(len(values), 3, 3)))[0]
    return np.einsum("nij,nj,nkj->nik", axes, values, axes), axes


def test_matrices_are_inverted_in_the_directions_that_they_know(random):
    """An eigenvalue below the given share of the largest counts as none."""
    values = np.array(
        [[3.0, 2.0, 1.0], [5.0, 1.0, 1e-4], [5.0, 1.0, 1e-8], [2.0, 1e-9, 0.0], [0.0, 0.0, 0.0]]
    )
    values = np.concatenate([values * scale for scale in (1.0, 1e-12, 1e9)])
    matrix, axes = symmetric(random, values)
    known = values > 1e-6 * values.max(axis=1, keepdims=True)
    exact = np.einsum("nij,nj,nkj->nik", axes, np.where(known, 1.0 / np.where(known, values, 1.0), 0.0), axes)
    found, _ = invert(matrix, 1e-6)
    for k in range(len(values)):
        scale = np.abs(exact[k]).max() or 1.0
        np.testing.assert_allclose(found[k] / scale, exact[k] / scale, rtol=0, atol=1e-6)


def test_pairs_are_sorted_by_row_in_their_order(random):
    rows, columns = random.integers(0, 5, 30), random.integers(0, 99, 30)
    start, found = grouped(rows, columns, 6)
    assert start.tolist() == [0, *np.cumsum(np.bincount(rows, minlength=6))]
    assert found.tolist() == columns[np.argsort(rows, kind="stable")].tolist()
    assert start.dtype == found.dtype == np.int32


def row_of_cells(n):
    """Cubes in a row along x."""
    points, hexes = corners(n, 0.0)
    return build_mesh(grid(points, [(12, hexes[:n])]))


def test_neighbours_of_neighbours_are_neither_the_cell_nor_its_neighbours():
    mesh = row_of_cells(5)
    inner = mesh.owner[: mesh.n_internal]
    rows, columns = gradient._second_neighbours(inner, mesh.neighbour, 5, np.array([0, 2, 4]))
    assert sorted(zip(rows.tolist(), columns.tolist(), strict=True)) == [(0, 2), (2, 0), (2, 4), (4, 2)]
    # Three cells about an edge, of which each is its neighbour's neighbour too, and one beside the last.
    owner, neighbour = np.array([0, 0, 1, 2]), np.array([1, 2, 2, 3])
    rows, columns = gradient._second_neighbours(owner, neighbour, 4, np.array([1, 2, 3]))
    assert sorted(zip(rows.tolist(), columns.tolist(), strict=True)) == [(1, 3), (3, 0), (3, 1)]


def test_the_gradient_fits_differences_by_the_inverse_square_of_the_distance(random):
    """Against numpy's least squares, cell by cell; a cell at a corner asks its neighbours' neighbours."""
    mesh = build_mesh(block(4, 0.4))
    values, found = random.normal(size=(64, 2)), np.zeros((64, 2, 3))
    LeastSquaresGradient.over_faces(mesh, mesh.centres, *NONE)(values, found)
    pairs = np.stack([mesh.owner[: mesh.n_internal], mesh.neighbour], axis=1)
    for c in range(64):
        around = [*pairs[pairs[:, 0] == c, 1], *pairs[pairs[:, 1] == c, 0]]
        d = mesh.centres[around] - mesh.centres[c]
        w = 1.0 / np.linalg.norm(d, axis=1)
        exact = np.linalg.lstsq(w[:, None] * d, w[:, None] * (values[around] - values[c]), rcond=None)[0].T
        np.testing.assert_allclose(found[c], exact, rtol=0, atol=1e-9)


def test_a_row_of_cells_has_a_gradient_along_it_alone():
    """Its ends have one neighbour each; across it nothing is known."""
    mesh = row_of_cells(5)
    slope = np.zeros((5, 1, 3))
    LeastSquaresGradient.over_faces(mesh, mesh.centres, *NONE)(3.0 * mesh.centres[:, :1], slope)
    np.testing.assert_allclose(slope[:, 0], [[3.0, 0.0, 0.0]] * 5, atol=1e-12)


def test_sites_beyond_boundary_faces_count(random):
    """With a site at every boundary face a linear field has its gradient in a single cell."""
    mesh = row_of_cells(1)
    sites = np.concatenate([mesh.centres, mesh.boundary_centres])
    l = random.normal(size=(3, 3))
    for faces in ([0, 1, 2, 3, 4, 5], [5, 3, 1, 0, 2, 4]):
        chosen = np.array(faces)
        found = np.zeros((1, 3, 3))
        LeastSquaresGradient.over_faces(mesh, sites, chosen, (1 + chosen).astype(np.int32))(
            sites @ l.T, found
        )
        np.testing.assert_allclose(found[0], l, atol=1e-12)
