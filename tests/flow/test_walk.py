from __future__ import annotations

from functools import cache
from itertools import combinations, permutations, product

import numpy as np
import pytest
import pyvista
from mesh_shapes import (
    KINDS,
    block,
    box_patches,
    corners,
    cyclic_row,
    grid,
    interfaces,
    period,
    rings,
)
from walking import walked

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.mesh.arrays import FREE, frame, no_mesh
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.walk import (
    FAILED,
    REACHED,
    cross,
    holds,
    recover,
    sample,
    sample_ahead,
    turbulence,
    walk,
    walk_on,
)

GRADIENT = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])


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


def look_ahead(flow, hosts, start, end, u, l, room):
    for i in range(start.shape[0]):
        x0, x1 = (start[i, 0], start[i, 1], start[i, 2]), (end[i, 0], end[i, 1], end[i, 2])
        _, room[i], _, velocity, gradient, _ = sample_ahead(flow, hosts[i], x0, x1, 0.0)
        for k in range(3):
            u[i, k] = velocity[k]
        for k in range(9):
            l[i, k] = gradient[k]


@pytest.mark.parametrize("reach", [0.01, 0.3, 3.0])
def test_ahead_the_flow_is_that_of_the_last_tetrahedron_on_the_way(reach, random):
    """Within the first one, in another, and beyond the boundary."""
    shape = block(6, 0.25, "mixed")
    mesh = build_mesh(shape, box_patches(shape))
    n = len(mesh.nodes)
    flow = MeshFlow(mesh, random.standard_normal((n, 3)), random.standard_normal((n, 3, 3)))
    start = random.random((2000, 3))
    end = start + reach * random.uniform(-0.5, 0.5, start.shape)
    first = flow.locate(start)
    last, *_ = walked(flow, first, start, end)
    assert 0.02 < np.mean(first == last) < 0.98 or reach == 3.0
    u, l, room = np.empty((2000, 3)), np.empty((2000, 9)), np.empty(2000)
    link(look_ahead)(flow.arrays(), first, start, end, u, l, room)
    expected_u, expected_l = flow.sample(end, last, 0.0)
    np.testing.assert_allclose(u, expected_u, atol=1e-11 * np.abs(expected_u).max())
    np.testing.assert_allclose(l, expected_l.reshape(-1, 9), atol=1e-11 * np.abs(expected_l).max())
    # Whatever is so near lies in it, and that is not next to nothing.
    roomy = room > 0.0
    assert np.array_equal(roomy, weights(flow, last, end).min(axis=1) > 0.0)
    for corner in product((-1.0, 1.0), repeat=3):
        assert weights(flow, last[roomy], end[roomy] + room[roomy, None] * corner).min() >= -1e-12
    size = flow.cell_size(last)
    assert np.median(room[roomy] / size[roomy]) > 0.003


def go_on(flow, hosts, ahead, start, end, found):
    for i in range(start.shape[0]):
        x0, x1 = (start[i, 0], start[i, 1], start[i, 2]), (end[i, 0], end[i, 1], end[i, 2])
        found[i], _, _, _ = walk_on(flow, hosts[i], ahead[i], x0, x1)


