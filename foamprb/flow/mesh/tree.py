"""Balanced binary tree of bounding boxes: construction, and the functions with which kernels traverse it.

Node 1 is the root, node i has the children 2i and 2i + 1, and the last ``n_leaves`` nodes are the leaves. A
traversal visits the nodes whose boxes pass a test::

    node = 1
    while node > 0:
        hit = meet(tree.boxes, node, ...)
        if hit and node >= n_leaves:
            ...  # the entries of leaf node - n_leaves
        node = next_node(node, n_leaves, hit)
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np

from foamprb.body.tensor import Vector
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.lists import together

_LEAF = 8
_LEAST_APART = 20_000
"""Number of boxes from which the two halves of a tree are built at the same time."""


class Tree(NamedTuple):
    """Tree over n boxes."""

    boxes: Floats
    """(2 n_leaves, 6): lower and upper corner of each node's box, m."""
    leaves: Ints
    """(n_leaves, leaf size): indices of the boxes in each leaf, −1 for none."""


def next_node(node: int, n_leaves: int, enter: bool) -> int:
    """Return the next node of a depth-first traversal, 0 at its end; ``enter`` is False to skip a node."""
    if enter and node < n_leaves:
        return 2 * node
    while node & 1:
        node >>= 1
    return node + 1 if node > 0 else 0


def holds_point(boxes: Floats, i: int, x: Vector) -> bool:
    """Return True if a box holds a point."""
    return bool(
        boxes[i, 0] <= x[0] <= boxes[i, 3]
        and boxes[i, 1] <= x[1] <= boxes[i, 4]
        and boxes[i, 2] <= x[2] <= boxes[i, 5]
    )


def meet(boxes: Floats, i: int, others: Floats, j: int, reach: float) -> bool:
    """Return True if two boxes are at most ``reach`` (m) apart along each axis."""
    return bool(
        boxes[i, 0] - reach <= others[j, 3]
        and boxes[i, 1] - reach <= others[j, 4]
        and boxes[i, 2] - reach <= others[j, 5]
        and others[j, 0] <= boxes[i, 3] + reach
        and others[j, 1] <= boxes[i, 4] + reach
        and others[j, 2] <= boxes[i, 5] + reach
    )


def square_to_box(boxes: Floats, i: int, x: Vector) -> Any:
    """Return the squared distance of a point from a box, m²."""
    dx = max(boxes[i, 0] - x[0], 0.0, x[0] - boxes[i, 3])
    dy = max(boxes[i, 1] - x[1], 0.0, x[1] - boxes[i, 4])
    dz = max(boxes[i, 2] - x[2], 0.0, x[2] - boxes[i, 5])
    return dx * dx + dy * dy + dz * dz


