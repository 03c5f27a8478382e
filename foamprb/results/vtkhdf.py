"""VTKHDF file of a cloud over time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from foamprb.errors import InputError
from foamprb.results.atomic import atomic_write
from foamprb.results.vtk import PointCloud, poly_data

__all__ = ["write_vtkhdf"]


def write_vtkhdf(path: Path, times: Sequence[float], cloud_of: Callable[[int], PointCloud]) -> None:
    """Write the clouds of all times into one file, atomically, with one cloud in memory at a time.

    Parameters
    ----------
    path
        The file, ``.vtkhdf``.
    times
        Times in order, s; in single precision in the file.
    cloud_of
        Function that returns the cloud of a time by its index; all have the same arrays.

    Raises
    ------
    InputError
        If VTK was built without this writer.
    OSError
        If the file cannot be written.
    Exception
        Any exception of ``cloud_of``; ``path`` is then unchanged.
    """
    try:
        from vtkmodules.vtkIOHDF import vtkHDFWriter
    except ImportError as error:
        raise InputError("a VTKHDF file needs a VTK with the module IOHDF, as pip installs it.") from error
    source, writer = _Times(times, cloud_of), vtkHDFWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetWriteAllTimeSteps(True)
    writer.SetCompressionLevel(1)
    writer.SetChunkSize(_CHUNK)
    for part in (writer, writer.GetExecutive(), source, source.GetExecutive()):
        part.AddObserver("ErrorEvent", lambda *_: None)
    with atomic_write(path) as temporary:
        # VTK selects the format by the suffix.
        part = temporary.with_name(f"{temporary.name}.vtkhdf")
        try:
            writer.SetFileName(str(part))
            written = writer.Write()
            if source.error is not None:
                raise source.error
            if written != 1 or not part.exists():
                raise OSError(f"{path}: VTK cannot write it.")
            part.replace(temporary)
        finally:
            part.unlink(missing_ok=True)


_CHUNK = 4096
"""Chunk size in values, the least size of an array."""


class _Times(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """VTK source that passes the clouds of all times to the writer."""

    def __init__(self, times: Sequence[float], cloud_of: Callable[[int], PointCloud]) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self._times, self._cloud_of = np.array(times, dtype=np.float64), cloud_of
        self._before = vtkPolyData()
        self.error: Exception | None = None
        """What went wrong: no exception comes back from VTK."""

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:  # noqa: ARG002
        information, times = outputs.GetInformationObject(0), self._times.tolist()
        information.Set(Pipeline.TIME_STEPS(), times, len(times))
        information.Set(Pipeline.TIME_RANGE(), [times[0], times[-1]], 2)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:  # noqa: ARG002
        information, output = outputs.GetInformationObject(0), vtkPolyData.GetData(outputs)
        wanted = information.Get(Pipeline.UPDATE_TIME_STEP())
        index = int(np.argmin(abs(self._times - (self._times[0] if wanted is None else wanted))))
        if self.error is None:
            try:
                self._before = poly_data(self._cloud_of(index))
            except Exception as error:
                self.error = error
        output.ShallowCopy(self._before)
        output.GetInformation().Set(output.DATA_TIME_STEP(), float(self._times[index]))
        return 1
