"""Processor folders of a decomposed case: their files; meshes and fields joined as by reconstructPar.

The addressing files of decomposePar give the point, face, cell and patch of the whole for each piece of a
part. Without them, as in meshes that were made in parallel, parts are joined over their processor patches.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.boundary import PolyMesh
from foamprb.flow.mesh.lists import Index, Mask, int32, ragged, starts
from foamprb.flow.patches import CONSTRAINTS
from foamprb.flow.read.boundary import PatchInfo, read_boundary
from foamprb.flow.read.case import available_times
from foamprb.flow.read.checks import require_numbers
from foamprb.flow.read.field import FoamField, PatchField
from foamprb.flow.read.foamfile import FoamFile, Labels, read_blocks, read_cell_zones
from foamprb.flow.read.polymesh import checked_poly, count_cells
from foamprb.flow.read.times import listed

_ADDRESSING = ("pointProcAddressing", "faceProcAddressing", "cellProcAddressing", "boundaryProcAddressing")
JOINED = "The parts have no files *ProcAddressing: they were joined over their processor patches."
_APART = 1e-6
"""Largest distance of a point between two parts, as a fraction of the extent of the mesh."""


class Processors:
    """Folders of the processors: one for each, or collated ones for several."""

    def __init__(self, case: Path) -> None:
        self.folders: list[Path] = []
        """In the order of the processors."""
        single: dict[int, Path] = {}
        several: dict[int, tuple[int, Path]] = {}
        for path in case.glob("processor*"):
            if match := re.fullmatch(r"processor(\d+)", path.name):
                single[int(match[1])] = path
            elif match := re.fullmatch(r"processors(\d+)(?:_(\d+)-(\d+))?", path.name):
                several[int(match[2] or 0)] = int(match[3] or int(match[1]) - 1), path
        if not single and not several:
            raise InputError(f"{case}: no processor folders.")
        for number in range(max(single, default=0)):
            if number not in single:
                raise InputError(
                    f"{case / f'processor{number}'}: no such folder, but there is processor{max(single)}."
                )
        expected = 0
        for first, (last, path) in sorted(several.items() if not single else ()):
            if first != expected:
                raise InputError(f"{path}: there is no folder for processor {expected}.")
            expected = last + 1
        self.collated = not single
        self.folders = [path for _, path in sorted(single.items())] or [
            path for _, (_, path) in sorted(several.items())
        ]
        self.n = len(single) or expected
        self._sizes = [last - first + 1 for first, (last, _) in sorted(several.items())]
        """Number of processors of each folder of collated files."""

    def files(self, relative: Path) -> list[FoamFile] | None:
        """Return the file of each processor; None if all are missing, InputError if some are."""
        paths = [existing(folder / relative) for folder in self.folders]
        found = [path for path in paths if path is not None]
        if not found:
            return None
        for folder, path in zip(self.folders, paths, strict=True):
            if path is None:
                raise InputError(f"{folder / relative}: no such file.")
        if not self.collated:
            return [FoamFile(path) for path in found]
        files: list[FoamFile] = []
        for size, path in zip(self._sizes, found, strict=True):
            blocks = read_blocks(path)
            if len(blocks) != size:
                raise InputError(
                    f"{path}: parts of {len(blocks)} processors, not {size}; the file is cut short."
                )
            files += blocks
        return files

    def times(self) -> tuple[tuple[str, ...], str]:
        """Return the times that all folders have, and a note on others; InputError if they have none."""
        times = [available_times(folder) for folder in self.folders]
        common = tuple(name for name in times[0] if all(name in names for names in times))
        others = sorted({name for names in times for name in names if name not in common}, key=float)
        if not common:
            raise InputError(
                f"{self.folders[0].parent}: no time is in all processor folders; in some: {listed(others)}."
            )
        if not others:
            return common, ""
        return common, (
            f"Some processor folders alone have the times {listed(others)}; all have {listed(common)}."
        )


class Piece(NamedTuple):
    """Mesh of a processor."""

    paths: Sequence[Path]
    """Its files: points, faces, owner, neighbour, boundary."""
    points: Floats
    start: Ints
    lists: Ints
    owner: Ints
    neighbour: Ints
    patches: Sequence[PatchInfo]

    @property
    def n_cells(self) -> int:
        """Return the number of cells."""
        return count_cells(self.owner, self.neighbour)


class Address(NamedTuple):
    """Places of the pieces of a part in the whole mesh."""

    patches: Sequence[PatchInfo]
    """The part's own."""
    points: Labels
    faces: Labels
    turned: Mask
    """(n_faces,) True if the face turns the other way in the whole: its cell is the neighbour there."""
    cells: Labels
    of_patches: Labels
    """−1 for patches between processors."""


