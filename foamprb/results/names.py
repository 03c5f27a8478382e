"""File names from names in settings and meshes: allowed characters, and escapes for the others.

Settings name clouds, cloud functions, injection models and regions; a mesh names patches. No such name may
lead out of the folder of the results.
"""

from __future__ import annotations

import re
import zlib

__all__ = ["fault_of_word", "file_name"]

_MOST_BYTES = 200
"""Longest name: file systems allow 255, and suffixes and temporary names need some."""
_NO_WORD = re.compile(r"""[\s"'/\\;{}]""")


def fault_of_word(name: str) -> str:
    """Return why a name is not a valid OpenFOAM word and file name; empty if it is."""
    if not name:
        return "it is empty"
    if found := _NO_WORD.search(name):
        return f"it contains {found[0]!r}"
    if not name.isprintable():
        return "it contains a character that cannot be printed"
    if name.startswith("."):
        return "it begins with a dot"
    if len(name.encode()) > _MOST_BYTES:
        return f"it is longer than {_MOST_BYTES} bytes"
    return ""


def file_name(name: str) -> str:
    """Return a file name: the name itself if it is a word, else with escapes such as ``%2F`` for ``/``.

    Different names have different file names.
    """
    if not fault_of_word(name) and "%" not in name:
        return name
    octets = name.encode(errors="surrogateescape")
    escaped = "".join(chr(octet) if octet in _PLAIN else f"%{octet:02X}" for octet in octets)
    if len(escaped) <= _MOST_BYTES:
        return escaped
    return f"{escaped[: _MOST_BYTES - 20]}%{zlib.crc32(octets):08X}"


_PLAIN = frozenset(b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+:,=@~")
