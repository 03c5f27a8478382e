"""Tables as comma-separated text."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.output.atomic import atomic_write

Column = Sequence[object] | NDArray[Any]

# Rows converted to Python objects at a time: bounds the memory, costs no time.
_CHUNK = 65536

_QUOTE = '"'
_SPECIAL = re.compile(r'[,"\r\n]')


def write_table(path: Path, columns: Mapping[str, Column]) -> None:
    """Write a table with one line of column names, in one step.

    A floating-point number is written with the fewest digits that read back as the same double; ``nan``,
    ``inf`` and ``-inf`` are words. Text with a comma, a quote or a line break is quoted.

    Parameters
    ----------
    path
        The file, ``.csv``.
    columns
        Numbers or text of each column, all of the same length n, by name and in order.

    Raises
    ------
    ValueError
        If the columns differ in length, or one has more than one axis.
    OSError
        If the file cannot be written.
    """
    arrays = {name: _as_column(name, column) for name, column in columns.items()}
    lengths = {name: len(array) for name, array in arrays.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"Columns of a table differ in length: {lengths}.")
    with atomic_write(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        file.write(",".join(map(_cell, arrays)) + "\n")
        for rows in _chunks(list(arrays.values())):
            file.writelines(f"{','.join(row)}\n" for row in rows)


def read_table(path: Path) -> dict[str, NDArray[Any]]:
    """Read what :func:`write_table` has written.

    Returns
    -------
    The columns (n,) by name, in order: whole numbers (int64), numbers (float64), or words.

    Raises
    ------
    InputError
        If the file is missing, or is no such table.
    """
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not a readable table ({error}).") from error
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise InputError(f"{path}: not a table: its lines have different numbers of columns.")
    names, *lines = rows
    return {name: _typed([line[i] for line in lines]) for i, name in enumerate(names)}


def _typed(words: list[str]) -> NDArray[Any]:
    """Numbers, if all words are."""
    for kind in (np.int64, np.float64):
        try:
            return np.array(words, dtype=str).astype(kind)
        except ValueError:
            continue
    return np.array(words, dtype=str)


def _as_column(name: str, column: Column) -> NDArray[Any]:
    # Objects, so that numpy does not turn a mixed list into text or a list of long integers into floats.
    array = column if isinstance(column, np.ndarray) else np.array(column, dtype=object)
    if array.ndim != 1:
        raise ValueError(f"Column '{name}' of a table has shape {array.shape}.")
    return array


def _chunks(columns: list[NDArray[Any]]) -> Iterator[Iterable[tuple[str, ...]]]:
    n = len(columns[0]) if columns else 0
    for start in range(0, n, _CHUNK):
        yield zip(*(_cells(column[start : start + _CHUNK]) for column in columns), strict=True)


def _cells(column: NDArray[Any]) -> Iterator[str]:
    # A double's repr is the shortest text that reads back the same.
    return map(repr if column.dtype.kind in "iuf" else _cell, column.tolist())


def _cell(value: object) -> str:
    text = str(value)
    return f'"{text.replace(_QUOTE, 2 * _QUOTE)}"' if _SPECIAL.search(text) else text
