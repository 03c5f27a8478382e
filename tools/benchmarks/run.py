"""A whole run, 1000 steps of a million particles with output, against its computation alone.

By the integrator ``paper``, and by the one that is chosen by default: at OpenFOAM's Δt, and at the shorter
one of ``paper``, several of which then go into a step.
"""

from __future__ import annotations

import shutil
import statistics
import time
from pathlib import Path
from typing import NamedTuple

from benchmarks import pipe
from benchmarks.records import Options, Row, isolated, rows
from benchmarks.tracker import OPENFOAM_STEP, STEP

WRITES = 10


class Scheme(NamedTuple):
    """An integrator and its Δt, s."""

    integrator: str
    dt: float


SCHEMES = {
    "paper": Scheme("paper", STEP["paper"]),
    "default": Scheme("auto", OPENFOAM_STEP),
    f"default, Δt {STEP['paper']:g} s": Scheme("auto", STEP["paper"]),
}
"""By what the rows call them."""


def with_output(case: str) -> dict[str, float]:
    """Run the program; return wall seconds, and seconds of waiting for output."""
    from foamprb import execute, prepare
    from foamprb.cloud.cloud import Cloud
    from foamprb.results.background import Writer

    job = prepare(case)
    waited = 0.0

    def timed(function):
        def call(*arguments):
            nonlocal waited
            start = time.perf_counter()
            result = function(*arguments)
            waited += time.perf_counter() - start
            return result

        return call

    Writer.finish, Cloud.snapshot = timed(Writer.finish), timed(Cloud.snapshot)
    start = time.perf_counter()
    execute(job, "startTime")
    return {
        "wall": time.perf_counter() - start,
        "waited": waited,
        "particle-steps": pipe.particle_steps(job.cloud),
    }


def alone(case: str, steps: int) -> dict[str, float]:
    """Run the same steps in one call, without output."""
    from foamprb import prepare

    cloud = prepare(case).cloud
    start = time.perf_counter()
    cloud.advance(steps)
    return {"wall": time.perf_counter() - start, "particle-steps": pipe.particle_steps(cloud)}


def measure(options: Options) -> list[Row]:
    """Measure wall seconds with all threads."""
    n, steps, repeats = (20_000, 100, 1) if options.quick else (1_000_000, 1000, 3)
    case = Path(pipe.case("40k"))
    results = case / "postProcessing" / "softCloud"
    table = []
    for subject, scheme in SCHEMES.items():
        pipe.write_soft_cloud(case, n, scheme.dt, steps, WRITES, scheme.integrator)
        computed, runs = [], []
        for _ in range(repeats):
            computed.append(isolated(alone, str(case), steps).result["wall"])
            # A run would begin by removing what the last one, or one that was stopped, has left.
            shutil.rmtree(results, ignore_errors=True)
            runs.append(isolated(with_output, str(case)).result)
        wall = statistics.median(run["wall"] for run in runs)
        waited = statistics.median(run["waited"] for run in runs)
        compute = statistics.median(computed)
        written = sum(file.stat().st_size for file in results.glob("*.vtp"))
        shutil.rmtree(results)
        table += rows("run", "wall time of computing alone", {subject: compute}, "s", n)
        table += rows("run", "wall time of the run", {subject: wall}, "s", n)
        table += rows("run", "run over computing alone", {subject: wall / compute}, "", n)
        table += rows("run", "share of the run that waits for output", {subject: waited / wall}, "", n)
        table += rows("run", "particle-steps", {subject: runs[0]["particle-steps"]}, "", n)
        table += rows("run", f"written in {WRITES} snapshots", {subject: written / 1e6}, "MB", n)
    return table
