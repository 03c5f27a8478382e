"""Plots in one style: distinguishable colours, symbols with units, readable on light and dark pages."""

from __future__ import annotations

import io
import re
import zlib
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.optional import load
from foamprb.results.intervals import Estimate
from foamprb.view.colours import NAMES, number, readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.backend_bases import RendererBase
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]

FATES = {
    "active": NAMES[0], "stuck": NAMES[5], "escaped": NAMES[2], "failed": NAMES[3],
    "ruptured": "#8800ff", "released": "#dd0044",
}  # fmt: skip
"""Colour of each fate: a contrast of about 3 to light and dark, distances also for the colour-blind."""
_INK, _SOFT, _PAPER = "#17202a", "#4c5966", "#ffffff"
_BINS = 40
_WIDTH, _MARGIN = 6.4, 6.0
"""Width of a plot, inches, and its margins, dots."""
_HATCHES = dict(zip(FATES, ("", "///", "...", "xxx", "ooo", "\\\\\\"), strict=True))
_MARKERS = dict(zip(FATES, "o^s*Dv", strict=True))
_MOST_DOTS = 5000
"""Dots of each fate, about, in a plot of places."""
_PER_BIN = 8
"""Mean number of particles in a bin of the way along walls, while there are few."""
_ROLES = {_INK: "currentColor", _SOFT: "var(--soft)", _PAPER: "var(--paper)"}
_STYLE: Any = {
    "font.size": 10.0,
    "font.family": "DejaVu Sans",
    "svg.fonttype": "none",
    # Names of patches may contain dollars.
    "text.parse_math": False,
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
    """Plot in three forms."""

    svg: str
    """For a page: in the colours and fonts of its text, without a background."""
    svg_file: bytes
    """For a file, on white."""
    png: bytes
    """For a file, on white, 200 dots per inch."""


def _legend(axes: Axes) -> None:
    """Draw the legend beside the axes: to look for a free place among many bars takes matplotlib seconds."""
    axes.legend(fontsize=9, loc="center left", bbox_to_anchor=(1.0, 0.5))


def _plot(draw: Callable[[Figure, Axes], None], height: float = 3.2) -> Plot:
    """Return the plot that a function draws on a figure and its axes; ``height`` in inches."""
    with load("matplotlib").rc_context(_STYLE):
        figure = load("matplotlib.figure").Figure(figsize=(_WIDTH, height))
        pixels = load("matplotlib.backends.backend_agg").FigureCanvasAgg(figure)
        draw(figure, figure.add_subplot())
        ticker = load("matplotlib.ticker")
        for axes in figure.axes:
            for axis in (axes.xaxis, axes.yaxis):
                if isinstance(axis.get_major_formatter(), ticker.ScalarFormatter):
                    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: number(value)))
        _fit(figure, pixels.get_renderer())
        file, png = io.StringIO(), io.BytesIO()
        # Figure.savefig would draw each file twice.
        figure.set_facecolor("none")
        load("matplotlib.backends.backend_svg").FigureCanvasSVG(figure).print_svg(
            file, metadata={"Date": None}
        )
        figure.set_canvas(pixels)
        figure.set_facecolor(_PAPER)
        figure.set_dpi(200)
        pixels.print_png(png, pil_kwargs={"compress_level": 3})
    text = file.getvalue()
    alone = re.sub(r"(<svg[^>]*>)", rf'\1<rect width="100%" height="100%" fill="{_PAPER}"/>', text, count=1)
    return Plot(_inline(text), alone.encode(), png.getvalue())


def _fit(figure: Figure, renderer: RendererBase) -> None:
    """Let the axes with labels and legend fill a figure; layouts of matplotlib draw everything thrice."""
    (axes,) = figure.axes
    boxes = axes.get_tightbbox(renderer), axes.get_window_extent(renderer)
    outer, inner = (np.array(box.extents if box else np.zeros(4)) for box in boxes)
    size = figure.dpi * np.array(figure.get_size_inches())
    low = (inner[:2] - outer[:2] + _MARGIN) / size
    high = 1.0 - (outer[2:] - inner[2:] + _MARGIN) / size
    axes.set_position((*low, *(high - low)))


