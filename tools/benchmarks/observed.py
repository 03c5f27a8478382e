"""What a user's run costs: each function, model and setting over the run without it, beside other programs.

Pairs alternate on one thread. Two runs that differ in length only are subtracted: start, injection, the
transient from rest and the last writing fall away.
"""

from __future__ import annotations

import shutil
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from benchmarks import pipe
from benchmarks.peers import particle_tracer
from benchmarks.records import Options, Row, interleaved, isolated, rows
from benchmarks.tracker import OPENFOAM_STEP, SOLVER, openfoam_cost

CAPILLARY_NUMBER = 0.5
"""At the wall."""
COST, RATIO = "cost of a run", "over the run without"
BARE, VTK = "nothing more", "VTK's particle tracer"
CALL, SNAPSHOT = "calls of one deltaT", "late snapshots"
_CALL = 160
"""Δt of a long call."""
_PLANE = f"origin ({0.3 * pipe.LENGTH:g} 0 0); normal (1 0 0);"


class Setup(NamedTuple):
    """What a run has beside the defaults."""

    functions: str = ""
    forces: str = ""
    solution: str = ""
    dt: float = OPENFOAM_STEP
    """s."""
    ring: tuple[float, float] = (0.0, 0.9)
    """Distances from the axis between which bodies begin, over the pipe's radius."""


class Compared(NamedTuple):
    """A setup, the largest ratio that is wanted, and the setup without it."""

    setup: Setup
    limit: float | None = None
    without: Setup = Setup()
    openfoam: str = ""
    """Cloud function of OpenFOAM for the same purpose."""


def _near_wall(radii: float) -> Setup:
    """Let centres begin between so many radii of a body from the wall, and one more."""
    radius = 0.5 * pipe.D / pipe.RADIUS
    return Setup(ring=(1.0 - (radii + 1.0) * radius, 1.0 - radii * radius))


def _function(kind: str, entries: str = "") -> Setup:
    return Setup(functions=f"f {{ type {kind}; {entries} }}")


ROWS = {
    "particleStatistics": Compared(_function("particleStatistics"), 1.25, openfoam="type voidFraction;"),
    "particleTracks": Compared(
        _function("particleTracks", "trackInterval 1; maxSamples 1000000;"), 1.05,
        openfoam="type particleTracks; trackInterval 1; maxSamples 1000000; resetOnWrite yes;",
    ),
    "deformabilityCytometry": Compared(_function("deformabilityCytometry", f"{_PLANE} view (0 0 1);"), 1.15),
    "particleCollector": Compared(
        _function("particleCollector", f"mode plane; {_PLANE}"), 1.15,
        openfoam="type particleCollector; mode concentricCircle; origin (0.018 0 0); radius (0.0021); "
        "nSector 1; refDir (0 1 0); normal (1 0 0); negateParcelsOppositeNormal no; removeCollected no; "
        "surfaceFormat none; resetOnWrite no; log no;",
    ),
    "particleHistogram": Compared(_function("particleHistogram"), 1.15),
    "fieldSampling": Compared(_function("fieldSampling", "fields ( U );"), 1.15),
    "haemolysis fluid": Compared(_function("haemolysis", "constants Zhang;"), 1.3),
    "haemolysis morphology": Compared(_function("haemolysis", "constants Zhang; stress morphology;"), 2.0),
    "patchPostProcessing": Compared(
        _function("patchPostProcessing", "patches ( wall );"),
        openfoam="type patchPostProcessing; patches ( wall ); maxStoredParcels 1000000;",
    ),
    "suspensionStress": Compared(_function("suspensionStress")),
    "writeInterval 10 deltaT": Compared(Setup(solution=f"writeInterval {10 * OPENFOAM_STEP:g};")),
    "writeInterval deltaT": Compared(Setup(solution=f"writeInterval {OPENFOAM_STEP:g};")),
    "maxDeltaT deltaT": Compared(Setup(solution=f"maxDeltaT {OPENFOAM_STEP:g};")),
    "tolerance 1e-6": Compared(Setup(solution="integrationSchemes { tolerance 1e-6; roughnessShare 0; }")),
    "writeInterval 20 deltaT": Compared(Setup(solution=f"writeInterval {20 * OPENFOAM_STEP:g};"), 2.0),
    "deltaT/10": Compared(Setup(dt=OPENFOAM_STEP / 10), 1.2),
    "wallLift, far from walls": Compared(Setup(forces="wallLift;"), 1.3),
    "faxenCorrection": Compared(Setup(forces="faxenCorrection;"), 1.3),
    "SaffmanMeiLiftForce": Compared(Setup(forces="SaffmanMeiLiftForce;"), 1.3),
    "swimming": Compared(Setup(forces="swimming { speed 2e-5; }"), 1.3),
    "BrownianMotion": Compared(Setup(forces="BrownianMotion { T 293.15; }"), 2.0),
    "centres 1 to 2 radii from a wall": Compared(_near_wall(1.0), 2.5, _near_wall(20.0)),
}  # fmt: skip
"""By what the page calls them."""
LIMITS = {name: row.limit for name, row in ROWS.items() if row.limit} | {CALL: 2.0, SNAPSHOT: 1.2}


