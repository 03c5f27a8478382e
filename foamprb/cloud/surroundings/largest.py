"""Largest values on the path of each particle, and the curvature of the flow there.

The values are those of the states in which its steps start. The second derivatives of the flow are sampled in
the first step of a body, and once in :data:`INTERVAL` tracking steps, or in a stretch that is longer. Only
their means are used: where no model needs their reconstruction, they are those of single tetrahedra.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import taylor_deformation
from foamprb.body.quadratic import bullet_amplitude, parts, resolved_strain, square
from foamprb.body.tensor import Scalar, select, sym
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import Medium, Scratch, at, load3, load9, viscosity_at
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.surroundings.base import Stage, Surrounding
from foamprb.cloud.surroundings.quadratic import QuadraticRows, load7
from foamprb.compile.link import Slots, traced
from foamprb.flow.kernels import curvature

INTERVAL = 64
"""Tracking steps between two samples of the second derivatives."""


class LargestRows(NamedTuple):
    """Values of a particle so far."""

    largest: Annotated[int, Row(5, "", "largest values, see :class:`Largest`", of="largest", saved=True)]
    curved: Annotated[int, Row(3, "1/s", "sums of a |S| and |E|, and their number", of="curved", saved=True)]
    starting: Annotated[int, Row(1, "", "1 at the start of a step, 0 at the end of a call")]
    sample_step: Annotated[int, Row(1, "", "tracking step of the last sample of the curvature", -1.0)]


class Largest(NamedTuple):
    """Index of each of the largest values on a path, in :attr:`~foamprb.cloud.state.Particles.largest`."""

    D: int
    """Taylor's deformation."""
    shear_rate: int
    """γ̇ of the fluid at the centre, 1/s."""
    shear_stress: int
    """μ_f γ̇ there, Pa."""
    closeness: int
    """1/(1 + gap/a): 1 in contact, 0 beyond the reach of walls."""
    bullet: int
    """ε of the quadratic mode; 0 without that mode."""


LARGEST = Largest(*range(5))
values = offsets(LargestRows)
mode = offsets(QuadraticRows)


@choice
def mode_amplitude(_block: Block, _i: int) -> Scalar:
    """Return 0: the body has no quadratic mode."""
    return 0.0


def amplitude_of_mode(block: Block, i: int) -> Scalar:
    """Return ε of the quadratic mode of lane i."""
    return bullet_amplitude(load7(block, mode.B, i))


def sample_curvature(
    flow: object, s: Scratch, i: int, step: int, remaining: float, _medium: Medium, _coefficients: object
) -> None:
    """Note that a step of lane i starts, and sample the second derivatives in some of them."""
    block = s.block
    block[values.starting * LANES + i] = 1.0 if remaining > 0.0 else 0.0
    # The first step of a stretch, for any division of the run into calls.
    stretch = max(s.stride[i], 1)
    first = s.step[i] if s.stride[i] > 0 else step
    if remaining <= 0.0 or block[values.sample_step * LANES + i] == first:
        return
    block[values.sample_step * LANES + i] = first
    a, place = block[at.R * LANES + i], values.curved * LANES + i
    # Also the first step of each body, which may live for less than an interval.
    if first // INTERVAL == (first - stretch) // INTERVAL and block[place + 2 * LANES] > 0.0:
        return
    S = parts(curvature(flow, s.host[i], load3(block, at.x, i), block[at.t * LANES + i])).S
    block[place] += a * np.sqrt(square(S))
    block[place + LANES] += resolved_strain(a, sym(load9(block, at.l, i)), load3(block, at.u, i))
    block[place + 2 * LANES] += 1.0


@traced
def largest_stage(block: Block, medium: Medium) -> None:
    """Store the largest values at the starts of steps."""
    for i in range(LANES):
        starts = block[at.moving * LANES + i] * block[values.starting * LANES + i] > 0.0
        x, y, z = load3(block, at.stretch, i)
        D = taylor_deformation(np.maximum(np.maximum(x, y), z), np.minimum(np.minimum(x, y), z))
        rate = shear_rate(load9(block, at.l, i))
        stress = viscosity_at(block, i, medium) * rate
        gap = np.maximum(block[at.clearance * LANES + i] / block[at.R * LANES + i], 0.0)
        raise_to(block, i, LARGEST.D, select(starts, D, 0.0))
        raise_to(block, i, LARGEST.shear_rate, select(starts, rate, 0.0))
        raise_to(block, i, LARGEST.shear_stress, select(starts, stress, 0.0))
        raise_to(block, i, LARGEST.closeness, select(starts, 1.0 / (1.0 + gap), 0.0))
        raise_to(block, i, LARGEST.bullet, select(starts, mode_amplitude(block, i), 0.0))


def raise_to(block: Block, i: int, k: int, value: Scalar) -> None:
    """Store a value as the largest one of index k in lane i, unless that is larger."""
    place = (values.largest + k) * LANES + i
    block[place] = np.maximum(block[place], value)


def note_largest(block: Block, medium: Medium, share: float, _coefficients: object) -> None:
    """Store the largest values before the surroundings change the flow at the starts of steps."""
    if share == 0.0:
        largest_stage(block, medium)


@dataclass(frozen=True, kw_only=True)
class LargestValues(Surrounding):
    """Record of the largest values on each path; every loop has it, and it changes nothing else."""

    quadratic: bool = False
    """Whether bodies have the quadratic mode."""

    rows: ClassVar = (LargestRows,)
    each_step: ClassVar = False
    stages: ClassVar = (
        Stage("start", sample_curvature, adds=(values.curved,), before=(at.u, at.l)),
        Stage("fluid", note_largest, writes=(values.largest,), before=(at.u, at.l)),
    )

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the amplitude of the quadratic mode, if bodies have it."""
        return {mode_amplitude: amplitude_of_mode} if self.quadratic else {}
