"""Outlines of passing particles, as in the images of a deformability cytometer."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloudfunctions.base import Memory, ObservedCloud, columns, names_of
from foamprb.cloudfunctions.crossings import PlaneFunction, unit
from foamprb.dictionary.constraints import Meaning, Vector3
from foamprb.errors import InputError
from foamprb.results.tables import write_table

__all__ = ["DeformabilityCytometry", "Outline", "outline"]

Floats = NDArray[np.float64]


class Outline(NamedTuple):
    """Shadows of bodies on a plane: ellipses."""

    area: Floats
    """(n,), m²."""
    perimeter: Floats
    """(n,), m."""
    semi_axes: Floats
    """(n, 2), the longer one first, m."""

    @property
    def deformation(self) -> Floats:
        """1 − 2 √(πA)/P, (n,): 0 for a circle (Mietke et al. 2015)."""
        return np.asarray(1.0 - 2.0 * np.sqrt(np.pi * self.area) / self.perimeter)


def outline(B: Floats, view: Floats) -> Outline:
    """Return the shadows of ellipsoids.

    Parameters
    ----------
    B
        R² F Fᵀ, (n, 3, 3), m²: its eigenvalues are the squares of the semi-axes.
    view
        Unit vector of the viewing direction, (3,).

    The shadow of {x: x·B⁻¹x ≤ 1} on the plane with the basis P is the ellipse of P B Pᵀ.
    """
    from scipy.special import ellipe

    other = np.eye(3)[int(np.argmin(np.abs(view)))]
    first = np.cross(view, other)
    first /= np.linalg.norm(first)
    basis = np.stack([first, np.cross(view, first)])
    squares = np.linalg.eigvalsh(np.einsum("ai,nij,bj->nab", basis, B, basis))[:, ::-1]
    a, b = np.sqrt(squares).T
    return Outline(
        np.pi * a * b, 4.0 * a * ellipe(1.0 - squares[:, 1] / squares[:, 0]), np.stack([a, b], axis=1)
    )


@dataclass(frozen=True)
class DeformabilityCytometry(PlaneFunction):
    """Outline in a camera of each particle that crosses a plane: ``cytometry.csv``.

    Area A and perimeter P of the shadow along ``view``, its semi-axes and the deformation 1 − 2√(πA)/P, at
    the place and time of the crossing, which are computed as by ``particleCollector``.
    """

    origin: Annotated[Vector3, Meaning("a point of the plane", "m")]
    normal: Annotated[Vector3, Meaning("its normal, of any length", "1")]
    view: Annotated[Vector3, Meaning("viewing direction of the camera, of any length", "1")]

    def __post_init__(self) -> None:
        super().__post_init__()
        if not any(self.view):
            raise InputError("has a view (0 0 0)")

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the table of all crossings."""
        p, t, x, sense = self.crossings(memory, cloud)
        F = p.F.reshape(-1, 3, 3)
        seen = outline(p.R[:, None, None] ** 2 * F @ F.transpose(0, 2, 1), unit(self.view))
        write_table(
            folder / "cytometry.csv",
            {"id": p.number, "injector": names_of(cloud.names["injector"], p.injector), "t": t,
             **columns("xyz", x), "direction": sense.astype(np.int64), "area": seen.area,
             "perimeter": seen.perimeter, **columns("ab", seen.semi_axes), "deformation": seen.deformation},
        )  # fmt: skip
