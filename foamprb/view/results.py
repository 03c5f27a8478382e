"""Results of a run, read from the files of one cloud: arrays, tables, data frames, meshes of pyvista."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.flow.read.source import FlowSource
from foamprb.optional import load
from foamprb.results.folder import FATES, HOW, TOUCHED, ResultsFolder
from foamprb.results.intervals import share
from foamprb.results.pvd import SnapshotFile, files_of, read_pvd
from foamprb.results.reading import reading
from foamprb.results.record import Record, read_record
from foamprb.results.shapes import DERIVED, SOURCES, derived
from foamprb.results.tables import read_result
from foamprb.results.vtk import PointCloud, Tracks, poly_data, tracks_data
from foamprb.results.vtk_check import is_sealed
from foamprb.view.surfaces import MODE, bulges, unfolded
from foamprb.view.vtk_read import PolyFile, joined, read_own

if TYPE_CHECKING:
    import pyvista

log = logging.getLogger("foamprb")

Table = dict[str, NDArray[Any]]

NEEDED = ("origId", "d", "glyph", "status")
"""Point arrays without which a body cannot be drawn."""

_WORDS = ("fate", "patch")
"""Columns of text, also where every patch has a number for a name."""
_OF_FATES = {"id": np.int64, "t0": np.float64, "t1": np.float64, "Ca": np.float64, "fate": str, "patch": str}
_AGAIN = "Run the particles again: foamprb run."


@dataclass(frozen=True, repr=False)
class Run:
    """Results of one cloud of a case. A file is read when its contents are requested.

    Parameters
    ----------
    results
        Folder of the files.
    entries
        Times and their files, in order of time; at least one.
    units
        Unit of each point array by name.
    names
        For each array of codes, the meanings of 0, 1, ….
    components
        Number of components of each point array by name, in the order of the files; then of the arrays that
        follow from them.
    """

    results: ResultsFolder
    entries: tuple[SnapshotFile, ...]
    units: Mapping[str, str]
    names: Mapping[str, tuple[str, ...]]
    components: Mapping[str, int]

    def __repr__(self) -> str:
        times = self.times
        return (
            f"<Run of {self.name}: {len(times)} times from {times[0]:g} to {times[-1]:g} s in {self.folder}>"
        )

    @property
    def folder(self) -> Path:
        """Path of the folder."""
        return self.results.path

    @property
    def name(self) -> str:
        """Name of the cloud."""
        return self.results.cloud

    def source(self, source: FlowSource | None) -> FlowSource:
        """Return the source of the flow, in the region of the run and with its scale."""
        source = replace(source or FlowSource(), region=self.results.region)
        if source.file is None or source.scale is not None:
            return source
        return replace(source, scale=self.record.get("flow", {}).get("scale"))

    @property
    def times(self) -> NDArray[np.float64]:
        """Written times, (m,), s."""
        return np.array([entry.time for entry in self.entries])

    @cached_property
    def record(self) -> Record:
        """Contents of ``run.json``: settings, versions, mesh, warnings. Empty without that file."""
        return read_record(self.results.record)

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of the tables, without endings: ``fates``, ``exposure/exposure``, …."""
        return self.results.tables

    def file(self, table: str) -> Path:
        """Return the file of one of :attr:`tables`.

        Raises
        ------
        InputError
            If there is no such table.
        """
        file = self.results.table(table)
        if not file.exists():
            raise InputError(f"{self.folder}: no table '{table}'. {suggestion(table, self.tables)}")
        return file

    def table(self, name: str = "fates") -> Table:
        """Return the columns of a table by name, (n,) each; the settings page describes them.

        Raises
        ------
        InputError
            If there is no such table, or it is damaged.
        """
        return read_result(self.file(name), _WORDS)

    def frame(self, name: str = "fates") -> Any:
        """Return a table as a data frame of pandas; InputError without pandas, or as :meth:`table`."""
        return frame_of(self.table(name))

    @property
    def has_fates(self) -> bool:
        """Whether the run has ended and written its table ``fates``."""
        return self.results.table(FATES).exists()

    def fates(self, columns: Collection[str] | None = None) -> Table | None:
        """Return the table ``fates``, or some of its columns; None if the run has not ended.

        Raises
        ------
        InputError
            If the table is damaged or lacks a column.
        """
        if not self.has_fates:
            return None
        file = self.file(FATES)
        table = read_result(file, _WORDS, columns and {*columns, *_OF_FATES, TOUCHED})
        with reading(file, "is not the table that foamprb run writes"):
            # Older tables lack the column.
            table.setdefault(TOUCHED, (table["fate"] == "stuck") & (table["t1"] <= table["t0"]))
            return table | {name: table[name].astype(kind) for name, kind in _OF_FATES.items()}

    def summary(self) -> Table:
        """Return the number and share of the released particles by fate and patch, the most frequent first.

        Columns: ``fate``, ``patch``, ``particles``, ``share``, and its interval of 95 % after Wilson,
        ``shareLow`` and ``shareHigh``.

        Raises
        ------
        InputError
            If the run has not ended; see also :meth:`fates`.
        """
        fates = self.fates()
        if fates is None:
            raise InputError(f"{self.folder}: no fates, the run has not ended. {HOW}")
        return summary_of(fates)

    def nearest(self, time: float) -> int:
        """Return the index of the written time that is nearest to ``time``, s."""
        return int(np.argmin(np.abs(self.times - time)))

    def cloud(
        self,
        index: int,
        arrays: Iterable[str] | None = None,
        rows: Callable[[Table], NDArray[Any]] | None = None,
    ) -> PointCloud:
        """Read the cloud of one time, by default with all its arrays and those that follow from them.

        Parameters
        ----------
        index
            Index of the time.
        arrays
            Names of the arrays.
        rows
            Returns the rows of the particles to return, by the arrays of the file; by default all.

        Raises
        ------
        InputError
            If the file is missing or damaged, or lacks an array that the last time has.
        """
        entry = self.entries[index]
        path = self.folder / entry.file
        names = tuple(self.components) if arrays is None else tuple(arrays)
        stored = names if DERIVED.keys().isdisjoint(names) else (*names, *SOURCES)
        data = _read(path, stored)
        arrays_of_file = dict(data.arrays)
        # Files contain them if the run was asked to write them.
        following = [name for name in names if name in DERIVED and name not in arrays_of_file]
        if missing := [name for name in stored if name not in arrays_of_file and name not in following]:
            raise InputError(
                f"{path}: no array '{missing[0]}', which other times have; are these the files of one run?"
            )
        points = data.points
        del data
        if rows is not None:
            some = rows(arrays_of_file)
            points = points[some]
            arrays_of_file = {name: array[some] for name, array in arrays_of_file.items()}
        if following:
            glyph, d, status = (arrays_of_file[name] for name in SOURCES)
            arrays_of_file |= derived(glyph, d, status, following)
        n = len(points)
        shapes = {name: (n,) if self.components[name] == 1 else (n, self.components[name]) for name in names}
        values = {name: arrays_of_file[name].reshape(shape) for name, shape in shapes.items()}
        return PointCloud(entry.time, points.astype(np.float64), values, self.units, self.names)

    def snapshot(self, time: float | None = None) -> pyvista.PolyData:
        """Return the cloud at the written time nearest to ``time``, s, by default the last, with all arrays.

        Raises
        ------
        InputError
            If the file is missing or damaged, or pyvista is not installed.
        """
        cloud = self.cloud(-1 if time is None else self.nearest(time))
        mesh = load("pyvista").PolyData(poly_data(cloud))
        mesh.field_data["time"] = [cloud.time]
        # For VTK's Tensor Glyph.
        mesh.set_active_tensors("glyph")
        return mesh

    def bodies(
        self, time: float | None = None, enlargement: float = 1.0, resolution: int = 16
    ) -> pyvista.PolyData:
        """Return the surfaces of the bodies at the written time nearest to ``time``, s, by default the last.

        Each point has the arrays of its body. See :meth:`snapshot` for the errors.

        Parameters
        ----------
        time
            Time, s.
        enlargement
            Factor of the size.
        resolution
            Number of facets around a body.
        """
        pyvista, cloud = load("pyvista"), self.cloud(-1 if time is None else self.nearest(time))
        sphere = pyvista.Sphere(radius=1.0, theta_resolution=resolution, phi_resolution=resolution)
        n, size = len(cloud.points), sphere.n_points
        shapes = cloud.arrays["glyph"].reshape(n, 3, 3)
        X = sphere.points.astype(np.float64)
        offsets = X @ shapes
        if MODE in cloud.arrays:
            radius = 0.5 * cloud.arrays["d"].astype(np.float64)[:, None, None]
            finite = np.isfinite(offsets).all(axis=(1, 2))
            F = (shapes.swapaxes(1, 2) / radius)[finite]
            K = bulges(F, unfolded(F, cloud.arrays[MODE][finite]))
            offsets[finite] += radius[finite] * np.einsum("nijk,vj,vk->nvi", K, X, X, optimize=True)
        points = cloud.points[:, None] + enlargement * offsets
        corners = sphere.regular_faces + size * np.arange(n)[:, None, None]
        mesh = pyvista.PolyData.from_regular_faces(points.reshape(-1, 3), corners.reshape(-1, 3))
        for name, array in cloud.arrays.items():
            mesh.point_data[name] = np.repeat(array, size, axis=0)
        mesh.field_data["time"] = [cloud.time]
        return mesh

    @property
    def tracks(self) -> pyvista.PolyData | None:
        """Paths of ``particleTracks``, one line each, with ``time`` at its points; None without."""
        file = self.results.tracks
        if file is None:
            return None
        data = _read(file)
        units, names = _units_of(data), {name: data.texts.get(f"{name}Names", ()) for name in data.arrays}
        values = {name: array[data.order] for name, array in data.arrays.items()}
        paths = Tracks(data.points[data.order], data.start, values, data.of_lines, units, names)
        return load("pyvista").wrap(tracks_data(paths))

    def paths(self, arrays: Iterable[str] = ()) -> Tracks | None:
        """Read the paths of ``particleTracks`` with ``time``, ``origId`` and further arrays at the points.

        Returns
        -------
        None without the function, or if it has recorded no path.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        file = self.results.tracks
        if file is None:
            return None
        wanted = ("time", *arrays)
        data = _read(file, wanted)
        if len(data.start) == 1:
            return None
        if any(name not in data.arrays for name in wanted) or "origId" not in data.of_lines:
            raise InputError(f"{file}: not the paths that the cloud function particleTracks writes.")
        values = {name: data.arrays[name][data.order] for name in wanted}
        points = data.points.astype(np.float64)[data.order]
        return Tracks(points, data.start, values, {"origId": data.of_lines["origId"]})


def summary_of(fates: Table) -> Table:
    """Return :meth:`Run.summary` of a table of fates."""
    pairs = np.stack([fates["fate"], fates["patch"]], axis=1)
    kinds, counts = np.unique(pairs, axis=0, return_counts=True)
    order = np.argsort(-counts, kind="stable")
    kinds, counts = kinds[order], counts[order]
    estimates = np.array([share(int(count), len(pairs)) for count in counts]).reshape(-1, 3)
    columns = dict(zip(("share", "shareLow", "shareHigh"), estimates.T, strict=True))
    return {"fate": kinds[:, 0], "patch": kinds[:, 1], "particles": counts, **columns}


def frame_of(table: Table) -> Any:
    """Return a table as a data frame; see :meth:`Run.frame`."""
    try:
        import pandas
    except ImportError:
        raise InputError("a data frame needs pandas: pip install pandas. Without it: table().") from None
    return pandas.DataFrame(table)


def open_run(
    path: PathLike[str] | str,
    cloud: str | None = None,
    region: str = "",
    results: PathLike[str] | str | None = None,
) -> Run:
    """See :func:`foamprb.view.notebook.open_run`."""
    folder = ResultsFolder.find(Path(path), cloud, region, None if results is None else Path(results))
    entries = read_pvd(folder.pvd)
    if not entries:
        raise InputError(f"{folder.pvd}: lists no files; the run has not written any yet. {HOW}")
    # Units, names and components stand in the last file, which has the most particles.
    file = folder.path / entries[-1].file
    data = _read(file)
    components = {key: 1 if array.ndim == 1 else array.shape[1] for key, array in data.arrays.items()}
    missing = [key for key in NEEDED if key not in components]
    if missing:
        raise InputError(f"{file}: no array '{missing[0]}'; not a cloud that foamprb run wrote.")
    units = _units_of(data)
    for name, (unit, number) in DERIVED.items():
        components.setdefault(name, number)
        units.setdefault(name, unit)
    names = {key: meanings for key in components if (meanings := tuple(data.texts.get(f"{key}Names", ())))}
    return Run(folder, entries, units, names, components)


def _units_of(data: PolyFile) -> dict[str, str]:
    """Return the units of arrays by the names of these."""
    return {name: unit for name, _, unit in (text.partition(" ") for text in data.texts.get("units", ()))}


def _read(path: Path, arrays: Collection[str] | None = None) -> PolyFile:
    """Read a file of points or lines that foamprb wrote, with all its point arrays or some of them."""
    if not path.exists():
        raise InputError(f"{path}: missing, though the list of files names it. {_AGAIN}")
    with reading(path, remedy=_AGAIN):
        pieces = [file for file in files_of(path) if file.suffix == ".vtp"]
        for file in pieces:
            is_sealed(file)
        return joined([read_own(file, arrays) for file in pieces])
