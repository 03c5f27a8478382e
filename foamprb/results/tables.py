"""Tables: comma-separated text, or Parquet's binary columns."""

from __future__ import annotations

import csv
import importlib
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import groupby
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.optional import load
from foamprb.results.atomic import atomic_write

Column = Sequence[object] | NDArray[Any]

# Rows converted to text at a time: their pieces fit in the cache.
_CHUNK = 2048

_WIDE = {"i": np.dtype(np.int64), "u": np.dtype(np.uint64), "f": np.dtype(np.float64)}

_QUOTE = '"'
_SPECIAL = re.compile(r'[,"\r\n]')


def require_kind(kind: str) -> None:
    """Raise InputError if a kind of tables is not available."""
    if kind == "parquet":
        _parquet("tables of Parquet")


def write_table(
    path: Path, columns: Mapping[str, Column], before: Callable[[], object] = lambda: None
) -> None:
    """Write a table, atomically; the suffix of the file selects the kind.

    Text has one line of column names. A floating-point number has the fewest digits that read back as the
    same double; ``nan``, ``inf`` and ``-inf`` are words. Text with a comma, a quote or a line break is
    quoted.

    Parameters
    ----------
    path
        The file, ``.csv`` or ``.parquet``.
    columns
        Numbers or text of each column, all of the same length n, by name and in order.
    before
        Called before the file is renamed to its final name; an exception leaves no file.

    Raises
    ------
    ValueError
        If the columns differ in length, or one has more than one axis.
    InputError
        If the kind is Parquet, and pyarrow is not installed.
    OSError
        If the file cannot be written.
    """
    arrays = {name: _as_column(name, column) for name, column in columns.items()}
    lengths = {name: len(array) for name, array in arrays.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"Columns of a table differ in length: {lengths}.")
    if path.suffix == ".parquet":
        _write_parquet(path, arrays, before)
        return
    with atomic_write(path) as temporary:
        with temporary.open("w", encoding="utf-8", newline="") as file:
            file.write(",".join(map(_cell, arrays)) + "\n")
            for lines in _chunks(list(arrays.values())):
                file.write(lines)
        before()


def read_table(path: Path, words: Collection[str] = ()) -> dict[str, NDArray[Any]]:
    """Read a table of :func:`write_table`.

    Parameters
    ----------
    path
        The file.
    words
        Columns of words, also if all of them look like numbers.

    Returns
    -------
    The columns (n,) by name, in order: integers (int64), numbers (float64), or words.

    Raises
    ------
    InputError
        If the file is missing or not a table; if it is Parquet, and pyarrow is not installed.
    """
    if path.suffix == ".parquet":
        return _read_parquet(path)
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not a readable table ({error}).") from error
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise InputError(f"{path}: not a table: its lines have different numbers of columns.")
    names, *lines = rows
    return {name: _typed([line[i] for line in lines], name in words) for i, name in enumerate(names)}


def _parquet(what: str) -> Any:
    load("pyarrow", "parquet", f"{what} needs")
    return importlib.import_module("pyarrow.parquet")


def _write_parquet(path: Path, arrays: Mapping[str, NDArray[Any]], before: Callable[[], object]) -> None:
    """Write a Parquet table with typed numbers; the bytes depend on columns and pyarrow version only."""
    parquet = _parquet(str(path))
    arrow = importlib.import_module("pyarrow")
    columns = {name: arrow.array(_plain(array)) for name, array in arrays.items()}
    kinds = {name: _plain(array).dtype.kind for name, array in arrays.items()}
    # Corresponding bytes of doubles of similar magnitude are similar.
    split = [name for name, kind in kinds.items() if kind == "f"]
    words = [name for name, kind in kinds.items() if kind == "O"]
    with atomic_write(path) as temporary:
        with temporary.open("wb") as file:
            parquet.write_table(
                arrow.table(columns), file, compression="zstd", use_dictionary=words,
                use_byte_stream_split=split,
            )  # fmt: skip
        before()


