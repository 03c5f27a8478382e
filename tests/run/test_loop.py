"""Number of steps per call of a stepper."""

from __future__ import annotations

import logging
import time
from types import SimpleNamespace
from typing import Any, cast

import pytest
from numba.core import event

from foamprb.cloud.state import Status
from foamprb.run import loop
from foamprb.run.compilation import Compilation
from foamprb.run.loop import _Schedule


def calls(wanted: float, target: int, most: float = 1e9, stretch: int = 1, step: int = 0) -> list[int]:
    """Lengths of the calls to a target, of four particles and two that are never made."""
    tracker = SimpleNamespace(stretch_steps=stretch, movable=(Status.PENDING, Status.ACTIVE))
    counts = {Status.PENDING: 3, Status.ACTIVE: 3}
    cloud = SimpleNamespace(step=step, tracker=tracker, counts=lambda: counts, late=2)
    stepper = SimpleNamespace(cloud=cloud)
    schedule, found = _Schedule(cast("Any", stepper), Compilation(), lambda *_: None), []
    schedule._steps = wanted
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loop, "MOST_STEPS", 4 * most)
        while cloud.step < target:
            found.append(schedule._next_steps(target))
            cloud.step += found[-1]
    return found


@pytest.mark.parametrize(
    ("wanted", "lengths"),
    [(97.0, [100]), (103.0, [100]), (45.0, [50, 50]), (30.0, [34, 33, 33]), (1e6, [100]), (0.2, [1] * 100)],
)
def test_calls_to_a_write_time_are_alike(wanted: float, lengths: list[int]) -> None:
    assert calls(wanted, 100) == lengths


def test_no_call_is_longer_than_the_limit() -> None:
    assert calls(50.0, 100, most=40.0) == [40, 30, 30]


def test_calls_end_where_steps_through_several_do() -> None:
    assert calls(30.0, 100, stretch=4) == [36, 32, 32]
    assert calls(0.2, 11, stretch=4) == [4, 4, 3]
    assert calls(5.0, 22, stretch=8, step=3) == [5, 8, 6]


def test_compilation_with_the_first_steps_is_logged(monkeypatch, caplog) -> None:
    def advance(*_: Any) -> None:
        end = time.monotonic() + 5.0
        with event.trigger_event("numba:compile"):
            while not caplog.messages and time.monotonic() < end:
                time.sleep(1e-3)

    monkeypatch.setattr("foamprb.run.compilation._TICK", 1e-3)
    tracker = SimpleNamespace(compiled=False, stretch_steps=1, movable=(Status.ACTIVE,))
    cloud = SimpleNamespace(step=0, tracker=tracker, counts=lambda: {Status.ACTIVE: 1}, late=0)
    stepper = SimpleNamespace(cloud=cloud, advance=advance)
    with caplog.at_level(logging.INFO, "foamprb"):
        _Schedule(cast("Any", stepper), Compilation(), lambda *_: None).advance(1, lambda: False)
    assert caplog.messages[0].startswith("Compiling the formulas, once")
    assert caplog.messages[-1] == "Compiled in 0 s"
