"""Contact of a body without inertia: how a reaction moves, turns and strains it, and pushes out of walls.

The reaction N n of a contact acts at the point r = −R² b·n/s from the body's centre, with b = F Fᵀ and the
reach s. It is a force on the centre and the stress (N/V) n r on the shape, whose skew part is its torque.
Whether a wall or a body is on the other side makes no difference here.
"""

from __future__ import annotations

from typing import NamedTuple

from foamprb.body.brownian import response, shape_resistance
from foamprb.body.ellipsoid import integrals, reach
from foamprb.body.error_control import largest
from foamprb.body.exponential_runge_kutta import group_exponential
from foamprb.body.stokes import isochoric
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    det,
    dot,
    dot_vector,
    from_frame,
    inner,
    inverse,
    longest_stretch,
    minus,
    norm,
    plus,
    plus_scaled,
    refined_frame,
    scale,
    scale_vector,
    skew,
    stretches_in_frame,
    to_frame,
    transpose,
    vector_dot,
)
from foamprb.body.wall import hindered_resistance
from foamprb.cloud.block import at, load3, load9, load_integrals, store3, store9, store_integrals
from foamprb.cloud.elastic import hindrance_by_walls, resistances, volume_at_rest
from foamprb.cloud.layout import LANES, Block
from foamprb.compile.link import separate, slot

_MOST_TURN = 0.2
"""Largest strain or angle of one push."""


class Push(NamedTuple):
    """Response of a body to a unit reaction, times μ_f."""

    v: Vector
    """Velocity of the centre, 1/m."""
    l: Tensor
    """Velocity gradient, 1/m²."""
    r: Vector
    """Point of contact from the centre, m."""
    rate: Scalar
    """Rate of the gap, above 0, 1/m."""


def push_of(block: Block, i: int, n: Vector, h: Scalar) -> Push:
    """Return the response of lane i to a reaction along n at its point of contact, for h, s."""
    F, R = load9(block, at.F, i), block[at.R * LANES + i]
    # Those in the block are of the last evaluation, which may be one that other lanes needed.
    stretches, _ = stretches_in_frame(F, load9(block, at.frame, i))
    store3(block, at.stretch, i, stretches)
    store_integrals(block, i, integrals(stretches))
    return _push_at(
        block, i, n, scale_vector(-R * R / reach(R, F, n), dot_vector(dot(F, transpose(F)), n)), h
    )


def _push_at(block: Block, i: int, n: Vector, r: Vector, h: Scalar) -> Push:
    """Return the response of lane i to a unit force along n at r that lasts for h, s.

    Over a time h elasticity is as stiff as a viscosity μ h.
    """
    Q = load9(block, at.frame, i)
    K = hindered_resistance(resistances(block, i), hindrance_by_walls(block, i))
    v = vector_dot(dot_vector(inverse(K), dot_vector(Q, n)), Q)
    eta = (block[at.eta * LANES + i] + block[at.mu * LANES + i] * h) / block[at.fluid * LANES + i]
    resistance = shape_resistance(load3(block, at.stretch, i), load_integrals(block, i), eta)
    l = from_frame(Q, response(resistance, to_frame(Q, stress_of(n, r, volume_at_rest(block, i)))))
    return Push(v, l, r, inner(n, v) + inner(n, dot_vector(l, r)))


def stress_of(f: Vector, r: Vector, volume: Scalar) -> Tensor:
    """Return the stress f r/V of a force f at r, Pa; its skew part is the torque r × f over V."""
    x = scale_vector(1.0 / volume, f)
    return (
        x[0] * r[0], x[0] * r[1], x[0] * r[2],
        x[1] * r[0], x[1] * r[1], x[1] * r[2],
        x[2] * r[0], x[2] * r[1], x[2] * r[2],
    )  # fmt: skip


@slot
def push_out(_block: Block, _i: int, n: Vector, x: Vector, width: float, _mu: float, _W: Vector) -> Vector:
    """Move the centre along n by the width, without friction; return its new place."""
    return plus_scaled(x, width, n)


@separate
def push_along_mobility(
    block: Block, i: int, n: Vector, x: Vector, width: float, mu: float, W: Vector
) -> Vector:
    """Move, turn and strain the body in lane i by a reaction along n so that its gap grows by the width, m.

    Friction of up to mu times the reaction undoes the slip of its point of contact on a wall of velocity W,
    m/s, in the step. A body that does not slip rolls. Where a wall hinders the body, the stages of the step
    have strained it by its load, and the reaction does not: it would relax, and be strained, at each step.

    Returns
    -------
    The new place of its centre. The gap is linear in the width; call again for what is left.
    """
    F, h = load9(block, at.F, i), block[at.dt * LANES + i]
    v, l, r, rate = push_of(block, i, n, h)
    if largest(hindrance_by_walls(block, i)) > 0.0:
        l = skew(l)
        rate = inner(n, v) + inner(n, dot_vector(l, r))
    N = width / rate
    N *= min(1.0, _MOST_TURN / (abs(N) * max(norm(l[:3]), norm(l[3:6]), norm(l[6:])) + 1e-300))
    way, turn = scale_vector(N, v), scale(N, l)
    if mu > 0.0:
        l_s = dot(load9(block, at.A, i), inverse(F))
        w = minus(plus(load3(block, at.v, i), dot_vector(l_s, r)), W)
        w = plus_scaled(w, -inner(w, n), n)
        slip = h * norm(w)
        e = scale_vector(-h / (slip + 1e-300), w)
        v, l, _, rate = _push_at(block, i, e, r, h)
        T = min(mu * N, slip / (rate + 1e-300))
        way, turn = plus_scaled(way, T, v), add(turn, scale(T, l))
    F = dot(group_exponential(turn), F)
    F = isochoric(F, det(F))
    # Frame and integrals of this lane only: those of its neighbours stay as they are.
    Q = refined_frame(F, refined_frame(F, load9(block, at.frame, i)))
    stretches, _ = stretches_in_frame(F, Q)
    block[at.length * LANES + i] = block[at.R * LANES + i] * longest_stretch(F)
    store9(block, at.F, i, F)
    store9(block, at.new_F, i, F)
    store9(block, at.frame, i, Q)
    store9(block, at.Q, i, Q)
    store3(block, at.stretch, i, stretches)
    store_integrals(block, i, integrals(stretches))
    return plus(x, way)
