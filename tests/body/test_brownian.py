from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, mild_stretches, rotations, square, tensors
from validation.references import wall as ref

from foamprb.body.brownian import (
    BOLTZMANN,
    deviates,
    random_force,
    random_stress,
    response,
    shape_resistance,
)
from foamprb.body.drag import oberbeck
from foamprb.body.ellipsoid import integrals
from foamprb.body.exponential_runge_kutta import group_exponential
from foamprb.body.stokes import mobility, velocity_gradient
from foamprb.body.tensor import (
    add,
    det,
    dev,
    dot,
    dot_vector,
    from_frame,
    inverse,
    principal_frame,
    scale,
    sym,
    to_frame,
    transpose,
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


# --- Motion -------------------------------------------------------------------------------------------------


def test_ellipsoids_diffuse_along_their_axes_with_einsteins_coefficients():
    """⟨Δx²⟩ = 2 kT Δt/(μ K_a) of water's molecules at 293 K, a body of half a micrometre."""
    n, dt, mu, T = 40_000, 1e-3, 1e-3, 293.0
    axes = (0.5e-6, 0.3e-6, 0.2e-6)
    k = oberbeck(axes, integrals(axes))
    K = (k[0], 0.0, 0.0, 0.0, k[1], 0.0, 0.0, 0.0, k[2])
    three, _ = draw(n, 0)
    f = np.array(random_force(K, np.sqrt(2.0 * BOLTZMANN * T * mu / dt), three))
    moved = dt * f / (mu * np.array(k)[:, None])
    expected = 2.0 * BOLTZMANN * T * dt / (mu * np.array(k))
    np.testing.assert_allclose((moved**2).mean(axis=1), expected, rtol=5.0 * np.sqrt(2.0 / n))
    scaled = moved / np.sqrt(expected)[:, None]
    assert abs(np.cov(scaled) - np.eye(3)).max() < 5.0 * np.sqrt(2.0 / n)


def settle(n, steps, dt, weight, drifting=True):
    """Heights of unit spheres with kT = 1, μ = 1/6π over the wall x₃ = 0, after so many steps."""
    k = (6.0 * np.pi,) * 3
    up = (0.0, 0.0, 1.0)
    mu = 1.0 / (6.0 * np.pi)
    h = 1.0 + 1.5 * np.ones(n)

    def resistance(h):
        return hindered_resistance(k, hindrance(k, up, h, np.maximum(h - 1.0, 1e-3)))

    def velocity(K, f):
        return dot_vector(inverse(K), f)[2] / mu

    for step in range(steps):
        three, _ = draw(n, step)
        K = resistance(h)
        f = random_force(K, np.sqrt(2.0 * mu / dt), three)
        load = (f[0], f[1], f[2] - weight)
        middle = h + 0.5 * dt * velocity(K, load) if drifting else h
        h = h + dt * velocity(resistance(middle), load)
        h = 1.0 + abs(h - 1.0)
    return h


def test_heights_over_a_wall_have_boltzmanns_distribution():
    """P(h) ∝ exp(−W (h − R)/kT), although the mobility vanishes at the wall."""
    weight, n = 1.0, 3000
    h = settle(n, 2500, 4e-3, weight)
    gap = np.sort(h - 1.0)
    assert gap.mean() == pytest.approx(1.0 / weight, abs=4.0 / np.sqrt(n))
    distance = abs(1.0 - np.exp(-weight * gap) - (np.arange(n) + 0.5) / n).max()
    assert distance < 1.95 / np.sqrt(n)


def test_without_the_drift_particles_gather_at_the_wall():
    """A step with the mobility of its start, against the previous test."""
    n = 1000
    assert settle(n, 1000, 1e-2, 1.0, drifting=False).mean() - 1.0 < 0.8


def rates(F, T, Q0):
    """l_s of unit bodies of the modulus 1 in a fluid of viscosity 1 at rest with random stresses T, in Q0."""
    Q, stretches = principal_frame(F)
    g = integrals(stretches)
    sigma = to_frame(Q, dot(F, transpose(F)))
    turned = to_frame(Q, from_frame(Q0, T))
    l = velocity_gradient(mobility(stretches, g, 0.0), sigma, ZERO)
    return from_frame(Q, add(l, response(shape_resistance(stretches, g, 0.0), turned)))


def fluctuate(n, steps, dt, kT):
    """Mean stored energies over kT, at every step, of n bodies that start as spheres."""
    one, zero = np.ones(n), np.zeros(n)
    F = (one, zero, zero, zero, one, zero, zero, zero, one)
    size = np.sqrt(2.0 * kT / (VOLUME * dt))
    energies = np.empty(steps)
    for step in range(steps):
        Q0, stretches = principal_frame(F)
        _, nine = draw(n, step)
        T = random_stress(shape_resistance(stretches, integrals(stretches), 0.0), size, nine)
        middle = dot(group_exponential(scale(0.5 * dt, rates(F, T, Q0))), F)
        F = dot(group_exponential(scale(dt, rates(middle, T, Q0))), F)
        F = scale(np.cbrt(1.0 / det(F)), F)
        b = dot(F, transpose(F))
        energies[step] = (0.5 * VOLUME * (b[0] + b[4] + b[8] - 3.0)).mean() / kT
    return energies


@pytest.mark.parametrize(("kT", "expected"), [(1e-4, 2.5), (0.4, None)])
def test_the_energy_of_the_shape_is_that_of_its_five_degrees_of_freedom(kT, expected):
    """5/2 kT of small fluctuations; of large ones, the mean over all F of det F = 1."""
    found = fluctuate(1500, 260, 0.1, kT)[60:].mean()
    exact = ref.mean_shape_energy(kT / VOLUME)
    if expected is not None:
        assert exact == pytest.approx(expected, rel=1e-3)
    assert found == pytest.approx(exact, rel=0.02)
