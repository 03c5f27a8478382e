"""Models of the surroundings by name, and their composition for the loop of every integrator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from functools import cache
from itertools import accumulate
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import at, choose3, load3, load9
from foamprb.cloud.forces import class_of_entries, tried
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.base import (
    apply_surroundings,
    held_for,
    look_ahead,
    resolved_share,
    update_surroundings,
)
from foamprb.cloud.layout import (
    LANES,
    Layout,
    compose_function,
    end,
    keep,
    layout,
    offsets,
    rows_of,
    sequence,
    text_of,
)
from foamprb.cloud.motion import bounce_along, turn_along
from foamprb.cloud.surroundings.base import Stage, Surrounding, add3, add9
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.compile.link import Function, separate, traced
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


_NEEDS = {
    "x": (at.x, 3), "u": (at.u, 3), "grad(u)": (at.l, 9), "v": (at.v, 3), "F": (at.new_F, 9), "R": (at.R, 1),
    "rho": (at.rho, 1), "t": (at.t, 1),
}  # fmt: skip
"""First row and number of rows of what a user's model may need."""
_ADDS = ("u", "grad(u)")
_ACCESS = {"load3": load3, "load9": load9, "add3": add3, "add9": add9, "choose3": choose3}


class UserSurrounding(Surrounding):
    """A model that :func:`add_surrounding` has made of a function."""

    name: ClassVar[str]
    each_step: ClassVar = False
    evaluate: ClassVar[Function]
    samples: ClassVar[tuple[Any, ...]]
    """Values that it needs, with which it is tried."""

    def coefficients(self, patches: Sequence[Patch]) -> tuple[object, ...]:  # noqa: ARG002
        """Return the entries."""
        return tuple(self._entries().values())

    def _entries(self) -> dict[str, float]:
        return {entry.name: float(getattr(self, entry.name)) for entry in fields(self)}

    def __reduce__(self) -> Any:
        """Return how another process, which has run the same file, restores it."""
        return _restored, (self.name, self._entries())


def _restored(name: str, entries: dict[str, float]) -> Surrounding:
    return SURROUNDINGS[name](**entries)


def add_surrounding(
    name: str, evaluate: Function, needs: Sequence[str] = (), adds: Sequence[str] = ("u",)
) -> type[Surrounding]:
    """Add a model to :data:`SURROUNDINGS`, for selection by its name in ``particleForces``; it acts last.

    Parameters
    ----------
    name
        A word.
    evaluate
        ``evaluate(*needs, *entries)`` returns what the model adds to the fluid that a particle feels, a tuple
        of three for ``u`` and of nine for ``grad(u)``; a tuple of both if it adds to both. The last
        parameters are the entries of its dictionary, see :func:`foamprb.cloud.forces.add_force`; so are the
        rules for what may be compiled.
    needs
        Names of values, in the order of the parameters: ``x``, the barycentre, m; ``t``, the time at the
        start of the step, s; ``u``, m/s, and ``grad(u)``, row by row, 1/s, of the fluid, with what the models
        before have added; ``v``, the particle's velocity at the start of the step, m/s; ``F``, its
        deformation gradient; ``R``, the radius of the sphere of the same volume, m; ``rho``, its density at
        rest, kg/m³.
    adds
        ``u``, ``grad(u)`` or both.

    Returns
    -------
    The class of the model, whose instances are arguments of :class:`Models`.

    Raises
    ------
    ValueError
        If the name is taken, or the function is not plain or fails.
    """
    if name in SURROUNDINGS:
        raise ValueError(f"the model {name} exists already")
    for given, allowed in ((needs, tuple(_NEEDS)), (adds, _ADDS)):
        for one in given:
            if one not in allowed:
                raise ValueError(f"model {name}: {one} is unknown. Allowed: {', '.join(allowed)}")
    kind = class_of_entries(
        f"model {name}", evaluate, needs, UserSurrounding, {"evaluate": staticmethod(evaluate), "name": name}
    )
    read = "".join(f"{_load(need)}, " for need in needs)
    call = f"evaluate({read}*coefficients)"
    lines = [f"added = {call if len(adds) > 1 else f'({call},)'}"]
    for k, row in enumerate(adds):
        first, n = _NEEDS[row]
        lines.append(f"add{n}(block, {first}, i, added[{k}])")
    body = "".join(f"        {line}\n" for line in lines)
    text = f"def {name}(block, medium, share, coefficients):\n    for i in range(LANES):\n{body}"
    run = traced(compose_function(name, text, {"evaluate": evaluate, **_ACCESS}))
    changed = tuple(_NEEDS[one][0] for one in adds)
    # To what it both needs and adds to, it adds as it finds it.
    reads = tuple(_NEEDS[one][0] for one in needs if one not in adds)
    kind.stages = (Stage("fluid", run, reads, adds=changed),)
    kind.samples = tuple(1.0 if n == 1 else (1.0,) * n for n in (_NEEDS[one][1] for one in needs))
    _try(name, tried(kind), [_NEEDS[one][1] for one in adds])
    SURROUNDINGS[name] = kind
    return kind


