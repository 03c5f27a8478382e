"""Forces on the barycentre beside drag, and their sum, which the stages of every integrator call.

A new force is a class below, which declares its entries and names a plain function, and a line in
:data:`FORCES`. :func:`compose` puts the sum behind :func:`sum_of_forces`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields, make_dataclass
from inspect import signature
from itertools import pairwise
from numbers import Real
from types import FunctionType
from typing import Annotated, Any, ClassVar, NamedTuple, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from foamprb.body.choice import choice
from foamprb.body.drag import reduced_gravity
from foamprb.body.lift import (
    DUCTS,
    LONG,
    SHORT,
    balances,
    duct_coefficient,
    duct_lift,
    hinges,
    rectangle_coefficient,
    rectangles,
)
from foamprb.body.tensor import Scalar, Vector, inner, minus, norm, plus, scale_vector
from foamprb.cloud.block import LocalMedium, Medium, at, choose3, load3, local_medium
from foamprb.cloud.layout import LANES, Block, compose_function, text_of
from foamprb.compile.link import Function, kernel
from foamprb.dictionary.constraints import (
    Bounds,
    Choice,
    Meaning,
    NonNegative,
    Only,
    Pairs,
    Positive,
    Vector3,
)
from foamprb.errors import InputError

T = TypeVar("T")

_FLUID_VELOCITY = Only("U", "the flow's velocity")
_TINY = 1e-300
_POINTS = 50
"""Largest number of points of a table of ``ductLift``."""


class Inputs(NamedTuple):
    """Arguments of a force: the particle and the fluid around it.

    A force that needs more adds a field here, which :func:`_inputs_of` sets for all integrators. Fields that
    no chosen force reads are left out of the compiled code.
    """

    J: Scalar
    """Volume ratio."""
    rho: Scalar
    """Density of the undeformed solid, kg/m³; that of the deformed one is ρ_s/J."""
    Du_Dt: Vector
    """Acceleration of the fluid at the barycentre, ∂u/∂t + l·u, m/s²."""
    medium: LocalMedium
    """Fluid and gravity: ``mu``, Pa s, if it is constant; ``rho``, kg/m³; ``gravity``, m/s²."""
    x: Vector = (0.0, 0.0, 0.0)
    """Position of the barycentre, m."""
    R: Scalar = 0.0
    """Radius of the sphere of the same volume at rest, m."""
    t: Scalar = 0.0
    """Time, s."""


def displaced(inputs: Inputs) -> Scalar:
    """Return the mass of the displaced fluid over that of the particle, s = m_f/m = J ρ_f/ρ_s."""
    return inputs.J * inputs.medium.rho / inputs.rho


@dataclass(frozen=True, kw_only=True)
class Force:
    """A force on the barycentre. Its fields are the entries of its dictionary in ``particleForces``."""

    evaluate: ClassVar[Callable[..., tuple[Vector, Scalar]]]
    """``evaluate(inputs, *coefficients)``: the force per mass of the particle, m/s², and the inertia that it
    adds, in masses of the particle."""

    name: ClassVar[str] = ""
    """Name of a user's force."""
    needs: ClassVar[tuple[str, ...]] = ()
    """Names of further values, which follow ``inputs`` in its arguments; see :func:`add_force`."""

    @property
    def needed_fields(self) -> tuple[str, ...]:
        """Names of the fields of the case that it needs, and of their gradients as ``grad(E)``."""
        return tuple(name for name in self.needs if name not in STATE)

    @property
    def coefficients(self) -> tuple[Any, ...]:
        """The entries that are numbers, in their order."""
        return tuple(float(value) for value in self._numbers().values())

    def __str__(self) -> str:
        """Return the numbers for the log: ``(Cvm 0.5)``, or nothing."""
        numbers = ", ".join(f"{name} {value:g}" for name, value in self._numbers().items())
        return f"({numbers})" if numbers else ""

    def _numbers(self) -> dict[str, Any]:
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: value for name, value in values.items() if isinstance(value, Real)}


