"""Plain numba, and a numba version that was not tested, give the same results."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
import small_program
from paths import PIPE, ROOT

import foamprb
from foamprb.compile import link as linking
from foamprb.compile.link import SWITCH, TESTED

AIR = foamprb.Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))

PROGRAM = """
import logging, sys
import numba
{change}
logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stdout)
import small_program
plain = small_program.outer(small_program.example())
assert abs(small_program.linked()(small_program.example()) / plain - 1.0) < 1e-13
"""


@pytest.fixture(params=["0", "1"])
def switch(request, tmp_path, monkeypatch):
    monkeypatch.setenv(SWITCH, request.param)
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(linking, "_parts", {})


def test_small_program_is_right(switch):
    expected, found = small_program.example(), small_program.example()
    total = small_program.outer(expected)
    for _ in range(2):
        # The second time it is loaded from the cache.
        linking._parts.clear()
        found = small_program.example()
        assert small_program.linked()(found) == pytest.approx(total, rel=1e-13)
        assert found.values == pytest.approx(expected.values, rel=1e-13)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("", []),
        ("numba.__version__ = '0.99.0'", [f"numba 0.99.0 is untested (tested: {TESTED})"]),
        (
            "sys.modules['numba._dynfunc'] = None; del numba._dynfunc",
            ["Some optimisations are off"],
        ),
    ],
    ids=["tested", "untested", "changed"],
)
def test_plain_numba_serves_where_internals_are_unknown(change, message, tmp_path):
    environment = {
        **{name: value for name, value in os.environ.items() if name != SWITCH},
        "PYTHONPATH": f"{ROOT}:{ROOT}/tests",
        "FOAMPRB_CACHE_DIR": str(tmp_path),
    }
    command = [sys.executable, "-c", PROGRAM.format(change=change)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert len(lines) == len(message)
    assert all(line.startswith(start) for line, start in zip(lines, message, strict=True))


def moved(flow):
    """Particles of the pipe after a few steps: some have left it, some have met its wall."""
    random = np.random.default_rng(0)
    r, angle = 2.0e-3 * np.sqrt(random.random(300)), 2.0 * np.pi * random.random(300)
    x = np.stack([0.1095 * random.random(300), r * np.cos(angle), r * np.sin(angle)], axis=1)
    p = foamprb.spheres(x, d=50e-6, rho=2560.0, mu=0.05)
    walls = [foamprb.Rebound() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    models = foamprb.Models(integrator="stokes")
    foamprb.Cloud(p, flow, AIR, walls, 1e-3, models, threads=1).advance(10)
    return p


def test_pipe_is_the_same_with_plain_numba(tmp_path, monkeypatch):
    """Sums of products are rounded in another way."""
    flow = foamprb.read_case(PIPE)
    usual = moved(flow)
    monkeypatch.setenv(SWITCH, "1")
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    plain = moved(flow)
    assert not list(tmp_path.iterdir())
    assert {foamprb.Status.ACTIVE, foamprb.Status.ESCAPED} == set(usual.status)
    assert np.array_equal(usual.status, plain.status)
    for name in ("x", "v", "F", "t"):
        ours, theirs = getattr(plain, name), getattr(usual, name)
        # Three digits are lost where two rates of relaxation are nearly the same.
        assert ours == pytest.approx(theirs, rel=1e-11, abs=1e-13 * np.abs(theirs).max()), name
