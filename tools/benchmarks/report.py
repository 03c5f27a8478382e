"""Targets and tables: from the raw results to ``performance.md``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from string import Template
from typing import NamedTuple

from benchmarks import mesh, observed, pipe, scaling
from benchmarks.records import Results

TEMPLATE = Path(__file__).with_name("performance.md.in")
_BUSY = 0.5
WORST_DEFAULT = "worst default run over OpenFOAM's"
WORST_TUTORIAL = "worst default run in a tutorial's flow over OpenFOAM's"
INFO = "info, 1M cells"


class Target(NamedTuple):
    """What is wanted of a number that the results hold; the limit is a largest value unless ``least``."""

    text: str
    value: Callable[[Results], float | None]
    limit: float
    least: bool = False

    def met(self, value: float) -> bool:
        """Return whether the value meets the target."""
        return value >= self.limit if self.least else value <= self.limit


def _quotient(over: float | None, under: float | None) -> float | None:
    return None if over is None or under is None else over / under


def _got(quantity: str, subject: str = "", size: float | None = None) -> Callable[[Results], float | None]:
    return lambda results: results.get(quantity, subject, size)


def _ready(results: Results) -> float | None:
    cells = pipe.GRIDS["1M"].cells
    ours, vtk = (
        results.get("time to ready", "foamprb", cells),
        results.get("time to ready", "VTK reads", cells),
    )
    return None if vtk is None else _quotient(ours, 3.0 * vtk + 10.0)


def _compiled(results: Results) -> float | None:
    first, second = results.get("start", "first run"), results.get("start", "second run")
    return None if first is None or second is None else first - second


def _further(results: Results) -> float | None:
    return _quotient(*(results.get(mesh.FURTHER, name) for name in ("foamprb, 1000 bodies", "reading U")))


_KEPT = _got("memory kept per cell, kB", "", pipe.GRIDS["1M"].cells)
_PEAK = _got("peak memory, GB", "foamprb", pipe.GRIDS["8M"].cells)

TARGETS = (
    Target(
        "`paper`: CPU per particle-step over OpenFOAM's", _got("cost over OpenFOAM's", "foamprb paper"), 0.2
    ),
    Target(
        "a run with default settings, air and water, Ca 0.01 to 2: CPU over OpenFOAM's",
        _got(WORST_DEFAULT),
        0.25,
    ),
    Target(
        "the same in the flows of two of OpenFOAM's tutorials, on tetrahedra and in a snappy mesh",
        _got(WORST_TUTORIAL),
        0.25,
    ),
    Target("speed-up by two threads", _got(scaling.SPEED_UP, "threads", 2), 1.85, least=True),
    Target(
        "memory per particle of a run with output, kB", _got("memory per particle", "run with output", 1e6), 1
    ),
    Target(
        "CPU per particle-step, 1e6 particles over 1e5", _got("cost of many over few", "1e6 over 1e5"), 1.3
    ),
    Target("1e7 particles: peak memory, GB", _got("peak memory of 1e7 particles"), 16),
    Target("1e6 cells: time to ready over (3 × VTK's reading + 10 s)", _ready, 1),
    Target("1e6 cells: memory kept per cell, kB", _KEPT, 0.8),
    Target("1e6 cells, 1000 bodies: a further time of a transient flow over reading U", _further, 3),
    Target("8e6 cells: peak memory, GB", _PEAK, 20),
    Target(
        "default integrator: CPU per particle-step, 1e6 cells over 5e3",
        _got("cost of fine over coarse", "1M over 5k"),
        2,
    ),
    Target(
        "1e5 particles, 1000 steps: run with ten snapshots over computing alone",
        _got("run over computing alone"),
        1.15,
    ),
    Target("`foamprb -help`, s", _got("start", "help"), 0.4),
    Target("`foamprb info` of 1e6 cells, s", _got("start", INFO), 2),
    Target("compilation in the first run, s on the wall: it less a later one", _compiled, 10),
    Target("first run says that it compiles", _got("first run says so"), 1, least=True),
)


def table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """Return a table in Markdown with aligned columns."""
    widths = [max(len(line[k]) for line in (head, *lines)) for k in range(len(head))]
    rule = ["-" * width for width in widths]
    return "\n".join(
        "| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) + " |"
        for line in (head, rule, *lines)
    )


def number(value: float) -> str:
    """Return three significant digits."""
    return f"{value:.3g}" if abs(value) < 1e4 else f"{value:.2e}"


def written_table(results: Results) -> str:
    """Return every target with its measured value."""
    lines = []
    for target in TARGETS:
        value = target.value(results)
        bound = f"{'≥' if target.least else '≤'} {target.limit:g}"
        if value is None:
            lines.append((target.text, "not measured", bound, ""))
            continue
        limit_ratio = target.limit / value if target.least and value else value / target.limit
        verdict = "met" if target.met(value) else "**not met**"
        lines.append((target.text, number(value), bound, f"{verdict} ({limit_ratio:.2f} of the limit)"))
    return table(("target", "measured", "limit", "outcome"), lines)


def _machines(results: Results) -> str:
    lines = []
    for row in results.rows:
        if row.quantity == "machine":
            busy = (
                f"; **busy** ({row.value:.1f} processors, before it began): times are in doubt"
                if row.value > _BUSY
                else ""
            )
            lines.append(f"* {row.part}: {row.subject}{busy}")
    return "\n".join(lines)


def costs_table(results: Results) -> str:
    """Return the cost of each run of part ``observed``, over the bare run and beside OpenFOAM's function."""
    lines = []
    theirs = results.get(observed.COST, observed.openfoam(observed.BARE))
    for name in (observed.BARE, *observed.ROWS, observed.CALL, observed.SNAPSHOT):
        cost, ratio = results.get(observed.COST, name), results.get(observed.RATIO, name)
        limit, other = observed.LIMITS.get(name), results.get(observed.COST, observed.openfoam(name))
        missed = ratio is not None and limit is not None and ratio > limit
        over = _quotient(other, theirs)
        lines.append((
            name,
            "" if cost is None else number(cost),
            "" if ratio is None else f"**{number(ratio)}**" if missed else number(ratio),
            "" if limit is None else f"{limit:g}",
            "" if other is None else number(other),
            "" if over is None else number(over),
        ))  # fmt: skip
    tracer = results.get(observed.COST, observed.VTK)
    lines.append((observed.VTK, "" if tracer is None else number(tracer), "", "", "", ""))
    head = "a run with", "cost, µs", "over the run without", "at most", "OpenFOAM, µs", "over its run without"
    return table(head, lines)


