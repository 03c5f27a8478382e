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
    """Largest values of both numbers over all active particles at the write times of a run."""

    def __init__(self) -> None:
        self.usual = Slip(*np.zeros((2, 1)))
        """Largest 99 % quantile."""
        self.worst = Slip(*np.zeros((2, 1)))

    def add(self, other: SlipRecord) -> None:
        """Add another record."""
        self.usual = Slip(*np.fmax(self.usual, other.usual))
        self.worst = Slip(*np.fmax(self.worst, other.worst))

    @classmethod
    def of(cls, p: Particles, flow: Sampled, time: float, medium: Medium) -> Self:
        """Return the record of the active particles of a cloud at its time, s."""
        record, active = cls(), np.flatnonzero(p.status == Status.ACTIVE)
        parts = [
            _slip(p.take(active[start : start + _CHUNK]), flow, time, medium)
            for start in range(0, len(active), _CHUNK)
        ]
        if parts:
            numbers = np.concatenate(parts, axis=1)
            record.usual = Slip(*np.nanquantile(numbers, 0.99, axis=1, keepdims=True))
            record.worst = Slip(*np.nanmax(numbers, axis=1, keepdims=True))
        return record

    def lines(self) -> list[str]:
        """Return lines with the largest 99 % quantile and value of each number; none without samples."""
        names = ("Reynolds number of slip", "Stokes number")
        return [
            f"{name:24s} 99 % below {usual[0]:.3g}, at most {worst[0]:.3g}"
            for name, usual, worst in zip(names, self.usual, self.worst, strict=True)
            if worst[0]
        ]
