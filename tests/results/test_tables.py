import csv
import importlib
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.errors import InputError
from foamprb.results.folder import ResultsFolder
from foamprb.results.tables import Rows, read_table, require_kind, rows_of, write_rows, write_table


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


@given(
    values=st.lists(st.floats(width=64), max_size=20),
    texts=st.lists(st.text(st.characters(exclude_categories=["Cs"]))),
)
def test_parquet_gives_back_numbers_to_the_bit_and_words(
    tmp_path_factory: pytest.TempPathFactory, values: list[float], texts: list[str]
) -> None:
    n = min(len(values), len(texts))
    path = tmp_path_factory.mktemp("tables") / "t.parquet"
    number = np.arange(n, dtype=np.int32)
    x = np.array(values[:n], dtype=float)
    write_table(path, {"x": x, "id": number, "list": values[:n], "w": texts[:n]})
    found = read_table(path)
    assert list(found) == ["x", "id", "list", "w"]
    assert found["x"].tobytes() == x.tobytes()
    if n:
        assert found["list"].tobytes() == found["x"].tobytes()
    assert (found["id"].dtype, found["id"].tolist()) == (np.int64, number.tolist())
    assert found["w"].dtype.kind == "U"
    # numpy cuts zeros off the end of a word.
    assert found["w"].tolist() == [text.rstrip("\0") for text in texts[:n]]


def test_parquet_has_the_columns_of_the_text(tmp_path: Path) -> None:
    columns = {"id": [7, 8], "d": np.array([0.1, np.inf]), "fate": ["stuck", "1"], "mixed": [1, 2.5]}
    found = []
    for kind in ("csv", "parquet"):
        write_table(tmp_path / f"t.{kind}", columns)
        assert ResultsFolder(tmp_path, "cloud").find_table("t") == tmp_path / "t.csv"
        found.append(read_table(tmp_path / f"t.{kind}"))
    for name, column in found[0].items():
        assert column.dtype.kind == found[1][name].dtype.kind
        assert column.tolist() == found[1][name].tolist()
    assert ResultsFolder(tmp_path, "cloud").find_table("u") is None
    assert read_table(tmp_path / "t.csv", words=("id",))["id"].tolist() == ["7", "8"]


def write_in_parts(path: Path, columns: dict[str, Any], size: int, patch: pytest.MonkeyPatch) -> int:
    """Write a table in parts of some rows and empty parts; return the most rows that wait to be written."""
    parquet = pytest.importorskip("pyarrow.parquet")
    write, written, waiting = parquet.ParquetWriter.write_table, [0], [0]

    def count(writer: Any, table: Any) -> None:
        written.append(written[-1] + len(table))
        write(writer, table)

    def parts() -> Iterator[Rows]:
        for start in range(0, len(columns["id"]), size):
            yield rows_of({name: column[:0] for name, column in columns.items()}, "parquet")
            waiting.append(start - written[-1])
            yield rows_of({k: column[start : start + size] for k, column in columns.items()}, "parquet")

    patch.setattr(parquet.ParquetWriter, "write_table", count)
    write_rows(path, parts())
    patch.setattr(parquet.ParquetWriter, "write_table", write)
    return max(waiting)


def test_parquet_is_written_in_groups_that_do_not_depend_on_the_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("foamprb.results.tables._GROUP", 100)
    columns = {"id": np.arange(1050), "x": np.linspace(0.0, 1.0, 1050), "w": np.array(["a", "bc"] * 525, "O")}
    path, found = tmp_path / "t.parquet", set()
    for size in (7, 250, 2000):
        assert write_in_parts(path, columns, size, monkeypatch) <= size + 200
        found.add(path.read_bytes())
    assert len(found) == 1
    groups = pytest.importorskip("pyarrow.parquet").ParquetFile(path).metadata
    assert [groups.row_group(k).num_rows for k in range(groups.num_row_groups)] == [100] * 10 + [50]
    assert read_table(path)["w"].tolist() == columns["w"].tolist()


def test_broken_parquet_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "t.parquet"
    write_table(path, {"x": np.arange(1000.0)})
    path.write_bytes(path.read_bytes()[:500])
    with pytest.raises(InputError, match=r"t\.parquet: not a readable table \("):
        read_table(path)
    with pytest.raises(InputError, match=r"none\.parquet: not a readable table"):
        read_table(tmp_path / "none.parquet")


def test_parquet_without_pyarrow_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_table(tmp_path / "t.parquet", {"x": [1.0]})
    load = importlib.import_module

    def absent(name: str, package: str | None = None) -> object:
        if name.startswith("pyarrow"):
            raise ImportError(name)
        return load(name, package)

    monkeypatch.setattr(importlib, "import_module", absent)
    require_kind("csv")
    remedy = r"needs pyarrow: pip install 'foamprb\[parquet\]'"
    with pytest.raises(InputError, match=f"tables of Parquet {remedy}"):
        require_kind("parquet")
    for use in (lambda path: write_table(path, {"x": [1.0]}), read_table):
        with pytest.raises(InputError, match=rf"t\.parquet {remedy}"):
            use(tmp_path / "t.parquet")
