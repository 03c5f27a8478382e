"""Projected cost of a billion particles on a thousand nodes: a model with measured constants.

Constants of foamprb are read from ``performance.csv`` (``tools/benchmark`` makes it); those of the cluster
are assumed and listed. The load balance is simulated with the times at which rigid spheres land in or leave
the paper's pipe. Writes ``projection.md`` and, with matplotlib, ``projection.png``.

    python tools/figures/projection.py --output docs
"""

from __future__ import annotations

import argparse
import heapq
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

from foamprb.results.tables import write_table

RADIUS, LENGTH, WALL_RATE, GRAVITY = 2.1e-3, 0.75, 923.8, 9.81
D, RHO_S, MU_F, RHO_F = 5e-6, 2560.0, 1.208 * 1.491e-5, 1.208
MEAN = WALL_RATE * RADIUS / 4
CELLS = 10_000_000
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
    latency: float = 20e-6  # seconds to ask for and be given a chunk, over the network
    disk: float = 200e9  # bytes per second of the parallel file system, all nodes together
    per_node_disk: float = 2e9  # bytes per second that one node writes
    metadata: float = 20e3  # operations per second of its metadata server


MEANING = {
    "nodes": "nodes",
    "cores": "cores per node",
    "memory": "memory per node, bytes",
    "link": "network per node, bytes/s",
    "latency": "latency of a chunk of particles, s",
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
    """Peak per particle in a run with output."""
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
        peak=1e3 * last("memory per particle", "run with output"),
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
        start = time.perf_counter()
        write_table(file, columns)
        return (time.perf_counter() - start) / n, file.stat().st_size / n


def modules() -> float:
    """Return the number of modules that a run imports."""
    text = "import sys, foamprb.run.loop; print(len(sys.modules))"
    return float(
        subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout
    )


def lifetimes(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return landing or leaving times of rigid spheres entering in proportion to the flux, and their angles.

    They settle at Stokes' speed in Poiseuille's flow: y is linear and x a cubic in t.

    Returns
    -------
    times (n,), s, and the angle of entry (n,), by which a mesh's inlet might be ordered.
    """
    random = np.random.default_rng(0)
    # Flux below r is a fraction 1 − (1 − r²/R²)² of the whole.
    r = RADIUS * np.sqrt(1.0 - np.sqrt(1.0 - random.random(n)))
    angle = 2.0 * np.pi * random.random(n)
    y, z = r * np.cos(angle), r * np.sin(angle)
    fall = (RHO_S - RHO_F) * D**2 * GRAVITY / (18.0 * MU_F)
    landing = (y + np.sqrt(RADIUS**2 - z**2)) / fall

    def distance(t: np.ndarray) -> np.ndarray:
        square = (y * y + z * z) * t - y * fall * t**2 + fall**2 * t**3 / 3.0
        return 2.0 * MEAN * (t - square / RADIUS**2)

    low, high = np.zeros(n), landing.copy()
    for _ in range(50):
        middle = 0.5 * (low + high)
        beyond = distance(middle) > LENGTH
        high = np.where(beyond, middle, high)
        low = np.where(beyond, low, middle)
    return np.minimum(np.where(distance(landing) > LENGTH, high, landing), END), angle


class Balance(NamedTuple):
    """Load balance of a way of sharing."""

    slowest: float
    """Time of the run over that with perfect balance."""
    moved: float
    """Share of the particles that change nodes, on average per write interval."""
    requests: float
    """Requests for chunks per write interval."""


def work_in(life: np.ndarray, interval: int) -> np.ndarray:
    """Return the time for which each particle is tracked in a write interval, s."""
    length = END / INTERVALS
    return np.clip(life - interval * length, 0.0, length)


def shared_statically(life: np.ndarray, nodes: int, scatter: float) -> Balance:
    """Return the balance if every node keeps its share and all synchronise at each write.

    ``scatter`` is the ratio of the run's particles to the sample's: with random places, sums over more
    particles scatter less about their mean.
    """
    total = slowest = 0.0
    for interval in range(INTERVALS):
        share = work_in(life, interval)[: len(life) // nodes * nodes].reshape(nodes, -1).sum(axis=1)
        mean = share.mean()
        total += mean
        slowest += mean + (share.max() - mean) / np.sqrt(scatter)
    return Balance(slowest / total, 0.0, 0.0)


def shared_dynamically(
    life: np.ndarray, nodes: int, chunks_per_node: int, latency: float, scale: float
) -> Balance:
    """Return the balance if a node without chunks takes one from the fullest node.

    ``scale`` is the time of a node for a second of a sample's particle, s, for comparison with the latency.
    """
    total = slowest = moved = 0.0
    for interval in range(INTERVALS):
        work = scale * work_in(life, interval)
        size = len(work) // (nodes * chunks_per_node)
        chunks = work[: size * nodes * chunks_per_node].reshape(nodes, chunks_per_node, size).sum(axis=2)
        total += chunks.sum() / nodes
        finish, stolen = _steal(chunks, latency)
        slowest += finish
        moved += stolen / chunks.size
    return Balance(slowest / total, moved / INTERVALS, float(nodes * chunks_per_node))


def _steal(chunks: np.ndarray, latency: float) -> tuple[float, int]:
    """Return the end of the last node, and the number of chunks that changed nodes."""
    left = [list(map(float, row)) for row in chunks]
    fullest = [(-len(row), node) for node, row in enumerate(left)]
    heapq.heapify(fullest)
    clock = [(0.0, node) for node in range(len(left))]
    heapq.heapify(clock)
    end, stolen = 0.0, 0
    while clock:
        now, node = heapq.heappop(clock)
        end = max(end, now)
        if left[node]:
            heapq.heappush(clock, (now + left[node].pop(), node))
            continue
        while fullest:
            size, victim = heapq.heappop(fullest)
            if not left[victim]:
                continue
            if -size != len(left[victim]):
                # The entry is of before: that node has worked since.
                heapq.heappush(fullest, (-len(left[victim]), victim))
                continue
            work = left[victim].pop()
            heapq.heappush(fullest, (size + 1, victim))
            stolen += 1
            heapq.heappush(clock, (now + latency + work, node))
            break
    return end, stolen


def project(m: Measured, c: Cluster, particles: float, dt: float, writes: int) -> tuple[str, dict[str, Any]]:
    """Return the page, and the data of the plot."""
    life, angle = lifetimes(_SAMPLE)
    steps = particles * life.mean() / dt
    compute = steps * m.step / (c.nodes * c.cores * m.efficiency)
    scatter = particles / _SAMPLE
    # A sample's particle stands for this many; a second of it costs this much on one node.
    scale = scatter * m.step / dt / (c.cores * m.efficiency)
    by_place = life[np.argsort(angle)]
    balances = {
        "static, in the order of the inlet's faces": shared_statically(by_place, c.nodes, 1.0),
        "static, random distribution": shared_statically(life, c.nodes, scatter),
    }
    chunked = {
        k: shared_dynamically(by_place, c.nodes, k, c.latency, scale) for k in (1, 2, 4, 8, 16, 32, 64)
    }
    for k in (4, 16, 64):
        balances[f"dynamic, {k} chunks a node"] = chunked[k]

    files = {"a file a node": c.nodes, "a file a core": c.nodes * c.cores, "one file": 1}
    to_disk = max(particles * m.file / c.disk, particles / c.nodes * m.file / c.per_node_disk)
    prepare_one = particles / c.nodes * m.snapshot
    prepare_all = prepare_one / (c.cores * m.efficiency)
    mesh = CELLS * m.cell
    ranks, levels = c.nodes * c.cores, np.ceil(np.log2(c.nodes))
    # Creating under another name, writing, flushing, renaming, flushing the folder.
    operations = {name: 5 * n / c.metadata for name, n in files.items()}
    whole = {
        "read and prepare the mesh, on one core of each node": CELLS * m.ready,
        "the same once, then sent along a tree of nodes": CELLS * m.ready + levels * mesh / c.link,
        "particle-steps, perfectly balanced": compute,
        "particle-steps, dynamic with 16 chunks a node": compute * chunked[16].slowest,
        f"{writes} snapshots: measured and packed by one core a node": writes * prepare_one,
        f"{writes} snapshots: by all cores": writes * prepare_all,
        f"{writes} snapshots: onto the file system": writes * to_disk,
        f"{writes} snapshots: metadata, a file a node": writes * operations["a file a node"],
        f"{writes} snapshots: metadata, a file a core": writes * operations["a file a core"],
        "the table of fates, as text by one process": particles * m.row,
        "the same by a process a node": particles / c.nodes * m.row,
        "start of Python, a process a core, from the parallel file system": ranks
        * 4
        * m.modules
        / c.metadata,
        "the same, a process a node": c.nodes * 4 * m.modules / c.metadata,
    }
    memory = {
        "mesh, once a node": mesh,
        "mesh, once a core": mesh * c.cores,
        "particles": particles / c.nodes * m.state,
        "particles in a run with output": particles / c.nodes * m.peak,
        "during preparation of the mesh": CELLS * m.cell_peak,
    }
    traffic = {
        "mesh, to every node": mesh * (c.nodes - 1),
        "particles that change nodes, a write interval, 16 chunks": 2.0
        * chunked[16].moved
        * particles
        * m.state,
        "counts at each write": 64.0 * ranks,
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
                ("peak in a run with output, bytes/particle", number(m.peak)),
                ("mesh and flow, bytes/cell", number(m.cell)),
                ("the same during preparation, bytes/cell", number(m.cell_peak)),
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
        balance=table(
            ("way", "time over perfect balance", "particles moved per interval", "chunks per interval"),
            [
                (name, f"{b.slowest:.3f}", f"{100 * b.moved:.2f} %", f"{b.requests:.0f}")
                for name, b in balances.items()
            ],
        ),
        times=table(("what", "s"), [(k, number(v)) for k, v in whole.items()]),
        memory=table(
            ("per node", "GB", "of the node"),
            [(k, number(v / 1e9), f"{100 * v / c.memory:.1f} %") for k, v in memory.items()],
        ),
        traffic=table(
            ("network", "GB in all", "s at full speed"),
            [(k, number(v / 1e9), number(v / (c.link * c.nodes))) for k, v in traffic.items()],
        ),
        sizes=table(
            ("output", "files per snapshot", "GB a file", "files in all", "metadata, s per snapshot"),
            [
                (k, f"{n}", number(particles * m.file / n / 1e9), f"{n * writes}", number(operations[k]))
                for k, n in files.items()
            ],
        ),
        snapshot=number(particles * m.file / 1e9),
        all_snapshots=number(writes * particles * m.file / 1e12),
        table_size=number(particles * m.row_bytes / 1e9),
        order=_order(whole, compute),
    )
    return text, {"life": life, "chunked": chunked}


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
    """Plot landing times, and balance against the number of chunks."""
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
    chunked: dict[int, Balance] = found["chunked"]
    right.semilogx(list(chunked), [b.slowest for b in chunked.values()], "o-", base=2)
    right.set(xlabel="chunks a node", ylabel="time over perfect balance")
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
