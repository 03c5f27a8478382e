"""What OpenFOAM's reconstructPar does: the meshes and fields of parts, written as those of one case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.read.boundary import CONSTRAINTS, PatchInfo
from foamprb.flow.read.field import Field, PatchField
from foamprb.flow.read.foamfile import Labels, read_cell_zones
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


def checked(field: Field, part: Part) -> Field:
    """The field of a part, if it fits the part's mesh; InputError otherwise."""
    if len(field.cells) not in (1, len(part.cell_at)):
        raise InputError(
            f"{field.path}: {len(field.cells)} cells, but the mesh there has {len(part.cell_at)}."
        )
    for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
        if at < 0:
            continue
        entry = field.of(patch)
        if entry is None and patch.type not in CONSTRAINTS:
            raise InputError(f"{field.path}: no boundaryField for the patch {patch.name}.")
        for key, values in entry.fields.items() if entry is not None else ():
            if len(values) not in (1, patch.faces):
                raise InputError(
                    f"{field.path}: {len(values)} values of {key} on patch {patch.name}, which has "
                    f"{patch.faces} faces."
                )
    return field


def join_fields(
    parts: Sequence[Part], fields: Sequence[Field], patches: Sequence[PatchInfo], ranges: Labels
) -> Field:
    """Put the fields of parts together.

    Parameters
    ----------
    parts, fields
        The parts of the mesh, and the field of each.
    patches, ranges
        The patches of the whole, and at which boundary face each begins, and the last ends.
    """
    cells = np.empty((sum(len(part.cell_at) for part in parts), fields[0].cells.shape[1]))
    for part, field in zip(parts, fields, strict=True):
        cells[part.cell_at] = field.cells
    n_internal = 1 + max(int(part.face_at.max(initial=-1)) for part in parts) - int(ranges[-1])
    found = {
        patch.name: _join_patch(parts, fields, index, n_internal + ranges[index : index + 2])
        for index, patch in enumerate(patches)
    }
    entries = {name: entry for name, entry in found.items() if entry is not None}
    return Field(fields[0].path, fields[0].kind, cells, entries)


def _join_patch(
    parts: Sequence[Part], fields: Sequence[Field], index: int, ends: Labels
) -> PatchField | None:
    """The entry of a patch whose faces in the whole lie between two numbers; None if no part has one."""
    pieces: list[tuple[Labels, PatchField]] = []
    for part, field in zip(parts, fields, strict=True):
        for patch in (part.patches[k] for k in np.flatnonzero(part.patch_at == index).tolist()):
            entry = field.of(patch)
            if entry is not None:
                pieces.append((part.face_at[patch.start : patch.start + patch.faces] - ends[0], entry))
    # A part without faces of the patch may have an entry without values.
    filled = [piece for piece in pieces if len(piece[0])] or pieces
    if not filled:
        return None
    keys = set.intersection(*(set(entry.fields) for _, entry in filled))
    values = {}
    for key in sorted(keys):
        values[key] = np.empty((int(ends[1] - ends[0]), filled[0][1].fields[key].shape[1]))
        for faces, entry in filled:
            values[key][faces] = entry.fields[key]
    return filled[0][1]._replace(pattern=False, fields=values)


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
