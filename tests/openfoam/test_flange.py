"""The flange of OpenFOAM's tutorial for snappyHexMesh: where particles end, as VTK sees the same mesh."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
import pyvista
import vtk
from foam_tutorials import TUTORIALS, tutorial

from foamprb import Cloud, Escape, Medium, Models, Status, Stick, read_case, spheres

pytestmark = pytest.mark.openfoam

OPENINGS = ("flange_patch2", "flange_patch4")
RADIUS = 5e-5
HEADER = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"
VELOCITY = """dimensions [0 1 -1 0 0 0 0];
internalField uniform (0.3 -1 0.5);
boundaryField { ".*" { type zeroGradient; } }
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    case = tutorial("mesh/snappyHexMesh/flange", tmp_path_factory.mktemp("mesh") / "flange")
    surface = case / "constant/triSurface"
    surface.mkdir(parents=True, exist_ok=True)
    shutil.copy(TUTORIALS / "resources/geometry/flange.stl.gz", surface)
    for words in (["blockMesh"], ["surfaceFeatureExtract"], ["snappyHexMesh", "-overwrite"]):
        subprocess.run(words, cwd=case, check=True, stdout=subprocess.DEVNULL)
    (case / "0").mkdir(exist_ok=True)
    (case / "0/U").write_text(HEADER.format("volVectorField", "U") + VELOCITY)
    (case / "flange.foam").touch()
    return case


def test_tracks_lie_in_the_cells_that_vtk_sees_but_for_their_ends_on_openings(case):
    flow = read_case(case, "0")
    whole = pyvista.OpenFOAMReader(case / "flange.foam").read()
    cells, boundary = whole["internalMesh"], whole["boundary"]
    assert np.count_nonzero(cells.celltypes == pyvista.CellType.POLYHEDRON) > 1000
    surface, wall = vtk.vtkImplicitPolyDataDistance(), vtk.vtkImplicitPolyDataDistance()
    surface.SetInput(cells.extract_surface(algorithm="dataset_surface").triangulate())
    faces = pyvista.merge([boundary[name] for name in {*boundary.keys()} - {*OPENINGS}])
    wall.SetInput(faces.extract_surface(algorithm="dataset_surface").triangulate())
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(cells)
    locator.BuildLocator()

    # Anywhere in the mesh, some of them nearer to a wall than their radius.
    random, zone, n = np.random.default_rng(1), flow.cell_zone(None), 400
    share = np.abs(zone.volumes) / np.abs(zone.volumes).sum()
    corners = zone.vertices(zone.hosts[random.choice(len(share), n, p=share)])
    x = np.einsum("ni,nij->nj", random.dirichlet([1.0] * 4, n), corners)
    p = spheres(x, d=2 * RADIUS, rho=1.0, mu=1e4)
    distance = np.abs([wall.EvaluateFunction(x) for x in p.x])
    patches = [patch.name for patch in flow.patches]
    walls = [Escape() if name in OPENINGS else Stick() for name in patches]
    cloud = Cloud(p, flow, Medium(1e-2, 1.0, (0.0, 0.0, 0.0)), walls, 2e-5, Models(integrator="stokes"))
    cloud.advance(1)

    # Those end at once, and no others: they appear in touch with a wall.
    at_once = (p.status == Status.STUCK) & (p.t == 0.0)
    # VTK cuts warped faces of the wall into other triangles, which lie up to a fifth of the radius apart.
    certain = np.abs(distance / RADIUS - 1.0) > 0.2
    assert np.count_nonzero(at_once & certain) > 3
    np.testing.assert_array_equal(at_once[certain], distance[certain] < RADIUS)

    points = [x]
    for _ in range(40):
        points.append(p.x[p.status == Status.ACTIVE])
        cloud.advance(50)
    assert cloud.particles.counts()[Status.FAILED] == 0
    points.append(p.x[p.status != Status.ESCAPED])
    assert [x for x in np.concatenate(points) if locator.FindCell(x) < 0] == []
    # On a face a point is in a cell or not, as its last bits will, or as VTK cuts the face into triangles.
    ends = p.x[p.status == Status.ESCAPED]
    assert len(ends) > 30
    assert max(abs(surface.EvaluateFunction(x)) for x in ends) < 0.01 * RADIUS
    assert sum(locator.FindCell(x) < 0 for x in ends) > 0
