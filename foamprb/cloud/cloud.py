"""A cloud of particles in a flow, and the stepper that advances it."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.compressibility import limited_lame
from foamprb.body.material import MATERIALS
from foamprb.body.membrane import LARGEST_STRETCH
from foamprb.body.tensor import longest_stretch
from foamprb.cloud.block import Medium
from foamprb.cloud.communicator import (
    Communicator,
    Value,
    applied,
    count_at,
    in_flow,
    normals_at,
    particles_of,
    same,
    store_at,
    take_rebounds,
    values_of,
)
from foamprb.cloud.contact import GAPS, gap, gaps_of, in_order
from foamprb.cloud.instants import PREFIX, READ, Moments
from foamprb.cloud.integrators.adaptive import stretch_in
from foamprb.cloud.integrators.paper import PAPER
from foamprb.cloud.integrators.registry import INTEGRATORS, automatic
from foamprb.cloud.limits import Limits, LoopLimits
from foamprb.cloud.measures import as_slice, path_stokes_number, shape_stokes_number, shear_rate_at
from foamprb.cloud.motion import SEEN, longest_of
from foamprb.cloud.needs import check_needs
from foamprb.cloud.patches import CYCLIC, Interaction, stopping
from foamprb.cloud.stability import unstable, warning_of
from foamprb.cloud.state import REASONS, Particles, Reason, Status, concatenate
from foamprb.cloud.surroundings.base import Survey
from foamprb.cloud.surroundings.memory import FadingMemory
from foamprb.cloud.tracker import Models, Tracker, available_threads, check, never
from foamprb.cloud.viscosity import medium_at, model_of, viscosity_at_rate
from foamprb.compile.link import conform, link, packed
from foamprb.errors import FailedParticlesWarning, InputError, ValidityWarning
from foamprb.flow.base import Floats, Flow
from foamprb.flow.fields import columns_of
from foamprb.flow.nodes import NodeValues

_REACH_MARGIN, _REACH_GROWTH = 1.25, 1.5
_REACH_IN_CELLS = 0.3
"""Least reach of lists of walls over the width of a cell at these walls."""
_FIRST_CHECK = 4
"""Steps before the stability of ``paper`` is first checked; it is again whenever they have doubled."""
_ROUND_OFF = 1e-6
"""Share of a step by which it may end after the time until which the flow is ready."""


class Snapshot(NamedTuple):
    """Copy of a :class:`Cloud` at one time."""

    particles: Particles
    flow: Flow
    time: float
    step: int
    recovered: int
    reach: float
    stretch_steps: int


@dataclass
class Cloud:
    """Particles, the flow that carries them, and the models that act on them.

    Parameters
    ----------
    particles
        The state; :meth:`advance` changes it in place. Of several processes, that of the first one until the
        first step.
    flow
        Any :class:`~foamprb.flow.base.Flow`.
    medium
        The fluid's viscosity (Pa s, or a model of :mod:`foamprb.cloud.viscosity`) and density (kg/m³), and
        gravity (m/s²).
    interactions
        Interactions of the flow's patches, in their order.
    dt
        Tracking step Δt, s. Step n goes from start + n Δt to start + (n + 1) Δt.
    models
        Names of traction, drag, material and wall test.
    threads
        Number of threads; results do not depend on it.
    step
        Number of steps done.
    start
        Time at step 0, on the axis of the flow's and the injections' times, s.
    recovered
        Number of failed walks so far that a tree search repaired.
    reach
        Distance, m, to which walls are listed: it grows with the longest particle so far.
    limits
        Limits of each particle.
    decoupled
        Names of coupled patches with other interactions than ``Cyclic``.
    comm
        The processes that hold the particles; by default this one alone.
    end
        Time at which the last step ends, s. It is shorter than Δt if this is no multiple of Δt.
    late
        Number of further particles that never appear before the end, and are not stored.

    Raises
    ------
    InputError
        If a coupled patch has another interaction than ``Cyclic``.
        If a particle without a host lies outside the flow, one is larger than the limits allow in it, or the
        models do not go together.
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
    limits: Limits = field(default_factory=Limits)
    decoupled: Collection[str] = ()
    comm: Communicator = field(default_factory=Communicator)
    end: float = math.inf
    late: int = 0

    def __post_init__(self) -> None:
        if len(self.interactions) != len(self.flow.patches):
            raise ValueError(f"{len(self.interactions)} interactions for {len(self.flow.patches)} patches")
        for patch, interaction in zip(self.flow.patches, self.interactions, strict=True):
            if patch.neighbour and interaction.code != CYCLIC and patch.name not in self.decoupled:
                raise InputError(
                    f"the patch {patch.name} is coupled with {patch.neighbour}, where particles continue, "
                    f"and has the interaction {type(interaction).__name__}: use foamprb.patch_interactions, "
                    "or name it in decoupled"
                )
        self.comm.adopt(self.particles)
        self.map_ranks(_refuse_mixture, self.models.material)
        tense = any(self.map_ranks(_is_tense))
        self.map_ranks(_refuse_extreme, self.medium)
        self._refuse_early()
        find_hosts(self.particles, self.flow)
        if self.step == 0:
            self._limit_bulk_moduli()
        self.stokes_numbers: tuple[float, float] | None = None
        """Largest of the shape and of the path, if the integrator follows from them."""
        if self.models.integrator == "auto":
            self.stokes_numbers = self._find_stokes_numbers()
            integrator = automatic(max(self.stokes_numbers), self.models.material)
            self.models = replace(self.models, integrator=integrator)
        self._add_memory()
        check(self.models, tense)
        check_needs(self.models.forces, columns_of(self.flow))
        around = (*model_of(self.medium.mu), *self.models.surroundings)
        for model in around:
            model.walls(self.flow.patches)
            for kernel in model.kernels:
                if kernel not in self.flow.kernels:
                    raise InputError(f"{type(model).__name__} needs {kernel}, which this flow does not have")
        self.map_ranks(_begin, around)
        self._warned: set[str] = set()
        self._next_check = self.step + _FIRST_CHECK
        self._reach_grows = True
        self._largest = max(self.map_ranks(_largest_radius))
        self._refuse_large()
        self.tracker = Tracker(
            self.models,
            self.flow.kernels,
            self.medium,
            self.interactions,
            self.dt,
            self.start,
            shaped=any(self.map_ranks(is_shaped)),
            tense=tense,
            patches=self.flow.patches,
            columns=columns_of(self.flow),
            end=self.end,
        )
        if self.tracker.stride is None:
            self.tracker.stretch_steps = stretch_in(self._rate_of_change(), self.dt)
        self.comm.rank.tracker = self.tracker

    def _add_memory(self) -> None:
        """Add the memory of the solid to the models, if the particles have relaxation times."""
        n_times = max(self.map_ranks(_number_of_times))
        models = self.models
        if n_times and not any(isinstance(model, FadingMemory) for model in models.surroundings):
            memory = FadingMemory(n_times=n_times, power_law=MATERIALS[models.material].power_law)
            self.models = replace(models, surroundings=(memory, *models.surroundings))

    @property
    def stretch_steps(self) -> int:
        """Multiple of steps at which calls change no results."""
        return self.tracker.stretch_steps

    @property
    def size(self) -> int:
        """Number of particles, on all ranks."""
        return self.comm.n_particles

    def map_ranks(self, function: Callable[..., Value], *arguments: object) -> list[Value]:
        """Apply a function to the particles of each rank, in any order, and the arguments."""
        return self.comm.call(applied, function, None, *arguments)

    def map_by_id(self, function: Callable[..., Value], *arguments: object) -> Iterator[Value]:
        """Apply a function to blocks of particles sorted by number, and the arguments.

        A cloud without particles has one block.
        """
        return self.comm.map_by_id(function, *arguments)

    def map_in_flow(self, function: Callable[..., Value], *arguments: object) -> list[Value]:
        """Apply a function to the particles of each rank, the flow around them, the time (s), and others."""
        self.publish()
        return self.comm.call(in_flow, function, self.time, *arguments)

    def publish(self, time: float | None = None) -> None:
        """Give all ranks the flow at a time, s, by default the present one."""
        time = self.time if time is None else time
        self.flow.load(time, time)
        self.comm.publish(self.flow_arrays(), self.flow)

    def of(self, numbers: NDArray[np.int64]) -> Particles:
        """Return particles by their numbers, in this order."""
        sought, order = np.unique(numbers, return_inverse=True)
        particles = concatenate(self.comm.call(particles_of, sought))
        return particles.take(np.argsort(particles.number)[order])

    def values_of(self, numbers: NDArray[np.int64], name: str) -> NDArray[Any]:
        """Return one array of particles by their numbers, in this order."""
        return self._joined(numbers, self.comm.call(values_of, np.unique(numbers), name))

    def _joined(self, numbers: NDArray[np.int64], by_rank: Sequence[Any]) -> NDArray[Any]:
        """Join numbers and values of each rank; return the values in the order of ``numbers``."""
        owned, values = (np.concatenate(parts) for parts in zip(*by_rank, strict=True))
        order = np.argsort(owned)
        return np.asarray(values[order[np.searchsorted(owned, numbers, sorter=order)]])

    def all_particles(self) -> Particles:
        """Return all particles, which takes the memory of the whole cloud if there are several ranks."""
        return self.particles if self.comm.size == 1 else concatenate(self.map_by_id(same))

    def counts(self) -> dict[Status, int]:
        """Return the number of particles of each status, with those that are not stored."""
        counts = self.comm.counts()
        return {**counts, Status.PENDING: counts[Status.PENDING] + self.late}

    @property
    def time(self) -> float:
        """Time after the last step, s."""
        return self.time_of(self.step)

    def time_of(self, step: int) -> float:
        """Return the time after a number of steps, s."""
        return min(self.start + step * self.dt, self.end)

    def store_at(self, times: Sequence[float], with_rates: bool = False) -> None:
        """Let the next steps store the state at some instants, s, see :mod:`foamprb.cloud.instants`.

        Parameters
        ----------
        times
            Rising times.
        with_rates
            Whether dF/dt is needed there.
        """
        more = (name for name in READ if name in self.tracker.changing and (with_rates or name != "A"))
        self.comm.call(store_at, Moments(tuple(times), tuple(more)))

    @property
    def stored(self) -> Mapping[str, NDArray[Any]]:
        """States at instants that the first rank writes to checkpoints, by their names."""
        return {name: a for name, a in self.comm.arrays_here().items() if name.startswith(PREFIX)}

    def counts_at(self, time: float) -> dict[Status, int]:
        """Return the number of particles of each status at an instant of the last steps, s, or now."""
        return dict(zip(Status, np.sum(self.comm.call(count_at, time), axis=0).tolist(), strict=True))

    @property
    def last_end(self) -> float:
        """Time to which the particles have come that were released, the latest, s; the start without any."""
        return max(self.start, *self.map_ranks(_last_end))

    @property
    def medium_there(self) -> Medium:
        """Medium with the viscosity at each particle, (n,), if it varies."""
        return medium_at(self.medium, self.flow, self.particles, self.time)

    def advance(self, steps: int) -> None:
        """Take ``steps`` time steps with the threads of this process.

        A :class:`~foamprb.errors.FailedParticlesWarning` reports failed particles; the others continue. A
        :class:`~foamprb.errors.ValidityWarning` reports, once, that steps are too long for a model of the
        surroundings or for the integrator ``paper``. After Ctrl-C the cloud can be advanced further.

        Raises
        ------
        InputError
            If the flow ends before, or cannot be read; earlier steps are kept.
        """
        p = self.particles
        before = p.counts()[Status.FAILED]
        medium = self.medium_there if self.models.surroundings else self.medium
        survey = Survey(p, self.flow, medium, self.dt)
        for model in self.models.surroundings:
            self._warn_once(type(model).__name__, model.remarks(survey).long_step)
        end, reached = self.step + steps, -1
        while reached < self.step < end:
            reached = self.step
            checks = self.models.integrator == PAPER.name and PAPER.name not in self._warned
            Stepper(self).advance(min(end, self._next_check if checks else end) - reached)
            if checks and self.step >= self._next_check:
                # A shape beyond the limit oscillates, and is at times within it.
                self._next_check = self.step + max(self.step, _FIRST_CHECK)
                unstable_steps = unstable(p, self.medium_there.mu, self.dt, self.models.material)
                self._warn_once(PAPER.name, warning_of(*unstable_steps, self.dt))
        failed = p.counts()[Status.FAILED] - before
        if failed:
            k = int(np.flatnonzero(p.status == Status.FAILED)[-1])
            warnings.warn(
                f"{failed} of {p.size} particles failed until t = {self.time:g} s; particle {k}, at "
                f"t = {p.t[k]:g} s: {explain(p.reason[k], self.models, self.limits)}.",
                FailedParticlesWarning,
                stacklevel=2,
            )

    def _warn_once(self, subject: str, text: str) -> None:
        """Warn about a subject from :meth:`advance`, if there is a text and there was none before."""
        if text and subject not in self._warned:
            self._warned.add(subject)
            warnings.warn(text, ValidityWarning, stacklevel=3)

    @property
    def bounds(self) -> LoopLimits:
        """Limits of the compiled loop, and the distance to which walls are listed."""
        limits = self.limits
        length = limits.maxSize * self.flow.width
        listed = self.flow.lists_walls and bool(self._touchable)
        reach = self.reach if listed else np.inf
        return LoopLimits(
            limits.maxStretch, length, float(limits.maxSubSteps), reach, self._reach_grows,
            limits.maxCells, self.models.roughness_share * self.roughness,
        )  # fmt: skip

    @property
    def roughness(self) -> float:
        """Roughness of the loaded flow, if it limits the tolerance of steps; else 0."""
        adaptive = INTEGRATORS[self.models.integrator].adaptive and self.models.roughness_share > 0.0
        return self.flow.roughness() if adaptive else 0.0

    @property
    def tolerance(self) -> float:
        """Largest error of a step in the loaded flow."""
        return max(self.models.tolerance, self.bounds.tolerance)

    def load_flow(self, steps: int) -> tuple[Any, int]:
        """Prepare the flow for the next ``steps`` steps, or as many as its loaded times cover.

        See :meth:`foamprb.flow.base.Flow.load` for its errors.

        Returns
        -------
        The arguments of the flow's kernels, and the number of steps, at least 1.
        """
        until = self.flow.load(self.time, self.time_of(self.step + 1))
        ready = (until - self.time) / self.dt + _ROUND_OFF
        # The last step may be shorter, and is a call of its own.
        steps = min(steps, max(1, self.most_steps - 1 - self.step))
        self._grow_reach()
        return self.flow_arrays(), steps if ready > steps else max(1, int(ready))

    def steps_before(self, t: float) -> int:
        """Return the number of steps that end before a time, s, from the start."""
        return math.ceil((t - self.start) / self.dt - _ROUND_OFF) - 1

    @property
    def most_steps(self) -> int:
        """Number of steps from the start to the end."""
        steps = (self.end - self.start) / self.dt
        return max(1, math.ceil(steps - _ROUND_OFF)) if math.isfinite(steps) else sys.maxsize

    def take_rebounds(self) -> NDArray[np.float64]:
        """Return the rebounds and passages since the last call, if the models have ``rebounds``.

        Returns
        -------
        A row for each, in the order of their times; see :func:`foamprb.cloud.contact.rebounds_of`.
        """
        return in_order(self.comm.call(take_rebounds))

    def snapshot(self, before: Snapshot | None = None) -> Snapshot:
        """Return a copy of the arrays that steps change, and the other arrays themselves.

        Parameters
        ----------
        before
            An earlier copy whose memory is overwritten.
        """
        into = None if before is None else before.particles
        particles = self.particles.copy_changing(into, self.tracker.changing, self.threads)
        return Snapshot(
            particles, self.flow, self.time, self.step, self.recovered, self.reach, self.stretch_steps
        )

    def contact_normals(self, p: Particles) -> NDArray[np.float64]:
        """Return unit normals, into the fluid, of the walls on which particles of the cloud ended.

        Returns
        -------
        Normals, (n, 3); NaN where no wall is found.
        """
        self._grow_reach()
        self.publish()
        return self._joined(p.number, self.comm.call(normals_at, np.unique(p.number)))

    def flow_arrays(self) -> Any:
        """Return the arguments of the flow's kernels, with walls within :attr:`reach` or a model's range."""
        sight, seen = self._sight
        return self.flow.arrays(self.reach, self._touchable, sight, seen)

    @property
    def _touchable(self) -> list[int]:
        """Indices of the patches that a body may touch."""
        return [] if self.models.touching == "centre" else stopping(self.interactions)

    @property
    def _sight(self) -> tuple[float, list[int]]:
        """Range within which models need walls, m, and the indices of their patches."""
        ranges = [model.walls(self.flow.patches) for model in self.models.surroundings]
        seen = {index for _, patches in ranges for index in patches}
        radii = max((radii for radii, _ in ranges), default=0.0)
        return radii * self._largest, [i for i in stopping(self.interactions) if i in seen]

    def make_ready(self) -> Any:
        """Prepare the flow for the first step; return the arguments of its kernels."""
        self._grow_reach()
        return self.flow_arrays()

    def _grow_reach(self) -> None:
        """Set the reach at the start beyond the range of the longest particle, and to a share of a cell."""
        if self.reach == 0.0:
            reach = max(self.map_ranks(first_reach))
            # Such lists are hardly longer, and hold while bodies stretch.
            self.reach = max(reach, _REACH_IN_CELLS * self.flow.cell_size_at(self._touchable))

    def extend_reach(self) -> None:
        """List walls farther away, unless the lists would be too long: then bodies that need it fail."""
        before, self.reach = self.reach, _REACH_GROWTH * self.reach
        try:
            self.flow_arrays()
        except InputError:
            self.reach, self._reach_grows = before, False

    def _refuse_large(self) -> None:
        """Raise InputError if a particle that has not ended is larger than the flow is wide."""
        most = self.bounds.maxLength
        numbers, lengths = map(np.concatenate, zip(*self.map_ranks(_longer_than, most), strict=True))
        if len(numbers):
            raise InputError(
                f"{len(numbers)} of {self.size} particles are too large for the flow, which is "
                f"{self.flow.width:g} m wide: the longest semi-axis of particle {numbers[0]} is "
                f"{lengths[0]:g} m. Allowed: up to {most:g} m, maxSize = {self.limits.maxSize:g} "
                "times the width; are diameters in m"
            )

    def _refuse_early(self) -> None:
        """Raise InputError if a particle would appear before the start."""
        early = np.concatenate(self.map_ranks(_released_before, self.start))
        if len(early):
            raise InputError(
                f"{len(early)} of {self.size} particles would appear before the start of the run at "
                f"{self.start:g} s, the first at {early.min():g} s"
            )

    def _rate_of_change(self) -> float:
        """Return the largest velocity gradient at the flow's nodes, or 2 U/L if larger, 1/s; 0 without nodes.

        U is the largest velocity, L the longest edge of the box around the flow.
        """
        ends = self.flow.ends_at_nodes(_speeds_and_gradients)
        if not ends:
            return 0.0
        (_, speed), (_, gradient) = ends
        low, high = self.flow.bounds
        return max(gradient, 2.0 * speed / float((high - low).max()))

    def _find_stokes_numbers(self) -> tuple[float, float]:
        """Return the largest Stokes numbers of shape and path of the particles that have not ended."""
        pairs = [(0.0, 0.0)]
        for moving in self.map_by_id(_moving):
            medium = medium_at(self.medium, self.flow, moving, self.time)
            shape = shape_stokes_number(moving, self.flow, medium.mu, self.time)
            pairs.append((shape, path_stokes_number(moving, self.flow, medium, self.time)))
        shapes, paths = zip(*pairs, strict=True)
        return max(shapes), max(paths)

    def _limit_bulk_moduli(self) -> None:
        """Reduce bulk moduli whose pressure round-off would spoil; the largest γ̇ is that at release."""
        if not any(self.map_ranks(_is_stiff_in_volume)):
            return
        stress = 0.0
        for moving in self.map_by_id(_moving):
            mu = medium_at(self.medium, self.flow, moving, self.time).mu
            stress = max(stress, float(np.max(mu * shear_rate_at(self.flow, moving, self.time), initial=0.0)))
        self.map_ranks(_limit_lame, stress)


