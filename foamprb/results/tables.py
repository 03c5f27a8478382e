"""Tables: comma-separated text, or Parquet's binary columns."""

from __future__ import annotations

import csv
import importlib
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import chain, islice
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import orjson
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.optional import load
from foamprb.results.atomic import atomic_write

Column = Sequence[object] | NDArray[Any]
Columns: TypeAlias = dict[str, NDArray[Any]]

# Rows that are converted to text or from it together; their cells fit into the processor's cache.
_CHUNK = 2048
_AT_ONCE = 1 << 14
"""Rows of a table whose text is in memory together."""
_GROUP = 1 << 16
"""Rows of a row group of Parquet, which are in memory together."""
_WIDE = {"i": np.dtype(np.int64), "u": np.dtype(np.uint64), "f": np.dtype(np.float64)}
_QUOTE = '"'
_SPECIAL = re.compile(r'[,"\r\n]')
_FORMULA, _QUOTED = re.compile(r"'*[=+\-@\t]"), re.compile(r"''*[=+\-@\t]")


def require_kind(kind: str) -> None:
    """Raise InputError if the library for a kind of tables is missing."""
    if kind == "parquet":
        _parquet("tables of Parquet")


class Rows(NamedTuple):
    """Rows of a table of some kind."""

    names: tuple[str, ...]
    values: bytes | Columns
    """Text, or columns."""


def rows_of(columns: Mapping[str, Column], kind: str) -> Rows:
    """Return rows of a table as :func:`write_rows` takes them.

    Parameters
    ----------
    columns
        See :func:`write_table`.
    kind
        Ending of the file: ``csv`` or ``parquet``.

    Raises
    ------
    ValueError
        If the columns differ in length, or one has more than one axis.
    """
    arrays = {name: as_column(name, column) for name, column in columns.items()}
    lengths = {name: len(array) for name, array in arrays.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"Columns of a table differ in length: {lengths}.")
    if kind == "parquet":
        return Rows(tuple(arrays), {name: _plain(array) for name, array in arrays.items()})
    text = []
    for start in range(0, max(lengths.values(), default=0), _CHUNK):
        cells = (_texts(array[start : start + _CHUNK]) for array in arrays.values())
        text.append("".join(",".join(row) + "\n" for row in zip(*cells, strict=True)).encode())
    return Rows(tuple(arrays), b"".join(text))


def write_rows(path: Path, parts: Iterable[Rows], before: Callable[[Path], object] = lambda _: None) -> None:
    """Write a table from its rows part by part; see :func:`write_table`.

    Parameters
    ----------
    parts
        From :func:`rows_of` for the kind of the file, at least one.
    path, before
        See :func:`write_table`.
    """
    if path.suffix == ".parquet":
        _write_parquet(path, parts, before)
        return
    with atomic_write(path) as temporary:
        with temporary.open("wb") as file:
            for i, part in enumerate(parts):
                if i == 0:
                    file.write((",".join(map(_cell, part.names)) + "\n").encode())
                assert isinstance(part.values, bytes)
                file.write(part.values)
        before(temporary)


def write_table(
    path: Path, columns: Mapping[str, Column], before: Callable[[Path], object] = lambda _: None
) -> None:
    """Write a table, in one step; the ending of the file selects its kind.

    The text format begins with a line of column names. A floating-point number is written with the fewest
    digits that read back as the same double, or as ``nan``, ``inf`` or ``-inf``. Text with a comma, a quote
    or a line break is quoted.

    Parameters
    ----------
    path
        The file, ``.csv`` or ``.parquet``.
    columns
        Numbers or text of each column, all of the same length n, by name and in order.
    before
        Called with the temporary file when all is written; if it raises, no file remains.

    Raises
    ------
    ValueError
        If the columns differ in length, or one has more than one axis.
    InputError
        If the kind is Parquet, and pyarrow is not installed.
    OSError
        If the file cannot be written.
    """
    n = max((len(column) for column in columns.values()), default=0)
    step = max(n, 1) if path.suffix == ".parquet" else _AT_ONCE
    parts = (
        rows_of({name: column[start : start + step] for name, column in columns.items()}, path.suffix[1:])
        for start in range(0, max(n, 1), step)
    )
    write_rows(path, parts, before)


def read_table(path: Path, words: Collection[str] = ()) -> dict[str, NDArray[Any]]:
    """Read a table of :func:`write_table`.

    Parameters
    ----------
    path
        The file.
    words
        Columns of text, even if all cells look like numbers.

    Returns
    -------
    The columns (n,) by name, in order: integers (int64), numbers (float64), or text.

    Raises
    ------
    InputError
        If the file is missing or is no table; if it is Parquet, and pyarrow is not installed.
    """
    if path.suffix == ".parquet":
        return _read_parquet(path)
    columns: list[list[NDArray[Any]]] = []
    try:
        with path.open(encoding="utf-8", newline="") as file:
            reader = csv.reader(file)
            names = next(reader, [])
            columns = [[] for _ in names]
            while rows := list(islice(reader, _CHUNK)):
                if any(len(row) != len(names) for row in rows):
                    names = []
                    break
                for name, parts, cells in zip(names, columns, zip(*rows, strict=True), strict=True):
                    parts.append(_typed(cells, name in words))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not a readable table ({error}).") from error
    if not names:
        raise InputError(f"{path}: not a table: its lines have different numbers of columns.")
    kinds = [{part.dtype.kind for part in parts} for parts in columns]
    mixed = {name for name, found in zip(names, kinds, strict=True) if "U" in found and len(found) > 1}
    if mixed:
        # Some of the rows look like numbers.
        return read_table(path, {*words, *mixed})
    return {
        name: np.concatenate(parts or [_typed((), name in words)])
        for name, parts in zip(names, columns, strict=True)
    }


