"""Cost of ``foamprb run`` with default settings, against OpenFOAM's rigid point spheres.

Automatic integrator, error control, touching ellipsoids, checkpoints, particles up to the wall.
"""

from __future__ import annotations

import shutil
from functools import partial
from pathlib import Path

from benchmarks import pipe
from benchmarks.records import Options, Row, isolated, rows
from benchmarks.report import WORST_DEFAULT
from benchmarks.tracker import ENOUGH, OPENFOAM_STEP, SOLVER, openfoam_cost, pairs

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


def measure(options: Options) -> list[Row]:
    """Measure cost per particle-step by stiffness, and over OpenFOAM's at the same Δt."""
    n, steps, repeats = (10_000, 40, 1) if options.quick else (30_000, 100, 2)
    case = pipe.case("40k")
    times = pipe.transient_case("40k", _EACH * OPENFOAM_STEP, (_WARM_UP + steps) // _EACH + 2)
    x = pipe.positions(n, reach=REACH)
    for folder in (case, times):
        pipe.write_positions(folder / "constant" / "softCloudPositions", x)

    def ends(Ca: float, fluid: pipe.Fluid = pipe.AIR, more: str = "", of: Path = case) -> list[str]:
        write = partial(pipe.write_default_cloud, of, Ca=Ca, dt=OPENFOAM_STEP, fluid=fluid, more=more)
        name = f"soft{Ca:g}_{fluid.rho:g}_{len(more)}"
        return [str(write(f"{name}_{k}", steps=_WARM_UP + k * steps)) for k in (0, 1)]

    def theirs(fluid: pipe.Fluid) -> float:
        pipe.write_dictionaries(case, fluid.nu, fluid.rho)
        pipe.write_parcels(case, x, rho=fluid.rho_s)
        try:
            return openfoam_cost(case, n, min(steps, ENOUGH))
        finally:
            # Other parts use the case as well.
            pipe.write_dictionaries(case, pipe.NU, pipe.RHO)

    runs = {f"Ca {Ca:g}{fluid}": ends(Ca, FLUIDS[fluid]) for fluid in FLUIDS for Ca in CAPILLARY_NUMBERS}
    runs[SHORT] = ends(0.5, more=f"maxDeltaT {OPENFOAM_STEP:g};")
    changing = [ends(0.5, more="transient yes;", of=times)]
    costs: dict[str, list[float]] = {}
    for _ in range(repeats):
        ours = isolated(pairs, str(case), [*runs.values()], 1).result
        ours += isolated(pairs, str(times), changing, 1, False).result
        for name, cost in zip((*runs, TRANSIENT), ours, strict=True):
            costs.setdefault(name, []).append(cost)
        for fluid in FLUIDS if shutil.which(SOLVER) else ():
            costs.setdefault(f"OpenFOAM{fluid}", []).append(theirs(FLUIDS[fluid]))
    least = {name: min(values) for name, values in costs.items()}
    table = rows("whole", "cost of a default run", least, "us/particle-step", n)
    if "OpenFOAM" in least:
        ratios = {
            name: least[name] / least["OpenFOAM, water" if "water" in name else "OpenFOAM"]
            for name in (*runs, TRANSIENT)
        }
        table += rows("whole", "default run over OpenFOAM's", ratios, "")
        worst = max(ratio for name, ratio in ratios.items() if name not in (SHORT, TRANSIENT))
        table += rows("whole", WORST_DEFAULT, {"": worst}, "")
    return table