def _try(name: str, model: UserSurrounding, components: Sequence[int]) -> None:
    """Evaluate a model; raise ValueError if it fails or returns others than so many components of each."""
    try:
        added = model.evaluate(*model.samples, *model.coefficients(()))
        found = [len(one) for one in (added if len(components) > 1 else (added,))]
    except Exception as error:
        raise ValueError(f"model {name}: {type(error).__name__}: {error}") from error
    if found != [*components]:
        raise ValueError(
            f"model {name}: it returns {added}, not {' and '.join(map(str, components))} numbers"
        )


def _load(need: str) -> str:
    """Return the text that reads a value of lane i."""
    row, n = _NEEDS[need]
    if need == "x":
        # At the start of a step new_x is not known.
        return f"choose3(share > 0.0, load3(block, {at.new_x}, i), load3(block, {row}, i))"
    return f"block[{row} * LANES + i]" if n == 1 else f"load{n}(block, {row}, i)"


def with_rows(base: Layout, surroundings: Sequence[Surrounding]) -> Layout:
    """Return the layout of an integrator's block, extended by the lasting rows of these models."""
    if not surroundings:
        return base
    parts = [offsets(rows) for model in surroundings for rows in model.rows]
    extended = layout(*base.parts, *parts)
    rows = (row for at in parts for row in range(at[0], end(at)))
    return keep(extended, [row for row in rows if row not in extended.lasting])


class Composed(NamedTuple):
    """What the models of a cloud put into a loop."""

    slots: dict[Function, Function]
    """Functions behind slots and choices."""
    switches: dict[str, int]
    """By the names of :class:`~foamprb.cloud.block.Switches`."""


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
    texts = _placed(surroundings, patches)[0]
    of_models = [(n, stage) for n, model in enumerate(surroundings) for stage in model.stages]

    def at_place(place: str) -> list[Function]:
        some = _in_order([(n, stage) for n, stage in of_models if stage.place == place], surroundings)
        names = [f"{place}_{type(surroundings[n]).__name__}" for n, _ in some]
        return [
            _adapter(name, _PLACES[place], stage.run, texts[n])
            for name, (n, stage) in zip(names, some, strict=True)
        ]

    holding = at_place("hold")
    slots: dict[Any, Any] = {
        update_surroundings: sequence("update_surroundings", "flow, s, medium", at_place("start")),
        look_ahead: sequence("look_ahead", "flow, s, medium", at_place("ahead")),
        apply_surroundings: sequence(
            "apply_surroundings", "block, medium, share", [*at_place("properties"), *at_place("fluid")]
        ),
        resolved_share: sequence("resolved_share", "flow, s, i, medium", at_place("accept"), least="1.0"),
        held_for: sequence("held_for", "block, i, medium", holding, least="np.inf"),
    }
    switches = {"draws": 1} if holding else {}
    together: dict[Function, list[Function]] = {}
    for model in surroundings:
        switches |= model.switches
        for place, function in model.slots(inertia).items():
            if place in _TOGETHER:
                together.setdefault(place, []).append(function)
            elif slots.setdefault(place, function) is not function:
                others = [type(m).__name__ for m in surroundings if place in m.slots(inertia)]
                raise InputError(
                    f"{type(model).__name__} excludes {others[0]}: both determine {place.__name__}"
                )
    for place, functions in together.items():
        slots[place] = sequence(place.__name__, _TOGETHER[place], functions)
    return Composed(slots, switches)


