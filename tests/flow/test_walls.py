"""Clearance between a body and triangles, as plain functions, and boxes that meet."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.body.quadratic import bullet_amplitude, largest_swelling, swelling, turn_of
from foamprb.flow.base import NEAR
from foamprb.flow.mesh.arrays import no_mesh
from foamprb.flow.walk import nearest_point
from foamprb.flow.wall_lists import wall_tree
from foamprb.flow.walls import gap, nearest_in_tree, nearest_wall


def distance(corners):
    """Of a triangle from the origin, from its plane, its sides and its corners."""
    a, b, c = corners
    n = np.cross(b - a, c - a)
    foot = (a @ n) / (n @ n) * n
    w = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), foot - a, rcond=None)[0]
    found = []
    if w.min() >= 0.0 and w.sum() <= 1.0:
        found.append(np.linalg.norm(foot))
    for p, q in ((a, b), (b, c), (c, a)):
        s = np.clip(-(p @ (q - p)) / ((q - p) @ (q - p)), 0.0, 1.0)
        found.append(np.linalg.norm(p + s * (q - p)))
    return min(found)


def soup(random, n=40):
    """Triangles all about the origin, with their normals and patches."""
    middles = random.normal(size=(n, 3))
    corners = middles[:, None] + 0.4 * random.normal(size=(n, 3, 3))
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    arrays = no_mesh()._replace(
        nodes=corners.reshape(-1, 3),
        triangles=np.arange(3 * n).reshape(-1, 3),
        triangle_normals=normals,
        triangle_patch=np.arange(n) % 5,
        near=np.arange(n),
        near_start=np.array([0, n]),
        tets=np.array([[3, 0, 0, 0]]),
        n_points=3,
    )
    return corners, normals, arrays


def test_the_nearest_point_of_a_triangle_is_in_it_and_the_nearest(random):
    """Over its face, its sides and its corners, whichever comes first."""
    regions = set()
    for _ in range(300):
        corners = random.normal(size=(3, 3)) + random.normal(size=3)
        p = np.array(nearest_point(*map(tuple, corners)))
        w = np.linalg.lstsq(np.vstack([corners.T, np.ones(3)]), [*p, 1.0], rcond=None)[0]
        assert w @ corners == pytest.approx(p, abs=1e-12)
        assert w.min() > -1e-12
        assert np.linalg.norm(p) == pytest.approx(distance(corners), abs=1e-12)
        regions.add(tuple(w > 1e-12))
    assert len(regions) == 7


def bodies(random, n=25):
    for _ in range(n):
        F = np.eye(3) + 0.5 * random.uniform(-1.0, 1.0, (3, 3))
        F *= np.sign(np.linalg.det(F)) / np.cbrt(abs(np.linalg.det(F)))
        yield 0.5 * random.normal(size=3), F, random.uniform(0.02, 0.2)


def test_the_nearest_wall_is_that_of_the_ball_before_it_was_deformed(random):
    """And the gap to a plane wall is that of the body, in metres."""
    corners, normals, arrays = soup(random)
    near = 0
    for x, F, R in bodies(random, 60):
        flat = tuple(F.ravel())
        mapped = (corners - x) @ np.linalg.inv(F).T
        gaps = np.array([distance(c) for c in mapped]) - R
        k = int(gaps.argmin())
        found = gap(arrays, 0, tuple(x), flat, R)
        if gaps[k] < NEAR * R:
            near += 1
            assert found[0] == pytest.approx(gaps[k] * np.linalg.norm(normals[k] @ F), abs=1e-12)
            assert found[1:] == (k % 5, k)
        else:
            assert found == (np.inf, -1, -1)
    assert 10 < near < 60
    assert gap(arrays._replace(near_start=np.array([0, 0])), 0, tuple(x), flat, R) == (np.inf, -1, -1)


def test_the_ball_of_a_quadratic_mode_is_swollen_towards_each_triangle(random, monkeypatch):
    """A list and a tree find the smallest gap; the triangle need not be the nearest to the ball."""
    monkeypatch.setattr("foamprb.flow.walls.swelling", swelling)
    monkeypatch.setattr("foamprb.flow.walls.largest_swelling", largest_swelling)
    corners, normals, arrays = soup(random)
    tree = wall_tree(corners, normals)
    arrays = arrays._replace(wall_boxes=tree.boxes, wall_leaves=tree.leaves)
    changed = 0
    for x, F, R in bodies(random, 200):
        B = random.standard_normal(7)
        B = tuple(0.3 / bullet_amplitude(tuple(B)) * B)
        flat, inverse_F = tuple(F.ravel()), tuple(np.linalg.inv(F).ravel())
        mode = B, turn_of(flat)
        mapped = (corners - x) @ np.linalg.inv(F).T
        nearest = np.array([nearest_point(*map(tuple, c)) for c in mapped])
        away = np.linalg.norm(nearest, axis=1)
        swollen = [swelling(mode, inverse_F, tuple(p / d)) for p, d in zip(nearest, away, strict=True)]
        gaps = np.where(away < (1.0 + NEAR) * R, away - R - R * np.array(swollen), np.inf)
        k = int(gaps.argmin())
        clearance = gaps[k] * np.linalg.norm(normals[k] @ F)
        expected = (clearance, k % 5, k) if gaps[k] < NEAR * R else (np.inf, -1, -1)
        changed += np.isfinite(expected[0]) and k != away.argmin()
        for seed in (None, 0, max(expected[2], 0)):
            listing = arrays
            if seed is not None:
                listing = arrays._replace(near=np.array([-1 - seed]), near_start=np.array([0, 1]))
            assert gap(listing, 0, tuple(x), flat, R, mode) == (
                pytest.approx(expected[0], abs=1e-12),
                *expected[1:],
            )
    assert changed > 2


def test_a_tree_of_walls_finds_what_a_list_of_all_finds(random):
    corners, normals, arrays = soup(random)
    tree = wall_tree(corners, normals)
    arrays = arrays._replace(wall_boxes=tree.boxes, wall_leaves=tree.leaves)
    for x, F, R in bodies(random, 60):
        place, flat = tuple(x), tuple(F.ravel())
        expected = nearest_wall(arrays, 0, len(corners), place, flat, R)
        for seed in (0, 7, max(expected[2], 0)):
            assert nearest_in_tree(arrays, seed, place, flat, R) == expected
            # A list may hold nothing but the seed.
            short = arrays._replace(near=np.array([-1 - seed]), near_start=np.array([0, 1]))
            assert gap(short, 0, place, flat, R) == gap(arrays, 0, place, flat, R)


def test_of_walls_that_are_equally_near_the_first_counts():
    """Two triangles on each other, in a list and in a tree, whichever is the seed."""
    corners = np.array([[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, -1.0, 0.0]]] * 2)
    normals = np.array([[0.0, 0.0, 1.0]] * 2)
    tree = wall_tree(corners, normals)
    arrays = no_mesh()._replace(
        nodes=corners.reshape(-1, 3), triangles=np.arange(6).reshape(2, 3), triangle_normals=normals,
        triangle_patch=np.array([3, 4]), near=np.arange(2), wall_boxes=tree.boxes, wall_leaves=tree.leaves,
    )  # fmt: skip
    F = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    expected = (pytest.approx(0.15), 3, 0)
    for near in ([0, 1], [0, -1 - 1], [1, -1 - 0]):
        listing = arrays._replace(near=np.array(near))
        assert nearest_wall(listing, 0, 2, (0.0, 0.0, 0.25), F, 0.1) == expected
    for seed in (0, 1):
        assert nearest_in_tree(arrays, seed, (0.0, 0.0, 0.25), F, 0.1) == expected
