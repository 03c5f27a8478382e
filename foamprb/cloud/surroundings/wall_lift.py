"""Hydrodynamic effect of walls on a soft particle near them: lift, strain, and hindered motion.

The formulas are those of :mod:`foamprb.body.wall`. The walls around a particle are found once before each
step; within it they are planes. A wall *reflects* velocity and velocity gradient of the flow that a particle
causes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple, TypeAlias

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import reach
from foamprb.body.material import finger_of_body_in_frame
from foamprb.body.stokes import Mobility, velocity_gradient
from foamprb.body.tensor import (
    ZERO,
    Scalar,
    Tensor,
    Vector,
    add,
    between,
    dev,
    dot,
    dot_vector,
    from_frame,
    inner,
    inverse,
    minus,
    plus,
    plus_scaled,
    principal_frame,
    scale,
    scale_vector,
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
    reflected_share,
    stagnation_factor,
    stresslet_gradient,
    stresslet_velocity,
)
from foamprb.cloud.block import (
    Medium,
    Scratch,
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
    hindrance_by_walls,
    incompressible_stress,
    mobility_deficit,
    present_hindrance,
    resistances,
    volume_at_rest,
    with_tension,
)
from foamprb.cloud.forces import forces_on
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.integrators.rosenbrock import drag_axes, find_drag_axes, leave_gradient, resist
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.surroundings.base import (
    Remarks,
    Stage,
    Surrounding,
    Survey,
    add3,
    add9,
    curved_velocity,
    thermal_force,
    thermal_gradient,
)
from foamprb.compile.link import Slots, separate, slot, traced
from foamprb.dictionary.constraints import Bounds, Meaning, Positive, Words
from foamprb.dictionary.patterns import matches
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats, Flow, Ints, Patch
from foamprb.flow.kernels import linked_with, wall_speeds, walls
from foamprb.flow.patches import PatchKind

Numbers: TypeAlias = tuple[float, float, float, float, Floats]
"""Entries, and 1 for each patch that counts."""

CLOSE = 2.0
"""Distance of the centre from a wall, in radii, below which steps are counted as close."""
_FAR = 1e9
"""Distance of an absent wall, in radii, or in metres in a lane without a particle."""
_REPEATS = 2
_OFF_PLANE = 0.05
"""How far a wall may be from its plane at the end of a step longer than Δt, over its distance."""


class WallRows(NamedTuple):
    """Walls around a particle, and their effect on it."""

    wall_distance: Annotated[int, Row(3, "m", "distances of the centre from up to three walls", _FAR)]
    wall_normal: Annotated[int, Row(9, "1", "their unit normals into the fluid")]
    wall_speed: Annotated[int, Row(3, "m/s", "their velocities along these")]
    counted: Annotated[int, Row(1, "s", "start of the last step begun near a wall", -1e300, lasting=True)]
    counted_for: Annotated[int, Row(1, "s", "its length", lasting=True)]
    close: Annotated[int, Row(1, "s", "total length of such steps", of="close", saved=True)]
    one_distance: Annotated[int, Row(1, "m", "present distance of the centre from one of them", 1.0)]
    one_normal: Annotated[int, Row(3, "1", "its normal")]
    one_gap: Annotated[int, Row(1, "m", "gap between body and wall", 1.0)]
    present: Annotated[int, Row(1, "", "1 if that wall exists, else 0")]
    free_stresslet: Annotated[int, Row(9, "N m", "stresslet of the particle without walls")]
    stresslet: Annotated[int, Row(9, "N m", "stresslet of the particle")]
    mobility_normal: Annotated[int, Row(9, "1", "mobility of the body's shape")]
    mobility_shear: Annotated[int, Row(3, "1", "the same, in shear")]
    mobility_slip: Annotated[int, Row(3, "1", "(b² − c²)/(b² + c²) and its cyclic companions")]
    reflected: Annotated[int, Row(9, "1/s", "velocity gradient that the walls reflect")]
    least_gap: Annotated[int, Row(1, "1", "smallest gap, in radii", 1.0)]
    wall_lift: Annotated[int, Row(3, "m/s", "velocity that they reflect")]
    load: Annotated[int, Row(3, "N", "force of the particle on the fluid")]
    load_gradient: Annotated[int, Row(9, "1/s", "velocity gradient by its image")]
    held_force: Annotated[int, Row(3, "N", "force of molecules that has the gradient held_gradient")]
    held_gradient: Annotated[int, Row(9, "1/s", "gradient by the image of that force where it was drawn")]
    hindrance: Annotated[int, Row(9, "1", "resistance added by walls, in the particle frame")]
    drag_frame: Annotated[int, Row(9, "1", "frame in which the drag at the start of a step is diagonal")]


near = offsets(WallRows)


def find_walls(
    flow: object, s: Scratch, i: int, _step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Store the walls around the particle in lane i, and add up the lengths of steps where one is close."""
    cut_off, least_gap, _, _, patch_mask = coefficients
    block = s.block
    R = block[at.R * LANES + i]
    t = block[at.t * LANES + i]
    x = load3(block, at.x, i)
    p = walls(flow, s.host[i], x, cut_off * R, patch_mask, t)
    store3(block, near.wall_speed, i, wall_speeds(flow, s.host[i], x, p, t))
    store3(block, near.wall_distance, i, (min(p.h1, _FAR * R), min(p.h2, _FAR * R), min(p.h3, _FAR * R)))
    block[near.least_gap * LANES + i] = least_gap
    store3(block, near.wall_normal, i, p.n1)
    store3(block, near.wall_normal + 3, i, p.n2)
    store3(block, near.wall_normal + 6, i, p.n3)
    if min(p.h1, p.h2, p.h3) < CLOSE * R and remaining > 0.0:
        h = block[at.dt * LANES + i]
        # A step that is repeated counts once.
        before = block[near.counted_for * LANES + i] if block[near.counted * LANES + i] == t else 0.0
        block[near.counted * LANES + i], block[near.counted_for * LANES + i] = t, h
        block[near.close * LANES + i] += h - before


