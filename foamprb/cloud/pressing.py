"""Contact: how a reaction moves, turns and strains a body, and pushes it out of walls.

The reaction N n of a contact acts at the point r = −R² b·n/s from the body's centre, with b = F Fᵀ and the
reach s. It is a force on the centre and the stress (N/V) n r on the shape, whose skew part is its torque.
Whether a wall or a body is on the other side makes no difference here.
"""

from __future__ import annotations

from typing import NamedTuple

from foamprb.body.brownian import response, shape_resistance, with_inertia
from foamprb.body.choice import choice
from foamprb.body.ellipsoid import integrals, reach
from foamprb.body.error_control import largest
from foamprb.body.exponential_runge_kutta import group_exponential
from foamprb.body.tensor import (
    ZERO,
    Scalar,
    Tensor,
    Vector,
    add,
    add_identity,
    axial,
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
    trace,
    transpose,
    vector_dot,
    vector_product,
)
from foamprb.body.wall import hindered_resistance
from foamprb.cloud.block import at, load3, load9, load_integrals, store3, store9, store_integrals
from foamprb.cloud.elastic import hindrance_by_walls, resistances, volume_at_rest
from foamprb.cloud.layout import LANES, Block
from foamprb.cloud.patches import rebound_velocity
from foamprb.compile.link import separate, slot

_MOST_TURN = 0.2
"""Largest strain or angle of one push."""
SAME_NORMAL = 0.9999
"""Cosine of the angle between two walls above which they are one."""
_FLATTEST = 0.2
"""Reach to a wall, in radii, below which a solid is pressed no flatter: it would not keep its volume."""


def speed_at(v: Vector, l: Tensor, r: Vector, n: Vector) -> Scalar:
    """Return the speed along n, m/s, of the point at r from the centre of a body with v and l."""
    return inner(n, v) + inner(n, dot_vector(l, r))


def point_of_contact(block: Block, i: int, F: Tensor, n: Vector) -> Vector:
    """Return the point of lane i with F that a wall of normal n touches, from the centre, m."""
    R = block[at.R * LANES + i]
    return scale_vector(-R * R / reach(R, F, n), dot_vector(dot(F, transpose(F)), n))


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
    F, Q = load9(block, at.F, i), load9(block, at.frame, i)
    # Those in the block are of the last evaluation, which may be one that other lanes needed.
    stretches, _ = stretches_in_frame(F, Q)
    store3(block, at.stretch, i, stretches)
    store_integrals(block, i, integrals(stretches))
    return push_at(block, i, Q, n, point_of_contact(block, i, F, n), h)


def push_at(block: Block, i: int, Q: Tensor, n: Vector, r: Vector, h: Scalar) -> Push:
    """Return the response of lane i, whose shape is in the block, to a unit force along n at r for h, s.

    Over a time h elasticity is as stiff as a viscosity μ h, and a mass m as a resistance m/h.
    """
    K = hindered_resistance(resistances(block, i), hindrance_by_walls(block, i))
    mass, inertia, dilation = inertia_over(block, i, h)
    v = vector_dot(dot_vector(inverse(add_identity(K, mass)), dot_vector(Q, n)), Q)
    eta = (block[at.eta * LANES + i] + block[at.mu * LANES + i] * h) / block[at.fluid * LANES + i]
    stretches = load3(block, at.stretch, i)
    resistance = with_inertia(shape_resistance(stretches, load_integrals(block, i), eta), stretches, inertia)
    T = to_frame(Q, stress_of(n, r, volume_at_rest(block, i)))
    l = from_frame(Q, response(resistance, T, dilation))
    return Push(v, l, r, speed_at(v, l, r, n))


def stress_of(f: Vector, r: Vector, volume: Scalar) -> Tensor:
    """Return the stress f r/V of a force f at r, Pa; its skew part is the torque r × f over V."""
    x = scale_vector(1.0 / volume, f)
    return (
        x[0] * r[0], x[0] * r[1], x[0] * r[2],
        x[1] * r[0], x[1] * r[1], x[1] * r[2],
        x[2] * r[0], x[2] * r[1], x[2] * r[2],
    )  # fmt: skip


@choice
def inertia_over(_block: Block, _i: int, _h: Scalar) -> Vector:
    """Return what inertia adds over a time h to the resistances of centre and shape; by default none.

    The third number is the rate of dilation by a unit pressure. All are over μ_f.
    """
    return 0.0, 0.0, 0.0


