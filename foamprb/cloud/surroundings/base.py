"""What a model of the surroundings is: entries in the settings, and two plain functions on a block."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

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
    """``look(flow, s, i, step, dt, medium, coefficients)``: store what it needs to know around the particle
    in lane i, before each step h, and once more at the end, in the tracking step of that number and size Δt,
    s. The lane's x and t are those of the start of h."""
    disturb: ClassVar[Callable[..., None]]
    """``disturb(block, medium, predicted, coefficients)``: change the rows u and l of all lanes. The state of
    the lanes is that of the start of h or, where ``predicted``, new_x and new_F; frames and integrals are
    those of new_F in both."""

    @property
    def coefficients(self) -> Any:
        """What its functions read of the entries, a tuple of numbers."""
        return ()

    @property
    def bindings(self) -> Mapping[str, Callable[..., Any]]:
        """Functions of its own, by the names by which others call them."""
        return {}
