"""Contact of bodies without inertia with walls: a reaction moves, turns and strains them."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, boundary, box_patches, grid
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.stats import chisquare, kstest

from foamprb.body.brownian import BOLTZMANN, shape_resistance
from foamprb.body.drag import drag
from foamprb.body.ellipsoid import integrals
from foamprb.cloud.block import Medium, at, idle_lanes, new_block, new_frames, new_integrals, store9
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.layout import layout
from foamprb.cloud.patches import Rebound
from foamprb.cloud.pressing import push_of
from foamprb.cloud.state import Status, set_rest_shape, spheres
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.dispersion import StochasticDispersion
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow

STILL = analytic.shear_over_wall(0.0)
UP = np.array([0.0, 0.0, 1.0])
VOLUME = 4.0 / 3.0 * np.pi


def tilted(ratio, degrees):
    """Deformation gradient of a spheroid of volume 4π/3 whose axis leans that far from the floor."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    axis, b = np.array([c, 0.0, s]), ratio ** (-1.0 / 3.0)
    return b * np.eye(3) + (ratio - 1.0) * b * np.outer(axis, axis)


def resting(F, w, mu=1e7, rest=None):
    """A unit body in contact with the floor z = 0, pressed by w μ_s, and its medium."""
    p = spheres(
        [[0.0, 0.0, np.linalg.norm(F[2])]], d=2.0, rho=1.0 + w * mu / VOLUME, mu=mu, poissons_ratio=0.4999
    )
    if rest is not None:
        set_rest_shape(p, rest)
        p.F0[:] = F.ravel()
    p.F[:] = F.ravel()
    return p


def cloud_of(p, dt, around=(), integrator="stokes"):
    models, rho, g = Models(integrator=integrator, surroundings=around), 1.0, 1.0
    if integrator == "rosenbrock":
        # As heavy in the fluid, with hardly any inertia.
        rho, g = 1e-4, 1e4
        p.rho[:] *= rho
    return Cloud(p, STILL, Medium(1.0, rho, (0.0, 0.0, -g)), [Rebound()], dt, models, threads=1)


def lean(p):
    """Angles of the longest axes with the floor, degrees."""
    F = p.F.reshape(-1, 3, 3)
    return np.degrees(np.arcsin(abs(np.linalg.eigh(F @ F.transpose(0, 2, 1))[1][:, 2, 2])))


def test_a_reaction_turns_a_rigid_spheroid_as_perrin_says():
    """The rate of the gap is n·K⁻¹·n + |r × n|²/ζ_r, with Perrin's resistances of 3:1."""
    rows = layout(at)
    lanes = new_block(rows.rows)
    idle_lanes(lanes, rows.initial, 1.0)
    F, n = tilted(3.0, 45.0), tuple(UP)
    store9(lanes, at.new_F, 0, tuple(F.ravel()))
    store9(lanes, at.F, 0, tuple(F.ravel()))
    new_frames(lanes)
    store9(lanes, at.frame, 0, tuple(lanes[at.Q * 16 : (at.Q + 9) * 16 : 16]))
    new_integrals(lanes)
    lanes[at.eta * 16] = 1e9
    c = push_of(lanes, 0, n, 0.0)
    r = -F @ F.T @ UP / np.linalg.norm(F[2])
    np.testing.assert_allclose(c.r, r, rtol=1e-12)
    across = 0.5 / (0.97380 * 6.0 * np.pi) + 0.5 / (1.19787 * 6.0 * np.pi)
    torque = np.cross(r, UP)
    assert c.rate == pytest.approx(across + torque @ torque / (2.34077 * 8.0 * np.pi), rel=1e-5)
    spin = 0.5 * np.array([c.l[7] - c.l[5], c.l[2] - c.l[6], c.l[3] - c.l[1]])
    np.testing.assert_allclose(spin, torque / (2.34077 * 8.0 * np.pi), atol=1e-6)


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
def test_a_rigid_spheroid_that_settles_on_its_tip_lies_down(integrator):
    """3:1 from 45°, against (ζ_n s'² + ζ_r) dφ/dt = −W s'(φ) with Perrin's resistances."""
    F = tilted(3.0, 45.0)
    p = resting(F, 1e-7, rest=np.sort(np.linalg.svd(F)[1])[::-1])
    cloud, found = cloud_of(p, 1.0, integrator=integrator), []
    for steps in (2, 3, 5, 10, 20, 20):
        cloud.advance(steps)
        found.append(lean(p)[0])
    np.testing.assert_allclose(found, [43.417, 41.032, 37.041, 29.066, 13.627, 3.084], atol=0.05)
    assert p.x[0, 2] == pytest.approx(0.70134, abs=1e-3)


