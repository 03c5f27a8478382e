"""Coupled patches: the motion from one to the other, and which face goes on in which."""

from __future__ import annotations

import numpy as np
import pytest
import pyvista
from scipy.spatial.transform import Rotation

from foamprb.errors import InputError
from foamprb.flow.base import Patch
from foamprb.flow.mesh import coupling
from foamprb.flow.mesh.boundary import PatchSurface, Transform
from foamprb.flow.mesh.coupling import Coupling, couple

NOWHERE = np.zeros(3)


def patch(n=3, width=1.0, bend=0.3):
    """Centres and area vectors of n × n faces, a little bent so that no rotation carries them onto itself."""
    t = (np.arange(n) + 0.5) / n * width
    y, z = (g.ravel() for g in np.meshgrid(t, t))
    centres = np.stack([bend * y * y + 0.5 * bend * y * z, y, z], axis=1)
    areas = np.stack([-np.ones_like(y), bend * (2.0 * y + 0.5 * z), 0.5 * bend * y], axis=1)
    return centres, areas * (width / n) ** 2


def joined(first, second):
    """Centres, areas and face numbers of two patches."""
    a, b = np.arange(len(first[0])), len(first[0]) + np.arange(len(second[0]))
    return np.concatenate([first[0], second[0]]), np.concatenate([first[1], second[1]]), a, b


def moved(faces, turn, shift):
    """Where a motion carries faces; there they face the other way."""
    return faces[0] @ turn.T + shift, -faces[1] @ turn.T


def motions(random):
    for angle in (0.0, 0.3, 2.0, np.pi):
        axis = random.normal(size=3)
        yield Rotation.from_rotvec(angle * axis / np.linalg.norm(axis)).as_matrix(), random.normal(size=3)


def test_the_motion_between_cyclic_patches_is_found_from_their_faces(random):
    for turn, shift in motions(random):
        centres, areas, a, b = joined(patch(), moved(patch(), turn, shift))
        found = coupling._cyclic(4, 7, a, b, centres, areas)
        assert (found.patch, found.other, found.matching) == (4, 7, True)
        np.testing.assert_allclose(found.turn, turn, atol=1e-12)
        np.testing.assert_allclose(found.shift, shift, atol=1e-12)
        assert np.array_equal(found.faces, a)
        assert np.array_equal(found.partners, b)
        back = found.reverse()
        assert (back.patch, back.other) == (7, 4)
        assert np.array_equal(back.faces, b)
        assert np.array_equal(back.partners, a)
        np.testing.assert_allclose(centres[b] @ back.turn.T + back.shift, centres[a], atol=1e-12)


def test_a_rotation_by_round_off_of_single_precision_is_none(random):
    for angle, none in ((5e-6, True), (2e-5, False)):
        turn = Rotation.from_rotvec([0.0, 0.0, angle]).as_matrix()
        centres, areas, a, b = joined(patch(), moved(patch(), turn, np.array([1.0, 2.0, 3.0])))
        assert np.array_equal(coupling._cyclic(0, 1, a, b, centres, areas).turn, np.eye(3)) == none


@pytest.mark.parametrize("n", [1, 2])
def test_few_faces_are_turned_no_more_than_they_must(n):
    """One face, or two in a row, along each axis: about their normal nothing is known."""
    for axis in range(3):
        centres = np.roll(np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 1.5]])[:n], axis, axis=1)
        areas = np.roll(np.array([[-1.0, 0.0, 0.0]] * n), axis, axis=1)
        shift = np.array([1.0, 2.0, 3.0])
        centres, areas, a, b = joined((centres, areas), moved((centres, areas), np.eye(3), shift))
        found = coupling._cyclic(0, 1, a, b, centres, areas)
        assert np.array_equal(found.turn, np.eye(3))
        np.testing.assert_allclose(found.shift, shift, atol=1e-12)


