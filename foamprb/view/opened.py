"""The results of a run as what Python works with: arrays, data frames, pyvista's meshes."""

from __future__ import annotations

import importlib
import json
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.results.tables import KINDS, find_table, read_table
from foamprb.results.vtk import PointCloud, poly_data
from foamprb.view.results import Results, open_results

__all__ = ["Run", "open_run"]

Table = dict[str, NDArray[Any]]
_FRAMES = ("pandas", "polars")


class Run:
    """The results of one cloud in a case, read when they are asked for.

    Parameters
    ----------
    results
        The run's files.
    """

    def __init__(self, results: Results) -> None:
        self._results = results

    def __repr__(self) -> str:
        times = self.times
        return (
            f"<Run of {self.name}: {len(times)} times from {times[0]:g} to {times[-1]:g} s in {self.folder}>"
        )

    @property
    def folder(self) -> Path:
        """``postProcessing/<cloud>``."""
        return self._results.folder

    @property
    def name(self) -> str:
        """The cloud's."""
        return self._results.name

    @property
    def times(self) -> NDArray[np.float64]:
        """The times that were written, (m,), s."""
        return np.array([entry.time for entry in self._results.entries])

    @property
    def units(self) -> dict[str, str]:
        """The unit of each array of :meth:`snapshot`, by name."""
        return dict(self._results.units)

    @cached_property
    def record(self) -> dict[str, Any]:
        """What was run (``run.json``): settings, versions, mesh, warnings; empty without that file."""
        file = self.folder / "run.json"
        if not file.exists():
            return {}
        try:
            found = json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise InputError(f"{file} is damaged: {error}") from error
        if not isinstance(found, dict):
            raise InputError(f"{file} is damaged: it is no record of a run.")
        return found

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of the tables that there are, without endings: ``fates``, ``exposure/exposure``, …."""
        patterns = [f"{folder}*.{kind}" for folder in ("", "*/") for kind in KINDS]
        found = {file.relative_to(self.folder) for pattern in patterns for file in self.folder.glob(pattern)}
        return tuple(sorted({file.with_suffix("").as_posix() for file in found}))

    def file(self, table: str) -> Path:
        """The file of one of :attr:`tables`.

        Raises
        ------
        InputError
            If there is no such table.
        """
        found = find_table(self.folder, table)
        if found is None:
            raise InputError(f"{self.folder}: no table '{table}'. {suggestion(table, self.tables)}")
        return found

    def table(self, name: str = "fates") -> Table:
        """Return the columns of a table by name, (n,) each; the page on settings says what they are.

        Raises
        ------
        InputError
            If there is no such table, or it is damaged; if it is Parquet, and pyarrow is not installed.
        """
        return read_table(self.file(name))

    def frame(self, name: str = "fates") -> Any:
        """Return a table as a data frame of pandas or, without it, of polars.

        Raises
        ------
        InputError
            As :meth:`table`; or neither is installed.
        """
        for package in _FRAMES:
            try:
                return importlib.import_module(package).DataFrame(self.table(name))
            except ImportError:
                continue
        raise InputError("a data frame needs pandas or polars: pip install pandas. Or take: table()")

    def snapshot(self, time: float | None = None) -> pyvista.PolyData:
        """Return the cloud at the written time nearest to ``time``, s, by default the last, with all arrays.

        Raises
        ------
        InputError
            If the file is missing or damaged.
        """
        found = self._results.snapshot(len(self.times) - 1 if time is None else self._results.nearest(time))
        given = self._results
        mesh = pyvista.PolyData(
            poly_data(PointCloud(found.time, found.points, found.arrays, given.units, given.names))
        )
        mesh.field_data["time"] = [found.time]
        return mesh

    @property
    def tracks(self) -> pyvista.PolyData | None:
        """The paths of ``particleTracks``, a line each, with ``time`` at its points; None without."""
        files = sorted(self.folder.glob("*/tracks.vtp"))
        return pyvista.read(files[0]) if files else None


def open_run(path: Path | str, cloud: str | None = None) -> Run:
    """Open the results of a run.

    Parameters
    ----------
    path
        The case.
    cloud
        Name of the cloud; by default ``softCloud``, or the only one that there is.

    Raises
    ------
    InputError
        If there are none, or several without a name; if the list of files or the last file is damaged.
    """
    return Run(open_results(Path(path), cloud))
