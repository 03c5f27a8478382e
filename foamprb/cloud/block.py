"""A block of particles: :data:`LANES` of them side by side, one row of numbers per component.

What every integrator does with a block is here: its rows (:class:`Rows`), filling and emptying it, and the
particle frame with Jeffery's integrals of each lane.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import COMPACT, Integrals, integrals, integrals_of_compact
from foamprb.body.material import metric_at_rest
from foamprb.body.tensor import (
    Tensor,
    Vector,
    dot_vector,
    longest_stretch,
    refined_frame,
    select,
    stretches_in_frame,
)
from foamprb.cloud.layout import IDENTITY, LANES, Row, end, layout, offsets
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.state import Particles, Reason
from foamprb.compile.link import side_by_side, traced

(
    LOST, NOT_FINITE, VOLUME_RATIO, NOT_CONVERGED, STEP_TOO_SMALL,
    FLOW_NOT_FINITE, STRETCHED, TOO_LARGE, WALLS_TOO_MANY, SUB_STEPS, CELLS_TOO_MANY,
) = (int(reason) for reason in Reason if reason)  # fmt: skip


class Rows(NamedTuple):
    """The rows that the block of every integrator has."""

    x: Annotated[int, Row(3, "m", "position of the barycentre", of="x", saved=True)]
    v: Annotated[int, Row(3, "m/s", "velocity of the barycentre", of="v", saved=True)]
    F: Annotated[int, Row(9, "1", "deformation gradient", IDENTITY, of="F", saved=True)]
    A: Annotated[int, Row(9, "1/s", "material velocity gradient dF/dt", of="A", saved=True)]
    Q: Annotated[int, Row(9, "1", "particle frame of new_F, axes as rows")]
    stretch: Annotated[int, Row(3, "1", "stretches of new_F along the axes of Q")]
    skewness: Annotated[int, Row(1, "1", "how far Q is from the axes of new_F: (b_ac/(λ_a λ_c))²")]
    alpha: Annotated[int, Row(3, "1", "Jeffery's α₀, β₀, γ₀ of the stretches")]
    ring: Annotated[int, Row(3, "1", "Jeffery's α₀°, β₀°, γ₀° of the stretches")]
    star: Annotated[int, Row(3, "1", "Jeffery's α₀*, β₀*, γ₀* of the stretches")]
    chi: Annotated[int, Row(1, "1", "χ of the stretches")]
    u: Annotated[int, Row(3, "m/s", "velocity of the fluid at the barycentre")]
    l: Annotated[int, Row(9, "1/s", "velocity gradient ∂u_i/∂x_j of the fluid there")]
    DuDt: Annotated[int, Row(3, "m/s2", "acceleration of the fluid there, ∂u/∂t + l·u")]
    stress: Annotated[int, Row(9, "Pa", "σ̃* less the viscous stress of the solid, in the frame Q")]
    predictor: Annotated[int, Row(9, "1", "Newton's first iterate Q·(F + Δt A)")]
    new_x: Annotated[int, Row(3, "m", "x at the end of the step, if no wall is met")]
    new_v: Annotated[int, Row(3, "m/s", "v at the end of the step")]
    new_F: Annotated[int, Row(9, "1", "F at the end of the step, or of the stage", IDENTITY, of="F")]
    new_A: Annotated[int, Row(9, "1/s", "A at the end of the step")]
    J: Annotated[int, Row(1, "1", "volume ratio det F at the end of the step")]
    error: Annotated[int, Row(1, "1", "estimated error of the step")]
    R: Annotated[int, Row(1, "m", "radius at rest, of the sphere of the same volume", 1.0, of="R")]
    rho: Annotated[int, Row(1, "kg/m3", "density at rest", 1.0, of="rho")]
    mu: Annotated[int, Row(1, "Pa", "shear modulus of the solid", 1.0, of="mu")]
    lame: Annotated[int, Row(1, "Pa", "Lame's first parameter of the solid", 1.0, of="lame")]
    k: Annotated[int, Row(1, "1", "third parameter of the solid, if it has one", 1.0, of="k")]
    eta: Annotated[int, Row(1, "Pa s", "viscosity of the solid", of="eta")]
    inertia: Annotated[
        int, Row(1, "m/kg", "5/(ρ_s R²), the inverse inertia of the shape per volume", 5.0, lasting=True)
    ]
    tension: Annotated[int, Row(1, "Pa", "surface tension over the radius, γ/R", lasting=True)]
    F0: Annotated[int, Row(9, "1", "F at rest, from that sphere", of="F0", saved="mirrored")]
    M: Annotated[int, Row(9, "1", "shape at rest, (F₀ F₀)⁻¹", IDENTITY, lasting=True)]
    mirrored: Annotated[int, Row(1, "", "1 where F0 has changed, else 0", lasting=True)]
    frame: Annotated[int, Row(9, "1", "particle frame of F, axes as rows", IDENTITY, of="Q", saved=True)]
    renewed: Annotated[
        int, Row(1, "", "1 where F and its frame are new or turned since the last step", lasting=True)
    ]
    t0: Annotated[int, Row(1, "s", "time of injection", of="t0")]
    t: Annotated[int, Row(1, "s", "time to which the particle has come", of="t", saved=True)]
    h: Annotated[int, Row(1, "s", "time step that the error allows", of="h", saved=True)]
    dt: Annotated[int, Row(1, "s", "time step that is being taken")]
    moving: Annotated[int, Row(1, "", "1 where a step is being taken, else 0")]
    verdict: Annotated[int, Row(1, "", "reason why the new state is not sound; 0 if it is")]
    length: Annotated[int, Row(1, "m", "longest semi-axis, or a little more", lasting=True)]
    clearance: Annotated[int, Row(1, "m", "gap between the body and the nearest wall", lasting=True)]
    maxStretch: Annotated[int, Row(1, "1", "largest stretch of F that is allowed", lasting=True)]
    maxLength: Annotated[int, Row(1, "m", "longest semi-axis that is allowed", lasting=True)]
    taken: Annotated[
        int, Row(1, "1", "steps taken since the last whole tracking step, also those repeated", lasting=True)
    ]
    substeps: Annotated[
        int, Row(1, "1", "the same of the last tracking step that is done", of="substeps", saved=True)
    ]


at = offsets(Rows)
"""The number of the first row of each quantity."""
ROWS = end(at)
idle, load_rows, save_rows, ask_rows = layout(at)[1:5]

# Largest |b_ac|/(λ_a λ_c) between the axes of a frame, squared; what was stored is held to a little less.
_SKEWNESS, _STORED_SKEWNESS = 1e-24, 1e-22
_MOST_REPEATS = 10
_MIN_J, _MAX_J = 0.125, 8.0
_LINE = 8
"""Numbers on a line of memory, and in the widest register."""


class Medium(NamedTuple):
    """The fluid around the particles, and gravity."""

    mu: float
    """Pa s."""
    rho: float
    """kg/m³."""
    gravity: Vector
    """m/s²."""
    coefficients: Any = ()
    """Of the forces on the barycentre: the loop's, which a cloud fills in from its models."""
    surroundings: Any = ()
    """Coefficients of the models of the surroundings, likewise."""


