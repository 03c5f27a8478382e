"""Page that shows several runs side by side."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import dist
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.results.atomic import refuse_other_kind, write_text
from foamprb.results.intervals import Estimate, difference, pair_correlation, quantile, share
from foamprb.results.record import Record
from foamprb.view.colours import with_interval
from foamprb.view.report import plots
from foamprb.view.report.page import PageSection, figure, grid, page, table
from foamprb.view.results import Table
from foamprb.view.runs import Runs
from foamprb.view.sensitivity import (
    QUANTITIES,
    Design,
    design_of,
    index_table,
    largest_deformation,
    places_of,
    samples_of,
)
from foamprb.view.show import PAGE_BEGINS, spread

Floats = NDArray[np.float64]

_MOST_CURVES = 12
_MOST_CONTRASTS = 50
"""Most runs whose differences from the first are listed."""


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
    renamed = {name: same_places(runs[name].record, runs[next(iter(ended))].record) for name in ended}
    released = {name: _renamed(fates, renamed[name]) for name, fates in ended.items()}
    labels = _labels(runs, released)
    sections = [
        PageSection("runs", "Runs", _rows(runs, released)),
        PageSection("fates", "Places", _places(labels, released)),
        *_contrasts(runs, labels, released),
        PageSection("distributions", "Distributions", _distributions(labels, released)),
    ]
    text = page(
        f"Comparison: {', '.join([*released][:3])}{', …' * (len(released) > 3)}",
        f"{len(released)} runs that have ended",
        [(f"{sum(len(fates['id']) for fates in released.values())}", "particles in all")],
        [
            *(f"{name} has not ended and is left out." for name in missing),
            *(
                f"The patch {old} of {name} lies where {new} of the first run does, and has its name here."
                for name, names in renamed.items()
                for old, new in names.items()
            ),
        ],
        sections,
    )
    target.parent.mkdir(parents=True, exist_ok=True)
    write_text(target, text)
    return target


def same_places(record: Record, first: Record) -> dict[str, str]:
    """Return the names of patches in a first run, by those in another run, where the names differ.

    Two patches meet if their areas agree to 10 %, and their centres to 5 % of the root of the area. None is
    renamed if two of them would get the same name, or the runs have no places of patches.
    """
    known = [p for p in first.get("patches", ()) if p.get("area")]
    names: dict[str, str] = {}
    for patch in record.get("patches", ()):
        size, x = patch.get("area", 0.0), patch.get("centre", ())
        here = [
            p["name"]
            for p in known
            if abs(p["area"] - size) < 0.1 * size and dist(p["centre"], x) < 0.05 * size**0.5
        ]
        names[patch["name"]] = here[0] if len(here) == 1 else patch["name"]
    if len(set(names.values())) < len(names):
        return {}
    return {old: new for old, new in names.items() if old != new}


def _renamed(fates: Table, names: Mapping[str, str]) -> Table:
    """Return fates with other names of patches."""
    return fates | {"patch": np.array([names.get(name, name) for name in fates["patch"].tolist()], dtype=str)}


def _contrasts(runs: Runs, labels: dict[str, str], released: dict[str, Table]) -> Iterator[PageSection]:
    """Yield the section of the indices of a Sobol design, or of the differences of other runs."""
    design = design_of(runs.numbers, runs.entries, released)
    if design is not None:
        yield PageSection("indices", "Sensitivity", _indices(released, design))
    elif 1 < len(released) <= _MOST_CONTRASTS:
        yield PageSection("differences", "Differences", _differences(labels, released))


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
        D = largest_deformation(fates)
        rows.append(
            (
                name,
                *(entries[name].get(path, "") for path in paths),
                len(fates["id"]),
                *counts,
                *(_text(quantile(values, p), unit) for values, p, unit in (
                    (fates["t1"] - fates["t0"], 0.5, "s"), (D, 0.5, "1"), (D, 0.95, "1")
                )),
            )
        )  # fmt: skip
    head = (
        *("run", *(path.split("/")[-1] for path in paths), "injected", *fates_of),
        *("median residence time", "median largest D", "largest D of 19 in 20 below"),
    )
    caption = "A row for each run; the largest D on each path; in parentheses 95 % intervals"
    return table(caption, head, rows)


def _text(estimate: Estimate, unit: str = "1") -> str:
    return "" if np.isnan(estimate.value) else with_interval(estimate, unit)


def _places(labels: dict[str, str], released: dict[str, Table]) -> str:
    """Return the shares of the particles by fate and patch."""
    counts = {
        name: dict(zip(*np.unique(places_of(fates), return_counts=True), strict=True))
        for name, fates in released.items()
    }
    places = _all_places(released)
    rows = [
        (labels[name], *(share(int(counts[name].get(p, 0)), len(fates["id"])).percent() for p in places))
        for name, fates in released.items()
        if len(fates["id"])
    ]
    caption = "Share of the particles by fate and patch; in parentheses 95 % intervals, after Wilson"
    return table(caption, ("run", *places), rows)


def _all_places(released: dict[str, Table]) -> list[str]:
    return sorted({str(place) for fates in released.values() for place in np.unique(places_of(fates))})


def _differences(labels: dict[str, str], released: dict[str, Table]) -> str:
    """Return the differences of the other runs from the first."""
    first, *others = released
    places, there, before = _all_places(released), places_of(released[first]), samples_of(released[first])
    rows = []
    for name in others:
        pairs = _same_starts(released[name], released[first])
        here, after = places_of(released[name]), samples_of(released[name])
        shares = (_difference_of_shares(here == place, there == place, pairs) for place in places)
        medians = (
            _text(_difference_of_medians(after[what], before[what], pairs), unit)
            for what, unit in QUANTITIES.items()
        )
        rows.append((labels[name], "yes" if pairs else "no", *shares, *medians))
    caption = (
        f"Differences from the first run, {labels[first]}; in parentheses 95 % intervals. Runs that release "
        "the same particles are compared in pairs."
    )
    head = ("run", "same particles", *places, *(f"median {what}" for what in QUANTITIES))
    return table(caption, head, rows)


def _same_starts(a: Table, b: Table) -> bool:
    """Return True if two runs have released the same particles at the same places and times."""
    columns = ("id", "t0", "x0", "y0", "z0")
    return all(name in a and name in b and np.array_equal(a[name], b[name]) for name in columns)


def _difference_of_shares(a: NDArray[np.bool_], b: NDArray[np.bool_], pairs: bool) -> str:
    of_a, of_b = (share(int(of_run.sum()), len(of_run)) for of_run in (a, b))
    change = difference(of_a, of_b, pair_correlation(a, b) if pairs else 0.0)
    return _text(Estimate(*(100.0 * x for x in change)), "%")


def _difference_of_medians(a: Floats, b: Floats, pairs: bool) -> Estimate:
    of_a, of_b, correlation = quantile(a), quantile(b), 0.0
    if pairs:
        both = np.isfinite(a) & np.isfinite(b)
        correlation = pair_correlation(a[both] < of_a.value, b[both] < of_b.value)
    return difference(of_a, of_b, correlation)


def _indices(released: dict[str, Table], design: Design) -> str:
    """Return the indices of Sobol of the runs of a design."""
    columns = index_table(design, released)
    first, total = (
        map(_text, map(Estimate, *(columns[f"{kind}{end}"].tolist() for end in ("", "Low", "High"))))
        for kind in ("first", "total")
    )
    entries = (path.split("/")[-1] for path in columns["entry"].tolist())
    rows = zip(columns["result"].tolist(), entries, first, total, strict=True)
    caption = (
        f"Indices of Sobol by {design.runs.size} runs: the share of the variance that an entry explains by "
        "itself, and with its interactions; in parentheses 95 % intervals"
    )
    lost = f"{design.missing} rows of the design are left out; n is a power of 2." if design.missing else ""
    return f"<p>{lost}</p>" * bool(lost) + table(caption, ("result", "entry", "first order", "total"), rows)


def _distributions(labels: dict[str, str], released: dict[str, Table]) -> str:
    shown = [list(released)[k] for k in spread(len(released), _MOST_CURVES)]
    few = f"<p>{len(shown)} of {len(released)} runs, evenly spread.</p>" if len(shown) < len(released) else ""
    D = [(labels[name], largest_deformation(released[name])) for name in shown]
    times = [(labels[name], released[name]["t1"] - released[name]["t0"]) for name in shown]
    return few + grid(
        _distribution(D, ("D", "1"), "the largest D on the path of each particle"),
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
