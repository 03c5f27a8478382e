"""How a working block is laid out: its rows are declared once, and what follows from that.

A declaration is a NamedTuple class whose fields are Annotated with a :class:`Row`. An instance of it holds
the number at which each quantity begins (:func:`offsets`), so that a line of a kernel reads
``load9(block, at.F, i)``; :func:`layout` makes the functions that fill a block with particles and empty it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import accumulate
from typing import Any, NamedTuple, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

__all__ = ["IDENTITY", "LANES", "Layout", "Row", "end", "keep", "layout", "offsets", "rows_of"]

LANES = 16
"""Number of particles of a block, side by side: so few that its rows stay in the first level of the cache."""

IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


class Row(NamedTuple):
    """How one quantity of a block is laid out, and what it means."""

    components: int
    """Number of rows: 1, 3 or 9, one for each component."""
    unit: str
    meaning: str
    initial: float | tuple[float, ...] = 0.0
    """Value in a lane without a particle, of all components or of each. Such a lane is computed as any other
    and must stay finite: it is a sphere at rest."""
    of: str = ""
    """Array of :class:`~foamprb.cloud.state.Particles` from which it is loaded, if it is."""
    saved: bool | str = False
    """Whether it is saved to that array, or the scalar of the same block that must be positive for that."""
    lasting: bool = False
    """Whether it belongs to the particle from one step to the next, as all that is loaded does. What does not
    is found anew in each step before it is used."""


class Layout(NamedTuple):
    """What follows from the declaration of a block."""

    rows: int
    """Number of rows."""
    idle: Callable[[Any], None]
    """``idle(block)`` fills every lane with the initial values."""
    load: Callable[[Any, int, Any, int], None]
    """``load(p, k, block, i)`` copies particle k of the cloud into lane i."""
    save: Callable[[Any, int, Any, int], None]
    """``save(p, k, block, i)`` copies what is saved of lane i back to particle k."""
    ask: Callable[[Any, int], float]
    """``ask(p, k)`` reads of particle k what ``load`` will, so that it comes from memory, and returns a sum
    that means nothing."""
    parts: tuple[tuple[int, ...], ...]
    """:func:`offsets` of the declarations of which the block consists, in order."""
    kept: NDArray[np.int64]
    """Rows that belong to a particle from one step to the next, by their numbers, last those not loaded."""
    fresh: NDArray[np.float64]
    """Initial values of those that are not loaded."""


Declared = TypeVar("Declared", bound=tuple[int, ...])


def rows_of(declaration: type[tuple[int, ...]]) -> dict[str, Row]:
    """The rows of a declaration, by name, in their order in a block."""
    hints = get_type_hints(declaration, include_extras=True)
    return {name: hint.__metadata__[0] for name, hint in hints.items()}


def offsets(declaration: type[Declared], first: int = 0) -> Declared:
    """The number of the first row of each quantity.

    Parameters
    ----------
    declaration
        NamedTuple class with a :class:`Row` in the annotation of each field.
    first
        Number of the first row of all: the :func:`end` of the rows before these.
    """
    components = [row.components for row in rows_of(declaration).values()]
    make: Any = declaration
    found: Declared = make(*accumulate(components[:-1], initial=first))
    return found


def end(at: tuple[int, ...]) -> int:
    """The number after the last row of a declaration, from its :func:`offsets`."""
    return at[-1] + [*rows_of(type(at)).values()][-1].components


def layout(*parts: tuple[int, ...]) -> Layout:
    """The functions that fill a block with particles and empty it.

    They are written as text and then executed: numba compiles no loop over quantities of several shapes.

    Parameters
    ----------
    parts
        :func:`offsets` of the declarations of which the block consists, in order.

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
    exec("\n".join([*_idle(rows), *_load(rows), *_save(rows), *_ask(rows)]), scope)
    loaded = _numbers(placed for placed in rows.values() if placed[1].of)
    lasting = _numbers(placed for placed in rows.values() if placed[1].lasting and not placed[1].of)
    found = Layout(
        rows=end(parts[-1]),
        idle=scope["idle"],
        load=scope["load_rows"],
        save=scope["save_rows"],
        ask=scope["ask_rows"],
        parts=parts,
        kept=np.array(loaded, dtype=np.int64),
        fresh=np.empty(0),
    )
    return keep(found, lasting)


def keep(own: Layout, rows: Sequence[int]) -> Layout:
    """A layout of which these rows, which are not loaded, are kept as well."""
    block = np.empty(own.rows * LANES)
    own.idle(block)
    numbers = np.array(rows, dtype=np.int64)
    values = block[numbers * LANES]
    return own._replace(kept=np.concatenate([own.kept, numbers]), fresh=np.concatenate([own.fresh, values]))


Placed = dict[str, tuple[int, Row]]
"""By name, the number where each quantity begins, and its row."""


def _numbers(placed: Iterable[tuple[int, Row]]) -> list[int]:
    """The numbers of all rows of these quantities."""
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
        chosen = (placed for placed in rows.values() if placed[1].saved == saved)
        margin = "    " if isinstance(saved, str) else ""
        yield from (margin + line for line in _copies(chosen, "{array} = {lane}"))


def _ask(rows: Placed) -> Iterator[str]:
    # The first and the last component: there are no lines of memory between those of nine numbers.
    loaded = {row.of: row.components for _, row in rows.values() if row.of}
    yield "def ask_rows(p, k):"
    yield "    total = 0.0"
    for array, components in loaded.items():
        ends = ["k"] if components == 1 else ["k, 0", f"k, {components - 1}"]
        yield from (f"    total += p.{array}[{place}]" for place in ends)
    yield "    return total"


def _copies(placed: Iterable[tuple[int, Row]], copy: str) -> Iterator[str]:
    """Lines that copy between lane i and particle k: one loop for all quantities of as many components."""
    by_components: dict[int, list[tuple[int, str]]] = {}
    for first, row in placed:
        by_components.setdefault(row.components, []).append((first, row.of))
    for components, quantities in by_components.items():
        if components == 1:
            for first, array in quantities:
                yield "    " + copy.format(lane=f"block[{first} * LANES + i]", array=f"p.{array}[k]")
        else:
            yield f"    for c in range({components}):"
            for first, array in quantities:
                lane, element = f"block[({first} + c) * LANES + i]", f"p.{array}[k, c]"
                yield "        " + copy.format(lane=lane, array=element)
