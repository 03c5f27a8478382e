"""Layout of a working block, from one declaration of its rows.

A declaration is a NamedTuple class whose fields are Annotated with a :class:`Row`. An instance of it holds
the first row of each quantity (:func:`offsets`), so that a line of a kernel reads
``load9(block, at.F, i)``. The rows of a model have the same place in every block, used or not, so that its
machine code does not depend on other models. :func:`layout` generates the functions that load and save
particles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import accumulate
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from foamprb.compile.link import Function, separate, slot

Block: TypeAlias = NDArray[np.float64]
"""A working block: rows × :data:`LANES` numbers, flat."""
LANES = 16
"""Number of particles of a block, side by side: so few that its rows stay in the first level of the cache."""

IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


class Row(NamedTuple):
    """Declaration of one quantity of a block."""

    components: int
    """Number of rows (1, 3 or 9), one for each component."""
    unit: str
    meaning: str
    initial: float | tuple[float, ...] = 0.0
    """Value in an empty lane, of all components or of each. Empty lanes are computed too: they hold a sphere
    at rest, which stays finite."""
    of: str = ""
    """Array of :class:`~foamprb.cloud.state.Particles` from which it is loaded, empty for none."""
    saved: bool | str = False
    """True if it is saved to that array, or the name of a scalar of the block that must then be positive."""
    lasting: bool = False
    """True if it keeps its value from one step to the next; loaded quantities always do. Other rows are
    computed in each step before they are used."""
    columns: bool = False
    """True if its array has columns even where the quantity has one component."""


MOST_TIMES, MOST_FIELDS = 60, 60
"""Relaxation times of a solid, and components of the fields that forces need, at most."""
_ROOMS: tuple[tuple[int, tuple[str, ...]], ...] = (
    (172, ("Rows",)),
    (80, ("StepRows",)),
    (180, ("RelaxationRows", "StiffnessRows")),
    (12, ("LargestRows",)),
    (8, ("ViscosityRows", "FieldRows", "MixtureRows")),
    (48, ("QuadraticRows",)),
    (20, ("SecondRows",)),
    (40, ("FaxenRows",)),
    (112, ("WallRows",)),
    (37, ("BrownianRows",)),
    (8, ("SwimmerRows",)),
    (12, ("EddyRows",)),
    (8, ("FrameRows",)),
    (8, ("FateRows",)),
    (4, ("BondRows",)),
    (22, ("MemoryRows",)),
    (8 * MOST_TIMES, ("TimesRows",)),
    (2 * (12 + MOST_FIELDS), ("NeededRows",)),
)
"""Numbers of rows that are reserved, in this order, for declarations by name; one room for alternatives."""
_FIRST: dict[str, tuple[int, int]] = {
    name: (first, size)
    for first, (size, names) in zip(accumulate((size for size, _ in _ROOMS), initial=0), _ROOMS, strict=False)
    for name in names
}
"""First row and size of the room of a declaration."""
FURTHER = sum(size for size, _ in _ROOMS)
"""First row behind all rooms: of users' models."""
_further: dict[type[tuple[int, ...]], int] = {}
"""First row of each of their declarations, in the order in which they were met."""


class Layout(NamedTuple):
    """Generated functions and sizes of a block."""

    rows: int
    """Number of rows."""
    initial: NDArray[np.float64]
    """(rows,) initial values."""
    load: Callable[[Any, int, Any, int], None]
    """``load(p, k, block, i)`` copies particle k of the cloud into lane i."""
    save: Callable[[Any, int, Any, int], None]
    """``save(p, k, block, i)`` copies the saved rows of lane i to particle k."""
    parts: tuple[tuple[int, ...], ...]
    """:func:`offsets` of the block's declarations, in order."""
    lasting: NDArray[np.int64]
    """Indices of the rows that keep their values between steps; those not loaded come last."""
    fresh: NDArray[np.float64]
    """Initial values of the lasting rows that are not loaded."""


Declared = TypeVar("Declared", bound=tuple[int, ...])


