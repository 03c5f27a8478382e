"""Fields on the mesh: sums over the cells are those over the particles."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from observing import observe, pipe_cloud
from paths import PIPE

from foamprb.cli import main
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.errors import InputError
from foamprb.flow.read.field import Kind, read_field
from foamprb.flow.read.openfoam import read_case
from foamprb.results.foam import PatchValues, write_scalar_field
from foamprb.view.results import open_run

FUNCTION = "\ncloudFunctions { fields { type particleStatistics; sampleInterval 20; } }\n"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    case = tmp_path_factory.mktemp("statistics") / "pipe"
    shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("postProcessing"))
    file = case / "constant/softCloudProperties"
    text = re.sub(r"((?:endTime|writeInterval)\s+)[^;]+;", r"\g<1>0.02;", file.read_text())
    file.write_text(re.sub(r"\ncloudFunctions.*", "", text, flags=re.DOTALL) + FUNCTION)
    assert main(["run", "-case", str(case)]) == 0
    return case


def field(run, name, dimensions):
    path = run / "postProcessing/softCloud/fields/0.02" / name
    return read_field(path, Kind("volScalarField", "scalar", (dimensions,), "a scalar"), run).cells.ravel()


def test_the_time_in_the_cells_is_that_of_the_particles(run):
    fates = open_run(run).table()
    released = fates["fate"] != "pending"
    found = field(run, "residenceTime", (0, 0, 1, 0, 0, 0, 0))
    assert found.sum() == pytest.approx((fates["t1"] - fates["t0"])[released].sum(), rel=1e-9)
    flow = read_case(run)
    density = field(run, "concentration", (0, -3, 0, 0, 0, 0, 0))
    np.testing.assert_allclose(density * flow.mesh.volumes * 0.02, found, rtol=1e-9, atol=1e-15)


def test_mean_deformation_is_where_particles_were(run):
    D = field(run, "meanD", (0, 0, 0, 0, 0, 0, 0))
    time = field(run, "residenceTime", (0, 0, 1, 0, 0, 0, 0))
    assert ((D > 0.0) <= (time > 0.0)).all()
    assert 0.0 < D.max() < 1.0


def test_a_flow_without_a_mesh_is_refused(tmp_path):
    with pytest.raises(InputError, match="the flow has no mesh"):
        observe(pipe_cloud(), ParticleStatistics(), tmp_path)


def test_a_field_is_written_as_openfoam_reads_it(tmp_path):
    patches = {"wall": PatchValues("calculated", np.array([1.0, 0.1])), "front": PatchValues("empty")}
    write_scalar_field(tmp_path / "s", (0, -2, 0, 0, 0, 0, 0), np.array([2.0, 3.0]), patches)
    text = (tmp_path / "s").read_text()
    assert "dimensions      [0 -2 0 0 0 0 0];" in text
    assert "internalField   nonuniform List<scalar> 2\n(\n2.0\n3.0\n);" in text
    assert re.search(r"wall\n    \{\n        type            calculated;\n        value  ", text)
    assert re.search(r"front\n    \{\n        type            empty;\n    \}", text)
