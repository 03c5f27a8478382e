"""Checkpoints: files in numpy's format ``.npz``, an uncompressed zip archive with a CRC-32 of each array.

The last array, ``header``, is a text in JSON. If all rows of an array are equal, as in many arrays of a
cloud, the file contains one of them; the header's ``rows`` gives their number. The last two files stay on
disk, so that a run can resume when one of them is damaged.

Several processes write a checkpoint together: the first its file, and each one some rows of some arrays, as a
file ``<time>.npz.<first row>`` of the same format. The header's ``parts`` gives these rows and the checksums.
"""

from __future__ import annotations

import errno
import json
import logging
import math
import os
import re
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple, TypedDict

import numpy as np
import orjson
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.results.atomic import atomic_write
from foamprb.results.reading import checked, open_regular

log = logging.getLogger("foamprb")

VERSION = 14
PARTICLES, FUNCTIONS = "particles/", "functions/"
"""Prefixes of array names: particle state, cloud-function data."""
MOST_FILES = 2
"""Number of checkpoints that stay on disk."""

_HEADER = "header"
"""Name of the array with the header."""
_OLD = b"foamprb checkpoint "
"""First bytes of a checkpoint of format 13 or before; the number of the format follows."""
_NAME = re.compile(r"(-?\d+(?:\.\d+)?(?:e[-+]\d+)?)\.(?:npz|checkpoint)")
_INCOMPLETE = "it is incomplete or does not match its checksums"
_LOCAL_HEADER = struct.Struct("<26xHH")
"""What precedes a file in a zip archive: the lengths of its name and of the extra field, which follow."""
# Rows that are compared first.
_FIRST = 1000


@dataclass(frozen=True)
class Checkpoint:
    """State at a time, s: a header of values that JSON can represent, and arrays by name."""

    time: float
    header: Mapping[str, object]
    arrays: Mapping[str, NDArray[Any]]


class DamagedError(Exception):
    """A file that is no complete checkpoint; the message gives the reason."""


