"""OpenFOAM's files of lists, ascii or binary, compressed or not, in double precision."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing, read_bytes
from foamprb.errors import InputError
from foamprb.flow.base import Floats

Labels: TypeAlias = NDArray[np.int64]

_HEADER_BYTES = 4096
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_BLANK = re.compile(rb"(?:\s+|//[^\n]*|/\*.*?\*/)*", re.DOTALL)
_NOTE = re.compile(rb"//[^\n]*|/\*.*?\*/", re.DOTALL)
_WORD = re.compile(rb'"(?:[^"\\]|\\.)*"|[^\s(){};"]+')
_COUNT = re.compile(rb"\d+")
COMPONENTS = {b"label": 1, b"scalar": 1, b"vector": 3, b"sphericalTensor": 1, b"symmTensor": 6, b"tensor": 9}
_MOST_ENTRIES = 1 << 31


class ListAt(NamedTuple):
    """Position of a list of numbers in a file."""

    n: int
    components: int
    dtype: np.dtype[Any]
    """Type in binary; in ascii it distinguishes integers from other numbers."""
    begin: int
    end: int
    binary: bool
    uniform: bool
    """True if one entry stands for all, ``4{7}``."""


class FoamFile:
    """Bytes of a file, and the position up to which they have been read."""

    def __init__(self, path: Path) -> None:
        found = existing(path)
        if found is None:
            raise InputError(f"{path}: no such file.")
        self.path, self.data = found, read_bytes(found)
        entries = header(found)
        self.kind, self.binary = entries.get("class", ""), entries.get("format") == "binary"
        arch = entries.get("arch", "")
        order = ">" if arch.startswith("MSB") else "<"
        self.label = np.dtype(f"{order}i{8 if 'label=64' in arch else 4}")
        self._scalar = np.dtype(f"{order}f{4 if 'scalar=32' in arch else 8}")
        end = re.search(rb"FoamFile\s*\{.*?\}", self.data, re.DOTALL)
        self.at = end.end() if end else 0
        self.skip()

    def broken(self, what: str, at: int | None = None) -> InputError:
        """Return the error that something else is expected here, or at another position, with the line."""
        line = self.data.count(b"\n", 0, self.at if at is None else at) + 1
        return InputError(f"{self.path}: line {line}: {what} expected; the file is broken or cut short.")

    def skip(self) -> None:
        """Skip blanks and comments."""
        match = _BLANK.match(self.data, self.at)
        self.at = match.end() if match else self.at

    def take(self, text: bytes) -> bool:
        """Skip the text if it comes next; return True if it does."""
        found = self.data.startswith(text, self.at)
        if found:
            self.at += len(text)
            self.skip()
        return found

    def need(self, text: bytes) -> None:
        """Skip the text; InputError if it does not come next."""
        if not self.take(text):
            raise self.broken(f"'{text.decode()}'")

    def word(self) -> bytes:
        """Return the next word."""
        match = _WORD.match(self.data, self.at)
        if match is None:
            raise self.broken("a word")
        self.at = match.end()
        self.skip()
        return match[0]

    def count(self) -> int:
        """Return a number of entries; blanks after it are not skipped, as binary data may follow."""
        match = _COUNT.match(self.data, self.at)
        if match is None:
            raise self.broken("a number of entries")
        self.at = match.end()
        if int(match[0]) > _MOST_ENTRIES:
            raise self.broken(f"a number of entries up to {_MOST_ENTRIES}")
        return int(match[0])

    def labels(self) -> Labels:
        """Return a list of labels (n,), whose number of entries comes first."""
        values: Labels = self.list(1, self.label)[:, 0]
        return values

    def list(self, components: int, binary: np.dtype[Any] | None = None) -> NDArray[Any]:
        """Return a list (n, components), whose number of entries comes first; binary scalars by default."""
        return self.numbers(self.locate(components, binary))

    def locate(self, components: int, binary: np.dtype[Any] | None = None) -> ListAt:
        """Skip a list, and return its position; see :meth:`list`."""
        n = self.count()
        dtype = self._scalar if binary is None else binary
        if n == 0:
            self.skip()
            if self.take(b"("):
                self.need(b")")
            return ListAt(0, components, dtype, self.at, self.at, False, False)
        if self.binary and not self._is_uniform():
            begin = self.data.find(b"(", self.at) + 1
            end = begin + n * components * dtype.itemsize
            if begin == 0 or self.data[end : end + 1] != b")":
                raise self.broken(f"a list of {n} entries in binary")
            self.at = end + 1
            self.skip()
            return ListAt(n, components, dtype, begin, end, True, False)
        self.skip()
        uniform = self.take(b"{")
        if not uniform:
            self.need(b"(")
        begin, closing = self.at, b"}" if uniform else b")"
        # The last of several components has a bracket of its own.
        last = re.compile(rb"\)\s*" + re.escape(closing)).search(self.data, begin) if components > 1 else None
        end = last.start() if last else self.data.find(closing, begin)
        after = last.end() if last else end + 1
        if end < 0:
            raise self.broken(f"'{closing.decode()}'")
        self.at = after
        self.skip()
        return ListAt(n, components, dtype, begin, end, False, uniform)

    def numbers(self, at: ListAt) -> NDArray[Any]:
        """Return the numbers (n, components) of a list."""
        wide = np.float64 if at.dtype.kind == "f" else np.int64
        if at.n == 0:
            return np.zeros((0, at.components), dtype=wide)
        if at.binary:
            values = np.frombuffer(self.data, at.dtype, at.n * at.components, at.begin)
            return values.reshape(-1, at.components).astype(wide)
        n = 1 if at.uniform else at.n
        text = _NOTE.sub(b" ", self.data[at.begin : at.end]).translate(bytes.maketrans(b"()", b"  "))
        try:
            found: NDArray[Any] = np.array(text.split(), dtype=wide)
        except (ValueError, OverflowError):
            kind = "numbers" if wide is np.float64 else "whole numbers"
            raise self.broken(f"a list of {kind}", at.begin) from None
        if len(found) != n * at.components:
            raise self.broken(f"a list of {n} entries, not {len(found) / at.components:g},", at.begin)
        return np.broadcast_to(found.reshape(n, at.components), (at.n, at.components))

    def _is_uniform(self) -> bool:
        match = _BLANK.match(self.data, self.at)
        return match is not None and self.data[match.end() : match.end() + 1] == b"{"

    def skip_entry(self) -> None:
        """Skip the value of a key and the semicolon."""
        while not self.take(b";"):
            if self.data[self.at : self.at + 1] in (b"(", b")", b"{", b"}"):
                self.take(self.data[self.at : self.at + 1])
            else:
                self.word()


def require_room(path: Path) -> None:
    """Raise InputError if a file is too short for the stated number of entries."""
    file = FoamFile(path)
    n = file.count()
    if n > len(file.data):
        raise file.broken(f"a number of entries that the file has room for, not {n},")


def read_labels(path: Path) -> Labels:
    """Read a ``labelList``, (n,).

    Raises
    ------
    InputError
        The file is missing or broken.
    """
    return FoamFile(path).labels()


def read_vectors(path: Path) -> Floats:
    """Read a ``vectorField``, (n, 3); raise InputError if it is missing or broken."""
    values: Floats = FoamFile(path).list(3)
    return values


def read_faces(path: Path) -> tuple[Labels, Labels]:
    """Read a ``faceList`` or ``faceCompactList``: the start of each face's points, (n + 1,), and the points.

    Raises
    ------
    InputError
        The file is missing or broken.
    """
    file = FoamFile(path)
    if file.kind == "faceCompactList":
        start, points = file.labels(), file.labels()
        if len(start) == 0 or start[0] != 0 or start[-1] != len(points) or np.any(np.diff(start) < 0):
            raise InputError(f"{file.path}: the lengths of the faces do not fit their points.")
        return start, points
    n = file.count()
    text = _NOTE.sub(b" ", file.data[file.at :]).translate(bytes.maketrans(b"()", b"  "))
    try:
        numbers = np.array(text.split(), dtype=np.int64)
    except (ValueError, OverflowError):
        raise file.broken("a list of faces") from None
    sizes = np.empty(n, dtype=np.int64)
    at = 0
    for face in range(n):
        if at >= len(numbers):
            raise file.broken(f"a list of {n} faces")
        sizes[face] = numbers[at]
        at += 1 + max(int(numbers[at]), 0)
    if at != len(numbers):
        raise file.broken(f"a list of {n} faces")
    start = np.concatenate([[0], np.cumsum(sizes)])
    is_point = np.ones(len(numbers), dtype=bool)
    is_point[start[:-1] + np.arange(n)] = False
    return start, numbers[is_point]


def read_cell_zones(path: Path) -> dict[str, Labels]:
    """Read the cells of each zone from ``polyMesh/cellZones``.

    Raises
    ------
    InputError
        The file is missing or broken.
    """
    file = FoamFile(path)
    n = file.count()
    file.skip()
    file.need(b"(")
    zones: dict[str, Labels] = {}
    while not file.take(b")"):
        name = file.word().decode("utf-8", "replace").strip('"')
        file.need(b"{")
        cells: Labels | None = None
        while not file.take(b"}"):
            if file.word() == b"cellLabels":
                # An empty zone in binary is just 0.
                file.take(b"List<label>")
                cells = file.labels()
                file.need(b";")
            else:
                file.skip_entry()
        if cells is None:
            raise InputError(f"{file.path}: zone {name} has no cellLabels.")
        zones[name] = cells
    if len(zones) != n:
        raise InputError(f"{file.path}: only {len(zones)} of {n} zones could be read.")
    return zones


def header(path: Path) -> dict[str, str]:
    """Return the entries of the FoamFile header; empty without a header."""
    text = read_bytes(path, _HEADER_BYTES).decode("latin-1")
    match = re.search(r"FoamFile\s*\{(.*?)\}", _COMMENT.sub(" ", text), re.DOTALL)
    if match is None:
        return {}
    entries = re.findall(r'(\w+)\s+("[^"]*"|[^;]*);', match[1])
    return {key: value.strip().strip('"') for key, value in entries}
