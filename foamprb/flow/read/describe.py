"""Contents of a case or a mesh file, for a person to read."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np

from foamprb.flow.base import Floats, Ints
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.fluid import describe_viscosity
from foamprb.flow.read.motion import moving_times
from foamprb.flow.read.openfoam import Case
from foamprb.flow.read.source import Division
from foamprb.flow.read.times import listed

_ALIKE = 4
"""Number of times with the same fields from which one line stands for them."""


class TimeInfo(NamedTuple):
    """Time directory: its name as OpenFOAM wrote it, and the classes of its fields by name."""

    name: str
    fields: dict[str, str]


@dataclass(frozen=True)
class CaseInfo:
    """Contents of a case."""

    case: Path
    times: tuple[TimeInfo, ...]
    patches: tuple[PatchInfo, ...]
    points: int
    cells: dict[str, int]
    """Number of cells of each kind."""
    bounds: tuple[Floats, Floats]
    """Lowest and highest coordinates, m."""
    region: str = ""
    """Region that is described."""
    regions: tuple[str, ...] = ()
    """All regions."""
    viscosity: tuple[str, ...] = ()
    """Lines about the viscosity of the fluid."""
    moving: tuple[str, ...] = ()
    """Times with points of their own."""
    remade: tuple[str, ...] = ()
    """Times with faces of their own."""

    def lines(self) -> list[str]:
        """Return the contents as lines of text."""
        return [
            f"Case    {self.case}",
            *([f"Region  {self.region}"] if self.region else []),
            *([f"Regions {', '.join(self.regions)}"] if self.regions else []),
            "",
            *_lines_of_mesh(self.points, self.cells, self.bounds),
            *(f"    {patch.name:20s} {patch.faces:10d} faces  {patch.type}" for patch in self.patches),
            "",
            *(
                ["Viscosity of the fluid", *(f"    {line}" for line in self.viscosity), ""]
                * bool(self.viscosity)
            ),
            "Times and fields",
            *self._lines_of_times(),
            *([f"    Points of the mesh, too: {listed(self.moving)}"] * bool(self.moving)),
            *([f"    Faces of the mesh, too: {listed(self.remade)}"] * bool(self.remade)),
        ]

    def _lines_of_times(self) -> list[str]:
        """Return a line for each time; one for many successive times with the same fields."""
        lines = []
        for fields, group in groupby(self.times, key=lambda time: time.fields):
            names = [time.name for time in group]
            if len(names) >= _ALIKE:
                names = [f"{names[0]} to {names[-1]} ({len(names)} times)"]
            text = ", ".join(f"{name} ({kind})" for name, kind in fields.items())
            lines += [f"    {name:20s} {text}" for name in names]
        return lines


def describe(case: Case) -> CaseInfo:
    """Return the contents of a case, without reading a field."""
    names = case.times()
    times = tuple(TimeInfo(name, case.fields(name)) for name in names)
    (points, faces, *_), patches, _ = case.poly(names[-1] if names else None)
    kinds = _kinds(faces.start, faces.owner, faces.neighbour, len(faces.first) - 1)
    bounds = points.min(axis=0), points.max(axis=0)
    folders = {name: case.folder(name) for name in names[1:]}
    moving, remade = (tuple(moving_times(folders, part)) for part in ("points", "faces"))
    viscosity = describe_viscosity(case.root, case.region, times[-1].fields if times else ())
    return CaseInfo(
        case.root, times, patches, len(points), kinds, bounds, case.region, case.regions(), tuple(viscosity),
        moving, remade,
    )  # fmt: skip


def describe_file(
    path: Path, velocity: str = "U", division: Division | None = None, scale: float = 1.0
) -> list[str]:
    """Return the contents of a mesh file as lines of text."""
    # Only mesh files need VTK.
    from foamprb.flow.read.meshfile import open_file
    from foamprb.flow.read.vtkfile import times_of_file

    grid, mesh, _, patches, remarks, _ = open_file(path, velocity, "latestTime", division, scale)
    bounds = mesh.points.min(axis=0), mesh.points.max(axis=0)
    kinds = _kinds(mesh.face_start, mesh.owner, mesh.neighbour, mesh.n_cells)
    lines = [f"File    {path}", "", *_lines_of_mesh(mesh.n_points, kinds, bounds, True)]
    lines += [*(f"    {line}" for line in patches), "", "Arrays"]
    for where, data in (("cells", grid.cell_data), ("points", grid.point_data)):
        lines += [f"    {name:20s} at {where}, {np.shape(data[name])[1:] or 'scalar'}" for name in list(data)]
    times = times_of_file(path)
    lines += ["", "Times", f"    {listed(times)}"] if times else []
    return [*lines, *([""] if remarks else []), *remarks]


_KINDS = {(4, 4, 0): "tetrahedron", (6, 0, 6): "hexahedron", (5, 2, 3): "prism", (5, 4, 1): "pyramid"}
"""By the numbers of faces, of triangles and of quadrangles."""


def _kinds(start: Ints, owner: Ints, neighbour: Ints, n_cells: int) -> dict[str, int]:
    """Return the number of cells of each kind, by name."""
    sizes = np.diff(start)
    counts = np.stack(
        [
            np.bincount(owner, of, n_cells) + np.bincount(neighbour, of[: len(neighbour)], n_cells)
            for of in (np.ones(len(sizes)), sizes == 3, sizes == 4)
        ]
    ).astype(int)
    by_kind = {
        name: int(np.all(counts == np.array(numbers)[:, None], axis=0).sum())
        for numbers, name in _KINDS.items()
    }
    by_kind["polyhedron"] = n_cells - sum(by_kind.values())
    return {name: n for name, n in by_kind.items() if n}


def size_of(low: Floats, high: Floats, file: bool) -> str:
    """Return a sentence about the size of a flow between two corners, m, of a mesh file or a case."""
    size = " x ".join(f"{x:.4g}" for x in high - low)
    scale = "-scale 1e-3" if file else 'transformPoints -scale "(1e-3 1e-3 1e-3)"'
    return f"Lengths are taken as metres: {size} m. If they are mm: {scale}."


def _lines_of_mesh(
    points: int, cells: dict[str, int], bounds: tuple[Floats, Floats], file: bool = False
) -> list[str]:
    low, high = ("({:g} {:g} {:g})".format(*corner) for corner in bounds)
    return [
        "Mesh",
        f"    {'points':20s} {points:10d}",
        *(f"    {kind:20s} {n:10d}" for kind, n in cells.items()),
        f"    {'bounds [m]':20s} {low} {high}",
        f"    {size_of(*bounds, file)}",
        "",
        "Patches",
    ]
