"""Operations per particle-step, counted; and the processor's peak, by a kernel of fused multiply-adds."""

from __future__ import annotations

import collections
import math
import time
from typing import Any, ClassVar

import numba
import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.profile import STAGES, blocks_of
from benchmarks.records import KILO, Options, Row, rows
from benchmarks.tracker import STEP
from foamprb.cloud.layout import LANES
from foamprb.cloud.tracker import Models

COUNTED = ("add", "multiply", "divide", "sqrt")
_CHAINS, _LENGTH = 4, 8


class Counting:
    """A number that counts what is done with it; comparisons and changes of sign are free."""

    # Numbers of numpy leave the operation to this class.
    __array_priority__ = 1000.0
    done: ClassVar[collections.Counter[str]] = collections.Counter()
    __slots__ = ("value",)

    def __init__(self, value: float) -> None:
        self.value = value

    def _make(self, kind: str, value: float) -> Counting:
        Counting.done[kind] += 1
        return Counting(value)

    def __add__(self, other: Any) -> Counting:
        return self._make("add", self.value + float(other))

    def __sub__(self, other: Any) -> Counting:
        return self._make("add", self.value - float(other))

    def __rsub__(self, other: Any) -> Counting:
        return self._make("add", float(other) - self.value)

    def __mul__(self, other: Any) -> Counting:
        return self._make("multiply", self.value * float(other))

    def __truediv__(self, other: Any) -> Counting:
        return self._make("divide", self.value / float(other))

    def __rtruediv__(self, other: Any) -> Counting:
        return self._make("divide", float(other) / self.value)

    __radd__, __rmul__ = __add__, __mul__

    def sqrt(self) -> Counting:
        """Count a square root called by ``np.sqrt``."""
        return self._make("sqrt", math.sqrt(self.value))

    def __neg__(self) -> Counting:
        return Counting(-self.value)

    def __abs__(self) -> Counting:
        return Counting(abs(self.value))

    def __float__(self) -> float:
        return self.value

    def __lt__(self, other: Any) -> bool:
        return self.value < float(other)

    def __le__(self, other: Any) -> bool:
        return self.value <= float(other)

    def __gt__(self, other: Any) -> bool:
        return self.value > float(other)

    def __ge__(self, other: Any) -> bool:
        return self.value >= float(other)


def operations(stage: Any, numbers: Any, medium: Any) -> collections.Counter[str]:
    """Count the operations of one lane in a stage, by kind, by running its text on counting numbers."""
    Counting.done.clear()
    arguments = {"": (), "medium": (medium,), "judging": (medium, Models().tolerance)}
    stage.function(numbers, *arguments[stage.takes])
    return collections.Counter({kind: n / LANES for kind, n in Counting.done.items()})


@numba.njit(fastmath={"contract"})
def _multiply_add(data: Any, b: float, c: float, times: int) -> None:
    for _ in range(times):
        for i in range(data.shape[0] // _CHAINS):
            # Independent chains, or each would wait for its own last result.
            x, y, z, w = data[4 * i], data[4 * i + 1], data[4 * i + 2], data[4 * i + 3]
            for _ in range(_LENGTH):
                x, y, z, w = x * b + c, y * b + c, z * b + c, w * b + c
                x, y, z, w = x * b + c, y * b + c, z * b + c, w * b + c
            data[4 * i], data[4 * i + 1], data[4 * i + 2], data[4 * i + 3] = x, y, z, w


def peak(repeats: int) -> float:
    """Return the peak rate of additions and multiplications of a compiled loop on one core."""
    data, times = np.full(1024, 0.5), 20_000
    _multiply_add(data, 0.5, 0.25, 1)
    best = math.inf
    for _ in range(repeats):
        start = time.process_time()
        _multiply_add(data, 0.5, 0.25, times)
        best = min(best, time.process_time() - start)
    return 2.0 * 2.0 * _LENGTH * data.size * times / best


def operations_by_stage(integrator: str) -> dict[str, collections.Counter[str]]:
    """Return the operations of a particle-step in the stages of an integrator, by kind."""
    flow = foamprb.analytic.pipe(pipe.RADIUS, pipe.MEAN, pipe.LENGTH)
    cloud = pipe.soft_cloud(flow, LANES, STEP[integrator], integrator)
    cloud.advance(20)
    ((_, data),) = blocks_of(cloud, 1)
    numbers = np.array([Counting(float(x)) for x in data], dtype=object)
    found = {}
    for name, stage in STAGES[integrator].items():
        counts = operations(stage, numbers, cloud.tracker.medium)
        found[name] = collections.Counter({kind: stage.times * counts[kind] for kind in COUNTED})
    return found


def measure(options: Options) -> list[Row]:
    """Measure operations of each stage and of all stages, and the peak."""
    found = []
    for integrator in STAGES:
        counts = operations_by_stage(integrator)
        by_stage = {name: count.total() for name, count in counts.items()}
        total = {kind: sum(count[kind] for count in counts.values()) for kind in COUNTED}
        found += rows("roofline", f"operations of {integrator}", by_stage, "per particle-step")
        found += rows("roofline", f"of these, {integrator}", total, "per particle-step")
    best = peak(3 if options.quick else 15) / KILO**3
    found += rows("roofline", "peak of one core", {"fused multiply-add": best}, "GFLOP/s")
    return found
