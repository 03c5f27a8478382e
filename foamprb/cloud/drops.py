"""Drops in place of solids: the functions of a lane that the loop without inertia then calls."""

from __future__ import annotations

import numpy as np

from foamprb.body.morphology import drop_drag_factor, drop_mobility, drop_stress
from foamprb.body.stokes import Mobility
from foamprb.body.tensor import Scalar, Tensor, Vector, ddot, dev, dot, from_frame, scale, sym, transpose
from foamprb.cloud import elastic
from foamprb.cloud.block import Medium, at, load9, viscosity_at
from foamprb.cloud.elastic import volume_at_rest
from foamprb.cloud.integrators import adaptive
from foamprb.cloud.integrators.adaptive import drag_rate_of_solid
from foamprb.cloud.layout import LANES, Block
from foamprb.cloud.surroundings import wall_lift
from foamprb.compile.link import Slots


def _numbers(block: Block, i: int, medium: Medium) -> tuple[Scalar, Scalar]:
    """Return λ and μ_f γ̇ R/σ of lane i."""
    d = sym(load9(block, at.l, i))
    mu_f = viscosity_at(block, i, medium)
    Ca = mu_f * np.sqrt(2.0 * ddot(d, d)) / block[at.mu * LANES + i]
    return block[at.eta * LANES + i] / mu_f, Ca


def body_mobility(block: Block, i: int, medium: Medium, _stretches: Vector) -> Mobility:
    """Return the mobility in the present gradient of the fluid."""
    ratio, Ca = _numbers(block, i, medium)
    return drop_mobility(ratio, Ca)


def mobility_deficit(block: Block, i: int, medium: Medium) -> Scalar:
    """Return the ``deficit`` of that mobility."""
    ratio, Ca = _numbers(block, i, medium)
    return drop_mobility(ratio, Ca).deficit


def drag_rate(block: Block, i: int, mu_f: float, k: Vector) -> Vector:
    """Return μ_f K_a/m, 1/s, less by the factor of a spherical drop, with K_a in units of R."""
    f = drop_drag_factor(block[at.eta * LANES + i] / mu_f)
    x, y, z = drag_rate_of_solid(block, i, mu_f, k)
    return f * x, f * y, f * z


def stresslet(block: Block, i: int, medium: Medium, l_f: Tensor, l_s: Tensor) -> Tensor:
    """Return the stresslet, N m; l_f in space's axes, l_s in the particle's."""
    ratio, Ca = _numbers(block, i, medium)
    Q = load9(block, at.Q, i)
    F = load9(block, at.new_F, i)
    s = drop_stress(ratio, Ca, dev(sym(l_f)), from_frame(Q, sym(l_s)), dot(F, transpose(F)))
    return scale(volume_at_rest(block, i) * viscosity_at(block, i, medium), s)


DROP: Slots = {
    elastic.body_mobility: body_mobility,
    elastic.mobility_deficit: mobility_deficit,
    adaptive.drag_rate: drag_rate,
    wall_lift.stresslet: stresslet,
}
"""What drops put behind choices."""
