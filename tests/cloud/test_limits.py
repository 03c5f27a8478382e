"""What fails a particle that the model no longer describes, and what ends a call of the compiled loop."""

from __future__ import annotations

import itertools
import math
import re
import threading
import time
import warnings
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from small_clouds import assert_same, box_cloud, pipe_cloud

from foamprb import FailedParticlesWarning, Limits, analytic, set_rest_shape
from foamprb.body.material import MATERIALS
from foamprb.cloud.block import ROWS, Medium, accept_stage, at, load9, store9
from foamprb.cloud.cloud import Cloud, Stepper, explain
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import LANES
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import REASONS, Particles, Reason, Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError

IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
OIL = Medium(1.0, 1000.0, (0.0, 0.0, 0.0))


def in_extension(Ca, limits=Limits(), dt=0.1, integrator="stokes"):  # noqa: B008
    """Spheres in uniaxial extension of a shear rate of 1/s."""
    p = spheres(np.zeros((len(Ca), 3)), d=1e-5, rho=1000.0, mu=1.0 / np.array(Ca))
    flow = analytic.extension(1.0 / np.sqrt(3.0))
    return Cloud(p, flow, OIL, (), dt, Models(integrator=integrator), 1, limits=limits)


def reasons(cloud):
    return [Reason(r) for r in cloud.particles.reason]


def test_defaults_of_limits_are_those_of_the_manual():
    page = Path(__file__).parents[2] / "docs/settings.md"
    told = dict(re.findall(r"^\| `(max\w+)` \| 1 \| (\w[\w.]*) \|", page.read_text(), re.MULTILINE))
    for name, default in asdict(Limits()).items():
        assert default == (math.inf if told[name] == "none" else float(told[name]))


class TestStretch:
    def test_beyond_the_steady_shapes_of_extension_a_body_is_stretched_to_the_limit(self):
        """At Ca 10 it follows the fluid, at first faster, λ ∼ exp ε̇t; at 0.2 it comes to rest."""
        cloud = in_extension([10.0, 0.2])
        with pytest.warns(FailedParticlesWarning, match=r"1 of 2 particles failed.*beyond maxStretch"):
            cloud.advance(300)
        p = cloud.particles
        assert [*p.status] == [Status.FAILED, Status.ACTIVE]
        assert reasons(cloud) == [Reason.STRETCHED, Reason.NONE]
        rate = 1.0 / np.sqrt(3.0)
        assert np.log(100.0) - 0.5 < rate * p.t[0] < np.log(100.0) + 0.5
        assert 50.0 < np.linalg.norm(p.F[0].reshape(3, 3), 2) <= 100.0
        assert np.all(p.F[1] < 2.0)

    def test_it_is_from_the_shape_at_rest(self):
        p = spheres(np.zeros((1, 3)), d=1e-5, rho=1000.0, mu=1e6)
        set_rest_shape(p, (40.0, 1.0, 1.0))
        cloud = Cloud(p, analytic.shear(1.0), OIL, (), 0.1, Models(), 1, limits=Limits(maxStretch=2.0))
        cloud.advance(10)
        assert p.status[0] == Status.ACTIVE
        assert np.linalg.norm(p.F[0].reshape(3, 3), 2) > 10.0

    @pytest.mark.parametrize("integrator", INTEGRATORS)
    def test_every_integrator_heeds_it(self, integrator):
        cloud = in_extension([10.0], Limits(maxStretch=3.0), 1e-4, integrator)
        cloud.particles.rho[:] = 1e12
        cloud = Cloud(
            cloud.particles, cloud.flow, OIL, (), 1e-2, cloud.models, 1, limits=Limits(maxStretch=3.0)
        )
        Stepper(cloud).advance(700)
        assert reasons(cloud) == [Reason.STRETCHED]
        assert cloud.particles.t[0] > 1.0


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("d", 1e-310, r"the diameter of particle 0 is 1e-310 m\. Allowed: 1e-30 to 1e\+30 m; are the units"),
        ("rho", 1e300, r"the density of particle 0 is 1e\+300 kg/m3"),
        ("mu", 1e-300, r"the shear modulus of particle 0 is 1e-300 Pa"),
    ],
)
def test_properties_beyond_all_measure_are_named(name, value, message):
    p = spheres(np.zeros((1, 3)), **{"d": 1e-5, "rho": 1e3, "mu": 1.0, name: value})
    with pytest.raises(InputError, match=message):
        Cloud(p, analytic.shear(1.0), OIL, (), 1e-3)
    with pytest.raises(InputError, match=r"the fluid's viscosity is 1e\+300 Pa s"):
        Cloud(
            spheres(np.zeros((1, 3)), d=1e-5, rho=1e3, mu=1.0), analytic.shear(1.0), Medium(1e300, 1.0), (), 1
        )


