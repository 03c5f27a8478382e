"""The compiled loop over particles, put together from the models that a cloud selects."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import DRAGS
from foamprb.body.ellipsoid import COMPACT
from foamprb.body.error_control import strain_in_frame
from foamprb.body.material import MATERIALS, finger, finger_in_frame
from foamprb.body.rosenbrock import (
    elasticity_by_dilation,
    extra_elasticity_by_dilation,
    extra_stress,
    kirchhoff,
)
from foamprb.body.surface_tension import laplace_stress
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.block import Medium, Scratch, new_scratch
from foamprb.cloud.contact import CROWDED, in_order, note
from foamprb.cloud.forces import DEFAULT, Force, coefficients, compose
from foamprb.cloud.integrators.adaptive import stretch_of
from foamprb.cloud.integrators.base import track_share
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import LANES, rows_of
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.motion import RARE, UNLISTED, PatchTable, beyond, clearance_of, reach_end
from foamprb.cloud.patches import MIRROR, Interaction, Rebound
from foamprb.cloud.state import Particles, Status, empty
from foamprb.cloud.surroundings import registry as surroundings
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.compile.link import compile_part, is_compiled, link, read_by
from foamprb.errors import InputError
from foamprb.flow.analytic import gap_free
from foamprb.flow.base import Patch
from foamprb.flow.meshflow import LONG

__all__ = ["Models", "Outcome", "Tracker", "available_threads", "never"]


def never() -> bool:
    """Return False: the default stop callback."""
    return False


def available_threads() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


class Outcome(NamedTuple):
    """How far the particles came in some steps.

    Where they did not all come to the end, some are there and the others where they began; the same steps
    taken again take the others there, to the same state.
    """

    mended: int = 0
    """Number of walks that failed and were mended by the tree."""
    finished: bool = True
    """Whether all particles came to the end."""
    outgrown: bool = False
    """Whether one did not as it may touch walls that are not listed."""
    crowded: bool = False
    """Whether some did not as there was no room for their rebounds; there is now."""

    def __add__(self, other: Any) -> Outcome:
        """Of two shares of the particles."""
        return Outcome(
            self.mended + other.mended,
            self.finished and other.finished,
            self.outgrown or other.outgrown,
            self.crowded or other.crowded,
        )


@dataclass(frozen=True)
class Models:
    """The models that a cloud selects, by their names in the registries of :mod:`foamprb.body`."""

    traction: str = "roscoe"
    drag: str = "oberbeck"
    material: str = "neoHooke"
    touching: Literal["ellipsoid", "centre"] = "ellipsoid"
    integrator: str = "auto"
    """``auto`` is chosen by a cloud, by its particles' largest shape Stokes number where they start."""
    tolerance: float = 1e-4
    """Largest error of a step of ``stokes`` and ``rosenbrock``; infinite for steps of fixed size."""
    forces: tuple[Force, ...] = DEFAULT
    """What acts on the barycentre beside drag."""
    surroundings: tuple[Surrounding, ...] = ()
    """What changes the fluid that a particle feels, in this order."""
    rebounds: bool = False
    """Whether it is noted where and when particles bounce off (:meth:`Tracker.take_rebounds`)."""
    stride: int = 1
    """How many tracking steps Δt long a step of ``stokes`` or ``rosenbrock`` may be where its error allows
    it. None goes beyond the end of a call of :meth:`foamprb.cloud.cloud.Cloud.advance`."""


