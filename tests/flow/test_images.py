"""Images of walls and of cells beyond patches over which a flow goes on."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, cyclic_row, period
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation

from foamprb.flow.images import Images, _unturned
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.walls import Walls, images_of_walls


def small_wall(place):
    """One small triangle at a place."""
    corners = np.add(place, [[[0.0, 0.0, 0.0], [1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0]]])
    return Walls(corners, np.array([[0.0, 0.0, 1.0]]), np.array([2], dtype=np.int32))


@pytest.mark.parametrize(
    ("place", "seen"),
    [
        # A period is 1 along x; within a tenth of the left patch a wall is seen beyond the right one.
        ((0.05, 0.5, 0.5), (1.05, 0.5, 0.5)),
        ((0.95, 0.5, 0.5), (-0.05, 0.5, 0.5)),
        # Above the patch, by less than the reach and by more.
        ((0.05, 0.5, 1.05), (1.05, 0.5, 1.05)),
        ((0.05, 0.5, 1.2), None),
        ((0.05, 1.05, 0.5), (1.05, 1.05, 0.5)),
        ((0.05, 1.2, 0.5), None),
        ((0.05, -0.2, 0.5), None),
        ((0.5, 0.5, 0.5), None),
    ],
)
def test_walls_near_a_coupled_patch_are_seen_beyond_its_neighbour(place, seen):
    images = images_of_walls(cyclic_row(0.0, 1), small_wall(place), 0.1)
    assert len(images.corners) == (0 if seen is None else 1)
    if seen is not None:
        np.testing.assert_allclose(images.corners[0, 0], seen, atol=1e-9)
        np.testing.assert_array_equal(images.normals, [[0.0, 0.0, 1.0]])


def rotation(random):
    return Rotation.random(random_state=int(random.integers(1000))).as_matrix()


@pytest.mark.parametrize("kind", ["symmetryPlane", "symmetry", "empty"])
def test_cells_before_a_plane_have_their_images_behind_it(kind, random):
    """Whichever way it faces; vectors and tensors are mirrored, but not behind an empty patch."""
    for _ in range(3):
        Q, shift = rotation(random), random.normal(size=3)
        shape = block(2, 0.2)
        patches = [p._replace(type=kind) if p.name == "floor" else p for p in box_patches(shape)]
        for part in (shape, *(p.surface for p in patches)):
            part.points = np.asarray(part.points) @ Q.T + shift
        mesh = build_mesh(shape, patches)
        images = Images(mesh)
        assert len(images.faces) == len(images.cells) == len(images.places) == 4
        assert mesh.owner[mesh.n_internal + images.faces].tolist() == images.cells.tolist()
        assert set(images.faces) == set(range(*mesh.patch_start[:2]))
        n = Q[:, 2]
        mirror = np.eye(3) - 2.0 * np.outer(n, n)
        np.testing.assert_allclose(
            images.places, (mesh.centres[images.cells] - shift) @ mirror + shift, atol=1e-9
        )
        turn = np.eye(3) if kind == "empty" else mirror
        u, l = random.normal(size=(8, 3)), random.normal(size=(8, 3, 3))
        np.testing.assert_allclose(images.turned(u), u[images.cells] @ turn.T, atol=1e-9)
        np.testing.assert_allclose(images.turned(l), turn @ l[images.cells] @ turn.T, atol=1e-9)
        h = random.normal(size=(8, 3, 3, 3))
        exact = np.einsum("ia,jb,kc,nabc->nijk", turn, turn, turn, h[images.cells])
        np.testing.assert_allclose(images.turned(h), exact, atol=1e-9)
        np.testing.assert_allclose(images.turned(2.0 * l, lambda own: 0.5 * own), images.turned(l))
        # At the plane's points the parts agree that the mirror does not change.
        at_points = random.normal(size=(mesh.n_points, 3))
        before = at_points.copy()
        images.agree(at_points)
        on_plane = np.abs((mesh.points - shift) @ n) < 1e-9
        assert on_plane.sum() == 9
        np.testing.assert_array_equal(at_points[~on_plane], before[~on_plane])
        mean = before if kind == "empty" else 0.5 * (before + before @ mirror.T)
        np.testing.assert_allclose(at_points[on_plane], mean[on_plane], atol=1e-9)


@pytest.mark.parametrize("angle", [0.0, 40.0])
def test_cells_before_a_cyclic_patch_have_their_images_behind_its_neighbour(angle, random):
    mesh = cyclic_row(angle, 1)
    images, (turn, shift) = Images(mesh), period(angle)
    names = [patch.name for patch in mesh.patches]
    u, l = random.normal(size=(mesh.n_cells, 3)), random.normal(size=(mesh.n_cells, 3, 3))
    turned_u, turned_l = images.turned(u), images.turned(l)
    assert len(images.faces) == 2 * 16
    for k, face in enumerate(images.faces):
        name = names[np.searchsorted(mesh.patch_start, face, side="right") - 1]
        # Beyond the left patch lies what is before the right one, a period back.
        q, s = (turn.T, -turn.T @ shift) if name == "left" else (turn, shift)
        cell = images.cells[k]
        np.testing.assert_allclose(images.places[k], q @ mesh.centres[cell] + s, atol=1e-9)
        np.testing.assert_allclose(turned_u[k], q @ u[cell], atol=1e-9)
        np.testing.assert_allclose(turned_l[k], q @ l[cell] @ q.T, atol=1e-9)
        there = {"left": "right", "right": "left"}[name]
        own = slice(*mesh.patch_start[names.index(there) :][:2])
        assert cell in mesh.owner[mesh.n_internal :][own]
    points = random.normal(size=(mesh.n_points, 3))
    before = points.copy()
    images.agree(points)
    tree = KDTree(mesh.points)
    pairs = 0
    for p, x in enumerate(mesh.points):
        distance, other = tree.query(turn @ x + shift)
        if distance < 1e-9:
            mean = 0.5 * (turn @ before[p] + before[other])
            np.testing.assert_allclose(points[other], mean, atol=1e-12)
            np.testing.assert_allclose(points[p], turn.T @ mean, atol=1e-12)
            pairs += 1
    assert pairs == 25
    assert (points != before).any(axis=1).sum() == 50


def test_on_an_axis_only_what_no_turn_about_it_changes_stays(random):
    for axis in (np.array([0.0, 0.0, 1.0]), np.array([0.6, 0.0, -0.8]), random.normal(size=3)):
        unit = axis / np.linalg.norm(axis)
        turn, other = (Rotation.from_rotvec(a * unit).as_matrix() for a in (0.4, 1.3))
        v, T = random.normal(size=(4, 3)), random.normal(size=(4, 3, 3))
        kept, kept_T = _unturned(turn, v), _unturned(turn, T)
        np.testing.assert_allclose(kept, np.outer(v @ unit, unit), atol=1e-12)
        np.testing.assert_allclose(kept_T, other @ kept_T @ other.T, atol=1e-12)
        # The mean over all turns.
        turns = [Rotation.from_rotvec(a * unit).as_matrix() for a in np.linspace(0, 2 * np.pi, 9)[:-1]]
        np.testing.assert_allclose(kept_T, np.mean([q @ T @ q.T for q in turns], axis=0), atol=1e-12)
