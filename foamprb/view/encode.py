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
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.view.bodies import Bodies, Quantity

Floats = NDArray[np.float64]
Integers = NDArray[np.int32 | np.int64]

POSITION_BITS = 24
"""Positions have an error of at most half of 2⁻²⁴ of the longest side of the scene."""
SHAPE_STEP = 2.0**-11
"""Components of F have an error of at most half of this, unless one of them is larger than 16."""
MANTISSA_BITS = 14
"""Values have a relative error of at most half of 2⁻¹⁴, which leaves four digits."""
OCTAVES = 24
"""Values below 2⁻²⁴ of the largest of their array become 0."""

_MOST_ORDER = 2
_SHORT = 2**15 - 1
_AT_ONCE = 1 << 16
"""Bodies or components whose numbers are in memory together."""


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
    """One for each component, or one for all; None for integers. Of values: the smallest above 0."""
    step: list[float] | None = None


def pack(integers: NDArray[Any], low: list[float] | None = None, step: list[float] | None = None) -> Column:
    """Pack integers below 2³⁰ in size, of any shape, with the prediction that leaves the smallest numbers."""
    table = integers.reshape(len(integers), math.prod(integers.shape[1:]))
    orders = range(_MOST_ORDER + 1)
    sizes = np.array([[_size(differences) for differences in map(part, orders)] for part in _parts(table)])
    bits, largest = sizes.reshape(-1, len(orders), 2).transpose(2, 1, 0)
    order = int(np.argmin(bits.sum(axis=1)))
    n_bytes = max(1, (int(largest[order].max(initial=0)).bit_length() + 7) // 8)
    planes = np.empty((n_bytes, table.size), dtype=np.uint8)
    done = 0
    for part in _parts(table):
        # Zigzag: 0, −1, 1, −2, … → 0, 1, 2, 3, …; numbers of consecutive times become neighbours.
        small = _folded(part(order)).astype(np.uint32).T.ravel()
        for k in range(n_bytes):
            planes[k, done : done + len(small)] = (small >> (8 * k)).astype(np.uint8)
        done += len(small)
    # For such noise this strategy is as dense as the highest level, and six times as fast.
    deflate = zlib.compressobj(6, strategy=zlib.Z_FILTERED)
    data = base64.b64encode(deflate.compress(planes.data) + deflate.flush()).decode("ascii")
    return Column(integers.shape, order, n_bytes, data, low, step)


def _parts(table: NDArray[Any]) -> Iterator[Callable[[int], Integers]]:
    """Yield functions of an order that return the differences of some columns."""
    for start in range(0, table.shape[1], _AT_ONCE):
        columns = table[:, start : start + _AT_ONCE]
        # Differences of order two are up to four times as large.
        dtype = np.int32 if np.abs(columns).max(initial=0) < 2**28 else np.int64
        yield partial(_differences, columns.astype(dtype))


def _size(differences: Integers) -> tuple[float, int]:
    """Return about the number of bits that differences need, and the largest folded one."""
    bits = np.log2(1.0 + np.abs(differences)).sum()
    return float(bits), int(_folded(differences).max(initial=0))


def _folded(differences: Integers) -> Integers:
    """Return integers ≥ 0 from differences: 0, −1, 1, −2, … → 0, 1, 2, 3, …."""
    return np.where(differences < 0, -2 * differences - 1, 2 * differences)


def _differences(integers: Integers, order: int) -> Integers:
    for _ in range(min(order, len(integers))):
        integers = np.diff(integers, axis=0, prepend=np.zeros_like(integers[:1]))
    return integers


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


def pack_modes(B: NDArray[Any]) -> Column:
    """Pack quadratic modes, (m, n, 7), with the error of F."""
    step = max(SHAPE_STEP, float(np.abs(B).max(initial=0.0)) / _SHORT)
    return pack(np.rint(B / step), [0.0], [step])


def pack_field(field: Quantity) -> Column:
    """Pack the values of an array to a relative error, so that small values keep their digits.

    An integer w is 0 for NaN. With k = w − 2 − 2¹⁴·``OCTAVES`` and ``low`` = l the value is 0 for k = 0,
    else sign(k) 2ᵉ (1 + f) l, where |k| − 1 = 2¹⁴ (e + f) and 0 ≤ f < 1.
    """
    finite = np.isfinite(field.values)
    most = float(np.abs(field.values).max(initial=0.0, where=finite))
    low = 2.0 ** (math.floor(math.log2(max(most, 1e-300))) - OCTAVES + 1)
    components = field.values.shape[2]
    integers = np.zeros(field.values.shape, dtype=np.int32)
    for k in range(components):
        values = np.where(finite[:, :, k], field.values[:, :, k], 0.0).astype(np.float64)
        mantissa, exponent = np.frexp(np.abs(values) / low)
        steps = 1 + np.rint((exponent - 1 + 2.0 * mantissa - 1.0) * 2**MANTISSA_BITS)
        codes = np.where(np.abs(values) < low, 0.0, np.copysign(steps, values))
        integers[:, :, k] = np.where(finite[:, :, k], codes + 2 + OCTAVES * 2**MANTISSA_BITS, 0.0)
    return pack(integers, [low] * components)


def pack_values(values: Floats) -> Column:
    """Pack finite values (v,), to half of 2⁻²⁴ of their range."""
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
    step = (high - low) / (2**POSITION_BITS - 1) or 1.0
    return pack(np.rint((values - low) / step), [low], [step])


def pack_bits(mask: NDArray[np.bool_]) -> Column:
    """Pack Booleans (m, n), eight to a byte, the first in the lowest bit."""
    return pack(np.packbits(mask, axis=1, bitorder="little"))
