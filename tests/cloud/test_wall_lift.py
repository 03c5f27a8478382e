"""Soft particles near walls, carried by the loop: lift, slip, hindered settling, and which walls are seen."""

from __future__ import annotations

import re

import numpy as np
import pytest
from mesh_shapes import block, box_patches
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from validation.references.near_wall import sphere_across_wall

from foamprb.cloud.block import Medium, at, idle_lanes, new_block, store3
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.layout import LANES, layout
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Status, concatenate, spheres
from foamprb.cloud.surroundings import wall_lift
from foamprb.cloud.surroundings.base import Survey
from foamprb.cloud.surroundings.wall_lift import WallLift, count_close, nearest_walls, share_of_close
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic
from foamprb.flow.kernels import linked_with
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.planes import walls

R, RATE, MU_F = 1e-6, 100.0, 1e-3
OIL = Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
STILL = analytic.shear_over_wall(0.0)


def particles(heights, Ca=0.1, rho=1000.0):
    x = [(0.0, 0.0, h * R) for h in np.atleast_1d(heights)]
    return spheres(x, d=2.0 * R, rho=rho, mu=MU_F * RATE / np.asarray(Ca), poissons_ratio=0.4999)


def carried(p, steps, *, model=None, medium=OIL, flow=None, integrator="stokes", dt=0.02 / RATE, **more):
    flow = flow or analytic.shear_over_wall(RATE)
    model = (model if model is not None else WallLift(cutOff=1000.0),)
    models = Models(integrator=integrator, surroundings=model, **more)
    Cloud(p, flow, medium, [Rebound()] * len(flow.patches), dt, models, threads=1).advance(steps)
    return p


def settling_speed():
    return 2.0 / 9.0 * R**2 * 1000.0 * 9.81 / MU_F


def test_without_mobility_it_settles_as_if_alone():
    heavy = Medium(MU_F, 1000.0, (0.0, 0.0, -9.81))
    p = carried(particles(1.5, 1e-4, rho=2000.0), 20, medium=heavy, flow=STILL, dt=1e-6,
                model=WallLift(mobility=False), integrator="rosenbrock")  # fmt: skip
    assert -p.v[0, 2] == pytest.approx(settling_speed(), rel=1e-3)


def test_lift_is_the_same_with_both_integrators_with_inertia():
    size = 50.0 * R
    found = []
    for name, dt in (("rosenbrock", 2e-4), ("paper", 2e-5)):
        p = spheres([(0.0, 0.0, 4.0 * size)], d=2.0 * size, rho=1000.0, mu=MU_F * RATE / 0.1,
                    poissons_ratio=0.4999)  # fmt: skip
        carried(p, round(0.02 / dt), integrator=name, dt=dt, model=WallLift(mobility=False))
        found.append((p.x[0, 2], p.v[0, 2]))
    assert found[0][0] - 4.0 * size > 0.005 * size
    assert found[1][0] - 4.0 * size == pytest.approx(found[0][0] - 4.0 * size, rel=0.02)
    assert found[1][1] == pytest.approx(found[0][1], rel=0.02)


def test_a_particle_that_no_wall_is_near_goes_as_without_the_model():
    """Whatever others are in its block, and in any order."""
    far, shear = particles([30.0, 31.0, 500.0]), analytic.linear([[0.0, 0.0, RATE], [0.0] * 3, [0.0] * 3])
    alone = Cloud(
        particles([30.0, 31.0, 500.0]), shear, OIL, (), 1e-4, Models(integrator="stokes"), threads=1
    )
    alone.advance(20)
    only = carried(particles([30.0, 31.0, 500.0]), 20, model=WallLift(), dt=1e-4)
    near = particles(np.linspace(1.2, 9.0, 50))
    p = carried(concatenate([near, far]), 20, model=WallLift(), dt=1e-4)
    q = carried(concatenate([far.take(slice(None)), near.take(slice(None))]), 0, model=WallLift(), dt=1e-4)
    assert q.size == 53
    for name in ("x", "v", "F", "A"):
        assert np.array_equal(getattr(p, name)[-3:], getattr(only, name)), name
        there = getattr(alone.particles, name)
        np.testing.assert_allclose(
            getattr(only, name), there, 1e-11, 1e-13 * np.abs(there).max(), err_msg=name
        )
    heights = np.linspace(1.2, 9.0, 50)
    one_by_one = np.concatenate([carried(particles(h), 20, model=WallLift(), dt=1e-4).x for h in heights[:3]])
    assert np.array_equal(p.x[:3], one_by_one)


