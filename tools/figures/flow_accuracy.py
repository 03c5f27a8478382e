"""Errors of u and ∇u between the cell centres of pipe meshes, against the Poiseuille solution.

Usage: python tools/figures/flow_accuracy.py CASE [CASE …], coarsest first; pipes along x with the paper's
dimensions. Each mesh is sampled at random points, in the core (r < 0.9 R) and near the wall, by
three methods: foamprb's; OpenFOAM's cellPoint (nodal means on the same tetrahedra, gradient constant in
each); and VTK's point data (probed; gradient by vtkGradientFilter). Once with the solver's U, once with exact
values at the cell centres and at rest on the wall.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyvista

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks.pipe import MEAN, RADIUS, Floats, Ints, poiseuille

from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.case import select_time
from foamprb.flow.read.field import VELOCITY_FIELD
from foamprb.flow.read.openfoam import Case, velocities
from foamprb.flow.reconstruct import Reconstruction

Sampler = Callable[[Floats], tuple[Floats, Floats]]
COLUMNS = ("u core", "u wall", "∇u core", "∇u wall")


def velocity(x: Floats) -> Floats:
    """Return Poiseuille's u at the points (n, 3), zero outside."""
    return np.maximum(poiseuille(x), 0.0)


def gradient(x: Floats) -> Floats:
    """Return Poiseuille's ∂u_i/∂x_j at the points, (n, 3, 3)."""
    l = np.zeros((len(x), 3, 3))
    l[:, 0, 1:] = -4.0 * MEAN / RADIUS**2 * x[:, 1:]
    return l


def ours(mesh: Mesh, cells: Floats, boundary: Floats) -> Sampler:
    """Return u and ∇u of foamprb, with the fluxes that follow from them."""
    u, l = Reconstruction(mesh)(cells, boundary)
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l))
    return lambda x: flow.sample(x, flow.locate(x), 0.0)


def cell_point(mesh: Mesh, cells: Floats, boundary: Floats) -> Sampler:
    """Interpolate as OpenFOAM's cellPoint: inverse-distance means, boundary points by boundary faces only."""
    columns = np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_point_start))
    u = weighted_mean(mesh, mesh.cell_points, mesh.centres[columns], cells[columns])
    first = mesh.face_start[mesh.n_internal]
    faces = np.repeat(np.arange(len(boundary)), np.diff(mesh.face_start)[mesh.n_internal :])
    rim = mesh.face_points[first:]
    u_rim = weighted_mean(mesh, rim, mesh.boundary_centres[faces], boundary[faces])
    u[rim] = u_rim[rim]
    nodes, values = mesh.nodes, np.concatenate([u, cells])
    flow = MeshFlow(mesh, values, np.zeros((len(values), 3, 3)))

    def sample(x: Floats) -> tuple[Floats, Floats]:
        hosts = flow.locate(x)
        tets = mesh.tets[hosts]
        edges = nodes[tets[:, 1:]] - nodes[tets[:, :1]]
        differences = values[tets[:, 1:]] - values[tets[:, :1]]
        return flow.sample(x, hosts, 0.0)[0], np.linalg.solve(edges, differences).transpose(0, 2, 1)

    return sample


def weighted_mean(mesh: Mesh, points: Ints, sites: Floats, values: Floats) -> Floats:
    """Return means at mesh points of values at sites, weighted by inverse distance."""
    weight = 1.0 / np.linalg.norm(mesh.points[points] - sites, axis=1)
    total = np.bincount(points, weight, mesh.n_points)
    sums = [np.bincount(points, weight * column, mesh.n_points) for column in values.T]
    return np.stack(sums, axis=1) / np.where(total > 0.0, total, 1.0)[:, None]


def vtk_points(grid: pyvista.UnstructuredGrid) -> Sampler:
    """Probe the grid's point data ``U``, and its gradient, with VTK."""
    derived = grid.compute_derivative(scalars="U", gradient="l")

    def sample(x: Floats) -> tuple[Floats, Floats]:
        probed = pyvista.PolyData(x).sample(derived)
        return np.asarray(probed["U"], dtype=float), np.asarray(probed["l"], dtype=float).reshape(-1, 3, 3)

    return sample


