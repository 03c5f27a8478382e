"""Reynolds and Stokes numbers of the motion of particles relative to the fluid, over a run."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import Medium
from foamprb.cloud.measures import carrier_velocity
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.viscosity import medium_at
from foamprb.flow.base import Sampled

Floats = NDArray[np.float64]
_CHUNK = 16_384
_EDGES = np.hstack([0.0, np.logspace(-15.0, 5.0, 2001), np.inf])
"""Bounds of the classes from which quantiles are taken."""
_MOST = 50_000
"""Particles in a record, at most."""


class Slip(NamedTuple):
    """Numbers of n particles at one time."""

    reynolds: Floats
    """|v − u| d/ν."""
    stokes: Floats
    """Translational Stokes number γ̇ τ_p with τ_p = 2 ρ_s R²/(9 μ_f)."""


def drag_excess(reynolds: float) -> float:
    """Return by which share the drag of a sphere exceeds Stokes' (Schiller and Naumann 1933)."""
    return float(0.15 * reynolds**0.687)


def _slip(p: Particles, flow: Sampled, time: float, medium: Medium) -> Slip:
    medium = medium_at(medium, flow, p, time)
    u, l = flow.sample(p.x, p.host, time)
    speed = np.linalg.norm(p.v - carrier_velocity(p, u), axis=1)
    rate = np.asarray(shear_rate(tuple(l.reshape(-1, 9).T)))  # type: ignore[arg-type]
    return Slip(speed * 2.0 * p.R * medium.rho / medium.mu, rate * 2.0 * p.rho * p.R**2 / (9.0 * medium.mu))


class SlipRecord:
    """Distribution of both numbers over active particles at the write times of a run."""

    def __init__(self) -> None:
        self.counts = np.zeros((2, len(_EDGES) - 1), dtype=np.int64)
        """Number of samples in each class."""
        self.worst = Slip(*np.zeros((2, 1)))

    def add(self, other: SlipRecord) -> None:
        """Add another record."""
        self.counts += other.counts
        self.worst = Slip(*np.fmax(self.worst, other.worst))

    @classmethod
    def of(cls, p: Particles, flow: Sampled, time: float, medium: Medium, size: int) -> Self:
        """Return the record of active particles of a cloud of some size at its time, s; of many, of some."""
        stride = max(1, -(-size // _MOST))
        record, active = cls(), np.flatnonzero((p.status == Status.ACTIVE) & (p.number % stride == 0))
        for start in range(0, len(active), _CHUNK):
            slip = _slip(p.take(active[start : start + _CHUNK]), flow, time, medium)
            record.counts += [np.histogram(values, _EDGES)[0] for values in slip]
            record.worst = Slip(*np.fmax(record.worst, np.fmax.reduce(slip, axis=1, keepdims=True)))
        return record

    def lines(self) -> list[str]:
        """Return lines with the 99 % quantile and the largest value of each number; none without samples."""
        names = ("Reynolds number of slip", "Stokes number")
        # Sums, unlike quantiles, are the same for any distribution of the particles.
        below = self.counts.cumsum(axis=1)
        classes = [int(np.searchsorted(row, 0.99 * row[-1])) for row in below]
        return [
            f"{name:24s} 99 % below {min(_EDGES[k + 1], worst[0]):.3g}, at most {worst[0]:.3g}"
            for name, k, worst in zip(names, classes, self.worst, strict=True)
            if worst[0]
        ]
