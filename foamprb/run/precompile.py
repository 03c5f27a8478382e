"""Compilation before the first run: one step of a small case in each kind of flow and fluid."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.viscosity import RATE_LAWS
from foamprb.compile.cache import cache_directory
from foamprb.run.job import prepare
from foamprb.run.loop import execute
from foamprb.run.template import write_template

log = logging.getLogger("foamprb")

_FILES = {
    "system/controlDict": ("dictionary", "deltaT 1e-3;"),
    "constant/polyMesh/points": (
        "vectorField",
        "12((0 0 0) (1 0 0) (2 0 0) (0 1 0) (1 1 0) (2 1 0) (0 0 1) (1 0 1) (2 0 1) (0 1 1) (1 1 1) (2 1 1))",
    ),
    "constant/polyMesh/faces": (
        "faceList",
        "11(4(1 4 10 7) 4(0 6 9 3) 4(2 5 11 8) 4(3 9 10 4) 4(4 10 11 5) 4(0 3 4 1) 4(1 4 5 2) 4(6 7 10 9) "
        "4(7 8 11 10) 4(0 1 7 6) 4(1 2 8 7))",
    ),
    "constant/polyMesh/owner": ("labelList", "11(0 0 1 0 1 0 1 0 1 0 1)"),
    "constant/polyMesh/neighbour": ("labelList", "1(1)"),
    "constant/polyMesh/boundary": (
        "polyBoundaryMesh",
        "3(inlet { type patch; nFaces 1; startFace 1; } outlet { type patch; nFaces 7; startFace 2; } "
        "wall { type wall; nFaces 2; startFace 9; })",
    ),
    "constant/polyMesh/cellZones": (
        "regIOobject",
        "1(rotor { type cellZone; cellLabels List<label> 1(0); })",
    ),
}
RUNS = [
    *product(("Newtonian",), ("steady", "transient"), INTEGRATORS),
    ("Newtonian", "rotating", "stokes"),
    *product(RATE_LAWS, ("steady", "transient"), ("stokes", "rosenbrock")),
]
"""Fluid, flow and integrator of each run."""
_STABLE = 1e-9
"""Step in which the paper's integrator is stable, s."""
_VELOCITY = (
    "dimensions [0 1 -1 0 0 0 0]; internalField nonuniform List<vector> 2((1 0 0) (0.5 0 0)); "
    'boundaryField { "(inlet|outlet)" { type zeroGradient; } wall { type noSlip; } }'
)
_ROTATION = "rotor { cellZone rotor; active yes; origin (0 0 0); axis (0 0 1); omega 1; }"
_COEFFICIENTS = "nu0 1e-5; nuInf 1e-6; nuMin 1e-6; nuMax 1e-5; tau0 1e-6; k 1e-5; m 1e-5; n 0.8;"


def compile_all() -> None:
    """Compile the code of runs with the settings that ``foamprb init`` writes.

    That is for steady, transient and rotating flows, and for fluids with each law of the shear rate. The
    paper's integrator is compiled for Newtonian fluids only.
    """
    with TemporaryDirectory() as folder:
        for fluid, kind, scheme in RUNS:
            log.info("Compiling integrationScheme %s for %s flows of %s fluids", scheme, kind, fluid)
            case, dt = Path(folder) / f"{fluid}-{kind}", _STABLE if scheme == "paper" else 1e-3
            entries = {
                "solution/transient": kind == "transient",
                "solution/deltaT": dt,
                "solution/endTime": dt,
                "solution/integrationSchemes": {"shape": scheme},
            }
            with _silence():
                if not case.exists():
                    _write_case(case, fluid, rotating=kind == "rotating")
                    write_template(case)
                job = prepare(case, overrides=entries)
                job.cloud.flow.locate(np.ones((1, 3)))
                execute(job, "startTime")
    log.info("The code is kept in %s", cache_directory())


def _write_case(case: Path, fluid: str, rotating: bool) -> None:
    """Write a case of two cells with a velocity at two times."""
    files = _FILES | {f"{time}/U": ("volVectorField", _VELOCITY) for time in (0, 1)}
    text = f"transportModel {fluid}; nu 1e-5; rho 1000; {fluid}Coeffs {{ {_COEFFICIENTS} }}"
    files["constant/transportProperties"] = "dictionary", text
    if rotating:
        files["constant/MRFProperties"] = "dictionary", _ROTATION
    for name, (kind, text) in files.items():
        path = case / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(
            f"FoamFile {{ version 2.0; format ascii; class {kind}; object {path.name}; }}\n{text}\n"
        )


@contextmanager
def _silence() -> Iterator[None]:
    """Log nothing."""
    log.disabled = True
    try:
        yield
    finally:
        log.disabled = False