def _inline(svg: str) -> str:
    """Return an SVG as a part of a page: without its head, in the page's colours and fonts."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    # Equal images of a plot have the same id, to which nothing refers.
    svg = re.sub(r'(<image [^>]*?) ?\bid="[^"]*"', r"\1", svg)
    # Clip paths of different plots have the same ids; a checksum makes them different.
    mark = f"p{zlib.crc32(svg.encode())}"
    svg = re.sub(r'id="([^"]+)"', rf'id="{mark}\1"', svg)
    svg = re.sub(r'(xlink:href="#|url\(#)', rf"\g<1>{mark}", svg)
    for colour, role in _ROLES.items():
        svg = svg.replace(colour, role)
    svg = re.sub(r"<text ", '<text fill="currentColor" ', svg)
    return re.sub(r"font: ([\d.]+px) [^;\"]*", r"font: \1 var(--font)", svg)


def _label(symbol: str, unit: str) -> str:
    return symbol if unit == "1" else f"{symbol} [{unit}]"


def _scaled(values: Floats, unit: str) -> tuple[float, str]:
    finite = values[np.isfinite(values)]
    return readable(unit, float(np.abs(finite).max()) if len(finite) else 0.0)


def shares(counts: dict[str, dict[str, int]]) -> Plot:
    """Return bars of particles by patch, stacked by fate: ``{"outlet": {"escaped": 900}, …}``."""
    patches = list(counts)

    def draw(_: object, axes: Axes) -> None:
        left = np.zeros(len(patches))
        for fate, colour in FATES.items():
            widths = np.array([counts[patch].get(fate, 0) for patch in patches], dtype=float)
            if widths.any():
                axes.barh(patches, widths, left=left, color=colour, label=fate, hatch=_HATCHES[fate],
                          edgecolor=_PAPER, linewidth=0.5, height=0.68)  # fmt: skip
                left += widths
        for row, total in enumerate(left):
            axes.annotate(f" {total:.0f}", (total, row), va="center")
        axes.invert_yaxis()
        axes.grid(False, axis="y")
        axes.margins(x=0.1)
        axes.set(xlabel="particles", ylabel="")
        _legend(axes)

    return _plot(draw, height=0.9 + 0.42 * len(patches))


def histogram(groups: dict[str, Floats], symbol: str, unit: str) -> Plot:
    """Return stacked histograms of a quantity by fate."""
    everything = np.concatenate([v[np.isfinite(v)] for v in groups.values()])
    factor, name = _scaled(everything, unit)

    def draw(_: object, axes: Axes) -> None:
        low, high = (everything.min(), everything.max()) if len(everything) else (0.0, 1.0)
        if high <= low:
            low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
        edges = np.linspace(low, high, _BINS + 1) / factor
        bottom = np.zeros(_BINS)
        for fate, values in groups.items():
            height = np.histogram(values[np.isfinite(values)] / factor, edges)[0]
            if height.any():
                axes.bar(
                    edges[:-1], height, np.diff(edges), bottom=bottom, align="edge", label=fate,
                    color=FATES[fate], hatch=_HATCHES[fate], edgecolor=_PAPER, linewidth=0.4,
                )  # fmt: skip
                bottom += height
        axes.set(xlabel=_label(symbol, name), ylabel="particles")
        _legend(axes)

    return _plot(draw)


def curves(
    lines: Sequence[tuple[str, Floats, Floats]],
    x: tuple[str, str],
    y: tuple[str, str],
    band: tuple[Floats, Floats, Floats] | None = None,
) -> Plot:
    """Return curves, and a band between two curves.

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

    def draw(_: object, axes: Axes) -> None:
        if band is not None:
            axes.fill_between(band[0] / fx, band[1] / fy, band[2] / fy, color=NAMES[0], alpha=0.22,
                              linewidth=0, label="9 in 10")  # fmt: skip
        for k, (label, along, up) in enumerate(lines):
            axes.plot(along / fx, up / fy, linestyle=dashes[k % 6], color=NAMES[(0, 5, 2, 3, 1, 4)[k % 6]],
                      label=label)  # fmt: skip
        axes.set(xlabel=_label(x[0], nx), ylabel=_label(y[0], ny))
        _legend(axes)

    return _plot(draw)


