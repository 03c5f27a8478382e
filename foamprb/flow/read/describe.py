"""What a case holds, for a person to read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from foamprb.flow.base import Floats
from foamprb.flow.mesh.cells import CELL_KINDS
from foamprb.flow.mesh.lists import cell_types, points_of
from foamprb.flow.read.boundary import PatchInfo, read_boundary
from foamprb.flow.read.case import available_times, fields_of, mesh_files, mesh_folder, regions, require_case
from foamprb.flow.read.checks import noted_counts, require_labels
from foamprb.flow.read.vtk_reader import raise_first_error, read_blocks


class TimeInfo(NamedTuple):
    """A time directory: its name as OpenFOAM wrote it, and its fields by name with their classes."""

    name: str
    fields: dict[str, str]


@dataclass(frozen=True)
class CaseInfo:
    """What a case holds."""

    case: Path
    times: tuple[TimeInfo, ...]
    patches: tuple[PatchInfo, ...]
    points: int
    cells: dict[str, int]
    """Number of cells of each kind."""
    bounds: tuple[Floats, Floats]
    """Lowest and highest coordinates, m."""
    region: str = ""
    """The region that this is about."""
    regions: tuple[str, ...] = ()
    """All regions."""

    def lines(self) -> list[str]:
        """The same for a person to read."""
        low, high = ("({:g} {:g} {:g})".format(*corner) for corner in self.bounds)
        return [
            f"Case    {self.case}",
            *([f"Region  {self.region}"] if self.region else []),
            *([f"Regions {', '.join(self.regions)}"] if self.regions else []),
            "",
            "Mesh",
            f"    {'points':20s} {self.points:10d}",
            *(f"    {kind:20s} {n:10d}" for kind, n in self.cells.items()),
            f"    {'bounds [m]':20s} {low} {high}",
            "",
            "Patches",
            *(f"    {patch.name:20s} {patch.faces:10d} faces  {patch.type}" for patch in self.patches),
            "",
            "Times and fields",
            *(
                f"    {time.name:20s} " + ", ".join(f"{name} ({kind})" for name, kind in time.fields.items())
                for time in self.times
            ),
        ]


def describe(case: Path, region: str = "") -> CaseInfo:
    """Tell what a case, or a region of it, holds, without reading a field.

    Raises
    ------
    InputError
        The folder is no case, or its mesh cannot be read.
    """
    require_case(case, region)
    names = available_times(case)
    times = tuple(TimeInfo(name, fields_of(case / name / region)) for name in names)
    folder = mesh_folder(case, names[-1] if names else None, region)
    patches = read_boundary(folder / "boundary", case)
    require_labels(folder, noted_counts(folder))
    files = mesh_files(case, names[-1] if names else None, region)
    blocks, messages = read_blocks(files, patches=False)
    raise_first_error(folder, messages)
    grid = blocks["internalMesh"]
    kinds = np.bincount(cell_types(grid), minlength=256)
    cells = {
        CELL_KINDS.get(number, f"VTK type {number}"): int(kinds[number])
        for number in np.flatnonzero(kinds).tolist()
    }
    points = points_of(grid).astype(np.float64)
    bounds = (points.min(axis=0), points.max(axis=0))
    return CaseInfo(case, times, patches, len(points), cells, bounds, region, regions(case))
