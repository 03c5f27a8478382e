"""Speed-up by threads, and the same answer to the last bit whatever their number and the order in memory."""

from __future__ import annotations

import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, rows, wall_of
from foamprb.compile.helper import available_threads


def _timed(cloud, steps: int) -> float:
    before = pipe.particle_steps(cloud)
    spent = wall_of(lambda: cloud.advance(steps))
    return 1e6 * spent / (pipe.particle_steps(cloud) - before)


def _shuffled(cloud, order, threads: int):
    """The same particles in another order."""
    rest = (cloud.flow, cloud.medium, cloud.interactions, cloud.dt, cloud.models, threads)
    return foamprb.Cloud(cloud.particles.take(order), *rest)


def _same(a, b) -> bool:
    """Whether two clouds are in the same state, but for how a cloud numbers its particles."""
    a = a._replace(number=b.number)
    return all(x.tobytes() == y.tobytes() for x, y in zip(a, b, strict=True))


def measure(options: Options) -> list[Row]:
    """Wall time per particle-step with 1, 2, 4, … threads; 1 where runs agree bit by bit."""
    n, steps, repeats = (20_000, 20, 2) if options.quick else (100_000, 40, 7)
    flow = foamprb.read_case(pipe.case("40k"))
    counts = [1]
    while 2 * counts[-1] <= available_threads():
        counts.append(2 * counts[-1])
    clouds = {count: pipe.soft_cloud(flow, n, 2e-5, threads=count) for count in counts}
    for cloud in clouds.values():
        cloud.advance(10)
    times = interleaved({str(k): lambda c=c: _timed(c, steps) for k, c in clouds.items()}, repeats)
    found = []
    for count in counts:
        spent = times[str(count)]
        found += rows("threads", "wall time by threads", {"foamprb paper": spent}, "us/particle-step", count)
        found += rows("threads", "speed-up", {"foamprb paper": times["1"] / spent}, "", count)

    order = np.random.default_rng(1).permutation(n)
    for integrator in ("paper", "stokes"):
        one = pipe.soft_cloud(flow, n, 2e-5, integrator, threads=1)
        others = [_shuffled(one, order, threads) for threads in (1, 2, 3)]
        one.advance(20)
        same = True
        for other in others:
            # In pieces of other lengths as well.
            other.advance(7)
            other.advance(13)
            same &= _same(one.particles.take(order), other.particles)
        found += rows("threads", "same to the last bit", {f"foamprb {integrator}": float(same)}, "")
    return found
