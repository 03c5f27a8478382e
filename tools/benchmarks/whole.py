"""Cost of ``foamprb run`` with default settings, against OpenFOAM's rigid point spheres.

Automatic integrator, error control, touching ellipsoids, checkpoints, particles up to the wall. Runs that
differ in length only are subtracted, so that start, injection and output fall away.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, isolated, rows
from benchmarks.report import WORST_DEFAULT
from benchmarks.tracker import ENOUGH, OPENFOAM_STEP, SOLVER, openfoam_cost

CAPILLARY_NUMBERS = (0.01, 0.5, 2.0)
"""At the wall."""
FLUIDS = {"": pipe.AIR, ", water": pipe.WATER}
"""By what the rows add to Ca."""
SHORT = "Ca 0.5, maxDeltaT = deltaT"
"""A run that is not the default: none of its steps is longer than OpenFOAM's."""
TRANSIENT, _EACH = "Ca 0.5, transient", 20
"""A run in air whose flow, the same at all times, is read and made ready anew each so many Δt."""
REACH = 0.985
"""Largest distance of a particle from the axis, in radii of the pipe."""
_WARM_UP = 5


def run(case: str, dictionary: str) -> dict[str, Any]:
    """Run a cloud on one thread; return how many particle-steps it did."""
    from foamprb import execute, prepare

    job = prepare(case, dictionary=Path(dictionary), threads=1)
    execute(job, "startTime")
    return {"particle-steps": pipe.particle_steps(job.cloud)}


def costs(case: Path, lengths: tuple[int, ...], write: Callable[[int], Path]) -> list[float]:
    """Measure CPU µs per particle-step between runs of successive lengths, and in total.

    Parameters
    ----------
    lengths
        In steps, beyond those of a first run that is shorter than all.
    write
        Writes the properties of a cloud for so many steps.
    """
    spent = []
    for count in (0, *lengths):
        child = isolated(run, str(case), str(write(_WARM_UP + count)))
        spent.append((child.cpu, child.result["particle-steps"]))
    pairs = [*pairwise(spent), (spent[0], spent[-1])]
    return [1e6 * (after[0] - before[0]) / (after[1] - before[1]) for before, after in pairs]


def measure(options: Options) -> list[Row]:
    """Measure cost per particle-step by stiffness, and over OpenFOAM's at the same Δt."""
    n, steps, repeats = (10_000, 40, 2) if options.quick else (100_000, 100, 3)
    case = pipe.case("40k")
    x = pipe.positions(n, reach=REACH)
    pipe.write_positions(case / "constant" / "softCloudPositions", x)
    halves: dict[str, list[list[float]]] = {}

    times = pipe.transient_case("40k", _EACH * OPENFOAM_STEP, (_WARM_UP + steps) // _EACH + 2)
    pipe.write_positions(times / "constant" / "softCloudPositions", x)

    def ours(name: str, Ca: float, fluid: pipe.Fluid, more: str = "", of: Path = case) -> float:
        write = partial(pipe.write_default_cloud, of, Ca=Ca, dt=OPENFOAM_STEP, fluid=fluid, more=more)
        lengths = steps // 2, steps
        first, second, both = costs(of, lengths, lambda count: write(f"soft{count}", steps=count))
        halves.setdefault(name, []).append([first, second])
        return both

    def theirs(fluid: pipe.Fluid) -> float:
        pipe.write_dictionaries(case, fluid.nu, fluid.rho)
        pipe.write_parcels(case, x, rho=fluid.rho_s)
        try:
            return openfoam_cost(case, n, min(steps, ENOUGH))
        finally:
            # Other parts use the case as well.
            pipe.write_dictionaries(case, pipe.NU, pipe.RHO)

    contestants: dict[str, Callable[[], float]] = {}
    for fluid in FLUIDS:
        for Ca in CAPILLARY_NUMBERS:
            name = f"Ca {Ca:g}{fluid}"
            contestants[name] = partial(ours, name, Ca, FLUIDS[fluid])
    contestants[SHORT] = partial(ours, SHORT, 0.5, pipe.AIR, f"maxDeltaT {OPENFOAM_STEP:g};")
    contestants[TRANSIENT] = partial(ours, TRANSIENT, 0.5, pipe.AIR, "transient yes;", times)
    if shutil.which(SOLVER):
        contestants |= {f"OpenFOAM{fluid}": partial(theirs, FLUIDS[fluid]) for fluid in FLUIDS}
    medians = interleaved(contestants, repeats)
    table = rows("whole", "cost of a default run", medians, "us/particle-step", n)
    time = 0.5e3 * steps * OPENFOAM_STEP
    for k, quantity in enumerate((f"in its first {time:g} ms, from rest", f"in the next {time:g} ms")):
        parts = {name: median(half[k] for half in values) for name, values in halves.items()}
        table += rows("whole", quantity, parts, "us/particle-step", n)
    if "OpenFOAM" in medians:
        ratios = {
            name: medians[name] / medians["OpenFOAM, water" if "water" in name else "OpenFOAM"]
            for name in halves
        }
        table += rows("whole", "default run over OpenFOAM's", ratios, "")
        worst = max(ratio for name, ratio in ratios.items() if name not in (SHORT, TRANSIENT))
        table += rows("whole", WORST_DEFAULT, {"": worst}, "")
    return table
