"""Integrator ``stokes``: without inertia of the shape, of order 3(2), exactly incompressible.

The formulas are those of :mod:`foamprb.body.exponential_runge_kutta`. The shape's only unknown is F; its
rate is that of the balance of forces in the state. The barycentre follows the flow and slips through it
as far as drag balances the forces and, to first order, its own inertia (:mod:`foamprb.body.slip`).
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

from foamprb.body.choice import choice
from foamprb.body.drag import drag
from foamprb.body.error_control import FLUID_SHARE, relative_size, strain_scale
from foamprb.body.exponential_runge_kutta import NODE, algebra_rate, group_exponential
from foamprb.body.exponential_runge_kutta import first_argument as quarter_argument
from foamprb.body.exponential_runge_kutta import last_argument as end_argument
from foamprb.body.exponential_runge_kutta import second_order as of_second_order
from foamprb.body.exponential_runge_kutta import slope as slope_of
from foamprb.body.exponential_runge_kutta import third_order as of_third_order
from foamprb.body.material import MATERIALS, finger_of_body_in_frame
from foamprb.body.relaxation import Relaxation, Response, fastest, relaxation, relaxing, responses
from foamprb.body.rosenbrock import Elasticity
from foamprb.body.slip import balanced_slip
from foamprb.body.stokes import Mobility, isochoric, velocity_gradient
from foamprb.body.tensor import (
    ZERO,
    Scalar,
    Tensor,
    Vector,
    add,
    between,
    det,
    diagonal,
    dot,
    from_frame,
    minus,
    plus,
    plus_scaled,
    scale,
    scale_vector,
    select,
    to_frame,
    transpose,
)
from foamprb.body.turning import commutator, turning_gradient
from foamprb.cloud.block import (
    Medium,
    Switches,
    at,
    choose,
    choose3,
    load3,
    load9,
    load_integrals,
    store3,
    store9,
    viscosity_at,
)
from foamprb.cloud.elastic import (
    body_mobility,
    incompressible_elasticity,
    incompressible_stress,
    mobility_deficit,
    with_tension,
)
from foamprb.cloud.forces import forces_on
from foamprb.cloud.integrators.adaptive import (
    ADAPTIVE,
    acceleration_at_end,
    add_disturbance_error,
    apply_reactions,
    choose_order,
    correct_path,
    counted_error,
    drag_rate,
    during,
    end_acceleration,
    end_slope,
    error_share,
    find_reactions,
    finish_path,
    first_slope,
    fluid_acceleration,
    judge_difference,
    keep_frame,
    last_argument,
    mark_disturbed,
    place_after,
    predict,
    second_slope,
    third_slope,
    track_adaptive,
    update_discount,
)
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Block, Row, layout, offsets
from foamprb.cloud.paths import RecordedRows
from foamprb.cloud.pressing import push_along_mobility, push_out
from foamprb.cloud.reactions import add_reactions, balance_walls, free_motion
from foamprb.compile.link import traced


class RelaxationRows(NamedTuple):
    """Rows that later stages read: the state at the start in its frame, and its relaxation."""

    start_slip: Annotated[int, Row(3, "m/s", "velocity relative to the fluid at the start")]
    end_slip: Annotated[int, Row(3, "m/s", "the same in the fluid at the end, of the shape at the start")]
    disturbance: Annotated[int, Row(3, "m/s", "what the surroundings add to the flow's velocity")]
    l_s: Annotated[int, Row(9, "1/s", "the body's velocity gradient")]
    b_e: Annotated[int, Row(9, "1", "elastic b_e")]
    normal: Annotated[int, Row(9, "1", "d_s,aa for unit changes of the normal stresses over μ_f")]
    compliance: Annotated[int, Row(3, "1", "d_s,ab for unit changes of the shear stresses over μ_f")]
    slip: Annotated[int, Row(3, "1", "(b² − c²)/(b² + c²) and its cyclic companions")]
    upper: Annotated[int, Row(3, "1/s", "relaxation of the components 23, 13 and 12")]
    lower: Annotated[int, Row(3, "1/s", "the same of 32, 31 and 21")]
    relaxation: Annotated[int, Row(9, "1/s", "relaxation of the normal components")]
    pairs: Annotated[int, Row(9, "s2", "h² φ₂, φ₃ and φ₄ of the pairs, for the whole step")]
    along: Annotated[int, Row(3, "s2", "those of the normal rates: weights of J")]
    bent: Annotated[int, Row(3, "s3", "and weights of J²")]
    change: Annotated[int, Row(9, "1/s", "change of l_s by that of the fluid's gradient over the step")]
    turning: Annotated[int, Row(9, "1/s2", "rate of change of l_s by turning")]
    quarter: Annotated[int, Row(9, "1", "Ω at a quarter of the step")]
    slope: Annotated[int, Row(9, "1/s", "slope of what is not stiff, per step")]
    second: Annotated[int, Row(9, "1", "Ω of order 2")]


work = offsets(RelaxationRows)


@choice
def with_fading(
    _block: Block, _i: int, turning: Tensor, _m: Mobility, _e: Elasticity, _G: Tensor, _mu_f: Scalar
) -> Tensor:
    """Return the rate of change of l_s by turning as it is: the solid has no memory that fades."""
    return turning


def gradient_by_slope(n: Relaxation, Omega: Tensor, l_s: Tensor, change: Tensor, k: Tensor) -> Tensor:
    """Return l_s at the end of a step by the rate g of Ω that the slope k of N gives: g + ½[Ω, g], 1/s."""
    g = add(add(relaxing(n, Omega), l_s), add(change, k))
    return add(g, scale(0.5, commutator(Omega, g)))


@choice
def gradient_at_end(
    l_end: Tensor, _Q: Tensor, _n: Relaxation, _Omega: Tensor, _l_s: Tensor, _change: Tensor, _last: Tensor
) -> Tensor:
    """Return the velocity gradient at the end of a step of order 3, that of the last evaluation, 1/s."""
    return l_end


@traced
def predict_inertialess(block: Block, medium: Medium) -> None:
    """Compute velocity and acceleration at the start, and the position they predict."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        w = slip_of_body(block, i, medium, load9(block, during.start_l, i), load3(block, at.DuDt, i))
        v = plus(load3(block, at.u, i), w)
        a = fluid_acceleration(block, i, v)
        store3(block, work.start_slip, i, w)
        store3(block, during.start_v, i, v)
        store3(block, during.start_a, i, a)
        store3(block, at.new_x, i, place_after(block, i, h, v, a))


