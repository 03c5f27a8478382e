"""Tracks lead from release to end through the sampled points."""

from __future__ import annotations

import numpy as np
import pyvista
from observing import RADIUS, observe, observed, pipe_cloud

from foamprb.cloud.state import Status
from foamprb.cloudfunctions.particle_tracks import ParticleTracks
from foamprb.cloudfunctions.registry import CloudFunctions


def test_paths_lead_from_release_to_end_through_the_looks(tmp_path):
    cloud = pipe_cloud()
    n = cloud.particles.size
    recorded = [[(*x, t)] for x, t in zip(cloud.particles.x0, cloud.particles.t0, strict=True)]
    reference = pipe_cloud()
    for _ in range(0, 700, 50):
        reference.advance(50)
        p = reference.particles
        for k in np.flatnonzero(p.status != Status.PENDING):
            if p.t[k] > recorded[k][-1][3]:
                recorded[k].append((*p.x[k], p.t[k]))
    observe(cloud, ParticleTracks(50, 1000), tmp_path)
    tracks = pyvista.read(tmp_path / "f/tracks.vtp")
    assert tracks.n_lines == n
    np.testing.assert_array_equal(tracks.cell_data["origId"], np.arange(n))
    np.testing.assert_array_equal(tracks.cell_data["status"], cloud.particles.status)
    assert set(cloud.particles.status) == {Status.STUCK, Status.ESCAPED}
    at = 0
    for k, path in enumerate(recorded):
        assert tracks.lines[at] == len(path)
        ids = tracks.lines[at + 1 : at + 1 + len(path)]
        at += 1 + len(path)
        # The reference ends its steps at the points.
        np.testing.assert_allclose(tracks.points[ids], np.array(path)[:, :3], atol=1e-3 * RADIUS)
        np.testing.assert_allclose(tracks.point_data["time"][ids], np.array(path)[:, 3], rtol=1e-3)
        np.testing.assert_array_equal(tracks.points[ids[-1]], cloud.particles.x[k])
    axes = tracks.point_data["semiAxes"]
    D_found = (axes[:, 0] - axes[:, 2]) / (axes[:, 0] + axes[:, 2])
    np.testing.assert_allclose(tracks.point_data["taylorDeformation"], D_found, atol=1e-14)
    assert list(tracks.field_data["injectorNames"]) == ["one", "two"]


def test_samples_and_tracks_have_their_limits(tmp_path):
    cloud = pipe_cloud()
    observe(cloud, ParticleTracks(1, maxSamples=21, maxTracks=8), tmp_path)
    tracks = pyvista.read(tmp_path / "f/tracks.vtp")
    np.testing.assert_array_equal(tracks.cell_data["origId"], np.arange(0, 40, 5))
    assert tracks.n_points == 8 * 21


def test_what_has_not_moved_has_no_path(tmp_path):
    cloud = pipe_cloud()
    functions = CloudFunctions({"f": ParticleTracks(10, 21)}, observed(cloud))
    functions.write(tmp_path)
    assert pyvista.read(tmp_path / "f/tracks.vtp").n_points == 0
