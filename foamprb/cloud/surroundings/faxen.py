"""Faxén's correction: the mean of a curved flow over the body instead of its velocity at the centre.

The formula is that of :mod:`foamprb.body.faxen`. The flow's second derivatives are those at the start of a
step and at its end, and linear between them; with ``paper`` those at the start.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

from foamprb.body.faxen import Curvature, faxen_velocity
from foamprb.body.tensor import (
    Scalar,
    Vector,
    between,
    dot,
    dot_vector,
    inner,
    minus,
    plus_scaled,
    scale,
    scale_vector,
    select,
    transpose,
)
from foamprb.body.wall import curvature_factor
from foamprb.cloud.block import Medium, Scratch, at, choose3, load3, load9, store3
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.surroundings.base import Stage, Surrounding, add3, curved_velocity
from foamprb.compile.link import Slots, traced
from foamprb.flow.kernels import curvature


class FaxenRows(NamedTuple):
    """Second derivatives of the flow on a step: ∂²u/∂x², ∂y², ∂z², ∂x∂y, ∂y∂z and ∂x∂z."""

    curvature_start: Annotated[int, Row(18, "1/(m s)", "second derivatives at the start")]
    curvature_end: Annotated[int, Row(18, "1/(m s)", "the same where the step is to lead")]
    curvature_way: Annotated[int, Row(3, "m", "the way there; 0 as long as it is unknown")]


curved = offsets(FaxenRows)


def store_curvature(
    flow: object, s: Scratch, i: int, _step: int, _rest: float, _medium: Medium, _coefficients: object
) -> None:
    """Store the second derivatives at the position of lane i."""
    x = load3(s.block, at.x, i)
    _store(s.block, i, curved.curvature_start, curvature(flow, s.host[i], x, s.block[at.t * LANES + i]))
    store3(s.block, curved.curvature_way, i, (0.0, 0.0, 0.0))


def store_curvature_ahead(flow: object, s: Scratch, i: int, _medium: Medium, _coefficients: object) -> None:
    """Store the second derivatives where the step of lane i is to lead."""
    x, t = load3(s.block, at.new_x, i), s.block[at.t * LANES + i] + s.block[at.dt * LANES + i]
    _store(s.block, i, curved.curvature_end, curvature(flow, s.ahead[i], x, t))
    store3(s.block, curved.curvature_way, i, minus(x, load3(s.block, at.x, i)))


def _store(block: Block, i: int, row: int, second: Curvature) -> None:
    for k in range(6):
        for c in range(3):
            block[(row + 3 * k + c) * LANES + i] = second[k][c]


@traced
def correct(block: Block, medium: Medium, share: float, coefficients: object) -> None:  # noqa: ARG001
    """Add ⅙ C:∇∇u to the velocity of the fluid, with the shape tensor C."""
    for i in range(LANES):
        F, R = load9(block, at.new_F, i), block[at.R * LANES + i]
        add3(block, at.u, i, faxen_velocity(scale(R * R, dot(F, transpose(F))), _second(block, i, share)))


def near_wall(block: Block, i: int, n: Vector, h: Scalar, e: Scalar, share: Scalar) -> Vector:
    """Return what a wall adds to Faxén's correction of lane i along it, less this correction across it, m/s.

    ``n``, ``h`` and ``e`` are the wall's normal, its distance and the body's reach over that;
    :func:`foamprb.body.wall.stagnation_factor` contains the correction across.
    """
    # ⅙ C:∇∇u of a body whose shape tensor is n n: a sixth of the second derivative along n.
    square = (
        n[0] * n[0], n[0] * n[1], n[0] * n[2],
        n[0] * n[1], n[1] * n[1], n[1] * n[2],
        n[0] * n[2], n[1] * n[2], n[2] * n[2],
    )  # fmt: skip
    c = faxen_velocity(square, _second(block, i, share))
    l_n = inner(dot_vector(load9(block, at.l, i), n), n)
    q, x = 3.0 * h * h * curvature_factor(e) - h * h * e * e, e * e
    return plus_scaled(scale_vector(q, c), -q * inner(c, n) - x / 6.0 * h * l_n, n)


def _second(block: Block, i: int, share: Scalar) -> Curvature:
    """Return the second derivatives where lane i is after a share of the step."""
    way = load3(block, curved.curvature_way, i)
    length_2, moved = inner(way, way), minus(load3(block, at.new_x, i), load3(block, at.x, i))
    gone = select((share > 0.0) & (length_2 > 0.0), inner(moved, way) / (length_2 + 1e-300), 0.0)
    return (
        _second_at(block, i, 0, gone), _second_at(block, i, 1, gone), _second_at(block, i, 2, gone),
        _second_at(block, i, 3, gone), _second_at(block, i, 4, gone), _second_at(block, i, 5, gone),
    )  # fmt: skip


def _second_at(block: Block, i: int, k: int, gone: Scalar) -> Vector:
    """Return the k-th second derivatives at a share of the way."""
    start = load3(block, curved.curvature_start + 3 * k, i)
    end = load3(block, curved.curvature_end + 3 * k, i)
    return choose3(gone > 0.0, between(start, end, gone), start)


@dataclass(frozen=True, kw_only=True)
class FaxenCorrection(Surrounding):
    """Mean of a curved flow over the body instead of its velocity at the centre: ``faxenCorrection;``."""

    rows: ClassVar = (FaxenRows,)
    each_step: ClassVar = False
    kernels: ClassVar = ("curvature",)
    stages: ClassVar = (
        Stage("start", store_curvature, writes=(curved.curvature_start,)),
        Stage("ahead", store_curvature_ahead, writes=(curved.curvature_end,)),
        Stage("fluid", correct, reads=(curved.curvature_start, curved.curvature_end), adds=(at.u,)),
    )

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the part of ``wallLift`` by the flow's second derivatives."""
        return {curved_velocity: near_wall}

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Refuse drops, inside which the fluid moves."""
        return "faxenCorrection holds for solids, not for drops" if liquid else ""