def read_pieces(processors: Processors, files: Sequence[Path], case: Path) -> list[Piece]:
    """Read the meshes of all processors.

    Parameters
    ----------
    processors
        The folders.
    files
        ``points``, ``faces``, ``owner``, ``neighbour`` and ``boundary`` of the first folder.
    case
        The case, for messages.
    """
    columns = []
    for path in files:
        found = processors.files(path.relative_to(processors.folders[0]))
        if found is None:
            raise InputError(f"{path}: no such file.")
        columns.append(found)
    pieces = []
    for row in zip(*columns, strict=True):
        start, lists = row[1].faces()
        owner, neighbour = row[2].indices(), row[3].indices()
        patches = read_boundary(row[4].path, case, row[4])
        piece = Piece([file.path for file in row], row[0].list(3), start, lists, owner, neighbour, patches)
        if len(start) - 1 != len(owner):
            raise InputError(
                f"{row[1].path}: {len(start) - 1} entries, but the other files say {len(owner)}."
            )
        if len(neighbour) + sum(patch.faces for patch in patches) != len(owner):
            raise InputError(f"{row[4].path}: the patches do not fit the {len(owner)} faces.")
        for file, values, limit in ((row[1], lists, len(piece.points)), (row[3], neighbour, piece.n_cells)):
            if len(values) and not 0 <= values.min() <= values.max() < limit:
                raise InputError(f"{file.path}: an index outside 0 to {limit - 1}.")
        pieces.append(piece)
    return pieces


def read_addresses(processors: Processors, folder: Path, pieces: Sequence[Piece]) -> list[Address] | None:
    """Read the addressing files; None without them, InputError if they do not fit the meshes."""
    at = folder.relative_to(processors.folders[0])
    columns = [processors.files(at / name) for name in _ADDRESSING]
    if None in columns:
        return None
    found = []
    for piece, *row in zip(pieces, *filter(None, columns), strict=True):
        points, signed, cells, patches = (file.labels() for file in row)
        for file, values, expected in (
            (row[0], points, len(piece.points)),
            (row[1], signed, len(piece.owner)),
            (row[3], patches, len(piece.patches)),
        ):
            if len(values) != expected:
                raise InputError(
                    f"{file.path}: {len(values)} entries, but the other files say {expected}. Without files "
                    "*ProcAddressing the parts are joined over their processor patches."
                )
        if piece.n_cells > len(cells):
            raise InputError(f"{piece.paths[2]}: an index outside 0 to {len(cells) - 1}.")
        if np.any(signed == 0):
            raise InputError(f"{row[1].path}: there is no face 0.")
        found.append(Address(piece.patches, points, np.abs(signed) - 1, signed < 0, cells, patches))
    return found


def found_addresses(pieces: Sequence[Piece]) -> list[Address]:
    """Return a numbering of the whole mesh by which the pieces meet at their processor patches.

    Raises
    ------
    InputError
        A processor patch has no counterpart with the same faces.
    """
    internal = starts(np.array([len(piece.neighbour) for piece in pieces]))
    between, n = _between(pieces, int(internal[-1]))
    outer = _boundary_starts(pieces, n)
    points = _found_points(pieces)
    cells, found = starts(np.array([piece.n_cells for piece in pieces])), []
    for k, piece in enumerate(pieces):
        faces = np.full(len(piece.owner), -1, dtype=np.int64)
        turned = np.zeros(len(piece.owner), dtype=bool)
        faces[: len(piece.neighbour)] = np.arange(internal[k], internal[k + 1])
        for patch in piece.patches:
            part, other = slice(patch.start, patch.start + patch.faces), _other(patch)
            first = outer[k, patch.name] if other < 0 else between[min(k, other), max(k, other)]
            faces[part], turned[part] = np.arange(first, first + patch.faces), 0 <= other < k
        of_patches = [-1 if "neighbProcNo" in p.entries else i for i, p in enumerate(piece.patches)]
        found.append(
            Address(
                piece.patches, points[k], faces, turned, np.arange(cells[k], cells[k + 1]),
                np.array(of_patches, dtype=np.int64),
            )
        )  # fmt: skip
    return found