def inertia_of_solid(block: Block, i: int, h: Scalar) -> Vector:
    """Return the same of a compressible solid."""
    mu_f, R = block[at.fluid * LANES + i], block[at.R * LANES + i]
    shape = 1.0 / (block[at.inertia * LANES + i] * mu_f * h)
    mass = 5.0 / (R * R) * volume_at_rest(block, i) * shape
    return mass, shape, mu_f / (block[at.lame * LANES + i] * h)


@choice
def is_strained_by_load(block: Block, i: int) -> bool:
    """Return whether a wall hinders lane i: the image of its load then strains it, and reactions do not."""
    return bool(largest(hindrance_by_walls(block, i)) > 0.0)


@slot
def approach(block: Block, i: int, n: Vector) -> tuple[float, float]:
    """Return the speeds along n at start and end of a step, m/s; by default of the centre."""
    return inner(load3(block, at.new_v, i), n), inner(load3(block, at.v, i), n)


@slot
def redirect(block: Block, i: int, n: Vector, W: Vector, e: float, mu: float, _rests: bool) -> None:
    """Change the velocity of the centre by a rebound off a wall of velocity W, m/s."""
    v = minus(load3(block, at.v, i), W)
    store3(block, at.v, i, plus(W, rebound_velocity(v, n, e, mu)))


def spin_of(F: Tensor, A: Tensor) -> tuple[Vector, Tensor]:
    """Return the spin, 1/s, by which a rigid body has the angular momentum of F and A, and (tr b − b)⁻¹.

    With b = F Fᵀ, I = ⅕ m R² (tr b − b), and the angular momentum is ⅕ m R² times twice the axial vector of
    the skew part of A Fᵀ.
    """
    b, H = dot(F, transpose(F)), dot(A, transpose(F))
    mobility = inverse(add_identity(scale(-1.0, b), trace(b)))
    return dot_vector(mobility, scale_vector(2.0, axial(skew(H)))), mobility


def rigid_speed_at_contact(block: Block, i: int, v: Vector, F: Tensor, A: Tensor, n: Vector) -> float:
    """Return the speed along n, m/s, of the point of contact of lane i as a rigid body with v, F and A."""
    return float(inner(v, n) + inner(spin_of(F, A)[0], vector_product(point_of_contact(block, i, F, n), n)))


