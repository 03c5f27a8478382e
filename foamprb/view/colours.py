"""Colours of values and names, light and dark styles, and readable numbers with units."""

from __future__ import annotations

import colorsys
import math
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.optional import load
from foamprb.results.intervals import Estimate

Table = NDArray[np.uint8]

NAMES = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8c8c8c")
"""Distinguishable colours of names (M. Okabe and K. Ito, Color Universal Design, 2008)."""

MAPS = ("viridis", "cividis", "magma", "coolwarm")
"""Colour maps of matplotlib; the last one is for values on both sides of zero."""

OF_DEPOSITS = "magma"
"""Colour map of the deposits on walls."""
_GOLDEN_ANGLE = 137.508
_PREFIXES = ((1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_SCALED_UNITS = frozenset({"m", "s", "m/s", "Pa", "N"})
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Style(NamedTuple):
    """Colours of everything but the bodies, the same as in ``page.css``."""

    paper: str
    ink: str
    soft: str
    glass: str
    edge: str
    accent: str
    deposit: str
    plane: Table
    """256 colours of a plane through the flow."""


@cache
def colour_map(name: str) -> Table:
    """Return 256 colours, (256, 3)."""
    # Those of matplotlib, whose import takes longer than a page.
    tables: Table = np.load(Path(__file__).parent / "page/maps.npy")
    return np.asarray(tables[MAPS.index(name)])


def rgb(colour: str) -> tuple[int, int, int]:
    """Return (r, g, b) of ``#rrggbb``."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def ramp(*colours: str) -> Table:
    """Return 256 colours, (256, 3), interpolated between given ones."""
    stops = np.array([rgb(colour) for colour in colours], dtype=np.float64)
    at = np.linspace(0.0, len(colours) - 1.0, 256)
    return (
        np.stack([np.interp(at, range(len(colours)), stops[:, c]) for c in range(3)], axis=1)
        .round()
        .astype(np.uint8)
    )


LIGHT = Style(
    "#ffffff",
    "#17202a",
    "#4c5966",
    "#c9d5de",
    "#51606e",
    "#0b5fa5",
    "#c2410c",
    ramp("#fbfcfd", "#a9c0d3", "#4d7597"),
)
DARK = Style(
    "#10151b",
    "#eaf0f5",
    "#adb9c5",
    "#2c3945",
    "#8797a6",
    "#7cbcf7",
    "#ff9d66",
    ramp("#141b22", "#3a5468", "#9cb9cf"),
)


def colour_of_name(k: int) -> str:
    """Return the colour of the k-th name; beyond :data:`NAMES`, hues at the golden angle."""
    if k < len(NAMES):
        return NAMES[k]
    r, g, b = colorsys.hsv_to_rgb(k * _GOLDEN_ANGLE % 360.0 / 360.0, 2.0 / 3.0, 0.75)
    return "#{:02x}{:02x}{:02x}".format(*(round(255.0 * c) for c in (r, g, b)))


def readable(unit: str, most: float) -> tuple[float, str]:
    """Return size and name of a unit in which numbers up to ``most`` need no power of ten."""
    pretty = _pretty(unit)
    if unit in _SCALED_UNITS and 0.0 < abs(most) < 1e5:
        for factor, prefix in _PREFIXES:
            if abs(most) >= 0.5 * factor:
                return factor, prefix + pretty
    return 1.0, pretty


def written(value: float, unit: str, most: float) -> str:
    """Return a value in the :func:`readable` unit of ``most``: ``0.04, "s", 0.06`` → "40 ms"."""
    factor, name = readable(unit, most)
    return f"{number(value / factor)} {name}".rstrip()


def with_interval(estimate: Estimate, unit: str = "1") -> str:
    """Return an estimate in a readable unit, with its interval if it has one: ``40 (38 to 43) ms``."""
    factor, name = readable(unit, abs(estimate.value))
    value, low, high = (number(x / factor) for x in estimate)
    text = value if math.isnan(estimate.low + estimate.high) else f"{value} ({low} to {high})"
    return f"{text} {name}".removesuffix(" 1").rstrip()


def number(value: float, digits: int = 4) -> str:
    """Return a number as the page shows it: ``1.5e-5`` → "1.5 × 10⁻⁵"."""
    if not math.isfinite(value):
        return "unknown"
    if value == 0.0 or 1e-3 <= abs(value) < 1e5:
        # Beyond its digits the format g takes powers of ten.
        return f"{float(f'{value:.{digits}g}'):.9g}".replace("-", "−")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{float(mantissa):g} × 10{str(int(exponent)).translate(_SUPERSCRIPTS)}".replace("-", "−")


def in_ascii(text: str) -> str:
    """Return a text with the numbers of :func:`number` for typefaces without superscripts: "1.5e-5"."""
    digits = {sign: digit for digit, sign in _SUPERSCRIPTS.items()}
    powers = re.compile(f" × 10([{''.join(map(chr, digits))}]+)")
    return powers.sub(lambda power: f"e{power[1].translate(digits)}", text).replace("−", "-")


def font_file(bold: bool = False) -> str:
    """Return the file of the typeface of pictures, which is the first one of the pages."""
    name = f"DejaVuSans{'-Bold' if bold else ''}.ttf"
    return str(Path(load("matplotlib").get_data_path()) / "fonts/ttf" / name)


def round_limits(low: float, high: float) -> tuple[float, float]:
    """Return round numbers, the first not above ``low``, the second not below ``high``.

    A range on one side of zero that reaches near it begins at zero. A range on both sides is symmetric.
    """
    if low < 0.0 < high:
        most = _round_up(max(-low, high))
        return -most, most
    if high <= 0.0 and low < 0.0:
        a, b = round_limits(-high, -low)
        return -b, -a
    if high == 0.0:
        return 0.0, 1.0
    if low <= 0.3 * high or high - low <= 1e-6 * high:
        return 0.0, _round_up(high)
    step = _round_up(high - low) / 10.0
    return math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step


def _round_up(value: float) -> float:
    """Return the least number of one digit that is not below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return float(f"{math.ceil(value / power * (1 - 1e-6)) * power:.12g}")


def round_down(value: float, digits: Sequence[int] = (1, 2, 3, 4, 5, 6, 8)) -> float:
    """Return the largest of some digits times a power of ten that is not above a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    digit = max(digit for digit in digits if digit * power <= value * (1 + 1e-12))
    return float(f"{digit * power:.12g}")


def _pretty(unit: str) -> str:
    """Return a unit with superscripts: ``m/s2`` → m/s²."""
    return re.sub(r"(?<=[A-Za-z])-?\d+", lambda power: power[0].translate(_SUPERSCRIPTS), unit)
