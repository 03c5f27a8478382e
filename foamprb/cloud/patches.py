"""Interactions of particles with patches: OpenFOAM's models, with its entries."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Protocol

from foamprb.body.bonds import sensitivity
from foamprb.body.tensor import Scalar, Vector, inner, select
from foamprb.dictionary.constraints import Fraction, Meaning, NonNegative, Positive, Seed
from foamprb.dictionary.schema import Schema
from foamprb.errors import InputError

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


@dataclass(frozen=True, kw_only=True)
class Adhere:
    """Adhesion by bonds: the particle slides along the patch until it sticks, and may come off again."""

    kOn: Annotated[float, NonNegative, Meaning("rate at which a bond forms in contact", "1/s")]
    kOff: Annotated[float, NonNegative, Meaning("rate at which it breaks without a force", "1/s")]
    xb: Annotated[float, NonNegative, Meaning("reactive length, the rate is kOff exp(F xb/kT)", "m")] = 0.0
    T: Annotated[float | None, Positive, Meaning("temperature", "K", "with `xb` required")] = None
    criticalShearRate: Annotated[
        float | None,
        Positive,
        Meaning("of the fluid, above which nothing sticks", "1/s", "none"),
    ] = None
    mu: Annotated[float, NonNegative, Meaning("friction, along the patch", "1")] = 0.0
    seed: Seed = 1
    code: ClassVar[int] = REBOUND

    def __post_init__(self) -> None:
        if self.xb > 0.0 and self.T is None:
            raise InputError("has the reactive length xb, which needs the temperature T")

    @property
    def breaks(self) -> bool:
        """Whether bonds may break."""
        return self.kOff > 0.0 or self.criticalShearRate is not None

    def bond(self, mu_f: Any) -> tuple[float, ...]:
        """Return its row of :attr:`foamprb.cloud.motion.PatchTable.bonds`; mu_f is the viscosity, Pa s."""
        per_force = 0.0
        if self.T is not None and self.xb > 0.0:
            if not isinstance(mu_f, float | int):
                raise InputError("adhere has xb, which needs a constant viscosity of the fluid: give mu")
            per_force = mu_f * sensitivity(self.xb, self.T)
        limit = math.inf if self.criticalShearRate is None else self.criticalShearRate
        return self.kOn, self.kOff, per_force, limit, float(self.seed)


def stopping(interactions: Sequence[Interaction]) -> list[int]:
    """Return the indices of the patches that stop a body."""
    return [i for i, action in enumerate(interactions) if action.code in (STICK, REBOUND)]


NO_BOND = (-1.0, 0.0, 0.0, math.inf, 0.0)
"""The same of a patch without bonds."""


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
    "adhere": Adhere,
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
