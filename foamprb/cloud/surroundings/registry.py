"""Models of the surroundings by name, and their composition for the loop of every integrator."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import accumulate
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import Switches, at
from foamprb.cloud.forces import store_fields
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.base import (
    apply_surroundings,
    held_for,
    look_ahead,
    resolved_share,
    update_surroundings,
)
from foamprb.cloud.lanes import hold
from foamprb.cloud.layout import (
    FURTHER,
    LANES,
    Layout,
    compose_function,
    end,
    is_reserved,
    keep,
    layout,
    offsets,
    sequence,
    text_of,
)
from foamprb.cloud.motion import bounce_along, form_bond, mirror_memory, turn_along
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift, after_lift, before_lift
from foamprb.compile.link import separate
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
    names = set[str]()
    for call in ("update", "disturb"):
        function: Any = getattr(kind, call)
        if function is not None and not isinstance(function, FunctionType):
            raise ValueError(f"model {name}: {call} of {kind.__name__} is no staticmethod(…)")
        names |= function.__globals__.keys() if function is not None else set()
    for rows in kind.rows:
        if rows not in names:
            raise ValueError(f"model {name}: the module has no offsets of its rows by the name {rows}")
    SURROUNDINGS[name] = kind


def with_rows(base: Layout, surroundings: Sequence[Surrounding]) -> Layout:
    """Return the layout of an integrator's block, extended by the lasting rows of these models."""
    if not surroundings:
        return base
    parts = _offsets(surroundings).values()
    extended = layout(*base.parts, *parts)
    rows = (row for at in parts for row in range(at[0], end(at)))
    return keep(extended, [row for row in rows if row not in extended.lasting])


class Composed(NamedTuple):
    """What the models of a cloud put into a loop."""

    slots: dict[Callable[..., Any], Callable[..., Any]]
    """Functions behind slots of the loop."""
    switches: dict[str, int]
    """By the names of :class:`~foamprb.cloud.block.Switches`."""
    bindings: dict[str, Any]
    """Functions that stages call, and offsets of rows without a reserved place, by name."""


def compose(surroundings: Sequence[Surrounding], patches: Sequence[Patch], inertia: bool) -> Composed:
    """Return what models put into a loop.

    Parameters
    ----------
    surroundings, patches
        The models, in the order in which they act, and the patches of the flow.
    inertia
        Whether the integrator's solid has inertia.

    Raises
    ------
    InputError
        If two models determine the same quantity.
    """
    by_place: dict[str, list[Callable[..., Any]]] = {name: [] for name in _PLACES}
    for model, coefficients in zip(surroundings, _placed(surroundings, patches)[0], strict=True):
        for name, text in _PLACES.items():
            function = getattr(type(model), name)
            if function is not None:
                by_place[name].append(
                    _adapter(f"{name}_{type(model).__name__}", text, function, coefficients)
                )
    slots: dict[Any, Any] = {
        update_surroundings: sequence("update_surroundings", "flow, s, medium", by_place["update"]),
        look_ahead: sequence("look_ahead", "flow, s, medium", by_place["look"]),
        apply_surroundings: sequence(
            "apply_surroundings", "block, medium, share", [*by_place["prepare"], *by_place["disturb"]]
        ),
        resolved_share: sequence("resolved_share", "flow, s, i, medium", by_place["resolve"], least="1.0"),
        held_for: sequence("held_for", "block, i, medium", by_place["hold"], least="np.inf"),
    }
    switches = {"draws": 1} if by_place["hold"] else {}
    bindings: dict[str, Any] = {name: at for name, at in _offsets(surroundings).items() if at[0] >= FURTHER}
    together: dict[str, list[Callable[..., Any]]] = {}
    for model in surroundings:
        own: Mapping[str, Any] = model.bindings(inertia)
        for name, value in own.items():
            if name in Switches._fields:
                switches[name] = value
            elif name in _TOGETHER:
                together.setdefault(name, []).append(value)
            elif bindings.setdefault(name, value) is not value:
                others = [type(m).__name__ for m in surroundings if name in m.bindings(inertia)]
                raise InputError(f"{type(model).__name__} excludes {others[0]}: both determine {name}")
    for name, functions in together.items():
        slots[_SLOTS[name]] = sequence(name, _TOGETHER[name], functions)
    slots |= {_SLOTS[name]: bindings.pop(name) for name in _SLOTS.keys() & bindings.keys()}
    return Composed(slots, switches, bindings)


