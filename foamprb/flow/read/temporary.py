"""Temporary folders that are removed even if their process is killed: by the next one."""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
import weakref
from pathlib import Path

__all__ = ["temporary_folder"]

_PREFIX = "foamprb-temporary-"
_LOCK = ".lock"
"""A file in each such folder, by which it is known and held."""


def temporary_folder(owner: object) -> Path:
    """A new temporary folder, which is removed when its owner is.

    A process that is killed leaves its folder behind. But a file in it is locked as long as the process
    lives: folders with such a file that no process locks any more are removed here, and no others.
    """
    _remove_left()
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
        descriptor = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o600)
        # Before it was locked, another process may have removed it as one left behind.
        if _lock(descriptor) and (folder / _LOCK).exists():
            weakref.finalize(owner, _remove, folder, descriptor)
            return folder
        os.close(descriptor)


def _lock(descriptor: int) -> bool:
    """Lock a file, if nobody has; where the file system has no locks, as if it were done."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        pass
    return True


def _remove(folder: Path, descriptor: int) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    os.close(descriptor)


def _remove_left() -> None:
    """Remove the folders that no process holds."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        try:
            descriptor = os.open(folder / _LOCK, os.O_RDWR | os.O_NOFOLLOW)
        except OSError:
            # Somebody else's, of another kind, or gone.
            continue
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(descriptor)
        else:
            _remove(folder, descriptor)
