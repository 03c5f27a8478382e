"""Integrator ``rosenbrock``: with inertia of the solid, of order 3(2), linearly implicit.

The formulas are those of :mod:`foamprb.body.inertial_runge_kutta` and :mod:`foamprb.body.inertial_path`.
The shape's unknowns are F and l_s = A F⁻¹. Vectors and tensors of a step are components in the particle
frame of its start; those of the path are so in a frame along which drag is diagonal, another near walls.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.drag import drag
from foamprb.body.error_control import (
    FLUID_SHARE,
    chord_error,
    largest,
    parabola_error,
    relative_size,
    strain_scale,
)
from foamprb.body.exponential_runge_kutta import NODE, algebra_excess, group_exponential
from foamprb.body.inertial_path import NOTHING, Motion, first_motion, fluid_changes, last_motion
from foamprb.body.inertial_path import respond as respond_in_path
from foamprb.body.inertial_path import second_order as path_of_second_order
from foamprb.body.inertial_path import slope as slope_of_path
from foamprb.body.inertial_path import third_order as path_of_third_order
from foamprb.body.inertial_runge_kutta import (
    Pair,
    combine,
    fluid_change,
    over_b,
    resolvent,
    turning_acceleration,
)
from foamprb.body.inertial_runge_kutta import first_argument as quarter_argument
from foamprb.body.inertial_runge_kutta import last_argument as end_argument
from foamprb.body.inertial_runge_kutta import second_order as of_second_order
from foamprb.body.inertial_runge_kutta import slope as slope_of
from foamprb.body.inertial_runge_kutta import third_order as of_third_order
from foamprb.body.material import finger_of_body_in_frame, viscous_stress
from foamprb.body.rosenbrock import Elasticity, Stiffness, inertial_stiffness, relaxation_rate
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    between,
    det,
    dot,
    dot_vector,
    from_frame,
    inner,
    minus,
    plus,
    plus_scaled,
    scale,
    scale_vector,
    select,
    to_frame,
    transpose,
    vector_dot,
)
from foamprb.body.traction import traction
from foamprb.cloud.block import (
    Medium,
    Switches,
    at,
    choose,
    choose3,
    load3,
    load4,
    load9,
    load_integrals,
    store3,
    store4,
    store9,
    viscosity_at,
)
from foamprb.cloud.elastic import conservative_stress, solid_elasticity
from foamprb.cloud.forces import acceleration
from foamprb.cloud.integrators.adaptive import (
    ADAPTIVE,
    acceleration_at_end,
    choose_order,
    correct_path,
    counted_error,
    drag_rate,
    during,
    end_acceleration,
    error_share,
    first_slope,
    fluid_acceleration,
    judge_difference,
    keep_frame,
    last_argument,
    mark_disturbed,
    predict,
    second_slope,
    store_path_error,
    third_slope,
    track_adaptive,
    update_discount,
)
from foamprb.cloud.integrators.base import Integrator, lifted
from foamprb.cloud.layout import LANES, Block, Row, layout, offsets
from foamprb.cloud.motion import STOPS_AT_CONTACT, rewind
from foamprb.cloud.paths import RecordedRows
from foamprb.cloud.pressing import (
    approach,
    inertia_of_solid,
    inertia_over,
    push_out,
    push_solid,
    redirect,
    redirect_solid,
    rigid_speed_at_contact,
)
from foamprb.compile.link import traced


@choice
def resist(_block: Block, _i: int, rate: Vector, w: Vector) -> Vector:
    """Return the deceleration by drag at the slip w with the rates μ_f K/m, 1/s, in the particle frame, m/s².

    A surrounding that hinders motion replaces this and the next three functions.
    """
    return rate[0] * w[0], rate[1] * w[1], rate[2] * w[2]


@choice
def find_drag_axes(_block: Block, _i: int, Q: Tensor, rate: Vector) -> tuple[Tensor, Vector]:
    """Return the frame in which the drag at the start of a step is diagonal, and its rates there: Q's."""
    return Q, rate


