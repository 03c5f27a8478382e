"""The compiled loop for the second-order integrators, each particle with error-controlled steps of its own.

A tracking step Δt is cut into as many steps h as the tolerance asks for; the size that a particle found is
part of its state. As in :mod:`foamprb.cloud.advance`, the lanes of a block go side by side and all alike.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import acceleration, slip_acceleration
from foamprb.body.drag import oberbeck as drag
from foamprb.body.ellipsoid import Integrals
from foamprb.body.material import finger_of_sphere as finger
from foamprb.body.material import viscous_stress
from foamprb.body.rosenbrock import (
    GAMMA,
    Elasticity,
    Stiffness,
    elastic_response,
    elasticity,
    inertial_stiffness,
    kirchhoff,
    solve_inertial,
)
from foamprb.body.stokes import Mobility, isochoric, mobility, solve_inertialess, velocity_gradient
from foamprb.body.surface_tension import no_stress as interface
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    det,
    dot,
    dot_vector,
    exponential,
    from_frame,
    inverse,
    reciprocals,
    scale,
    select,
    to_frame,
    transpose,
    vector_dot,
)
from foamprb.body.traction import roscoe as traction
from foamprb.cloud.block import (
    NOT_CONVERGED,
    ROWS,
    Medium,
    Scratch,
    accept_stage,
    at,
    choose,
    frame_stage,
    idle_lanes,
    integrals_stage,
    load3,
    load9,
    load_integrals,
    load_particle,
    new_frames,
    save_particle,
    store3,
    store9,
    store_fluid,
    straighten_stage,
    stretch_stage,
)
from foamprb.cloud.layout import LANES, Row, end, layout, offsets
from foamprb.cloud.motion import (
    ACTIVE,
    PENDING,
    SHORTEST_STEP,
    PatchTable,
    clearance_of,
    fail,
    is_sound,
    reach_end,
    release,
)
from foamprb.cloud.state import Particles
from foamprb.flow.analytic import sample_linear as sample
from foamprb.flow.analytic import walk_free as walk


class SlopeRows(NamedTuple):
    """What both integrators remember of the first stage: its slopes k₁, and the frame that it was in."""

    kx: Annotated[int, Row(3, "m/s", "slope of the position")]
    kF: Annotated[int, Row(9, "1/s", "slope of the deformation gradient, times F⁻¹")]
    start_Q: Annotated[int, Row(9, "1", "particle frame at the start of the step")]


class InertialRows(NamedTuple):
    """What the integrator with inertia remembers beside that."""

    kv: Annotated[int, Row(3, "m/s2", "slope of the velocity")]
    kL: Annotated[int, Row(9, "1/s2", "slope of the body's velocity gradient")]
    rate: Annotated[int, Row(3, "1/s", "rates of drag along the axes of start_Q")]
    b: Annotated[int, Row(3, "1", "these and the rows below: a Stiffness, at the start of the step")]
    traction: Annotated[int, Row(9, "1/s", "")]
    traction_first: Annotated[int, Row(9, "1/s", "")]
    traction_second: Annotated[int, Row(9, "1/s", "")]
    elastic: Annotated[int, Row(9, "1/s2", "")]
    elastic_first: Annotated[int, Row(9, "1/s2", "")]
    elastic_second: Annotated[int, Row(9, "1/s2", "")]


class InertialessRows(NamedTuple):
    """What the integrator without inertia remembers beside that."""

    normal: Annotated[int, Row(9, "1", "normal of Mobility, at the start of the step")]
    compliance: Annotated[int, Row(3, "1", "compliance of the same")]
    slip: Annotated[int, Row(3, "1", "slip of the same")]
    squares: Annotated[int, Row(3, "1", "squares of Elasticity, at the start of the step")]
    slopes: Annotated[int, Row(9, "Pa", "slopes of the same")]
    shear: Annotated[int, Row(3, "Pa", "shear of the same")]


slope = offsets(SlopeRows, ROWS)
inertial = offsets(InertialRows, end(slope))
inertialess = offsets(InertialessRows, end(slope))
INERTIAL_LAYOUT = layout(at, slope, inertial)
INERTIALESS_LAYOUT = layout(at, slope, inertialess)

_SAFETY, _LEAST, _MOST = 0.9, 0.2, 4.0
_SMALLEST = 1e-9
"""A step that must be smaller than this share of Δt is a failure."""


def _store_stiffness(block: Any, i: int, n: Stiffness) -> None:
    store3(block, inertial.b, i, n.b)
    store9(block, inertial.traction, i, n.traction)
    store9(block, inertial.traction_first, i, n.traction_pairs[0])
    store9(block, inertial.traction_second, i, n.traction_pairs[1])
    store9(block, inertial.elastic, i, n.elastic)
    store9(block, inertial.elastic_first, i, n.elastic_pairs[0])
    store9(block, inertial.elastic_second, i, n.elastic_pairs[1])


def _load_stiffness(block: Any, i: int) -> Stiffness:
    return Stiffness(
        load3(block, inertial.b, i),
        load9(block, inertial.traction, i),
        (load9(block, inertial.traction_first, i), load9(block, inertial.traction_second, i)),
        load9(block, inertial.elastic, i),
        (load9(block, inertial.elastic_first, i), load9(block, inertial.elastic_second, i)),
    )


def _solid(block: Any, i: int) -> tuple[Any, Any, Any]:
    """μ_s and λ_s, Pa, and the third parameter of the solid."""
    return block[at.mu * LANES + i], block[at.lame * LANES + i], block[at.k * LANES + i]


def _inertia(block: Any, i: int) -> float:
    """c = 5/(ρ_s R²), the inverse inertia of the shape per volume."""
    R = block[at.R * LANES + i]
    return 5.0 / (block[at.rho * LANES + i] * R * R)  # type: ignore[no-any-return]


def _drag_rate(block: Any, i: int, mu_f: float, k: Vector) -> Vector:
    """μ_f K_a/m, 1/s, with K_a in units of R."""
    R = block[at.R * LANES + i]
    c = mu_f / (4.0 / 3.0 * math.pi * R * R * block[at.rho * LANES + i])
    return c * k[0], c * k[1], c * k[2]


def _drift(Q: Tensor, rate: Vector, a: Vector) -> Vector:
    """Velocity relative to the fluid at which drag balances the acceleration, m/s."""
    g = dot_vector(Q, a)
    r = reciprocals(rate)
    return vector_dot((g[0] * r[0], g[1] * r[1], g[2] * r[2]), Q)


def _combine(y: Tensor, h: Any, k1: Tensor, k2: Tensor) -> Tensor:
    """Y + h (3 k₁ + k₂)/2."""
    return add(y, add(scale(1.5 * h, k1), scale(0.5 * h, k2)))


def _largest(T: Tensor) -> Any:
    p = np.maximum(np.maximum(abs(T[0]), abs(T[1])), np.maximum(abs(T[2]), abs(T[3])))
    q = np.maximum(np.maximum(abs(T[4]), abs(T[5])), np.maximum(abs(T[6]), abs(T[7])))
    return np.maximum(np.maximum(p, q), abs(T[8]))


def _finish(block: Any, i: int, F: Tensor, k2F: Tensor, x_slopes: tuple[Vector, Vector]) -> None:
    """Store the new deformation gradient and position, and the error estimate of the step."""
    h = block[at.dt * LANES + i]
    k1F = load9(block, slope.kF, i)
    store9(block, at.new_F, i, dot(exponential(add(scale(1.5 * h, k1F), scale(0.5 * h, k2F))), F))
    k1, k2 = x_slopes
    x = load3(block, at.x, i)
    store3(
        block,
        at.new_x,
        i,
        (
            x[0] + h * (1.5 * k1[0] + 0.5 * k2[0]),
            x[1] + h * (1.5 * k1[1] + 0.5 * k2[1]),
            x[2] + h * (1.5 * k1[2] + 0.5 * k2[2]),
        ),
    )
    bend = abs(k1[0] + k2[0]) + abs(k1[1] + k2[1]) + abs(k1[2] + k2[2])
    way = abs(k1[0]) + abs(k1[1]) + abs(k1[2]) + block[at.R * LANES + i] / h
    block[at.error * LANES + i] = np.maximum(0.5 * h * _largest(add(k1F, k2F)), 0.5 * bend / way)


def first_inertial(block: Any, medium: Medium) -> None:
    """Stage 1 with inertia: slopes at the start of the step, and the state that they predict.

    The shape's unknowns are F and l_s = A F⁻¹, with dF/dt = l_s F and dl_s/dt = Ȧ F⁻¹ − l_s l_s: the traction
    depends on l_s, so that what is stiff in l_s does not reappear in F.
    """
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        gh = GAMMA * h
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        F, A = load9(block, at.F, i), load9(block, at.A, i)
        c = _inertia(block, i)
        l_s = dot(A, inverse(F))
        L, G = to_frame(Q, l_s), dot(Q, F)
        b, b_e = dot(G, transpose(G)), finger(G, load9(block, at.M, i))
        W = _shape_force(block, i, medium.mu, Q, stretches, g, L, b_e)
        e = _elasticity(block, i, stretches, b_e, 1.0)
        n = inertial_stiffness(stretches, g, e, c, medium.mu, block[at.eta * LANES + i])
        r = add(W, scale(-1.0, dot(dot(L, L), b)))
        Y = solve_inertial(n, gh, add(r, scale(-gh, elastic_response(n, L))))
        kL = from_frame(Q, Y)
        kF = add(l_s, scale(gh, kL))
        _store_stiffness(block, i, n)
        store9(block, inertial.kL, i, kL)
        store9(block, slope.kF, i, kF)
        store9(block, at.new_A, i, add(l_s, scale(h, kL)))
        store9(block, at.new_F, i, dot(exponential(scale(h, kF)), F))

        v, x = load3(block, at.v, i), load3(block, at.x, i)
        a, rate = _acceleration(block, i, medium, Q, drag(stretches, g), v, det(F))
        kv = _damped(Q, rate, gh, a)
        kx = (v[0] + gh * kv[0], v[1] + gh * kv[1], v[2] + gh * kv[2])
        store3(block, inertial.kv, i, kv)
        store3(block, slope.kx, i, kx)
        store3(block, at.new_v, i, (v[0] + h * kv[0], v[1] + h * kv[1], v[2] + h * kv[2]))
        store3(block, at.new_x, i, (x[0] + h * kx[0], x[1] + h * kx[1], x[2] + h * kx[2]))
        store9(block, slope.start_Q, i, Q)
        store3(block, inertial.rate, i, rate)


def second_inertial(block: Any, medium: Medium) -> None:
    """Stage 2 with inertia: slopes at the predicted state, and the new state."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        gh = GAMMA * h
        n = _load_stiffness(block, i)
        Q0, rate0 = load9(block, slope.start_Q, i), load3(block, inertial.rate, i)
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        F, A = load9(block, at.F, i), load9(block, at.A, i)
        F_p, l_p = load9(block, at.new_F, i), load9(block, at.new_A, i)
        k1F, k1L = load9(block, slope.kF, i), load9(block, inertial.kL, i)
        L, G = to_frame(Q, l_p), dot(Q, F_p)
        b = dot(G, transpose(G))
        W = _shape_force(block, i, medium.mu, Q, stretches, g, L, finger(G, load9(block, at.M, i)))
        f_L = from_frame(Q, add(dot(W, inverse(b)), scale(-1.0, dot(L, L))))
        r_F = add(l_p, scale(-2.0, k1F))
        r_L = add(f_L, scale(-2.0, k1L))
        G0 = dot(Q0, F)
        r = dot(to_frame(Q0, r_L), dot(G0, transpose(G0)))
        Y = solve_inertial(n, gh, add(r, scale(-gh, elastic_response(n, to_frame(Q0, r_F)))))
        k2L = from_frame(Q0, Y)
        k2F = add(r_F, scale(gh, k2L))
        l_s = _combine(dot(A, inverse(F)), h, k1L, k2L)

        v, v_p = load3(block, at.v, i), load3(block, at.new_v, i)
        k1v, k1x = load3(block, inertial.kv, i), load3(block, slope.kx, i)
        f_v, _ = _acceleration(block, i, medium, Q, drag(stretches, g), v_p, det(F_p))
        k2v = _damped(Q0, rate0, gh, (f_v[0] - 2.0 * k1v[0], f_v[1] - 2.0 * k1v[1], f_v[2] - 2.0 * k1v[2]))
        k2x = (
            v_p[0] - 2.0 * k1x[0] + gh * k2v[0],
            v_p[1] - 2.0 * k1x[1] + gh * k2v[1],
            v_p[2] - 2.0 * k1x[2] + gh * k2v[2],
        )
        _finish(block, i, F, k2F, (k1x, k2x))
        F_new = load9(block, at.new_F, i)
        store9(block, at.new_A, i, dot(l_s, F_new))
        block[at.J * LANES + i] = det(F_new)
        # Over the step, an error of l_s is one of the deformation gradient.
        error = 0.5 * h * h * _largest(add(k1L, k2L))
        block[at.error * LANES + i] = np.maximum(block[at.error * LANES + i], error)
        store3(
            block,
            at.new_v,
            i,
            (
                v[0] + h * (1.5 * k1v[0] + 0.5 * k2v[0]),
                v[1] + h * (1.5 * k1v[1] + 0.5 * k2v[1]),
                v[2] + h * (1.5 * k1v[2] + 0.5 * k2v[2]),
            ),
        )


