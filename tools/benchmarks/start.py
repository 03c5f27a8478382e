"""Start-up time of the program: help, the first run with compilation, a later one, ``info`` of a mesh.

The run has the settings that a user has by default, with the integrator that takes most to compile.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from benchmarks import pipe
from benchmarks.records import TOOLS, Options, Row, rows
from benchmarks.report import INFO
from benchmarks.tracker import OPENFOAM_STEP

FIRST_RUNS = 1


class Start(NamedTuple):
    """Seconds on the wall and of CPU, and what was said."""

    wall: float
    cpu: float
    said: str


def _foamprb(cache: str, *arguments: str) -> Start:
    path = os.pathsep.join(filter(None, (str(TOOLS.parent), os.environ.get("PYTHONPATH", ""))))
    environment = {**os.environ, "FOAMPRB_CACHE_DIR": cache, "PYTHONPATH": path}
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "foamprb", *arguments], env=environment, capture_output=True, text=True
    )
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise RuntimeError(f"foamprb {' '.join(arguments)}: {done.stderr[-1000:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Start(wall, cpu, done.stdout + done.stderr)


def measure(options: Options) -> list[Row]:
    """Measure medians of wall and CPU seconds; 1 if the first runs report compilation."""
    repeats = 3
    case = Path(pipe.case("5k"))
    pipe.write_positions(case / "constant" / "softCloudPositions", pipe.positions(100))
    pipe.write_default_cloud(case, "softCloud", 0.5, OPENFOAM_STEP, 1)
    run = ("run", "-case", str(case), "-threads", "1")
    large = pipe.case("40k" if options.quick else "1M")
    starts: dict[str, list[Start]] = {"help": [], "first run": [], "second run": [], INFO: []}
    for _ in range(1 if options.quick else FIRST_RUNS):
        with tempfile.TemporaryDirectory() as cache:
            starts["first run"].append(_foamprb(cache, *run))
            starts["second run"] += [_foamprb(cache, *run) for _ in range(repeats)]
            starts["help"] += [_foamprb(cache, "-help") for _ in range(repeats)]
            starts[INFO].append(_foamprb(cache, "info", "-case", str(large)))
    walls = {name: statistics.median(start.wall for start in those) for name, those in starts.items()}
    cpu = {name: statistics.median(start.cpu for start in those) for name, those in starts.items()}
    table = rows("start", "start", walls, "s") + rows("start", "CPU of the start", cpu, "s")
    said = all("ompil" in start.said for start in starts["first run"])
    table += rows("start", "first run says so", {"first run": float(said)}, "")
    return table
