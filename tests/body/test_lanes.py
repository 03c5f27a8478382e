"""Formulas for walls and molecules: compiled, vectorised, and equal to numpy."""

from __future__ import annotations

import re

import numpy as np
import pytest
from processor import has_avx2
from strategies import flat, square

from foamprb.body.brownian import deviates, random_force, random_stress, response, shape_resistance
from foamprb.body.drag import oberbeck
from foamprb.body.ellipsoid import integrals
from foamprb.body.faxen import faxen_velocity
from foamprb.body.tensor import dev, sym
from foamprb.body.wall import (
    force_gradient,
    hindered_resistance,
    hindrance,
    stresslet_gradient,
    stresslet_velocity,
)
from foamprb.compile.link import link

LANES = 32


def load3(block, row, i):
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES]


def load9(block, row, i):
    return load3(block, row, i) + load3(block, row + 3, i) + load3(block, row + 6, i)


def store3(block, row, i, v):
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = v[0], v[1], v[2]


def store9(block, row, i, T):
    store3(block, row, i, (T[0], T[1], T[2]))
    store3(block, row + 3, i, (T[3], T[4], T[5]))
    store3(block, row + 6, i, (T[6], T[7], T[8]))


def wall_lanes(block):
    """All that a wall does to the body in each of the lanes, of rows 9 S, 9 C, 3 n, 3 f, 3 k, h, gap."""
    for i in range(LANES):
        S, C, n = load9(block, 0, i), load9(block, 9, i), load3(block, 18, i)
        f, k = load3(block, 21, i), load3(block, 24, i)
        h, gap = block[27 * LANES + i], block[28 * LANES + i]
        store3(block, 29, i, stresslet_velocity(S, C, n, h, 1.3))
        store3(block, 32, i, random_force(hindered_resistance(k, hindrance(k, n, h, gap)), 0.7, f))
        store3(block, 35, i, faxen_velocity(C, (n, f, k, f, n, k)))
        store9(block, 38, i, stresslet_gradient(S, C, n, h, 1.3))
        store9(block, 47, i, force_gradient(f, C, n, h, 1.3))


def brownian_lanes(block):
    """The random stress and the body's response to it in each of the lanes, of rows 3 axes."""
    for i in range(LANES):
        axes = load3(block, 0, i)
        _, xi = deviates(np.uint64(i), np.uint64(5), (np.uint64(3), np.uint64(1)))
        r = shape_resistance(axes, integrals(axes), 0.4)
        store9(block, 3, i, response(r, random_stress(r, 0.9, xi)))


def rows():
    random = np.random.default_rng(8)
    F = np.eye(3) + 0.2 * random.normal(size=(LANES, 3, 3))
    S = np.array([flat(square(dev(sym(flat(T))))) for T in random.normal(size=(LANES, 3, 3))])
    C = (F @ F.transpose(0, 2, 1)).reshape(-1, 9)
    n = random.normal(size=(LANES, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    axes = 0.7 + random.random((LANES, 3))
    k = np.array(oberbeck(tuple(axes.T), integrals(tuple(axes.T)))).T
    h = 1.5 + random.random((LANES, 1))
    wall = np.concatenate([S, C, n, random.normal(size=(LANES, 3)), k, h, h - 1.3], axis=1)
    return {wall_lanes: (wall, 27), brownian_lanes: (axes, 9)}


@pytest.mark.parametrize("lanes", [wall_lanes, brownian_lanes])
def test_compiled_lanes(lanes, monkeypatch, tmp_path):
    # What comes from the cache cannot be inspected.
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    filled, results = rows()[lanes]
    found = np.concatenate([filled.T.ravel(), np.zeros(results * LANES)])
    plain = found.copy()
    compiled = link(lanes)
    compiled(found)
    lanes(plain)
    np.testing.assert_allclose(found, plain, rtol=1e-10, atol=1e-12)
    assert abs(found[filled.size :]).max() > 0.1
    # The vector units of older processors lack some of the operations.
    if has_avx2():
        (assembly,) = compiled.inspect_asm().values()
        operation = r"^\s+v?(?:add|sub|mul|div|sqrt|fn?m(?:add|sub)\d*)([ps])d\b"
        kinds = re.findall(operation, assembly, re.MULTILINE)
        assert kinds.count("p") > 50
        assert kinds.count("s") <= 4