class Tracker:
    """The compiled loop over particles with everything that acts on them, but neither particles nor flow.

    Parameters
    ----------
    models
        Names of the models.
    kernels
        The functions of the flow, as :class:`~foamprb.flow.base.Flow` has them.
    medium, interactions, dt, start
        As of a :class:`Cloud`.
    shaped, tense
        Whether some particle is no sphere at rest; whether some has surface tension.
    patches
        The flow's.
    """

    def __init__(
        self,
        models: Models,
        kernels: Mapping[str, Callable[..., Any]],
        medium: Medium,
        interactions: Sequence[Interaction],
        dt: float,
        start: float,
        shaped: bool,
        tense: bool,
        patches: Sequence[Patch] = (),
    ) -> None:
        self._made_of = models, kernels, medium, interactions, dt, start, shaped, tense, patches
        bindings: dict[str, Any] = dict(kernels)
        if models.touching == "centre":
            bindings["gap"] = gap_free
        bindings["traction"] = TRACTIONS[models.traction]
        bindings["drag"] = DRAGS[models.drag]
        material = MATERIALS[models.material]
        bindings["derivatives"] = material.derivatives
        if material.dilation is not None:
            bindings["dilation"] = material.dilation
            bindings["elasticity"] = elasticity_by_dilation
            bindings["extra_elasticity"] = extra_elasticity_by_dilation
        # In its particle frame the elastic strain of a sphere is diagonal.
        if shaped:
            bindings |= {"finger": finger, "finger_in_frame": finger_in_frame}
            bindings |= {"kirchhoff": kirchhoff, "extra_stress": extra_stress}
        else:
            bindings["strain_by"] = strain_in_frame
        if tense:
            bindings["interface"] = laplace_stress
        if models.rebounds:
            bindings["record_rebound"] = note
        self.integrator = integrator = INTEGRATORS[models.integrator]
        self.layout = layout = surroundings.with_rows(integrator.layout, models.surroundings)
        bindings["prefetch_rows"] = layout.prefetch
        required: dict[str, Any] = {"idle": layout.idle, "load_rows": layout.load, "save_rows": layout.save}
        required |= integrator.bindings
        required |= compose(models.forces)
        bindings |= required
        bindings |= surroundings.compose(integrator.layout, models.surroundings, integrator.inertia)
        # The flow and the models offer more than every loop reads.
        read = read_by(track_share, {**bindings, "track": integrator.track})
        self.kernels = kernels
        self.bindings = {name: bindings[name] for name in bindings if name in read or name in required}
        self.separate: tuple[Callable[..., Any], ...] = (
            *integrator.stages,
            *(stage for model in models.surroundings for stage in type(model).stages()),
            *integrator.rare,
            *RARE,
            *LONG,
        )
        self.table = _patch_table(interactions)
        self.medium = medium._replace(
            coefficients=coefficients(models.forces),
            surroundings=surroundings.coefficients(models.surroundings, patches),
        )
        self.dt, self.start = dt, start
        self.stride = 1
        # What surrounds a body may change, and be drawn, with each tracking step.
        if integrator.adaptive and models.tolerance < np.inf and not models.surroundings:
            self.stride = models.stride
        self.options = (models.tolerance, self.stride) if integrator.adaptive else ()
        self.whole = stretch_of(self.stride)
        """Calls that begin and end at multiples of so many steps may cut a run anywhere: no bit changes."""
        self.rebounds: list[NDArray[np.float64]] = []
        self._room = _ROOM if models.rebounds else 0
        self._track = link(track_share, {**self.bindings, "track": integrator.track}, self.separate)

    def __reduce__(self) -> tuple[Any, ...]:
        # Another process compiles for itself.
        return Tracker, self._made_of

    @property
    def changing(self) -> frozenset[str]:
        """Names of the arrays of particles that the loop may change with these models and patches."""
        rows = [row for part in self.layout.parts for row in rows_of(type(part)).values()]
        saved = {row.of for row in rows if row.saved} | {"status", "reason", "patch", "host"}
        # Only a mirror changes a shape at rest.
        return frozenset(saved if MIRROR in self.table.code else saved - {"F0"})

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled already."""
        return is_compiled(self._track)

    def compile(self, flow: Any) -> None:
        """Compile the loop in this thread, with what the flow's kernels read."""
        nothing = np.empty(0, dtype=np.int64)
        scratch = self._scratch()
        self._track(
            flow, self.table, self.medium, empty(0), nothing, 0, 0, self.dt, self.start, scratch,
            self.options,
        )  # fmt: skip

    def compile_moves(self, flow: Any) -> None:
        """Compile what comes after the stages in each step, with what the flow's kernels read."""
        self._compile(reach_end, {"flow": flow})

    def compile_contact(self, flow: Any) -> None:
        """Compile what takes particles to walls, through coupled patches and into lanes, likewise.

        Of the rare parts the first, which takes as long as all others: these come with the loop.
        """
        self._compile(clearance_of, {"flow": flow})
        for part in (beyond, *self.integrator.rare[:1]):
            self._compile(part, {"flow": flow})

    def compile_stages(self) -> None:
        """Compile the stages."""
        for stage in self.integrator.stages:
            self._compile(stage, {})

    def _compile(self, function: Callable[..., Any], arguments: dict[str, Any]) -> None:
        """Compile a part of the loop, with examples of those arguments that not every part has."""
        scratch, vector = self._scratch(), (0.0, 0.0, 0.0)
        arguments |= {"patches": self.table, "medium": self.medium, "s": scratch, "block": scratch.block}
        arguments |= {"M": scratch.matrix}
        arguments |= {"p": empty(0), "members": np.empty(0, dtype=np.int64)}
        arguments |= dict.fromkeys(("i", "code", "triangle", "ahead", "step", "last", "kind"), np.int64(0))
        arguments |= dict.fromkeys(("goal", "x0", "x1"), vector)
        arguments |= dict.fromkeys(("tolerance", "allowed", "t_end", "h", "dt", "start"), 0.0)
        arguments |= {"held": False}
        compile_part(function, arguments, self.bindings, self.separate)

    def _scratch(self, stop: Any = None, bounds: LoopLimits = LoopLimits()) -> Scratch:  # noqa: B008
        kept = self.layout.kept, self.layout.fresh
        return new_scratch(self.layout.rows, stop, bounds, self._room, kept)

    def advance(
        self,
        flow: Any,
        p: Particles,
        step: int,
        steps: int,
        threads: int,
        bounds: LoopLimits = LoopLimits(),  # noqa: B008
        stop: Callable[[], bool] = never,
    ) -> Outcome:
        """Carry particles from step ``step`` through ``steps`` steps, in place.

        Parameters
        ----------
        flow
            What the flow's kernels read.
        bounds
            What no particle may pass.
        stop
            Asked some times a second: true to end before all are at the end. A signal's handler that raises
            ends it as well.
        """
        last = step + steps
        reached = np.full(p.size, step)
        # An earlier call may have been stopped after some had come farther than others.
        active = p.status == Status.ACTIVE
        reached[active] = np.maximum(step, np.rint((p.t[active] - self.start) / self.dt).astype(np.int64))
        outcome = Outcome()
        for end in sorted({*np.unique(reached[(reached > step) & (reached < last)]).tolist(), last}):
            rows = np.flatnonzero((p.status <= Status.ACTIVE) & (reached <= step))
            part = self._carry(flow, p, rows, (step, end - step), threads, bounds, stop)
            outcome += part
            if not part.finished:
                break
            step = end
        return outcome

    def _carry(
        self,
        flow: Any,
        p: Particles,
        rows: NDArray[np.int64],
        steps: tuple[int, int],
        threads: int,
        bounds: LoopLimits,
        stop: Callable[[], bool],
    ) -> Outcome:
        """Carry the particles of some rows from a step through so many steps."""
        halt = np.zeros(1, dtype=np.int64)

        def work(share: Share) -> Outcome:
            scratch = self._scratch(halt, bounds)
            mended: int = self._track(
                flow, self.table, self.medium, p, *share, self.dt, self.start, scratch, self.options
            )
            if scratch.noted[1]:
                self.rebounds.append(scratch.rebounds[: scratch.noted[1]].copy())
            outgrown = scratch.outgrown[0]
            return Outcome(mended, not (outgrown or halt[0]), outgrown == UNLISTED, outgrown == CROWDED)

        # A thread that is held up leaves the shares that it has not begun to others.
        shares = shares_of(p, rows, steps, (self.dt, self.start), _SHARES * threads if threads > 1 else 1)
        # Also one share goes to another thread: this one answers signals meanwhile.
        with ThreadPoolExecutor(threads) as pool:
            under_way = [pool.submit(work, share) for share in shares]
            try:
                while wait(under_way, _PATIENCE).not_done:
                    if stop():
                        halt[0] = 1
            except BaseException:
                halt[0] = 1
                raise
        outcome = sum((share.result() for share in under_way), Outcome())
        if outcome.crowded:
            self._room *= _MORE_ROOM
        return outcome

    def take_rebounds(self) -> NDArray[np.float64]:
        """Return the rebounds since the last call, as :func:`foamprb.cloud.contact.in_order` does."""
        found, self.rebounds = self.rebounds, []
        return in_order(found)


