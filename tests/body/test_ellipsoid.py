from __future__ import annotations

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from scipy.special import binom, elliprd, elliprf
from strategies import flat, rotations, stretches

from foamprb.body.ellipsoid import _reciprocal_root, _ring_tail, _tails, integrals, reach

SHAPES = [
    (1.0, 1.0, 1.0),
    (1.0, 1.0 + 1e-15, 1.0 - 1e-15),
    (1.0 + 1e-8, 1.0, 1.0 - 1e-8),
    (1.001, 1.0, 0.999),
    (2.0, 1.0, 1.0),
    (2.0, 2.0, 1.0),
    (3.0, 2.0, 1.0),
    (1000.0, 1.0, 1.0),
    (1000.0, 1000.0, 1.0),
    (1000.0, 30.0, 1.0),
    (1000.0, 1.0 + 1e-12, 1.0),
]


def as_dict(a, b, c):
    g = integrals((a, b, c))
    values = (*g.alpha, *g.ring, *g.star, g.chi)
    names = [x + kind for kind in ("0", "ring", "star") for x in ("alpha", "beta", "gamma")]
    return dict(zip([*names, "chi"], values, strict=True))


def by_quadrature(a, b, c):
    """The defining integrals with λ = g²(1−s²)/s², g³ = abc, which is smooth in s, to 20 digits."""
    mpmath.mp.dps = 24
    x, y, z = (mpmath.mpf(float(v)) ** 2 for v in (a, b, c))
    g2 = mpmath.cbrt(x * y * z)

    def integral(weight):
        def f(s):
            lam = g2 * (1 - s * s) / (s * s)
            delta = mpmath.sqrt((x + lam) * (y + lam) * (z + lam))
            return weight(lam) / delta * 2 * g2 / s**3

        # The integrand varies over the decades between the axes.
        scales = [v * 10**k for v in (x, y, z) for k in (-2, -1, 0, 1, 2)]
        knots = sorted({0, 1, *(mpmath.sqrt(g2 / (g2 + scale)) for scale in scales)})
        return mpmath.quad(f, knots)

    return {
        "alpha0": integral(lambda lam: 1 / (x + lam)),
        "beta0": integral(lambda lam: 1 / (y + lam)),
        "gamma0": integral(lambda lam: 1 / (z + lam)),
        "alpharing": integral(lambda lam: 1 / ((y + lam) * (z + lam))),
        "betaring": integral(lambda lam: 1 / ((z + lam) * (x + lam))),
        "gammaring": integral(lambda lam: 1 / ((x + lam) * (y + lam))),
        "alphastar": integral(lambda lam: lam / ((y + lam) * (z + lam))),
        "betastar": integral(lambda lam: lam / ((z + lam) * (x + lam))),
        "gammastar": integral(lambda lam: lam / ((x + lam) * (y + lam))),
        "chi": integral(lambda _: 1),
    }


@pytest.mark.parametrize("shape", SHAPES)
def test_integrals_equal_quadrature_to_twelve_digits(shape):
    expected = by_quadrature(*shape)
    for name, value in as_dict(*shape).items():
        assert abs(mpmath.mpf(float(value)) / expected[name] - 1) < 1e-12, name


def ring(x, y, z):
    """∫dλ/((y+λ)(z+λ)Δ) of squared semi-axes, as a divided difference, to 30 digits."""
    mpmath.mp.dps = 60
    x, y, z = map(mpmath.mpf, (x, y, z))
    return mpmath.mpf(2) / 3 * (mpmath.elliprd(x, y, z) - mpmath.elliprd(x, z, y)) / (y - z)