def _is_stiff_in_volume(p: Particles) -> bool:
    return bool((p.lame > limited_lame(p.lame, _stress_scale(p))).any())


def _limit_lame(p: Particles, viscous_stress: float) -> None:
    p.lame[:] = limited_lame(p.lame, np.maximum(_stress_scale(p), viscous_stress))


def _stress_scale(p: Particles) -> NDArray[np.float64]:
    """Return the largest stress on each particle as far as its state has it, Pa."""
    # Ca, if any, is that of the release or of the reference shear rate.
    scale: NDArray[np.float64] = np.maximum(p.mu * np.fmax(p.Ca, 1.0), p.gamma / p.R)
    return scale


def _speeds_and_gradients(values: NodeValues) -> tuple[Floats, Floats]:
    return np.linalg.norm(values.u, axis=1), np.linalg.norm(values.l, axis=1)


_LEAST, _MOST = 1e-30, 1e30
"""Limits of properties in SI units: products of a few of them are finite numbers."""


def _refuse_extreme(p: Particles, medium: Medium) -> None:
    """Raise InputError if a property of a particle or of the fluid is too large or small to compute with."""
    properties = (
        ("the diameter of particle {}", 2.0 * p.R, "m"),
        ("the density of particle {}", p.rho, "kg/m3"),
        ("the shear modulus of particle {}", p.mu, "Pa"),
        ("the fluid's viscosity", np.array([viscosity_at_rate(medium.mu, None)]), "Pa s"),
        ("the fluid's density", np.array([medium.rho]), "kg/m3"),
    )
    for name, values, unit in properties:
        wrong = np.flatnonzero((values != 0.0) & ~((values >= _LEAST) & (values <= _MOST)))
        if len(wrong):
            number = p.number[wrong[0]] if p.size else 0
            raise InputError(
                f"{name.format(number)} is {values[wrong[0]]:g} {unit}. Allowed: {_LEAST:g} to {_MOST:g} "
                f"{unit}; are the units right"
            )


