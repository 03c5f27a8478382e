"""Functions behind slots: callers are compiled once, whatever is behind them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from foamprb.compile import link as linking
from foamprb.compile.link import kernel, link, packed, separate, slot
from foamprb.compile.record import record


@slot
def model(x):
    """The default."""
    return x


@slot
def another(x):
    """The default of another slot."""
    return -x


@separate
def caller(x):
    return model(x) + 10.0 * another(x)


def entry(x):
    return caller(x)


def doubled(x):
    return 2.0 * x


def tripled(x):
    return 3.0 * x


def rounded(x):
    """With another type than the others return."""
    return int(x)


@pytest.fixture
def fresh(tmp_path, monkeypatch):
    """Do as if another process began, with an empty cache at first."""
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(linking, "_dispatchers", {})
    return lambda: monkeypatch.setattr(linking, "_dispatchers", {})


def hits_of(name):
    """Number of times that a function was loaded from the cache, and that it was compiled."""
    (code,) = (d for d in linking._dispatchers.values() if d.py_func.__name__ == name)
    return sum(code.stats.cache_hits.values()), sum(code.stats.cache_misses.values())


def test_callers_serve_for_every_function_behind_a_slot(fresh):
    expected = [({}, -9.0), ({model: doubled}, -8.0), ({another: tripled}, 31.0)]
    expected += [({model: doubled, another: tripled}, 32.0)]
    for n, (slots, result) in enumerate(expected):
        f = link(entry, slots=slots)
        assert f(1.0) == result
        assert hits_of("caller") == ((1, 0) if n else (0, 1))
        assert sum(f.stats.cache_hits.values()) == (1 if n else 0)
        fresh()


def test_slots_with_the_same_function_are_told_apart(fresh):
    """In both orders: the code for one function behind both serves for two, and the reverse."""
    choices = [({model: doubled, another: doubled}, 22.0), ({model: doubled, another: tripled}, 32.0)]
    for n, (slots, result) in enumerate((*choices, *choices)):
        assert link(entry, slots=slots)(1.0) == result
        assert hits_of("caller") == ((1, 0) if n else (0, 1))
        fresh()


def test_loops_of_one_process_have_their_own_functions(fresh):
    loops = [link(entry, slots={model: f}) for f in (doubled, tripled)]
    assert [f(1.0) for f in loops] == [-8.0, -7.0]


def test_function_with_another_type_of_result_leads_to_another_compilation(fresh):
    """The code of the caller takes a float, and would misread the bits of an integer."""
    for function in (doubled, rounded, doubled):
        assert link(entry, slots={model: function})(1.5) == function(1.5) - 15.0
        fresh()


def none(_x):
    """A constant, whose type numba tells from that of a number."""
    return 0


def test_a_function_that_returns_a_constant_leads_to_no_other_compilation(fresh):
    for n, function in enumerate((rounded, none, rounded)):
        assert link(entry, slots={model: function})(1.5) == function(1.5) - 15.0
        assert hits_of("caller") == ((1, 0) if n else (0, 1))
        fresh()


# ---------------------------------------------------------------------------------------------------------
# Packed arguments


@record
class Inner(NamedTuple):
    table: Any
    count: int


@record
class Outer(NamedTuple):
    inner: Inner
    numbers: Any
    scale: float
    limits: tuple[float, int]


class Pair(NamedTuple):
    first: Any
    second: float


@kernel
def value(_given: Any, x: float, y: float) -> float:
    """The default, which reads nothing."""
    return x + y


@separate
def calls_kernel(given, x, y):
    return value(given, x, y)


def outermost(given, x, y):
    return calls_kernel(given, x, y)


def of_record(given, x, y):
    table = given.inner.table
    total = given.scale * x + y + given.inner.count + given.limits[0] * given.limits[1]
    for i in range(table.shape[0]):
        for j in range(table.shape[1]):
            total += table[i, j] * given.numbers[j]
    return total


def of_pair(given, y):
    """Without a parameter that it does not need."""
    return given.first[1] + given.second * y


def of_nested(given, x, y):
    (a, b), c, n = given
    return a[0] * x + b[1, 0] * y + c.real * c.imag + n


def of_nothing(_given, x):
    return 7.0 * x


TABLE = np.arange(6.0).reshape(2, 3)
ARGUMENTS = [
    (of_record, Outer(Inner(TABLE, 3), np.arange(3, dtype=np.int32), 0.5, (1.5, 2))),
    (of_record, Outer(Inner(TABLE.T[::2], 3), np.arange(6)[::2], 0.5, (1.5, 2))),
    (of_pair, Pair(np.arange(3.0), 2.5)),
    (of_pair, Pair(np.arange(6, dtype=np.float32)[::3], 2.5)),
    (of_nested, ((np.arange(2.0), TABLE), 2.0 - 3.0j, 5)),
    (of_nothing, ()),
    (of_nothing, Inner(TABLE, 1)),
]
ALL = {"x": 2.0, "y": 3.0}


def called_plainly(function, argument):
    names = function.__code__.co_varnames[1 : function.__code__.co_argcount]
    return function(argument, *(ALL[name] for name in names))


def test_loops_are_not_compiled_again_for_another_packed_argument(fresh):
    for n, (function, argument) in enumerate(ARGUMENTS):
        given = packed(argument)
        f = link(outermost, slots={value: function}, given=given.layout)
        assert f(given, 2.0, 3.0) == called_plainly(function, argument)
        assert sum(f.stats.cache_hits.values()) == (1 if n else 0)
        fresh()


def test_default_of_a_kernel_needs_no_layout():
    assert link(outermost)(packed(()), 2.0, 3.0) == 5.0


@pytest.mark.parametrize(
    "argument", [(True,), Pair(np.arange(2.0), np.True_), Inner(TABLE, np.int8(1)), ("a",)]
)
def test_items_of_other_types_are_an_error(argument):
    with pytest.raises(TypeError, match="which no kernel takes by address"):
        packed(argument)
