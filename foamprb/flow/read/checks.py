"""Checks of what VTK's readers pass over in silence or crash on: numbers, volumes, labels, faces."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from foamprb.dictionary.files import existing, read_bytes
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.case import shown
from foamprb.flow.read.foamfile import header, read_faces, read_labels, require_room

LARGEST = 1e30
"""Of lengths in m and velocities in m/s, so that products of a few of them stay finite."""


def require_numbers(values: Floats, source: Path, what: str, where: str = "number") -> None:
    """Refuse rows that are not finite, or larger than any length or velocity.

    Parameters
    ----------
    values, source
        (n, components), and the file that they are from.
    what, where
        What a row is called, and where it is, before its number.

    Raises
    ------
    InputError
        How many of them, and the first.
    """
    bad = np.flatnonzero(~(np.abs(values) <= LARGEST).all(axis=1))
    if len(bad):
        first = " ".join(f"{x:g}" for x in values[bad[0]])
        raise InputError(
            f"{source}: {len(bad)} of {len(values)} {what}s are not finite numbers below {LARGEST:g}; the "
            f"first is ({first}) {where} {bad[0]}."
        )


def require_volumes(mesh: Mesh, source: Path) -> None:
    """Refuse a mesh that cannot be one.

    Raises
    ------
    InputError
        Cells have no volume or are inside out.
    """
    flat = np.flatnonzero(~(mesh.volumes > 0.0))
    if len(flat):
        x = "({:g} {:g} {:g})".format(*mesh.centres[flat[0]])
        raise InputError(
            f"{source}: {len(flat)} of {mesh.n_cells} cells have no positive volume; the first is cell "
            f"{flat[0]} at {x}. Is the mesh damaged? (checkMesh tells)"
        )


def noted_counts(folder: Path) -> dict[str, int]:
    """Counts that OpenFOAM notes in the header of ``owner``: nPoints, nCells, nFaces, nInternalFaces."""
    for name in ("faces", "owner", "neighbour"):
        if existing(folder / name) is None:
            raise InputError(f"{folder / name}: no such file.")
    note = header(shown(folder / "owner")).get("note", "")
    return {word: int(number) for word, number in re.findall(r"(n\w+):\s*(\d+)", note)}


def require_labels(folder: Path, noted: dict[str, int]) -> None:
    """Raise InputError for broken faces, and for owners and neighbours that are not the numbers of cells.

    VTK would allocate memory for as many cells.
    """
    for name in ("points", "faces"):
        if existing(folder / name) is not None:
            require_room(folder / name)
    faces = 0
    for name in ("owner", "neighbour"):
        path = shown(folder / name)
        labels = read_labels(path)
        faces = max(faces, len(labels))
        # There are fewer cells than faces in any mesh.
        limit = noted.get("nCells", faces)
        wrong = np.flatnonzero((labels < 0) | (labels >= limit))
        if len(wrong):
            raise InputError(
                f"{path}: face {wrong[0]} belongs to cell {labels[wrong[0]]}, but there are {limit} cells."
            )
    _require_faces(shown(folder / "faces"), 10 * max(faces, noted.get("nPoints", 0)))


def _require_faces(path: Path, limit: int) -> None:
    """Refuse lists of faces that VTK does not survive: lengths that do not fit, or beyond all memory."""
    if header(path).get("class") == "faceCompactList":
        read_faces(path)
        return
    data = read_bytes(path)
    long = re.compile(rb"\d{%d,}" % (len(str(limit)) + 1)).search(data, max(data.find(b"}"), 0))
    if long is not None:
        line = data.count(b"\n", 0, long.start()) + 1
        raise InputError(
            f"{path}: line {line}: {long[0][:30].decode()} is neither a point nor a number of them."
        )