class TestSize:
    def test_a_body_larger_than_the_duct_is_refused(self):
        p = spheres(np.zeros((2, 3)), d=[1e-3, 10.0], rho=1000.0, mu=1.0)
        walls = (Stick(), Escape(), Escape())
        with pytest.raises(InputError, match=r"1 of 2 particles are too large.*0.3 m wide.* 1 is 5 m"):
            Cloud(p, analytic.pipe(0.15, 1.0, 2.0), OIL, walls, 1e-3)

    def test_one_that_grows_beyond_its_share_of_the_width_fails(self):
        p = spheres(np.full((1, 3), (0.5, 0.1, 0.0)), d=0.02, rho=1000.0, mu=1e-3)
        walls = (Rebound(), Escape(), Escape())
        flow = analytic.pipe(0.15, 0.5, 100.0)
        cloud = Cloud(p, flow, OIL, walls, 1e-2, Models(), 1, limits=Limits(maxSize=0.1))
        Stepper(cloud).advance(1000)
        assert reasons(cloud) == [Reason.TOO_LARGE]
        assert 0.02 < 0.01 * np.linalg.norm(p.F[0].reshape(3, 3), 2) < 0.03


class TestCells:
    @staticmethod
    def flow(several: bool):
        """Shear of 1/s along x, at two times or steady, in hexahedra and smaller prisms."""
        from mesh_shapes import block, box_patches

        from foamprb.flow.mesh.mesh import build_mesh
        from foamprb.flow.meshflow import MeshFlow
        from foamprb.flow.series import SeriesFlow

        shape = block(3, 0.0, "mixed")
        mesh = build_mesh(shape, box_patches(shape))
        points = np.concatenate([mesh.points, mesh.centres])
        l = np.zeros((len(points), 3, 3))
        l[:, 0, 2] = 1.0
        u = np.einsum("nij,nj->ni", l, points - 0.5)
        return SeriesFlow(mesh, [0.0, 100.0], lambda _: (u, l)) if several else MeshFlow(mesh, u, l)

    @pytest.mark.parametrize(
        ("integrator", "several"), [("paper", False), ("rosenbrock", False), ("stokes", True)]
    )
    def test_one_that_outgrows_its_cell_fails_and_says_so(self, several, integrator):
        flow = self.flow(several)
        x = np.array([[0.3, 0.4, 0.5], [0.7, 0.6, 0.5]])
        size = flow.cell_size(flow.locate(x))
        p = spheres(x, d=0.8 * 2.0 * size, rho=1e3, mu=[1e-2, 1e3])
        limits = Limits(maxCells=1.0, maxSize=1e3)
        models = Models(integrator=integrator)
        walls = [Escape() for _ in flow.patches]
        cloud = Cloud(p, flow, OIL, walls, 1e-2, models, 1, limits=limits)
        Stepper(cloud).advance(200)
        assert reasons(cloud) == [Reason.CELLS_TOO_MANY, Reason.NONE]
        longest = p.R * np.linalg.norm(p.F.reshape(-1, 3, 3), 2, axis=(1, 2)) / flow.cell_size(p.host)
        # What is compared is a bound of the longest stretch from above.
        assert 0.97 < longest[0] < 1.02
        assert longest[1] < 1.0
        assert "(maxCells is 1)" in explain(p.reason[0], models, limits)


class TestCost:
    def test_a_particle_that_needs_more_steps_than_it_may_fails(self):
        for most, reason in ((3, Reason.SUB_STEPS), (1e6, Reason.NONE)):
            cloud = in_extension([0.2], Limits(maxSubSteps=most), dt=1.0)
            Stepper(cloud).advance(1)
            assert reasons(cloud) == [reason]
            assert (cloud.particles.t[0] < 1.0) == (reason == Reason.SUB_STEPS)

    def test_repeated_steps_are_counted(self):
        cloud = in_extension([0.2], dt=1e-5)
        Stepper(cloud).advance(1)
        assert cloud.particles.substeps[0] == 1
        coarse = in_extension([0.2], dt=1.0)
        Stepper(coarse).advance(1)
        assert coarse.particles.substeps[0] > 5


