"""Places of release where bodies have room between walls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import clearances, first_reach
from foamprb.cloud.communicator import parts_of
from foamprb.cloud.injection.distribution import draw
from foamprb.cloud.injection.models import Drawn
from foamprb.cloud.state import Particles, concatenate, empty
from foamprb.errors import InputError
from foamprb.flow.base import Flow
from foamprb.settings.injections import InjectionSettings

MOST_DRAWN = 1000
"""Most places that are drawn anew for a body."""
_AT_ONCE = 1000
"""Bodies whose places are drawn anew together, whatever the number of processes."""


@dataclass
class Room:
    """Draw of places where bodies at rest overlap no wall at the times of their release.

    Sizes and shapes are those of the bodies in the order of their numbers; a place without room for its body
    is drawn anew, so that clearance changes the distribution of the places, not of the sizes.
    """

    injection: InjectionSettings
    flow: Flow
    walls: Sequence[int]
    """Indices of the patches from which bodies are kept away."""
    sizes: np.random.Generator
    shapes: np.random.Generator
    """Sources of the random numbers of both."""
    reach: float = 0.0
    """Distance to which walls are listed, m."""
    moved: int = 0
    """Number of bodies whose places were drawn anew."""

    def fit(self, drawn: Drawn, redraw: Callable[[int], Drawn], t: NDArray[np.float64]) -> Drawn:
        """Return places for the next bodies, released at t (n,), s, with others for bodies without room.

        Raises
        ------
        InputError
            If a body has no room at :data:`MOST_DRAWN` places.
        """
        (x, hosts), cramped = drawn, []
        for part in parts_of(len(x)):
            p = self._bodies(x[part], hosts[part], t[part])
            rows = np.flatnonzero(self._overlap(p))
            cramped.append((part.start + rows, p.take(rows)))
        rows = np.concatenate([rows for rows, _ in cramped])
        bodies = concatenate(p for _, p in cramped)
        self.moved += len(rows)
        for first in range(0, len(rows), _AT_ONCE):
            some = slice(first, first + _AT_ONCE)
            p = self._move(bodies.take(some), redraw)
            x[rows[some]], hosts[rows[some]] = p.x, p.host
        return x, hosts

    def _bodies(self, x: NDArray[np.float64], hosts: NDArray[np.int32], t: NDArray[np.float64]) -> Particles:
        """Return the next bodies at rest, at some places and times."""
        p = empty(len(x))
        p.x[:], p.host[:], p.t[:] = x, hosts, t
        p.R[:] = 0.5 * draw(self.injection.sizeDistribution or 0.0, p.size, self.sizes)
        self.injection.shape.form(p, self.shapes)
        return p

    def _overlap(self, p: Particles) -> NDArray[np.bool_]:
        """Return which bodies overlap a wall."""
        self.reach = max(self.reach, first_reach(p))
        return clearances(p, self.flow, self.reach, self.walls) < 0.0

    def _move(self, p: Particles, redraw: Callable[[int], Drawn]) -> Particles:
        """Return bodies at other places, where they have room."""
        left = np.arange(p.size)
        for _ in range(MOST_DRAWN):
            p.x[left], p.host[left] = redraw(len(left))
            left = left[self._overlap(p.take(left))]
            if not len(left):
                return p
        raise InputError(
            f"clearance yes: a body of diameter {2.0 * p.R[left[0]]:g} m has no room at any of {MOST_DRAWN} "
            "random places. Allowed: smaller bodies, other places, or clearance no."
        )
