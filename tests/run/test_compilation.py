"""A second process compiles the loop while the flow is read; its code is that of the first process."""

import io
import logging
import shutil
import subprocess
import time

import numba
import numpy as np
import pytest
from foam_writer import header
from mesh_shapes import block
from numba.core import event
from paths import PIPE
from pipe_case import edit, short_case

import foamprb
from foamprb.cli import main
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import _kernel
from foamprb.cloud.tracker import Models, Tracker
from foamprb.compile import link as compiling
from foamprb.compile.cache import cache_directory
from foamprb.compile.link import packed
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow
from foamprb.run import precompile
from foamprb.run.compilation import Compilation

AIR = Medium(1.8e-5, 1.2, (0.0, -9.81, 0.0))


def steady(mesh):
    return MeshFlow(mesh, 0.1 * np.ones((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def transient(mesh):
    u = 0.1 * np.ones((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))
    return SeriesFlow(mesh, [0.0, 1.0], lambda _: u)


def loop():
    return Tracker(
        Models(integrator="paper"), MeshFlow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False
    )


def begun(tracker, flow):
    compilation = Compilation()
    compilation.begin(tracker, flow)
    return compilation


@pytest.fixture
def two_processors(tmp_path, monkeypatch):
    """An empty cache, and a processor to spare."""
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(compiling, "_dispatchers", {})
    monkeypatch.setattr("foamprb.run.compilation.available_threads", lambda: 2)


def test_one_processor_compiles_alone(two_processors, monkeypatch):
    monkeypatch.setattr("foamprb.run.compilation.available_threads", lambda: 1)
    monkeypatch.setattr("foamprb.run.compilation.subprocess.Popen", lambda *_, **__: pytest.fail("a process"))
    begun(loop(), MeshFlow).wait()


@pytest.mark.usefixtures("two_processors")
def test_no_process_outlives_an_error_in_the_input(tmp_path, monkeypatch, capsys):
    started, popen = [], subprocess.Popen

    def start(*arguments, **options):
        started.append(popen(*arguments, **options))
        return started[0]

    monkeypatch.setattr("foamprb.run.compilation.subprocess.Popen", start)
    shutil.copytree(PIPE, tmp_path / "pipe", ignore=shutil.ignore_patterns("postProcessing"))
    (tmp_path / "pipe/249/U.gz").write_bytes(b"no field")
    assert main(["run", "-case", str(tmp_path / "pipe")]) == 1
    assert "--> foamprb Error" in capsys.readouterr().err
    assert started[0].returncode is not None


@pytest.mark.usefixtures("two_processors")
def test_a_stopped_process_is_not_waited_for():
    tracker = loop()
    compilation = begun(tracker, MeshFlow)
    compilation.stop()
    compilation.stop()
    compilation.wait()
    assert not tracker.compiled


@pytest.mark.usefixtures("two_processors")
def test_a_process_that_cannot_start_is_ignored(monkeypatch):
    monkeypatch.setattr("foamprb.run.compilation.sys.executable", "/bin/false")
    tracker = loop()
    begun(tracker, MeshFlow).wait()
    assert not tracker.compiled


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize("terminal", [False, True])
def test_the_time_of_compilation_is_shown_while_something_compiles(terminal, monkeypatch, caplog):
    monkeypatch.setattr("foamprb.run.compilation._TICK", 1e-3)
    monkeypatch.setattr("foamprb.run.compilation._BETWEEN_LINES", 1e-2)
    monkeypatch.setattr("sys.stderr", screen := Terminal() if terminal else io.StringIO())
    compilation = Compilation()

    def wait_for(n):
        line = "\x1b[2KCompiling: 0 s\r"
        while (screen.getvalue().count(line) if terminal else caplog.messages.count("Compiling: 0 s")) < n:
            time.sleep(1e-3)

    with caplog.at_level(logging.INFO, "foamprb"):
        with compilation.shown():
            time.sleep(0.02)
            assert not caplog.messages
            with event.trigger_event("numba:compile"):
                wait_for(3)
        compilation.log_end()
    first, *between, last = caplog.messages
    assert first.startswith("Compiling the formulas, once; the code is kept in ")
    assert last == "Compiled in 0 s"
    assert set(between) == (set() if terminal else {"Compiling: 0 s"})
    # At the end the line is erased.
    assert ("\r\x1b[2K" in screen.getvalue()) == terminal


@pytest.mark.parametrize("make", [steady, transient])
def test_example_of_a_flow_has_the_types_of_its_arguments(make):
    flow = make(build_mesh(block(1, 0.0, "mixed")))
    assert numba.typeof(type(flow).nothing()) == numba.typeof(flow.arrays(0.0, []))


def test_code_of_the_second_process_is_used(tmp_path, monkeypatch):
    (tmp_path / "numpy.py").write_text("open('executed', 'w')")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("foamprb.run.compilation.available_threads", lambda: 2)
    flow = steady(build_mesh(block(1, 0.0, "mixed")))
    models = Models(integrator="paper", touching="centre")

    def loop():
        return Tracker(models, flow.kernels, AIR, [], 1e-3, 0.0, shaped=False, tense=False)

    # A cache that lacks only the loop and the measures.
    arguments = type(flow).nothing()
    loop().compile(arguments)
    code = loop().linked(packed(arguments), packed(()))
    lacks = [compiling._stores[id(entry)][0].folder for entry in (code, _kernel())]
    cache = tmp_path / "cache"
    cache.mkdir()
    for folder in {*cache_directory().glob("*")} - {*lacks}:
        (cache / folder.name).symlink_to(folder)
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(cache))
    monkeypatch.setattr(compiling, "_dispatchers", {})

    p = foamprb.spheres(np.array([[0.5, 0.5, 0.5]]), d=1e-3, rho=1000.0, mu=1.0)
    cloud = Cloud(p, flow, AIR, [foamprb.Stick()] * len(flow.patches), 1e-3, models)
    assert not cloud.tracker.is_compiled(arguments)
    begun(loop(), type(flow)).wait()
    # It runs no code of the current folder.
    assert not (tmp_path / "executed").exists()
    assert cloud.tracker.is_compiled(arguments)
    assert all((cache / folder.name).is_dir() for folder in lacks)
    cloud.advance(1)
    stats = cloud.tracker._loop.stats
    assert (sum(stats.cache_hits.values()), sum(stats.cache_misses.values())) == (1, 0)
    assert p.x[0, 0] > 0.5


def in_memory():
    """Functions that this process has compiled, or loaded from the cache."""
    return {(code.__qualname__, s) for code in compiling._dispatchers.values() for s in code.signatures}


@pytest.mark.parametrize(
    ("fluid", "kind"), [("CrossPowerLaw", "steady"), ("Newtonian", "transient"), ("Newtonian", "rotating")]
)
def test_after_compile_no_run_has_to(fluid, kind, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(compiling, "_dispatchers", {})
    monkeypatch.setattr(precompile, "RUNS", [(fluid, kind, "stokes")])
    assert main(["compile"]) == 0
    assert "The code is kept in" in capsys.readouterr().out
    case = short_case(tmp_path)
    edit(case, r"shape\s+paper;", "shape stokes;")
    laws = f"transportModel {fluid}; CrossPowerLawCoeffs {{ nu0 3e-5; nuInf 1e-5; m 0.01; n 0.7; }}"
    edit(case, r"transportModel\s+Newtonian;", laws, "constant/transportProperties")
    if kind == "transient":
        edit(case, r"deltaT\s", "transient yes; accept ( pseudoTime ); deltaT ")
        shutil.copytree(case / "249", case / "0", dirs_exist_ok=True)
    if kind == "rotating":
        zones = "1(rotor { type cellZone; cellLabels List<label> 2(0 1); })"
        (case / "constant/polyMesh/cellZones").write_text(header("regIOobject", "cellZones") + zones)
        rotor = "rotor { cellZone rotor; origin (0 0 0); axis (1 0 0); omega 1; }"
        (case / "constant/MRFProperties").write_text(header("dictionary", "MRFProperties") + rotor)
    before = in_memory()
    assert main(["run", "-case", str(case)]) == 0
    assert in_memory() - before == set()