def stays_by_planes(flow: object, s: Scratch, i: int, _medium: Medium, coefficients: Numbers) -> float:
    """Return a half for a step of lane i after which the nearest wall is off its plane, else 1."""
    block, cut = s.block, coefficients[0] * s.block[at.R * LANES + i]
    x = load3(block, at.new_x, i)
    way, expected, dt = minus(x, load3(block, at.x, i)), cut, block[at.dt * LANES + i]
    for k in range(3):
        h, n = block[(near.wall_distance + k) * LANES + i], load3(block, near.wall_normal + 3 * k, i)
        expected = min(expected, h + inner(way, n) - dt * block[(near.wall_speed + k) * LANES + i])
    p = walls(flow, s.ahead[i], x, cut, coefficients[4], block[at.t * LANES + i] + dt)
    distance = min(p.h1, p.h2, p.h3, cut)
    return 0.5 if abs(expected - distance) > _OFF_PLANE * distance else 1.0


def lift(block: Block, medium: Medium, share: float, coefficients: Numbers) -> None:
    """Add the reflections of the particles' stresslets to u and l, and hinder motion by forces.

    The stresslet is that in the flow with the reflected gradient, found by iteration. The gradient of the
    image of a load deforms the particle. The effect of the stresslet of a rigid body under load on the
    velocity is part of the mobility.
    """
    _, least_gap, strain, hindered, _ = coefficients
    most = 0
    for i in range(LANES):
        h, far = load3(block, near.wall_distance, i), 0.5 * _FAR * block[at.R * LANES + i]
        most = max(most, int(h[0] < far) + int(h[1] < far) + int(h[2] < far))
    if most == 0:
        return
    clear_stage(block)
    if hindered > 0.0:
        before_lift(block, medium, share, least_gap, strain, most)
    free_stage(block, medium, share)
    reflect(block, medium, share, least_gap, strain, most)
    for wall in range(most):
        select_wall(block, wall, share, least_gap)
        velocity_stage(block, medium, share)
        if hindered > 0.0:
            hindrance_stage(block, medium)
    if hindered > 0.0:
        after_lift(block, medium, share, least_gap, strain, most)
    end_lift(block, strain)


@separate
def reflect(block: Block, medium: Medium, share: float, least_gap: float, strain: float, most: int) -> None:
    """Compute the gradient that walls reflect, and the stresslet in it, from that without walls."""
    for _ in range(_REPEATS):
        start_reflection(block)
        for wall in range(most):
            select_wall(block, wall, share, least_gap)
            reflection_stage(block, medium, 1.0)
        response_stage(block, medium, strain)


@traced
def clear_stage(block: Block) -> None:
    """Start without hindrance and without the gradient of a load."""
    for i in range(LANES):
        nothing = scale(0.0, load9(block, at.l, i))
        store9(block, near.hindrance, i, nothing)
        store9(block, near.load_gradient, i, nothing)


