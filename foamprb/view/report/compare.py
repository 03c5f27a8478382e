"""Page that shows several runs side by side."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.results.atomic import refuse_other_kind, write_text
from foamprb.view.colours import written
from foamprb.view.report import plots
from foamprb.view.report.page import PageSection, figure, grid, page, table
from foamprb.view.results import Table
from foamprb.view.runs import Runs
from foamprb.view.show import PAGE_BEGINS, spread

Floats = NDArray[np.float64]

_MOST_CURVES = 12


def write_comparison(runs: Runs, target: Path) -> Path:
    """Write a page about several runs that have ended, in one step: a row for each, and their distributions.

    Parameters
    ----------
    runs
        The runs.
    target
        The page.

    Returns
    -------
    The page.

    Raises
    ------
    InputError
        If none has ended, or files are damaged.
    OSError
        If the file cannot be written.
    """
    refuse_other_kind(target, PAGE_BEGINS)
    ended = {name: fates for name, run in runs.items() if (fates := run.fates()) is not None}
    if not ended:
        raise InputError(f"none of the runs {', '.join(runs)} has ended. To continue: foamprb run -resume.")
    missing = [name for name in runs if name not in ended]
    released = {name: _released(fates) for name, fates in ended.items()}
    labels = _labels(runs, released)
    sections = [
        PageSection("runs", "Runs", _rows(runs, released)),
        PageSection("fates", "Places", _places(labels, released)),
        PageSection("distributions", "Distributions", _distributions(labels, released)),
    ]
    text = page(
        "Comparison",
        f"{len(released)} runs that have ended",
        [(f"{sum(len(fates['id']) for fates in released.values())}", "particles in all")],
        [f"{name} has not ended and is left out." for name in missing],
        sections,
    )
    target.parent.mkdir(parents=True, exist_ok=True)
    write_text(target, text)
    return target


def _released(fates: Table) -> Table:
    here = fates["fate"] != "pending"
    return {name: column[here] for name, column in fates.items()}


def _labels(runs: Runs, names: Iterable[str]) -> dict[str, str]:
    """Return a short text for each run: the values of the replaced entries, or its name."""
    entries = runs.entries
    return {
        name: ", ".join(f"{path.split('/')[-1]} {text}" for path, text in entries[name].items()) or name
        for name in names
    }


def _rows(runs: Runs, released: dict[str, Table]) -> str:
    entries = runs.entries
    paths = list(dict.fromkeys(path for name in released for path in entries[name]))
    tables = released.values()
    fates_of = [name for name in plots.FATES if any((fates["fate"] == name).any() for fates in tables)]
    rows = []
    for name, fates in released.items():
        counts = [int((fates["fate"] == fate).sum()) for fate in fates_of]
        rows.append(
            (
                name,
                *(entries[name].get(path, "") for path in paths),
                len(fates["id"]),
                *counts,
                _quantile(fates["t1"] - fates["t0"], 0.5, "s"),
                *(_quantile(fates.get("D", np.zeros(0)), share) for share in (0.5, 0.95)),
            )
        )
    head = (
        *("run", *(path.split("/")[-1] for path in paths), "injected", *fates_of),
        *("median residence time", "median D", "D of 19 in 20 below"),
    )
    return table("A row for each run; D at the end of each particle", head, rows)


def _quantile(values: Floats, share: float, unit: str = "") -> str:
    values = values[np.isfinite(values)]
    if not len(values):
        return ""
    quantile = float(np.quantile(values, share))
    return written(quantile, unit, quantile) if unit else f"{quantile:.4g}"


def _places(labels: dict[str, str], released: dict[str, Table]) -> str:
    """Return the shares of the particles by fate and patch."""
    counts = {
        name: dict(zip(*np.unique(_where(fates), return_counts=True), strict=True))
        for name, fates in released.items()
    }
    places = sorted({str(place) for by_place in counts.values() for place in by_place})
    rows = [
        (
            labels[name],
            *(f"{100.0 * counts[name].get(place, 0) / len(released[name]['id']):.1f} %" for place in places),
        )
        for name in released
        if len(released[name]["id"])
    ]
    return table("Share of the particles by fate and patch", ("run", *places), rows)


def _where(fates: Table) -> NDArray[np.str_]:
    pairs = zip(fates["fate"].tolist(), fates["patch"].tolist(), strict=True)
    return np.array([f"{fate}: {patch}" if patch else fate for fate, patch in pairs])


def _distributions(labels: dict[str, str], released: dict[str, Table]) -> str:
    shown = [list(released)[k] for k in spread(len(released), _MOST_CURVES)]
    few = f"<p>{len(shown)} of {len(released)} runs, evenly spread.</p>" if len(shown) < len(released) else ""
    D = [(labels[name], released[name]["D"]) for name in shown if "D" in released[name]]
    times = [(labels[name], released[name]["t1"] - released[name]["t0"]) for name in shown]
    return few + grid(
        _distribution(D, ("D", "1"), "Taylor's deformation at the end of each particle"),
        _distribution(times, ("t", "s"), "residence time"),
    )


def _distribution(groups: Sequence[tuple[str, Floats]], x: tuple[str, str], what: str) -> str:
    """Return a figure with the share of the particles below each value."""
    lines = []
    for label, values in groups:
        values = np.sort(values[np.isfinite(values)])
        lines.append((label, values, np.arange(1, len(values) + 1) / max(1, len(values))))
    if not any(len(values) for _, values, _ in lines):
        return ""
    plot = plots.curves(lines, x, ("share of the particles below", "1"))
    return figure(plot, f"Distribution of {what}.")
