"""Other point trackers on the same mesh, alternating with foamprb."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from typing import Any

import numpy as np
import pyvista
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkCellLocator, vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkCommonMath import vtkRungeKutta2
from vtkmodules.vtkFiltersFlowPaths import (
    vtkLagrangianMatidaIntegrationModel,
    vtkLagrangianParticleTracker,
    vtkParticleTracer,
)

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, cpu_of, interleaved, rows
from benchmarks.tracker import OPENFOAM_STEP, SOLVER, Tracker, openfoam_cost

_CELL_LENGTHS = 0.1


def grid_of(case: Any) -> pyvista.UnstructuredGrid:
    """Return mesh and U at the points by VTK's reader, with the fluid properties of Matida's model."""
    reader = pyvista.POpenFOAMReader(str(case / "system" / "controlDict"))
    reader.cell_to_point_creation = True
    reader.skip_zero_time = False
    reader.set_active_time_value(0.0)
    grid = reader.read()["internalMesh"]
    grid.clear_cell_data()
    grid.point_data["U"] = grid.point_data["U"].astype(float)
    grid.point_data["density"] = np.full(grid.n_points, pipe.RHO)
    grid.point_data["viscosity"] = np.full(grid.n_points, pipe.RHO * pipe.NU)
    return grid


def seeds(n: int) -> pyvista.PolyData:
    """Return the places of foamprb's particles."""
    x = pipe.positions(n)
    points = pyvista.PolyData(x)
    points.point_data["velocity"] = pipe.poiseuille(x)
    points.point_data["d"] = np.full(n, pipe.D)
    points.point_data["rho"] = np.full(n, pipe.RHO_S)
    return points


def streamlines(grid: pyvista.UnstructuredGrid, start: pyvista.PolyData, order: int, steps: int) -> float:
    """Measure CPU µs per step of pyvista's streamlines: massless points."""
    lines = []

    def work() -> None:
        lines.append(
            grid.streamlines_from_source(
                start,
                vectors="U",
                integrator_type=order,
                integration_direction="forward",
                initial_step_length=_CELL_LENGTHS,
                step_unit="cl",
                max_steps=steps,
                max_length=1e3,
                compute_vorticity=False,
            )
        )

    spent = cpu_of(work)
    return 1e6 * spent / (lines[0].n_points - lines[0].n_cells)


def matida(grid: pyvista.UnstructuredGrid, start: pyvista.PolyData, steps: int) -> float:
    """Measure CPU µs per step of VTK's Lagrangian tracker: rigid spheres with drag and gravity."""
    model = vtkLagrangianMatidaIntegrationModel()
    model.SetLocator(vtkCellLocator())
    points = vtkDataObject.FIELD_ASSOCIATION_POINTS
    for index, port, name in (
        (0, 1, "velocity"), (3, 0, "U"), (4, 0, "density"), (5, 0, "viscosity"), (6, 1, "d"), (7, 1, "rho"),
    ):  # fmt: skip
        model.SetInputArrayToProcess(index, port, 0, points, name)
    model.SetNumberOfTrackedUserData(13)
    tracker = vtkLagrangianParticleTracker()
    tracker.SetIntegrator(vtkRungeKutta2())
    tracker.SetIntegrationModel(model)
    tracker.SetInputDataObject(0, grid)
    tracker.SetInputDataObject(1, start)
    tracker.SetStepFactor(_CELL_LENGTHS)
    tracker.SetMaximumNumberOfSteps(steps)
    spent = cpu_of(tracker.Update)
    paths = pyvista.wrap(tracker.GetOutput())
    return 1e6 * spent / (paths.n_points - paths.n_cells)


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


def particle_tracer(grid: pyvista.UnstructuredGrid, start: pyvista.PolyData, steps: int) -> float:
    """Measure CPU µs per point and Δt of VTK's filter Particle Tracer: massless points.

    It is told that mesh and seeds do not change, and takes one step or more between two times of the flow.
    """
    times = [OPENFOAM_STEP * k for k in range(steps + 2)]
    source, tracer = _Steady(grid, times), vtkParticleTracer()
    tracer.SetInputConnection(0, source.GetOutputPort())
    tracer.SetInputDataObject(1, start)
    tracer.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "U")
    tracer.SetComputeVorticity(False)
    tracer.SetMeshOverTimeToStatic()
    tracer.SetStaticSeeds(True)
    tracer.UpdateTimeStep(times[1])
    spent = cpu_of(lambda: tracer.UpdateTimeStep(times[-1]))
    return 1e6 * spent / (steps * tracer.GetOutput().GetNumberOfPoints())


def measure(options: Options) -> list[Row]:
    """Measure CPU µs per particle-step, and the ratio to foamprb's."""
    n, steps, repeats = (500, 20, 1) if options.quick else (10_000, 50, 5)
    case = pipe.case("40k")
    grid, start = grid_of(case), seeds(n)
    flow = foamprb.read_case(case)
    contestants: dict[str, Callable[[], float]] = {
        f"foamprb {name}": Tracker(flow, 10 * n, name, steps).cost for name in ("paper", "stokes")
    }
    for order, name in ((2, "RK2"), (4, "RK4"), (45, "RK45")):
        contestants[f"pyvista streamlines {name}"] = lambda order=order: streamlines(
            grid, start, order, steps
        )
    contestants["vtkLagrangianParticleTracker"] = lambda: matida(grid, start, steps)
    contestants["vtkParticleTracer, ParaView's"] = lambda: particle_tracer(grid, start, steps)
    if shutil.which(SOLVER):
        pipe.write_parcels(case, pipe.positions(10 * n))
        contestants["OpenFOAM"] = lambda: openfoam_cost(case, 10 * n, steps)
    costs = interleaved(contestants, repeats)
    ratios = {name: cost / costs["foamprb paper"] for name, cost in costs.items()}
    table = rows("peers", "cost of a peer", costs, "us/particle-step")
    return table + rows("peers", "cost over foamprb paper's", ratios, "")
