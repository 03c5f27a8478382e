"""The integrator ``stokes``: without inertia of the solid, of second order, exactly incompressible.

The formulas are those of :mod:`foamprb.body.stokes`. The shape's only unknown is F; its rate, and the
barycentre's velocity, are those of the balance of forces in the state.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

from foamprb.body.drag import oberbeck as drag
from foamprb.body.ellipsoid import Integrals
from foamprb.body.material import MATERIALS
from foamprb.body.material import finger_of_sphere as finger
from foamprb.body.rosenbrock import GAMMA, Elasticity
from foamprb.body.stokes import Mobility, isochoric, mobility, solve_inertialess, velocity_gradient
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    det,
    dot,
    dot_vector,
    exponential,
    from_frame,
    reciprocals,
    scale,
    select,
    to_frame,
    vector_dot,
)
from foamprb.cloud.block import BLOCK_STAGES, Medium, at, choose, load3, load9, load_integrals, store3, store9
from foamprb.cloud.forces.total import slip_acceleration
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.integrators.second_order import (
    SECOND_ORDER_ROWS,
    conservative_stress,
    drag_rate,
    finish,
    slope,
    solid_elasticity,
    track_adaptive,
)
from foamprb.cloud.layout import LANES, Row, layout, offsets


class ResponseRows(NamedTuple):
    """What stage 2 needs of stage 1 beside the :class:`SlopeRows`: the state's mobility and elasticity."""

    normal: Annotated[int, Row(9, "1", "d_s,aa for unit changes of the normal stresses over μ_f")]
    compliance: Annotated[int, Row(3, "1", "d_s,ab for unit changes of the shear stresses over μ_f")]
    slip: Annotated[int, Row(3, "1", "(b² − c²)/(b² + c²) and its cyclic companions")]
    squares: Annotated[int, Row(3, "1", "squared elastic stretches e_a²")]
    slopes: Annotated[int, Row(9, "Pa", "∂τ_a/∂ln e_c")]
    shear: Annotated[int, Row(3, "Pa", "the same of the shear stresses, for 23, 13 and 12")]


own = offsets(ResponseRows, SECOND_ORDER_ROWS)


def first_inertialess(block: Any, medium: Medium) -> None:
    """Stage 1 without inertia."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        F, x = load9(block, at.F, i), load3(block, at.x, i)
        b_e = finger(dot(Q, F), load9(block, at.M, i))
        m = mobility(stretches, g, block[at.eta * LANES + i] / medium.mu)
        l_s, kx = _balance(block, i, medium, Q, stretches, g, m, b_e)
        # The pressure takes over the solid's resistance to dilation.
        e = solid_elasticity(block, i, stretches, b_e, 0.0)
        Y = solve_inertialess(m, e, GAMMA * h, medium.mu, l_s)
        kF = from_frame(Q, Y)
        store9(block, slope.kF, i, kF)
        store3(block, slope.kx, i, kx)
        store9(block, at.new_F, i, dot(exponential(scale(h, kF)), F))
        store3(block, at.new_x, i, (x[0] + h * kx[0], x[1] + h * kx[1], x[2] + h * kx[2]))
        store9(block, slope.start_Q, i, Q)
        store9(block, own.normal, i, m.normal)
        store3(block, own.compliance, i, m.compliance)
        store3(block, own.slip, i, m.slip)
        store3(block, own.squares, i, e.squares)
        store9(block, own.slopes, i, e.slopes)
        store3(block, own.shear, i, e.shear)


def second_inertialess(block: Any, medium: Medium) -> None:
    """Stage 2 without inertia; the volume is restored exactly."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        Q0 = load9(block, slope.start_Q, i)
        eta = block[at.eta * LANES + i] / medium.mu
        F, F_p = load9(block, at.F, i), load9(block, at.new_F, i)
        b_e = finger(dot(Q, F_p), load9(block, at.M, i))
        l_s, v = _balance(block, i, medium, Q, stretches, g, mobility(stretches, g, eta), b_e)
        l_p = from_frame(Q, l_s)
        k1F, k1x = load9(block, slope.kF, i), load3(block, slope.kx, i)
        r = to_frame(Q0, add(l_p, scale(-2.0, k1F)))
        m, e = _load_response(block, i)
        Y = solve_inertialess(m, e, GAMMA * h, medium.mu, r)
        k2x = (v[0] - 2.0 * k1x[0], v[1] - 2.0 * k1x[1], v[2] - 2.0 * k1x[2])
        finish(block, i, F, from_frame(Q0, Y), (k1x, k2x))
        F_new = load9(block, at.new_F, i)
        J = det(F_new)
        F_new = isochoric(F_new, J)
        store9(block, at.new_F, i, F_new)
        block[at.J * LANES + i] = J
        store9(block, at.new_A, i, dot(l_p, F_new))
        store3(block, at.new_v, i, v)


