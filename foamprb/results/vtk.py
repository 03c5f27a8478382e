"""Clouds and tracks as VTK PolyData: a ``.vtp`` file, or a ``.pvtp`` of several pieces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple
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

from foamprb.results.atomic import atomic_write

_BLOCK_BYTES = 1 << 20
"""Compression block; VTK's default, 32 kB, takes a quarter more time."""


@dataclass(frozen=True)
class PointCloud:
    """Cloud of n particles at one time.

    Parameters
    ----------
    time
        Time, s.
    points
        Positions, shape (n, 3), m.
    arrays
        Values at the points by name, each of shape (n,) or (n, k); types are kept, except that booleans
        become 0 and 1.
    units
        Unit of each array by name.
    names
        For an array of codes, the meaning of the codes 0, 1, …: ``{"status": ("pending", "active", …)}``.

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
    """Cloud in parts, so that a large one is never completely in memory."""

    time: float
    """Time of all parts, s."""
    number: int
    """Number of parts, at least 1."""
    snapshots: Iterator[PointCloud]
    """Iterator over ``number`` parts with the same arrays, units and names."""


def write_snapshot(path: Path, cloud: PointCloud | Parts) -> tuple[PieceArray, ...]:
    """Write a cloud as VTK PolyData, atomically: a vertex per particle, with its point arrays.

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
        Any exception of the parts; ``path`` is then unchanged.
    """
    parts = Parts(cloud.time, 1, iter([cloud])) if isinstance(cloud, PointCloud) else cloud
    source = _Source(parts)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetNumberOfPieces(parts.number)
    _write(path, writer, source)
    return source.layout


class _Source(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """VTK source that passes the parts of a cloud to the writer, one piece per request."""

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
                self._last = poly_data(snapshot)
            except Exception as error:
                self.error = error
        if self._last is None:
            return 0
        # Also after an error: if its source fails after the first piece, the writer would repeat the request
        # for ever.
        vtkPolyData.GetData(outputs).ShallowCopy(self._last)
        return 1


class PieceArray(NamedTuple):
    """Declaration of an array in a ``.pvtp``: name, VTK's name of its type, components."""

    name: str
    type: str
    components: int


def layout(snapshot: PointCloud) -> tuple[PieceArray, ...]:
    """Return the arrays of a cloud, the points first."""
    arrays = {"Points": np.asarray(snapshot.points, dtype=np.float64), **snapshot.arrays}
    return tuple(
        PieceArray(name, _type_name(array.dtype), 1 if array.ndim == 1 else array.shape[1])
        for name, array in arrays.items()
    )


def write_pieces(path: Path, arrays: Sequence[PieceArray], pieces: Sequence[Path]) -> None:
    """Write the file that joins several ``.vtp`` to one cloud, atomically.

    Parameters
    ----------
    path
        The file, ``.pvtp``.
    arrays
        :func:`layout` of each of the pieces.
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


def _type_name(dtype: np.dtype[Any]) -> str:
    kind = {"f": "Float", "i": "Int", "u": "UInt", "b": "Int"}[dtype.kind]
    return f"{kind}{8 * dtype.itemsize}"


def _write(path: Path, writer: vtkXMLPolyDataWriter, source: _Source | None = None) -> None:
    """Write PolyData atomically; other threads run while VTK writes."""
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    # Mantissas of doubles hardly compress: zlib gains 8 % in size in 25 times the time.
    writer.SetCompressorTypeToLZ4()
    writer.SetBlockSize(_BLOCK_BYTES)
    # VTK does not print observed errors; the error code gives the reason.
    sources = () if source is None else (source, source.GetExecutive())
    for part in (writer, writer.GetExecutive(), *sources):
        part.AddObserver("ErrorEvent", lambda *_: None)
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
    """Paths of m particles, stored consecutively.

    Parameters
    ----------
    points
        Positions, shape (n, 3), m, path after path.
    start
        Index of the first point of each path, and n, shape (m + 1,).
    values
        Arrays by name, (n,) or (n, k): at the points.
    tracks
        Arrays by name, (m,): of the paths.
    units, names
        See :class:`PointCloud`.
    """

    points: NDArray[np.float64]
    start: NDArray[np.int64]
    values: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    tracks: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, Sequence[str]] = field(default_factory=dict)


def write_tracks(path: Path, tracks: Tracks) -> None:
    """Write paths as VTK PolyData, atomically: a polyline per path, with point and cell arrays.

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


def poly_data(snapshot: PointCloud) -> vtkPolyData:
    """Return a cloud as VTK PolyData, like :func:`write_snapshot`; it shares the memory of the arrays."""
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
    """Add the units of the arrays, and the meaning of codes."""
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
    result = numpy_to_vtk(np.ascontiguousarray(plain))
    result.SetName(name)
    return result


def _text_array(name: str, texts: Sequence[str]) -> vtkStringArray:
    result = vtkStringArray()
    result.SetName(name)
    for text in texts:
        result.InsertNextValue(text)
    return result
