"""Swimmers: bodies that move through the fluid in a direction of their own.

The formulas are those of :mod:`foamprb.body.swimming`. The random spin is drawn at the start of one or more
tracking steps, and constant during these.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple, TypeAlias

import numpy as np

from foamprb.body.brownian import deviates
from foamprb.body.swimming import along_axes, direction, random_directions, random_spin
from foamprb.body.tensor import Tensor, Vector, det, dot_vector, inner, norm, scale_vector
from foamprb.cloud.block import Medium, Scratch, at, load3, load9, store3
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.motion import bounce_along, mirror_body, turn_along
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.surroundings.base import Remarks, Stage, Surrounding, Survey, add3, add9
from foamprb.compile.link import Slots, separate, traced
from foamprb.dictionary.constraints import Meaning, NonNegative, Positive, Seed, Vector3
from foamprb.errors import InputError
from foamprb.flow.base import Patch

Numbers: TypeAlias = tuple[float, float, np.uint64]
"""Speed, rotational diffusivity and seed."""

LARGE_TURN = 0.02
"""D_R Δt above which the user is warned."""
_HELD_TURN = 0.002
"""D_R t up to which a spin may hold for longer than a tracking step."""
_START, _KIND = np.uint64(4), np.uint64(3)
"""Second words of the keys of the first directions and of the spins; the seed is the first."""


class SwimmerRows(NamedTuple):
    """A swimmer's direction and spin."""

    swimmer: Annotated[int, Row(1, "", "number in the cloud", of="number")]
    heading: Annotated[int, Row(3, "1", "q of its direction F·q/|F·q|", of="heading", saved=True)]
    spun: Annotated[int, Row(1, "", "tracking step, from 1 on, for which a spin was drawn last")]
    tumble: Annotated[int, Row(3, "1/s", "random angular velocity")]


swimmers = offsets(SwimmerRows)


def draw_spin(
    _flow: object, s: Scratch, i: int, step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Draw the spin of lane i, which holds for the time that remains."""
    block = s.block
    if block[swimmers.spun * LANES + i] != step + 1.0 and remaining > 0.0:
        block[swimmers.spun * LANES + i] = step + 1.0
        number = np.uint64(block[swimmers.swimmer * LANES + i])
        three, _ = deviates(number, np.uint64(step), (coefficients[2], _KIND))
        store3(block, swimmers.tumble, i, random_spin(coefficients[1], remaining, three))


def hold_of_spin(_block: Block, _i: int, _medium: Medium, coefficients: Numbers) -> float:
    """Return how long the spin may be constant, s: the swimmer then turns little."""
    return _HELD_TURN / (coefficients[1] + 1e-300)


@traced
def swim(block: Block, medium: Medium, share: float, coefficients: Numbers) -> None:  # noqa: ARG001
    """Add the swimming velocity to u, and the random spin to l."""
    speed = coefficients[0]
    for i in range(LANES):
        p = direction(load9(block, at.new_F, i), load3(block, swimmers.heading, i))
        add3(block, at.u, i, scale_vector(speed, p))
        x, y, z = load3(block, swimmers.tumble, i)
        add9(block, at.l, i, (0.0 * x, -z, y, z, 0.0 * x, -x, -y, x, 0.0 * x))


@separate
def turn_heading(block: Block, i: int, turn: Tensor) -> None:
    """Mirror q of lane i, together with the body; a rotation of F turns the direction already."""
    if det(turn) < 0.0:
        store3(block, swimmers.heading, i, dot_vector(turn, load3(block, swimmers.heading, i)))


@separate
def leave_wall(block: Block, i: int, n: Vector) -> None:
    """Mirror the swimmer in lane i at a wall of normal n, unless it swims away from it already."""
    if inner(direction(load9(block, at.F, i), load3(block, swimmers.heading, i)), n) < 0.0:
        turn_heading(block, i, mirror_body(block, i, n))


@dataclass(frozen=True, kw_only=True)
class Swimming(Surrounding):
    """Bodies that swim through the fluid in a direction of their own: ``swimming { speed 20e-6; }``."""

    speed: Annotated[float, Positive, Meaning("speed through the fluid", "m/s")]
    rotationalDiffusivity: Annotated[
        float, NonNegative, Meaning("of the direction, besides that by `BrownianMotion`", "1/s")
    ] = 0.0
    direction: Annotated[
        Vector3 | None, Meaning("at the start; other shapes than spheres swim along an axis", "1", "random")
    ] = None
    seed: Seed = 1

    rows: ClassVar = (SwimmerRows,)
    each_step: ClassVar = False
    mirrors: ClassVar = True
    measures: ClassVar = ("swimmingDirection",)
    surveys: ClassVar = ()
    stages: ClassVar = (
        Stage("start", draw_spin, writes=(swimmers.tumble,)),
        Stage("hold", hold_of_spin),
        Stage("fluid", swim, reads=(at.new_F, swimmers.heading, swimmers.tumble), adds=(at.u, at.l)),
    )

    def __post_init__(self) -> None:
        if self.direction is not None and not 0.0 < norm(self.direction) < math.inf:
            raise InputError("has a direction of length 0. Allowed: a vector (x y z)")

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return the speed, the diffusivity and the seed."""
        return float(self.speed), float(self.rotationalDiffusivity), np.uint64(self.seed)

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the functions by which mirrors and walls change the direction."""
        return {turn_along: turn_heading, bounce_along: leave_wall}

    def begin(self, p: Particles) -> None:
        """Set the directions of the particles that have none."""
        new = np.flatnonzero((p.status <= Status.ACTIVE) & (p.heading == 0.0).all(axis=1))
        if self.direction is None:
            wanted = random_directions(p.number[new].astype(np.uint64), (np.uint64(self.seed), _START))
        else:
            wanted = np.tile(np.array(self.direction) / norm(self.direction), (len(new), 1))
        F = p.F[new].reshape(-1, 3, 3)
        p.heading[new] = np.linalg.solve(F, along_axes(p.F[new], wanted)[:, :, None])[:, :, 0]

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Refuse drops, whose shape does not turn with the liquid."""
        return "swimming holds for solids, not for drops" if liquid else ""

    def remarks(self, survey: Survey) -> Remarks:
        """Note over which distance swimmers keep their direction without molecules; warn of large turns."""
        D = self.rotationalDiffusivity
        notes = (f"{'persistence length [m]':24s} {self.speed / (2.0 * D):.3g}",) if D > 0.0 else ()
        turn = D * survey.dt
        if turn <= LARGE_TURN:
            return Remarks(notes)
        long_step = (
            f"swimmers turn at random by sqrt(2 D dt) = {math.sqrt(2.0 * turn):.2g} in a step, which is not "
            f"small. Use deltaT < {LARGE_TURN / D:.2g}."
        )
        return Remarks(notes, (long_step,), long_step)
