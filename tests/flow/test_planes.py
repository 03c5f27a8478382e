"""The walls near a point, as planes: how far, and which way."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.planes import walls

CUT = 0.3


@pytest.fixture(scope="module")
def flow():
    shape = block(4, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def test_all_walls_of_a_box_within_the_cut_are_seen_where_they_are(flow):
    """Over the middle of triangles and over their edges, near faces, edges and corners of a unit cube."""
    arrays = flow.arrays(1.0, (), CUT, range(len(flow.patches)))
    chosen = np.ones(len(flow.patches), dtype=np.int8)
    x = np.random.default_rng(5).uniform(0.02, 0.98, (150, 3))
    for place, host in zip(x, flow.locate(x), strict=True):
        planes = walls(arrays, int(host), tuple(place), CUT, chosen)
        found = {}
        for h, n in ((planes.h1, planes.n1), (planes.h2, planes.n2), (planes.h3, planes.n3)):
            if h < math.inf:
                found[tuple(np.round(n).astype(int).tolist())] = h
                assert np.abs(np.array(n) - np.round(n)).max() < 1e-12
        expected = {}
        for axis in range(3):
            for sign, distance in ((1, place[axis]), (-1, 1.0 - place[axis])):
                if distance < CUT:
                    expected[tuple(sign * int(k == axis) for k in range(3))] = distance
        assert found == pytest.approx(expected, abs=1e-12)
