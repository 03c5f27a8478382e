"""Files of OpenFOAM: fields on a mesh, and clouds of particles."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.results.atomic import atomic_write, write_text

Floats = NDArray[np.float64]


GENERIC = frozenset({"patch", "wall", "mappedWall", "mappedPatch"})
"""Types of patches on which a field may have any boundary condition."""


class PatchValues(NamedTuple):
    """Field on a patch."""

    type: str
    """Type of the patch field: ``calculated``, or the type of a constraint patch such as ``empty``."""
    values: Floats | None = None
    """Values at the faces; None for a constraint patch."""


def write_field(
    path: Path,
    dimensions: Sequence[int],
    cells: Floats,
    patches: Mapping[str, PatchValues],
    name: str | None = None,
    *,
    binary: bool = False,
) -> None:
    """Write a ``volScalarField`` or a ``volSymmTensorField`` in one step, as text or binary.

    Parameters
    ----------
    path
        The file.
    dimensions
        Exponents of kg, m, s, K, mol, A, cd.
    cells
        Values at the cells, (n,), or (n, 6) in the order xx yy zz xy yz xz.
    patches
        Fields on the patches by name, in the order of the mesh.
    name
        Name of the field; by default the file's.
    binary
        Whether lists are little-endian doubles.
    """
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        kind = "volScalarField" if cells.ndim == 1 else "volSymmTensorField"
        file.write(_header(kind, name or path.name, binary=binary).encode())
        file.write(f"dimensions      [{' '.join(map(str, dimensions))}];\n\ninternalField   ".encode())
        file.write(_values(cells, binary) + b";\n\nboundaryField\n{\n")
        for key, patch in patches.items():
            word = key if key.replace("_", "").replace("-", "").isalnum() else f'"{key}"'
            file.write(f"    {word}\n    {{\n        type            {patch.type};\n".encode())
            if patch.values is not None:
                file.write(b"        value           " + _values(patch.values, binary) + b";\n")
            file.write(b"    }\n")
        file.write(b"}\n")


def _values(values: Floats, binary: bool) -> bytes:
    """Return a list of values as it is in a file."""
    n = len(values)
    if n and (values == values[0]).all():
        return f"uniform {_items(values[:1])[0]}".encode()
    head = f"nonuniform List<{'scalar' if values.ndim == 1 else 'symmTensor'}> {n}\n(".encode()
    if binary:
        ordered = values if values.ndim == 1 else values[:, SYMMETRIC]
        return head + ordered.astype("<f8").tobytes() + b")"
    return head + "".join(["\n", *(f"{item}\n" for item in _items(values)), ")"]).encode()


def _items(values: Floats) -> list[str]:
    """Return the text of each value."""
    if values.ndim == 1:
        return [f"{v!r}" for v in values.tolist()]
    return [f"({' '.join(map(repr, v))})" for v in values[:, SYMMETRIC].tolist()]


_CLASSES = {1: "scalarField", 3: "vectorField", 6: "symmTensorField", 9: "tensorField"}
SYMMETRIC = [0, 3, 5, 1, 4, 2]
"""Indices of xx xy xz yy yz zz among xx yy zz xy yz xz."""
_GEOMETRY = "geometry        positions;\n"


def remove_lagrangian(case: Path, cloud: str) -> None:
    """Remove the files of :func:`write_lagrangian` of a cloud at all times of a case, and no others."""
    for properties in case.glob(f"[0-9]*/uniform/lagrangian/{cloud}/cloudProperties"):
        # OpenFOAM's own files have more entries.
        if not properties.read_text(encoding="utf-8", errors="replace").endswith(f"}}\n\n{_GEOMETRY}"):
            continue
        time = properties.parents[3]
        shutil.rmtree(time / "lagrangian" / cloud, ignore_errors=True)
        shutil.rmtree(properties.parent)
        for folder in ("lagrangian", "uniform/lagrangian", "uniform", "."):
            # Only an empty folder can be removed.
            with suppress(OSError):
                (time / folder).rmdir()


def write_lagrangian(
    folder: Path, points: Floats, cells: NDArray[np.int64], arrays: Mapping[str, NDArray[Any]]
) -> None:
    """Write a cloud in OpenFOAM's format, plain text: ``positions``, and a file for each array.

    ``<time>/uniform/lagrangian/<cloud>/cloudProperties`` declares the format of the positions.

    Parameters
    ----------
    folder
        ``<time>/lagrangian/<cloud>``.
    points
        Positions, (n, 3), m.
    cells
        Indices of the cells that contain them, (n,).
    arrays
        Values by name, (n,) or (n, k) with k of 1, 3, 6 (xx yy zz xy yz xz) or 9. Other arrays are left out,
        as OpenFOAM has no files for them. NaN and infinity are written as 0.
    """
    time = folder.parents[1]
    properties = time / "uniform" / "lagrangian" / folder.name / "cloudProperties"
    # Without this file OpenFOAM would expect barycentric coordinates, and find no particles.
    location = str(properties.parent.relative_to(time.parent))
    for place in (folder, properties.parent):
        place.mkdir(parents=True, exist_ok=True)
    write_text(properties, _header("dictionary", properties.name, location) + _GEOMETRY)
    n = len(points)
    lines = [
        f"({x!r} {y!r} {z!r}) {c}\n" for (x, y, z), c in zip(points.tolist(), cells.tolist(), strict=True)
    ]
    _write_list(folder / "positions", "Cloud<passiveParticle>", n, lines)
    for name, array in arrays.items():
        components = 1 if array.ndim == 1 else array.shape[1]
        if components not in _CLASSES:
            continue
        if array.dtype.kind == "f":
            plain, kind = np.nan_to_num(array, nan=0.0, posinf=0.0, neginf=0.0), _CLASSES[components]
        else:
            plain, kind = array.astype(np.int64), "labelField"
        rows = plain[:, SYMMETRIC] if components == 6 else plain
        if components == 1:
            lines = [f"{value!r}\n" for value in rows.tolist()]
        else:
            lines = [f"({' '.join(map(repr, row))})\n" for row in rows.tolist()]
        _write_list(folder / name, kind, n, lines)


def _header(kind: str, name: str, location: str = "", binary: bool = False) -> str:
    place = f'    location    "{location}";\n' if location else ""
    form = 'binary;\n    arch        "LSB;label=32;scalar=64"' if binary else "ascii"
    return (
        f"FoamFile\n{{\n    version     2.0;\n    format      {form};\n    class       {kind};\n"
        f"{place}    object      {name};\n}}\n\n"
    )


def _write_list(path: Path, kind: str, n: int, lines: Sequence[str]) -> None:
    head = _header(kind, path.name, "/".join(path.parts[-4:-1]))
    write_text(path, f"{head}{n}\n(\n{''.join(lines)})\n")
