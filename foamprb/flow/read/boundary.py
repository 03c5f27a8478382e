"""Patches of ``polyMesh/boundary``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from math import radians
from pathlib import Path
from typing import Annotated, NamedTuple

from foamprb.dictionary.constraints import NonNegative, Vector3
from foamprb.dictionary.files import existing
from foamprb.dictionary.grammar import read_dictionary_list
from foamprb.dictionary.schema import read_entries
from foamprb.dictionary.tree import Stream, unquoted
from foamprb.errors import InputError, suggestion
from foamprb.flow.mesh.boundary import PatchSurface, Transform
from foamprb.flow.mesh.lists import Mask
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import CONSTRAINTS, KINDS
from foamprb.flow.read.foamfile import FoamFile

_SIMILAR = 0.84


class PatchInfo(NamedTuple):
    """Patch of ``polyMesh/boundary``."""

    name: str
    type: str
    faces: int
    start: int
    """Its first face."""
    neighbour: str
    """The patch that a coupled patch leads to."""
    transform: Transform
    """Motion from a cyclicAMI patch to its neighbour."""
    entries: dict[str, str]
    """All entries except dictionaries."""
    rows: Mask | None = None
    """Which of the faces in files of the case count, if some do not; see :mod:`foamprb.flow.read.overlap`."""

    @property
    def groups(self) -> frozenset[str]:
        """Return the groups of the patch; a constraint type or ``wall`` is a group too."""
        names = self.entries.get("inGroups", "").partition("(")[2].partition(")")[0].split()
        return frozenset(map(unquoted, names)) | ({self.type} & (CONSTRAINTS | {"wall"}))


class CaseMesh(NamedTuple):
    """Mesh of a case at a time, and its patches as the case lists them."""

    mesh: Mesh
    patches: tuple[PatchInfo, ...]
    notes: tuple[str, ...] = ()
    """Sentences for the user."""


@dataclass(frozen=True, kw_only=True)
class _BoundaryEntry:
    """Entries of a patch in ``polyMesh/boundary``."""

    type: str
    nFaces: Annotated[int, NonNegative]
    startFace: Annotated[int, NonNegative]
    neighbourPatch: str = ""
    transform: str = ""
    transformType: str = ""
    separationVector: Vector3 | None = None
    separation: Vector3 | None = None
    rotationAxis: Vector3 = (0.0, 0.0, 0.0)
    rotationCentre: Vector3 = (0.0, 0.0, 0.0)
    rotationAngle: float | None = None


# Characters that OpenFOAM does not allow in a word; VTK crashes on some of them.
_NO_WORD = re.compile(r"""[\s"'/;{}]""")


def read_boundary(path: Path, case: Path, file: FoamFile | None = None) -> tuple[PatchInfo, ...]:
    """Read the patches of ``polyMesh/boundary``, or of its contents if they have been read.

    Raises
    ------
    InputError
        The file is missing or broken; the name of a patch is not a word of OpenFOAM or occurs twice; a patch
        does not begin where the previous one ends; a type is misspelt, like ``wal``.
    """
    existing_file = existing(path)
    if existing_file is None:
        raise InputError(f"{path}: no such file.")
    try:
        return _patches(existing_file, case, file)
    except InputError as error:
        raise InputError(f"{case}: {error}") from None


def _patches(path: Path, case: Path, file: FoamFile | None) -> tuple[PatchInfo, ...]:
    patches: list[PatchInfo] = []
    text = None if file is None else file.data.decode("utf-8", "replace")
    for dictionary in read_dictionary_list(path, case, text).items:
        read = read_entries(_BoundaryEntry, dictionary, also=dictionary.entries)
        name = unquoted(dictionary.key)
        if _NO_WORD.search(name) or name in (".", ".."):
            raise dictionary.mistake("is no name for a patch: a word without blanks, / ; { } and quotes is.")
        if read.type not in KINDS and get_close_matches(read.type.lower(), KINDS, n=1, cutoff=_SIMILAR):
            raise dictionary.at("type").mistake(f"is '{read.type}'. {suggestion(read.type, KINDS)}")
        if any(name == patch.name for patch in patches):
            raise dictionary.mistake("occurs twice.")
        if patches and read.startFace != patches[-1].start + patches[-1].faces:
            expected = patches[-1].start + patches[-1].faces
            raise dictionary.mistake(
                f"starts at face {read.startFace}, but the patch before it ends at {expected}."
            )
        entries = {key: entry.text for key, entry in dictionary.entries.items() if isinstance(entry, Stream)}
        # OpenFOAM's angle is in degrees.
        angle = None if read.rotationAngle is None else radians(read.rotationAngle)
        # OpenFOAM.com and OpenFOAM.org have different words.
        kind, shift = read.transform or read.transformType, read.separationVector or read.separation
        transform = Transform(kind, shift, read.rotationAxis, read.rotationCentre, angle)
        patches.append(
            PatchInfo(name, read.type, read.nFaces, read.startFace, read.neighbourPatch, transform, entries)
        )
    return tuple(patch._replace(neighbour=_neighbour(patch, patches)) for patch in patches)


def _neighbour(patch: PatchInfo, patches: Sequence[PatchInfo]) -> str:
    """Return the neighbour of a coupled patch; ``coupleGroup`` names the group of both."""
    group = unquoted(patch.entries.get("coupleGroup", ""))
    if patch.neighbour or not group:
        return patch.neighbour
    others = [
        p.name for p in patches if p != patch and (group in p.groups or p.entries.get("coupleGroup") == group)
    ]
    return others[0] if len(others) == 1 else ""


def patches_of_mesh(patches: Sequence[PatchInfo]) -> list[PatchSurface]:
    """Return the patches as the mesh couples them.

    A nonConformalCyclic patch has no faces: it couples those of its ``originalPatch``.
    """
    surfaces = {
        p.name: PatchSurface(p.name, p.type, None, p.neighbour, p.transform, p.groups) for p in patches
    }
    originals = {
        p.name: p.entries.get("originalPatch", "") for p in patches if p.type == "nonConformalCyclic"
    }
    names = list(originals.values())
    for patch in patches:
        name = originals.get(patch.name, "")
        if name in surfaces:
            # Of an original with several neighbours, particles cannot know which one they enter.
            other = originals.get(patch.neighbour, "") if names.count(name) == 1 else ""
            # It is no wall, even if its type is.
            groups = surfaces[name].groups - {"wall"}
            surfaces[name] = PatchSurface(name, "cyclicAMI", None, other, patch.transform, groups)
    return list(surfaces.values())