def test_faces_must_land_on_each_other_face_each_other_and_be_as_large(random):
    """To a hundredth of their size."""
    for turn, shift in motions(random):
        for off, fits in ((0.005, True), (0.02, False)):
            size = np.sqrt(np.linalg.norm(patch()[1], axis=1))
            # One face moved along, and the motion as it was.
            for k, axis in ((0, 1), (4, 2), (8, 0)):
                centres, areas, a, b = joined(patch(), moved(patch(), turn, shift))
                centres[b[k], axis] += off * size[k]
                one = Coupling(0, 1, a, b, turn, shift)
                assert coupling._fits(one, centres, areas) == fits
                centres, areas, a, b = joined(patch(), moved(patch(), turn, shift))
                areas[b[k]] *= 1.0 + 2.0 * off
                assert coupling._fits(one, centres, areas) == fits
        centres, areas, a, b = joined(patch(), moved(patch(), turn, shift))
        assert coupling._cyclic(0, 1, a, b[:-1], centres, areas) is None
        assert coupling._cyclic(0, 1, a, b[::-1], centres, areas) is None
        # As in a mirror.
        mirror = np.diag([1.0, 1.0, -1.0])
        centres, areas, a, b = joined(patch(), moved(patch(), turn @ mirror, shift))
        assert coupling._cyclic(0, 1, a, b, centres, areas) is None


def test_wedges_turn_about_the_line_in_which_their_planes_meet(random):
    """Wherever it lies; each face looks for its partner."""
    for _ in range(5):
        Q, origin = Rotation.random(random_state=random.integers(1000)).as_matrix(), random.normal(size=3)
        half = np.radians(random.uniform(1.0, 20.0))
        r, z = (g.ravel() for g in np.meshgrid([0.3, 0.7, 1.2], [0.1, 0.5]))
        sides = []
        for sign in (-1.0, 1.0):
            x = np.stack([r * np.cos(half), sign * r * np.sin(half), z], axis=1)
            n = np.tile([-np.sin(half), sign * np.cos(half), 0.0], (6, 1)) * (1.0 + r)[:, None] * 0.01
            sides.append((x @ Q.T + origin, n @ Q.T))
        order = random.permutation(6)
        centres, areas, a, b = joined(sides[0], tuple(s[order] for s in sides[1]))
        found = coupling._wedge(2, 5, a, b, centres, areas)
        turn = Q @ Rotation.from_rotvec([0.0, 0.0, 2.0 * half]).as_matrix() @ Q.T
        np.testing.assert_allclose(found.turn, turn, atol=1e-12)
        np.testing.assert_allclose(found.shift, origin - turn @ origin, atol=1e-12)
        assert (found.patch, found.other) == (2, 5)
        assert np.array_equal(found.faces, a)
        assert np.array_equal(found.partners, b[np.argsort(order)])
        assert coupling._wedge(2, 5, a, b[:-1], centres, areas) is None
        # Nothing turns between parallel planes, and two faces may not go on in one.
        assert coupling._wedge(2, 5, a, a, centres, areas * [[1.0]]) is None
        beside = centres.copy()
        beside[b[0]] = beside[b[1]]
        assert coupling._wedge(2, 5, a, b, beside, areas) is None


def stated(transform, x=(0.0, 0.0, 0.0), m=(-1.0, 0.0, 0.0), y=(3.0, 0.0, 0.0), n=(1.0, 0.0, 0.0)):
    surface = PatchSurface("side", "cyclicAMI", None, "", transform)
    return coupling._stated_motion(surface, *(np.array(v, dtype=float) for v in (x, m, y, n)))


def test_a_translation_is_the_stated_one_in_the_sense_that_fits():
    for separation, shift in (
        (None, (3.0, 0.0, 0.0)),
        ((3.1, 0.0, 0.0), (3.1, 0.0, 0.0)),
        ((-3.1, 0.0, 0.0), (3.1, 0.0, 0.0)),
        ((0.1, 2.0, 0.0), (0.1, 2.0, 0.0)),
    ):
        turn, found = stated(Transform("translational", separation=separation))
        assert np.array_equal(turn, np.eye(3))
        assert tuple(found) == shift
    turn, found = stated(Transform())
    assert np.array_equal(turn, np.eye(3))
    assert not found.any()
    assert not stated(Transform("rotational"))[1].any()


