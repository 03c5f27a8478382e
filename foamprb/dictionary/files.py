"""OpenFOAM's files on disk, plain or compressed."""

from __future__ import annotations

import errno
import gzip
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from foamprb.errors import InputError

MOST_UNPACKED, MOST_RATIO = 256 << 20, 200
"""Size up to which every compressed file is read, bytes, and the largest ratio of larger ones."""
_PIECE = 1 << 20
"""Bytes that are decompressed at a time."""


def existing(path: Path) -> Path | None:
    """Return the file itself, else its compressed form ``.gz``, else None, in OpenFOAM's order.

    Raises
    ------
    InputError
        If the folder may not be read.
    """
    for form in (path, _compressed(path)):
        if _is_file(form):
            return form
    return None


def read_bytes(path: Path, limit: int = -1) -> bytes:
    """Read the file's bytes, decompressed, up to a limit."""
    try:
        if path.suffix != ".gz":
            with path.open("rb") as stream:
                return stream.read(limit)
        most = max(MOST_UNPACKED, MOST_RATIO * path.stat().st_size)
        with gzip.open(path) as stream:
            if limit >= 0:
                return stream.read(limit)
            # In pieces, as a call takes memory for all bytes that it is asked for.
            data = BytesIO()
            while data.tell() <= most and (piece := stream.read(_PIECE)):
                data.write(piece)
        if data.tell() <= most:
            return data.getvalue()
        raise InputError(
            f"{path}: holds more than {MOST_RATIO} times its size, {most >> 20} MiB; is it damaged? Allowed "
            f"after gunzip {path.name}."
        )
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(f"{path}: cannot be read: {error}.") from None


@contextmanager
def opened(path: Path) -> Iterator[BinaryIO]:
    """Open a file to read some of its bytes, decompressed; see :func:`read_bytes`."""
    if path.suffix == ".gz":
        yield BytesIO(read_bytes(path))
        return
    try:
        with path.open("rb") as stream:
            yield stream
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error}.") from None


def _compressed(path: Path) -> Path:
    return path.with_name(path.name + ".gz")


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError as error:
        if error.errno == errno.ENAMETOOLONG:
            return False
        raise InputError(f"{path}: cannot be read: {error.strerror}.") from None
