"""The compiled loop over particles, composed of the models that a cloud selects."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import InitVar, dataclass, replace
from functools import partial
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import DRAGS, drag
from foamprb.body.ellipsoid import COMPACT
from foamprb.body.material import MATERIALS
from foamprb.body.traction import TRACTIONS, traction
from foamprb.cloud.adhesion import Adhesion
from foamprb.cloud.block import Medium, Scratch, new_scratch
from foamprb.cloud.contact import CROWDED, GAPS, contact_normals, gap, in_order
from foamprb.cloud.drops import DROP
from foamprb.cloud.elastic import functions_of_solid
from foamprb.cloud.forces import DEFAULT, Force, coefficients, compose, sum_of_forces
from foamprb.cloud.integrators.adaptive import apply_reactions, find_reactions, sampling, stretch_of
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.lanes import PAUSED
from foamprb.cloud.layout import LANES, load_rows, rows_of, save_rows
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.motion import SHORTEST_STEP, UNLISTED, PatchTable, interrupted
from foamprb.cloud.needs import needed_by, reader_of
from foamprb.cloud.patches import CYCLIC, MIRROR, NO_BOND, REBOUND, Adhere, Interaction, Rebound
from foamprb.cloud.paths import ROOM, Observation, Steps, recorder_of
from foamprb.cloud.pressing import approach, push_out, redirect
from foamprb.cloud.state import Particles, Status, empty
from foamprb.cloud.surroundings import registry as surroundings
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.fates import Fates
from foamprb.cloud.surroundings.largest import LargestValues
from foamprb.cloud.surroundings.memory import FadingMemory
from foamprb.cloud.surroundings.quadratic import QuadraticDrop, QuadraticSolid
from foamprb.cloud.viscosity import in_fluid, model_of
from foamprb.compile.link import Function, conform, is_compiled, link, packed
from foamprb.errors import InputError
from foamprb.flow.analytic import gap_free
from foamprb.flow.base import Patch
from foamprb.flow.fields import FieldColumns, Fields, fields_on, width
from foamprb.flow.kernels import behind
from foamprb.flow.mesh.arrays import no_mesh


def never() -> bool:
    """Return False: the default stop callback."""
    return False


def available_threads() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


class Outcome(NamedTuple):
    """Progress of particles in some steps.

    If not all particles reached the end, each is either there or where it began. The same steps taken again
    bring the others to the end, to the same state.
    """

    mended: int = 0
    """Number of failed walks that a tree search repaired."""
    finished: bool = True
    """Whether all particles reached the end."""
    outgrown: bool = False
    """Whether a particle stopped because it may touch walls that are not listed."""
    crowded: bool = False
    """Whether particles stopped because the buffer of rebounds was full; it is larger now."""

    def __add__(self, other: Any) -> Outcome:
        """Return the sum of two outcomes."""
        return Outcome(
            self.mended + other.mended,
            self.finished and other.finished,
            self.outgrown or other.outgrown,
            self.crowded or other.crowded,
        )


SHAPES = ("affine", "quadratic")
"""Models of the shape."""


@dataclass(frozen=True)
class Models:
    """The models that a cloud selects, by their names in the registries of :mod:`foamprb.body`."""

    traction: str = "roscoe"
    drag: str = "oberbeck"
    material: str = "neoHooke"
    touching: Literal["ellipsoid", "centre"] = "ellipsoid"
    integrator: str = "auto"
    """``auto``: the cloud chooses by the largest shape Stokes number of its particles at their start."""
    tolerance: float = 1e-4
    """Largest error of a step of ``stokes`` and ``rosenbrock``, see :attr:`roughness_share`; infinite for
    steps of fixed size."""
    forces: tuple[Force, ...] = DEFAULT
    """Forces on the barycentre beside drag."""
    surroundings: tuple[Surrounding, ...] = ()
    """Models that change the fluid at a particle, in this order."""
    rebounds: bool = False
    """Whether rebounds, and passages of coupled patches, are recorded (:meth:`Tracker.take_rebounds`)."""
    stride: int | None = 1
    """Longest step of ``stokes`` or ``rosenbrock`` where its error allows it, in tracking steps Δt; None for
    any. No step goes beyond the end of a call of :meth:`foamprb.cloud.cloud.Cloud.advance`."""
    roughness_share: float = 0.05
    """Least tolerance over the roughness of the flow (:meth:`foamprb.flow.base.Flow.roughness`); 0 for the
    tolerance as it is, as in studies of convergence."""
    shape: InitVar[str] = "affine"
    """``affine``, or ``quadratic`` for a second mode, which is the first of the ``surroundings``."""

    def __post_init__(self, shape: str) -> None:
        if shape not in SHAPES:
            raise InputError(f"the shape is {shape}. Allowed: {', '.join(SHAPES)}")
        if shape != "affine" and not self.has_quadratic:
            mode = QuadraticDrop() if MATERIALS[self.material].liquid else QuadraticSolid()
            object.__setattr__(self, "surroundings", (mode, *self.surroundings))

    @property
    def has_quadratic(self) -> bool:
        """Whether bodies have the quadratic mode."""
        return any(isinstance(model, QuadraticSolid) for model in self.surroundings)

    @property
    def has_memory(self) -> bool:
        """Whether the solid has memory."""
        return any(isinstance(model, FadingMemory) for model in self.surroundings)

    @property
    def has_fates(self) -> bool:
        """Whether particles may rupture or be released."""
        return any(isinstance(model, Fates) for model in self.surroundings)


class Tracker:
    """Compiled loop over particles with all models, without particles and flow.

    Parameters
    ----------
    models, medium, interactions, dt, start
        See :class:`foamprb.cloud.cloud.Cloud`.
    kernels
        Functions of the flow, ``Flow.kernels``.
    shaped, tense
        Whether a particle is not a sphere at rest; whether one has surface tension.
    patches
        Patches of the flow.
    columns
        Fields of the case with which the flow was read.
    end
        Time at which the last step ends, s; it is shorter than Δt if this is no multiple of Δt.
    """

    def __init__(
        self,
        models: Models,
        kernels: Mapping[str, Function],
        medium: Medium,
        interactions: Sequence[Interaction],
        dt: float,
        start: float,
        shaped: bool,
        tense: bool,
        patches: Sequence[Patch] = (),
        columns: Sequence[FieldColumns] = (),
        end: float = np.inf,
    ) -> None:
        self._made_of = models, kernels, medium, interactions, dt, start, shaped, tense, patches, columns, end
        material = MATERIALS[models.material]
        self.integrator = integrator = INTEGRATORS[models.integrator]
        self.mu = medium.mu
        adheres = any(isinstance(interaction, Adhere) for interaction in interactions)
        if adheres and models.has_memory:
            raise InputError("a solid with relaxation relaxes where it sticks: adhere does not compute that")
        if adheres and integrator.name == "paper":
            raise InputError("adhere needs the integrator stokes or rosenbrock, not paper")
        # The others may read the viscosity.
        needed = needed_by(models.forces, columns)
        self._columns = needed[0].columns if needed else ()
        # The first of those that change the fluid's gradient, which it reads.
        largest = LargestValues(quadratic=models.has_quadratic)
        n_times = max((m.n_times for m in models.surroundings if isinstance(m, FadingMemory)), default=0)
        given = models.surroundings
        own = (replace(m, n_times=n_times) if isinstance(m, QuadraticSolid) else m for m in given)
        others = (*(in_fluid(m, medium.mu) for m in own), *((Adhesion(),) if adheres else ()))
        around = (*model_of(medium.mu), *needed, largest, *others)
        self.layout = layout = surroundings.with_rows(integrator.layout, around)
        composed = surroundings.compose(around, patches, integrator.inertia)
        # The elastic strain of a sphere without memory is diagonal in its particle frame.
        general = shaped or models.has_memory
        reader = partial(reader_of, columns=columns, inertia=integrator.inertia)
        self.slots: dict[Function, Function] = {
            load_rows: layout.load, save_rows: layout.save, **behind(kernels), **sampling(kernels), **GAPS,
            gap: conform(gap, gap_free if models.touching == "centre" else kernels["gap"]),
            traction: TRACTIONS[models.traction], drag: DRAGS[models.drag],
            **functions_of_solid(material, general, tense), **(DROP if material.liquid else {}),
            sum_of_forces: compose(models.forces, reader), **integrator.slots, **composed.slots,
        }  # fmt: skip
        if (
            material.liquid
            or material.fluid
            or models.has_memory
            or models.has_quadratic
            or models.touching == "centre"
            or not any(interaction.code == REBOUND for interaction in interactions)
        ):
            # Contact moves the centre alone, or ends the motion. A first run need not compile the others.
            for one in (approach, redirect, push_out, find_reactions, apply_reactions):
                self.slots.pop(one, None)
        self.kernels = kernels
        self.switches = integrator.switches._replace(**composed.switches)
        self.table = _patch_table(interactions, medium.mu)
        breaks = any(isinstance(interaction, Adhere) and interaction.breaks for interaction in interactions)
        self.movable = (Status.PENDING, Status.ACTIVE, *((Status.STUCK,) if breaks else ()))
        """Statuses of particles that may move again."""
        g1, g2, g3 = map(float, medium.gravity)
        self.medium = medium._replace(
            # No kernel reads it where it varies.
            mu=np.nan if model_of(medium.mu) else float(medium.mu),
            rho=float(medium.rho),
            gravity=(g1, g2, g3),
            forces=coefficients(models.forces),
            numbers=surroundings.numbers_of(around, patches),
        )
        self.dt, self.start, self.end = dt, start, end
        # Surroundings may change, or draw random numbers, in each tracking step.
        free = integrator.adaptive and models.tolerance < np.inf
        self.stride = models.stride if free and not any(m.each_step for m in around) else 1
        """Longest step in tracking steps; None for any."""
        self.stretch_steps = stretch_of(self.stride)
        """Multiple of steps at which a run may be cut into calls without any change of its results."""
        self.rebounds: list[NDArray[np.float64]] = []
        self._room = _ROOM if models.rebounds else 0
        self._loop: Any = None
        self._layouts: dict[str, Any] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        # Compiled code is not sent; the other process loads it from the cache.
        return Tracker, self._made_of, {"stretch_steps": self.stretch_steps}

    @property
    def options(self) -> tuple[float, ...]:
        """Further arguments of the integrator's loop."""
        if not self.integrator.adaptive:
            return ()
        return self._made_of[0].tolerance, self.stride or self.stretch_steps, self.stretch_steps

    @property
    def changing(self) -> frozenset[str]:
        """Names of the particle arrays that the loop may change."""
        rows = [row for part in self.layout.parts for row in rows_of(type(part)).values()]
        saved = {row.of for row in rows if row.saved} | {"status", "reason", "patch", "host"}
        # Only mirrors change shapes at rest.
        mirrors = MIRROR in self.table.code or any(m.mirrors for m in self._made_of[0].surroundings)
        return frozenset(saved if mirrors else saved - {"F0"})

    def linked(self, flow: object, fields: Any) -> Any:
        """Return the loop for packed arrays of a flow and of fields of the case."""
        layouts = {"flow": getattr(flow, "layout", None), "fields": getattr(fields, "layout", None)}
        # Linking costs as much as some thousands of steps.
        if self._loop is None or layouts != self._layouts:
            self._layouts = layouts
            self._loop = link(self.integrator.track, self.slots, **layouts)
        return self._loop

    @property
    def compiled(self) -> bool:
        """Whether the loop of the last steps is compiled, or in the cache."""
        return self._loop is not None and is_compiled(self._loop)

    def is_compiled(self, flow: object) -> bool:
        """Return True if the loop for the arguments of a flow's kernels is compiled, or in the cache."""
        return is_compiled(self.linked(packed(flow), self._sampled(self._no_fields)))

    def compile(self, flow: object) -> None:
        """Compile the loop for the arguments of a flow's kernels."""
        nothing, flow = np.empty(0, dtype=np.int64), packed(flow)
        scratch = self._scratch(fields=self._sampled(self._no_fields))
        self.linked(flow, scratch.fields)(
            flow, self.table, self.medium, empty(0), nothing, 0, 0, self.dt, self.start, scratch,
            *self.options,
        )  # fmt: skip

    @property
    def _no_fields(self) -> Fields:
        return fields_on(no_mesh(), np.empty((0, width(self._columns))), self._columns)

    def _sampled(self, fields: Fields | None) -> Any:
        """Return the packed arrays of fields of the case that forces need."""
        return packed(fields.arrays if self._columns and fields is not None else ())

    def _scratch(
        self,
        stop: Any = None,
        bounds: LoopLimits = LoopLimits(),  # noqa: B008
        fields: Any = None,
        observation: Observation = Observation(),  # noqa: B008
    ) -> Scratch:
        scratch = new_scratch(self.layout, stop, bounds, self._room, self.switches)
        slack = 2.0 * SHORTEST_STEP * self.dt
        recorder = recorder_of(observation, self.integrator.recorded, self.layout, slack)
        scratch = scratch._replace(recorder=recorder)
        return scratch if fields is None else scratch._replace(fields=fields)

    def advance(
        self,
        flow: object,
        p: Particles,
        step: int,
        steps: int,
        threads: int,
        bounds: LoopLimits = LoopLimits(),  # noqa: B008
        stop: Callable[[], bool] = never,
        fields: Fields | None = None,
        observation: Observation = Observation(),  # noqa: B008
    ) -> Outcome:
        """Advance particles from step ``step`` by ``steps`` steps, in place.

        Parameters
        ----------
        flow
            Arguments of the flow's kernels.
        bounds
            Limits of each particle.
        stop
            Called several times a second; the steps end early if it returns True or a signal's handler
            raises.
        fields
            Fields of the case at the loaded times, if the flow was read with some.
        observation
            Which steps are recorded, and the functions to which they are given.
        """
        last = step + steps
        dt, start = times = self._times(step)
        reached = np.full(p.size, step)
        # After an interrupted call some particles are ahead of others.
        active = p.status == Status.ACTIVE
        reached[active] = np.maximum(step, np.rint((p.t[active] - start) / dt).astype(np.int64))
        outcome = Outcome()
        for end in sorted({*np.unique(reached[(reached > step) & (reached < last)]).tolist(), last}):
            rows = np.flatnonzero(np.isin(p.status, self.movable) & (reached <= step))
            part = self._carry(
                flow, p, rows, (step, end - step), times, threads, bounds, stop, fields, observation
            )
            outcome += part
            if not part.finished:
                break
            step = end
        return outcome

    def _times(self, step: int) -> tuple[float, float]:
        """Return Δt and the time at step 0, s, with which a step ends no later than the last one."""
        dt, begin = self.dt, self.start + step * self.dt
        if begin + dt <= self.end:
            return dt, self.start
        dt = self.end - begin
        return dt, begin - step * dt

    def _carry(
        self,
        flow: object,
        p: Particles,
        rows: NDArray[np.int64],
        steps: tuple[int, int],
        times: tuple[float, float],
        threads: int,
        bounds: LoopLimits,
        stop: Callable[[], bool],
        fields: Fields | None,
        observation: Observation,
    ) -> Outcome:
        """Advance the particles of some rows from a step by a number of steps."""
        halt = np.zeros(1, dtype=np.int64)
        flow, sampled = packed(flow), self._sampled(fields)
        track = self.linked(flow, sampled)

        def work(task: Task) -> Outcome:
            scratch = self._scratch(halt, bounds, sampled, observation)
            mended = 0
            for part in task.parts(self.integrator.adaptive or len(scratch.recorder.tables) == 0):
                going_on = 1
                while going_on:
                    mended += track(flow, self.table, self.medium, p, *part, *times, scratch, *self.options)
                    going_on = scratch.counts[PAUSED]
                    self._observe(observation, scratch, p)
            if scratch.noted[1]:
                self.rebounds.append(scratch.rebounds[: scratch.noted[1]].copy())
            outgrown = scratch.outgrown[0]
            return Outcome(mended, not (outgrown or halt[0]), outgrown == UNLISTED, outgrown == CROWDED)

        # Several tasks per thread, so that a delayed thread leaves some to the others.
        tasks = tasks_of(p, rows, steps, times, _TASKS * threads if threads > 1 else 1)
        # Even a single task runs in another thread: this one handles signals meanwhile.
        with ThreadPoolExecutor(threads) as pool:
            under_way = [pool.submit(work, task) for task in tasks]
            try:
                while wait(under_way, _PATIENCE).not_done:
                    if stop():
                        halt[0] = 1
            except BaseException:
                halt[0] = 1
                raise
        outcome = sum((task.result() for task in under_way), Outcome())
        if outcome.crowded:
            self._room *= _MORE_ROOM
        return outcome

    def _observe(self, observation: Observation, s: Scratch, p: Particles) -> None:
        """Give the recorded steps to the functions of an observation, and empty their tables."""
        count = s.recorder.count
        steps, count[0] = Steps(s.recorder.tables[: count[0]], self.integrator.recorded.in_frame), 0
        if steps.n and observation.store is not None:
            observation.store(steps)
        if steps.n and observation.observe is not None:
            coupled = np.flatnonzero(self.table.code == CYCLIC).tolist()
            steps = steps.divided(s.rebounds[: s.noted[0]], coupled)
            # Those of particles that stay where they began are taken again.
            observation.observe(steps.take(steps.t[1] <= p.t[steps.row]) if interrupted(s) else steps)

    def contact_normals(self, flow: object, p: Particles, rows: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return normals (n, 3) of the walls on which particles ended; NaN where no wall is found."""
        normals = np.empty((len(rows), 3))
        flow = packed(flow)
        layout = getattr(flow, "layout", None)
        link(contact_normals, self.slots, flow=layout)(flow, p, rows, normals)
        return normals

    def take_rebounds(self) -> NDArray[np.float64]:
        """Return the records since the last call, as :func:`foamprb.cloud.contact.in_order` does."""
        records, self.rebounds = self.rebounds, []
        return in_order(records)


class Task(NamedTuple):
    """Particles and steps of one call of the compiled loop."""

    rows: NDArray[np.int64]
    step: int
    steps: int

    def parts(self, whole: bool) -> Iterator[Task]:
        """Yield the same task, or unless it may be ``whole``, parts whose steps of Δt fit into a table."""
        rows, steps = (len(self.rows), self.steps) if whole else (4 * LANES, ROOM // 4)
        for step in range(self.step, self.step + self.steps, max(steps, 1)):
            for first in range(0, len(self.rows), max(rows, 1)):
                count = min(steps, self.step + self.steps - step)
                yield Task(self.rows[first : first + rows], step, count)


def tasks_of(
    p: Particles, rows: NDArray[np.int64], steps: tuple[int, int], times: tuple[float, float], number: int
) -> list[Task]:
    """Divide particles into tasks: first the active, then the pending ones.

    A block takes all steps of its task, whether its particles have appeared or not. Pending particles are
    therefore grouped by the step at which they appear; particles that appear later than the end are left out.

    Parameters
    ----------
    p, rows
        Particles, and the indices of active or pending ones.
    steps
        First step, and number of steps.
    times
        Δt, and the time at step 0, s.
    number
        Number of tasks of active particles, if they fill as many blocks.
    """
    (step, count), (dt, start) = steps, times
    pending = p.status[rows] == Status.PENDING
    active, waiting = rows[~pending], rows[pending]
    tasks = [Task(dealt, step, count) for dealt in _deal(in_blocks(p, active), number)]

    # One step early: the loop computes these times with other round-off.
    due = np.maximum(np.floor((p.t0[waiting] - start) / dt) - 1.0, step)
    coming = due < step + count
    waiting, due = waiting[coming], due[coming]
    order = np.argsort(due, kind="stable")
    blocks = -(-len(waiting) // LANES)
    most = -(-blocks // _GROUPS) * LANES
    for low in range(0, len(waiting), max(most, 1)):
        group = order[low : low + most]
        first = int(due[group[0]])
        tasks.append(Task(in_blocks(p, waiting[group]), first, step + count - first))
    return tasks


def _deal(rows: NDArray[np.int64], number: int) -> list[NDArray[np.int64]]:
    """Deal out blocks of rows in turn to at most ``number`` hands."""
    blocks = -(-len(rows) // LANES)
    missing = blocks * LANES - len(rows)
    padded = np.pad(rows, (0, missing)).reshape(blocks, LANES)
    hands = min(number, blocks)
    shares = [padded[k::hands].ravel() for k in range(hands)]
    if missing:
        last = (blocks - 1) % hands
        shares[last] = shares[last][:-missing]
    return shares


def in_blocks(p: Particles, rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return rows in the order in which particles are put into blocks.

    All lanes of a block take the steps that its most demanding particle needs. Particles are therefore sorted
    by steps per Δt, rounded up to a power of two, the most first; then by the order of their steps; then by
    elongation, which costs iterations of the integrals; then by host, so that the nodes are in the cache.
    """
    effort = np.frexp(p.substeps[rows] * (1.0 - 1e-9))[1]
    # F : F of a body in shear with stretches λ, 1, 1/λ and λ² = COMPACT.
    many = 2 * len(rows) > p.size
    F = p.F if many else p.F[rows]
    elongated = np.einsum("ni,ni->n", F, F) > COMPACT + 1.0 + 1.0 / COMPACT
    elongated = elongated[rows] if many else elongated
    kind = 4 * p.demanding[rows] + 2 * (p.discount[rows] > 0.0) + elongated
    key = (-effort.astype(np.int64) << 35) + (kind.astype(np.int64) << 32) + p.host[rows]
    # A stable sort is not needed, and costs four times as much.
    return rows[np.argsort(key)]


_PATIENCE = 0.1
"""Time between two calls of ``stop``, s."""
_TASKS = 8
"""Tasks of active particles per thread, with several threads."""
_GROUPS = 64
"""Tasks of pending particles: half of the steps of one task are idle."""
_ROOM, _MORE_ROOM = 1000, 4
"""Size of a task's buffer of rebounds, and its growth factor when it is full."""


def check(models: Models, tense: bool) -> None:
    """Raise InputError if the models exclude each other; for ``tense`` see :class:`Tracker`."""
    if models.stride is not None and (not isinstance(models.stride, int | np.integer) or models.stride < 1):
        raise InputError(
            f"the stride is {models.stride}. Allowed: whole numbers of tracking steps, 1 or more"
        )
    integrator = INTEGRATORS[models.integrator]
    reason = integrator.refuses(models.traction, models.material, tense)
    if reason:
        raise InputError(f"the integrator {integrator.name} {reason}")
    kind = MATERIALS[models.material]
    liquid = kind.liquid
    if (liquid or kind.fluid) and integrator.inertia:
        raise InputError(
            f"the shape of a {models.material} has no inertia: it needs the integrator stokes, not "
            f"{integrator.name}"
        )
    if kind.slides and (models.has_memory or models.has_quadratic):
        what = "relaxation" if models.has_memory else "stiffness in the shape model quadratic"
        raise InputError(f"the {what} is unknown for the membrane of a {models.material}")
    for model in models.surroundings:
        # Those that need elasticity refuse vesicles as drops.
        elastic = isinstance(model, BrownianMotion | Fates)
        if reason := model.refuses(integrator, liquid or (kind.fluid and elastic)):
            raise InputError(reason)


def _patch_table(interactions: Sequence[Interaction], mu_f: Any) -> PatchTable:
    rebounds = [
        i if isinstance(i, Rebound) else Rebound(0.0, i.mu) if isinstance(i, Adhere) else Rebound()
        for i in interactions
    ]
    bonds = [i.bond(mu_f) if isinstance(i, Adhere) else NO_BOND for i in interactions]
    return PatchTable(
        code=np.array([i.code for i in interactions], dtype=np.int8),
        e=np.array([r.e for r in rebounds], dtype=float),
        mu=np.array([r.mu for r in rebounds], dtype=float),
        bonds=np.array(bonds, dtype=float).reshape(-1, len(NO_BOND)),
    )
