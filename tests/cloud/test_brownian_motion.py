"""Brownian motion in the loop: diffusion, equilibria, and numbers that depend on nothing but their number."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import kstest
from validation.references import wall as ref

from foamprb.body.brownian import BOLTZMANN
from foamprb.body.wall import normal_mobility, parallel_mobility
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import set_rest_shape, spheres
from foamprb.cloud.surroundings.base import Survey
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError, ValidityWarning
from foamprb.flow import analytic
from foamprb.flow.base import NEAR

MU_F, R, T = 1e-3, 0.5e-6, 300.0
KT = BOLTZMANN * T
D = KT / (6.0 * np.pi * MU_F * R)
WATER = Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
HEAVY = Medium(MU_F, 1000.0, (0.0, 0.0, -9.81))
RHO_OF_SCALE_R = 1000.0 + KT / (R * 9.81 * 4.0 / 3.0 * np.pi * R**3)
"""Density at which kT over the weight is R."""
STILL = analytic.linear(np.zeros((3, 3)))
STIFF = 1e4
MOLECULES = (BrownianMotion(T=T),)


def beads(n, mu=STIFF, rho=1000.0, height=0.0):
    return spheres(np.tile([0.0, 0.0, height], (n, 1)), d=2.0 * R, rho=rho, mu=mu, poissons_ratio=0.4999)


def carried(p, steps, dt, *, flow=STILL, medium=WATER, models=MOLECULES, threads=1,
            integrator="stokes", stride=1):  # fmt: skip
    chosen = Models(integrator=integrator, surroundings=models, stride=stride)
    cloud = Cloud(p, flow, medium, [Rebound()] * len(flow.patches), dt, chosen, threads=threads)
    cloud.advance(steps)
    return p


def test_a_sphere_with_inertia_diffuses_as_einstein_says():
    """Variance of each component to four times its standard error, √(2/n); no correlation."""
    n, steps, dt = 4000, 5, 1e-3
    p = carried(beads(n), steps, dt, integrator="rosenbrock", models=(BrownianMotion(T=T, shape=False),))
    moments = p.x.T @ p.x / n / (2.0 * D * steps * dt)
    np.testing.assert_allclose(moments, np.eye(3), atol=4.0 * np.sqrt(2.0 / n))
    assert np.abs(p.x.mean(axis=0)).max() < 4.0 * np.sqrt(2.0 * D * steps * dt / n)


@pytest.mark.parametrize("ratio", [3.0, 1.0 / 3.0])
def test_a_spheroid_turns_as_perrin_says(ratio):
    """The image of the axis of the rest shape, to six times the standard error."""
    n, dt = 4000, 1e-4
    p = beads(n)
    set_rest_shape(p, (ratio, 1.0, 1.0))
    axis = p.F.reshape(-1, 3, 3)[:, :, 0] / np.linalg.norm(p.F.reshape(-1, 3, 3)[:, :, 0], axis=1)[:, None]
    carried(p, 1, dt)
    _, turns = ref.perrin_rotation(ratio)
    new = p.F.reshape(-1, 3, 3)[:, :, 0]
    new /= np.linalg.norm(new, axis=1)[:, None]
    rotation = KT / (8.0 * np.pi * MU_F * R**3) / turns
    tilted = ((new - axis)[:, 1:] ** 2).mean(axis=0) / (2.0 * rotation * dt)
    assert tilted == pytest.approx([1.0, 1.0], rel=6.0 * np.sqrt(2.0 / n))


@pytest.mark.parametrize(("steps", "share", "stride"), [(200, 1, 1), (400, 8, None)])
def test_heights_over_a_wall_come_to_boltzmanns(steps, share, stride):
    """With the hindered mobility, heights come to exp(−W h/kT) in steps √(2 D Δt) of a tenth of kT/W.

    And in steps of any length, from an eighth of these on.
    """
    n = 250
    p = beads(n, rho=RHO_OF_SCALE_R)
    random = np.random.default_rng(3)
    # At equilibrium, in which it is to stay: gaps over R are exponential.
    p.x[:, 2] = R * (1.0 + random.exponential(1.0, n))
    dt = 0.5 * 0.1**2 * R**2 / D
    models = (WallLift(cutOff=20.0), BrownianMotion(T=T, shape=False))
    flow = analytic.shear_over_wall(0.0)
    carried(p, steps, dt / share, flow=flow, medium=HEAVY, models=models, stride=stride)
    gaps = p.x[:, 2] / R - 1.0
    assert gaps.mean() == pytest.approx(1.0, abs=4.0 / np.sqrt(n))
    assert kstest(np.maximum(gaps, 0.0), "expon").pvalue > 1e-3
    # Steps into the wall are reflected: no body lies on it, none is missing beside it.
    assert np.mean(gaps < 1e-9) < 1e-3
    near = n * (np.exp(-0.02) - np.exp(-0.1))
    assert np.sum((gaps > 0.02) & (gaps < 0.1)) == pytest.approx(near, abs=4.0 * np.sqrt(near))


def test_the_image_of_a_load_costs_a_stiff_bead_few_steps():
    """A stiff bead relaxes from place to place within a step; each strain by its weight is not followed."""
    p = beads(20, height=2.0 * R, rho=RHO_OF_SCALE_R)
    models = (WallLift(cutOff=20.0), BrownianMotion(T=T, shape=False))
    carried(p, 2, 0.5 * 0.09**2 * R**2 / D, flow=analytic.shear_over_wall(0.0), medium=HEAVY, models=models)
    assert p.substeps.mean() < 10.0


def test_steps_too_long_for_the_scale_of_heights_are_warned_of():
    p, model = beads(2, rho=RHO_OF_SCALE_R), BrownianMotion(T=T, shape=False)
    flow = analytic.shear_over_wall(0.0)
    assert not model.remarks(Survey(p, flow, HEAVY, 0.5 * 0.09**2 * R**2 / D)).warnings
    (warning,) = model.remarks(Survey(p, flow, HEAVY, 0.5 * 0.2**2 * R**2 / D)).warnings
    assert f"Use deltaT < {0.5 * 0.1**2 * R**2 / D:.2g}." in warning
    with pytest.warns(ValidityWarning, match="Use deltaT <"):
        carried(p, 1, 0.5 * 0.2**2 * R**2 / D, flow=flow, medium=HEAVY, models=(WallLift(cutOff=20.0), model))
    # Without weight a channel limits the steps.
    channel = analytic.pipe(10.0 * R, 0.0, 1.0)
    assert not model.remarks(Survey(p, channel, WATER, 0.5 * 1.0**2 * R**2 / D)).warnings
    assert model.remarks(Survey(p, channel, WATER, 0.5 * 2.0**2 * R**2 / D)).warnings


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
@pytest.mark.parametrize("h", [3.0, 1.3])
def test_a_sphere_near_a_wall_diffuses_with_its_hindered_mobilities(integrator, h):
    """Along and across it in a short time, with inertia as without; to four times the standard error."""
    n, dt = 250, 1e-4 * R**2 / D
    p = beads(n, height=h * R)
    models = (WallLift(cutOff=20.0), BrownianMotion(T=T, shape=False))
    carried(p, 2, dt, flow=analytic.shear_over_wall(0.0), models=models, integrator=integrator)
    moved = (p.x - [0.0, 0.0, h * R]) / np.sqrt(4.0 * D * dt)
    e = 1.0 / h
    expected = parallel_mobility(e), parallel_mobility(e), normal_mobility(e)
    assert (moved**2).mean(axis=0) == pytest.approx(expected, rel=4.0 * np.sqrt(2.0 / n))


def test_random_numbers_may_hold_for_several_tracking_steps():
    """The variance is Einstein's. Neither threads nor calls that end at ends of stretches change a bit."""
    n, dt = 1000, 1e-3
    models = (BrownianMotion(T=T, shape=False),)
    whole = carried(beads(n), 64, dt, models=models, stride=None)
    assert np.all(whole.substeps < 0.2)
    assert (whole.x**2).mean() / (2.0 * D * 64 * dt) == pytest.approx(1.0, abs=4.0 * np.sqrt(2.0 / 3.0 / n))
    p = beads(n)
    chosen = Models(integrator="stokes", surroundings=models, stride=None)
    cloud = Cloud(p, STILL, WATER, (), dt, chosen, threads=3)
    for _ in range(64 // cloud.stretch_steps):
        cloud.advance(cloud.stretch_steps)
    assert np.array_equal(whole.x, p.x)


@pytest.mark.parametrize(("gap", "fewest", "most"), [(0.2, 1.3, 2.6), (1.0, 1.3, 2.6), (30.0, 1.0, 1.0)])
def test_random_numbers_hold_while_a_body_moves_a_fifth_of_the_gap(gap, fewest, most):
    """Four tracking steps are then one step, near the wall 1.3 to 2.6, as gaps change meanwhile.

    A wall farther away than :data:`NEAR` radii is ignored.
    """
    hold = 0.5 * (0.2 * min(gap, NEAR) * R) ** 2 / D
    models, p = (BrownianMotion(T=T, shape=False),), beads(200, height=(1.0 + gap) * R)
    carried(p, 64, hold / 4.0, flow=analytic.shear_over_wall(0.0), models=models, stride=None)
    assert fewest <= 4.0 * p.substeps.mean() <= most


@pytest.mark.parametrize("ratio", [1.0, 20.0])
def test_strains_have_the_energy_of_equilibrium_in_steps_of_any_length(ratio):
    """5/2 kT, also where Δt is many times the relaxation time 3 μ_f/(2 μ_s)."""
    n, mu = 2000, 500.0
    p = carried(beads(n, mu=mu), 8, ratio * 1.5 * MU_F / mu)
    F = p.F.reshape(-1, 3, 3)
    strain = 0.5 * (F @ F.transpose(0, 2, 1) - np.eye(3))
    energy = 4.0 / 3.0 * np.pi * R**3 * mu * (strain**2).sum(axis=(1, 2))
    assert energy.mean() / KT == pytest.approx(2.5, rel=4.0 * np.sqrt(0.4 / n) + 0.01)


def test_a_first_step_that_is_short_has_the_variance_of_its_length():
    n, dt = 3000, 1e-3
    p = beads(n)
    p.t0[:] = 0.75 * dt
    carried(p, 1, dt)
    assert (p.x**2).mean() / (2.0 * D * 0.25 * dt) == pytest.approx(1.0, abs=4.0 * np.sqrt(2.0 / 3.0 / n))


def test_the_papers_integrator_is_refused():
    with pytest.raises(
        InputError, match="BrownianMotion needs the integrator stokes or rosenbrock, not paper"
    ):
        carried(beads(1), 1, 1e-4, integrator="paper")


def test_where_molecules_deform_more_than_the_flow_a_warning_says_so():
    """√(5 k_B T/(2 μ_s V)): a strain of 1 % for a radius of 1 µm and 25 Pa, of 1 where both are small."""
    model, hard, soft = BrownianMotion(T=293.15), beads(3, mu=25.0), beads(3, mu=0.1)
    hard.R[:], soft.R[:] = 1e-6, 3e-7
    assert model.remarks(Survey(hard, STILL, WATER, 1e-3)).warnings == ()
    (said,) = model.remarks(Survey(soft, STILL, WATER, 1e-3)).warnings
    assert "by a strain of 0.95 (median)" in said
    assert BrownianMotion(T=293.15, shape=False).remarks(Survey(soft, STILL, WATER, 1e-3)).warnings == ()
