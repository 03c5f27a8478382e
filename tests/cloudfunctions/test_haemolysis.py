"""Damage by power laws, against formulas on paths of known stress."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mesh_shapes import cyclic_row
from observing import (
    MEAN,
    RADIUS,
    WATER,
    column,
    go_on,
    made_steps,
    observe,
    observed,
    pipe_cloud,
    restore,
    see,
    table,
)
from scipy.integrate import quad, solve_ivp

from foamprb import analytic
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Cyclic, Stick
from foamprb.cloud.paths import step
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import FieldViscosity
from foamprb.cloud.viscosity import PowerLaw as PowerLawFluid
from foamprb.cloudfunctions.haemolysis import (
    POWER_LAWS,
    SPECIES,
    Haemolysis,
    PowerLaw,
    effective_shear_rate,
    index_of_haemolysis,
    pore_area,
    relaxed,
)
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshFlow


def test_paths_of_constant_stress(tmp_path):
    """A τ^α t^β, of particles that stay at their radii in a pipe."""
    cloud = pipe_cloud(medium=WATER)
    p = cloud.particles
    r = np.hypot(p.x[:, 1], p.x[:, 2])
    observe(cloud, Haemolysis(constants="Ding"), tmp_path)
    rows = table(tmp_path / "f/haemolysis.csv")
    A, alpha, beta = POWER_LAWS["Ding"][:3]
    tau = WATER.mu * 4.0 * MEAN * r / RADIUS**2
    np.testing.assert_allclose(column(rows, "haemolysis"), A * tau**alpha * (p.t - p.t0) ** beta, rtol=1e-5)


def test_a_path_through_coupled_patches_in_a_field_of_the_viscosity(tmp_path):
    """A step that they divide has no host at the patch."""
    mesh, rate = cyclic_row(0.0, 1), 5e4
    l = np.zeros((3, 3))
    l[0, 2] = rate
    flow = MeshFlow(
        mesh,
        mesh.nodes @ l.T,
        np.tile(l, (len(mesh.nodes), 1, 1)),
        viscosity=np.tile([2.0, 0.0, 0.0, 0.0], (len(mesh.nodes), 1)),
    )
    p = spheres([[0.6, 0.5, 0.5], [0.1, 0.4, 0.4]], d=1e-5, rho=1e3, mu=1e6)
    medium = WATER._replace(mu=FieldViscosity(factor=1e-3, mean=1.0))
    walls = [Cyclic() if patch.neighbour else Stick() for patch in flow.patches]
    cloud = Cloud(p, flow, medium, walls, 1.5e-5, Models(integrator="stokes", rebounds=True))
    observe(cloud, Haemolysis(constants="Song"), tmp_path)
    A, alpha, beta = POWER_LAWS["Song"][:3]
    damage = column(table(tmp_path / "f/haemolysis.csv"), "haemolysis")
    np.testing.assert_allclose(damage, A * (2e-3 * rate) ** alpha * cloud.time**beta, rtol=1e-5)


def test_the_constants_are_those_of_the_papers():
    """Per cent, for 255 Pa during 0.1 s; Giersiepen's is the one that is larger than experiments since."""
    t = 0.1
    found = {
        n: float(index_of_haemolysis(c, np.array(255.0 ** (c.alpha / c.beta) * t)))
        for n, c in POWER_LAWS.items()
    }
    assert found["Giersiepen"] == pytest.approx(3.62e-5 * 255**2.416 * t**0.785)
    assert found["Giersiepen"] > 2.0 > found["Zhang"] > 0.1
    assert max(found, key=lambda name: found[name]) == "Giersiepen"


def test_steps_of_a_changing_stress_converge_with_second_order(tmp_path):
    """A stress that grows as 1 + t², against the integral."""
    errors, exponent = [], POWER_LAWS["Zhang"].alpha / POWER_LAWS["Zhang"].beta
    exact = quad(lambda s: (WATER.mu * 1e4 * (1.0 + s * s)) ** exponent, 0.0, 1.0)[0]
    for n in (10, 20, 40):
        cloud, t = pipe_cloud(n=1, medium=WATER), np.linspace(0.0, 1.0, n + 1)
        cloud.particles.t[:] = 0.0
        functions = CloudFunctions({"f": Haemolysis(constants="Zhang")}, observed(cloud))
        see(cloud, made_steps(t, l=simple_shear(1e4 * (1.0 + t * t))))
        errors.append(abs(functions.state()["f/dose"][0] / exact - 1.0))
    assert errors[0] < 0.02
    np.testing.assert_allclose(np.array(errors[:-1]) / errors[1:], 4.0, rtol=0.02)


