"""Without compilation the same functions run in the interpreter."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pyvista
from paths import ROOT
from pipe_case import edit
from transient_case import write_transient_case

from foamprb.cli import main


def arrays(case):
    """Positions and arrays of the particles at the last write time."""
    mesh = pyvista.read(sorted((case / "postProcessing/softCloud").glob("*.vtp"))[-1])
    return {"points": np.asarray(mesh.points), **{name: np.asarray(a) for name, a in mesh.point_data.items()}}


def test_run_without_compilation_gives_the_same(tmp_path):
    """`tests/cloud/test_cloud.py` has the scheme of the paper."""
    found = []
    for name in ("compiled", "interpreted"):
        (tmp_path / name).mkdir()
        case = write_transient_case(tmp_path / name)
        edit(case, "endTime 1.2;", "endTime 0.4;")
        if name == "compiled":
            assert main(["run", "-case", str(case), "-threads", "1"]) == 0
        else:
            command = [sys.executable, "-m", "foamprb", "run", "-case", str(case), "-threads", "1"]
            environment = {**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(ROOT)}
            done = subprocess.run(command, env=environment, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
        found.append(arrays(case))
    compiled, interpreted = found
    assert compiled.keys() == interpreted.keys()
    for name, array in compiled.items():
        scale = np.abs(np.nan_to_num(array)).max(initial=0.0)
        np.testing.assert_allclose(interpreted[name], array, rtol=1e-6, atol=1e-9 * scale, err_msg=name)
