"""Where a flow comes from, through the command line."""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest
from foam_writer import write_case
from mesh_shapes import block
from paths import PIPE

from foamprb.cli import main
from foamprb.errors import InputError
from foamprb.flow.read.flows import read_flow
from foamprb.flow.read.source import Division, FlowSource
from foamprb.view.results import open_run


@pytest.fixture
def flow_file(tmp_path):
    shape = block(3, 0.2)
    shape.cell_data["velocity"] = np.ones((27, 3))
    shape.save(tmp_path / "flow.vtu")
    return tmp_path / "flow.vtu"


def test_info_of_a_mesh_file(flow_file, capsys):
    assert main(["info", "-flow", str(flow_file), "-featureAngle", "30"]) == 0
    said = capsys.readouterr().out
    assert "hexahedron                   27" in said
    assert "wall5                         9 faces  wall" in said
    assert "Openings are unknown: no array U. Another one is read by -velocity NAME: velocity." in said
    assert main(["info", "-flow", str(flow_file), "-velocity", "velocity"]) == 0
    said = capsys.readouterr().out
    assert (
        "opening5                      9 faces  opening         1 m2, 1 m3/s out, about (0.5 0.5 1)" in said
    )
    assert "velocity             at cells, (3,)" in said


def test_the_settings_of_one_folder_on_the_mesh_file_of_another(flow_file, tmp_path, capsys):
    case = tmp_path / "case"
    shutil.copytree(PIPE / "constant", case / "constant", ignore=shutil.ignore_patterns("polyMesh"))
    settings = case / "constant/softCloudProperties"
    text = settings.read_text()
    begin, end = text.index("        patches"), text.index("        touching")
    text = text[:begin] + 'patches ( "opening.*" { type rebound; } );\n' + text[end:]
    begin, end = text.index("        // 300 particles"), text.index("    patchInteractionModel")
    settings.write_text(text[:begin] + "    }\n\n" + text[end:])
    (case / "constant/softCloudPositions").write_text("((0.5 0.5 0.5))")
    arguments = ["-case", str(case), "-flow", str(flow_file), "-velocity", "velocity", "-dry-run"]
    assert main(["run", *arguments]) == 0
    said = capsys.readouterr().out
    assert f"Reading flow of case {flow_file}" in said
    assert "Dry run: 5 particles" in said
    assert main(["run", *arguments, "-region", "air"]) == 1
    assert "a mesh file has no regions, but the region is air" in capsys.readouterr().err


def test_followers_leave_a_duct_of_micrometres_through_its_outlet(tmp_path, capsys):
    """The scale is an entry of the settings, which the run uses, and a record of the run, which views use."""
    shape = block(8, 0.0)
    shape.points *= 1000.0
    y, z = 1e-3 * np.asarray(shape.points)[:, 1:].T
    shape.point_data["U"] = np.outer(y * (1.0 - y) * z * (1.0 - z), [0.1, 0.0, 0.0])
    file, case = tmp_path / "duct.vtu", tmp_path / "case"
    shape.save(file)
    (case / "constant").mkdir(parents=True)
    (case / "constant/transportProperties").write_text("transportModel Newtonian; nu 1e-06; rho 1000;")
    where = ["-case", str(case), "-flow", str(file)]
    assert main(["init", *where, "-scale", "1e-6"]) == 0
    assert "opening1                     64 faces  opening         1e-06 m2" in capsys.readouterr().out
    settings = case / "constant/softCloudProperties"
    text = settings.read_text()
    assert re.search(r"opening1 +{ type escape; }", text)
    assert re.search(r"wall +{ type stick; }", text)
    assert re.search(r"endTime +([0-9.]+)", text)[1] == "1"
    settings.write_text(re.sub("parcelsPerSecond +[0-9.e+]+", "parcelsPerSecond 100", text))
    assert main(["run", *where]) == 0
    said = capsys.readouterr().out
    everything = r"19   95 % \(76.4–99.1 %\)\n"
    assert re.search(rf"stuck +0\n +escaped +{everything} +opening1 +{everything}", said), said
    assert open_run(case).source(FlowSource(file)).length_scale == 1e-6


def test_the_settings_of_a_region_go_before_those_of_the_case(tmp_path, capsys):
    case = tmp_path / "case"
    shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("coarse", "medium", "fine", "postProcessing"))
    (case / "constant/air").mkdir()
    (case / "constant/polyMesh").rename(case / "constant/air/polyMesh")
    (case / "249/air").mkdir()
    (case / "249/U.gz").rename(case / "249/air/U.gz")
    assert main(["run", "-case", str(case), "-dry-run"]) == 1
    assert "divided into regions; choose one with -region. Allowed: air" in capsys.readouterr().err
    assert main(["run", "-case", str(case), "-region", "air", "-dry-run"]) == 0
    assert "Dry run: 305 particles, 50000 steps" in capsys.readouterr().out
    own = case / "constant/air/softCloudProperties"
    text = (case / "constant/softCloudProperties").read_text()
    own.write_text(text.replace("endTime         1;", "endTime         2;"))
    assert main(["run", "-case", str(case), "-region", "air", "-dry-run"]) == 0
    assert "Dry run: 305 particles, 100000 steps" in capsys.readouterr().out


@pytest.mark.parametrize("angle", ["0", "180", "-3"])
def test_feature_angles_that_are_none(angle, flow_file, capsys):
    assert main(["info", "-flow", str(flow_file), f"-featureAngle={angle}"]) == 1
    assert "an angle between 0 and 180 degrees is needed" in capsys.readouterr().err


def test_the_boundary_of_a_case_is_not_divided(tmp_path):
    write_case(tmp_path)
    with pytest.raises(InputError, match="a case has its own patches"):
        read_flow(tmp_path, source=FlowSource(division=Division(feature_angle=30.0)))
    with pytest.raises(InputError, match="only the lengths of a mesh file"):
        read_flow(tmp_path, source=FlowSource(scale=1e-3))
    assert read_flow(tmp_path).mesh.n_cells == 8
