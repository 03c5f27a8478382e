"""What walls send back to a soft particle near them: lift, strain, and hindered motion.

The formulas are those of :mod:`foamprb.body.wall`. The walls around a particle are looked for once before
each step; within it they are planes.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import reach
from foamprb.body.material import finger_of_sphere_in_frame as finger_in_frame
from foamprb.body.stokes import Mobility, mobility, velocity_gradient
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    dev,
    dot,
    dot_vector,
    from_frame,
    inverse,
    principal_frame,
    scale,
    select,
    skew,
    sym,
    to_frame,
    trace,
    transpose,
    vector_dot,
)
from foamprb.body.traction import disturbance
from foamprb.body.wall import (
    force_gradient,
    hindered_resistance,
    hindrance,
    stresslet_gradient,
    stresslet_velocity,
)
from foamprb.cloud.block import Medium, Scratch, at, choose, load3, load9, load_integrals, store3, store9
from foamprb.cloud.elastic import incompressible_stress
from foamprb.cloud.forces.total import pushes_on
from foamprb.cloud.layout import LANES, Row, offsets
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.resistance import resistances
from foamprb.compile.link import link
from foamprb.dictionary.constraints import Bounds, Meaning, Positive, Words
from foamprb.errors import InputError, suggestion
from foamprb.flow.analytic import walls_free as walls
from foamprb.flow.base import WALLS, Floats, Flow, Patch

__all__ = ["CLOSE", "WallLift"]

CLOSE = 2.0
"""Distance of the centre from a wall, in radii, within which the steps of a particle are counted."""
_FAR = 1e9
"""Distance of a wall that is not there, in radii, or in metres in a lane without a particle."""
_REPEATS = 2


class WallRows(NamedTuple):
    """The walls around a particle, and what they send back."""

    wall_distance: Annotated[int, Row(3, "m", "distances of the centre from up to three walls", _FAR)]
    wall_normal: Annotated[int, Row(9, "1", "their unit normals into the fluid")]
    counted: Annotated[int, Row(1, "", "tracking step, from 1 on, at which walls were last looked for")]
    close: Annotated[int, Row(1, "", "steps begun near a wall", of="close", saved=True)]
    one_distance: Annotated[int, Row(1, "m", "distance of the centre from one of them, now", 1.0)]
    one_normal: Annotated[int, Row(3, "1", "its normal")]
    one_gap: Annotated[int, Row(1, "m", "gap between body and wall", 1.0)]
    there: Annotated[int, Row(1, "", "1 if there is that wall, else 0")]
    alone: Annotated[int, Row(9, "N m", "stresslet of the particle without walls")]
    stresslet: Annotated[int, Row(9, "N m", "stresslet of the particle")]
    gives_normal: Annotated[int, Row(9, "1", "how the body gives way: its mobility")]
    gives_shear: Annotated[int, Row(3, "1", "the same, in shear")]
    gives_slip: Annotated[int, Row(3, "1", "(b² − c²)/(b² + c²) and its cyclic companions")]
    sent_back: Annotated[int, Row(9, "1/s", "velocity gradient that the walls send back")]
    least_gap: Annotated[int, Row(1, "1", "least gap, in radii", 1.0)]
    wall_lift: Annotated[int, Row(3, "m/s", "velocity that they send back")]
    load: Annotated[int, Row(3, "N", "force of the particle on the fluid")]
    by_load: Annotated[int, Row(9, "1/s", "velocity gradient that they send back of it")]
    hindrance: Annotated[int, Row(9, "1", "resistance that they add, in the particle frame")]
    drag_frame: Annotated[int, Row(9, "1", "frame in which the drag at the start of a step is diagonal")]


near = offsets(WallRows)


def look_for_walls(
    flow: Any, s: Scratch, i: int, step: int, _rest: float, _medium: Medium, coefficients: Any
) -> None:
    """Put the walls around the particle in lane i into its rows, and count the step if one is close."""
    cut_off, least_gap, _, _, chosen = coefficients
    block = s.block
    R = block[at.R * LANES + i]
    p = walls(flow, s.host[i], load3(block, at.x, i), cut_off * R, chosen)
    store3(block, near.wall_distance, i, (min(p.h1, _FAR * R), min(p.h2, _FAR * R), min(p.h3, _FAR * R)))
    block[near.least_gap * LANES + i] = least_gap
    store3(block, near.wall_normal, i, p.n1)
    store3(block, near.wall_normal + 3, i, p.n2)
    store3(block, near.wall_normal + 6, i, p.n3)
    if block[near.counted * LANES + i] != step + 1.0:
        block[near.counted * LANES + i] = step + 1.0
        if min(p.h1, p.h2, p.h3) < CLOSE * R:
            block[near.close * LANES + i] += 1.0


def lift(block: Any, medium: Medium, share: float, coefficients: Any) -> None:
    """Add what the walls send back of the particles' stresslets to u and l, and hold back what falls.

    The stresslet is that of the flow with the walls' own gradient, to which it comes by repetition. The
    gradient of the image of a load deforms; what the stresslet that a rigid body answers with does to the
    velocity is a part of the mobility.
    """
    _, least_gap, strain, hindered, _ = coefficients
    most = 0
    for i in range(LANES):
        h, far = load3(block, near.wall_distance, i), 0.5 * _FAR * block[at.R * LANES + i]
        most = max(most, (h[0] < far) + (h[1] < far) + (h[2] < far))
    if most == 0:
        return
    for i in range(LANES):
        nothing = scale(0.0, load9(block, at.l, i))
        store9(block, near.hindrance, i, nothing)
        store9(block, near.by_load, i, nothing)
    if hindered > 0.0:
        before_lift(block, medium, share, least_gap, strain, most)
    for i in range(LANES):
        store3(block, near.wall_lift, i, (0.0, 0.0, 0.0))
        S = stresslet(block, i, medium, load9(block, at.l, i), body_gradient(block, i, medium, share))
        store9(block, near.alone, i, S)
        store9(block, near.stresslet, i, S)
    for _ in range(_REPEATS):
        for i in range(LANES):
            store9(block, near.sent_back, i, scale(0.0, load9(block, at.l, i)))
        for wall in range(most):
            add_sent_back(block, wall, share, least_gap, medium, 1.0)
        for i in range(LANES):
            E = scale(strain, load9(block, near.sent_back, i))
            S = stresslet(block, i, medium, E, body_response(block, i, medium, E))
            store9(block, near.stresslet, i, add(load9(block, near.alone, i), S))
    for wall in range(most):
        pick_wall(block, wall, share, least_gap)
        for i in range(LANES):
            n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
            v = stresslet_velocity(load9(block, near.stresslet, i), shape_of(block, i), n, d, medium.mu)
            w, there = load3(block, near.wall_lift, i), block[near.there * LANES + i]
            store3(block, near.wall_lift, i, (w[0] + there * v[0], w[1] + there * v[1], w[2] + there * v[2]))
        if hindered > 0.0:
            for i in range(LANES):
                n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
                W = hindrance_of(block, i, n, d, block[near.one_gap * LANES + i])
                W = scale(block[near.there * LANES + i], W)
                store9(block, near.hindrance, i, add(load9(block, near.hindrance, i), W))
    if hindered > 0.0:
        after_lift(block, medium, share, least_gap, strain, most)
    for i in range(LANES):
        some = any_near(block, i)
        l, u, w = load9(block, at.l, i), load3(block, at.u, i), load3(block, near.wall_lift, i)
        E = add(scale(strain, load9(block, near.sent_back, i)), load9(block, near.by_load, i))
        store9(block, at.l, i, choose(some, add(l, E), l))
        store3(
            block,
            at.u,
            i,
            (
                select(some, u[0] + w[0], u[0]),
                select(some, u[1] + w[1], u[1]),
                select(some, u[2] + w[2], u[2]),
            ),
        )


def any_near(block: Any, i: int) -> Any:
    """Whether lane i has a wall near it."""
    h, far = load3(block, near.wall_distance, i), 0.5 * _FAR * block[at.R * LANES + i]
    return (h[0] < far) | (h[1] < far) | (h[2] < far)


def strain_by_load(
    block: Any, medium: Medium, share: float, least_gap: float, strain: float, most: int
) -> None:
    """The gradient by which the image of a load deforms, and that of the rigid stresslet that answers it."""
    for i in range(LANES):
        store3(block, near.load, i, load_of(block, i, medium, share))
    for wall in range(most):
        pick_wall(block, wall, share, least_gap)
        for i in range(LANES):
            n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
            E = force_gradient(load3(block, near.load, i), shape_of(block, i), n, d, medium.mu)
            E = scale(strain * block[near.there * LANES + i], E)
            store9(block, near.by_load, i, add(load9(block, near.by_load, i), E))
    for i in range(LANES):
        E = load9(block, near.by_load, i)
        store9(block, near.sent_back, i, E)
        store9(block, near.stresslet, i, stresslet(block, i, medium, E, scale(0.0, E)))
    for wall in range(most):
        add_sent_back(block, wall, share, least_gap, medium, strain)
    for i in range(LANES):
        store9(block, near.by_load, i, load9(block, near.sent_back, i))


def hold_back(
    block: Any, medium: Medium, _share: float, _least_gap: float, _strain: float, _most: int
) -> None:
    """Add what the walls take off the velocity by the load to that which they send back."""
    for i in range(LANES):
        v = held_back(block, i, medium)
        w = load3(block, near.wall_lift, i)
        store3(block, near.wall_lift, i, (w[0] + v[0], w[1] + v[1], w[2] + v[2]))


def no_load_yet(
    _block: Any, _medium: Medium, _share: float, _least_gap: float, _strain: float, _most: int
) -> None:
    """Before the lift is known, so is not the drag of a body with inertia."""


def strain_by_drag(
    block: Any, medium: Medium, share: float, least_gap: float, strain: float, most: int
) -> None:
    """As :func:`strain_by_load`, of a body with inertia; what the walls take off, of the molecules' push."""
    for i in range(LANES):
        # The stresslet without walls has served.
        store9(block, near.alone, i, load9(block, near.sent_back, i))
    strain_by_load(block, medium, share, least_gap, strain, most)
    for i in range(LANES):
        store9(block, near.sent_back, i, load9(block, near.alone, i))
        store3(block, near.load, i, thermal_force(block, i))
    hold_back(block, medium, share, least_gap, strain, most)