def read_vtk(case: Path) -> pyvista.UnstructuredGrid:
    """Return the case's mesh with the point data of VTK's reader."""
    reader = pyvista.POpenFOAMReader(str(case / "system" / "controlDict"))
    reader.cell_to_point_creation = True
    reader.set_active_time_value(float(select_time(case)))
    return reader.read()["internalMesh"]


def with_point_data(grid: pyvista.UnstructuredGrid, cells: Floats) -> pyvista.UnstructuredGrid:
    """Return the grid with VTK's means of cell values, zero on the wall as in its reader."""
    copy = pyvista.UnstructuredGrid()
    copy.copy_structure(grid)
    copy.cell_data["U"] = cells
    copy = copy.cell_data_to_point_data()
    on_wall = np.hypot(copy.points[:, 1], copy.points[:, 2]) > (1.0 - 1e-5) * RADIUS
    copy.point_data["U"][on_wall] = 0.0
    return copy


def random_points(mesh: Mesh) -> Floats:
    """Return uniformly distributed points in the middle three fifths of the pipe, inside its mesh."""
    rng, number = np.random.default_rng(0), 100_000
    low, high = mesh.points[:, 0].min(), mesh.points[:, 0].max()
    r, angle = RADIUS * np.sqrt(rng.random(number)), 2.0 * np.pi * rng.random(number)
    x = low + (high - low) * (0.2 + 0.6 * rng.random(number))
    points = np.stack([x, r * np.cos(angle), r * np.sin(angle)], axis=1)
    nothing = np.zeros((mesh.n_points + mesh.n_cells, 3))
    flow = MeshFlow(mesh, nothing, np.zeros((len(nothing), 3, 3)))
    return points[flow.locate(points) >= 0]


def errors(sample: Sampler, x: Floats) -> list[tuple[float, float]]:
    """Return rms and maximum of the errors, for each of the columns, in %."""
    u, l = sample(x)
    core = np.hypot(x[:, 1], x[:, 2]) < 0.9 * RADIUS
    of_u = np.linalg.norm(u - velocity(x), axis=1) / MEAN
    of_l = np.linalg.norm((l - gradient(x)).reshape(-1, 9), axis=1) / (4.0 * MEAN / RADIUS)
    parts = [100.0 * error[region] for error in (of_u, of_l) for region in (core, ~core)]
    return [(float(np.sqrt(np.mean(part**2))), float(part.max())) for part in parts]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE")
    options = parser.parse_args()

    results: dict[tuple[str, str], list[list[tuple[float, float]]]] = {}
    sizes = []
    for case in options.cases:
        opened = Case(case)
        name = opened.select_time("latestTime")
        read = opened.mesh(name)
        mesh, (cells, boundary) = read.mesh, velocities(opened.field(name, "U", VELOCITY_FIELD), read)
        x = random_points(mesh)
        sizes.append(mesh.n_cells)
        exact, exact_boundary = velocity(mesh.centres), velocity(mesh.boundary_centres)
        for patch, first, last in zip(mesh.patches, mesh.patch_start, mesh.patch_start[1:], strict=False):
            if patch.type == "wall":
                exact_boundary[first:last] = 0.0
        grid = read_vtk(case)
        for source, values in (("solver", (cells, boundary)), ("exact", (exact, exact_boundary))):
            points = grid if source == "solver" else with_point_data(grid, exact)
            for method, sampler in (
                ("foamprb", ours(mesh, *values)),
                ("cellPoint", cell_point(mesh, *values)),
                ("VTK", vtk_points(points)),
            ):
                results.setdefault((source, method), []).append(errors(sampler, x))

    print("Errors rms/max; u in % of the mean velocity, ∇u in % of the wall shear rate; order of the rms")
    print(f"{'cells':>8} {'values':7} {'method':10}" + "".join(f"{name:>16}" for name in COLUMNS))
    for (source, method), rows in results.items():
        for size, row in zip(sizes, rows, strict=True):
            print(f"{size:8} {source:7} {method:10}" + "".join(f"{rms:9.3f}/{top:6.2f}" for rms, top in row))
        if len(rows) > 1:
            step = np.log(sizes[-1] / sizes[-2]) / 3.0
            orders = [np.log(a[0] / b[0]) / step for a, b in zip(rows[-2], rows[-1], strict=True)]
            print(f"{'order':>8} {'':18}" + "".join(f"{order:16.2f}" for order in orders))


if __name__ == "__main__":
    main()
