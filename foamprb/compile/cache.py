"""Cache of compiled code on disk, one file for each function and each set of types of its arguments.

The name of a file depends on the code, not on its place, so that another installation of the same source
finds it. Each file has a checksum, as damaged machine code crashes the process. Only files that the user or
root wrote are read, as compiled code can do anything.

Code that cannot be read, or is not trusted, is compiled again; if it cannot be written, in each process.
Neither ends a run.

A wheel may contain code as well, which is trusted as its Python code is, and only read.
"""

from __future__ import annotations

import hashlib
import logging
import os
import pickle
import secrets
import stat
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

import platformdirs

__all__ = ["SUPPLIED", "Store", "cache_directory"]

log = logging.getLogger("foamprb")

SUPPLIED = Path(__file__).with_name("supplied")
"""Folder of the code that came with the package, laid out as the cache; absent in a clone."""
_SUFFIX = ".code"
_MAGIC = b"foamprb compiled code 1\n"
_WRITABLE_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class _Dump(Protocol):
    def __call__(self, data: Any, /) -> bytes: ...


def cache_directory() -> Path:
    """Return the folder of the cache: ``$FOAMPRB_CACHE_DIR``, else ``foamprb`` in the user's cache folder."""
    folder = os.environ.get("FOAMPRB_CACHE_DIR")
    return Path(folder) if folder else Path(platformdirs.user_cache_dir("foamprb", appauthor=False))


class Store:
    """Files of one function.

    Parameters
    ----------
    name
        Name of its folder in :func:`cache_directory`. It must change with the code of the function and of its
        callees, and with everything else that changes the machine code.
    dump
        Converts a value to bytes for ``pickle.loads``.
    """

    def __init__(self, name: str, dump: _Dump = pickle.dumps) -> None:
        self._name, self._dump = name, dump
        self._root = cache_directory()
        self.folder = self._root / name

    def __bool__(self) -> bool:
        """Return True if there is a file in a trusted folder."""
        folders = (SUPPLIED / self._name, *([self.folder] if self._trusted() else []))
        return any(True for folder in folders for _ in folder.glob(f"*{_SUFFIX}"))

    def load(self, key: Any) -> Any:
        """Return the value saved under ``key``; None if there is no trusted one."""
        file = self._file(key)
        data = _supplied(self._name, file.name) or (_read(file, self._root) if self._trusted() else b"")
        # It may name a class that no longer exists.
        with suppress(Exception):
            saved_key, value = pickle.loads(data)
            return value if saved_key == (self._name, key) else None
        return None

    def save(self, key: Any, value: Any) -> None:
        """Write or replace the file of a key atomically."""
        try:
            _make(self._root)
            if self._trusted():
                _make(self.folder)
                _write(self._file(key), self._dump(((self._name, key), value)))
        except OSError as error:
            _tell(self._root, logging.INFO, f"is not complete: {error.strerror}")
        except (pickle.PickleError, AttributeError, ImportError, TypeError):
            # Another process could not import a part of it.
            pass

    def flush(self) -> None:
        """Remove all files of the function."""
        for file in self.folder.glob(f"*{_SUFFIX}"):
            file.unlink(missing_ok=True)

    def _file(self, key: Any) -> Path:
        return self.folder / f"{hashlib.sha256(repr(key).encode()).hexdigest()[:24]}{_SUFFIX}"

    def _trusted(self) -> bool:
        """Return True unless another user may write to one of the folders."""
        return all(_is_trusted(folder, folder.stat, self._root) for folder in (self._root, self.folder))


def _is_trusted(path: Path, status_of: Callable[[], os.stat_result], root: Path) -> bool:
    """Return True if only the user and root may have written a file or folder; warn if not."""
    try:
        status = status_of()
    except OSError:
        return True
    if status.st_uid not in (0, os.geteuid()):
        _tell(root, logging.WARNING, f"is not used: {path} belongs to another user")
    elif status.st_mode & _WRITABLE_BY_OTHERS:
        _tell(root, logging.WARNING, f"is not used: others may write to {path} (chmod go-w helps)")
    else:
        return True
    return False


def _read(file: Path, root: Path) -> bytes:
    """Return the content of a file after its checksum; empty if it is damaged or not trusted."""
    try:
        # Do not block on a pipe.
        descriptor = os.open(file, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return b""
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode) or not _is_trusted(file, lambda: status, root):
            return b""
        with os.fdopen(descriptor, "rb", closefd=False) as opened:
            data = opened.read()
    except OSError:
        return b""
    finally:
        os.close(descriptor)
    return _checked(data)


def _supplied(folder: str, name: str) -> bytes:
    """Return the content of a file that came with the package; empty if it is absent or damaged."""
    try:
        return _checked((SUPPLIED / folder / name).read_bytes())
    except OSError:
        return b""


def _checked(data: bytes) -> bytes:
    """Return the data after its checksum; empty if they differ."""
    head, data = data[: len(_MAGIC) + 32], data[len(_MAGIC) + 32 :]
    return data if head == _MAGIC + hashlib.sha256(data).digest() else b""


def _write(file: Path, data: bytes) -> None:
    temporary = file.with_name(f".{file.name}.{secrets.token_hex(4)}.tmp")
    descriptor = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, _mode(0o644))
    try:
        with os.fdopen(descriptor, "wb") as opened:
            opened.write(_MAGIC + hashlib.sha256(data).digest() + data)
        temporary.replace(file)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _make(folder: Path) -> None:
    """Make a folder to which only the user may write, if it is absent."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    folder.mkdir(mode=_mode(0o755), exist_ok=True)


def _mode(for_all: int) -> int:
    """Return permissions of a new file; others may read files of root, e.g. in the image of a container."""
    return for_all if os.geteuid() == 0 else for_all & 0o700


_told: set[tuple[Path, int]] = set()


def _tell(root: Path, level: int, what: str) -> None:
    """Log once in a process that a cache is unusable."""
    if (root, level) not in _told:
        _told.add((root, level))
        log.log(level, "The compiled code in %s %s", root, what)