class Stepper:
    """Stepper that advances a cloud with the ranks that hold its particles.

    Parameters
    ----------
    cloud
        The cloud; of one process, its arrays change in place.
    """

    def __init__(self, cloud: Cloud) -> None:
        self.cloud = cloud
        cloud.comm.prepare_steps(cloud)

    def advance(self, steps: int, stop: Callable[[], bool] = never) -> None:
        """Advance by ``steps`` time steps, without warnings; see :meth:`Cloud.advance`.

        Parameters
        ----------
        steps
            Number of steps.
        stop
            Called several times a second; the steps end early if it returns True, as after Ctrl-C. Then
            ``cloud.step`` is the step that all particles have reached. Particles ahead of it stay there until
            the others have caught up in a later call. They also end after an instant at which the state is
            stored, as soon as all particles are at the same step.
        """
        cloud = self.cloud
        last = min(cloud.step + steps, cloud.most_steps)
        while cloud.step < last:
            arrays, ready = cloud.load_flow(last - cloud.step)
            cloud.comm.publish(arrays, cloud.flow)
            outcome = cloud.comm.advance(cloud.step, ready, cloud.bounds, stop)
            cloud.recovered += outcome.mended
            if outcome.outgrown:
                cloud.extend_reach()
            elif outcome.finished:
                cloud.step += ready
                if any(time <= cloud.time for time in cloud.comm.rank.moments.times):
                    return
            elif not outcome.crowded or stop():
                return