@traced
def free_stage(block: Block, medium: Medium, share: float) -> None:
    """Compute the stresslet without walls."""
    for i in range(LANES):
        store3(block, near.wall_lift, i, (0.0, 0.0, 0.0))
        S = stresslet(block, i, medium, load9(block, at.l, i), body_gradient(block, i, medium, share))
        store9(block, near.free_stresslet, i, S)
        store9(block, near.stresslet, i, S)


@traced
def start_reflection(block: Block) -> None:
    """Start without a reflected gradient."""
    for i in range(LANES):
        store9(block, near.reflected, i, scale(0.0, load9(block, at.l, i)))


@traced
def reflection_stage(block: Block, medium: Medium, factor: float) -> None:
    """Add the reflection of the stresslets by the selected wall, times a factor, to ``reflected``."""
    for i in range(LANES):
        n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
        S, mu_f = load9(block, near.stresslet, i), viscosity_at(block, i, medium)
        E = stresslet_gradient(S, shape_of(block, i), n, d, mu_f)
        add9(block, near.reflected, i, scale(factor * block[near.present * LANES + i], E))


@traced
def response_stage(block: Block, medium: Medium, strain: float) -> None:
    """Compute the stresslet in the flow with the reflected gradient."""
    for i in range(LANES):
        E = scale(strain, load9(block, near.reflected, i))
        S = stresslet(block, i, medium, E, body_response(block, i, medium, E))
        store9(block, near.stresslet, i, add(load9(block, near.free_stresslet, i), S))


@traced
def velocity_stage(block: Block, medium: Medium, share: float) -> None:
    """Add the velocity that the selected wall reflects, and that by the flow's curvature at it.

    Over a wall without slip u_n is half of the distance times its slope.
    """
    for i in range(LANES):
        n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
        S, mu_f, C = load9(block, near.stresslet, i), viscosity_at(block, i, medium), shape_of(block, i)
        e = np.sqrt(inner(dot_vector(C, n), n)) / d
        u_n = 0.5 * d * inner(dot_vector(load9(block, at.l, i), n), n)
        u_n *= stagnation_factor(e, gain_of_stiff(reflected_share(e)))
        v = plus_scaled(stresslet_velocity(S, C, n, d, mu_f), u_n, n)
        v = plus(v, curved_velocity(block, i, n, d, e, share))
        add3(block, near.wall_lift, i, scale_vector(block[near.present * LANES + i], v))


@traced
def hindrance_stage(block: Block, medium: Medium) -> None:  # noqa: ARG001
    """Add the resistance by the selected wall."""
    for i in range(LANES):
        n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
        W = hindrance_of(block, i, n, d, block[near.one_gap * LANES + i])
        add9(block, near.hindrance, i, scale(block[near.present * LANES + i], W))


@traced
def end_lift(block: Block, strain: float) -> None:
    """Add what the walls reflect to u and l."""
    for i in range(LANES):
        some = any_near(block, i)
        l, u, w = load9(block, at.l, i), load3(block, at.u, i), load3(block, near.wall_lift, i)
        E = add(scale(strain, load9(block, near.reflected, i)), load9(block, near.load_gradient, i))
        store9(block, at.l, i, choose(some, add(l, E), l))
        store3(block, at.u, i, choose3(some, plus(u, w), u))


def any_near(block: Block, i: int) -> Any:
    """Return whether lane i has a wall near it."""
    h, far = load3(block, near.wall_distance, i), 0.5 * _FAR * block[at.R * LANES + i]
    return (h[0] < far) | (h[1] < far) | (h[2] < far)


@slot
def before_lift(
    block: Block, medium: Medium, share: float, least_gap: float, strain: float, most: int
) -> None:
    """Store the gradient of the image of a load and of the resulting stresslet of a rigid body.

    ``most`` is the largest number of walls near a lane.
    """
    load_stage(block, medium, share)
    strain_by_load(block, medium, share, least_gap, strain, most)


def no_load_before_lift(
    _block: Block, _medium: Medium, _share: float, _least_gap: float, _strain: float, _most: int
) -> None:
    """No-op: the drag on a body with inertia depends on the lift."""


@slot
def after_lift(
    block: Block, medium: Medium, _share: float, _least_gap: float, _strain: float, _most: int
) -> None:
    """Add the velocity that a load loses by the walls to the reflected one."""
    loss_stage(block, medium)


def strain_by_drag(
    block: Block, medium: Medium, share: float, least_gap: float, strain: float, most: int
) -> None:
    """See :func:`before_lift`, for a body with inertia; hinder the force of molecules."""
    for i in range(LANES):
        # The rows of free_stresslet are free again.
        store9(block, near.free_stresslet, i, load9(block, near.reflected, i))
    load_stage(block, medium, share)
    strain_by_load(block, medium, share, least_gap, strain, most)
    for i in range(LANES):
        store9(block, near.reflected, i, load9(block, near.free_stresslet, i))
    molecule_stage(block)
    loss_stage(block, medium)


