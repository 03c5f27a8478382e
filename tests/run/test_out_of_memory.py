"""Where memory runs out, a run ends in one message."""

from __future__ import annotations

import os
import resource
import subprocess
import sys

import pytest
from paths import ROOT
from pipe_case import copy_of_pipe, edit, short_case

from foamprb import memory, prepare
from foamprb.errors import InputError, RunStopped
from foamprb.run.results import open_results

N = 300_000
MB = 1 << 20


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """Particles of which the arrays and the copies that are written need 300 MB."""
    case = copy_of_pipe(tmp_path_factory.mktemp("memory"))
    edit(case, r"endTime\s+\S+;", "endTime 1.2e-4;")
    edit(case, r"writeInterval\s+\S+;", "writeInterval 4e-5;")
    edit(case, r"duration\s+\S+;", "duration 5e-5;")
    edit(case, r"parcelsPerSecond\s+\S+;", f"parcelsPerSecond {N / 5e-5:g};")
    # And so all is compiled.
    done = run(case, 8000 * MB)
    assert done.returncode == 0, done.stderr
    return case


def run(case, limit):
    """A run whose address space is limited, bytes."""
    paths = os.pathsep.join([str(ROOT), *sys.path])
    return subprocess.run(
        [sys.executable, "-m", "foamprb", "run", "-case", str(case), "-threads", "2", "-overwrite"],
        capture_output=True, text=True, check=False, timeout=600,
        env={**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )  # fmt: skip


# Before anything is read, while particles are placed, while they move or are written, and after all is well.
@pytest.mark.parametrize("megabytes", [100, 930, 1120, 1200])
def test_a_run_ends_in_one_message_or_as_it_should(case, megabytes):
    done = run(case, megabytes * MB)
    assert done.returncode in ((1,) if megabytes < 1000 else (0, 1)), done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    if done.returncode == 1 and "OpenBLAS" not in done.stderr:
        assert done.stderr.count("\n") == 1
        assert "not enough memory for" in done.stderr
        assert ", and th" in done.stderr
        if megabytes > 960:
            assert f"{N} particles" in done.stderr or f"{N + 5} particles" in done.stderr
    unfinished = [path for path in case.rglob("postProcessing/**/*") if path.name.endswith(".tmp")]
    assert unfinished == []


@pytest.fixture(autouse=True)
def _nothing_wanted():
    memory.forget()
    yield
    memory.forget()


def test_message_names_requested_and_available_memory(monkeypatch):
    monkeypatch.setattr(memory, "memory", lambda: 2e9)
    monkeypatch.setattr(memory, "_limit", lambda _: 0.0)
    assert str(memory.ran_out(MemoryError())) == "not enough memory; there are 2 GB."
    memory.announce("cells", 100, 1e6)
    memory.announce("particles", 10_000_000, 1e3)
    says = "not enough memory for 100 cells and 10000000 particles; needs "
    assert str(memory.ran_out(MemoryError())) == f"{says}about 10.1 GB, and there are 2 GB."
    memory.announce("particles", 10, 1e3)
    assert "10 particles; needs more than 2 GB, and there are 2 GB." in str(memory.ran_out(MemoryError()))


def test_only_memory_errors_are_reported_as_such():
    assert memory.ran_out(ValueError("no")) is None
    assert memory.ran_out(OSError(28, "No space left on device")) is None
    assert memory.ran_out(OSError(12, "Cannot allocate memory")) is not None
    assert memory.ran_out(ImportError("x.so: failed to map segment from shared object")) is not None
    assert memory.ran_out(RuntimeError("can't start new thread")) is not None
    after = ValueError("after it")
    after.__context__ = MemoryError()
    assert memory.ran_out(after) is not None


def test_the_writers_thread_ends_a_run_with_a_message(tmp_path):
    def fail():
        raise MemoryError

    job = prepare(short_case(tmp_path), threads=1)
    with (
        pytest.raises(RunStopped, match=rf"^not enough memory for 9216 cells and {job.cloud.size} particles"),
        open_results(job) as results,
    ):
        results._writer.begin(fail)
    with pytest.raises(InputError, match="as it is"), open_results(job):
        raise InputError("as it is")
