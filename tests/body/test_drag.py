from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, stretches

from foamprb.body.drag import brenner_prolate, implicit_euler, oberbeck, reduced_gravity
from foamprb.body.ellipsoid import integrals


def resistances(law, *axes):
    return np.array(law(axes, integrals(axes)))


def brenner(r):
    """k'₁₁ and k'₂₂ of the paper's (D.1), (D.2) as printed."""
    root = np.sqrt(r * r - 1)
    log = np.log(r + root)
    along = 8 * root**3 / ((2 * r * r - 1) * log - r * root)
    across = 16 * root**3 / ((2 * r * r - 3) * log + r * root)
    return along, across


@pytest.mark.parametrize("r", [1.5, 2.0, 5.0, 10.0, 100.0])
def test_prolate_spheroid_has_brenners_closed_form(r):
    along, across = brenner(r)
    for law in (oberbeck, brenner_prolate):
        np.testing.assert_allclose(resistances(law, r, 1.0, 1.0) / np.pi, [along, across, across], rtol=1e-11)
        np.testing.assert_allclose(resistances(law, 1.0, r, 1.0) / np.pi, [across, along, across], rtol=1e-11)


@pytest.mark.parametrize("r", [1.5, 3.0, 20.0])
def test_oblate_spheroid_has_its_closed_form(r):
    """Broadside and edgewise resistance of a disk-like spheroid (Happel & Brenner 1983, 5-11)."""
    s = 1 / np.sqrt(r * r - 1)  # sinh of the spheroidal coordinate
    acot = np.arctan(1 / s)
    focus = np.sqrt(r * r - 1)
    broadside = 8 * np.pi * focus / (s - (s * s - 1) * acot)
    edgewise = 16 * np.pi * focus / ((3 + s * s) * acot - s)
    # Check of the closed forms themselves: a sphere is their limit.
    np.testing.assert_allclose(resistances(oberbeck, r, r, 1.0), [edgewise, edgewise, broadside], rtol=1e-11)


def test_triaxial_ellipsoid_near_boundary_elements():
    """5:3:1 by boundary elements, 15.501, 17.066, 20.565 (Štrakl et al. 2022), to their 0.2 %."""
    found = resistances(oberbeck, 5.0, 3.0, 1.0) / np.pi
    np.testing.assert_allclose(found, [15.488, 17.047, 20.528], rtol=4e-5)
    np.testing.assert_allclose(found, [15.501, 17.066, 20.565], rtol=2e-3)


@given(st.floats(1e-6, 10.0))
def test_sphere_has_stokes_drag(R):
    for law in (oberbeck, brenner_prolate):
        np.testing.assert_allclose(resistances(law, R, R, R), 6 * np.pi * R, rtol=1e-13)


@given(stretches)
def test_resistance_grows_with_the_body_and_lies_between_spheres(axes):
    found = resistances(oberbeck, *axes)
    assert (found >= 6 * np.pi * min(axes) * (1 - 1e-12)).all()
    assert (found <= 6 * np.pi * max(axes) * (1 + 1e-12)).all()
    # The longer an axis, the smaller the resistance along it.
    axes = np.array(axes)
    longer = axes[:, None] > axes
    smaller = found[:, None] <= found * (1 + 1e-12)
    assert smaller[longer].all()


@given(stretches)
def test_brenner_prolate_underestimates_the_size(axes):
    longest = int(np.argmax(axes))
    exact, surrogate = resistances(oberbeck, *axes), resistances(brenner_prolate, *axes)
    assert surrogate[longest] <= exact[longest] * (1 + 1e-12)


def test_reduced_gravity_follows_the_volume():
    """(ρ_s/J − ρ_f) J vol₀ g per mass ρ_s vol₀; nothing is left at equal densities."""
    np.testing.assert_allclose(reduced_gravity(1.2, 2500.0, 1000.0, (0.0, -9.81, 0.0))[1], -9.81 * (1 - 0.48))
    np.testing.assert_allclose(reduced_gravity(1.0, 1000.0, 1000.0, (1.0, 2.0, 3.0)), 0.0)


def test_implicit_euler_is_first_order():
    """Against v(t) = (1 − e^(−kt)) u for a sphere from rest."""
    k, end = 50.0, 0.02
    errors = []
    for steps in (40, 80, 160):
        v = (0.0, 0.0, 0.0)
        for _ in range(steps):
            identity = flat(np.eye(3))
            v = implicit_euler(v, (1.0, 0.0, 0.0), identity, (k, k, k), (0.0, 0.0, 0.0), end / steps)
        errors.append(abs(v[0] - (1 - np.exp(-k * end))))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 1.0, atol=0.03)
