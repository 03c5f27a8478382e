"""Geometry, planes, camera and colours of a scene."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from foam_writer import GRADIENT, write_case
from hypothesis import given
from hypothesis import strategies as st
from view_run import motion, write_run

from foamprb.errors import InputError
from foamprb.flow.read.openfoam import read_case
from foamprb.view.bodies import Bodies, Codes, Quantity, gather
from foamprb.view.colours import colour_of_name, in_ascii, readable, rgb, round_down, round_limits, written
from foamprb.view.flowfield import cut, read_plane
from foamprb.view.geometry import Geometry, Surface, boundary, flat_normal
from foamprb.view.results import open_run
from foamprb.view.scene import (
    ALL,
    PERCENTILES,
    VIEW_ANGLE,
    automatic_enlargement,
    camera_for,
    limits_of,
    opening,
    principal_axes,
)
from foamprb.view.show import Request, groups_of, make_scene, make_still, spread

EMPTY = Bodies(
    times=np.zeros(1),
    ids=np.zeros(0, dtype=np.int64),
    radius=np.zeros(0),
    x=np.zeros((1, 0, 3)),
    F=np.zeros((1, 0, 3, 3), dtype=np.float32),
    present=np.zeros((1, 0), dtype=bool),
    status=Codes("status", "status", ("pending", "active", "stuck"), np.zeros((1, 0), dtype=np.uint8)),
    fields={},
    codes={},
)


@pytest.fixture(scope="module")
def flow(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cube") / "case"
    write_case(folder, perturbation=0.0)
    return read_case(folder)


@pytest.fixture
def bodies(tmp_path):
    write_run(tmp_path, motion(10, 4), mesh=False)
    return gather(open_run(tmp_path), range(4))


def slab(sides, kind="wall", turn=None):
    """A box whose sides are one patch."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * np.array(sides)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    points = corners if turn is None else corners @ turn.T
    return Geometry((Surface("wall", kind, points, triangles),), np.zeros((0, 2, 3)), None)


class TestGeometry:
    def test_the_boundary_of_a_cube(self, flow):
        geometry = boundary(flow.mesh)
        assert [surface.name for surface in geometry.surfaces] == ["floor", "lid", "sides"]
        areas = np.concatenate([surface.areas for surface in geometry.surfaces])
        # Closed, of six sides, turned outwards.
        np.testing.assert_allclose(areas.sum(axis=0), 0.0, atol=1e-7)
        assert np.linalg.norm(areas, axis=1).sum() == pytest.approx(6.0, rel=1e-6)
        centres = np.concatenate([surface.centres for surface in geometry.surfaces])
        assert (np.einsum("ij,ij->i", areas, centres - 0.5) > 0.0).all()

    def test_edges_are_those_of_the_cube_and_nothing_else(self, flow):
        edges = boundary(flow.mesh).edges
        length = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).sum()
        assert length == pytest.approx(12.0, rel=1e-6)
        at_side = np.isclose(edges, 0.0, atol=1e-6) | np.isclose(edges, 1.0, atol=1e-6)
        assert (at_side.all(axis=1).sum(axis=1) >= 2).all()

    @pytest.mark.parametrize("plane", ["x", "y=0.3", "z=0.77", "(0.4 0.5 0.6) (1 2 -1)"])
    def test_a_plane_shows_the_flow_as_it_is(self, flow, plane):
        """The flow is linear: speed and shear rate are exact."""
        origin, normal = read_plane(plane, *flow.bounds)
        found = cut(flow, origin, normal)
        assert np.abs((found.points - origin) @ normal).max() < 1e-7
        speed = np.linalg.norm(found.points @ GRADIENT.T, axis=1)
        np.testing.assert_allclose(found.values["speed"], speed, atol=2e-5)
        d = 0.5 * (GRADIENT + GRADIENT.T)
        np.testing.assert_allclose(found.values["shearRate"], math.sqrt(2.0 * (d * d).sum()), rtol=1e-5)

    @pytest.mark.parametrize("plane", ["x", "z=0.77"])
    def test_a_plane_fills_the_cross_section(self, flow, plane):
        found = cut(flow, *read_plane(plane, *flow.bounds))
        a, b, c = found.points[found.triangles].transpose(1, 0, 2)
        assert 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() == pytest.approx(1.0, rel=1e-5)

    @pytest.mark.parametrize(
        ("text", "said"),
        [
            ("w", "not a plane"),
            ("x=a", "not a plane"),
            ("(0 0 0)", "not a plane"),
            ("(0 0 0) (0 0 0)", "normal is zero"),
            ("z=2", "misses the mesh"),
            ("(0 0 3) (0 0 1)", "misses the mesh"),
        ],
    )
    def test_invalid_planes_are_refused(self, text, said):
        with pytest.raises(InputError, match=said):
            read_plane(text, np.zeros(3), np.ones(3))

    def test_the_flat_direction_is_that_of_the_empty_patches(self, flow):
        mesh = boundary(flow.mesh)
        kinds = {"sides": "wall", "floor": "empty", "lid": "empty"}
        surfaces = [surface._replace(type=kinds[surface.name]) for surface in mesh.surfaces]
        np.testing.assert_allclose(flat_normal(surfaces), [0.0, 0.0, 1.0], atol=1e-7)