class Share(NamedTuple):
    """Particles that a thread carries, as :func:`foamprb.cloud.integrators.base.track_share` wants them."""

    rows: NDArray[np.int64]
    step: int
    steps: int


def shares_of(
    p: Particles, rows: NDArray[np.int64], steps: tuple[int, int], times: tuple[float, float], number: int
) -> list[Share]:
    """Share out the particles of some rows: first those that are active, then those that will be.

    A block goes through all steps of its share, whether its particles are there yet or not. So the pending
    share blocks with those that appear when they do, from that step on; and those that do not appear before
    the end are in none.

    Parameters
    ----------
    p, rows
        Particles, and which of them: active or pending.
    steps
        The first step, and their number.
    times
        Length of a step, and the time at step 0, s.
    number
        Shares of the active, if they have as many blocks.
    """
    (step, count), (dt, start) = steps, times
    pending = p.status[rows] == Status.PENDING
    active, waiting = rows[~pending], rows[pending]
    found = [Share(dealt, step, count) for dealt in _deal(in_blocks(p, active), number)]

    # One step early, as the loop has these times to other last bits.
    due = np.maximum(np.floor((p.t0[waiting] - start) / dt) - 1.0, step)
    coming = due < step + count
    waiting, due = waiting[coming], due[coming]
    order = np.argsort(due, kind="stable")
    blocks = -(-len(waiting) // LANES)
    most = -(-blocks // _GROUPS) * LANES
    for begin in range(0, len(waiting), max(most, 1)):
        group = order[begin : begin + most]
        first = int(due[group[0]])
        found.append(Share(in_blocks(p, waiting[group]), first, step + count - first))
    return found


def _deal(rows: NDArray[np.int64], number: int) -> list[NDArray[np.int64]]:
    """Deal out blocks of rows in turn, to so many if there are as many blocks."""
    blocks = -(-len(rows) // LANES)
    missing = blocks * LANES - len(rows)
    whole = np.pad(rows, (0, missing)).reshape(blocks, LANES)
    hands = min(number, blocks)
    found = [whole[k::hands].ravel() for k in range(hands)]
    if missing:
        last = (blocks - 1) % hands
        found[last] = found[last][:-missing]
    return found


def in_blocks(p: Particles, rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """The order in which particles are put into blocks, of those in some rows.

    A block does for all of them what one needs: those that took as many steps for a Δt, to the power of two,
    share one, first those that took most, so that none is left alone at the end; among them those whose steps
    go to order 3, now or when it is found out again whether they must; among these the elongated, whose
    integrals want more work. Of these do neighbours in the mesh: the nodes they read are then in the cache.
    """
    # As many as the next power of two count as that.
    effort = np.frexp(p.substeps[rows] * (1.0 - 1e-9))[1]
    # Of a body in shear, whose middle axis is about as long as at rest: λ, 1 and 1/λ with λ² = COMPACT.
    many = 2 * len(rows) > p.size
    F = p.F if many else p.F[rows]
    elongated = np.einsum("ni,ni->n", F, F) > COMPACT + 1.0 + 1.0 / COMPACT
    elongated = elongated[rows] if many else elongated
    kind = 4 * p.demanding[rows] + 2 * (p.discount[rows] > 0.0) + elongated
    key = (-effort.astype(np.int64) << 35) + (kind.astype(np.int64) << 32) + p.host[rows]
    # Which of equals comes first does not matter, and a stable order costs four times as much.
    return rows[np.argsort(key)]


_PATIENCE = 0.1
"""Seconds after which it is asked whether to stop."""
_SHARES = 8
"""Of the active particles, for each of several threads."""
_GROUPS = 64
"""Shares of the pending particles that appear during the steps: half of one share's steps are idle."""
_ROOM, _MORE_ROOM = 1000, 4
"""Rebounds of a share in a call; by what it grows where there are more."""


def check(models: Models, tense: bool) -> None:
    """Raise InputError if the models do not go together; ``tense`` as of :class:`Tracker`."""
    if not isinstance(models.stride, int | np.integer) or models.stride < 1:
        raise InputError(
            f"the stride is {models.stride}. Allowed: whole numbers of tracking steps, 1 or more"
        )
    integrator = INTEGRATORS[models.integrator]
    reason = integrator.refuses(models.traction, models.material, tense)
    if reason:
        raise InputError(f"the integrator {integrator.name} {reason}")
    for model in models.surroundings:
        reason = model.refuses(integrator.inertia, integrator.name)
        if reason:
            raise InputError(reason)


def _patch_table(interactions: Sequence[Interaction]) -> PatchTable:
    rebounds = [i if isinstance(i, Rebound) else Rebound() for i in interactions]
    return PatchTable(
        code=np.array([i.code for i in interactions], dtype=np.int8),
        e=np.array([r.e for r in rebounds], dtype=float),
        mu=np.array([r.mu for r in rebounds], dtype=float),
    )
