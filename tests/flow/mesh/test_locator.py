"""The tetrahedron that holds a point."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block

from foamprb.flow.mesh import locator
from foamprb.flow.mesh.arrays import TOLERANCE
from foamprb.flow.mesh.locator import cell_boxes, locate, seek
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
