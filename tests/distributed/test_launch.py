"""Start and end of the processes of a parallel run."""

from __future__ import annotations

import os
import signal
import threading
from dataclasses import fields

import pytest

from foamprb.cloud.cloud import Cloud
from foamprb.distributed import launch
from foamprb.distributed.launch import caught_signals
from foamprb.distributed.ranks import Ranks
from foamprb.errors import RunStopped


def test_default_threads_are_the_processors_of_the_process():
    (default,) = (field.default_factory for field in fields(Cloud) if field.name == "threads")
    assert default() == len(os.sched_getaffinity(0))


class Dismissed(Ranks):
    """Ranks that only note with which exit status they are sent home."""

    def __init__(self) -> None:
        self.status: list[int] = []

    def dismiss(self, status: int) -> None:
        self.status.append(status)


def stopped(_):
    raise RunStopped("the disk is full")


@pytest.mark.parametrize(
    ("lead", "status", "error"), [(lambda _: 0, 0, None), (lambda _: 3, 3, None), (stopped, 1, RunStopped)]
)
def test_the_others_leave_with_the_exit_status_of_the_first(lead, status, error, monkeypatch):
    ranks = Dismissed()
    monkeypatch.setattr(launch, "connect", lambda: ranks)
    if error is None:
        assert launch.run_together(lead) == status
    else:
        with pytest.raises(error):
            launch.run_together(lead)
    assert ranks.status == [status]


def test_a_process_that_is_alone_leads_nobody(monkeypatch):
    monkeypatch.setattr(launch, "connect", lambda: None)
    assert launch.run_together(lambda ranks: 0 if ranks is None else 1) == 0


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_first_signal_is_caught_and_the_second_acts(number):
    before = {n: signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM)}
    received = []
    signal.signal(number, lambda n, _: received.append(n))
    try:
        with caught_signals() as caught:
            assert caught == []
            signal.raise_signal(number)
            assert (caught, received) == ([number], [])
            signal.raise_signal(number)
            assert (caught, received) == ([number], [number])
    finally:
        after = signal.signal(number, before[number])
    assert after is not before[number]
    assert {n: signal.getsignal(n) for n in before} == before


def test_another_thread_catches_nothing():
    caught_there: list[list[int]] = []

    def run() -> None:
        before = signal.getsignal(signal.SIGINT)
        with caught_signals() as caught:
            assert signal.getsignal(signal.SIGINT) is before
            caught_there.append(caught)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert caught_there == [[]]
