import csv
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.errors import InputError
from foamprb.results.tables import read_result, read_table, rows_of, write_rows, write_table


def read(path: Path) -> list[list[str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


@given(values=st.lists(st.floats(width=64), max_size=20))
def test_doubles_round_trip_exactly(tmp_path_factory: pytest.TempPathFactory, values: list[float]) -> None:
    path = tmp_path_factory.mktemp("tables") / "t.csv"
    write_table(path, {"array": np.array(values, dtype=float), "list": values})
    for column in zip(*read(path)[1:], strict=True):
        found = np.array([float(text) for text in column])
        nan = np.isnan(values)
        np.testing.assert_array_equal(np.isnan(found), nan)
        assert found[~nan].tobytes() == np.array(values)[~nan].tobytes()


@given(texts=st.lists(st.text(st.characters(exclude_categories=["Cs"])), min_size=1, max_size=8))
def test_text_round_trips(tmp_path_factory: pytest.TempPathFactory, texts: list[str]) -> None:
    path = tmp_path_factory.mktemp("tables") / "t.csv"
    write_table(path, {"id": range(len(texts)), "fate": texts})
    found = read_table(path, ["fate"])["fate"]
    # numpy's texts end at trailing zeros.
    assert found.tolist() == np.array(texts).tolist()


@pytest.mark.parametrize("word", ["=1+1", "+x", "-patch", "@SUM(A1)", "'=x", "'plain", "a=b"])
def test_no_word_is_a_formula(tmp_path: Path, word: str) -> None:
    """Spreadsheets would compute it."""
    path = tmp_path / "t.csv"
    write_table(path, {"patch": [word], "x": [-1.0]})
    assert read(path)[1][0][0] not in "=+-@"
    assert read_table(path, ["patch"])["patch"].tolist() == [word]
    assert read(path)[1][1] == "-1.0"


def test_shortest_digits(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    write_table(
        path,
        {
            "id": np.array([7, 2**62]),
            "d": np.array([0.1, 5e-6]),
            "t1": [math.nan, -math.inf],
            "fate": np.array(["stuck", "escaped"]),
        },
    )
    assert path.read_text() == f"id,d,t1,fate\n7,0.1,nan,stuck\n{2**62},5e-6,-inf,escaped\n"


def test_many_rows_keep_their_order(tmp_path: Path) -> None:
    n = 150_000
    path = tmp_path / "t.csv"
    write_table(path, {"id": np.arange(n), "x": np.arange(n) / 3})
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table, np.c_[np.arange(n), np.arange(n) / 3])


def test_kind_of_a_column_is_that_of_all_its_rows(tmp_path: Path) -> None:
    n = 10_000
    path = tmp_path / "t.csv"
    numbers = [*range(n), 0.5]
    words = [*map(str, range(n)), "=a"]
    write_table(path, {"id": np.arange(n + 1), "x": numbers, "word": words})
    table = read_table(path)
    assert [array.dtype.kind for array in table.values()] == ["i", "f", "U"]
    assert table["x"].tolist() == numbers
    assert table["word"].tolist() == words
    with path.open("a") as file:
        file.write("1,2\n")
    with pytest.raises(InputError, match="different numbers of columns"):
        read_table(path)


def test_no_rows(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    write_table(path, {"id": [], "x": np.empty(0)})
    assert path.read_text() == "id,x\n"


@pytest.mark.parametrize(
    ("columns", "message"),
    [({"a": [1], "b": [1, 2]}, "differ in length"), ({"x": np.zeros((2, 3))}, "'x' .* shape")],
)
def test_columns_that_are_no_table(tmp_path: Path, columns: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        write_table(tmp_path / "t.csv", columns)  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


def test_records_beside_a_table_are_its_rows(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    columns = {
        "id": np.arange(5),
        "x": np.array([1.0, np.nan, np.inf, -0.0, 1e-300]),
        "fate": np.array([*"abcde"]),
    }
    parts = (rows_of({name: c[k : k + 2] for name, c in columns.items()}, True) for k in (0, 2, 4))
    write_rows(path, parts, n=5)
    records = np.load(path.with_suffix(".npy"))
    for name, column in columns.items():
        np.testing.assert_array_equal(records[name], column)
        np.testing.assert_array_equal(read_result(path, wanted=[name])[name], column)


def test_another_array_beside_a_table_is_not_its_rows(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    write_table(path, {"x": [1, 2]})
    np.save(path.with_suffix(".npy"), np.zeros(3))
    assert read_result(path)["x"].tolist() == [1, 2]
