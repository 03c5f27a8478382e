"""Quadratic mode of soft bodies: their shape by the curvature of the flow, and the drift by that shape.

The formulas are those of :mod:`foamprb.body.quadratic`. In a fluid whose viscosity varies, μ S and μ v follow
from the stress, by its differences over the body: where a thinning fluid has no shear, μ S is not the
product of both. The flow is sampled where steps start. Between two
starts its S is linear in time, in a frame that turns with the fluid, and the mode is advanced exactly. On
its way through a step a body drifts by a mode that is linear between the start and the predicted end.

In a solid with memory a share g_k of the stiffness of B and q acts on what has not faded, B − D_k, with
dD_k/dt = (B − D_k)/T_k in the turning frame. So D_k add to the sources; in a step they are exact for a
linear B.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, ClassVar, NamedTuple, TypeAlias

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import largest_swelling, swelling
from foamprb.body.lift import vorticity
from foamprb.body.quadratic import (
    Parts,
    Third,
    advanced,
    advanced_vector,
    combine,
    drift_by_shift,
    drift_of_drop,
    drift_of_solid,
    parts,
    relaxation_of_drop,
    relaxation_of_shift,
    relaxation_of_solid,
    rotation,
    shift,
    source,
    square,
    turn_of,
    turned,
    weights,
)
from foamprb.body.quadratic import largest_swelling as largest_swelling_by_mode
from foamprb.body.quadratic import swelling as swelling_by_mode
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    combine_vectors,
    det,
    dev,
    dot,
    dot_vector,
    inner,
    minus,
    norm,
    plus,
    plus_scaled,
    scale,
    scale_vector,
    select,
    sym,
    transpose,
    vector_product,
)
from foamprb.cloud.block import Medium, Scratch, at, load3, load9, store3, store9, viscosity_at
from foamprb.cloud.contact import mode_in, mode_of
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.motion import renew_clearance, resume, turn_along
from foamprb.cloud.state import Particles
from foamprb.cloud.surroundings.base import Remarks, Stage, Surrounding, Survey, add3
from foamprb.cloud.surroundings.memory import rows_for
from foamprb.compile.link import Slots, separate, traced
from foamprb.flow.base import Patch
from foamprb.flow.kernels import curvature, sample, walk

Numbers: TypeAlias = tuple[float, ...]
"""Coefficients of a varying viscosity."""

Beside: TypeAlias = tuple[Tensor, float, float]


class QuadraticRows(NamedTuple):
    """Mode of a body, and the flow where it was computed last."""

    B: Annotated[int, Row(7, "1", "components 111, 112, 113, 122, 123, 222, 223", of="B", saved=True)]
    shift: Annotated[int, Row(3, "m", "displacement q of the surface of a solid", of="shift", saved=True)]
    sampled: Annotated[int, Row(1, "", "1 once the flow is sampled, else 0")]
    reached: Annotated[int, Row(1, "s", "time at which it was sampled")]
    recovery: Annotated[int, Row(1, "1/s", "relaxation 1/τ₃ of B then")]
    growth: Annotated[int, Row(7, "1/s", "source of B then")]
    pull: Annotated[int, Row(3, "m/s", "source of q then")]
    fluid_spin: Annotated[int, Row(3, "1/s", "angular velocity of the fluid then")]
    end: Annotated[int, Row(7, "1", "B where the step is to lead")]
    next_growth: Annotated[int, Row(7, "1/s", "source of B there")]
    way: Annotated[int, Row(3, "m", "the way there; 0 as long as it is unknown")]
    shift_drift: Annotated[int, Row(3, "m/s", "mean drift by q in the step")]


class SecondRows(NamedTuple):
    """Second derivatives of the flow at the start of a step."""

    S: Annotated[int, Row(7, "1/(m s)", "symmetric, traceless part")]
    T: Annotated[int, Row(9, "1/(m s)", "symmetric part of the gradient of the vorticity")]
    laplacian: Annotated[int, Row(3, "1/(m s)", "Laplacian of the velocity")]


_CHANGE, _CHANGE_OF_B = 0.2, 1e-3
"""Relative change of S, and change of B, within a step longer than Δt."""

_D = 3.0**-0.5
_DIRECTIONS = (
    (1.0, 0.0, 0.0, 0.4), (0.0, 1.0, 0.0, 0.4), (0.0, 0.0, 1.0, 0.4),
    (_D, _D, _D, 0.45), (_D, _D, -_D, 0.45), (_D, -_D, _D, 0.45), (-_D, _D, _D, 0.45),
)  # fmt: skip
"""Directions of a quadrature over a sphere, of degree 5 with their opposites, and weights, in sum 3."""
_NOTHING: Tensor = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_NO_MODE: Third = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_NO_SHIFT: Vector = (0.0, 0.0, 0.0)

mode = offsets(QuadraticRows)
second = offsets(SecondRows)


def load7(block: Block, row: int, i: int) -> Third:
    """Return the components in seven rows of lane i."""
    k = row * LANES + i
    return (
        block[k], block[k + LANES], block[k + 2 * LANES], block[k + 3 * LANES],
        block[k + 4 * LANES], block[k + 5 * LANES], block[k + 6 * LANES],
    )  # fmt: skip


def store7(block: Block, row: int, i: int, B: Third) -> None:
    """Store components in seven rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES], block[k + 3 * LANES] = B[0], B[1], B[2], B[3]
    block[k + 4 * LANES], block[k + 5 * LANES], block[k + 6 * LANES] = B[4], B[5], B[6]


