"""Formulas of eddies."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.body.turbulence import (
    crossing_rate,
    dissipation,
    eddy_time,
    kolmogorov_length,
    kolmogorov_rate,
    lasting,
)


def test_a_slip_takes_a_particle_through_the_length_of_an_eddy():
    """Of C_μ^¾ k^{3/2}/ε in its time over the rate, if it is fast enough; never sooner than a millionth."""
    k, epsilon, slip = 0.3, 2.0, 4.0
    life = eddy_time(k, epsilon) / crossing_rate(k, slip)
    assert life * slip == pytest.approx(0.09**0.75 * k**1.5 / epsilon)
    assert crossing_rate(k, 0.0) == 1.0
    assert crossing_rate(0.0, 1.0) == 1e6
    assert eddy_time(0.0, 0.0) == 0.0


def test_dispersion_by_an_eddy_does_not_depend_on_the_step():
    for ratio in (0.01, 0.4, 1.0, 1.4, 2.6, 100.3):
        n, share = lasting(ratio, 1.0)
        assert n == max(1, round(ratio))
        # A way (share n)² every n steps.
        assert share**2 * n**2 / n == pytest.approx(ratio)


def test_kolmogorovs_scales_have_a_reynolds_number_of_one():
    rate, length = kolmogorov_rate(7.0, 1e-5), kolmogorov_length(7.0, 1e-5)
    assert rate * length**2 / 1e-5 == pytest.approx(1.0)
    assert np.isfinite(kolmogorov_length(0.0, 1e-5))


def test_omega_is_epsilon_over_k():
    assert dissipation(2.0, 30.0) == pytest.approx(0.09 * 60.0)
