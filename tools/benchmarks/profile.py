"""Profile: each compiled stage of the loop alone, on blocks of a run."""

from __future__ import annotations

import time
from typing import Any, NamedTuple

import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, cpu_of, interleaved, rows
from benchmarks.report import GAP, USEFUL
from benchmarks.tracker import OPENFOAM_STEP, Tracker
from benchmarks.whole import CAPILLARY_NUMBERS, REACH
from foamprb.cloud import block
from foamprb.cloud.block import frame_stage
from foamprb.cloud.block import frame_stage as judging_stage
from foamprb.cloud.block import frame_stage as medium_stage
from foamprb.cloud.integrators import paper, rosenbrock, stokes
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.layout import LANES
from foamprb.cloud.motion import SEEN
from foamprb.cloud.tracker import Models, in_blocks
from foamprb.compile.link import link, read_by
from foamprb.flow.meshflow import LONG
from foamprb.flow.walk import sample, walk
from foamprb.flow.walls import gap
from foamprb.settings.solution import STRIDE


class Stage(NamedTuple):
    """A compiled part of the loop, and how often a step calls it."""

    function: Any
    times: int
    takes: str = ""
    """``medium``, ``judging`` for medium and tolerance, or nothing beside the block."""


STAGES: dict[str, dict[str, Stage]] = {
    "paper": {
        "traction": Stage(paper.traction_stage, 1, "medium"),
        "newton": Stage(paper.newton_stage, 1),
        "frame": Stage(block.frame_stage, 1),
        "stretches": Stage(block.stretch_stage, 1),
        "integrals": Stage(block.compact_stage, 1),
        "barycentre": Stage(paper.barycentre_stage, 1, "medium"),
    },
    "stokes": {
        "frame": Stage(block.frame_stage, 3),
        "stretches": Stage(block.stretch_stage, 3),
        "integrals": Stage(block.compact_stage, 3),
        "prediction": Stage(stokes.predict_inertialess, 1, "medium"),
        "first slope": Stage(stokes.first_inertialess, 1, "medium"),
        "second slope": Stage(stokes.second_inertialess, 1, "judging"),
        "last argument": Stage(stokes.last_inertialess, 1, "medium"),
        "third slope": Stage(stokes.third_inertialess, 1, "judging"),
    },
    "rosenbrock": {
        "frame": Stage(block.frame_stage, 3),
        "stretches": Stage(block.stretch_stage, 3),
        "integrals": Stage(block.compact_stage, 3),
        "prediction": Stage(rosenbrock.predict_inertial, 1, "medium"),
        "first slope": Stage(rosenbrock.first_inertial, 1, "medium"),
        "second slope": Stage(rosenbrock.second_inertial, 1, "judging"),
        "last argument": Stage(rosenbrock.last_inertial, 1, "medium"),
        "third slope": Stage(rosenbrock.third_inertial, 1, "judging"),
    },
}
"""Stages over the lanes of a block that a step of order 3 goes through, in the order of the loop."""
WIDTHS = (0.01, 0.1, 0.5, 2.0, 4.0)
"""Diameters of bodies at the wall, in sizes of a cell."""

FLOW_STAGES = {
    "paper": {"sample": 1, "walk": 1, "gap": 1},
    "stokes": {"sample": 3, "walk": 2, "gap": 1},
    "rosenbrock": {"sample": 3, "walk": 2, "gap": 1},
}
"""What goes particle by particle, and how often in a step: its end is mostly found with the flow there."""


def _repeat(data: Any, times: int) -> None:
    for _ in range(times):
        frame_stage(data)


def _repeat_medium(data: Any, medium: Any, times: int) -> None:
    for _ in range(times):
        medium_stage(data, medium)


def _repeat_judging(data: Any, medium: Any, tolerance: Any, times: int) -> None:
    for _ in range(times):
        judging_stage(data, medium, tolerance)


def _repeat_sample(flow: Any, hosts: Any, x: Any, times: int, out: Any) -> None:
    for _ in range(times):
        for i in range(len(hosts)):
            u, l, u_t = sample(flow, hosts[i], (x[i, 0], x[i, 1], x[i, 2]), 0.0)
            strain = l[0] + l[1] + l[2] + l[3] + l[4] + l[5] + l[6] + l[7] + l[8]
            out[i] += u[0] + u[1] + u[2] + strain + u_t[0]