def _shape_force(
    block: Any, i: int, mu_f: float, Q: Tensor, stretches: Vector, g: Integrals, L: Tensor, b_e: Tensor
) -> Tensor:
    """Ȧ Fᵀ = c (J(σ̃ − σ_v) − τ) (33), 1/s², in the particle frame, where l_s is L."""
    stress = scale(mu_f, traction(stretches, g, to_frame(Q, load9(block, at.l, i)), L))
    stress = add(stress, scale(-1.0, viscous_stress(L, block[at.eta * LANES + i])))
    J = stretches[0] * stretches[1] * stretches[2]
    tau = _conservative_stress(block, i, stretches, b_e, J)
    c = _inertia(block, i)
    return add(scale(c * J, stress), scale(-c, tau))


def _conservative_stress(block: Any, i: int, stretches: Vector, b_e: Tensor, J: Any) -> Tensor:
    """Kirchhoff stress of the solid and of its surface tension, Pa, in the particle frame."""
    tau = kirchhoff(b_e, J, *_solid(block, i))
    s = interface(stretches, block[at.tension * LANES + i])
    return (
        tau[0] + s[0], tau[1], tau[2],
        tau[3], tau[4] + s[1], tau[5],
        tau[6], tau[7], tau[8] + s[2],
    )  # fmt: skip


