"""List of the files that a run writes: a later run may remove these files and no others."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path, PurePosixPath
from typing import Literal, TypedDict

from foamprb.errors import InputError
from foamprb.results.atomic import replace_end, write_text
from foamprb.results.folder import MANIFEST
from foamprb.results.reading import checked, read_bytes, reading

_NEXT, _END = "\n ,", "\n ]\n}\n"
"""Text between two names, and after the last name."""


class Manifest:
    """Files that a run has written into its folder or is about to write.

    ``manifest.json`` names them relative to the folder, one in a line. A file is listed before it is written,
    so that no file stays unlisted if the run is killed. A listed file may be missing, or be listed twice.
    Files are appended: the cost does not grow with the length of the list.

    Parameters
    ----------
    folder
        The run's folder.
    files
        Files that are listed initially.
    """

    def __init__(self, folder: Path, files: Iterable[Path] = ()) -> None:
        self.folder = folder
        self.files = set(files)
        """The files that :meth:`read` has found; later ones are on disk only."""
        self._expected: frozenset[Path] | None = None
        self._tables: set[Path] = set()

    @property
    def path(self) -> Path:
        """File of the list, which does not list itself."""
        return self.folder / MANIFEST

    @classmethod
    def read(cls, folder: Path) -> Manifest:
        """Read the list of a run in its folder; it is empty without a manifest.

        Raises
        ------
        InputError
            If the manifest is damaged or has another format.
        """
        manifest = cls(folder)
        if manifest.path.exists() or manifest.path.is_symlink():
            with reading(manifest.path):
                names = _content(read_bytes(manifest.path))["files"]
                manifest.files = {folder / name for name in names if _is_inside(name)}
                _refuse_links(folder, manifest.files)
        return manifest

    def expect(self, files: Iterable[Path]) -> None:
        """List files that are about to be written.

        Raises
        ------
        InputError
            If a folder on the way to a file is a link.
        """
        files = frozenset(files)
        self._add(files - (self._expected or frozenset()))
        self._expected = files

    def expect_table(self, file: Path) -> None:
        """List a file that is written at each write time, before the first of them; see :meth:`expect`."""
        if file != self.path and file not in self._tables | self.files:
            self._add(frozenset([file]))
            self._expected = self._expected or frozenset()
            self._tables.add(file)

    def _add(self, files: frozenset[Path]) -> None:
        """Append files to the list; begin it with them if it is not begun."""
        try:
            _refuse_links(self.folder, files)
        except ValueError as error:
            raise InputError(f"{self.folder}: results would be written elsewhere: {error}") from error
        if self._expected is None:
            self._write(self.files | files)
        elif files:
            replace_end(self.path, _END.encode(), f"{_NEXT}{self._lines(files)}{_END}".encode())

    def settle(self, files: Iterable[Path]) -> None:
        """List only files that exist, and files that are about to be written, in one step."""
        self._write({file for file in Manifest.read(self.folder).files if file.exists()} | {*files})

    def _write(self, files: Iterable[Path]) -> None:
        write_text(self.path, f'{{\n "format": 1,\n "files": [\n  {self._lines(files)}{_END}')

    def _lines(self, files: Iterable[Path]) -> str:
        return _NEXT.join(map(json.dumps, sorted(file.relative_to(self.folder).as_posix() for file in files)))

    def remove(self, files: Iterable[Path]) -> None:
        """Remove listed files, in order, and the folders that become empty."""
        for file in files:
            file.unlink(missing_ok=True)
            self.files.discard(file)
            for parent in file.relative_to(self.folder).parents[:-1]:
                with suppress(OSError):
                    (self.folder / parent).rmdir()


class _List(TypedDict):
    """Contents of a manifest."""

    format: Literal[1]
    files: list[str]


def _content(data: bytes) -> _List:
    """Return the contents of a manifest; without the last lines if they were not written completely."""
    try:
        content = json.loads(data)
    except ValueError:
        content = json.loads(data.rpartition(_NEXT.encode())[0] + _END.encode())
    return checked(content, _List)


def _is_inside(name: str) -> bool:
    """Return True; raise ValueError if a name cannot be that of a file in the folder."""
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or not path.parts or "\0" in name:
        raise ValueError(f"it names '{name}', which is not in its folder")
    os.fsencode(name)
    return True


def _refuse_links(folder: Path, files: Iterable[Path]) -> None:
    """Raise ValueError if a folder between the run's folder and a file is a link, which leads elsewhere."""
    folders = {file.parent.relative_to(folder) for file in files}
    for parent in {path for path in folders for path in (path, *path.parents) if path.parts}:
        if (folder / parent).is_symlink():
            raise ValueError(f"the folder '{parent}' is a link.")
