"""Walks through meshes that are folded over, and along edges of the wall that point inwards."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import corners, grid
from walking import walked

from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.walk import REACHED, walk

# Six tetrahedra of each cube, along its main diagonal.
PATHS = ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))
SHIFT = (0.375, 0.3125, 0.25)


def at_rest(shape):
    mesh = build_mesh(shape)
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def folded(kind):
    """A block of 27 cubes, one of whose inner points lies beyond the opposite sides of some of its cells."""
    points, hexes = corners(3, 0.0)
    inside = np.flatnonzero(np.all((points > 1e-9) & (points < 1.0 - 1e-9), axis=1))
    points[inside[0]] += SHIFT
    cells = [(12, hexes)] if kind == "hexahedra" else [(10, hexes[:, [0, a, b, 6]]) for a, b in PATHS]
    return at_rest(grid(points, cells))


def volumes(nodes, tets):
    a, b, c, d = (nodes[tets[:, k]] for k in range(4))
    return np.einsum("ni,ni->n", np.cross(b - a, c - a), d - a) / 6.0


def holds(flow, x):
    """Which tetrahedra hold each point, (n, m)."""
    nodes, tets = flow.mesh.nodes, flow.mesh.tets
    a, b, c, d = (nodes[tets[:, k]] for k in range(4))
    inverse = np.linalg.inv(np.stack([b - a, c - a, d - a], axis=2))
    w = np.einsum("tij,ptj->pti", inverse, x[:, None] - a)
    return (w.min(axis=2) >= -1e-9) & (w.sum(axis=2) <= 1.0 + 1e-9)


@pytest.mark.parametrize("kind", ["hexahedra", "tetrahedra"])
def test_a_walk_between_places_outside_a_fold_goes_through_it(kind, random):
    """A mesh covers each place once more by sound tetrahedra than by those turned inside out.

    So the way from a place that is covered once ends at such a place: it cannot be lost in the fold.
    """
    flow = folded(kind)
    assert flow.mesh.inverted > 0
    assert (volumes(flow.mesh.nodes, flow.mesh.tets) < 0.0).any()
    x = random.random((1500, 3))
    covered = holds(flow, x)
    once = np.flatnonzero(covered.sum(axis=1) == 1)
    assert len(once) > 1000
    a, b = random.choice(once, (2, 20_000))
    hosts, fractions, patches, _ = walked(flow, covered.argmax(axis=1)[a].astype(np.int32), x[a], x[b])
    assert np.all(patches == REACHED)
    assert np.all(fractions == 1.0)
    assert np.array_equal(hosts, covered.argmax(axis=1)[b])


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.parametrize("seed", [2816, 10313])
def test_a_path_in_the_side_of_a_folded_tetrahedron_is_followed_exactly(seed):
    """By the sign of round-off it could go to and fro between the two that share the side.

    The plain text and rounded points: on every processor the round-off is the same.
    """
    flow = folded("hexahedra")
    arrays = flow.arrays()
    arrays = arrays._replace(nodes=np.round(arrays.nodes * 2**20) / 2**20)
    nodes, tets = arrays.nodes[:, :3], arrays.tets
    random = np.random.default_rng(seed)
    tet, side = random.choice(np.flatnonzero(volumes(nodes, tets) < 0.0)), random.integers(0, 4)
    a, b = random.dirichlet((1.0, 1.0, 1.0), 2) @ nodes[[p for k, p in enumerate(tets[tet]) if k != side]]
    d = b - a
    start = a - 0.98 * np.where(d > 0.0, a / d, (a - 1.0) / d).min() * d
    end = b + 3.0 * d / np.linalg.norm(d)
    exact = np.where(end > start, (1.0 - start) / (end - start), -start / (end - start)).min()
    host = int(flow.locate(start[None])[0])
    _, fraction, patch, _ = walk(arrays, host, tuple(map(float, start)), tuple(map(float, end)))
    assert patch == 0
    assert fraction == pytest.approx(exact, abs=1e-14)


@pytest.mark.parametrize("along", [0, 1], ids=["down one wall", "along the other"])
def test_a_path_that_touches_the_rim_of_a_wall_goes_on_inside(along, random):
    """It comes steeply along a wall and leaves where the wall ends: both ways out are at the same place."""
    points, hexes = corners(4, 0.0)
    middle = points[hexes].mean(axis=1)
    flow = at_rest(grid(points, [(12, hexes[~np.all(middle[:, :2] > 0.5, axis=1)])]))
    n = 500
    rim = np.column_stack([np.full(n, 0.5), np.full(n, 0.5), random.uniform(0.1, 0.9, n)])
    for across, up in ((0.1, 0.0), (0.1, 0.04), (0.215, 0.0), (0.215, 0.04)):
        d = np.array([across, -0.3, up])
        d = d if along == 0 else np.array([-d[1], -d[0], d[2]]) * -1.0
        start, end = rim - d, rim + 0.9 * d
        hosts, fractions, patches, _ = walked(flow, flow.locate(start), start, end)
        assert np.all(patches == REACHED)
        assert np.all(fractions == 1.0)
        assert np.all(flow.locate(end) >= 0)
        assert holds(flow, end)[np.arange(n), hosts].all()
