"""Files of positions for ``manualInjection``: OpenFOAM's list, or a table of plain numbers."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.constraints import Bounds
from foamprb.dictionary.mistakes import Mistake
from foamprb.errors import InputError, suggestion

Floats = NDArray[np.float64]


class Positions(NamedTuple):
    """Positions of n particles, and further columns of a file."""

    x: Floats
    """(n, 3), m."""
    columns: dict[str, Floats]
    """Other columns by their names, (n,) each."""


# Possessive quantifiers: a broken file is rejected in linear time.
_NUMBER = rb"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?"
_ROWS = re.compile(rb"(?:\s*+\(\s*+%b\s++%b\s++%b\s*+\))*+\s*+" % (_NUMBER, _NUMBER, _NUMBER))
_COMMENT = re.compile(rb"//[^\n]*+|/\*.*?\*/", re.DOTALL)
_COMMENT_IN_TABLE = re.compile(rb"(?:#|//)[^\n]*+")
_HEADER = re.compile(rb"\s*+(?:FoamFile\s*+\{[^}]*+\})?+\s*+")
_OPENING = re.compile(rb"(\d{1,18}+)?\s*+\(")
_PARENTHESES = bytes.maketrans(b"()", b"  ")
_FINITE = Bounds(-np.inf, np.inf, True, True, "a finite number")
_COORDINATES = ("x", "y", "z")
# Names in ParaView's spreadsheets.
_ALIASES = {f"Points{mark}{i}": name for mark in ":_" for i, name in enumerate(_COORDINATES)}
_ALIASES |= {name.upper(): name for name in _COORDINATES}
log = logging.getLogger("foamprb")


def read_positions(path: Path, columns: Mapping[str, Bounds] | None = None) -> Positions:
    """Read positions, in one of two formats.

    * OpenFOAM's list ``( (x y z) (x y z) … )``, with or without a header and the number of positions;
    * a table with a line for each position, numbers separated by commas, semicolons or white space. Its first
      line may name the columns: ``x,y,z,d,rho``. Other columns are ignored, with a note. Comments begin with
      ``#`` or ``//``.

    Parameters
    ----------
    path
        The file.
    columns
        Further columns that a table may have, with the bounds of their values.
    """
    try:
        data = path.read_bytes().removeprefix(b"\xef\xbb\xbf")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}.") from error
    text = _COMMENT.sub(_blank, data)
    header = _HEADER.match(text)
    start = header.end() if header else 0
    opening = _OPENING.match(text, start)
    if opening is None and b"FoamFile" not in text[:start]:
        return _table(path, data, columns or {})
    if opening is None:
        raise _mistake(path, text, start, "Expected: a list ( (x y z) (x y z) … )")
    return Positions(_list(path, text, start, opening), {})


def _list(path: Path, text: bytes, start: int, opening: re.Match[bytes]) -> Floats:
    """Read OpenFOAM's list, given the match of its opening."""
    rows = _ROWS.match(text, opening.end())
    end = rows.end() if rows else opening.end()
    # Until Python 3.11.4 a match may end within a row that does not fit.
    begun = text.rfind(b"(", opening.end(), end)
    if begun > text.rfind(b")", opening.end(), end):
        end = begun
    if text[end : end + 1] != b")":
        raise _mistake(path, text, end, "Expected: (x y z), three numbers, or the list's closing )")
    # The line that ends OpenFOAM's files is not always a comment.
    if re.search(rb"[\w()]", text[end + 1 :]):
        first = len(text) - len(text[end + 1 :].lstrip())
        raise _mistake(path, text, first, "Expected: nothing after the list")
    numbers = np.array(text[opening.end() : end].translate(_PARENTHESES).split(), dtype=np.float64)
    positions = numbers.reshape(-1, 3)
    if opening[1] is not None and int(opening[1]) != len(positions):
        raise _mistake(path, text, start, f"The list holds {len(positions)} positions")
    finite = np.isfinite(positions).all(axis=1)
    if not finite.all():
        row = int(np.argmin(finite))
        starts = (match.start() for match in re.finditer(rb"\(", text[opening.end() : end]))
        offset = next(start for index, start in enumerate(starts) if index == row)
        raise _mistake(path, text, opening.end() + offset, "Expected: (x y z), three finite numbers")
    return positions


