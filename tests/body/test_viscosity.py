"""Laws of generalised Newtonian fluids."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.body.viscosity import (
    bird_carreau,
    casson,
    cross_power_law,
    herschel_bulkley,
    power_law,
    shear_rate,
)


def test_the_shear_rate_is_root_two_times_the_norm_of_the_strain_rate():
    """OpenFOAM's ``sqrt(2)*mag(symm(gradU))``: γ̇ in simple shear, √12 times the rate of extension."""
    assert shear_rate((0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)) == pytest.approx(3.0)
    assert shear_rate((2.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0)) == pytest.approx(np.sqrt(12.0))


def test_bird_carreau_of_blood():
    """Coefficients of Cho and Kensey (1991)."""
    rate = np.array([1.0, 10.0, 100.0, 1000.0])
    found = bird_carreau(rate, 0.056, 0.00345, 3.313, 0.3568, 2.0)
    assert found == pytest.approx([0.027098, 0.008979, 0.004708, 0.003736], abs=5e-7)


def test_a_power_law_is_limited():
    rate = np.array([0.0, 0.31498026, 1.0, 3.1748021, 1e9])
    found = power_law(rate, 0.5, 0.6, 1e-3, 10.0)
    assert found == pytest.approx([10.0, 0.7937005, 0.5, 0.31498026, 1e-3], rel=1e-7)


@pytest.mark.parametrize(
    ("law", "at_rest", "far"),
    [
        (lambda rate: bird_carreau(rate, 3.0, 1.0, 2.0, 0.2, 2.0), 3.0, 1.0),
        (lambda rate: cross_power_law(rate, 3.0, 1.0, 2.0, 1.5), 3.0, 1.0),
        (lambda rate: herschel_bulkley(rate, 3.0, 1.0, 2.0, 1.0), 3.0, 2.0),
        (lambda rate: casson(rate, 2.0, 1.0, 0.0, 3.0), 3.0, 2.0),
        (lambda rate: casson(rate, 2.0, 1.0, 2.5, 3.0), 3.0, 2.5),
    ],
)
def test_limits_of_laws(law, at_rest, far):
    assert law(0.0) == pytest.approx(at_rest, rel=1e-12)
    assert law(1e16) == pytest.approx(far, rel=1e-6)


def test_laws_with_a_yield_stress():
    """τ = τ₀ + k γ̇ⁿ, and √τ = √τ₀ + √(m γ̇)."""
    assert 4.0 * herschel_bulkley(4.0, 1e9, 1.0, 2.0, 0.5) == pytest.approx(5.0)
    assert 4.0 * casson(4.0, 0.25, 9.0, 0.0, 1e9) == pytest.approx(16.0)
