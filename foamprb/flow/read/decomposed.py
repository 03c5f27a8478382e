"""Cases in processor folders, joined in memory: in the order of before they were cut, if it is recorded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import PolyMesh
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.case import (
    MissingFieldError,
    mesh_files,
    mesh_folder,
    regions,
    require_choice,
    require_region,
)
from foamprb.flow.read.field import FoamField, Kind, read_field
from foamprb.flow.read.foamfile import Labels
from foamprb.flow.read.openfoam import Case
from foamprb.flow.read.processors import (
    JOINED,
    Address,
    Processors,
    checked,
    found_addresses,
    join_fields,
    join_meshes,
    join_zones,
    read_addresses,
    read_pieces,
    whole_patches,
)
from foamprb.flow.read.times import choose_times, pick_time


class DecomposedCase(Case):
    """Case in processor folders."""

    def __init__(self, root: Path, region: str = "") -> None:
        super().__init__(root, region)
        self.processors = Processors(root)
        self._first = self.processors.folders[0]
        names = self.regions()
        require_region(root, region, names)
        self._times, note = self.processors.times()
        if not region and existing(mesh_folder(self._first, self._times[-1], "") / "faces") is None:
            require_choice(root, names)
        self._files: tuple[Path, ...] = ()
        self._poly: PolyMesh | None = None
        self._parts: list[Address] = []
        self._mesh_notes: list[str] = []
        self._patches: list[PatchInfo] = []
        self._ranges: Labels = np.zeros(1, dtype=np.int64)
        self.notes = (f"The flow was put together from {self.processors.n} processor folders.", note)[
            : 1 + bool(note)
        ]

    @property
    def roots(self) -> Sequence[Path]:
        """The folders of the processors."""
        return self.processors.folders

    def times(self) -> tuple[str, ...]:
        """Return the names of the times of all processors."""
        return self._times

    def select_time(self, time: float | str) -> str:
        """Return the name of a time; see :func:`foamprb.flow.read.times.pick_time`."""
        return self._times[pick_time(self.root, self._times, time)]

    def select_times(self, selection: str | None) -> tuple[str, ...]:
        """Return the names of times; see :func:`foamprb.flow.read.times.choose_times`."""
        return choose_times(self.root, self._times, selection)

    def folder(self, time: str) -> Path:
        """Return the folder of the first processor's fields at a time."""
        return self._first / time / self.region

    def mesh_folder(self, time: str) -> Path:
        """Return the folder of the first processor's mesh at a time."""
        return mesh_folder(self._first, time, self.region)

    def regions(self) -> tuple[str, ...]:
        """Return the names of all regions."""
        return regions(self._first)

    def field(self, time: str, name: str, kind: Kind) -> FoamField:
        """Read a field at a time of all processors, and join it; InputError if one is missing or broken."""
        files = self.processors.files(Path(time) / self.region / name)
        if files is None:
            raise MissingFieldError(f"{self.folder(time) / name}: no such file.")
        self._open(time)
        fields = [
            checked(read_field(file, kind, self.root), part)
            for file, part in zip(files, self._parts, strict=True)
        ]
        return join_fields(self._parts, fields, self._patches, self._ranges)

    def zones(self, time: str) -> Mapping[str, NDArray[np.int64]]:
        """Read the cells of each zone by name; InputError if a file is broken."""
        self._open(time)
        return join_zones(self.processors, self.mesh_folder(time), self._parts)

    def poly(self, time: str | None) -> tuple[PolyMesh, tuple[PatchInfo, ...], list[str]]:
        """Join points, faces and patches at a time; see :meth:`Case.poly`."""
        self._open(time)
        poly, self._poly = self._poly, None
        if poly is None:
            self._files = ()
            return self.poly(time)
        return poly, tuple(self._patches), self._mesh_notes

    def points(self, time: str) -> Floats:
        """Return the points of the joined mesh at a time, (n_points, 3), m."""
        return self.poly(time)[0].points

    def _open(self, time: str | None) -> None:
        """Read and join the mesh at a time, unless it is that of the last call."""
        files = mesh_files(self._first, time, self.region)
        if files == self._files:
            return
        pieces = read_pieces(self.processors, files, self.root)
        parts = read_addresses(self.processors, files[1].parent, pieces)
        self._mesh_notes = [] if parts else [JOINED]
        parts = parts or found_addresses(pieces)
        self._patches, self._ranges = whole_patches(self.root, parts)
        self._poly = join_meshes(self.root, pieces, parts, self._patches, self._ranges)
        self._parts, self._files = parts, files
