"""The table on the terminal, and the report as Markdown with its figures."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

from foamprb.errors import InputError, suggestion
from validation.case import Case, Curve, Figure, Outcome, Panel, Row

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLUMNS = (
    "quantity",
    "ours",
    "reference",
    "source of the reference",
    "difference",
    "allowed",
    "pass",
    "note",
)
_COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:red", "tab:purple", "tab:brown")
_DPI = 90


class Section(NamedTuple):
    """One case that has run."""

    name: str
    case: Case
    outcome: Outcome


def choose(cases: Mapping[str, Case], names: Sequence[str]) -> dict[str, Case]:
    """Return the cases of the given names in the order of the registry; all without names.

    Raises
    ------
    InputError
        If there is no such case.
    """
    for name in names:
        if name not in cases:
            raise InputError(f"unknown validation case '{name}'. {suggestion(name, cases)}")
    return {name: case for name, case in cases.items() if not names or name in names}


def pyplot() -> Any:
    """Return matplotlib's pyplot, drawing to files."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    return plt


def validate(cases: Mapping[str, Case], folder: Path, quick: bool) -> bool:
    """Run cases, print their rows, and write ``report.md`` and the figures.

    Parameters
    ----------
    cases
        By name.
    folder
        Of the report; it is made if need be.
    quick
        Run the quick form of each case.

    Returns
    -------
    Whether every row that has an allowed difference passed.
    """
    plt = pyplot()
    sections = []
    for name, case in cases.items():
        start = time.perf_counter()
        print(f"\n{name}: {case.title} ({case.section})\n", flush=True)
        outcome = case.run(quick)
        sections.append(Section(name, case, outcome))
        print(table(outcome.rows))
        print(f"\n{name} ran in {time.perf_counter() - start:.1f} s")
    write(sections, folder, quick, plt)
    failed = [f"{s.name}: {row.quantity}" for s in sections for row in s.outcome.rows if row.passed is False]
    print(f"\n{summary(sections)}")
    for line in failed:
        print(f"    failed: {line}")
    print(f"Report in {folder / 'report.md'}\n")
    return not failed


def cells(row: Row) -> tuple[str, ...]:
    """Return a row's entries in the order of :data:`COLUMNS`."""
    percent = row.relative
    return (
        row.quantity,
        _number(row.ours),
        _number(row.reference),
        row.source,
        _difference(row.difference, percent),
        _difference(row.allowed, percent),
        {True: "yes", False: "NO", None: "–"}[row.passed],
        row.note,
    )


def _number(value: float | None) -> str:
    return "–" if value is None else f"{value:.7g}"


def _difference(value: float | None, relative: bool) -> str:
    if value is None:
        return "–"
    if relative:
        return f"{100.0 * value:.2g} %"
    return f"{value:.2g}"


def table(rows: Sequence[Row]) -> str:
    """Return rows as aligned text under a heading."""
    lines = [COLUMNS, *(cells(row) for row in rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(COLUMNS))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


def summary(sections: Sequence[Section]) -> str:
    """Return the numbers of rows that pass, fail, and are for information only."""
    rows = [row for section in sections for row in section.outcome.rows]
    passed = sum(row.passed is True for row in rows)
    failed = sum(row.passed is False for row in rows)
    others = len(rows) - passed - failed
    return f"{passed} of {passed + failed} rows pass; {others} more are for information only."


def write(sections: Sequence[Section], folder: Path, quick: bool, plt: Any) -> None:
    """Write the report of cases that have run."""
    folder.mkdir(parents=True, exist_ok=True)
    for section in sections:
        for figure in section.outcome.figures:
            draw(figure, folder / f"{figure.name}.png", plt)
    (folder / "report.md").write_text(markdown(sections, quick), encoding="utf-8")


def _introduction(sections: Sequence[Section], quick: bool) -> list[str]:
    form = "the quick form of `tools/validate`" if quick else "`tools/validate`"
    return [
        f"Made by {form}, version {version('foamprb')}. {summary(sections)}",
        "Each reference is independent of the quantity checked. A difference in per cent is relative to "
        "the reference. Rows without an allowed difference are for information only.",
    ]


def markdown(sections: Sequence[Section], quick: bool) -> str:
    """Return the report as Markdown, its figures beside it."""
    parts = ["# Validation", *_introduction(sections, quick)]
    for name, case, outcome in sections:
        parts += [f"## {case.title}", f"`{name}`; {case.section}."]
        lines = [COLUMNS, tuple("---" for _ in COLUMNS), *(cells(row) for row in outcome.rows)]
        parts.append(
            "\n".join("| " + " | ".join(c.replace("|", "\\|") for c in line) + " |" for line in lines)
        )
        parts += outcome.remarks
        for figure in outcome.figures:
            parts.append(f"![{figure.caption.replace('[', '(').replace(']', ')')}]({figure.name}.png)")
            parts.append(figure.caption)
    return "\n\n".join(parts) + "\n"


def draw(figure: Figure, file: Path, plt: ModuleType | Any) -> None:
    """Draw a figure's panels, at most three side by side, into a PNG file."""
    n = len(figure.panels)
    picture, grid = plt.subplots(
        1, n, figsize=(4.4 * n if n > 1 else 6.5, 3.9), layout="constrained", squeeze=False
    )
    for axes, panel in zip(grid[0], figure.panels, strict=True):
        _draw_panel(axes, panel)
    picture.savefig(file, dpi=_DPI, metadata={"Software": None})
    plt.close(picture)


def _draw_panel(axes: Axes, panel: Panel) -> None:
    for curve in panel.curves:
        axes.plot(curve.x, curve.y, label=curve.label or "_", **_style(curve, panel))
    axes.set(xlabel=panel.xlabel, ylabel=panel.ylabel)
    if panel.scale == "log":
        axes.set(xscale="log", yscale="log")
    if panel.scale == "equal":
        axes.set_aspect("equal", adjustable="datalim")
    if any(curve.label for curve in panel.curves):
        axes.legend(frameon=False, fontsize="x-small")


def _style(curve: Curve, panel: Panel) -> dict[str, Any]:
    colour = _COLOURS[curve.colour % len(_COLOURS)]
    if curve.kind == "reference":
        marker = "osv^Dx"[curve.colour % 6]
        return {"ls": "", "marker": marker, "ms": 4.5, "mfc": "none", "color": colour}
    if curve.kind == "guide":
        return {"lw": 0.8, "ls": ("--", ":", "-.")[curve.colour % 3], "color": "0.4"}
    return {"lw": 1.5, "color": colour, "marker": "." if panel.scale == "log" else ""}
