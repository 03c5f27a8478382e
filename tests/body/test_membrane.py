"""Membranes that slide under their tangential load, against the balance that their table was made of."""

from __future__ import annotations

import numpy as np
import pytest
from figures import membrane as balance
from scipy.spatial.transform import Rotation
from strategies import flat, square

from foamprb.body.material import MATERIALS, modulus_of_capsule
from foamprb.body.membrane import (
    LARGEST_STRETCH,
    WITHIN,
    law_of,
    least_tensions,
    name_of,
    poissons_ratio_of,
    product_of_invariants,
)

NEO_HOOKE, SKALAK = ("neoHookean", 0.0), ("Skalak", 3.0)


def stress(law, b, J=1.0, lame=0.0):
    """T of a capsule with G_s = 1 N/m and R = 1 m."""
    mu = modulus_of_capsule(1.0, poissons_ratio_of(*law), 1.0)
    return square(MATERIALS[name_of(*law)].stress(flat(b), J, mu, lame, 0.0))


@pytest.mark.parametrize(
    ("law", "h", "expected"),
    [
        (NEO_HOOKE, (0.25, -0.33, 0.08), (0.42944, -0.33149, -0.09794)),
        (NEO_HOOKE, (0.45, -0.6, 0.15), (1.20639, -0.88899, -0.31740)),
        (("Skalak", 1.0), (0.3, -0.4, 0.1), (0.74386, -0.62356, -0.12031)),
        (("Skalak", 10.0), (0.3, -0.31, 0.01), (1.36079, -1.19442, -0.16637)),
    ],
)
def test_the_stress_is_that_of_the_balance(law, h, expected):
    """T of membranes.py by an independent program."""
    T = np.diag(stress(law, np.diag(np.exp(2.0 * np.array(h)))))
    np.testing.assert_allclose(T, expected, atol=1e-3 * np.linalg.norm(expected))


def test_a_membrane_between_those_of_the_table_is_that_of_the_balance():
    """Of C = 3, which has no row; the script of the table also computes the tensions."""
    h, membrane = np.array([0.3, -0.4, 0.1]), balance.Membrane(balance.skalak(3.0))
    q = np.zeros(membrane.n_unknowns)
    for share in np.linspace(0.2, 1.0, 5):
        q = membrane.slide(q, share * h)
    T, F = membrane.stress(q, h), np.diag(np.exp(h))
    np.testing.assert_allclose(np.diag(stress(SKALAK, F @ F)), T, atol=2e-3 * np.linalg.norm(T))
    assert least_tensions(F.reshape(1, 9), *SKALAK)[0] == pytest.approx(
        membrane.tensions(q, h).min(), abs=0.02
    )


def test_a_row_of_the_table_comes_from_its_script():
    """Its first two sizes in the first direction; the whole table takes minutes."""
    membrane = balance.Membrane(balance.neo_hookean)
    for _, (h, T, least) in zip(range(2), membrane.table(), strict=False):
        F = np.diag(np.exp(h))
        np.testing.assert_allclose(np.diag(stress(NEO_HOOKE, F @ F)), T, rtol=1e-3)
        assert least_tensions(F.reshape(1, 9), *NEO_HOOKE)[0] == pytest.approx(least, abs=1e-4)


def test_a_change_of_volume_adds_a_pressure():
    R, h = Rotation.from_rotvec((0.3, -0.5, 0.8)).as_matrix(), np.array([0.3, -0.2, -0.1])
    b, J = R @ np.diag(np.exp(2.0 * h)) @ R.T, 1.03
    T = stress(SKALAK, b)
    np.testing.assert_allclose(T, R @ stress(SKALAK, np.diag(np.exp(2.0 * h))) @ R.T, atol=1e-12)
    np.testing.assert_allclose(
        stress(SKALAK, b * J ** (2.0 / 3.0), J, 5.0), T + 5.0 * np.log(J) * np.eye(3), atol=1e-12
    )
    assert np.trace(T) == pytest.approx(0.0, abs=1e-12)


def test_tables_end_at_the_largest_stretch():
    for s in (LARGEST_STRETCH, 1.0 / LARGEST_STRETCH):
        F = np.diag([s, s**-0.5, s**-0.5])
        assert product_of_invariants(flat(F)) == pytest.approx(WITHIN, rel=1e-3)
        assert np.isfinite(least_tensions(F.reshape(1, 9), *NEO_HOOKE))


def test_names_of_membranes_have_their_law():
    for law in (NEO_HOOKE, SKALAK, ("Skalak", 1e-5)):
        assert law_of(name_of(*law)) == law
        assert MATERIALS[name_of(*law)].slides
    for wrong in ("capsule", "capsule Skalak", "capsule Skalak 60", "capsule Skalak x", "steel"):
        with pytest.raises(KeyError):
            law_of(wrong)
