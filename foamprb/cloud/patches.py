"""What a patch does to a particle that meets it: OpenFOAM's patch interaction models, with its entries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Protocol

from foamprb.body.tensor import Scalar, Vector, inner, select
from foamprb.dictionary.constraints import Fraction, Meaning, NonNegative
from foamprb.dictionary.schema import Schema

STICK, ESCAPE, REBOUND, MIRROR, CYCLIC = 0, 1, 2, 3, 4


class Interaction(Schema, Protocol):
    """What a patch does to a particle; the particle loop acts on the code."""

    code: ClassVar[int]


@dataclass(frozen=True)
class Stick:
    """The particle stays where it touches the patch."""

    code: ClassVar[int] = STICK


@dataclass(frozen=True)
class Escape:
    """The particle leaves the domain through the patch, when its centre does."""

    code: ClassVar[int] = ESCAPE


@dataclass(frozen=True)
class Rebound:
    """The particle bounces off: restitution ``e`` normal to the patch, friction ``mu`` along it."""

    e: Annotated[float, Fraction, Meaning("restitution, normal to the patch", "1")] = 1.0
    mu: Annotated[float, NonNegative, Meaning("friction, along the patch", "1")] = 0.0
    code: ClassVar[int] = REBOUND


@dataclass(frozen=True)
class Mirror:
    """The particle's mirror image comes in, velocity and shape, when its centre meets the plane."""

    code: ClassVar[int] = MIRROR


@dataclass(frozen=True)
class Cyclic:
    """The particle goes on from the neighbouring patch when its centre meets this one."""

    code: ClassVar[int] = CYCLIC


INTERACTIONS: dict[str, type[Interaction]] = {
    "stick": Stick,
    "escape": Escape,
    "rebound": Rebound,
}
"""What a user may choose; the others follow from the type of the patch."""


def rebound_velocity(v: Vector, n: Vector, e: Scalar, mu: Scalar) -> Vector:
    """Velocity after a bounce, as OpenFOAM's ``rebound`` has it.

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
