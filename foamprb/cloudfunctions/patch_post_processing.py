"""Particles that end on patches or bounce off them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.communicator import parts_of
from foamprb.cloud.contact import Rebounds, in_order, rebounds_of
from foamprb.cloud.patches import REBOUND, Interaction
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    CloudFunction,
    ContactObserver,
    Memory,
    ObservedCloud,
    columns,
    masses,
    names_of,
    table,
)
from foamprb.dictionary.constraints import AtLeastOne, Meaning, Words
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import patches_named
from foamprb.results.folder import file_name
from foamprb.results.tables import Rows, rows_of, write_rows

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PatchPostProcessing(CloudFunction, ContactObserver):
    """Time, place, velocity and shape of particles that meet a patch: ``<patch>.csv``.

    There is a row for each particle that sticks to the patch or leaves through it, and for each ``rebound``,
    with the velocity before. A body that rolls or slides along the wall has one rebound, at its arrival.
    ``impactAngle`` is the angle between the velocity and the normal out of the fluid, ``axisAngle`` the angle
    between the longest axis and the normal, both in degrees.
    """

    patches: Annotated[Words, Meaning("`(name name)`: names, groups or regular expressions")]
    maxStoredParcels: Annotated[
        int | None, AtLeastOne, Meaning("only the first of each patch", default="all")
    ] = None

    arrays: ClassVar = {"rebounds": table}

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Check the names of the patches; return an empty table of rebounds if particles bounce off one.

        Raises
        ------
        InputError
            If there is no such patch, or the cloud does not record the rebounds from it.
        """
        names = cloud.names["patch"]
        for name in self.patches:
            if not _patches_named(cloud, name):
                raise InputError(f"patch {name} is not in the mesh. {suggestion(name, names)}")
        bouncing = self._bouncing(cloud)
        if bouncing and not cloud.cloud.models.rebounds:
            raise InputError(
                f"patch {names[bouncing[0]]}: particles bounce off it, which is recorded if the "
                "models have rebounds=True"
            )
        return {"rebounds": in_order([])} if bouncing else {}

    def needs_rebounds(self, interactions: Mapping[str, Interaction]) -> bool:
        """Return whether particles bounce off one of the patches."""
        # A word that is no name may be that of a group.
        words = not interactions.keys() >= set(self.patches)
        return any(i.code == REBOUND for name, i in interactions.items() if words or name in self.patches)

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Record the rebounds from these patches."""
        if bouncing := self._bouncing(cloud):
            mine = np.isin(rebounds_of(rows).patch, bouncing)
            memory["rebounds"] = np.concatenate([memory["rebounds"], rows[mine]])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write a table for each patch, in the order of time."""
        bouncing = self._bouncing(cloud)
        if bouncing:
            self._drop(memory, bouncing)
        met: Iterator[Rebounds]
        for patch in self._chosen(cloud):
            path = folder / f"{file_name(cloud.names['patch'][patch])}.csv"
            if patch in bouncing:
                records = rebounds_of(memory["rebounds"])
                mine = records.patch == patch
                met = (Rebounds(*(array[mine][part] for array in records)) for part in parts_of(mine.sum()))
            else:
                met = self._landings(cloud, patch)
            write_rows(path, (_rows_of(cloud, some, patch in bouncing) for some in met))

    def _chosen(self, cloud: ObservedCloud) -> list[int]:
        """Return the indices of the patches."""
        return list(dict.fromkeys(k for word in self.patches for k in _patches_named(cloud, word)))

    def _bouncing(self, cloud: ObservedCloud) -> list[int]:
        """Return the indices of the patches off which particles bounce."""
        return [patch for patch in self._chosen(cloud) if cloud.cloud.interactions[patch].code == REBOUND]

    def _drop(self, memory: Memory, bouncing: Sequence[int]) -> None:
        """Drop rebounds beyond ``maxStoredParcels``, when all particles are at the same time."""
        rows = in_order([memory["rebounds"]])
        patch = rebounds_of(rows).patch
        first_rows = [rows[patch == which][: self.maxStoredParcels] for which in bouncing]
        memory["rebounds"] = in_order(first_rows)

    def _landings(self, cloud: ObservedCloud, patch: int) -> Iterator[Rebounds]:
        """Yield the ends of particles on a patch in the order of time, in the form of rebounds."""
        numbers, times = map(np.concatenate, zip(*cloud.map(_landed, patch), strict=True))
        numbers = numbers[np.argsort(times, kind="stable")][: self.maxStoredParcels]
        for part in parts_of(len(numbers)):
            p = cloud.of(numbers[part]).particles
            n = cloud.cloud.contact_normals(p)
            yield Rebounds(p.number, p.patch.astype(np.int64), p.t, p.x, p.v, n, p.F)


def _landed(p: Particles, _memory: Memory, patch: int) -> tuple[NDArray[np.int64], Floats]:
    """Return numbers and times of the particles that have ended on a patch."""
    ended = (p.patch == patch) & ((p.status == Status.STUCK) | (p.status == Status.ESCAPED))
    return p.number[ended], p.t[ended]


def _rows_of(cloud: ObservedCloud, met: Rebounds, bounces: bool) -> Rows:
    """Return the rows of the table of a patch."""
    p = cloud.of(met.number).particles
    p.F[:] = met.F
    if bounces:
        # The frame that a particle has now would change last digits.
        p.Q[:] = np.eye(3).ravel()
    axes, D, longest = cloud.of(p).measure(
        np.arange(p.size), "semiAxes", "taylorDeformation", lambda c: np.stack(c.frame[:3], axis=1)
    )
    return rows_of(
        {
            "id": met.number, "injector": names_of(cloud.names["injector"], p.injector),
            "fate": ["rebound"] * p.size if bounces else names_of(STATUS_NAMES, p.status), "t": met.t,
            **columns("xyz", met.x), **columns(("Ux", "Uy", "Uz"), met.v),
            "d": 2.0 * p.R, "mass": masses(p, np.arange(p.size)), "Ca": p.Ca,
            **columns("abc", axes), "D": D,
            "impactAngle": _angle(met.v, -met.n), "axisAngle": _axis_angle(longest, met.n),
        }
    )  # fmt: skip


def _patches_named(cloud: ObservedCloud, word: str) -> list[int]:
    pairs = zip(cloud.cloud.flow.patches, cloud.names["patch"], strict=True)
    return patches_named([patch._replace(name=name) for patch, name in pairs], word)


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
