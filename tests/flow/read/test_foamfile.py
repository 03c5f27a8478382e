"""The lists in OpenFOAM's files, in every form in which they may stand there."""

from __future__ import annotations

import re

import numpy as np
import pytest
from foam_writer import header as written_header

from foamprb.errors import InputError
from foamprb.flow.read.foamfile import (
    COMPONENTS,
    FoamFile,
    header,
    read_cell_zones,
    read_vectors,
)


def file_of(folder, body, kind="labelList", style="ascii", arch="", name="list"):
    """A file with a header of some class, and what follows it."""
    noted = f'arch "{arch}"; ' if arch else ""
    head = f"FoamFile\n{{\nformat {style}; class {kind}; {noted}object {name};\n}}\n"
    path = folder / name
    path.write_bytes(head.encode() + (body if isinstance(body, bytes) else body.encode()))
    return path


@pytest.mark.parametrize(
    ("body", "numbers"),
    [
        ("3(4 5 6)", [4, 5, 6]),
        ("3\n(\n4\n5\n6\n)\n", [4, 5, 6]),
        ("List<label> 3\n(\n4\n5\n6\n)\n", [4, 5, 6]),
        ("// a note\n3 ( 4 /* or 9 */ 5 // and 8\n 6 )", [4, 5, 6]),
        ("3{7}", [7, 7, 7]),
        ("3 { 7 }", [7, 7, 7]),
        ("1(4)", [4]),
        ("0()", []),
        ("0", []),
        ("2(-4 5)", [-4, 5]),
    ],
)
def test_labels(body, numbers, tmp_path):
    found = FoamFile(file_of(tmp_path, body)).labels()
    assert found.tolist() == numbers
    assert found.dtype == np.int64


@pytest.mark.parametrize(
    ("body", "rows"),
    [
        ("2((1 2 3) (4 5 6.5))", [[1, 2, 3], [4, 5, 6.5]]),
        ("2 ( ( 1 2 3 )\n( 4 5 6.5 ) )", [[1, 2, 3], [4, 5, 6.5]]),
        ("2{(1 2 3)}", [[1, 2, 3]] * 2),
        ("1((1e-3 -2 +3))", [[1e-3, -2, 3]]),
        ("0()", np.empty((0, 3))),
    ],
)
def test_vectors(body, rows, tmp_path):
    found = read_vectors(file_of(tmp_path, body, "vectorField"))
    assert found.shape == (len(rows), 3)
    np.testing.assert_array_equal(found, rows)


@pytest.mark.parametrize("order", ["LSB", "MSB"])
@pytest.mark.parametrize("label", [32, 64])
@pytest.mark.parametrize("scalar", [32, 64])
def test_binary_lists_of_every_width_and_order(order, label, scalar, tmp_path):
    sign, arch = "<" if order == "LSB" else ">", f"{order};label={label};scalar={scalar}"
    labels, vectors = np.array([3, -1, 70000]), np.array([[1.5, -2.0, 3.0], [0.25, 0.5, 1e6]])
    packed = labels.astype(f"{sign}i{label // 8}").tobytes()
    path = file_of(tmp_path, b"3(" + packed + b")\n", "labelList", "binary", arch)
    assert FoamFile(path).labels().tolist() == labels.tolist()
    packed = vectors.astype(f"{sign}f{scalar // 8}").tobytes()
    path = file_of(tmp_path, b"2\n(" + packed + b")\n", "vectorField", "binary", arch)
    np.testing.assert_array_equal(read_vectors(path), vectors)
    # One entry for all stands there as text.
    path = file_of(tmp_path, "4 {(1 2 3)}", "vectorField", "binary", arch)
    np.testing.assert_array_equal(read_vectors(path), [[1, 2, 3]] * 4)
    path = file_of(tmp_path, b"3(" + packed[:5] + b")", "labelList", "binary", arch)
    with pytest.raises(InputError, match="a list of 3 entries in binary expected"):
        FoamFile(path).labels()


@pytest.mark.parametrize(
    ("body", "line", "what"),
    [
        ("\n\nx(1 2)", 7, "a number of entries"),
        ("3\n[1 2 3]", 6, r"'\('"),
        ("3\n(1 2 3", 6, r"'\)'"),
        ("3{1", 5, "'}'"),
        ("3\n(1 2 three)", 6, "a list of whole numbers"),
        ("3\n(1 2 3.5)", 6, "a list of whole numbers"),
        ("3\n(1 2)", 6, "a list of 3 entries, not 2,"),
        ("3\n(1 2 3 4)", 6, "a list of 3 entries, not 4,"),
        ("0(1)", 5, r"'\)'"),
        ("99999999999(1)", 5, "a number of entries up to"),
    ],
)
def test_a_broken_list_is_named_with_its_line(body, line, what, tmp_path):
    path = file_of(tmp_path, body)
    with pytest.raises(
        InputError, match=rf"^{path}: line {line}: {what}.* expected; the file is broken or cut"
    ):
        FoamFile(path).labels()