def regrouped(parts: Iterable[Particles], n: int) -> Iterator[Particles]:
    """Yield the same particles in parts of n, the last of which may be smaller; at least one part."""
    held: list[Particles] = []
    for part in parts:
        held.append(part)
        while sum(p.size for p in held) > n:
            joined = concatenate(held)
            yield joined.take(slice(n))
            held = [joined.take(slice(n, None))]
    yield concatenate(held)


def explain(reason: Reason | int, models: Models, limits: Limits) -> str:
    """Return the reason of a failure, with the limit or a hint, as the end of a sentence."""
    reason = Reason(reason)
    scheme = INTEGRATORS[models.integrator]
    hint = ""
    if reason == Reason.STRETCHED:
        kind = MATERIALS[models.material]
        end = " and breaks up" if kind.liquid else ""
        hint = f"maxStretch is {limits.maxStretch:g}; it has no steady shape there{end}"
        if kind.slides and not kind.fluid:
            hint = f"the law of its membrane is known up to a stretch of {LARGEST_STRETCH:g}"
    elif reason == Reason.TOO_LARGE:
        hint = f"maxSize is {limits.maxSize:g}; no gradient is uniform over such a body"
    elif reason == Reason.CELLS_TOO_MANY:
        hint = f"maxCells is {limits.maxCells:g}"
    elif reason == Reason.WALLS_TOO_MANY:
        hint = "no gradient is uniform over such a body"
    elif reason == Reason.SUB_STEPS:
        hint = f"maxSubSteps is {limits.maxSubSteps:g}"
    elif reason == Reason.VOLUME_RATIO and models.material == "saintVenantKirchhoff":
        hint = "a Saint Venant-Kirchhoff solid gives way when it is compressed"
    elif reason == Reason.VOLUME_RATIO and scheme.adaptive:
        hint = "the solid is too soft to keep its volume"
    elif not scheme.adaptive and reason in (
        Reason.VOLUME_RATIO, Reason.NOT_FINITE, Reason.NOT_CONVERGED,
    ):  # fmt: skip
        hint = "Δt beyond stability?"
    return f"{REASONS[reason]} ({hint})" if hint else REASONS[reason]


