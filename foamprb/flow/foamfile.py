"""OpenFOAM's own files of lists and fields, ascii or binary, compressed or not, in double precision."""

from __future__ import annotations

import gzip
import re
import zlib
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError

Floats: TypeAlias = NDArray[np.float64]
Labels: TypeAlias = NDArray[np.int64]

__all__ = [
    "Patch",
    "VectorField",
    "existing",
    "header",
    "read_boundary",
    "read_bytes",
    "read_faces",
    "read_field",
    "read_labels",
    "read_vectors",
]

_HEADER_BYTES = 4096
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_BLANK = re.compile(rb"(?:\s+|//[^\n]*|/\*.*?\*/)*", re.DOTALL)
_NOTE = re.compile(rb"//[^\n]*|/\*.*?\*/", re.DOTALL)
_WORD = re.compile(rb'"(?:[^"\\]|\\.)*"|[^\s(){};"]+')
_COUNT = re.compile(rb"\d+")
_NUMBERS = re.compile(rb"[^()]*")
_COMPONENTS = {b"label": 1, b"scalar": 1, b"vector": 3, b"sphericalTensor": 1, b"symmTensor": 6, b"tensor": 9}


class Patch(NamedTuple):
    """A patch of ``polyMesh/boundary``."""

    name: str
    type: str
    faces: int
    start: int
    entries: dict[str, str]
    """All its entries, as they stand in the file."""


class VectorField(NamedTuple):
    """A ``volVectorField``."""

    cells: Floats
    """(n_cells, 3), or (1, 3) if they are all alike."""
    patches: dict[str, tuple[str, Floats | None]]
    """Type, and the values if there are any: (n_faces, 3), or (1, 3) if they are all alike."""