@traced
def first_inertialess(block: Block, medium: Medium) -> None:
    """Compute the state at the start, its relaxation, and the shape at a quarter of the step."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        Q, stretches, F = load9(block, at.Q, i), load3(block, at.stretch, i), load9(block, at.F, i)
        # Of the flow, and with the surroundings.
        l, l_end, felt = load9(block, during.start_l, i), load9(block, during.end_l, i), load9(block, at.l, i)
        mark_disturbed(block, i)
        block[at.fluid * LANES + i] = viscosity_at(block, i, medium)
        G = dot(Q, F)
        b_e = finger_of_body_in_frame(stretches, G, load9(block, at.M, i))
        l_f = to_frame(Q, felt)
        m, sigma = _response(block, i, medium, stretches, b_e, l_f)
        l_s = velocity_gradient(m, sigma, l_f)
        e = incompressible_elasticity(block, i, b_e)
        n = relaxation(m, e, viscosity_at(block, i, medium))
        quarter, full = responses(n, h)
        dl = add(l_end, scale(-1.0, l))
        change = _seen(m, to_frame(Q, dl))
        turning = turning_gradient(stretches, m, e, viscosity_at(block, i, medium), l_s, l_f, sigma)
        turning = with_fading(block, i, turning, m, e, G, viscosity_at(block, i, medium))
        Omega = quarter_argument(n, quarter, h, l_s, change, turning)
        store9(block, at.new_F, i, dot(transpose(Q), dot(group_exponential(Omega), G)))
        # Forces act at the end here, and at the start elsewhere.
        block[at.gone * LANES + i] = 1.0
        store3(block, work.end_slip, i, slip_of_body(block, i, medium, l_end, end_acceleration(block, i)))
        block[at.gone * LANES + i] = 0.0
        # That of the body's place and time, as long as the flow is smooth.
        store9(block, at.l, i, add(l, scale(NODE, dl)))
        x, v = load3(block, at.x, i), load3(block, during.start_v, i)
        store3(block, at.new_x, i, plus_scaled(x, NODE * h, v))
        store3(block, work.disturbance, i, minus(load3(block, at.u, i), load3(block, during.start_u, i)))
        store3(block, at.u, i, _fluid_at_node(block, i))
        store9(block, during.start_Q, i, Q)
        store9(block, work.l_s, i, l_s)
        store9(block, work.b_e, i, b_e)
        store9(block, work.normal, i, m.normal)
        store3(block, work.compliance, i, m.compliance)
        store3(block, work.slip, i, m.slip)
        store3(block, work.upper, i, n.upper)
        store3(block, work.lower, i, n.lower)
        store9(block, work.relaxation, i, n.normal)
        store9(block, work.pairs, i, full.pairs)
        store3(block, work.along, i, full.along)
        store3(block, work.bent, i, full.bent)
        store9(block, work.change, i, change)
        store9(block, work.turning, i, turning)
        store9(block, work.quarter, i, Omega)


@traced
def second_inertialess(block: Block, medium: Medium, tolerance: float) -> None:
    """Compute the slope at a quarter of the step and the solution of order 2, and choose the order."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        Q0, Omega = load9(block, during.start_Q, i), load9(block, work.quarter, i)
        l_s, b_e, change = load9(block, work.l_s, i), load9(block, work.b_e, i), load9(block, work.change, i)
        n, full = _load_relaxation(block, i)
        turn = dot(Q0, transpose(load9(block, at.Q, i)))
        g = algebra_rate(Omega, to_frame(turn, _gradient_in_frame(block, i, medium)))
        k = slope_of(n, Omega, g, l_s, scale(NODE, change), 1.0 / NODE)
        two, by_fluid, by_slope = of_second_order(n, full, h, l_s, change, k)
        strain = strain_scale(b_e, two)
        share = error_share(block, i, fastest(n))
        size = share * relative_size(by_slope, b_e, strain)
        size = size + FLUID_SHARE * relative_size(by_fluid, b_e, strain)
        choose_order(block, i, counted_error(block, i, size), tolerance)
        store9(block, work.slope, i, k)
        store9(block, work.second, i, two)
        store9(block, during.second_Q, i, load9(block, at.Q, i))

        # The slip changes with the fluid and with the shape.
        l, a = load9(block, during.start_l, i), load3(block, at.DuDt, i)
        w0, w1, w = (
            load3(block, work.start_slip, i),
            load3(block, work.end_slip, i),
            slip_of_body(block, i, medium, l, a),
        )
        # So does the disturbance by the surroundings.
        d, p, q = load3(block, work.disturbance, i), load3(block, at.u, i), _fluid_at_node(block, i)
        u = load3(block, during.end_u, i)
        dv = plus(minus(w, w0), minus(minus(p, q), d))
        finish_path(block, i, plus_scaled(plus(plus(u, d), w1), 1.0 / NODE, dv))
        add_disturbance_error(block, i, d, scale_vector(1.0 / NODE, dv))
        F = _finish_shape(block, i, Q0, two)
        end = gradient_by_slope(n, two, l_s, change, k)
        store9(block, at.new_A, i, dot(from_frame(Q0, end), F))


