"""The scripts that measure: their meshes, and their results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from benchmarks import looking, observed, pipe, scaling
from benchmarks.records import Results, Row, isolated, peak_memory, read_rows
from benchmarks.report import TARGETS, Target, costs_table, written_table

import foamprb
from foamprb.cloudfunctions.registry import FUNCTIONS
from foamprb.results.tables import write_table

GRID = pipe.Grid(6, 3, 8)


def test_pipe_mesh_holds_the_exact_flow(tmp_path):
    flow = foamprb.read_case(pipe.write_case(tmp_path, GRID))
    mesh = flow.mesh
    assert mesh.n_cells == GRID.cells
    assert mesh.inverted == 0
    assert [patch.type for patch in mesh.patches] == ["patch", "patch", "wall"]
    # A polygon of 24 sides in the circle.
    facets = 12.0 / np.pi * np.sin(np.pi / 12.0)
    assert mesh.volumes.sum() == pytest.approx(facets * np.pi * pipe.RADIUS**2 * pipe.LENGTH, rel=1e-5)
    u = flow.at_nodes()[1][mesh.n_points :]
    # The values belong to the means of the cells' corners, which are not quite their centres.
    assert u == pytest.approx(pipe.poiseuille(mesh.centres), abs=0.02 * pipe.MEAN)


def test_a_run_with_output_is_in_air_whatever_another_part_has_left(tmp_path):
    case = pipe.write_case(tmp_path, GRID)
    pipe.write_dictionaries(case, pipe.WATER.nu, pipe.WATER.rho)
    pipe.write_soft_cloud(case, 10, 2e-5, 10, 1)
    medium = foamprb.prepare(case).cloud.medium
    assert (medium.mu, medium.rho) == pytest.approx((pipe.NU * pipe.RHO, pipe.RHO))


def test_sizes_of_the_grids():
    assert pipe.GRIDS["5k"].cells == 4992
    assert pipe.GRIDS["40k"].cells == 39_936


def test_a_process_of_its_own_has_its_own_memory():
    _ballast = np.ones(50_000_000)
    assert peak_memory() > 4e8
    assert isolated(peak_memory).result < 2e8


@pytest.mark.nightly
def test_many_bodies_are_looked_at_in_little_memory(tmp_path):
    case = looking.write_run(tmp_path, 100_000, 51)
    for command, most in {"view": 470.0, "report": 600.0}.items():
        words = [command, "-noBrowser", "-case", str(case)]
        code = f"from foamprb.cli import main\nassert main({words}) == 0\n"
        assert looking.cost(code, tmp_path)[1] < most


def test_results_come_back_from_their_file(tmp_path):
    rows = [Row("tracker", "cost", "a, b", 10.0, 0.1, "us"), Row("mesh", "cost", "c", 0.0, 2.0, "")]
    write_table(tmp_path / "x.csv", {name: [getattr(row, name) for row in rows] for name in Row._fields})
    assert read_rows(tmp_path / "x.csv") == rows
    assert Results(rows).get("cost", "c") == 2.0
    assert Results(rows).get("cost", "a, b", 11.0) is None


def test_targets_know_their_sense():
    assert Target("", lambda _: None, 2.0).met(2.0)
    assert not Target("", lambda _: None, 2.0).met(2.1)
    assert Target("", lambda _: None, 2.0, least=True).met(2.1)
    assert not Target("", lambda _: None, 2.0, least=True).met(1.9)
    rows = [Row("scaling", scaling.SPEED_UP, "threads", 2.0, 1.5, "")]
    table = written_table(Results(rows))
    assert table.count("not measured") == len(TARGETS) - 1
    assert "**not met** (1.23 of the limit)" in table


def test_every_cloud_function_is_measured_in_settings_that_are_read(tmp_path):
    case, types = pipe.write_case(tmp_path, GRID), set()
    for row in observed.ROWS.values():
        file = observed.write_setup(case, "with", row.setup, 3, 2e-4)
        job = foamprb.prepare(case, dictionary=Path(file))
        types |= {type(function) for function in job.functions.functions.values()}
        assert job.cloud.dt * job.steps == pytest.approx(2e-4)
    assert types == {*FUNCTIONS.values()}


def test_writing_every_step_is_measured_as_dearer_and_leaves_no_results(tmp_path):
    case = pipe.write_case(tmp_path, GRID)
    bare, writing = observed.compare(["writeInterval deltaT"], 50, case, observed.Size(50, 0, 1, 20, 1, 0))
    assert writing > max(bare, 0.0)
    assert not [*(case / "postProcessing").iterdir()]


def test_a_missed_target_stands_out():
    ratios = {"particleStatistics": 1.3, "particleTracks": 1.04}
    rows = [Row("observed", observed.RATIO, name, 0.0, value, "") for name, value in ratios.items()]
    table = costs_table(Results(rows))
    assert "**1.3**" in table
    assert "| 1.04 " in table
