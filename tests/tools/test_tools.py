"""The scripts that measure: their meshes, their counting, and their models."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks import pipe, plain
from benchmarks.records import Results, Row, isolated, peak_memory, read_rows
from benchmarks.report import TARGETS, Target, written_table
from benchmarks.roofline import Counting
from figures import projection

import foamprb
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


def test_the_scheme_in_plain_numpy_is_the_compiled_one():
    """To what each of the two leaves of its frames' skewness."""
    x, dt, steps = pipe.positions(40), 2e-5, 50
    flow = foamprb.analytic.pipe(pipe.RADIUS, pipe.MEAN, pipe.LENGTH)
    cloud = pipe.soft_cloud(flow, len(x), dt)
    cloud.advance(steps)
    (state,) = plain.carry(x, steps, dt)
    p = cloud.particles
    np.testing.assert_allclose(np.transpose(state.F), p.F, atol=1e-10)
    np.testing.assert_allclose(np.transpose(state.A), p.A, atol=1e-8 * pipe.WALL_RATE)
    np.testing.assert_allclose(np.transpose(state.x), p.x, atol=1e-13)
    np.testing.assert_allclose(np.transpose(state.v), p.v, atol=1e-10)
    assert np.abs(p.F - np.eye(3).ravel()).max() > 0.2


def test_a_run_with_output_is_in_air_whatever_another_part_has_left(tmp_path):
    case = pipe.write_case(tmp_path, GRID)
    pipe.write_dictionaries(case, pipe.WATER.nu, pipe.WATER.rho)
    pipe.write_soft_cloud(case, 10, 2e-5, 10, 1)
    medium = foamprb.prepare(case).cloud.medium
    assert (medium.mu, medium.rho) == pytest.approx((pipe.NU * pipe.RHO, pipe.RHO))


def test_sizes_of_the_grids():
    assert pipe.GRIDS["5k"].cells == 4992
    assert pipe.GRIDS["40k"].cells == 39_936


def test_operations_are_counted():
    Counting.done.clear()
    a, b = Counting(3.0), Counting(4.0)
    c = np.sqrt(a * a + b * b) / np.float64(2.0) - 1.0
    assert float(c) == 1.5
    assert Counting.done == {"multiply": 2, "add": 2, "sqrt": 1, "divide": 1}


def test_a_process_of_its_own_has_its_own_memory():
    _ballast = np.ones(50_000_000)
    assert peak_memory() > 4e8
    assert isolated(peak_memory).result < 2e8


def test_results_come_back_from_their_file(tmp_path):
    rows = [Row("tracker", "cost", "a, b", 10.0, 0.1, "us"), Row("mesh", "cost", "c", 0.0, 2.0, "")]
    write_table(tmp_path / "x.csv", {name: [getattr(row, name) for row in rows] for name in Row._fields})
    assert read_rows(tmp_path / "x.csv") == rows
    assert Results(rows).get("cost", "c") == 2.0
    assert Results(rows).get("cost", "a, b", 11.0) is None


def test_a_part_shows_what_was_measured_last():
    """Another processor's rows stay behind those of this one, part by part."""
    old, new = Row("mesh", "cost", "c", 0.0, 2.0, "", "old"), Row("mesh", "cost", "c", 0.0, 1.0, "", "new")
    other = Row("start", "start", "-help", 0.0, 0.3, "s", "old")
    results = Results([new, old, other])
    assert results.newest().rows == (new, other)
    assert results.on("old").rows == (old, other)


def test_targets_know_their_sense():
    assert Target("", lambda _: None, 2.0).met(2.0)
    assert not Target("", lambda _: None, 2.0).met(2.1)
    assert Target("", lambda _: None, 2.0, least=True).met(2.1)
    assert not Target("", lambda _: None, 2.0, least=True).met(1.9)
    rows = [Row("threads", "speed-up", "foamprb paper", 2.0, 1.5, "")]
    table = written_table(Results(rows))
    assert table.count("not measured") == len(TARGETS) - 1
    assert "**not met** (1.23 of the limit)" in table


class TestProjection:
    def test_spheres_on_the_vertical_land_after_their_fall(self):
        """The paper's: 0.2327 s from 0.45 mm above the wall, so 1.93 mm/s; at most 4.2 mm to fall."""
        times = projection.lifetimes(20_000).life
        assert (times > 0.0).all()
        assert times.max() <= 2.0 * projection.RADIUS / (0.45e-3 / 0.2327)
        # Without falling, a particle on the axis needs L/(2 U).
        assert times.min() < projection.LENGTH / (2.0 * projection.MEAN) < times.max()

    def test_no_node_waits_when_all_have_the_same(self):
        assert projection.shared_by_number(np.full(8000, projection.END), 10, 1.0) == pytest.approx(1.0)

    def test_particles_that_enter_together_are_the_work_of_few_nodes(self):
        sample = projection.lifetimes(20_000)
        assert projection.shared_by_place(sample, 1, 1) == 1.0
        assert (
            1.0 < projection.shared_by_place(sample, 4, 1) < projection.shared_by_place(sample, 20, 1) < 20.0
        )
