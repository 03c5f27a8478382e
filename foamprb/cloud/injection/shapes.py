"""Shapes at rest: spheres, and ellipsoids of the same volume."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from foamprb.cloud.state import Particles, set_rest_shape
from foamprb.dictionary.constraints import Positive3, Vector3

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sphere:
    """Spheres, whose diameter is that of the size distribution."""

    def form(self, p: Particles, random: np.random.Generator) -> None:
        """Leave the particles as they are."""


@dataclass(frozen=True)
class Ellipsoid:
    """Ellipsoids with the volume of the sphere whose diameter the size distribution gives.

    Their semi-axes are in the proportion ``axisRatios``. The first lies along ``e1``, the second in the plane
    of ``e1`` and ``e2``; or their directions are random, each as likely as any other.
    """

    axisRatios: Annotated[Vector3, Positive3]
    orientation: Literal["axes", "random"] = "axes"
    e1: Vector3 = (1.0, 0.0, 0.0)
    e2: Vector3 = (0.0, 1.0, 0.0)

    def axes(self) -> Floats:
        """Unit vectors along the semi-axes as rows of a rotation, (3, 3).

        Raises
        ------
        ValueError
            If ``e1`` and ``e2`` are parallel, or one is zero.
        """
        first, second = np.array(self.e1), np.array(self.e2)
        third = np.cross(first, second)
        if not np.linalg.norm(third) > 1e-6 * np.linalg.norm(first) * np.linalg.norm(second):
            raise ValueError("e1 and e2 are parallel")
        rows = np.array([first, np.cross(third, first), third])
        unit: Floats = rows / np.linalg.norm(rows, axis=1, keepdims=True)
        return unit

    def form(self, p: Particles, random: np.random.Generator) -> None:
        """Give the particles their shape at rest, in which they start."""
        if self.orientation == "random":
            # A normal distribution of four components has no preferred direction.
            axes = Rotation.from_quat(random.standard_normal((p.size, 4))).as_matrix()
        else:
            axes = self.axes()
        set_rest_shape(p, self.axisRatios, axes)


Shape = Sphere | Ellipsoid

SHAPES: dict[str, type[Shape]] = {"sphere": Sphere, "ellipsoid": Ellipsoid}
