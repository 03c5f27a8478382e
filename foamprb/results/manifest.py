"""List of the files that a run writes: a later run may remove these files and no others."""

from __future__ import annotations

import json
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path, PurePosixPath
from typing import Any

from foamprb.errors import InputError
from foamprb.results.atomic import write_text
from foamprb.results.folder import MANIFEST

FORMAT = 1


class Manifest:
    """Files that a run has written into its folder or is about to write.

    ``manifest.json`` names them relative to the folder. A file is listed before it is written, so that no
    file stays unlisted if the run is killed. A listed file may be missing.

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
        self._expected: frozenset[Path] = frozenset()

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
        if manifest.path.exists():
            try:
                manifest.files = {folder / name for name in _names(json.loads(manifest.path.read_bytes()))}
                _refuse_links(folder, manifest.files)
            except (OSError, TypeError, ValueError, RecursionError) as error:
                raise InputError(f"{manifest.path} is damaged: {error}") from error
        return manifest

    def expect(self, files: Iterable[Path]) -> None:
        """List files that are about to be written, in one step.

        Files of the last call that do not exist now are dropped from the list.

        Raises
        ------
        InputError
            If a folder on the way to a file is a link.
        OSError
            If the manifest cannot be written.
        """
        files = frozenset(files)
        try:
            _refuse_links(self.folder, files)
        except ValueError as error:
            raise InputError(f"{self.folder}: results would be written elsewhere: {error}") from error
        self.files -= {file for file in self._expected if not file.exists()}
        self._expected = files
        self.files |= self._expected
        names = sorted(_name(file, self.folder) for file in self.files)
        content = {"format": FORMAT, "files": names}
        write_text(self.path, f"{json.dumps(content, indent=1)}\n")

    def remove(self, files: Iterable[Path]) -> None:
        """Remove listed files, in order, and the folders that become empty.

        Raises
        ------
        OSError
            If a file cannot be removed.
        """
        for file in files:
            file.unlink(missing_ok=True)
            self.files.discard(file)
            for parent in file.relative_to(self.folder).parents[:-1]:
                with suppress(OSError):
                    (self.folder / parent).rmdir()


@cache
def _name(file: Path, folder: Path) -> str:
    return file.relative_to(folder).as_posix()


def _refuse_links(folder: Path, files: Iterable[Path]) -> None:
    """Raise ValueError if a folder between the run's folder and a file is a link, which leads elsewhere."""
    for parent in {parent for file in files for parent in file.relative_to(folder).parents[:-1]}:
        if (folder / parent).is_symlink():
            raise ValueError(f"the folder '{parent}' is a link.")


def _names(content: Any) -> list[str]:
    """Return the names in a manifest; raise ValueError if it was changed."""
    if not isinstance(content, dict) or not isinstance(content.get("files"), list):
        raise ValueError("it is not a list of files.")
    if content.get("format") != FORMAT:
        raise ValueError(f"its format is {content.get('format')}, not {FORMAT}.")
    names: list[str] = content["files"]
    for name in names:
        path = PurePosixPath(name)
        if path.is_absolute() or ".." in path.parts or not path.parts:
            raise ValueError(f"it names '{name}', which is not in its folder.")
    return names
