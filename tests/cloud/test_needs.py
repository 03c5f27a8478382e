"""Forces that read the body, the fluid and fields of the case; those of examples/forces in closed form."""

from __future__ import annotations

import re

import numpy as np
import pytest
from mesh_shapes import block, box_patches
from paths import ROOT

from foamprb import Cloud, InputError, Medium, Models, analytic, spheres
from foamprb.cloud.block import at
from foamprb.cloud.forces import FORCES, acceleration, add_force, coefficients, compose, sum_of_forces
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import LANES
from foamprb.cloud.needs import needed, needed_by, reader_of
from foamprb.cloud.patches import Rebound
from foamprb.cloud.surroundings.registry import with_rows
from foamprb.compile.link import link
from foamprb.flow.fields import FieldColumns
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow
from foamprb.settings.libs import load_libs

A, MU, G = 1e-5, 1e-3, 0.5
"""Radius, viscosity, and gradient of the linear fields 1 + G x."""
FOLDER = ROOT / "examples/forces"


@pytest.fixture(autouse=True)
def _registry(monkeypatch):
    monkeypatch.setattr("foamprb.settings.libs._loaded", {})
    before = dict(FORCES)
    yield
    FORCES.clear()
    FORCES.update(before)


def force_of(name):
    load_libs([FOLDER / f"{name}.py"])
    return FORCES[name]


WIDTHS = {"E": 3, "grad(E)": 9, "grad(p2)": 3, "grad(v2)": 3, "T": 1, "grad(T)": 3}
"""Fields that the examples need, with their numbers of components."""


def flow_at_rest(values, growth=(1.0, 1.0, 1.0), n=3):
    """Fluid at rest in fields ``values(x)``, which grow as ``growth`` at the times 0, 0.3 and 1.

    Without a growth it is steady. Other fields that the examples need have no gradient.
    """
    shape = block(n, 0.2)
    mesh = build_mesh(shape, box_patches(shape))
    x = np.concatenate([mesh.points, mesh.centres])
    u, l = np.zeros((len(x), 3)), np.zeros((len(x), 3, 3))
    fields = {name: np.full((len(x), width), float(name == "T")) for name, width in WIDTHS.items()}
    table = np.column_stack(list((fields | values(x)).values()))
    columns = tuple(FieldColumns(name, width, "1") for name, width in WIDTHS.items())
    if growth:
        return SeriesFlow(mesh, [0.0, 0.3, 1.0], lambda i: (u, l, growth[i] * table), sampled=columns)
    flow = MeshFlow(mesh, u, l)
    flow.field_table, flow.field_columns = table, columns
    return flow


WITHOUT_EFFECT = {
    "dielectrophoresis": {"epsilon": 1.0, "K": 0.0},
    "acoustics": {"kappa": 1.0, "f1": 0.0, "f2": 0.0},
    "thermophoresis": {"k": 1.0},
}


def moved(flow, name, entries, integrator="stokes", dt=0.02, time=0.9, rho_f=1000.0):
    """The first coordinates of three spheres before and after some time, in the loop with all examples."""
    forces = tuple(force_of(n)(**(entries if n == name else e)) for n, e in WITHOUT_EFFECT.items())
    p = spheres(np.array([[0.2, 0.3, 0.4], [0.4, 0.6, 0.5], [0.1, 0.5, 0.6]]), d=2 * A, rho=1000.0, mu=1e3)
    walls, medium = [Rebound()] * len(flow.patches), Medium(MU, rho_f, (0.0, 0.0, 0.0))
    cloud = Cloud(p, flow, medium, walls, dt, Models(integrator=integrator, forces=forces))
    x0 = p.x.copy()
    cloud.advance(round(time / dt))
    np.testing.assert_allclose(p.x[:, 1:], x0[:, 1:], atol=1e-4)
    return x0[:, 0], p.x[:, 0]


def vector_field(x):
    """E = (1 + G x) e_x and its gradient."""
    E, gradient = np.zeros((len(x), 3)), np.zeros((len(x), 9))
    E[:, 0], gradient[:, 0] = 1.0 + G * x[:, 0], G
    return {"E": E, "grad(E)": gradient}


