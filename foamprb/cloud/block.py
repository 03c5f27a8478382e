"""Block of :data:`LANES` particles, with one row of numbers per component.

It holds the rows that every integrator has (:class:`Rows`), loading and saving of particles, and the stages
for the particle frames and Jeffery's integrals.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import COMPACT, Integrals, integrals, integrals_of_compact
from foamprb.body.material import metric_at_rest
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    dot_vector,
    longest_stretch,
    refined_frame,
    select,
    stretches_in_frame,
)
from foamprb.cloud.layout import IDENTITY, LANES, Block, Layout, Row, end, load_rows, offsets, save_rows
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.state import Particles, Reason
from foamprb.compile.link import packed, traced
from foamprb.compile.record import record

(
    LOST, NOT_FINITE, VOLUME_RATIO, NOT_CONVERGED, STEP_TOO_SMALL,
    FLOW_NOT_FINITE, STRETCHED, TOO_LARGE, WALLS_TOO_MANY, SUB_STEPS, CELLS_TOO_MANY,
) = (int(reason) for reason in Reason if Reason.NONE < reason <= Reason.CELLS_TOO_MANY)  # fmt: skip


class Rows(NamedTuple):
    """Rows of the block of every integrator."""

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
    new_v: Annotated[int, Row(3, "m/s", "v at the end of the step; once accepted, at its start")]
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
    fluid: Annotated[int, Row(1, "Pa s", "viscosity of the fluid at the start of the step", 1.0)]
    inertia: Annotated[
        int, Row(1, "m/kg", "5/(ρ_s R²), the inverse inertia of the shape per volume", 5.0, lasting=True)
    ]
    tension: Annotated[int, Row(1, "Pa", "surface tension over the radius, γ/R", lasting=True)]
    fading: Annotated[
        int, Row(1, "1/s", "fastest rate at which the memory of the solid fades; 0 without", lasting=True)
    ]
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
    gone: Annotated[int, Row(1, "1", "share of the step after which forces act: 0 at x, else at new_x")]
    verdict: Annotated[int, Row(1, "", "reason why the new state is not sound; 0 if it is")]
    length: Annotated[int, Row(1, "m", "longest semi-axis, or a little more", lasting=True)]
    clearance: Annotated[int, Row(1, "m", "gap between the body and the nearest wall", lasting=True)]
    reaction: Annotated[int, Row(3, "m2/s", "reactions of up to three walls in the step, over μ_f")]
    contact_normal: Annotated[int, Row(9, "1", "normals of these walls, into the fluid")]
    maxStretch: Annotated[int, Row(1, "1", "largest stretch of F that is allowed", lasting=True)]
    maxLength: Annotated[int, Row(1, "m", "longest semi-axis that is allowed", lasting=True)]
    taken: Annotated[
        int, Row(1, "1", "steps taken since the last whole tracking step, also those repeated", lasting=True)
    ]
    substeps: Annotated[
        int, Row(1, "1", "the same of the last tracking step that is done", of="substeps", saved=True)
    ]
    passed: Annotated[int, Row(1, "1", "share of the time of the step at an evaluation")]


at = offsets(Rows)
"""Index of the first row of each quantity."""
ROWS = end(at)

# Largest |b_ac|/(λ_a λ_c) between the axes of a frame, squared; stored frames may be a little more skew.
_SKEWNESS, _STORED_SKEWNESS = 1e-24, 1e-22
_MOST_REPEATS = 10
_MIN_J, _MAX_J = 0.125, 8.0
_LINE = 8
"""Doubles on a cache line, and in the widest register."""


Ints: TypeAlias = NDArray[np.int64]
Floats: TypeAlias = NDArray[np.float64]
Four: TypeAlias = tuple[Scalar, Scalar, Scalar, Scalar]


@record
class Medium(NamedTuple):
    """Fluid around the particles, and gravity."""

    mu: Any
    """Viscosity, Pa s, or a model of it (:mod:`foamprb.cloud.viscosity`)."""
    rho: Scalar
    """kg/m³, a number; at each of some particles, (n,), where it varies."""
    gravity: Vector = (0.0, 0.0, 0.0)
    """m/s²."""
    forces: Any = ()
    """Coefficients of the forces on the barycentre, (n,); a cloud takes them from its models."""
    numbers: Any = ()
    """Coefficients of the models of the surroundings, (n,), likewise."""


@choice
def viscosity_at(_block: Block, _i: int, medium: Medium) -> Scalar:
    """Return μ_f at the barycentre of lane i, Pa s: a constant, unless a model of it replaces this."""
    return medium.mu


class LocalMedium(NamedTuple):
    """The same at a particle, as forces read it."""

    mu: Any
    rho: Scalar
    gravity: Vector = (0.0, 0.0, 0.0)
    forces: Any = ()


@choice
def local_medium(_block: Block, _i: int, medium: Medium) -> LocalMedium:
    """Return the medium with the density at lane i, a constant; see :func:`viscosity_at`."""
    return LocalMedium(medium.mu, medium.rho, medium.gravity, medium.forces)


REBOUND_NUMBERS = 21
"""Numbers that are recorded of a rebound (:func:`foamprb.cloud.contact.note`)."""


class Recorder(NamedTuple):
    """Records of steps, and which steps and rows these are (:mod:`foamprb.cloud.paths`); none by default."""

    tables: Floats = np.empty((0, 0, 0))
    """(n, rows, LANES) steps of all lanes, one table after the other."""
    count: Any = np.zeros(2, dtype=np.int64)
    """(2,) number of tables with steps; level of the rows that are recorded of the present step."""
    starts: Ints = np.empty((0, 3), dtype=np.int64)
    """(k, 3) rows that are recorded before a step is accepted, those of the table, and their levels: 1 in
    every record, 2 in those of steps that may lead past an instant."""
    ends: Ints = np.empty((0, 3), dtype=np.int64)
    """The same after it."""
    watched: NDArray[np.bool_] = np.empty(0, dtype=np.bool_)
    """1 for each particle of the cloud all of whose steps are recorded, else 0; empty for none."""
    times: Floats = np.empty(0)
    """(w,) instants, s, rising."""
    slack: float = 0.0
    """Time by which a step may be longer than intended, s."""


class Switches(NamedTuple):
    """What the loop does for the integrator and the models; 0 for no."""

    bouncing: int = 0
    """How a body with inertia bounces, see :mod:`foamprb.cloud.motion`."""
    reflects_steps: int = 0
    """1 if a step into a wall on which a body would slide is reflected, as for random motion."""
    draws: int = 0
    """1 if models draw random numbers."""
    updates_end: int = 0
    """1 if rates, or models, are updated at the ends of calls."""


@record
class Scratch(NamedTuple):
    """Working memory of a loop, so that the cloud's arrays are written only for finished particles.

    Neighbours in the cloud's arrays may belong to other threads, and writing to shared cache lines is slow.
    """

    block: Block
    """Rows × LANES numbers, flat."""
    status: Ints
    """Status of each lane, (LANES,) integers as all up to ``step``."""
    reason: Ints
    patch: Ints
    host: Ints
    ahead: Ints
    """Host at the end of the step."""
    step: Ints
    """Tracking step."""
    matrix: Floats
    """(9, 10) linear equations of one particle."""
    stop: Ints
    """(1,) integer shared with other threads: not 0 to stop the loop at once."""
    number: Ints
    """(LANES,) index of each particle in the whole cloud."""
    outgrown: Ints
    """(1,) integer: not 0 once a wall may not be listed, or a rebound has no room."""
    rebounds: Floats
    """Buffer for the rebounds, (n, :data:`REBOUND_NUMBERS`)."""
    noted: Ints
    """(2,) number of recorded rebounds, in all and of finished blocks."""
    bounds: LoopLimits
    """Limits of the particles."""
    member: Ints
    """(LANES,) index of each particle in the cloud's arrays, −1 for none."""
    mended: Ints
    """(LANES,) number of walks that needed the tree."""
    lasting: Ints
    """As in :class:`~foamprb.cloud.layout.Layout`."""
    fresh: Floats
    """As in :class:`~foamprb.cloud.layout.Layout`."""
    shelf: Floats
    """Rows ``lasting`` of the particles that are set aside, (:data:`SHELF`, n)."""
    labels: Ints
    """Their integers, (:data:`SHELF`, :data:`LABELS`)."""
    counts: Ints
    """(:data:`COUNTS`,) numbers of particles set aside, and other counts (:mod:`foamprb.cloud.lanes`)."""
    stride: Ints
    """(LANES,) tracking steps to the end of the stretch."""
    recorder: Recorder
    initial: Floats
    """As in :class:`~foamprb.cloud.layout.Layout`."""
    switches: Switches
    fields: Any
    """Packed arrays of the fields of the case that forces need, see
    :func:`foamprb.flow.fields.blend_fields`."""


