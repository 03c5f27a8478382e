"""Clouds in OpenFOAM's own files, read back by foamToVTK."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
import pyvista
from view_run import motion, write_run

import foamprb
from foamprb.cli import main

pytestmark = [
    pytest.mark.openfoam,
    pytest.mark.skipif(shutil.which("foamToVTK") is None, reason="foamToVTK is not on PATH"),
]


def test_foam_to_vtk_reads_the_cloud_back(tmp_path):
    write_run(tmp_path, motion(20, 4))
    assert main(["export", "openfoam", "-case", str(tmp_path)]) == 0
    run = foamprb.open_run(tmp_path)
    case = run.folder / "openfoam"
    control = tmp_path / "system/controlDict"
    control.write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n"
        "application foamToVTK; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 0.1;\n"
        "writeControl timeStep; writeInterval 1;\n"
    )
    for name in ("fvSchemes", "fvSolution"):
        (tmp_path / "system" / name).write_text(
            f"FoamFile {{ version 2.0; format ascii; class dictionary; object {name}; }}\n"
            "divSchemes {} gradSchemes {} laplacianSchemes {}\n"
        )
    subprocess.run(["foamToVTK", "-case", str(case)], check=True, capture_output=True)
    files = sorted((case / "VTK/lagrangian/softCloud").glob("*.vtp"))
    assert len(files) == len(run.times)
    for file, time in zip(files, run.times, strict=True):
        found, cloud = pyvista.read(file), run.snapshot(time)
        here = cloud["status"] <= 2
        assert found.n_points == here.sum() > 0
        # foamToVTK writes single precision.
        np.testing.assert_allclose(found.points, cloud.points[here], rtol=0, atol=1e-6)
        np.testing.assert_array_equal(found["origId"], cloud["origId"][here])
        for name in ("d", "U", "semiAxes", "taylorDeformation", "deformationGradient"):
            np.testing.assert_allclose(found[name], cloud[name][here], rtol=1e-6, atol=1e-9, err_msg=name)