@pytest.mark.parametrize("e", [1.0, 0.5])
def test_a_tilted_spheroid_bounces_off_its_tip_and_spins(e):
    """3:1 at 45° in vacuum, with P = (1 + e) m/(1 + m (r × n)·I⁻¹·(r × n)); e = 1 keeps the energy."""
    F = tilted(3.0, 45.0)
    p = resting(F, 1e-7, mu=1e4, rest=np.sort(np.linalg.svd(F)[1])[::-1])
    p.x[:, 2] += 0.537
    p.v[:] = (0.0, 0.0, -1.0)
    vacuum, models = Medium(1e-12, 1e-9, (0.0, 0.0, 0.0)), Models(integrator="rosenbrock")
    Cloud(p, STILL, vacuum, [Rebound(e)], 0.1, models, threads=1).advance(9)
    assert p.v[0, 2] == pytest.approx(-1.0 + (1.0 + e) * 5.0 / 13.0, abs=1e-6)
    energy = 0.5 * (p.v**2).sum() + 0.1 * (p.A**2).sum()
    assert energy == pytest.approx(0.5 - (1.0 - e**2) * 2.5 / 13.0, rel=1e-3)


@pytest.mark.parametrize(
    ("w", "height", "wide", "integrator", "off"),
    [(2.0, 0.863544, 1.15802, "stokes", 2e-6), (10.0, 0.580474, 1.72273, "stokes", 2e-6),
     (2.0, 0.863544, 1.15802, "rosenbrock", 3e-3)],
)  # fmt: skip
def test_a_soft_sphere_is_pressed_as_the_minimum_of_its_energy(w, height, wide, integrator, off):
    """ζ³ + ω ζ² = 1, ω = 3w/4π, b = (1/ζ, 1/ζ, ζ²); with inertia the first order in Δt is left."""
    p = resting(np.eye(3), w, mu=1.0)
    dt, steps = (0.05, 1000) if integrator == "stokes" else (0.02, 800)
    cloud_of(p, dt, integrator=integrator).advance(steps)
    assert p.x[0, 2] == pytest.approx(height, abs=off)
    b = p.F.reshape(3, 3) @ p.F.reshape(3, 3).T
    np.testing.assert_allclose(np.diag(b), [wide, wide, height**2], atol=3.0 * off + 1e-5)
    if integrator == "stokes":
        np.testing.assert_allclose(p.v, 0.0, atol=1e-6)


def test_a_sphere_that_overlaps_the_floor_at_its_release_is_put_onto_it():
    p = resting(np.eye(3), 2.0, mu=1.0)
    p.x[:, 2] = 0.7
    cloud_of(p, 1e-4).advance(10)
    assert p.status[0] == Status.ACTIVE
    assert p.x[0, 2] == pytest.approx(np.linalg.norm(p.F[0, 6:]), abs=1e-6)


@pytest.mark.parametrize("w", [2.0, 10.0])
def test_a_soft_sphere_is_pressed_in_time_as_its_power_says(w):
    """(K + V r/ζ²) dζ/dt = −W − V W_el'(ζ), with the resistances K and r of the spheroid; Δt of 0.05."""
    volume, times = VOLUME, [0.5, 1.0, 2.0, 5.0]

    def rate(_t, zeta):
        axes = (zeta**-0.5, zeta**-0.5, zeta)
        g = integrals(axes)
        r = shape_resistance(axes, g, 0.0).normal
        resistance = drag(axes, g)[2] + volume * (0.25 * (r[0] + r[1]) + r[2]) / zeta**2
        return (-w - volume * (zeta - zeta**-2)) / resistance

    exact = solve_ivp(rate, (0.0, 5.0), [1.0], t_eval=times, rtol=1e-10, atol=1e-12).y[0]
    p, found = resting(np.eye(3), w, mu=1.0), []
    cloud = cloud_of(p, 0.05)
    for steps in (10, 10, 20, 60):
        cloud.advance(steps)
        found.append(p.x[0, 2])
    np.testing.assert_allclose(found, exact, atol=1e-6 * w)