def flow_parts(flow: object, s: Scratch, i: int) -> Parts:
    """Return the parts of the second derivatives at lane i."""
    block = s.block
    return parts(curvature(flow, s.host[i], load3(block, at.x, i), block[at.t * LANES + i]))


def elapsed(block: Block, i: int) -> float:
    """Return the time for which the mode of lane i has to be advanced, s; 0 if it has just been loaded."""
    k = mode.sampled * LANES + i
    return float(block[at.t * LANES + i] - block[mode.reached * LANES + i]) if block[k] > 0.0 else 0.0


def hold_mode(block: Block, i: int, held: float) -> None:
    """Let the mode of lane i go on as it was before a wall held it for a time, s."""
    block[mode.reached * LANES + i] += held


def ahead(block: Block, i: int, remaining: float) -> float:
    """Return the length of the next step of lane i, s; 0 at the end of a call."""
    return float(block[at.dt * LANES + i]) if remaining > 0.0 else 0.0


@choice
def past_of_mode(_block: Block, _i: int, _h: float, _turn: Tensor, _rate: float) -> tuple[Third, float]:
    """Return the source of B by faded modes after a step h, s, of a solid with memory, in two parts, 1/s.

    The second is a factor of B there; both are 0 without memory. ``rate`` is the relaxation 1/τ₃, 1/s.
    """
    return _NO_MODE, 0.0


@choice
def past_of_shift(_block: Block, _i: int, _h: float, _turn: Tensor, _rate: float) -> tuple[Vector, float]:
    """Return the source of q by faded ones, m/s, as :func:`past_of_mode` does."""
    return _NO_SHIFT, 0.0


@choice
def fade_mode(_block: Block, _i: int, _h: float, _turn: Tensor, _end: Third) -> None:
    """Advance the faded modes over a step h, s, from the stored B to that at its end."""


@choice
def fade_shift(_block: Block, _i: int, _h: float, _turn: Tensor, _end: Vector) -> None:
    """Advance the faded displacements over a step h, s, from the stored q to that at its end."""


@choice
def turn_past(_block: Block, _i: int, _turn: Tensor) -> None:
    """Turn or mirror the faded modes and displacements."""