@separate
def redirect_solid(block: Block, i: int, n: Vector, W: Vector, e: float, mu: float, rests: bool) -> None:
    """Change velocity and spin of a solid by a rebound; no-op for one that rests, which the push stops.

    The impulse P = −(1 + e) ġ/(1/m + (r × n)·I⁻¹·(r × n)) acts at the point of contact, whose speed as that
    of a rigid body is ġ. It does not strain the body.
    """
    if rests:
        return
    F, A, v = load9(block, at.F, i), load9(block, at.A, i), minus(load3(block, at.v, i), W)
    (spin, mobility), torque = spin_of(F, A), vector_product(point_of_contact(block, i, F, n), n)
    turn = scale_vector(5.0 / block[at.R * LANES + i] ** 2, dot_vector(mobility, torque))
    speed = inner(v, n) + inner(spin, torque)
    P = -(1.0 + e) * min(speed, 0.0) / (1.0 + inner(torque, turn))
    along = plus_scaled(v, -inner(v, n), n)
    v = plus_scaled(plus_scaled(v, P, n), -mu if speed < 0.0 else 0.0, along)
    store3(block, at.v, i, plus(W, v))
    x, y, z = scale_vector(P, turn)
    store9(block, at.A, i, add(A, dot((0.0, -z, y, z, 0.0, -x, -y, x, 0.0), F)))


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
    The new place of its centre. It is so to first order; call again for what is left.
    """
    F = load9(block, at.F, i)
    h = block[at.dt * LANES + i]
    # The reaction in the step may become less by it.
    carried = h * reaction_on(block, i, n)
    c = _push_of_step(block, i, n)
    N = _reaction(c, width, carried)
    # The reaction at half of the way: a body that turns is pushed along a curve.
    _set_shape(block, i, dot(group_exponential(scale(0.5 * N, c.l)), F))
    c = _push_of_step(block, i, n)
    N = _reaction(c, width, carried)
    _add_reaction(block, i, n, N / h)
    v, l = minus(load3(block, at.v, i), W), dot(load9(block, at.A, i), inverse(F))
    slip = scale_vector(h, _slip(v, l, c.r, n))
    way, turn = _with_friction(block, i, c, N, mu * (N + carried), slip, (0.0, 0.0, 0.0), ZERO)
    F = dot(group_exponential(turn), F)
    _set_shape(block, i, F)
    store9(block, at.A, i, dot(l, F))
    return plus(x, way)


def _reaction(c: Push, width: float, carried: float) -> float:
    """Return the reaction over μ_f and time that widens the gap, less if the body would turn by too much.

    A wall does not pull: with ``carried``, the reaction already in the step, it is not negative.
    """
    N = max(width / c.rate, -carried)
    most = abs(N) * max(norm(c.l[:3]), norm(c.l[3:6]), norm(c.l[6:]))
    return float(N * min(1.0, _MOST_TURN / (most + 1e-300)))


def reaction_on(block: Block, i: int, n: Vector) -> float:
    """Return the reaction over μ_f, m²/s, of a wall of normal n on lane i in the step."""
    N = 0.0
    for k in range(3):
        same = inner(load3(block, at.contact_normal + 3 * k, i), n) > SAME_NORMAL
        N += block[(at.reaction + k) * LANES + i] if same else 0.0
    return N


def carries_reaction(block: Block, i: int) -> bool:
    """Return whether lane i carries a reaction of any wall in the step."""
    x, y, z = load3(block, at.reaction, i)
    return bool(x + y + z > 0.0)


def _add_reaction(block: Block, i: int, n: Vector, N: float) -> None:
    """Add to the reaction of the wall of normal n, of up to three."""
    for k in range(3):
        same = inner(load3(block, at.contact_normal + 3 * k, i), n) > SAME_NORMAL
        if same or block[(at.reaction + k) * LANES + i] == 0.0:
            block[(at.reaction + k) * LANES + i] += N
            store3(block, at.contact_normal + 3 * k, i, n)
            return


def _set_shape(block: Block, i: int, F: Tensor) -> None:
    """Store the shape of lane i."""
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


@separate
def push_solid(block: Block, i: int, n: Vector, x: Vector, width: float, mu: float, W: Vector) -> Vector:
    """Do so with a body with inertia, and stop its point of contact; a flat one is only moved and stopped."""
    R = block[at.R * LANES + i]
    if reach(R, load9(block, at.F, i), n) < _FLATTEST * R:
        v = minus(load3(block, at.v, i), W)
        store3(block, at.v, i, plus(W, rebound_velocity(v, n, 0.0, 0.0)))
        return plus_scaled(x, width, n)
    x = push_along_mobility(block, i, n, x, width, mu, W)
    c, F = _push_of_step(block, i, n), load9(block, at.F, i)
    v, l = minus(load3(block, at.v, i), W), dot(load9(block, at.A, i), inverse(F))
    P = -min(speed_at(v, l, c.r, n), 0.0) / c.rate
    v, l = _with_friction(block, i, c, P, mu * P, _slip(v, l, c.r, n), v, l)
    store3(block, at.v, i, plus(v, W))
    store9(block, at.A, i, dot(l, F))
    return x


def _push_of_step(block: Block, i: int, n: Vector) -> Push:
    return unstrained_if_hindered(block, i, n, push_of(block, i, n, block[at.dt * LANES + i]))


def unstrained_if_hindered(block: Block, i: int, n: Vector, c: Push) -> Push:
    """Return the push of lane i, without strain where a wall hinders the body: its load has strained it."""
    if is_strained_by_load(block, i):
        l = skew(c.l)
        return Push(c.v, l, c.r, speed_at(c.v, l, c.r, n))
    return c


def _slip(v: Vector, l: Tensor, r: Vector, n: Vector) -> Vector:
    """Return the velocity of the point at r along a wall of normal n, m/s."""
    w = plus(v, dot_vector(l, r))
    return plus_scaled(w, -inner(w, n), n)


def _with_friction(
    block: Block, i: int, c: Push, N: float, most: float, slip: Vector, v: Vector, l: Tensor
) -> tuple[Vector, Tensor]:
    """Return v and l with the push by N, and by friction of up to ``most`` against the slip."""
    v, l = plus_scaled(v, N, c.v), add(l, scale(N, c.l))
    if most <= 0.0:
        return v, l
    size, Q = norm(slip), load9(block, at.frame, i)
    t = push_at(block, i, Q, scale_vector(-1.0 / (size + 1e-300), slip), c.r, block[at.dt * LANES + i])
    T = min(most, size / (t.rate + 1e-300))
    return plus_scaled(v, T, t.v), add(l, scale(T, t.l))
