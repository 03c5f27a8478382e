"""Intervals of shares, quantiles and differences."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.stats import binomtest

from foamprb.results.intervals import difference, pair_correlation, quantile, share


@pytest.mark.parametrize(("count", "total"), [(0, 10), (3, 1000), (20, 60), (60, 60)])
def test_share_has_wilsons_interval(count, total):
    ends = binomtest(count, total).proportion_ci(method="wilson")
    assert share(count, total) == pytest.approx((count / total, ends.low, ends.high), rel=1e-12)


def test_share_of_no_particles_is_unknown():
    assert all(map(math.isnan, share(0, 0)))


def test_ends_of_the_median_are_order_statistics():
    """The 6th and the 15th of 20 values hold the median in 95.9 % of all samples, the next two in 88.5 %."""
    values = np.random.default_rng(0).permutation([*np.arange(1.0, 21.0), np.nan])
    assert quantile(values) == (10.5, 6.0, 15.0)
    few = quantile(np.arange(5.0))
    assert few.value == 2.0
    assert math.isnan(few.low)
    assert all(map(math.isnan, quantile([np.nan])))


def test_difference_of_shares_is_that_of_newcombe():
    """56 of 70 less 48 of 80, Newcombe (1998), table II, method 10."""
    assert difference(share(56, 70), share(48, 80)) == pytest.approx((0.2, 0.0524, 0.3339), abs=5e-5)


def test_intervals_of_differences_hold_the_true_ones():
    """Of pairs in 95 % of the clouds, where these of independent clouds would be twice as wide."""
    random, held, widths = np.random.default_rng(1), [], []
    p, n = np.array([0.4, 0.12, 0.05, 0.43]), 300
    for _ in range(1500):
        k = random.choice(4, n, p=p)
        a, b = k <= 1, (k == 0) | (k == 2)
        shares = share(int(a.sum()), n), share(int(b.sum()), n)
        pairs, apart = difference(*shares, pair_correlation(a, b)), difference(*shares)
        held.append(pairs.low <= p[1] - p[2] <= pairs.high)
        widths.append((pairs.high - pairs.low) / (apart.high - apart.low))
    assert np.mean(held) == pytest.approx(0.95, abs=0.02)
    assert np.mean(widths) == pytest.approx(math.sqrt((0.17 - 0.07**2) / 0.4971), rel=0.05)


def test_same_particles_with_the_same_fates_do_not_differ():
    a = np.arange(100) < 30
    same = share(30, 100)
    assert difference(same, same, pair_correlation(a, a)) == pytest.approx((0.0, -0.0, 0.0), abs=0.02)
    assert pair_correlation(a, ~np.zeros(100, dtype=bool)) == 0.0
