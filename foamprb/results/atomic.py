"""Atomic writing of files: a file exists completely or not at all."""

from __future__ import annotations

import fcntl
import os
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from foamprb.errors import InputError

_TOKEN_BYTES = 4
_TEMPORARY = re.compile(rf"\..+\.[0-9a-f]{{{2 * _TOKEN_BYTES}}}\.tmp")


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary file, renamed to ``path`` if the context ends without an error.

    Even after a full disk or a killed process ``path`` has either its previous contents or all of the new
    ones. The folder of ``path`` is made if absent. An error inside the context removes the temporary file;
    after a killed process :func:`remove_unfinished` removes it.

    Yields
    ------
    The empty temporary file in the folder of ``path``: on one file system, where renaming is atomic.

    Raises
    ------
    OSError
        If the file cannot be written or renamed; it names ``path``.
    """
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(_TOKEN_BYTES)}.tmp")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.touch(exist_ok=False)
        yield temporary
        _flush(temporary, os.O_RDWR)
        temporary.replace(path)
        # Without this a power failure may lose the new name itself.
        _flush(path.parent, os.O_RDONLY)
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno and error.filename in (None, temporary, str(temporary)):
            # The error of a write names no file, and the temporary one is of no use to the user.
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def forget(path: Path) -> None:
    """Drop a file from the page cache of the operating system.

    The next file of a series reuses this memory; allocation of unused memory can cost several times as much
    as the copy. This is advice, ignored by some file systems. A missing file is ignored.
    """
    with suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
        finally:
            os.close(descriptor)


def remove_unfinished(folder: Path) -> None:
    """Remove the temporary files of killed processes in a folder, if it exists."""
    for file in tuple(folder.iterdir()) if folder.is_dir() else ():
        if _TEMPORARY.fullmatch(file.name):
            file.unlink(missing_ok=True)


@contextmanager
def only_writer(folder: Path) -> Iterator[None]:
    """Lock a folder, made if absent, for this process; the lock ends with the process.

    Raises
    ------
    InputError
        If another process has locked the folder.
    OSError
        If the folder cannot be made.
    """
    folder.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise InputError(f"{folder}: another run is writing here.") from error
        except OSError:
            # Some network file systems have no locks; the run continues without.
            pass
        yield
    finally:
        os.close(descriptor)


def _flush(path: Path, flags: int) -> None:
    descriptor = os.open(path, flags)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
