"""Triangles across interfaces whose faces do not match."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import interfaces, joined_boxes

from foamprb.flow.mesh.interfaces import face_pairs, overlaps, pairs_within


def test_pairs_of_spheres_are_those_that_meet(random):
    """Of sizes over several octaves, and touching ones."""
    middle, others = random.random((60, 3)), random.random((80, 3))
    radius, reach = 0.3 * random.random(60) ** 4, 0.3 * random.random(80) ** 4
    middle[0], others[0], radius[0], reach[0] = 0.0, (0.5, 0.0, 0.0), 0.125, 0.125
    apart = np.linalg.norm(middle[:, None] - others, axis=2)
    expected = apart <= 2.0 * (radius[:, None] + reach)
    assert expected[0, 0]
    rows, columns = pairs_within(middle, radius, others, reach, 2.0)
    found = np.zeros_like(expected)
    found[rows, columns] = True
    assert len(rows) == expected.sum()
    np.testing.assert_array_equal(found, expected)


def test_unequal_faces_share_the_areas_that_lie_on_each_other():
    """Squares of a quarter and a third: along each axis the parts are those of two rulers."""
    mesh = joined_boxes([4, 3], [("cyclicAMI", 0, 0, 1)])
    pairs, n = face_pairs(mesh), len(mesh.boundary_centres)
    shared = np.zeros((n, n))
    shared[pairs.faces, pairs.others] = pairs.parts
    here, there = mesh.couplings[0].faces, mesh.couplings[0].partners
    others = np.unique(mesh.couplings[1].faces)
    assert set(there) <= set(others)
    length = np.ones((len(here), len(others)))
    for axis in (1, 2):
        one, other = (mesh.boundary_centres[faces, axis] for faces in (here, others))
        low = np.maximum.outer(one - 1.0 / 8.0, other - 1.0 / 6.0)
        high = np.minimum.outer(one + 1.0 / 8.0, other + 1.0 / 6.0)
        length *= np.maximum(high - low, 0.0)
    assert shared[np.ix_(here, others)] == pytest.approx(length * 16.0, abs=1e-9)
    assert shared[np.ix_(others, here)] == pytest.approx(length.T * 9.0, abs=1e-9)


def test_a_triangle_lists_those_of_the_partner_of_its_face_though_they_are_far():
    mesh = interfaces(0.0, cuts=(2, 3, 2))[0]
    coupling = mesh.couplings[0]
    triangles, start, others = overlaps(mesh, coupling)
    # Farther than any overlap: the partner of the first face is that of the last.
    moved = coupling.partners.copy()
    moved[0] = coupling.partners[-1]
    _, begin, further = overlaps(mesh, coupling._replace(partners=moved))
    far = np.flatnonzero(mesh.triangle_face == moved[0])
    for k, triangle in enumerate(triangles):
        before, after = others[start[k] : start[k + 1]], further[begin[k] : begin[k + 1]]
        if mesh.triangle_face[triangle] == coupling.faces[0]:
            np.testing.assert_array_equal(after, np.union1d(before, far))
            assert len(after) > len(before)
        else:
            np.testing.assert_array_equal(after, before)
