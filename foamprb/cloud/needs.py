"""Values that forces need beside :class:`~foamprb.cloud.forces.Inputs`: of the body, the fluid and the case.

The fluid and the fields are sampled at the start and at the predicted end of a step; between them they are
linear in time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from foamprb.body.tensor import Scalar, Tensor, Vector, add, between, scale
from foamprb.cloud.block import Medium, Scratch, at, choose3, load3, load9, viscosity_at
from foamprb.cloud.forces import SAMPLE, STATE, Force, no_values, store_fields
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.layout import LANES, MOST_FIELDS, Block, Row, offsets
from foamprb.cloud.surroundings.base import Stage, Surrounding
from foamprb.compile.link import Slots
from foamprb.errors import InputError, suggestion
from foamprb.flow.fields import FieldArrays, FieldColumns, blend_fields, width
from foamprb.flow.walk import blend

_FIRST = {"u": (0, 3), "grad(u)": (3, 9)}
"""First row and number of rows of what is sampled of the fluid; the fields of the case follow."""
_FLUID_ROWS = 12


class NeededRows(NamedTuple):
    """The fluid's u and ∇u, and fields of the case, on a step."""

    start: Annotated[int, Row(_FLUID_ROWS + MOST_FIELDS, "", "at the start")]
    end: Annotated[int, Row(_FLUID_ROWS + MOST_FIELDS, "", "at the predicted end")]


needed = offsets(NeededRows)


def sample_start(
    _flow: object, s: Scratch, i: int, _step: int, _rest: float, _medium: Medium, _coefficients: object
) -> None:
    """Store the fluid and the fields at the start of a step of lane i."""
    block = s.block
    u, l = load3(block, at.u, i), load9(block, at.l, i)
    _store(s, i, needed.start, s.host[i], load3(block, at.x, i), block[at.t * LANES + i], u, l)


def sample_end(_flow: object, s: Scratch, i: int, _medium: Medium, _coefficients: object) -> None:
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
    fields: FieldArrays, block: Block, i: int, row: int, host: int, x: Vector, t: float
) -> None:
    """Store the fields of the case at x and t."""
    before, after, w, share = blend_fields(fields, host, x, t)
    table = fields[1]
    for c in range(table.shape[1]):
        a, b = blend(table, c, before, w), blend(table, c, after, w)
        block[(row + c) * LANES + i] = a + share * (b - a)


# ---------------------------------------------------------------------------------------------------------
# Values for the force, at the share ``gone`` of the step


def _scalar(a: int, b: int) -> Callable[..., Any]:
    """Return a function that reads a number from rows a and b, and so on."""

    def read(block: Block, i: int, _medium: Medium) -> Scalar:
        start, end = block[a * LANES + i], block[b * LANES + i]
        return start + block[at.gone * LANES + i] * (end - start)

    return read


def _vector(a: int, b: int) -> Callable[..., Any]:
    def read(block: Block, i: int, _medium: Medium) -> Vector:
        return between(load3(block, a, i), load3(block, b, i), block[at.gone * LANES + i])

    return read


def _tensor(a: int, b: int) -> Callable[..., Any]:
    def read(block: Block, i: int, _medium: Medium) -> Tensor:
        start, end = load9(block, a, i), load9(block, b, i)
        return add(start, scale(block[at.gone * LANES + i], add(end, scale(-1.0, start))))

    return read


def _symmetric(a: int, b: int) -> Callable[..., Any]:
    def read(block: Block, i: int, _medium: Medium) -> Tensor:
        gone = block[at.gone * LANES + i]
        xx, yy, zz = between(load3(block, a, i), load3(block, b, i), gone)
        xy, yz, xz = between(load3(block, a + 3, i), load3(block, b + 3, i), gone)
        return xx, xy, xz, xy, yy, yz, xz, yz, zz

    return read


def _velocity(block: Block, i: int, _medium: Medium) -> Vector:
    return choose3(block[at.gone * LANES + i] > 0.0, load3(block, at.new_v, i), load3(block, at.v, i))


def _last_velocity(block: Block, i: int, _medium: Medium) -> Vector:
    return load3(block, at.v, i)


def _viscosity(block: Block, i: int, medium: Medium) -> Scalar:
    return viscosity_at(block, i, medium)


def _shape(block: Block, i: int, _medium: Medium) -> Tensor:
    return load9(block, at.new_F, i)


_READERS = {1: _scalar, 3: _vector, 6: _symmetric, 9: _tensor}
"""By the number of rows."""


def _then(others: Callable[..., Any], value: Callable[..., Any]) -> Callable[..., Any]:
    def read(block: Block, i: int, medium: Medium) -> tuple[Any, ...]:
        return *others(block, i, medium), value(block, i, medium)

    return read


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
            one = _READERS[n](needed.start + first, needed.end + first)
        read = _then(read, one)
    return read


@dataclass(frozen=True, kw_only=True)
class Needed(Surrounding):
    """Fluid and fields around particles, which some forces need."""

    columns: tuple[FieldColumns, ...]

    each_step: ClassVar = False
    stages: ClassVar = (
        Stage("start", sample_start, writes=(needed.start,), before=(at.u, at.l)),
        Stage("ahead", sample_end, writes=(needed.end,)),
    )

    rows: ClassVar = (NeededRows,)

    def __post_init__(self) -> None:
        if width(self.columns) > MOST_FIELDS:
            raise InputError(
                f"forces need {width(self.columns)} components of fields of the case. Allowed: {MOST_FIELDS}"
            )

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the function that samples fields, if there are some."""
        return {store_fields: store_case_fields} if self.columns else {}


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