REBOUND_NUMBERS = 21
"""Numbers that are noted of a rebound (:func:`foamprb.cloud.rebounds.note`)."""


class Scratch(NamedTuple):
    """Working memory of a loop: while a block is in it, the cloud's arrays are left alone.

    Neighbours in memory may be in the blocks of other threads, and a line of memory that two processors write
    to goes to and fro between them.
    """

    block: Any
    """Rows × LANES numbers, flat."""
    status: Any
    """LANES whole numbers, as those that follow: what each particle is doing."""
    reason: Any
    patch: Any
    host: Any
    ahead: Any
    """The host to which the step of each leads."""
    step: Any
    """The step at which each particle is."""
    matrix: Any
    """9 × 10 numbers: one particle's equations."""
    stop: Any
    """A whole number that others share: not zero when a loop shall end at once."""
    number: Any
    """LANES whole numbers: which of the whole cloud each particle is."""
    outgrown: Any
    """A whole number: not zero once a wall may not be listed, or a rebound has no room."""
    rebounds: Any
    """Room for the rebounds of this loop's particles, (n, :data:`REBOUND_NUMBERS`)."""
    noted: Any
    """Two whole numbers: how many are there, and how many of them of blocks that are done."""
    bounds: LoopLimits
    """What no particle may pass."""
    member: Any
    """LANES whole numbers: which particle of the cloud's arrays is in each lane, −1 for none."""
    mended: Any
    """LANES whole numbers: how many walks of each the tree has mended."""
    kept: Any
    """Numbers of rows, as of :class:`~foamprb.cloud.layout.Layout`."""
    fresh: Any
    """Values, likewise."""
    shelf: Any
    """What is in the n rows ``kept`` of particles that are put aside, (:data:`SHELF`, n)."""
    labels: Any
    """Beside it whole numbers, (:data:`SHELF`, :data:`LABELS`)."""
    counts: Any
    """Whole numbers: how many are put aside, and what else is counted there."""
    asked: Any
    """One number without meaning: what was read in advance, which the compiler must believe to be of use."""
    stride: Any
    """LANES whole numbers: the tracking steps of the stretch that each is in."""


