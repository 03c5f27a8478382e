"""Numbers as text for a page: quantised, predicted from the time before, deflated, base64.

A *column* is an array of whole numbers with the time as its first axis. Each number is replaced by its
difference from what the times before it predict, the differences by whole numbers ≥ 0 that are small where
they are, and these byte by byte: all lowest bytes, then all second ones, …. What moves smoothly in time then
has high bytes of mostly zeros, and deflates well. ``js/data.js`` undoes it.
"""

from __future__ import annotations

import base64
import math
import zlib
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.view.bodies import Bodies, Field

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

POSITION_BITS = 24
"""A position is known to half of 2⁻²⁴ of the longest side of what is shown."""
SHAPE_STEP = 2.0**-11
"""A component of F is known to half of that, unless one of them is larger than 16."""
VALUE_BITS = 16
"""A value is known to about half of 2⁻¹⁶ of the range of its array."""

_MOST_ORDER = 2
_SHORT = 2**15 - 1


class Column(NamedTuple):
    """How an array of whole numbers was packed; with ``data`` all that is needed to have it back."""

    shape: tuple[int, ...]
    order: int
    """0: the numbers; 1: their change from one time to the next; 2: the change of the change."""
    bytes: int
    """Bytes per number, 1 to 4."""
    data: str
    """Base64 of the deflated bytes."""


class Packed(NamedTuple):
    """Numbers ``low + step * whole``, of which the whole ones are packed."""

    column: Column
    low: list[float]
    """Of each component, or one for all."""
    step: list[float]


def pack(whole: NDArray[Any]) -> Column:
    """Pack whole numbers, below 2³⁰ in size, with the prediction that leaves the least.

    Parameters
    ----------
    whole
        Of any shape, the time first.
    """
    order, differences = min(
        ((k, _differences(whole.astype(np.int64), k)) for k in range(_MOST_ORDER + 1)),
        key=lambda pair: float(np.log2(1.0 + np.abs(pair[1])).sum()),
    )
    # Zigzag: 0, −1, 1, −2, … → 0, 1, 2, 3, ….
    small = np.where(differences < 0, -2 * differences - 1, 2 * differences).astype(np.uint32)
    # What follows in time lies side by side.
    small = np.ascontiguousarray(small.reshape(len(whole), math.prod(whole.shape[1:])).T)
    n_bytes = max(1, (int(small.max(initial=0)).bit_length() + 7) // 8)
    planes = [(small >> (8 * k)).astype(np.uint8).tobytes() for k in range(n_bytes)]
    return Column(whole.shape, order, n_bytes, deflated(b"".join(planes)))


def deflated(data: bytes) -> str:
    """Base64 of zlib's compression."""
    return base64.b64encode(zlib.compress(data, 9)).decode("ascii")


def _differences(whole: Whole, order: int) -> Whole:
    for _ in range(min(order, len(whole))):
        whole = np.diff(whole, axis=0, prepend=np.zeros_like(whole[:1]))
    return whole


class Grid(NamedTuple):
    """The grid to which positions are rounded: ``low + step * (i, j, k)``."""

    low: Floats
    """(3,), m."""
    step: float
    """m."""

    def __call__(self, points: Floats) -> Whole:
        """Nearest grid points, of the same shape."""
        return np.rint((points - self.low) / self.step).astype(np.int64)


def grid_of(*points: Floats) -> Grid:
    """The grid of 2²⁴ steps along the longest side of the box around points, each (…, 3)."""
    corners = [p.reshape(-1, 3) for p in points if p.size]
    if not corners:
        return Grid(np.zeros(3), 1.0)
    low = np.min([p.min(axis=0) for p in corners], axis=0)
    side = float((np.max([p.max(axis=0) for p in corners], axis=0) - low).max())
    # Any, where all points are one.
    return Grid(low, (side if side > 0.0 else 1.0) / (2**POSITION_BITS - 1))


def pack_points(points: Floats, grid: Grid) -> Packed:
    """Pack positions (…, 3), of which the first axis may be the time."""
    return Packed(pack(grid(points)), grid.low.tolist(), [grid.step])


def pack_shapes(bodies: Bodies) -> Packed:
    """Pack F, (m, n, 9), row after row."""
    largest = float(np.abs(bodies.F).max(initial=0.0))
    step = max(SHAPE_STEP, largest / _SHORT)
    m, n = bodies.present.shape
    return Packed(pack(np.rint(bodies.F.reshape(m, n, 9) / step)), [0.0], [step])


def pack_field(field: Field) -> Packed:
    """Pack the values of an array: 0 is NaN, the range goes from 1 to 2¹⁶ − 1."""
    values = field.values.astype(np.float64)
    known = np.isfinite(values)
    whole = np.zeros(values.shape, dtype=np.int64)
    low, step = [], []
    for k in range(values.shape[2]):
        own = values[:, :, k][known[:, :, k]]
        least, most = (float(own.min()), float(own.max())) if own.size else (0.0, 0.0)
        size = (most - least) / (2**VALUE_BITS - 2)
        if not size > 0.0:
            # One value only, which is known as it is.
            size = abs(least) * 2.0**-POSITION_BITS or 1.0
        whole[:, :, k][known[:, :, k]] = 1 + np.rint((own - least) / size).astype(np.int64)
        low.append(least - size)
        step.append(size)
    return Packed(pack(whole), low, step)


def pack_values(values: Floats) -> Packed:
    """Pack values (v,) that are all known, to half of 2⁻²⁴ of their range."""
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
    step = (high - low) / (2**POSITION_BITS - 1) or 1.0
    return Packed(pack(np.rint((values - low) / step)), [low], [step])


def pack_bits(mask: NDArray[np.bool_]) -> Column:
    """Pack truth values (m, n), eight to a byte, the first in the lowest bit."""
    return pack(np.packbits(mask, axis=1, bitorder="little"))
