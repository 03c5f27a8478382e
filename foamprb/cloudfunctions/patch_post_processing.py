"""The particles that end on patches."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import MEASURES
from foamprb.cloud.patches import REBOUND
from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import STATUS_NAMES, Memory, ObservedCloud
from foamprb.cloudfunctions.rows import columns, masses, names_of
from foamprb.dictionary.constraints import AtLeastOne, Meaning, Words
from foamprb.errors import InputError, suggestion
from foamprb.output.names import file_name
from foamprb.output.tables import write_table

__all__ = ["PatchPostProcessing"]

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PatchPostProcessing:
    """The particles that stick to a patch or leave through it: when, where, in what shape: ``<patch>.csv``.

    ``impactAngle`` is the angle between the velocity and the normal out of the fluid, ``axisAngle`` that
    between the longest axis and the normal, both in degrees. A rebound is not recorded.
    """

    patches: Annotated[Words, Meaning("`(name name)`")]
    maxStoredParcels: (
        Annotated[int, AtLeastOne, Meaning("only the first of each patch", default="all")] | None
    ) = None

    @property
    def interval(self) -> int:
        """The write times are enough: what has ended stays as it is."""
        return 0

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Check the names of the patches; nothing is remembered.

        Raises
        ------
        InputError
            If there is no such patch, or particles bounce off it.
        """
        for name in self.patches:
            if name not in cloud.patches:
                raise InputError(f"patch {name} is not in the mesh. {suggestion(name, cloud.patches)}")
            if cloud.cloud.interactions[cloud.patches.index(name)].code == REBOUND:
                raise InputError(
                    f"patch {name}: particles bounce off it, but only those that stick or escape are seen."
                )
        return {}

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Leave all to :meth:`write`."""

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:  # noqa: ARG002
        """Write a table for each patch, in the order of time."""
        p = cloud.particles
        for name in self.patches:
            ended = (p.status == Status.STUCK) | (p.status == Status.ESCAPED)
            rows = np.flatnonzero(ended & (p.patch == cloud.patches.index(name)))
            rows = rows[np.argsort(p.t[rows], kind="stable")][: self.maxStoredParcels]
            axes, D, longest = cloud.collect(
                rows,
                MEASURES["semiAxes"].value,
                MEASURES["taylorDeformation"].value,
                lambda c: np.stack(c.frame[:3], axis=1),
            )
            n = cloud.cloud.contact_normals(rows)
            write_table(
                folder / f"{file_name(name)}.{cloud.tables}",
                {
                    "id": rows, "injector": names_of(cloud.injectors, p.injector[rows]),
                    "fate": names_of(STATUS_NAMES, p.status[rows]), "t": p.t[rows],
                    **columns("xyz", p.x[rows]), **columns(("Ux", "Uy", "Uz"), p.v[rows]),
                    "d": 2.0 * p.R[rows], "mass": masses(p, rows), "Ca": p.Ca[rows],
                    **columns("abc", axes), "D": D,
                    "impactAngle": _angle(p.v[rows], -n), "axisAngle": _axis_angle(longest, n),
                },
            )  # fmt: skip


def _angle(a: Floats, b: Floats) -> Floats:
    """Return the angles between vectors (n, 3), degrees; NaN where one of them has no direction."""
    length = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        cosine = np.einsum("ni,ni->n", a, b) / length
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _axis_angle(a: Floats, b: Floats) -> Floats:
    """Return the angles between axes and vectors (n, 3), up to 90 degrees."""
    angle = _angle(a, b)
    return np.minimum(angle, 180.0 - angle)
