"""Tracing of stages: one execution on symbols gives the code for numbers."""

import inspect
import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import foamprb
from foamprb.body.choice import choice
from foamprb.body.tensor import select
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import LANES
from foamprb.cloud.tracker import Tracker
from foamprb.compile import link as compiling
from foamprb.compile.link import link, linked, traced
from foamprb.compile.record_type import register_records
from foamprb.compile.trace import TRACED, UntraceableError, trace
from foamprb.flow.meshflow import MeshFlow

ROWS = 4
FLAGS = "contract nsz"


@pytest.fixture
def fresh(tmp_path, monkeypatch, caplog):
    """Nothing compiled in this process nor in an earlier one; what is not traced is in the log."""
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(compiling, "_dispatchers", {})
    return caplog


@traced
def everything(block, shift):
    for i in range(LANES):
        x, y = block[i], block[LANES + i]
        quotient = (x - 2.0 * y) / (1.0 + y * y) - 0.0 + (x - y) * (y - x)
        power = (-x) ** 3 + 0.0 * y + (shift[0] - 1 * x) ** 2 / 4
        for n in range(1, 3):
            power = n * power + shift[1]
        size = np.sqrt(abs(quotient)) + math.sqrt(2.0) * np.exp(-np.sqrt(x * x))
        size = size + np.maximum(x, 0.25) * np.minimum(x, y)
        size = size + np.maximum(np.maximum(0.0, abs(x)), np.maximum(abs(y), 0.5)) * np.maximum(abs(x), x)
        between = (x < y) & (y <= 3.0) | (x >= 2.0) & (x != 2.5) | (y == 1.0)
        chosen = select(between, power, 0.0 - size)
        block[2 * LANES + i] = 0.0
        block[2 * LANES + i] = select(x > 2.0, 0.125 * chosen, chosen)
        block[3 * LANES + i] += block[2 * LANES + i] + 1.0


@traced
def everything_at_once(block, shift):
    for i in range(LANES):
        x, y = block[i], block[LANES + i]
        block[2 * LANES + i] = (1.0 - np.sqrt(x)) / y + shift[0]


@traced
def in_two_loops(block, shift):
    factor = shift[0] / shift[1]
    for i in range(LANES):
        block[2 * LANES + i] = factor * block[i]
        block[3 * LANES + i] = factor
    for i in range(LANES):
        block[3 * LANES + i] += block[2 * LANES + i] * factor


@traced
def with_a_branch(block, shift):
    for i in range(LANES):
        if block[i] > shift[0]:
            block[LANES + i] = shift[1]


@choice
def stage(block, shift):
    """Stands for one of those above."""


def entry(block, shift):
    stage(block, shift)


def after(function, block, shift):
    """The block after a plain and after a compiled pass."""
    plain, compiled = block.copy(), block.copy()
    with np.errstate(all="ignore"):
        function(plain, shift)
    link(entry, {stage: function})(compiled, shift)
    return plain.reshape(ROWS, LANES), compiled.reshape(ROWS, LANES)


numbers = st.one_of(
    st.floats(-4.0, 4.0), st.sampled_from([0.0, -0.0, 1.0, 2.0, 2.5, 3.0, np.inf, -np.inf, np.nan])
)


@given(st.lists(numbers, min_size=2 * LANES, max_size=2 * LANES), st.tuples(numbers, numbers))
def test_traced_code_gives_what_the_function_gives(values, shift):
    """In every lane, NaN included; sums of products are rounded in another way."""
    block = np.concatenate([values, np.linspace(-1.0, 1.0, 2 * LANES)])
    plain, compiled = after(everything, block, shift)
    np.testing.assert_allclose(compiled, plain, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("function", "reason"),
    [
        (everything, None),
        (everything_at_once, None),
        (in_two_loops, None),
        (with_a_branch, "it branches on a value"),
    ],
)
def test_stage_that_cannot_be_traced_is_compiled_with_a_warning(function, reason, fresh):
    block = np.linspace(0.5, 2.0, ROWS * LANES)
    plain, compiled = after(function, block, (1.0, -1.0))
    np.testing.assert_allclose(compiled, plain, rtol=1e-14)
    expected = f"The stage {function.__name__} compiles slowly, as it cannot be traced: {reason}"
    assert fresh.messages == ([expected] if reason else [])


