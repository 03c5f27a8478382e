"""Images of walls beyond coupled patches: those within reach, and no others."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import cyclic_row

from foamprb.flow.walls import Walls, images_of_walls


def small_wall(place):
    """One small triangle at a place."""
    corners = np.add(place, [[[0.0, 0.0, 0.0], [1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0]]])
    return Walls(corners, np.array([[0.0, 0.0, 1.0]]), np.array([2], dtype=np.int32))


@pytest.mark.parametrize(
    ("place", "seen"),
    [
        # A period is 1 along x; within a tenth of the left patch a wall is seen beyond the right one.
        ((0.05, 0.5, 0.5), (1.05, 0.5, 0.5)),
        ((0.95, 0.5, 0.5), (-0.05, 0.5, 0.5)),
        # Above the patch, by less than the reach and by more.
        ((0.05, 0.5, 1.05), (1.05, 0.5, 1.05)),
        ((0.05, 0.5, 1.2), None),
        ((0.05, 1.05, 0.5), (1.05, 1.05, 0.5)),
        ((0.05, 1.2, 0.5), None),
        ((0.05, -0.2, 0.5), None),
        ((0.5, 0.5, 0.5), None),
    ],
)
def test_walls_near_a_coupled_patch_are_seen_beyond_its_neighbour(place, seen):
    images = images_of_walls(cyclic_row(0.0, 1), small_wall(place), 0.1)
    assert len(images.corners) == (0 if seen is None else 1)
    if seen is not None:
        np.testing.assert_allclose(images.corners[0, 0], seen, atol=1e-9)
        np.testing.assert_array_equal(images.normals, [[0.0, 0.0, 1.0]])
