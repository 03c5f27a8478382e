"""The pipe case run live: its flow against the committed one, and foamprb on both."""

from __future__ import annotations

import shutil
import subprocess

import numpy as np
import pytest
from paths import PIPE
from pipe_case import copy_of_pipe, fates

from foamprb import read_case
from foamprb.cli import main

pytestmark = pytest.mark.openfoam

CASE = PIPE


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
    committed = copy_of_pipe(tmp_path)
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
