"""Rigid particles in OpenFOAM's elbow go where OpenFOAM takes them, the more so the finer the mesh."""

from __future__ import annotations

import numpy as np
import pytest
from figures import elbow

pytestmark = pytest.mark.openfoam


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Ours and OpenFOAM's on each of two meshes."""
    if not elbow.TUTORIAL.exists():
        pytest.skip("OpenFOAM's tutorials are not here")
    cases = elbow.solve(tmp_path_factory.mktemp("elbow"), 2)
    return [
        (elbow.foamprb(case, level, 0.1), elbow.openfoam(case, level, "cellPoint", 0.02))
        for level, case in enumerate(cases)
    ]


def test_programs_converge_to_the_same_places(runs):
    """On the coarse mesh cellPoint, linear between the nodes, is farther from them than foamprb."""
    (ours, theirs), (our_best, their_best) = runs
    coarse = np.median(elbow.distances(ours, theirs))
    fine = np.median(elbow.distances(our_best, their_best))
    our_error, their_error = (
        np.median(elbow.distances(*pair)) for pair in ((ours, their_best), (theirs, our_best))
    )
    assert fine < 0.3 * coarse
    assert our_error < 0.5 * their_error
    # Of 64 m.
    assert fine < 0.25


def test_fates_are_alike(runs):
    n = runs[0][0].places.shape[1]
    assert n == 60
    for pair in runs:
        assert elbow.fates(*pair) >= n - 2


def test_the_mean_of_the_cells_on_the_finer_mesh_is_that_of_the_cell():
    """A flow that is linear has its value at the centre as mean over a triangle."""
    plane = elbow.Plane(
        np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.5]]),
        np.array([[0, 1, 2], [0, 2, 3]]),
        {"wall": np.array([[0, 1], [1, 2]])},
        (0.0, 1.0),
    )
    fine = plane.refined()
    areas = elbow.area(fine.points, fine.triangles)
    assert areas.min() > 0.0
    np.testing.assert_allclose(areas.reshape(-1, 4), elbow.area(*plane[:2])[:, None].repeat(4, 1) / 4.0)
    np.testing.assert_allclose(fine.centres.reshape(-1, 4, 2).mean(axis=1), plane.centres)
    assert len(fine.edges["wall"]) == 4
    assert np.linalg.norm(np.diff(fine.points[fine.edges["wall"]], axis=1), axis=2).sum() == 3.0