@separate
def strain_by_load(
    block: Block, medium: Medium, share: float, least_gap: float, strain: float, most: int
) -> None:
    """Store the gradient of the image of the stored load, see :func:`before_lift`."""
    for wall in range(most):
        select_wall(block, wall, share, least_gap)
        image_stage(block, medium, strain)
    rigid_stage(block, medium)
    for wall in range(most):
        select_wall(block, wall, share, least_gap)
        reflection_stage(block, medium, strain)
    for i in range(LANES):
        store9(block, near.load_gradient, i, load9(block, near.reflected, i))


@separate
def strain_by_steady_load(
    block: Block, medium: Medium, share: float, least_gap: float, strain: float, most: int
) -> None:
    """See :func:`before_lift`, less the gradient by the force of molecules where that was drawn.

    Walls couple force and rate of strain: v = M·f + C:T, l = Cᵀ·f + N:T, with the mobilities M of a rigid
    body, and more, C N⁻¹ Cᵀ, of one that gives way. Force and stress of molecules are drawn with M⁻¹ and N⁻¹.
    They have the covariance of the whole resistance if N⁻¹ Cᵀ·f is taken off the stress, i.e. Cᵀ·f off l.
    Where N⁻¹ is without walls, half of the gradient that walls reflect of the stress is taken off, too: the
    square root of 1 + x is about 1 + x/2.
    """
    new = 0
    for i in range(LANES):
        new += thermal_force(block, i) != load3(block, near.held_force, i)
    if new > 0 and share == 0.0:
        molecule_stage(block)
        strain_by_load(block, medium, share, least_gap, strain, most)
        for i in range(LANES):
            f = thermal_force(block, i)
            if f != load3(block, near.held_force, i):
                store9(block, near.held_gradient, i, load9(block, near.load_gradient, i))
            store9(block, near.load_gradient, i, ZERO)
        molecular_stresslet_stage(block, medium)
        reflect(block, medium, share, least_gap, strain, most)
        for i in range(LANES):
            f = thermal_force(block, i)
            if f != load3(block, near.held_force, i):
                store3(block, near.held_force, i, f)
                add9(block, near.held_gradient, i, scale(0.5 * strain, load9(block, near.reflected, i)))
    load_stage(block, medium, share)
    strain_by_load(block, medium, share, least_gap, strain, most)
    for i in range(LANES):
        add9(block, near.load_gradient, i, scale(-1.0, load9(block, near.held_gradient, i)))


@traced
def molecular_stresslet_stage(block: Block, medium: Medium) -> None:
    """Compute the stresslet without walls by the stress of molecules alone."""
    for i in range(LANES):
        Q, l = load9(block, at.Q, i), thermal_gradient(block, i)
        m = store_mobility(block, i, medium)
        l_f = to_frame(Q, l)
        S = stresslet(block, i, medium, scale(0.0, l), velocity_gradient(m, scale(0.0, l), l_f))
        store9(block, near.free_stresslet, i, S)
        store9(block, near.stresslet, i, S)


def store_mobility(block: Block, i: int, medium: Medium) -> Mobility:
    """Store and return the mobility of lane i."""
    m = mobility_in_step(block, i, medium, load3(block, at.stretch, i))
    store9(block, near.mobility_normal, i, m.normal)
    store3(block, near.mobility_shear, i, m.compliance)
    store3(block, near.mobility_slip, i, m.slip)
    return m


@traced
def load_stage(block: Block, medium: Medium, share: float) -> None:
    """Store the forces of the particles on the fluid."""
    for i in range(LANES):
        store3(block, near.load, i, load_of(block, i, medium, share))


@traced
def molecule_stage(block: Block) -> None:
    """Store the forces of molecules as load."""
    for i in range(LANES):
        store3(block, near.load, i, thermal_force(block, i))


@traced
def image_stage(block: Block, medium: Medium, strain: float) -> None:
    """Add the gradient of the image of the load in the selected wall."""
    for i in range(LANES):
        n, d = load3(block, near.one_normal, i), block[near.one_distance * LANES + i]
        f, mu_f = load3(block, near.load, i), viscosity_at(block, i, medium)
        E = force_gradient(f, shape_of(block, i), n, d, mu_f)
        add9(block, near.load_gradient, i, scale(strain * block[near.present * LANES + i], E))


