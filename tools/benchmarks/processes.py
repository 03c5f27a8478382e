"""Memory and CPU of MPI processes: foamprb, OpenFOAM's cloud and Parcels, by their number.

``$FOAMPRB_BENCHMARK_PARCELS`` names a Python that has Parcels 3 with mpi4py; without it Parcels is left out.
"""

from __future__ import annotations

import os
import re
import resource
import shutil
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from functools import partial
from math import prod
from pathlib import Path
from statistics import median
from typing import NamedTuple

from benchmarks import pipe
from benchmarks.records import MEGA, TOOLS, Options, Row
from benchmarks.tracker import OPENFOAM_STEP, SOLVER, openfoam_environment
from foamprb.parallel.shared_memory import NODE_RANKS

PARCELS = "FOAMPRB_BENCHMARK_PARCELS"
LARGEST, ALL = "memory, largest process", "memory, all processes"
COST = "user CPU per particle-step"
_BETWEEN = 0.1
"""Time between two looks at the processes, s."""
_SHORT = 5
"""Steps of the runs whose memory is measured, and that are subtracted for the cost of a step."""
_REACH = 2.7
"""Particles are spread over so many thirds of the pipe; none leaves it."""


_YIELD = ("--bind-to", "none", "--mca", "mpi_yield_when_idle", "1")


class Use(NamedTuple):
    """What a program used, all processes together unless stated otherwise."""

    largest: float
    """Peak of the resident size of the process with the highest one, shared memory included, bytes."""
    memory: float
    """Peak of the sum over all processes, with shared memory and libraries once, bytes."""
    cpu: float
    """User CPU, s."""


def measured(words: Sequence[str], folder: Path, environment: dict[str, str]) -> Use:
    """Run a program, and look at its processes meanwhile.

    Raises
    ------
    RuntimeError
        It failed.
    """
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with (folder / "log").open("w+") as log:
        program = subprocess.Popen(words, cwd=folder, env=environment, stdout=log, stderr=log)
        done, peaks = threading.Event(), {"one": 0.0, "all": 0.0}

        def watch() -> None:
            while not done.wait(_BETWEEN):
                sizes = [size for pid in _descendants(program.pid) if (size := _sizes(pid))]
                if not sizes:
                    continue
                together = sum(size.own for size in sizes) + max(size.files for size in sizes)
                peaks["one"] = max(peaks["one"], *(size.peak for size in sizes))
                peaks["all"] = max(peaks["all"], peaks["one"], together)

        watcher = threading.Thread(target=watch)
        watcher.start()
        program.wait()
        done.set()
        watcher.join()
        log.seek(0)
        if program.returncode:
            raise RuntimeError(f"{' '.join(words)}: {log.read()[-2000:]}")
    return Use(peaks["one"], peaks["all"], resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)


def _descendants(first: int) -> list[int]:
    """Return a process and all that it started, directly or not, except ``mpirun``."""
    children: dict[int, list[int]] = {}
    launchers = set()
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = path.read_text().partition("(")[2].rpartition(")")
        except OSError:
            continue
        children.setdefault(int(rest.split()[1]), []).append(int(path.parent.name))
        if name in ("mpirun", "orted"):
            launchers.add(int(path.parent.name))
    found = [first]
    for process in found:
        found += children.get(process, [])
    return [process for process in found if process not in launchers]


class _Sizes(NamedTuple):
    """Sizes of a process, bytes."""

    peak: float
    """Largest resident size so far."""
    own: float
    """Its own memory, and its share of the memory shared with other processes."""
    files: float
    """Libraries and other files."""


def _sizes(process: int) -> _Sizes | None:
    """Return the sizes of a process; None if it has ended."""
    folder, found = Path("/proc") / str(process), {}
    try:
        for name in ("status", "smaps_rollup"):
            for key, size in re.findall(r"^(\w+):\s+(\d+) kB", (folder / name).read_text(), re.MULTILINE):
                found[key] = 1024.0 * float(size)
        return _Sizes(found["VmHWM"], found["Pss_Anon"] + found["Pss_Shmem"], found["RssFile"])
    except (OSError, KeyError):
        return None


def decomposed_folder(case: Path, cuts: tuple[int, int, int]) -> Path:
    """Return the folder of :func:`decomposed`."""
    return case.with_name(f"{case.name}_{'x'.join(map(str, cuts))}")


