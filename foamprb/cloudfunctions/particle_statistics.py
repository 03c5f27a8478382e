"""Fields on the mesh: residence time, deformation, deposition and stress of particles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import as_slice, shapes
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    Memory,
    ObservedCloud,
    Rows,
    SampledFunction,
    SampleInterval,
    StepObserver,
    appearing,
    append,
    per_cell,
    per_event,
    per_particle,
    sums_of_cells,
)
from foamprb.dictionary.constraints import Meaning
from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshSizes
from foamprb.results.foam import GENERIC, PatchValues, write_field

__all__ = ["ParticleStatistics"]

Floats = NDArray[np.float64]

_DIMENSIONS: dict[str, tuple[int, ...]] = {
    "concentration": (0, -3, 0, 0, 0, 0, 0),
    "residenceTime": (0, 0, 1, 0, 0, 0, 0),
    "meanD": (0, 0, 0, 0, 0, 0, 0),
    "deposition": (0, -2, 0, 0, 0, 0, 0),
    "volumeFraction": (0, 0, 0, 0, 0, 0, 0),
    "sigmaParticles": (1, -1, -2, 0, 0, 0, 0),
}


@dataclass(frozen=True)
class ParticleStatistics(SampledFunction, StepObserver):
    """Fields on the mesh, in OpenFOAM's format, in a folder for each write time.

    ``concentration``, mean number of particles per volume since the start, 1/m³; ``residenceTime``, the time
    that all of them have spent in a cell, s; ``meanD``, the mean of Taylor's D over that time; and on the
    boundary ``deposition``, particles stuck per area of a face, 1/m². Half of the time between two samples
    counts for the cell at its beginning, and half for the cell at its end. With ``sigmaParticles`` also
    ``volumeFraction`` and ``sigmaParticles``, means since the start of the particles' volume and of the sum
    of their stresslets, per volume of the cell.
    """

    sampleInterval: SampleInterval = 1
    sigmaParticles: Annotated[bool, Meaning("whether to write the particles' stress and volume, too")] = False

    arrays: ClassVar = {
        **SampledFunction.arrays,
        **dict.fromkeys(("cell", "D", "S"), per_particle),
        "passed": per_event,
        "sums": per_cell,
    }

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return cells, −1 outside and before the release, and Taylor's D."""
        p, cell = cloud.particles, np.full(len(rows), -1, dtype=np.int64)
        inside = np.flatnonzero((p.host[rows] >= 0) & (p.status[rows] != Status.PENDING))
        if len(inside):
            cell[inside] = _cell_of(cloud, p.host[rows[inside]])
        if not self.sigmaParticles:
            return {"cell": cell, "D": shapes(p.take(as_slice(rows)))[1]}
        D, J, S = cloud.measure(rows, "taylorDeformation", "J", "stresslet")
        # The volume comes first among the seven.
        return {"cell": cell, "D": D, "S": np.column_stack([4.0 / 3.0 * math.pi * p.R[rows] ** 3 * J, S])}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return sums of zero; raise InputError if the flow has no mesh."""
        n, columns = _flow(cloud).mesh.n_cells, 9 if self.sigmaParticles else 2
        return {"sums": np.zeros((n, columns)), "passed": np.empty((0, 3 + columns))}

    def before_steps(self, memory: Memory, cloud: ObservedCloud, until: float) -> None:
        """Store the cells of the particles that appear, where their tetrahedra are known."""
        rows = appearing(cloud, until)
        memory["cell"][rows] = _cell_of(cloud, cloud.particles.host[rows])

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Store half the time since the last sample, and its products, for the cells at both ends."""
        half = 0.5 * (now["t"] - memory["t"][rows])
        # A particle that the mesh has lost counts in its last cell.
        now["cell"] = np.where(now["cell"] >= 0, now["cell"], memory["cell"][rows])
        for end, values in enumerate(({name: memory[name][rows] for name in now}, now)):
            inside = np.flatnonzero(values["cell"] >= 0)
            number, weight = cloud.particles.number[rows[inside]], half[inside]
            quantities = [np.ones(len(inside)), *(values[name][inside] for name in ("D", "S") if name in now)]
            added = weight[:, None] * np.column_stack(quantities)
            ends = np.full(len(inside), end)
            append(memory, "passed", np.column_stack([number, ends, values["cell"][inside], added]))

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the fields of this time."""
        sizes = _flow(cloud).mesh_sizes()
        n, time = len(sizes.volumes), max(cloud.time - cloud.cloud.start, 1e-300)
        beside = np.empty((len(sizes.owner), memory["sums"].shape[1]))
        for part, sums in sums_of_cells(cloud, "sums", n):
            faces = np.flatnonzero((sizes.owner >= part.start) & (sizes.owner < part.stop))
            beside[faces] = sums[sizes.owner[faces] - part.start]
        on_faces = _fields(beside, sizes.volumes[sizes.owner], time)
        on_faces["deposition"] = _stuck_on_faces(cloud, sizes) / sizes.areas
        folder.mkdir(exist_ok=True)
        for name, values in on_faces.items():
            patches = {
                patch.name: PatchValues("calculated", values[slice(*sizes.patch_start[k : k + 2])])
                if patch.type in GENERIC
                else PatchValues(patch.type)
                for k, patch in enumerate(cloud.cloud.flow.patches)
            }
            cells = (
                _fields(sums, sizes.volumes[part], time)[name]
                for part, sums in sums_of_cells(cloud, "sums", n)
            )
            write_field(folder / f"{cloud.time:.12g}" / name, _DIMENSIONS[name], cells, n, patches)


def _fields(sums: Floats, volumes: Floats, time: float) -> dict[str, Floats]:
    """Return the fields at cells by the sums of all samples, volumes (m³) and the time since the start, s."""
    spent, timeD, *more = sums.T
    passed = np.maximum(volumes, 1e-300) * time
    fields = {
        "concentration": spent / passed,
        "residenceTime": spent,
        "meanD": np.divide(timeD, spent, out=np.zeros_like(spent), where=spent > 0.0),
        "deposition": np.zeros_like(spent),
    }
    if more:
        # The volume comes first.
        volume, *stress = more / passed
        fields |= {"volumeFraction": volume, "sigmaParticles": np.stack(stress, axis=1)}
    return fields


def _flow(cloud: ObservedCloud) -> Any:
    """Return the flow, which has cells."""
    if not hasattr(cloud.cloud.flow, "mesh_sizes"):
        raise InputError("the flow has no mesh for the fields.")
    return cloud.cloud.flow


def _cell_of(cloud: ObservedCloud, hosts: NDArray[np.int32]) -> NDArray[np.int64]:
    flow: Any = cloud.cloud.flow
    cells: NDArray[np.int64] = flow.cell_of(hosts)
    return cells


def _stuck_on_faces(cloud: ObservedCloud, sizes: MeshSizes) -> Floats:
    """Count particles on each boundary face: the face of their patch with the nearest centre."""
    from scipy.spatial import cKDTree

    counts = np.zeros(len(sizes.areas))
    trees: dict[int, cKDTree] = {}
    for x, patch in cloud.map(_stuck):
        for index in np.unique(patch):
            first, last = sizes.patch_start[index : index + 2].tolist()
            if last > first:
                tree = trees.setdefault(index, cKDTree(sizes.centres[first:last]))
                nearest = tree.query(x[patch == index])[1]
                counts[first:last] += np.bincount(nearest, minlength=last - first)
    return counts


def _stuck(p: Particles, _memory: Memory) -> tuple[Floats, NDArray[np.int32]]:
    """Return places and patches of stuck particles."""
    stuck = (p.status == Status.STUCK) & (p.patch >= 0)
    return p.x[stuck], p.patch[stuck]