@traced
def rigid_stage(block: Block, medium: Medium) -> None:
    """Compute the stresslet of a rigid body in the gradient of the load's image."""
    for i in range(LANES):
        E = load9(block, near.load_gradient, i)
        store9(block, near.reflected, i, E)
        store9(block, near.stresslet, i, stresslet(block, i, medium, E, scale(0.0, E)))


@traced
def loss_stage(block: Block, medium: Medium) -> None:
    """Add the velocity that the load loses by the walls to the reflected one."""
    for i in range(LANES):
        add3(block, near.wall_lift, i, velocity_loss(block, i, medium))


@separate
def select_wall(block: Block, wall: int, share: float, least_gap: float) -> None:
    """Copy one of the walls of all lanes, as of ``share`` of the step, into the rows for one wall.

    Loops that index rows by a variable are not vectorised.
    """
    for i in range(LANES):
        passed = block[at.passed * LANES + i] * block[at.dt * LANES + i] if share > 0.0 else 0.0
        came = passed * block[(near.wall_speed + wall) * LANES + i]
        block[near.one_distance * LANES + i] = block[(near.wall_distance + wall) * LANES + i] - came
        for k in range(3):
            block[(near.one_normal + k) * LANES + i] = block[(near.wall_normal + 3 * wall + k) * LANES + i]
    place_stage(block, share, least_gap)


@traced
def place_stage(block: Block, share: float, least_gap: float) -> None:
    """Compute distance and gap of the selected wall after ``share`` of the step."""
    for i in range(LANES):
        R, h = block[at.R * LANES + i], block[near.one_distance * LANES + i]
        n, there = load3(block, near.one_normal, i), select(h < 0.5 * _FAR * R, 1.0, 0.0)
        # At the start of a step new_x is not known.
        way = inner(minus(load3(block, at.new_x, i), load3(block, at.x, i)), n)
        h, gap = distance_and_gap(block, i, n, h + select(share > 0.0, share * way, 0.0), least_gap)
        block[near.present * LANES + i] = there
        block[near.one_distance * LANES + i] = h
        block[near.one_gap * LANES + i] = gap


def distance_and_gap(block: Block, i: int, n: Vector, h: float, least_gap: float) -> tuple[float, float]:
    """Return the distance of the centre of lane i from a wall and the gap between them, m.

    The gap is at least ``least_gap`` radii, and the distance is consistent with it.
    """
    R = block[at.R * LANES + i]
    extent = reach(R, load9(block, at.new_F, i), n)
    gap = np.maximum(h - extent, least_gap * R)
    return gap + extent, gap


def shape_of(block: Block, i: int) -> Tensor:
    """Return the shape tensor R² F Fᵀ of lane i, m²."""
    F, R = load9(block, at.new_F, i), block[at.R * LANES + i]
    return scale(R * R, dot(F, transpose(F)))


@choice
def stresslet(block: Block, i: int, medium: Medium, l_f: Tensor, l_s: Tensor) -> Tensor:
    """Return S = V μ_f dev sym s̃(l_f − l_s) of lane i, N m; l_f in space's axes, l_s in the particle's."""
    Q, stretches, g = load9(block, at.Q, i), load3(block, at.stretch, i), load_integrals(block, i)
    relative = add(to_frame(Q, l_f), scale(-1.0, l_s))
    s, _ = disturbance(stretches, g, dev(sym(relative)), skew(relative))
    volume = volume_at_rest(block, i) * stretches[0] * stretches[1] * stretches[2]
    return from_frame(Q, scale(volume * viscosity_at(block, i, medium), dev(sym(s))))


@choice
def body_gradient(block: Block, i: int, medium: Medium, share: float) -> Tensor:  # noqa: ARG001
    """Return l_s of the body in lane i, in the particle frame, 1/s; without inertia, store its mobility.

    Only here, l includes the gradient of the image of the load, and that by molecules. The stresslet is then
    the difference from that of a rigid body, which the hindrance includes, less the stress of molecules.
    """
    Q, stretches = load9(block, at.Q, i), load3(block, at.stretch, i)
    m = store_mobility(block, i, medium)
    b_e = finger_of_body_in_frame(stretches, dot(Q, load9(block, at.new_F, i)), load9(block, at.M, i))
    tau = incompressible_stress(block, i, stretches, b_e)
    l = add(add(load9(block, at.l, i), load9(block, near.load_gradient, i)), thermal_gradient(block, i))
    l_f, sigma = to_frame(Q, l), scale(1.0 / viscosity_at(block, i, medium), tau)
    return velocity_gradient(m, with_tension(block, i, m, stretches, sigma, l_f), l_f)


