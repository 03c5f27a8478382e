"""The processor folders of a decomposed case, and what each says of its part of the mesh."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.lists import Mask
from foamprb.flow.read.boundary import PatchInfo, read_boundary
from foamprb.flow.read.case import available_times
from foamprb.flow.read.foamfile import Labels, read_faces, read_labels, read_vectors

_MESH = ("points", "faces", "owner", "neighbour", "boundary")
_ADDRESSING = ("pointProcAddressing", "faceProcAddressing", "cellProcAddressing", "boundaryProcAddressing")


def processors(case: Path) -> tuple[Path, ...]:
    """The processor folders, in their order.

    Raises
    ------
    InputError
        There is none, one is missing, or they are in the collated format.
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
    """A processor's mesh, and the places of its pieces in the whole."""

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
    """(n_faces,) whether a face turns the other way there: its cell is the neighbour."""
    cell_at: Labels
    patch_at: Labels


def common_times(folders: Sequence[Path], region: str) -> tuple[str, ...]:
    """The times of all folders; raise InputError if one of them misses a time that another has."""
    times = available_times(folders[0])
    for folder in folders:
        here = available_times(folder)
        meshes = [folder / name / region / "polyMesh" for name in here]
        moved = [mesh for mesh in meshes if mesh.is_dir()]
        if moved:
            raise InputError(f"{moved[0]}: the mesh changes in time; of decomposed cases it must not.")
        for name in (*times, *here):
            if (name in times) != (name in here):
                lacking, having = (folder, folders[0]) if name in times else (folders[0], folder)
                raise InputError(f"{lacking}: no time {name}, which {having.name} has.")
    return times


def read_part(case: Path, folder: Path, region: str) -> Part:
    """Read what a processor folder holds of the mesh; InputError if it is missing, broken or inconsistent."""
    mesh = folder / "constant" / region / "polyMesh"
    for name in _MESH:
        if existing(mesh / name) is None:
            raise InputError(f"{mesh / name}: no such file.")
    for name in _ADDRESSING:
        if existing(mesh / name) is None:
            raise InputError(
                f"{mesh / name}: no such file. Without decomposePar's addressing the parts cannot be put "
                "together here: run reconstructParMesh and reconstructPar."
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
    """The patches of the whole case, and at which boundary face each begins, and the last ends."""
    known: dict[int, PatchInfo] = {}
    counts: dict[int, int] = {}
    for part in parts:
        names = [patch.name for patch in part.patches]
        for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
            if at >= 0:
                known.setdefault(at, patch)
                counts[at] = counts.get(at, 0) + patch.faces
            elif "referPatch" in patch.entries and patch.entries["referPatch"] in names:
                # A cyclic patch whose two sides lie on different processors.
                whole = int(part.patch_at[names.index(patch.entries["referPatch"])])
                counts[whole] = counts.get(whole, 0) + patch.faces
    if sorted(known) != list(range(len(known))):
        raise InputError(f"{case}: the processor folders do not name all patches of the mesh.")
    patches = [known[at]._replace(faces=counts[at]) for at in range(len(known))]
    return patches, np.concatenate([[0], np.cumsum([patch.faces for patch in patches])]).astype(np.int64)