@pytest.mark.parametrize(
    ("body", "what"),
    [("2((1 2 3) (4 5))", "a list of 2 entries, not 1.66667,"), ("1((1 2 x))", "a list of numbers")],
)
def test_a_broken_list_of_vectors(body, what, tmp_path):
    with pytest.raises(InputError, match=re.escape(what)):
        read_vectors(file_of(tmp_path, body, "vectorField"))


def test_faces_one_by_one_and_in_one_list(tmp_path):
    for body, kind in (
        ("3(4(0 1 2 3) 3(4 5 6)\n5(1 2 3 4 5))", "faceList"),
        ("4(0 4 7 12)\n12(0 1 2 3 4 5 6 1 2 3 4 5)", "faceCompactList"),
    ):
        start, points = FoamFile(file_of(tmp_path, body, kind)).faces()
        assert start.tolist() == [0, 4, 7, 12]
        assert points.tolist() == [0, 1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5]
    # As foam-extend writes them in binary.
    packed = b"2\n(\n" + b"".join(
        b"%d\n(%s)\n" % (len(f), np.array(f, dtype="<i4").tobytes()) for f in ([0, 1, 2, 3], [4, 5, 40])
    )
    start, points = FoamFile(file_of(tmp_path, packed + b")", "faceList", "binary")).faces()
    assert start.tolist() == [0, 4, 7]
    assert points.tolist() == [0, 1, 2, 3, 4, 5, 40]


@pytest.mark.parametrize(
    ("body", "kind", "message"),
    [
        ("3(4(0 1 2 3) 3(4 5 6))", "faceList", "a list of 3 faces expected"),
        ("1(4(0 1 2 3) 3(4 5 6))", "faceList", "a list of 1 faces expected"),
        ("1(4(0 1 2))", "faceList", "a list of 1 faces expected"),
        ("1(3(0 1 a))", "faceList", "a list of 1 faces expected"),
        ("3(0 4 7)\n6(0 1 2 3 4 5)", "faceCompactList", "the lengths of the faces do not fit their points"),
        ("3(1 4 6)\n6(0 1 2 3 4 5)", "faceCompactList", "the lengths of the faces do not fit their points"),
        ("3(0 7 6)\n6(0 1 2 3 4 5)", "faceCompactList", "the lengths of the faces do not fit their points"),
        ("0()\n0()", "faceCompactList", "the lengths of the faces do not fit their points"),
    ],
)
def test_broken_faces(body, kind, message, tmp_path):
    with pytest.raises(InputError, match=message):
        FoamFile(file_of(tmp_path, body, kind)).faces()


ZONES = """
3
(
rotor { type cellZone; cellLabels List<label> 3(4 5 6); other (1 { 2 } 3); }
"a b" { cellLabels 0; type cellZone; }
stator { note word; cellLabels List<label> 2{7}; }
)
"""


def test_zones_of_cells(tmp_path):
    zones = read_cell_zones(file_of(tmp_path, ZONES, "regIOobject"))
    assert {name: cells.tolist() for name, cells in zones.items()} == {
        "rotor": [4, 5, 6], "a b": [], "stator": [7, 7],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("3\n(", "4\n("), r"only 3 of 4 zones could be read"),
        (("cellLabels 0;", ""), "zone a b has no cellLabels"),
        (("rotor {", "rotor ["), "'{' expected"),
        (("3(4 5 6);", "3(4 5 6)"), "';' expected"),
    ],
)
def test_broken_zones(change, message, tmp_path):
    with pytest.raises(InputError, match=message):
        read_cell_zones(file_of(tmp_path, ZONES.replace(*change), "regIOobject"))


def test_the_header_of_a_file(tmp_path):
    path = tmp_path / "U"
    path.write_text(
        "/* a banner\nFoamFile { class none; } */\n" + written_header("volVectorField", "U", "n:3")
    )
    assert header(path) == {
        "version": "2.0", "format": "ascii", "class": "volVectorField", "object": "U", "note": "n:3",
    }  # fmt: skip
    path.write_text("no header\n")
    assert header(path) == {}
    with pytest.raises(InputError, match="nothing: no such file"):
        FoamFile(tmp_path / "nothing")


def test_words_and_entries_are_passed(tmp_path):
    file = FoamFile(file_of(tmp_path, "first second (1 (2) {3}) third; last"))
    assert file.word() == b"first"
    file.skip_entry()
    assert file.word() == b"last"
    with pytest.raises(InputError, match="a word expected"):
        file.word()
    assert not file.take(b"x")


def test_numbers_of_the_types_of_openfoam():
    assert COMPONENTS == {
        b"label": 1, b"scalar": 1, b"vector": 3, b"sphericalTensor": 1, b"symmTensor": 6, b"tensor": 9,
    }  # fmt: skip
