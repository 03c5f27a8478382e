"""The tree over boxes, and the tetrahedron that holds a point."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block

from foamprb.flow.mesh import locator
from foamprb.flow.mesh.arrays import TOLERANCE, next_leaf
from foamprb.flow.mesh.locator import build_tree, cell_boxes, locate, seek
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow


@pytest.fixture(scope="module")
def flow():
    mesh = build_mesh(block(3, 0.3, "mixed"))
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def test_a_box_holds_the_points_and_the_centre_of_its_cell(flow):
    """And four times the tolerance of its longest side."""
    mesh = flow.mesh
    found = np.full((mesh.n_cells, 6), np.nan)
    centres = mesh.centres.copy()
    # A centre beside its cell counts as well.
    centres[4] += (3.0, 0.0, 0.0)
    locator._bound(mesh.points, centres, mesh.cell_point_start, mesh.cell_points, found)
    assert not np.array_equal(found, cell_boxes(mesh))
    for cell in range(mesh.n_cells):
        own = mesh.cell_points[slice(*mesh.cell_point_start[cell : cell + 2])]
        held = np.vstack([mesh.points[own], centres[cell]])
        low, high = held.min(axis=0), held.max(axis=0)
        margin = 4.0 * TOLERANCE * (high - low).max()
        np.testing.assert_allclose(found[cell], [*(low - margin), *(high + margin)], rtol=0, atol=1e-15)


@pytest.mark.parametrize("n", [1, 8, 9, 16, 17, 100])
def test_leaves_are_as_full_as_they_can_be(n, random):
    """At most eight in each, in a balanced tree; every node is the box of what is below it."""
    low = random.random((n, 3)) * [1.0, 5.0, 0.2]
    boxes = np.concatenate([low, low + 0.01], axis=1)
    tree, cells = build_tree(boxes)
    leaves = 1
    while 8 * leaves < n:
        leaves *= 2
    assert cells.shape == (leaves, -(-n // leaves))
    assert cells.dtype == np.int32
    assert tree.shape == (2 * leaves, 6)
    assert tree[0].tolist() == [np.inf] * 3 + [-np.inf] * 3
    for node in range(1, 2 * leaves):
        first, last = node, node
        while first < leaves:
            first, last = 2 * first, 2 * last + 1
        own = cells[first - leaves : last - leaves + 1].ravel()
        own = own[own >= 0]
        if len(own) == 0:
            assert tree[node].tolist() == [np.inf] * 3 + [-np.inf] * 3
            continue
        np.testing.assert_array_equal(tree[node, :3], boxes[own, :3].min(axis=0))
        np.testing.assert_array_equal(tree[node, 3:], boxes[own, 3:].max(axis=0))


def test_all_leaves_that_hold_a_place_are_found_in_turn(flow, random):
    """Those whose boxes, and of course whose ancestors' boxes, hold it; none twice, and none outside."""
    arrays = flow.arrays()
    boxes, leaves = arrays.tree_boxes, len(arrays.tree_cells)
    for x in random.uniform(-0.2, 1.2, (200, 3)):
        expected = leaves + np.flatnonzero(
            np.all((boxes[leaves:, :3] <= x) & (x <= boxes[leaves:, 3:]), axis=1)
        )
        found, leaf = [], next_leaf(arrays, 0, x)
        while leaf:
            found.append(leaf)
            leaf = next_leaf(arrays, leaf, x)
        assert found == expected.tolist()


def test_a_group_is_halved_along_its_longest_axis(random):
    for axis in range(3):
        centres = random.random((32, 3))
        centres[:, axis] *= 3.0
        centres[28:] = np.inf
        order = random.permutation(32).astype(np.int32)
        locator._halve(centres, order, 1)
        assert sorted(order) == list(range(32))
        assert centres[order[:16], axis].max() <= centres[order[16:], axis].min()
        locator._halve(centres, order, 2)
        for begin in (0, 16):
            half = order[begin : begin + 16]
            there = centres[half][np.isfinite(centres[half]).all(axis=1)]
            longest = int(np.ptp(there, axis=0).argmax())
            assert centres[half[:8], longest].max() <= centres[half[8:], longest].min()


def test_the_lower_part_is_put_first(random):
    for n in (2, 3, 10, 31):
        for _ in range(20):
            centres = random.integers(0, 8, (n, 3)).astype(float)
            order, middle = random.permutation(n), int(random.integers(1, n))
            locator._part(centres, 1, order, 0, n - 1, middle)
            assert sorted(order) == list(range(n))
            assert centres[order[:middle], 1].max() <= centres[order[middle:], 1].min()


def test_the_host_of_a_place_is_the_tetrahedron_with_the_largest_smallest_weight(flow, random):
    """As all of them tell; outside there is none."""
    arrays, nodes, tets = flow.arrays(), flow.mesh.nodes, flow.mesh.tets
    a = nodes[tets]
    matrices = np.concatenate([a.transpose(0, 2, 1), np.ones((len(tets), 1, 4))], axis=1)
    for x in [*random.uniform(-0.05, 1.05, (40, 3)), *nodes[random.integers(len(nodes), size=5)]]:
        w = np.linalg.solve(matrices, np.broadcast_to([*x, 1.0], (len(tets), 4))[:, :, None])[:, :, 0]
        depth = w.min(axis=1)
        found = locate(arrays, tuple(x))
        compiled = int(flow.locate(x[None])[0])
        assert seek(arrays, tuple(x), (0.0, 0.0, 1.0)) == found
        if depth.max() < -2.0 * TOLERANCE:
            assert found == compiled == -1
        else:
            assert depth[[found, compiled]] == pytest.approx(depth.max(), abs=1e-11)
    # By round-off outside it is still inside.
    assert locate(arrays, (0.5, 0.4, -1e-11)) >= 0
    assert locate(arrays, (0.5, 0.4, -1e-6)) == -1