def _in_order(stages: Sequence[tuple[int, Stage]], models: Sequence[Surrounding]) -> list[tuple[int, Stage]]:
    """Return the stages of one place, with the numbers of their models, in an order that their rows allow.

    Of several such orders it is the one nearest to the order of the models.

    Raises
    ------
    InputError
        If two models write the same rows, or each must act before the other.
    """
    names = [type(models[n]).__name__ for n, _ in stages]
    for k, (n, one) in enumerate(stages):
        for j, (m, other) in enumerate(stages[:k]):
            both = set(one.writes) & set(other.writes)
            if both and n != m:
                raise InputError(f"{names[k]} excludes {names[j]}: both determine {_row(min(both), models)}")
    left, ordered = list(range(len(stages))), list[tuple[int, Stage]]()
    while left:
        free = [k for k in left if not any(j != k and _precedes(stages[j][1], stages[k][1]) for j in left)]
        if not free:
            raise InputError(f"{' and '.join(names[k] for k in left)} each read what another one changes")
        left.remove(free[0])
        ordered.append(stages[free[0]])
    return ordered


def _precedes(one: Stage, other: Stage) -> bool:
    """Return True if a stage must come before another one of its place."""
    changes = {*one.writes, *one.adds}
    return bool(
        changes & {*other.reads}
        or {*one.writes} & {*other.adds}
        or {*one.before} & {*other.writes, *other.adds}
    )


def _row(first: int, models: Sequence[Surrounding]) -> str:
    """Return the name of a quantity by its first row."""
    parts = (at, during, *(offsets(rows) for model in models for rows in model.rows))
    names = (zip(part, rows_of(type(part)), strict=True) for part in parts)
    return next(name for part in names for row, name in part if row == first)


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
    "start": (
        "def {name}(flow, s, medium):\n"
        "    block, numbers = s.block, medium.numbers\n"
        f"    for i in range({LANES}):\n"
        f"        if block[{at.moving * LANES} + i] > 0.0:\n"
        f"            step, remaining = int(block[{during.held_from * LANES} + i]), "
        f"block[{during.remaining * LANES} + i]\n"
        "            function(flow, s, i, step, remaining, medium, {coefficients})\n"
    ),
    "ahead": (
        "def {name}(flow, s, medium):\n"
        "    block, numbers = s.block, medium.numbers\n"
        f"    for i in range({LANES}):\n"
        f"        if block[{at.moving * LANES} + i] > 0.0:\n"
        "            function(flow, s, i, medium, {coefficients})\n"
    ),
    "accept": (
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
    ("properties", "fluid"),
    "def {name}(block, medium, share):\n"
    "    numbers = medium.numbers\n"
    "    function(block, medium, share, {coefficients})\n",
)
"""How the functions of models are called at each place of a step."""


@cache
def _adapter(name: str, text: str, function: Function, coefficients: str) -> Function:
    """Return a function of the loop that calls one of a model with its coefficients."""
    return separate(
        compose_function(name, text.format(name=name, coefficients=coefficients), {"function": function})
    )


_TOGETHER = {turn_along: "block, i, turn", bounce_along: "block, i, n"}
"""Slots behind which several models may put a function; all are called."""