def _parquet(what: str) -> tuple[Any, Any]:
    """Return the modules pyarrow and pyarrow.parquet, which ``what`` needs."""
    return load("pyarrow", "parquet", f"{what} needs"), importlib.import_module("pyarrow.parquet")


def _write_parquet(path: Path, parts: Iterable[Rows], before: Callable[[Path], object]) -> None:
    """Write Parquet. Its bytes depend on nothing but the columns and the version of pyarrow."""
    arrow, parquet = _parquet(str(path))
    groups = _groups(parts)
    first = next(groups)
    # Doubles of similar size compress better byte by byte.
    split = [name for name, array in first.items() if array.dtype.kind == "f"]
    words = [name for name, array in first.items() if array.dtype.kind == "O"]

    def table_of(columns: Columns) -> Any:
        return arrow.table({name: arrow.array(array) for name, array in columns.items()})

    with atomic_write(path) as temporary:
        with (
            temporary.open("wb") as file,
            parquet.ParquetWriter(
                file,
                table_of(first).schema,
                compression="zstd",
                use_dictionary=words,
                use_byte_stream_split=split,
            ) as writer,
        ):
            for columns in chain([first], groups):
                writer.write_table(table_of(columns))
        before(temporary)


def _groups(parts: Iterable[Rows]) -> Iterator[Columns]:
    """Yield columns of ``_GROUP`` rows, the last of which may have fewer, whatever the sizes of the parts.

    There is at least one group; a table without rows has one without rows.
    """
    kept: list[Columns] = []
    empty: Columns | None = None
    for part in parts:
        assert isinstance(part.values, dict)
        if _length(part.values):
            kept.append(part.values)
        else:
            empty = part.values
        while sum(map(_length, kept)) > _GROUP:
            names, whole = kept[0], _joined(kept)
            yield {name: whole[name][:_GROUP] for name in names}
            kept = [{name: whole[name][_GROUP:] for name in names}]
    if kept:
        yield _joined(kept)
    elif empty is not None:
        yield empty


def _length(columns: Columns) -> int:
    return max(map(len, columns.values()), default=0)


def _joined(parts: Sequence[Columns]) -> Columns:
    """Return the columns of several parts, of a single one as they are."""
    if len(parts) == 1:
        return parts[0]
    return {name: np.concatenate([columns[name] for columns in parts]) for name in parts[0]}


def _plain(array: NDArray[Any]) -> NDArray[Any]:
    """Return numbers, or else Python strings."""
    if array.dtype.kind in _WIDE:
        return array
    found = array.tolist()
    if found and all(type(value) in (int, float) for value in found):
        return np.array(found)
    return np.array([str(value) for value in found], dtype=object)


def _read_parquet(path: Path) -> dict[str, NDArray[Any]]:
    arrow, parquet = _parquet(str(path))
    try:
        # pyarrow would take some file names for folders or addresses.
        with path.open("rb") as file:
            table = parquet.read_table(file)
    except (OSError, arrow.ArrowException) as error:
        raise InputError(f"{path}: not a readable table ({error}).") from error
    found = {name: column.to_numpy() for name, column in zip(table.column_names, table.columns, strict=True)}
    return {
        name: array.astype(str) if array.dtype.kind == "O" else array.astype(_WIDE[array.dtype.kind])
        for name, array in found.items()
    }


def _typed(words: Sequence[str], stay: bool) -> NDArray[Any]:
    """Return numbers if all words are numbers; if ``stay``, return the words."""
    for kind in () if stay else (np.int64, np.float64):
        try:
            return np.array(words, dtype=str).astype(kind)
        except ValueError:
            continue
    return np.array([word[1:] if _QUOTED.match(word) else word for word in words], dtype=str)


def as_column(name: str, column: Column) -> NDArray[Any]:
    """Return a column as an array; ValueError if it has more than one axis."""
    # Objects, so that numpy does not turn a mixed list into text or a list of long integers into floats.
    array = column if isinstance(column, np.ndarray) else np.array(column, dtype=object)
    if array.ndim != 1:
        raise ValueError(f"Column '{name}' of a table has shape {array.shape}.")
    return array


def _texts(column: NDArray[Any]) -> list[str]:
    """Return the cells of a column as text."""
    kind = column.dtype.kind
    if kind not in _WIDE:
        return list(map(_cell, column.tolist()))
    # JSON's numbers are valid in tables, and orjson writes them much faster than Python does.
    numbers = column.astype(_WIDE[kind], order="C", copy=False)
    texts = orjson.dumps(numbers, option=orjson.OPT_SERIALIZE_NUMPY).decode()[1:-1].split(",")
    for row in np.flatnonzero(~np.isfinite(numbers)):
        texts[row] = repr(float(numbers[row]))
    return texts


def _cell(value: object) -> str:
    text = str(value)
    # Spreadsheets take such words for formulas; read_table removes the apostrophe.
    if isinstance(value, str) and _FORMULA.match(text):
        text = f"'{text}"
    return f'"{text.replace(_QUOTE, 2 * _QUOTE)}"' if _SPECIAL.search(text) else text
