"""Targets, tables and plots: from the raw results to ``performance.md``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from string import Template
from typing import NamedTuple

from benchmarks import pipe
from benchmarks.records import KILO, Results
from benchmarks.scaling import MEMORY, PARTICLE, SPEED_UP, WALL

TEMPLATE = Path(__file__).with_name("performance.md.in")
_BUSY = 0.5
TABLES = (
    "tracker", "whole", "tutorials", "threads", "memory", "run", "mesh", "start", "output", "integrators",
    "surroundings", "peers", "roofline",
)  # fmt: skip
OVER_OPENFOAM = "cost over OpenFOAM's"
WORST_DEFAULT = "worst default run over OpenFOAM's"
WORST_TUTORIAL = "worst default run in a tutorial's flow over OpenFOAM's"
INFO = "info, 1M cells"
USEFUL = "share of lane-steps of use in a default run"
GAP = "cost of the gap to the wall"
SAME = "same to the last bit"
OVER_COMPUTING = "run over computing alone"
WAITING = "share of the run that waits for output"
EQUAL_ERROR = "cost of paper over stokes"


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
    known = [rate for rate in alone if rate is not None]
    return _quotient(results.get("throughput", "snapshot to file", 1e6), min(known)) if known else None


def _useful(results: Results) -> float | None:
    shares = [row.value for row in results.rows if row.quantity == USEFUL]
    return min(shares) if shares else None


_KEPT = _got("memory kept per cell, kB", "", pipe.GRIDS["1M"].cells)
_PEAK = _got("peak memory, GB", "foamprb", pipe.GRIDS["8M"].cells)

TARGETS = (
    Target("`paper`: CPU per particle-step over OpenFOAM's", _got(OVER_OPENFOAM, "foamprb paper"), 0.2),
    Target(
        "a run with default settings, air and water, Ca 0.01 to 2: CPU over OpenFOAM's",
        _got(WORST_DEFAULT),
        0.25,
    ),
    Target("the same in the flows of three of OpenFOAM's tutorials", _got(WORST_TUTORIAL), 0.25),
    Target(
        "a run with default settings: least share of the lanes' steps that is of use",
        _useful,
        0.85,
        least=True,
    ),
    Target("speed-up by two threads", _got("speed-up", "foamprb paper", 2), 1.85, least=True),
    Target("`paper`: same bits, any threads, any order", _got(SAME, "foamprb paper"), 1, least=True),
    Target("`stokes`: same bits, any threads, any order", _got(SAME, "foamprb stokes"), 1, least=True),
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
        "1e6 particles, 1000 steps: default run over computing alone", _got(OVER_COMPUTING, "default"), 1.1
    ),
    Target("the same by `paper`", _got(OVER_COMPUTING, "paper"), 1.1),
    Target("share of a default run's time in which it waits for output", _got(WAITING, "default"), 0.1),
    Target("`foamprb -help`, s", _got("start", "help"), 0.4),
    Target("`foamprb info` of 1e6 cells, s", _got("start", INFO), 2),
    Target("compilation in the first run, s on the wall: it less a later one", _compiled, 10),
    Target("first run says that it compiles", _got("first run says so"), 1, least=True),
    Target(
        "water: CPU of `paper` over `stokes` at equal error",
        _got(EQUAL_ERROR, "error of F 1e-3"),
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


def _rows_table(results: Results, part: str, without: Sequence[str] = ()) -> str:
    rows = [r for r in results.part(part) if r.quantity not in ("machine", *without)]
    if not rows:
        return "Not measured."
    lines = [(r.quantity, r.subject, f"{r.size:g}" if r.size else "", number(r.value), r.unit) for r in rows]
    return table(("quantity", "of", "size", "value", "unit"), lines)


def _profile(results: Results) -> str:
    """Return the stages of each integrator with their share of the whole."""
    texts = []
    for integrator in ("paper", "stokes", "rosenbrock"):
        whole = results.get("cost", f"foamprb {integrator}, whole loop")
        stages = [r for r in results.part("profile") if r.quantity == f"stage of {integrator}"]
        quantity = f"operations of {integrator}"
        counted = {r.subject: r.value for r in results.part("roofline") if r.quantity == quantity}
        if whole is None or not stages:
            continue
        lines = []
        for r in stages:
            share = f"{100 * r.value / whole:.0f} %"
            if r.subject in counted:
                operations = counted[r.subject]
                rate = (number(operations), f"{operations / r.value / KILO:.2f}")
            else:
                rate = ("", "")
            lines.append((r.subject, number(1e3 * r.value), share, *rate))
        rest = whole - sum(r.value for r in stages)
        lines.append(("all else", number(1e3 * rest), f"{100 * rest / whole:.0f} %", "", ""))
        lines.append(("whole loop", number(1e3 * whole), "", "", ""))
        head = ("stage", "ns per particle-step", "share", "operations", "GFLOP/s")
        texts.append(f"`{integrator}`:\n\n{table(head, lines)}")
    shares = [r for r in results.part("profile") if r.quantity == USEFUL]
    if shares:
        lines = [(r.subject, f"{100 * r.value:.0f} %") for r in shares]
        texts.append(table(("a default run", "lane-steps of use, at least"), lines))
    gaps = [r for r in results.part("profile") if r.quantity == GAP]
    if gaps:
        lines = [(r.subject, number(KILO * r.value)) for r in gaps]
        texts.append(table(("the gap to the wall, at the wall", "ns"), lines))
    return "\n\n".join(texts) or "Not measured."


def _processes(results: Results) -> str:
    """Return a line for each program and number of processes."""
    quantities = ("memory, largest process", "memory, all processes", "user CPU per particle-step")
    lines = []
    for program in results.subjects(quantities[0]):
        for ranks, _ in results.curve(quantities[0], program):
            values = [results.get(quantity, program, ranks) for quantity in quantities]
            lines.append((program, f"{ranks:g}", *("" if v is None else number(v) for v in values)))
    head = ("program", "processes", "largest, MB", "all, MB", "µs per particle-step")
    return table(head, lines) if lines else "Not measured."


def _scaling(results: Results) -> str:
    """Return a line for each number of cores."""
    ways = results.subjects(WALL)
    lines = []
    for cores in sorted({row.size for row in results.part("scaling") if row.quantity == WALL}):
        values = [results.get(quantity, way, cores) for way in ways for quantity in (WALL, SPEED_UP, MEMORY)]
        lines.append((f"{cores:g}", *("" if v is None else number(v) for v in values)))
    if not lines:
        return "Not measured."
    head = ("cores", *(text for way in ways for text in (f"{way}, ns", "speed-up", "MB")))
    each = [
        (f"{way}, {cores:g} core{'s'[: cores > 1]}", number(value))
        for way in ways
        for cores, value in results.curve(PARTICLE, way)
    ]
    return f"{table(head, lines)}\n\n{table(('way', 'kB of memory a particle'), each)}"


def _by_processor(results: Results) -> str:
    """Return the cost of a step over OpenFOAM's, on every processor measured."""
    ratios = ("cost over OpenFOAM's", "default run over OpenFOAM's")
    chosen = [row for row in results.rows if row.quantity in ratios]
    columns = list(dict.fromkeys((row.quantity, row.subject) for row in chosen))
    lines = []
    for processor in dict.fromkeys(row.processor for row in chosen):
        here = results.on(processor)
        openfoam = here.get("cost", "OpenFOAM") or here.get("cost of a default run", "OpenFOAM")
        values = [openfoam, *(here.get(*column) for column in columns)]
        lines.append((processor, *("" if v is None else number(v) for v in values)))
    head = (
        "processor",
        "OpenFOAM, us",
        *(f"{subject}, {quantity.split()[0]}" for quantity, subject in columns),
    )
    return table(head, lines) if lines else "Not measured."


def write_report(results: Results, folder: Path) -> None:
    """Write ``performance.md`` and its plots, of each part what was measured last."""
    processors = _by_processor(results)
    results = results.newest()
    parts = {part: _rows_table(results, part) for part in TABLES}
    text = Template(TEMPLATE.read_text(encoding="utf-8")).substitute(
        targets=written_table(results),
        machines=_machines(results),
        profile=_profile(results),
        processors=processors,
        processes=_processes(results),
        scaling=_scaling(results),
        **parts,
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
