"""The T-junction run live: who takes which branch, against how the flow divides."""

from __future__ import annotations

import re
import shutil
import subprocess
from itertools import product
from pathlib import Path
from typing import NamedTuple

import meshio
import numpy as np
import pytest
import pyvista
from cgns_writer import write_cgns
from figures import t_junction
from paths import ROOT
from scipy.spatial import cKDTree

from foamprb import Cloud, Medium, Stick, spheres
from foamprb.cli import main
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import Status
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.flows import read_flow
from foamprb.flow.read.openfoam import read_case
from foamprb.flow.read.source import FlowSource

pytestmark = pytest.mark.openfoam

CASE = ROOT / "cases/tJunction"
FLOW, SHARE = 1e-10, 0.5
STIFF, SOFT = 0.001, 0.1
BAND = 2e-6
"""About the dividing streamline, m: a bead so close to it may creep along the wall for seconds."""


@pytest.fixture(scope="module")
def lines(job):
    """Fates of stiff and of soft beads from one line across the channel, as far as a bead has room."""
    y = np.arange(-38e-6, 38.5e-6, 2e-6)
    starts = np.column_stack([y, np.zeros_like(y)])
    return y, t_junction.send(job, starts, STIFF), t_junction.send(job, starts, SOFT)


def test_settings_hold(live):
    assert main(["run", "-case", str(live), "-dry-run"]) == 0


def test_flow_enters_leaves_and_divides_as_prescribed(live):
    rates = t_junction.flow_rates(live)
    assert rates["inlet"] == pytest.approx(-FLOW, rel=1e-9)
    assert rates["side"] == pytest.approx(SHARE * FLOW, rel=1e-9)
    assert sum(rates.values()) == pytest.approx(0.0, abs=1e-6 * FLOW)


def test_the_flow_is_developed_where_beads_start(job):
    """The peak of a square duct is 2.096 times the mean (Shah and London 1978); the coarse mesh cuts 2 %."""
    assert t_junction.speeds(job, np.zeros((1, 2)))[0] == pytest.approx(2.096e-2, rel=0.03)


@pytest.mark.parametrize("Ca", [STIFF, SOFT])
def test_beads_as_frequent_as_the_flux_divide_as_the_flow(job, Ca):
    n = 1000
    patch = t_junction.send(job, t_junction.random_by_flux(job, n), Ca).patch
    straight, side, wall, under_way, failed = (
        np.count_nonzero(patch == name) for name in ("straight", "side", "wall", "", "failed")
    )
    assert failed == 0
    assert straight + side + wall + under_way == n
    error = np.sqrt(n * SHARE * (1.0 - SHARE))
    assert abs(side - SHARE * n) < 2.0 * error
    assert abs(straight - (1.0 - SHARE) * n) < 2.0 * error
    assert wall + under_way < 0.02 * n


def test_stiff_and_soft_take_the_same_branch_away_from_the_dividing_streamline(lines):
    y, stiff, soft = lines
    edge = (y[stiff.patch == "straight"].max() + y[stiff.patch == "side"].min()) / 2.0
    far = np.abs(y - edge) > BAND
    expected = np.where(y < edge, "straight", "side")
    assert set(expected[far]) == {"straight", "side"}
    for fates in (stiff, soft):
        np.testing.assert_array_equal(fates.patch[far], expected[far])


def test_deformation_in_the_junction_is_what_tells_them_apart(lines):
    """Small strains are proportional to Ca; the soft bead's are not small, and it has a history."""
    _, stiff, soft = lines
    assert (stiff.D > 0.0).all()
    assert (stiff.D < 0.02).all()
    assert (soft.D > 20.0 * stiff.D).all()
    assert (soft.D < 1.0).all()


PLACES = 2000
SMALL, GEL, HALF = 1e-8, 20e-6, 50e-6
"""Diameters of tracers and gels, and half the width of the channel, m."""
NAMES = {12: "hexahedron", 10: "tetra", 13: "wedge"}
"""Of meshio, by VTK's types of cells."""


class Fast(NamedTuple):
    """The coarse case with an eight hundredth of the viscosity, at the Reynolds number 8."""

    folder: Path
    grid: pyvista.UnstructuredGrid
    flow: MeshFlow
    x: np.ndarray
    """Places of tracers, then of gels, over the inlet as the flux, (2 PLACES, 3), m."""
    stuck: tuple[int, float]
    """Number of the tracers that stick, and share of the gels."""


@pytest.fixture(scope="module")
def fast(tmp_path_factory):
    case = shutil.copytree(CASE, tmp_path_factory.mktemp("fast") / "case")
    liquid = case / "constant/transportProperties"
    liquid.write_text(re.sub(r"\nnu .*;", "\nnu 1.25e-7;", liquid.read_text()))
    folder = case.parent / "run"
    subprocess.run([case / "Allrun", "coarse", folder], check=True)
    (folder / "case.foam").touch()
    reader = pyvista.OpenFOAMReader(folder / "case.foam")
    reader.set_active_time_value(reader.time_values[-1])
    reader.cell_to_point_creation = False
    flow, random = read_case(folder), np.random.default_rng(1)
    faces = flow.patch_faces("inlet", 0.0)
    flux = np.maximum(np.einsum("tvi,ti->tv", faces.velocity, faces.normals), 0.0).mean(axis=1) * faces.areas
    x = []
    for d in (SMALL, GEL):
        rows = random.choice(len(flux), 4 * PLACES, p=flux / flux.sum())
        drawn = np.einsum("nk,nki->ni", random.dirichlet(np.ones(3), len(rows)), faces.vertices[rows])
        drawn += 1e-9 * faces.normals[rows]
        x.append(drawn[(np.abs(drawn[:, 1:]) < HALF - 0.5 * d).all(axis=1)][:PLACES])
    x = np.concatenate(x)
    return Fast(folder, reader.read()["internalMesh"], flow, x, stuck_of(flow, x))


