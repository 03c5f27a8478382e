"""Bodies with the quadratic mode: their shape, their drift, and numbers that depend on nothing else."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from foamprb.body.quadratic import bullet_amplitude, layers, rotation, turned
from foamprb.body.viscosity import shear_rate
from foamprb.cloud import viscosity as carrier
from foamprb.cloud.block import Medium, at, idle_lanes, load3, new_block, store3
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.layout import LANES, layout, offsets
from foamprb.cloud.measures import context, measure
from foamprb.cloud.patches import Escape, Stick
from foamprb.cloud.state import Status, drops, set_rest_shape, spheres, with_relaxation
from foamprb.cloud.surroundings import quadratic
from foamprb.cloud.surroundings.base import Survey
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.quadratic import QuadraticRows, QuadraticSolid, load7, store7
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

MU_F, R = 1e-3, 1e-5
WATER = Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
RADIUS, U = 1e-4, 1e-2
SOFT = 1.0
"""Shear modulus, Pa: relaxation in a millisecond."""


def advanced(p, flow, steps, dt, integrator="stokes", threads=1, stride=1):
    """Drops without Faxén's correction, which holds for solids."""
    liquid = p.drop.any()
    models = Models(
        integrator=integrator,
        material="drop" if liquid else "neoHooke",
        surroundings=() if liquid else (FaxenCorrection(),),
        shape="quadratic",
        stride=stride,
    )
    cloud = Cloud(p, flow, WATER, [Escape()] * len(flow.patches), dt, models, threads=threads)
    for n in np.atleast_1d(steps):
        cloud.advance(int(n))
    return cloud


def bodies(x, mu=SOFT, eta=0.0):
    return spheres(np.atleast_2d(x), d=2.0 * R, rho=1000.0, mu=mu, poissons_ratio=0.4999, eta=eta)


