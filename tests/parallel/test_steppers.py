"""Steppers that advance a cloud, and the end of the processes of a parallel run."""

from __future__ import annotations

import os
import signal
import threading
from dataclasses import fields

import numpy as np
import pytest
from small_clouds import pipe_cloud

from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.state import Particles
from foamprb.cloud.tracker import never
from foamprb.errors import RunStopped
from foamprb.parallel import launch
from foamprb.parallel.launch import caught_signals
from foamprb.parallel.ranks import Ranks


class Apart(Stepper):
    """Advances copies of the particles, as a stepper with memory of its own does."""

    def __init__(self, cloud: Cloud) -> None:
        super().__init__(cloud)
        self.own = Particles(*(array.copy() for array in cloud.particles))

    def _carry(self, flow, steps, stop=never):
        cloud = self.cloud
        return cloud.tracker.advance(flow, self.own, cloud.step, steps, cloud.threads, cloud.bounds, stop)

    def counts(self):
        return self.own.counts()

    def gather(self):
        for array, own in zip(self.cloud.particles, self.own, strict=True):
            array[:] = own


def test_steppers_with_and_without_own_memory_agree():
    alone, handed = pipe_cloud("paper"), pipe_cloud("paper")
    alone.advance(12)
    for kind, steps in ((Apart, 3), (Stepper, 4), (Apart, 5)):
        stepper = kind(handed)
        stepper.advance(steps)
        if steps == 5:
            assert stepper.counts() == alone.particles.counts()
            assert handed.particles.t[0] < alone.particles.t[0]
        stepper.gather()
    for array, expected in zip(handed.particles, alone.particles, strict=True):
        np.testing.assert_array_equal(array, expected)


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