def decomposed(case: Path, cuts: tuple[int, int, int]) -> Path:
    """Return the case in processor folders alone, so many along each axis; the case itself for one."""
    parts = prod(cuts)
    if parts == 1:
        return case
    folder = decomposed_folder(case, cuts)
    if (folder / f"processor{parts - 1}").is_dir():
        # Particles may have come since.
        for path in (case / "constant").iterdir():
            link = folder / "constant" / path.name
            if path.name != "polyMesh" and not link.is_symlink():
                link.symlink_to(path)
        return folder
    shutil.copytree(case / "system", folder / "system")
    (folder / "constant").mkdir()
    (folder / "system" / "decomposeParDict").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
        f"numberOfSubdomains {parts}; method hierarchical; "
        f"hierarchicalCoeffs {{ n ({' '.join(map(str, cuts))}); delta 0.001; order xyz; }}\n"
    )
    for path in (*(case / "constant").iterdir(), case / "0"):
        (folder / path.relative_to(case)).symlink_to(path)
    subprocess.run(
        ["decomposePar"], cwd=folder, env=openfoam_environment(), check=True, stdout=subprocess.DEVNULL
    )
    for link in (folder / "constant" / "polyMesh", folder / "0"):
        link.unlink()
    return folder


def together(ranks: int) -> list[str]:
    """Return the words before a program that start so many processes of it."""
    # Waiting processes yield: their user CPU is that of the work.
    return [] if ranks == 1 else ["mpirun", "-np", str(ranks), "--oversubscribe", *_YIELD]


def ours(case: Path, ranks: int, steps: int, nodes: bool) -> Use:
    """Measure foamprb's default run; ``nodes`` takes each process for a computer of its own."""
    folder = decomposed(case, (ranks, 1, 1))
    # A file of the case itself, to which the folder has a link.
    file = pipe.write_default_cloud(case, "softCloud", 0.5, OPENFOAM_STEP, steps)
    words = [sys.executable, "-m", "foamprb", "run", "-threads", "1", "-overwrite", "-dict", str(file)]
    environment = openfoam_environment() | ({NODE_RANKS: "1"} if nodes else {})
    return measured([*together(ranks), *words, *(["-parallel"] if ranks > 1 else [])], folder, environment)


def openfoam(case: Path, ranks: int, steps: int) -> Use:
    """Measure OpenFOAM's solver, which writes its parcels at the end."""
    folder = decomposed(case, (ranks, 1, 1))
    pipe.write_control(folder, OPENFOAM_STEP, steps * OPENFOAM_STEP, steps)
    words = [*together(ranks), SOLVER, *(["-parallel"] if ranks > 1 else [])]
    return measured(words, folder, openfoam_environment())


def parcels(case: Path, n: int, cells: int, ranks: int, steps: int) -> Use:
    """Measure Parcels."""
    program = str(TOOLS / "benchmarks" / "parcels_run.py")
    words = [*together(ranks), os.environ[PARCELS], program, str(cells), str(n), str(steps)]
    return measured(words, case, {k: v for k, v in os.environ.items() if k != "PYTHONPATH"})


def contestants(grid: str, n: int) -> dict[tuple[str, int], Callable[[int], Use]]:
    """Return runs of n particles, functions of the number of steps, by program and processes."""
    case = pipe.case(grid)
    x = pipe.positions(n)
    x[:, 0] *= _REACH
    for name in ("softCloudPositions", "kinematicCloudPositions"):
        pipe.write_positions(case / "constant" / name, x)
    pipe.write_parcels(case, x)
    found: dict[tuple[str, int], Callable[[int], Use]] = {}
    for ranks in (1, 2, 4):
        found["foamprb", ranks] = partial(ours, case, ranks, nodes=False)
        if ranks > 1:
            found["foamprb, a node each", ranks] = partial(ours, case, ranks, nodes=True)
        found["OpenFOAM", ranks] = partial(openfoam, case, ranks)
        if os.environ.get(PARCELS):
            found["Parcels", ranks] = partial(parcels, case, n, pipe.GRIDS[grid].cells, ranks)
    return found


def measure(options: Options) -> list[Row]:
    """Measure memory in a large case, and user CPU of pairs of runs of different lengths in a small one."""
    if not (shutil.which("mpirun") and shutil.which("decomposePar")):
        return []
    grid, many = ("40k", 20_000) if options.quick else ("300k", 200_000)
    n, steps, repeats = (20_000, 20, 1) if options.quick else (100_000, 50, 2)
    found = []
    for (name, ranks), run in contestants(grid, many).items():
        use = run(steps=_SHORT)
        for quantity, size in ((LARGEST, use.largest), (ALL, use.memory)):
            found.append(Row("processes", quantity, name, ranks, size / MEGA, "MB"))
    costs: dict[tuple[str, int], list[float]] = {}
    for _ in range(repeats):
        for key, run in contestants("40k", n).items():
            short, long = run(steps=_SHORT), run(steps=_SHORT + steps)
            costs.setdefault(key, []).append(1e6 * (long.cpu - short.cpu) / (n * steps))
    return found + [Row("processes", COST, *key, median(values), "us") for key, values in costs.items()]