# ---------------------------------------------------------------------------------------------------------
# The forces


def weight(inputs: Inputs) -> tuple[Vector, Scalar]:
    """Return weight less buoyancy, (1 − s) g, m/s² (28), (35); no inertia."""
    return reduced_gravity(inputs.J, inputs.rho, inputs.medium.rho, inputs.medium.gravity), 0.0


@dataclass(frozen=True, kw_only=True)
class Gravity(Force):
    """Gravity, ``constant/g``, less buoyancy: ``gravity;``."""

    evaluate: ClassVar = staticmethod(weight)


def focusing(
    inputs: Inputs, origin: Vector, direction: Vector, weights: tuple[Scalar, Scalar],
    size: Scalar, rate: Scalar, *table: Scalar,
) -> tuple[Vector, Scalar]:  # fmt: skip
    """Return C ρ_f γ̇² R⁴ over m, m/s², away from the middle of a duct; no inertia.

    ``weights`` are those of the distance along the direction and of the whole distance: (1, 0) in a channel,
    (−1, 1) in a pipe.
    """
    e, d = direction, minus(inputs.x, origin)
    along, across = weights
    f = along * inner(d, e)
    q = (across * d[0] + f * e[0], across * d[1] + f * e[1], across * d[2] + f * e[2])
    r = norm(q)
    a = duct_lift(duct_coefficient(r / size, table), inputs.R, rate, inputs.medium.rho, inputs.rho)
    return scale_vector(a / (r + _TINY), q), 0.0


@dataclass(frozen=True, kw_only=True)
class DuctLift(Force):
    """Lift by inertia of the fluid on neutral particles in a straight pipe or between plane walls."""

    shape: Annotated[str, Choice(DUCTS), Meaning("of the duct; a channel has plane walls")]
    origin: Annotated[Vector3, Meaning("a point of the middle plane, or of the axis", "m")]
    direction: Annotated[Vector3, Meaning("normal of the walls, or direction of the axis")]
    size: Annotated[float, Positive, Meaning("half the distance of the walls, or the radius", "m")]
    shearRate: Annotated[float, NonNegative, Meaning("γ̇, shear rate of the flow at the wall", "1/s")]
    table: Annotated[
        Pairs | None,
        Meaning(
            "pairs (s C): distance from the middle over `size`, and coefficient of the force C ρ_f γ̇² R⁴ "
            "outwards",
            "1",
            "that of a small rigid sphere",
        ),
    ] = None

    evaluate: ClassVar = staticmethod(focusing)

    def __post_init__(self) -> None:
        if not any(self.direction):
            raise InputError("has a direction of length 0")
        s = [s for s, _ in self._table]
        if not 2 <= len(s) <= _POINTS or s[0] < 0.0 or any(b <= a for a, b in pairwise(s)):
            raise InputError(f"needs a table of 2 to {_POINTS} pairs (s C), s >= 0 and increasing")

    @property
    def _table(self) -> Pairs:
        return DUCTS[self.shape] if self.table is None else self.table

    @property
    def coefficients(self) -> tuple[Any, ...]:
        """The arguments of :func:`focusing`, of the same types for any table."""
        length = math.hypot(*self.direction)
        e = tuple(component / length for component in self.direction)
        weights = (1.0, 0.0) if self.shape == "channel" else (-1.0, 1.0)
        corners = hinges(self._table)
        unused = (0.0,) * (1 + 2 * _POINTS - len(corners))
        origin = tuple(map(float, self.origin))
        return origin, e, weights, float(self.size), float(self.shearRate), *corners, *unused

    @property
    def normals(self) -> list[Any]:
        """Normals of planes that all hold the middle of the duct, each (3,)."""
        if self.shape == "channel":
            return [self.direction]
        across = np.linalg.svd(np.array([self.direction], dtype=np.float64))[2][1:]
        return [*across]

    def __str__(self) -> str:
        """Return the entries for the log."""
        zeros = ", ".join(f"{s:.3g}" for s in balances(self._table))
        return f"({self.shape}, size {self.size:g}, shearRate {self.shearRate:g}, C = 0 at {zeros or 'no s'})"


