"""Large meshes: time until the first step against VTK's reading alone, memory, and cost of a step."""

from __future__ import annotations

import os
import time
from pathlib import Path

from benchmarks import pipe
from benchmarks.records import (
    GIGA,
    KILO,
    Options,
    Row,
    available_memory,
    interleaved,
    isolated,
    peak_memory,
    resident_memory,
    rows,
)
from benchmarks.tracker import OPENFOAM_STEP

DEFAULT = "rosenbrock"
"""Integrator that a run in air chooses."""
FURTHER = "a further time of a transient flow"
NEEDED = 21e9
"""Free memory, bytes, without which 8e6 cells are not tried."""


def vtk_reads(grid: str) -> float:
    """Return the CPU seconds of VTK's reader for mesh and U."""
    import vtkmodules.util.numpy_support
    from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

    assert vtkmodules.util.numpy_support
    start = time.process_time()
    reader = vtkOpenFOAMReader()
    reader.SetFileName(str(pipe.case(grid) / "case.foam"))
    reader.SetCreateCellToPoint(False)
    reader.SetSkipZeroTime(False)
    reader.UpdateInformation()
    reader.DisableAllCellArrays()
    reader.SetCellArrayStatus("U", 1)
    for index in range(reader.GetNumberOfPatchArrays()):
        reader.SetPatchArrayStatus(reader.GetPatchArrayName(index), 1)
    reader.UpdateTimeStep(0.0)
    return time.process_time() - start


def ready(grid: str) -> dict[str, float]:
    """Return the CPU seconds until the first step of a particle, and the memory kept for it."""
    import foamprb

    small = foamprb.read_case(pipe.case("5k"))
    pipe.soft_cloud(small, 64, 2e-5).advance(1)
    del small
    before, start = resident_memory(), time.process_time()
    flow = foamprb.read_case(pipe.case(grid))
    cloud = pipe.soft_cloud(flow, 64, 2e-5)
    cloud.advance(1)
    spent = time.process_time() - start
    return {"spent": spent, "kept": resident_memory() - before, "peak": peak_memory()}


def write_times(grid: str, count: int, n: int) -> str:
    """Write the case with so many times of the same U, a tenth of a cell apart, and n bodies; return it."""
    folder = pipe.transient_case(grid, OPENFOAM_STEP, count)
    pipe.write_positions(folder / "constant" / "softCloudPositions", pipe.positions(n))
    more = "transient true;"
    pipe.write_default_cloud(folder, "softCloud", 0.5, OPENFOAM_STEP / 2, 2 * (count - 1), more=more)
    return str(folder)


def run(case: str) -> None:
    """Run a case on one thread."""
    from foamprb import execute, prepare

    execute(prepare(case, threads=1), "startTime")


def read_velocity(case: str, count: int) -> float:
    """Return the CPU seconds of reading U."""
    from foamprb.flow.read.field import VELOCITY_FIELD, read_field

    folder = Path(case)
    start = time.process_time()
    for _ in range(count):
        read_field(folder / "0" / "U", VELOCITY_FIELD, folder)
    return (time.process_time() - start) / count


def further_time(grid: str, count: int, n: int) -> dict[str, float]:
    """Return the CPU seconds that a further time of a transient flow takes, and those of reading U."""
    short, long = (isolated(run, write_times(grid, k, n)).cpu for k in (2, 2 + count))
    reading = isolated(read_velocity, str(pipe.case(grid)), count).result
    return {"foamprb, 1000 bodies": (long - short) / count, "reading U": reading}


def costs(grids: list[str], n: int, steps: int, repeats: int) -> dict[str, float]:
    """Return CPU per particle-step on each mesh, μs."""
    import foamprb
    from benchmarks.tracker import Tracker

    trackers = {grid: Tracker(foamprb.read_case(pipe.case(grid)), n, DEFAULT, steps) for grid in grids}
    return interleaved({grid: tracker.cost for grid, tracker in trackers.items()}, repeats)


def measure(options: Options) -> list[Row]:
    """Time, memory and cost by the number of cells."""
    grids = ["5k", "40k", "300k", "1M"]
    n, steps, repeats = (5000, 5, 1) if options.quick else (50_000, 20, 2)
    if options.quick:
        grids = grids[:2]
    tried = list(grids)
    if options.large and available_memory() > NEEDED:
        tried.append("8M")
    table = []
    for grid in tried:
        # Written in a process of its own, and the files are in the system's cache for both readers.
        isolated(write, grid)
        reading = sorted(isolated(vtk_reads, grid).result for _ in range(1 if grid == "8M" else repeats))
        results = [isolated(ready, grid).result for _ in range(1 if grid == "8M" else min(repeats, 2))]
        cells = pipe.GRIDS[grid].cells
        spent = sorted(result["spent"] for result in results)[len(results) // 2]
        used, peak = results[0]["kept"], results[0]["peak"]
        times = {"foamprb": spent, "VTK reads": reading[len(reading) // 2]}
        table += rows("mesh", "time to ready", times, "s CPU", cells)
        table += rows("mesh", "memory kept per cell, kB", {"foamprb": used / cells / KILO}, "kB", cells)
        table += rows("mesh", "peak memory, GB", {"foamprb": peak / GIGA}, "GB", cells)
    spent = further_time(finest := grids[-1], 2 if options.quick else 4, 1000)
    table += rows("mesh", FURTHER, spent, "s CPU", pipe.GRIDS[finest].cells)
    by_cells = isolated(costs, grids, n, steps, repeats).result
    for grid, cost in by_cells.items():
        size = pipe.GRIDS[grid].cells
        table += rows("mesh", "cost by cells", {f"foamprb {DEFAULT}": cost}, "us/particle-step", size)
    table += rows(
        "mesh", "cost of fine over coarse", {f"{finest} over 5k": by_cells[finest] / by_cells["5k"]}, ""
    )
    return table


def write(grid: str) -> None:
    """Write the case of a grid."""
    os.sync()
    pipe.case(grid)