@traced
def last_inertialess(block: Block, medium: Medium) -> None:
    """Compute the shape for the evaluation at the end, in lanes of order 3."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        Q0, F = load9(block, during.start_Q, i), load9(block, at.F, i)
        l_s, change = load9(block, work.l_s, i), load9(block, work.change, i)
        n, full = _load_relaxation(block, i)
        k, turning = load9(block, work.slope, i), load9(block, work.turning, i)
        curve = _bend(block, i, medium, Q0)
        Omega = end_argument(n, full, h, l_s, change, curve, k, turning)
        new = dot(transpose(Q0), dot(group_exponential(Omega), dot(Q0, F)))
        third = block[during.third * LANES + i] > 0.0
        store9(block, at.new_F, i, choose(third, new, load9(block, at.new_F, i)))
        store9(block, at.l, i, load9(block, during.end_l, i))
        store3(block, at.u, i, load3(block, during.end_u, i))
        # The quarter has served.
        store9(block, work.quarter, i, Omega)


@traced
def third_inertialess(block: Block, medium: Medium, tolerance: float) -> None:
    """Compute the slope at the end and the solution of order 3."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        Q0, Omega = load9(block, during.start_Q, i), load9(block, work.quarter, i)
        l_s, b_e, change = load9(block, work.l_s, i), load9(block, work.b_e, i), load9(block, work.change, i)
        n, full = _load_relaxation(block, i)
        k, two = load9(block, work.slope, i), load9(block, work.second, i)
        curve = _bend(block, i, medium, Q0)
        l_end = _gradient(block, i, medium)
        g = algebra_rate(Omega, to_frame(Q0, l_end))
        last = slope_of(n, Omega, g, l_s, change, 1.0)
        three = of_third_order(n, full, h, l_s, change, curve, k, last)
        difference = relative_size(add(three, scale(-1.0, two)), b_e, strain_scale(b_e, two))
        third = block[during.third * LANES + i] > 0.0
        update_discount(block, i, third, difference, tolerance)
        F_two, J_two, A_two = load9(block, at.new_F, i), block[at.J * LANES + i], load9(block, at.new_A, i)
        F = _finish_shape(block, i, Q0, three)
        store9(block, at.new_F, i, choose(third, F, F_two))
        block[at.J * LANES + i] = select(third, block[at.J * LANES + i], J_two)
        l_end = gradient_at_end(l_end, Q0, n, three, l_s, change, last)
        store9(block, at.new_A, i, choose(third, dot(l_end, F), A_two))
        keep_frame(block, i, third)
        judge_difference(block, i, select(third, difference, 0.0), tolerance)


