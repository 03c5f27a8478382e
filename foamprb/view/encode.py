"""Numbers as text for a page: quantised, predicted from the times before, deflated, base64.

A *column* is an array of integers with the time as its first axis. Each number is replaced by its difference
from the prediction of the times before it. The differences become integers ≥ 0, small where the differences
are small. Their bytes are written in planes: all lowest bytes, then all second ones, …. Smooth motion then
leaves high bytes of mostly zeros, which deflate well. ``js/data.js`` decodes it.
"""

from __future__ import annotations

import base64
import math
import zlib
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.view.bodies import Bodies, Quantity

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

POSITION_BITS = 24
"""Positions have an error of at most half of 2⁻²⁴ of the longest side of the scene."""
SHAPE_STEP = 2.0**-11
"""Components of F have an error of at most half of this, unless one of them is larger than 16."""
VALUE_BITS = 16
"""Values have an error of about half of 2⁻¹⁶ of the range of their array."""

_MOST_ORDER = 2
_SHORT = 2**15 - 1


class Column(NamedTuple):
    """Packed array of integers, or of numbers ``low + step * integer``."""

    shape: tuple[int, ...]
    order: int
    """0: the numbers; 1: their change from one time to the next; 2: the change of the change."""
    bytes: int
    """Bytes per number, 1 to 4."""
    data: str
    """Base64 of the deflated bytes."""
    low: list[float] | None = None
    """One for each component, or one for all; None for integers."""
    step: list[float] | None = None


def pack(whole: NDArray[Any], low: list[float] | None = None, step: list[float] | None = None) -> Column:
    """Pack integers below 2³⁰ in size, of any shape, with the prediction that leaves the smallest numbers."""
    order, differences = min(
        ((k, _differences(whole.astype(np.int64), k)) for k in range(_MOST_ORDER + 1)),
        key=lambda pair: float(np.log2(1.0 + np.abs(pair[1])).sum()),
    )
    # Zigzag: 0, −1, 1, −2, … → 0, 1, 2, 3, ….
    small = np.where(differences < 0, -2 * differences - 1, 2 * differences).astype(np.uint32)
    # Numbers of consecutive times become neighbours.
    small = np.ascontiguousarray(small.reshape(len(whole), math.prod(whole.shape[1:])).T)
    n_bytes = max(1, (int(small.max(initial=0)).bit_length() + 7) // 8)
    planes = b"".join((small >> (8 * k)).astype(np.uint8).tobytes() for k in range(n_bytes))
    data = base64.b64encode(zlib.compress(planes, 9)).decode("ascii")
    return Column(whole.shape, order, n_bytes, data, low, step)


def _differences(whole: Integers, order: int) -> Integers:
    for _ in range(min(order, len(whole))):
        whole = np.diff(whole, axis=0, prepend=np.zeros_like(whole[:1]))
    return whole


class Grid(NamedTuple):
    """Grid to which positions are rounded: ``low + step * (i, j, k)``."""

    low: Floats
    """(3,), m."""
    step: float
    """m."""


def grid_of(*points: Floats) -> Grid:
    """Return the grid of 2²⁴ steps along the longest side of the box around points, each (…, 3)."""
    low, high = bounds(*points)
    # A single point needs any positive step.
    return Grid(low, (float((high - low).max()) or 1.0) / (2**POSITION_BITS - 1))


def bounds(*points: Floats) -> tuple[Floats, Floats]:
    """Return the lowest and the highest corner of the box around points, each (…, 3)."""
    everything = np.concatenate([p.reshape(-1, 3) for p in points])
    if len(everything) == 0:
        return np.zeros(3), np.zeros(3)
    return everything.min(axis=0), everything.max(axis=0)


def pack_points(points: Floats, grid: Grid) -> Column:
    """Pack positions (…, 3); the first axis may be the time."""
    return pack(np.rint((points - grid.low) / grid.step), grid.low.tolist(), [grid.step])


def pack_shapes(bodies: Bodies) -> Column:
    """Pack F, (m, n, 9), row after row."""
    step = max(SHAPE_STEP, float(np.abs(bodies.F).max(initial=0.0)) / _SHORT)
    m, n = bodies.present.shape
    return pack(np.rint(bodies.F.reshape(m, n, 9) / step), [0.0], [step])


def pack_field(field: Quantity) -> Column:
    """Pack the values of an array: 0 for NaN, 1 to 2¹⁶ − 1 for the range."""
    values = field.values.astype(np.float64)
    known = np.isfinite(values)
    whole = np.zeros(values.shape, dtype=np.int64)
    low, step = [], []
    for k in range(values.shape[2]):
        own = values[:, :, k][known[:, :, k]]
        least, most = (float(own.min()), float(own.max())) if own.size else (0.0, 0.0)
        size = (most - least) / (2**VALUE_BITS - 2)
        if not size > 0.0:
            # A single value is stored without an error.
            size = abs(least) * 2.0**-POSITION_BITS or 1.0
        whole[:, :, k][known[:, :, k]] = 1 + np.rint((own - least) / size).astype(np.int64)
        low.append(least - size)
        step.append(size)
    return pack(whole, low, step)


def pack_values(values: Floats) -> Column:
    """Pack finite values (v,), to half of 2⁻²⁴ of their range."""
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
    step = (high - low) / (2**POSITION_BITS - 1) or 1.0
    return pack(np.rint((values - low) / step), [low], [step])


def pack_bits(mask: NDArray[np.bool_]) -> Column:
    """Pack Booleans (m, n), eight to a byte, the first in the lowest bit."""
    return pack(np.packbits(mask, axis=1, bitorder="little"))
