"""A series of which some times are in pieces, as ParaView reads it."""

from __future__ import annotations

import json
import shutil
import subprocess

import pytest
from clouds import cloud, in_parts

from foamprb.results.folder import ResultsFolder
from foamprb.results.pvd import Series
from foamprb.results.vtk import layout, write_pieces, write_snapshot

pytestmark = [
    pytest.mark.paraview,
    pytest.mark.skipif(shutil.which("pvpython") is None, reason="pvpython is not on PATH"),
]

SCRIPT = """
import json, sys
from paraview.simple import PVDReader
from paraview.servermanager import Fetch
reader, found = PVDReader(FileName=sys.argv[1]), []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    data = Fetch(reader)
    names = data.GetFieldData().GetAbstractArray("statusNames")
    found.append([time, data.GetClassName(), data.GetNumberOfVerts(), data.GetPoint(3),
                  data.GetPointData().GetArray("deformationGradient").GetTuple(3), names.GetValue(1)])
print(json.dumps(found))
"""


def test_paraview_reads_a_series_with_and_without_pieces(tmp_path):
    series = Series(ResultsFolder(tmp_path, "cloud"))
    series.append(in_parts(cloud(0.1, 6), (2, 4)))
    stem = series.next(0.2)
    pieces = [stem / f"{i}.vtp" for i in range(3)]
    for piece, n in zip(pieces, (3, 0, 3), strict=True):
        write_snapshot(piece, cloud(0.2, n))
    write_pieces(stem.with_suffix(".pvtp"), layout(cloud()), pieces)
    series.add(0.2, stem.with_suffix(".pvtp"))
    script = tmp_path / "read.py"
    script.write_text(SCRIPT)
    done = subprocess.run(["pvpython", script, series.folder.pvd], capture_output=True, text=True, check=True)
    found = json.loads(done.stdout.strip().splitlines()[-1])
    for (time, kind, n, point, F, name), expected, row in zip(
        found, (cloud(0.1, 6), cloud(0.2, 3)), (3, 0), strict=True
    ):
        assert (time, kind, n, name) == (expected.time, "vtkPolyData", 6, "active")
        assert point == expected.points[row].tolist()
        assert expected.arrays["deformationGradient"][row].tolist() == F
