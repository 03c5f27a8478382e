"""Files that exist whole or not at all."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_SUFFIX = ".tmp"


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Give a temporary file to write; on leaving without an error it becomes ``path`` in one step.

    Whatever happens meanwhile, a full disk or a killed process included, ``path`` holds either what it held
    before or all of what was written. The folder of ``path`` is made if it is absent. An error inside the
    context removes the temporary file; a killed process leaves it behind, for :func:`remove_unfinished`.

    Yields
    ------
    The temporary file, empty, in the folder of ``path``: on one file system, where renaming is one step.

    Raises
    ------
    OSError
        If the file cannot be written or renamed.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}{_SUFFIX}")
    try:
        temporary.touch(exist_ok=False)
        yield temporary
        _flush(temporary, os.O_RDWR)
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    # Without this the new name itself may be lost when the power fails.
    _flush(path.parent, os.O_RDONLY)


def remove_unfinished(path: Path) -> None:
    """Remove the temporary files that killed processes left for ``path``."""
    start, end = f".{path.name}.", _SUFFIX
    for file in path.parent.iterdir() if path.parent.is_dir() else ():
        if file.name.startswith(start) and file.name.endswith(end):
            file.unlink(missing_ok=True)


def _flush(path: Path, flags: int) -> None:
    descriptor = os.open(path, flags)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
