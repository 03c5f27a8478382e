"""The files of ``postProcessing/<cloud>/`` as arrays: snapshots, fates and tracks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyvista
from numpy.typing import NDArray

from foamprb.errors import InputError, suggestion
from foamprb.flow.read.vtk_reader import vtk_messages
from foamprb.results.pvd import Entry, read_pvd
from foamprb.results.tables import find_table, read_table

Floats = NDArray[np.float64]

NEEDED = ("origId", "d", "glyph", "status")
"""Point arrays without which a body cannot be drawn."""

_HOW = "Run the particles first: foamprb run."
_AGAIN = "Run the particles anew: foamprb run."


class Snapshot(NamedTuple):
    """A cloud of n bodies at one time."""

    time: float
    """s."""
    points: Floats
    """Positions, (n, 3), m."""
    arrays: dict[str, NDArray[Any]]
    """Point arrays by name, (n,) or (n, k)."""


class Fates(NamedTuple):
    """Columns of the table ``fates``, a row for each of n bodies."""

    ids: NDArray[np.int64]
    fate: list[str]
    patch: list[str]
    """Where it ended; empty for one that did not."""
    start: Floats
    """Time of release, s."""
    end: Floats
    """Time to which it was tracked, s."""
    capillary: Floats
    """Capillary number of the settings."""


class Paths(NamedTuple):
    """Polylines of m bodies, one after the other."""

    ids: NDArray[np.int64]
    """(m,)"""
    points: Floats
    """(n, 3), m."""
    times: Floats
    """(n,), s."""
    start: NDArray[np.int64]
    """Where each path begins among the points, and n, (m + 1,)."""


@dataclass(frozen=True)
class Results:
    """What a run of one cloud left on disk.

    Parameters
    ----------
    folder
        ``postProcessing/<cloud>``.
    name
        The cloud.
    entries
        The times and their files, in order of time; at least one.
    units
        Unit of each array by name, as the files give it.
    names
        For an array of codes, what 0, 1, … mean.
    components
        Number of components of each array by name, in the order of the files.
    """

    folder: Path
    name: str
    entries: tuple[Entry, ...]
    units: Mapping[str, str]
    names: Mapping[str, tuple[str, ...]]
    components: Mapping[str, int]

    def snapshot(self, index: int, arrays: Iterable[str] | None = None) -> Snapshot:
        """Read the cloud of one time, by default with all its arrays.

        Raises
        ------
        InputError
            If the file is missing, damaged or lacks an array that those of other times have.
        """
        entry = self.entries[index]
        wanted = tuple(self.components) if arrays is None else tuple(arrays)
        data = _read(self.folder / entry.file, wanted)
        found: dict[str, NDArray[Any]] = {}
        for name in wanted:
            if name not in data.point_data:
                raise InputError(
                    f"{self.folder / entry.file}: no array '{name}', which other times have; are these the "
                    "files of one run?"
                )
            # Of no bodies VTK forgets how many components there were.
            shape = (-1,) if self.components[name] == 1 else (data.n_points, self.components[name])
            found[name] = np.array(data.point_data[name]).reshape(shape)
        return Snapshot(entry.time, np.array(data.points, dtype=np.float64).reshape(-1, 3), found)

    def nearest(self, time: float) -> int:
        """Index of the snapshot whose time, s, is nearest."""
        return int(np.argmin([abs(entry.time - time) for entry in self.entries]))

    @property
    def has_fates(self) -> bool:
        """Whether the run has ended and written its table ``fates``."""
        return find_table(self.folder, "fates") is not None

    def fates(self) -> Fates | None:
        """Read the table ``fates``; None if the run has not written it, as it has not ended.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        path = find_table(self.folder, "fates")
        if path is None:
            return None
        found = read_table(path, words=("fate", "patch"))
        try:
            return Fates(
                np.asarray(found["id"], dtype=np.int64),
                found["fate"].tolist(),
                found["patch"].tolist(),
                *(np.asarray(found[key], dtype=np.float64) for key in ("t0", "t1", "Ca")),
            )
        except (KeyError, ValueError) as error:
            raise InputError(f"{path}: not the table that foamprb run writes ({error}).") from error

    def paths(self) -> Paths | None:
        """Read the paths of the cloud function ``particleTracks``; None if there are none.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        files = sorted(self.folder.glob("*/tracks.vtp"))
        if not files:
            return None
        data = _read(files[0], ("time",))
        if data.n_lines == 0:
            return None
        ids = data.cell_data.get("origId")
        times = data.point_data.get("time")
        offsets = np.array(pyvista.convert_array(data.GetLines().GetOffsetsArray()), dtype=np.int64)
        order = np.array(pyvista.convert_array(data.GetLines().GetConnectivityArray()), dtype=np.int64)
        if ids is None or times is None or len(ids) != len(offsets) - 1:
            raise InputError(f"{files[0]}: not the paths that the cloud function particleTracks writes.")
        points = np.array(data.points, dtype=np.float64)[order]
        return Paths(np.array(ids, dtype=np.int64), points, np.array(times)[order], offsets)


def open_results(case: Path, cloud: str | None = None) -> Results:
    """Find the results of a cloud in a case.

    Parameters
    ----------
    case
        Folder of the case.
    cloud
        Name of the cloud; by default ``softCloud``, or the only one that there is.

    Raises
    ------
    InputError
        If there are none, or several without a name; if the list of files or the last file is damaged.
    """
    if not case.is_dir():
        raise InputError(f"{case}: no such folder.")
    found = {path.stem: path for path in case.glob("postProcessing/*/*.pvd") if path.stem == path.parent.name}
    if not found:
        raise InputError(f"{case}: no results here (postProcessing/<cloud>/<cloud>.pvd). {_HOW}")
    name = cloud or ("softCloud" if "softCloud" in found else next(iter(found)))
    if cloud is None and len(found) > 1 and "softCloud" not in found:
        raise InputError(f"{case}: the results of {len(found)} clouds are here: {', '.join(sorted(found))}. "
                         "Choose one with -cloud.")  # fmt: skip
    if name not in found:
        raise InputError(f"{case}: no results of a cloud '{name}'. {suggestion(name, found)}")
    pvd = found[name]
    entries = read_pvd(pvd)
    if not entries:
        raise InputError(f"{pvd}: lists no files; the run has not written any yet. {_HOW}")
    return _described(pvd.parent, name, entries)


def _described(folder: Path, name: str, entries: tuple[Entry, ...]) -> Results:
    """Take units, names and components from the last file, which has the most particles."""
    file = folder / entries[-1].file
    data = _read(file)
    components = {
        key: 1 if data.point_data[key].ndim == 1 else int(data.point_data[key].shape[1])
        for key in data.point_data.keys()  # noqa: SIM118 - pyvista iterates otherwise
    }
    missing = [key for key in NEEDED if key not in components]
    if missing:
        raise InputError(f"{file}: no array '{missing[0]}'; not a cloud that foamprb run wrote.")
    fields = data.field_data
    words = [str(text).partition(" ") for text in fields.get("units", ())]
    names = {key: tuple(map(str, fields[f"{key}Names"])) for key in components if f"{key}Names" in fields}
    return Results(folder, name, entries, {key: unit for key, _, unit in words}, names, components)


def _read(path: Path, arrays: Iterable[str] | None = None) -> Any:
    """Read a VTK file, with all its point arrays or some of them."""
    if not path.exists():
        raise InputError(
            f"{path}: missing, though the list of files names it. Run the particles anew: foamprb run."
        )
    data, failure = None, ""
    with vtk_messages() as said:
        try:
            reader = pyvista.get_reader(path)
            if arrays is not None:
                reader.disable_all_point_arrays()
                for name in arrays:
                    reader.enable_point_array(name)
            data = reader.read()
        except Exception as error:
            failure = " ".join(str(error).split())
    if failure or said.errors:
        reason = said.errors[0].rstrip(".") if said.errors else failure
        raise InputError(f"{path}: damaged ({reason}). {_AGAIN}")
    if not isinstance(data, pyvista.PolyData):
        raise InputError(f"{path}: not a cloud of particles.")
    return data