def _elasticity(block: Any, i: int, stretches: Vector, b_e: Tensor, dilation: float) -> Elasticity:
    """The solid's elasticity, its resistance to dilation taken ``dilation`` times."""
    mu, lame, k = _solid(block, i)
    J = stretches[0] * stretches[1] * stretches[2]
    squares = (b_e[0], b_e[4], b_e[8])
    return elasticity(squares, J, mu, dilation * lame, k, block[at.tension * LANES + i])


def _acceleration(
    block: Any, i: int, medium: Medium, Q: Tensor, k: Vector, v: Vector, J: Any
) -> tuple[Vector, Vector]:
    """Acceleration of the barycentre (34), m/s², and the rates of drag, 1/s, with resistances R k."""
    u = load3(block, at.u, i)
    a, inertia = acceleration(
        J,
        block[at.rho * LANES + i],
        medium.rho,
        medium.gravity,
        medium.pressure_gradient,
        medium.virtual_mass,
        load3(block, at.DuDt, i),
    )
    r = _drag_rate(block, i, medium.mu, k)
    rate = (r[0] / inertia, r[1] / inertia, r[2] / inertia)
    w = dot_vector(Q, (u[0] - v[0], u[1] - v[1], u[2] - v[2]))
    a_D = vector_dot((rate[0] * w[0], rate[1] * w[1], rate[2] * w[2]), Q)
    return (a[0] + a_D[0], a[1] + a_D[1], a[2] + a_D[2]), rate


