"""Own reader of clouds and tracks: the same numbers as by VTK, of any data."""

from __future__ import annotations

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from foamprb.results.vtk import Parts, PointCloud, Tracks, write_snapshot, write_tracks
from foamprb.view.vtk_read import read_own


@pytest.mark.parametrize("n", [0, 1, 12, 40_000])
def test_a_cloud_is_as_vtk_reads_it(n, tmp_path):
    """Random numbers hardly compress, constants to almost nothing; in two pieces and several blocks."""
    random = np.random.default_rng(n)
    points = random.random((n, 3))
    points[n // 4 : n // 3] = np.nan
    arrays = {"d": np.full(n, 1e-5, np.float32), "glyph": random.random((n, 9)), "origId": np.arange(n)}
    cloud = PointCloud(0.5, points, arrays, {"d": "m"}, {"status": ("a", "ä b")})
    file = tmp_path / "cloud.vtp"
    write_snapshot(file, Parts(0.5, 2, iter([cloud, cloud])))
    own = read_own(file)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    np.testing.assert_array_equal(own.points, np.concatenate([points, points]))
    for name in arrays:
        np.testing.assert_array_equal(own.arrays[name], np.concatenate([arrays[name]] * 2))
        np.testing.assert_array_equal(own.arrays[name], vtk_to_numpy(data.GetArray(name)))
    assert own.texts == {"units": ("d m",), "statusNames": ("a", "ä b")}
    assert [*read_own(file, ("d",)).arrays] == ["d"]


def test_tracks_are_those_that_were_written(tmp_path):
    tracks = Tracks(np.random.default_rng(1).random((5, 3)), np.array([0, 2, 5]), {"time": np.arange(5.0)},
                    {"origId": np.arange(2)})  # fmt: skip
    write_tracks(tmp_path / "tracks.vtp", tracks)
    own = read_own(tmp_path / "tracks.vtp")
    np.testing.assert_array_equal(own.points[own.order], tracks.points)
    np.testing.assert_array_equal(own.start, tracks.start)
    np.testing.assert_array_equal(own.of_lines["origId"], [0, 1])
