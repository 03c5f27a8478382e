"""Where memory runs out, a run ends in one message."""

from __future__ import annotations

import pytest
from pipe_case import short_case

from foamprb import memory, prepare
from foamprb.errors import InputError, RunStopped
from foamprb.run.results import open_results


def test_message_names_the_available_memory(monkeypatch):
    monkeypatch.setattr(memory, "memory", lambda: 2e9)
    assert str(memory.ran_out(MemoryError())) == "not enough memory; 2 GB are available."


def test_only_memory_errors_are_reported_as_such():
    assert memory.ran_out(ValueError("no")) is None
    assert memory.ran_out(OSError(28, "No space left on device")) is None
    assert memory.ran_out(OSError(12, "Cannot allocate memory")) is not None
    after = ValueError("after it")
    after.__context__ = MemoryError()
    assert memory.ran_out(after) is not None


def test_the_writers_thread_ends_a_run_with_a_message(tmp_path):
    def fail():
        raise MemoryError

    job = prepare(short_case(tmp_path), threads=1)
    with pytest.raises(RunStopped, match="not enough memory; "), open_results(job) as results:
        results._writer.submit(fail)
    with pytest.raises(InputError, match="as it is"), open_results(job):
        raise InputError("as it is")
