"""Sums over what surrounds a cell or a point, as plain functions, against the same sums by whole arrays."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.flow.gradient import group, mean_series, sum_differences

# xx, yy, zz, xy, xz, yz.
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def square(h):
    """Symmetric matrices (…, 3, 3) of six second derivatives (…, 6)."""
    full = np.empty((*h.shape[:-1], 3, 3))
    for k, (i, j) in enumerate(PAIRS):
        full[..., i, j] = full[..., j, i] = h[..., k]
    return full


def test_values_are_grouped_by_key_in_their_order(random):
    keys, values = random.integers(0, 6, 40), random.integers(0, 1000, 40)
    keys[keys == 4] = 5
    start, grouped = np.zeros(7, dtype=np.int32), np.empty(40, dtype=np.int32)
    group(keys, values, start, grouped)
    assert grouped.tolist() == values[np.argsort(keys, kind="stable")].tolist()
    assert start.tolist() == [0, *np.cumsum(np.bincount(keys, minlength=6))]


@pytest.mark.parametrize("bent", [False, True])
def test_differences_are_summed_with_the_inverse_square_of_the_distance(bent, random):
    n, m, low = 9, 2, 3
    sites, values = random.normal(size=(n, 3)), random.normal(size=(n, m))
    bends = random.normal(size=(n, m, 6)) if bent else np.empty((0, m, 6))
    # The last is the cell itself, at no distance, which says nothing.
    around = [[], [], [], [5, 7, 8, 3], [0, 1, 4], []]
    start = np.concatenate([[0], np.cumsum([len(a) for a in around])])
    sums = np.zeros((3, m, 3))
    sum_differences(sites, start, np.concatenate(around).astype(int), values, bends, low, sums)
    for row, c in enumerate((3, 4, 5)):
        expected = np.zeros((m, 3))
        for s in around[c]:
            d = sites[s] - sites[c]
            if s == c:
                continue
            f = values[s] - values[c]
            if bent:
                f = f - 0.5 * np.einsum("i,mij,j->m", d, square(bends[c]), d)
            expected += np.outer(f, d) / (d @ d)
        np.testing.assert_allclose(sums[row], expected, rtol=1e-13, atol=1e-13)


def test_a_point_has_the_mean_of_the_series_about_the_sites(random):
    n = 5
    sites, points = random.normal(size=(n, 3)), random.normal(size=(3, 3))
    u, l, h = random.normal(size=(n, 3)), random.normal(size=(n, 3, 3)), random.normal(size=(n, 3, 6))
    around = [[0, 3, 4], [], [1, 2]]
    start, columns = np.array([0, 3, 3, 5]), np.array([0, 3, 4, 1, 2])
    u_points, l_points = np.zeros((3, 3)), np.zeros((3, 3, 3))
    mean_series(points, sites, start, columns, u, l, h, u_points, l_points)
    for p in (0, 2):
        d = points[p] - sites[around[p]]
        w = 1.0 / np.linalg.norm(d, axis=1)
        w /= w.sum()
        H = square(h[around[p]])
        at = u[around[p]] + np.einsum("sij,sj->si", l[around[p]], d)
        at += 0.5 * np.einsum("sijk,sj,sk->si", H, d, d)
        np.testing.assert_allclose(u_points[p], w @ at, rtol=1e-13)
        slopes = l[around[p]] + np.einsum("sijk,sk->sij", H, d)
        np.testing.assert_allclose(l_points[p], np.einsum("s,sij->ij", w, slopes), rtol=1e-13)
    # Around the second there is nothing.
    assert not u_points[1].any()
    assert not l_points[1].any()


def test_a_point_on_a_site_has_its_values(random):
    sites = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    u, l, h = random.normal(size=(2, 3)), random.normal(size=(2, 3, 3)), random.normal(size=(2, 3, 6))
    u_points, l_points = np.zeros((1, 3)), np.zeros((1, 3, 3))
    mean_series(sites[1:], sites, np.array([0, 2]), np.array([0, 1]), u, l, h, u_points, l_points)
    np.testing.assert_allclose(u_points[0], u[1], rtol=1e-14)
    np.testing.assert_allclose(l_points[0], l[1], rtol=1e-14)