@pytest.mark.parametrize("angle", [0.4, -0.4, 2.5])
def test_a_rotation_is_that_between_the_sides_about_the_stated_axis(angle, random):
    """Sides of a sector by the way they face, sides that wind about the axis by where they lie."""
    for _ in range(4):
        axis, centre = random.normal(size=3), random.normal(size=3)
        unit = axis / np.linalg.norm(axis)
        turn = Rotation.from_rotvec(angle * unit).as_matrix()
        x, m = random.normal(size=3), random.normal(size=3)
        y = centre + turn @ (x - centre)
        for given in (None, abs(angle), -abs(angle)):
            transform = Transform("rotational", axis=tuple(axis), centre=tuple(centre), angle=given)
            for way, area in (("faces", m), ("lies", 3.0 * unit + 1e-3 * m)):
                place = x if way == "lies" else centre + unit
                there = y if way == "lies" else centre + unit
                found, shift = stated(transform, place, area, there, -turn @ area)
                np.testing.assert_allclose(found, turn, atol=1e-9, err_msg=way)
                np.testing.assert_allclose(shift, centre - turn @ centre, atol=1e-9)
        # Not the one between the sides, but the one that is stated.
        transform = Transform("rotational", axis=tuple(axis), centre=tuple(centre), angle=0.5)
        sense = Rotation.from_rotvec(0.5 * np.sign(angle) * unit).as_matrix()
        np.testing.assert_allclose(stated(transform, x, m, y, -turn @ m)[0], sense, atol=1e-12)


def test_without_a_centre_the_axis_goes_through_the_origin():
    turn = Rotation.from_rotvec([0.0, 0.0, 0.4]).as_matrix()
    x, m = np.array([1.0, 0.2, 0.3]), np.array([0.1, -1.0, 0.0])
    found, shift = stated(Transform("rotational", axis=(0.0, 0.0, 2.0)), x, m, turn @ x, -turn @ m)
    np.testing.assert_allclose(found, turn, atol=1e-12)
    np.testing.assert_allclose(shift, 0.0, atol=1e-12)


def sheet(n, x=0.0, low=0.0, high=1.0, facing=1.0):
    """A plane patch of n × n faces at x, from low to high along y and from 0 to 1 along z."""
    plane = pyvista.ImageData(dimensions=(1, n + 1, n + 1), spacing=(1.0, (high - low) / n, 1.0 / n),
                              origin=(x, low, 0.0)).extract_surface(algorithm="dataset_surface")  # fmt: skip
    centres = np.array(plane.cell_centers().points, dtype=float)
    areas = np.tile([facing * (high - low) / n**2, 0.0, 0.0], (n * n, 1))
    return plane, (centres, areas)


ALONG = Transform("translational", separation=(1.0, 0.0, 0.0))


def interface(here, there, transform=ALONG):
    centres, areas, a, b = joined(here[1], there[1])
    surfaces = [
        PatchSurface("one", "cyclicAMI", here[0], "two", transform),
        PatchSurface("two", "cyclicAMI", there[0], "one", transform),
    ]
    patches = [Patch("one", "cyclicAMI", "two"), Patch("two", "cyclicAMI", "one")]
    return couple(patches, np.array([0, len(a), len(a) + len(b)]), centres, areas, surfaces, "mesh")


def test_patches_cut_differently_go_on_in_the_nearest_faces():
    here, there = sheet(4, facing=-1.0), sheet(6, 1.0)
    named, (one, two) = interface(here, there)
    assert [p.neighbour for p in named] == ["two", "one"]
    for found, (patch_, other), shift in ((one, (0, 1), (1.0, 0, 0)), (two, (1, 0), (-1.0, 0, 0))):
        assert (found.patch, found.other, found.matching) == (patch_, other, False)
        assert np.array_equal(found.turn, np.eye(3))
        assert tuple(found.shift) == shift
    both = np.concatenate([here[1][0], there[1][0]])
    assert np.array_equal(one.faces, np.arange(16))
    assert np.array_equal(two.faces, 16 + np.arange(36))
    for found in (one, two):
        apart = both[found.faces] + found.shift - both[found.partners]
        assert np.abs(apart).max() <= 0.126


