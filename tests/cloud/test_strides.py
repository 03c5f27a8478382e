"""Steps that go through several tracking steps, where the error allows it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mesh_shapes import block, box_patches, grid
from small_clouds import assert_same

from foamprb import analytic
from foamprb.body.error_control import GROWTH
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.contact import rebounds_of
from foamprb.cloud.integrators.adaptive import stretch_in, stretch_of
from foamprb.cloud.patches import Escape, Mirror, Rebound, Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.fates import FateLimits, Fates
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow

ADAPTIVE = ("rosenbrock", "stokes")
HEAVY = Medium(1.0, 1.0, (0.0, 0.0, 0.0))


def in_shear(integrator, stride, dt=0.01, Ca=(1e-3, 0.1, 0.5), tolerance=1e-4):
    """Bodies of several softness in a shear of rate 1, of shape Stokes number 0.01."""
    p = spheres(np.zeros((len(Ca), 3)), d=2.0, rho=0.15, mu=1.0 / np.array(Ca))
    models = Models(integrator=integrator, tolerance=tolerance, stride=stride)
    return Cloud(p, analytic.shear(1.0), HEAVY, (), dt, models, threads=1)


def in_mesh_shear(integrator, dt):
    """A body at rest in a shear of rate 1 on a mesh, with steps of any length."""
    mesh = build_mesh(shape := block(4, 0.0), box_patches(shape))
    gradient = np.zeros((3, 3))
    gradient[0, 1] = 1.0
    flow = MeshFlow(mesh, (mesh.nodes - 0.5) @ gradient.T, np.broadcast_to(gradient, (len(mesh.nodes), 3, 3)))
    p = spheres(np.full((3, 3), 0.5), d=0.02, rho=1500.0, mu=1.0 / np.array([1e-3, 0.1, 0.5]))
    models = Models(integrator=integrator, stride=None)
    return Cloud(p, flow, HEAVY, [Rebound()] * len(flow.patches), dt, models, threads=1)


def towards_lid(integrator, stride, lid, d=0.02, z=(0.213,), dt=0.004, rate=1.0):
    """Nearly rigid bodies in a stream w = rate (0.2 + z) in a cube, which carries them to its lid."""
    mesh = build_mesh(shape := block(4, 0.0), box_patches(shape))
    nodes, gradient = mesh.nodes, np.zeros((len(mesh.nodes), 3, 3))
    gradient[:, 2, 2] = rate
    u = np.outer(rate * (0.2 + nodes[:, 2]), [0.0, 0.0, 1.0])
    p = spheres([[0.4, 0.6, each] for each in z], d=d, rho=1e-3, mu=1e5)
    p.v[:, 2] = rate * (0.2 + p.x[:, 2])
    flow = MeshFlow(mesh, u, gradient)
    walls = [lid if each.name == "lid" else Rebound() for each in flow.patches]
    models = Models(integrator=integrator, stride=stride, rebounds=True)
    return Cloud(p, flow, HEAVY, walls, dt, models, threads=1)


def arrival(z0, z):
    """When what is carried from z0 comes to z, s."""
    return np.log((0.2 + z) / (0.2 + np.asarray(z0)))


def settled(cloud, z):
    """The same, of which the bodies have their shapes in the stream, at z, ready for steps of eight Δt."""
    cloud.advance(24)
    p, flow = cloud.particles, cloud.flow
    p.x[:, 2] = z
    p.host[:] = flow.locate(p.x)
    p.v[:], _ = flow.sample(p.x, p.host, 0.0)
    p.h[:] = 8 * cloud.dt
    return cloud


@pytest.mark.parametrize("integrator", ADAPTIVE)
class TestShear:
    def test_a_step_is_as_long_as_its_error_and_the_stride_allow(self, integrator):
        for stride in (1, 2, 3, 4):
            cloud = in_shear(integrator, stride)
            cloud.advance(96)
            assert cloud.particles.substeps == pytest.approx(1.0 / stride)
            assert np.all(cloud.particles.h <= stride * cloud.dt)
        # Not longer than 1.1/γ̇ = 1.1 s: 10 steps in 10.24 s.
        cloud = in_shear(integrator, 256)
        cloud.advance(2 * 2048)
        assert cloud.particles.substeps == pytest.approx(10.0 / 1024.0)

    @pytest.mark.parametrize(("steps", "taken"), [(64, 14), (5, 1), (6, 2), (1, 1)])
    def test_steps_need_not_end_with_tracking_steps(self, integrator, steps, taken):
        """Of up to 5 Δt, 1.1 of the inverse of the gradient, there are as few as fit."""
        cloud = in_shear(integrator, 8, dt=0.22, tolerance=10.0)
        cloud.advance(64)
        cloud.advance(steps)
        assert cloud.particles.substeps == pytest.approx(taken / steps)

    def test_steps_grow_by_a_half_at_most(self, integrator):
        """From s, n of them come no farther than s (1.5ⁿ − 1)/0.5; about so far if no error is too large."""
        cloud = in_shear(integrator, 1, tolerance=10.0)
        cloud.advance(1)
        cloud.particles.h[:] = 0.01 * cloud.dt
        cloud.advance(1)
        least = math.log(1.0 + (GROWTH - 1.0) / 0.01, GROWTH)
        assert np.all((cloud.particles.substeps >= least) & (cloud.particles.substeps < least + 3.0))

    def test_the_error_stays_below_the_tolerance_times_the_steps(self, integrator):
        """Over the first shear times, of all bodies, as it does in steps of Δt."""
        exact = in_shear(integrator, 1, dt=1e-3, tolerance=1e-8)
        exact.advance(3000)
        F = exact.particles.F
        scale = np.linalg.norm(F, axis=1)
        for stride in (1, 4, 16):
            cloud = in_shear(integrator, stride)
            cloud.advance(300)
            error = np.linalg.norm(cloud.particles.F - F, axis=1) / scale
            assert np.all(error < 1e-4 * 300 / stride)

    def test_all_come_to_the_end_of_a_call_and_no_farther(self, integrator):
        cloud = in_shear(integrator, 4)
        for steps in (64, 7, 1, 3):
            cloud.advance(steps)
            np.testing.assert_array_equal(cloud.particles.t, cloud.start + cloud.step * cloud.dt)

    def test_one_that_appears_within_a_step_goes_on_at_the_multiples(self, integrator):
        clouds = in_shear(integrator, 1, tolerance=1e-7), in_shear(integrator, 4)
        for cloud in clouds:
            cloud.particles.t0[:] = cloud.particles.t[:] = 0.05, 0.0533, 0.06
            cloud.particles.status[:] = Status.PENDING
            cloud.advance(64)
            np.testing.assert_array_equal(cloud.particles.t, cloud.time)
        exact, late = (cloud.particles.F for cloud in clouds)
        assert np.abs(late - exact).max() < 1e-4 * 64 / 4
        assert clouds[1].particles.substeps == pytest.approx(0.25)


def through_jet(integrator, width):
    """Bodies in a stream of 1 cell per Δt, released at all phases, and a jet of some cells across it."""
    n, first = 48, 24
    points = np.array([(i, j, k) for i in range(n + 1) for j in (0, 1) for k in (0, 1)])
    shape = grid(points, [(12, 4 * np.arange(n)[:, None] + [0, 4, 6, 2, 1, 5, 7, 3])])
    mesh = build_mesh(shape, box_patches(shape))

    def velocity(centres):
        in_jet = (centres[:, 0] > first) & (centres[:, 0] < first + width)
        return np.stack([np.ones(len(centres)), np.where(in_jet, 0.1, 0.0), np.zeros(len(centres))], axis=1)

    flow = MeshFlow(mesh, *Reconstruction(mesh)(velocity(mesh.centres), velocity(mesh.boundary_centres)))
    starts = np.stack([np.linspace(0.5, 8.5, 100), np.full(100, 0.5), np.full(100, 0.5)], axis=1)
    p = spheres(starts, d=1e-3, rho=1e-3, mu=1e4)
    models = Models(integrator=integrator, stride=8, rebounds=True)
    return Cloud(p, flow, HEAVY, [Escape()] * len(flow.patches), 1.0, models, threads=1)


@pytest.mark.parametrize("width", [1, 2, 3])
@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_no_long_step_misses_a_narrow_jet(integrator, width):
    """The jet moves each body across by its flux through the path."""
    cloud = through_jet(integrator, width)
    path = np.stack([np.linspace(0.005, 47.995, 4800), np.full(4800, 0.5), np.full(4800, 0.5)], axis=1)
    u, _ = cloud.flow.sample(path, cloud.flow.locate(path), 0.0)
    cloud.advance(36)
    np.testing.assert_allclose(cloud.particles.x[:, 1] - 0.5, 0.01 * u[:, 1].sum(), rtol=0.05)
    assert np.all(cloud.particles.substeps < 1.0)


@pytest.mark.parametrize("stride", [1, 8])
@pytest.mark.parametrize("integrator", ADAPTIVE)
class TestPatches:
    """What happens there is found to the chord of a path in Δt, 2e-6 s, not in eight, 1.3e-4 s."""

    START = np.linspace(0.113, 0.213, 40)

    @pytest.mark.parametrize("d", [0.02, 0.2])
    def test_a_body_sticks_where_and_when_it_touches_the_wall(self, integrator, stride, d):
        cloud = towards_lid(integrator, stride, Stick(), d, self.START)
        cloud.advance(384)
        p = cloud.particles
        assert np.all(p.status == Status.STUCK)
        assert p.t == pytest.approx(arrival(self.START, 1.0 - 0.5 * d), abs=1e-5)
        assert p.x[:, 2] == pytest.approx(1.0 - 0.5 * d, abs=1e-5)

    def test_it_leaves_where_and_when_its_centre_does(self, integrator, stride):
        cloud = towards_lid(integrator, stride, Escape(), z=self.START)
        cloud.advance(384)
        p = cloud.particles
        assert np.all(p.status == Status.ESCAPED)
        assert p.t == pytest.approx(arrival(self.START, 1.0), abs=1e-5)
        np.testing.assert_allclose(p.x, [[0.4, 0.6, 1.0]] * len(p.x), atol=1e-9)

    def test_it_bounces_when_it_touches_the_wall(self, integrator, stride):
        cloud = towards_lid(integrator, stride, Rebound(e=0.9), 0.2, self.START)
        cloud.advance(384)
        found = rebounds_of(cloud.take_rebounds())
        first = [found.t[found.number == k].min() for k in range(len(self.START))]
        assert first == pytest.approx(arrival(self.START, 0.9), abs=1e-5)

    def test_a_mirror_does_not_cut_steps(self, integrator, stride):
        """It is not touched: a body's centre goes through it and comes back as its own image."""
        cloud = settled(towards_lid(integrator, stride, Mirror(), dt=0.02, rate=1e-3), 0.9999)
        for z in (0.999908, 0.9999):
            cloud.advance(8)
            assert cloud.particles.substeps[0] == pytest.approx(1.0 / stride)
            assert cloud.particles.x[0, 2] == pytest.approx(z, abs=1e-6) or stride < 8
        assert cloud.particles.x[0, 2] < 1.0

    @pytest.mark.parametrize(("rate", "too_close"), [(-0.15, False), (0.03, False), (0.036, True)])
    def test_close_to_a_wall_a_long_step_leaves_a_tenth_of_the_gap(self, integrator, stride, rate, too_close):
        """From a gap of 0.7 R, 8 Δt lead a body away, or 0.57 R or 0.68 R closer."""
        cloud = settled(towards_lid(integrator, stride, Stick(), dt=0.02, rate=rate), 0.983)
        cloud.advance(8)
        one = 1.0 / stride
        assert (cloud.particles.substeps[0] > one + 1e-9) == (too_close and stride > 1)


