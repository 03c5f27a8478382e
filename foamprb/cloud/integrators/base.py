"""Integrators of the shape: a loop over steps, its stages, and its limits.

Particles do not act on each other, so a block of :data:`LANES` of them advances by many steps while it stays
in the processor's cache. In a step, the flow is sampled and the mesh walked particle by particle. The
equations of the body are computed stage by stage over the lanes, in vector instructions. All lanes go
through the same operations, so results depend neither on their order nor on the number of threads.

The names of models (``traction``, ``drag``, ``sample``, ``walk``, …) are bound to the selected ones when the
loop is compiled (:func:`foamprb.compile.link.link`), and ``track`` to the loop of the integrator.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import inf
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Scalar, Vector
from foamprb.cloud.block import Medium, Scratch
from foamprb.cloud.layout import LANES, Layout
from foamprb.cloud.motion import PatchTable
from foamprb.cloud.paths import RecordedRows
from foamprb.cloud.state import Particles

MOST_MEMBERS = LANES
"""Particles that the loop of an integrator takes at once; bound with it."""


def _refuses_nothing(_traction: str, _material: str, _tense: bool) -> str:
    return ""


class Integrator(NamedTuple):
    """Integrator, with its name in the settings."""

    name: str
    description: str
    """Phrase for the log."""
    order: int
    """Order of accuracy in the time step."""
    track: Callable[..., int]
    """Loop that advances a block of particles."""
    stages: tuple[Callable[..., Any], ...]
    """Parts of the loop that do not depend on the flow; each is compiled once for all flows."""
    layout: Layout
    """Layout of its block."""
    recorded: RecordedRows
    """Rows of its block that are recorded of each step."""
    rare: tuple[Callable[..., Any], ...] = ()
    """Parts of the loop that few steps need, compiled as separate functions; the longest comes first."""
    bindings: Mapping[str, Callable[..., Any] | int] = MappingProxyType({})
    """Its own functions and constants, by their names in the loop."""
    adaptive: bool = False
    """Whether it divides tracking steps to meet a tolerance, which is then an argument of its loop."""
    inertia: bool = True
    """Whether the solid has inertia."""
    stable_steps: float = inf
    """Largest stable Δt in relaxation times τ_s of a sphere's shape, less for an elongated body."""
    refuses: Callable[[str, str, bool], str] = _refuses_nothing
    """``refuses(traction, material, tense)`` returns the reason against a traction, a material or surface
    tension, as the end of a sentence that starts with the integrator's name; empty if there is none."""


# ---------------------------------------------------------------------------------------------------------
# Models of the surroundings: the names below are bound to those that a cloud has chosen (see
# foamprb.cloud.surroundings.registry) when the loop is compiled. Without any they are no-ops.


def update_surroundings(flow: Any, s: Scratch, i: int, step: int, remaining: float, medium: Medium) -> None:
    """Let each model update its rows of lane i before a step.

    Parameters
    ----------
    step
        Number of the tracking step in which the lane's random numbers begin.
    remaining
        Time from the lane's t to the end of their validity, s; 0 at the end of a call.
    """
    update_all(flow, s, i, step, remaining, medium, medium.surroundings)


def apply_surroundings(block: Any, medium: Medium, share: float) -> None:
    """Let each model change the fluid's u and l of all lanes, ``share`` of the way from x to new_x."""
    prepare_all(block, medium, share, medium.surroundings)
    disturb_all(block, medium, share, medium.surroundings)


def look_ahead(flow: Any, s: Scratch, i: int, medium: Medium) -> None:
    """Let each model update its rows of lane i where the step is to lead."""
    look_all(flow, s, i, medium, medium.surroundings)


def resolved_share(flow: Any, s: Scratch, i: int, medium: Medium) -> float:
    """Return the smallest share of a step of lane i longer than Δt that a model resolves, 1 for all of it."""
    share: float = resolve_all(flow, s, i, medium, medium.surroundings)
    return share


def held_for(block: Any, i: int, medium: Medium) -> float:
    """Return how long lane i may hold its next random numbers, s."""
    longest: float = hold_all(block, i, medium, medium.surroundings)
    return longest


def held_forever(_block: Any, _i: int, _medium: Medium, _coefficients: Any) -> float:
    """Return infinity: there are no random numbers."""
    return inf


def no_look(_flow: Any, _s: Scratch, _i: int, _medium: Medium, _coefficients: Any) -> None:
    """No-op: no model needs the end of a step."""


def all_resolved(_flow: Any, _s: Scratch, _i: int, _medium: Medium, _coefficients: Any) -> float:
    """Return 1: every step is resolved."""
    return 1.0


def no_update(
    _flow: Any, _s: Scratch, _i: int, _step: int, _remaining: float, _medium: Medium, _coefficients: Any
) -> None:
    """No-op: no model of the surroundings has rows."""


def no_disturbance(_block: Any, _medium: Medium, _share: float, _coefficients: Any) -> None:
    """No-op: u and l are not disturbed."""


def lifted(
    _block: Any, _i: int, _medium: Medium, a: Vector, _v: Vector, _rate: Vector, _inertia: Scalar
) -> Vector:
    """Return the acceleration by all forces but drag as it is: no lift by inertia of the fluid, m/s².

    The arguments are a, the velocity of the body, the rates of drag μ_f K_a/m, 1/s, and the inertia of body
    and virtual mass over that of the body, by which a and the rates are divided.
    """
    return a


update_all: Any = no_update
look_all: Any = no_look
hold_all: Any = held_forever
resolve_all: Any = all_resolved
prepare_all: Any = no_disturbance
disturb_all: Any = no_disturbance


track: Any = None


def track_share(
    flow: Any,
    patches: PatchTable,
    medium: Medium,
    p: Particles,
    rows: NDArray[np.int64],
    step: int,
    steps: int,
    dt: float,
    start: float,
    scratch: Scratch,
    options: tuple[float, ...],
) -> int:
    """Advance a thread's share of the particles, with the indices ``rows``.

    Parameters
    ----------
    options
        Further arguments of the integrator's loop; the others are as in
        :func:`foamprb.cloud.integrators.paper.track_block`.

    Returns
    -------
    The number of walks that needed the tree.
    """
    recovered = 0
    for first in range(0, len(rows), MOST_MEMBERS):
        members = rows[first : first + MOST_MEMBERS]
        recovered += track(flow, patches, medium, p, members, step, steps, dt, start, scratch, *options)
    return recovered