def test_a_way_is_not_followed_again_to_where_one_near_it_led(random):
    """Where no face leads on it is found there, and only there; else wherever one looks first."""
    flow = flow_on("hexahedra")
    start = random.random((2000, 3))
    end = start + random.uniform(-0.2, 0.2, start.shape)
    inside = np.all((end > 0.0) & (end < 1.0), axis=1)
    start, end = start[inside], end[inside]
    first, last, found = flow.locate(start), flow.locate(end), np.empty(len(end), dtype=np.int32)
    arrays, moved = flow.arrays(), first != last
    assert moved.mean() > 0.3
    for looked_at in (first, last, np.zeros_like(first)):
        link(go_on)(arrays, first, looked_at, start, end, found)
        assert np.array_equal(found, last)
    walled = arrays._replace(neighbours=np.full_like(arrays.neighbours, -1))
    link(go_on)(walled, first, first, start, end, found)
    assert np.array_equal(found, first)
    link(go_on)(walled, first, last, start, end, found)
    assert np.array_equal(found, last)


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
def test_an_interface_keeps_the_place(mesh, apart, random):
    """The host holds it, or is the nearest where the two sides lie apart by what is between their chords."""
    flow = at_rest(mesh)
    coupled = [c.patch for c in mesh.couplings]
    triangles = np.repeat(np.flatnonzero(np.isin(mesh.triangle_patch, coupled)), 5).astype(np.int32)
    share = random.dirichlet((1.0, 1.0, 1.0), len(triangles))
    x = np.einsum("nk,nki->ni", share, mesh.points[mesh.triangles[triangles]])
    hosts, y = np.empty(len(x), dtype=np.int32), np.empty((len(x), 3))
    link(crossed)(flow.arrays(), triangles, x, hosts, y)
    for c in mesh.couplings:
        here = mesh.triangle_patch[triangles] == c.patch
        assert y[here] == pytest.approx(x[here] @ c.turn.T + c.shift, abs=1e-9)
        there = mesh.triangles[mesh.triangle_patch == c.other]
        surface = pyvista.PolyData.from_regular_faces(mesh.points, there)
        _, nearest = surface.find_closest_cell(y[here], return_closest_point=True)
        assert np.linalg.norm(nearest - y[here], axis=1).max() <= apart + 1e-9
        depth = weights(flow, hosts[here], y[here]).min(axis=1)
        assert (depth > -1e-6).any()
        assert weights(flow, hosts[here], nearest)[depth < -1e-6] == pytest.approx(0.5, abs=0.5 + 1e-6)


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


@pytest.fixture
def tetrahedra(random):
    """Arrays of two tetrahedra among eight nodes with values of their own, and of turbulence."""
    nodes = random.normal(size=(8, 16))
    nodes[:, FREE] = 1.0
    nodes[[1, 2, 4], FREE] = 0.0
    return no_mesh()._replace(
        nodes=nodes,
        turbulence=random.normal(size=(8, 8)),
        tets=np.array([[0, 1, 2, 3], [6, 2, 7, 4]]),
    )


def shares(nodes, tet, x):
    """Of the corners in the value at x."""
    return np.linalg.solve(np.vstack([nodes[tet, :3].T, np.ones(4)]), [*x, 1.0])


def quadratic(nodes, rows, w):
    """The value at weights w: that of the linear field, and the bends along the edges off the walls."""
    u = w @ nodes[rows, 4:7]
    for (i, a), (j, b) in combinations(enumerate(rows), 2):
        bend = (nodes[a, 7:] - nodes[b, 7:]).reshape(3, 3) @ (nodes[b, :3] - nodes[a, :3])
        u = u + 0.5 * w[i] * w[j] * nodes[a, FREE] * nodes[b, FREE] * bend
    return u


