"""That lists of walls nearby leave out nothing that counts, however short they are."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, pipe, pipe_patches
from mesh_shapes import grid as make_grid

from foamprb.compile.link import link
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.planes import planes_among
from foamprb.flow.wall_lists import EDGE, SURE, edges_out, wall_tree
from foamprb.flow.walls import gap, nearest_wall


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
    tree = wall_tree(corners, normals, np.ones(len(walls), dtype=bool))
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
    whole = arrays._replace(seen=(4 * names + EDGE).astype(np.int32))
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


def test_a_plane_is_one_entry_where_no_edge_of_it_is_near():
    grid, patches = SHAPES["fine box"]
    mesh = build_mesh(grid, patches)
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
    arrays = flow.arrays(0.0, (), 0.3, solid(flow))
    cell = int(arrays.tets[flow.locate(np.array([[0.55, 0.55, 0.2]]))[0], 0]) - arrays.n_points
    begin, end = arrays.seen_start[cell : cell + 2]
    assert end - begin == 1
    assert arrays.seen[begin] & SURE
    assert arrays.triangle_normals[arrays.seen[begin] >> 2] == pytest.approx([0.0, 0.0, 1.0])


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


def test_the_gap_is_the_same_from_a_tree_as_from_a_list(flow, monkeypatch):
    """To the last bit, the triangle too, for bodies that are long."""
    walls = solid(flow)
    R, reach = 0.05, 0.6
    names = np.flatnonzero(np.isin(flow.mesh.triangle_patch, walls)).astype(np.int32)
    monkeypatch.setattr("foamprb.flow.wall_lists.MOST_LISTED", 2)
    arrays = flow.arrays(reach, walls)
    assert (np.diff(arrays.near_start) <= 2).all()
    whole = arrays._replace(near=names)
    ours, theirs = link(gap), link(nearest_wall)
    random, used = np.random.default_rng(1), 0
    for x, host in places(flow, 200):
        U, _, V = np.linalg.svd(random.standard_normal((3, 3)))
        F = tuple((U @ np.diag([2.0, 1.0, 0.5]) @ V).ravel())
        cell = arrays.tets[host, 0] - arrays.n_points
        begin, end = arrays.near_start[cell], arrays.near_start[cell + 1]
        if begin < end and arrays.near[begin] < 0:
            used += 1
            assert ours(arrays, host, tuple(x), F, R) == theirs(whole, 0, len(names), tuple(x), F, R)
    assert used > 50
    flow.arrays(0.9 * reach, walls)


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
