"""Outlines of ellipsoids, against shadows that are drawn point by point."""

from __future__ import annotations

import numpy as np
import pytest
from observing import MEAN, RADIUS, WATER, column, observe, pipe_cloud, table
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from foamprb.cloudfunctions.deformability_cytometry import DeformabilityCytometry, outline
from foamprb.errors import InputError


def test_an_outline_is_that_of_the_points_of_the_surface():
    random = np.random.default_rng(3)
    unit = random.standard_normal((400_000, 3))
    unit /= np.linalg.norm(unit, axis=1)[:, None]
    axes, turn = np.array([3.0, 2.0, 0.7]), Rotation.from_rotvec([0.3, -1.1, 0.6]).as_matrix()
    F = turn * axes
    view = np.array([0.2, -0.5, 0.6]) / np.linalg.norm([0.2, -0.5, 0.6])
    flat = np.linalg.svd(view[None])[2][1:]
    hull = ConvexHull(unit @ F.T @ flat.T)
    found = outline((F @ F.T)[None], view)
    # Of a polygon, in two dimensions the hull's volume is its area, and its area its perimeter.
    assert found.area[0] == pytest.approx(hull.volume, rel=1e-3)
    assert found.perimeter[0] == pytest.approx(hull.area, rel=1e-3)


def test_a_sphere_has_no_deformation_and_an_ellipse_that_of_its_axes():
    found = outline(np.array([np.eye(3), np.diag([4.0, 1.0, 9.0])]), np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(found.area, [np.pi, 2.0 * np.pi])
    np.testing.assert_allclose(found.semi_axes, [[1.0, 1.0], [2.0, 1.0]])
    # Ramanujan's second formula for the perimeter, exact to 1e-6 here.
    h = (1.0 / 3.0) ** 2
    perimeter = np.pi * 3.0 * (1.0 + 3.0 * h / (10.0 + np.sqrt(4.0 - 3.0 * h)))
    expected = [0.0, 1.0 - 2.0 * np.sqrt(2.0) * np.pi / perimeter]
    np.testing.assert_allclose(found.deformation, expected, atol=1e-6)


def test_particles_are_seen_where_and_when_they_cross(tmp_path):
    cloud = pipe_cloud(medium=WATER)
    p, start = cloud.particles, cloud.particles.x[:, 0].copy()
    r = np.hypot(p.x[:, 1], p.x[:, 2])
    speed = 2.0 * MEAN * (1.0 - (r / RADIUS) ** 2)
    plane = DeformabilityCytometry(origin=(0.01, 0, 0), normal=(2, 0, 0), view=(0, 0, 1))
    observe(cloud, plane, tmp_path)
    rows = table(tmp_path / "f/cytometry.csv")
    ids = column(rows, "id").astype(int)
    assert len(ids) > 20
    np.testing.assert_allclose(column(rows, "t"), p.t0[ids] + (0.01 - start[ids]) / speed[ids], rtol=1e-4)
    np.testing.assert_allclose(column(rows, "x"), 0.01, rtol=1e-9)
    assert (column(rows, "direction") == 1).all()
    deformation = column(rows, "deformation")
    assert (deformation >= -1e-12).all()
    assert deformation.max() > 0.001
    # Taken along the view, none has more than the area of the longest and the middle axis.
    assert (column(rows, "area") < np.pi * p.R[ids] ** 2 * 2.0).all()


def test_directions_of_no_length_are_refused():
    with pytest.raises(InputError, match=r"has a view \(0 0 0\)"):
        DeformabilityCytometry(origin=(0, 0, 0), normal=(1, 0, 0), view=(0, 0, 0))
