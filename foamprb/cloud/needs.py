"""Values that forces need beside :class:`~foamprb.cloud.forces.Inputs`: of the body, the fluid and the case.

The fluid and the fields are sampled at the start and at the predicted end of a step; between them they are
linear in time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, ClassVar, NamedTuple

from foamprb.body.tensor import Scalar, Tensor, Vector, add, between, scale
from foamprb.cloud.block import Medium, Scratch, at, choose3, load3, load9, viscosity_at
from foamprb.cloud.forces import SAMPLE, STATE, Force, no_values, store_fields
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.layout import LANES, Row
from foamprb.cloud.surroundings.base import Surrounding, Traits
from foamprb.compile.link import bound
from foamprb.errors import InputError, suggestion
from foamprb.flow.fields import FieldArrays, FieldColumns, blend_fields, width
from foamprb.flow.walk import blend

_FIRST = {"u": (0, 3), "grad(u)": (3, 9)}
"""First row and number of rows of what is sampled of the fluid; the fields of the case follow."""
_FLUID_ROWS = 12


class _Offsets(NamedTuple):
    """Rows at the start and at the end of a step, as :class:`Needed` declares them."""

    start: int
    end: int


needed = _Offsets(0, 0)
FIRST = 0
"""First row of one value, behind those offsets; bound with its reader."""


def sample_start(
    _flow: Any, s: Scratch, i: int, _step: int, _rest: float, _medium: Medium, _coefficients: Any
) -> None:
    """Store the fluid and the fields at the start of a step of lane i."""
    block = s.block
    u, l = load3(block, at.u, i), load9(block, at.l, i)
    _store(s, i, needed.start, s.host[i], load3(block, at.x, i), block[at.t * LANES + i], u, l)


def sample_end(_flow: Any, s: Scratch, i: int, _medium: Medium, _coefficients: Any) -> None:
    """Store the fluid and the fields at the predicted end of a step of lane i."""
    block = s.block
    t = block[at.t * LANES + i] + block[at.dt * LANES + i]
    u, l = load3(block, during.end_u, i), load9(block, during.end_l, i)
    _store(s, i, needed.end, s.ahead[i], load3(block, at.new_x, i), t, u, l)


def _store(s: Scratch, i: int, row: int, host: int, x: Vector, t: float, u: Vector, l: Tensor) -> None:
    block = s.block
    for c in range(3):
        block[(row + c) * LANES + i] = u[c]
    for c in range(9):
        block[(row + 3 + c) * LANES + i] = l[c]
    store_fields(s.fields, block, i, row + _FLUID_ROWS, host, x, t)


def store_case_fields(
    fields: FieldArrays, block: Any, i: int, row: int, host: int, x: Vector, t: float
) -> None:
    """Store the fields of the case at x and t."""
    before, after, w, share = blend_fields(fields, host, x, t)
    table = fields[1]
    for c in range(table.shape[1]):
        a, b = blend(table, c, before, w), blend(table, c, after, w)
        block[(row + c) * LANES + i] = a + share * (b - a)


# ---------------------------------------------------------------------------------------------------------
# Values for the force, at the share ``gone`` of the step


def _scalar(block: Any, i: int, _medium: Medium) -> Scalar:
    a, b = block[(needed.start + FIRST) * LANES + i], block[(needed.end + FIRST) * LANES + i]
    return a + block[at.gone * LANES + i] * (b - a)


def _vector(block: Any, i: int, _medium: Medium) -> Vector:
    a, b = load3(block, needed.start + FIRST, i), load3(block, needed.end + FIRST, i)
    return between(a, b, block[at.gone * LANES + i])


def _tensor(block: Any, i: int, _medium: Medium) -> Tensor:
    a, b = load9(block, needed.start + FIRST, i), load9(block, needed.end + FIRST, i)
    return add(a, scale(block[at.gone * LANES + i], add(b, scale(-1.0, a))))


def _symmetric(block: Any, i: int, _medium: Medium) -> Tensor:
    a, b = needed.start + FIRST, needed.end + FIRST
    gone = block[at.gone * LANES + i]
    xx, yy, zz = between(load3(block, a, i), load3(block, b, i), gone)
    xy, yz, xz = between(load3(block, a + 3, i), load3(block, b + 3, i), gone)
    return xx, xy, xz, xy, yy, yz, xz, yz, zz


def _velocity(block: Any, i: int, _medium: Medium) -> Vector:
    return choose3(block[at.gone * LANES + i] > 0.0, load3(block, at.new_v, i), load3(block, at.v, i))


def _last_velocity(block: Any, i: int, _medium: Medium) -> Vector:
    return load3(block, at.v, i)


def _viscosity(block: Any, i: int, medium: Medium) -> Scalar:
    return viscosity_at(block, i, medium)


def _shape(block: Any, i: int, _medium: Medium) -> Tensor:
    return load9(block, at.new_F, i)


_READERS = {1: _scalar, 3: _vector, 6: _symmetric, 9: _tensor}
"""By the number of rows."""


def _then_read(block: Any, i: int, medium: Medium) -> tuple[Any, ...]:
    return *others(block, i, medium), value(block, i, medium)


others: Any = no_values
value: Any = _scalar


def reader_of(force: Force, columns: Sequence[FieldColumns], inertia: bool) -> Callable[..., Any]:
    """Return the function of a block, a lane and the medium that returns the values that a force needs."""
    places, row = dict(_FIRST), _FLUID_ROWS
    for column in columns:
        places[column.name] = row, column.components
        row += column.components
    of_body = {"v": _velocity if inertia else _last_velocity, "F": _shape, "mu": _viscosity}
    read: Callable[..., Any] = no_values
    for name in force.needs:
        if name in of_body:
            one = of_body[name]
        else:
            first, n = places[name]
            one = bound(_READERS[n], FIRST=first)
        read = bound(_then_read, others=read, value=one)
    return read


@dataclass(frozen=True, kw_only=True)
class Needed(Surrounding):
    """Fluid and fields around particles, which some forces need."""

    columns: tuple[FieldColumns, ...]

    traits: ClassVar = Traits(each_step=False)
    update: ClassVar = staticmethod(sample_start)
    look: ClassVar = staticmethod(sample_end)

    @property
    def rows(self) -> Mapping[str, type[tuple[int, ...]]]:  # type: ignore[override]
        """The same number of rows at the start and at the end of a step."""
        return {"needed": _declaration(_FLUID_ROWS + width(self.columns))}

    def bindings(self, inertia: bool) -> Mapping[str, Callable[..., Any]]:  # noqa: ARG002
        """Return the function that samples fields, if there are some."""
        return {"store_fields": store_case_fields} if self.columns else {}


@cache
def _declaration(n: int) -> type[tuple[int, ...]]:
    meaning = "fluid's u and grad u, and fields of the case, at the {} of a step"
    fields = [(name, Annotated[int, Row(n, "", meaning.format(name))]) for name in _Offsets._fields]
    made: Any = NamedTuple("NeededRows", fields)  # type: ignore[misc]
    return made


def needed_by(forces: Sequence[Force], columns: Sequence[FieldColumns]) -> tuple[Needed, ...]:
    """Return the model that samples what the forces need, if they need something that is sampled."""
    names = {name for force in forces for name in force.needs}
    if not names - {"v", "F", "mu"}:
        return ()
    return (Needed(columns=tuple(columns) if names & {c.name for c in columns} else ()),)


_SAMPLES: dict[int, Any] = {1: 1.5, 3: (1.5, 0.5, 0.2)} | dict.fromkeys(
    (6, 9), tuple(map(float, range(1, 10)))
)
_KINDS = {1: "a scalar", 3: "a vector", 6: "a symmetric tensor", 9: "a tensor"}


def check_needs(forces: Sequence[Force], columns: Sequence[FieldColumns]) -> None:
    """Try forces with the fields of a flow.

    Raises
    ------
    InputError
        A field is missing, or a force does not take it.
    """
    components = {column.name: column.components for column in columns}
    for force in forces:
        fields = [name for name in force.needs if name not in STATE]
        for name in fields:
            if name not in components:
                raise InputError(
                    f"the force {force.name} needs {name}, which this flow does not have. "
                    f"{suggestion(name, (*STATE, *components))} A case may have further fields."
                )
        samples = [STATE[name] if name in STATE else _SAMPLES[components[name]] for name in force.needs]
        try:
            type(force).evaluate(SAMPLE, *samples, *force.coefficients)
        except Exception as error:
            kinds = ", ".join(f"{name} is {_KINDS[components[name]]}" for name in fields)
            raise InputError(
                f"the force {force.name} fails: {type(error).__name__}: {error}; {kinds}"
            ) from error
