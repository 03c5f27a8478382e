"""Least squares of many small problems at once: Gauss–Newton steps of logarithms, or of values from 0 on."""

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
"""Change of an unknown for a derivative, in its unit: 1 for a logarithm, max(θ, 1) for a value."""
_LONGEST, _SMALL = 1.5, 2e-3
"""Longest step, and largest last one, in units."""
_GAIN = 1e-4
"""Largest decrease of the sum of squares by a last step."""
_DAMPING = 0.1
"""Added to the squares of sensitivities in standard errors: an unknown without influence does not move."""
WIDEST = _DAMPING**-0.5
"""Standard error, in units, beyond which an unknown stays near its start."""
_RANGE = 1e4
"""Largest factor between an unknown and its start."""
_FAR = 0.2
"""Logarithm of measured over predicted value beyond which the residual is that of logarithms."""


class Solution(NamedTuple):
    """Solutions of n problems with q unknowns and k values each."""

    theta: Floats
    """Unknowns, (n, q)."""
    predicted: Floats
    """Predicted values there, (n, k)."""
    spread: Floats
    """Standard errors of the unknowns, (n, q), in their units, by the errors of the values."""
    valid: NDArray[np.bool_]
    """Whether there is a prediction, (n,)."""
    converged: NDArray[np.bool_]
    """Whether no step improves it, (n,)."""


def gauss_newton(
    predict: Predict,
    values: Floats,
    errors: Floats,
    start: Floats,
    positive: NDArray[np.bool_],
    bounded: NDArray[np.bool_],
) -> Solution:
    """Solve n problems of q unknowns each.

    A step that leaves the valid range or increases the sum of squares is halved. Far from the solution, the
    residuals of ``positive`` values are those of their logarithms. A prediction that is not finite is
    invalid.

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
    bounded
        Which unknowns are values from 0 on; the others are logarithms, (q,).
    """
    (n, q), k = start.shape, values.shape[1]
    s = Solution(
        start.copy(), np.full((n, k), np.nan), np.full((n, q), np.nan), np.zeros(n, bool), np.zeros(n, bool)
    )
    theta, last = start.copy(), np.zeros((n, q))
    low = np.where(bounded, 0.0, start - math.log(_RANGE))
    high = np.where(bounded, start * _RANGE, start + math.log(_RANGE))
    cost, going = np.full(n, np.inf), np.ones(n, dtype=bool)
    for _ in range(_MOST_STEPS):
        rows = np.flatnonzero(going)
        if not len(rows):
            break
        y, well = predict(rows, theta[rows], True)
        measured = np.isfinite(values[rows])
        well = well & (np.isfinite(y) | ~measured).all(axis=1)
        ranked = _residuals(values[rows], y, errors[rows], positive, weighted_by=values[rows])
        now = np.where(well, (ranked**2).sum(axis=1), np.inf)
        better = now <= cost[rows] * (1.0 + 1e-6) + 1e-9
        better &= well
        _turn_back(rows[~better], s, theta, last, going, high, bounded)
        rows, y, measured = rows[better], y[better], measured[better]
        if not len(rows):
            continue
        s.theta[rows], s.predicted[rows], s.valid[rows], cost[rows] = theta[rows], y, True, now[better]
        unit = _units(theta[rows], bounded)
        shifted = (theta[rows][:, None] + _DIFFERENCE * unit[:, None] * np.eye(q)).reshape(-1, q)
        moved, fine = predict(np.repeat(rows, q), shifted, False)
        slopes = (moved.reshape(-1, q, k) - y[:, None]) / _DIFFERENCE
        J = np.nan_to_num(np.where(fine.reshape(-1, q, 1), slopes, 0.0)).transpose(0, 2, 1)
        Jw = J * np.where(measured, 1.0 / errors[rows], 0.0)[:, :, None]
        normal = np.einsum("nki,nkj->nij", Jw, Jw)
        slope = np.einsum("nki,nk->ni", Jw, _residuals(values[rows], y, errors[rows], positive))
        room = np.where(bounded, theta[rows] / unit, np.inf)
        step = _bounded_step(normal + _DAMPING * np.eye(q), slope, room)
        step *= np.minimum(1.0, _LONGEST / np.maximum(np.abs(step).max(axis=1, keepdims=True), 1e-300))
        s.spread[rows] = _spread(normal)
        aim = np.clip(theta[rows] + unit * step, low[rows], high[rows])
        last[rows] = aim - theta[rows]
        step, theta[rows] = last[rows] / unit, aim
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
    bounded: NDArray[np.bool_],
) -> None:
    """Halve the last steps of some problems; without any estimate so far, raise the first logarithm."""
    first, k = ~s.valid[rows], int(np.argmin(bounded))
    raised = 4.0 * theta[rows, k] if bounded[k] else theta[rows, k] + math.log(4.0)
    theta[rows[first], k] = raised[first]
    going[rows[first]] = raised[first] <= high[rows[first], k]
    others = rows[~first]
    last[others] *= 0.5
    theta[others] = s.theta[others] + last[others]
    ended = others[np.abs(last[others] / _units(theta[others], bounded)).max(axis=1, initial=0.0) < _SMALL]
    going[ended], s.converged[ended] = False, True


def _units(theta: Floats, bounded: NDArray[np.bool_]) -> Floats:
    """Return the units of unknowns, (n, q)."""
    return np.where(bounded, np.maximum(theta, 1.0), 1.0)


def _bounded_step(normal: Floats, slope: Floats, room: Floats) -> Floats:
    """Return the steps, (n, q), that solve normal · step = slope with step ≥ −room."""
    held = np.zeros_like(slope, dtype=bool)
    while True:
        ends = np.where(held, -room, 0.0)
        free = ~(held[:, :, None] | held[:, None, :])
        A = np.where(free, normal, np.eye(slope.shape[1]))
        b = np.where(held, ends, slope - np.einsum("nij,nj->ni", normal, ends))
        step = np.linalg.solve(A, b[:, :, None])[:, :, 0]
        beyond = (step < -room) & ~held
        if not beyond.any():
            return step
        held |= beyond


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