def _other(patch: PatchInfo) -> int:
    """Return the piece on the other side of a processor patch; −1 for any other patch."""
    return int(patch.entries["neighbProcNo"]) if patch.type == "processor" else -1


def _between(pieces: Sequence[Piece], n: int) -> tuple[dict[tuple[int, int], int], int]:
    """Number the faces of processor patches from n on.

    Returns
    -------
    The first face of each pair of pieces, and the number behind the last face.
    """
    patches = {(k, _other(p)): p for k, piece in enumerate(pieces) for p in piece.patches}
    first = {}
    for (own, other), patch in sorted(patches.items()):
        if other < 0:
            continue
        beyond = patches.get((other, own))
        if beyond is None or beyond.faces != patch.faces:
            raise InputError(
                f"{pieces[own].paths[4]}: patch {patch.name} has {patch.faces} faces, but the patch "
                f"of processor {other} to it has {beyond.faces if beyond else 0}."
            )
        if own < other:
            first[own, other] = n
            n += patch.faces
    return first, n


def _boundary_starts(pieces: Sequence[Piece], n: int) -> dict[tuple[int, str], int]:
    """Number the boundary faces from n on, patch by patch; those of two cyclic patches in the same order.

    Returns
    -------
    The first face of each patch of each piece.
    """
    segments: dict[str, list[tuple[tuple[int, int], int, PatchInfo]]] = {}
    names = [patch.name for piece in pieces[:1] for patch in piece.patches]
    for own, piece in enumerate(pieces):
        for patch in piece.patches:
            if patch.type == "processor":
                continue
            name = patch.entries.get("referPatch", patch.name)
            whole = next((p for p in piece.patches if p.name == name), patch)
            other = int(patch.entries.get("neighbProcNo", own))
            first = whole.neighbour not in names or names.index(name) < names.index(whole.neighbour)
            segments.setdefault(name, []).append(((own, other) if first else (other, own), own, patch))
    found = {}
    for _, lists in sorted(segments.items(), key=lambda item: names.index(item[0])):
        for _, own, patch in sorted(lists, key=lambda segment: segment[0]):
            found[own, patch.name] = n
            n += patch.faces
    return found


def _found_points(pieces: Sequence[Piece]) -> list[Labels]:
    """Return the numbers of the points of each piece: those that coincide have one.

    Points are numbered by the first piece that has them, in its order.
    """
    ends = starts(np.array([len(piece.points) for piece in pieces]))
    rows: dict[tuple[int, int], Index] = {}
    sizes: dict[tuple[int, int], Ints] = {}
    for k, piece in enumerate(pieces):
        for patch in piece.patches:
            other = _other(patch)
            if other < 0:
                continue
            start = piece.start[patch.start : patch.start + patch.faces + 1].astype(np.intp)
            sizes[k, other] = np.diff(start)
            order = ragged(np.zeros(patch.faces, dtype=np.intp), np.diff(start))
            if other < k:
                # There the faces turn the other way.
                order = -order % np.repeat(np.diff(start), np.diff(start))
            rows[k, other] = piece.lists[np.repeat(start[:-1], np.diff(start)) + order] + ends[k]
    for (own, other), counts in sizes.items():
        if not np.array_equal(counts, sizes[other, own]):
            first, second = (pieces[k].paths[1] for k in (other, own))
            raise InputError(f"{first}: the faces of a processor patch differ from those of {second}.")
    nothing = np.empty(0, dtype=np.intp)
    here = np.concatenate([nothing, *(rows[own, other] for own, other in rows)])
    there = np.concatenate([nothing, *(rows[other, own] for own, other in rows)])
    numbers = np.arange(ends[-1], dtype=np.int64)
    before = np.empty(0, dtype=np.int64)
    while not np.array_equal(before, numbers):
        before = numbers.copy()
        np.minimum.at(numbers, here, before[there])
    leading = numbers == np.arange(len(numbers))
    return np.split((np.cumsum(leading) - 1)[numbers], ends[1:-1])


