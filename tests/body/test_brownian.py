from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, mild_stretches, rotations, square, tensors
from validation.references import wall as ref

from foamprb.body.brownian import (
    deviates,
    random_force,
    random_stress,
    response,
    shape_resistance,
)
from foamprb.body.drag import oberbeck
from foamprb.body.ellipsoid import integrals
from foamprb.body.stokes import mobility, velocity_gradient
from foamprb.body.tensor import (
    add,
    dev,
    scale,
    sym,
)
from foamprb.body.traction import roscoe
from foamprb.body.wall import hindered_resistance, hindrance

VOLUME = 4.0 / 3.0 * np.pi
ZERO = (0.0,) * 9
KEY = (np.uint64(11), np.uint64(1))
ratios = st.floats(0.0, 20.0)


def draw(n, step):
    """Three and nine deviates of n particles, as tuples of arrays."""
    return deviates(np.arange(n, dtype=np.uint64), np.uint64(step), KEY)


# --- Numbers ------------------------------------------------------------------------------------------------


def test_deviates_belong_to_the_particle_and_the_step():
    n = 50
    three, nine = draw(n, 4)
    for i in (0, 17, n - 1):
        a, b = deviates(np.uint64(i), np.uint64(4), KEY)
        np.testing.assert_array_equal(a, [c[i] for c in three])
        np.testing.assert_array_equal(b, [c[i] for c in nine])
    others = [draw(n, 5), deviates(np.arange(n, dtype=np.uint64), np.uint64(4), (KEY[0], np.uint64(2)))]
    for first, second in others:
        assert not np.any(np.array(first + second) == np.array(three + nine))


def test_deviates_of_numbers_beyond_32_bits_are_others():
    large = np.uint64(2**32)
    seen = {
        deviates(particle, step, KEY)[0][0]
        for particle in (np.uint64(0), large, np.uint64(1))
        for step in (np.uint64(0), large, np.uint64(2**40), np.uint64(1), np.uint64(2))
    }
    assert len(seen) == 15


def test_the_twelve_deviates_are_independent():
    n = 100_000
    three, nine = draw(n, 0)
    covariance = np.cov(np.array(three + nine))
    assert abs(covariance - np.eye(12)).max() < 5.0 * np.sqrt(2.0 / n)


# --- Fluctuation and dissipation ----------------------------------------------------------------------------


@given(mild_stretches, rotations, st.floats(0.01, 3.0))
def test_random_forces_have_the_covariance_of_the_resistance(stretches, Q, gap):
    k = oberbeck(stretches, integrals(stretches))
    K = hindered_resistance(k, hindrance(k, flat(Q[0]), gap + 1.0, gap))
    root = np.stack([random_force(K, 1.7, tuple(e)) for e in np.eye(3)], axis=1)
    np.testing.assert_allclose(root @ root.T, 1.7**2 * square(K), rtol=1e-12, atol=1e-10)


@given(mild_stretches, ratios, tensors)
def test_the_bodys_response_to_a_stress_is_that_of_its_shape(axes, eta, T):
    g = integrals(axes)
    stress = sym(T)
    l = response(shape_resistance(axes, g, eta), stress)
    expected = velocity_gradient(mobility(axes, g, eta), scale(-1.0, stress), ZERO)
    np.testing.assert_allclose(l, expected, atol=1e-12)


@given(mild_stretches, ratios, tensors)
def test_the_response_balances_the_traction_and_the_solids_viscous_stress(axes, eta, T):
    """T = −σ̃(l_s; 0) + 2 η d_s less a pressure, torque included."""
    g = integrals(axes)
    l = response(shape_resistance(axes, g, eta), T)
    load = add(scale(2.0 * eta, sym(l)), scale(-1.0, roscoe(axes, g, ZERO, l)))
    np.testing.assert_allclose(dev(load), dev(T), atol=1e-11)
    assert abs(l[0] + l[4] + l[8]) < 1e-13


@given(mild_stretches, ratios, tensors, tensors)
def test_the_response_is_reciprocal_and_dissipates(axes, eta, S, T):
    """Lorentz's theorem: S:l(T) = T:l(S), and T:l(T) > 0."""
    r = shape_resistance(axes, integrals(axes), eta)
    a, b = np.dot(S, response(r, T)), np.dot(T, response(r, S))
    np.testing.assert_allclose(a, b, atol=1e-12)
    assert np.dot(T, response(r, T)) >= 0.0


@given(mild_stretches, ratios)
def test_random_stresses_have_the_covariance_of_the_resistance(axes, eta):
    """In the rates that they cause: with size 1, ⟨l l⟩ is the response itself."""
    r = shape_resistance(axes, integrals(axes), eta)
    M = np.stack([response(r, tuple(e)) for e in np.eye(9)], axis=1)
    root = np.stack([random_stress(r, 1.0, tuple(e)) for e in np.eye(9)], axis=1)
    np.testing.assert_allclose(M @ root @ root.T @ M.T, M, atol=1e-11)


def test_a_turning_sphere_has_its_resistance():
    """Torque 8π μ R³ ω: V (T_21 − T_12)."""
    R = 1.4
    axes = (R, R, R)
    r = shape_resistance(axes, integrals(axes), 0.0)
    l = response(r, (0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    torque = 2.0 * VOLUME * R**3
    np.testing.assert_allclose(l[3], torque / (8.0 * np.pi * R**3), rtol=1e-13)


@pytest.mark.parametrize("ratio", [0.2, 0.5, 2.0, 5.0, 20.0])
def test_spheroids_diffuse_with_perrins_factors(ratio):
    """Resistances of a rigid spheroid over those of the sphere of its volume (Perrin 1934, 1936)."""
    axes = tuple(np.array([ratio, 1.0, 1.0]) / np.cbrt(ratio))
    g = integrals(axes)
    K, r = oberbeck(axes, g), shape_resistance(axes, g, 0.0)
    along, across = ref.perrin_translation(ratio)
    np.testing.assert_allclose((K[0], K[1]), (6 * np.pi * along, 6 * np.pi * across), rtol=1e-11)
    about, over = ref.perrin_rotation(ratio)
    # Torque over rate: V 2 μ r_ww for the axes 1 (pair 23) and 2 (pair 13).
    np.testing.assert_allclose(
        (2 * VOLUME * r.spin[0], 2 * VOLUME * r.spin[1]), (8 * np.pi * about, 8 * np.pi * over), rtol=1e-11
    )
