"""Targets, tables and plots: from the raw results to ``performance.md``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from string import Template
from typing import NamedTuple

from benchmarks import pipe
from benchmarks.records import PARTS, Results

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


def _written(results: Results) -> float | None:
    """Return bytes per second of a snapshot of a million particles, over the rate of disk or compressor."""
    alone = [results.get("throughput", name, 1e6) for name in ("disk, with fsync", "zlib alone, level 1")]
    rates = [rate for rate in alone if rate is not None]
    return _quotient(results.get("throughput", "snapshot to file", 1e6), min(rates)) if rates else None


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
    Target("the same in the flows of three of OpenFOAM's tutorials", _got(WORST_TUTORIAL), 0.25),
    Target("speed-up by two threads", _got("speed-up", "foamprb paper", 2), 1.85, least=True),
    Target(
        "memory per particle of a run with output, kB", _got("memory per particle", "run with output", 1e6), 1
    ),
    Target(
        "CPU per particle-step, 1e6 particles over 1e5", _got("cost of many over few", "1e6 over 1e5"), 1.3
    ),
    Target("1e7 particles: peak memory, GB", _got("peak memory of 1e7 particles"), 16),
    Target("1e6 cells: time to ready over (3 × VTK's reading + 10 s)", _ready, 1),
    Target("1e6 cells: memory kept per cell, kB", _KEPT, 1.5),
    Target("8e6 cells: peak memory, GB", _PEAK, 20),
    Target("CPU per particle-step, 1e6 cells over 5e3", _got("cost of fine over coarse", "1M over 5k"), 2),
    Target("writing 1e6 particles: rate over the disk's or zlib's own", _written, 0.5, least=True),
    Target(
        "1e6 particles, 1000 steps: default run over computing alone",
        _got("run over computing alone", "default"),
        1.1,
    ),
    Target("the same by `paper`", _got("run over computing alone", "paper"), 1.1),
    Target(
        "share of a default run's time in which it waits for output",
        _got("share of the run that waits for output", "default"),
        0.1,
    ),
    Target("`foamprb -help`, s", _got("start", "help"), 0.4),
    Target("`foamprb info` of 1e6 cells, s", _got("start", INFO), 2),
    Target("compilation in the first run, s on the wall: it less a later one", _compiled, 10),
    Target("first run says that it compiles", _got("first run says so"), 1, least=True),
    Target(
        "water: CPU of `paper` over `stokes` at equal error",
        _got("cost of paper over stokes", "error of F 1e-3"),
        20,
        least=True,
    ),
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


def _rows_table(results: Results, part: str) -> str:
    rows = [r for r in results.part(part) if r.quantity != "machine"]
    if not rows:
        return "Not measured."
    lines = [(r.quantity, r.subject, f"{r.size:g}" if r.size else "", number(r.value), r.unit) for r in rows]
    return table(("quantity", "of", "size", "value", "unit"), lines)


def write_report(results: Results, folder: Path) -> None:
    """Write ``performance.md`` and its plots."""
    text = Template(TEMPLATE.read_text(encoding="utf-8")).substitute(
        {part: _rows_table(results, part) for part in PARTS},
        targets=written_table(results),
        machines=_machines(results),
    )
    (folder / "performance.md").write_text(text, encoding="utf-8")
    _plot(results, folder / "performance.png")


def _plot(results: Results, file: Path) -> None:
    """Time per particle-step against particles, cells and threads."""
    try:
        import matplotlib as mpl
    except ImportError:
        print("Without matplotlib there are no plots.")
        return
    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, panels = plt.subplots(1, 3, figsize=(11, 3.6), sharey=True, layout="constrained")
    for panel, thing in zip(panels, ("particles", "cells", "threads"), strict=True):
        quantity = f"{'wall time' if thing == 'threads' else 'cost'} by {thing}"
        for subject in results.subjects(quantity):
            curve = results.curve(quantity, subject)
            panel.plot(*zip(*curve, strict=True), "o-", ms=4, label=subject)
            if thing == "threads" and curve[0][0] == 1:
                ideal = [(n, curve[0][1] / n) for n, _ in curve]
                panel.plot(*zip(*ideal, strict=True), ":", color="0.5", label="ideal")
        openfoam = results.get("cost", "OpenFOAM")
        if openfoam is not None and thing != "threads":
            panel.axhline(openfoam, color="0.4", lw=0.8, label="OpenFOAM, rigid point spheres")
        panel.set(xlabel=f"number of {thing}", ylim=(0, None))
        if thing == "threads":
            panel.xaxis.get_major_locator().set_params(integer=True)
        else:
            panel.set_xscale("log")
        panel.grid(alpha=0.3)
        if panel.get_legend_handles_labels()[0]:
            panel.legend(frameon=False, fontsize=8)
    panels[0].set_ylabel("µs per particle-step")
    figure.savefig(file, dpi=130)
    plt.close(figure)
