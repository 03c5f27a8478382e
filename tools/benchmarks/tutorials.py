"""Cost of a default run in flows of OpenFOAM's tutorials, also on tetrahedra, and in a mesh of snappyHexMesh.

The cloud is what ``foamprb init`` writes, but for places all over the mesh, as often as there is volume.

How right the places are is measured too, of particles that are released at rest: what the steps in time are
off by, each program against itself with much shorter steps. OpenFOAM's error goes with Δt, which says by what
its Δt is to be divided for ours to be reached.
"""

from __future__ import annotations

import gzip
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.divided import divide, hexahedra, write_mesh
from benchmarks.records import TOOLS, Options, Row, isolated, rows
from benchmarks.report import WORST_TUTORIAL
from benchmarks.tracker import ENOUGH, SOLVER, openfoam_cost, openfoam_environment, pairs
from foamprb.cloud.cloud import Stepper

EXAMPLES = Path("/usr/share/doc/openfoam-examples/examples/incompressible")
RHO = 1.2
"""Of the fluid, which these tutorials do not say, kg/m³."""
CAPILLARY_NUMBERS = (0.01, 0.5)
"""At the mean shear rate, as ``foamprb init`` has it."""
LEFT = 0.85
"""Share of the parcels that are still in the flow at the end."""
_FINE, _FINEST = 16, 64
"""What OpenFOAM's Δt is divided by: where its error goes with Δt, and for the places that count as right."""
_TIGHT, _SHORT = 1e-8, 64
"""Tolerance of our places that count as right, and what Δt is divided by there."""
_WARM_UP = 5
_FOLLOWED, _FOR = 1000, 20
"""Particles that are followed, and for how many Δt."""


class Tutorial(NamedTuple):
    """How a flow is computed."""

    folder: str
    solver: str
    nu: float
    """m²/s."""
    end: float
    """Of the run, s or iterations."""


TETRAHEDRA = "tetrahedra"
"""The flow of ``TJunction`` on a mesh whose hexahedra are cut into six tetrahedra each."""
SNAPPY = "snappy"
"""The bend of ``cases/snappy``, meshed by snappyHexMesh."""
TUTORIALS = {
    "TJunction": Tutorial("pimpleFoam/RAS/TJunction", "pimpleFoam", 1e-5, 0.3),
    TETRAHEDRA: Tutorial("pimpleFoam/RAS/TJunction", "pimpleFoam", 1e-5, 0.1),
    "pitzDaily": Tutorial("simpleFoam/pitzDaily", "simpleFoam", 1e-5, 300.0),
    SNAPPY: Tutorial("", "cases/snappy/Allrun", 1.491e-5, 0.0),
}


def _sh(case: Path, *words: str) -> str:
    done = subprocess.run(words, cwd=case, env=openfoam_environment(), capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}: {(done.stderr or done.stdout)[-1000:]}")
    return done.stdout


def solve(name: str, folder: Path) -> Path:
    """Return a case with its last time as time 0, for parcels; computed once."""
    if (folder / "0" / "U").exists():
        return folder
    tutorial, work = TUTORIALS[name], folder.with_name(f"{folder.name}.solver")
    for left_over in (folder, work):
        shutil.rmtree(left_over, ignore_errors=True)
    if name == SNAPPY:
        _sh(TOOLS.parent, tutorial.solver, str(work))
    else:
        _run(tutorial, work, divided=name == TETRAHEDRA)
    times = [path for path in work.iterdir() if re.fullmatch(r"[\d.]+", path.name)]
    shutil.copytree(work / "constant" / "polyMesh", folder / "constant" / "polyMesh")
    (folder / "system").mkdir()
    (folder / "0").mkdir()
    pipe.write_dictionaries(folder, tutorial.nu, RHO)
    pipe.write_control(folder, 1.0, 1.0)
    shutil.copy(max(times, key=lambda path: float(path.name)) / "U", folder / "0")
    shutil.rmtree(work)
    return folder