def _damped(Q: Tensor, rate: Vector, gh: Any, r: Vector) -> Vector:
    """Solution k of (1 + γh rate_a) k_a = r_a in the frame Q."""
    w = dot_vector(Q, r)
    d = reciprocals((1.0 + gh * rate[0], 1.0 + gh * rate[1], 1.0 + gh * rate[2]))
    return vector_dot((w[0] * d[0], w[1] * d[1], w[2] * d[2]), Q)


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
        e = _elasticity(block, i, stretches, b_e, 0.0)
        Y = solve_inertialess(m, e, GAMMA * h, medium.mu, l_s)
        kF = from_frame(Q, Y)
        store9(block, slope.kF, i, kF)
        store3(block, slope.kx, i, kx)
        store9(block, at.new_F, i, dot(exponential(scale(h, kF)), F))
        store3(block, at.new_x, i, (x[0] + h * kx[0], x[1] + h * kx[1], x[2] + h * kx[2]))
        store9(block, slope.start_Q, i, Q)
        store9(block, inertialess.normal, i, m.normal)
        store3(block, inertialess.compliance, i, m.compliance)
        store3(block, inertialess.slip, i, m.slip)
        store3(block, inertialess.squares, i, e.squares)
        store9(block, inertialess.slopes, i, e.slopes)
        store3(block, inertialess.shear, i, e.shear)


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
        _finish(block, i, F, from_frame(Q0, Y), (k1x, k2x))
        F_new = load9(block, at.new_F, i)
        J = det(F_new)
        F_new = isochoric(F_new, J)
        store9(block, at.new_F, i, F_new)
        block[at.J * LANES + i] = J
        store9(block, at.new_A, i, dot(l_p, F_new))
        store3(block, at.new_v, i, v)