def longest_semi_axis(p: Particles) -> float:
    """Return an upper bound of the semi-axes of active and pending particles, m; 0 without any."""
    return float(link(longest_of)(p))


def first_reach(p: Particles) -> float:
    """Return the distance to which walls are listed for particles at their start, m."""
    return SEEN * _REACH_MARGIN * longest_semi_axis(p)


def clearances(p: Particles, flow: Flow, reach: float, patches: Sequence[int]) -> Floats:
    """Return the gaps between bodies and the nearest of some patches within ``reach`` (m), (n,), m.

    They are infinite where there is none. On a mesh that moves they are the gaps at the times of the bodies,
    whose hosts are set; outside the mesh they are −∞. Otherwise the first times of the flow are loaded.
    """
    moves, first = "wall_velocity" in flow.kernels, flow.span[0] if math.isfinite(flow.span[0]) else 0.0
    times = np.minimum(p.t, flow.span[1]) if moves else np.full(p.size, first)
    if moves:
        p.host[:] = flow.locate(p.x, times)
    gaps, left = np.full(p.size, -np.inf), np.flatnonzero(p.host >= 0)
    slots = {**GAPS, gap: conform(gap, flow.kernels["gap"])}
    while len(left):
        start = float(times[left].min())
        here = times[left] <= max(start, flow.load(start, start))
        some, arrays = p.take(left[here]), packed(flow.arrays(reach, patches))
        of_some = np.empty(some.size)
        link(gaps_of, slots, flow=getattr(arrays, "layout", None))(arrays, some, of_some)
        gaps[left[here]], left = of_some, left[~here]
    return gaps