def dots(
    x: Floats,
    y: Floats,
    x_axis: tuple[str, str],
    y_axis: tuple[str, str],
    line: bool = False,
    log: bool = False,
    errors: Floats | None = None,
    others: tuple[Floats, Floats] | None = None,
    curves: Sequence[tuple[str, Floats, Floats]] = (),
) -> Plot:
    """Return a dot for each body; a selection of many.

    Parameters
    ----------
    x, y
        Values, (n,).
    x_axis, y_axis
        Symbol and unit of both axes.
    line
        Whether to draw the line on which both are equal.
    log
        Whether the axis of y is logarithmic.
    errors
        Standard errors of x, (n,), drawn as bars.
    others
        x and y of bodies that were left out.
    curves
        Label, x and y of curves.
    """
    few = slice(None, None, 1 + len(x) // _MOST_DOTS)
    (fx, nx), (fy, ny) = _scaled(x, x_axis[1]), _scaled(y, y_axis[1])

    def draw(_: object, axes: Axes) -> None:
        if others is not None and len(others[0]):
            axes.plot(others[0] / fx, others[1] / fy, "x", color=_SOFT, markersize=3.5, markeredgewidth=0.8,
                      rasterized=True, label="left out")  # fmt: skip
        if errors is not None:
            axes.errorbar(x[few] / fx, y[few] / fy, xerr=errors[few] / fx, fmt="none", ecolor=NAMES[0],
                          elinewidth=0.6, alpha=0.35)  # fmt: skip
        axes.plot(x[few] / fx, y[few] / fy, "o", color=NAMES[0], markersize=3.0, markeredgewidth=0.0,
                  alpha=0.5, rasterized=True)  # fmt: skip
        for label, along, up in curves:
            axes.plot(along / fx, up / fy, color=_INK, linewidth=0.9)
            axes.annotate(label, (along[-1] / fx, up[-1] / fy), fontsize=8)
        if others is not None and len(others[0]):
            _legend(axes)
        if line:
            ends = np.array([np.nanmin(x), np.nanmax(x)])
            axes.plot(ends / fx, ends / fy, "--", color=NAMES[5], label="equal")
            _legend(axes)
        axes.set(xlabel=_label(x_axis[0], nx), ylabel=_label(y_axis[0], ny))
        if log:
            axes.set_yscale("log")
            # matplotlib's powers would be formulas, which labels do not have.
            plain = load("matplotlib.ticker").FuncFormatter(lambda value, _: number(value))
            axes.yaxis.set_major_formatter(plain)
            axes.yaxis.set_minor_formatter(plain)

    return _plot(draw)


def spreads(groups: dict[str, Floats], medians: dict[str, Estimate], symbol: str, unit: str) -> Plot:
    """Return histograms of a quantity of groups of bodies, with their medians and the intervals of these."""
    everything = np.concatenate(list(groups.values()))
    factor, name = _scaled(everything, unit)
    low, high = np.quantile(everything, (0.005, 0.995))
    edges = np.linspace(low, high if high > low else low + (abs(low) or 1.0), _BINS + 1)

    def draw(_: object, axes: Axes) -> None:
        for k, (group, values) in enumerate(groups.items()):
            colour, median = NAMES[(0, 5, 2, 3, 1, 4)[k % 6]], medians[group]
            bins, label = (edges / factor).tolist(), group or "bodies"
            axes.hist(values / factor, bins, histtype="step", color=colour, label=label)
            axes.axvline(median.value / factor, color=colour, linestyle="--", linewidth=1.0)
            axes.axvspan(median.low / factor, median.high / factor, color=colour, alpha=0.22, linewidth=0)
        axes.set(xlabel=_label(symbol, name), ylabel="bodies")
        _legend(axes)

    return _plot(draw)


def by_origin(x: Floats, fates: NDArray[np.str_]) -> Plot:
    """Return the places of release (n, 3), m, coloured by fate; rare fates are drawn over frequent ones."""
    extent = np.ptp(x, axis=0)
    first, second = (axis for axis in range(3) if axis != int(np.argmin(extent)))
    factor, name = readable("m", float(extent.max()))
    groups = {fate: np.flatnonzero(fates == fate) for fate in FATES if (fates == fate).any()}

    def draw(_: object, axes: Axes) -> None:
        for k, fate in enumerate(sorted(groups, key=lambda fate: -len(groups[fate]))):
            dots = x[groups[fate][:: 1 + len(groups[fate]) // _MOST_DOTS]] / factor
            axes.plot(
                dots[:, first], dots[:, second], _MARKERS[fate], color=FATES[fate],
                markersize=5.0 if k else 3.0, markeredgewidth=0.0, rasterized=True,
                label=f"{fate} ({len(groups[fate])})",
            )  # fmt: skip
        ratio = extent[first] / max(extent[second], 1e-300)
        axes.set_aspect("equal" if 0.2 < ratio < 5.0 else "auto")
        axes.set(xlabel=f"{'xyz'[first]} [{name}]", ylabel=f"{'xyz'[second]} [{name}]")
        _legend(axes)

    return _plot(draw)


def per_length(ways: Mapping[str, Floats], longest: float) -> Plot:
    """Return the particles per length over the lengths of their ways, (n,), m, by the names of walls.

    The axis ends at the ``longest`` way, m.
    """
    factor, name = readable("m", longest)
    most = max(map(len, ways.values()))
    edges = np.linspace(0.0, longest, int(np.clip(most / _PER_BIN, 4, _BINS)) + 1)

    def draw(_: object, axes: Axes) -> None:
        for k, (wall, lengths) in enumerate(ways.items()):
            numbers = np.histogram(lengths, edges)[0] / np.diff(edges)
            colour = NAMES[(0, 5, 2, 3, 1, 4)[k % 6]]
            axes.stairs(numbers, edges / factor, color=colour, linewidth=1.4, label=wall)
        axes.set(xlabel=f"way along the walls from the release [{name}]", ylabel="particles per length [1/m]")
        axes.set_ylim(bottom=0.0)
        _legend(axes)

    return _plot(draw)
