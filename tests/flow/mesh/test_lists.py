"""Lists of lists as two arrays, and the codes by which faces are found again."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.flow.mesh import boundary
from foamprb.flow.mesh.lists import ragged, share, starts, take_lists, together
from foamprb.flow.mesh.mesh import build_mesh


def test_lists_begin_where_those_before_them_end():
    assert starts(np.array([3, 0, 2])).tolist() == [0, 3, 3, 5]
    assert starts(np.array([], dtype=int)).tolist() == [0]
    assert ragged(np.array([5, 9, 2]), np.array([2, 0, 3])).tolist() == [5, 6, 2, 3, 4]
    start, entries = take_lists(np.array([0, 2, 2, 5]), np.array([7, 8, 1, 2, 3]), np.array([2, 1, 0, 2]))
    assert start.tolist() == [0, 3, 3, 5, 8]
    assert entries.tolist() == [1, 2, 3, 7, 8, 1, 2, 3]


@pytest.mark.parametrize("n", [0, 9, 10_000, 25_000])
def test_parts_that_are_computed_at_the_same_time_make_the_whole(n):
    parts = share(n, lambda begin, end: list(range(begin, end)))
    assert [i for part in parts for i in part] == list(range(n))
    assert together(*(partial(divmod, 7, k) for k in (2, 3))) == [(3, 1), (2, 1)]


def codes(*lists, reverse=False):
    start = np.cumsum([0, *map(len, lists)])
    return boundary._turning_codes(start, np.concatenate([*map(np.array, lists), []]).astype(int), reverse)


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
