"""What resists the motion of a particle through the fluid."""

from __future__ import annotations

from typing import Any

from foamprb.body.drag import oberbeck as drag
from foamprb.body.tensor import Tensor, Vector
from foamprb.cloud.block import at, load3, load_integrals
from foamprb.cloud.layout import LANES


def resistances(block: Any, i: int) -> Vector:
    """Principal resistances K of lane i without walls, m."""
    R, k = block[at.R * LANES + i], drag(load3(block, at.stretch, i), load_integrals(block, i))
    return R * k[0], R * k[1], R * k[2]


def along_own_axes(_block: Any, _i: int, rate: Vector, w: Vector) -> Vector:
    """What drag with the rates μ_f K/m, 1/s, does to a body that lags by w, m/s², in the particle frame."""
    return rate[0] * w[0], rate[1] * w[1], rate[2] * w[2]


def own_axes(_block: Any, _i: int, Q: Tensor, rate: Vector) -> tuple[Tensor, Vector]:
    """Frame in which the drag at the start of a step is diagonal, and its rates there: the particle's."""
    return Q, rate


def own_frame(_block: Any, _i: int, Q: Tensor) -> Tensor:
    """The frame of :func:`own_axes` in the stages that follow, if Q is the particle's at the start."""
    return Q


def leave_gradient(_block: Any, _i: int, _Q: Tensor, _l_s: Tensor, _wanted: Any) -> None:
    """Nobody asks for the l_s of a body with inertia before its A is known."""


def no_hindrance(_block: Any, _i: int) -> Tensor:
    """No wall hinders."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
