"""Clouds and fields in OpenFOAM's own files, read back by its programs and by VTK."""

from __future__ import annotations

import re
import shutil
import subprocess

import numpy as np
import pytest
import pyvista
from paths import PIPE
from view_run import motion, write_run

import foamprb
from foamprb.cli import main
from foamprb.flow.read.field import Kind, read_field
from foamprb.flow.read.openfoam import read_case
from foamprb.results.foam import PatchValues, write_field

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


def test_openfoam_and_vtk_read_binary_fields(tmp_path):
    for name in ("system", "constant/polyMesh"):
        shutil.copytree(PIPE / name, tmp_path / name)
    shutil.copytree(PIPE / "249", tmp_path / "1")
    mesh = read_case(tmp_path, "1").mesh
    random = np.random.default_rng(1)
    s, sigma = random.random(mesh.n_cells), random.normal(size=(mesh.n_cells, 6))
    sizes = zip(mesh.patches, np.diff(mesh.patch_start), strict=True)
    faces = {patch.name: random.random(n) for patch, n in sizes}
    patches = {name: PatchValues("calculated", values) for name, values in faces.items()}
    write_field(tmp_path / "1/s", (0,) * 7, s, patches, binary=True)
    uniform = {name: PatchValues("calculated", np.ones((len(values), 6))) for name, values in faces.items()}
    write_field(tmp_path / "1/sigma", (0,) * 7, sigma, uniform, binary=True)
    (tmp_path / "case.foam").touch()
    reader = pyvista.OpenFOAMReader(tmp_path / "case.foam")
    reader.set_active_time_value(1.0)
    inside = reader.read()["internalMesh"].cell_data
    np.testing.assert_allclose(inside["s"], s, rtol=1e-6)
    # VTK orders xx yy zz xy yz xz.
    np.testing.assert_allclose(inside["sigma"], sigma, rtol=1e-6)
    control = tmp_path / "system/controlDict"
    text = control.read_text().replace("writeFormat     binary", "writeFormat     ascii")
    control.write_text(re.sub(r"writePrecision\s+\d+", "writePrecision 17", text))
    subprocess.run(["foamFormatConvert", "-case", tmp_path, "-time", "1"], check=True, capture_output=True)
    assert re.search(rb"format\s+ascii;", (tmp_path / "1/s").read_bytes())
    kind = Kind("volScalarField", "scalar", (), "a scalar")
    found = read_field(tmp_path / "1/s", kind, tmp_path)
    np.testing.assert_array_equal(found.cells[:, 0], s)
    for name, values in faces.items():
        np.testing.assert_array_equal(found.patches[name].fields["value"][:, 0], values)