SHELF, LABELS, COUNTS = 15 * LANES, 8, 5
"""Places on a shelf, and whole numbers beside each; numbers that are counted."""


def new_scratch(
    rows: int,
    stop: Any = None,
    bounds: LoopLimits = LoopLimits(),  # noqa: B008
    room: int = 0,
    kept: tuple[NDArray[np.int64], NDArray[np.float64]] = (np.empty(0, dtype=np.int64), np.empty(0)),
) -> Scratch:
    """Working memory for a block of that many rows.

    Parameters
    ----------
    stop, bounds
        As in :class:`Scratch`.
    room
        How many rebounds it can take.
    kept
        The layout's ``kept`` and ``fresh``, if particles are to be put aside.
    """
    rows_kept, fresh = kept
    # One array, so that no other thread writes to the same lines of memory.
    lanes = iter(np.zeros((10, LANES), dtype=np.int64))

    return Scratch(
        block=new_block(rows),
        status=next(lanes),
        reason=next(lanes),
        patch=next(lanes),
        host=next(lanes),
        ahead=next(lanes),
        step=next(lanes),
        matrix=np.empty((9, 10)),
        stop=np.zeros(1, dtype=np.int64) if stop is None else stop,
        number=next(lanes),
        outgrown=np.zeros(1, dtype=np.int64),
        rebounds=np.empty((room, REBOUND_NUMBERS)),
        noted=np.zeros(2, dtype=np.int64),
        bounds=bounds,
        member=next(lanes),
        mended=next(lanes),
        kept=rows_kept,
        fresh=fresh,
        shelf=np.empty((SHELF, len(rows_kept))),
        labels=np.empty((SHELF, LABELS), dtype=np.int64),
        counts=np.zeros(COUNTS, dtype=np.int64),
        asked=np.empty(1),
        stride=next(lanes),
    )


def new_block(rows: int) -> NDArray[np.float64]:
    """Rows × LANES numbers, flat, of which no register full lies on two lines of memory."""
    room = np.empty(rows * LANES + _LINE)
    first = -room.ctypes.data // room.itemsize % _LINE
    return room[first : first + rows * LANES]


def load3(block: Any, row: int, i: int) -> Vector:
    """The vector in three rows of lane i."""
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES]


def store3(block: Any, row: int, i: int, v: Vector) -> None:
    """Put a vector into three rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = v[0], v[1], v[2]


def load4(block: Any, row: int, i: int) -> tuple[Any, Any, Any, Any]:
    """The numbers in four rows of lane i."""
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES], block[k + 3 * LANES]


def store4(block: Any, row: int, i: int, v: tuple[Any, Any, Any, Any]) -> None:
    """Put four numbers into as many rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES], block[k + 3 * LANES] = v[0], v[1], v[2], v[3]


def load9(block: Any, row: int, i: int) -> Tensor:
    """The tensor in nine rows of lane i."""
    k = row * LANES + i
    return (
        block[k], block[k + LANES], block[k + 2 * LANES],
        block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES],
        block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES],
    )  # fmt: skip


def store9(block: Any, row: int, i: int, T: Tensor) -> None:
    """Put a tensor into nine rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = T[0], T[1], T[2]
    block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES] = T[3], T[4], T[5]
    block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES] = T[6], T[7], T[8]


def store_fluid(block: Any, i: int, u: Vector, l_f: Tensor, u_t: Vector) -> None:
    """Put the fluid's u, its gradient and its acceleration Du/Dt = ∂u/∂t + l·u into lane i."""
    store3(block, at.u, i, u)
    store9(block, at.l, i, l_f)
    c = dot_vector(l_f, u)
    store3(block, at.DuDt, i, (u_t[0] + c[0], u_t[1] + c[1], u_t[2] + c[2]))


def load_integrals(block: Any, i: int) -> Integrals:
    """Jeffery's integrals of lane i."""
    return Integrals(
        alpha=load3(block, at.alpha, i),
        ring=load3(block, at.ring, i),
        star=load3(block, at.star, i),
        chi=block[at.chi * LANES + i],
    )


def store_integrals(block: Any, i: int, g: Integrals) -> None:
    """Put Jeffery's integrals into lane i."""
    store3(block, at.alpha, i, g.alpha)
    store3(block, at.ring, i, g.ring)
    store3(block, at.star, i, g.star)
    block[at.chi * LANES + i] = g.chi