@pytest.mark.parametrize("calls", [(192,), (64, 128), (128, 64)], ids=str)
def test_prepared_flow_of_an_aligned_call_changes_no_bit(calls):
    """No step goes past a time of the flow, wherever a call ends."""
    mesh = build_mesh(shape := block(3, 0.1), box_patches(shape))
    x = mesh.nodes - 0.5
    rate = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])

    def read(k):
        return 0.03 * (3 + k) * x @ rate.T, np.tile(0.03 * (3 + k) * rate, (len(x), 1, 1))

    def cloud():
        flow = SeriesFlow(mesh, [0.0, 0.13, 0.31, 0.7, 2.2], read)
        p = spheres(0.3 + 0.4 * np.random.default_rng(1).random((20, 3)), d=1e-2, rho=1.0, mu=10.0)
        models = Models(integrator="stokes", stride=8)
        return Cloud(p, flow, HEAVY, [Rebound() for _ in flow.patches], 0.01, models, threads=1)

    whole, parts = cloud(), cloud()
    whole.advance(192)
    for steps in calls:
        parts.advance(steps)
    assert_same(whole.particles, parts.particles)
    assert whole.particles.substeps.max() <= 0.25


@pytest.mark.parametrize(
    ("dt", "stretch"), [(0.1, 32), (0.047, 32), (0.046, 64), (0.003, 992), (1e-9, 2**14)]
)
def test_a_shorter_tracking_step_makes_no_shorter_stretch(dt, stretch):
    """Of up to 3/γ̇, and at least 32 tracking steps."""
    assert stretch_in(1.0, dt) == stretch
    assert stretch_in(0.0, dt) == 32


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_a_tenth_of_the_tracking_step_takes_no_more_steps(integrator):
    """And calls that end at ends of stretches change no bit."""
    taken = []
    for dt, steps in ((0.03, 192), (0.003, 1984)):
        whole, parts = (in_mesh_shear(integrator, dt) for _ in range(2))
        whole.advance(steps)
        n = whole.tracker.stretch_steps
        for part in (n, steps - n):
            parts.advance(part)
        assert_same(whole.particles, parts.particles)
        taken.append(whole.particles.substeps / dt)
    assert np.all(taken[1] <= 1.1 * taken[0])


