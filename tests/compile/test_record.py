"""Named tuples that compiled functions take by address."""

from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foamprb.compile.link import link
from foamprb.compile.record import record


@record
class Inner(NamedTuple):
    table: Any
    count: int


@record
class Outer(NamedTuple):
    inner: Inner
    numbers: Any
    weights: Any
    scale: float
    limits: tuple[float, float]


def measure(given: Outer, out: Any) -> None:
    """Write what the items hold, read through two levels."""
    table = given.inner.table
    total = 0.0
    for i in range(table.shape[0]):
        for j in range(table.shape[1]):
            total += table[i, j] * given.scale
    out[0], out[1], out[2] = total, given.inner.count, table.size
    out[3], out[4] = len(given.numbers), given.limits[1]
    given.numbers[0] = 7
    out[5], out[6] = given.numbers[0], given.weights[1]


def outer(table: Any, weights: Any) -> Outer:
    return Outer(Inner(table, 3), np.zeros(4, dtype=np.int32), weights, 0.5, (1.0, 2.0))


@given(st.integers(0, 5), st.integers(1, 20))
def test_compiled_code_reads_what_python_reads(rows: int, columns: int) -> None:
    table = np.arange(rows * columns, dtype=float).reshape(rows, columns)
    compiled, plain = np.empty(7), np.empty(7)
    link(measure)(outer(table, np.array([1.0, 2.0])), compiled)
    measure(outer(table, np.array([1.0, 2.0])), plain)
    np.testing.assert_array_equal(compiled, plain)


def test_arrays_with_gaps_between_numbers_are_read() -> None:
    out = np.empty(7)
    link(measure)(outer(np.ones((2, 2)), np.arange(6.0)[::3]), out)
    assert out[6] == 3.0


def test_records_of_other_types_are_compiled_again() -> None:
    out = np.empty(7)
    link(measure)(outer(np.ones((2, 2), dtype=np.float32), np.ones(2)), out)
    assert out[0] == 2.0


def test_an_unknown_item_is_an_error() -> None:
    def wrong(given: Outer, out: Any) -> None:
        out[0] = given.lenght

    with pytest.raises(numba.TypingError, match="lenght"):
        link(wrong)(outer(np.ones((1, 1)), np.ones(2)), np.empty(7))
