"""Checksums of ``.vtp`` files: VTK trusts what it reads, and crashes on damaged files."""

from __future__ import annotations

import re
from pathlib import Path

import xxhash

from foamprb.results.reading import open_regular

__all__ = ["is_sealed", "seal"]

_SEAL = "<!-- xxh3 {} -->\n"
_PATTERN = re.compile(rb"<!-- xxh3 ([0-9a-f]{16}) -->\n")
_LENGTH, _CHUNK = len(_SEAL.format("0" * 16)), 1 << 20


def seal(path: Path) -> None:
    """Append the checksum of a file as a comment, which readers of VTK's files ignore."""
    with path.open("r+b") as file:
        digest = xxhash.xxh3_64()
        while chunk := file.read(_CHUNK):
            digest.update(chunk)
        file.write(_SEAL.format(digest.hexdigest()).encode())


def is_sealed(path: Path) -> bool:
    """Return whether a file ends with its checksum, as foamprb writes it.

    Raises
    ------
    ValueError
        If the checksum is that of another content.
    """
    with open_regular(path) as file:
        left = max(0, path.stat().st_size - _LENGTH)
        digest = xxhash.xxh3_64()
        while left and (chunk := file.read(min(left, _CHUNK))):
            digest.update(chunk)
            left -= len(chunk)
        match = _PATTERN.fullmatch(file.read())
    if match is None:
        return False
    if match[1] != digest.hexdigest().encode():
        raise ValueError("its checksum is that of another content")
    return True
