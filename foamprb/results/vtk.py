"""Clouds and tracks as VTK PolyData: ``.vtp`` files, ``.pvtp`` files of several pieces, and VTKHDF files."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkCommonMisc import vtkErrorCode
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from foamprb.results.atomic import atomic_write, write_text
from foamprb.results.vtk_check import seal

_BLOCK_BYTES = 1 << 20
"""Size of a compressed block; VTK's default of 32 kB is slower."""
_CHUNK = 4096
"""Values in a compressed block of a VTKHDF file, the smallest size of an array there."""


@dataclass(frozen=True)
class PointCloud:
    """Cloud of n particles at one time.

    Parameters
    ----------
    time
        Time, s.
    points
        Positions, shape (n, 3), m, in double or single precision.
    arrays
        Values at the points by name, each of shape (n,) or (n, k). Each keeps its type, but Booleans become
        0 and 1.
    units
        Unit of each array by name.
    names
        For each array of codes, the meanings of the codes 0, 1, …: ``{"status": ("pending", "active", …)}``.
    """

    time: float
    points: NDArray[Any]
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, Sequence[str]] = field(default_factory=dict)


class Parts(NamedTuple):
    """Cloud in parts, so that a large one is never in memory as a whole."""

    time: float
    """Time of all parts, s."""
    number: int
    """Number of parts, at least one."""
    snapshots: Iterator[PointCloud]
    """The parts, all with the same arrays, units and names."""


def write_snapshot(path: Path, cloud: PointCloud | Parts) -> tuple[PieceArray, ...]:
    """Write a cloud as VTK PolyData, in one step: a vertex per particle, with its point arrays.

    Field data are ``TimeValue``, ``units`` (``"rho kg/m3"``, …) and, for each array of codes,
    ``<array>Names``. Each part of a cloud becomes a piece of the file. Returns the :func:`layout`.

    Raises
    ------
    Exception
        Any exception of the parts; ``path`` is unchanged then.
    """
    parts = Parts(cloud.time, 1, iter([cloud])) if isinstance(cloud, PointCloud) else cloud
    source = _Source(lambda _: next(parts.snapshots))
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetNumberOfPieces(parts.number)
    _write_xml(path, writer, source)
    return source.layout


def write_vtkhdf(path: Path, times: Sequence[float], cloud_of: Callable[[int], PointCloud]) -> None:
    """Write the clouds of all times into one file, in one step, with one cloud at a time in memory.

    Parameters
    ----------
    path
        The file, ``.vtkhdf``.
    times
        Increasing times, s; the file stores them in single precision.
    cloud_of
        Returns the cloud of a time, by its index; all have the same arrays.

    Raises
    ------
    OSError
        If the file cannot be written.
    Exception
        Any exception of ``cloud_of``; ``path`` is unchanged then.
    """
    from vtkmodules.vtkIOHDF import vtkHDFWriter

    source, writer = _Source(cloud_of, times), vtkHDFWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetWriteAllTimeSteps(True)
    writer.SetCompressionLevel(1)
    writer.SetChunkSize(_CHUNK)
    _write(path, writer, source)


