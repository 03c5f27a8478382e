"""Page about fitted properties."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from foamprb.results.atomic import atomic_write, refuse_other_kind, write_text
from foamprb.results.intervals import Estimate
from foamprb.view.colours import number
from foamprb.view.report import plots
from foamprb.view.report.page import PageSection, figure, grid, page, table
from foamprb.view.show import PAGE_BEGINS

if TYPE_CHECKING:
    from foamprb.run.fit import Fits

Floats = NDArray[np.float64]

UNITS = {
    "shearModulus": "Pa", "youngsModulus": "Pa", "viscosity": "Pa s", "surfaceTension": "N/m", "k": "Pa",
    "alpha": "1", "surfaceShearModulus": "N/m", "area": "m²", "angle": "rad", "treading": "1/s",
}  # fmt: skip


def write_fit_page(fits: Fits, target: Path) -> Path:
    """Write the page of a fit, and its plots as files beside it, in the folder ``fitPlots``."""
    refuse_other_kind(target, PAGE_BEGINS)
    columns, fitted = fits.table, fits.fitted
    made: dict[str, plots.Plot] = {}

    def drawn(name: str, plot: plots.Plot, caption: str) -> str:
        made[name] = plot
        return figure(plot, caption)

    spreads, over_size, over_place, compared = [], [], [], []
    axis = max("xyz", key=lambda name: float(np.ptp(columns[name][fitted])) if fitted.any() else 0.0)
    medians = _medians(fits)
    for name in fits.unknown if fitted.any() else ():
        y = (name, UNITS[name])
        groups = {group: _of_group(fits, name, group) for group in medians[name]}
        groups = {group: values for group, values in groups.items() if len(values)}
        plot = plots.spreads(groups, medians[name], *y)
        spreads.append(drawn(f"{name}Histogram", plot, f"{name}: median and its 95 % interval."))
        plot = plots.dots(
            columns["d"][fitted], columns[name][fitted], ("d", "m"), y, log=_is_positive(fits, name)
        )
        over_size.append(drawn(f"{name}OverSize", plot, f"{name} over the diameter."))
        if np.ptp(columns[axis][fitted]) < 0.1 * np.median(columns["d"][fitted]):
            # All pass at the same place.
            continue
        plot = plots.dots(
            columns[axis][fitted], columns[name][fitted], (axis, "m"), y, log=_is_positive(fits, name)
        )
        over_place.append(drawn(f"{name}OverPlace", plot, f"{name} over the place in the plane."))
    for name in fits.shapes if fitted.any() else ():
        unit = UNITS.get(name, "1")
        seen, predicted = columns[name][fitted], columns[f"{name}Predicted"][fitted]
        errors = columns[f"{name}Error"][fitted]
        plot = plots.dots(
            seen, predicted, (f"{name}, measured", unit), ("predicted", unit), line=True,
            errors=errors if np.isfinite(errors).any() else None,
        )  # fmt: skip
        compared.append(
            drawn(f"{name}Predicted", plot, f"{name}, predicted over measured, with standard errors.")
        )
    events = []
    if {"area", "deformation"} <= columns.keys() and fitted.any():
        area, deformation = columns["area"], columns["deformation"]
        lines = [
            (
                number(value),
                *(fits.lines[name][fits.lines["value"] == value] for name in ("area", "deformation")),
            )
            for value in np.unique(fits.lines.get("value", ()))
        ]
        plot = plots.dots(
            area[fitted], deformation[fitted], ("area", "m²"), ("deformation", "1"),
            others=(area[~fitted], deformation[~fitted]), curves=lines,
        )  # fmt: skip
        caption = f"All events; lines of equal {fits.unknown[0]}, {UNITS[fits.unknown[0]]}."
        events.append(drawn("deformationOverArea", plot, caption))
    grouped = "group" in fits.population
    rows = [
        (
            f"{row[0]} [{UNITS[row[0]]}]",
            *row[1 : 1 + grouped],
            int(row[1 + grouped]),
            *_numbers(row[2 + grouped :]),
        )
        for row in zip(*fits.population.values(), strict=True)
    ]
    heads = ("property", *(["group"] if grouped else []), "bodies", "median", "from", "to", "deviation of ln",
             "from", "to")  # fmt: skip
    population = table("Medians, with 95 % intervals", heads, rows)
    if fits.differences:
        rows = [(*row[:3], *_numbers(row[3:])) for row in zip(*fits.differences.values(), strict=True)]
        heads = ("property", "group", "less that of", "difference", "from", "to")
        population += table("Differences of medians, with 95 % intervals", heads, rows)
    reasons = table("Bodies that were not fitted", ("reason", "bodies"), fits.reasons.items())
    sections = [
        *([PageSection("events", "Events", grid(*events))] if events else []),
        PageSection("population", "Population", population + grid(*spreads)),
        PageSection("size", "Size", grid(*over_size)),
        *([PageSection("place", "Place", grid(*over_place))] if over_place else []),
        PageSection("shapes", "Shapes", grid(*compared)),
        PageSection("reasons", "Not fitted", reasons if fits.reasons else "<p>None.</p>"),
    ]
    cards = [(str(int(fitted.sum())), "bodies fitted"), (str(int((~fitted).sum())), "not fitted")]
    text = page(f"Fit: {Path(*fits.folder.resolve().parts[-4:])}", str(fits.folder), cards, [], sections)
    for name, plot in made.items():
        for ending, data in ((".svg", plot.svg_file), (".png", plot.png)):
            with atomic_write(target.parent / f"{target.stem}Plots" / f"{name}{ending}") as temporary:
                temporary.write_bytes(data)
    write_text(target, text)
    return target


def _numbers(values: Sequence[float]) -> tuple[str, ...]:
    return tuple("" if np.isnan(value) else number(value) for value in values)


def _medians(fits: Fits) -> dict[str, dict[str, Estimate]]:
    """Return the medians of each property by group, "" without groups."""
    columns = fits.population
    medians: dict[str, dict[str, Estimate]] = {name: {} for name in fits.unknown}
    groups = columns.get("group", np.full(len(columns["property"]), ""))
    ends = (columns[f"median{end}"] for end in ("", "Low", "High"))
    for name, group, *values in zip(columns["property"], groups, *ends, strict=True):
        medians[str(name)][str(group)] = Estimate(*map(float, values))
    return medians


def _of_group(fits: Fits, name: str, group: str) -> Floats:
    """Return the values of the fitted bodies of a group, those of all for ""."""
    return np.asarray(fits.table[name][fits.fitted & ((fits.table["group"] == group) if group else True)])


def _is_positive(fits: Fits, name: str) -> bool:
    return bool((fits.table[name][fits.fitted] > 0.0).all())
