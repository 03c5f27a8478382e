"""Runs on several processes, against the run on one: the same bits, and the same manners."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from foam_writer import decompose, read_fields
from paths import ROOT
from pipe_case import edit, short_case, with_eddies
from transient_case import SCALE, scaled, write_transient_case

from foamprb.cli import main
from foamprb.cloud.forces import FORCES
from foamprb.distributed.shared_memory import NODE_RANKS
from foamprb.results.checkpoint import StoredCheckpoint
from foamprb.results.pieces import XMLPolyDataReader, XMLPPolyDataReader
from foamprb.results.pvd import read_pvd

pytestmark = [
    pytest.mark.mpi,
    pytest.mark.skipif(shutil.which("mpirun") is None, reason="mpirun is not on PATH"),
]

FUNCTIONS = """cloudFunctions
{
    hits    { type patchPostProcessing; patches (wall); }
    paths   { type particleTracks; trackInterval 10; maxSamples 100; }
    loads   { type particleHistogram; }
    plane   { type particleCollector; mode plane; origin (0.0005 0 0); normal (1 0 0); }
    camera  { type deformabilityCytometry; origin (0.0005 0 0); normal (1 0 0); view (0 0 1); }
    blood   { type haemolysis; constants Ding; stress KelvinVoigt; }
    stress  { type suspensionStress; }
    fields  { type fieldSampling; fields (p); }
    cells   { type particleStatistics; }
}"""
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path]),
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
}


def case_with_functions(folder: Path) -> Path:
    case = short_case(folder)
    edit(case, r"cloudFunctions\s*\{\}", FUNCTIONS)
    edit(case, r"(\s)(deltaT\s)", r"\1writeFields (Uc stresslet); \2")
    return case


@pytest.fixture(scope="module")
def truth(tmp_path_factory):
    """A case and its results on one process."""
    case = case_with_functions(tmp_path_factory.mktemp("truth"))
    assert main(["run", "-case", str(case)]) == 0
    return case


@pytest.fixture
def case(tmp_path):
    return case_with_functions(tmp_path)


def command(n: int, case: Path, *options: str, script: Path | None = None) -> list[str]:
    program = [str(script)] if script else ["-m", "foamprb"]
    words = ["run", "-case", str(case), "-parallel", *options]
    return ["mpirun", "-np", str(n), sys.executable, *program, *words]


def run(n: int, case: Path, *options: str, script: Path | None = None) -> subprocess.CompletedProcess[str]:
    words = command(n, case, *options, script=script)
    return subprocess.run(words, capture_output=True, text=True, env=ENVIRONMENT, timeout=300, check=False)


def finish(n: int, case: Path, *options: str) -> str:
    done = run(n, case, *options)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == ""
    return done.stdout


def after_hook(folder: Path, hook: str) -> Path:
    """A script that changes something and then is ``foamprb``; ``rank`` is the number of the process."""
    script = folder / "hooked.py"
    script.write_text(
        "import errno, os, signal, sys\n"
        "from foamprb.cli import main\n"
        "from foamprb.distributed import shared_memory\n"
        "from foamprb.distributed.ranks import Ranks\n"
        "from foamprb.distributed.worker import Worker\n"
        "rank = int(os.environ['OMPI_COMM_WORLD_RANK'])\n"
        f"{hook}\n"
        "sys.exit(main())\n"
    )
    return script


def at_write(action: str, number: int, when: float = 0.0029) -> str:
    """Let a process do something as it writes its piece of the cloud of 3 ms."""
    return f"""
write = Worker.write_piece
def hooked(self, folder, time, *others):
    if rank == {number} and {when} < time < {when} + 0.0002:
        {action}
    return write(self, folder, time, *others)
Worker.write_piece = hooked
"""


def folder_of(case: Path) -> Path:
    return case / "postProcessing/softCloud"


def clouds(case: Path) -> list[tuple[float, dict[str, np.ndarray]]]:
    """Times and point arrays in the order of the particles' numbers."""
    found = []
    for entry in read_pvd(folder_of(case) / "softCloud.pvd"):
        path = folder_of(case) / entry.file
        cloud = (XMLPPolyDataReader if path.suffix == ".pvtp" else XMLPolyDataReader)(path).read()
        order = np.argsort(cloud["origId"], kind="stable")
        arrays = {"points": cloud.points, **{name: cloud[name] for name in cloud.point_data}}
        found.append((entry.time, {name: np.asarray(array)[order] for name, array in arrays.items()}))
    return found


