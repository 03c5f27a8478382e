"""Loops over faces and cells, as plain functions."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import HEXAHEDRON_FACES, KINDS, block, polyhedra

from foamprb.flow.mesh import faces
from foamprb.flow.mesh.faces import OPEN, TWISTED, Faces, Fans, Numbering, number_tetrahedra, split_cells
from foamprb.flow.mesh.geometry import inward_normals
from foamprb.flow.mesh.mesh import build_mesh


def lists_of(found):
    """Start and points of faces."""
    return np.cumsum([0, *map(len, found)]), np.array([p for face in found for p in face])


def polygon(random, n):
    """A flat polygon about a place, with its centroid and area vector by triangles from a corner."""
    e = np.linalg.qr(random.normal(size=(3, 3)))[0]
    angle = np.sort(random.uniform(0.0, 2.0 * np.pi, n))
    ring = random.normal(size=3) + (np.cos(angle)[:, None] * e[0] + np.sin(angle)[:, None] * e[1])
    parts = [ring[[0, k, k + 1]] for k in range(1, n - 1)]
    vectors = np.array([0.5 * np.cross(t[1] - t[0], t[2] - t[0]) for t in parts])
    areas = np.linalg.norm(vectors, axis=1)
    return ring, areas @ np.array([t.mean(axis=0) for t in parts]) / areas.sum(), vectors.sum(axis=0)


def test_a_flat_face_has_its_centroid_and_its_area(random):
    rings, centroids, vectors = zip(*(polygon(random, n) for n in (3, 4, 5, 8, 3, 6)), strict=True)
    sizes = [len(r) for r in rings]
    order = random.permutation(sum(sizes))
    points = np.empty((sum(sizes), 3))
    points[order] = np.concatenate(rings)
    start = np.cumsum([0, *sizes])
    centres, areas = np.full((2, len(rings), 3), np.nan)
    faces.measure_faces(points, start, order, centres, areas)
    np.testing.assert_allclose(centres, centroids, rtol=0, atol=1e-12)
    np.testing.assert_allclose(areas, vectors, rtol=0, atol=1e-12)


def test_a_warped_face_is_weighed_by_triangles_about_its_mean(random):
    """Weights are their areas along the whole."""
    for n in (4, 5):
        ring = polygon(random, n)[0] + 0.1 * random.normal(size=(n, 3))
        mean = ring.mean(axis=0)
        crosses = np.cross(ring - mean, np.roll(ring, -1, axis=0) - mean)
        total = 0.5 * crosses.sum(axis=0)
        w = crosses @ total
        thirds = (mean + ring + np.roll(ring, -1, axis=0)) / 3.0
        centres, areas = np.empty((2, 1, 3))
        faces.measure_faces(ring, np.array([0, n]), np.arange(n), centres, areas)
        np.testing.assert_allclose(areas[0], total, rtol=0, atol=1e-13)
        np.testing.assert_allclose(centres[0], w @ thirds / w.sum(), rtol=0, atol=1e-13)


def test_a_face_folded_onto_itself_has_its_mean_as_centre():
    ring = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    centres, areas = np.empty((2, 1, 3))
    faces.measure_faces(ring, np.array([0, 4]), np.arange(4), centres, areas)
    np.testing.assert_allclose(centres[0], [0.5, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(areas[0], 0.0, atol=1e-15)
    # Nearly so: the weights lead beyond its corners.
    bow = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0 + 1e-9, 0.0]])
    faces.measure_faces(bow, np.array([0, 4]), np.arange(4), centres, areas)
    assert np.abs(centres[0] - bow.mean(axis=0)).max() <= 0.51


def split(cells):
    """Cut cells of faces apart, each face with its own points, none shared; and what is wrong with them."""
    found = [face for cell in cells for face in cell]
    start, lists = lists_of(found)
    first = np.cumsum([0, *map(len, cells)])
    n = int(sum(len(f) - 2 for f in found))
    tets, neighbours = np.full((2, n, 4), -99)
    cell_start, triangle_tet = np.empty(len(cells) + 1, dtype=int), np.full(n, -99)
    state, face_tet = np.zeros(len(cells), dtype=np.uint8), np.empty(len(found), dtype=int)
    owner, own = np.repeat(np.arange(len(cells)), np.diff(first)), np.arange(len(found))
    each, numbers = Faces(start, lists, owner, np.empty(0, int), first, own), Numbering(cell_start, face_tet)
    number_tetrahedra(each, numbers)
    fans = Fans(tets, neighbours, triangle_tet, state)
    for c in range(len(cells)):
        split_cells(c, c + 1, 100, each, numbers, np.full((5, 64), -1), fans)
    return cell_start, tets, neighbours, triangle_tet, state.tolist()


def test_a_cell_that_is_open_or_twisted_is_known():
    cube = [list(f) for f in HEXAHEDRON_FACES]
    other = [[p + 8 for p in f] for f in cube]
    cell_start, tets, neighbours, triangle_tet, state = split([cube, other])
    assert state == [0, 0]
    assert cell_start.tolist() == [0, 12, 24]
    assert tets[:, 0].tolist() == [100] * 12 + [101] * 12
    assert sorted(-1 - neighbours[:, 0]) == list(range(24))
    assert triangle_tet[-1 - neighbours[:, 0]].tolist() == list(range(24))
    for t in range(24):
        for slot in (1, 2, 3):
            back = neighbours[t, slot]
            shared = sorted(tets[t, [k for k in range(4) if k != slot]])
            [there] = [k for k in range(4) if neighbours[back, k] == t]
            assert sorted(tets[back, [k for k in range(4) if k != there]]) == shared
    assert split([cube[:5], other])[-1] == [OPEN, 0]
    assert split([other, [*cube[:5], cube[5][::-1]]])[-1] == [0, TWISTED]
    # An edge of three faces.
    assert split([[*cube, [0, 1, 5, 4]]])[-1][0] & OPEN


@pytest.mark.parametrize("kind", KINDS)
def test_centres_and_volumes_of_cells_and_faces_are_those_of_the_box(kind):
    """Sums over all: ∫ dA = 0, ∫ x·dA/3 = V, and the centroid of the box."""
    mesh = build_mesh(block(4, 0.3, kind))
    assert mesh.boundary_areas.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-13)
    flux = np.einsum("fi,fi->", mesh.boundary_centres, mesh.boundary_areas) / 3.0
    assert flux == pytest.approx(1.0, rel=1e-12)
    assert mesh.volumes @ mesh.centres == pytest.approx(np.full(3, 0.5), abs=2e-3)
    sides = np.abs(mesh.boundary_areas).sum(axis=0)
    assert sides == pytest.approx(np.full(3, 2.0), rel=1e-12)


def test_normals_point_inwards_and_a_triangle_without_area_borrows_that_of_its_face(random):
    points = random.normal(size=(5, 3))
    points[4] = 0.5 * (points[0] + points[1])
    triangles = np.array([[0, 1, 2], [3, 2, 1], [0, 1, 4], [2, 2, 2]])
    areas = random.normal(size=(4, 3))
    areas[3] = 0.0
    found = inward_normals(points, triangles, areas)
    for k in range(2):
        a, b, c = points[triangles[k]]
        n = -np.cross(b - a, c - a)
        np.testing.assert_allclose(found[k], n / np.linalg.norm(n), atol=1e-13)
    np.testing.assert_allclose(found[2], -areas[2] / np.linalg.norm(areas[2]), atol=1e-13)
    assert not found[3].any()


def test_between_fans_that_are_as_good_round_off_does_not_decide():
    """A square whose corners lie a little off a plane: its first fan stays, unless another is better."""
    for lift, base in ((0.0, 0), (1e-10, 0), (-1e-10, 0), (1e-3, 1), (-1e-3, 0)):
        points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, lift], [1.0, 1.0, 0.0], [0.0, 1.0, lift]])
        lists, centre = np.arange(4), np.array([[0.5, 0.5, -0.6]])
        nobody = np.zeros(0, dtype=int)
        assert faces.choose_bases(points, centre, np.array([0, 4]), lists, np.array([0]), nobody) == 0
        assert lists[0] == base


def test_a_face_of_many_points_is_cut_at_a_cost_that_is_not_quadratic():
    n = 20_000
    angle = 2.0 * np.pi * np.arange(n) / n
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0.0 * angle])
    k = np.arange(n)
    sides = np.column_stack([k, (k + 1) % n, n + (k + 1) % n, n + k])
    points = np.concatenate([ring, ring + np.array([0.0, 0.0, 1.0])])
    mesh = build_mesh(polyhedra(points, [[k[::-1], n + k, *sides]]))
    assert len(mesh.tets) == 2 * (n - 2) + 2 * n
    assert mesh.volumes[0] == pytest.approx(np.pi, rel=1e-6)
