"""Clouds as ParaView reads them: one ``.vtp`` per time, or a ``.pvtp`` with pieces, and a ``.pvd``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonMisc import vtkErrorCode
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from foamprb.errors import InputError
from foamprb.output.atomic import atomic_write

_BLOCK_BYTES = 1 << 20
"""Compressed at a time: VTK's own 32 kB would cost a quarter more time."""


@dataclass(frozen=True)
class PointCloud:
    """A cloud of n particles at one time.

    Parameters
    ----------
    time
        Time, s.
    points
        Positions, shape (n, 3), m.
    arrays
        Values at the points by name, each of shape (n,) or (n, k); each keeps its type, except that truth
        values become 0 and 1.
    units
        Unit of each array by name.
    names
        For an array of codes, what the codes 0, 1, … mean: ``{"status": ("pending", "active", …)}``.

    Raises
    ------
    ValueError
        If an array does not have n rows and one or two axes.
    """

    time: float
    points: NDArray[np.float64]
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, Sequence[str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.points.ndim != 2 or self.points.shape[1] != 3:
            raise ValueError(f"Points of a snapshot have shape {self.points.shape}, not (n, 3).")
        n = len(self.points)
        for name, array in self.arrays.items():
            if array.ndim not in (1, 2) or len(array) != n:
                raise ValueError(
                    f"Array '{name}' of a snapshot has shape {array.shape}, not ({n},) or ({n}, k)."
                )


class Parts(NamedTuple):
    """A cloud bit by bit, so that a large one need never be in memory as a whole."""

    time: float
    """Time of all, s."""
    number: int
    """At least one."""
    snapshots: Iterator[PointCloud]
    """So many, with the same arrays, units and names."""


def write_snapshot(path: Path, cloud: PointCloud | Parts) -> tuple[PieceArray, ...]:
    """Write a cloud as VTK PolyData, in one step: a vertex per particle, with its point arrays.

    Field data are ``TimeValue``, ``units`` (``"rho kg/m3"``, …) and, for each array of codes,
    ``<array>Names``. Each part of a cloud becomes a piece of the file.

    Parameters
    ----------
    path
        The file, ``.vtp``.
    cloud
        The cloud.

    Returns
    -------
    The :func:`layout` of the cloud.

    Raises
    ------
    OSError
        If the file cannot be written.
    Exception
        Whatever the parts raise; what was at ``path`` is as it was.
    """
    parts = Parts(cloud.time, 1, iter([cloud])) if isinstance(cloud, PointCloud) else cloud
    source = _Source(parts)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetNumberOfPieces(parts.number)
    _write(path, writer, source)
    return source.layout


class _Source(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """Gives VTK's writer, which asks for piece after piece, the parts of a cloud."""

    def __init__(self, parts: Parts) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self.parts = parts
        self.layout: tuple[PieceArray, ...] = ()
        self.error: Exception | None = None
        """What went wrong: no exception comes back from VTK."""
        self._last: vtkPolyData | None = None

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:  # noqa: ARG002
        outputs.GetInformationObject(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:  # noqa: ARG002
        if self.error is None:
            try:
                snapshot = next(self.parts.snapshots)
                self.layout = self.layout or layout(snapshot)
                self._last = _poly_data(snapshot)
            except Exception as error:
                self.error = error
        if self._last is None:
            return 0
        # Also after an error: a writer whose source fails after the first piece would ask for ever.
        vtkPolyData.GetData(outputs).ShallowCopy(self._last)
        return 1


class PieceArray(NamedTuple):
    """An array of a cloud as a ``.pvtp`` declares it: its name, VTK's name of its type, its components."""

    name: str
    type: str
    components: int


def layout(snapshot: PointCloud) -> tuple[PieceArray, ...]:
    """The arrays of a cloud, the points first."""
    arrays = {"Points": np.asarray(snapshot.points, dtype=np.float64), **snapshot.arrays}
    return tuple(
        PieceArray(name, _type_name(array.dtype), 1 if array.ndim == 1 else array.shape[1])
        for name, array in arrays.items()
    )


def write_pieces(path: Path, arrays: Sequence[PieceArray], pieces: Sequence[Path]) -> None:
    """Write the file by which several ``.vtp`` are one cloud, in one step.

    Parameters
    ----------
    path
        The file, ``.pvtp``.
    arrays
        What :func:`layout` says of each of the pieces.
    pieces
        The files of the pieces, in a folder in that of ``path``.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    points, *values = (
        f'<PDataArray type="{a.type}" Name={quoteattr(a.name)} NumberOfComponents="{a.components}"/>\n'
        for a in arrays
    )
    sources = (quoteattr(piece.relative_to(path.parent).as_posix()) for piece in pieces)
    text = (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="PPolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        '  <PPolyData GhostLevel="0">\n'
        f"    <PPointData>\n{''.join(f'      {value}' for value in values)}    </PPointData>\n"
        f"    <PPoints>\n      {points}    </PPoints>\n"
        f"{''.join(f'    <Piece Source={source}/>{chr(10)}' for source in sources)}"
        "  </PPolyData>\n</VTKFile>\n"
    )
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def files_of(path: Path) -> tuple[Path, ...]:
    """A cloud's file and those of its pieces, if it has any, whether they are there or not."""
    if path.suffix != ".pvtp" or not path.exists():
        return (path,)
    root = ElementTree.fromstring(path.read_bytes())
    return (path, *(path.parent / piece.attrib["Source"] for piece in root.iter("Piece")))


def _type_name(dtype: np.dtype[Any]) -> str:
    kind = {"f": "Float", "i": "Int", "u": "UInt", "b": "Int"}[dtype.kind]
    return f"{kind}{8 * dtype.itemsize}"


def _write(path: Path, writer: vtkXMLPolyDataWriter, source: _Source | None = None) -> None:
    """Write PolyData in one step; VTK lets other threads go on meanwhile."""
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    # Mantissas of doubles hardly compress: zlib would gain 8 % in size for 25 times the time.
    writer.SetCompressorTypeToLZ4()
    writer.SetBlockSize(_BLOCK_BYTES)
    # Observed errors go unprinted; the error code tells what happened.
    sources = () if source is None else (source, source.GetExecutive())
    for spoken in (writer, writer.GetExecutive(), *sources):
        spoken.AddObserver("ErrorEvent", lambda *_: None)
    with atomic_write(path) as temporary:
        writer.SetFileName(str(temporary))
        written = writer.Write()
        if source is not None and source.error is not None:
            raise source.error
        if written != 1 or writer.GetErrorCode():
            reason = vtkErrorCode.GetStringFromErrorCode(writer.GetErrorCode())
            raise OSError(f"{path}: VTK could not write this file ({reason}).")


@dataclass(frozen=True)
class Tracks:
    """Paths of m particles, one after the other.

    Parameters
    ----------
    points
        Positions, shape (n, 3), m, path after path.
    start
        Where each path begins among the points, and n, shape (m + 1,).
    values
        Arrays by name, (n,) or (n, k): at the points.
    tracks
        Arrays by name, (m,): of the paths.
    units, names
        As of a :class:`PointCloud`.
    """

    points: NDArray[np.float64]
    start: NDArray[np.int64]
    values: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    tracks: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, Sequence[str]] = field(default_factory=dict)


def write_tracks(path: Path, tracks: Tracks) -> None:
    """Write paths as VTK PolyData, in one step: a polyline per path, with point and cell arrays.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(_vtk_array("Points", np.asarray(tracks.points, dtype=np.float64)))
    data.SetPoints(points)
    lines = vtkCellArray()
    order = np.arange(len(tracks.points), dtype=np.int64)
    lines.SetData(_vtk_array("offsets", tracks.start), _vtk_array("connectivity", order))
    data.SetLines(lines)
    for name, array in tracks.values.items():
        data.GetPointData().AddArray(_vtk_array(name, array))
    for name, array in tracks.tracks.items():
        data.GetCellData().AddArray(_vtk_array(name, array))
    _add_texts(data, tracks.units, tracks.names)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    _write(path, writer)


class Entry(NamedTuple):
    """One line of a ``.pvd``: a time, s, and the name of its file in the same folder."""

    time: float
    file: str


class Series:
    """The files ``<name>_<index>.vtp`` of one cloud and the ``<name>.pvd`` that lists them with their times.

    A cloud that several processes write is a ``.pvtp``, with pieces in a folder of the same name. At any
    moment the ``.pvd`` on disk names whole files only.

    Parameters
    ----------
    folder
        Where the files are; made when the first is written.
    name
        The cloud's name.
    """

    def __init__(self, folder: Path, name: str) -> None:
        self.folder = folder
        self.name = name
        self.entries: tuple[Entry, ...] = ()

    @property
    def pvd(self) -> Path:
        """The file that ParaView opens."""
        return self.folder / f"{self.name}.pvd"

    def append(self, cloud: PointCloud | Parts) -> Path:
        """Write a cloud and list it.

        Returns
        -------
        The ``.vtp`` file.

        Raises
        ------
        ValueError
            If the time is not later than that of the cloud before.
        OSError
            If a file cannot be written.
        """
        file = with_ending(self.next(cloud.time), ".vtp")
        write_snapshot(file, cloud)
        self.add(cloud.time, file)
        return file

    def next(self, time: float) -> Path:
        """The file for the cloud of a time, s, without its ending.

        Raises
        ------
        ValueError
            If the time is not later than that of the cloud before.
        """
        if self.entries and not time > self.entries[-1].time:
            raise ValueError(f"Time {time!r} s does not follow {self.entries[-1].time!r} s.")
        last = re.search(r"_(\d+)\.p?vtp$", self.entries[-1].file) if self.entries else None
        index = int(last[1]) + 1 if last else len(self.entries)
        return self.folder / f"{self.name}_{index:06d}"

    def add(self, time: float, file: Path) -> None:
        """List a file that is whole, named by :meth:`next`.

        Raises
        ------
        OSError
            If the list cannot be written.
        """
        self._list((*self.entries, Entry(float(time), file.name)))

    def relist(self, entries: Sequence[Entry]) -> None:
        """List clouds that an earlier run has written, in order of time, and no others.

        Raises
        ------
        OSError
            If the list cannot be written, or removed when it is empty.
        """
        if entries:
            self._list(tuple(entries))
        else:
            self.pvd.unlink(missing_ok=True)
            self.entries = ()

    def _list(self, entries: tuple[Entry, ...]) -> None:
        with atomic_write(self.pvd) as temporary:
            temporary.write_text(_pvd_text(entries), encoding="utf-8")
        self.entries = entries


def with_ending(stem: Path, ending: str) -> Path:
    """The file of a cloud, of whose name a dot may be a part; ``ending`` is ``.vtp`` or ``.pvtp``."""
    return stem.with_name(stem.name + ending)


def read_pvd(path: Path) -> tuple[Entry, ...]:
    """Read the times and files that a ``.pvd`` lists.

    Returns
    -------
    The entries in order of time.

    Raises
    ------
    InputError
        If the file cannot be read, is not such a list, or names a file outside its own folder.
    """
    try:
        root = ElementTree.fromstring(path.read_bytes())
        entries = [Entry(float(e.attrib["timestep"]), e.attrib["file"]) for e in root.iter("DataSet")]
    except (OSError, ElementTree.ParseError, KeyError, ValueError) as error:
        raise InputError(f"{path}: not a readable list of VTK files ({error}).") from error
    for entry in entries:
        if Path(entry.file).name != entry.file or not entry.file.endswith((".vtp", ".pvtp")):
            raise InputError(
                f"{path}: names '{entry.file}', which is not a .vtp or .pvtp file in its own folder."
            )
    return tuple(sorted(entries))


def _pvd_text(entries: Sequence[Entry]) -> str:
    lines = [f'    <DataSet timestep="{e.time!r}" part="0" file={quoteattr(e.file)}/>\n' for e in entries]
    return (
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n'
        f"{''.join(lines)}"
        "  </Collection>\n</VTKFile>\n"
    )


def _poly_data(snapshot: PointCloud) -> vtkPolyData:
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(_vtk_array("Points", np.asarray(snapshot.points, dtype=np.float64)))
    data.SetPoints(points)
    data.SetVerts(_vertices(len(snapshot.points)))
    for name, array in snapshot.arrays.items():
        data.GetPointData().AddArray(_vtk_array(name, array))
    fields = data.GetFieldData()
    fields.AddArray(_vtk_array("TimeValue", np.array([snapshot.time], dtype=np.float64)))
    _add_texts(data, snapshot.units, snapshot.names)
    return data


def _add_texts(data: vtkPolyData, units: Mapping[str, str], names: Mapping[str, Sequence[str]]) -> None:
    """Add the units of the arrays, and what codes mean."""
    fields = data.GetFieldData()
    if units:
        fields.AddArray(_text_array("units", [f"{name} {unit}" for name, unit in units.items()]))
    for name, meanings in names.items():
        fields.AddArray(_text_array(f"{name}Names", meanings))


def _vertices(n: int) -> vtkCellArray:
    cells = vtkCellArray()
    index = np.arange(n + 1, dtype=np.int64)
    cells.SetData(_vtk_array("offsets", index), _vtk_array("connectivity", index[:n]))
    return cells


def _vtk_array(name: str, array: NDArray[Any]) -> Any:
    plain = array.astype(np.int8) if array.dtype == np.bool_ else array
    result = numpy_to_vtk(np.ascontiguousarray(plain), deep=True)
    result.SetName(name)
    return result


def _text_array(name: str, texts: Sequence[str]) -> vtkStringArray:
    result = vtkStringArray()
    result.SetName(name)
    for text in texts:
        result.InsertNextValue(text)
    return result
