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


def no_hindrance(_block: Any, _i: int) -> Tensor:
    """No wall hinders."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
