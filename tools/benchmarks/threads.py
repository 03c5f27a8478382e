"""Speed-up by threads.

Beside them stand as many processes of one thread, which share nothing but the machine: threads cannot be
expected to do better than they, where processors share their clocks, their caches, or a host with others.
"""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, rows, wall_of
from foamprb.cloud.tracker import available_threads


def _timed(cloud, steps: int) -> float:
    before = pipe.particle_steps(cloud)
    spent = wall_of(lambda: cloud.advance(steps))
    return 1e6 * spent / (pipe.particle_steps(cloud) - before)


_clouds = []
"""Of a process that shares nothing with others."""


def _begin(n: int, dt: float) -> None:
    _clouds.append(pipe.soft_cloud(foamprb.read_case(pipe.case("40k")), n, dt))
    _clouds[0].advance(10)


def _go_on(steps: int) -> float:
    return _timed(_clouds[0], steps)


def measure(options: Options) -> list[Row]:
    """Measure wall time per particle-step with 1, 2, 4, … threads, and processes."""
    n, dt, steps, repeats = (20_000, 2e-5, 20, 2) if options.quick else (100_000, 2e-5, 100, 9)
    flow = foamprb.read_case(pipe.case("40k"))
    counts = [1]
    while 2 * counts[-1] <= available_threads():
        counts.append(2 * counts[-1])
    clouds = {count: pipe.soft_cloud(flow, n, dt, threads=count) for count in counts}
    for cloud in clouds.values():
        cloud.advance(10)
    most = counts[-1]
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(most, spawn, _begin, (n, dt)) as pool:

        def apart() -> float:
            return max(pool.map(_go_on, [steps] * most)) / most

        apart()
        contestants = {str(k): lambda c=c: _timed(c, steps) for k, c in clouds.items()}
        times = interleaved({**contestants, "apart": apart}, repeats)
    speed_up = {"foamprb paper": times["1"] / times["apart"]}
    table = rows("threads", "speed-up by processes that share nothing", speed_up, "", most)
    for count in counts:
        spent = times[str(count)]
        table += rows("threads", "wall time by threads", {"foamprb paper": spent}, "us/particle-step", count)
        table += rows("threads", "speed-up", {"foamprb paper": times["1"] / spent}, "", count)
    return table
