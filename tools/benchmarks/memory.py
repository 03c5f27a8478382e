"""A million particles: memory of each, and cost against the number of particles."""

from __future__ import annotations

from pathlib import Path

from benchmarks import pipe
from benchmarks.records import (
    GIGA,
    KILO,
    Options,
    Row,
    available_memory,
    isolated,
    peak_memory,
    resident_memory,
    rows,
)

NEEDED = 18e9
"""Free memory, bytes, without which 1e7 particles are not tried."""


def throughput(n: int, steps: int, repeats: int) -> dict[str, float]:
    """Return CPU per particle-step of n particles, μs, and their memory, bytes."""
    import foamprb

    flow = foamprb.read_case(pipe.case("40k"))
    pipe.soft_cloud(flow, 64, 2e-5).advance(1)
    before = resident_memory()
    cloud = pipe.soft_cloud(flow, n, 2e-5)
    costs = [pipe.cost(cloud, steps) for _ in range(repeats)]
    return {"cost": sorted(costs)[repeats // 2], "kept": resident_memory() - before, "peak": peak_memory()}


def whole_run(case: str, n: int) -> None:
    """Run n particles with output, for the peak memory."""
    from foamprb import execute, prepare

    folder = Path(case)
    pipe.write_soft_cloud(folder, n, 2e-5, 10, 2)
    execute(prepare(folder, threads=1))


def measure(options: Options) -> list[Row]:
    """Measure memory and CPU per particle."""
    few, many, steps, repeats = (10_000, 100_000, 5, 1) if options.quick else (100_000, 1_000_000, 10, 1)
    table = []
    results = {n: isolated(throughput, n, steps, repeats).result for n in (few, many)}
    for n, result in results.items():
        table += rows("memory", "cost by particles", {"foamprb paper": result["cost"]}, "us/particle-step", n)
    ratio = {
        "1e5 over 1e4" if options.quick else "1e6 over 1e5": results[many]["cost"] / results[few]["cost"]
    }
    table += rows("memory", "cost of many over few", ratio, "")
    case = str(pipe.case("40k"))
    peaks = {n: isolated(whole_run, case, n).peak for n in (few, many)}
    per_particle = {
        "tracking alone, kept": results[many]["kept"] / many,
        "tracking alone": (results[many]["peak"] - results[few]["peak"]) / (many - few),
        "run with output": (peaks[many] - peaks[few]) / (many - few),
    }
    table += [
        row
        for name, b in per_particle.items()
        for row in rows("memory", "memory per particle", {name: b / KILO}, "kB", many)
    ]
    if options.large and available_memory() > NEEDED:
        large = isolated(whole_run, case, 10_000_000)
        table += rows("memory", "peak memory of 1e7 particles", {"run with output": large.peak / GIGA}, "GB")
    return table
