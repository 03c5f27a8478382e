"""Results in the files of other programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import pyvista
from view_run import motion, write_run
from vtkmodules.vtkIOHDF import vtkHDFReader

import foamprb
from foamprb import read_case
from foamprb.cli import main
from foamprb.results.tables import write_table


@pytest.fixture
def case(tmp_path):
    write_run(tmp_path, motion(9, 5))
    return tmp_path


def export(case: Path, kind: str, *options: str) -> None:
    assert main(["export", kind, "-case", str(case), *options]) == 0


def test_one_file_has_every_array_of_every_time(case):
    export(case, "vtkhdf")
    run = foamprb.open_run(case)
    reader = vtkHDFReader()
    reader.SetFileName(str(run.folder / "softCloud.vtkhdf"))
    reader.UpdateInformation()
    key = reader.GetExecutive().TIME_STEPS()
    times = reader.GetOutputInformation(0).Get(key)
    np.testing.assert_allclose(times, run.times, rtol=1e-7)
    for time, exact in zip(times, run.times, strict=True):
        reader.UpdateTimeStep(time)
        found, expected = pyvista.wrap(reader.GetOutputDataObject(0)), run.snapshot(exact)
        np.testing.assert_array_equal(found.points, expected.points)
        for name in expected.point_data:
            np.testing.assert_array_equal(found.point_data[name], expected.point_data[name])
    # Bodies that are released later are missing at first.
    assert run.snapshot(0.0).n_points < run.snapshot().n_points


def numbers(path: Path) -> np.ndarray:
    text = path.read_text()
    return np.array(text[text.index("\n(") :].replace("(", " ").replace(")", " ").split(), dtype=float)


def test_openfoams_files_name_the_cell_of_each_body(case):
    export(case, "openfoam")
    run = foamprb.open_run(case)
    cloud, folder = run.snapshot(), run.folder / "openfoam/0.4/lagrangian/softCloud"
    here = cloud["status"] <= 2
    assert here.sum() == cloud.n_points - 1
    rows = numbers(folder / "positions").reshape(-1, 4)
    np.testing.assert_array_equal(rows[:, :3], cloud.points[here])
    flow = read_case(case)
    np.testing.assert_array_equal(rows[:, 3], flow.cell_of(flow.locate(cloud.points[here])))
    F = numbers(folder / "deformationGradient").reshape(-1, 9)
    np.testing.assert_array_equal(F, cloud["deformationGradient"][here])
    assert "class       labelField;" in (folder / "origId").read_text()
    np.testing.assert_array_equal(numbers(folder / "d"), cloud["d"][here])
    assert (run.folder / "openfoam/constant/polyMesh/points").exists()


def test_openfoams_files_go_into_the_case_if_asked(case):
    export(case, "openfoam", "-output", str(case))
    assert (case / "0.4/lagrangian/softCloud/positions").exists()
    assert not (case / "constant").is_symlink()


def test_a_foreign_cloud_of_the_same_name_is_kept(case, capsys):
    foreign = case / "0.4/lagrangian/softCloud/positions"
    foreign.parent.mkdir(parents=True)
    foreign.write_text("of a solver")
    assert main(["export", "openfoam", "-case", str(case), "-output", str(case)]) == 1
    assert "lagrangian/softCloud: not written by foamprb; it is kept" in capsys.readouterr().err
    assert foreign.read_text() == "of a solver"
    assert not list(case.glob("0.[0-3]/lagrangian"))


@pytest.mark.parametrize("command", [["view"], ["report"], ["view", "-png"], ["export", "vtkhdf"]])
def test_an_output_replaces_no_file_of_another_kind(command, case, capsys):
    file = case / "constant/softCloudProperties"
    file.write_text("solution { }")
    write_table(case / "postProcessing/softCloud/fates.csv", {"id": []})
    option = [] if "-png" in command else ["-output"]
    assert main([*command, *option, str(file), "-case", str(case)]) == 1
    assert "softCloudProperties: a file of another kind, which is kept" in capsys.readouterr().err
    assert file.read_text() == "solution { }"


@pytest.mark.parametrize("inside", [False, True])
def test_files_of_an_earlier_export_are_removed(case, inside):
    """Later times of an earlier run are removed; files of OpenFOAM stay."""
    options = ["-output", str(case)] if inside else []
    target = case if inside else case / "postProcessing/softCloud/openfoam"
    export(case, "openfoam", *options)
    assert (target / "0.4/lagrangian/softCloud/positions").exists()
    fields = sorted(path for path in case.rglob("U") if "lagrangian" not in path.parts)
    own = target / "0.3/uniform/lagrangian/softCloud/cloudProperties"
    own.write_text(own.read_text() + "processor0 { particleCount 3; }\n")
    write_run(case, motion(9, 3), mesh=False)
    export(case, "openfoam", *options)
    assert not (target / "0.4/lagrangian").exists()
    assert (target / "0.3/lagrangian/softCloud/positions").exists()
    assert sorted(path.name for path in target.glob("0*/lagrangian")) == ["lagrangian"] * 4
    assert sorted(path for path in case.rglob("U") if "lagrangian" not in path.parts) == fields


def test_a_body_a_little_outside_is_in_the_cell_at_the_wall(case):
    from foamprb.view.export import _cells

    flow = read_case(case)
    inside = np.array([[0.31, 0.47, 1e-6], [0.8, 1.0 - 1e-6, 0.2]])
    outside = inside + np.array([[0.0, 0.0, -2e-6], [0.0, 2e-6, 0.0]])
    np.testing.assert_array_equal(_cells(flow, outside), _cells(flow, inside))


def test_impossible_exports_are_reported(case, capsys, tmp_path_factory):
    empty = tmp_path_factory.mktemp("empty")
    assert main(["export", "vtkhdf", "-case", str(empty)]) == 1
    assert "no results here" in capsys.readouterr().err
    assert main(["export", "excel", "-case", str(case)]) == 2
    assert "vtkhdf" in capsys.readouterr().err


def test_a_stress_has_openfoams_order(tmp_path):
    from foamprb.results.foam import write_lagrangian

    stress = np.array([[1.0, 2.0, 3.0, 4.0, 5.0, np.nan]])
    folder = tmp_path / "0.1/lagrangian/c"
    write_lagrangian(folder, np.zeros((1, 3)), np.array([7]), {"S": stress, "q": np.zeros((1, 4))})
    # xx yy zz xy yz xz become xx xy xz yy yz zz; NaN becomes 0.
    assert numbers(folder / "S").tolist() == [1.0, 4.0, 0.0, 2.0, 5.0, 3.0]
    assert 'location    "0.1/lagrangian/c";' in (folder / "S").read_text()
    assert not (folder / "q").exists()