def _refuse_mixture(p: Particles, material: str) -> None:
    """Raise InputError unless all particles are round drops, or all are solids, as the material is."""
    liquid = MATERIALS[material].liquid
    if (p.drop.astype(bool) != liquid).any():
        raise InputError(
            f"the material is {material}, but {np.count_nonzero(p.drop != liquid)} of {p.size} particles are "
            f"{'solids: use foamprb.drops' if liquid else 'drops: use the material drop'}"
        )
    slides = MATERIALS[material].slides
    if (liquid or slides) and ((p.gamma != 0.0).any() or (np.eye(3).ravel() != p.F0).any()):
        raise InputError(
            "a membrane with a law is a sphere without tension at rest. Allowed: neither shape (F0) nor "
            "surfaceTension (gamma)"
            if slides
            else "a drop is a sphere at rest with the tension mu R. Allowed: neither F0 nor gamma"
        )


def _is_tense(p: Particles) -> bool:
    return bool((p.gamma != 0.0).any())


def is_shaped(p: Particles) -> bool:
    """Return whether a particle at rest is not a sphere."""
    return bool((np.eye(3).ravel() != p.F0).any())


def _number_of_times(p: Particles) -> int:
    return p.n_times


def _largest_radius(p: Particles) -> float:
    return float(p.R.max(initial=0.0))


