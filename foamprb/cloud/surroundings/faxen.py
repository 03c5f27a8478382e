"""Faxén's correction: the mean of a curved flow over the body instead of its velocity at the centre.

The formula is that of :mod:`foamprb.body.faxen`. The flow's second derivatives are those at the start of a
step.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from foamprb.body.faxen import faxen_velocity
from foamprb.body.tensor import dot, scale, transpose
from foamprb.cloud.block import Medium, Scratch, at, load3, load9, store3
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Row, offsets
from foamprb.cloud.surroundings.base import Surrounding, Traits, add3
from foamprb.compile.link import traced
from foamprb.flow.analytic import curvature_linear as curvature

__all__ = ["FaxenCorrection"]


class FaxenRows(NamedTuple):
    """Second derivatives of the flow at the start of a step."""

    along_xx: Annotated[int, Row(3, "1/(m s)", "∂²u/∂x²")]
    along_yy: Annotated[int, Row(3, "1/(m s)", "∂²u/∂y²")]
    along_zz: Annotated[int, Row(3, "1/(m s)", "∂²u/∂z²")]
    along_xy: Annotated[int, Row(3, "1/(m s)", "∂²u/∂x∂y")]
    along_yz: Annotated[int, Row(3, "1/(m s)", "∂²u/∂y∂z")]
    along_xz: Annotated[int, Row(3, "1/(m s)", "∂²u/∂x∂z")]


curved = offsets(FaxenRows)


def store_curvature(
    flow: Any, s: Scratch, i: int, _step: int, _rest: float, _medium: Medium, _coefficients: Any
) -> None:
    """Store the second derivatives at the position of lane i."""
    block = s.block
    xx, yy, zz, xy, yz, xz = curvature(flow, s.host[i], load3(block, at.x, i), block[at.t * LANES + i])
    store3(block, curved.along_xx, i, xx)
    store3(block, curved.along_yy, i, yy)
    store3(block, curved.along_zz, i, zz)
    store3(block, curved.along_xy, i, xy)
    store3(block, curved.along_yz, i, yz)
    store3(block, curved.along_xz, i, xz)


@traced
def correct(block: Any, medium: Medium, share: float, coefficients: Any) -> None:  # noqa: ARG001
    """Add ⅙ C:∇∇u to the velocity of the fluid, with the shape tensor C."""
    for i in range(LANES):
        F, R = load9(block, at.new_F, i), block[at.R * LANES + i]
        second = (
            load3(block, curved.along_xx, i),
            load3(block, curved.along_yy, i),
            load3(block, curved.along_zz, i),
            load3(block, curved.along_xy, i),
            load3(block, curved.along_yz, i),
            load3(block, curved.along_xz, i),
        )
        add3(block, at.u, i, faxen_velocity(scale(R * R, dot(F, transpose(F))), second))


@dataclass(frozen=True, kw_only=True)
class FaxenCorrection(Surrounding):
    """Mean of a curved flow over the body instead of its velocity at the centre: ``faxenCorrection;``."""

    rows: ClassVar = {"curved": FaxenRows}
    traits: ClassVar = Traits(kernels=("curvature",))
    update: ClassVar = staticmethod(store_curvature)
    disturb: ClassVar = staticmethod(correct)

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Refuse drops, inside which the fluid moves."""
        return "faxenCorrection holds for solids, not for drops" if liquid else ""