def _plain(array: NDArray[Any]) -> NDArray[Any]:
    """Return numbers as they are, and words as Python strings."""
    if array.dtype.kind in _WIDE:
        return array
    found = array.tolist()
    if found and all(type(value) in (int, float) for value in found):
        return np.array(found)
    return np.array([str(value) for value in found], dtype=object)


def _read_parquet(path: Path) -> dict[str, NDArray[Any]]:
    parquet = _parquet(str(path))
    arrow = importlib.import_module("pyarrow")
    try:
        # An open file, as pyarrow could interpret a name as a folder or an address.
        with path.open("rb") as file:
            table = parquet.read_table(file)
    except (OSError, arrow.ArrowException) as error:
        raise InputError(f"{path}: not a readable table ({error}).") from error
    found = {name: column.to_numpy() for name, column in zip(table.column_names, table.columns, strict=True)}
    return {
        name: array.astype(str) if array.dtype.kind == "O" else array.astype(_WIDE[array.dtype.kind])
        for name, array in found.items()
    }


def _typed(words: list[str], stay: bool) -> NDArray[Any]:
    """Return numbers if all words are numbers and the column may be numeric."""
    for kind in () if stay else (np.int64, np.float64):
        try:
            return np.array(words, dtype=str).astype(kind)
        except ValueError:
            continue
    return np.array(words, dtype=str)


def _as_column(name: str, column: Column) -> NDArray[Any]:
    # Objects: numpy would convert a mixed list to text and long integers to floats.
    array = column if isinstance(column, np.ndarray) else np.array(column, dtype=object)
    if array.ndim != 1:
        raise ValueError(f"Column '{name}' of a table has shape {array.shape}.")
    return array


def _chunks(columns: list[NDArray[Any]]) -> Iterator[str]:
    """Yield the lines of a table, some thousands at a time."""
    n = len(columns[0]) if columns else 0
    runs = [list(run) for _, run in groupby(columns, _kind)]
    for start in range(0, n, _CHUNK):
        rows = slice(start, start + _CHUNK)
        # Cells and separators in one list: a third of the cost of joining row by row.
        pieces = [","] * (2 * len(runs) * len(columns[0][rows]))
        for i, run in enumerate(runs):
            pieces[2 * i :: 2 * len(runs)] = _texts([column[rows] for column in run])
        pieces[2 * len(runs) - 1 :: 2 * len(runs)] = ["\n"] * len(columns[0][rows])
        yield "".join(pieces)


def _kind(column: NDArray[Any]) -> np.dtype[Any] | int:
    """Return the kind of a column; columns of numbers of one kind are written together."""
    return _WIDE.get(column.dtype.kind, id(column))


def _texts(columns: list[NDArray[Any]]) -> list[str]:
    """Return the rows of columns of one kind as text."""
    kind = _kind(columns[0])
    if isinstance(kind, int):
        values = columns[0].tolist()
        if set(map(type, values)) != {str}:
            return list(map(_cell, values))
        cells = {text: _quoted(text) for text in set(values)}
        return [cells[text] for text in values]
    # JSON has the number format of tables, and orjson writes it thirty times as fast as Python.
    numbers = np.stack(columns, axis=1).astype(kind, order="C", copy=False)
    texts = orjson.dumps(numbers, option=orjson.OPT_SERIALIZE_NUMPY).decode()[2:-2].split("],[")
    for row in np.flatnonzero(~np.isfinite(numbers).all(axis=1)):
        texts[row] = ",".join(map(_float, numbers[row].tolist()))
    return texts


def _float(value: float) -> str:
    return orjson.dumps(value).decode() if isfinite(value) else repr(value)


def _cell(value: object) -> str:
    return _quoted(str(value))


# A column has few different words.
@lru_cache(maxsize=_CHUNK)
def _quoted(text: str) -> str:
    return f'"{text.replace(_QUOTE, 2 * _QUOTE)}"' if _SPECIAL.search(text) else text
