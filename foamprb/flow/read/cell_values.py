"""Values of a field in all cells, without the mesh: of a case, or of its processor folders."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.read.case import available_times, is_only_decomposed, mesh_folder
from foamprb.flow.read.field import Kind, read_field
from foamprb.flow.read.processors import Processors


def solution_times(case: Path, region: str) -> tuple[str, ...]:
    """Return the names of the times of the solution, in the case or in its processor folders."""
    if not case.is_dir():
        return ()
    return Processors(case).times()[0] if is_only_decomposed(case, region) else available_times(case)


def has_field(case: Path, region: str, time: str, name: str) -> bool:
    """Return whether there is a field at a time of the solution."""
    top = Processors(case).folders[0] if is_only_decomposed(case, region) else case
    return existing(top / time / region / name) is not None


def cell_values(case: Path, region: str, time: str, name: str, kind: Kind) -> Floats:
    """Read a field at a time of the solution.

    Returns
    -------
    The values in the order of the whole mesh if it is known, (n_cells, components); or (1, components) if
    they are all alike in a case that is not decomposed.
    """
    if not is_only_decomposed(case, region):
        return read_field(case / time / region / name, kind, case).cells
    processors = Processors(case)
    first, relative = processors.folders[0], Path(time) / region / name
    files = processors.files(relative)
    if files is None:
        raise InputError(f"{first / relative}: no such file.")
    parts = [read_field(file, kind, case).cells for file in files]
    mesh = mesh_folder(first, time, region).relative_to(first)
    addresses = processors.files(mesh / "cellProcAddressing")
    if addresses is None:
        owners = processors.files(mesh / "owner") or ()
        counts = [int(file.labels().max(initial=-1)) + 1 for file in owners]
        places = np.arange(sum(counts))
    else:
        labels = [file.labels() for file in addresses]
        counts, places = [len(own) for own in labels], np.concatenate(labels)
    for file, part, count in zip(files, parts, counts, strict=True):
        if len(part) not in (1, count):
            raise InputError(f"{file.path}: {len(part)} cells, but the mesh there has {count}.")
    pairs = zip(parts, counts, strict=True)
    values = np.concatenate([np.broadcast_to(part, (n, part.shape[1])) for part, n in pairs])
    return values[np.argsort(places)]
