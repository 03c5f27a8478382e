"""Plots in one style: colours that most people tell apart, symbols with units, on any ground."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.view.colours import NAMES, readable
from foamprb.view.geometry import Geometry
from foamprb.view.libraries import load
from foamprb.view.report.deposits import Deposits

__all__ = [
    "FATES",
    "Plot",
    "curves",
    "histogram",
    "on_geometry",
    "shares",
    "unrolled",
]

Floats = NDArray[np.float64]

FATES = {"active": NAMES[0], "stuck": NAMES[5], "escaped": NAMES[2], "failed": NAMES[3]}
"""Colour of each fate; each has three times the brightness of both grounds, or a third."""
_INK, _SOFT, _PAPER = "#17202a", "#4c5966", "#ffffff"
_HATCHES = ("", "///", "...", "xxx")
_ROLES = {_INK: "currentColor", _SOFT: "var(--soft)", _PAPER: "var(--paper)"}
_STYLE: Any = {
    "font.size": 10.0,
    "font.family": "sans-serif",
    "svg.fonttype": "none",
    "svg.hashsalt": "foamprb",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": _SOFT,
    "axes.labelcolor": _INK,
    "axes.titlecolor": _INK,
    "axes.titlesize": 10.0,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": _SOFT,
    "grid.alpha": 0.25,
    "grid.linewidth": 0.6,
    "text.color": _INK,
    "xtick.color": _SOFT,
    "ytick.color": _SOFT,
    "xtick.labelcolor": _INK,
    "ytick.labelcolor": _INK,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "figure.dpi": 100.0,
    "savefig.facecolor": "none",
    "axes.facecolor": "none",
    "image.cmap": "viridis",
}


class Plot(NamedTuple):
    """A plot in two forms."""

    svg: str
    """For a page: its ink is that of the text around it, on a ground of any colour."""
    svg_file: bytes
    """By itself, on white."""
    png: bytes
    """The same, 200 dots an inch."""


@contextmanager
def _figure(width: float = 6.4, height: float = 3.2) -> Iterator[tuple[Any, Any, list[Plot]]]:
    """A figure in the style; what is drawn in it is in the list afterwards."""
    made: list[Plot] = []
    with load("matplotlib").rc_context(_STYLE):
        figure = load("matplotlib.figure").Figure(figsize=(width, height), layout="constrained")
        load("matplotlib.backends.backend_agg").FigureCanvasAgg(figure)
        yield figure, figure.add_subplot(), made
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None})
        alone, png = io.BytesIO(), io.BytesIO()
        figure.savefig(alone, format="svg", facecolor=_PAPER, metadata={"Date": None})
        figure.savefig(png, format="png", facecolor=_PAPER, dpi=200)
    made.append(Plot(_inline(text.getvalue()), alone.getvalue(), png.getvalue()))


def _inline(svg: str) -> str:
    """An SVG as a part of a page: without its head, in the page's colours and letters."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    # The names of clip paths are those of the drawing's own numbers: unlike in each plot, by its contents.
    mark = f"p{abs(hash(svg)) % 10**8}"
    svg = re.sub(r'id="([^"]+)"', rf'id="{mark}\1"', svg)
    svg = re.sub(r'(xlink:href="#|url\(#)', rf"\g<1>{mark}", svg)
    for colour, role in _ROLES.items():
        svg = svg.replace(colour, role)
    svg = re.sub(r"<text ", '<text fill="currentColor" ', svg)
    return re.sub(r"font: ([\d.]+px) [^;\"]*", r"font: \1 var(--font)", svg)


def _labels(axes: Any, x: str, y: str) -> None:
    axes.set_xlabel(x)
    axes.set_ylabel(y)


def _scaled(values: Floats, unit: str) -> tuple[float, str]:
    finite = values[np.isfinite(values)]
    return readable(unit, float(np.abs(finite).max()) if len(finite) else 0.0)


def shares(counts: dict[str, dict[str, int]]) -> Plot:
    """Bars of particles by patch, in parts by fate: ``{"outlet": {"escaped": 900}, …}``."""
    patches = list(counts)
    with _figure(height=0.9 + 0.42 * len(patches)) as (_, axes, made):
        left = np.zeros(len(patches))
        for k, (fate, colour) in enumerate(FATES.items()):
            widths = np.array([counts[patch].get(fate, 0) for patch in patches], dtype=float)
            if widths.any():
                axes.barh(patches, widths, left=left, color=colour, label=fate, hatch=_HATCHES[k],
                          edgecolor=_PAPER, linewidth=0.5, height=0.68)  # fmt: skip
                left += widths
        for row, total in enumerate(left):
            axes.annotate(f" {total:.0f}", (total, row), va="center")
        axes.invert_yaxis()
        axes.grid(False, axis="y")
        axes.margins(x=0.1)
        _labels(axes, "particles", "")
        axes.legend(fontsize=9)
    return made[0]


def histogram(
    groups: dict[str, Floats], symbol: str, unit: str, colours: dict[str, str], bins: int = 40
) -> Plot:
    """Histograms of a quantity by group, one upon the other."""
    everything = np.concatenate([v[np.isfinite(v)] for v in groups.values()])
    factor, name = _scaled(everything, unit)
    with _figure() as (_, axes, made):
        low, high = (everything.min(), everything.max()) if len(everything) else (0.0, 1.0)
        if high <= low:
            low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
        edges = np.linspace(low, high, bins + 1) / factor
        bottom = np.zeros(bins)
        for k, (group, values) in enumerate(groups.items()):
            height = np.histogram(values[np.isfinite(values)] / factor, edges)[0]
            if height.any():
                axes.bar(edges[:-1], height, np.diff(edges), bottom=bottom, align="edge", label=group,
                         color=colours.get(group, NAMES[k % 6]), hatch=_HATCHES[k % 4], edgecolor=_PAPER,
                         linewidth=0.4)  # fmt: skip
                bottom += height
        _labels(axes, f"{symbol} [{name}]" if name != "1" else symbol, "particles")
        axes.legend(fontsize=9)
    return made[0]


