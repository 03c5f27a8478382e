"""Random tensors and shapes for property tests."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

components = st.floats(-2.0, 2.0, allow_nan=False, width=64)
tensors = arrays(float, 9, elements=components).map(lambda a: tuple(map(float, a)))
rotations = st.integers(0, 2**32 - 1).map(
    lambda seed: Rotation.from_quat(np.random.default_rng(seed).normal(size=4)).as_matrix()
)
stretches = st.tuples(*[st.floats(-1.5, 1.5).map(lambda e: 10.0**e)] * 3)
mild_stretches = st.tuples(*[st.floats(0.6, 1.6)] * 3)


def flat(matrix: np.ndarray) -> tuple[float, ...]:
    return tuple(float(value) for value in np.ravel(matrix))


def square(tensor: tuple) -> np.ndarray:
    return np.reshape(np.asarray(tensor, dtype=float), (3, 3))