def _table(path: Path, data: bytes, columns: Mapping[str, Bounds]) -> Positions:
    """Read lines of numbers, with or without a first line of names, which may be a comment."""
    commented = re.match(rb"\s*+#[ \t]*+([^\n]*+)", data)
    if commented and set(_COORDINATES) <= set(_words(commented[1].decode(errors="replace"))):
        data = data.replace(b"#", b" ", 1)
    lines = [line.strip() for line in _COMMENT_IN_TABLE.sub(b"", data).decode(errors="replace").split("\n")]
    rows = [k for k, line in enumerate(lines) if line]
    head = lines[rows[0]] if rows else ""
    names: Sequence[str] = _COORDINATES
    recognised = (*_COORDINATES, *columns)
    if not head or re.search(r"[a-df-zA-DF-Z]", head):
        names = _words(head)
        row = rows.pop(0) if rows else len(lines) - 1
        expected = "Expected: a list ( (x y z) (x y z) … ), or lines x y z"
        if not head:
            raise _unexpected(path, row + 1, head, expected)
        if not set(names) & set(recognised):
            # The text is not quoted: a foreign case may name any file.
            raise Mistake(str(path), row + 1, f"no positions. {expected}.")
        for name in recognised:
            if names.count(name) != 1 and name in (*_COORDINATES, *names):
                hint = suggestion(name, names)[:-1]
                raise _unexpected(path, row + 1, head, f"Expected: one column {name}. {hint}")
    if ignored := [name for name in names if name not in recognised]:
        log.info("%s: ignored columns: %s.", path, ", ".join(ignored))
    used = [k for k, name in enumerate(names) if name in recognised]
    row = 0

    def each() -> Iterator[str]:
        nonlocal row
        for row in rows:
            yield lines[row]

    numbers = np.empty((0, len(used)))
    try:
        if rows:
            numbers = np.loadtxt(
                each(), delimiter=_separator(head), comments=None, quotechar='"', ndmin=2,
                usecols=used if ignored else None,
            )  # fmt: skip
        if numbers.shape[1] != len(used):
            row = rows[0]
            raise ValueError
    except ValueError:
        hint = "" if names is not _COORDINATES else ", or a first line with the names of the columns"
        expected = f"Expected: {len(names)} numbers, {' '.join(names)}{hint}"
        raise _unexpected(path, row + 1, lines[row], expected) from None
    values = {names[k]: column.copy() for k, column in zip(used, numbers.T, strict=True)}
    for name, column in values.items():
        bounds = columns.get(name, _FINITE)
        if len(column) and not (bounds.admits(column.min()) and bounds.admits(column.max())):
            row = rows[next(k for k, value in enumerate(column) if not bounds.admits(value))]
            raise _unexpected(path, row + 1, lines[row], f"Expected: for {name}, {bounds.text}")
    return Positions(np.stack([values.pop(name) for name in _COORDINATES], axis=1), values)


def _separator(line: str) -> str | None:
    return next((mark for mark in ",;" if mark in line), None)


def _words(line: str) -> tuple[str, ...]:
    """Return the words of a line, separated by commas or semicolons or, without these, by white space."""
    words = (word.strip().strip("\"'") for word in line.split(_separator(line)))
    return tuple(_ALIASES.get(name, name) for name in words)


def _blank(comment: re.Match[bytes]) -> bytes:
    """Return white space in place of a comment, with its line ends, so that line numbers are kept."""
    return b" " + b"\n" * comment[0].count(b"\n")


def _mistake(path: Path, text: bytes, position: int, expected: str) -> Mistake:
    """Return the error at a position of the text: the line, the text found and the text expected."""
    line = text[position : position + 60].split(b"\n")[0].decode(errors="replace")
    return _unexpected(path, text.count(b"\n", 0, position) + 1, line, expected)


def _unexpected(path: Path, number: int, line: str, expected: str) -> Mistake:
    return Mistake(str(path), number, f"found '{line.strip()[:60] or 'the end of the file'}'. {expected}.")
