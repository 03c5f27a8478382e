"""Flow of a given history of velocity gradients, one for each body; the bodies stay where they are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from foamprb.body.tensor import Tensor, Vector
from foamprb.errors import InputError
from foamprb.flow.analytic import AnalyticFlow, gap_free
from foamprb.flow.base import Floats, Ints


class HistoryArrays(NamedTuple):
    """Gradients (bodies, times, 9), 1/s, at equal distances of time."""

    start: float
    rate: float
    """Times per second."""
    gradients: Floats


def sample_history(flow: HistoryArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:  # noqa: ARG001
    """Return no velocity, and the gradient at t of the body ``host``, linear between two times."""
    g, s = flow.gradients, (t - flow.start) * flow.rate
    k = min(max(int(s), 0), g.shape[1] - 2)
    f, zero = s - k, (0.0, 0.0, 0.0)
    e = 1.0 - f
    l = (
        e * g[host, k, 0] + f * g[host, k + 1, 0],
        e * g[host, k, 1] + f * g[host, k + 1, 1],
        e * g[host, k, 2] + f * g[host, k + 1, 2],
        e * g[host, k, 3] + f * g[host, k + 1, 3],
        e * g[host, k, 4] + f * g[host, k + 1, 4],
        e * g[host, k, 5] + f * g[host, k + 1, 5],
        e * g[host, k, 6] + f * g[host, k + 1, 6],
        e * g[host, k, 7] + f * g[host, k + 1, 7],
        e * g[host, k, 8] + f * g[host, k + 1, 8],
    )
    return zero, l, zero


class HistoryFlow(AnalyticFlow):
    """Velocity gradients that each body feels, at times of equal distance; :func:`history`."""

    _parameters: HistoryArrays

    def locate(self, points: Floats, t: ArrayLike | None = None) -> Ints:  # noqa: ARG002
        """Return the numbers of the points: point k has the history k."""
        return np.arange(len(points), dtype=np.int32)

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Return no velocity, (n, 3), and the gradients (n, 3, 3), 1/s, of the bodies at t, s."""
        g = self._parameters.gradients
        s = np.clip((t - self._parameters.start) * self._parameters.rate, 0.0, g.shape[1] - 1.0)
        k = min(int(s), g.shape[1] - 2)
        l = (1.0 - (s - k)) * g[hosts, k] + (s - k) * g[hosts, k + 1]
        return np.zeros((len(points), 3)), l.reshape(-1, 3, 3)


def history(times: ArrayLike, gradients: ArrayLike) -> HistoryFlow:
    """Return the flow in which body k feels the gradients ``gradients[k]``.

    Parameters
    ----------
    times
        (m,), s, m of at least 2, at equal distances.
    gradients
        (n, m, 3, 3), ∂u_i/∂x_j of each body at these times, 1/s. Between them they are linear.

    Raises
    ------
    InputError
        If the times do not grow by the same step, or the gradients are not finite or of another shape.
    """
    t = np.asarray(times, dtype=float)
    g = np.ascontiguousarray(gradients, dtype=float)
    if t.ndim != 1 or len(t) < 2:
        raise InputError(f"times have the shape {t.shape}. Allowed: (m,) with m of at least 2.")
    if g.shape[1:] != (len(t), 3, 3):
        raise InputError(f"gradients have the shape {g.shape}. Allowed: (bodies, {len(t)}, 3, 3).")
    step = (t[-1] - t[0]) / (len(t) - 1)
    off = np.abs(t - (t[0] + step * np.arange(len(t)))).max()
    if not (step > 0.0 and off <= 1e-3 * step):
        raise InputError(
            f"times differ by up to {off:.3g} s from steps of {step:.3g} s. Allowed: equal steps."
        )
    if not np.isfinite(g).all():
        raise InputError(f"gradients: {np.count_nonzero(~np.isfinite(g))} numbers are not finite.")
    arrays = HistoryArrays(float(t[0]), 1.0 / step, g.reshape(len(g), len(t), 9))
    kernels: dict[str, Callable[..., Any]] = {"sample": sample_history, "gap": gap_free}
    return HistoryFlow(arrays, kernels)