def _repeat_walk(flow: Any, hosts: Any, x: Any, x1: Any, times: int, out: Any) -> None:
    for _ in range(times):
        for i in range(len(hosts)):
            host, fraction, _, _ = walk(
                flow, hosts[i], (x[i, 0], x[i, 1], x[i, 2]), (x1[i, 0], x1[i, 1], x1[i, 2])
            )
            out[i] += host + fraction


def _repeat_gap(flow: Any, hosts: Any, x: Any, F: Any, R: Any, times: int, out: Any) -> None:
    for _ in range(times):
        for i in range(len(hosts)):
            f = F[i]
            shape = (f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8])
            clearance, _, _ = gap(flow, hosts[i], (x[i, 0], x[i, 1], x[i, 2]), shape, R[i])
            out[i] += min(clearance, 1.0)


def blocks_of(cloud: Any, number: int) -> list[tuple[Any, Any]]:
    """Return some of the blocks of a run of a cloud: rows of the particles, and the filled block."""
    p = cloud.particles
    rows_of = in_blocks(p, np.flatnonzero(p.status == foamprb.Status.ACTIVE))
    starts = np.linspace(0, len(rows_of) - LANES, number).astype(int)
    return [(rows_of[s : s + LANES], filled(cloud, rows_of[s : s + LANES])) for s in starts]


def filled(cloud: Any, members: Any) -> Any:
    """Return a block with the state of the particles, the flow around them and their frame."""
    scratch = block.new_scratch(cloud.tracker.integrator.layout.rows)
    data = scratch.block
    data[:] = 0.0
    block.idle_lanes(data, cloud.dt)
    p = cloud.particles
    u, l = cloud.flow.sample(p.x[members], p.host[members], cloud.time)
    for i, k in enumerate(members):
        block.load_particle(p, k, scratch, i)
        block.store3(data, block.at.u, i, tuple(u[i]))
        block.store9(data, block.at.l, i, tuple(l[i].ravel()))
        if cloud.tracker.integrator.adaptive:
            for row in (during.start_u, during.end_u):
                block.store3(data, row, i, tuple(u[i]))
            for row in (during.start_l, during.end_l):
                block.store9(data, row, i, tuple(l[i].ravel()))
    for stage in (block.frame_stage, block.stretch_stage, block.compact_stage):
        link(_repeat, {"frame_stage": stage}, separate=(stage,))(data, 1)
    return data


def _timed(run: Any, times: int, blocks: int) -> float:
    start = time.process_time()
    run(times)
    return 1e6 * (time.process_time() - start) / (times * blocks * LANES)


def contestants(cloud: Any, integrator: str, number: int) -> dict[str, Any]:
    """Return a function per stage that runs it repeatedly on each block."""
    chosen = blocks_of(cloud, number)
    p = cloud.particles
    runs: dict[str, Any] = {}
    for name, stage in STAGES[integrator].items():
        medium = cloud.tracker.medium
        if stage.takes == "medium":
            bindings = cloud.tracker.bindings | {"medium_stage": stage.function}
            kernel = link(_repeat_medium, read_by(_repeat_medium, bindings), (stage.function,))
            runs[name] = lambda times, k=kernel, m=medium: [k(data, m, times) for _, data in chosen]
        elif stage.takes == "judging":
            bindings = cloud.tracker.bindings | {"judging_stage": stage.function}
            kernel = link(_repeat_judging, read_by(_repeat_judging, bindings), (stage.function,))
            runs[name] = lambda times, k=kernel, m=medium: [k(data, m, 1e-4, times) for _, data in chosen]
        else:
            kernel = link(_repeat, {"frame_stage": stage.function}, separate=(stage.function,))
            runs[name] = lambda times, k=kernel: [k(data, times) for _, data in chosen]
    arrays = cloud.flow.arrays(1e-5)
    out = np.zeros(LANES)
    sampling = link(_repeat_sample)
    walking = link(_repeat_walk, separate=LONG)
    touching = link(_repeat_gap, separate=LONG)
    places = [(p.host[m], p.x[m], p.x[m] + cloud.dt * p.v[m], p.F[m], p.R[m]) for m, _ in chosen]
    runs["sample"] = lambda times: [sampling(arrays, h, x, times, out) for h, x, *_ in places]
    runs["walk"] = lambda times: [walking(arrays, h, x, x1, times, out) for h, x, x1, *_ in places]
    runs["gap"] = lambda times: [touching(arrays, h, x, F, R, times, out) for h, x, _, F, R in places]
    return runs