@pytest.mark.parametrize(
    ("integrator", "dt", "growth"),
    [
        ("stokes", 0.02, (1.0, 1.3, 2.0)),
        ("rosenbrock", 0.02, (1.0, 1.3, 2.0)),
        ("paper", 1e-5, ()),
    ],
)
def test_dielectrophoresis_is_that_of_the_closed_form(integrator, dt, growth):
    """dx/dt = c G (1 + G x) (1 + t)², c = 2/3 a² ε K/μ, with the square of the growth of the field."""
    c = 0.4
    entries = {"epsilon": 1.5 * c * MU / (A * A), "K": 1.0}
    x0, x = moved(flow_at_rest(vector_field, growth), "dielectrophoresis", entries, integrator, dt)
    power = (1.9**3 - 1.0) / 3.0 if growth else 0.9
    expected = (x0 + 1.0 / G) * np.exp(c * G * G * power) - 1.0 / G
    np.testing.assert_allclose(x, expected, rtol=2e-4)
    assert (x - x0).min() > 0.1


def test_sound_moves_spheres_as_in_the_closed_form():
    """tan kx = exp(2 k D t) tan kx₀ with D = 2/3 Φ k a² E/μ, in a standing wave of the energy density E."""
    k, f1, f2, kappa, energy = 0.5 * np.pi, 0.6, 0.4, 4e-10, 4e6

    def values(x):
        wave = np.outer(k * np.sin(2.0 * k * x[:, 0]), (1.0, 0.0, 0.0))
        return {"grad(p2)": -2.0 * energy / kappa * wave, "grad(v2)": 2.0 * energy / 1000.0 * wave}

    entries = {"kappa": kappa, "f1": f1, "f2": f2}
    x0, x = moved(flow_at_rest(values, n=12), "acoustics", entries, time=1.0)
    D = 2.0 / 3.0 * (f1 / 3.0 + f2 / 2.0) * k * A * A * energy / MU
    np.testing.assert_allclose(x, np.arctan(np.tan(k * x0) * np.exp(2.0 * k * D)) / k, rtol=5e-3)
    assert (x - x0).min() > 0.04


def test_spheres_in_a_gas_move_to_the_cold_as_in_the_closed_form():
    """d(T²)/dt = −3 ν G²/(2 + k) along the path, in T = 1 + G x."""
    nu, k = 1.0, 1.0
    flow = flow_at_rest(lambda x: {"T": 1.0 + G * x[:, 0], "grad(T)": np.full((len(x), 3), [G, 0.0, 0.0])})
    x0, x = moved(flow, "thermophoresis", {"k": k}, time=0.3, rho_f=MU / nu)
    expected = (np.sqrt((1.0 + G * x0) ** 2 - 3.0 * nu * G * G / (2.0 + k) * 0.3) - 1.0) / G
    np.testing.assert_allclose(x, expected, rtol=2e-4)
    assert (x0 - x).min() > 0.05


def along_shear(inputs, u, grad_u, mu, v, F, rate):
    """Drift along the fluid's velocity, and one by its gradient; sideways by shape and velocity."""
    c = 4.5 * mu * rate / (inputs.rho * inputs.R * inputs.R)
    return (c * (u[0] + 1e-3 * grad_u[1]), 0.0 * c, c * v[0] * F[4]), 0.0


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
def test_force_reads_the_fluid_and_the_body_in_a_flow_in_closed_form(integrator):
    """In a linear shear u = γ y: dx/dt = γ y + c γ (y + 1e-3), and dz/dt = c cos(½ γ t) dx/dt as it turns."""
    force, rate, y = add_force("along", along_shear, ("u", "grad(u)", "mu", "v", "F")), 0.25, 0.3
    p = spheres(np.array([[0.0, y, 0.0]]), d=2 * A, rho=1000.0, mu=1e3)
    models = Models(integrator=integrator, forces=(force(rate=rate),))
    cloud = Cloud(p, analytic.shear(3.0), Medium(MU, 1000.0, (0.0, 0.0, 0.0)), (), 1e-3, models)
    cloud.advance(400)
    speed = 3.0 * y + rate * 3.0 * (y + 1e-3)
    # The first step knows no velocity yet.
    turned = np.sin(0.5 * 3.0 * 0.4) / (0.5 * 3.0)
    np.testing.assert_allclose(p.x[0], [0.4 * speed, y, turned * rate * speed], rtol=4e-3)