def add_sent_back(
    block: Any, wall: int, share: float, least_gap: float, medium: Medium, factor: float
) -> None:
    """Add the gradient that one of the walls sends back of the stresslets, times a factor, to its rows."""
    pick_wall(block, wall, share, least_gap)
    for i in range(LANES):
        n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
        E = stresslet_gradient(load9(block, near.stresslet, i), shape_of(block, i), n, d, medium.mu)
        E = scale(factor * block[near.there * LANES + i], E)
        store9(block, near.sent_back, i, add(load9(block, near.sent_back, i), E))


def pick_wall(block: Any, wall: int, share: float, least_gap: float) -> None:
    """Put one of the walls of all lanes, seen from the place at that share of the way, into rows of its own.

    Rows that are chosen by a number would keep the loops that read them from being vectorised.
    """
    for i in range(LANES):
        block[near.one_distance * LANES + i] = block[(near.wall_distance + wall) * LANES + i]
        for k in range(3):
            block[(near.one_normal + k) * LANES + i] = block[(near.wall_normal + 3 * wall + k) * LANES + i]
    for i in range(LANES):
        R, h, n = (
            block[at.R * LANES + i],
            block[near.one_distance * LANES + i],
            load3(block, near.one_normal, i),
        )
        there = select(h < 0.5 * _FAR * R, 1.0, 0.0)
        x, y = load3(block, at.x, i), load3(block, at.new_x, i)
        # At the start of a step new_x is not known.
        way = (y[0] - x[0]) * n[0] + (y[1] - x[1]) * n[1] + (y[2] - x[2]) * n[2]
        h, gap = clear_of(block, i, n, h + select(share > 0.0, share * way, 0.0), least_gap)
        block[near.there * LANES + i] = there
        block[near.one_distance * LANES + i] = h
        block[near.one_gap * LANES + i] = gap


