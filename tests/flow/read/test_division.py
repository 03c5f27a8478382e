"""A boundary divided by the velocity, at its edges or by an array, and the types of its patches."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mesh_shapes import block, corners, grid, pipe

from foamprb.errors import InputError
from foamprb.flow.mesh.cells import poly_of_grid
from foamprb.flow.mesh.mesh import assemble, build_mesh
from foamprb.flow.read import division
from foamprb.flow.read.division import BoundaryVelocity, boundary_velocity, divided, lost_flow
from foamprb.flow.read.source import Division

FILE = Path("flow.vtu")


def divide(shape, by=Division(), whole=None):  # noqa: B008
    poly = poly_of_grid(shape, None, "flow.vtu")
    mesh = assemble(poly, "flow.vtu")
    u = boundary_velocity(mesh, [(shape, [])], "U")
    return divided(poly, mesh, shape if whole is None else whole, by, u, FILE)


def with_flow(shape, u, where):
    places = shape.points if where == "points" else shape.cell_centers().points
    data = shape.point_data if where == "points" else shape.cell_data
    data["U"] = u(np.asarray(places, dtype=float).T)
    return shape


def along_x(u):
    return np.stack([u, 0.0 * u, 0.0 * u], axis=1)


def patches_of(shape, by=Division()):  # noqa: B008
    mesh = divide(shape, by)[0]
    return {patch.name: patch.type for patch in mesh.patches}


@pytest.mark.parametrize(("angle", "count"), [(89.0, 6), (91.0, 1)])
@pytest.mark.parametrize("kind", ["hexahedra", "mixed"])
def test_a_box_has_six_sides_up_to_a_right_angle(angle, count, kind):
    mesh, _, warnings = divide(block(2, 0.0, kind), Division(feature_angle=angle))
    assert not warnings
    assert [patch.name for patch in mesh.patches] == (
        [f"wall{k}" for k in range(6)] if count == 6 else ["wall"]
    )
    for first, last in zip(mesh.patch_start[:-1], mesh.patch_start[1:], strict=True):
        n = mesh.boundary_areas[first:last] / np.linalg.norm(mesh.boundary_areas[first:last], axis=1)[:, None]
        assert np.allclose(n, n[0]) == (count == 6)


@pytest.mark.parametrize(("angle", "count"), [(20.0, 18), (25.0, 3)])
def test_a_pipe_of_sixteen_sides_is_round_from_their_angle_on(angle, count):
    """Sides turn by 22.5 degrees."""
    assert len(divide(pipe(4), Division(feature_angle=angle))[0].patches) == count


@pytest.mark.parametrize("where", ["cells", "points"])
def test_the_flow_of_a_pipe_shows_its_ends(where):
    shape = with_flow(pipe(6), lambda x: along_x(1.0 - x[1] ** 2 - x[2] ** 2), where)
    mesh, u, _ = divide(shape)
    assert patches_of(shape) == {"opening0": "patch", "wall": "wall", "opening1": "patch"}
    flux = np.add.reduceat(u.fluxes(mesh)[0], mesh.patch_start[:-1])
    assert flux == pytest.approx([-np.pi / 2, 0.0, np.pi / 2], rel=0.1, abs=1e-9)
    assert not lost_flow(mesh, u)


@pytest.mark.parametrize("where", ["cells", "points"])
def test_half_a_channel_ends_at_a_symmetry_plane(where):
    """The profile is widest at y = 0; nothing changes along z."""
    shape = with_flow(block(8, 0.0), lambda x: along_x(1.0 - x[1] ** 2), where)
    mesh = divide(shape)[0]
    types = {}
    for patch, first in zip(mesh.patches, mesh.patch_start[:-1], strict=True):
        types[tuple(np.round(mesh.boundary_areas[first] * 64.0).astype(int).tolist())] = patch.type
    assert types == {
        (-1, 0, 0): "patch", (1, 0, 0): "patch", (0, -1, 0): "symmetryPlane", (0, 1, 0): "wall",
        (0, 0, -1): "symmetryPlane", (0, 0, 1): "symmetryPlane",
    }  # fmt: skip


@pytest.mark.parametrize("where", ["cells", "points"])
def test_a_wall_that_moves_along_itself_is_a_wall(where):
    """Couette flow, whose ends are open."""
    shape = with_flow(block(6, 0.0), lambda x: along_x(x[1]), where)
    assert sorted(patches_of(shape).values()) == ["patch"] * 2 + ["symmetryPlane"] * 2 + ["wall"]


@pytest.mark.parametrize("where", ["cells", "points"])
def test_a_closed_cavity_has_no_opening(where):
    """Velocities that are continued from the cells to the corners cross the walls there."""

    def eddy(place):
        x, y, z = place
        s, c = np.sin(np.pi * np.array([x, y])), np.cos(np.pi * np.array([x, y]))
        return np.stack([s[0] ** 2 * s[1] * c[1], -(s[1] ** 2) * s[0] * c[0], 0.0 * z], axis=1)

    assert sorted(patches_of(with_flow(block(12, 0.0), eddy, where)).values()) == ["symmetryPlane"] * 2 + [
        "wall"
    ]


def test_an_opening_in_a_wall_is_a_patch_of_its_own():
    """A jet through the floor, and all of the lid opposite."""

    def jet(place):
        x, y, z = place
        r2 = (x - 0.5) ** 2 + (y - 0.5) ** 2
        w = np.where(z < 1e-9, np.maximum(1.0 - r2 / 0.0625, 0.0), 0.1113)
        inside = np.minimum.reduce([x, 1.0 - x, y, 1.0 - y]) > 1e-9
        return np.stack([0.0 * w, 0.0 * w, w * inside], axis=1)

    shape = with_flow(block(16, 0.0), jet, "points")
    mesh, u, _ = divide(shape)
    assert sorted(patch.name for patch in mesh.patches) == ["opening0", "opening1", "wall"]
    area = {
        patch.name: np.linalg.norm(mesh.boundary_areas[a:b], axis=1).sum()
        for patch, a, b in zip(mesh.patches, mesh.patch_start, mesh.patch_start[1:], strict=False)
    }
    assert area["opening0"] == pytest.approx(np.pi / 16, rel=0.25)
    assert area["opening1"] == pytest.approx(1.0)
    assert not lost_flow(mesh, u)
    mesh.patches = tuple(
        patch._replace(type="wall") if patch.name == "opening0" else patch for patch in mesh.patches
    )
    assert len(lost_flow(mesh, u)) == 1


@pytest.mark.parametrize(
    ("speed", "continued", "count"), [(0.01, 1.0, 3), (0.01, 0.5, 2), (0.01, -1.0, 2), (1e-5, 1.0, 2)]
)
def test_a_wall_that_the_flow_meets_is_no_opening(speed, continued, count):
    """The velocity across it decreases towards it. Hardly any flow crosses the edges of a rough domain."""
    shape = block(2, 0.0)
    poly = poly_of_grid(shape, None, "flow.vtu")
    mesh = assemble(poly, "flow.vtu")
    x, _, z = mesh.boundary_centres.T
    cells = np.zeros((1, len(x), 3))
    cells[0, (x == 0.0) | (x == 1.0), 0] = 1.0
    cells[0, z == 1.0, 2] = speed
    faces = cells * np.where(z == 1.0, continued, 1.0)[:, None]
    u = BoundaryVelocity(faces, cells, np.zeros(len(x), dtype=bool))
    patches = divided(poly, mesh, shape, Division(), u, FILE)[0].patches
    assert [patch.type for patch in patches].count("patch") == count


def test_the_type_of_a_patch_is_that_of_all_times():
    """A flow at rest at the first time."""
    shape = with_flow(block(4, 0.0), lambda x: along_x(x[1] * (1.0 - x[1])), "points")
    still = with_flow(block(4, 0.0), lambda x: along_x(0.0 * x[1]), "points")
    poly = poly_of_grid(still, None, "flow.vtu")
    mesh = assemble(poly, "flow.vtu")
    u = boundary_velocity(mesh, [(still, []), (shape, [])], "U")
    patches = divided(poly, mesh, still, Division(), u, FILE)[0].patches
    assert [patch.type for patch in patches].count("patch") == 2


def test_cells_that_meet_in_an_edge_alone_are_noted():
    """Two cubes that touch along an edge, where four boundary faces meet."""
    points, hexes = corners(2, 0.0)
    middle = points[hexes].mean(axis=1)
    chosen = hexes[(middle[:, 2] < 0.5) & ((middle[:, 0] < 0.5) == (middle[:, 1] < 0.5))]
    shape = grid(points, [(12, chosen)])
    (warning,) = divide(shape)[2]
    assert warning.startswith("At 1 edges more than two boundary faces meet: the domain touches itself there")
    edges, face = division._boundary_edges(build_mesh(shape))
    assert len(edges) == len(face) == 48
    assert np.bincount(face).tolist() == [4] * 12
    assert sorted(np.unique(edges, return_counts=True)[1].tolist()) == [2] * 22 + [4]


def test_too_many_patches_are_refused(monkeypatch):
    shape = block(2, 0.0)
    for most, refused in ((6, False), (5, True)):
        monkeypatch.setattr(division, "_MOST_PATCHES", most)
        if refused:
            with pytest.raises(InputError, match=r"the boundary falls into 6 patches; at most 5\."):
                divide(shape, Division(feature_angle=30.0))
        else:
            divide(shape, Division(feature_angle=30.0))


def by_array(values, kinds=(12, 9), names=None):
    points, hexes = corners(1, 0.0)
    parts = {12: hexes, 9: np.concatenate([hexes[:, :4], hexes[:, 4:]])}
    whole = grid(points, [(kind, parts[kind]) for kind in kinds])
    whole.cell_data["part"] = np.asarray(values)
    for name, value in (names or {}).items():
        whole.field_data[name] = np.array(value)
    return divide(grid(points, [(12, hexes)]), Division(array="part"), whole)[0]


def test_values_on_surface_cells_name_the_patches():
    """By the groups of two dimensions; what has no value or no name is the boundary."""
    names = {"low": [4, 2], "solid": [7, 3], "high": [9, 3], "other": [1, 2, 3]}
    mesh = by_array([7, 4, 9], names=names)
    found = {patch.name: k for k, patch in enumerate(mesh.patches)}
    assert set(found) == {"boundary", "low", "boundary9"}
    for name, z in (("low", 0.0), ("boundary9", 1.0)):
        own = slice(*mesh.patch_start[found[name] :][:2])
        assert mesh.boundary_centres[own][:, 2].tolist() == [z]
    assert np.diff(mesh.patch_start)[found["boundary"]] == 4
    assert all(patch.type == "wall" for patch in mesh.patches)


@pytest.mark.parametrize("values", [[0.5, 1.0, 2.0], [[1, 2], [3, 4], [5, 6]]])
def test_an_array_of_other_than_whole_numbers_is_refused(values):
    with pytest.raises(InputError, match="cell array part is not an array of integers, one for each cell"):
        by_array(values)


def test_an_array_needs_surface_cells():
    with pytest.raises(InputError, match="no surface cells among the cells, for part to name patches on"):
        by_array([1], kinds=(12,))