@cache
def past_rows(n_times: int) -> Any:
    """Return the declaration of the faded modes of a solid with so many relaxation times."""
    row = Row(10 * n_times, "", "faded B of each time, then faded q", of="modeMemory", saved=True)
    return NamedTuple("PastRows", [("past", Annotated[int, row])])


@cache
def with_past(n_times: int) -> Slots:
    """Return the functions of faded modes for so many relaxation times."""
    times, first = offsets(rows_for(n_times)), offsets(past_rows(n_times)).past

    def rate_and_share(block: Block, i: int, k: int) -> tuple[float, float]:
        return block[(times.memory_rate + k) * LANES + i], block[(times.memory_share + k) * LANES + i]

    def source_of_mode(block: Block, i: int, h: float, turn: Tensor, rate: float) -> tuple[Third, float]:
        B, known, own = load7(block, mode.B, i), _NO_MODE, 0.0
        stiffness = 16.0 * block[at.mu * LANES + i]
        share = rate * stiffness / (stiffness + (280.0 / 11.0) * block[at.tension * LANES + i])
        for k in range(n_times):
            r, g = rate_and_share(block, i, k)
            w = weights(r, h)
            D = turned(combine(w.decay, load7(block, first + 7 * k, i), w.before * r, B), turn)
            known, own = combine(1.0, known, share * g, D), own + share * g * w.after * r
        return known, own

    def source_of_shift(block: Block, i: int, h: float, turn: Tensor, rate: float) -> tuple[Vector, float]:
        q, known, own = load3(block, mode.shift, i), _NO_SHIFT, 0.0
        for k in range(n_times):
            r, g = rate_and_share(block, i, k)
            w, row = weights(r, h), first + 7 * n_times + 3 * k
            D = dot_vector(turn, combine_vectors(w.decay, load3(block, row, i), w.before * r, q))
            known, own = plus_scaled(known, rate * g, D), own + rate * g * w.after * r
        return known, own

    def fade_B(block: Block, i: int, h: float, turn: Tensor, end: Third) -> None:
        for k in range(n_times):
            r, row = block[(times.memory_rate + k) * LANES + i], first + 7 * k
            w = weights(r, h)
            D = turned(combine(w.decay, load7(block, row, i), w.before * r, load7(block, mode.B, i)), turn)
            store7(block, row, i, combine(1.0, D, w.after * r, end))

    def fade_q(block: Block, i: int, h: float, turn: Tensor, end: Vector) -> None:
        for k in range(n_times):
            r, row = block[(times.memory_rate + k) * LANES + i], first + 7 * n_times + 3 * k
            w = weights(r, h)
            D = combine_vectors(w.decay, load3(block, row, i), w.before * r, load3(block, mode.shift, i))
            store3(block, row, i, plus_scaled(dot_vector(turn, D), w.after * r, end))

    def turn_all(block: Block, i: int, turn: Tensor) -> None:
        for k in range(n_times):
            row, rest = first + 7 * k, first + 7 * n_times + 3 * k
            store7(block, row, i, turned(load7(block, row, i), turn))
            store3(block, rest, i, dot_vector(turn, load3(block, rest, i)))

    return {
        past_of_mode: source_of_mode,
        past_of_shift: source_of_shift,
        fade_mode: fade_B,
        fade_shift: fade_q,
        turn_past: turn_all,
    }


def mode_after_step(
    block: Block, i: int, after: Third, rate: float, turn: Tensor, h: float
) -> tuple[Third, Third]:
    """Return B of lane i after a step h, s, and its source there, 1/s; ``after`` is the part by the flow."""
    w = weights(rate, h)
    known, own = past_of_mode(block, i, h, turn, rate)
    after = combine(1.0, after, 1.0, known)
    end = advanced(load7(block, mode.B, i), load7(block, mode.growth, i), after, w, turn)
    # The source grows with B itself.
    end = combine(1.0 / (1.0 - own * w.after), end, 0.0, end)
    return end, combine(1.0, after, own, end)