def clear_of(block: Any, i: int, n: Vector, h: float, least_gap: float) -> tuple[float, float]:
    """Distance of the centre of lane i from a wall and gap between them, m.

    The gap is no less than so many radii, and the distance agrees with it.
    """
    R = block[at.R * LANES + i]
    extent = reach(R, load9(block, at.new_F, i), n)
    gap = np.maximum(h - extent, least_gap * R)
    return gap + extent, gap


def shape_of(block: Any, i: int) -> Tensor:
    """Shape tensor R² F Fᵀ of lane i, m²."""
    F, R = load9(block, at.new_F, i), block[at.R * LANES + i]
    return scale(R * R, dot(F, transpose(F)))


def stresslet(block: Any, i: int, medium: Medium, l_f: Tensor, l_s: Tensor) -> Tensor:
    """S = V μ_f dev sym s̃(l_f − l_s) of lane i, N m: l_f in space's axes, l_s in the particle's, 1/s."""
    Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
    relative = add(to_frame(Q, l_f), scale(-1.0, l_s))
    s, _ = disturbance(stretches, g, dev(sym(relative)), skew(relative))
    R = block[at.R * LANES + i]
    volume = 4.0 / 3.0 * math.pi * R * R * R * stretches[0] * stretches[1] * stretches[2]
    return from_frame(Q, scale(volume * medium.mu, dev(sym(s))))