def stuck_of(flow, x):
    """Return how many tracers, and which share of the gels, stick on their way."""
    acts = [Stick() if patch.type == "wall" else Escape() for patch in flow.patches]
    bodies = spheres(x, d=np.repeat([SMALL, GEL], PLACES), rho=1000.0, mu=1e3)
    cloud = Cloud(bodies, flow, Medium(1.25e-4, 1000.0, (0.0, 0.0, 0.0)), acts, 1e-3)
    cloud.advance(400)
    counts = cloud.particles.counts()
    assert counts[Status.FAILED] == 0
    assert counts[Status.ESCAPED] > 0.9 * len(x)
    stuck = bodies.status == Status.STUCK
    return int(stuck[:PLACES].sum()), float(stuck[PLACES:].mean())


def cells_of(fast, shape):
    """Return the case's grid with its hexahedra, or two prisms or some tetrahedra in each."""
    if shape != "prisms":
        return fast.grid if shape == "hexahedra" else fast.grid.triangulate()
    cells, points = fast.grid.cells_dict[12], np.array(fast.grid.points)
    x, y, z = np.moveaxis(np.round(points[cells] * 1e9), 2, 0)
    # Corners in VTK's order, in all cells from the same one on.
    corners = np.take_along_axis(cells, np.lexsort((x, y, z), axis=1)[:, [0, 1, 3, 2, 4, 5, 7, 6]], 1)
    halves = np.concatenate([corners[:, [0, 1, 2, 4, 5, 6]], corners[:, [0, 2, 3, 4, 6, 7]]])
    grid = pyvista.UnstructuredGrid({13: halves}, points)
    grid.cell_data["U"] = np.tile(fast.grid.cell_data["U"], (2, 1))
    return grid


def table_of(fast):
    """Return the tetrahedra that docs/tables.md makes of points, off the case's grid away from its walls."""
    grid = velocities(fast.grid, fast.flow, "points")
    x, u = np.array(grid.points, dtype=float), np.array(grid.point_data["U"])
    inside = np.ones(len(x), dtype=bool)
    inside[grid.extract_surface(algorithm="dataset_surface").point_data["vtkOriginalPointIds"]] = False
    x[inside] += np.random.default_rng(0).uniform(-8e-7, 8e-7, (inside.sum(), 3))
    u[inside] = fast.flow.sample(x[inside], fast.flow.locate(x[inside]), 0.0)[0]
    cloud = pyvista.PolyData(1e6 * x)
    cloud["U"] = u
    mesh = cloud.delaunay_3d(alpha=20.0)
    mesh = mesh.extract_cells(np.flatnonzero(mesh.celltypes == 10))
    mesh.points = 1e-6 * np.array(mesh.points)
    return mesh


def velocities(grid, flow, values):
    """A copy of a grid of cells with U at its cells, or at its points and 0 on walls, as solvers write it."""
    if values == "cells":
        return grid
    mesh = flow.mesh
    u = np.array(grid.cell_data_to_point_data().point_data["U"])
    walls = mesh.triangles[mesh.triangle_patch == [patch.name for patch in flow.patches].index("wall")]
    u[cKDTree(mesh.nodes[np.unique(walls)]).query(grid.points)[0] < 1e-9] = 0.0
    grid = grid.copy()
    grid.cell_data.clear()
    grid.point_data["U"] = u
    return grid


def write(file, grid):
    """Write a grid with U in the format of the name of the file."""
    at_cells = "U" in grid.cell_data
    u = np.array((grid.cell_data if at_cells else grid.point_data)["U"], dtype=float)
    if file.suffix == ".cgns":
        write_cgns(file, grid, u)
    elif file.suffix in (".vtk", ".vtu"):
        grid.save(file)
    else:
        ((vtk_type, cells),) = grid.cells_dict.items()
        data = {"cell_data": {"U": [u]}} if at_cells else {"point_data": {"U": u}}
        mesh = meshio.Mesh(np.array(grid.points), [(NAMES[vtk_type], cells)], **data)
        mesh.write(file, **({"file_format": "gmsh22"} if file.suffix == ".msh" else {}))


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("shape", "values"),
    [*product(("hexahedra", "prisms", "tetrahedra"), ("cells", "points")), ("table", "points")],
)
def test_bodies_stick_in_any_file_as_in_the_case(fast, tmp_path, shape, values):
    """From the same places over the inlet; 140 tracers and twice as many gels stuck where walls leaked."""
    grid = table_of(fast) if shape == "table" else velocities(cells_of(fast, shape), fast.flow, values)
    assert fast.stuck[0] <= 3
    assert fast.stuck[1] > 0.05
    for ending in ("vtu",) if shape == "table" else ("vtu", "vtk", "msh", "xdmf", "cgns"):
        file = tmp_path / f"flow.{ending}"
        write(file, grid)
        name = "Velocity" if ending == "cgns" else "U"
        of_file = read_flow(fast.folder, "latestTime", FlowSource(file=file, velocity=name))
        tracers, gels = stuck_of(of_file, fast.x)
        assert tracers <= 3, ending
        assert gels == pytest.approx(fast.stuck[1], abs=0.01), ending
