"""Forces on the barycentre: their sum, and that a new one is a declaration and a name in the registry."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
import pytest
from paths import ROOT
from pipe_case import copy_of_pipe, edit

from foamprb import (
    Cloud,
    Gravity,
    InputError,
    Medium,
    Models,
    PressureGradient,
    VirtualMass,
    analytic,
    spheres,
)
from foamprb.cloud.forces.base import Force, Inputs
from foamprb.cloud.forces.registry import FORCES
from foamprb.cloud.forces.total import coefficients, compose
from foamprb.dictionary.constraints import Positive
from foamprb.run.job import prepare

MU_F, RHO_F, RHO, R = 1e-3, 1000.0, 1500.0, 1e-4
G, DU_DT = (0.3, -9.81, 1.0), (4.0, 5.0, -6.0)


def thrust(_inputs: Inputs, a, share):
    """The acceleration a along the first axis, and ``share`` of it along the second."""
    return (a, share * a, 0.0), 0.0


@dataclass(frozen=True, kw_only=True)
class Thrust(Force):
    a: Annotated[float, Positive]
    share: float = 0.0

    push: ClassVar = staticmethod(thrust)


@pytest.fixture
def with_thrust(monkeypatch):
    monkeypatch.setitem(FORCES, "thrust", Thrust)


def summed(*forces):
    """Force and inertia per mass, and what the drag balances without inertia, of plain numbers."""
    given = coefficients(forces)
    inputs = Inputs(1.1, RHO, DU_DT, Medium(MU_F, RHO_F, G, given))
    bound = compose(forces)
    push, inertia = bound["pushes"](inputs, given)
    return np.array(push), inertia, np.array(bound["slips"](inputs, given))


def test_forces_are_those_of_maxey_and_riley():
    s, g, Du = 1.1 * RHO_F / RHO, np.array(G), np.array(DU_DT)
    push, inertia, slip = summed()
    assert (push.tolist(), inertia, slip.tolist()) == ([0.0] * 3, 1.0, [0.0] * 3)
    push, inertia, slip = summed(Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))
    np.testing.assert_allclose(push, (1 - s) * g + s * Du + 0.5 * s * Du, rtol=1e-14)
    assert inertia == pytest.approx(1 + 0.5 * s, rel=1e-15)
    # With dv/dt = Du/Dt in the equation of motion.
    np.testing.assert_allclose(slip, push - inertia * Du, rtol=1e-14)


@pytest.mark.parametrize(
    "forces", [(Thrust(a=2.0, share=3.0), Gravity()), (Gravity(), Thrust(a=2.0, share=3.0))]
)
def test_sum_does_not_depend_on_the_order(forces):
    push, inertia, slip = summed(*forces)
    expected = (1 - 1.1 * RHO_F / RHO) * np.array(G) + [2.0, 6.0, 0.0]
    np.testing.assert_allclose(push, expected, rtol=1e-14)
    # Without a function of its own, a force is balanced by the drag as it is.
    np.testing.assert_allclose(slip, expected, rtol=1e-14)
    assert inertia == 1.0


@pytest.mark.parametrize("integrator", ["paper", "rosenbrock", "stokes"])
def test_force_that_is_added_acts_with_every_integrator(integrator, with_thrust):
    """A sphere in a fluid at rest comes to the speed a m/(6πμR) = 2 a ρ_s R²/(9 μ)."""
    a, share = 3.0, 0.25
    p = spheres([[0.0, 0.0, 0.0]], d=2 * R, rho=RHO, mu=1e3)
    models = Models(integrator=integrator, forces=(VirtualMass(Cvm=0.5), Thrust(a=a, share=share)))
    tau = 2 * RHO * R**2 / (9 * MU_F)
    # The paper's scheme is not stable beyond 1.5 τ_s = ρ_s R²/(10 μ).
    dt = 0.2 * tau
    cloud = Cloud(p, analytic.linear(np.zeros((3, 3))), Medium(MU_F, RHO_F, G), (), dt, models, threads=1)
    cloud.advance(300)
    np.testing.assert_allclose(p.v[0], [a * tau, share * a * tau, 0.0], rtol=1e-9, atol=1e-18)


def test_force_that_is_added_is_an_entry_of_the_settings(tmp_path, with_thrust):
    """With its own entries, and messages about them; the cloud has it in the order of the registry."""
    case = copy_of_pipe(tmp_path)
    edit(case, r"^\s+gravity;", "thrust { a 100; } gravity;")
    job = prepare(case)
    assert list(job.settings.forces) == ["gravity", "thrust"]
    assert job.cloud.models.forces == (Gravity(), Thrust(a=100.0))
    assert str(Thrust(a=100.0)) == "(a 100, share 0)"
    for wrong, message in {
        "thrust { a -1; }": "particleForces/thrust/a is '-1'. Allowed: a number > 0",
        "thrust;": "particleForces/thrust/a is missing",
        "thrst { a 1; }": "particleForces/thrst is not known. Did you mean 'thrust'",
    }.items():
        edit(case, r"^thr.*gravity;", f"{wrong} gravity;")
        with pytest.raises(InputError, match=message):
            prepare(case)


def test_pages_name_every_force():
    settings, page = (ROOT / "docs" / name for name in ("settings.md", "models/forces.md"))
    for name in FORCES:
        assert f"| `particleForces/{name}` |" in settings.read_text()
        assert f"| `{name}` |" in page.read_text()