def balanced_gradient(block: Any, i: int, medium: Medium, share: float) -> Tensor:  # noqa: ARG001
    """l_s of a body without inertia in the flow of lane i, in the particle frame, 1/s; keeps its mobility.

    The gradient that the image of the load makes is seen here only: the stresslet is then that by which the
    body differs from a rigid one, whose own is in the hindrance.
    """
    Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
    m = mobility(stretches, g, block[at.eta * LANES + i] / medium.mu)
    store9(block, near.gives_normal, i, m.normal)
    store3(block, near.gives_shear, i, m.compliance)
    store3(block, near.gives_slip, i, m.slip)
    b_e = finger_in_frame(stretches, dot(Q, load9(block, at.new_F, i)), load9(block, at.M, i))
    tau = incompressible_stress(block, i, stretches, b_e)
    l = add(load9(block, at.l, i), load9(block, near.by_load, i))
    return velocity_gradient(m, scale(1.0 / medium.mu, tau), to_frame(Q, l))


def giving_way(block: Any, i: int, medium: Medium, E: Tensor) -> Tensor:
    """By how much l_s of such a body changes with a gradient E (space's axes), in the particle frame, 1/s."""
    m = Mobility(
        load9(block, near.gives_normal, i),
        load3(block, near.gives_shear, i),
        load3(block, near.gives_slip, i),
        1.0 - block[at.eta * LANES + i] / medium.mu,
    )
    l = to_frame(load9(block, at.Q, i), E)
    return velocity_gradient(m, scale(0.0, l), l)


def moving_gradient(block: Any, i: int, medium: Medium, share: float) -> Tensor:  # noqa: ARG001
    """l_s of a body with inertia, which is its state, in the particle frame, 1/s."""
    Q = load9(block, at.Q, i)
    if share > 0.0:
        return to_frame(Q, load9(block, at.new_A, i))
    return to_frame(Q, dot(load9(block, at.A, i), inverse(load9(block, at.F, i))))


