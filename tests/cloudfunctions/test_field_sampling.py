"""Fields of a case along the paths of particles."""

from __future__ import annotations

import numpy as np
import pytest
import pyvista
from foam_writer import header, put_linear, write_case
from observing import column, table
from pipe_case import END, edit, results, short_case, stop_after, time_folder
from transient_case import write_transient_case

from foamprb.cli import main
from foamprb.dictionary.dimensions import unit_text
from foamprb.errors import InputError
from foamprb.flow.read.flows import read_transient_flow
from foamprb.flow.read.openfoam import Case, steady_flow
from foamprb.flow.read.source import FlowSource


@pytest.mark.parametrize("components", [1, 3, 6, 9])
def test_a_linear_field_is_exact(components, tmp_path):
    write_case(tmp_path)
    mesh = Case(tmp_path).mesh("1e1").mesh
    at = np.random.default_rng(2).normal(size=(components, 3))
    put_linear(tmp_path / "1e1", mesh, at=at)
    flow = steady_flow(Case(tmp_path), "1e1", FlowSource(sampled=("T",)))
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    x = low + (high - low) * np.random.default_rng(1).uniform(0.02, 0.98, (50, 3))
    hosts = flow.locate(x)
    assert np.count_nonzero(hosts >= 0) > 40
    found = flow.fields(0.0, 0.0).at(x, hosts, 0.0)["T"]
    expected = np.where(hosts[:, None] >= 0, x @ at.T - 1.0, np.nan)
    if components == 1:
        # Corners beyond all centres of cells and faces keep to their range.
        centres = np.concatenate([mesh.centres, mesh.boundary_centres]) @ at.T - 1.0
        corners = flow._arrays.nodes[flow.mesh.tets[hosts], :3] @ at.T - 1.0
        beyond = (corners < centres.min()) | (corners > centres.max())
        assert found.values[hosts >= 0].min() >= centres.min()
        assert found.values[hosts >= 0].max() <= centres.max()
        expected[beyond.any(axis=(1, 2))] = found.values[beyond.any(axis=(1, 2))]
        assert np.count_nonzero(beyond.any(axis=(1, 2))) < len(x) / 2
    # OpenFOAM's symmetric tensors are xx xy xz yy yz zz.
    order = [0, 3, 5, 1, 4, 2] if components == 6 else range(components)
    np.testing.assert_allclose(found.values, expected[:, order], atol=1e-12)
    assert found.unit == "K"


def test_units_are_written_as_quotients():
    units = {
        (1, -1, -2): "kg/(m s2)",
        (0, 2, -2): "m2/s2",
        (0, 0, -1): "1/s",
        (0, 0, 0): "1",
        (1, -3, 0): "kg/m3",
    }
    assert {key: unit_text((*key, 0, 0, 0, 0)) for key in units} == units
    assert unit_text((0, 0.5, -1.5, 0, 0, 0, 0)) == "m0.5/s1.5"


def test_what_cannot_be_sampled_has_one_message(tmp_path):
    mesh = write_case(tmp_path)
    put_linear(tmp_path / "1e1", mesh)
    (tmp_path / "1e1/faces").write_text(header("surfaceScalarField", "faces"))
    with pytest.raises(InputError, match=r"no field Tt at time 1e1\. Did you mean 'T'\? Allowed: T, U, p\."):
        steady_flow(Case(tmp_path), "1e1", FlowSource(sampled=("Tt",)))
    with pytest.raises(InputError, match=r"faces is a surfaceScalarField, which is not sampled \(time 1e1\)"):
        steady_flow(Case(tmp_path), "1e1", FlowSource(sampled=("faces",)))


def test_a_field_that_a_time_lacks_is_reported_at_the_start(tmp_path):
    case = write_transient_case(tmp_path)
    put_linear(case / "0", Case(case).mesh("0").mesh)
    with pytest.raises(InputError, match=r"no field T at time 0\.5"):
        read_transient_flow(case, None, None, FlowSource(sampled=("T",)))


def test_values_at_a_given_time_do_not_depend_on_the_loaded_times(tmp_path):
    """Nor do those beside it by round-off."""
    case = write_transient_case(tmp_path)
    mesh = Case(case).mesh("0").mesh
    for time in ("0", "0.5", "1.5"):
        put_linear(case / time, mesh, begin=np.sqrt(2.0 + float(time)))
    flow = read_transient_flow(case, None, None, FlowSource(sampled=("T",)))
    x = np.random.default_rng(1).uniform(0.1, 0.9, (50, 3))
    hosts = flow.locate(x)
    for t in (0.5, 0.5 * (1.0 - 1e-15), 0.5 * (1.0 + 1e-15)):
        before, after, both = (
            flow.fields(*ends).at(x, hosts, t)["T"] for ends in ((0.1, 0.4), (0.6, 1.0), (0.1, 1.0))
        )
        assert before.values.tobytes() == after.values.tobytes() == both.values.tobytes()


