"""Wall time and memory of a default run by cores: as threads, and as processes that share a flow."""

from __future__ import annotations

import os
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from benchmarks import pipe
from benchmarks.records import KILO, MEGA, Options, Row
from benchmarks.tracker import OPENFOAM_STEP, openfoam_environment

WALL, SPEED_UP, MEMORY = "wall time by cores", "speed-up by cores", "memory of the largest process by cores"
PARTICLE = "memory per particle by cores"
_REACH = 2.0
"""Particles are spread over so many thirds of the pipe; none leaves it."""
_SHORTER = 5
"""Runs with twice the particles, which give the memory of one, have so many times fewer steps."""


class Use(NamedTuple):
    """What a run used."""

    wall: float
    """Time from its first write time to the second, s."""
    memory: float
    """Peak of the resident size of the process with the highest one, shared memory included, bytes."""


def _run(case: Path, settings: Path, cores: int, way: str) -> Use:
    """Run foamprb.

    Raises
    ------
    RuntimeError
        It failed.
    """
    words = [sys.executable, "-m", "foamprb", "run", "-overwrite", "-dict", str(settings), "-threads"]
    if way == "threads":
        words += [str(cores)]
    else:
        # Waiting processes yield: their user CPU is that of the work.
        mpirun = ["mpirun", "-np", str(cores), "--oversubscribe", "--bind-to", "none"]
        words = [*mpirun, "--mca", "mpi_yield_when_idle", "1", *words, "1", "-parallel"]
    log = case / "log"
    with log.open("w") as file:
        program = subprocess.Popen(words, cwd=case, env=openfoam_environment(), stdout=file, stderr=file)
        _, status, used = os.wait4(program.pid, 0)
        program.returncode = os.waitstatus_to_exitcode(status)
    text = log.read_text()
    clocks = [float(t) for t in re.findall(r"ClockTime = (\S+) s", text)]
    if program.returncode or len(clocks) < 2:
        raise RuntimeError(f"{' '.join(words)}: {text[-2000:]}")
    return Use(clocks[1] - clocks[0], 1024.0 * used.ru_maxrss)


def _write_cloud(case: Path, n: int, steps: int) -> Path:
    """Write n particles, and settings with two write times so many steps apart."""
    x = pipe.positions(n)
    x[:, 0] *= _REACH
    pipe.write_positions(case / "constant" / "softCloudPositions", x)
    interval = f"writeInterval {steps * OPENFOAM_STEP:.9g};"
    return pipe.write_default_cloud(case, "softCloud", 0.5, OPENFOAM_STEP, 2 * steps, more=interval)


def measure(options: Options) -> list[Row]:
    """Measure with 1, 2, 4, … cores: medians of alternate runs, the largest memory, that of a particle."""
    grid, n, steps, repeats = ("40k", 20_000, 10, 1) if options.quick else ("300k", 200_000, 50, 2)
    case = pipe.case(grid)
    settings = _write_cloud(case, n, steps)
    ways = ["threads"]
    if shutil.which("mpirun"):
        ways += ["processes"]
    runs: dict[tuple[str, int], list[Use]] = {("threads", 1): []}
    ends = {("threads", 1), *((way, 2) for way in ways)}
    cores = 2
    while cores <= len(os.sched_getaffinity(0)):
        runs |= {(way, cores): [] for way in ways}
        cores *= 2
    for _ in range(repeats):
        for (way, cores), uses in runs.items():
            uses.append(_run(case, settings, cores, way))
    settings = _write_cloud(case, 2 * n, steps // _SHORTER)
    twice = {run: _run(case, settings, run[1], run[0]).memory for run in ends if run in runs}
    table, one = [], statistics.median(use.wall for use in runs["threads", 1])
    for (way, cores), uses in runs.items():
        wall = statistics.median(use.wall for use in uses)
        memory = max(use.memory for use in uses)
        table.append(Row("scaling", WALL, way, cores, KILO * MEGA * wall / (n * steps), "ns/particle-step"))
        table.append(Row("scaling", SPEED_UP, way, cores, one / wall, ""))
        table.append(Row("scaling", MEMORY, way, cores, memory / MEGA, "MB"))
        if (way, cores) in twice:
            processes = 1 if way == "threads" else cores
            each = processes * (twice[way, cores] - memory) / n
            table.append(Row("scaling", PARTICLE, way, cores, each / KILO, "kB"))
    return table
