from __future__ import annotations

import numba
import numpy as np
import pytest
from mesh_shapes import block, box_patches
from small_clouds import assert_same

from foamprb import analytic
from foamprb.body.ellipsoid import reach
from foamprb.body.material import MATERIALS, stored_energy
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Reason, Status, spheres
from foamprb.cloud.tracker import Models, Outcome
from foamprb.compile import link as linking
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.series import SeriesFlow

AIR = Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))
WALL_RATE, RADIUS, D = 923.8, 2.1e-3, 5e-6
MEAN = WALL_RATE * RADIUS / 4


def walk_fails(flow, host, x0, x1):
    return host, 0.0, -2, -1


def recover_above(flow, x):
    return 0 if x[2] >= 0.0 else -1


PAPER = Models(integrator="paper")


def modulus(Ca):
    return AIR.mu * WALL_RATE / np.asarray(Ca)


def pipe_cloud(Ca, dt=2e-5, x=(0.0, -1.65e-3, 0.0), wall=None, length=0.3, touching="ellipsoid", **options):
    Ca = np.atleast_1d(Ca)
    p = spheres(np.tile(x, (len(Ca), 1)), d=D, rho=2560.0, mu=modulus(Ca))
    chosen = {k: options.pop(k) for k in ("drag", "traction", "integrator") if k in options}
    models = Models(touching=touching, **({"integrator": "paper"} | chosen))
    flow = analytic.pipe(RADIUS, MEAN, length)
    return Cloud(p, flow, AIR, (wall or Stick(), Escape(), Escape()), dt, models, **options)


def scattered_cloud(n=70, **options):
    random = np.random.default_rng(1)
    cloud = pipe_cloud(np.linspace(0.05, 1.0, n), length=0.03, **options)
    p = cloud.particles
    r, phi = RADIUS * np.sqrt(random.uniform(0, 0.98, n)), random.uniform(0, 2 * np.pi, n)
    r[:5], phi[:5] = 0.996 * RADIUS, np.pi
    p.x[:] = p.x0[:] = np.stack([random.uniform(0, 0.02, n), r * np.cos(phi), r * np.sin(phi)], axis=1)
    p.t0[:] = p.t[:] = random.uniform(0, 5e-3, n)
    return cloud


