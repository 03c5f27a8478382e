"""Distributions of size and stiffness against the distributions' own formulas."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from scipy.integrate import quad

from foamprb.cloud.injection.distribution import (
    FixedValue,
    General,
    Normal,
    RosinRammler,
    Scaled,
    Uniform,
    draw,
)
from foamprb.errors import InputError

NORMAL = Normal(minValue=2e-6, maxValue=12e-6, expectation=5e-6, variance=3e-6)
ROSIN = RosinRammler(minValue=2e-6, maxValue=12e-6, d=5e-6, n=2.5)
UNIFORM = Uniform(minValue=2e-6, maxValue=12e-6)
GENERAL = General(((2e-6, 1.0), (4e-6, 3.0), (5e-6, 0.0), (6e-6, 0.0), (9e-6, 7.0)))


def normal_density(x):
    return np.exp(-(((x - 5e-6) / 3e-6) ** 2))


def rosin_density(x):
    s = (x - 2e-6) / 5e-6
    return 2.5 / 5e-6 * s**1.5 * np.exp(-(s**2.5))


def uniform_density(x):
    return 1.0


def general_density(x):
    return np.interp(x, *np.transpose(GENERAL.distribution))


CASES = [
    (NORMAL, normal_density),
    (ROSIN, rosin_density),
    (UNIFORM, uniform_density),
    (GENERAL, general_density),
]
NAMES = ["normal", "RosinRammler", "uniform", "general"]
EACH = pytest.mark.parametrize("distribution", [case[0] for case in CASES], ids=NAMES)


def test_extreme_numbers_give_values_between_the_limits():
    """The exponential of a large power, and the square of a small density, are no numbers."""
    share = np.linspace(0.0, 1.0, 11)
    rosin = RosinRammler(minValue=1e-6, maxValue=9.1e-5, d=1e-6, n=400.0)
    # The values lie close to d.
    np.testing.assert_allclose(rosin.quantile(share)[1:-1], 2e-6, rtol=0.01)
    small = General(((1.0, 1e-200), (2.0, 1e-200)))
    np.testing.assert_allclose(small.quantile(share), 1.0 + share)


def integral(density, a, b):
    kinks = [x for x in (4e-6, 5e-6, 6e-6) if a < x < b]
    value, _ = quad(density, a, b, points=kinks or None, epsabs=0.0, epsrel=1e-12)
    return value


@pytest.mark.parametrize(("distribution", "density"), CASES, ids=NAMES)
def test_quantile_inverts_the_integral_of_the_density(distribution, density):
    low, high = distribution.limits
    total = integral(density, low, high)
    shares = np.array([1e-6, 0.01, 0.2, 0.5, 0.77, 0.99, 1.0 - 1e-6])
    values = distribution.quantile(shares)
    found = [integral(density, low, x) / total for x in values]
    np.testing.assert_allclose(found, shares, rtol=1e-8)


@EACH
def test_the_ends_are_the_limits(distribution):
    # Where the density vanishes at an end, round-off in the share opens up in the value.
    ends = distribution.quantile(np.array([0.0, 1.0]))
    np.testing.assert_allclose(ends, distribution.limits, rtol=1e-7)


@EACH
def test_samples_are_quantiles_at_even_shares_and_those_of_a_seed_the_same_again(distribution):
    first, again = (draw(distribution, 50, np.random.default_rng(3)) for _ in range(2))
    np.testing.assert_array_equal(first, again)
    np.testing.assert_array_equal(first, distribution.quantile(np.random.default_rng(3).random(50)))


def test_normal_is_scipys_with_openfoams_width():
    a, b = (np.array([2e-6, 12e-6]) - 5e-6) / (3e-6 / np.sqrt(2.0))
    expected = stats.truncnorm(a, b, loc=5e-6, scale=3e-6 / np.sqrt(2.0))
    shares = np.linspace(0.0, 1.0, 101)
    np.testing.assert_allclose(NORMAL.quantile(shares), expected.ppf(shares), rtol=1e-12)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_normal_keeps_its_digits_far_out(side):
    """Between 20 and 21 standard deviations only a sliver is left, close to an exponential."""
    width = np.sqrt(2.0)
    low, high = sorted((100.0 + side * 20.0, 100.0 + side * 21.0))
    distribution = Normal(minValue=low, maxValue=high, expectation=100.0, variance=width)
    x = distribution.quantile(np.linspace(0.05, 0.95, 10))
    expected = 100.0 + side * stats.truncnorm(20.0, 21.0).ppf(
        np.linspace(0.05, 0.95, 10) if side > 0 else np.linspace(0.95, 0.05, 10)
    )
    np.testing.assert_allclose(x, expected, rtol=1e-10)


@given(
    st.lists(st.tuples(st.floats(0.01, 10.0), st.floats(0.0, 5.0)), min_size=2, max_size=8),
    st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20),
)
def test_general_inverts_its_integral(pieces, shares):
    x = np.cumsum([length for length, _ in pieces])
    w = np.array([weight if weight > 1e-6 else 0.0 for _, weight in pieces])
    if not w.any():
        return
    values = General(tuple(zip(x, w, strict=True))).quantile(np.array(shares))

    def below(v):
        inside = x[x < v]
        nodes, heights = np.append(inside, v), np.append(w[x < v], np.interp(v, x, w))
        return np.sum(0.5 * np.diff(nodes) * (heights[1:] + heights[:-1]))

    total = below(x[-1])
    np.testing.assert_allclose([below(v) / total for v in values], shares, atol=1e-9)


def test_what_follows_from_a_distributed_quantity():
    """Ca with a spread gives shear moduli c/Ca; shares count from below all the same."""
    base = Uniform(minValue=0.25, maxValue=1.0)
    mu = Scaled(base, factor=2.0, power=-1)
    assert mu.limits == (2.0, 8.0)
    shares = np.linspace(0.0, 1.0, 7)
    np.testing.assert_allclose(mu.quantile(shares), 2.0 / base.quantile(1.0 - shares), rtol=1e-15)
    assert (np.diff(mu.quantile(shares)) > 0.0).all()
    young = Scaled(base, factor=3.0)
    np.testing.assert_allclose(young.quantile(shares), 3.0 * base.quantile(shares), rtol=1e-15)


def test_what_is_beyond_all_numbers_is_infinite():
    """Particles made of it are refused by a message, which names how many they are."""
    mu = Scaled(Uniform(minValue=1e-320, maxValue=1.0), factor=2.0, power=-1)
    assert mu.limits == (2.0, np.inf)
    np.testing.assert_array_equal(mu.quantile(np.array([0.0, 1.0])), [2.0, np.inf])


def test_a_number_is_the_same_for_all():
    random = np.random.default_rng(0)
    np.testing.assert_array_equal(draw(4.0, 3, random), [4.0, 4.0, 4.0])
    np.testing.assert_array_equal(draw(FixedValue(5.0), 2, random), [5.0, 5.0])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Uniform(minValue=2.0, maxValue=2.0), "minValue 2, which is not below maxValue 2"),
        (lambda: RosinRammler(minValue=3.0, maxValue=2.0, d=1.0, n=1.0), "not below"),
        (lambda: Normal(minValue=50.0, maxValue=51.0, expectation=0.0, variance=1.0), "no values remain"),
        (lambda: General(((1.0, 1.0),)), "two pairs"),
        (lambda: General(()), "two pairs"),
        (lambda: General(((1.0, 1.0), (1.0, 2.0))), "increasing"),
        (lambda: General(((1.0, -1.0), (2.0, 2.0))), "negative"),
        (lambda: General(((1.0, 0.0), (2.0, 0.0))), "zero throughout"),
    ],
)
def test_what_cannot_be_a_distribution(make, message):
    with pytest.raises(InputError, match=message):
        make()
