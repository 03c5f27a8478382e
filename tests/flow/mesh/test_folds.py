"""Lines through tetrahedra, as plain functions: which face they leave by, and where."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from hard_meshes import FLUSH, HARD, flow_in, from_hosts, ray
from mesh_shapes import block, box_patches, corners, grid

from foamprb.errors import InputError
from foamprb.flow.mesh import folds
from foamprb.flow.mesh.arrays import no_mesh
from foamprb.flow.mesh.folds import FLAT, grade, is_flat, settle
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.walk import find_thread


def one(nodes, tet=(0, 1, 2, 3), triangles=((1, 2, 3),)):
    """The arrays of a tetrahedron, and of triangles among its nodes."""
    nodes = np.asarray(nodes, dtype=float)
    normals = np.array([np.cross(nodes[b] - nodes[a], nodes[c] - nodes[a]) for a, b, c in triangles])
    return no_mesh()._replace(
        nodes=nodes,
        tets=np.array([tet]),
        triangles=np.array(triangles),
        triangle_normals=normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None],
    )


def volume(a, b, c, d):
    return np.linalg.det([b - a, c - a, d - a])


@pytest.mark.parametrize(
    ("height", "flat", "mark", "folded"),
    [(1e-6, False, 0, 0), (1e-8, False, FLAT, 0), (1e-12, True, FLAT, 0), (0.0, True, FLAT, 0),
     (-1e-12, True, FLAT, 0), (-1e-8, False, FLAT, 1), (-1.0, False, FLAT, 1)],
)  # fmt: skip
def test_tetrahedra_are_flat_or_folded_by_their_height(height, flat, mark, folded):
    """In units of the edges from the first node."""
    nodes = 7.0 * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]) + 1e-3
    nodes[3] = nodes[0] + 7.0 * np.array([np.sqrt(1.0 - height**2), 0.0, height])
    arrays = one(nodes, (0, 1, 2, 3))
    assert is_flat(arrays, 0) == flat
    marks, boxes = np.zeros(3, dtype=np.uint8), np.full((1, 6), np.nan)
    # The first node is the centre of cell 2.
    assert grade(nodes, np.array([[0, 1, 2, 3]]), -2, marks, boxes) == folded
    assert marks.tolist() == [0, 0, mark]
    if folded:
        assert boxes[0].tolist() == [*nodes.min(axis=0), *nodes.max(axis=0)]
        # Without room they are counted all the same.
        assert grade(nodes, np.array([[0, 1, 2, 3]] * 2), -2, marks, boxes) == 2
    else:
        assert np.isnan(boxes).all()


def pressed(layers, thickness):
    """A box of 3 × 3 × layers cells of which the middle layer is so thin."""
    points, hexes = corners(3, 0.0)
    z = np.array([0.0, 0.5, 0.5 + thickness, 1.0])
    points[:, 2] = z[np.round(3.0 * points[:, 2]).astype(int)]
    mesh = build_mesh(grid(points, [(12, hexes)]))
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def test_who_is_in_a_flat_tetrahedron_is_in_the_one_beside_that_holds_the_place(random):
    """Of the cell, of its neighbours, or of their neighbours; a sound one is kept."""
    flow = pressed(3, 0.0)
    arrays = flow.arrays()
    flat = [t for t in range(len(arrays.tets)) if is_flat(arrays, t)]
    assert len(flat) == 9 * 12
    for tet in random.choice(flat, 20):
        cell = arrays.tets[tet, 0] - arrays.n_points
        x, y, _ = flow.mesh.centres[cell]
        for shift in (0.2, 0.4):
            place = (x + random.uniform(-0.1, 0.1), y, 0.5 + random.choice([-1, 1]) * 0.05)
            if shift == 0.4:
                # In a neighbour of a neighbour.
                place = (place[0] + (1.0 / 3.0 if x < 0.5 else -1.0 / 3.0), *place[1:])
            found = settle(arrays, int(tet), place)
            assert not is_flat(arrays, found)
            assert folds._depth(arrays, found, place) >= -1e-9
    sound = next(t for t in range(len(arrays.tets)) if not is_flat(arrays, t))
    assert settle(arrays, sound, (9.0, 9.0, 9.0)) == sound


def along(flow, n, random, inside=0.7):
    """Places in a mesh, their hosts, and ends of which some lie outside."""
    low, high = flow.bounds
    x0 = random.uniform(low, high, (4 * n, 3))
    hosts = flow.locate(x0)
    x0, hosts = x0[hosts >= 0][:n], hosts[hosts >= 0][:n]
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    return zip(x0, hosts, random.uniform(middle - half / inside, middle + half / inside, (n, 3)), strict=True)


@pytest.mark.parametrize("kind", ["hexahedra", "tetrahedra", "mixed"])
def test_a_thread_through_a_sound_mesh_ends_where_the_line_does(kind, random):
    """In the plain text: at the place, or at the side of the box that the line meets first."""
    shape = block(2, 0.3, kind)
    mesh = build_mesh(shape, box_patches(shape))
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
    arrays, seen = flow.arrays(), set()
    for x0, host, x1 in along(flow, 40, random):
        d = x1 - x0
        exact = min(1.0, np.where(d > 0.0, (1.0 - x0) / d, -x0 / d).min())
        found, fraction, patch, triangle = folds.trace(arrays, int(host), tuple(x0), tuple(x1))
        assert fraction == pytest.approx(exact, abs=1e-12)
        assert folds._depth(arrays, found, tuple(x0 + exact * d)) > -1e-9
        if exact == 1.0:
            assert (patch, triangle) == (-1, -1)
        else:
            assert patch == mesh.triangle_patch[triangle]
            assert found == mesh.triangle_tet[triangle]
            names = [p.name for p in mesh.patches]
            z = (x0 + exact * d)[2]
            assert names[patch] == ("floor" if z < 1e-9 else "lid" if z > 1.0 - 1e-9 else "sides")
        seen.add(patch)
        # Who stays where they are has arrived.
        assert folds.trace(arrays, int(host), tuple(x0), tuple(x0)) == (host, 1.0, -1, -1)
    assert seen == {-1, 0, 1, 2}


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_thread_along_an_axis_goes_as_far_as_the_mesh(axis, sign):
    mesh = build_mesh(block(2, 0.0))
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
    x0 = np.array([0.31, 0.42, 0.23])
    (host,) = flow.locate(x0[None])
    room = 1.0 - x0[axis] if sign > 0.0 else x0[axis]
    for length in (0.9 * room, 2.0 * room):
        x1 = x0 + sign * length * np.eye(3)[axis]
        found, fraction, patch, _ = folds.trace(flow.arrays(), int(host), tuple(x0), tuple(x1))
        exact = min(1.0, room / length)
        assert fraction == pytest.approx(exact, abs=1e-12)
        assert (patch == -1) == (exact == 1.0)
        assert folds._depth(flow.arrays(), found, tuple(x0 + exact * (x1 - x0))) > -1e-9


def test_a_place_outside_is_nearest_to_a_cell_within_two_faces(random):
    """Where no cell holds it: the cell itself, its neighbours, and their neighbours are asked."""
    mesh = build_mesh(block(3, 0.0))
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
    arrays, steps = flow.arrays(), set()
    cell_of = arrays.tets[:, 0] - arrays.n_points
    index = np.floor(3.0 * mesh.centres)
    for _ in range(30):
        x = random.uniform(0.0, 1.0, 3)
        x[random.integers(3)] = random.choice([-0.05, 1.05])
        tet = int(random.integers(len(cell_of)))
        # Steps over faces from one cell to another, in a row of cubes along each axis.
        away = np.abs(index - index[cell_of[tet]]).sum(axis=1)[cell_of]
        depth = np.array([folds._depth(arrays, t, tuple(x)) for t in range(len(cell_of))])
        expected = depth[away <= 2.0].max()
        assert depth[folds.nearby(arrays, tet, tuple(x))] == pytest.approx(expected, rel=1e-12, abs=0.0)
        steps.add(away[np.where(away <= 2.0, depth, -np.inf).argmax()])
    assert steps >= {1.0, 2.0}


def hard(kind):
    """The flow in the first mesh of a kind that is not refused."""
    for seed in range(20):
        with suppress(InputError):
            return flow_in(HARD[kind](seed))
    raise AssertionError(kind)


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.filterwarnings("ignore:invalid value")
@pytest.mark.parametrize("kind", ["folded", "concave", "aspect 1e4", "slivers", "a layer without volume"])
def test_a_thread_through_a_hard_mesh_ends_where_the_line_meets_the_boundary(kind, random):
    """In the plain text, against all triangles of the boundary."""
    flow = hard(kind)
    arrays, extent = flow.arrays(), np.ptp(flow.mesh.points, axis=0)
    triangles = flow.mesh.points[flow.mesh.triangles] / extent
    reached = left = 0
    for x0, host, x1 in along(flow, 25, random):
        d = (x1 - x0) / extent
        room = FLUSH / np.linalg.norm(d)
        # From another tetrahedron that holds the place, if from this the line does not lead away.
        found, fraction, patch, _ = find_thread(arrays, int(host), tuple(x0), tuple(x1))
        assert patch != folds._FAILED
        met, first = ray(triangles, tuple(x0 / extent), tuple(d), room, fraction)
        assert first >= fraction - room
        if patch == -1:
            assert from_hosts(flow, np.array([found]), x1[None]) < FLUSH
            reached += 1
        else:
            assert met <= room
            left += 1
    assert min(reached, left) > 3


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.filterwarnings("ignore:invalid value")
def test_a_thread_lost_from_one_tetrahedron_is_found_from_another(random):
    """From a tetrahedron elsewhere some threads are lost; a second one, which holds the start, has them."""
    flow = hard("folded")
    arrays, lost = flow.arrays(), 0
    for x0, host, x1 in along(flow, 60, random):
        way, elsewhere = (tuple(x0), tuple(x1)), int(random.integers(len(flow.mesh.tets)))
        if folds.trace(arrays, elsewhere, *way)[2] != folds._FAILED:
            continue
        lost += 1
        _, fraction, patch, _ = find_thread(arrays, elsewhere, *way)
        _, expected, left_by, _ = folds.trace(arrays, int(host), *way)
        assert (patch, fraction) == (left_by, pytest.approx(expected, abs=1e-9))
    assert lost > 2


def test_from_outside_there_is_no_thread():
    """A place beyond a wall that is no round-off away, on a line that does not come in."""
    flow = hard("folded")
    arrays = flow.arrays()
    hosts = flow.locate(np.array([[0.01, 0.5, 0.5]]))
    found = folds.trace(arrays, int(hosts[0]), (-0.1, 0.5, 0.5), (-0.5, 0.5, 0.5))
    assert found[1:3] == (0.0, folds._FAILED)