def build_tree(boxes: Floats) -> Tree:
    """Sort boxes (n, 6), lower and upper corners, into a tree.

    Each level halves every group along the axis on which the group is longest.
    """
    n = len(boxes)
    depth = max(0, int(np.ceil(np.log2(n / _LEAF))))
    n_leaves = 1 << depth
    size = -(-n // n_leaves)
    # Empty entries sort behind all others.
    centres = np.full((size * n_leaves, 3), np.inf)
    centres[:n] = 0.5 * (boxes[:, :3] + boxes[:, 3:])
    order = np.arange(size * n_leaves, dtype=np.int32)
    halve, middle = link(_halve), len(order) // 2
    if len(order) < _LEAST_APART:
        halve(centres, order, depth)
    else:
        halve(centres, order, 1)
        halves = (centres[:middle], order[:middle]), (centres[middle:], order[middle:])
        together(*(partial(halve, *half, depth - 1) for half in halves))
    order = np.sort(order.reshape(n_leaves, size), axis=1)
    return tree_with(np.where(order < n, order, np.int32(-1)), boxes)


def tree_with(leaves: Ints, boxes: Floats) -> Tree:
    """Return a tree over boxes (n, 6) whose leaves, (n_leaves, leaf size), are known."""
    tree = np.empty((2 * len(leaves), 6))
    link(_bound)(boxes, leaves, tree)
    return Tree(tree, leaves)


def _bound(boxes: Floats, leaves: Ints, tree: Floats) -> None:
    """Write the box of each node of the tree, and an empty one in row 0."""
    n_leaves = leaves.shape[0]
    for node in range(2 * n_leaves - 1, -1, -1):
        for i in range(3):
            low, high = np.inf, -np.inf
            for k in range(leaves.shape[1] if node >= n_leaves else 0):
                cell = leaves[node - n_leaves, k]
                if cell >= 0:
                    low, high = min(low, boxes[cell, i]), max(high, boxes[cell, i + 3])
            for child in range(2 * node, 2 * node + 2 if 0 < node < n_leaves else 0):
                low, high = min(low, tree[child, i]), max(high, tree[child, i + 3])
            tree[node, i], tree[node, i + 3] = low, high


def _halve(centres: Floats, order: Ints, depth: int) -> None:
    """Put the lower half of each group along its longest axis before the upper, on each level of the tree.

    The rows of ``centres`` (n, 3) and of ``order`` (n,) are moved together.
    """
    for level in range(depth):
        size = order.shape[0] >> level
        for begin in range(0, order.shape[0], size):
            axis, longest = 0, 0.0
            for j in range(3):
                low, high = np.inf, -np.inf
                for k in range(begin, begin + size):
                    x = centres[k, j]
                    low, high = min(low, x), max(high, x if x < np.inf else high)
                if high - low > longest:
                    axis, longest = j, high - low
            _partition(centres, axis, order, begin, begin + size - 1, begin + size // 2)


def _partition(centres: Floats, axis: int, order: Ints, first: int, last: int, middle: int) -> None:
    """Sort partially, so that no entry before ``middle`` lies above one behind it (Hoare's selection)."""
    while first < last:
        pivot = centres[(first + last) // 2, axis]
        i, j = first, last
        while i <= j:
            while centres[i, axis] < pivot:
                i += 1
            while centres[j, axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                for k in range(3):
                    centres[i, k], centres[j, k] = centres[j, k], centres[i, k]
                i += 1
                j -= 1
        if middle <= j:
            last = j
        elif middle >= i:
            first = i
        else:
            return


def pairs_near(boxes: Floats, tree: Tree, targets: Floats) -> tuple[Ints, Ints]:
    """List, for each box of a tree, the boxes ``targets`` (n, 6) that meet it.

    Returns
    -------
    start, found
        The targets that meet box i are ``found[start[i]]`` to ``found[start[i + 1] - 1]``.
    """
    start, counts = np.zeros(len(boxes) + 1, dtype=np.int32), np.zeros(len(boxes), dtype=np.int32)
    link(_list_pairs)(tree, boxes, targets, counts, np.empty(0, dtype=np.int32))
    np.cumsum(counts, out=start[1:])
    found = np.empty(start[-1], dtype=np.int32)
    link(_list_pairs)(tree, boxes, targets, start[:-1].copy(), found)
    return start, found


def _list_pairs(tree: Tree, boxes: Floats, targets: Floats, place: Ints, found: Ints) -> None:
    """Advance ``place`` of each box by the count of targets that meet it; list these if there is room."""
    n_leaves = tree.leaves.shape[0]
    for target in range(targets.shape[0]):
        node = 1
        while node > 0:
            hit = meet(tree.boxes, node, targets, target, 0.0)
            for k in range(tree.leaves.shape[1] if hit and node >= n_leaves else 0):
                i = tree.leaves[node - n_leaves, k]
                if i >= 0 and meet(boxes, i, targets, target, 0.0):
                    if found.shape[0] > 0:
                        found[place[i]] = target
                    place[i] += 1
            node = next_node(node, n_leaves, hit)
