"""Folders and files of a case: times, regions, dictionaries, meshes and fields."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.tree import Dictionary, Stream, unquoted
from foamprb.errors import InputError, suggestion
from foamprb.flow.read.field import Kind
from foamprb.flow.read.foamfile import header, read_cell_zones
from foamprb.flow.read.times import choose_times, listed, pick_time


class MissingFieldError(InputError):
    """Error: a field is missing at a time."""


_TIME_NAME = re.compile(r"-?\d+(\.\d*)?([eE][-+]?\d+)?")


_OFF = frozenset({"no", "off", "false", "n", "f", "none"})


def find_dictionary(case: Path, region: str, *names: str) -> Dictionary | None:
    """Read the first of some dictionaries in ``constant`` or ``system`` of a region, else of the case.

    Returns None if there is no such file; raises InputError if it cannot be read.
    """
    path = find_file(case, region, *names)
    return None if path is None else read_dictionary(path, case)


def find_file(case: Path, region: str, *names: str) -> Path | None:
    """Return the first of :func:`find_files`, or None."""
    return next(find_files(case, region, *names), None)


def find_files(case: Path, region: str, *names: str) -> Iterator[Path]:
    """Yield the existing ones of some files in ``constant`` or ``system`` of a region, then of the case."""
    for part in dict.fromkeys((region, "")):
        for path in (case / folder / part / name for name in names for folder in ("constant", "system")):
            if existing(path) is not None:
                yield path


def active_zones(root: Dictionary) -> list[Dictionary]:
    """Return the dictionaries in a dictionary that are not switched off by ``active``."""
    entries = [entry for entry in root.entries.values() if isinstance(entry, Dictionary)]
    return [entry for entry in entries if word_of(entry, "active") not in _OFF]


def word_of(dictionary: Dictionary, key: str, default: str = "") -> str:
    """Return the text of an entry."""
    entry = dictionary.entries.get(key)
    return entry.text if isinstance(entry, Stream) else default


def available_times(case: Path) -> tuple[str, ...]:
    """Return the names of the time directories, as OpenFOAM wrote them, in the order of time."""
    names = [path.name for path in case.iterdir() if path.is_dir() and _TIME_NAME.fullmatch(path.name)]
    return tuple(sorted(names, key=float))


def regions(case: Path) -> tuple[str, ...]:
    """Return the names of the regions of a case; none for a case with one mesh.

    Without any mesh, they are read from ``constant/regionProperties``.
    """
    for folder in ("constant", *available_times(case)):
        with_mesh = {path.parents[1].name for path in case.glob(f"{folder}/*/polyMesh/faces*")}
        if with_mesh:
            return tuple(sorted(with_mesh))
        if (case / folder / "polyMesh").is_dir():
            break
    return tuple(sorted(_listed_regions(case)))


def _listed_regions(case: Path) -> set[str]:
    """Return the words in the inner parentheses of ``regions ( fluid (air water) solid (heater) )``."""
    try:
        root = find_dictionary(case, "", "regionProperties")
    except InputError:
        return set()
    text = word_of(root, "regions") if root else ""
    return {unquoted(word) for words in re.findall(r"\(([^()]*)\)", text) for word in words.split()}


def select_time(case: Path, time: float | str = "latestTime", region: str = "") -> str:
    """Return the name of the time directory of a time: ``latestTime``, or a value."""
    names = _require_times(case, region)
    name = names[pick_time(case, names, time)]
    if time == "latestTime":
        _require_latest(case, name)
    if not os.access(case / name, os.R_OK | os.X_OK):
        raise InputError(f"{case / name}: this folder cannot be read: no permission.")
    return name


def _require_times(case: Path, region: str) -> tuple[str, ...]:
    """Return the times; InputError if there is no case, or it has no times."""
    require_case(case, region)
    names = available_times(case)
    if not names:
        split = " Only decomposed times are there: run reconstructPar." if processor_folders(case) else ""
        raise InputError(f"{case}: no time directories; has the solver been run?{split}")
    return names


def _require_latest(case: Path, name: str) -> None:
    """Raise InputError if a later time exists that is not a folder: a file, or a broken link."""
    for path in case.iterdir():
        if _TIME_NAME.fullmatch(path.name) and not path.is_dir() and float(path.name) > float(name):
            raise InputError(
                f"{path}: named like a time, but not a readable folder. The latest readable time is {name}: "
                f"-time {name}."
            )


def require_case(case: Path, region: str) -> None:
    """Raise InputError if there is no case with a mesh, or it does not have the region."""
    if not case.is_dir():
        raise InputError(f"{case}: no such folder.")
    names = regions(case)
    require_region(case, region, names)
    last = (available_times(case) or (None,))[-1]
    if existing(mesh_folder(case, last, region) / "faces") is not None:
        return
    if processor_folders(case):
        raise InputError(
            f"{case}: only the processor folders hold a mesh; run reconstructParMesh and reconstructPar."
        )
    if not region:
        require_choice(case, names)
    folder = case / "constant" / region / "polyMesh"
    if existing(case / "system/controlDict") is not None:
        raise InputError(
            f"{folder}: no mesh here. Make it and the flow first, as by blockMesh and simpleFoam."
        )
    raise InputError(f"{folder}: no mesh here; is {case} an OpenFOAM case?")


def require_region(case: Path, region: str, names: Sequence[str]) -> None:
    """Raise InputError if a case of these regions does not have a named region."""
    if region and region not in names:
        raise InputError(
            f"{case}: no region {region}. {suggestion(region, names)}"
            if names
            else f"{case}: no region {region}; the case is not divided into regions."
        )


def require_choice(case: Path, names: Sequence[str]) -> None:
    """Raise InputError if a case without its own mesh has regions, of which one must be chosen."""
    if names:
        raise InputError(
            f"{case}: the mesh is divided into regions; choose one with -region. Allowed: {', '.join(names)}."
        )


def processor_folders(case: Path) -> list[Path]:
    """Return the folders of processors that hold anything."""
    return [
        path
        for path in sorted(case.glob("processor*"))
        if (path / "constant").is_dir() or available_times(path)
    ]


def is_only_decomposed(case: Path, region: str = "") -> bool:
    """Return True if only the processor folders hold the solution: no mesh beside them, or no time but 0."""
    folders = processor_folders(case)
    if not folders:
        return False
    last = (available_times(case) or (None,))[-1]
    if existing(mesh_folder(case, last, region) / "faces") is None:
        return not regions(case) or bool(region)
    return float(last or 0) == 0.0 and float((available_times(folders[0]) or (0,))[-1]) != 0.0


def later_times(case: Path) -> tuple[str, ...]:
    """Return a note if processor folders have later times than the case."""
    folders, names = processor_folders(case), available_times(case)
    beyond = available_times(folders[0])[-1:] if folders else ()
    if not beyond or not names or float(beyond[0]) <= float(names[-1]):
        return ()
    return (
        f"The processor folders have the later time {beyond[0]}, which is not read: the latest "
        f"reconstructed one is {names[-1]}. -decomposed reads the processor folders.",
    )


def mesh_folder(case: Path, time: str | None, region: str, part: str = "faces") -> Path:
    """Return the ``polyMesh`` folder whose faces, or another ``part`` of the mesh, are valid at a time."""
    folder = case / "constant" / region / "polyMesh"
    for name in available_times(case):
        changed = case / name / region / "polyMesh"
        if time is not None and float(name) <= float(time) and existing(changed / part) is not None:
            folder = changed
    return folder


def mesh_files(case: Path, time: str | None, region: str) -> tuple[Path, ...]:
    """Return the files of the mesh at a time, without ``.gz``: points first, then faces and the rest."""
    folder = mesh_folder(case, time, region)
    points = mesh_folder(case, time, region, "points")
    return (points / "points", *(folder / name for name in ("faces", "owner", "neighbour", "boundary")))


def field_path(folder: Path, field: str, kind: Kind) -> Path:
    """Return the file of a field in a time directory; InputError if it is missing or of another class."""
    path = existing(folder / field)
    if path is None:
        regional = sorted(
            each.parent.name for each in folder.glob(f"*/{field}*") if each.name in (field, f"{field}.gz")
        )
        hint = f" These regions have it: {', '.join(regional)}; choose one with -region." if regional else ""
        raise MissingFieldError(
            f"{folder}: no field {field}; the fields are {listed(fields_of(folder))}.{hint}"
        )
    kind_of_file = header(path).get("class", "(none)")
    if kind_of_file != kind.name:
        raise InputError(f"{path}: the class is {kind_of_file}, but {kind.meaning} is a {kind.name}.")
    return path


def fields_of(folder: Path) -> dict[str, str]:
    """Return the classes of the fields of a time directory by name."""
    classes = {}
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if path.is_file():
            kind = header(path).get("class", "")
            if kind.endswith("Field"):
                classes[path.name.removesuffix(".gz")] = kind
    return classes


def cell_zones(folder: Path) -> Mapping[str, NDArray[np.int64]]:
    """Read the cells of each zone by name from a folder ``polyMesh``; InputError if the file is broken."""
    path = existing(folder / "cellZones")
    return {} if path is None else read_cell_zones(path)


def shown(path: Path) -> Path:
    """Return the name of a file as it is on disk, for messages."""
    return existing(path) or path


def select_times(
    case: os.PathLike[str] | str, selection: str | None = None, region: str = ""
) -> tuple[str, ...]:
    """Return the names of the selected time directories of a case, in the order of time.

    Parameters
    ----------
    case, region
        Folder of the case, and a region of its mesh.
    selection
        Values and ranges ``a:b``, ``a:`` or ``:b`` (ends included), separated by commas or blanks;
        ``latestTime``; None for all.

    Raises
    ------
    InputError
        The case cannot be read; a value or a range selects nothing; or two names are the same time.
    """
    case = Path(case)
    return choose_times(case, _require_times(case, region), selection)
