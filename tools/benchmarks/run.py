"""A whole run, 1000 steps of a million particles with ten snapshots, against its computation alone."""

from __future__ import annotations

import shutil
import statistics
import time
from pathlib import Path

from benchmarks import pipe
from benchmarks.records import Options, Row, isolated, rows
from benchmarks.tracker import OPENFOAM_STEP

WRITES = 10


def with_output(case: str) -> float:
    """Return the wall seconds of the program."""
    from foamprb import execute, prepare

    job = prepare(case)
    start = time.perf_counter()
    execute(job, "startTime")
    return time.perf_counter() - start


def alone(case: str, steps: int) -> float:
    """Return the wall seconds of the same steps in one call, without output."""
    from foamprb import prepare

    cloud = prepare(case).cloud
    start = time.perf_counter()
    cloud.advance(steps)
    return time.perf_counter() - start


def measure(options: Options) -> list[Row]:
    """Measure wall seconds with all threads."""
    n, steps, repeats = (20_000, 100, 1) if options.quick else (100_000, 1000, 2)
    case = Path(pipe.case("40k"))
    results = case / "postProcessing" / "softCloud"
    pipe.write_soft_cloud(case, n, OPENFOAM_STEP, steps, WRITES, "auto")
    computed, runs = [], []
    for _ in range(repeats):
        computed.append(isolated(alone, str(case), steps).result)
        # A run would begin by removing what the last one, or one that was stopped, has left.
        shutil.rmtree(results, ignore_errors=True)
        runs.append(isolated(with_output, str(case)).result)
    wall, compute = statistics.median(runs), statistics.median(computed)
    written = sum(file.stat().st_size for file in results.glob("*.vtp"))
    shutil.rmtree(results)
    times = {"computing alone": compute, "with output": wall}
    table = rows("run", "wall time of a run", times, "s", n)
    table += rows("run", "run over computing alone", {"": wall / compute}, "", n)
    return table + rows("run", f"written in {WRITES} snapshots", {"": written / n}, "bytes/particle", n)
