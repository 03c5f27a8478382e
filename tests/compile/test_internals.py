"""Plain numba, and a numba version that was not tested, give the same results."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
import small_program
from paths import ROOT
from small_clouds import pipe_cloud

from foamprb.cloud.cloud import Stepper
from foamprb.cloud.state import Status
from foamprb.compile import link as linking
from foamprb.compile.link import SWITCH, TESTED

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
    monkeypatch.setattr(linking, "_dispatchers", {})


def test_small_program_is_right(switch):
    expected, found = small_program.example(), small_program.example()
    total = small_program.outer(expected)
    for _ in range(2):
        # The second time it is loaded from the cache.
        linking._dispatchers.clear()
        found = small_program.example()
        assert small_program.linked()(found) == pytest.approx(total, rel=1e-13)
        assert found.values == pytest.approx(expected.values, rel=1e-13, abs=0.0)


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


def moved():
    """Particles of a pipe after a few steps: some have left it, some have met its wall."""
    cloud = pipe_cloud("paper")
    Stepper(cloud).advance(20)
    return cloud.particles


@pytest.mark.skipif(os.environ.get("HYPOTHESIS_PROFILE") != "nightly", reason="compiles a minute each time")
def test_pipe_is_the_same_with_plain_numba(tmp_path, monkeypatch):
    """Sums of products are rounded in another way."""
    usual = moved()
    monkeypatch.setenv(SWITCH, "1")
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    plain = moved()
    assert not list(tmp_path.iterdir())
    assert {Status.ACTIVE, Status.STUCK, Status.ESCAPED, Status.PENDING} == set(usual.status)
    assert np.array_equal(usual.status, plain.status)
    for name in ("x", "v", "F", "t"):
        ours, theirs = getattr(plain, name), getattr(usual, name)
        # Three digits are lost where two rates of relaxation are nearly the same.
        assert ours == pytest.approx(theirs, rel=1e-11, abs=1e-13 * np.nanmax(np.abs(theirs)), nan_ok=True), (
            name
        )


def test_call_of_an_absent_function_is_an_error(tmp_path, monkeypatch):
    """LLVM would leave the address of the function at zero, and the process would crash."""
    from foamprb.compile import internals

    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(linking, "_dispatchers", {})
    engine = internals._codegen()._engine
    monkeypatch.setattr(engine, "is_symbol_defined", lambda name: not name.startswith("code_"))
    with pytest.raises(RuntimeError, match=r"outer_\w+ calls code_\w+, code_\w+, which is not compiled"):
        small_program.linked()(small_program.example())


def test_indices_of_any_width_share_code(tmp_path, monkeypatch):
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(linking, "_dispatchers", {})
    cells, weights = np.array([2, 0], dtype=np.int32), np.array([1.0, 2.0, 4.0])
    assert linking.link(sum_at)(cells, weights) == 1.0 + 4.0 + 2.0
    (weight,) = (d for d in linking._dispatchers.values() if d.py_func.__name__ == "weight_at")
    assert len(weight.signatures) == 1


def weight_at(weights, cell):
    return weights[cell]


def sum_at(cells, weights):
    total = weight_at(weights, len(cells) - 1)
    for cell in cells:
        total += weight_at(weights, cell)
    return total