def leave_moving_gradient(block: Any, i: int, Q: Tensor, l_s: Tensor, wanted: Any) -> None:
    """Put its l_s, components in the frame Q, where :func:`moving_gradient` finds it, if it is wanted."""
    l = from_frame(Q, l_s)
    store9(block, at.new_A, i, choose(wanted, l, load9(block, at.new_A, i)))


def standing_firm(block: Any, i: int, medium: Medium, E: Tensor) -> Tensor:  # noqa: ARG001
    """That a body with inertia does not give way at once."""
    return scale(0.0, E)


def balanced_load(block: Any, i: int, medium: Medium, share: float) -> Vector:  # noqa: ARG001
    """What a body without inertia exerts on the fluid, N: the forces on it less its inertia."""
    Du_Dt, t = load3(block, at.DuDt, i), thermal_force(block, i)
    _, push, inertia = pushes_on(block, i, medium, 1.0, Du_Dt)
    a = (push[0] - inertia * Du_Dt[0], push[1] - inertia * Du_Dt[1], push[2] - inertia * Du_Dt[2])
    R = block[at.R * LANES + i]
    m = 4.0 / 3.0 * math.pi * R * R * R * block[at.rho * LANES + i]
    return m * a[0] + t[0], m * a[1] + t[1], m * a[2] + t[2]


def drag_on_fluid(block: Any, i: int, medium: Medium, share: float) -> Vector:
    """What a body with inertia exerts on the fluid, N: μ_f K·(v − u), u with what the walls send back.

    In a step h that is long against the time m/μ_f K in which drag balances the forces, these in its place:
    v and the body's velocity gradient, in which it is strained, would each be found from the other's error,
    and grow. Their weight is of the fourth order in h.
    """
    Q, k, u, w = (
        load9(block, at.Q, i),
        resistances(block, i),
        load3(block, at.u, i),
        load3(block, near.wall_lift, i),
    )
    v = load3(block, at.new_v, i) if share > 0.0 else load3(block, at.v, i)
    slip = dot_vector(Q, (v[0] - u[0] - w[0], v[1] - u[1] - w[1], v[2] - u[2] - w[2]))
    K = hindered_resistance(k, load9(block, near.hindrance, i))
    d = vector_dot(dot_vector(scale(medium.mu, K), slip), Q)
    f = balanced_load(block, i, medium, share)
    R = block[at.R * LANES + i]
    m = 4.0 / 3.0 * math.pi * R * R * R * block[at.rho * LANES + i]
    x = block[at.dt * LANES + i] * medium.mu * trace(K) / (6.0 * m)
    y = x * x * x * x
    c = y / (1.0 + y)
    return d[0] + c * (f[0] - d[0]), d[1] + c * (f[1] - d[1]), d[2] + c * (f[2] - d[2])


def hindered_rate(block: Any, i: int, rate: Vector) -> Tensor:
    """Rates of drag of lane i near its walls, 1/s, in the particle frame, from those without."""
    W = load9(block, near.hindrance, i)
    # Where no lane has a wall, those of an earlier step are left.
    return hindered_resistance(rate, choose(any_near(block, i), W, scale(0.0, W)))


def across_axes(block: Any, i: int, rate: Vector, w: Vector) -> Vector:
    """As :func:`foamprb.cloud.surroundings.resistance.along_own_axes`, near walls."""
    return dot_vector(hindered_rate(block, i, rate), w)


def find_hindered_axes(block: Any, i: int, Q: Tensor, rate: Vector) -> tuple[Tensor, Vector]:
    """Frame in which the drag near walls is diagonal at the start of a step, and its rates there, 1/s."""
    P, rates = principal_frame(hindered_rate(block, i, rate))
    axes = dot(P, Q)
    store9(block, near.drag_frame, i, axes)
    return axes, rates


def hindered_axes(block: Any, i: int, _Q: Tensor) -> Tensor:
    """That frame in the stages that follow."""
    return load9(block, near.drag_frame, i)


