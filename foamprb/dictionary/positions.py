"""Files of positions for ``manualInjection``: OpenFOAM's list, or a table of plain numbers."""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.constraints import Bounds
from foamprb.dictionary.mistakes import Mistake
from foamprb.errors import InputError, suggestion

__all__ = ["Positions", "read_positions"]

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
_SEPARATOR = rb"(?:[ \t]*+[,;][ \t]*+|[ \t]++)"
_CELL = rb"(?:\"[^\"\n]*+\"|[^,;\n]*+)"
_SEPARATORS = bytes.maketrans(b",;", b"  ")
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

    Raises
    ------
    InputError
        If the file cannot be read, is neither, or holds a number that is not finite or out of its bounds;
        with the line.
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
    if commented and set(_COORDINATES) <= set(_words(commented[1].rstrip())):
        data = data.replace(b"#", b" ", 1)
    text = _COMMENT_IN_TABLE.sub(b"", data)
    first = len(text) - len(text.lstrip())
    line = text[first:].split(b"\n", 1)[0].rstrip()
    names: Sequence[str] = _COORDINATES
    body = first
    if not re.fullmatch(rb"%b(?:%b%b)*+" % (_NUMBER, _SEPARATOR, _NUMBER), line):
        names = _names(path, text, first, line, columns)
        body = first + len(line)
    known = (*_COORDINATES, *columns)
    cells = [_NUMBER if name in known else _CELL if re.search(rb"[,;]", line) else rb"\S++" for name in names]
    row = rb"[ \t]*+%b[ \t\r]*+" % _SEPARATOR.join(cells)
    rows = re.compile(rb"\s*+(?:%b(?:\n\s*+|\Z))*+" % row)
    match = rows.match(text, body)
    end = match.end() if match else body
    if end < len(text):
        # Until Python 3.11.4 a match may end within a row that does not fit.
        end = max(body, text.rfind(b"\n", 0, end) + 1)
        expected = f"{len(names)} numbers, {' '.join(names)}"
        hint = "" if names is not _COORDINATES else ", or a first line with the names of the columns"
        raise _mistake(path, text, end, f"Expected: {expected}{hint}")
    if ignored := [name for name in names if name not in known]:
        log.info("%s: ignored columns: %s.", path, ", ".join(ignored))
        names = [name for name in names if name in known]
        used = rb"[ \t]*+%b[ \t\r]*+" % _SEPARATOR.join(b"(%b)" % c if c is _NUMBER else c for c in cells)
        numbers = np.array(re.findall(used, text[body:end]), dtype=np.float64)
    else:
        numbers = np.array(text[body:end].translate(_SEPARATORS).split(), dtype=np.float64)
    values = dict(zip(names, numbers.reshape(-1, len(names)).T, strict=True))
    for name, column in values.items():
        bounds = columns.get(name, _FINITE)
        if len(column) and not (bounds.admits(column.min()) and bounds.admits(column.max())):
            wrong = next(k for k, value in enumerate(column) if not bounds.admits(value))
            at = _start_of_row(text, body, wrong)
            raise _mistake(path, text, at, f"Expected: for {name}, {bounds.text}")
    x = np.stack([values.pop(name) for name in _COORDINATES], axis=1)
    return Positions(x, {name: column.copy() for name, column in values.items()})


def _names(path: Path, text: bytes, at: int, line: bytes, columns: Mapping[str, Bounds]) -> tuple[str, ...]:
    """Read the names of columns."""
    names = _words(line)
    known = (*_COORDINATES, *columns)
    if not line:
        raise _mistake(path, text, at, "Expected: a list ( (x y z) (x y z) … ), or lines x y z")
    if not set(names) & set(known):
        # The text is not quoted: a foreign case may name any file.
        line_number = text.count(b"\n", 0, at) + 1
        expected = "Expected: a list ( (x y z) (x y z) … ), or lines x y z."
        raise Mistake(str(path), line_number, f"no positions. {expected}")
    for name in names:
        # Not an ignored column, but a mistake.
        if name not in known and name.lower() in {word.lower() for word in known}:
            raise _mistake(path, text, at, f"There is no column {name}. {suggestion(name, known)[:-1]}")
        if name in known and names.count(name) > 1:
            raise _mistake(path, text, at, f"The column {name} appears twice")
    for name in _COORDINATES:
        if name not in names:
            found = suggestion(name, names)[:-1]
            raise _mistake(path, text, at, f"The column {name} is missing. {found}")
    return names


def _words(line: bytes) -> tuple[str, ...]:
    """Return the words of a line, separated by commas or semicolons or, without these, by white space."""
    words = re.split(rb"[,;]", line) if re.search(rb"[,;]", line) else line.split()
    found = (word.decode(errors="replace").strip().strip("\"'") for word in words)
    return tuple(_ALIASES.get(name, name) for name in found)


def _start_of_row(text: bytes, body: int, row: int) -> int:
    """Return the position of a row of a table; blank lines do not count."""
    starts = (match.start() for match in re.finditer(rb"\S[^\n]*+", text[body:]))
    return body + next(start for index, start in enumerate(starts) if index == row)


def _blank(comment: re.Match[bytes]) -> bytes:
    """Return white space in place of a comment, with its line ends, so that line numbers are kept."""
    return b" " + b"\n" * comment[0].count(b"\n")


def _mistake(path: Path, text: bytes, position: int, expected: str) -> Mistake:
    """Return the error at a position of the text: the line, the text found and the text expected."""
    line = text.count(b"\n", 0, position) + 1
    found = text[position : position + 60].split(b"\n")[0].decode(errors="replace").strip()
    return Mistake(str(path), line, f"found '{found or 'the end of the file'}'. {expected}.")
