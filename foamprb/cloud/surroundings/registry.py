"""The models of the surroundings, by the names of their entries in ``particleForces``."""

from __future__ import annotations

from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.wall_lift import WallLift

__all__ = ["SURROUNDINGS"]

SURROUNDINGS: dict[str, type[Surrounding]] = {
    "faxenCorrection": FaxenCorrection,
    "wallLift": WallLift,
    "BrownianMotion": BrownianMotion,
}
"""In the order in which those that are chosen act, whatever their order in the settings."""
