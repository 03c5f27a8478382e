"""Clouds in OpenFOAM's own files, read back by ParaView's reader."""

from __future__ import annotations

import json
import shutil
import subprocess

import numpy as np
import pytest
from view_run import motion, write_run

import foamprb
from foamprb.cli import main

pytestmark = [
    pytest.mark.paraview,
    pytest.mark.skipif(shutil.which("pvpython") is None, reason="pvpython is not on PATH"),
]

SCRIPT = """
import json, sys
from paraview import simple, servermanager
from vtkmodules.numpy_interface import dataset_adapter as dsa
reader = simple.OpenFOAMReader(FileName=sys.argv[1])
reader.MeshRegions = ["lagrangian/softCloud"]
reader.UpdatePipelineInformation()
out = []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    found = servermanager.Fetch(simple.MergeBlocks(Input=reader, OutputDataSetType="Polygonal Mesh"), idx=0)
    data = dsa.WrapDataObject(found)
    out.append([time, data.Points.tolist(), data.PointData["U"].tolist(), data.PointData["d"].tolist()])
print("RESULT" + json.dumps(out))
"""


def test_paraviews_reader_gives_the_cloud_back(tmp_path):
    write_run(tmp_path, motion(20, 4))
    assert main(["export", "openfoam", "-case", str(tmp_path)]) == 0
    run = foamprb.open_run(tmp_path)
    (tmp_path / "read.py").write_text(SCRIPT)
    done = subprocess.run(
        ["pvpython", str(tmp_path / "read.py"), str(run.folder / "openfoam/softCloud.foam")],
        capture_output=True, text=True, timeout=240, check=False,
    )  # fmt: skip
    assert "RESULT" in done.stdout, done.stderr
    times = json.loads(done.stdout.split("RESULT")[1])
    # A time 0 without fields is not in its list.
    assert [time[0] for time in times] == pytest.approx(run.times[1:])
    for time, points, U, d in times:
        cloud = run.snapshot(time)
        here = cloud["status"] <= 2
        # The reader has single precision.
        np.testing.assert_allclose(points, cloud.points[here], rtol=0, atol=1e-6)
        np.testing.assert_allclose(U, cloud["U"][here], rtol=1e-6, atol=1e-7)
        np.testing.assert_allclose(d, cloud["d"][here], rtol=1e-6)