def whole_patches(case: Path, parts: Sequence[Address]) -> tuple[list[PatchInfo], Labels]:
    """Return the patches of the whole case, and the boundary face at which each begins and the last ends."""
    known: dict[int, PatchInfo] = {}
    counts: dict[int, int] = {}
    for part in parts:
        names = [patch.name for patch in part.patches]
        for patch, at in zip(part.patches, part.of_patches.tolist(), strict=True):
            if at >= 0:
                known.setdefault(at, patch)
                counts[at] = counts.get(at, 0) + patch.faces
            elif patch.entries.get("referPatch") in names:
                # A cyclic patch whose two sides lie on different processors.
                whole = int(part.of_patches[names.index(patch.entries["referPatch"])])
                counts[whole] = counts.get(whole, 0) + patch.faces
    if sorted(known) != list(range(len(known))):
        raise InputError(f"{case}: the processor folders do not name all patches of the mesh.")
    patches = [known[at]._replace(faces=counts[at]) for at in range(len(known))]
    return patches, starts(np.array([patch.faces for patch in patches], dtype=np.int64))


def join_meshes(
    case: Path,
    pieces: Sequence[Piece],
    parts: Sequence[Address],
    patches: Sequence[PatchInfo],
    ranges: Labels,
) -> PolyMesh:
    """Join meshes; see :func:`whole_patches`. InputError if the parts do not make a whole."""
    foreign = InputError(
        f"{case}: the processor folders do not make a whole mesh; one of them is damaged or of another case."
    )
    n_cells = _count([part.cells for part in parts])
    n_points = _count([part.points for part in parts])
    n_faces = _count([part.faces[~part.turned] for part in parts])
    n_internal = n_faces - int(ranges[-1])
    turned = np.concatenate([part.faces[part.turned] for part in parts])
    if (
        min(n_cells, n_points, n_internal) < 0
        or n_cells != sum(len(part.cells) for part in parts)
        or n_faces != sum(np.count_nonzero(~part.turned) for part in parts)
        or turned.max(initial=-1) >= n_faces
        or len(np.unique(turned)) != len(turned)
    ):
        raise foreign
    points = np.empty((n_points, 3))
    owner, neighbour, size = (np.full(n_faces, -1, dtype=np.int64) for _ in range(3))
    for piece, part in zip(pieces, parts, strict=True):
        points[part.points] = piece.points
        own = ~part.turned
        owner[part.faces[own]] = part.cells[piece.owner[own]]
        size[part.faces[own]] = np.diff(piece.start)[own]
        neighbour[part.faces[: len(piece.neighbour)]] = part.cells[piece.neighbour]
        neighbour[part.faces[part.turned]] = part.cells[piece.owner[part.turned]]
    apart = max(
        float(np.abs(points[part.points] - piece.points).max(initial=0.0))
        for piece, part in zip(pieces, parts, strict=True)
    )
    if (
        not apart <= _APART * float(np.ptp(points, axis=0).max())
        or np.any(neighbour[:n_internal] < 0)
        or np.any(neighbour[n_internal:] >= 0)
    ):
        raise foreign
    start = starts(size)
    lists = np.empty(start[-1], dtype=np.int32)
    for piece, part in zip(pieces, parts, strict=True):
        own = ~part.turned
        counts = np.diff(piece.start)[own]
        own_points = piece.lists[ragged(piece.start[:-1][own], counts)]
        lists[ragged(start[part.faces[own]], counts)] = part.points[own_points]
    whole = [
        patch._replace(start=n_internal + int(first)) for patch, first in zip(patches, ranges, strict=False)
    ]
    arrays = int32(start), lists, int32(owner), int32(neighbour[:n_internal])
    return checked_poly(pieces[0].paths, points, *arrays, whole)


