"""That lists of walls nearby leave out nothing that counts, however short they are."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from mesh_shapes import block, box_patches, pipe, pipe_patches
from mesh_shapes import grid as make_grid

from foamprb.compile.link import link
from foamprb.flow import wall_lists
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.mesh.tree import meet, square_to_box
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.planes import planes_among
from foamprb.flow.walk import nearest_point
from foamprb.flow.wall_lists import WallTree, edges_out, wall_tree
from foamprb.flow.walls import gap


def around_a_corner():
    """Three of the four blocks of a box of 2 × 2: the fourth is solid, and its edge sticks out."""
    points, cells = [], []
    for origin in ((0, 0, 0), (1, 0, 0), (0, 1, 0)):
        part = block(4, perturbation=0.0)
        first = sum(len(q) for q in points)
        points.append(np.asarray(part.points) + origin)
        cells.append(part.cells.reshape(-1, 9)[:, 1:] + first)
    points, cells = np.concatenate(points), np.concatenate(cells)
    _, unique, place = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    shape = make_grid(points[unique], [(12, place.reshape(-1)[cells])])
    return shape, box_patches(shape)


def shapes():
    for kind in ("hexahedra", "tetrahedra", "polyhedra"):
        grid = block(4, kind=kind)
        yield f"box of {kind}", grid, box_patches(grid)
    grid = block(8, 0.0)
    yield "fine box", grid, box_patches(grid)
    grid = pipe(10)
    yield "pipe", grid, pipe_patches(grid)
    yield "corner", *around_a_corner()


SHAPES = {name: (grid, patches) for name, grid, patches in shapes()}


@pytest.fixture(scope="module", params=SHAPES)
def flow(request):
    mesh = build_mesh(*SHAPES[request.param])
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def places(flow, n=400):
    low, high = flow.bounds
    x = np.random.default_rng(0).uniform(low, high, (4 * n, 3))
    hosts = flow.locate(x)
    return list(zip(x[hosts >= 0][:n], hosts[hosts >= 0][:n], strict=True))


def solid(flow):
    return [index for index, patch in enumerate(flow.patches) if patch.type == "wall"]


def test_every_branch_of_the_tree_knows_the_triangles_below_it(flow):
    """Their boxes, the cone in which their normals are, and whether they have an edge that counts."""
    mesh = flow.mesh
    walls = np.flatnonzero(np.isin(mesh.triangle_patch, solid(flow)))
    corners, normals = mesh.points[mesh.triangles[walls]], mesh.triangle_normals[walls]
    tree = wall_tree(corners, normals)
    n = len(tree.leaves)
    below = {n + k: leaf[leaf >= 0] for k, leaf in enumerate(tree.leaves)}
    for node in range(n - 1, 0, -1):
        below[node] = np.concatenate([below[2 * node], below[2 * node + 1]])
    assert np.array_equal(np.sort(below[1]), np.arange(len(walls)))
    for node, names in below.items():
        if len(names):
            points = corners[names].reshape(-1, 3)
            ends = np.concatenate([points.min(axis=0), points.max(axis=0)])
            np.testing.assert_array_equal(tree.boxes[node], ends)
            axis, angle, edge = tree.cones[node, :3], tree.cones[node, 3], tree.cones[node, 4]
            assert np.linalg.norm(axis) == pytest.approx(1.0, abs=1e-12)
            widest = np.arccos(np.clip(normals[names] @ axis, -1.0, 1.0)).max()
            # Of a leaf no wider than need be.
            assert widest - 1e-7 <= angle <= (widest + 1e-7 if node >= n else np.pi)
            assert edge == tree.edges[names].any()


@pytest.mark.parametrize("cut", [0.1, 0.4])
def test_the_walls_around_a_place_are_those_of_all_triangles(flow, cut):
    """To the last digits: normals of triangles in one plane differ by round-off."""
    mesh, walls = flow.mesh, solid(flow)
    arrays = flow.arrays(0.0, (), cut, walls)
    chosen = np.array([index in walls for index in range(len(flow.patches))], dtype=np.int8)
    names = np.flatnonzero(chosen[mesh.triangle_patch]).astype(np.int32)
    whole = arrays._replace(seen=(2 * names + 1).astype(np.int32))
    some, all_ = link(flow.kernels["walls"]), link(planes_among)
    found = 0
    for x, host in places(flow):
        ours = some(arrays, host, tuple(x), cut, chosen)
        theirs = all_(whole, 0, len(names), tuple(x), cut, chosen)
        planes = [sorted((p[k], *p[k + 1]) for k in (0, 2, 4) if p[k] < np.inf) for p in (ours, theirs)]
        assert np.shape(planes[0]) == np.shape(planes[1])
        if planes[0]:
            assert np.array(planes[0]) == pytest.approx(np.array(planes[1]), abs=1e-9)
        found += len(planes[0])
    assert found > 50


def test_edges_count_where_they_stick_out_or_end():
    grid, patches = around_a_corner()
    mesh = build_mesh(grid, patches)
    walls = np.isin(mesh.triangle_patch, [i for i, patch in enumerate(mesh.patches) if patch.type == "wall"])
    corners = mesh.points[mesh.triangles[walls]]
    out = edges_out(corners, mesh.triangle_normals[walls])
    # The line x = y = 1, and that at z = 1, where the walls end at a patch that is none.
    on_line = np.isclose(corners[:, :, :2], 1.0).all(axis=2).sum(axis=1) == 2
    at_end = np.isclose(corners[:, :, 2], 1.0).sum(axis=1) == 2
    assert on_line.any()
    assert at_end.any()
    assert np.array_equal(out, on_line | at_end)


def listed(near):
    """Names of the triangles in lists for touching, whether their planes are there already or not."""
    return np.maximum(near, -1 - near)


def test_the_gap_is_the_same_where_one_triangle_stands_for_all_in_its_plane(flow):
    """To the last bit, the triangle too; and no two that come first are in one plane."""
    walls = solid(flow)
    R, reach = 0.02, 0.3
    arrays = flow.arrays(reach, walls)
    start, near = arrays.near_start, arrays.near
    hidden, near_all, found = 0, listed(near), 0
    for begin, end in itertools.pairwise(start):
        if begin < end and near[begin] < 0:
            # A place to search the tree from.
            near_all[begin] = near[begin]
            continue
        near_all[begin:end].sort()
        first = near[begin:end][near[begin:end] >= 0]
        corners, n = arrays.nodes[arrays.triangles[first], :3], arrays.triangle_normals[first]
        off = np.abs(np.einsum("ik,ijlk->ijl", n, corners[None] - corners[:, None, :1])).max(2, initial=0.0)
        same = (off < 1e-13) & (n @ n.T > 0.5) & ~np.eye(len(first), dtype=bool)
        assert not same.any()
        hidden += end - begin - len(first)
    whole, ours = arrays._replace(near=near_all), link(gap)
    random = np.random.default_rng(1)
    for x, host in places(flow, 300):
        U, _, V = np.linalg.svd(random.standard_normal((3, 3)))
        F = tuple((U @ np.diag([2.0, 1.0, 0.5]) @ V).ravel())
        expected = ours(whole, host, tuple(x), F, R)
        assert ours(arrays, host, tuple(x), F, R) == expected
        found += np.isfinite(expected[0])
    assert hidden > 0
    assert found > 20


def times(unit, grid):
    scaled = grid.copy()
    scaled.points = unit * np.asarray(grid.points)
    return scaled


def test_the_gap_from_a_tree_grows_with_the_unit_of_length(monkeypatch):
    """In a box of a kilometre as in one of a millimetre."""
    monkeypatch.setattr("foamprb.flow.wall_lists.MOST_LISTED", 2)
    shape, patches = SHAPES["box of tetrahedra"]
    found, stretch, our_gap = [], (1.5, 0.3, 0.0, 0.0, 0.8, 0.1, 0.2, 0.0, 0.9), link(gap)
    for unit in (1e-3, 1.0, 1e3):
        mesh = build_mesh(
            times(unit, shape), [patch._replace(surface=times(unit, patch.surface)) for patch in patches]
        )
        flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
        arrays = flow.arrays(0.6 * unit, solid(flow))
        x = unit * np.random.default_rng(2).uniform(0.05, 0.95, (100, 3))
        gaps = [
            our_gap(arrays, host, tuple(y), stretch, 0.2 * unit)
            for y, host in zip(x, flow.locate(x), strict=True)
        ]
        found.append(np.array([g[0] / unit for g in gaps]))
    assert np.isfinite(found[0]).sum() > 50
    for other in found[1:]:
        np.testing.assert_allclose(other, found[0], rtol=0, atol=1e-12)


def boxes_of(random, n, most=6):
    low = random.integers(0, most, (n, 3)).astype(float)
    return np.concatenate([low, low + random.integers(1, 4, (n, 3))], axis=1)


def test_boxes_are_as_far_apart_as_their_nearest_points(random):
    """Along each axis, and in a straight line; as for the box of a triangle."""
    a, b = boxes_of(random, 60), boxes_of(random, 60)
    for k in range(60):
        apart = np.maximum(np.maximum(a[k, :3] - b[k, 3:], b[k, :3] - a[k, 3:]), 0.0)
        assert wall_lists._square_between(a, k, b, k) == np.sum(apart**2)
        for reach in (0.0, 0.5, 1.0, 2.0):
            assert meet(a, k, b, k, reach) == (apart.max() <= reach)
            spread = np.array([[a[k, :3], a[k, 3:], 0.5 * (a[k, :3] + a[k, 3:])]])
            spread = spread[:, random.permutation(3)]
            assert wall_lists._triangle_meets(spread, 0, b, k, reach) == (apart.max() <= reach)
        x = tuple(random.uniform(-1.0, 10.0, 3))
        nearest = np.clip(x, a[k, :3], a[k, 3:])
        assert square_to_box(a, k, x) == pytest.approx(np.sum((nearest - x) ** 2))
        assert wall_lists._middle(a, k) == tuple(0.5 * (a[k, :3] + a[k, 3:]))


def soup(random, n=40, size=0.4):
    corners = random.normal(size=(n, 1, 3)) + size * random.normal(size=(n, 3, 3))
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return corners, normals / np.linalg.norm(normals, axis=1)[:, None]


def test_the_nearest_triangle_of_a_tree_is_the_nearest_of_all(random):
    corners, normals = soup(random)
    tree = wall_lists.wall_tree(corners, normals)
    for _ in range(40):
        x = random.normal(size=3)
        distances = [np.linalg.norm(nearest_point(*map(tuple, c - x))) for c in corners]
        k = int(np.argmin(distances))
        for seed in (0, k, 11):
            found = wall_lists.nearest_triangle(tree, tuple(x), 9.0, seed)
            assert found == (k, pytest.approx(distances[k]))
            cut = 0.99 * distances[k]
            assert wall_lists.nearest_triangle(tree, tuple(x), cut, seed) == (-1, pytest.approx(cut))


def test_triangles_of_a_plane_are_known_as_such(random):
    for _ in range(10):
        e = np.linalg.qr(random.normal(size=(3, 3)))[0]
        flat = random.normal(size=(2, 3, 2)) @ e[:2] + 3.0 * e[2]
        corners = np.concatenate([flat, flat[1:] + 1e-6 * e[2], flat[1:] * [1.0, 1.0, 1.0]])
        corners[3, random.integers(3)] += 1e-6 * e[2]
        normals = np.tile(e[2], (4, 1))
        tree = WallTree(corners, normals, None, None, None, None)
        assert [wall_lists._in_plane(tree, 0, j) for j in range(4)] == [True, True, False, False]
        # The other side of a thin wall is another plane.
        turned = tree._replace(normals=normals * [[1], [-1], [1], [1]])
        assert not wall_lists._in_plane(turned, 0, 1)
        found = np.arange(4)
        assert wall_lists._planes_first(tree, found, 4) == 3
        assert found.tolist() == [0, 2, 3, 1]


def test_a_triangle_is_a_wall_of_a_cell_from_which_a_perpendicular_ends_on_it(random):
    """Against many places in the cell; an edge counts within the limit."""
    kinds = set()
    for k in range(300):
        corners, normals = soup(random, 1, 1.0)
        normals *= random.choice([-1.0, 1.0])
        low = random.normal(size=3)
        boxes = np.concatenate([low, low + random.uniform(0.05, 0.5, 3)])[None]
        tree = WallTree(corners, normals, None, None, None, np.array([k % 2 == 0]))
        middle = wall_lists._middle(boxes, 0)
        half = tuple(0.5 * (boxes[0, 3:] - boxes[0, :3]))
        sight, limit = 1.5, 0.7
        kind = wall_lists._kind(tree, 0, boxes, 0, middle, half, sight, limit)
        x = random.uniform(boxes[0, :3], boxes[0, 3:], (300, 3))
        a, b, c = corners[0]
        h = (x - a) @ normals[0]
        foot = x - h[:, None] * normals[0] - a
        w = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), foot.T, rcond=None)[0]
        ends = (h > 0.0) & (h < sight) & (w.min(axis=0) >= 0.0) & (w.sum(axis=0) <= 1.0)
        if ends.any():
            assert kind >= 0
        apart = np.maximum(corners[0].min(axis=0) - boxes[0, 3:], boxes[0, :3] - corners[0].max(axis=0))
        near = np.linalg.norm(np.maximum(apart, 0.0)) <= limit
        if (kind == 1) and k % 2 == 0:
            assert near
        elif kind == 1:
            raise AssertionError("a triangle without such an edge")
        elif near and k % 2 == 0:
            # Behind it, or out of sight.
            ends = np.array(list(itertools.product(*boxes.reshape(2, 3).T)))
            heights = (ends - a) @ normals[0]
            assert heights.max() <= 0.0 or heights.min() >= sight
        if kind == -1 and k % 2:
            # Not by much more than the cell is wide.
            assert not ends.any()
        kinds.add(kind)
    assert kinds == {-1, 0, 1}


def boxed_soup(random, n=60):
    """Small triangles all about, of which some count, and the boxes of some cells among them."""
    corners, normals = soup(random, n, 0.15)
    low = random.uniform(-1.5, 1.5, (25, 3))
    boxes = np.concatenate([low, low + random.uniform(0.1, 0.5, (25, 3))], axis=1)
    return wall_lists.wall_tree(corners, normals), boxes, 3 * np.arange(n) + 5


@pytest.mark.parametrize("most", [3, 5, 64])
def test_lists_for_touching_hold_what_is_near_or_the_nearest_alone(most, random, monkeypatch):
    """In the plain text; a list that would be longer than the most is the triangle nearest to the middle."""
    monkeypatch.setattr(wall_lists, "link", lambda function: function)
    monkeypatch.setattr(wall_lists, "MOST_LISTED", most)
    tree, boxes, names = boxed_soup(random)
    reach = 0.3
    start, near = wall_lists.near_walls(tree, boxes, reach, names, 1.0)
    low, high = tree.corners.min(axis=1) - reach, tree.corners.max(axis=1) + reach
    lengths = []
    for cell, box in enumerate(boxes):
        found = near[start[cell] : start[cell + 1]].tolist()
        meet = np.flatnonzero(np.all((low <= box[3:]) & (box[:3] <= high), axis=1))
        if len(meet) <= most:
            assert found == names[meet].tolist()
        else:
            middle = 0.5 * (box[:3] + box[3:])
            distances = [np.linalg.norm(nearest_point(*map(tuple, c - middle))) for c in tree.corners]
            assert found == [-1 - names[np.argmin(distances)]]
        lengths.append(len(meet))
    assert (max(lengths) > most) == (most < 64)
    assert min(lengths) < 3
    assert start[-1] == len(near)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_lists_for_seeing_hold_what_is_a_wall_of_its_own_kind(share, random, monkeypatch):
    """All that :func:`_kind` accepts of all triangles, asked one by one."""
    monkeypatch.setattr(wall_lists, "link", lambda function: function)
    tree, boxes, names = boxed_soup(random)
    edges = random.random(60) < share
    tree = tree._replace(edges=edges, cones=wall_lists._cones(tree.normals, edges, tree.leaves))
    sight, found_kinds = 0.6, set()
    start, seen = wall_lists.seen_walls(tree, boxes, sight, names)
    for cell, box in enumerate(boxes):
        middle = wall_lists._middle(boxes, cell)
        half = tuple(box[3:] - middle)
        size = np.linalg.norm(half)
        distances = [np.linalg.norm(nearest_point(*map(tuple, c - middle))) for c in tree.corners]
        expected = []
        if min(distances) < sight + size:
            limit = min(min(distances) + size, sight)
            for i in range(60):
                kind = wall_lists._kind(tree, i, boxes, cell, middle, half, sight, limit)
                low, high = tree.corners[i].min(axis=0), tree.corners[i].max(axis=0)
                apart = np.maximum(low - box[3:], box[:3] - high)
                if kind >= 0 and np.linalg.norm(np.maximum(apart, 0.0)) < sight:
                    expected.append(2 * names[i] + kind)
        found = seen[start[cell] : start[cell + 1]].tolist()
        # A box of a leaf may be near where a triangle of it is not.
        assert set(expected) <= set(found)
        assert found == sorted(found)
        for entry in set(found) - set(expected):
            i = int(np.flatnonzero(names == entry >> 1)[0])
            assert wall_lists._kind(tree, i, boxes, cell, middle, half, sight, limit) == entry & 1
        found_kinds |= {entry & 1 for entry in found}
    assert found_kinds == {0.0: {0}, 0.5: {0, 1}, 1.0: {1}}[share]


@pytest.mark.parametrize("axis", range(3))
def test_an_edge_is_seen_from_where_no_perpendicular_ends_on_its_triangle(axis, monkeypatch):
    """A small triangle far beside a small cell, hardly below it: only as an edge, and not beyond sight."""
    monkeypatch.setattr(wall_lists, "link", lambda function: function)
    corners = np.array([[[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]]])
    box = np.array([[1.0, 0.0, 0.1], [1.05, 0.05, 0.15]])
    corners, box = np.roll(corners, axis, axis=2), np.roll(box, axis, axis=1)
    normals = np.roll([[0.0, 0.0, 1.0]], axis, axis=1)
    tree = wall_lists.wall_tree(corners, normals)
    boxes, names = box.reshape(1, 6), np.array([7])
    assert wall_lists.seen_walls(tree, boxes, 1.0, names)[1].tolist() == [2 * 7 + 1]
    assert wall_lists.seen_walls(tree, boxes, 0.5, names)[1].tolist() == []
    # From behind it is no wall, nor where no edge of it can be the nearest.
    assert wall_lists.seen_walls(tree._replace(normals=-normals), boxes, 1.0, names)[1].tolist() == []
    inner = tree._replace(edges=np.array([False]), cones=tree.cones * [1, 1, 1, 1, 0])
    assert wall_lists.seen_walls(inner, boxes, 1.0, names)[1].tolist() == []