def _load_response(block: Any, i: int) -> tuple[Mobility, Elasticity]:
    """Mobility and elasticity at the start of the step, as stage 1 left them, for the step's equations."""
    compliance, slip = load3(block, inertialess.compliance, i), load3(block, inertialess.slip, i)
    m = Mobility(load9(block, inertialess.normal, i), compliance, slip, 1.0)
    squares, shear = load3(block, inertialess.squares, i), load3(block, inertialess.shear, i)
    return m, Elasticity(squares, load9(block, inertialess.slopes, i), shear)


def _balance(
    block: Any, i: int, medium: Medium, Q: Tensor, stretches: Vector, g: Integrals, m: Mobility, b_e: Tensor
) -> tuple[Tensor, Vector]:
    """l_s in the particle frame, 1/s, and the barycentre's velocity u + K⁻¹ f_G/μ_f, m/s."""
    tau = _conservative_stress(block, i, stretches, b_e, 0.0 * b_e[0] + 1.0)
    sigma = scale(1.0 / medium.mu, tau)
    l_f = to_frame(Q, load9(block, at.l, i))
    l_s = velocity_gradient(stretches, g, m, sigma, l_f)
    rate = _drag_rate(block, i, medium.mu, drag(stretches, g))
    rho, DuDt = block[at.rho * LANES + i], load3(block, at.DuDt, i)
    a = slip_acceleration(1.0, rho, medium.rho, medium.gravity, medium.pressure_gradient, DuDt)
    u, w = load3(block, at.u, i), _drift(Q, rate, a)
    return l_s, (u[0] + w[0], u[1] + w[1], u[2] + w[2])


def end_inertial(block: Any, medium: Medium) -> None:
    """A and v at the end belong to the state, which the stages have left in the block."""


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


first_slope, second_slope, end_slope = first_inertial, second_inertial, end_inertial


def _begin(block: Any, i: int, h: float) -> None:
    """Put the state of lane i where the frame is taken from, and its step."""
    store9(block, at.new_F, i, load9(block, at.F, i))
    block[at.dt * LANES + i] = h


def _predicted_host(flow: Any, host: int, block: Any, i: int) -> int:
    """Host of the predicted position, or the last one on the way to a boundary."""
    found, _, patch, _ = walk(flow, host, load3(block, at.x, i), load3(block, at.new_x, i))
    return host if patch == -2 else found


def _next_size(h: float, error: float, tolerance: float) -> float:
    """Step that the error estimate, of second order in h, allows."""
    if not math.isfinite(error):
        return _LEAST * h
    factor = _SAFETY * math.sqrt(tolerance / (error + 1e-300))
    return h * min(_MOST, max(_LEAST, factor))


