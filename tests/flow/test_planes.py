"""The walls near a point, as planes: how far, and which way."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from mesh_shapes import block, box_patches
from scipy.spatial.transform import Rotation

from foamprb.flow.base import NO_PLANES
from foamprb.flow.mesh.arrays import no_mesh
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.planes import planes_among, walls
from foamprb.flow.walk import nearest_point

CUT = 0.3


@pytest.fixture(scope="module")
def flow():
    shape = block(4, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def triangles_at(corners, normals, patches=None):
    """The arrays of triangles (n, 3, 3) with their normals, all of them listed."""
    n = len(corners)
    return no_mesh()._replace(
        nodes=np.reshape(corners, (-1, 3)),
        triangles=np.arange(3 * n).reshape(-1, 3),
        triangle_normals=np.asarray(normals, dtype=float),
        triangle_patch=np.zeros(n, dtype=np.int32) if patches is None else np.asarray(patches),
        seen=2 * np.arange(n) + 1,
    )


def seen_from(arrays, x, cut, chosen=(1,)):
    found = planes_among(arrays, 0, len(arrays.seen), tuple(x), cut, np.array(chosen, dtype=np.int8))
    return sorted((found[k], tuple(found[k + 1])) for k in (0, 2, 4) if found[k] < math.inf)


def turned(random):
    return Rotation.random(random_state=random.integers(1000)).as_matrix()


def wide(n, at, size):
    """A triangle about a place with a normal."""
    e = np.eye(3)[np.abs(n).argmin()]
    a = np.cross(n, e) / np.linalg.norm(np.cross(n, e))
    b = np.cross(n, a)
    return at + size * np.array([a, -0.5 * a + 0.9 * b, -0.5 * a - 0.9 * b])


def test_the_three_nearest_walls_count_whichever_way_they_face(random):
    """Six walls around a place in a box that is turned: the farther three are forgotten."""
    for _ in range(20):
        Q = turned(random)
        normals = np.concatenate([Q, -Q])
        distances = random.permutation(np.arange(1.0, 7.0))
        x = random.normal(size=3)
        corners = [wide(n, x - h * n, 5.0) for n, h in zip(normals, distances, strict=True)]
        found = seen_from(triangles_at(corners, normals), x, 6.5)
        order = np.argsort(distances)[:3]
        assert [h for h, _ in found] == pytest.approx([1.0, 2.0, 3.0])
        assert np.array([n for _, n in found]) == pytest.approx(normals[order], abs=1e-12)
        # Nothing from the cut on.
        assert [h for h, _ in seen_from(triangles_at(corners, normals), x, 2.5)] == pytest.approx([1.0, 2.0])


def test_of_walls_within_an_angle_of_45_degrees_the_nearest_counts(random):
    for angle, count in ((44.0, 1), (46.0, 2)):
        for order, near in itertools.product(((0, 1), (1, 0)), ((0.5, 0.6), (3.0, 4.0))):
            for others in range(3):
                Q, x = turned(random), random.normal(size=3)
                c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
                normals = [Q[0], c * Q[0] + s * Q[1], -Q[0], -Q[2]]
                distances = np.array([1.0, 2.0, *near])
                # Walls that were found before must not matter.
                rows = [*[2, 3][:others], *order]
                corners = [wide(normals[k], x - distances[k] * normals[k], 9.0) for k in rows]
                found = seen_from(triangles_at(corners, [normals[k] for k in rows]), x, 5.0)
                expected = sorted(distances[[*([2, 3][:others]), *([0, 1][:count])]])
                assert [h for h, _ in found] == pytest.approx(expected[:3])


def test_a_triangle_is_a_wall_where_a_perpendicular_ends_on_it(random):
    """Its sides belong to it; beside it only the nearest point of all may be a wall."""
    for _ in range(20):
        Q, middle = turned(random), random.normal(size=3)
        n = Q[2]
        corner = wide(n, middle, 1.0)
        arrays = triangles_at([corner], [n])
        share = random.dirichlet((1.0, 1.0, 1.0))
        share[random.integers(3)] *= random.integers(2)
        foot = share @ corner / share.sum()
        [(h, towards)] = seen_from(arrays, foot + 0.3 * n, 2.0)
        assert (h, *towards) == pytest.approx((0.3, *n), abs=1e-9)
        # From behind it is none.
        assert seen_from(arrays, foot - 0.3 * n, 2.0) == []
        # Beyond a corner and beyond a side.
        for away in (corner[0] - middle, middle - corner[0]):
            x = middle + 2.0 * away + 0.3 * n
            p = nearest_point(*(tuple(corner[k] - x) for k in range(3)))
            [(h, towards)] = seen_from(arrays, x, 3.0)
            assert h == pytest.approx(np.linalg.norm(p))
            assert towards == pytest.approx(-np.array(p) / h)
            assert seen_from(arrays, x, 0.99 * h) == []
            # Not if an edge of it cannot be the nearest.
            assert seen_from(arrays._replace(seen=np.array([0])), x, 3.0) == []


def test_the_nearest_edge_counts_if_it_is_nearer_than_any_face():
    """A step: a floor below, and an edge that is now nearer than it, now not; of two edges the nearer."""
    floor = wide(np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, 0.0]), 9.0)
    up, step = (0.0, 0.0, 1.0), np.array([[1.0, -1.0, 0.5], [1.0, 1.0, 0.5], [3.0, 0.0, 0.5]])
    other = step * np.array([-1.0, 1.0, 1.0]) + np.array([-0.2, 0.0, 0.0])
    for order in ((0, 1, 2), (2, 1, 0), (1, 2, 0)):
        corners = np.array([floor, step, other])[list(order)]
        arrays = triangles_at(corners, [up, up, up])
        for z, count in ((1.2, 1), (0.8, 1)):
            found = seen_from(arrays, (0.0, 0.0, z), 4.0)
            edge = math.hypot(1.0, z - 0.5)
            [(h, towards), *_] = found
            assert h == pytest.approx(min(z, edge))
            assert towards == pytest.approx(up if z < edge else np.array([-1.0, 0.0, z - 0.5]) / edge)
            assert len(found) >= count


def test_patches_that_are_not_chosen_are_no_walls(random):
    n = np.array([0.0, 0.6, 0.8])
    corners = [wide(n, np.zeros(3), 3.0), wide(-n, 2.0 * n, 3.0)]
    arrays = triangles_at(corners, [n, -n], [1, 0])
    x = 0.4 * n
    assert [h for h, _ in seen_from(arrays, x, 5.0, (1, 1))] == pytest.approx([0.4, 1.6])
    assert [h for h, _ in seen_from(arrays, x, 5.0, (0, 1))] == pytest.approx([0.4])
    assert [h for h, _ in seen_from(arrays, x, 5.0, (1, 0))] == pytest.approx([1.6])
    assert seen_from(arrays, x, 5.0, (0, 0)) == []


def test_a_cell_without_a_list_sees_no_walls(flow):
    arrays = flow.arrays(1.0, (), CUT, range(len(flow.patches)))
    hosts = flow.locate(np.array([[0.5, 0.5, 0.1]]))
    nothing = arrays._replace(seen_start=0 * arrays.seen_start)
    assert walls(nothing, int(hosts[0]), (0.5, 0.5, 0.1), CUT, np.ones(3, dtype=np.int8)) == NO_PLANES
