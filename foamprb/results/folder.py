"""Folder of one cloud's results, and the names of its files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from foamprb.errors import InputError, suggestion
from foamprb.results.names import fault_of_word

__all__ = ["FAILURES", "FATES", "KINDS", "MANIFEST", "RECORD_FORMAT", "ResultsFolder", "fault_of_function"]

DEFAULT_CLOUD = "softCloud"
FATES, FAILURES = "fates", "failed"
"""Tables of a run: a row per particle, and a row per failed particle."""
KINDS = ("csv", "parquet")
"""Kinds of tables, the suffixes of their files."""
MANIFEST, RECORD, CHECKPOINTS = "manifest.json", "run.json", "checkpoint"
RECORD_FORMAT = 2
"""Version of the entries of the record."""
_ROOT = "postProcessing"
HOW = "Run the particles first: foamprb run."


@dataclass(frozen=True, order=True)
class ResultsFolder:
    """Folder of one cloud's results, ``postProcessing/[<region>/]<cloud>`` in a case.

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
    def of_case(cls, case: Path, cloud: str, region: str = "") -> ResultsFolder:
        """Return the folder for the results of a cloud."""
        return cls(case / _ROOT / region / cloud, cloud, region)

    @classmethod
    def find(cls, case: Path, cloud: str | None = None, region: str = "") -> ResultsFolder:
        """Find the results of runs in a case.

        Parameters
        ----------
        case
            Folder of the case.
        cloud
            Name of the cloud; by default ``softCloud``, or the only one.
        region
            Region of the mesh; by default the default region, or any other if that has no results.

        Raises
        ------
        InputError
            If there are no such results, or several clouds or regions have results.
        """
        if not case.is_dir():
            raise InputError(f"{case}: no such folder.")
        found = sorted(_written(case))
        if not found:
            raise InputError(
                f"{case}: no results here ({_ROOT}/<cloud>/<cloud>.pvd, in a region: "
                f"{_ROOT}/<region>/<cloud>/<cloud>.pvd). {HOW}"
            )
        regions = {folder.region for folder in found}
        if region and region not in regions:
            raise InputError(f"{case}: no results of region '{region}'. {suggestion(region, regions - {''})}")
        if region or "" in regions:
            found = [folder for folder in found if folder.region == region]
        clouds = {folder.cloud for folder in found}
        if cloud is not None and cloud not in clouds:
            raise InputError(f"{case}: no results of a cloud '{cloud}'. {suggestion(cloud, clouds)}")
        name = cloud or DEFAULT_CLOUD
        if name in clouds:
            found = [folder for folder in found if folder.cloud == name]
        if len(found) > 1:
            names = ", ".join(folder.path.relative_to(case / _ROOT).as_posix() for folder in found)
            option = "-cloud" if len(clouds) > 1 and name not in clouds else "-region"
            raise InputError(f"{case}: results of {len(found)} clouds: {names}. Choose one with {option}.")
        return found[0]

    @property
    def pvd(self) -> Path:
        """Return the list of the snapshots, for ParaView."""
        return self.path / f"{self.cloud}.pvd"

    @property
    def state(self) -> Path:
        """Return ParaView's state, which shows the bodies."""
        return self.path / f"{self.cloud}.py"

    @property
    def record(self) -> Path:
        """Return the description of the run."""
        return self.path / RECORD

    @property
    def checkpoints(self) -> Path:
        """Return the folder of the checkpoints."""
        return self.path / CHECKPOINTS

    @property
    def page(self) -> Path:
        """Return the page of ``foamprb view``."""
        return self.path / f"{self.cloud}.html"

    @property
    def report(self) -> Path:
        """Return the page of ``foamprb report``."""
        return self.path / "report.html"

    @property
    def tracks(self) -> Path | None:
        """Return the paths of the cloud function ``particleTracks``; None without them."""
        return min(self.path.glob("*/tracks.vtp"), default=None)

    @property
    def tables(self) -> tuple[str, ...]:
        """Return the names of the tables on disk, without suffix: ``fates``, ``exposure/exposure``, …."""
        patterns = [f"{folder}*.{kind}" for folder in ("", "*/") for kind in KINDS]
        found = {file.relative_to(self.path) for pattern in patterns for file in self.path.glob(pattern)}
        return tuple(sorted({file.with_suffix("").as_posix() for file in found}))

    def table(self, name: str, kind: str = "csv") -> Path:
        """Return the file of a table, whether it exists or not."""
        return self.path / f"{name}.{kind}"

    def find_table(self, name: str) -> Path | None:
        """Return the file of a table of any kind; None without one."""
        return next((file for kind in KINDS if (file := self.table(name, kind)).exists()), None)

    def snapshot(self, index: int) -> Path:
        """Return the file of the snapshot with an index, without suffix."""
        return self.path / f"{self.cloud}_{index:06d}"


def fault_of_function(name: str, cloud: str) -> str:
    """Return why a name is not valid for a cloud function and its folder; empty if it is."""
    series = re.compile(re.escape(cloud) + r"(\.pvd|\.py|_\d{6,}.*)")
    tables = {f"{table}.{kind}" for table in (FATES, FAILURES) for kind in KINDS}
    if name in {CHECKPOINTS, MANIFEST, RECORD, "manifest", *tables} or series.fullmatch(name):
        return "the results have a file of that name"
    return fault_of_word(name)


def _written(case: Path) -> Iterator[ResultsFolder]:
    """Yield the folders of the clouds with results in a case."""
    for pvd in (case / _ROOT).glob("*/*.pvd"):
        if pvd.stem == pvd.parent.name:
            yield ResultsFolder(pvd.parent, pvd.stem)
    for pvd in (case / _ROOT).glob("*/*/*.pvd"):
        region = pvd.parents[1]
        if pvd.stem == pvd.parent.name and not (region / f"{region.name}.pvd").exists():
            yield ResultsFolder(pvd.parent, pvd.stem, region.name)
