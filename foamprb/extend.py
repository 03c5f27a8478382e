"""Names for :doc:`user-defined models </own-models>`: rows of a block, bounds, stages, the cloud."""

from foamprb.cloud.block import at, load3, load9, store3, store9
from foamprb.cloud.layout import LANES, Row, offsets
from foamprb.cloud.surroundings.base import Remarks, Stage, Survey
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.dictionary.constraints import Bounds, NonNegative, Positive

__all__ = [
    "LANES",
    "Bounds",
    "NonNegative",
    "ObservedCloud",
    "Positive",
    "Remarks",
    "Row",
    "Stage",
    "Survey",
    "at",
    "load3",
    "load9",
    "offsets",
    "store3",
    "store9",
]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return sorted(__all__)