def _moving(p: Particles) -> Particles:
    return p.take(as_slice(np.flatnonzero(p.status <= Status.ACTIVE)))


def _begin(p: Particles, models: Sequence[Any]) -> None:
    """Set the arrays of particles that models of the surroundings keep."""
    for model in models:
        model.begin(p)


def _released_before(p: Particles, start: float) -> NDArray[np.float64]:
    """Return the times of release before the start, s."""
    return np.asarray(p.t0[(p.status == Status.PENDING) & (p.t0 < start)])


def _longer_than(p: Particles, most: float) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return numbers and longest semi-axes, m, of particles beyond a length that have not ended."""
    longest = p.R * longest_stretch(tuple(p.F.T))
    wrong = (longest > most) & (p.status <= Status.ACTIVE)
    return p.number[wrong], longest[wrong]


def _last_end(p: Particles) -> float:
    """Return the latest time of particles that were released, s; −∞ without any."""
    return float(p.t[p.status != Status.PENDING].max(initial=-np.inf))


def find_hosts(p: Particles, flow: Flow) -> None:
    """Find the hosts of particles that have none; raise InputError for those outside the flow."""
    homeless = np.flatnonzero((p.host < 0) & (p.status <= Status.ACTIVE))
    if len(homeless) == 0:
        return
    p.host[homeless] = flow.locate(p.x[homeless], np.fmax(p.t0[homeless], p.t[homeless]))
    outside = homeless[p.host[homeless] < 0]
    if len(outside):
        first = ", ".join("({:g} {:g} {:g})".format(*x) for x in p.x[outside[:3]])
        raise InputError(f"{len(outside)} of {p.size} particles lie outside the flow: {first}")
