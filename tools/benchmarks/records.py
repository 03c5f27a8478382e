"""Results of the benchmark's parts, clocks and processes."""

from __future__ import annotations

import csv
import gc
import importlib
import importlib.metadata
import json
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any, NamedTuple

TOOLS = Path(__file__).parents[1]
KILO, MEGA, GIGA = 1e3, 1e6, 1e9
PARTS = (
    "observed", "tracker", "whole", "tutorials", "memory", "run", "mesh", "start", "scaling",
)  # fmt: skip


class Row(NamedTuple):
    """One number of the raw results."""

    part: str
    quantity: str
    """What was measured; the number of something that it depends on is the ``size``."""
    subject: str
    """Of what: a program, an integrator, a stage."""
    size: float
    value: float
    unit: str


@dataclass(frozen=True)
class Options:
    """How much to measure."""

    quick: bool = False
    """Few steps and repeats: to see that all works."""
    large: bool = False
    """Also what needs 16 to 20 GB of memory."""
    bodies: int = 0
    """Of the runs of part ``observed``; 0: its own number."""


class Results:
    """Rows that can be asked for."""

    def __init__(self, rows: Iterable[Row]) -> None:
        self.rows = tuple(rows)

    def get(self, quantity: str, subject: str = "", size: float | None = None) -> float | None:
        """Return the value of the first matching row, or None."""
        for row in self.rows:
            if (
                row.quantity == quantity
                and (not subject or row.subject == subject)
                and (size is None or row.size == size)
            ):
                return row.value
        return None

    def part(self, name: str) -> list[Row]:
        """Return rows of one part."""
        return [row for row in self.rows if row.part == name]


def read_rows(path: Path) -> list[Row]:
    """Return the rows of a file of :func:`foamprb.results.tables.write_table`; [] if it is absent."""
    if not path.is_file():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return [
            Row(**{name: float(r[name]) if name in ("size", "value") else r[name] for name in Row._fields})
            for r in csv.DictReader(file)
        ]


def machine() -> str:
    """Return the processor, versions relevant for speed, and the date."""
    models = re.findall(r"model name\s*:\s*(.+)", _text("/proc/cpuinfo"))
    model = models[0] if models else platform.processor() or platform.machine()
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("numba", "numpy", "vtk"))
    processors = len(os.sched_getaffinity(0))
    return f"{model}, {processors} processors, Python {platform.python_version()}, {versions}, {date.today()}"


def load(seconds: float = 2.0) -> float:
    """Return the number of processors busy while this process sleeps: above 0.5, times are unreliable."""
    idle, total = _processor_time()
    time.sleep(seconds)
    idle_now, total_now = _processor_time()
    return (os.cpu_count() or 1) * (1.0 - (idle_now - idle) / (total_now - total))


def _processor_time() -> tuple[float, float]:
    """Return idle and total time of all processors, in the kernel's ticks."""
    ticks = [float(word) for word in _text("/proc/stat").split("\n", 1)[0].split()[1:9]]
    return ticks[3] + ticks[4], sum(ticks)


def available_memory() -> float:
    """Return the memory available to a new process, bytes."""
    return 1024.0 * float(re.findall(r"MemAvailable:\s*(\d+)", _text("/proc/meminfo"))[0])


def peak_memory() -> float:
    """Return the largest resident size of this process so far, bytes."""
    # ru_maxrss would count the parent's memory in.
    return 1024.0 * float(re.findall(r"VmHWM:\s*(\d+)", _text("/proc/self/status"))[0])


def resident_memory() -> float:
    """Return the resident size of this process, bytes."""
    gc.collect()
    return 1024.0 * float(re.findall(r"VmRSS:\s*(\d+)", _text("/proc/self/status"))[0])


def _text(path: str) -> str:
    try:
        return Path(path).read_text()
    except OSError:
        return ""


def cpu_of(work: Callable[[], Any]) -> float:
    """Return the CPU seconds of this process for a function."""
    start = time.process_time()
    work()
    return time.process_time() - start


def wall_of(work: Callable[[], Any]) -> float:
    """Return the wall seconds of a function."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def interleaved(contestants: Mapping[str, Callable[[], float]], repeats: int) -> dict[str, float]:
    """Return medians of each contestant's results, called in turn to share fluctuations of the machine."""
    results: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(repeats):
        for name, contestant in contestants.items():
            results[name].append(contestant())
    return {name: statistics.median(values) for name, values in results.items()}


class Child(NamedTuple):
    """What a process of its own found and used."""

    result: Any
    cpu: float
    """Seconds, of the process and its own children."""
    wall: float
    peak: float
    """Bytes."""


def isolated(
    function: Callable[..., Any], *arguments: Any, environment: Mapping[str, str] | None = None
) -> Child:
    """Call a function of one of these modules in a fresh process; arguments and result are as JSON has them.

    Raises
    ------
    RuntimeError
        If it failed, with what it said.
    """
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        call = json.dumps([function.__module__, function.__qualname__, arguments, str(answer)])
        paths = [str(TOOLS), str(TOOLS.parent), os.environ.get("PYTHONPATH", "")]
        variables = {**os.environ, **(environment or {}), "PYTHONPATH": os.pathsep.join(filter(None, paths))}
        done = subprocess.run(
            [sys.executable, "-m", "benchmarks.records", call], env=variables, capture_output=True, text=True
        )
        if done.returncode != 0 or not answer.exists():
            raise RuntimeError(f"{function.__qualname__}: {(done.stderr or done.stdout).strip()[-2000:]}")
        return Child(**json.loads(answer.read_text()))


def _serve(call: str) -> None:
    module, name, arguments, answer = json.loads(call)
    function = getattr(importlib.import_module(module), name)
    start = time.perf_counter()
    result = function(*arguments)
    usage = os.times()
    child = Child(result, sum(usage[:4]), time.perf_counter() - start, peak_memory())
    Path(answer).write_text(json.dumps(child._asdict()))


def rows(part: str, quantity: str, values: Mapping[str, float], unit: str, size: float = 0.0) -> list[Row]:
    """Return a row for each subject."""
    return [Row(part, quantity, subject, size, value, unit) for subject, value in values.items()]


if __name__ == "__main__":
    _serve(sys.argv[1])
