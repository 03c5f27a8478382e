"""Files of positions."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.dictionary.constraints import NonNegative, Positive
from foamprb.dictionary.positions import read_positions
from foamprb.errors import InputError

finite = st.floats(allow_nan=False, allow_infinity=False)


@given(
    st.lists(st.tuples(finite, finite, finite)),
    st.booleans(),
    st.sampled_from(["", "// (1 2 3)\n", "/*\n*/ "]),
)
def test_written_positions_are_read_back(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float, float, float]],
    counted: bool,
    comment: str,
) -> None:
    path = tmp_path_factory.getbasetemp() / "positions"
    body = "\n".join(f"({x!r} {y!r}\t{z!r} ) {comment}" for x, y, z in rows)
    path.write_text(
        f"FoamFile {{ class vectorField; }}\n{comment}{len(rows) if counted else ''}\n(\n{body})\n{comment}"
    )
    positions, columns = read_positions(path)
    assert columns == {}
    assert positions.shape == (len(rows), 3)
    assert positions.dtype == np.float64
    np.testing.assert_array_equal(positions, np.array(rows, dtype=float).reshape(-1, 3))


def test_a_line_that_only_resembles_a_comment_may_follow_the_list(tmp_path: Path) -> None:
    """As in OpenFOAM's MPPICFoam/column."""
    path = tmp_path / "positions"
    path.write_text("(\n(-0.1 0 0.2)\n)\n\n/ ****************** //\n")
    assert read_positions(path).x.tolist() == [[-0.1, 0.0, 0.2]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("(\n(0 0 0)\n(0 0)\n)", r"line 3: found '\(0 0\)'\. Expected: \(x y z\), three numbers"),
        ("(\n(0 0 nan)\n)", r"line 2: found '\(0 0 nan\)'"),
        (
            "(\n(0 0 0)\n(0 1e400 0)\n)",
            r"line 3: found '\(0 1e400 0\)'\. Expected: \(x y z\), three finite numbers",
        ),
        ("(\n(0 0 0)\n", "line 3: found 'the end of the file'"),
        ("((0 0 0))\n(1 1 1)", "line 2: found .*Expected: nothing after the list"),
        ("\n3 ((0 0 0) (1 1 1))", r"line 2: .*The list holds 2 positions\."),
        ("(0 0 0)", "line 1: found '0 0 0"),
        ("", "line 1: found 'the end of the file'. Expected: a list"),
        ("FoamFile { }\nuniform (0 0 0);", "line 2: found 'uniform"),
    ],
)
def test_positions_mistakes(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "positions").write_text(text)
    with pytest.raises(InputError, match=f"^{re.escape(str(tmp_path))}/positions, {message}"):
        read_positions(tmp_path / "positions")


def test_positions_file_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none: No such file or directory"):
        read_positions(tmp_path / "none")


@pytest.mark.parametrize(
    "text", ["(" + "(0 1 2)\n" * 100_000 + "(0 1\n)", "0 1 2\n" * 100_000 + "0 1\n"], ids=["list", "table"]
)
def test_a_broken_row_late_in_a_long_file_is_found_at_once(tmp_path: Path, text: str) -> None:
    (tmp_path / "positions").write_text(text)
    with pytest.raises(InputError, match="line 100001: found"):
        read_positions(tmp_path / "positions")


# Tables

COLUMNS = {"d": Positive, "rho": Positive, "Ca": Positive, "viscosity": NonNegative}
positive = st.floats(1e-300, 1e300)


@given(
    st.lists(st.tuples(finite, finite, finite)),
    st.sampled_from([" ", "\t", ",", ", ", " ; ", "  \t "]),
    st.sampled_from(["\n", "\r\n", "\n\n", " \n  ", "  # (1 2 3)\n", "\n// 4 5 6\n"]),
    st.sampled_from(["", "x{0}y{0}z", "# x{0}y{0}z", '"Points:0"{0}"Points:1"{0}"Points:2"']),
)
def test_lines_of_numbers_are_read_back(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float, float, float]],
    separator: str,
    end: str,
    header: str,
) -> None:
    path = tmp_path_factory.getbasetemp() / "positions.csv"
    lines = [header.format(separator)] * bool(header)
    lines += [separator.join(map(repr, row)) for row in rows]
    path.write_bytes("".join(line + end for line in lines).encode())
    if not lines:
        with pytest.raises(InputError, match="Expected: a list"):
            read_positions(path)
        return
    positions, columns = read_positions(path)
    assert columns == {}
    assert positions.shape == (len(rows), 3)
    np.testing.assert_array_equal(positions, np.array(rows, dtype=float).reshape(-1, 3))


