"""OpenFOAM's fields on cells and patches, in double precision."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.read.foamfile import COMPONENTS, FIELDS, FoamFile

_NONUNIFORM = re.compile(rb"\bnonuniform\s+List<(?P<inner>%b)>\s*(?=\d)" % b"|".join(COMPONENTS))
_NO_DICTIONARY = re.compile(rb"\bboundaryField\b(?!\s*\{)")


class Field(NamedTuple):
    """A ``volVectorField`` of 3 components, or a ``volTensorField`` of 9."""

    cells: Floats
    """(n_cells, components), or (1, components) if they are all alike."""
    patches: dict[str, tuple[str, Floats | None]]
    """Type, and the values if there are any: (n_faces, components), or one row if they are all alike."""


def require_lists(path: Path) -> None:
    """Raise InputError if a binary field is broken in ways on which VTK's reader crashes.

    Each list must be as long as it says, and ``boundaryField`` a dictionary.
    """
    file = FoamFile(path)
    if file.binary and (bare := _NO_DICTIONARY.search(file.data, file.at)) is not None:
        file.at = bare.end()
        raise file.broken("'{'")
    while file.binary and (match := _NONUNIFORM.search(file.data, file.at)) is not None:
        file.at = match.end()
        inner = match["inner"]
        file.list(COMPONENTS[inner], file.label if inner == b"label" else None)


def read_field(path: Path, kind: str = "volVectorField") -> Field:
    """Read a ``volVectorField`` or a ``volTensorField``.

    Raises
    ------
    InputError
        The file is missing, broken, or another field.
    """
    file = FoamFile(path)
    if file.kind != kind:
        raise InputError(f"{file.path}: the class is {file.kind or '(none)'}, not {kind}.")
    cells: Floats | None = None
    patches: dict[str, tuple[str, Floats | None]] | None = None
    while file.at < len(file.data):
        key = file.word()
        if key == b"boundaryField":
            patches = _patch_fields(file)
        elif file.take(b"{"):
            file.dictionary()
        elif key == b"internalField":
            cells = file.value()
        else:
            file.value()
    if cells is None or patches is None:
        raise InputError(
            f"{file.path}: no internalField of {FIELDS[kind].decode()}s and boundaryField; the file is cut "
            "short."
        )
    return Field(cells, patches)


def _patch_fields(file: FoamFile) -> dict[str, tuple[str, Floats | None]]:
    file.need(b"{")
    patches = {}
    while not file.take(b"}"):
        name = file.word().decode("utf-8", "replace").strip('"')
        file.need(b"{")
        entries, fields = file.dictionary()
        patches[name] = entries.get("type", ""), fields.get("value")
    return patches
