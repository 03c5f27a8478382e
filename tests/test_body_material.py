from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from strategies import flat, mild_stretches, rotations, square

from foamprb.body.material import MATERIALS, lame_parameter, piola

MU, LAME = 3.0, 40.0


@pytest.mark.parametrize("name", MATERIALS)
@given(rotations, mild_stretches, rotations)
def test_piola_stress_is_the_derivative_of_the_stored_energy(name, Q1, stretch, Q2):
    material = MATERIALS[name]
    F = Q1 @ np.diag(stretch) @ Q2
    P = square(piola(material, flat(F), MU, LAME))
    h = 1e-4
    for i in range(3):
        for j in range(3):
            E = np.zeros((3, 3))
            E[i, j] = h
            w = [material.energy(flat(F + k * E), MU, LAME) for k in (-2, -1, 1, 2)]
            derivative = (w[0] - 8 * w[1] + 8 * w[2] - w[3]) / (12 * h)
            np.testing.assert_allclose(P[i, j], derivative, atol=2e-7 * np.abs(P).max() + 1e-8)


@pytest.mark.parametrize("name", MATERIALS)
@given(rotations, mild_stretches, rotations, rotations)
def test_stress_turns_with_the_body_and_not_with_its_rest_frame(name, Q1, stretch, Q2, R):
    F = Q1 @ np.diag(stretch) @ Q2
    P = square(piola(MATERIALS[name], flat(F), MU, LAME))
    np.testing.assert_allclose(square(piola(MATERIALS[name], flat(R @ F), MU, LAME)), R @ P, atol=1e-10)
    np.testing.assert_allclose(square(piola(MATERIALS[name], flat(F @ R), MU, LAME)), P @ R, atol=1e-10)


@pytest.mark.parametrize("name", MATERIALS)
@given(rotations)
def test_a_rotation_stores_no_energy_and_no_stress(name, R):
    np.testing.assert_allclose(MATERIALS[name].energy(flat(R), MU, LAME), 0.0, atol=1e-13)
    np.testing.assert_allclose(piola(MATERIALS[name], flat(R), MU, LAME), 0.0, atol=1e-12)


@pytest.mark.parametrize("name", MATERIALS)
def test_small_strains_are_those_of_hookes_law(name):
    """P → 2 μ ε + λ tr(ε) I."""
    e = 1e-6 * np.array([[1.0, 2.0, 0.0], [2.0, -3.0, 1.0], [0.0, 1.0, 0.5]])
    expected = 2 * MU * e + LAME * np.trace(e) * np.eye(3)
    found = square(piola(MATERIALS[name], flat(np.eye(3) + e), MU, LAME))
    np.testing.assert_allclose(found, expected, rtol=2e-5, atol=1e-10)


@pytest.mark.parametrize("name", MATERIALS)
@pytest.mark.parametrize("J", [0.7, 1.0, 1.3])
def test_third_coefficient_is_the_derivative_of_the_second(name, J):
    h = 1e-5
    psi = [MATERIALS[name].coefficients(J + k * h, MU, LAME)[1] for k in (-1, 1)]
    expected = J * (psi[1] - psi[0]) / (2 * h)
    np.testing.assert_allclose(MATERIALS[name].coefficients(J, MU, LAME)[2], expected, rtol=1e-8)


def test_lame_parameter():
    """K = λ + ⅔ μ = 2 μ (1 + ν)/(3 (1 − 2ν))."""
    nu = 0.3
    np.testing.assert_allclose(
        lame_parameter(MU, nu) + 2 / 3 * MU, 2 * MU * (1 + nu) / (3 * (1 - 2 * nu)), rtol=1e-14
    )
