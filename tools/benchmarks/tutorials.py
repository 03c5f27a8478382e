"""What a default run costs in flows that were not made for it: OpenFOAM's tutorials, solved by OpenFOAM.

The cloud is what ``foamprb init`` writes, but for places all over the mesh, as often as there is volume.
"""

from __future__ import annotations

import gzip
import re
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, isolated, rows
from benchmarks.report import WORST_TUTORIAL
from benchmarks.tracker import SOLVER, openfoam_cost, openfoam_environment
from benchmarks.whole import cost, run

EXAMPLES = Path("/usr/share/doc/openfoam-examples/examples/incompressible")
RHO = 1.2
"""Of the fluid, which these tutorials do not say, kg/m³."""
CAPILLARY_NUMBERS = (0.01, 0.5)
"""At the mean shear rate, as ``foamprb init`` has it."""
LEFT = 0.85
"""Share of the parcels that are still in the flow at the end."""


class Tutorial(NamedTuple):
    """How a flow is computed."""

    folder: str
    solver: str
    nu: float
    """m²/s."""
    end: float
    """Of the run, s or iterations."""


TUTORIALS = {
    "TJunction": Tutorial("pimpleFoam/RAS/TJunction", "pimpleFoam", 1e-5, 0.3),
    "pitzDaily": Tutorial("simpleFoam/pitzDaily", "simpleFoam", 1e-5, 300.0),
    "cavity": Tutorial("icoFoam/cavity/cavity", "icoFoam", 0.01, 0.5),
}


def _sh(case: Path, *words: str) -> str:
    done = subprocess.run(words, cwd=case, env=openfoam_environment(), capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}: {(done.stderr or done.stdout)[-1000:]}")
    return done.stdout


def solve(name: str, folder: Path) -> Path:
    """The tutorial's case with its last time as time 0, for parcels; computed once."""
    if (folder / "0" / "U").exists():
        return folder
    tutorial, work = TUTORIALS[name], folder.with_name(f"{folder.name}.solver")
    for left_over in (folder, work):
        shutil.rmtree(left_over, ignore_errors=True)
    shutil.copytree(EXAMPLES / tutorial.folder, work)
    for file in work.rglob("*.gz"):
        file.with_suffix("").write_bytes(gzip.decompress(file.read_bytes()))
        file.unlink()
    control = work / "system" / "controlDict"
    # Without the functions, which only look on.
    text = re.sub(r"endTime\s+\S+;", f"endTime {tutorial.end:g};", control.read_text().split("functions")[0])
    control.write_text(text)
    _sh(work, "blockMesh")
    _sh(work, tutorial.solver)
    times = [path for path in work.iterdir() if re.fullmatch(r"[\d.]+", path.name)]
    shutil.copytree(work / "constant" / "polyMesh", folder / "constant" / "polyMesh")
    (folder / "system").mkdir()
    (folder / "0").mkdir()
    pipe.write_dictionaries(folder, tutorial.nu, RHO)
    pipe.write_control(folder, 1.0, 1.0)
    shutil.copy(max(times, key=lambda path: float(path.name)) / "U", folder / "0")
    shutil.rmtree(work)
    return folder


def places(case: Path, n: int) -> pipe.Floats:
    """Random places in the mesh, (n, 3)."""
    mesh, random = foamprb.read_case(case).mesh, np.random.default_rng(0)
    corners = mesh.nodes[mesh.tets]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    chosen = random.choice(len(volumes), n, p=volumes / volumes.sum())
    found: pipe.Floats = np.einsum("nk,nki->ni", random.dirichlet(np.ones(4), n), corners[chosen])
    return found


class Settings(NamedTuple):
    """What ``foamprb init`` has written, and what of it is needed."""

    text: str
    dt: float
    """s."""
    d: float
    """m."""
    rho: float
    """kg/m³."""
    modulus: float
    """Pa, of Ca = 1."""