def test_time_close_to_a_wall_is_added_up():
    p = carried(particles([1.5, 3.0]), 7, model=WallLift())
    assert p.close == pytest.approx([7 * 0.02 / RATE, 0.0])
    line = share_of_close(*count_close(p))
    assert "50.00%, of 1 particles" in line


def test_a_body_between_two_walls_is_pushed_to_the_middle():
    flow = analytic.slit(8.0 * R, RATE * 8.0 * R / 6.0)
    p = carried(particles([2.5, 4.0, 5.5]), 100, flow=flow)
    assert p.v[0, 2] > 0.0
    assert p.v[1, 2] == pytest.approx(0.0, abs=1e-6 * p.v[0, 2])
    assert p.v[2, 2] == pytest.approx(-p.v[0, 2], rel=1e-6, abs=0.0)


def test_a_sphere_that_flows_onto_a_post_arrives():
    """Head-on, on the exact path within .01 R down to a gap of .1 R; then the post holds it."""
    radius, dt = 100.0 * R, 0.02
    flow = analytic.posts(4.0 * radius, 2.0 * radius, (20.0 * radius, 0.0))
    p = spheres([(-radius - 3.0 * R, 0.0, 0.0)], d=2.0 * R, rho=1000.0, mu=1e4)
    cloud = Cloud(p, flow, OIL, [Stick()], dt, Models(surroundings=(WallLift(),)), threads=1)
    grid = np.linspace(1.05, 3.2, 40)
    share = CubicSpline(grid, [sphere_across_wall(h).stagnation for h in grid])

    def rate(_t, h):
        u, _ = flow.sample(np.array([[-radius - h[0] * R, 0.0, 0.0]]), np.zeros(1, np.int32), 0.0)
        return -u[0, 0] / R * share(h)

    exact = solve_ivp(rate, (0.0, 14.0), [3.0], rtol=1e-8, dense_output=True)
    found = []
    for _ in range(7):
        cloud.advance(100)
        found.append(-(p.x[0, 0] + radius) / R)
    heights = exact.sol(2.0 * np.arange(1, 8))[0]
    assert heights[-1] < 1.1
    np.testing.assert_allclose(found, heights, atol=0.01)
    cloud.advance(600)
    assert p.status[0] == Status.STUCK
    assert p.x[0, 0] == pytest.approx(-radius - R, abs=1e-3 * R)


# --- Which walls are seen -----------------------------------------------------------------------------------


def still(mesh):
    return MeshFlow(mesh, np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3)))


def test_only_chosen_patches_count():
    grid = block(4)
    flow = still(build_mesh(grid, box_patches(grid)))
    names = [patch.name for patch in flow.patches]
    assert WallLift(patches=("floor",)).patch_mask(flow.patches).tolist() == [
        name == "floor" for name in names
    ]
    assert WallLift(patches=("s.*",)).patch_mask(flow.patches).tolist() == [name == "sides" for name in names]
    with pytest.raises(InputError, match=re.escape("wallLift/patches is flor, which is no patch.")):
        WallLift(patches=("flor",)).walls(flow.patches)


def test_distances_are_told_in_radii():
    p = particles([3.0, 50.0])
    p.host[:] = 0
    flow = analytic.shear_over_wall(RATE)
    near = nearest_walls(p, flow.arrays(1.0, [0]), flow, 10.0, np.array([1], dtype=np.int8))
    assert near.tolist() == pytest.approx([3.0, np.inf])
    notes = WallLift().remarks(Survey(p, flow, None, 1.0, flow.arrays(1.0, [0]))).notes
    assert notes[-1].split() == ["beyond", "cutOff", "1"]