@choice
def drag_axes(_block: Block, _i: int, Q: Tensor) -> Tensor:
    """Return the frame of :func:`find_drag_axes` in later stages; Q is the particle frame at the start."""
    return Q


@choice
def leave_gradient(_block: Block, _i: int, _Q: Tensor, _l_s: Tensor, _wanted: Any) -> None:
    """No-op: no surrounding reads l_s before A is computed."""


class StiffnessRows(NamedTuple):
    """Rows that later stages read: the state at the start, and its stiffness."""

    G: Annotated[int, Row(9, "1", "Q·F at the start")]
    b_e: Annotated[int, Row(9, "1", "elastic b_e")]
    l_s: Annotated[int, Row(9, "1/s", "the body's velocity gradient")]
    l_t: Annotated[int, Row(9, "1/s2", "its rate")]
    b: Annotated[int, Row(3, "1", "λ_a²")]
    traction: Annotated[int, Row(9, "1/s", "how the traction's normal stresses resist stretching")]
    traction_pairs: Annotated[int, Row(12, "1/s", "how its shear stresses do, 23, 13 and 12")]
    elastic: Annotated[int, Row(9, "1/s2", "how the elastic normal stresses resist strain")]
    elastic_pairs: Annotated[int, Row(6, "1/s2", "how the elastic shear stresses do, 23, 13 and 12")]
    weight: Annotated[int, Row(1, "1/s", "5 J μ_f/(ρ_s R²)")]
    deficit: Annotated[int, Row(1, "1", "1 − η_s/μ_f")]
    change: Annotated[int, Row(9, "1/s2", "change of dl_s/dt by that of the fluid's gradient over the step")]
    turning: Annotated[int, Row(9, "1/s3", "rate of change of dl_s/dt by turning")]
    Omega: Annotated[int, Row(9, "1", "Ω of the shape that is evaluated")]
    dl: Annotated[int, Row(9, "1/s", "change of l_s there")]
    slope_Omega: Annotated[int, Row(9, "1/s", "slope of what is not stiff of dΩ/dt, per step")]
    slope_l: Annotated[int, Row(9, "1/s2", "the same of dl_s/dt")]
    second_Omega: Annotated[int, Row(9, "1", "Ω of order 2")]
    second_l: Annotated[int, Row(9, "1/s", "change of l_s of order 2")]
    rate: Annotated[int, Row(3, "1/s", "rates of drag")]
    first_v: Annotated[int, Row(3, "m/s", "velocity")]
    first_vt: Annotated[int, Row(3, "m/s2", "its rate")]
    drag_change: Annotated[int, Row(3, "m/s2", "change of the drag by that of the fluid's velocity")]
    drag_bend: Annotated[int, Row(3, "m/s2", "the part of it quadratic in time")]
    dv: Annotated[int, Row(3, "m/s", "change of v there")]
    slope_v: Annotated[int, Row(3, "m/s2", "slope of what is not stiff of dv/dt, per step")]
    second_x: Annotated[int, Row(3, "m", "way of order 2")]
    second_v: Annotated[int, Row(3, "m/s", "change of v of order 2")]


work = offsets(StiffnessRows)


@choice
def with_fading(
    _block: Block, _i: int, turning: Tensor, _n: Stiffness, _e: Elasticity, _G: Tensor, _c: Any
) -> Tensor:
    """Return the rate of change of dl_s/dt by turning as it is: the solid has no memory that fades."""
    return turning


