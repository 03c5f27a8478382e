"""The table on the terminal, and the report as Markdown with its figures."""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
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
    "kind",
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


def validate(cases: Mapping[str, Case], folder: Path, quick: bool, order: Sequence[str]) -> bool:
    """Run cases, print their rows, and write the report, its page of others' numbers, and the figures.

    Parameters
    ----------
    cases
        By name.
    folder
        Of the report; it is made if need be.
    quick
        Run the quick form of each case.
    order
        Of all cases; sections of cases that do not run remain in the report.

    Returns
    -------
    Whether every row passed that has an allowed difference, and a reference that the code must meet.
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
    write(sections, folder, quick, plt, order)
    rows = [(section.name, row) for section in sections for row in section.outcome.rows]
    failed = [f"{name}: {row.quantity}" for name, row in rows if row.verifies and row.passed is False]
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
        _number(row.ours, row.our_error),
        _number(row.reference, row.reference_error) + _spread(row.quartiles),
        row.source,
        row.kind,
        _difference(row.difference, percent),
        _difference(row.allowed, percent),
        {True: "yes", False: "no", None: "–"}[row.passed],
        row.note,
    )


def _number(value: float | None, error: float | None) -> str:
    bar = "" if error is None else f" ± {error:.2g}"
    return "–" if value is None else f"{value:.7g}{bar}"


def _spread(quartiles: tuple[float, float] | None) -> str:
    return "" if quartiles is None else " [{:.3g}, {:.3g}]".format(*quartiles)


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


def write(sections: Sequence[Section], folder: Path, quick: bool, plt: Any, order: Sequence[str]) -> None:
    """Write the report of cases that have run; other sections of a report in the folder remain."""
    folder.mkdir(parents=True, exist_ok=True)
    for section in sections:
        for figure in section.outcome.figures:
            draw(figure, folder / f"{figure.name}.png", plt)
    file = folder / "report.md"
    texts = _sections_of(file.read_text(encoding="utf-8")) if file.is_file() else {}
    texts |= {section.name: markdown(section) for section in sections}
    texts = {name: texts[name] for name in order if name in texts}
    file.write_text(
        _joined("Validation report", _introduction(texts.values(), quick), texts), encoding="utf-8"
    )
    others = {name: part for name, text in texts.items() if (part := _rows_of_others(text))}
    page = _joined("Numbers of others", _introduction_of_others(others.values()), others)
    (folder / "others.md").write_text(page, encoding="utf-8")


def _sections_of(text: str) -> dict[str, str]:
    """Return the sections of a report by the name of their case."""
    parts = text.split("\n## ")[1:]
    return {part.split("`")[1]: f"## {part.strip()}" for part in parts}


def _joined(title: str, introduction: str, texts: Mapping[str, str]) -> str:
    return "\n\n".join([f"# {title}", introduction, *texts.values()]) + "\n"


def _lines_of_rows(text: str) -> list[list[str]]:
    """Return the cells of each row of the tables of a text."""
    lines = [re.split(r"(?<!\\) ?\| ?", line)[1:-1] for line in text.splitlines() if line.startswith("| ")]
    return [line for line in lines if line[0] != COLUMNS[0] and line[0] != "---"]


def _count(texts: Iterable[str], column: str) -> Counter[str]:
    return Counter(row[COLUMNS.index(column)] for text in texts for row in _lines_of_rows(text))


def _passed_by_kind(texts: Iterable[str]) -> str:
    """Return how many rows pass, of each kind of reference: ``12 of 13 rows pass: 10 of 10 equations, …``."""
    kind, passed = COLUMNS.index("kind"), COLUMNS.index("pass")
    counts = Counter((row[kind], row[passed]) for text in texts for row in _lines_of_rows(text))
    kinds = ("equations", "others", "measured")
    yes, no = ([counts[name, word] for name in kinds] for word in ("yes", "no"))
    parts = ", ".join(f"{y} of {y + n} {name}" for name, y, n in zip(kinds, yes, no, strict=True))
    return f"{sum(yes)} of {sum(yes) + sum(no)} rows pass: {parts}"


def _introduction(texts: Iterable[str], quick: bool) -> str:
    form = "the quick form of `tools/validate`" if quick else "`tools/validate`"
    passed, kinds = _count(texts, "pass"), _count(texts, "kind")
    return (
        f"{_passed_by_kind(texts)}; {passed['–']} more are for information only. "
        f"Made by {form}, version {version('foamprb').partition('+')[0]}.\n\n"
        "The kind of a reference: `equations`, the same equations solved by another method, or their closed "
        f"form ({kinds['equations']} rows, verification); `own`, ours by other meshes, frames or steps "
        f"({kinds['own']} rows, not counted above); `others`, theory or a computation of more than the "
        f"model that others printed ({kinds['others']} rows); `measured`, an experiment "
        f"({kinds['measured']} rows). The last two are validation, and have [their own page](others.md). "
        "A difference in per cent is relative to the reference. Rows without an allowed difference are for "
        "information only."
    )


def _introduction_of_others(texts: Iterable[str]) -> str:
    kinds = _count(texts, "kind")
    return (
        "The rows of the [validation report](report.md) whose reference is theory or a computation that "
        f"others printed (`others`, {kinds['others']} rows), or an experiment (`measured`, "
        f"{kinds['measured']} rows). An error bar of a reference is its scatter, or the accuracy of reading "
        "it; that of the median of a population is its standard error, and brackets are the quartiles. One "
        "of ours is numerical. The allowed difference is one for each quantity, chosen from what the "
        "reference is worth and not from the outcome: a row that exceeds it says no. Rows without one are "
        "for information."
    )


def _rows_of_others(text: str) -> str:
    """Return a section with the rows of others alone, without its figures; empty if it has none."""
    kind = COLUMNS.index("kind")
    rows = [row for row in _lines_of_rows(text) if row[kind] in ("others", "measured")]
    if not rows:
        return ""
    head, name = text.splitlines()[0], text.split("`")[1]
    lines = [COLUMNS, tuple("---" for _ in COLUMNS), *rows]
    return "\n\n".join([head, f"`{name}`", "\n".join("| " + " | ".join(line) + " |" for line in lines)])


def markdown(section: Section) -> str:
    """Return the section of a case as Markdown, its figures beside it."""
    name, case, outcome = section
    lines = [COLUMNS, tuple("---" for _ in COLUMNS), *(cells(row) for row in outcome.rows)]
    table = "\n".join("| " + " | ".join(c.replace("|", "\\|") for c in line) + " |" for line in lines)
    parts = [f"## {case.title}", f"`{name}`; {case.section}.", table, *outcome.remarks]
    for figure in outcome.figures:
        parts.append(f"![{figure.caption.replace('[', '(').replace(']', ')')}]({figure.name}.png)")
        parts.append(figure.caption)
    return "\n\n".join(parts)


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
