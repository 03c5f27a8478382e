"""Changes of a computation that keep its result: of units, order, time, place, steps and tolerance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

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


IN_SPACE = [name for name, models in MODELS.items() if not models.surroundings]
GRADIENT = RATE * np.array([[0.2, 0.9, 0.0], [0.1, -0.5, 0.3], [0.4, 0.0, 0.3]])


STREAM = 0.01
"""Speed along y, m/s, with which the moving flow covers many radii."""


def moving_flow(x, y, z, t):
    """The linear flow, seen by someone who moves against the stream; numbers, since it is compiled."""
    y = y - 0.01 * t
    return 20.0 * x + 90.0 * y, 0.01 + 10.0 * x - 50.0 * y + 30.0 * z, 40.0 * x + 30.0 * z


def in_space(models, Q, stream=False):
    """Bodies in a linear flow that is turned by Q or moves, seen from the frame turned or moved so."""
    p = (
        drops(PLACES @ Q.T, gamma=4e-6, eta=MU, d=2.0 * R, rho=1500.0)
        if models.material == "drop"
        else spheres(PLACES @ Q.T, mu=1.0, bulk_modulus=1e3, d=2.0 * R, rho=1500.0)
    )
    dt = 2e-7 if models.integrator == "paper" else 2e-4
    U = np.array([0.0, STREAM if stream else 0.0, 0.0])
    p.v[:] = U
    moving = analytic.function(moving_flow, length=1e-5, time=1e-2)
    flow = moving if stream else analytic.linear(Q @ GRADIENT @ Q.T)
    medium = Medium(MU, RHO, tuple(Q @ (0.0, 0.0, -9.81)))
    cloud = Cloud(p, flow, medium, (), dt, replace(models, forces=(*DEFAULT, Gravity())), threads=1)
    cloud.advance(STEPS)
    F = p.F.reshape(-1, 3, 3)
    return (p.x - STEPS * dt * U) @ Q, (p.v - U) @ Q, Q.T @ F @ F.transpose(0, 2, 1) @ Q


@pytest.mark.parametrize("name", IN_SPACE)
def test_a_turned_flow_gives_the_turned_result(name):
    """By a cyclic exchange of axes to round-off, and by an angle to the tolerance of the steps."""
    as_it_is = in_space(MODELS[name], np.eye(3))
    angle = Rotation.from_rotvec([0.3, -1.0, 0.5]).as_matrix()
    for Q, tolerance in ((np.roll(np.eye(3), 1, axis=0), 1e-9), (angle, 1e-3)):
        for one, other in zip(as_it_is, in_space(MODELS[name], Q), strict=True):
            np.testing.assert_allclose(other, one, rtol=0.0, atol=tolerance * np.abs(one).max())


@pytest.mark.parametrize("name", IN_SPACE)
def test_a_uniform_stream_carries_along_and_changes_nothing_else(name):
    at_rest = in_space(MODELS[name], np.eye(3))
    for one, other in zip(at_rest, in_space(MODELS[name], np.eye(3), stream=True), strict=True):
        np.testing.assert_allclose(other, one, rtol=0.0, atol=1e-3 * np.abs(one).max())


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
