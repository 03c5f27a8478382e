from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import pyvista
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_shapes import KINDS, block, box_patches, corners, grid, interfaces, pipe, pipe_patches, rings

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.mesh.locator import build_tree, cell_boxes
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.walk import FAILED, REACHED, cross, normal, recover, walk
from foamprb.flow.wall_lists import near_walls, wall_tree
from foamprb.flow.walls import gap

GRADIENT = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])
ROOM = 1.0 - 1e-9


def follow(flow, hosts, start, end, found, fractions):
    for i in range(start.shape[0]):
        host, fraction, patch, triangle = walk(
            flow, hosts[i], (start[i, 0], start[i, 1], start[i, 2]), (end[i, 0], end[i, 1], end[i, 2])
        )
        found[i, 0], found[i, 1], found[i, 2], fractions[i] = host, patch, triangle, fraction


def clearances(flow, hosts, x, F, R, gaps, triangles):
    for i in range(x.shape[0]):
        f = (F[i, 0], F[i, 1], F[i, 2], F[i, 3], F[i, 4], F[i, 5], F[i, 6], F[i, 7], F[i, 8])
        gaps[i], _, triangles[i] = gap(flow, hosts[i], (x[i, 0], x[i, 1], x[i, 2]), f, R)


def walked(flow, hosts, start, end):
    found, fractions = np.empty((len(start), 3), dtype=np.int32), np.empty(len(start))
    link(follow)(flow.arrays(), hosts, start, end, found, fractions)
    return found[:, 0], fractions, found[:, 1], found[:, 2]


def cleared(flow, x, F, R, reach):
    gaps, triangles = np.empty(len(x)), np.empty(len(x), dtype=np.int32)
    link(clearances)(
        flow.arrays(reach), flow.locate(x), x, np.asarray(F, dtype=float).reshape(-1, 9), R, gaps, triangles
    )
    return gaps, triangles


def at_rest(mesh):
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def linear(mesh):
    nodes = mesh.nodes
    return MeshFlow(mesh, nodes @ GRADIENT.T, np.broadcast_to(GRADIENT, (len(nodes), 3, 3)))


@cache
def flow_on(kind, n=6, perturbation=0.25):
    shape = block(n, perturbation, kind)
    return linear(build_mesh(shape, box_patches(shape)))


def weights(flow, tets, x):
    a, b, c, d = (flow.mesh.nodes[flow.mesh.tets[tets, k]] for k in range(4))
    part = np.linalg.solve(np.stack([b - a, c - a, d - a], axis=2), (x - a)[:, :, None])[:, :, 0]
    return np.column_stack([1.0 - part.sum(axis=1), part])


def test_tree_finds_what_trying_all_tetrahedra_finds(random):
    flow = flow_on("mixed", 3)
    points = random.uniform(-0.1, 1.1, (400, 3))
    hosts = flow.locate(points)
    n = len(flow.mesh.tets)
    best = np.array([weights(flow, np.arange(n), np.tile(x, (n, 1))).min(axis=1).max() for x in points])
    assert np.array_equal(hosts >= 0, best >= -1e-9)
    inside = hosts >= 0
    assert weights(flow, hosts[inside], points[inside]).min(axis=1) == pytest.approx(best[inside], abs=1e-12)


@pytest.mark.parametrize("n", [1, 2, 7, 8, 9, 17, 1000])
def test_tree_holds_every_box_once(n, random):
    low = random.random((n, 3))
    boxes = np.concatenate([low, low + 0.1 * random.random((n, 3))], axis=1)
    tree, cells = build_tree(boxes)
    assert sorted(cells[cells >= 0].tolist()) == list(range(n))
    leaves = len(cells)
    for leaf in range(leaves):
        node = leaves + leaf
        while node:
            for cell in cells[leaf][cells[leaf] >= 0]:
                assert np.all(tree[node, :3] <= boxes[cell, :3])
                assert np.all(tree[node, 3:] >= boxes[cell, 3:])
            node //= 2


