from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from strategies import flat, mild_stretches, rotations, square

from foamprb.body.material import (
    MATERIALS,
    Parameter,
    add_material,
    invariants,
    lame_parameter,
    modulus_of_capsule,
    piola,
    stored_energy,
)

MU, LAME = 3.0, 40.0

K = {name: {"mooneyRivlin": 0.3, "gent": 20.0}.get(name, 0.0) for name in MATERIALS}


@pytest.mark.parametrize("name", MATERIALS)
@given(rotations, mild_stretches, rotations)
def test_piola_stress_is_the_derivative_of_the_stored_energy(name, Q1, stretch, Q2):
    material = MATERIALS[name]
    F = Q1 @ np.diag(stretch) @ Q2
    P = square(piola(material, flat(F), MU, LAME, K[name]))
    h = 1e-4
    for i in range(3):
        for j in range(3):
            E = np.zeros((3, 3))
            E[i, j] = h
            w = [stored_energy(material, flat(F + k * E), MU, LAME, K[name]) for k in (-2, -1, 1, 2)]
            derivative = (w[0] - 8 * w[1] + 8 * w[2] - w[3]) / (12 * h)
            np.testing.assert_allclose(P[i, j], derivative, atol=2e-7 * np.abs(P).max() + 1e-8)


@pytest.mark.parametrize("name", MATERIALS)
@given(rotations, mild_stretches, rotations, rotations)
def test_stress_turns_with_the_body_and_not_with_its_rest_frame(name, Q1, stretch, Q2, R):
    F = Q1 @ np.diag(stretch) @ Q2
    P = square(piola(MATERIALS[name], flat(F), MU, LAME, K[name]))
    turned = square(piola(MATERIALS[name], flat(R @ F), MU, LAME, K[name]))
    np.testing.assert_allclose(turned, R @ P, atol=1e-10)
    turned = square(piola(MATERIALS[name], flat(F @ R), MU, LAME, K[name]))
    np.testing.assert_allclose(turned, P @ R, atol=1e-10)


@pytest.mark.parametrize("name", MATERIALS)
@given(rotations)
def test_a_rotation_stores_no_energy_and_no_stress(name, R):
    np.testing.assert_allclose(stored_energy(MATERIALS[name], flat(R), MU, LAME, K[name]), 0.0, atol=1e-12)
    np.testing.assert_allclose(piola(MATERIALS[name], flat(R), MU, LAME, K[name]), 0.0, atol=1e-12)


@pytest.mark.parametrize("name", MATERIALS)
def test_small_strains_are_those_of_hookes_law(name):
    """P → 2 μ ε + λ tr(ε) I."""
    e = 1e-7 * np.array([[1.0, 2.0, 0.0], [2.0, -3.0, 1.0], [0.0, 1.0, 0.5]])
    expected = 2 * MU * e + LAME * np.trace(e) * np.eye(3)
    found = square(piola(MATERIALS[name], flat(np.eye(3) + e), MU, LAME, K[name]))
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-12)


@pytest.mark.parametrize("name", [name for name, m in MATERIALS.items() if m.dilation])
@pytest.mark.parametrize("J", [0.7, 1.0, 1.3])
def test_dilation_is_the_derivative_of_the_volumetric_stress(name, J):
    """J d(J w_J)/dJ, for the solids that the paper's scheme takes."""
    h = 1e-5
    psi = [x * MATERIALS[name].derivatives(3.0, 3.0, x, MU, LAME, 0.0)[2] for x in (J - h, J + h)]
    expected = J * (psi[1] - psi[0]) / (2 * h)
    np.testing.assert_allclose(MATERIALS[name].dilation(J, MU, LAME), expected, rtol=1e-8)


@given(rotations, mild_stretches)
def test_invariants(Q, stretch):
    b = Q @ np.diag(stretch) @ Q.T
    expected = (np.trace(b), 0.5 * (np.trace(b) ** 2 - np.trace(b @ b)))
    np.testing.assert_allclose(invariants(flat(b)), expected, rtol=1e-12)


def test_mooney_rivlin_without_its_second_part_is_neo_hooke():
    F = flat(np.array([[1.2, 0.3, 0.0], [0.0, 0.9, 0.1], [0.1, 0.0, 1.0]]))
    expected = piola(MATERIALS["neoHooke"], F, MU, LAME)
    np.testing.assert_allclose(piola(MATERIALS["mooneyRivlin"], F, MU, LAME, 0.0), expected, atol=1e-13)


