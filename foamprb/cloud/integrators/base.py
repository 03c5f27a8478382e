"""What an integrator of the shape is: a loop over steps, the stages of a step, and the limits of both."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import inf
from types import MappingProxyType
from typing import Any, NamedTuple

from foamprb.cloud.block import Medium, Scratch
from foamprb.cloud.layout import Layout

__all__ = ["Integrator", "apply_surroundings", "no_disturbance", "no_update", "update_surroundings"]


def _refuses_nothing(_traction: str, _material: str, _tense: bool) -> str:
    return ""


class Integrator(NamedTuple):
    """One integrator, by the name that the settings have for it."""

    name: str
    description: str
    """Half a sentence for the log."""
    order: int
    """Order of accuracy in the time step."""
    track: Callable[..., int]
    """The loop that carries a block of particles through steps."""
    stages: tuple[Callable[..., Any], ...]
    """The parts of the loop that do not depend on the flow: each is compiled once for all flows."""
    layout: Layout
    """Of its block."""
    rare: tuple[Callable[..., Any], ...] = ()
    """Parts of the loop that depend on the flow and that few steps need, compiled on their own.

    The longest comes first.
    """
    bindings: Mapping[str, Callable[..., Any] | int] = MappingProxyType({})
    """Functions and constants of its own, by the names by which the loop calls them."""
    adaptive: bool = False
    """Whether it cuts a tracking step as its tolerance asks for, which the loop then takes as an option."""
    inertia: bool = True
    """Whether the solid has inertia."""
    stable_steps: float = inf
    """Largest stable Δt in relaxation times τ_s of a sphere's shape, less for an elongated body."""
    refuses: Callable[[str, str, bool], str] = _refuses_nothing
    """``refuses(traction, material, tense)`` says why the integrator cannot take the traction, the material
    or surface tension, as the end of a sentence that begins with its name; an empty text if it can."""


# ---------------------------------------------------------------------------------------------------------
# Models of the surroundings: the names below are bound to those that a cloud has chosen (see
# foamprb.cloud.surroundings.registry) when the loop is compiled. Without any they are no-ops.


def update_surroundings(flow: Any, s: Scratch, i: int, step: int, rest: float, medium: Medium) -> None:
    """Let each model update its rows of lane i before a step.

    Parameters
    ----------
    step
        Number of the tracking step.
    rest
        Time from the lane's t to the end of the tracking step, s.
    """
    update_all(flow, s, i, step, rest, medium, medium.surroundings)


def apply_surroundings(block: Any, medium: Medium, share: float) -> None:
    """Let each model change the fluid's u and l of all lanes, ``share`` of the way from x to new_x."""
    prepare_all(block, medium, share, medium.surroundings)
    disturb_all(block, medium, share, medium.surroundings)


def no_update(
    _flow: Any, _s: Scratch, _i: int, _step: int, _rest: float, _medium: Medium, _coefficients: Any
) -> None:
    """No-op: no model of the surroundings has rows."""


def no_disturbance(_block: Any, _medium: Medium, _share: float, _coefficients: Any) -> None:
    """No-op: u and l are those of the flow."""


update_all: Any = no_update
prepare_all: Any = no_disturbance
disturb_all: Any = no_disturbance