def _run(tutorial: Tutorial, work: Path, divided: bool) -> None:
    """Compute the flow of a tutorial in a folder, on its hexahedra or on tetrahedra."""
    shutil.copytree(EXAMPLES / tutorial.folder, work)
    for file in work.rglob("*.gz"):
        file.with_suffix("").write_bytes(gzip.decompress(file.read_bytes()))
        file.unlink()
    control = work / "system" / "controlDict"
    # Without the functions, which only look on.
    text = re.sub(r"endTime\s+\S+;", f"endTime {tutorial.end:g};", control.read_text().split("functions")[0])
    control.write_text(text)
    _sh(work, "blockMesh")
    if divided:
        grid, patches = hexahedra(work)
        write_mesh(work / "constant" / "polyMesh", divide(grid, "tetrahedra"), patches)
        # On tetrahedra pimpleFoam diverges without limits and at the tutorial's Courant number.
        schemes = work / "system" / "fvSchemes"
        gradients, rest = schemes.read_text().split("divSchemes")
        limited = gradients.replace("Gauss linear", "cellLimited Gauss linear 1")
        schemes.write_text(f"{limited}divSchemes{rest}")
        control.write_text(re.sub(r"maxCo\s+\S+;", "maxCo 1;", control.read_text()))
    _sh(work, tutorial.solver)


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
    """Return the settings of ``foamprb init`` with listed particles and without cloud functions."""
    file = case / "constant" / "softCloudProperties"
    file.unlink(missing_ok=True)
    _sh(case, sys.executable, "-m", "foamprb", "init")
    text = file.read_text(encoding="utf-8")

    def entry(pattern: str) -> float:
        match = re.search(pattern + r"\s+([\d.e+-]+)", text)
        assert match, f"{file} has no {pattern}"
        return float(match[1])

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
    values["deltaT"] = f"{settings.dt:.9g}"
    for key, value in values.items():
        text = re.sub(rf"\b{key}\s+[\d.e+-]+", f"{key} {value}", text)
    path = case / "constant" / f"soft{Ca:g}_{steps}Properties"
    path.write_text(text, encoding="utf-8")
    return path


def patches_of(case: Path) -> str:
    """Return interactions like :data:`benchmarks.pipe.PATCHES`: sticky walls, escape at openings."""
    kinds = {"wall": "stick", "patch": "escape"}
    flow = foamprb.read_case(case)
    return " ".join(f"{p.name} {{ type {kinds[p.type]}; }}" for p in flow.patches if p.type in kinds)


def our_places(case: str, dictionary: str, steps: int, tolerance: float | None = None) -> list[list[float]]:
    """Return places of particles released at rest after some steps; the start for ended ones."""
    from foamprb import Status, prepare

    job = prepare(case, dictionary=Path(dictionary))
    cloud = job.cloud
    if tolerance is not None:
        models = replace(cloud.models, tolerance=tolerance, roughness_share=0.0)
        p, flow, medium, walls = cloud.particles, cloud.flow, cloud.medium, cloud.interactions
        cloud = foamprb.Cloud(p, flow, medium, walls, cloud.dt, models)
    cloud.particles.v[:] = 0.0
    Stepper(cloud).advance(steps)
    p = cloud.particles
    ends: list[list[float]] = np.where((p.status == Status.ACTIVE)[:, None], p.x, p.x0).tolist()
    return ends


def their_places(case: Path, n: int, dt: float, time: float) -> pipe.Floats:
    """Return places of OpenFOAM's parcels after a time, s, in steps of ``dt``."""
    # Its parcels take one step more, before the start.
    pipe.write_control(case, dt, time - dt, round(time / dt) - 1)
    _sh(case, SOLVER)
    (folder,) = (path for path in case.iterdir() if re.fullmatch(r"[\d.e-]+", path.name) and path.name != "0")
    cloud = folder / "lagrangian" / "kinematicCloud"
    numbers = {
        name: np.array(re.findall(r"[-\d.e+]+", (cloud / name).read_text().split("\n(\n")[1]), dtype=float)
        for name in ("positions", "origId")
    }
    shutil.rmtree(folder)
    ends = np.full((n, 3), np.nan)
    ends[numbers["origId"].astype(int)] = numbers["positions"].reshape(-1, 4)[:, :3]
    return ends


