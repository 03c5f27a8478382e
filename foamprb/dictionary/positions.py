"""OpenFOAM's file of positions for ``manualInjection``."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError

_NUMBER = rb"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?"
# Possessive throughout, so that a broken file is refused in linear time.
_ROWS = re.compile(rb"(?:\s*+\(\s*+%b\s++%b\s++%b\s*+\))*+\s*+" % (_NUMBER, _NUMBER, _NUMBER))
_COMMENT = re.compile(rb"//[^\n]*+|/\*.*?\*/", re.DOTALL)
_HEADER = re.compile(rb"\s*+(?:FoamFile\s*+\{[^}]*+\})?+\s*+")
_OPENING = re.compile(rb"(\d{1,18}+)?\s*+\(")
_PARENTHESES = bytes.maketrans(b"()", b"  ")


def read_positions(path: Path) -> NDArray[np.float64]:
    """Read the positions of a file ``( (x y z) (x y z) … )``, a FoamFile header and a count before it or not.

    Returns
    -------
    Array of shape (n, 3), m.

    Raises
    ------
    InputError
        If the file cannot be read, is not such a list, or holds a number that is not finite; with the line.
    """
    try:
        text = _COMMENT.sub(_blank, path.read_bytes())
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}.") from error
    header = _HEADER.match(text)
    start = header.end() if header else 0
    opening = _OPENING.match(text, start)
    if opening is None:
        raise _mistake(path, text, start, "Expected: a list ( (x y z) (x y z) … )")
    rows = _ROWS.match(text, opening.end())
    end = rows.end() if rows else opening.end()
    if text[end : end + 1] != b")":
        raise _mistake(path, text, end, "Expected: (x y z), three numbers, or the list's closing )")
    if text[end + 1 :].strip():
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


def _blank(comment: re.Match[bytes]) -> bytes:
    """White space instead of a comment, with its line ends, so that line numbers stay."""
    return b" " + b"\n" * comment[0].count(b"\n")


def _mistake(path: Path, text: bytes, position: int, expected: str) -> InputError:
    """Say what stands at a position of the text, in which line, and what should."""
    line = text.count(b"\n", 0, position) + 1
    found = text[position : position + 60].split(b"\n")[0].decode(errors="replace").strip()
    return InputError(f"{path}, line {line}: found '{found or 'the end of the file'}'. {expected}.")