def curves(
    lines: Sequence[tuple[str, Floats, Floats]],
    x: tuple[str, str],
    y: tuple[str, str],
    band: tuple[Floats, Floats, Floats] | None = None,
) -> Plot:
    """Curves, and a band between two.

    Parameters
    ----------
    lines
        The label, x and y of each.
    x, y
        Symbol and unit of both axes.
    band
        x, and y of its lower and upper edge.
    """
    dashes = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)))
    fx, nx = _scaled(np.concatenate([line[1] for line in lines]), x[1])
    fy, ny = _scaled(np.concatenate([line[2] for line in lines]), y[1])
    with _figure() as (_, axes, made):
        if band is not None:
            axes.fill_between(band[0] / fx, band[1] / fy, band[2] / fy, color=NAMES[0], alpha=0.22,
                              linewidth=0, label="9 in 10")  # fmt: skip
        for k, (label, along, up) in enumerate(lines):
            axes.plot(along / fx, up / fy, linestyle=dashes[k % 6], color=NAMES[(0, 5, 2, 3, 1, 4)[k % 6]],
                      label=label)  # fmt: skip
        _labels(axes, f"{x[0]} [{nx}]" if nx != "1" else x[0], f"{y[0]} [{ny}]" if ny != "1" else y[0])
        axes.legend(fontsize=9, ncols=2 if len(lines) > 3 else 1)
    return made[0]


def unrolled(found: Deposits) -> Plot:
    """Particles per area of a wall, unrolled."""
    factor, name = readable("m", float(max(np.ptp(edges) for edges in found.edges)))
    with _figure() as (figure, axes, made):
        image = axes.pcolormesh(
            found.edges[0] / factor, found.edges[1] / factor, found.density.T, rasterized=True, vmin=0.0
        )
        if found.number <= 2000:
            axes.plot(*(found.points / factor).T, ".", color="#ffffff", markersize=1.4, markeredgewidth=0.0)
        axes.grid(False)
        ratio = np.ptp(found.edges[0]) / max(np.ptp(found.edges[1]), 1e-300)
        axes.set_aspect("equal" if 0.2 < ratio < 5.0 else "auto")
        axes.xaxis.set_major_locator(load("matplotlib.ticker").MaxNLocator(6))
        _labels(axes, f"{found.across[0]} {found.name} [{name}]", f"{found.across[1]} [{name}]")
        bar = figure.colorbar(image, ax=axes)
        bar.set_label("particles per area [1/m²]")
        bar.outline.set_visible(False)
    return made[0]


def on_geometry(geometry: Geometry, walls: dict[str, Deposits]) -> Plot:
    """Particles per area on all walls, seen from two sides, the hidden parts behind."""
    corners, values = [], []
    for surface in geometry.surfaces:
        triangles = surface.points[surface.triangles]
        own = walls.get(surface.name)
        corners.append(triangles)
        values.append(own.triangles if own else np.full(len(triangles), np.nan))
    corner, value = np.concatenate(corners), np.concatenate(values)
    extent = np.ptp(corner.reshape(-1, 3), axis=0)
    hidden = int(np.argmin(extent)) if geometry.flat is None else int(np.argmax(np.abs(geometry.flat)))
    first, second = (axis for axis in range(3) if axis != hidden)
    factor, name = readable("m", float(extent.max()))
    # The walls of a flat case are seen from their edges.
    sides, width = ((1.0, -1.0), 0.2) if geometry.flat is None else ((1.0,), 4.0)
    with _figure(height=(2.6 if len(sides) > 1 else 3.6) * len(sides) + 0.4) as (figure, axes, made):
        axes.remove()
        panels = np.atleast_1d(figure.subplots(len(sides), 1, sharex=True))
        high = float(np.nanmax(value)) if np.isfinite(value).any() else 1.0
        for panel, side in zip(panels, sides, strict=True):
            order = np.argsort(side * corner[:, :, hidden].mean(axis=1))
            order = order[np.isfinite(value[order])]
            outlines: Any = corner[order][:, :, [first, second]] / factor
            shown = load("matplotlib.collections").PolyCollection(
                outlines, array=value[order], edgecolors="face", linewidths=width, rasterized=True
            )
            shown.set_clim(0.0, high or 1.0)
            panel.add_collection(shown)
            for start, end in geometry.edges[:, :, [first, second]] / factor:
                panel.plot([start[0], end[0]], [start[1], end[1]], color=_SOFT, linewidth=0.5)
            panel.autoscale_view()
            panel.set_aspect("equal")
            panel.grid(False)
            sign = "+" if side > 0.0 else "−"
            panel.set_title(f"seen from {sign}{'xyz'[hidden]}", loc="left")
            panel.set_ylabel(f"{'xyz'[second]} [{name}]")
        panels[-1].set_xlabel(f"{'xyz'[first]} [{name}]")
        bar = figure.colorbar(shown, ax=list(panels))
        bar.set_label("particles per area [1/m²]")
        bar.outline.set_visible(False)
    return made[0]
