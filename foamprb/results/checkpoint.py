"""Checkpoints: files of a header and arrays, with a checksum.

A file consists of a line with format and version, a checksum, the header as one line of JSON, and the arrays
in numpy's ``.npy`` format, in the order of the header's ``arrays``. The checksum is the 64-bit XXH3 of
everything else. If all rows of an array are equal, as in many arrays of a cloud, the file contains one of
them; the header's ``rows`` gives their number. The last two files stay on disk, so that a run can resume when
one of them is damaged.
"""

from __future__ import annotations

import hashlib
import json
import logging
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xxhash
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.results.atomic import atomic_write, drop_cache

log = logging.getLogger("foamprb")

VERSION = 8
MOST_FILES = 2
"""Number of checkpoints that stay on disk."""

_FORMAT = b"foamprb checkpoint "
_NAME = re.compile(r"(\d+(?:\.\d+)?(?:e[-+]\d+)?)\.checkpoint")
_SUM_BYTES = 8
_LONGEST_FIRST = len(_FORMAT) + 8
# Rows that are compared first.
_FIRST = 1000


@dataclass(frozen=True)
class Checkpoint:
    """State at a time, s: a header of values that JSON can represent, and arrays by name."""

    time: float
    header: Mapping[str, Any]
    arrays: Mapping[str, NDArray[Any]]


class DamagedError(Exception):
    """A file that is no complete checkpoint; the message gives the reason."""


class Checkpoints:
    """The files ``<time>.checkpoint`` in a folder.

    Parameters
    ----------
    folder
        The folder, made when the first file is written.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def files(self) -> dict[float, Path]:
        """Return the files by their times, s, damaged or not, in order of time."""
        found = tuple(self.folder.iterdir()) if self.folder.is_dir() else ()
        times = {float(match[1]): file for file in found if (match := _NAME.fullmatch(file.name))}
        return dict(sorted(times.items()))

    def file(self, time: float) -> Path:
        """Return the file of a checkpoint at a time, s."""
        return self.folder / f"{time:.12g}.checkpoint"

    def write(self, checkpoint: Checkpoint) -> Path:
        """Write a checkpoint, and remove all but the last two.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        path = self.file(checkpoint.time)
        for file in self.files().values():
            drop_cache(file)
        write_checkpoint(path, checkpoint)
        for file in list(self.files().values())[:-MOST_FILES]:
            file.unlink(missing_ok=True)
        return path

    def latest(self) -> Checkpoint | None:
        """Read the latest undamaged checkpoint, and remove the damaged ones after it.

        Returns
        -------
        The checkpoint; None if there are no files.

        Raises
        ------
        InputError
            If all are damaged, or the latest undamaged one has another version.
        """
        files = self.files()
        for time, file in sorted(files.items(), reverse=True):
            try:
                checkpoint = read_checkpoint(file)
            except DamagedError as error:
                log.warning("%s is damaged: %s. The checkpoint before it is used.", file, error)
                continue
            self.truncate(after=time)
            return checkpoint
        if files:
            raise InputError(
                f"{self.folder}: no intact checkpoint ({len(files)} damaged). Begin again with -overwrite "
                "or startFrom startTime."
            )
        return None

    def truncate(self, after: float) -> None:
        """Remove the checkpoints of later times, s."""
        for time, file in self.files().items():
            if time > after:
                file.unlink(missing_ok=True)


def write_checkpoint(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint in one step.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    arrays = {name: np.asarray(array, order="C") for name, array in checkpoint.arrays.items()}
    rows = {name: len(array) for name, array in arrays.items() if is_one_row(array)}
    header = {"time": checkpoint.time, "arrays": list(arrays), "rows": rows, **checkpoint.header}
    first = _FORMAT + b"%d\n" % VERSION
    with atomic_write(path) as temporary, temporary.open("w+b") as file:
        file.write(first + bytes(_SUM_BYTES) + json.dumps(header, allow_nan=False).encode() + b"\n")
        for name, array in arrays.items():
            np.lib.format.write_array(file, array[:1] if name in rows else array)
        checksum = _checksum(file, first)
        file.seek(len(first))
        file.write(checksum)


def read_checkpoint(path: Path) -> Checkpoint:
    """Read a checkpoint, after comparing its checksum with its bytes.

    Raises
    ------
    DamagedError
        If the file is damaged.
    InputError
        If it is undamaged, but has another version.
    """
    with path.open("rb") as file:
        first = file.readline(_LONGEST_FIRST)
        version = first.removeprefix(_FORMAT).strip().decode(errors="replace")
        if file.read(_SUM_BYTES) != _checksum(file, first):
            other = first.startswith(_FORMAT) and version.isdigit() and version != str(VERSION)
            # Other versions may have other checksums.
            raise DamagedError(
                f"its format is {version}, not {VERSION}"
                if other
                else "its contents do not match its checksum"
            )
        if version != str(VERSION):
            raise InputError(
                f"{path}: a checkpoint of format {version}; this version of foamprb reads format {VERSION}."
            )
        file.seek(len(first) + _SUM_BYTES)
        header = json.loads(file.readline())
        arrays = {name: np.lib.format.read_array(file, allow_pickle=False) for name in header.pop("arrays")}
    for name, n in header.pop("rows").items():
        arrays[name] = np.repeat(arrays[name], n, axis=0)
    return Checkpoint(header.pop("time"), header, arrays)


def is_one_row(array: NDArray[Any]) -> bool:
    """Return True if a contiguous array has two rows or more, and all are equal to the last bit."""
    if array.ndim == 0 or len(array) < 2 or not array.size or array.itemsize not in (1, 2, 4, 8):
        return False
    bits = array.view(f"u{array.itemsize}")
    # Most arrays with different rows differ early, or in the last row.
    return all(bool((bits[part] == bits[0]).all()) for part in (slice(-1, None), slice(_FIRST), slice(None)))


def _checksum(file: Any, first: bytes) -> bytes:
    """Return the checksum of a file with a first line; it is much faster than CRC-32 or SHA-256."""
    file.seek(len(first) + _SUM_BYTES)
    return hashlib.file_digest(file, lambda: xxhash.xxh3_64(first)).digest()
