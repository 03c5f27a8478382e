"""Outlines of passing particles, as in the images of a deformability cytometer."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloudfunctions.base import (
    Memory,
    ObservedCloud,
    Rows,
    SampleInterval,
    append,
    columns,
    names_of,
    per_event,
)
from foamprb.cloudfunctions.crossings import PlaneFunction, crossings, unit
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
    the place and time of the crossing, which are computed as by ``particleCollector``. Between samples the
    shape is linear in time.
    """

    origin: Annotated[Vector3, Meaning("a point of the plane", "m")]
    normal: Annotated[Vector3, Meaning("its normal, of any length", "1")]
    view: Annotated[Vector3, Meaning("viewing direction of the camera, of any length", "1")]
    sampleInterval: SampleInterval = 1

    arrays: ClassVar = {**PlaneFunction.arrays, "seen": per_event}

    def __post_init__(self) -> None:
        super().__post_init__()
        if not any(self.view):
            raise InputError("has a view (0 0 0)")

    def initial(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return an empty table."""
        return {"seen": np.empty((0, 11))}

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Add the particles that have changed sides since the last sample."""
        p = cloud.particles
        crossed = crossings(memory, now, rows, np.array(self.origin), unit(self.normal))
        at, s = crossed.rows, crossed.share[:, None]
        F = ((1.0 - s) * memory["F"][at] + s * now["F"][crossed.among]).reshape(-1, 3, 3)
        seen = outline(p.R[at, None, None] ** 2 * F @ F.transpose(0, 2, 1), unit(self.view))
        shadow = seen.area, seen.perimeter, seen.semi_axes, seen.deformation
        new = np.column_stack([p.number[at], crossed.time, crossed.x, crossed.sense, *shadow])
        append(memory, "seen", new[np.argsort(new[:, 1], kind="stable")])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the table of all crossings."""
        seen = memory["seen"]
        rows = seen[:, 0].astype(np.int64)
        injector = names_of(cloud.names["injector"], cloud.cloud.values_of(rows, "injector"))
        names = ("area", "perimeter", "a", "b", "deformation")
        write_table(
            folder / "cytometry.csv",
            {"id": rows, "injector": injector,
             "t": seen[:, 1], **columns("xyz", seen[:, 2:5]), "direction": seen[:, 5].astype(np.int64),
             **columns(names, seen[:, 6:])},
        )  # fmt: skip