def no_thermal_force(_block: Any, _i: int) -> Vector:
    """Molecules do not push."""
    return 0.0, 0.0, 0.0


def hindrance_of(block: Any, i: int, n: Vector, h: float, gap: float) -> Tensor:
    """W of one wall, in the particle frame."""
    return hindrance(resistances(block, i), dot_vector(load9(block, at.Q, i), n), h, gap)


def hindrance_at_start(block: Any, i: int) -> Tensor:
    """W of all walls around lane i at the start of a step, in the particle frame."""
    return add(add(_hindrance_of(block, i, 0), _hindrance_of(block, i, 1)), _hindrance_of(block, i, 2))


def _hindrance_of(block: Any, i: int, wall: int) -> Tensor:
    n, h = load3(block, near.wall_normal + 3 * wall, i), block[(near.wall_distance + wall) * LANES + i]
    there = select(h < 0.5 * _FAR * block[at.R * LANES + i], 1.0, 0.0)
    h, gap = clear_of(block, i, n, h, block[near.least_gap * LANES + i])
    return scale(there, hindrance_of(block, i, n, h, gap))


def held_back(block: Any, i: int, medium: Medium) -> Vector:
    """What the walls take off the velocity relative to the fluid, (K_h⁻¹ − K⁻¹)·f/μ_f, m/s."""
    Q, k = load9(block, at.Q, i), resistances(block, i)
    f = dot_vector(Q, load3(block, near.load, i))
    v = dot_vector(inverse(hindered_resistance(k, load9(block, near.hindrance, i))), f)
    c = 1.0 / medium.mu
    w = (c * (v[0] - f[0] / k[0]), c * (v[1] - f[1] / k[1]), c * (v[2] - f[2] / k[2]))
    return vector_dot(w, Q)


def nearest_walls(p: Particles, arrays: Any, flow: Flow, cut_off: float, chosen: NDArray[np.int8]) -> Floats:
    """Distances of the particles from the nearest wall, in radii, (n,); infinite from ``cut_off`` on."""
    nearest = np.empty(p.size)
    link(_nearest_walls, flow.kernels)(arrays, p, cut_off, chosen, nearest)
    return nearest


def _nearest_walls(
    flow: Any, p: Particles, cut_off: float, chosen: NDArray[np.int8], nearest: Floats
) -> None:
    for k in range(len(nearest)):
        nearest[k] = math.inf
        if p.host[k] >= 0:
            x, R = (p.x[k, 0], p.x[k, 1], p.x[k, 2]), p.R[k]
            found = walls(flow, p.host[k], x, cut_off * R, chosen)
            nearest[k] = min(found.h1, found.h2, found.h3) / R


body_gradient: Callable[..., Tensor] = balanced_gradient
body_response: Callable[..., Tensor] = giving_way
load_of: Callable[..., Vector] = balanced_load
before_lift: Callable[..., None] = strain_by_load
after_lift: Callable[..., None] = hold_back
thermal_force: Callable[..., Vector] = no_thermal_force


_OF_INERTIA: Mapping[str, Callable[..., Any]] = {
    "load_of": drag_on_fluid,
    "before_lift": no_load_yet,
    "after_lift": strain_by_drag,
    "resist": across_axes,
    "find_drag_axes": find_hindered_axes,
    "drag_axes": hindered_axes,
}
"""What hinders a body with inertia: its drag, which a step takes as a whole tensor."""

_MORE_THAN_CLOSE = Bounds(CLOSE, math.inf, True, True, f"a number > {CLOSE:g}")