class _File:
    """A file's bytes, and how far they have been read."""

    def __init__(self, path: Path) -> None:
        found = existing(path)
        if found is None:
            raise InputError(f"{path}: no such file.")
        self.path, self.data = found, read_bytes(found)
        entries = header(found)
        self.kind, self.binary = entries.get("class", ""), entries.get("format") == "binary"
        arch = entries.get("arch", "")
        order = ">" if arch.startswith("MSB") else "<"
        self._label = np.dtype(f"{order}i{8 if 'label=64' in arch else 4}")
        self._scalar = np.dtype(f"{order}f{4 if 'scalar=32' in arch else 8}")
        end = re.search(rb"FoamFile\s*\{.*?\}", self.data, re.DOTALL)
        self.at = end.end() if end else 0
        self._skip()

    def broken(self, what: str) -> InputError:
        line = self.data.count(b"\n", 0, self.at) + 1
        return InputError(f"{self.path}: line {line}: {what} expected; the file is broken or cut short.")

    def _skip(self) -> None:
        match = _BLANK.match(self.data, self.at)
        self.at = match.end() if match else self.at

    def take(self, text: bytes) -> bool:
        """Whether the text comes next; it is then passed."""
        found = self.data.startswith(text, self.at)
        if found:
            self.at += len(text)
            self._skip()
        return found

    def need(self, text: bytes) -> None:
        if not self.take(text):
            raise self.broken(f"'{text.decode()}'")

    def word(self) -> bytes:
        match = _WORD.match(self.data, self.at)
        if match is None:
            raise self.broken("a word")
        self.at = match.end()
        self._skip()
        return match[0]

    def count(self) -> int:
        """A number of entries; what follows it is not touched, as it may be binary."""
        match = _COUNT.match(self.data, self.at)
        if match is None:
            raise self.broken("a number of entries")
        self.at = match.end()
        return int(match[0])

    def list(self, components: int, *, labels: bool = False) -> NDArray[Any]:
        """A list (n, components), its number of entries first."""
        n = self.count()
        dtype = self._label if labels else self._scalar
        wide = np.int64 if labels else np.float64
        if n == 0:
            self._skip()
            if self.take(b"("):
                self.need(b")")
            return np.zeros((0, components), dtype=wide)
        if not self.binary or self._is_uniform():
            self._skip()
            if self.take(b"{"):
                one = self._numbers(1, components, b"}")
                return np.repeat(one, n, axis=0).astype(wide)
            self.need(b"(")
            return self._numbers(n, components, b")").astype(wide)
        begin = self.data.find(b"(", self.at) + 1
        end = begin + n * components * dtype.itemsize
        if begin == 0 or self.data[end : end + 1] != b")":
            raise self.broken(f"a list of {n} entries in binary")
        self.at = end + 1
        self._skip()
        values = np.frombuffer(self.data, dtype, n * components, begin)
        return values.reshape(n, components).astype(wide)

    def _is_uniform(self) -> bool:
        match = _BLANK.match(self.data, self.at)
        return match is not None and self.data[match.end() : match.end() + 1] == b"{"

    def _numbers(self, n: int, components: int, closing: bytes) -> Floats:
        """Numbers in ascii up to the closing bracket, which is passed; vectors in brackets of their own."""
        if components > 1:
            end = re.compile(rb"\)\s*" + re.escape(closing)).search(self.data, self.at)
            stop = end.start() if end else self.data.find(closing, self.at)
            after = end.end() if end else stop + 1
        else:
            stop = self.data.find(closing, self.at)
            after = stop + 1
        if stop < 0:
            raise self.broken(f"'{closing.decode()}'")
        text = _NOTE.sub(b" ", self.data[self.at : stop]).translate(bytes.maketrans(b"()", b"  "))
        try:
            values = np.array(text.split(), dtype=np.float64)
        except ValueError:
            raise self.broken("a list of numbers") from None
        if len(values) != n * components:
            raise self.broken(f"a list of {n} entries, not {len(values) / components:g},")
        self.at = after
        self._skip()
        return values.reshape(n, components)

    def value(self) -> Floats | None:
        """The vectors after ``uniform`` or ``nonuniform``; None for anything else, which is passed."""
        found = None
        while not self.take(b";"):
            if self.take(b"nonuniform"):
                kind = self.word() if not _COUNT.match(self.data, self.at) else b"List<vector>"
                inner = kind[5:-1]
                if inner not in _COMPONENTS:
                    raise self.broken("List<vector>")
                read = self.list(_COMPONENTS[inner], labels=inner == b"label")
                found = read if inner == b"vector" else None
            elif self.take(b"uniform") and self.take(b"("):
                found = self._numbers(3, 1, b")").reshape(1, 3) if self._three() else None
            elif self.at >= len(self.data):
                raise self.broken("';'")
            elif self.data[self.at : self.at + 1] in (b"(", b")", b"{", b"}"):
                self.take(self.data[self.at : self.at + 1])
            else:
                self.word()
        return found

    def _three(self) -> bool:
        match = _NUMBERS.match(self.data, self.at)
        return match is not None and len(match[0].split()) == 3

    def dictionary(self) -> tuple[dict[str, str], dict[str, Floats | None]]:
        """Plain entries, and fields of vectors, of a dictionary whose opening brace has been passed."""
        entries: dict[str, str] = {}
        fields: dict[str, Floats | None] = {}
        while not self.take(b"}"):
            key = self.word().decode("utf-8", "replace")
            if self.take(b"{"):
                self.dictionary()
                continue
            begin = self.at
            field = self.value()
            if field is None:
                entries[key] = self.data[begin : self.at].decode("latin-1").strip().rstrip(";").strip()
            else:
                fields[key] = field
        return entries, fields


def read_labels(path: Path) -> Labels:
    """Read a ``labelList``, (n,).

    Raises
    ------
    InputError
        The file is missing or broken.
    """
    return _File(path).list(1, labels=True)[:, 0]


def read_vectors(path: Path) -> Floats:
    """Read a ``vectorField``, (n, 3); raise InputError if it is missing or broken."""
    values: Floats = _File(path).list(3)
    return values