@pytest.mark.parametrize("ratio", [-3.0, -0.7, 0.0, 0.5, 2.0])
def test_the_series_at_nearly_equal_axes_is_that_of_the_power_sums(ratio):
    """(2/5) Σ 5/(5 + 2m) T_m (Carlson 1979), m T_m = Σ p_k T_{m−k}; ``ratio`` is (y − z)/m over x/m − 1."""
    s = Polynomial([0.0, 1.0])
    found = _ring_tail(1.0 + s, ratio * s, 0.0 * s, 1.0)
    X, Y, Z = -1.0, (1.0 / 3.0 - ratio) / 2.0, (1.0 / 3.0 + ratio) / 2.0
    p = [0.5 * X**k + 1.5 * (Y**k + Z**k) for k in range(8)]
    T = [1.0]
    for m in range(1, 8):
        T.append(sum(p[k] * T[m - k] for k in range(1, m + 1)) / m)
    expected = [0.4 * 5.0 / (5.0 + 2.0 * m) * T[m] for m in range(8)]
    np.testing.assert_allclose(found.coef, expected, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(_reciprocal_root(s).coef, binom(-0.5, np.arange(8)), rtol=1e-14)


@pytest.mark.parametrize("way", [(2.0, -1.0, -0.9), (-2.0, 1.0, 1.3), (0.1, 1.0, -1.0), (1.0, 0.5, -1.5)])
def test_the_series_at_nearly_equal_axes_ends_before_the_eighth_order(way):
    errors = []
    for size in (0.1, 0.05):
        x, y, z = (1.0 + size * w for w in way)
        mean = mpmath.mpf(x + 3.0 * y + 3.0 * z) / 7
        found = _ring_tail(x, y, z, float(1 / mean))
        errors.append(abs(float(found - ring(x, y, z) * mean ** mpmath.mpf(2.5))))
    assert errors[0] < 3e-7
    assert np.log2(errors[0] / errors[1]) == pytest.approx(8.0, abs=0.5)


@given(stretches)
def test_the_tails_have_all_digits_where_few_duplications_leave_them(axes):
    """Roots by series about the common mean, for squares that differ as a ratio of 1000 leaves them."""
    x, y, z = (1.0 + 0.045 * np.log(a / min(axes)) / max(np.log(max(axes) / min(axes)), 1e-9) for a in axes)
    *tails, total = _tails(x, y, z)
    assert total == pytest.approx(2.0 / np.sqrt(x * y * z), rel=1e-14, abs=0.0)
    for tail, (p, q, r) in zip(tails, ((x, y, z), (y, z, x), (z, x, y)), strict=True):
        mean = (p + 3.0 * q + 3.0 * r) / 7.0
        assert tail == pytest.approx(_ring_tail(p, q, r, 1.0 / mean) * mean**-2.5, rel=1e-14, abs=0.0)


@given(stretches, st.permutations([0, 1, 2]))
def test_integrals_do_not_depend_on_the_order_of_the_axes(axes, order):
    g, permuted = integrals(axes), integrals(tuple(axes[i] for i in order))
    for ours, theirs in ((g.alpha, permuted.alpha), (g.ring, permuted.ring), (g.star, permuted.star)):
        np.testing.assert_allclose(theirs, [ours[i] for i in order], rtol=1e-13)


@given(stretches, st.sampled_from([1e-6, 1e3]))
def test_integrals_scale_with_their_units(axes, unit):
    g, scaled = integrals(axes), integrals(tuple(unit * a for a in axes))
    np.testing.assert_allclose(scaled.alpha, np.array(g.alpha) / unit**3, rtol=1e-13)
    np.testing.assert_allclose(scaled.ring, np.array(g.ring) / unit**5, rtol=1e-13)
    np.testing.assert_allclose(scaled.star, np.array(g.star) / unit**3, rtol=1e-13)
    np.testing.assert_allclose(scaled.chi, g.chi / unit, rtol=1e-13)


@given(stretches)
def test_integrals_equal_scipys_carlson_functions(axes):
    a, b, c = axes
    g = integrals(axes)
    x, y, z = a * a, b * b, c * c
    expected = [2 / 3 * elliprd(y, z, x), 2 / 3 * elliprd(z, x, y), 2 / 3 * elliprd(x, y, z)]
    np.testing.assert_allclose(g.alpha, expected, rtol=1e-13)
    np.testing.assert_allclose(g.chi, 2 * elliprf(x, y, z), rtol=1e-13)
    np.testing.assert_allclose(sum(g.alpha), 2 / (a * b * c), rtol=1e-13)


@given(rotations, stretches)
def test_reach_is_the_largest_projection_of_the_surface(Q, stretch):
    F = Q @ np.diag(stretch)
    n = np.array([2.0, -1.0, 2.0]) / 3.0
    # The surface point where the normal is n is F Fᵀ n/|Fᵀ n|.
    h = F.T @ n
    furthest = F @ (h / np.linalg.norm(h))
    np.testing.assert_allclose(reach(1.5, flat(F), tuple(n)), 1.5 * furthest @ n, rtol=1e-12)
    directions = np.random.default_rng(0).normal(size=(200, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    assert (1.5 * (directions @ F.T) @ n <= reach(1.5, flat(F), tuple(n)) * (1 + 1e-12)).all()
