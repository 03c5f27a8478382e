"""The folders of a case: its times, its regions, the mesh and the fields that hold at a time."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError, suggestion
from foamprb.flow.read.field import Kind
from foamprb.flow.read.foamfile import header, read_cell_zones
from foamprb.flow.read.times import choose_times, listed, pick_time

_TIME_NAME = re.compile(r"\d+(\.\d*)?([eE][-+]?\d+)?")


def available_times(case: Path) -> tuple[str, ...]:
    """Names of the time directories, as OpenFOAM wrote them, in the order of time."""
    names = [path.name for path in case.iterdir() if path.is_dir() and _TIME_NAME.fullmatch(path.name)]
    return tuple(sorted(names, key=float))


def regions(case: Path) -> tuple[str, ...]:
    """Names of the regions of a case whose mesh is divided into regions; none for a case of one mesh."""
    return tuple(sorted(path.parents[1].name for path in case.glob("constant/*/polyMesh/faces*")))


def select_time(case: Path, time: float | str = "latestTime", region: str = "") -> str:
    """Name of the time directory that ``time`` means: ``latestTime``, or a value.

    Raises
    ------
    InputError
        The case has no such time; the message lists those that it has.
    """
    require_case(case, region)
    names = available_times(case)
    if not names:
        split = " Only decomposed times are there: run reconstructPar." if is_decomposed(case) else ""
        raise InputError(f"{case}: no time directories; has the solver been run?{split}")
    return names[pick_time(case, names, time)]


def require_case(case: Path, region: str) -> None:
    """Raise InputError if there is no case with a mesh, or the region is not one of its regions."""
    if not case.is_dir():
        raise InputError(f"{case}: no such folder.")
    names = regions(case)
    require_region(case, region, names)
    if existing(case / "constant" / region / "polyMesh" / "faces") is not None:
        return
    if is_decomposed(case):
        raise InputError(
            f"{case}: only the processor folders hold a mesh; run reconstructParMesh and reconstructPar."
        )
    require_choice(case, names)
    raise InputError(f"{case / 'constant' / 'polyMesh'}: no mesh here; is {case} an OpenFOAM case?")


def require_region(case: Path, region: str, names: Sequence[str]) -> None:
    """Raise InputError if a region is named that a case of these regions does not have."""
    if region and region not in names:
        raise InputError(
            f"{case}: no region {region}. {suggestion(region, names)}"
            if names
            else f"{case}: no region {region}; the case is not divided into regions."
        )


def require_choice(case: Path, names: Sequence[str]) -> None:
    """Raise InputError if a case without a mesh of its own has regions, of which one must be chosen."""
    if names:
        raise InputError(
            f"{case}: the mesh is divided into regions; choose one with -region. Allowed: {', '.join(names)}."
        )


def is_decomposed(case: Path) -> bool:
    """Whether there are processor folders."""
    return any(case.glob("processor*/constant")) or any(case.glob("processors*/constant"))


def mesh_folder(case: Path, time: str | None, region: str) -> Path:
    """The ``polyMesh`` folder whose topology holds at the time."""
    folder = case / "constant" / region / "polyMesh"
    for name in available_times(case):
        changed = case / name / region / "polyMesh"
        if time is not None and float(name) <= float(time) and existing(changed / "faces") is not None:
            folder = changed
    return folder


def field_path(folder: Path, field: str, kind: Kind) -> Path:
    """The file of a field in a time directory; InputError if it is missing or of another class."""
    path = existing(folder / field)
    if path is None:
        raise InputError(f"{folder}: no field {field}; the fields are {listed(fields_of(folder))}.")
    found = header(path).get("class", "(none)")
    if found != kind.name:
        raise InputError(f"{path}: the class is {found}, but {kind.meaning} is a {kind.name}.")
    return path


def fields_of(folder: Path) -> dict[str, str]:
    """Fields of a time directory, name → class."""
    found = {}
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if path.is_file():
            kind = header(path).get("class", "")
            if kind.endswith("Field"):
                found[path.name.removesuffix(".gz")] = kind
    return found


def cell_zones(folder: Path) -> Mapping[str, NDArray[np.int64]]:
    """The cells of each zone by name, of the mesh in a folder ``polyMesh``; InputError if they are broken."""
    path = existing(folder / "cellZones")
    return {} if path is None else read_cell_zones(path)


def shown(path: Path) -> Path:
    """The file's name as it is on disk, for a message."""
    return existing(path) or path


def select_times(case: Path, selection: str | None = None, region: str = "") -> tuple[str, ...]:
    """Names of the time directories of a case that ``selection`` means; see :func:`choose_times`.

    Raises
    ------
    InputError
        The case cannot be read; or as :func:`choose_times`.
    """
    select_time(case, region=region)
    return choose_times(case, available_times(case), selection)