@cache
def rows_of(declaration: type[tuple[int, ...]]) -> Mapping[str, Row]:
    """Return the rows of a declaration by name, in order."""
    hints = get_type_hints(declaration, include_extras=True)
    return MappingProxyType({name: hint.__metadata__[0] for name, hint in hints.items()})


def offsets(declaration: type[Declared], first: int | None = None) -> Declared:
    """Return the index of the first row of each quantity, the same in every block.

    Parameters
    ----------
    declaration
        NamedTuple class with a :class:`Row` in the annotation of each field.
    first
        Index of the first row of another table than a block.

    Raises
    ------
    ValueError
        If it has more rows than are reserved.
    """
    components = [row.components for row in rows_of(declaration).values()]
    if first is None and _is_reserved(declaration):
        first, size = _FIRST[declaration.__name__]
        if sum(components) > size:
            raise ValueError(f"{declaration.__name__} has {sum(components)} rows, and room for {size}")
    elif first is None:
        sizes = (sum(row.components for row in rows_of(other).values()) for other in _further)
        first = _further.setdefault(declaration, FURTHER + sum(sizes))
    make: Any = declaration
    rows: Declared = make(*accumulate(components[:-1], initial=first))
    return rows


def end(at: tuple[int, ...]) -> int:
    """Return the index after the last row of a declaration, from its :func:`offsets`."""
    return at[-1] + [*rows_of(type(at)).values()][-1].components


def layout(*parts: tuple[int, ...]) -> Layout:
    """Generate the functions that load particles into a block and save them.

    They are generated as text, as numba compiles no loop over quantities of several shapes.

    Parameters
    ----------
    parts
        :func:`offsets` of the block's declarations, in order.

    Raises
    ------
    ValueError
        If two declarations have a name in common.
    """
    rows: Placed = {}
    for at in parts:
        for first, (name, row) in zip(at, rows_of(type(at)).items(), strict=True):
            if name in rows:
                raise ValueError(f"the row {name} is declared twice")
            rows[name] = first, row
    initial = np.zeros(max(end(at) for at in parts))
    for first, row in rows.values():
        initial[first : first + row.components] = row.initial
    loaded = _numbers(placed for placed in rows.values() if placed[1].of)
    unloaded = _numbers(placed for placed in rows.values() if placed[1].lasting and not placed[1].of)
    loaded_only = Layout(
        rows=len(initial),
        initial=initial,
        load=sequence("load_rows", "p, k, block, i", [_copier("load", type(at)) for at in parts]),
        save=sequence("save_rows", "p, k, block, i", [_copier("save", type(at)) for at in parts]),
        parts=parts,
        lasting=np.array(loaded, dtype=np.int64),
        fresh=np.empty(0),
    )
    return keep(loaded_only, unloaded)


@slot
def load_rows(_p: Any, _k: int, _block: Block, _i: int) -> None:
    """See :attr:`Layout.load`."""


@slot
def save_rows(_p: Any, _k: int, _block: Block, _i: int) -> None:
    """See :attr:`Layout.save`."""


def keep(base: Layout, rows: Sequence[int]) -> Layout:
    """Return a layout that keeps these rows too, which are not loaded."""
    numbers = np.array(rows, dtype=np.int64)
    return base._replace(
        lasting=np.concatenate([base.lasting, numbers]),
        fresh=np.concatenate([base.fresh, base.initial[numbers]]),
    )


Placed = dict[str, tuple[int, Row]]
"""By name, the first row of each quantity and its declaration."""


def _numbers(placed: Iterable[tuple[int, Row]]) -> list[int]:
    """Return the indices of all rows of these quantities."""
    return [first + c for first, row in placed for c in range(row.components)]


def _is_reserved(declaration: type[tuple[int, ...]]) -> bool:
    """Return True if a place is reserved for the rows of a declaration, which is one of this package."""
    return declaration.__name__ in _FIRST and declaration.__module__.startswith("foamprb.")


def sequence(name: str, parameters: str, functions: Sequence[Function], least: str = "") -> Function:
    """Return a function with these parameters that calls others, in their order, with all of them.

    It returns their smallest result; ``least`` without functions, if that is given.
    """
    return _sequence(name, parameters, tuple(functions), least)