def _count(addresses: Iterable[Labels]) -> int:
    """Return the count of pieces if the parts hold all indices from 0 on and no others, else −1."""
    numbers = np.concatenate(list(addresses))
    n = int(numbers.max(initial=-1)) + 1
    if n > len(numbers) or numbers.min(initial=0) < 0:
        return -1
    return n if np.bincount(numbers, minlength=n).all() else -1


def join_zones(
    processors: Processors, folder: Path, parts: Sequence[Address]
) -> Mapping[str, NDArray[np.int64]]:
    """Join the zones of cells, each in the order of its cells."""
    zones: dict[str, list[Labels]] = {}
    files = processors.files(folder.relative_to(processors.folders[0]) / "cellZones")
    for part, file in zip(parts, files or (), strict=False):
        for name, cells in read_cell_zones(file).items():
            if len(cells) and not 0 <= cells.min() <= cells.max() < len(part.cells):
                raise InputError(f"{file.path}: zone {name} names a cell that is not there.")
            zones.setdefault(name, []).append(part.cells[cells])
    return {name: np.sort(np.concatenate(lists)) for name, lists in zones.items()}


def checked(field: FoamField, part: Address) -> FoamField:
    """Return the field of a part if it fits the part's mesh; InputError otherwise.

    Of a field of faces those of the patches are kept.
    """
    if field.kind.name.startswith("surface"):
        field = field._replace(cells=np.zeros((1, field.cells.shape[1])))
    if len(field.cells) not in (1, len(part.cells)):
        raise InputError(f"{field.path}: {len(field.cells)} cells, but the mesh there has {len(part.cells)}.")
    require_numbers(field.cells, field.path, "value", "at cell")
    for patch, at in zip(part.patches, part.of_patches.tolist(), strict=True):
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
    parts: Sequence[Address], fields: Sequence[FoamField], patches: Sequence[PatchInfo], ranges: Labels
) -> FoamField:
    """Join the fields of parts.

    Parameters
    ----------
    parts, fields
        The parts of the mesh, and the field of each.
    patches, ranges
        See :func:`whole_patches`.
    """
    cells = np.empty((sum(len(part.cells) for part in parts), fields[0].cells.shape[1]))
    for part, field in zip(parts, fields, strict=True):
        cells[part.cells] = field.cells
    n_internal = 1 + max(int(part.faces.max(initial=-1)) for part in parts) - int(ranges[-1])
    found = {
        patch.name: _join_patch(parts, fields, index, n_internal + ranges[index : index + 2])
        for index, patch in enumerate(patches)
    }
    entries = {name: entry for name, entry in found.items() if entry is not None}
    return fields[0]._replace(cells=cells, patches=entries)


def _join_patch(
    parts: Sequence[Address], fields: Sequence[FoamField], index: int, ends: Labels
) -> PatchField | None:
    """Return the entry of a patch, whose faces ``ends`` bounds in the whole; None if no part has an entry."""
    pieces: list[tuple[Labels, PatchField]] = []
    for part, field in zip(parts, fields, strict=True):
        for patch in (part.patches[k] for k in np.flatnonzero(part.of_patches == index).tolist()):
            entry = field.of(patch)
            if entry is not None:
                pieces.append((part.faces[patch.start : patch.start + patch.faces] - ends[0], entry))
    # A part without faces of the patch may have an entry without values.
    filled = [piece for piece in pieces if len(piece[0])] or pieces
    if not filled:
        return None
    values = {}
    for key in sorted(set.intersection(*(set(entry.fields) for _, entry in filled))):
        # Faces of a cyclic patch whose sides lie on different processors have no values.
        values[key] = np.zeros((int(ends[1] - ends[0]), filled[0][1].fields[key].shape[1]))
        for faces, entry in filled:
            values[key][faces] = entry.fields[key]
    return filled[0][1]._replace(pattern=False, fields=values)
