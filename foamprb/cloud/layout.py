"""Layout of a working block, from one declaration of its rows.

A declaration is a NamedTuple class whose fields are Annotated with a :class:`Row`. An instance of it holds
the first row of each quantity (:func:`offsets`), so that a line of a kernel reads
``load9(block, at.F, i)``. :func:`layout` generates the functions that load and save particles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import accumulate
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

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


class Layout(NamedTuple):
    """Generated functions and sizes of a block."""

    rows: int
    """Number of rows."""
    idle: Callable[[Any], None]
    """``idle(block)`` fills every lane with the initial values."""
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


def offsets(declaration: type[Declared], first: int = 0) -> Declared:
    """Return the index of the first row of each quantity.

    Parameters
    ----------
    declaration
        NamedTuple class with a :class:`Row` in the annotation of each field.
    first
        Index of the first row: the :func:`end` of the rows before these.
    """
    components = [row.components for row in rows_of(declaration).values()]
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
    scope: dict[str, Any] = {"__name__": __name__, "LANES": LANES}
    exec("\n".join([*_idle(rows), *_load(rows), *_save(rows)]), scope)
    loaded = _numbers(placed for placed in rows.values() if placed[1].of)
    unloaded = _numbers(placed for placed in rows.values() if placed[1].lasting and not placed[1].of)
    loaded_only = Layout(
        rows=end(parts[-1]),
        idle=scope["idle"],
        load=scope["load_rows"],
        save=scope["save_rows"],
        parts=parts,
        lasting=np.array(loaded, dtype=np.int64),
        fresh=np.empty(0),
    )
    return keep(loaded_only, unloaded)


def keep(base: Layout, rows: Sequence[int]) -> Layout:
    """Return a layout that keeps these rows too, which are not loaded."""
    block = np.empty(base.rows * LANES)
    base.idle(block)
    numbers = np.array(rows, dtype=np.int64)
    values = block[numbers * LANES]
    return base._replace(
        lasting=np.concatenate([base.lasting, numbers]), fresh=np.concatenate([base.fresh, values])
    )


Placed = dict[str, tuple[int, Row]]
"""By name, the first row of each quantity and its declaration."""


def _numbers(placed: Iterable[tuple[int, Row]]) -> list[int]:
    """Return the indices of all rows of these quantities."""
    return [first + c for first, row in placed for c in range(row.components)]


def _idle(rows: Placed) -> Iterator[str]:
    yield "def idle(block):"
    yield "    for k in range(len(block)):"
    yield "        block[k] = 0.0"
    yield "    for i in range(LANES):"
    yield "        pass"
    for first, row in rows.values():
        values = row.initial if isinstance(row.initial, tuple) else (row.initial,) * row.components
        for c, value in enumerate(values):
            if value != 0.0:
                yield f"        block[{first + c} * LANES + i] = {value!r}"


def _load(rows: Placed) -> Iterator[str]:
    yield "def load_rows(p, k, block, i):"
    yield "    pass"
    yield from _copies((placed for placed in rows.values() if placed[1].of), "{lane} = {array}")


def _save(rows: Placed) -> Iterator[str]:
    yield "def save_rows(p, k, block, i):"
    yield "    pass"
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