def test_stages_of_all_integrators_are_traced(fresh):
    medium = foamprb.Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
    for integrator in INTEGRATORS.values():
        models = foamprb.Models(integrator=integrator.name)
        tracker = Tracker(models, MeshFlow.kernels, medium, [], 1e-3, 0.0, shaped=True, tense=False)
        scratch = tracker._scratch()
        examples = {"block": scratch.block, "M": scratch.matrix, "medium": tracker.medium, "i": np.int64(0)}
        examples |= {"allowed": 1.0, "tolerance": 1.0}
        register_records()
        linkage = compiling._Linkage(tracker.slots)
        stages = [f for f in linked(integrator.track, tracker.slots) if hasattr(f, TRACED)]
        assert len(stages) >= 7
        for stage in stages:
            kinds = tuple(numba.typeof(examples[name]) for name in inspect.signature(stage).parameters)
            compiling._link(stage, linkage, "lanes", stage.__name__).dispatcher.compile(kinds)
    assert fresh.messages == []


def operations(function, *arguments):
    """Lines of the code of a function, each an operation."""
    linked = link(entry, {stage: function}).py_func.__globals__["stage"]

    def symbols(code):
        return [code.block, *(code.argument(k) for k in range(len(arguments)))]

    return trace(linked.py_func, LANES, FLAGS, symbols).function("f").splitlines()


def twice_the_same(block):
    for i in range(LANES):
        x, y = block[i], block[LANES + i]
        block[i] = 0.0
        block[LANES + i] = (x + y) / (x * y) + np.sqrt(x * y)
        block[i] = (y + x) / (y * x) - np.sqrt(x * y)


def test_equal_operations_are_written_once_and_what_is_overwritten_never():
    text = "\n".join(operations(twice_the_same))
    for name, count in (("fdiv", 1), ("fadd", 2), ("fmul", 1), ("fsub", 1), ("call", 1), ("load", 2)):
        assert text.count(f"= {name} ") == count, name
    assert text.count("store ") == 2


def not_a_row(block):
    for i in range(LANES):
        block[3 + i] = 1.0


def whole_numbers(block):
    for i in range(LANES):
        block[i] = float(i)


def any_power(block):
    for i in range(LANES):
        block[i] = block[i] ** 0.5


def no_lanes(block):
    block[0] = 1.0


def with_a_sum(block):
    total = 0.0
    for i in range(LANES):
        total += block[i]
    for i in range(LANES):
        block[i] -= total / LANES


def with_a_left_over(block):
    last = 0.0
    for i in range(LANES):
        last = block[i]
    for i in range(LANES):
        block[i] = last


def with_a_count(block):
    n = 0
    for _ in range(LANES):
        n += 1
    for i in range(LANES):
        block[i] = block[i] / n


def with_places(block):
    n = 0.0
    for i in range(LANES):
        n += 1.0
        block[i] = n


def with_the_last_lane(block):
    for i in range(LANES):
        block[i] += 1.0
    block[LANES + i] = 1.0


def with_a_result(block):
    for i in range(LANES):
        block[i] += 1.0
    return 1.0


def test_function_that_is_not_a_stage_is_rejected():
    functions = [
        not_a_row,
        whole_numbers,
        any_power,
        no_lanes,
        with_a_branch,
        with_a_sum,
        with_a_left_over,
        with_a_count,
        with_places,
        with_the_last_lane,
        with_a_result,
    ]
    for function in functions:
        with pytest.raises(UntraceableError):
            operations(function, *(["shift"] if function is with_a_branch else []))
