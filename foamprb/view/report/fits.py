"""Page about fitted properties."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from foamprb.results.atomic import atomic_write, refuse_other_kind, write_text
from foamprb.view.colours import number
from foamprb.view.report import plots
from foamprb.view.report.page import PageSection, figure, grid, page, table
from foamprb.view.show import PAGE_BEGINS

if TYPE_CHECKING:
    from foamprb.run.fit import Fits

_UNITS = {
    "shearModulus": "Pa", "viscosity": "Pa s", "surfaceTension": "N/m", "area": "m²", "angle": "rad",
    "treading": "1/s", "k": "Pa", "alpha": "1",
}  # fmt: skip


def _numbers(values: Sequence[float]) -> tuple[str, ...]:
    return tuple("" if np.isnan(value) else number(value) for value in values)


def write_fit_page(fits: Fits, target: Path) -> Path:
    """Write the page of a fit, and its plots as files beside it, in the folder ``fitPlots``."""
    refuse_other_kind(target, PAGE_BEGINS)
    columns, fitted = fits.table, fits.fitted
    made: dict[str, plots.Plot] = {}

    def drawn(name: str, plot: plots.Plot, caption: str) -> str:
        made[name] = plot
        return figure(plot, caption)

    over_size, over_place, compared = [], [], []
    axis = max("xyz", key=lambda name: float(np.ptp(columns[name][fitted])) if fitted.any() else 0.0)
    for name in fits.unknown if fitted.any() else ():
        y = (name, _UNITS[name])
        plot = plots.dots(columns["d"][fitted], columns[name][fitted], ("d", "m"), y, log=True)
        over_size.append(drawn(f"{name}OverSize", plot, f"{name} over the diameter."))
        if np.ptp(columns[axis][fitted]) < 0.1 * np.median(columns["d"][fitted]):
            # All pass at the same place.
            continue
        plot = plots.dots(columns[axis][fitted], columns[name][fitted], (axis, "m"), y, log=True)
        over_place.append(drawn(f"{name}OverPlace", plot, f"{name} over the place in the plane."))
    for name in fits.shapes if fitted.any() else ():
        unit = _UNITS.get(name, "1")
        seen, predicted = columns[name][fitted], columns[f"{name}Predicted"][fitted]
        plot = plots.dots(seen, predicted, (f"{name}, measured", unit), ("predicted", unit), line=True)
        compared.append(drawn(f"{name}Predicted", plot, f"{name}, predicted over measured."))
    grouped = "group" in fits.population
    numbers = [
        (*row[: 1 + grouped], *map(int, row[1 + grouped : 2 + grouped]), *_numbers(row[2 + grouped :]))
        for row in zip(*fits.population.values(), strict=True)
    ]
    heads = ("property", *(["group"] if grouped else []), "bodies", "median", "from", "to", "deviation of ln",
             "from", "to")  # fmt: skip
    reasons = table("Bodies that were not fitted", ("reason", "bodies"), fits.reasons.items())
    sections = [
        PageSection("population", "Population", table("Medians, with 95 % intervals", heads, numbers)),
        PageSection("size", "Size", grid(*over_size)),
        *([PageSection("place", "Place", grid(*over_place))] if over_place else []),
        PageSection("shapes", "Shapes", grid(*compared)),
        PageSection("reasons", "Not fitted", reasons if fits.reasons else "<p>None.</p>"),
    ]
    cards = [(str(int(fitted.sum())), "bodies fitted"), (str(int((~fitted).sum())), "not fitted")]
    text = page("Fit", str(fits.folder), cards, [], sections)
    for name, plot in made.items():
        for ending, data in ((".svg", plot.svg_file), (".png", plot.png)):
            with atomic_write(target.parent / f"{target.stem}Plots" / f"{name}{ending}") as temporary:
                temporary.write_bytes(data)
    write_text(target, text)
    return target
