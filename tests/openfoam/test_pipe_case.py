"""The pipe case run live: its flow against the committed one, and foamprb on both."""

from __future__ import annotations

import csv
import shutil
import subprocess

import numpy as np
import pytest
from paths import PIPE

from foamprb import Cloud, Medium, Models, Status, patch_interactions, read_case, spheres
from foamprb.cli import main

pytestmark = pytest.mark.openfoam

CASE = PIPE

D = 5e-6


def fates(case):
    with (case / "postProcessing/softCloud/fates.csv").open() as file:
        return list(csv.DictReader(file))


def test_committed_flow_is_what_a_live_run_gives(live):
    committed, fresh = read_case(PIPE), read_case(live)
    assert [tuple(p) for p in committed.patches] == [tuple(p) for p in fresh.patches]
    np.testing.assert_array_equal(committed.mesh.points, fresh.mesh.points)
    np.testing.assert_array_equal(committed.mesh.tets, fresh.mesh.tets)
    x = np.random.default_rng(0).uniform([0.0, -1.4e-3, -1.4e-3], [0.1, 1.4e-3, 1.4e-3], (1000, 3))
    hosts = committed.locate(x)
    u, l_f = committed.sample(x, hosts, 0.0)
    u_fresh, l_fresh = fresh.sample(x, hosts, 0.0)
    np.testing.assert_allclose(u_fresh, u, atol=1e-5 * 0.485)
    np.testing.assert_allclose(l_fresh, l_f, atol=1e-4 * 923.8)


def test_foamprb_gives_the_same_fates_on_both(live, tmp_path):
    committed = tmp_path / "pipe"
    shutil.copytree(
        PIPE, committed, ignore=shutil.ignore_patterns("postProcessing", "coarse", "medium", "fine")
    )
    for case in (committed, live):
        assert main(["run", "-case", str(case)]) == 0
    ours, theirs = fates(committed), fates(live)
    assert len(ours) == len(theirs) > 300
    assert sum(
        a["fate"] == b["fate"] and a["patch"] == b["patch"] for a, b in zip(ours, theirs, strict=True)
    ) >= (len(ours) - 1)
    for a, b in zip(ours[:5], theirs[:5], strict=True):
        assert a["fate"] == "stuck"
        assert float(a["x1"]) == pytest.approx(float(b["x1"]), rel=1e-4)


def test_openfoams_own_tools_read_the_committed_result(tmp_path):
    case = tmp_path / "pipe"
    shutil.copytree(PIPE, case, ignore=shutil.ignore_patterns("postProcessing", "coarse", "medium", "fine"))
    log = subprocess.run(
        ["checkMesh", "-latestTime"], cwd=case, capture_output=True, text=True, check=True
    ).stdout
    assert "Mesh OK." in log
    subprocess.run(
        ["postProcess", "-func", "mag(U)", "-latestTime"], cwd=case, capture_output=True, check=True
    )


def test_the_quasi_rigid_particle_lands_within_a_third_of_a_percent(live):
    """Against 8989 diameters of the exact pipe, touching by its centre as there."""
    flow = read_case(live)
    start = [[0.0, -1.65e-3, 0.0]]
    mu = 1.208 * 1.491e-5
    particles = spheres(start, d=D, rho=2560.0, mu=mu * 923.8 / 1e-4)
    walls = patch_interactions(flow)
    air = Medium(mu, 1.208, (0.0, -9.81, 0.0))
    cloud = Cloud(particles, flow, air, walls, 2e-5, Models(touching="centre", integrator="paper"))
    cloud.advance(15_000)
    assert particles.status[0] == Status.STUCK
    assert particles.x[0, 0] / D == pytest.approx(8989, rel=3e-3)
    assert particles.t[0] == pytest.approx(0.2327, rel=3e-3)
