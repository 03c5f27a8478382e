"""OpenFOAM's files of lists, ascii or binary, compressed or not, in double precision."""

from __future__ import annotations

import os
import re
import warnings
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.compile.link import link
from foamprb.dictionary.files import existing, opened, read_bytes
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.lists import MOST_INDICES, int32, starts

Labels: TypeAlias = NDArray[np.int64]

HEADER_BYTES = 4096
"""Number of bytes that hold the header of a file and the count of its first list."""
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_BLANK = re.compile(rb"(?:\s+|//[^\n]*|/\*.*?\*/)*", re.DOTALL)
_BLOCK = re.compile(_BLANK.pattern + rb"(\d+)\s*\(", re.DOTALL)
_NOTE = re.compile(rb"//[^\n]*|/\*.*?\*/", re.DOTALL)
_WORD = re.compile(rb'"(?:[^"\\]|\\.)*"|[^\s(){};"]+')
_COUNT = re.compile(rb"(?:List<\w+>\s*)?(\d+)")
COMPONENTS = {b"label": 1, b"scalar": 1, b"vector": 3, b"sphericalTensor": 1, b"symmTensor": 6, b"tensor": 9}
_MOST_UNPACKED = 1 << 22
"""Bytes of a compressed file up to which it is unpacked for a look at its end."""
_ENDS = [re.compile(rb"%b\s*(?://[^\n]*\s*)*\Z" % bracket) for bracket in (rb"\}", rb"\)")]
"""Ends of a field and of a collated one, perhaps before comments."""
_MOST_ENTRIES = 1 << 31
_NO_BRACKETS = bytes.maketrans(b"()", b"  ")


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

    def __init__(self, path: Path, data: bytes | None = None, entries: dict[str, str] | None = None) -> None:
        """Read a file; or take ``data``, a part of a file, and the ``entries`` of its header."""
        file = existing(path)
        if file is None:
            raise InputError(f"{path}: no such file.")
        self.path, self.data = file, read_bytes(file) if data is None else data
        entries = entries or header(file)
        self.kind, self.binary = entries.get("class", ""), entries.get("format") == "binary"
        arch = entries.get("arch", "")
        order = ">" if arch.startswith("MSB") else "<"
        self.label = np.dtype(f"{order}i{8 if 'label=64' in arch else 4}")
        self._scalar = np.dtype(f"{order}f{4 if 'scalar=32' in arch else 8}")
        end = re.search(rb"FoamFile\s*\{.*?\}", self.data[:HEADER_BYTES], re.DOTALL)
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
        comes = self.data.startswith(text, self.at)
        if comes:
            self.at += len(text)
            self.skip()
        return comes

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
        if int(match[1]) > _MOST_ENTRIES:
            raise self.broken(f"a number of entries up to {_MOST_ENTRIES}")
        return int(match[1])

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
        numbers = self._parsed(at.begin, at.end, wide)
        if numbers is None:
            kind = "numbers" if wide is np.float64 else "whole numbers"
            raise self.broken(f"a list of {kind}", at.begin)
        if len(numbers) != n * at.components:
            raise self.broken(f"a list of {n} entries, not {len(numbers) / at.components:g},", at.begin)
        values = numbers.reshape(n, at.components)
        # A view that cannot be written to has other compiled functions.
        return np.broadcast_to(values, (at.n, at.components)) if at.uniform else values

    def indices(self) -> Ints:
        """Return a list of labels (n,) as 32-bit integers."""
        at = self.locate(1, self.label)
        if at.binary and at.dtype == np.dtype("<i4"):
            return np.frombuffer(self.data, at.dtype, at.n, at.begin).astype(np.int32)
        return self.narrowed(self.numbers(at)[:, 0], at.begin)

    def narrowed(self, labels: Labels, at: int) -> Ints:
        """Return labels as 32-bit integers; InputError with the position ``at`` if one is too large."""
        if len(labels) and max(-int(labels.min()), int(labels.max())) > MOST_INDICES:
            raise self.broken(f"a list of labels up to {MOST_INDICES}", at)
        return int32(labels)

    def _parsed(self, begin: int, end: int, dtype: type) -> NDArray[Any] | None:
        """Return the numbers between two positions of a text; None if there is anything but numbers."""
        text = self.data[begin:end]
        if b"/" in text:
            text = _NOTE.sub(b" ", text)
        text = text.translate(_NO_BRACKETS)
        if not text.strip():
            return np.empty(0, dtype=dtype)
        with warnings.catch_warnings():
            # NumPy warns of a text that it could not read to its end.
            warnings.simplefilter("error")
            try:
                return np.fromstring(text, dtype=dtype, sep=" ")
            except (ValueError, DeprecationWarning):
                return None

    def faces(self) -> tuple[Ints, Ints]:
        """Return the start of each face's points, (n + 1,), and the points."""
        if self.kind == "faceCompactList":
            start, points = self.indices(), self.indices()
            if len(start) == 0 or start[0] != 0 or start[-1] != len(points) or np.any(np.diff(start) < 0):
                raise InputError(f"{self.path}: the lengths of the faces do not fit their points.")
            return start, points
        n = self.count()
        begin = self.at
        wrong = self.broken(f"a list of {n} faces", begin)
        if self.binary:
            self.skip()
            self.need(b"(")
            lists = [self.indices() for _ in range(n)]
            self.need(b")")
            return int32(starts(np.array([len(face) for face in lists], dtype=np.intp))), np.concatenate(
                lists
            )
        numbers = self._parsed(begin, self.data.rfind(b")"), np.int64)
        if numbers is None or n > len(numbers):
            raise wrong
        start, points = np.empty(n + 1, dtype=np.int32), np.empty(len(numbers) - n, dtype=np.int32)
        if not link(_part_faces)(self.narrowed(numbers, begin), start, points):
            raise wrong
        return start, points

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