def openfoam(name: str) -> str:
    """Return the subject of the cost of OpenFOAM's parcels with a function for the same purpose."""
    return f"OpenFOAM, {name}"


class Size(NamedTuple):
    """How much is computed."""

    bodies: int
    many: int
    """Bodies beside 1000 tracks."""
    settling: int
    """Δt from rest, which are not measured."""
    steps: int
    """Δt that are measured."""
    repeats: int
    snapshots: int


def write_setup(case: Path, name: str, setup: Setup, n: int, end: float) -> str:
    """Write the settings of a run of n bodies until the time ``end``, s, and positions; return the file."""
    places = f"positions_{n}_{setup.ring[0]:g}_{setup.ring[1]:g}"
    if not (case / "constant" / places).exists():
        pipe.write_positions(case / "constant" / places, pipe.positions(n, setup.ring[1], setup.ring[0]))
    entries = setup.solution, setup.forces, setup.functions, places
    steps = round(end / setup.dt)
    written = pipe.write_default_cloud(case, name, CAPILLARY_NUMBER, setup.dt, steps, pipe.WATER, *entries)
    return str(written)


def pairs(case: str, runs: list[list[str]], repeats: int) -> list[float]:
    """Return CPU µs per body and :data:`OPENFOAM_STEP` of each run; the least of the repeats counts.

    Parameters
    ----------
    runs
        The settings of a short and a long run of each.
    """
    from foamprb import execute, prepare
    from foamprb.run.compilation import compile_run

    flows: dict[Any, Any] = {}

    def clock(file: str) -> tuple[float, float]:
        job = prepare(case, dictionary=Path(file), threads=1, flows=flows)
        compile_run(job.cloud, job.compilation)
        start = time.process_time()
        execute(job, "startTime")
        spent = time.process_time() - start
        shutil.rmtree(job.folder.path)
        return spent, pipe.particle_steps(job.cloud) * job.cloud.dt / OPENFOAM_STEP

    # What is compiled is not measured.
    for short, _ in runs:
        clock(short)
    clocks = [[[clock(file) for file in ends] for ends in runs] for _ in range(repeats)]
    # What else runs on the machine only adds to a time.
    least = [[min(repeat[k][end] for repeat in clocks) for end in (0, 1)] for k in range(len(runs))]
    return [1e6 * (long[0] - short[0]) / (long[1] - short[1]) for short, long in least]


