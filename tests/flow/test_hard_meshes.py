"""Walks through meshes that no mesher should make; `tools/hardening/walks` takes a hundred times as many."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from hard_meshes import FLUSH, HARD, N, cut, flow_in, from_hosts, seen, shaken, try_walks
from mesh_shapes import block, grid
from walking import walked

from foamprb.errors import InputError
from foamprb.flow.mesh.folds import FLAT, FOLDED, SOUND
from foamprb.flow.walk import REACHED, is_sound, sample_ahead, walk


def some(kind):
    """The first two seeds of which the mesh is not refused, with their flows."""
    found = []
    for seed in range(20):
        with suppress(InputError):
            found.append((seed, flow_in(HARD[kind](seed))))
        if len(found) == 2:
            break
    return found


@pytest.mark.parametrize("kind", HARD)
def test_every_walk_goes_as_far_as_the_straight_line_in_the_boundary(kind):
    for seed, _ in some(kind):
        counts = try_walks(HARD[kind](seed), 400, 104, seed)
        assert counts.walks > 41_000
        assert min(counts.reached, counts.left) > 0.2 * counts.walks
        assert counts.wrong == 0, counts
        assert counts.worst < FLUSH


def test_the_meshes_are_hard():
    """Most kinds have tetrahedra turned inside out, or without volume."""
    worst = {kind: max(flow.arrays().folds.max() for _, flow in some(kind)) for kind in HARD}
    assert sum(state == FOLDED for state in worst.values()) >= 6
    assert sum(state == FLAT for state in worst.values()) >= 2


def test_a_sound_mesh_has_neither_folds_nor_lists_of_its_boundary():
    arrays = flow_in(block(4, 0.3)).arrays()
    assert (arrays.folds == SOUND).all()
    assert len(arrays.rim) == arrays.rim_start[-1] == 0


def test_a_tetrahedron_of_coincident_points_holds_nothing(random):
    """Of a cell of which four edges have no length; a particle that was in it goes on as elsewhere."""
    points, hexes = shaken(0.0)
    s = N + 1
    middle = 2 * s * s + 2 * s + 2
    points[middle] = points[middle + 1] = points[middle + s] = points[middle + 1 + s]
    flow = flow_in(grid(points, [(12, hexes)]))
    nodes, tets = flow.mesh.nodes[:, :3], flow.mesh.tets
    a, b, c, d = (nodes[tets[:, k]] for k in range(4))
    empty = np.flatnonzero(np.einsum("ti,ti->t", b - a, np.cross(c - a, d - a)) == 0.0)
    assert len(empty) > 0
    for tet in empty:
        x0 = nodes[tets[tet]].mean(axis=0)
        x1 = random.random(3)
        host, fraction, patch, _ = walk(flow.arrays(), int(tet), tuple(map(float, x0)), tuple(map(float, x1)))
        assert (fraction, patch) == (1.0, REACHED)
        assert from_hosts(flow, np.array([host]), x1[None]) < FLUSH
        _, _, patch, _ = walk(flow.arrays(), int(tet), tuple(map(float, x0)), (5.0, 0.1, 0.2))
        assert patch >= 0


def test_there_is_no_room_in_what_is_folded():
    """A place near another may lie in several tetrahedra there, and a path to it end in any of them."""
    _, flow = some("folded")[0]
    arrays, nodes, tets = flow.arrays(), flow.mesh.nodes[:, :3], flow.mesh.tets
    a, b, c, d = (nodes[tets[:, k]] for k in range(4))
    volume = np.einsum("ti,ti->t", b - a, np.cross(c - a, d - a))
    sound = np.array([is_sound(arrays, tet) for tet in range(len(tets))])
    for state in (True, False):
        chosen = np.flatnonzero((sound == state) & (volume > 1e-6 * volume.max()))[:20]
        assert len(chosen) == 20
        for tet in chosen:
            x = tuple(map(float, nodes[tets[tet]].mean(axis=0)))
            last, room, *_ = sample_ahead(arrays, int(tet), x, x, 0.0)
            assert sound[last] == state
            assert (room > 0.0) == state


@pytest.mark.parametrize("kind", [0, 1], ids=["hexahedra", "tetrahedra"])
def test_what_leaves_through_a_pile_of_flat_cells_has_its_host_behind_all_of_them(kind, random):
    """Three layers lie flat on the boundary: a cell there may have none with a volume within two steps."""
    points, hexes = shaken(0.0)
    layer = (N + 1) ** 2
    for k in (2, 3, 4):
        points[k * layer : (k + 1) * layer] = points[layer : 2 * layer]
    flow = flow_in(cut(points, hexes, kind))
    arrays, top = flow.arrays(), float(points[layer, 2])
    for x, y in random.uniform(0.05, 0.95, (20, 2)).tolist():
        inside, rim, outside = (x, y, 0.5 * top), (x, y, top), (x, y, 1.5 * top)
        host, fraction, patch, _ = walk(arrays, int(flow.locate(np.array([inside]))[0]), inside, outside)
        assert patch >= 0
        assert fraction == pytest.approx(0.5, abs=1e-12)
        assert from_hosts(flow, np.array([host]), np.array([rim])) < FLUSH


@pytest.mark.parametrize(
    ("seed", "start", "goal"),
    [
        (582, (0.125, 0.4375, 0.5), (0.6875, 0.625, 0.3125)),
        (513, (0.25, 0.6875, 0.3125), (0.12499999999999997, 0.25, 0.625)),
    ],
    ids=["met beyond the goal", "a product rounded to a tie"],
)
def test_a_line_in_the_planes_of_faces_ends_in_the_tetrahedron_that_holds_its_goal(seed, start, goal):
    """With the fused products of a processor such a line met a face too far on, or was lost at another."""
    flow = flow_in(HARD["slivers"](seed))
    x0, x1 = np.array([start]), np.array([goal])
    hosts, _, patches, _ = walked(flow, flow.locate(x0).astype(np.int32), x0, x1)
    assert patches[0] == REACHED
    assert from_hosts(flow, hosts, x1) < FLUSH


def test_the_tree_finds_no_place_outside_in_a_fold(random):
    """There a tetrahedron of positive volume and one turned inside out lie on each other."""
    flow = flow_in(HARD["aspect 1e4"](2))
    points = flow.mesh.points
    extent = np.ptp(points, axis=0)
    x = points.min(axis=0) + extent * random.uniform(-0.05, 1.05, (20_000, 3))
    inside, distance = seen(np.ascontiguousarray(points[flow.mesh.triangles] / extent), x / extent)
    assert np.array_equal((flow.locate(x) >= 0)[distance > FLUSH], inside[distance > FLUSH])
