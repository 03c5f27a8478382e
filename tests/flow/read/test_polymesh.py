"""Numbers of cells in OpenFOAM's meshes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mesh_shapes import block

from foamprb.flow.mesh.boundary import Transform
from foamprb.flow.mesh.geometry import faces_of
from foamprb.flow.mesh.mesh import assemble, build_mesh
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.polymesh import checked_poly, count_cells


@pytest.mark.parametrize(
    ("owner", "neighbour", "n"),
    [([0, 0, 1], [1, 2], 3), ([0, 0, 1], [1, 3], 2), ([0, 2], [1], 3), ([], [], 0), ([0, 1], [3, 2, 5], 4)],
)
def test_cells_that_own_no_face_count_if_none_is_left_out(owner, neighbour, n):
    assert count_cells(np.array(owner, dtype=np.int32), np.array(neighbour, dtype=np.int32)) == n


def test_the_last_cell_may_lie_inside():
    mesh = build_mesh(block(3))
    number = np.arange(27, dtype=np.int32)
    number[[13, 26]] = 26, 13
    sides = number[mesh.owner], number[mesh.neighbour]
    faces = faces_of(mesh.face_start, mesh.face_points.copy(), *sides, 27)
    assert faces.owner.max() == 25
    boundary = len(faces.owner) - len(faces.neighbour)
    patches = [PatchInfo("wall", "wall", boundary, len(faces.neighbour), "", Transform(), {})]
    lists = faces.start, faces.points, faces.owner, faces.neighbour
    poly = checked_poly([Path("points")] * 5, mesh.points, *lists, patches)
    np.testing.assert_allclose(assemble(poly, "mesh").volumes[number], mesh.volumes, rtol=1e-13)