@traced
def predict_inertial(block: Block, medium: Medium) -> None:
    """Compute velocity and its rate at the start, and the position they predict with drag."""
    for i in range(LANES):
        h, Q = block[at.dt * LANES + i], load9(block, at.Q, i)
        v, x = load3(block, at.v, i), load3(block, at.x, i)
        v_t, rate = _acceleration(block, i, medium, v)
        Q, rate = find_drag_axes(block, i, Q, rate)
        a_u = dot_vector(Q, fluid_acceleration(block, i, v))
        start = (dot_vector(Q, v), dot_vector(Q, v_t))
        by_fluid = (h * rate[0] * a_u[0], h * rate[1] * a_u[1], h * rate[2] * a_u[2])
        way, _ = respond_in_path(rate, h, start, (NOTHING[0], by_fluid), NOTHING)
        way = vector_dot(way, Q)
        store3(block, at.new_x, i, plus(x, way))
        # The parabola from the start with the velocity v to that place.
        f = 2.0 / (h * h)
        bend = (f * (way[0] - h * v[0]), f * (way[1] - h * v[1]), f * (way[2] - h * v[2]))
        store3(block, during.start_v, i, v)
        store3(block, during.start_a, i, bend)
        store3(block, work.rate, i, rate)
        store3(block, work.first_v, i, start[0])
        store3(block, work.first_vt, i, start[1])


@traced
def first_inertial(block: Block, medium: Medium) -> None:
    """Compute the state at the start, its stiffness, and the state at a quarter of the step.

    The shape's unknowns are F and l_s = A F⁻¹, with dF/dt = l_s F and dl_s/dt = Ȧ F⁻¹ − l_s l_s: the traction
    depends on l_s, so that what is stiff in l_s does not reappear in F.
    """
    for i in range(LANES):
        h, c = block[at.dt * LANES + i], block[at.inertia * LANES + i]
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        F, A = load9(block, at.F, i), load9(block, at.A, i)
        # Of the flow, and with the surroundings.
        l, l_end, felt = load9(block, during.start_l, i), load9(block, during.end_l, i), load9(block, at.l, i)
        mark_disturbed(block, i)
        block[at.fluid * LANES + i] = viscosity_at(block, i, medium)
        G = dot(Q, F)
        # A F⁻¹ = A Fᵀ b⁻¹, with a diagonal b in the particle frame.
        L = over_b(_squares(stretches), dot(dot(Q, A), transpose(G)))
        b_e = finger_of_body_in_frame(stretches, G, load9(block, at.M, i))
        l_t, tau = _shape_rate(block, i, viscosity_at(block, i, medium), L, b_e)
        e = solid_elasticity(block, i, stretches, b_e)
        n = inertial_stiffness(stretches, g, e, c, viscosity_at(block, i, medium), block[at.eta * LANES + i])
        dl = add(l_end, scale(-1.0, l))
        change = fluid_change(n, to_frame(Q, dl))
        turning = turning_acceleration(stretches, n, c, L, l_t, to_frame(Q, felt), tau)
        turning = with_fading(block, i, turning, n, e, G, c)
        shape = quarter_argument(n, resolvent(n, NODE * h), h, (L, l_t), change, turning)
        _set_shape(block, i, Q, G, shape)
        leave_gradient(block, i, Q, add(L, shape[1]), block[at.moving * LANES + i] > 0.0)
        store9(block, during.start_Q, i, Q)
        store9(block, work.G, i, G)
        store9(block, work.b_e, i, b_e)
        store9(block, work.l_s, i, L)
        store9(block, work.l_t, i, l_t)
        _store_stiffness(block, i, n)
        store9(block, work.change, i, change)
        store9(block, work.turning, i, turning)

        v, u, u_end = load3(block, at.v, i), load3(block, during.start_u, i), load3(block, during.end_u, i)
        rate, start = (
            load3(block, work.rate, i),
            (load3(block, work.first_v, i), load3(block, work.first_vt, i)),
        )
        P = drag_axes(block, i, Q)
        du = minus(u_end, u)
        a_u = _fluid_slope(block, i, h, v, du)
        changes = fluid_changes(rate, h, dot_vector(P, du), dot_vector(P, a_u))
        moved = first_motion(rate, h, start, *changes)
        _set_motion(block, i, P, moved)
        x, way = load3(block, at.x, i), vector_dot(moved[0], P)
        store3(block, at.new_x, i, plus(x, way))
        store3(block, work.drag_change, i, changes[0])
        store3(block, work.drag_bend, i, changes[1])

        # The fluid there follows from the parabola; its acceleration is linear between start and end.
        p, q = NODE - NODE * NODE, NODE * NODE
        a = between(load3(block, at.DuDt, i), end_acceleration(block, i), NODE)
        block[at.gone * LANES + i] = NODE
        store3(block, at.u, i, plus_scaled(plus_scaled(u, p * h, a_u), q, du))
        store9(block, at.l, i, add(l, scale(NODE, dl)))
        store3(block, at.DuDt, i, a)


