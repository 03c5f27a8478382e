"""Zones of cells: ``polyMesh/cellZones`` of a case, which VTK's reader gives without the cells' numbers."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError

_COMMENT = re.compile(rb"/\*.*?\*/|//[^\n]*", re.DOTALL)
_HEADER = re.compile(rb"FoamFile\s*\{(.*?)\}", re.DOTALL)
_ZONE = re.compile(rb"\s*([^\s{}();]+)\s*\{")
_LABELS = re.compile(rb"[^{}]*?\bcellLabels\s+List<label>\s*(\d+)\s*([({])?")
_REST = re.compile(rb"[^{}()]*\}")


def parse_cell_zones(text: bytes, path: Path) -> Mapping[str, NDArray[np.int64]]:
    """Read the cells of each zone from the bytes of a file ``cellZones``, ascii or binary.

    Raises
    ------
    InputError
        If the file is broken, or cut short.
    """
    header = _HEADER.search(text)
    entries = header[1] if header else b""
    binary = re.search(rb"format\s+binary", entries) is not None
    width = 8 if re.search(rb"label=64", entries) else 4
    if not binary:
        text = _COMMENT.sub(b" ", text)
        header = _HEADER.search(text)
    opening = re.compile(rb"[^(]*?(\d+)\s*\(").search(text, header.end() if header else 0)
    if opening is None:
        raise InputError(f"{path}: no list of zones could be read.")
    zones: dict[str, NDArray[np.int64]] = {}
    at = opening.end()
    for _ in range(int(opening[1])):
        name = _ZONE.match(text, at)
        labels = _LABELS.match(text, name.end()) if name else None
        if name is None or labels is None:
            raise InputError(f"{path}: only {len(zones)} of {int(opening[1])} zones could be read.")
        word = name[1].decode("utf-8", "replace").strip('"')
        cells, at = _labels(text, labels, f"<i{width}" if binary else None)
        rest = _REST.match(text, at)
        if cells is None or rest is None:
            raise InputError(f"{path}: the cells of zone {word} could not be read; the file is broken.")
        zones[word] = cells
        at = rest.end()
    return zones


def _labels(text: bytes, found: re.Match[bytes], kind: str | None) -> tuple[NDArray[Any] | None, int]:
    """The labels of one zone and where they end; None if they are not what their number says."""
    n, start = int(found[1]), found.end()
    if found[2] is None:
        return (np.empty(0, dtype=np.int64) if n == 0 else None), start
    if kind is not None and found[2] == b"(":
        end = start + n * np.dtype(kind).itemsize
        if text[end : end + 1] != b")":
            return None, start
        return np.frombuffer(text[start:end], dtype=kind).astype(np.int64), end + 1
    end = text.find(b")" if found[2] == b"(" else b"}", start)
    words = text[start:end].split() if end >= 0 else []
    if not all(word.isdigit() for word in words):
        return None, start
    cells = np.array(words, dtype=np.int64)
    # Equal labels may be written once: 5{0}.
    cells = np.repeat(cells, n) if found[2] == b"{" and len(cells) == 1 else cells
    return (cells if len(cells) == n else None), end + 1