def end_inertialess(block: Any, medium: Medium) -> None:
    """A and v of the balance at the end; the stages leave those of the state that the last step predicted."""
    for i in range(LANES):
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        F = load9(block, at.F, i)
        m = mobility(stretches, g, block[at.eta * LANES + i] / medium.mu)
        b_e = finger(dot(Q, F), load9(block, at.M, i))
        l_s, v = _balance(block, i, medium, Q, stretches, g, m, b_e)
        moving = block[at.moving * LANES + i] > 0.0
        A, w = load9(block, at.A, i), load3(block, at.v, i)
        store9(block, at.A, i, choose(moving, dot(from_frame(Q, l_s), F), A))
        store3(
            block,
            at.v,
            i,
            (select(moving, v[0], w[0]), select(moving, v[1], w[1]), select(moving, v[2], w[2])),
        )


def _balance(
    block: Any, i: int, medium: Medium, Q: Tensor, stretches: Vector, g: Integrals, m: Mobility, b_e: Tensor
) -> tuple[Tensor, Vector]:
    """l_s in the particle frame, 1/s, and the barycentre's velocity u + K⁻¹ f_G/μ_f, m/s."""
    tau = conservative_stress(block, i, stretches, b_e, 0.0 * b_e[0] + 1.0)
    sigma = scale(1.0 / medium.mu, tau)
    l_f = to_frame(Q, load9(block, at.l, i))
    l_s = velocity_gradient(stretches, g, m, sigma, l_f)
    rate = drag_rate(block, i, medium.mu, drag(stretches, g))
    w = _drift(Q, rate, slip_acceleration(block, i, medium))
    u = load3(block, at.u, i)
    return l_s, (u[0] + w[0], u[1] + w[1], u[2] + w[2])


def _drift(Q: Tensor, rate: Vector, a: Vector) -> Vector:
    """Velocity relative to the fluid at which drag balances the acceleration, m/s."""
    g = dot_vector(Q, a)
    r = reciprocals(rate)
    return vector_dot((g[0] * r[0], g[1] * r[1], g[2] * r[2]), Q)


def _load_response(block: Any, i: int) -> tuple[Mobility, Elasticity]:
    """Mobility and elasticity at the start of the step, as stage 1 left them, for the step's equations."""
    compliance, slip = load3(block, own.compliance, i), load3(block, own.slip, i)
    m = Mobility(load9(block, own.normal, i), compliance, slip, 1.0)
    squares, shear = load3(block, own.squares, i), load3(block, own.shear, i)
    return m, Elasticity(squares, load9(block, own.slopes, i), shear)


def _refuses(traction: str, material: str, _tense: bool) -> str:
    if traction != "roscoe":
        return f"needs the traction roscoe, not {traction}"
    if not MATERIALS[material].isochoric:
        return f"takes no {material}: it has no incompressible form"
    return ""


STOKES = Integrator(
    name="stokes",
    description="without inertia, second order, exactly incompressible",
    order=2,
    track=track_adaptive,
    stages=(*BLOCK_STAGES, first_inertialess, second_inertialess, end_inertialess),
    layout=layout(at, slope, own),
    bindings={
        "first_slope": first_inertialess,
        "second_slope": second_inertialess,
        "end_slope": end_inertialess,
    },
    adaptive=True,
    inertia=False,
    refuses=_refuses,
)