def rectangle_focusing(
    inputs: Inputs, origin: Vector, long: Vector, short: Vector, half_sides: tuple[Scalar, Scalar],
    rate: Scalar, along: tuple[Scalar, ...], across: tuple[Scalar, ...],
) -> tuple[Vector, Scalar]:  # fmt: skip
    """Return C ρ_f γ̇² R⁴ over m, m/s², along the sides of a duct; no inertia.

    ``long`` and ``short`` are the directions of its sides; ``along`` and ``across`` are both tables.
    """
    d = minus(inputs.x, origin)
    s, t = inner(d, long) / half_sides[0], inner(d, short) / half_sides[1]
    a = duct_lift(1.0, inputs.R, rate, inputs.medium.rho, inputs.rho)
    C = a * rectangle_coefficient(s, t, along, SHORT)
    D = a * rectangle_coefficient(t, s, across, LONG)
    return plus(scale_vector(C, long), scale_vector(D, short)), 0.0


@dataclass(frozen=True, kw_only=True)
class RectangularDuctLift(Force):
    """Lift by inertia of the fluid on neutral particles in a straight square or rectangular duct."""

    origin: Annotated[Vector3, Meaning("a point of the axis", "m")]
    axis: Annotated[Vector3, Meaning("direction of the flow")]
    direction: Annotated[Vector3, Meaning("normal of the longer sides")]
    size: Annotated[float, Positive, Meaning("half the distance of the longer sides", "m")]
    shearRate: Annotated[
        float, NonNegative, Meaning("γ̇, shear rate of the flow in the middle of a longer side", "1/s")
    ]
    aspectRatio: Annotated[float, Positive, Meaning("longer side over shorter one: 1, 2 or 4", "1")] = 1.0

    evaluate: ClassVar = staticmethod(rectangle_focusing)

    def __post_init__(self) -> None:
        if self.aspectRatio not in rectangles():
            allowed = ", ".join(f"{ratio:g}" for ratio in rectangles())
            raise InputError(f"has the aspectRatio {self.aspectRatio:g}. Allowed: {allowed}")
        turned = inner(self.axis, self.direction)
        if not (any(self.axis) and any(self.direction)) or abs(turned) > 1e-6 * norm(self.axis) * norm(
            self.direction
        ):
            raise InputError("needs an axis and a direction at a right angle to it")

    @property
    def normals(self) -> list[Any]:
        """Normals of planes that all hold the middle of the duct, each (3,)."""
        return [self.direction, np.cross(self.axis, self.direction)]

    @property
    def coefficients(self) -> tuple[Any, ...]:
        """The arguments of :func:`rectangle_focusing`, of the same types for any aspect ratio."""
        short = scale_vector(1.0 / norm(self.direction), self.direction)
        long = tuple(map(float, np.cross(scale_vector(1.0 / norm(self.axis), self.axis), short)))
        sides = float(self.aspectRatio * self.size), float(self.size)
        tables = rectangles()[self.aspectRatio]
        return tuple(map(float, self.origin)), long, short, sides, float(self.shearRate), *tables


def pressure_gradient(inputs: Inputs) -> tuple[Vector, Scalar]:
    """Return m_f Du/Dt over m, s Du/Dt, m/s² (Maxey & Riley 1983); no inertia."""
    return scale_vector(displaced(inputs), inputs.Du_Dt), 0.0


@dataclass(frozen=True, kw_only=True)
class PressureGradient(Force):
    """Force of the undisturbed flow's acceleration: ``pressureGradient;`` or ``{ U U; }``."""

    U: Annotated[str, _FLUID_VELOCITY] = "U"

    evaluate: ClassVar = staticmethod(pressure_gradient)


