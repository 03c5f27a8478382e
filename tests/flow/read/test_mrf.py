"""MRFProperties: zones, their walls, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from foam_writer import header, put_zones, write_case

from foamprb.errors import InputError
from foamprb.flow.base import Caveat
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.flows import read_flow, read_transient_flow
from foamprb.flow.read.mrf import read_rotations, rotating_zones, with_rotating_walls
from foamprb.flow.read.source import FlowSource
from foamprb.flow.rotating import RotatingFlow

RELATIVE = FlowSource(relative=True)
ROTOR = (
    "rotor {{ cellZone upper; active yes; nonRotatingPatches ({still}); origin (0.5 0.5 0); axis (0 0 2); "
    "omega {omega}; }} other {{ cellZone none; active no; }}"
)


@pytest.fixture
def case(tmp_path):
    mesh = write_case(tmp_path, perturbation=0.0)
    cells = np.flatnonzero(mesh.centres[:, 2] > 0.5)
    put_zones(tmp_path, upper=cells)
    put(tmp_path)
    return tmp_path, mesh, cells


def put(case, omega="3", still=""):
    path = case / "constant/MRFProperties"
    path.write_text(header("dictionary", path.name) + ROTOR.format(omega=omega, still=still))


@pytest.mark.parametrize("omega", ["3", "constant 3", "omega [0 0 -1 0 0 0 0] 3"])
def test_an_active_zone_is_read_as_openfoam_writes_it(case, omega):
    folder, _, _ = case
    put(folder, omega, "lid")
    (rotation,) = read_rotations(folder, "")
    assert rotation.zone == "upper"
    assert rotation.omega == (0.0, 0.0, 3.0)
    assert rotation.origin == (0.5, 0.5, 0.0)
    assert rotation.still == ("lid",)


def test_velocities_are_relative_in_the_zone(case):
    folder, _, _ = case
    put(folder, still="floor sides lid")
    flow, absolute = read_flow(folder, source=RELATIVE), read_flow(folder)
    assert isinstance(flow, RotatingFlow)
    assert type(absolute) is MeshFlow
    x = np.array([[0.4, 0.6, 0.2], [0.4, 0.6, 0.8]])
    u, l = flow.sample(x, flow.locate(x), 0.0)
    v, m = absolute.sample(x, absolute.locate(x), 0.0)
    # Ω × r of (−0.1, 0.1, 0.8).
    np.testing.assert_allclose(v - u, [[0.0, 0.0, 0.0], [-0.3, -0.3, 0.0]], atol=1e-6)
    np.testing.assert_allclose((m - l)[1], [[0.0, -3.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 0.0]], atol=1e-6)
    assert any("zone rotor of 4 cells rotates with 3 rad/s" in note for note in flow.notes)
    # The linear velocity goes across the walls.
    of, of_absolute = (
        [note for note in each.notes if isinstance(note, Caveat) and "across its faces" not in note]
        for each in (flow, absolute)
    )
    assert not of
    (warning,) = of_absolute
    assert "absolute velocity" in warning


def test_second_derivatives_are_the_same_in_all_frames(case):
    """As Faxén's correction asks for them."""
    folder, _, _ = case
    random = np.random.default_rng(3)
    absolute, rotating = read_flow(folder), read_flow(folder, source=RELATIVE)
    u, l = random.standard_normal((2, len(absolute.arrays().nodes), 3, 3))
    zones = rotating.rotating
    seen, plain = RotatingFlow(zones, absolute.mesh, u[:, 0], l), MeshFlow(absolute.mesh, u[:, 0], l)
    for x in ((0.4, 0.6, 0.2), (0.4, 0.6, 0.8)):
        host = int(plain.locate(np.array([x]))[0])
        found = seen.kernels["curvature"](seen.arrays(), host, x, 0.0)
        assert np.array(found) == pytest.approx(
            np.array(plain.kernels["curvature"](plain.arrays(), host, x, 0.0))
        )
        assert np.abs(found).max() > 0.1


@pytest.mark.parametrize("still", ["", "sides"])
def test_walls_of_the_zone_turn_with_it_unless_named(case, still):
    """Whatever stands in U."""
    folder, mesh, cells = case
    put(folder, still=still)
    rotations = read_rotations(folder, "")
    zones = rotating_zones(rotations, {"upper": cells}, mesh.n_cells)
    before = np.ones((len(mesh.boundary_centres), 3))
    values = with_rotating_walls(before, mesh, rotations, zones)
    sides = [patch.name for patch in mesh.patches].index("sides")
    own = np.arange(mesh.patch_start[sides], mesh.patch_start[sides + 1])
    x = mesh.boundary_centres[own]
    inside = x[:, 2] > 0.5
    turned = np.stack([-3.0 * (x[:, 1] - 0.5), 3.0 * (x[:, 0] - 0.5), 0.0 * x[:, 0]], axis=1)
    expected = np.where(inside[:, None] & (still == ""), turned, 1.0)
    np.testing.assert_allclose(values[own], expected)
    assert inside.any()
    assert not inside.all()


WRONG = [
    ("table ((0 1) (1 2))", "", r"MRFProperties.*omega is .*Allowed: a constant angular velocity in rad/s"),
    ("fast", "", r"omega is 'fast'"),
]


