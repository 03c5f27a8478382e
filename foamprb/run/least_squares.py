"""Least squares of many small problems at once: Gauss–Newton steps in logarithms of the unknowns."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Predict: TypeAlias = Callable[[NDArray[np.int64], Floats, bool], tuple[Floats, NDArray[np.bool_]]]

_MOST_STEPS = 25
_DIFFERENCE = 0.02
"""Change of a logarithm for a derivative."""
_LONGEST, _SMALL = 1.5, 2e-3
"""Longest step of a logarithm, and largest last one."""
_GAIN = 1e-4
"""Largest decrease of the sum of squares by a last step."""
_DAMPING = 0.1
"""Added to the squares of sensitivities in standard errors: an unknown without influence does not move."""
_RANGE = math.log(1e4)
"""Farthest from the start that a logarithm may be."""
_FAR = 0.2
"""Logarithm of measured over predicted value beyond which the residual is that of logarithms."""


class Solution(NamedTuple):
    """Solutions of n problems with q unknowns and k values each."""

    theta: Floats
    """Unknowns, (n, q)."""
    predicted: Floats
    """Predicted values there, (n, k)."""
    spread: Floats
    """Standard errors of the unknowns, (n, q), by the errors of the values."""
    valid: NDArray[np.bool_]
    """Whether there is a prediction, (n,)."""
    converged: NDArray[np.bool_]
    """Whether no step improves it, (n,)."""


def gauss_newton(
    predict: Predict, values: Floats, errors: Floats, start: Floats, positive: NDArray[np.bool_]
) -> Solution:
    """Solve n problems of q unknown logarithms each.

    A step that leaves the valid range or increases the sum of squares is halved. Far from the solution, the
    residuals of ``positive`` values are those of their logarithms.

    Parameters
    ----------
    predict
        Returns predictions, (m, k), and their validity, (m,), of some problems (m,) at unknowns (m, q); the
        last argument is True at an estimate, False for derivatives.
    values, errors
        Measured values and their standard errors, (n, k); NaN for a value that is missing.
    start
        Unknowns at the start, (n, q).
    positive
        Which values are above 0, (k,).
    """
    (n, q), k = start.shape, values.shape[1]
    s = Solution(
        start.copy(), np.full((n, k), np.nan), np.full((n, q), np.nan), np.zeros(n, bool), np.zeros(n, bool)
    )
    theta, last = start.copy(), np.zeros((n, q))
    low, high = start - _RANGE, start + _RANGE
    cost, going = np.full(n, np.inf), np.ones(n, dtype=bool)
    for _ in range(_MOST_STEPS):
        rows = np.flatnonzero(going)
        if not len(rows):
            break
        y, well = predict(rows, theta[rows], True)
        ranked = _residuals(values[rows], y, errors[rows], positive, weighted_by=values[rows])
        now = np.where(well, (ranked**2).sum(axis=1), np.inf)
        better = now <= cost[rows] * (1.0 + 1e-6) + 1e-9
        better &= well
        _turn_back(rows[~better], s, theta, last, going, high)
        rows, y = rows[better], y[better]
        if not len(rows):
            continue
        s.theta[rows], s.predicted[rows], s.valid[rows], cost[rows] = theta[rows], y, True, now[better]
        shifted = (theta[rows][:, None] + _DIFFERENCE * np.eye(q)).reshape(-1, q)
        moved, fine = predict(np.repeat(rows, q), shifted, False)
        slopes = (moved.reshape(-1, q, k) - y[:, None]) / _DIFFERENCE
        J = np.nan_to_num(np.where(fine.reshape(-1, q, 1), slopes, 0.0)).transpose(0, 2, 1)
        Jw = J * np.where(np.isfinite(values[rows]), 1.0 / errors[rows], 0.0)[:, :, None]
        normal = np.einsum("nki,nkj->nij", Jw, Jw)
        slope = np.einsum("nki,nk->ni", Jw, _residuals(values[rows], y, errors[rows], positive))
        step = np.linalg.solve(normal + _DAMPING * np.eye(q), slope[:, :, None])[:, :, 0]
        step *= np.minimum(1.0, _LONGEST / np.maximum(np.abs(step).max(axis=1, keepdims=True), 1e-300))
        s.spread[rows] = _spread(normal)
        aim = np.clip(theta[rows] + step, low[rows], high[rows])
        step = aim - theta[rows]
        theta[rows], last[rows] = aim, step
        ends = (np.abs(step).max(axis=1) < _SMALL) | ((slope * step).sum(axis=1) < _GAIN)
        ended = rows[ends]
        s.theta[ended] = theta[ended]
        s.predicted[ended] += np.einsum("nki,ni->nk", J[ends], step[ends])
        going[ended], s.converged[ended] = False, True
    return s


def _turn_back(
    rows: NDArray[np.int64],
    s: Solution,
    theta: Floats,
    last: Floats,
    going: NDArray[np.bool_],
    high: Floats,
) -> None:
    """Halve the last steps of some problems; without any estimate so far, raise the first unknown."""
    first = ~s.valid[rows]
    theta[rows[first], 0] += math.log(4.0)
    going[rows[first]] = theta[rows[first], 0] <= high[rows[first], 0]
    others = rows[~first]
    last[others] *= 0.5
    theta[others] = s.theta[others] + last[others]
    ended = others[np.abs(last[others]).max(axis=1, initial=0.0) < _SMALL]
    going[ended], s.converged[ended] = False, True


def _spread(normal: Floats) -> Floats:
    """Return the standard errors of the unknowns, (n, q), infinite where the values do not depend on them."""
    diagonal = np.diagonal(normal, axis1=1, axis2=2)
    # Scaled, so that units do not matter for the inverse.
    unit = np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    scaled = normal / (unit[:, :, None] * unit[:, None, :]) + 1e-14 * np.eye(normal.shape[1])
    inverse = np.linalg.inv(scaled + np.eye(normal.shape[1]) * (diagonal <= 0.0)[:, :, None])
    spread = np.sqrt(np.maximum(np.diagonal(inverse, axis1=1, axis2=2), 0.0)) / unit
    return np.asarray(np.where(diagonal > 0.0, spread, np.inf))


def _residuals(
    values: Floats, y: Floats, errors: Floats, positive: NDArray[np.bool_], weighted_by: Floats | None = None
) -> Floats:
    """Return residuals in standard errors, (n, k), 0 for missing values.

    Those of logarithms are used for values that are far away; or for all, with the errors ``weighted_by`` the
    same values for each prediction, by which predictions are ranked.
    """
    plain = (values - y) / errors
    with np.errstate(divide="ignore", invalid="ignore"):
        logarithm = np.log(values / y)
        by_logarithm = positive & (values > 0.0) & (y > 0.0)
        if weighted_by is None:
            by_logarithm &= np.abs(logarithm) > _FAR
        scaled = logarithm * (y if weighted_by is None else weighted_by) / errors
    return np.nan_to_num(np.where(by_logarithm, scaled, plain))