SHELF, LABELS, COUNTS = 10 * LANES, 8, 5
"""Places on the shelf, integers of each, and counts."""


def new_scratch(
    layout: Layout,
    stop: Ints | None = None,
    bounds: LoopLimits = LoopLimits(),  # noqa: B008
    room: int = 0,
    switches: Switches = Switches(),  # noqa: B008
) -> Scratch:
    """Return working memory for a block of a layout.

    Parameters
    ----------
    stop, bounds, switches
        As in :class:`Scratch`.
    room
        Length of the buffer for rebounds.
    """
    # One array, so that no other thread writes to the same lines of memory.
    lanes = iter(np.zeros((10, LANES), dtype=np.int64))

    return Scratch(
        block=new_block(layout.rows),
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
        lasting=layout.lasting,
        fresh=layout.fresh,
        shelf=np.empty((SHELF, len(layout.lasting))),
        labels=np.empty((SHELF, LABELS), dtype=np.int64),
        counts=np.zeros(COUNTS, dtype=np.int64),
        stride=next(lanes),
        recorder=Recorder(),
        initial=layout.initial,
        switches=switches,
        fields=packed(()),
    )


def new_block(rows: int) -> NDArray[np.float64]:
    """Return rows × LANES numbers, flat, aligned to cache lines."""
    room = np.empty(rows * LANES + _LINE)
    first = -room.ctypes.data // room.itemsize % _LINE
    return room[first : first + rows * LANES]


