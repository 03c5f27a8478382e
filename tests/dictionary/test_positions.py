"""Files of positions."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

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
    positions = read_positions(path)
    assert positions.shape == (len(rows), 3)
    assert positions.dtype == np.float64
    np.testing.assert_array_equal(positions, np.array(rows, dtype=float).reshape(-1, 3))


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


def test_a_broken_row_late_in_a_long_file_is_found_at_once(tmp_path: Path) -> None:
    (tmp_path / "positions").write_text("(" + "(0 1 2)\n" * 100_000 + "(0 1\n)")
    with pytest.raises(InputError, match="line 100001: found"):
        read_positions(tmp_path / "positions")
