"""Without any part of numba's inner workings, and with another numba, results are the same."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
from paths import PIPE, ROOT

import foamprb
from foamprb.compile import link as linking
from foamprb.compile import trial
from foamprb.compile.internals import PARTS, SWITCH, TRIED, internals
from foamprb.errors import InputError

AIR = foamprb.Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))

# What another numba might lack, and the parts that are then left out.
OTHERS = {
    "version": ("numba.__version__ = '0.99.0'", ()),
    "module": ("sys.modules['numba.core.event'] = None", ("collector",)),
    "extension": ("del numba._dynfunc; sys.modules['numba._dynfunc'] = None", ("machineCode",)),
    "class": ("del numba.core.typed_passes.NopythonRewrites", ("needless",)),
    "method": ("del compiler.CompileResult._reduce", ("cache",)),
    "passes": (
        "del numba.core.compiler_machinery.PassManager",
        ("machineCode", "arithmetic", "needless"),
    ),
}

SITE = """
import sys
import numba
import numba.core.typed_passes
from numba.core import compiler
from numba.core.codegen import JITCodeLibrary
{change}
"""

PROGRAM = """
import logging, sys
logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stdout)
from foamprb.compile import trial
from foamprb.compile.internals import internals
print(*internals().parts)
assert trial.is_right()
"""


def with_another_numba(change, folder):
    """What is said, and the parts that are used, with a numba that is changed as soon as Python starts."""
    (folder / "sitecustomize.py").write_text(SITE.format(change=change))
    environment = {
        **{name: value for name, value in os.environ.items() if name != SWITCH},
        "PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)]),
        "FOAMPRB_CACHE_DIR": str(folder / "cache"),
    }
    done = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    *said, parts = done.stdout.splitlines()
    return said, parts.split()


@pytest.mark.parametrize("without", ["0", "1", *PARTS])
def test_any_part_may_be_missing(without, tmp_path, monkeypatch):
    monkeypatch.setenv(SWITCH, without)
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(linking, "_parts", {})
    expected = [] if without == "1" else [name for name in PARTS if name != without]
    assert list(internals().parts) == expected
    assert trial.is_right()


def test_a_part_that_is_none_has_its_message(monkeypatch):
    monkeypatch.setenv(SWITCH, "inlineing")
    with pytest.raises(
        InputError, match=r"no part inlineing\. Did you mean 'inlining'\? Allowed: arithmetic, "
    ):
        internals()


@pytest.mark.parametrize("kind", OTHERS)
def test_another_numba_is_used_as_far_as_it_goes(kind, tmp_path):
    change, missing = OTHERS[kind]
    said, parts = with_another_numba(change, tmp_path)
    assert parts == [name for name in PARTS if name not in missing]
    assert bool(said) == bool(missing)
    if missing:
        assert f"it compiles more slowly, without {', '.join(missing)}." in said[0]


# One that has all names, and means something else by them.
CHANGED = """
numba.__version__ = '0.99.0'

def finalize(library, again=JITCodeLibrary.finalize, optimize=JITCodeLibrary._optimize_final_module):
    # Called with what it was not called with before.
    JITCodeLibrary._optimize_final_module = optimize
    again(library)
    JITCodeLibrary._optimize_final_module = lambda library, level: optimize(library)

JITCodeLibrary.finalize = finalize
JITCodeLibrary._optimize_final_module = None

import os
from numba.core.typing.context import Context
resolve = Context.resolve_function_type

def resolve_function_type(context, *arguments):
    # As wrong machine code would.
    if 'resolve_function_type' in vars(context):
        os.abort()
    return resolve(context, *arguments)

Context.resolve_function_type = resolve_function_type
"""


def test_parts_that_go_wrong_with_an_unknown_numba_are_left_out(tmp_path):
    said, parts = with_another_numba(CHANGED, tmp_path)
    assert parts == [name for name in PARTS if name not in ("machineCode", "arithmetic")]
    assert said[0].startswith(f"numba 0.99.0 is not the version that foamprb knows best, {TRIED}: ")
    # Found out once: what came of it is saved.
    assert list((tmp_path / "cache/trials").glob("*.code"))


def carried(flow):
    """Particles of the pipe after a few steps: some have left it, some have met its wall."""
    random = np.random.default_rng(0)
    r, angle = 2.0e-3 * np.sqrt(random.random(300)), 2.0 * np.pi * random.random(300)
    x = np.stack([0.1095 * random.random(300), r * np.cos(angle), r * np.sin(angle)], axis=1)
    p = foamprb.spheres(x, d=50e-6, rho=2560.0, mu=0.05)
    walls = [foamprb.Rebound() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    models = foamprb.Models(integrator="stokes")
    foamprb.Cloud(p, flow, AIR, walls, 1e-3, models, threads=1).advance(10)
    return p


def test_the_pipe_is_the_same_without_any_part(tmp_path, monkeypatch):
    """Functions are inlined otherwise, and sums of products rounded otherwise."""
    flow = foamprb.read_case(PIPE)
    usual = carried(flow)
    monkeypatch.setenv(SWITCH, "1")
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    plain = carried(flow)
    assert not list(tmp_path.iterdir())
    assert {foamprb.Status.ACTIVE, foamprb.Status.ESCAPED} == set(usual.status)
    assert np.array_equal(usual.status, plain.status)
    for name in ("x", "v", "F", "t"):
        ours, theirs = getattr(plain, name), getattr(usual, name)
        # Three digits of round-off go where two rates of relaxation are nearly the same.
        assert ours == pytest.approx(theirs, rel=1e-11, abs=1e-13 * np.abs(theirs).max()), name
