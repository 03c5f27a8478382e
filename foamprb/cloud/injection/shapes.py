"""Shapes at rest: spheres, and ellipsoids of the same volume.

A new shape is a frozen dataclass of its entries and a line in :data:`SHAPES`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Particles, set_rest_shape
from foamprb.dictionary.constraints import Meaning, Positive3, Vector3
from foamprb.dictionary.schema import read_model
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """A shape at rest, of the volume of the sphere whose diameter the size distribution gives."""

    def form(self, p: Particles, random: np.random.Generator) -> None:
        """Change spheres at rest into this shape, in which they start."""

    @staticmethod
    def from_dictionary(dictionary: Dictionary) -> Shape:
        """Read ``{ type ellipsoid; … }``."""
        return read_model(SHAPES, dictionary)


@dataclass(frozen=True)
class Sphere(Shape):
    """Spheres, whose diameter is that of the size distribution."""


@dataclass(frozen=True)
class Ellipsoid(Shape):
    """Ellipsoids with the volume of the sphere whose diameter the size distribution gives.

    Their semi-axes are in the proportion ``axisRatios``. The first lies along ``e1``, the second in the plane
    of ``e1`` and ``e2``; or all directions are equally likely.
    """

    axisRatios: Annotated[Vector3, Positive3, Meaning("semi-axes up to a common factor, `(2 1 1)`", "1")]
    orientation: Annotated[
        Literal["axes", "random"], Meaning("`axes`, or `random`: all directions are equally likely")
    ] = "axes"
    e1: Annotated[Vector3, Meaning("the first semi-axis lies along it", "1")] = (1.0, 0.0, 0.0)
    e2: Annotated[Vector3, Meaning("the second lies in the plane of `e1` and `e2`", "1")] = (0.0, 1.0, 0.0)

    def __post_init__(self) -> None:
        first, second = _scaled(self.e1), _scaled(self.e2)
        sine = np.linalg.norm(np.cross(first, second))
        if not sine > 1e-6 * np.linalg.norm(first) * np.linalg.norm(second):
            raise InputError("gives no orientation: e1 and e2 are parallel")

    def axes(self) -> Floats:
        """Return unit vectors along the semi-axes as rows of a rotation, (3, 3)."""
        first, second = _scaled(self.e1), _scaled(self.e2)
        third = np.cross(first, second)
        rows = np.array([first, np.cross(third, first), third])
        unit: Floats = rows / np.linalg.norm(rows, axis=1, keepdims=True)
        return unit

    def form(self, p: Particles, random: np.random.Generator) -> None:
        """Change spheres at rest into ellipsoids."""
        from scipy.spatial.transform import Rotation

        if self.orientation == "random":
            # A normal distribution of four components has no preferred direction.
            axes = Rotation.from_quat(random.standard_normal((p.size, 4))).as_matrix()
        else:
            axes = self.axes()
        set_rest_shape(p, self.axisRatios, axes)


def _scaled(v: Vector3) -> Floats:
    """Return a vector with 1 for its largest component, whose powers do not overflow; zero stays zero."""
    return np.array(v) / (max(map(abs, v)) or 1.0)


SHAPES: dict[str, type[Shape]] = {"sphere": Sphere, "ellipsoid": Ellipsoid}
"""By the word that ``type`` selects."""
