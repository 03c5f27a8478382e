"""Changes of a computation that keep its result: of units, order, time, place, steps and tolerance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import DEFAULT, Gravity
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import drops, spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic

pytestmark = pytest.mark.nightly
R, MU, RHO, RATE, STEPS = 2e-6, 1e-3, 1000.0, 100.0, 40
MODELS = {
    "stokes": Models(integrator="stokes"),
    "rosenbrock": Models(integrator="rosenbrock"),
    "paper": Models(integrator="paper"),
    "quadratic": Models(integrator="stokes", shape="quadratic"),
    "drop": Models(integrator="stokes", material="drop"),
    "lift": Models(integrator="stokes", surroundings=(FaxenCorrection(), WallLift())),
    "slip": Models(integrator="rosenbrock", surroundings=(SaffmanMeiLift(),)),
}
PLACES = np.array([(0.0, 0.0, h * R) for h in (1.5, 4.0, 9.0, 20.0)])


def advanced(models, length=1.0, time=1.0, mass=1.0, start=0.0, shift=0.0, order=slice(None), parts=1):
    """Bodies in shear over a wall, in units that are larger by factors; ``parts`` divides the time step."""
    density, stress = mass / length**3, mass / (length * time**2)
    place = np.array([shift, 0.0, 0.0])
    x = ((PLACES + place) * length)[order]
    common = {"d": 2.0 * R * length, "rho": 1500.0 * density, "t0": start * time}
    if models.material == "drop":
        p = drops(x, gamma=4e-6 * stress * length, eta=MU * stress * time, **common)
    else:
        p = spheres(x, mu=1.0 * stress, bulk_modulus=1e3 * stress, **common)
    medium = Medium(MU * stress * time, RHO * density, (0.0, 0.0, -9.81 * length / time**2))
    dt = (2e-7 if models.integrator == "paper" else 2e-4) * time / parts
    models = replace(models, forces=(*DEFAULT, Gravity()))
    flow = analytic.shear_over_wall(RATE / time)
    cloud = Cloud(p, flow, medium, [Rebound()], dt, models, threads=1, start=start * time)
    cloud.advance(STEPS * parts)
    return p.x / length - place, p.v * time / length, p.F


@pytest.mark.parametrize("name", MODELS)
def test_units_change_no_bit(name):
    """Powers of two, as lengths in units of 8 m, times of 1/4 s and masses of 32 kg."""
    for one, other in zip(advanced(MODELS[name]), advanced(MODELS[name], 8.0, 0.25, 32.0), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("name", MODELS)
def test_the_order_of_particles_changes_no_bit(name):
    order = np.array([2, 0, 3, 1])
    for one, other in zip(advanced(MODELS[name]), advanced(MODELS[name], order=order), strict=True):
        np.testing.assert_array_equal(one[order], other)


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("change", [{"start": 1.0}, {"shift": 1e-3}])
def test_a_later_start_and_another_place_change_round_off_only(name, change):
    for one, other in zip(advanced(MODELS[name]), advanced(MODELS[name], **change), strict=True):
        np.testing.assert_allclose(other, one, rtol=1e-9, atol=1e-9 * np.abs(one).max())


@pytest.mark.parametrize("name", MODELS)
def test_shorter_steps_and_a_smaller_tolerance_change_what_errors_allow(name):
    """Of integrators with error control by the tolerance, of the paper's by its first order."""
    whole, short = advanced(MODELS[name]), advanced(MODELS[name], parts=10)
    small = advanced(replace(MODELS[name], tolerance=0.1 * Models.tolerance))
    for one, *others in zip(whole, short, small, strict=True):
        for other in others:
            np.testing.assert_allclose(other, one, rtol=2e-3, atol=2e-3 * np.abs(one).max())
