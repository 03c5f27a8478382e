"""What OpenFOAM's reconstructPar does: the meshes and fields of parts, written as those of one case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.read.boundary import PatchInfo
from foamprb.flow.read.field import Field
from foamprb.flow.read.foamfile import Labels, existing, read_cell_zones
from foamprb.flow.read.processors import Part

HEADER = """FoamFile
{{
    version     2.0;
    format      binary;
    class       {kind};
    arch        "LSB;label=32;scalar=64";
    {note}
    object      {name};
}}

"""
_APART = 1e-6
"""How far apart a point may be in two parts, of the extent of the mesh."""


def write_mesh(
    folder: Path, case: Path, parts: Sequence[Part], patches: Sequence[PatchInfo], ranges: Labels
) -> None:
    """Write the whole mesh to a folder ``polyMesh``.

    Raises
    ------
    InputError
        The parts do not make a whole.
    """
    foreign = InputError(
        f"{case}: the processor folders do not make a whole mesh; one of them is damaged or of another case."
    )
    n_cells = _whole_number([part.cell_at for part in parts])
    n_points = _whole_number([part.point_at for part in parts])
    n_faces = _whole_number([part.face_at[~part.turned] for part in parts])
    n_internal = n_faces - int(ranges[-1])
    turned = np.concatenate([part.face_at[part.turned] for part in parts])
    if (
        min(n_cells, n_points, n_internal) < 0
        or n_cells != sum(len(part.cell_at) for part in parts)
        or n_faces != sum(np.count_nonzero(~part.turned) for part in parts)
        or turned.max(initial=-1) >= n_faces
        or len(np.unique(turned)) != len(turned)
    ):
        raise foreign
    points = np.empty((n_points, 3))
    owner, neighbour, size = (np.full(n_faces, -1, dtype=np.int64) for _ in range(3))
    for part in parts:
        points[part.point_at] = part.points
        own = ~part.turned
        owner[part.face_at[own]] = part.cell_at[part.owner[own]]
        size[part.face_at[own]] = np.diff(part.face_start)[own]
        inside = len(part.neighbour)
        neighbour[part.face_at[:inside]] = part.cell_at[part.neighbour]
        neighbour[part.face_at[part.turned]] = part.cell_at[part.owner[part.turned]]
    apart = max(float(np.abs(points[part.point_at] - part.points).max(initial=0.0)) for part in parts)
    if (
        not apart <= _APART * float(np.ptp(points, axis=0).max())
        or np.any(neighbour[:n_internal] < 0)
        or np.any(neighbour[n_internal:] >= 0)
    ):
        raise foreign
    start = np.concatenate([[0], np.cumsum(size)])
    lists = np.empty(start[-1], dtype=np.int64)
    for part in parts:
        mine = np.flatnonzero(~part.turned)
        counts = np.diff(part.face_start)[mine]
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        to = np.repeat(start[part.face_at[mine]], counts) + within
        lists[to] = part.point_at[part.face_points[np.repeat(part.face_start[mine], counts) + within]]
    folder.mkdir(parents=True)
    note = f'note "nPoints:{n_points}  nCells:{n_cells}  nFaces:{n_faces}  nInternalFaces:{n_internal}";'
    _write(folder / "points", "vectorField", [points])
    _write(folder / "faces", "faceCompactList", [start, lists])
    _write(folder / "owner", "labelList", [owner], note)
    _write(folder / "neighbour", "labelList", [neighbour[:n_internal]], note)
    text = "".join(
        f"{patch.name}\n{{\n"
        + "".join(f"    {key} {value};\n" for key, value in _entries(patch, n_internal + int(first)).items())
        + "}\n"
        for patch, first in zip(patches, ranges, strict=False)
    )
    (folder / "boundary").write_text(
        HEADER.format(kind="polyBoundaryMesh", note="", name="boundary").replace("binary", "ascii")
        + f"{len(patches)}\n(\n{text})\n"
    )


def _whole_number(addresses: Sequence[Labels]) -> int:
    """How many pieces there are if the parts hold all numbers from 0 on, and no others; −1 if they do not."""
    numbers = np.concatenate(addresses)
    n = int(numbers.max(initial=-1)) + 1
    if n > len(numbers) or numbers.min(initial=0) < 0:
        return -1
    return n if np.bincount(numbers, minlength=n).all() else -1


def write_zones(path: Path, parts: Sequence[Part]) -> None:
    """Put the zones of cells together, if there are any; each in the order of its cells."""
    zones: dict[str, list[Labels]] = {}
    for part in parts:
        found = existing(part.mesh / "cellZones")
        for name, cells in ({} if found is None else read_cell_zones(found)).items():
            if len(cells) and not 0 <= cells.min() <= cells.max() < len(part.cell_at):
                raise InputError(f"{found}: zone {name} names a cell that is not there.")
            zones.setdefault(name, []).append(part.cell_at[cells])
    text = ""
    for name, lists in zones.items():
        labels = np.sort(np.concatenate(lists))
        text += f"{name}\n{{\n    type cellZone;\n    cellLabels List<label> {len(labels)} "
        text += f"({' '.join(map(str, labels))});\n}}\n"
    if zones:
        head = HEADER.format(kind="regIOobject", note="", name="cellZones").replace("binary", "ascii")
        path.write_text(f"{head}{len(zones)}\n(\n{text})\n")


def _entries(patch: PatchInfo, start: int) -> dict[str, str]:
    return patch.entries | {"nFaces": str(patch.faces), "startFace": str(start)}


def checked(field: Field, part: Part, path: Path) -> Field:
    """The field, if it has the part's size."""
    if len(field.cells) not in (1, len(part.cell_at)):
        raise InputError(f"{path}: {len(field.cells)} cells, but the mesh there has {len(part.cell_at)}.")
    for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
        if at < 0:
            continue
        if patch.name not in field.patches:
            raise InputError(f"{path}: no boundaryField for the patch {patch.name}.")
        values = field.patches[patch.name][1]
        if values is not None and len(values) not in (1, patch.faces):
            raise InputError(
                f"{path}: {len(values)} values on patch {patch.name}, which has {patch.faces} faces."
            )
    return field


