"""A named piece of the boundary."""

from __future__ import annotations

from typing import NamedTuple


class Patch(NamedTuple):
    """A patch's name and its OpenFOAM type: wall, patch, symmetryPlane, wedge, …."""

    name: str
    type: str