@pytest.mark.parametrize("calls", [(20,), (3, 1, 16)], ids=str)
@pytest.mark.parametrize("start", [0.0, 0.2])
@pytest.mark.parametrize("stride", [1, 4])
def test_a_flow_that_changes_is_followed_from_one_of_its_times_to_the_next(calls, start, stride):
    """In one call past several of them: the way of a tracer is the area under the velocity's corners."""
    times, speed = [0.0, 0.25, 0.5, 0.8, 1.3], [1.0, 0.0, 0.5, -0.5, 1.0]
    shape = block(2, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    n = len(mesh.nodes)
    way = np.array([0.3, 0.2, -0.1])
    flow = SeriesFlow(mesh, times, lambda k: (np.tile(speed[k] * way, (n, 1)), np.zeros((n, 3, 3))))
    p = spheres([[0.5, 0.5, 0.5]], d=1e-6, rho=1e3, mu=1e3, t0=start)
    medium = Medium(1.0, 1e3, (0.0, 0.0, 0.0))
    walls = [Rebound() for _ in flow.patches]
    models = Models(integrator="stokes", stride=stride)
    cloud = Cloud(p, flow, medium, walls, 0.05, models, threads=1, start=start)
    for steps in calls:
        cloud.advance(steps)
    t = np.linspace(start, start + 1.0, 2001)
    assert p.t[0] == pytest.approx(start + 1.0)
    assert p.x[0] - 0.5 == pytest.approx(np.trapezoid(np.interp(t, times, speed), t) * way, abs=1e-7)


@pytest.mark.parametrize("integrator", ["paper", "stokes"])
def test_a_shorter_last_step_is_a_step_of_that_length(integrator):
    """51.685 steps; some particles are released in the last one."""
    end = 1.0337e-3
    cloud = scattered_cloud(integrator=integrator, end=end)
    cloud.particles.t0[-3:] = cloud.particles.t[-3:] = 51.3 * cloud.dt
    cloud.advance(100)
    assert (cloud.step, cloud.time) == (52, end)
    assert cloud.particles.t[cloud.particles.status == Status.ACTIVE] == pytest.approx(end, rel=1e-14)
    first = scattered_cloud(integrator=integrator)
    first.particles.t0[-3:] = first.particles.t[-3:] = 51.3 * first.dt
    first.advance(51)
    last = Cloud(
        first.particles, first.flow, AIR, first.interactions, end - first.time, first.models, start=first.time
    )
    last.advance(1)
    found, expected = cloud.particles, last.particles
    assert (found.status == expected.status).all()
    np.testing.assert_allclose(found.x, expected.x, rtol=1e-11)
    np.testing.assert_allclose(found.F, expected.F, rtol=0.0, atol=1e-10)


class TestPipe:
    """Sect. 5.4 with the exact profile."""

    def test_a_stuck_ellipsoid_touches_the_wall(self):
        cloud = pipe_cloud([1e-4, 0.25, 1.0])
        cloud.advance(20_000)
        for x, F in zip(cloud.particles.x, cloud.particles.F, strict=True):
            r = np.hypot(x[1], x[2])
            n = (0.0, -x[1] / r, -x[2] / r)
            # The moment of contact is found to second order in the step.
            assert r + reach(D / 2, tuple(F), n) == pytest.approx(RADIUS, abs=2e-4 * D)

    def test_a_particle_leaves_where_the_pipe_ends(self):
        cloud = pipe_cloud(0.1, x=(0.0, 0.0, 0.0), length=0.01)
        cloud.advance(5_000)
        p = cloud.particles
        assert p.status[0] == Status.ESCAPED
        assert cloud.flow.patches[p.patch[0]].name == "outlet"
        assert p.x[0, 0] == pytest.approx(0.01, rel=1e-12, abs=0.0)


class TestBookkeeping:
    def test_every_particle_is_accounted_for_at_every_step(self):
        cloud = scattered_cloud()
        injected = 0
        for _ in range(150):
            cloud.advance(10)
            counts = cloud.particles.counts()
            assert sum(counts.values()) == cloud.particles.size
            assert counts[Status.FAILED] == 0
            now = cloud.particles.size - counts[Status.PENDING]
            assert now >= injected
            assert now == np.count_nonzero(cloud.particles.t0 < cloud.time)
            injected = now
        assert counts[Status.ESCAPED] > 0
        assert counts[Status.STUCK] > 0

    def test_compiled_and_plain_text_agree(self, monkeypatch):
        """The same text as plain Python, on one block in a shear flow."""
        clouds = []
        for _ in range(2):
            p = spheres(np.zeros((2, 3)), d=D, rho=2560.0, mu=modulus([0.1, 0.7]))
            clouds.append(Cloud(p, analytic.shear(500.0), AIR, (), 2e-5, PAPER))
        compiled, plain = clouds
        compiled.advance(5)
        monkeypatch.setattr(linking, "_dispatchers", {})
        monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
        monkeypatch.setenv(linking.SWITCH, "1")
        flow, tracker = plain.flow.arrays(0.0, ()), plain.tracker
        track = tracker.linked(flow, ())
        assert not hasattr(track, "signatures")
        with np.errstate(all="ignore"):
            track(
                flow, tracker.table, tracker.medium, plain.particles, np.arange(2), 0, 5, plain.dt, 0.0,
                tracker._scratch(),
            )  # fmt: skip
        for name in ("x", "v", "F"):
            a, b = getattr(compiled.particles, name), getattr(plain.particles, name)
            np.testing.assert_allclose(a, b, rtol=1e-12, atol=1e-14)

    def test_a_step_beyond_stability_ends_particles_with_a_reason_and_no_others(self):
        cloud = pipe_cloud([1e-3, 1.0, 1.0], dt=4e-4)
        p = cloud.particles
        p.R[0] *= 20  # a larger sphere relaxes 400 times slower
        Stepper(cloud).advance(300)
        assert p.status[0] != Status.FAILED
        assert (p.status[1:] == Status.FAILED).all()
        assert all(p.reason[1:] != Reason.NONE)
        assert np.isfinite(p.x).all()

    def test_a_particle_due_at_the_end_of_a_step_starts_in_the_next(self):
        """Otherwise its first step would have a length of round-off, and its rate of deformation be noise."""
        cloud = pipe_cloud(0.5)
        cloud.particles.t0[:] = np.nextafter(3 * cloud.dt, 0.0)
        cloud.advance(3)
        assert cloud.particles.status[0] == Status.PENDING
        cloud.advance(1)
        reference = pipe_cloud(0.5)
        reference.advance(1)
        np.testing.assert_allclose(cloud.particles.F, reference.particles.F, atol=1e-15)
        np.testing.assert_allclose(cloud.particles.A, reference.particles.A, rtol=1e-12, atol=1e-9)

    def test_normals_of_walls_are_found_with_the_compiled_parts_of_the_loop(self, monkeypatch):
        """The long kernels take seconds to compile."""

        def with_own_machine_code():
            return {key: d for key, d in linking._dispatchers.items() if id(d) in linking._stores}

        monkeypatch.setattr(linking, "_dispatchers", {})
        cloud = pipe_cloud(0.5)
        cloud.tracker.compile(cloud.make_ready())
        before = with_own_machine_code()
        cloud.contact_normals(cloud.particles)
        names = [d.py_func.__name__ for key, d in with_own_machine_code().items() if key not in before]
        # The gap of a particle is the kernel of the cloud for that of a lane.
        assert sorted(names) == ["contact_normals", "unpacking"]

    def test_failed_walk_is_recovered_by_the_tree_and_counted(self):
        cloud = self.in_shear(0.0, walk=walk_fails, recover=recover_above)
        cloud.advance(7)
        assert cloud.recovered == 7
        assert cloud.particles.status[0] == Status.ACTIVE
        reference = self.in_shear(0.0)
        reference.advance(7)
        np.testing.assert_array_equal(cloud.particles.x, reference.particles.x)

    def test_particle_outside_the_tree_fails_with_reason_and_place(self):
        cloud = self.in_shear(-1e-3, walk=walk_fails, recover=recover_above)
        Stepper(cloud).advance(7)
        p = cloud.particles
        assert (p.status[0], p.reason[0]) == (Status.FAILED, Reason.LOST)
        assert np.isfinite(p.x).all()
        assert p.t[0] == pytest.approx(cloud.dt)

    def in_shear(self, z, **kernels):
        flow = analytic.shear(100.0)
        flow.kernels = {**flow.kernels, **kernels}
        p = spheres([[0.0, 1e-3, z]], d=D, rho=2560.0, mu=modulus(0.1))
        return Cloud(p, flow, AIR, (), 2e-5, PAPER)


class TestWalls:
    @pytest.mark.parametrize("integrator", ["paper", "rosenbrock", "stokes"])
    def test_a_body_at_rest_on_a_bouncing_wall_does_not_sink_into_it(self, integrator):
        """Without restitution it stays in touch and slides; its centre keeps its distance."""
        p = spheres([[0.05, -RADIUS + 0.6 * D, 0.0]], d=D, rho=2560.0, mu=modulus(0.01))
        walls = (Rebound(0.0, 0.0), Escape(), Escape())
        flow = analytic.pipe(RADIUS, MEAN, 1.0)
        cloud = Cloud(p, flow, AIR, walls, 2e-5, Models(integrator=integrator))
        cloud.advance(3000)
        assert p.status[0] == Status.ACTIVE
        assert p.x[0, 0] > 0.05
        # Free fall in that time would be forty diameters.
        assert RADIUS - np.hypot(p.x[0, 1], p.x[0, 2]) == pytest.approx(D / 2, rel=0.05)

    def test_a_particle_released_in_touch_with_a_sticky_wall_stays_there(self):
        cloud = pipe_cloud(0.1, x=(0.05, -RADIUS + 0.4 * D, 0.0))
        cloud.advance(3)
        assert cloud.particles.status[0] == Status.STUCK
        np.testing.assert_array_equal(cloud.particles.x, cloud.particles.x0)
        assert cloud.particles.t[0] == cloud.particles.t0[0]


def test_energy_only_falls_in_a_fluid_at_rest():
    """A stretched body springs back; its kinetic and stored energy together never grow."""
    Ca, R, mu_f, number = np.array([0.05, 1.0]), 1e-6, 1e-3, 5.0
    rho = number * 15 * mu_f / R**2
    p = spheres(np.zeros((2, 3)), d=2 * R, rho=rho, mu=mu_f / Ca, poissons_ratio=0.45)
    medium = Medium(mu_f, rho, (0.0, 0.0, 0.0))
    cloud = Cloud(p, analytic.linear(np.zeros((3, 3))), medium, (), 1e-3 * number, PAPER)
    p.F[:] = np.diag([1.5, 0.8, 1 / 1.2]).ravel()
    volume, theta = 4 / 3 * np.pi * p.R**3, 4 / 3 * np.pi * p.R**5 * p.rho / 5

    def energy():
        stored = stored_energy(MATERIALS["neoHooke"], tuple(p.F.T), p.mu, p.lame)
        return 0.5 * theta * (p.A**2).sum(axis=1) + volume * stored

    before = start = energy()
    for _ in range(300):
        cloud.advance(20)
        now = energy()
        assert (now <= before * (1 + 1e-12)).all()
        before = now
    assert (now < 0.05 * start).all()


@pytest.mark.parametrize("array", ["x", "v", "F", "A"])
@pytest.mark.parametrize("integrator", ["paper", "rosenbrock"])
def test_not_a_number_ends_its_particle_with_a_reason_and_no_other(array, integrator):
    clean, spoilt = (scattered_cloud(integrator=integrator) for _ in range(2))
    for cloud in (clean, spoilt):
        Stepper(cloud).advance(300)
    k = int(np.flatnonzero(spoilt.particles.status == Status.ACTIVE)[3])
    getattr(spoilt.particles, array)[k] = np.nan
    for cloud in (clean, spoilt):
        Stepper(cloud).advance(100)
    p = spoilt.particles
    assert p.status[k] == Status.FAILED
    assert p.reason[k] == Reason.NOT_FINITE
    others = np.arange(p.size) != k
    assert_same(p.take(others), clean.particles.take(others))


def test_outcomes_of_two_shares_add_up():
    assert Outcome(2) + Outcome(3) == Outcome(5)
    for one, other in ((True, False), (False, True), (False, False)):
        assert Outcome(0, one) + Outcome(0, other) == Outcome(0, False)
        assert Outcome(0, True, not one) + Outcome(0, True, not other) == Outcome(0, True, True)
