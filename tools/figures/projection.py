"""Projected cost of a billion particles in a large mesh on a thousand nodes: a model with measured constants.

Constants of foamprb are read from ``performance.csv`` (``tools/benchmark`` makes it); those of the cluster
are assumed and listed. The load balance is simulated with the paths of rigid spheres in the paper's pipe.
Writes ``projection.md`` and, with matplotlib, ``projection.png``.

    python tools/figures/projection.py --output docs
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))
from benchmarks.records import Results, read_rows
from benchmarks.report import number, table

from foamprb.cloud.cloud import PART
from foamprb.parallel.homes import PARTS
from foamprb.results.tables import write_table

RADIUS, LENGTH, WALL_RATE, GRAVITY = 2.1e-3, 0.75, 923.8, 9.81
D, RHO_S, MU_F, RHO_F = 5e-6, 2560.0, 1.208 * 1.491e-5, 1.208
MEAN = WALL_RATE * RADIUS / 4
CELLS = 200_000_000
PREPARED = 1700.0
"""Bytes for each cell that a node holds while it prepares the flow, measured with 1e6 cells on four nodes."""
PLACE = 100.0
"""Bytes for each particle on the first process while places of release are drawn, measured with 1e6."""
PASSES = 5
"""How often the processes go through all particles together: four times at the start, once at the end."""
RINGS = 5
"""Layers of cells around those of a node."""
PAUSE = 2e-3
"""Time of an exchange between nodes beside the data, s: two barriers with pauses of up to 1 ms."""
EVERY = 40
"""Steps between two exchanges."""
TIMES = 200
"""Times at which the places of particles are evaluated."""
END, INTERVALS = 2.0, 20
_SAMPLE = 1_000_000
TEMPLATE = Path(__file__).with_suffix(".md.in")


@dataclass(frozen=True)
class Cluster:
    """Assumptions about the machine."""

    nodes: int = 1000
    cores: int = 64  # per node
    memory: float = 256e9  # bytes per node
    link: float = 10e9  # bytes per second and node
    disk: float = 200e9  # bytes per second of the parallel file system, all nodes together
    per_node_disk: float = 2e9  # bytes per second that one node writes
    metadata: float = 20e3  # operations per second of its metadata server


MEANING = {
    "nodes": "nodes",
    "cores": "cores per node",
    "memory": "memory per node, bytes",
    "link": "network per node, bytes/s",
    "disk": "parallel file system, all nodes together, bytes/s",
    "per_node_disk": "the same for one node, bytes/s",
    "metadata": "its metadata server, operations/s",
}


class Measured(NamedTuple):
    """Measured constants of foamprb; SI units, bytes."""

    step: float
    """CPU of a particle-step of ``paper``."""
    efficiency: float
    """Of two threads over one; assumed for all cores of a node."""
    state: float
    """State per particle."""
    peak: float
    """Peak per particle in a run with output on two nodes."""
    cell: float
    """Mesh and flow per cell."""
    cell_peak: float
    """Per cell, during preparation of the mesh."""
    ready: float
    """CPU time per cell until the first step."""
    snapshot: float
    """Wall time per particle to measure and to write."""
    file: float
    """Size of a snapshot per particle."""
    row: float
    """Wall time of a row of the table of fates."""
    row_bytes: float
    modules: float
    """Files that Python opens to start."""


def measured(results: Results) -> Measured:
    """Return constants from the benchmark's results, and others measured here at once.

    Raises
    ------
    SystemExit
        If a part of the benchmark is missing.
    """

    def last(quantity: str, subject: str) -> float:
        curve = results.curve(quantity, subject)
        if not curve:
            raise SystemExit(f"performance.csv has no {quantity} of {subject}: run tools/benchmark")
        return curve[-1][1]

    cells, ready = results.curve("time to ready", "foamprb")[-1]
    particles, writing = results.curve("time of a snapshot", "snapshot to file")[-1]
    measuring = last("time of a snapshot", "measures")
    row, row_bytes = table_row()
    return Measured(
        step=1e-6 * last("cost", "foamprb paper"),
        efficiency=min(1.0, (results.get("speed-up", "foamprb paper", 2) or 2.0) / 2.0),
        state=1e3 * last("memory per particle", "tracking alone, kept"),
        peak=1e3 * last("memory per particle by cores", "nodes"),
        cell=1e3 * last("memory kept per cell, kB", "foamprb"),
        cell_peak=1e9 * last("peak memory, GB", "foamprb") / cells,
        ready=ready / cells,
        snapshot=(writing + measuring) / particles,
        file=last("size of a snapshot", "file, foamprb"),
        row=row,
        row_bytes=row_bytes,
        modules=modules(),
    )


def table_row() -> tuple[float, float]:
    """Return seconds and bytes of a row of a table with 18 columns of numbers, like the table of fates."""
    n, random = 50_000, np.random.default_rng(0)
    columns = {f"column{k}": random.random(n) for k in range(18)}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "table.csv"
        start = time.process_time()
        write_table(file, columns)
        return (time.process_time() - start) / n, file.stat().st_size / n


def modules() -> float:
    """Return the number of modules that a run imports."""
    text = "import sys, foamprb.run.loop; print(len(sys.modules))"
    return float(
        subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout
    )


class Sample(NamedTuple):
    """Rigid spheres that enter in proportion to the flux: places (y, z), m, and times until they end, s."""

    y: np.ndarray
    z: np.ndarray
    life: np.ndarray

    @property
    def fall(self) -> float:
        """Stokes' speed, with which they settle along -y, m/s."""
        return (RHO_S - RHO_F) * D**2 * GRAVITY / (18.0 * MU_F)

    def distance(self, t: np.ndarray | float) -> np.ndarray:
        """Return the distance along the pipe after a time: y is linear and x a cubic in t."""
        y, z, fall = self.y, self.z, self.fall
        square = (y * y + z * z) * t - y * fall * t**2 + fall**2 * t**3 / 3.0
        return np.asarray(2.0 * MEAN * (t - square / RADIUS**2))