def share_of_use(flow: Any, n: int, Ca: float, steps: int = 8 * STRIDE) -> float:
    """Return the least share of the lanes' steps of a default run that carry a particle.

    It is that of lanes that would wait for the slowest of their block, and not take another particle.
    Particles of Ca at the wall are up to the wall, and blocks are filled anew after ``steps`` tracking steps.
    """
    cloud = pipe.soft_cloud(
        flow, n, OPENFOAM_STEP, "auto", Ca=Ca, reach=REACH, tolerance=Models().tolerance, stride=STRIDE
    )
    cloud.advance(steps)
    p = cloud.particles
    blocks = in_blocks(p, np.flatnonzero(p.status == foamprb.Status.ACTIVE))
    taken = np.zeros(n)
    whole = cloud.tracker.whole
    for _ in range(steps // whole):
        cloud.advance(whole)
        taken += whole * p.substeps
    in_use = taken[blocks[: len(blocks) // LANES * LANES]].reshape(-1, LANES)
    return float(in_use.sum() / (LANES * in_use.max(axis=1).sum()))


def gap_cost(flow: Any, width: float, n: int, repeats: int) -> float:
    """Measure CPU µs for the gap between wall and a sphere of a given width in cells.

    Its centre is at 0.985 radii from the axis, or as near to the wall as 1.5 of its own radii.
    """
    cell = (np.pi * pipe.RADIUS**2 * pipe.LENGTH / pipe.GRIDS["40k"].cells) ** (1.0 / 3.0)
    R = 0.5 * width * cell
    random = np.random.default_rng(2)
    r, angle = min(REACH * pipe.RADIUS, pipe.RADIUS - 1.5 * R), 2.0 * np.pi * random.random(n)
    x = np.stack([pipe.LENGTH * (0.1 + 0.8 * random.random(n)), r * np.cos(angle), r * np.sin(angle)], axis=1)
    hosts = flow.locate(x)
    order = np.argsort(hosts, kind="stable")
    arrays, hosts, x = flow.arrays(1.05 * SEEN * R), hosts[order], x[order]
    shapes, radii, out = np.tile(np.eye(3).ravel(), (n, 1)), np.full(n, R), np.zeros(n)
    touching = link(_repeat_gap, separate=LONG)
    touching(arrays, hosts, x, shapes, radii, 1, out)
    spent = [cpu_of(lambda: touching(arrays, hosts, x, shapes, radii, 5, out)) for _ in range(repeats)]
    return 1e6 * min(spent) / (5 * n)


def measure(options: Options) -> list[Row]:
    """Measure CPU per particle-step of each stage, and of the loop with many steps a call and with one."""
    n, number, times, repeats = (6400, 10, 20, 3) if options.quick else (100_000, 50, 100, 7)
    flow = foamprb.read_case(pipe.case("40k"))
    found = []
    for integrator, stages in STAGES.items():
        tracker = Tracker(flow, n, integrator, 20)
        single = Tracker(flow, n, integrator, 1)
        runs = contestants(tracker.cloud, integrator, number)
        # In the order of the loop: each stage reads what those before it left in the block.
        for run in runs.values():
            run(1)
        clocks = {name: lambda r=run: _timed(r, times, number) for name, run in runs.items()}
        costs = interleaved({"whole": tracker.cost, "one step": single.cost} | clocks, repeats)
        unit = "us/particle-step"
        found += rows("profile", "cost", {f"foamprb {integrator}, whole loop": costs["whole"]}, unit)
        found += rows("profile", "cost", {f"foamprb {integrator}, one step a call": costs["one step"]}, unit)
        often = {name: stage.times for name, stage in stages.items()} | FLOW_STAGES[integrator]
        shares = {name: costs[name] * count for name, count in often.items()}
        found += rows("profile", f"stage of {integrator}", shares, unit)
    used = {f"Ca {Ca:g}": share_of_use(flow, min(n, 20_000), Ca) for Ca in CAPILLARY_NUMBERS}
    found += rows("profile", USEFUL, used, "")
    gaps = {f"bodies {w:g} cells wide": gap_cost(flow, w, min(n, 20_000), repeats) for w in WIDTHS}
    return found + rows("profile", GAP, gaps, "us")