@traced
def second_inertial(block: Block, medium: Medium, tolerance: float) -> None:
    """Compute slopes at a quarter of the step and the solution of order 2, and choose the order."""
    for i in range(LANES):
        h, Q0 = block[at.dt * LANES + i], load9(block, during.start_Q, i)
        n, start = _load_stiffness(block, i), (load9(block, work.l_s, i), load9(block, work.l_t, i))
        b_e, change = load9(block, work.b_e, i), load9(block, work.change, i)
        rates = _rates(block, i, medium, Q0, start[0])
        k = slope_of(n, _argument(block, i), rates, start, scale(NODE, change), 1.0 / NODE)
        share = error_share(block, i, relaxation_rate(n))
        two, estimate = of_second_order(n, resolvent(n, h), h, start, change, k, (share, FLUID_SHARE))
        error_2 = 0.5 * h * _size(estimate, h, b_e, strain_scale(b_e, two[0]))
        size = counted_error(block, i, error_2)
        store9(block, work.slope_Omega, i, k[0])
        store9(block, work.slope_l, i, k[1])
        store9(block, work.second_Omega, i, two[0])
        store9(block, work.second_l, i, two[1])

        rate, moving, changes = _load_drag(block, i)
        seen = _fluid_share(changes, NODE)
        P = drag_axes(block, i, Q0)
        forced = _forced(block, i, medium, P)
        kv = slope_of_path(rate, load3(block, work.dv, i), forced, moving[1], seen, 1.0 / NODE)
        path = path_of_second_order(rate, h, moving, *changes, kv)
        by_forces = respond_in_path(rate, h, NOTHING, kv, NOTHING)
        size = np.maximum(size, _length(by_forces, h, _way(block, i)))
        choose_order(block, i, size, tolerance)
        store3(block, work.slope_v, i, kv[1])
        store3(block, work.second_x, i, path[0])
        store3(block, work.second_v, i, path[1])

        store9(block, during.second_Q, i, load9(block, at.Q, i))
        F, A, J = _new_shape(block, i, Q0, start[0], two)
        x, v = _new_motion(block, i, P, path)
        store9(block, at.new_F, i, F)
        store9(block, at.new_A, i, A)
        block[at.J * LANES + i] = J
        store3(block, at.new_x, i, x)
        store3(block, at.new_v, i, v)


@traced
def last_inertial(block: Block, medium: Medium) -> None:  # noqa: ARG001
    """Compute the state for the evaluation at the end, in lanes of order 3."""
    for i in range(LANES):
        h, Q0 = block[at.dt * LANES + i], load9(block, during.start_Q, i)
        third = block[during.third * LANES + i] > 0.0
        n, start = _load_stiffness(block, i), (load9(block, work.l_s, i), load9(block, work.l_t, i))
        k = load9(block, work.slope_Omega, i), load9(block, work.slope_l, i)
        change, turning = load9(block, work.change, i), load9(block, work.turning, i)
        bend = _bend(block, i, n, Q0)
        shape = end_argument(n, resolvent(n, h), h, start, change, bend, k, turning)
        F = load9(block, at.new_F, i)
        _set_shape(block, i, Q0, load9(block, work.G, i), shape)
        store9(block, at.new_F, i, choose(third, load9(block, at.new_F, i), F))
        leave_gradient(block, i, Q0, add(start[0], shape[1]), third)

        rate, moving, changes = _load_drag(block, i)
        v = load3(block, at.new_v, i)
        slope = (NOTHING[0], load3(block, work.slope_v, i))
        P = drag_axes(block, i, Q0)
        _set_motion(block, i, P, last_motion(rate, h, moving, *changes, slope))
        store3(block, at.new_v, i, choose3(third, load3(block, at.new_v, i), v))
        block[at.gone * LANES + i] = 1.0
        store3(block, at.u, i, load3(block, during.end_u, i))
        store9(block, at.l, i, load9(block, during.end_l, i))
        store3(block, at.DuDt, i, end_acceleration(block, i))