def numbers_of(surroundings: Sequence[Surrounding], patches: Sequence[Patch]) -> NDArray[np.float64]:
    """Return the coefficients of models, each at its place, (n,)."""
    return _placed(surroundings, patches)[1]


_ROOMS = {
    "WallLift": 6, "BrownianMotion": 3, "Swimming": 3, "StochasticDispersion": 3, "GradientDispersion": 3,
    "Fates": 8, "PowerLaw": 6, "CrossPowerLaw": 6, "BirdCarreau": 6, "Casson": 6, "HerschelBulkley": 6,
    "FieldViscosity": 1, "PhaseMixture": 4,
}  # fmt: skip
"""Numbers that are reserved for the coefficients of models, so that their code does not depend on others."""
_FIRST = dict(zip(_ROOMS, accumulate(_ROOMS.values(), initial=0), strict=False))
_FURTHER = sum(_ROOMS.values())
_TAIL = _FURTHER + 64
"""Numbers of other models are before this place, arrays behind it."""


def _placed(
    surroundings: Sequence[Surrounding], patches: Sequence[Patch]
) -> tuple[list[str], NDArray[np.float64]]:
    """Return the text of the coefficients of each model, and all numbers.

    Raises
    ------
    InputError
        If a model has more coefficients than there are places.
    """
    numbers, texts, further = [0.0] * _TAIL, [], _FURTHER
    for model in surroundings:
        name, values = type(model).__name__, model.coefficients(patches)
        own: list[float] = []
        # A user's model may have the same name.
        reserved = name in _ROOMS and type(model).__module__.startswith("foamprb.")
        first = _FIRST[name] if reserved else further
        texts.append(text_of(values, first, own, numbers))
        if first + len(own) > (first + _ROOMS[name] if reserved else _TAIL):
            raise InputError(f"{name} has {len(own)} coefficients, which are too many")
        numbers[first : first + len(own)] = own
        further += 0 if reserved else len(own)
    return texts, np.array(numbers)


_PLACES = {
    "update": (
        "def {name}(flow, s, medium):\n"
        "    block, numbers = s.block, medium.numbers\n"
        f"    for i in range({LANES}):\n"
        f"        if block[{at.moving * LANES} + i] > 0.0:\n"
        f"            step, remaining = int(block[{during.held_from * LANES} + i]), "
        f"block[{during.remaining * LANES} + i]\n"
        "            function(flow, s, i, step, remaining, medium, {coefficients})\n"
    ),
    "look": (
        "def {name}(flow, s, medium):\n"
        "    block, numbers = s.block, medium.numbers\n"
        f"    for i in range({LANES}):\n"
        f"        if block[{at.moving * LANES} + i] > 0.0:\n"
        "            function(flow, s, i, medium, {coefficients})\n"
    ),
    "resolve": (
        "def {name}(flow, s, i, medium):\n"
        "    numbers = medium.numbers\n"
        "    return float(function(flow, s, i, medium, {coefficients}))\n"
    ),
    "hold": (
        "def {name}(block, i, medium):\n"
        "    numbers = medium.numbers\n"
        "    return float(function(block, i, medium, {coefficients}))\n"
    ),
} | dict.fromkeys(
    ("prepare", "disturb"),
    "def {name}(block, medium, share):\n"
    "    numbers = medium.numbers\n"
    "    function(block, medium, share, {coefficients})\n",
)
"""How the functions of models are called at each place of a step."""


@cache
def _adapter(name: str, text: str, function: Callable[..., Any], coefficients: str) -> Callable[..., Any]:
    """Return a function of the loop that calls one of a model with its coefficients."""
    return separate(
        compose_function(name, text.format(name=name, coefficients=coefficients), {"function": function})
    )


def _offsets(surroundings: Sequence[Surrounding]) -> dict[str, tuple[int, ...]]:
    first_rows: dict[str, tuple[int, ...]] = {}
    first = FURTHER
    for model in surroundings:
        for name, rows in model.rows.items():
            own = None if is_reserved(rows) else first
            first_rows[name] = offsets(rows, own)
            if own is not None:
                first = end(first_rows[name])
    return first_rows


_TOGETHER = {"turn_along": "block, i, turn", "bounce_along": "block, i, n"}
"""Functions that several models may have; all are called."""
_SLOTS: dict[str, Callable[..., Any]] = {
    slot.__name__: slot
    for slot in (
        turn_along,
        bounce_along,
        form_bond,
        mirror_memory,
        hold,
        store_fields,
        before_lift,
        after_lift,
    )
}
"""Slots that models fill, by name."""
