from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from foamprb.body.philox import normals, philox, uniform
from foamprb.compile.link import link

KNOWN = [
    (
        (0x00000000, 0x00000000, 0x00000000, 0x00000000), (0x00000000, 0x00000000),
        (0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8),
    ),
    (
        (0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF), (0xFFFFFFFF, 0xFFFFFFFF),
        (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD),
    ),
    (
        (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344), (0xA4093822, 0x299F31D0),
        (0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
    ),
]  # fmt: skip
"""Counter, key and answer, of the tests that Random123 publishes (kat_vectors)."""


def words(*values):
    return tuple(np.uint64(v) for v in values)


@pytest.mark.parametrize(("counter", "key", "expected"), KNOWN)
def test_known_answers(counter, key, expected):
    assert philox(words(*counter), words(*key)) == expected


def test_arrays_and_compiled_code_give_the_same():
    n = 1000
    rng = np.random.default_rng(0)
    counter, key = rng.integers(0, 2**32, (4, n), dtype=np.uint64), rng.integers(0, 2**32, 2, dtype=np.uint64)
    found = np.array(philox(tuple(counter), tuple(key)))
    for i in (0, 1, n - 1):
        assert philox(words(*counter[:, i]), tuple(key)) == tuple(found[:, i])
    compiled = np.empty((4, n), dtype=np.uint64)
    deviates = np.empty((4, n))
    link(fill)(counter, key, compiled, deviates)
    np.testing.assert_array_equal(compiled, found)
    np.testing.assert_allclose(deviates, normals(tuple(found)), atol=1e-13)


def fill(counter, key, found, deviates):
    for i in range(counter.shape[1]):
        four = philox((counter[0, i], counter[1, i], counter[2, i], counter[3, i]), (key[0], key[1]))
        found[0, i], found[1, i], found[2, i], found[3, i] = four
        deviates[0, i], deviates[1, i], deviates[2, i], deviates[3, i] = normals(four)


def test_uniform_numbers_lie_inside_the_unit_interval():
    assert 0.0 < uniform(np.uint64(0)) < 2e-10
    assert 1.0 - 2e-10 < uniform(np.uint64(2**32 - 1)) < 1.0


def test_normal_deviates_are_those_of_box_and_muller():
    """To 1e-13, at the ends of the interval too."""
    ends = np.array([0, 1, 2**31, 2**32 - 2, 2**32 - 1], dtype=np.uint64)
    rng = np.random.default_rng(1)
    grid = np.concatenate([ends, rng.integers(0, 2**32, 2000, dtype=np.uint64)])
    first, second = grid, rng.permutation(grid)
    found = normals((first, second, second, first))
    for (a, b), (p, q) in (((found[0], found[1]), (first, second)), ((found[2], found[3]), (second, first))):
        size, angle = np.sqrt(-2.0 * np.log(uniform(p))), np.pi * (2.0 * uniform(q) - 1.0)
        np.testing.assert_allclose(a, size * np.cos(angle), atol=1e-13, rtol=1e-4)
        np.testing.assert_allclose(b, size * np.sin(angle), atol=1e-13, rtol=1e-4)


def test_normal_deviates_are_normal_and_independent():
    n = 200_000
    i = np.arange(n, dtype=np.uint64)
    zero = np.zeros_like(i)
    x = np.array(normals(philox((i, zero, zero, zero), words(7, 1))))
    for row in x:
        assert stats.kstest(row, "norm").pvalue > 1e-3
    assert abs(np.cov(x) - np.eye(4)).max() < 5.0 * np.sqrt(2.0 / n)
    squares = np.corrcoef(x**2)
    assert abs(squares - np.eye(4)).max() < 5.0 / np.sqrt(n)
    # Of neighbouring counters.
    assert abs(np.mean(x[:, 1:] * x[:, :-1], axis=1)).max() < 5.0 / np.sqrt(n)
