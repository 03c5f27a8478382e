"""A whole run, 1000 steps of a million particles with output, against its computation alone."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

from benchmarks import pipe
from benchmarks.records import Options, Row, isolated, rows

STEP = 2e-5
WRITES = 10


def with_output(case: str) -> dict[str, float]:
    """What ``foamprb run`` does: its seconds on the wall, and those in which it waited for output."""
    import foamprb
    from foamprb.cloud.cloud import Cloud
    from foamprb.output.background import Writer

    job = foamprb.prepare(case)
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
    # Whatever a measurement that was stopped has left there.
    foamprb.execute(job, "startTime")
    return {
        "wall": time.perf_counter() - start,
        "waited": waited,
        "particle-steps": pipe.particle_steps(job.cloud),
    }


def alone(case: str, steps: int) -> dict[str, float]:
    """The same steps in one call, without output."""
    import foamprb

    cloud = foamprb.prepare(case).cloud
    start = time.perf_counter()
    cloud.advance(steps)
    return {"wall": time.perf_counter() - start, "particle-steps": pipe.particle_steps(cloud)}


def measure(options: Options) -> list[Row]:
    """Seconds on the wall with all threads."""
    n, steps = (20_000, 100) if options.quick else (1_000_000, 1000)
    case = Path(pipe.case("40k"))
    pipe.write_soft_cloud(case, n, STEP, steps, WRITES)
    computed = isolated(alone, str(case), steps).result
    whole = isolated(with_output, str(case)).result
    results = case / "postProcessing" / "softCloud"
    written = sum(file.stat().st_size for file in results.glob("*.vtp"))
    shutil.rmtree(results)
    found = rows("run", "wall time", {"compute alone": computed["wall"], "run": whole["wall"]}, "s", n)
    found += rows("run", "wall time over compute alone", {"run": whole["wall"] / computed["wall"]}, "", n)
    found += rows("run", "share of the wall time", {"output": whole["waited"] / whole["wall"]}, "", n)
    found += rows("run", "particle-steps", {"run": whole["particle-steps"]}, "", n)
    found += rows("run", "written", {f"{WRITES} snapshots": written / 1e6}, "MB", n)
    return found
