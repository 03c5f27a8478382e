"""Surfaces of bodies with a quadratic mode."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body.quadratic import layers

MODE = "quadraticShape"
"""The array of the mode B in the files of a run that has it, (n, 7)."""


# ParaView executes the text of these functions.
def unfolded(F: NDArray[Any], B: NDArray[Any]) -> NDArray[Any]:
    """Return modes B, (n, 7), so reduced that the surfaces x = F X + B XX of n bodies do not fold.

    The amplitude of a bullet is at most 0.4 of the smallest stretch of F, (n, 3, 3). A mode that is not
    finite becomes 0.
    """
    B = np.where(np.isfinite(B).all(axis=1)[:, None], B, 0.0).astype(np.float64)
    amplitude = np.sqrt(0.4 * np.sum(np.array(layers(tuple(B.T))) ** 2, axis=(0, 1)))
    smallest = np.linalg.svd(F, compute_uv=False)[:, 2]
    return np.asarray(B * np.minimum(1.0, 0.4 * smallest / np.maximum(amplitude, 1e-300))[:, None])


def bulges(F: NDArray[Any], B: NDArray[Any]) -> NDArray[Any]:
    """Return K of the surfaces x = F X + K XX of n bodies, |X| = 1, (n, 3, 3, 3), in radii.

    The axes of B, (n, 7), are those of space. X is a point of the material, which F, (n, 3, 3), has turned by
    its rotation Q: K_iJK = B_ijk Q_jJ Q_kK.
    """
    U, _, V = np.linalg.svd(F)
    Q = (U @ V)[:, None]
    K: NDArray[Any] = np.moveaxis(np.array(layers(tuple(B.T))), 2, 0).reshape(-1, 3, 3, 3)
    return np.asarray(Q.swapaxes(2, 3) @ K @ Q)
