"""Forces on the barycentre: their sum, and that a new one is a declaration and a name in the registry."""

from __future__ import annotations

from dataclasses import dataclass
from types import FunctionType
from typing import Annotated, ClassVar

import numpy as np
import pytest
from paths import ROOT
from pipe_case import copy_of_pipe, edit
from strategies import flat

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
from foamprb.body.slip import balanced_slip
from foamprb.cloud.block import ROWS, LocalMedium, at
from foamprb.cloud.forces import FORCES, Force, Inputs, coefficients, compose, forces_on
from foamprb.cloud.layout import LANES
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

    evaluate: ClassVar = staticmethod(thrust)


@pytest.fixture
def with_thrust(monkeypatch):
    monkeypatch.setitem(FORCES, "thrust", Thrust)


def summed(*forces, Du_Dt=DU_DT):
    """Force and inertia per mass, of plain numbers."""
    inputs = Inputs(1.1, RHO, Du_Dt, LocalMedium(MU_F, RHO_F, G, coefficients(forces)))
    push, inertia = compose(forces)(None, 0, inputs)
    return np.array(push), inertia


def test_forces_are_those_of_maxey_and_riley():
    s, g, Du = 1.1 * RHO_F / RHO, np.array(G), np.array(DU_DT)
    push, inertia = summed()
    assert (push.tolist(), inertia) == ([0.0] * 3, 1.0)
    push, inertia = summed(Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))
    np.testing.assert_allclose(push, (1 - s) * g + s * Du + 0.5 * s * Du, rtol=1e-14)
    assert inertia == pytest.approx(1 + 0.5 * s, rel=1e-15, abs=0.0)


@pytest.mark.parametrize("with_pressure", [False, True])
def test_slip_is_that_of_maxey_and_riley_to_first_order(with_pressure):
    """A sphere's velocity relative to the fluid, from the forces as the integrator adds them up.

    m (1 + C s)(Du/Dt + l·w) = Σ f − μ_f K·(v − u), with w where the fluid is not accelerated.
    """
    forces = (Gravity(), VirtualMass(Cvm=0.5), *([PressureGradient()] if with_pressure else []))
    block = np.zeros(ROWS * LANES)
    block[at.rho * LANES] = RHO
    medium = Medium(MU_F, RHO_F, G, coefficients(forces))
    bound = FunctionType(forces_on.__code__, forces_on.__globals__ | {"sum_of_forces": compose(forces)})
    steady, push, inertia = bound(block, 0, medium, 1.1, DU_DT)
    np.testing.assert_allclose(steady, summed(*forces, Du_Dt=(0.0, 0.0, 0.0))[0], rtol=1e-14)
    rate, l = 40.0, np.array([[0.0, 3.0, 0.0], [0.0, 0.0, 1.0], [2.0, 0.0, 0.0]])
    rates = (rate, rate, rate)
    slip = balanced_slip(flat(np.eye(3)), rates, steady, push, inertia, DU_DT, flat(l))
    s = 1.1 * RHO_F / RHO
    w = (1 - s) * np.array(G) / rate
    assert inertia == pytest.approx(1 + 0.5 * s, rel=1e-15, abs=0.0)
    expected = w + ((with_pressure * s - 1) * np.array(DU_DT) - (1 + 0.5 * s) * l @ w) / rate
    np.testing.assert_allclose(slip, expected, rtol=1e-13)


@pytest.mark.parametrize(
    "forces", [(Thrust(a=2.0, share=3.0), Gravity()), (Gravity(), Thrust(a=2.0, share=3.0))]
)
def test_sum_does_not_depend_on_the_order(forces):
    push, inertia = summed(*forces)
    expected = (1 - 1.1 * RHO_F / RHO) * np.array(G) + [2.0, 6.0, 0.0]
    np.testing.assert_allclose(push, expected, rtol=1e-14)
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


@pytest.mark.parametrize("tolerance", [1e-4, 1e-5])
def test_a_sphere_like_the_fluid_goes_round_with_it_to_the_tolerance(tolerance):
    """A piece of a rotating fluid: the forces turn with it, and their error is a share of its way at most."""
    spin, turned = 50.0, 5.0
    p = spheres([[1e-2, 0.0, 0.0]], d=2e-4, rho=1000.0, mu=1e3)
    p.v[0] = 0.0, 1e-2 * spin, 0.0
    forces = (Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))
    models = Models(integrator="rosenbrock", tolerance=tolerance, forces=forces)
    flow = analytic.linear(spin * np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]))
    cloud = Cloud(p, flow, Medium(1e-3, 1000.0, (0.0, 0.0, 0.0)), (), 1e-3, models)
    cloud.advance(round(turned / spin / cloud.dt))
    assert np.hypot(*p.x[0, :2]) == pytest.approx(1e-2, rel=turned * tolerance)