# --- Shape --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("integrator", "eta"), [("stokes", 0.0), ("stokes", 3e-3), ("rosenbrock", 0.0)])
def test_a_body_on_the_axis_of_a_pipe_becomes_a_bullet(integrator, eta):
    """ε = 7/8 μ U a/(μ_s R²) (1 − exp −t/τ₃), in steps as long as τ₃/3; the affine shape stays a sphere."""
    tau = (19.0 * MU_F + 16.0 * eta) / (16.0 * SOFT)
    p = bodies((0.0, 0.0, 0.0), eta=eta)
    advanced(p, analytic.pipe(RADIUS, 0.5 * U), 6, tau / 3.0, integrator)
    eps = 7.0 / 8.0 * MU_F * U * R / (SOFT * RADIUS**2) * (1.0 - np.exp(-2.0))
    B = eps * np.array([1.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(p.B[0], B, atol=1e-7 * eps)
    np.testing.assert_allclose(p.F[0], np.eye(3).ravel(), atol=1e-12)


def test_the_stress_of_a_thinning_fluid_bends_a_body(monkeypatch):
    """τ_xr = −G r/2 in a tube for any law: ε = 7/32 G a/μ_s, though μ is infinite on the axis and S is 0."""
    G, n, k, a = 4.8e7, 0.6, 0.4, 4e-6

    def sample(_flow, _host, x, _t):
        r = np.hypot(x[1], x[2])
        slope = -((G * r / (2.0 * k)) ** (1.0 / n)) / max(r, 1e-300)
        return (0.0,) * 3, (0.0, slope * x[1], slope * x[2], *(6 * (0.0,))), (0.0,) * 3

    monkeypatch.setattr(quadratic, "sample", sample)
    law = carrier.PowerLaw(k=k, n=n)
    monkeypatch.setattr(quadratic, "viscosity_beside", lambda _f, _h, _x, _t, l, _c: law.at(shear_rate(l)))
    mu_S, mu_v, mu = quadratic.stress_parts(None, 0, (0.0, 0.0, 0.0), 0.0, a, ())
    assert 35.0 / 32.0 * bullet_amplitude(mu_S) == pytest.approx(7.0 / 32.0 * G, rel=1e-12)
    np.testing.assert_allclose(mu_v, (-G, 0.0, 0.0), atol=1e-9 * G)
    # The mean of μ over the body is that near its surface.
    assert mu == pytest.approx(law.at((G * a / (2.0 * k)) ** (1.0 / n)), rel=0.3)


def test_a_law_of_one_viscosity_gives_the_same_bullets():
    """τ is linear in a pipe: differences over the body are exact."""
    shapes = []
    for mu in (MU_F, carrier.PowerLaw(k=MU_F, n=1.0)):
        p = bodies((0.0, 0.3 * RADIUS, 0.0))
        flow, models = (
            analytic.pipe(RADIUS, 0.5 * U),
            Models(integrator="stokes", shape="quadratic", stride=1),
        )
        cloud = Cloud(p, flow, WATER._replace(mu=mu), [Escape()] * len(flow.patches), 2e-4, models, threads=1)
        cloud.advance(20)
        shapes.append(np.concatenate([p.B[0] / bullet_amplitude(tuple(p.B[0])), p.x[0] / RADIUS]))
    np.testing.assert_allclose(*shapes, atol=1e-9)


def steps_in(velocity, x, n, end):
    """The body of radius 0.3 after n equal steps in a flow of these velocities."""
    flow = analytic.function(velocity, length=1.0)
    p = spheres([x], d=0.6, rho=1e-12, mu=8.0)
    models = Models(integrator="stokes", shape="quadratic", forces=(), tolerance=np.inf)
    medium = Medium(1.0, 1e-12, (0.0, 0.0, 0.0))
    Cloud(p, flow, medium, (), end / n, models, threads=1).advance(n)
    return p


def curved(x, y, z):
    return 1.0 + 0.3 * y * y * y + 0.2 * y, 0.25 * np.cos(x), 0.1 * np.sin(x)


def test_paths_by_the_mode_are_of_second_order():
    """The source of the mode varies along the path; half the step has a quarter of the error."""
    ends = {n: steps_in(curved, (0.0, 0.3, 0.0), n, 2.0).x[0] for n in (16, 32, 512)}
    errors = [np.abs(ends[n] - ends[512]).max() for n in (16, 32)]
    assert errors[0] < 1e-4
    assert 3.5 < errors[0] / errors[1] < 6.0


def test_a_solid_with_memory_bends_by_its_relaxing_moduli():
    """Off the axis of a pipe, where S turns in the frame of the body: B and q of their equations."""
    G0, G, T, eta, y = SOFT, (2.0, 1.0), (2e-3, 2e-2), 1e-3, 0.4e-4
    p = with_relaxation(bodies((0.0, y, 0.0), mu=G0, eta=eta), G, T)
    advanced(p, analytic.pipe(RADIUS, 0.5 * U), 400, 5e-5)
    g = -2.0 * U / RADIUS**2
    spin = (0.0, 0.0, -0.5 * g * y)
    c, S = 17.5 * R * MU_F / (19.0 * MU_F + 16.0 * eta), np.array([-0.4, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0]) * g
    v = (MU_F * R**2 / 3.0) / (2.0 * MU_F + 3.0 * eta) * np.array([2.0 * g, 0.0, 0.0])

    def rates(t, state):
        """In the turning frame: B, then q, and those that have faded."""
        past, Y = rotation(spin, -t), state.reshape(3, 10)
        source = np.r_[c * np.array(turned(tuple(S), past)), np.reshape(past, (3, 3)) @ v]
        stress = G0 * Y[0] + sum(g_k * (Y[0] - Y[k]) for k, g_k in enumerate(G, 1))
        elastic = np.r_[7 * [16.0 / (19.0 * MU_F + 16.0 * eta)], 3 * [3.0 / (2.0 * MU_F + 3.0 * eta)]]
        return np.concatenate(
            [source - elastic * stress, *((Y[0] - Y[k]) / t_k for k, t_k in enumerate(T, 1))]
        )

    t = 400 * 5e-5
    Y = solve_ivp(rates, (0.0, t), np.zeros(30), rtol=1e-9, atol=1e-14).y[:10, -1]
    turn = rotation(spin, t)
    B, q = turned(tuple(Y[:7]), turn), np.reshape(turn, (3, 3)) @ Y[7:]
    np.testing.assert_allclose(p.B[0], B, atol=2e-3 * np.abs(B).max())
    np.testing.assert_allclose(p.shift[0], q, atol=2e-3 * np.abs(q).max())


def test_a_body_where_the_flow_has_no_velocity_gets_its_mode():
    """S_111 = 1 at a stagnation point: B_111 = 35/32 μ_f a S/μ_s, in 60 relaxation times."""

    def stagnation(x, y, z):
        return 0.5 * x * x - 0.25 * (y * y + z * z), -0.5 * x * y, -0.5 * x * z

    p = steps_in(stagnation, (0.0, 0.0, 0.0), 20, 9.0)
    assert p.B[0, 0] == pytest.approx(35.0 / 32.0 * 0.3 / 8.0, rel=1e-9)
    assert not p.v.any()


def test_drops_have_shapes_of_their_own():
    """ε = (10 + 11λ)/(20 (1 + λ)) μ U a²/(σ R²)."""
    sigma = SOFT * R
    p = drops([(0.0, 0.0, 0.0)], d=2.0 * R, rho=1000.0, gamma=sigma, eta=MU_F)
    cloud = advanced(p, analytic.pipe(RADIUS, 0.5 * U), 40, 5e-4)
    eps = 21.0 / 40.0 * MU_F * U * R**2 / (sigma * RADIUS**2)
    assert p.B[0, 0] == pytest.approx(eps, rel=1e-5)
    found = measure(context(p, cloud.flow, MU_F, cloud.time), ["quadraticShape", "bulletAmplitude"])
    np.testing.assert_array_equal(found["quadraticShape"], p.B)
    assert found["bulletAmplitude"] == pytest.approx(eps, rel=1e-5)


def test_shapes_follow_a_flow_that_changes_along_the_path():
    """They do not depend on the step to second order."""
    results = []
    for n in (50, 100, 200):
        p = bodies((0.0, 0.3e-3, 0.0))
        advanced(p, WAVES_AND_RIPPLES, n, 1e-2 / n)
        results.append(p.B[0].copy())
    error, half = results[0] - results[2], results[1] - results[2]
    assert bullet_amplitude(tuple(results[2])) > 1e-4
    assert np.linalg.norm(error) / np.linalg.norm(half) == pytest.approx(5.0, rel=0.2)


@pytest.mark.parametrize(("height", "substeps"), [(1.0, 0.5), (2.0, 0.05)], ids=["ripples", "rise"])
def test_long_steps_resolve_the_change_of_the_flow(height, substeps):
    """A straight path at constant speed, where nothing but the source of the mode changes."""
    results = []
    for stride in (1, 64):
        p = bodies((0.0, 0.0, height))
        advanced(p, WAVES_AND_RIPPLES, 512, 1e-2 / 512, stride=stride)
        results.append(p.B[0].copy())
    assert p.substeps[0] < substeps
    assert results[1] == pytest.approx(results[0], abs=0.02 * np.abs(results[0]).max())


def _waves_and_ripples(x, y, z, t):
    """Three flows in one loop: waves at z = 0, ripples at 1 m, and one that rises slowly at 2 m."""
    if z > 1.5:
        return 1e7 * y * y * np.sin(10.0 * t), 0.0 * y, 0.0 * z
    if z > 0.5:
        return 0.05 + 1e6 * y * y * np.sin(3e4 * x), 0.0 * y, 0.0 * z
    k, v = 3e3, 0.05
    return (
        v * (1.0 + 0.3 * np.cos(k * y) * np.cos(k * x)),
        v * 0.3 * np.sin(k * y) * np.sin(k * x),
        0.1 * v * np.sin(k * y),
    )


WAVES_AND_RIPPLES = analytic.function(_waves_and_ripples)


# --- Contact ------------------------------------------------------------------------------------------------


def sinking(steps):
    """Return the cloud of a soft body that sinks onto the lower wall of a slit."""
    models = Models(integrator="stokes", shape="quadratic", surroundings=(FaxenCorrection(),), stride=1)
    p = spheres([(0.0, 0.0, 1.3 * R)], d=2.0 * R, rho=3000.0, mu=SOFT, poissons_ratio=0.4999)
    medium = Medium(MU_F, 1000.0, (0.0, 0.0, -9.81))
    cloud = Cloud(p, analytic.slit(4.0 * R, 3e-3), medium, [Stick()] * 2, 1e-4, models)
    for n in steps:
        cloud.advance(n)
    return cloud


def test_the_surface_of_the_mode_meets_a_wall():
    cloud = sinking([400])
    p = cloud.particles
    assert p.status[0] == Status.STUCK
    X = np.random.default_rng(0).standard_normal((200_000, 3))
    X /= np.linalg.norm(X, axis=1, keepdims=True)
    F = p.F[0].reshape(3, 3)
    U, _, V = np.linalg.svd(F)
    Y = X @ (U @ V).T
    whole = np.array(layers(tuple(p.B[0]))).reshape(3, 3, 3)
    lowest = p.x[0, 2] / R + (X @ F[2] + np.einsum("jk,vj,vk->v", whole[2], Y, Y)).min()
    ellipsoid = p.x[0, 2] / R - np.linalg.norm(F[2])
    assert abs(lowest) < 2e-3
    assert abs(ellipsoid) > 0.015
    assert cloud.contact_normals(p)[0].tolist() == [0.0, 0.0, 1.0]


def test_contact_does_not_depend_on_calls():
    one, many = (sinking(steps).particles for steps in ([400], [1] * 400))
    assert one.x.tobytes() == many.x.tobytes()
    assert one.t == many.t


# --- Drift --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("flow", "drift", "integrator"),
    [
        ("pipe", -25.0 / 144.0, "rosenbrock"),
        ("slit", -5.0 / 36.0, "stokes"),
    ],
)
def test_elastic_bodies_drift_inward(flow, drift, integrator):
    """-25/144 or -5/36 of γ g μ a²/μ_s; γ g = 4 U² y/R⁴."""
    y = 0.5 * RADIUS
    if flow == "pipe":
        across, x, flow = 1, (0.0, y, 0.0), analytic.pipe(RADIUS, 0.5 * U)
    else:
        across, x, flow = 2, (0.0, 0.0, RADIUS + y), analytic.slit(2.0 * RADIUS, U / 1.5)
    p = bodies(x, mu=10.0 * SOFT)
    advanced(p, flow, 40, 2e-5, integrator)
    expected = drift * 4.0 * U * U * y / RADIUS**4 * MU_F * R * R / (10.0 * SOFT)
    assert p.v[0, across] == pytest.approx(expected, rel=2e-3)


def _linear_and_quadratic(x, y, z):
    c = 1e3
    return (
        x + 2.0 * y + 0.5 * c * (x * x - y * y + 3.0 * z * z + 4.0 * x * y + 2.0 * y * z),
        -2.0 * y + z + 0.5 * c * (2.0 * x * x + y * y - 2.0 * x * z + 4.0 * y * z),
        3.0 * x
        - y
        + z
        + 0.5 * c * (x * x + 2.0 * y * y - 2.0 * z * z - 2.0 * x * y - 2.0 * x * z - 6.0 * y * z),
    )


@pytest.mark.parametrize(
    ("kind", "drift"),
    [("solid", (6.625000, -1.701389, -6.270833)), ("drop", (5.500000, -1.925000, -5.512500))],
)
def test_drift_in_a_flow_without_symmetry(kind, drift):
    """Beside that of a sphere, in units of μ_f a²/μ_s or μ_f a³/σ times the scales of the flow."""
    if kind == "solid":
        p, sphere = bodies((0.0, 0.0, 0.0), mu=10.0 * SOFT), 1.0 / 6.0
    else:
        p = drops([(0.0, 0.0, 0.0)], d=2.0 * R, rho=1000.0, gamma=10.0 * SOFT * R, eta=MU_F)
        sphere = 0.1
    flow = analytic.function(_linear_and_quadratic)
    advanced(p, flow, 100, 2e-5)
    u, _ = flow.sample(p.x, p.host, 0.0)
    slip = p.v[0] - u[0] - sphere * R * R * 1e3 * np.array([3.0, 3.0, 1.0])
    assert slip / (0.1 * MU_F * R * R / SOFT * 1e3) == pytest.approx(drift, rel=2e-3)


def test_a_new_body_is_displaced_by_its_shift():
    """Where the fluid does not turn, the centre moves by −q while the surface does by q."""
    p = bodies((0.0, 0.0, 0.0))
    advanced(p, analytic.pipe(RADIUS, 0.5 * U), 10, 1e-3)
    bend = -4.0 * U / RADIUS**2
    q = MU_F * R * R / (9.0 * SOFT) * bend
    assert p.shift[0, 0] == pytest.approx(q, rel=1e-6)
    # Beside the path of a sphere, by Faxén.
    assert p.x[0, 0] - (U + R * R / 6.0 * bend) * 1e-2 == pytest.approx(-q, rel=1e-3)


# --- Numbers ------------------------------------------------------------------------------------------------


@pytest.fixture
def lane():
    """A block with the rows of the mode, whose lane 3 has just been computed."""
    mode = offsets(QuadraticRows)
    own = layout(at, mode)
    block, random = new_block(own.rows), np.random.default_rng(4)
    idle_lanes(block, own.initial, 0.3)
    block[at.t * LANES + 3], block[mode.reached * LANES + 3], block[mode.sampled * LANES + 3] = 0.7, 0.2, 1.0
    store3(block, at.v, 3, (1.0, 0.0, 0.0))
    for row in (mode.B, mode.growth):
        store7(block, row, 3, tuple(random.normal(size=7)))
    for row in (mode.shift, mode.pull, mode.fluid_spin):
        store3(block, row, 3, tuple(random.normal(size=3)))
    return SimpleNamespace(block=block, mode=mode)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_mirrored_body_goes_on_as_the_mirror_image(lane, sign):
    """By a rotation, and by one with a reflection."""
    block, mode, random = lane.block, lane.mode, np.random.default_rng(5)
    turn = sign * np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn) * sign
    flat = tuple(turn.ravel())
    growth, pull, spin = random.normal(size=7), random.normal(size=3), random.normal(size=3)
    before = block.copy()
    quadratic.advance_mode(block, 3, tuple(growth), 2.0, tuple(spin), 0.3)
    quadratic.advance_shift(block, 3, tuple(pull), 3.0, tuple(spin), 0.3)
    there = [turned(load7(block, row, 3), flat) for row in (mode.B, mode.end)]
    drift = turn @ load3(block, mode.shift_drift, 3)
    block[:] = before
    quadratic.turn_mode(block, 3, flat)
    spin = np.linalg.det(turn) * turn @ spin
    quadratic.advance_mode(block, 3, turned(tuple(growth), flat), 2.0, tuple(spin), 0.3)
    quadratic.advance_shift(block, 3, tuple(turn @ pull), 3.0, tuple(spin), 0.3)
    for row, expected in zip((mode.B, mode.end), there, strict=True):
        assert load7(block, row, 3) == pytest.approx(expected, abs=1e-12)
    assert load3(block, mode.shift_drift, 3) == pytest.approx(drift, abs=1e-12)


