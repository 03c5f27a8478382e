"""Cloud over time as a LAMMPS dump, which OVITO shows as ellipsoids."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from foamprb.results.atomic import atomic_write
from foamprb.results.vtk import PointCloud

__all__ = ["write_dump"]

_COLUMNS = (
    "id type x y z shapex shapey shapez quatw quati quatj quatk vx vy vz taylorDeformation shearRate status"
)
_LEAST = 1e-300


def write_dump(path: Path, clouds: Iterable[PointCloud]) -> None:
    """Write the clouds of all times into one text file, in one step.

    Each body is an ellipsoid with the diameters ``shapex`` to ``shapez`` along axes that the quaternion
    rotates. Its ``type`` is the index of its injection model plus 1. Lengths are in µm, as bodies are too
    small for OVITO in m; times are in s.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    with atomic_write(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        for step, cloud in enumerate(clouds):
            x, a = 1e6 * cloud.points, cloud.arrays
            n = len(x)
            low, high = (x.min(axis=0), x.max(axis=0)) if n else (np.zeros(3), np.zeros(3))
            bounds = "".join(f"{p:.9g} {q:.9g}\n" for p, q in zip(low, high + _LEAST, strict=True))
            file.write(
                f"ITEM: UNITS\nmicro\nITEM: TIME\n{cloud.time!r}\nITEM: TIMESTEP\n{step}\n"
                f"ITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS ff ff ff\n{bounds}ITEM: ATOMS {_COLUMNS}\n"
            )
            rows = np.column_stack(
                [
                    a["origId"] + 1, a["injector"] + 1, x, 2e6 * a["semiAxes"].reshape(n, 3),
                    a["orientation"].reshape(n, 4), a["U"].reshape(n, 3), a["taylorDeformation"],
                    a["shearRate"], a["status"],
                ]
            )  # fmt: skip
            np.savetxt(file, rows, fmt="%d %d" + " %.9g" * 15 + " %d")
