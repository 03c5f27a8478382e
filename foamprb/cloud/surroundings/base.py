"""Base class of the models of the surroundings: entries in the settings, and plain functions on a block."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar, Literal, NamedTuple

from foamprb.body.choice import choice
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    plus,
)
from foamprb.cloud.block import Medium, load3, load9, store3, store9
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import Block
from foamprb.cloud.state import Particles
from foamprb.compile.link import Slots
from foamprb.flow.base import Flow, Patch


class Stage(NamedTuple):
    """Function of a model, its place in a step, and the rows by which models depend on each other.

    Rows are named by their offsets, as ``at.u``. At a place, a stage comes after those that write or add to
    what it reads, and before those that change what it reads ``before``.
    """

    place: Literal["start", "ahead", "properties", "fluid", "accept", "hold"]
    """Where and how it is called:

    * ``start``: ``run(flow, s, i, step, remaining, medium, coefficients)`` before a step h of lane i, whose x
      and t are at the start of h. Random numbers belong to the tracking step ``step`` and hold for the time
      ``remaining``, s, through one or more steps h. A further call with ``remaining`` 0 comes at the end of a
      call of the loop, for the last rates.
    * ``ahead``: ``run(flow, s, i, medium, coefficients)`` where the step is to lead, new_x in the host
      ``s.ahead[i]``; not with ``paper``.
    * ``properties``: ``run(block, medium, share, coefficients)`` for all lanes at each evaluation of the
      body's equations, for data that other models read. The lanes are at x + share·(new_x − x), with the
      shape new_F; frames and integrals are its own.
    * ``fluid``: the same after all properties, for what is added to u and l.
    * ``accept``: ``run(flow, s, i, medium, coefficients) -> share``: of a step of lane i longer than Δt that
      led to new_x and new_F, the share that the model resolves. Below 1 the step is repeated, so much
      shorter.
    * ``hold``: ``run(block, i, medium, coefficients) -> s``: how long lane i may hold the next random
      numbers. They hold for a power of two of tracking steps at most, one at least."""
    run: Callable[..., Any]
    reads: tuple[int, ...] = ()
    writes: tuple[int, ...] = ()
    """Rows that no other model may write."""
    adds: tuple[int, ...] = ()
    """Rows to which others may add as well."""
    before: tuple[int, ...] = ()


class Survey(NamedTuple):
    """Cloud about which a model remarks."""

    p: Particles
    flow: Flow
    medium: Medium
    """With the viscosity at each particle, (n,), if it varies."""
    dt: float
    """Tracking step, s."""
    arrays: Any = None
    """Arguments of the flow's kernels before a run. None before further steps, for which only
    ``long_step`` is read."""


class Remarks(NamedTuple):
    """Lines of a model for the log."""

    notes: Sequence[str] = ()
    """Lines before a run."""
    warnings: Sequence[str] = ()
    """Sentences before a run."""
    long_step: str = ""
    """Warning that Δt is too long for the model; empty if not."""


@dataclass(frozen=True, kw_only=True)
class Surrounding:
    """A model that changes the fluid's velocity u and gradient l in the equations of a particle.

    Its fields are the entries of its dictionary. It stores data of a particle in rows of its own in the
    block, which are saved if their declaration says so.
    """

    rows: ClassVar[tuple[type[tuple[int, ...]], ...]] = ()
    """Declarations of its rows, as :func:`foamprb.cloud.layout.offsets` reads them."""
    stages: ClassVar[tuple[Stage, ...]] = ()
    switches: ClassVar[Mapping[str, int]] = {}
    """What the loop does for it, by the names of :class:`foamprb.cloud.block.Switches`."""
    each_step: ClassVar[bool] = True
    """Whether no step may be longer than a tracking step."""
    kernels: ClassVar[tuple[str, ...]] = ()
    """Kernels that a flow (:class:`foamprb.flow.base.Flow`) must have."""
    mirrors: ClassVar[bool] = False
    """Whether it mirrors bodies, with their shapes at rest."""
    measures: ClassVar[tuple[str, ...]] = ()
    """Names of the optional measures that files then contain."""
    surveys: ClassVar[tuple[str, ...]] = Particles._fields
    """Names of the arrays of particles that :meth:`remarks` reads."""

    def coefficients(self, patches: Sequence[Patch]) -> tuple[object, ...]:  # noqa: ARG002
        """Return the arguments of its functions: numbers and arrays of them, perhaps in tuples."""
        return ()

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return its functions behind slots and choices, for an integrator with or without inertia."""
        return {}

    def walls(self, patches: Sequence[Patch]) -> tuple[float, Sequence[int]]:  # noqa: ARG002
        """Return how far away the flow must find walls, in radii of a particle, and indices of their patches.

        Raises
        ------
        InputError
            If its entries name patches that the flow does not have.
        """
        return 0.0, ()

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Return why it is incompatible with an integrator, or with drops; empty if it is compatible."""
        return ""

    def begin(self, p: Particles) -> None:  # noqa: ARG002
        """Set the arrays of the particles that the model keeps, where they are not set."""
        return

    def remarks(self, survey: Survey) -> Remarks:  # noqa: ARG002
        """Return lines for the log."""
        return Remarks()

    def __str__(self) -> str:
        """Return the entries for the log: ``(cutOff 10, strain yes)``."""
        values = ((field.name, getattr(self, field.name)) for field in fields(self))
        named = [f"{name} {_written(value)}" for name, value in values if value is not None]
        return f"({', '.join(named)})" if named else ""


def _written(value: Any) -> str:
    """Return an entry's value as it is written in a dictionary."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):
        return f"({' '.join(map(_written, value))})"
    return f"{value:g}" if isinstance(value, float | int) else f"({value})"


@choice
def curved_velocity(_block: Block, _i: int, _n: Vector, _h: Scalar, _e: Scalar, _share: Scalar) -> Vector:
    """Return the velocity by second derivatives of the flow at a wall, m/s; by default they are unknown."""
    return 0.0, 0.0, 0.0


@choice
def thermal_gradient(_block: Block, _i: int) -> Tensor:
    """Return the gradient by which the stress of molecules acts on a body, 1/s; by default none."""
    return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


@choice
def thermal_force(_block: Block, _i: int) -> Vector:
    """Return the force of molecules, N; by default none."""
    return 0.0, 0.0, 0.0


def add3(block: Block, row: int, i: int, v: Vector) -> None:
    """Add a vector to three rows of lane i."""
    store3(block, row, i, plus(load3(block, row, i), v))


def add9(block: Block, row: int, i: int, T: Tensor) -> None:
    """Add a tensor to nine rows of lane i."""
    store9(block, row, i, add(load9(block, row, i), T))