def load3(block: Block, row: int, i: int) -> Vector:
    """Return the vector in three rows of lane i."""
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES]


def store3(block: Block, row: int, i: int, v: Vector) -> None:
    """Store a vector in three rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = v[0], v[1], v[2]


def load4(block: Block, row: int, i: int) -> Four:
    """Return the numbers in four rows of lane i."""
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES], block[k + 3 * LANES]


def store4(block: Block, row: int, i: int, v: Four) -> None:
    """Store four numbers in four rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES], block[k + 3 * LANES] = v[0], v[1], v[2], v[3]


def load9(block: Block, row: int, i: int) -> Tensor:
    """Return the tensor in nine rows of lane i."""
    k = row * LANES + i
    return (
        block[k], block[k + LANES], block[k + 2 * LANES],
        block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES],
        block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES],
    )  # fmt: skip


def store9(block: Block, row: int, i: int, T: Tensor) -> None:
    """Store a tensor in nine rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = T[0], T[1], T[2]
    block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES] = T[3], T[4], T[5]
    block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES] = T[6], T[7], T[8]


def store_fluid(block: Block, i: int, u: Vector, l_f: Tensor, u_t: Vector) -> None:
    """Store the fluid's u, its gradient and its acceleration Du/Dt = ∂u/∂t + l·u in lane i."""
    store3(block, at.u, i, u)
    store9(block, at.l, i, l_f)
    c = dot_vector(l_f, u)
    store3(block, at.DuDt, i, (u_t[0] + c[0], u_t[1] + c[1], u_t[2] + c[2]))


def load_integrals(block: Block, i: int) -> Integrals:
    """Return Jeffery's integrals of lane i."""
    return Integrals(
        alpha=load3(block, at.alpha, i),
        ring=load3(block, at.ring, i),
        star=load3(block, at.star, i),
        chi=block[at.chi * LANES + i],
    )


def store_integrals(block: Block, i: int, g: Integrals) -> None:
    """Store Jeffery's integrals in lane i."""
    store3(block, at.alpha, i, g.alpha)
    store3(block, at.ring, i, g.ring)
    store3(block, at.star, i, g.star)
    block[at.chi * LANES + i] = g.chi


