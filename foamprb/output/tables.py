"""Tables as comma-separated text."""

from __future__ import annotations

import math
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


class TimeTable:
    """A table that grows by a row at a time, its first column the time, s.

    At any moment the file holds whole rows only, but for the last of a killed run, which the next drops.

    Parameters
    ----------
    path
        The file, ``.csv``.
    names
        Names of the columns after ``time``.
    after
        Time, s, from which the run goes on: rows of later times are dropped, as they will be written anew.
        By default everything: the run is a new one.

    Raises
    ------
    InputError
        If the file has other columns, or what is no number for a time.
    OSError
        If the file cannot be written.
    """

    def __init__(self, path: Path, names: Sequence[str], *, after: float = -math.inf) -> None:
        self.path = path
        first = ",".join(map(_cell, ("time", *names))) + "\n"
        lines = [first]
        if after > -math.inf and path.exists():
            with path.open(encoding="utf-8", newline="\n") as file:
                lines = list(file)
        if lines[:1] != [first]:
            raise InputError(f"{path}: its first line must be {first.strip()} for a run to go on with it.")
        try:
            kept = [line for line in lines[1:] if line.endswith("\n") and float(line.split(",")[0]) <= after]
        except ValueError as error:
            raise InputError(f"{path}: a row has no time ({error}).") from error
        with atomic_write(path) as temporary:
            temporary.write_text(first + "".join(kept), "utf-8")

    def append(self, time: float, row: Sequence[object]) -> None:
        """Add a row; a text may not hold a line break.

        Raises
        ------
        OSError
            If there is no room for it; the file is then as before.
        """
        line = ",".join(_cell(value) for value in (float(time), *row)) + "\n"
        with self.path.open("ab", buffering=0) as file:
            size = file.tell()
            try:
                rest = line.encode()
                while rest:
                    rest = rest[file.write(rest) :]
            except OSError as error:
                file.truncate(size)
                error.filename = str(self.path)
                raise


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
