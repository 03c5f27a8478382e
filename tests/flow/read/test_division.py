"""A boundary divided at its edges, or by an array, and what is said of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mesh_shapes import block, corners, grid, pipe

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read import division
from foamprb.flow.read.division import divided, patch_names
from foamprb.flow.read.source import Division

FILE = Path("flow.vtu")


@pytest.mark.parametrize(("angle", "count"), [(89.0, 6), (91.0, 1)])
@pytest.mark.parametrize("kind", ["hexahedra", "mixed"])
def test_a_box_has_six_sides_up_to_a_right_angle(angle, count, kind):
    shape = block(2, 0.0, kind)
    mesh, note = divided(shape, shape, Division(feature_angle=angle), FILE)
    assert len(mesh.patches) == count
    assert note == f"The boundary is divided into {patch_names(mesh)}."
    assert [patch.name for patch in mesh.patches] == [f"boundary{k}" for k in range(count)]
    for first, last in zip(mesh.patch_start[:-1], mesh.patch_start[1:], strict=True):
        n = mesh.boundary_areas[first:last] / np.linalg.norm(mesh.boundary_areas[first:last], axis=1)[:, None]
        assert np.allclose(n, n[0]) == (count == 6)


@pytest.mark.parametrize(("angle", "count"), [(20.0, 18), (25.0, 3)])
def test_a_pipe_of_sixteen_sides_is_round_from_their_angle_on(angle, count):
    """Sides turn by 22.5 degrees."""
    shape = pipe(4)
    mesh, _ = divided(shape, shape, Division(feature_angle=angle), FILE)
    assert len(mesh.patches) == count


def test_without_a_division_the_boundary_is_one_wall():
    shape = block(2, 0.2)
    mesh, note = divided(shape, shape, Division(), FILE)
    assert [tuple(patch)[:2] for patch in mesh.patches] == [("boundary", "wall")]
    assert note == "The file names no patches: the whole boundary is one wall, named boundary."
    assert patch_names(mesh) == "boundary (wall, 24 faces)"


def test_cells_that_meet_in_an_edge_alone_are_noted():
    """Two cubes that touch along an edge, where four boundary faces meet."""
    points, hexes = corners(2, 0.0)
    middle = points[hexes].mean(axis=1)
    chosen = hexes[(middle[:, 2] < 0.5) & ((middle[:, 0] < 0.5) == (middle[:, 1] < 0.5))]
    shape = grid(points, [(12, chosen)])
    _, note = divided(shape, shape, Division(), FILE)
    assert note.endswith("At 1 edges more than two boundary faces meet: the domain touches itself there, or "
                         "cells name points that are not theirs.")  # fmt: skip
    edges, face = division._boundary_edges(build_mesh(shape))
    assert len(edges) == len(face) == 48
    assert np.bincount(face).tolist() == [4] * 12
    assert sorted(np.unique(edges, return_counts=True)[1].tolist()) == [2] * 22 + [4]


def test_too_many_patches_are_refused(monkeypatch):
    shape = block(2, 0.0)
    for most, refused in ((6, False), (5, True)):
        monkeypatch.setattr(division, "_MOST_PATCHES", most)
        if refused:
            with pytest.raises(InputError, match=r"the boundary falls into 6 patches; at most 5\."):
                divided(shape, shape, Division(feature_angle=30.0), FILE)
        else:
            divided(shape, shape, Division(feature_angle=30.0), FILE)


def by_array(values, kinds=(12, 9), names=None):
    points, hexes = corners(1, 0.0)
    parts = {12: hexes, 9: np.concatenate([hexes[:, :4], hexes[:, 4:]])}
    whole = grid(points, [(kind, parts[kind]) for kind in kinds])
    whole.cell_data["part"] = np.asarray(values)
    for name, value in (names or {}).items():
        whole.field_data[name] = np.array(value)
    return divided(grid(points, [(12, hexes)]), whole, Division(array="part"), FILE)[0]


def test_values_on_surface_cells_name_the_patches():
    """By the groups of two dimensions; what has no value or no name is the boundary."""
    names = {"low": [4, 2], "solid": [7, 3], "high": [9, 3], "other": [1, 2, 3]}
    mesh = by_array([7, 4, 9], names=names)
    found = {patch.name: k for k, patch in enumerate(mesh.patches)}
    assert set(found) == {"boundary", "low", "boundary9"}
    for name, z in (("low", 0.0), ("boundary9", 1.0)):
        own = slice(*mesh.patch_start[found[name] :][:2])
        assert mesh.boundary_centres[own][:, 2].tolist() == [z]
    assert np.diff(mesh.patch_start)[found["boundary"]] == 4
    assert all(patch.type == "wall" for patch in mesh.patches)


@pytest.mark.parametrize("values", [[0.5, 1.0, 2.0], [[1, 2], [3, 4], [5, 6]]])
def test_an_array_of_other_than_whole_numbers_is_refused(values):
    with pytest.raises(InputError, match="cell array part is not an array of integers, one for each cell"):
        by_array(values)


def test_an_array_needs_surface_cells():
    with pytest.raises(InputError, match="no surface cells among the cells, for part to name patches on"):
        by_array([1], kinds=(12,))