def test_the_nearest_of_all_walls_is_told():
    """Of a box, whose floor, lid and sides are walls: where each of the six is the nearest."""
    grid = block(4, perturbation=0.0)
    flow = still(build_mesh(grid, box_patches(grid)))
    x = np.array([[a, 0.45, 0.6] for a in (0.03, 0.96)])
    x = np.concatenate([np.roll(x, shift, axis=1) for shift in range(3)] + [[[0.5, 0.4, 0.6]]])
    every, near = np.ones(len(flow.patches), dtype=np.int8), np.full(len(x), np.inf)
    arrays, cuts = flow.arrays(0.0, (), 0.3, range(len(every))), np.full(len(x), 0.3)
    find, packed_flow = linked_with(flow.kernels, arrays, wall_lift._nearest_walls)
    find(packed_flow, x, flow.locate(x), cuts, every, 0.0, near)
    expected = np.minimum(x, 1.0 - x).min(axis=1)
    expected[expected > 0.3] = np.inf
    assert near == pytest.approx(expected, rel=1e-9)
    assert expected[:6].max() < 0.05


def test_walls_of_a_mesh_act_like_a_half_space():
    """A cloud on a mesh with one wall, against the flow in closed form."""
    grid = block(4, perturbation=0.0)
    mesh = build_mesh(grid, box_patches(grid))
    nodes = np.asarray(mesh.nodes)
    u = np.stack([RATE * nodes[:, 2], 0 * nodes[:, 0], 0 * nodes[:, 0]], axis=1)
    l = np.tile([[0.0, 0.0, RATE], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], (len(nodes), 1, 1))
    flow = MeshFlow(mesh, u, l)
    p = spheres([[0.5, 0.5, 0.06]], d=0.04, rho=1000.0, mu=MU_F * RATE / 0.1)
    q = spheres([[0.5, 0.5, 0.06]], d=0.04, rho=1000.0, mu=MU_F * RATE / 0.1)
    models = Models(integrator="stokes", surroundings=(WallLift(patches=("floor",), cutOff=8.0),))
    rules = [Escape() if patch.type == "patch" else Stick() for patch in flow.patches]
    Cloud(p, flow, OIL, rules, 1e-4, models, threads=1).advance(20)
    same = Models(integrator="stokes", surroundings=(WallLift(cutOff=8.0),))
    Cloud(q, analytic.shear_over_wall(RATE), OIL, [Stick()], 1e-4, same, threads=1).advance(20)
    assert p.x == pytest.approx(q.x, rel=1e-9)
    assert p.x[0, 2] > 0.06
    arrays = flow.arrays(0.0, (), 0.16, [0, 1, 2])
    assert walls(arrays, p.host[0], tuple(p.x[0]), 0.01, np.ones(3, np.int8)).h1 == np.inf


def test_every_wall_counts_in_the_interpreter(monkeypatch):
    """Sums of numpy's comparisons are no counts."""
    rows = layout(at, during, wall_lift.near)
    lanes = new_block(rows.rows)
    idle_lanes(lanes, rows.initial, 1e-3)
    for k, normal in enumerate(np.eye(3)):
        lanes[(wall_lift.near.wall_distance + k) * LANES] = 3.0 + k
        store3(lanes, wall_lift.near.wall_normal + 3 * k, 0, tuple(normal))
    found = set()
    monkeypatch.setattr(wall_lift, "select_wall", lambda _block, wall, *_: found.add(wall))
    # Lanes without a particle have no normals.
    with np.errstate(all="ignore"):
        wall_lift.lift(lanes, Medium(1e-3, 1e3), 0.0, (10.0, 0.01, 1.0, 0.0, np.ones(1)))
    assert found == {0, 1, 2}
