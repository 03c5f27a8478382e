"""Files of OpenFOAM: fields on a mesh, and clouds of particles."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.results.atomic import atomic_write

__all__ = ["PatchValues", "remove_lagrangian", "write_lagrangian", "write_scalar_field"]

Floats = NDArray[np.float64]


class PatchValues(NamedTuple):
    """Boundary condition and values of a field on a patch."""

    type: str
    """``calculated``, or the type of a constraint patch."""
    values: Floats | None = None
    """One value per face."""


def write_scalar_field(
    path: Path, dimensions: Sequence[int], cells: Floats, patches: Mapping[str, PatchValues]
) -> None:
    """Write a ``volScalarField``, plain text, in one step.

    Parameters
    ----------
    path
        The file; its name is the field's.
    dimensions
        Exponents of kg, m, s, K, mol, A, cd.
    cells
        One value per cell.
    patches
        By their names, in the order of the mesh.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    parts = [
        "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       volScalarField;\n"
        f"    object      {path.name};\n}}\n\ndimensions      [{' '.join(map(str, dimensions))}];\n\n"
        f"internalField   {_values(cells)};\n\nboundaryField\n{{\n"
    ]
    for name, patch in patches.items():
        value = "" if patch.values is None else f"        value           {_values(patch.values)};\n"
        parts.append(f"    {_key(name)}\n    {{\n        type            {patch.type};\n{value}    }}\n")
    parts.append("}\n")
    with atomic_write(path) as temporary:
        temporary.write_text("".join(parts), encoding="utf-8")


def _values(values: Floats) -> str:
    if len(values) and (values == values[0]).all():
        return f"uniform {float(values[0])!r}"
    return f"nonuniform List<scalar> {len(values)}\n(\n" + "".join(f"{v!r}\n" for v in values.tolist()) + ")"


def _key(name: str) -> str:
    return name if name.replace("_", "").replace("-", "").isalnum() else f'"{name}"'


_CLASSES = {1: "scalarField", 3: "vectorField", 6: "symmTensorField", 9: "tensorField"}
_SYMMETRIC = [0, 3, 5, 1, 4, 2]
"""Indices of xx xy xz yy yz zz among xx yy zz xy yz xz."""


_GEOMETRY = "geometry        positions;\n"


def remove_lagrangian(case: Path, cloud: str) -> None:
    """Remove the files of :func:`write_lagrangian` for a cloud at all times of a case, and nothing else.

    Raises
    ------
    OSError
        If a file cannot be removed.
    """
    for own in case.glob(f"[0-9]*/uniform/lagrangian/{cloud}/cloudProperties"):
        # OpenFOAM's own files have more entries.
        if not own.read_text(encoding="utf-8", errors="replace").endswith(f"}}\n\n{_GEOMETRY}"):
            continue
        time = own.parents[3]
        shutil.rmtree(time / "lagrangian" / cloud, ignore_errors=True)
        shutil.rmtree(own.parent)
        for folder in ("lagrangian", "uniform/lagrangian", "uniform", "."):
            # The folder contains nothing else.
            with suppress(OSError):
                (time / folder).rmdir()


def write_lagrangian(
    folder: Path, points: Floats, cells: NDArray[np.int64], arrays: Mapping[str, NDArray[Any]]
) -> None:
    """Write a cloud in OpenFOAM's ascii format: ``positions``, and a file per array.

    ``<time>/uniform/lagrangian/<cloud>/cloudProperties`` declares them as positions.

    Parameters
    ----------
    folder
        ``<time>/lagrangian/<cloud>``.
    points
        Positions, (n, 3), m.
    cells
        Cell of each particle.
    arrays
        Values by name, (n,) or (n, k) with k of 1, 3, 6 (xx yy zz xy yz xz) or 9; OpenFOAM has no files for
        other shapes, which are left out. NaN and infinity are written as 0.

    Raises
    ------
    OSError
        If a file cannot be written.
    """
    time = folder.parents[1]
    own = time / "uniform" / "lagrangian" / folder.name / "cloudProperties"
    with atomic_write(own) as temporary:
        # Without it OpenFOAM expects barycentric coordinates, and finds no particles.
        head = _header("dictionary", str(own.parent.relative_to(time.parent)), own.name)
        temporary.write_text(head + _GEOMETRY, encoding="utf-8")
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
        rows = plain[:, _SYMMETRIC] if components == 6 else plain
        if components == 1:
            lines = [f"{value!r}\n" for value in rows.tolist()]
        else:
            lines = [f"({' '.join(map(repr, row))})\n" for row in rows.tolist()]
        _write_list(folder / name, kind, n, lines)


def _header(kind: str, location: str, name: str) -> str:
    return (
        f"FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {kind};\n"
        f'    location    "{location}";\n    object      {name};\n}}\n\n'
    )


def _write_list(path: Path, kind: str, n: int, lines: Sequence[str]) -> None:
    head = _header(kind, "/".join(path.parts[-4:-1]), path.name)
    with atomic_write(path) as temporary:
        temporary.write_text(f"{head}{n}\n(\n{''.join(lines)})\n", encoding="utf-8")
