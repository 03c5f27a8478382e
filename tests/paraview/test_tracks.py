"""The tracks of a cloud function, as ParaView reads them."""

from __future__ import annotations

import json
import shutil
import subprocess

import numpy as np
import pytest

from foamprb.results.vtk import Tracks, write_tracks

pytestmark = [
    pytest.mark.paraview,
    pytest.mark.skipif(shutil.which("pvpython") is None, reason="pvpython is not on PATH"),
]

SCRIPT = """
import json, sys
from paraview.simple import XMLPolyDataReader
from paraview.servermanager import Fetch
data = Fetch(XMLPolyDataReader(FileName=[sys.argv[1]]))
lines = [data.GetCell(i) for i in range(data.GetNumberOfCells())]
print(json.dumps({
    "sizes": [line.GetNumberOfPoints() for line in lines],
    "kinds": sorted({line.GetClassName() for line in lines}),
    "last": data.GetPoint(data.GetCell(1).GetPointId(2)),
    "time": [data.GetPointData().GetArray("time").GetValue(i) for i in range(data.GetNumberOfPoints())],
    "id": [data.GetCellData().GetArray("origId").GetValue(i) for i in range(data.GetNumberOfCells())],
}))
"""


def test_paraview_reads_polylines_with_their_arrays(tmp_path):
    points = np.arange(15.0).reshape(5, 3)
    tracks = Tracks(
        points, np.array([0, 2, 5]), {"time": np.linspace(0.0, 1.0, 5)}, {"origId": np.array([7, 9])}
    )
    write_tracks(tmp_path / "tracks.vtp", tracks)
    script = tmp_path / "read.py"
    script.write_text(SCRIPT)
    done = subprocess.run(
        ["pvpython", script, tmp_path / "tracks.vtp"], capture_output=True, text=True, check=True
    )
    found = json.loads(done.stdout.strip().splitlines()[-1])
    assert found["sizes"] == [2, 3]
    assert found["kinds"] == ["vtkLine", "vtkPolyLine"]
    assert found["last"] == [12.0, 13.0, 14.0]
    assert found["time"] == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert found["id"] == [7, 9]
