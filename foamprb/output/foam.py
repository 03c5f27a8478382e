"""Fields in OpenFOAM's files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.output.atomic import atomic_write

__all__ = ["PatchValues", "write_scalar_field"]

Floats = NDArray[np.float64]


class PatchValues(NamedTuple):
    """What a field is on a patch."""

    type: str
    """``calculated``, or that of a patch whose type says it all."""
    values: Floats | None = None
    """One for each face."""


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
        Values, one for each cell.
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
