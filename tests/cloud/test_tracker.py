"""What a loop is made of by default, and what of it is compiled beforehand."""

from __future__ import annotations

import inspect
import re
from pathlib import Path

import numba
import pytest

import foamprb
from foamprb.cloud.block import Medium
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.surroundings.dispersion import Dispersion
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.tracker import Models, Tracker, check
from foamprb.flow.meshflow import MeshFlow


def test_the_tolerance_is_the_one_that_the_manual_tells():
    page = Path(__file__).parents[2] / "docs/settings.md"
    told = re.search(
        r"^\| `integrationSchemes/tolerance` \| 1 \| ([\d.e-]+) \|", page.read_text(), re.MULTILINE
    )
    assert Models().tolerance == float(told[1])


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_precompilation_has_an_example_of_each_argument(integrator, monkeypatch):
    """Numbers are double, and a lane is counted as the loop counts it: else it would be compiled again."""
    found = {}

    def note(function, arguments, *_):
        names = inspect.signature(function).parameters
        found[function.__name__] = {name: numba.typeof(arguments[name]) for name in names}

    monkeypatch.setattr("foamprb.cloud.tracker.compile_part", note)
    medium = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
    tracker = Tracker(
        Models(integrator=integrator), MeshFlow.kernels, medium, [], 1e-3, 0.0, shaped=False, tense=False
    )
    tracker.compile_moves(MeshFlow.nothing())
    assert list(found) == ["reach_end"]
    tracker.compile_contact(MeshFlow.nothing())
    tracker.compile_stages()
    for part in tracker.integrator.rare:
        tracker._compile(part, {"flow": MeshFlow.nothing()})
    assert len(found) == 3 + len(tracker.integrator.stages) + len(tracker.integrator.rare)
    expected = dict.fromkeys(("i", "code", "triangle", "step", "last", "kind"), numba.int64)
    expected |= dict.fromkeys(("goal", "x0", "x1"), numba.types.UniTuple(numba.float64, 3))
    expected |= dict.fromkeys(("t_end", "h", "dt", "start", "tolerance", "allowed"), numba.float64)
    expected |= {"held": numba.boolean}
    for types in found.values():
        for name in types.keys() & expected:
            assert types[name] == expected[name], name


class Misspelt(foamprb.FaxenCorrection):
    def bindings(self, _inertia):
        return {"turn_alongg": self.update}


def test_name_that_no_loop_reads_is_refused():
    everything = foamprb.FaxenCorrection(), foamprb.WallLift(), foamprb.BrownianMotion(T=300.0), Dispersion()
    check(Models(integrator="stokes", surroundings=(*everything, RotatingFrames())), tense=False)
    with pytest.raises(NameError, match=r"Misspelt binds turn_alongg, .*Did you mean turn_along"):
        check(Models(integrator="stokes", surroundings=(Misspelt(),)), tense=False)