@choice
def mobility_in_step(block: Block, i: int, medium: Medium, stretches: Vector) -> Mobility:
    """Return the mobility by which the body's stress moves it; by default that of the instant."""
    return body_mobility(block, i, medium, stretches)


@choice
def deficit_in_step(block: Block, i: int, medium: Medium) -> Any:
    """Return the ``deficit`` of that mobility."""
    return mobility_deficit(block, i, medium)


@choice
def body_response(block: Block, i: int, medium: Medium, E: Tensor) -> Tensor:
    """Return the change of that l_s by a gradient E (space's axes), in the particle frame, 1/s."""
    m = Mobility(
        load9(block, near.mobility_normal, i),
        load3(block, near.mobility_shear, i),
        load3(block, near.mobility_slip, i),
        deficit_in_step(block, i, medium),
    )
    l = to_frame(load9(block, at.Q, i), E)
    return velocity_gradient(m, scale(0.0, l), l)


def moving_gradient(block: Block, i: int, medium: Medium, share: float) -> Tensor:  # noqa: ARG001
    """Return l_s of a body with inertia, from its state, in the particle frame, 1/s."""
    start = dot(load9(block, at.A, i), inverse(load9(block, at.F, i)))
    return to_frame(load9(block, at.Q, i), choose(share > 0.0, load9(block, at.new_A, i), start))


def leave_moving_gradient(block: Block, i: int, Q: Tensor, l_s: Tensor, wanted: Any) -> None:
    """Store l_s, given in the frame Q, for :func:`moving_gradient`, if ``wanted``."""
    l = from_frame(Q, l_s)
    store9(block, at.new_A, i, choose(wanted, l, load9(block, at.new_A, i)))


def no_response(block: Block, i: int, medium: Medium, E: Tensor) -> Tensor:  # noqa: ARG001
    """Return zero: l_s of a body with inertia does not change at once."""
    return scale(0.0, E)


@choice
def gain_of_stiff(q: Scalar) -> Scalar:
    """Return the stresslet of a stiff body that came to rest, over that without walls.

    ``q`` is the share of a stresslet's strain that its image sends back. By default the body has no inertia:
    the iteration starts from the stress that balances all of the strain, and a body without stress resists
    by −⅔ of a rigid one.
    """
    p = q * (1.0 - q * (2.0 / 3.0))
    return 1.0 + p / (1.0 - p * (5.0 / 3.0))


def gain_of_moving(q: Scalar) -> Scalar:
    """Return the same for a body with inertia: two reflections."""
    return 1.0 + q * (1.0 + q)


@choice
def load_of(block: Block, i: int, medium: Medium, share: float) -> Vector:  # noqa: ARG001
    """Return the force of a body on the fluid, N; by default of one without inertia."""
    return balanced_load(block, i, medium)


def balanced_load(block: Block, i: int, medium: Medium) -> Vector:
    """Return the forces on a body less its inertia, N."""
    Du_Dt, t = load3(block, at.DuDt, i), thermal_force(block, i)
    _, f, inertia = forces_on(block, i, medium, 1.0, Du_Dt)
    m = volume_at_rest(block, i) * block[at.rho * LANES + i]
    return plus(scale_vector(m, minus(f, scale_vector(inertia, Du_Dt))), t)


def drag_on_fluid(block: Block, i: int, medium: Medium, share: float) -> Vector:
    """Return the force of a body with inertia on the fluid, N: μ_f K·(v − u), u with the reflection.

    If the step h is long compared with the relaxation time m/μ_f K, return the balanced load instead:
    errors of v and of the body's velocity gradient would amplify each other. Its weight is of fourth order in
    h.
    """
    Q, k = load9(block, at.Q, i), resistances(block, i)
    v = choose3(share > 0.0, load3(block, at.new_v, i), load3(block, at.v, i))
    slip = dot_vector(Q, minus(minus(v, load3(block, at.u, i)), load3(block, near.wall_lift, i)))
    K = hindered_resistance(k, load9(block, near.hindrance, i))
    d = vector_dot(dot_vector(scale(viscosity_at(block, i, medium), K), slip), Q)
    f = balanced_load(block, i, medium)
    m = volume_at_rest(block, i) * block[at.rho * LANES + i]
    x = block[at.dt * LANES + i] * viscosity_at(block, i, medium) * trace(K) / (6.0 * m)
    y = x * x * x * x
    return between(d, f, y / (1.0 + y))


def hindered_rate(block: Block, i: int, rate: Vector) -> Tensor:
    """Return the rates of drag of lane i near its walls, 1/s, in the particle frame, from those without."""
    return hindered_resistance(rate, hindrance_now(block, i))


