"""Atomic writing: a file is complete or absent."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import secrets
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from foamprb.errors import InputError

_TOKEN_BYTES = 4
_TEMPORARY = re.compile(rf"\.(.+)\.[0-9a-f]{{{2 * _TOKEN_BYTES}}}\.tmp")
_before: ContextVar[Callable[[Path], object]] = ContextVar("_before", default=lambda _: None)
"""Called with the name of a file before it is written."""


@contextmanager
def before_each_file(call: Callable[[Path], object]) -> Iterator[None]:
    """Call a function with the name of each file that this thread writes, before it is begun."""
    token = _before.set(call)
    try:
        yield
    finally:
        _before.reset(token)


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary file; rename it to ``path`` when the context ends without an error.

    Even after a full disk or a killed process ``path`` holds either its earlier contents or all of the new
    ones. The folder of ``path`` is made if it is absent, but not its parents: a case that is moved while
    its results are written is not begun anew at its old place. An error inside the context removes the
    temporary file. A killed process leaves it behind; :func:`remove_unfinished` removes it.

    Yields
    ------
    The temporary file, empty, in the folder of ``path``, as renaming is atomic within one file system.

    Raises
    ------
    OSError
        If the file cannot be written or renamed; it names ``path``.
    """
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(_TOKEN_BYTES)}.tmp")
    _before.get()(path)
    try:
        path.parent.mkdir(exist_ok=True)
        temporary.touch(exist_ok=False)
        yield temporary
        _flush(temporary, os.O_RDWR)
        temporary.replace(path)
        # Otherwise the new name may be lost when the power fails.
        _flush(path.parent, os.O_RDONLY)
    except BaseException as error:
        temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno and error.filename in (None, temporary, str(temporary)):
            # The error of a write has no file name, and users do not know the temporary one.
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def refuse_other_kind(path: Path, *beginnings: bytes) -> None:
    """Refuse to replace an existing file that is not of the kind to be written, as an input of the user.

    Raises
    ------
    InputError
        If the file has contents, and begins otherwise.
    """
    if path.is_file():
        with path.open("rb") as file:
            head = file.read(max(map(len, beginnings)))
        if head and not head.startswith(beginnings):
            raise InputError(f"{path}: a file of another kind, which is kept. Choose another name.")


def write_text(path: Path, text: str) -> None:
    """Write a text file in one step; OSError as :func:`atomic_write`."""
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def replace_end(path: Path, end: bytes, text: bytes) -> None:
    """Write a text over the end of a file, and flush it; after an error the file has its old end.

    The cost does not depend on the size of the file. A killed process may leave a part of the text.

    Raises
    ------
    OSError
        If the file cannot be written; it names ``path``.
    """
    with path.open("r+b", buffering=0) as file:
        place = file.seek(-len(end), os.SEEK_END)
        try:
            if file.write(text) != len(text):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            _flush(path, os.O_RDWR)
        except OSError as error:
            file.truncate(place)
            file.seek(place)
            file.write(end)
            if error.errno and error.filename is None:
                raise OSError(error.errno, error.strerror, str(path)) from error
            raise


def remove_unfinished(files: Collection[Path]) -> None:
    """Remove the temporary files that killed processes left of some files."""
    for folder in {file.parent for file in files}:
        for file in tuple(folder.iterdir()) if folder.is_dir() else ():
            if unfinished(file) in files:
                file.unlink(missing_ok=True)


def unfinished(file: Path) -> Path | None:
    """Return the file that a temporary file was to become; None for another file."""
    match = _TEMPORARY.fullmatch(file.name)
    return file.with_name(match[1]) if match else None


@contextmanager
def only_writer(folder: Path) -> Iterator[None]:
    """Lock a folder for this process, which ends the lock; make the folder if it is absent.

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
            # Some network file systems have no locks; the run does not depend on them.
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
