"""Reynolds and Stokes numbers of the motion of particles relative to the fluid, over a run."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import Medium
from foamprb.cloud.measures import carrier_velocity
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.viscosity import medium_at
from foamprb.flow.base import Sampled

_CHUNK = 16_384
_MOST = 10_000
"""Particles whose numbers are compared at a time, at most: others at each."""


class Slip(NamedTuple):
    """Largest numbers of particles."""

    reynolds: float = 0.0
    """|v − u| d/ν."""
    stokes: float = 0.0
    """Translational Stokes number γ̇ τ_p with τ_p = 2 ρ_s R²/(9 μ_f)."""

    def or_more(self, other: Slip) -> Slip:
        """Return the larger ones of two."""
        return Slip(*map(float, np.fmax(self, other)))

    def lines(self) -> list[str]:
        """Return a line for each number; none without slip."""
        share = 100.0 * drag_excess(self.reynolds)
        too_small = f"; the drag of a sphere is {share:.2g} % more than Stokes'" if share > 1.0 else ""
        names = ("Reynolds number of slip", too_small), ("Stokes number", "")
        pairs = zip(names, self, strict=True)
        return [f"{name:24s} at most {value:.3g}{more}" for (name, more), value in pairs if value]


def drag_excess(reynolds: float) -> float:
    """Return by which share the drag of a sphere exceeds Stokes' (Schiller and Naumann 1933)."""
    return float(0.15 * reynolds**0.687)


def slip_of(p: Particles, flow: Sampled, time: float, medium: Medium, size: int, turn: int = 0) -> Slip:
    """Return the largest numbers of active particles at a time, s; of some of a cloud of large ``size``.

    Those of each further ``turn`` are others, until all have had theirs.
    """
    stride = max(1, -(-size // _MOST))
    largest, active = Slip(), np.flatnonzero((p.status == Status.ACTIVE) & ((p.number - turn) % stride == 0))
    for start in range(0, len(active), _CHUNK):
        some = p.take(active[start : start + _CHUNK])
        fluid = medium_at(medium, flow, some, time)
        u, l = flow.sample(some.x, some.host, time)
        speed = np.linalg.norm(some.v - carrier_velocity(some, u), axis=1)
        rate = np.asarray(shear_rate(tuple(l.reshape(-1, 9).T)))  # type: ignore[arg-type]
        reynolds = speed * 2.0 * some.R * fluid.rho / fluid.mu
        stokes = rate * 2.0 * some.rho * some.R**2 / (9.0 * fluid.mu)
        largest = largest.or_more(Slip(*map(np.fmax.reduce, (reynolds, stokes))))
    return largest
