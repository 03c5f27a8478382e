"""What processor folders say of their parts, and what they make together."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from foam_writer import decompose, header, write_case

from foamprb.errors import InputError
from foamprb.flow.mesh.boundary import Transform
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.case import mesh_files
from foamprb.flow.read.field import VELOCITY_FIELD, PatchField, read_field
from foamprb.flow.read.processors import (
    Processors,
    checked,
    found_addresses,
    join_meshes,
    join_zones,
    read_addresses,
    read_pieces,
    whole_patches,
)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    case = tmp_path_factory.mktemp("parts") / "case"
    mesh = write_case(case, "mixed")
    decompose(case, mesh, np.random.default_rng(5).integers(0, 3, mesh.n_cells), ("0", "0.5", "1e1"))
    return case


@pytest.fixture
def case(written, tmp_path):
    shutil.copytree(written, tmp_path / "case")
    return tmp_path / "case"


def test_folders_in_the_order_of_their_numbers(tmp_path):
    with pytest.raises(InputError, match="no processor folders"):
        Processors(tmp_path)
    for number in range(12):
        (tmp_path / f"processor{number}").mkdir()
    (tmp_path / "processorx").mkdir()
    assert [path.name for path in Processors(tmp_path).folders] == [f"processor{k}" for k in range(12)]
    (tmp_path / "processor3").rmdir()
    with pytest.raises(InputError, match="processor3: no such folder, but there is processor11"):
        Processors(tmp_path)


def pieces_of(case):
    folders = Processors(case)
    return read_pieces(folders, mesh_files(folders.folders[0], None, ""), case)


def parts_of(case):
    folder = case / "processor0/constant/polyMesh"
    return read_addresses(Processors(case), folder, pieces_of(case))


def change(path, pattern, text):
    old = path.read_text()
    new = re.sub(pattern, text, old, count=1)
    assert new != old
    path.write_text(new)


@pytest.mark.parametrize(
    ("name", "pattern", "text", "message"),
    [
        ("faceProcAddressing", r"\n(-?\d+)\n\)", r"\n)", "a list of"),
        ("faceProcAddressing", r"\(\n-?\d+", "(\n0", "there is no face 0"),
        ("neighbour", r"\(\n\d+", "(\n-2", "neighbour: an index outside 0 to"),
        ("faces", r"\n(\d)\(\d+", r"\n\1(777", "faces: an index outside 0 to"),
    ],
)
def test_a_part_that_does_not_fit_is_named(name, pattern, text, message, case):
    change(case / "processor1/constant/polyMesh" / name, pattern, text)
    with pytest.raises(InputError, match=f"{name}: .*{message}|{name}: {message}|{message}"):
        parts_of(case)


@pytest.mark.parametrize("name", ["pointProcAddressing", "faceProcAddressing", "boundaryProcAddressing"])
def test_lists_of_another_length_are_refused(name, case):
    path = case / "processor1/constant/polyMesh" / name
    path.write_text(header("labelList", name) + "2 ( 1 2 )\n")
    with pytest.raises(InputError, match=rf"{name}: 2 entries, but the other files say \d+\."):
        parts_of(case)


def test_each_part_says_where_its_pieces_are(written):
    parts = parts_of(written)
    cells = np.concatenate([part.cells for part in parts])
    assert sorted(cells.tolist()) == list(range(len(cells)))
    signed = {}
    for part in parts:
        assert len(part.turned) == len(part.faces)
        for face, turned in zip(part.faces.tolist(), part.turned.tolist(), strict=True):
            signed.setdefault(face, []).append(turned)
    assert min(signed) == 0
    # A face between two parts turns on one side.
    assert all(sorted(sides) in ([False], [False, True]) for sides in signed.values())
    assert any(len(sides) == 2 for sides in signed.values())


def patch(name, faces, start=0, **entries):
    return PatchInfo(name, entries.pop("type", "wall"), faces, start, "", Transform(), entries)


def parts_with(part, *lists):
    return [
        part._replace(patches=tuple(p for p, _ in own), of_patches=np.array([at for _, at in own]))
        for own in lists
    ]


def test_patches_of_the_whole_are_those_of_the_parts_together(written):
    part = parts_of(written)[1]
    parts = parts_with(
        part,
        [(patch("a", 3), 0), (patch("b", 0), 1), (patch("p", 9, type="processor"), -1)],
        [(patch("a", 2), 0), (patch("b", 4), 1), (patch("q", 5, type="processor", referPatch="b"), -1),
         (patch("r", 7, type="processor", referPatch="nothing"), -1)],
    )  # fmt: skip
    patches, ranges = whole_patches(written, parts)
    assert [(p.name, p.faces) for p in patches] == [("a", 5), ("b", 9)]
    assert ranges.tolist() == [0, 5, 14]
    with pytest.raises(InputError, match="the processor folders do not name all patches of the mesh"):
        whole_patches(written, parts_with(part, [(patch("a", 3), 0), (patch("c", 4), 2)]))


def test_zones_of_parts_are_one_zone_in_the_order_of_the_cells(case, tmp_path):
    parts, folder = parts_of(case), case / "processor0/constant/polyMesh"
    assert join_zones(Processors(case), folder, parts) == {}
    for k, zones in enumerate(({"a": [1, 0], "b": []}, {}, {"a": [0], "c": [1]})):
        text = "".join(f"{n} {{ type cellZone; cellLabels List<label> {len(c)}({' '.join(map(str, c))}); }}\n"
                       for n, c in zones.items())  # fmt: skip
        text = header("regIOobject", "cellZones") + f"{len(zones)}\n(\n{text})\n"
        (case / f"processor{k}/constant/polyMesh/cellZones").write_text(text)
    found = join_zones(Processors(case), folder, parts)
    expected = np.sort([parts[0].cells[1], parts[0].cells[0], parts[2].cells[0]])
    assert {name: cells.tolist() for name, cells in found.items()} == {
        "a": expected.tolist(), "b": [], "c": [parts[2].cells[1]],
    }  # fmt: skip
    change(folder / "cellZones", r"2\(1 0\)", "2(1 99)")
    with pytest.raises(InputError, match=r"processor0.*cellZones: zone a names a cell that is not there"):
        join_zones(Processors(case), folder, parts)


def test_the_field_of_a_part_must_fit_it(written):
    part = parts_of(written)[1]
    field = read_field(written / "processor1/0/U", VELOCITY_FIELD, written)
    assert checked(field, part) is field
    n = len(part.cells)
    with pytest.raises(InputError, match=f"U: {n - 1} cells, but the mesh there has {n}"):
        checked(field._replace(cells=field.cells[1:]), part)
    uniform = field._replace(cells=field.cells[:1])
    assert checked(uniform, part) is uniform
    first = next(p for p, at in zip(part.patches, part.of_patches, strict=True) if at >= 0 and p.faces > 2)
    entry = PatchField("fixedValue", False, {"value": np.zeros((2, 3))}, {"type": "fixedValue"})
    with pytest.raises(
        InputError, match=f"2 values of value on patch {first.name}, which has {first.faces} f"
    ):
        checked(field._replace(patches={**field.patches, first.name: entry}), part)
    lacking = {name: entry for name, entry in field.patches.items() if name != first.name}
    with pytest.raises(InputError, match=f"no boundaryField for the patch {first.name}"):
        checked(field._replace(patches=lacking), part)


@pytest.mark.parametrize(
    ("pattern", "text", "message"),
    [
        (r"neighbProcNo 1", "neighbProcNo 7", "patch procBoundary0to1 has .* of processor 7 to it has 0"),
        (r"(?s)procBoundary0to1 \{ type processor", "procBoundary0to1 { type patch", "procBoundary1to0 has"),
    ],
)
def test_processor_patches_without_counterpart_are_named(pattern, text, message, case):
    change(case / "processor0/constant/polyMesh/boundary", pattern, text)
    with pytest.raises(InputError, match=message):
        found_addresses(pieces_of(case))


def test_points_of_processor_patches_must_coincide(case):
    """Moved by a quarter, the first point of a part lies apart from the same point of another."""
    pieces = pieces_of(case)
    parts = found_addresses(pieces)
    patches, ranges = whole_patches(case, parts)
    assert join_meshes(case, pieces, parts, patches, ranges).faces.owner.max() == 11
    pieces[1] = pieces[1]._replace(points=pieces[1].points + 0.25)
    with pytest.raises(InputError, match="do not make a whole mesh"):
        join_meshes(case, pieces, parts, patches, ranges)
