"""Fields on the mesh: residence time, deformation, deposition and stress of particles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    AT_ONCE,
    Memory,
    ObservedCloud,
    Rows,
    SampledFunction,
    SampleInterval,
    append,
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
class ParticleStatistics(SampledFunction):
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

    events: ClassVar[str] = "passed"
    common: ClassVar[frozenset[str]] = SampledFunction.common | {"time", "timeD", "timeS"}

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return cells, −1 outside and before the release, and Taylor's D."""
        p, cell = cloud.particles, np.full(len(rows), -1, dtype=np.int64)
        inside = np.flatnonzero((p.host[rows] >= 0) & (p.status[rows] != Status.PENDING))
        if len(inside):
            cell[inside] = _cell_of(cloud, p.host[rows[inside]])
        own = {"cell": cell, "D": cloud.measure(rows, "taylorDeformation")[0]}
        if self.sigmaParticles:
            # The volume comes first among the seven.
            J, S = cloud.measure(rows, "J", "stresslet")
            own["S"] = np.column_stack([4.0 / 3.0 * math.pi * cloud.particles.R[rows] ** 3 * J, S])
        return own

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return sums of zero; raise InputError if the flow has no mesh."""
        n, columns = _flow(cloud).mesh.n_cells, 9 if self.sigmaParticles else 2
        stress = {"timeS": np.zeros((7, n))} if self.sigmaParticles else {}
        passed = np.empty((0, 3 + 2 * columns))
        return {"time": np.zeros(n), "timeD": np.zeros(n), **stress, "passed": passed}

    def before_steps(self, memory: Memory, cloud: ObservedCloud, until: float) -> None:
        """Store the cells of the particles that appear, where their tetrahedra are known."""
        rows = cloud.appearing(until)
        memory["cell"][rows] = _cell_of(cloud, cloud.particles.host[rows])

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Store half the time since the last sample, and cells and values at both its ends.

        The sums are those of :meth:`end_sample`, so that they do not depend on the order of the particles.
        """
        half = 0.5 * (now["t"] - memory["t"][rows])
        # A particle that the mesh has lost counts in its last cell.
        now["cell"] = np.where(now["cell"] >= 0, now["cell"], memory["cell"][rows])
        names = ("cell", "D", *(("S",) if self.sigmaParticles else ()))
        ends = [values[name] for values in ({k: memory[k][rows] for k in names}, now) for name in names]
        append(memory, "passed", np.column_stack([cloud.particles.number[rows], 0.0 * half, half, *ends]))

    def end_sample(self, memory: Memory, cloud: ObservedCloud) -> None:  # noqa: ARG002
        """Add the sample to the sums of the cells."""
        passed = memory["passed"]
        parts = (passed[:, 0] // AT_ONCE).astype(np.int64)
        for part in np.unique(parts):
            self._add_up(memory, passed[parts == part])
        memory["passed"] = passed[:0]

    def _add_up(self, memory: Memory, passed: Floats) -> None:
        n = len(memory["time"])
        for end in np.split(passed[:, 3:], 2, axis=1):
            known = end[:, 0] >= 0
            cell, weight = end[known, 0].astype(np.int64), passed[known, 2]
            memory["time"] += np.bincount(cell, weight, n)
            memory["timeD"] += np.bincount(cell, weight * end[known, 1], n)
            if self.sigmaParticles:
                for total, values in zip(memory["timeS"], end[known, 2:].T, strict=True):
                    total += np.bincount(cell, weight * values, n)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the fields of this time."""
        sizes, time = _flow(cloud).mesh_sizes(), memory["time"]
        passed = np.maximum(sizes.volumes, 1e-300) * max(cloud.time - cloud.cloud.start, 1e-300)
        fields = {
            "concentration": time / passed,
            "residenceTime": time,
            "meanD": np.divide(memory["timeD"], time, out=np.zeros_like(time), where=time > 0.0),
            "deposition": np.zeros_like(time),
        }
        if self.sigmaParticles:
            volume, *stress = memory["timeS"] / passed
            fields |= {"volumeFraction": volume, "sigmaParticles": np.stack(stress, axis=1)}
        stuck = _stuck_on_faces(cloud, sizes)
        folder.mkdir(exist_ok=True)
        for name, values in fields.items():
            on_faces = stuck / sizes.areas if name == "deposition" else values[sizes.owner]
            patches = {
                patch.name: PatchValues("calculated", on_faces[slice(*sizes.patch_start[k : k + 2])])
                if patch.type in GENERIC
                else PatchValues(patch.type)
                for k, patch in enumerate(cloud.cloud.flow.patches)
            }
            write_field(folder / f"{cloud.time:.12g}" / name, _DIMENSIONS[name], values, patches)


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
    counts = np.zeros(len(sizes.areas))
    trees: dict[int, cKDTree] = {}
    for x, patch in cloud.cloud.in_order(_stuck):
        for index in np.unique(patch):
            first, last = sizes.patch_start[index : index + 2].tolist()
            if last > first:
                tree = trees.setdefault(index, cKDTree(sizes.centres[first:last]))
                nearest = tree.query(x[patch == index])[1]
                counts[first:last] += np.bincount(nearest, minlength=last - first)
    return counts


def _stuck(p: Particles) -> tuple[Floats, NDArray[np.int32]]:
    """Return places and patches of stuck particles."""
    stuck = (p.status == Status.STUCK) & (p.patch >= 0)
    return p.x[stuck], p.patch[stuck]
