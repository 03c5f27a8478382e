"""What a user's run costs: ``foamprb run`` with its default settings, against OpenFOAM's rigid point spheres.

Automatic integrator, error control, touching ellipsoids, checkpoints, particles up to the wall. Two runs that
differ in length only are subtracted, so that start, injection and output fall away.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, isolated, rows
from benchmarks.report import WORST_DEFAULT
from benchmarks.tracker import OPENFOAM_STEP, SOLVER, openfoam_cost

CAPILLARY_NUMBERS = (0.01, 0.5, 2.0)
"""At the wall."""
SHORT = "Ca 0.5, maxDeltaT = deltaT"
"""A run that is not the default: none of its steps is longer than OpenFOAM's."""
REACH = 0.985
"""Largest distance of a particle from the axis, in radii of the pipe."""
_WARM_UP = 5


def run(case: str, dictionary: str) -> dict[str, Any]:
    """Run a cloud on one thread; return how many particle-steps it did."""
    from foamprb import execute, prepare

    job = prepare(case, dictionary=Path(dictionary), threads=1)
    execute(job, "startTime")
    return {"particle-steps": pipe.particle_steps(job.cloud)}


def cost(case: Path, steps: int, write: Callable[[int], Path]) -> float:
    """Microseconds of CPU per particle-step; ``write`` writes the properties of a cloud for so many steps."""
    spent = []
    for count in (_WARM_UP, _WARM_UP + steps):
        child = isolated(run, str(case), str(write(count)))
        spent.append((child.cpu, child.result["particle-steps"]))
    return 1e6 * (spent[1][0] - spent[0][0]) / (spent[1][1] - spent[0][1])


def measure(options: Options) -> list[Row]:
    """Cost per particle-step by stiffness, and over OpenFOAM's at the same Δt."""
    n, steps, repeats = (10_000, 40, 2) if options.quick else (100_000, 100, 7)
    case = pipe.case("40k")
    x = pipe.positions(n, reach=REACH)
    pipe.write_positions(case / "constant" / "softCloudPositions", x)

    def ours(Ca: float, more: str = "") -> float:
        write = partial(pipe.write_default_cloud, case, Ca=Ca, dt=OPENFOAM_STEP, more=more)
        return cost(case, steps, lambda count: write(f"soft{count}", steps=count))

    contestants = {f"Ca {Ca:g}": partial(ours, Ca) for Ca in CAPILLARY_NUMBERS}
    contestants[SHORT] = lambda: ours(0.5, f"maxDeltaT {OPENFOAM_STEP:g};")
    if shutil.which(SOLVER):
        pipe.write_parcels(case, x)
        contestants["OpenFOAM"] = lambda: openfoam_cost(case, n, steps)
    costs = interleaved(contestants, repeats)
    found = rows("whole", "cost of a default run", costs, "us/particle-step", n)
    if "OpenFOAM" in costs:
        ratios = {name: value / costs["OpenFOAM"] for name, value in costs.items() if name != "OpenFOAM"}
        found += rows("whole", "default run over OpenFOAM's", ratios, "")
        worst = max(ratio for name, ratio in ratios.items() if name != SHORT)
        found += rows("whole", WORST_DEFAULT, {"": worst}, "")
    return found
