"""A cloud of particles in a flow: what a run advances."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import DRAGS
from foamprb.body.interface import laplace_stress
from foamprb.body.material import MATERIALS
from foamprb.body.material import finger as finger_of_ellipsoid
from foamprb.body.tensor import principal_frame
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
from foamprb.cloud.advance import STAGES, track_block
from foamprb.cloud.block import LANES, ROWS, Medium, Scratch
from foamprb.cloud.contact import contact_normals
from foamprb.cloud.motion import PatchTable
from foamprb.cloud.patches import ESCAPE, Interaction, Rebound
from foamprb.cloud.state import Particles, Status
from foamprb.compile import Target, is_compiled, link
from foamprb.errors import InputError
from foamprb.flow.analytic import gap_free
from foamprb.flow.base import Flow

if TYPE_CHECKING:
    from foamprb.cloud.device import Device

__all__ = ["Cloud", "Models", "available_threads", "require_device"]

_REACH_MARGIN = 2.0
_ROUND_OFF = 1e-6
"""Share of a step by which it may end after the time until which the flow is ready."""


def available_threads() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


def require_device(device: Target) -> None:
    """Raise InputError if a device cannot be used: say what is missing."""
    if device == "cpu":
        return
    if find_spec("numba_cuda") is None:
        raise InputError("device cuda: the package numba-cuda is missing. Try: pip install 'foamprb[cuda]'")
    import_module("foamprb.cloud.device").device_name()


class Loop(NamedTuple):
    """A compiled loop over particles, and what it is made of."""

    entry: Callable[..., int]
    stages: tuple[Callable[..., Any], ...]
    rows: int
    """Rows of a block."""
    adaptive: bool
    bindings: dict[str, Callable[..., Any]]


_SECOND_ORDER = (track_adaptive, ADAPTIVE_STAGES, ADAPTIVE_ROWS, True)

LOOPS: dict[str, Loop] = {
    "paper": Loop(track_block, STAGES, ROWS, False, {}),
    "rosenbrock": Loop(
        *_SECOND_ORDER,
        {"first_slope": first_inertial, "second_slope": second_inertial, "end_slope": end_inertial},
    ),
    "stokes": Loop(
        *_SECOND_ORDER,
        {"first_slope": first_inertialess, "second_slope": second_inertialess, "end_slope": end_inertialess},
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
    device
        ``"cuda"`` has a GPU advance the particles. They stay in its memory: see :meth:`advance` and
        :meth:`fetch`. What is changed in the arrays of ``particles`` after the first step is not seen there,
        but ``particles`` may be replaced by others.
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
    device: Target = "cpu"

    def __post_init__(self) -> None:
        if len(self.interactions) != len(self.flow.patches):
            raise ValueError(f"{len(self.interactions)} interactions for {len(self.flow.patches)} patches")
        _check(self.models)
        _refuse_early(self.particles, self.start)
        _find_hosts(self.particles, self.flow)
        loop, bindings, separate = linkage(self.models, self.flow, self.particles)
        self._rows = loop.rows
        self._options = (self.models.tolerance,) if loop.adaptive else ()
        self._table = _patch_table(self.interactions)
        self._device: Device | None = None
        if self.device == "cuda":
            require_device(self.device)
            self._device = import_module("foamprb.cloud.device").Device(
                loop.entry, loop.rows, bindings, separate, self.medium, self._table, self._options
            )
        else:
            self._track = link(loop.entry, bindings, separate)

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled; if not, the first :meth:`advance` takes some seconds to do it."""
        return is_compiled(self._track) if self._device is None else self._device.compiled

    @property
    def device_name(self) -> str:
        """What advances the particles."""
        return "cpu" if self._device is None else f"cuda ({self._device.name})"

    @property
    def time(self) -> float:
        """Time to which the cloud has come, s."""
        return self.start + self.step * self.dt

    def advance(self, steps: int) -> None:
        """Take ``steps`` time steps, with all threads, whatever becomes of single particles.

        On a CUDA device, of the particles here only ``status`` follows; :meth:`fetch` brings the rest.

        Raises
        ------
        InputError
            If the flow ends before, or cannot be read; the steps so far are done.
        """
        last = self.step + steps
        while self.step < last:
            ready = self._load(last - self.step)
            if self._device is None:
                self._advance(ready)
            else:
                if self._device.ahead != ready:
                    self._launch(self._device, ready)
                self.recovered += self._device.finish()
            self.step += ready

    def fetch(self, ahead: int = 0) -> None:
        """Bring the particles here up to date; nothing to do unless they are on a CUDA device.

        Parameters
        ----------
        ahead
            Number of steps that the device may begin with meanwhile. They count when :meth:`advance` is
            called with this number, and are dropped otherwise.
        """
        device = self._device
        if device is None:
            return
        device.hold(self.particles)
        device.keep()
        # What is wrong with the flow is said when the steps are due.
        with suppress(InputError):
            if ahead and not device.ahead:
                self._launch(device, self._load(ahead))
        device.deliver()

    def _load(self, steps: int) -> int:
        """Make the flow ready for as many steps as it can be, of ``steps``; how many these are."""
        until = self.flow.load(self.time, self.start + (self.step + 1) * self.dt)
        ready = (until - self.time) / self.dt + _ROUND_OFF
        return steps if ready > steps else max(1, int(ready))

    def _launch(self, device: Device, steps: int) -> None:
        device.hold(self.particles)
        self._grow_reach(device.longest_semi_axis())
        device.launch(self._flow_arrays(), self.step, steps, self.dt, self.start)

    def _advance(self, steps: int) -> None:
        """Take steps for which the flow is ready."""
        p = self.particles
        rows = np.flatnonzero((p.status == Status.PENDING) | (p.status == Status.ACTIVE))
        # Neighbours in the mesh share a block, so that the nodes they read are in the cache.
        rows = rows[np.lexsort((rows, p.host[rows], p.status[rows]))]
        blocks = [rows[i : i + LANES] for i in range(0, len(rows), LANES)]
        self._grow_reach(_longest_semi_axis(p))
        flow_arrays = self._flow_arrays()

        def work(share: Sequence[NDArray[np.int64]]) -> int:
            scratch = Scratch(
                np.empty(self._rows * LANES),
                np.empty(LANES),
                np.empty(LANES, dtype=np.int64),
                np.empty((9, 10)),
            )
            return sum(
                self._track(
                    flow_arrays, self._table, self.medium, p, members,
                    self.step, steps, self.dt, self.start, scratch, *self._options,
                )
                for members in share
            )  # fmt: skip

        shares = [blocks[i :: self.threads] for i in range(self.threads)]
        if self.threads == 1 or len(blocks) < 2:
            self.recovered += work(blocks)
        else:
            with ThreadPoolExecutor(self.threads) as pool:
                self.recovered += sum(pool.map(work, shares))

    def contact_normals(self, rows: NDArray[np.int64]) -> NDArray[np.float64]:
        """Unit normals, into the fluid, of the patches on which particles ended, (n, 3); NaN if not found."""
        bindings = dict(self.flow.kernels)
        if self.models.touching == "centre":
            bindings["gap"] = gap_free
        normals = np.empty((len(rows), 3))
        link(contact_normals, bindings)(self._flow_arrays(), self.particles, rows, normals)
        return normals

    def _grow_reach(self, longest: float) -> None:
        """See to it that walls are listed to well beyond the reach of the longest particle."""
        if longest * _REACH_MARGIN > self.reach:
            self.reach = 2.0 * _REACH_MARGIN * longest

    def _flow_arrays(self) -> Any:
        """The flow's arrays, with the walls within reach."""
        touchable = [i for i, interaction in enumerate(self.interactions) if interaction.code != ESCAPE]
        return self.flow.arrays(self.reach, [] if self.models.touching == "centre" else touchable)