@pytest.mark.parametrize("host", [0, 1])
def test_the_gradient_is_linear_between_nodes_and_the_velocity_quadratic(tetrahedra, host, random):
    """Along edges between two nodes off the walls; nodes 1, 2 and 4 are on walls."""
    arrays, x = tetrahedra, tuple(random.normal(size=3))
    w, rows = shares(arrays.nodes, arrays.tets[host], x), arrays.tets[host]
    u, l, u_t = sample(arrays, host, x, 0.3)
    assert u == pytest.approx(quadratic(arrays.nodes, rows, w), rel=1e-9)
    assert l == pytest.approx(w @ arrays.nodes[rows, 7:], rel=1e-9)
    assert u_t == (0.0, 0.0, 0.0)
    k, epsilon, slope, drift = turbulence(arrays, host, x, 0.3)
    expected = w @ arrays.turbulence[rows]
    assert (k, epsilon, *slope, *drift) == pytest.approx(expected, rel=1e-9)
    nothing = arrays._replace(turbulence=np.empty((0, 8)))
    assert turbulence(nothing, host, x, 0.3) == (0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_a_tetrahedron_holds_what_is_in_it_to_round_off(tetrahedra, random):
    arrays = tetrahedra
    for host, rows in enumerate(arrays.tets):
        arrays.tets[host, 1:3] = rows[[2, 1]] if frame(arrays, host)[4] < 0.0 else rows[[1, 2]]
        corners = arrays.nodes[arrays.tets[host], :3]
        for out in range(4):
            w = np.insert(random.dirichlet(np.ones(3)), out, 0.0)
            for off, inside in ((-1e-6, False), (-2e-9, False), (-5e-10, True), (1e-3, True)):
                shifted = (1.0 - off) * w
                shifted[out] = off
                assert holds(arrays, host, tuple(shifted @ corners)) == inside


@pytest.mark.parametrize("angle", [0.0, 40.0])
def test_who_meets_a_coupled_patch_goes_on_beyond_its_neighbour(angle, random):
    """At the place that the motion gives, in the tetrahedron that holds it."""
    mesh = cyclic_row(angle, 1)
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
    arrays, (turn, shift) = flow.arrays(), period(angle)
    names = [patch.name for patch in mesh.patches]
    for name, q, s in (("left", turn, shift), ("right", turn.T, -turn.T @ shift)):
        for triangle in np.flatnonzero(mesh.triangle_patch == names.index(name))[:12]:
            x = random.dirichlet(np.ones(3)) @ mesh.points[mesh.triangles[triangle]]
            host, y, rotation = cross(arrays, int(triangle), tuple(x))
            assert np.reshape(rotation, (3, 3)) == pytest.approx(q, abs=1e-6)
            assert y == pytest.approx(q @ x + s, abs=1e-6)
            assert weights(flow, np.array([host]), np.array([y])).min() > -1e-6
            patch = names.index("right" if name == "left" else "left")
            assert host in mesh.triangle_tet[mesh.triangle_patch == patch]
    lone = int(np.flatnonzero(mesh.triangle_patch == names.index("floor"))[0])
    assert cross(arrays, lone, (0.1, 0.2, 0.3))[0] == -1


@pytest.mark.parametrize("axis", range(3))
def test_a_way_that_no_face_lets_out_begins_anew_nearer_to_the_middle(axis, monkeypatch):
    """Two tetrahedra; the start is beyond the side between them by more than round-off, the end less so."""

    def no_thread(*_):
        raise AssertionError("the way is found from a nudged start")

    monkeypatch.setattr("foamprb.flow.walk.find_thread", no_thread)
    nodes = np.zeros((5, 16))
    side = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    nodes[:, :3] = np.roll([*side, [-1.0, 0.3, 0.3], [1.0, 0.3, 0.3]], axis, axis=1)
    arrays = no_mesh()._replace(
        nodes=nodes, n_points=3, tets=np.array([[3, 0, 1, 2], [4, 0, 2, 1]]),
        neighbours=np.array([[1, -1, -2, -3], [0, -4, -5, -6]]), folds=np.zeros(2, dtype=np.uint8),
        triangle_patch=np.arange(6),
    )  # fmt: skip
    assert min(frame(arrays, t)[4] for t in (0, 1)) > 0.0
    x0, x1 = (tuple(np.roll(x, axis)) for x in ((1e-5, 0.3, 0.3), (5e-6, 0.3, 0.31)))
    assert walk(arrays, 0, x0, x1) == (1, 1.0, REACHED, -1)
    # From so far beyond no nudge helps.
    with pytest.raises(AssertionError, match="nudged"):
        walk(arrays, 0, tuple(np.roll((1e-3, 0.3, 0.3), axis)), tuple(np.roll((5e-4, 0.3, 0.31), axis)))


def test_a_way_through_the_rim_of_a_wall_goes_on_inside():
    """Two tetrahedra whose walls make an edge that stands inwards; the way touches it and misses both walls.

    At the edge the way leaves by a wall and by the side between the tetrahedra at once, in whatever order.
    """
    nodes = np.zeros((5, 16))
    nodes[:, :3] = [[0, 0, -1], [0, 0, 1], [0, 1, 0], [-1, -1, 0], [1, -1, 0]]
    for order in permutations((3, 0, 1, 2)):
        first = list(order)
        if np.linalg.det(nodes[first[1:], :3] - nodes[first[0], :3]) < 0.0:
            first[:2] = first[1::-1]
        neighbours = np.array([[-1, -2, -3, -4], [0, -5, -6, -7]])
        neighbours[0, first.index(3)] = 1
        arrays = no_mesh()._replace(
            nodes=nodes, n_points=3, tets=np.array([first, [4, 0, 1, 2]]), neighbours=neighbours,
            folds=np.zeros(5, dtype=np.uint8), triangle_patch=np.arange(7),
        )  # fmt: skip
        assert min(frame(arrays, t)[4] for t in (0, 1)) > 0.0
        assert walk(arrays, 0, (-0.25, 0.0, 0.0), (0.25, 0.0, 0.0)) == (1, 1.0, REACHED, -1)
