"""States at instants within steps: as near to the path as its steps are, and without effect on them."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from mesh_shapes import block, box_patches, build_mesh, cyclic_row, period
from small_clouds import assert_same

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.patches import Adhere, Cyclic, Mirror, Rebound
from foamprb.cloud.paths import Observation
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow.meshflow import MeshFlow

HEAVY = Medium(1.0, 1.0, (0.0, 0.0, 0.0))
DT = 0.01
ADAPTIVE = ("rosenbrock", "stokes")


def stretched(integrator, tolerance=1e-4, threads=1):
    """Bodies that an extension of rate 1 carries away, one of which appears at 0.105 s."""
    p = spheres([[0.1, 1.0, 0.0], [0.2, 0.5, 0.1], [0.3, 0.0, 0.2]], d=0.02, rho=0.15, mu=[1e3, 10.0, 2.0])
    p.t0[2] = p.t[2] = 0.105
    p.v[:] = p.x * [1.0, -1.0, 0.0]
    models = Models(integrator=integrator, tolerance=tolerance, stride=None)
    flow = analytic.linear(np.diag([1.0, -1.0, 0.0]))
    return Cloud(p, flow, HEAVY, (), DT, models, threads=threads)


def states(cloud, steps, times, with_rates=False):
    """States at some instants of the next steps."""
    cloud.store_at(times, with_rates)
    last = cloud.step + steps
    while cloud.step < last:
        Stepper(cloud).advance(last - cloud.step)
    return [cloud.comm.rank.at_instant(time, in_flow=False) for time in times]


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_paths_do_not_depend_on_instants(integrator):
    bare, stored, threaded = stretched(integrator), stretched(integrator), stretched(integrator, threads=2)
    bare.advance(64)
    times = [DT * k for k in range(1, 64)]
    one = states(stored, 64, times)
    assert_same(bare.particles, stored.particles)
    for a, b in zip(one, states(threaded, 64, times), strict=True):
        assert_same(a, b)


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_states_are_as_near_to_the_path_as_the_steps(integrator):
    """Against steps that end there, a thousand times as exact; the third body is released in between."""
    times = [0.0277, 0.0777, 0.1, 0.2222, 0.301]
    exact = []
    for time in times:
        cloud = stretched(integrator, tolerance=1e-7)
        cloud.end = time
        cloud.__post_init__()
        cloud.advance(cloud.most_steps)
        exact.append(cloud.particles)
    errors = []
    for tolerance in (1e-3, 1e-4, 1e-5):
        found = states(stretched(integrator, tolerance), 32, times, with_rates=True)
        for then, p in zip(found, exact, strict=True):
            np.testing.assert_array_equal(then.status, p.status)
        active = [p.status == Status.ACTIVE for p in exact]
        errors.append(
            [
                max(np.abs(getattr(then, name) - getattr(p, name))[a].max()
                    for then, p, a in zip(found, exact, active, strict=True))
                for name in ("x", "v", "F", "A")
            ]
        )  # fmt: skip
    errors = np.array(errors)
    assert np.all(errors[:, :3] < 10.0 * np.array([[1e-3], [1e-4], [1e-5]]))
    assert np.all(errors[2, :3] < 0.3 * errors[0, :3])


def test_a_body_that_passes_a_coupled_patch_stays_on_its_line():
    mesh = cyclic_row(0.0, 1)
    flow = MeshFlow(mesh, np.tile([2.0, 0.0, 0.0], (len(mesh.nodes), 1)), np.zeros((len(mesh.nodes), 3, 3)))
    low, high = flow.bounds
    length = np.linalg.norm(period(0.0)[1])
    p = spheres([0.5 * (low + high) + [0.0371, 0.0, 0.0]], d=0.01, rho=1.0, mu=1.0)
    p.v[:] = 2.0, 0.0, 0.0
    actions = [Cyclic() if patch.neighbour else Rebound() for patch in flow.patches]
    models = Models(integrator="stokes", stride=None)
    cloud = Cloud(p, flow, HEAVY, actions, DT, models, threads=1)
    times = [DT * k for k in range(1, 96)]
    for time, then in zip(times, states(cloud, 96, times), strict=True):
        way = 0.5 * (high[0] - low[0]) + 0.0371 + 2.0 * time
        assert then.x[0, 0] - low[0] == pytest.approx(way % length, abs=1e-9)
    assert cloud.particles.t[0] == 96 * DT


def test_a_body_that_meets_a_mirror_is_on_its_lines():
    shape = block(3, 0.2)
    patches = [p._replace(type="symmetryPlane") if p.name == "floor" else p for p in box_patches(shape)]
    mesh = build_mesh(shape, patches)
    flow = MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))
    p = spheres([[0.4, 0.6, 0.1]], d=1e-3, rho=1e12, mu=1e6)
    p.v[:] = 0.1, 0.0, -1.0
    actions = [Mirror() if patch.type == "symmetryPlane" else Rebound() for patch in flow.patches]
    models = Models(integrator="rosenbrock", stride=None)
    cloud = Cloud(p, flow, HEAVY, actions, DT, models, threads=1)
    times = [0.02 + DT * k for k in range(16)]
    for time, then in zip(times, states(cloud, 32, times), strict=True):
        assert then.x[0] == pytest.approx([0.4 + 0.1 * time, 0.6, abs(0.1 - time)], abs=1e-6)


def bound_to_wall():
    """Bodies in contact with a wall to which bonds hold them now and then."""
    R, water = 2e-6, Medium(1e-3, 1000.0, (0.0, 0.0, -9.81))
    p = spheres(np.tile([0.0, 0.0, R * (1.0 + 1e-7)], (50, 1)), d=2 * R, rho=1200.0, mu=100.0)
    patch = Adhere(kOn=5.0, kOff=5.0, xb=0.0, T=300.0)
    flow = analytic.shear_over_wall(10.0)
    return Cloud(p, flow, water, [patch], DT, Models(integrator="stokes"), threads=1)


def test_a_body_that_a_bond_holds_is_stuck_until_it_breaks():
    times = [DT * k for k in range(1, 64)]
    found = states(bound_to_wall(), 64, times)
    held = 0
    for k, then in enumerate(found):
        cloud = bound_to_wall()
        cloud.advance(k + 1)
        stopped = cloud.particles
        np.testing.assert_array_equal(then.status, stopped.status)
        np.testing.assert_array_equal(then.patch, stopped.patch)
        held += np.count_nonzero(then.status == Status.STUCK)
    assert held > 500


@pytest.mark.parametrize("make", [bound_to_wall, lambda: stretched("rosenbrock")])
def test_steps_that_functions_observe_do_not_depend_on_instants(make):
    """Nor do they have the time in which a bond holds a body."""

    def observed(times):
        cloud, seen = make(), []

        def observe(steps):
            moved = steps.take(steps.t[1] > steps.t[0])
            seen.append(np.column_stack([moved.number, *moved.t, *moved.both("F")]))

        needs, all_bodies = frozenset({"F0", "F1"}), np.ones(cloud.size, dtype=bool)
        seeing = Observation(needs, all_bodies, observe)
        cloud.comm.rank.sampling = SimpleNamespace(observers=lambda _rank, _until: seeing)
        states(cloud, 64, times)
        return np.concatenate(seen)

    np.testing.assert_array_equal(observed([DT * k for k in range(1, 64)]), observed([]))


def test_particles_that_are_ahead_store_what_they_do_in_one_call():
    """As after a stop: half of them go the way again."""
    times = [0.05, 0.12, 0.2]
    whole = states(stretched("stokes"), 32, times)
    cloud = stretched("stokes")
    cloud.store_at(times)
    before = [array.copy() for array in cloud.particles]
    Stepper(cloud).advance(32)
    for array, old in zip(cloud.particles, before, strict=True):
        array[::2] = old[::2]
    cloud.step = 0
    for a, b in zip(whole, states(cloud, 32, times), strict=True):
        assert_same(a, b)