@pytest.mark.parametrize(
    ("there", "fits"),
    [
        # Of the area of each 95 % must lie on the other.
        (sheet(40, 1.0, 0.0, 1.03), True),
        (sheet(40, 1.0, 0.0, 1.08), False),
        (sheet(40, 1.0, 0.0, 0.97), True),
        (sheet(40, 1.0, 0.0, 0.9), False),
        # Apart by less and by more than a quarter of a face.
        (sheet(40, 1.0 + 0.2 / 40), True),
        (sheet(40, 1.0 + 0.3 / 40), False),
    ],
)
def test_patches_that_do_not_lie_on_each_other_are_not_coupled(there, fits):
    named, couplings = interface(sheet(40, facing=-1.0), there)
    assert len(couplings) == (2 if fits else 0)
    assert [p.neighbour for p in named] == (["two", "one"] if fits else ["", ""])


def test_a_patch_without_faces_is_coupled_to_none():
    named, couplings = interface(sheet(4, facing=-1.0), (sheet(4)[0], (np.empty((0, 3)), np.empty((0, 3)))))
    assert couplings == ()
    assert [p.neighbour for p in named] == ["", ""]


def cyclic(*patches, faces=None):
    n = len(patches)
    faces = [patch()] * n if faces is None else faces
    start = np.cumsum([0, *(len(f[0]) for f in faces)])
    centres, areas = (np.concatenate([f[k] for f in faces]) for k in (0, 1))
    return couple(list(patches), start, centres, areas, (), "the mesh")


@pytest.mark.parametrize(
    ("patches", "message"),
    [
        (
            (Patch("left", "cyclic", "rigth"), Patch("right", "cyclic", "left")),
            r"the mesh: neighbourPatch rigth of the cyclic patch left is not there\. Did you mean 'right'",
        ),
        (
            (Patch("left", "cyclic", "right"), Patch("right", "wall")),
            r"left names right as its neighbour, but right is of type wall with the neighbour \(none\)\.",
        ),
        (
            (Patch("left", "cyclic", "right"), Patch("right", "cyclic", "right")),
            "but right is of type cyclic with the neighbour right",
        ),
        ((Patch("left", "cyclic", "left"),), "left names left as its neighbour"),
        (
            (Patch("left", "cyclic", "right"), Patch("right", "cyclic", "left")),
            r"faces of the cyclic patches left \(9\) and right \(4\) do not fit onto each other",
        ),
    ],
)
def test_patches_that_cannot_be_coupled_are_named(patches, message):
    with pytest.raises(InputError, match=message):
        cyclic(*patches, faces=[patch(), patch(2)][: len(patches)])


def test_several_pairs_of_patches_are_coupled_each_with_its_own(random):
    """A patch between them is none; two pairs of wedges find each other by their shape."""
    shift = np.array([2.0, 0.0, 0.0])
    one, two = patch(), patch(2, 3.0, 0.1)
    turns = [Rotation.from_rotvec(v).as_matrix() for v in ([0.0, 0.0, 0.5], [0.0, 0.3, 0.0])]
    flat = [patch(3, 1.0, 0.0), patch(2, 1.0, 0.0)]
    cyclics = [one, two, patch(1), moved(two, np.eye(3), -shift), moved(one, np.eye(3), shift)]
    faces = [*cyclics, *flat, moved(flat[1], turns[1], NOWHERE), moved(flat[0], turns[0], NOWHERE)]
    patches = (
        Patch("a", "cyclic", "b"), Patch("c", "cyclic", "d"), Patch("wall", "wall"),
        Patch("d", "cyclic", "c"), Patch("b", "cyclic", "a"),
        *(Patch(name, "wedge") for name in "efgh"),
    )  # fmt: skip
    named, couplings = cyclic(*patches, faces=faces)
    assert [p.neighbour for p in named] == ["b", "d", "", "c", "a", "h", "g", "f", "e"]
    assert [(c.patch, c.other) for c in couplings] == [
        (0, 4), (4, 0), (1, 3), (3, 1), (5, 8), (8, 5), (6, 7), (7, 6),
    ]  # fmt: skip
    np.testing.assert_allclose(couplings[0].shift, shift, atol=1e-12)
    np.testing.assert_allclose(couplings[2].shift, -shift, atol=1e-12)
    np.testing.assert_allclose(couplings[4].turn, turns[0], atol=1e-12)
    np.testing.assert_allclose(couplings[6].turn, turns[1], atol=1e-12)