@traced
def correct_inertialess(block: Block) -> None:
    """Replace Hermite's cubic by Simpson's rule for the way in the fluid.

    Hermite's cubic is Simpson's rule with its own velocity in the middle, ½ (u₀ + u) + h/8 (a₀ − a).
    """
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        u = plus(load3(block, during.start_u, i), load3(block, during.end_u, i))
        a = minus(load3(block, during.start_a, i), acceleration_at_end(block, i, load3(block, at.new_v, i)))
        more = minus(load3(block, during.middle_u, i), plus_scaled(scale_vector(0.5, u), 0.125 * h, a))
        store3(block, at.new_x, i, plus_scaled(load3(block, at.new_x, i), h * (2.0 / 3.0), more))


@traced
def end_inertialess(block: Block, medium: Medium) -> None:
    """Compute A and v of the balance at the end of the last step."""
    for i in range(LANES):
        moving = block[at.moving * LANES + i] > 0.0
        l_s = _gradient(block, i, medium)
        F, A = load9(block, at.F, i), load9(block, at.A, i)
        store9(block, at.A, i, choose(moving, dot(l_s, F), A))
        slip = slip_of_body(block, i, medium, load9(block, during.start_l, i), load3(block, at.DuDt, i))
        v = plus(load3(block, at.u, i), slip)
        store3(block, at.v, i, choose3(moving, v, load3(block, at.v, i)))


def free_motion_inertialess(block: Block, i: int, medium: Medium, h: float) -> tuple[Vector, Tensor]:
    """Return v, m/s, and l_s, 1/s, at the start of a step h, with elasticity as a viscosity μ h."""
    eta = block[at.eta * LANES + i]
    block[at.eta * LANES + i] = eta + block[at.mu * LANES + i] * h
    l = _gradient(block, i, medium)
    block[at.eta * LANES + i] = eta
    slip = slip_of_body(block, i, medium, load9(block, during.start_l, i), load3(block, at.DuDt, i))
    return plus(load3(block, at.u, i), slip), l


def _response(
    block: Block, i: int, medium: Medium, stretches: Vector, b_e: Tensor, l_f: Tensor
) -> tuple[Mobility, Tensor]:
    """Return the mobility, and the elastic stress over μ_f, 1/s, in the particle frame."""
    m = body_mobility(block, i, medium, stretches)
    tau = incompressible_stress(block, i, stretches, b_e)
    sigma = scale(1.0 / viscosity_at(block, i, medium), tau)
    return m, with_tension(block, i, m, stretches, sigma, l_f)


def _gradient(block: Block, i: int, medium: Medium) -> Tensor:
    """Return l_s of the shape new_F, whose frame and integrals are in the block, 1/s."""
    return from_frame(load9(block, at.Q, i), _gradient_in_frame(block, i, medium))


