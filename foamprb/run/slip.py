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

__all__ = ["Slip", "SlipRecord", "drag_excess"]

Floats = NDArray[np.float64]
_CHUNK = 16_384
_EDGES = np.linspace(-15.0, 5.0, 401)
"""Decimal logarithms of the bounds of the classes from which quantiles are taken."""


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
    """Distribution of both numbers over all active particles at the write times of a run."""

    def __init__(self) -> None:
        self._counts = np.zeros((len(Slip._fields), len(_EDGES) + 1), dtype=np.int64)
        self.worst = Slip(*np.zeros((2, 1)))

    def add(self, other: SlipRecord) -> None:
        """Add another record."""
        self._counts += other._counts
        self.worst = Slip(*(np.maximum(a, b) for a, b in zip(self.worst, other.worst, strict=True)))

    @classmethod
    def of(cls, p: Particles, flow: Sampled, time: float, medium: Medium) -> Self:
        """Return the record of the active particles of a cloud at its time, s."""
        record, active = cls(), np.flatnonzero(p.status == Status.ACTIVE)
        for start in range(0, len(active), _CHUNK):
            slip = _slip(p.take(active[start : start + _CHUNK]), flow, time, medium)
            for k, values in enumerate(slip):
                with np.errstate(divide="ignore"):
                    classes = np.searchsorted(_EDGES, np.log10(values))
                record._counts[k] += np.bincount(classes, minlength=len(_EDGES) + 1)
                record.worst[k][0] = max(record.worst[k][0], np.nanmax(values))
        return record

    def lines(self) -> list[str]:
        """Return lines with median, 99 % quantile and largest value of each number; none without samples."""
        if not self._counts.any():
            return []
        names = ("Reynolds number of slip", "Stokes number")
        return [
            f"{name:24s} {self._quantile(k, 0.5):.3g}, 99 % below {self._quantile(k, 0.99):.3g}, at most "
            f"{self.worst[k][0]:.3g}"
            for k, name in enumerate(names)
        ]

    def _quantile(self, k: int, share: float) -> float:
        """Return the upper bound of the class of a quantile, at most the largest value."""
        total = np.cumsum(self._counts[k])
        edge = _EDGES[min(int(np.searchsorted(total, share * total[-1])), len(_EDGES) - 1)]
        return float(min(10.0**edge, self.worst[k][0]))