@pytest.mark.parametrize(("omega", "still", "message"), WRONG)
def test_what_is_no_constant_is_refused(case, omega, still, message):
    folder, _, _ = case
    put(folder, omega, still)
    with pytest.raises(InputError, match=message):
        read_flow(folder, source=RELATIVE)


def test_a_zone_that_the_mesh_lacks_and_a_transient_flow_are_refused(case):
    folder, _, _ = case
    with pytest.raises(InputError, match="seen from their rotors in steady flows only"):
        read_transient_flow(folder, None, None, RELATIVE)
    path = folder / "constant/MRFProperties"
    path.write_text(path.read_text().replace("cellZone upper", "cellZone uper"))
    with pytest.raises(InputError, match=r"cellZone is 'uper', which the mesh does not have\. Did you mean"):
        read_flow(folder, source=RELATIVE)


def test_without_an_active_zone_nothing_changes(case):
    folder, _, _ = case
    path = folder / "constant/MRFProperties"
    path.write_text(path.read_text().replace("active yes", "active no"))
    assert type(read_flow(folder, source=RELATIVE)) is MeshFlow


def zone_of(folder, text):
    path = folder / "constant/MRFProperties"
    path.write_text(header("dictionary", path.name) + text)
    return read_rotations(folder, "")


def test_an_axis_of_any_length_and_direction(case):
    """Ω is ω along the axis; without cellZone the zone is that of the entry's name."""
    folder, _, _ = case
    (one,) = zone_of(
        folder, 'upper { origin (1 2 3); axis (2 -4 4); omega -6; nonRotatingPatches 2(a "b.*"); }'
    )
    assert one.name == one.zone == "upper"
    assert one.omega == pytest.approx((-2.0, 4.0, -4.0))
    assert one.origin == (1.0, 2.0, 3.0)
    assert one.still == ("a", "b.*")
    assert one.source.endswith("constant/MRFProperties")
    first = "origin (0 0 0); axis (0 0 1); omega 1e1;"
    second = "origin origin [0 1 0 0 0 0 0] (.5 1. 1e-1); axis (1 0 0); omega 2; cellZone c;"
    one, two = zone_of(folder, f"a {{ {first} }} b {{ {second} }}")
    assert (one.omega, one.still) == ((0.0, 0.0, 10.0), ())
    assert (two.origin, two.omega, two.zone) == ((0.5, 1.0, 0.1), (2.0, 0.0, 0.0), "c")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "axis (0 0 0); omega 1; origin (0 0 0);",
            r"axis is zero\. Allowed: a vector",
        ),
        ("axis (0 0 1); omega 1;", r"origin is missing\. Allowed: a vector \(x y z\)\."),
        ("axis (0 0 1); origin (0 0 0);", "omega is missing"),
        ("omega 1; origin (0 0 0);", "axis is missing"),
        ("axis (0 0 1 0); omega 1; origin (0 0 0);", "axis is '.*'. Allowed: a vector"),
        ("axis (0 0 1); omega 1; origin { x 0; };", "origin is"),
        (
            "axis (0 0 1); omega 1e999; origin (0 0 0);",
            r"omega is '1e999'\. Allowed: a constant",
        ),
        ("axis (0 0 1e999); omega 1; origin (0 0 0);", r"axis is '\(0 0 1e999\)'. Allowed: a vector"),
        ("axis (0 0 1); omega 1; origin (0 1e999 0);", r"origin is '\(0 1e999 0\)'. Allowed: a vector"),
    ],
)
def test_a_zone_needs_an_axis_a_place_and_a_speed(case, text, message):
    with pytest.raises(InputError, match=message):
        zone_of(case[0], f"rotor {{ {text} }}")


def test_zones_of_a_region_go_before_those_of_the_case(case):
    folder, _, _ = case
    (folder / "constant/air").mkdir()
    assert [r.name for r in read_rotations(folder, "air")] == ["rotor"]
    own = folder / "constant/air/MRFProperties"
    own.write_text(header("dictionary", own.name) + "fan { origin (0 0 0); axis (0 0 1); omega 1; }")
    assert [r.name for r in read_rotations(folder, "air")] == ["fan"]
    assert [r.name for r in read_rotations(folder, "")] == ["rotor"]
    own.unlink()
    (folder / "constant/MRFProperties").unlink()
    assert read_rotations(folder, "air") == ()


@pytest.mark.parametrize("cells", [[0, 8], [-1, 0]])
def test_a_zone_of_cells_beyond_the_mesh_is_refused(case, cells):
    rotations = read_rotations(case[0], "")
    with pytest.raises(InputError, match=r"cellZone upper names cells beyond the mesh's 8\."):
        rotating_zones(rotations, {"upper": np.array(cells)}, 8)
    [zone] = rotating_zones(rotations, {"upper": np.array([0, 7])}, 8)
    assert (zone.name, zone.omega, zone.origin) == ("rotor", (0.0, 0.0, 3.0), (0.5, 0.5, 0.0))
    assert zone.cells.tolist() == [0, 7]
    [empty] = rotating_zones(rotations, {"upper": np.array([], dtype=int)}, 8)
    assert len(empty.cells) == 0
