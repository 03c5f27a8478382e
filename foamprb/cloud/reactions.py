"""Reactions of walls on bodies that rest on them, through the stages of a step.

A body that touches walls at the start of a step carries their reactions N ≥ 0 in the whole step, as it does
forces. They are such that none of its gaps is negative at the end, in the motion that elasticity, as stiff as
a viscosity μ h, allows it in the step h. In equilibrium this is exact. Elsewhere the push at the end of the
step (:mod:`foamprb.cloud.pressing`) corrects what is left, of second order in h.
"""

from __future__ import annotations

import math

from foamprb.body.brownian import response, shape_resistance
from foamprb.body.choice import choice
from foamprb.body.tensor import (
    ZERO,
    Tensor,
    Vector,
    add,
    dot_vector,
    from_frame,
    inner,
    inverse,
    minus,
    plus,
    scale_vector,
    skew,
    to_frame,
    vector_dot,
)
from foamprb.body.wall import hindered_resistance
from foamprb.cloud.block import (
    Medium,
    Scratch,
    at,
    load3,
    load9,
    load_integrals,
    store3,
    store9,
    viscosity_at,
)
from foamprb.cloud.contact import gap_of_lane
from foamprb.cloud.elastic import present_hindrance, resistances, volume_at_rest
from foamprb.cloud.layout import LANES, Block
from foamprb.cloud.motion import TOUCH, PatchTable
from foamprb.cloud.patches import REBOUND
from foamprb.cloud.pressing import (
    SAME_NORMAL,
    Push,
    carries_reaction,
    is_strained_by_load,
    point_of_contact,
    push_at,
    speed_at,
    stress_of,
    unstrained_if_hindered,
)
from foamprb.compile.link import separate
from foamprb.flow.kernels import normal, wall_velocity

_ASIDE, _BESIDE = 1e-2, 1e-3
"""How far off known walls, in radii, the body is when others are searched, and gap up to which they count."""
_SWEEPS = 100
"""Most sweeps over the walls."""
_ENOUGH = 1e-14
"""Relative change of a reaction in the last one."""
_STIFF = 1e9
"""Viscosity of a body, over that of the fluid, that a reaction turns as a rigid one."""


@choice
def free_motion(_block: Block, _i: int, _medium: Medium, _h: float) -> tuple[Vector, Tensor]:
    """Return v, m/s, and l_s, 1/s, of lane i at the start of a step h, s, without reactions."""
    return (0.0, 0.0, 0.0), ZERO


@separate
def balance_walls(flow: object, patches: PatchTable, s: Scratch, medium: Medium, share: float) -> int:
    """Find the reactions on the lanes that rest on walls, and add them to u and l of the first stage.

    They are those of ``share`` of a step, for 0 of an instant. Random motion is mirrored at walls instead.

    Returns
    -------
    The number of these lanes.
    """
    block, resting = s.block, 0
    for i in range(LANES):
        if block[at.moving * LANES + i] > 0.0:
            store3(block, at.reaction, i, (0.0, 0.0, 0.0))
            # One that overlaps a wall, as at its release, is pushed out first.
            touches = abs(block[at.clearance * LANES + i]) <= TOUCH * block[at.R * LANES + i]
            if touches and s.switches.reflects_steps == 0:
                resting += _balance(flow, patches, s, i, medium, share * block[at.dt * LANES + i])
    if resting > 0:
        add_reactions(block)
    return resting