def test_a_body_that_a_wall_lets_go_keeps_the_shape_with_which_it_was_held(lane):
    B = load7(lane.block, lane.mode.B, 3)
    quadratic.hold_mode(lane.block, 3, 0.5)
    quadratic.advance_mode(lane.block, 3, (1.0,) * 7, 2.0, (0.0, 0.0, 0.0), 0.3)
    assert load7(lane.block, lane.mode.B, 3) == B


# --- Choice -------------------------------------------------------------------------------------------------


def test_a_wrong_shape_and_the_scheme_of_the_paper_are_refused():
    with pytest.raises(InputError, match=r"the shape is cubic\. Allowed: affine, quadratic"):
        Models(shape="cubic")
    with pytest.raises(InputError, match="quadratic needs the integrator stokes or rosenbrock, not paper"):
        advanced(bodies((0.0, 0.0, 0.0)), analytic.shear(1.0), 1, 1e-4, "paper")


def test_bodies_that_are_no_spheres_are_told():
    p = bodies(np.zeros((3, 3)))
    assert not QuadraticSolid().remarks(Survey(p, None, WATER, 1e-4)).warnings
    set_rest_shape(p, np.array([(1.0, 1.0, 1.0), (2.0, 1.0, 1.0), (1.0, 1.0, 3.0)]))
    (warning,) = QuadraticSolid().remarks(Survey(p, None, WATER, 1e-4)).warnings
    assert warning.startswith("2 of 3 particles are no spheres at rest")
