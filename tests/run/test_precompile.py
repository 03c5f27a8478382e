"""The loop is compiled by another process while the flow is read, and is what this one would have made."""

import numpy as np
import pytest
from mesh_shapes import block

import foamprb
from foamprb.cli import main
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.tracker import Models, Tracker
from foamprb.compile import link as compiling
from foamprb.compile.helper import early_helper
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow
from foamprb.run.precompile import Precompiler

AIR = Medium(1.8e-5, 1.2, (0.0, -9.81, 0.0))


def steady(mesh):
    return MeshFlow(mesh, 0.1 * np.ones((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def transient(mesh):
    u = 0.1 * np.ones((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))
    return SeriesFlow(mesh, [0.0, 1.0], lambda _: u)


@pytest.mark.parametrize("make", [steady, transient])
def test_what_was_precompiled_is_what_is_wanted(make, tmp_path, monkeypatch):
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(compiling, "_parts", {})
    monkeypatch.setattr("foamprb.run.precompile.available_threads", lambda: 2)
    flow = make(build_mesh(block(1, 0.0, "mixed")))
    p = foamprb.spheres(np.array([[0.5, 0.5, 0.5]]), d=1e-3, rho=1000.0, mu=1.0)
    cloud = Cloud(p, flow, AIR, [foamprb.Stick()] * len(flow.patches), 1e-3, Models(integrator="stokes"))
    assert not cloud.compiled
    early = Tracker(cloud.models, flow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False)
    precompiler = Precompiler(early, type(flow))
    assert precompiler
    precompiler.wait()
    assert cloud.compiled
    assert not Precompiler(early, type(flow))
    cloud.advance(1)
    stats = cloud.tracker._track.stats
    assert (sum(stats.cache_hits.values()), sum(stats.cache_misses.values())) == (1, 0)
    assert p.x[0, 0] > 0.5
    # The stages as the first process would compile them are those that the loop is made of.
    monkeypatch.setattr(compiling, "_parts", {})
    assert not [stage.__name__ for stage in early.integrator.stages if early._compile(stage, {})]


@pytest.fixture
def early(tmp_path, monkeypatch):
    """What asks for a helper, on two processors, with a cache of its own."""
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr("foamprb.compile.helper.available_threads", lambda: 2)
    return lambda: early_helper("foamprb.run.precompile")


def test_a_helper_is_started_early_where_nothing_was_ever_compiled(early, tmp_path, monkeypatch):
    helper = early()
    assert helper
    assert not helper.ended
    helper.stop()
    assert helper.ended
    # It may be stopped again, and waited for.
    helper.stop()
    helper.wait()
    (tmp_path / "cache").mkdir()
    monkeypatch.setattr("foamprb.compile.helper.available_threads", lambda: 1)
    assert not early()
    monkeypatch.setattr("foamprb.compile.helper.available_threads", lambda: 2)
    (tmp_path / "cache/some code").mkdir()
    assert not early()


def test_a_helper_that_was_started_early_is_told_what_to_compile(early, monkeypatch):
    monkeypatch.setattr(compiling, "_parts", {})
    monkeypatch.setattr("foamprb.run.precompile.available_threads", lambda: 2)
    tracker = Tracker(
        Models(integrator="paper"), MeshFlow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False
    )
    helper = early()
    Precompiler(tracker, MeshFlow, helper).wait()
    assert helper.ended
    assert tracker.compiled


def test_a_helper_that_is_not_wanted_is_stopped(early, monkeypatch):
    monkeypatch.setattr("foamprb.run.precompile.available_threads", lambda: 1)
    tracker = Tracker(
        Models(integrator="paper"), MeshFlow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False
    )
    helper = early()
    assert not Precompiler(tracker, MeshFlow, helper)
    assert helper.ended


def test_a_mistake_in_the_input_leaves_no_helper(early, tmp_path, monkeypatch, capsys):
    started = []

    def start(module):
        started.append(early())
        return started[0]

    monkeypatch.setattr("foamprb.compile.helper.early_helper", start)
    assert main(["run", "-case", str(tmp_path / "nothing")]) == 1
    assert "--> foamprb Error" in capsys.readouterr().err
    assert started[0].ended


def test_one_that_is_stopped_leaves_nothing_to_wait_for(tmp_path, monkeypatch):
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(compiling, "_parts", {})
    monkeypatch.setattr("foamprb.run.precompile.available_threads", lambda: 2)
    tracker = Tracker(
        Models(integrator="paper"), MeshFlow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False
    )
    precompiler = Precompiler(tracker, MeshFlow)
    precompiler.stop()
    precompiler.wait()
    assert not tracker.compiled


def test_one_that_cannot_start_costs_nothing_but_its_help(tmp_path, monkeypatch):
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(compiling, "_parts", {})
    monkeypatch.setattr("foamprb.run.precompile.available_threads", lambda: 2)
    monkeypatch.setattr("foamprb.compile.helper.sys.executable", "/bin/false")
    tracker = Tracker(
        Models(integrator="paper"), MeshFlow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False
    )
    precompiler = Precompiler(tracker, MeshFlow)
    precompiler.wait()
    assert not tracker.compiled


def test_after_compile_no_run_has_to(capsys):
    """Where other tests keep their code as well, as much of it is theirs."""
    assert main(["compile"]) == 0
    assert "The code is kept in" in capsys.readouterr().out
    for kind in (MeshFlow, SeriesFlow):
        for integrator in INTEGRATORS:
            models = Models(integrator=integrator)
            assert Tracker(models, kind.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False).compiled
