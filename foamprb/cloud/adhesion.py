"""Adhesion to walls by bonds: the functions of a lane that a patch with ``adhere`` calls.

The formulas are those of :mod:`foamprb.body.bonds`. A body that touches the wall slides along it until a bond
forms, and is stuck while it lasts.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

import numpy as np

from foamprb.body.bonds import exponential_deviate, force_on_held_sphere, off_rate
from foamprb.body.tensor import Vector
from foamprb.body.viscosity import shear_rate
from foamprb.cloud import lanes, motion
from foamprb.cloud.block import Scratch, at, load3, load9, store3
from foamprb.cloud.layout import LANES, Row, offsets
from foamprb.cloud.motion import (
    ACTIVE,
    BOND_FORCE,
    BOND_FORMS,
    BOND_LIMIT,
    BOND_LOOSENS,
    BOND_SEED,
    SHORTEST_STEP,
    STUCK,
    PatchTable,
    renew_clearance,
    resume,
    settle,
    turn_along,
    turn_body,
)
from foamprb.cloud.patches import STICK
from foamprb.cloud.paths import record_rest
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.compile.link import Slots
from foamprb.flow.kernels import ride, sample

_KIND = np.uint64(5)
"""Second word of the key of these random numbers; the seed is the first."""


class BondRows(NamedTuple):
    """Bond of a particle."""

    adherent: Annotated[int, Row(1, "", "number in the cloud", of="number")]
    hazard: Annotated[int, Row(1, "1", "integral of the rate since the last change", of="hazard", saved=True)]
    held: Annotated[int, Row(1, "s", "time to which it is integrated while stuck", of="held", saved=True)]
    changes: Annotated[int, Row(1, "", "bonds formed and broken so far", of="bonds", saved=True)]


bonds = offsets(BondRows)


def hazard_until_change(patches: PatchTable, s: Scratch, i: int, patch: int) -> float:
    """Return the hazard left until the next change of the bond in lane i."""
    number = np.uint64(s.block[bonds.adherent * LANES + i])
    change = np.uint64(s.block[bonds.changes * LANES + i])
    key = (np.uint64(patches.bonds[patch, BOND_SEED]), _KIND)
    return float(exponential_deviate(number, change, key) - s.block[bonds.hazard * LANES + i])


def rate_of_shear(flow: object, s: Scratch, i: int, x: Vector, t: float) -> float:
    """Return the shear rate of the fluid around lane i, at x, at a time, 1/s."""
    _, l_f, _ = sample(flow, s.host[i], x, t)
    return float(shear_rate(l_f))


def change_bond(s: Scratch, i: int) -> None:
    """Begin with the next random number of lane i."""
    s.block[bonds.hazard * LANES + i] = 0.0
    s.block[bonds.changes * LANES + i] += 1.0


def form_bond(flow: object, patches: PatchTable, s: Scratch, i: int, patch: int, t: float, h: float) -> None:
    """Let lane i stick to a patch that it has touched for a time h, until t, if a bond forms."""
    rate = patches.bonds[patch, BOND_FORMS]
    if not (rate > 0.0 and h > 0.0 and s.status[i] == ACTIVE):
        return
    if rate_of_shear(flow, s, i, load3(s.block, at.x, i), t) > patches.bonds[patch, BOND_LIMIT]:
        return
    if rate * h < hazard_until_change(patches, s, i, patch):
        s.block[bonds.hazard * LANES + i] += rate * h
    else:
        settle(s, i, patch, STICK)
        change_bond(s, i)
        s.block[bonds.held * LANES + i] = t


def hold(flow: object, patches: PatchTable, s: Scratch, i: int, last: int, dt: float, start: float) -> None:
    """Hold lane i, if it is stuck by a bond, up to the tracking step ``last``, or until the bond breaks."""
    block = s.block
    if s.status[i] != STUCK:
        return
    bond = patches.bonds[s.patch[i]]
    if bond[BOND_LOOSENS] == 0.0 and bond[BOND_LIMIT] == math.inf:
        return
    while s.step[i] < last:
        end = start + (s.step[i] + 1) * dt
        since = max(block[at.t * LANES + i], block[bonds.held * LANES + i])
        if end - since > SHORTEST_STEP * dt:
            now = 0.5 * (since + end)
            x, _, _ = ride(flow, s.host[i], load3(block, at.x, i), block[at.t * LANES + i], now)
            gamma = rate_of_shear(flow, s, i, x, now)
            force = force_on_held_sphere(block[at.R * LANES + i], gamma, 1.0)
            rate = off_rate(bond[BOND_LOOSENS], force, bond[BOND_FORCE])
            hazard_left = hazard_until_change(patches, s, i, s.patch[i])
            if gamma > bond[BOND_LIMIT]:
                hazard_left = 0.0
            if rate * (end - since) >= hazard_left:
                let_go(flow, s, i, since + hazard_left / rate if hazard_left > 0.0 else since, dt)
                return
            block[bonds.hazard * LANES + i] += rate * (end - since)
            block[bonds.held * LANES + i] = end
        s.step[i] += 1


def let_go(flow: object, s: Scratch, i: int, t: float, dt: float) -> None:
    """Let the stuck particle in lane i move again from a time on, with the velocity of the wall at first."""
    block = s.block
    x, turn, v = ride(flow, s.host[i], load3(block, at.x, i), block[at.t * LANES + i], t)
    if turn[0] < 1.0 or turn[4] < 1.0:
        turn_body(block, i, turn, load9(block, at.F, i), load9(block, at.A, i))
        turn_along(block, i, turn)
    resume(block, i, t - block[at.t * LANES + i])
    record_rest(s, i, t)
    change_bond(s, i)
    s.status[i], s.patch[i] = ACTIVE, -1
    block[at.t * LANES + i], block[at.h * LANES + i] = t, dt
    block[at.taken * LANES + i], block[at.renewed * LANES + i] = 0.0, 1.0
    store3(block, at.x, i, x)
    store3(block, at.v, i, v)
    renew_clearance(flow, s, i)


@dataclass(frozen=True, kw_only=True)
class Adhesion(Surrounding):
    """Bonds of bodies with the walls on which they adhere; a cloud adds it if a patch has ``adhere``."""

    rows: ClassVar = (BondRows,)
    each_step: ClassVar = False

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the functions for bodies that touch a wall or stick to it."""
        return {motion.form_bond: form_bond, lanes.hold: hold}
