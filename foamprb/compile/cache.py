"""The cache: compiled code on disk, one file for each function and each set of types of its arguments.

A file is found by what the code does, not by where its source lies, so that another installation of the same
source has it too. Nothing is read back from it before two questions are answered. Is it whole? It carries a
checksum: damaged machine code, once it is loaded, crashes the process. Who could have written it? Whoever may
write compiled code decides what the program does, so that only the user and root may.

What cannot be read, or is not trusted, is compiled anew; what cannot be written is compiled anew in each
process. Neither ends a run.
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

__all__ = ["Store", "cache_directory"]

log = logging.getLogger("foamprb")

_SUFFIX = ".code"
_MAGIC = b"foamprb compiled code 1\n"
_WRITABLE_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class _Dump(Protocol):
    def __call__(self, data: Any, /) -> bytes: ...


def cache_directory() -> Path:
    """Folder of the cache: ``$FOAMPRB_CACHE_DIR``, else ``foamprb`` in the user's cache folder."""
    chosen = os.environ.get("FOAMPRB_CACHE_DIR")
    return Path(chosen) if chosen else Path(platformdirs.user_cache_dir("foamprb", appauthor=False))


class Store:
    """The files of one function.

    Parameters
    ----------
    name
        Of its folder in :func:`cache_directory`; it changes with the function's code, with all that it calls
        and with whatever else makes another machine code of it.
    dump
        Turns what is saved into bytes that ``pickle.loads`` reads.
    """

    def __init__(self, name: str, dump: _Dump = pickle.dumps) -> None:
        self._name, self._dump = name, dump
        self._root = cache_directory()
        self.folder = self._root / name

    def __bool__(self) -> bool:
        """Whether there is a file that may be used."""
        return self._trusted() and any(self.folder.glob(f"*{_SUFFIX}"))

    def load(self, key: Any) -> Any:
        """What was saved under ``key``; None if there is nothing, or nothing that may be used."""
        if not self._trusted():
            return None
        data = _read(self._file(key), self._root)
        # Whole as it is, it may name a class that has gone since.
        with suppress(Exception):
            found, value = pickle.loads(data)
            return value if found == (self._name, key) else None
        return None

    def save(self, key: Any, value: Any) -> None:
        """Write a file, in place of one of the same key, so that no other process sees a part of it."""
        try:
            _make(self._root)
            if self._trusted():
                _make(self.folder)
                _write(self._file(key), self._dump(((self._name, key), value)))
        except OSError as error:
            _tell(self._root, logging.INFO, f"is not complete: {error.strerror}")
        except (pickle.PickleError, AttributeError, ImportError, TypeError):
            # It names what another process could not import.
            pass

    def flush(self) -> None:
        """Remove all files of the function."""
        for file in self.folder.glob(f"*{_SUFFIX}"):
            file.unlink(missing_ok=True)

    def _file(self, key: Any) -> Path:
        return self.folder / f"{hashlib.sha256(repr(key).encode()).hexdigest()[:24]}{_SUFFIX}"

    def _trusted(self) -> bool:
        """Whether both folders are there, and nobody but the user and root can have put files into them."""
        return all(_is_trusted(folder, folder.stat, self._root) for folder in (self._root, self.folder))


def _is_trusted(path: Path, status_of: Callable[[], os.stat_result], root: Path) -> bool:
    """Whether nobody but the user and root can have written a file or a folder; if not, the log says so."""
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
    """What a file holds after its checksum; nothing if it is damaged, or if others could write to it."""
    try:
        # Of what lies there, be it a pipe, nothing is asked before it is known to be a file.
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
    """Make a folder to which nobody else may write, if it is absent."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    folder.mkdir(mode=_mode(0o755), exist_ok=True)


def _mode(for_all: int) -> int:
    """Permissions of what is made: others may read what root made, in a container's image for instance."""
    return for_all if os.geteuid() == 0 else for_all & 0o700


_told: set[tuple[Path, int]] = set()


def _tell(root: Path, level: int, what: str) -> None:
    """Say once in a process what is wrong with a cache."""
    if (root, level) not in _told:
        _told.add((root, level))
        log.log(level, "The compiled code in %s %s", root, what)
