from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import flat, mild_stretches, rotations, square, tensors

from foamprb.body import rosenbrock, stokes, surface_tension
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import (
    MATERIALS,
    finger,
    metric_at_rest,
    piola,
    stored_energy,
    viscous_stress,
)
from foamprb.body.tensor import dev
from foamprb.body.traction import roscoe

MU, LAME = 2.0, 30.0
AT_REST = (0.0,) * 9
PAIRS = ((1, 2, 0), (0, 2, 1), (0, 1, 2))


@pytest.mark.parametrize("name", MATERIALS)
@pytest.mark.parametrize("stretch", [(1.2, 0.9, 1.05), (0.7, 1.1, 1.4)])
def test_stress_of_every_material_is_that_of_its_piola_stress(name, stretch, monkeypatch):
    """Along the axes, and in a frame that is turned."""
    material, k = MATERIALS[name], {"mooneyRivlin": 0.4, "gent": 5.0}.get(name, 0.0)
    monkeypatch.setattr(rosenbrock, "derivatives", material.derivatives)
    F, J = np.diag(stretch), np.prod(stretch)
    tau = square(piola(material, flat(F), MU, LAME, k)) @ F.T
    found = square(rosenbrock.kirchhoff_in_frame(flat(F @ F.T), J, MU, LAME, k))
    np.testing.assert_allclose(found, tau, atol=1e-12)
    Q = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3.0
    found = square(rosenbrock.kirchhoff(flat(Q @ F @ F.T @ Q.T), J, MU, LAME, k))
    np.testing.assert_allclose(found, Q @ tau @ Q.T, atol=1e-12)


@pytest.mark.parametrize("name", [name for name in MATERIALS if MATERIALS[name].isochoric])
@pytest.mark.parametrize("tension", [0.0, 3.0])
def test_the_extra_stress_of_an_incompressible_body_lacks_a_pressure_only(name, tension, monkeypatch):
    """So do the columns of its slopes; the shear is that of the whole stress."""
    material, k = MATERIALS[name], {"mooneyRivlin": 0.4, "gent": 5.0}.get(name, 0.0)
    monkeypatch.setattr(rosenbrock, "derivatives", material.derivatives)
    stretch = np.array([1.3, 0.9, 1.0 / 1.17])
    b, squares = flat(np.diag(stretch**2)), tuple(stretch**2)
    for stress, extra in (
        (rosenbrock.kirchhoff, rosenbrock.extra_stress),
        (rosenbrock.kirchhoff_in_frame, rosenbrock.extra_stress_in_frame),
    ):
        off = np.subtract(stress(b, 1.0, MU, LAME, k), extra(b, 1.0, MU, LAME, k))
        pressure = material.derivatives(b[0] + b[4] + b[8], 3.0, 1.0, MU, LAME, k)[2]
        np.testing.assert_allclose(square(off), pressure * np.eye(3), atol=1e-13)
    whole = rosenbrock.elasticity(squares, 1.0, MU, LAME, k, tension)
    extra = rosenbrock.extra_elasticity(squares, 1.0, MU, LAME, k, tension)
    columns = square(np.subtract(whole.slopes, extra.slopes))
    np.testing.assert_allclose(columns, np.tile(columns[0], (3, 1)), atol=1e-8)
    assert columns[0] == pytest.approx(np.full(3, LAME - _bulk_of_shear(name, k)), rel=1e-5)
    assert whole.shear == extra.shear


@pytest.mark.parametrize("tension", [0.0, 3.0])
@pytest.mark.parametrize("name", [name for name, solid in MATERIALS.items() if solid.dilation is not None])
@given(stretch=mild_stretches)
def test_the_elasticity_of_a_solid_with_a_dilation_is_that_by_differences(name, tension, stretch):
    squares, J = tuple(s * s for s in stretch), float(np.prod(stretch))
    with pytest.MonkeyPatch.context() as patch:
        for part in ("derivatives", "dilation"):
            patch.setattr(rosenbrock, part, getattr(MATERIALS[name], part))
        arguments = squares, J, MU, LAME, 0.0, tension
        for closed, by_differences in (
            (rosenbrock.elasticity_by_dilation, rosenbrock.elasticity),
            (rosenbrock.extra_elasticity_by_dilation, rosenbrock.extra_elasticity),
        ):
            found, expected = closed(*arguments), by_differences(*arguments)
            size = np.abs(expected.slopes).max()
            np.testing.assert_allclose(found.slopes, expected.slopes, atol=1e-5 * size)
            np.testing.assert_allclose(found.shear, expected.shear, rtol=1e-12)


