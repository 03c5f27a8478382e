"""Names for :doc:`user-defined models </own-models>`: rows of a block, bounds of entries, stages."""

from foamprb.cloud.block import at, load3, load9, store3, store9
from foamprb.cloud.layout import LANES, Row, offsets
from foamprb.cloud.surroundings.base import Remarks, Stage, Survey
from foamprb.dictionary.constraints import Bounds, NonNegative, Positive

__all__ = [
    "LANES",
    "Bounds",
    "NonNegative",
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
