"""Models of the surroundings by name, and their composition for the loop of every integrator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any

from foamprb.cloud.block import Medium, Scratch
from foamprb.cloud.forces import nested
from foamprb.cloud.integrators.base import all_resolved, held_forever, no_disturbance, no_look, no_update
from foamprb.cloud.layout import Layout, end, keep, layout, offsets
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.compile.link import bound
from foamprb.errors import InputError
from foamprb.flow.base import Patch

SURROUNDINGS: dict[str, type[Surrounding]] = {
    "faxenCorrection": FaxenCorrection,
    "SaffmanMeiLiftForce": SaffmanMeiLift,
    "wallLift": WallLift,
    "BrownianMotion": BrownianMotion,
    "swimming": Swimming,
}
"""By the names of their entries in ``particleForces``, in the order in which they act."""


def add_surrounding(name: str, kind: type[Surrounding]) -> None:
    """Add a model to :data:`SURROUNDINGS`, for selection by its name in ``particleForces``; it acts last.

    Parameters
    ----------
    name
        A word.
    kind
        A frozen dataclass of its entries, see :class:`Surrounding`.

    Raises
    ------
    ValueError
        If the name is taken, or the class is none of a model.
    """
    if name in SURROUNDINGS:
        raise ValueError(f"the model {name} exists already")
    if not (isinstance(kind, type) and issubclass(kind, Surrounding)):
        raise ValueError(f"model {name}: {kind!r} is no subclass of Surrounding")
    if "__dataclass_fields__" not in vars(kind):
        raise ValueError(f"model {name}: {kind.__name__} has no @dataclass(frozen=True, kw_only=True)")
    for function in ("update", "disturb"):
        if not isinstance(getattr(kind, function), FunctionType):
            raise ValueError(f"model {name}: {function} of {kind.__name__} is no staticmethod(…)")
    for rows in kind.rows:
        if rows not in kind.disturb.__globals__.keys() | kind.update.__globals__.keys():
            raise ValueError(f"model {name}: the module has no offsets of its rows by the name {rows}")
    SURROUNDINGS[name] = kind


def with_rows(base: Layout, surroundings: Sequence[Surrounding]) -> Layout:
    """Return the layout of an integrator's block, extended by the lasting rows of these models."""
    if not surroundings:
        return base
    extended = layout(*base.parts, *_offsets(base, surroundings).values())
    return keep(extended, [row for row in range(base.rows, extended.rows) if row not in extended.lasting])


def compose(base: Layout, surroundings: Sequence[Surrounding], inertia: bool) -> dict[str, Any]:
    """Return the composed functions of these models and the offsets of their rows, by the names they bind.

    Parameters
    ----------
    base
        Layout of the integrator's block without them.
    inertia
        Whether the integrator's solid has inertia.

    Raises
    ------
    InputError
        If two models determine the same quantity.
    """
    if not surroundings:
        return {}
    update: Callable[..., None] = no_update
    look: Callable[..., None] = no_look
    resolve: Callable[..., float] = all_resolved
    hold: Callable[..., float] = held_forever
    prepare: Callable[..., None] = no_disturbance
    disturb: Callable[..., None] = no_disturbance
    bindings: dict[str, Any] = dict(_offsets(base, surroundings))
    for model in surroundings:
        update = bound(_then_update, others=update, model=type(model).update)
        look = bound(_then_look, others=look, model=type(model).look)
        resolve = bound(_least_resolved, others=resolve, model=type(model).resolve)
        hold = bound(_shortest_held, others=hold, model=type(model).hold)
        functions: dict[str, Any] = dict(model.bindings(inertia))
        prepare = bound(_then_disturb, others=prepare, model=functions.pop("prepare", no_disturbance))
        disturb = bound(_then_disturb, others=disturb, model=type(model).disturb)
        for name in functions.keys() & bindings.keys():
            if name in _TOGETHER:
                functions[name] = bound(_both, one=bindings[name], other=functions[name])
            elif functions[name] is not bindings[name]:
                others = [
                    type(m).__name__ for m in surroundings if m is not model and name in m.bindings(inertia)
                ]
                raise InputError(f"{type(model).__name__} excludes {others[0]}: both determine {name}")
        bindings |= functions
    composed = {"update_all": update, "look_all": look, "resolve_all": resolve, "hold_all": hold}
    return {**bindings, **composed, "prepare_all": prepare, "disturb_all": disturb}


def stages(surroundings: Sequence[Surrounding], inertia: bool) -> list[Callable[..., Any]]:
    """Return the functions of these models that are compiled once for all flows."""
    prepared: list[Any] = [model.bindings(inertia).get("prepare") for model in surroundings]
    further = [stage for model in surroundings for stage in model.stages]
    return [*filter(None, prepared), *further, *(type(model).disturb for model in surroundings)]


def coefficients(surroundings: Sequence[Surrounding], patches: Sequence[Patch]) -> tuple[Any, ...]:
    """Return the coefficients of these models, see :func:`foamprb.cloud.forces.nested`."""
    return nested(model.coefficients(patches) for model in surroundings)


def _offsets(base: Layout, surroundings: Sequence[Surrounding]) -> dict[str, tuple[int, ...]]:
    first_rows: dict[str, tuple[int, ...]] = {}
    first = base.rows
    for model in surroundings:
        for name, rows in model.rows.items():
            first_rows[name] = offsets(rows, first)
            first = end(first_rows[name])
    return first_rows


_TOGETHER = {"turn_along", "bounce_along"}
"""Functions that several models may bind; all are called."""


def _both(block: Any, i: int, turn: Any) -> None:
    one(block, i, turn)
    other(block, i, turn)


def _then_update(
    flow: Any, s: Scratch, i: int, step: int, remaining: float, medium: Medium, coefficients: Any
) -> None:
    others(flow, s, i, step, remaining, medium, coefficients[0])
    model(flow, s, i, step, remaining, medium, coefficients[1])


def _then_look(flow: Any, s: Scratch, i: int, medium: Medium, coefficients: Any) -> None:
    others(flow, s, i, medium, coefficients[0])
    model(flow, s, i, medium, coefficients[1])


def _least_resolved(flow: Any, s: Scratch, i: int, medium: Medium, coefficients: Any) -> float:
    share: float = min(
        others(flow, s, i, medium, coefficients[0]), model(flow, s, i, medium, coefficients[1])
    )
    return share


def _shortest_held(block: Any, i: int, medium: Medium, coefficients: Any) -> float:
    longest: float = min(others(block, i, medium, coefficients[0]), model(block, i, medium, coefficients[1]))
    return longest


def _then_disturb(block: Any, medium: Medium, share: float, coefficients: Any) -> None:
    others(block, medium, share, coefficients[0])
    model(block, medium, share, coefficients[1])


others: Any = no_update
model: Any = no_update
one: Any = no_update
other: Any = no_update
