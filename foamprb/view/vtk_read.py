"""Reader of the ``.vtp`` files that foamprb writes. It checks all sizes, where VTK's reader crashes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from foamprb.compile.link import compiled
from foamprb.results.reading import open_regular

Table = dict[str, NDArray[Any]]
Bytes = NDArray[np.uint8]

_MOST_HEAD, _LARGEST_RATIO = 64 << 20, 255
"""Largest size of the head of a file, and largest ratio of LZ4's compression."""
_MARK = b'<AppendedData encoding="raw">\n   _'
_SIZES = {"Int": (1, 2, 4, 8), "UInt": (1, 2, 4, 8), "Float": (4, 8)}
_TYPES = {f"{name}{8 * n}": f"<{name[0].lower()}{n}" for name, sizes in _SIZES.items() for n in sizes}


class PolyFile(NamedTuple):
    """Points and lines of a file, with their arrays and texts by name."""

    points: NDArray[Any]
    """(n, 3)."""
    arrays: Table
    """(n,) or (n, components), at the points."""
    start: NDArray[np.int64]
    """(m + 1,): first entry of each line in ``order``, and its length."""
    order: NDArray[np.int64]
    """Indices of the points of the lines."""
    of_lines: Table
    """(m,) or (m, components)."""
    texts: Mapping[str, Sequence[str]]


def read_own(path: Path, wanted: Collection[str] | None = None) -> PolyFile:
    """Read a file that foamprb wrote, with all arrays at its points or some of them.

    Raises
    ------
    ValueError
        The file differs from all that foamprb writes.
    """
    with open_regular(path) as file:
        head = b""
        while _MARK not in head:
            more = file.read(1 << 16)
            head += more
            if not more or len(head) > _MOST_HEAD:
                raise ValueError("its data have no beginning")
        head = head.partition(_MARK)[0]
        data = _Data(file, len(head) + len(_MARK), path.stat().st_size)
        root = ElementTree.fromstring(head + b"</VTKFile>")
        if (root.get("compressor"), root.get("header_type")) != ("vtkLZ4DataCompressor", "UInt32"):
            raise ValueError("its data have another form")
        texts = {
            e.attrib["Name"]: tuple(data.read(e).tobytes().decode().split("\0")[:-1])
            for e in root.findall("PolyData/FieldData/Array")
        }
        pieces = [_piece(piece, data, wanted) for piece in root.findall("PolyData/Piece")]
        return joined(pieces)._replace(texts=texts)


def joined(parts: Sequence[PolyFile]) -> PolyFile:
    """Return pieces with the same arrays as one; ValueError if they have others, or several have lines."""
    filled = [part for part in parts if len(part.points)] or [*parts[:1]]
    if not filled or any(part.arrays.keys() != filled[0].arrays.keys() for part in filled):
        raise ValueError("its pieces have different arrays")
    if len(filled) == 1:
        return filled[0]
    if any(len(part.order) for part in filled):
        raise ValueError("several pieces have lines")
    arrays = {name: np.concatenate([part.arrays[name] for part in filled]) for name in filled[0].arrays}
    return filled[0]._replace(points=np.concatenate([part.points for part in filled]), arrays=arrays)


def _piece(piece: Any, data: _Data, wanted: Collection[str] | None) -> PolyFile:
    n, m = (_count(piece.attrib[f"NumberOf{what}"]) for what in ("Points", "Lines"))

    def table(part: str, rows: int | None, names: Collection[str] | None = None) -> Table:
        entries = [(e.attrib["Name"], e) for e in piece.findall(f"{part}/DataArray")]
        return {name: data.array(e, rows) for name, e in entries if names is None or name in names}

    points = table("Points", n).get("Points", np.zeros((0, 3)))
    lines = table("Lines", None if m else 0)
    start, order = np.append(np.int64(0), lines["offsets"]), lines["connectivity"]
    is_whole = len(start) == m + 1 and start[-1] == len(order) and bool((np.diff(start) >= 0).all())
    if not is_whole or points.shape != (n, 3) or not ((order >= 0) & (order < n)).all():
        raise ValueError("its lines or points have other numbers")
    return PolyFile(
        points, table("PointData", n, wanted), start, order, table("CellData", m) if m else {}, {}
    )


class _Data:
    """Compressed data of a file of some size, from a place on."""

    def __init__(self, file: BinaryIO, begin: int, size: int) -> None:
        self._file, self._begin, self._size = file, begin, size

    def array(self, entry: Any, rows: int | None) -> NDArray[Any]:
        """Return an array with some rows, or with any number for None; without components it has one axis."""
        kind, components = (
            np.dtype(_TYPES[entry.attrib["type"]]),
            _count(entry.get("NumberOfComponents", "1")),
        )
        row = kind.itemsize * max(components, 1)
        values = self.read(entry, None if rows is None else rows * row, row).view(kind)
        return values.reshape(-1, components) if components > 1 else values

    def read(self, entry: Any, size: int | None = None, row: int = 1) -> Bytes:
        """Return the bytes of an entry; ValueError if they are not of the size, or no rows."""
        place = self._begin + _count(entry.attrib["offset"])
        n, block, last = (*self._numbers(place, 1), *self._numbers(place + 4, 2)) if size != 0 else (0, 0, 0)
        packed = self._numbers(place + 12, n)
        total = (n - 1) * block + (last or block) if n else 0
        if total > _LARGEST_RATIO * sum(packed) or total % row or total != (total if size is None else size):
            raise ValueError(f"an array has {total} bytes")
        result, done, decompress = np.empty(total, dtype=np.uint8), 0, compiled(expand)
        self._file.seek(place + 12 + 4 * n)
        for k, length in enumerate(packed):
            part = result[done : total if k == n - 1 else done + block]
            done += len(part)
            source = np.frombuffer(bytearray(self._file.read(min(length, self._size))), dtype=np.uint8)
            if len(source) != length or decompress(source, part) != len(part):
                raise ValueError("a block of data is damaged")
        return result

    def _numbers(self, place: int, n: int) -> list[int]:
        if place + 4 * n > self._size:
            raise ValueError("it ends too early")
        self._file.seek(place)
        return [int(number) for number in np.frombuffer(self._file.read(4 * n), dtype="<u4")]


def _count(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 19):
        raise ValueError(f"'{text[:20]}' is no count")
    return int(text)


def expand(source: Bytes, target: Bytes) -> int:
    """Decompress a block of LZ4; return the number of bytes, −1 if it is damaged or too long."""
    i, o, n, m = 0, 0, len(source), len(target)
    while i < n:
        token = int(source[i])
        i += 1
        for which in range(2):
            length = token >> 4 if which == 0 else token & 15
            back = 0
            if which == 1:
                if i + 2 > n:
                    return -1
                back = int(source[i]) + 256 * int(source[i + 1])
                i += 2
            if length == 15:
                more = 255
                while more == 255:
                    if i >= n:
                        return -1
                    more = int(source[i])
                    i += 1
                    length += more
            if which == 0:
                if i + length > n or o + length > m:
                    return -1
                for _ in range(length):
                    target[o] = source[i]
                    o += 1
                    i += 1
                if i == n:
                    return o
            else:
                length += 4
                if back == 0 or back > o or o + length > m:
                    return -1
                for _ in range(length):
                    target[o] = target[o - back]
                    o += 1
    return -1
