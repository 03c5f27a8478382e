"""The stress of a dilute suspension, against Einstein."""

from __future__ import annotations

import numpy as np
from observing import WATER, observe, table

from foamprb import analytic
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.suspension_stress import SuspensionStress


def test_suspension_of_rigid_spheres_is_einsteins(tmp_path):
    """[η] = 5/2 and S = 5 μ_f V d_f, whatever the sizes and the flow."""
    L = np.array([[0.2, 1.0, 0.0], [0.0, -0.3, 0.5], [0.0, 0.0, 0.1]])
    radii = np.array([1e-6, 2e-6, 3e-6, 4e-6])
    p = spheres(np.zeros((4, 3)), d=2 * radii, rho=1e3, mu=WATER.mu * 1e5)
    p.injector[:] = [0, 0, 1, 1]
    cloud = Cloud(p, analytic.linear(L), WATER, (), 0.01, Models(integrator="stokes"))
    observe(cloud, SuspensionStress(), tmp_path, writes=(10, 20))
    rows = table(tmp_path / "f/suspensionStress.csv")
    assert [(row["time"], row["injector"], row["parcels"]) for row in rows] == [
        ("0.1", "one", "2"), ("0.1", "two", "2"), ("0.2", "one", "2"), ("0.2", "two", "2")
    ]  # fmt: skip
    d = (L + L.T) / 2
    for row in rows:
        np.testing.assert_allclose(float(row["intrinsicViscosity"]), 2.5, rtol=1e-4)
        found = [float(row[name]) for name in ("Sxx", "Syy", "Szz", "Sxy", "Syz", "Sxz")]
        expected = 5 * WATER.mu * d[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
        np.testing.assert_allclose(found, expected, atol=1e-4 * WATER.mu)
    own = radii[:2] if rows[0]["injector"] == "one" else radii[2:]
    np.testing.assert_allclose(float(rows[0]["volume"]), np.sum(4 / 3 * np.pi * own**3), rtol=1e-6)


def test_intrinsic_viscosity_of_soft_bodies_is_their_dissipation(tmp_path):
    """S:d/(2 μ_f d:d) with all nine components; the stress of a soft body is no multiple of d."""
    L = np.array([[0.2, 1.0, 0.0], [0.0, -0.3, 0.5], [0.0, 0.0, 0.1]])
    p = spheres(np.zeros((2, 3)), d=np.array([2e-6, 5e-6]), rho=1e3, mu=WATER.mu)
    cloud = Cloud(p, analytic.linear(L), WATER, (), 0.01, Models(integrator="stokes"))
    observe(cloud, SuspensionStress(), tmp_path, writes=(100,))
    row = table(tmp_path / "f/suspensionStress.csv")[0]
    xx, yy, zz, xy, yz, xz = (float(row[name]) for name in ("Sxx", "Syy", "Szz", "Sxy", "Syz", "Sxz"))
    S, d = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), (L + L.T) / 2
    assert np.linalg.norm(S / np.linalg.norm(S) - d / np.linalg.norm(d)) > 0.1
    expected = np.sum(S * d) / (2 * WATER.mu * np.sum(d * d))
    np.testing.assert_allclose(float(row["intrinsicViscosity"]), expected, rtol=1e-4)
