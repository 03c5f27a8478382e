"""Numbers and labels that cannot be those of a mesh."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from mesh_shapes import block, boundary, box_patches, corners, grid

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read.checks import (
    caveat_of_order,
    require_numbers,
    require_patch_shapes,
    require_volumes,
)

SOURCE = Path("file")


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1.1e30, -1.1e30])
@pytest.mark.parametrize("column", [0, 1, 2])
def test_rows_of_numbers_are_finite_and_below_any_length(bad, column):
    values = np.arange(12.0).reshape(4, 3)
    values[1, column] = 1e30
    require_numbers(values, SOURCE, "point")
    values[2:, column] = bad
    first = " ".join(f"{x:g}" for x in values[2])
    with pytest.raises(InputError) as caught:
        require_numbers(values, SOURCE, "point", "at cell")
    assert str(caught.value) == (
        f"file: 2 of 4 points are not finite numbers below 1e+30; the first is ({first}) at cell 2."
    )


def test_velocities_in_another_order_are_told():
    """Of a parabola between two plates; a uniform flow with noise has no order."""
    cube = block(6, 0.0)
    mesh = build_mesh(cube, box_patches(cube))
    u = np.zeros((mesh.n_cells, 3))
    u[:, 0] = mesh.centres[:, 1] * (1.0 - mesh.centres[:, 1])
    assert caveat_of_order(mesh, u) == []
    (found,) = caveat_of_order(mesh, np.random.default_rng(1).permutation(u))
    assert "velocities of neighbouring cells differ by 0." in found
    noise = 1.0 + 1e-3 * np.random.default_rng(1).normal(size=u.shape)
    assert caveat_of_order(mesh, noise) == []


@pytest.mark.parametrize("volume", [0.0, -1.0, np.nan])
def test_cells_have_a_volume(volume):
    mesh = SimpleNamespace(
        volumes=np.array([1.0, volume, volume]), n_cells=3, centres=np.arange(9.0).reshape(3, 3)
    )
    with pytest.raises(
        InputError, match=r"2 of 3 cells have no positive volume; the first is cell 1 at \(3 4 5"
    ):
        require_volumes(mesh, SOURCE)
    mesh.volumes[:] = 1e-300
    require_volumes(mesh, SOURCE)


def plate(layers, bend=0.0, lean=0.0, types=("empty", "empty", "wall"), scale=1.0, away=0.0):
    """Layers of cells along z, bent or leaning; coordinates have passed through single precision."""
    points, hexes = corners(4, 0.0)
    shape = grid(points[: 25 * (layers + 1)], [(12, hexes[: 16 * layers])])
    top = 0.25 * layers

    def name(centre):
        return "floor" if centre[2] < 1e-9 else "lid" if centre[2] > top - 1e-9 else "sides"

    surfaces = boundary(shape, name, dict(zip(("floor", "lid", "sides"), types, strict=True)))

    def moved(x):
        z = x[:, 2] + bend * np.sin(np.pi * x[:, 0]) + lean * x[:, 0]
        return np.float32(scale * np.column_stack([x[:, 0], x[:, 1], z]) + away).astype(np.float64)

    for part in (shape, *(patch.surface for patch in surfaces)):
        part.points = moved(np.array(part.points))
    return build_mesh(shape, surfaces)


@pytest.mark.parametrize("bend", [1e-3, 0.1])
@pytest.mark.parametrize("kind", ["symmetryPlane", "wedge"])
def test_a_curved_plane_is_refused(kind, bend, tmp_path):
    with pytest.raises(InputError, match=f"patch floor is of type {kind}, but not planar: its faces"):
        require_patch_shapes(plate(3, bend, types=(kind, "wall", "wall")), tmp_path)
    require_patch_shapes(plate(3, bend, types=("symmetry", "wall", "wall")), tmp_path)


@pytest.mark.parametrize(("scale", "away"), [(1.0, 0.0), (1e-3, 0.0), (1e-3, 1.0), (1.0, 100.0)])
def test_a_plane_is_one_whatever_its_place_and_size(scale, away, tmp_path):
    """Coordinates carry the round-off of single precision."""
    types = ("symmetryPlane", "symmetryPlane", "wall")
    require_patch_shapes(plate(3, lean=0.3, types=types, scale=scale, away=away), tmp_path)
    require_patch_shapes(plate(1, scale=scale, away=away), tmp_path)
    with pytest.raises(InputError, match="not planar"):
        require_patch_shapes(plate(3, 0.1, 0.3, types, scale, away), tmp_path)


def test_empty_patches_of_several_layers_are_refused(tmp_path):
    require_patch_shapes(plate(1), tmp_path)
    with pytest.raises(InputError, match=r"empty patch floor and lid: cell 0 has 1 faces on it along z"):
        require_patch_shapes(plate(2), tmp_path)


@pytest.mark.parametrize(("bend", "lean"), [(0.01, 0.0), (0.0, 0.01)])
def test_empty_patches_across_no_coordinate_are_refused(bend, lean, tmp_path):
    with pytest.raises(InputError, match=r"patch floor and lid: \d+ of 32 faces do not look along x, y"):
        require_patch_shapes(plate(1, bend, lean), tmp_path)


@pytest.mark.parametrize(("lift", "refused"), [(0.0, False), (1e-7, False), (1e-5, True)])
def test_however_exact_its_coordinates_a_plane_may_turn_by_a_millionth(lift, refused, tmp_path, monkeypatch):
    monkeypatch.setattr("foamprb.flow.read.checks._SINGLE", 0.0)
    mesh = plate(3, types=("symmetryPlane", "wall", "wall"))
    mesh.boundary_areas[2, 0] += lift * np.linalg.norm(mesh.boundary_areas[2])
    if refused:
        with pytest.raises(InputError, match="patch floor is of type symmetryPlane, but not planar"):
            require_patch_shapes(mesh, tmp_path)
    else:
        require_patch_shapes(mesh, tmp_path)