def run_steady(case, *options):
    assert main(["run", "-case", str(case), *options]) == 0
    return case / "postProcessing/softCloud"


def test_values_along_paths_and_after_a_restart(tmp_path):
    case = short_case(tmp_path)
    time = time_folder(case)
    mesh = Case(case).mesh(time.name).mesh
    put_linear(time, mesh, at=np.array([100.0, 0.0, 0.0]))
    put_linear(time, mesh, "thermo:rho", begin=2.0, at=np.zeros(3))
    put_linear(time, mesh, "rho", at=np.eye(3), begin=0.0, dimensions="[0 1 -1 0 0 0 0]")
    entry = """cloudFunctions
    {
        sample { type fieldSampling; fields (T rho thermo:rho); }
        paths { type particleTracks; trackInterval 10; maxSamples 100; }"""
    edit(case, r"^cloudFunctions\s*\{", entry)
    stop_after(case, 0.5 * END)
    run_steady(case, "-resume")
    resumed = results(case)
    output = run_steady(case, "-overwrite")
    assert results(case) == resumed
    rows, fates = (table(next(output.rglob(name))) for name in ("fields.csv", "fates.csv"))
    assert [row["id"] for row in rows] == [row["id"] for row in fates]
    assert "stuck" in {row["fate"] for row in rows}
    first, last = (100.0 * column(fates, x) - 1.0 for x in ("x0", "x1"))
    np.testing.assert_allclose(column(rows, "T"), last, atol=1e-9)
    # The field rises along the pipe, in which a particle soon has the speed of the fluid.
    np.testing.assert_array_equal(column(rows, "TMax"), column(rows, "T"))
    moved = column(rows, "time") > column(fates, "t0")
    np.testing.assert_allclose(column(rows, "TMean")[moved], 0.5 * (first + last)[moved], rtol=0.01)
    # The name of the vector is that of the particles' density.
    np.testing.assert_allclose(column(rows, "rhocy"), column(fates, "y1"), atol=1e-12)
    far = np.sqrt(sum(column(fates, f"{x}1") ** 2 for x in "xyz"))
    assert (column(rows, "rhocMax") >= far * (1.0 - 1e-12)).all()
    np.testing.assert_array_equal(column(fates, "T"), column(rows, "T"))
    np.testing.assert_array_equal(column(fates, "rhocz"), column(rows, "rhocz"))
    np.testing.assert_allclose(column(fates, "thermo:rho"), 2.0, rtol=1e-12)
    tracks = output / "paths/tracks.vtp"
    assert 1 in pyvista.read(tracks).cell_data["status"]
    for file in (sorted(output.rglob("*.vtp"))[0], tracks):
        data = pyvista.read(file)
        np.testing.assert_allclose(data.point_data["T"], 100.0 * data.points[:, 0] - 1.0, atol=1e-9)
        np.testing.assert_allclose(data.point_data["rhoc"], data.points, atol=1e-12)
        assert {"T K", "rhoc m/s", "thermo:rho K"} <= set(data.field_data["units"])


def test_values_are_linear_between_the_times_of_a_transient_flow(tmp_path):
    """T = 4 t + 0.01 x at the times of the flow, 0, 0.5 and 1.5."""
    case = write_transient_case(tmp_path)
    mesh = Case(case).mesh("0").mesh
    for time in ("0", "0.5", "1.5"):
        put_linear(case / time, mesh, at=np.array([0.01, 0.0, 0.0]), begin=4.0 * float(time))
    functions = """cloudFunctions
    {
        sample { type fieldSampling; fields (T); }
        tracks { type particleTracks; trackInterval 4; maxSamples 100; }
    }
    solution"""
    edit(case, r"^solution", functions)
    edit(case, r"deltaT\s", "writePrecision double; deltaT ")
    # The particles start between two samples, at 0.3 s.
    output = run_steady(case)
    rows, fates = table(output / "sample/fields.csv"), table(output / "fates.csv")
    first, last = (4.0 * column(fates, f"t{k}") + 0.01 * column(fates, f"x{k}") for k in (0, 1))
    np.testing.assert_allclose(column(rows, "T"), last, rtol=1e-10)
    np.testing.assert_allclose(column(fates, "T"), last, rtol=1e-10)
    np.testing.assert_allclose(column(rows, "TMean"), 0.5 * (first + last), rtol=1e-4)
    tracks = pyvista.read(output / "tracks/tracks.vtp")
    expected = 4.0 * tracks.point_data["time"] + 0.01 * tracks.points[:, 0]
    assert tracks.point_data["time"].min() == pytest.approx(0.3)
    # Within a step the field is linear in time.
    np.testing.assert_allclose(tracks.point_data["T"], expected, rtol=1e-7)
    clouds = [pyvista.read(file) for file in sorted(output.glob("softCloud_*.vtp"))]
    assert clouds[0].n_points == 0
    assert "T" in clouds[0].point_data
    np.testing.assert_allclose(clouds[-1].point_data["T"], last, rtol=1e-10)