def test_a_soft_sphere_is_pressed_into_an_edge_by_both_walls():
    """Of 90°, by W across each: ζ⁶ + W/(V μ_s) ζ⁵ = 1, the minimum of 2 W ζ + ½ V μ_s (2 ζ² + ζ⁻⁴)."""
    p, w = resting(np.eye(3), 2.0, mu=1.0), 2.0
    p.x[:] = (1.0, -20.0, 1.0)
    p.rho[:] = 1.0 + w / VOLUME
    flow = closed(40.0 * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), 2)
    medium = Medium(1.0, 1.0, (-1.0, 0.0, -1.0))
    Cloud(p, flow, medium, [Rebound()], 0.5, Models(integrator="stokes"), threads=1).advance(200)
    zeta = brentq(lambda z: z**6 + w / VOLUME * z**5 - 1.0, 0.1, 1.0)
    np.testing.assert_allclose(p.x[0, [0, 2]], zeta, atol=2e-6)


@pytest.mark.parametrize(
    ("mu_W", "speed", "spin"), [(9.0, 5.0 / 7.0, 5.0 / 7.0), (3.0, 0.840845, 0.619366), (0.0, 1.0, 0.5)]
)
def test_a_rigid_sphere_on_a_floor_rolls_in_shear(mu_W, speed, spin):
    """It rolls if friction exceeds 12π/7 μ_f κ R², and slides otherwise."""
    p, dt, W = resting(np.eye(3), 1e-6), 0.005, 10.0
    # Light, so that the inertia of body and fluid is small.
    p.rho[:] *= 1e-6
    flow, medium = analytic.shear_over_wall(1.0), Medium(1.0, 1e-6, (0.0, 0.0, -1e6))
    Cloud(p, flow, medium, [Rebound(0.0, mu_W / W)], dt, Models(integrator="stokes"), threads=1).advance(200)
    assert p.x[0, 0] == pytest.approx(speed, rel=2e-3)
    F = p.F.reshape(3, 3)
    assert np.arctan2(F[0, 2] - F[2, 0], F[0, 0] + F[2, 2]) == pytest.approx(spin, rel=2e-3)


