"""The particle loop on one core against OpenFOAM's rigid point spheres, on the same mesh."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
from pathlib import Path
from typing import Any

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, rows

SOLVER = "icoUncoupledKinematicParcelFoam"
STEP = {"paper": 2e-5, "rosenbrock": 1e-4, "stokes": 1e-4}
"""Δt, s: the paper's scheme is stable below 9e-5; the others take OpenFOAM's step."""
OPENFOAM_STEP = 1e-4
ENOUGH = 30
"""Steps of OpenFOAM's that are measured beside runs of ours, which are many times shorter."""


class Tracker:
    """Whole loop of an integrator: sampling, walking, shape, barycentre and wall test."""

    def __init__(self, flow, n: int, integrator: str, steps: int, warm_up: int = 10) -> None:
        self.cloud = pipe.soft_cloud(flow, n, STEP[integrator], integrator)
        self.steps = steps
        self.cloud.advance(warm_up)

    def cost(self) -> float:
        """Measure CPU µs per particle-step."""
        return pipe.cost(self.cloud, self.steps)


def pairs(case: str, runs: list[list[str]], repeats: int, kept: bool = True) -> list[float]:
    """Return CPU µs per body and Δt of runs on one thread: of the difference of two, each the least of some.

    Start, injection, the transient from rest and the last writing are in both, and fall away. What else runs
    on a machine only adds to a time.

    Parameters
    ----------
    runs
        The settings of a short and a long run of each.
    repeats
        How often each is run, in turn.
    kept
        Whether all read the flow once, and not each anew.
    """
    from foamprb import execute, prepare
    from foamprb.run.compilation import compile_run

    flows: dict[Any, Any] = {}

    def clock(file: str) -> tuple[float, float]:
        job = prepare(case, dictionary=Path(file), threads=1, flows=flows if kept else {})
        compile_run(job.cloud, job.compilation)
        start = time.process_time()
        execute(job, "startTime")
        spent = time.process_time() - start
        shutil.rmtree(job.folder.path)
        return spent, pipe.particle_steps(job.cloud)

    # What is compiled, or linked, is not measured: it would make a short run dearer, and so the cost less.
    for short, _ in runs:
        clock(short)
    clocks = [[[clock(file) for file in ends] for ends in runs] for _ in range(repeats)]
    least = [[min(repeat[k][end] for repeat in clocks) for end in (0, 1)] for k in range(len(runs))]
    return [1e6 * (long[0] - short[0]) / (long[1] - short[1]) for short, long in least]


def openfoam_environment() -> dict[str, str]:
    """Return the environment for OpenFOAM's programs, including Debian's missing variable."""
    debian = Path("/usr/share/openfoam")
    return ({"WM_PROJECT_DIR": str(debian)} if debian.is_dir() else {}) | os.environ


def openfoam_cost(
    case: Path,
    n: int,
    steps: int,
    dt: float = OPENFOAM_STEP,
    left: float = 0.99,
    interval: int = 1_000_000,
) -> float:
    """Measure CPU µs per parcel-step of OpenFOAM's solver, without start and injection.

    Parameters
    ----------
    case
        With parcels that are there from the start.
    n, steps
        Number of parcels, and of steps.
    dt
        Δt, s.
    left
        So large a share of the parcels must be there at the end.
    interval
        Steps between two writings.

    Raises
    ------
    RuntimeError
        If the solver failed or lost parcels.
    """
    pipe.write_control(case, dt, (steps + 5) * dt, interval)
    done = subprocess.run([SOLVER], cwd=case, env=openfoam_environment(), capture_output=True, text=True)
    times = [float(t) for t in re.findall(r"ExecutionTime = (\S+) s", done.stdout)]
    parcels = [int(m) for m in re.findall(r"Current number of parcels\s*= (\d+)", done.stdout)]
    if done.returncode or len(times) < steps + 5:
        raise RuntimeError(f"{SOLVER}: {(done.stderr or done.stdout)[-1000:]}")
    if parcels[-1] < left * n:
        raise RuntimeError(f"{SOLVER}: {parcels[-1]} of {n} parcels are left")
    # The first steps inject, and bring the parcels from rest to the flow's velocity.
    return 1e6 * (times[steps + 4] - times[4]) / sum(parcels[5 : steps + 5])


def measure(options: Options) -> list[Row]:
    """Measure cost per particle-step of all integrators and of OpenFOAM, and by number of particles."""
    n, steps, repeats = (10_000, 10, 2) if options.quick else (50_000, ENOUGH, 3)
    case = pipe.case("40k")
    flow = foamprb.read_case(case)
    contestants = {f"foamprb {name}": Tracker(flow, n, name, steps).cost for name in STEP}
    if shutil.which(SOLVER):
        pipe.write_parcels(case, pipe.positions(n))
        contestants["OpenFOAM"] = lambda: openfoam_cost(case, n, steps)
    costs = interleaved(contestants, repeats)
    table = rows("tracker", "cost", costs, "us/particle-step", n)
    if "OpenFOAM" in costs:
        ratios = {name: value / costs["OpenFOAM"] for name, value in costs.items() if name != "OpenFOAM"}
        table += rows("tracker", "cost over OpenFOAM's", ratios, "")
    for size in (100, 1000, 10_000):
        tracker = Tracker(flow, size, "paper", steps)
        cost = interleaved({"foamprb paper": tracker.cost}, 3 * repeats)
        table += rows("tracker", "cost by particles", cost, "us/particle-step", size)
    table += rows(
        "tracker", "cost by particles", {"foamprb paper": costs["foamprb paper"]}, "us/particle-step", n
    )
    return table