def shift_after_step(
    block: Block, i: int, after: Vector, rate: float, turn: Tensor, h: float
) -> tuple[Vector, Vector]:
    """Return q of lane i and its source, as :func:`mode_after_step` does."""
    w = weights(rate, h)
    known, own = past_of_shift(block, i, h, turn, rate)
    after = plus(after, known)
    end = advanced_vector(load3(block, mode.shift, i), load3(block, mode.pull, i), after, w, turn)
    end = scale_vector(1.0 / (1.0 - own * w.after), end)
    return end, plus_scaled(after, own, end)


def advance_mode(block: Block, i: int, growth: Third, rate: float, spin: Vector, step: float) -> None:
    """Advance B of lane i to its time, and store it with a first one at the end of the next step.

    Parameters
    ----------
    growth, rate
        Source of B and its relaxation, 1/s.
    spin
        Angular velocity of the fluid, 1/s.
    step
        Length of the next step, s.
    """
    h, B = elapsed(block, i), load7(block, mode.B, i)
    turn = rotation(combine_vectors(0.5, load3(block, mode.fluid_spin, i), 0.5, spin), h)
    if h > 0.0:
        B, growth = mode_after_step(block, i, growth, rate, turn, h)
        fade_mode(block, i, h, turn, B)
        store7(block, mode.B, i, B)
    else:
        growth = combine(1.0, growth, 1.0, past_of_mode(block, i, 0.0, turn, rate)[0])
    store7(block, mode.end, i, advanced(B, growth, growth, weights(rate, step), rotation(spin, step)))
    store7(block, mode.growth, i, growth)
    store3(block, mode.way, i, (0.0, 0.0, 0.0))
    block[mode.recovery * LANES + i] = rate


def advance_shift(block: Block, i: int, pull: Vector, rate: float, spin: Vector, step: float) -> None:
    """Advance q of lane i to its time, and store it with the mean drift in the next step.

    ``pull`` is the source of q, m/s; see :func:`advance_mode`.
    """
    h, q, flow_pull = elapsed(block, i), load3(block, mode.shift, i), pull
    turn = rotation(combine_vectors(0.5, load3(block, mode.fluid_spin, i), 0.5, spin), h)
    if h > 0.0:
        q, pull = shift_after_step(block, i, pull, rate, turn, h)
        fade_shift(block, i, h, turn, q)
        store3(block, mode.shift, i, q)
    else:
        pull = plus(pull, past_of_shift(block, i, 0.0, turn, rate)[0])
    store3(block, mode.pull, i, pull)
    if step > 0.0:
        store_shift_drift(block, i, flow_pull, rate, spin, step)
    else:
        change = plus(combine_vectors(1.0, pull, -rate, q), vector_product(spin, q))
        store3(block, mode.shift_drift, i, drift_by_shift(spin, q, change))


def store_shift_drift(block: Block, i: int, pull: Vector, rate: float, spin: Vector, step: float) -> None:
    """Store the mean drift by q of lane i in a step, at whose end the flow's source of q is ``pull``, m/s."""
    q = load3(block, mode.shift, i)
    end, _ = shift_after_step(block, i, pull, rate, rotation(spin, step), step)
    change = combine_vectors(1.0 / step, end, -1.0 / step, q)
    store3(block, mode.shift_drift, i, drift_by_shift(spin, combine_vectors(0.5, q, 0.5, end), change))


def advance_solid(
    flow: object, s: Scratch, i: int, remaining: float, mu_f: float, mu_S: Third, mu_v: Vector
) -> None:
    """Advance the mode of the solid in lane i by μ S and μ v, Pa/m², in the viscosity mu_f."""
    block = s.block
    a, mu_s, eta = block[at.R * LANES + i], block[at.mu * LANES + i], block[at.eta * LANES + i]
    spin = scale_vector(0.5, vorticity(load9(block, at.l, i)))
    c, step = source(eta / mu_f) * a / mu_f, ahead(block, i, remaining)
    rate = relaxation_of_solid(mu_f, mu_s, eta, block[at.tension * LANES + i])
    advance_mode(block, i, combine(c, mu_S, 0.0, mu_S), rate, spin, step)
    rate = relaxation_of_shift(mu_f, mu_s, eta)
    advance_shift(block, i, scale_vector(rate, shift(a, 1.0, mu_s, mu_v)), rate, spin, step)
    close_update(flow, s, i, spin)


