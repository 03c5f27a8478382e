"""Cost of a particle (Appendix F)."""

from __future__ import annotations

import time

import numpy as np

from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.tracker import Models
from validation.case import Outcome, Row
from validation.runs import pipe_cloud

PAPER = 3e-4
APPENDIX = "the paper, Appendix F"
TABLE = {"sphere, 3206 elements": 56.0, "3:1, 3254 elements": 70.0, "4:2, 3998 elements": 120.0}
"""Table F.1: seconds of one boundary-element solution of the traction."""


def cost(quick: bool) -> Outcome:
    """Cost per particle-step."""
    n, steps = (320, 100) if quick else (3200, 500)
    rows = []
    for name in INTEGRATORS:
        cloud = pipe_cloud(np.linspace(0.1, 0.8, n), 1e-5, Models(integrator=name))
        cloud.threads = 1
        cloud.advance(2)
        start = time.perf_counter()
        cloud.advance(steps)
        spent = (time.perf_counter() - start) / (n * steps)
        note = f"ours is {PAPER / spent:.0f} times cheaper, on one core"
        rows.append(
            Row(f"{name}: time per particle and step [s]", spent, PAPER, APPENDIX, note=note, kind="others")
        )
        if name == "paper":
            rows += [
                Row(
                    f"{name}: time per particle and step [s]",
                    spent,
                    seconds,
                    f"Table F.1: {body}",
                    kind="others",
                    note=f"ours is {seconds / spent:.1e} times cheaper",
                )
                for body, seconds in TABLE.items()
            ]
    remarks = ["Times are those of the machine of this report, for information only."]
    return Outcome(rows, [], remarks)