class Checkpoints:
    """The files ``<time>.npz`` in a folder.

    Parameters
    ----------
    folder
        The folder, made when the first file is written.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def files(self) -> dict[float, Path]:
        """Return the files by their times, s, damaged or not, in order of time."""
        files = tuple(self.folder.iterdir()) if self.folder.is_dir() else ()
        times = {float(match[1]): file for file in files if (match := _NAME.fullmatch(file.name))}
        return dict(sorted(times.items()))

    def file(self, time: float) -> Path:
        """Return the file of a checkpoint at a time, s."""
        return self.folder / f"{time:.12g}.npz"

    def write(self, checkpoint: Checkpoint) -> Path:
        """Write a checkpoint, and remove all but the last two."""
        path = self.file(checkpoint.time)
        write_checkpoint(path, checkpoint)
        for file in list(self.files().values())[:-MOST_FILES]:
            _remove(file)
        return path

    def latest(self, fits: Callable[[StoredCheckpoint], bool] = lambda _: True) -> StoredCheckpoint | None:
        """Find the latest undamaged checkpoint from which a run can continue, and remove those after it.

        Parameters
        ----------
        fits
            Returns whether the run can continue from a checkpoint, or raises DamagedError. If it can from
            none, the latest undamaged one is returned.

        Returns
        -------
        The checkpoint; None if there are no files.

        Raises
        ------
        InputError
            If all are damaged, or the latest undamaged one has another version.
        """
        files, intact = self.files(), None
        for time, file in sorted(files.items(), reverse=True):
            try:
                checkpoint = StoredCheckpoint(file, verify=True)
                is_usable = fits(checkpoint)
            except DamagedError as error:
                log.warning("%s is damaged: %s. The checkpoint before it is used.", file, error)
                continue
            if is_usable:
                self.truncate(after=time)
                return checkpoint
            intact = intact or checkpoint
        if files and intact is None:
            raise InputError(
                f"{self.folder}: no intact checkpoint ({len(files)} damaged). Begin again with -overwrite "
                "or startFrom startTime."
            )
        return intact

    def truncate(self, after: float) -> None:
        """Remove the checkpoints of later times, s."""
        for time, file in self.files().items():
            if time > after:
                _remove(file)


def parts_of(file: Path) -> list[Path]:
    """Return the files with the further rows of a checkpoint."""
    # Another file of such a name may be unfinished.
    return sorted(part for part in file.parent.glob(f"{file.name}.*") if part.suffix[1:].isdigit())


def part_file(file: Path, first: int) -> Path:
    """Return the file with the rows of a checkpoint from one on."""
    return file.with_name(f"{file.name}.{first}")


def _remove(file: Path) -> None:
    """Remove a checkpoint, its own file first, so that no file is one without its parts."""
    file.unlink(missing_ok=True)
    for part in parts_of(file):
        part.unlink(missing_ok=True)


def write_checkpoint(path: Path, checkpoint: Checkpoint) -> str:
    """Write a checkpoint; see :func:`write_arrays`."""
    return write_arrays(path, checkpoint.time, checkpoint.header, checkpoint.arrays.items())


def write_arrays(
    path: Path, time: float, header: Mapping[str, object], arrays: Iterable[tuple[str, NDArray[Any]]]
) -> str:
    """Write a checkpoint, or a part of one, in one step, array by array; return the checksum."""
    names, rows = [], {}
    with atomic_write(path) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        for name, values in arrays:
            array = np.asarray(values, order="C")
            names.append(name)
            if is_one_row(array):
                rows[name] = len(array)
            _write_array(archive, name, array[:1] if name in rows else array)
            # The next array is gathered before these names are bound again.
            del values, array
        text = orjson.dumps({"format": VERSION, "time": time, "arrays": names, "rows": rows, **header})
        _write_array(archive, _HEADER, np.frombuffer(text, dtype=np.uint8))
    return _checksum(archive)


def _write_array(archive: zipfile.ZipFile, name: str, array: NDArray[np.generic]) -> None:
    # A name alone has a fixed date: equal states have equal bytes.
    with archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True) as file:
        np.lib.format.write_array_header_1_0(file, np.lib.format.header_data_from_array_1_0(array))
        # write_array copies 16 MiB at a time.
        file.write(array.reshape(-1).view(np.uint8).data)


def _checksum(archive: zipfile.ZipFile) -> str:
    """Return a checksum of the names and checksums of the arrays."""
    members = [(member.filename, member.CRC) for member in archive.infolist()]
    return f"{zlib.crc32(repr(members).encode()):08x}"


class _Place(NamedTuple):
    """Array in a file."""

    offset: int
    """Where its first row begins, bytes."""
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    repeated: bool
    """Whether the file contains one of its rows, which are all equal."""


class _File(NamedTuple):
    """Header and places of the arrays of one file."""

    path: Path
    time: float
    header: dict[str, Any]
    arrays: dict[str, _Place]

    def read_into(self, array: NDArray[np.generic], name: str, first: int) -> None:
        """Read rows of an array from a number on."""
        place = self.arrays[name]
        rows = array[:1] if place.repeated else array
        row = math.prod(place.shape[1:]) * place.dtype.itemsize
        left = rows.reshape(-1).view(np.uint8)
        with self.path.open("rb", buffering=0) as file:
            file.seek(place.offset + (0 if place.repeated else first * row))
            while len(left):
                n = file.readinto(left.data)
                if not n:
                    raise OSError(errno.EIO, "the file was cut after it was opened", str(self.path))
                left = left[n:]
        if place.repeated:
            array[1:] = array[0]


class StoredCheckpoint:
    """A checkpoint on disk, of which any rows of any array can be read.

    Parameters
    ----------
    path
        Its file.
    verify
        Whether to compare the checksums of the file and its parts with their bytes.

    Raises
    ------
    DamagedError
        If a file is damaged.
    InputError
        If it is undamaged, but has another version.
    """

    def __init__(self, path: Path, verify: bool = False) -> None:
        self.path = path
        main, _ = _open(path, verify)
        self.time, self.header = main.time, main.header
        self._files = [(0, main)]
        for first, expected in self.header.get("parts", ()):
            file = part_file(path, first)
            try:
                part, checksum = _open(file, verify)
            except FileNotFoundError:
                raise DamagedError(f"{file.name} is missing") from None
            except DamagedError as error:
                raise DamagedError(f"in {file.name} {error}") from error
            if checksum != expected:
                raise DamagedError(f"{file.name} belongs to another checkpoint")
            self._files.append((first, part))
        self.layout: dict[str, tuple[tuple[int, ...], np.dtype[Any]]] = {}
        """Shapes and types of the arrays."""
        for name, place in main.arrays.items():
            more = sum(part.arrays[name].shape[0] for part in self._parts(name))
            shape = (place.shape[0] + more, *place.shape[1:]) if more else place.shape
            self.layout[name] = shape, place.dtype

    def _parts(self, name: str) -> list[_File]:
        """Return the parts with further rows of an array."""
        return [part for _, part in self._files[1:] if name in part.arrays]

    def read(self, name: str) -> NDArray[Any]:
        """Return an array."""
        shape, dtype = self.layout[name]
        array = np.empty(shape, dtype=dtype)
        self.read_into(array, name, 0)
        return array

    def read_into(self, array: NDArray[np.generic], name: str, first: int) -> None:
        """Read rows of a stored array, from ``first`` on, into a contiguous array of its type."""
        rows, start = np.atleast_1d(array), 0
        for file in (self._files[0][1], *self._parts(name)):
            end = start + (file.arrays[name].shape[0] if array.ndim else 1)
            low, high = max(first, start), min(first + len(rows), end)
            if low < high:
                file.read_into(rows[low - first : high - first], name, low - start)
            start = end

    def read_all(self) -> Checkpoint:
        """Return header and all arrays."""
        return Checkpoint(self.time, self.header, {name: self.read(name) for name in self.layout})


class _PartHeader(TypedDict):
    """Entries of the header of each file."""

    format: int
    time: float
    arrays: list[str]
    rows: dict[str, int]


class _Header(_PartHeader, total=False):
    """Entries of the header of a checkpoint."""

    parts: list[tuple[int, str]]


def _open(path: Path, verify: bool) -> tuple[_File, str]:
    """Read the header of one file; return also its checksum. See :class:`StoredCheckpoint`."""
    try:
        return _opened(path, verify)
    except (DamagedError, InputError, FileNotFoundError, MemoryError):
        raise
    except (zipfile.BadZipFile, EOFError) as error:
        raise DamagedError(_INCOMPLETE) from error
    except Exception as error:
        raise DamagedError(str(error) if isinstance(error, OSError | ValueError) else repr(error)) from error


def _opened(path: Path, verify: bool) -> tuple[_File, str]:
    with open_regular(path) as file:
        first = file.read(len(_OLD) + 8)
        if first.startswith(_OLD):
            raise _other_format(path, first.removeprefix(_OLD).partition(b"\n")[0].decode(errors="replace"))
        with zipfile.ZipFile(file) as archive:
            members = archive.infolist()
            if any(member.compress_type != zipfile.ZIP_STORED for member in members):
                raise DamagedError("it is compressed")
            if verify and archive.testzip() is not None:
                raise DamagedError(_INCOMPLETE)
            offset, shape, _ = _array_at(file, archive.getinfo(f"{_HEADER}.npy"))
            file.seek(offset)
            header = dict[str, Any](json.loads(file.read(shape[0])))
            if header.get("format") != VERSION:
                raise _other_format(path, header.get("format"))
            header = dict[str, Any](checked(header, _Header, "its header"))
            del header["format"]
            names, rows = header.pop("arrays"), header.pop("rows")
            if [member.filename for member in members] != [f"{name}.npy" for name in (*names, _HEADER)]:
                raise ValueError("it has other arrays than its header")
            places = {}
            for name, member in zip(names, members, strict=False):
                offset, stored, dtype = _array_at(file, member)
                shape = (rows[name], *stored[1:]) if name in rows else stored
                if min(shape, default=0) < 0:
                    raise ValueError(f"the array {name} has the shape {shape}")
                places[name] = _Place(offset, shape, dtype, name in rows)
            return _File(path, header.pop("time"), header, places), _checksum(archive)


def _other_format(path: Path, version: object) -> InputError:
    return InputError(
        f"{path}: a checkpoint of format {version}; this version of foamprb reads format {VERSION}. Continue "
        "with the version that wrote it, or start over: -overwrite, or startFrom startTime."
    )


def _array_at(file: BinaryIO, member: zipfile.ZipInfo) -> tuple[int, tuple[int, ...], np.dtype[Any]]:
    """Return where the values of an array begin in a file, bytes, and its shape and type."""
    file.seek(member.header_offset)
    start = sum(_LOCAL_HEADER.unpack(file.read(_LOCAL_HEADER.size))) + file.tell()
    file.seek(start)
    np.lib.format.read_magic(file)
    shape, _, dtype = np.lib.format.read_array_header_1_0(file)
    if dtype.hasobject or min(shape, default=0) < 0:
        raise ValueError(f"{member.filename} has the type {dtype} and the shape {shape}")
    place = file.tell()
    end = place + math.prod(shape) * dtype.itemsize
    if end != start + member.file_size or end > os.fstat(file.fileno()).st_size:
        raise ValueError(f"{member.filename} has {member.file_size} bytes and the shape {shape}")
    return place, shape, dtype


def is_one_row(array: NDArray[np.generic]) -> bool:
    """Return True if a contiguous array has two rows or more, and all are equal to the last bit."""
    if array.ndim == 0 or len(array) < 2 or not array.size or array.itemsize not in (1, 2, 4, 8):
        return False
    bits = array.view(f"u{array.itemsize}")
    # Most arrays with different rows differ early, or in the last row.
    return all(bool((bits[part] == bits[0]).all()) for part in (slice(-1, None), slice(_FIRST), slice(None)))