class _Source(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """Source of VTK's writers, which request one piece after the other, or one time after the other.

    Parameters
    ----------
    cloud_of
        Returns the cloud of a time, by its index; without times, the next piece.
    times
        Times of the clouds, s.
    """

    def __init__(self, cloud_of: Callable[[int], PointCloud], times: Sequence[float] = ()) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self._cloud_of, self._times = cloud_of, np.array(times, dtype=np.float64)
        self._last = vtkPolyData()
        self.layout: tuple[PieceArray, ...] = ()
        self.error: Exception | None = None
        """First exception of ``cloud_of``, which VTK does not pass on."""

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:  # noqa: ARG002
        information, times = outputs.GetInformationObject(0), self._times.tolist()
        if times:
            information.Set(Pipeline.TIME_STEPS(), times, len(times))
            information.Set(Pipeline.TIME_RANGE(), [times[0], times[-1]], 2)
        else:
            information.Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:  # noqa: ARG002
        requested = outputs.GetInformationObject(0).Get(Pipeline.UPDATE_TIME_STEP())
        output, index = vtkPolyData.GetData(outputs), 0
        if requested is not None and len(self._times):
            index = int(np.argmin(abs(self._times - requested)))
        if self.error is None:
            try:
                snapshot = self._cloud_of(index)
                self.layout = self.layout or layout(snapshot)
                self._last = poly_data(snapshot)
            except Exception as error:
                self.error = error
        # Also after an error: a writer whose source fails after the first piece repeats its request for ever.
        output.ShallowCopy(self._last)
        if len(self._times):
            output.GetInformation().Set(output.DATA_TIME_STEP(), float(self._times[index]))
        return 1


class PieceArray(NamedTuple):
    """Declaration of an array in a ``.pvtp``: its name, VTK's name of its type, its number of components."""

    name: str
    type: str
    components: int


def layout(snapshot: PointCloud) -> tuple[PieceArray, ...]:
    """Return the declarations of the arrays of a cloud, the points first."""
    kinds = {"f": "Float", "i": "Int", "u": "UInt", "b": "Int"}
    arrays = {"Points": snapshot.points, **snapshot.arrays}
    return tuple(
        PieceArray(
            name,
            f"{kinds[array.dtype.kind]}{8 * array.dtype.itemsize}",
            1 if array.ndim == 1 else array.shape[1],
        )
        for name, array in arrays.items()
    )


def write_pieces(path: Path, arrays: Sequence[PieceArray], pieces: Sequence[Path]) -> None:
    """Write the file that makes several ``.vtp`` one cloud, in one step.

    Parameters
    ----------
    path
        The file, ``.pvtp``.
    arrays
        The :func:`layout` of each of the pieces.
    pieces
        Files of the pieces, in the folder of ``path`` or below.
    """
    points, *values = (
        f'<PDataArray type="{a.type}" Name={quoteattr(a.name)} NumberOfComponents="{a.components}"/>\n'
        for a in arrays
    )
    sources = (quoteattr(piece.relative_to(path.parent).as_posix()) for piece in pieces)
    write_text(
        path,
        '<?xml version="1.0"?>\n'
        '<VTKFile type="PPolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        '  <PPolyData GhostLevel="0">\n'
        f"    <PPointData>\n{''.join(f'      {value}' for value in values)}    </PPointData>\n"
        f"    <PPoints>\n      {points}    </PPoints>\n"
        f"{''.join(f'    <Piece Source={source}/>{chr(10)}' for source in sources)}"
        "  </PPolyData>\n</VTKFile>\n",
    )


def _write_xml(path: Path, writer: vtkXMLPolyDataWriter, source: _Source | None = None) -> None:
    """Write a compressed XML file in one step."""
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    # Mantissas of doubles hardly compress, so the slower zlib would gain little.
    writer.SetCompressorTypeToLZ4()
    writer.SetBlockSize(_BLOCK_BYTES)
    _write(path, writer, source, seal)


def _write(
    path: Path,
    writer: Any,
    source: _Source | None = None,
    finish: Callable[[Path], None] = lambda _: None,
) -> None:
    """Write a file in one step, and finish it; other threads run while VTK writes."""
    # VTK does not print errors that are observed; the error code gives their reason.
    sources = () if source is None else (source, source.GetExecutive())
    for part in (writer, writer.GetExecutive(), *sources):
        part.AddObserver("ErrorEvent", lambda *_: None)
    with atomic_write(path) as temporary:
        writer.SetFileName(str(temporary))
        written = writer.Write()
        if source is not None and source.error is not None:
            raise source.error
        if written != 1 or writer.GetErrorCode() or not temporary.stat().st_size:
            reason = vtkErrorCode.GetStringFromErrorCode(writer.GetErrorCode())
            raise OSError(f"{path}: VTK could not write this file ({reason}).")
        finish(temporary)


@dataclass(frozen=True)
class Tracks:
    """Paths of m particles, one after the other.

    Parameters
    ----------
    points
        Positions, shape (n, 3), m, path after path.
    start
        Index of the first point of each path, and n, shape (m + 1,).
    values
        Arrays by name, (n,) or (n, k), at the points.
    tracks
        Arrays by name, (m,), of the paths.
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
    """Write paths as VTK PolyData, in one step: a polyline per path, with point and cell arrays."""
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(tracks_data(tracks))
    _write_xml(path, writer)


def tracks_data(tracks: Tracks) -> vtkPolyData:
    """Return paths as the PolyData of :func:`write_tracks`."""
    data = _points(tracks.points, tracks.values)
    data.SetLines(_cells(tracks.start))
    for name, array in tracks.tracks.items():
        data.GetCellData().AddArray(_vtk_array(name, array))
    _add_texts(data, tracks.units, {name: meanings for name, meanings in tracks.names.items() if meanings})
    return data


def write_triangles(path: Path, corners: NDArray[np.float64]) -> None:
    """Write n triangles, (n, 3, 3), m, as VTK PolyData, in one step."""
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(triangles_data(corners.reshape(-1, 3), np.arange(3 * len(corners))))
    _write_xml(path, writer)


def triangles_data(points: NDArray[Any], triangles: NDArray[np.int64]) -> vtkPolyData:
    """Return triangles of points (n, 3) as PolyData; it shares the memory of the points."""
    data, count = _points(points, {}), triangles.size // 3
    offsets = _vtk_array("offsets", 3 * np.arange(count + 1, dtype=np.int64))
    cells = vtkCellArray()
    cells.SetData(offsets, _vtk_array("connectivity", triangles.ravel()))
    data.SetPolys(cells)
    return data


def poly_data(snapshot: PointCloud) -> vtkPolyData:
    """Return a cloud as the PolyData of :func:`write_snapshot`; it shares the memory of the arrays."""
    data = _points(snapshot.points, snapshot.arrays)
    data.SetVerts(_cells(np.arange(len(snapshot.points) + 1, dtype=np.int64)))
    data.GetFieldData().AddArray(_vtk_array("TimeValue", np.array([snapshot.time], dtype=np.float64)))
    _add_texts(data, snapshot.units, snapshot.names)
    return data


def _points(points: NDArray[Any], arrays: Mapping[str, NDArray[Any]]) -> vtkPolyData:
    """Return PolyData with points and point arrays, without cells."""
    data, positions = vtkPolyData(), vtkPoints()
    positions.SetData(_vtk_array("Points", points))
    data.SetPoints(positions)
    for name, array in arrays.items():
        data.GetPointData().AddArray(_vtk_array(name, array))
    return data


def _cells(offsets: NDArray[np.int64]) -> vtkCellArray:
    """Return cells of consecutive points, cell i of the points ``offsets[i]`` to ``offsets[i + 1] - 1``."""
    cells, points = vtkCellArray(), np.arange(offsets[-1], dtype=np.int64)
    cells.SetData(_vtk_array("offsets", offsets), _vtk_array("connectivity", points))
    return cells


def _add_texts(data: vtkPolyData, units: Mapping[str, str], names: Mapping[str, Sequence[str]]) -> None:
    """Add the units of the arrays and the meanings of codes as field data."""
    texts = {"units": [f"{name} {unit}" for name, unit in units.items()]} if units else {}
    for name, values in (
        texts | {f"{name}Names": list(meanings) for name, meanings in names.items()}
    ).items():
        array = vtkStringArray()
        array.SetName(name)
        for value in values:
            array.InsertNextValue(value)
        data.GetFieldData().AddArray(array)


def _vtk_array(name: str, array: NDArray[np.generic]) -> Any:
    plain = array.astype(np.int8) if array.dtype == np.bool_ else array
    result = numpy_to_vtk(np.ascontiguousarray(plain))
    result.SetName(name)
    return result