@pytest.mark.parametrize("rate", [300.0, 5000.0, 42000.0])
def test_the_shear_of_a_deformation_is_that_of_aroras_equation(rate):
    """dS/dt = −f₁(S − g I) + f₂(ES + SE) + f₃(WS − SW), until it is steady; its semi-axes are √λ(S)."""
    f1, f2 = Haemolysis(constants="Song").f1, Haemolysis(constants="Song").f2
    # For blood: Arora, Behr & Pasquali (2004), and HemTracer's.
    assert (f1, f2) == (5.0, 4.2298e-4)
    gradient = np.array([[0.0, rate, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    E, W = 0.5 * (gradient + gradient.T), 0.5 * (gradient - gradient.T)

    def slope(_, s):
        S = s.reshape(3, 3)
        second = 0.5 * (np.trace(S) ** 2 - np.trace(S @ S))
        recovery = -f1 * (S - 3.0 * np.linalg.det(S) / second * np.eye(3))
        return (recovery + f2 * (E @ S + S @ E) + f2 * (W @ S - S @ W)).ravel()

    found = solve_ivp(slope, (0.0, 10.0), np.eye(3).ravel(), method="LSODA", rtol=1e-10, atol=1e-12)
    axes = np.sqrt(np.linalg.eigvalsh(found.y[:, -1].reshape(3, 3)))
    D = (axes[2] - axes[0]) / (axes[2] + axes[0])
    assert effective_shear_rate(D, f1, f2) == pytest.approx(rate, rel=1e-6)


@pytest.mark.parametrize("name", POWER_LAWS)
def test_a_path_of_changing_stress(name, tmp_path):
    """A (∫τ^{α/β} dt)^β by quadrature, on a path whose stress is known at all times."""

    def u(x, y, z, t):
        return 400.0 * (1.0 + 0.8 * math.sin(60.0 * t)) * y, 0.0 * x, 0.0 * z

    law, end = POWER_LAWS[name], 0.1
    body = spheres(np.zeros((1, 3)), d=6e-6, rho=WATER.rho, mu=100.0)
    flow = analytic.function(u, length=1.0, time=0.1)
    cloud = Cloud(body, flow, WATER, (), 2e-4, Models(integrator="stokes"))
    observe(cloud, Haemolysis(constants=name), tmp_path, writes=(500,))
    (found,) = column(table(tmp_path / "f/haemolysis.csv"), "haemolysis")

    def stress(t):
        return WATER.mu * 400.0 * (1.0 + 0.8 * np.sin(60.0 * t))

    dose = quad(lambda t: stress(t) ** (law.alpha / law.beta), 0.0, end, epsabs=0.0, epsrel=1e-11, limit=200)[
        0
    ]
    exact = law.A * dose**law.beta
    assert found == pytest.approx(exact, rel=1e-4)


BLOOD = 3.5e-3


def simple_shear(rate):
    """Gradients of simple shear, (n, 9)."""
    l = np.zeros((len(rate), 9))
    l[:, 1] = rate
    return l


def exposed(function, periods, samples=50):
    """Per cent released by a cell at rest that goes through periods (γ̇, duration) of simple shear."""
    cloud, start = pipe_cloud(n=1), 0.0
    cloud.particles.t[:] = 0.0
    functions = CloudFunctions({"f": function}, observed(cloud))
    for rate, duration in periods:
        t = start + np.linspace(0.0, duration, samples + 1)
        see(cloud, made_steps(t, l=simple_shear(np.full(samples + 1, rate))))
        start += duration
    return float(index_of_haemolysis(function.law, functions.state()["f/dose"])[0])


@pytest.mark.parametrize(("stress", "expected"), [("morphology", 1.71148e-5), ("KelvinVoigt", 1.71072e-5)])
def test_a_cell_remembers_a_pulse(stress, expected):
    """Giersiepen's per cent on G_eff: of S by solve_ivp at 1e-9, of Kelvin and Voigt's G by quadrature.

    The fluid's stress would give 1.7e-2 % at once, and no damage after the pulse.
    """
    function = Haemolysis(constants="Giersiepen", stress=stress, mu=BLOOD)
    pulse = [(20500.0, 0.005), (0.0, 1.0)]
    assert exposed(function, pulse) == pytest.approx(expected, rel=2e-4)
    assert exposed(function, pulse, samples=3) == pytest.approx(expected, rel=2e-3)


def test_the_shear_rate_of_a_cell_follows_a_ramp():
    """dG/dt = f₁ (G_f − G) with a linear G_f, against an integrator of differential equations."""
    start, end, h, f1 = 200.0, 1400.0, 0.3, 5.0
    solution = solve_ivp(
        lambda t, G: f1 * (start + (end - start) * t / h - G), (0.0, h), [50.0], rtol=1e-10, atol=1e-10
    )
    assert relaxed(50.0, start, end, h, f1) == pytest.approx(solution.y[0, -1], rel=1e-8)


def test_pores_are_of_the_order_of_the_power_law_of_the_same_experiments():
    """Ding's, 100 Pa for 1.5 s: the constant h is of a share, not of per cent."""
    pores = exposed(Haemolysis(constants="pores", stress="KelvinVoigt", mu=BLOOD), [(100.0 / BLOOD, 1.5)])
    law = POWER_LAWS["Ding"]
    assert 1.0 < pores / (law.A * 100.0**law.alpha * 1.5**law.beta) < 3.0
    assert pore_area(np.array([3749.0, 42_000.0, 1e6])) == pytest.approx([0.0, 7.8502, 7.8502])


@pytest.mark.parametrize("stress", ["fluid", "KelvinVoigt"])
def test_pores_of_species_differ_by_their_constants(stress):
    """h τ^k, and without a memory h τ^k A_p(γ̇) t."""
    share = {
        species: exposed(Haemolysis("pores", stress, species, mu=BLOOD), [(100.0 / BLOOD, 1.5)])
        for species in ("human", "porcine")
    }
    (h, k), (h1, k1) = (
        SPECIES[species].of_stress if stress == "fluid" else SPECIES[species].of_strain
        for species in ("human", "porcine")
    )
    assert share["porcine"] / share["human"] == pytest.approx(h1 / h * 100.0 ** (k1 - k), rel=1e-12)
    if stress == "fluid":
        area = float(pore_area(np.array(100.0 / BLOOD)))
        assert share["human"] == pytest.approx(100.0 * h * 100.0**k * area * 1.5, rel=1e-12)


def test_a_cell_turns_with_the_particle_at_a_coupled_patch():
    """By the turn that F makes between the parts of a step before and after the patch."""
    assert Haemolysis(constants="Song").needs_rebounds({"inlet": Cyclic()})
    assert not Haemolysis(constants="Song").needs_rebounds({"inlet": Stick()})
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    shapes = []
    for passes in (False, True):
        cloud = pipe_cloud(n=1)
        cloud.particles.t[:] = 0.0
        function = Haemolysis(constants="Song", stress="morphology")
        functions = CloudFunctions({"f": function}, observed(cloud))
        l = simple_shear(np.full(3, 5000.0))
        steps = made_steps([0.0, 0.1, 0.2], l=l)
        if passes:
            after = (turn @ l[0].reshape(3, 3) @ turn.T).ravel()
            table = steps.tables[0, :, 1]
            table[step.passed] = 1.0
            for first in (step.l0, step.l1):
                table[first : first + 9] = after
            for first in (step.F0, step.F1):
                table[first : first + 9] = turn.ravel()
        see(cloud, steps)
        shapes.append(functions.state()["f/cell"].reshape(3, 3))
    assert abs(shapes[0][0, 1]) > 0.1
    np.testing.assert_allclose(shapes[1], turn @ shapes[0] @ turn.T, atol=1e-12)


def test_the_viscosity_is_that_at_the_particle_or_of_whole_blood():
    t, rate, law = np.array([0.0, 1.0]), np.full(2, 1000.0), POWER_LAWS["Song"]
    for mu, expected in ((None, 0.5 * 1000.0**-0.4), (BLOOD, BLOOD)):
        cloud = pipe_cloud(n=1, medium=WATER)
        cloud.particles.t[:] = 0.0
        cloud.medium = cloud.medium._replace(mu=PowerLawFluid(k=0.5, n=0.6))
        functions = CloudFunctions({"f": Haemolysis(constants="Song", mu=mu)}, observed(cloud))
        see(cloud, made_steps(t, l=simple_shear(rate)))
        dose = (expected * 1000.0) ** (law.alpha / law.beta)
        np.testing.assert_allclose(functions.state()["f/dose"], dose, rtol=1e-12)


def test_stresses_beyond_the_experiments_are_reported_once(tmp_path, caplog):
    cloud, function = pipe_cloud(n=4), Haemolysis(constants="Zhang", stress="KelvinVoigt")
    functions = CloudFunctions({"damage": function}, observed(cloud))
    cloud.particles.status[:] = Status.ACTIVE
    cloud.comm.arrays_here()["damage/peak"][0] = 321.0
    for _ in range(2):
        functions.write(tmp_path)
    (record,) = caplog.records
    assert (
        "cloudFunctions/damage: 1 of 4 particles are beyond the range of the constants Zhang"
        in record.message
    )


def test_cells_with_a_memory_go_on_after_a_restart_with_the_same_bits(tmp_path):
    """Sampled at every step of a pipe's bodies, where slow cells of both kinds agree."""
    found = {}
    for stress in ("KelvinVoigt", "morphology"):
        function, texts = Haemolysis(constants="Song", stress=stress), []
        for first in ((50, 100), (50,)):
            cloud = pipe_cloud(n=8, medium=WATER)
            functions = observe(cloud, function, tmp_path, writes=first)
            if len(first) == 1:
                state = {name: array.copy() for name, array in functions.state().items()}
                again = CloudFunctions({"f": function}, observed(cloud))
                restore(again, state)
                go_on(cloud, again, tmp_path, (100,))
            texts.append([(tmp_path / f"f/{name}.csv").read_text() for name in ("haemolysis", "means")])
        assert texts[0] == texts[1]
        found[stress] = column(table(tmp_path / "f/haemolysis.csv"), "haemolysis")
    assert found["morphology"] == pytest.approx(found["KelvinVoigt"], rel=0.01, abs=0.0)


def test_own_constants():
    assert Haemolysis(constants="own", A=1.0, alpha=2.0, beta=0.5).law == PowerLaw(1.0, 2.0, 0.5)
    with pytest.raises(InputError, match="which need A, alpha and beta"):
        Haemolysis(constants="own", A=1.0)
    with pytest.raises(InputError, match="constants own takes it"):
        Haemolysis(constants="Song", A=1.0)
    with pytest.raises(InputError, match="constants of Song and species; constants pores takes it"):
        Haemolysis(constants="Song", species="porcine")


def test_no_more_is_set_free_than_there_is(tmp_path):
    observe(pipe_cloud(), Haemolysis(constants="own", A=1e9, alpha=1.0, beta=1.0), tmp_path)
    found = column(table(tmp_path / "f/haemolysis.csv"), "haemolysis")
    assert found.max() == 100.0
    assert column(table(tmp_path / "f/means.csv"), "haemolysis").max() <= 100.0


def test_failed_particles_are_not_in_the_means(tmp_path):
    """Their shapes, and so their stresses, may be anything; in the table of particles they stay."""
    cloud, law = pipe_cloud(n=8), Haemolysis(constants="Song")
    functions = CloudFunctions({"f": law}, observed(cloud))
    cloud.particles.status[:] = Status.ACTIVE
    cloud.particles.status[:4] = Status.FAILED
    cloud.comm.arrays_here()["f/dose"][:] = np.where(np.arange(8) < 4, 1e9, 1.0)
    functions.write(tmp_path)
    expected = float(index_of_haemolysis(law.law, np.array(1.0)))
    for row in table(tmp_path / "f/means.csv"):
        assert (int(row["parcels"]), float(row["haemolysis"])) == (2, pytest.approx(expected, rel=1e-6))
    assert len(table(tmp_path / "f/haemolysis.csv")) == 8


def test_where_the_flow_is_unknown_the_last_stress_goes_on():
    """As of a particle that has left the mesh: its place gives no number."""
    cloud, law = pipe_cloud(n=1, medium=WATER), POWER_LAWS["Song"]
    cloud.particles.t[:] = 0.0
    functions = CloudFunctions({"f": Haemolysis(constants="Song")}, observed(cloud))
    l = simple_shear(np.array([300.0, np.nan]))
    l[1] = np.nan
    see(cloud, made_steps(np.array([0.0, 0.5]), l=l))
    rate = (WATER.mu * 300.0) ** (law.alpha / law.beta)
    np.testing.assert_allclose(functions.state()["f/dose"], 0.5 * rate, rtol=1e-12)
