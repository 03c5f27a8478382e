"""Check of ``.vtp`` files before VTK reads them: VTK trusts their headers, and may crash on damaged ones."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import BinaryIO
from xml.etree import ElementTree

from foamprb.results.reading import open_regular

_HEAD, _DATA = b'compressor="vtkLZ4DataCompressor"', b'<AppendedData encoding="raw">'
_BYTES = {"Int8": 1, "UInt8": 1, "Int16": 2, "UInt16": 2, "Int32": 4, "UInt32": 4, "Int64": 8, "UInt64": 8,
          "Float32": 4, "Float64": 8}  # fmt: skip
_MOST_HEADER, _CHUNK = 1 << 24, 1 << 16
_CELLS = ("Verts", "Lines", "Strips", "Polys")


def is_compressed(path: Path) -> bool:
    """Return whether a file has the form in which foamprb writes VTK's files."""
    with open_regular(path) as file:
        return _HEAD in file.read(300)


def require_sizes(path: Path) -> None:
    """Check that the sizes in the header of a compressed ``.vtp`` file match its data.

    Raises
    ------
    ValueError
        If they are not, or the header cannot be read; with the reason.
    """
    with path.open("rb") as file:
        head = _head(file)
        start = head.find(_DATA)
        first = head.find(b"_", start + len(_DATA)) + 1
        if start < 0 or first == 0:
            raise ValueError("it has no data")
        root = ElementTree.fromstring(head[:start] + b"</VTKFile>")
        order = {"LittleEndian": "<", "BigEndian": ">"}.get(root.get("byte_order", ""))
        word = {"UInt32": "I", "UInt64": "Q"}.get(root.get("header_type", ""))
        pieces = root.findall("PolyData/Piece")
        if order is None or word is None or not pieces:
            raise ValueError("its header cannot be read")
        end = path.stat().st_size
        sections: list[tuple[ElementTree.Element, dict[str, int]]] = [
            (section, {}) for section in root.findall("PolyData/FieldData")
        ]
        for piece in pieces:
            counts = {name: int(piece.get(f"NumberOf{name}", "0")) for name in ("Points", *_CELLS)}
            counts |= {"PointData": counts["Points"], "CellData": sum(counts[name] for name in _CELLS)}
            sections += [(section, counts) for section in piece]
        places = []
        for section, counts in sections:
            for array in (*section.iter("DataArray"), *section.iter("Array")):
                name, kind, at = (array.get(key, "") for key in ("Name", "type", "offset"))
                size, last = _extent(file, first + int(at), end, order + word)
                places.append((int(at), last - first))
                tuples = int(array.get("NumberOfTuples", str(counts.get(section.tag, -1))))
                expected = tuples * int(array.get("NumberOfComponents", "1")) * _BYTES.get(kind, 0)
                if kind != "String" and name != "connectivity" and size != expected:
                    raise ValueError(f"{name or section.tag} has {size} bytes of data, not {expected}")
        places.sort()
        begins, ends = ([place[k] for place in places] for k in (0, 1))
        if begins != [0, *ends[:-1]]:
            raise ValueError("its header does not match its data")


def _head(file: BinaryIO) -> bytes:
    """Return the beginning of a file with the header, and some of the data."""
    head = bytearray()
    while (chunk := file.read(_CHUNK)) and len(head) < _MOST_HEADER:
        has_data = _DATA in head
        head += chunk
        if has_data:
            break
    return bytes(head)


def _extent(file: BinaryIO, at: int, end: int, word: str) -> tuple[int, int]:
    """Return the size of the decompressed data at a place of a file, and the place after its last block."""
    n = struct.calcsize(word)
    if not 0 <= at <= end - n:
        raise ValueError("it is cut short")
    file.seek(at)
    (blocks,) = struct.unpack(word, file.read(n))
    head = n * (3 + blocks)
    if at + head > end:
        raise ValueError("it is cut short")
    size, last, *packed = struct.unpack(f"{word[0]}{2 + blocks}{word[1]}", file.read(head - n))
    if (after := at + head + sum(packed)) > end:
        raise ValueError("it is cut short")
    return int((blocks - 1) * size + (last or size)) if blocks else 0, after
