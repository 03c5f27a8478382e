"""Fields on the mesh: sums over the cells are those over the particles."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
import small_clouds
from observing import observe, observed, pipe_cloud
from paths import PIPE

from foamprb.cli import main
from foamprb.cloudfunctions.particle_statistics import ParticleStatistics
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.errors import InputError
from foamprb.flow.read.field import Kind, read_field
from foamprb.flow.read.openfoam import read_case
from foamprb.results.foam import PatchValues, write_field
from foamprb.view.results import open_run

FUNCTION = "\ncloudFunctions { fields { type particleStatistics; sigmaParticles yes; } }\n"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    case = tmp_path_factory.mktemp("statistics") / "pipe"
    shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("postProcessing"))
    file = case / "constant/softCloudProperties"
    text = re.sub(r"((?:endTime|writeInterval)\s+)[^;]+;", r"\g<1>0.02;", file.read_text())
    text = re.sub(r"(\bCa\s+)[\d.]+;", r"\g<1>0.01;", text)
    file.write_text(re.sub(r"\ncloudFunctions.*", "", text, flags=re.DOTALL) + FUNCTION)
    assert main(["run", "-case", str(case)]) == 0
    return case


def field(run, name, dimensions):
    path = run / "postProcessing/softCloud/fields/0.02" / name
    return read_field(path, Kind("volScalarField", "scalar", (dimensions,), "a scalar"), run).cells.ravel()


def test_the_time_in_the_cells_is_that_of_the_particles(run):
    fates = open_run(run).table()
    found = field(run, "residenceTime", (0, 0, 1, 0, 0, 0, 0))
    assert found.sum() == pytest.approx((fates["t1"] - fates["t0"]).sum(), rel=1e-9)
    flow = read_case(run)
    density = field(run, "concentration", (0, -3, 0, 0, 0, 0, 0))
    np.testing.assert_allclose(density * flow.mesh.volumes * 0.02, found, rtol=1e-9, atol=1e-15)


def test_faces_have_the_values_of_their_cells(run):
    flow = read_case(run)
    mesh = flow.mesh
    path = run / "postProcessing/softCloud/fields/0.02/residenceTime"
    found = read_field(path, Kind("volScalarField", "scalar", ((0, 0, 1, 0, 0, 0, 0),), "a time"), run)
    starts = mesh.patch_start
    for patch, first, last in zip(flow.patches, starts[:-1], starts[1:], strict=True):
        expected = found.cells[mesh.owner[mesh.n_internal :][first:last]]
        values = found.patches[patch.name].fields["value"]
        np.testing.assert_array_equal(np.broadcast_to(values, expected.shape), expected)
    assert np.ptp(found.patches["inlet"].fields["value"]) > 0.0


def test_mean_deformation_is_where_particles_were(run):
    D = field(run, "meanD", (0, 0, 0, 0, 0, 0, 0))
    time = field(run, "residenceTime", (0, 0, 1, 0, 0, 0, 0))
    assert ((D > 0.0) <= (time > 0.0)).all()
    assert 0.0 < D.max() < 1.0


def stress(run, path=None):
    path = path or run / "postProcessing/softCloud/fields/0.02/sigmaParticles"
    kind = Kind("volSymmTensorField", "symmTensor", (), "a stress")
    return read_field(path, kind, run)


def test_stress_is_that_of_nearly_rigid_spheres_in_the_flow_of_their_cells(run):
    fraction = field(run, "volumeFraction", (0, 0, 0, 0, 0, 0, 0))
    results, flow = open_run(run), read_case(run)
    fates = results.table()
    volume = np.pi / 6.0 * results.snapshot()["d"][0] ** 3
    moved = (fates["t1"] - fates["t0"]).sum()
    assert 0.02 * (fraction @ flow.mesh.volumes) == pytest.approx(moved * volume, rel=1e-3, abs=0.0)
    mu = results.record["fluid"]["mu"]
    centres = flow.mesh.centres
    l = flow.sample(centres, flow.locate(centres), 0.0)[1].reshape(-1, 3, 3)
    d = 0.5 * (l + l.transpose(0, 2, 1))
    rigid = 5.0 * mu * fraction[:, None] * d[:, [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]]
    # Ca is 0.01; a body is not at the centre of its cell.
    difference = stress(run).cells - rigid
    assert np.linalg.norm(difference) < 0.1 * np.linalg.norm(rigid)


def test_stress_is_exported_for_a_solver_at_a_chosen_volume_fraction(run, capsys):
    target = run / "1/sigma"
    export = ["export", "stress", "-case", str(run), "-volumeFraction", "0.03", "-output", str(target)]
    assert main(export) == 0
    fraction = field(run, "volumeFraction", (0, 0, 0, 0, 0, 0, 0))
    volumes = read_case(run, "0").mesh.volumes
    factor = -0.03 / (fraction @ volumes / volumes.sum()) / open_run(run).record["fluid"]["rho"]
    found = stress(run, target)
    np.testing.assert_allclose(found.cells, factor * stress(run).cells, rtol=1e-12)
    assert {patch.type for patch in found.patches.values()} == {"fixedValue"}
    export[5] = "0.06"
    assert main(export) == 0
    assert "Change of the stress: 100 %" in capsys.readouterr().out


def test_a_run_without_stress_and_another_file_are_refused(run, tmp_path, capsys):
    settings = run / "constant/softCloudProperties"
    before = settings.read_bytes()
    assert main(["export", "stress", "-case", str(run), "-output", str(settings)]) == 1
    assert "a file of another kind, which is kept" in capsys.readouterr().err
    assert settings.read_bytes() == before
    results = run / "postProcessing/softCloud/fields"
    results.rename(tmp_path / "fields")
    assert main(["export", "stress", "-case", str(run)]) == 1
    assert "type particleStatistics; sigmaParticles yes;" in capsys.readouterr().err
    (tmp_path / "fields").rename(results)


def test_times_and_deformation_are_the_same_with_the_stress(tmp_path):
    sums = []
    for sigmaParticles in (False, True):
        cloud = small_clouds.box_cloud("stokes")
        functions = CloudFunctions({"f": ParticleStatistics(sigmaParticles)}, observed(cloud))
        cloud.advance(10)
        sums.append(functions.state()["f/sums"])
    assert (sums[0] > 0).any(axis=0).all()
    assert sums[0].tobytes() == sums[1][:, :4].tobytes()


def test_a_flow_without_a_mesh_is_refused(tmp_path):
    with pytest.raises(InputError, match="the flow has no mesh"):
        observe(pipe_cloud(), ParticleStatistics(), tmp_path)


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("equal", [0, 11, 12])
def test_a_field_is_read_with_the_bits_that_were_written(equal, binary, tmp_path):
    values = np.where(np.arange(12) < equal, 0.25, 1.0 / np.arange(1, 13))
    for kind, cells in (("scalar", values), ("symmTensor", np.outer(values, np.arange(1.0, 7.0)))):
        patches = {"wall": PatchValues("calculated", cells[5:8]), "front": PatchValues("empty")}
        write_field(tmp_path / "s", (0,) * 7, cells, patches, binary=binary)
        assert (b"nonuniform" in (tmp_path / "s").read_bytes()) == (equal < 12)
        found = read_field(
            tmp_path / "s", Kind(f"vol{kind[0].upper()}{kind[1:]}Field", kind, (), "a field"), tmp_path
        )
        written = cells.reshape(12, -1)
        if kind == "symmTensor":
            written = written[:, [0, 3, 5, 1, 4, 2]]
        for read, expected in ((found.cells, written), (found.patches["wall"].fields["value"], written[5:8])):
            np.testing.assert_array_equal(np.broadcast_to(read, expected.shape), expected)


def test_fields_are_binary_unless_ascii_is_set_and_a_run_may_change_that(run, tmp_path):
    path = run / "postProcessing/softCloud/fields/0.02/residenceTime"
    assert b"format      binary;" in path.read_bytes()[:200]
    cloud = small_clouds.box_cloud("stokes")
    function = ParticleStatistics(writeFormat="ascii")
    observe(cloud, function, tmp_path)
    assert b"format      ascii;" in next(tmp_path.rglob("residenceTime")).read_bytes()[:200]
    assert function == ParticleStatistics()


def test_a_field_is_written_as_openfoam_reads_it(tmp_path):
    patches = {"wall": PatchValues("calculated", np.array([1.0, 0.1])), "front": PatchValues("empty")}
    write_field(tmp_path / "s", (0, -2, 0, 0, 0, 0, 0), np.array([2.0, 3.0]), patches)
    text = (tmp_path / "s").read_text()
    assert "dimensions      [0 -2 0 0 0 0 0];" in text
    assert "internalField   nonuniform List<scalar> 2\n(\n2.0\n3.0\n);" in text
    assert re.search(r"wall\n    \{\n        type            calculated;\n        value  ", text)
    assert re.search(r"front\n    \{\n        type            empty;\n    \}", text)
