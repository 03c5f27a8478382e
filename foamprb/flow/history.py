"""Flow of a given history of velocity gradients, one for each body; the bodies stay where they are."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from foamprb.body.tensor import Tensor, Vector, add, add_scaled, ddot, scale, subtract
from foamprb.compile.link import Function
from foamprb.errors import InputError
from foamprb.flow.analytic import AnalyticFlow, gap_free
from foamprb.flow.base import Floats, Ints


class HistoryArrays(NamedTuple):
    """Gradients (bodies, times, 9), 1/s, at equal distances of time."""

    start: float
    rate: float
    """Times per second."""
    gradients: Floats


def _at(g: Floats, host: int, k: int) -> Tensor:
    """Return the gradient of the body ``host`` at time k, 1/s."""
    return (
        g[host, k, 0], g[host, k, 1], g[host, k, 2], g[host, k, 3], g[host, k, 4],
        g[host, k, 5], g[host, k, 6], g[host, k, 7], g[host, k, 8],
    )  # fmt: skip


def sample_history(flow: HistoryArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:  # noqa: ARG001
    """Return no velocity, and the gradient at t of the body ``host``, linear between two times."""
    g, s = flow.gradients, (t - flow.start) * flow.rate
    k, zero = min(max(int(s), 0), g.shape[1] - 2), (0.0, 0.0, 0.0)
    l = add(scale(1.0 - (s - k), _at(g, host, k)), scale(s - k, _at(g, host, k + 1)))
    return zero, l, zero


_ROUND_OFF = 1e-6
"""Of times, in their distances."""
_BEND, _LEAST_BEND = 1.0 / 16.0, 1e-10
"""Largest part of the gradient quadratic in time over the linear one, in a step that spans several times, and
over the mean.

Errors of steps of order 2, which use the linear one alone, thus stay below twice their tolerance.
"""


def parabola_of_history(
    flow: HistoryArrays, host: int, t0: float, t1: float
) -> tuple[float, float, Tensor, Tensor, Tensor]:
    """Return the least-squares parabola through the gradients of the body ``host`` in a step.

    Parabola and gradient have the same integrals against 1, t and t². A step over which the gradient bends
    too much ends earlier, at a time of the history. For the values see
    :func:`foamprb.flow.kernels.parabola`.
    """
    a, b, most = (t0 - flow.start) * flow.rate, (t1 - flow.start) * flow.rate, math.inf
    first = int(a + _ROUND_OFF)
    mean, slope, bend = _moments(flow.gradients, host, a, b)
    excess = _bending(mean, slope, bend)
    while b > first + 1 + _ROUND_OFF and excess > 1.0:
        b = max(first + 1.0, np.floor(a + max(0.25, 0.9 / excess) * (b - a)))
        t1 = flow.start + b / flow.rate
        most = max(t1 - t0, 1.0 / flow.rate)
        mean, slope, bend = _moments(flow.gradients, host, a, b)
        excess = _bending(mean, slope, bend)
    ends = add(mean, bend)
    return t1, most, subtract(ends, slope), add_scaled(mean, -0.5, bend), add(ends, slope)


def _bending(mean: Tensor, slope: Tensor, bend: Tensor) -> float:
    """Return how much the gradient bends, over the limit and beyond round-off."""
    least = _LEAST_BEND**2 * ddot(mean, mean) + 1e-300
    return float(np.sqrt(ddot(bend, bend) / (_BEND**2 * ddot(slope, slope) + least)))


def _moments(g: Floats, host: int, a: float, b: float) -> tuple[Tensor, Tensor, Tensor]:
    """Return the coefficients of Legendre's polynomials 1, 2s − 1, 6s² − 6s + 1, s from 0 to 1 in [a, b]."""
    zero = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    mean, slope, bend = zero, zero, zero
    most, per_step, before = g.shape[1] - 2, 1.0 / (b - a), (0.0, 0.0, 0.0)
    first, last = min(max(int(a + _ROUND_OFF), 0), most), min(max(math.ceil(b - _ROUND_OFF) - 1, 0), most)
    for k in range(first, last + 2):
        here, after = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        if k <= last:
            low, high = a if k == first else float(k), b if k == last else k + 1.0
            f, d, change = 0.5 * (low + high) - k, (high - low) * per_step, high - low
            odd = 2.0 * (f + k - a) * per_step - 1.0
            even, rise = 1.5 * odd * odd - 0.5 + 0.5 * d * d, 0.5 * d * d * change
            # Weights of the two times between which the gradient is linear.
            p, q = d * (1.0 - f), d * f
            here = (p, 3.0 * odd * p - rise, 5.0 * (even * p - odd * rise))
            after = (q, 3.0 * odd * q + rise, 5.0 * (even * q + odd * rise))
        l = _at(g, host, k)
        mean = add_scaled(mean, before[0] + here[0], l)
        slope = add_scaled(slope, before[1] + here[1], l)
        bend = add_scaled(bend, before[2] + here[2], l)
        before = after
    return mean, slope, bend


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
    kernels: dict[str, Function] = {"sample": sample_history, "gap": gap_free}
    kernels["parabola"] = parabola_of_history
    return HistoryFlow(arrays, kernels)