def virtual_mass(inputs: Inputs, Cvm: Scalar) -> tuple[Vector, Scalar]:
    """Return C s Du/Dt, m/s², and the inertia C s (Auton, Hunt & Prud'homme 1988)."""
    c = Cvm * displaced(inputs)
    return scale_vector(c, inputs.Du_Dt), c


@dataclass(frozen=True, kw_only=True)
class VirtualMass(Force):
    """Fluid that an accelerating particle accelerates with it: ``virtualMass { Cvm 0.5; }``."""

    Cvm: Annotated[float, NonNegative, Meaning("coefficient of virtual mass; ½ for a sphere", "1")]
    U: Annotated[str, _FLUID_VELOCITY] = "U"

    evaluate: ClassVar = staticmethod(virtual_mass)


FORCES: dict[str, type[Force]] = {
    "ductLift": DuctLift,
    "gravity": Gravity,
    "pressureGradient": PressureGradient,
    "rectangularDuctLift": RectangularDuctLift,
    "virtualMass": VirtualMass,
}
"""By the names of their entries in ``particleForces``, in the order in which they are added."""


# ---------------------------------------------------------------------------------------------------------
# Forces of users


@dataclass(frozen=True, kw_only=True)
class UserForce(Force):
    """A force that :func:`add_force` has added."""

    def __reduce__(self) -> Any:
        """Return how another process, which has run the same file, restores it."""
        return _restored, (self.name, {field.name: getattr(self, field.name) for field in fields(self)})


def _restored(name: str, values: Mapping[str, float]) -> Force:
    return FORCES[name](**values)


SAMPLE = Inputs(
    1.0, 1e3, (0.1, 0.2, 0.3), LocalMedium(1e-3, 1e3, (0.0, 0.0, -9.81)), (1e-3, 2e-3, 3e-3), 1e-6, 0.5
)
"""Arguments with which a user's force is tried."""


STATE: dict[str, Any] = {
    "u": (0.1, 0.2, 0.3),
    "grad(u)": (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, -6.0),
    "v": (0.3, 0.2, 0.1),
    "F": (1.0, 0.1, 0.2, 0.3, 1.0, 0.4, 0.5, 0.6, 1.0),
    "mu": 1e-3,
}
"""Values that a force may need beside fields of the case, with those with which it is tried."""


def add_force(
    name: str, evaluate: Callable[..., tuple[Vector, Scalar]], needs: Sequence[str] = ()
) -> type[Force]:
    """Add a force to :data:`FORCES`, for selection by its name in ``particleForces``.

    Parameters
    ----------
    name
        A word.
    evaluate
        ``evaluate(inputs, *entries)`` returns the force per mass of the particle, ((x, y, z) in m/s², inertia
        in masses of the particle, in most cases 0.0), from :class:`Inputs`, the values that it ``needs``,
        and numbers. The last parameters are the entries of the force's dictionary; one with a default may
        be left out, and a hint ``Annotated[float, Positive]`` restricts it. It is compiled: a plain function
        of module level, of arithmetic and numpy functions, with :func:`foamprb.select` in place of ``if``.
    needs
        Names of further values, in the order of the parameters after ``inputs``: ``u``, m/s, and
        ``grad(u)``, ∂u_i/∂x_j row by row, 1/s, of the fluid; ``mu``, its viscosity, Pa s; ``v``, velocity of
        the particle, m/s; ``F``, its deformation gradient row by row; fields of the case, and ``grad(E)``
        for the gradient of a scalar or a vector E, row by row.

    Returns
    -------
    The class of the force, whose instances are arguments of :class:`Models`.

    Raises
    ------
    ValueError
        If the name is taken, or the function is not plain, fails, or returns something else. With fields
        of the case it is tried as soon as these are known.
    """
    if name in FORCES:
        raise ValueError(f"the force {name} exists already")
    for need in needs:
        if need in Inputs._fields:
            raise ValueError(f"force {name}: it needs {need}, which is inputs.{need}")
        if not re.fullmatch(r"[\w.:]+|grad\([\w.:]+\)", need):
            raise ValueError(f"force {name}: it needs {need!r}. Allowed: names, and gradients as grad(E)")
    namespace = {"evaluate": staticmethod(evaluate), "name": name, "needs": tuple(needs)}
    kind: type[Force] = class_of_entries(f"force {name}", evaluate, ("inputs", *needs), UserForce, namespace)
    if STATE.keys() >= set(needs):
        _try(name, tried(kind))
    FORCES[name] = kind
    return kind


