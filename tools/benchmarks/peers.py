"""VTK's particle tracer, ParaView's filter, on the mesh of the other programs."""

from __future__ import annotations

from typing import Any

import pyvista
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersFlowPaths import vtkParticleTracer

from benchmarks import pipe
from benchmarks.records import cpu_of
from benchmarks.tracker import OPENFOAM_STEP


class _Steady(VTKPythonAlgorithmBase):
    """A grid that is the same at many times."""

    def __init__(self, grid: pyvista.UnstructuredGrid, times: list[float]) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")
        self.grid, self.times = grid, times

    def RequestInformation(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        information, times = outputs.GetInformationObject(0), self.times
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), times, len(times))
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [times[0], times[-1]], 2)
        return 1

    def RequestData(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        time = outputs.GetInformationObject(0).Get(key)
        out = vtkUnstructuredGrid.GetData(outputs)
        out.ShallowCopy(self.grid)
        out.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)
        return 1


def particle_tracer(case: str, n: int, steps: int) -> float:
    """Measure CPU µs per massless point and Δt, from the second time of the flow on.

    Mesh and seeds are declared constant. The filter takes one step or more between two times of the flow.
    """
    reader = pyvista.POpenFOAMReader(f"{case}/system/controlDict")
    reader.cell_to_point_creation = True
    reader.skip_zero_time = False
    reader.set_active_time_value(0.0)
    grid = reader.read()["internalMesh"]
    grid.clear_cell_data()
    grid.point_data["U"] = grid.point_data["U"].astype(float)
    times = [OPENFOAM_STEP * k for k in range(steps + 2)]
    source, tracer = _Steady(grid, times), vtkParticleTracer()
    tracer.SetInputConnection(0, source.GetOutputPort())
    tracer.SetInputDataObject(1, pyvista.PolyData(pipe.positions(n)))
    tracer.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "U")
    tracer.SetComputeVorticity(False)
    tracer.SetMeshOverTimeToStatic()
    tracer.SetStaticSeeds(True)
    tracer.UpdateTimeStep(times[1])
    spent = cpu_of(lambda: tracer.UpdateTimeStep(times[-1]))
    return 1e6 * spent / (steps * tracer.GetOutput().GetNumberOfPoints())
