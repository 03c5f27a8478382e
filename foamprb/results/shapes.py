"""Arrays of a cloud that follow from its ``glyph``, ``d`` and ``status``, and that files need not contain."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

SOURCES = ("glyph", "d", "status")
"""The arrays that :func:`derived` needs."""
DERIVED = {
    "active": ("", 1),
    "deformationGradient": ("1", 9),
    "semiAxes": ("m", 3),
    "orientation": ("1", 4),
    "taylorDeformation": ("1", 1),
    "J": ("1", 1),
}
"""Units and numbers of components. ``deformationGradient`` is that of spheres at rest; the files of other
bodies contain it."""


# ParaView executes the text of this function, so it uses numpy only.
def derived(
    glyph: NDArray[Any], d: NDArray[Any], status: NDArray[Any], names: Collection[str]
) -> dict[str, NDArray[Any]]:
    """Return some of the arrays that follow from the shapes of n bodies; NaN for a shape that is not finite.

    Parameters
    ----------
    glyph
        Columns of R F, one after the other, (n, 9), m.
    d
        Diameters at rest, (n,), m.
    status
        Statuses, (n,).
    names
        Names of the arrays.
    """
    radius = 0.5 * d[:, None, None].astype(np.float64)
    with np.errstate(all="ignore"):
        F = glyph.reshape(-1, 3, 3).astype(np.float64).swapaxes(1, 2) / radius
    lost = ~np.isfinite(F).all(axis=(1, 2))
    F[lost] = np.eye(3)
    values = {"active": (status == 1).astype(np.int8)}
    if "deformationGradient" in names:
        values["deformationGradient"] = F.reshape(-1, 9)
    if "J" in names:
        values["J"] = np.linalg.det(F)
    squares = axes = None
    if {"semiAxes", "orientation", "taylorDeformation"}.isdisjoint(names):
        pass
    elif "orientation" in names or glyph.dtype != np.float32:
        squares, axes = np.linalg.eigh(F @ F.swapaxes(1, 2))
    else:
        # Closed form of the eigenvalues; where two are equal, its error is below that of single precision.
        x, y, z = F[:, 0], F[:, 1], F[:, 2]
        pairs = ((x, x), (y, y), (z, z), (x, y), (x, z), (y, z))
        xx, yy, zz, xy, xz, yz = (np.einsum("ni,ni->n", one, other) for one, other in pairs)
        mean = (xx + yy + zz) / 3.0
        xx, yy, zz = xx - mean, yy - mean, zz - mean
        spread = np.sqrt((xx * xx + yy * yy + zz * zz) / 6.0 + (xy * xy + xz * xz + yz * yz) / 3.0)
        third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
        angle = np.arccos(np.clip(third / np.maximum(2.0 * spread**3, 1e-300), -1.0, 1.0)) / 3.0
        least, most = (mean + 2.0 * spread * np.cos(angle + turn) for turn in (2.0 * np.pi / 3.0, 0.0))
        squares = np.stack([least, 3.0 * mean - least - most, most], axis=1)
    if squares is not None:
        a, b, c = np.sqrt(np.maximum(squares[:, ::-1], 0.0)).T
        values["semiAxes"] = np.stack([a, b, c], axis=1) * radius[:, 0]
        values["taylorDeformation"] = (a - c) / (a + c)
    if axes is not None:
        # The rows of the frame are the axes, the longest first. The third makes it right-handed.
        Q = axes[:, :, ::-1].swapaxes(1, 2)
        Q[:, 2] = np.cross(Q[:, 0], Q[:, 1])
        xx, yy, zz = (Q[:, k, k] for k in range(3))
        x, y, z = Q[:, 1, 2] - Q[:, 2, 1], Q[:, 2, 0] - Q[:, 0, 2], Q[:, 0, 1] - Q[:, 1, 0]
        xy, xz, yz = Q[:, 0, 1] + Q[:, 1, 0], Q[:, 0, 2] + Q[:, 2, 0], Q[:, 1, 2] + Q[:, 2, 1]
        # Each row is a multiple of the quaternion; the row with the largest diagonal is the most accurate.
        multiples = np.array(
            [
                [1 + xx + yy + zz, x, y, z],
                [x, 1 + xx - yy - zz, xy, xz],
                [y, xy, 1 - xx + yy - zz, yz],
                [z, xz, yz, 1 - xx - yy + zz],
            ]
        )
        best = np.argmax(np.einsum("iin->in", multiples), axis=0)
        quaternion = multiples[best, :, np.arange(len(F))]
        length = np.copysign(np.linalg.norm(quaternion, axis=1), quaternion[:, 0])
        values["orientation"] = quaternion / length[:, None]
    for name, array in values.items():
        if name != "active":
            array[lost] = np.nan
    return {name: values[name] for name in names}