def class_of_entries(
    model: str,
    evaluate: Function,
    given: Sequence[str],
    base: type[T],
    namespace: dict[str, Any],
) -> type[T]:
    """Return the class of a user's model, whose entries are the parameters of a function.

    Parameters
    ----------
    model
        What it is, and its name: ``force trap``.
    evaluate
        The function; its first parameters are what it is ``given``.
    base, namespace
        As of :func:`dataclasses.make_dataclass`; the latter has the ``name``.

    Raises
    ------
    ValueError
        If the function is not plain, or has too few parameters or other entries than numbers.
    """
    if not namespace["name"].isidentifier():
        raise ValueError(f"{model}: the name is no word of letters, digits and _")
    if not isinstance(evaluate, FunctionType) or evaluate.__closure__:
        raise ValueError(f"{model}: {evaluate!r} is not a plain function of module level")
    hints = get_type_hints(evaluate, include_extras=True)
    parameters = [*signature(evaluate).parameters.values()]
    if len(parameters) < len(given):
        raise ValueError(f"{model}: it has {len(parameters)} parameters for {', '.join(given)}")
    entries: list[Any] = []
    for p in parameters[len(given) :]:
        hint = hints.get(p.name, float)
        if getattr(hint, "__origin__", hint) is not float:
            raise ValueError(f"{model}: the entry {p.name} is no float")
        default: Any = field() if p.default is p.empty else field(default=float(p.default))
        entries.append((p.name, hint, default))
    return make_dataclass(
        namespace["name"], entries, bases=(base,), frozen=True, kw_only=True, namespace=namespace
    )


def _try(name: str, force: Force) -> None:
    """Evaluate a force without fields; raise ValueError if it fails or returns something else."""
    try:
        arguments = SAMPLE, *(STATE[need] for need in force.needs), *force.coefficients
        (x, y, z), inertia = result = type(force).evaluate(*arguments)
    except Exception as error:
        raise ValueError(f"force {name}: {type(error).__name__}: {error}") from error
    if not all(isinstance(number, Real) and math.isfinite(number) for number in (x, y, z, inertia)):
        raise ValueError(f"force {name}: it returns {result}, not ((x, y, z), inertia) of finite numbers")


def tried(kind: type[T]) -> T:
    """Return a model with its defaults, and with numbers that its bounds admit where it has none."""
    hints = get_type_hints(kind, include_extras=True)
    values = {}
    for entry in fields(kind):  # type: ignore[arg-type]
        if entry.default is MISSING:
            bounds = [b for b in getattr(hints[entry.name], "__metadata__", ()) if isinstance(b, Bounds)]
            numbers = (1.0, *(0.5 * (b.lower + b.upper) for b in bounds), *(b.lower + 1.0 for b in bounds))
            values[entry.name] = next((v for v in numbers if all(b.admits(v) for b in bounds)), 1.0)
    return kind(**values)


# ---------------------------------------------------------------------------------------------------------
# Their sum


def acceleration(block: Block, i: int, medium: Medium, J: Scalar) -> tuple[Vector, Scalar]:
    """Return the acceleration of lane i by every force but drag, m/s², and the inertia in particle masses.

    m (1 + Σ C) dv/dt = Σ f + f_D with the forces f and the inertia m C that each adds.
    """
    f, inertia = sum_of_forces(block, i, _inputs_of(block, i, medium, J))
    return scale_vector(1.0 / inertia, f), inertia


