"""Files of a cloud over time: a ``.vtp`` or ``.pvtp`` file per time, and the ``.pvd`` that lists them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

from foamprb.results.atomic import write_text
from foamprb.results.folder import ResultsFolder
from foamprb.results.reading import read_bytes, reading
from foamprb.results.vtk import Parts, PointCloud, write_snapshot


def files_of(path: Path) -> tuple[Path, ...]:
    """Return the file of a snapshot and the files of its pieces, whether they exist or not."""
    if path.suffix != ".pvtp" or not path.exists():
        return (path,)
    with reading(path):
        pieces = ElementTree.fromstring(read_bytes(path)).iter("Piece")
        files = [Path(piece.attrib["Source"]) for piece in pieces]
        for file in files:
            if file.is_absolute() or ".." in file.parts or file.suffix != ".vtp":
                raise ValueError(f"it names the piece '{file}', which is not a .vtp file in its folder")
        return (path, *(path.parent / file for file in files))


class SnapshotFile(NamedTuple):
    """Line of a ``.pvd``: a time, s, and the name of its file in the same folder."""

    time: float
    file: str


class Series:
    """Snapshots ``<name>_<index>.vtp`` of one cloud, and the ``<name>.pvd`` that lists them with their times.

    Several processes write a ``.pvtp``, with pieces in a folder of the same name. At any moment the ``.pvd``
    on disk names complete files only.

    Parameters
    ----------
    folder
        Folder of the files; made when the first is written.
    """

    def __init__(self, folder: ResultsFolder) -> None:
        self.folder = folder
        self.entries: tuple[SnapshotFile, ...] = ()

    def append(self, cloud: PointCloud | Parts) -> Path:
        """Write a snapshot and list it; return the ``.vtp`` file; ValueError as :meth:`next`."""
        file = with_ending(self.next(cloud.time), ".vtp")
        write_snapshot(file, cloud)
        self.add(cloud.time, file)
        return file

    def next(self, time: float, ahead: int = 0) -> Path:
        """Return the file for the snapshot of a time, s, without its ending, after some that are not listed.

        Raises
        ------
        ValueError
            If the time is not later than the last listed one.
        """
        if self.entries and not time > self.entries[-1].time:
            raise ValueError(f"Time {time!r} s does not follow {self.entries[-1].time!r} s.")
        last = re.search(r"_(\d+)\.p?vtp$", self.entries[-1].file) if self.entries else None
        index = int(last[1]) + 1 if last else len(self.entries)
        return self.folder.snapshot(index + ahead)

    def add(self, time: float, file: Path) -> None:
        """List a complete file, named by :meth:`next`."""
        self._list((*self.entries, SnapshotFile(float(time), file.name)))

    def relist(self, entries: Sequence[SnapshotFile]) -> None:
        """List only these snapshots of an earlier run, in order of time."""
        if entries:
            self._list(tuple(entries))
        else:
            self.folder.pvd.unlink(missing_ok=True)
            self.entries = ()

    def _list(self, entries: tuple[SnapshotFile, ...]) -> None:
        write_text(
            self.folder.pvd,
            '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n'
            f"{''.join(map(_line, entries))}  </Collection>\n</VTKFile>\n",
        )
        self.entries = entries


@cache
def _line(entry: SnapshotFile) -> str:
    """Return the line of a ``.pvd``; the list is written whole at each time."""
    return f'    <DataSet timestep="{entry.time!r}" part="0" file={quoteattr(entry.file)}/>\n'


def with_ending(stem: Path, ending: str) -> Path:
    """Return the file of a cloud, the name of which may contain dots; ``ending`` is ``.vtp`` or ``.pvtp``."""
    return stem.with_name(stem.name + ending)


def read_pvd(path: Path) -> tuple[SnapshotFile, ...]:
    """Read the times and files that a ``.pvd`` lists, in order of time."""
    with reading(path, "is no list of VTK files"):
        root = ElementTree.fromstring(read_bytes(path))
        entries = [SnapshotFile(float(e.attrib["timestep"]), e.attrib["file"]) for e in root.iter("DataSet")]
        for time, file in entries:
            if Path(file).name != file or not file.endswith((".vtp", ".pvtp")) or "\0" in file:
                raise ValueError(f"it names '{file}', which is not a .vtp or .pvtp file in its own folder")
            if not math.isfinite(time):
                raise ValueError(f"the time of {file} is {time}")
    return tuple(sorted(entries))
