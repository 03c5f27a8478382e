"""A cloud of particles in a flow: what a run advances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import Medium
from foamprb.cloud.contact import contact_normals
from foamprb.cloud.executor import Executor, Threads, available_threads
from foamprb.cloud.patches import REBOUND, STICK, Interaction
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.tracker import Models, Tracker, check
from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.analytic import gap_free
from foamprb.flow.base import Flow

__all__ = ["Cloud", "Snapshot"]

_REACH_MARGIN = 2.0
_ROUND_OFF = 1e-6
"""Share of a step by which it may end after the time until which the flow is ready."""


class Snapshot(NamedTuple):
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
        p = self.particles
        tense = bool((p.gamma != 0.0).any())
        check(self.models, tense)
        for model in self.models.surroundings:
            model.check(self.flow.patches)
        _refuse_early(p, self.start)
        _find_hosts(p, self.flow)
        self.tracker = Tracker(
            self.models,
            self.flow.kernels,
            self.medium,
            self.interactions,
            self.dt,
            self.start,
            shaped=bool((np.eye(3).ravel() != p.F0).any()),
            tense=tense,
            patches=self.flow.patches,
        )
        self.executor: Executor = Threads()
        self.executor.take(self)

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled; if not, the first :meth:`advance` takes some seconds to do it."""
        return self.executor.compiled

    @property
    def time(self) -> float:
        """Time to which the cloud has come, s."""
        return self.start + self.step * self.dt

    def advance(self, steps: int) -> None:
        """Take ``steps`` time steps, whatever becomes of single particles.

        Where another executor than this process' threads carries the particles, :meth:`gather` brings the
        result.

        Raises
        ------
        InputError
            If the flow ends before, or cannot be read; the steps so far are done.
        """
        last = self.step + steps
        while self.step < last:
            flow, ready = self.load_flow(last - self.step)
            self.recovered += self.executor.advance(flow, ready)
            self.step += ready

    def begin(self, steps: int) -> None:
        """Let the executor begin with steps while this process does something else, if it is one that can.

        Until :meth:`advance` is called with the same number nothing is seen of them, and when it is called
        with another they are dropped.
        """
        self.executor.begin(steps)

    def load_flow(self, steps: int) -> tuple[Any, int]:
        """Make the flow ready for the next ``steps`` steps, or for as many of them as it can be.

        Returns
        -------
        What the flow's kernels read, and the number of steps, at least 1.

        Raises
        ------
        InputError
            If the flow ends before, or cannot be read.
        """
        until = self.flow.load(self.time, self.start + (self.step + 1) * self.dt)
        ready = (until - self.time) / self.dt + _ROUND_OFF
        self._grow_reach()
        return self.flow_arrays(), steps if ready > steps else max(1, int(ready))

    def hand_over(self, executor: Executor) -> None:
        """Let an executor carry the particles from now on."""
        self.gather()
        executor.take(self)
        self.executor = executor

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status, whether they were gathered or not."""
        return self.executor.counts()

    def gather(self) -> None:
        """Make sure that :attr:`particles` are as they were left by the last step."""
        self.executor.gather()

    def snapshot(self, before: Snapshot | None = None) -> Snapshot:
        """A copy of what will change.

        Parameters
        ----------
        before
            An earlier copy that nobody needs any more, whose memory is used again.
        """
        particles = self.particles.copy_changing(None if before is None else before.particles)
        return Snapshot(particles, self.flow, self.time, self.step, self.recovered, self.reach)

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
        unseen = self.models.touching == "centre" and self._wanted_reach == 0.0
        return self.flow.arrays(self.reach, [] if unseen else touchable)

    def make_ready(self) -> None:
        """Do what the first step wants done of the flow, and would do."""
        self._grow_reach()
        self.flow_arrays()

    def _grow_reach(self) -> None:
        """Let the reach be well beyond the longest particle."""
        longest = self.executor.longest()
        if longest * max(_REACH_MARGIN, self._wanted_reach) > self.reach:
            self.reach = max(2.0 * _REACH_MARGIN, 1.25 * self._wanted_reach) * longest

    @property
    def _wanted_reach(self) -> float:
        """Distance to which models want walls to be listed, in radii."""
        return max((model.reach for model in self.models.surroundings), default=0.0)


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