@choice
def viscosity_beside(
    _flow: object, _host: int, _x: Vector, _t: float, _l: Tensor, _coefficients: object
) -> float:
    """Return :attr:`QuadraticInVarying.beside`, Pa s."""
    raise NotImplementedError


@separate
def stress_beside(flow: object, host: int, x: Vector, t: float, way: Vector, coefficients: Numbers) -> Beside:
    """Return the stress 2 μ d, Pa, a way from x, or at a boundary before; μ there; the share of the way."""
    reached, share, patch, _ = walk(flow, host, x, t, plus(x, way), t)
    if patch == -2:
        reached, share = host, 0.0
    there = plus(x, scale_vector(share, way))
    _, l, _ = sample(flow, reached, there, t)
    mu = viscosity_beside(flow, reached, there, t, l, coefficients)
    return scale(2.0 * mu, sym(l)), mu, share


def stress_parts(
    flow: object, host: int, x: Vector, t: float, a: float, coefficients: Numbers
) -> tuple[Third, Vector, float]:
    """Return means over a body of radius a: μ S and μ v, Pa/m², and the harmonic one of μ, Pa s.

    By the divergence theorem the mean of ∂τ_ij/∂x_k is (3/a) times that of τ_ij n_k over the surface, here of
    14 points: exact for polynomials of degree 4. μ S is the symmetric, traceless part of ½ ∂τ_ij/∂x_k,
    and μ v = ∇·τ, as for a constant viscosity.
    """
    X, Y, Z, fluidity = _NOTHING, _NOTHING, _NOTHING, 0.0
    for n_x, n_y, n_z, w in _DIRECTIONS:
        n = (n_x, n_y, n_z)
        slope, fluidity_there = stress_slope(flow, host, x, t, scale_vector(a, n), coefficients)
        X, Y, Z = (
            add(X, scale(w * n[0], slope)),
            add(Y, scale(w * n[1], slope)),
            add(Z, scale(w * n[2], slope)),
        )
        fluidity += w / 3.0 * fluidity_there
    q = 0.25
    S = parts((
        (2.0 * q * X[0], 2.0 * q * X[1], 2.0 * q * X[2]),
        (2.0 * q * Y[1], 2.0 * q * Y[4], 2.0 * q * Y[5]),
        (2.0 * q * Z[2], 2.0 * q * Z[5], 2.0 * q * Z[8]),
        (q * (Y[0] + X[1]), q * (Y[1] + X[4]), q * (Y[2] + X[5])),
        (q * (Z[1] + Y[2]), q * (Z[4] + Y[5]), q * (Z[5] + Y[8])),
        (q * (Z[0] + X[2]), q * (Z[1] + X[5]), q * (Z[2] + X[8])),
    )).S  # fmt: skip
    force = (X[0] + Y[1] + Z[2], X[1] + Y[4] + Z[5], X[2] + Y[5] + Z[8])
    return S, force, 1.0 / fluidity


def stress_slope(
    flow: object, host: int, x: Vector, t: float, way: Vector, coefficients: Numbers
) -> tuple[Tensor, float]:
    """Return the mean derivative of the stress along a way to both sides of x, Pa/m, and the mean 1/μ."""
    after, mu_after, there = stress_beside(flow, host, x, t, way, coefficients)
    before, mu_before, here = stress_beside(flow, host, x, t, scale_vector(-1.0, way), coefficients)
    length = max(there + here, 1e-9) * norm(way)
    return scale(1.0 / length, add(after, scale(-1.0, before))), 0.5 / mu_after + 0.5 / mu_before


