"""What a loop is made of by default."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import foamprb
from foamprb.cloud.surroundings.dispersion import Dispersion
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.tracker import Models, check


def test_the_tolerance_is_the_one_that_the_manual_tells():
    page = Path(__file__).parents[2] / "docs/settings.md"
    told = re.search(
        r"^\| `integrationSchemes/tolerance` \| 1 \| ([\d.e-]+) \|", page.read_text(), re.MULTILINE
    )
    assert Models().tolerance == float(told[1])


class Misspelt(foamprb.FaxenCorrection):
    def bindings(self, _inertia):
        return {"turn_alongg": self.update}


def test_name_that_no_loop_reads_is_refused():
    everything = foamprb.FaxenCorrection(), foamprb.WallLift(), foamprb.BrownianMotion(T=300.0), Dispersion()
    check(Models(integrator="stokes", surroundings=(*everything, RotatingFrames())), tense=False)
    with pytest.raises(NameError, match=r"Misspelt binds turn_alongg, .*Did you mean turn_along"):
        check(Models(integrator="stokes", surroundings=(Misspelt(),)), tense=False)
