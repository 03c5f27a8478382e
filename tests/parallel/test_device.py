"""Clouds on a CUDA device that numba simulates, against the same on the processor."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import device_cases
import numpy as np
import pytest
from paths import ROOT
from pipe_case import copy_of_pipe, edit, fates, results

import foamprb.parallel.launch
from foamprb.cli import main
from foamprb.cloud.state import Particles, Status

needs_numba_cuda = pytest.mark.skipif(find_spec("numba_cuda") is None, reason="numba-cuda is not installed")

# The error estimate is a small difference of slopes, and so is the step that it allows.
TOLERANCE = dict.fromkeys(Particles._fields, 1e-10) | {"h": 1e-7}
TESTS = ROOT / "tests"


def small_case(folder: Path) -> Path:
    case = copy_of_pipe(folder)
    edit(case, r"endTime\s+\S+;", "endTime 2e-4;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 8e-5;")
    edit(case, r"deltaT\s+\S+;", "deltaT 2e-5;")
    edit(case, r"parcelsPerSecond\s+\S+;", "parcelsPerSecond 20000;")
    edit(case, r"duration\s+\S+;", "duration 1.5e-4;")
    edit(case, r"\(0 -0\.00165 0\)", "(0 -0.00165 0) (0 -0.0020976 0)", "constant/softCloudPositions")
    return case


def run_python(*arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join([str(TESTS), str(TESTS.parent), os.environ.get("PYTHONPATH", "")])
    environment = os.environ | {"PYTHONPATH": path} | variables
    return subprocess.run([sys.executable, *arguments], env=environment, capture_output=True, text=True)


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """Cases for the processor, for a whole run on the device, and for one in two parts."""
    return [small_case(tmp_path_factory.mktemp(name)) for name in ("cpu", "whole", "stopped")]


@pytest.fixture(scope="module")
def on_device(tmp_path_factory, cases):
    """States on the simulated device; the cases are run as well."""
    file = tmp_path_factory.mktemp("device") / "states.npz"
    script = str(TESTS / "device_cases.py")
    done = run_python(script, str(file), *map(str, cases[1:]), NUMBA_ENABLE_CUDASIM="1")
    assert done.returncode == 0, done.stderr
    with np.load(file) as arrays:
        return dict(arrays)


@pytest.fixture(scope="module")
def on_processor():
    return device_cases.states("cpu")


@needs_numba_cuda
class TestSimulated:
    @pytest.mark.parametrize("integrator", device_cases.INTEGRATORS)
    @pytest.mark.parametrize("cloud", ["pipe_cloud", "box_cloud", "long_steps"])
    def test_device_and_processor_agree(self, cloud, integrator, on_device, on_processor):
        for name in Particles._fields:
            key = f"{cloud} {integrator}/{name}"
            there, here = on_device[key], on_processor[key]
            if here.dtype.kind == "f":
                allowed = TOLERANCE[name] * np.abs(here).max()
                np.testing.assert_allclose(there, here, rtol=0.0, atol=allowed, err_msg=key)
            else:
                np.testing.assert_array_equal(there, here, err_msg=key)

    def test_clouds_hold_particles_of_every_kind(self, on_processor):
        """Else the test above would compare nothing of sticking, escaping, rebounding and waiting."""
        for integrator in device_cases.INTEGRATORS:
            expected = [Status.ACTIVE, Status.STUCK, Status.ESCAPED, Status.ACTIVE, Status.PENDING]
            assert on_processor[f"pipe_cloud {integrator}/status"].tolist() == expected
            status = on_processor[f"box_cloud {integrator}/status"].tolist()
            assert status[0] == Status.STUCK
            assert status[2:] == [Status.ACTIVE] * 3
        assert on_processor["box_cloud paper/v"][2, 1] < 0.0
        assert on_processor["box_cloud paper/status"][1] == Status.ESCAPED

    @pytest.mark.parametrize("integrator", device_cases.INTEGRATORS)
    def test_pieces_and_steps_begun_ahead_change_no_bit(self, integrator, on_device):
        """Whether the steps that were begun ahead are taken or dropped, and in a cloud that goes on."""
        for name in Particles._fields:
            whole, pieces = (on_device[f"{kind} {integrator}/{name}"] for kind in ("pipe_cloud", "pieces"))
            np.testing.assert_array_equal(pieces, whole, err_msg=name)

    def test_rebounds_are_refused_and_not_lost(self, tmp_path):
        case = small_case(tmp_path)
        edit(case, r"type\s+stick;", "type rebound;")
        hits = "hits { type patchPostProcessing; patches (wall); }"
        edit(case, r"cloudFunctions\s*\{\}", f"cloudFunctions {{ {hits} }}")
        words = ("-m", "foamprb", "run", "-case", str(case), "-device", "cuda")
        done = run_python(*words, NUMBA_ENABLE_CUDASIM="1")
        assert done.returncode == 1
        assert done.stderr.startswith("--> foamprb Error : -device cuda: patchPostProcessing of patches that")
        assert len(done.stderr.splitlines()) == 1

    def test_particles_here_know_nothing_of_steps_begun_ahead(self, on_device):
        assert on_device["early paper/t"][0] == pytest.approx(3 * 4e-5)

    def test_walks_mended_by_the_tree_are_counted(self, on_device):
        assert on_device["mended"] == 3 * 4

    @pytest.mark.usefixtures("on_device")
    def test_a_run_agrees_with_that_on_the_processor(self, cases):
        assert main(["run", "-case", str(cases[0])]) == 0
        here, there = fates(cases[0]), fates(cases[1])
        assert [(row["fate"], row["patch"]) for row in here] == [(row["fate"], row["patch"]) for row in there]
        assert {row["fate"] for row in here} == {"active", "stuck"}
        for name in ("t1", "x1", "y1", "z1", "a", "b", "c"):
            a, b = (np.array([float(row[name]) for row in rows]) for rows in (here, there))
            np.testing.assert_allclose(b, a, rtol=0.0, atol=1e-10 * np.abs(a).max(), err_msg=name)

    @pytest.mark.usefixtures("on_device")
    def test_a_run_that_was_stopped_goes_on_to_the_same_files(self, cases):
        whole, stopped = results(cases[1]), results(cases[2])
        assert set(whole) == set(stopped)
        assert len(whole) > 5
        assert [name for name in whole if whole[name] != stopped[name]] == []


class TestRefusal:
    def test_a_missing_package_is_one_message(self, cases, monkeypatch, capsys):
        monkeypatch.setattr(foamprb.parallel.launch, "find_spec", lambda _: None)
        assert main(["run", "-case", str(cases[0]), "-device", "cuda"]) == 1
        error = capsys.readouterr().err
        assert re.fullmatch(
            r"--> foamprb Error : -device cuda needs numba-cuda: .*'foamprb\[cuda\]'\.\n", error
        )

    @needs_numba_cuda
    def test_no_device_is_one_message(self, cases):
        done = run_python(
            "-m", "foamprb", "run", "-case", str(cases[0]), "-device", "cuda", CUDA_VISIBLE_DEVICES=""
        )
        assert done.returncode == 1
        assert re.match(r"--> foamprb Error : -device cuda: there is no CUDA device.*\n$", done.stderr)
        assert "Traceback" not in done.stderr

    def test_an_unknown_device_is_one_message(self, cases, capsys):
        assert main(["run", "-case", str(cases[0]), "-device", "gpu"]) == 1
        assert "'gpu' (choose from" in capsys.readouterr().err