class TestReasons:
    def test_not_a_number_in_the_flow_is_the_reason(self):
        for integrator in INTEGRATORS:
            cloud = in_extension([0.2, 0.2], integrator=integrator)
            p = cloud.particles
            flow = analytic.linear(np.full((3, 3), np.nan))
            cloud = Cloud(p, flow, OIL, (), 1e-4, cloud.models, 1)
            Stepper(cloud).advance(3)
            assert reasons(cloud) == [Reason.FLOW_NOT_FINITE] * 2

    def test_each_has_words_and_only_steps_of_fixed_size_blame_the_step(self):
        assert set(REASONS) == set(Reason)
        for reason in Reason:
            for integrator, material in itertools.product(INTEGRATORS, MATERIALS):
                if INTEGRATORS[integrator].refuses("roscoe", material, False) or MATERIALS[material].liquid:
                    continue
                text = explain(reason, Models(integrator=integrator, material=material), Limits())
                assert ("Δt beyond stability" in text) == (
                    integrator == "paper"
                    and reason in (Reason.NOT_FINITE, Reason.VOLUME_RATIO, Reason.NOT_CONVERGED)
                )
                assert "Newton" not in text or reason == Reason.NOT_CONVERGED
                assert ("too soft to keep its volume" in text) == (
                    integrator != "paper"
                    and material != "saintVenantKirchhoff"
                    and reason == Reason.VOLUME_RATIO
                )

    def test_a_solid_that_gives_way_is_no_fault_of_the_step(self):
        """Saint Venant-Kirchhoff's has no resistance left at a stretch of 1/√3."""
        p = spheres(np.zeros((1, 3)), d=1e-5, rho=1000.0, mu=1.0, poissons_ratio=0.3)
        models = Models(material="saintVenantKirchhoff", integrator="rosenbrock")
        cloud = Cloud(p, analytic.extension(-3.0), OIL, (), 0.01, models, 1)
        Stepper(cloud).advance(500)
        assert reasons(cloud) == [Reason.VOLUME_RATIO]
        text = explain(p.reason[0], models, cloud.limits)
        assert "gives way when it is compressed" in text
        assert "stability" not in text


class TestWalls:
    @pytest.mark.parametrize("integrator", INTEGRATORS)
    def test_wall_forces_do_not_depend_on_the_reach_of_lists(self, integrator):
        clouds = [box_cloud(integrator) for _ in range(3)]
        # The default; a cell's width more; so little that it must grow.
        clouds[1].reach, clouds[2].reach = 0.6, 1e-3
        for cloud in clouds:
            Stepper(cloud).advance(12)
            assert_same(cloud.particles, clouds[0].particles)
        assert clouds[2].reach > 1e-2
        # One list, to 0.3 of a crooked cell of ½, lasts while bodies of 0.01 stretch.
        assert clouds[0].reach == pytest.approx(0.15, rel=0.05)
        assert Status.STUCK in clouds[0].particles.status

    def test_where_lists_would_be_too_long_the_body_fails_and_no_other(self, monkeypatch):
        cloud, whole = box_cloud("rosenbrock"), box_cloud("rosenbrock")
        for c in (cloud, whole):
            c.particles.mu[:], c.particles.lame[:], c.reach = 1e6, 1e8, 0.05
        Stepper(cloud).advance(1)
        Stepper(whole).advance(12)
        monkeypatch.setattr("foamprb.flow.wall_lists._MOST_ENTRIES", 1)
        cloud.particles.R[2] *= 1.5
        Stepper(cloud).advance(11)
        assert cloud.particles.reason[2] == Reason.WALLS_TOO_MANY
        others = [0, 1, 3, 4]
        assert_same(cloud.particles.take(others), whole.particles.take(others))


