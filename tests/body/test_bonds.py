"""Kinetics of bonds: random numbers, Bell's rate and the force on a sphere at a wall."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import kstest

from foamprb.body.bonds import exponential_deviate, force_on_held_sphere, off_rate, sensitivity

KEY = np.uint64(1), np.uint64(5)


def test_deviates_are_exponential_and_depend_on_particle_change_and_seed():
    numbers = np.arange(4000, dtype=np.uint64)
    found = exponential_deviate(numbers, np.uint64(0), KEY)
    assert kstest(found, "expon").pvalue > 0.01
    assert exponential_deviate(np.uint64(7), np.uint64(0), KEY) == pytest.approx(found[7], rel=1e-14, abs=0.0)
    for other in (exponential_deviate(numbers, np.uint64(1), KEY), exponential_deviate(numbers, np.uint64(0),
                  (np.uint64(2), KEY[1]))):  # fmt: skip
        assert abs(np.corrcoef(other, found)[0, 1]) < 4.0 / np.sqrt(4000)


def test_bells_rate():
    """Twice as fast at F = ln 2 kT/x_b; a finite number for any force."""
    per_force = sensitivity(4e-10, 300.0)
    force = np.log(2.0) * 1.380649e-23 * 300.0 / 4e-10
    assert off_rate(3.0, force, per_force) == pytest.approx(6.0)
    assert off_rate(3.0, 0.0, per_force) == 3.0
    assert np.isfinite(off_rate(3.0, 1.0, per_force))


def test_force_on_a_sphere_at_a_wall():
    """1.7005 · 6π μ R² γ̇ (Goldman, Cox & Brenner 1967): 12.8 pN for R = 2 µm in water at 100 1/s."""
    assert force_on_held_sphere(2e-6, 100.0, 1e-3) == pytest.approx(1.2821e-11, rel=1e-4, abs=0.0)
