"""The pulsatile pipe run live on its coarse mesh: flow, particles, and the same in processor folders."""

from __future__ import annotations

import re

import numpy as np
import pytest
from paths import ROOT, load

from foamprb.cli import main
from foamprb.results.pvd import read_pvd

pytestmark = pytest.mark.openfoam

CASE = ROOT / "cases/pulsatilePipe"
MEAN_FLOW = 0.012
"""Error of the coarse mesh's mean flow, which carries the particles astray."""


check = load(CASE / "check.py")


@pytest.fixture(scope="module")
def exact(live):
    cloud = check.in_exact_flow(check.in_files(live))
    return cloud, check.track(cloud)


def test_the_flow_is_womersleys(live):
    errors = check.flow_errors(live)
    assert max(errors.u) < 0.008
    assert max(errors.slope) < 0.02


def test_particles_go_as_in_the_flow_in_closed_form(live, exact):
    cloud, track = exact
    moved = np.abs(cloud.particles.x - cloud.particles.x0).max()
    assert moved > 0.03
    x, F = check.distances(check.track(check.in_files(live)), track)
    assert x[1] < MEAN_FLOW * moved
    # A shear strain of two, in a flow whose mean shear is off by as much.
    assert F[0] < 4.0 * MEAN_FLOW


def test_the_error_of_few_times_is_of_second_order(live):
    # In every second and fourth of the times; not fewer, where the next order shows.
    tracks = [check.track(check.in_files(live, stride), periods=2) for stride in (1, 2, 4)]
    two, four = (check.distances(track, tracks[0])[1, 0] for track in tracks[1:])
    # (4² − 1²)/(2² − 1²) = 5
    assert four / two == pytest.approx(5.0, rel=0.1)


def test_the_case_runs_from_the_command_line(live):
    settings = live / "constant/softCloudProperties"
    settings.write_text(re.sub(r"writeInterval +\S+;", "writeInterval 1;", settings.read_text()))
    assert main(["run", "-case", str(live), "-time", "3:4"]) == 0
    folder = live / "postProcessing/softCloud"
    assert [entry.time for entry in read_pvd(folder / "softCloud.pvd")] == pytest.approx([3, 4, 5, 6, 7])