def errors(case: Path, name: str, settings: Settings, x: pipe.Floats) -> dict[str, float]:
    """Return medians of the relative errors of places, by the subjects of :func:`compare`."""
    pipe.write_positions(case / "constant" / "softCloudPositions", x)
    pipe.write_parcels(case, x, settings.d, settings.rho, patches_of(case))

    def off(places: pipe.Floats, right: pipe.Floats) -> float:
        way = np.linalg.norm(right - x, axis=1)
        moved = way > 0.0
        error = np.linalg.norm(places - right, axis=1)[moved] / way[moved]
        # Who has ended in one of them has no place.
        return float(np.median(error[error < 1.0]))

    def ours(Ca: float, divided: int, *tolerance: float) -> pipe.Floats:
        cloud = write_cloud(case, settings._replace(dt=settings.dt / divided), Ca, _FOR * divided)
        child = isolated(our_places, str(case), str(cloud), _FOR * divided, *tolerance)
        return np.array(child.result)

    misses = {f"{name}, Ca {Ca:g}": off(ours(Ca, 1), ours(Ca, _SHORT, _TIGHT)) for Ca in CAPILLARY_NUMBERS}
    dt, time = settings.dt, _FOR * settings.dt
    right = their_places(case, len(x), dt / _FINEST, time)
    for key, divided in (("OpenFOAM", 1), (f"OpenFOAM, Δt/{_FINE}", _FINE)):
        misses[f"{name}, {key}"] = off(their_places(case, len(x), dt / divided, time), right)
    return misses


def compare(name: str, n: int, steps: int, repeats: int) -> list[Row]:
    """Return cost per particle-step in one tutorial's flow, and over OpenFOAM's, also at equal error."""
    case = solve(name, pipe.scratch_folder() / f"tutorial_{name}")
    settings, x = first_settings(case), pipe.places_in(foamprb.read_case(case).mesh, n)
    pipe.write_positions(case / "constant" / "softCloudPositions", x)
    pipe.write_parcels(case, x, settings.d, settings.rho, patches_of(case))

    soft = tuple(f"{name}, Ca {Ca:g}" for Ca in CAPILLARY_NUMBERS)
    runs = [
        [str(write_cloud(case, settings, Ca, count)) for count in (_WARM_UP, _WARM_UP + steps)]
        for Ca in CAPILLARY_NUMBERS
    ]
    rigid, fine = f"{name}, OpenFOAM", f"{name}, OpenFOAM, Δt/{_FINE}"
    costs: dict[str, list[float]] = {}
    for _ in range(repeats):
        for key, cost in zip(soft, isolated(pairs, str(case), runs, 1).result, strict=True):
            costs.setdefault(key, []).append(cost)
        # The cost of its steps is the same from the first on.
        for key, divided in ((rigid, 1), (fine, _FINE)):
            theirs = openfoam_cost(case, n, min(steps, ENOUGH), settings.dt / divided, LEFT)
            costs.setdefault(key, []).append(theirs)
    least = {key: min(values) for key, values in costs.items()}
    table = rows("tutorials", "cost in a tutorial's flow", least, "us/particle-step", n)
    ratios = {key: least[key] / least[rigid] for key in soft}
    table += rows("tutorials", "default run in a tutorial's flow over OpenFOAM's", ratios, "")
    off = errors(case, name, settings, x[:_FOLLOWED])
    table += rows("tutorials", f"error of the place after {_FOR} Δt over the way", off, "")
    # So many of OpenFOAM's steps in one Δt have our error.
    needed = {key: _FINE * off[fine] / off[key] for key in soft}
    equal = {key: least[key] / (needed[key] * least[fine]) for key in soft}
    return table + rows("tutorials", "the same at equal error of the place", equal, "")


def measure(options: Options) -> list[Row]:
    """Measure cost per particle-step in all tutorials; [] without OpenFOAM and its tutorials."""
    if not (shutil.which(SOLVER) and EXAMPLES.is_dir()):
        return []
    n, steps, repeats = (5_000, 20, 1) if options.quick else (20_000, 100, 2)
    table = [row for name in TUTORIALS for row in compare(name, n, steps, repeats)]
    worst = max(row.value for row in table if "over OpenFOAM's" in row.quantity)
    return table + rows("tutorials", WORST_TUTORIAL, {"": worst}, "")
