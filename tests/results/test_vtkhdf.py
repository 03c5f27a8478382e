"""Files of a cloud over time, as VTK reads them."""

from __future__ import annotations

import numpy as np
import pytest
import pyvista
from vtkmodules.vtkIOHDF import vtkHDFReader

from foamprb.errors import InputError
from foamprb.results.vtk import PointCloud, write_vtkhdf


def test_each_time_has_its_own_cloud_of_its_own_size(tmp_path, random):
    clouds = [
        PointCloud(time, random.random((n, 3)), {"d": random.random(n)})
        for time, n in ((0.5, 2), (1.0, 0), (1.25, 7))
    ]
    write_vtkhdf(tmp_path / "a.vtkhdf", [cloud.time for cloud in clouds], clouds.__getitem__)
    assert [file.name for file in tmp_path.iterdir()] == ["a.vtkhdf"]
    reader = vtkHDFReader()
    reader.SetFileName(str(tmp_path / "a.vtkhdf"))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(reader.GetExecutive().TIME_STEPS())
    assert times == (0.5, 1.0, 1.25)
    for time, cloud in zip(times, clouds, strict=True):
        reader.UpdateTimeStep(time)
        found = pyvista.wrap(reader.GetOutputDataObject(0))
        assert found.n_points == len(cloud.points)
        if len(cloud.points):
            np.testing.assert_array_equal(found.points, cloud.points)
            np.testing.assert_array_equal(found.point_data["d"], cloud.arrays["d"])


def test_failed_write_keeps_the_old_file(tmp_path):
    path = tmp_path / "a.vtkhdf"
    path.write_text("before")

    def cloud(index):
        if index:
            raise InputError("damaged")
        return PointCloud(0.0, np.zeros((2, 3)), {"d": np.ones(2)})

    with pytest.raises(InputError, match="damaged"):
        write_vtkhdf(path, [0.0, 1.0], cloud)
    assert [file.name for file in tmp_path.iterdir()] == ["a.vtkhdf"]
    assert path.read_text() == "before"
    with pytest.raises(OSError, match=r"a\.vtkhdf"):
        write_vtkhdf(tmp_path / "a.vtkhdf/no/b.vtkhdf", [0.0], cloud)
    assert [file.name for file in tmp_path.iterdir()] == ["a.vtkhdf"]
