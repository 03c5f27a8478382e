"""Time and memory to prepare a mesh for tracking: tetrahedra, nodal u and ∇u, balance of fluxes, cell tree.

A block of N³ hexahedra with displaced points; the time to build the mesh in VTK itself is not counted.

    python tools/benchmarks/mesh_cost.py 100
"""

from __future__ import annotations

import argparse
import resource
import time

import numpy as np
import pyvista

from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction


def block(n: int) -> pyvista.UnstructuredGrid:
    """Return a cube of n³ hexahedra with inner points displaced by up to a tenth of a cell."""
    grid = pyvista.ImageData(dimensions=(n + 1,) * 3, spacing=(1.0 / n,) * 3).cast_to_structured_grid()
    points = grid.points.astype(float)
    inside = ((points > 1e-9) & (points < 1 - 1e-9)).all(axis=1)
    points[inside] += np.random.default_rng(0).uniform(-0.1 / n, 0.1 / n, (inside.sum(), 3))
    grid.points = points
    return grid.cast_to_unstructured_grid()


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("n", type=int, nargs="?", default=100, help="cells along an edge [100]")
    n = parser.parse_args().n
    small = build_mesh(block(4))
    nodal = Reconstruction(small)(small.centres, small.boundary_centres)
    MeshFlow(small, *nodal, correction=Conservation(small)(*nodal))  # compiles
    grid = block(n)
    clock = [time.process_time()]
    mesh = build_mesh(grid)
    clock.append(time.process_time())
    nodal = Reconstruction(mesh)(mesh.centres, mesh.boundary_centres)
    clock.append(time.process_time())
    correction = Conservation(mesh)(*nodal)
    clock.append(time.process_time())
    flow = MeshFlow(mesh, *nodal, correction=correction)
    clock.append(time.process_time())
    kept = {id(a): a.nbytes for a in (*vars(mesh).values(), *flow.arrays()) if isinstance(a, np.ndarray)}
    for name, seconds in zip(("mesh", "reconstruction", "fluxes", "tree"), np.diff(clock), strict=True):
        print(f"{name:16s} {seconds:8.1f} s CPU")
    print(f"{'total':16s} {clock[-1] - clock[0]:8.1f} s CPU for {mesh.n_cells} cells")
    print(f"{'kept':16s} {sum(kept.values()) / mesh.n_cells:8.0f} bytes per cell")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2
    print(f"{'peak':16s} {peak:8.2f} GiB of the process")


if __name__ == "__main__":
    main()
