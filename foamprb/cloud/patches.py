"""Interactions of particles with patches: OpenFOAM's models, with its entries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Protocol

from foamprb.body.tensor import Scalar, Vector, inner, select
from foamprb.dictionary.constraints import Fraction, Meaning, NonNegative
from foamprb.dictionary.schema import Schema

STICK, ESCAPE, REBOUND, MIRROR, CYCLIC = 0, 1, 2, 3, 4


class Interaction(Schema, Protocol):
    """Interaction with a patch, which the particle loop selects by its code."""

    code: ClassVar[int]


@dataclass(frozen=True)
class Stick:
    """Sticking: the particle stays where it touches the patch."""

    code: ClassVar[int] = STICK


@dataclass(frozen=True)
class Escape:
    """Escape: the particle leaves the domain when its centre crosses the patch."""

    code: ClassVar[int] = ESCAPE


@dataclass(frozen=True)
class Rebound:
    """Rebound with restitution ``e`` normal to the patch and friction ``mu`` along it."""

    e: Annotated[float, Fraction, Meaning("restitution, normal to the patch", "1")] = 1.0
    mu: Annotated[float, NonNegative, Meaning("friction, along the patch", "1")] = 0.0
    code: ClassVar[int] = REBOUND


@dataclass(frozen=True)
class Mirror:
    """Reflection: the particle's mirror image enters, velocity and shape, when its centre meets the plane."""

    code: ClassVar[int] = MIRROR


@dataclass(frozen=True)
class Cyclic:
    """Periodicity: the particle enters by the neighbouring patch when its centre meets this one."""

    code: ClassVar[int] = CYCLIC


INTERACTIONS: dict[str, type[Interaction]] = {
    "stick": Stick,
    "escape": Escape,
    "rebound": Rebound,
}
"""Interactions that users select; the others follow from the type of the patch."""


def rebound_velocity(v: Vector, n: Vector, e: Scalar, mu: Scalar) -> Vector:
    """Return the velocity after a rebound, as OpenFOAM's ``rebound`` computes it.

    Parameters
    ----------
    v, n
        Velocity before, m/s, and the wall's unit normal into the fluid.
    e, mu
        The normal part of v is reversed and multiplied by e, the tangential part by 1 − mu; a particle
        that already moves away from the wall keeps its velocity.
    """
    vn = inner(v, n)
    approaching = vn < 0.0
    change = select(approaching, -(1.0 + e - mu) * vn, 0.0)
    keep = select(approaching, 1.0 - mu, 1.0)
    return (keep * v[0] + change * n[0], keep * v[1] + change * n[1], keep * v[2] + change * n[2])
