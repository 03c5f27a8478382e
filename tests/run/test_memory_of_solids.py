"""Solids with memory in a run: settings, power laws, checkpoints, and fits."""

from __future__ import annotations

import numpy as np
import pytest
from pipe_cells import MEAN, RADIUS, SETTINGS, pipe_job
from validation.references.power_law import creep_of_power_law

from foamprb.body.memory import complex_modulus, power_law_modulus, times_of_power_law
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic
from foamprb.run.fit import fit_job
from foamprb.run.lut import compute_lut
from foamprb.run.measured import read_measured
from foamprb.run.release import with_power_law

PRONY = "relaxation { type prony; moduli ( 200 100 ); times ( 1e-2 0.2 ); }"


def solid(text):
    return SETTINGS.replace("type neoHooke; shearModulus 300; viscosity 1;", text)


def test_the_moduli_of_a_series_are_beside_the_one_that_stays(tmp_path):
    p = pipe_job(tmp_path, solid(f"type neoHooke; shearModulus 300; {PRONY}")).cloud.particles
    assert p.mu[0] == 600.0
    np.testing.assert_allclose(p.memoryShares[0], [1.0 / 3.0, 1.0 / 6.0])
    np.testing.assert_allclose(p.memoryRates[0], [100.0, 5.0])


def test_the_series_of_a_power_law_has_its_modulus(tmp_path):
    """From 1/endTime to 1/deltaT, of k and α of each particle, and any frequency of reference."""
    distributed = "alpha { type uniform; uniformDistribution { minValue 0.2; maxValue 0.6; } }"
    text = f"type powerLaw; k 100; {distributed} referenceFrequency 10; viscosity 0.5;"
    p = pipe_job(tmp_path, solid(text)).cloud.particles
    omega = np.geomspace(1.0 / 2.0, 1.0 / 2e-3, 20)
    assert np.ptp(p.k) > 0.2
    for row in (0, 20, 36):
        G = p.memoryShares[row] * p.mu[row]
        stays = p.mu[row] - G.sum()
        ours = complex_modulus(omega, stays, G, 1.0 / p.memoryRates[row], p.eta[row])
        law = 100.0 * 10.0 ** -p.k[row] * power_law_modulus(omega, p.k[row]) + 0.5j * omega
        np.testing.assert_allclose(ours, law, rtol=6e-3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("type neoHooke; shearModulus 1; relaxation { type prony; moduli ( 1 2 ); times ( 1 ); }",
         "has 2 moduli and 1 times. Allowed: as many of both, 1 to 10"),
        ("type neoHooke; shearModulus 1; relaxation { type prony; moduli ( 1 ); times ( -1 ); }",
         "has the modulus or time -1. Allowed: numbers > 0"),
        ("type drop; surfaceTension 1; viscosity 1; relaxation { type prony; moduli ( 1 ); times ( 1 ); }",
         "gives relaxation, which the solid drop does not have"),
        ("type powerLaw; k 1;", "alpha is missing"),
        ("type powerLaw; k 1; alpha 1.2;", "a number > 0 and < 1"),
        ("type powerLaw; k 1; alpha 0.5; shearModulus 3;", "gives shearModulus, which the solid powerLaw"),
        ("type neoHooke; shearModulus 1; k 1;", "gives k, which the solid neoHooke does not have"),
    ],
)  # fmt: skip
def test_mistakes_are_reported(tmp_path, text, message):
    with pytest.raises(InputError) as error:
        pipe_job(tmp_path, solid(text))
    assert message in str(error.value)


# --- Power laws against the exact creep of small strains ----------------------------------------------------


def test_a_sphere_of_a_power_law_creeps_as_its_fractional_equation_says():
    """To the error of the series, at times from a hundredth to all of its range."""
    rate, times = 1e-5, np.array([0.1, 0.3, 1.0, 3.0, 10.0])
    p = spheres([(0.0, 0.0, 0.0)], d=2.0, rho=1e-6, mu=1.0)
    p = with_power_law(p, np.array([3.0]), np.array([0.4]), times_of_power_law(0.01, 10.0), 1.0)
    medium, models = Medium(1.0, 1e-6, (0.0, 0.0, 0.0)), Models(integrator="stokes", tolerance=1e-6)
    cloud = Cloud(p, analytic.extension(rate), medium, (), 0.01, models, threads=1)
    for t, expected in zip(times, rate * creep_of_power_law(times, 3.0, 0.4).real, strict=True):
        cloud.advance(round(t / cloud.dt) - cloud.step)
        assert np.log(cloud.particles.F[0, 0]) == pytest.approx(expected, rel=3e-3)


def test_power_laws_are_recovered_from_creep(tmp_path):
    """Strain and angle are those of small strains of the exact law, along the paths from the release on."""
    text = solid("type powerLaw; k 5e4; alpha 0.4;").replace("deltaT 2e-3", "deltaT 1e-3")
    job = pipe_job(tmp_path, text)
    random, n = np.random.default_rng(0), 24
    k, alpha = 5e4 * np.exp(random.normal(0.0, 0.4, n)), random.uniform(0.25, 0.6, n)
    y, sheared = random.uniform(4e-5, 8e-5, n), random.uniform(6.0, 14.0, n)
    rate, u = 4.0 * MEAN * y / RADIUS**2, 2.0 * MEAN * (1.0 - (y / RADIUS) ** 2)
    x = 1e-6 + sheared * u / rate
    c = 0.5j * rate * creep_of_power_law(sheared / rate, k, alpha, rate)
    table = {"x": x, "y": y, "d": np.full(n, 15e-6), "strain": 2.0 * np.abs(c), "angle": 0.5 * np.angle(c)}
    fits = fit_job(job, read_measured(table), ("k", "alpha"), "x")
    assert fits.fitted.all(), fits.reasons
    np.testing.assert_allclose(fits.table["k"], k, rtol=0.02)
    np.testing.assert_allclose(fits.table["alpha"], alpha, rtol=0.02)


def test_a_property_that_the_solid_does_not_have_is_refused(tmp_path):
    job = pipe_job(tmp_path, solid("type powerLaw; k 5e4; alpha 0.4;"))
    measured = read_measured({"y": [5e-5], "d": [15e-6], "strain": [0.1]})
    with pytest.raises(InputError, match=r"the solid powerLaw has no such property. Allowed: k, alpha"):
        fit_job(job, measured, ("shearModulus",), "x=1e-3")
    with pytest.raises(InputError, match=r"-moduli of shearModulus: the solid powerLaw has no such"):
        compute_lut(job, (7e-6, 8e-6), (1e2, 1e3), 2, "x=1e-3")