@pytest.mark.parametrize(
    ("angle", "force", "lean_of", "energy"),
    [(90.0, (-1.0, 0.0, -1.2), 0.0, 2.539842), (60.0, (-1.0, 0.0, -1.20005), 12.6608, 2.993042)],
)
def test_a_spheroid_in_an_edge_touches_both_walls(angle, force, lean_of, energy):
    """2:1, at the minimum of its energy, with reactions of (1.2, 1.0) and (1.7774, 1.1547)."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    flow = closed(40.0 * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [c, 0.0, s]]), 2)
    F = tilted(2.0, lean_of + 4.0)
    p = resting(F, 1e-7, rest=np.sort(np.linalg.svd(F)[1])[::-1])
    p.x[:] = (2.1, -20.0, 0.9)
    cloud = Cloud(p, flow, Medium(1.0, 1.0, force), [Rebound()], 0.1, Models(integrator="stokes"), threads=1)
    cloud.advance(1000)
    assert -p.x[0] @ force == pytest.approx(energy, abs=5e-5)
    assert lean(p)[0] == pytest.approx(lean_of, abs=0.2)


CLOSED = {
    "wedge of 30 degrees": ([[0, 0, 0], [1, 0, 0], [0.75**0.5, 0, 0.5]], 2),
    "tetrahedron": ([[0, 0, 0], [1, 0, 0], [0.3, 0.9, 0], [0.4, 0.3, 0.8]], 3),
}
"""Corners, and the number of dimensions of the simplex that they span."""


def closed(corners, dimensions):
    """A still flow in one cell between walls, a prism along y if the corners are those of a triangle."""
    both = np.concatenate([corners - (0.0, corners.max(), 0.0), corners]) if dimensions == 2 else corners
    shape = grid(both, [(13 if dimensions == 2 else 10, np.arange(len(both))[None])])
    mesh = build_mesh(shape, boundary(shape, lambda _centre: "wall", {"wall": "wall"}))
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def enclosed(flow, x, model, dt, steps):
    """Points to walls at x in that flow, after steps."""
    p = spheres(x, d=2e-3, rho=1.0, mu=1e9)
    models = Models(integrator="stokes", surroundings=(model,), touching="centre")
    rules = [Rebound()] * len(flow.patches)
    Cloud(p, flow, Medium(1.0, 1.0, (0.0, 0.0, 0.0)), rules, dt, models, threads=1).advance(steps)
    assert (p.status == Status.ACTIVE).all()
    return p.x


FAST = 1e-3 / (6.0 * np.pi * 1e-3)
"""Diffusivity of spheres of 1 mm with kT of 1 mJ, which only their ratio makes fast."""


def still_box():
    """A still fluid in a unit box of 27 cells; eddies of 0.58 m/s live 0.2 s in it."""
    shape = block(3)
    mesh = build_mesh(shape, box_patches(shape))
    turbulence = np.tile([0.5, 2.5, *6 * [0.0]], (len(mesh.nodes), 1))
    u = np.zeros((len(mesh.nodes), 3))
    return MeshFlow(mesh, u, np.zeros((*u.shape, 3)), turbulence=turbulence)


@pytest.mark.filterwarnings("ignore:molecules move particles")
def test_no_body_leaves_a_closed_box():
    """Random steps of a tenth of the box meet two walls at once near each edge."""
    flow, x = still_box(), np.random.default_rng(3).uniform(0.01, 0.99, (600, 3))
    x = enclosed(flow, x, BrownianMotion(T=1e-3 / BOLTZMANN, shape=False), 0.005 / FAST, 100)
    assert ((x >= 0.0) & (x <= 1.0)).all()
    assert min(kstest(x[:, k], "uniform").pvalue for k in range(3)) > 1e-3


@pytest.mark.nightly
@pytest.mark.filterwarnings("ignore:molecules move", "ignore:swimmers turn", "ignore:eddies move")
@pytest.mark.parametrize(
    ("model", "dt"),
    [
        (BrownianMotion(T=1e-3 / BOLTZMANN, shape=False), 0.002 / FAST),
        (Swimming(speed=1.0, rotationalDiffusivity=2.0), 0.03),
        (StochasticDispersion(), 0.03),
        (StochasticDispersion(fluctuations="OpenFOAM"), 0.03),
    ],
)
def test_bodies_in_a_closed_box_stay_uniform(model, dt):
    """4000 bodies over 1000 steps, in 64 parts of the box, by χ²."""
    x = enclosed(still_box(), np.random.default_rng(3).uniform(0.01, 0.99, (4000, 3)), model, dt, 1000)
    assert ((x >= 0.0) & (x <= 1.0)).all()
    counts, _ = np.histogramdd(x, bins=4, range=[(0.0, 1.0)] * 3)
    assert chisquare(counts.ravel()).pvalue > 1e-3


@pytest.mark.filterwarnings("ignore:molecules move particles", "ignore:swimmers turn at random")
@pytest.mark.parametrize("name", CLOSED)
@pytest.mark.parametrize("model", ["molecules", "swimmers"])
def test_no_body_leaves_a_sharp_corner(name, model):
    """And they stay uniform: the share λ of a corner of an n-simplex has the distribution 1 − (1 − λ)ⁿ."""
    corners, n = np.array(CLOSED[name][0], dtype=float), CLOSED[name][1]
    random = np.random.default_rng(3)
    x = 0.98 * random.dirichlet(np.ones(n + 1), 500) @ corners + 0.02 * corners.mean(axis=0)
    x[:, 1] -= random.uniform(0.01, 0.99, 500) if n == 2 else 0.0
    molecules, dt = BrownianMotion(T=1e-3 / BOLTZMANN, shape=False), 0.002 / FAST
    swimmers = Swimming(speed=1.0, rotationalDiffusivity=2.0)
    chosen = (molecules, dt) if model == "molecules" else (swimmers, 0.05)
    x = enclosed(closed(corners, n), x, *chosen, 60)
    axes = [0, 2] if n == 2 else [0, 1, 2]
    shares = np.linalg.solve(
        np.vstack([corners[:, axes].T, np.ones(n + 1)]), np.vstack([x[:, axes].T, np.ones(len(x))])
    )
    assert shares.min() > -1e-9
    assert min(kstest(1.0 - (1.0 - shares.clip(0.0, 1.0)) ** n, "uniform", axis=1).pvalue) > 1e-3


# --- Molecules over a floor ---------------------------------------------------------------------------------

KT = 1e-3
D = KT / (6.0 * np.pi)
"""Of a unit sphere in a fluid of viscosity 1."""


def leaning(n, ratio, scale):
    """F of n spheroids as Boltzmann has them with kT over the weight of ``scale``."""
    random, angles, a = np.random.default_rng(11), [], ratio ** (2.0 / np.array([1.5, -3.0, -3.0]))
    while len(angles) < n:
        q = random.uniform(-1.0, 1.0)
        if random.random() < np.exp((a[1] ** 0.5 - np.sqrt(a[0] * q * q + a[1] * (1.0 - q * q))) / scale):
            angles.append(np.degrees(np.arcsin(q)))
    return np.array([tilted(ratio, angle) for angle in angles]), np.sqrt(a)


def over_floor(n, F, rest, around, steps, dt=0.002, scale=1.0, mu=1e4):
    """Bodies of μ_s/kT with kT over the weight of ``scale``, from exponential gaps on; their gaps then."""
    weight = KT / VOLUME / scale
    height = np.linalg.norm(F[:, 2], axis=1) + np.random.default_rng(7).exponential(scale, size=n)
    x = np.stack([0 * height, 0 * height, height], axis=1)
    p = spheres(x, d=2.0, rho=1.0 + weight, mu=mu * KT, poissons_ratio=0.4999)
    if rest is not None:
        set_rest_shape(p, rest)
        p.F0[:] = F.reshape(n, 9)
    p.F[:] = F.reshape(n, 9)
    cloud_of(p, dt / D, around).advance(steps)
    return p, p.x[:, 2] - np.linalg.norm(p.F.reshape(n, 3, 3)[:, 2], axis=1)


MOLECULES = BrownianMotion(T=KT / BOLTZMANN)


def test_molecules_keep_bodies_over_a_floor_in_boltzmanns_equilibrium():
    """2:1 spheroids: the force that is held through sub-steps is mirrored, and torque and force together."""
    n = 500
    F, rest = leaning(n, 2.0, 1.0)
    p, gap = over_floor(n, F, rest, (MOLECULES,), 150)
    assert (p.status == Status.ACTIVE).all()
    assert np.mean(gap < 0.05) == pytest.approx(0.0488, abs=3.0 * np.sqrt(0.0488 / n))
    assert np.mean(gap < 0.002) < 0.002 + 4.0 * np.sqrt(0.002 / n)
    assert np.mean(np.sin(np.radians(lean(p))) ** 2) == pytest.approx(0.2657, abs=0.035)


def test_stiff_bodies_do_not_hover_by_the_stress_of_molecules():
    """Their solid balances it: no stresslet. The order of the models is no matter."""
    n, F = 160, np.tile(np.eye(3), (160, 1, 1))
    found = [
        over_floor(n, F, None, order, 60, 0.01)
        for order in ((MOLECULES, WallLift()), (WallLift(), MOLECULES))
    ]
    assert np.array_equal(found[0][0].x, found[1][0].x)
    assert found[0][1].mean() == pytest.approx(1.0, abs=4.0 / np.sqrt(n))


def test_soft_bodies_with_wall_lift_fluctuate_with_the_mobility_of_their_motion():
    """A force strains them by its image in the wall, that of molecules too: ⟨s⟩ = 0.979 for ℓ = 0.3."""
    n, scale = 400, 0.3
    F = np.tile(np.diag([0.979**-0.5, 0.979**-0.5, 0.979]), (n, 1, 1))
    p, gap = over_floor(n, F, None, (MOLECULES, WallLift()), 500, 0.001, scale, 20.0 / VOLUME)
    assert gap.mean() / scale == pytest.approx(1.0, abs=3.0 / np.sqrt(n))
    assert np.mean(gap < 0.2 * scale) == pytest.approx(0.1813, abs=3.0 * np.sqrt(0.1813 / n))
    reach = np.linalg.norm(p.F.reshape(n, 3, 3)[:, 2], axis=1)
    assert reach.mean() == pytest.approx(0.979, abs=4.0 * reach.std() / np.sqrt(n))


@pytest.mark.parametrize("mu", [1e4, 10.0])
def test_a_body_at_rest_on_a_floor_with_wall_lift_takes_long_steps(mu):
    """Of many relaxation times; its load has strained it, and the reaction does not do so again."""
    p = spheres([[0.0, 0.0, 5e-6]], d=1e-5, rho=1100.0, mu=mu, poissons_ratio=0.4999)
    water = Medium(1e-3, 1000.0, (0.0, 0.0, -9.81))
    cloud = Cloud(p, STILL, water, [Rebound()], 1e-2, Models(surroundings=(WallLift(),), stride=1))
    cloud.advance(4)
    strain = p.F[0, 8] - 1.0
    cloud.advance(4)
    assert p.substeps[0] <= 1.0
    assert p.F[0, 8] - 1.0 == pytest.approx(strain, rel=1e-6)


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("scale", "k", "reach", "wide", "strain", "models"),
    [
        (1.0, 20.0, 1.0155, 1.0475, 0.2489, 1),
        (0.1, 20.0, 0.8870, 0.7991, 0.2892, 1),
        (0.05, 100.0, 0.9437, 0.8935, 0.0597, 1),
        (1.0, 20.0, 1.0155, 1.0475, 0.2489, 2),
    ],
)
def test_soft_spheres_over_a_floor_have_the_shapes_of_boltzmann(scale, k, reach, wide, strain, models):
    """⟨s⟩, ⟨b_nn⟩, ⟨tr b − 3⟩ for k = V μ_s/kT and p(b) ∝ exp(−s/ℓ − V W/kT); to four errors."""
    n = 4000
    # Of the mean height, so that gaps hardly change while the shapes come to equilibrium.
    F = np.tile(np.diag([reach**-0.5, reach**-0.5, reach]), (n, 1, 1))
    dt = min(0.002, 0.005 * scale**2)
    p, gap = over_floor(n, F, None, (MOLECULES, WallLift())[:models], 1100, dt, scale, k / VOLUME)
    b = p.F.reshape(n, 3, 3) @ p.F.reshape(n, 3, 3).transpose(0, 2, 1)
    for values, expected, own in (
        (gap / scale, 1.0, 0.0), (np.sqrt(b[:, 2, 2]), reach, 4e-4), (b[:, 2, 2], wide, 8e-4),
        (np.trace(b, axis1=1, axis2=2) - 3.0, strain, 6e-4),
    ):  # fmt: skip
        assert values.mean() == pytest.approx(expected, abs=4.0 * np.hypot(values.std() / n**0.5, own))


@pytest.mark.nightly
@pytest.mark.parametrize(
    ("scale", "cos_2", "models"),
    [(1.0, 0.2657, 1), (0.2, 0.1075, 1), (1.0, None, 2), (1.0, 0.2657, 2), (0.2, 0.1075, 2)],
)
def test_stiff_bodies_over_a_floor_are_as_boltzmann_has_them(scale, cos_2, models):
    """2:1 spheroids, and spheres with the hindrance by the wall; gaps are exponential."""
    n = 2000
    F, rest = leaning(n, 2.0, scale) if cos_2 else (np.tile(np.eye(3), (n, 1, 1)), None)
    around = (MOLECULES, WallLift())[:models]
    p, gap = over_floor(n, F, rest, around, 150, 0.002 if scale == 1.0 else 2.5e-4, scale)
    assert gap.mean() / scale == pytest.approx(1.0, abs=4.0 / n**0.5)
    for share in (0.01, 0.05, 0.2):
        expected = 1.0 - np.exp(-share)
        assert np.mean(gap < share * scale) == pytest.approx(expected, abs=4.0 * np.sqrt(expected / n) + 1e-3)
    if cos_2:
        values = np.sin(np.radians(lean(p))) ** 2
        assert values.mean() == pytest.approx(cos_2, abs=4.0 * values.std() / n**0.5)
