"""Integrators of the shape: a loop over steps, its stages, and its limits.

Particles do not act on each other, so a block of :data:`LANES` of them advances by many steps while it stays
in the processor's cache. In a step, the flow is sampled and the mesh walked particle by particle. The
equations of the body are computed stage by stage over the lanes, in vector instructions. All lanes go
through the same operations, so results depend neither on their order nor on the number of threads.

What a model, an integrator or a flow does is behind slots (:func:`foamprb.compile.link.slot`): a loop is
compiled once for all of them.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from types import MappingProxyType
from typing import NamedTuple

from foamprb.body.choice import choice
from foamprb.body.tensor import Scalar, Vector
from foamprb.cloud.block import Medium, Scratch, Switches
from foamprb.cloud.layout import Block, Layout
from foamprb.cloud.paths import RecordedRows
from foamprb.compile.link import Slots, slot


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
    """Loop that advances particles."""
    layout: Layout
    """Layout of its block."""
    recorded: RecordedRows
    """Rows of its block that are recorded of each step."""
    slots: Slots = MappingProxyType({})
    """Its functions behind slots of the loop and of stages that all integrators have."""
    switches: Switches = Switches()
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
# Models of the surroundings (see foamprb.cloud.surroundings.registry)


@slot
def update_surroundings(_flow: object, _s: Scratch, _medium: Medium) -> None:
    """Let each model update its rows of the moving lanes before a step.

    The rows ``held_from`` and ``remaining`` hold the tracking step in which a lane's random numbers begin,
    and the time to the end of their validity, s; 0 at the end of a call.
    """


@slot
def apply_surroundings(_block: Block, _medium: Medium, _share: float) -> None:
    """Let each model change the fluid's u and l of all lanes, ``share`` of the way from x to new_x."""


@slot
def look_ahead(_flow: object, _s: Scratch, _medium: Medium) -> None:
    """Let each model update its rows of the moving lanes where the steps are to lead."""


@slot
def resolved_share(_flow: object, _s: Scratch, _i: int, _medium: Medium) -> float:
    """Return the smallest share of a step of lane i longer than Δt that a model resolves, 1 for all of it."""
    return 1.0


@slot
def held_for(_block: Block, _i: int, _medium: Medium) -> float:
    """Return how long lane i may hold its next random numbers, s."""
    return inf


@choice
def lifted(
    _block: Block, _i: int, _medium: Medium, a: Vector, _v: Vector, _rate: Vector, _inertia: Scalar
) -> Vector:
    """Return the acceleration by all forces but drag as it is: no lift by inertia of the fluid, m/s².

    The arguments are a, the velocity of the body, the rates of drag μ_f K_a/m, 1/s, and the inertia of body
    and virtual mass over that of the body, by which a and the rates are divided.
    """
    return a