def close_update(flow: object, s: Scratch, i: int, spin: Vector) -> None:
    """Store that the mode of lane i is that of its time, and the gap of its surface from the walls."""
    block = s.block
    renew_clearance(flow, s, i)
    store3(block, mode.fluid_spin, i, spin)
    block[mode.sampled * LANES + i], block[mode.reached * LANES + i] = 1.0, block[at.t * LANES + i]


def update_solid(
    flow: object, s: Scratch, i: int, _step: int, remaining: float, medium: Medium, _coefficients: object
) -> None:
    """Advance the mode of the solid in lane i."""
    mu_f = viscosity_at(s.block, i, medium)
    S, _, v = flow_parts(flow, s, i)
    advance_solid(flow, s, i, remaining, mu_f, combine(mu_f, S, 0.0, S), scale_vector(mu_f, v))


def update_in_varying(
    flow: object, s: Scratch, i: int, _step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Advance the mode of the solid in lane i, in a fluid whose viscosity varies."""
    x, t, a = load3(s.block, at.x, i), s.block[at.t * LANES + i], s.block[at.R * LANES + i]
    mu_S, mu_v, mu_f = stress_parts(flow, s.host[i], x, t, a, coefficients)
    advance_solid(flow, s, i, remaining, mu_f, mu_S, mu_v)


def update_drop(
    flow: object, s: Scratch, i: int, _step: int, remaining: float, medium: Medium, _coefficients: object
) -> None:
    """Advance the mode of the drop in lane i."""
    block = s.block
    mu_f = viscosity_at(block, i, medium)
    ratio = block[at.eta * LANES + i] / mu_f
    S, T, v = flow_parts(flow, s, i)
    spin = scale_vector(0.5, vorticity(load9(block, at.l, i)))
    c = source(ratio) * block[at.R * LANES + i]
    # The modulus of a drop is its tension over the radius.
    rate = relaxation_of_drop(mu_f, ratio, block[at.mu * LANES + i])
    advance_mode(block, i, combine(c, S, 0.0, S), rate, spin, ahead(block, i, remaining))
    close_update(flow, s, i, spin)
    store7(block, second.S, i, S)
    store9(block, second.T, i, T)
    store3(block, second.laplacian, i, v)


def advance_ahead(block: Block, i: int, mu_f: float, mu_S: Third, mu_v: Vector) -> None:
    """Store B of lane i where the step is to lead, with μ S and μ v, Pa/m², there; the way and the drift."""
    a, mu_s, eta = block[at.R * LANES + i], block[at.mu * LANES + i], block[at.eta * LANES + i]
    h, growth = block[at.dt * LANES + i], combine(source(eta / mu_f) * a / mu_f, mu_S, 0.0, mu_S)
    spin = load3(block, mode.fluid_spin, i)
    end, growth = mode_after_step(block, i, growth, block[mode.recovery * LANES + i], rotation(spin, h), h)
    rate = relaxation_of_shift(mu_f, mu_s, eta)
    first = load3(block, mode.shift_drift, i)
    store_shift_drift(block, i, scale_vector(rate, shift(a, 1.0, mu_s, mu_v)), rate, spin, h)
    # The path takes twice the change from here on.
    mean = combine_vectors(0.5, first, 0.5, load3(block, mode.shift_drift, i))
    store3(block, mode.shift_drift, i, mean)
    store7(block, mode.end, i, end)
    store7(block, mode.next_growth, i, growth)
    store3(block, mode.way, i, minus(load3(block, at.new_x, i), load3(block, at.x, i)))


def mode_on_way(block: Block, i: int, share: float) -> Third:
    """Return B of lane i at a share of the way; ``share`` is 0 at the start of a step."""
    way, moved = load3(block, mode.way, i), minus(load3(block, at.new_x, i), load3(block, at.x, i))
    length_2 = inner(way, way)
    gone = select((share > 0.0) & (length_2 > 0.0), inner(moved, way) / (length_2 + 1e-300), 0.0)
    return combine(1.0 - gone, load7(block, mode.B, i), gone, load7(block, mode.end, i))


@traced
def carry_solid(block: Block, medium: Medium, share: float, coefficients: Numbers) -> None:  # noqa: ARG001
    """Add the drift of solids to the velocity of the fluid."""
    for i in range(LANES):
        E, B = sym(load9(block, at.l, i)), mode_on_way(block, i, share)
        drift = drift_of_solid(block[at.R * LANES + i], B, E)
        add3(block, at.u, i, plus(drift, load3(block, mode.shift_drift, i)))


@traced
def carry_drop(block: Block, medium: Medium, share: float, coefficients: Numbers) -> None:  # noqa: ARG001
    """Add the velocity of drops relative to the fluid at their centres."""
    for i in range(LANES):
        F, E = load9(block, at.new_F, i), sym(load9(block, at.l, i))
        A = scale(0.5, dev(dot(F, transpose(F))))
        ratio = block[at.eta * LANES + i] / viscosity_at(block, i, medium)
        flow = Parts(load7(block, second.S, i), load9(block, second.T, i), load3(block, second.laplacian, i))
        B = mode_on_way(block, i, share)
        add3(block, at.u, i, drift_of_drop(block[at.R * LANES + i], ratio, A, B, E, flow))


def look_at_end(flow: object, s: Scratch, i: int, medium: Medium, _coefficients: object) -> None:
    """Advance the mode of lane i to where the step is to lead."""
    block = s.block
    t, h = block[at.t * LANES + i], block[at.dt * LANES + i]
    S, _, v = parts(curvature(flow, s.ahead[i], load3(block, at.new_x, i), t + h))
    mu_f = viscosity_at(block, i, medium)
    advance_ahead(block, i, mu_f, combine(mu_f, S, 0.0, S), scale_vector(mu_f, v))


def look_in_varying(flow: object, s: Scratch, i: int, _medium: Medium, coefficients: Numbers) -> None:
    """Do the same in a fluid whose viscosity varies."""
    block = s.block
    a, t = block[at.R * LANES + i], block[at.t * LANES + i] + block[at.dt * LANES + i]
    mu_S, mu_v, mu_f = stress_parts(flow, s.ahead[i], load3(block, at.new_x, i), t, a, coefficients)
    advance_ahead(block, i, mu_f, mu_S, mu_v)


def stays_resolved(_flow: object, s: Scratch, i: int, _medium: Medium, _coefficients: object) -> float:
    """Return the share of a step of lane i in which the source of B changes little, or changes B little."""
    block = s.block
    h, before, after = (
        block[at.dt * LANES + i],
        load7(block, mode.growth, i),
        load7(block, mode.next_growth, i),
    )
    change = square(combine(1.0, after, -1.0, before)) ** 0.5
    largest = max(square(before) ** 0.5, square(after) ** 0.5)
    time = min(h, 1.0 / block[mode.recovery * LANES + i])
    allowed = max(_CHANGE * largest, _CHANGE_OF_B / time)
    return float(min(1.0, allowed / (change + 1e-300)))


def mode_of_lane(block: Block, i: int, F: Tensor) -> tuple[Third, Tensor]:
    """Return B of lane i and the rotation of F, for contact."""
    return load7(block, mode.B, i), turn_of(F)


def mode_of_row(p: Particles, k: int, F: Tensor) -> tuple[Third, Tensor]:
    """Return B of particle k and the rotation of F, for contact."""
    b = p.B
    return (b[k, 0], b[k, 1], b[k, 2], b[k, 3], b[k, 4], b[k, 5], b[k, 6]), turn_of(F)


@separate
def turn_mode(block: Block, i: int, turn: Tensor) -> None:
    """Turn or mirror the mode of lane i, and the flow where it was computed last."""
    store7(block, mode.B, i, turned(load7(block, mode.B, i), turn))
    store7(block, mode.growth, i, turned(load7(block, mode.growth, i), turn))
    store3(block, mode.shift, i, dot_vector(turn, load3(block, mode.shift, i)))
    store3(block, mode.pull, i, dot_vector(turn, load3(block, mode.pull, i)))
    store3(
        block, mode.fluid_spin, i, scale_vector(det(turn), dot_vector(turn, load3(block, mode.fluid_spin, i)))
    )
    turn_past(block, i, turn)


def _stages(
    update: Callable[..., None], carry: Callable[..., None], look: Callable[..., None]
) -> tuple[Stage, ...]:
    return (
        Stage("start", update, writes=(mode.B,), before=(at.l,)),
        Stage("ahead", look, writes=(mode.end,)),
        Stage("accept", stays_resolved),
        Stage("fluid", carry, reads=(mode.B, mode.end), adds=(at.u,), before=(at.l,)),
    )


@dataclass(frozen=True, kw_only=True)
class QuadraticSolid(Surrounding):
    """Quadratic mode of elastic bodies: ``subModels { shapeModel quadratic; }``."""

    n_times: int = 0
    """Number of relaxation times of the solid."""

    each_step: ClassVar = False
    kernels: ClassVar = ("curvature",)
    measures: ClassVar = ("quadraticShape", "bulletAmplitude")
    surveys: ClassVar = ("F0",)
    switches: ClassVar = {"updates_end": 1}
    stages: ClassVar = _stages(update_solid, carry_solid, look_at_end)

    @property
    def rows(self) -> tuple[type[tuple[int, ...]], ...]:  # type: ignore[override]
        """Declaration of its rows."""
        return (QuadraticRows, past_rows(self.n_times)) if self.n_times else (QuadraticRows,)

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return how mirrors turn the mode, contact, and how it fades."""
        return {
            **(with_past(self.n_times) if self.n_times else {}),
            turn_along: turn_mode,
            resume: hold_mode,
            mode_in: mode_of_lane,
            mode_of: mode_of_row,
            swelling: swelling_by_mode,
            largest_swelling: largest_swelling_by_mode,
        }

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Refuse ``paper``, which has no update at the end of a call."""
        if integrator.name == "paper":
            return "the shape model quadratic needs the integrator stokes or rosenbrock, not paper"
        return ""

    def remarks(self, survey: Survey) -> Remarks:
        """Warn of bodies that are no spheres at rest."""
        shaped = int(np.count_nonzero((np.eye(3).ravel() != survey.p.F0).any(axis=1)))
        if shaped == 0:
            return Remarks()
        return Remarks(
            (),
            (
                f"{shaped} of {survey.p.size} particles are no spheres at rest: the shape model quadratic "
                "computes their second mode and its drift as those of spheres of the same volume.",
            ),
        )


@dataclass(frozen=True, kw_only=True)
class QuadraticInVarying(QuadraticSolid):
    """Quadratic mode of elastic bodies in a fluid whose viscosity varies."""

    fluid: Surrounding
    """Its viscosity."""
    beside: Callable[..., Any]
    """``beside(flow, host, x, t, l, coefficients) -> mu``: μ_f at a point, Pa s."""

    stages: ClassVar = _stages(update_in_varying, carry_solid, look_in_varying)

    def coefficients(self, patches: Sequence[Patch]) -> tuple[object, ...]:
        """Return those of the fluid."""
        return self.fluid.coefficients(patches)

    def slots(self, inertia: bool) -> Slots:
        """Return also the viscosity at a point."""
        return {**super().slots(inertia), viscosity_beside: self.beside}


@dataclass(frozen=True, kw_only=True)
class QuadraticDrop(QuadraticSolid):
    """Quadratic mode of drops."""

    rows: ClassVar = (QuadraticRows, SecondRows)
    stages: ClassVar = _stages(update_drop, carry_drop, look_at_end)
