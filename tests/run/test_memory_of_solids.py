"""Solids with memory in a run: settings, power laws, checkpoints, and fits."""

from __future__ import annotations

import logging
import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from pipe_case import copy_of_pipe
from pipe_cells import MEAN, RADIUS, SETTINGS, pipe_job
from validation.references.power_law import creep_of_power_law

from foamprb.body.memory import (
    complex_modulus,
    power_law_modulus,
    range_of_power_law,
    series_of_power_law,
    times_of_power_law,
)
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic
from foamprb.run.fit import fit_job
from foamprb.run.job import prepare
from foamprb.run.log import log_description
from foamprb.run.lut import compute_lut
from foamprb.run.measured import read_measured
from foamprb.run.release import with_power_law
from foamprb.run.restart import fingerprint, refuse_changes

PRONY = "relaxation { type prony; moduli ( 200 100 ); times ( 1e-2 0.2 ); }"


def solid(text):
    return SETTINGS.replace("type neoHooke; shearModulus 300; viscosity 1;", text)


def test_a_power_law_holds_up_to_the_shear_rate_of_the_flow(tmp_path):
    """The wall shear rate of the pipe is 924 1/s, of which deltaT, 0.01 s, says nothing."""
    case = copy_of_pipe(tmp_path)
    text = solid("type powerLaw; k 100; alpha 0.3;").replace("-9e-5", "-1.9e-3").replace("9e-5", "1.9e-3")
    (case / "constant/softCloudProperties").write_text(text.replace("deltaT 2e-3", "deltaT 1e-2"))
    rates = prepare(case).cloud.particles.memoryRates[0]
    assert range_of_power_law(1.0 / rates)[1] > 0.95 * 924.0
    # A flow without nodes: the warning says the shear rate where particles start.
    job = pipe_job(tmp_path / "pipe", solid("type powerLaw; k 100; alpha 0.3;").replace("2e-3;", "2e-2;"))
    (warning,) = [text for text in job.description["warnings"] if "power law" in text]
    assert "the shear rate at particles is up to 180 1/s" in warning
    assert "holds up to 50 1/s, that is 1/deltaT. Needed: deltaT up to 0.0056." in warning


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


def test_the_series_of_a_wide_range_is_a_passive_solid():
    """Ten times are few for nine decades, but no modulus and no viscosity is negative."""
    series = series_of_power_law(np.linspace(0.02, 0.98, 49), times_of_power_law(1e-6, 1e3))
    for values in series:
        assert (values > 0.0).all()


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


def test_a_fit_finds_the_modulus_that_stays(tmp_path):
    """From the strains of stiff cells in a steady shear, by the complex modulus (Roscoe 1967)."""
    relaxing, times = np.array([4e4, 2e4]), np.array([1e-3, 1e-2])
    text = (
        "type neoHooke; shearModulus 3e4; relaxation { type prony; moduli ( 4e4 2e4 ); times ( 1e-3 1e-2 ); }"
    )
    job = pipe_job(tmp_path, solid(text))
    stays, y = np.array([2e4, 3e4, 5e4]), np.array([3e-5, 5e-5, 7e-5])
    rate = 4.0 * MEAN * y / RADIUS**2
    G = np.array([complex_modulus(*one, relaxing, times) for one in zip(rate, stays, strict=True)])
    strain = np.abs(5.0 * rate / (2.0 * G + 3j * rate))
    measured = read_measured({"y": y, "d": np.full(3, 15e-6), "strain": strain})
    fits = fit_job(job, measured, ("shearModulus",), "x=2e-3")
    assert fits.fitted.all(), fits.reasons
    np.testing.assert_allclose(fits.table["shearModulus"], stays, rtol=0.02)


def test_the_log_tells_the_error_of_a_power_law(tmp_path, caplog):
    """From 1/endTime to 1/deltaT, of 2 s and 2 ms."""
    with caplog.at_level(logging.INFO, "foamprb"):
        log_description(pipe_job(tmp_path, solid("type powerLaw; k 82; alpha 0.44;")))
    found = re.search(r"power law \[1/s\] +within (\S+) % from (\S+) to (\S+)$", caplog.text, re.MULTILINE)
    assert found is not None
    error, low, high = map(float, found.groups())
    assert 0.0 < error < 0.5
    assert (low, high) == pytest.approx((0.5, 500.0), rel=0.01)
    assert "the power law holds" not in caplog.text


def test_a_range_too_wide_for_a_power_law_is_a_warning(tmp_path, caplog):
    text = solid("type powerLaw; k 82; alpha 0.44;").replace("deltaT 2e-3", "deltaT 2e-9")
    log_description(pipe_job(tmp_path, text))
    assert "the power law holds within 4.1 % only, as endTime is 1e+09 deltaT." in caplog.text


def test_a_property_that_the_solid_does_not_have_is_refused(tmp_path):
    job = pipe_job(tmp_path, solid("type powerLaw; k 5e4; alpha 0.4;"))
    measured = read_measured({"y": [5e-5], "d": [15e-6], "strain": [0.1]})
    with pytest.raises(InputError, match=r"the solid powerLaw has no such property. Allowed: k, alpha"):
        fit_job(job, measured, ("shearModulus",), "x=1e-3")
    with pytest.raises(InputError, match=r"-moduli of shearModulus: the solid powerLaw has no such"):
        compute_lut(job, (7e-6, 8e-6), (1e2, 1e3), 2, "x=1e-3")


def test_an_extended_run_of_a_power_law_is_refused_with_the_cause(tmp_path):
    text = solid("type powerLaw; k 82; alpha 0.44;")
    job, longer = (pipe_job(tmp_path, t) for t in (text, text.replace("endTime 2;", "endTime 4;")))
    stored: Any = SimpleNamespace(header={"fingerprint": fingerprint(job.settings, job.cloud)})
    with pytest.raises(InputError, match="The relaxation times of a powerLaw follow from deltaT and endTime"):
        refuse_changes(stored, fingerprint(longer.settings, longer.cloud), "case")
