"""What a step does that meets several patches, or whose walk fails: places and times against free flight."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches, cyclic_row

from foamprb import Cloud, Escape, Medium, Models, Rebound, Status, Stick, analytic, spheres, with_relaxation
from foamprb.cloud.block import store3
from foamprb.cloud.integrators.adaptive import during, holds_end
from foamprb.cloud.layout import LANES
from foamprb.cloud.patches import Cyclic, Mirror
from foamprb.flow.channels import walk_pipe
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow

NOTHING = Medium(1e-12, 1e-12, (0.0, 0.0, 0.0))
RADIUS = 1.0
# Below the first height every walk from the axis fails, down to the second the tree finds what is asked.
FAILS, FOUND = -0.5, -0.6


OBLIQUE = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3.0
"""Turns no axis onto another, and its rows have components of all signs."""


@pytest.mark.parametrize(
    ("goal", "held"),
    [
        ((1.0, 2.0, 3.0), True),
        ((1.4, 1.6, 3.4), True),
        ((1.0, 2.6, 3.0), False),
        ((1.0, 2.0, 2.4), False),
        ((np.nan, 2.0, 3.0), False),
        ((1.0, np.nan, 3.0), False),
        ((1.0, 2.0, np.nan), False),
        ((np.inf, 2.0, 3.0), False),
    ],
)
def test_not_a_number_lies_in_no_tetrahedron(goal, held):
    """A step's end is looked for unless it is certainly as near to its prediction as that has room."""
    lane, numbers = 3, np.full(during.room * LANES + LANES, np.nan)
    store3(numbers, during.ahead, lane, (1.0, 2.0, 3.0))
    numbers[during.room * LANES + lane] = 0.5
    assert holds_end(numbers, lane, goal) == held
    numbers[during.room * LANES + lane] = 0.0
    assert not holds_end(numbers, lane, goal)
    numbers[during.room * LANES + lane] = np.nan
    assert not holds_end(numbers, lane, goal)


def walk_that_fails_at_first(flow, host, x0, x1):
    if x0[1] > FAILS:
        return host, 0.0, -2, -1
    return walk_pipe(flow, host, x0, x1)


def recover_upper_part(flow, x):
    return 0 if x[1] > (FOUND if x[0] < 5.5 else -0.3) else -1


def at_rest(mesh):
    nodes = mesh.nodes
    return MeshFlow(mesh, np.zeros((len(nodes), 3)), np.zeros((len(nodes), 3, 3)))


def flying(flow, interactions, x, v, dt):
    """A heavy sphere in nearly nothing, whose centre alone meets walls, after one step."""
    p = spheres([x], d=1e-3, rho=1e6, mu=1e3)
    p.v[:] = v
    cloud = Cloud(
        p, flow, NOTHING, interactions, dt, Models(touching="centre", integrator="paper"), threads=1
    )
    cloud.advance(1)
    return cloud


def test_a_step_that_meets_two_patches_ends_in_time_on_the_second():
    """From the floor it flies up to the lid: the time on the lid is that of the whole way."""
    shape = block(3, 0.2)
    flow = at_rest(build_mesh(shape, box_patches(shape)))
    walls = [Escape() if patch.name == "lid" else Rebound() for patch in flow.patches]
    p = flying(flow, walls, (0.4, 0.6, 0.3), (0.1, 0.0, -2.0), 1.0).particles
    assert p.status[0] == Status.ESCAPED
    assert p.t[0] == pytest.approx((0.3 + 1.0) / 2.0, rel=1e-9)
    assert p.x[0] == pytest.approx([0.4 + 0.1 * p.t[0], 0.6, 1.0], abs=1e-9)


def test_any_number_of_periods_is_crossed_in_a_step():
    """A coupled patch is no wall that a particle could be shut in between."""
    flow = at_rest(cyclic_row(0.0, 1))
    sides = [Cyclic() if patch.neighbour else Rebound() for patch in flow.patches]
    p = flying(flow, sides, (0.25, 0.4, 0.3), (37.5, 0.0, 0.0), 1.0).particles
    assert p.status[0] == Status.ACTIVE
    assert p.x[0] == pytest.approx([(0.25 + 37.5) % 1.0, 0.4, 0.3], abs=1e-8)
    assert p.t[0] == 1.0