def hindrance_now(block: Block, i: int) -> Tensor:
    """Return W of all walls around lane i, in the particle frame."""
    W = load9(block, near.hindrance, i)
    # Without walls near any lane, the rows of hindrance are from an earlier step.
    return choose(any_near(block, i), W, scale(0.0, W))


def across_axes(block: Block, i: int, rate: Vector, w: Vector) -> Vector:
    """See :func:`foamprb.cloud.integrators.rosenbrock.resist`; near walls."""
    return dot_vector(hindered_rate(block, i, rate), w)


def find_hindered_axes(block: Block, i: int, Q: Tensor, rate: Vector) -> tuple[Tensor, Vector]:
    """Return the frame in which the drag near walls is diagonal at the start of a step, and its rates."""
    P, rates = principal_frame(hindered_rate(block, i, rate))
    axes = dot(P, Q)
    store9(block, near.drag_frame, i, axes)
    return axes, rates


def hindered_axes(block: Block, i: int, _Q: Tensor) -> Tensor:
    """Return that frame in later stages."""
    return load9(block, near.drag_frame, i)


def hindrance_of(block: Block, i: int, n: Vector, h: float, gap: float) -> Tensor:
    """Return W of one wall, in the particle frame."""
    return hindrance(resistances(block, i), dot_vector(load9(block, at.Q, i), n), h, gap)


def hindrance_at_start(block: Block, i: int) -> Tensor:
    """Return W of all walls around lane i at the start of a step, in the particle frame."""
    return add(add(_hindrance_of(block, i, 0), _hindrance_of(block, i, 1)), _hindrance_of(block, i, 2))


def _hindrance_of(block: Block, i: int, wall: int) -> Tensor:
    n, h = load3(block, near.wall_normal + 3 * wall, i), block[(near.wall_distance + wall) * LANES + i]
    there = select(h < 0.5 * _FAR * block[at.R * LANES + i], 1.0, 0.0)
    h, gap = distance_and_gap(block, i, n, h, block[near.least_gap * LANES + i])
    return scale(there, hindrance_of(block, i, n, h, gap))


def velocity_loss(block: Block, i: int, medium: Medium) -> Vector:
    """Return the change of the slip by walls, (K_h⁻¹ − K⁻¹)·f/μ_f, m/s."""
    Q, k = load9(block, at.Q, i), resistances(block, i)
    f = dot_vector(Q, load3(block, near.load, i))
    v = dot_vector(inverse(hindered_resistance(k, load9(block, near.hindrance, i))), f)
    c = 1.0 / viscosity_at(block, i, medium)
    w = (c * (v[0] - f[0] / k[0]), c * (v[1] - f[1] / k[1]), c * (v[2] - f[2] / k[2]))
    return vector_dot(w, Q)


def nearest_walls(p: Particles, arrays: Any, flow: Flow, cut_off: float, patch_mask: Floats) -> Floats:
    """Return distances of particles from the nearest wall, in radii, (n,); infinite beyond ``cut_off``."""
    nearest = np.full(p.size, np.inf)
    find, packed_flow = linked_with(flow.kernels, arrays, _nearest_walls)
    start = float(p.t0.min(initial=np.inf))
    find(packed_flow, p.x, p.host, cut_off * p.R, patch_mask, start, nearest)
    distances: Floats = nearest / p.R
    return distances


def _nearest_walls(
    flow: object, x: Floats, hosts: Ints, cuts: Floats, patch_mask: Floats, t: float, nearest: Floats
) -> None:
    for k in range(len(nearest)):
        if hosts[k] >= 0:
            planes = walls(flow, hosts[k], (x[k, 0], x[k, 1], x[k, 2]), cuts[k], patch_mask, t)
            nearest[k] = min(planes.h1, planes.h2, planes.h3)


_MOTION: Slots = {
    body_gradient: moving_gradient,
    body_response: no_response,
    gain_of_stiff: gain_of_moving,
    leave_gradient: leave_moving_gradient,
}
"""Velocity gradient and stresslet of a body with inertia."""
_DRAG: Slots = {
    load_of: drag_on_fluid,
    before_lift: no_load_before_lift,
    after_lift: strain_by_drag,
    resist: across_axes,
    find_drag_axes: find_hindered_axes,
    drag_axes: hindered_axes,
}
"""Drag on a body with inertia as a full tensor."""

_MORE_THAN_CLOSE = Bounds(CLOSE, math.inf, True, True, f"a number > {CLOSE:g}")


