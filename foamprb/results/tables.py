"""Tables of comma-separated text, and beside long ones the same rows as numpy has them."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from io import TextIOWrapper
from itertools import groupby, islice
from operator import add
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import orjson
from numpy.typing import NDArray

from foamprb.results.atomic import atomic_write
from foamprb.results.reading import open_regular, reading

Column = Sequence[object] | NDArray[Any]

# Rows that are converted to text or from it together; their cells fit into the processor's cache.
_CHUNK = 2048
_AT_ONCE = 1 << 14
"""Rows of a table whose text is in memory together."""
_WIDE = {"i": np.dtype(np.int64), "u": np.dtype(np.uint64), "f": np.dtype(np.float64)}
_QUOTE = '"'
_SPECIAL = re.compile(r'[,"\r\n]')
_FORMULA, _QUOTED = re.compile(r"'*[=+\-@\t]"), re.compile(r"''*[=+\-@\t]")


LONG = 100_000
"""Rows beyond which a table has a file of records beside it."""
RECORDS = ".npy"


class Rows(NamedTuple):
    """Names of the columns of a table, and some of its rows as text."""

    names: tuple[str, ...]
    text: bytes
    records: NDArray[Any] | None = None
    """The same rows, each an item with a field of each column."""


def rows_of(columns: Mapping[str, Column], with_records: bool = False) -> Rows:
    """Return rows of a table as :func:`write_rows` takes them.

    Columns of text need a width for ``with_records``, the same in all parts of a table.

    Raises
    ------
    ValueError
        If the columns differ in length, or one has more than one axis.
    """
    arrays = {name: as_column(name, column) for name, column in columns.items()}
    lengths = {name: len(array) for name, array in arrays.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"Columns of a table differ in length: {lengths}.")
    text = []
    for start in range(0, max(lengths.values(), default=0), _CHUNK):
        chunks = (array[start : start + _CHUNK] for array in arrays.values())
        # Adjacent columns of numbers become text together.
        groups = (list(group) for _, group in groupby(chunks, lambda chunk: chunk.dtype.kind))
        cells = [cell for group in groups for cell in _texts(group)]
        lines = map(",".join, zip(*cells, strict=True))
        text.append("\n".join((*lines, "")).encode())
    return Rows(tuple(arrays), b"".join(text), _records_of(arrays) if with_records else None)


def _records_of(arrays: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    kinds = [(name, array.dtype) for name, array in arrays.items()]
    records = np.empty(max(map(len, arrays.values()), default=0), dtype=kinds)
    for name, array in arrays.items():
        records[name] = array
    return records


def write_rows(
    path: Path, parts: Iterable[Rows], before: Callable[[], object] = lambda: None, n: int = 0
) -> None:
    """Write a table from its rows part by part; see :func:`write_table`.

    Parameters
    ----------
    before
        Called when all is written; if it raises, no file remains.
    n
        Number of rows of parts with records, which go to a file of numpy beside the table; 0 without.
    """
    with atomic_write(path) as temporary, ExitStack() as beside:
        records = beside.enter_context(atomic_write(path.with_suffix(RECORDS))) if n else None
        with temporary.open("wb") as file, ExitStack() as opened:
            other = opened.enter_context(records.open("wb")) if records else None
            for i, part in enumerate(parts):
                if i == 0:
                    file.write((",".join(map(_cell, part.names)) + "\n").encode())
                file.write(part.text)
                if other and part.records is not None:
                    if i == 0:
                        kind = np.lib.format.dtype_to_descr(part.records.dtype)
                        head = {"descr": kind, "fortran_order": False, "shape": (n,)}
                        np.lib.format.write_array_header_2_0(other, head)
                    other.write(part.records.tobytes())
        before()


def write_table(path: Path, columns: Mapping[str, Column]) -> None:
    """Write a table, in one step; ValueError as :func:`rows_of`.

    The text begins with a line of column names. A floating-point number is written with the fewest
    digits that read back as the same double, or as ``nan``, ``inf`` or ``-inf``. Text with a comma, a quote
    or a line break is quoted.

    Parameters
    ----------
    path
        The file.
    columns
        Numbers or text of each column, all of the same length n, by name and in order.
    """
    n = max((len(column) for column in columns.values()), default=0)
    parts = (
        rows_of({name: column[start : start + _AT_ONCE] for name, column in columns.items()})
        for start in range(0, max(n, 1), _AT_ONCE)
    )
    write_rows(path, parts)


def read_table(
    path: Path, words: Collection[str] = (), wanted: Collection[str] | None = None
) -> dict[str, NDArray[Any]]:
    """Read a table of :func:`write_table`.

    Parameters
    ----------
    path
        The file.
    words
        Columns of text, even if all cells look like numbers.
    wanted
        Columns to return, by default all. A table may lack some.

    Returns
    -------
    The columns (n,) by name, in order: integers (int64), numbers (float64), or text.
    """
    with reading(path, "is no table"), open_regular(path) as file:
        reader = csv.reader(TextIOWrapper(file, encoding="utf-8", newline=""))
        names = next(reader, [])
        columns: dict[str, list[NDArray[Any]]] = {
            name: [] for name in names if wanted is None or name in wanted
        }
        while rows := list(islice(reader, _CHUNK)):
            if any(len(row) != len(names) for row in rows):
                raise ValueError("its lines have different numbers of columns")
            for name, cells in zip(names, zip(*rows, strict=True), strict=True):
                if name in columns:
                    columns[name].append(_typed(cells, name in words))
        if not names or len({*names}) < len(names):
            raise ValueError("its first line is not one of different names of columns")
    kinds = {name: {part.dtype.kind for part in parts} for name, parts in columns.items()}
    mixed = {name for name, letters in kinds.items() if "U" in letters and len(letters) > 1}
    if mixed:
        # Some of the rows look like numbers.
        return read_table(path, {*words, *mixed}, wanted)
    return {name: np.concatenate(parts or [_typed((), name in words)]) for name, parts in columns.items()}


def read_result(
    path: Path, words: Collection[str] = (), wanted: Collection[str] | None = None
) -> dict[str, NDArray[Any]]:
    """Read a table of a run as :func:`read_table`, from the records of :func:`write_rows` if it has them."""
    records = path.with_suffix(RECORDS)
    if records.exists():
        with reading(records, "is no table"), open_regular(records) as file:
            rows = np.load(file, allow_pickle=False)
        # A function of a user may write arrays of its own beside its tables.
        if names := rows.dtype.names:
            return {name: rows[name].copy() for name in names if wanted is None or name in wanted}
    return read_table(path, words, wanted)


def _typed(words: Sequence[str], stay: bool) -> NDArray[Any]:
    """Return numbers if all words are numbers; if ``stay``, return the words."""
    if not stay:
        # JSON's numbers are read faster than others; it has no nan and no inf.
        with suppress(orjson.JSONDecodeError, OverflowError):
            numbers = orjson.loads(f"[{','.join(words)}]")
            if len(numbers) == len(words) and {*map(type, numbers)} in ({int}, {float}):
                return np.array(numbers, dtype=type(numbers[0]))
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


def _texts(columns: Sequence[NDArray[Any]]) -> list[list[str]]:
    """Return the cells of adjacent columns of one kind as text; several columns of numbers as one."""
    kind = columns[0].dtype.kind
    if kind not in _WIDE:
        return [_words(column.tolist()) for column in columns]
    if not len(columns[0]):
        return [[]]
    # JSON's numbers are valid in tables, and orjson writes them much faster than Python does.
    numbers = np.stack(columns, axis=1, dtype=_WIDE[kind], casting="same_kind")
    text = orjson.dumps(numbers, option=orjson.OPT_SERIALIZE_NUMPY).decode()
    # JSON has null for each number that is not finite, in the same order.
    words = list(map(repr, numbers[~np.isfinite(numbers)].tolist()))
    if len({*words}) == 1:
        text = text.replace("null", words[0])
    elif words:
        first, *others = text.split("null")
        text = first + "".join(map(add, words, others))
    return [text[2:-2].split("],[")]


def _words(values: Sequence[object]) -> list[str]:
    """Return the cells of a column that is not of numbers; most have few different texts."""
    if {*map(type, values)} == {str}:
        cells = {value: _cell(value) for value in {*values}}
        return [cells[value] for value in values]
    return list(map(_cell, values))


def _cell(value: object) -> str:
    text = str(value)
    # Spreadsheets take such words for formulas; read_table removes the apostrophe.
    if isinstance(value, str) and _FORMULA.match(text):
        text = f"'{text}"
    return f'"{text.replace(_QUOTE, 2 * _QUOTE)}"' if _SPECIAL.search(text) else text
