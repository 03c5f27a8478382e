"""Times of a flow, ready for the kernels, on disk for later runs.

A file holds u and ∇u at the nodes and the balanced fluxes of a time. Its name is a hash of all that they
depend on: the mesh, the values that were read, the code and the processor.
"""

from __future__ import annotations

import hashlib
import logging
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from foamprb.compile.link import key_of
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh

__all__ = ["PreparedTimes"]

log = logging.getLogger("foamprb")

Values: TypeAlias = tuple[Floats, Floats, Any]
_SUFFIX = ".flow"
_UNUSED = 7 * 86400.0
"""Time after which a file that no run has read may be removed, s."""


class PreparedTimes:
    """Folder of the times of flows; it never takes more of a disk than it leaves free.

    Parameters
    ----------
    folder
        The folder; None to keep nothing.
    mesh
        Mesh of the flow.

    Raises
    ------
    InputError
        If the folder cannot be made.
    """

    def __init__(self, folder: Path | None, mesh: Mesh) -> None:
        self._folder = folder
        if folder is not None:
            try:
                folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise InputError(f"-cache {folder}: this folder cannot be made: {error.strerror}.") from error
            geometry = (getattr(mesh, name) for name in _GEOMETRY)
            self._key = _hash(_code(), *geometry, mesh.patches, mesh.couplings)

    def get(self, values: Sequence[Any], make: Callable[[], Values]) -> Values:
        """Return u, ∇u and fluxes from disk, else as they are made, and keep them there.

        Parameters
        ----------
        values
            All that they depend on beside the mesh: arrays, tuples of arrays, and None.
        make
            Makes them.
        """
        if self._folder is None:
            return make()
        file = self._folder / f"{_hash(self._key, *values)}{_SUFFIX}"
        arrays = _loaded(file)
        if arrays is None:
            arrays = make()
            # Where fluxes cannot be balanced each run needs the warning.
            if arrays[-1] is not None and not np.isnan(arrays[-1]).any():
                self._store(file, arrays)
        return arrays

    def _store(self, file: Path, arrays: Values) -> None:
        folder = file.parent
        try:
            if not _has_room(folder, sum(array.nbytes for array in arrays)):
                return
            with tempfile.NamedTemporaryFile(dir=folder, suffix=".part", delete=False) as part:
                try:
                    for array in arrays:
                        np.save(part, array)
                    Path(part.name).replace(file)
                finally:
                    Path(part.name).unlink(missing_ok=True)
        except OSError as error:
            log.warning("-cache %s: times of the flow are no longer stored: %s.", folder, error.strerror)
            self._folder = None


_GEOMETRY = ("points", "face_start", "face_points", "owner", "neighbour", "patch_start")


def _loaded(file: Path) -> Values | None:
    """Return the arrays of a file; None if there is no whole one."""
    with suppress(OSError, ValueError, EOFError), file.open("rb") as stream:
        arrays = np.load(stream), np.load(stream), np.load(stream)
        os.utime(file)
        return arrays
    return None


def _has_room(folder: Path, size: int) -> bool:
    """Return whether files of some bytes can be added; remove unused files if they cannot."""
    files = {}
    for file in folder.glob(f"*{_SUFFIX}"):
        with suppress(FileNotFoundError):
            files[file] = file.stat()
    total, free = sum(stat.st_size for stat in files.values()) + size, shutil.disk_usage(folder).free - size
    for file, stat in sorted(files.items(), key=lambda item: item[1].st_mtime):
        if total <= free or time.time() - stat.st_mtime < _UNUSED:
            break
        file.unlink(missing_ok=True)
        total, free = total - stat.st_size, free + stat.st_size
    return total <= free


def _hash(*values: Any) -> str:
    digest = hashlib.blake2b(digest_size=20)
    for value in values:
        if isinstance(value, np.ndarray):
            digest.update(f"{value.dtype.str}{value.shape}".encode())
            digest.update(np.ascontiguousarray(value).view(np.uint8).data)
        else:
            # The order of a set differs from process to process.
            items = sorted(value) if isinstance(value, frozenset) else value
            content = _hash(*items) if isinstance(items, tuple | list) else items
            digest.update(content if isinstance(content, bytes) else repr(content).encode())
    return digest.hexdigest()


@cache
def _code() -> str:
    """Return a hash of the code that makes times, of the libraries and the processor."""
    files = sorted(Path(__file__).parents[1].rglob("*.py"))
    return key_of([*map(version, ("numpy", "scipy")), *(file.read_text() for file in files)])