def track_adaptive(
    flow: Any,
    patches: PatchTable,
    medium: Medium,
    p: Particles,
    members: NDArray[np.int64],
    step: int,
    steps: int,
    dt: float,
    start: float,
    scratch: Scratch,
    tolerance: float,
) -> int:
    """Carry up to LANES particles through ``steps`` tracking steps, each in steps h ≤ Δt of its own.

    Parameters
    ----------
    As :func:`foamprb.cloud.advance.track_block`, with a block of the integrator's rows, and
    tolerance
        Largest error of a step in the deformation gradient, and in the direction of the path.

    Returns
    -------
    The number of walks that failed and were mended by the tree.
    """
    recovered = 0
    last = step + steps
    block, status, current = scratch.block, scratch.status, scratch.step
    idle_lanes(block, dt)
    for i in range(LANES):
        current[i] = step
    for i in range(len(members)):
        load_particle(p, members[i], scratch, i)
        if status[i] == ACTIVE:
            block[at.clearance * LANES + i], _, _ = clearance_of(flow, scratch, i)

    while True:
        moving = 0
        for i in range(len(members)):
            block[at.moving * LANES + i] = 0.0
            while status[i] == PENDING and current[i] < last:
                if block[at.t0 * LANES + i] < start + (current[i] + 1) * dt - SHORTEST_STEP * dt:
                    release(flow, patches, scratch, i)
                    block[at.h * LANES + i] = dt
                else:
                    current[i] += 1
            if status[i] != ACTIVE or current[i] >= last:
                continue
            moving += 1
            block[at.moving * LANES + i] = 1.0
            t, size = block[at.t * LANES + i], block[at.h * LANES + i]
            rest = start + (current[i] + 1) * dt - t
            # A little more than one step left is two equal ones, not one and a sliver; round-off is not more.
            h = rest if size >= rest - SHORTEST_STEP * dt else min(size, 0.5 * rest)
            _begin(block, i, h)
            u, l_f, u_t = sample(flow, scratch.host[i], load3(block, at.x, i), t)
            store_fluid(block, i, u, l_f, u_t)
        if moving == 0:
            break

        new_frames(block)
        integrals_stage(block)
        first_slope(block, medium)
        for i in range(len(members)):
            if status[i] == ACTIVE and current[i] < last:
                host = _predicted_host(flow, scratch.host[i], block, i)
                t_new = block[at.t * LANES + i] + block[at.dt * LANES + i]
                u, l_f, u_t = sample(flow, host, load3(block, at.new_x, i), t_new)
                store_fluid(block, i, u, l_f, u_t)
        new_frames(block)
        integrals_stage(block)
        second_slope(block, medium)
        accept_stage(block, tolerance)

        for i in range(len(members)):
            if status[i] != ACTIVE or current[i] >= last:
                continue
            h = block[at.dt * LANES + i]
            t_end = start + (current[i] + 1) * dt
            error = block[at.error * LANES + i]
            size = _next_size(h, error, tolerance)
            if not error <= tolerance:
                block[at.h * LANES + i] = size
                if size < _SMALLEST * dt:
                    fail(scratch, i, NOT_CONVERGED)
                continue
            if not is_sound(scratch, i):
                continue
            t_new = block[at.t * LANES + i] + h
            whole = t_new >= t_end - SHORTEST_STEP * dt
            if whole:
                t_new = t_end
                # A step cut short by the end of Δt says nothing against the size before it.
                size = max(size, block[at.h * LANES + i])
            block[at.h * LANES + i] = min(dt, size)
            goal = load3(block, at.new_x, i)
            recovered += reach_end(flow, patches, scratch, i, goal, t_new, h)
            if whole:
                current[i] += 1
    for i in range(len(members)):
        block[at.moving * LANES + i] = 0.0
        if status[i] == ACTIVE:
            block[at.moving * LANES + i] = 1.0
            store9(block, at.new_F, i, load9(block, at.F, i))
            x, t = load3(block, at.x, i), block[at.t * LANES + i]
            u, l_f, u_t = sample(flow, scratch.host[i], x, t)
            store_fluid(block, i, u, l_f, u_t)
    new_frames(block)
    integrals_stage(block)
    end_slope(block, medium)
    for i in range(len(members)):
        save_particle(p, members[i], scratch, i)
    return recovered


ADAPTIVE_STAGES = (
    frame_stage,
    stretch_stage,
    straighten_stage,
    integrals_stage,
    accept_stage,
)
"""Parts of the loop that do not depend on the flow, compiled once for all flows; an integrator has more."""