def test_gent_is_neo_hooke_far_from_its_limit_and_infinite_at_it():
    F = flat(np.diag([1.5, 0.8, 1 / 1.2]))
    expected = piola(MATERIALS["neoHooke"], F, MU, LAME)
    np.testing.assert_allclose(piola(MATERIALS["gent"], F, MU, LAME, 1e9), expected, rtol=1e-8)
    limit = sum(x * x for x in (1.5, 0.8, 1 / 1.2)) - 3
    with np.errstate(divide="ignore"):
        assert np.isinf(MATERIALS["gent"].derivatives(3 + limit, 3.0, 1.0, MU, LAME, limit)[0])


def test_lame_parameter():
    """K = λ + ⅔ μ = 2 μ (1 + ν)/(3 (1 − 2ν))."""
    nu = 0.3
    np.testing.assert_allclose(
        lame_parameter(MU, nu) + 2 / 3 * MU, 2 * MU * (1 + nu) / (3 * (1 - 2 * nu)), rtol=1e-14
    )


def coupled_energy(I1, I2, J, mu, lame, k):
    """Of which each derivative depends on all three invariants."""
    x, y, z = I1 - 3.0, I2 - 3.0, J - 1.0
    own = 0.1 * x * x + 0.2 * y * y + 0.3 * x * y + 0.4 * y * z + 0.5 * z * x
    return 0.5 * mu * (x - 2.0 * np.log(J)) + mu * own + 0.5 * lame * z * z


def coupled_derivatives(I1, I2, J, mu, lame, k):
    """The derivative k is wrong by as little as 2 per mille of the shear modulus, but not at rest."""
    x, y, z = I1 - 3.0, I2 - 3.0, J - 1.0
    off = 0.005 * mu * x
    return (
        0.5 * mu + mu * (0.2 * x + 0.3 * y + 0.5 * z) + off * (k == 1.0),
        mu * (0.4 * y + 0.3 * x + 0.4 * z) + off * (k == 2.0),
        -mu / J + mu * (0.4 * y + 0.5 * x) + lame * z + off * (k == 3.0),
    )


def test_a_solid_whose_derivatives_are_those_of_its_energy_is_added():
    try:
        found = [
            add_material(
                "given", coupled_energy, coupled_derivatives, parameter=Parameter("wrong", 0.0, 0.0)
            ),
            add_material("taken", coupled_energy),
        ]
        for material in found:
            w = material.derivatives(3.2, 3.1, 1.05, MU, LAME, 0.0)
            expected = coupled_derivatives(3.2, 3.1, 1.05, MU, LAME, 0.0)
            np.testing.assert_allclose(w, expected, rtol=1e-13)
    finally:
        for name in ("given", "taken"):
            MATERIALS.pop(name, None)


@pytest.mark.parametrize("wrong", [1, 2, 3])
def test_a_solid_whose_derivatives_are_not_those_of_its_energy_is_refused(wrong):
    parameter = Parameter("wrong", float(wrong), float(wrong))
    with pytest.raises(ValueError, match=rf"at .*3\.3, 3\.2, 1\.02.* derivative {wrong} of its energy"):
        add_material("given", coupled_energy, coupled_derivatives, parameter=parameter)
    assert "given" not in MATERIALS


@pytest.mark.parametrize(
    ("nu_s", "modulus", "D"), [(0.5, 0.6, 25 / 12), (1 / 3, 4 / 7, 2.1875), (0.9, 0.65517, 1.9079)]
)
def test_a_capsule_of_small_deformation_is_that_of_barthes_biesel(nu_s, modulus, D):
    """μ R/G_s, and D over μ_f γ̇ R/G_s = 5/4 (2 + ν_s)/(1 + ν_s), with D = 5/4 Ca of the solid sphere."""
    found = modulus_of_capsule(3e-3, nu_s, 5e-6)
    assert found * 5e-6 / 3e-3 == pytest.approx(modulus, rel=1e-5)
    assert 1.25 * 3e-3 / 5e-6 / found == pytest.approx(D, rel=1e-4)