def _part_faces(numbers: Ints, start: Ints, points: Ints) -> bool:
    """Part faces, each with its number of points before it; return False if they do not fill the arrays."""
    n, at, to = start.shape[0] - 1, 0, 0
    for f in range(n):
        start[f] = to
        size = numbers[at] if at < numbers.shape[0] else -1
        if size < 0 or to + size > points.shape[0] or at + size >= numbers.shape[0]:
            return False
        for k in range(size):
            points[to + k] = numbers[at + 1 + k]
        at, to = at + 1 + size, to + size
    start[n] = to
    return bool(at == numbers.shape[0])


def read_vectors(path: Path) -> Floats:
    """Read a ``vectorField``, (n, 3); raise InputError if it is missing or broken."""
    values: Floats = FoamFile(path).list(3)
    return values


def read_cell_zones(path: Path | FoamFile) -> dict[str, Labels]:
    """Read the cells of each zone from ``polyMesh/cellZones``."""
    file = path if isinstance(path, FoamFile) else FoamFile(path)
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


def read_blocks(path: Path, data: bool = True) -> list[FoamFile]:
    """Read a collated file, which holds a file of each processor, of which only the first has a header.

    Without ``data`` the files are empty: it is only checked whether the file is complete.
    """
    files: list[FoamFile] = []
    entries = header(path)
    with opened(path) as stream:
        at = FoamFile(path, stream.read(HEADER_BYTES), entries).at
        while True:
            stream.seek(at)
            text = stream.read(HEADER_BYTES)
            if _BLANK.fullmatch(text):
                return files
            match = _BLOCK.match(text)
            n, begin = (int(match[1]), at + match.end()) if match else (0, at)
            stream.seek(begin)
            block = stream.read(n) if data else b""
            stream.seek(begin + n)
            if match is None or stream.read(1) != b")":
                raise InputError(
                    f"{path}: byte {at}: the file of processor {len(files)}, {n} bytes, expected; the file "
                    "is broken or cut short."
                )
            files.append(FoamFile(path, block, entries))
            at = begin + n + 1


def damage(path: Path) -> str:
    """Return missing, empty, cut off or unreadable for such a file, by its first and last bytes; else ''."""
    file = existing(path)
    if file is None:
        return "missing"
    if file.suffix == ".gz" and file.stat().st_size > _MOST_UNPACKED:
        return ""
    try:
        with opened(file) as stream:
            first = stream.read(HEADER_BYTES)
            stream.seek(max(0, stream.seek(0, os.SEEK_END) - HEADER_BYTES))
            last = stream.read()
        collated = b"decomposedBlockData" in first
        if collated:
            read_blocks(file, data=False)
    except InputError:
        return "unreadable"
    if b"FoamFile" not in first:
        return "cut off" if first.strip() else "empty"
    return "" if _ENDS[collated].search(last) else "cut off"


def header(path: Path) -> dict[str, str]:
    """Return the entries of the FoamFile header, in a collated file of the first part; empty without one."""
    text = _COMMENT.sub(" ", read_bytes(path, HEADER_BYTES).decode("latin-1"))
    headers = re.findall(r"FoamFile\s*\{(.*?)\}", text, re.DOTALL)
    for match in headers:
        entries = {
            key: value.strip().strip('"') for key, value in re.findall(r'(\w+)\s+("[^"]*"|[^;]*);', match)
        }
        if entries.get("class") != "decomposedBlockData":
            return entries
    return {}
