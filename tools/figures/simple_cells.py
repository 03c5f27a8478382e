"""Errors of u and ∇u in pipes of tetrahedra and prisms, with the correction that keeps volume and without.

Usage: python tools/figures/simple_cells.py; prints the table of docs/flow.md; gmsh makes the meshes. A pipe
of radius 1 m and length 5 m has Poiseuille's velocity at the cells and at its ends, and rests on its wall.
Points are random, off the ends. Errors of u are rms and largest, in % of the mean velocity; ``across`` is the
rms of the components across the axis, which are zero; ∇u is the mean of its size over the exact one for
r > 0.9, less 1, and its standard deviation.
"""

from __future__ import annotations

import argparse

import numpy as np
import pyvista
from numpy.typing import NDArray

from foamprb.flow.fluxes import Conservation
from foamprb.flow.jumps import medians
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction

LENGTH = 5.0
SIZES = {"tetrahedra": (0.5, 0.33, 0.22), "prisms": (0.33, 0.22)}
RINGS = ((0.0, 0.5), (0.5, 0.8), (0.8, 0.9), (0.9, 1.0))
TYPES = {4: pyvista.CellType.TETRA, 6: pyvista.CellType.WEDGE}
Floats = NDArray[np.float64]


def velocity(x: Floats) -> Floats:
    """Return Poiseuille's u of mean 1 m/s."""
    u = np.zeros_like(x)
    u[:, 0] = 2.0 * np.maximum(1.0 - x[:, 1] ** 2 - x[:, 2] ** 2, 0.0)
    return u


def meshed(kind: str, size: float) -> Mesh:
    """Return a pipe of cells of a size, m."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    for bound in ("Min", "Max"):
        gmsh.option.setNumber(f"Mesh.CharacteristicLength{bound}", size)
    occ = gmsh.model.occ
    if kind == "tetrahedra":
        occ.addCylinder(0.0, 0.0, 0.0, LENGTH, 0.0, 0.0, 1.0)
    else:
        disk = [(2, occ.addDisk(0.0, 0.0, 0.0, 1.0, 1.0, zAxis=[1.0, 0.0, 0.0]))]
        occ.extrude(disk, LENGTH, 0.0, 0.0, numElements=[round(LENGTH / size)], recombine=True)
    occ.synchronize()
    gmsh.model.mesh.generate(3)
    tags, points, _ = gmsh.model.mesh.getNodes()
    row = np.zeros(int(tags.max()) + 1, dtype=np.intp)
    row[tags] = np.arange(len(tags))
    _, _, nodes = gmsh.model.mesh.getElements(3)
    corners = 4 if kind == "tetrahedra" else 6
    cells = row[nodes[0].reshape(-1, corners)]
    gmsh.finalize()
    grid = pyvista.UnstructuredGrid({TYPES[corners]: cells}, points.reshape(-1, 3))
    surface = grid.extract_surface(algorithm="dataset_surface", pass_pointid=False, pass_cellid=False)
    x = surface.cell_centers().points[:, 0]
    ends = {"inlet": x < 1e-6, "outlet": x > LENGTH - 1e-6}
    chosen = {**ends, "wall": ~(ends["inlet"] | ends["outlet"])}
    return build_mesh(grid, [
        PatchSurface(name, "wall" if name == "wall" else "patch", surface.extract_cells(np.flatnonzero(rows))
                     .extract_surface(algorithm="dataset_surface", pass_pointid=False, pass_cellid=False))
        for name, rows in chosen.items()
    ])  # fmt: skip


def row(name: str, flow: MeshFlow) -> str:
    """Return a row of the table."""
    random, n = np.random.default_rng(0), 100_000
    r, angle = np.sqrt(random.random(n)), 2.0 * np.pi * random.random(n)
    x = np.column_stack([LENGTH * random.uniform(0.2, 0.8, n), r * np.cos(angle), r * np.sin(angle)])
    hosts = flow.locate(x)
    x, r, hosts = x[hosts >= 0], r[hosts >= 0], hosts[hosts >= 0]
    u, l = flow.sample(x, hosts, 0.0)
    error = 100.0 * np.linalg.norm(u - velocity(x), axis=1)
    rings = [error[(r >= low) & (r < high)] for low, high in RINGS]
    across = 100.0 * np.sqrt(np.mean(np.sum(u[:, 1:] ** 2, axis=1)))
    rate = np.linalg.norm(l, axis=(1, 2))[r > 0.9] / (4.0 * r[r > 0.9]) - 1.0
    jumps = " / ".join(f"{100.0 * jump:.2g}" for jump in medians(flow.gradient_jumps()))
    cells = [f"{np.sqrt(np.mean(ring**2)):.2f} / {ring.max():.1f}" for ring in [*rings, error]]
    cells += [f"{across:.2f}", f"{100 * rate.mean():+.1f} ± {100 * rate.std():.1f}", jumps]
    return f"| {name} | {' | '.join(cells)} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    heads = [f"{low:g} ≤ r < {high:g}" for low, high in RINGS]
    print(f"| cells | u | {' | '.join(heads)} | all | across | ∇u, % | between cells, % |")
    print("|" + "---|" * (len(heads) + 6))
    for kind, sizes in SIZES.items():
        for size in sizes:
            mesh = meshed(kind, size)
            boundary = velocity(mesh.boundary_centres)
            boundary[mesh.patch_start[2] :] = 0.0
            u, l = Reconstruction(mesh)(velocity(mesh.centres), boundary)
            fluxes = Conservation(mesh)(u, l)
            for name, phi in (("interpolated", None), ("keeps volume", fluxes)):
                print(row(f"{mesh.n_cells} {kind} | {name}", MeshFlow(mesh, u, l, fluxes=phi)), flush=True)


if __name__ == "__main__":
    main()
