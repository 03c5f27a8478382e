"""A named piece of the boundary."""

from __future__ import annotations

from typing import NamedTuple

WALLS = frozenset({"wall", "mappedWall"})
"""The types of patches that are walls: also those to which another region's wall fits."""


class Patch(NamedTuple):
    """A patch's name and its OpenFOAM type: wall, patch, symmetryPlane, wedge, …."""

    name: str
    type: str
    neighbour: str = ""
    """The patch to which a particle goes on that meets this one, if the two are coupled."""
