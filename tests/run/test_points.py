"""Points of the fluid that go along with the bodies: fates that the fluid alone would give."""

from __future__ import annotations

import logging
import shutil

import numpy as np
import pytest
from pipe_case import copy_of_pipe, edit, results
from scipy.integrate import solve_ivp
from transient_case import SCALE, write_transient_case

import foamprb
from foamprb.cli import main
from foamprb.errors import RunStopped
from foamprb.run.points import points_of


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """Bodies of 5 µm that start from the axis to the wall, which the outermost overlap, and settle."""
    case = copy_of_pipe(tmp_path_factory.mktemp("points"))
    edit(case, r"shape\s+paper;", "shape stokes; } tracers yes; interpolationSchemes {")
    edit(case, r"endTime\s+\S+;", "endTime 0.02;")
    edit(case, r"duration\s+\S+;", "duration 0.002;")
    places = " ".join(f"(0 {y:.9g} 0)" for y in np.linspace(0.0, -2.0935e-3, 80))
    edit(case, r"\(0 -0\.00165 0\)", places, "constant/softCloudPositions")
    return case


def test_points_follow_the_fluid_and_none_sticks(case, capsys):
    assert main(["run", "-case", str(case), "-threads", "2"]) == 0
    run = foamprb.open_run(case)
    fates, points = run.table("fates"), run.table("tracers")
    np.testing.assert_array_equal(points["id"], fates["id"])
    stuck = int((fates["fate"] == "stuck").sum())
    assert stuck > 3
    assert not (points["fate"] == "stuck").any()
    # Poiseuille's flow, as far as the mesh resolves it: every point keeps its radius and velocity.
    r0, r1 = (np.hypot(t[f"y{k}"], t[f"z{k}"]) for t, k in ((fates, 0), (points, 1)))
    np.testing.assert_allclose(r1, r0, atol=1e-6)
    speed = (points["x1"] - fates["x0"]) / (points["t1"] - fates["t0"])
    active = points["fate"] == "active"
    wanted = speed[0] * (1.0 - (r0 / 2.1e-3) ** 2)
    np.testing.assert_allclose(speed[active], wanted[active], atol=0.005 * speed[0])
    n, text = len(fates["id"]), capsys.readouterr().out
    share = foamprb.results.intervals.share
    said = f"{share(stuck, n).percent()}; of points {share(0, n).percent()}"
    assert f"stuck                    {stuck:10d}   {said}" in text
    assert f"    wall                 {stuck:10d}   {said}" in text
    # The report has them, too.
    assert main(["report", "-case", str(case)]) == 0
    page = (case / "postProcessing/softCloud/report.html").read_text()
    assert "share of points" in page
    assert share(0, n).percent() in page
    (case / "postProcessing/softCloud/report.html").unlink()
    shutil.rmtree(case / "postProcessing/softCloud/reportPlots")


def test_a_run_that_stops_among_its_points_ends_with_the_same_files(case, tmp_path):
    logging.getLogger("foamprb").handlers.clear()
    whole = results(case)
    assert any(name.endswith("tracers.csv") for name in whole)
    job = foamprb.prepare(case, threads=2)
    done = []

    def stop():
        done.append(job.cloud.step == job.steps)
        return done.count(True) > 1

    with pytest.raises(RunStopped, match=r"of the tracers\. .*add -resume"):
        foamprb.execute(job, "startTime", stop)
    assert not any(name.endswith(("fates.csv", "tracers.csv")) for name in results(case))
    foamprb.execute(foamprb.prepare(case, threads=1), "latestTime")
    assert results(case) == whole


def test_points_in_a_flow_that_changes_follow_its_velocity(tmp_path):
    """It is linear in time and space, and the bodies, which have inertia, end elsewhere."""
    case = write_transient_case(tmp_path)
    edit(case, r"transient yes;", "transient yes; tracers yes;")
    edit(case, r"shape stokes;", "shape stokes; roughnessShare 0.01;")
    job = foamprb.prepare(case, threads=1)
    assert points_of(job).models.roughness_share == 0.01
    foamprb.execute(job)
    flow, x = job.cloud.flow, np.array([[0.5, 0.5, 0.5], [0.45, 0.5, 0.55]])
    flow.load(0.0, 0.0)
    u, gradient = (values / SCALE["0"] for values in flow.sample(x, flow.locate(x), 0.0))

    def velocity(t, y):
        factor = np.interp(t, [float(time) for time in SCALE], list(SCALE.values()))
        return factor * (u[0] + gradient[0] @ (y - x[0]))

    points = foamprb.open_run(case).table("tracers")
    for k in range(2):
        way = solve_ivp(velocity, (0.3, 1.2), x[k], rtol=1e-10, max_step=0.01).y[:, -1]
        np.testing.assert_allclose([points[f"{c}1"][k] for c in "xyz"], way, atol=1e-6)