@dataclass(frozen=True, kw_only=True)
class WallLift(Surrounding):
    """Lift, strain and hindrance by walls: ``wallLift;`` or ``wallLift { cutOff 10; }``."""

    cutOff: Annotated[
        float, _MORE_THAN_CLOSE, Meaning("distance of the centre beyond which a wall does not count", "radii")
    ] = 10.0
    strain: Annotated[bool, Meaning("whether the gradient that walls reflect deforms the particle")] = True
    mobility: Annotated[bool, Meaning("whether walls hinder the motion by forces; not with `paper`")] = True
    leastGap: Annotated[
        float, Positive, Meaning("smallest gap in the hindrance: the roughness of the wall", "radii")
    ] = 0.01
    patches: Annotated[
        Words | None, Meaning("patches that count: names, or patterns in quotes", "", "walls")
    ] = None

    rows: ClassVar = (WallRows,)
    each_step: ClassVar = False
    surveys: ClassVar = ("x", "host", "R", "t0")
    stages: ClassVar = (
        Stage("start", find_walls, writes=(near.wall_distance, near.wall_normal, near.wall_speed)),
        Stage("accept", stays_by_planes),
        Stage("fluid", lift, reads=(near.wall_distance,), adds=(at.u, at.l), before=(at.l,)),
    )

    def walls(self, patches: Sequence[Patch]) -> tuple[float, Sequence[int]]:
        """Return ``cutOff``, and the patches that count; raise InputError if a pattern matches no patch."""
        for pattern in self.patches or ():
            if not any(matches(pattern, patch.name) for patch in patches):
                names = [patch.name for patch in patches]
                text = f"wallLift/patches is {pattern}, which is no patch. {suggestion(pattern, names)}"
                raise InputError(text.removesuffix("."))
        return self.cutOff, [int(index) for index in np.flatnonzero(self.patch_mask(patches))]

    def patch_mask(self, patches: Sequence[Patch]) -> Floats:
        """Return 1 for each patch that counts, else 0."""
        if self.patches is None:
            return np.array([patch.kind is PatchKind.WALL for patch in patches], dtype=np.float64)
        named = [any(matches(p, patch.name) for p in self.patches) for patch in patches]
        return np.array(named, dtype=np.float64)

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:
        """Return the entries, and 1 for each patch that counts."""
        strain, hindered = float(self.strain), float(self.mobility)
        return self.cutOff, self.leastGap, strain, hindered, self.patch_mask(patches)

    def slots(self, inertia: bool) -> Slots:
        """Return the functions of a body with inertia, and the hindrance."""
        motion: Slots = _MOTION if inertia else {}
        if not self.mobility:
            return motion
        hindrances = {hindrance_by_walls: hindrance_at_start, present_hindrance: hindrance_now}
        return {**motion, **hindrances, **(_DRAG if inertia else {})}

    def refuses(self, integrator: Integrator, liquid: bool) -> str:
        """Refuse ``paper``, whose drag is diagonal in the particle frame, and the hindrance of drops."""
        if self.mobility and integrator.name == "paper":
            return (
                "wallLift/mobility is yes, which needs the integrator stokes or rosenbrock, not paper: "
                "set mobility no, or integrationSchemes/shape rosenbrock"
            )
        if self.mobility and liquid:
            return "wallLift/mobility holds for solids, not for drops: set it no"
        return ""

    def remarks(self, survey: Survey) -> Remarks:
        """Note the range of the particles' distances from walls at their start."""
        if survey.arrays is None:
            return Remarks()
        p, flow = survey.p, survey.flow
        nearest = nearest_walls(p, survey.arrays, flow, self.cutOff, self.patch_mask(flow.patches))
        some = nearest[np.isfinite(nearest)]
        beyond = len(nearest) - len(some)
        lines = (
            [f"{'distance to walls/radius':24s} {some.min():.4g} to {some.max():.4g}"] if len(some) else []
        )
        return Remarks([*lines, f"{'beyond cutOff':24s} {beyond}"])


def count_close(p: Particles) -> tuple[float, float, int]:
    """Return the times close to a wall and in all, s, and the number of particles that were close."""
    total = (p.t - p.t0)[p.status != Status.PENDING].sum()
    return float(p.close.sum()), float(total), int(np.count_nonzero(p.close))


def share_of_close(close: float, total: float, some: int) -> str:
    """Return the share of time close to a wall, from sums of :func:`count_close`, for the log."""
    share = close / (total + 1e-300)
    return f"{f'time within {CLOSE:g} radii of walls':36s} {share:.2%}, of {some:.0f} particles"