def first_settings(case: Path) -> Settings:
    """The properties that ``foamprb init`` writes, with particles from a list and nothing that looks on."""
    file = case / "constant" / "softCloudProperties"
    file.unlink(missing_ok=True)
    _sh(case, sys.executable, "-m", "foamprb", "init")
    text = file.read_text(encoding="utf-8")

    def entry(pattern: str) -> float:
        found = re.search(pattern + r"\s+([\d.e+-]+)", text)
        assert found, f"{file} has no {pattern}"
        return float(found[1])

    d = entry(r"\bvalue")
    places = (
        'injectionModels { all { type manualInjection; SOI 0; positionsFile "softCloudPositions"; '
        "ignoreOutOfBounds true; sizeDistribution { type fixedValue; fixedValueDistribution { "
        f"value {d:g}; }} }} }} }}\n    "
    )
    start, end = text.index("injectionModels"), text.index("patchInteractionModel")
    changed = (text[:start] + places + text[end:]).split("cloudFunctions")[0]
    return Settings(changed, entry("deltaT"), d, entry("rho0"), entry("shearModulus") * entry("Ca ="))


def write_cloud(case: Path, settings: Settings, Ca: float, steps: int) -> Path:
    """Write the properties for a run of so many steps; return the file."""
    text, end = settings.text, f"{steps * settings.dt:.9g}"
    values = {"endTime": end, "writeInterval": end, "shearModulus": f"{settings.modulus / Ca:.9g}"}
    for key, value in values.items():
        text = re.sub(rf"{key}\s+[\d.e+-]+", f"{key} {value}", text)
    path = case / "constant" / f"soft{steps}Properties"
    path.write_text(text, encoding="utf-8")
    return path


def patches_of(case: Path) -> str:
    """As :data:`benchmarks.pipe.PATCHES`: walls are sticky, and who reaches an opening is out."""
    kinds = {"wall": "stick", "patch": "escape"}
    flow = foamprb.read_case(case)
    return " ".join(f"{p.name} {{ type {kinds[p.type]}; }}" for p in flow.patches if p.type in kinds)


def compare(name: str, n: int, steps: int, repeats: int) -> list[Row]:
    """Cost per particle-step in one tutorial's flow, and over OpenFOAM's."""
    case = solve(name, pipe.scratch_folder() / f"tutorial_{name}")
    settings, x = first_settings(case), places(case, n)
    pipe.write_positions(case / "constant" / "softCloudPositions", x)
    pipe.write_parcels(case, x, settings.d, settings.rho, patches_of(case))

    def ours(Ca: float) -> float:
        return cost(case, steps, partial(write_cloud, case, settings, Ca))

    # What is compiled is not measured.
    isolated(run, str(case), str(write_cloud(case, settings, 1.0, 1)))
    contestants = {f"{name}, Ca {Ca:g}": partial(ours, Ca) for Ca in CAPILLARY_NUMBERS}
    contestants[f"{name}, OpenFOAM"] = lambda: openfoam_cost(case, n, steps, settings.dt, LEFT)
    costs = interleaved(contestants, repeats)
    theirs = costs[f"{name}, OpenFOAM"]
    ratios = {key: value / theirs for key, value in costs.items() if "OpenFOAM" not in key}
    found = rows("tutorials", "cost in a tutorial's flow", costs, "us/particle-step", n)
    return found + rows("tutorials", "default run in a tutorial's flow over OpenFOAM's", ratios, "")


def measure(options: Options) -> list[Row]:
    """Cost per particle-step in all of them; nothing without OpenFOAM and its tutorials."""
    if not (shutil.which(SOLVER) and EXAMPLES.is_dir()):
        return []
    n, steps, repeats = (5_000, 20, 1) if options.quick else (100_000, 100, 5)
    found = [row for name in TUTORIALS for row in compare(name, n, steps, repeats)]
    worst = max(row.value for row in found if "over OpenFOAM's" in row.quantity)
    return found + rows("tutorials", WORST_TUTORIAL, {"": worst}, "")
