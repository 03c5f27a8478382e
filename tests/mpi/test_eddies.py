"""Eddies on several processes: those of one."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

import pytest
from paths import ROOT
from pipe_case import fates, with_eddies

from foamprb.cli import main

pytestmark = [
    pytest.mark.mpi,
    pytest.mark.skipif(shutil.which("mpirun") is None, reason="mpirun is not on PATH"),
]
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path]),
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
}


def test_eddies_are_the_same_on_several_processes(tmp_path):
    case = with_eddies(tmp_path)
    assert main(["run", "-case", str(case)]) == 0
    expected = fates(case)
    words = ["run", "-case", str(case), "-parallel", "-overwrite"]
    command = ["mpirun", "-np", "3", sys.executable, "-m", "foamprb", *words]
    done = subprocess.run(command, capture_output=True, text=True, env=ENVIRONMENT, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    assert fates(case) == expected
