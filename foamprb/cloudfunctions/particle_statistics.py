"""Fields on the mesh: residence time, deformation, deposition and stress of particles."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import FlowSamples, shapes
from foamprb.cloud.paths import Steps, step
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.viscosity import viscosity_of
from foamprb.cloudfunctions.base import (
    Memory,
    ObservedCloud,
    PathFunction,
    per_cell,
    per_particle,
    table,
    taylor_at_end,
)
from foamprb.cloudfunctions.cells import no_sums, parts_in_cells, values_of
from foamprb.compile.link import compiled
from foamprb.dictionary.constraints import Meaning
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import Mesh
from foamprb.results.foam import GENERIC, PatchValues, write_field

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
class ParticleStatistics(PathFunction):
    """Fields on the mesh, in OpenFOAM's format, in a folder for each write time.

    ``concentration``, mean number of particles per volume since the start, 1/m³; ``residenceTime``, the time
    that all of them have spent in a cell, s; ``meanD``, the mean of Taylor's D over that time; and on the
    boundary ``deposition``, particles stuck per area of a face, 1/m². The time of a step counts for the cells
    that it goes through, from face to face. With ``sigmaParticles`` also
    ``volumeFraction`` and ``sigmaParticles``, means since the start of the particles' volume and of the sum
    of their stresslets, per volume of the cell.
    """

    sigmaParticles: Annotated[bool, Meaning("whether to write the particles' stress and volume, too")] = False
    # A run may continue with the other format.
    writeFormat: Annotated[Literal["binary", "ascii"], Meaning("OpenFOAM's format of the fields")] = field(
        default="binary", compare=False
    )

    arrays: ClassVar = {**PathFunction.arrays, "D": per_particle, "sums": per_cell, "scale": table}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return sums of zero, and their largest terms; raise InputError if the flow has no mesh."""
        dt, scale = cloud.cloud.tracker.dt, np.ones(9 if self.sigmaParticles else 2)
        if self.sigmaParticles:
            R, stress = np.max([(1e-30, 1e-30), *cloud.cloud.map_ranks(_largest)], axis=0)
            scale[2], scale[3:] = 4.0 * R**3, 4.0 * R**3 * stress
        sums = no_sums(_mesh(cloud).n_cells, len(scale))
        return {"D": shapes(cloud.particles)[1], "sums": sums, "scale": dt * scale}

    @property
    def needs(self) -> frozenset[str]:
        """See :class:`PathFunction`."""
        return frozenset({"F1", "Q1", *(("F0", "Q0", "A0", "l0", "l1") if self.sigmaParticles else ())})

    def add(self, memory: Memory, cloud: ObservedCloud, steps: Steps, fresh: NDArray[np.bool_]) -> None:
        """Add the time in each cell, and its products."""
        assert cloud.add_to_cells is not None
        ends = np.empty((2, len(memory["scale"]) - 1, steps.n))
        compiled(_deform)(steps.tables, fresh, memory["D"], ends[0, 0], ends[1, 0])
        if self.sigmaParticles:
            ends[:, 1:, fresh] = _stress_at_ends(cloud, steps.take(fresh))
        arrays: Any = cloud.cloud.flow.arrays
        mesh = getattr(arrays, "mesh", arrays)
        for cells, integrals in parts_in_cells(mesh, _in_frames(arrays, steps), fresh, ends[0], ends[1]):
            cloud.add_to_cells(cells, integrals, memory["scale"])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the fields of this time."""
        mesh, time = _mesh(cloud), max(cloud.time - cloud.cloud.start, 1e-300)
        in_cells = _fields(values_of(memory["sums"], memory["scale"]), mesh.volumes, time)
        on_faces = {name: values[mesh.owner[mesh.n_internal :]] for name, values in in_cells.items()}
        on_faces["deposition"] = _stuck_on_faces(cloud, mesh) / np.linalg.norm(mesh.boundary_areas, axis=1)
        folder.mkdir(exist_ok=True)
        for name, values in on_faces.items():
            patches = {
                patch.name: PatchValues("calculated", values[slice(*mesh.patch_start[k : k + 2])])
                if patch.type in GENERIC
                else PatchValues(patch.type)
                for k, patch in enumerate(cloud.cloud.flow.patches)
            }
            path = folder / f"{cloud.time:.12g}" / name
            binary = self.writeFormat == "binary"
            write_field(path, _DIMENSIONS[name], in_cells[name], patches, binary=binary)


def _in_frames(arrays: Any, steps: Steps) -> Steps:
    """Return steps with their places in the frames of a mesh that moves."""
    if not hasattr(arrays, "pulled"):
        return steps
    tables = steps.tables.copy()
    first, last = (tables[:, row].astype(np.int64).ravel() for row in (step.host0, step.host1))
    # A step that a coupled patch divides has a host at one of its ends only.
    hosts = np.where(first < 0, last, first), np.where(last < 0, first, last)
    for x, t, host in zip((step.x0, step.x1), (step.t0, step.t1), hosts, strict=True):
        places = np.moveaxis(tables[:, x : x + 3], 1, 2)
        pulled = arrays.pulled(places.reshape(-1, 3), host, tables[:, t].ravel())
        tables[:, x : x + 3] = np.moveaxis(pulled.reshape(places.shape), 2, 1)
    return steps._replace(tables=tables)


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


def _mesh(cloud: ObservedCloud) -> Mesh:
    """Return the mesh of the flow; raise InputError if it has none."""
    mesh: Mesh | None = getattr(cloud.cloud.flow, "mesh", None)
    if mesh is None:
        raise InputError("the flow has no mesh for the fields.")
    return mesh


def _largest(p: Particles) -> tuple[float, float]:
    """Return the largest radius, m, and the largest shear modulus, Pa; 0 without particles."""
    return float(p.R.max(initial=0.0)), float(p.mu.max(initial=0.0))


def _deform(tables: Floats, fresh: NDArray[np.bool_], D: Floats, first: Floats, last: Floats) -> None:
    """Put Taylor's D at both ends of fresh steps into arrays, (n,), and update that of their particles."""
    k = 0
    for steps in tables:
        for i in range(steps.shape[1]):
            if fresh[k]:
                row = int(steps[step.row, i])
                first[k] = D[row]
                D[row] = last[k] = taylor_at_end(steps, i)
            k += 1


