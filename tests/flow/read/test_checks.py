"""Numbers and labels that cannot be those of a mesh."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from foam_writer import Format, header, write_case
from mesh_shapes import boundary, corners, grid

from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read.checks import (
    noted_counts,
    require_labels,
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


def test_counts_are_noted_beside_the_owners(tmp_path):
    mesh = write_case(tmp_path)
    folder = tmp_path / "constant/polyMesh"
    noted = noted_counts(folder)
    assert (noted["nPoints"], noted["nCells"]) == (mesh.n_points, 8)
    assert noted["nFaces"] == len(mesh.owner)
    for name in ("neighbour", "owner", "faces"):
        (folder / name).rename(folder / "away")
        with pytest.raises(InputError, match=f"{name}: no such file"):
            noted_counts(folder)
        (folder / "away").rename(folder / name)


@pytest.mark.parametrize("name", ["owner", "neighbour"])
@pytest.mark.parametrize(("label", "wrong"), [(-1, True), (7, False), (8, True)])
def test_owners_and_neighbours_are_cells(name, label, wrong, tmp_path):
    """By the number that is noted; without a note there are fewer than faces."""
    mesh = write_case(tmp_path)
    folder = tmp_path / "constant/polyMesh"
    path = folder / name
    labels = (mesh.owner if name == "owner" else mesh.neighbour).tolist()
    labels[3] = label
    path.write_text(header("labelList", name) + f"{len(labels)}({' '.join(map(str, labels))})\n")
    if wrong:
        with pytest.raises(
            InputError, match=f"{name}: face 3 belongs to cell {label}, but there are 8 cells"
        ):
            require_labels(folder, {"nCells": 8})
    else:
        require_labels(folder, {"nCells": 8})
    limit = len(mesh.owner)
    if label >= 0:
        require_labels(folder, {})
    labels[3] = limit
    path.write_text(header("labelList", name) + f"{len(labels)}({' '.join(map(str, labels))})\n")
    with pytest.raises(InputError, match=f"face 3 belongs to cell {limit}, but there are {limit} cells"):
        require_labels(folder, {})


def test_faces_name_no_number_beyond_all_points(tmp_path):
    mesh = write_case(tmp_path)
    folder = tmp_path / "constant/polyMesh"
    noted = noted_counts(folder)
    require_labels(folder, noted)
    text = (folder / "faces").read_text()
    digits = len(str(10 * max(len(mesh.owner), mesh.n_points)))
    for number, wrong in (("9" * digits, False), ("9" * (digits + 1), True)):
        (folder / "faces").write_text(text.replace("\n4(", f"\n4({number} ", 1))
        if wrong:
            with pytest.raises(
                InputError, match=rf"line \d+: {number} is neither a point nor a count of points"
            ):
                require_labels(folder, noted)
        else:
            require_labels(folder, noted)
    # Its line is counted from the first, be that empty.
    for empty in (0, 1, 3):
        changed = empty * "\n" + text.replace("\n4(", f"\n4({number} ", 1)
        (folder / "faces").write_text(changed)
        line = next(n for n, words in enumerate(changed.split("\n"), 1) if number in words)
        with pytest.raises(InputError, match=f"faces: line {line}: {number} is neither"):
            require_labels(folder, noted)
    binary = tmp_path / "binary"
    write_case(binary, form=Format(binary=True))
    require_labels(binary / "constant/polyMesh", {"nCells": 8})


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