def lifetimes(n: int) -> Sample:
    """Return n spheres with the times at which they land or leave."""
    random = np.random.default_rng(0)
    # Flux below r is a fraction 1 − (1 − r²/R²)² of the whole.
    r = RADIUS * np.sqrt(1.0 - np.sqrt(1.0 - random.random(n)))
    angle = 2.0 * np.pi * random.random(n)
    sample = Sample(r * np.cos(angle), r * np.sin(angle), np.empty(n))
    landing = (sample.y + np.sqrt(RADIUS**2 - sample.z**2)) / sample.fall
    low, high = np.zeros(n), landing.copy()
    for _ in range(50):
        middle = 0.5 * (low + high)
        beyond = sample.distance(middle) > LENGTH
        high = np.where(beyond, middle, high)
        low = np.where(beyond, low, middle)
    leaves = sample.distance(landing) > LENGTH
    return sample._replace(life=np.minimum(np.where(leaves, high, landing), END))


def work_in(life: np.ndarray, interval: int) -> np.ndarray:
    """Return the time for which each particle is tracked in a write interval, s."""
    length = END / INTERVALS
    return np.clip(life - interval * length, 0.0, length)


def shared_by_number(life: np.ndarray, nodes: int, scatter: float) -> float:
    """Return the time over that with perfect balance if every node has every N-th particle.

    All synchronise at each write. ``scatter`` is the ratio of the run's particles to the sample's: sums over
    more particles scatter less about their mean.
    """
    total = slowest = 0.0
    for interval in range(INTERVALS):
        share = work_in(life, interval)[: len(life) // nodes * nodes].reshape(nodes, -1).sum(axis=1)
        mean = share.mean()
        total += mean
        slowest += mean + (share.max() - mean) / np.sqrt(scatter)
    return slowest / total


def shared_by_place(sample: Sample, slices: int, sectors: int) -> float:
    """Return the time over that with perfect balance if every node has the particles in its part of the pipe.

    The pipe is cut into slices along its axis, and these into sectors.
    """
    total = slowest = 0.0
    for t in (np.arange(TIMES) + 0.5) * END / TIMES:
        there = np.flatnonzero(sample.life > t)
        x = sample.distance(t)[there]
        angle = np.arctan2(sample.z[there], sample.y[there] - sample.fall * t)
        part = np.clip((x / LENGTH * slices).astype(int), 0, slices - 1) * sectors
        part += np.clip(((angle / (2.0 * np.pi) + 0.5) * sectors).astype(int), 0, sectors - 1)
        slowest += np.bincount(part, minlength=1).max() if len(part) else 0.0
        total += len(part) / (slices * sectors)
    return slowest / total


def cells_held(own: float) -> float:
    """Return the number of cells of a node with the layers around its own cells, a cube."""
    return (own ** (1.0 / 3.0) + 2.0 * RINGS) ** 3


def project(m: Measured, c: Cluster, particles: float, dt: float, writes: int) -> tuple[str, dict[str, Any]]:
    """Return the page, and the data of the plot."""
    sample = lifetimes(_SAMPLE)
    life = sample.life
    steps = particles * life.mean() / dt
    compute = steps * m.step / (c.nodes * c.cores * m.efficiency)
    places = {sectors: shared_by_place(sample, c.nodes // sectors, sectors) for sectors in (1, 10, 100)}
    by_number = shared_by_number(life, c.nodes, particles / _SAMPLE)
    own, ranks = CELLS / c.nodes, c.nodes * c.cores
    held = cells_held(own)
    to_disk = max(particles * m.file / c.disk, particles / c.nodes * m.file / c.per_node_disk)
    # Creating under another name, writing, flushing, renaming, flushing the folder.
    operations = 5.0 / c.metadata
    gathered = particles * m.state
    exchanges = END / dt / EVERY
    whole = {
        "read and prepare the parts of the mesh, a core a node": held * m.ready,
        "particle-steps, perfectly balanced": compute,
        "particle-steps, particles by number, the mesh whole on each node": compute * by_number,
        "particle-steps, particles by place, 10 sectors a slice": compute * places[10],
        f"exchanges between nodes, every {EVERY} steps": exchanges * PAUSE,
        f"{writes} snapshots: measured and packed, a process a core": writes
        * particles
        / (ranks * m.efficiency)
        * m.snapshot,
        f"{writes} snapshots: onto the file system": writes * to_disk,
        f"{writes} checkpoints: sent to the homes of the particles": writes * gathered / (c.nodes * c.link),
        f"{writes} checkpoints: onto the file system": writes
        * max(gathered / c.disk, gathered / c.nodes / c.per_node_disk),
        f"{writes} snapshots and checkpoints: metadata, two files a core": 2 * writes * operations * ranks,
        "the cloud at the start, sent by the first process part by part": gathered / c.link,
        f"rows of tables and the like, {PASSES} times for all particles": PASSES
        * particles
        / (PART * min(PARTS, ranks))
        * PAUSE,
        "the table of fates, as text, a process a core": particles * m.row / ranks,
        "the table of fates, written by the first process": particles * m.row_bytes / c.per_node_disk,
        "start of Python, a process a core, from the parallel file system": ranks
        * 4
        * m.modules
        / c.metadata,
        "start of Python, a process a node": c.nodes * 4 * m.modules / c.metadata,
    }
    memory = {
        "mesh, whole on each node": CELLS * m.cell,
        "mesh, whole, during its preparation": CELLS * m.cell_peak,
        "mesh, the part of a node with its layers": held * m.cell,
        "mesh, the part, during its preparation": held * PREPARED,
        "particles of a node, evenly": particles / c.nodes * m.peak,
        "first process: places of all particles, while they are drawn": particles * PLACE,
    }
    text = TEMPLATE.read_text(encoding="utf-8").format(
        particles=number(particles),
        nodes=c.nodes,
        constants=table(
            ("constant", "value"),
            [
                ("CPU of a particle-step of `paper`, µs", number(1e6 * m.step)),
                ("efficiency of threads", number(m.efficiency)),
                ("state, bytes/particle", number(m.state)),
                ("peak in a run with output on nodes, bytes/particle", number(m.peak)),
                ("mesh and flow, bytes/cell", number(m.cell)),
                ("the same during preparation, whole, bytes/cell", number(m.cell_peak)),
                ("the same, a part, bytes/cell held", number(PREPARED)),
                ("mesh and flow, µs of CPU/cell", number(1e6 * m.ready)),
                ("snapshot: measures and file, µs/particle", number(1e6 * m.snapshot)),
                ("snapshot, bytes/particle", number(m.file)),
                ("row of `fates.csv`, µs and bytes", f"{number(1e6 * m.row)}, {number(m.row_bytes)}"),
                ("modules that a run imports", number(m.modules)),
            ],
        ),
        cluster=table(("assumed", ""), [(MEANING[f.name], f"{getattr(c, f.name):g}") for f in fields(c)]),
        life=f"{life.mean():.2f}",
        tenth=f"{np.quantile(life, 0.1):.2f}",
        ninth=f"{np.quantile(life, 0.9):.2f}",
        dt=f"{dt:g}",
        steps=number(steps),
        cells=number(CELLS),
        writes=writes,
        intervals=INTERVALS,
        own=number(own),
        held=number(held),
        layers=RINGS,
        balance=table(
            ("way", "time over perfect balance"),
            [
                ("by number, evened out after each chunk (the mesh whole on each node)", f"{by_number:.3f}"),
                *(
                    (f"by place, {c.nodes // k} slices of {k} sector{'s'[: k > 1]}", f"{v:.1f}")
                    for k, v in places.items()
                ),
            ],
        ),
        times=table(("what", "s"), [(k, number(v)) for k, v in whole.items()]),
        memory=table(
            ("per node", "GB", "of the node"),
            [(k, number(v / 1e9), f"{100 * v / c.memory:.1f} %") for k, v in memory.items()],
        ),
        snapshot=number(particles * m.file / 1e9),
        all_snapshots=number(writes * particles * m.file / 1e12),
        table_size=number(particles * m.row_bytes / 1e9),
        most_particles=number(c.memory / PLACE),
        order=_order(whole, compute),
    )
    return text, {"life": life, "places": places}


def _order(whole: dict[str, float], compute: float) -> str:
    """List operations longer than the computation, in descending order."""
    worst = sorted(
        ((v, k) for k, v in whole.items() if v > compute and "particle-steps" not in k), reverse=True
    )
    if not worst:
        return "No operation above takes longer than the particle-steps."
    return "\n".join(
        f"{place}. {what}: {seconds / compute:.1f} times the particle-steps."
        for place, (seconds, what) in enumerate(worst, start=1)
    )


def plot(found: dict[str, Any], file: Path) -> None:
    """Plot landing times, and the balance by place."""
    try:
        import matplotlib as mpl
    except ImportError:
        print("Without matplotlib there is no plot.")
        return
    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    left.hist(found["life"], bins=100, range=(0.0, END), density=True, color="tab:blue")
    left.set(xlabel="time until a particle lands or leaves, s", ylabel="density, 1/s")
    places: dict[int, float] = found["places"]
    right.loglog(list(places), list(places.values()), "o-")
    right.set(xlabel="sectors of a slice", ylabel="time over perfect balance")
    right.grid(alpha=0.3)
    figure.savefig(file, dpi=130)
    plt.close(figure)


def main() -> None:
    """Project, write and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument(
        "--output", type=Path, default=Path("docs"), help="folder, with performance.csv [docs]"
    )
    parser.add_argument("--particles", type=float, default=1e9)
    parser.add_argument("--dt", type=float, default=2e-5, help="time step, s [2e-5]")
    parser.add_argument("--writes", type=int, default=100, help="snapshots [100]")
    for field in fields(Cluster):
        kind: Callable[[str], Any] = type(field.default)
        text = f"{MEANING[field.name]} [{field.default:g}]"
        parser.add_argument(f"--{field.name.replace('_', '-')}", type=kind, default=field.default, help=text)
    options = parser.parse_args()
    cluster = Cluster(**{field.name: getattr(options, field.name) for field in fields(Cluster)})
    constants = measured(Results(read_rows(options.output / "performance.csv")).newest())
    text, found = project(constants, cluster, options.particles, options.dt, options.writes)
    (options.output / "projection.md").write_text(text, encoding="utf-8")
    plot(found, options.output / "projection.png")
    print(text)


if __name__ == "__main__":
    main()
