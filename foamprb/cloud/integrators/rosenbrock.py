"""The integrator ``rosenbrock``: with inertia of the solid, of second order.

The formulas are those of :mod:`foamprb.body.rosenbrock`. The shape's unknowns are F and l_s = A F⁻¹.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from foamprb.body.drag import oberbeck as drag
from foamprb.body.ellipsoid import Integrals
from foamprb.body.material import finger_of_sphere as finger
from foamprb.body.material import viscous_stress
from foamprb.body.rosenbrock import GAMMA, Stiffness, elastic_response, inertial_stiffness, solve_inertial
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
    to_frame,
    transpose,
    vector_dot,
)
from foamprb.body.traction import roscoe as traction
from foamprb.cloud.block import BLOCK_STAGES, Medium, at, load3, load9, load_integrals, store3, store9
from foamprb.cloud.elastic import conservative_stress, solid_elasticity
from foamprb.cloud.forces.total import acceleration
from foamprb.cloud.integrators.adaptive import drag_rate
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.integrators.second_order import SECOND_ORDER_ROWS, finish, largest, slope, track_adaptive
from foamprb.cloud.layout import LANES, Row, layout, offsets


class StiffnessRows(NamedTuple):
    """What stage 2 needs of stage 1 beside the :class:`SlopeRows`, the :class:`Stiffness` included."""

    kv: Annotated[int, Row(3, "m/s2", "slope of the velocity")]
    kL: Annotated[int, Row(9, "1/s2", "slope of the body's velocity gradient l_s")]
    rate: Annotated[int, Row(3, "1/s", "rates of drag along the axes of the frame")]
    b: Annotated[int, Row(3, "1", "λ_a²")]
    traction: Annotated[int, Row(9, "1/s", "how the traction's normal stresses resist stretching")]
    traction_first: Annotated[int, Row(9, "1/s", "how its shear stresses do, 23 and 13")]
    traction_second: Annotated[int, Row(9, "1/s", "the same, 12")]
    elastic: Annotated[int, Row(9, "1/s2", "how the elastic normal stresses resist strain")]
    elastic_first: Annotated[int, Row(9, "1/s2", "how the elastic shear stresses do, 23 and 13")]
    elastic_second: Annotated[int, Row(9, "1/s2", "the same, 12")]


own = offsets(StiffnessRows, SECOND_ORDER_ROWS)


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
        e = solid_elasticity(block, i, stretches, b_e, 1.0)
        n = inertial_stiffness(stretches, g, e, c, medium.mu, block[at.eta * LANES + i])
        r = add(W, scale(-1.0, dot(dot(L, L), b)))
        Y = solve_inertial(n, gh, add(r, scale(-gh, elastic_response(n, L))))
        kL = from_frame(Q, Y)
        kF = add(l_s, scale(gh, kL))
        _store_stiffness(block, i, n)
        store9(block, own.kL, i, kL)
        store9(block, slope.kF, i, kF)
        store9(block, at.new_A, i, add(l_s, scale(h, kL)))
        store9(block, at.new_F, i, dot(exponential(scale(h, kF)), F))

        v, x = load3(block, at.v, i), load3(block, at.x, i)
        a, rate = _acceleration(block, i, medium, Q, drag(stretches, g), v, det(F))
        kv = _damped(Q, rate, gh, a)
        kx = (v[0] + gh * kv[0], v[1] + gh * kv[1], v[2] + gh * kv[2])
        store3(block, own.kv, i, kv)
        store3(block, slope.kx, i, kx)
        store3(block, at.new_v, i, (v[0] + h * kv[0], v[1] + h * kv[1], v[2] + h * kv[2]))
        store3(block, at.new_x, i, (x[0] + h * kx[0], x[1] + h * kx[1], x[2] + h * kx[2]))
        store9(block, slope.start_Q, i, Q)
        store3(block, own.rate, i, rate)


def second_inertial(block: Any, medium: Medium) -> None:
    """Stage 2 with inertia: slopes at the predicted state, and the new state."""
    for i in range(LANES):
        h = block[at.dt * LANES + i]
        gh = GAMMA * h
        n = _load_stiffness(block, i)
        Q0, rate0 = load9(block, slope.start_Q, i), load3(block, own.rate, i)
        Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
        F, A = load9(block, at.F, i), load9(block, at.A, i)
        F_p, l_p = load9(block, at.new_F, i), load9(block, at.new_A, i)
        k1F, k1L = load9(block, slope.kF, i), load9(block, own.kL, i)
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
        k1v, k1x = load3(block, own.kv, i), load3(block, slope.kx, i)
        f_v, _ = _acceleration(block, i, medium, Q, drag(stretches, g), v_p, det(F_p))
        k2v = _damped(Q0, rate0, gh, (f_v[0] - 2.0 * k1v[0], f_v[1] - 2.0 * k1v[1], f_v[2] - 2.0 * k1v[2]))
        k2x = (
            v_p[0] - 2.0 * k1x[0] + gh * k2v[0],
            v_p[1] - 2.0 * k1x[1] + gh * k2v[1],
            v_p[2] - 2.0 * k1x[2] + gh * k2v[2],
        )
        finish(block, i, F, k2F, (k1x, k2x))
        F_new = load9(block, at.new_F, i)
        store9(block, at.new_A, i, dot(l_s, F_new))
        block[at.J * LANES + i] = det(F_new)
        # Over the step, an error of l_s is one of the deformation gradient.
        error = 0.5 * h * h * largest(add(k1L, k2L))
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
    tau = conservative_stress(block, i, stretches, b_e, J)
    c = _inertia(block, i)
    return add(scale(c * J, stress), scale(-c, tau))


def _acceleration(
    block: Any, i: int, medium: Medium, Q: Tensor, k: Vector, v: Vector, J: Any
) -> tuple[Vector, Vector]:
    """Acceleration of the barycentre (34), m/s², and the rates of drag, 1/s, with resistances R k."""
    u = load3(block, at.u, i)
    a, inertia = acceleration(block, i, medium, J)
    r = drag_rate(block, i, medium.mu, k)
    rate = (r[0] / inertia, r[1] / inertia, r[2] / inertia)
    w = dot_vector(Q, (u[0] - v[0], u[1] - v[1], u[2] - v[2]))
    a_D = vector_dot((rate[0] * w[0], rate[1] * w[1], rate[2] * w[2]), Q)
    return (a[0] + a_D[0], a[1] + a_D[1], a[2] + a_D[2]), rate


def _inertia(block: Any, i: int) -> float:
    """c = 5/(ρ_s R²), the inverse inertia of the shape per volume."""
    R = block[at.R * LANES + i]
    return 5.0 / (block[at.rho * LANES + i] * R * R)  # type: ignore[no-any-return]


def _damped(Q: Tensor, rate: Vector, gh: Any, r: Vector) -> Vector:
    """Solution k of (1 + γh rate_a) k_a = r_a in the frame Q."""
    w = dot_vector(Q, r)
    d = reciprocals((1.0 + gh * rate[0], 1.0 + gh * rate[1], 1.0 + gh * rate[2]))
    return vector_dot((w[0] * d[0], w[1] * d[1], w[2] * d[2]), Q)


def _combine(y: Tensor, h: Any, k1: Tensor, k2: Tensor) -> Tensor:
    """Y + h (3 k₁ + k₂)/2."""
    return add(y, add(scale(1.5 * h, k1), scale(0.5 * h, k2)))


def _store_stiffness(block: Any, i: int, n: Stiffness) -> None:
    store3(block, own.b, i, n.b)
    store9(block, own.traction, i, n.traction)
    store9(block, own.traction_first, i, n.traction_pairs[0])
    store9(block, own.traction_second, i, n.traction_pairs[1])
    store9(block, own.elastic, i, n.elastic)
    store9(block, own.elastic_first, i, n.elastic_pairs[0])
    store9(block, own.elastic_second, i, n.elastic_pairs[1])


def _load_stiffness(block: Any, i: int) -> Stiffness:
    return Stiffness(
        load3(block, own.b, i),
        load9(block, own.traction, i),
        (load9(block, own.traction_first, i), load9(block, own.traction_second, i)),
        load9(block, own.elastic, i),
        (load9(block, own.elastic_first, i), load9(block, own.elastic_second, i)),
    )


ROSENBROCK = Integrator(
    name="rosenbrock",
    description="with inertia, second order, implicit in elasticity and traction",
    order=2,
    track=track_adaptive,
    stages=(*BLOCK_STAGES, first_inertial, second_inertial),
    layout=layout(at, slope, own),
    bindings={"first_slope": first_inertial, "second_slope": second_inertial},
    adaptive=True,
)
