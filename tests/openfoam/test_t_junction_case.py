"""The T-junction run live: who takes which branch, against how the flow divides."""

from __future__ import annotations

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
from foamprb.flow.read.flows import read_flow
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
NAMES = {12: "hexahedron", 10: "tetra"}
"""Of meshio, by VTK's types of cells."""


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
@pytest.mark.parametrize("values", ["cells", "points"])
@pytest.mark.parametrize("shape", ["hexahedra", "tetrahedra"])
def test_tracers_stick_to_no_wall_of_any_file(job, live, tmp_path, shape, values):
    """From the same places over the inlet; 140 and more stuck where walls of files let the flow through."""
    (live / "case.foam").touch()
    reader = pyvista.OpenFOAMReader(live / "case.foam")
    reader.set_active_time_value(reader.time_values[-1])
    reader.cell_to_point_creation = False
    grid, flow = reader.read()["internalMesh"], job.cloud.flow
    grid = velocities(grid if shape == "hexahedra" else grid.triangulate(), flow, values)
    faces, random = flow.patch_faces("inlet", 0.0), np.random.default_rng(1)
    flux = np.maximum(np.einsum("tvi,ti->tv", faces.velocity, faces.normals), 0.0).mean(axis=1) * faces.areas
    rows = random.choice(len(flux), PLACES, p=flux / flux.sum())
    x = np.einsum("nk,nki->ni", random.dirichlet(np.ones(3), PLACES), faces.vertices[rows])
    x += 1e-9 * faces.normals[rows]
    for ending in ("vtu", "vtk", "msh", "xdmf", "cgns"):
        file = tmp_path / f"flow.{ending}"
        write(file, grid)
        name = "Velocity" if ending == "cgns" else "U"
        of_file = read_flow(live, "latestTime", FlowSource(file=file, velocity=name))
        acts = [Stick() if patch.type == "wall" else Escape() for patch in of_file.patches]
        medium = Medium(0.1, 1000.0, (0.0, 0.0, 0.0))
        cloud = Cloud(spheres(x, d=1e-8, rho=1000.0, mu=1e3), of_file, medium, acts, 1e-3)
        cloud.advance(400)
        counts = cloud.particles.counts()
        assert counts[Status.STUCK] <= 3, ending
        assert counts[Status.ESCAPED] > 0.95 * PLACES, ending
        assert counts[Status.FAILED] == 0, ending