@pytest.mark.parametrize("kind", KINDS)
def test_linear_flow_is_sampled_exactly(kind, random):
    flow = flow_on(kind)
    points = random.random((2000, 3))
    u, l = flow.sample(points, flow.locate(points), 0.0)
    assert u == pytest.approx(points @ GRADIENT.T, abs=1e-13)
    assert l == pytest.approx(np.broadcast_to(GRADIENT, l.shape), abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_walks_end_where_the_tree_finds_them(kind, random):
    flow = flow_on(kind)
    start, end = random.random((2, 10_000, 3))
    hosts, fractions, patches, _ = walked(flow, flow.locate(start), start, end)
    assert np.all(patches == REACHED)
    assert np.all(fractions == 1.0)
    assert weights(flow, hosts, end).min() >= -1e-9
    assert np.array_equal(hosts, flow.locate(end))


@pytest.mark.parametrize("kind", KINDS)
def test_walls_are_met_where_the_straight_line_crosses_them(kind, random):
    flow = flow_on(kind)
    start, end = random.random((10_000, 3)), random.uniform(-1.0, 2.0, (10_000, 3))
    hosts, fractions, patches, triangles = walked(flow, flow.locate(start), start, end)
    with np.errstate(divide="ignore"):
        step = end - start
        exact = np.minimum(1.0, np.where(step > 0.0, (1.0 - start) / step, -start / step).min(axis=1))
    assert np.array_equal(patches >= 0, exact < 1.0)
    assert not np.any(patches == FAILED)
    assert fractions == pytest.approx(exact, abs=1e-12)
    out = patches >= 0
    hits = (start + fractions[:, None] * step)[out]
    assert np.array_equal(hosts[out], flow.mesh.triangle_tet[triangles[out]])
    assert weights(flow, hosts[out], hits).min() > -1e-8
    names = np.array([patch.name for patch in flow.patches])[patches[out]]
    assert np.array_equal(names == "floor", hits[:, 2] < 1e-9)


def crossed(flow, triangles, x, hosts, y):
    for i in range(x.shape[0]):
        hosts[i], place, _ = cross(flow, triangles[i], (x[i, 0], x[i, 1], x[i, 2]))
        y[i, 0], y[i, 1], y[i, 2] = place[0], place[1], place[2]


@pytest.mark.parametrize(
    ("mesh", "apart"),
    [(rings(), 1.0 - np.cos(np.pi / 24)), (interfaces(0.0)[0], 0.0), (interfaces(40.0, (4, 5))[0], 0.0)],
    ids=["rings", "row", "bend"],
)
def test_across_an_interface_the_nearest_place_of_the_other_side_is_next(mesh, apart, random):
    """The two sides may be cut differently, and lie apart by what is between their chords."""
    flow = at_rest(mesh)
    coupled = [c.patch for c in mesh.couplings]
    triangles = np.repeat(np.flatnonzero(np.isin(mesh.triangle_patch, coupled)), 5).astype(np.int32)
    share = random.dirichlet((1.0, 1.0, 1.0), len(triangles))
    x = np.einsum("nk,nki->ni", share, mesh.points[mesh.triangles[triangles]])
    hosts, y = np.empty(len(x), dtype=np.int32), np.empty((len(x), 3))
    link(crossed)(flow.arrays(), triangles, x, hosts, y)
    assert np.all(weights(flow, hosts, y) > -1e-9)
    for c in mesh.couplings:
        here = mesh.triangle_patch[triangles] == c.patch
        there = mesh.triangles[mesh.triangle_patch == c.other]
        surface = pyvista.PolyData.from_regular_faces(mesh.points, there)
        images = x[here] @ c.turn.T + c.shift
        _, nearest = surface.find_closest_cell(images, return_closest_point=True)
        off, least = (np.linalg.norm(z - images, axis=1) for z in (y[here], nearest))
        # An image that a tetrahedron over there holds stays where it is.
        inside = weights(flow, hosts[here], images).min(axis=1) > -1e-9
        assert off[inside] == pytest.approx(0.0, abs=1e-9)
        assert off[~inside] == pytest.approx(least[~inside], abs=1e-9)
        assert least.max() <= apart + 1e-9
        assert inside.any()


@pytest.mark.parametrize("perturbation", [0.0, 0.25])
@pytest.mark.parametrize("kind", KINDS)
def test_walks_from_vertex_to_vertex(kind, perturbation, random):
    """Along edges and faces, and through vertices: every choice of the way is a tie."""
    flow = flow_on(kind, 4, perturbation)
    nodes = flow.mesh.nodes
    start, end = nodes[random.integers(0, len(nodes), (2, 5000))]
    hosts = flow.locate(start)
    assert np.all(hosts >= 0)
    hosts, _, patches, _ = walked(flow, hosts, start, end)
    assert np.all(patches == REACHED)
    assert weights(flow, hosts, end).min() >= -1.01e-9


@pytest.mark.parametrize("kind", KINDS)
def test_walks_along_the_boundary(kind, random):
    flow = flow_on(kind)
    start, end = random.random((2, 2000, 3))
    start[:, 2] = end[:, 2] = 0.0
    start[:500, 1] = end[:500, 1] = 1.0
    _, _, patches, _ = walked(flow, flow.locate(start), start, end)
    assert np.all(patches == REACHED)


def test_walks_from_every_tetrahedron_that_holds_the_start(random):
    """A start on a face, edge or vertex belongs to several hosts; each must do."""
    flow = flow_on("hexahedra", 3)
    mesh = flow.mesh
    tets = np.arange(len(mesh.tets))
    share = random.integers(0, 3, (len(tets), 4)) * random.random((len(tets), 4))
    share[share.sum(axis=1) == 0.0] = 1.0
    start = np.einsum("tk,tki->ti", share / share.sum(axis=1, keepdims=True), mesh.nodes[mesh.tets])
    end = random.random((len(tets), 3))
    hosts, _, patches, _ = walked(flow, tets.astype(np.int32), start, end)
    assert np.all(patches == REACHED)
    assert np.array_equal(hosts, flow.locate(end))


def test_a_start_outside_by_round_off_meets_the_wall_at_once():
    flow = flow_on("hexahedra")
    start = np.array([[0.3, 0.4, -1e-11], [0.3, 0.4, -1e-11]])
    end = np.array([[0.35, 0.4, -0.1], [0.35, 0.4, 0.1]])
    _, fractions, patches, _ = walked(flow, flow.locate(start), start, end)
    assert patches.tolist() == [0, REACHED]
    assert fractions == pytest.approx([0.0, 1.0])


@given(st.integers(0, 10_000), st.floats(0.0, 1.5))
@settings(max_examples=15)
def test_no_particle_is_lost_in_a_crumpled_mesh(seed, perturbation):
    """With tetrahedra turned inside out a walk may fail, but openly, and the tree knows the place."""
    flow = linear(build_mesh(block(3, perturbation, seed=seed)))
    random = np.random.default_rng(seed)
    start, end = random.random((2, 500, 3))
    hosts, _, patches, _ = walked(flow, flow.locate(start), start, end)
    assert np.all((patches == REACHED) | (patches == FAILED))
    good = patches == REACHED
    assert weights(flow, hosts[good], end[good]).min() >= -1.01e-9
    assert np.count_nonzero(~good) <= (0 if flow.mesh.inverted == 0 else 60)
    assert np.all(flow.locate(end[~good]) >= 0)


def test_walks_around_a_corner_that_points_inwards(random):
    """An L-shaped room: the planes of some walls cut through the room."""
    points, hexes = corners(4, 0.0)
    middle = points[hexes].mean(axis=1)
    shape = grid(points, [(12, hexes[~np.all(middle[:, :2] > 0.5, axis=1)])])
    flow = linear(build_mesh(shape))
    start = np.column_stack([np.full(200, 0.5), np.full(200, 0.5), random.random(200)])
    ends = [
        start + np.array(step) * 0.4
        for step in ([-1, 0.5, 0], [0.5, -1, 0], [0, -1, 0], [-1, 0, 0], [0, 1, 0])
    ]
    for end in ends:
        _, _, patches, _ = walked(flow, flow.locate(start), start, end)
        assert np.all(patches == REACHED)
    _, fractions, patches, _ = walked(flow, flow.locate(start), start, start + np.array([0.1, 0.1, 0.0]))
    assert np.all(patches == 0)
    assert fractions == pytest.approx(np.zeros(200), abs=1e-8)


def test_kernels_mean_the_same_uncompiled(random):
    flow = flow_on("tetrahedra", 2)
    arrays = flow.arrays()
    start, end = random.random((2, 20, 3))
    hosts = flow.locate(start)
    assert [recover(arrays, tuple(x)) for x in start] == hosts.tolist()
    last, fractions, _, _ = walked(flow, hosts, start, end)
    assert [
        walk(arrays, h, tuple(a), tuple(b))[:2] for h, a, b in zip(hosts, start, end, strict=True)
    ] == list(zip(last.tolist(), fractions.tolist(), strict=True))


def random_deformations(random, n):
    F = np.eye(3) + 0.6 * random.uniform(-1.0, 1.0, (n, 3, 3))
    return F / np.cbrt(np.linalg.det(F))[:, None, None]


def test_gap_over_a_plane_wall_is_the_support_function(random):
    flow = flow_on("hexahedra", 8, 0.2)
    n, R = 500, 0.03
    F = random_deformations(random, n)
    F = F[np.linalg.det(F) > 0.0]
    reach = R * np.linalg.norm(F, axis=(1, 2)).max()
    x = 0.4 + 0.2 * random.random((len(F), 3))
    x[:, 2] = reach * random.random(len(F))
    gaps, _ = cleared(flow, x, F, R, reach)
    stretch = np.linalg.norm(F[:, 2, :], axis=1)
    near = x[:, 2] < R * stretch
    assert np.array_equal(gaps < 0.0, near)
    assert gaps[near] == pytest.approx((x[:, 2] / stretch - R)[near], abs=1e-12)


def test_gap_at_an_edge_that_points_inwards():
    points, hexes = corners(8, 0.0)
    middle = points[hexes].mean(axis=1)
    shape = grid(points, [(12, hexes[~np.all(middle[:, :2] > 0.5, axis=1)])])
    flow = linear(build_mesh(shape))
    x = np.array([[0.47, 0.46, 0.4], [0.44, 0.47, 0.5]])
    F = np.tile(np.diag([1.2, 1.0, 1.0 / 1.2]), (2, 1, 1))
    F[1] = [[1.0, 0.4, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    gaps, _ = cleared(flow, x, F, 0.02, 0.05)
    for index in range(2):
        z = np.linspace(0.2, 0.8, 200_001)
        edge = np.column_stack([np.full(len(z), 0.5), np.full(len(z), 0.5), z]) - x[index]
        distance = np.linalg.norm(edge @ np.linalg.inv(F[index]).T, axis=1).min()
        assert gaps[index] == pytest.approx(distance - 0.02, abs=1e-9)


def test_gap_is_infinite_away_from_walls_and_before_other_patches():
    flow = flow_on("hexahedra", 8, 0.2)
    x = np.array([[0.5, 0.5, 0.5], [0.5, 0.5, 0.999], [0.5, 0.5, 0.001]])
    gaps, triangles = cleared(flow, x, np.tile(np.eye(3), (3, 1, 1)), 0.01, 0.01)
    assert np.isinf(gaps).tolist() == [True, True, False]
    assert triangles[:2].tolist() == [-1, -1]
    assert normal(flow.arrays(), triangles[2], (0.0, 0.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0))


def test_near_walls_lists_all_that_are_near():
    shape = pipe(6)
    mesh = build_mesh(shape, pipe_patches(shape))
    boxes, reach = cell_boxes(mesh), 0.11
    corner = mesh.points[mesh.triangles]
    walls = np.flatnonzero(mesh.triangle_patch == 2).astype(np.int32)
    tree = wall_tree(corner[walls], mesh.triangle_normals[walls], np.ones(len(walls), dtype=bool))
    start, near = near_walls(tree, boxes, reach, walls, 1.0)
    low, high = corner.min(axis=1) - reach, corner.max(axis=1) + reach
    for cell in range(mesh.n_cells):
        meets = np.all((boxes[cell, :3] <= high) & (boxes[cell, 3:] >= low), axis=1) & (
            mesh.triangle_patch == 2
        )
        assert near[start[cell] : start[cell + 1]].tolist() == np.flatnonzero(meets).tolist()


def test_bodies_many_cells_wide_are_refused_before_memory_is_full(monkeypatch):
    shape = block(8, 0.2)
    flow = linear(build_mesh(shape, box_patches(shape)))
    pairs = len(flow.arrays(0.2).near)
    assert pairs > 8**3
    flow.arrays(0.1)
    monkeypatch.setattr("foamprb.flow.wall_lists._MOST_ENTRIES", pairs - 1)
    with pytest.raises(InputError, match=r"within 0.2 m .* but cells are 0\.12\d* m wide") as refused:
        flow.arrays(0.2)
    assert f"more than {pairs - 1} entries" in str(refused.value)
    monkeypatch.setattr("foamprb.flow.wall_lists._MOST_ENTRIES", pairs)
    assert len(flow.arrays(0.2).near) == pairs


def test_cells_and_patches_of_a_flow():
    shape = block(4, 0.0)
    flow = linear(build_mesh(shape, box_patches(shape)))
    hosts = flow.locate(np.array([[0.1, 0.1, 0.1], [0.9, 0.9, 0.9], [2.0, 0.0, 0.0]]))
    assert flow.cell_of(hosts[:2]).tolist() == [0, 63]
    assert hosts[2] == -1
    assert flow.cell_size(hosts[:2]) == pytest.approx([0.25, 0.25])
    assert np.array_equal(flow.bounds, [[0.0] * 3, [1.0] * 3])
    lid = flow.patch_faces("lid", 0.0)
    assert np.sum(lid.areas) == pytest.approx(1.0)
    assert np.all(lid.vertices[:, :, 2] == 1.0)
    assert np.allclose(lid.normals, [0.0, 0.0, -1.0])
    assert lid.velocity == pytest.approx(lid.vertices @ GRADIENT.T)
    assert weights(flow, lid.hosts, lid.vertices.mean(axis=1)).min() > -1e-12
    with pytest.raises(InputError, match="patch lidd is not in the mesh\\. Did you mean 'lid'"):
        flow.patch_faces("lidd", 0.0)
