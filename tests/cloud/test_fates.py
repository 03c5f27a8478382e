"""Bodies that rupture or release their contents: at which limit, when, and what files say."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.motion import conclude, outcome_code
from foamprb.cloud.state import REASONS, Particles, Reason, Status, drops, spheres
from foamprb.cloud.surroundings.fates import FateLimits, Fates
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

MU, RATE, DT = 1e-3, 10.0, 1e-3
STRESS = MU * np.sqrt(3.0) * RATE
WATER = Medium(MU, 1000.0, (0.0, 0.0, 0.0))


def fluid_like(n=1, mu=1e-9):
    """Bodies that deform as the fluid does: as viscous, with hardly an elasticity."""
    return spheres(np.zeros((n, 3)), d=1e-5, rho=1000.0, mu=mu, eta=MU, poissons_ratio=0.4999)


def carried(p, calls=(100,), integrator="stokes", stride=1, **fates):
    flow = analytic.linear(np.diag([RATE, -0.5 * RATE, -0.5 * RATE]))
    models = Models(integrator=integrator, surroundings=(Fates(**fates),), stride=stride)
    cloud = Cloud(p, flow, WATER, [], DT, models, threads=1)
    for steps in calls:
        cloud.advance(steps)
    return p


@pytest.mark.parametrize(("integrator", "stride"), [("rosenbrock", 8), ("stokes", 1)])
def test_a_body_ruptures_at_a_known_extension(integrator, stride):
    """At ln λ/ε̇, to Δt; a stiff one does not reach the stretch, and its dose is μ γ̇ t."""
    p = carried(
        fluid_like(2, mu=np.array([1e-9, 1.0])), (100,), integrator, stride, ruptured=FateLimits(stretch=2)
    )
    assert (p.status[0], p.reason[0]) == (Status.RUPTURED, Reason.STRETCH_REACHED)
    assert 0.0 <= p.t[0] - np.log(2.0) / RATE < 1.001 * DT
    assert np.exp(RATE * p.t[0]) == pytest.approx(p.F[0, 0], rel=1e-3)
    assert (p.status[1], p.reason[1]) == (Status.ACTIVE, Reason.NONE)
    assert p.substeps[1] < 1.0 or stride == 1
    assert p.dose[1] == pytest.approx(STRESS * 0.1, rel=1e-9)


def test_the_first_limit_that_is_reached_counts():
    """Elastic stress after von Mises, μ_s (λ² − 1/λ), before the stretch; calls change nothing."""
    runs = [
        carried(fluid_like(2, mu=np.array([1e-9, 0.01])), calls, ruptured=FateLimits(stress=0.01),
                released=FateLimits(dose=0.05 * STRESS))
        for calls in ((100,), (17, 1, 82))
    ]  # fmt: skip
    p = runs[0]
    assert [*p.status] == [Status.RELEASED, Status.RUPTURED]
    assert [*p.reason] == [Reason.DOSE_REACHED, Reason.STRESS_REACHED]
    assert 0.0 <= p.t[0] - 0.05 < 1.001 * DT
    stretch = p.F[1, 0]
    assert 0.01 * (stretch**2 - 1.0 / stretch) == pytest.approx(0.01, rel=4.0 * RATE * DT)
    for name, one, other in zip(Particles._fields, *runs, strict=True):
        np.testing.assert_array_equal(one, other, err_msg=name)


def test_codes_hold_status_and_reason():
    assert max(Reason) < 16
    assert set(REASONS) == set(Reason)
    s = type("Lanes", (), {"status": [1], "reason": [0]})
    conclude(s, 0, outcome_code(Status.RELEASED, Reason.DOSE_REACHED))
    assert (s.status[0], s.reason[0]) == (Status.RELEASED, Reason.DOSE_REACHED)


def test_bad_limits_are_refused():
    with pytest.raises(InputError, match=r"has no limit\. Allowed: stretch, stress, shearStress, dose"):
        FateLimits()
    with pytest.raises(InputError, match=r"has no fate\. Allowed: ruptured, released"):
        Fates()
    with pytest.raises(InputError, match="not paper"):
        carried(fluid_like(), integrator="paper", ruptured=FateLimits(stretch=2.0))
    p = drops(np.zeros((1, 3)), d=1e-5, rho=1000.0, gamma=1e-3, eta=MU)
    models = Models(material="drop", surroundings=(Fates(ruptured=FateLimits(stress=1.0)),))
    with pytest.raises(InputError, match="the limit stress of a fate holds for solids"):
        Cloud(p, analytic.shear(1.0), WATER, [], DT, models)
    assert str(Fates(ruptured=FateLimits(stretch=2.0, dose=3.0))) == "(ruptured (stretch 2 dose 3))"