@separate
def _balance(flow: object, patches: PatchTable, s: Scratch, i: int, medium: Medium, h: float) -> bool:
    """Store the reactions on lane i for a step h, s; return whether there are any."""
    block = s.block
    block[at.fluid * LANES + i] = viscosity_at(block, i, medium)
    F, (v, l) = load9(block, at.F, i), free_motion(block, i, medium, h)
    n, a = _wall_beside(flow, patches, s, i, (0.0, 0.0, 0.0), v, l, h)
    if a == math.inf:
        return False
    aside = scale_vector(_ASIDE * block[at.R * LANES + i], n)
    m, b = _wall_beside(flow, patches, s, i, aside, v, l, h)
    both = inner(n, m)
    if b == math.inf or abs(both) > SAME_NORMAL:
        m, b = n, math.inf
    aside = scale_vector(1.0 / (1.0 + both), plus(aside, scale_vector(_ASIDE * block[at.R * LANES + i], m)))
    o, c = _wall_beside(flow, patches, s, i, aside, v, l, h) if b < math.inf else (n, math.inf)
    if c == math.inf or max(abs(inner(n, o)), abs(inner(m, o))) > SAME_NORMAL:
        o, c = n, math.inf
    normals, speeds, Q = (n, m, o), (a, b, c), load9(block, at.Q, i)
    pushes = (
        _push(block, i, Q, F, n, h), _push(block, i, Q, F, m, h), _push(block, i, Q, F, o, h),
    )  # fmt: skip
    for _ in range(_SWEEPS):
        change = 0.0
        for k in range(3):
            speed = speeds[k]
            for j in range(3):
                N, p = block[(at.reaction + j) * LANES + i], pushes[j]
                speed += N * speed_at(p.v, p.l, pushes[k].r, normals[k])
            N = block[(at.reaction + k) * LANES + i]
            new = max(0.0, N - speed / pushes[k].rate)
            change = max(change, abs(new - N) - _ENOUGH * new)
            block[(at.reaction + k) * LANES + i] = new
        if change <= 0.0:
            break
    for k in range(3):
        store3(block, at.contact_normal + 3 * k, i, normals[k])
    return carries_reaction(block, i)


def _push(block: Block, i: int, Q: Tensor, F: Tensor, n: Vector, h: float) -> Push:
    return unstrained_if_hindered(block, i, n, push_at(block, i, Q, n, point_of_contact(block, i, F, n), h))


@separate
def _wall_beside(
    flow: object, patches: PatchTable, s: Scratch, i: int, aside: Vector, v: Vector, l: Tensor, h: float
) -> tuple[Vector, float]:
    """Return the normal of a wall that lane i touches, and the mean speed of the gap in a step h, m/s.

    It is the wall nearest to the body moved ``aside``, m, and the motion is that with v and l. The speed is
    infinite if the body does not touch this wall or does not rebound from it.
    """
    block = s.block
    x, F = load3(block, at.x, i), load9(block, at.F, i)
    R, t = block[at.R * LANES + i], block[at.t * LANES + i]
    gap, patch, triangle = gap_of_lane(flow, block, i, s.host[i], plus(x, aside), F, t)
    if patch < 0 or patches.code[patch] != REBOUND:
        return x, math.inf
    n = normal(flow, triangle, x, t)
    gap -= inner(aside, n)
    if abs(gap) > _BESIDE * R:
        return n, math.inf
    r = point_of_contact(block, i, F, n)
    speed = speed_at(minus(v, wall_velocity(flow, triangle, plus(x, r), t)), l, r, n)
    return n, speed + (gap / h if h > 0.0 else 0.0)


@separate
def add_reactions(block: Block) -> None:
    """Add to u and l of the lanes with reactions what makes the fluid exert these as force and stress."""
    for i in range(LANES):
        if not (block[at.moving * LANES + i] > 0.0 and carries_reaction(block, i)):
            continue
        Q, F = load9(block, at.Q, i), load9(block, at.new_F, i)
        force, T = (0.0, 0.0, 0.0), ZERO
        for k in range(3):
            n = load3(block, at.contact_normal + 3 * k, i)
            f = scale_vector(block[(at.reaction + k) * LANES + i], n)
            r = point_of_contact(block, i, F, n)
            force, T = plus(force, f), add(T, stress_of(f, r, volume_at_rest(block, i)))
        K = hindered_resistance(resistances(block, i), present_hindrance(block, i))
        v = vector_dot(dot_vector(inverse(K), dot_vector(Q, force)), Q)
        hindered = is_strained_by_load(block, i)
        # The fluid's gradient by which a body as viscous as the fluid deforms so, or a stiff one turns so.
        eta = _STIFF if hindered else 1.0
        r_shape = shape_resistance(load3(block, at.stretch, i), load_integrals(block, i), eta)
        l = from_frame(Q, response(r_shape, to_frame(Q, T)))
        store3(block, at.u, i, plus(load3(block, at.u, i), v))
        store9(block, at.l, i, add(load9(block, at.l, i), skew(l) if hindered else l))