def forces_on(
    block: Block, i: int, medium: Medium, J: Scalar, Du_Dt: Vector
) -> tuple[Vector, Vector, Scalar]:
    """Return the forces on lane i without and with the fluid's acceleration, m/s², and the inertia.

    The arguments of :func:`foamprb.body.slip.balanced_slip`.
    """
    inputs = _inputs_of(block, i, medium, J)
    where = inputs.medium, inputs.x, inputs.R, inputs.t
    f, inertia = sum_of_forces(block, i, Inputs(inputs.J, inputs.rho, Du_Dt, *where))
    still = Inputs(inputs.J, inputs.rho, scale_vector(0.0, inputs.Du_Dt), *where)
    steady, _ = sum_of_forces(block, i, still)
    return steady, f, inertia


def compose(forces: Sequence[Force], reader_of: Callable[[Force], Function] | None = None) -> Function:
    """Return the sum of these forces, for :func:`sum_of_forces`.

    ``reader_of`` returns a function that reads what a force needs, see :mod:`foamprb.cloud.needs`.
    """
    total: Function = no_force
    for force, text in zip(forces, _placed(forces)[0], strict=True):
        read = reader_of(force) if reader_of else no_values
        entries = compose_function("entries", f"def entries(numbers):\n    return {text}\n", {})
        total = _with_force(total, type(force).evaluate, read, entries)
    return total


def coefficients(forces: Sequence[Force]) -> NDArray[np.float64]:
    """Return the coefficients of these forces, one after the other, (n,)."""
    return _placed(forces)[1]


def _placed(forces: Sequence[Force]) -> tuple[list[str], NDArray[np.float64]]:
    """Return the text of the coefficients of each force, and all numbers."""
    numbers: list[float] = []
    texts = []
    for force in forces:
        own: list[float] = []
        texts.append(text_of(force.coefficients, len(numbers), own, []))
        numbers += own
    return texts, np.array(numbers)


def _inputs_of(block: Block, i: int, medium: Medium, J: Scalar) -> Inputs:
    gone = block[at.gone * LANES + i]
    x = choose3(gone > 0.0, load3(block, at.new_x, i), load3(block, at.x, i))
    t = block[at.t * LANES + i] + gone * block[at.dt * LANES + i]
    R, rho = block[at.R * LANES + i], block[at.rho * LANES + i]
    return Inputs(J, rho, load3(block, at.DuDt, i), local_medium(block, i, medium), x, R, t)


# Not the constants 0 and 1. Which sums of a stage the compiler contracts depends on its loads: without these,
# last bits of the shape would depend on whether one of the forces reads them.
def no_force(_block: Block, _i: int, inputs: Inputs) -> tuple[Vector, Scalar]:
    """Return a force of zero, and the inertia of the particle alone."""
    return scale_vector(0.0, inputs.Du_Dt), 1.0 + 0.0 * displaced(inputs)


@kernel
def store_fields(_fields: Any, _block: Block, _i: int, _row: int, _host: int, _x: Vector, _t: float) -> None:
    """No-op: no force reads a field."""


def no_values(_block: Block, _i: int, _medium: Medium) -> tuple[()]:
    """Return no values: a force needs none beside its inputs."""
    return ()


def _with_force(
    others: Function,
    force: Function,
    read: Function,
    entries: Function,
) -> Function:
    """Return the sum of others and of a force, with functions that read what it needs and its entries."""

    def total(block: Block, i: int, inputs: Inputs) -> tuple[Vector, Scalar]:
        a, m = others(block, i, inputs)
        b, n = force(inputs, *read(block, i, inputs.medium), *entries(inputs.medium.forces))
        return plus(a, b), m + n

    return total


DEFAULT: tuple[Force, ...] = (Gravity(),)
"""The forces of a cloud for which none are chosen, and of the uncompiled functions."""
sum_of_forces: Callable[[Any, int, Inputs], tuple[Vector, Scalar]] = choice(compose(DEFAULT))
"""The forces on lane i, m/s², and the inertia, in masses of the particle."""