@given(
    st.lists(st.tuples(finite, finite, finite, positive, positive, st.floats(0.0, 1e300)), min_size=1),
    st.permutations(["x", "y", "z", "d", "rho", "viscosity"]),
    st.sampled_from([",", "\t"]),
)
def test_columns_are_known_by_their_names(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[float, ...]],
    names: list[str],
    separator: str,
) -> None:
    path = tmp_path_factory.getbasetemp() / "columns.csv"
    values = dict(zip(["x", "y", "z", "d", "rho", "viscosity"], np.transpose(rows), strict=True))
    lines = [names, *([repr(float(values[name][k])) for name in names] for k in range(len(rows)))]
    path.write_text("\n".join(separator.join(line) for line in lines))
    positions, columns = read_positions(path, COLUMNS)
    np.testing.assert_array_equal(positions, np.stack([values[c] for c in "xyz"], axis=1))
    assert columns.keys() == {"d", "rho", "viscosity"}
    for name, column in columns.items():
        np.testing.assert_array_equal(column, values[name])


def test_what_excel_and_numpy_write_is_read(tmp_path: Path) -> None:
    table = np.array([[1.0, 2.0, 3.0, 1e-5], [4.0, 5.0, 6.0, 2e-5]])
    np.savetxt(tmp_path / "numpy", table, header="x y z d")
    text = "x;y;z;d\r\n1;2;3;1e-5\r\n4;5;6;2e-5\r\n"
    (tmp_path / "excel").write_bytes(b"\xef\xbb\xbf" + text.encode())
    for name in ("numpy", "excel"):
        positions, columns = read_positions(tmp_path / name, COLUMNS)
        np.testing.assert_array_equal(positions, table[:, :3])
        np.testing.assert_array_equal(columns["d"], table[:, 3])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0 0 0\n0 0\n", "line 2: found '0 0'. Expected: 3 numbers, x y z, or a first line with the names"),
        ("0 0 0\n\n# a\n1 2 3 4\n", "line 4: found '1 2 3 4'. Expected: 3 numbers, x y z"),
        ("0 0 0 1e-5\n", "line 1: found '0 0 0 1e-5'. Expected: 3 numbers, x y z, or a first line with the"),
        ("0,0,0\n0,a,0", "line 2: found '0,a,0'. Expected: 3 numbers"),
        ("0,0,0\n0,,0,0", "line 2: found '0,,0,0'. Expected: 3 numbers"),
        ("0 0 0\n0 1e400 0", "line 2: found '0 1e400 0'. Expected: for y, a finite number"),
        ("0 0 0\n0 nan 0", "line 2: found '0 nan 0'. Expected: for y, a finite number"),
        ("x,y,d\n0,0,1", "line 1: found 'x,y,d'. Expected: one column z"),
        ("x,y,z,x\n0,0,1,1", "line 1: found 'x,y,z,x'. Expected: one column x"),
        ("x y z d\n0 0 0 1\n\n0 0 0 0", "line 4: found '0 0 0 0'. Expected: for d, a number > 0."),
        ("x y z d\n0 0 0", "line 2: found '0 0 0'. Expected: 4 numbers, x y z d."),
        ("x y z viscosity\n0 0 0 -1", "Expected: for viscosity, a number >= 0."),
        ("some text\n1 2 3", "line 1: no positions. Expected: a list ( (x y z) (x y z) … ), or lines x"),
    ],
)
def test_mistakes_in_tables(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "positions").write_text(text)
    with pytest.raises(InputError) as caught:
        read_positions(tmp_path / "positions", COLUMNS)
    assert str(caught.value).startswith(f"{tmp_path}/positions, line ")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        "Point ID,Points_0,Points_1,Points_2,Points_Magnitude\n0,1,2,3,3.74\n1,4,5,6,8.77\n",
        '"Name","X","Y","Z","U:0"\n"a, b",1,2,3,nan\n"",4,5,6,\n',
        "id X Y Z\na 1 2 3\nb 4 5 6\n",
    ],
    ids=["ParaView", "words", "white space"],
)
def test_further_columns_are_ignored_with_a_note(tmp_path: Path, caplog, text: str) -> None:
    path = tmp_path / "seeds.csv"
    path.write_text(text)
    with caplog.at_level("INFO", "foamprb"):
        found = read_positions(path)
    np.testing.assert_array_equal(found.x, [[1, 2, 3], [4, 5, 6]])
    assert found.columns == {}
    assert f"{path}: ignored columns: " in caplog.text
