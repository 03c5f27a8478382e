"""Numbers and labels that cannot be those of a mesh."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from foam_writer import Format, header, write_case

from foamprb.errors import InputError
from foamprb.flow.read.checks import noted_counts, require_labels, require_numbers, require_volumes

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
                InputError, match=rf"line \d+: {number} is neither a point nor a number of them"
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