def new_frames(block: Any) -> None:
    """Particle frame and stretches of the new deformation gradient, from the frame of the last one."""
    frame_stage(block)
    stretch_stage(block)
    straighten(block, _SKEWNESS)


def resume_frames(block: Any) -> None:
    """Particle frames and stretches as they were when the block's particles were last saved."""
    for i in range(LANES):
        store9(block, at.Q, i, load9(block, at.frame, i))
    # One compiled stage serves both: elsewhere the compiler may contract sums in another way.
    stretch_stage(block)
    # For a particle that never moved, or whose F somebody set.
    straighten(block, _STORED_SKEWNESS)


def renew_frames(block: Any) -> None:
    """As :func:`resume_frames`, of lanes whose state was put there or turned since the last step."""
    found = 0
    for i in range(LANES):
        if block[at.renewed * LANES + i] > 0.0:
            block[at.renewed * LANES + i] = 0.0
            found += 1
            store9(block, at.Q, i, load9(block, at.frame, i))
            store9(block, at.new_F, i, load9(block, at.F, i))
    if found:
        stretch_stage(block)
        straighten(block, _STORED_SKEWNESS)
        new_integrals(block)


@side_by_side
def frame_stage(block: Any) -> None:
    """Particle frame of the new deformation gradient, from the frame of the last one."""
    for i in range(LANES):
        store9(block, at.Q, i, refined_frame(load9(block, at.new_F, i), load9(block, at.frame, i)))


@traced
def stretch_stage(block: Any) -> None:
    """Stretches of the new deformation gradient along its frame, and how skew that still is."""
    for i in range(LANES):
        stretches, skewness = stretches_in_frame(load9(block, at.new_F, i), load9(block, at.Q, i))
        store3(block, at.stretch, i, stretches)
        block[at.skewness * LANES + i] = skewness


def straighten(block: Any, allowed: float) -> None:
    """Refine the frames further that have turned too far for one pass."""
    for _ in range(_MOST_REPEATS):
        found = 0
        for i in range(LANES):
            if block[at.skewness * LANES + i] > allowed:
                found += 1
        if found == 0:
            break
        straighten_stage(block, allowed)
        stretch_stage(block)


@side_by_side
def straighten_stage(block: Any, allowed: float) -> None:
    """Refine those frames, and no others, that are more skew than is allowed."""
    for i in range(LANES):
        Q = load9(block, at.Q, i)
        refined = refined_frame(load9(block, at.new_F, i), Q)
        store9(block, at.Q, i, choose(block[at.skewness * LANES + i] > allowed, refined, Q))


def note_pace(_block: Any, _i: int, _tolerance: float) -> None:
    """Nothing says how long the next step of lane i may be."""


@side_by_side
def accept_stage(block: Any, tolerance: float) -> None:
    """Judge the new shapes and velocities, and take over those that are sound, of the lanes that move."""
    for i in range(LANES):
        block[at.taken * LANES + i] += block[at.moving * LANES + i]
        F, A, v = load9(block, at.new_F, i), load9(block, at.new_A, i), load3(block, at.new_v, i)
        total = (
            (v[0] + v[1] + v[2] + F[0] + F[1] + F[2] + F[3] + F[4] + F[5] + F[6] + F[7] + F[8])
            + (A[0] + A[1] + A[2] + A[3] + A[4] + A[5] + A[6] + A[7] + A[8])
        )  # fmt: skip
        J = block[at.J * LANES + i]
        verdict = select(block[at.error * LANES + i] <= tolerance, 0.0, float(NOT_CONVERGED))
        stretch = longest_stretch(F)
        length = block[at.R * LANES + i] * stretch
        verdict = select(length <= block[at.maxLength * LANES + i], verdict, float(TOO_LARGE))
        verdict = select(stretch <= block[at.maxStretch * LANES + i], verdict, float(STRETCHED))
        verdict = select((J >= _MIN_J) & (J <= _MAX_J), verdict, float(VOLUME_RATIO))
        verdict = select(abs(total) < np.inf, verdict, float(NOT_FINITE))
        block[at.verdict * LANES + i] = verdict
        note_pace(block, i, tolerance)
        sound = (verdict == 0.0) & (block[at.moving * LANES + i] > 0.0)
        block[at.length * LANES + i] = select(sound, length, block[at.length * LANES + i])
        store9(block, at.F, i, choose(sound, F, load9(block, at.F, i)))
        store9(block, at.A, i, choose(sound, A, load9(block, at.A, i)))
        store9(block, at.frame, i, choose(sound, load9(block, at.Q, i), load9(block, at.frame, i)))
        w = load3(block, at.v, i)
        store3(block, at.v, i, choose3(sound, v, w))


