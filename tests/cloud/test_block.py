"""Blocks of particles: who shares one, and what all lanes of one go through."""

from __future__ import annotations

from itertools import chain, product

import numpy as np
import pytest

from foamprb.body.ellipsoid import COMPACT, integrals
from foamprb.cloud.block import (
    ROWS,
    at,
    idle_lanes,
    load_integrals,
    new_block,
    new_integrals,
    store3,
)
from foamprb.cloud.layout import LANES, layout
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import in_blocks, tasks_of
from foamprb.compile.link import link

LONG, ROUND = (2.5, 1.0, 0.4), (1.3, 1.0, 1.0 / 1.3)


@pytest.mark.parametrize("elongated", [0, 1, LANES - 1, LANES])
def test_every_lane_has_the_integrals_of_its_own_shape(elongated):
    """Whichever of the two ways to them a block goes, or both."""
    block = new_block(ROWS)
    idle_lanes(block, layout(at).initial, 1.0)
    shapes = [LONG if i < elongated else ROUND for i in range(LANES)]
    for i, stretches in enumerate(shapes):
        store3(block, at.stretch, i, stretches)
    link(new_integrals)(block)
    for i, stretches in enumerate(shapes):
        found, expected = load_integrals(block, i), integrals(stretches)
        for name in ("alpha", "ring", "star", "chi"):
            np.testing.assert_allclose(getattr(found, name), getattr(expected, name), rtol=1e-13)


@pytest.mark.parametrize("rows", [1, 3, ROWS])
def test_a_block_begins_on_a_line_of_memory(rows):
    """Else every second access of a wide register takes two lines."""
    for _ in range(20):
        block = new_block(rows)
        assert block.shape == (rows * LANES,)
        assert block.flags.c_contiguous
        assert block.ctypes.data % 64 == 0


def test_particles_of_equal_cost_share_blocks():
    """Of each kind only what is left over shares a block with others; within, neighbours are side by side."""
    random, n = np.random.default_rng(4), 160 * LANES
    p = spheres(np.zeros((n, 3)), d=1e-6, rho=1.0, mu=1.0)
    p.status[:] = Status.ACTIVE
    p.host[:] = random.integers(0, 2**31 - 1, n)
    p.substeps[:] = random.choice([0.25, 1.0, 2.0, 64.0], n)
    long = random.random(n) < 0.5
    turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
    for shape, chosen in ((LONG, long), (ROUND, ~long)):
        p.F[chosen] = (np.diag(shape) @ turn).ravel()
    p.discount[:] = random.choice([0.0, 0.3, 0.75], n)
    p.demanding[:] = random.integers(0, 2, n)
    assert LONG[0] / LONG[2] > COMPACT > ROUND[0] / ROUND[2]
    order = in_blocks(p, np.arange(n))
    np.testing.assert_array_equal(np.sort(order), np.arange(n))
    orders = 2 * p.demanding[order] + (p.discount[order] > 0.0)
    kinds = (32 * p.substeps[order] + 2 * orders + long[order]).reshape(-1, LANES)
    assert np.count_nonzero(np.ptp(kinds, axis=1)) <= 4 * 4 * 2 - 1
    flat, hosts = kinds.ravel(), p.host[order]
    assert (np.diff(hosts)[flat[1:] == flat[:-1]] >= 0).all()


@pytest.mark.parametrize("threads", [1, 3])
def test_pending_particles_cost_nothing_before_they_appear(threads):
    """In no share that ends before, and else in one whose first step is that, or little earlier."""
    random, n, dt, start, step, steps = np.random.default_rng(5), 5000 * LANES + 3, 0.1, 2.0, 30, 100
    p = spheres(np.zeros((n, 3)), d=1e-6, rho=1.0, mu=1.0)
    p.status[:] = random.choice([Status.PENDING, Status.ACTIVE], n, p=[0.7, 0.3])
    p.t0[:] = start + random.uniform(0.0, 20.0, n)
    rows = np.flatnonzero(random.random(n) < 0.9)
    pending = p.status == Status.PENDING
    shares = tasks_of(p, rows, (step, steps), (dt, start), threads)
    assert all(share.step + share.steps == step + steps for share in shares)
    carried = np.concatenate([share.rows for share in shares])
    assert len(np.unique(carried)) == len(carried)
    assert np.isin(carried, rows).all()
    appears = np.where(pending, (p.t0 - start) / dt, -np.inf)
    assert np.isin(rows[appears[rows] < step + steps], carried).all()
    assert appears[carried].max() < step + steps + 2
    begun = np.concatenate([s.step - np.maximum(appears[s.rows], step) for s in shares])
    assert begun.max() <= 0.0
    waited = np.concatenate([appears[s.rows] - s.step for s in shares])
    assert waited.max() < 3.0 + 2.0 * steps / 64


def test_shares_have_whole_blocks_of_the_same_order():
    """Dealt out in turn, so that each share has cheap and costly blocks."""
    for n, number in product([0, 1, LANES, 7 * LANES, 7 * LANES + 5], [1, 3, 16]):
        p = spheres(np.zeros((n, 3)), d=1e-6, rho=1.0, mu=1.0)
        p.status[:] = Status.ACTIVE
        p.host[:] = np.random.default_rng(6).permutation(n)
        order = in_blocks(p, np.arange(n))
        shares = tasks_of(p, np.arange(n), (0, 1), (1.0, 0.0), number)
        blocks = [order[k : k + LANES].tolist() for k in range(0, n, LANES)]
        assert len(shares) == min(number, len(blocks))
        for k, share in enumerate(shares):
            assert share.rows.tolist() == list(chain.from_iterable(blocks[k :: len(shares)]))
