"""Where in the mesh particles spend their time, how deformed they are there, on which faces they settle."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import SAMPLE_INTERVAL, Memory, ObservedCloud, Rows
from foamprb.cloudfunctions.rows import close_ended, open_rows
from foamprb.dictionary.constraints import AtLeastOne
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import Mesh
from foamprb.results.foam import PatchValues, write_scalar_field

__all__ = ["ParticleStatistics"]

Floats = NDArray[np.float64]

_GENERIC = frozenset({"patch", "wall", "mappedWall", "mappedPatch"})
"""Types of patches on which a field may have any type."""
_DIMENSIONS: dict[str, tuple[int, ...]] = {
    "concentration": (0, -3, 0, 0, 0, 0, 0),
    "residenceTime": (0, 0, 1, 0, 0, 0, 0),
    "meanD": (0, 0, 0, 0, 0, 0, 0),
    "deposition": (0, -2, 0, 0, 0, 0, 0),
}


@dataclass(frozen=True)
class ParticleStatistics:
    """Fields on the mesh, in OpenFOAM's format, in a folder for each write time.

    ``concentration``, mean number of particles per volume since the start, 1/m³; ``residenceTime``, the time
    that all of them have spent in a cell, s; ``meanD``, the mean of Taylor's D over that time; and on the
    boundary ``deposition``, particles stuck per area of a face, 1/m². Of the time between two samples half
    counts for the cell at its beginning, and half for that at its end.
    """

    sampleInterval: Annotated[int, AtLeastOne, SAMPLE_INTERVAL] = 1

    @property
    def interval(self) -> int:
        """Steps between two samples."""
        return self.sampleInterval

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the cells in which all particles start, and sums of zero.

        Raises
        ------
        InputError
            If the flow has no mesh.
        """
        mesh, p = _mesh(cloud), cloud.particles
        return {
            "closed": np.zeros(p.size, dtype=bool),
            "t": p.t.copy(),
            "cell": _cells(mesh, p.host),
            "D": cloud.measure(np.arange(p.size), "taylorDeformation")[0],
            "time": np.zeros(mesh.n_cells),
            "timeD": np.zeros(mesh.n_cells),
        }

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add the time since the last sample to the sums of the cells."""
        mesh, p = _mesh(cloud), cloud.particles
        rows = open_rows(memory, p)
        half = 0.5 * (p.t[rows] - memory["t"][rows])
        # A particle that the mesh has lost counts where it was last.
        cell = np.where(p.host[rows] >= 0, _cells(mesh, p.host[rows]), memory["cell"][rows])
        (D,) = cloud.measure(rows, "taylorDeformation")
        for where, shape in ((memory["cell"][rows], memory["D"][rows]), (cell, D)):
            known = where >= 0
            memory["time"] += np.bincount(where[known], half[known], mesh.n_cells)
            memory["timeD"] += np.bincount(where[known], (half * shape)[known], mesh.n_cells)
        memory["t"][rows], memory["cell"][rows], memory["D"][rows] = p.t[rows], cell, D
        close_ended(memory, p, rows)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the fields of this time."""
        mesh = _mesh(cloud)
        time = memory["time"]
        passed = max(cloud.time - cloud.cloud.start, 1e-300)
        fields = {
            "concentration": time / (np.maximum(mesh.volumes, 1e-300) * passed),
            "residenceTime": time,
            "meanD": np.divide(memory["timeD"], time, out=np.zeros_like(time), where=time > 0.0),
            "deposition": np.zeros(mesh.n_cells),
        }
        stuck = _stuck_on_faces(cloud, mesh)
        areas = np.linalg.norm(mesh.boundary_areas, axis=1)
        for name, values in fields.items():
            on_faces = stuck / areas if name == "deposition" else values[mesh.owner[mesh.n_internal :]]
            patches = {
                patch.name: PatchValues("calculated", on_faces[mesh.patch_start[k] : mesh.patch_start[k + 1]])
                if patch.type in _GENERIC
                else PatchValues(patch.type)
                for k, patch in enumerate(mesh.patches)
            }
            write_scalar_field(folder / f"{cloud.time:.12g}" / name, _DIMENSIONS[name], values, patches)


def _mesh(cloud: ObservedCloud) -> Mesh:
    mesh: Any = getattr(cloud.cloud.flow, "mesh", None)
    if not isinstance(mesh, Mesh):
        raise InputError("the flow has no mesh, on which the fields would be.")
    return mesh


def _cells(mesh: Mesh, hosts: NDArray[Any]) -> Rows:
    """Cells that hold the tetrahedra; −1 outside."""
    return np.where(hosts >= 0, mesh.tets[hosts, 0].astype(np.int64) - mesh.n_points, -1)


def _stuck_on_faces(cloud: ObservedCloud, mesh: Mesh) -> Floats:
    """Number of particles stuck on each boundary face: that of their patch whose centre is nearest."""
    p, counts = cloud.particles, np.zeros(len(mesh.boundary_centres))
    for index in range(len(mesh.patches)):
        first, last = int(mesh.patch_start[index]), int(mesh.patch_start[index + 1])
        x = p.x[(p.status == Status.STUCK) & (p.patch == index)]
        if len(x) and last > first:
            nearest = cKDTree(mesh.boundary_centres[first:last]).query(x)[1]
            counts[first:last] += np.bincount(nearest, minlength=last - first)
    return counts