def _gradient_in_frame(block: Block, i: int, medium: Medium) -> Tensor:
    """Return the same in that frame."""
    Q, stretches = load9(block, at.Q, i), load3(block, at.stretch, i)
    b_e = finger_of_body_in_frame(stretches, dot(Q, load9(block, at.new_F, i)), load9(block, at.M, i))
    l_f = to_frame(Q, load9(block, at.l, i))
    m, sigma = _response(block, i, medium, stretches, b_e, l_f)
    return velocity_gradient(m, sigma, l_f)


def _fluid_at_node(block: Block, i: int) -> Vector:
    """Return the velocity of the undisturbed fluid at a quarter of the step, m/s."""
    return between(load3(block, during.start_u, i), load3(block, during.end_u, i), NODE)


def _seen(m: Mobility, dl_f: Tensor) -> Tensor:
    """Return the change of l_s by a change of the fluid's gradient, 1/s."""
    return velocity_gradient(m, ZERO, dl_f)


def _bend(block: Block, i: int, medium: Medium, Q: Tensor) -> Tensor:
    """Return the part of l_s that is quadratic in time, from that of the fluid's gradient, 1/s."""
    l, middle, l_end = (
        load9(block, during.start_l, i),
        load9(block, during.middle_l, i),
        load9(block, during.end_l, i),
    )
    bend = scale(2.0, add(add(l, l_end), scale(-2.0, middle)))
    deficit = mobility_deficit(block, i, medium)
    m = Mobility(
        load9(block, work.normal, i), load3(block, work.compliance, i), load3(block, work.slip, i), deficit
    )
    return _seen(m, to_frame(Q, bend))


@choice
def slip_of_body(block: Block, i: int, medium: Medium, l_f: Tensor, Du_Dt: Vector) -> Vector:
    """Return the velocity relative to the fluid of the shape in the block, m/s."""
    return slip_by_forces(block, i, medium, l_f, Du_Dt)


def slip_by_forces(block: Block, i: int, medium: Medium, l_f: Tensor, Du_Dt: Vector) -> Vector:
    """Return the same where drag balances the forces."""
    k = drag(load3(block, at.stretch, i), load_integrals(block, i))
    rate = drag_rate(block, i, viscosity_at(block, i, medium), k)
    steady, push, inertia = forces_on(block, i, medium, 1.0, Du_Dt)
    return balanced_slip(load9(block, at.Q, i), rate, steady, push, inertia, Du_Dt, l_f)


def _finish_shape(block: Block, i: int, Q: Tensor, Omega: Tensor) -> Tensor:
    """Store and return the new deformation gradient with its exact volume; store its volume before."""
    F = dot(transpose(Q), dot(group_exponential(Omega), dot(Q, load9(block, at.F, i))))
    J = det(F)
    F = isochoric(F, J)
    store9(block, at.new_F, i, F)
    block[at.J * LANES + i] = J
    return F


def _load_relaxation(block: Block, i: int) -> tuple[Relaxation, Response]:
    """Return the relaxation of the state at the start, and the functions of the whole step."""
    b_e = load9(block, work.b_e, i)
    n = Relaxation(
        diagonal(b_e),
        load3(block, work.upper, i),
        load3(block, work.lower, i),
        load9(block, work.relaxation, i),
    )
    return n, Response(load9(block, work.pairs, i), load3(block, work.along, i), load3(block, work.bent, i))


def _refuses(traction: str, material: str, _tense: bool) -> str:
    if traction != "roscoe":
        return f"needs the traction roscoe, not {traction}"
    if not MATERIALS[material].isochoric:
        return f"takes no {material}: it has no incompressible form"
    return ""


STOKES = Integrator(
    name="stokes",
    description="without inertia, third order, exactly incompressible",
    order=3,
    track=track_adaptive,
    layout=layout(at, during, work),
    recorded=RecordedRows(
        during.start_Q, during.start_l, work.l_s, in_frame=True, end_l=during.end_l, v=during.start_v
    ),
    slots={
        **ADAPTIVE,
        predict: predict_inertialess,
        first_slope: first_inertialess,
        second_slope: second_inertialess,
        last_argument: last_inertialess,
        third_slope: third_inertialess,
        correct_path: correct_inertialess,
        end_slope: end_inertialess,
        push_out: push_along_mobility,
        find_reactions: balance_walls,
        apply_reactions: add_reactions,
        free_motion: free_motion_inertialess,
    },
    switches=Switches(updates_end=1),
    adaptive=True,
    inertia=False,
    refuses=_refuses,
)