def content(file: Path) -> tuple[dict[str, Any], dict[str, bytes]] | bytes:
    """Content of a file; of a checkpoint without checksums of files, as each process has its own."""
    if file.suffix != ".npz":
        return file.read_bytes()
    checkpoint = StoredCheckpoint(file, verify=True).read_all()
    # Sums over the particles of several ranks have other round-off.
    others = "sums", "parts", "fingerprint"
    header = {name: value for name, value in checkpoint.header.items() if name not in others}
    return header, {name: array.tobytes() for name, array in checkpoint.arrays.items()}


def assert_same(case: Path, truth: Path, functions: bool = True) -> None:
    """Every table, the last checkpoint and the clouds bit for bit; no file is unlisted."""
    folder = folder_of(case)
    listed = {folder / name for name in json.loads((folder / "manifest.json").read_text())["files"]}
    assert listed == {f for f in folder.rglob("*") if f.is_file()} - {folder / "manifest.json"}
    expected = [f.relative_to(folder_of(truth)) for f in folder_of(truth).rglob("*") if f.is_file()]
    last = max((f for f in expected if f.suffix == ".npz"), key=lambda f: float(f.stem))
    assert functions == any(f.name == "tracks.vtp" for f in expected)
    for file in expected:
        if file.suffix in ("", ".csv") or file in (last, Path("paths/tracks.vtp")):
            assert content(folder_of(case) / file) == content(folder_of(truth) / file), file
    for (at, found), (at_there, arrays) in zip(clouds(case), clouds(truth), strict=True):
        assert at == at_there
        assert list(found) == list(arrays)
        for name, array in arrays.items():
            assert found[name].dtype == array.dtype
            assert found[name].tobytes() == array.tobytes(), (at, name)