@traced
def third_inertial(block: Block, medium: Medium, tolerance: float) -> None:
    """Compute slopes at the end and the solution of order 3."""
    for i in range(LANES):
        h, Q0 = block[at.dt * LANES + i], load9(block, during.start_Q, i)
        third = block[during.third * LANES + i] > 0.0
        n, start = _load_stiffness(block, i), (load9(block, work.l_s, i), load9(block, work.l_t, i))
        b_e, change = load9(block, work.b_e, i), load9(block, work.change, i)
        k = load9(block, work.slope_Omega, i), load9(block, work.slope_l, i)
        last = slope_of(n, _argument(block, i), _rates(block, i, medium, Q0, start[0]), start, change, 1.0)
        bend = _bend(block, i, n, Q0)
        three = of_third_order(n, resolvent(n, h), h, start, change, bend, k, last)
        two = load9(block, work.second_Omega, i), load9(block, work.second_l, i)
        strain = strain_scale(b_e, two[0])
        difference = _size(combine(1.0, three, -1.0, two), h, b_e, strain)
        update_discount(block, i, third, difference, tolerance)

        rate, moving, changes = _load_drag(block, i)
        P = drag_axes(block, i, Q0)
        slope = (NOTHING[0], load3(block, work.slope_v, i))
        forced = _forced(block, i, medium, P)
        end = slope_of_path(rate, load3(block, work.dv, i), forced, moving[1], changes[0], 1.0)
        path = path_of_third_order(rate, h, moving, *changes, slope, end)
        x2, v2 = load3(block, work.second_x, i), load3(block, work.second_v, i)
        miss = minus(path[0], x2), minus(path[1], v2)
        difference = np.maximum(difference, _length(miss, h, _way(block, i)))
        F, A, J = _new_shape(block, i, Q0, start[0], three)
        store9(block, at.new_F, i, choose(third, F, load9(block, at.new_F, i)))
        store9(block, at.new_A, i, choose(third, A, load9(block, at.new_A, i)))
        block[at.J * LANES + i] = select(third, J, block[at.J * LANES + i])
        x, v = _new_motion(block, i, P, path)
        store3(block, at.new_x, i, choose3(third, x, load3(block, at.new_x, i)))
        store3(block, at.new_v, i, choose3(third, v, load3(block, at.new_v, i)))
        keep_frame(block, i, third)
        judge_difference(block, i, select(third, difference, 0.0), tolerance)


@traced
def correct_inertial(block: Block) -> None:
    """Lead the parabola of the fluid's velocity through the velocity in the middle of the step.

    The path is linear in that velocity.
    """
    for i in range(LANES):
        h, P = block[at.dt * LANES + i], drag_axes(block, i, load9(block, during.start_Q, i))
        rate, _, changes = _load_drag(block, i)
        du = dot_vector(P, minus(load3(block, during.middle_u, i), load3(block, during.start_u, i)))
        bend = scale_vector(
            4.0, minus((rate[0] * du[0], rate[1] * du[1], rate[2] * du[2]), _fluid_share(changes, 0.5))
        )
        more = respond_in_path(rate, h, NOTHING, (NOTHING[0], bend), (NOTHING[0], scale_vector(-2.0, bend)))
        x, v = load3(block, at.new_x, i), load3(block, at.new_v, i)
        store3(block, at.new_x, i, plus(x, vector_dot(more[0], P)))
        store3(block, at.new_v, i, plus(v, vector_dot(more[1], P)))


