"""Checkpoints: files of a header and arrays, with a checksum.

A file contains one line with format and version, the header as one line of JSON, the arrays as numpy's
``.npy`` in the order of the header's ``arrays``, and the 64-bit XXH3 checksum of all this. If all rows of an
array are equal, the file has one of them, and the header's ``rows`` their number. The last two files stay on
disk, so that a run can resume if one of them is damaged.
"""

from __future__ import annotations

import json
import logging
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np
import xxhash
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.results.atomic import atomic_write, forget, remove_unfinished

log = logging.getLogger("foamprb")

VERSION = 7
MOST_FILES = 2
"""Number of checkpoints on disk."""

_FORMAT = b"foamprb checkpoint "
_NAME = re.compile(r"(\d+(?:\.\d+)?(?:e[-+]\d+)?)\.checkpoint")
_SUM_BYTES = 8
_LONGEST_VERSION = 8
# Bytes copied at a time.
_CHUNK = 1 << 20
# Rows compared first, before all rows are.
_FIRST = 1000


@dataclass(frozen=True)
class Checkpoint:
    """State at a time, s: a header of JSON values, and arrays by name."""

    time: float
    header: Mapping[str, Any]
    arrays: Mapping[str, NDArray[Any]]


class DamagedError(Exception):
    """Incomplete or damaged checkpoint; the message gives the reason."""


class Checkpoints:
    """Files ``<time>.checkpoint`` in a folder.

    Parameters
    ----------
    folder
        Folder of the files; made with the first.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        remove_unfinished(folder)

    def files(self) -> dict[float, Path]:
        """Return the files by their times, s, intact or not, the latest last."""
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
            forget(file)
        write_checkpoint(path, checkpoint)
        for file in list(self.files().values())[:-MOST_FILES]:
            file.unlink(missing_ok=True)
        return path

    def latest(self) -> Checkpoint | None:
        """Read the latest intact checkpoint, and remove later damaged ones; None without any.

        Raises
        ------
        InputError
            If all are damaged, or the latest intact one is of another version.
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
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        summed = _Summed(file)
        summed.write(_FORMAT + b"%d\n" % VERSION)
        summed.write(json.dumps(header, allow_nan=False).encode() + b"\n")
        for name, array in arrays.items():
            summed.write_array(array[:1] if name in rows else array)
        file.write(summed.checksum.digest())


def read_checkpoint(path: Path) -> Checkpoint:
    """Verify the checksum of a checkpoint and read it.

    Raises
    ------
    DamagedError
        If the file is damaged.
    InputError
        If it is intact, but of another version.
    """
    with path.open("rb") as file:
        _check(file)
        first = file.readline().removeprefix(_FORMAT).strip()
        if first != b"%d" % VERSION:
            raise InputError(
                f"{path}: a checkpoint of format {first.decode(errors='replace')}; this version of foamprb "
                f"reads format {VERSION}."
            )
        header = json.loads(file.readline())
        arrays = {name: np.lib.format.read_array(file, allow_pickle=False) for name in header.pop("arrays")}
    for name, n in header.pop("rows").items():
        arrays[name] = np.repeat(arrays[name], n, axis=0)
    return Checkpoint(header.pop("time"), header, arrays)


def is_one_row(array: NDArray[Any]) -> bool:
    """Return whether a contiguous array has more than one row, all equal to the last bit."""
    if array.ndim == 0 or len(array) < 2 or not array.size or array.itemsize not in (1, 2, 4, 8):
        return False
    bits = array.view(f"u{array.itemsize}")
    # Most arrays with different rows differ early, or at the end.
    return all(bool((bits[part] == bits[0]).all()) for part in (slice(-1, None), slice(_FIRST), slice(None)))


class _Summed:
    """Writer that computes the checksum of its output.

    XXH3 detects damage by disks and killed processes in a sixth of the time of writing. zlib's CRC-32 would
    take as long as writing, and a cryptographic checksum longer.
    """

    def __init__(self, file: IO[bytes]) -> None:
        self.file = file
        self.checksum = xxhash.xxh3_64()

    def write(self, data: bytes | memoryview) -> None:
        self.checksum.update(data)
        self.file.write(data)

    def write_array(self, array: NDArray[Any]) -> None:
        """Write a contiguous array as ``.npy``, without a copy."""
        np.lib.format.write_array_header_1_0(self, np.lib.format.header_data_from_array_1_0(array))
        if array.size:
            self.write(array.reshape(-1).view(np.uint8).data)


def _check(file: IO[bytes]) -> None:
    """Compare the checksum at the end with the bytes before it, and rewind the file."""
    if file.read(len(_FORMAT)) != _FORMAT:
        raise DamagedError("it has no checkpoint header")
    size = file.seek(0, os.SEEK_END)
    file.seek(0)
    rest, checksum = size - _SUM_BYTES, xxhash.xxh3_64()
    while rest > 0:
        data = file.read(min(rest, _CHUNK))
        if not data:
            raise DamagedError("it was truncated during reading")
        checksum.update(data)
        rest -= len(data)
    matches = file.read() == checksum.digest()
    file.seek(len(_FORMAT))
    version = file.readline(_LONGEST_VERSION).strip()
    file.seek(0)
    if not matches and version != b"%d" % VERSION and version.isdigit():
        # Other versions have other checksums.
        raise DamagedError(f"its format is {version.decode()}, not {VERSION}")
    if not matches:
        raise DamagedError("its contents do not match its checksum")