def choose3(condition: Any, v: Vector, w: Vector) -> Vector:
    """V where the condition holds, else w."""
    return select(condition, v[0], w[0]), select(condition, v[1], w[1]), select(condition, v[2], w[2])


def choose(condition: Any, S: Tensor, T: Tensor) -> Tensor:
    """S where the condition holds, else T."""
    return (
        select(condition, S[0], T[0]), select(condition, S[1], T[1]), select(condition, S[2], T[2]),
        select(condition, S[3], T[3]), select(condition, S[4], T[4]), select(condition, S[5], T[5]),
        select(condition, S[6], T[6]), select(condition, S[7], T[7]), select(condition, S[8], T[8]),
    )  # fmt: skip


def new_integrals(block: Any) -> None:
    """Jeffery's integrals of the stretches."""
    elongated = 0
    for i in range(LANES):
        if is_elongated(load3(block, at.stretch, i)):
            elongated += 1
    if elongated < LANES:
        compact_stage(block)
    if elongated > 0:
        elongated_stage(block)


def is_elongated(stretches: Vector) -> Any:
    """Whether the integrals of a body want more work."""
    x, y, z = stretches
    return np.maximum(np.maximum(x, y), z) > COMPACT * np.minimum(np.minimum(x, y), z)


@side_by_side
def compact_stage(block: Any) -> None:
    """Jeffery's integrals of the stretches, of bodies that are not elongated."""
    for i in range(LANES):
        store_integrals(block, i, integrals_of_compact(load3(block, at.stretch, i)))


@side_by_side
def elongated_stage(block: Any) -> None:
    """Those of the others; the rest stays as it is."""
    for i in range(LANES):
        stretches, known = load3(block, at.stretch, i), load_integrals(block, i)
        g, elongated = integrals(stretches), is_elongated(stretches)
        alpha = choose3(elongated, g.alpha, known.alpha)
        ring, star = choose3(elongated, g.ring, known.ring), choose3(elongated, g.star, known.star)
        chi = select(elongated, g.chi, known.chi)
        store_integrals(block, i, Integrals(alpha=alpha, ring=ring, star=star, chi=chi))


def load_particle(p: Particles, k: int, s: Scratch, i: int) -> None:
    """Copy particle k of the cloud into lane i."""
    s.status[i], s.host[i], s.number[i] = p.status[k], p.host[k], p.number[k]
    # None of those that are loaded has ended.
    s.reason[i], s.patch[i] = 0, -1
    load_rows(p, k, s.block, i)
    s.block[at.inertia * LANES + i] = 5.0 / (p.rho[k] * p.R[k] * p.R[k])
    s.block[at.tension * LANES + i] = p.gamma[k] / p.R[k]
    store9(s.block, at.M, i, metric_at_rest(load9(s.block, at.F0, i)))
    s.block[at.clearance * LANES + i] = np.inf
    s.block[at.taken * LANES + i] = 0.0
    s.block[at.maxStretch * LANES + i] = s.bounds.maxStretch * longest_stretch(load9(s.block, at.F0, i))
    s.block[at.maxLength * LANES + i] = s.bounds.maxLength
    s.block[at.length * LANES + i] = p.R[k] * longest_stretch(load9(s.block, at.F, i))


def ask_for_particle(p: Particles, k: int) -> float:
    """Read of particle k what :func:`load_particle` will: of many, the memory is so waited for at once."""
    return float(p.status[k] + p.host[k] + p.number[k] + p.gamma[k] + ask_rows(p, k))


def save_particle(p: Particles, k: int, s: Scratch, i: int) -> None:
    """Copy the state in lane i back to particle k of the cloud."""
    p.host[k] = s.host[i]
    # What seldom changes is left alone: each line of memory that is not written to is time won.
    if p.status[k] != s.status[i]:
        p.status[k], p.reason[k], p.patch[k] = s.status[i], s.reason[i], s.patch[i]
    save_rows(p, k, s.block, i)


def idle_lanes(block: Any, dt: float) -> None:
    """Fill every lane with a sphere at rest, which takes steps of Δt."""
    idle(block)
    for i in range(LANES):
        block[at.dt * LANES + i] = dt


BLOCK_STAGES = (
    frame_stage, stretch_stage, straighten_stage, compact_stage, elongated_stage, accept_stage
)  # fmt: skip
"""The stages that every integrator has."""
