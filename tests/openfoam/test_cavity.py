"""OpenFOAM's first tutorial: a two-dimensional box with a lid that slides."""

from __future__ import annotations

import subprocess

import numpy as np
import pytest
import pyvista
from foam_tutorials import tutorial

from foamprb import Cloud, Medium, Models, Status, read_case, read_mesh_file, spheres
from foamprb.cloud.patches import Stick
from foamprb.settings.patches import patch_interactions

pytestmark = pytest.mark.openfoam


def test_the_flow_in_cavity_stays_in_its_plane_and_off_its_walls(tmp_path):
    case = tutorial("incompressible/icoFoam/cavity/cavity", tmp_path / "cavity")
    for application in ("blockMesh", "icoFoam"):
        subprocess.run([application], cwd=case, check=True, capture_output=True)
    (case / "case.foam").touch()
    reader = pyvista.OpenFOAMReader(str(case / "case.foam"))
    reader.set_active_time_value(0.5)
    grid = reader.read()["internalMesh"]
    grid.point_data.clear()
    grid.save(tmp_path / "flow.vtk")
    x = np.random.default_rng(0).uniform(0.02, 0.98, (300, 3)) * [0.1, 0.1, 0.01]
    for flow in (read_case(case), read_mesh_file(tmp_path / "flow.vtk")):
        u, l = flow.sample(x, flow.locate(x), 0.0)
        assert np.abs(u[:, 2]).max() == np.abs(l[:, 2]).max() == 0.0
        bodies, still = spheres(x, d=1e-8, rho=1e3, mu=1e3), Medium(1e-6, 1e3, (0.0, 0.0, 0.0))
        cloud = Cloud(bodies, flow, still, patch_interactions(flow, Stick()), 5e-3, Models("roscoe"))
        cloud.advance(200)
        assert np.all(cloud.particles.status == Status.ACTIVE)
        assert np.array_equal(cloud.particles.x[:, 2], x[:, 2])