@pytest.mark.parametrize("tension", [0.0, 3.0])
@given(stretch=mild_stretches)
def test_the_elasticity_of_a_stress_is_that_of_the_energy(tension, stretch):
    squares, J = tuple(s * s for s in stretch), float(np.prod(stretch))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rosenbrock, "derivatives", MATERIALS["mooneyRivlin"].derivatives)
        arguments = squares, J, MU, LAME, 0.4, tension
        found, expected = rosenbrock.elasticity_by_stress(*arguments), rosenbrock.elasticity(*arguments)
    size = np.abs(expected.slopes).max()
    np.testing.assert_allclose(found.slopes, expected.slopes, atol=1e-8 * size)
    # Of first order in the difference.
    np.testing.assert_allclose(found.shear, expected.shear, rtol=1e-6)


def _bulk_of_shear(name, k):
    """By how much λ' is less than λ in the solid's volume energy."""
    return {"mooneyRivlin": 2.0 * MU * k, "gent": 2.0 * MU / (k or 1.0), "drop": -MU / 1.5}.get(name, 0.0)


def elasticity(stretch, tension=0.0):
    squares = tuple(x * x for x in stretch)
    return rosenbrock.elasticity(squares, np.prod(stretch), MU, LAME, 0.0, tension)


@given(rotations, mild_stretches, rotations, mild_stretches, tensors)
def test_kirchhoff_stress_is_the_energys_derivative_for_every_shape_at_rest(Q1, stretch, Q2, rest, X):
    """dw₀(F F₀⁻¹) = τ : X along dF = X F, with b_e = F M Fᵀ and det F₀ = 1."""
    material = MATERIALS["neoHooke"]
    F = Q1 @ np.diag(stretch)
    F0 = Q2 @ np.diag(np.array(rest) / np.prod(rest) ** (1 / 3)) @ Q2.T
    b_e = finger(flat(F), metric_at_rest(flat(F0)))
    tau = square(rosenbrock.kirchhoff(b_e, np.linalg.det(F), MU, LAME, 0.0))
    h = 1e-5
    w = [
        stored_energy(material, flat((np.eye(3) + k * h * square(X)) @ F @ np.linalg.inv(F0)), MU, LAME)
        for k in (-1, 1)
    ]
    slope = (w[1] - w[0]) / (2 * h)
    np.testing.assert_allclose(slope, np.sum(tau * square(X)), atol=1e-6 * (1 + np.abs(tau).max()))


@given(mild_stretches)
def test_surface_tension_stress_is_the_derivative_of_the_surface(stretch):
    """(1/vol₀) ∂(γ S)/∂ln λ_a − 2γ/R, against S by quadrature over the sphere (Cauchy: dS = J |F⁻ᵀ N| dA)."""
    u, weights = np.polynomial.legendre.leggauss(60)
    phi = np.arange(120) * np.pi / 60
    s = np.sqrt(1 - u**2)
    n = np.stack([s[:, None] * np.cos(phi), s[:, None] * np.sin(phi), u[:, None] + 0 * phi])

    def surface(x):
        stretched = np.linalg.norm(n / np.reshape(x, (3, 1, 1)), axis=0)
        return np.prod(x) * np.sum(weights[:, None] * stretched) * np.pi / 60

    x, h = np.array(stretch), 1e-5
    found = surface_tension.laplace_stress(stretch, 0.7)
    for a in range(3):
        step = np.exp(h * np.eye(3)[a])
        slope = (surface(x * step) - surface(x / step)) / (2 * h)
        expected = 0.7 * slope / (4 / 3 * np.pi) - 2 * 0.7
        np.testing.assert_allclose(found[a], expected, atol=1e-8)


