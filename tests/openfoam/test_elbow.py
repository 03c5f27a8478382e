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
    (ours, _), (our_best, their_best) = runs
    # On the coarse mesh OpenFOAM's differ from its own on the fine one for 3.
    for run in (ours, our_best):
        assert elbow.fates(run, their_best) >= n - 2