def calls(case: str, file: str, repeats: int) -> list[float]:
    """Return the least CPU seconds of a call of :data:`_CALL` Δt, and of as many calls of one."""
    from foamprb import prepare
    from foamprb.cloud.cloud import Stepper

    flows: dict[Any, Any] = {}

    def clock(call: int) -> float:
        job = prepare(case, dictionary=Path(file), threads=1, flows=flows)
        stepper = Stepper(job.cloud)
        stepper.advance(_CALL // 4)
        start = time.process_time()
        for _ in range(_CALL // call):
            stepper.advance(call)
        return time.process_time() - start

    clock(_CALL)
    whole, parts = zip(*((clock(_CALL), clock(1)) for _ in range(repeats)), strict=True)
    return [min(whole), min(parts)]


def writings(case: str, files: list[str]) -> list[float]:
    """Return CPU seconds of runs with a snapshot at each Δt."""
    from foamprb import execute, prepare

    seconds = []
    for file in files:
        job = prepare(case, dictionary=Path(file), threads=1)
        start = time.process_time()
        execute(job, "startTime")
        seconds.append(time.process_time() - start)
        shutil.rmtree(job.folder.path)
    return seconds


def _openfoam(case: Path, size: Size) -> dict[str, Callable[[], float]]:
    """Return measurements of OpenFOAM's parcels, without and with its functions."""
    copy = case.with_name(f"{case.name}_parcels")
    if not copy.exists():
        shutil.copytree(case, copy)
    pipe.write_dictionaries(copy, pipe.WATER.nu, pipe.WATER.rho)
    x = pipe.positions(size.bodies, 0.9)

    def measured(functions: str = "", interval: int = 1_000_000) -> float:
        pipe.write_parcels(copy, x, rho=pipe.WATER.rho_s, functions=functions)
        try:
            return openfoam_cost(copy, size.bodies, size.steps, interval=interval)
        finally:
            for path in copy.glob("[0-9]*[!0]*"):
                shutil.rmtree(path)

    contestants: dict[str, Callable[[], float]] = {openfoam(BARE): measured}
    for name, row in ROWS.items():
        if row.openfoam:
            contestants[openfoam(name)] = lambda row=row: measured(f"f {{ {row.openfoam} }}")
    return contestants | {openfoam("writeInterval 10 deltaT"): lambda: measured(interval=10)}


def compare(name: str, case: Path, size: Size) -> list[float]:
    """Return the costs without and with one of :data:`ROWS`."""
    row, settled, measured = ROWS[name], size.settling * OPENFOAM_STEP, size.steps * OPENFOAM_STEP
    n = size.many if name == "particleTracks" else size.bodies
    files = [
        [
            write_setup(case, f"{kind}0", setup, n, settled),
            write_setup(case, f"{kind}1", setup, n, settled + measured),
        ]
        for kind, setup in (("without", row.without), ("with", row.setup))
    ]
    costs: list[float] = isolated(pairs, str(case), files, min(size.repeats, 200_000 // n + 2)).result
    return costs


def measure(options: Options) -> list[Row]:
    """Measure the cost of each of :data:`ROWS`, over the bare run; calls, snapshots and other programs."""
    bodies = options.bodies or 50_000
    size = Size(bodies, 20 * bodies, 50, 200, 3, 2000)
    if options.quick:
        size = Size(options.bodies or 5000, 10_000, 10, 20, 1, 400)
    case, bare = pipe.case("40k"), []
    file = write_setup(case, "calls", Setup(), size.bodies, 2 * _CALL * OPENFOAM_STEP)
    long, short = isolated(calls, str(case), file, size.repeats).result
    table = rows("observed", RATIO, {CALL: short / long}, "", size.bodies)
    every = Setup(dt=1e-6, solution="writeInterval 1e-6;")
    numbers = size.snapshots // 100, size.snapshots // 100, size.snapshots // 2, size.snapshots
    files = [write_setup(case, f"snapshots{k}", every, 100, n * every.dt) for k, n in enumerate(numbers)]
    # The first run compiles.
    _, start, half, whole = isolated(writings, str(case), files).result
    late = (whole - half) / (half - start) * (numbers[2] - numbers[1]) / (numbers[3] - numbers[2])
    table += rows("observed", RATIO, {SNAPSHOT: late}, "", size.snapshots)
    few = size.bodies // 10
    contestants = {VTK: lambda: isolated(particle_tracer, str(case), few, size.steps // 4).result}
    if shutil.which(SOLVER):
        contestants |= _openfoam(case, size)
    theirs = interleaved(contestants, size.repeats)
    table += rows("observed", COST, theirs, "us/particle-step", size.bodies)
    for name, row in ROWS.items():
        without, cost = compare(name, case, size)
        n = size.many if name == "particleTracks" else size.bodies
        table += rows("observed", RATIO, {name: cost / without}, "", n)
        table += rows("observed", COST, {name: cost}, "us/particle-step", n)
        if row.without == Setup() and n == size.bodies:
            bare.append(without)
    return table + rows("observed", COST, {BARE: statistics.median(bare)}, "us/particle-step", size.bodies)