def new_frames(block: Block) -> None:
    """Compute frame and stretches of the new deformation gradient, from the frame of the last one."""
    frame_stage(block)
    stretch_stage(block)
    straighten(block, _SKEWNESS)


def resume_frames(block: Block) -> None:
    """Restore the frames and stretches of loaded particles."""
    for i in range(LANES):
        store9(block, at.Q, i, load9(block, at.frame, i))
    # The same compiled stage as in new_frames: another might contract sums in another way.
    stretch_stage(block)
    # For a particle that never moved, or whose F was set from outside.
    straighten(block, _STORED_SKEWNESS)


def renew_frames(block: Block) -> None:
    """Restore frames and stretches of the lanes whose state was loaded or turned since the last step."""
    renewed = 0
    for i in range(LANES):
        if block[at.renewed * LANES + i] > 0.0:
            block[at.renewed * LANES + i] = 0.0
            renewed += 1
            store9(block, at.Q, i, load9(block, at.frame, i))
            store9(block, at.new_F, i, load9(block, at.F, i))
    if renewed:
        stretch_stage(block)
        straighten(block, _STORED_SKEWNESS)
        new_integrals(block)


@traced
def frame_stage(block: Block) -> None:
    """Compute the frame of the new deformation gradient, from the frame of the last one."""
    for i in range(LANES):
        store9(block, at.Q, i, refined_frame(load9(block, at.new_F, i), load9(block, at.frame, i)))


@traced
def stretch_stage(block: Block) -> None:
    """Compute the stretches of the new deformation gradient along its frame, and the frame's skewness."""
    for i in range(LANES):
        stretches, skewness = stretches_in_frame(load9(block, at.new_F, i), load9(block, at.Q, i))
        store3(block, at.stretch, i, stretches)
        block[at.skewness * LANES + i] = skewness


def straighten(block: Block, allowed: float) -> None:
    """Repeat the refinement of frames that turned too far for one pass."""
    for _ in range(_MOST_REPEATS):
        skewed = 0
        for i in range(LANES):
            if block[at.skewness * LANES + i] > allowed:
                skewed += 1
        if skewed == 0:
            break
        straighten_stage(block, allowed)
        stretch_stage(block)


@traced
def straighten_stage(block: Block, allowed: float) -> None:
    """Refine the frames that are more skew than ``allowed``."""
    for i in range(LANES):
        Q = load9(block, at.Q, i)
        refined = refined_frame(load9(block, at.new_F, i), Q)
        store9(block, at.Q, i, choose(block[at.skewness * LANES + i] > allowed, refined, Q))


@choice
def limit_next_step(_block: Block, _i: int, _tolerance: float) -> None:
    """No-op for integrators without step control."""


@choice
def judge(_block: Block, _i: int, verdict: Scalar) -> Scalar:
    """Return the verdict on a step as it is; a model of the surroundings may replace this."""
    return verdict


@choice
def judge_law(_F: Tensor, verdict: Scalar) -> Scalar:
    """Return the verdict on a shape as it is; a solid whose law ends may replace this."""
    return verdict


@traced
def accept_stage(block: Block, tolerance: float) -> None:
    """Judge the new shapes and velocities of the moving lanes, and accept the sound ones."""
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
        verdict = judge_law(F, verdict)
        verdict = select((J >= _MIN_J) & (J <= _MAX_J), verdict, float(VOLUME_RATIO))
        verdict = select(abs(total) < np.inf, verdict, float(NOT_FINITE))
        verdict = judge(block, i, verdict)
        block[at.verdict * LANES + i] = verdict
        limit_next_step(block, i, tolerance)
        sound = (verdict == 0.0) & (block[at.moving * LANES + i] > 0.0)
        block[at.length * LANES + i] = select(sound, length, block[at.length * LANES + i])
        store9(block, at.F, i, choose(sound, F, load9(block, at.F, i)))
        store9(block, at.A, i, choose(sound, A, load9(block, at.A, i)))
        store9(block, at.frame, i, choose(sound, load9(block, at.Q, i), load9(block, at.frame, i)))
        w = load3(block, at.v, i)
        store3(block, at.v, i, choose3(sound, v, w))
        store3(block, at.new_v, i, choose3(sound, w, v))