def write_field(
    path: Path,
    kind: str,
    parts: Sequence[Part],
    fields: Sequence[Field],
    patches: Sequence[PatchInfo],
    ranges: Labels,
) -> None:
    """Write a field of the whole case; arguments as of :func:`write_mesh`, ``kind`` is the field's class."""
    components = fields[0].cells.shape[1]
    of = {3: "vector", 9: "tensor"}[components]
    cells = np.empty((sum(len(part.cell_at) for part in parts), components))
    n_faces = 1 + max(int(part.face_at.max(initial=-1)) for part in parts)
    boundary = np.zeros((int(ranges[-1]), components))
    valued = np.zeros(len(patches), dtype=bool)
    types = [""] * len(patches)
    for part, field in zip(parts, fields, strict=True):
        cells[part.cell_at] = field.cells
        for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
            if at < 0:
                continue
            types[at], values = field.patches[patch.name]
            if values is not None and patch.faces:
                faces = part.face_at[patch.start : patch.start + patch.faces]
                boundary[faces - (n_faces - len(boundary))] = values
                valued[at] = True
    with path.open("wb") as file:
        file.write(HEADER.format(kind=kind, note="", name=path.name).encode())
        length = 1 if components == 3 else 0
        file.write(f"dimensions [0 {length} -1 0 0 0 0];\ninternalField nonuniform List<{of}> ".encode())
        _write_list(file, cells)
        file.write(b";\nboundaryField\n{\n")
        for i, patch in enumerate(patches):
            file.write(f"{patch.name}\n{{\ntype {types[i]};\n".encode())
            if valued[i]:
                file.write(f"value nonuniform List<{of}> ".encode())
                _write_list(file, boundary[ranges[i] : ranges[i + 1]])
                file.write(b";\n")
            file.write(b"}\n")
        file.write(b"}\n")


def _write(path: Path, kind: str, lists: Sequence[NDArray[Any]], note: str = "") -> None:
    with path.open("wb") as file:
        file.write(HEADER.format(kind=kind, note=note, name=path.name).encode())
        for values in lists:
            _write_list(file, values)
            file.write(b"\n")


def _write_list(file: Any, values: NDArray[Any]) -> None:
    kind = "<f8" if values.dtype.kind == "f" else "<i4"
    file.write(f"{len(values)}\n(".encode())
    file.write(np.ascontiguousarray(values, dtype=kind).tobytes())
    file.write(b")")