@dataclass(frozen=True, kw_only=True)
class WallLift(Surrounding):
    """What walls send back of a soft particle: ``wallLift;`` or ``wallLift { cutOff 10; }``."""

    cutOff: Annotated[
        float, _MORE_THAN_CLOSE, Meaning("distance of the centre beyond which a wall does not count", "radii")
    ] = 10.0
    strain: Annotated[bool, Meaning("whether the gradient that walls send back deforms the particle")] = True
    mobility: Annotated[bool, Meaning("whether walls hinder what settles; not with `paper`")] = True
    leastGap: Annotated[
        float, Positive, Meaning("gap below which motion across is hindered no more: roughness", "radii")
    ] = 0.01
    patches: (
        Annotated[Words, Meaning("patches that count: names, or patterns in quotes", "", "walls")] | None
    ) = None

    rows: ClassVar = WallRows
    place: ClassVar = "near"
    look: ClassVar = staticmethod(look_for_walls)
    disturb: ClassVar = staticmethod(lift)

    @property
    def sight(self) -> float:
        """Distance to which it asks the flow for walls, in radii."""
        return self.cutOff

    def seen(self, patches: Sequence[Patch]) -> Sequence[int]:
        """Which of the flow's patches it asks for."""
        return [int(index) for index in np.flatnonzero(self.chosen(patches))]

    def chosen(self, patches: Sequence[Patch]) -> NDArray[np.int8]:
        """1 for each patch that counts, else 0."""
        if self.patches is None:
            return np.array([patch.type in WALLS for patch in patches], dtype=np.int8)
        named = [any(re.fullmatch(p, patch.name) for p in self.patches) for patch in patches]
        return np.array(named, dtype=np.int8)

    def coefficients(self, patches: Sequence[Patch]) -> Any:
        """What the functions read."""
        strain, hindered = float(self.strain), float(self.mobility)
        return self.cutOff, self.leastGap, strain, hindered, self.chosen(patches)

    def bindings(self, inertia: bool) -> Mapping[str, Callable[..., Any]]:
        """How the body's own motion is known."""
        motion: Mapping[str, Callable[..., Any]] = {
            "body_gradient": moving_gradient if inertia else balanced_gradient,
            "body_response": standing_firm if inertia else giving_way,
            "leave_gradient": leave_moving_gradient,
        }
        if not self.mobility:
            return motion
        return {**motion, "hindrance_by_walls": hindrance_at_start, **(_OF_INERTIA if inertia else {})}

    def refuses(self, inertia: bool, integrator: str) -> str:  # noqa: ARG002
        """Not with the paper's, whose drag is along the particle's axes."""
        if self.mobility and integrator == "paper":
            return (
                "wallLift/mobility is yes, which needs the integrator stokes or rosenbrock, not paper: "
                "set mobility no, or integrationSchemes/shape rosenbrock"
            )
        return ""

    def notes(self, p: Particles, arrays: Any, flow: Flow) -> Sequence[str]:
        """How far the particles are from the walls where they start."""
        nearest = nearest_walls(p, arrays, flow, self.cutOff, self.chosen(flow.patches))
        some = nearest[np.isfinite(nearest)]
        beyond = len(nearest) - len(some)
        lines = (
            [f"{'distance to walls/radius':24s} {some.min():.4g} to {some.max():.4g}"] if len(some) else []
        )
        return [*lines, f"{'beyond cutOff':24s} {beyond}"]

    def summary(self, p: Particles, dt: float) -> Sequence[str]:
        """How often particles were close to a wall."""
        steps = (p.t - p.t0)[p.status != Status.PENDING].sum() / dt
        close, some = p.close.sum() / max(steps, 1.0), np.count_nonzero(p.close)
        return [f"{f'steps within {CLOSE:g} radii of walls':36s} {close:.2%}, of {some} particles"]

    def check(self, patches: Sequence[Patch]) -> None:
        """Raise InputError if a pattern matches no patch."""
        for pattern in self.patches or ():
            if not any(re.fullmatch(pattern, patch.name) for patch in patches):
                names = [patch.name for patch in patches]
                text = f"wallLift/patches is {pattern}, which is no patch. {suggestion(pattern, names)}"
                raise InputError(text.removesuffix("."))