def read_faces(path: Path) -> tuple[Labels, Labels]:
    """Read a ``faceList`` or a ``faceCompactList``: where each face's points begin, (n + 1,), and the points.

    Raises
    ------
    InputError
        The file is missing or broken.
    """
    file = _File(path)
    if file.kind == "faceCompactList":
        start = file.list(1, labels=True)[:, 0]
        points = file.list(1, labels=True)[:, 0]
        if len(start) == 0 or start[0] != 0 or start[-1] != len(points) or np.any(np.diff(start) < 0):
            raise InputError(f"{file.path}: the lengths of the faces do not fit their points.")
        return start, points
    n = file.count()
    text = _NOTE.sub(b" ", file.data[file.at :]).translate(bytes.maketrans(b"()", b"  "))
    try:
        numbers = np.array(text.split(), dtype=np.int64)
    except ValueError:
        raise file.broken("a list of faces") from None
    sizes = np.empty(n, dtype=np.int64)
    at = 0
    for face in range(n):
        if at >= len(numbers):
            raise file.broken(f"a list of {n} faces")
        sizes[face] = numbers[at]
        at += 1 + int(numbers[at])
    if at != len(numbers):
        raise file.broken(f"a list of {n} faces")
    start = np.concatenate([[0], np.cumsum(sizes)])
    kept = np.ones(len(numbers), dtype=bool)
    kept[start[:-1] + np.arange(n)] = False
    return start, numbers[kept]


def read_boundary(path: Path) -> list[Patch]:
    """Read the patches of ``polyMesh/boundary``; raise InputError if it is missing or broken."""
    file = _File(path)
    file.count()
    file._skip()
    file.need(b"(")
    patches = []
    while not file.take(b")"):
        name = file.word().decode("utf-8", "replace").strip('"')
        file.need(b"{")
        entries, _ = file.dictionary()
        numbers = [entries.get(key, "") for key in ("nFaces", "startFace")]
        if "type" not in entries or not all(number.isdigit() for number in numbers):
            raise InputError(f"{file.path}: patch {name} lacks its type, nFaces or startFace.")
        patches.append(Patch(name, entries["type"], int(numbers[0]), int(numbers[1]), entries))
    return patches


def read_field(path: Path) -> VectorField:
    """Read a ``volVectorField``; raise InputError if it is missing, broken, or another field."""
    file = _File(path)
    if file.kind != "volVectorField":
        raise InputError(f"{file.path}: the class is {file.kind or '(none)'}, not volVectorField.")
    cells: Floats | None = None
    patches: dict[str, tuple[str, Floats | None]] | None = None
    while file.at < len(file.data):
        key = file.word()
        if key == b"boundaryField":
            patches = _patch_fields(file)
        elif file.take(b"{"):
            file.dictionary()
        elif key == b"internalField":
            cells = file.value()
        else:
            file.value()
    if cells is None or patches is None:
        raise InputError(
            f"{file.path}: no internalField of vectors and boundaryField; the file is cut short."
        )
    return VectorField(cells, patches)


def _patch_fields(file: _File) -> dict[str, tuple[str, Floats | None]]:
    file.need(b"{")
    patches = {}
    while not file.take(b"}"):
        name = file.word().decode("utf-8", "replace").strip('"')
        file.need(b"{")
        entries, fields = file.dictionary()
        patches[name] = entries.get("type", ""), fields.get("value")
    return patches


def header(path: Path) -> dict[str, str]:
    """Entries of the FoamFile header; empty when there is none."""
    text = read_bytes(path, _HEADER_BYTES).decode("latin-1")
    match = re.search(r"FoamFile\s*\{(.*?)\}", _COMMENT.sub(" ", text), re.DOTALL)
    if match is None:
        return {}
    entries = re.findall(r'(\w+)\s+("[^"]*"|[^;]*);', match[1])
    return {key: value.strip().strip('"') for key, value in entries}


def existing(path: Path) -> Path | None:
    """The file itself, or its compressed form."""
    zipped = path.with_name(path.name + ".gz")
    return path if path.is_file() else zipped if zipped.is_file() else None


def read_bytes(path: Path, limit: int = -1) -> bytes:
    """The file's bytes, or the first of them, decompressed; raise InputError if it cannot be read."""
    try:
        with gzip.open(path) if path.suffix == ".gz" else path.open("rb") as stream:
            return stream.read(limit)
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(f"{path}: cannot be read: {error}.") from None
