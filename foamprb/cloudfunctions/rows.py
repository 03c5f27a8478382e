"""Rows of particles, and columns of tables, that several cloud functions need."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import Memory, Rows
from foamprb.results.tables import Column

__all__ = ["close_ended", "columns", "masses", "names_of", "open_rows"]


def open_rows(memory: Memory, p: Particles) -> Rows:
    """Return the rows of the particles that move, or that have ended since the last sample."""
    return np.flatnonzero(~memory["closed"] & (p.status != Status.PENDING))


def close_ended(memory: Memory, p: Particles, rows: Rows) -> None:
    """Sample those of the rows that have ended no more."""
    memory["closed"][rows] = p.status[rows] > Status.ACTIVE


def masses(p: Particles, rows: Rows) -> NDArray[np.float64]:
    """Return masses, kg."""
    mass: NDArray[np.float64] = 4.0 / 3.0 * math.pi * p.rho[rows] * p.R[rows] ** 3
    return mass


def names_of(names: Sequence[str], codes: NDArray[Any]) -> list[str]:
    """Return the name that each code stands for."""
    return [names[code] for code in codes]


def columns(names: Sequence[str], array: NDArray[Any]) -> dict[str, Column]:
    """Return the columns of an array by their names."""
    return dict(zip(names, array.T, strict=True))