def rewind_inertial(block: Block, i: int, f: float) -> None:
    """Set the shape in lane i to that after the fraction f of the finished step, on Hermite's cubic."""
    Q, h = load9(block, during.start_Q, i), block[at.dt * LANES + i]
    G, L = load9(block, work.G, i), load9(block, work.l_s, i)
    F0, A0 = dot(transpose(Q), G), dot(transpose(Q), dot(L, G))
    D = add(load9(block, at.F, i), scale(-1.0, F0))
    a, b = add(scale(h, A0), scale(-1.0, D)), add(scale(h, load9(block, at.A, i)), scale(-1.0, D))
    g = 1.0 - f
    store9(block, at.F, i, add(F0, add(scale(f, D), add(scale(f * g * g, a), scale(-f * f * g, b)))))
    slope = add(D, add(scale(g * (1.0 - 3.0 * f), a), scale(-f * (2.0 - 3.0 * f), b)))
    store9(block, at.A, i, scale(1.0 / h, slope))


def approach_of_point(block: Block, i: int, n: Vector) -> tuple[float, float]:
    """Return the speeds along n of the point of contact of lane i at start and end of a step, m/s.

    They are those of a rigid body, which a bounce reverses: a strain that presses it on is no approach.
    """
    Q, F, A = load9(block, during.start_Q, i), load9(block, at.F, i), load9(block, at.A, i)
    F0, l0 = dot(transpose(Q), load9(block, work.G, i)), from_frame(Q, load9(block, work.l_s, i))
    start = rigid_speed_at_contact(block, i, load3(block, at.new_v, i), F0, dot(l0, F0), n)
    return start, rigid_speed_at_contact(block, i, load3(block, at.v, i), F, A, n)


def _shape_rate(block: Block, i: int, mu_f: float, L: Tensor, b_e: Tensor) -> tuple[Tensor, Tensor]:
    """Return dl_s/dt = Ȧ F⁻¹ − l_s l_s, Ȧ Fᵀ = c (J(σ̃ − σ_v) − τ) (33), 1/s², and τ, Pa, in its frame.

    Parameters
    ----------
    L
        The body's velocity gradient, 1/s.
    b_e
        Elastic b_e.
    """
    Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
    J = stretches[0] * stretches[1] * stretches[2]
    tau = conservative_stress(block, i, stretches, b_e, J)
    c = block[at.inertia * LANES + i]
    solid = add(scale(-c, tau), scale(-c * J, viscous_stress(L, block[at.eta * LANES + i])))
    fluid = scale(c * J * mu_f, traction(stretches, g, to_frame(Q, load9(block, at.l, i)), L))
    return add(over_b(_squares(stretches), add(fluid, solid)), scale(-1.0, dot(L, L))), tau


def _squares(v: Vector) -> Vector:
    return v[0] * v[0], v[1] * v[1], v[2] * v[2]


def _rates(block: Block, i: int, medium: Medium, Q0: Tensor, l_s: Tensor) -> Pair:
    """Return the rate of Ω less l_s, 1/s, and the rate of l_s, 1/s², of the evaluated state."""
    Q, L = load9(block, at.Q, i), add(l_s, load9(block, work.dl, i))
    G = dot(Q, load9(block, at.new_F, i))
    turn = dot(Q, transpose(Q0))
    b_e = finger_of_body_in_frame(load3(block, at.stretch, i), G, load9(block, at.M, i))
    rate, _ = _shape_rate(block, i, viscosity_at(block, i, medium), to_frame(turn, L), b_e)
    return algebra_excess(load9(block, work.Omega, i), L), from_frame(turn, rate)


def _argument(block: Block, i: int) -> Pair:
    """Return Ω and the change of l_s of the evaluated state."""
    return load9(block, work.Omega, i), load9(block, work.dl, i)


def _set_shape(block: Block, i: int, Q: Tensor, G: Tensor, shape: Pair) -> None:
    """Store the shape to be evaluated."""
    store9(block, work.Omega, i, shape[0])
    store9(block, work.dl, i, shape[1])
    store9(block, at.new_F, i, dot(transpose(Q), dot(group_exponential(shape[0]), G)))


def _set_motion(block: Block, i: int, Q: Tensor, moved: Motion) -> None:
    """Store the displacement to the position to be evaluated, and the velocity there."""
    v, dv = load3(block, at.v, i), vector_dot(moved[1], Q)
    store3(block, work.dv, i, moved[1])
    store3(block, at.new_v, i, plus(v, dv))