SIDES = st.tuples(*[st.sampled_from([0.01, 0.1, 1.0, 5.0])] * 3)


class TestCamera:
    @given(SIDES, st.floats(0.3, 3.0), st.sampled_from([(0, 0, 0), (0, -9.81, 0), (3.0, 0, -9.0)]))
    def test_everything_is_seen_unless_it_is_long(self, sides, aspect, g):
        geometry = slab(sides)
        camera = camera_for(geometry, EMPTY, 0, np.array(g, dtype=float))
        assert np.linalg.norm(camera.towards) == pytest.approx(1.0)
        across = np.cross(camera.up, camera.towards)
        across /= np.linalg.norm(across)
        upright = np.cross(camera.towards, across)
        assert camera.up @ upright > 0.5
        seen = geometry.points - camera.focus - camera.distance(aspect) * camera.towards
        depth = -(seen @ camera.towards)
        assert (depth > 0.0).all() or math.isfinite(camera.least_width)
        slope = math.tan(math.radians(VIEW_ANGLE / 2))
        if not math.isfinite(camera.least_width):
            assert (np.abs(seen @ across) <= slope * aspect * depth).all()
            assert (np.abs(seen @ upright) <= slope * depth).all()

    def test_texts_leave_less_room(self):
        camera = camera_for(slab((1.0, 1.0, 1.0)), EMPTY, 0, np.zeros(3))
        assert camera.distance(2.0, 0.5) > 1.5 * camera.distance(2.0)

    def test_of_a_long_pipe_the_part_with_most_bodies(self, bodies):
        geometry = slab((100.0, 1.0, 1.0))
        x = bodies.x.copy()
        x[..., 0] += 70.0
        moved = replace(bodies, x=x)
        camera = camera_for(
            geometry, moved, int(moved.shown.sum(axis=1).argmax()), np.array([0.0, -9.81, 0.0])
        )
        assert 68.0 < camera.focus[0] < 73.0
        np.testing.assert_allclose(camera.up, [0.0, 1.0, 0.0])

    def test_a_step_of_six_widths_opens_whole(self, bodies):
        """All of it is visible, though the bodies lie in a part."""
        geometry = slab((6.0, 1.0, 0.01))._replace(flat=np.array([0.0, 0.0, 1.0]))
        camera = camera_for(geometry, bodies, int(bodies.shown.sum(axis=1).argmax()), np.zeros(3))
        np.testing.assert_allclose(camera.focus[:2], [3.0, 0.5])
        assert camera.distance(2.0) * 2.0 * math.tan(math.radians(VIEW_ANGLE / 2)) > 3.0

    def test_a_flat_case_is_looked_at_straight(self):
        geometry = slab((2.0, 1.0, 0.01))._replace(flat=np.array([0.0, 0.0, 1.0]))
        camera = camera_for(geometry, EMPTY, 0, np.zeros(3))
        np.testing.assert_allclose(camera.towards, [0.0, 0.0, 1.0])
        np.testing.assert_allclose(camera.up, [0.0, 1.0, 0.0])

    def test_a_flat_room_on_the_floor_is_seen_from_above_with_gravity_down(self):
        camera = camera_for(slab((4.0, 3.0, 0.5)), EMPTY, 0, np.array([0.0, 0.0, -9.81]))
        assert camera.up @ [0.0, 0.0, 1.0] > 0.5
        assert camera.towards @ [0.0, 0.0, 1.0] == pytest.approx(math.sin(math.radians(55.0)))

    def test_a_tilted_box_is_seen_along_its_own_axes(self):
        angle = math.radians(35.0)
        turn = np.array(
            [[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]]
        )
        points = slab((9.0, 2.0, 1.0), turn=turn).points
        axes = principal_axes(points, points.min(axis=0), points.max(axis=0))
        assert abs(axes[:, 0] @ turn[:, 0]) == pytest.approx(1.0, abs=1e-9)
        straight = slab((9.0, 2.0, 1.0)).points
        np.testing.assert_array_equal(
            principal_axes(straight, np.zeros(3), np.array([9.0, 2.0, 1.0])), np.eye(3)
        )

    @pytest.mark.parametrize(
        ("recorded", "shown"),
        [([0.8, 0.0, 0.0], [1.0, 0.0, 0.0]), ([0.1, 0.0, 0.0], None), (None, None), ("[1, 0]", None)],
    )
    def test_the_direction_of_the_flow_is_that_of_the_record(self, tmp_path, recorded, shown):
        write_run(tmp_path, motion(4, 2), mesh=False)
        run = open_run(tmp_path)
        run.results.record.write_text(json.dumps({"flow": {"direction": recorded}}))
        found = make_scene(Request(tmp_path), run, range(2)).directions
        assert {name: vector.tolist() for name, vector in found.items()} == ({"flow": shown} if shown else {})

    def test_without_a_sound_record_the_flow_has_no_direction(self, tmp_path, caplog):
        write_run(tmp_path, motion(4, 2), mesh=False)
        run = open_run(tmp_path)
        run.results.record.write_text("{")
        assert make_scene(Request(tmp_path), run, range(2)).directions == {}
        assert "The direction of the flow is not shown" in caplog.text

    def test_gravity_of_the_case_points_down(self, tmp_path):
        write_run(tmp_path, motion(4, 2), mesh=False)
        (tmp_path / "constant").mkdir()
        (tmp_path / "constant/g").write_text("FoamFile { format ascii; } value (0 0 -9.81);")
        scene = make_scene(Request(tmp_path), open_run(tmp_path), range(2))
        assert scene.camera.up.tolist() == [0.0, 0.0, 1.0]
        assert scene.directions["gravity"].tolist() == [0.0, 0.0, -1.0]


