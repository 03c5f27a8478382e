"""The thread that writes, and runs that go on while it does."""

from __future__ import annotations

import errno
import os
import threading
import time
from collections.abc import Callable

import pytest
from pipe_case import edit, results, short_case

from foamprb import execute, prepare
from foamprb.cli import main
from foamprb.cloud.cloud import Stepper
from foamprb.errors import RunStopped
from foamprb.results import pvd
from foamprb.results.background import Writer
from foamprb.results.checkpoint import Checkpoints
from foamprb.results.pvd import Series

PATIENCE = 60.0
"""Seconds after which what is waited for will not come."""


def wait_for(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(1e-3)


def fail() -> None:
    raise OSError("no space")


def test_one_piece_of_work_at_a_time_in_order() -> None:
    done: list[int] = []
    free = threading.Event()

    def first() -> None:
        assert free.wait(PATIENCE)
        done.append(1)

    with Writer() as writer:
        writer.submit(first)
        writer.check()
        # It takes no second piece before the first is done.
        second = threading.Thread(target=writer.submit, args=(lambda: done.append(2),))
        second.start()
        second.join(0.1)
        assert second.is_alive()
        assert done == []
        free.set()
        second.join(PATIENCE)
        writer.finish()
        assert done == [1, 2]
        writer.submit(lambda: done.append(3))
    assert done == [1, 2, 3]


@pytest.mark.parametrize("word", ["check", "finish", "submit"])
def test_error_is_reported_once(word: str) -> None:
    with Writer() as writer:
        writer.submit(fail)
        wait_for(lambda: writer._unfinished is not None and writer._unfinished.done())
        with pytest.raises(OSError, match="no space"):
            getattr(writer, word)(*([fail] if word == "submit" else []))
        writer.finish()


def test_leaving_raises_the_last_error() -> None:
    with pytest.raises(OSError, match="no space"), Writer() as writer:
        writer.submit(fail)


def test_leaving_with_an_error_waits_and_keeps_the_error() -> None:
    done = []

    def slow() -> None:
        time.sleep(0.05)
        done.append(1)
        fail()

    def interrupted() -> None:
        with Writer() as writer:
            writer.submit(slow)
            raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        interrupted()
    assert done == [1]


@pytest.fixture
def case(tmp_path, monkeypatch):
    # A few steps at a time: 50 to each of six write times.
    monkeypatch.setattr("foamprb.run.loop.MOST_STEPS", 3000)
    return short_case(tmp_path)


def test_particles_go_on_while_a_cloud_is_written_but_not_beyond_the_next(case, monkeypatch):
    job = prepare(case, threads=1)
    append, steps = Series.append, []

    def slow(series, cloud):
        now = round(cloud.time / job.cloud.dt)
        if 0 < now < job.steps:
            # The particles come to the next write time while this is not written, and no further.
            wait_for(lambda: job.cloud.step == now + 50)
            time.sleep(0.05)
        steps.append((now, job.cloud.step))
        return append(series, cloud)

    monkeypatch.setattr(Series, "append", slow)
    execute(job)
    assert steps == [(0, 0), *((n, min(n + 50, 300)) for n in range(50, 301, 50))]


def test_results_do_not_depend_on_when_they_are_written(case, tmp_path, monkeypatch):
    assert main(["run", "-case", str(case)]) == 0
    expected = results(case)
    submit = Writer.submit

    def at_once(writer, work):
        submit(writer, work)
        writer.finish()

    monkeypatch.setattr(Writer, "submit", at_once)
    assert main(["run", "-case", str(case), "-overwrite"]) == 0
    assert results(case) == expected


def test_checkpoints_hold_what_cloud_functions_had_observed_at_their_time(case, monkeypatch):
    """And nothing of what they observe while the checkpoint is written."""
    edit(case, r"cloudFunctions\s*\{\}", "cloudFunctions { f { type particleHistogram; } }")
    write, found = Checkpoints.write, []
    for slow in (False, True):
        job, states = prepare(case, threads=1), {}

        def record(checkpoints, checkpoint, job=job, states=states, slow=slow):
            now = round(checkpoint.time / job.cloud.dt)
            if slow and now < job.steps:
                wait_for(lambda: job.cloud.step == now + 50)
            states[now] = {name: array.copy() for name, array in checkpoint.arrays.items()}
            return write(checkpoints, checkpoint)

        monkeypatch.setattr(Checkpoints, "write", record)
        execute(job, "startTime")
        found.append(states)
    assert list(found[0]) == list(found[1]) == [50, 100, 150, 200, 250, 300]
    for early, late in zip(found[0].values(), found[1].values(), strict=True):
        assert "functions/f/sumD" in early
        assert early.keys() == late.keys()
        assert all(early[name].tobytes() == late[name].tobytes() for name in early)


def test_a_failed_write_ends_the_run_before_the_next_is_due(case, monkeypatch):
    job = prepare(case, threads=1)
    write, begun, writers = pvd.write_snapshot, [], []
    submit, advance = Writer.submit, Stepper.advance

    def full(path, cloud):
        begun.append(path.name)
        if len(begun) == 3:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        return write(path, cloud)

    def known(writer, work):
        submit(writer, work)
        writers.append(writer)

    def slow(stepper, steps, stop):
        # As more particles would be: on the way to the third write time the second cloud has time to fail.
        advance(stepper, steps, stop)
        if stepper.cloud.step > 100:
            wait_for(lambda: writers[-1]._unfinished.done())

    monkeypatch.setattr(pvd, "write_snapshot", full)
    monkeypatch.setattr(Writer, "submit", known)
    monkeypatch.setattr(Stepper, "advance", slow)
    with pytest.raises(RunStopped, match=r"No space .*softCloud_000002\.vtp'\. To continue .*-resume"):
        execute(job)
    assert begun == ["softCloud_000000.vtp", "softCloud_000001.vtp", "softCloud_000002.vtp"]
    assert 100 <= job.cloud.step < 150
    folder = case / "postProcessing/softCloud"
    assert [entry.time for entry in pvd.read_pvd(folder / "softCloud.pvd")] == [0.0, 0.001]
    assert [f.name for f in (folder / "checkpoint").iterdir()] == ["0.001.npz"]