def linkage(
    models: Models, flow: Flow, p: Particles
) -> tuple[Loop, dict[str, Callable[..., Any]], tuple[Callable[..., Any], ...]]:
    """The loop over particles that the models and the flow ask for, and how to link it.

    Returns
    -------
    loop, bindings, separate
        As :func:`foamprb.compile.link` takes the entry of the loop.
    """
    bindings = dict(flow.kernels)
    if models.touching == "centre":
        bindings["gap"] = gap_free
    bindings["traction"] = TRACTIONS[models.traction]
    bindings["drag"] = DRAGS[models.drag]
    material = MATERIALS[models.material]
    bindings["derivatives"] = material.derivatives
    if material.dilation is not None:
        bindings["dilation"] = material.dilation
    if (np.eye(3).ravel() != p.F0).any():
        bindings["finger"] = finger_of_ellipsoid
    if (p.gamma != 0.0).any():
        _refuse_tension(models)
        bindings["interface"] = laplace_stress
    loop = LOOPS[models.integrator]
    bindings.update(loop.bindings)
    # The walk and the wall test are long and called from several places: inlined they would multiply.
    return loop, bindings, (*loop.stages, bindings["walk"], bindings["gap"], bindings["recover"])


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


def _longest_semi_axis(p: Particles) -> float:
    live = (p.status == Status.PENDING) | (p.status == Status.ACTIVE)
    if not live.any():
        return 0.0
    _, stretches = principal_frame(tuple(p.F[live].T))
    return float((np.max(stretches, axis=0) * p.R[live]).max())


def _patch_table(interactions: Sequence[Interaction]) -> PatchTable:
    rebounds = [i if isinstance(i, Rebound) else Rebound() for i in interactions]
    return PatchTable(
        np.array([i.code for i in interactions], dtype=np.int8),
        np.array([r.e for r in rebounds], dtype=float),
        np.array([r.mu for r in rebounds], dtype=float),
    )
