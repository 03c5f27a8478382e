"""Lift by inertia of the fluid, in the slip or, with inertia of the body, in its acceleration.

The formulas are those of :mod:`foamprb.body.lift`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from foamprb.body.lift import lift_force, lifted_slip, vorticity
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    dot_vector,
    inverse,
    minus,
    plus,
    scale_vector,
    vector_dot,
)
from foamprb.body.wall import hindered_resistance
from foamprb.cloud.block import Medium, at, load3, load9, local_medium, viscosity_at
from foamprb.cloud.elastic import present_hindrance, resistances, volume_at_rest
from foamprb.cloud.integrators.base import Integrator, lifted
from foamprb.cloud.integrators.stokes import slip_by_forces, slip_of_body
from foamprb.cloud.layout import LANES, Block
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.compile.link import Slots
from foamprb.dictionary.constraints import Only


def slip_with_lift(block: Block, i: int, medium: Medium, l_f: Tensor, Du_Dt: Vector) -> Vector:
    """Return the velocity relative to the fluid of the shape in the block, m/s."""
    w, k = slip_by_forces(block, i, medium, l_f, Du_Dt), resistances(block, i)
    Q, R, mu = load9(block, at.Q, i), block[at.R * LANES + i], viscosity_at(block, i, medium)
    K = hindered_resistance(k, present_hindrance(block, i))
    x, y, z = dot_vector(Q, w)
    # The walls' effect on the slip without lift is part of u.
    near_walls = vector_dot(dot_vector(inverse(K), (k[0] * x, k[1] * y, k[2] * z)), Q)
    lifted = lifted_slip(near_walls, Q, K, vorticity(l_f), R, local_medium(block, i, medium).rho, mu)
    return plus(w, minus(lifted, near_walls))


def acceleration_with_lift(
    block: Block, i: int, medium: Medium, a: Vector, v: Vector, rate: Vector, inertia: Scalar
) -> Vector:
    """Return the acceleration with that by lift, m/s²; see :func:`foamprb.cloud.integrators.base.lifted`.

    In steps that are long against the relaxation by drag, the lift is that of the slip at which drag balances
    it, since the lift of an explicit slip would be unstable there.
    """
    Q, u = load9(block, at.Q, i), load3(block, at.u, i)
    R, mu, omega = block[at.R * LANES + i], viscosity_at(block, i, medium), vorticity(load9(block, at.l, i))
    mass = volume_at_rest(block, i) * block[at.rho * LANES + i] * inertia
    K = hindered_resistance(scale_vector(mass / mu, rate), present_hindrance(block, i))
    load = dot_vector(Q, minus(a, load3(block, at.DuDt, i)))
    w0 = vector_dot(dot_vector(inverse(K), scale_vector(mass / mu, load)), Q)
    balanced = lifted_slip(w0, Q, K, omega, R, local_medium(block, i, medium).rho, mu)
    y = block[at.dt * LANES + i] * (rate[0] + rate[1] + rate[2]) * (1.0 / 3.0)
    y = y * y
    share = y * y / (1.0 + y * y)
    w = minus(v, u)
    w = plus(w, scale_vector(share, minus(balanced, w)))
    return plus(a, scale_vector(1.0 / mass, lift_force(w, omega, R, local_medium(block, i, medium).rho, mu)))


@dataclass(frozen=True, kw_only=True)
class SaffmanMeiLift(Surrounding):
    """Lift by inertia of the fluid on a sphere that slips in shear: ``SaffmanMeiLiftForce;``."""

    each_step: ClassVar = False

    U: Annotated[str, Only("U", "the flow's velocity")] = "U"

    def slots(self, inertia: bool) -> Slots:
        """Return the acceleration, or the slip without inertia."""
        return {lifted: acceleration_with_lift} if inertia else {slip_of_body: slip_with_lift}

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Refuse drops, inside which the fluid moves."""
        return "SaffmanMeiLiftForce holds for solids, not for drops" if liquid else ""