def _stress_at_ends(cloud: ObservedCloud, steps: Steps) -> Floats:
    """Return volume (m³) and stresslet (N m, xx yy zz xy yz xz) at both ends of steps, (2, 7, n).

    dF/dt at the end is that of the parabola through both shapes and dF/dt at the start.
    """
    F0, F1 = steps.both("F")
    h, A0 = np.subtract(*steps.t[::-1])[:, None], steps.rate
    # A step that a coupled patch divides has a host at one of its ends only.
    first, last = steps.hosts
    hosts = np.where(first < 0, last, first), np.where(last < 0, first, last)
    A1 = 2.0 * (F1 - F0) / h - A0
    values = []
    for end, (F, A) in enumerate(((F0, A0), (F1, A1))):
        p = cloud.particles.take(steps.row)
        p = p._replace(F=np.ascontiguousarray(F), A=np.ascontiguousarray(A), Q=steps.both("Q")[end].copy())
        l = steps.both("l")[end]
        mu = viscosity_of(cloud.cloud.medium.mu, cloud.cloud.flow, p.x, hosts[end], l, steps.t[end])
        fluid = FlowSamples(np.full((steps.n, 3), np.nan), l.copy(), np.broadcast_to(mu, steps.n))
        J, S = cloud.of(p).measure_in(fluid, "J", "stresslet")
        values.append(np.concatenate([(4.0 / 3.0 * math.pi * p.R**3 * J)[None], S.T]))
    return np.stack(values)


def _stuck_on_faces(cloud: ObservedCloud, mesh: Mesh) -> Floats:
    """Count particles on each boundary face: the face of their patch with the nearest centre."""
    from scipy.spatial import cKDTree

    counts = np.zeros(len(mesh.boundary_areas))
    trees: dict[int, cKDTree] = {}
    arrays: Any = cloud.cloud.flow.arrays(0.0, ())
    for x, patch, host, t in cloud.map(_stuck):
        x = arrays.pulled(x, host, t, False) if hasattr(arrays, "pulled") else x
        for index in np.unique(patch):
            first, last = mesh.patch_start[index : index + 2].tolist()
            if last > first:
                tree = trees.setdefault(index, cKDTree(mesh.boundary_centres[first:last]))
                nearest = tree.query(x[patch == index])[1]
                counts[first:last] += np.bincount(nearest, minlength=last - first)
    return counts


def _stuck(p: Particles, _memory: Memory) -> tuple[Floats, NDArray[np.int32], NDArray[np.int32], Floats]:
    """Return places, patches, hosts and times of stuck particles."""
    stuck = (p.status == Status.STUCK) & (p.patch >= 0)
    return p.x[stuck], p.patch[stuck], p.host[stuck], p.t[stuck]
