"""What a whole run needs of memory for each particle."""

from __future__ import annotations

import math
import os
import subprocess
import sys

import numpy as np
from paths import ROOT
from pipe_case import copy_of_pipe, edit

from foamprb.cloud.state import VARIABLES

FEW, MANY = 50_000, 150_000
UNTOUCHED = sum(math.prod(v.shape) * np.dtype(v.dtype).itemsize for v in VARIABLES.values() if v.optional)
STATE, MOST = 470.0, 988.0
"""Bytes per particle of the state, and with the copy that is being written, which has 454; without the
optional arrays, of which no page is touched."""

SCRIPT = """
import sys, tracemalloc
from foamprb import execute, prepare
from foamprb.run.log import log_description

def peak_of_run(case):
    tracemalloc.reset_peak()
    job = prepare(case, threads=1)
    log_description(job)
    execute(job, "startTime")
    return tracemalloc.get_traced_memory()[1]

first, few, many = sys.argv[1:]
# It also loads and compiles.
peak_of_run(first)
tracemalloc.start()
print(peak_of_run(many) - peak_of_run(few))
"""


def test_a_run_needs_less_than_a_kilobyte_per_particle(tmp_path):
    """Of all arrays at the peak; what a process has resident varies with the heap by 200 bytes."""
    cases = []
    for n in (1000, FEW, MANY):
        (tmp_path / str(n)).mkdir()
        case = copy_of_pipe(tmp_path / str(n))
        # All are in the flow when the last of three clouds is written.
        edit(case, r"endTime\s+\S+;", "endTime 1.2e-4;")
        edit(case, r"writeInterval\s+\S+;", "writeInterval 4e-5;")
        edit(case, r"duration\s+\S+;", "duration 5e-5;")
        edit(case, r"parcelsPerSecond\s+\S+;", f"parcelsPerSecond {n / 5e-5:g};")
        cases.append(str(case))
    path = os.pathsep.join([str(ROOT), *sys.path])
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, *cases],
        capture_output=True, text=True, check=True, env={**os.environ, "PYTHONPATH": path},
    )  # fmt: skip
    taken = float(done.stdout.splitlines()[-1]) / (MANY - FEW) - UNTOUCHED
    assert STATE < taken < MOST
