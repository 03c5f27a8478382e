"""Files that are written in one step: they exist whole or not at all."""

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
    """Give a temporary file to write; when the context ends without an error it becomes ``path`` in one step.

    Even after a full disk or a killed process ``path`` holds either what it held before or all of what was
    written. The folder of ``path`` is made if it is absent. An error inside the context removes the temporary
    file; a killed process leaves it behind, and :func:`remove_unfinished` removes it.

    Yields
    ------
    The temporary file, empty, in the folder of ``path``: on one file system, where renaming is one step.

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
        # Without this the new name itself may be lost when the power fails.
        _flush(path.parent, os.O_RDONLY)
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno and error.filename in (None, temporary, str(temporary)):
            # A write does not know its file, and the temporary one means nothing to the user.
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def forget(path: Path) -> None:
    """Let the operating system give up its copy in memory of a file that is on disk.

    Before the next file of a series is written, this is where its memory comes from: to take memory that was
    not in use can cost several times what the copy does. Advice, which not all file systems take; a file that
    is not there has no copy.
    """
    with suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
        finally:
            os.close(descriptor)


def remove_unfinished(folder: Path) -> None:
    """Remove the temporary files that killed processes left in a folder, if there is one."""
    for file in tuple(folder.iterdir()) if folder.is_dir() else ():
        if _TEMPORARY.fullmatch(file.name):
            file.unlink(missing_ok=True)


@contextmanager
def only_writer(folder: Path) -> Iterator[None]:
    """Lock a folder, which is made if it is absent, for this process; the lock ends with the process.

    Raises
    ------
    InputError
        If another process has locked the folder.
    OSError
        If there can be no such folder.
    """
    folder.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise InputError(f"{folder}: another run is writing here.") from error
        except OSError:
            # Some network file systems have no locks; the run is as good without.
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
