"""Tree over boxes."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.flow.mesh.tree import build_tree, holds_point, next_node, pairs_near


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


def test_traversal_visits_the_leaves_that_hold_a_point(random):
    """Each once and in order; subtrees whose box does not hold the point are skipped."""
    low = random.random((100, 3))
    boxes, leaves = build_tree(np.concatenate([low, low + 0.2], axis=1))
    n = len(leaves)
    for x in random.uniform(-0.2, 1.2, (200, 3)):
        expected = n + np.flatnonzero(np.all((boxes[n:, :3] <= x) & (x <= boxes[n:, 3:]), axis=1))
        found, node = [], 1
        while node > 0:
            hit = holds_point(boxes, node, x)
            found += [node] if hit and node >= n else []
            node = next_node(node, n, hit)
        assert found == expected.tolist()


@pytest.mark.parametrize("n", [1, 9, 40])
def test_boxes_that_meet_are_listed_cell_by_cell(n, random):
    """Those that touch meet as well."""
    low, others = random.integers(0, 8, (n, 3)), random.integers(0, 8, (30, 3))
    boxes = np.concatenate([low, low + random.integers(1, 3, (n, 3))], axis=1).astype(float)
    targets = np.concatenate([others, others + random.integers(0, 3, (30, 3))], axis=1).astype(float)
    start, found = pairs_near(boxes, build_tree(boxes), targets)
    for cell in range(n):
        meet = np.all((boxes[cell, :3] <= targets[:, 3:]) & (targets[:, :3] <= boxes[cell, 3:]), axis=1)
        assert found[start[cell] : start[cell + 1]].tolist() == np.flatnonzero(meet).tolist()
    assert start[-1] == len(found)
    assert n == 1 or len(found) > 0