class TestNumbers:
    @given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
    def test_limits_hold_the_values_and_are_not_much_wider(self, a, b):
        low, high = sorted((a, b))
        least, most = round_limits(low, high)
        size = max(abs(low), abs(high))
        assert least <= low + 2e-6 * size
        assert most >= high - 2e-6 * size
        assert most > least
        # One digit: at worst from 1.0…1 to 2; and both sides of zero alike.
        assert max(abs(least), abs(most)) <= max(2.0 * size * (1 + 1e-9), 1.0 if size == 0.0 else 0.0)

    @pytest.mark.parametrize(
        ("values", "limits"),
        [
            ((0.02, 0.71), (0.0, 0.8)),
            ((-3.0, 1.0), (-3.0, 3.0)),
            ((0.998, 1.003), (0.998, 1.003)),
            ((5, 5), (0, 5)),
        ],
    )
    def test_limits_are_round(self, values, limits):
        assert round_limits(*values) == pytest.approx(limits, abs=6e-4)

    @given(st.floats(1e-9, 1e9))
    def test_rounding_down(self, value):
        assert 0.5 * value < round_down(value) <= value * (1 + 1e-11)

    @pytest.mark.parametrize(
        ("value", "unit", "most", "text"),
        [
            (2.5e-6, "m", 2.5e-6, "2.5 µm"),
            (0.04, "s", 0.06, "40 ms"),
            (0.12, "s", 0.56, "0.12 s"),
            (-0.0196, "m/s", 0.03, "−19.6 mm/s"),
            (2560.0, "kg/m3", 2560.0, "2560 kg/m³"),
            (0.3, "", 0.3, "0.3"),
            (0.0, "m", 0.0, "0 m"),
            (-1.5e-5, "1/s", 1.5e-5, "−1.5 × 10⁻⁵ 1/s"),
            (12345.6, "1/s", 2e4, "12350 1/s"),
            (1.23456e7, "", 2e7, "1.235 × 10⁷"),
        ],
    )
    def test_numbers_with_units(self, value, unit, most, text):
        assert written(value, unit, most) == text

    def test_a_unit_keeps_its_powers_outside_the_prefixes(self):
        assert readable("N m", 1e-18) == (1.0, "N m")
        assert readable("1/s", 1e-5) == (1.0, "1/s")

    def test_the_first_forty_names_have_forty_colours(self):
        colours = [rgb(colour_of_name(k)) for k in range(40)]
        assert len(set(colours)) == 40