SHOWN = {
    "whole": {"default run over OpenFOAM's": "over OpenFOAM's"},
    "tutorials": {
        "default run in a tutorial's flow over OpenFOAM's": "over OpenFOAM's",
        "error of the place after 20 Δt over the way": "error of the place",
        "the same at equal error of the place": "over OpenFOAM's, equal error",
    },
    "mesh": {
        "time to ready": "ready, s CPU",
        "memory kept per cell, kB": "kept per cell, kB",
        "peak memory, GB": "peak, GB",
    },
    "scaling": {
        scaling.SPEED_UP: "speed-up",
        scaling.MEMORY: "memory of the largest process, MB",
        scaling.PARTICLE: "memory per particle, kB",
    },
}
"""Quantities on the page and their columns, by part; ``performance.csv`` has all."""


def _part_table(results: Results, part: str) -> str:
    columns = SHOWN[part]
    values = {(r.subject, r.size, r.quantity): r.value for r in results.part(part) if r.quantity in columns}
    lines = [
        (of, f"{size:g}" if size else "", *(
            number(values[of, size, quantity]) if (of, size, quantity) in values else ""
            for quantity in columns
        ))
        for of, size in dict.fromkeys(key[:2] for key in values)
    ]  # fmt: skip
    return table(("of", "size", *columns.values()), lines) if lines else "Not measured."


def write_report(results: Results, folder: Path) -> None:
    """Write ``performance.md``."""
    text = Template(TEMPLATE.read_text(encoding="utf-8")).substitute(
        {part: _part_table(results, part) for part in SHOWN},
        costs=costs_table(results),
        targets=written_table(results),
        machines=_machines(results),
    )
    (folder / "performance.md").write_text(text, encoding="utf-8")
