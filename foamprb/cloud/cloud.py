"""A cloud of particles in a flow: what a run advances."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
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
from foamprb.compile import Target, link
from foamprb.errors import InputError
from foamprb.flow.analytic import gap_free
from foamprb.flow.base import Flow

if TYPE_CHECKING:
    from foamprb.cloud.device import Device

__all__ = ["Cloud", "Models", "available_threads"]

_REACH_MARGIN = 2.0


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


_SECOND_ORDER = (track_adaptive, ADAPTIVE_STAGES, ADAPTIVE_ROWS, True)

LOOPS: dict[str, Loop] = {
    "paper": Loop(track_block, STAGES, ROWS, False, {}),
    "rosenbrock": Loop(*_SECOND_ORDER, {"first_slope": first_inertial, "second_slope": second_inertial}),
    "stokes": Loop(*_SECOND_ORDER, {"first_slope": first_inertialess, "second_slope": second_inertialess}),
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
        If a particle without a host lies outside the flow, the models do not go together, or there is no such
        device.
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
        _find_hosts(self.particles, self.flow)
        bindings = dict(self.flow.kernels)
        if self.models.touching == "centre":
            bindings["gap"] = gap_free
        bindings["traction"] = TRACTIONS[self.models.traction]
        bindings["drag"] = DRAGS[self.models.drag]
        material = MATERIALS[self.models.material]
        bindings["derivatives"] = material.derivatives
        if material.dilation is not None:
            bindings["dilation"] = material.dilation
        p = self.particles
        if (np.eye(3).ravel() != p.F0).any():
            bindings["finger"] = finger_of_ellipsoid
        if (p.gamma != 0.0).any():
            _refuse_tension(self.models)
            bindings["interface"] = laplace_stress
        loop = LOOPS[self.models.integrator]
        bindings.update(loop.bindings)
        # The walk and the wall test are long and called from several places: inlined they would multiply.
        parts = (*loop.stages, bindings["walk"], bindings["gap"], bindings["recover"])
        self._rows = loop.rows
        self._options = (self.models.tolerance,) if loop.adaptive else ()
        self._table = _patch_table(self.interactions)
        self._device: Device | None = None
        if self.device == "cuda":
            made = _device_module().Device
            self._device = made(
                loop.entry, loop.rows, bindings, parts, self.medium, self._table, self._options
            )
        else:
            self._track = link(loop.entry, bindings, separate=parts)
        self._arrays: tuple[float, Any] = (-1.0, None)

    @property
    def time(self) -> float:
        """Time to which the cloud has come, s."""
        return self.start + self.step * self.dt

    @property
    def device_name(self) -> str:
        """What advances the particles."""
        return "cpu" if self._device is None else f"cuda ({self._device.name})"

    def advance(self, steps: int) -> None:
        """Take ``steps`` time steps, with all threads, whatever becomes of single particles.

        On a CUDA device, of the particles here only ``status`` follows; :meth:`fetch` brings the rest.
        """
        if self._device is None:
            self._advance_here(steps)
        else:
            if self._device.ahead != steps:
                self._launch(self._device, steps)
            self.recovered += self._device.finish()
        self.step += steps

    def fetch(self, ahead: int = 0) -> None:
        """Bring the particles here up to date; nothing to do unless they are on a CUDA device.

        Parameters
        ----------
        ahead
            Number of steps that the device may start meanwhile. They count when :meth:`advance` is called
            with just this number, and are dropped otherwise.
        """
        device = self._device
        if device is None:
            return
        device.hold(self.particles)
        device.keep()
        if ahead and not device.ahead:
            self._launch(device, ahead)
        device.deliver()

    def _launch(self, device: Device, steps: int) -> None:
        device.hold(self.particles)
        device.launch(self._flow_arrays(), self.step, steps, self.dt, self.start)

    def _advance_here(self, steps: int) -> None:
        p = self.particles
        rows = np.flatnonzero((p.status == Status.PENDING) | (p.status == Status.ACTIVE))
        # Neighbours in the mesh share a block, so that the nodes they read are in the cache.
        rows = rows[np.lexsort((rows, p.host[rows], p.status[rows]))]
        blocks = [rows[i : i + LANES] for i in range(0, len(rows), LANES)]
        flow_arrays = self._flow_arrays()

        def work(share: Sequence[NDArray[np.int64]]) -> int:
            block, matrix = np.empty(self._rows * LANES), np.empty((9, 10))
            scratch = Scratch(block, np.empty(LANES), np.empty(LANES, dtype=np.int64), matrix)
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

    def _flow_arrays(self) -> Any:
        """The flow's arrays, with walls listed to well beyond the reach of the longest particle."""
        device, p = self._device, self.particles
        longest = _longest_semi_axis(p) if device is None else device.longest_semi_axis()
        if longest * _REACH_MARGIN > self.reach:
            self.reach = 2.0 * _REACH_MARGIN * longest
        if self._arrays[0] != self.reach:
            touchable = [i for i, interaction in enumerate(self.interactions) if interaction.code != ESCAPE]
            if self.models.touching == "centre":
                touchable = []
            self._arrays = (self.reach, self.flow.arrays(self.reach, touchable))
        return self._arrays[1]


def _device_module() -> ModuleType:
    if find_spec("numba_cuda") is None:
        raise InputError(
            "device cuda: the package numba-cuda is missing; pip install 'foamprb[cuda]' brings it"
        )
    return import_module("foamprb.cloud.device")


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