def choose3(condition: Scalar, v: Vector, w: Vector) -> Vector:
    """Return v where the condition holds, else w."""
    return select(condition, v[0], w[0]), select(condition, v[1], w[1]), select(condition, v[2], w[2])


def choose(condition: Scalar, S: Tensor, T: Tensor) -> Tensor:
    """Return S where the condition holds, else T."""
    return (
        select(condition, S[0], T[0]), select(condition, S[1], T[1]), select(condition, S[2], T[2]),
        select(condition, S[3], T[3]), select(condition, S[4], T[4]), select(condition, S[5], T[5]),
        select(condition, S[6], T[6]), select(condition, S[7], T[7]), select(condition, S[8], T[8]),
    )  # fmt: skip


def new_integrals(block: Block) -> None:
    """Compute Jeffery's integrals of the stretches."""
    elongated = 0
    for i in range(LANES):
        if is_elongated(load3(block, at.stretch, i)):
            elongated += 1
    if elongated < LANES:
        compact_stage(block)
    if elongated > 0:
        elongated_stage(block)


def is_elongated(stretches: Vector) -> Scalar:
    """Return True if the integrals of a body need the formulas for elongated bodies."""
    x, y, z = stretches
    return np.maximum(np.maximum(x, y), z) > COMPACT * np.minimum(np.minimum(x, y), z)


@traced
def compact_stage(block: Block) -> None:
    """Compute Jeffery's integrals with the formulas for compact bodies."""
    for i in range(LANES):
        store_integrals(block, i, integrals_of_compact(load3(block, at.stretch, i)))


@traced
def elongated_stage(block: Block) -> None:
    """Replace the integrals of elongated bodies."""
    for i in range(LANES):
        stretches, compact = load3(block, at.stretch, i), load_integrals(block, i)
        g, elongated = integrals(stretches), is_elongated(stretches)
        alpha = choose3(elongated, g.alpha, compact.alpha)
        ring, star = choose3(elongated, g.ring, compact.ring), choose3(elongated, g.star, compact.star)
        chi = select(elongated, g.chi, compact.chi)
        store_integrals(block, i, Integrals(alpha=alpha, ring=ring, star=star, chi=chi))


def load_particle(p: Particles, k: int, s: Scratch, i: int) -> None:
    """Copy particle k of the cloud into lane i."""
    s.status[i], s.host[i], s.number[i] = p.status[k], p.host[k], p.number[k]
    # A loaded particle may be stuck, but has not ended.
    s.reason[i], s.patch[i] = 0, p.patch[k]
    load_rows(p, k, s.block, i)
    s.block[at.inertia * LANES + i] = 5.0 / (p.rho[k] * p.R[k] * p.R[k])
    s.block[at.tension * LANES + i] = p.gamma[k] / p.R[k]
    s.block[at.fading * LANES + i] = p.memoryRates[k, 0] if p.memoryRates.shape[1] > 0 else 0.0
    store9(s.block, at.M, i, metric_at_rest(load9(s.block, at.F0, i)))
    s.block[at.clearance * LANES + i] = np.inf
    s.block[at.taken * LANES + i] = 0.0
    s.block[at.maxStretch * LANES + i] = s.bounds.maxStretch * longest_stretch(load9(s.block, at.F0, i))
    s.block[at.maxLength * LANES + i] = s.bounds.maxLength
    s.block[at.length * LANES + i] = p.R[k] * longest_stretch(load9(s.block, at.F, i))


def save_particle(p: Particles, k: int, s: Scratch, i: int) -> None:
    """Copy the state in lane i back to particle k of the cloud."""
    p.host[k] = s.host[i]
    # Written only when changed, to save memory traffic.
    if p.status[k] != s.status[i] or p.patch[k] != s.patch[i]:
        p.status[k], p.reason[k], p.patch[k] = s.status[i], s.reason[i], s.patch[i]
    save_rows(p, k, s.block, i)


def idle_lanes(block: Block, initial: Floats, dt: float) -> None:
    """Fill every lane with the initial values, a sphere at rest, and steps of Δt."""
    for row in range(len(initial)):
        for i in range(LANES):
            block[row * LANES + i] = initial[row]
    for i in range(LANES):
        block[at.dt * LANES + i] = dt
