"""Processor folders of a decomposed case: parts of the mesh and of fields, joined as by reconstructPar."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.lists import Mask, ragged, starts
from foamprb.flow.read.boundary import CONSTRAINTS, PatchInfo, read_boundary
from foamprb.flow.read.case import available_times, cell_zones
from foamprb.flow.read.field import FoamField, PatchField
from foamprb.flow.read.foamfile import Labels, read_faces, read_labels, read_vectors

_MESH = ("points", "faces", "owner", "neighbour", "boundary")
_ADDRESSING = ("pointProcAddressing", "faceProcAddressing", "cellProcAddressing", "boundaryProcAddressing")
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
"""Largest distance of a point between two parts, as a fraction of the extent of the mesh."""


def processors(case: Path) -> tuple[Path, ...]:
    """Return the processor folders in their order.

    Raises
    ------
    InputError
        There are no such folders, one is missing, or they are in the collated format.
    """
    folders = {
        int(m[1]): path
        for path in case.glob("processor*")
        if (m := re.fullmatch(r"processor(\d+)", path.name))
    }
    if not folders:
        collated = [path.name for path in case.glob("processors*") if path.is_dir()]
        if collated:
            raise InputError(f"{case / collated[0]}: the collated format is not read: run reconstructPar.")
        raise InputError(f"{case}: no processor folders.")
    for number in range(max(folders)):
        if number not in folders:
            raise InputError(
                f"{case / f'processor{number}'}: no such folder, but there is processor{max(folders)}."
            )
    return tuple(folders[number] for number in sorted(folders))


class Part(NamedTuple):
    """Mesh of a processor, and the indices of its pieces in the whole mesh."""

    mesh: Path
    """The folder ``polyMesh``."""
    points: Floats
    face_start: Labels
    face_points: Labels
    owner: Labels
    neighbour: Labels
    patches: Sequence[PatchInfo]
    point_at: Labels
    face_at: Labels
    turned: Mask
    """(n_faces,) True if the face turns the other way in the whole: its cell is the neighbour there."""
    cell_at: Labels
    patch_at: Labels

    def without_mesh(self) -> Part:
        """Return the part with the indices that fields need alone."""
        nothing = np.empty(0, dtype=np.int64)
        return self._replace(
            points=np.empty((0, 3)), face_start=nothing, face_points=nothing, owner=nothing,
            neighbour=nothing, point_at=nothing,
        )  # fmt: skip


def common_times(folders: Sequence[Path], region: str) -> tuple[str, ...]:
    """Return the times of all folders; raise InputError if one of them misses a time that another has."""
    times = available_times(folders[0])
    for folder in folders:
        here = available_times(folder)
        for mesh in (folder / name / region / "polyMesh" for name in here):
            if mesh.is_dir():
                raise InputError(f"{mesh}: the mesh changes in time; in decomposed cases it must not.")
        for name in (*times, *here):
            if (name in times) != (name in here):
                lacking, having = (folder, folders[0]) if name in times else (folders[0], folder)
                raise InputError(f"{lacking}: no time {name}, which {having.name} has.")
    return times


def read_part(case: Path, folder: Path, region: str) -> Part:
    """Read the mesh of a processor folder; InputError if it is missing, broken or inconsistent."""
    mesh = folder / "constant" / region / "polyMesh"
    for name in _MESH:
        if existing(mesh / name) is None:
            raise InputError(f"{mesh / name}: no such file.")
    for name in _ADDRESSING:
        if existing(mesh / name) is None:
            raise InputError(
                f"{mesh / name}: no such file. Without decomposePar's addressing the processor meshes cannot "
                "be joined: run reconstructParMesh and reconstructPar."
            )
    start, points = read_faces(mesh / "faces")
    signed = read_labels(mesh / "faceProcAddressing")
    part = Part(
        mesh, read_vectors(mesh / "points"), start, points,
        read_labels(mesh / "owner"), read_labels(mesh / "neighbour"),
        read_boundary(mesh / "boundary", case),
        read_labels(mesh / "pointProcAddressing"), np.abs(signed) - 1, signed < 0,
        read_labels(mesh / "cellProcAddressing"), read_labels(mesh / "boundaryProcAddressing"),
    )  # fmt: skip
    cells, faces = len(part.cell_at), len(part.owner)
    for name, found, expected in (
        ("faces", len(start) - 1, faces),
        ("faceProcAddressing", len(signed), faces),
        ("pointProcAddressing", len(part.point_at), len(part.points)),
        ("boundaryProcAddressing", len(part.patch_at), len(part.patches)),
    ):
        if found != expected:
            raise InputError(f"{mesh / name}: {found} entries, but the other files say {expected}.")
    for name, values, limit in (
        ("faces", points, len(part.points)),
        ("owner", part.owner, cells),
        ("neighbour", part.neighbour, cells),
    ):
        if len(values) and not 0 <= values.min() <= values.max() < limit:
            raise InputError(f"{mesh / name}: an index outside 0 to {limit - 1}.")
    if np.any(signed == 0):
        raise InputError(f"{mesh / 'faceProcAddressing'}: there is no face 0.")
    return part


def whole_patches(case: Path, parts: Sequence[Part]) -> tuple[list[PatchInfo], Labels]:
    """Return the patches of the whole case, and the boundary face at which each begins and the last ends."""
    known: dict[int, PatchInfo] = {}
    counts: dict[int, int] = {}
    for part in parts:
        names = [patch.name for patch in part.patches]
        for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
            if at >= 0:
                known.setdefault(at, patch)
                counts[at] = counts.get(at, 0) + patch.faces
            elif patch.entries.get("referPatch") in names:
                # A cyclic patch whose two sides lie on different processors.
                whole = int(part.patch_at[names.index(patch.entries["referPatch"])])
                counts[whole] = counts.get(whole, 0) + patch.faces
    if sorted(known) != list(range(len(known))):
        raise InputError(f"{case}: the processor folders do not name all patches of the mesh.")
    patches = [known[at]._replace(faces=counts[at]) for at in range(len(known))]
    return patches, starts(np.array([patch.faces for patch in patches], dtype=np.int64))


def write_mesh(
    folder: Path, case: Path, parts: Sequence[Part], patches: Sequence[PatchInfo], ranges: Labels
) -> None:
    """Write the whole mesh to a folder ``polyMesh``; InputError if the parts do not make a whole."""
    foreign = InputError(
        f"{case}: the processor folders do not make a whole mesh; one of them is damaged or of another case."
    )
    n_cells = _count([part.cell_at for part in parts])
    n_points = _count([part.point_at for part in parts])
    n_faces = _count([part.face_at[~part.turned] for part in parts])
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
        neighbour[part.face_at[: len(part.neighbour)]] = part.cell_at[part.neighbour]
        neighbour[part.face_at[part.turned]] = part.cell_at[part.owner[part.turned]]
    apart = max(float(np.abs(points[part.point_at] - part.points).max(initial=0.0)) for part in parts)
    if (
        not apart <= _APART * float(np.ptp(points, axis=0).max())
        or np.any(neighbour[:n_internal] < 0)
        or np.any(neighbour[n_internal:] >= 0)
    ):
        raise foreign
    start = starts(size)
    lists = np.empty(start[-1], dtype=np.int64)
    for part in parts:
        own = ~part.turned
        counts = np.diff(part.face_start)[own]
        own_points = part.face_points[ragged(part.face_start[:-1][own], counts)]
        lists[ragged(start[part.face_at[own]], counts)] = part.point_at[own_points]
    folder.mkdir(parents=True)
    note = f'note "nPoints:{n_points}  nCells:{n_cells}  nFaces:{n_faces}  nInternalFaces:{n_internal}";'
    _write(folder / "points", "vectorField", [points])
    _write(folder / "faces", "faceCompactList", [start, lists])
    _write(folder / "owner", "labelList", [owner], note)
    _write(folder / "neighbour", "labelList", [neighbour[:n_internal]], note)
    text = ""
    for patch, first in zip(patches, ranges, strict=False):
        entries = patch.entries | {"nFaces": str(patch.faces), "startFace": str(n_internal + int(first))}
        lines = "".join(f"    {key} {word};\n" for key, word in entries.items())
        text += f"{patch.name}\n{{\n{lines}}}\n"
    _write_text(folder / "boundary", "polyBoundaryMesh", len(patches), text)


def _count(addresses: Sequence[Labels]) -> int:
    """Return the count of pieces if the parts hold all indices from 0 on and no others, else −1."""
    numbers = np.concatenate(addresses)
    n = int(numbers.max(initial=-1)) + 1
    if n > len(numbers) or numbers.min(initial=0) < 0:
        return -1
    return n if np.bincount(numbers, minlength=n).all() else -1


def write_zones(path: Path, parts: Sequence[Part]) -> None:
    """Join the zones of cells, if there are any, each in the order of its cells."""
    zones: dict[str, list[Labels]] = {}
    for part in parts:
        for name, cells in cell_zones(part.mesh).items():
            if len(cells) and not 0 <= cells.min() <= cells.max() < len(part.cell_at):
                raise InputError(f"{part.mesh / 'cellZones'}: zone {name} names a cell that is not there.")
            zones.setdefault(name, []).append(part.cell_at[cells])
    text = ""
    for name, lists in zones.items():
        labels = np.sort(np.concatenate(lists))
        text += f"{name}\n{{\n    type cellZone;\n    cellLabels List<label> {len(labels)} "
        text += f"({' '.join(map(str, labels))});\n}}\n"
    if zones:
        _write_text(path, "regIOobject", len(zones), text)


def checked(field: FoamField, part: Part) -> FoamField:
    """Return the field of a part if it fits the part's mesh; InputError otherwise."""
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
    parts: Sequence[Part], fields: Sequence[FoamField], patches: Sequence[PatchInfo], ranges: Labels
) -> FoamField:
    """Join the fields of parts.

    Parameters
    ----------
    parts, fields
        The parts of the mesh, and the field of each.
    patches, ranges
        See :func:`whole_patches`.
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
    return fields[0]._replace(cells=cells, patches=entries)


def _join_patch(
    parts: Sequence[Part], fields: Sequence[FoamField], index: int, ends: Labels
) -> PatchField | None:
    """Return the entry of a patch, whose faces ``ends`` bounds in the whole; None if no part has an entry."""
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
    values = {}
    for key in sorted(set.intersection(*(set(entry.fields) for _, entry in filled))):
        values[key] = np.empty((int(ends[1] - ends[0]), filled[0][1].fields[key].shape[1]))
        for faces, entry in filled:
            values[key][faces] = entry.fields[key]
    return filled[0][1]._replace(pattern=False, fields=values)


def _write(path: Path, kind: str, lists: Sequence[NDArray[Any]], note: str = "") -> None:
    with path.open("wb") as file:
        file.write(HEADER.format(kind=kind, note=note, name=path.name).encode())
        for values in lists:
            file.write(f"{len(values)}\n(".encode())
            file.write(values.astype("<f8" if values.dtype.kind == "f" else "<i4").tobytes())
            file.write(b")\n")


def _write_text(path: Path, kind: str, n: int, text: str) -> None:
    head = HEADER.format(kind=kind, note="", name=path.name).replace("binary", "ascii")
    path.write_text(f"{head}{n}\n(\n{text})\n")