def test_surface_tension_stiffens_a_sphere_by_its_elasticity():
    e, h = elasticity((1.0, 1.0, 1.0), 3.0), 1e-4
    bare = elasticity((1.0, 1.0, 1.0))
    for a in range(3):
        step = np.exp(h * (np.eye(3)[a] - 1 / 3))
        change = np.array(surface_tension.laplace_stress(tuple(step), 3.0)) / h
        np.testing.assert_allclose(square(e.slopes)[:, a] - square(bare.slopes)[:, a], change, atol=2e-3)
    np.testing.assert_allclose(np.array(e.shear) - np.array(bare.shear), 0.8 * 3.0, rtol=1e-12)


@pytest.mark.parametrize("name", MATERIALS)
@given(mild_stretches, tensors)
def test_elasticity_is_that_derivative_for_every_material(name, stretch, X):
    """Where the energy depends on I₂ as well a shear stress depends on the third stretch."""
    material, k = MATERIALS[name], {"mooneyRivlin": 0.4, "gent": 20.0}.get(name, 0.0)
    F, X, h = np.diag(stretch), square(X), 1e-5
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rosenbrock, "derivatives", material.derivatives)
        e = rosenbrock.elasticity(tuple(x * x for x in stretch), np.prod(stretch), MU, LAME, k, 0.0)
    G = [F + s * h * X @ F for s in (1, -1)]
    tau = [square(piola(material, flat(g), MU, LAME, k)) @ g.T for g in G]
    change = (tau[0] - tau[1]) / (2 * h)
    size = 1.0 + abs(square(e.slopes)).max()
    np.testing.assert_allclose(square(e.slopes) @ np.diag(X), np.diag(change), atol=1e-4 * size)
    for i, j, other in PAIRS:
        expected = e.shear[other] * (X[i, j] * stretch[j] ** 2 + X[j, i] * stretch[i] ** 2)
        np.testing.assert_allclose(change[i, j], expected, atol=1e-6 * size)
        np.testing.assert_allclose(change[j, i], expected, atol=1e-6 * size)


@given(mild_stretches, tensors, st.floats(0.0, 20.0))
def test_traction_coefficients_are_those_of_roscoes_traction(axes, Y, eta):
    g, Y = integrals(axes), square(Y)
    s = square(roscoe(axes, g, AT_REST, flat(Y))) - square(viscous_stress(flat(Y), eta))
    np.testing.assert_allclose(
        square(rosenbrock.traction_slopes(axes, g, eta)) @ np.diag(Y), np.diag(s), atol=1e-10
    )
    shears = rosenbrock.shears(axes, g, eta)
    for i, j, other in PAIRS:
        c = shears[other]
        np.testing.assert_allclose(c[0] * Y[i, j] + c[1] * Y[j, i], s[i, j], atol=1e-11)
        np.testing.assert_allclose(c[2] * Y[i, j] + c[3] * Y[j, i], s[j, i], atol=1e-11)


@given(mild_stretches, tensors, tensors, st.floats(0.0, 20.0))
def test_inertialess_body_is_in_balance_and_keeps_its_volume(axes, stress, l_f, eta):
    """σ̃(l_s; l_f) − 2 η_s d_s = σ up to a pressure, no torque, Σ d_s,aa = 0."""
    g = integrals(axes)
    sigma = square(stress) + square(stress).T
    L = flat(square(dev(l_f)))
    l_s = stokes.velocity_gradient(stokes.mobility(axes, g, eta), flat(sigma), L)
    np.testing.assert_allclose(np.trace(square(l_s)), 0.0, atol=1e-12)
    left = square(roscoe(axes, g, L, l_s)) - square(viscous_stress(l_s, eta)) - sigma
    np.testing.assert_allclose(left - np.trace(left) / 3 * np.eye(3), 0.0, atol=1e-10)


@given(st.floats(0.3, 1.9))
def test_isochoric_restores_the_volume(J):
    """Far from 1 as well, where every iteration counts."""
    F = flat(np.diag([J, 1.0, 1.0]))
    np.testing.assert_allclose(np.linalg.det(square(stokes.isochoric(F, J))), 1.0, rtol=1e-14)