def test_mistakes_have_one_message():
    def needs_x(inputs, x):
        return x, 0.0

    for needs, message in (
        (("x",), r"force a: it needs x, which is inputs\.x"),
        (("grad E",), "force a: it needs 'grad E'. Allowed: names, and gradients"),
        (("u", "v"), "force a: it has 2 parameters for inputs, u, v"),
    ):
        with pytest.raises(ValueError, match=message):
            add_force("a", needs_x, needs)
    medium, p = Medium(MU, 1000.0, (0.0, 0.0, 0.0)), spheres(np.zeros((1, 3)), d=A, rho=1000.0, mu=1e3)
    force = force_of("dielectrophoresis")(epsilon=1.0, K=1.0)
    with pytest.raises(InputError, match="dielectrophoresis needs E, which this flow does not have"):
        Cloud(p, analytic.shear(1.0), medium, (), 1.0, Models(forces=(force,)))
    near = add_force("b", needs_x, ("gradu",))()
    with pytest.raises(InputError, match=r"b needs gradu, .* Did you mean 'grad\(u\)'\?"):
        Cloud(p, analytic.shear(1.0), medium, (), 1.0, Models(forces=(near,)))
    flow = flow_at_rest(vector_field, ())
    flow.field_columns = (FieldColumns("E", 1, "V/m"), FieldColumns("grad(E)", 3, "V/m2"))
    with pytest.raises(
        InputError, match=r"dielectrophoresis fails: .*; E is a scalar, grad\(E\) is a vector"
    ):
        Cloud(p, flow, medium, [Rebound()] * len(flow.patches), 1.0, Models(forces=(force,)))


def test_page_shows_the_examples():
    page = (ROOT / "docs/own-models.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    files = sorted(FOLDER.glob("*.py"))
    assert len(files) == 4
    assert all(file.read_text() in blocks for file in files)


def everything(inputs, u, T, S, F, E, mu, a, b=2.0):
    """A force that reads values of all kinds."""
    return (a * u[0] + T * F[1], S[1] + b * E[2], mu * S[5] + inputs.x[0]), 0.0


def test_values_are_those_of_the_place_in_compiled_stages_too():
    """Linear between the start and the end of a step; with wallLift a stage is compiled by numba."""
    columns = (FieldColumns("T", 1, "K"), FieldColumns("S", 6, "Pa"), FieldColumns("E", 3, "V/m"))
    force = add_force("everything", everything, ("u", "T", "S", "F", "E", "mu"))(a=3.0)
    (model,) = needed_by((force,), columns)
    own = INTEGRATORS["stokes"].layout
    total = compose((force,), lambda f: reader_of(f, columns, inertia=False))
    random, n = np.random.default_rng(1), with_rows(own, (model,)).rows
    block = random.uniform(0.5, 1.5, n * LANES)
    rows = block.reshape(n, LANES)
    gone = rows[at.gone, 5]
    first, last = (rows[k : k + 22, 5] for k in needed)
    x = first + gone * (last - first)
    medium = Medium(MU, 1000.0, (0.0, 0.0, -9.81), coefficients((force,)))
    f, inertia = link(acceleration, {sum_of_forces: total})(block, 5, medium, 1.0)
    F = rows[at.new_F : at.new_F + 9, 5]
    expected = 3.0 * x[0] + x[12] * F[1], x[16] + 2.0 * x[21], MU * x[17] + rows[at.new_x, 5]
    np.testing.assert_allclose(f, expected, rtol=1e-13)
    assert inertia == 1.0
