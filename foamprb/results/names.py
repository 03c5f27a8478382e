"""Names that become names of files: which ones may, and how others are escaped.

A user names clouds, cloud functions, injection models and regions, a mesh names patches. None of these names
may lead out of the folder of the results, or replace a file in it.
"""

from __future__ import annotations

import re
import zlib

__all__ = ["fault_of_folder", "fault_of_word", "file_name"]

_MOST_BYTES = 200
"""Of a name: file systems allow 255, of which suffixes and temporary names take some."""
_RESULTS = frozenset(
    {
        *("checkpoint", "manifest", "manifest.json", "run.json"),
        *(f"{table}.{kind}" for table in ("fates", "failed") for kind in ("csv", "parquet")),
    }
)
"""What a run writes into the cloud's folder, beside the series of the cloud."""
_NO_WORD = re.compile(r"""[\s"'/\\;{}]""")


def fault_of_word(name: str) -> str:
    """Return why a name is no word of OpenFOAM that can be the name of a file; nothing if it is one."""
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


def fault_of_folder(name: str, cloud: str) -> str:
    """Return why a folder in that of a cloud's results cannot have a name; nothing if it can."""
    series = re.compile(re.escape(cloud) + r"(\.pvd|\.py|_\d{6,}.*)")
    if name in _RESULTS or series.fullmatch(name):
        return "the results have a file of that name"
    return fault_of_word(name)


def file_name(name: str) -> str:
    """Return a name for a file: as it is if it is a word, else with escapes, ``%2F`` for ``/``.

    Different names stay different.
    """
    if not fault_of_word(name) and "%" not in name:
        return name
    octets = name.encode(errors="surrogateescape")
    escaped = "".join(chr(octet) if octet in _PLAIN else f"%{octet:02X}" for octet in octets)
    if len(escaped) <= _MOST_BYTES:
        return escaped
    return f"{escaped[: _MOST_BYTES - 20]}%{zlib.crc32(octets):08X}"


_PLAIN = frozenset(b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+:,=@~")
