"""Folder of one cloud's results, and the names of the files in it.

Users name clouds, cloud functions, injection models and regions; a mesh names patches. No such name may lead
out of the folder of the results.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from foamprb.errors import InputError, suggestion
from foamprb.results.atomic import unfinished
from foamprb.results.tables import RECORDS

DEFAULT_CLOUD = "softCloud"
FATES, FAILURES, TRACERS = "fates", "failed", "tracers"
"""Tables of a run: a row per particle, per failed particle, and per point of the fluid."""
TOUCHED = "touchedAtRelease"
"""Column of ``fates``: 1 for a body that stuck where it was released."""
MANIFEST, RECORD, CHECKPOINTS = "manifest.json", "run.json", "checkpoint"
_ROOT = "postProcessing"
_MOST_BYTES = 200
"""Longest name: file systems allow 255, and suffixes and temporary names need some."""
_CHECKPOINT = re.compile(r"[\d.e+-]+\.(npz|checkpoint)(\.\d+)?|\..+\.tmp")
_NO_WORD = re.compile(r"""[\s"'/\\;{}]""")
HOW = "Run the particles first: foamprb run."


@dataclass(frozen=True, order=True)
class ResultsFolder:
    """The folder of one cloud's results, ``postProcessing/[<region>/]<cloud>`` in a case.

    Parameters
    ----------
    path
        The folder.
    cloud
        Name of the cloud.
    region
        Region of the mesh; empty for the default region.
    """

    path: Path
    cloud: str
    region: str = ""

    @classmethod
    def of_case(cls, case: Path, cloud: str, region: str = "", root: Path | None = None) -> ResultsFolder:
        """Return the folder that a run of a cloud writes into, below ``postProcessing`` or another root."""
        return cls((root or case / _ROOT) / region / cloud, cloud, region)

    @classmethod
    def find(
        cls, case: Path, cloud: str | None = None, region: str = "", root: Path | None = None
    ) -> ResultsFolder:
        """Find the results that runs of a case left.

        Parameters
        ----------
        case
            Folder of the case.
        cloud
            Name of the cloud; by default ``softCloud``, or the only one.
        region
            Region of the mesh; by default the default region, or any other if that has no results.
        root
            Folder of the results instead of ``postProcessing`` in the case.

        Raises
        ------
        InputError
            If there are no such results, or results of several clouds or regions.
        """
        if not case.is_dir():
            raise InputError(f"{case}: no such folder.")
        top = root or case / _ROOT
        folders = sorted(_written(top))
        if not folders:
            raise InputError(f"{top}: no results here ([<region>/]<cloud>/<cloud>.pvd). {HOW}")
        regions = {folder.region for folder in folders}
        if region and region not in regions:
            raise InputError(f"{case}: no results of region '{region}'. {suggestion(region, regions - {''})}")
        if region:
            folders = [folder for folder in folders if folder.region == region]
        clouds = {folder.cloud for folder in folders}
        if cloud is not None and cloud not in clouds:
            raise InputError(f"{case}: no results of a cloud '{cloud}'. {suggestion(cloud, clouds)}")
        if cloud is not None:
            folders = [folder for folder in folders if folder.cloud == cloud]
        folders = [folder for folder in folders if folder.region == region] or folders
        clouds = {folder.cloud for folder in folders}
        name = cloud or DEFAULT_CLOUD
        if name in clouds:
            folders = [folder for folder in folders if folder.cloud == name]
        if len(folders) > 1:
            names = ", ".join(folder.path.relative_to(top).as_posix() for folder in folders)
            option = "-cloud" if len(clouds) > 1 and name not in clouds else "-region"
            raise InputError(f"{case}: results of {len(folders)} clouds: {names}. Choose one with {option}.")
        return folders[0]

    @property
    def pvd(self) -> Path:
        """List of the snapshots; ParaView opens it."""
        return self.path / f"{self.cloud}.pvd"

    @property
    def state(self) -> Path:
        """State of ``foamprb paraview``, which shows the bodies."""
        return self.path / f"{self.cloud}.py"

    @property
    def walls(self) -> Path:
        """Walls that the state shows."""
        return self.path / "walls.vtp"

    @property
    def record(self) -> Path:
        """Description of the run."""
        return self.path / RECORD

    @property
    def checkpoints(self) -> Path:
        """Folder of the checkpoints."""
        return self.path / CHECKPOINTS

    @property
    def page(self) -> Path:
        """Page of ``foamprb view``."""
        return self.path / f"{self.cloud}.html"

    @property
    def report(self) -> Path:
        """Page of ``foamprb report``."""
        return self.path / "report.html"

    @property
    def tracks(self) -> Path | None:
        """Paths that the cloud function ``particleTracks`` wrote; None without them."""
        return min(self.path.glob("*/tracks.vtp"), default=None)

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of the tables on disk, without endings: ``fates``, ``exposure/exposure``, …."""
        files = (*self.path.glob("*.csv"), *self.path.glob("*/*.csv"))
        return tuple(sorted(file.relative_to(self.path).with_suffix("").as_posix() for file in files))

    def leftovers(self, listed: Collection[Path]) -> list[Path]:
        """Return files with names of clouds, checkpoints or temporary files of a run that a list lacks."""
        series = _series(self.cloud)

        def is_ours(file: Path) -> bool:
            top, *below = file.relative_to(self.path).parts
            if top == CHECKPOINTS and below:
                return bool(_CHECKPOINT.fullmatch(below[0]))
            return bool(series.fullmatch(top)) or unfinished(file) is not None

        others = {self.pvd, self.state, self.path / MANIFEST, *listed}
        files = (file for file in sorted(self.path.rglob("*")) if file.is_symlink() or not file.is_dir())
        return [file for file in files if file not in others and is_ours(file)]

    def table(self, name: str) -> Path:
        """Return the file of a table, whether it exists or not."""
        return self.path / f"{name}.csv"

    def snapshot(self, index: int) -> Path:
        """Return the file of the snapshot with an index, without its ending."""
        return self.path / f"{self.cloud}_{index:06d}"


def fault_of_function(name: str, cloud: str) -> str:
    """Return why a cloud function cannot have a name, which names its folder too; empty if it can."""
    tables = {f"{table}.csv" for table in (FATES, FAILURES, TRACERS)} | {f"{FATES}{RECORDS}"}
    if name in {CHECKPOINTS, MANIFEST, RECORD, "manifest", *tables} or _series(cloud).fullmatch(name):
        return "the results have a file of that name"
    return fault_of_word(name)


def _series(cloud: str) -> re.Pattern[str]:
    """Return the pattern of the names of the clouds of a run, of their list, and of what shows them."""
    return re.compile(re.escape(cloud) + r"(\.pvd|\.py|_\d{6,}.*)")


def fault_of_word(name: str) -> str:
    """Return why a name is not a valid OpenFOAM word and file name; empty if it is."""
    if not name:
        return "it is empty"
    if fault := _NO_WORD.search(name):
        return f"it contains {fault[0]!r}"
    if not name.isprintable():
        return "it contains a character that cannot be printed"
    if name.startswith("."):
        return "it begins with a dot"
    if len(name.encode()) > _MOST_BYTES:
        return f"it is longer than {_MOST_BYTES} bytes"
    return ""


def file_name(name: str) -> str:
    """Return a file name: the name itself if it is a word, else with escapes such as ``%2F`` for ``/``.

    Different names have different file names.
    """
    if not fault_of_word(name) and "%" not in name:
        return name
    escaped = quote(name, safe="+:,=@", errors="surrogateescape").replace(".", "%2E")
    if len(escaped) <= _MOST_BYTES:
        return escaped
    checksum = zlib.crc32(name.encode(errors="surrogateescape"))
    return f"{escaped[: _MOST_BYTES - 20]}%{checksum:08X}"


def _written(root: Path) -> Iterator[ResultsFolder]:
    """Give the folders of the clouds that runs have written."""
    for pvd in root.glob("*/*.pvd"):
        if pvd.stem == pvd.parent.name:
            yield ResultsFolder(pvd.parent, pvd.stem)
    for pvd in root.glob("*/*/*.pvd"):
        region = pvd.parents[1]
        if pvd.stem == pvd.parent.name and not (region / f"{region.name}.pvd").exists():
            yield ResultsFolder(pvd.parent, pvd.stem, region.name)