@cache
def _sequence(name: str, parameters: str, functions: tuple[Function, ...], least: str) -> Function:
    if len(functions) == 1:
        return functions[0]
    calls = [f"f{n}({parameters})" for n in range(len(functions))]
    lines = calls or ["pass"]
    if least:
        lines = [f"return min({', '.join(calls)})" if calls else f"return {least}"]
    text = f"def {name}({parameters}):\n" + "".join(f"    {line}\n" for line in lines)
    return compose_function(name, text, {f"f{n}": function for n, function in enumerate(functions)})


def compose_function(name: str, text: str, scope: Mapping[str, Any]) -> Function:
    """Return the function of a name in a text, which reads other names in a scope."""
    names: dict[str, Any] = {"__name__": __name__, "LANES": LANES, "np": np, **scope}
    exec(text, names)
    made: Function = names[name]
    return made


def text_of(values: Any, first: int, numbers: list[float], tail: list[float]) -> str:
    """Return an expression for numbers, tuples of them and arrays that reads them from an array ``numbers``.

    Parameters
    ----------
    values
        The numbers. A seed is a numpy integer.
    first
        Index of the first number in the array.
    numbers
        Takes the numbers that begin there.
    tail
        Takes the arrays, at its end. It becomes the array ``numbers``.
    """
    if isinstance(values, tuple):
        items = "".join(f"{text_of(value, first, numbers, tail)}, " for value in values)
        return f"({items})"
    if isinstance(values, np.ndarray):
        # The code does not depend on the place and the length.
        begin, end = (f"int(numbers[{first + len(numbers) + k}])" for k in range(2))
        numbers += [float(len(tail)), float(len(tail) + len(values))]
        tail.extend(map(float, values))
        return f"numbers[{begin}:{end}]"
    numbers.append(float(values))
    number = f"numbers[{first + len(numbers) - 1}]"
    return f"np.uint64({number})" if isinstance(values, np.uint64) else number


@cache
def _copier(kind: str, declaration: type[tuple[int, ...]]) -> Function:
    """Return the function that loads or saves the rows of one declaration."""
    at = offsets(declaration)
    rows = {name: (row, each) for row, (name, each) in zip(at, rows_of(declaration).items(), strict=True)}
    name = f"{kind}_{declaration.__name__}"
    lines = _load(rows) if kind == "load" else _save(rows)
    text = "\n".join([f"def {name}(p, k, block, i):", "    pass", *lines, ""])
    return separate(compose_function(name, text, {}))


def _load(rows: Placed) -> Iterator[str]:
    yield from _copies((placed for placed in rows.values() if placed[1].of), "{lane} = {array}")


def _save(rows: Placed) -> Iterator[str]:
    kinds = dict.fromkeys(row.saved for _, row in rows.values() if row.saved)
    for saved in kinds:
        if isinstance(saved, str):
            yield f"    if block[{rows[saved][0]} * LANES + i] > 0.0:"
        quantities = (placed for placed in rows.values() if placed[1].saved == saved)
        margin = "    " if isinstance(saved, str) else ""
        yield from (margin + line for line in _copies(quantities, "{array} = {lane}"))


def _copies(placed: Iterable[tuple[int, Row]], copy: str) -> Iterator[str]:
    """Generate lines that copy between lane i and particle k, one loop for each number of components."""
    by_components: dict[int, list[tuple[int, str]]] = {}
    for first, row in placed:
        components = 0 if row.components == 1 and not row.columns else row.components
        by_components.setdefault(components, []).append((first, row.of))
    for components, quantities in by_components.items():
        if components == 0:
            for first, array in quantities:
                yield "    " + copy.format(lane=f"block[{first} * LANES + i]", array=f"p.{array}[k]")
        else:
            yield f"    for c in range({components}):"
            for first, array in quantities:
                lane, element = f"block[({first} + c) * LANES + i]", f"p.{array}[k, c]"
                yield "        " + copy.format(lane=lane, array=element)
