"""What a run costs: each function, model and setting over the run without it, beside other programs."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from benchmarks import pipe
from benchmarks.peers import particle_tracer
from benchmarks.records import Options, Row, interleaved, isolated, rows
from benchmarks.tracker import OPENFOAM_STEP, SOLVER, openfoam_cost, pairs

CAPILLARY_NUMBER = 0.5
"""At the wall."""
COST, RATIO = "cost of a run", "over the run without"
BARE, VTK = "nothing more", "VTK's particle tracer"
CALL, SNAPSHOT = "calls of one deltaT", "late snapshots"
_CALL = 160
"""Δt of a long call."""
_MANY = ("particleTracks", "writeInterval 10 deltaT", "writeInterval 20 deltaT")
"""Rows whose cost depends on the number of bodies."""
_TOGETHER = 7
"""Runs that alternate with the same run without what they have, at most."""
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
    """Bodies of :data:`_MANY`."""
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
            return openfoam_cost(copy, size.bodies, size.steps // 4, interval=interval)
        finally:
            for path in copy.glob("[0-9]*[!0]*"):
                shutil.rmtree(path)

    contestants: dict[str, Callable[[], float]] = {openfoam(BARE): measured}
    for name, row in ROWS.items():
        if row.openfoam:
            contestants[openfoam(name)] = lambda row=row: measured(f"f {{ {row.openfoam} }}")
    return contestants | {openfoam("writeInterval 10 deltaT"): lambda: measured(interval=10)}


def groups(bodies: int, many: int) -> list[tuple[list[str], int]]:
    """Return the names of the :data:`ROWS` that share a run without them, and the number of its bodies."""
    shared: dict[tuple[Setup, int], list[str]] = {}
    for name, row in ROWS.items():
        shared.setdefault((row.without, many if name in _MANY else bodies), []).append(name)
    return [
        (names[k : k + _TOGETHER], n)
        for (_, n), names in shared.items()
        for k in range(0, len(names), _TOGETHER)
    ]


def compare(names: list[str], n: int, case: Path, size: Size) -> list[float]:
    """Return the costs of the run without some of :data:`ROWS`, and of each; the Δt is that of OpenFOAM."""
    steps = size.steps if n == size.bodies else size.steps // 4
    settled, measured = (count * OPENFOAM_STEP for count in (size.settling, steps))
    setups = [ROWS[names[0]].without, *(ROWS[name].setup for name in names)]
    files = [
        [
            write_setup(case, f"short{k}", setup, n, settled),
            write_setup(case, f"long{k}", setup, n, settled + measured),
        ]
        for k, setup in enumerate(setups)
    ]
    costs = isolated(pairs, str(case), files, size.repeats).result
    return [cost * OPENFOAM_STEP / setup.dt for cost, setup in zip(costs, setups, strict=True)]


def measure(options: Options) -> list[Row]:
    """Measure the cost of each of :data:`ROWS`, over the bare run; calls, snapshots and other programs."""
    # So few that the steps of a run cost more than its start and its files, which are subtracted.
    bodies = options.bodies or 4000
    size = Size(bodies, 10 * bodies, 50, 800, 3, 400)
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
    for names, n in groups(size.bodies, size.many):
        without, *costs = compare(names, n, case, size)
        measured = dict(zip(names, costs, strict=True))
        over = {name: cost / without for name, cost in measured.items()}
        table += rows("observed", RATIO, over, "", n)
        table += rows("observed", COST, measured, "us/particle-step", n)
        if ROWS[names[0]].without == Setup() and n == size.bodies:
            bare.append(without)
    return table + rows("observed", COST, {BARE: min(bare)}, "us/particle-step", size.bodies)
