"""A cloud of particles in a flow: what a run advances."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import DRAGS
from foamprb.body.material import MATERIALS
from foamprb.body.material import finger as finger_of_ellipsoid
from foamprb.body.surface_tension import laplace_stress
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.adaptive import (
    ADAPTIVE_ROWS,
    ADAPTIVE_STAGES,
    end_inertial,
    end_inertialess,
    first_inertial,
    first_inertialess,
    second_inertial,
    second_inertialess,
    track_adaptive,
)
from foamprb.cloud.advance import STAGES, track_block, track_share
from foamprb.cloud.block import LANES, ROWS, Medium, new_scratch
from foamprb.cloud.contact import contact_normals
from foamprb.cloud.motion import RARE, PatchTable, longest_of, reach_end, release
from foamprb.cloud.patches import REBOUND, STICK, Interaction, Rebound
from foamprb.cloud.state import Particles, Status
from foamprb.compile.link import compile_part, is_compiled, link
from foamprb.errors import InputError
from foamprb.flow.analytic import gap_free
from foamprb.flow.base import Flow
from foamprb.flow.walk import LONG

__all__ = ["Cloud", "Crew", "Models", "Still", "Tracker", "available_threads"]

_REACH_MARGIN = 2.0
_ROUND_OFF = 1e-6
"""Share of a step by which it may end after the time until which the flow is ready."""


def available_threads() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


class Loop(NamedTuple):
    """A compiled loop over particles, and what it is made of."""

    entry: Callable[..., int]
    stages: tuple[Callable[..., Any], ...]
    rows: int
    """Rows of a block."""
    adaptive: bool
    bindings: dict[str, Callable[..., Any]]


def _second_order(**slopes: Callable[..., Any]) -> Loop:
    return Loop(track_adaptive, (*ADAPTIVE_STAGES, *slopes.values()), ADAPTIVE_ROWS, True, slopes)


LOOPS: dict[str, Loop] = {
    "paper": Loop(track_block, STAGES, ROWS, False, {}),
    "rosenbrock": _second_order(
        first_slope=first_inertial, second_slope=second_inertial, end_slope=end_inertial
    ),
    "stokes": _second_order(
        first_slope=first_inertialess, second_slope=second_inertialess, end_slope=end_inertialess
    ),
}
"""The integrators of the shape, by the names of :data:`foamprb.body.imex.INTEGRATORS`."""


@dataclass(frozen=True)
class Models:
    """Names of the models that a cloud selects, from the registries of :mod:`foamprb.body`."""

    traction: str = "roscoe"
    drag: str = "oberbeck"
    material: str = "neoHooke"
    touching: Literal["ellipsoid", "centre"] = "ellipsoid"
    integrator: str = "paper"
    tolerance: float = 1e-4
    """Largest error of a step of the second-order integrators; infinite for steps of fixed size."""


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
    ) -> None:
        self._made_of = models, kernels, medium, interactions, dt, start, shaped, tense
        bindings = dict(kernels)
        if models.touching == "centre":
            bindings["gap"] = gap_free
        bindings["traction"] = TRACTIONS[models.traction]
        bindings["drag"] = DRAGS[models.drag]
        material = MATERIALS[models.material]
        bindings["derivatives"] = material.derivatives
        if material.dilation is not None:
            bindings["dilation"] = material.dilation
        if shaped:
            bindings["finger"] = finger_of_ellipsoid
        if tense:
            bindings["interface"] = laplace_stress
        self.loop = loop = LOOPS[models.integrator]
        bindings.update(loop.bindings)
        self.kernels, self.bindings = kernels, bindings
        self.separate: tuple[Callable[..., Any], ...] = (*loop.stages, *RARE, *LONG)
        self.table = _patch_table(interactions)
        self.medium, self.dt, self.start = medium, dt, start
        self.options = (models.tolerance,) if loop.adaptive else ()
        self._track = link(track_share, {**bindings, "track": loop.entry}, self.separate)

    def __reduce__(self) -> tuple[Any, ...]:
        # Another process compiles for itself.
        return Tracker, self._made_of

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled already."""
        return is_compiled(self._track)

    def compile_moves(self, flow: Any) -> None:
        """Compile what comes after the stages in each step, with what the flow's kernels read."""
        self._compile((release, reach_end), {"flow": flow})

    def compile_stages(self) -> None:
        """Compile the second half of the stages.

        With it, and with what reads a flow, there is about as much to compile as without it in the loop.
        """
        stages = self.loop.stages
        self._compile(stages[len(stages) // 2 :], {})

    def _compile(self, functions: Iterable[Callable[..., Any]], arguments: dict[str, Any]) -> None:
        scratch, vector = new_scratch(self.loop.rows), (0.0, 0.0, 0.0)
        arguments |= {"patches": self.table, "medium": self.medium, "s": scratch, "block": scratch.block}
        arguments |= {"M": scratch.matrix, "i": np.int64(0), "goal": vector}
        arguments |= dict.fromkeys(("tolerance", "allowed", "t_end", "h"), 0.0)
        for function in functions:
            compile_part(function, arguments, self.bindings, self.separate)

    def advance(self, flow: Any, p: Particles, step: int, steps: int, threads: int) -> int:
        """Carry particles from step ``step`` through ``steps`` steps, in place.

        Parameters
        ----------
        flow
            What the flow's kernels read.

        Returns
        -------
        The number of walks that failed and were mended by the tree.
        """
        rows = np.flatnonzero((p.status == Status.PENDING) | (p.status == Status.ACTIVE))
        # Neighbours in the mesh share a block, so that the nodes they read are in the cache.
        place = (p.status[rows].astype(np.int64) << 32) + p.host[rows]
        rows = rows[np.argsort(place, kind="stable")]

        def work(first: int) -> int:
            scratch = new_scratch(self.loop.rows)
            mended: int = self._track(
                flow, self.table, self.medium, p, rows, first, shares,
                step, steps, self.dt, self.start, scratch, self.options,
            )  # fmt: skip
            return mended

        blocks = -(-len(rows) // LANES)
        # A thread that is held up leaves the shares that it has not begun to others.
        shares = max(1, min(_SHARES * threads if threads > 1 else 1, blocks))
        if shares == 1:
            return work(0)
        with ThreadPoolExecutor(threads) as pool:
            return sum(pool.map(work, range(shares)))


_SHARES = 8
"""Of the particles, for each of several threads."""
AT_ONCE = 20_000_000
"""Steps of a particle that threads take in some seconds; to take up its state and put it down costs a few."""


class Crew(Protocol):
    """Who carries the particles of a cloud through their steps, and knows the state of each until asked."""

    at_once: int
    """Number of steps of a particle that it takes in a second or so."""

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled."""

    def begin(self, prepare: Callable[[], tuple[Any, int]]) -> None:
        """Begin with steps while the cloud's arrays stay as they are or are gathered, if that can be done.

        ``prepare`` gives what the flow's kernels read, and the number of steps. The next :meth:`advance`
        takes these steps if it asks for as many; else they are as if they had never been begun.
        """

    def advance(self, flow: Any, steps: int) -> int:
        """Take steps with what the flow's kernels read; return the number of walks mended by the tree."""

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status."""

    def longest(self) -> float:
        """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""

    def gather(self) -> None:
        """Put the state of every particle into the cloud's arrays."""


class _Threads:
    """The crew of a cloud by itself: the threads of this process, in the cloud's own arrays."""

    at_once = AT_ONCE

    def __init__(self, cloud: Cloud) -> None:
        self._cloud = cloud

    @property
    def compiled(self) -> bool:
        return self._cloud.tracker.compiled

    def begin(self, prepare: Callable[[], tuple[Any, int]]) -> None:
        """They would take the time from what is done meanwhile."""

    def advance(self, flow: Any, steps: int) -> int:
        cloud = self._cloud
        return cloud.tracker.advance(flow, cloud.particles, cloud.step, steps, cloud.threads)

    def counts(self) -> dict[Status, int]:
        return self._cloud.particles.counts()

    def longest(self) -> float:
        return longest_semi_axis(self._cloud.particles)

    def gather(self) -> None:
        """They are there."""


class Still(NamedTuple):
    """A :class:`Cloud` as it was at one moment, whatever has become of it since."""

    particles: Particles
    flow: Flow
    time: float
    step: int
    recovered: int
    reach: float


@dataclass
class Cloud:
    """Particles, the flow that carries them, and the models that act on them.

    Parameters
    ----------
    particles
        The state; :meth:`advance` changes it in place.
    flow
        Any :class:`~foamprb.flow.base.Flow`.
    medium
        The fluid's viscosity (Pa s) and density (kg/m³), and gravity (m/s²).
    interactions
        What each of the flow's patches does, in their order.
    dt
        Tracking step Δt, s. Step n goes from start + n Δt to start + (n + 1) Δt.
    models
        Names of traction, drag, material and wall test.
    threads
        Number of threads; the answer does not depend on it.
    step
        Number of steps done.
    start
        Time at step 0, on the axis of the flow's and the injections' times, s.
    recovered
        Number of walks so far that failed and were mended by the tree.
    reach
        Distance, m, to which walls are listed: it grows with the longest particle so far, and is a part of
        the state, as a step that ends on a wall may depend on whether the wall was listed before.

    Raises
    ------
    InputError
        If a particle without a host lies outside the flow, or the models do not go together.
    ValueError
        If there is not one interaction for each patch.
    """

    particles: Particles
    flow: Flow
    medium: Medium
    interactions: Sequence[Interaction]
    dt: float
    models: Models = field(default_factory=Models)
    threads: int = field(default_factory=available_threads)
    step: int = 0
    recovered: int = 0
    start: float = 0.0
    reach: float = 0.0

    def __post_init__(self) -> None:
        if len(self.interactions) != len(self.flow.patches):
            raise ValueError(f"{len(self.interactions)} interactions for {len(self.flow.patches)} patches")
        _check(self.models)
        _refuse_early(self.particles, self.start)
        _find_hosts(self.particles, self.flow)
        p = self.particles
        tense = bool((p.gamma != 0.0).any())
        if tense:
            _refuse_tension(self.models)
        self.tracker = Tracker(
            self.models,
            self.flow.kernels,
            self.medium,
            self.interactions,
            self.dt,
            self.start,
            shaped=bool((np.eye(3).ravel() != p.F0).any()),
            tense=tense,
        )
        self.crew: Crew = _Threads(self)

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled; if not, the first :meth:`advance` takes some seconds to do it."""
        return self.crew.compiled

    @property
    def time(self) -> float:
        """Time to which the cloud has come, s."""
        return self.start + self.step * self.dt

    def advance(self, steps: int) -> None:
        """Take ``steps`` time steps, whatever becomes of single particles.

        Where others than this process' own threads carry the particles, :meth:`gather` brings the result.

        Raises
        ------
        InputError
            If the flow ends before, or cannot be read; the steps so far are done.
        """
        last = self.step + steps
        while self.step < last:
            flow, ready = self._prepare(last - self.step)
            self.recovered += self.crew.advance(flow, ready)
            self.step += ready

    def begin(self, steps: int) -> None:
        """Let the crew begin with steps while this process does something else, if it is one that can.

        Until :meth:`advance` is called with the same number nothing is seen of them, and when it is called
        with another they are dropped.
        """
        self.crew.begin(lambda: self._prepare(steps))

    def _prepare(self, steps: int) -> tuple[Any, int]:
        """Make the flow ready for as many steps as it can be, of ``steps``: its arrays, and how many."""
        until = self.flow.load(self.time, self.start + (self.step + 1) * self.dt)
        ready = (until - self.time) / self.dt + _ROUND_OFF
        self._grow_reach()
        return self.flow_arrays(), steps if ready > steps else max(1, int(ready))

    def hand_over(self, crew: Crew) -> None:
        """Let others carry the particles, which know them and the flow."""
        self.crew = crew

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status, whether they were gathered or not."""
        return self.crew.counts()

    def gather(self) -> None:
        """Make sure that :attr:`particles` are as they were left by the last step."""
        self.crew.gather()

    def still(self, before: Still | None = None) -> Still:
        """A copy of what will change.

        Parameters
        ----------
        before
            An earlier copy that nobody needs any more, whose memory is used again.
        """
        particles = self.particles.copy_changing(None if before is None else before.particles)
        return Still(particles, self.flow, self.time, self.step, self.recovered, self.reach)

    def contact_normals(self, rows: NDArray[np.int64]) -> NDArray[np.float64]:
        """Unit normals, into the fluid, of the patches on which particles ended, (n, 3); NaN if not found."""
        bindings = dict(self.flow.kernels)
        if self.models.touching == "centre":
            bindings["gap"] = gap_free
        normals = np.empty((len(rows), 3))
        self._grow_reach()
        link(contact_normals, bindings)(self.flow_arrays(), self.particles, rows, normals)
        return normals

    def flow_arrays(self) -> Any:
        """What the flow's kernels read, with walls listed to :attr:`reach`."""
        touchable = [i for i, action in enumerate(self.interactions) if action.code in (STICK, REBOUND)]
        return self.flow.arrays(self.reach, [] if self.models.touching == "centre" else touchable)

    def make_ready(self) -> None:
        """Do what the first step wants done of the flow, and would do."""
        self._grow_reach()
        self.flow_arrays()

    def _grow_reach(self) -> None:
        """Let the reach be well beyond the longest particle."""
        longest = self.crew.longest()
        if longest * _REACH_MARGIN > self.reach:
            self.reach = 2.0 * _REACH_MARGIN * longest


def _check(models: Models) -> None:
    """Raise InputError if the models do not go together."""
    material = MATERIALS[models.material]
    if models.integrator == "stokes" and models.traction != "roscoe":
        raise InputError(f"the integrator stokes needs the traction roscoe, not {models.traction}")
    if models.integrator == "stokes" and not material.isochoric:
        raise InputError(f"the integrator stokes takes no {models.material}: it has no incompressible form")
    if models.integrator == "paper" and material.dilation is None:
        raise InputError(f"the integrator paper takes no {models.material}: choose rosenbrock or stokes")


def _refuse_tension(models: Models) -> None:
    if models.integrator == "paper":
        raise InputError("the integrator paper takes no surfaceTension: choose rosenbrock or stokes")


def _refuse_early(p: Particles, start: float) -> None:
    early = np.flatnonzero((p.status == Status.PENDING) & (p.t0 < start))
    if len(early):
        raise InputError(
            f"{len(early)} of {p.size} particles would appear before the start of the run at {start:g} s, "
            f"the first at {p.t0[early].min():g} s"
        )


def _find_hosts(p: Particles, flow: Flow) -> None:
    homeless = np.flatnonzero((p.host < 0) & (p.status <= Status.ACTIVE))
    if len(homeless) == 0:
        return
    p.host[homeless] = flow.locate(p.x[homeless])
    outside = homeless[p.host[homeless] < 0]
    if len(outside):
        first = ", ".join("({:g} {:g} {:g})".format(*x) for x in p.x[outside[:3]])
        raise InputError(f"{len(outside)} of {p.size} particles lie outside the flow: {first}")


def longest_semi_axis(p: Particles) -> float:
    """Longest semi-axis of the particles that move or will, m, or a little more; 0 without any."""
    return float(link(longest_of)(p))


def _patch_table(interactions: Sequence[Interaction]) -> PatchTable:
    rebounds = [i if isinstance(i, Rebound) else Rebound() for i in interactions]
    return PatchTable(
        np.array([i.code for i in interactions], dtype=np.int8),
        np.array([r.e for r in rebounds], dtype=float),
        np.array([r.mu for r in rebounds], dtype=float),
    )