def test_a_corner_that_a_particle_cannot_leave_holds_it_for_the_step():
    """Between two walls that are closer than it flies in a step it meets more walls than one could list."""
    shape = block(3, 0.2)
    flow = at_rest(build_mesh(shape, box_patches(shape)))
    p = flying(flow, [Rebound()] * 3, (0.4, 0.6, 0.3), (0.0, 0.0, -40.0), 1.0).particles
    assert p.status[0] == Status.ACTIVE
    assert p.t[0] == 1.0
    assert 0.0 <= p.x[0, 2] <= 1.0
    assert flow.cell_of(flow.locate(p.x)) == flow.cell_of(p.host)


def in_pipe_with_walks_that_fail(interaction, dt, x=5.0):
    flow = analytic.pipe(RADIUS, 0.0, 10.0)
    flow.kernels = {**flow.kernels, "walk": walk_that_fails_at_first, "recover": recover_upper_part}
    return flying(flow, (interaction, Escape(), Escape()), (x, 0.0, 0.0), (0.0, -2.0, 0.0), dt)


def test_the_time_of_a_mended_walk_goes_on_to_the_wall():
    """The tree finds the way down to 0.6 radii; from there it takes the rest of the step, and no more."""
    cloud = in_pipe_with_walks_that_fail(Stick(), 0.8)
    p = cloud.particles
    assert cloud.recovered == 1
    assert p.status[0] == Status.STUCK
    assert p.t[0] == pytest.approx(RADIUS / 2.0, rel=1e-9)
    assert p.x[0, 1] == pytest.approx(-RADIUS, abs=1e-9)


def test_after_a_mended_walk_the_rest_of_the_step_is_flown():
    cloud = in_pipe_with_walks_that_fail(Rebound(), 0.6)
    p = cloud.particles
    assert cloud.recovered == 1
    assert p.status[0] == Status.ACTIVE
    # Down to the wall and back: 1.2 radii in all.
    assert p.x[0, 1] == pytest.approx(-RADIUS + 0.2, abs=1e-9)
    assert p.v[0, 1] == pytest.approx(2.0, rel=1e-9)


def test_a_walk_that_is_mended_in_the_middle_of_the_mesh_ends_at_its_goal():
    cloud = in_pipe_with_walks_that_fail(Rebound(), 0.2)
    assert cloud.recovered == 1
    assert cloud.particles.x[0, 1] == pytest.approx(-0.4, abs=1e-9)


def test_a_walk_that_fails_once_more_leaves_the_centre_where_it_was_mended():
    """The tree finds the way down to 0.3 radii, where every walk fails: there the step ends, in time."""
    cloud = in_pipe_with_walks_that_fail(Stick(), 0.8, 6.0)
    p = cloud.particles
    assert cloud.recovered == 1
    assert p.status[0] == Status.ACTIVE
    assert p.t[0] == 0.8
    assert p.x[0] == pytest.approx([6.0, -0.3, 0.0], abs=1e-9)