@pytest.mark.parametrize(("n", "nodes"), [(2, 1), (3, 2)])
def test_results_are_those_of_one_process(n, nodes, case, truth, monkeypatch):
    """On any number of nodes, of which the second of two has fewer processes."""
    monkeypatch.setitem(ENVIRONMENT, NODE_RANKS, str(-(-n // nodes)))
    out = finish(n, case)
    computers = "1 computer\n" if nodes == 1 else f"{nodes} computers\n"
    assert re.search(rf"310 particles among {n} processes of \d+ threads? on {computers}", out)
    assert out.count("Starting time loop") == 1
    assert_same(case, truth)
    first = folder_of(case) / "softCloud_000001"
    assert sorted(file.name for file in first.iterdir()) == [f"{i}.vtp" for i in range(n)]


AROUND = "wallLift { cutOff 100; } BrownianMotion { T 293.15; } faxenCorrection; gravity;"


def with_surroundings(case: Path) -> Path:
    """Particles that see the wall from far away, are pushed by molecules, and become bullets."""
    edit(case, r"shape\s+paper;", "shape stokes;")
    edit(case, r"^(\s*)tractionModel", r"\1shapeModel quadratic;\n\1tractionModel")
    edit(case, r"^\s+gravity;", AROUND)
    return case


@pytest.fixture(scope="module")
def pushed(tmp_path_factory):
    """As ``truth``, with walls and molecules."""
    case = with_surroundings(case_with_functions(tmp_path_factory.mktemp("pushed")))
    assert main(["run", "-case", str(case)]) == 0
    return case


def test_walls_and_molecules_do_the_same_after_a_kill_with_other_numbers(case, pushed, tmp_path, monkeypatch):
    with_surroundings(case)
    kill = after_hook(tmp_path, at_write("os.kill(os.getpid(), signal.SIGKILL)", 1))
    with monkeypatch.context() as two_nodes:
        two_nodes.setitem(ENVIRONMENT, NODE_RANKS, "1")
        assert run(2, case, script=kill).returncode != 0
    finish(3, case, "-resume")
    assert_same(case, pushed)


def test_one_process_writes_what_it_writes_without_mpi(case, truth):
    words = [sys.executable, "-m", "foamprb", "run", "-case", str(case), "-parallel"]
    subprocess.run(words, check=True, capture_output=True, env=ENVIRONMENT)
    found = {f.relative_to(case): f.read_bytes() for f in folder_of(case).rglob("*") if f.is_file()}
    expected = {f.relative_to(truth): f.read_bytes() for f in folder_of(truth).rglob("*") if f.is_file()}
    assert found == expected


def test_a_killed_run_goes_on_with_other_numbers_of_processes(case, truth, tmp_path):
    kill = after_hook(tmp_path, at_write("os.kill(os.getpid(), signal.SIGKILL)", 1))
    assert run(2, case, script=kill).returncode != 0
    assert not (folder_of(case) / "fates.csv").exists()
    # On three, until 4 ms; then on one.
    stop = after_hook(tmp_path, at_write("os.kill(os.getpid(), signal.SIGTERM)", 2, 0.0039))
    done = run(3, case, "-resume", script=stop)
    assert "Continuing from the checkpoint at t = 0.002 s" in done.stdout
    assert done.returncode == 143
    assert main(["run", "-case", str(case), "-resume"]) == 0
    assert_same(case, truth)
    suffixes = [Path(entry.file).suffix for entry in read_pvd(folder_of(case) / "softCloud.pvd")]
    assert suffixes == [".vtp"] + [".pvtp"] * 4 + [".vtp"] * 2


def test_a_run_begun_alone_goes_on_with_others(case, truth):
    edit(case, r"endTime\s+\S+;", "endTime 0.003;")
    assert main(["run", "-case", str(case)]) == 0
    edit(case, r"endTime\s+\S+;", "endTime 0.006;")
    finish(2, case, "-resume")
    assert_same(case, truth)


ERRORS = {
    "full disk": (
        at_write("raise OSError(errno.ENOSPC, 'No space left on device', str(folder))", 1),
        r"No space left on device: '.*softCloud_000003'\. To continue .*-resume",
    ),
    "bug": (at_write("1 / 0", 1), "rank 1: ZeroDivisionError: division by zero"),
}


@pytest.mark.parametrize("name", ERRORS)
def test_an_error_on_one_process_has_one_message_and_ends_all(name, case, truth, tmp_path):
    hook, expected = ERRORS[name]
    done = run(2, case, script=after_hook(tmp_path, hook))
    assert done.returncode == 1
    ours = [line for line in done.stderr.splitlines() if "foamprb" in line]
    assert len(ours) == 1, done.stderr
    assert re.match(f"--> foamprb Error : .*{expected}", ours[0])
    assert "Traceback" not in done.stderr
    assert "MPI_ABORT" not in done.stderr
    assert main(["run", "-case", str(case), "-resume"]) == 0
    assert_same(case, truth)


def test_a_mistake_in_the_input_has_one_message(case):
    edit(case, r"deltaT\s", "deltat ")
    done = run(2, case)
    assert done.returncode == 1
    assert done.stderr.count("foamprb Error") == 1
    assert "Did you mean 'deltaT'" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("number", [0, 1])
def test_ctrl_c_on_any_process_leaves_a_checkpoint(number, case, truth, tmp_path):
    hook = after_hook(tmp_path, at_write("os.kill(os.getpid(), signal.SIGINT)", number))
    done = run(2, case, script=hook)
    assert done.returncode == 130
    ours = [line for line in done.stderr.splitlines() if "foamprb" in line]
    assert ours == ["--> foamprb stopped at t = 0.003 s. To continue from the last checkpoint, add -resume."]
    assert "Traceback" not in done.stderr
    assert (folder_of(case) / "checkpoint/0.003.npz").exists()
    assert main(["run", "-case", str(case), "-resume"]) == 0
    assert_same(case, truth)


def test_ctrl_c_to_mpirun_ends_the_run_in_order(case):
    edit(case, r"endTime\s+\S+;", "endTime 1000;")
    # Many points, so that particles are on their way until SIGTERM comes.
    edit(case, "trackInterval 10;", "trackInterval 1;")
    # From Ctrl-C on mpirun reads no more of what the processes say: who says much waits for it for ever.
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.01;")
    # So long it waits before it sends SIGTERM, and as long again before it kills.
    patient = {**ENVIRONMENT, "OMPI_MCA_odls_base_sigkill_timeout": "10"}
    with subprocess.Popen(
        command(2, case), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=patient
    ) as process:
        deadline = time.monotonic() + 200.0
        while not (folder_of(case) / "checkpoint/0.01.npz").exists():
            assert time.monotonic() < deadline
            assert process.poll() is None
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=100)
    assert process.returncode != 0
    assert err.count("foamprb stopped at t = ") == 1, out + err
    assert "Traceback" not in err


def test_a_flow_that_changes_in_time_is_shared_as_it_is_read(tmp_path):
    case = write_transient_case(tmp_path / "case")
    edit(case, "^solution", "cloudFunctions { fields { type fieldSampling; fields (U p); } } solution")
    alone = Path(shutil.copytree(case, tmp_path / "alone"))
    assert main(["run", "-case", str(alone)]) == 0
    # However small the mesh is, its arrays are shared.
    done = run(2, case, script=after_hook(tmp_path, "shared_memory._SMALLEST = 100"))
    assert done.returncode == 0, done.stderr
    assert_same(case, alone, functions=False)


@pytest.fixture
def halves(tmp_path, monkeypatch):
    """A flow that changes in time in two processor folders, and two nodes."""
    monkeypatch.setitem(ENVIRONMENT, NODE_RANKS, "1")
    case = write_transient_case(tmp_path / "case")
    mesh = read_fields(case)[0]
    decompose(case, mesh, (mesh.centres[:, 0] > 0.5).astype(int), tuple(SCALE))
    for time_of, factor in SCALE.items():
        shutil.rmtree(case / time_of)
        for file in case.glob(f"processor*/{time_of}/U"):
            file.write_text(scaled(file.read_text(), factor))
    shutil.rmtree(case / "constant/polyMesh")
    return case


PUSH = """
import foamprb
def push(inputs, U, grad_U, rate):
    return (rate * U[0], rate * grad_U[1], 0.0), 0.0
foamprb.add_force("pushByField", push, needs=("U", "grad(U)"))
"""


def test_nodes_have_the_same_flow_that_changes_in_time(halves, tmp_path, capsys, monkeypatch):
    case = halves
    monkeypatch.delitem(FORCES, "pushByField", raising=False)
    functions = """
    fields { type fieldSampling; fields (U); }
    sums { type particleStatistics; sigmaParticles yes; }
    paths { type particleTracks; trackInterval 100; maxSamples 10; }
    """
    edit(case, "^solution", f"cloudFunctions {{ {functions} }} solution")
    # A force reads a field, and its gradient, on both nodes.
    (case / "constant/push.py").write_text(PUSH)
    edit(case, "^cloudFunctions", 'libs ("push.py"); cloudFunctions')
    edit(case, "gravity;", "gravity; wallLift { cutOff 1000; } faxenCorrection; pushByField { rate 100; }")
    edit(case, r'"\.\*" \{ type escape; \}', 'lid { type escape; } "floor|sides" { type stick; }')
    # The third ends before a time of the flow, and is sampled after it.
    (case / "constant/positions").write_text("((0.5 0.5 0.5) (0.499 0.5 0.55) (0.7 0.7 0.99))")
    alone = Path(shutil.copytree(case, tmp_path / "alone"))
    assert main(["run", "-case", str(alone)]) == 0
    (distances,) = re.findall(r"distance to walls/radius.*", capsys.readouterr().out)
    # However small the mesh is, its arrays are shared.
    script = after_hook(tmp_path, "shared_memory._SMALLEST = 100")
    for options in (), ("-overwrite",):
        done = run(2, case, "-cache", str(tmp_path / "cache"), *options, script=script)
        assert done.returncode == 0, done.stderr
        assert "on 2 computers" in done.stdout
        assert distances in done.stdout
        assert_same(case, alone)
        assert len(list((tmp_path / "cache").iterdir())) == 3


LANDING = """
advance = Ranks.advance
def hooked(self, *given):
    outcome = advance(self, *given)
    with open({log!r}, "a") as file:
        print(*(int(counts[1]) for counts in self._counts), file=file)
    return outcome
Ranks.advance = hooked
"""


def test_work_is_shared_anew_when_the_particles_of_one_process_land(tmp_path):
    case = short_case(tmp_path)
    edit(case, r"parcelsPerSecond\s+\S+;", "parcelsPerSecond 250;")
    # Every other particle lands within a millisecond.
    pairs = "(0 -0.002096 0) (0 -0.0003 0)"
    edit(case, r"\(0 -0\.00165 0\) \(0 -0\.002096 0\)", f"{pairs} " * 100, "constant/softCloudPositions")
    # None is stretched so far that walls must be listed farther away, and the first call taken again.
    edit(case, r"solid \{ Ca \S+; \}", "solid { Ca 0.0001; }")
    serial = Path(shutil.copytree(case, tmp_path / "serial"))
    assert main(["run", "-case", str(serial)]) == 0
    log = tmp_path / "active"
    done = run(2, case, script=after_hook(tmp_path, LANDING.format(log=str(log))))
    assert done.returncode == 0, done.stderr
    assert_same(case, serial, functions=False)
    active = np.loadtxt(log, dtype=int)
    # All but one of the particles of one process are gone; then the other has given it half of its own.
    assert active[0].tolist() == [1, 500]
    assert sorted(active[-1]) == [250, 251]


SHARING = """
import json, pathlib, sys
import numpy as np
from foamprb import prepare
from foamprb.distributed.launch import connect
from foamprb.distributed.worker import Worker

def private():
    # Memory that is this process' alone, kB.
    text = pathlib.Path("/proc/self/smaps_rollup").read_text()
    return sum(int(line.split()[1]) for line in text.splitlines() if line.startswith("Private"))

def mapping(array):
    # Device and file of the mapping that holds an array, and this process' share of its memory, kB.
    address, found = array.__array_interface__["data"][0], None
    for line in open("/proc/self/smaps"):
        words = line.split()
        if not words[0].endswith(":"):
            low, high = (int(word, 16) for word in words[0].split("-"))
            found = words[3:5] if low <= address < high else None
        elif found and words[0] == "Pss:":
            return found, int(words[1])

def touch(self):
    self.before = private()
    return float(self.windows.arrays[max(self.windows.arrays)].sum())

def tell(self):
    return *mapping(self.windows.arrays[max(self.windows.arrays)]), private() - self.before

Worker.touch, Worker.tell = touch, tell
found = connect()
if isinstance(found, Worker):
    sys.exit(found.serve(()))
job = prepare(sys.argv[1], threads=1, comm=found)
found.prepare_steps(job.cloud)
shared = found._publisher.move(np.full(1 << 24, 1.5))
# The flow's own arrays and those of its mesh are the shared ones.
flow, windows = job.cloud.flow, found.rank.windows.arrays.values()
for array in (flow.arrays().nodes, flow.arrays().tets, flow.arrays().neighbours):
    assert any(array is window for window in windows)
assert flow.mesh.tets is flow.arrays().tets
shared[-1] = 2.5
print(json.dumps([found.call(Worker.touch), found.call(Worker.tell)]))
found.dismiss(0)
"""


def test_memory_of_the_flow_is_shared(case, tmp_path):
    """128 MB that all see, and nobody has for himself."""
    script = tmp_path / "sharing.py"
    script.write_text(SHARING)
    words = ["mpirun", "-np", "3", sys.executable, str(script), str(case)]
    done = subprocess.run(words, capture_output=True, text=True, env=ENVIRONMENT, check=False, timeout=200)
    assert done.returncode == 0, done.stderr
    totals, told = json.loads(done.stdout.splitlines()[-1])
    assert totals == [1.5 * (1 << 24) + 1.0] * 3
    files, shares, grown = zip(*told, strict=True)
    # One file in memory that all have mapped, so that their shares of it add up to one array.
    assert len({tuple(file) for file in files}) == 1
    assert sum(shares) == pytest.approx(1 << 17, rel=0.02)
    assert max(grown) < 1 << 14


MEMORY = """
import sys, tracemalloc
from foamprb.cloud import measures
# Parts of a cloud take little memory beside the whole.
measures.PER_CONTEXT = 200
from foamprb.cloud import communicator
communicator.PART = 200
from foamprb import execute, prepare
from foamprb.distributed.launch import connect
from foamprb.distributed.worker import Worker
from foamprb.run import job as runs
from foamprb.run.log import log_description

found = connect()
if isinstance(found, Worker):
    sys.exit(found.serve(()))
assemble = runs.assemble

def assemble_anew(*given):
    tracemalloc.reset_peak()
    return assemble(*given)

def peak_of_run(case):
    job = prepare(case, threads=1, comm=found)
    log_description(job)
    execute(job, "startTime")
    return tracemalloc.get_traced_memory()[1]

runs.assemble = assemble_anew
few, many = sys.argv[1:]
# The first run also loads and compiles.
peak_of_run(few)
tracemalloc.start()
# One of them may hold a file longer than usual.
before = min(peak_of_run(few) for _ in range(2))
print(peak_of_run(many) - before)
found.dismiss(0)
"""
FEW, MANY = 2_000, 10_000
MOST = 360.0
"""Bytes of the first of three processes for each particle of the cloud.

A particle has 518 bytes, and 49 of a cloud function; a third of them are 189. On its way to a file a variable
of 72 bytes takes a few times as much. A second copy of the particles would be 173 bytes more.
"""


def test_no_process_holds_the_whole_cloud(tmp_path):
    """From the start to the end, with a function that remembers data and one that reads moving particles."""
    cases = []
    for n in (FEW, MANY):
        case = short_case(tmp_path / str(n))
        edit(
            case,
            r"cloudFunctions\s*\{\}",
            "cloudFunctions { a { type particleHistogram; } b { type suspensionStress; } }",
        )
        edit(case, r"endTime\s+\S+;", "endTime 1.2e-4;")
        edit(case, r"writeInterval\s+\S+;", "writeInterval 4e-5;")
        edit(case, r"duration\s+\S+;", "duration 5e-5;")
        edit(case, r"parcelsPerSecond\s+\S+;", f"parcelsPerSecond {n / 5e-5:g};")
        cases.append(str(case))
    script = tmp_path / "memory.py"
    script.write_text(MEMORY)
    words = ["mpirun", "-np", "3", sys.executable, str(script), *cases]
    done = subprocess.run(words, capture_output=True, text=True, env=ENVIRONMENT, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    assert 0.0 < float(done.stdout.splitlines()[-1]) / (MANY - FEW) < MOST


def test_rebounds_are_noted_by_all_processes(tmp_path):
    """Particles change hands, and take what they did with them."""
    one, two = (case_with_functions(tmp_path / name) for name in ("one", "two"))
    for case in (one, two):
        edit(case, r"type\s+stick;", "type rebound; e 0.5; mu 0.1;")
    assert main(["run", "-case", str(one)]) == 0
    finish(2, two)
    assert_same(two, one)
    assert (folder_of(one) / "hits/wall.csv").read_text().count("rebound") > 3


def test_eddies_are_the_same_on_several_processes(tmp_path):
    """And solids' memory. Without cloud functions each process gathers and saves a part of the particles."""
    case = with_eddies(tmp_path)
    edit(case, r"shape\s+paper;", "shape stokes;")
    relaxation = "relaxation { type prony; moduli (0.05 0.02); times (1e-4 1e-3); }"
    edit(case, r"(type\s+neoHooke;)", rf"\1 {relaxation}")
    alone = Path(shutil.copytree(case, tmp_path / "alone"))
    assert main(["run", "-case", str(alone)]) == 0
    kill = after_hook(tmp_path, at_write("os.kill(os.getpid(), signal.SIGKILL)", 1))
    assert run(3, case, script=kill).returncode != 0
    saved = {file.name for file in (folder_of(case) / "checkpoint").iterdir()}
    parts = ("", ".0", ".104", ".207")
    assert saved == {f"{t}.npz{part}" for t in ("0.001", "0.002") for part in parts}
    # A part that is cut gives way to the checkpoint before.
    part = folder_of(case) / "checkpoint/0.002.npz.104"
    part.write_bytes(part.read_bytes()[:-1])
    assert "Continuing from the checkpoint at t = 0.001 s" in finish(2, case, "-resume")
    assert_same(case, alone, functions=False)