@pytest.mark.parametrize("stride", [0, -4, 2.5, 4.0, math.nan, math.inf])
def test_stride_must_be_a_positive_integer(stride):
    with pytest.raises(InputError, match=f"the stride is {stride}. Allowed: whole numbers"):
        in_shear("stokes", stride)


@pytest.mark.parametrize("stride", [4, 5, 7])
def test_calls_that_end_at_ends_of_stretches_change_no_bit(stride):
    whole, parts = (in_shear("stokes", stride) for _ in range(2))
    n = stretch_of(stride)
    whole.advance(2 * n)
    parts.advance(n)
    parts.advance(n)
    assert_same(whole.particles, parts.particles)
    assert whole.particles.substeps == pytest.approx(1.0 / stride)


SMOOTH = (
    FaxenCorrection(), SaffmanMeiLift(), WallLift(), Swimming(speed=1e-3),
    Fates(ruptured=FateLimits(dose=1e9)),
)  # fmt: skip


def test_models_that_change_smoothly_take_steps_as_long_as_none():
    """All in one loop: one that may not would shorten the steps of all."""
    p = spheres(np.array([[0.0, 0.0, 50.0]]), d=2.0, rho=0.15, mu=10.0)
    models = Models(integrator="stokes", surroundings=SMOOTH, stride=4)
    cloud = Cloud(p, analytic.shear_over_wall(1.0), HEAVY, (Rebound(),), 0.01, models, threads=1)
    cloud.advance(96)
    assert p.substeps == pytest.approx(0.25)


def test_fixed_steps_and_models_of_each_step_keep_the_tracking_step():
    for models in (
        Models(integrator="paper", stride=4),
        Models(integrator="stokes", tolerance=math.inf, stride=4),
        Models(integrator="stokes", surroundings=(Surrounding(),), stride=4),
    ):
        p = spheres(np.zeros((1, 3)), d=1.0, rho=1.0, mu=1.0)
        assert Cloud(p, analytic.shear(1.0), HEAVY, (), 0.01, models, threads=1).tracker.stride == 1
