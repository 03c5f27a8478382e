"""The integrators of order 3(2), against independent solutions and against each other."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from small_clouds import assert_same
from strategies import flat, square
from unsteady_flow import changing_flow

from foamprb import analytic
from foamprb.body import stokes
from foamprb.body.ellipsoid import integrals
from foamprb.body.error_control import REUSE_FOR
from foamprb.body.material import MATERIALS, piola
from foamprb.body.tensor import principal_frame
from foamprb.cloud.block import Medium, at, idle_lanes, new_block, new_frames, new_integrals
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import DEFAULT, coefficients
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.integrators.rosenbrock import ROSENBROCK, predict_inertial
from foamprb.cloud.layout import LANES
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError

ADAPTIVE = ("rosenbrock", "stokes")
MU_F = 1e-3
K = {name: {"mooneyRivlin": 0.4, "gent": 5.0}.get(name, 0.0) for name in MATERIALS}


def in_flow(flow, Ca, dt, integrator, tolerance=np.inf, number=1e-3, nu=0.49, material="neoHooke", stride=1):
    """Particles in a flow of unit shear rate, with a shape Stokes number; steps of fixed size by default."""
    Ca, R = np.atleast_1d(Ca), 1e-6
    rho = number * 15 * MU_F / R**2
    p = spheres(np.zeros((len(Ca), 3)), d=2 * R, rho=rho, mu=MU_F / Ca, poissons_ratio=nu, k=K[material])
    models = Models(integrator=integrator, tolerance=tolerance, material=material, stride=stride)
    return Cloud(p, flow, Medium(MU_F, rho, (0.0, 0.0, 0.0)), (), dt, models)


def inertialess(t, Ca, gradient, material="neoHooke"):
    """F(t) by an independent integrator of the nine ordinary differential equations.

    The gradient, (3, 3), is given as such or as a function of time.
    """

    def rate(time, y):
        F = y.reshape(3, 3)
        Q, axes = principal_frame(flat(F))
        Q, g = square(Q), integrals(axes)
        tau = square(piola(MATERIALS[material], flat(F), 1.0, 0.0, K[material])) @ F.T
        l = gradient(time) if callable(gradient) else gradient
        sigma, l_f = Q @ tau @ Q.T / Ca, Q @ l @ Q.T
        l_s = stokes.velocity_gradient(stokes.mobility(axes, g, 0.0), flat(sigma), flat(l_f))
        return (Q.T @ square(l_s) @ Q @ F).ravel()

    found = solve_ivp(rate, (0.0, t), np.eye(3).ravel(), method="LSODA", rtol=1e-12, atol=1e-14)
    return found.y[:, -1]


def unsteady(t):
    """A velocity gradient that pulsates, oscillates and turns."""
    c, s = math.cos(1.3 * t), math.sin(1.3 * t)
    return np.array([[0.0, 1.0 + 0.5 * c, 0.0], [0.2 * s, 0.0, 0.0], [0.0, 0.0, 0.0]])


def unsteady_flow():
    return changing_flow(1.3, (1.0, 0.5, 0.0, 0.0), (0.0, 0.0, 0.2, 0.0))


def relative_errors(F, exact):
    """Of the strain b − I over it, or of the attitude, whichever is larger, as the tolerance has it."""
    found = []
    for own, other in zip(F.reshape(-1, 3, 3), np.reshape(exact, (-1, 3, 3)), strict=True):
        b, c = own @ own.T, other @ other.T
        turn = own @ np.linalg.inv(other)
        found.append(max(np.abs(b - c).max() / np.abs(c - np.eye(3)).max(), np.abs(turn - turn.T).max() / 2))
    return np.array(found)


def pipe(integrator, dt, tolerance=1e-4, n=60, wall=None):
    random = np.random.default_rng(3)
    air = Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))
    r, phi = 2.0e-3 * np.sqrt(random.uniform(0, 1, n)), random.uniform(0, 2 * np.pi, n)
    x = np.stack([np.zeros(n), r * np.cos(phi), r * np.sin(phi)], axis=1)
    mu = air.mu * 923.8 / random.uniform(0.05, 1.0, n)
    p = spheres(x, d=5e-6, rho=2560.0, mu=mu, t0=random.uniform(0, 5e-3, n))
    flow = analytic.pipe(2.1e-3, 923.8 * 2.1e-3 / 4, 0.03)
    interactions = (wall or Stick(), Escape(), Escape())
    return Cloud(p, flow, air, interactions, dt, Models(integrator=integrator, tolerance=tolerance))


@pytest.mark.parametrize(
    ("integrator", "number", "steps"), [("stokes", 1e-3, (20, 40, 80)), ("rosenbrock", 0.05, (40, 80, 160))]
)
def test_third_order_of_path_and_shape_in_an_unsteady_gradient(integrator, number, steps):
    """The body moves through the flow, so that u and its gradient change by its path as well."""
    found = []
    for n in (*steps, 16 * steps[0]):
        cloud = in_flow(unsteady_flow(), [0.1, 0.5, 2.0], 2.0 / n, integrator, number=number)
        cloud.particles.x[:] = (3e-6, 1e-5, 1e-6)
        cloud.particles.v[:] = (1.5e-5, 0.0, 0.0)
        cloud.advance(n)
        found.append((cloud.particles.F.copy(), cloud.particles.x.copy()))
    for k in range(2):
        errors = [np.abs(state[k] - found[-1][k]).max(axis=1) for state in found[:-1]]
        orders = np.log2(errors[0] / errors[-1]) / 2
        assert (orders > 2.5).all(), (k, orders)


@pytest.mark.parametrize(("integrator", "number"), [("stokes", 1e-6), ("rosenbrock", 0.05)])
def test_the_path_by_three_velocities_is_of_third_order_and_better_than_by_two(integrator, number):
    """Of a stiff body, in a flow that is called rough and then limits no step."""

    def place(n, share):
        tolerance = 1e-4 if share else np.inf
        cloud = in_flow(unsteady_flow(), 1e-4, 2.0 / n, integrator, tolerance, number)
        cloud.flow.roughness, cloud.models = lambda: 1.0, replace(cloud.models, roughness_share=share)
        cloud.particles.x[:], cloud.particles.v[:] = (3e-6, 1e-5, 1e-6), (1.5e-5, 0.0, 0.0)
        cloud.advance(n)
        assert (cloud.particles.substeps == 1).all()
        return cloud.particles.x[0]

    exact = place(640, 0.0)
    three, two = ([np.linalg.norm(place(n, share) - exact) for n in (20, 40, 80)] for share in (0.1, 0.0))
    assert np.log2(three[0] / three[2]) / 2 > 2.5, three
    assert three[0] < 0.6 * two[0], (three, two)


def test_the_order_is_not_reduced_in_stiff_bodies():
    """Of bodies that relax a hundred to a hundred thousand times faster than the flow changes.

    ROS2 has the strain of such to 1e-1 with steps of γ̇h = 0.1.
    """
    Ca = np.array([1e-5, 1e-4, 1e-3, 1e-2])
    exact = [inertialess(2.0, c, unsteady) for c in Ca[1:]]
    errors = []
    for n in (20, 40):
        cloud = in_flow(unsteady_flow(), Ca, 2.0 / n, "stokes")
        cloud.advance(n)
        F = cloud.particles.F.reshape(-1, 3, 3)
        errors.append(relative_errors(F[1:], exact))
        # What is stiffer than the reference's method can be, is so in proportion.
        strain = (F @ F.swapaxes(1, 2) - np.eye(3)) / Ca[:, None, None]
        np.testing.assert_allclose(strain[0], strain[1], atol=1e-3)
    # The reference itself is good to 2e-6 of the strain.
    assert (errors[0] < 2e-5).all(), errors
    assert (errors[1] < 4e-6).all(), errors


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
def test_the_deformation_of_any_body_is_right_to_the_tolerance(tolerance):
    """In an unsteady gradient, whatever the strain; errors add up to tolerance times steps at most."""
    Ca = np.array([1e-4, 1e-3, 1e-2, 0.1, 0.5])
    exact = np.array([inertialess(2.0, c, unsteady) for c in Ca])
    cloud = in_flow(unsteady_flow(), Ca, 2.0, "stokes", tolerance=tolerance)
    cloud.advance(1)
    errors = relative_errors(cloud.particles.F, exact)
    assert (errors < 5 * tolerance).all(), errors
    # Steps are not shorter than they need be.
    assert (errors > 1e-3 * tolerance).all(), errors


@pytest.mark.parametrize(("number", "speed"), [(0.05, 1.0), (1.0, 1.0), (0.05, 1e3)])
def test_a_heavy_body_takes_no_more_steps_than_its_path_and_shape_need(number, speed):
    """25 to 55 in two units of time; four times as many if a change were judged as an error."""
    cloud = in_flow(unsteady_flow(), [0.1, 0.5, 2.0], 0.5, "rosenbrock", number=number, tolerance=1e-4)
    p, taken = cloud.particles, np.zeros(3)
    p.x[:], p.v[:] = speed * np.array([3e-6, 1e-5, 1e-6]), speed * np.array([1.5e-5, -1e-5, 2e-5])
    for _ in range(4):
        cloud.advance(1)
        taken += p.substeps
    assert (taken > 15).all(), taken
    assert (taken < 75).all(), taken


def test_a_heavy_bead_leaves_a_vortex():
    """In solid rotation: r grows as exp(τ Ω² t), τ = 2 ρ_s R²/(9 μ), to first order in Ωτ."""
    fluid = Medium(MU_F, 1.0, (0.0, 0.0, 0.0))
    R, rho = 1e-4, 2000.0
    tau = 2 * rho * R**2 / (9 * MU_F)
    spin = 0.02 / tau
    l = spin * np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    ends = {}
    for integrator in ADAPTIVE:
        p = spheres([[1e-2, 0.0, 0.0]], d=2 * R, rho=rho, mu=1e4 * MU_F * spin)
        models = Models(integrator=integrator, tolerance=1e-6)
        cloud = Cloud(p, analytic.linear(l), fluid, (), 0.1 / spin, models)
        cloud.advance(100)
        ends[integrator] = np.log(np.hypot(p.x[0, 0], p.x[0, 1]) / 1e-2)
    growth = tau * spin**2 * 10.0 / spin
    assert ends["stokes"] == pytest.approx(growth, rel=2e-3)
    assert ends["rosenbrock"] == pytest.approx(growth, rel=1e-2)


@pytest.mark.parametrize("material", ["mooneyRivlin", "gent"])
def test_stokes_with_other_solids_against_an_independent_integrator(material):
    gradient = np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0.0]])
    cloud = in_flow(analytic.linear(gradient), 0.3, 0.1, "stokes", tolerance=1e-7, material=material)
    cloud.advance(20)
    expected = inertialess(2.0, 0.3, gradient, material)
    np.testing.assert_allclose(cloud.particles.F[0], expected, atol=2e-5)
    assert np.abs(expected - inertialess(2.0, 0.3, gradient)).max() > 1e-3


@pytest.mark.parametrize("material", [name for name, m in MATERIALS.items() if m.isochoric and not m.liquid])
def test_with_little_inertia_the_inertial_body_goes_as_the_inertialess(material):
    gradient = np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0.0]])
    flow = analytic.linear(gradient)
    cloud = in_flow(flow, 0.3, 0.01, "rosenbrock", number=1e-4, nu=0.4999, material=material)
    cloud.advance(200)
    expected = inertialess(2.0, 0.3, gradient, material)
    np.testing.assert_allclose(cloud.particles.F[0], expected, atol=2e-3)


def test_saint_venant_kirchhoff_runs_with_inertia_and_is_refused_elsewhere():
    cloud = in_flow(analytic.shear(1.0), 0.02, 0.01, "rosenbrock", nu=0.45, material="saintVenantKirchhoff")
    cloud.advance(100)
    F = cloud.particles.F[0].reshape(3, 3)
    values = np.sqrt(np.linalg.eigvalsh(F @ F.T))
    # Small strains are Hooke's: D = 5/4 Ca, as for every other solid.
    assert (values[2] - values[0]) / (values[2] + values[0]) == pytest.approx(1.25 * 0.02, rel=0.03)
    for integrator in ("paper", "stokes"):
        with pytest.raises(InputError, match="saintVenantKirchhoff"):
            in_flow(analytic.shear(1.0), 0.1, 0.01, integrator, material="saintVenantKirchhoff")


def test_stokes_is_stable_and_keeps_the_volume_for_any_stiffness():
    """Steps set by the flow, γ̇Δt = 0.1, for solids that relax up to a million times faster."""
    cloud = in_flow(analytic.shear(1.0), [1e-6, 1e-5, 1e-3, 0.1, 10.0], 0.1, "stokes")
    cloud.advance(100)
    F = cloud.particles.F.reshape(-1, 3, 3)
    assert (cloud.particles.status == Status.ACTIVE).all()
    np.testing.assert_allclose(np.linalg.det(F), 1.0, atol=1e-13)
    # Small deformation: Taylor's D is 5/4 Ca.
    values = np.sqrt(np.linalg.eigvalsh(F @ F.transpose(0, 2, 1)))
    found = (values[:, 2] - values[:, 0]) / (values[:, 2] + values[:, 0])
    np.testing.assert_allclose(found[:3], 1.25 * np.array([1e-6, 1e-5, 1e-3]), rtol=1e-3)


@pytest.mark.parametrize("stride", [1, 4])
@pytest.mark.parametrize("number", [0.055, 0.012])
def test_errors_of_a_sudden_start_decay(number, stride):
    """From rest in shear, γ̇Δt = 0.073: no estimate sees how the first few τ_s are gone through.

    After twenty steps the strain is right to half of the tolerance times their number, also where most go
    through two or four of these.
    """
    Ca, dt, tolerance = [1e-3, 1e-2, 0.03, 0.1, 0.3, 0.5, 1.0, 2.0], 0.073, 1e-4
    ours = in_flow(analytic.shear(1.0), Ca, dt, "rosenbrock", tolerance, number, stride=stride)
    clouds = ours, in_flow(analytic.shear(1.0), Ca, dt, "rosenbrock", 1e-8, number)
    for steps, limits in ((1, (0.4, *7 * (0.04,))), (9, (3e-3,) * 8), (10, (1e-3,) * 8)):
        for cloud in clouds:
            cloud.advance(steps)
        errors = relative_errors(*(cloud.particles.F for cloud in clouds))
        assert (errors < limits).all(), errors


@pytest.mark.parametrize("learns", [False, True])
@pytest.mark.parametrize("gamma_h", [0.03, 0.073, 0.15])
def test_the_error_of_every_step_is_about_below_the_tolerance(gamma_h, learns):
    """Of steps from right states, from rest on: below in 95 of 100, and nowhere twice as much.

    So it is whether or not a body remembers what its last steps of order 3 said of those of order 2.
    """
    Ca, tolerance, parts = [1e-3, 1e-2, 0.03, 0.1, 0.3, 0.5, 1.0, 2.0], 1e-4, 64
    # Steps of fixed size are of order 3 whatever their errors are.
    exact = in_flow(analytic.shear(1.0), Ca, gamma_h / parts, "stokes")
    errors, discount = [], np.zeros(len(Ca))
    for _ in range(30):
        cloud = in_flow(analytic.shear(1.0), Ca, gamma_h, "stokes", tolerance)
        cloud.particles.discount[:] = discount
        for name in ("F", "A", "v", "Q"):
            getattr(cloud.particles, name)[:] = getattr(exact.particles, name)
        cloud.particles.h[:] = gamma_h
        exact.advance(parts)
        cloud.advance(1)
        if learns:
            discount = cloud.particles.discount
        found = relative_errors(cloud.particles.F, exact.particles.F)
        errors.append(found / np.maximum(cloud.particles.substeps, 1.0))
    assert np.max(errors) < 2 * tolerance
    assert np.mean(np.array(errors) < tolerance) > 0.95


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
def test_a_body_learns_how_much_less_its_errors_are_than_they_might_be(integrator):
    """A soft one treads its tank steadily: where N might change at a rate γ̇ it hardly does.

    Whether a step was of order 3 is seen by comparison with one of order 2.
    """
    Ca, h = [1.5, 2.0, 2.5, 3.0, 4.0, 5.0], 0.08
    clouds = [in_flow(analytic.shear(1.0), Ca, h, integrator, 1e-4, 0.05) for _ in range(2)]
    exact, second = (in_flow(analytic.shear(1.0), Ca, h, integrator, t, 0.05) for t in (1e-9, 1e6))
    thirds, demanding = np.zeros((2, 60, len(Ca))), np.zeros((60, len(Ca)))
    errors = []
    for n in range(60):
        for k, cloud in enumerate(clouds):
            for other in (exact, second):
                for name in ("F", "A", "v", "Q"):
                    getattr(other.particles, name)[:] = getattr(cloud.particles, name)
                other.particles.h[:] = h
                other.advance(1)
            if k == 1:
                cloud.particles.discount[:] = 0.0
            cloud.advance(1)
            # Other than by round-off of the time, which is another for each cloud.
            thirds[k, n] = (np.abs(cloud.particles.F - second.particles.F) > 1e-12).any(axis=1)
            demanding[n] = clouds[0].particles.demanding
            if n >= 20:
                assert (cloud.particles.substeps == 1).all()
                errors.append(relative_errors(cloud.particles.F, exact.particles.F))
    learned, not_learned = thirds[:, 20:].mean(axis=(1, 2))
    assert not_learned > 0.3
    assert 0.0 < learned < 0.4 * not_learned
    assert np.max(errors) < 1e-4
    assert (clouds[0].particles.discount > 0.0).any()
    # What is known of the next step, but for those in which it is found out again.
    foretold = np.array([n for n in range(59) if (n + 1) % REUSE_FOR])
    expected, found = demanding[foretold] > 0.0, thirds[0, foretold + 1]
    assert found[expected].mean() > 0.5
    assert found[~expected].mean() < 0.1


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
def test_what_a_body_has_learned_holds_until_the_next_eighth_step(integrator):
    """A stiff one in a slow flow, which needs no step of order 3 to learn from."""
    cloud = in_flow(analytic.shear(1.0), 0.1, 1e-3, integrator, 1e-4, 1e-4)
    cloud.advance(10)
    cloud.particles.discount[:] = 0.5
    cloud.advance(6)
    assert cloud.step == 16
    assert (cloud.particles.discount == 0.5).all()
    cloud.advance(1)
    assert (cloud.particles.discount == 0.0).all()


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_jumps_of_the_gradient_between_coarse_cells_do_not_shorten_steps(coarse_vortex, integrator, random):
    """Steps of a fifth of a cell turn by up to 0.1 rad; with chords cut at θ²/12 = 1e-4 that is three."""
    x, tolerance = 0.1 + 0.8 * random.random((200, 3)), 1e-4

    def after(steps, tolerance):
        rho = 1000.0 if integrator == "rosenbrock" else 1.0
        p = spheres(x, d=2e-3, rho=rho, mu=0.35)
        p.v[:], _ = coarse_vortex.sample(x, coarse_vortex.locate(x), 0.0)
        models = Models(integrator=integrator, tolerance=tolerance, roughness_share=0.0)
        walls = [Stick() for _ in coarse_vortex.patches]
        cloud = Cloud(p, coarse_vortex, Medium(0.011, 1.0, (0.0, 0.0, 0.0)), walls, 1.0 / steps, models)
        taken = []
        for _ in range(30):
            cloud.advance(steps // 30)
            taken.append(cloud.particles.substeps.mean())
        return cloud.particles, np.mean(taken)

    p, taken = after(30, tolerance)
    exact, _ = after(960, 1e-7)
    assert taken < 4.0
    assert np.all(p.status == exact.status)
    # The way is at most 1 m long, and nearby ways part by little.
    off = np.linalg.norm(p.x - exact.x, axis=1)
    assert np.sqrt(np.mean(off**2)) < 0.5 * tolerance
    assert np.quantile(off, 0.99) < 2.0 * tolerance


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_answer_does_not_depend_on_threads_chunks_or_order(integrator, random):
    one, many, mixed = (pipe(integrator, 2e-5 if integrator == "paper" else 2e-4) for _ in range(3))
    one.threads, many.threads = 1, 3
    order = random.permutation(one.particles.size)
    mixed.particles = mixed.particles.take(order)
    one.advance(300)
    mixed.advance(300)
    for steps in (1, 7, 92, 200):
        many.advance(steps)
    assert_same(one.particles, many.particles)
    assert_same(one.particles.take(order), mixed.particles)
    counts = one.particles.counts()
    assert counts[Status.FAILED] == 0
    assert counts[Status.ESCAPED] > 0 or integrator == "paper"


def test_rebound_without_inertia_stays_in_the_flow():
    cloud = pipe("stokes", 2e-4, wall=Rebound(0.5, 0.1))
    cloud.advance(1500)
    p = cloud.particles
    counts = p.counts()
    assert counts[Status.FAILED] == counts[Status.STUCK] == 0
    assert (np.hypot(p.x[:, 1], p.x[:, 2]) <= 2.1e-3).all()


def test_stokes_refuses_jefferys_traction():
    p = spheres(np.zeros((1, 3)), d=1e-6, rho=1.0, mu=1.0)
    with pytest.raises(InputError, match="roscoe"):
        Cloud(
            p,
            analytic.shear(1.0),
            Medium(1.0, 1.0, (0, 0, 0)),
            (),
            1.0,
            Models("jeffery", integrator="stokes"),
        )


def test_the_place_predicted_with_inertia_is_that_of_drag_in_a_fluid_that_is_accelerated():
    """A sphere at rest, of relaxation rate r, in u + a t: at first its acceleration is r (u + a t)."""
    layout, h, R = ROSENBROCK.layout, 1e-4, 1.0
    medium = Medium(1.0, 1e-12, (0.0, 0.0, 0.0), coefficients(DEFAULT))
    block = new_block(layout.rows)
    idle_lanes(block, layout.initial, h)
    new_frames(block)
    new_integrals(block)
    u, a = np.array([1.0, -2.0, 3.0]), np.array([4e4, 2e4, -6e4])
    rows = block.reshape(-1, LANES)
    rows[at.R], rows[at.rho], rows[at.inertia] = R, 4.5, 5.0 / (4.5 * R**2)
    rows[during.start_l : during.start_l + 9] = rows[at.l : at.l + 9] = 0.0
    for c in range(3):
        rows[at.u + c] = rows[during.start_u + c] = u[c]
        rows[at.DuDt + c] = a[c]
        rows[at.v + c] = rows[at.x + c] = 0.0
    predict_inertial(block, medium)
    r = 4.5 / (4.5 * R**2)
    x = r * (u * h**2 / 2.0 + a * h**3 / 6.0)
    assert rows[at.new_x : at.new_x + 3] == pytest.approx(x[:, None] * np.ones(LANES), rel=r * h)