def with_values(values):
    """Bodies at one time, all in the flow, with an array of these values."""
    n = len(values)
    field = Quantity("D", "D", "", ("",), np.array(values, dtype=np.float32)[None, :, None])
    status = Codes("status", "status", ("pending", "active"), np.ones((1, n), dtype=np.uint8))
    return replace(EMPTY, present=np.ones((1, n), dtype=bool), status=status, fields={"D": field})


class TestOutliers:
    def test_one_among_many_has_no_share_in_the_colours(self):
        bodies = with_values([*np.linspace(0.0, 0.1, 999), 70.0, np.nan])
        assert limits_of(bodies, "D", "", PERCENTILES) == (0.0, pytest.approx(0.1))
        assert limits_of(bodies, "D", "", ALL) == limits_of(bodies, "D", "") == (0.0, 70.0)

    def test_three_in_a_hundred_at_a_wall_do_not_make_the_others_alike(self):
        """In pitzDaily, most D lie below 0.1, and those at the walls near 1."""
        bodies = with_values([*np.linspace(0.0, 0.1, 97), 0.8, 0.9, 1.0])
        assert limits_of(bodies, "D", "", PERCENTILES) == (0.0, pytest.approx(0.1))

    def test_of_up_to_twenty_values_none_is_left_out(self):
        assert limits_of(with_values([*[0.1] * 19, 7.0]), "D", "", PERCENTILES)[1] == 7.0
        assert limits_of(with_values([]), "D", "", PERCENTILES) == (0.0, 1.0)

    def test_where_nearly_all_are_alike_the_others_count(self):
        assert limits_of(with_values([*[0.0] * 999, 7.0]), "D", "", PERCENTILES) == (0.0, 7.0)


def test_enlargement_makes_bodies_visible_but_not_overlapping(bodies):
    sides = np.ones(3)
    size = 2.0 * np.median(bodies.radius)
    drawn = size * automatic_enlargement(bodies, sides)
    assert 0.02 < drawn <= 1 / 16
    assert automatic_enlargement(bodies, 0.1 * sides) == 1.0
    # A thousand times as many in the same box are a tenth as large.
    many = replace(
        bodies,
        status=bodies.status._replace(codes=np.repeat(bodies.status.codes, 1000, axis=1)),
        present=np.repeat(bodies.present, 1000, axis=1),
        radius=np.repeat(bodies.radius, 1000) / 50.0,
    )
    assert size / 50.0 * automatic_enlargement(many, sides) < 0.05


def test_deposits_open_at_the_last_time_and_others_at_the_fullest():
    shown = np.array([1, 7, 7, 4])
    assert opening(shown, 0) == opening(shown, 3) == 2
    assert opening(shown, 4) == 3
    assert opening(np.zeros(3, dtype=int), 0) == 2


def test_deposits_after_the_first_time_shown_are_named(tmp_path):
    case = tmp_path / "case"
    write_run(case, motion(6, 4))
    run = open_run(case)
    scene = make_scene(Request(case), run, range(4))
    assert (scene.bodies.times[scene.first], scene.groups) == (pytest.approx(0.2), "1 on walls at 300 ms")
    assert make_scene(Request(case, time=0.3), run, range(4)).groups == ""
    assert make_still(Request(case), run).groups == scene.groups


@given(st.integers(1, 300), st.integers(1, 300))
def test_times_are_spread_evenly_and_end_with_the_last(count, most):
    frames = spread(count, most)
    assert len(frames) == min(count, most)
    assert frames[-1] == count - 1
    assert frames == sorted(set(frames))
    gaps = np.diff(frames)
    assert gaps.size == 0 or gaps.max() - gaps.min() <= 1


def test_the_caption_has_the_groups_and_the_fluid():
    record = {
        "injections": [
            {"capillary": [0.02, 0.5], "reynolds": [1e-5, 1e-5]},
            {"capillary": [1.5, 2.0], "reynolds": [1e-5, 1e-5]},
        ],
        "fluid": {"mu": 1.8e-5, "rho": 1.208},
    }
    assert groups_of(record) == "Ca 0.02 to 2, Re 1 × 10⁻⁵, fluid 0.018 mPa s, 1.208 kg/m³"
    # ParaView's typeface has no small digits but ¹²³, and no minus.
    assert in_ascii(groups_of(record)) == "Ca 0.02 to 2, Re 1e-5, fluid 0.018 mPa s, 1.208 kg/m³"
    assert groups_of({}) == ""
