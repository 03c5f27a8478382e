"""The surroundings that a cloud has chosen, one after the other, as the loop of every integrator calls them.

The names ``looks``, ``prepares`` and ``disturbs`` are bound to these (:func:`compose`) when the loop is
compiled. Without any model they do nothing, and cost nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from foamprb.cloud.block import Medium, Scratch
from foamprb.cloud.forces.total import bound
from foamprb.cloud.layout import Layout, end, keep, layout, offsets
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.flow.base import Patch

__all__ = ["coefficients", "compose", "look_around", "surround", "with_rows"]


def look_around(flow: Any, s: Scratch, i: int, step: int, rest: float, medium: Medium) -> None:
    """Let each model store what it needs to know around the particle in lane i.

    Parameters
    ----------
    step
        Number of the tracking step.
    rest
        How long it lasts from the lane's t on, s.
    """
    looks(flow, s, i, step, rest, medium, medium.surroundings)


def surround(block: Any, medium: Medium, share: float) -> None:
    """Change the fluid's u and l as the particles feel them, of all lanes.

    Parameters
    ----------
    share
        How far on the way from x to new_x the body is.
    """
    prepares(block, medium, share, medium.surroundings)
    disturbs(block, medium, share, medium.surroundings)


def no_look(
    _flow: Any, _s: Scratch, _i: int, _step: int, _rest: float, _medium: Medium, _coefficients: Any
) -> None:
    """Nothing is looked for."""


def no_disturbance(_block: Any, _medium: Medium, _share: float, _coefficients: Any) -> None:
    """The fluid is felt as the flow has it."""


def with_rows(own: Layout, surroundings: Sequence[Surrounding]) -> Layout:
    """The layout of an integrator's block with the rows of these models behind its own, all of them kept."""
    if not surroundings:
        return own
    found = layout(*own.parts, *_places(own, surroundings).values())
    return keep(found, [row for row in range(own.rows, found.rows) if row not in found.kept])


def compose(own: Layout, surroundings: Sequence[Surrounding], inertia: bool) -> dict[str, Any]:
    """The functions of these models together, by the names to which they are bound, and where their rows are.

    Parameters
    ----------
    own
        Layout of the integrator's block without them.
    inertia
        Whether the integrator's solid has inertia.
    """
    if not surroundings:
        return {}
    look: Callable[..., None] = no_look
    disturb: Callable[..., None] = no_disturbance
    prepare: Callable[..., None] = no_disturbance
    found: dict[str, Any] = dict(_places(own, surroundings))
    for model in surroundings:
        look = bound(_look_and, others=look, model=type(model).look)
        disturb = bound(_disturb_and, others=disturb, model=type(model).disturb)
        prepare = bound(_disturb_and, others=prepare, model=type(model).prepare or no_disturbance)
        found |= model.bindings(inertia)
    return {**found, "looks": look, "prepares": prepare, "disturbs": disturb}


def coefficients(surroundings: Sequence[Surrounding], patches: Sequence[Patch]) -> tuple[Any, ...]:
    """The coefficients of these models as the functions of :func:`compose` read them: ((…, 1st), 2nd)."""
    nested: tuple[Any, ...] = ()
    for model in surroundings:
        nested = nested, model.coefficients(patches)
    return nested


def _places(own: Layout, surroundings: Sequence[Surrounding]) -> dict[str, tuple[int, ...]]:
    places: dict[str, tuple[int, ...]] = {}
    first = own.rows
    for model in surroundings:
        at = offsets(type(model).rows, first)
        places[type(model).place] = at
        first = end(at)
    return places


def _look_and(
    flow: Any, s: Scratch, i: int, step: int, rest: float, medium: Medium, coefficients: Any
) -> None:
    others(flow, s, i, step, rest, medium, coefficients[0])
    model(flow, s, i, step, rest, medium, coefficients[1])


def _disturb_and(block: Any, medium: Medium, share: float, coefficients: Any) -> None:
    others(block, medium, share, coefficients[0])
    model(block, medium, share, coefficients[1])


others: Any = no_look
model: Any = no_look

looks: Any = no_look
prepares: Any = no_disturbance
disturbs: Any = no_disturbance
