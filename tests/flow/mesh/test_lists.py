"""Lists of lists as two arrays, and the codes by which faces are found again."""

from __future__ import annotations

import numpy as np
import pytest
import pyvista
from mesh_shapes import block, box_patches

from foamprb.flow.mesh import boundary
from foamprb.flow.mesh.lists import cell_array, int32, ragged, starts, take_lists
from foamprb.flow.mesh.mesh import build_mesh


def test_lists_begin_where_those_before_them_end():
    assert starts(np.array([3, 0, 2])).tolist() == [0, 3, 3, 5]
    assert starts(np.array([], dtype=int)).tolist() == [0]
    assert ragged(np.array([5, 9, 2]), np.array([2, 0, 3])).tolist() == [5, 6, 2, 3, 4]
    start, entries = take_lists(np.array([0, 2, 2, 5]), np.array([7, 8, 1, 2, 3]), np.array([2, 1, 0, 2]))
    assert start.tolist() == [0, 3, 3, 5, 8]
    assert entries.tolist() == [1, 2, 3, 7, 8, 1, 2, 3]


def test_lists_of_vtk():
    for nothing in (None, pyvista.PolyData().GetPolys()):
        start, points = cell_array(nothing)
        assert start.tolist() == [0]
        assert len(points) == 0
    start, points = cell_array(pyvista.PolyData(np.zeros((5, 3)), [3, 4, 2, 0, 4, 0, 1, 2, 3]).GetPolys())
    assert start.tolist() == [0, 3, 7]
    assert points.tolist() == [4, 2, 0, 0, 1, 2, 3]
    found = int32(np.arange(6, dtype=np.int64)[::2])
    assert found.tolist() == [0, 2, 4]
    assert found.dtype == np.int32
    assert found.flags.c_contiguous


def codes(*lists, reverse=False):
    start = np.cumsum([0, *map(len, lists)])
    return boundary._turning_codes(start, np.concatenate([*map(np.array, lists), []]).astype(int), reverse)


def test_a_code_of_a_face_knows_its_turn_but_not_its_beginning():
    one, shifted, other, back = codes([4, 7, 9, 2], [9, 2, 4, 7], [4, 9, 7, 2], [2, 9, 7, 4])
    assert one == shifted
    assert len({one, other, back}) == 3
    assert codes([4, 7, 9, 2], reverse=True)[0] == back
    assert codes([2, 9, 7, 4], reverse=True)[0] == one
    # Of two faces beside each other neither knows the other.
    assert codes([4, 7, 9], [4, 7, 9, 2], [1, 2, 3]).tolist() == [*codes([4, 7, 9]), one, *codes([1, 2, 3])]
    assert len(codes()) == 0


def test_mixed_numbers_are_all_different():
    """The finalizer of splitmix64, whose first values are known."""
    assert len(np.unique(boundary.mix(np.arange(100_000)))) == 100_000
    assert boundary.mix(np.array([0, 1, 2])).tolist() == [
        0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F,
    ]  # fmt: skip


def test_codes_are_found_where_they_are(random):
    known = random.permutation(np.arange(10, 60, 5)).astype(np.uint64)
    order = np.argsort(known, kind="stable")
    wanted = np.array([15, 9, 55, 60, 12, 10], dtype=np.uint64)
    found = boundary._find(known, order, wanted)
    for code, at in zip(wanted, found, strict=True):
        assert at == (int(np.flatnonzero(known == code)[0]) if code in known else -1)
    assert boundary._find(known[:0], order[:0], wanted).tolist() == [-1] * 6


def test_boundary_faces_stand_patch_by_patch_as_their_files_have_them():
    """With their owners, and each where its cell names it."""
    shape = block(2, 0.2, "mixed")
    patches = box_patches(shape)
    mesh = build_mesh(shape, patches)
    face = mesh.n_internal
    for patch in patches:
        for cell in range(patch.surface.n_cells):
            corners = np.asarray(patch.surface.get_cell(cell).points)
            own = mesh.points[mesh.face_points[slice(*mesh.face_start[face : face + 2])]]
            assert {tuple(x) for x in own.tolist()} == {tuple(x) for x in corners.tolist()}
            inside = mesh.centres[mesh.owner[face]]
            n = mesh.boundary_areas[face - mesh.n_internal]
            assert (own.mean(axis=0) - inside) @ n > 0.0
            points = set(mesh.face_points[slice(*mesh.face_start[face : face + 2])].tolist())
            held = mesh.cell_points[slice(*mesh.cell_point_start[mesh.owner[face] :][:2])]
            assert points <= set(held.tolist())
            face += 1
    assert face == len(mesh.owner)


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_a_point_is_known_by_its_coordinates(zero):
    """Of which −0 is 0."""
    shape = block(2, 0.0)
    patches = box_patches(shape)
    patches[0].surface.points = np.where(np.asarray(patches[0].surface.points) == 0.0, zero,
                                         np.asarray(patches[0].surface.points))  # fmt: skip
    assert build_mesh(shape, patches).patch_start.tolist() == [0, 4, 8, 24]
