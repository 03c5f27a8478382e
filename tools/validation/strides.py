"""Steps longer than a tracking step, the default of a run."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Floats, Outcome, Row
from validation.references.shear import SHEAR, inertialess_history
from validation.runs import (
    advance_to,
    pipe_cloud,
    soft_in_pipe,
    unit_cloud,
)

CAPILLARY = (0.01, 0.5, 2.0)
_PIPE_STEP, _PIPE_END = 1e-4, 0.01
_SHEAR_STEP, _SHEAR_END = 0.02, 10.0
_ALLOWED = 0.1
"""Of tolerance × steps, which is a bound: bodies forget what single steps were off by."""


def _rows(cloud: Cloud, F: Floats, end: float, where: str) -> list[Row]:
    """Advance one body to ``end``, s, and compare its F with that of the reference, (3, 3)."""
    advance_to(cloud, end)
    p, tolerance = cloud.particles, cloud.models.tolerance
    where = f"{where}, {'any steps' if cloud.models.stride is None else 'steps up to Δt'}"
    taken = float(p.substeps[0])
    error = float(np.linalg.norm(p.F[0] - F.ravel()) / np.linalg.norm(F))
    bound = tolerance * taken * end / cloud.dt
    return [
        Row(f"{where}: error of F", error, 0.0, "solve_ivp", _ALLOWED * bound),
        Row(f"{where}: steps per Δt at the end", taken, None, ""),
    ]


def strides(quick: bool) -> Outcome:
    """Steps longer than Δt."""
    rows: list[Row] = []
    for Ca in CAPILLARY[1:2] if quick else CAPILLARY:
        reference = inertialess_history(SHEAR, Ca, np.array([_SHEAR_END]))[-1]
        for stride in (1, None):
            models = Models(integrator="stokes", stride=stride)
            shear = unit_cloud(analytic.shear(1.0), Ca, 1e-6, _SHEAR_STEP, models)
            rows += _rows(shear, reference, _SHEAR_END, f"stokes, shear, Ca = {Ca:g}")
    for Ca in CAPILLARY[1:2] if quick else CAPILLARY:
        reference = soft_in_pipe(Ca, np.array([0.0, _PIPE_END])).F[-1]
        for stride in (1, None):
            pipe = pipe_cloud(Ca, _PIPE_STEP, Models(integrator="rosenbrock", stride=stride))
            rows += _rows(pipe, reference, _PIPE_END, f"rosenbrock, pipe, Ca = {Ca:g}")
    return Outcome(rows, [], [])