class TestStop:
    def test_a_call_ends_within_a_step_and_goes_on_to_the_same_state(self):
        """Two threads with seconds of work in one step; some blocks are done, others not.

        By CPU time: other work on the machine does not count.
        """

        def cloud():
            Ca = np.where(np.arange(320) < 160, 0.01, 4.0)
            p = spheres(np.zeros((len(Ca), 3)), d=1e-5, rho=1000.0, mu=1.0 / Ca)
            models = Models(integrator="stokes", tolerance=1e-11)
            limits = Limits(maxSubSteps=1e12)
            return Cloud(p, analytic.shear(1.0), OIL, (), 100.0, models, 2, limits=limits)

        whole, parts = cloud(), cloud()
        for each in (whole, parts):
            each.tracker.compile(each.make_ready())
        begun = time.process_time()
        Stepper(whole).advance(1)
        took = time.process_time() - begun
        slow, count = 0.0, 0
        while parts.step == 0:
            count += 1
            due = time.process_time() + 0.2 * took * count
            Stepper(parts).advance(1, lambda due=due: time.process_time() > due)
            slow = max(slow, time.process_time() - due)
        assert slow < 0.5 * took
        assert count > 1
        assert_same(whole.particles, parts.particles)

    def test_particles_ahead_stay_until_the_others_catch_up(self):
        for make in (pipe_cloud, box_cloud):
            for integrator in INTEGRATORS:
                whole, parts = make(integrator), make(integrator)
                Stepper(whole).advance(12)
                Stepper(parts).advance(3)
                flow, _ = parts.load_flow(9)
                rest = parts.particles
                ahead = rest.take(np.arange(2))
                parts.tracker.advance(flow, ahead, 3, 5, 1, parts.bounds)
                for name, array in zip(Particles._fields, rest, strict=True):
                    array[:2] = getattr(ahead, name)
                Stepper(parts).advance(2)
                Stepper(parts).advance(7)
                assert_same(whole.particles, parts.particles)

    def test_an_exception_in_the_thread_that_waits_ends_the_loop(self):
        # Ellipsoids that tumble.
        p = spheres(np.zeros((64, 3)), d=1e-5, rho=1000.0, mu=1e4)
        set_rest_shape(p, (2.0, 1.0, 1.0))
        models, limits = Models(integrator="stokes"), Limits(maxSubSteps=1e12)
        cloud = Cloud(p, analytic.shear(1.0), OIL, (), 1e5, models, 1, limits=limits)

        def stop():
            raise KeyboardInterrupt

        cloud.tracker.compile(cloud.make_ready())
        started = time.process_time()
        with pytest.raises(KeyboardInterrupt):
            Stepper(cloud).advance(1, stop)
        assert time.process_time() - started < 2.0
        assert threading.active_count() < 10
        assert cloud.step == 0


class TestModels:
    def test_the_integrator_is_chosen_as_by_the_command_line(self):
        assert Models().integrator == "auto"
        p = spheres(np.zeros((1, 3)), d=1e-5, rho=1000.0, mu=1.0)
        assert Cloud(p, analytic.shear(1.0), OIL, (), 0.1).models.integrator == "stokes"
        heavy = spheres(np.zeros((1, 3)), d=1e-2, rho=1e5, mu=1.0)
        assert Cloud(heavy, analytic.shear(100.0), OIL, (), 0.1).models.integrator == "rosenbrock"

    def test_a_warning_becomes_an_exception_on_request(self):
        cloud = in_extension([10.0])
        with warnings.catch_warnings():
            warnings.simplefilter("error", FailedParticlesWarning)
            with pytest.raises(FailedParticlesWarning):
                cloud.advance(300)


@pytest.mark.parametrize("row", ["new_v", "new_F", "new_A"])
def test_state_with_one_nan_is_refused(row):
    size = 3 if row == "new_v" else 9
    for component in range(size):
        block = np.zeros(ROWS * LANES)
        for i in range(LANES):
            store9(block, at.new_F, i, IDENTITY)
            store9(block, at.F, i, IDENTITY)
            for name in ("J", "moving", "R"):
                block[getattr(at, name) * LANES + i] = 1.0
            for name in ("maxLength", "maxStretch"):
                block[getattr(at, name) * LANES + i] = 10.0
        block[(getattr(at, row) + component) * LANES] = np.nan
        accept_stage(block, 1.0)
        verdicts = block[at.verdict * LANES : (at.verdict + 1) * LANES]
        assert verdicts.tolist() == [Reason.NOT_FINITE] + [0] * (LANES - 1), component
        assert load9(block, at.F, 0) == IDENTITY
