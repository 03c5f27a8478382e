"""What a model of the surroundings is: entries in the settings, and two plain functions on a block."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar

from foamprb.cloud.block import Medium
from foamprb.cloud.state import Particles
from foamprb.flow.base import Flow, Patch

__all__ = ["Surrounding"]


@dataclass(frozen=True, kw_only=True)
class Surrounding:
    """A model that changes the velocity u and the gradient l of the fluid as a particle feels them.

    Its fields are the entries of its dictionary. What it finds out about a particle it stores in rows of its
    own in the block, which are not saved unless their declaration says so.
    """

    rows: ClassVar[type[tuple[int, ...]]]
    """Declaration of its rows, as :func:`foamprb.cloud.layout.offsets` reads it."""
    place: ClassVar[str]
    """Global name by which its functions know where its rows begin."""
    look: ClassVar[Callable[..., None]]
    """``look(flow, s, i, step, rest, medium, coefficients)``: store what it needs to know around the particle
    in lane i, before each step h, in the tracking step of that number, of which as much (s) is left; once
    more at the end of a call, where the integrator then finds the last rates. The lane's x and t are those of
    the start of h."""
    prepare: ClassVar[Callable[..., None] | None] = None
    """As ``disturb``, before that of any model: for what others ask of this one."""
    disturb: ClassVar[Callable[..., None]]
    """``disturb(block, medium, share, coefficients)``: change the rows u and l of all lanes. The lanes are at
    x + share·(new_x − x), with the shape new_F; frames and integrals are its own."""

    turbulent: ClassVar[bool] = False
    """Whether it needs k and ε of the flow."""
    needs: ClassVar[tuple[str, ...]] = ()
    """Kernels of a flow (:class:`foamprb.flow.base.Flow`) without which it cannot be."""

    @classmethod
    def stages(cls) -> tuple[Callable[..., None], ...]:
        """What is compiled once for all flows."""
        return (cls.disturb,) if cls.prepare is None else (cls.prepare, cls.disturb)

    @property
    def sight(self) -> float:
        """Distance to which it asks the flow for walls, in radii of a particle."""
        return 0.0

    def seen(self, patches: Sequence[Patch]) -> Sequence[int]:  # noqa: ARG002
        """Which of the flow's patches it asks for."""
        return ()

    def coefficients(self, patches: Sequence[Patch]) -> Any:  # noqa: ARG002
        """What its functions read: a tuple of numbers and arrays, of the same types for any patches."""
        return ()

    def bindings(self, inertia: bool) -> Mapping[str, Callable[..., Any]]:  # noqa: ARG002
        """Functions by the names by which they are called, for an integrator with or without inertia."""
        return {}

    def refuses(self, inertia: bool, integrator: str) -> str:  # noqa: ARG002
        """Why it does not go with an integrator of that name, with or without inertia; empty if it does."""
        return ""

    def check(self, patches: Sequence[Patch]) -> None:  # noqa: ARG002
        """Raise InputError if its entries name what is not among the flow's patches."""
        return

    def notes(self, p: Particles, arrays: Any, flow: Flow) -> Sequence[str]:  # noqa: ARG002
        """What a user should read before a run, line by line; ``arrays`` are what the flow's kernels read."""
        return ()

    def warnings(self, p: Particles, flow: Flow, medium: Medium, dt: float) -> Sequence[str]:  # noqa: ARG002
        """What a user should be warned of before a run with steps Δt (s), sentence by sentence."""
        return ()

    def summary(self, p: Particles, dt: float) -> Sequence[str]:  # noqa: ARG002
        """What a user should read after a run with steps Δt (s), line by line."""
        return ()

    def __str__(self) -> str:
        """The entries, for the log: ``(cutOff 10, strain yes)``."""
        values = ((field.name, getattr(self, field.name)) for field in fields(self))
        named = [f"{name} {_written(value)}" for name, value in values if value is not None]
        return f"({', '.join(named)})" if named else ""


def _written(value: Any) -> str:
    """An entry's value as a dictionary has it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    return f"({' '.join(value)})" if isinstance(value, tuple) else f"{value:g}"