def _new_shape(block: Block, i: int, Q: Tensor, l_s: Tensor, end: Pair) -> tuple[Tensor, Tensor, Any]:
    """Return F, A and J at the end of the step."""
    G = dot(group_exponential(end[0]), load9(block, work.G, i))
    F = dot(transpose(Q), G)
    return F, dot(transpose(Q), dot(add(l_s, end[1]), G)), det(F)


def _new_motion(block: Block, i: int, Q: Tensor, end: Motion) -> tuple[Vector, Vector]:
    """Return position and velocity at the end of the step."""
    x, v = load3(block, at.x, i), load3(block, at.v, i)
    return plus(x, vector_dot(end[0], Q)), plus(v, vector_dot(end[1], Q))


def _forced(block: Block, i: int, medium: Medium, Q: Tensor) -> Vector:
    """Return the rate of the velocity in the evaluated state, m/s²."""
    v_t, _ = _acceleration(block, i, medium, load3(block, at.new_v, i))
    return dot_vector(Q, v_t)


def _acceleration(block: Block, i: int, medium: Medium, v: Vector) -> tuple[Vector, Vector]:
    """Return the acceleration (34) of the body in the block at velocity v, m/s², and drag's rates, 1/s.

    The rates are those without walls, along the particle's axes.
    """
    Q, stretches, u = load9(block, at.Q, i), load3(block, at.stretch, i), load3(block, at.u, i)
    a, inertia = acceleration(block, i, medium, stretches[0] * stretches[1] * stretches[2])
    r = drag_rate(block, i, viscosity_at(block, i, medium), drag(stretches, load_integrals(block, i)))
    rate = scale_vector(1.0 / inertia, r)
    a_D = vector_dot(resist(block, i, rate, dot_vector(Q, minus(u, v))), Q)
    return plus(lifted(block, i, medium, a, v, rate, inertia), a_D), rate


def _fluid_share(changes: tuple[Vector, Vector], s: float) -> Vector:
    """Return the change of dv/dt by that of the fluid's velocity after the share s of the step, m/s²."""
    (x, y, z), (p, q, r) = changes
    c = s * s - s
    return s * x + c * p, s * y + c * q, s * z + c * r


def _fluid_slope(block: Block, i: int, h: Scalar, v: Vector, du: Vector) -> Vector:
    """Return the initial rate of the fluid's velocity, m/s², by parabola or chord, whichever has less error.

    Stores that error.

    Parameters
    ----------
    h
        The step, s.
    v
        Velocity of the body, m/s.
    du
        Change of the fluid's over the step, m/s.
    """
    a_u, bend, way = fluid_acceleration(block, i, v), load3(block, during.start_a, i), _way(block, i)
    # The fluid at the end, with the slip of the body as it is or as it is predicted. Thus the jumps of the
    # fluid's velocity between cells, which u_t leaves out and a lagging body does not follow, do not count.
    u, u_end = load3(block, during.start_u, i), load3(block, during.end_u, i)
    with_slip = minus(plus(u_end, v), u)
    a_end = acceleration_at_end(block, i, plus_scaled(with_slip, h, minus(bend, a_u)))
    chord = np.minimum(
        chord_error(h, way, a_u, a_end), chord_error(h, way, a_u, acceleration_at_end(block, i, with_slip))
    )
    straight = chord < parabola_error(h, way, du, a_u, a_end)
    # The body as it starts: a bent path counts for more than the parabola is off by, so that steps are short
    # enough for forces that change along it, too.
    parabola = parabola_error(h, way, du, a_u, acceleration_at_end(block, i, v))
    # NaN is not less, and stays NaN.
    store_path_error(block, i, select(chord < parabola, chord, parabola))
    return choose3(straight, scale_vector(1.0 / h, du), a_u)