@pytest.mark.parametrize("turn", [np.eye(3), OBLIQUE], ids=["level", "oblique"])
def test_the_body_behind_a_mirror_is_the_mirror_image(turn):
    """Its shape at rest is turned as the rest of it is: of the ellipsoid F·F0 every point is mirrored."""
    shape = block(3, 0.2)
    level = [(p.name, np.asarray(p.surface.points).copy()) for p in box_patches(shape)]
    patches = [p._replace(type="symmetryPlane") if p.name == "floor" else p for p in box_patches(shape)]
    shape.points = np.asarray(shape.points) @ turn.T
    for patch, (_, points) in zip(patches, level, strict=True):
        patch.surface.points = points @ turn.T
    flow = at_rest(build_mesh(shape, patches))
    rest = np.diag([1.25, 0.8, 1.0]) @ np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])
    rest = turn @ rest @ turn.T
    bodies = []
    for domain in (flow, analytic.linear(np.zeros((3, 3)))):
        p = spheres([turn @ (0.4, 0.6, 0.1)], d=1e-3, rho=1e6, mu=1e3)
        p.v[:] = turn @ (0.1, 0.0, -1.0)
        p.F0[:] = rest.ravel()
        sides = [Mirror() if patch.type == "symmetryPlane" else Rebound() for patch in domain.patches]
        Cloud(p, domain, NOTHING, sides, 0.02, Models(integrator="paper"), threads=1).advance(20)
        bodies.append((p.F0[0].reshape(3, 3), p.F[0].reshape(3, 3), p.x[0], p.v[0]))
    mirror = turn @ np.diag([1.0, 1.0, -1.0]) @ turn.T
    (rest_there, F_there, x, v), (rest_free, F_free, x_free, v_free) = bodies
    assert x == pytest.approx(mirror @ x_free, abs=1e-12)
    assert v == pytest.approx(mirror @ v_free, abs=1e-12)
    assert rest_there == pytest.approx(mirror @ rest_free @ mirror, abs=1e-15 if turn[0, 0] == 1.0 else 1e-7)
    there, free = F_there @ rest_there, F_free @ rest_free
    near = 1e-12 if turn[0, 0] == 1.0 else 1e-7
    assert there @ there.T == pytest.approx(mirror @ free @ free.T @ mirror, abs=near)
    assert abs((turn.T @ free @ free.T @ turn)[0, 2]) > 0.1


@pytest.mark.parametrize("height", [0.3, 0.5])
def test_a_body_that_appears_in_touch_with_a_wall_sticks_to_no_other_than_a_sticky_one(height):
    """A sphere of radius 0.4 comes to nothing but at a sticky floor that it touches."""
    shape = block(3, 0.2)
    flow = at_rest(build_mesh(shape, box_patches(shape)))
    found = {}
    for wall in (Stick(), Rebound()):
        p = spheres([(0.5, 0.5, height)], d=0.8, rho=1.0, mu=1e3)
        patches = [wall if patch.name == "floor" else Escape() for patch in flow.patches]
        cloud = Cloud(p, flow, NOTHING, patches, 1e-9, Models(integrator="paper"), threads=1)
        cloud.advance(1)
        found[type(wall)] = p.status[0]
    assert found[Stick] == (Status.STUCK if height < 0.4 else Status.ACTIVE)
    assert found[Rebound] == Status.ACTIVE


def test_a_mirror_turns_the_memory_of_a_solid():
    """A body that relaxes to its shape at rest goes on behind the mirror as it would have without."""
    shape = block(3, 0.2)
    patches = [p._replace(type="symmetryPlane") if p.name == "floor" else p for p in box_patches(shape)]
    bodies = []
    for domain in (at_rest(build_mesh(shape, patches)), analytic.linear(np.zeros((3, 3)))):
        p = with_relaxation(spheres([(0.4, 0.6, 0.1)], d=1e-3, rho=1e6, mu=1e3), [1e3, 2e3], [0.05, 0.5])
        p.v[:] = 0.1, 0.0, -1.0
        p.F[:] = 1.2, 0.0, 0.3, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 / 1.2
        sides = [Mirror() if patch.type == "symmetryPlane" else Rebound() for patch in domain.patches]
        Cloud(p, domain, NOTHING, sides, 0.02, Models(integrator="rosenbrock"), threads=1).advance(20)
        bodies.append(p)
    mirrored, free = bodies
    assert mirrored.x[0, 2] == pytest.approx(-free.x[0, 2], rel=1e-6)
    signs = np.array([1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
    assert np.abs(free.memory[0, [4, 10]]).min() > 1e-4
    np.testing.assert_allclose(
        mirrored.memory[0].reshape(2, 6), signs * free.memory[0].reshape(2, 6), atol=1e-6
    )