def _way(block: Block, i: int) -> Scalar:
    """Return the scale of path errors: the way of the fluid or of the body plus the radius, m."""
    h, v, u = block[at.dt * LANES + i], load3(block, at.v, i), load3(block, during.end_u, i)
    return h * np.sqrt(np.maximum(inner(v, v), inner(u, u))) + block[at.R * LANES + i]


def _size(v: Pair, h: Scalar, b_e: Tensor, strain: Scalar) -> Scalar:
    """Return the size of a small difference of two shapes; a difference of l_s counts times h."""
    return np.maximum(relative_size(v[0], b_e, strain), h * largest(v[1]))


def _length(m: Motion, h: Scalar, way: Scalar) -> Scalar:
    """Return the size of a small difference of two positions and velocities, over the way."""
    x, v = m
    return np.sqrt(np.maximum(inner(x, x), h * h * inner(v, v))) / way


def _bend(block: Block, i: int, n: Stiffness, Q: Tensor) -> Tensor:
    """Return the part of dl_s/dt that is quadratic in time, from that of the fluid's gradient, 1/s²."""
    l, middle, l_end = (
        load9(block, during.start_l, i),
        load9(block, during.middle_l, i),
        load9(block, during.end_l, i),
    )
    return fluid_change(n, to_frame(Q, scale(2.0, add(add(l, l_end), scale(-2.0, middle)))))


def _store_stiffness(block: Block, i: int, n: Stiffness) -> None:
    store3(block, work.b, i, n.b)
    store9(block, work.traction, i, n.traction)
    p, q, r = n.traction_pairs
    store4(block, work.traction_pairs, i, p)
    store4(block, work.traction_pairs + 4, i, q)
    store4(block, work.traction_pairs + 8, i, r)
    store9(block, work.elastic, i, n.elastic)
    (p0, p1), (q0, q1), (r0, r1) = n.elastic_pairs
    store3(block, work.elastic_pairs, i, (p0, p1, q0))
    store3(block, work.elastic_pairs + 3, i, (q1, r0, r1))
    block[work.weight * LANES + i] = n.weight
    block[work.deficit * LANES + i] = n.deficit


def _load_drag(block: Block, i: int) -> tuple[Vector, Motion, tuple[Vector, Vector]]:
    """Return rates of drag, velocity and its rate at the start, and changes by the fluid's velocity."""
    moving = load3(block, work.first_v, i), load3(block, work.first_vt, i)
    return (
        load3(block, work.rate, i),
        moving,
        (load3(block, work.drag_change, i), load3(block, work.drag_bend, i)),
    )


def _load_stiffness(block: Block, i: int) -> Stiffness:
    p, q, r = (
        load4(block, work.traction_pairs, i),
        load4(block, work.traction_pairs + 4, i),
        load4(block, work.traction_pairs + 8, i),
    )
    (p0, p1, q0), (q1, r0, r1) = load3(block, work.elastic_pairs, i), load3(block, work.elastic_pairs + 3, i)
    return Stiffness(
        b=load3(block, work.b, i),
        traction=load9(block, work.traction, i),
        traction_pairs=(p, q, r),
        elastic=load9(block, work.elastic, i),
        elastic_pairs=((p0, p1), (q0, q1), (r0, r1)),
        weight=block[work.weight * LANES + i],
        deficit=block[work.deficit * LANES + i],
    )


ROSENBROCK = Integrator(
    name="rosenbrock",
    description="with inertia, third order, implicit in elasticity and traction",
    order=3,
    track=track_adaptive,
    layout=layout(at, during, work),
    recorded=RecordedRows(during.start_Q, during.start_l, at.A, in_frame=False, end_l=during.end_l),
    slots={
        **ADAPTIVE,
        predict: predict_inertial,
        first_slope: first_inertial,
        second_slope: second_inertial,
        last_argument: last_inertial,
        third_slope: third_inertial,
        correct_path: correct_inertial,
        rewind: rewind_inertial,
        inertia_over: inertia_of_solid,
        approach: approach_of_point,
        redirect: redirect_solid,
        push_out: push_solid,
    },
    switches=Switches(bouncing=STOPS_AT_CONTACT),
    adaptive=True,
)
